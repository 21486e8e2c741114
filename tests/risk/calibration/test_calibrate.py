"""Calibrations against dense grids; tests that say little or nothing, or contradict a prior."""

import hashlib
import math
import os
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.special import ndtri

from rocksteady import Status, calibrate
from rocksteady.arrays import Floats
from rocksteady.calibration import (
    Calibration,
    ObjectPrior,
    Observations,
    OutcomeErrors,
    Prior,
    PriorRange,
    ShakingTest,
    compute_test_fates,
)
from rocksteady.errors import InputError
from rocksteady.risk.calibration import calibrate as module
from rocksteady.risk.calibration.calibration import Conflict, codes_of
from tests.every import every
from tests.risk.calibration.cases import LINEAR, SERIAL, STONE, make_records, narrow, narrow_tests

ALONE = ObjectPrior(
    name="block", alpha_rad="0.17:0.33", p_rad_s=4.0, housner_factor=1.0, scatter=0.0
)
EXACT = Prior(
    noise=OutcomeErrors(sigma_ln=PriorRange.exactly(0.2), outliers=PriorRange.exactly(0.03))
)
FEW_TESTS = narrow_tests().subset([place for place in range(60) if place % 15 < 3])
"""Twelve tests on three records."""


def shaken(fell: list[Any], gains: Any = 1.0, block: ObjectPrior = ALONE) -> Observations:
    """Return a test on each of some motions."""
    ends = zip(make_records(len(fell)), fell, np.broadcast_to(gains, len(fell)), strict=True)
    tests = [
        ShakingTest(name=record.name or "", record=record, object="block", fell=own, gain=float(g))
        for record, own, g in ends
    ]
    return Observations(tests=tests, objects={"block": block})


def few(tests: Observations, prior: Prior | None = None, runs: int = 200, seed: int = 0) -> Any:
    return calibrate(tests, prior, most_runs=runs, model=LINEAR, run=SERIAL, seed=seed)


def row_of(found: Calibration, name: str) -> Mapping[str, Any]:
    return next(row for row in found.parameters if row["parameter"] == name)


def on_a_grid(tests: Observations) -> tuple[Floats, Floats]:
    """Return 100 alphas, and the probability of a fall of each test there, by 40 gains."""
    alphas = 0.17 + 0.16 * (np.arange(100) + 0.5) / 100
    gains = np.exp(0.2 * ndtri((np.arange(40) + 0.5) / 40))
    blocks = ALONE.blocks(alphas[:, np.newaxis])
    fates = compute_test_fates(blocks, tests, gains=gains, outputs=("status",), model=LINEAR)
    fell = fates["status"].transpose("block", "test", "gain", "draw").values == Status.OVERTURNED
    return alphas, 0.97 * fell[..., 0].mean(axis=2) + 0.015


def test_posterior_and_predictions_are_those_of_a_dense_grid() -> None:
    """Alpha alone is unknown: its quantiles, and each prediction without its group, by sums."""
    rng = np.random.default_rng(4)
    gains = np.geomspace(0.4, 2.0, 20) * np.exp(0.1 * rng.normal(size=20))
    given = shaken([None] * 20, rng.permutation(gains))
    groups = np.arange(20) // 4
    alphas, p = on_a_grid(given)
    fell = rng.random(20) < p[45]
    tests = [
        replace(test, fell=bool(end), group=f"{group}")
        for test, end, group in zip(given.tests, fell, groups, strict=True)
    ]
    found = few(replace(given, tests=tests), EXACT, 6000)
    logs = np.where(fell, np.log(p), np.log(1.0 - p))
    weights = np.exp(logs.sum(axis=1))
    ends = np.interp([0.5, 0.05, 0.95], np.cumsum(weights) / weights.sum(), alphas + 0.0008)
    assert found.posteriors["block"].interval("alpha_rad") == pytest.approx(ends, abs=0.01)
    exact = []
    for place, group in enumerate(groups):
        weights = np.exp(logs[:, groups != group].sum(axis=1))
        exact.append(float(weights @ p[:, place] / weights.sum()))
    assert np.abs(found.validation.predictions.block - exact).mean() < 0.025
    assert found.validation.predictions.block == pytest.approx(exact, abs=0.08)


