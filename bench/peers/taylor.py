"""heyoka: Taylor series to the last bit, each impact a terminal event whose callback goes on.

Events are roots of the Taylor polynomials of a step. Right after an event heyoka disregards that
event for a while, its cooldown. The one that it chooses itself loses bounces of velocity 1e-7 and
lets the block fall through the floor; the shortest bounce before the rest rule lasts 1e-8, and the
cooldown is far below it. The start itself is a root too and counts as no impact.
"""

import math
import time
from collections.abc import Callable
from importlib.metadata import version
from typing import Any

import numpy as np

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
    uplift,
    uplift_share,
)

AMPLITUDE, FREQUENCY, STANDS_ON, MOVES = 0, 1, 2, 3  # parameters of the equation
COOLDOWN = 1e-12
EXACT, COARSE = 2.0**-52, 1e-10
IMPACT, FELL = -1, -2  # how heyoka names the terminal event that stopped it


def peers() -> list[Peer]:
    """Return the integrator of one trajectory and that of as many as fit the vector registers."""
    return peers_of(LINEAR, EXACT)


def nonlinear_peers() -> list[Peer]:
    """Return the same for the nonlinear equation of motion, to rounding and to a tolerance."""
    return [*peers_of(ALPHA, EXACT), *peers_of(ALPHA, COARSE)]


def peers_of(alpha: float, tolerance: float) -> list[Peer]:
    """Return the integrators for blocks of one alpha."""
    import heyoka

    lanes = heyoka.recommended_simd_size()
    settings = f"tolerance {tolerance:.2g}, fast_math, terminal events with cooldown {COOLDOWN}"
    return [
        Peer(
            name="heyoka",
            version=version("heyoka"),
            settings=f"taylor_adaptive, {settings}",
            thinned=1,
            run=Single(alpha, tolerance).run,
        ),
        Peer(
            name="heyoka, batch",
            version=version("heyoka"),
            settings=f"taylor_adaptive_batch of {lanes}, {settings}",
            thinned=1,
            run=Batch(lanes, alpha, tolerance).run,
        ),
    ]


def system(
    event: Callable[..., Any],
    impact: Callable[..., bool],
    fell: Any,
    alpha: float,
    tolerance: float,
) -> dict[str, Any]:
    """Return equations and events, with the side, and a switch that stops the motion."""
    import heyoka as hy

    x, v = hy.make_vars("x", "v")
    amplitude, frequency, side, moves = (hy.par[i] for i in range(4))
    base = amplitude * hy.sin(frequency * hy.time)
    # Above a certain angle and rising it can never come back.
    if alpha == LINEAR:
        pull, lost = x - side + base, 1.0 + amplitude
    else:
        tilt = alpha - alpha * side * x
        pull = base * hy.cos(tilt) - side * hy.sin(tilt) / alpha
        lost = 1.0 + hy.atan(alpha * amplitude) / alpha
    beyond = side * x - lost
    rising = {"direction": hy.event_direction.positive}
    return {
        "sys": [(x, v), (v, moves * pull)],
        "t_events": [
            event(x, callback=impact, cooldown=COOLDOWN),
            event(beyond, **rising, **({"callback": fell} if fell else {})),
        ],
        "fast_math": True,
        "tol": tolerance,
    }


class Single:
    """One trajectory after the other."""

    def __init__(self, alpha: float, tolerance: float) -> None:
        import heyoka as hy

        self.share = uplift_share(alpha)
        made = system(hy.t_event, self.impact_callback(), None, alpha, tolerance)
        self.solver = hy.taylor_adaptive(state=[0.0, 0.0], pars=[1.0] * 4, **made)
        self.state, self.pars = self.solver.state, self.solver.pars
        self.began = self.last = 0.0
        self.impacts = 0

    def impact_callback(self) -> Callable[[Any, int], bool]:
        """Return a function and no method: heyoka would copy the object that holds it."""

        def impact(solver: Any, _: int) -> bool:
            now, state, pars = solver.time, self.state, self.pars
            state[0] = 0.0
            if now == self.began:
                return True
            state[1] *= RESTITUTION
            pars[STANDS_ON] = -pars[STANDS_ON]
            self.impacts += 1
            self.last = now
            return abs(state[1]) > SLOW or lifted(pars, now, self.share)

        return impact

    def run(self, cells: Cells) -> Outcome:
        """Integrate the cells."""
        count = len(cells.amplitude)
        status, impacts = np.zeros(count, np.int64), np.zeros(count, np.int64)
        last = np.full(count, math.nan)
        began = time.process_time()
        for i in range(count):
            status[i] = self.fate(cells.amplitude[i], cells.frequency_ratio[i])
            impacts[i] = self.impacts
            if self.impacts:
                last[i] = (cells.frequency_ratio[i] * self.last) % TURN
        seconds = time.process_time() - began
        return Outcome(status=status, impacts=impacts, last_phase=last, seconds=seconds)

    def fate(self, amplitude: float, frequency: float) -> int:
        """Integrate one cell and return how it ends."""
        solver, end = self.solver, TURN * CYCLES / frequency
        self.pars[:] = amplitude, frequency, 1.0, 1.0
        self.state[:] = 0.0, START_VELOCITY
        solver.time = self.began = 0.0
        self.impacts = 0
        while True:
            solver.reset_cooldowns()
            outcome = int(solver.propagate_until(end)[0].value)
            if outcome == FELL:
                return OVERTURNED
            if outcome != IMPACT:
                return ROCKING
            tau, side = uplift(self.share * amplitude, frequency * solver.time)
            if tau >= TURN * CYCLES:
                return ROCKING
            solver.time = self.began = tau / frequency
            self.pars[STANDS_ON] = side
            self.state[:] = 0.0, side * SLOW


