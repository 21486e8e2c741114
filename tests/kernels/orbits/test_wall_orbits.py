"""Orbits of a block against a wall: its return map, its simplest orbits in closed form, chains.

With T = 2 pi n/Omega, h = tanh(T/2), D = (1 - e)/(1 + e) and beta = A/(1 + Omega^2) a flight that
begins and lands at the same phase f, and leaves with e times the speed with which it lands, has::

    Omega cos f + D h sin f = D h/beta
    v = 2 e/(1 + e) h (1 - beta sin f)
    trace = ((1 + e)^2 + (1 - e)^2 cosh T)/2
            - Omega^2 (1 + e)^2 (1 + cosh T)/2 beta sin f/(1 - beta sin f)

and the determinant e^2 (docs/theory/one-sided.md).
"""

import math
from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.batch.attractors import (
    HIGHEST,
    LOWEST,
    ORBIT_PHASE,
    ORBIT_SIDE,
    ORBIT_SPEED,
    OUTCOME,
    PASSAGES,
    PERIODS,
    REAL_COLUMNS,
    RESTS,
    SYMMETRIC,
    WHOLE_COLUMNS,
    settle_cells,
)
from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.tables import ALPHA, March
from rocksteady.kernels.core.tuples import Cells, Kept, Outcomes, States, Tables, Until
from rocksteady.kernels.march.march import march
from rocksteady.kernels.orbits import chains
from rocksteady.kernels.orbits.periodic import (
    LANDING,
    ORBIT_COLUMNS,
    OTHER_PEAK,
    PEAK,
    Fixed,
    Orbits,
    Sought,
    distance,
    fill_peaks,
    is_symmetric,
    loss,
    multipliers,
    polish,
    search,
    state_at,
)
from rocksteady.kernels.orbits.return_map import (
    FALL,
    IMPACT,
    STAY,
    UPLIFT,
    AnyState,
    Section,
    highest_after,
    next_passage,
)
from rocksteady.kernels.orbits.settle import MEMORY, PERIODIC, STAYS, Settled, settle
from rocksteady.kernels.orbits.systems import System, like_sides, make_system
from tests.every import every
from tests.kernels.passages import state_at_phase
from tests.kernels.tables import NONE, harmonic
from tests.kernels.walls import against_wall, in_model
from tests.oracles import ExactFlight, mp
from tests.strategies import sample_size

Floats = NDArray[np.float64]
TWO_PI = 2.0 * math.pi


class Simple(NamedTuple):
    """An orbit with one impact in n forcing periods, in closed form."""

    phase: float
    speed: float
    trace: float


def simple_orbit(amplitude: float, frequency: float, e: float, n: int, branch: int) -> Simple:
    damping, length = (1.0 - e) / (1.0 + e), TWO_PI * n / frequency
    h, beta = math.tanh(0.5 * length), amplitude / (1.0 + frequency**2)
    middle = math.atan2(damping * h, frequency)
    apart = math.acos(damping * h / (beta * math.hypot(frequency, damping * h)))
    phase = middle + (apart if branch == 1 else -apart)
    swing = beta * math.sin(phase)
    cosh = math.cosh(length)
    trace = 0.5 * ((1.0 + e) ** 2 + (1.0 - e) ** 2 * cosh)
    trace -= 0.5 * (frequency * (1.0 + e)) ** 2 * (1.0 + cosh) * swing / (1.0 - swing)
    return Simple(phase % TWO_PI, 2.0 * e / (1.0 + e) * h * (1.0 - swing), trace)


def one_sided(amplitude: float, frequency: float, e: float, alpha: float = 0.0) -> System:
    _, sides = in_model(harmonic(amplitude, frequency), against_wall(e), alpha)
    return make_system(amplitude, frequency, sides)


def landed_exactly(
    amplitude: float, frequency: float, e: float, near: float, phase: mp.mpf, speed: mp.mpf
) -> NDArray[np.object_]:
    """Return phase and speed after the impact near a time, in many digits."""
    flight = ExactFlight(-1, 0, amplitude, frequency, 0, mp.mpf(speed), phase)
    time = flight.zero_near(near)
    return np.array([phase + mp.mpf(frequency) * time, -mp.mpf(e) * flight.state(time)[1]])


