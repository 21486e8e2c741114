"""Trajectories side by side: the fates of the scalar march, whichever lanes they share."""

from concurrent.futures import ThreadPoolExecutor
from typing import Any, cast

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.batch.harmonic import fates_of_sides
from rocksteady.kernels.core.tables import (
    AT_REST,
    LEAN,
    OVERTURNED,
    RATE,
    RESTITUTION,
    ROCKING,
    UNDECIDED,
)
from rocksteady.kernels.core.tuples import Cells, Fates, Starts
from rocksteady.kernels.lanes._both_sides import change_sides
from rocksteady.kernels.lanes._fields import FIELDS, LANES
from rocksteady.kernels.lanes._launching import begin_special_apart, launch
from rocksteady.kernels.lanes._newton import shake
from rocksteady.kernels.lanes.driver import lane_fates
from tests.kernels.fates import NO_LIMIT, empty, fates_in_lanes, harmonic_fates, like_sides
from tests.kernels.walls import against_wall
from tests.oracles import mp
from tests.strategies import PLAIN, sample_size
from tools.aot.dispatch import dispatcher

Floats = NDArray[np.float64]


def by_lanes(columns: Floats, cycles: int, leaping: bool = True) -> Fates:
    """Run cells given as rows of amplitude, frequency, restitution, angle, velocity, phase."""
    found = empty(len(columns))
    fates_in_lanes(columns.T.copy(), cycles, leaping, found)
    return found


def one_by_one(columns: Floats, cycles: int) -> Fates:
    found = empty(len(columns))
    amplitude, frequency, restitution, angle, velocity, phase = columns.T.copy()
    harmonic_fates(amplitude, frequency, restitution, angle, velocity, phase, cycles, *found)
    return found


def random_cells(rng: np.random.Generator, count: int) -> Floats:
    """Return blocks of every kind: above, at, below uplift, slow and fast, at rest and moving."""

    def some(share: float) -> NDArray[np.bool_]:
        return rng.random(count) < share

    columns = np.zeros((count, 6))
    columns[:, 0] = np.where(some(0.8), rng.uniform(0.0, 8.0, count), rng.uniform(0.9, 1.1, count))
    columns[some(0.01), 0] = 1.0
    columns[some(0.01), 0] = 1.0 + 2.0**-52
    columns[some(0.01), 0] = 1.0 + 1e-14
    columns[some(0.01), 0] = 0.0
    columns[:, 1] = np.where(
        some(0.5), rng.uniform(0.3, 12.0, count), 10.0 ** rng.uniform(-2.0, 3.0, count)
    )
    columns[:, 2] = np.where(some(0.95), rng.uniform(0.05, 1.0, count), 1.0)
    columns[some(0.3), 3] = 0.4
    columns[:, 3] *= rng.normal(0.0, 1.0, count)
    columns[:, 4] = rng.normal(0.0, 0.6, count) * np.where(
        some(0.3), 10.0 ** rng.uniform(-6.0, 0.0, count), 1.0
    )
    columns[some(0.15), 4] = 0.0
    columns[:, 5] = rng.uniform(-10.0, 10.0, count)
    # Where next to nothing is lost at an impact, slow bounces would go on for ever.
    lossless = columns[:, 2] > 0.97
    columns[lossless, 1] = np.maximum(columns[lossless, 1], 0.5)
    columns[lossless, 3], columns[lossless, 4] = 0.0, 0.3
    return columns


def unit(side: int, velocity: float = 0.3) -> Floats:
    """Return work unit B1, or B2 with velocity 0, on a grid of side x side."""
    frequency, amplitude = np.meshgrid(np.linspace(1.0, 12.0, side), np.linspace(1.0, 6.0, side))
    columns = np.zeros((side * side, 6))
    columns[:, 0], columns[:, 1] = amplitude.ravel(), frequency.ravel()
    columns[:, 2], columns[:, 4] = 0.8, velocity
    return columns


