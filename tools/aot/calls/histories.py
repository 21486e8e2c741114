"""Calls of the kernels behind one time history: the march, its clock and its replay."""

import math
from typing import Any

import numpy as np

from rocksteady.kernels.core.motions import (
    CLOSED,
    MAVROEIDIS_PAPAGEORGIOU,
    PIECE_COLUMNS,
    RICKER,
    RICKER_ANTISYMMETRIC,
    PulseNumbers,
)
from rocksteady.kernels.core.tables import (
    AMPLITUDE,
    CEILING,
    FREQUENCY,
    OVERTURNED,
    PEAK_COLUMNS,
    ROW_COLUMNS,
    ROW_DURATION,
    SEGMENT_COLUMNS,
    March,
)
from rocksteady.kernels.march.facts import LANDING_ROWS
from rocksteady.kernels.march.forces import FORCES
from tools.aot.calls.drawn import CENTRES, MOTIONS, Drawn
from tools.aot.calls.recorder import Recorder

LIMIT = 400
"""Flights after which a march is given up."""
RESTING = "pulse"
"""The kind of motion under which marches end at rest."""


def record_histories(call: Recorder) -> None:
    """Record marches under motions of every kind, and what is read off them."""
    for kind in MOTIONS:
        for nonlinear in (False, True):
            drawn = Drawn.by_name(f"{kind}, {nonlinear}")
            segments = drawn.segments(kind, nonlinear=nonlinear)
            sides, status, rows = _history(call, drawn, segments, LIMIT)
            if kind == RESTING:
                _facts(call, segments, sides, rows, status)
    drawn = Drawn.by_name("base that falls away")
    _history(call, drawn, drawn.segments("record", nonlinear=True, lift=6.0), LIMIT)
    drawn = Drawn.by_name("march cut short")
    _history(call, drawn, drawn.segments("harmonic", nonlinear=False), 3)
    for nonlinear in (False, True):
        _fall(call, nonlinear=nonlinear)


def record_small_parts(call: Recorder) -> None:
    """Record clocks, tables and other small kernels that Python calls by themselves."""
    drawn = Drawn.by_name("small parts")
    for phase in (0.0, math.pi, -math.pi, drawn.between(-20.0, 20.0), drawn.over(1e3, 1e6)):
        call("clock", phase)
    phases = drawn.rng.uniform(-9.0, 9.0, 12)
    call("fill_clocks", phases, np.zeros(12, np.int64), np.zeros(12))
    for nonlinear in (False, True):
        call("is_nonlinear", drawn.sides(1, nonlinear=nonlinear)[0])
        segments = drawn.segments("pieces", nonlinear=nonlinear)
        call("segment_start", segments, 2)
        call("segment_start", segments, len(segments) - 1)
    for _ in range(2):
        amplitude, ratio = drawn.shaking()
        empty = np.ones((1, SEGMENT_COLUMNS))
        call("harmonic_segment", empty, amplitude, ratio, drawn.between(-3.0, 3.0))
    for side in (1, -1):
        slender = drawn.sides(1, nonlinear=True, alike=0.0)[0]
        call("jump_share", slender, side, drawn.between(0.0, 0.9))
    for kind in ("harmonic", "pulse"):
        ending = Drawn.by_name(f"ends under {kind}")
        shaken = ending.segments(kind, nonlinear=False)
        call("run_end", shaken, ending.sides(1, nonlinear=False)[0], ending.between(1.0, 99.0))


def record_motions(call: Recorder) -> None:
    """Record tables of pulses of every form, and of samples."""
    for form in (CLOSED, RICKER, RICKER_ANTISYMMETRIC, MAVROEIDIS_PAPAGEORGIOU):
        drawn = Drawn.by_name(f"pulse of form {form}")
        pieces = drawn.rng.uniform(0.5, 2.0, (2 if form == CLOSED else 0, PIECE_COLUMNS))
        reach, gamma, peak = drawn.between(3.0, 5.0), drawn.between(1.2, 3.0), 0.9
        pulse = PulseNumbers(form, pieces, *drawn.shaking(), 3e-2, reach, gamma, 0.4, peak)
        count, _ = call.quietly("fill_pulse", pulse, np.zeros((0, SEGMENT_COLUMNS)))
        call("fill_pulse", pulse, np.zeros((count, SEGMENT_COLUMNS)))
    drawn = Drawn.by_name("samples and bounds")
    samples = drawn.rng.normal(size=12)
    call("fill_lines", samples, drawn.between(0.01, 0.1), np.zeros((12, SEGMENT_COLUMNS)))
    call("fill_bounds", drawn.segments("impulses", nonlinear=False))
    call("ricker_at", True, drawn.between(2.0, 3.0))


