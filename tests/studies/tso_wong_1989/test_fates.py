"""What runs settle to: against an integrator, published attractors, and the mirrored run."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    DimensionlessBlock,
    Harmonic,
    State,
    Steady,
    Trajectory,
    simulate,
    steady_states,
)
from rocksteady.studies.tso_wong_1989.fates import (
    LONGEST_PERIOD,
    RUNS,
    SETTLED,
    Fate,
    Kind,
    fate_of,
    fates_over_kicks,
    settle,
)
from tests.dynamics.integrator import integrate

BLOCK = DimensionlessBlock(restitution=0.8)


def shaking(a: float, w: float, phase: float = 0.0) -> Harmonic:
    return Harmonic(amplitude=a, frequency_ratio=w, phase=phase)


def settled(a: float, w: float, *, side: int = -1, **start: Any) -> Fate:
    return settle(0.8, shaking(a, w), Steady(**start), side=side)


# ------------------------------------------------------------------------------ known attractors


@pytest.mark.parametrize(
    ("a", "w", "order", "highest", "lowest", "accuracy"),
    [
        (2.0, 1.9, 1, 0.90035, -0.44427, 5.1e-6),
        (2.0, 1.85, 1, 1.01036, -0.36025, 1.1e-5),
        (2.0, 1.8, 1, 1.0976, -0.2997, 5.1e-5),
        (2.0, 4.2, 3, 0.53129, -0.44713, 5.1e-6),
        (4.0, 6.0, 3, 0.39815, -0.27242, 1.1e-5),
    ],
)
def test_unsymmetric_attractors_have_the_reference_peaks(
    a: float, w: float, order: int, highest: float, lowest: float, accuracy: float
) -> None:
    fate = settled(a, w, order=order, kick=1e-4)
    assert fate.period == order
    assert not fate.symmetric
    assert fate.kind is (Kind.UNSYMMETRIC if order == 1 else Kind.SUBHARMONIC)
    peaks = (fate.highest, fate.lowest)
    if fate.bias < 0:
        peaks = (-fate.lowest, -fate.highest)
    assert peaks == pytest.approx((highest, lowest), abs=accuracy)


@pytest.mark.parametrize(("w", "order"), [(1.78, 1), (4.06, 3)])
def test_beyond_the_unsymmetric_motion_its_period_is_doubled(w: float, order: int) -> None:
    fate = settled(2.0, w, order=order, kick=1e-3)
    assert (fate.kind, fate.period, fate.symmetric) == (Kind.SUBHARMONIC, 2 * order, False)
    assert fate.label == f"unsymmetric 1/{2 * order} subharmonic"


def test_beyond_the_doublings_the_harmonic_motion_overturns_and_the_subharmonic_does_not() -> None:
    assert settled(2.0, 1.765).kind is Kind.OVERTURNED
    assert settled(2.0, 4.03, order=3).kind is Kind.SYMMETRIC


@pytest.mark.parametrize(
    ("a", "w", "order", "name"),
    [
        (2.0, 4.0, 1, "symmetric harmonic"),
        (6.0, 4.0, 1, "symmetric harmonic"),
        (2.0, 6.0, 3, "symmetric 1/3 subharmonic"),
    ],
)
def test_a_stable_closed_form_is_its_own_fate(a: float, w: float, order: int, name: str) -> None:
    states = steady_states(a, w, 0.8, order=order)
    assert states.peak is not None
    assert states.stable[0]
    fate = settled(a, w, order=order)
    assert (fate.label, fate.period, fate.symmetric, fate.bias) == (name, order, True, 0)
    assert fate.highest == pytest.approx(float(states.peak[0]), abs=1e-9)
    assert fate.lowest == pytest.approx(-float(states.peak[0]), abs=1e-9)
    assert fate.run.end_s * w / (2.0 * math.pi) == pytest.approx(RUNS[0]), "the shortest will do"


def test_a_symmetric_state_that_is_not_harmonic_repeats_after_no_shorter_time() -> None:
    run = simulate(BLOCK, shaking(2.0, 6.0), start=Steady(order=3), cycles=60)
    unit = 2.0 * math.pi / 6.0
    times = run.end_s - np.linspace(3.0, 6.0, 50) * unit
    angle = run(times).angle
    for periods in (1, 2):
        assert np.abs(run(times + periods * unit).angle - angle).max() > 0.1
    np.testing.assert_allclose(run(times + 3 * unit).angle, angle, atol=1e-9)
    np.testing.assert_allclose(run(times + 1.5 * unit).angle, -angle, atol=1e-9)
    assert fate_of(run).period == 3


def test_a_block_that_falls_and_one_that_stays() -> None:
    fallen = settled(2.0, 1.7)
    assert fallen.kind is Kind.OVERTURNED
    assert fallen.run.overturn_tau is not None
    assert fallen.overturned_after == pytest.approx(fallen.run.overturn_tau / (2.0 * math.pi))
    assert fallen.label == f"overturns after {fallen.overturned_after:.1f} periods"
    assert (fallen.period, fallen.bias) == (0, 0)
    rest = fate_of(simulate(BLOCK, shaking(0.5, 4.0), start=State(angle=0.0, velocity=0.1)))
    assert (rest.kind, rest.label, rest.bias) == (Kind.REST, "at rest", 0)
    assert math.isnan(rest.highest)
    assert math.isnan(rest.overturned_after)


def test_a_run_too_short_to_tell_is_not_settled() -> None:
    def fate(cycles: float) -> Kind:
        return fate_of(simulate(BLOCK, shaking(2.0, 4.0), start=Steady(), cycles=cycles)).kind

    assert fate(2 * LONGEST_PERIOD - 1) is Kind.UNSETTLED
    assert fate(2 * LONGEST_PERIOD + 1) is Kind.SYMMETRIC


def test_a_run_on_its_way_is_not_settled_yet() -> None:
    start = State(angle=0.0, velocity=0.3)
    short = fate_of(simulate(BLOCK, shaking(2.0, 4.0), start=start, cycles=30))
    long = fate_of(simulate(BLOCK, shaking(2.0, 4.0), start=start, cycles=300))
    assert (short.kind, long.kind) == (Kind.UNSETTLED, Kind.SYMMETRIC)
    assert short.label == "not settled"


# ------------------------------------------------------------------------------------- oracles


def brute_period(angle: Any, samples: int) -> int:
    """Smallest number of periods after which sampled angles repeat themselves."""
    for period in range(1, 13):
        if np.abs(angle[: -period * samples] - angle[period * samples :]).max() < 1e-5:
            return period
    return 0


@pytest.mark.parametrize(
    ("a", "w", "order", "kick"),
    [(2.0, 1.9, 1, 1e-2), (4.0, 6.0, 3, 1e-1), (2.0, 5.0, 3, 1e-2)],
)
def test_an_integrator_started_late_in_the_run_settles_to_the_same(
    a: float, w: float, order: int, kick: float
) -> None:
    branch = 2 if w == 5.0 else 1
    fate = settle(0.8, shaking(a, w), Steady(order=order, branch=branch, kick=kick), side=1)
    run = fate.run
    assert isinstance(run.motion, Harmonic)
    phase = run.motion.phase
    impacts = run.impacts
    first = int(np.searchsorted(impacts.s, run.end_s - 40.0 * 2.0 * math.pi / w))
    began, speed = float(impacts.s[first]), float(impacts.velocity_after[first])
    unit = 2.0 * math.pi / w
    later = integrate(
        lambda s: a * math.sin(w * (s + began) + phase),
        30.0 * unit,
        alpha=1.0,
        p=1.0,
        restitution=0.8,
        angle=0.0,
        velocity=speed,
        longest_step=0.01 * unit,
    )
    last = later.times > later.times[-1] - fate.period * unit
    assert later.angles[last].max() == pytest.approx(fate.highest, abs=1e-4)
    assert later.angles[last].max() <= fate.highest + 1e-7
    assert later.angles[last].min() == pytest.approx(fate.lowest, abs=1e-4)
    landings = np.array(later.impacts[-24:])
    gaps = np.diff(landings)
    per_period = 2  # impacts in a repetition of these motions
    np.testing.assert_allclose(gaps[per_period:], gaps[:-per_period], atol=1e-5)
    assert (gaps[:2].sum()) == pytest.approx(fate.period * unit, abs=1e-5)


@pytest.mark.parametrize("seed", range(4))
def test_period_and_symmetry_are_those_of_the_sampled_angle(seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, w = rng.uniform(1.5, 4.0), rng.uniform(3.0, 9.0)
    for velocity in rng.uniform(-1.0, 1.0, 12):
        run = simulate(
            BLOCK, shaking(a, w, 0.4), start=State(angle=0.0, velocity=velocity), cycles=400
        )
        fate = fate_of(run)
        if fate.period == 0:
            continue
        unit = 2.0 * math.pi / w
        times = run.end_s - np.arange(36 * 30, -1, -1) * (unit / 36)
        angle = run(times).angle
        assert brute_period(angle, 36) == fate.period
        half = fate.period * 18
        mirrored = bool(np.abs(angle[:-half] + angle[half:]).max() < 1e-5)
        assert mirrored == fate.symmetric
        period = angle[-36 * fate.period - 1 :]
        assert period.max() <= fate.highest + 1e-7
        assert period.min() >= fate.lowest - 1e-7
        assert period.max() > fate.highest - 0.02


# ------------------------------------------------------------------------------------ symmetry


def test_the_two_sides_of_an_orbit_that_loses_its_symmetry_lead_to_mirror_images() -> None:
    # Its multiplier is negative: half a cycle later one side is the other, mirrored.
    for w, order in ((1.9, 1), (4.2, 3)):
        for kick in (1e-6, 1e-3):
            one, other = (settled(2.0, w, order=order, kick=kick, side=side) for side in (1, -1))
            assert one.bias == -other.bias != 0
            assert (one.kind, one.period) == (other.kind, other.period)
            assert one.highest == pytest.approx(-other.lowest, abs=1e-6)
            assert one.lowest == pytest.approx(-other.highest, abs=1e-6)


def test_a_mirrored_run_has_the_mirrored_fate() -> None:
    for phase, velocity in ((0.3, 0.4), (2.0, 0.7), (1.0, -0.2)):
        one, other = (
            fate_of(
                simulate(
                    BLOCK,
                    shaking(2.0, 1.9, phase + turn),
                    start=State(angle=0.0, velocity=sign * velocity),
                    cycles=400,
                )
            )
            for turn, sign in ((0.0, 1.0), (math.pi, -1.0))
        )
        assert (one.kind, one.period, one.symmetric) == (other.kind, other.period, other.symmetric)
        assert one.bias == -other.bias
        if one.period:
            assert one.highest == pytest.approx(-other.lowest, abs=1e-7)


def test_fates_over_distances_are_those_of_each_distance() -> None:
    kicks = (1e-6, 1e-4, 1e-2)
    start = Steady(branch=2, order=3, kick=0.1)
    fates = fates_over_kicks(0.8, shaking(2.0, 5.0), start, side=-1, kicks=kicks)
    for kick, fate in zip(kicks, fates, strict=True):
        alone = settled(2.0, 5.0, branch=2, order=3, kick=kick, side=-1)
        assert (fate.kind, fate.highest) == (alone.kind, alone.highest)
        np.testing.assert_array_equal(fate.run.rows, alone.run.rows)


def test_a_longer_run_is_followed_where_the_shorter_one_has_not_settled() -> None:
    def cycles(run: Trajectory, w: float) -> float:
        return run.end_s * w / (2.0 * math.pi)

    near = settled(2.0, 1.9475, kick=1e-4)  # just beyond symmetry breaking: slow
    assert cycles(near.run, 1.9475) > RUNS[0] + 1
    far = settled(2.0, 1.9, kick=1e-2)
    assert cycles(far.run, 1.9) == pytest.approx(RUNS[0], abs=1.0)
    assert SETTLED < 1e-5
