"""Clock of a march: the segment, whole half cycles of its sinusoid, and the remaining phase.

Half cycles are counted in an integer and the phase stays in [0, pi), so that nothing drifts over
millions of cycles, and a change of side adds exactly pi.  On a segment without sinusoid the time
since its start takes the phase's place, and no half cycles are counted.
"""

import math

import numpy as np

from rocksteady.kernels.core.forcing import HALF_PI, SINE, Forcing
from rocksteady.kernels.core.tables import DURATION, FREQUENCY, PHASE, Floats
from rocksteady.kernels.core.typed import ZERO
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.machine_code.types import Floats2

PI_HIGH = math.pi
PI_LOW = 1.2246467991473532e-16  # pi - PI_HIGH


@inlined
def clock(phase: float) -> tuple[int, float]:
    """Split an unbounded phase into whole half cycles and a rest in [0, pi)."""
    return side_clock(phase, ZERO)


@inlined
def side_clock(phase: float, moved: int) -> tuple[int, float]:
    """Split a phase that `side_phase` had moved by so many half cycles.

    It added as many times the double next to pi, and as much is taken away again.
    """
    # np.floor stays a float; math.floor would go through an integer and back.
    half = float(np.floor(phase * (1.0 / math.pi)))
    rest = (phase - half * PI_HIGH) - (half - moved) * PI_LOW
    if rest < 0.0:
        rest = 0.0
    elif rest >= math.pi:
        half += 1.0
        rest = 0.0
    return int(half), rest


@inlined
def side_phase(half: int, phase: float, side: int, frequency: float) -> tuple[float, int]:
    """Return the phase seen from a side, in [-pi/2, 3 pi/2), and its half cycle less `half`."""
    if frequency == 0.0:
        return 0.0, 0
    if (half % 2 == 0) == (side > 0):
        return phase, 0
    if phase < HALF_PI:
        return phase + math.pi, 1
    return phase - math.pi, -1


@compiled
def segment_start(segments: Floats2, index: int) -> tuple[int, float]:
    """Return half cycles and phase (or time) at the start of a segment."""
    if segments[index, FREQUENCY] == 0.0:
        return 0, 0.0
    return clock(segments[index, PHASE])


@compiled
def segment_end(segments: Floats, index: int) -> tuple[int, float]:
    """Return half cycles and phase (or time) at the end of a segment of finite duration."""
    duration, frequency = segments[index, DURATION], segments[index, FREQUENCY]
    if frequency == 0.0:
        return 0, duration
    return clock(segments[index, PHASE] + frequency * duration)


@inlined
def elapsed_time(
    half_cycles: int, phase: float, from_half: int, from_phase: float, frequency: float
) -> float:
    """Return the pivot time between two clock readings on one segment."""
    if frequency == 0.0:
        return phase - from_phase
    return ((half_cycles - from_half) * math.pi + (phase - from_phase)) / frequency


@compiled
def later_clock(half: int, phase: float, frequency: float, time: float) -> tuple[int, float]:
    """Return the clock reading a pivot time later."""
    if frequency == 0.0:
        return half, phase + time
    turned, phase = clock(phase + frequency * time)
    return half + turned, phase


@compiled
def uplift_clock(
    half: int, phase: float, frequency: float, wait: float, side: int, forcing: Forcing
) -> tuple[int, float]:
    """Return the clock reading after a wait for uplift; exact where the node has a closed form."""
    if frequency == 0.0 or forcing.kind != SINE:
        return later_clock(half, phase, frequency, wait)
    seen_phase, seen_half = side_phase(half, phase, side, frequency)
    turned, phase = clock(forcing.rising)
    if forcing.rising < seen_phase:
        turned += 2
    return half + turned - seen_half, phase
