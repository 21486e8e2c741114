"""Tables of segments and sides for the march, and a march that is counted, then recorded."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.core.clock import clock, segment_start
from rocksteady.kernels.core.tables import (
    ALIKE,
    AMPLITUDE,
    CEILING,
    CONSTANT,
    DURATION,
    ENDED_BY_IMPACT,
    FREQUENCY,
    JUMP,
    PHASE,
    ROW_COLUMNS,
    ROW_DURATION,
    ROW_EVENT,
    ROW_HALF_CYCLES,
    ROW_PHASE,
    ROW_SEGMENT,
    ROW_SIDE,
    SEGMENT_COLUMNS,
    SLOPE,
    March,
)
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.march.march import march
from tests.oracles import ExactSegment, mp

Floats = NDArray[np.float64]
PLENTY = 2**62
NONE = np.zeros(0)
"""In place of the peaks that a march keeps."""


@dataclass(frozen=True)
class Piece:
    """One segment: c0 + c1 s + A sin(Omega s + phi) for a duration, after a jump of velocity."""

    duration: float = math.inf
    constant: float = 0.0
    slope: float = 0.0
    amplitude: float = 0.0
    frequency: float = 0.0
    phase: float = 0.0
    jump: float = 0.0

    def base(self, time: float) -> float:
        swing = self.amplitude * math.sin(self.phase + self.frequency * time)
        return self.constant + self.slope * time + swing


def table(*pieces: Piece) -> Floats:
    """Return the segments with their ceilings, max |a| from each one's start on."""
    rows = np.zeros((len(pieces), SEGMENT_COLUMNS))
    ceiling = 0.0
    for i in reversed(range(len(pieces))):
        piece = pieces[i]
        rows[i, DURATION] = piece.duration
        rows[i, JUMP] = piece.jump
        rows[i, CONSTANT] = piece.constant
        rows[i, SLOPE] = piece.slope
        rows[i, AMPLITUDE] = piece.amplitude
        rows[i, FREQUENCY] = piece.frequency
        rows[i, PHASE] = piece.phase
        line = abs(piece.constant)
        if piece.slope != 0.0:
            line = max(line, abs(piece.constant + piece.slope * piece.duration))
        ceiling = max(ceiling, line + piece.amplitude)
        rows[i, CEILING] = ceiling
        if piece.jump != 0.0:
            ceiling = math.inf
    return rows


def sampled_pieces(values: Floats, step: float, last_step: float | None = None) -> list[Piece]:
    """Return straight lines between samples, the last perhaps of another length, and still base."""
    steps = np.full(len(values) - 1, step)
    steps[-1] = last_step or step
    lines = [
        Piece(float(h), constant=float(a), slope=float((b - a) / h))
        for a, b, h in zip(values[:-1], values[1:], steps, strict=True)
    ]
    return [*lines, Piece()]


def sampled(values: Floats, step: float, last_step: float | None = None) -> Floats:
    """Return the table of samples, of which the march knows that they are alike."""
    rows = table(*sampled_pieces(values, step, last_step))
    alike = len(values) - (2 if last_step is None else 3)
    rows[: alike + 1, ALIKE] = np.arange(alike, -1, -1)
    return rows


def one_by_one(segments: Floats) -> Floats:
    """Return the table without the notes that samples are alike: each is searched for zeros."""
    plain = segments.copy()
    plain[:, ALIKE] = 0.0
    return plain


def harmonic(amplitude: float, frequency: float, phase: float = 0.0) -> Floats:
    return table(Piece(amplitude=amplitude, frequency=frequency, phase=phase))


def exact_segments(*pieces: Piece) -> list[ExactSegment]:
    start, segments = mp.mpf(0), []
    for piece in pieces:
        segments.append(
            ExactSegment(
                start,
                *(
                    mp.mpf(value)
                    for value in (
                        piece.constant,
                        piece.slope,
                        piece.amplitude,
                        piece.frequency,
                        piece.phase,
                        piece.jump,
                    )
                ),
            )
        )
        start += mp.mpf(piece.duration)
    return segments


def both_sides(
    restitution: float | tuple[float, float],
    lean: tuple[float, float] = (1.0, 1.0),
    rate: tuple[float, float] = (1.0, 1.0),
) -> Floats:
    pair = restitution if isinstance(restitution, tuple) else (restitution, restitution)
    return np.array([pair, lean, rate]).T.copy()


