"""Baselines, resampling and pairs: nothing is done unasked, and all that is done is noted."""

from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import (
    InputError,
    Record,
    Recording,
    RecordSet,
    baseline_corrected,
    pair_records,
    read_record,
    read_recordings,
    resampled,
)
from tests.records.writers import at2, csv, knet, samples

Floats = NDArray[np.float64]
START = datetime(2020, 1, 2, tzinfo=UTC)


def recording(values: Floats, dt: float = 0.01, **others: object) -> Recording:
    record = Record(acceleration_m_s2=values, dt_s=dt, name="hut")
    whole = Recording(record=record, format="csv", path=Path("hut.csv"), units_in_file="g")
    return replace(whole, **others)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("baseline", "order"), [("mean", 0), ("linear", 1), ("polynomial:2", 2), ("polynomial:5", 5)]
)
def test_a_polynomial_is_taken_off_and_noted(baseline: str, order: int) -> None:
    values = samples(500)
    time = np.linspace(0.0, 5.0, 500)
    # NumPy's other fit, in powers of the time itself.
    expected = values - np.polyval(np.polyfit(time, values, order), time)
    drifting = values + sum(0.3 * (time - 1.0) ** power for power in range(order + 1))
    found = baseline_corrected(recording(drifting), baseline)
    np.testing.assert_allclose(found.record.acceleration_m_s2, expected, atol=1e-9)
    assert len(found.processing) == 1
    assert "fitted by least squares, taken off" in found.processing[0]


def test_none_is_none_and_nothing_else_is_known() -> None:
    one = recording(samples(100))
    assert baseline_corrected(one, "none") is one
    for wrong in ("", "mean:1", "polynomial", "polynomial:11", "polynomial:-1", "cubic"):
        with pytest.raises(InputError, match=r"baseline = .*use none, mean, linear or polynomial"):
            baseline_corrected(one, wrong)


def test_read_record_leaves_the_baseline_as_it_is_unless_asked(tmp_path: Path) -> None:
    path = tmp_path / "hut.AT2"
    path.write_text(at2(samples(200) + 0.25))
    assert read_record(path).acceleration_m_s2.mean() > 1.0
    assert abs(read_record(path, baseline="mean").acceleration_m_s2.mean()) < 1e-12


@pytest.mark.parametrize("divisor", [1, 2, 3, 7])
def test_a_finer_interval_leaves_the_motion_as_it_is(divisor: int) -> None:
    one = recording(samples(300))
    finer = resampled(one, 0.01 / divisor)
    np.testing.assert_allclose(
        finer.record.acceleration_m_s2[::divisor], one.record.acceleration_m_s2, atol=1e-12
    )
    assert finer.record.duration_s == pytest.approx(one.record.duration_s)
    assert (finer is one) == (divisor == 1)
    if divisor > 1:
        assert finer.processing == (f"resampled from 0.01 s to {0.01 / divisor:g} s (linear)",)


@pytest.mark.parametrize("dt", [0.005, 0.02, 0.025])
def test_what_the_new_interval_cannot_show_is_filtered(dt: float) -> None:
    time = 0.01 * np.arange(4000)
    window = np.sin(np.pi * time / time[-1]) ** 2
    slow, fast = (np.sin(2.0 * np.pi * hertz * time) * window for hertz in (1.3, 43.0))
    found = resampled(recording(slow + fast), dt, method="filtered").record.acceleration_m_s2
    new = dt * np.arange(len(found))
    if dt > 0.01:
        np.testing.assert_allclose(found, np.interp(new, time, slow), atol=5e-3)
    else:
        np.testing.assert_allclose(found[::2], slow + fast, atol=5e-3)


@pytest.mark.parametrize("dt", [0.0, -1.0, float("nan"), 1e-9, 10.0])
def test_intervals_that_leave_no_record(dt: float) -> None:
    with pytest.raises(InputError, match="dt_s"):
        resampled(recording(samples(100)), dt)


def test_methods_and_ratios_that_are_not_known() -> None:
    with pytest.raises(InputError, match="use linear or filtered"):
        resampled(recording(samples(100)), 0.02, method="cubic")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="whole numbers"):
        resampled(recording(samples(100)), 0.01 * np.pi, method="filtered")


# ---------------------------------------------------------------------------------- pairs


