"""Periodic orbits as closed chains of arcs: equations and derivatives for continuation.

The unknowns are the phases of the impacts alone.  Between two of them the block flies an arc
(`kernels.linear.arcs`, `kernels.nonlinear.arcs`), and at impact k the arc that begins must leave
with what the impact leaves of the one that lands (eq 9)::

    F_k = start(Phi_k, Phi_(k+1)) - restitution landing(Phi_(k-1), Phi_k) = 0,  k = 0 .. m - 1
    Phi_m = Phi_0 + h pi

with m arcs in h half periods of the shaking, both even or both odd.  An even chain is a whole
orbit.  An odd one is half of a symmetric orbit: a half period later the shaking is reversed and the
block is on its other side, so that the second half is the mirror image of the first.  A block
against a wall stays on its side: its chains are whole orbits, with any number of arcs in an even
number of half periods, and the restitution is the wall's.  F is smooth
where orbits are created, turn unstable or graze, and its derivative is a cyclic band: F_k knows the
phases k - 1, k and k + 1 only.

Closed with a factor z instead (``dPhi_m = z dPhi_0``) the derivative is singular where z is a
Floquet multiplier: z = 1 at a fold; z = -1 where an even chain doubles its period and where an odd
one breaks its symmetry.
"""

import math

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.linear.arcs import arc_flight, make_arc
from rocksteady.kernels.linear.extrema import inner_extrema
from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.machine_code.types import Floats1, Floats2, Integers1
from rocksteady.kernels.nonlinear.arcs import nonlinear_arc, nonlinear_extrema
from rocksteady.kernels.orbits.return_map import Jacobian, identity, product
from rocksteady.kernels.orbits.systems import (
    EitherSystem,
    SeriesSystem,
    System,
    drive_of,
    forcing_of,
    make_system,
)

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]

# Columns of the table of a chain, one row an impact.
START = 0  # speed after it, per pivot time
LANDING = 1  # speed with which the arc that it begins lands
DURATION = 2  # pivot time of that arc
ERROR = 3  # F
BY_BEFORE = 4  # derivatives of F by the phase of the impact before, ...
BY_HERE = 5
BY_AFTER = 6
BY_AMPLITUDE = 7
BY_FREQUENCY = 8
BY_RESTITUTION = 9
CHAIN_COLUMNS = 10


@compiled
def side_of(row: int) -> int:
    """Return the side to which impact `row` sends the block: a chain begins on the positive one."""
    return 1 if row % 2 == 0 else -1


@compiled
def side_in(system: System, row: int) -> int:
    """Return it of a block that may stand against a wall, where it is the free side."""
    return side_of(row) if system.free == 0 else system.free


@compiled
def seen(turns: int, phase: float, side: int) -> float:
    """Return the phase of the shaking seen from a side, whole periods left out."""
    return phase if (turns % 2 == 0) == (side > 0) else phase + math.pi


@compiled
def seen_from(shares: Floats | None, turns: int, phase: float, side: int) -> float:
    """Return what `seen` does; of a Fourier series the phase is the base's on both sides."""
    if shares is None:
        return seen(turns, phase, side)
    return seen(turns, phase, 1)


@compiled
def fill_chain(
    amplitude: float,
    frequency: float,
    sides: Floats2,
    turns: Integers1,
    phases: Floats1,
    half_cycles: int,
    table: Floats2,
) -> None:
    """Fill the table of a chain.

    Parameters
    ----------
    amplitude, frequency
        A and Omega.
    sides
        As for `kernels.orbits.systems.make_system`, of either model; the derivative by the
        restitution is that by both sides' together.
    turns, phases
        Whole half cycles and the phase beyond them at each impact, shape (m,).
    half_cycles
        h, even with m or odd with m; even of a block against a wall.
    table
        Shape (m, CHAIN_COLUMNS).
    """
    fill_rows(make_system(amplitude, frequency, sides), turns, phases, half_cycles, table)


@compiled
def series_fill_chain(
    system: SeriesSystem, turns: Integers1, phases: Floats1, half_cycles: int, table: Floats2
) -> None:
    """Do what `fill_chain` does under a Fourier series; its amplitude is the bound of the series.

    The half periods are those of its period: odd only where half a period turns it round.
    """
    fill_rows(system, turns, phases, half_cycles, table)


