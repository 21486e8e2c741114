"""Cases that several tests draw: random flights of every kind, and Hypothesis strategies."""

import math
import os
from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np
import pytest
from hypothesis import strategies as st
from numpy.typing import NDArray

Floats = NDArray[np.float64]
SizeT = TypeVar("SizeT")

PLAIN = os.environ.get("ROCKSTEADY_KERNELS") == "python"
"""Whether the kernels run as plain Python, some hundred times slower."""


def sample_size(compiled: SizeT, plain: SizeT) -> SizeT:
    """Return how much to test: as much as compiled code can do, or less without it."""
    return plain if PLAIN else compiled


def inner_sample_size(compiled: int, plain: int) -> int:
    """Return how much to test of a kernel that other kernels alone call.

    The library does not hold it: it runs as plain Python, but what it is compared with does not.
    """
    return plain if PLAIN else round(math.sqrt(compiled * plain))


def rest_slow(values: Sequence[Any], quick: int) -> list[Any]:
    """Return values to test with: the first few in every run, the others in the slow tests."""
    return [
        *values[:quick],
        *(pytest.param(value, marks=pytest.mark.slow) for value in values[quick:]),
    ]


# Columns of a random flight.
CONSTANT, SLOPE, AMPLITUDE, FREQUENCY, ANGLE, VELOCITY, PHASE, SPAN = range(8)


def random_flights(rng: np.random.Generator, count: int) -> Floats:
    """Return flights of every kind of forcing, shape (count, 8), many of them nearly balanced.

    A flight whose growing part is small hovers, dips and grazes; drawn at random it would fly off.
    """
    flights = np.zeros((count, 8))

    def some(share: float) -> NDArray[np.bool_]:
        return rng.random(count) < share

    flights[:, CONSTANT] = np.where(some(0.6), -1.0, rng.uniform(-3.0, 3.0, count))
    flights[some(0.05), CONSTANT] = 0.0
    flights[:, SLOPE] = np.where(some(0.25), rng.normal(0.0, 1.0, count), 0.0)
    flights[:, AMPLITUDE] = np.where(some(0.9), 10.0 ** rng.uniform(-1.0, 1.1, count), 0.0)
    flights[some(0.05), AMPLITUDE] = 1.0
    flights[:, FREQUENCY] = 10.0 ** rng.uniform(math.log10(0.05), 3.0, count)
    flights[flights[:, AMPLITUDE] == 0.0, FREQUENCY] = 0.0
    flights[:, PHASE] = rng.uniform(-0.5 * math.pi, 1.5 * math.pi, count)
    flights[:, ANGLE] = np.where(some(0.5), 0.0, rng.normal(0.0, 0.7, count))
    # A base that shakes fast moves the block little: its starts are scaled alike.
    frequency = flights[:, FREQUENCY]
    scale = np.where(some(0.5), 1.0, 1.0 / (1.0 + frequency))
    flights[:, ANGLE] *= scale
    flights[:, VELOCITY] = rng.normal(0.0, 1.0, count) * scale
    beta = flights[:, AMPLITUDE] / (1.0 + frequency**2)
    balanced = -(
        flights[:, SLOPE]
        + beta * frequency * np.cos(flights[:, PHASE])
        + flights[:, ANGLE]
        + flights[:, CONSTANT]
        + beta * np.sin(flights[:, PHASE])
    )
    growing = 10.0 ** rng.uniform(-9.0, 0.0, count) * rng.choice([-1.0, 1.0], count)
    hovering = some(0.5)
    flights[hovering, VELOCITY] = (balanced + 2.0 * growing)[hovering]
    start = flights[:, ANGLE] == 0.0
    slow = start & (np.abs(flights[:, VELOCITY]) < 1e-4)
    flights[slow, VELOCITY] = 1e-2  # the double-precision oracle is too coarse for tiny bounces
    longest = np.where(frequency > 30.0, 300.0 / np.maximum(frequency, 30.0), 10.0)
    flights[:, SPAN] = longest * rng.uniform(0.05, 1.0, count)
    return flights


# ---------------------------------------------------------------------- Hypothesis strategies


def logarithmic(low: float, high: float) -> st.SearchStrategy[float]:
    """Draw from [low, high], even in the logarithm."""
    # exp(log(high)) may be a little more than high.
    return st.floats(math.log(low), math.log(high)).map(lambda x: min(max(math.exp(x), low), high))


frequency_ratios = logarithmic(0.05, 1000.0)
amplitudes = st.one_of(st.floats(0.0, 12.0), st.just(1.0))
restitutions = st.floats(0.05, 1.0)
phases = st.floats(-0.5 * math.pi, 1.5 * math.pi, exclude_max=True)
velocities = logarithmic(1e-12, 10.0)
