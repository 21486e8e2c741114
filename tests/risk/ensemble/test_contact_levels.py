"""Default levels under vertical motion: the base that falls at g ends them."""

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.risk.ensemble.contact_levels import (
    contact_levels,
    levels_in_contact,
    words_of_shorter,
)
from rocksteady.seismic.measures.scalar import Measure

STATUE = rs.Block.asymmetric(left=0.17, right=0.27, height=1.6)
MEASURE = Measure("p_pgv_per_uplift")
USUAL = rs.risk.Levels(MEASURE)


def suite(vertical: float) -> list[rs.BaseMotion]:
    """Motions with a vertical component that is a part of another horizontal one."""
    across, up = (
        rs.motions.make_synthetic_suite(12, seed=1),
        rs.motions.make_synthetic_suite(12, seed=2),
    )
    return [rs.BaseMotion(a, b.scaled(vertical)) for a, b in zip(across, up, strict=True)]


def test_contact_is_lost_exactly_above_the_contact_level() -> None:
    # Oracle: the march itself, of a free base motion just below and just above g downwards.
    pairs = suite(0.5)[:3]
    for pair, level in zip(pairs, contact_levels(USUAL, [STATUE], pairs)[0], strict=True):
        up = pair.vertical
        assert isinstance(up, rs.Record)
        assert isinstance(pair.horizontal, rs.Record)
        factor = 9.80665 / -min(up.acceleration_m_s2)
        at_one = rs.measures.compute_measure(pair.horizontal, MEASURE, STATUE)
        assert level == pytest.approx(factor * at_one, rel=1e-12)
        gentle = pair.horizontal.scaled(1e-3)  # it lifts the statue only where its base falls
        below, above = (
            rs.simulate(STATUE, rs.BaseMotion(gentle, up.scaled(factor * part))).status
            for part in (0.999, 1.001)
        )
        assert below is not rs.Status.LOST_CONTACT
        assert above is rs.Status.LOST_CONTACT


def test_levels_are_the_usual_ones_without_vertical_motion_and_where_they_are_given() -> None:
    plain, shaken = rs.motions.make_synthetic_suite(3), suite(0.5)
    assert levels_in_contact(USUAL, [STATUE], shaken) != USUAL
    assert levels_in_contact(USUAL, [STATUE], plain) == USUAL
    assert np.isinf(contact_levels(USUAL, [STATUE], plain)).all()
    assert levels_in_contact(USUAL, [STATUE], shaken, ways=rs.risk.Ways(vertical=False)) == USUAL
    given = rs.risk.Levels("pgv_m_s", [1.0, 30.0])
    assert levels_in_contact(given, [STATUE], shaken) is given


@pytest.mark.parametrize(
    ("count", "width", "vertical"), [(1, 0.3, 8.0), (3, 1.5, 2.0), (3, 0.3, 2.0), (1, 1.5, 8.0)]
)
def test_few_motions_with_strong_vertical_parts_have_answers(
    count: int, width: float, vertical: float
) -> None:
    # Each run is more than 1 % of so few, and a stocky block lifts where the base falls at g.
    block, shaken = rs.Block.rectangle(width=width, height=1.8), suite(vertical)[:count]
    one, bands = rs.risk.RestitutionBand(draws=1), rs.risk.FitOptions(bands=None)
    for ways in (rs.risk.Ways(), rs.risk.Ways(vertical=True)):
        fragility = rs.compute_fragility(block, shaken, restitution=one, ways=ways, fitting=bands)
        runs = fragility.ensemble
        assert not (runs.status == rs.Status.LOST_CONTACT).any()
        assert runs.sizes["level"] == 20
        (words,) = (text for text in fragility.warnings if "falls at g" in text)
        assert words in fragility.describe().notes
        # Oracle: at the last level the base falls at g, but for a part in 10^9, under one motion.
        falling = [
            -each.vertical.acceleration_m_s2.min() * scale
            for each, scale in zip(shaken, runs["scale"].values[0, :, -1], strict=True)
            if isinstance(each.vertical, rs.Record)
        ]
        assert max(falling) == pytest.approx(9.80665, rel=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("vertical", [0.3, 0.6])
def test_an_assessment_with_strong_vertical_motion_has_an_answer(vertical: float) -> None:
    statue = rs.risk.DescribedObject(
        values={
            "name": "statue",
            "geometry": {"left_m": 0.17, "right_m": 0.27, "mass_centre_height_m": 0.8},
            "demand": {"pgv_m_s": 0.25},
            "assessment": {"draws": 1, "levels": 8, "replicates": 0, "target_probability": 0.9},
        }
    )
    found = rs.assess_object(statue, suite(vertical))
    assert found.fragility is not None
    runs = found.fragility.ensemble
    assert float((runs.status == rs.Status.LOST_CONTACT).mean()) <= 0.01
    assert runs.level.size == 8
    assert 0.0 < float(runs.level[-1]) < 3.0
    assert found.probability is not None
    assert any("falls at g" in note for note in found.describe().notes)


def test_the_last_level_is_the_highest_at_which_one_in_a_hundred_may_end_so() -> None:
    """Counted run by run: of both ways half have the vertical motion."""
    shaken = suite(0.5)
    lost = contact_levels(USUAL, [STATUE], shaken)[0]
    usual = USUAL.levels_for([STATUE])
    lasts = {}
    for vertical, part in ((True, 1.0), ("both", 0.5)):
        ways = rs.risk.Ways(vertical=vertical)  # type: ignore[arg-type]
        result = levels_in_contact(USUAL, [STATUE], shaken, ways=ways).levels
        assert isinstance(result, tuple)
        assert len(result) == 20

        def ended(last: float, part: float = part) -> float:
            """Return the share of the runs that end without an answer."""
            span = np.geomspace(min(usual[0], last / 2.0), last, 20)
            runs = [
                level > limit * (1.0 - 1e-9) * (1.0 + 1e-12) for level in span for limit in lost
            ]
            return part * float(np.mean(runs))

        lasts[vertical] = result[-1]
        assert ended(result[-1]) <= 0.01
        higher = sorted(limit for limit in [*lost, usual[-1]] if limit > result[-1] * (1.0 + 1e-6))
        assert higher
        assert all(ended(limit * (1.0 - 1e-9)) > 0.01 for limit in higher)
        assert result[0] == pytest.approx(min(usual[0], result[-1] / 2.0))
    assert lasts[True] <= lasts["both"]
    words = words_of_shorter(USUAL, [STATUE], lasts[True])
    assert len(words) == 1
    assert words[0].startswith("The levels end at p PGV/(g tan alpha) ")
    assert (
        "the vertical motion of stronger records falls at g, and such runs have no an" in words[0]
    )
    assert words_of_shorter(USUAL, [STATUE], usual[-1]) == []
    assert words_of_shorter(rs.risk.Levels(MEASURE, [1.0]), [STATUE], 1.0) == []
