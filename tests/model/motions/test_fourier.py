"""Fourier series: what they accept, their peak, and those of samples."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import rocksteady as rs
from tests.every import every

WAVES = st.lists(
    st.tuples(st.integers(1, 12), st.floats(-2.0, 2.0), st.floats(-7.0, 7.0)),
    min_size=1,
    max_size=5,
    unique_by=lambda wave: wave[0],
).filter(lambda waves: sum(abs(size) for _, size, _ in waves) > 1e-3)


def by_hand(motion: rs.motions.FourierSeries, pt: np.ndarray) -> np.ndarray:
    turned = motion.frequency_ratio * pt + motion.phase
    waves = [a * np.sin(k * turned + phi) for k, a, phi in motion.harmonics]
    return np.asarray(motion.amplitude * np.sum(waves, axis=0))


@given(WAVES)
def test_the_peak_is_that_of_many_samples_and_is_reached(
    waves: list[tuple[int, float, float]],
) -> None:
    motion = rs.motions.FourierSeries(amplitude=1.7, frequency_ratio=2.0, harmonics=tuple(waves))
    samples = np.abs(motion.acceleration(np.linspace(0.0, 2.0 * math.pi, 4_001)))
    bend = 1.7 * sum(abs(a) * k * k for k, a, _ in waves) * (math.pi / 4_000) ** 2
    assert samples.max() <= motion.peak * (1.0 + 1e-14)
    assert motion.peak <= samples.max() + bend
    assert abs(motion.acceleration(motion.peak_phase)) == pytest.approx(motion.peak, rel=1e-13)


def test_samples_give_the_series_that_they_are_of() -> None:
    motion = rs.motions.FourierSeries(
        amplitude=2.0,
        frequency_ratio=3.0,
        harmonics=((1, 1.0, 0.4), (3, -0.5, 1.0), (7, 0.2, -2.0)),
    )
    phases = np.arange(64) * (2.0 * math.pi / 64)
    again = rs.motions.FourierSeries.from_samples(
        5.0 + motion.acceleration(phases), frequency_ratio=3.0, orders=20
    )
    assert again.orders == (1, 3, 7)
    assert again.misfit(5.0 + motion.acceleration(phases)) < 1e-13
    fine = np.linspace(0.0, 7.0, 333)
    assert again.acceleration(fine) == pytest.approx(motion.acceleration(fine), abs=1e-13)
    fewer = rs.motions.FourierSeries.from_samples(
        motion.acceleration(phases), frequency_ratio=3.0, orders=3
    )
    assert fewer.misfit(motion.acceleration(phases)) == pytest.approx(0.4, rel=0.05)


def test_a_motion_is_one_segment_with_its_own_acceleration_and_displacement() -> None:
    motion = rs.motions.FourierSeries(
        amplitude=1.2, frequency_ratio=2.5, harmonics=((1, 1.0, 0.4), (4, -0.7, 1.0)), phase=0.3
    )
    run = rs.simulate(rs.DimensionlessBlock(restitution=0.8), motion, cycles=3)
    assert len(motion.segments()) == 1
    pt = np.linspace(0.0, run.end_time_pt, 50)
    assert run.base_acceleration(pt) == pytest.approx(by_hand(motion, pt), abs=1e-13)
    inner, h = pt[1:-1], 1e-4
    place = [run.base_displacement(inner + shift) for shift in (-h, 0.0, h)]
    second = (place[0] - 2.0 * place[1] + place[2]) / (h * h)
    assert second == pytest.approx(by_hand(motion, inner), abs=1e-5)
    turned = rs.motions.scale(motion, -2.0)
    (segment,) = turned.segments()
    assert segment.amplitude > 0.0
    reverse = rs.simulate(rs.DimensionlessBlock(restitution=0.8), turned, cycles=1)
    pt = np.linspace(0.0, reverse.end_time_pt, 50)
    assert reverse.base_acceleration(pt) == pytest.approx(-2.0 * by_hand(motion, pt), abs=1e-13)


def test_a_sum_of_two_harmonics_is_one_segment() -> None:
    one, other = (
        rs.Piecewise(
            pieces=(rs.motions.Segment(duration=60.0, amplitude=a, frequency=w, phase=phase),)
        )
        for a, w, phase in ((1.2, 4.0, 0.3), (0.6, 6.0, -0.4))
    )
    total = rs.motions.add(one, other)
    (segment,) = total.segments()
    assert [wave[0] for wave in segment.harmonics] == [2, 3]
    run = rs.simulate(rs.DimensionlessBlock(restitution=0.8), total)
    pt = np.linspace(0.0, 59.9, 400)
    expected = 1.2 * np.sin(4.0 * pt + 0.3) + 0.6 * np.sin(6.0 * pt - 0.4)
    assert run.base_acceleration(pt) == pytest.approx(expected, abs=1e-12)
    endless = rs.motions.add(
        rs.Harmonic(amplitude=1.2, frequency_ratio=4.0),
        rs.Harmonic(amplitude=0.6, frequency_ratio=6.0),
    )
    assert len(endless.segments()) == 1
    with pytest.raises(rs.errors.ModelError, match="whole multiples of one frequency"):
        rs.motions.add(
            rs.Harmonic(amplitude=1.2, frequency_ratio=4.0),
            rs.Harmonic(amplitude=0.6, frequency_ratio=4.0 * math.sqrt(2.0)),
        )


@every(
    ("harmonics", "words"),
    [
        ((), "a sequence of triples"),
        (((1, 1.0),), "a tuple of 3 values"),
        (((1, 1.0, 0.0), (1, 2.0, 0.0)), "order 1 may stand in it once"),
        (((0, 1.0, 0.0),), "from 1 to 64"),
        (((65, 1.0, 0.0),), "from 1 to 64"),
        (((1, 0.0, 0.0),), "one size must not be 0"),
        (((1, math.nan, 0.0),), "must not hold NaN"),
    ],
)
def test_what_is_no_series_is_refused(harmonics: Any, words: str) -> None:
    with pytest.raises(rs.errors.InputError, match=words):
        rs.motions.FourierSeries(amplitude=1.0, frequency_ratio=2.0, harmonics=harmonics)


def test_what_one_sinusoid_alone_has_is_refused_by_name() -> None:
    block = rs.DimensionlessBlock(restitution=0.8)
    motion = rs.motions.FourierSeries(
        amplitude=2.0, frequency_ratio=4.0, harmonics=((1, 1.0, 0.0),)
    )
    with pytest.raises(rs.errors.ModelError, match="a steady state needs harmonic shaking"):
        rs.simulate(block, motion, start=rs.Steady())
    with pytest.raises(rs.errors.ModelError, match="single sinusoid"):
        rs.map_fates(block, motion, axes={"phase": [0.0, 1.0]}, start=rs.Steady())
    with pytest.raises(rs.errors.ModelError, match="no vertical motion goes with a Fourier series"):
        rs.simulate(
            rs.Block.from_p(alpha=0.2, p=2.0),
            rs.BaseMotion(
                motion, rs.Piecewise(pieces=(rs.motions.Segment(duration=1.0, constant=0.1),))
            ),
        )
    with pytest.raises(rs.errors.ModelError, match="no constant and no slope"):
        rs.motions.Segment(duration=1.0, constant=1.0, frequency=1.0, harmonics=((1, 1.0, 0.0),))
    with pytest.raises(rs.errors.InputError, match="order 64"):
        rs.motions.FourierSeries(amplitude=1.0, frequency_ratio=200.0, harmonics=((64, 1.0, 0.0),))


@pytest.mark.parametrize(("count", "highest"), [(33, 16), (34, 16), (200, 16), (32, 15), (9, 4)])
def test_a_jolt_has_all_orders_up_to_sixteen_or_to_what_its_samples_allow(
    count: int, highest: int
) -> None:
    jolt = np.zeros(count)
    jolt[3] = 1.0
    series = rs.motions.FourierSeries.from_samples(jolt, frequency_ratio=2.0)
    assert series.orders == tuple(range(1, highest + 1))


def test_few_samples_have_the_orders_that_they_allow() -> None:
    few = rs.motions.FourierSeries.from_samples([0.0, 1.0, 0.0, -1.0], frequency_ratio=2.0)
    ((order, size, phase),) = few.harmonics
    assert order == 1
    assert (size, phase) == pytest.approx((1.0, 0.0), abs=1e-15)
    with pytest.raises(rs.errors.InputError, match="at most 1 orders"):
        rs.motions.FourierSeries.from_samples([0.0, 1.0, 0.0, -1.0], frequency_ratio=2.0, orders=2)


@pytest.mark.parametrize(
    ("orders", "odd"), [((1,), True), ((1, 3, 7), True), ((2,), False), ((1, 2), False)]
)
def test_odd_orders_alone_make_a_shaking_that_is_its_own_negative_half_a_period_on(
    orders: tuple[int, ...], odd: bool
) -> None:
    motion = rs.motions.FourierSeries(
        amplitude=1.3, frequency_ratio=2.0, harmonics=tuple((k, 1.0 / k, 0.3 * k) for k in orders)
    )
    assert motion.orders == orders
    assert motion.antisymmetric is odd
    phases = np.linspace(0.0, 6.0, 20)
    half = motion.acceleration(phases + math.pi) + motion.acceleration(phases)
    assert bool(np.abs(half).max() < 1e-12) is odd
    # The largest possible value is reached where all harmonics have their crest together.
    together = rs.motions.FourierSeries(
        amplitude=1.3,
        frequency_ratio=2.0,
        harmonics=tuple((k, 1.0 / k, 0.5 * math.pi) for k in orders),
    )
    assert together.peak == pytest.approx(1.3 * sum(1.0 / k for k in orders), rel=1e-12)


def test_phases_and_samples_that_are_no_numbers_are_refused() -> None:
    motion = rs.motions.FourierSeries(
        amplitude=1.0, frequency_ratio=2.0, harmonics=((1, 1.0, 0.0),)
    )
    wrong: list[Any] = [
        math.nan,
        math.inf,
        "a",
        [0.0, math.nan],
        None,
        1.1e50,
        -1.1e50,
        [[1.0], []],
    ]
    for value in wrong:
        with pytest.raises(rs.errors.InputError, match="phase"):
            motion.acceleration(value)
    assert motion.acceleration(1e50).shape == ()
    rows: list[Any] = [[1.0, 2.0], 1.0, [[1.0, 2.0, 3.0]], [], np.zeros(1_000_001)]
    for value in rows:
        with pytest.raises(rs.errors.InputError, match="a row of 3 to 1000000 numbers"):
            motion.misfit(value)
    assert motion.misfit([0.0, 0.0, 0.0]) == pytest.approx(math.sin(2.0 * math.pi / 3.0))


def test_rounding_is_no_harmonic_of_samples() -> None:
    turn = 2.0 * math.pi * np.arange(64) / 64
    for share, kept in ((1e-11, (1, 5)), (1e-13, (1,))):
        samples = np.sin(turn) + share * np.sin(5.0 * turn)
        series = rs.motions.FourierSeries.from_samples(samples, frequency_ratio=1.0)
        assert series.orders == kept, share


def test_samples_that_are_all_the_same_are_no_shaking() -> None:
    for level in (0.0, 2.0, 0.1, -1e-30):
        for count in (3, 16, 17):
            with pytest.raises(rs.errors.InputError, match="they must differ from their mean"):
                rs.motions.FourierSeries.from_samples(np.full(count, level), frequency_ratio=1.0)
