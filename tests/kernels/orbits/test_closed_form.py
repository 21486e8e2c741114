"""Tso and Wong's symmetric steady states: the paper's own equations, 50 digits, printed numbers."""

import math
from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.optimize import brentq

from rocksteady.kernels.orbits.closed_form import (
    Points,
    Steady,
    fill_curves,
    fill_half_cycle,
    fill_steady,
    half_cycle_shape,
    symmetric_orbit,
    symmetry_breaking,
)
from tests.every import every
from tests.oracles import ExactFlight, mp
from tests.published import TW1
from tests.strategies import frequency_ratios, restitutions, sample_size

Floats = NDArray[np.float64]
Long = np.longdouble


def steady(
    amplitude: object, frequency: object, restitution: object, order: object, shapes: bool = True
) -> Steady:
    """Fill both branches at every point of the broadcast arguments."""
    a, w, r, n = (
        values.copy()
        for values in np.broadcast_arrays(
            np.atleast_1d(np.asarray(amplitude, dtype=np.float64)),
            np.asarray(frequency, dtype=np.float64),
            np.asarray(restitution, dtype=np.float64),
            np.asarray(order, dtype=np.int64),
        )
    )
    points = len(a)
    found = Steady(
        np.zeros(points, dtype=np.int64),
        np.zeros((3, points)),
        np.full((2, points), math.nan),
        np.full((2, points), math.nan),
        np.full((2, points), math.nan),
        np.full((2, points), math.nan),
        np.zeros((2, points), dtype=np.int64),
        np.zeros((2, points), dtype=np.bool_),
    )
    fill_steady(Points(a, w, r, n), shapes, found)
    return found


def paper_boundaries(w: Floats, r: Floats, n: NDArray[np.int64]) -> tuple[Floats, Floats, Floats]:
    """Return eqs 23, 24 and 25 as printed."""
    d, h = (1.0 - r) / (1.0 + r), np.tanh(n * np.pi / (2.0 * w))
    square = 1.0 + w * w
    existence = square * d * h * h / np.sqrt(1.0 + (d * h * w) ** 2)
    return existence, h * square / w, d * h * h * square


def random_points(
    seed: int, count: int, nearest: float = 1e-6
) -> tuple[Floats, Floats, Floats, NDArray[np.int64]]:
    """Return amplitude, frequency ratio, restitution, order: where there is a symmetric orbit."""
    rng = np.random.default_rng(seed)
    w = 10.0 ** rng.uniform(math.log10(0.05), 3.0, count)
    r = np.where(rng.random(count) < 0.1, 1.0, rng.uniform(1e-3, 1.0, count))
    n = 2 * rng.integers(0, 5, count) + 1
    least = paper_boundaries(w, r, n)[0]
    a = least * (1.0 + 10.0 ** rng.uniform(math.log10(nearest), 1.5, count))
    a = np.where(r == 1.0, 10.0 ** rng.uniform(-2.0, 1.5, count), a)
    return a, w, r, n


# ------------------------------------------------------------------------- the paper's equations


def residuals(
    a: Floats, w: Floats, r: Floats, n: NDArray[np.int64], phase: Floats, velocity: Floats
) -> tuple[Floats, Floats]:
    """Return eqs 12 and 13 over cosh(n pi/Omega), with eqs 14 and 15, in extended precision."""
    amplitude, omega, delta = Long(1) * a, Long(1) * w, Long(1) * r
    f, v = Long(1) * phase, Long(1) * velocity
    beta = amplitude / (1 + omega * omega)
    pi = Long("3.14159265358979323846264338327950288")
    half = np.exp(-2 * n * pi / omega)
    sinh, one = (1 - half) / (1 + half), 2 * np.exp(-n * pi / omega) / (1 + half)  # over cosh
    growth = omega * (v + beta * np.cos(f))  # a+
    offset = beta * np.sin(f) - 1  # b+
    # u+(n pi) = 0, and restitution times u+'(n pi) = -v; sin and cos change sign with n odd.
    first = growth * sinh + offset + (1 + beta * np.sin(f)) * one
    second = delta * ((growth + offset * sinh) / omega + beta * np.cos(f) * one) + v * one
    return np.abs(first).astype(float), np.abs(second).astype(float)


