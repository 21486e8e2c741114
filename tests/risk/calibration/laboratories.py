"""Laboratories with a known truth: shaking tests in sessions, as two specimens of stone have them.

``python -m tests.risk.calibration.laboratories 3`` prints held-out scores of three of them.
"""

import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rocksteady import Block, Linear, Record, Status, calibrate, read_record
from rocksteady.calibration import (
    DrawOptions,
    ObjectPrior,
    Observations,
    ShakingTest,
    compute_test_fates,
)
from rocksteady.risk.observations.fates import Scatter
from rocksteady.seismic.measures.scalar import compute_measure
from tests.records import FOLDER

OUTLINES = {"specimen 1": (0.25, 1.0), "specimen 2": (0.17, 0.5)}
"""Width and height [m]."""
SESSION_GAIN, SESSION_RESTITUTION, TEST_GAIN, FLIPPED = 0.15, 0.02, 0.03, 0.05
LEVELS = (0.35, 0.5, 0.65, 0.8, 1.0)
"""p PGV/(g tan alpha) of the outline at the gains of the table."""


@dataclass(frozen=True, kw_only=True)
class Laboratory:
    """Tests as they are given, and what is true of each object and session."""

    tests: Observations
    alpha_rad: Mapping[str, float]
    restitution: Mapping[str, float]
    session_gain: Mapping[str, float]


def motions(count: int, seed: int) -> list[Record]:
    """Return recorded motions, chosen at random."""
    files = sorted((FOLDER / "suite_at2").glob("*.AT2"))
    rng = np.random.default_rng([seed, 3])
    chosen = [read_record(files[k]) for k in rng.permutation(len(files))[:count]]
    return [replace(record, name=record.name or f"motion {k}") for k, record in enumerate(chosen)]


def make_laboratory(
    seed: int, *, tests: int = 490, records: int = 14, sessions: int = 14, scatter: float = 0.0,
    outlines: Sequence[str] = tuple(OUTLINES), spread: float = SESSION_GAIN,
) -> Laboratory:  # fmt: skip
    """Return a laboratory whose sessions take turns with the specimens.

    Parameters
    ----------
    seed
        Another one gives another laboratory.
    tests, records, sessions
        How many, both specimens together.
    scatter
        Deviation of the restitution from impact to impact; above 0.1 no draw of the default prior
        has that law.
    outlines
        Specimens.
    spread
        Standard deviation of the gains of sessions, in ln.
    """
    rng = np.random.default_rng([seed, 4])
    shakings = motions(records, seed)
    base = {name: float(rng.uniform(0.7, 0.9)) for name in outlines}
    factor = {name: float(rng.uniform(0.9, 1.05)) for name in outlines}
    blocks, gain_of = {}, {}
    given, truth, error = [], [], []
    for session in range(sessions):
        name = outlines[session % len(outlines)]
        width, height = OUTLINES[name]
        gain_of[f"day {session + 1}"] = shift = float(rng.normal(0.0, spread))
        held = ObjectPrior(
            name=name, width_m=width, height_m=height, base=base[name], scatter=0.0,
            housner_factor=factor[name] + float(rng.normal(0.0, SESSION_RESTITUTION)),
        )  # fmt: skip
        blocks[f"day {session + 1}"] = held.blocks(np.empty((1, 0)))
        outline = Block.rectangle(width=width, height=height)
        count = tests // sessions + (session < tests % sessions)
        pairs = rng.integers(0, records * len(LEVELS), count)
        for pair in pairs.tolist():
            record, level = shakings[pair // len(LEVELS)], LEVELS[pair % len(LEVELS)]
            unit = float(compute_measure(record, "p_pgv_per_uplift", outline))
            given.append(
                ShakingTest(
                    name=f"test {len(given) + 1}",
                    record=record,
                    object=name,
                    gain=level / unit,
                    session=f"day {session + 1}",
                )  # fmt: skip
            )
            truth.append(replace(given[-1], object=f"day {session + 1}"))
            error.append(shift + TEST_GAIN * float(rng.normal()))
    levels = np.exp(np.array(error))[:, np.newaxis] * np.array([1.0, 0.95, 1.05])
    fell = (
        compute_test_fates(
            blocks, truth, gains=levels, outputs=["status"], model=Linear(),
            scatter=Scatter(scatter, seed=seed) if scatter else None,
        )["status"].values.reshape(len(given), 3)
        == Status.OVERTURNED
    )  # fmt: skip
    edge = (fell != fell[:, :1]).any(axis=1)
    flips = edge & (rng.random(len(given)) < FLIPPED / max(edge.mean(), FLIPPED))
    outcomes = fell[:, 0] ^ flips
    objects = {
        name: ObjectPrior(name=name, width_m=OUTLINES[name][0], height_m=OUTLINES[name][1])
        for name in outlines
    }
    middle = {name: blocks[f"day {k + 1}"][0] for k, name in enumerate(outlines)}
    return Laboratory(
        tests=Observations(
            tests=[
                replace(test, fell=bool(own)) for test, own in zip(given, outcomes, strict=True)
            ],
            objects=objects,
        ),
        alpha_rad={name: block.alpha for name, block in middle.items()},
        restitution=factor,
        session_gain=gain_of,
    )


def scores_of(laboratory: Laboratory, **options: Any) -> dict[str, tuple[float, float]]:
    """Return accuracy and Brier score of each rule, held out by record."""
    found = calibrate(laboratory.tests, folds="record", model=Linear(), **options)
    return {
        name: (row.accuracy[0], row.brier[0]) for name, row in found.validation.rows.items()
    } | {"draws": (min(p.effective_draws for p in found.posteriors.values()), found.temper)}


if __name__ == "__main__":
    for number in range(int(sys.argv[1])):
        began = time.perf_counter()
        scattered = 0.2 if number == 9 else 0.0
        made = make_laboratory(number, scatter=scattered)
        fell = np.nanmean(made.tests.fell)
        ready = time.perf_counter()
        words = {
            name: tuple(round(each, 4) for each in pair)
            for name, pair in scores_of(made, sampling=DrawOptions()).items()
        }
        seconds = time.perf_counter() - ready
        sys.stdout.write(
            f"{number}: {fell:.2f} fell, {words}, {ready - began:.0f} + {seconds:.0f} s\n"
        )
        sys.stdout.flush()
