"""Stripes: which levels are joined, and where a joined stripe stands."""

import math

import numpy as np
import pytest

from rocksteady.risk.fits._stripes import compare_stripes, stripe_table
from rocksteady.risk.fits._trial_counts import Counts, counts_of
from tests.every import every


def counts(levels: list[float], failures: list[int], trials: list[int]) -> Counts:
    given = (("trials", trials), ("failures", failures))
    return counts_of(np.array(levels, dtype=float), given, None)[0]


def test_levels_of_ten_trials_on_average_are_stripes_and_of_fewer_are_joined() -> None:
    levels = list(np.geomspace(1.0, 8.0, 4))
    for trials, rows in (([10, 10, 10, 10], 4), ([1, 1, 19, 19], 4), ([10, 10, 10, 9], 3)):
        found, _ = compare_stripes(counts(levels, [0, 1, 2, 3], trials), np.full(4, 0.5))
        assert len(found) == rows, trials
        assert sum(row[1] for row in found) == sum(trials)
        assert sum(row[2] for row in found) == 6


@every(("trials", "rows"), [(1, 1), (9, 1), (19, 1), (20, 2), (99, 9), (100, 10), (2000, 10)])
def test_scattered_trials_are_joined_ten_at_least_to_ten_stripes_at_most(
    trials: int, rows: int
) -> None:
    levels = np.geomspace(0.1, 10.0, trials)
    made = counts(levels.tolist(), [0] * trials, [1] * trials)
    found, misfit = compare_stripes(made, np.zeros(trials))
    sizes = [row[1] for row in found]
    assert len(sizes) == rows
    assert max(sizes) - min(sizes) <= 1
    assert misfit == 0.0
    assert [row[0] for row in found] == sorted(row[0] for row in found)


def test_a_joined_stripe_is_at_the_mean_logarithm_with_the_mean_probability() -> None:
    """By hand: 2, 1 and 1 trials at 1, 4 and 16 have a mean of ln of 1.5 ln 2."""
    made = counts([1.0, 4.0, 16.0], [0, 1, 1], [2, 1, 1])
    ((at, trials, failures, curve),), misfit = compare_stripes(made, np.array([0.1, 0.5, 0.9]))
    assert at == pytest.approx(2.0**1.5)
    assert (trials, failures) == (4, 2)
    assert curve == pytest.approx(0.4)
    assert misfit == pytest.approx(0.1)
    (row,) = stripe_table([(at, trials, failures, curve)]).rows
    assert row["share"] == 0.5
    unknown, misfit = compare_stripes(made, np.full(3, math.nan))
    assert unknown[0][3] is None
    assert math.isnan(misfit)


def test_without_trials_there_are_no_stripes() -> None:
    made = counts([1.0], [0], [1])
    empty = Counts(
        levels=made.levels[:0],
        failures=made.failures[:, :0],
        trials=made.trials[:, :0],
        multiplicity=made.multiplicity,
    )
    rows, misfit = compare_stripes(empty, np.empty(0))
    assert rows == ()
    assert math.isnan(misfit)