def _history(call: Recorder, drawn: Drawn, segments: Any, limit: int) -> tuple[Any, int, Any]:
    """Record a march with its rows, and its replay; return sides, status and rows."""
    sides = drawn.sides(1, nonlinear=segments.shape[1] > SEGMENT_COLUMNS)[0]
    half, phase = call.quietly("segment_start", segments, 0)
    moving = drawn.chance(0.7)
    velocity = drawn.between(-0.3, 0.3) if moving else 0.0
    angle = math.copysign(drawn.between(0.0, 0.4), velocity) if drawn.chance(0.5) else 0.0
    side = int(math.copysign(1.0, velocity)) if moving or angle != 0.0 else 0
    start = March(side, angle, velocity, 0, half, phase, 0, 0)
    stop = (half + 40, phase) if len(segments) == 1 else (0, drawn.between(5.0, 40.0))
    slow = drawn.over(1e-4, 1.0)
    return sides, *_marched(call, (segments, sides, start, *stop, slow, limit), drawn)


def _fall(call: Recorder, *, nonlinear: bool) -> None:
    """Record marches that end in overturning, and what is read off their last flight."""
    for attempt in range(2):
        drawn = Drawn.by_name(f"falls, {nonlinear}, {attempt}")
        sides = drawn.sides(1, nonlinear=nonlinear, alike=attempt)[0]
        segments = drawn.segments("harmonic", nonlinear=nonlinear)
        while True:
            segments[0, AMPLITUDE] = segments[0, CEILING] = drawn.between(3.0, 9.0)
            segments[0, FREQUENCY] = drawn.over(1.5, 6.0)
            half, phase = call.quietly("segment_start", segments, 0)
            start = March(1, 0.0, drawn.between(0.01, 0.3), 0, half, phase, 0, 0)
            given = (segments, sides, start, half + 60, phase, math.inf, LIMIT)
            status, end = call.quietly("march", *given, np.zeros((0, ROW_COLUMNS)), np.zeros(0))
            if status == OVERTURNED and end.impacts > 3:
                break
        _, rows = _marched(call, given, drawn)
        call("last_crossing", segments, sides, rows, drawn.between(0.2, 0.8) if attempt else 1.0)
        call("peaks_until_overturning", segments, sides, rows)
        _facts(call, segments, sides, rows, OVERTURNED)


def _facts(call: Recorder, segments: Any, sides: Any, rows: Any, status: int) -> None:
    """Record what a march amounts to."""
    starts = np.zeros(len(rows))
    call("run_facts", segments, sides, rows, status, starts)
    call("largest_forces", segments, sides, rows, 1.0, CENTRES, np.zeros(FORCES))
    landings = np.zeros((LANDING_ROWS, len(rows)))
    call("fill_landings", segments, sides, rows, starts, landings)


def _marched(call: Recorder, given: tuple[Any, ...], drawn: Drawn) -> tuple[int, Any]:
    """Record a march that keeps its rows, states at some times and peaks; return them."""
    segments, sides = given[:2]
    status, end = call.quietly("march", *given, np.zeros((0, ROW_COLUMNS)), np.zeros(0))
    rows = np.zeros((end.flights, ROW_COLUMNS))
    call("march", *given, rows, np.zeros(PEAK_COLUMNS))
    index = np.sort(drawn.rng.integers(0, len(rows), 12))
    span = np.minimum(rows[index, ROW_DURATION], 1.0)
    states = np.zeros((3, 12))
    call("fill_states", segments, sides, rows, index, span * drawn.rng.random(12), states)
    last = min(float(rows[-1, ROW_DURATION]), 0.7)
    call("recorded_peaks", segments, sides, rows, last)
    return status, rows
