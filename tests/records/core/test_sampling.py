"""Times that are printed with few digits: what the printing explains is even, and nothing else."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rocksteady.errors import RecordFileError
from rocksteady.records import Recording, read_recordings
from rocksteady.records.core.sampling import places
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
