"""Shares of one damage state: half of the runs, their band, rows, and what summarises them."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.measures import Measure
from rocksteady.risk import DamageState, StateFragility, fit_curve
from rocksteady.risk.counted.curve import Curve
from tests.risk.counted.recorded import spread_out

RECORDS = 20
RUNS = 5 * RECORDS


def state_of(
    falls: list[int], name: str = "overturned", lifts_at: Any = (0.1,), **keys: Any
) -> StateFragility:
    """Return a state of which so many of 100 runs at each level reach it, at .2, .4, .8 ... g."""
    levels = np.array([0.2 * 2.0**k for k in range(len(falls))])
    counts = [spread_out(each, RECORDS) for each in falls]
    return StateFragility(
        state=DamageState(name, keys.get("peak")),
        measure=keys.get("measure", Measure("pga_g")),
        curve=Curve(levels=levels, counts=counts, lifts_at=np.sort(np.array(lifts_at, float))),
        lognormal=fit_curve(levels, falls, [RUNS] * len(falls)),
    )


def test_half_fall_where_the_curve_is_a_half() -> None:
    """From 25 at 0.4 g to 75 of 100 at 0.8 g: at their geometric mean."""
    half = state_of([0, 25, 75, 100]).half
    assert half is not None
    middle, low, high = half
    assert middle == pytest.approx(0.4 * math.sqrt(2.0))
    bands = [spread_out(each, RECORDS).band for each in (25, 75)]
    # The level of the lower end is where the upper end of the share is a half.
    for level, end in ((low, 1), (high, 0)):
        part = (0.5 - bands[0][end]) / (bands[1][end] - bands[0][end])
        assert level == pytest.approx(0.4 * 2.0**part)


@given(st.lists(st.integers(0, RUNS), min_size=1, max_size=8))
def test_half_is_a_level_at_which_the_share_is_a_half(falls: list[int]) -> None:
    state = state_of(falls)
    steps = state.curve.steps
    half = state.half
    if steps[0] >= 0.5 or steps[-1] < 0.5:
        assert half is None
        return
    assert half is not None
    middle, low, high = half
    assert float(state.share(middle)) == pytest.approx(0.5, abs=1e-9)
    assert float(state.share(0.999 * middle)) < 0.5
    assert low is None or low <= middle
    assert high is None or high >= middle


def test_half_fall_no_lower_than_half_lift() -> None:
    """None falls at 0.2 g and all at 0.4 g; from 0.39 g on they lift."""
    state = state_of([0, 100], lifts_at=[0.39] * 10)
    half = state.half
    assert half is not None
    assert half[0] == pytest.approx(0.39, rel=1e-6)
    assert float(state.share(half[0] * 1.001)) >= 0.5
    assert half[1] is None or half[1] >= 0.39 * (1.0 - 1e-6)


@pytest.mark.parametrize(
    ("lifts_at", "middle"),
    [([0.3, 0.1, 0.5], 0.3), ([0.4, 0.3, 0.1, 0.5], 0.3), ([0.1, math.inf], 0.1),
     ([0.1, math.inf, math.inf], None)],
)  # fmt: skip
def test_half_lift_above_the_middle_threshold_and_it_has_no_band(
    lifts_at: list[float], middle: float | None
) -> None:
    state = state_of([0, 50], "uplift", lifts_at)
    if middle is None:
        assert state.half is None
        return
    assert state.half == (middle, None, None)
    assert float(state.share(middle * (1.0 + 1e-9))) >= 0.5
    assert float(state.share(middle)) < 0.5


def test_the_share_that_lifts_is_a_step_and_of_other_states_the_curve() -> None:
    lifted, fallen = (state_of([0, 100], name, [0.25, 0.3]) for name in ("uplift", "overturned"))
    at = [0.2, 0.26, 0.31]
    assert lifted.share(at).tolist() == [0.0, 0.5, 1.0]
    assert fallen.share(at) == pytest.approx([0.0, min(0.5, math.log2(1.3)), math.log2(0.31 / 0.2)])


def test_a_lognormal_summarises_up_to_ten_points() -> None:
    for falls, good in (([2, 16, 50, 84, 98], True), ([0, 40, 40, 40, 100], False)):
        state = state_of(falls)
        assert state.is_lognormal == good == (state.lognormal.misfit <= 0.1)
    step = state_of([0, 0, 100, 100])
    assert math.isnan(step.lognormal.beta)
    assert step.summary_row["beta"] is None
    never = state_of([0, 0, 0])
    assert not never.is_lognormal
    assert never.summary_row == {
        "damage_state": "overturned", "median": None, "beta": None, "misfit": None,
    }  # fmt: skip


def test_each_level_is_a_row_with_its_count_and_interval() -> None:
    state = state_of([0, 25, 75, 100])
    rows = state.rows
    assert [row["level"] for row in rows] == pytest.approx([0.2, 0.4, 0.8, 1.6])
    for row, falls in zip(rows, (0, 25, 75, 100), strict=True):
        count = spread_out(falls, RECORDS)
        assert (row["share"], row["reached"], row["runs"]) == (falls / 100, falls, RUNS)
        assert (row["low"], row["high"]) == count.band
        assert row["records"] == RECORDS
        assert (row["measure"], row["damage_state"]) == ("pga_g", "overturned")
    assert state_of([0, 9], measure=None).rows[0]["measure"] == "scale"
    values = state.to_dict()
    assert [row["share"] for row in values["shares"]] == [0.0, 0.25, 0.75, 1.0]
    assert values["median"] == state.lognormal.median
