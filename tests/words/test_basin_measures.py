"""Words of measures of basins."""

import pytest

from rocksteady.basins import check_boundary
from tests.dynamics.basins.measures.labelled_sets import disc


def test_what_a_smooth_boundary_would_have_is_told() -> None:
    found = check_boundary(disc(300), 8, seed=5)
    told = {fact.label: fact.words for fact in found.describe().facts}["smooth boundaries"]
    low, high = map(float, told.split(" to "))
    assert low == pytest.approx(found.smooth_entropy - found.standard_error, abs=6e-5)
    assert high == pytest.approx(found.smooth_entropy + found.standard_error + found.bias, abs=6e-5)


def test_a_coarse_window_is_said() -> None:
    found = check_boundary(disc(200), 20)
    assert not found.fine
    assert "narrower than 50 radii" in found.summary()
