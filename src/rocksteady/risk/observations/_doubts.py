"""What is unusual in tests: large gains, bases that do not come to rest, coarse records."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from rocksteady.model.motions.record import Record
from rocksteady.results.numbers import number, plural
from rocksteady.risk.observations._sides import P
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.shaking_test import ShakingTest

LARGE_GAIN = 10.0
MOVING_BASE = 0.1
"""Velocity after a record over the largest in it, above which the base has not come to rest."""
COARSE = 0.1
"""Interval times p, above which the form of a pulse is lost between samples."""


def doubts_on(tests: Sequence[ShakingTest], objects: Mapping[str, ObjectPrior]) -> Iterator[str]:
    """Yield sentences on what is unusual."""
    scaled = [test for test in tests if not 1.0 / LARGE_GAIN <= test.gain <= LARGE_GAIN]
    if scaled:
        worst = max(scaled, key=lambda test: max(test.gain, 1.0 / test.gain))
        yield (
            f"{plural(len(scaled), 'test')} scale a record by more than 10 or by less than 1/10, "
            f"{worst.name} by {number(worst.gain)}: check the units of the record."
        )
    # No object stands at an angle beyond its slenderness.
    most = {name: prior.outline_alpha_rad for name, prior in objects.items()}
    beyond = [each for each in tests if (each.peak_rad or 0.0) > most[each.object]]
    if beyond:
        first = beyond[0]
        yield (
            f"{plural(len(beyond), 'test')} that stood reached more than the slenderness of the "
            f"object, {first.name} {number(first.peak_rad or 0.0)} rad of "
            f"{number(most[first.object])}: check the unit of peak_rad, and the size."
        )
    records = {id(test.record): test.record for test in tests}
    moving = [record for record in records.values() if _left_moving(record)]
    if moving:
        yield (
            f"After {plural(len(moving), 'record')} the base still moves, as after "
            f"{moving[0].name}: its velocity at the end is above a tenth of the largest. Correct "
            "the baseline, or give the whole record."
        )
    rates = {name: _rate(prior) for name, prior in objects.items()}
    steps = {test.name: test.record.dt_s * rates[test.object] for test in tests}
    coarse = [name for name, step in steps.items() if step > COARSE]
    if coarse:
        coarsest = max(coarse, key=steps.__getitem__)
        yield (
            f"Records are sampled coarsely in {plural(len(coarse), 'test')}: dt p is "
            f"{number(steps[coarsest])} in {coarsest}, above {COARSE:g}."
        )


def _left_moving(record: Record) -> bool:
    """Return whether the base still moves after a record."""
    a = record.acceleration_m_s2
    velocity = np.cumsum(0.5 * (a[1:] + a[:-1]))
    return bool(abs(velocity[-1]) > MOVING_BASE * np.abs(velocity).max())


def _rate(one: ObjectPrior) -> float:
    """Return p of the middle of what is known [rad/s]."""
    middle = one.draw(np.full((1, len(one.parameters)), 0.5))
    return float(one.sides(middle)[0, :, P].max())
