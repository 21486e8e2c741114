"""Nonlinear trajectories side by side: the fates of the march, whichever lanes they share."""

import math
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import Block
from rocksteady.kernels.batch.harmonic import fates_of_sides
from rocksteady.kernels.core import tuples
from rocksteady.kernels.core.tables import (
    ALPHA,
    AT_REST,
    LEAN,
    LEFT_OUT,
    NONLINEAR_SIDE_COLUMNS,
    OVERTURNED,
    RATE,
    RESTITUTION,
    ROCKING,
    UNDECIDED,
)
from rocksteady.kernels.core.tuples import Fates, Starts
from rocksteady.kernels.nonlinear_lanes.loop import nonlinear_lane_fates
from rocksteady.model.equations import Nonlinear
from tests.dynamics.full_integrator import impacts_by_integrator
from tests.strategies import PLAIN, sample_size

# Lanes that are idle compute as well, whatever comes of it, and selects leave it out.
pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning")

Floats = NDArray[np.float64]

TOLERANCE = 1e-10
MOST = 20_000


class Cells(NamedTuple):
    amplitude: Floats
    frequency: Floats
    sides: Floats
    angle: Floats
    velocity: Floats
    phase: Floats

    @property
    def shaken(self) -> tuples.Cells:
        return tuples.Cells(*self[:3])

    @property
    def starts(self) -> Starts:
        return Starts(*self[3:])

    def at(self, index: object) -> "Cells":
        return Cells(*(np.ascontiguousarray(part[index]) for part in self))  # type: ignore[call-overload]


def empty(count: int) -> Fates:
    return Fates(np.zeros(count, np.int64), np.zeros(count, np.int64), np.zeros((count, 3)))


def by_lanes(cells: Cells, cycles: int, leaping: bool = True, most: int = MOST) -> Fates:
    found = empty(len(cells.amplitude))
    nonlinear_lane_fates(cells.shaken, cells.starts, cycles, leaping, most, found)
    return found


def one_by_one(cells: Cells, cycles: int) -> Fates:
    found = empty(len(cells.amplitude))
    fates_of_sides(cells.shaken, cells.starts, cycles, MOST, found)
    return found


def cells_of(
    amplitude: Floats,
    frequency: Floats,
    restitution: Floats | float,
    alpha: Floats | float,
    angle: Floats | float = 0.0,
    velocity: Floats | float = 0.0,
    phase: Floats | float = 0.0,
) -> Cells:
    count = len(amplitude)
    sides = np.ones((count, 2, NONLINEAR_SIDE_COLUMNS))
    sides[:, :, RESTITUTION] = np.broadcast_to(restitution, count)[:, np.newaxis]
    sides[:, :, ALPHA] = np.broadcast_to(alpha, count)[:, np.newaxis]
    sides[:, :, LEFT_OUT] = 1e-5 * TOLERANCE
    state = (np.broadcast_to(part, count).astype(float) for part in (angle, velocity, phase))
    return Cells(amplitude.astype(float), frequency.astype(float), sides, *state)


def with_unlike_sides(cells: Cells, rng: np.random.Generator, share: float) -> Cells:
    """Return the cells with another negative side in some of them."""
    sides = cells.sides.copy()
    count = len(sides)
    factor = np.exp(rng.uniform(-0.7, 0.7, (3, count)))
    factor[:, rng.random(count) < 0.3] **= 1e-3  # nearly alike
    factor[:, rng.random(count) >= share] = 1.0
    sides[:, 1, ALPHA] = np.minimum(sides[:, 0, ALPHA] * factor[0], 1.5)
    sides[:, 1, LEAN] = sides[:, 1, ALPHA] / sides[:, 0, ALPHA]
    sides[:, 1, RATE] = factor[1]
    sides[:, 1, RESTITUTION] **= factor[2]
    return cells._replace(sides=sides)


