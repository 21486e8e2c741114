"""Rows of a damage state: the curve to use first, and each under its stage."""

import pytest

from rocksteady.risk import DamageState, StateFragility, fit_curve, fit_two_stages
from tests.every import every

AT, TRIALS = [0.2, 0.4, 0.8, 1.6], [40] * 4
PLAIN = fit_curve(AT, [2, 9, 27, 39], TRIALS)
TWO = fit_two_stages(AT, [10, 30, 40, 40], [0, 9, 27, 39], TRIALS)
GATED = fit_two_stages(AT, 0.3, [0, 3, 33, 39], TRIALS)


@every(
    ("two", "given_uplift", "first"),
    [(None, False, "plain"), (TWO, True, "given-uplift"), (GATED, False, "two-stage"),
     (GATED, True, "given-uplift")],
)  # fmt: skip
def test_one_row_is_used_and_it_comes_first(two: object, given_uplift: bool, first: str) -> None:
    state = StateFragility(
        state=DamageState("overturned"),
        plain=PLAIN if two is None else two.plain,  # type: ignore[attr-defined]
        two_stage=two,  # type: ignore[arg-type]
        given_uplift=given_uplift,
    )
    rows = state.rows("pgv_m_s")
    assert [row["used"] for row in rows] == [True] + [False] * (len(rows) - 1)
    assert rows[0]["stage"] == first
    assert len(rows) == (1 if two is None else 4)
    by_stage = {row["stage"]: row for row in rows}
    assert {row["measure"] for row in rows} == {"pgv_m_s"}
    assert by_stage["plain"]["gain"] is None
    assert by_stage["plain"]["offset"] == 0.0
    assert by_stage["plain"]["trials"] == 160
    assert rows[0]["median"] == pytest.approx(state.curve.median)
    if two is not None:
        assert by_stage["two-stage"]["status"] == "product"
        assert by_stage["two-stage"]["gain"] == state.gain == two.gain  # type: ignore[attr-defined]
        assert by_stage["two-stage"]["beta"] is None
        assert by_stage["given-uplift"]["offset"] == two.offset  # type: ignore[attr-defined]
        assert by_stage["uplift"]["offset"] == 0.0
        assert by_stage["given-uplift"]["failures"] == 75
    else:
        assert state.gain is None


def test_a_step_and_bands_stand_in_their_columns() -> None:
    step = StateFragility(
        state=DamageState("half", 0.5), plain=fit_curve(AT, [0, 0, 40, 40], TRIALS)
    )
    (row,) = step.rows("pga_g")
    assert (row["step_low"], row["step_high"], row["peak"]) == (0.4, 0.8, 0.5)
    assert (row["low"], row["beta_low"], row["beta"]) == (None, None, None)
    assert row["status"] == "separated"


def test_a_state_is_described_by_the_curve_to_use() -> None:
    state = StateFragility(state=DamageState("half", 0.5), plain=PLAIN)
    told = state.describe()
    assert told.headline == f"half: {PLAIN.describe().headline}"
    facts = {fact.key: fact.value for fact in told.facts}
    assert "measure" not in facts  # which its fragility has
    assert (facts["damage_state"], facts["peak"]) == ("half", 0.5)
    assert facts["median"] == PLAIN.median
    assert state.to_dict()["fits"] == state.rows("intensity")
