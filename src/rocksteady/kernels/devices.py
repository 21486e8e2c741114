"""Forms in which devices run kernels over cells, and the choice between a device and the host.

A form names the queued kernel that does the work of a host kernel, what it needs besides the
arguments of that, and how long each cell is expected to take.  The arguments of a queued kernel
are the queue, the room of its workers, what they share, and those of the host kernel.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.batch.arrival import STATE_COLUMNS
from rocksteady.kernels.batch.attractors import (
    queued_nonlinear_settle_cells,
    queued_settle_cells,
    settle_cells,
)
from rocksteady.kernels.batch.known_orbits import KNOWN_COLUMNS
from rocksteady.kernels.batch.records import (
    FEW,
    queued_nonlinear_record_fates,
    queued_record_fates,
    record_fates,
)
from rocksteady.kernels.batch.waiting import fill_hardest
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.tables import is_nonlinear
from rocksteady.kernels.core.tuples import Blocks, Cells, Starts, States, SymmetricCells
from rocksteady.kernels.lanes.driver import lane_fates, queued_lane_fates
from rocksteady.kernels.lanes.settling import lane_attractors, queued_lane_attractors
from rocksteady.kernels.machine_code.device import cells_in, current_device
from rocksteady.kernels.nonlinear_lanes.loop import (
    nonlinear_lane_fates,
    queued_nonlinear_lane_fates,
)
from rocksteady.kernels.nonlinear_lanes.settling import (
    nonlinear_lane_attractors,
    queued_nonlinear_lane_attractors,
)
from rocksteady.kernels.orbits.periodic import ORBIT_COLUMNS
from rocksteady.kernels.orbits.settle import GROWN, MEMORY

Floats = NDArray[np.float64]

LONGEST_ORBIT = 512
"""Passages of the longest orbit for which a worker of a device has room: 57 kB.  On the host there
is room for all; to a cell with more it is left over."""

COLD = ("linear_march", "nonlinear_march", "bounces_die_out")
"""Kernels that the build of a device never compiles into their callers.

