"""Closed chains of arcs against orbits of the return map, closed forms and differences."""

import cmath
import math
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.orbits import chains, periodic
from rocksteady.kernels.orbits.closed_form import symmetric_orbit
from rocksteady.kernels.orbits.return_map import Section
from rocksteady.kernels.orbits.systems import System, make_system
from tests.every import every
from tests.kernels.passages import LOPSIDED
from tests.kernels.tables import both_sides
from tests.strategies import sample_size

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]


@dataclass(frozen=True)
class Case:
    """A chain, an orbit or not."""

    amplitude: float
    frequency: float
    sides: Floats
    turns: Whole
    phases: Floats
    half_cycles: int

    @property
    def system(self) -> System:
        return make_system(self.amplitude, self.frequency, self.sides)

    def table(
        self,
        phases: Floats | None = None,
        *,
        more: Floats | None = None,
    ) -> Floats:
        """Return the chain's table, its phases or its parameters moved."""
        at = self.phases if phases is None else phases
        table = np.empty((len(at), chains.CHAIN_COLUMNS))
        moved = np.zeros(3) if more is None else more
        sides = self.sides.copy()
        sides[:, 0] += moved[2]
        chains.fill_chain(
            self.amplitude + moved[0],
            self.frequency + moved[1],
            sides,
            self.turns,
            at,
            self.half_cycles,
            table,
        )
        return table

    def matrix(self, closing: float) -> Floats:
        matrix = np.empty((len(self.phases), len(self.phases)))
        chains.fill_matrix(self.table(), closing, matrix)
        return matrix

    def shape(self) -> Floats:
        shape = np.empty((len(self.phases), 3))
        chains.fill_arcs(self.system, self.turns, self.phases, self.table(), shape)
        return shape


def steady(amplitude: float, frequency: float, restitution: float, order: int, branch: int) -> Case:
    """Return half of a symmetric orbit in closed form, as an odd chain of one arc."""
    phase = symmetric_orbit(amplitude, frequency, restitution, order, branch).phase
    turns = np.zeros(1, dtype=np.int64)
    sides = both_sides(restitution)
    return Case(amplitude, frequency, sides, turns, np.array([phase]), order)


def random_chain(rng: np.random.Generator, impacts: int, *, lopsided: bool = False) -> Case:
    """Return a chain that is no orbit; an even number of arcs in an even number of half cycles."""
    steps = rng.uniform(0.3, 4.0, impacts)
    total = math.fsum(steps.tolist()) / math.pi
    half_cycles = 2 * round(0.5 * (total - impacts % 2)) + impacts % 2
    starts = rng.uniform(0.0, 6.0) + np.cumsum(steps) * (max(half_cycles, 1) / total)
    turns = np.floor(starts / math.pi).astype(np.int64)
    sides = both_sides(rng.uniform(0.2, 1.0))
    if lopsided:
        sides = both_sides(*LOPSIDED[rng.integers(len(LOPSIDED))])
    frequency = 10.0 ** rng.uniform(-0.5, 1.5)
    phases = starts - turns * math.pi
    return Case(rng.uniform(0.2, 5.0), frequency, sides, turns, phases, max(half_cycles, 1))


@dataclass(frozen=True)
class Found:
    """An orbit of the return map, and the same as a chain."""

    case: Case
    fixed: periodic.Fixed
    table: Floats
    loss: float


