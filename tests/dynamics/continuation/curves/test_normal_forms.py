"""Derivatives of the matrix of a chain in directions of its phases, and signs of coefficients."""

import numpy as np
import pytest

from rocksteady import DimensionlessBlock, Harmonic, find_orbits
from rocksteady.dynamics.continuation.chains.chain import Chain
from rocksteady.dynamics.continuation.curves._normal_forms import _bent, fold_coefficient
from rocksteady.dynamics.continuation.from_orbit import chain_at


def chain_with(impacts: int) -> Chain:
    block = DimensionlessBlock(restitution=0.8)
    motion = Harmonic(amplitude=3.0, frequency_ratio=4.2)
    chains = map(chain_at, find_orbits(block, motion, max_period=3, max_impacts=6))
    return next(chain for chain in chains if chain.impacts == impacts)


@pytest.mark.parametrize("impacts", [1, 2])
def test_the_matrix_bends_as_differences_of_two_steps_say(impacts: int) -> None:
    chain = chain_with(impacts)
    along = np.array([0.6, -0.8])[:impacts]

    def slope(step: float) -> np.ndarray:
        ahead, behind = (
            chain.moved(chain.phases + sign * step * along, chain.parameters).matrix(1.0)
            for sign in (1.0, -1.0)
        )
        difference: np.ndarray = (ahead - behind) / (2.0 * step)
        return difference

    # Richardson's extrapolation of central differences.
    expected = (4.0 * slope(5e-4) - slope(1e-3)) / 3.0
    assert _bent(chain, along) == pytest.approx(expected, rel=1e-7, abs=1e-7)
    assert fold_coefficient(chain, along) == -fold_coefficient(chain, -along) != 0.0