class Batch:
    """Several trajectories side by side in vector registers."""

    def __init__(self, lanes: int, alpha: float, tolerance: float) -> None:
        import heyoka as hy

        self.share = uplift_share(alpha)
        made = system(
            hy.t_event_batch, self.impact_callback(), self.fall_callback(), alpha, tolerance
        )
        zeros, ones = np.zeros((2, lanes)), np.ones((4, lanes))
        self.lanes = lanes
        self.solver = hy.taylor_adaptive_batch(state=zeros, pars=ones, **made)
        self.state, self.pars, self.time = self.solver.state, self.solver.pars, self.solver.time
        self.began, self.last = np.zeros(lanes), np.zeros(lanes)
        self.impacts = np.zeros(lanes, np.int64)
        self.fell, self.rests = np.zeros(lanes, bool), np.zeros(lanes, bool)

    def impact_callback(self) -> Callable[[Any, int, int], bool]:
        """Return a function and no method: heyoka would copy the object that holds it."""

        def impact(_: Any, __: int, lane: int) -> bool:
            now, state, pars = self.time[lane], self.state, self.pars
            state[0, lane] = 0.0
            if now == self.began[lane]:
                return True
            state[1, lane] *= RESTITUTION
            pars[STANDS_ON, lane] = -pars[STANDS_ON, lane]
            self.impacts[lane] += 1
            self.last[lane] = now
            if abs(state[1, lane]) > SLOW or lifted(pars[:, lane], now, self.share):
                return True
            self.rests[lane] = True
            return False

        return impact

    def fall_callback(self) -> Callable[[Any, int, int], bool]:
        """Return what freezes a lane until the others have ended too."""

        def fell(_: Any, __: int, lane: int) -> bool:
            self.fell[lane] = True
            self.freeze(lane)
            return True

        return fell

    def freeze(self, lane: int) -> None:
        """Let a lane stand still, away from all events."""
        self.pars[MOVES, lane] = 0.0
        self.state[:, lane] = self.pars[STANDS_ON, lane], 0.0

    def run(self, cells: Cells) -> Outcome:
        """Integrate the cells, neighbours along the amplitude side by side."""
        count = len(cells.amplitude)
        status, impacts = np.zeros(count, np.int64), np.zeros(count, np.int64)
        last = np.full(count, math.nan)
        order = np.lexsort((cells.amplitude, cells.frequency_ratio))
        began = time.process_time()
        for first in range(0, count, self.lanes):
            chosen = order[first : first + self.lanes]
            filled = np.resize(chosen, self.lanes)  # the last batch repeats some cells
            frequency = cells.frequency_ratio[filled]
            self.integrate(cells.amplitude[filled], frequency)
            used = len(chosen)
            status[chosen] = np.where(self.fell, OVERTURNED, ROCKING)[:used]
            impacts[chosen] = self.impacts[:used]
            phases = np.where(self.impacts > 0, (frequency * self.last) % TURN, math.nan)
            last[chosen] = phases[:used]
        seconds = time.process_time() - began
        return Outcome(status=status, impacts=impacts, last_phase=last, seconds=seconds)

    def integrate(self, amplitude: np.ndarray, frequency: np.ndarray) -> None:
        """Integrate one batch to the end of each lane."""
        solver, end = self.solver, TURN * CYCLES / frequency
        self.pars[AMPLITUDE], self.pars[FREQUENCY] = amplitude, frequency
        self.pars[STANDS_ON] = self.pars[MOVES] = 1.0
        self.state[0], self.state[1] = 0.0, START_VELOCITY
        self.began[:] = 0.0
        solver.set_time(0.0)
        solver.reset_cooldowns()
        self.impacts[:], self.fell[:], self.rests[:] = 0, False, False
        while True:
            solver.propagate_until(end)
            if not self.rests.any():
                return
            times = self.time.copy()
            for lane in np.flatnonzero(self.rests):
                tau, side = uplift(self.share * amplitude[lane], frequency[lane] * times[lane])
                if tau >= TURN * CYCLES:
                    self.freeze(lane)
                    continue
                times[lane] = self.began[lane] = tau / frequency[lane]
                self.pars[STANDS_ON, lane] = side
                self.state[:, lane] = 0.0, side * SLOW
                solver.reset_cooldowns(int(lane))
            self.rests[:] = False
            solver.set_time(times)


def lifted(pars: np.ndarray, now: float, share: float) -> bool:
    """Return whether the base pulls harder than gravity."""
    return bool(share * pars[AMPLITUDE] * abs(math.sin(pars[FREQUENCY] * now)) >= 1.0)
