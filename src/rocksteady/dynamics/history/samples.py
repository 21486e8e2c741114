"""Samples of a time history as arrays: motion, flights, impacts."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.kernels.core.tables import COUNTED
from rocksteady.model.checks.arguments import checked_result


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False)
class Samples:
    """Motion of the block at given times, as arrays of the shape of the times.

    Attributes
    ----------
    pt
        Pivot time p t since the start.
    tau
        omega t of harmonic shaking; None for other motions.
    t_s
        Time [s]; None without a block.
    angle
        u = theta/alpha, with alpha of the positive side on either side.
    velocity, acceleration
        du/d(pt) and d2u/d(pt)2; at an impact the value just after it.
    base_acceleration
        In units of alpha g.
    energy
        Kinetic and potential energy above rest, in units of I_0 (p alpha)^2:
        ``velocity^2/2 + |angle| - angle^2/2``; in the nonlinear model
        ``velocity^2/2 + (cos(alpha (1 - |angle|)) - cos(alpha))/alpha^2``.  The upright position
        has 1/2, or ``(1 - cos(alpha))/alpha^2``.  On the other side of an asymmetric block it is
        over that side's I_0, which an impact without loss of velocity leaves as it is: with its
        alpha and p over the reference's, lambda and rho, and y = |angle|/lambda the second term
        is ``(lambda rho)^2`` times the same of y and of that side's alpha.
    """

    pt: Floats
    tau: Floats | None
    t_s: Floats | None
    angle: Floats
    velocity: Floats
    acceleration: Floats
    base_acceleration: Floats
    energy: Floats


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False)
class Flights:
    """All flights and rests in order, as arrays of shape (flights,).

    A flight that crosses from one segment of the base motion into the next is two of them.

    Attributes
    ----------
    pt
        Pivot time at the start.
    duration
        In pivot time; infinite for the last flight of a block that overturns.
    side
        +1, -1, or 0 at rest.
    angle, velocity
        u and du/d(pt) at the start.
    ended_by
        0 the end of the segment or of the run, 1 an impact, 2 proof that the block never comes
        back, 3 uplift from rest.
    """

    pt: Floats
    duration: Floats
    side: NDArray[np.int64]
    angle: Floats
    velocity: Floats
    ended_by: NDArray[np.int64]

    def __len__(self) -> int:
        """Return the number of flights and rests."""
        return len(self.pt)


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False)
class Impacts:
    """Impacts in order, as arrays of shape (impacts,).

    Those of a `Trajectory` leave with 1e-6 or more in du/d(pt), in the alpha and p of the side that
    they leave to: chatter, which brings a block to rest, has no end of slower ones.

    Attributes
    ----------
    pt
        Pivot time since the start.
    half_cycles, phase
        Harmonic motion: whole half periods of the shaking and the phase within the next [rad],
        which lose no digits however long the run; otherwise the segment's index and the time in it.
    side
        The side the block falls from, +1 or -1.
    velocity_before, velocity_after
        du/d(pt).
    """

    pt: Floats
    half_cycles: NDArray[np.int64]
    phase: Floats
    side: NDArray[np.int64]
    velocity_before: Floats
    velocity_after: Floats

    def __len__(self) -> int:
        """Return the number of impacts."""
        return len(self.pt)


COUNTED_IMPACTS = f"impacts that leave with {COUNTED:g} or more in du/d(pt)"
