"""Held-out predictions against posteriors on a grid, where fates are a threshold in alpha."""

import numpy as np
import pytest
from scipy import stats

from rocksteady.risk.calibration.held_out.folds import (
    LADDER,
    Evidence,
    _nested_scores,
    choose_tempers,
    effective,
    hold_out,
    predict_with,
    preferred,
    weighted_quantiles,
)

SIGMA = 0.2


def toy(alpha: np.ndarray, load: np.ndarray, fell: np.ndarray, base: np.ndarray) -> Evidence:
    """Return the evidence of a block that falls where load exp(SIGMA z) > alpha."""
    share = 0.96 * stats.norm.cdf((np.log(load) - np.log(alpha)[:, None]) / SIGMA) + 0.02
    logs = np.log(np.where(fell > 0, share, 1 - share))
    return Evidence(base=base, log_likelihood=logs, share=share, tests=np.arange(len(load)))


@pytest.fixture
def problem() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    rng = np.random.default_rng(4)
    load = 0.25 * np.exp(0.4 * rng.normal(size=24))
    fell = (load * np.exp(SIGMA * rng.normal(size=24)) > 0.25).astype(float)
    return load, fell, np.arange(24) % 6


@pytest.mark.parametrize("temper", [1.0, 0.3])
def test_predictions_without_a_group_are_those_of_a_grid(
    problem: tuple[np.ndarray, np.ndarray, np.ndarray], temper: float
) -> None:
    """Draws from an unlike density, with weights, against a sum over a fine grid of alpha."""
    load, fell, codes = problem
    rng = np.random.default_rng(5)
    # The prior is uniform in [.15, .35]; the draws come from a triangle there.
    alpha = rng.triangular(0.15, 0.24, 0.35, size=40_000)
    density = stats.triang.pdf(alpha, 0.45, 0.15, 0.2)
    held = hold_out([toy(alpha, load, fell, -np.log(density))], codes, temper)
    grid = np.linspace(0.15, 0.35, 4001)
    share = toy(grid, load, fell, np.zeros(len(grid)))
    for test in range(len(load)):
        others = codes != codes[test]
        weight = np.exp(temper * share.log_likelihood[:, others].sum(axis=1))
        expected = (weight * share.share[:, test]).sum() / weight.sum()
        assert held.p[test] == pytest.approx(expected, abs=0.008)
        below = np.cumsum(weight) / weight.sum()
        ends = share.share[[np.searchsorted(below, 0.95), np.searchsorted(below, 0.05)], test]
        assert [held.low[test], held.high[test]] == pytest.approx(ends.tolist(), abs=0.02)


def test_error_is_the_scatter_of_repeated_draws(
    problem: tuple[np.ndarray, np.ndarray, np.ndarray],
) -> None:
    load, fell, codes = problem
    rng = np.random.default_rng(6)
    runs = [
        hold_out([toy(rng.uniform(0.15, 0.35, 400), load, fell, np.zeros(400))], codes, 1.0)
        for _ in range(200)
    ]
    scatter = np.std([run.p for run in runs], axis=0)
    stated = np.mean([run.error for run in runs], axis=0)
    assert stated == pytest.approx(scatter, rel=0.3)


def test_a_single_draw_with_all_the_weight_has_an_unknown_error(
    problem: tuple[np.ndarray, np.ndarray, np.ndarray],
) -> None:
    load, fell, codes = problem
    base = np.full(50, -1e4)
    base[3] = 0.0
    held = hold_out([toy(np.linspace(0.2, 0.3, 50), load, fell, base)], codes, 1.0)
    assert (held.error == 0.5).all()
    assert held.effective == pytest.approx(1.0)


def test_tempers_of_a_group_do_not_depend_on_its_outcomes() -> None:
    """Outcomes that the model cannot explain call for a small temper; one group is never heard."""
    rng = np.random.default_rng(7)
    load = 0.25 * np.exp(0.5 * rng.normal(size=120))
    fell = (rng.random(120) < 0.5).astype(float)
    codes = np.repeat(np.arange(30), 4)
    alpha = rng.uniform(0.15, 0.35, 400)
    first = choose_tempers([toy(alpha, load, fell, np.zeros(400))], codes, fell)
    changed = np.where(codes == 8, 1.0 - fell, fell)
    second = choose_tempers([toy(alpha, load, changed, np.zeros(400))], codes, changed)
    assert first[8] == second[8]
    assert set(first.tolist()) <= set(LADDER)


def test_nested_scores_are_those_of_brute_force() -> None:
    rng = np.random.default_rng(8)
    load = 0.25 * np.exp(0.5 * rng.normal(size=24))
    fell = (rng.random(24) < 0.5).astype(float)
    codes = np.repeat(np.arange(12), 2)
    alpha = rng.uniform(0.15, 0.35, 300)
    evidence = toy(alpha, load, fell, np.zeros(300))
    tempers = choose_tempers([evidence], codes, fell)
    nested = _nested_scores(evidence, codes, np.arange(12), fell, LADDER)
    for group in range(12):
        scores = np.zeros((len(LADDER), 11))
        for row, temper in enumerate(LADDER):
            for place, fold in enumerate(np.delete(np.arange(12), group)):
                kept = (codes != group) & (codes != fold)
                weight = np.exp(temper * evidence.log_likelihood[:, kept].sum(axis=1))
                p = weight @ evidence.share / weight.sum()
                held = codes == fold
                scores[row, place] = np.log(np.where(fell > 0, p, 1 - p)[held]).sum()
        assert np.delete(nested[:, :, group], group, axis=1) == pytest.approx(scores)
        lost = scores[scores.sum(axis=1).argmax()] - scores
        error = lost.std(axis=1, ddof=1) * np.sqrt(11)
        row = int(np.argmax(lost.sum(axis=1) <= error + 1e-9))
        clearly = lost[0].sum() > 2.0 * error[0]
        assert tempers[group] == (LADDER[row] if clearly else 1.0)


def test_a_temper_below_one_takes_a_clear_gain() -> None:
    rng = np.random.default_rng(9)
    noise = rng.normal(size=(3, 40))
    noise -= noise.mean(axis=1, keepdims=True)
    slight = np.array([[0.0], [0.1], [0.05]])  # better, but not by the error of 40 folds
    assert preferred(noise + slight) == 0
    assert preferred(0.3 * noise + np.array([[0.0], [3.0], [0.0]])) == 1
    assert preferred(np.array([[0.0] * 5, [9.0] * 5])) == 0  # five folds say too little


def test_weighted_quantiles_are_those_of_repeated_values() -> None:
    values = np.array([[3.0], [1.0], [2.0]])
    weights = np.array([[0.2], [0.5], [0.3]])
    found = weighted_quantiles(values, weights, (0.05, 0.5, 0.75, 0.95))
    assert found[:, 0].tolist() == [1.0, 1.0, 2.0, 3.0]
    assert effective(np.array([0.5, 0.5, 0.0])) == 2.0


def test_the_error_of_a_mean_needs_two_draws() -> None:
    weights = np.array([[0.5, 1.0], [0.5, 0.0]])
    share = np.array([[0.2, 0.2], [0.4, 0.4]])
    found = predict_with(weights, share, ends=False)
    assert found["p"] == pytest.approx([0.3, 0.2])
    assert found["effective"] == pytest.approx([2.0, 1.0])
    # Two draws 0.1 from their mean: the standard deviation 0.1 sqrt(2), over sqrt(2).
    assert found["error"] == pytest.approx([0.1, 0.5])
