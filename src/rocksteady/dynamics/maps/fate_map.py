"""Fate of a block after a given time, over a grid of parameters."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.dynamics.batch.fates import ENDS, batch_size, ends_of, load_kernel
from rocksteady.dynamics.history.start import Start
from rocksteady.dynamics.maps._grid_map import Question, map_of
from rocksteady.dynamics.maps._scenario import Scenario
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.equations import Model, chosen_model
from rocksteady.model.motions.segments import Harmonic
from rocksteady.outcomes import NO_START, NO_START_LABEL
from rocksteady.sweep.cases.outputs import Output
from rocksteady.sweep.run import Run

if TYPE_CHECKING:
    import xarray

Floats = NDArray[np.float64]


@checked
def map_fates(
    block: Block | DimensionlessBlock,
    shaking: Harmonic | None = None,
    *,
    axes: Mapping[str, ArrayLike],
    start: Start | None = None,
    cycles: int = 200,
    housner: bool = False,
    run: Run | None = None,
    refine: int | None = None,
    model: Model | None = None,
) -> "xarray.Dataset":
    """Return the fate of a block after a given time, over a grid of parameters.

    Every cell is how `simulate` ends at that point, as long as no small difference grows more than
    some 1e12-fold on the way (`Trajectory.growth`).  Where it does, in chaotic cells, rounding
    decides, and the two compute in different ways: a cell is the end of a motion within rounding of
    that one.  Where `map_attractors` follows a motion until
    it is known what it settles to, it is followed here for some periods and no longer.

    Parameters
    ----------
    block, shaking, axes, start, housner
        As for `map_attractors`: any parameter of block, shaking and start may be an axis.
    cycles
        Forcing periods that each motion is followed for, at most.
    run
        As for `rocksteady.sweep.evaluate.evaluate`.
    refine
        As for `map_attractors`; a border is one of fates.
    model
        As for `map_attractors`.

    Returns
    -------
    xarray.Dataset
        The axes are its dimensions.  ``fate`` has flags: rocking, at-rest, overturned, or undecided
        after four million impacts, the codes of `Status`; or no-start (-1) where a steady state to
        start from does not exist or is no motion.  ``impacts`` is how many there were until then;
        of the infinitely many before a rest those count that came before it was proved.  What is no
        axis stands in its attributes.
        Of a refined map ``met`` says which cells were computed; the others have a fate alone.

    Raises
    ------
    InputError, ModelError, OutputError, UnfinishedError
        As for `map_attractors`.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, State, map_fates
    >>> found = map_fates(
    ...     DimensionlessBlock(restitution=0.8),
    ...     axes={"amplitude": [0.5, 2.0], "frequency_ratio": [1.0, 4.0, 8.0]},
    ...     start=State(angle=0.0, velocity=0.3),
    ... )
    >>> found.fate.values
    array([[1, 0, 0],
           [2, 0, 0]], dtype=int8)
    >>> print(found.fate.attrs["flag_meanings"])
    rocking at-rest overturned undecided no-start
    >>> found.impacts.sel(amplitude=2.0).values
    array([  0, 399, 133])

    Which share of the velocities at which it is set off upright does not make it fall, by the phase
    of the shaking at that moment?

    >>> import numpy as np
    >>> found = map_fates(
    ...     DimensionlessBlock(restitution=0.8),
    ...     Harmonic(amplitude=1.5, frequency_ratio=3.0),
    ...     axes={"phase": np.linspace(0.0, 6.0, 4), "velocity": np.linspace(-1.0, 1.0, 201)},
    ... )
    >>> print((found.fate != 2).mean("velocity").values.round(2))
    [0.77 0.94 0.77 0.79]
    """
    return map_of(
        FATES,
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


def _fates(*, scenario: Scenario, cycles: int, **coordinates: Floats) -> dict[str, NDArray[Any]]:
    """Return the fates in the cells of a map."""
    cells = scenario.cells(coordinates)
    status, impacts = ends_of(
        # Nothing to follow where there is no start.
        amplitude=np.where(cells.there, cells.amplitude, 0.0),
        frequency_ratio=cells.frequency_ratio,
        sides=cells.sides,
        angle=cells.angle,
        velocity=cells.velocity,
        phase=cells.phase,
        cycles=cycles,
    )
    return {"fate": np.where(cells.there, status, NO_START).astype(np.int8), "impacts": impacts}


FATES = Question(
    cases=_fates,
    outputs=(
        Output(
            name="fate",
            dtype=np.int8,
            long_name="what becomes of the block",
            flags={**{int(status): status.label for status in ENDS}, NO_START: NO_START_LABEL},
        ),
        Output(name="impacts", dtype=np.int64, long_name="impacts until then"),
    ),
    classes=("fate",),
    batch=batch_size,
    load=load_kernel,
)
