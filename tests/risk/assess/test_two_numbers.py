"""Two numbers to an answer: the worked case, limits, refusals and words."""

import itertools
import math
import re
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady import Block
from rocksteady.errors import InputError
from rocksteady.risk import assess_by_formula
from rocksteady.risk.assess.two_numbers import WORDS, share_words
from tests.descriptions import as_json, fits
from tests.every import every

BLOCK = Block.rectangle(width=0.32, height=1.8)


def test_the_worked_case() -> None:
    found = assess_by_formula(BLOCK, 0.35, 0.4)
    assert found.probability == pytest.approx(0.3992, abs=5e-5)
    assert found.median_pgv_m_s == pytest.approx(0.4653, abs=5e-5)
    assert found.uplift_pga_g == pytest.approx(0.1778, abs=5e-5)
    assert found.friction_needed == pytest.approx(0.2199, abs=5e-5)
    assert found.beta == 0.592
    assert found.verdict == "rocks"
    assert found.sentence == (
        "About 2 in 5 blocks of this shape and size would fall at a PGA of 0.35 g and a PGV of "
        "0.4 m/s."
    )


def test_the_other_probability_is_that_of_our_own_runs() -> None:
    from scipy.stats import norm

    found = assess_by_formula(BLOCK, 0.35, 0.4)
    number = BLOCK.p * 0.4 / (9.80665 * 0.32 / 1.8)
    assert found.other_probability == pytest.approx(norm.cdf(math.log(number / 0.672) / 0.462))
    assert found.probability == pytest.approx(norm.cdf(math.log(number / 0.757) / 0.592))
    text = " ".join(found.summary(more=True).split())
    assert "second probability 47 %" in text
    assert "28,399" in text
    assert "10.1002/eqe.70042" in text
    assert "not a prediction for one" in text
    assert "anchorage rules" in text


@given(st.floats(0.05, 0.4), st.floats(0.2, 6.0))
def test_at_the_median_half_fall_and_below_uplift_none(slope: float, height: float) -> None:
    block = Block.rectangle(width=slope * height, height=height)
    median = assess_by_formula(block, 2.0 * slope, 0.3).median_pgv_m_s
    assert assess_by_formula(block, 2.0 * slope, median).probability == pytest.approx(0.5)
    resting = assess_by_formula(block, 0.999 * slope, 9.0 * median)
    assert (resting.probability, resting.other_probability) == (0.0, 0.0)
    assert resting.verdict == "rest"
    assert "does not lift it" in resting.sentence


@given(st.floats(0.05, 0.4), st.floats(0.2, 3.0), st.floats(0.01, 3.0), st.floats(0.05, 3.0))
def test_larger_blocks_of_one_shape_need_velocities_with_the_root_of_their_size(
    slope: float, height: float, scale: float, pgv: float
) -> None:
    small = Block.rectangle(width=slope * height, height=height)
    large = Block.rectangle(width=slope * height * scale, height=height * scale)
    one = assess_by_formula(small, 1.0, pgv)
    other = assess_by_formula(large, 1.0, pgv * math.sqrt(scale))
    assert other.probability == pytest.approx(one.probability, abs=1e-12)


@pytest.mark.parametrize(("friction", "words"), [(0.1, "It slides"), (0.2, "It also slides")])
def test_where_friction_governs_rocking_is_no_answer(friction: float, words: str) -> None:
    found = assess_by_formula(BLOCK, 0.35, 0.4, friction)
    assert (found.probability, found.other_probability) == (None, None)
    assert found.verdict == "slides"
    assert found.sentence.startswith(words)
    assert "0.22" in found.sentence
    assert as_json(found.to_dict())["probability"] is None
    assert fits(found.summary())


def test_enough_friction_and_none_give_the_same_probability() -> None:
    known, unknown = (assess_by_formula(BLOCK, 0.35, 0.4, mu) for mu in (0.3, None))
    assert known.probability == unknown.probability
    assert known.remarks == ()
    assert "friction is not given" in unknown.remarks[0]


@every(("pga", "pgv"), [(0.35, 40.0), (35.0, 0.4), (0.35, 0.01), (35.0, 40.0)])
def test_a_ratio_that_no_ground_has_is_remarked_on(pga: float, pgv: float) -> None:
    found = assess_by_formula(BLOCK, pga, pgv, 99.0)
    assert any("are the units right?" in remark for remark in found.remarks)


