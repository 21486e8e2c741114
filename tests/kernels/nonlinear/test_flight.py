"""Flights of the nonlinear model up to the end of a run."""

import math

import numpy as np

from rocksteady.kernels.batch.harmonic import fates_of_sides
from rocksteady.kernels.core.tables import OVERTURNED, ROCKING
from tests.strategies import sample_size

ALPHA = 0.3


def test_a_run_that_ends_beyond_the_point_of_no_return_has_overturned() -> None:
    """The verdict at the end of a run is that of its state, however the steps fall."""
    cells = sample_size(4000, 20)
    rng = np.random.default_rng(2011)
    amplitude, ratio = rng.uniform(3.0, 9.0, cells), rng.uniform(1.0, 6.0, cells)
    still, velocity = np.zeros(cells), rng.normal(0.0, 0.5, cells)
    sides = np.tile([0.8, 1.0, 1.0, ALPHA, 1e-15], (cells, 2, 1))
    status, impacts = np.zeros(cells, dtype=np.int64), np.zeros(cells, dtype=np.int64)
    final = np.empty((cells, 3))
    fates_of_sides(
        amplitude, ratio, sides, still, velocity, still, 2, 10**6, status, impacts, final
    )
    lost_from = 1.0 + np.arctan(ALPHA * amplitude) / ALPHA
    onwards = final[:, 0] * final[:, 1] >= 0.0
    beyond = (np.abs(final[:, 0]) > lost_from) & onwards & (status == ROCKING)
    assert not beyond.any()
    assert np.abs(final[status == ROCKING, 0]).max(initial=0.0) < 0.5 * math.pi / ALPHA
    if cells > 100:
        assert min(np.count_nonzero(status == code) for code in (ROCKING, OVERTURNED)) > 1000
