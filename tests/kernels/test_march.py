"""The march against 50 digits, against integrated differential equations, and against itself."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import brentq

from rocksteady.kernels.cells import NO_LIMIT
from rocksteady.kernels.march import (
    AT_REST,
    ENDED_BY_IMPACT,
    ENDED_BY_NO_RETURN,
    ENDED_BY_SPAN,
    ENDED_BY_UPLIFT,
    FREQUENCY,
    OVERTURNED,
    ROCKING,
    ROW_EVENT,
    ROW_HALF_CYCLES,
    ROW_PHASE,
    ROW_SIDE,
    UNDECIDED,
    March,
    clock,
    march,
)
from rocksteady.kernels.symmetric import (
    existence_amplitude,
    
    symmetric_orbit,
    symmetry_breaking,
)
from tests.kernels.tables import (
    Floats,
    Piece,
    Run,
    both_sides,
    exact_segments,
    harmonic,
    march_to,
    run,
    signs_hold,
    table,
)
from tests.oracles import exact_march, integrated_impacts, mp
from tests.strategies import PLAIN, logarithmic, sample_size

TWO_PI = 2.0 * math.pi

# --------------------------------------------------------------------------------- 50 digits

# Amplitude, frequency ratio, restitution, phase, velocity, cycles: all settle on periodic motion.
PERIODIC = [
    (2.0, 4.0, 0.8, 0.0, 0.3, 60),
    (2.0, 6.0, 0.8, 1.78, 0.64, 60),  # order 3
    (3.0, 8.0, 0.95, 2.88, 0.86, 60),  # order 3
    (2.0, 1.9, 0.8, 2.3, 0.5, 60),  # unsymmetric
    (1.3, 0.9, 0.6, 2.6, 0.2, 40),
    (6.0, 40.0, 0.7, 0.5, 0.1, 60),
    (4.0, 300.0, 0.9, 3.0, 0.01, 60),
    (0.6, 3.0, 0.85, 2.5, 0.2, 60),  # never enough to lift a block at rest
]


@pytest.mark.parametrize("case", PERIODIC, ids=str)
def test_impacts_lie_where_fifty_digits_put_them(
    case: tuple[float, float, float, float, float, int],
) -> None:
    amplitude, frequency, restitution, phase, velocity, cycles = case
    cycles = sample_size(cycles, min(cycles, 10))
    piece = Piece(amplitude=amplitude, frequency=frequency, phase=phase)
    ran = run(
        table(piece),
        both_sides(restitution),
        side=1,
        velocity=velocity,
        half_cycles=2 * cycles,
        rest_velocity=0.0,
    )
    exact = exact_march(
        exact_segments(piece),
        (2 * cycles * mp.pi) / mp.mpf(frequency),
        side=1,
        velocity=velocity,
        restitution=(mp.mpf(restitution),) * 2,
    )
    assert ran.status == ROCKING
    compare_with_exact(ran, exact.impacts)


def compare_with_exact(ran: Run, exact: list) -> None:  # type: ignore[type-arg]
    found = ran.impacts()
    assert len(found) == len(exact)
    assert len(found) > 5
    for (time, side, velocity), truth in zip(found, exact, strict=True):
        assert side == truth.side
        assert abs(time - truth.time) <= 1e-13 * truth.time
        assert abs(velocity - truth.velocity) <= 1e-12 * abs(truth.velocity)