def apart(one: Fates, other: Fates) -> Floats:
    """Return the largest difference of the final states, phases taken modulo pi."""
    difference = np.abs(one.final - other.final)
    difference[:, 2] = np.minimum(difference[:, 2], np.abs(np.pi - difference[:, 2]))
    largest: Floats = np.max(difference / (1.0 + np.abs(other.final)), axis=1)
    return largest


def check_random_runs(seed: int, count: int) -> None:
    """Hold short runs of symmetric blocks against the march."""
    columns = random_cells(np.random.default_rng(seed), count)
    check_runs(by_lanes(columns, 3), one_by_one(columns, 3), columns[:, 2] == 1.0)


def check_unlike_runs(seed: int, count: int) -> None:
    """Hold short runs of unlike blocks, and of blocks by a wall, against the march."""
    cells, starts = unlike_cells(np.random.default_rng(seed), count)
    lanes, plain = empty(count), empty(count)
    with np.errstate(over="ignore"):  # as plain Python, of a lane whose step is not taken
        lane_fates(cells, starts, 3, True, NO_LIMIT, lanes)
    fates_of_sides(cells, starts, 3, NO_LIMIT, plain)
    check_runs(lanes, plain, (np.abs(cells.sides[:, :, RESTITUTION]) == 1.0).all(axis=1))


def check_runs(lanes: Fates, plain: Fates, lossless: NDArray[np.bool_]) -> None:
    """Hold runs against those of the march.

    Fates may differ only where the march itself is undecided to rounding; the number of impacts
    only where chatter comes to rest, which the lanes see sooner or later than the march.
    """
    count = len(lossless)
    assert np.count_nonzero(lanes.status != plain.status) <= 1e-6 * count
    same = (lanes.status == plain.status) & (lanes.impacts == plain.impacts)
    difference = apart(lanes, plain)
    assert np.quantile(difference[same], sample_size(0.99, 0.9)) < 1e-13
    assert np.count_nonzero(difference[same] > 1e-8) <= max(1.0, 1e-4 * count)
    chattered = ~same & (lanes.status == plain.status)
    assert np.quantile(difference[chattered], 0.9) < 1e-12 if chattered.any() else True
    assert not np.any(chattered & lossless)


def unlike_cells(rng: np.random.Generator, count: int) -> tuple[Cells, Starts]:
    """Return blocks whose sides differ, nearly differ or are alike, and blocks by either wall."""
    columns = random_cells(rng, count)
    sides = like_sides(columns[:, 2])
    factor = np.exp(rng.uniform(-0.7, 0.7, (3, count)))
    factor[:, rng.random(count) < 0.2] **= 1e-3
    factor[:, rng.random(count) < 0.1] = 1.0
    sides[:, 1, LEAN], sides[:, 1, RATE] = factor[:2]
    sides[:, 1, RESTITUTION] **= factor[2]
    angle, velocity = columns[:, 3], columns[:, 4]
    for i in np.flatnonzero(rng.random(count) < 0.4):
        free = 1 if i % 2 else -1
        bounce = 0.0 if rng.random() < 0.2 else float(columns[i, 2])
        sides[i] = against_wall(bounce, *sides[i, 1, [LEAN, RATE]], free=free)
        angle[i], velocity[i] = free * abs(angle[i]), free * abs(velocity[i])
    starts = Starts(angle.copy(), velocity.copy(), columns[:, 5].copy())
    return Cells(columns[:, 0].copy(), columns[:, 1].copy(), sides), starts


def test_short_runs_of_unlike_blocks_end_as_those_of_the_march() -> None:
    check_unlike_runs(2, sample_size(40_000, 60))


@pytest.mark.slow
@pytest.mark.skipif(PLAIN, reason="a million runs need compiled code")
def test_a_million_runs_of_unlike_blocks_end_as_those_of_the_march() -> None:
    for seed in range(20, 30):
        check_unlike_runs(seed, 100_000)


def test_short_runs_end_as_those_of_the_march() -> None:
    check_random_runs(1, sample_size(100_000, 60))


