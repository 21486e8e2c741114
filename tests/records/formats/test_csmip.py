"""Files of CSMIP, volumes 1 and 2: channels, units, times and samples in turn."""

from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from rocksteady.errors import RecordFileError
from tests.records import refused
from tests.records.formats.networks import CM, close, read
from tests.records.writers import csmip_v2_channel, rows


def test_csmip_units_are_understood_as_a_whole(tmp_path: Path) -> None:
    text = csmip_v2_channel(CM)
    for unit in ("cm/sec2 x 10.", "furlongs.", "cm/sec2 (multiplied by 10)"):
        with refused("", "the unit that the file states, .*, is not understood; give units"):
            read(tmp_path, text.replace("in cm/sec2.", f"in {unit}"))
    with pytest.raises(RecordFileError, match=r"line 46, .*its unit of time is not understood"):
        read(tmp_path, text.replace("0.005 sec, in cm/sec2", "0.005 furlongs, in cm/sec2"))


def test_csmip_volume_2_takes_the_acceleration_of_each_channel(tmp_path: Path) -> None:
    text = csmip_v2_channel(CM) + csmip_v2_channel(2.0 * CM, channel=2, name="Up")
    first, second = read(tmp_path, text)
    close(first, CM, 5e-6)
    close(second, 2.0 * CM, 5e-6)
    assert (first.format, first.component, first.station) == ("csmip-v2", "360 Deg", "Hut")
    assert second.orientation == "vertical"
    assert first.record.dt_s == 0.005
    assert first.start_time == datetime(2012, 2, 13, 21, 6, 45, tzinfo=UTC)


def test_csmip_without_acceleration_is_refused(tmp_path: Path) -> None:
    text = csmip_v2_channel(CM).replace("points of accel data", "points of veloc data")
    for given in ({}, {"units": "gal"}):
        with refused("velocity", "it announces no samples of acceleration: velocity, and the base"):
            read(tmp_path, text, **given)


def test_csmip_volume_1(tmp_path: Path) -> None:
    head = csmip_v2_channel(CM).split("\n")[1:8]
    peak = np.abs(CM).max() / 980.665
    words = [*head, "-", "Units of uncor data are sec and g .", f"Max  = {peak:8.5f} g , at 3 sec."]
    numbers = rows(np.arange(100.0), "{:5.0f}", 16) + rows(np.zeros(50), "{:10.6f}", 8)
    line = f" {len(CM)} Accelerogram points at 200 pts/sec in units of g .      Format: (8f9.6)\n"
    text = "\n".join(words) + "\n" + numbers + line + rows(CM / 980.665, "{:9.6f}", 8)
    (found,) = read(tmp_path, text + "/&  ----  End of data for channel  1  ----\n")
    close(found, CM, 5e-4)
    assert (found.format, found.units_in_file, found.record.dt_s) == ("csmip-v1", "g", 0.005)


@pytest.mark.parametrize("even", [True, False])
def test_csmip_volume_1_of_times_and_samples_in_turn(tmp_path: Path, even: bool) -> None:
    times = 0.02 * np.arange(len(CM))
    if not even:
        times[5::7] += 0.007
    head = [
        "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 02/28/94",
        *(["-"] * 8),
        "CHAN  1:  90 DEG",
        f"NO. OF POINTS =  {len(CM)}  RECORD LENGTH =  8.040 SEC",
        "UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  =   .153 G.",
        "-",
    ]
    pairs = np.column_stack([times, CM / 98.0665]).ravel()
    numbers = rows(np.arange(100.0), "{:5.0f}", 16) + rows(np.zeros(50), "{:10.6f}", 8)
    text = "\n".join(head) + "\n" + numbers + rows(pairs, "{:7.3f}", 10) + "----- END\n"
    if not even:
        with pytest.raises(RecordFileError, match=r"line 3\d, .*ask for resampling"):
            read(tmp_path, text)
    (found,) = read(tmp_path, text, resample=not even)
    assert (found.format, found.orientation, found.azimuth_deg) == ("csmip-v1", "horizontal", 90.0)
    assert found.record.dt_s == pytest.approx(0.02, abs=1e-9)
    if even:
        close(found, CM, 0.05)
        (other,) = read(tmp_path, text.replace(".153 G", ".353 G"))
        assert (found.warnings, len(other.warnings)) == ((), 1)
    else:
        assert "resampled" in found.processing[0]


def test_csmip_starts(tmp_path: Path) -> None:
    text = csmip_v2_channel(CM)
    for written, start in (
        ("2/13/12, 21:06:45.0", datetime(2012, 2, 13, 21, 6, 45, tzinfo=UTC)),
        ("2/13/70, 21:06:45.0", datetime(1970, 2, 13, 21, 6, 45, tzinfo=UTC)),
        ("2/13/69, 21:06:45.0", datetime(2069, 2, 13, 21, 6, 45, tzinfo=UTC)),
        ("2/13/99, 21:06:45.5", datetime(1999, 2, 13, 21, 6, 45, 500000, tzinfo=UTC)),
        ("2/13/100, 1: 2: 3", datetime(100, 2, 13, 1, 2, 3, tzinfo=UTC)),
        ("12-31-1994, 23:59:60", datetime(1995, 1, 1, tzinfo=UTC)),
        *(("13/2/12, 21:06:45.0", None), ("2/30/12, 21:06:45.0", None), ("2/13, 1:2:3", None)),
    ):
        (result,) = read(tmp_path, text.replace("2/13/12, 21:06:45.0", written))
        assert result.start_time == start, written


def test_csmip_words_of_the_header(tmp_path: Path) -> None:
    text = csmip_v2_channel(CM)
    (result,) = read(tmp_path, text)
    assert result.event == "Record of Mon Feb 13, 2012 13:06:45.0 PS"
    assert result.warnings == ()
    assert result.stated_peak_m_s2 == pytest.approx(1.5, rel=1e-3)
    peak = f"{CM[np.abs(CM).argmax()]:10.3f}    cm/sec/sec"
    assert peak in text
    in_g = f"{CM[np.abs(CM).argmax()] / 980.665:10.7f}    g"
    for old, new, fields in (
        (peak, in_g, {"stated_peak_m_s2": pytest.approx(1.5, rel=1e-5), "warnings": ()}),
        (peak, peak.replace("cm/sec/sec", "furlongs"), {"stated_peak_m_s2": None, "warnings": ()}),
        ("Hut                   ", " " * 22, {"station": "89146"}),
        ("Hut                                       CGS", "", {"station": "89146"}),
        ("Chan  1: 360 Deg", "-", {"component": None, "orientation": "unknown"}),
        ("Record of", "Rcrd of", {"event": "Rcrd of Mon Feb 13, 2012 13:06:45.0 PST"}),
        (
            "intervals of    0.005",
            "intervals of    0.010",
            {"warnings": ("the header states 0.01 s between samples too; 0.005 s are taken",)},
        ),
        ("Station No.", "Place", {"station": None}),
    ):
        assert old in text
        (single,) = read(tmp_path, text.replace(old, new))
        assert {name: getattr(single, name) for name in fields} == fields, old
        assert single.record == result.record
    doubled = text.replace("intervals of    0.005", "intervals of    0.010")
    assert len(read(tmp_path, doubled, dt_s=0.005)[0].warnings) == 1
