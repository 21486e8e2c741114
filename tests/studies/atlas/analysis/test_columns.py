"""The bands at one frequency: against closed forms, the search for orbits, and settled motions."""

import numpy as np
import pytest

from rocksteady import DimensionlessBlock, Execution, Harmonic, Steady, find_attractor, find_orbits
from rocksteady.branches import PointType
from rocksteady.formulas import symmetry_breaking_amplitude
from rocksteady.orbits import compute_region_boundaries
from rocksteady.studies.atlas.analysis.columns import column, columns, followed
from rocksteady.studies.atlas.analysis.plane import Plane
from tests.every import every

BLOCK = DimensionlessBlock(restitution=0.8)


@pytest.mark.slow
@every(("order", "ratio"), [(1, 2.0), (1, 3.0), (3, 4.0), (5, 8.0)])
@every("restitution", [0.5, 0.8, 0.95])
def test_a_column_begins_and_breaks_where_the_closed_forms_say(
    order: int, ratio: float, restitution: float
) -> None:
    bands = column(restitution, ratio, 8.0, order)
    assert bands.lowest == compute_region_boundaries(ratio, restitution, order=order).existence
    breaking = float(symmetry_breaking_amplitude(ratio, restitution, order=order))
    assert bands.borders[0] == pytest.approx(min(breaking, 8.0), rel=1e-12)
    assert list(bands.borders) == sorted(bands.borders)
    assert bands.limit >= bands.borders[-1]


def test_a_cascade_shrinks_and_ends_shortly_after_its_third_doubling() -> None:
    bands = column(0.8, 2.0, 8.0, 1)
    assert list(bands.ends) == [PointType.SYMMETRY_BREAKING, *[PointType.PERIOD_DOUBLING] * 3]
    steps = np.diff(bands.borders[1:])
    assert 3.5 < steps[0] / steps[1] < 9.0
    assert 0.0 < bands.limit - bands.borders[-1] < steps[1]


def test_beyond_the_window_a_column_ends_at_its_top() -> None:
    bands = column(0.8, 6.0, 8.0, 1)
    assert bands.borders == (8.0,)
    assert bands.ends == (None,)
    assert bands.band(1) == (8.0, 8.0)


def test_above_the_window_there_is_no_column() -> None:
    bands = column(0.8, 12.0, 1.0, 3)
    assert np.isnan(bands.lowest)
    assert bands.borders == ()
    assert np.isnan(bands.limit)


def test_at_low_frequencies_a_band_thinner_than_rounding_is_not_followed() -> None:
    bands = column(0.8, 0.6, 8.0, 3)
    assert bands.ends == (None,)
    assert not bands.followed
    assert bands.borders[0] == pytest.approx(bands.lowest, rel=1e-6)


def test_a_thin_band_is_followed_whatever_the_height_of_the_plane() -> None:
    # n = 3 at Omega 1.5: symmetric motions between 0.353583 and 0.353932 alone.
    low, high = column(0.8, 1.5, 8.0, 3), column(0.8, 1.5, 80.0, 3)
    assert len(low.borders) == 4
    assert low.borders == pytest.approx(high.borders, rel=1e-12)
    assert low.limit == pytest.approx(0.35404018, abs=3e-7)


def test_a_graze_ends_the_unsymmetric_motions_of_the_third_at_high_frequency() -> None:
    bands = column(0.8, 7.0, 8.0, 3)
    assert bands.ends[-1] is PointType.GRAZING
    assert bands.borders[-1] == pytest.approx(5.17067, abs=1e-5)
    assert bands.limit == bands.borders[-1]


def test_no_border_lies_above_the_plane() -> None:
    # Here the unsymmetric band ends within 2 % above the top.
    bands = column(0.8, 3.245, 8.04, 1)
    assert bands.borders[0] < bands.borders[1] == 8.04
    assert len(bands.borders) == 2


@pytest.mark.slow
def test_bands_agree_with_the_search_for_orbits_at_random_points() -> None:
    # The search knows nothing of continuation; it is told apart by impacts and period.
    rng = np.random.default_rng(20)
    seen = {"symmetric": 0, "unsymmetric": 0, "doubled": 0, "nothing": 0}
    for _ in range(40):
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
        found = find_attractor(BLOCK, shaking, start=Steady(order=order, kick=1e-3))
        if which < 3:
            expected = (order * (2 if which == 2 else 1), 4 if which == 2 else 2, which == 0)
            match = (
                found.orbit is not None
                and (found.orbit.period, found.orbit.impacts, found.orbit.symmetric) == expected
            )
            if not match:  # the kick led elsewhere: is the orbit there all the same?
                several = find_orbits(
                    BLOCK, shaking, max_period=expected[0], max_impacts=expected[1], seeds=160
                )
                match = any(
                    (orbit.period, orbit.impacts, orbit.symmetric) == expected and orbit.stable
                    for orbit in several
                )
            assert match, (order, ratio, amplitude, name)
        else:
            several = find_orbits(BLOCK, shaking, max_period=order, max_impacts=2, seeds=32)
            assert not any(
                orbit.stable for orbit in several if (orbit.period, orbit.impacts) == (order, 2)
            ), (order, ratio, amplitude)
    assert min(seen.values()) >= 5


@pytest.mark.slow
@pytest.mark.parametrize(
    ("top", "ratios"),
    # Too thin to be followed, with cascades, with a graze, and beyond the top; none at all.
    [(7.2, [0.6, 2.0, 4.0, 6.0, 7.0, 9.0]), (0.9, [1.5, 12.0])],
)
def test_columns_of_a_sweep_are_those_of_single_calls(top: float, ratios: list[float]) -> None:
    rows = np.array([0.125, 0.375, 0.625, 0.875]) * top
    plane = Plane(restitution=0.8, amplitude=rows, frequency_ratio=[1.0, 2.0, 3.0])
    assert plane.top == pytest.approx(top)
    found = columns(plane, 3, ratios, run=Execution(workers=2))
    for each, ratio in zip(found, ratios, strict=True):
        np.testing.assert_equal(vars(each), vars(column(0.8, ratio, plane.top, 3)))
    if top > 1.0:
        assert [each.followed for each in found] == [False, *[True] * 5]
        ends = {end for each in found for end in each.ends}
        assert {None, PointType.PERIOD_DOUBLING, PointType.GRAZING} <= ends
    else:
        assert found[0].ends
        assert not found[1].ends
        assert np.isnan(found[1].lowest)


def test_the_bifurcations_of_a_column_lie_on_its_borders() -> None:
    for ratio, order in ((2.0, 1), (7.0, 3), (6.0, 1)):
        bands = column(0.8, ratio, 8.0, order)
        lowest, points = followed(0.8, ratio, 8.0, order)
        assert lowest == bands.lowest
        assert tuple(point and point.type for point in points) == bands.ends
        for point, border in zip(points, bands.borders, strict=True):
            assert border == (8.0 if point is None else point.amplitude)
