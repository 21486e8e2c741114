"""The kernels that Python calls: the functions of the library.

Their annotations state the types of a call (`kernels.machine_code.types`).  Kernels that only other
kernels call are not listed.  ``python -m rocksteady.kernels.entries`` compiles all of them with
numba, which takes some minutes the first time, and keeps the machine code on disk.
"""

import logging
import time
from typing import Any

from rocksteady.kernels.batch.attractors import fill_clocks, settle_cells, settle_series_cells
from rocksteady.kernels.batch.harmonic import fates_of_sides, harmonic_segment, series_fates
from rocksteady.kernels.batch.pulses import pulse_fates
from rocksteady.kernels.batch.records import record_fates
from rocksteady.kernels.batch.waiting import fill_hardest
from rocksteady.kernels.core.clock import clock, segment_start
from rocksteady.kernels.core.tables import is_nonlinear
from rocksteady.kernels.elementary.loops import (
    fill_acos,
    fill_asin,
    fill_asinh,
    fill_atan,
    fill_atan2,
    fill_cos,
    fill_cosh,
    fill_exp,
    fill_expm1,
    fill_hypot,
    fill_log,
    fill_log1p,
    fill_next_up,
    fill_sin,
    fill_sinh,
    fill_tan,
    fill_tanh,
)
from rocksteady.kernels.lanes.driver import lane_fates
from rocksteady.kernels.lanes.settling import lane_attractors
from rocksteady.kernels.linear.oscillator import fill_oscillator
from rocksteady.kernels.machine_code.compilation import Kernel, cache_folder
from rocksteady.kernels.march.march import march
from rocksteady.kernels.march.replay import (
    fill_states,
    last_crossing,
    peaks_until_overturning,
    recorded_peaks,
)
from rocksteady.kernels.nonlinear.drive import jump_share
from rocksteady.kernels.nonlinear_lanes.loop import nonlinear_lane_fates
from rocksteady.kernels.orbits.bounces import chatter_end
from rocksteady.kernels.orbits.chains import (
    fill_arcs,
    fill_chain,
    fill_matrix,
    series_fill_arcs,
    series_fill_chain,
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
    next_passage,
    phase_between,
    uplift_after,
)
from rocksteady.kernels.orbits.series_map import (
    series_fill_peaks,
    series_highest_after,
    series_is_symmetric,
    series_loss,
    series_measured,
    series_next_passage,
    series_polish,
    series_search,
    series_settle,
    series_uplift_after,
)
from rocksteady.kernels.orbits.settle import settle, stretched
from rocksteady.kernels.orbits.symmetric_nonlinear import symmetric_from
from rocksteady.kernels.orbits.systems import fill_uplifts, make_system

logger = logging.getLogger(__name__)

_KERNELS: tuple[Any, ...] = (
    # Batches.
    fates_of_sides,
    series_fates,
    lane_fates,
    nonlinear_lane_fates,
    settle_cells,
    settle_series_cells,
    lane_attractors,
    fill_clocks,
    record_fates,
    fill_hardest,
    pulse_fates,
    harmonic_segment,
    fill_oscillator,
    # Time histories.
    march,
    fill_states,
    last_crossing,
    peaks_until_overturning,
    recorded_peaks,
    clock,
    segment_start,
    is_nonlinear,
    jump_share,
    # Steady states.
    fill_steady,
    fill_curves,
    fill_half_cycle,
    half_cycle_jacobian,
    symmetric_orbit,
    symmetric_from,
    symmetry_breaking,
    # The return map and its orbits.
    make_system,
    fill_uplifts,
    next_passage,
    uplift_after,
    chatter_end,
    guess_after,
    highest_after,
    phase_between,
    settle,
    stretched,
    search,
    polish,
    measured,
    multipliers,
    loss,
    fill_peaks,
    is_symmetric,
    mirror,
    put,
    state_at,
    # The same under a Fourier series.
    series_next_passage,
    series_uplift_after,
    series_highest_after,
    series_settle,
    series_search,
    series_polish,
    series_measured,
    series_loss,
    series_fill_peaks,
    series_is_symmetric,
    # Continuation.
    fill_chain,
    fill_matrix,
    fill_arcs,
    series_fill_chain,
    series_fill_arcs,
    side_of,
    turned_over,
    # Elementary functions over arrays.
    fill_exp,
    fill_expm1,
    fill_log,
    fill_log1p,
    fill_sin,
    fill_cos,
    fill_tan,
    fill_asin,
    fill_acos,
    fill_atan,
    fill_sinh,
    fill_cosh,
    fill_tanh,
    fill_asinh,
    fill_next_up,
    fill_atan2,
    fill_hypot,
)
ENTRIES: dict[str, Any] = {kernel.__name__: kernel for kernel in _KERNELS}
"""By name; each a `Kernel`, or with compilation switched off the function itself."""


def warm() -> None:
    """Compile every entry by numba, or load it from disk."""
    for kernel in ENTRIES.values():
        if isinstance(kernel, Kernel):
            kernel.compile()


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    began = time.perf_counter()
    warm()
    logger.info("kernels ready in %s (%.1f s)", cache_folder(), time.perf_counter() - began)