def test_the_paper_s_equations_hold_at_a_hundred_thousand_points() -> None:
    count = sample_size(100_000, 3000)
    a, w, r, n = random_points(1, count)
    found = steady(a, w, r, n, shapes=False)
    assert np.all(found.region != 4)
    for branch in range(2):
        first, second = residuals(a, w, r, n, found.phase[branch], found.velocity[branch])
        assert first.max() < 1e-13
        assert second.max() < 1e-13


def exact_orbit(a: float, w: float, r: float, n: int, branch: int) -> tuple[Any, Any]:
    """Solve eqs 16 and 17 in 50 digits: eliminate the velocity, then quadratic in tan(f/2)."""
    A, W, d = mp.mpf(a), mp.mpf(w), mp.mpf(r)
    beta, length = A / (1 + W * W), n * mp.pi / W
    h = mp.tanh(length / 2)
    D = (1 - d) / (1 + d)
    P, Q = D * h * W, D * h * h / beta
    # P cos f + sin f = Q (eq 20) is sin(f + atan P) = Q/sqrt(1 + P^2).
    tilt, arc = mp.atan(P), mp.asin(Q / mp.sqrt(1 + P * P))
    f = (mp.pi - arc if branch == 1 else arc) - tilt
    v = -(beta * mp.sin(f) / h - h) / W - beta * mp.cos(f)  # eq 18
    return f, v


def exact_trace(a: float, w: float, r: float, n: int, f: Any, v: Any) -> Any:
    """Return the trace of the half-cycle map as `results.md` TW5 has it."""
    length, d = n * mp.pi / mp.mpf(w), mp.mpf(r)
    grip = (1 + d) - (1 - d) * mp.mpf(a) * mp.sin(f)
    return -2 * d * mp.cosh(length) + d * mp.sinh(length) / (mp.mpf(w) * v) * grip


def check_orbits(seed: int, count: int) -> None:
    a, w, r, n = random_points(seed, count, nearest=1e-2)
    found = steady(a, w, r, n, shapes=False)
    for i in range(count):
        for branch in (1, 2):
            f, v = exact_orbit(a[i], w[i], r[i], int(n[i]), branch)
            case = (a[i], w[i], r[i], n[i], branch)
            turn = (f - found.phase[branch - 1, i]) / (2 * mp.pi)
            assert abs(turn - mp.nint(turn)) * 2 * mp.pi < 1e-13, case
            beta = a[i] / (1 + w[i] ** 2)
            # Branch 2 changes the sign of its velocity (eq 24): absolute there.
            scale = abs(v) if branch == 1 else abs(v) + 0.1 * beta
            assert abs(found.velocity[branch - 1, i] - v) < 1e-13 * scale, case
            if abs(v) < 1e-3 * beta or n[i] * math.pi / w[i] > 600:
                continue
            trace = exact_trace(a[i], w[i], r[i], int(n[i]), f, v)
            size = abs(trace) + mp.cosh(n[i] * mp.pi / w[i])
            assert abs(found.trace[branch - 1, i] - trace) < 1e-11 * size, case


@pytest.mark.slow
def test_phase_velocity_and_trace_agree_with_fifty_digits() -> None:
    check_orbits(2, sample_size(1500, 150))


def test_phase_velocity_and_trace_of_a_few_orbits_agree_with_fifty_digits() -> None:
    check_orbits(12, 60)


