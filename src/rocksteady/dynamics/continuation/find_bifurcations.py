"""Bifurcation diagram found: from which motions branches start, and over which range."""

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import real_array
from rocksteady.dynamics.continuation.branches import (
    BranchOptions,
    find_branches,
    refuse_wall,
    searched_orbits,
    settled_orbits,
    simple_orbits,
)
from rocksteady.dynamics.continuation.cascade import longest_cascade
from rocksteady.dynamics.continuation.diagram import BifurcationDiagram
from rocksteady.dynamics.continuation.resting.find_resting import find_resting_branches
from rocksteady.dynamics.continuation.resting.resting_branch import RestingBranch
from rocksteady.dynamics.history.start import (
    HasStart,
    Rest,
    Start,
    Steady,
    initial_march,
    start_of,
)
from rocksteady.dynamics.orbits.attractor_sweep import AttractorSweep, sweep_attractor
from rocksteady.dynamics.orbits.return_map import periodic_motion
from rocksteady.dynamics.parameters import PARAMETERS, moved_to, range_of
from rocksteady.errors import InputError, ModelError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import whole_number
from rocksteady.model.equations import Model, ModelChoice, chosen_model
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.segments import Harmonic

LONGEST_SWEEP = 20_000
"""Values of a sweep; each takes about a millisecond, a motion that does not settle several."""
VALUES = 400
"""Default number of values of a sweep."""


@checked
def find_bifurcations(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion,
    parameter: str,
    *,
    within: tuple[float, float] | None = None,
    values: ArrayLike | None = None,
    start: Start | HasStart | None = None,
    search: BranchOptions | None = None,
    model: ModelChoice = None,
) -> BifurcationDiagram:
    """Find the periodic motions over a parameter, with all bifurcations that connect them.

    Branches start from the symmetric motions in closed form, or those of the nonlinear model to
    which they lead, and from what two sweeps, upwards and downwards, settle to.  They are followed
    around their folds, and so is every branch that begins at a bifurcation.  Orbits that come to
    rest are found over the whole range (`find_resting_branches`).  One of each pair of
    mirror images is followed.  A block whose sides differ has neither symmetric motions nor mirror
    images: in their place a search finds motions with two impacts at several values.  So it does
    under a Fourier series, which has no closed form; orbits that come to rest are not followed
    under one.

    Parameters
    ----------
    block
        It rocks on both of its sides.  Over "restitution" both impacts have the same.
    motion
        Harmonic shaking or a Fourier series.  Its phase is that at the start of each sweep.
    parameter
        "amplitude", "frequency_ratio" or "restitution".
    within
        Its range (low, high); by default the ends of `values`, or from half to twice its own value.
    values
        Values of the sweeps: their number (default 400; 0 for no sweeps), or the values themselves.
    start
        Start of each sweep; by default the steady state, or rest where there is none.
    search
        Which branches are followed, and for how long the sweeps wait; by default `BranchOptions()`.
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.

    Returns
    -------
    BifurcationDiagram
        Branches, bifurcations and sweeps: amplitudes over alpha g, frequencies over p, peaks over
        alpha.

    Raises
    ------
    InputError, ModelError
        If a value is outside its range, the block stands against a wall, or the nonlinear model
        meets a block without slenderness.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic
    >>> block = DimensionlessBlock(restitution=0.8)
    >>> motion = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    >>> diagram = find_bifurcations(block, motion, "frequency_ratio", within=(1.8, 2.4), values=7)
    >>> for each in diagram.points:
    ...     print(each.point.type, f"{each.point.frequency_ratio:.6f}", each.branches)
    symmetry-breaking 1.948378 (1, 2)
    """
    refuse_wall(block, "branches")
    equations = chosen_model(model, block)
    shaken, asked = periodic_motion(motion), BranchOptions() if search is None else search
    if parameter not in PARAMETERS:
        valid = "orbits are followed over " + ", ".join(PARAMETERS)
        raise InputError("parameter", parameter, valid, "name one of them")
    (low, high), steps = _range_of(block, shaken, parameter, within, values)
    sweeps = tuple(
        _swept(
            block,
            shaken,
            parameter,
            way,
            start_of(Steady(order=asked.orders[0]) if start is None else start),
            max_cycles=asked.max_cycles,
            model=equations,
        )
        for way in ((steps, steps[::-1]) if steps.size else ())
    )
    origins = [
        *simple_orbits(block, shaken, parameter, (low, high), asked, equations),
        *settled_orbits(sweeps, asked),
    ]
    if asked.everywhere:
        origins += searched_orbits(block, shaken, parameter, (low, high), asked, equations)
    branches = find_branches(
        origins,
        parameter,
        (low, high),
        max_period=asked.longest,
        max_impacts=asked.max_impacts,
        max_branches=asked.max_branches + 1,
    )
    complete = len(branches) <= asked.max_branches  # one more shows that more would have begun
    branches = branches[: asked.max_branches]
    cascade = longest_cascade(branches, (low, high), asked.doublings) if asked.doublings else None
    return BifurcationDiagram(
        block=block,
        motion=shaken,
        parameter=parameter,
        within=(low, high),
        search=asked,
        branches=branches,
        sweeps=sweeps,
        cascade=cascade,
        complete=complete,
        resting=_resting(block, shaken, parameter, (low, high), asked, equations),
        model=equations,
    )


