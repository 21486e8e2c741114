"""Combined base motions: scaled or reversed, delayed, cut off, one after another, and summed."""

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import accumulate, pairwise
from typing import TYPE_CHECKING, Annotated, overload

from rocksteady.errors import ModelError
from rocksteady.kernels.elementary.arrays import atan2, hypot, sincos
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.checks.validation import LARGEST, in_range, positive
from rocksteady.model.motions._sampled import polyline
from rocksteady.model.motions.harmonics import HIGHEST_ORDER
from rocksteady.model.motions.segments import (
    LONGEST_DURATION,
    Motion,
    Piecewise,
    Segment,
    segments_of,
)

if TYPE_CHECKING:
    from rocksteady.model.motions.record import Record

SUM_TOLERANCE = 1e-6
"""Default largest error [alpha g] of a sum that has to be sampled."""

SAME_FREQUENCY = 1e-12
"""Frequencies whose relative distance is below this differ by rounding."""

_TIME = Bounds(0.0, LONGEST_DURATION, "[]", "give a pivot time p t")

_SAME_TIME = 1e-12
"""Times whose relative distance is below this differ by rounding."""


@overload
def scale(motion: "Record", factor: float) -> "Record": ...
@overload
def scale(motion: Motion, factor: float) -> Piecewise: ...
@checked
def scale(motion: "Motion | Record", factor: float) -> "Piecewise | Record":
    """Multiply a base motion by a factor; -1 reverses it.

    Parameters
    ----------
    motion
        Any base motion.
    factor
        Accelerations and impulses are multiplied by it; not 0 for a `Record`.

    Returns
    -------
    Piecewise or Record
        A `Record` of a `Record`, in m/s^2 and seconds as before.

    Raises
    ------
    InputError
        If the factor, or an acceleration times the factor, is not finite or beyond 1e50.

    Examples
    --------
    >>> from rocksteady import Pulse
    >>> from rocksteady.motions import scale
    >>> pulse = Pulse(shape="rectangle", amplitude=1.5, frequency_ratio=2.0)
    >>> [piece.constant for piece in scale(pulse, -1.0).segments()]
    [-1.5]
    """
    if not hasattr(motion, "segments"):
        from rocksteady.model.motions.record import Record

        if isinstance(motion, Record):
            return motion.scaled(factor)
    by = in_range("factor", factor, -LARGEST, LARGEST, "[]", hint="give a number; -1 turns round")
    return Piecewise(
        pieces=tuple(
            replace(
                piece,
                constant=by * piece.constant,
                slope=by * piece.slope,
                amplitude=by * piece.amplitude,
                jump=by * piece.jump,
            )
            for piece in _segments(motion)
        )
    )


@checked
def delay(motion: Motion, by: Annotated[float, _TIME]) -> Piecewise:
    """Return a base motion that begins later, after a still base.

    Parameters
    ----------
    motion
        Any base motion.
    by
        Pivot time p t, from 0 to 1e6.

    Raises
    ------
    InputError
        If the time is outside its range.

    Examples
    --------
    >>> from rocksteady import Pulse
    >>> from rocksteady.motions import delay
    >>> pulse = Pulse(shape="rectangle", amplitude=1.5, frequency_ratio=2.0)
    >>> [piece.duration for piece in delay(pulse, 0.5).segments()]
    [0.5, 1.5707963267948966]
    """
    still = (Segment(duration=by),) if by > 0.0 else ()
    return Piecewise(pieces=still + _segments(motion))


@checked
def cut(motion: Motion, at: Annotated[float, _TIME]) -> Piecewise:
    """Return a base motion up to a time, followed by a still base.

    Parameters
    ----------
    motion
        Any base motion, an endless one too.
    at
        Pivot time p t at which it is cut off, from 0 to 1e6; n cycles of harmonic shaking last
        2 pi n/Omega.

    Raises
    ------
    InputError
        If the time is outside its range.

    Examples
    --------
    Five cycles of harmonic shaking:

    >>> import math
    >>> from rocksteady import Harmonic
    >>> from rocksteady.motions import cut
    >>> five = cut(Harmonic(amplitude=2.0, frequency_ratio=4.0), 5 * 2.0 * math.pi / 4.0)
    >>> [round(piece.duration, 6) for piece in five.segments()]
    [7.853982]
    """
    kept: list[Segment] = []
    begun = 0.0
    for piece in _segments(motion):
        if begun >= at:
            break
        left = at - begun
        # A rest that rounding leaves is no segment.
        whole = piece.duration <= left * (1.0 + _SAME_TIME)
        kept.append(piece if whole else replace(piece, duration=left))
        begun += piece.duration
    return Piecewise(pieces=tuple(kept))