@compiled
def fill_rows(
    system: EitherSystem, turns: Integers1, phases: Floats1, half_cycles: int, table: Floats2
) -> None:
    """Fill the table of a chain in a system of either kind."""
    m = len(phases)
    table[:, ERROR:] = 0.0
    for k in range(m):
        side = side_in(system, k)
        row = 0 if side > 0 else 1
        forcing = forcing_of(system, side)
        after = (k + 1) % m
        halves = (turns[after] + (half_cycles if after == 0 else 0)) - turns[k]
        passed = halves * math.pi + (phases[after] - phases[k])
        duration = passed / forcing.frequency
        # An odd chain closes on the other side, where the shaking has turned by as much.
        last = seen_from(system.shares, turns[k] + halves, phases[after], side)
        first = seen_from(system.shares, turns[k], phases[k], side)
        if system.left_out > 0.0:
            arc = nonlinear_arc(drive_of(system, row), duration, first, last, system.shares)
        else:
            arc = make_arc(forcing, duration, first, last)
        lean, rate = system.lean[row], system.rate[row]
        unit = lean * rate
        table[k, START], table[k, LANDING] = unit * arc.start, unit * arc.landing
        table[k, DURATION] = duration / rate
        table[k, ERROR] += unit * arc.start
        table[k, BY_HERE] += unit * arc.start_by_first
        table[k, BY_AFTER] = unit * arc.start_by_last
        table[k, BY_AMPLITUDE] += rate * arc.start_by_amplitude
        table[k, BY_FREQUENCY] += lean * arc.start_by_frequency
        kept = abs(system.restitution[row])
        table[after, ERROR] -= kept * unit * arc.landing
        table[after, BY_BEFORE] = -kept * unit * arc.landing_by_first
        table[after, BY_HERE] -= kept * unit * arc.landing_by_last
        table[after, BY_AMPLITUDE] -= kept * rate * arc.landing_by_amplitude
        table[after, BY_FREQUENCY] -= kept * lean * arc.landing_by_frequency
        table[after, BY_RESTITUTION] = -unit * arc.landing


@compiled
def fill_matrix(table: Floats2, closing: float, matrix: Floats2) -> None:
    """Fill the derivative of F by the phases, shape (m, m), closed with a factor of 1 or -1."""
    m = len(table)
    matrix[:, :] = 0.0
    for k in range(m):
        matrix[k, k] += table[k, BY_HERE]
        matrix[k, (k + 1) % m] += table[k, BY_AFTER] * (closing if k + 1 == m else 1.0)
        matrix[k, (k - 1) % m] += table[k, BY_BEFORE] * (closing if k == 0 else 1.0)


@compiled
def turned_over(table: Floats2) -> Jacobian:
    """Return what a chain makes of a displacement of the phases of its last two impacts.

    Its eigenvalues are those of the return map over the chain; its entries are infinite where an
    arc lands without speed.
    """
    total = identity()
    for k in range(len(table)):
        ahead = table[k, BY_AFTER]
        step = Jacobian(0.0, 1.0, -table[k, BY_BEFORE] / ahead, -table[k, BY_HERE] / ahead)
        total = product(step, total)
    return total


@compiled
def fill_arcs(
    system: System, turns: Integers1, phases: Floats1, table: Floats2, shape: Floats2
) -> None:
    """Fill the extrema of each arc: largest |theta|/alpha, least minimum and its pivot time.

    A minimum at the base is a graze, one below it makes the chain inadmissible; inf and nan where
    the arc has none.  Of an arc without a positive duration all are nan.  `shape` is (m, 3).
    """
    for k in range(len(phases)):
        side = side_in(system, k)
        forcing = forcing_of(system, side)
        rate = system.rate[0] if side > 0 else system.rate[1]
        lean = system.lean[0] if side > 0 else system.lean[1]
        duration = table[k, DURATION] * rate
        if not duration > 0.0:
            shape[k, :] = math.nan
            continue
        first = seen_from(system.shares, turns[k], phases[k], side)
        last = first + forcing.frequency * duration
        if system.left_out > 0.0:
            drive = drive_of(system, 0 if side > 0 else 1)
            highest, lowest, when = nonlinear_extrema(drive, duration, first, last, system.shares)
        else:
            flight = arc_flight(forcing, duration, first, last)
            highest, lowest, when, _ = inner_extrema(flight, forcing, duration)
        shape[k, 0], shape[k, 1], shape[k, 2] = max(0.0, highest) * lean, lowest * lean, when / rate
