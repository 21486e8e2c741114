"""Symmetric steady states of the full equations, over arrays of points.

Between two impacts a block stays on one side, where its equation is smooth.  For each phase f of
the shaking at the first of them there is one flight that is back on the base n half periods later:
a boundary-value problem, which does not ask whether the flight passes the floor on its way.  It is
half of a steady state where its speeds v at both ends fit an impact::

    g(f) = v(0) + restitution v(T) = 0

In the linear model g is a constant less a sinusoid (eq 20).  In the full equations it still has one
valley and one crest, so that there are two states or none: branch 1 where g rises, branch 2 where
it falls, as in the closed form, to which they lead as the slenderness falls to 0.  They meet at a
fold, where the valley rises above 0.
"""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.kernels.core.forcing import grazes
from rocksteady.kernels.elementary.arrays import acos, atan, cos, exp, sin

ORDER = 24
"""Order of the Taylor series of a piece."""
LONGEST, WIDEST = 0.5, 1.0
"""Longest piece of a half cycle: pivot time, and phase of the shaking [rad]."""
STEPS = 30
"""Most Newton steps to a flight, or to an extremum."""
LARGEST_TILT = 0.3
"""Largest change of the tilt [rad] that a step to a flight may bring."""
SOLVED = 1e-12
"""Step to a flight, in parts of its largest speed, whose square is below rounding."""
TRIALS = 60
"""Most trials of a phase in its bracket."""
CLOSED = 1e-9
"""Step of a phase [rad] whose square is below rounding."""
SAMPLES = 32
"""Samples of a piece, between which extrema are located."""
ROOM = 2048
"""Pieces that are computed together, of a size for a processor's cache."""

Indices = NDArray[np.intp]


class Points(NamedTuple):
    """Shaken blocks whose half cycles have one number of pieces; arrays of shape (flights, 1)."""

    amplitude: Floats
    frequency_ratio: Floats
    restitution: Floats
    alpha: Floats
    order: Floats
    length: Floats  # pivot time of a piece


class Flights(NamedTuple):
    """Flights from the base back to it, shape (flights,) unless stated; nan where none is found."""

    series: Floats  # of u by the part of a piece that has passed: (ORDER + 1, flights, pieces)
    speeds: Floats  # du/d(pt) where pieces begin, and at the end: (flights, pieces + 1)
    early: Floats  # derivatives by the phase, in the same time, of the speed at the start ...
    late: Floats  # ... and at the end
    growth: Floats  # derivative of the speed at the end by that at the start
    reach: Floats  # of the angle at the end by the speed at the start, over the growth


def find_half_cycles(*given: Floats) -> Floats:
    """Find both symmetric steady states of the full equations at each point.

    Parameters
    ----------
    given
        Amplitude, frequency ratio, restitution, alpha [rad] and order, each of shape (points,).

    Returns
    -------
    array
        Phase, velocity, trace, peak, extrema, whether it is admissible, and the derivative of the
        half cycle in (phase, velocity), row by row, in parts of its growth: shape (10, 2, points),
        branch 1 first; nan where there are none.
    """
    amplitude, ratio, *_, order = given
    counts, span = pieces_of(order, ratio), order * math.pi / ratio
    fields = np.full((10, 2, len(ratio)), math.nan)
    fields[4:6] = 0.0
    for count in np.unique(counts[amplitude > 0.0]).tolist():
        mine = np.flatnonzero((counts == count) & (amplitude > 0.0))
        for some in np.array_split(mine, math.ceil(2 * count * len(mine) / ROOM)):
            points = Points(*(np.tile(x[some], 2)[:, None] for x in (*given, span / count)))
            with np.errstate(all="ignore"):
                fields[:, :, some] = _states(points, count).reshape(10, 2, -1)
    return fields


def pieces_of(order: Floats, frequency_ratio: Floats) -> NDArray[np.int64]:
    """Return the number of pieces of each half cycle, a power of 2."""
    span = order * math.pi
    _, power = np.frexp(np.maximum(span / frequency_ratio / LONGEST, span / WIDEST))
    count: NDArray[np.int64] = np.left_shift(1, power.astype(np.int64))
    return count


