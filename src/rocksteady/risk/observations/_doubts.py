"""What is unusual in tests: large gains, bases that do not come to rest, coarse records."""

from collections.abc import Mapping, Sequence

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


def doubts_on(tests: Sequence[ShakingTest], objects: Mapping[str, ObjectPrior]) -> tuple[str, ...]:
    """Return sentences on what is unusual."""
    return (
        *_gains(tests),
        *_peaks(tests, objects),
        *_moving(tests),
        *_coarse(tests, objects),
    )


def _gains(tests: Sequence[ShakingTest]) -> list[str]:
    scaled = [test for test in tests if not 1.0 / LARGE_GAIN <= test.gain <= LARGE_GAIN]
    if not scaled:
        return []
    worst = max(scaled, key=lambda test: max(test.gain, 1.0 / test.gain))
    words = (
        f"{plural(len(scaled), 'test')} scale a record by more than 10 or by less than 1/10, "
        f"{worst.name} by {number(worst.gain)}: check the units of the record."
    )
    return [words]


def _peaks(tests: Sequence[ShakingTest], objects: Mapping[str, ObjectPrior]) -> list[str]:
    """Return a sentence on angles beyond the slenderness, at which no object stands."""
    most = {name: prior.outline_alpha_rad for name, prior in objects.items()}
    beyond = [each for each in tests if (each.peak_rad or 0.0) > most[each.object]]
    if not beyond:
        return []
    first = beyond[0]
    words = (
        f"{plural(len(beyond), 'test')} that stood reached more than the slenderness of the "
        f"object, {first.name} {number(first.peak_rad or 0.0)} rad of "
        f"{number(most[first.object])}: check the unit of peak_rad, and the size."
    )
    return [words]


def _moving(tests: Sequence[ShakingTest]) -> list[str]:
    records = {id(test.record): test.record for test in tests}
    moving = [record for record in records.values() if _left_moving(record)]
    if not moving:
        return []
    words = (
        f"After {plural(len(moving), 'record')} the base still moves, as after "
        f"{moving[0].name}: its velocity at the end is above a tenth of the largest. Correct the "
        "baseline, or give the whole record."
    )
    return [words]


def _left_moving(record: Record) -> bool:
    """Return whether the base still moves after a record."""
    a = record.acceleration_m_s2
    velocity = np.cumsum(0.5 * (a[1:] + a[:-1]))
    return bool(abs(velocity[-1]) > MOVING_BASE * np.abs(velocity).max())


def _coarse(tests: Sequence[ShakingTest], objects: Mapping[str, ObjectPrior]) -> list[str]:
    rates = {name: _rate(prior) for name, prior in objects.items()}
    coarse = [test for test in tests if test.record.dt_s * rates[test.object] > COARSE]
    if not coarse:
        return []
    worst = max(coarse, key=lambda test: test.record.dt_s * rates[test.object])
    words = (
        f"Records are sampled coarsely in {plural(len(coarse), 'test')}: dt p is "
        f"{number(worst.record.dt_s * rates[worst.object])} in {worst.name}, above {COARSE:g}."
    )
    return [words]


def _rate(one: ObjectPrior) -> float:
    """Return p of the middle of what is known [rad/s]."""
    middle = one.draw(np.full((1, len(one.parameters)), 0.5))
    return float(one.sides(middle)[0, :, P].max())