def random_cells(rng: np.random.Generator, count: int) -> Cells:
    """Return blocks of every kind: slender and stocky, above, at, below uplift, slow and fast.

    The sides of half of them differ.
    """

    def some(share: float) -> NDArray[np.bool_]:
        return rng.random(count) < share

    def spread(low: float, high: float) -> Floats:
        return np.asarray(np.exp(rng.uniform(math.log(low), math.log(high), count)))

    alpha = spread(0.001, 1.5)
    uplift = np.tan(alpha) / alpha
    amplitude = rng.uniform(0.0, np.where(some(0.7), 8.0, 20.0))
    amplitude = np.where(some(0.1), uplift * rng.uniform(0.9, 1.1, count), amplitude)
    amplitude[some(0.01)] = 0.0
    frequency = np.where(some(0.5), rng.uniform(0.3, 12.0, count), spread(0.05, 100.0))
    restitution = rng.uniform(0.0, np.where(some(0.9), 0.97, 1.0))
    restitution[some(0.02)] = 1.0
    restitution[some(0.02)] = 1e-300  # 0 would be that of a wall
    angle = np.where(some(0.4), rng.normal(0.0, 0.4, count), 0.0)
    velocity = rng.normal(0.0, 0.6, count) * np.where(some(0.3), spread(1e-6, 1.0), 1.0)
    velocity[some(0.15)] = 0.0
    # Where next to nothing is lost at an impact, slow bounces would go on for ever.
    lossless = restitution > 0.97
    frequency[lossless] = np.maximum(frequency[lossless], 0.5)
    angle[lossless], velocity[lossless] = 0.0, 0.3
    phase = rng.uniform(-10.0, 10.0, count)
    cells = cells_of(amplitude, frequency, restitution, alpha, angle, velocity, phase)
    return with_unlike_sides(cells, rng, 0.5)


def unit(side: int, velocity: float = 0.3, alpha: float = 0.2) -> Cells:
    """Return the grid of work unit B1, of blocks with a slenderness."""
    frequency, amplitude = np.meshgrid(np.linspace(1.0, 12.0, side), np.linspace(1.0, 6.0, side))
    return cells_of(amplitude.ravel(), frequency.ravel(), 0.8, alpha, velocity=velocity)


def decided_by_the_tolerance(cell: Cells, cycles: int) -> bool:
    """Return whether the march changes its verdict with the amplitude by the tolerance."""
    moved = cell.at(np.zeros(41, np.int64))
    moved.amplitude[:] *= 1.0 + TOLERANCE * np.linspace(-1.0, 1.0, 41)
    return len(set(one_by_one(moved, cycles).status.tolist())) > 1


def check_random_runs(seed: int, count: int, cycles: int, leaping: bool) -> None:
    """Hold runs against the march.

    Fates may differ only where the tolerance decides; impacts only of chaotic motions, whose last
    digits grow, and of chatter.
    """
    cells = random_cells(np.random.default_rng(seed), count)
    lanes, plain = by_lanes(cells, cycles, leaping), one_by_one(cells, cycles)
    other = np.flatnonzero(lanes.status != plain.status)
    assert len(other) <= max(1.0, 1e-3 * count)
    for i in other:
        assert decided_by_the_tolerance(cells.at([i]), cycles), cells.at([i])
    same = (lanes.status == plain.status) & (plain.status != UNDECIDED)
    assert np.count_nonzero(same & (lanes.impacts != plain.impacts)) <= 0.01 * count
    apart = np.abs(lanes.final - plain.final)
    apart[:, 2] = np.minimum(apart[:, 2], np.abs(np.pi - apart[:, 2]))
    largest = np.max(apart / (1.0 + np.abs(plain.final)), axis=1)[same]
    assert np.quantile(largest, 0.5) < 1e-14
    assert np.quantile(largest, sample_size(0.9, 0.8)) < 1e-10
    assert set(plain.status.tolist()) >= sample_size({ROCKING, OVERTURNED}, {ROCKING})


@pytest.mark.parametrize(("cycles", "leaping"), [(3, False), (30, True)])
def test_runs_end_as_those_of_the_march(cycles: int, leaping: bool) -> None:
    check_random_runs(cycles, sample_size(3000, 12), sample_size(cycles, 2), leaping)


@pytest.mark.slow
@pytest.mark.skipif(PLAIN, reason="so many runs need compiled code")
def test_two_hundred_thousand_runs_end_as_those_of_the_march() -> None:
    for seed in range(100, 120):
        check_random_runs(seed, 10_000, 3, leaping=False)


@pytest.mark.skipif(PLAIN, reason="a hundred thousand impacts need compiled code")
@pytest.mark.parametrize("alpha", [0.2, 0.6])
def test_leaps_lead_to_the_fates_of_the_long_way(alpha: float) -> None:
    cells = unit(16, alpha=alpha)
    leapt, long, plain = by_lanes(cells, 200), by_lanes(cells, 200, False), one_by_one(cells, 200)
    np.testing.assert_array_equal(long.status, plain.status)
    np.testing.assert_array_equal(leapt.status, plain.status)
    assert np.count_nonzero(long.impacts != plain.impacts) <= 3
    assert np.count_nonzero(leapt.impacts != plain.impacts) <= 3
    assert np.quantile(np.abs(long.final - plain.final), 0.9) < 1e-11
    assert np.quantile(np.abs(leapt.final - plain.final), 0.8) < 1e-9


