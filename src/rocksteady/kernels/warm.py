"""Compile every kernel that the package calls, so that later processes load it from disk.

``python -m rocksteady.kernels.warm`` takes a minute or two, once for each version of the
sources, and next to nothing from then on.  Test workers started before it would each compile their
own.  Each kernel that Python calls belongs into `warm`, with the types that it is called with.
"""

import logging
import math
import time

import numpy as np

from rocksteady.kernels.batch.attractors import (
    REAL_COLUMNS,
    WHOLE_COLUMNS,
    fill_clocks,
    settle_cells,
)
from rocksteady.kernels.batch.harmonic import fates_of_sides, harmonic_segment
from rocksteady.kernels.batch.pulses import pulse_fates
from rocksteady.kernels.batch.records import record_fates
from rocksteady.kernels.core.clock import clock, segment_start
from rocksteady.kernels.core.tables import (
    DURATION,
    ROW_COLUMNS,
    SEGMENT_COLUMNS,
    March,
    is_nonlinear,
)
from rocksteady.kernels.lanes.driver import lane_fates
from rocksteady.kernels.machine_code.compilation import cache_folder
from rocksteady.kernels.march.march import march
from rocksteady.kernels.march.replay import (
    fill_states,
    last_crossing,
    peaks_until_overturning,
    recorded_peaks,
)
from rocksteady.kernels.nonlinear.drive import jump_share
from rocksteady.kernels.orbits.chains import (
    CHAIN_COLUMNS,
    fill_arcs,
    fill_chain,
    fill_matrix,
    side_of,
    turned_over,
)
from rocksteady.kernels.orbits.closed_form import (
    fill_curves,
    fill_half_cycle,
    fill_steady,
    half_cycle_jacobian,
    symmetric_orbit,
    symmetry_breaking,
)
from rocksteady.kernels.orbits.periodic import (
    ORBIT_COLUMNS,
    fill_peaks,
    is_symmetric,
    loss,
    measured,
    mirror,
    multipliers,
    polish,
    put,
    search,
    state_at,
)
from rocksteady.kernels.orbits.return_map import (
    guess_after,
    highest_after,
    make_system,
    next_passage,
    phase_between,
    uplift_after,
)
from rocksteady.kernels.orbits.settle import GENERIC, MEMORY, Stretch, settle, stretched
from rocksteady.kernels.orbits.symmetric_nonlinear import symmetric_from

logger = logging.getLogger(__name__)