def landed(system: System, state: Section, phase: float, speed: float) -> Floats:
    """Return phase and speed after the passage from a state that is moved by so much."""
    moved = Section(state.side, 0, state.phase + phase, state.speed + speed)
    after = next_passage(system, moved, -1.0).state
    return np.array([math.pi * after.half_cycles + after.phase, after.speed])


def settled_from(
    system: System, phase: float, velocity: float, periods: int = 2000
) -> tuple[Settled, Floats]:
    half, rest = clock(phase)
    memory, table = (np.zeros((MEMORY, ORBIT_COLUMNS)) for _ in range(2))
    side = 0 if velocity == 0.0 else system.free
    found = settle(system, AnyState(side, half, rest, 0.0, velocity), periods, memory, table)
    return found, table[: found.passages]


# amplitude, frequency, restitution and n of stable orbits
STABLE = [
    (1.3, 6.398, 0.49, 1),
    (0.328, 3.583, 0.993, 1),
    (0.644, 6.456, 0.754, 1),
    (1.208, 6.777, 0.636, 2),
    (0.355, 6.552, 0.89, 2),
    (2.867, 7.371, 0.385, 3),
]
UNSTABLE = [(*case, 2) for case in STABLE[:4]] + [(2.0, 4.0, 0.8, 1, 1), (3.0, 5.0, 0.6, 2, 1)]


# ------------------------------------------------------------------------------ the return map


@pytest.mark.parametrize("free", [1, -1])
def test_a_passage_is_an_impact_of_the_march_bit_for_bit(free: int) -> None:
    rng, checked = np.random.default_rng(free + 5), 0
    while checked < sample_size(400, 40):
        amplitude, frequency = 10.0 ** rng.uniform(-0.5, 1.0), 10.0 ** rng.uniform(-0.5, 1.2)
        sides = against_wall(rng.uniform(0.1, 1.0), free=free)
        start = state_at_phase(free, rng.uniform(0.0, TWO_PI), rng.uniform(0.02, 0.8))
        step = next_passage(make_system(amplitude, frequency, sides), start, -1.0)
        if step.kind != IMPACT:
            continue
        begin = March(free, 0.0, free * start.speed, 0, start.half_cycles, start.phase, 0, 0)
        segments, rows = harmonic(amplitude, frequency), np.zeros((1, 8))
        _, end = march(Tables(segments, sides), begin, Until(2**60, 0.0, 0.0, 1), Kept(rows, NONE))
        assert step.state.side == end.side == free
        assert (step.state.half_cycles, step.state.phase) == (end.half_cycles, end.phase)
        assert step.state.speed == free * end.velocity
        checked += 1


def test_its_derivative_is_that_of_differences_in_many_digits() -> None:
    rng, checked = np.random.default_rng(1), 0
    step = mp.mpf(10) ** -30
    while checked < sample_size(60, 20):
        amplitude, frequency, e = rng.uniform((0.3, 0.5, 0.1), (4.0, 8.0, 1.0)).tolist()
        phase, speed = rng.uniform((0.0, 0.1), (TWO_PI, 0.8)).tolist()
        state = state_at_phase(1, phase, speed)
        passage = next_passage(one_sided(amplitude, frequency, e), state, -1.0)
        if passage.kind != IMPACT or passage.landing < 0.05 or passage.time > 8.0:
            continue
        first = state.half_cycles * mp.pi + mp.mpf(state.phase)
        shaken = (amplitude, frequency, e, passage.time)
        columns = []
        for more, faster in ((step, 0), (0, step)):
            after = landed_exactly(*shaken, first + more, speed + faster)
            before = landed_exactly(*shaken, first - more, speed - faster)
            columns.append((after - before) / (2 * step))
        truth = np.column_stack(columns).astype(np.float64)
        got = np.array(passage.jacobian).reshape(2, 2)
        blur = 1e-12 * math.exp(passage.time) * (1.0 + frequency) * (1.0 + amplitude)
        np.testing.assert_allclose(got, truth, rtol=1e-9, atol=blur / passage.landing**2)
        determinant = e * e * speed / passage.state.speed
        size = abs(truth[0, 0] * truth[1, 1]) + abs(truth[0, 1] * truth[1, 0])
        assert truth[0, 0] * truth[1, 1] - truth[0, 1] * truth[1, 0] == pytest.approx(
            determinant, abs=1e-12 * size
        )
        checked += 1