@pytest.mark.skipif(PLAIN, reason="a hundred thousand impacts need compiled code")
def test_leaps_of_unlike_sides_lead_to_the_fates_of_the_long_way() -> None:
    cells = unit(16)
    cells.sides[:, 1] = [0.75, 1.25, 1.1, 0.25, 1e-5 * TOLERANCE]
    leapt, long, plain = by_lanes(cells, 200), by_lanes(cells, 200, False), one_by_one(cells, 200)
    np.testing.assert_array_equal(leapt.status, long.status)
    np.testing.assert_array_equal(leapt.status, plain.status)
    assert np.count_nonzero(leapt.impacts != long.impacts) <= 3
    assert np.quantile(np.abs(leapt.final - long.final), 0.8) < 1e-9
    assert np.quantile(np.abs(leapt.final - plain.final), 0.8) < 1e-9


@pytest.mark.skipif(PLAIN, reason="thousands of bounces need compiled code")
@pytest.mark.parametrize("share", [1.0, 0.9, 0.5])
def test_a_motion_returns_on_its_own_side(share: float) -> None:
    """Sides that differ in restitution alone lift off alike, but bounce in numbers of their own."""
    amplitude, frequency = np.meshgrid(np.linspace(1.03, 1.2, 12), np.linspace(0.5, 3.0, 12))
    cells = cells_of(amplitude.ravel(), frequency.ravel(), 0.6, 0.2)
    cells.sides[:, 1, RESTITUTION] *= share
    leapt, long = by_lanes(cells, 51), by_lanes(cells, 51, False)
    np.testing.assert_array_equal(leapt.status, long.status)
    np.testing.assert_array_equal(leapt.impacts, long.impacts)
    assert np.max(np.abs(leapt.final - long.final)) < 1e-9
    assert np.count_nonzero(long.impacts > 100) > 50


def test_a_mirrored_block_meets_the_same_fate() -> None:
    """Under shaking that is half a period ahead, from a mirrored start."""
    count = sample_size(2000, 12)
    cells = random_cells(np.random.default_rng(5), count)
    mirrored = Cells(
        cells.amplitude,
        cells.frequency,
        np.ascontiguousarray(cells.sides[:, ::-1]),
        -cells.angle,
        -cells.velocity,
        cells.phase + math.pi,
    )
    one, other = by_lanes(cells, 3), by_lanes(mirrored, 3)
    assert np.count_nonzero(one.status != other.status) <= 1e-3 * count
    same = (one.status == other.status) & (one.status != UNDECIDED)
    assert np.count_nonzero(same & (one.impacts != other.impacts)) <= 0.01 * count
    apart = np.abs(one.final[same, :2] + other.final[same, :2])
    assert np.quantile(apart, 0.5) < 1e-13
    assert np.count_nonzero(one.final[same, 0]) > count // 4


@pytest.mark.skipif(PLAIN, reason="takes minutes uncompiled")
@pytest.mark.parametrize(
    "block",
    [
        Block.from_p(alpha=0.3, p=1.0, restitution=0.8),
        Block.asymmetric(left=0.2, right=0.35, height=1.2, restitution=(0.85, 0.7)),
    ],
)
def test_as_many_impacts_as_a_general_solver_finds(block: Block) -> None:
    cycles = 8
    amplitude, frequency = np.array([1.5, 3.0, 4.5]), np.array([3.0, 6.0, 9.0])
    cells = cells_of(amplitude, frequency, 0.0, 0.0, velocity=0.3)
    cells.sides[:] = Nonlinear(tolerance=TOLERANCE).sides(block)
    lanes = by_lanes(cells, cycles)
    assert (lanes.status == ROCKING).all()
    for i in range(3):

        def shaking(t: float, a: float = amplitude[i], w: float = frequency[i]) -> float:
            return block.alpha * a * math.sin(w * block.p * t)

        times = impacts_by_integrator(
            shaking,
            block=block,
            angle=0.0,
            velocity=0.3 * block.alpha * block.p,
            breaks=[0.0, 2.0 * math.pi * cycles / (frequency[i] * block.p)],
            longest_step=math.inf,
            count=10**9,
        )
        assert lanes.impacts[i] == len(times)


