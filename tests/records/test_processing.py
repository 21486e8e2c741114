"""Cleaning and resampling: nothing is done unasked, and all that is done is noted."""

from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import read_record
from rocksteady.errors import InputError
from rocksteady.records import Cleaning, Recording, resample
from tests.every import every
from tests.records import recording
from tests.records.writers import at2, samples

Floats = NDArray[np.float64]


def levelled(one: Recording, baseline: str) -> Recording:
    return Cleaning(baseline=baseline).apply(one)


@every(
    ("baseline", "order"), [("mean", 0), ("linear", 1), ("polynomial:2", 2), ("polynomial:5", 5)]
)
def test_a_polynomial_is_taken_off_and_noted(baseline: str, order: int) -> None:
    values = samples(500)
    time = np.linspace(0.0, 5.0, 500)
    # NumPy's other fit, in powers of the time itself.
    expected = values - np.polyval(np.polyfit(time, values, order), time)
    drifting = values + sum(0.3 * (time - 1.0) ** power for power in range(order + 1))
    found = levelled(recording(drifting), baseline)
    np.testing.assert_allclose(found.record.acceleration_m_s2, expected, atol=1e-9)
    assert len(found.processing) == 1
    assert "fitted by least squares, taken off" in found.processing[0]


@every("baseline", ["linear", "polynomial:2", "polynomial:10"])
def test_a_record_is_at_most_a_polynomial_through_its_samples(baseline: str) -> None:
    values = np.array([0.3, -1.0])
    found = levelled(recording(values), baseline).record.acceleration_m_s2
    np.testing.assert_allclose(found, 0.0, atol=1e-15)


def test_none_is_none_and_nothing_else_is_known() -> None:
    one = recording(samples(100))
    assert levelled(one, "none") is one
    wrong = ("", "none:1", "mean:1", "linear:1", "pre:", "pre:0", "pre:-1", "polynom:1")
    numbers = (
        "polynomial",
        *(f"polynomial:{order}" for order in ("", "11", "-1", "1.5", "0" * 10)),
    )
    for baseline in (*wrong, *numbers):
        with pytest.raises(InputError, match=r"baseline = .*pre:SECONDS, linear or polynomial:N"):
            levelled(one, baseline)


def test_read_record_leaves_the_baseline_as_it_is_unless_asked(tmp_path: Path) -> None:
    path = tmp_path / "hut.AT2"
    path.write_text(at2(samples(200) + 0.25))
    assert read_record(path).acceleration_m_s2.mean() > 1.0
    assert (
        abs(read_record(path, cleaning=Cleaning(baseline="mean")).acceleration_m_s2.mean()) < 1e-12
    )


@every(
    ("low", "high", "words"),
    [("0.5", "", "from 0.5 Hz"), ("", "12", "up to 12 Hz"), ("0.5", "12", "0.5 to 12 Hz")],
)
def test_a_filter_has_the_gain_of_butterworth_and_no_phase(low: str, high: str, words: str) -> None:
    """Its gain in closed form, on the Fourier transform of a shock with quiet ends."""
    shock = np.zeros(4096)
    shock[1800:2000] = samples(200)
    expected = np.fft.rfft(shock)
    detuned = np.tan(np.pi * 0.01 * np.fft.rfftfreq(len(shock), 0.01))
    if low:
        expected *= 1.0 - 1.0 / (1.0 + (detuned / np.tan(np.pi * 0.01 * float(low))) ** 4)
    if high:
        expected /= 1.0 + (detuned / np.tan(np.pi * 0.01 * float(high))) ** 4
    found = Cleaning(filter_hz=f"{low}:{high}").apply(recording(shock))
    kept = np.fft.irfft(expected, len(shock))
    np.testing.assert_allclose(found.record.acceleration_m_s2, kept, atol=1e-6)
    assert found.processing == (f"filter: {words}, Butterworth of order 4 without phase shift",)


def test_offset_filter_and_trim_follow_each_other() -> None:
    """The offset is that of the quiet part, though it is trimmed; times of day move along."""
    begin = datetime(2020, 1, 1, tzinfo=UTC)
    values = 0.3 + np.concatenate([np.zeros(200), samples(500)])
    raw = recording(values, processing=(), start_time=begin)
    found = Cleaning(baseline="pre:1.99", filter_hz="0.5:20", trim_s="2:6.5").apply(raw)
    filtered = Cleaning(filter_hz="0.5:20").apply(levelled(raw, "pre:1.99"))
    assert found == Cleaning(trim_s="2:6.5").apply(filtered)
    assert found.record.duration_s == pytest.approx(4.5)
    assert found.start_time == begin + timedelta(seconds=2.0)
    assert found.processing == (
        "baseline: the mean of the first 1.99 s, taken off (0.3 m/s^2 at most)",
        "filter: 0.5 to 20 Hz, Butterworth of order 4 without phase shift",
        "trim: 2 to 6.5 s kept",
    )
    offset = Cleaning(baseline="pre:1.99", trim_s="2:").apply(raw).record.acceleration_m_s2
    np.testing.assert_allclose(offset, samples(500), atol=1e-15)


