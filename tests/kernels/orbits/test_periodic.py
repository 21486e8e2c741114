"""Periodic orbits of the return map: closed forms, differences, eigenvalues, the map itself."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from rocksteady.kernels.orbits.closed_form import half_cycle_shape, symmetric_orbit
from rocksteady.kernels.orbits.periodic import (
    CLOSED,
    LANDING,
    ORBIT_COLUMNS,
    PEAK,
    PHASE_ERROR,
    SPEED,
    TIME,
    Fixed,
    Orbits,
    Sought,
    closed_after,
    distance,
    fill_peaks,
    is_symmetric,
    loss,
    measured,
    mirror,
    moved,
    multipliers,
    polish,
    primitive,
    put,
    search,
    state_at,
)
from rocksteady.kernels.orbits.return_map import (
    FALL,
    IMPACT,
    UPLIFT,
    AnyState,
    Jacobian,
    Section,
    first_passage,
    next_passage,
    phase_between,
    shifted,
)
from rocksteady.kernels.orbits.systems import System, make_system
from tests.every import every
from tests.kernels.passages import LOPSIDED, even_system, state_at_phase
from tests.kernels.tables import both_sides
from tests.strategies import sample_size

Floats = NDArray[np.float64]
TWO_PI = 2.0 * math.pi


def room(passages: int) -> Floats:
    return np.zeros((passages, ORBIT_COLUMNS))


def closed_form(
    amplitude: float, frequency: float, restitution: float, order: int = 1, branch: int = 1
) -> tuple[Section, float]:
    """Return the first state of a symmetric orbit and the trace of its half cycle."""
    orbit = symmetric_orbit(amplitude, frequency, restitution, order, branch)
    return state_at_phase(1, orbit.phase, frequency * orbit.velocity), orbit.trace


def closes(system: System, table: Floats, passages: int, periods: int) -> None:
    """Check with the map alone, from each state, that a table holds an orbit."""
    for k in range(passages):
        state = state_at(table, k)
        step = next_passage(system, state, -1.0)
        assert distance(step.state, state_at(table, (k + 1) % passages)) < 1e-11
        assert step.time == pytest.approx(table[k, TIME], rel=1e-9)
        assert step.landing == pytest.approx(table[k, LANDING], rel=1e-9, abs=1e-12)
    spans = [
        phase_between(state_at(table, k), next_passage(system, state_at(table, k), -1.0).state)
        for k in range(passages)
    ]
    assert math.fsum(spans) == pytest.approx(TWO_PI * periods, abs=1e-10)


def monodromy(system: System, state: Section, passages: int, step: float = 1e-6) -> Floats:
    """Return the derivative of several passages by central differences."""
    columns = []
    for df, dv in ((step, 0.0), (0.0, step)):
        ends = []
        for sign in (1.0, -1.0):
            here = shifted(state, sign * df, sign * dv)
            for _ in range(passages):
                here = next_passage(system, here, -1.0).state
            ends.append(here)
        more, less = ends
        columns.append(
            [phase_between(less, more) / (2.0 * step), (more.speed - less.speed) / (2.0 * step)]
        )
    return np.array(columns).T


# ------------------------------------------------------------------------------------- polish


def test_symmetric_orbits_are_found_again_from_nearby_with_their_multipliers() -> None:
    rng = np.random.default_rng(1)
    checked = 0
    while checked < sample_size(400, 15):
        frequency, restitution = rng.uniform(1.0, 15.0), rng.uniform(0.2, 0.999)
        order, branch = int(rng.choice([1, 1, 3])), int(rng.choice([1, 2]))
        d, h = (1 - restitution) / (1 + restitution), math.tanh(order * math.pi / 2 / frequency)
        least = (1 + frequency**2) * d * h * h / math.hypot(1.0, d * h * frequency)
        amplitude = max(least, 0.1) * rng.uniform(1.05, 4.0)
        if amplitude < least:
            continue
        orbit = symmetric_orbit(amplitude, frequency, restitution, order, branch)
        _, _, admissible = half_cycle_shape(amplitude, frequency, restitution, order, orbit)
        if not admissible or abs(orbit.trace) > 50.0 or frequency * orbit.velocity < 0.01:
            continue
        checked += 1
        first, trace = closed_form(amplitude, frequency, restitution, order, branch)
        system, table = even_system(amplitude, frequency, restitution), room(2)
        # So near that the flights on the way have the shape of the orbit's.
        nudge = 1e-7 * rng.choice([-1.0, 1.0], 2)
        near = shifted(first, nudge[0], nudge[1] * first.speed)
        fixed = polish(system, near, 2, order, table)
        assert fixed.found, (amplitude, frequency, restitution, order, branch)
        assert fixed.residual <= CLOSED
        ill = 1.0 / abs(1.0 - trace**2 / restitution**2) + 1.0
        assert distance(first, state_at(table, 0)) < 1e-10 * (1.0 + trace**2) * ill
        assert distance(mirror(first, order), state_at(table, 1)) < 1e-10 * (1 + trace**2) * ill
        assert is_symmetric(system, table, 2, order) or ill > 100.0
        assert primitive(table, 2, order) == (2, order)
        closes(system, table, 2, order)
        found = multipliers(fixed.jacobian, loss(system, 1, 2, fixed.rests))
        expected = np.roots([1.0, -trace, restitution**2]) ** 2
        assert sum(found) == pytest.approx(sum(expected), rel=1e-6, abs=1e-8)
        assert found[0] * found[1] == pytest.approx(restitution**4, rel=1e-12)


def settled(system: System, passages: int, seed: int = 0) -> Section:
    """Return a state after a long run from one that stays on its feet."""
    rng = np.random.default_rng(seed)
    while True:
        state = state_at_phase(1, rng.uniform(0.0, TWO_PI), rng.uniform(0.05, 1.2))
        for _ in range(200 * passages):
            step = next_passage(system, state, -1.0)
            if step.kind != IMPACT:
                break
            state = step.state
        else:
            return state if state.side == 1 else next_passage(system, state, -1.0).state


# amplitude, frequency, sides, passages, periods: with orbits that attract
ATTRACTING = [
    (2.0, 4.0, both_sides(0.8), 2, 1),
    (1.7, 1.9, both_sides(0.7), 2, 1),
    (3.0, 8.0, both_sides(0.95), 2, 1),
    (1.2, 6.0, both_sides(*LOPSIDED[0]), 2, 1),
    (1.1, 7.0, both_sides(*LOPSIDED[2]), 2, 1),
    (1.0, 9.0, both_sides(*LOPSIDED[1]), 2, 1),
]


@every(("amplitude", "frequency", "sides", "passages", "periods"), ATTRACTING)
def test_where_a_long_run_settles_there_is_an_orbit_with_the_multipliers_of_its_map(
    amplitude: float, frequency: float, sides: Floats, passages: int, periods: int
) -> None:
    system, table = make_system(amplitude, frequency, sides), room(passages)
    state = settled(system, passages)
    fixed = polish(system, state, passages, periods, table)
    assert fixed.found
    assert distance(state, state_at(table, 0)) < 1e-8
    closes(system, table, passages, periods)
    determinant = loss(system, 1, passages, 0)
    assert determinant == pytest.approx(float(np.prod(sides[:, 0]) ** passages), rel=1e-14)
    numbers = multipliers(fixed.jacobian, determinant)
    eigenvalues = np.linalg.eigvals(monodromy(system, state_at(table, 0), passages))
    assert abs(numbers[0]) < 1.0
    assert sorted(map(abs, numbers)) == pytest.approx(sorted(abs(eigenvalues)), rel=1e-5)
    assert sum(numbers) == pytest.approx(sum(eigenvalues), rel=1e-5)
    # The same multipliers, whatever impact comes first.
    for k in range(1, passages):
        again = room(passages)
        other = polish(system, state_at(table, k), passages, periods, again)
        assert other.found
        start = state_at(again, 0)
        assert loss(system, start.side, passages, 0) == pytest.approx(determinant, rel=1e-14)
        assert multipliers(other.jacobian, determinant) == pytest.approx(numbers, rel=1e-9)


@pytest.mark.parametrize("times", [2, 3])
def test_an_orbit_gone_round_several_times_has_itself_as_primitive(times: int) -> None:
    system, table = even_system(2.0, 4.0, 0.8), room(2 * times)
    first, trace = closed_form(2.0, 4.0, 0.8)
    fixed = polish(system, first, 2 * times, times, table)
    assert fixed.found
    assert primitive(table, 2 * times, times) == (2, 1)
    found = multipliers(fixed.jacobian, loss(system, 1, 2 * times, 0))
    assert sum(found) == pytest.approx(
        sum(np.roots([1.0, -trace, 0.64]) ** (2 * times)).real, abs=1e-12
    )


def test_a_search_that_falls_or_lands_on_the_other_side_finds_nothing() -> None:
    falling = even_system(2.0, 1.5, 0.8)
    assert next_passage(falling, state_at_phase(1, 1.0, 3.0), -1.0).kind == FALL
    assert not polish(falling, state_at_phase(1, 1.0, 3.0), 2, 1, room(2)).found
    # An odd number of impacts leads to the other side.
    first, _ = closed_form(2.0, 4.0, 0.8)
    assert not polish(even_system(2.0, 4.0, 0.8), first, 3, 1, room(3)).found
    # There is no orbit of two impacts with two periods near one of one.
    assert not polish(even_system(2.0, 4.0, 0.8), first, 2, 2, room(2)).found


@pytest.mark.parametrize(
    ("amplitude", "frequency", "restitution"), [(1.01, 2.0, 0.8), (1.05, 1.0, 0.3)]
)
def test_an_orbit_with_rest_is_found_from_each_of_its_states_and_forgets_everything(
    amplitude: float, frequency: float, restitution: float
) -> None:
    system = even_system(amplitude, frequency, restitution)
    start = first_passage(system, AnyState(0, 0, 0.0, 0.0, 0.0)).state
    states = [start]
    while True:
        step = next_passage(system, states[-1], -1.0)
        if phase_between(start, step.state) > TWO_PI - 1e-9:
            break
        states.append(step.state)
    assert step.kind == UPLIFT
    assert distance(start, step.state) < 1e-13
    for state in states:
        table = room(len(states))
        fixed = polish(system, state, len(states), 1, table)
        assert fixed.found
        assert fixed.rests == 2  # one on its way to either side
        assert fixed.grazes == 0
        assert fixed.jacobian == (0.0, 0.0, 0.0, 0.0)
        assert loss(system, state.side, len(states), fixed.rests) == 0.0
        assert multipliers(fixed.jacobian, 0.0) == (0.0, 0.0)
        assert is_symmetric(system, table, len(states), 1)
        assert (table[:, SPEED] == 0.0).sum() == 2
        for k, other in enumerate(states):
            shift = (k - states.index(state)) % len(states)
            assert distance(state_at(table, shift), other) < 1e-9


# --------------------------------------------------------------------------- what it is made of


def test_a_step_too_long_for_any_number_moves_nothing() -> None:
    table = room(1)
    put(table, 0, Section(1, 0, 1.0, 2.0))
    table[0, PHASE_ERROR] = 1e308
    before = table.copy()
    with np.errstate(over="ignore"):
        assert not moved(table, 1, Jacobian(0.0, 0.0, 0.0, 0.0))
    assert np.array_equal(table, before)


@every("away", [1e-13, 5e-13])
def test_an_orbit_is_polished_until_rounding_stops_it(away: float) -> None:
    system = even_system(2.0, 4.0, 0.8)
    state, _ = closed_form(2.0, 4.0, 0.8)
    found = polish(system, shifted(state, away, 0.0), 2, 1, room(2))
    assert found.found
    assert found.residual < 2e-15


def test_what_states_miss_of_an_orbit_is_their_distance_from_where_the_map_leads() -> None:
    system, table = even_system(2.0, 4.0, 0.8), room(2)
    first, _ = closed_form(2.0, 4.0, 0.8)
    put(table, 0, first)
    put(table, 1, mirror(first, 1))
    assert measured(system, 2, 1, table).residual < 1e-14
    put(table, 1, shifted(mirror(first, 1), 1e-5, 0.0))
    fixed = measured(system, 2, 1, table)
    assert not fixed.found
    assert fixed.residual == pytest.approx(1e-5, rel=0.5)
    put(table, 1, shifted(mirror(first, 1), 0.0, 1e-5 * first.speed))
    assert measured(system, 2, 1, table).residual >= 1e-5 * (1.0 - 1e-5)
    # A table whose next state is on the wrong side is no orbit at all.
    put(table, 1, first)
    assert measured(system, 2, 1, table).residual == math.inf


@pytest.mark.parametrize("order", [1, 3])
def test_half_of_a_symmetric_orbit_closes_on_its_mirror_image(order: int) -> None:
    system, table, whole = even_system(2.0, 6.0, 0.8), room(2), room(2)
    first, _ = closed_form(2.0, 6.0, 0.8, order)
    put(table, 0, first)
    half = closed_after(system, 1, order, table)
    assert half.residual < 1e-13
    put(whole, 0, first)
    put(whole, 1, mirror(first, order))
    both = measured(system, 2, order, whole).jacobian
    twice = np.linalg.matrix_power(np.reshape(half.jacobian, (2, 2)), 2)
    assert np.reshape(both, (2, 2)) == pytest.approx(twice, rel=1e-10)
    # A full period later it is the state itself, and one flight does not lead there.
    assert closed_after(system, 1, 2 * order, table).residual == math.inf


@given(
    entries=st.lists(st.floats(-30.0, 30.0), min_size=4, max_size=4),
    lossless=st.booleans(),
)
def test_multipliers_are_the_eigenvalues_the_larger_first(
    entries: list[float], lossless: bool
) -> None:
    a, b, c, d = entries
    if lossless:  # determinant 1
        a = a if abs(a) > 0.1 else 1.0
        d = (1.0 + b * c) / a
    first, second = multipliers(Jacobian(a, b, c, d), a * d - b * c)
    eigenvalues = np.linalg.eigvals(np.array([[a, b], [c, d]]))
    size = 1.0 + np.abs([a, b, c, d]).max()
    assert abs(first) >= abs(second) * (1.0 - 1e-12) - 1e-7 * size
    assert first + second == pytest.approx(a + d, abs=1e-6 * size)
    # Where they nearly meet, the square root halves the digits.
    gap = abs(eigenvalues[0] - eigenvalues[1])
    slack = min(1e-6 * size, 1e-11 * size**2 / max(gap, 1e-300)) + 1e-9 * size
    nearest = np.abs(eigenvalues - first).min()
    assert nearest <= slack


def test_a_determinant_of_0_leaves_one_multiplier() -> None:
    assert multipliers(Jacobian(0.25, 0.0, 0.0, 0.0), 0.0) == (0.25, 0.0)


@every("restitution", [0.3, 0.8, 1.0])
def test_complex_multipliers_have_the_modulus_that_the_impacts_leave(restitution: float) -> None:
    determinant = restitution**4
    first, second = multipliers(Jacobian(0.05, -3.0, 1.0, 0.05), determinant)
    assert first == second.conjugate()
    assert abs(first) == pytest.approx(restitution**2, rel=1e-15)


def test_distance_counts_phase_modulo_a_period_and_speed_relatively() -> None:
    here = Section(1, 0, 0.1, 0.5)
    assert distance(here, Section(-1, 0, 0.1, 0.5)) == math.inf
    assert distance(here, Section(1, 8, 0.1, 0.5)) == 0.0
    assert distance(here, Section(1, -2, 0.1 + 1e-6, 0.5)) == pytest.approx(1e-6, rel=1e-8)
    assert distance(here, Section(1, 1, math.pi - 0.1, 0.5)) == pytest.approx(0.2)
    assert distance(here, Section(1, 1, 0.1, 0.5)) == pytest.approx(math.pi)
    assert distance(here, Section(1, 0, 0.1, 0.5 * 1.01)) == pytest.approx(0.01)
    # Speeds next to nothing are measured against 1e-3.
    rest = Section(1, 0, 0.1, 0.0)
    assert distance(rest, Section(1, 0, 0.1, 1e-8)) == pytest.approx(1e-5)


def test_the_mirror_image_of_a_state_is_its_own_half_a_period_on() -> None:
    state = Section(1, 3, 0.4, 0.2)
    assert mirror(state, 1) == Section(-1, 4, 0.4, 0.2)
    assert distance(mirror(mirror(state, 1), 3), state) == 0.0


def test_peaks_are_those_of_the_closed_form() -> None:
    system, table = even_system(2.0, 4.0, 0.8), room(2)
    first, _ = closed_form(2.0, 4.0, 0.8)
    assert polish(system, first, 2, 1, table).found
    fill_peaks(system, 2, table)
    assert table[:, PEAK] == pytest.approx([0.1854991060] * 2, abs=6e-11)


# ------------------------------------------------------------------------------------- search


def searched(
    system: System, fastest: float, seeds: int, passages: int, periods: int, mirrors: bool = True
) -> tuple[Floats, NDArray[np.int64]]:
    steps = np.arange(seeds, dtype=np.float64)
    found, shape = np.zeros((256, 2)), np.zeros((256, 2), dtype=np.int64)
    count = search(
        system,
        Sought(
            steps * (TWO_PI / seeds), (steps + 0.5) * (fastest / seeds), passages, periods, mirrors
        ),
        room(passages),
        Orbits(found, shape),
        0,
    )
    return found[:count], shape[:count]


def orbit_of(system: System, found: Floats, shape: NDArray[np.int64]) -> tuple[Fixed, Floats]:
    table = room(int(shape[0]))
    state = state_at_phase(1, found[0], found[1])
    return polish(system, state, int(shape[0]), int(shape[1]), table), table


def test_a_search_finds_the_closed_forms_and_no_orbit_twice() -> None:
    system, seeds = even_system(1.0, 2.0, 0.8), sample_size(24, 5)
    found, shape = searched(system, 1.5, seeds, 4, 2)
    tables = []
    for row, size in zip(found, shape, strict=True):
        fixed, table = orbit_of(system, row, size)
        assert fixed.found
        closes(system, table, int(size[0]), int(size[1]))
        assert primitive(table, int(size[0]), int(size[1])) == tuple(size)
        tables.append(table)
    for branch in (1, 2):
        first, _ = closed_form(1.0, 2.0, 0.8, 1, branch)
        hits = [min(distance(state_at(t, k), first) for k in range(len(t))) < 1e-9 for t in tables]
        assert hits.count(True) == 1 or (sample_size(0, 1) and not any(hits))
    for i, one in enumerate(tables):
        for other in tables[:i]:
            for k in range(len(other)):
                there = state_at(other, k)
                assert distance(state_at(one, 0), there) > 1e-6
                assert distance(state_at(one, 0), mirror(there, 1)) > 1e-6


def test_without_mirror_images_a_search_gives_both() -> None:
    # At Omega = 1.9 the symmetric orbit has lost its stability to two, mirror images of each other.
    system, seeds = even_system(2.0, 1.9, 0.8), sample_size(24, 6)
    one, _ = searched(system, 2.0, seeds, 2, 1)
    both, shape = searched(system, 2.0, seeds, 2, 1, mirrors=False)
    assert len(both) == len(one) + (len(one) - 1) == 3
    leaning = [orbit_of(system, row, size)[1] for row, size in zip(both, shape, strict=True)]
    unsymmetric = [table for table in leaning if not is_symmetric(system, table, 2, 1)]
    assert len(unsymmetric) == 2
    assert distance(mirror(state_at(unsymmetric[0], 1), 1), state_at(unsymmetric[1], 0)) < 1e-9


def test_a_search_stops_when_there_is_no_more_room() -> None:
    system = even_system(1.0, 2.0, 0.8)
    found, shape = np.zeros((1, 2)), np.zeros((1, 2), dtype=np.int64)
    phases, speeds = np.linspace(0.0, 6.0, 8), np.linspace(0.1, 1.2, 8)
    assert search(system, Sought(phases, speeds, 2, 1, True), room(2), Orbits(found, shape), 0) == 1


def test_a_lopsided_block_has_orbits_too() -> None:
    sides = both_sides(*LOPSIDED[0])
    system = make_system(1.2, 6.0, sides)
    found, shape = searched(system, 1.2, sample_size(20, 5), 2, 1, mirrors=False)
    assert len(found) >= 1
    for row, size in zip(found, shape, strict=True):
        fixed, table = orbit_of(system, row, size)
        assert fixed.found
        closes(system, table, int(size[0]), int(size[1]))
        numbers = multipliers(fixed.jacobian, loss(system, 1, 2, 0))
        assert numbers[0] * numbers[1] == pytest.approx((0.7 * 0.9) ** 2, rel=1e-12)
