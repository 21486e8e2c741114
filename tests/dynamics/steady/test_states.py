"""Steady states against published numbers and against the formulae."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Pulse,
    find_orbits,
    find_steady_states,
)
from rocksteady.errors import InputError, ModelError, RocksteadyError
from rocksteady.formulas import steady_states
from rocksteady.model.equations import Linear
from rocksteady.motions import FourierSeries
from rocksteady.orbits import compute_steady_orbit
from tests.dynamics.formulae import (
    half_cycle,
    numbers,
    printed,
    printed_boundaries,
    printed_region,
)
from tests.dynamics.points import checked, orders, points, states_at
from tests.every import every
from tests.published import TW1
from tests.strategies import logarithmic

# ------------------------------------------------------------------------ published numbers


@every(("point", "phase", "velocity", "peak"), TW1)
def test_tw1_phase_velocity_and_peak(
    point: tuple[float, float, float, int], phase: float, velocity: float, peak: float
) -> None:
    states = states_at(point)
    assert states.phase[0] == pytest.approx(phase, abs=5.1e-11)
    assert states.velocity_tau[0] == pytest.approx(velocity, abs=5.1e-11)
    assert checked(states.peak)[0] == pytest.approx(peak, abs=5.1e-11)
    assert states.stable[0]


@every(
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


@every(("amplitude", "frequency_ratio"), [(1.0, 4.0), (1.0, 6.0), (1.0, 16.0), (2.0, 12.0)])
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


@every(
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


@every(
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
    assert abs(states.half_cycle_multipliers[1, 0]) == pytest.approx(
        multiplier, abs=0.51 * 10.0**-decimals
    )
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
    assert states.half_cycle_multipliers[0, 0] == pytest.approx(-1.182, abs=5.1e-4)


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
        assert np.isnan(
            [states.phase, states.velocity_tau, states.trace, checked(states.peak)]
        ).all()
        assert np.isnan(states.half_cycle_multipliers.real).all()
        assert not (checked(states.admissible) | states.stable | states.neutral).any()
        return
    h, beta, p, q = numbers(a, w, r, n)
    # What the printed forms lose: S is a difference, v the difference of h/Omega and the rest.
    lost = 1e-15 * (1.0 + p * p) / min(1.0, 1.0 + p * p - q * q)
    for branch in (1, 2):
        expected = printed(a, w, r, n, branch)
        phase, velocity = states.phase[branch - 1], states.velocity_tau[branch - 1]
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
    states = steady_states(a, w, r, order=n, with_shapes=False)
    assert (states.region != 4).all()
    end, shrunk = np.tanh(n * math.pi / w), 1.0 / np.cosh(np.minimum(n * math.pi / w, 700.0))
    beta = a / (1.0 + w * w)
    sine, cosine = np.sin(states.phase), np.cos(states.phase)
    sinh_part, cosh_part = w * (states.velocity_tau + beta * cosine), beta * sine - 1.0
    landing = sinh_part * end + cosh_part + (1.0 + beta * sine) * shrunk
    bounce = (
        r * (sinh_part + cosh_part * end) + (r * beta * cosine + states.velocity_tau) * w * shrunk
    )
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
        phase, velocity = states.phase[which], states.velocity_tau[which]
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
        _, angle = half_cycle(a, w, n, states.phase[which], states.velocity_tau[which], 20_001)
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
    assert (states.velocity_tau[1] < 0.0).all()
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
    assert (states.velocity_tau > 0.0).all()
    assert bool(states.in_phase[0]) is bool(states.region == 3)
    assert kind > existence  # E8: region 3 never vanishes


def test_the_states_of_a_block_under_a_motion_are_those_of_the_closed_form() -> None:
    sized = Block.rectangle(width=0.4, height=2.0)
    bare = DimensionlessBlock(restitution=0.8)
    motion = Harmonic(amplitude=3.0, frequency_ratio=5.0, phase=0.7)
    for block in (sized, bare):
        found = find_steady_states(block, motion, order=[1, 3], model="linear")
        assert (found.model, found.closed_form) == (Linear(), None)
        expected = steady_states(3.0, 5.0, block.dimensionless().restitution, order=[1, 3])
        for name in ("phase", "velocity", "peak", "admissible", "stable", "region"):
            np.testing.assert_array_equal(getattr(found, name), getattr(expected, name))
    assert "°" in find_steady_states(sized, motion).summary()
    assert "°" not in find_steady_states(bare, motion).summary()
    assert "velocity_deg_s" in find_steady_states(sized, motion).to_dataframe()


def test_a_block_without_symmetric_states_and_a_motion_of_another_kind_are_refused() -> None:
    motion = Harmonic(amplitude=3.0, frequency_ratio=5.0)
    wall = DimensionlessBlock(restitution=0.5, one_sided=True)
    with pytest.raises(ModelError, match=r"block stands against a wall"):
        find_steady_states(wall, motion)
    pulse: Any = Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=2.0)
    series: Any = FourierSeries(amplitude=2.0, frequency_ratio=2.0, harmonics=((3, 0.2, 0.0),))
    for other in (pulse, series):
        with pytest.raises(RocksteadyError, match="motion = "):
            find_steady_states(DimensionlessBlock(restitution=0.8), other)
    with pytest.raises(InputError, match="order = 2"):
        find_steady_states(DimensionlessBlock(restitution=0.8), motion, order=2)


def test_below_what_squares_hold_the_states_are_those_of_vanishing_shaking() -> None:
    limit = steady_states(1e-100, [2.0, 1e4], 1.0, order=[1, 10_001])
    for amplitude in (1e-150, 1e-160, 5e-324):
        states = steady_states(amplitude, [2.0, 1e4], 1.0, order=[1, 10_001])
        assert states.peak == pytest.approx(limit.peak, rel=1e-13)
        assert states.velocity == pytest.approx(limit.velocity, rel=1e-13)
        assert states.phase.tolist() == [[math.pi, math.pi], [0.0, 0.0]]
        assert states.amplitude.tolist() == [amplitude, amplitude]
        course = compute_steady_orbit(amplitude, 2.0, 1.0, branch=2)
        assert course.angle.max() == pytest.approx(0.245060291285869, abs=1e-14)


def test_a_solution_that_goes_downwards_has_its_sign_here_and_its_modulus_as_an_orbit() -> None:
    states = steady_states(6.0, 8.0, 0.8)
    assert states.velocity[1] < 0.0
    assert states.admissible is not None
    assert not states.admissible[1]
    motion = Harmonic(amplitude=6.0, frequency_ratio=8.0)
    orbits = find_orbits(
        DimensionlessBlock(restitution=0.8), motion, max_period=1, max_impacts=2, seeds=4
    )
    (orbit,) = (each for each in orbits if each.branch == 2)
    assert [each.speed for each in orbit.states] == pytest.approx(2 * [-states.velocity[1]])
