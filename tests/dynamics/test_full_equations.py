"""The outcome in the full equations beside that of the linear model."""

import math

import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Nonlinear,
    Pulse,
    State,
    Steady,
    simulate,
)
from rocksteady.dynamics.history.neighbours import full_run

BLOCK = Block.rectangle(width=0.4, height=2.0)


def shaken(accel_g: float, frequency_hz: float) -> Harmonic:
    return Harmonic.from_si(
        BLOCK, acceleration_m_s2=accel_g * BLOCK.gravity, frequency_hz=frequency_hz
    )


def test_a_run_of_the_linear_model_names_what_the_full_equations_do() -> None:
    linear = simulate(BLOCK, shaken(0.4, 1.0))
    fact = full_run(linear)
    full = simulate(BLOCK, shaken(0.4, 1.0), model=Nonlinear())
    assert linear.overturn_time_s == pytest.approx(3.54, abs=0.005)
    assert full.overturn_time_s == pytest.approx(1.92, abs=0.005)
    assert fact.value["overturn_time_s"] == full.overturn_time_s
    assert fact.text == "falls 1.92 s into the motion"
    # Of other starts too: the phase of a steady one is that of the run.
    for start in (Steady(), State(angle=0.3, velocity=-0.2)):
        run = simulate(BLOCK, shaken(0.4, 2.0), start=start, cycles=60)
        first = State(angle=run(0.0).angle.item(), velocity=run(0.0).velocity.item())
        other = simulate(BLOCK, run.motion, start=first, cycles=60, model=Nonlinear())
        values = full_run(run).value
        assert (values["status"], values["peak"]) == (other.status.label, other.peak)


def test_where_the_answer_is_of_the_full_equations_or_has_none_nothing_stands_beside_it() -> None:
    bare = DimensionlessBlock(restitution=0.9)
    harmonic = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    pulse = Pulse(shape="one-sine", amplitude=1.5, frequency_ratio=4.0)
    for run in (
        simulate(bare, harmonic),
        simulate(BLOCK, shaken(0.4, 1.0), model=Nonlinear()),
        simulate(BLOCK, pulse),
    ):
        assert full_run(run).value is None
        assert not full_run(run).label
        assert "full equations" not in run.summary()
    assert "in the full equations it may end otherwise" in simulate(BLOCK, harmonic).summary()


def test_a_long_run_is_followed_for_a_thousand_periods() -> None:
    motion = shaken(0.2, 5.0)
    run = simulate(BLOCK, motion, start=Steady(), cycles=3000)
    assert math.isclose(run.end_time_pt * motion.frequency_ratio, 6000.0 * math.pi)
    assert f"{1000.0 / 5.0:g} s into the motion" in full_run(run).text
