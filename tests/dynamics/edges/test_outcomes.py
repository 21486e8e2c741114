"""Outcomes of states: the side of a fall is that on which a run ends."""

from dataclasses import replace

import pytest

from rocksteady import DimensionlessBlock, Harmonic, Linear, State, find_orbits, simulate
from rocksteady.dynamics.edges._flow import Flow
from rocksteady.dynamics.edges._outcomes import TURN, Outcomes


@pytest.mark.parametrize(("angle", "word"), [(0.9, "positive"), (-0.9, "negative")])
def test_a_fall_is_named_after_its_side(angle: float, word: str) -> None:
    block, motion = DimensionlessBlock(restitution=0.8), Harmonic(amplitude=0.1, frequency_ratio=9)
    outcome = Outcomes(Flow(block, motion, Linear()), 20).of(angle, angle, 0.0)
    run = simulate(block, motion, start=State(angle=angle, velocity=angle), cycles=20)
    assert float(run(run.end_time_pt).angle) * angle > 1.0
    assert outcome.name == f"overturned to the {word} side"
    assert outcome.number * angle > 0.0


def test_an_orbit_is_one_that_was_seen_whichever_side_of_a_period_its_phase_is_on() -> None:
    block, motion = DimensionlessBlock(restitution=0.8), Harmonic(amplitude=3, frequency_ratio=4.2)
    orbit = next(each for each in find_orbits(block, motion, max_period=1) if each.stable)
    seen = Outcomes(Flow(block, motion, Linear()), 20)
    (first, *more) = orbit.states

    def moved(phase: float, speed: float = first.speed) -> int:
        state = replace(first, phase=phase, speed=speed)
        return seen._number(replace(orbit, states=(state, *more[:0])))

    assert (moved(1e-13), moved(TURN - 1e-13), moved(3.0), moved(3.0 + 1e-13)) == (1, 1, 2, 2)
    assert (moved(3.0, first.speed + 1.0), moved(1e-13)) == (3, 1)
    assert seen._number(replace(orbit, period=7)) == 4
