"""Steady states: the paper's numbers and formulae, sampled half cycles, and their shapes."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rocksteady import (
    DimensionlessBlock,
    Harmonic,
    InputError,
    State,
    Steady,
    SteadyStates,
    simulate,
    steady_orbit,
    steady_states,
)
from tests.dynamics.formulae import (
    half_cycle,
    numbers,
    printed,
    printed_boundaries,
    printed_region,
    printed_trace,
)
from tests.strategies import logarithmic

orders = st.sampled_from([1, 3, 5, 7])
points = st.tuples(logarithmic(0.05, 12.0), logarithmic(0.3, 50.0), st.floats(0.05, 0.999), orders)


def states_at(point: tuple[float, float, float, int], **options: bool) -> SteadyStates:
    a, w, r, n = point
    return steady_states(a, w, r, order=n, **options)


def checked(values: Any) -> Any:
    """Return an attribute that is None without shapes, known to be there."""
    assert values is not None
    return values


# ------------------------------------------------------------------------ published numbers


@pytest.mark.parametrize(
    ("point", "phase", "velocity", "peak"),
    [
        ((2.0, 4.0, 0.8, 1), 2.8465425429, 0.1830972718, 0.1854991060),
        ((2.0, 6.0, 0.8, 3), 1.7852919857, 0.1073819482, 0.2888312915),
        ((3.0, 8.0, 0.95, 3), 2.8781538751, 0.1078741335, 0.1605680074),
        ((1.0, 2.0, 0.5, 1), 2.0129317200, 0.2756474666, 0.3407162565),
    ],
)
def test_tw1_phase_velocity_and_peak(
    point: tuple[float, float, float, int], phase: float, velocity: float, peak: float
) -> None:
    states = states_at(point)
    assert states.phase[0] == pytest.approx(phase, abs=5.1e-11)
    assert states.velocity[0] == pytest.approx(velocity, abs=5.1e-11)
    assert checked(states.peak)[0] == pytest.approx(peak, abs=5.1e-11)
    assert states.stable[0]


@pytest.mark.parametrize(
    ("order", "amplitude", "frequency_ratio", "peak"),
    [
        (1, 1.0, 2.0, 0.43188),
        (1, 1.0, 4.0, 0.12635),
        (1, 1.0, 8.0, 0.03298),
        (1, 3.0, 3.0, 0.41518),
        (1, 3.0, 4.0, 0.24397),
        (1, 3.0, 8.0, 0.06373),
        (1, 6.0, 4.0, 0.41873),
        (1, 6.0, 8.0, 0.10940),
        (3, 2.0, 5.0, 0.38246),
        (3, 2.0, 8.0, 0.17832),
        (3, 3.0, 4.0, 0.57409),
        (3, 3.0, 8.0, 0.18981),
        (3, 6.0, 6.0, 0.39555),
    ],
)
def test_tw3_peaks_of_figure_5(
    order: int, amplitude: float, frequency_ratio: float, peak: float
) -> None:
    states = steady_states(amplitude, frequency_ratio, 0.8, order=order)
    assert checked(states.peak)[0] == pytest.approx(peak, abs=5.1e-6)
    assert checked(states.admissible)[0]


@pytest.mark.parametrize(
    ("amplitude", "frequency_ratio"), [(1.0, 4.0), (1.0, 6.0), (1.0, 16.0), (2.0, 12.0)]
)
def test_tw3_where_the_subharmonic_curves_have_ended(
    amplitude: float, frequency_ratio: float
) -> None:
    states = steady_states(amplitude, frequency_ratio, 0.8, order=3)
    assert not checked(states.admissible).any()
    assert not states.stable.any()


@pytest.mark.parametrize(
    ("order", "frequency_ratio", "peaks"),
    [
        (1, 4.0, (0.236912, 0.243970, 0.247783, 0.248915)),
        (3, 6.0, (0.324958, 0.310461, 0.282634, 0.243701)),
    ],
)
def test_tw4_peaks_against_restitution(
    order: int, frequency_ratio: float, peaks: tuple[float, ...]
) -> None:
    states = steady_states(3.0, frequency_ratio, [0.7, 0.8, 0.9, 1.0], order=order)
    np.testing.assert_allclose(checked(states.peak)[0], peaks, rtol=0.0, atol=5.1e-7)


@pytest.mark.parametrize(
    ("point", "trace"),
    [
        ((2.0, 2.0, 0.8, 1), -1.555331),
        ((2.0, 6.0, 0.8, 3), 0.011954),
        ((4.0, 6.0, 0.8, 3), -1.723601),
        ((0.75, 4.0, 0.5, 1), 0.767),
        ((1.7, 6.0, 0.8, 3), 0.813),
    ],
)
def test_tw5_traces(point: tuple[float, float, float, int], trace: float) -> None:
    digits = 5.1e-4 if round(trace, 3) == trace else 5.1e-7
    assert states_at(point).trace[0] == pytest.approx(trace, abs=digits)


@pytest.mark.parametrize(
    ("order", "amplitude", "frequency_ratio", "multiplier"),
    [
        (1, 1.0, 1.0, 25.658),
        (1, 1.0, 2.0, 10.2467),
        (1, 1.0, 8.0, 7.2251),
        (3, 2.0, 3.5, 19.557),
        (3, 2.0, 4.0, 12.419),
        (3, 2.0, 5.0, 6.8005),
    ],
)
def test_tw8_branch_2_is_unstable(
    order: int, amplitude: float, frequency_ratio: float, multiplier: float
) -> None:
    states = steady_states(amplitude, frequency_ratio, 0.8, order=order)
    decimals = len(str(multiplier).partition(".")[2])
    assert abs(states.multipliers[1, 0]) == pytest.approx(multiplier, abs=0.51 * 10.0**-decimals)
    assert checked(states.admissible)[1]
    assert not states.stable[1]


@pytest.mark.parametrize("point", [(0.75, 4.0, 0.5, 1), (1.7, 6.0, 0.8, 3)])
def test_e2_an_in_phase_solution_of_region_3_is_stable(
    point: tuple[float, float, float, int],
) -> None:
    states = states_at(point)
    assert states.region == 3
    assert states.in_phase[0]
    assert states.stable[0]


def test_e3_figure_11a_is_unstable_with_a_multiplier_of_minus_1_182() -> None:
    states = steady_states(4.0, 6.0, 0.8, order=3)
    assert checked(states.admissible)[0]
    assert not states.stable[0]
    assert states.multipliers[0, 0] == pytest.approx(-1.182, abs=5.1e-4)


# ----------------------------------------------------------------------- against the formulae


@given(points)
def test_region_and_solutions_are_those_of_the_printed_formulae(
    point: tuple[float, float, float, int],
) -> None:
    a, w, r, n = point
    boundaries = printed_boundaries(w, r, n)
    assume(min(abs(a / boundary - 1.0) for boundary in boundaries) > 1e-6)
    states = states_at(point)
    assert (states.existence, states.sign, states.kind) == pytest.approx(boundaries, rel=1e-13)
    assert states.region == printed_region(a, w, r, n)
    if states.region == 4:
        assert np.isnan([states.phase, states.velocity, states.trace, checked(states.peak)]).all()
        assert np.isnan(states.multipliers.real).all()
        assert not (checked(states.admissible) | states.stable | states.neutral).any()
        return
    h, beta, p, q = numbers(a, w, r, n)
    # What the printed forms lose: S is a difference, v the difference of h/Omega and the rest.
    lost = 1e-15 * (1.0 + p * p) / min(1.0, 1.0 + p * p - q * q)
    for branch in (1, 2):
        expected = printed(a, w, r, n, branch)
        phase, velocity = states.phase[branch - 1], states.velocity[branch - 1]
        assert math.sin(phase) == pytest.approx(expected.sine, abs=1e-14 + 10.0 * lost)
        assert math.cos(phase) == pytest.approx(expected.cosine, abs=1e-14 + 10.0 * lost)
        scale = h / w + beta * (1.0 + 1.0 / (h * w))
        assert velocity == pytest.approx(expected.velocity, abs=scale * (1e-13 + 10.0 * lost))
        assert bool(states.in_phase[branch - 1]) is (expected.cosine > 0.0) or (
            abs(expected.cosine) < 1e-12
        )


def test_residuals_of_equations_12_and_13_at_a_hundred_thousand_points() -> None:
    rng = np.random.default_rng(20261120)
    count = 100_000
    w = 10.0 ** rng.uniform(math.log10(0.05), 3.0, count)
    r, n = rng.uniform(0.05, 1.0, count), rng.choice([1, 3, 5], count)
    h = np.tanh(n * math.pi / (2.0 * w))
    d = (1.0 - r) / (1.0 + r)
    existence = (1.0 + w * w) * d * h * h / np.sqrt(1.0 + (d * h * w) ** 2)
    a = existence * (1.0 + 10.0 ** rng.uniform(-6.0, 1.5, count))
    a = np.where(a > 0.0, a, 1.0)
    a = np.minimum(a, np.maximum(12.0, 1.01 * existence))
    states = steady_states(a, w, r, order=n, shapes=False)
    assert (states.region != 4).all()
    end, shrunk = np.tanh(n * math.pi / w), 1.0 / np.cosh(np.minimum(n * math.pi / w, 700.0))
    beta = a / (1.0 + w * w)
    sine, cosine = np.sin(states.phase), np.cos(states.phase)
    sinh_part, cosh_part = w * (states.velocity + beta * cosine), beta * sine - 1.0
    landing = sinh_part * end + cosh_part + (1.0 + beta * sine) * shrunk
    bounce = r * (sinh_part + cosh_part * end) + (r * beta * cosine + states.velocity) * w * shrunk
    scale = 1.0 + beta * np.maximum(1.0, w)  # of the terms; 1e-13 of 1 at moderate amplitudes
    assert np.abs(landing / scale).max() < 1e-13
    assert np.abs(bounce / scale).max() < 1e-13


@given(points)
@settings(max_examples=200)
def test_peak_and_admissibility_are_those_of_the_sampled_half_cycle(
    point: tuple[float, float, float, int],
) -> None:
    a, w, _, n = point
    assume(n * math.pi / w < 15.0)  # the plain closed form loses digits in longer half cycles
    states = states_at(point)
    assume(states.region != 4)
    for which in (0, 1):
        phase, velocity = states.phase[which], states.velocity[which]
        s, angle = half_cycle(a, w, n, phase, velocity, 20_001)
        inside = angle[1:-1]
        lowest = inside[100:-100].min()
        if velocity > 1e-9 and lowest > 1e-6:
            assert checked(states.admissible)[which]
            curvature = 1.0 + a + angle.max()
            coarse = curvature * (s[1] - s[0]) ** 2 / 8.0
            assert -1e-9 <= checked(states.peak)[which] - angle.max() <= coarse + 1e-9
        elif velocity < -1e-9 or lowest < -1e-6:
            assert not checked(states.admissible)[which]


@given(points)
def test_the_number_of_extrema_is_that_of_the_changes_of_direction(
    point: tuple[float, float, float, int],
) -> None:
    a, w, _, n = point
    assume(n * math.pi / w < 12.0)
    states = states_at(point)
    assume(states.region != 4)
    for which in (0, 1):
        if not checked(states.admissible)[which]:
            continue
        _, angle = half_cycle(a, w, n, states.phase[which], states.velocity[which], 20_001)
        slope = np.diff(angle)
        if np.abs(slope[1:] - slope[:-1])[np.sign(slope[1:]) != np.sign(slope[:-1])].min() < 1e-11:
            continue  # nearly an inflection: sampling cannot tell
        turns = int((np.sign(slope[1:]) != np.sign(slope[:-1])).sum())
        assert checked(states.extrema)[which] == turns


@given(st.floats(0.02, 0.98), logarithmic(0.3, 50.0), st.floats(0.05, 0.99), orders)
def test_e1_in_regions_2_and_5_branch_2_falls_through_the_floor(
    share: float, w: float, r: float, n: int
) -> None:
    existence, sign, kind = printed_boundaries(w, r, n)
    amplitudes = [max(sign, kind) * (1.0 + 10.0 * share)]  # region 2
    if sign < kind * 0.999:
        amplitudes.append(max(sign, existence) + share * (kind - max(sign, existence)))
    states = steady_states(amplitudes, w, r, order=n)
    assert set(states.region.tolist()) <= {2, 5}
    assert (states.velocity[1] < 0.0).all()
    assert not checked(states.admissible)[1].any()
    assert (states.phase[1] < 0.0).all()


@given(st.floats(0.02, 0.98), logarithmic(0.3, 50.0), st.floats(0.05, 0.99), orders)
def test_e7_in_regions_1_and_3_both_phases_are_positive(
    share: float, w: float, r: float, n: int
) -> None:
    existence, sign, kind = printed_boundaries(w, r, n)
    assume(existence < 0.999 * sign)
    states = steady_states(existence + share * (sign - existence), w, r, order=n)
    assert states.region in (1, 3)
    assert (states.phase > 0.0).all()
    assert (states.velocity > 0.0).all()
    assert bool(states.in_phase[0]) is bool(states.region == 3)
    assert kind > existence  # E8: region 3 never vanishes


# ------------------------------------------------------------------------------- stability


def half_cycle_map(a: float, w: float, r: float, phase: float, velocity: float, n: int) -> Any:
    """Phase and du/ds after the next impact, seen from the other side, by a simulation."""
    run = simulate(
        DimensionlessBlock(restitution=r),
        Harmonic(amplitude=a, frequency_ratio=w, phase=phase),
        start=State(angle=0.0, velocity=velocity),
        cycles=n,
    )
    s, after = run.impacts.s[0], run.impacts.velocity_after[0]
    return np.array([phase + w * s - n * math.pi, -after])


@pytest.mark.parametrize(
    ("point", "branch"),
    [
        ((2.0, 4.0, 0.8, 1), 1),
        ((2.0, 2.0, 0.8, 1), 1),
        ((2.0, 6.0, 0.8, 3), 1),
        ((4.0, 6.0, 0.8, 3), 1),
        ((1.0, 2.0, 0.5, 1), 1),
        ((0.75, 4.0, 0.5, 1), 1),
        ((3.0, 8.0, 0.95, 3), 1),
        ((3.0, 4.0, 1.0, 1), 1),
        ((1.0, 2.0, 0.8, 1), 2),
        ((1.0, 8.0, 0.8, 1), 2),
        ((2.0, 5.0, 0.8, 3), 2),
    ],
)
def test_multipliers_are_those_of_the_differentiated_half_cycle(
    point: tuple[float, float, float, int], branch: int
) -> None:
    a, w, r, n = point
    states = states_at(point)
    assert checked(states.admissible)[branch - 1]
    phase, velocity = float(states.phase[branch - 1]), w * float(states.velocity[branch - 1])
    # It is a fixed point of the map ...
    np.testing.assert_allclose(
        half_cycle_map(a, w, r, phase, velocity, n), [phase, velocity], rtol=1e-12
    )
    # ... whose derivative has these eigenvalues.
    h = 3e-6
    columns = [
        (
            half_cycle_map(a, w, r, phase + h * x, velocity * (1.0 + h * y), n)
            - half_cycle_map(a, w, r, phase - h * x, velocity * (1.0 - h * y), n)
        )
        / (2.0 * h * (x + y * velocity))
        for x, y in ((1.0, 0.0), (0.0, 1.0))
    ]
    eigenvalues = np.linalg.eigvals(np.array(columns).T)
    eigenvalues = eigenvalues[np.lexsort((-eigenvalues.imag, -np.abs(eigenvalues).round(6)))]
    np.testing.assert_allclose(states.multipliers[branch - 1], eigenvalues, rtol=1e-6, atol=1e-7)


@given(points)
def test_multipliers_solve_their_quadratic_and_decide_stability(
    point: tuple[float, float, float, int],
) -> None:
    a, w, r, n = point
    assume(n * math.pi / w < 100.0)
    states = states_at(point)
    assume(states.region != 4)
    for which in (0, 1):
        first, second = states.multipliers[which]
        assert first * second == pytest.approx(r * r, rel=1e-12)
        assert first + second == pytest.approx(states.trace[which], rel=1e-12, abs=1e-14)
        assert abs(first) >= abs(second) * (1.0 - 1e-15)
        assert first.imag >= 0.0
        inside = abs(first) < 1.0
        if abs(abs(first) - 1.0) > 1e-9:
            stable = bool(inside and checked(states.admissible)[which])
            assert bool(states.stable[which]) is stable
        # TW5, where its difference keeps its digits
        sine = math.sin(states.phase[which])
        direct = printed_trace(a, w, r, n, sine, states.velocity[which])
        assert states.trace[which] == pytest.approx(
            direct,
            abs=1e-9 * math.cosh(n * math.pi / w) * (1.0 + 1.0 / abs(states.velocity[which])),
        )


@given(logarithmic(0.05, 12.0), logarithmic(0.3, 50.0), orders)
def test_restitution_1_makes_neutral_orbits_and_never_stable_ones(
    a: float, w: float, n: int
) -> None:
    states = steady_states(a, w, 1.0, order=n)
    assert states.region in (1, 2)
    assert not states.stable.any()
    for which in (0, 1):
        elliptic = abs(states.trace[which]) < 2.0 and checked(states.admissible)[which]
        assert bool(states.neutral[which]) is bool(elliptic)
        if elliptic:
            np.testing.assert_allclose(np.abs(states.multipliers[which]), 1.0, rtol=1e-14)
    # Branch 1 is exactly out of phase, branch 2 exactly in phase.
    assert states.phase.tolist() == [math.pi, 0.0]


def test_a_stable_orbit_is_no_neutral_one() -> None:
    states = steady_states(2.0, 4.0, 0.8)
    assert states.stable[0]
    assert not states.neutral.any()


def test_at_the_existence_boundary_the_two_branches_meet_with_a_multiplier_of_1() -> None:
    existence = float(steady_states(2.0, 4.0, 0.8).existence)
    states = steady_states(existence * (1.0 + 1e-12), 4.0, 0.8)
    assert states.phase[0] == pytest.approx(states.phase[1], abs=1e-5)
    np.testing.assert_allclose(states.trace, 1.64, atol=1e-4)


# ----------------------------------------------------------------- shapes and bad arguments


def test_arrays_broadcast_and_each_element_is_the_scalar_call() -> None:
    a = np.array([0.1, 0.75, 2.0, 6.0])[:, np.newaxis, np.newaxis]
    w, n = np.array([2.0, 4.0, 9.0])[:, np.newaxis], np.array([1, 3])
    grid = steady_states(a, w, 0.8, order=n)
    assert grid.region.shape == grid.order.shape == grid.amplitude.shape == (4, 3, 2)
    assert grid.phase.shape == checked(grid.peak).shape == grid.stable.shape == (2, 4, 3, 2)
    assert grid.multipliers.shape == (2, 4, 3, 2, 2)
    for index in np.ndindex(4, 3, 2):
        i, j, k = index
        one = steady_states(a[i, 0, 0], w[j, 0], 0.8, order=int(n[k]))
        assert one.region.shape == ()
        assert one.phase.shape == (2,)
        assert one.multipliers.shape == (2, 2)
        assert grid.region[index] == one.region
        for name in ("phase", "velocity", "trace", "peak", "extrema", "admissible", "stable"):
            np.testing.assert_array_equal(
                getattr(grid, name)[(slice(None), *index)], getattr(one, name)
            )
        np.testing.assert_array_equal(grid.multipliers[(slice(None), *index)], one.multipliers)


def test_arrays_of_any_memory_order_and_of_integers_give_the_same() -> None:
    a = np.array([[1, 2, 3], [4, 5, 6]])
    plain = steady_states(a.astype(float), 4.0, 0.8)
    for same in (a, np.asfortranarray(a), a.T.copy().T, a.tolist(), a.astype(np.int8)):
        np.testing.assert_array_equal(steady_states(same, 4, 0.8).phase, plain.phase)


def test_empty_arrays_give_empty_results() -> None:
    states = steady_states(np.zeros((0, 3)), 4.0, 0.8)
    assert states.phase.shape == (2, 0, 3)
    assert states.stable.shape == (2, 0, 3)
    assert states.multipliers.shape == (2, 0, 3, 2)
    assert steady_states([], [], []).region.shape == (0,)


def test_results_do_not_share_memory_with_the_arguments() -> None:
    a = np.array([1.0, 2.0])
    states = steady_states(a, 4.0, 0.8)
    phase = states.phase.copy()
    a[:] = 0.0
    np.testing.assert_array_equal(states.amplitude, [1.0, 2.0])
    np.testing.assert_array_equal(states.phase, phase)


@pytest.mark.parametrize("restitution", [0.8, 1.0])
def test_nothing_exists_without_shaking(restitution: float) -> None:
    states = steady_states(0.0, 4.0, restitution)
    assert states.region == 4
    assert np.isnan(states.phase).all()


def test_without_shapes_the_rest_is_the_same_and_stability_is_refused() -> None:
    whole, bare = steady_states(2.0, 4.0, 0.8), steady_states(2.0, 4.0, 0.8, shapes=False)
    np.testing.assert_array_equal(whole.phase, bare.phase)
    np.testing.assert_array_equal(whole.multipliers, bare.multipliers)
    assert [bare.peak, bare.extrema, bare.admissible] == [None, None, None]
    with pytest.raises(AttributeError, match="shapes=True"):
        _ = bare.stable


@pytest.mark.parametrize(
    ("name", "value", "reason"),
    [
        ("amplitude", -1.0, "0, 1e"),
        ("amplitude", math.nan, "0, 1e"),
        ("amplitude", math.inf, "0, 1e"),
        ("amplitude", "2", "real number"),
        ("amplitude", True, "real number"),
        ("amplitude", 1j, "real number"),
        ("amplitude", None, "real number"),
        ("frequency_ratio", 0.0, "lie in"),
        ("frequency_ratio", -4.0, "lie in"),
        ("frequency_ratio", math.nan, "lie in"),
        ("frequency_ratio", math.inf, "lie in"),
        ("frequency_ratio", 1e200, "lie in"),
        ("restitution", 0.0, r"\(0, 1\]"),
        ("restitution", 1.2, r"\(0, 1\]"),
        ("restitution", -0.5, r"\(0, 1\]"),
        ("restitution", math.nan, r"\(0, 1\]"),
        ("order", 2, "odd number of half periods"),
        ("order", 0, "1 or above"),
        ("order", -1, "1 or above"),
        ("order", 1.0, "whole number"),
        ("order", True, "whole number"),
        ("order", "1", "whole number"),
        ("order", 10**30 + 1, "at most"),
        ("order", 10**18 + 1, "at most"),
    ],
)
@pytest.mark.parametrize("in_array", [False, True])
def test_a_bad_argument_is_refused_with_the_reason(
    name: str, value: Any, reason: str, in_array: bool
) -> None:
    good: dict[str, Any] = {"amplitude": 2, "frequency_ratio": 4, "restitution": 1, "order": 1}
    # An array of an integer and a bool is one of integers before anyone can look at it.
    good[name] = [good[name], value] if in_array and value is not True else value
    with pytest.raises(InputError, match=rf"^{name} = .*{reason}"):
        steady_states(**good)


def test_shapes_that_do_not_broadcast_are_refused_with_the_shapes() -> None:
    with pytest.raises(InputError, match=r"\(2,\), \(3,\)"):
        steady_states([1.0, 2.0], [1.0, 2.0, 3.0], 0.8)


@given(
    logarithmic(1e-50, 1e49),
    logarithmic(0.01, 1e4),
    st.floats(0.0, 1.0, exclude_min=True),
    orders,
)
def test_no_nan_is_silent_whatever_the_magnitudes(a: float, w: float, r: float, n: int) -> None:
    states = steady_states(a, w, r, order=n)
    assert np.isfinite([states.existence, states.sign, states.kind]).all()
    missing = np.isnan([states.phase, states.velocity, states.trace, checked(states.peak)])
    assert missing.all() if states.region == 4 else not missing.any()


# ------------------------------------------------------------------------------ as a dataset


def test_the_dataset_names_its_dimensions_units_and_classes() -> None:
    states = steady_states(np.array([1.0, 2.0])[:, np.newaxis], [2.0, 4.0, 8.0], 0.8)
    data = states.to_dataset()
    assert dict(data.sizes) == {"branch": 2, "grid_0": 2, "grid_1": 3}
    assert data["branch"].values.tolist() == [1, 2]
    assert all("units" in data[name].attrs for name in data.data_vars)
    assert data["phase"].attrs["units"] == "rad"
    assert data["region"].attrs["flag_values"] == [1, 2, 3, 4, 5]
    assert len(data["region"].attrs["flag_meanings"].split()) == 5
    assert data["phase"].dims == ("branch", "grid_0", "grid_1")
    assert data["existence_amplitude"].dims == ("grid_0", "grid_1")
    for name in ("phase", "velocity", "peak", "stable", "admissible", "region"):
        np.testing.assert_array_equal(data[name].values, getattr(states, name))
    assert float(data["velocity"].sel(branch=1)[1, 1]) == states.velocity[0, 1, 1]


def test_a_dataset_without_shapes_leaves_out_what_was_not_computed() -> None:
    data = steady_states(2.0, 4.0, 0.8, shapes=False).to_dataset()
    assert "phase" in data
    assert not {"peak", "admissible", "stable"} & set(data.data_vars)


# ------------------------------------------------------------------------- one whole period


@given(points, st.sampled_from([1, 2]))
@settings(max_examples=50)
def test_an_orbit_closes_mirrors_itself_and_obeys_equation_4(
    point: tuple[float, float, float, int], branch: int
) -> None:
    a, w, r, n = point
    assume(n * math.pi / w < 15.0)
    states = states_at(point)
    assume(states.region != 4)
    samples = 4001
    orbit = steady_orbit(a, w, r, order=n, branch=branch, samples=samples)
    assert orbit.tau.shape == orbit.angle.shape == orbit.velocity.shape == (samples,)
    assert orbit.tau[[0, -1]] == pytest.approx([0.0, 2.0 * n * math.pi])
    half = samples // 2
    scale = np.abs(orbit.angle).max() + a / (1.0 + w * w)
    assert np.abs(orbit.angle[[0, half, -1]]).max() < 1e-11 * (1.0 + scale)
    np.testing.assert_array_equal(orbit.angle[half + 1 :], -orbit.angle[1 : half + 1])
    np.testing.assert_array_equal(orbit.velocity[half + 1 :], -orbit.velocity[1 : half + 1])
    assert orbit.velocity[0] == pytest.approx(states.velocity[branch - 1], rel=1e-9, abs=1e-14)
    # after the impact at the end of the half cycle the velocity is the first one mirrored (eq 9)
    assert r * orbit.velocity[half] == pytest.approx(
        -orbit.velocity[0], rel=1e-9, abs=1e-12 * (1.0 + scale)
    )
    # eqs 4 and 5 by differences: Omega^2 u'' = u - sign + a(tau)
    step = orbit.tau[1]
    u = orbit.angle[: half + 1]
    second = (u[2:] - 2.0 * u[1:-1] + u[:-2]) / step**2
    base = a * np.sin(orbit.tau[1:half] + states.phase[branch - 1])
    np.testing.assert_allclose(orbit.excitation[1:half], base, atol=1e-12 * (1.0 + a))
    error = np.abs(w * w * second - (u[1:-1] - 1.0 + base))
    fourth = 1.0 + a + np.abs(u).max() + a * w * w  # bound of d4u/ds4
    bound = fourth * (step / w) ** 2 / 10.0 + 1e-13 * (1.0 + scale) * (w / step) ** 2
    assert error.max() <= bound
    # and the velocity is the angle's derivative
    slope = (u[2:] - u[:-2]) / (2.0 * step)
    third = (np.abs(orbit.velocity).max() * w + a * w) / w**3
    np.testing.assert_allclose(
        orbit.velocity[1:half], slope, atol=third * step**2 + 1e-12 * (1.0 + scale) / step
    )


def test_an_orbit_where_none_exists_is_refused_with_the_least_amplitude() -> None:
    with pytest.raises(InputError, match=r"^amplitude = 0\.2 .*0\.260201"):
        steady_orbit(0.2, 4.0, 0.8)


@pytest.mark.parametrize("branch", [0, 3, -1])
def test_an_orbit_of_a_third_branch_is_refused(branch: int) -> None:
    with pytest.raises(InputError, match="two branches"):
        steady_orbit(2.0, 4.0, 0.8, branch=branch)


@pytest.mark.parametrize("samples", [2, 4, 1, 0, -5])
def test_samples_of_an_orbit_must_be_odd_and_three_at_least(samples: int) -> None:
    with pytest.raises(InputError, match=r"^samples = "):
        steady_orbit(2.0, 4.0, 0.8, samples=samples)


# --------------------------------------------------------------------------- in a simulation


@pytest.mark.parametrize(
    "point",
    [
        (2.0, 4.0, 0.8, 1),
        (2.0, 6.0, 0.8, 3),
        (3.0, 8.0, 0.95, 3),
        (1.0, 2.0, 0.5, 1),
        (0.75, 4.0, 0.5, 1),
        (1.7, 6.0, 0.8, 3),
    ],
)
def test_a_stable_steady_state_is_kept(point: tuple[float, float, float, int]) -> None:
    a, w, r, n = point
    states = states_at(point)
    run = simulate(
        DimensionlessBlock(restitution=r),
        Harmonic(amplitude=a, frequency_ratio=w),
        start=Steady(order=n),
        cycles=60 * n + 0.25,
    )
    assert run.status.label == "rocking"
    assert len(run.impacts) == 120
    assert run.peak == pytest.approx(checked(states.peak)[0], abs=1e-12)
    np.testing.assert_allclose(run.impacts.s, np.arange(1, 121) * n * math.pi / w, rtol=1e-12)
    np.testing.assert_allclose(
        np.abs(run.impacts.velocity_after), w * states.velocity[0], rtol=1e-11
    )


@pytest.mark.parametrize(
    ("point", "branch"),
    [((1.0, 1.0, 0.8, 1), 2), ((1.0, 2.0, 0.8, 1), 2), ((2.0, 5.0, 0.8, 3), 2)],
)
def test_an_unstable_steady_state_is_left_on_the_named_side(
    point: tuple[float, float, float, int], branch: int
) -> None:
    a, w, r, n = point
    states = states_at(point)
    velocity = w * float(states.velocity[branch - 1])
    growth = float(abs(states.multipliers[branch - 1, 0]))
    runs = {}
    for side in (1, -1):
        runs[side] = simulate(
            DimensionlessBlock(restitution=r),
            Harmonic(amplitude=a, frequency_ratio=w),
            start=Steady(branch=branch, order=n),
            cycles=40 * n,
            side=side,
        )
        departure = np.abs(runs[side].impacts.velocity_after) - velocity
        # the first few half cycles multiply the distance by the multiplier ...
        assert abs(departure[2] / departure[1]) == pytest.approx(growth, rel=1e-2)
        # ... and it begins on its side, with more velocity or less
        begin = runs[side](0.0)
        assert math.copysign(1.0, float(begin.velocity) - velocity) == side
        # along the unstable direction: from the very first half cycle on it only grows
        first_step = departure[0] / (float(begin.velocity) - velocity)
        assert abs(first_step) == pytest.approx(growth, rel=1e-2)
        # in the end it is far away
        assert abs(departure[:40]).max() > 0.1 * velocity
    first, second = (runs[side].impacts.velocity_after for side in (1, -1))
    assert abs(abs(first[3]) - abs(second[3])) > 1e-4 * velocity
    assert len(first) != len(second) or not np.allclose(first, second)


def test_leaving_along_the_unstable_direction_is_symmetric_to_first_order() -> None:
    states = steady_states(1.0, 2.0, 0.8)
    velocity = 2.0 * states.velocity[1]
    departures = [
        np.abs(
            simulate(
                DimensionlessBlock(restitution=0.8),
                Harmonic(amplitude=1.0, frequency_ratio=2.0),
                start=Steady(branch=2),
                cycles=2,
                side=side,
            ).impacts.velocity_after[:3]
        )
        - velocity
        for side in (1, -1)
    ]
    np.testing.assert_allclose(departures[0], -departures[1], rtol=0.01)
