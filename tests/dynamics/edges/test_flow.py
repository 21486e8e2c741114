"""The flow forward and backward between two phases."""

import math

import numpy as np
import pytest

from rocksteady import Block, DimensionlessBlock, Harmonic, Linear, Nonlinear, State, simulate
from rocksteady.dynamics.edges._flow import Flow
from rocksteady.errors import ModelError
from rocksteady.model.equations import Model
from tests.every import every

TURN = 2.0 * math.pi

CASES = [
    (DimensionlessBlock(restitution=0.8), Linear()),
    (DimensionlessBlock(restitution=1.0), Linear()),
    (DimensionlessBlock(restitution=0.9, alpha_ratio=1.2, p_ratio=0.9), Linear()),
    (DimensionlessBlock(restitution=0.8, one_sided=True), Linear()),
    (Block.from_p(alpha=0.3, p=2.0, restitution=0.85), Nonlinear(tolerance=1e-12)),
]


@every(("block", "model"), CASES)
def test_backward_undoes_forward(block: Block | DimensionlessBlock, model: Model) -> None:
    motion = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    forward = Flow(block, motion, model)
    backward = Flow(block, motion, model, backward=True)
    generator = np.random.default_rng(5)
    followed = 0
    for _ in range(60):
        u, v = generator.uniform(-0.4, 0.4, 2).tolist()
        u = abs(u) if block.one_sided else u
        begin = generator.uniform(0.0, 6.0)
        end = begin + 0.8 * TURN
        there = forward.carried(u, v, begin, end)
        back = backward.carried(there.angle, there.velocity, end, begin)
        if there.impacts == 0 or there.rested or back.impacts != there.impacts:
            continue  # a chatter that has come to rest on the way has no past
        followed += 1
        assert (back.angle, back.velocity) == pytest.approx((u, v), abs=1e-9)
    assert followed > 30


def test_a_falling_block_is_followed_beyond_the_proof_of_its_fall() -> None:
    # Seen by the trajectory, which draws falls, at the same time.
    block, motion = (
        DimensionlessBlock(restitution=0.8),
        Harmonic(amplitude=0.5, frequency_ratio=9.0),
    )
    reached = Flow(block, motion, Linear()).carried(0.9, 0.4, 0.0, TURN)
    run = simulate(block, motion, start=State(angle=0.9, velocity=0.4), cycles=3)
    seen = run(TURN / 9.0)
    assert reached.fallen
    assert (reached.angle, reached.velocity) == pytest.approx(
        (float(seen.angle), float(seen.velocity)), abs=1e-13
    )


def test_states_after_impacts_are_those_of_a_run() -> None:
    block, motion = (
        DimensionlessBlock(restitution=0.8),
        Harmonic(amplitude=2.0, frequency_ratio=4.0),
    )
    run = simulate(block, motion, start=State(angle=0.1, velocity=0.2), cycles=4)
    flow = Flow(block, motion, Linear())
    for count in (1, 2, 3):
        found = flow.after(0.1, 0.2, 0.0, count, longest=10.0 * TURN)
        assert found.velocity == pytest.approx(
            float(run.impacts.velocity_after[count - 1]), abs=1e-14
        )
        assert found.phase == pytest.approx(4.0 * float(run.impacts.pt[count - 1]), abs=1e-12)


@every("restitution", [0.0, 0.5])
def test_off_a_wall_a_velocity_into_it_is_one_away_from_it(restitution: float) -> None:
    block = DimensionlessBlock(restitution=restitution, one_sided=True)
    flow = Flow(block, Harmonic(amplitude=2.0, frequency_ratio=4.0), Linear())
    away, into = (flow.carried(0.0, velocity, 0.5, 1.5) for velocity in (0.3, -0.3))
    assert away == into
    assert away.angle > 0.0


def test_an_impact_that_stops_the_block_cannot_be_undone() -> None:
    block = DimensionlessBlock(restitution=0.0, one_sided=True)
    with pytest.raises(ModelError, match="restitution above 0"):
        Flow(block, Harmonic(amplitude=1.0, frequency_ratio=2.0), Linear(), backward=True)
