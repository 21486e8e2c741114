"""Attractor of a block over a grid of parameters of block, shaking and start."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.dynamics.batch.attractors import (
    batch_size,
    load_kernel,
    outputs_of_orbits,
    settled_cells,
)
from rocksteady.dynamics.history.start import Start
from rocksteady.dynamics.maps._grid_map import Question, map_of
from rocksteady.dynamics.maps._scenario import Scenario
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.equations import Model, chosen_model
from rocksteady.model.motions.segments import Harmonic
from rocksteady.outcomes import NO_START
from rocksteady.sweep.run import Run

if TYPE_CHECKING:
    import xarray

Floats = NDArray[np.float64]


@checked
def map_attractors(
    block: Block | DimensionlessBlock,
    shaking: Harmonic | None = None,
    *,
    axes: Mapping[str, ArrayLike],
    start: Start | None = None,
    cycles: int = 2000,
    housner: bool = False,
    run: Run | None = None,
    refine: int | None = None,
    model: Model | None = None,
) -> "xarray.Dataset":
    """Return the attractor of a block over a grid of parameters.

    Every cell is what `find_attractor` finds at that point, to the last bit.

    Parameters
    ----------
    block, shaking, start
        What is not named in `axes` keeps the value that it has here, in the measures in which it is
        given here; `start` is `Rest` (default), `State` or `Steady`.  The shaking may be left out
        where its amplitude and its frequency are named.
    axes
        Values, shape (points,), of one or more parameters by their names; their order is that of
        the dimensions.  A number in place of values fixes a parameter: it is no dimension.

        ==================================  ======================================================
        amplitude, frequency_ratio, phase   of the shaking; the phase [rad] not with a steady start
        restitution                         of the block, of both impacts
        negative_restitution, alpha_ratio,  of a `DimensionlessBlock`: by what its sides differ
        p_ratio
        angle, velocity                     of the state at the start, as in `State`
        kick                                of a `Steady` start
        ==================================  ======================================================

        of a `Block` also

        ================================  ========================================================
        acceleration_m_s2, frequency_hz   of the shaking, in place of its two ratios
        width, height                     [m] of a homogeneous rectangle; each keeps the other
        alpha, radius, p                  [rad], [m], [rad/s]; alpha keeps the radius, and the
                                          radius, or p in its place, keeps alpha
        ================================  ========================================================

        A `Harmonic` keeps its two ratios, also where a size is moved, so that its ground moves
        otherwise under each block; name acceleration_m_s2 and frequency_hz to have all blocks
        stand on one ground.  An initial state stays in the measures of the block.
    cycles
        As for `find_attractor`.
    housner
        Whether the restitution follows from the slenderness, cell by cell; else the block's own
        stays.
    run
        As for `rocksteady.sweep.evaluate.evaluate`.
    refine
        With a power of two, as 8, every eighth cell along each axis is computed, and of the others
        those alone that are near a border of kinds, periods or numbers of impacts; see
        `rocksteady.sweep.refine.refined`.  Not with a store.
    model
        `Linear()` (default) or `Nonlinear()`, which needs a `Block` and takes some forty times as
        long.

    Returns
    -------
    xarray.Dataset
        The axes are its dimensions.  ``kind`` has flags; it is no-start (-1) where a steady state
        to start from does not exist or is no motion.  ``period`` [forcing periods], ``impacts`` in
        a period (-1 for infinitely many), ``highest`` and ``lowest`` theta/alpha, ``lyapunov`` per
        forcing period, and ``after`` how many of them that was known.  What is no axis stands in
        its attributes.  Of a refined map ``met`` says which cells were computed; the others have
        kind, period and impacts alone.

    Raises
    ------
    InputError
        If a number is outside its range, or a parameter is unknown.
    ModelError
        If axes, block, shaking and start do not go together.
    OutputError, UnfinishedError
        If the store cannot be written, as for `rocksteady.sweep.evaluate.evaluate`.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock
    >>> found = map_attractors(
    ...     DimensionlessBlock(restitution=0.8),
    ...     axes={"amplitude": [0.5, 2.0], "frequency_ratio": [1.0, 4.0, 8.0]},
    ... )
    >>> found.kind.values
    array([[2, 2, 2],
           [3, 0, 0]], dtype=int8)
    >>> print(found.kind.attrs["flag_meanings"])
    symmetric unsymmetric rest overturned aperiodic undecided no-start

    Does a block stand up to this shaking, by its width and by the phase at which it begins?

    >>> block = Block.rectangle(width=0.4, height=2.0, restitution=0.9)
    >>> found = map_attractors(
    ...     block,
    ...     axes={
    ...         "width": [0.4, 0.6, 0.9],
    ...         "phase": [0.0, 1.5],
    ...         "acceleration_m_s2": 4.0,
    ...         "frequency_hz": 1.0,
    ...     },
    ... )
    >>> found.kind.values
    array([[3, 3],
           [3, 0],
           [2, 2]], dtype=int8)
    """
    return map_of(
        ATTRACTORS,
        block,
        shaking,
        axes=axes,
        start=start,
        cycles=cycles,
        housner=housner,
        run=run,
        refine=refine,
        model=chosen_model(model, block),
    )


def _settled(*, scenario: Scenario, cycles: int, **coordinates: Floats) -> dict[str, NDArray[Any]]:
    """Return what the cells of a map settle to."""
    cells = scenario.cells(coordinates)
    there = cells.there
    found = settled_cells(
        np.where(there, cells.amplitude, 0.0),  # nothing to follow where there is no start
        cells.frequency_ratio,
        cells.sides,
        cells.begin,
        cycles,
    )
    return {
        "kind": np.where(there, found.kind, np.int8(NO_START)),
        "period": found.period,
        "impacts": found.impacts,
        "highest": np.where(there, found.highest, np.nan),
        "lowest": np.where(there, found.lowest, np.nan),
        "lyapunov": found.lyapunov,
        "after": found.after,
    }


ATTRACTORS = Question(
    cases=_settled,
    outputs=outputs_of_orbits(),
    classes=("kind", "period", "impacts"),
    batch=batch_size,
    load=load_kernel,
)
