"""The kernels that Python calls: the functions of the library.

Their annotations state the types of a call (`kernels.machine_code.types`).  Kernels that only other
kernels call are not listed.
"""

from typing import Any

from rocksteady.kernels.batch import attractors, base_forces, harmonic, pulses, records, waiting
from rocksteady.kernels.core import clock, motions, tables
from rocksteady.kernels.elementary import loops
from rocksteady.kernels.lanes import driver, settling
from rocksteady.kernels.linear import oscillator
from rocksteady.kernels.march import facts, march, replay
from rocksteady.kernels.march.forces import largest_forces
from rocksteady.kernels.nonlinear import drive
from rocksteady.kernels.nonlinear_lanes import loop
from rocksteady.kernels.nonlinear_lanes import settling as nonlinear_settling
from rocksteady.kernels.orbits import (
    bounces,
    chains,
    closed_form,
    periodic,
    return_map,
    settle,
    symmetric_nonlinear,
    systems,
)

_KERNELS: tuple[Any, ...] = (
    # Batches.
    harmonic.fates_of_sides,
    harmonic.series_fates,
    driver.lane_fates,
    loop.nonlinear_lane_fates,
    attractors.settle_cells,
    attractors.settle_series_cells,
    settling.lane_attractors,
    nonlinear_settling.nonlinear_lane_attractors,
    attractors.fill_clocks,
    records.record_fates,
    base_forces.record_forces,
    waiting.fill_hardest,
    pulses.pulse_fates,
    harmonic.harmonic_segment,
    oscillator.fill_oscillator,
    oscillator.fill_largest,
    # Time histories.
    march.march,
    replay.fill_states,
    replay.last_crossing,
    replay.peaks_until_overturning,
    replay.recorded_peaks,
    facts.run_end,
    facts.run_facts,
    facts.fill_landings,
    largest_forces,
    clock.clock,
    clock.segment_start,
    tables.is_nonlinear,
    drive.jump_share,
    # Base motions.
    motions.fill_pulse,
    motions.fill_lines,
    motions.fill_bounds,
    motions.ricker_at,
    # Steady states.
    closed_form.fill_steady,
    closed_form.fill_curves,
    closed_form.fill_half_cycle,
    closed_form.half_cycle_jacobian,
    closed_form.symmetric_orbit,
    symmetric_nonlinear.symmetric_from,
    closed_form.symmetry_breaking,
    # The return map and its orbits.
    systems.make_system,
    systems.fill_uplifts,
    return_map.next_passage,
    return_map.uplift_after,
    bounces.chatter_end,
    return_map.guess_after,
    return_map.highest_after,
    return_map.phase_between,
    settle.settle,
    settle.stretched,
    periodic.search,
    periodic.polish,
    periodic.measured,
    periodic.multipliers,
    periodic.loss,
    periodic.fill_peaks,
    periodic.is_symmetric,
    periodic.mirror,
    periodic.put,
    periodic.state_at,
    # Continuation.
    chains.fill_chain,
    chains.fill_matrix,
    chains.fill_arcs,
    chains.series_fill_chain,
    chains.side_of,
    chains.turned_over,
    # Elementary functions over arrays.
    *(each for name, each in vars(loops).items() if name.startswith("fill_")),
    # What takes a system, under a Fourier series.
    *map(
        systems.for_series,
        (
            return_map.next_passage,
            return_map.uplift_after,
            return_map.highest_after,
            settle.settle,
            periodic.search,
            periodic.polish,
            periodic.measured,
            periodic.loss,
            periodic.fill_peaks,
            periodic.is_symmetric,
            chains.fill_arcs,
        ),
    ),
)
ENTRIES: dict[str, Any] = {kernel.__name__: kernel for kernel in _KERNELS}
"""By name; each a `Kernel`."""
