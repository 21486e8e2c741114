"""Fates that change with how records are processed and solved: counts of flips."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rocksteady.model.equations import Model, Nonlinear
from rocksteady.model.motions.record import Record
from rocksteady.outcomes import Status
from rocksteady.risk.calibration.posterior import Posterior
from rocksteady.risk.calibration.sampler.bench import in_plane
from rocksteady.risk.observations.fates import compute_test_fates
from rocksteady.risk.observations.shaking_test import ShakingTest
from rocksteady.sweep.run import Execution

HIGH_PASS_HZ = 0.1
LOOSER = 100.0
LARGEST_TOLERANCE = 1e-3


def count_flips(
    posteriors: Sequence[Posterior],
    tests: Sequence[ShakingTest],
    *,
    model: Model,
    run: Execution | None,
) -> dict[str, int]:
    """Return how many fates change, at the median block of each object without any error.

    Variants are records at half their interval (band-limited between samples, not straight),
    without their linear baseline, high-passed at 0.1 Hz, and, of the full equations, a tolerance
    that is 100 times larger.

    Returns
    -------
    dict
        Number of tests whose fate changes, by the variant.
    """
    variants: list[tuple[str, Callable[[Record], Record | None] | None, Model]] = [
        ("half the sampling interval", _halved, model),
        ("linear baseline removed", _levelled, model),
        (f"high-pass at {HIGH_PASS_HZ} Hz", _high_passed, model),
    ]
    if isinstance(model, Nonlinear):
        looser = Nonlinear(tolerance=min(LARGEST_TOLERANCE, LOOSER * model.tolerance))
        variants.append((f"tolerance {looser.tolerance:g}", None, looser))
    usual = _fates(posteriors, tests, model, run)
    flips = {}
    for words, change, equations in variants:
        changed = tests if change is None else _changed(tests, change)
        flips[words] = int((usual != _fates(posteriors, changed, equations, run)).sum())
    return flips


def _fates(
    posteriors: Sequence[Posterior],
    tests: Sequence[ShakingTest],
    model: Model,
    run: Execution | None,
) -> NDArray[np.bool_]:
    """Return which tests fall."""
    fell = np.zeros(len(tests), dtype=bool)
    for posterior in posteriors:
        places = [place for place, test in enumerate(tests) if test.object == posterior.object]
        values = posterior.median_values()
        block = posterior.space.block.block(values)
        angle = float(posterior.space.orientation(values[np.newaxis])[0])
        dataset = compute_test_fates(
            block,
            in_plane([tests[place] for place in places], angle),
            outputs=("status",),
            model=model,
            run=run,
        )
        fell[places] = (dataset["status"].values == Status.OVERTURNED).reshape(len(places))
    return fell


def _changed(
    tests: Sequence[ShakingTest], change: Callable[[Record], Record | None]
) -> list[ShakingTest]:
    """Return tests on changed records, each record changed once."""
    made: dict[int, Record] = {}

    def of(record: Record) -> Record:
        if id(record) not in made:
            changed = change(record)
            made[id(record)] = record if changed is None else changed
        return made[id(record)]

    return [
        replace(
            test,
            record=of(test.record),
            transverse=None if test.transverse is None else of(test.transverse),
            vertical=None if test.vertical is None else of(test.vertical),
        )
        for test in tests
    ]


def _halved(record: Record) -> Record:
    from scipy.signal import resample_poly

    samples = np.asarray(resample_poly(record.acceleration_m_s2, 2, 1))
    return replace(record, acceleration_m_s2=samples, dt_s=0.5 * record.dt_s)


def _levelled(record: Record) -> Record | None:
    from scipy.signal import detrend

    samples = np.asarray(detrend(record.acceleration_m_s2))
    # Of a straight line nothing is left, which is no record.
    return replace(record, acceleration_m_s2=samples) if samples.any() else None


def _high_passed(record: Record) -> Record:
    from scipy.signal import butter, sosfiltfilt

    samples = record.acceleration_m_s2
    if HIGH_PASS_HZ * 2.0 * record.dt_s >= 1.0:
        return record
    sections = butter(2, HIGH_PASS_HZ, "highpass", fs=1.0 / record.dt_s, output="sos")
    pad = min(len(samples) - 1, round(2.0 / (HIGH_PASS_HZ * record.dt_s)))
    filtered = sosfiltfilt(sections, samples, padtype="constant", padlen=pad)
    return replace(record, acceleration_m_s2=np.asarray(filtered))
