"""Fate of a block after a given time, over a grid of parameters."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.batch.fates import ENDS, batch_size, ends_of, load_kernel
from rocksteady.dynamics.history.start import HasStart, Start
from rocksteady.dynamics.maps._scenario import Scenario
from rocksteady.dynamics.maps.grid_map import Question, map_of
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.equations import ModelChoice
from rocksteady.model.motions.floor import Floor
from rocksteady.model.motions.fourier import PeriodicMotion, harmonics_of
from rocksteady.outcomes import NO_START, NO_START_LABEL
from rocksteady.sweep.cases.labelled import as_dataset
from rocksteady.sweep.cases.outputs import Output
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray


@checked
def map_fates(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion | Floor | None = None,
    *,
    axes: Mapping[str, ArrayLike],
    start: Start | HasStart | None = None,
    cycles: int = 200,
    refine: int | None = None,
    model: ModelChoice = None,
    run: Execution | None = None,
) -> "xarray.Dataset":
    """Compute the fate of a block after a given time, over a grid of parameters.

    A motion is followed for some periods and no longer, whatever it settles to.  Every cell is how
    `simulate` ends at that point, as long as no small difference grows more than some 1e12-fold
    (`Trajectory.growth`); in chaotic cells it is the end of a motion within rounding of that one.

    Parameters
    ----------
    block, motion, axes, start
        As for `map_attractors`: any parameter of block, motion and start may be an axis.
    cycles
        Forcing periods that each motion is followed for, at most (default 200).
    refine, model, run
        As for `map_attractors`; a border is one of fates.

    Returns
    -------
    xarray.Dataset
        ``fate`` with flags: rocking, at-rest, overturned, or undecided after four million impacts;
        -1 where no start exists.  Its ``rocksteady`` accessor has summary() and plot().

    Raises
    ------
    InputError, ModelError, OutputError, UnfinishedError
        As for `map_attractors`.

    Examples
    --------
    Which share of the velocities at which it is set off upright does not make it fall, by the phase
    of the motion at that moment?

    >>> import numpy as np
    >>> from rocksteady import DimensionlessBlock, Harmonic, map_fates
    >>> cells = map_fates(
    ...     DimensionlessBlock(restitution=0.8),
    ...     Harmonic(amplitude=1.5, frequency_ratio=3.0),
    ...     axes={"phase": np.linspace(0.0, 6.0, 4), "velocity": np.linspace(-1.0, 1.0, 201)},
    ... )
    >>> print((cells.fate != 2).mean("velocity").values.round(2))
    [0.77 0.94 0.77 0.79]
    >>> print(cells.fate.attrs["flag_meanings"])
    rocking at-rest overturned undecided no-start
    """
    cells = map_of(
        FATES,
        block,
        motion,
        axes=axes,
        start=start,
        cycles=cycles,
        refine=refine,
        model=model,
        run=run,
    )
    return as_dataset(cells)


def _fates(*, scenario: Scenario, cycles: int, **coordinates: Floats) -> dict[str, NDArray[Any]]:
    """Return the fates in the cells of a map."""
    cells = scenario.cells(coordinates)
    status = ends_of(
        # Nothing to follow where there is no start.
        amplitude=np.where(cells.there, cells.amplitude, 0.0),
        frequency_ratio=cells.frequency_ratio,
        sides=cells.sides,
        angle=cells.angle,
        velocity=cells.velocity,
        phase=cells.phase,
        cycles=cycles,
        harmonics=harmonics_of(scenario.motion),
    )
    return {"fate": np.where(cells.there, status, NO_START).astype(np.int8)}


FATES = Question(
    cases=_fates,
    outputs=(
        Output(
            name="fate",
            dtype=np.int8,
            long_name="what becomes of the block",
            flags={**{int(status): status.label for status in ENDS}, NO_START: NO_START_LABEL},
        ),
    ),
    classes=("fate",),
    counted="cycles",
    cycles=200,
    batch=batch_size,
    load=load_kernel,
)
