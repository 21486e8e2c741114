"""What runs settle to: against a slow comparison of sampled angles, and published attractors."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import DimensionlessBlock, Harmonic, Rest, State, Status, Steady, simulate
from rocksteady.formulas import steady_states
from rocksteady.histories import Trajectory
from rocksteady.studies.tso_wong_1989.figures.fates import Fate, Kind, fates_over_kicks, settle
from tests.dynamics.integrator import integrate
from tests.every import every

BLOCK = DimensionlessBlock(restitution=0.8)


def shaking(a: float, w: float, phase: float = 0.0) -> Harmonic:
    return Harmonic(amplitude=a, frequency_ratio=w, phase=phase)


def settled(a: float, w: float, *, side: int = -1, **start: Any) -> Fate:
    return settle(0.8, shaking(a, w), Steady(side=side, **start))


# ------------------------------------------------------------------------------ known attractors


@every(
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


@every(
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
    assert fate.highest == pytest.approx(float(states.peak[0]), abs=1e-12)
    assert fate.lowest == pytest.approx(-float(states.peak[0]), abs=1e-12)


def test_a_block_that_falls_and_one_that_stays() -> None:
    fallen = settled(2.0, 1.7)
    run = simulate(BLOCK, shaking(2.0, 1.7), start=Steady(side=-1), cycles=100)
    assert fallen.kind is Kind.OVERTURNED
    assert run.overturn_time_tau is not None
    assert fallen.overturned_after == pytest.approx(run.overturn_time_tau / (2.0 * math.pi))
    assert fallen.label == f"overturns after {fallen.overturned_after:.1f} periods"
    assert (fallen.period, fallen.bias) == (0, 0)
    rest = settle(0.8, shaking(0.5, 4.0), State(angle=0.0, velocity=0.1))
    assert (rest.kind, rest.label, rest.bias) == (Kind.REST, "at rest", 0)
    assert math.isnan(rest.highest)
    assert math.isnan(rest.overturned_after)


def test_an_aperiodic_motion_is_not_settled() -> None:
    fate = settle(0.5, shaking(1.7347, 1.6633), Rest())
    assert (fate.kind, fate.label, fate.period) == (Kind.UNSETTLED, "not settled", 0)


# ------------------------------------------------------------------------------------- oracles

SAMPLES = 64
LONGEST = 12


def compared(run: Trajectory) -> tuple[str, int, bool]:
    """Outcome, period and symmetry from angles sampled over the last periods of a long run."""
    if run.status in (Status.OVERTURNED, Status.AT_REST):
        return run.status.label, 0, False
    unit = 2.0 * math.pi / run.frequency_ratio
    back = np.arange(2 * LONGEST * SAMPLES, -1, -1)
    angle = run(run.end_time_pt - back * (unit / SAMPLES)).angle
    last = angle[LONGEST * SAMPLES :]

    def earlier(samples: int) -> Any:
        return angle[LONGEST * SAMPLES - samples : len(angle) - samples]

    for period in range(1, LONGEST + 1):
        if np.abs(last - earlier(period * SAMPLES)).max() < 1e-7:
            mirrored = np.abs(last + earlier(period * SAMPLES // 2)).max() < 1e-6
            return "periodic", period, bool(mirrored)
    return "unsettled", 0, False


@every("seed", range(4))
def test_period_and_symmetry_are_those_of_the_sampled_angle(seed: int) -> None:
    rng = np.random.default_rng(seed)
    known = {Kind.OVERTURNED: "overturned", Kind.REST: "at-rest"}
    for _ in range(25):
        a, w, velocity = rng.uniform(0.5, 5.0), rng.uniform(1.0, 9.0), rng.uniform(-1.2, 1.2)
        start = State(angle=0.0, velocity=velocity)
        run = simulate(BLOCK, shaking(a, w, 0.4), start=start, cycles=600)
        fate = settle(0.8, shaking(a, w, 0.4), start)
        outcome, period, mirrored = compared(run)
        if outcome in ("unsettled", "at-rest") and fate.orbit is not None:
            continue  # slow, or a rest from which it lifts again
        assert known.get(fate.kind, "periodic") == outcome
        assert (fate.period, fate.symmetric) == (period, mirrored)
        if period:
            unit = 2.0 * math.pi / w
            angle = run(run.end_time_pt - np.linspace(0.0, period * unit, 400)).angle
            assert angle.max() <= fate.highest + 1e-7
            assert angle.min() >= fate.lowest - 1e-7
            assert angle.max() > fate.highest - 0.02


@pytest.mark.slow
@every(
    ("a", "w", "order", "branch", "kick"),
    [(2.0, 1.9, 1, 1, 1e-2), (4.0, 6.0, 3, 1, 1e-1), (2.0, 5.0, 3, 2, 1e-2)],
)
def test_an_integrator_started_on_the_motion_stays_there(
    a: float, w: float, order: int, branch: int, kick: float
) -> None:
    fate = settled(a, w, order=order, branch=branch, kick=kick, side=1)
    assert fate.orbit is not None
    first = fate.orbit.states[0]
    unit = 2.0 * math.pi / w
    later = integrate(
        lambda s: a * math.sin(w * s + first.phase),
        30.0 * unit,
        alpha=1.0,
        p=1.0,
        restitution=0.8,
        angle=0.0,
        velocity=first.side * first.speed,
        longest_step=0.01 * unit,
    )
    last = later.times > later.times[-1] - fate.period * unit
    assert later.angles[last].max() == pytest.approx(fate.highest, abs=1e-4)
    assert later.angles[last].min() == pytest.approx(fate.lowest, abs=1e-4)
    gaps = np.diff(np.array(later.impacts[-24:]))
    np.testing.assert_allclose(gaps[2:], gaps[:-2], atol=1e-5)
    assert gaps[:2].sum() == pytest.approx(fate.period * unit, abs=1e-5)


# ------------------------------------------------------------------------------------ symmetry


def test_the_two_sides_of_an_orbit_that_loses_its_symmetry_lead_to_mirror_images() -> None:
    # Its multiplier is negative: half a cycle later one side is the other, mirrored.
    for w, order in ((1.9, 1), (4.2, 3)):
        for kick in (1e-6, 1e-3):
            one, other = (settled(2.0, w, order=order, kick=kick, side=side) for side in (1, -1))
            assert one.bias == -other.bias != 0
            assert (one.kind, one.period) == (other.kind, other.period)
            assert one.highest == pytest.approx(-other.lowest, abs=1e-9)
            assert one.lowest == pytest.approx(-other.highest, abs=1e-9)


def test_a_mirrored_start_has_the_mirrored_fate() -> None:
    for phase, velocity in ((0.3, 0.4), (2.0, 0.7), (1.0, -0.2)):
        one, other = (
            settle(
                0.8,
                shaking(2.0, 1.9, phase + turn),
                State(angle=0.0, velocity=sign * velocity),
            )
            for turn, sign in ((0.0, 1.0), (math.pi, -1.0))
        )
        assert (one.kind, one.period, one.symmetric) == (other.kind, other.period, other.symmetric)
        assert one.bias == -other.bias
        if one.period:
            assert one.highest == pytest.approx(-other.lowest, abs=1e-9)


@every(
    ("a", "w", "order", "branch", "side", "kinds"),
    [
        (1.0, 2.0, 1, 2, 1, {Kind.OVERTURNED, Kind.SYMMETRIC}),
        (1.0, 2.0, 1, 2, -1, {Kind.REST, Kind.SYMMETRIC}),
        (2.0, 5.0, 3, 2, 1, {Kind.SUBHARMONIC}),
        (2.0, 1.948, 1, 1, -1, {Kind.UNSETTLED, Kind.UNSYMMETRIC}),
    ],
)
def test_fates_over_distances_are_those_of_each_distance(
    a: float, w: float, order: int, branch: int, side: int, kinds: set[Kind]
) -> None:
    kicks = np.geomspace(1e-6, 1e-2, 9)
    start = Steady(branch=branch, order=order, kick=0.1, side=side)
    fates = fates_over_kicks(0.8, shaking(a, w), start, kicks=kicks)
    assert {fate.kind for fate in fates} == kinds
    for kick, fate in zip(kicks.tolist(), fates, strict=True):
        alone = settled(a, w, branch=branch, order=order, kick=kick, side=side)
        # One at a time and as cells of a map they are one motion, to rounding.
        for name, value in {**vars(alone), "orbit": None}.items():
            if isinstance(value, float):
                assert getattr(fate, name) == pytest.approx(value, abs=1e-9, nan_ok=True)
            else:
                assert getattr(fate, name) == value
        assert (fate.label, fate.bias) == (alone.label, alone.bias)


def test_a_motion_next_to_its_loss_of_symmetry_is_not_taken_for_settled() -> None:
    # Its multiplier is -1.0018: after hundreds of periods it still is next to the symmetric one.
    assert settled(2.0, 1.948, kick=1e-6).kind is Kind.UNSETTLED
    fate = settled(2.0, 1.948, kick=0.05)
    assert fate.kind is Kind.UNSYMMETRIC
    assert abs(fate.highest + fate.lowest) > 1e-3
