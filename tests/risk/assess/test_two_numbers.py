"""Two numbers to an answer: the worked case, limits, refusals and remarks."""

import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import norm

from rocksteady import Block
from rocksteady.errors import InputError
from rocksteady.risk import assess_by_formula
from tests.descriptions import as_json, fits
from tests.every import every

BLOCK = Block.rectangle(width=0.32, height=1.8)
G = 9.80665


def test_the_worked_case() -> None:
    result = assess_by_formula(BLOCK, 0.35, 0.4)
    assert result.probability == pytest.approx(0.3992, abs=5e-5)
    ratio = BLOCK.p * 0.4 / (G * 0.32 / 1.8)
    assert result.probability == pytest.approx(norm.cdf(math.log(ratio / 0.757) / 0.592))
    assert result.median_pgv_m_s == pytest.approx(0.4653, abs=5e-5)
    assert result.uplift_pga_g == pytest.approx(0.1778, abs=5e-5)
    assert result.friction_needed == pytest.approx(0.2199, abs=5e-5)
    assert (result.beta, result.verdict) == (0.592, "rocks")
    assert result.sentence == "40 % of such blocks fall at 0.35 g and 0.4 m/s, by a formula."
    assert "10.1002/eqe.70042" in result.summary(more=True)


@given(st.floats(0.05, 0.4), st.floats(0.2, 6.0))
def test_at_the_median_half_fall_and_below_uplift_none(slope: float, height: float) -> None:
    block = Block.rectangle(width=slope * height, height=height)
    median = assess_by_formula(block, 2.0 * slope, 0.3).median_pgv_m_s
    assert assess_by_formula(block, 2.0 * slope, median).probability == pytest.approx(0.5)
    resting = assess_by_formula(block, 0.999 * slope, 9.0 * median)
    assert (resting.probability, resting.verdict) == (0.0, "rest")


@given(st.floats(0.05, 0.4), st.floats(0.2, 3.0), st.floats(0.01, 3.0), st.floats(0.05, 3.0))
def test_larger_blocks_of_one_shape_need_velocities_with_the_root_of_their_size(
    slope: float, height: float, scale: float, pgv: float
) -> None:
    small = Block.rectangle(width=slope * height, height=height)
    large = Block.rectangle(width=slope * height * scale, height=height * scale)
    share = assess_by_formula(small, 1.0, pgv).probability
    scaled = assess_by_formula(large, 1.0, pgv * math.sqrt(scale)).probability
    assert scaled == pytest.approx(share, abs=1e-12)


@every("friction", [0.1, 0.2])
def test_where_friction_governs_rocking_is_no_answer(friction: float) -> None:
    """It slides below tan(alpha) = 0.178, and slides and rocks below its need of 0.22."""
    result = assess_by_formula(BLOCK, 0.35, 0.4, friction)
    assert (result.probability, result.verdict) == (None, "slides")
    assert as_json(result.to_dict())["probability"] is None
    assert result.sentence.startswith("It slides at 0.35 g")


def test_friction_is_needed_at_impacts_too() -> None:
    soft = Block.rectangle(width=0.32, height=1.8, restitution=0.8)
    result = assess_by_formula(soft, 0.35, 0.4, friction=0.5)
    assert result.probability is None
    assert result.friction_needed == pytest.approx(1.8 / 0.32 * 0.2 / 1.8)


def test_vertical_motion_lowers_uplift() -> None:
    plain = assess_by_formula(BLOCK, 0.17, 0.4)
    assert (plain.probability, plain.verdict) == (0.0, "rest")
    shaken = assess_by_formula(BLOCK, 0.17, 0.4, vertical_g=0.2)
    assert shaken.uplift_pga_g == pytest.approx(0.8 * 0.32 / 1.8)
    assert shaken.probability == assess_by_formula(BLOCK, 0.35, 0.4).probability
    assert "with 0.2 g of vertical motion downwards" in shaken.sentence
    for wrong in (-0.1, 1.0):
        with pytest.raises(InputError, match="vertical"):
            assess_by_formula(BLOCK, 0.35, 0.4, vertical_g=wrong)


@every(
    ("changed", "name"),
    [
        ({"pga_g": 0.0}, "pga_g"), ({"pga_g": math.inf}, "pga_g"), ({"pgv_m_s": -1.0}, "pgv_m_s"),
        ({"friction": -0.1}, "friction"), ({"block": Block.from_p(alpha=1e-320, p=1e6)}, "alpha"),
    ],
)  # fmt: skip
def test_what_is_no_peak_is_refused(changed: dict[str, Any], name: str) -> None:
    arguments: dict[str, Any] = {"block": BLOCK, "pga_g": 0.35, "pgv_m_s": 0.4} | changed
    with pytest.raises(InputError) as refusal:
        assess_by_formula(**arguments)
    assert refusal.value.name == name


def test_remarks_at_the_edges_of_what_is_usual() -> None:
    for pga, ratio, words in (
        (0.4, 0.0099, "PGV/PGA is 0.0099 s"), (0.4, 0.0101, ""), (0.4, 0.499, ""),
        (0.4, 0.501, "PGV/PGA is 0.501 s"), (3.999, 0.1, ""), (4.001, 0.1, "PGV/PGA is 0.1 s"),
        (9.0, 0.6, "PGV/PGA is 0.6 s"),
    ):  # fmt: skip
        remarks = assess_by_formula(BLOCK, pga, ratio * pga * G, 20.0).remarks
        assert len(remarks) == (words != ""), (pga, ratio)
        assert "".join(remarks).startswith(words)
        assert all("are the units right?" in remark for remark in remarks)
    outside = assess_by_formula(Block.from_p(alpha=0.4, p=2.0), 0.6, 0.4, 20.0).remarks
    unlike = Block.asymmetric(left=0.1, right=0.3, height=1.8)
    result = assess_by_formula(unlike, 0.35, 0.4, 20.0)
    assert result.uplift_pga_g == pytest.approx(0.1 / 0.9)
    alpha, p = unlike.positive.alpha, unlike.positive.p
    assert result.median_pgv_m_s == pytest.approx(0.757 * G * math.tan(alpha) / p)
    wall = assess_by_formula(BLOCK.against_wall(0.5), 0.35, 0.4, 20.0).remarks
    unknown = assess_by_formula(BLOCK, 0.35, 0.4)
    for remarks, words in (
        (outside, "outside the runs"), (result.remarks, "sides differ"), (wall, "wall is left out"),
        (unknown.remarks, "friction is not given"),
    ):  # fmt: skip
        assert words in remarks[-1], remarks
    assert assess_by_formula(BLOCK, 0.35, 0.4, 0.3).remarks == ()
    assert fits(unknown.summary())
    assert "doubt" in unknown.summary()
