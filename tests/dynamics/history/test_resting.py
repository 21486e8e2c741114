"""Friction of a block at rest, against its definition at many times."""

import numpy as np
import pytest

from rocksteady import (
    BaseMotion,
    Block,
    Harmonic,
    Piecewise,
    Pulse,
    Record,
    State,
    Still,
    simulate,
)
from rocksteady.dynamics.history import base_motion
from rocksteady.errors import ModelError
from rocksteady.histories import Trajectory
from rocksteady.motions import Segment
from tests.dynamics.history.test_trajectory_quantities import GROUND, LIFT

RECTANGLE = Block.rectangle(width=0.4, height=1.2)
SKEWED = Block.asymmetric(left=0.1, right=0.4, height=1.2)


def at_rest(run: Trajectory, looks: int = 200_001) -> float:
    """Return the largest ratio of forces in the rests of a run, looked at evenly."""
    assert isinstance(run.block, Block)
    end = run.end_time_pt if run.overturn_time_pt is None else run.overturn_time_pt
    moving = base_motion.segment_starts(run.segments)[-1] or end  # then the base stands still
    times = np.linspace(0.0, min(end, moving), looks)
    side = run.flights.side[np.searchsorted(run.flights.pt, times, side="right") - 1]
    across = base_motion.base_acceleration(run.segments, times) * run.block.alpha
    driven = np.maximum(across, 0.0) if run.block.one_sided else np.abs(across)
    down = 1.0 + base_motion.lift(run.segments, times)
    return float((driven / down)[side == 0].max(initial=0.0))


def test_what_never_lifts_needs_the_peak_of_its_base() -> None:
    run = simulate(RECTANGLE, GROUND.scaled(0.1))
    assert not run.peak
    assert run.friction_needed == pytest.approx(run.pga_g)
    assert run.friction_needed == pytest.approx(at_rest(run), rel=1e-3)
    lifted = simulate(RECTANGLE, BaseMotion(GROUND.scaled(0.1), LIFT))
    assert lifted.friction_needed == pytest.approx(at_rest(lifted), rel=1e-3)
    shaken = simulate(RECTANGLE, Harmonic(amplitude=0.7, frequency_ratio=4.0), cycles=3)
    assert shaken.friction_needed == pytest.approx(0.7 * RECTANGLE.alpha, rel=1e-4)


def test_what_rocks_needs_no_less_at_rest() -> None:
    for block, motion in (
        (SKEWED, GROUND),
        (RECTANGLE, GROUND),
        (RECTANGLE, Harmonic(amplitude=1.5, frequency_ratio=6.0)),
        (SKEWED, Pulse(shape="one-sine", amplitude=1.6, frequency_ratio=5.0)),
        (RECTANGLE.against_wall(0.5), GROUND),
    ):
        run = simulate(block, motion)
        assert run.peak > 0.0
        assert run.friction_needed is not None
        assert run.friction_needed >= at_rest(run) * (1.0 - 1e-4)


def test_a_weak_side_lifts_before_the_strong_one_and_rests_under_more() -> None:
    """Driven to its strong side alone it rests, though it would lift to the other."""
    strong = np.tan(SKEWED.negative.alpha)
    push = Record(acceleration_m_s2=-9.80665 * 0.9 * strong * np.ones(50), dt_s=0.01)
    run = simulate(SKEWED, push)
    assert not run.peak
    assert run.friction_needed == pytest.approx(0.9 * strong)
    assert 0.9 * strong > np.tan(SKEWED.positive.alpha)


def test_a_wall_takes_what_drives_a_block_into_it() -> None:
    push = Record(acceleration_m_s2=-2.0 * np.ones(50), dt_s=0.01)
    walled = RECTANGLE.against_wall(0.5)
    assert simulate(walled, push).friction_needed == pytest.approx(0.0)
    assert simulate(walled, push.reversed()).friction_needed == pytest.approx(2.0 / 9.80665)


def test_a_block_that_is_let_go_needs_friction_and_a_struck_base_has_none() -> None:
    run = simulate(RECTANGLE, Still(), start=State(angle=0.5, velocity=0.0))
    assert run.friction_needed is not None
    assert 0.0 < run.friction_needed < 1.0
    assert run.uplift_g is None
    assert "friction_needed" not in run.to_dict()
    words = run.describe(friction=0.01).to_dict()
    assert (words["friction"], words["friction_needed"]) == (0.01, run.friction_needed)
    struck = simulate(RECTANGLE, Piecewise(pieces=(Segment(duration=1.0, jump=0.5),)))
    assert struck.friction_needed is None
    with pytest.raises(ModelError, match="without impulses"):
        struck.describe(friction=0.3)