def test_a_block_beyond_our_own_runs_and_one_whose_sides_differ_are_remarked_on() -> None:
    tiny = assess_by_formula(Block.rectangle(width=0.02, height=0.1), 0.35, 0.4, 1.0)
    assert "p 12" in tiny.remarks[0]
    block = Block.asymmetric(left=0.1, right=0.3, height=1.8)
    found = assess_by_formula(block, 0.35, 0.4, 1.0)
    assert any("sides differ" in remark for remark in found.remarks)
    assert found.uplift_pga_g == pytest.approx(0.1 / 0.9)
    side = block.positive
    assert found.median_pgv_m_s == pytest.approx(0.757 * 9.80665 * math.tan(side.alpha) / side.p)


def test_words_of_shares_are_the_nearest_odds_and_never_0_or_1() -> None:
    assert share_words(0.0) == "Fewer than 1 in 1000"
    assert share_words(1.0) == "More than 99 in 100"
    assert [share_words(p) for p in (0.5, 0.1, 0.34, 0.012, 0.9)] == [
        "About 1 in 2",
        "About 1 in 10",
        "About 1 in 3",
        "About 1 in 100",
        "About 9 in 10",
    ]


def test_json_has_the_keys_of_the_contract_and_the_text_fits_a_page() -> None:
    found = assess_by_formula(BLOCK, 0.35, 0.4)
    values = as_json(found.to_dict())
    keys = ["probability", "median_pgv_m_s", "beta", "uplift_pga_g", "friction_needed", "sentence"]
    for key in keys:
        assert values[key] == getattr(found, key)
    assert fits(found.summary())


@every(
    ("changed", "name"),
    [
        ({"pga_g": 0.0}, "pga_g"),
        ({"pga_g": math.inf}, "pga_g"),
        ({"pgv_m_s": -1.0}, "pgv_m_s"),
        ({"friction": -0.1}, "friction"),
    ],
)
def test_what_is_no_peak_is_refused(changed: dict[str, Any], name: str) -> None:
    arguments: dict[str, Any] = {"block": BLOCK, "pga_g": 0.35, "pgv_m_s": 0.4} | changed
    with pytest.raises(InputError) as refusal:
        assess_by_formula(**arguments)
    assert refusal.value.name == name


def test_vertical_motion_lowers_uplift_and_is_printed() -> None:
    plain = assess_by_formula(BLOCK, 0.17, 0.4)
    assert (plain.probability, plain.verdict) == (0.0, "rest")
    shaken = assess_by_formula(BLOCK, 0.17, 0.4, vertical_g=0.5, vertical_share=0.4)
    assert shaken.uplift_pga_g == pytest.approx(0.8 * 0.32 / 1.8)
    assert shaken.probability == assess_by_formula(BLOCK, 0.35, 0.4).probability
    assert shaken.sentence.endswith(
        "with 0.2 g of vertical motion downwards at the peak (0.4 of 0.5 g)."
    )
    assert "vertical" not in plain.sentence
    for wrong in ({"vertical_g": -0.1}, {"vertical_share": 1.5}, {"vertical_g": 1.0}):
        with pytest.raises(InputError, match="vertical"):
            assess_by_formula(BLOCK, 0.35, 0.4, **wrong)


def test_friction_that_impacts_need_is_named() -> None:
    soft = Block.rectangle(width=0.32, height=1.8, restitution=0.8)
    found = assess_by_formula(soft, 0.35, 0.4, friction=0.5)
    assert (found.friction_cause, found.probability) == ("impacts", None)
    assert found.friction_needed == pytest.approx(1.8 / 0.32 * 0.2 / 1.8)
    assert "0.625 for impacts" in found.sentence


def test_words_of_odds_are_the_odds() -> None:
    """Each known share is called by its own words, and others by those of the nearest odds."""
    for share, words in WORDS:
        part, whole = map(int, re.findall(r"\d+", words))
        assert share == pytest.approx(part / whole, abs=1e-15)
        assert share_words(share) == f"About {words}"
    for low, high in itertools.pairwise(WORDS):
        odds = [math.log(each[0] / (1.0 - each[0])) for each in (low, high)]
        for near, words in ((0.49, low[1]), (0.51, high[1])):
            middle = odds[0] + near * (odds[1] - odds[0])
            assert share_words(1.0 / (1.0 + math.exp(-middle))) == f"About {words}"
    assert share_words(0.000999) == share_words(0.0) == "Fewer than 1 in 1000"
    assert share_words(0.9901) == share_words(1.0) == "More than 99 in 100"


