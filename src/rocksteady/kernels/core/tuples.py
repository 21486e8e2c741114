"""Tuples that kernels pass on: what belongs together, under one name."""

from typing import NamedTuple

from rocksteady.kernels.machine_code.types import Floats1, Floats2, Floats3, Integers1, Integers2


class Tables(NamedTuple):
    """A motion and a block, with the columns of `rocksteady.kernels.core.tables`.

    Attributes
    ----------
    segments
        Shape (segments, 9); of the nonlinear model (segments, 12); of either with a Fourier series
        of so many orders (segments, 13 + 2 orders).
    sides
        Shape (2, 3); of the nonlinear model (2, 5); of either with restitution that scatters
        (2, 7).
    """

    segments: Floats2
    sides: Floats2


class Until(NamedTuple):
    """Where a march ends at the latest, and when it may come to rest.

    Attributes
    ----------
    half_cycles, phase
        The clock reading on the last segment at which the run ends, where that is endless.
    rest_velocity
        Chatter slower than this, in du/d(pt) with the alpha and p of either side, ends in rest as
        soon as the bound of `rocksteady.kernels.march.rest` proves that it does.  From COUNTED on,
        impacts on a still base are counted without flights; those left out on a moving base are
        not.  If infinite, impacts slower than COUNTED count too.
    limit
        Flights and rests after which the march gives up as UNDECIDED, as it does before a
        nonlinear flight whose steps come to nothing (`kernels.nonlinear.flight.is_stuck`).  A still
        base on which the bounces before are proved to die out decides.
    """

    half_cycles: int
    phase: float
    rest_velocity: float
    limit: int


class Kept(NamedTuple):
    """What a march keeps of its flights.

    Attributes
    ----------
    rows
        Array of shape (flights, 8) that receives the flights, as many as a first march without
        rows (0, 8) has counted: a march does not depend on whether it is recorded.
    peaks
        Array of shape (2,) for the largest |theta|/alpha of either side and the largest |velocity|
        up to the end, or to the proof of overturning; values already in it are kept where they are
        larger.  Of shape (0,): no peaks.  In shape (11,) they are followed by what
        `kernels.core.tables.keep_passage` keeps.
    """

    rows: Floats2
    peaks: Floats1


class Cells(NamedTuple):
    """Blocks under harmonic shaking, one a cell.

    Attributes
    ----------
    amplitude, frequency_ratio
        Shape (cells,).
    sides
        Shape (cells, 2, 3) or, in the nonlinear model, (cells, 2, 5).
    """

    amplitude: Floats1
    frequency_ratio: Floats1
    sides: Floats3


class SymmetricCells(NamedTuple):
    """Symmetric blocks of the linear model under harmonic shaking; arrays of shape (cells,)."""

    amplitude: Floats1
    frequency_ratio: Floats1
    restitution: Floats1


class SeriesCells(NamedTuple):
    """Blocks under a Fourier series: `Cells`, and the shares of the series, which all cells have.

    The amplitudes bound the acceleration, as `rocksteady.kernels.core.harmonics` has them.
    """

    amplitude: Floats1
    frequency_ratio: Floats1
    shares: Floats1
    sides: Floats3


class Starts(NamedTuple):
    """Where motions start: theta/alpha, its derivative by s, and the phase, of shape (cells,)."""

    angle: Floats1
    velocity: Floats1
    phase: Floats1


class States(NamedTuple):
    """Where motions start, as `rocksteady.kernels.core.tables.March` has it, of shape (cells,)."""

    side: Integers1
    angle: Floats1
    velocity: Floats1
    half_cycles: Integers1
    phase: Floats1


class Fates(NamedTuple):
    """Receives how motions end: status code, number of impacts, and (angle, velocity, phase)."""

    status: Integers1
    impacts: Integers1
    final: Floats2


class Outcomes(NamedTuple):
    """Receives what motions settle to, in the columns of `rocksteady.kernels.batch.attractors`."""

    whole: Integers2
    real: Floats2


class Blocks(NamedTuple):
    """Blocks under one motion.

    Attributes
    ----------
    sides
        Shape (blocks, 2, 3), (blocks, 2, 5) or (blocks, 2, 7): alpha g over the motion's scale for
        lean and p for rate, in the units of the motion.
    afterwards
        Pivot time p t for which each is followed on the still base, shape (blocks,).
    """

    sides: Floats3
    afterwards: Floats1


class PeakFates(NamedTuple):
    """Receives how blocks under one motion fare.

    Attributes
    ----------
    status, impacts
        The status code and the number of impacts, shape (blocks,).
    peaks
        In shape (blocks, 2), the largest |theta|/alpha, each side in its own alpha, and the largest
        |d(theta/alpha)/d(p t)|, with the positive side's alpha and p, until the end or overturning.
        In shape (blocks, 0) there are none, and the march is faster.
    """

    status: Integers1
    impacts: Integers1
    peaks: Floats2


class PulseFates(NamedTuple):
    """Receives how a block fares under pulses; arrays of shape (cells,).

    Attributes
    ----------
    status
        AT_REST for whatever does not overturn, OVERTURNED or UNDECIDED.
    impacts, side
        The impacts until overturning and its side; of what does not overturn, the impacts while the
        pulse lasts, and 0.
    during
        ``3 n + 1 + side`` of the n impacts and the side (or rest, 0) at the pulse's end.
    margin
        How far beyond (above 0) or short of overturning the block is; nan if undecided.
    """

    status: Integers1
    impacts: Integers1
    side: Integers1
    during: Integers1
    margin: Floats1