@every(
    ("fell", "gain", "share", "words"),
    [(True, 0.8, 0.9, "fell, so that alpha is at most"), (False, 0.7, 0.1, "stood, so that alpha")],
)
def test_outcomes_of_one_kind_give_a_bound_and_no_fit(
    fell: bool, gain: float, share: float, words: str
) -> None:
    tests = shaken([fell] * 6, gain)
    alphas, p = on_a_grid(tests)
    weights = np.prod(p if fell else 1.0 - p, axis=1)
    exact = float(np.interp(share, np.cumsum(weights) / weights.sum(), alphas + 0.0008))
    found = few(tests, EXACT, 3000)
    row = row_of(found, "alpha_rad")
    assert (row["verdict"], row["bound_side"]) == ("bound", "upper" if fell else "lower")
    assert row["bound"] == pytest.approx(exact, abs=0.006)
    assert abs(0.17 + 0.16 * share - exact) > 0.01  # the prior's own is another one
    assert f"A bound and no fit: all tests of block {words}" in " ".join(found.summary().split())


def test_a_narrow_stone_is_described_by_what_is_predicted_first() -> None:
    found = narrow()
    share = found.validation.rows["predicted"].accuracy[0]
    assert found.summary().startswith(f"{100 * share:.0f} % of tests are predicted (90 %:")
    effective = found.posteriors["stone"].effective_draws
    assert f"{effective:.0f} effective draws." in found.summary()
    # A lone session is accepted, and its gain stays the widest.
    widths = {}
    for name in found.posteriors["stone"].sessions:
        _, low, high = found.posteriors["stone"].session_gain(name)
        widths[name] = math.log(high / low)
    assert max(widths, key=widths.__getitem__) == "day 4"
    assert found.new_day is not None
    assert (found.new_day.folds, found.new_day.rows["predicted"].groups) == ("session", 4)
    assert "half the sampling interval" in found.flips
    assert row_of(found, "alpha_rad")["outline"] == pytest.approx(STONE.outline_alpha_rad)
    assert row_of(found, "base")["verdict"] == "identified"


def test_folds_are_of_one_of_four_kinds() -> None:
    tests = narrow_tests().tests
    names, codes = codes_of(tests, "session")
    assert [names[code] for code in codes.tolist()] == [test.session for test in tests]
    assert narrow().validate("test").rows["predicted"].groups == 60
    names, codes = codes_of([replace(tests[0], session=None), *tests[1:]], "session")
    assert (names[codes[0]], (codes == codes[0]).sum()) == ("t0", 1)
    with pytest.raises(InputError, match="no test has a session; give tests theirs, or hold out"):
        codes_of([replace(test, session=None) for test in tests], "session")
    with pytest.raises(InputError, match="it must be one of group, record, test, session"):
        codes_of(tests, "day")  # type: ignore[arg-type]


def test_a_budget_that_is_used_up_is_no_answer() -> None:
    found = few(FEW_TESTS, runs=100)
    effective = found.posteriors["stone"].effective_draws
    assert found.describe().sentence == (
        f"No answer: {effective:.0f} effective draws of the 200 that it takes, after 100 runs of a "
        "test."
    )
    assert found.more_runs_help
    assert {row["verdict"] for row in found.parameters} == {"not identified"}
    assert all(row["median"] is row["low"] is row["bound"] is None for row in found.parameters)


def test_what_says_nothing_is_said() -> None:
    """One record, no outcome, nothing that lifts, an object that is known exactly."""
    of_one = [test for test in narrow_tests().tests if test.group == "motion 2"]
    found = few(replace(narrow_tests(), tests=of_one))
    assert found.validation.rows == {}
    reason = "all tests with an outcome are of one group: none is left to predict it from"
    assert any(reason in sentence for sentence in found.warnings)
    found = few(shaken([None] * 3), runs=1200)
    assert {row["verdict"] for row in found.parameters} == {"prior returned"}
    assert any("no test has an outcome" in sentence for sentence in found.warnings)
    found = few(shaken([False] * 4, 1e-3), runs=1200)
    assert any("is informative" in sentence for sentence in found.warnings)
    # The prior's own 10 %.
    assert row_of(found, "alpha_rad")["bound"] == pytest.approx(0.17 + 0.1 * 0.16, abs=0.01)
    exact = shaken([True, False, True], block=replace(ALONE, alpha_rad=0.25))
    found = few(exact, EXACT, runs=400)
    _, p = on_a_grid(exact)
    assert found.validation.predictions.block == pytest.approx(0.5 * (p[49] + p[50]), abs=0.08)


