"""What a block settles to that rests, falls, never settles, or is asked for what cannot be."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Rest,
    State,
    Status,
    Steady,
    Still,
    find_attractor,
    find_orbits,
    simulate,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import steady_states
from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.orbits.settle import LONGEST_ORBIT
from rocksteady.outcomes import AttractorKind
from tests.dynamics.recurrence import seen
from tests.dynamics.settling import Start, is_an_orbit_that_attracts, settled
from tests.every import every

# ------------------------------------------------------------------------------------------ rest


@every(
    ("amplitude", "frequency", "restitution"),
    [(1.01, 2.0, 0.8), (1.05, 1.0, 0.3), (1.0001, 4.0, 0.9), (1.0001, 0.3, 0.5)],
)
def test_an_orbit_with_rest_is_the_same_from_different_starts(
    amplitude: float, frequency: float, restitution: float
) -> None:
    starts: list[tuple[float, Start]] = [
        (0.0, Rest()),
        (1.7, Rest()),
        (3.0, State(angle=1e-5, velocity=0.0)),
        (4.0, State(angle=0.0, velocity=-1e-5)),
    ]
    found = [settled(amplitude, frequency, restitution, phase=p, start=s) for p, s in starts]
    for one in found:
        is_an_orbit_that_attracts(one)
        assert (one.kind, one.period) == (AttractorKind.SYMMETRIC, 1)
        assert one.orbit is not None
        assert one.orbit.rest_phases == 2
        assert one.peaks == pytest.approx(found[0].peaks, rel=1e-9)
        lifts = [state for state in one.orbit.states if state.speed == 0.0]
        assert sorted(state.side for state in lifts) == [-1, 1]
        for state in lifts:
            assert state.side * amplitude * math.sin(state.phase) == pytest.approx(1.0, abs=1e-12)


@every("amplitude", [0.0, 0.3, 1.0])
def test_where_the_base_never_lifts_it_a_block_at_rest_stays(amplitude: float) -> None:
    found = settled(amplitude, 4.0, 0.8)
    assert found.kind is AttractorKind.REST
    assert found.peaks == (0.0, 0.0)
    assert math.isnan(found.lyapunov)


def test_a_tilted_block_on_a_still_base_comes_to_rest_or_falls() -> None:
    assert settled(0.0, 4.0, 0.9, start=State(angle=0.5, velocity=0.0)).kind is AttractorKind.REST
    over = settled(0.0, 4.0, 0.9, start=State(angle=-1.1, velocity=0.0))
    assert over.kind is AttractorKind.OVERTURNED
    assert over.peaks is None


def test_below_uplift_a_moving_block_may_rock_on() -> None:
    # A = .9 lifts no block, and keeps one rocking.
    assert settled(0.9, 4.0, 0.9).kind is AttractorKind.REST
    rocking = settled(0.9, 4.0, 0.9, start=State(angle=0.5, velocity=0.0))
    assert (rocking.kind, rocking.period) == (AttractorKind.SYMMETRIC, 1)


@every(
    ("point", "kind"),
    [
        ((20.0, 0.05, 0.8), AttractorKind.OVERTURNED),
        ((20.0, 200.0, 0.95), AttractorKind.SYMMETRIC),
        ((3.0, 200.0, 0.05), AttractorKind.UNSYMMETRIC),
        ((1.2, 200.0, 0.999), AttractorKind.SYMMETRIC),
        ((1.0001, 0.05, 0.05), AttractorKind.SYMMETRIC),
        ((20.0, 200.0, 0.05), AttractorKind.APERIODIC),
    ],
)
def test_extreme_points(point: tuple[float, float, float], kind: AttractorKind) -> None:
    found = settled(*point)
    assert found.kind is kind
    if found.orbit is not None:
        is_an_orbit_that_attracts(found)


# ------------------------------------------------------------------------------- none, or not yet


def test_without_loss_nothing_settles_and_the_reason_is_given() -> None:
    found = settled(0.5, 4.0, 1.0, start=State(angle=0.2, velocity=0.0))
    assert found.kind is AttractorKind.UNDECIDED
    assert "without loss" in found.reason
    assert found.orbit is None
    still = settled(0.0, 4.0, 1.0, start=State(angle=0.5, velocity=0.0))
    assert still.kind is AttractorKind.UNDECIDED


@every("cycles", [1, 3, 5])
def test_too_few_cycles_are_a_reason_to_be_undecided(cycles: int) -> None:
    found = settled(2.0, 4.0, 0.8, max_cycles=cycles)
    assert found.kind is AttractorKind.UNDECIDED
    assert f"within {cycles} forcing periods" in found.reason
    assert "more cycles" in found.reason
    assert found.after == cycles


def test_a_physical_block_settles_like_its_restitution() -> None:
    block = Block.from_radius(alpha=0.2, radius=1.0, restitution=0.8)
    found = find_attractor(block, Harmonic(amplitude=2.0, frequency_ratio=4.0), model="linear")
    assert found.peaks == settled(2.0, 4.0, 0.8).peaks


def test_an_attractor_has_a_table_for_notebooks() -> None:
    assert "multipliers" in settled(2.0, 4.0, 0.8)._repr_html_()
    assert "overturned" in settled(2.0, 1.7, 0.8, start=Steady())._repr_html_()
    assert "no repetition" in settled(2.0, 4.0, 0.8, max_cycles=5)._repr_html_()


@every(
    ("values", "message"),
    [
        ({"max_cycles": 0}, r"^max_cycles = 0 "),
        ({"max_cycles": 2.5}, r"^max_cycles = 2\.5 "),
        ({"max_cycles": math.inf}, r"^max_cycles = inf "),
        ({"side": 0}, r"^side = 0 .*1 or -1"),
        ({"start": 0.3}, r"^start = 0\.3 "),
    ],
)
def test_what_is_no_number_no_side_and_no_start_is_refused(
    values: dict[str, object], message: str
) -> None:
    with pytest.raises(InputError, match=message):
        settled(2.0, 4.0, 0.8, **values)  # type: ignore[arg-type]


def test_what_is_no_block_what_is_not_harmonic_and_where_no_orbit_is_is_refused() -> None:
    with pytest.raises(InputError, match=r"^block = 0\.8 "):
        find_attractor(0.8, Harmonic(amplitude=1.0, frequency_ratio=1.0))  # type: ignore[arg-type]
    with pytest.raises(ModelError, match=r"^motion = Still"):
        find_attractor(DimensionlessBlock(restitution=0.8), Still())  # type: ignore[arg-type]
    with pytest.raises(ModelError, match=r"^start = Steady"):
        settled(0.1, 4.0, 0.8, start=Steady())


def test_without_loss_no_steady_start_is_an_attractor() -> None:
    for amplitude in np.linspace(0.5, 6.0, 12).tolist():
        for frequency in np.linspace(1.0, 12.0, 12).tolist():
            states = steady_states(amplitude, frequency, 1.0)
            if states.neutral[0]:
                found = settled(amplitude, frequency, 1.0, start=Steady(), max_cycles=40)
                assert found.orbit is None, (amplitude, frequency)


@every(
    ("point", "cycles"), [((4.76, 10.88, 0.64), 12), ((2.15, 2.04, 0.48), 12), ((2.0, 4.0, 0.8), 3)]
)
def test_a_short_run_is_never_called_aperiodic(
    point: tuple[float, float, float], cycles: int
) -> None:
    for phase in (0.0, 0.5, 1.0, 2.0):
        assert settled(*point, phase=phase, max_cycles=cycles).kind is not AttractorKind.APERIODIC


def test_what_has_settled_by_the_end_of_the_cycles_is_recognised() -> None:
    whole = settled(2.0, 1.9, 0.8, start=Steady(), side=-1)
    found = settled(2.0, 1.9, 0.8, start=Steady(), side=-1, max_cycles=53)
    assert found.kind is AttractorKind.UNSYMMETRIC
    assert found.peaks == pytest.approx(whole.peaks, abs=1e-9)


@pytest.mark.parametrize(
    ("point", "period", "rests"),
    [
        ((1.112926390436941, 8.003032001497338, 0.664791885510839), 11, 1),  # 261 passages
        ((1.0629304171178815, 11.092625804515649, 0.8500066194737368), 11, 2),  # 714
    ],
)
def test_an_orbit_that_rocks_for_long_between_rests_is_recognised(
    point: tuple[float, float, float], period: int, rests: int
) -> None:
    # From an uplift the motion is always the same, so that it closes to the last bit.
    found = settled(*point)
    assert found.orbit is not None
    assert (found.period, found.orbit.rest_phases) == (period, rests)


ACCUMULATED = {0.5: 1.147608, 0.7: 1.104328, 0.8: 1.077888, 0.87: 1.056216, 0.9: 1.045812}
"""Amplitude at which the bounces of fast shaking accumulate at the next uplift, by restitution."""


@every("restitution", ACCUMULATED)
@every("beyond", [4e-4, 1e-3, 3e-3])
def test_where_chatter_just_fails_to_end_before_uplift_motions_repeat_from_rest_to_rest(
    restitution: float, beyond: float
) -> None:
    amplitude = ACCUMULATED[restitution] * (1.0 + beyond)
    for frequency in (1.3, 2.1, 3.3, 5.7, 7.9):
        found = settled(amplitude, frequency, restitution)
        assert found.after < 400
        if found.orbit is None:
            if found.kind is AttractorKind.UNDECIDED:
                assert found.growth > 1e12
                assert "rounding decides" in found.reason
            continue
        assert found.orbit.residual <= 1e-12
        if found.orbit.rest_phases:
            begin = found.orbit.states[0]
            assert begin.speed == 0.0
            assert amplitude * abs(math.sin(begin.phase)) == pytest.approx(1.0, abs=1e-12)


@every("restitution", ACCUMULATED)
def test_no_orbit_with_rests_depends_on_the_last_digit_of_the_amplitude(
    restitution: float,
) -> None:
    decided = 0
    for beyond in (4e-4, 1e-3, 3e-3, 0.01):
        amplitude = ACCUMULATED[restitution] * (1.0 + beyond)
        for frequency in (1.3, 2.1, 3.3, 5.7, 7.9):
            found, *others = (
                settled(moved, frequency, restitution)
                for moved in (
                    amplitude,
                    math.nextafter(amplitude, 0.0),
                    math.nextafter(amplitude, 2.0),
                )
            )
            if found.orbit is None or not found.orbit.rest_phases or found.growth > 1e12:
                continue
            decided += 1
            assert {(other.kind, other.period) for other in others} == {(found.kind, found.period)}
    assert decided >= 3


def test_where_rounding_decides_what_follows_a_rest_there_is_no_orbit() -> None:
    # Steps of an ulp of the amplitude gave periods of 27, 20 and 11; 60 digits give 11.
    found = settled(1.15, 5.4, 0.51)
    assert found.kind is AttractorKind.UNDECIDED
    assert found.after < 100
    assert "rounding decides" in found.reason
    block = DimensionlessBlock(restitution=0.51)
    shaking = Harmonic(amplitude=1.15, frequency_ratio=5.4)
    assert not [o for o in find_orbits(block, shaking, max_period=30, seeds=2) if o.rest_phases]


def test_an_orbit_that_is_too_long_to_hold_ends_the_run_with_that_reason() -> None:
    # How long it is before it repeats itself is up to rounding: of near amplitudes some are.
    near = (1.006876 * (1.0 + k * 1e-6) for k in range(40))
    all_found = (
        settled(amplitude, 2.0508474576271185, 0.99, max_cycles=1000) for amplitude in near
    )
    found = next(found for found in all_found if "more than an orbit may have" in found.reason)
    assert found.kind is AttractorKind.UNDECIDED
    assert found.after < 1000
    said = re.search(r"it has (\d+) impacts in (\d+) forcing periods", found.reason)
    assert said is not None
    assert int(said[1]) > LONGEST_ORBIT
    assert int(said[2]) <= found.after


def test_an_orbit_with_rest_of_any_size_is_recognised() -> None:
    found = settled(1.0001, 1000.0, 0.95)
    assert found.orbit is not None
    assert (found.kind, found.period) == (AttractorKind.SYMMETRIC, 1)


def test_the_peaks_of_an_orbit_with_rest_count_its_largest_bounce() -> None:
    # A large swing to one side, a small bounce to the other, and rest.
    block = DimensionlessBlock(restitution=0.06852906483237249)
    shaking = Harmonic(amplitude=1.1675980811909625, frequency_ratio=0.6036093403906745)
    brute, found = seen(block, shaking, Rest()), find_attractor(block, shaking)
    assert (found.kind.value, found.period) == (brute.kind, brute.period) == ("unsymmetric", 1)
    assert found.peaks is not None
    larger, smaller = sorted(map(abs, found.peaks), reverse=True)
    high, low = sorted((abs(brute.highest), abs(brute.lowest)), reverse=True)
    assert larger == pytest.approx(high, rel=1e-4)
    assert low > 5e-3
    assert smaller == pytest.approx(low, rel=1e-2)


def test_of_an_upright_block_the_reason_is_its_balance() -> None:
    found = settled(0.0, 4.0, 0.9, start=State(angle=1.0, velocity=0.0))
    assert found.kind is AttractorKind.UNDECIDED
    assert "nan" not in found.reason


def test_more_cycles_than_an_integer_holds_are_refused() -> None:
    with pytest.raises(InputError, match=r"^max_cycles = "):
        settled(2.0, 4.0, 0.8, max_cycles=10**20)


@every(
    "point",
    [
        (1.136807753871025, 12.779994015403771, 0.5560594737629436),  # period 20
        (1.14652, 10.28454, 0.51320),
        (1.07652, 4.55947, 0.80652),
        (1.05, 1.0, 0.3),
    ],
)
def test_an_orbit_with_rest_draws_itself_as_it_is(point: tuple[float, float, float]) -> None:
    # A run from its first state would leave it between two rests.
    orbit = settled(*point).orbit
    assert orbit is not None
    assert orbit.rest_phases
    run = orbit.trajectory()
    unit = 2.0 * math.pi / orbit.motion.frequency_ratio
    assert run.end_time_pt == pytest.approx(orbit.period * unit, rel=1e-9)
    angle = run(run.times(400)).angle
    assert angle.max() == pytest.approx(orbit.highest, rel=1e-3)
    assert angle.min() == pytest.approx(orbit.lowest, rel=1e-3)
    assert (np.diff(run.flights.pt) >= -1e-12).all()


# ----------------------------------------------------------------- starts that lift at once


def random_cases(seed: int, count: int, *, lifting: bool) -> list[tuple[float, Harmonic]]:
    """Random restitutions and motions; `lifting` ones push a still block off at once."""
    random = np.random.default_rng(seed)
    listed: list[tuple[float, Harmonic]] = []
    while len(listed) < count:
        restitution, amplitude, frequency, phase = random.uniform(
            [0.3, 1.0, 2.0, 0.0], [0.95, 4.0, 9.0, math.pi]
        ).tolist()
        motion = Harmonic(amplitude=amplitude, frequency_ratio=frequency, phase=phase)
        again = clock(phase + math.pi) == (1, phase)  # mirrored without rounding
        if again and (not lifting or amplitude * math.sin(phase) > 1.0):
            listed.append((restitution, motion))
    return listed


@pytest.mark.parametrize("one_sided", [True, False])
def test_what_lifts_at_once_settles_to_what_a_time_history_comes_to(*, one_sided: bool) -> None:
    decided = 0
    for restitution, motion in random_cases(3, 150, lifting=True):
        block = DimensionlessBlock(restitution=restitution, one_sided=one_sided)
        found = find_attractor(block, motion, max_cycles=100)
        if found.growth > 1e7 or found.kind in ("undecided", "aperiodic"):
            continue
        decided += 1
        # What is left of the way there, and in the end a period of the orbit.
        run = simulate(block, motion, cycles=found.after + 300)
        assert (run.status == Status.OVERTURNED) == (found.kind == "overturned")
        if found.orbit is None:
            continue
        assert found.orbit.stable
        if found.orbit.largest_multiplier ** (300 / found.orbit.period) > 1e-6:
            continue  # it comes there more slowly
        last = 2.0 * math.pi * found.orbit.period / motion.frequency_ratio
        ends = run(np.linspace(run.end_time_pt - last, run.end_time_pt, 4000)).angle
        high, low = found.orbit.highest, found.orbit.lowest
        if not one_sided and abs(ends.max() - high) > abs(ends.max() + low):
            high, low = -low, -high
        assert [ends.max(), ends.min()] == pytest.approx([high, low], abs=2e-3)
    assert decided > 40


def test_a_mirrored_start_settles_to_the_mirror_image_bit_for_bit() -> None:
    for restitution, motion in random_cases(5, 60, lifting=False):
        block = DimensionlessBlock(restitution=restitution)
        angle, velocity = motion.amplitude / 5.0 - 0.4, motion.frequency_ratio / 9.0 - 0.5
        pair = [
            (replace(motion, phase=motion.phase + k * math.pi), State(angle=u, velocity=v))
            for k, u, v in ((0, angle, velocity), (1, -angle, -velocity))
        ]
        runs = [simulate(block, shaken, start=start, cycles=20) for shaken, start in pair]
        ends = [(run.status, run.peak, run.end_time_pt) for run in runs]
        assert ends[0] == ends[1]
        found = [find_attractor(block, shaken, start=start) for shaken, start in pair]
        told = [(each.kind, each.period, each.after, each.growth, each.reason) for each in found]
        assert told[0] == told[1]
        peaks, images = (each.peaks for each in found)
        if peaks is not None and images is not None:
            assert peaks == (-images[1], -images[0])