Beside lanes they do the few flights that lanes do not do: inlined, they would take registers of the
loops over lanes; called, they make those be saved, but only where a call is made.  Where there are
no lanes they do all, and a call is nothing beside that.
"""


@dataclass(frozen=True)
class Form:
    """How a device runs what a host kernel does.

    Attributes
    ----------
    queued
        The queued kernel: what each worker calls once.
    room
        Shapes of the scratch arrays of one worker; the kernel takes an array of shape
        (workers, ...) for each.
    shared
        Makes of the host kernel's arguments the arrays that all workers read, if there are any.
    length
        Estimates of the host kernel's arguments how long each cell takes, shape (cells,), in any
        unit.  Cells are taken in descending order of it; results do not depend on it.
    """

    queued: Any
    room: tuple[tuple[int, ...], ...] = ()
    shared: Callable[..., tuple[Floats, ...]] | None = None
    length: Callable[..., Floats] | None = None


def run_cells(kernel: Any, *arguments: Any) -> None:
    """Run a kernel over cells: on the current device if it has a form for it, else on the host."""
    device = current_device()
    form = None if device is None else form_of(kernel, arguments)
    if device is None or form is None:
        kernel(*arguments)
    else:
        device.run(form, arguments)


def form_of(kernel: Any, arguments: tuple[Any, ...]) -> Form | None:
    """Return the form of a host kernel for a call of it; None where there is none, or no cell."""
    name = kernel.__name__
    if name not in FORMS or cells_in(arguments) == 0:
        return None
    if name in _BOTH:
        (blocks,) = (each for each in arguments if isinstance(each, Cells | Blocks))
        name = f"nonlinear_{name}" if is_nonlinear(blocks.sides[0]) else name
    return FORMS[name]


def _shaken(amplitude: Floats, frequency_ratio: Floats, angle: Floats, velocity: Floats) -> Floats:
    """Return an estimate of how long motions under harmonic shaking take.

    Weak uplift takes longest, with small bounces by the thousand; a block that is shaken hard and
    slowly falls at once, and one at rest under an amplitude of 1 or less stays there.  There are
    few values on purpose: cells of the same one are taken in their natural order, in which
    neighbours move alike, so that the threads of a warp have like things to do.
    """
    share = amplitude / (1.2 * frequency_ratio + 0.2)  # 1 where nearly all begin to fall at once
    usual = np.where(share > 1.0, 0.05, np.where(share > 0.5, 1.5, 1.0))
    length = np.where((amplitude > 1.0) & (amplitude < 1.2), 20.0, usual)
    return np.where((amplitude <= 1.0) & (angle == 0.0) & (velocity == 0.0), 0.0, length)


def _shaken_length(cells: Cells | SymmetricCells, begin: Starts | States, *_others: Any) -> Floats:
    """Return the estimate for the arguments of kernels of cells under harmonic shaking."""
    return _shaken(cells.amplitude, cells.frequency_ratio, begin.angle, begin.velocity)


def _record_length(segments: Floats, blocks: Blocks, *_others: Any) -> Floats:
    """Return an estimate for the arguments of `record_fates`.

    It is p times the time from the first acceleration of the base that lifts the block to the end
    of the motion: how many impacts there is time for.  Weight that changes with a vertical motion
    is not looked at, nor are falls foreseen.
    """
    sides = blocks.sides
    strongest = np.maximum.accumulate(
        np.abs(segments[:-1, columns.CONSTANT]) + np.abs(segments[:-1, columns.AMPLITUDE])
    )
    first = np.searchsorted(strongest, sides[:, :, columns.LEAN].min(axis=1))
    ends = np.cumsum(segments[:-1, columns.DURATION])
    left = ends[-1] - np.concatenate([[0.0], ends])[first]
    return np.where(first < len(strongest), left * sides[:, 0, columns.RATE], 0.0)


def _hardest(segments: Floats, blocks: Blocks, *_others: Any) -> tuple[Floats, ...]:
    """Return what the workers of `record_fates` share."""
    sides = blocks.sides
    hardest = np.empty(len(segments) - 1)
    if len(sides) > FEW:  # of fewer it is not read
        fill_hardest(segments, is_nonlinear(sides[0]), hardest)
    return (hardest,)


_LANE_ROOM = ((1, MEMORY, STATE_COLUMNS), (MEMORY, ORBIT_COLUMNS))
_SETTLE_ROOM = ((MEMORY, GROWN + 1), (LONGEST_ORBIT, ORBIT_COLUMNS))

FORMS: dict[str, Form] = {
    lane_fates.__name__: Form(queued_lane_fates, length=_shaken_length),
    nonlinear_lane_fates.__name__: Form(queued_nonlinear_lane_fates, length=_shaken_length),
    lane_attractors.__name__: Form(queued_lane_attractors, room=_LANE_ROOM, length=_shaken_length),
    nonlinear_lane_attractors.__name__: Form(
        queued_nonlinear_lane_attractors,
        room=(_LANE_ROOM[0], (1, KNOWN_COLUMNS), _LANE_ROOM[1]),
        length=_shaken_length,
    ),
    settle_cells.__name__: Form(queued_settle_cells, room=_SETTLE_ROOM, length=_shaken_length),
    f"nonlinear_{settle_cells.__name__}": Form(
        queued_nonlinear_settle_cells, room=_SETTLE_ROOM, length=_shaken_length
    ),
    record_fates.__name__: Form(queued_record_fates, shared=_hardest, length=_record_length),
    f"nonlinear_{record_fates.__name__}": Form(
        queued_nonlinear_record_fates, shared=_hardest, length=_record_length
    ),
}
"""By the name of the host kernel; where its sides are nonlinear, by that after `nonlinear_`."""

_BOTH = {settle_cells.__name__, record_fates.__name__}
"""Names of host kernels with a form for each model."""
