"""Outcomes of states: the side of a fall is that on which a run ends."""

import pytest

from rocksteady import DimensionlessBlock, Harmonic, Linear, State, simulate
from rocksteady.dynamics.edges._flow import Flow
from rocksteady.dynamics.edges._outcomes import Outcomes


@pytest.mark.parametrize(("angle", "word"), [(0.9, "positive"), (-0.9, "negative")])
def test_a_fall_is_named_after_its_side(angle: float, word: str) -> None:
    block, motion = DimensionlessBlock(restitution=0.8), Harmonic(amplitude=0.1, frequency_ratio=9)
    outcome = Outcomes(Flow(block, motion, Linear()), 20).of(angle, angle, 0.0)
    run = simulate(block, motion, start=State(angle=angle, velocity=angle), cycles=20)
    assert float(run(run.end_time_pt).angle) * angle > 1.0
    assert outcome.name == f"overturned to the {word} side"
    assert outcome.number * angle > 0.0
