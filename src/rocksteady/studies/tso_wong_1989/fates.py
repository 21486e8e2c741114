"""What a run settles to, and how that depends on how far an unstable orbit is left."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from rocksteady import DimensionlessBlock, Harmonic, Status, Steady, Trajectory, simulate

Floats = NDArray[np.float64]

SETTLED = 1e-6
"""Largest change of theta/alpha from period to period of a motion that counts as settled."""
LONGEST_PERIOD = 12
"""Excitation periods up to which a repetition is looked for."""
SAMPLES = 64
"""Angles compared in an excitation period."""
RUNS = (150, 600, 2400)
"""Excitation periods to follow before looking; longer where the shorter run had not settled."""


class Kind(StrEnum):
    """What became of a block."""

    REST = "at rest"
    SYMMETRIC = "symmetric harmonic"
    UNSYMMETRIC = "unsymmetric harmonic"
    SUBHARMONIC = "subharmonic"
    OVERTURNED = "overturned"
    UNSETTLED = "not settled"


@dataclass(frozen=True, kw_only=True)
class Fate:
    """What a run settles to.

    Attributes
    ----------
    kind
        What became of the block.
    period
        Excitation periods after which the motion repeats itself; 0 unless it does.
    symmetric
        Whether half of that turns it into its mirror image.
    highest, lowest
        Extrema of theta/alpha of the settled motion; nan where there is none.
    phase_tau
        tau = omega t of the highest point within the motion's period.
    overturned_after
        Excitation periods until the block passes |theta| = alpha for good; nan unless it does.
    run
        The run that shows it.
    """

    kind: Kind
    run: Trajectory
    period: int = 0
    symmetric: bool = False
    highest: float = math.nan
    lowest: float = math.nan
    overturned_after: float = math.nan

    @property
    def label(self) -> str:
        """What became of the block, in a few words."""
        if self.kind is Kind.OVERTURNED:
            return f"overturns after {self.overturned_after:.1f} periods"
        if self.kind is Kind.SUBHARMONIC:
            shape = "symmetric" if self.symmetric else "unsymmetric"
            return f"{shape} 1/{self.period} subharmonic"
        return self.kind.value

    @property
    def bias(self) -> int:
        """Side to which an unsymmetric motion leans, +1 or -1; 0 for every other."""
        if self.period == 0 or self.symmetric:
            return 0
        return 1 if self.highest > -self.lowest else -1


def fate_of(run: Trajectory) -> Fate:
    """Return what a run under harmonic shaking has settled to by its end.

    The angle is compared with itself one, two, ... excitation periods earlier, over the last
    `LONGEST_PERIOD` of them; angles, unlike velocities, do not jump.

    Parameters
    ----------
    run
        Followed for some multiples of `LONGEST_PERIOD`; an overturning or resting one may end
        anywhere.

    Returns
    -------
    Fate
        Not settled where no repetition is found within `SETTLED`.
    """
    if run.status is Status.OVERTURNED:
        assert run.overturn_tau is not None
        after = run.overturn_tau / (2.0 * math.pi)
        return Fate(kind=Kind.OVERTURNED, run=run, overturned_after=after)
    if run.status is Status.AT_REST:
        return Fate(kind=Kind.REST, run=run)
    unit = 2.0 * math.pi / run.frequency_ratio
    if run.end_s < 2.0 * LONGEST_PERIOD * unit:
        return Fate(kind=Kind.UNSETTLED, run=run)
    back = np.arange(2 * LONGEST_PERIOD * SAMPLES, -1, -1)
    angle = run(run.end_s - back * (unit / SAMPLES)).angle
    last = angle[LONGEST_PERIOD * SAMPLES :]
    for period in range(1, LONGEST_PERIOD + 1):
        if np.abs(last - _earlier(angle, period * SAMPLES)).max() < SETTLED:
            break
    else:
        return Fate(kind=Kind.UNSETTLED, run=run)
    half = period * SAMPLES // 2
    symmetric = bool(np.abs(last + _earlier(angle, half)).max() < SETTLED)
    kind = Kind.SUBHARMONIC
    if period == 1:
        kind = Kind.SYMMETRIC if symmetric else Kind.UNSYMMETRIC
    return Fate(
        kind=kind,
        run=run,
        period=period,
        symmetric=symmetric,
        highest=_highest(run, period * unit, 1.0),
        lowest=-_highest(run, period * unit, -1.0),
    )


def _earlier(angle: Floats, samples: int) -> Floats:
    """Return the angles that lie a number of samples before the last ones."""
    first = LONGEST_PERIOD * SAMPLES - samples
    return angle[first : len(angle) - samples]


def _highest(run: Trajectory, length: float, sign: float) -> float:
    """Return the largest `sign` times angle over the last `length` of pivot time."""
    times = np.linspace(run.end_s - length, run.end_s, 400)
    coarse = times[int(np.argmax(sign * run(times).angle))]
    step = times[1] - times[0]
    bounds = (max(coarse - step, times[0]), min(coarse + step, run.end_s))
    found = minimize_scalar(
        lambda s: -sign * float(run(s).angle), bounds=bounds, method="bounded",
        options={"xatol": 1e-10},
    )  # fmt: skip
    return float(max(-found.fun, sign * float(run(coarse).angle)))


def settle(restitution: float, shaking: Harmonic, start: Steady, *, side: int = 1) -> Fate:
    """Return what a block settles to that leaves a symmetric steady state.

    Parameters
    ----------
    restitution
        Of the block, in (0, 1].
    shaking
        Amplitude and frequency ratio; the steady state decides the phase.
    start
        The steady state, and how far from it the block is set off.
    side
        +1 or -1.

    Returns
    -------
    Fate
        Of the shortest of the `RUNS` that has settled, or else of the longest.
    """
    block = DimensionlessBlock(restitution=restitution)
    fate = None
    for cycles in RUNS:
        fate = fate_of(simulate(block, shaking, start=start, cycles=cycles, side=side))
        if fate.kind is not Kind.UNSETTLED:
            break
    assert fate is not None
    return fate


def fates_over_kicks(
    restitution: float, shaking: Harmonic, start: Steady, *, side: int, kicks: Sequence[float]
) -> list[Fate]:
    """Return what a block settles to for each distance at which it leaves a steady state."""
    return [
        settle(
            restitution,
            shaking,
            Steady(branch=start.branch, order=start.order, kick=kick),
            side=side,
        )
        for kick in kicks
    ]