@pytest.mark.parametrize("alpha", [0.0, 0.3])
def test_it_is_that_of_differences_of_the_map_and_its_mirror_image(alpha: float) -> None:
    rng, checked = np.random.default_rng(2), 0
    while checked < sample_size(40, 6):
        amplitude, frequency, e = rng.uniform((0.3, 2.0, 0.2), (2.0, 9.0, 1.0)).tolist()
        lean, rate = rng.uniform(0.8, 1.3, 2).tolist()
        systems = [
            make_system(
                amplitude,
                frequency,
                in_model(NONE[:0, np.newaxis] * np.ones(9), sides, alpha)[1],
            )
            for sides in (
                against_wall(e, lean, rate),
                against_wall(e, lean, rate, free=-1),
            )
        ]
        state = Section(1, 0, float(rng.uniform(0.0, math.pi)), float(rng.uniform(0.1, 0.4)))
        image = Section(-1, 1, state.phase, state.speed)
        here, there = (
            next_passage(system, begin, -1.0)
            for system, begin in zip(systems, (state, image), strict=True)
        )
        assert there.kind == here.kind
        if here.kind in (FALL, STAY):
            continue
        assert there.state == Section(
            -1, here.state.half_cycles + 1, here.state.phase, here.state.speed
        )
        assert here.state.side == 1
        assert (there.time, there.landing, there.jacobian) == (
            here.time,
            here.landing,
            here.jacobian,
        )
        assert highest_after(systems[0], state, here) == highest_after(systems[1], image, there)
        assert highest_after(systems[0], state, here)[1] == 0.0
        if here.kind != IMPACT or here.landing < 0.05:
            continue
        checked += 1
        h, system = 1e-6, systems[0]
        near = np.column_stack(
            [
                landed(system, state, h, 0.0) - landed(system, state, -h, 0.0),
                landed(system, state, 0.0, h) - landed(system, state, 0.0, -h),
            ]
        ) / (2.0 * h)
        jacobian = np.array(here.jacobian).reshape(2, 2)
        np.testing.assert_allclose(near, jacobian, atol=1e-5 * np.abs(jacobian).max() ** 2)


def test_an_orbit_without_rest_has_the_determinant_of_its_impacts_on_one_side() -> None:
    for sides in (against_wall(0.6), against_wall(0.6, free=-1)):
        system = make_system(1.0, 3.0, sides)
        assert not like_sides(system)
        for passages in (1, 2, 5):
            expected = 0.36**passages
            assert loss(system, system.free, passages, 0) == pytest.approx(expected, rel=1e-14)
            assert loss(system, system.free, passages, 1) == 0.0
    assert loss(make_system(1.0, 3.0, against_wall(0.0)), 1, 1, 0) == 0.0


# ------------------------------------------------------------------------------ closed forms


@every(("amplitude", "frequency", "e", "n", "branch"), [(*case, 1) for case in STABLE] + UNSTABLE)
@every("free", [1, -1])
def test_newtons_method_finds_the_simplest_orbits_with_their_multipliers(
    amplitude: float, frequency: float, e: float, n: int, branch: int, free: int
) -> None:
    orbit = simple_orbit(amplitude, frequency, e, n, branch)
    system = make_system(amplitude, frequency, against_wall(e, free=free))
    turned = 0.0 if free > 0 else math.pi
    near = state_at_phase(free, orbit.phase + 1e-4 + turned, orbit.speed * 1.0003)
    table = np.zeros((1, ORBIT_COLUMNS))
    fixed = polish(system, near, 1, n, table)
    assert fixed.found
    assert (fixed.rests, fixed.grazes) == (0, 0)
    truth = state_at_phase(free, orbit.phase + turned, orbit.speed)
    assert distance(state_at(table, 0), truth) < 1e-11
    assert table[0, LANDING] == pytest.approx(orbit.speed / e, rel=1e-11)
    found = multipliers(fixed.jacobian, loss(system, free, 1, 0))
    expected = sorted(np.roots([1.0, -orbit.trace, e * e]), key=abs, reverse=True)
    assert abs(found[0] + found[1] - orbit.trace) <= 1e-9 * (1.0 + abs(orbit.trace))
    assert abs(found[0]) == pytest.approx(abs(expected[0]), rel=1e-6)
    assert found[0] * found[1] == pytest.approx(e * e, rel=1e-12)
    assert not is_symmetric(system, table, 1, n)
    fill_peaks(system, 1, table)
    assert table[0, PEAK] > 0.0
    assert table[0, OTHER_PEAK] == 0.0


