"""The bands of families: against closed forms, the search for orbits, and settled motions."""

import numpy as np
import pytest

from rocksteady import (
    DimensionlessBlock,
    Harmonic,
    PointType,
    Steady,
    attractor,
    boundaries,
    orbits,
    steady_states,
    symmetry_breaking_amplitude,
)
from rocksteady.studies.atlas.families import column
from rocksteady.studies.atlas.findings import bands_at
from tests.studies.atlas.small import small

BLOCK = DimensionlessBlock(restitution=0.8)


@pytest.mark.parametrize(("order", "ratio"), [(1, 2.0), (1, 3.0), (3, 4.0), (5, 8.0)])
@pytest.mark.parametrize("restitution", [0.5, 0.8, 0.95])
def test_a_column_begins_and_breaks_where_the_closed_forms_say(
    order: int, ratio: float, restitution: float
) -> None:
    bands = column(restitution, ratio, 8.0, order)
    assert bands.lowest == boundaries(ratio, restitution, order=order).existence
    breaking = float(symmetry_breaking_amplitude(ratio, restitution, order=order))
    assert bands.borders[0] == pytest.approx(min(breaking, 8.0), rel=1e-12)
    assert list(bands.borders) == sorted(bands.borders)
    assert bands.limit >= bands.borders[-1]


def test_a_cascade_shrinks_and_ends_shortly_after_its_third_doubling() -> None:
    bands = column(0.8, 2.0, 8.0, 1)
    types = [point.type for point in bands.points if point is not None]
    assert types == [PointType.SYMMETRY_BREAKING, *[PointType.PERIOD_DOUBLING] * 3]
    steps = np.diff(bands.borders[1:])
    assert 3.5 < steps[0] / steps[1] < 9.0
    assert 0.0 < bands.limit - bands.borders[-1] < steps[1]


def test_beyond_the_window_a_column_ends_at_its_top() -> None:
    bands = column(0.8, 6.0, 8.0, 1)
    assert bands.borders == (8.0,)
    assert bands.points == (None,)
    assert bands.band(1) == (8.0, 8.0)


def test_above_the_window_there_is_no_column() -> None:
    bands = column(0.8, 12.0, 1.0, 3)
    assert np.isnan(bands.lowest)
    assert bands.borders == ()
    assert np.isnan(bands.limit)


def test_at_low_frequencies_a_band_thinner_than_rounding_is_not_followed() -> None:
    bands = column(0.8, 0.6, 8.0, 3)
    assert bands.points == (None,)
    assert not bands.followed
    assert bands.borders[0] == pytest.approx(bands.lowest, rel=1e-6)
    found = bands_at(bands, 3)
    assert found.ends_with == "not-followed"
    assert found.symmetric_until == bands.borders[0]
    assert np.isnan(found.leaning_until)


def test_a_thin_band_is_followed_whatever_the_height_of_the_plane() -> None:
    # n = 3 at Omega 1.5: symmetric motions between 0.353583 and 0.353932 alone.
    low, high = column(0.8, 1.5, 8.0, 3), column(0.8, 1.5, 80.0, 3)
    assert len(low.borders) == 4
    assert low.borders == pytest.approx(high.borders, rel=1e-12)
    assert low.limit == pytest.approx(0.35404018, abs=3e-7)


def test_a_graze_ends_the_leaning_motions_of_the_third_at_high_frequency() -> None:
    bands = column(0.8, 7.0, 8.0, 3)
    last = bands.points[-1]
    assert last is not None
    assert last.type is PointType.GRAZING
    assert bands.borders[-1] == pytest.approx(5.17067, abs=1e-5)
    assert bands.limit == bands.borders[-1]


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


def test_the_symmetric_area_is_that_of_the_closed_form_in_the_whole_window() -> None:
    for family in small().families:
        left, right, low, high = family.plane.window
        ratios = left + (right - left) * (np.arange(600) + 0.5) / 600
        amplitudes = low + (high - low) * (np.arange(400) + 0.5) / 400
        states = steady_states(amplitudes[:, np.newaxis], ratios, 0.8, order=family.order)
        assert family.area(0) == pytest.approx(float(states.stable[0].mean()), abs=3e-3)


@pytest.mark.slow
def test_bands_agree_with_the_search_for_orbits_at_random_points() -> None:
    # The search knows nothing of continuation; it is told apart by impacts and period.
    rng = np.random.default_rng(20)
    seen = {"symmetric": 0, "leaning": 0, "doubled": 0, "nothing": 0}
    for _ in range(110):
        order = int(rng.choice([1, 1, 3]))
        ratio = float(rng.uniform(1.5, 3.2) if order == 1 else rng.uniform(2.5, 5.4))
        bands = column(0.8, ratio, 8.0, order)
        edges = [*(bands.band(level)[0] for level in range(3)), bands.band(2)[1]]
        which = int(rng.integers(0, 4))
        low, high = (edges[3] * 1.01, edges[3] * 1.2) if which == 3 else edges[which : which + 2]
        amplitude = float(rng.uniform(low + 0.02 * (high - low), high - 0.02 * (high - low)))
        name = [*seen][which]
        seen[name] += 1
        shaking = Harmonic(amplitude=amplitude, frequency_ratio=ratio)
        found = attractor(BLOCK, shaking, start=Steady(order=order, kick=1e-3))
        if which < 3:
            expected = (order * (2 if which == 2 else 1), 4 if which == 2 else 2, which == 0)
            match = (
                found.orbit is not None
                and (found.orbit.period, found.orbit.impacts, found.orbit.symmetric) == expected
            )
            if not match:  # the kick led elsewhere: is the orbit there all the same?
                several = orbits(
                    BLOCK, shaking, max_period=expected[0], max_impacts=expected[1], seeds=160
                )
                match = any(
                    (orbit.period, orbit.impacts, orbit.symmetric) == expected and orbit.stable
                    for orbit in several
                )
            assert match, (order, ratio, amplitude, name)
        else:
            several = orbits(BLOCK, shaking, max_period=order, max_impacts=2, seeds=32)
            assert not any(
                orbit.stable for orbit in several if (orbit.period, orbit.impacts) == (order, 2)
            ), (order, ratio, amplitude)
    assert min(seen.values()) >= 15


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


def test_no_border_lies_above_the_plane() -> None:
    # Here the leaning band ends within 2 % above the top.
    bands = column(0.8, 3.245, 8.04, 1)
    assert bands.borders[0] < bands.borders[1] == 8.04
    assert len(bands.borders) == 2
