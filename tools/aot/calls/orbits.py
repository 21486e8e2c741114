"""Calls of the kernels behind steady states, orbits, attractors and continuation."""

import math
from itertools import product
from typing import Any

import numpy as np

from rocksteady.kernels.core.tables import RESTITUTION
from rocksteady.kernels.orbits.chains import CHAIN_COLUMNS
from rocksteady.kernels.orbits.closed_form import Symmetric
from rocksteady.kernels.orbits.periodic import ORBIT_COLUMNS
from rocksteady.kernels.orbits.return_map import FALL, STAY, STUCK, Section
from rocksteady.kernels.orbits.settle import GENERIC, LONGEST_ORBIT, MEMORY, PERIODIC, Stretch
from rocksteady.kernels.orbits.systems import System
from tools.aot.calls.drawn import Drawn
from tools.aot.calls.recorder import Recorder

CASES = (  # amplitude, frequency ratio and restitution: orbits, chatter and rests among them
    (2.0, 4.0, 0.8),
    (1.2, 1.0, 0.6),
    (2.6, 4.4, 0.9),
    (5.5, 8.0, 0.85),
    (1.05, 2.0, 0.5),
    (2.3, 2.9, 0.93),
)
STEADY = ((2.0, 4.0, 0.8, 1), (4.0, 7.0, 0.9, 3), (25.0, 30.0, 1.0, 5))
"""Amplitude, frequency ratio, restitution and order of symmetric orbits."""


def record_steady_orbits(call: Recorder) -> None:
    """Record symmetric orbits in closed form, those of the nonlinear model, and their parts."""
    drawn = Drawn.by_name("steady orbits")
    for a, w, r, order in STEADY:
        for branch in (1, 2):
            orbit: Symmetric = call("symmetric_orbit", a, w, r, order, branch)
            if branch == 1 and order != 3:
                call("half_cycle_jacobian", a, w, r, order, orbit)
                times = np.sort(drawn.rng.uniform(0.0, order * math.pi / w, 9))
                call("fill_half_cycle", a, w, order, orbit, times, np.zeros((2, 9)))
                call("symmetry_breaking", w, min(r, 0.99), order)
            if order == 1:
                sides = drawn.sides(1, nonlinear=True, alike=1.0)[0]
                sides[:, RESTITUTION] = r
                half, phase = call.quietly("clock", orbit.phase)
                state = Section(1, half, phase, w * orbit.velocity)
                call("symmetric_from", a, w, sides, order, branch, state)


def record_passages(call: Recorder) -> None:
    """Record the return map: impacts, rests, uplifts and falls, of blocks of every kind."""
    for nonlinear in (False, True):
        for k in (0, 1, 4):
            drawn = Drawn.by_name(f"passages, {nonlinear}, {k}")
            system = _system(call, drawn, *CASES[k], nonlinear=nonlinear, alike=k % 2)
            speeds = (drawn.between(0.2, 0.5), 1e-3) if k else (drawn.between(0.2, 0.5), 3.0)
            for speed in speeds:
                state = Section(1 if k else -1, 3, drawn.between(0.0, math.pi), speed)
                step = call("next_passage", system, state, -1.0)
                if k != 1 and step.kind not in (FALL, STAY, STUCK):
                    call("highest_after", system, state, step)
                if k == 1 and speed == speeds[0]:
                    call("phase_between", state, step.state)
                    call("guess_after", step)
                    stretch = Stretch(*GENERIC, drawn.between(-1.0, 1.0), 2)
                    call("stretched", stretch, step.jacobian)
            if k != 0:
                lifted = call("uplift_after", system, k, drawn.between(0.0, math.pi))
                begin = lifted.state
                call("chatter_end", system, begin, Section(begin.side, 3, 0.1, 1e-4))