@every(("frequency", "e", "n"), [case[1:] for case in STABLE])
def test_they_meet_in_a_fold_and_the_stable_one_doubles_its_period(
    frequency: float, e: float, n: int
) -> None:
    damping, length = (1.0 - e) / (1.0 + e), TWO_PI * n / frequency
    lost, square = damping * math.tanh(0.5 * length), 1.0 + frequency**2
    fold = square * lost / math.hypot(frequency, lost)
    for above in (1e-6, 1e-3, 0.2):
        one, other = (simple_orbit(fold * (1.0 + above), frequency, e, n, k) for k in (1, 2))
        assert one.trace < 1.0 + e * e < other.trace
    # Just below it Newton's method finds nothing where just above it finds both.
    for amplitude, there in ((fold * 1.001, True), (fold * 0.999, False)):
        system, table = one_sided(amplitude, frequency, e), np.zeros((1, ORBIT_COLUMNS))
        for branch in (1, 2):
            orbit = simple_orbit(fold * 1.001, frequency, e, n, branch)
            state = state_at_phase(1, orbit.phase, orbit.speed)
            if abs(next_passage(system, state, -1.0).time - length) < 0.1 * length:
                found = polish(system, state, 1, n, table)
                assert bool(found.found) is there
    # Where the trace is -(1 + e^2) by the formula, the kernel's derivative has the multiplier -1.
    shaken = (frequency * (1.0 + e)) ** 2 * (1.0 + math.cosh(length))
    ratio = (1.0 + e) ** 2 + (1.0 - e) ** 2 * math.cosh(length) + 2.0 * (1.0 + e * e)
    swing = ratio / shaken / (1.0 + ratio / shaken)
    further = (swing * (frequency**2 + lost**2) / lost - lost) / frequency
    amplitude = fold * math.hypot(1.0, further)
    orbit = simple_orbit(amplitude, frequency, e, n, 1)
    table = np.zeros((1, ORBIT_COLUMNS))
    state = state_at_phase(1, orbit.phase, orbit.speed)
    step = next_passage(one_sided(amplitude, frequency, e), state, -1.0)
    if abs(step.time - length) > 1e-6:
        pytest.skip("the wall is in its way before")
    fixed = polish(one_sided(amplitude, frequency, e), state, 1, n, table)
    numbers = multipliers(fixed.jacobian, e * e)
    assert numbers[0] == pytest.approx(-1.0, abs=1e-7)
    assert numbers[1] == pytest.approx(-e * e, abs=1e-7)


@every(("amplitude", "frequency", "e", "n"), STABLE)
def test_near_a_stable_one_a_motion_settles_to_it(
    amplitude: float, frequency: float, e: float, n: int
) -> None:
    orbit = simple_orbit(amplitude, frequency, e, n, 1)
    largest = np.abs(np.roots([1.0, -orbit.trace, e * e])).max()
    assert largest < 1.0
    system = one_sided(amplitude, frequency, e)
    found, table = settled_from(system, orbit.phase + 1e-4, orbit.speed * 1.0002, 6000)
    assert (found.outcome, found.passages, found.periods, found.rests) == (PERIODIC, 1, n, 0)
    assert found.residual <= 1e-12
    truth = state_at_phase(1, orbit.phase, orbit.speed)
    assert distance(state_at(table, 0), truth) < 1e-10
    assert found.lyapunov == pytest.approx(math.log(largest) / n, rel=1e-6)


@every(("amplitude", "frequency", "e", "n", "branch"), UNSTABLE)
def test_to_an_unstable_one_no_motion_settles(
    amplitude: float, frequency: float, e: float, n: int, branch: int
) -> None:
    orbit = simple_orbit(amplitude, frequency, e, n, branch)
    assert np.abs(np.roots([1.0, -orbit.trace, e * e])).max() > 1.0
    found, table = settled_from(
        one_sided(amplitude, frequency, e), orbit.phase, orbit.speed, sample_size(1000, 200)
    )
    truth = state_at_phase(1, orbit.phase, orbit.speed)
    for row in range(len(table) if found.outcome == PERIODIC else 0):
        assert distance(state_at(table, row), truth) > 1e-3