def test_neighbours_change_nothing() -> None:
    cycles = sample_size(40, 2)
    rng = np.random.default_rng(2)
    cells = random_cells(rng, sample_size(400, 6))
    whole = by_lanes(cells, cycles)
    count = len(cells.amplitude)
    for picked in (rng.permutation(count), np.arange(3), np.array([count - 1])):
        for one, other in zip(by_lanes(cells.at(picked), cycles), whole, strict=True):
            np.testing.assert_array_equal(one, other[picked])
    parts = [np.arange(k, count, 3) for k in range(3)]
    with ThreadPoolExecutor(3) as pool:
        found = list(pool.map(lambda part: by_lanes(cells.at(part), cycles), parts))
    for part, fates in zip(parts, found, strict=True):
        for one, other in zip(fates, whole, strict=True):
            np.testing.assert_array_equal(one, other[part])


def test_no_cells_at_all() -> None:
    by_lanes(unit(1).at(slice(0, 0)), 10)


def test_every_fate_occurs() -> None:
    one = np.ones(1)
    calm = cells_of(0.5 * one, 3.0 * one, 0.8, 0.2, velocity=0.3)
    rocking = cells_of(2.0 * one, 6.0 * one, 0.8, 0.2, velocity=0.3)
    falling = cells_of(6.0 * one, 1.0 * one, 0.8, 0.2, velocity=0.3)
    lying = cells_of(0.0 * one, 1.0 * one, 0.8, 0.2, angle=9.0)
    lifting = cells_of(1.5 * one, 2.0 * one, 0.5, 0.2)
    expected = (AT_REST, ROCKING, OVERTURNED, OVERTURNED, one_by_one(lifting, 10).status[0])
    for cells, fate in zip((calm, rocking, falling, lying, lifting), expected, strict=True):
        assert by_lanes(cells, 10).status[0] == fate


@pytest.mark.skipif(PLAIN, reason="thousands of bounces need compiled code")
@pytest.mark.parametrize("leaping", [False, True])
def test_bounces_without_end_are_given_up(leaping: bool) -> None:
    """Whatever runs beside them, and with the same number of impacts."""
    one, most = np.ones(1), 300
    endless = cells_of(0.5 * one, 0.01 * one, 1.0, 0.2, velocity=1e-3)
    others = unit(6)
    together = Cells(*(np.concatenate(parts) for parts in zip(others, endless, strict=True)))
    for cells in (endless, together):
        found = by_lanes(cells, 50, leaping, most)
        assert found.status[-1] == UNDECIDED
        assert found.impacts[-1] == most
        assert np.isnan(found.final[-1]).all()


def test_after_an_impact_without_rebound_the_side_lifts_that_the_base_lifts() -> None:
    """It is not always the one that the block would have bounced to."""
    count = sample_size(4000, 24)
    rng = np.random.default_rng(7)
    amplitude, frequency = rng.uniform(1.2, 6.0, count), rng.uniform(0.5, 8.0, count)
    alpha = np.exp(rng.uniform(-6.0, -1.0, count))
    phase = rng.uniform(0.0, 6.0, count)
    cells = cells_of(amplitude, frequency, 1e-300, alpha, rng.normal(0.0, 0.4, count), phase=phase)
    cells = with_unlike_sides(cells, rng, 0.5)
    lanes, plain = by_lanes(cells, 2), one_by_one(cells, 2)
    assert np.count_nonzero(lanes.status != plain.status) <= 1
    assert np.count_nonzero(lanes.impacts != plain.impacts) <= 4
    assert np.count_nonzero(plain.impacts > 1) > count // 3


@pytest.mark.slow
@pytest.mark.skipif(PLAIN, reason="many bounces need compiled code")
@pytest.mark.parametrize("over", [1.0 - 1e-9, 1.0 + 1e-7, 1.001, 1.1])
@pytest.mark.parametrize("frequency", [0.05, 4.0, 100.0, 1e7])
@pytest.mark.parametrize("restitution", [1e-300, 0.5, 0.9])
def test_chatter_beside_uplift(over: float, frequency: float, restitution: float) -> None:
    alpha, velocity = np.array([0.01, 0.3, 1.2]), np.array([0.0, 1e-3, -0.1])
    alpha, velocity = (part.ravel() for part in np.meshgrid(alpha, velocity))
    amplitude = over * np.tan(alpha) / alpha
    cells = cells_of(
        amplitude, np.full(9, frequency), restitution, alpha, velocity=velocity, phase=0.4
    )
    lanes, plain = by_lanes(cells, 5, most=10**6), one_by_one(cells, 5)
    np.testing.assert_array_equal(lanes.status, plain.status)
    assert (lanes.status != UNDECIDED).all()
