"""Attractor of a block over a grid of parameters of block, shaking and start."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.batch.attractors import (
    batch_size,
    load_kernel,
    outputs_of_orbits,
    settled_cells,
)
from rocksteady.dynamics.history.start import HasStart, Start
from rocksteady.dynamics.maps._scenario import Scenario
from rocksteady.dynamics.maps.grid_map import Question, map_of
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.equations import ModelChoice
from rocksteady.model.motions.floor import Floor
from rocksteady.model.motions.fourier import PeriodicMotion, harmonics_of
from rocksteady.outcomes import NO_START
from rocksteady.sweep.cases.labelled import as_dataset
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray


@checked
def map_attractors(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion | Floor | None = None,
    *,
    axes: Mapping[str, ArrayLike],
    start: Start | HasStart | None = None,
    max_cycles: int = 2000,
    refine: int | None = None,
    model: ModelChoice = None,
    run: Execution | None = None,
) -> "xarray.Dataset":
    """Compute the attractor of a block over a grid of parameters.

    Every cell is what `find_attractor` finds at that point.  Orbits agree to rounding; where small
    differences grow beyond 1e10 on the way, rounding may choose another one.

    Parameters
    ----------
    block, motion, start
        What is not in `axes` stays as it is given here.  A `Harmonic` keeps its two ratios, also
        where a size moves.  Without a motion, `axes` names its amplitude and frequency; so it does
        of the ground with a `rocksteady.motions.Floor`, whose lasting shaking a `Block` then has.
    axes
        Values, shape (points,), by parameter, in the order of the dimensions; a number fixes one.

        ==================================  ======================================================
        amplitude, frequency_ratio, phase   of the motion; acceleration_m_s2, frequency_hz of a
                                            `Block`; the phase [rad] not with a steady start
        restitution                         of both impacts; "housner" follows the slenderness,
                                            and so does ("housner", 0.965), a factor of it
        negative_restitution, alpha_ratio,  of a `DimensionlessBlock`: by what its sides differ
        p_ratio
        width, height, alpha, radius, p     of a `Block`, a homogeneous rectangle: width and height
                                            keep each other, alpha keeps the radius, the others
                                            alpha
        angle, velocity, kick               of the start: a `State`, or a `Steady`
        ==================================  ======================================================
    max_cycles
        Forcing periods after which a motion counts as aperiodic or undecided (default 2000).
    refine
        With a power of two, as 8, computes each eighth cell along an axis, and the others only near
        a border of kinds, periods or impacts.  Not with a store.
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.
    run
        Executor, store and progress, as for `evaluate`.

    Returns
    -------
    xarray.Dataset
        ``kind`` with flags (-1: no start exists), ``period`` [forcing periods], ``impacts`` in a
        period (-1: infinitely many), ``highest``, ``lowest``, ``lyapunov`` and ``after``; for a
        refined map ``met``: whether a cell was computed.  Its ``rocksteady`` accessor has summary()
        and plot().

    Raises
    ------
    InputError, ModelError, OutputError, UnfinishedError
        If a value is outside its range, the parts do not go together, or a store is not written.

    Examples
    --------
    >>> block = Block.rectangle(width=0.4, height=2.0, restitution=0.9)
    >>> ground = {"acceleration_m_s2": 4.0, "frequency_hz": 1.0}
    >>> cells = map_attractors(block, axes={"width": [0.4, 0.9], "phase": [0.0, 1.5], **ground})
    >>> cells.kind.values
    array([[3, 3],
           [2, 2]], dtype=int8)
    """
    cells = map_of(
        ATTRACTORS,
        block,
        motion,
        axes=axes,
        start=start,
        cycles=max_cycles,
        refine=refine,
        model=model,
        run=run,
    )
    return as_dataset(cells)


def _settled(*, scenario: Scenario, cycles: int, **coordinates: Floats) -> dict[str, NDArray[Any]]:
    """Return what the cells of a map settle to."""
    cells = scenario.cells(coordinates)
    exists = cells.there
    attractors = settled_cells(
        np.where(exists, cells.amplitude, 0.0),  # nothing to follow where there is no start
        cells.frequency_ratio,
        cells.sides,
        cells.begin,
        cycles,
        harmonics_of(scenario.motion),
    )
    return {
        "kind": np.where(exists, attractors.kind, np.int8(NO_START)),
        "period": attractors.period,
        "impacts": attractors.impacts,
        "highest": np.where(exists, attractors.highest, np.nan),
        "lowest": np.where(exists, attractors.lowest, np.nan),
        "lyapunov": attractors.lyapunov,
        "after": attractors.after,
    }


ATTRACTORS = Question(
    cases=_settled,
    outputs=outputs_of_orbits(),
    classes=("kind", "period", "impacts"),
    counted="max_cycles",
    cycles=2000,
    batch=batch_size,
    load=lambda _: load_kernel(),
)
