"""What a block settles to: brute force, printed numbers, symmetries, chaos, rest."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import DimensionlessBlock, Harmonic, Rest, State, Steady, find_attractor, simulate
from rocksteady.dynamics.orbits.attractor import KINDS, kind_codes
from rocksteady.errors import ModelError
from rocksteady.formulas import steady_states
from rocksteady.kernels.orbits.closed_form import symmetry_breaking
from rocksteady.kernels.orbits.settle import UNSETTLED
from rocksteady.orbits import Attractor
from rocksteady.outcomes import AttractorKind, motion_verb
from tests.dynamics.kicks import apart
from tests.dynamics.recurrence import seen
from tests.dynamics.settling import Start, is_an_orbit_that_attracts, settled
from tests.every import every

Floats = NDArray[np.float64]
# --------------------------------------------------------------------------------- brute force


def compared(seed: int, points: int) -> tuple[dict[str, int], int, list[object]]:
    """Compare what motions settle to with what one sees of it.

    Returns how many of each kind had clearly settled; of how many that were chaotic to begin with
    rounding decided to which of several attractors they went; and those told otherwise.
    """
    rng = np.random.default_rng(seed)
    kinds: dict[str, int] = {}
    undecidable = 0
    wrong: list[object] = []
    for _ in range(points):
        a, w = 10.0 ** rng.uniform(-0.2, 1.0), 10.0 ** rng.uniform(-0.5, 1.5)
        block = DimensionlessBlock(restitution=rng.uniform(0.05, 0.99))
        shaking = Harmonic(amplitude=a, frequency_ratio=w, phase=rng.uniform(0.0, 6.28))
        start: Start = Rest()
        if rng.random() < 0.6:
            start = State(angle=rng.uniform(-0.8, 0.8), velocity=rng.uniform(-0.3, 0.3))
        brute = seen(block, shaking, start)
        if brute.kind == "unsettled":
            continue
        found = find_attractor(block, shaking, start=start)
        kinds[brute.kind] = kinds.get(brute.kind, 0) + 1
        agree = (found.kind.value, found.period or 0) == (brute.kind, brute.period)
        if found.orbit is not None:
            is_an_orbit_that_attracts(found)
        if agree and found.orbit is not None:
            # Samples miss a peak by no more than |u''| (gap/2)^2 / 2.
            gap = 2.0 * math.pi / w / 96
            missed = (1.0 + a + max(brute.highest, -brute.lowest)) * gap * gap / 8.0 + 1e-8
            above = (found.orbit.highest - brute.highest, brute.lowest - found.orbit.lowest)
            agree = all(-1e-8 <= part <= missed for part in above)
        if not agree and found.after > 30:
            undecidable += 1
        elif not agree:
            wrong.append((a, w, block, start, shaking.phase, brute, found))
    return kinds, undecidable, wrong


def test_it_agrees_with_a_comparison_of_periods_wherever_a_motion_has_settled() -> None:
    kinds, undecidable, wrong = compared(1, 400)
    assert not wrong
    assert undecidable <= 2
    assert min(kinds[kind] for kind in ("symmetric", "unsymmetric", "rest", "overturned")) > 10


@pytest.mark.slow
def test_it_agrees_with_a_comparison_of_periods_at_many_points() -> None:
    undecidable = 0
    for seed in (2, 3):
        _, several, wrong = compared(seed, 1500)
        assert not wrong
        undecidable += several
    assert undecidable <= 3  # in 3,000


# ------------------------------------------------------------------------------ printed numbers


@every("side", [1, -1])
@every(
    ("frequency", "order", "peaks", "digits"),
    [
        (1.9, 1, (0.90035, 0.44427), 5),
        (1.85, 1, (1.01036, 0.36025), 5),  # beyond 1, not toppling
        (1.8, 1, (1.0976, 0.2997), 4),
        (4.2, 3, (0.53129, 0.44713), 5),
    ],
)
def test_the_unsymmetric_attractors_of_the_reference(
    frequency: float, order: int, peaks: tuple[float, float], digits: int, side: int
) -> None:
    # TW7; the lower peaks are cut and not rounded.
    found = settled(2.0, frequency, 0.8, start=Steady(order=order), side=side)
    assert found.kind is AttractorKind.UNSYMMETRIC
    assert found.period == order
    is_an_orbit_that_attracts(found)
    assert found.peaks is not None
    larger, smaller = sorted(map(abs, found.peaks), reverse=True)
    assert (larger, smaller) == pytest.approx(peaks, abs=1.1 * 10.0**-digits)


def carried_on(
    frequencies: list[float], found: Attractor, amplitude: float = 2.0
) -> list[Attractor]:
    """Follow an attractor through frequencies, each from where the last one was."""
    follow = [found]
    for frequency in frequencies:
        orbit = follow[-1].orbit
        assert orbit is not None
        first = orbit.states[0]
        start = State(angle=0.0, velocity=first.side * first.speed)
        follow.append(settled(amplitude, frequency, 0.8, phase=first.phase, start=start))
    return follow[1:]


def test_the_period_doubles_where_the_reference_has_it() -> None:
    # TW7: doubled at 1.78, gone by 1.77.
    begin = settled(2.0, 1.8, 0.8, start=Steady(), side=-1)
    down = [1.795, 1.79, 1.7885, 1.788, 1.787, 1.785, 1.78, 1.777, 1.776, 1.775, 1.774]
    found = carried_on(down, begin)
    assert [one.period for one in found] == [1, 1] + 8 * [2] + [4]
    for one in found:
        is_an_orbit_that_attracts(one)
        assert one.orbit is not None
        assert one.orbit.impacts == 2 * (one.period or 0)
        assert one.kind is AttractorKind.UNSYMMETRIC
        answer = one.describe()
        words = motion_verb(one.kind, one.period)
        assert answer.sentence.startswith(f"It {words}, and leans from ")
    for side in (1, -1):
        gone = settled(2.0, 1.77, 0.8, start=Steady(), side=side)
        assert gone.kind is AttractorKind.OVERTURNED
        assert gone.peaks is None


def test_the_period_of_the_subharmonic_doubles_too() -> None:
    # TW7: n = 3, doubled at 4.06, and 4.04 leads to n = 1.
    begin = settled(2.0, 4.2, 0.8, start=Steady(order=3), side=-1)
    found = carried_on([4.15, 4.1, 4.08, 4.07, 4.06, 4.05], begin)
    assert [one.period for one in found] == [3, 3, 3, 3, 6, 6]
    for side in (1, -1):
        one = settled(2.0, 4.04, 0.8, start=Steady(order=3), side=side)
        assert (one.kind, one.period) == (AttractorKind.SYMMETRIC, 1)


def test_where_the_paper_is_corrected() -> None:
    # E2: in-phase orbits attract.
    for a, w, r, n in ((0.75, 4.0, 0.5, 1), (1.7, 6.0, 0.8, 3)):
        states = steady_states(a, w, r, order=n)
        start = State(angle=0.0, velocity=1.002 * float(states.velocity[0]))
        found = settled(a, w, r, phase=float(states.phase[0]), start=start)
        assert (found.kind, found.period) == (AttractorKind.SYMMETRIC, n)
        assert found.peaks is not None
        assert found.peaks[0] == pytest.approx(float(np.asarray(states.peak)[0]), rel=1e-10)
    # E3: Fig 11(a) is left for an unsymmetric one.
    for side in (1, -1):
        found = settled(4.0, 6.0, 0.8, start=Steady(order=3), side=side)
        assert (found.kind, found.period) == (AttractorKind.UNSYMMETRIC, 3)
        assert found.peaks is not None
        larger, smaller = sorted(map(abs, found.peaks), reverse=True)
        assert (larger, smaller) == pytest.approx((0.39815, 0.27242), abs=1.1e-5)


# ----------------------------------------------------------------------------------- symmetries


def test_a_mirrored_start_leads_to_the_mirrored_attractor() -> None:
    rng = np.random.default_rng(5)
    unsymmetric = 0
    for _ in range(300):
        a, w, r = 10.0 ** rng.uniform(0.0, 0.8), rng.uniform(1.5, 8.0), rng.uniform(0.3, 0.95)
        angle, velocity, phase = rng.uniform(-0.5, 0.5), rng.normal(), rng.uniform(0.0, 3.1)
        one = settled(a, w, r, phase=phase, start=State(angle=angle, velocity=velocity))
        if one.after > 60:
            continue  # chaotic to begin with: rounding decides
        other = settled(
            a, w, r, phase=phase + math.pi, start=State(angle=-angle, velocity=-velocity)
        )
        assert other.kind is one.kind
        assert other.period == one.period
        if one.peaks is not None:
            assert other.peaks is not None
            assert other.peaks == pytest.approx((-one.peaks[1], -one.peaks[0]), abs=1e-9)
            unsymmetric += one.kind is AttractorKind.UNSYMMETRIC
    assert unsymmetric > 5


def test_whole_periods_of_the_phase_change_nothing() -> None:
    rng = np.random.default_rng(6)
    for _ in range(150):
        a, w, r = 10.0 ** rng.uniform(0.0, 0.8), rng.uniform(1.5, 8.0), rng.uniform(0.3, 0.95)
        phase, start = rng.uniform(0.0, 6.2), State(angle=rng.uniform(-0.4, 0.4), velocity=0.1)
        one = settled(a, w, r, phase=phase, start=start)
        if one.after > 60:
            continue
        other = settled(a, w, r, phase=phase - 4.0 * math.pi, start=start)
        assert (other.kind, other.period) == (one.kind, one.period)
        if one.peaks is not None:
            assert other.peaks == pytest.approx(one.peaks, abs=1e-9)


def test_the_sides_on_which_an_unstable_orbit_is_left_are_mirror_images_where_symmetry_broke() -> (
    None
):
    one, other = (settled(2.0, 1.9, 0.8, start=Steady(), side=side) for side in (1, -1))
    assert one.peaks is not None
    assert other.peaks is not None
    assert one.peaks == pytest.approx((-other.peaks[1], -other.peaks[0]), abs=1e-12)
    assert one.orbit is not None
    assert other.orbit is not None
    image = one.orbit.mirrored.states[0]
    assert min(apart(image, state) for state in other.orbit.states) < 1e-9


@every("side", [1, -1])
@every(
    ("point", "branch"),
    [((1.0, 2.0, 1), 2), ((1.0, 8.0, 1), 2), ((2.0, 5.0, 3), 2), ((4.0, 6.0, 3), 1)],
)
def test_an_unstable_start_is_left_and_never_returned(
    point: tuple[float, float, int], branch: int, side: int
) -> None:
    a, w, n = point
    found = settled(a, w, 0.8, start=Steady(branch=branch, order=n), side=side)
    states = steady_states(a, w, 0.8, order=n)
    assert found.kind is not AttractorKind.UNDECIDED
    if found.orbit is not None:
        is_an_orbit_that_attracts(found)
        unstable = float(states.velocity[branch - 1])
        for state in found.orbit.states:
            assert abs(state.speed - unstable) > 1e-3 or found.period != n


def test_a_stable_start_is_returned() -> None:
    for a, w, r, n in ((2.0, 4.0, 0.8, 1), (3.0, 8.0, 0.95, 3), (1.7, 6.0, 0.8, 3)):
        states = steady_states(a, w, r, order=n)
        found = settled(a, w, r, start=Steady(order=n))
        assert (found.kind, found.period) == (AttractorKind.SYMMETRIC, n)
        assert found.orbit is not None
        size = float(abs(states.multipliers[0, 0]))
        assert found.orbit.largest_multiplier == pytest.approx(size, rel=1e-9)


# -------------------------------------------------------------------------- weakly attracting


@every("frequency", [2.0, 3.0, 6.0])
@every("below", [1e-2, 1e-3, 1e-4, -1e-4, -1e-3])
def test_next_to_symmetry_breaking_the_right_orbit_is_told(frequency: float, below: float) -> None:
    # Multipliers of .91 to .9999: before it the symmetric orbit attracts, after it two others.
    amplitude = symmetry_breaking(frequency, 0.8, 1) * (1.0 - below)
    states = steady_states(amplitude, frequency, 0.8)
    start = State(angle=0.0, velocity=1.01 * float(states.velocity[0]))
    found = settled(amplitude, frequency, 0.8, phase=float(states.phase[0]), start=start)
    is_an_orbit_that_attracts(found)
    expected = AttractorKind.SYMMETRIC if below > 0.0 else AttractorKind.UNSYMMETRIC
    assert found.kind is expected
    if below > 0.0:
        assert found.peaks is not None
        assert found.peaks[0] == pytest.approx(float(np.asarray(states.peak)[0]), rel=1e-9)


@every("above", [1e-2, 1e-4, 1e-6, 1e-8])
def test_next_to_the_fold_the_stable_branch_is_told(above: float) -> None:
    amplitude = float(steady_states(2.0, 4.0, 0.8).existence) * (1.0 + above)
    states = steady_states(amplitude, 4.0, 0.8)
    start = State(angle=0.0, velocity=(1.0 + 1e-7) * float(states.velocity[0]))
    found = settled(amplitude, 4.0, 0.8, phase=float(states.phase[0]), start=start)
    assert found.kind is AttractorKind.SYMMETRIC
    assert found.orbit is not None
    assert found.orbit.largest_multiplier == pytest.approx(
        float(abs(states.multipliers[0, 0])), abs=1e-6
    )


@every("restitution", [0.99, 0.999, 0.9999])
def test_a_block_that_loses_next_to_nothing_settles_where_it_starts(restitution: float) -> None:
    found = settled(0.5, 4.0, restitution, start=Steady())
    assert (found.kind, found.period) == (AttractorKind.SYMMETRIC, 1)
    assert found.lyapunov == pytest.approx(2.0 * math.log(restitution), rel=1e-6)


# ------------------------------------------------------------------------------------ aperiodic


CHAOS = (1.7347, 1.6633, 0.5)


def test_a_chaotic_motion_is_aperiodic_and_two_motions_part_at_its_lyapunov_exponent() -> None:
    a, w, r = CHAOS
    found = settled(a, w, r, max_cycles=6000)
    assert found.kind is AttractorKind.APERIODIC
    assert found.orbit is None
    assert found.period is None
    assert found.peaks is None
    assert found.after >= 6000
    # Pairs of simulations 1e-9 apart, from many states of one run, over twelve periods each.
    block = DimensionlessBlock(restitution=r)
    shaking = Harmonic(amplitude=a, frequency_ratio=w)
    unit = 2.0 * math.pi / w
    run = simulate(block, shaking, cycles=360)
    rates = []
    for begin in range(40, 352, 2):
        state = run(begin * unit)
        if abs(float(state.angle)) < 0.05:
            continue
        near, far = [
            simulate(
                block,
                shaking,
                start=State(angle=float(state.angle) + shift, velocity=float(state.velocity)),
                cycles=13,
            )
            for shift in (0.0, 1e-9)
        ]
        # Angles and velocities at whole periods: a plane across the flow.
        times = unit * np.array([1.0, 12.0])
        u, v = near(times), far(times)
        gap = np.hypot(u.angle - v.angle, u.velocity - v.velocity)
        if gap.min() > 0.0 and gap.max() < 1e-2:
            rates.append(math.log(gap[1] / gap[0]) / 11.0)
    assert len(rates) > 60
    spread = float(np.std(rates)) / math.sqrt(len(rates))
    assert found.lyapunov == pytest.approx(float(np.mean(rates)), abs=4.0 * spread + 0.05)


def test_a_chaotic_motion_has_the_exponent_of_any_start() -> None:
    exponents = [
        settled(*CHAOS, phase=phase, max_cycles=20_000).lyapunov for phase in (0.0, 1.0, 3.0, 5.0)
    ]
    exponents = [one for one in exponents if math.isfinite(one)]
    assert len(exponents) >= 2
    assert np.ptp(exponents) < 0.05
    assert min(exponents) > 0.5


def test_rows_of_a_chaotic_motion_are_the_impacts_of_the_second_half_of_its_run() -> None:
    motion = settled(*CHAOS, max_cycles=100)
    run, rows = motion.trajectory(), motion.rows()
    omega = CHAOS[1]
    late = [k for k, time in enumerate(run.impacts.pt.tolist()) if time >= 0.5 * run.end_time_pt]
    assert 0 < len(rows) == len(late) < len(run.impacts)
    for row, k in zip(rows, late, strict=True):
        phase = omega * run.impacts.pt[k] + run.motion.phase  # type: ignore[union-attr]
        turns = (row["phase_rad"] - phase) / (2.0 * math.pi)
        assert turns == pytest.approx(round(turns), abs=1e-9)
        assert 0.0 <= row["phase_rad"] < 2.0 * math.pi
        speed = row["side"] * row["speed_per_pivot_time"]
        assert speed == pytest.approx(run.impacts.velocity_after[k], rel=1e-12)


# --------------------------------------------------------------- what rounding may have decided


def test_growth_is_what_a_small_difference_becomes_on_the_way() -> None:
    calm, long = settled(2.0, 4.0, 0.8), settled(6.504671554246363, 7.402801419542081, 0.93757897)
    assert 1.0 <= calm.growth < 1e3
    assert long.growth > 1e6
    # A start further from the attractor passes the same flights, with one difference followed.
    one, other = (
        simulate(
            DimensionlessBlock(restitution=0.8),
            Harmonic(amplitude=2.0, frequency_ratio=4.0),
            start=State(angle=0.0, velocity=0.3 + shift),
            cycles=12,
        ).impacts
        for shift in (0.0, 1e-9)
    )
    seen = np.abs(other.velocity_after - one.velocity_after).max() / 1e-9
    found = settled(2.0, 4.0, 0.8, start=State(angle=0.0, velocity=0.3))
    assert found.growth >= 1.0
    assert seen < 1e3 * found.growth


@every(
    ("point", "order"),
    [((0.8, 0.05, 0.6), 9), ((0.95, 0.0218, 0.175), 3), ((0.75, 0.03, 0.9967), 9)],
)
@every("branch", [1, 2])
def test_a_steady_start_with_long_half_cycles_is_left_or_refused(
    point: tuple[float, float, float], order: int, branch: int
) -> None:
    stable, refused = True, "start"
    try:
        orbit = settled(*point, start=Steady(branch=branch, order=order)).orbit
        stable = orbit is None or orbit.stable
    except ModelError as error:
        refused = error.name
    assert stable
    assert refused == "start"


def test_without_loss_at_its_impacts_or_at_a_wall_nothing_is_aperiodic() -> None:
    # Minus the wall's restitution is what a side table holds.
    least = [0.9, 1.0, -0.9, -0.0, -1.0]
    kinds = [KINDS[code] for code in kind_codes([UNSETTLED] * 5, [0] * 5, [0.5] * 5, least)]
    chaos, unknown = AttractorKind.APERIODIC, AttractorKind.UNDECIDED
    assert kinds == [chaos, unknown, chaos, chaos, unknown]