def test_the_phase_is_in_its_range_and_never_a_negative_zero() -> None:
    a, w, r, n = random_points(3, sample_size(20_000, 1000))
    found = steady(a, w, r, n, shapes=False)
    assert np.all(found.phase > -math.pi)
    assert np.all(found.phase <= math.pi)
    assert not np.any(np.signbit(found.phase) & (found.phase == 0.0))


# ------------------------------------------------------------------------------ printed numbers


@every(("point", "phase", "velocity", "peak"), TW1)
def test_table_1(
    point: tuple[float, float, float, int], phase: float, velocity: float, peak: float
) -> None:
    found = steady(*point)
    assert found.phase[0, 0] == pytest.approx(phase, abs=6e-11)
    assert found.velocity[0, 0] == pytest.approx(velocity, abs=6e-11)
    assert found.peak[0, 0] == pytest.approx(peak, abs=6e-11)
    assert found.admissible[0, 0]


@every(
    ("point", "existence", "kind", "sign"),
    [
        ((0.5, 1, 4.0), 0.70825, 0.79129, 1.58816),
        ((0.8, 3, 6.0), 1.61999, 1.76805, 4.04406),
        ((0.95, 1, 10.0), 0.06281, 0.06286, 1.57358),
        ((0.5, 3, 8.0), 3.50833, 6.06806, 4.29984),
    ],
)
def test_table_2(
    point: tuple[float, int, float], existence: float, kind: float, sign: float
) -> None:
    restitution, order, frequency = point
    found = steady(1.0, frequency, restitution, order)
    assert found.boundaries[:, 0] == pytest.approx([existence, sign, kind], abs=6e-6)


@every(
    ("amplitude", "order", "peaks"),
    [
        (1.0, 1, {2: 0.43188, 4: 0.12635, 8: 0.03298}),
        (3.0, 1, {3: 0.41518, 4: 0.24397, 8: 0.06373}),
        (6.0, 1, {4: 0.41873, 8: 0.10940}),
        (2.0, 3, {5: 0.38246, 8: 0.17832}),
        (3.0, 3, {4: 0.57409, 8: 0.18981}),
        (6.0, 3, {6: 0.39555}),
    ],
)
def test_the_peaks_of_figure_5(amplitude: float, order: int, peaks: dict[int, float]) -> None:
    found = steady(amplitude, list(peaks), 0.8, order)
    assert found.peak[0] == pytest.approx(list(peaks.values()), abs=6e-6)


def test_where_figure_5_has_no_third_subharmonic() -> None:
    assert np.all(steady(1.0, np.linspace(4.0, 16.0, 50), 0.8, 3).region == 4)
    assert steady(2.0, 12.0, 0.8, 3).region[0] == 4


@pytest.mark.parametrize(
    ("frequency", "order", "peaks"),
    [
        (4.0, 1, (0.236912, 0.243970, 0.247783, 0.248915)),
        (6.0, 3, (0.324958, 0.310461, 0.282634, 0.243701)),
    ],
)
def test_the_peaks_of_figure_7(frequency: float, order: int, peaks: tuple[float, ...]) -> None:
    found = steady(3.0, frequency, [0.7, 0.8, 0.9, 1.0], order)
    assert found.peak[0] == pytest.approx(peaks, abs=6e-7)


@every(
    ("point", "trace"),
    [
        ((2.0, 2.0, 0.8, 1), -1.555331),
        ((2.0, 6.0, 0.8, 3), 0.011954),
        ((4.0, 6.0, 0.8, 3), -1.723601),
        ((0.75, 4.0, 0.5, 1), 0.767),  # E2: stable, in-phase
        ((1.7, 6.0, 0.8, 3), 0.813),
    ],
)
def test_the_trace_of_the_half_cycle_map(
    point: tuple[float, float, float, int], trace: float
) -> None:
    assert steady(*point).trace[0, 0] == pytest.approx(trace, abs=6e-7 if trace < 0.5 else 6e-4)


