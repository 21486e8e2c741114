"""Rocking on floors of buildings against an integrator that shares nothing with the package.

SciPy filters the ground by the building's mode; Runge and Kutta's steps rock all blocks at once.
"""

import itertools
import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import cont2discrete, lfilter

from rocksteady import Block, Record, simulate
from rocksteady.arrays import Floats
from rocksteady.motions import Floor
from tests.model.motions.test_floor import real_suite

G = 9.80665
ZETA, SHAPE = 0.05, 1.3
PERIODS = (0.6, 1.2)
SIZES = ((0.6, 2.0), (0.32, 1.8))
"""Of a statue and a cabinet."""
PARTS = 4
"""Steps in an interval of a record."""
QUIET_S = 8.0
"""Followed beyond the end of a record."""
SLOWEST = 1e-5
"""Rate after an impact below which a block rests [rad/s]."""
FALLEN = 1.4
"""Rotation from which no block comes back [rad]."""
NEAR = 0.1
"""Peaks within this of alpha are too near the edge to be compared, and so are their fates."""


def floor_of(record: Record, period_s: float) -> tuple[Floats, float]:
    """Return the acceleration of the floor at half steps, and the step."""
    step = record.dt_s / PARTS
    ground = np.append(record.acceleration_m_s2, np.zeros(int(QUIET_S / record.dt_s)))
    times = 0.5 * step * np.arange((len(ground) - 1) * 2 * PARTS + 1)
    fine = np.interp(times, record.dt_s * np.arange(len(ground)), ground)
    w = 2.0 * math.pi / period_s
    # x'' over the ground's acceleration: -s^2/(s^2 + 2 zeta w s + w^2)
    mode: Any = ([1.0 - SHAPE, 2.0 * ZETA * w, w * w], [1.0, 2.0 * ZETA * w, w * w])
    above, below, _ = cont2discrete(mode, 0.5 * step, method="foh")
    return lfilter(above.ravel(), below, fine), step


def landing(height: Floats, before: Floats, after: Floats, h: Floats) -> tuple[Floats, Floats]:
    """Return when in a step a rotation reaches 0, and its rate then, by a parabola."""
    slope = (after - before) / h
    below = -before + np.sqrt(np.maximum(before * before - 2.0 * slope * height, 0.0))
    since = np.clip(2.0 * height / np.where(below > 0.0, below, np.inf), 0.0, h)
    return since, before + slope * since


def rocked(floor: Floats, h: Floats, width: Floats, height: Floats) -> tuple[Floats, Floats]:
    """Return the largest rotation over alpha of each block, and its alpha.

    ``4/3 R theta'' = -side g sin(alpha - |theta|) + a cos(alpha - |theta|)`` of a rectangle, and
    Housner's restitution.  `floor` has a row for each half step, a column for each block.
    """
    alpha, radius = np.arctan2(width, height), 0.5 * np.hypot(width, height)
    ratio, uplift = 1.0 - 1.5 * np.sin(alpha) ** 2, G * np.tan(alpha)
    side, angle, turn, peak = np.zeros((4, len(h)))

    def angular(angle: Floats, a: Floats) -> Floats:
        left = alpha - side * angle
        return -0.75 * (side * G * np.sin(left) - a * np.cos(left)) / radius

    for a0, a1, a2 in zip(floor[:-2:2], floor[1:-1:2], floor[2::2], strict=True):
        lifts = (side == 0.0) & (np.abs(a0) > uplift) & (peak < FALLEN)
        side[lifts] = np.sign(a0[lifts])
        k1 = angular(angle, a0)
        k2 = angular(angle + 0.5 * h * turn, a1)
        k3 = angular(angle + 0.5 * h * (turn + 0.5 * h * k1), a1)
        k4 = angular(angle + h * (turn + 0.5 * h * k2), a2)
        rocks = side != 0.0
        later = np.where(rocks, turn + h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4), 0.0)
        moved = np.where(rocks, angle + h * (turn + h / 6.0 * (k1 + k2 + k3)), 0.0)
        hits = side * moved < 0.0
        if hits.any():
            since, speed = landing(side * angle, side * turn, side * later, h)
            side[hits] = -side[hits]
            rest, fresh = h - since, side * ratio * np.abs(speed)
            k = angular(0.0 * fresh, a2)
            later[hits] = (fresh + k * rest)[hits]
            moved[hits] = (fresh * rest + 0.5 * k * rest * rest)[hits]
            still = hits & (np.abs(fresh) < SLOWEST)
            side[still] = moved[still] = later[still] = 0.0
        angle, turn = moved, later
        peak = np.maximum(peak, np.abs(angle))
        fallen = peak > FALLEN
        side[fallen] = angle[fallen] = turn[fallen] = 0.0
    return peak / alpha, alpha


@pytest.mark.slow
def test_blocks_on_floors_fall_as_an_independent_integrator_says() -> None:
    records = sorted(real_suite(), key=lambda each: each.duration_s)[:10]
    floors = {key: floor_of(*key) for key in itertools.product(records, PERIODS)}
    cases = [(*key, *size) for key in floors for size in SIZES]
    rows = np.zeros((max(len(each) for each, _ in floors.values()), len(cases)))
    for column, (record, period, *_) in enumerate(cases):
        moved = floors[record, period][0]
        rows[: len(moved), column] = moved
    steps, width, height = np.array(
        [(floors[record, period][1], *size) for record, period, *size in cases]
    ).T
    peaks, alpha = rocked(rows, steps, width, height)
    fell: NDArray[np.bool_] = peaks * alpha > FALLEN
    compared = 0
    for (record, period, *size), peak, falls in zip(cases, peaks, fell, strict=True):
        floor = Floor(frequencies_hz=1.0 / period, damping=ZETA, shapes=SHAPE)
        block = Block.rectangle(width=size[0], height=size[1])
        run = simulate(block, floor.motion(record))
        if not falls and peak > 1.0 - NEAR:
            continue
        compared += 1
        assert (run.status.label == "overturned") == falls, (record.name, period, size)
        if not falls:
            assert run.peak == pytest.approx(peak, rel=0.05, abs=0.002), (record.name, period, size)
    assert compared >= 36
