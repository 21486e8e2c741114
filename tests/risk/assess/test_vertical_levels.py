"""Levels of an assessment under vertical motion: the base that falls at g ends them."""

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.risk.assess._vertical_levels import contact_levels, levels_of
from rocksteady.seismic.measures.scalar import Measure

STATUE = rs.Block.asymmetric(left=0.17, right=0.27, height=1.6)
MEASURE = Measure("p_pgv_per_uplift")


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
    for pair, level in zip(pairs, contact_levels(MEASURE, STATUE, pairs), strict=True):
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


def test_levels_without_vertical_motion_are_the_usual_ones() -> None:
    assert levels_of(MEASURE, STATUE, suite(0.5), 20) != rs.risk.Levels(MEASURE)
    assert levels_of(MEASURE, STATUE, rs.motions.make_synthetic_suite(3), 20) == rs.risk.Levels(
        MEASURE
    )
    assert np.isinf(contact_levels(MEASURE, STATUE, rs.motions.make_synthetic_suite(3))).all()


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