BREAKING = [
    (1, {1.0: 1.448324, 2.0: 1.948378, 3.0: 2.345723, 4.0: 2.690687, 6.0: 3.291248}),
    (3, {1.0: 2.957132, 2.0: 4.249471, 3.0: 5.237990, 4.0: 6.143263, 6.0: 7.959945}),
]


@pytest.mark.parametrize(("order", "printed"), BREAKING)
def test_where_symmetry_breaks(order: int, printed: dict[float, float]) -> None:
    for amplitude, frequency in printed.items():
        found = brentq(
            lambda w, a=amplitude: symmetry_breaking(w, 0.8, order) - a,
            0.9 * frequency,
            1.1 * frequency,
            xtol=1e-13,
        )
        assert found == pytest.approx(frequency, abs=6e-7)


@pytest.mark.parametrize(
    ("amplitude", "order", "multipliers"),
    [
        (1.0, 1, {1.0: 25.658, 2.0: 10.2467, 8.0: 7.2251}),
        (2.0, 3, {3.5: 19.557, 4.0: 12.419, 5.0: 6.8005}),
    ],
)
def test_branch_2_is_unstable(
    amplitude: float, order: int, multipliers: dict[float, float]
) -> None:
    found = steady(amplitude, list(multipliers), 0.8, order)
    trace = found.trace[1]
    largest = 0.5 * (trace + np.sqrt(trace**2 - 4.0 * 0.8**2))
    assert largest == pytest.approx(list(multipliers.values()), rel=5e-5)


def test_where_the_paper_is_corrected() -> None:
    # E1: in region 2, branch 2 starts downwards. E3: Fig 11(a) has a multiplier of -1.182.
    found = steady(3.0, 4.0, 0.8, 1)
    assert found.region[0] == 2
    assert found.velocity[1, 0] < 0.0
    assert not found.admissible[1, 0]
    trace = steady(4.0, 6.0, 0.8, 3).trace[0, 0]
    assert 0.5 * (trace - math.sqrt(trace**2 - 4.0 * 0.8**2)) == pytest.approx(-1.182, abs=6e-4)


# -------------------------------------------------------------------------- regions, boundaries


def test_regions_and_boundaries_are_those_of_the_printed_inequalities() -> None:
    rng = np.random.default_rng(5)
    count = sample_size(20_000, 2000)
    w, r = 10.0 ** rng.uniform(-1.3, 3.0, count), rng.uniform(1e-3, 1.0, count)
    n = 2 * rng.integers(0, 5, count) + 1
    existence, sign, kind = paper_boundaries(w, r, n)
    a = np.where(rng.random(count) < 0.7, existence, 1.0) * 10.0 ** rng.uniform(-0.3, 1.0, count)
    found = steady(a, w, r, n, shapes=False)
    assert np.allclose(found.boundaries, [existence, sign, kind], rtol=1e-14, atol=0.0)
    d, h, beta = (1.0 - r) / (1.0 + r), np.tanh(n * np.pi / (2.0 * w)), a / (1.0 + w * w)
    P, Q = d * h * w, d * h * h / beta
    expected = np.select(
        [Q * Q > 1.0 + P * P, (Q < 1.0) & (P < Q), Q < 1.0, P < Q], [4, 1, 2, 3], default=5
    )
    assert np.array_equal(found.region, expected)
    assert set(expected.tolist()) == {1, 2, 3, 4, 5}
    nowhere = found.region == 4
    assert np.all(np.isnan(found.phase[:, nowhere]))
    # The sign of the phase of branch 2, and what is in phase, change where they should.
    there = ~nowhere
    assert np.array_equal(found.phase[1, there] > 0.0, (P < Q)[there])
    assert np.all(found.phase[0, there] > 0.0)
    in_phase = np.abs(found.phase[0, there]) < 0.5 * math.pi
    assert np.array_equal(in_phase, (Q > 1.0)[there])