@pytest.mark.slow
@pytest.mark.skipif(PLAIN, reason="a million runs need compiled code")
def test_a_million_short_runs_end_as_those_of_the_march() -> None:
    for seed in range(10, 20):
        check_random_runs(seed, 100_000)


@pytest.mark.skipif(PLAIN, reason="two million impacts need compiled code")
def test_the_survivors_of_work_unit_b1() -> None:
    columns = unit(100)
    lanes, plain = by_lanes(columns, 200, leaping=False), one_by_one(columns, 200)
    assert int((lanes.status != OVERTURNED).sum()) == 6397
    assert np.array_equal(lanes.status, plain.status)
    # The few others end in chatter, which comes to rest sooner or later.
    assert np.count_nonzero(lanes.impacts != plain.impacts) <= 5
    difference = apart(lanes, plain)
    assert np.quantile(difference, 0.5) < 1e-15
    assert np.quantile(difference, 0.99) < 1e-13


@pytest.mark.skipif(PLAIN, reason="a million impacts need compiled code")
def test_fates_from_rest_differ_only_where_rounding_decides() -> None:
    columns = unit(100, velocity=0.0)
    lanes, plain = by_lanes(columns, 200, leaping=False), one_by_one(columns, 200)
    other = np.flatnonzero(lanes.status != plain.status)
    assert other.size <= 5
    # Chaotic: the march itself changes its verdict with the last digits of the amplitude.
    for i in other:
        moved = np.repeat(columns[i : i + 1], 40, axis=0)
        moved[:, 0] *= 1.0 + 1e-15 * np.arange(-20, 20)
        assert len(set(one_by_one(moved, 200).status.tolist())) > 1


def converged(columns: Floats, end: Floats) -> tuple[mpmath.mpf, mpmath.mpf] | None:
    """Return angle and velocity of the steady motion with one impact a half cycle, in 50 digits.

    `end` is the state near which it is at the phase of the start, after whole cycles; None where
    the motion is another one.
    """
    amplitude, frequency, restitution = map(mp.mpf, columns[:3])
    beta = amplitude / (1 + frequency**2)

    def flight(phase: mpmath.mpf, velocity: mpmath.mpf, time: mpmath.mpf) -> list[mpmath.mpf]:
        a = velocity + beta * frequency * mp.cos(phase)
        b = beta * mp.sin(phase) - 1
        turned = phase + frequency * time
        return [
            a * mp.sinh(time) + b * mp.cosh(time) + 1 - beta * mp.sin(turned),
            a * mp.cosh(time) + b * mp.sinh(time) - beta * frequency * mp.cos(turned),
        ]

    def residual(phase: mpmath.mpf, velocity: mpmath.mpf) -> list[mpmath.mpf]:
        angle, speed = flight(phase, velocity, mp.pi / frequency)
        return [angle, speed * restitution + velocity]

    for guess in np.linspace(-1.5, 4.5, 13):
        try:
            phase, velocity = mp.findroot(residual, (guess, 0.3), tol=1e-60)
        except (ValueError, ZeroDivisionError):
            continue
        for side in (0, 1):  # the start's phase is 0, or pi from the other side
            time = ((side * mp.pi - phase) / frequency) % (mp.pi / frequency)
            angle, speed = flight(phase, velocity, time)
            if abs(abs(end[0]) - angle) + abs(abs(end[1]) - abs(speed)) < 1e-6 and velocity > 0:
                return angle, speed
    return None


@pytest.mark.slow
@pytest.mark.skipif(PLAIN, reason="200 cycles of many cells need compiled code")
@pytest.mark.parametrize("leaping", [False, True])
def test_steady_motions_after_200_cycles_against_50_digits(leaping: bool) -> None:
    columns = unit(12)
    lanes = by_lanes(columns, 200, leaping)
    checked = 0
    for cell in np.flatnonzero((lanes.status == ROCKING) & (lanes.impacts >= 395)):
        exact = converged(columns[cell], lanes.final[cell])
        if exact is None:
            continue
        checked += 1
        angle, speed = exact
        assert lanes.final[cell, 2] == 0.0
        off = abs(abs(lanes.final[cell, 0]) - angle) + abs(abs(lanes.final[cell, 1]) - abs(speed))
        # What the last phase of impact is off moves the state at the end as much, and leaps end
        # where the motion repeats to 1e-11.
        assert off < (1e-10 if leaping else 1e-14)
    assert checked >= 25