def compute_course(given: Sequence[float], phase: float, time: Floats) -> Floats:
    """Return angle and velocity, shape (2, times), at pivot times of a half cycle from a phase on.

    Parameters
    ----------
    given
        That of `find_half_cycles`, of one point.
    phase, time
        Phase of the shaking where it begins [rad], and the times.
    """
    _, ratio, *_, order = given
    (count,) = pieces_of(np.array([order]), np.array([ratio])).tolist()
    length = order * math.pi / ratio / count
    points = Points(*(np.array([[x]]) for x in (*given, length)))
    begins = np.zeros((1, count)), np.zeros((1, count + 1))
    piece = np.minimum((time / length).astype(np.int64), count - 1)
    series = find_flights(points, np.array([phase]), *begins).series[:, 0, piece]
    part = time / length - piece
    return np.array([_at(series, part), _at(_derived(series), part) / length])


def _states(points: Points, count: int) -> Floats:
    """Return what `find_half_cycles` does, for branch 1 of all points and then for branch 2."""
    w, r = points.frequency_ratio[:, 0], points.restitution[:, 0]
    begins = np.zeros((len(w), count)), np.zeros((len(w), count + 1))  # of the next search

    def fly(phase: Floats, which: Indices) -> Flights:
        flights = find_flights(_chosen(points, which), phase, *(x[which] for x in begins))
        known = np.isfinite(flights.early)
        for begin, end in zip(begins, (flights.series[0], flights.speeds), strict=True):
            begin[which[known]] = end[known]
        return flights

    def gap(phase: Floats, which: Indices) -> tuple[Floats, Floats]:
        flights, part = fly(phase, which), r[which]
        gaps = flights.speeds[:, 0] + part * flights.speeds[:, -1]
        return gaps, flights.early + part * flights.late

    # Valley and crest, first those of the linear model.
    half, every = len(w) // 2, np.arange(len(w))
    decay = exp(-points.order[:, 0] * math.pi / w)
    steepness = (1.0 - r) / (1.0 + r) * (1.0 - decay) / (1.0 + decay) * w  # P of eq 20
    ends = 0.5 * math.pi - atan(steepness) + math.pi * (every >= half)
    gaps, _ = gap(ends, every)
    size = 0.5 * (gaps[half:] - gaps[:half])
    bare = np.flatnonzero(gaps[:half] >= 0.0)  # near a fold, or without a state
    _find(lambda *at: (gap(*at)[1], size[at[1]]), ends, ends - 1.0, ends + 1.0, bare)
    gaps[bare], _ = gap(ends[bare], bare)
    (valley, crest), (least, most) = ends.reshape(2, half), gaps.reshape(2, half)
    which = np.flatnonzero(np.tile((least < 0.0) & (most > 0.0), 2))
    apart = acos(np.clip((most + least) / (most - least), -1.0, 1.0))
    phase = np.concatenate([valley + apart, valley - apart])
    _find(gap, phase, np.tile(valley, 2), np.concatenate([crest, crest - 2.0 * math.pi]), which)
    result = np.full((10, len(w)), math.nan)
    result[4:6] = 0.0
    if len(which):
        result[:, which] = _fields(_chosen(points, which), phase[which], fly(phase[which], which))
    return result


def _fields(points: Points, phase: Floats, flights: Flights) -> Floats:
    """Return what `find_half_cycles` does for flights from phases on."""
    a, w, r, alpha, order, _ = (x[:, 0] for x in points)
    velocity, end = flights.speeds[:, 0], flights.speeds[:, -1]
    braking = a * sin(phase + order * math.pi) * cos(alpha) - sin(alpha) / alpha
    early, late, growth, reach = flights.early, flights.late, flights.growth, flights.reach / end
    jacobian = (
        1.0 / growth + w * reach * early,
        -w * reach,
        -r * (late / growth - early + braking * reach * early),
        -r * (1.0 - braking * reach),
    )
    trace = 1.0 + r * r + w * reach * growth * (early + r * late)
    trace[
        [grazes(*each) for each in zip(np.abs(end).tolist(), a.tolist(), w.tolist(), strict=True)]
    ] = math.nan
    phase = phase - 2.0 * math.pi * (phase > math.pi) + 2.0 * math.pi * (phase <= -math.pi)
    shape = _shape(flights, 0.5 * math.pi / alpha)
    fields = np.array([phase, velocity, trace, *shape, *jacobian])
    open_ = ~(np.abs(velocity + r * end) <= 1e-9 * np.abs(flights.speeds).max(axis=-1))
    fields[:, open_] = math.nan
    return fields