@given(w=frequency_ratios, r=restitutions, order=st.sampled_from([1, 3, 5, 7, 9]))
def test_the_branches_meet_at_the_boundary_of_existence_with_multiplier_one(
    w: float, r: float, order: int
) -> None:
    least = float(steady(1.0, w, r, order, shapes=False).boundaries[0, 0])
    if least == 0.0:
        return
    fold = steady(least, w, r, order, shapes=False)
    assert fold.region[0] != 4
    # There the phase depends on the square root of what the amplitude is above the boundary.
    p = (1.0 - r) / (1.0 + r) * w * math.tanh(order * math.pi / (2.0 * w))
    assert fold.phase[0, 0] == pytest.approx(fold.phase[1, 0], abs=min(1e-7, 1e-14 + 1e-15 / p))
    size = math.cosh(min(order * math.pi / w, 700.0))
    assert abs(fold.trace[0, 0] - (1.0 + r * r)) <= 1e-13 * size
    assert steady(least * (1.0 - 1e-12), w, r, order, shapes=False).region[0] == 4


@given(w=frequency_ratios, r=st.floats(0.01, 1.0), order=st.sampled_from([1, 3, 5]))
@example(w=math.exp(-1.0), r=1.0, order=3)
@example(w=0.2, r=0.999999, order=1)
@example(w=math.exp(4.0), r=0.25, order=3)
def test_symmetry_breaks_where_a_multiplier_is_minus_one(w: float, r: float, order: int) -> None:
    amplitude = symmetry_breaking(w, r, order)
    if r == 1.0 and order * math.pi / w > 650.0:
        return  # the amplitude e^(-length) is next to nothing
    f, v = exact_orbit(amplitude, w, r, order, 1)
    if mp.im(f) != 0:  # within rounding of the fold
        least = paper_boundaries(np.array([w]), np.array([r]), np.array([order]))[0][0]
        assert amplitude == pytest.approx(least, rel=1e-15)
        return
    assert v > 0
    trace = exact_trace(amplitude, w, r, order, f, v)
    # As far as the rounding of the amplitude lets the trace be known.
    nudge = amplitude * (1.0 + 4e-15)
    f, v = exact_orbit(nudge, w, r, order, 1)
    spread = abs(exact_trace(nudge, w, r, order, f, v) - trace)
    assert abs(trace + (1 + mp.mpf(r) ** 2)) <= 1e-12 + spread


def test_without_loss_branch_1_is_the_elastic_orbit() -> None:
    # restitution 1: D = 0, so that sin f = 0, f = pi, and v = h/Omega + beta.
    a, w = np.array([0.1, 1.0, 3.0, 12.0]), np.array([0.3, 2.0, 30.0, 900.0])
    found = steady(a, w, 1.0, 1)
    assert np.all(found.boundaries[[0, 2]] == 0.0)
    assert np.all(found.phase[0] == math.pi)
    assert np.all(found.phase[1] == 0.0)
    h, beta = np.tanh(np.pi / (2.0 * w)), a / (1.0 + w * w)
    assert found.velocity[0] == pytest.approx(h / w + beta, rel=1e-14)
    assert found.velocity[1] == pytest.approx(h / w - beta, rel=1e-12)
    assert steady(0.0, 2.0, 1.0, 1).region[0] == 4


def test_the_limit_of_no_loss_is_reached_continuously() -> None:
    for w in (0.1, 1.0, 7.0, 300.0):
        edge = steady(2.0, w, 1.0, 1, shapes=False)
        near = steady(2.0, w, 1.0 - 1e-12, 1, shapes=False)
        assert np.allclose(near.velocity, edge.velocity, rtol=1e-9)
        assert np.allclose(near.phase, edge.phase, atol=1e-8)


# ---------------------------------------------------------------------------- shape of the cycle


class Sampled(NamedTuple):
    peak: float
    extrema: int
    lowest: float
    least_speed_between: float


