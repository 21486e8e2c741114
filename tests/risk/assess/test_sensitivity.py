"""Cases of a changed object: what each is from, and what is changed."""

import math
from typing import Any

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.risk.assess._counts import MULTIPLES, THE_DEMAND, Counts
from rocksteady.risk.assess._demand_level import DemandLevel
from rocksteady.risk.assess._sensitivity import (
    band_of,
    case_of,
    changes_of,
    levels_about,
    stays,
    tornado,
    vary,
)
from rocksteady.risk.assess.described.objects import DescribedObject, parameter_words
from rocksteady.risk.screens.friction import uplift_acceleration_g
from rocksteady.seismic.measures.scalar import Measure, compute_measure
from tests.every import every

RECORDS = 12


def described(**keys: Any) -> DescribedObject:
    values: dict[str, Any] = {"name": "vase", "geometry": {"width_m": 0.36, "height_m": 1.8}}
    return DescribedObject(values=values | keys)


def counts(shares: list[float], *, lifted: int = 5) -> Counts:
    """Return runs of which a share falls at each level, spread evenly over the records."""
    tried = np.full((RECORDS, 5), lifted)
    fell = np.zeros((RECORDS, 5), dtype=int)
    for level, share in enumerate(shares):
        count = round(share * tried[:, level].sum())
        fell[:, level] = [count // RECORDS + (k < count % RECORDS) for k in range(RECORDS)]
    return Counts(
        levels=0.4 * np.array(MULTIPLES),
        trials=np.full((RECORDS, 5), 6),
        lifted=tried,
        fell=fell,
        without=0,
        measure=("PGV", "m/s"),
        given_uplift=True,
    )


def test_levels_about_a_demand_hold_the_demand_in_their_middle() -> None:
    level = DemandLevel(measure=Measure("pgv_m_s"), value=0.4, words="")
    levels = levels_about(level)
    assert levels == [0.4 * each for each in MULTIPLES]
    assert levels[THE_DEMAND] == 0.4
    assert levels[::-1] == pytest.approx([0.16 / each for each in levels], rel=0.01)
    # A third of an octave apart, to two digits.
    assert np.diff(np.log2(levels)) == pytest.approx([1.0 / 3.0] * 4, abs=0.03)


def test_a_case_is_from_its_curve_or_from_its_count() -> None:
    smooth = case_of("x", "", counts([0.1, 0.25, 0.5, 0.75, 0.9]))
    assert smooth.basis == "curve"
    assert smooth.probability == smooth.fitted == pytest.approx(0.5, abs=0.03)
    assert (smooth.fell, smooth.trials, smooth.counted) == (30, 60, 0.5)
    assert smooth.median == pytest.approx(0.4, rel=0.05)
    # Far more fall at the demand than a curve through all levels allows.
    bulge = case_of("x", "", counts([0.1, 0.1, 0.7, 0.2, 0.9]))
    assert bulge.counted - bulge.fitted > 0.1
    assert (bulge.basis, bulge.probability) == ("count", bulge.counted)
    dip = case_of("x", "", counts([0.1, 0.6, 0.1, 0.7, 0.9]))
    assert dip.fitted - dip.counted > 0.1
    assert (dip.basis, dip.probability) == ("curve", dip.fitted)
    step = case_of("x", "", counts([0.0, 0.0, 1.0, 1.0, 1.0]))
    assert (step.basis, step.fitted, step.probability) == ("count", 1.0, 1.0)
    none = case_of("x", "", counts([0.0] * 5, lifted=0))
    assert math.isnan(none.probability)
    assert none.to_dict()["probability"] is None
    assert none.to_dict()["band_low"] is None
    resting = case_of("x", "", counts([0.1, 0.25, 0.5, 0.75, 0.9]), rests=True)
    assert (resting.basis, resting.probability, resting.counted) == ("statics", 0.0, 0.5)


def test_an_object_stays_up_to_its_uplift_and_without_a_pga_it_is_taken_to_lift() -> None:
    gate = uplift_acceleration_g(described().block)
    at, above = (
        described(demand={"pga_g": pga, "pgv_m_s": 0.4}) for pga in (gate, gate * (1.0 + 1e-8))
    )
    assert stays(at, at.block)
    assert not stays(above, above.block)
    assert not stays(described(demand={"pgv_m_s": 0.4}), described().block)
    shaken = described(demand={"pga_g": 0.95 * gate, "vertical_g": 0.2, "vertical_share": 0.4})
    assert not stays(shaken, shaken.block)


@every(
    ("restitution", "draws", "most", "count"),
    [("housner", 8, 3, 3), ("housner", 2, 3, 2), (0.9, 8, 3, 1), (None, 8, 20, 8)],
)
def test_restitutions_are_no_more_than_wanted(
    restitution: Any, draws: int, most: int, count: int
) -> None:
    given = {} if restitution is None else {"restitution": restitution}
    one = described(assessment={"draws": draws}, **given)
    assert band_of(one, most=most).draws == count
    ratios = band_of(one, most=most).ratios(one.block)
    assert ratios[0].tolist() == pytest.approx([one.block.restitution] * 2)
    between = described(restitution={"low": 0.8, "high": 0.9}, assessment={"draws": draws})
    ends = band_of(between, most=most).ratios(between.block)[[0, -1], 0]
    assert ends.tolist() == pytest.approx([0.8, 0.9])


def test_what_is_changed_is_the_height_of_the_mass_centre_by_a_tenth_and_the_width() -> None:
    changes = changes_of(described())
    words = [(parameter, change) for parameter, change, _ in changes]
    assert words == [
        ("mass centre", "-10 %"),
        ("mass centre", "+10 %"),
        ("base width", "-5 %, worn edges"),
    ]
    tangents = [math.tan(block.alpha) for _, _, block in changes]
    assert tangents == pytest.approx([0.2 / 0.9, 0.2 / 1.1, 0.95 * 0.2])
    stocky = described(geometry={"width_m": 1.2, "height_m": 0.9})  # with a lower centre no impacts
    assert [change for _, change, _ in changes_of(stocky)] == ["+10 %", "-5 %, worn edges"]
    ranged = described(geometry={"width_m": {"low": 0.3, "high": 0.42}, "height_m": 1.8})
    ends = [math.tan(block.alpha) for name, _, block in changes_of(ranged) if "width_m" in name]
    assert sorted(ends) == pytest.approx([0.3 / 1.8, 0.42 / 1.8])


@every(
    ("key", "words"),
    [
        ("geometry.inertia_kg_m2", "inertia"),
        ("geometry.p_rad_s", "p"),
        ("geometry.alpha_deg", "alpha"),
        ("geometry.alpha_rad", "alpha"),
        ("content.mass_kg", "content mass"),
        ("geometry.mass_kg", "mass"),
        ("restitution", "restitution"),
    ],
)
def test_a_key_is_read_without_its_unit(key: str, words: str) -> None:
    assert parameter_words(key) == words


def test_bars_are_of_one_method_and_what_the_pga_does_not_lift_is_no_fall() -> None:
    base = case_of("as described", "", counts([0.1, 0.25, 0.5, 0.75, 0.9]))
    resting = case_of("base width", "", counts([0.1, 0.25, 0.5, 0.75, 0.9]), rests=True)
    worse = case_of("mass centre", "", counts([0.1, 0.3, 0.7, 0.75, 0.9]))
    for basis, of in (("count", 0.5), ("curve", base.fitted)):
        bars = tornado([base, resting, worse], basis)  # type: ignore[arg-type]
        assert [bar["parameter"] for bar in bars] == ["base width", "mass centre"]
        assert {bar["base"] for bar in bars} == {of}
        assert (bars[0]["low"], bars[0]["high"]) == (0.0, of)
        assert bars[1]["high"] == (0.7 if basis == "count" else worse.fitted)


def test_runs_whose_base_falls_at_g_are_left_out_of_the_case_of_vertical_motion() -> None:
    across = rs.motions.make_synthetic_suite(4, seed=3)
    up = rs.motions.make_synthetic_suite(4, seed=4)
    pairs = [rs.BaseMotion(a, b.scaled(2.0)) for a, b in zip(across, up, strict=True)]
    level = DemandLevel(measure=Measure("pgv_m_s"), value=1.0, words="")
    case = vary(described(assessment={"draws": 1}), pairs, level)[-1]
    # Oracle: single runs of the same motions at the same levels.
    velocity, block = Measure("pgv_m_s"), described().block
    ends = [
        rs.simulate(block, pair.scaled(factor / compute_measure(record, velocity))).status
        for record, pair in zip(across, pairs, strict=True)
        for factor in levels_about(level)
    ]
    lost = sum(end is rs.Status.LOST_CONTACT for end in ends)
    assert 0 < lost < len(ends)
    assert case.parameter == "vertical motion"
    assert f"{lost} runs left out whose base falls at g" in case.change
