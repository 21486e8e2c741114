"""Shares of the basins of attraction over a parameter, with labels that stay with their orbits."""

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats, Integers
from rocksteady.dynamics.arrays import real_array
from rocksteady.dynamics.basins.cells import (
    CELL_OUTPUTS,
    SEED,
    drawn_states,
    found_in_cells,
)
from rocksteady.dynamics.basins.measures.entropy import BasinEntropies, compute_basin_entropy
from rocksteady.dynamics.basins.over._seeding import Here, seed_neighbours
from rocksteady.dynamics.basins.over.families import BasinFamily, families_of
from rocksteady.dynamics.basins.over.matching import MatchingOptions
from rocksteady.dynamics.basins.window import moment, shaken_axes, spacing
from rocksteady.dynamics.batch.attractors import (
    batch_size,
    settled_cells,
    starting,
)
from rocksteady.dynamics.orbits.attractor import FORCING_PERIODS
from rocksteady.dynamics.orbits.return_map import periodic_motion
from rocksteady.dynamics.parameters import AXES, PARAMETERS, moved_to
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.confidence import Confidence, share_interval
from rocksteady.model.checks.validation import index_value
from rocksteady.model.equations import Model, ModelChoice, chosen_model
from rocksteady.model.motions.fourier import (
    PeriodicMotion,
    harmonics_of,
)
from rocksteady.model.motions.harmonics import Harmonics
from rocksteady.outcomes import AttractorKind
from rocksteady.results.numbers import CONFIDENCE
from rocksteady.results.result import Result, words_module
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.evaluate import compute_cells
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray


MOVED = (*PARAMETERS, "phase")
"""Parameters over which shares are computed."""
MAX_CYCLES = 500


@checked
@dataclass(frozen=True, kw_only=True, eq=False)
class SamplingOptions:
    """Initial states whose attractors are counted, the same at each value of a parameter.

    Parameters
    ----------
    angles, velocities
        u = theta/alpha, shape (n,), and du/d(pt), shape (m,), evenly spaced; those of
        `compute_basins` by default.
    seed
        With one, a state is drawn in each cell, the same at each value; without, its middle.
    max_cycles
        Forcing periods after which a motion counts as aperiodic or undecided (default 500).

    Raises
    ------
    InputError
        If the seed or the number of periods is not valid; the axes are checked with their block.

    Examples
    --------
    >>> SamplingOptions(seed=1).max_cycles
    500
    """

    angles: ArrayLike | None = None
    velocities: ArrayLike | None = None
    seed: Annotated[int | None, SEED] = None
    max_cycles: Annotated[int, FORCING_PERIODS] = MAX_CYCLES


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class BasinShares(Result):
    """Shares of basins of attraction in one window over the values of a parameter.

    Attributes
    ----------
    block, motion
        Block and base motion; their own value of the parameter does not count.
    parameter
        "amplitude", "frequency_ratio", "restitution" or "phase".
    values
        Ascending or descending, shape (values,).
    families
        Attractors with their labels, which stay over the values.
    label
        Where each state goes: index of `families`, shape (values, m, n).
    angle, velocity
        Axes of the window: u, shape (n,), and du/d(pt), shape (m,).
    seed
        Seed with which states were drawn; None for the points of the grid.
    max_cycles
        Forcing periods after which a motion counted as aperiodic or undecided.
    matching
        How attractors became families.
    model
        Which equations of motion hold.
    """

    block: Block | DimensionlessBlock
    motion: PeriodicMotion
    parameter: str
    values: Floats
    families: tuple[BasinFamily, ...]
    label: Integers
    angle: Floats
    velocity: Floats
    seed: int | None
    max_cycles: int
    matching: MatchingOptions
    model: Model

    @cached_property
    def states(self) -> Integers:
        """Number of states of the window that go to each family, shape (families, values)."""
        count = len(self.families)
        counts = [np.bincount(labels.ravel(), minlength=count) for labels in self.label]
        return np.array(counts).T

    @property
    def share(self) -> Floats:
        """Share of each basin, shape (families, values); 0 where the attractor is not there."""
        shares: Floats = self.states / self.label[0].size
        return shares

    def intervals(self, confidence: Confidence = CONFIDENCE) -> tuple[Floats, Floats]:
        """Return Wilson's interval of each share, two arrays of shape (families, values).

        `Basins.fractions` explains what it means.

        Parameters
        ----------
        confidence
            Confidence of the interval, in (0, 1); default 0.9.

        Raises
        ------
        InputError
            If the confidence is outside its range.
        """
        return share_interval(self.share, self.label[0].size, confidence)

    def entropies(self, box: int | Sequence[int] | None = None) -> BasinEntropies:
        """Return the entropy of the basins at each value, as from `compute_basin_entropy`.

        Parameters
        ----------
        box
            Cells along each side of a box, in velocity and in angle; by default the most up to 20
            that divide both axes.
        """
        return BasinEntropies(
            parameter=self.parameter,
            values=self.values,
            entropies=tuple(compute_basin_entropy(labels, box) for labels in self.label),
        )

    def case(self, index: int) -> tuple[Block | DimensionlessBlock, PeriodicMotion]:
        """Return block and motion at one of the values.

        Parameters
        ----------
        index
            Index of the value.

        Raises
        ------
        InputError
            If there is no such value.
        """
        place = index_value(index, len(self.values), "value")
        return moved_to(self.block, self.motion, self.parameter, float(self.values[place]))

    @property
    def undecided(self) -> float:
        """Share of all states whose attractor is undecided."""
        of = [
            family.label
            for family in self.families
            if family.typical.kind is AttractorKind.UNDECIDED
        ]
        return float(self.states[of].sum() / self.label.size)

    def to_dataset(self) -> "xarray.Dataset":
        """Return the shares as an xarray Dataset with dimensions family and the parameter.

        Returns
        -------
        xarray.Dataset
            ``share``, its 90 % interval ``low`` and ``high``, ``states``, ``period`` (0 without an
            orbit), ``highest`` and ``lowest`` (theta/alpha) and ``present`` over family and
            parameter; ``label`` over parameter, velocity and angle.
        """
        dataset: xarray.Dataset = words_module(BasinShares).shares_dataset(self)
        return dataset