def sampled_half_cycle(a: float, w: float, r: float, n: int, branch: int) -> Sampled:
    """Sample the closed form, its coefficients from many digits, and refine its extrema."""
    with mp.workdps(60 + int(0.9 * n * math.pi / w)):  # the growing part is e^-length small
        f, v = exact_orbit(a, w, r, n, branch)
        W, beta = mp.mpf(w), mp.mpf(a) / (1 + mp.mpf(w) ** 2)
        first, offset = W * (v + beta * mp.cos(f)), beta * mp.sin(f) - 1
        length = n * mp.pi / W
        G = float((first + offset) / 2 * mp.exp(length))
    H, L, b, p = float((offset - first) / 2), float(length), float(beta), float(f)

    def angle(t: Any) -> Any:
        grown: Any = G * np.exp(t - L) + H * np.exp(-t) + 1.0 - b * np.sin(w * t + p)
        return grown

    def speed(t: Any) -> Any:
        grown: Any = G * np.exp(t - L) - H * np.exp(-t) - b * w * np.cos(w * t + p)
        return grown

    count = max(4000, int(60 * L))
    times = np.linspace(0.0, L, count)
    slopes = speed(times)
    turns = np.flatnonzero(slopes[:-1] * slopes[1:] < 0.0)
    at = [
        brentq(lambda t: float(speed(t)), times[i], times[i + 1], xtol=1e-16, rtol=1e-15)
        for i in turns
    ]
    heights = angle(np.array(at))
    inner = angle(times[1:-1])
    lowest = min([*heights.tolist(), float(inner.min())])
    # An extremum that is about to appear or vanish: the speed hardly passes zero.
    bends = np.diff(np.sign(np.diff(slopes)))
    closest = np.abs(slopes[1:-1][bends != 0.0])
    return Sampled(
        float(heights.max()) if at else -math.inf,
        len(at),
        lowest,
        float(closest.min()) if len(closest) else math.inf,
    )


def test_peak_extrema_and_admissibility_agree_with_dense_sampling() -> None:
    count = sample_size(500, 50)
    a, w, r, n = random_points(9, count, nearest=1e-3)
    found = steady(a, w, r, n)
    seen = {True: 0, False: 0}
    several = 0
    for i in range(count):
        for branch in (0, 1):
            truth = sampled_half_cycle(a[i], w[i], r[i], int(n[i]), branch + 1)
            case = (a[i], w[i], r[i], n[i], branch)
            size = 1.0 + a[i] / (1.0 + w[i] ** 2)
            velocity = w[i] * found.velocity[branch, i]
            if truth.least_speed_between > 1e-5 * size * min(1.0, 1.0 / w[i]):
                assert found.extrema[branch, i] == truth.extrema, case
            several += truth.extrema > 1
            if math.isfinite(truth.peak):
                assert found.peak[branch, i] == pytest.approx(truth.peak, abs=1e-13 * size), case
            # The samples next to the ends stand for the start and the landing.
            if velocity <= 0.0:
                assert not found.admissible[branch, i]
            elif truth.lowest > 1e-13 * size or truth.lowest < -1e-12 * size:
                assert found.admissible[branch, i] == (truth.lowest > 0.0), case
                seen[bool(found.admissible[branch, i])] += 1
    assert min(seen.values()) > count // 20
    assert several > count // 20


@every("order", [1, 3, 9])
def test_long_half_cycles_keep_their_accuracy(order: int) -> None:
    # At Omega = .05 a half cycle lasts 63 n: e^63 is 10^27, e^565 is 10^245.
    w, r = 0.05, 0.8
    least = paper_boundaries(np.array([w]), np.array([r]), np.array([order]))[0][0]
    for factor in (1.001, 1.5, 4.0):
        found = steady(least * factor, w, r, order)
        for branch in (0, 1):
            truth = sampled_half_cycle(least * factor, w, r, order, branch + 1)
            assert found.peak[branch, 0] == pytest.approx(truth.peak, rel=1e-12)
            assert found.extrema[branch, 0] == truth.extrema


