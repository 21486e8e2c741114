"""Calls of the elementary functions over arrays, and of oscillators under a record."""

import math

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.elementary import loops
from rocksteady.kernels.elementary.arrays import exp
from rocksteady.kernels.entries import ENTRIES
from tools.aot.calls.drawn import Drawn
from tools.aot.calls.recorder import Recorder

SPECIAL = (0.0, 1.0, 0.5, 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, math.inf)
"""Numbers that are recorded with both signs, and NaN with them."""
OF_TWO = ("fill_atan2", "fill_hypot")


def record_functions(call: Recorder, count: int) -> None:
    """Record every function at numbers of every size, `count` of them."""
    for name, kernel in ENTRIES.items():
        if kernel.__module__ != loops.__name__:
            continue
        drawn = Drawn.by_name(name)
        arguments = [_numbers(drawn, count) for _ in range(2 if name in OF_TWO else 1)]
        call(name, *arguments, np.zeros(count))


def record_oscillators(call: Recorder, samples: int) -> None:
    """Record the states of damped oscillators under a record, and their largest motion."""
    for damping in (0.0, 0.05):
        drawn = Drawn.by_name(f"oscillator, {damping}, {samples}")
        angle = drawn.between(0.05, 0.5)
        size = math.exp(-damping * angle)
        turn = (size * math.cos(angle), size * math.sin(angle))
        step = np.array([turn, *drawn.rng.normal(scale=0.01, size=(2, 2))])
        record, states = drawn.rng.normal(size=samples), np.zeros((2, samples))
        call("fill_oscillator", record, step, states)
        h, rate = drawn.between(0.1, 1.0), (-damping, math.sqrt(1.0 - damping * damping))
        call("fill_largest", record, drawn.rng.normal(size=(2, samples)), h, rate, np.zeros(3))


def _numbers(drawn: Drawn, count: int) -> NDArray[np.float64]:
    """Return numbers: most of usual sizes, others of all, in an order of their own."""
    rng = drawn.rng
    usual = rng.uniform(-1.0, 1.0, count) * rng.choice([1.0, 4.0, 30.0, 700.0], count)
    rare = rng.choice([-1.0, 1.0], count) * exp(rng.uniform(-700.0, 700.0, count))
    found = np.where(rng.random(count) < 0.7, usual, rare)
    special = np.array([*SPECIAL, *(-value for value in SPECIAL), math.nan])
    found[: len(special)] = special
    rng.shuffle(found)
    return found