def orbits_of_the_map(
    count: int, seed: int, *, lopsided: bool = False, most: int = 4
) -> list[Found]:
    """Return orbits that Newton's method finds from random states, of any number of impacts."""
    rng = np.random.default_rng(seed)
    found: list[Found] = []
    while len(found) < count:
        sides = both_sides(rng.uniform(0.3, 0.95))
        if lopsided:
            sides = both_sides(*LOPSIDED[rng.integers(len(LOPSIDED))])
        amplitude, frequency = rng.uniform(0.5, 4.0), rng.uniform(1.0, 6.0)
        system = make_system(amplitude, frequency, sides)
        passages, periods = 2 * int(rng.integers(1, most // 2 + 1)), int(rng.integers(1, 4))
        begin = Section(1, 0, rng.uniform(0.0, math.pi), rng.uniform(0.05, 1.0))
        table = np.zeros((passages, periodic.ORBIT_COLUMNS))
        fixed = periodic.polish(system, begin, passages, periods, table)
        slowest = table[:, periodic.LANDING].min()
        if not fixed.found or fixed.rests or fixed.grazes or slowest < 0.01:
            continue
        turns = table[:, periodic.HALF_CYCLES].astype(np.int64)
        phases = table[:, periodic.PHASE].copy()
        case = Case(amplitude, frequency, sides, turns, phases, 2 * periods)
        found.append(Found(case, fixed, table, periodic.loss(system, 1, passages, 0)))
    return found


# ------------------------------------------------------------------------- orbits of the return map


@pytest.mark.parametrize("lopsided", [False, True])
def test_an_orbit_of_the_return_map_is_a_closed_chain(lopsided: bool) -> None:
    for each in orbits_of_the_map(sample_size(150, 12), 1, lopsided=lopsided):
        table, orbit = each.case.table(), each.table
        steep = np.exp(orbit[:, periodic.TIME]).max() * (1.0 + each.case.amplitude)
        small = 1e-13 * steep
        assert np.abs(table[:, chains.ERROR]).max() <= small
        assert table[:, chains.START] == pytest.approx(orbit[:, periodic.SPEED], abs=small)
        assert table[:, chains.LANDING] == pytest.approx(orbit[:, periodic.LANDING], abs=small)
        assert table[:, chains.DURATION] == pytest.approx(orbit[:, periodic.TIME], abs=small)


@pytest.mark.parametrize("lopsided", [False, True])
def test_it_has_the_multipliers_of_its_saltation(lopsided: bool) -> None:
    # Displaced phases instead of phase and speed: another basis, the same eigenvalues.
    for each in orbits_of_the_map(sample_size(150, 12), 2, lopsided=lopsided):
        over = np.array(chains.turned_over(each.case.table())).reshape(2, 2)
        truth = np.array(each.fixed.jacobian).reshape(2, 2)
        size = np.abs(over).max() + np.abs(truth).max()
        assert np.trace(over) == pytest.approx(np.trace(truth), abs=1e-10 * size)
        assert np.linalg.det(over) == pytest.approx(each.loss, abs=1e-13 * size**2)
        assert np.linalg.det(truth) == pytest.approx(each.loss, abs=1e-13 * size**2)


def test_it_is_singular_where_the_factor_that_closes_it_is_a_multiplier() -> None:
    # det F(z) is (z - mu1)(z - mu2)/z, but for a factor that does not know z.
    for each in orbits_of_the_map(sample_size(100, 10), 3):
        over = chains.turned_over(each.case.table())
        one, other = periodic.multipliers(over, each.loss)
        with_one, with_minus = (np.linalg.det(each.case.matrix(z)) for z in (1.0, -1.0))
        expected = ((1.0 - one) * (1.0 - other)) / ((1.0 + one) * (1.0 + other))
        assert abs(expected.imag) <= 1e-12 * abs(expected)
        assert with_one / with_minus == pytest.approx(-expected.real, rel=1e-6, abs=1e-9)


def test_its_arcs_have_the_peaks_of_its_flights_and_none_dips() -> None:
    for each in orbits_of_the_map(sample_size(100, 10), 4, lopsided=True):
        periodic.fill_peaks(each.case.system, len(each.table), each.table)
        shape = each.case.shape()
        steep = np.exp(each.table[:, periodic.TIME]).max()
        assert shape[:, 0] == pytest.approx(each.table[:, periodic.PEAK], abs=1e-13 * steep)
        assert (shape[:, 1] > 0.0).all()  # inf where there is no minimum
        assert (np.isnan(shape[:, 2]) == np.isinf(shape[:, 1])).all()


# -------------------------------------------------------------------- symmetric orbits, closed form


@every("order", [1, 3, 5])
@every("branch", [1, 2])
def test_half_a_symmetric_orbit_is_an_odd_chain(order: int, branch: int) -> None:
    rng, checked = np.random.default_rng(10 * order + branch), 0
    while checked < sample_size(200, 40):
        restitution, frequency = rng.uniform(0.2, 0.99), 10.0 ** rng.uniform(-0.5, 1.2)
        length = order * math.pi / frequency
        lost = (1.0 - restitution) / (1.0 + restitution) * math.tanh(0.5 * length)
        fold = lost * math.tanh(0.5 * length) * (1.0 + frequency**2)
        fold /= math.hypot(1.0, lost * frequency)  # eq 23
        amplitude = fold * (1.0 + 10.0 ** rng.uniform(-2.0, 0.7))
        case = steady(amplitude, frequency, restitution, order, branch)
        table = case.table()
        checked += 1
        size = 1.0 + amplitude
        assert abs(table[0, chains.ERROR]) <= 1e-13 * size
        assert table[0, chains.DURATION] == pytest.approx(length, rel=1e-14)
        start, landing = table[0, chains.START], table[0, chains.LANDING]
        assert start == pytest.approx(restitution * landing, abs=1e-13 * size)
        if length > 25.0 or abs(landing) < 1e-3:
            continue
        # TW5: trace and determinant of the half-cycle map.
        cosh, sinh = math.cosh(length), math.sinh(length)
        swing = (1.0 - restitution) * amplitude * math.sin(case.phases[0])
        trace = -2.0 * restitution * cosh
        trace += restitution * sinh * ((1.0 + restitution) - swing) / start
        over = np.array(chains.turned_over(table)).reshape(2, 2)
        blur = 1e-12 * size * cosh * (1.0 + abs(over).max()) / abs(start)
        assert np.trace(over) == pytest.approx(trace, abs=blur)
        assert np.linalg.det(over) == pytest.approx(restitution**2, abs=blur * (1.0 + abs(trace)))


@every(
    ("amplitude", "frequency", "order", "trace"),
    [(2.0, 2.0, 1, -1.555331), (2.0, 6.0, 3, 0.011954), (4.0, 6.0, 3, -1.723601)],
)
def test_the_printed_traces(amplitude: float, frequency: float, order: int, trace: float) -> None:
    over = chains.turned_over(steady(amplitude, frequency, 0.8, order, 1).table())
    assert over[0] + over[3] == pytest.approx(trace, abs=1e-6)


def test_it_run_through_twice_is_a_closed_chain_with_the_squares() -> None:
    case = steady(2.0, 2.0, 0.8, 1, 1)
    turns, phases = np.array([0, 1]), np.repeat(case.phases, 2)
    twice = Case(2.0, 2.0, case.sides, turns, phases, 2)
    assert np.abs(twice.table()[:, chains.ERROR]).max() < 1e-14
    half = periodic.multipliers(chains.turned_over(case.table()), 0.8**2)
    whole = periodic.multipliers(chains.turned_over(twice.table()), 0.8**4)
    for one, other in zip(half, whole, strict=True):
        assert cmath.isclose(one * one, other, rel_tol=1e-12) or cmath.isclose(
            one * one, other.conjugate(), rel_tol=1e-12
        )


# ------------------------------------------------------------------------------------ derivatives


@every(
    ("impacts", "lopsided"),
    [(1, False), (2, False), (3, False), (4, False), (7, False), (2, True), (4, True)],
)
def test_the_derivatives_of_any_chain_agree_with_differences(impacts: int, lopsided: bool) -> None:
    rng = np.random.default_rng(impacts)
    step = 1e-6
    for _ in range(sample_size(40, 10)):
        case = random_chain(rng, impacts, lopsided=lopsided)
        table, matrix = case.table(), case.matrix(1.0)
        size = (1.0 + case.amplitude) * (1.0 + case.frequency) * np.abs(matrix).max()
        for column in range(impacts):
            shift = np.zeros(impacts)
            shift[column] = step
            more, less = (case.table(case.phases + sign * shift) for sign in (1.0, -1.0))
            slope = (more[:, chains.ERROR] - less[:, chains.ERROR]) / (2.0 * step)
            assert matrix[:, column] == pytest.approx(slope, abs=1e-8 * size)
        columns = (chains.BY_AMPLITUDE, chains.BY_FREQUENCY, chains.BY_RESTITUTION)
        for index, column in enumerate(columns):
            shift = np.zeros(3)
            shift[index] = step
            more, less = case.table(more=shift), case.table(more=-shift)
            slope = (more[:, chains.ERROR] - less[:, chains.ERROR]) / (2.0 * step)
            assert table[:, column] == pytest.approx(slope, abs=1e-8 * size)


def test_closed_with_minus_one_only_what_crosses_the_seam_is_reversed() -> None:
    rng = np.random.default_rng(5)
    for impacts in (1, 2, 3, 6):
        case = random_chain(rng, impacts)
        table, plus, minus = case.table(), case.matrix(1.0), case.matrix(-1.0)
        seam = np.zeros_like(plus)
        seam[0, -1] += table[0, chains.BY_BEFORE]
        seam[-1, 0] += table[-1, chains.BY_AFTER]
        assert minus == pytest.approx(plus - 2.0 * seam, abs=1e-12 * np.abs(plus).max())


def test_whole_periods_and_where_a_phase_is_split_do_not_count() -> None:
    rng = np.random.default_rng(6)
    for impacts in (1, 2, 5):
        case = random_chain(rng, impacts)
        later = Case(
            case.amplitude,
            case.frequency,
            case.sides,
            case.turns + 6,
            case.phases,
            case.half_cycles,
        )
        assert later.table() == pytest.approx(case.table(), rel=1e-12, abs=1e-12)
        split = Case(
            case.amplitude,
            case.frequency,
            case.sides,
            case.turns - 1,
            case.phases + math.pi,
            case.half_cycles,
        )
        assert split.table() == pytest.approx(case.table(), rel=1e-9, abs=1e-9)


# ------------------------------------------------------------------------------------- its arcs


@pytest.mark.slow
def test_extrema_of_arcs_agree_with_sampling_in_long_double() -> None:
    rng = np.random.default_rng(7)
    dips = 0
    for _ in range(sample_size(60, 8)):
        case = random_chain(rng, 4, lopsided=True)
        table, shape = case.table(), case.shape()
        for k in range(4):
            lean, rate = case.sides[k % 2, 1], case.sides[k % 2, 2]
            time = np.longdouble(table[k, chains.DURATION] * rate)
            w = np.longdouble(case.frequency / rate)
            beta = np.longdouble(case.amplitude / lean) / (1 + w * w)
            turned = int(case.turns[k] % 2 + k % 2)
            psi = np.longdouble(case.phases[k]) + turned * np.longdouble(math.pi)
            t = np.linspace(0.0, 1.0, 8_001).astype(np.longdouble) * time
            left, right = beta * np.sin(psi) - 1, beta * np.sin(psi + w * time) - 1
            y = (right * np.sinh(t) + left * np.sinh(time - t)) / np.sinh(time)
            y = lean * (y + 1 - beta * np.sin(psi + w * t))
            inner = (y[1:-1] < y[:-2]) & (y[1:-1] < y[2:])
            least = float(y[1:-1][inner].min(initial=math.inf))
            gap = float(time) / 8_000
            pull = (2.0 + case.amplitude + np.abs(y).max()) * gap * gap
            if math.isinf(least) or math.isinf(shape[k, 1]):
                # A dip that one of the two does not see is one at an end, or no deeper than a step.
                assert math.isinf(least) == math.isinf(shape[k, 1]) or (
                    min(float(shape[k, 2]) * rate, float(time - shape[k, 2] * rate)) < 2.0 * gap
                )
            else:
                dips += 1
                assert -1e-13 <= least - shape[k, 1] <= pull + 1e-12
            highest = max(0.0, float(y.max()))
            assert -1e-12 <= shape[k, 0] - highest <= pull + 1e-12
    assert dips > sample_size(20, 2)


def test_an_arc_without_duration_has_no_extrema() -> None:
    turns = np.zeros(2, dtype=np.int64)
    case = Case(2.0, 3.0, both_sides(0.7), turns, np.array([1.0, 0.5]), 2)
    shape = case.shape()
    assert np.isnan(shape[0]).all()
    assert not np.isnan(shape[1, 0])


def test_a_chain_that_lands_without_speed_has_infinite_entries_and_no_error() -> None:
    # Two impacts in one moment: the arc between them neither starts nor lands.
    turns = np.zeros(2, dtype=np.int64)
    case = Case(2.0, 3.0, both_sides(0.7), turns, np.array([1.0, 1.0]), 2)
    with np.errstate(all="ignore"):
        table = case.table()
    assert np.isfinite(table).all()
    assert table[0, chains.DURATION] == table[0, chains.START] == table[0, chains.LANDING] == 0.0
