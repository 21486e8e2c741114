"""What a motion settles to, in the kernel: closed forms, long runs, falls, rests, chaos."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.core.queue import LEFT_OVER
from rocksteady.kernels.core.tables import March
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.march.march import march
from rocksteady.kernels.orbits.closed_form import existence_amplitude, symmetric_orbit
from rocksteady.kernels.orbits.periodic import ORBIT_COLUMNS, distance, mirror, state_at
from rocksteady.kernels.orbits.return_map import (
    FALL,
    GRAZE,
    IMPACT,
    STAY,
    STUCK,
    UPLIFT,
    AnyState,
    Jacobian,
    Section,
    next_passage,
    phase_between,
    shifted,
)
from rocksteady.kernels.orbits.settle import (
    ARRIVED,
    FALLS,
    MEMORY,
    PERIODIC,
    STAYS,
    UNSETTLED,
    Settled,
    Stretch,
    arrives,
    rate_of,
    returns_to,
    settle,
    stretched,
)
from rocksteady.kernels.orbits.systems import System, make_system
from tests.every import every
from tests.kernels.passages import LOPSIDED, even_system, state_at_phase
from tests.kernels.tables import NONE, both_sides, harmonic
from tests.strategies import sample_size

Floats = NDArray[np.float64]
TWO_PI = 2.0 * math.pi


def settled_from(
    system: System,
    side: int,
    phase: float,
    angle: float,
    velocity: float,
    periods: int = 2000,
) -> tuple[Settled, Floats]:
    half, rest = clock(phase)
    memory, table = (np.zeros((MEMORY, ORBIT_COLUMNS)) for _ in range(2))
    found = settle(system, AnyState(side, half, rest, angle, velocity), periods, memory, table)
    return found, table[: found.passages]


# amplitude, frequency, restitution, order of a stable symmetric orbit of branch 1
STABLE = [
    (2.0, 4.0, 0.8, 1),
    (2.0, 6.0, 0.8, 3),
    (3.0, 8.0, 0.95, 3),
    (1.0, 2.0, 0.5, 1),
    (0.75, 4.0, 0.5, 1),  # E2: in phase, and stable
    (1.7, 6.0, 0.8, 3),
]


@every(("amplitude", "frequency", "restitution", "order"), STABLE)
def test_near_a_stable_symmetric_orbit_a_motion_settles_to_it(
    amplitude: float, frequency: float, restitution: float, order: int
) -> None:
    orbit = symmetric_orbit(amplitude, frequency, restitution, order, 1)
    first = state_at_phase(1, orbit.phase, frequency * orbit.velocity)
    system = even_system(amplitude, frequency, restitution)
    for side in (1, -1):
        phase = orbit.phase + 2e-3 + (0.0 if side > 0 else math.pi)
        velocity = side * frequency * orbit.velocity * 1.003
        found, table = settled_from(system, side, phase, 0.0, velocity)
        assert found.outcome == PERIODIC
        assert (found.passages, found.periods, found.rests) == (2, order, 0)
        assert found.residual <= 1e-12
        state = state_at(table, 0)
        near = first if state.side > 0 else mirror(first, order)
        assert distance(near, state) < 1e-10
        # Per forcing period, from the closed trace.
        root = np.abs(np.roots([1.0, -orbit.trace, restitution**2])).max()
        assert found.lyapunov == pytest.approx(2.0 * math.log(root) / order, rel=1e-7)


@every(
    ("amplitude", "frequency", "order", "branch"),
    [(1.0, 2.0, 1, 2), (2.0, 5.0, 3, 2), (2.0, 1.9, 1, 1)],
)
def test_a_motion_that_starts_on_an_unstable_orbit_never_settles_to_that(
    amplitude: float, frequency: float, order: int, branch: int
) -> None:
    orbit = symmetric_orbit(amplitude, frequency, 0.8, order, branch)
    system = even_system(amplitude, frequency, 0.8)
    on = state_at_phase(1, orbit.phase, frequency * orbit.velocity)
    found, table = settled_from(system, 1, orbit.phase, 0.0, frequency * orbit.velocity)
    assert found.outcome in (PERIODIC, FALLS)
    for row in range(len(table)):
        assert distance(on, state_at(table, row)) > 1e-3
        assert distance(mirror(on, order), state_at(table, row)) > 1e-3


@pytest.mark.parametrize(("restitution", "lean", "rate"), LOPSIDED[:1] + LOPSIDED[2:])
def test_a_lopsided_block_settles_where_a_long_march_ends(
    restitution: tuple[float, float], lean: tuple[float, float], rate: tuple[float, float]
) -> None:
    amplitude, frequency = 1.1, 7.0
    sides = both_sides(restitution, lean, rate)
    system = make_system(amplitude, frequency, sides)
    found, table = settled_from(system, 1, 0.4, 0.0, 0.2)
    assert found.outcome == PERIODIC
    start = March(1, 0.0, 0.2, 0, *clock(0.4), 0, 0)
    none = np.zeros((0, 8))
    count = 800
    _, end = march(
        Tables(harmonic(amplitude, frequency), sides),
        start,
        Until(2**60, 0.0, 0.0, count),
        Kept(none, NONE),
    )
    last = Section(end.side, end.half_cycles, end.phase, abs(end.velocity))
    assert min(distance(last, state_at(table, k)) for k in range(found.passages)) < 1e-9


def test_an_upright_block_pushed_over_falls_and_a_still_base_lets_it_stay() -> None:
    system = even_system(0.5, 2.0, 0.8)
    assert settled_from(system, 1, 0.0, 0.9, 2.0)[0].outcome == FALLS
    still = even_system(0.0, 2.0, 0.8)
    found, _ = settled_from(still, -1, 0.0, -0.5, 0.0)
    assert (found.outcome, math.isnan(found.lyapunov)) == (STAYS, True)
    assert settled_from(system, 0, 0.0, 0.0, 0.0)[0].outcome == STAYS


@pytest.mark.parametrize(
    ("amplitude", "frequency", "restitution"), [(1.01, 2.0, 0.8), (1.05, 1.0, 0.3)]
)
def test_a_motion_that_rests_in_every_period_is_recognised_from_any_start(
    amplitude: float, frequency: float, restitution: float
) -> None:
    system = even_system(amplitude, frequency, restitution)
    sums = set()
    for phase, velocity in ((0.0, 0.0), (1.0, 0.01), (4.0, 0.02), (2.0, -0.015)):
        side = int(np.sign(velocity))
        found, table = settled_from(system, side, phase, 0.0, velocity)
        assert (found.outcome, found.periods, found.rests) == (PERIODIC, 1, 2)
        assert found.lyapunov == -math.inf
        if velocity == 0.0:  # lifted by A sin > 1, it is known when it lifts to that side again
            assert (found.after, found.state.side) == (1, 1)
        speeds = [state_at(table, k).speed for k in range(found.passages)]
        assert speeds.count(0.0) == 2
        sums.add(round(sum(speeds), 12))
    assert len(sums) == 1


def test_how_far_a_chaotic_motion_is_from_itself_grows_at_its_lyapunov_exponent() -> None:
    amplitude, frequency = 1.7347, 1.6633
    system = even_system(amplitude, frequency, 0.5)
    periods = sample_size(4000, 500)
    found, _ = settled_from(system, 0, 0.0, 0.0, 0.0, periods)
    assert found.outcome == UNSETTLED
    assert found.after >= periods
    # Two motions side by side, the second brought back to 1e-8 after every passage.
    state, along = Section(1, *clock(math.asin(1 / amplitude)), 0.0), (1.0, 0.0)
    first, stretched = 0, 0.0
    for step in range(2 * periods):
        after = next_passage(system, state, -1.0)
        near = next_passage(system, shifted(state, 1e-8 * along[0], 1e-8 * along[1]), -1.0)
        assert after.kind in (IMPACT, UPLIFT, GRAZE)
        if step == 100:
            first, stretched = after.state.half_cycles, 0.0
        along = (
            phase_between(after.state, near.state),
            near.state.speed - after.state.speed,
        )
        size = math.hypot(*along)
        if near.state.side != after.state.side or size == 0.0:
            along, size = (1.0, 0.0), 1e-8
        stretched += math.log(size / 1e-8)
        along = (along[0] / size, along[1] / size)
        state = after.state
    exponent = stretched / (0.5 * (state.half_cycles - first))
    assert exponent > 0.3
    assert found.lyapunov == pytest.approx(exponent, rel=sample_size(0.05, 0.2))


def test_what_a_motion_only_passes_by_it_does_not_arrive_at() -> None:
    # The two-impact orbit of Omega = 4 attracts; a state near the other branch leaves that.
    system = even_system(2.0, 4.0, 0.8)
    orbit = symmetric_orbit(2.0, 4.0, 0.8, 1, 1)
    stable = state_at_phase(1, orbit.phase, 4.0 * orbit.velocity)
    assert arrives(system, shifted(stable, 1e-3, 0.0), stable, 2, 0.7)
    other = symmetric_orbit(1.0, 2.0, 0.8, 1, 2)
    unstable = state_at_phase(1, other.phase, 2.0 * other.velocity)
    near = shifted(unstable, 100.0 * ARRIVED, 0.0)
    assert not arrives(even_system(1.0, 2.0, 0.8), near, unstable, 2, 0.7)
    # Nor does it on the other side, or where it falls.
    assert not arrives(system, mirror(stable, 1), stable, 2, 0.7)
    assert not arrives(system, Section(1, 0, 1.0, 9.0), stable, 2, 0.7)


@every("below", [1e-3, 1e-5, 1e-6])
def test_next_to_a_fold_the_unstable_branch_parts_what_arrives_from_what_does_not(
    below: float,
) -> None:
    # Both branches are then close, the stable one attracts weakly, and between them is the border.
    a = existence_amplitude(4.0, 0.8, math.tanh(math.pi / 8.0)) * (1.0 + below)
    system, (one, two) = (
        even_system(a, 4.0, 0.8),
        (symmetric_orbit(a, 4.0, 0.8, 1, branch) for branch in (1, 2)),
    )
    stable = state_at_phase(1, one.phase, 4.0 * one.velocity)
    largest = larger(one.trace, 0.8) ** 2
    assert 0.0 < 1.0 - largest < 0.2
    for share, arrived in ((0.5, True), (0.9, True), (1.1, False), (1.5, False), (-2.0, True)):
        begin = shifted(
            stable,
            share * (two.phase - one.phase),
            share * 4.0 * (two.velocity - one.velocity),
        )
        assert arrives(system, begin, stable, 2, largest) is arrived


def larger(trace: float, restitution: float) -> float:
    """Return the larger multiplier of a half cycle."""
    return 0.5 * trace + math.sqrt(0.25 * trace * trace - restitution**2)


@every("periods", [1, 3, 5])
def test_too_few_periods_leave_it_unsettled(periods: int) -> None:
    found, _ = settled_from(even_system(2.0, 4.0, 0.8), 0, 0.0, 0.0, 0.0, periods)
    assert found.outcome == UNSETTLED
    assert periods <= found.after <= periods + 1
    assert found.passages == 0


def test_a_small_difference_turns_and_grows_with_each_passage() -> None:
    rng = np.random.default_rng(8)
    for _ in range(20):
        matrix, start = rng.normal(size=(2, 2)), rng.normal(size=2)
        start /= np.linalg.norm(start)
        begun = Stretch(float(start[0]), float(start[1]), 0.7, 12)
        stretch = stretched(begun, Jacobian(*matrix.ravel().tolist()))
        image = matrix @ start
        size = np.linalg.norm(image)
        np.testing.assert_allclose(stretch[:2], image / size, rtol=1e-13)
        assert stretch.logarithm == pytest.approx(0.7 + math.log(size), rel=1e-13)
        assert stretch.since == 12
        for scale in (1e-200, 1e200):  # whose squares are no numbers
            far = stretched(begun, Jacobian(*(scale * matrix).ravel().tolist()))
            np.testing.assert_allclose(far[:2], image / size, rtol=1e-13)
            assert far.logarithm == pytest.approx(0.7 + math.log(size) + math.log(scale), rel=1e-13)
    lost = stretched(Stretch(1.0, 0.0, 0.7, 12), Jacobian(0.0, 1.0, 0.0, 1.0))
    assert math.hypot(lost.phase, lost.speed) == pytest.approx(1.0)
    assert (lost.logarithm, lost.since) == (0.7, 12)


def test_an_exponent_is_growth_over_forcing_periods_of_two_half_cycles() -> None:
    rate, periods = rate_of(Stretch(1.0, 0.0, 3.0, 10), 34)
    assert (rate, periods) == (0.25, 12.0)
    rate, periods = rate_of(Stretch(1.0, 0.0, 3.0, 10), 10)
    assert math.isnan(rate)
    assert periods == 0.0


def test_the_weaker_an_orbit_attracts_the_longer_its_approach_is_followed() -> None:
    for passages in (1, 7):
        for largest in (0.0, 0.5, 0.9, 0.999):
            # In so many returns a distance falls to e^-30 of itself.
            returns = returns_to(passages, largest)
            assert returns >= 20 + math.floor(30.0 / (1.0 - largest) * (1.0 - 1e-9))
            assert returns <= 20 + math.ceil(30.0 / (1.0 - largest))
            assert largest**returns < math.exp(-30.0)
    assert returns_to(1, 1.0 - 1e-9) == 200_000
    assert returns_to(10, 1.0 - 1e-9) == 200_000
    assert returns_to(11, 1.0 - 1e-9) == 2_000_000 // 11
    assert returns_to(512, 1.0 - 1e-9) == 2_000_000 // 512


def test_outcomes_and_kinds_of_passages_are_told_apart() -> None:
    kinds = (IMPACT, UPLIFT, GRAZE, FALL, STAY, STUCK)
    outcomes = (PERIODIC, STAYS, FALLS, UNSETTLED, LEFT_OVER)
    assert len(set(kinds)) == len(kinds)
    assert len(set(outcomes)) == len(outcomes)
    system = even_system(2.0, 4.0, 0.8)
    assert next_passage(system, Section(1, 0, 0.4, 0.3), -1.0).kind == IMPACT
    assert next_passage(system, Section(1, 0, 0.4, 9.0), -1.0).kind == FALL
    still = even_system(0.5, 4.0, 0.5)
    assert next_passage(still, Section(1, 0, 0.4, 1e-4), -1.0).kind == STAY
    lifted = even_system(1.2, 4.0, 0.5)
    found = next_passage(lifted, Section(1, 1, 0.4, 1e-4), -1.0)
    assert (found.kind, found.state.speed) == (UPLIFT, 0.0)
    # Uplift is where 1.2 sin(phase) is 1.
    assert found.state.phase == pytest.approx(math.asin(1.0 / 1.2), rel=1e-12)