@pytest.mark.skipif(PLAIN, reason="many bisections need compiled code")
def test_grazing_jumps_come_at_the_same_starting_velocity() -> None:
    """Bisect, by lanes and by the march, to where the number of impacts jumps."""
    rng = np.random.default_rng(7)
    count = 60_000
    columns = random_cells(rng, count)
    columns[:, 0], columns[:, 1] = rng.uniform(1.1, 6.0, count), rng.uniform(1.0, 12.0, count)
    columns[:, 3], columns[:, 4] = 0.0, rng.uniform(0.05, 1.5, count)
    above = columns.copy()
    above[:, 4] *= 1.1
    columns[:, 2] = above[:, 2] = rng.uniform(0.8, 1.0, count)
    # Chatter aside, whose impacts the two do not count alike.
    counts = [run(ends, 1).impacts for ends in (columns, above) for run in (by_lanes, one_by_one)]
    alike = (counts[0] == counts[1]) & (counts[2] == counts[3]) & (np.max(counts, axis=0) < 6)
    jumps = np.flatnonzero(alike & (counts[0] != counts[2]))[:3000]
    assert jumps.size > 1000
    found = []
    for run in (by_lanes, one_by_one):
        low, high = columns[jumps].copy(), above[jumps].copy()
        first = run(low, 1).impacts
        for _ in range(60):
            middle = low.copy()
            middle[:, 4] = 0.5 * (low[:, 4] + high[:, 4])
            same = run(middle, 1).impacts == first
            low[same, 4], high[~same, 4] = middle[same, 4], middle[~same, 4]
        found.append(low[:, 4])
    off = np.abs(found[0] - found[1]) / found[1]
    assert off.max() < 1e-12


def test_neighbours_change_nothing() -> None:
    cycles = sample_size(60, 3)
    rng = np.random.default_rng(2)
    columns = np.vstack([unit(sample_size(20, 4)), random_cells(rng, sample_size(400, 10))])
    columns[:, 2] = np.minimum(columns[:, 2], 0.97)
    whole = by_lanes(columns, cycles)
    order = rng.permutation(len(columns))
    for one, other in zip(by_lanes(columns[order], cycles), whole, strict=True):
        assert np.array_equal(one, other[order])
    for parts in (2, 3):
        with ThreadPoolExecutor(parts) as pool:
            found = list(pool.map(lambda k, n=parts: by_lanes(columns[k::n], cycles), range(parts)))
        for k, part in enumerate(found):
            for one, other in zip(part, whole, strict=True):
                assert np.array_equal(one, other[k::parts])
    alone = by_lanes(columns[:1], cycles)
    assert np.array_equal(alone.final[0], whole.final[0])


def test_unlike_neighbours_change_nothing() -> None:
    """Nor does the place in the lanes: the last cells of a batch are moved to the front."""
    count = sample_size(300, 3)
    cells, starts = unlike_cells(np.random.default_rng(4), count)
    whole = empty(count)
    lane_fates(cells, starts, sample_size(200, 3), True, 10_000, whole)
    for i in range(count):
        one = empty(1)
        row = slice(i, i + 1)
        alone = Cells(*(part[row].copy() for part in cells))
        start = Starts(*(part[row].copy() for part in starts))
        lane_fates(alone, start, sample_size(200, 3), True, 10_000, one)
        for part, parts in zip(one, whole, strict=True):
            assert np.array_equal(part, parts[row])


def test_no_cells_at_all() -> None:
    by_lanes(np.zeros((0, 6)), 10)


