"""Times that are printed with few digits: what the printing explains is even, and nothing else."""

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rocksteady.errors import RecordFileError
from rocksteady.records import Recording, read_recordings
from rocksteady.records.core.assembling import Given
from rocksteady.records.core.sampling import Spaced, evenly_spaced, interpolated, places
from rocksteady.records.core.text import RecordText
from tests.every import every


def table(folder: Path, times: list[str]) -> Recording:
    """Return what is read of a table with these times."""
    values = np.random.default_rng(1).normal(size=len(times))
    rows = (f"{time},{value:.6f}" for time, value in zip(times, values, strict=True))
    path = folder / "table.csv"
    path.write_text("time (s),acc (m/s2)\n" + "\n".join(rows) + "\n")
    (found,) = read_recordings(path)
    np.testing.assert_array_equal(found.record.acceleration_m_s2, np.round(values, 6))
    return found


@pytest.mark.slow
@every(
    ("dt", "count", "form", "certain"),
    [
        (0.00125, 12000, "%g", True),
        (0.00125, 8008, "%g", False),
        (1 / 128, 5120, "%g", True),
        (0.005, 40000, "%.5g", False),
        (0.00125, 8000, "%.4f", True),
        (0.00125, 8000, "%.3f", False),
        (1 / 60, 2000, "%.4f", False),
        (0.004, 5000, "%.3e", False),
        (0.00125, 20, "%.4f", False),
        (0.005, 2000, "%.17g", True),
    ],
)
@every("start", [0.0, 12.5])
def test_times_of_few_digits(
    tmp_path: Path, dt: float, count: int, form: str, certain: bool, start: float
) -> None:
    found = table(tmp_path, [form % (start + k * dt) for k in range(count)])
    assert found.record.dt_s == pytest.approx(dt, rel=1e-12)
    if start == 0.0:
        assert ("digits of its times leave" in " ".join(found.warnings)) != certain
    assert found.processing == ()


@every(("dt", "decimals"), [(0.00125, 4), (0.00125, 3), (1 / 128, 4), (0.005, 2)])
def test_times_that_are_cut_off(tmp_path: Path, dt: float, decimals: int) -> None:
    scale = 10.0**decimals
    times = [f"{math.floor(k * dt * scale + 1e-9) / scale:.{decimals}f}" for k in range(5000)]
    assert table(tmp_path, times).record.dt_s == pytest.approx(dt, rel=1e-12)


@settings(max_examples=30, deadline=None)
@given(
    rate=st.sampled_from([40, 50, 64, 75, 100, 120, 128, 200, 250, 400, 500, 800, 1000]),
    count=st.integers(60, 3000),
    digits=st.integers(5, 9),
)
def test_any_rate_in_any_digits(
    tmp_path_factory: pytest.TempPathFactory, rate: int, count: int, digits: int
) -> None:
    times = [f"{k / rate:.{digits}g}" for k in range(count)]
    found = table(tmp_path_factory.mktemp("spacing"), times)
    assert found.record.dt_s == pytest.approx(1 / rate, rel=1e-9) or found.warnings


@every("gap", [20, 500, 998])
@every("dt", [0.005, 0.01, 0.00125])
def test_a_lost_row_is_no_printing(tmp_path: Path, gap: int, dt: float) -> None:
    times = [f"{k * dt:g}" for k in range(1000)]
    del times[gap]
    with pytest.raises(RecordFileError, match=f"line {gap + 2}, "):
        table(tmp_path, times)


@every("form", ["%.2f", "%g"])
@every("each", [6, 7, 9, 10, 11, 14, 20, 50])
def test_rows_that_are_missing_evenly(tmp_path: Path, each: int, form: str) -> None:
    times = [form % (0.01 * k) for k in range(1000) if (k + 1) % each]
    with pytest.raises(RecordFileError, match="ask for resampling"):
        table(tmp_path, times)


def test_all_columns_of_a_table_are_resampled(tmp_path: Path) -> None:
    times = np.array([0.0, 0.01, 0.02, 0.035, 0.04, 0.05])
    path = tmp_path / "table.csv"
    rows = (f"{time:.3f},{100.0 * time:.1f},{5.0 - 20.0 * time:.1f}" for time in times)
    path.write_text("time (s),N (m/s2),E (m/s2)\n" + "\n".join(rows) + "\n")
    found = read_recordings(path, resample=True)
    even = 0.01 * np.arange(6)
    for each, line in zip(found, (100.0 * even, 5.0 - 20.0 * even), strict=True):
        assert each.record.dt_s == pytest.approx(0.01)
        np.testing.assert_allclose(each.record.acceleration_m_s2, line, atol=1e-12)


def test_jitter_that_digits_do_not_explain(tmp_path: Path) -> None:
    times = 0.01 * np.arange(500) + np.random.default_rng(2).uniform(-0.002, 0.002, 500)
    with pytest.raises(RecordFileError, match="ask for resampling"):
        table(tmp_path, [f"{time:.6f}" for time in times])


def test_an_interval_that_the_words_contradict(tmp_path: Path) -> None:
    path = tmp_path / "table.csv"
    rows = "".join(f"{0.02 * k:.2f},{k % 7}\n" for k in range(40))
    path.write_text(f"# dt = 0.01 s\ntime (s),acc (gal)\n{rows}")
    (found,) = read_recordings(path)
    assert found.record.dt_s == 0.02
    assert "state 0.01 s between samples, and its times are 0.02 s apart" in found.warnings[0]


