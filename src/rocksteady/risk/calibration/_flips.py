"""Fates that change with how records are processed and solved: counts of flips."""

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rocksteady.errors import InputError
from rocksteady.model.equations import Model, Nonlinear
from rocksteady.model.motions.record import Record
from rocksteady.outcomes import Status
from rocksteady.records.core.recording import Recording
from rocksteady.records.processing import Cleaning, resample
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
    high = Cleaning(filter_hz=f"{HIGH_PASS_HZ}:")
    variants: list[tuple[str, Callable[[Recording], Recording] | None, Model]] = [
        ("half the sampling interval", _halved, model),
        ("linear baseline removed", Cleaning(baseline="linear").apply, model),
        (f"high-pass at {HIGH_PASS_HZ} Hz", high.apply, model),
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
    tests: Sequence[ShakingTest], change: Callable[[Recording], Recording]
) -> list[ShakingTest]:
    """Return tests on changed records, each record changed once, where it can be changed."""
    made: dict[int, Record] = {}

    def of(record: Record | None) -> Record | None:
        if record is not None and id(record) not in made:
            made[id(record)] = record
            recording = Recording(record=record, format="", path=Path(), units_in_file="m/s^2")
            with suppress(InputError):  # a slow record has no such band, a straight one no rest
                made[id(record)] = change(recording).record
        return None if record is None else made[id(record)]

    keys = ("record", "transverse", "vertical")
    return [
        replace(test, **{key: of(getattr(test, key)) for key in keys})  # type: ignore[arg-type]
        for test in tests
    ]


def _halved(recording: Recording) -> Recording:
    return resample(recording, 0.5 * recording.record.dt_s, method="filtered")
