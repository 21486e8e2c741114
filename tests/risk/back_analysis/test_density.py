"""Densities, regions and quantiles against sums of normal distributions."""

import math

import numpy as np
import pytest
from scipy import stats

from rocksteady.risk.back_analysis._density import Plane, level_of, tempered

NODES = np.linspace(-2.0, 1.0, 91)
RATIOS = np.stack([np.zeros(8), np.linspace(-0.5, 0.8, 8)], axis=1)
PLANE = Plane(nodes=NODES, ratios=RATIOS)
ACROSS = 0.6 * RATIOS[:, 1].std() * 8**-0.2


def weights(seed: int = 0) -> np.ndarray:
    made = np.random.default_rng(seed).random((8, 91)) ** 8
    made[:, :15] = made[:, -15:] = 0.0
    return np.asarray(made / made.sum())


def test_the_kernel_across_records_follows_their_spread() -> None:
    assert PLANE.across == pytest.approx([0.0, ACROSS])
    alike = Plane(nodes=NODES, ratios=np.stack([np.zeros(8), np.full(8, 0.3)], axis=1))
    assert alike.across.tolist() == [0.0, 0.05]
    assert len(PLANE.ordinates) == 64
    assert PLANE.ordinates[[0, -1]] == pytest.approx([-0.5 - 3 * ACROSS, 0.8 + 3 * ACROSS])
    step = (1.3 + 6 * ACROSS) / 63
    assert PLANE.cell == pytest.approx(step / 30.0)


def test_masses_are_normal_densities_about_records_and_nodes() -> None:
    one = np.zeros((8, 91))
    one[3, 40] = 1.0
    masses = PLANE.masses(one)
    assert masses.shape == (91, 64)
    assert masses.sum() == pytest.approx(1.0)
    along = stats.norm.pdf(NODES, NODES[40], 0.1)
    across = stats.norm.pdf(PLANE.ordinates, RATIOS[3, 1], ACROSS)
    expected = np.outer(along / along.sum(), across / across.sum())
    assert masses == pytest.approx(expected, abs=1e-12)
    several = np.stack([weights(), weights(1)])
    assert PLANE.masses(several)[1] == pytest.approx(PLANE.masses(several[1]))


@pytest.mark.parametrize("measure", [0, 1])
def test_quantiles_are_those_of_the_distribution(measure: int) -> None:
    """Of a sum of normal distributions of the width of both kernels together."""
    shares = np.array([0.05, 0.3, 0.5, 0.95])
    given = weights()
    values = np.log(PLANE.quantiles(given, measure, shares))
    found = PLANE.distribution(given[np.newaxis], measure, values[np.newaxis])[0]
    assert found == pytest.approx(shares, abs=2e-3)
    width = math.hypot(0.1, ACROSS if measure else 0.0)
    at = NODES + RATIOS[:, [measure]]
    by_hand = [(given * stats.norm.cdf((x - at) / width)).sum() for x in values]
    assert found == pytest.approx(by_hand, rel=1e-12)


def test_a_mean_is_taken_over_records_of_like_ratio() -> None:
    values = np.random.default_rng(2).random((8, 91))
    found = PLANE.local_mean(values)
    assert found.shape == (91, 64)
    near = stats.norm.pdf(PLANE.ordinates[20], RATIOS[:, 1], ACROSS)
    assert found[:, 20] == pytest.approx(near @ values / near.sum())
    assert PLANE.local_mean(np.full((8, 91), 0.3)) == pytest.approx(np.full((91, 64), 0.3))


def test_a_region_is_of_the_likeliest_cells_until_they_have_the_share() -> None:
    values = np.array([[4.0, 1.0], [3.0, 2.0]])
    for share, level in ((0.1, 4.0), (0.4, 4.0), (0.41, 3.0), (0.7, 3.0), (0.95, 1.0), (1.0, 1.0)):
        assert level_of(values, share) == level


def test_tempered_weights_add_both_signs_and_have_the_sum_one() -> None:
    logs = np.random.default_rng(3).normal(-800.0, 3.0, (2, 2, 8, 91))
    found = tempered(logs, 0.35)
    assert found.shape == (2, 8, 91)
    assert found.sum(axis=(1, 2)) == pytest.approx([1.0, 1.0])
    shifted = np.exp(0.35 * (logs + 800.0)).sum(axis=1)
    assert found == pytest.approx(shifted / shifted.sum(axis=(1, 2), keepdims=True))
