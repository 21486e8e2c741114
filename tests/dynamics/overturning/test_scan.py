"""The search along the amplitude, on fates that are known: parabolas, combs and needles."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.dynamics.overturning.scan import Fates, Found, first_grid, scan
from tests.every import every

Floats = NDArray[np.float64]


def fates_of(margin: Callable[[Floats], Floats]) -> Callable[[Floats], Fates]:
    """What a block would do whose margin is this function, always without an impact."""

    def follow(amplitude: Floats) -> Fates:
        values = margin(amplitude)
        none = np.zeros(len(values), dtype=np.int64)
        falls = values > 0.0
        return Fates(
            falls, np.ones(len(values), np.bool_), none, falls.astype(np.int64), none, values
        )

    return follow


def ends(found: Found) -> list[tuple[float, float]]:
    return list(zip(found.low.tolist(), found.high.tolist(), strict=True))


def test_a_window_far_narrower_than_the_grid_is_found_by_its_hump() -> None:
    found = scan(fates_of(lambda a: 1e-10 - (a - 3.14159) ** 2), 1.0, 20.0, 0.05)
    ((low, high),) = ends(found)
    assert low == pytest.approx(3.14158, abs=1e-12)
    assert high == pytest.approx(3.14160, abs=1e-12)
    assert found.tried < 1500


@every("closest", [1e-6, 1e-9, 1e-12])
def test_borders_are_brought_as_close_together_as_wanted_and_no_closer(closest: float) -> None:
    follow = fates_of(lambda a: np.sin(40.0 * a) - 0.5)
    exact, found = (scan(follow, 1.0, 5.0, 0.05, closest=part) for part in (0.0, closest))
    assert len(found.low) == len(exact.low) > 20
    assert found.low == pytest.approx(exact.low, rel=closest)
    assert found.high == pytest.approx(exact.high, rel=closest)
    assert found.tried < exact.tried
    apart = np.abs(found.low[1:] - exact.low[1:]) / exact.low[1:]
    assert apart.max() > 1e-3 * closest


def test_a_gap_far_narrower_than_the_grid_is_found_by_its_dip() -> None:
    found = scan(fates_of(lambda a: (a - 7.7) ** 2 - 1e-8), 1.0, 20.0, 0.05)
    (first, second) = ends(found)
    assert first == pytest.approx((1.0, 7.6999), abs=1e-11)
    assert second == pytest.approx((7.7001, 20.0), abs=1e-11)


def test_a_comb_finer_than_the_grid_is_found_by_its_slopes() -> None:
    # Windows of a third of a period, some of them between neighbours of the first grid.
    found = scan(fates_of(lambda a: np.sin(40.0 * a) - 0.5), 1.0, 5.0, 0.05)
    a = np.linspace(1.0, 5.0, 1_000_001)
    rising = np.flatnonzero(np.diff(np.sin(40.0 * a) > 0.5))
    borders = np.array(ends(found)).ravel()
    np.testing.assert_allclose(borders[(borders > 1.0) & (borders < 5.0)], a[rising], atol=1e-5)


def test_windows_that_touch_share_their_border_and_differ_in_their_way() -> None:
    def follow(amplitude: Floats) -> Fates:
        impacts = np.where(amplitude < 2.5, 2, np.where(amplitude < 2.5 + 1e-9, 1, 0))
        falls = amplitude > 2.0
        side = np.where(falls, 1, 0)
        yes = np.ones(len(falls), np.bool_)
        return Fates(falls, yes, impacts, side, impacts, np.where(falls, 1.0, -0.5))

    found = scan(follow, 1.0, 4.0, 0.01)
    assert found.impacts.tolist() == [2, 1, 0]
    assert found.low[0] == pytest.approx(2.0, rel=1e-15)
    assert found.high[:2].tolist() == found.low[1:].tolist()
    assert found.low[1:] == pytest.approx([2.5, 2.5 + 1e-9], rel=1e-15)
    assert found.high[2] == 4.0


def test_where_nothing_falls_there_is_no_window() -> None:
    assert ends(scan(fates_of(lambda a: np.full(len(a), -1.0)), 1.0, 20.0, 0.01)) == []
    assert ends(scan(fates_of(lambda a: -0.5 / a), 1.0, 20.0, 0.01)) == []


def test_a_hump_that_rounding_makes_is_left_alone() -> None:
    rng = np.random.default_rng(2)

    def noisy(a: Floats) -> Floats:
        return -0.5 + 0.1 * a / 20.0 + 1e-9 * rng.random(len(a))

    assert scan(fates_of(noisy), 1.0, 20.0, 0.01).tried < 600


def test_of_very_many_windows_the_search_ends_and_says_so() -> None:
    found = scan(fates_of(lambda a: np.sin(2000.0 * a**3)), 1.0, 3.0, 0.01, keep=5)
    assert len(found.hidden) > 0
    assert found.tried < 20_000
    assert scan(fates_of(lambda a: np.sin(3.0 * a)), 1.0, 3.0, 0.01).hidden.size == 0
    # The ends of the widest are found to rounding all the same.
    for k in np.argsort(found.high - found.low)[-5:].tolist():
        turns = 2000.0 * found.low[k] ** 3 / np.pi
        assert turns == pytest.approx(round(turns), abs=1e-9)


def test_a_rough_search_ends_at_the_borders_of_the_fine_fates() -> None:
    def shifted(by: float) -> Callable[[Floats], Fates]:
        return fates_of(lambda a: 0.3 - np.abs(a - 4.0 - by) * (1.0 + by))

    found = scan(shifted(0.0), 1.0, 20.0, 0.01, rough=shifted(1e-3))
    ((low, high),) = ends(found)
    assert low == pytest.approx(3.7, rel=1e-14)
    assert high == pytest.approx(4.3, rel=1e-14)


@pytest.mark.parametrize("wider", [1e-3, -1e-3])
def test_a_window_that_a_rough_search_takes_for_too_wide_or_narrow_is_found(wider: float) -> None:
    # All that the search tries beside the borders is then on the same side of them.
    def window(half: float) -> Callable[[Floats], Fates]:
        return fates_of(lambda a: half - np.abs(a - 4.0))

    found = scan(window(0.3), 1.0, 20.0, 0.01, rough=window(0.3 + wider))
    ((low, high),) = ends(found)
    assert [low, high] == pytest.approx([3.7, 4.3], rel=1e-14)
    gap = scan(
        fates_of(lambda a: np.abs(a - 4.0) - 0.3),
        1.0,
        20.0,
        0.01,
        rough=fates_of(lambda a: np.abs(a - 4.0) - 0.3 - wider),
    )
    assert ends(gap)[0][1] == pytest.approx(3.7, rel=1e-14)
    assert ends(gap)[1][0] == pytest.approx(4.3, rel=1e-14)


def test_the_grid_is_close_at_every_uplift() -> None:
    grid = first_grid(0.0, 5.0, 0.01, (1.05, 1.4))
    assert (grid[0], grid[1]) == (0.0, 1.05)
    for uplift in (1.05, 1.4):
        above = grid[grid > uplift]
        assert above[0] == pytest.approx(uplift * (1.0 + 1e-6), rel=1e-9)
        assert len(above[above < uplift * 1.0011]) > 40


@every(("low", "high"), [(1.0, 20.0), (0.0, 2.0), (1.5, 1.6), (0.2, 0.9)])
def test_the_first_grid_keeps_its_step_and_its_ends(low: float, high: float) -> None:
    grid = first_grid(low, high, 0.01)
    assert (grid[0], grid[-1]) == (low, high)
    assert (np.diff(grid) > 0.0).all()
    lifted = grid[grid >= 1.0]
    if lifted.size:
        assert (np.diff(lifted) <= 0.0100001 * lifted[1:]).all()
    else:
        assert len(grid) == 2
