"""Arrays of initial states: each what `dynamics.history.start` makes of it alone."""

import math
from dataclasses import replace

import numpy as np

from rocksteady import Block, DimensionlessBlock, Harmonic, Steady
from rocksteady.dynamics.batch.initial_states import at_phases, on_orbits
from rocksteady.dynamics.history.start import initial_march
from rocksteady.errors import ModelError
from rocksteady.model.equations import Linear, Model, Nonlinear
from tests.dynamics.batch.cells import random_cells
from tests.every import every

models = every("model", [Linear(), Nonlinear()])


@models
def test_states_at_phases_are_those_of_single_motions(model: Model) -> None:
    cells = random_cells(3, model, 200)
    begin = at_phases(cells.angle, cells.velocity, cells.phase)
    for at, (block, shaking, start) in enumerate(
        zip(cells.blocks, cells.shakings, cells.starts, strict=True)
    ):
        _, alone = initial_march(start, block.dimensionless(), shaking, model.sides(block))
        assert (begin.side[at], begin.half_cycles[at]) == (alone.side, alone.half_cycles)
        assert (begin.angle[at], begin.velocity[at]) == (alone.angle, alone.velocity)
        assert begin.phase[at] == alone.phase
    assert set(begin.side.tolist()) == {-1, 0, 1}


def test_a_phase_is_half_periods_and_a_rest_below_pi() -> None:
    phase = np.array([0.0, 1.0, -1.0, math.pi, -math.pi, 100.0, -1e4])
    begin = at_phases(np.zeros(7), np.full(7, -0.0), phase)
    assert ((begin.phase >= 0.0) & (begin.phase < math.pi)).all()
    np.testing.assert_allclose(math.pi * begin.half_cycles + begin.phase, phase, atol=1e-12)
    assert not np.signbit(begin.velocity).any()


@models
@every("start", [Steady(), Steady(branch=2, side=-1), Steady(branch=1, order=3, side=-1)])
def test_states_on_orbits_are_those_of_single_motions(model: Model, start: Steady) -> None:
    rng = np.random.default_rng(11)
    count = 60
    amplitude, ratio = rng.uniform(0.2, 6.0, count), rng.uniform(0.8, 8.0, count)
    kick = 10.0 ** rng.uniform(-7.0, -1.0, count)
    blocks = [
        DimensionlessBlock(restitution=restitution)
        if isinstance(model, Linear)
        else Block.from_p(alpha=rng.uniform(0.01, 0.3), p=2.0, restitution=restitution)
        for restitution in rng.uniform(0.4, 0.99, count)
    ]
    sides = np.array([model.sides(block) for block in blocks])
    velocity, phase, there = on_orbits(start, kick, amplitude, ratio, sides)
    for at, block in enumerate(blocks):
        one = replace(start, kick=kick.item(at))
        shaking = Harmonic(amplitude=amplitude.item(at), frequency_ratio=ratio.item(at))
        try:
            moved, alone = initial_march(one, block.dimensionless(), shaking, sides[at])
        except ModelError:
            assert (there[at], velocity[at], phase[at]) == (False, 0.0, 0.0)
            continue
        assert isinstance(moved, Harmonic)
        assert there[at]
        assert (velocity[at], phase[at]) == (alone.velocity, moved.phase)
    assert 0 < np.count_nonzero(there) < count
