"""A horizontal and a vertical motion together."""

import inspect

import numpy as np
import pytest

from rocksteady import (
    BaseMotion,
    Block,
    Harmonic,
    Linear,
    Nonlinear,
    Piecewise,
    Pulse,
    Record,
    SyntheticMotion,
    simulate,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.motions import BandNoise, FourierSeries, Impulses, Segment

BLOCK = Block.from_p(alpha=0.3, p=2.0, restitution=0.8)
TIME = np.arange(0.0, 3.0, 0.02)
ACROSS = Record(acceleration_m_s2=4.0 * np.sin(6.0 * TIME), dt_s=0.02)
UP = Record(acceleration_m_s2=2.0 * np.sin(11.0 * TIME), dt_s=0.02)


def test_without_a_vertical_component_it_is_the_horizontal_one() -> None:
    for motion in (ACROSS, Harmonic(amplitude=2.0, frequency_ratio=4.0)):
        one, other = simulate(BLOCK, BaseMotion(motion)), simulate(BLOCK, motion)
        assert (one.model, one.motion, one.vertical) == (other.model, motion, None)
        assert np.array_equal(one.rows, other.rows)


def test_with_a_vertical_component_the_full_equations_hold() -> None:
    both = BaseMotion(ACROSS, UP)
    run = simulate(BLOCK, both)
    assert (run.model, run.motion, run.vertical) == (Nonlinear(), ACROSS, UP)
    assert run.peak != simulate(BLOCK, ACROSS).peak
    shaken = BaseMotion(Harmonic(amplitude=2.0, frequency_ratio=4.0), UP)
    assert simulate(BLOCK, shaken, cycles=3).model == Nonlinear()
    with pytest.raises(ModelError, match="no term for it"):
        simulate(BLOCK, both, model=Linear())


def test_a_constant_upward_acceleration_is_more_gravity() -> None:
    """In a lift that accelerates at g/2 a block rocks as under 1.5 g."""
    push = Piecewise(pieces=(Segment(duration=2.0, constant=1.3), Segment(duration=2.0)))
    across = Record(acceleration_m_s2=np.array([2.0, 2.0, -3.0, -3.0, 0.0, 0.0]), dt_s=0.2)
    lift = Record(acceleration_m_s2=np.full(6, 0.5 * BLOCK.gravity), dt_s=0.2)
    heavy = Block.from_p(alpha=0.3, p=2.0 * 1.5**0.5, restitution=0.8, gravity=1.5 * BLOCK.gravity)
    strong = BaseMotion(across, lift).scaled(2.0)
    assert (strong.horizontal, strong.vertical) == (across.scaled(2.0), lift.scaled(2.0))
    one = simulate(BLOCK, BaseMotion(across.scaled(2.0), lift))
    other = simulate(heavy, across.scaled(2.0))
    count = int((one.impacts.pt < 1.0 * BLOCK.p).sum())
    seconds = one.impacts.pt[:count] / BLOCK.p
    assert one(0.9 * BLOCK.p).angle == pytest.approx(other(0.9 * heavy.p).angle, rel=1e-8)
    assert seconds == pytest.approx(other.impacts.pt[:count] / heavy.p, rel=1e-8)
    assert (
        BaseMotion(push).scaled(0.5).horizontal
        == BaseMotion(
            Piecewise(pieces=(Segment(duration=2.0, constant=0.65), Segment(duration=2.0)))
        ).horizontal
    )


def test_the_horizontal_component_alone_is_reversed() -> None:
    turned = BaseMotion(ACROSS, UP).reversed()
    assert (turned.horizontal, turned.vertical) == (ACROSS.reversed(), UP)
    here, there = simulate(BLOCK, BaseMotion(ACROSS, UP)), simulate(BLOCK, turned)
    assert len(here.impacts.pt) > 0
    assert np.array_equal(here.impacts.velocity_after, -there.impacts.velocity_after)


def test_a_component_is_a_base_motion() -> None:
    for given in ((3.0, None), (ACROSS, 3.0), (BaseMotion(ACROSS), None), (None, ACROSS)):
        with pytest.raises(InputError, match="it must be a Motion"):
            BaseMotion(*given)


def test_in_si_a_motion_has_the_defaults_of_its_class() -> None:
    checked = 0
    for kind in (BandNoise, FourierSeries, Harmonic, Impulses, Pulse, SyntheticMotion):
        defaults = inspect.signature(kind).parameters
        for parameter in inspect.signature(kind.from_si).parameters.values():
            if parameter.name in defaults:
                assert parameter.default == defaults[parameter.name].default, f"{kind}: {parameter}"
                checked += 1
    assert checked > 10
