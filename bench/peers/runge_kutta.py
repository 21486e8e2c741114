"""The classical Runge-Kutta method of order four in numba, with a fixed step.

A step that ends below the floor is cut at the zero of its cubic, found by bisection, and the march
goes on from there. Two impacts inside one step are lost.
"""

import math
import time
from functools import partial
from importlib.metadata import version

import numba
import numpy as np
from numpy.typing import NDArray

from bench.peers.work import (
    ALPHA,
    CYCLES,
    LINEAR,
    OVERTURNED,
    RESTITUTION,
    ROCKING,
    SLOW,
    START_VELOCITY,
    TURN,
    Cells,
    Outcome,
    Peer,
    lost_angle,
    uplift,
    uplift_share,
)

BISECTIONS = 52

compiled_uplift = numba.njit(uplift)
compiled_lost_angle = numba.njit(lost_angle)


def peers() -> list[Peer]:
    """Return the march with a coarse and with a fine step, compiled."""
    return peers_of(LINEAR)


def nonlinear_peers() -> list[Peer]:
    """Return the same for the nonlinear equation of motion."""
    return peers_of(ALPHA)


def peers_of(alpha: float) -> list[Peer]:
    """Return the march of blocks of one alpha."""
    fates(np.ones(1), np.ones(1), 10, 1, alpha, 1.0)
    return [
        Peer(
            name=f"Runge-Kutta 4, {steps} steps a period",
            version=f"numba {version('numba')}",
            settings="fixed step, bisection on the cubic of the step",
            thinned=thinned,
            run=partial(run, steps=steps, alpha=alpha),
        )
        for steps, thinned in ((100, 1), (2000, 4))
    ]


def run(cells: Cells, steps: int, alpha: float = LINEAR) -> Outcome:
    """March the cells; with `alpha` a rectangle in its nonlinear equation of motion."""
    began = time.process_time()
    status, impacts, last = fates(
        cells.amplitude, cells.frequency_ratio, steps, CYCLES, alpha, uplift_share(alpha)
    )
    seconds = time.process_time() - began
    return Outcome(status=status, impacts=impacts, last_phase=last, seconds=seconds)


@numba.njit(error_model="numpy")
def fates(
    amplitude: NDArray[np.float64],
    frequency_ratio: NDArray[np.float64],
    steps: int,
    cycles: int,
    alpha: float,
    share: float,
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """Return status, number of impacts and phase of the last one, of each cell."""
    count = len(amplitude)
    status, impacts = np.zeros(count, np.int64), np.zeros(count, np.int64)
    last = np.full(count, np.nan)
    for i in range(count):
        status[i], impacts[i], tau = fate(
            amplitude[i], frequency_ratio[i], steps, cycles, alpha, share
        )
        if impacts[i] > 0:
            last[i] = tau % TURN
    return status, impacts, last


@numba.njit(error_model="numpy")
def fate(
    amplitude: float, frequency: float, steps: int, cycles: int, alpha: float, share: float
) -> tuple[int, int, float]:
    """Return status, number of impacts and Omega s of the last one."""
    h, turned = TURN / (frequency * steps), TURN / steps
    end, tau, last = TURN * cycles, 0.0, 0.0
    lost, strength = compiled_lost_angle(amplitude, alpha), amplitude * share
    side, y, v, impacts = 1.0, 0.0, START_VELOCITY, 0
    while tau < end:
        k1 = pull(y, side * amplitude * math.sin(tau), alpha)
        middle = side * amplitude * math.sin(tau + 0.5 * turned)
        k2 = pull(y + 0.5 * h * v, middle, alpha)
        k3 = pull(y + 0.5 * h * v + 0.25 * h * h * k1, middle, alpha)
        ahead = side * amplitude * math.sin(tau + turned)
        k4 = pull(y + h * v + 0.5 * h * h * k2, ahead, alpha)
        y_next = y + h * v + h * h / 6.0 * (k1 + k2 + k3)
        v_next = v + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        if y_next > 0.0:
            y, v, tau = y_next, v_next, tau + turned
            if y > lost and v > 0.0:
                return OVERTURNED, impacts, last
            continue
        s = descent(y, h * v, y_next, h * v_next)
        if tau + s * turned > end:
            break
        tau += s * turned
        landing = 6.0 * s * (s - 1.0) * (y - y_next) / h
        landing += (3.0 * s - 1.0) * (s - 1.0) * v + (3.0 * s - 2.0) * s * v_next
        y, v, side = 0.0, -RESTITUTION * landing, -side
        impacts += 1
        last = tau
        if v < SLOW and strength * abs(math.sin(tau)) < 1.0:
            tau, lifting = compiled_uplift(strength, tau)
            side, v = float(lifting), SLOW
    return ROCKING, impacts, last


@numba.njit(error_model="numpy")
def pull(y: float, base: float, alpha: float) -> float:
    """Return y'' on the side on which the block stands."""
    if alpha == LINEAR:
        return y - 1.0 + base
    lean = alpha - alpha * y
    return base * math.cos(lean) - math.sin(lean) / alpha


@numba.njit(error_model="numpy")
def descent(y: float, slope: float, y_next: float, slope_next: float) -> float:
    """Return where in (0, 1] the cubic of a step falls through the floor."""
    low, high = 0.0, 1.0
    for _ in range(BISECTIONS):
        s = 0.5 * (low + high)
        rest = 1.0 - s
        value = (1.0 + 2.0 * s) * rest * rest * y + s * rest * rest * slope
        value += s * s * (3.0 - 2.0 * s) * y_next - s * s * rest * slope_next
        if value > 0.0:
            low = s
        else:
            high = s
    return high