@checked
def compute_basin_shares(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion,
    parameter: str,
    values: ArrayLike,
    *,
    sampling: SamplingOptions | None = None,
    matching: MatchingOptions | None = None,
    model: ModelChoice = None,
    run: Execution | None = None,
) -> BasinShares:
    """Compute the shares of the basins over a parameter, with labels that stay.

    At each value the states of one window are followed, as by `compute_basins`.  A state of each
    attractor is followed at the neighbouring values too, so that attractors of small basins are not
    lost; it does not count in the shares.  Orbits at neighbouring values whose states are close
    become one family, whatever their kinds and periods: a period doubling does not rename, and of
    two mirror images born at a symmetry breaking one goes on with the label.  Rest, overturned,
    aperiodic and undecided are families by kind.  As ``global_continuation`` of Attractors.jl with
    ``AttractorSeedContinueMatch`` [1]_.

    Parameters
    ----------
    block, motion
        Block and base motion; their own value of the parameter does not count.
    parameter
        "amplitude", "frequency_ratio", "restitution" or "phase" (that of the initial states).
    values
        Ascending or descending, shape (values,).
    sampling
        Window and number of states; by default `SamplingOptions()`.
    matching
        Distance and threshold of the matching; by default `MatchingOptions()`.
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.
    run
        Executor, store and progress, as for `evaluate`.

    Returns
    -------
    BasinShares
        Families with their orbits, and shares that sum to 1 at each value.

    Raises
    ------
    InputError, ModelError, OutputError, UnfinishedError
        If there is no such parameter, values do not ascend or descend or are outside their range,
        or as for `compute_basins`.

    References
    ----------
    .. [1] G. Datseris, K. L. Rossi and A. Wagemakers, Chaos 33, 073151 (2023),
       https://doi.org/10.1063/5.0159675

    Examples
    --------
    >>> import numpy as np
    >>> from rocksteady import DimensionlessBlock, Harmonic
    >>> from rocksteady.basins import SamplingOptions
    >>> shares = compute_basin_shares(
    ...     DimensionlessBlock(restitution=0.8),
    ...     Harmonic(amplitude=2.0, frequency_ratio=2.0),
    ...     "frequency_ratio",
    ...     [1.9, 2.0, 2.1],
    ...     sampling=SamplingOptions(
    ...         angles=np.linspace(-1, 1, 20), velocities=np.linspace(-1, 1, 20)
    ...     ),
    ... )
    >>> for family, share in zip(shares.families, shares.share):
    ...     print(family.name, share.round(3))
    overturned [0.898 0.885 0.885]
    symmetric-1 [0.042 0.115 0.115]
    unsymmetric-1 [0.06 0.   0.  ]
    """
    block.dimensionless()  # refuses sides too unlike
    equations = chosen_model(model, block)
    how = SamplingOptions() if sampling is None else sampling
    along = _axis(parameter, values)
    shaken = periodic_motion(motion)
    line = [moved_to(block, shaken, parameter, value) for value in along.points.tolist()]
    angle, velocity = shaken_axes(block, how.angles, how.velocities, drawn=how.seed is not None)
    clocks = [moment(moved) for _, moved in line]
    tables = np.array([equations.sides(block_at) for block_at, _ in line])
    cases = functools.partial(
        _settled_along,
        amplitudes=np.array([moved.amplitude for _, moved in line]),
        ratios=np.array([moved.frequency_ratio for _, moved in line]),
        clocks=np.array(clocks),
        sides=tables,
        waves=harmonics_of(shaken),
        cycles=how.max_cycles,
        seed=how.seed,
        cell=(spacing(angle), spacing(velocity)),
        states=len(angle) * len(velocity),
    )
    data = compute_cells(
        cases,
        Grid(axes=(along, velocity, angle)),
        CELL_OUTPUTS,
        run=run,
        batch=batch_size(how.max_cycles),
        numbered="number",
    )
    places = []
    for place, ((block_at, moved), (half, rest), sides) in enumerate(
        zip(line, clocks, tables, strict=True)
    ):
        start = replace(moved, phase=half * math.pi + rest)
        cells = {str(name): data[str(name)][place].values.ravel() for name in data.data_vars}
        places.append(Here(block=block_at, motion=start, sides=sides, cells=cells))
    seed_neighbours(places, how.max_cycles, equations)
    matched = MatchingOptions() if matching is None else matching
    families, label = families_of(places, matched, len(angle) * len(velocity))
    return BasinShares(
        block=block,
        motion=shaken,
        parameter=parameter,
        values=along.points,
        families=families,
        label=label.reshape(len(along), len(velocity), len(angle)),
        angle=angle.points,
        velocity=velocity.points,
        seed=how.seed,
        max_cycles=how.max_cycles,
        matching=matched,
        model=equations,
    )