def record_orbits(call: Recorder) -> None:
    """Record what motions settle to, and orbits as Newton's method finds and measures them."""
    for nonlinear in (False, True):
        for k, case in enumerate(CASES):
            if nonlinear and k in (1, 2):
                continue
            drawn = Drawn.by_name(f"orbits, {nonlinear}, {k}")
            system = _system(call.quietly, drawn, *case, nonlinear=nonlinear, alike=1)
            _orbit(call, drawn, system, rests=k == 3)
    for k in (0, 2):
        drawn = Drawn.by_name(f"search, {k}")
        system = _system(call.quietly, drawn, *CASES[k], nonlinear=k == 2, alike=1)
        phases, speeds = np.linspace(0.1, 6.0, 5), np.linspace(0.05, 0.8, 4)
        table, found = np.zeros((8, ORBIT_COLUMNS)), np.zeros((6, 2))
        shape = np.zeros((6, 2), np.int64)
        call("search", system, phases, speeds, 4, 3, True, table, found, shape, 0)
    drawn = Drawn.by_name("states")
    state = Section(-1, 5, drawn.between(0.0, 3.0), drawn.between(0.0, 1.0))
    table = np.zeros((2, ORBIT_COLUMNS))
    call("put", table, 1, call("mirror", state, 3))
    call("state_at", table, 1)


def record_chains(call: Recorder) -> None:
    """Record orbits as chains of arcs, closed and not, of either parity and model."""
    shapes = ((1, 1), (2, 2), (3, 5), (4, 6))
    for nonlinear, k in product((False, True), range(len(shapes))):
        impacts, halves = shapes[k]
        drawn = Drawn.by_name(f"chain, {k}" + ", nonlinear" * nonlinear)
        a, w, _ = CASES[k]
        sides = drawn.sides(1, nonlinear=nonlinear, alike=impacts % 2)[0]
        places = np.arange(impacts) * halves * math.pi / impacts + drawn.rng.uniform(
            0.1, 0.4, impacts
        )
        turns = np.floor(places / math.pi).astype(np.int64)
        phases = places - turns * math.pi
        table = np.zeros((impacts, CHAIN_COLUMNS))
        call("fill_chain", a, w, sides, turns, phases, halves, table)
        call("fill_matrix", table, 1.0 if k % 2 else -1.0, np.zeros((impacts, impacts)))
        call("turned_over", table)
        system = call.quietly("make_system", a, w, sides)
        call("fill_arcs", system, turns, phases, table, np.zeros((impacts, 3)))
    for row in (0, 1):
        call("side_of", row)


def _system(
    call: Any,
    drawn: Drawn,
    amplitude: float,
    frequency_ratio: float,
    restitution: float,
    *,
    nonlinear: bool,
    alike: float,
) -> System:
    """Return a shaken block."""
    sides = drawn.sides(1, nonlinear=nonlinear, alike=alike)[0]
    sides[:, RESTITUTION] = restitution
    system: System = call("make_system", amplitude, frequency_ratio, sides)
    return system


def _orbit(call: Recorder, drawn: Drawn, system: System, *, rests: bool) -> None:
    """Record what a motion settles to, and how its orbit is found and measured again."""
    start = (1, 0, drawn.between(0.0, math.pi), 0.0, drawn.between(0.05, 0.5), 60)
    if rests:
        start = (0, 0, start[2], 0.0, 0.0, 60)
    # The orbit of a motion that rests may be long: the whole room shows how much is needed.
    room = np.zeros((LONGEST_ORBIT, ORBIT_COLUMNS))
    call.quietly("settle", system, *start, np.zeros((MEMORY, ORBIT_COLUMNS)), room)
    rows = np.flatnonzero(room.any(axis=1))
    needed = int(rows[-1]) + 1 if len(rows) else 1
    if needed > MEMORY:
        message = f"a motion of this case needs {needed} rows: draw another one"
        raise ValueError(message)
    memory, table = np.zeros((MEMORY, 5)), np.zeros((needed, ORBIT_COLUMNS))
    settled = call("settle", system, *start, memory, table)
    if settled.outcome != PERIODIC:
        return
    passages, periods = settled.passages, settled.periods
    near = settled.state
    if near.speed > 0.0:
        near = near._replace(phase=near.phase + 1e-4, speed=near.speed * 1.001)
    fixed = call("polish", system, near, passages, periods, np.zeros((passages, ORBIT_COLUMNS)))
    call("measured", system, passages, periods, table)
    call("fill_peaks", system, passages, table)
    call("is_symmetric", system, table, passages, periods)
    determinant = call("loss", system, near.side, passages, fixed.rests)
    call("multipliers", fixed.jacobian, determinant)