def test_places_of_digits() -> None:
    np.testing.assert_allclose(places(["0", "0.00125", "9.99875", "10.0013", "100"]), [
        5e-6, 5e-6, 5e-6, 5e-5, 5e-4,
    ])  # fmt: skip
    np.testing.assert_allclose(places(["0.00", "0.01", "10.01"]), [5e-3] * 3)


def spaced(times: list[float], *, rounding: float = 1e-9, **given: Any) -> Spaced:
    """Return samples at times [s], which are written to a place."""
    text = RecordText(path=Path("hut.txt"), lines=("x",) * 99)
    values = np.arange(len(times), dtype=np.float64)
    return evenly_spaced(
        text,
        np.array(times),
        values,
        Given(**given),
        rounding=rounding,
        line_of=lambda sample: sample + 2,
    )


def test_times_that_do_not_grow_or_not_evenly() -> None:
    for times, words in (
        ([1.0], "it holds one sample, which is no record; see whether it is whole"),
        ([0.0, 0.01, 0.005, 0.02], "line 5, .*its time, 0.005 s, does not come after 0.01 s; give"),
        ([0.0, 0.01, 0.01, 0.02], "line 5, .*its time, 0.01 s, does not come after 0.01 s; give a"),
        ([0.03, 0.02, 0.01], "line 4, .*its time, 0.02 s, does not come after 0.03 s"),
        ([0.0, 0.01, 0.02, 0.05, 0.06], "line 6, .*0.05 s, is 0.03 s after the one before, and mo"),
        ([0.0, 0.01, 0.02, 0.022, 0.032], "line 6, .*0.022 s, is 0.002 s .* are 0.01 s apart; ask"),
    ):
        with pytest.raises(RecordFileError, match=words):
            spaced(times)
    for dt_s, words in (
        (0.1, "1 samples 0.1 s apart would be"),
        (1e-9, "samples 1e-09 s apart wo"),
    ):
        with pytest.raises(RecordFileError, match=f"{words}.*; give another dt_s"):
            spaced([0.0, 0.01, 0.03, 0.04], dt_s=dt_s, resample=True)


def test_samples_between_those_of_a_file_lie_on_straight_lines() -> None:
    uneven = [0.0, 0.01, 0.03, 0.04, 0.05]
    for dt_s, count in ((None, 6), (0.01, 6), (0.025, 3), (0.05, 2), (0.04, 2), (0.005, 11)):
        result = spaced(uneven, dt_s=dt_s, resample=True)
        step = 0.01 if dt_s is None else dt_s
        assert len(result.values) == count, dt_s
        assert result.dt_s == pytest.approx(step)
        expected = np.interp(step * np.arange(count), uneven, np.arange(5.0))
        np.testing.assert_allclose(result.values, expected, atol=1e-12)
        words = f"resampled from intervals of 0.01 to 0.02 s to {step:g} s (straight lines between"
        assert result.notes == (f"{words} the samples)",)
    even = [0.02 * at for at in range(9)]
    for dt_s, resample in ((None, False), (None, True), (0.02, True), (0.05, False)):
        result = spaced(even, dt_s=dt_s, resample=resample)
        assert result.dt_s == pytest.approx(0.02)
        assert (result.notes, len(result.values)) == ((), 9)
    late = spaced([5.0 + time for time in even], dt_s=0.01, resample=True)
    assert late.notes == ("resampled from 0.02 s to 0.01 s (straight lines between the samples)",)
    np.testing.assert_allclose(late.values, 0.5 * np.arange(17), atol=1e-9)


def test_a_time_may_be_a_hundredth_of_the_interval_off() -> None:
    for off, even in ((0.009, True), (-0.009, True), (0.011, False), (-0.011, False)):
        times = [0.01 * at for at in range(200)]
        times[100] += 0.01 * off
        if even:
            assert spaced(times).dt_s == pytest.approx(0.01, rel=1e-9)
        else:
            with pytest.raises(RecordFileError, match="ask for resampling"):
                spaced(times)


def test_an_interval_that_is_left_open_or_no_usual_one(tmp_path: Path) -> None:
    for dt, form, doubt in (
        *((0.01, "%.2f", ""), (1 / 128, "%.7f", ""), (0.0125, "%.3f", "open")),
        *((0.01234321, "%.6f", "odd"), (1.0 / 81.0, "%.6f", "")),
    ):
        result = table(tmp_path, [form % (k * dt) for k in range(60)])
        words = " ".join(result.warnings)
        assert result.record.dt_s == pytest.approx(dt, rel=1e-3)
        assert bool(words) == bool(doubt), (dt, words)
        assert ("no usual one: see whether rows are missing" in words) == ("odd" in doubt), dt
        if words:
            between = re.search(r"between ([\d.e-]+) and ([\d.e-]+) s: ([\d.e-]+) s is", words)
            assert between is not None
            low, high, chosen = map(float, between.groups())
            assert low <= dt * (1.0 + 1e-8)
            assert high >= dt * (1.0 - 1e-8)
            assert low <= chosen <= high


def test_straight_lines_between_samples() -> None:
    times, values = np.array([0.0, 1.0, 3.0]), np.array([2.0, 4.0, -2.0])
    at = np.array([0.0, 0.5, 1.0, 2.0, 3.0, 3.5, 99.0])
    np.testing.assert_allclose(
        interpolated(at, times, values), [2.0, 3.0, 4.0, 1.0, -2.0, -2.0, -2.0], atol=1e-15
    )
    np.testing.assert_allclose(places(["-0.50", "1.25e-1", "2D0"]), [5e-4, 5e-4, 5e-3])
    np.testing.assert_allclose(places(["1", "2", "30"]), [0.5] * 3)
    np.testing.assert_allclose(places(["1.5", "12"]), [0.05, 0.5])
