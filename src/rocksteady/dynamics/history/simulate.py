"""Time history of one block, computed from its base motion and initial state."""

from dataclasses import replace
from typing import Annotated

import numpy as np

from rocksteady.dynamics.history.start import HasStart, Start, initial_march, start_of
from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.kernels.core.tables import ROW_COLUMNS, SMALLEST_BOUNCE
from rocksteady.kernels.core.tuples import Kept, Until
from rocksteady.kernels.march.facts import run_end
from rocksteady.kernels.march.march import march
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds, Whole
from rocksteady.model.equations import ModelChoice, chosen_model
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Motion
from rocksteady.outcomes import Status

LONGEST_RUN = 1.0e15
"""Most forcing periods of a run; their half periods are still counted exactly."""
PERIODS = Bounds(0.0, LONGEST_RUN, "(]", "give the number of forcing periods to follow")

FLIGHT_LIMIT = 4_000_000
"""Flights after which a run ends; they would fill 256 MB."""

MOST_FLIGHTS = 100_000_000
"""The highest such limit."""


@checked
def simulate(
    block: Block | DimensionlessBlock,
    motion: Motion | Record | BaseMotion,
    *,
    start: Start | HasStart | None = None,
    cycles: Annotated[float, PERIODS] = 50.0,
    model: ModelChoice = None,
    max_flights: Annotated[int, Whole(1, MOST_FLIGHTS, "give a number of flights")] = FLIGHT_LIMIT,
) -> Trajectory:
    """Compute the time history of a block on a moving base, flight by flight.

    In the linear model (eqs 4 to 9) flights are in closed form; in the nonlinear one (eqs 1, 2)
    they are Taylor series, step by step, to the model's tolerance.  In both, impacts are isolated
    so that none can be missed, and found to the last digits of a double; overturning is proved, not
    read off a threshold.

    Parameters
    ----------
    block
        A `Block`, or a `DimensionlessBlock` where only restitution matters.  For one whose sides
        differ, alpha and p of the positive side are the units.
    motion
        The base motion: `Harmonic`, `Pulse`, `Impulses`, `Piecewise`, `SyntheticMotion`, `Still`,
        anything else with segments, a `Record`, which needs a `Block`, or a `BaseMotion` of two.
    start
        `Rest` (default), `State`, `Steady`, a steady state of the model, or `ImpactState`; one
        with a phase decides the phase of harmonic shaking.  A result with a ``start``, such as an
        `Orbit` or a `BranchPoint`, stands for it.
    cycles
        Periods of endless harmonic shaking to follow, up to 1e15.  Motions that end are followed
        on a still base to rest or proven overturning; without loss (restitution 1) for p t = 1e4.
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.  `Nonlinear` takes a
        tolerance.
    max_flights
        Flights after which the run ends, at rest where the bounces to come on a still base are
        proved to die out, else undecided; up to a hundred million, which fill 6.4 GB.

    Returns
    -------
    Trajectory
        Evaluable at any time; its status is how it ended.

    Raises
    ------
    InputError
        If a number is outside its range, or an argument is of another type.
    ModelError
        If the start does not fit the motion, a record or the nonlinear model meets a dimensionless
        block, or the linear model a vertical motion, for which its equations have no term.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic, Steady, simulate
    >>> run = simulate(
    ...     DimensionlessBlock(restitution=0.8),
    ...     Harmonic(amplitude=2.0, frequency_ratio=4.0),
    ...     start=Steady(),
    ...     cycles=10,
    ... )
    >>> print(run.status.label, len(run.impacts), f"{run.peak:.6f}")
    rocking 20 0.185499

    A `Block` moves by the full equations:

    >>> from rocksteady import Block
    >>> run = simulate(
    ...     Block.from_p(alpha=0.2, p=2.0, restitution=0.8),
    ...     Harmonic(amplitude=2.0, frequency_ratio=4.0),
    ...     start=Steady(),
    ...     cycles=10,
    ... )
    >>> print(f"{run.peak:.6f}")
    0.183552
    """
    equations = chosen_model(model, block)
    base = motion if isinstance(motion, BaseMotion) else BaseMotion(motion)
    across, vertical = base.horizontal, base.vertical
    begun = start_of(start)
    shaken, begin = initial_march(begun, block.dimensionless(), across, equations.sides(block))
    tables = equations.lower(block, shaken, vertical)
    until = Until(*run_end(tables, cycles), SMALLEST_BOUNCE, max_flights)
    _, end = march(tables, begin, until, Kept(np.zeros((0, ROW_COLUMNS)), np.zeros(0)))
    rows = np.zeros((end.flights, ROW_COLUMNS))
    status, _ = march(tables, begin, until, Kept(rows, np.zeros(0)))
    run = Trajectory(
        block=block,
        motion=shaken,
        vertical=vertical,
        model=equations,
        start=begun,
        status=Status(status),
        segments=tables.segments,
        sides=tables.sides,
        rows=rows,
    )
    if run.status is Status.AT_REST and end.flights == max_flights:
        return replace(run, impacts_left_out=end.impacts - len(run.impacts))
    return run
