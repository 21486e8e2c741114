"""Motions that have become periodic: leapt over, and nothing else is."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from rocksteady.kernels.core.tables import (
    LEAN,
    OVERTURNED,
    RESTITUTION,
    ROCKING,
    SIDE_COLUMNS,
    UNDECIDED,
)
from rocksteady.kernels.core.tuples import Cells, Starts
from rocksteady.kernels.lanes.driver import lane_fates
from rocksteady.kernels.orbits.closed_form import half_cycle_jacobian, symmetric_orbit
from tests.every import every
from tests.kernels.fates import NO_LIMIT, empty, fates_in_lanes, harmonic_fates
from tests.kernels.walls import against_wall
from tests.strategies import PLAIN

pytestmark = pytest.mark.skipif(PLAIN, reason="many cycles need compiled code")

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


def b1() -> Floats:
    """Return columns of amplitude, frequency ratio, restitution, angle, velocity, phase."""
    frequency, amplitude = np.meshgrid(np.linspace(1.0, 12.0, 100), np.linspace(1.0, 6.0, 100))
    return filled(amplitude, frequency, 0.8, 0.3, 0.0)


def b2() -> Floats:
    columns = b1()
    columns[4] = 0.0
    return columns


def b3(amplitude: float, frequency: float, restitution: float) -> Floats:
    """Return a window of starts: phase over one cycle, velocity up to 2."""
    phase, velocity = np.meshgrid(
        np.linspace(0.0, 2.0 * np.pi, 200, endpoint=False), np.linspace(0.0, 2.0, 200)
    )
    return filled(amplitude, frequency, restitution, velocity, phase)


def filled(
    amplitude: ArrayLike,
    frequency: ArrayLike,
    restitution: ArrayLike,
    velocity: ArrayLike,
    phase: ArrayLike,
) -> Floats:
    given = (amplitude, frequency, restitution, 0.0, velocity, phase)
    columns = np.broadcast_arrays(*(np.asarray(column, dtype=np.float64) for column in given))
    return np.array([column.ravel() for column in columns])


def run(columns: Floats, cycles: int, leaping: bool) -> tuple[Integers, Integers, Floats]:
    found = empty(columns.shape[1])
    fates_in_lanes(columns, cycles, leaping, found)
    return found


@every(
    "columns",
    [b1, b2, lambda: b3(2.0, 6.0, 0.8), lambda: b3(5.0, 12.0, 0.9), lambda: b3(3.0, 8.0, 0.95)],
)
def test_the_same_fate_in_every_cell_as_a_full_run(columns: Callable[[], Floats]) -> None:
    cells = columns()
    full, leapt = run(cells, 200, False), run(cells, 200, True)
    assert np.array_equal(full[0], leapt[0])
    assert np.array_equal(full[1], leapt[1])
    # Motions that settle late have not leapt; a chaotic one has not either.
    assert np.abs(full[2] - leapt[2]).max() < 1e-9


def test_an_odd_number_of_periods_later_the_mirror_image() -> None:
    cells = filled(2.0, 4.0, 0.8, 0.3, 0.0)
    for cycles in (1000, 1001, 123_457):
        full, leapt = run(cells, cycles, False), run(cells, cycles, True)
        assert full[0] == leapt[0] == ROCKING
        assert full[1] == leapt[1] == pytest.approx(2 * cycles, abs=30)
        assert leapt[2] == pytest.approx(full[2], abs=1e-10)


def test_a_million_cycles_cost_as_much_as_a_thousand() -> None:
    cells = filled(2.0, 4.0, 0.8, 0.3, 0.0)
    _, impacts, _ = run(cells, 10**12, True)
    assert impacts[0] == pytest.approx(2 * 10**12, abs=30)


@every("aside", [0.0, 1e-5, 1e-3])
def test_an_unstable_orbit_is_no_end(aside: float) -> None:
    """A motion that starts on one, or beside it along its stable direction, must leave it."""
    checked = 0
    for amplitude in np.linspace(1.0, 3.0, 21):
        for branch in (0, 1):
            orbit = symmetric_orbit(amplitude, 4.0, 0.8, 1, branch)
            speed = 4.0 * orbit.velocity
            if not (math.isfinite(speed) and speed > 0.0):
                continue
            jacobian = half_cycle_jacobian(amplitude, 4.0, 0.8, 1, orbit)
            roots, directions = np.linalg.eig(np.reshape(jacobian, (2, 2)))
            stable = np.real(directions[:, np.argmin(np.abs(roots))])
            start_phase = (orbit.phase + aside * stable[0]) % (2.0 * math.pi)
            cells = filled(amplitude, 4.0, 0.8, speed + aside * stable[1], start_phase)
            if run(cells, 3, False)[0] != ROCKING:
                continue
            start, after = run(cells, 3, False), run(cells, 2000, False)
            leaves = after[0] == OVERTURNED or np.abs(start[2] - after[2]).max() > 1e-3
            if not leaves:
                continue
            checked += 1
            leapt = run(cells, 2000, True)
            stayed = leapt[0] == ROCKING and np.abs(start[2] - leapt[2]).max() < 1e-3
            assert not stayed, (amplitude, branch)
    assert checked >= 5


def test_a_motion_is_leapt_long_before_it_repeats() -> None:
    """Limits on the impacts that are flown tell when: a motion beyond them is given up."""
    orbit = symmetric_orbit(2.0, 4.0, 0.8, 1, 1)
    largest = np.abs(np.roots([1.0, -orbit.trace, 0.8**2])).max()
    impacts_per_digit = -math.log(10.0) / math.log(largest)
    cells = filled(2.0, 4.0, 0.8, 0.3, 0.0)
    for most, ending in ((9 * impacts_per_digit, ROCKING), (4 * impacts_per_digit, UNDECIDED)):
        found = empty(1)
        fates_in_lanes(cells, 10**6, True, found, int(most))
        assert found[0][0] == ending


def test_periods_with_rests_and_doubled_periods_are_leapt_over() -> None:
    """Limits on the impacts that are flown tell: without a leap every motion would be given up."""
    wall, other_wall = against_wall(0.6), against_wall(0.6, free=-1)
    rests, chaotic_for_long = np.ones((2, 2, SIDE_COLUMNS))
    rests[:, RESTITUTION], rests[1, LEAN] = 0.3, 0.9
    chaotic_for_long[:, RESTITUTION], chaotic_for_long[:, LEAN] = 0.9, (1.2, 0.8)
    rows = [
        (wall, 1.5428571, 7.5),  # rests in every sixth cycle, chatters near the node in others
        (wall, 1.5, 6.5),  # ... in every third
        (other_wall, 1.5, 6.5),
        (rests, 1.5, 3.0),  # on either side in every cycle
        (wall, 1.2857143, 6.0),  # a period of eight cycles, doubled several times
        (wall, 1.4571429, 8.0),  # one of four cycles and 36 impacts
        (chaotic_for_long, 1.329, 5.0),
    ]
    sides = np.array([row[0] for row in rows])
    amplitude, frequency = np.array([row[1:] for row in rows]).T.copy()
    still = np.zeros(len(rows))
    velocity = 0.3 * np.where(sides[:, 0, RESTITUTION] == 1.0, -1.0, 1.0)
    cells, starts = Cells(amplitude, frequency, sides), Starts(still, velocity, still)
    full, leapt = empty(len(rows)), empty(len(rows))
    lane_fates(cells, starts, 6_000, False, NO_LIMIT, full)
    lane_fates(cells, starts, 6_000, True, 5_000, leapt)
    assert np.all(full.impacts > 5_000)
    assert np.array_equal(full.status, leapt.status)
    assert np.array_equal(full.impacts, leapt.impacts)
    assert np.abs(full.final - leapt.final).max() < 1e-9


def test_a_conservative_block_never_leaps() -> None:
    rng = np.random.default_rng(3)
    cells = filled(
        rng.uniform(0.2, 1.5, 200),
        rng.uniform(2.0, 8.0, 200),
        1.0,
        rng.uniform(0.1, 0.6, 200),
        rng.uniform(0.0, 6.0, 200),
    )
    full, leapt = run(cells, 300, False), run(cells, 300, True)
    for one, other in zip(full, leapt, strict=True):
        assert np.array_equal(one, other)


def test_the_march_agrees_on_the_basins() -> None:
    for shaking in ((2.0, 6.0, 0.8), (5.0, 12.0, 0.9), (3.0, 8.0, 0.95)):
        cells = np.ascontiguousarray(b3(*shaking)[:, ::7])
        status, impacts, _ = run(cells, 100, True)
        count = cells.shape[1]
        plain = np.zeros(count, np.int64), np.zeros(count, np.int64), np.zeros((count, 3))
        amplitude, frequency, restitution, angle, velocity, phase = cells
        harmonic_fates(amplitude, frequency, restitution, angle, velocity, phase, 100, *plain)
        assert np.array_equal(status, plain[0])
        # Chatter comes to rest sooner or later.
        assert np.mean(impacts != plain[1]) < 1e-3
