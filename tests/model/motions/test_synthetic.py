"""Synthetic motions: seeds, spectrum, envelope, and that they are what they say."""

import math
from typing import Any

import numpy as np
import pytest
from scipy import signal

from rocksteady import Block, SyntheticMotion
from rocksteady.dynamics.history.base_motion import base_acceleration
from rocksteady.errors import InputError
from rocksteady.model.linear_tables import segment_table
from tests.every import every
from tests.model.motions.test_pulses import Floats


def motion(seed: int = 1, **more: Any) -> SyntheticMotion:
    given = {"rms": 0.5, "frequency_ratio": 6.0, "duration": 30.0, "seed": seed} | more
    return SyntheticMotion(**given)


def test_one_seed_is_one_motion_and_another_is_another() -> None:
    first, again, other = motion(3), motion(3), motion(4)
    assert first.samples.tobytes() == again.samples.tobytes()
    assert first.segments() == again.segments()
    assert not np.array_equal(first.samples, other.samples)


def test_the_motion_is_straight_between_its_samples() -> None:
    one = motion()
    table = segment_table(one)
    at = np.arange(len(one.samples) - 1) * one.step
    np.testing.assert_allclose(base_acceleration(table, at + 1e-9), one.samples[:-1], atol=1e-6)
    half = 0.5 * (one.samples[1:] + one.samples[:-1])
    np.testing.assert_allclose(base_acceleration(table, at + 0.5 * one.step), half, atol=1e-12)
    assert math.fsum(piece.duration for piece in one.segments()) == pytest.approx(30.0)
    assert float(base_acceleration(table, 30.001)) == 0.0


@every("seed", range(5))
def test_the_base_ends_with_velocity_0(seed: int) -> None:
    one = motion(seed)
    end = float(np.trapezoid(one.samples))
    assert abs(end) < 1e-12 * float(np.abs(np.cumsum(one.samples)).max())


def target(x: Floats, damping: float, high: float) -> Floats:
    """Clough and Penzien's density over that of the noise, x = omega/omega_g."""
    ground = (1.0 + (2.0 * damping * x) ** 2) / ((1.0 - x**2) ** 2 + (2.0 * damping * x) ** 2)
    return np.asarray(ground * x**4 / ((high**2 - x**2) ** 2 + (2.0 * damping * high * x) ** 2))


