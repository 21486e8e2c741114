"""Evaluation shared by all maps: the same computation in every cell of a parameter grid."""

import functools
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from numbers import Number
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from rocksteady.dynamics.history.start import HasStart, Start, start_of
from rocksteady.dynamics.maps._scenario import Scenario
from rocksteady.dynamics.orbits.attractor import FORCING_PERIODS
from rocksteady.dynamics.parameters import AXES, validated_axes
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.housner_forms import Impacts
from rocksteady.model.equations import Model, ModelChoice, chosen_model
from rocksteady.model.motions.floor import Floor
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.outputs import Output
from rocksteady.sweep.cases.task import Cases
from rocksteady.sweep.evaluate import compute_cells
from rocksteady.sweep.refine import refined
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    from rocksteady.sweep.cases.cells import Labelled


@dataclass(frozen=True, kw_only=True)
class Question:
    """What is computed in each cell of a map.

    Attributes
    ----------
    cases
        A function at module level of ``scenario``, ``cycles`` and the coordinates of some cells.
    outputs
        What it answers.
    classes
        The outputs that make a class, where only the surroundings of borders are computed.
    counted
        Public name of the argument that becomes ``cycles``.
    cycles
        Its default.
    batch
        Returns how many cells one call takes, from the forcing periods that each is followed for.
    load
        Loads the kernels, or compiles them, so that what is timed afterwards is computation alone.
    """

    cases: Cases
    outputs: tuple[Output, ...]
    classes: tuple[str, ...]
    counted: str
    cycles: int
    batch: Callable[[int], int]
    load: Callable[[Model], None]


def map_of(
    question: Question,
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion | Floor | None,
    *,
    axes: Mapping[str, ArrayLike],
    start: Start | HasStart | None,
    cycles: int | None,
    refine: int | None,
    model: ModelChoice,
    run: Execution | None,
) -> "Labelled":
    """Return the answers to a question over a grid of parameters.

    Parameters and errors are those of `rocksteady.map_attractors`.
    """
    grid, fixed, housner = _grid(axes)
    floor = motion if isinstance(motion, Floor) else None
    scenario = Scenario(
        axes=grid.names,
        block=block,
        motion=None if isinstance(motion, Floor) else motion,
        start=start_of(start),
        fixed=fixed,
        housner=housner,
        model=chosen_model(model, block),
        floor=floor,
    )
    scenario.check({axis.name: axis.points for axis in grid.axes})
    periods = FORCING_PERIODS(question.counted, question.cycles if cycles is None else cycles)
    question.load(scenario.model)
    cases = functools.partial(question.cases, scenario=scenario, cycles=periods)
    how: dict[str, Any] = {
        "run": run,
        "batch": question.batch(periods),
        "attributes": {**scenario.attributes, question.counted: periods},
    }
    if refine is None:
        return compute_cells(cases, grid, question.outputs, **how)
    classes = question.classes
    return refined(cases, grid, question.outputs, classes=classes, coarse=refine, **how)


def _grid(axes: Mapping[str, ArrayLike]) -> tuple[Grid, tuple[tuple[str, Any], ...], float | None]:
    """Return the grid, the parameters that are fixed, and the factor of Housner's restitution."""
    given: object = axes
    if not isinstance(given, Mapping):
        raise InputError(
            "axes",
            given,
            "it names parameters, each with its values",
            "give a mapping, as {'amplitude': [1.0, 2.0]}",
        )
    housner = Impacts.of(axes.get("restitution")).factor
    follows = {"restitution"} if housner is not None else set()
    moved = {name: value for name, value in axes.items() if name not in follows}
    fixed = {name: value for name, value in moved.items() if _is_single(value)}
    names = validated_axes([name for name in moved if name not in fixed], fixed)
    grid = Grid(
        axes=tuple(Axis(name=name, values=axes[name], **AXES[name]._asdict()) for name in names)
    )
    return grid, tuple(fixed.items()), housner


def _is_single(value: object) -> bool:
    """Return whether something is a number, of Python or of an array, rather than an axis."""
    return isinstance(value, Number) or getattr(value, "shape", None) == ()
