"""The march that one would write first: sample the closed form, bisect where the sign changes.

It is what the package's march is measured against, and it shares no code with it. Between impacts
both use the exact solution; this one looks for the impact among a fixed number of samples per
forcing period, so that a bounce or a dip shorter than a sample is lost, ends chatter at a velocity
that is small, and calls a block overturned once its angle exceeds a threshold.
"""

import math

import numba
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

SAMPLES = 100  # per forcing period
TOPPLED = 10.0  # |theta| / alpha from which a block counts as overturned
SLOW = 1e-6  # velocity below which a bounce counts as rest
BISECTIONS = 60
# The status codes of the package, so that the fates can be compared.
ROCKING, AT_REST, OVERTURNED = 0, 1, 2


@numba.njit(error_model="numpy")
def sampled_fates(
    amplitude: Floats,
    frequency_ratio: Floats,
    restitution: Floats,
    velocity: Floats,
    cycles: int,
    samples: int,
    status: NDArray[np.int64],
    impacts: NDArray[np.int64],
) -> None:
    """March blocks that start at angle 0 and phase 0, and note how each ends."""
    for i in range(len(amplitude)):
        status[i], impacts[i] = sampled_fate(
            amplitude[i], frequency_ratio[i], restitution[i], velocity[i], cycles, samples
        )


@numba.njit(error_model="numpy")
def sampled_fate(
    amplitude: float,
    frequency: float,
    restitution: float,
    velocity: float,
    cycles: int,
    samples: int,
) -> tuple[int, int]:
    """Return the status after so many forcing periods, and the number of impacts."""
    beta = amplitude / (1.0 + frequency * frequency)
    step = 2.0 * math.pi / (frequency * samples)
    left = 2.0 * math.pi * cycles / frequency  # time still to run
    phase = 0.0  # of the forcing, seen from the side on which the block stands
    impacts = 0
    resting = velocity == 0.0
    while True:
        if resting:
            time = sampled_uplift(amplitude, frequency, phase, step, left)
            if time >= left:
                return AT_REST, impacts
            left -= time
            phase = (phase + frequency * time) % (2.0 * math.pi)
            if math.sin(phase) < 0.0:
                phase = (phase + math.pi) % (2.0 * math.pi)
            velocity = 0.0

        growing = 0.5 * (velocity + beta * frequency * math.cos(phase) + beta * math.sin(phase) - 1)
        decaying = growing - (velocity + beta * frequency * math.cos(phase))
        time = 0.0
        while True:
            time += step
            if time >= left:
                return ROCKING, impacts
            e = math.exp(time)
            y = growing * e + decaying / e + 1.0 - beta * math.sin(phase + frequency * time)
            if y <= 0.0:
                break
            if y > TOPPLED:
                return OVERTURNED, impacts
        high = bisected_zero(growing, decaying, beta, frequency, phase, time - step, time)
        e = math.exp(high)
        landing = phase + frequency * high
        velocity = -restitution * (
            growing * e - decaying / e - beta * frequency * math.cos(landing)
        )
        left -= high
        phase = (landing + math.pi) % (2.0 * math.pi)
        impacts += 1
        resting = velocity < SLOW and amplitude * abs(math.sin(phase)) < 1.0


@numba.njit(error_model="numpy")
def sampled_uplift(
    amplitude: float, frequency: float, phase: float, step: float, left: float
) -> float:
    """Sample until the base pulls harder than gravity and bisect the moment; `left` if never."""
    time = 0.0
    while amplitude * abs(math.sin(phase + frequency * time)) <= 1.0:
        time += step
        if time >= left:
            return left
    low, high = max(time - step, 0.0), time
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        if middle in (low, high):  # to the last bit
            break
        if amplitude * abs(math.sin(phase + frequency * middle)) > 1.0:
            high = middle
        else:
            low = middle
    return high


@numba.njit(error_model="numpy")
def bisected_zero(
    growing: float,
    decaying: float,
    beta: float,
    frequency: float,
    phase: float,
    low: float,
    high: float,
) -> float:
    """Bisect the change of sign of the angle between `low` and `high` to the last bit."""
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        e = math.exp(middle)
        if growing * e + decaying / e + 1.0 - beta * math.sin(phase + frequency * middle) > 0.0:
            low = middle
        else:
            high = middle
    return high
