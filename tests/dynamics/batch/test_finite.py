"""Fates under base motions that end: each is how `simulate` ends."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

from rocksteady import (
    BaseMotion,
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    Piecewise,
    Pulse,
    Record,
    State,
    Status,
    Still,
    compute_fate_basins,
    simulate,
)
from rocksteady.dynamics.batch.finite import fate_of, finite_table, thrust
from rocksteady.dynamics.history.base_motion import base_acceleration
from rocksteady.errors import InputError, ModelError
from rocksteady.kernels.core.tables import ROW_SIDE
from rocksteady.kernels.machine_code.compilation import PYTHON, runner
from rocksteady.motions import FourierSeries, Impulses, Segment, add, cut
from tests.every import every

BLOCK = Block.rectangle(width=0.6, height=3.0, restitution=0.9)
ASYMMETRIC = Block.asymmetric(left=0.3, right=0.4, height=3.0, restitution=0.85)
T = 0.05 * np.arange(90)
RECORD = Record(
    acceleration_m_s2=3.0 * np.sin(5.0 * T) * np.exp(-0.3 * T) + 1.2 * np.sin(13.0 * T), dt_s=0.05
)
UP = Record(acceleration_m_s2=4.0 * np.sin(17.0 * T[:60]), dt_s=0.05)
PULSE = Pulse(shape="one-sine", amplitude=3.0, frequency_ratio=3.0)
STRUCK = Piecewise(
    pieces=(
        Segment(duration=1.0, jump=0.4, slope=1.0),
        Segment(duration=2.0, jump=-0.6, amplitude=2.0, frequency=3.0, phase=1.0),
    )
)
CASES: tuple[tuple[Any, Any, Any], ...] = (
    *((block, motion, model) for block in (BLOCK, ASYMMETRIC, BLOCK.against_wall(0.7))
      for motion in (RECORD, PULSE, STRUCK) for model in (Linear(), Nonlinear())),
    (BLOCK, BaseMotion(RECORD, UP), Nonlinear()),
    (ASYMMETRIC, BaseMotion(RECORD, UP.scaled(4.0)), Nonlinear()),
    (BLOCK, Still(), Nonlinear()),
    (DimensionlessBlock(restitution=0.8), Impulses(velocities=(0.5, -0.9), times=(0.0, 1.5)),
     Linear()),
    (DimensionlessBlock(restitution=0.8), add(PULSE, STRUCK, tolerance=1e-3), Linear()),
    (DimensionlessBlock(restitution=0.8, alpha_ratio=1.3, p_ratio=0.9), PULSE, Linear()),
    (DimensionlessBlock(restitution=0.0, one_sided=True), PULSE, Linear()),
    (DimensionlessBlock(restitution=0.9),
     cut(Harmonic(amplitude=1.5, frequency_ratio=2.0, phase=4.0), 10.0), Linear()),
)  # fmt: skip


@every("case", range(len(CASES)))
def test_the_fate_is_how_a_time_history_ends(case: int) -> None:
    block, motion, model = CASES[case]
    table, sides = finite_table(motion, block, model), model.sides(block)
    draw = np.random.default_rng(case)
    states = [
        (0.0, 0.0),
        (0.0, 0.7),
        *draw.uniform(-1.4, 1.4, (3 if runner() == PYTHON else 20, 2)),
    ]
    for u, v in states:
        angle, velocity = (abs(u), v) if block.one_sided else (u, v)
        found = fate_of(table, sides, float(angle), float(velocity))
        start = State(angle=float(angle), velocity=float(velocity))
        run = simulate(block, motion, start=start, model=model)
        side = int(run.rows[-1, ROW_SIDE]) if run.status is Status.OVERTURNED else 0
        assert (found.status, found.side, found.impacts) == (run.status, side, len(run.impacts))
        assert found.peak == pytest.approx(run.peak, rel=1e-14)


def test_a_base_that_falls_away_ends_as_lost_contact() -> None:
    dropped = BaseMotion(RECORD, UP.scaled(4.0))
    table = finite_table(dropped, BLOCK, Nonlinear())
    found = fate_of(table, Nonlinear().sides(BLOCK), 0.1, 0.0)
    assert found.status == Status.LOST_CONTACT
    assert found.side == 0


@every("moment", [0.7, 1.0, 2.3, 3.0])
def test_a_state_on_the_way_has_the_fate_of_the_whole_run(moment: float) -> None:
    block = DimensionlessBlock(restitution=0.8)
    table = finite_table(STRUCK, block, Linear(), time_pt=moment)
    for velocity in (-0.2, 0.05, 0.3):
        run = simulate(block, STRUCK, start=State(angle=0.1, velocity=velocity))
        if moment >= min(run.rest_time_pt or math.inf, run.end_time_pt):
            continue
        # An impulse at the moment itself acts on the state before it.
        here = run(np.nextafter(moment, 0.0))
        found = fate_of(table, Linear().sides(block), float(here.angle), float(here.velocity))
        assert found.status == run.status
        assert found.impacts <= len(run.impacts)


def test_from_the_start_on_the_table_is_that_of_the_motion() -> None:
    whole = finite_table(BaseMotion(RECORD, UP), BLOCK, Nonlinear())
    later = finite_table(BaseMotion(RECORD, UP), BLOCK, Nonlinear(), time_pt=1e-9)
    assert len(whole) == len(later)
    np.testing.assert_allclose(whole[1:], later[1:], rtol=1e-9, atol=0.0)
    ended = finite_table(RECORD, BLOCK, Nonlinear(), time_pt=1e5)
    assert len(ended) == 1


@pytest.mark.parametrize("rate", [1.0, 0.9])
def test_the_thrust_is_the_integral_of_the_acceleration(rate: float) -> None:
    table = finite_table(STRUCK, DimensionlessBlock(restitution=0.8), Linear())
    expected = 0.0
    for low, high in ((0.0, 1.0), (1.0, 3.0)):
        expected += quad(
            lambda s: float(base_acceleration(table, s)) * math.exp(-rate * s) * rate, low, high
        )[0]
    expected += rate * (0.4 - 0.6 * math.exp(-rate))
    assert thrust(table, rate) == pytest.approx(expected, rel=1e-9)


def test_the_thrust_of_a_fourier_series_is_too() -> None:
    waves = ((1, 1.0, 0.3), (3, 0.5, -1.1), (4, 0.2, 2.0))
    series = FourierSeries(amplitude=1.7, frequency_ratio=2.3, harmonics=waves, phase=0.9)
    table = finite_table(cut(series, 4.0), DimensionlessBlock(restitution=0.8), Linear())
    expected = quad(
        lambda s: float(base_acceleration(table, s)) * math.exp(-s), 0.0, 4.0, epsabs=1e-13
    )[0]
    assert thrust(table, 1.0) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("model", [Linear(), Nonlinear()])
def test_fates_under_a_series_that_ends_are_those_of_simulate(model: Linear | Nonlinear) -> None:
    waves = ((1, 1.0, 0.0), (2, 0.6, 0.7))
    series = FourierSeries(amplitude=1.6, frequency_ratio=2.0, harmonics=waves)
    motion = cut(series, 6.0)
    states = np.linspace(-0.9, 0.9, 5)
    found = compute_fate_basins(BLOCK, motion, angles=states, velocities=states, model=model)
    for row, velocity in enumerate(states.tolist()):
        for column, angle in enumerate(states.tolist()):
            start = State(angle=angle, velocity=velocity)
            run = simulate(BLOCK, motion, start=start, model=model)
            assert Status(int(found.fate[row, column])) is run.status
            assert found.peak[row, column] == pytest.approx(run.peak, rel=1e-12)


def test_a_motion_without_end_is_refused() -> None:
    for motion in (
        Harmonic(amplitude=1.0, frequency_ratio=2.0),
        Piecewise(pieces=(Segment(duration=math.inf, constant=0.5),)),
    ):
        with pytest.raises(InputError, match="cut"):
            finite_table(motion, BLOCK, Linear())
    with pytest.raises(ModelError, match="vertical"):
        finite_table(BaseMotion(RECORD, UP), BLOCK, Linear())
    with pytest.raises(InputError, match="time_pt"):
        finite_table(RECORD, BLOCK, Linear(), time_pt=-1.0)