@checked
def join(*motions: Motion) -> Piecewise:
    """Return base motions in sequence, each beginning where the previous one ends.

    Parameters
    ----------
    *motions
        Base motions in order; only the last may be endless.

    Raises
    ------
    ModelError
        If a motion follows an endless one.

    Examples
    --------
    >>> from rocksteady import Pulse
    >>> from rocksteady.motions import join, scale
    >>> lobe = Pulse(shape="rectangle", amplitude=1.5, frequency_ratio=2.0)
    >>> [piece.constant for piece in join(lobe, scale(lobe, -1.0)).segments()]
    [1.5, -1.5]
    """
    return Piecewise(pieces=tuple(piece for motion in motions for piece in _segments(motion)))


@checked
def add(*motions: Motion, tolerance: float = SUM_TOLERANCE) -> Piecewise:
    """Return the sum of base motions that begin together.

    Constants, slopes and sinusoids of one frequency add up in closed form, and so do sinusoids
    alone whose frequencies are up to 64 times one of them or a whole part of it: a Fourier series.
    While others of several frequencies act, the sum is replaced by straight lines that are nowhere
    further from it than the tolerance: over a line of length h a sum of ``A_i sin(Omega_i s +
    phi_i)`` is missed by at most ``h^2/8`` times the sum of ``A_i Omega_i^2``.

    Parameters
    ----------
    *motions
        Any base motions; one that ends stands still from then on.
    tolerance
        In units of alpha g.

    Raises
    ------
    InputError
        If the tolerance is not above 0, or needs more than 200 000 lines.
    ModelError
        If sinusoids of several frequencies that are no Fourier series act together for ever.

    Examples
    --------
    >>> from rocksteady import Pulse
    >>> from rocksteady.motions import add, delay
    >>> pulse = Pulse(shape="rectangle", amplitude=1.5, frequency_ratio=2.0)
    >>> [piece.constant for piece in add(pulse, delay(pulse, 0.5)).segments()]
    [1.5, 3.0, 1.5]
    """
    error = positive("tolerance", tolerance, hint="give a small part of alpha g, as 1e-6")
    return added(motions, error, series=True)


def added(motions: Sequence[Motion], tolerance: float, *, series: bool) -> Piecewise:
    """Return the sum of motions; whether sinusoids may make a Fourier series is `series`."""
    parts = [_Part(_segments(motion)) for motion in motions]
    times = _distinct([time for part in parts if part.pieces for time in part.times])
    pieces: list[Segment] = []
    for low, high in pairwise(times):
        middle = low + 1.0 if high == math.inf else 0.5 * (low + high)
        jump = math.fsum(part.move_to(middle) for part in parts)
        acting = [(low - part.begun, part.acting) for part in parts if part.acting is not None]
        pieces += _sum(acting, high - low, jump, tolerance, series=series)
    return Piecewise(pieces=tuple(pieces))


def _segments(motion: Motion) -> tuple[Segment, ...]:
    if not hasattr(motion, "segments"):
        raise ModelError(
            "motion",
            motion,
            "it must have segments in the block's own measures, which a record has not",
            "put the samples together before making a Record of them",
        )
    return segments_of(motion)


class _Part:
    """One motion of a sum, and where in it we are: each of its segments is passed once.

    Attributes
    ----------
    pieces, times
        The segments, and the times at which they begin, with the end of the last.
    begun, acting
        When the segment of now began, and that segment; None past the last.
    """

    def __init__(self, pieces: Sequence[Segment]) -> None:
        self.pieces = pieces
        self.times = [0.0, *accumulate(piece.duration for piece in pieces)]
        self.next, self.begun = 0, 0.0
        self.acting: Segment | None = None

    def move_to(self, time: float) -> float:
        """Go on to a time, and return the jumps of the segments that begin on the way."""
        jump = 0.0
        while self.next < len(self.pieces) and self.times[self.next] < time:
            self.acting, self.begun = self.pieces[self.next], self.times[self.next]
            jump += self.acting.jump
            self.next += 1
        if self.times[self.next] < time:
            self.acting = None
        return jump


