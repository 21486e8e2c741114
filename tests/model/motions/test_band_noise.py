"""Noise of a band: its spectrum, its realisations, and the exact sum with another motion."""

import math
from functools import partial
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady import BaseMotion, Block, Harmonic, Piecewise, Pulse, Record, Still
from rocksteady.dynamics.history.base_motion import base_acceleration, impulses
from rocksteady.errors import InputError, ModelError
from rocksteady.model.linear_tables import segment_table
from rocksteady.motions import BandNoise, Impulses, Segment, add_noise
from tests.every import every

NOISE = BandNoise(rms=0.2, band=(1.0, 10.0), duration=30.0, seed=1)
MANY = 200
BLOCK = Block.rectangle(width=0.8, height=3.0)
RECORD = Record(acceleration_m_s2=np.sin(0.3 * np.arange(200)), dt_s=0.05)


def realisations() -> Any:
    return np.array([NOISE.realisation(number).samples for number in range(MANY)])


def test_rms_band_and_distribution_are_as_stated() -> None:
    found = realisations()
    # A realisation has 85 sinusoids, and all of them 17,000: the mean square scatters by 0.8 %.
    assert (found**2).mean() == pytest.approx(0.04, rel=0.03)
    assert (found[:, 7] ** 4).mean() / (found[:, 7] ** 2).mean() ** 2 == pytest.approx(3.0, abs=1.0)
    # Stationary: the same at all times, here at 20 of them, with 200 realisations each.
    each = (found[:, :: found.shape[1] // 20] ** 2).mean(axis=0) / 0.04
    assert (np.abs(each - 1.0) < 5.0 * math.sqrt(2.0 / MANY)).all()
    # Nothing outside the band, and a flat spectrum inside, by periodograms with a Hann window.
    window = np.hanning(found.shape[1])
    power = (np.abs(np.fft.rfft(found * window, axis=1)) ** 2).mean(axis=0)
    ratio = 2.0 * math.pi * np.fft.rfftfreq(found.shape[1], NOISE.step)
    inside = (ratio > 1.5) & (ratio < 9.5)
    outside = (ratio < 0.4) | (ratio > 10.6)
    assert power[outside].max() < 1e-4 * power[inside].mean()
    assert power[inside].std() / power[inside].mean() < 2.0 / math.sqrt(MANY)


def test_realisations_are_independent_and_their_ends_too() -> None:
    found = realisations()
    between = np.corrcoef(found[:40])[np.triu_indices(40, 1)]
    # A correlation of two of them has some 170 degrees of freedom.
    assert np.abs(between).max() < 0.4
    assert np.abs(between.mean()) < 0.02
    ends = np.corrcoef(found[:, 0], found[:, -1])[0, 1]
    assert abs(ends) < 4.0 / math.sqrt(MANY)
    other = BandNoise(rms=0.2, band=(1.0, 10.0), duration=30.0, seed=2)
    assert not np.array_equal(other.samples, NOISE.samples)


def test_a_realisation_depends_on_its_number_alone() -> None:
    fifth = NOISE.realisation(5)
    first = fifth.samples.copy()
    for number in reversed(range(40)):  # more than are kept
        _ = NOISE.realisation(number).samples
    assert np.array_equal(BandNoise(rms=0.2, band=(1.0, 10.0), duration=30.0, seed=1, number=5)
                          .samples, first)  # fmt: skip
    assert np.array_equal(fifth.samples, first)


@pytest.mark.parametrize("number", [0, 3])
def test_the_samples_are_the_sum_that_the_docstring_has(number: int) -> None:
    # 2 pi k/60 from 1 to 10: k from 10 to 95.
    k = np.arange(10, 96)
    drawn = np.random.default_rng(np.random.SeedSequence(1, spawn_key=(number,))).random((86, 2))
    size = 0.2 * np.sqrt(-2.0 * np.log1p(-drawn[:, 0]) / 86.0)
    s = NOISE.step * np.arange(len(NOISE.samples))
    turned = np.outer(s, 2.0 * math.pi * k / 60.0) - 2.0 * math.pi * drawn[:, 1]
    expected = np.cos(turned) @ size
    np.testing.assert_allclose(NOISE.realisation(number).samples, expected, rtol=0.0, atol=1e-13)


def test_a_sinusoid_alone_is_sampled_as_it_is() -> None:
    # A band around one sinusoid of the process, k = 20 of 2 pi k/60.
    one = BandNoise(rms=1.0, band=(2.08, 2.11), duration=30.0, seed=3)
    s = one.step * np.arange(len(one.samples))
    turn = 2.0 * math.pi * 20 / 60.0
    basis = np.column_stack([np.cos(turn * s), np.sin(turn * s)])
    _, left, *_ = np.linalg.lstsq(basis, one.samples, rcond=None)
    assert left[0] < 1e-20


MOTIONS: dict[str, Any] = {
    "still": Still(),
    "harmonic": Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=1.0),
    "pulse": Pulse(shape="type-c1", amplitude=2.0, frequency_ratio=0.3),
    "wavelet": Pulse(shape="ricker", amplitude=2.0, frequency_ratio=1.0, tolerance=1e-3),
    "impulses": Impulses(velocities=(0.3, -0.4, 0.2), times=(0.0, 11.0, 40.0)),
    "record": RECORD,
}


@every("name", MOTIONS)
def test_the_sum_is_the_sum_of_both_at_any_time(name: str) -> None:
    motion = MOTIONS[name]
    total = segment_table(add_noise(motion, NOISE, block=BLOCK))
    alone, noise = segment_table(motion, BLOCK), segment_table(NOISE)
    s = np.random.default_rng(0).uniform(0.0, 29.99, 2000)
    expected = base_acceleration(alone, s) + base_acceleration(noise, s)
    np.testing.assert_allclose(base_acceleration(total, s), expected, rtol=0.0, atol=1e-9)
    times, sizes = impulses(total)
    np.testing.assert_allclose(times, impulses(alone)[0], rtol=1e-12)
    assert sizes.tolist() == impulses(alone)[1].tolist()
    later = np.linspace(30.1, 60.0, 50)
    rest = 0.0 if name == "harmonic" else base_acceleration(alone, later)
    np.testing.assert_allclose(base_acceleration(total, later), rest, atol=1e-9)


@every("name", MOTIONS)
def test_noise_of_rms_0_leaves_the_motion_as_it_is(name: str) -> None:
    motion = MOTIONS[name]
    quiet = add_noise(motion, NOISE.realisation(0, rms=0.0), block=BLOCK)
    found, alone = segment_table(quiet), segment_table(motion, BLOCK)
    if name == "harmonic":  # ends with the noise
        assert found[0, 0] == 30.0
        assert np.array_equal(found[0, 1:7], alone[0, 1:7])
    else:
        assert np.array_equal(found, alone)


def test_the_vertical_component_has_no_noise() -> None:
    up = RECORD.scaled(0.5)
    found = add_noise(BaseMotion(RECORD, up), NOISE, block=BLOCK)
    assert isinstance(found, BaseMotion)
    assert found.vertical == up
    assert found.horizontal == add_noise(RECORD, NOISE, block=BLOCK)


@given(
    rms=st.floats(0.0, 10.0),
    low=st.floats(0.05, 5.0),
    wide=st.floats(0.5, 10.0),
    duration=st.floats(7.0, 60.0),
    seed=st.integers(0, 2**64 - 1),
)
def test_any_noise_is_a_motion(
    rms: float, low: float, wide: float, duration: float, seed: int
) -> None:
    noise = BandNoise(rms=rms, band=(low, low + wide), duration=duration, seed=seed)
    pieces = noise.segments()
    if rms:
        assert sum(piece.duration for piece in pieces) == pytest.approx(duration)
        assert 20 <= 2.0 * math.pi / ((low + wide) * noise.step) < 30
    assert np.isfinite(noise.samples).all()
    assert isinstance(add_noise(Still(), noise), Piecewise)


def test_si_units_are_those_of_the_block() -> None:
    noise = BandNoise.from_si(BLOCK, rms_m_s2=0.3, band_hz=(0.5, 5.0), duration_s=20.0, seed=1)
    assert noise.rms * BLOCK.uplift_acceleration == pytest.approx(0.3)
    assert noise.band[1] * BLOCK.p / (2.0 * math.pi) == pytest.approx(5.0)
    assert noise.duration / BLOCK.p == pytest.approx(20.0)


def test_what_is_no_noise_is_refused() -> None:
    good: dict[str, Any] = {"rms": 0.1, "band": (1.0, 5.0), "duration": 20.0, "seed": 1}
    for name, value in (
        ("rms", -0.1),
        ("rms", math.nan),
        ("band", (5.0, 1.0)),
        ("band", (0.0, 1.0)),
        ("band", 3.0),
        ("band", (1.0, 1.001)),
        ("duration", 0.0),
        ("duration", 1e6),
        ("seed", -1),
        ("seed", 2**64),
        ("seed", 1.5),
        ("number", -1),
    ):
        with pytest.raises(InputError, match=name):
            BandNoise(**{**good, name: value})
    with pytest.raises(InputError, match="1e9 products"):
        BandNoise(rms=0.1, band=(1.0, 5.0), duration=12000.0, seed=1)
    # Eight sinusoids: how many there are counts, not how high they are.
    assert BandNoise(rms=0.1, band=(1000.0, 1000.5), duration=50.0, seed=1).duration == 50.0
    with pytest.raises(ModelError, match="block"):
        add_noise(RECORD, NOISE)


def durations(motion: Any) -> list[float]:
    return [piece.duration for piece in motion.segments()]


def test_the_sum_is_cut_at_samples_and_at_starts_and_nowhere_else() -> None:
    lines = len(NOISE.segments())
    over_harmonic = add_noise(Harmonic(amplitude=2.0, frequency_ratio=4.0), NOISE)
    # Whole lines last one step to the last digit.
    assert set(durations(over_harmonic)[:-1]) == {NOISE.step}
    assert len(durations(over_harmonic)) == lines
    for shift, more in ((0.0, 0), (1e-10, 0), (-1e-10, 0), (1e-8, 1), (-1e-8, 1), (0.5, 1)):
        for place in (1, 7, 100):
            edge = (place + shift) * NOISE.step
            pieces = (Segment(duration=edge, constant=1.0), Segment(duration=40.0, constant=-1.0))
            total = add_noise(Piecewise(pieces=pieces), NOISE)
            lasting = durations(total)
            # The rest of the second segment follows the noise.
            assert len(lasting) == lines + more + 1, (shift, place)
            assert min(lasting) > 5e-9 * NOISE.step, (shift, place)
            assert lasting.count(NOISE.step) >= lines - 3, (shift, place)
            assert math.fsum(lasting) == pytest.approx(40.0 + edge, rel=1e-12)


def test_segments_shorter_than_a_step_keep_their_durations() -> None:
    short = NOISE.step / 7.3
    comb = tuple(Segment(duration=short, constant=float(k)) for k in range(30))
    total = add_noise(Piecewise(pieces=comb), NOISE)
    assert durations(total)[:5] == [short] * 5
    cuts = np.cumsum(durations(total))
    for place in range(1, 30):
        assert np.abs(cuts - place * short).min() < 1e-12
    for place in range(1, 20):
        assert np.abs(cuts - place * NOISE.step).min() < 1e-12


@every(
    ("last", "ends"),
    [
        (Segment(duration=math.inf, constant=0.5), True),
        (Segment(duration=math.inf, amplitude=0.5, frequency=2.0), True),
        (Segment(duration=math.inf), False),
        (Segment(duration=math.inf, jump=0.3), False),
    ],
)
def test_what_shakes_for_ever_ends_with_the_noise(last: Segment, ends: bool) -> None:
    first = Segment(duration=1.3, constant=0.2)
    for pieces in ((last,), (first, last)):
        total = add_noise(Piecewise(pieces=pieces), NOISE)
        table = segment_table(total)
        later = np.array([30.001, 45.0, 1e4])
        assert base_acceleration(table, later).tolist() == [0.0, 0.0, 0.0]
        if ends:
            assert math.fsum(durations(total)) == pytest.approx(30.0, rel=1e-12)
        times, sizes = impulses(table)
        assert sizes.tolist() == ([last.jump] if last.jump else [])
        assert all(time == pytest.approx(1.3 if len(pieces) == 2 else 0.0) for time in times)


def test_a_segment_without_a_sinusoid_has_no_phase_in_the_sum() -> None:
    quiet = Segment(duration=50.0, constant=1.0, frequency=3.0, phase=0.4)
    total = add_noise(Piecewise(pieces=(quiet,)), NOISE)
    assert {(piece.frequency, piece.phase) for piece in total.segments()} == {(0.0, 0.0)}
    loud = add_noise(
        Piecewise(pieces=(Segment(duration=50.0, amplitude=1.0, frequency=3.0),)), NOISE
    )
    assert {piece.frequency for piece in loud.segments()} == {3.0}
    assert add_noise(Still(), NOISE).segments() == NOISE.segments()


def test_lines_products_and_sinusoids_end_where_they_say() -> None:
    # 20 samples for each of 100 p: 200 000 lines are 628.3 long.
    most = 200_000 * 2.0 * math.pi / 2000.0
    narrow: dict[str, Any] = {"rms": 0.0, "band": (99.9, 100.0), "seed": 1}
    assert len(BandNoise(**narrow, duration=most * (1.0 - 1e-12)).samples) == 200_001
    with pytest.raises(InputError) as caught:
        BandNoise(**narrow, duration=most * 1.00001)
    assert caught.value.valid == ("it would take 200,002 straight lines, and 200,000 are the most")
    assert caught.value.hint == "give 628 or less, or a lower band"
    # Sinusoids are pi/duration apart: at 1.0 p this band has one, or none.
    for low, high, fit in ((1.0, 1.05, True), (0.95, 1.0, True), (1.01, 1.05, False)):
        call = partial(BandNoise, rms=0.1, band=(low, high), duration=10.0 * math.pi, seed=1)
        if fit:
            call()
        else:
            with pytest.raises(InputError, match=r"in this duration they are 0\.1 apart"):
                call()
    # Lines are 20 * 5 d/(2 pi), sinusoids 4.99 d/pi: 1e9 products where d is 6289.
    wide = partial(BandNoise, rms=0.0, band=(0.01, 5.0), seed=1)
    assert wide(duration=6285.0).duration == 6285.0
    with pytest.raises(
        InputError, match=r"100,1\d\d samples of 9,99\d sinusoids are more than 1e9"
    ):
        wide(duration=6293.0)


def test_the_number_and_the_rms_of_a_realisation_are_those_asked_for() -> None:
    assert NOISE.realisation(3) == BandNoise(
        rms=0.2, band=(1.0, 10.0), duration=30.0, seed=1, number=3
    )
    louder = NOISE.realisation(3, rms=0.4)
    np.testing.assert_allclose(louder.samples, 2.0 * NOISE.realisation(3).samples, rtol=1e-14)
    assert NOISE.realisation(0, rms=0.0).segments() == ()
    assert not NOISE.realisation(0, rms=0.0).samples.any()
    assert len(NOISE.samples) == len(NOISE.segments()) + 1
