"""Synthetic laboratories of known truth: 75 of the family that is fitted, 25 of another body.

``python -m tests.risk.calibration.laboratories 0 100`` prints a row for each: effective draws,
Pareto's k, where the truth lies in the posterior, and held-out scores of all ways to predict.
"""

import sys
import time
from dataclasses import dataclass
from typing import Any

import numpy as np

from rocksteady import Nonlinear, Status, calibrate
from rocksteady.arrays import Floats
from rocksteady.calibration import (
    Calibration,
    ObjectPrior,
    Observations,
    Scatter,
    ShakingTest,
    compute_test_fates,
)
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk.calibration.held_out.leaving_out import Case, Draws, predict_cases
from rocksteady.risk.calibration.sampler.space import WIDEST, Space, widened

FAMILY = 75
"""Laboratories of the family; later ones have another body."""
NAMES = ("base", "offset", "mass_centre_height_m", "gyration_m", "housner_factor", "scatter")
WIDTH_M, HEIGHT_M = 0.7, 0.8


@dataclass(frozen=True)
class Laboratory:
    """Tests, and what they were made of."""

    tests: Observations
    space: Space
    truth: Floats
    """Values of the parameters, shape (1, parameters)."""
    family: bool


def make_laboratory(number: int, *, motions: int = 24, sessions: int = 6) -> Laboratory:
    """Return 40 to 120 tests of a block with a base of 0.05 to 1.1 of the outline.

    The last session has one test.
    """
    rng, family = np.random.default_rng((93, number)), number % 100 < FAMILY
    count = int(rng.integers(40, 121))
    given = ObjectPrior(name="block", width_m=WIDTH_M, height_m=HEIGHT_M)
    space = Space(block=widened(given, dict.fromkeys(NAMES, False)))
    sizes = {"mass_centre_height_m": HEIGHT_M, "gyration_m": np.hypot(WIDTH_M, HEIGHT_M) / 12**0.5}
    ends = {name: (WIDEST[name][0].low, WIDEST[name][0].high) for name in NAMES}
    if not family:
        stranger = rng.random(3) < 0.5
        ends |= {
            "offset": (0.65, 0.8) if stranger[0] else (-0.8, -0.65),
            "mass_centre_height_m": (0.22, 0.28) if stranger[1] else (0.62, 0.7),
            "gyration_m": (0.75, 0.83) if stranger[2] else (1.12, 1.25),
            "scatter": (0.05, 0.05),
        }
    drawn = {name: rng.uniform(*ends[name]) * sizes.get(name, 1.0) for name in NAMES}
    drawn["base"] = np.exp(rng.uniform(np.log(0.05), np.log(1.1)))
    truth = np.array([[drawn[name] for name in space.names]])
    exact = ObjectPrior(name="block", width_m=WIDTH_M, height_m=HEIGHT_M, **drawn)
    weaker, _, half, rate, _, scatter = space.features(truth)[0]
    lean = weaker + half
    sigma, outliers = rng.uniform(0.05, 0.2), rng.uniform(0.01, 0.05)
    between = rng.uniform(0.0, 0.4) if family else 0.2
    moved = between * rng.standard_normal(sessions)
    day = rng.integers(sessions - 1, size=count)
    day[0] = sessions - 1
    suite = make_synthetic_suite(motions, seed=number)
    tests: list[dict[str, Any]] = []
    gains = []
    for place in range(count):
        record = suite[rng.integers(motions)]
        speed = np.abs(np.cumsum(record.acceleration_m_s2) * record.dt_s).max()
        level = np.exp(rng.uniform(np.log(0.4), np.log(2.2)))  # p PGV/(g tan alpha)
        gain = float(level * 9.81 * np.exp(lean) / (np.exp(rate) * speed))
        tests.append({"name": f"t{place}", "record": record, "object": "block", "gain": gain})
        gains.append(np.exp(moved[day[place]] + sigma * rng.standard_normal()))
    ends_of = compute_test_fates(
        exact.block([]),
        [ShakingTest(**test) for test in tests],
        gains=np.array(gains)[:, np.newaxis],
        scatter=Scatter(float(scatter), seed=number),
        outputs=("status",),
        model=Nonlinear(tolerance=1e-8),
    ).status.values.ravel()
    fell = np.where(
        rng.random(count) < outliers, rng.random(count) < 0.5, ends_of == Status.OVERTURNED
    )
    shaken = [
        ShakingTest(**test, fell=bool(end), session=f"day {number}")
        for test, end, number in zip(tests, fell, day.tolist(), strict=True)
    ]
    made = Observations(tests=shaken, objects={"block": given})
    return Laboratory(tests=made, space=space, truth=truth, family=family)