@pytest.mark.skipif(PLAIN, reason="many bounces need compiled code")
@pytest.mark.parametrize("leaping", [False, True])
def test_bounces_without_end_are_given_up(leaping: bool) -> None:
    """Whatever runs beside them, and with the same number of impacts."""
    most = 300
    endless = np.array([(0.5, 0.01, 1.0, 0.0, 1e-3, 0.0)])
    others = unit(12)
    together = np.vstack([others, endless, others])
    ends = []
    for columns in (endless, together):
        found = empty(len(columns))
        fates_in_lanes(columns.T.copy(), 200, leaping, found, most)
        ends.append(found)
    for found in (Fates(*(part[len(others)] for part in ends[1])), Fates(*(p[0] for p in ends[0]))):
        assert found.status == UNDECIDED
        assert found.impacts == most
        assert np.isnan(found.final).all()
    # A motion that becomes periodic in time has no limit; one that does not is given up.
    plain = by_lanes(others, 200, leaping)
    same = ends[1].status[: len(others)] == plain.status
    if leaping:
        assert same[plain.impacts < most].all()
        assert same.mean() > 0.95
    else:
        assert np.array_equal(same, plain.impacts <= most)


@pytest.mark.skipif(PLAIN, reason="many small bounces need compiled code")
@pytest.mark.parametrize("amplitude", [0.0, 0.5, 1.0, 1.0000001, 2.0, 6.0])
@pytest.mark.parametrize("frequency", [0.01, 0.3, 4.0, 1000.0])
@pytest.mark.parametrize("restitution", [0.05, 0.8, 1.0])
@pytest.mark.parametrize("velocity", [0.0, 0.3, -0.02])
def test_the_ends_of_the_ranges(
    amplitude: float, frequency: float, restitution: float, velocity: float
) -> None:
    if restitution == 1.0 and (frequency == 0.01 or 1.0 < amplitude < 1.1):
        frequency, amplitude = 0.3, 2.0  # small bounces of which none is lost: too many
    columns = np.array([(amplitude, frequency, restitution, 0.0, velocity, 0.4)])
    lanes, plain = by_lanes(columns, 4), one_by_one(columns, 4)
    assert lanes.status[0] == plain.status[0]
    # Small bounces without loss are chaotic: the march itself does not repeat them when the start
    # moves by its last digit.
    if restitution < 1.0:
        assert apart(lanes, plain)[0] < 1e-9


def test_every_fate_occurs() -> None:
    columns = np.zeros((3, 6))
    columns[:, 0], columns[:, 1], columns[:, 2] = (0.5, 2.0, 6.0), (3.0, 6.0, 1.0), 0.8
    columns[:, 4] = 0.3
    assert by_lanes(columns, 10).status.tolist() == [AT_REST, ROCKING, OVERTURNED]


@pytest.mark.slow
@pytest.mark.skipif(PLAIN, reason="about machine code")
def test_the_loops_become_vector_instructions() -> None:
    for loop in (shake, launch, begin_special_apart, change_sides):
        made = dispatcher(cast(Any, loop))
        made(np.zeros(FIELDS * LANES))
        machine = next(iter(made.inspect_asm().values()))
        assert any(packed in machine for packed in ("mulpd", ".2d")), loop.__name__
        # Nor is there a loop for lanes that do not fill a vector.
        assert not any(single in machine for single in ("mulsd", "fmul\td")), loop.__name__


@pytest.mark.parametrize("velocity", sample_size([1e-40, -1e-300], [-1e-300]))
def test_bounces_that_no_clock_resolves_come_to_rest(velocity: float) -> None:
    # At the peak of shaking that just does not lift, nothing pulls the block down.
    one = np.ones(1)
    cell, found = Cells(one, 4.0 * one, like_sides(0.5 * one)), empty(1)
    starts = Starts(0.0 * one, velocity * one, 0.5 * np.pi * one)
    lane_fates(cell, starts, 30, True, NO_LIMIT, found)
    assert found.status[0] == AT_REST
