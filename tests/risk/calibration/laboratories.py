"""Laboratories with a known truth: shaking tests in sessions, as two specimens of stone have them.

``python -m tests.risk.calibration.laboratories scores 0 10`` prints held-out scores of ten of them,
and ``coverage 0 200`` how often 90 % intervals of small ones hold what is true.  ``drawn 0 200``
does so where the truth comes from the default priors: there 90 % of them must hold it.
"""

import functools
import math
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rocksteady import Block, Linear, Record, Status, calibrate, read_record
from rocksteady.calibration import (
    ObjectPrior,
    Observations,
    OutcomeErrors,
    Prior,
    ShakingTest,
    compute_test_fates,
)
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.risk.observations.fates import Scatter
from rocksteady.seismic.measures.scalar import compute_measure
from tests.records import FOLDER

OUTLINES = {"specimen 1": (0.25, 1.0), "specimen 2": (0.17, 0.5)}
"""Width and height [m]."""
SESSION_GAIN, SESSION_RESTITUTION, TEST_GAIN, FLIPPED = 0.15, 0.02, 0.03, 0.05
STRANGE, SCATTERED = 9, 0.2
"""Laboratory whose law is not ours, and how much its restitution scatters."""
LEVELS = (0.35, 0.5, 0.65, 0.8, 1.0)
"""p PGV/(g tan alpha) of the outline at the gains of the table."""


@dataclass(frozen=True, kw_only=True)
class Laboratory:
    """Tests as they are given, and what is true of each object and session."""

    tests: Observations
    alpha_rad: Mapping[str, float]
    restitution: Mapping[str, float]
    session_gain: Mapping[str, float]
    session_ln: float


def motions(count: int, seed: int) -> list[Record]:
    """Return recorded motions, chosen at random."""
    files = sorted((FOLDER / "suite_at2").glob("*.AT2"))
    rng = np.random.default_rng([seed, 3])
    chosen = [read_record(files[k]) for k in rng.permutation(len(files))[:count]]
    return [replace(record, name=record.name or f"motion {k}") for k, record in enumerate(chosen)]


def make_laboratory(
    seed: int, *, tests: int = 490, records: int = 14, sessions: int = 14, scatter: float = 0.0,
    outlines: Sequence[str] = tuple(OUTLINES), spread: float = SESSION_GAIN, drawn: bool = False,
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
    drawn
        Whether objects and errors are drawn from the default priors, with one outline.
    """
    rng = np.random.default_rng([seed, 4])
    of_test, flipped = TEST_GAIN, FLIPPED
    shakings = motions(records, seed)
    base = {name: float(rng.uniform(0.7, 0.9)) for name in outlines}
    factor = {name: float(rng.uniform(0.9, 1.05)) for name in outlines}
    if drawn:
        (name,), chance = outlines, np.random.default_rng([seed, 5])
        known = ObjectPrior(name=name, width_m=OUTLINES[name][0], height_m=OUTLINES[name][1])
        values = known.draw(chance.random((1, len(known.parameters))))[0].tolist()
        its = dict(zip(known.parameters, values, strict=True))
        base[name], factor[name], scatter = its["base"], its["housner_factor"], its["scatter"]
        noise = OutcomeErrors()
        errors = (noise.session_ln, noise.sigma_ln, noise.outliers)
        spread, of_test, flipped = (float(each.quantile(chance.random())) for each in errors)
    blocks, gain_of = {}, {}
    given: list[ShakingTest] = []
    truth: list[ShakingTest] = []
    error: list[float] = []
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
                )
            )
            truth.append(replace(given[-1], object=f"day {session + 1}"))
            error.append(shift + of_test * float(rng.normal()))
    levels = np.exp(np.array(error))[:, np.newaxis] * np.array([1.0, 0.95, 1.05])
    fell = (
        compute_test_fates(
            blocks, truth, gains=levels, outputs=["status"], model=Linear(),
            scatter=Scatter(scatter, seed=seed) if scatter else None,
        )["status"].values.reshape(len(given), 3)
        == Status.OVERTURNED
    )  # fmt: skip
    edge = (fell != fell[:, :1]).any(axis=1) | drawn
    share = flipped / 2.0 if drawn else flipped / max(edge.mean(), flipped)
    flips = edge & (rng.random(len(given)) < share)
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
        session_ln=spread,
    )


def scores_of(found: Calibration) -> tuple[float, float]:
    """Return accuracy and Brier score, held out by record."""
    row = found.validation.rows["calibrated"]
    return row.accuracy[0], row.brier[0]


def table_of(seed: int) -> dict[str, tuple[float, float]]:
    """Return the scores of a laboratory with each cure switched off in turn, and of its rivals."""
    tests = make_laboratory(seed, scatter=SCATTERED if seed == STRANGE else 0.0).tests
    alone = replace(tests, tests=[replace(test, session=None) for test in tests.tests])
    found = fit(tests)
    rows = {"all cures": scores_of(found)}
    for rule in ("logistic", "base rate"):
        row = found.validation.rows[rule]
        rows[rule] = row.accuracy[0], row.brier[0]
    for recalibrate in (False, True):
        other = replace(found, recalibrate=recalibrate)
        rows[f"recalibrate {recalibrate}"] = scores_of(
            replace(found, validation=other.validate("record"))
        )
    rows["without sessions"] = scores_of(fit(alone))
    rows["base 0.6 to 1"] = scores_of(fit(tests, Prior(defaults={"base": "0.6:1.0"})))
    return rows


def fit(tests: Observations, prior: Prior | None = None) -> Calibration:
    """Return a calibration by the linear equations, held out by record."""
    return calibrate(tests, prior, folds="record", model=Linear())


def covered(seed: int, *, drawn: bool = False) -> dict[str, list[bool]]:
    """Return whether 90 % intervals of 60 tests on 12 records hold what is true."""
    name = tuple(OUTLINES)[seed % 2]
    made = make_laboratory(seed, tests=60, records=12, sessions=6, outlines=(name,), drawn=drawn)
    posterior = fit(made.tests).posteriors[name]
    truth = {
        "alpha_rad": made.alpha_rad[name],
        "housner_factor": made.restitution[name],
        "session_ln": made.session_ln,
    }
    held = {}
    for key, value in truth.items():
        _, low, high = posterior.interval(key)
        held[key] = [low <= value <= high]
    gains = [(math.exp(gain), *posterior.session_gain(day)) for day, gain in
             made.session_gain.items()]  # fmt: skip
    return held | {"gain of a session": [low <= gain <= high for gain, _, low, high in gains]}


def main(kind: str, first: int, last: int) -> None:
    """Print scores, or coverage, of laboratories."""
    coverage = functools.partial(covered, drawn=kind == "drawn")
    kept: dict[str, list[Any]] = {}
    began = time.perf_counter()
    for seed in range(first, last):
        rows: Mapping[str, Any] = table_of(seed) if kind == "scores" else coverage(seed)
        for name, values in rows.items():
            kept.setdefault(name, []).extend([values] if kind == "scores" else values)
        means = {name: np.mean(values, axis=0).round(4).tolist() for name, values in kept.items()}
        words = f"{seed - first + 1} in {time.perf_counter() - began:.0f} s: {means}\n"
        sys.stdout.write(words)
        sys.stdout.flush()


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