def _shape(flights: Flights, lying: Floats) -> tuple[Floats, Floats, Floats]:
    """Return peak, number of extrema, and whether flights stay above the floor, and stand up."""
    series, rates = flights.series, _derived(flights.series)
    parts = np.arange(SAMPLES) / SAMPLES
    angles, speeds = (
        _at(each[..., None], parts).reshape(len(lying), -1) for each in (series, rates)
    )
    after = np.concatenate([speeds[:, 1:], flights.speeds[:, -1:]], axis=-1)
    row, sample = np.nonzero((speeds > 0.0) != (after > 0.0))
    mine, rate, bend = (x[:, row, sample // SAMPLES] for x in (series, rates, _derived(rates)))
    low, high = sample % SAMPLES / SAMPLES, (sample % SAMPLES + 1) / SAMPLES
    part = 0.5 * (low + high)
    for _ in range(STEPS):
        part = np.clip(part - _at(rate, part) / _at(bend, part), low, high)
    extreme = _at(mine, part)
    highest, lowest, count = np.full((3, len(lying)), np.array([[-math.inf], [math.inf], [0.0]]))
    np.maximum.at(highest, row, extreme)
    np.minimum.at(lowest, row, extreme)
    np.add.at(count, row, 1.0)
    above = (angles[:, 1:] > 0.0).all(axis=-1) & (lowest > 0.0) & (flights.speeds[:, 0] > 0.0)
    return highest, count, (above & (highest < lying)).astype(np.float64)


def _find(
    function: Callable[[Floats, Indices], tuple[Floats, Floats]],
    phase: Floats,
    low: Floats,
    high: Floats,
    which: Indices,
) -> None:
    """Improve phases where a function, given with its derivative, is 0, by Newton's method.

    Each stays between one at which the function is negative, `low`, and one at which it is not.
    """
    low, high = low.copy(), high.copy()
    for _ in range(TRIALS):
        here = phase[which]
        value, rate = function(here, which)
        low[which], high[which] = (
            np.where(value < 0.0, here, low[which]),
            np.where(value < 0.0, high[which], here),
        )
        below, above, target = low[which], high[which], here - value / rate
        inside = (target - below) * (target - above) <= 0.0
        phase[which] = np.where(inside, target, 0.5 * (below + above))
        which = which[np.abs(phase[which] - here) > CLOSED]
        if not len(which):
            break


def find_flights(points: Points, phase: Floats, angles: Floats, speeds: Floats) -> Flights:
    """Find the flights that begin on the base at phases, shape (flights,), and end on it.

    Newton's method finds the states at which their pieces begin.

    Parameters
    ----------
    points, phase
        What is shaken, and the phases.
    angles, speeds
        Where the search begins: u, shape (flights, pieces), and du/d(pt), (flights, pieces + 1).
    """
    count = angles.shape[-1]
    angles, speeds = angles.copy(), speeds.copy()
    series = np.full((ORDER + 1, *angles.shape), math.nan)
    known = np.full((4, len(phase)), math.nan)
    which = np.arange(len(phase))
    for _ in range(STEPS):
        here = _chosen(points, which)
        clock = phase[which, None] + here.frequency_ratio * here.length * np.arange(count)
        parts, varied = _expand(here, clock, angles[which], speeds[which, :-1])
        angle, rate = _at(varied, 1.0), _at(_derived(varied), 1.0) / here.length
        nothing = np.zeros(len(which))
        off = _at(parts, 1.0) - np.column_stack([angles[which, 1:], nothing])
        bent = _at(_derived(parts), 1.0) / here.length - speeds[which, 1:]
        # The angle where a piece begins is slope times speed plus shift; the second row of shifts
        # and steps is the derivative by the phase.
        slope, shift, growth = nothing, np.zeros((2, len(which))), nothing + 1.0
        rows = []
        for k in range(count):
            (a, b, c), (d, e, f) = angle[..., k], rate[..., k]
            stretch, turn = d * slope + e, d * shift + np.array([bent[:, k], f])
            rows.append((slope, shift, stretch, turn))
            slope = (a * slope + b) / stretch
            shift = a * shift + np.array([off[:, k], c]) - slope * turn
            growth = growth * stretch
        step = last = -shift / slope
        moves, pushes = np.zeros(parts.shape[1:]), np.zeros((len(which), count + 1))
        pushes[:, -1] = step[0]
        for k in reversed(range(count)):
            before, shift, stretch, turn = rows[k]
            step = (step - turn) / stretch
            pushes[:, k], moves[:, k] = step[0], (before * step + shift)[0]
        tilt = (here.alpha * np.abs(moves)).max(axis=-1, keepdims=True)
        part = np.where(tilt > LARGEST_TILT, LARGEST_TILT / tilt, 1.0)
        angles[which] += part * moves
        speeds[which] += part * pushes
        done = np.abs(pushes).max(axis=-1) <= SOLVED * np.abs(speeds[which]).max(axis=-1)
        series[:, which[done]] = parts[:, done]
        known[:, which[done]] = np.array([step[1], last[1], growth, slope])[:, done]
        which = which[~done]
        if not len(which):
            break
    return Flights(series, speeds, *known)


def _chosen(points: Points, which: Indices) -> Points:
    """Return some points."""
    return Points(*(x[which] for x in points))


def _expand(points: Points, clock: Floats, angles: Floats, speeds: Floats) -> tuple[Floats, Floats]:
    """Return the Taylor series of pieces, and of their derivatives by angle, speed and phase.

    In parts of the piece, shape (ORDER + 1, flights, pieces) and (ORDER + 1, 3, ...).
    """
    a, w, _, alpha, _, h = points
    x, sine, cosine = np.zeros((3, ORDER + 1, *clock.shape))  # of u, and of the tilt alpha (1 - u)
    wave, along = np.zeros((2, ORDER + 1, *clock.shape))  # the base, and its derivative by phase
    varied = np.zeros((ORDER + 1, 3, *clock.shape))
    x[0], x[1] = angles, h * speeds
    varied[0, 0], varied[1, 1] = 1.0, h
    sine[0], cosine[0] = sin(alpha * (1.0 - angles)), cos(alpha * (1.0 - angles))
    wave[0], along[0] = a * sin(clock), a * cos(clock)
    pull, drive = np.zeros((2, ORDER + 1, *clock.shape))
    for k in range(ORDER - 1):
        if k:
            turned = -alpha * np.arange(1, k + 1).reshape(-1, 1, 1) * x[1 : k + 1] / k
            sine[k] = _product(turned, cosine[:k])
            cosine[k] = -_product(turned, sine[:k])
            wave[k], along[k] = w * h / k * along[k - 1], -w * h / k * wave[k - 1]
        square = h * h / ((k + 1) * (k + 2))
        x[k + 2] = square * (_product(wave[: k + 1], cosine[: k + 1]) - sine[k] / alpha)
        pull[k] = cosine[k] + alpha * _product(wave[: k + 1], sine[: k + 1])
        drive = _product(along[: k + 1], cosine[: k + 1])
        varied[k + 2] = _product(pull[: k + 1, None], varied[: k + 1])
        varied[k + 2, 2] += drive
        varied[k + 2] *= square
    return x, varied


def _product(first: Floats, second: Floats) -> Floats:
    """Return the last coefficient of the product of two series of one length."""
    result: Floats = (first * second[::-1]).sum(axis=0)
    return result


def _derived(series: Floats) -> Floats:
    """Return the derivative of series."""
    derived: Floats = series[1:] * np.arange(1, len(series)).reshape(-1, *[1] * (series.ndim - 1))
    return derived


def _at(series: Floats, part: Floats | float) -> Floats:
    """Return the values of series where a part of their piece has passed."""
    value: Floats = series[-1] * np.ones_like(part)
    for each in series[-2::-1]:
        value = value * part + each
    return value
