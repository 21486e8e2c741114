"""scipy: one call of solve_ivp for each flight, which ends at an event."""

import math
import time
from functools import partial
from importlib.metadata import version

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

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

Floats = NDArray[np.float64]


def peers() -> list[Peer]:
    """Return solve_ivp with its most accurate explicit method."""
    return [peer(LINEAR, 12)]


def nonlinear_peers() -> list[Peer]:
    """Return the same for the nonlinear equation of motion."""
    return [peer(ALPHA, 24)]


def peer(alpha: float, thinned: int) -> Peer:
    """Return solve_ivp for blocks of one alpha."""
    return Peer(
        name="scipy solve_ivp",
        version=version("scipy"),
        settings="DOP853, rtol 1e-10, atol 1e-12, terminal events",
        thinned=thinned,
        run=partial(run, alpha=alpha),
    )


def run(cells: Cells, alpha: float) -> Outcome:
    """Integrate the cells."""
    count = len(cells.amplitude)
    status, impacts = np.zeros(count, np.int64), np.zeros(count, np.int64)
    last = np.full(count, math.nan)
    began = time.process_time()
    for i in range(count):
        status[i], impacts[i], tau = fate(
            float(cells.amplitude[i]), float(cells.frequency_ratio[i]), alpha
        )
        if impacts[i]:
            last[i] = tau % TURN
    seconds = time.process_time() - began
    return Outcome(status=status, impacts=impacts, last_phase=last, seconds=seconds)


def fate(amplitude: float, frequency: float, alpha: float) -> tuple[int, int, float]:
    """Return status, number of impacts and Omega s of the last one."""
    began, end = 0.0, TURN * CYCLES / frequency
    side, velocity, impacts, last = 1.0, START_VELOCITY, 0, 0.0
    lost, strength = lost_angle(amplitude, alpha), amplitude * uplift_share(alpha)

    def linear(now: float, state: Floats) -> tuple[float, float]:
        return state[1], state[0] - 1.0 + side * amplitude * math.sin(frequency * now)

    def nonlinear(now: float, state: Floats) -> tuple[float, float]:
        tilt = alpha * (1.0 - state[0])
        push = side * amplitude * math.sin(frequency * now) * math.cos(tilt)
        return state[1], push - math.sin(tilt) / alpha

    def impact(now: float, state: Floats) -> float:
        return float(state[0]) if now > began else 1.0  # the start of a flight is no impact

    def fall(_: float, state: Floats) -> float:
        return float(state[0]) - lost  # rising through it, it can never come back

    impact.terminal = fall.terminal = True
    impact.direction, fall.direction = -1.0, 1.0
    while True:
        flight = solve_ivp(
            linear if alpha == LINEAR else nonlinear,
            (began, end),
            (0.0, velocity),
            method="DOP853",
            rtol=1e-10,
            atol=1e-12,
            events=(impact, fall),
        )
        if flight.t_events[1].size:
            return OVERTURNED, impacts, last
        if not flight.t_events[0].size:
            return ROCKING, impacts, last
        began = flight.t_events[0][0]
        velocity = -RESTITUTION * flight.y_events[0][0][1]
        impacts += 1
        last = frequency * began
        side = -side
        if velocity <= SLOW and strength * abs(math.sin(last)) < 1.0:
            tau, side = uplift(strength, last)
            began, velocity = tau / frequency, SLOW
            if began >= end:
                return ROCKING, impacts, last
