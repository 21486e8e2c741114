"""Test of smooth boundaries: its table, boundaries known to be smooth and fractal, errors."""

from typing import Any

import numpy as np
import pytest

from rocksteady.basins import check_boundary
from rocksteady.dynamics.basins.measures.boundary import smooth_entropy
from rocksteady.errors import InputError, ModelError
from tests.dynamics.basins.measures.labelled_sets import cantor, disc, newton, tilted_plane
from tests.every import every

TABLE = (0.499999, 0.4395093, 0.39609176, 0.36319428, 0.33722572)
"""Puy et al. 2021, of one to five dimensions."""


def test_a_smooth_boundary_has_the_published_entropy() -> None:
    found = [smooth_entropy(dimensions) for dimensions in range(1, 6)]
    assert found == pytest.approx(TABLE, abs=2e-6)


@pytest.mark.parametrize("labels", [tilted_plane(500), disc(500)])
def test_smooth_boundaries_are_smooth(labels: Any) -> None:
    found = check_boundary(labels, 8, seed=1)
    assert found.verdict == "smooth"
    assert found.fine


@every(
    "labels",
    [
        newton(500),
        np.broadcast_to(cantor(6)[:500], (500, 500)),
        np.random.default_rng(2).integers(0, 2, (500, 500)),
    ],
)
def test_fractal_boundaries_are_not(labels: Any) -> None:
    assert check_boundary(labels, 8, seed=1).verdict == "fractal"


def test_the_entropy_of_balls_on_a_line_is_that_of_every_cut() -> None:
    found = check_boundary(np.arange(2000) > 1200, 10, balls=4000)
    share = np.arange(1, 20) / 20.0  # a ball holds 20 states, and the boundary cuts it anywhere
    exact = -(share * np.log(share) + (1.0 - share) * np.log(1.0 - share)).mean()
    assert found.boundary_entropy == pytest.approx(exact, abs=4.0 * found.standard_error)
    assert found.smooth_entropy == pytest.approx(0.5, abs=1e-9)


def test_a_seed_gives_the_same_twice() -> None:
    one, other = (check_boundary(disc(300), 8, seed=5) for _ in range(2))
    assert one == other
    assert one != check_boundary(disc(300), 8, seed=6)


def test_what_cannot_be_tested_is_refused() -> None:
    with pytest.raises(ModelError, match="boundary in 0 of"):
        check_boundary(np.zeros((60, 60), dtype=np.int64), 8)
    with pytest.raises(InputError, match="ball = 20"):
        check_boundary(disc(20), 20)
    with pytest.raises(InputError, match="balls"):
        check_boundary(disc(200), 8, balls=20)