@pytest.mark.parametrize("free", [1, -1])
def test_a_search_finds_both_of_them_once(free: int) -> None:
    amplitude, frequency, e = 1.3, 6.398, 0.49
    system = make_system(amplitude, frequency, against_wall(e, free=free))
    count = sample_size(16, 7)
    phases, speeds = np.linspace(0.0, 6.0, count), np.linspace(0.02, 0.4, count)
    found, shape = np.zeros((40, 2)), np.zeros((40, 2), dtype=np.int64)
    table = np.zeros((3, ORBIT_COLUMNS))
    most = search(system, Sought(phases, speeds, 3, 1, False), table, Orbits(found, shape), 0)
    states = [state_at_phase(free, *row) for row in found[:most].tolist()]
    for branch in (1, 2):
        orbit = simple_orbit(amplitude, frequency, e, 1, branch)
        turned = 0.0 if free > 0 else math.pi
        truth = state_at_phase(free, orbit.phase + turned, orbit.speed)
        near = [k for k, state in enumerate(states) if distance(truth, state) < 1e-9]
        assert len(near) == 1
        assert tuple(shape[near[0]]) == (1, 1)
    for k, (passages, periods) in enumerate(shape[:most].tolist()):
        fixed: Fixed = polish(system, states[k], passages, periods, table)
        assert fixed.found


# ----------------------------------------------------------------------------- rest and loss


@pytest.mark.parametrize("alpha", [0.0, 0.3])
def test_off_a_wall_that_does_not_throw_it_back_every_period_is_the_same(alpha: float) -> None:
    amplitude, frequency = 1.6, 5.0
    system = one_sided(amplitude, frequency, 0.0, alpha)
    found, table = settled_from(system, 3.0, 0.1)
    # An impact after which it stays, and the uplift: two passages.
    assert (found.outcome, found.passages, found.periods, found.rests) == (PERIODIC, 2, 1, 1)
    assert found.lyapunov == -math.inf
    lifted = next(k for k in range(2) if table[k, LANDING] > 0.0)
    state = state_at(table, lifted)
    uplift = math.tan(alpha) / alpha if alpha else 1.0
    assert (state.side, state.half_cycles % 2, state.speed) == (1, 0, 0.0)
    assert state.phase == pytest.approx(math.asin(uplift / amplitude), rel=1e-15)
    step = next_passage(system, state, -1.0)
    assert (step.kind, step.state.speed) == (IMPACT, 0.0)
    assert next_passage(system, step.state, -1.0).kind == UPLIFT
    if alpha:
        return
    # The flight from the node in many digits: its first zero after the start.
    start = mp.asin(1 / mp.mpf(amplitude))
    flight = ExactFlight(-1, 0, mp.mpf(amplitude), mp.mpf(frequency), 0, 0, start)
    time = flight.zero_near(step.time)
    assert abs(time - step.time) < 1e-13
    assert step.landing == pytest.approx(float(-flight.state(time)[1]), rel=1e-12)
    grid = (time * k / 4000 for k in range(1, 4000))
    assert all(flight.state(at)[0] > 0 for at in grid)


def test_a_base_that_pushes_into_the_wall_alone_never_lifts_it() -> None:
    found, _ = settled_from(one_sided(0.99, 3.0, 0.5), 0.3, 0.05)
    assert found.outcome == STAYS


