"""The bands of families over the plane: against closed forms, and the search from many starts."""

import numpy as np
import pytest

from rocksteady.formulas import steady_states
from rocksteady.studies.atlas.analysis.columns import column
from rocksteady.studies.atlas.analysis.families import family_map
from tests.studies.atlas.small import plane, small


@pytest.mark.slow
def test_a_family_has_each_column_of_the_plane_in_its_order() -> None:
    said: list[str] = []
    family = family_map(plane(), 3, done=said.append)
    assert said == ["columns, n = 3"] * len(plane().ratios)
    assert [each.frequency_ratio for each in family.columns] == plane().ratios.tolist()
    for each in family.columns[::7]:
        expected = column(0.8, each.frequency_ratio, plane().top, 3)
        np.testing.assert_equal(vars(each), vars(expected))


def test_symmetric_bands_hold_what_the_closed_form_calls_stable() -> None:
    for family in small().families:
        plane = family.plane
        amplitude = plane.amplitudes[:, np.newaxis]
        states = steady_states(amplitude, plane.ratios, 0.8, order=family.order)
        inside = (amplitude > family.edges[0]) & (amplitude < family.edges[1])
        np.testing.assert_array_equal(inside, states.stable[0])


def test_areas_are_parts_of_the_window() -> None:
    for family in small().families:
        areas = [family.area(band) for band in range(3)]
        assert min(areas) > 0.0
        assert sum(areas) < 1.0


@pytest.mark.slow
def test_the_symmetric_area_is_that_of_the_closed_form_in_the_whole_window() -> None:
    for family in small().families:
        left, right, low, high = family.plane.window
        ratios = left + (right - left) * (np.arange(600) + 0.5) / 600
        amplitudes = low + (high - low) * (np.arange(400) + 0.5) / 400
        states = steady_states(amplitudes[:, np.newaxis], ratios, 0.8, order=family.order)
        assert family.area(0) == pytest.approx(float(states.stable[0].mean()), abs=3e-3)


def test_the_cells_of_the_search_lie_in_the_bands() -> None:
    found = small().found
    for family in small().families:
        own = found.having(
            lambda kind, n=family.order: (kind.period, kind.impacts) == (n, 2)  # type: ignore[misc]
        )
        stable = family.stable(family.plane.amplitudes)
        undoubled = stable & (family.plane.amplitudes[:, np.newaxis] < family.edges[2])
        assert not (own & ~stable).any()
        assert (own & undoubled).sum() >= 0.95 * undoubled.sum()
