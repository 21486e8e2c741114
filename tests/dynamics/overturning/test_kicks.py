"""Least fatal kicks: closed forms on a still base, time histories, symmetry, bad input."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Execution,
    Harmonic,
    Linear,
    Nonlinear,
    Piecewise,
    Pulse,
    Record,
    Rest,
    State,
    Status,
    find_fatal_kicks,
    simulate,
)
from rocksteady.errors import InputError
from rocksteady.formulas import overturning_impulse
from rocksteady.model.equations import Model
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.motions import Impulses, Segment, add, cut, delay, join, scale
from tests.every import every
from tests.outputs import lines_of
from tests.seismic.grounds import ground
from tests.strategies import sample_size

BLOCK = Block.rectangle(width=0.4, height=1.6, restitution=0.85)
LEANING = Block.asymmetric(left=0.25, right=0.35, height=1.6, restitution=(0.9, 0.8))
BARE = DimensionlessBlock(restitution=0.9)


@pytest.mark.parametrize("model", [Linear(), Nonlinear()], ids=lambda model: model.name)
def test_from_rest_it_is_the_overturning_impulse(model: Model) -> None:
    kicks = find_fatal_kicks(BLOCK, model=model)
    expected = overturning_impulse(BLOCK, model=model)
    assert kicks.signed[0] * kicks.unit_m_s == pytest.approx([expected, -expected], rel=1e-11)
    assert kicks.least_m_s[0] == pytest.approx(expected, rel=1e-11)


@pytest.mark.slow
@every(("u", "v"), [(0.5, 0.0), (0.2, 0.3), (0.9, -0.3), (0.05, -0.8)])
def test_the_linear_closed_forms_on_a_still_base(u: float, v: float) -> None:
    kicks = find_fatal_kicks(BARE, start=State(angle=u, velocity=v))
    # On its side the block passes the top with v + k > 1 - u; thrown back it lands with the speed
    # of (v - k)^2 + u (2 - u), and leaves with 0.9 of it, which is to be above 1.
    onwards = 1.0 - u - v
    back = v + math.sqrt(1.0 / 0.9**2 - u * (2.0 - u))
    assert kicks.signed[0] == pytest.approx([onwards, -back], rel=1e-11)
    mirrored = find_fatal_kicks(BARE, start=State(angle=-u, velocity=-v))
    assert mirrored.signed[0] == pytest.approx([back, -onwards], rel=1e-11)


def test_an_answer_has_the_least_kick_the_other_way_with_its_sign() -> None:
    kicks = find_fatal_kicks(BARE, start=State(angle=-0.6, velocity=0.0))
    mirrored = find_fatal_kicks(BARE, start=State(angle=0.6, velocity=0.0))
    for found, least, sign in ((kicks, "-0.4", ""), (mirrored, "0.4", "-")):
        answer = found.describe()
        facts = lines_of(answer)
        # Both ways a kick of 0.4 and one of the square root of 1/0.81 - 0.84 are the least.
        assert answer.sentence.startswith(f"The least kick that fells it is {least} ")
        other = f"{sign}{math.sqrt(1.0 / 0.81 - 0.84):.3f}"
        assert str(facts["the other way"]).startswith(other)


@every("u", [0.1, 0.5, 0.9])
def test_the_nonlinear_one_is_the_barrier_of_energy(u: float) -> None:
    alpha = BLOCK.alpha
    kicks = find_fatal_kicks(BLOCK, start=State(angle=u, velocity=0.0))
    # A jump dV of the base turns the block by dV p^2 cos(alpha (1 - u))/(alpha g).
    speed = 2.0 * math.sin(0.5 * alpha * (1.0 - u)) / alpha
    share = math.cos(alpha * (1.0 - u))
    assert kicks.signed[0, 0] == pytest.approx(speed / share, rel=1e-11)


def test_a_block_beyond_its_balance_falls_without_a_kick() -> None:
    kicks = find_fatal_kicks(BARE, start=State(angle=1.2, velocity=0.0))
    assert kicks.first.tolist() == [0.0, 0.0]
    assert kicks.at(0)[0].side == 1
    # A kick back that is hard enough saves it, until it falls on the other side.
    assert len(kicks.intervals(1)) == 2


@every("block", [BARE, LEANING, LEANING.against_wall(0.5)])
def test_an_answer_says_once_that_both_directions_were_searched(
    block: Block | DimensionlessBlock,
) -> None:
    assert find_fatal_kicks(block, model=Linear()).summary().count("both ways") == 1


@every("block", [BARE, BLOCK, LEANING])
@every("angle", [1.0, 1.01])
def test_a_block_at_its_balance_waits_for_a_kick_of_any_size(
    block: Block | DimensionlessBlock, angle: float
) -> None:
    """There it stays without one, as `simulate` has it; the least that fells it is 0 in size."""
    kicks = find_fatal_kicks(block, start=State(angle=angle, velocity=0.0))
    assert kicks.first[0] == 0.0
    answer = kicks.describe()
    ends = "falls without a kick" if angle > 1.0 else "stands balanced: any disturbance decides"
    assert answer.sentence == f"It {ends}."


@pytest.mark.slow
@every("block", [BLOCK, LEANING])
@every("model", [Linear(), Nonlinear()])
def test_a_kick_during_a_motion_is_an_impulse_of_it(block: Block, model: Model) -> None:
    pulse = Pulse(shape="one-sine", amplitude=1.6, frequency_ratio=4.0)
    when = 0.9
    kicks = find_fatal_kicks(block, motion=pulse, times_pt=when, model=model)
    turned = pulse.segments()[0]
    assert turned.duration > when
    for place, sign in enumerate((1.0, -1.0)):
        least = kicks.first[place]
        for factor, falls in ((1.0 - 1e-8, False), (1.0 + 1e-8, True)):
            before = replace(turned, duration=when)
            after = replace(
                turned,
                duration=turned.duration - when,
                phase=turned.phase + turned.frequency * when,
                jump=sign * least * factor,
            )
            run = simulate(block, Piecewise(pieces=(before, after)), model=model)
            assert (run.status is Status.OVERTURNED) is falls


def test_a_push_on_the_way_saves_as_much_of_the_kick_as_it_adds_to_the_growing_part() -> None:
    # z = u + u' grows by z' = z - 1 + a, and the block falls where z comes to 1 and more.
    pieces = Segment(duration=0.5, constant=0.8), Segment(duration=0.5, constant=0.3)
    motion = Piecewise(pieces=pieces)
    kicks = find_fatal_kicks(BARE, motion=motion, times_pt=(0.0, 0.5), within=(0.4, 0.9))
    first, last = 1.0 - math.exp(-0.5), math.exp(-0.5) - math.exp(-1.0)
    expected = 1.0 - 0.8 * first - 0.3 * last, 1.0 - 0.3 * first
    assert kicks.signed[:, 0] == pytest.approx(expected, rel=1e-11)


@pytest.mark.slow
def test_kicks_during_a_record_agree_with_time_histories() -> None:
    record = ground(1).scaled(0.7)
    times = np.array([0.3, 1.0]) * BLOCK.p
    kicks = find_fatal_kicks(BLOCK, motion=record, times_pt=times, model=Linear())
    samples = record.acceleration_m_s2 / BLOCK.uplift_acceleration
    step = record.dt_s * BLOCK.p
    course = simulate(BLOCK, record, model=Linear())
    checked = 0
    for moment, time in enumerate(times.tolist()):
        first = round(time / step)
        if abs(first * step - time) > 1e-9:
            continue
        at = course(time)
        rest = tuple(
            Segment(duration=step, constant=float(a), slope=float(b - a) / step)
            for a, b in zip(samples[first:-1], samples[first + 1 :], strict=True)
        )
        for size in np.linspace(0.05, 3.9, 40).tolist():
            for place, sign in enumerate((1.0, -1.0)):
                begun = State(angle=float(at.angle), velocity=float(at.velocity) + sign * size)
                run = simulate(BLOCK, Piecewise(pieces=rest), start=begun, model=Linear())
                inside = any(
                    low <= size <= high for low, high in kicks.intervals(2 * moment + place)
                )
                assert (run.status is Status.OVERTURNED) is inside
                checked += 1
    assert checked >= 80


@pytest.mark.slow
def test_kicks_among_impulses_are_impulses_more_of_time_histories() -> None:
    draw = np.random.default_rng(27)
    bodies = (BLOCK, LEANING, BLOCK.against_wall(0.8), DimensionlessBlock(restitution=0.95))
    checked = fatal = 0
    for case in range(sample_size(15, 2)):
        body = bodies[case % len(bodies)]
        model = Nonlinear() if isinstance(body, Block) and case % 3 else Linear()
        count = int(draw.integers(1, 4))
        struck = np.cumsum(draw.uniform(0.2, 1.5, count))
        struck[0] *= float(case % 3 > 0)
        train = dict(zip(struck.tolist(), draw.uniform(-0.8, 0.8, count).tolist(), strict=True))
        motion = Impulses(velocities=tuple(train.values()), times=tuple(train))
        begun = State(angle=float(draw.uniform(0.0, 0.3)), velocity=float(draw.uniform(0.0, 0.2)))
        start = begun if case % 4 == 3 else Rest()
        fallen = simulate(body, motion, start=start, model=model)
        if fallen.status is Status.OVERTURNED:
            continue
        # Before, with, between and after the impulses.
        last = float(struck[-1])
        when = (0.0, last, 0.5 * float(struck[0]), float(struck[0]) + 0.07, last + 2.0)[case % 5]
        kicks = find_fatal_kicks(body, start=start, motion=motion, times_pt=when, model=model)
        for row, sign in enumerate((1.0, -1.0)):
            ends = np.array(kicks.intervals(row)).ravel()
            sizes = [*(ends * (1.0 - 1e-6)), *(ends * (1.0 + 1e-6)), *draw.uniform(0.01, 3.9, 9)]
            for size in sizes:
                if size > kicks.within[1]:
                    continue
                kicked = {**train, when: train.get(when, 0.0) + sign * size}
                order = tuple(sorted(kicked))
                shaken = Impulses(velocities=tuple(kicked[t] for t in order), times=order)
                run = simulate(body, shaken, start=start, model=model)
                inside = any(low <= size <= high for low, high in kicks.intervals(row))
                assert (run.status is Status.OVERTURNED) is inside, (case, row, size)
                checked += 1
                fatal += inside
    assert fatal > checked / 5


@pytest.mark.slow
def test_every_last_segment_with_an_impulse_counts() -> None:
    # Each way of making one: the motion itself, its parts, sums, delays and cuts.
    struck = Impulses(velocities=(0.3, 0.671), times=(0.4, 1.324))
    pulse = Pulse(shape="half-sine", amplitude=1.1, frequency_ratio=4.0)
    turned = Piecewise(pieces=(Segment(duration=1.324), Segment(duration=math.inf, jump=0.671)))
    motions = (
        turned,
        struck,
        delay(struck, 0.3),
        cut(struck, 5.0),
        scale(struck, -1.0),
        join(pulse, struck),
        add(pulse, struck),
        BaseMotion(add(pulse, struck), Piecewise(pieces=(Segment(duration=2.0),))),
    )
    for motion in motions:
        at = find_fatal_kicks(LEANING, motion=motion, times_pt=1.0, model=Nonlinear())
        across = motion.horizontal if isinstance(motion, BaseMotion) else motion
        assert not isinstance(across, Record)
        for kick in at.signed[0].tolist():
            for factor in (1.0 - 1e-7, 1.0 + 1e-7):
                kicked = delay(Impulses(velocities=(factor * kick,)), 1.0)
                run = simulate(LEANING, add(across, kicked), model=Nonlinear())
                assert (run.status is Status.OVERTURNED) is (factor > 1.0)


def test_a_kick_after_the_fall_is_refused() -> None:
    push = Impulses(velocities=(1.5,))
    assert find_fatal_kicks(BARE, motion=push).first[0] == 0.0
    with pytest.raises(InputError, match=r"without a kick the run ends at .* overturned"):
        find_fatal_kicks(BARE, motion=push, times_pt=[0.0, 50.0])


def test_after_the_motion_a_block_at_rest_needs_the_impulse() -> None:
    record = ground(1).scaled(0.3)
    kicks = find_fatal_kicks(BLOCK, motion=record, times_pt=100.0)
    assert kicks.least_m_s[0] == pytest.approx(overturning_impulse(BLOCK), rel=1e-11)


@pytest.mark.slow
def test_the_vertical_component_counts_and_workers_do_not() -> None:
    record = ground(2).scaled(0.5)
    lifted = BaseMotion(record, record.scaled(0.4))
    plain, one, two = (
        find_fatal_kicks(BLOCK, motion=motion, times_pt=[0.5, 1.0], run=run)
        for motion, run in (
            (record, None),
            (lifted, Execution(executor="serial")),
            (lifted, Execution(workers=2)),
        )
    )
    assert not np.array_equal(plain.first, one.first)
    np.testing.assert_array_equal(one.first, two.first)


@pytest.mark.slow
def test_a_motion_and_its_delay_have_the_same_kicks() -> None:
    pulse = Pulse(shape="half-sine", amplitude=1.4, frequency_ratio=3.0)
    delayed = Piecewise(pieces=(Segment(duration=0.5), *pulse.segments()))
    here, later = (
        find_fatal_kicks(BARE, motion=motion, times_pt=time)
        for motion, time in ((pulse, 0.3), (delayed, 0.8))
    )
    np.testing.assert_allclose(here.first, later.first, rtol=1e-9)


def test_what_is_refused() -> None:
    with pytest.raises(InputError, match="end"):
        find_fatal_kicks(BARE, motion=Harmonic(amplitude=1.0, frequency_ratio=2.0))
    with pytest.raises(InputError, match="times_pt"):
        find_fatal_kicks(BARE, times_pt=-1.0)
    with pytest.raises(InputError, match="within"):
        find_fatal_kicks(BARE, within=(2.0, 1.0))
    with pytest.raises(InputError, match="start"):
        find_fatal_kicks(BARE, start=State(angle=0.1, velocity=0.0, phase=1.0))


def test_it_is_described_in_m_s() -> None:
    kicks = find_fatal_kicks(BLOCK, times_pt=[0.0, 1.0])
    rows = kicks.to_dataframe()
    assert rows["first_m_s"].tolist() == pytest.approx([overturning_impulse(BLOCK)] * 4)
    data = kicks.to_dataset()
    assert data["least"].values == pytest.approx(kicks.least)