def _axis(parameter: str, values: ArrayLike) -> Axis:
    """Return the axis of a parameter, ascending or descending."""
    if parameter not in MOVED:
        valid = "shares are computed over " + ", ".join(MOVED)
        raise InputError("parameter", parameter, valid, "name one of them")
    points = real_array("values", values)
    steps = np.diff(points) if points.ndim == 1 else np.zeros(1)
    if points.size == 0 or not ((steps > 0.0).all() or (steps < 0.0).all()):
        valid = "they must be a list of one value or more that ascends or descends"
        raise InputError("values", values, valid, "use numpy.linspace")
    # What a state settles to has a phase of its own among the outputs.
    name = "initial_phase" if parameter == "phase" else parameter
    return Axis(name=name, values=points, long_name=AXES[parameter].long_name)


def _settled_along(
    velocities: Floats,
    angles: Floats,
    number: Integers,
    *,
    amplitudes: Floats,
    ratios: Floats,
    clocks: Floats,
    sides: Floats,
    waves: Harmonics,
    cycles: int,
    seed: int | None,
    cell: tuple[float, float],
    states: int,
    **_moved: Floats,
) -> dict[str, NDArray[Any]]:
    """Return what some cells settle to; at each value a state has the number that it has alone."""
    place, alone = np.divmod(number, states)
    angle, velocity = drawn_states(angles, velocities, alone, seed, cell, sides[0])
    attractors = settled_cells(
        amplitudes[place],
        ratios[place],
        sides[place],
        starting(angle, velocity, clocks[place, 0].astype(np.int64), clocks[place, 1]),
        cycles,
        waves,
    )
    return {**found_in_cells(attractors), "start_angle": angle, "start_velocity": velocity}