def test_pairs_by_what_the_files_say(tmp_path: Path) -> None:
    paths = []
    for end, component in (("x", "090"), ("y", "UP"), ("z", "360")):
        paths.append(tmp_path / f"{end}.AT2")
        paths[-1].write_text(at2(samples(100), component=component))
    (one,) = pair_records(paths)
    assert one.name == "Hut - Far, West, Somewhere-01, 1/17/1994"
    assert [channel.component for channel in one.horizontal] == ["090", "360"]
    assert one.vertical is not None
    assert one.vertical.component == "UP"
    assert one.warnings == ()


def test_pairs_by_the_names_of_files(tmp_path: Path) -> None:
    for stem in ("CHY012-N", "CHY012-W", "CHY012-V", "A-BEN360", "A-BEN270", "A-BEN-UP", "x"):
        (tmp_path / f"{stem}.csv").write_text(csv(samples(100)))
    found = {one.name: one for one in pair_records(sorted(tmp_path.iterdir()))}
    assert sorted(found) == ["A-BEN", "CHY012", "x"]
    for name in ("A-BEN", "CHY012"):
        assert len(found[name].horizontal) == 2
        assert found[name].vertical is not None
    assert len(found["x"].other) == 1


def test_stations_of_one_hole_are_kept_apart(tmp_path: Path) -> None:
    counts = np.rint(1000 * samples(800)).astype(np.int64)
    for at in range(1, 7):
        (tmp_path / f"S.{at}").write_text(knet(counts, direction=str(at)))
    found = pair_records(sorted(tmp_path.iterdir()))
    assert [one.name.split(",")[0] for one in found] == ["AOM001 borehole", "AOM001 surface"]
    assert all(len(one.horizontal) == 2 and one.vertical for one in found)


def test_what_differs_is_said() -> None:
    one = recording(samples(100), orientation="horizontal", azimuth_deg=0.0, start_time=START)
    later = START + timedelta(seconds=0.05)
    two = recording(samples(90), 0.02, orientation="horizontal", azimuth_deg=40.0, start_time=later)
    from rocksteady.records.pairing import _doubts

    assert _doubts((one, two)) == (
        "intervals of 0.01, 0.02 s",
        "lengths of 90, 100 samples",
        "starts up to 0.05 s apart",
        "azimuths 0 and 40 deg, not at right angles",
    )
    with pytest.raises(InputError, match=r"different intervals.*resampled"):
        RecordSet(name="hut", horizontal=(one, two)).aligned("trim")


@pytest.mark.parametrize(("method", "first", "count"), [("trim", 5, 90), ("pad", 0, 100)])
def test_channels_are_brought_to_one_time(method: str, first: int, count: int) -> None:
    motion = samples(100)
    one = recording(motion, orientation="horizontal", start_time=START)
    late = START + timedelta(seconds=0.05)
    two = recording(motion[5:95], orientation="vertical", start_time=late)
    found = RecordSet(name="hut", horizontal=(one,), vertical=two).aligned(method)  # type: ignore[arg-type]
    assert found.vertical is not None
    vertical = found.vertical.record.acceleration_m_s2
    expected = motion[first : first + count].copy()
    np.testing.assert_array_equal(found.horizontal[0].record.acceleration_m_s2, expected)
    if method == "pad":
        expected[:5] = expected[95:] = 0.0
        assert "5 and 5 zeros put there" in found.vertical.processing[0]
    else:
        (note,) = found.horizontal[0].processing
        assert "5 samples cut from the start and 5 from the end" in note
    np.testing.assert_array_equal(vertical, expected)
    assert found.vertical.start_time == found.horizontal[0].start_time
    assert found.warnings == ()


def test_nothing_in_common_and_no_such_method() -> None:
    one = recording(samples(100), start_time=START)
    two = recording(samples(100), start_time=START + timedelta(seconds=60))
    both = RecordSet(name="hut", other=(one, two))
    with pytest.raises(InputError, match="no time in common"):
        both.aligned("trim")
    with pytest.raises(InputError, match="use trim or pad"):
        both.aligned("cut")  # type: ignore[arg-type]


def test_a_set_of_one_file_of_several_channels(tmp_path: Path) -> None:
    path = tmp_path / "hut.csv"
    path.write_text("t,acc_x (g),acc_y (g)\n0,1,2\n.01,2,3\n.02,-1,2\n")
    assert len(read_recordings(path)) == 2
    (one,) = pair_records([path])
    assert len(one.other) == 2
