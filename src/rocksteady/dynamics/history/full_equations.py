"""Runs in the full equations beside those of the linear model, of blocks of known size."""

import math

from rocksteady.dynamics.history._outcome import outcome, peak_words
from rocksteady.dynamics.history.simulate import simulate
from rocksteady.dynamics.history.start import Rest, State
from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.model.blocks.block import Block
from rocksteady.model.equations import Nonlinear, needs_full_equations
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.outcomes import Status
from rocksteady.results.description import Fact

LEAST, LONGEST = 50, 1000
"""Periods of the base motion over which the full equations are followed: at least, at most."""


def full_run(run: Trajectory) -> Fact:
    """Return the fact of how the same start ends in the full equations.

    Its value is None where these were computed, or the block has no known size.
    """
    block, motion = run.block, run.motion
    if not needs_full_equations(block, motion, run.model):
        return Fact("full_equations")
    assert isinstance(block, Block)
    assert isinstance(motion, PeriodicMotion)
    first = run(0.0)
    start = State(angle=float(first.angle), velocity=float(first.velocity))
    periods = run.end_time_pt * motion.frequency_ratio / (2.0 * math.pi)
    full = simulate(
        block,
        motion,
        start=run.start if isinstance(run.start, Rest) else start,
        cycles=min(max(periods, LEAST), LONGEST),
        model=Nonlinear(),
    )
    values = {
        "status": full.status.label,
        "peak": full.peak,
        "overturn_time_s": full.overturn_time_s,
    }
    words = outcome(full)
    if full.status is not Status.OVERTURNED:
        words += f", peak {peak_words(full.peak, block.alpha if block.symmetric else None)}"
    return Fact("full_equations", values, "full equations", words)