def by_truth(laboratory: Laboratory, calibration: Calibration) -> Floats:
    """Return held-out P(fall) of the block that made the tests, on the surfaces of the fit."""
    (fit,) = calibration.fits
    draws = Draws(
        likelihood=fit.likelihood,
        surfaces=fit.surfaces,
        features=laboratory.space.features(laboratory.truth),
        base=np.zeros(1),
    )
    groups = np.unique([test.group for test in laboratory.tests.tests], return_inverse=True)[1]
    cases = [Case(left=np.flatnonzero(groups == g), asked=np.flatnonzero(groups == g))
             for g in range(groups.max() + 1)]  # fmt: skip
    p = np.empty(len(groups))
    for case, (held, _) in zip(cases, predict_cases(draws, cases), strict=True):
        p[case.asked] = held.p
    return p


def row_of(number: int, seed: int = 0) -> dict[str, Any]:
    """Return what a laboratory shows."""
    laboratory, began = make_laboratory(number), time.perf_counter()
    calibration = calibrate(laboratory.tests, seed=seed)
    seconds = time.perf_counter() - began
    posterior, space = calibration.posteriors["block"], laboratory.space
    names = [*space.names, "alpha_rad", "p_rad_s", "restitution"]
    truth = dict(zip(space.names, laboratory.truth[0], strict=True))
    truth |= {name: value[0] for name, value in space.derived(laboratory.truth).items()}
    ranks = {n: float(posterior.weights[posterior.of(n) < truth[n]].sum()) for n in names}
    weaker, half = (space.features(posterior.values)[:, column] for column in (0, 2))
    mean = float(space.features(laboratory.truth)[0, [0, 2]].sum())
    ranks["mean ln tan alpha"] = float(posterior.weights[weaker + half < mean].sum())
    fell, validation = laboratory.tests.fell, calibration.validation
    ways = {
        "predicted": validation.predictions.p,
        "block": validation.predictions.block,
        "logistic": validation.predictions.logistic,
        "truth": by_truth(laboratory, calibration),
    }
    return {
        "number": number,
        "family": laboratory.family,
        "tests": len(fell),
        "base": truth["base"],
        "effective": posterior.effective_draws,
        "k": posterior.pareto_k,
        "runs": calibration.runs["block"],
        "rounds": len(calibration.fits[0].rounds),
        "seconds": seconds,
        "conflicts": [each.sentence for each in calibration.conflicts],
        "ranks": ranks,
        "fell": fell.tolist(),
        "ways": {name: p.tolist() for name, p in ways.items()},
    }


def summary(rows: list[dict[str, Any]]) -> None:
    """Print coverage of 90 % intervals and held-out scores over laboratories."""
    for family in (True, False):
        chosen = [row for row in rows if row["family"] == family]
        if not chosen:
            continue
        inside = {
            name: sum(0.05 < row["ranks"][name] < 0.95 for row in chosen)
            for name in chosen[0]["ranks"]
        }
        kind = "family" if family else "another body"
        sys.stdout.write(f"{kind} {len(chosen)}, inside 90 %: {inside}\n")
    fell = np.concatenate([row["fell"] for row in rows])
    for name in rows[0]["ways"]:
        p = np.concatenate([row["ways"][name] for row in rows])
        right, brier = np.mean((p >= 0.5) == (fell > 0.5)), np.mean(np.square(p - fell))
        sys.stdout.write(f"{name:10s} accuracy {right:.4f} Brier {brier:.4f}\n")
    least = min(row["effective"] for row in rows)
    most = max(row["k"] for row in rows)
    sys.stdout.write(f"effective draws {least:.0f} at least, k {most:.2f} at most\n")


def main(first: int, last: int) -> None:
    """Print the rows of some laboratories, and what they show together."""
    rows = []
    for number in range(first, last):
        row = row_of(number)
        rows.append(row)
        sys.stdout.write(
            f"{number:3d} {row['tests']:4d} tests, base {row['base']:.2f}: "
            f"{row['effective']:5.0f} effective, k {row['k']:5.2f}, {row['runs']:5d} runs, "
            f"{row['seconds']:5.1f} s, alpha at {row['ranks']['mean ln tan alpha']:.3f} "
            f"{'; '.join(row['conflicts'])}\n"
        )
    summary(rows)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:3]))
