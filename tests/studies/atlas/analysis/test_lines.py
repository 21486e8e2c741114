"""The borders in two parameters: against closed forms, and through the columns that began them."""

import numpy as np
import pytest

from rocksteady.formulas import symmetry_breaking_amplitude
from rocksteady.orbits import compute_region_boundaries
from rocksteady.studies.atlas.analysis.columns import column
from tests.every import every
from tests.studies.atlas.small import small


def test_the_continued_symmetry_breaking_is_the_closed_form() -> None:
    lines = [line for line in small().lines if line.name == "symmetry-breaking"]
    assert {line.order for line in lines} == {1, 3, 5}
    for line in lines:
        expected = symmetry_breaking_amplitude(line.frequency_ratio, 0.8, order=line.order)
        np.testing.assert_allclose(line.amplitude, expected, rtol=1e-9)


def test_the_existence_boundary_is_that_of_the_paper() -> None:
    for line in small().lines:
        if line.name == "existence":
            expected = compute_region_boundaries(
                line.frequency_ratio, 0.8, order=line.order
            ).existence
            np.testing.assert_array_equal(line.amplitude, expected)


@every("order", [1, 3, 5])
def test_lines_run_through_columns_that_did_not_begin_them(order: int) -> None:
    lines = {line.name: line for line in small().lines if line.order == order}
    for name, level in (("first-doubling", 1), ("second-doubling", 2)):
        line = lines[name]
        ratio = 0.41 * float(line.frequency_ratio.min()) + 0.59 * float(line.frequency_ratio.max())
        bands = column(0.8, ratio, 8.04, order)
        assert line.amplitude_at(ratio) == pytest.approx(bands.borders[level], abs=2e-3)


def test_the_first_doubling_of_the_third_ends_in_a_graze() -> None:
    (line,) = (x for x in small().lines if (x.order, x.name) == (3, "first-doubling"))
    assert "doubling-graze" in line.ends
    place = line.ends.index("doubling-graze") - 1
    assert line.frequency_ratio[-1 if place == 0 else 0] == pytest.approx(5.6875, abs=1e-4)


def test_beyond_its_ends_a_line_has_no_amplitude() -> None:
    line = small().lines[0]
    assert np.isnan(line.amplitude_at(0.01))
    assert np.isnan(line.amplitude_at(100.0))


def test_each_border_is_followed_once() -> None:
    names = [(line.order, line.name) for line in small().lines if line.name != "graze"]
    assert len(names) == len(set(names))
