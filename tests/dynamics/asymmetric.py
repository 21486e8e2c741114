"""Blocks whose sides differ, for the tests of time histories and of all that is built on them."""

from dataclasses import replace

import numpy as np

from rocksteady import Block, DimensionlessBlock, Harmonic

BLOCK = Block.asymmetric(left=0.15, right=0.25, height=1.2)
BARE = BLOCK.dimensionless()
ASYMMETRY = DimensionlessBlock(
    restitution=0.85, negative_restitution=0.75, alpha_ratio=1.3, p_ratio=0.95
)
HARD = Harmonic(amplitude=2.0, frequency_ratio=4.0)


def random_block(rng: np.random.Generator) -> Block:
    """Return a block of any offset, moment of inertia and restitutions, also against its own."""
    return Block.asymmetric(
        left=float(rng.uniform(0.05, 0.4)),
        right=float(rng.uniform(0.05, 0.4)),
        height=float(rng.uniform(1.0, 4.0)),
        gyration=float(rng.uniform(0.1, 1.0)),
        restitution=(float(rng.uniform(0.6, 0.98)), float(rng.uniform(0.6, 0.98))),
    )


def mirrored(block: Block) -> Block:
    """Return a block with its sides exchanged."""
    return replace(block, positive=block.negative, negative=block.positive)