@pytest.mark.parametrize("alpha", [0.0, 0.3])
def test_cells_settle_as_each_does_alone_and_to_mirror_images(alpha: float) -> None:
    count = sample_size(60, 8)
    rng = np.random.default_rng(4)
    a, w = rng.uniform(0.6, 3.0, count), rng.uniform(1.5, 8.0, count)
    phase, speed = rng.uniform(0.0, math.pi, count), rng.uniform(0.0, 0.4, count)
    speed[::5] = 0.0
    ratios = rng.uniform(0.0, 1.0, count)
    ratios[::7] = 0.0
    cycles, outcomes = sample_size(300, 25), []
    for free in (1, -1):
        flat = [against_wall(float(e), free=free) for e in ratios]
        sides = np.array([in_model(harmonic(1.0, 1.0), one, alpha)[1] for one in flat])
        side = np.where(speed > 0.0, free, 0).astype(np.int64)
        half = np.full(count, 0 if free > 0 else 1, dtype=np.int64)
        whole, real = np.empty((count, WHOLE_COLUMNS), np.int64), np.empty((count, REAL_COLUMNS))
        settle_cells(
            Cells(a, w, sides),
            States(side, np.zeros(count), free * speed, half, phase),
            cycles,
            Outcomes(whole, real),
        )
        outcomes.append((whole, real, sides))
    (whole, real, sides), (mirrored, image, _) = outcomes
    periodic = whole[:, OUTCOME] == PERIODIC
    assert periodic.sum() > count // 6
    same = [OUTCOME, PASSAGES, PERIODS, RESTS]
    np.testing.assert_array_equal(whole[:, same], mirrored[:, same])
    assert np.all(whole[:, SYMMETRIC] == 0)
    assert np.all(mirrored[:, SYMMETRIC] == 0)
    assert np.all(whole[periodic, ORBIT_SIDE] == 1)
    assert np.all(mirrored[periodic, ORBIT_SIDE] == -1)
    np.testing.assert_array_equal(real[:, ORBIT_SPEED], image[:, ORBIT_SPEED])
    assert np.all(real[periodic, LOWEST] == 0.0)
    assert np.all(real[periodic, HIGHEST] > 0.0)
    np.testing.assert_array_equal(real[:, HIGHEST], -image[:, LOWEST])
    for k in np.flatnonzero(periodic)[: sample_size(12, 3)].tolist():
        system = make_system(float(a[k]), float(w[k]), sides[k])
        alone, table = settled_from(system, float(phase[k]), float(speed[k]), cycles)
        assert (alone.passages, alone.periods) == (whole[k, PASSAGES], whole[k, PERIODS])
        state = state_at_phase(1, float(real[k, ORBIT_PHASE]), float(real[k, ORBIT_SPEED]))
        assert distance(state_at(table, 0), state) < 1e-12
    assert sides.shape[2] == (5 if alpha else 3)
    assert not alpha or np.all(sides[:, :, ALPHA] == alpha)


# ------------------------------------------------------------------------------------- chains


@every(("amplitude", "frequency", "e", "n", "branch"), [(*case, 1) for case in STABLE] + UNSTABLE)
@every("free", [1, -1])
def test_the_simplest_orbit_is_a_chain_of_one_arc_in_whole_periods(
    amplitude: float, frequency: float, e: float, n: int, branch: int, free: int
) -> None:
    orbit = simple_orbit(amplitude, frequency, e, n, branch)
    half, rest = clock(orbit.phase + (0.0 if free > 0 else math.pi))
    turns, phases = np.array([half], dtype=np.int64), np.array([rest])

    def filled(moved: float = 0.0, sharper: float = 0.0) -> Floats:
        table = np.empty((1, chains.CHAIN_COLUMNS))
        sides = against_wall(e + sharper, free=free)
        chains.fill_chain(amplitude, frequency, sides, turns, phases + moved, 2 * n, table)
        return table

    table = filled()
    assert abs(table[0, chains.ERROR]) < 1e-12
    assert table[0, chains.START] == pytest.approx(orbit.speed, rel=1e-10)
    assert table[0, chains.DURATION] == pytest.approx(TWO_PI * n / frequency, rel=1e-14)
    h = 1e-6
    by_phase = (filled(h) - filled(-h))[0, chains.ERROR] / (2.0 * h)
    matrix = np.empty((1, 1))
    chains.fill_matrix(table, 1.0, matrix)
    assert matrix[0, 0] == pytest.approx(by_phase, rel=1e-6, abs=1e-7)
    by_restitution = (filled(0.0, h) - filled(0.0, -h))[0, chains.ERROR] / (2.0 * h)
    assert table[0, chains.BY_RESTITUTION] == pytest.approx(by_restitution, rel=1e-6)
    over = np.array(chains.turned_over(table)).reshape(2, 2)
    size = 1e-8 * (1.0 + np.abs(over).max() ** 2)
    assert np.trace(over) == pytest.approx(orbit.trace, abs=size)
    assert np.linalg.det(over) == pytest.approx(e * e, abs=size)
    shape = np.empty((1, 3))
    system = make_system(amplitude, frequency, against_wall(e, free=free))
    chains.fill_arcs(system, turns, phases, table, shape)
    step = next_passage(system, state_at_phase(free, float(half * math.pi + rest), orbit.speed), -1)
    highest, _ = highest_after(
        system, state_at_phase(free, float(half * math.pi + rest), orbit.speed), step
    )
    assert shape[0, 0] == pytest.approx(highest, rel=1e-9)
