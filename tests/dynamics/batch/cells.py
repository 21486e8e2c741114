"""Random cells: blocks of both models with equal and unequal sides, shaken and started anyhow."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rocksteady import Block, DimensionlessBlock, Harmonic, State
from rocksteady.model.equations import Linear, Model
from tests.dynamics.asymmetric import random_block

Floats = NDArray[np.float64]
AnyBlock = Block | DimensionlessBlock


@dataclass(frozen=True)
class Cells:
    """Cells one by one, by the public constructors, and as the arrays of a batch."""

    model: Model
    blocks: list[AnyBlock]
    shakings: list[Harmonic]
    starts: list[State]

    @property
    def amplitude(self) -> Floats:
        return np.array([one.amplitude for one in self.shakings])

    @property
    def frequency_ratio(self) -> Floats:
        return np.array([one.frequency_ratio for one in self.shakings])

    @property
    def phase(self) -> Floats:
        return np.array([one.phase for one in self.shakings])

    @property
    def angle(self) -> Floats:
        return np.array([one.angle for one in self.starts])

    @property
    def velocity(self) -> Floats:
        return np.array([one.velocity for one in self.starts])

    @property
    def sides(self) -> Floats:
        return np.array([self.model.sides(one) for one in self.blocks])

    def __len__(self) -> int:
        return len(self.blocks)


def random_cells(seed: int, model: Model, count: int) -> Cells:
    """Return cells of which about half have equal sides, and a third start upright.

    Some shaking is too weak for uplift, and some restitutions are so low that motions rest in every
    period.
    """
    rng = np.random.default_rng(seed)
    blocks: list[AnyBlock] = []
    shakings, starts = [], []
    for at in range(count):
        restitution = rng.uniform(0.3, 0.95)
        if at % 2:
            block: AnyBlock = random_block(rng)
        elif isinstance(model, Linear):
            block = DimensionlessBlock(restitution=restitution)
        else:
            block = Block.from_p(alpha=rng.uniform(0.05, 0.4), p=2.0, restitution=restitution)
        blocks.append(block)
        ratio = rng.uniform(1.0, 7.0)
        amplitude = rng.uniform(0.3, 1.0 + 0.6 * ratio)
        phase = rng.uniform(-9.0, 9.0)
        shakings.append(Harmonic(amplitude=amplitude, frequency_ratio=ratio, phase=phase))
        angle, velocity = rng.uniform(-0.4, 0.4, 2)
        upright, still = (at % 3 == 0), (at % 6 == 0)
        starts.append(
            State(angle=0.0 if upright else angle, velocity=0.0 if still else 0.5 * velocity)
        )
    return Cells(model=model, blocks=blocks, shakings=shakings, starts=starts)