@every(
    ("name", "given", "words"),
    [
        ("filter_hz", ":50", r"lie in \[0.0001, 50\) Hz, below the Nyquist frequency of hut.csv"),
        ("filter_hz", "1e-9:", "Nyquist"),
        *(("trim_s", part, "has 0.99 s; give times inside") for part in ("0:1", "1:", "2:3")),
        ("trim_s", "0.101:0.102", "no two samples"),
        ("baseline", "pre:1", "has 0.99 s"),
        *(
            ("filter_hz", given, "the first one below the second")
            for given in ("", ":", "5", "2:1", "2:2", "-1:2", "nan:2", "a:b", "1:2:3")
        ),
    ],
)
def test_what_a_record_does_not_have_is_refused(name: str, given: str, words: str) -> None:
    with pytest.raises(InputError, match=f"^{name} = '{given}' is not valid: .*{words}"):
        Cleaning(**{name: given}).apply(recording(samples(100)))


@every("divisor", [1, 2, 3, 7])
def test_a_finer_interval_leaves_the_motion_as_it_is(divisor: int) -> None:
    one = recording(samples(300))
    finer = resample(one, 0.01 / divisor)
    np.testing.assert_allclose(
        finer.record.acceleration_m_s2[::divisor], one.record.acceleration_m_s2, atol=1e-12
    )
    assert finer.record.duration_s == pytest.approx(one.record.duration_s)
    assert (finer is one) == (divisor == 1)
    if divisor > 1:
        assert finer.processing == (f"resampled from 0.01 s to {0.01 / divisor:g} s (linear)",)


@every("dt", [0.005, 0.02, 0.025])
def test_what_the_new_interval_cannot_show_is_filtered(dt: float) -> None:
    time = 0.01 * np.arange(4000)
    window = np.sin(np.pi * time / time[-1]) ** 2
    slow, fast = (np.sin(2.0 * np.pi * hertz * time) * window for hertz in (1.3, 43.0))
    found = resample(recording(slow + fast), dt, method="filtered").record.acceleration_m_s2
    new = dt * np.arange(len(found))
    if dt > 0.01:
        np.testing.assert_allclose(found, np.interp(new, time, slow), atol=5e-3)
    else:
        np.testing.assert_allclose(found[::2], slow + fast, atol=5e-3)


@every("dt", [0.0, -1.0, float("nan"), 1e-9, 10.0])
def test_intervals_that_leave_no_record(dt: float) -> None:
    with pytest.raises(InputError, match="dt_s"):
        resample(recording(samples(100)), dt)


def test_methods_and_ratios_that_are_not_known() -> None:
    with pytest.raises(InputError, match="use linear or filtered"):
        resample(recording(samples(100)), 0.02, method="cubic")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="whole numbers"):
        resample(recording(samples(100)), 0.01 * np.pi, method="filtered")


def test_what_is_taken_off_in_words() -> None:
    values = np.array([1.0, 2.0, 4.0, 1.0])
    for baseline, what, largest in (
        ("mean", "the mean", 2.0),
        ("linear", "a straight line", 2.3),
        ("polynomial:0", "the mean", 2.0),
        ("polynomial:1", "a straight line", 2.3),
        ("polynomial:2", "a polynomial of order 2", 3.1),
        ("polynomial:10", "a polynomial of order 10", 4.0),
    ):
        (note,) = levelled(recording(values, processing=()), baseline).processing
        words = f"baseline: {what}, fitted by least squares, taken off"
        assert note == f"{words} ({largest:.3g} m/s^2 at most)", baseline


def test_a_resampled_record_ends_with_its_last_whole_interval() -> None:
    """0.99 s in all: as many samples as begin in it, whatever rounding makes of the quotient."""
    single = recording(samples(100))
    for dt, count in (
        *((0.99, 2), (0.495, 3), (0.33, 4), (0.5, 2), (0.03, 34), (0.02, 50), (0.98, 2)),
        *((0.0099, 101), (0.0011, 901), (0.011, 91), (0.99 / 7, 8), (0.99 / 49, 50)),
    ):
        result = resample(single, dt)
        assert len(result.record.acceleration_m_s2) == count, dt
        np.testing.assert_allclose(
            result.record.acceleration_m_s2,
            np.interp(dt * np.arange(count), 0.01 * np.arange(100), samples(100)),
            atol=1e-12,
        )
        assert result.processing == (f"resampled from 0.01 s to {dt:g} s (linear)",)
    for same, kept in ((0.01 * (1.0 + 1e-10), True), (0.01 * (1.0 + 1e-8), False)):
        assert (resample(single, same) is single) == kept
    for wrong, words in (
        (0.991, "0.99 s would have 1 samples; give an interval near the record's, 0.01 s"),
        (5.0, "0.99 s would have 1 samples"),
        (1e-9, "0.99 s would have 990000000 samples"),
        (0.99 / 20_000_000, "0.99 s would have 20000000"),
    ):
        with pytest.raises(InputError, match=words):
            resample(single, wrong)


def test_ratios_of_whole_numbers_up_to_a_thousand_can_be_filtered() -> None:
    single = recording(samples(3000))
    for finer, coarser in ((1, 2), (2, 1), (3, 7), (1, 999), (1, 1000)):
        result = resample(single, 0.01 * coarser / finer, method="filtered").record
        assert len(result.acceleration_m_s2) == 2999 * finer // coarser + 1
    for ratio in (1001.0, 1.0 / 1001.0, 2.0**0.5, 1.0 + 1e-6):
        with pytest.raises(InputError, match="one of whole numbers up to 1000; give such an inter"):
            resample(single, 0.01 * ratio, method="filtered")