def test_a_half_cycle_that_overflows_is_still_told() -> None:
    found = steady(0.4, 1e-3, 0.8, 1)
    assert found.region[0] != 4
    assert np.all(np.isinf(found.trace))
    assert np.all(np.isfinite(found.peak))
    point = np.array([0.4]), np.array([1e-3]), np.array([0.8]), np.array([1])
    first, second = residuals(*point, found.phase[0], found.velocity[0])
    assert max(first[0], second[0]) < 1e-13


def test_one_point_alone_is_told_as_in_a_batch() -> None:
    a, w, r, n = random_points(10, 50)
    batch = steady(a, w, r, n)
    for i in range(50):
        for branch in (0, 1):
            orbit = symmetric_orbit(a[i], w[i], r[i], int(n[i]), branch + 1)
            assert orbit.phase == batch.phase[branch, i]
            assert orbit.velocity == batch.velocity[branch, i]
            shape = half_cycle_shape(a[i], w[i], r[i], int(n[i]), orbit)
            assert shape == (
                batch.peak[branch, i],
                batch.extrema[branch, i],
                batch.admissible[branch, i],
            )


@every(("a", "w", "r", "n"), [(2.0, 4.0, 0.8, 1), (3.0, 8.0, 0.95, 3), (1.0, 2.0, 0.5, 1)])
def test_a_half_cycle_is_the_flight_from_its_phase_and_velocity(
    a: float, w: float, r: float, n: int
) -> None:
    length = n * math.pi / w
    times, states = np.linspace(0.0, length, 9), np.empty((2, 9))
    for branch in (1, 2):
        fill_half_cycle(a, w, n, symmetric_orbit(a, w, r, n, branch), times, states)
        f, v = exact_orbit(a, w, r, n, branch)
        flight = ExactFlight(mp.mpf(-1), mp.mpf(0), mp.mpf(a), mp.mpf(w), mp.mpf(0), w * v, f)
        for time, angle, velocity in zip(times, *states, strict=True):
            y, speed = flight.state(float(time))
            assert abs(y - angle) < 1e-12
            assert abs(speed - velocity) < 1e-12
        assert abs(states[0, -1]) < 1e-12  # and leaves with r times its speed, mirrored
        assert r * states[1, -1] == pytest.approx(-states[1, 0], rel=1e-11)


def test_curves_of_the_plane_are_the_boundaries_of_its_regions() -> None:
    w, r = np.array([1.5, 4.0, 4.0, 8.0]), np.array([0.5, 0.8, 0.9, 0.7])
    n, curves = np.array([1, 1, 3, 3]), np.empty((5, 4))
    fill_curves(w, r, n, curves)
    existence, sign, kind, breaking, heteroclinic = curves
    assert steady(existence * (1.0 - 1e-9), w, r, n, shapes=False).region.tolist() == [4] * 4
    found = steady(existence * (1.0 + 1e-9), w, r, n, shapes=False)
    assert np.all(found.region != 4)
    # Both branches are born together, and the second one's velocity changes its sign.
    assert np.abs(found.velocity[0] - found.velocity[1]).max() < 1e-3
    low, high = (
        steady(sign * (1.0 + off), w, r, n, shapes=False).velocity[1] for off in (-1e-6, 1e-6)
    )
    assert np.all((low * high <= 0.0) | np.isnan(low))
    for curve in (sign, kind):
        assert np.all(curve >= existence * (1.0 - 1e-12))
    for i in range(4):
        assert breaking[i] == symmetry_breaking(w[i], r[i], int(n[i]))
    # Of ever longer orbits the existence curve tends to the heteroclinic one.
    long, late = np.full(4, 99), np.empty((5, 4))
    fill_curves(w, r, long, late)
    np.testing.assert_allclose(late[0], heteroclinic, rtol=1e-9)