def _series(phasors: dict[float, tuple[float, float]]) -> Segment | None:
    """Return sinusoids whose frequencies are multiples of one as a Fourier series, or None."""
    slowest = min(phasors)
    for parts in range(1, HIGHEST_ORDER + 1):
        base = slowest / parts
        orders = {w: round(w / base) for w in phasors}
        if max(orders.values()) > HIGHEST_ORDER:
            return None
        if all(math.isclose(w, k * base, rel_tol=SAME_FREQUENCY) for w, k in orders.items()):
            shares: dict[int, tuple[float, float]] = {}
            for w, (sine, cosine) in phasors.items():
                before = shares.get(orders[w], (0.0, 0.0))
                shares[orders[w]] = (before[0] + sine, before[1] + cosine)
            waves = tuple((k, hypot(p, q), atan2(q, p)) for k, (p, q) in shares.items())
            if not any(size for _, size, _ in waves):
                return None
            return Segment(duration=1.0, amplitude=1.0, frequency=base, harmonics=waves)
    return None


def _distinct(times: list[float]) -> list[float]:
    """Return times in order, without a time that differs from the previous one by rounding."""
    distinct: list[float] = []
    for time in sorted(times):
        if not distinct or not math.isclose(distinct[-1], time, rel_tol=_SAME_TIME):
            distinct.append(time)
    return distinct


def _sum(
    acting: list[tuple[float, Segment]],
    duration: float,
    jump: float,
    tolerance: float,
    *,
    series: bool,
) -> tuple[Segment, ...]:
    """Return the sum of segments, each some time after its start, over a duration."""
    constant = math.fsum(piece.constant + piece.slope * since for since, piece in acting)
    slope = math.fsum(piece.slope for _, piece in acting)
    phasors: dict[float, tuple[float, float]] = {}  # its sine's share, and its cosine's
    for since, piece in acting:
        for order, size, phase in piece.harmonics or ((1, 1.0, 0.0),):
            if piece.amplitude * size != 0.0:
                turned = math.remainder(piece.phase + piece.frequency * since, 2.0 * math.pi)
                sine, cosine = sincos(math.remainder(order * turned + phase, 2.0 * math.pi))
                sine_share, cosine_share = phasors.get(order * piece.frequency, (0.0, 0.0))
                phasors[order * piece.frequency] = (
                    sine_share + piece.amplitude * size * cosine,
                    cosine_share + piece.amplitude * size * sine,
                )
    if series and len(phasors) > 1 and constant == slope == 0.0:
        combined = _series(phasors)
        if combined is not None:
            return (replace(combined, duration=duration, jump=jump),)
    if len(phasors) > 1:
        if duration == math.inf:
            raise ModelError(
                "motions",
                sorted(phasors),
                "for ever, sinusoids may act together alone, at whole multiples of one frequency",
                "end all but one of them, as Piecewise(pieces=(rs.motions.Segment(duration=...),))",
            )
        import numpy as np

        def together(s: "np.typing.NDArray[np.float64]") -> "np.typing.NDArray[np.float64]":
            total = constant + slope * s
            for w, (sine_share, cosine_share) in phasors.items():
                sine, cosine = sincos(w * s)
                total = total + (sine_share * sine + cosine_share * cosine)
            return np.asarray(total)

        curvature = math.fsum(hypot(*shares) * w * w for w, shares in phasors.items())
        first, *others = polyline(together, [(duration, curvature)], tolerance=tolerance)
        return replace(first, jump=jump), *others
    frequency, (sine_share, cosine_share) = (
        next(iter(phasors.items())) if phasors else (0.0, (0.0, 0.0))
    )
    return (
        Segment(
            duration=duration,
            constant=constant,
            slope=slope,
            amplitude=hypot(sine_share, cosine_share),
            frequency=frequency,
            phase=atan2(cosine_share, sine_share),
            jump=jump,
        ),
    )