@pytest.mark.parametrize(("damping", "high"), [(0.6, 0.1), (0.2, 0.3)])
def test_the_spectrum_is_the_target_on_average(damping: float, high: float) -> None:
    shape = {"rise": 0.0, "decay": 0.0, "filter_damping": damping, "high_pass_ratio": high}
    runs = [motion(seed, duration=60.0, **shape) for seed in range(400)]
    samples = np.array([one.samples[:-1] for one in runs])
    assert np.sqrt(np.mean(samples**2)) == pytest.approx(0.5, rel=0.01)
    step = runs[0].step
    power = np.mean(np.abs(np.fft.rfft(samples, axis=1)) ** 2, axis=0)
    ratio = np.arange(len(power)) * 2.0 * math.pi / (samples.shape[1] * step * 6.0)
    # the target with the same mean square over all frequencies that the samples can hold
    x = np.linspace(0.0, 20.0, 200_001)
    density = target(ratio, damping, high) / np.trapezoid(target(x, damping, high), x)
    # one-sided, over x, of a process with mean square 1
    found = power * 2.0 * step / (2.0 * math.pi * samples.shape[1]) * 6.0 / 0.25
    # twelve neighbouring frequencies of 400 runs: 1.4 % of scatter
    bands = np.arange(12, 12 * (len(ratio) // 12), 12)
    wide = np.add.reduceat(found, bands) / np.add.reduceat(density, bands)
    within = ratio[bands] < 3.0
    np.testing.assert_allclose(wide[within], 1.0, atol=0.08)


@every(("damping", "high"), [(0.6, 0.1), (0.2, 0.3)])
def test_the_filters_are_those_of_the_docstring_in_phase_too(damping: float, high: float) -> None:
    one = motion(filter_damping=damping, high_pass_ratio=high)
    turn, found = signal.sosfreqz(one._filters(), 64)
    # The bilinear transformation, over omega_g = 6.
    s = 2.0j / one.step * np.tan(0.5 * turn) / 6.0
    ground = (2.0 * damping * s + 1.0) / (s * s + 2.0 * damping * s + 1.0)
    low = s * s / (s * s + 2.0 * damping * high * s + high * high)
    np.testing.assert_allclose(found, ground * low, rtol=1e-9)


def test_the_envelope() -> None:
    runs = np.array([motion(seed, rise=0.2, decay=0.4).samples for seed in range(400)])
    size = np.sqrt(np.mean(runs**2, axis=0)) / 0.5
    part = np.linspace(0.0, 1.0, runs.shape[1])
    for at, expected in ((0.1, 0.25), (0.3, 1.0), (0.5, 1.0), (0.8, 0.1), (1.0, 0.01)):
        near = np.abs(part - at) < 0.02
        assert size[near].mean() == pytest.approx(expected, rel=0.2), at


def test_in_si() -> None:
    block = Block.rectangle(width=0.5, height=2.0)
    one = SyntheticMotion.from_si(block, rms_m_s2=1.0, frequency_hz=2.5, duration_s=20.0, seed=7)
    assert one.rms * block.uplift_acceleration == pytest.approx(1.0)
    assert one.frequency_ratio * block.p == pytest.approx(2.0 * math.pi * 2.5)
    assert one.step / block.p == pytest.approx(1.0 / 2.5 / 40.0, rel=1e-3)
    assert len(one.samples) == 2001


@every(
    ("name", "value"),
    [
        ("rms", -1.0),
        ("frequency_ratio", 0.0),
        ("duration", 0.0),
        ("duration", 1e6),
        ("seed", -1),
        ("seed", 1.5),
        ("filter_damping", 0.0),
        ("filter_damping", 1.1),
        ("high_pass_ratio", 0.0),
        ("high_pass_ratio", 1.0),
        ("rise", -0.1),
        ("rise", 1.1),
        ("decay", 0.9),
    ],
)
def test_what_is_out_of_range_is_refused(name: str, value: Any) -> None:
    with pytest.raises(InputError, match=f"^{name} = "):
        motion(**{name: value})


def test_the_shortest_and_the_plainest() -> None:
    assert len(motion(duration=1e-3).samples) == 2
    assert not motion(rms=0.0).samples.any()
    assert np.isfinite(motion(rise=1.0, decay=0.0).samples).all()
    assert np.isfinite(motion(filter_damping=1.0).samples).all()


def test_the_hint_of_a_motion_too_short_for_its_filters_is_long_enough() -> None:
    slow: dict[str, Any] = {"filter_damping": 0.01, "high_pass_ratio": 0.001, "rise": 0.0}
    for ratio in (0.5, 6.0):
        with pytest.raises(InputError) as caught:
            motion(frequency_ratio=ratio, duration=1e-4 / ratio, **slow)
        assert "and 1e+07 are the most" in caught.value.valid
        least = float(caught.value.hint.removeprefix("give ").removesuffix(" or more"))
        motion(frequency_ratio=ratio, duration=1.01 * least, **slow)
        with pytest.raises(InputError):
            motion(frequency_ratio=ratio, duration=0.98 * least, **slow)


def test_samples_are_40_for_each_period_of_the_ground_to_a_whole_number() -> None:
    for ratio, duration in ((6.0, 30.0), (1.3, 7.0), (50.0, 0.01), (0.05, 1.0)):
        one = motion(frequency_ratio=ratio, duration=duration, filter_damping=1.0)
        ideal = 2.0 * math.pi / (40.0 * ratio)
        lines = max(1, round(duration / ideal))
        assert one.step == pytest.approx(duration / lines, rel=1e-14)
    most = 200_000 * 2.0 * math.pi / (40.0 * 6.0)
    assert motion(duration=most * (1.0 - 1e-12)).duration < most
    with pytest.raises(InputError, match=r"^duration = .* it must lie in \(0, 5235\.98"):
        motion(duration=most * (1.0 + 1e-9))