# ----------------------------------------------------------------------------------- conflicts


@every(
    ("given", "ends", "widened", "runs"),
    [
        ("", {"base": "lower"}, {"base": True}, 2),
        ("0.3:1.2", {"base": "lower"}, {"base": False}, 1),
        ("0.3:1.2", {"base": "lower", "sigma_ln": "upper"}, {"base": False, "sigma_ln": True}, 2),
        ("", {}, {}, 1),
    ],
)
def test_only_defaults_are_widened(
    given: str, ends: Any, widened: dict[str, bool], runs: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[Any] = []

    def find(bench: Any, noise: OutcomeErrors, **_: Any) -> Any:
        seen.append((bench.space.block.spreads["base"], noise.sigma_ln))
        return SimpleNamespace(turn=len(seen), bench=bench)

    monkeypatch.setattr(module, "find_posterior", find)
    monkeypatch.setattr(module, "contradictions", lambda fit: ends if fit.turn == 1 else {})
    plan = module._Plan(seed=0, most_runs=200, model=LINEAR, run=None)
    stone = replace(STONE, base=given or None)
    _, conflicts = module._fit(stone, OutcomeErrors(), narrow_tests(), 0, plan)
    assert [(each.parameter, each.widened) for each in conflicts] == list(widened.items())
    assert len(seen) == runs
    assert seen[0][0] == PriorRange.parse(given or "log:0.03:1.2")
    assert (seen[-1][0].low < seen[0][0].low) == widened.get("base", False)
    assert (seen[-1][1].high > seen[0][1].high) == widened.get("sigma_ln", False)


def test_a_conflict_is_said_first_with_its_direction() -> None:
    prior = PriorRange.parse("log:0.03:1.2")
    conflict = Conflict(object="a", parameter="base", side="upper", prior=prior, widened=True)
    text = " ".join(replace(narrow(), conflicts=(conflict,)).summary().split())
    line = "of base (0.03 to 1.2) towards higher values; it was widened. "
    assert text.startswith(f"Tests contradict the default {line}")


# ------------------------------------------------------------------------------------ the same


def hash_of(found: Calibration) -> str:
    """Return a hash of all that a calibration says."""
    digest = hashlib.sha256(repr(found.to_dict()).encode())
    for each in found.posteriors.values():
        for array in (each.values, each.weights, *each.errors.values(), *each.sessions.values()):
            digest.update(array.tobytes())
    predictions = found.validation.predictions
    for column in (predictions.p, predictions.block, predictions.logistic, predictions.low):
        digest.update(column.tobytes())
    return digest.hexdigest()


@pytest.mark.slow
def test_another_seed_is_another_calibration_and_the_same_seed_is_not() -> None:
    first, again, other = (hash_of(few(FEW_TESTS, seed=seed)) for seed in (1, 1, 2))
    assert first == again != other


PROGRAM = """
from rocksteady import Execution, calibrate
from tests.risk.calibration.test_calibrate import LINEAR, hash_of, narrow_tests
run = Execution(executor="threads", workers={workers})
print(hash_of(calibrate(narrow_tests().subset(range(24)), most_runs=1600, model=LINEAR, run=run)))
"""
PLAIN = {
    "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4 AVX512_ICL",
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX512F",
}


@pytest.mark.slow
def test_the_same_bits_for_any_workers_threads_and_processors() -> None:
    """Threads of BLAS, its kernels for other processors, NumPy without vectors, plain libm."""
    hashes = set()
    for workers, threads, kernels, others in (
        (1, "1", "", {}),
        (2, "4", "", {}),
        (1, "1", "Haswell", {}),
        (1, "2", "Prescott", {}),
        (1, "1", "Nehalem", PLAIN),
    ):
        keys = {"OPENBLAS_NUM_THREADS": threads} | (
            {"OPENBLAS_CORETYPE": kernels} if kernels else {}
        )
        program = [sys.executable, "-W", "ignore", "-c", PROGRAM.format(workers=workers)]
        environment = os.environ | keys | others
        done = subprocess.run(program, env=environment, capture_output=True, text=True, check=True)
        hashes.add(done.stdout.split()[-1])
    assert len(hashes) == 1