def test_remarks_at_the_edges_of_what_is_usual() -> None:
    g = 9.80665
    for pga, ratio, words in (
        (0.4, 0.0099, "PGV/PGA is 0.0099 s; recorded motions have 0.01 to 0.5 s: are the units ri"),
        (0.4, 0.0101, ""),
        (0.4, 0.499, ""),
        (0.4, 0.501, "PGV/PGA is 0.501 s; recorded motions have 0.01 to 0.5 s: are the units righ"),
        (3.999, 0.1, ""),
        (4.001, 0.1, "A PGA of 4 g is beyond recorded ones, up to about 4 g: are the units right?"),
        (9.0, 0.6, "PGV/PGA is 0.6 s"),
    ):
        result = assess_by_formula(BLOCK, pga, ratio * pga * g, 20.0).remarks
        assert len(result) == (words != ""), (pga, ratio)
        assert "".join(result).startswith(words)
    for alpha, p, words in (
        *((0.0999, 2.0, "alpha 0.0999 rad"), (0.1001, 2.0, ""), (0.2999, 2.0, "")),
        *((0.3001, 2.0, "alpha 0.3 rad"), (0.2, 0.999, "p 0.999 rad/s"), (0.2, 1.001, "")),
        *((0.2, 2.999, ""), (0.2, 3.01, "p 3.01 rad/s"), (0.4, 4.0, "alpha 0.4 rad and p 4 rad/s")),
    ):
        result = assess_by_formula(Block.from_p(alpha=alpha, p=p), 0.6, 0.4, 20.0).remarks
        runs = "lies outside the runs of this package (alpha 0.1 to 0.3 rad, p 1 to 3 rad/s)."
        assert result == ((f"{words} {runs}",) if words else ()), (alpha, p)
    wall = assess_by_formula(BLOCK.against_wall(0.5), 0.35, 0.4, 20.0).remarks
    assert wall == ("The runs are of blocks that rock to both sides: the wall is left out.",)
    unlike = Block.asymmetric(left=0.15, right=0.2, height=1.8)
    assert assess_by_formula(unlike, 0.35, 0.4, 20.0).remarks == (
        "The sides differ: both are taken to be as the side that lifts first.",
    )


def test_answers_in_words() -> None:
    """What decides, at which demand, and what lifts the block as a share of the demand."""
    for pga, friction, vertical, first in (
        (0.35, None, 0.0, "40 % of such blocks fall at 0.35 g and 0.4 m/s, by a formula."),
        (0.1, None, 0.0, "It stands at 0.1 g and 0.4 m/s: this does not lift it."),
        (0.35, 0.1, 0.0, "It slides at 0.35 g and 0.4 m/s: no probability of falling by rocking."),
        (0.35, 0.3, 0.2, "at 0.35 g and 0.4 m/s with 0.2 g of vertical motion downwards at the pe"),
    ):
        result = assess_by_formula(BLOCK, pga, 0.4, friction, vertical_g=vertical)
        text = " ".join(result.summary().split())
        assert first in text, text
        rocks = result.verdict == "rocks"
        assert ("second formula" in text) == rocks
        assert ("half fall at" in text) == rocks
        lifts = 0.32 / 1.8 * (1.0 - vertical)
        assert f"lifts at {lifts:.3g} g, {lifts / pga:.2g} of the demand" in text.replace("  ", " ")
        given = "not known, and below it the block slides" if friction is None else f"{friction} gi"
        assert given in text
    values = assess_by_formula(BLOCK, 0.35, 0.4, vertical_g=0.2, vertical_share=0.5).to_dict()
    assert (values["vertical_g"], values["vertical_share"]) == (0.2, 0.5)
    assert values["uplift_pga_g"] == pytest.approx(0.9 * 0.32 / 1.8)
    assert values["other_beta"] == 0.462
    assert values["other_median_pgv_m_s"] / values["median_pgv_m_s"] == pytest.approx(0.672 / 0.757)
    full = " ".join(assess_by_formula(BLOCK, 0.35, 0.4).summary(more=True).split())
    assert "0.465 m/s, beta 0.592; second 0.413 m/s, 0.462" in full
    assert "0.22 to rock without sliding at this PGA; not given" in full
    soft = Block.rectangle(width=0.3, height=1.8, restitution=0.8)
    full = " ".join(assess_by_formula(soft, 0.2, 0.4, 0.9).summary(more=True).split())
    assert "0.667 to rock without sliding at this PGA, for impacts; 0.9 given" in full
