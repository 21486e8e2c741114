"""Times of a film's frames, and its playback speed."""

import math
from dataclasses import dataclass

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.history.base_motion import segment_starts
from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.errors import InputError
from rocksteady.kernels.core import tables as columns
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.validation import LARGEST, finite, in_range
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.pulses import Pulse

FRAMES_PER_SECOND = 25.0
FEWEST_A_PERIOD = 8
"""Frames in a period, below which a film no longer shows how the block moves."""
MOST_UNASKED = 400
"""Frames of a film at the default speed: the 50 periods of a usual run have 8 each."""
MOST_FRAMES = 1500
"""Frames of any film: a minute at 25 a second."""
FREE_SPEED = 5.0
"""Pivot time a second without forcing period or block; one free swing to and fro lasts about 6."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Reel:
    """Which moments a film shows, and how fast.

    Attributes
    ----------
    times
        Pivot times of the frames, at least one.
    speed
        In the unit of `speed_unit`, per second of the film.
    fps
        Frames a second.
    period
        Pivot time of the quickest motion.
    """

    times: Floats
    speed: float
    fps: float
    period: float


def speed_unit(trajectory: Trajectory) -> float:
    """Return the pivot time that passes in a second of the film at speed 1."""
    if isinstance(trajectory.block, Block):
        return trajectory.block.p
    if isinstance(trajectory.motion, PeriodicMotion):
        return 2.0 * math.pi / trajectory.motion.frequency_ratio
    return 1.0


def shortest_period(trajectory: Trajectory, start: float, end: float) -> float:
    """Return the pivot time of the quickest motion in a span: a period of the base, or 2 pi.

    A block that is let go rocks with periods of that order, until its bounces die out.
    """
    table = trajectory.segments
    starts = segment_starts(table)
    ends = np.append(starts[1:], math.inf)
    within = (starts < end) & (ends > start)
    frequency = table[:, columns.FREQUENCY]
    if table.shape[1] > columns.ORDERS:
        frequency = frequency * np.maximum(table[:, columns.ORDERS], 1.0)
    quickest = float(frequency[within].max(initial=1.0))
    motion = trajectory.motion
    if isinstance(motion, Pulse) and start < motion.duration:
        quickest = max(quickest, motion.frequency_ratio)  # which straight lines do not contain
    return 2.0 * math.pi / quickest


def reel_of(
    trajectory: Trajectory,
    span: tuple[float, float] | None,
    speed: float | None,
    fps: float,
    until: float,
) -> Reel:
    """Return the frames of a film, which lasts until a pivot time without a span.

    The other parameters and the errors are those of `animate`.
    """
    rate = in_range("fps", fps, 1.0, 60.0, "[]", hint="give frames a second; 25 is usual")
    start, end = (0.0, until) if span is None else _validated_span(trajectory, span)
    unit, length = speed_unit(trajectory), end - start
    period = shortest_period(trajectory, start, end)
    longest = period / FEWEST_A_PERIOD  # between two frames
    if speed is None:
        step = _usual_speed(trajectory, longest * rate) * unit / rate
        step = max(step, length / MOST_UNASKED)
        if step > longest * (1.0 + 1e-9):
            raise InputError(
                "span",
                (start, end),
                f"{MOST_UNASKED} frames would show each period with "
                f"{period / step:.3g} of them, and at least {FEWEST_A_PERIOD} are needed",
                f"show at most p t = {MOST_UNASKED * longest:.6g} of the run with "
                "span=(start, end), or choose a speed",
            )
    else:
        hint = "give 1 for the usual speed"
        step = in_range("speed", speed, 1.0 / LARGEST, LARGEST, "[]", hint=hint) * unit / rate
        slowest, fastest = length / (MOST_FRAMES * unit) * rate, longest / unit * rate
        if not slowest <= step / unit * rate <= fastest * (1.0 + 1e-9):
            raise InputError(
                "speed",
                speed,
                f"the film would have {length / step:.3g} frames, {period / step:.3g} in "
                f"each period; at most {MOST_FRAMES} and at least {FEWEST_A_PERIOD} are needed",
                (
                    f"give from {slowest:.3g} to {fastest:.3g}"
                    if slowest <= fastest
                    else "show a shorter part of the run"
                ),
            )
    # The last step is shortened to meet the end.
    count = math.ceil(length / step * (1.0 - 1e-12)) + 1 if length > 0.0 else 1
    times = np.minimum(start + step * np.arange(count), end)
    return Reel(times=times, speed=step * rate / unit, fps=rate, period=period)


def _validated_span(trajectory: Trajectory, span: tuple[float, float]) -> tuple[float, float]:
    """Return the pivot times between which the film runs."""
    hint = "give span=(start, end) in pivot time p t"
    valid = f"it must be two times, 0 <= start < end <= {trajectory.end_time_pt:.10g}"
    start, end = (finite("span", time, hint=hint) for time in span)
    if not 0.0 <= start < end <= trajectory.end_time_pt * (1.0 + 1e-15):
        raise InputError("span", span, valid, hint)
    return start, end


def _usual_speed(trajectory: Trajectory, fastest: float) -> float:
    """Return the default speed; `fastest` is in pivot time a second."""
    unit = speed_unit(trajectory)
    if not isinstance(trajectory.block, Block):
        # One period a second; slow shaking is not played faster than a block falls or rocks.
        forced = isinstance(trajectory.motion, PeriodicMotion)
        return min(1.0 if forced else FREE_SPEED, FREE_SPEED / unit, fastest / unit)
    # Real time, or slow motion by a round factor.
    speed, factors = 1.0, [0.5, 0.4, 0.5]
    while speed * unit > fastest:
        speed *= factors[0]
        factors = factors[1:] + factors[:1]
    return speed


def speed_text(trajectory: Trajectory, speed: float) -> str:
    """Return a speed as in the caption of a film."""
    if isinstance(trajectory.block, Block):
        return "real time" if abs(speed - 1.0) < 1e-9 else f"{speed:.3g} × real time"
    if isinstance(trajectory.motion, PeriodicMotion):
        return f"{speed:.3g} period{'' if abs(speed - 1.0) < 1e-9 else 's'} a second"
    return f"pt = {speed:.3g} a second"
