"""Basins of attraction: the attractor reached from each initial state at a given phase."""

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.basins.cells import (
    CELL_OUTPUTS,
    SEED,
    settled_states,
    states_at_phase,
)
from rocksteady.dynamics.basins.labels import BasinAttractor, labelled
from rocksteady.dynamics.basins.measures.entropy import BasinEntropy, compute_basin_entropy
from rocksteady.dynamics.basins.measures.uncertainty import (
    Probe,
    UncertaintyExponent,
    compute_uncertainty_exponent,
)
from rocksteady.dynamics.basins.window import (
    counted,
    moment,
    shaken_axes,
    spacing,
)
from rocksteady.dynamics.batch.attractors import batch_size
from rocksteady.dynamics.history.start import State
from rocksteady.dynamics.orbits.attractor import FORCING_PERIODS
from rocksteady.dynamics.orbits.return_map import periodic_motion
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.confidence import Confidence
from rocksteady.model.checks.validation import index_value
from rocksteady.model.equations import Linear, Model, ModelChoice, chosen_model
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.units import in_units
from rocksteady.outcomes import AttractorKind
from rocksteady.results.numbers import CONFIDENCE
from rocksteady.results.result import Result, words_module
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.evaluate import compute_cells
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import pandas as pd
    import xarray


MAX_CYCLES = 500
"""Default number of forcing periods for which a state is followed."""


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False)
class BasinShare(Result):
    """Share of a window that belongs to one basin.

    Attributes
    ----------
    label
        Label of the attractor.
    states
        Initial states of the window that go there.
    share
        Share of all states of the window.
    low, high
        Wilson's interval of the share.
    """

    label: int
    states: int
    share: float
    low: float
    high: float


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Basins(Result):
    """Basins of attraction over a window of initial states.

    Attributes
    ----------
    block, motion
        Block and base motion; the phase of `motion` is that of all initial states, in [0, 2 pi).
    angle
        u = theta/alpha, shape (n,).
    velocity
        du/d(pt), shape (m,).
    label
        Where each state goes: index of `attractors`, shape (m, n).
    attractors
        One for each label.
    start_angle, start_velocity
        The states, shape (m, n): points of the grid, or drawn in the cells around them.
    max_cycles
        Forcing periods after which a motion counted as aperiodic or undecided.
    seed
        Seed with which they were drawn; None for the points of the grid.
    model
        Which equations of motion hold: `Linear` or `Nonlinear`.
    """

    block: Block | DimensionlessBlock
    motion: PeriodicMotion
    angle: Floats
    velocity: Floats
    label: NDArray[np.int64]
    attractors: tuple[BasinAttractor, ...]
    start_angle: Floats
    start_velocity: Floats
    max_cycles: int
    seed: int | None
    model: Model = field(default_factory=Linear)

    @cached_property
    def states(self) -> NDArray[np.int64]:
        """Number of initial states that go to each attractor, shape (attractors,)."""
        return np.bincount(self.label.ravel(), minlength=len(self.attractors))

    @cached_property
    def stroboscopic(self) -> tuple[Floats, ...]:
        """Where each attractor is at the phase of the shaking: (u, du/d(pt)), shape (points, 2).

        An orbit of n forcing periods is at n points, a block at rest at one; others at none.
        """
        return tuple(states_at_phase(attractor, self.motion) for attractor in self.attractors)

    def fractions(self, confidence: Confidence = CONFIDENCE) -> tuple[BasinShare, ...]:
        """Return the share of each basin in the window, with Wilson's score interval.

        The interval is that of as many states drawn at random in the whole window.  One state drawn
        in each cell (with a seed) never varies more, so that the interval is on the safe side.  The
        middles of the cells are no random sample: usually they are closer still, but a thin basin
        along a line of the grid may be hit or missed as a whole.

        Parameters
        ----------
        confidence
            Confidence of the interval, in (0, 1); default 0.9.

        Returns
        -------
        tuple of BasinShare
            One for each attractor, in their order; the shares add up to 1.

        Raises
        ------
        InputError
            If the confidence is outside its range.

        References
        ----------
        E. B. Wilson, J. Am. Stat. Assoc. 22, 209-212 (1927).
        """
        return tuple(
            BasinShare(label=label, **counted(states, self.label.size, confidence))
            for label, states in enumerate(self.states.tolist())
        )

    def to_dataset(self) -> "xarray.Dataset":
        """Return the labels as an xarray Dataset with dimensions velocity, angle and attractor.

        Returns
        -------
        xarray.Dataset
            ``label`` with flags over velocity (du/d(pt)) and angle; ``start_angle`` and
            ``start_velocity``; kind, period, impacts (0 without an orbit, -1 for infinitely many),
            states and share over attractor.

        Examples
        --------
        >>> from rocksteady import DimensionlessBlock, Harmonic, compute_basins
        >>> block = DimensionlessBlock(restitution=0.8)
        >>> motion = Harmonic(amplitude=2.0, frequency_ratio=4.0)
        >>> window = [-0.5, 0.0, 0.5]
        >>> data = compute_basins(block, motion, angles=window, velocities=window).to_dataset()
        >>> print(data.label.dims, data.label.attrs["flag_meanings"])
        ('velocity', 'angle') overturned symmetric-1
        """
        dataset: xarray.Dataset = words_module(Basins).basins_dataset(self)
        return dataset

    def state(self, row: int, column: int) -> State:
        """Return the initial state of a cell, for `simulate` with `block` and `motion`.

        Parameters
        ----------
        row, column
            Index of its velocity and of its angle.

        Raises
        ------
        InputError
            If there is no such cell.
        """
        place = (
            index_value(row, len(self.velocity), "velocity"),
            index_value(column, len(self.angle), "angle"),
        )
        return State(
            angle=float(self.start_angle[place]), velocity=float(self.start_velocity[place])
        )

    def entropy(self, box: int | Sequence[int] | None = None) -> BasinEntropy:
        """Return the entropy of the basins, as from `compute_basin_entropy`.

        Parameters
        ----------
        box
            Cells along each side of a box, in velocity and in angle; by default the most up to 20
            that divide both axes.
        """
        return compute_basin_entropy(self.label, box)

    def uncertainty_exponent(
        self, sizes: Sequence[int] | None = None, *, by: Probe = "states"
    ) -> UncertaintyExponent:
        """Return the exponent of the boundary, as from `compute_uncertainty_exponent`.

        Parameters
        ----------
        sizes
            Perturbations or sides of boxes, in cells.
        by
            "states" (default) or "boxes".
        """
        return compute_uncertainty_exponent(self.label, sizes, by=by)

    @property
    def undecided(self) -> float:
        """Share of the states whose attractor is undecided."""
        of = [
            attractor.label
            for attractor in self.attractors
            if attractor.kind is AttractorKind.UNDECIDED
        ]
        return float(self.states[of].sum() / self.label.size)

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per state: angle, velocity, label and name of its attractor."""
        import pandas as pd

        names = np.array([attractor.name for attractor in self.attractors])
        columns = {
            "angle": self.start_angle.ravel(),
            "velocity": self.start_velocity.ravel(),
            "label": self.label.ravel(),
            "attractor": names[self.label.ravel()],
        }
        return pd.DataFrame(in_units(columns, self.block))


@checked
def compute_basins(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion,
    *,
    angles: ArrayLike | None = None,
    velocities: ArrayLike | None = None,
    max_cycles: int = MAX_CYCLES,
    seed: int | None = None,
    model: ModelChoice = None,
    run: Execution | None = None,
) -> Basins:
    """Compute the basins of attraction in a window of initial states at one phase.

    Each state is followed as by `find_attractor`; motions that settle to one orbit, whatever their
    shift in time by whole periods, go to one attractor.  Mirror images are two.  All motions that
    have not repeated within `max_cycles` and from which neighbours part count as one attractor,
    aperiodic, and so do those undecided.  With little loss a long transient looks like that too:
    more periods decide.

    Parameters
    ----------
    block
        Its restitution counts, and how its sides differ; in the nonlinear model its slenderness.
    motion
        Its phase is that of all initial states, modulo a period and to 12 decimals.
    angles, velocities
        u = theta/alpha, shape (n,), and du/d(pt), shape (m,), evenly spaced; by default the middles
        of 144 cells up to 1.2 and of 108 up to 1.5 on either side, the window of the explorer's
        page; where the sides differ, in the units of the larger.  Against a wall, angles of 0 or
        above.
    max_cycles
        Forcing periods after which a motion counts as aperiodic or undecided (default 500).
    seed
        With one, a state is drawn in each cell of the grid, instead of its middle.
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.
    run
        Executor, store and progress, as for `evaluate`.

    Returns
    -------
    Basins
        Labels, attractors and shares, in the order overturned, rest, orbits by period and number of
        impacts, aperiodic, undecided.

    Raises
    ------
    InputError, ModelError, OutputError, UnfinishedError
        If a number is outside its range, an axis is not evenly spaced, the nonlinear model meets a
        block without slenderness, or a store cannot be written.

    Examples
    --------
    >>> import numpy as np
    >>> from rocksteady import DimensionlessBlock, Harmonic, simulate
    >>> basins = compute_basins(
    ...     DimensionlessBlock(restitution=0.8),
    ...     Harmonic(amplitude=2.0, frequency_ratio=1.9),
    ...     angles=np.linspace(-1.0, 1.0, 20),
    ...     velocities=np.linspace(-0.95, 0.95, 20),
    ... )
    >>> for attractor, part in zip(basins.attractors, basins.fractions()):
    ...     print(attractor.name, f"{part.share:.4f}", f"{part.low:.3f} to {part.high:.3f}")
    overturned 0.9025 0.875 to 0.924
    unsymmetric-1a 0.0525 0.037 to 0.074
    unsymmetric-1b 0.0450 0.031 to 0.065
    >>> steady = simulate(basins.block, basins.motion, start=basins.attractors[1].start, cycles=2)
    """
    shaken = periodic_motion(motion)
    equations = chosen_model(model, block)
    sides = equations.sides(block)
    half, rest = moment(shaken)
    angle, velocity = shaken_axes(block, angles, velocities, drawn=seed is not None)
    periods = FORCING_PERIODS("max_cycles", max_cycles)
    draw = None if seed is None else SEED("seed", seed)
    start = replace(shaken, phase=half * math.pi + rest)
    cases = functools.partial(
        settled_states,
        motion=shaken,
        sides=sides,
        half_cycles=half,
        phase=rest,
        cycles=periods,
        seed=draw,
        cell=(spacing(angle), spacing(velocity)),
    )
    data = compute_cells(
        cases,
        Grid(axes=(velocity, angle)),
        CELL_OUTPUTS,
        run=run,
        batch=batch_size(periods),
        numbered="number",
    )
    cells = {str(name): data[str(name)].values for name in data.data_vars}
    label, attractors = labelled(block, start, equations, cells)
    return Basins(
        block=block,
        motion=start,
        angle=angle.points,
        velocity=velocity.points,
        label=label,
        attractors=attractors,
        start_angle=cells["start_angle"],
        start_velocity=cells["start_velocity"],
        max_cycles=periods,
        seed=draw,
        model=equations,
    )
