"""The growth of small differences along a run, against runs that begin a little apart."""

import math

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Piecewise,
    Samples,
    Segment,
    State,
    Steady,
    Still,
    find_steady_states,
    simulate,
)
from rocksteady.model.equations import Nonlinear
from rocksteady.model.motions.segments import Motion

BARE = DimensionlessBlock(restitution=0.8)
ASYMMETRY = DimensionlessBlock(restitution=0.8, alpha_ratio=1.4, p_ratio=0.9)
PIECES = (
    Segment(duration=1.0, constant=0.5),
    Segment(duration=0.7, constant=-1.2, slope=0.3),
    Segment(duration=2.0, amplitude=2.0, frequency=5.0),
)
MOTIONS: dict[str, tuple[DimensionlessBlock, Motion]] = {
    "harmonic": (BARE, Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=0.3)),
    "asymmetric": (ASYMMETRY, Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=0.3)),
    "piecewise": (BARE, Piecewise(pieces=PIECES)),
    "still": (BARE, Still()),
}


def states(motions: Samples) -> np.ndarray:
    return np.array([motions.angle, motions.velocity])


@pytest.mark.parametrize("name", MOTIONS)
def test_growth_is_that_of_runs_that_begin_a_little_apart(name: str) -> None:
    block, motion = MOTIONS[name]
    start, h = (0.1, 0.2), 1e-8
    begun = State(angle=0.1, velocity=0.2)
    run = simulate(block, motion, start=begun, cycles=5.3, max_flights=12)
    at = run.impacts.pt + 1e-4
    columns = []
    for shift in ((h, 0.0), (0.0, h)):
        ends = [
            simulate(
                block,
                motion,
                start=State(angle=start[0] + sign * shift[0], velocity=start[1] + sign * shift[1]),
                cycles=5.3,
            )(at)
            for sign in (1.0, -1.0)
        ]
        columns.append((states(ends[0]) - states(ends[1])) / (2.0 * h))
    largest = np.sqrt((np.array(columns) ** 2).sum(axis=(0, 1))).max()
    assert run.growth == pytest.approx(largest, rel=5e-3)


def test_from_an_unstable_orbit_it_is_the_power_of_its_multiplier() -> None:
    point = find_steady_states(1.0, 2.0, 0.8)
    branch = next(b for b in (0, 1) if point.admissible[b] and not point.stable[b])  # type: ignore[index]
    trace = abs(float(point.trace[branch]))
    multiplier = 0.5 * (trace + math.sqrt(trace**2 - 4.0 * 0.8**2))
    motion = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    start = Steady(branch=branch + 1, kick=1e-12)
    few, many = (simulate(BARE, motion, start=start, cycles=cycles).growth for cycles in (2, 3))
    assert few is not None
    assert many is not None
    assert many / few == pytest.approx(multiplier**2, rel=1e-3)


def test_a_rest_forgets_and_a_nonlinear_run_has_none() -> None:
    still = simulate(BARE, Still(), start=State(angle=0.0, velocity=0.0))
    assert still.growth == 1.0
    block = Block.rectangle(width=0.4, height=1.2)
    run = simulate(block, Still(), start=State(angle=0.1, velocity=0.0), model=Nonlinear())
    assert run.growth is None
