"""A shaken block as the return map sees it: under harmonic shaking, or under a Fourier series.

Both kinds of a system have the same fields.  A function that takes one of them takes the other: the
compiler makes two versions of it, each with the branches of its own kind.
"""

from functools import cache
from typing import Any, NamedTuple

from rocksteady.kernels.core import tables
from rocksteady.kernels.core.clock import side_phase
from rocksteady.kernels.core.forcing import Forcing, make_forcing
from rocksteady.kernels.core.harmonics import (
    fill_lifts,
    is_antisymmetric,
    level_of,
)
from rocksteady.kernels.core.tables import Floats, free_side, is_nonlinear, left_out_of
from rocksteady.kernels.core.typed import ONE
from rocksteady.kernels.machine_code.compilation import allocating, compiled, inlined, retyped
from rocksteady.kernels.machine_code.types import Floats1, Floats2
from rocksteady.kernels.nonlinear.drive import Drive, foot_forcing


class System(NamedTuple):
    """Harmonic shaking seen from both sides of a block.

    Of the nonlinear model the forcings are those of a block on its base.
    """

    positive: Forcing
    negative: Forcing
    frequency: float  # Omega, in reference time
    restitution: tuple[float, float]  # of the positive and the negative side; of a wall negative
    free: int  # the one side of a block against a wall, or 0
    lean: tuple[float, float]
    rate: tuple[float, float]
    # Of the nonlinear model; 0 in the linear one.
    alpha: tuple[float, float]
    amplitude: float  # A of the reference
    left_out: float  # by a step; 0 in the linear model
    shares: None = None  # of a sinusoid: no series
    lifts: None = None


class SeriesSystem(NamedTuple):
    """Shaking by a Fourier series seen from both sides of a block.

    The forcings have the constants of the foot and, for amplitude, the bound of the series.
    """

    positive: Forcing
    negative: Forcing
    frequency: float
    restitution: tuple[float, float]
    free: int
    lean: tuple[float, float]
    rate: tuple[float, float]
    alpha: tuple[float, float]
    amplitude: float
    left_out: float  # in either model
    shares: Floats1  # its shape (`rocksteady.kernels.core.harmonics`)
    lifts: Floats2  # phases at which it lifts either side, shape (2, orders)


EitherSystem = Any
"""A `System` or a `SeriesSystem`, for functions of which the compiler makes two versions."""


@cache
def for_series(kernel: Any) -> Any:
    """Return the kernel that does under a Fourier series what another one does."""
    return retyped(kernel, f"series_{kernel.__name__}", system=SeriesSystem)


def for_system(kernel: Any, system: EitherSystem) -> Any:
    """Return a kernel for the kind of a system."""
    return for_series(kernel) if isinstance(system, SeriesSystem) else kernel


@compiled
def make_system(amplitude: float, frequency: float, sides: Floats2) -> System:
    """Return the system of shaking ``A sin(Omega s + phi)`` and a table of sides."""
    size_here, turn_here = amplitude / sides[0, tables.LEAN], frequency / sides[0, tables.RATE]
    size_there, turn_there = amplitude / sides[1, tables.LEAN], frequency / sides[1, tables.RATE]
    alpha_here = alpha_there = left_out = 0.0
    if is_nonlinear(sides):
        alpha_here, alpha_there = sides[0, tables.ALPHA], sides[1, tables.ALPHA]
        left_out = sides[0, tables.LEFT_OUT]
        here = Drive(alpha_here, 0.0, 0.0, size_here, turn_here, 0.0, 0.0, 0.0)
        there = Drive(alpha_there, 0.0, 0.0, size_there, turn_there, 0.0, 0.0, 0.0)
        positive, negative = foot_forcing(here), foot_forcing(there)
    else:
        positive = make_forcing(-1.0, 0.0, size_here, turn_here)
        negative = positive
        if size_there != size_here or turn_there != turn_here:
            negative = make_forcing(-1.0, 0.0, size_there, turn_there)
    return System(
        positive,
        negative,
        frequency,
        (sides[0, tables.RESTITUTION], sides[1, tables.RESTITUTION]),
        free_side(sides),
        (sides[0, tables.LEAN], sides[1, tables.LEAN]),
        (sides[0, tables.RATE], sides[1, tables.RATE]),
        (alpha_here, alpha_there),
        amplitude,
        left_out,
        None,
        None,
    )


@allocating
def make_series_system(
    amplitude: float, frequency: float, sides: Floats2, shares: Floats1, lifts: Floats2
) -> SeriesSystem:
    """Return the system of a Fourier series and a table of sides.

    Parameters
    ----------
    amplitude, frequency
        A, which bounds the acceleration, and Omega of the period.
    sides
        As for `make_system`.
    shares
        Two of each order, shape (2 orders,).
    lifts
        Receives the phases of uplift, shape (2, orders).
    """
    system = make_system(amplitude, frequency, sides)
    fill_uplifts(system, shares, lifts)
    return SeriesSystem(
        system.positive,
        system.negative,
        frequency,
        system.restitution,
        system.free,
        system.lean,
        system.rate,
        system.alpha,
        amplitude,
        left_out_of(sides),
        shares,
        lifts,
    )


@compiled
def fill_uplifts(system: System, shares: Floats1, lifts: Floats2) -> None:
    """Fill the phases at which a Fourier series lifts either side, shape (2, orders).

    The system is that of a sinusoid with the amplitude that bounds the series.
    """
    fill_lifts(shares, 1.0, level_of(system.positive), lifts[0])
    fill_lifts(shares, -1.0, level_of(system.negative), lifts[1])


@inlined
def sign_in(shares: Floats | None, row: int) -> float:
    """Return how the side of a row sees a series: 1 or -1; 0 of a sinusoid."""
    if shares is None:
        return 0.0
    return 1.0 if row == 0 else -1.0


@inlined
def seen_from(
    shares: Floats | None, half: int, phase: float, side: int, frequency: float
) -> tuple[float, int]:
    """Return what `side_phase` does; of a series the phase is the base's on both sides."""
    if shares is None:
        return side_phase(half, phase, side, frequency)
    return side_phase(half, phase, ONE, frequency)


@compiled
def turns_round(shares: Floats | None) -> bool:
    """Return whether half a period turns the shaking round."""
    if shares is None:
        return True
    return is_antisymmetric(shares)


@compiled
def forcing_of(system: System, side: int) -> Forcing:
    """Return the forcing seen from one side."""
    return system.positive if side > 0 else system.negative


@compiled
def like_sides(system: System) -> bool:
    """Return whether a block has two sides that are alike."""
    return (
        system.restitution[0] == system.restitution[1]
        and system.lean[0] == system.lean[1]
        and system.rate[0] == system.rate[1]
        and system.alpha[0] == system.alpha[1]
    )


@compiled
def is_mirrored(system: EitherSystem) -> bool:
    """Return whether the mirror image of a motion, half a period later, is a motion too."""
    return like_sides(system) and turns_round(system.shares)


@inlined
def next_side(system: System, side: int) -> int:
    """Return the side to which an impact sends the block."""
    return -side if system.free == 0 else side


@compiled
def drive_of(system: System, row: int) -> Drive:
    """Return what drives the side of a row, where its flights are steps."""
    return Drive(
        system.alpha[row],
        0.0,
        0.0,
        system.amplitude / system.lean[row],
        system.frequency / system.rate[row],
        0.0,
        0.0,
        sign_in(system.shares, row),
    )
