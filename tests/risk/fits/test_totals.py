"""Failures and trials by level: what is joined, and what is left out."""

import numpy as np

from rocksteady.risk.fits._totals import totals_of
from tests.every import every


def test_levels_have_the_sums_of_their_observations_and_none_without_a_trial() -> None:
    found = totals_of([2.0, 1.0, 2.0, 3.0, 1.0], [1, 0, 5, 0, 0], [4, 3, 5, 0, 2])
    assert [part.tolist() for part in found] == [[1.0, 2.0], [0.0, 6.0], [5.0, 9.0]]
    alone = totals_of([2.0, 1.0, 2.0], [1, 0, 0], None)
    assert [part.tolist() for part in alone] == [[1.0, 2.0], [0.0, 1.0], [1.0, 2.0]]


@every(("part", "count"), [(1e-13, 1), (0.9e-12, 1), (1.2e-12, 2), (1e-11, 2)])
def test_levels_are_one_up_to_a_rounding_apart(part: float, count: int) -> None:
    found = totals_of(np.array([1.0, 1.0 + part, 5.0]), [0, 1, 1], None)
    assert len(found.levels) == count + 1
    assert found.levels[0] == 1.0
    assert found.trials[0] == (2.0 if count == 1 else 1.0)