@dataclass(frozen=True)
class Run:
    """A recorded march."""

    segments: Floats
    status: int
    end: March
    rows: Floats

    def phases(self) -> list[Any]:
        """Phases at the starts of the flights, whole half cycles included, in 50 digits."""
        return [
            int(row[ROW_HALF_CYCLES]) * mp.pi + mp.mpf(float(row[ROW_PHASE])) for row in self.rows
        ]

    def times(self) -> list[Any]:
        """Pivot times of the starts of the flights since that of the motion, in 50 digits."""
        starts = [mp.mpf(0)]
        for duration in self.segments[:-1, DURATION]:
            starts.append(starts[-1] + mp.mpf(float(duration)))
        times = []
        for row, phase in zip(self.rows, self.phases(), strict=True):
            index = int(row[ROW_SEGMENT])
            frequency = float(self.segments[index, FREQUENCY])
            if frequency == 0.0:
                times.append(starts[index] + mp.mpf(float(row[ROW_PHASE])))
            else:
                turned = phase - mp.mpf(float(self.segments[index, PHASE]))
                times.append(starts[index] + turned / mp.mpf(frequency))
        return times

    def impacts(self) -> list[tuple[Any, int, float]]:
        """Time, side before and velocity after each impact that begins another row."""
        times = self.times()
        found = []
        for i in range(1, len(self.rows)):
            before = self.rows[i - 1]
            if before[ROW_EVENT] == ENDED_BY_IMPACT:
                after = float(self.rows[i, 5]) if self.rows[i, ROW_SIDE] != 0.0 else 0.0
                found.append((times[i], int(before[ROW_SIDE]), after))
        return found

    def durations(self) -> Floats:
        return self.rows[:, ROW_DURATION]


def run(
    segments: Floats,
    sides: Floats,
    *,
    side: int = 0,
    angle: float = 0.0,
    velocity: float = 0.0,
    until: float = math.inf,
    half_cycles: int | None = None,
    rest_velocity: float = math.inf,
    limit: int = PLENTY,
) -> Run:
    """March from the start of the motion, `until` a time or whole `half_cycles` on one segment."""
    start_half, start_phase = segment_start(segments, 0)
    start = March(side, angle, velocity, 0, start_half, start_phase, 0, 0)
    last = segments[-1]
    stop_half, stop_phase = 0, until
    if half_cycles is not None:
        stop_half, stop_phase = start_half + half_cycles, start_phase
    elif math.isinf(until):
        stop_half = 2**60 if last[FREQUENCY] > 0.0 else 0
        stop_phase = 0.0 if last[FREQUENCY] > 0.0 else math.inf
    elif last[FREQUENCY] > 0.0:
        since = until - float(segments[:-1, DURATION].sum())
        stop_half, stop_phase = clock(last[PHASE] + last[FREQUENCY] * since)
    else:
        stop_phase = until - float(segments[:-1, DURATION].sum())
    none = np.zeros((0, ROW_COLUMNS))
    status, end = march(
        Tables(segments, sides),
        start,
        Until(stop_half, stop_phase, rest_velocity, limit),
        Kept(none, NONE),
    )
    rows = np.zeros((end.flights, ROW_COLUMNS))
    again, same = march(
        Tables(segments, sides),
        start,
        Until(stop_half, stop_phase, rest_velocity, limit),
        Kept(rows, NONE),
    )
    assert (again, same) == (status, end), "recording changes nothing"
    return Run(segments, status, end, rows)


def march_to(segments: Floats, sides: Floats, impacts: int, velocity: float) -> March:
    """March off the ground until so many impacts are done, and stop there."""
    half, phase = segment_start(segments, 0)
    side = 1 if velocity > 0.0 else -1
    start = March(side, 0.0, velocity, 0, half, phase, 0, 0)
    none = np.zeros((0, ROW_COLUMNS))
    _, end = march(
        Tables(segments, sides), start, Until(2**60, 0.0, 0.0, impacts), Kept(none, NONE)
    )
    return end


def signs_hold(rows: Floats) -> bool:
    """Return whether every flight starts on its own side of the floor and, from it, upwards."""
    side, angle, velocity = rows[:, ROW_SIDE], rows[:, 4], rows[:, 5]
    grounded = angle == 0.0
    return bool(np.all(side * angle >= 0.0) and np.all(side[grounded] * velocity[grounded] >= 0.0))


def numbers(values: Sequence[Any]) -> Floats:
    return np.array([float(value) for value in values])
