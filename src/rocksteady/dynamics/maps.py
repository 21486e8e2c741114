"""What a block settles to over a grid of amplitudes and frequency ratios."""

import functools
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.dynamics.attractor import cycles_value, side_value
from rocksteady.dynamics.grids import validated_grid
from rocksteady.dynamics.return_map import bare_block
from rocksteady.dynamics.settled import (
    NO_START,
    Beginnings,
    outputs_of_orbits,
    piece_size,
    settled_cells,
)
from rocksteady.dynamics.start import Rest, Start, Steady, initial_march
from rocksteady.errors import ModelError
from rocksteady.kernels.march import March
from rocksteady.model.block import Block, DimensionlessBlock
from rocksteady.model.motions import Harmonic
from rocksteady.sweep.axes import Axis, Grid
from rocksteady.sweep.evaluate import Done, evaluate

if TYPE_CHECKING:
    import xarray

Floats = NDArray[np.float64]


def attractor_map(
    block: Block | DimensionlessBlock,
    amplitude: ArrayLike,
    frequency_ratio: ArrayLike,
    *,
    phase: float = 0.0,
    start: Start | None = None,
    side: int = 1,
    cycles: int = 2000,
    executor: str = "threads",
    workers: int | None = None,
    done: Done | None = None,
) -> "xarray.Dataset":
    """Return what a block settles to over a grid of amplitudes and frequency ratios.

    Every cell is what `attractor` finds at that point, to the last bit.

    Parameters
    ----------
    block
        Its restitution counts.
    amplitude, frequency_ratio
        A = a_max/(alpha g) and Omega = omega/p, shape (points,) each.
    phase
        Phase of the shaking at the start [rad], unless a `Steady` start decides on it.
    start, side, cycles
        As for `attractor`.
    executor, workers, done
        As for `rocksteady.sweep.evaluate.evaluate`.

    Returns
    -------
    xarray.Dataset
        Dimensions amplitude and frequency_ratio.  ``kind`` has flags; it is ``no-start`` where a
        steady state to start from does not exist or is no motion.  ``period`` [forcing periods],
        ``impacts`` in a period (-1 for infinitely many), ``highest`` and ``lowest`` theta/alpha,
        ``lyapunov`` per forcing period, and ``after`` how many of them that was known.

    Raises
    ------
    InputError, ModelError
        If a number is outside its range, or the start does not fit.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock
    >>> found = attractor_map(DimensionlessBlock(restitution=0.8), [0.5, 2.0], [1.0, 4.0, 8.0])
    >>> found.kind.values
    array([[2, 2, 2],
           [3, 0, 0]], dtype=int8)
    >>> print(found.kind.attrs["flag_meanings"])
    symmetric unsymmetric rest overturned aperiodic undecided no-start
    """
    bare = bare_block(block)
    grid = Grid(
        axes=(
            Axis(name="amplitude", values=amplitude, long_name="a_max/(alpha g)"),
            Axis(name="frequency_ratio", values=frequency_ratio, long_name="omega/p"),
        )
    )
    validated_grid(grid.axes[0].points[:, np.newaxis], grid.axes[1].points, bare.restitution, 1)
    begin = Rest() if start is None else start
    first = Harmonic(
        amplitude=float(grid.axes[0].points[0]),
        frequency_ratio=float(grid.axes[1].points[0]),
        phase=phase,
    )
    if not isinstance(begin, Steady):  # the start itself is validated, once and not in each cell
        initial_march(begin, bare, first, side_value(side))
    cases = functools.partial(
        _settled,
        block=bare,
        phase=first.phase,
        start=begin,
        side=side_value(side),
        cycles=cycles_value(cycles),
    )
    attributes = {
        "restitution": bare.restitution,
        "phase": first.phase,
        "start": repr(begin),
        "side": side_value(side),
        "cycles": cycles_value(cycles),
    }
    return evaluate(
        cases,
        grid,
        outputs_of_orbits(),
        executor=executor,
        workers=workers,
        chunk=piece_size(cycles),
        done=done,
        attributes=attributes,
    )


def _settled(
    amplitude: Floats,
    frequency_ratio: Floats,
    *,
    block: DimensionlessBlock,
    phase: float,
    start: Start,
    side: int,
    cycles: int,
) -> dict[str, NDArray[Any]]:
    """Return what the cells of a map settle to."""
    begin, nowhere = _beginnings(amplitude, frequency_ratio, block, phase, start, side)
    found = settled_cells(
        np.where(nowhere, 0.0, amplitude), frequency_ratio, block.restitution, begin, cycles
    )
    return {
        "kind": np.where(nowhere, np.int8(NO_START), found.kind),
        "period": found.period,
        "impacts": found.impacts,
        "highest": np.where(nowhere, np.nan, found.highest),
        "lowest": np.where(nowhere, np.nan, found.lowest),
        "lyapunov": found.lyapunov,
        "after": found.after,
    }


def _beginnings(
    amplitude: Floats,
    frequency_ratio: Floats,
    block: DimensionlessBlock,
    phase: float,
    start: Start,
    side: int,
) -> tuple[Beginnings, NDArray[np.bool_]]:
    """Return the states at the start, and where there is none."""
    cells = len(amplitude)
    points = zip(amplitude.tolist(), frequency_ratio.tolist(), strict=True)
    shakings = (Harmonic(amplitude=a, frequency_ratio=w, phase=phase) for a, w in points)
    if isinstance(start, Steady):
        found = [_on_orbit(start, block, shaking, side) for shaking in shakings]
    else:  # the same for every shaking
        found = [initial_march(start, block, next(shakings), side)[1]] * cells
    upright = March(0, 0.0, 0.0, 0, 0, 0.0, 0, 0)
    states = [upright if march is None else march for march in found]
    begin = Beginnings(
        side=np.array([state.side for state in states]),
        angle=np.array([state.angle for state in states]),
        velocity=np.array([state.velocity for state in states]),
        half_cycles=np.array([state.half_cycles for state in states]),
        phase=np.array([state.phase for state in states]),
    )
    return begin, np.array([march is None for march in found])


def _on_orbit(
    start: Steady, block: DimensionlessBlock, shaking: Harmonic, side: int
) -> March | None:
    """Return the state on a steady state; None where that does not exist or is no motion."""
    try:
        return initial_march(start, block, shaking, side)[1]
    except ModelError:
        return None
