"""Stripes: which levels are joined, and where a joined stripe stands."""

import math

import numpy as np
import pytest

from rocksteady.risk.fits._stripes import compare_stripes
from rocksteady.risk.fits._totals import totals_of
from tests.every import every


def test_levels_of_ten_trials_on_average_are_stripes_and_of_fewer_are_joined() -> None:
    levels = list(np.geomspace(1.0, 8.0, 4))
    for trials, rows in (([10, 10, 10, 10], 4), ([1, 1, 19, 19], 4), ([10, 10, 10, 9], 3)):
        found, _ = compare_stripes(totals_of(levels, [0, 1, 2, 3], trials), np.full(4, 0.5))
        assert len(found) == rows, trials
        assert sum(row[1] for row in found) == sum(trials)
        assert sum(row[2] for row in found) == 6


@every(("trials", "rows"), [(1, 1), (9, 1), (19, 1), (20, 2), (99, 9), (100, 10), (2000, 10)])
def test_scattered_trials_are_joined_ten_at_least_to_ten_stripes_at_most(
    trials: int, rows: int
) -> None:
    levels = np.geomspace(0.1, 10.0, trials)
    made = totals_of(levels, [0] * trials, [1] * trials)
    found, misfit = compare_stripes(made, np.zeros(trials))
    sizes = [row[1] for row in found]
    assert len(sizes) == rows
    assert max(sizes) - min(sizes) <= 1
    assert misfit == 0.0
    assert [row[0] for row in found] == sorted(row[0] for row in found)


def test_a_joined_stripe_is_at_the_mean_logarithm_with_the_mean_probability() -> None:
    """By hand: 2, 1 and 1 trials at 2, 8 and 32 have a mean of ln of 2.5 ln 2."""
    made = totals_of([2.0, 8.0, 32.0], [0, 1, 1], [2, 1, 1])
    ((at, trials, failures, curve),), misfit = compare_stripes(made, np.array([0.1, 0.5, 0.9]))
    assert at == pytest.approx(2.0**2.5)
    assert (trials, failures) == (4, 2)
    assert curve == pytest.approx(0.4)
    assert misfit == pytest.approx(0.1)
    unknown, misfit = compare_stripes(made, np.full(3, math.nan))
    assert unknown[0][3] is None
    assert math.isnan(misfit)