def warm() -> None:
    """Call each kernel that Python calls, once, with the types that the package passes."""
    one = np.ones(1)
    whole = np.ones(1, dtype=np.int64)
    fill_steady(
        2.0 * one,
        4.0 * one,
        0.8 * one,
        whole,
        True,
        np.zeros(1, dtype=np.int64),
        np.zeros((3, 1)),
        np.zeros((2, 1)),
        np.zeros((2, 1)),
        np.zeros((2, 1)),
        np.zeros((2, 1)),
        np.zeros((2, 1), dtype=np.int64),
        np.zeros((2, 1), dtype=np.bool_),
    )
    orbit = symmetric_orbit(2.0, 4.0, 0.8, 1, 1)
    symmetry_breaking(4.0, 0.8, 1)
    fill_curves(4.0 * one, 0.8 * one, whole, np.zeros((5, 1)))
    fill_half_cycle(2.0, 4.0, 1, orbit, np.zeros(1), np.zeros((2, 1)))
    half_cycle_jacobian(2.0, 4.0, 0.8, 1, orbit)

    segments = np.zeros((1, SEGMENT_COLUMNS))
    harmonic_segment(segments, 2.0, 4.0, orbit.phase)
    segment_start(segments, 0)
    sides = np.array([(0.8, 1.0, 1.0), (0.8, 1.0, 1.0)])
    is_nonlinear(sides)
    half, phase = clock(orbit.phase)
    start = March(1, 0.0, 4.0 * orbit.velocity, 0, half, phase, 0, 0)
    rows = np.zeros((0, ROW_COLUMNS))
    peaks = np.zeros(0)
    _, end = march(segments, sides, start, half + 2, phase, math.inf, 100, rows, peaks)
    rows = np.zeros((end.flights, ROW_COLUMNS))
    march(segments, sides, start, half + 2, phase, math.inf, 100, rows, peaks)
    fill_states(segments, sides, rows, np.zeros(1, dtype=np.int64), np.zeros(1), np.zeros((3, 1)))
    recorded_peaks(segments, sides, rows, 0.1)
    peaks_until_overturning(segments, sides, rows)
    last_crossing(segments, sides, rows, 0.1)
    fates_of_sides(
        2.0 * one,
        4.0 * one,
        sides[np.newaxis],
        0.0 * one,
        0.3 * one,
        0.0 * one,
        2,
        100,
        np.zeros(1, dtype=np.int64),
        np.zeros(1, dtype=np.int64),
        np.zeros((1, 3)),
    )
    lane_fates(
        2.0 * one,
        4.0 * one,
        0.8 * one,
        0.0 * one,
        0.3 * one,
        0.0 * one,
        2,
        True,
        100,
        np.zeros(1, dtype=np.int64),
        np.zeros(1, dtype=np.int64),
        np.zeros((1, 3)),
    )
    record_fates(
        np.zeros((1, SEGMENT_COLUMNS)),
        sides[np.newaxis],
        one,
        100,
        np.zeros(1, dtype=np.int64),
        np.zeros(1, dtype=np.int64),
        np.zeros((1, 2)),
    )
    pulse = np.zeros((1, SEGMENT_COLUMNS))
    pulse[0, DURATION] = 1.0
    pulse_fates(
        pulse,
        sides,
        one,
        one,
        math.inf,
        100,
        np.zeros(1, dtype=np.int64),
        np.zeros(1, dtype=np.int64),
        np.zeros(1, dtype=np.int64),
        np.zeros(1, dtype=np.int64),
        np.zeros(1),
    )

    system = make_system(2.0, 4.0, sides)
    memory, table = np.zeros((MEMORY, ORBIT_COLUMNS)), np.zeros((MEMORY, ORBIT_COLUMNS))
    settle(system, 0, 0, 0.0, 0.0, 0.0, 50, memory, table)
    fill_clocks(one, np.zeros(1, dtype=np.int64), np.zeros(1))
    settle_cells(
        2.0 * one,
        4.0 * one,
        sides[np.newaxis],
        0 * whole,
        0.0 * one,
        0.0 * one,
        0 * whole,
        0.0 * one,
        50,
        np.zeros((1, WHOLE_COLUMNS), dtype=np.int64),
        np.zeros((1, REAL_COLUMNS)),
    )
    room = np.zeros((4, 2), dtype=np.int64)
    search(system, phase + 0.0 * one, 2.93 * one, 2, 1, True, table, np.zeros((4, 2)), room, 0)
    state = state_at(table, 0)
    fixed = polish(system, state, 2, 1, table)
    put(table, 1, mirror(state, 1))
    fill_peaks(system, 2, table)
    measured(system, 2, 1, table)
    is_symmetric(system, table, 2, 1)
    multipliers(fixed.jacobian, loss(system, state.side, 2, fixed.rests))
    step = next_passage(system, state, -1.0)
    phase_between(state, step.state)
    highest_after(system, state, step)
    guess_after(uplift_after(system, 0, 0.0))
    stretched(Stretch(GENERIC[0], GENERIC[1], 0.0, 0), step.jacobian)

    slender = np.hstack([sides, np.full((2, 1), 0.1), np.full((2, 1), 1e-15)])
    symmetric_from(2.0, 4.0, slender, 1, 1, state)
    jump_share(slender, 1, 0.0)

    turns, phases, chain = 0 * whole, orbit.phase * one, np.zeros((1, CHAIN_COLUMNS))
    fill_chain(2.0, 4.0, sides, turns, phases, 1, chain)
    fill_matrix(chain, 1.0, np.zeros((1, 1)))
    fill_arcs(system, turns, phases, chain, np.zeros((1, 3)))
    turned_over(chain)
    side_of(0)


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    began = time.perf_counter()
    warm()
    logger.info("kernels ready in %s (%.1f s)", cache_folder(), time.perf_counter() - began)