def _resting(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion,
    parameter: str,
    within: tuple[float, float],
    search: BranchOptions,
    model: Model,
) -> tuple[RestingBranch, ...]:
    """Return the branches of orbits that come to rest; none under a Fourier series."""
    if not isinstance(motion, Harmonic):
        return ()
    longest = search.longest
    return find_resting_branches(
        block, motion, parameter, within, max_period=longest, model=model
    ).branches


def _range_of(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion,
    parameter: str,
    within: object,
    values: ArrayLike | None,
) -> tuple[tuple[float, float], Floats]:
    """Return the range of a diagram, and the values of its upward sweep.

    Raises
    ------
    InputError
        If they are not valid, or too many.
    """
    chosen = VALUES if values is None else values
    given, count = np.atleast_1d(real_array("values", chosen)), np.ndim(chosen) == 0
    if within is None and not count and given.size > 1:
        within = (float(given.min()), float(given.max()))
    if within is None:
        if parameter == "restitution":
            here = block.dimensionless().restitution
            within = (0.5 * here, min(2.0 * here, 1.0))
        else:
            here = float(getattr(motion, parameter))
            within = (0.5 * here, 2.0 * here)
    low, high = range_of(within, parameter)
    for end in (low, high):
        moved_to(block, motion, parameter, end)  # refuses what is outside its range
    if not count:
        steps = np.sort(given)
    else:
        hint = "give a number of values, as 400, or 0 for no sweeps"
        value_count = whole_number("values", np.asarray(chosen).item(), at_least=0, hint=hint)
        steps = (
            np.linspace(low, high, min(value_count, LONGEST_SWEEP + 1))
            if value_count
            else np.zeros(0)
        )
    if steps.size > LONGEST_SWEEP:
        raise InputError(
            "values", steps.size, f"sweeps go through at most {LONGEST_SWEEP}", "take fewer"
        )
    return (low, high), steps


def _swept(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion,
    parameter: str,
    steps: Floats,
    start: Start,
    *,
    max_cycles: int,
    model: Model,
) -> AttractorSweep:
    """Return a sweep; from rest where it should begin on a steady state that does not exist."""
    body, shaken = moved_to(block, motion, parameter, float(steps[0]))
    if isinstance(start, Steady):
        try:
            initial_march(start, body.dimensionless(), shaken, model.sides(body))
        except ModelError:
            start = Rest()
    return sweep_attractor(
        body, shaken, parameter, steps, start=start, max_cycles=max_cycles, model=model
    )
