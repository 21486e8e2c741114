"""Files of COSMOS: channels, columns and intervals, and what is refused."""

from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from rocksteady.errors import RecordFileError
from tests.every import every
from tests.records import refused
from tests.records.formats.networks import CM, close, read
from tests.records.writers import cosmos_channel, samples


@every(
    "form",
    [
        ("{:10.5f}", "8F10.5", 8),
        ("{:15.6E}", "1E15.6", 1),
        ("{:10.5f}", "1F15.6E", 5),
        ("{:9.5f}", "10F9.5", 10),
    ],
)
def test_cosmos(tmp_path: Path, form: tuple[str, str, int]) -> None:
    (found,) = read(tmp_path, cosmos_channel(CM / 2, form=form))
    close(found, CM / 2, 1e-4)
    assert (found.format, found.units_in_file, found.record.dt_s) == ("cosmos-v2", "cm/s^2", 0.01)
    assert (found.azimuth_deg, found.component) == (340.0, "340 deg")
    assert found.station == "CE-J2236  CDMG Hut & Far"
    assert found.start_time == datetime(2005, 6, 16, 20, 53, 4, 400000, tzinfo=UTC)


def test_cosmos_numbers_that_fill_their_columns(tmp_path: Path) -> None:
    # Nothing stands between 100.12345 and 101.12345 but the width of nine.
    values = np.abs(CM) + 100.0
    text = cosmos_channel(values, form=("{:9.5f}", "8F9.5", 8))
    assert f"{values[0]:.5f}{values[1]:.5f}" in text
    (found,) = read(tmp_path, text)
    close(found, values, 5e-6)


def test_cosmos_takes_the_interval_that_fits_the_duration(tmp_path: Path) -> None:
    (found,) = read(tmp_path, cosmos_channel(CM, dt_ms=5.0, raw_dt=0.02))
    assert found.record.dt_s == 0.005
    assert "0.02 s between samples too" in found.warnings[0]
    unknown = cosmos_channel(samples(4000, peak=99.0), dt_ms=-999.0, raw_dt=-999.0)
    (found,) = read(tmp_path, unknown, dt_s=0.01)
    assert found.record.dt_s == 0.01
    none = cosmos_channel(CM, dt_ms=-999.0, raw_dt=-999.0).replace("approx   -402", "approx   4")
    with pytest.raises(RecordFileError, match="no interval of its header fits"):
        read(tmp_path, none)


@every("marker", [None, -999.0, -1.0])
def test_cosmos_values_that_are_unknown(tmp_path: Path, marker: float | None) -> None:
    """A header states the number that stands for them; where it states none it is -999."""
    text = cosmos_channel(CM, dt_ms=-999.0, raw_dt=0.01).replace(f"{4.4:13.6f}", f"{-999.0:13.6f}")
    text = text.replace(f"{CM[np.abs(CM).argmax()]:13.6f}", f"{-999.0:13.6f}")
    line = next(line for line in text.splitlines() if line.startswith("Values used"))
    if marker is None:
        text = text.replace(line, "-")
    else:
        text = text.replace(f"{-999.0:13.6f}", f"{marker:13.6f}")
        text = text.replace(line, f"{line.partition(':')[0]}: {marker:.0f}, {marker}")
    (found,) = read(tmp_path, text, dt_s=0.01)
    assert found.start_time == datetime(2005, 6, 16, 20, 53, tzinfo=UTC)
    (doubt,) = found.warnings
    assert doubt.endswith("a time or a rate above 0: 0.01 s, as given, is taken")


def test_cosmos_of_several_channels_and_quantities(tmp_path: Path) -> None:
    text = "".join(
        cosmos_channel(factor * CM, azimuth=azimuth, quantity=quantity, channel=at)
        for at, (factor, azimuth, quantity) in enumerate(
            [(1.0, 340, "acceleration"), (0.1, 340, "velocity"), (0.5, 400, "acceleration")], 1
        )
    )
    first, second = read(tmp_path, text)
    close(first, CM, 1e-5)
    close(second, 0.5 * CM, 1e-5)
    assert [one.orientation for one in (first, second)] == ["horizontal", "vertical"]
    assert first.record.name != second.record.name
    alone = cosmos_channel(CM, quantity="velocity", units="cm/sec(05)")
    for given in ({}, {"units": "gal"}):
        with refused("velocity", "it announces no acceleration: velocity, and the base moves"):
            read(tmp_path, alone, **given)


@every(("code", "azimuth"), [(1, 1.0), (359, 359.0), (360, 0.0), (361, None), (399, None)])
def test_cosmos_codes_of_directions(tmp_path: Path, code: int, azimuth: float | None) -> None:
    (found,) = read(tmp_path, cosmos_channel(CM, azimuth=code, label="sensor"))
    assert (found.azimuth_deg, found.orientation == "horizontal") == (azimuth, azimuth is not None)


def test_cosmos_levels_and_counts(tmp_path: Path) -> None:
    (found,) = read(tmp_path, cosmos_channel(CM, first="Uncorrected acceleration", dt_ms=10.0))
    assert found.format == "cosmos-v1"
    both = read(tmp_path, 2 * cosmos_channel(CM, first="Uncorrected acceleration"))
    assert [one.format for one in both] == ["cosmos-v1", "cosmos-v1"]
    assert both[0].event == both[1].event
    raw = cosmos_channel(CM, first="Raw acceleration counts", units="counts (50)")
    for given in ({}, {"units": "gal"}):
        with refused("counts", "its numbers are in counts: counts, and the base moves"):
            read(tmp_path, raw, **given)


@every(("code", "unit"), [(2, "g"), (4, "cm/sec2"), (7, "in/sec2"), (10, "gal"), (11, "mg")])
def test_cosmos_units_with_their_code(tmp_path: Path, code: int, unit: str) -> None:
    """A code beside another unit is a contradiction."""
    (found,) = read(tmp_path, cosmos_channel(CM / 981.0, units=f"{unit}({code:02d})"))
    (plain,) = read(tmp_path, cosmos_channel(CM / 981.0, units=unit))
    assert found.record == plain.record
    with refused("contradiction", rf"its words state mm/s\^2, and its code {code} "):
        read(tmp_path, cosmos_channel(CM, units=f"mm/sec2({code:02d})"))


def test_cosmos_units_that_contradict_their_code(tmp_path: Path) -> None:
    for units, kind in (
        *(("g(04)", "contradiction"), ("cm/sec(04)", "velocity")),
        *(("V(03)", "counts"), ("cm/sec2(50)", "counts")),
    ):
        for given in ({}, {"units": "gal"}):
            with refused(kind):
                read(tmp_path, cosmos_channel(CM, units=units), **given)
    text = cosmos_channel(CM, units="cm/sec2 x 10(04)")
    with refused("", "the unit that the file states, .*, is not understood; give units"):
        read(tmp_path, text)
    (one,) = read(tmp_path, text, units="gal")
    close(one, CM, 5e-4)


def test_cosmos_that_is_cut(tmp_path: Path) -> None:
    lines = cosmos_channel(CM).split("\n")
    for kept in (20, 25, 35, 44, 46, 60):
        with pytest.raises(RecordFileError):
            read(tmp_path, "\n".join(lines[:kept]))


def test_cosmos_intervals_and_times_of_peaks(tmp_path: Path) -> None:
    """The interval of the caller goes before both of the header; doubts of its peak remain."""
    values = samples(4000, peak=150.0)
    text = cosmos_channel(values, raw_dt=0.01)
    late = f"{np.abs(values).argmax() * 0.01:13.6f}"
    assert late in text
    moved = text.replace(late, f"{39.0:13.6f}")
    (result,) = read(tmp_path, moved)
    assert len(result.warnings) == 1
    assert "and the header states 39 s: see whether the interval is right" in result.warnings[0]
    assert read(tmp_path, moved, dt_s=0.01)[0].warnings == result.warnings
    placed = cosmos_channel(values).replace("Location: ground", "Location: 3rd Floor")
    assert read(tmp_path, placed)[0].position == "structure"
    # The line of the samples states whole seconds, cut or rounded.
    for dt_ms, raw, seconds, dt in (
        *((10.0, -999.0, 40, 0.01), (10.0, -999.0, 39, 0.01), (10.0, -999.0, 41, 0.01)),
        *((10.0, -999.0, 42, None), (10.0, -999.0, 38, None), (-999.0, 0.01, 40, 0.01)),
        *((10.0, 0.005, 20, 0.005), (5.0, 0.01, 20, 0.005), (10.0, 0.01, 0, 0.01)),
        *((5.0, 0.01, 0, 0.005), (0.0, 0.01, 40, 0.01)),
    ):
        changed = cosmos_channel(values, dt_ms=dt_ms, raw_dt=raw)
        stated = int(len(values) * dt_ms / 1000.0)
        changed = changed.replace(f"approx   {stated} secs", f"approx   {seconds} secs")
        if dt is None:
            with pytest.raises(
                RecordFileError, match=f"fits 4000 samples in some {seconds} s; giv"
            ):
                read(tmp_path, changed)
        else:
            assert read(tmp_path, changed)[0].record.dt_s == dt, (dt_ms, raw, seconds)
    raw_first = cosmos_channel(values, dt_ms=5.0, raw_dt=0.01, first="Uncorrected acceleration")
    raw_first = raw_first.replace("approx   20 secs", "approx   0 secs")
    assert read(tmp_path, raw_first)[0].record.dt_s == 0.01


def test_cosmos_starts_and_words(tmp_path: Path) -> None:
    text = cosmos_channel(CM)
    plain = datetime(2005, 6, 16, 20, 53, 4, 400000, tzinfo=UTC)
    cells = [f"{value:8.0f}" for value in (2005, 167, 6, 16, 20, 53)]
    names = (*("year", "", "month", "day", "hour", "minute"),)
    # The whole numbers run from the 40th on, ten a line.
    lines = text.split("\n")
    first = next(at for at, line in enumerate(lines) if "Integer-header values" in line) + 1
    for at, name in enumerate(names):
        row, column = first + (39 + at) // 10, (39 + at) % 10 * 8
        assert lines[row][column : column + 8] == cells[at]
        for value in (-999, 5):
            changed = [*lines]
            changed[row] = f"{lines[row][:column]}{value:8d}{lines[row][column + 8 :]}"
            (result,) = read(tmp_path, "\n".join(changed))
            if not name:
                assert result.start_time == plain
            elif value < 0:
                assert result.start_time is None
            else:
                assert result.start_time == plain.replace(**{name: value})  # type: ignore[arg-type]
    (result,) = read(tmp_path, text)
    assert result.event == "Somewhere in the West            June 16,2005 13:53 PDT"
    assert result.stated_peak_m_s2 == pytest.approx(1.5, rel=1e-6)
    for old, new, station in (
        ("Statn No: 01-23075  Code:", "Statn No: 01-23075  Cd:", None),
        ("Code:CE-J2236  CDMG Hut & Far", "Code: X", "X"),
    ):
        assert read(tmp_path, text.replace(old, new))[0].station == station


def test_cosmos_directions_without_a_code(tmp_path: Path) -> None:
    plain = cosmos_channel(CM, azimuth=-999, label="340 deg")
    scnl = " | <SCNL>HUT.{}.CE.01"
    for text, component, orientation, azimuth in (
        (plain, "340 deg", "horizontal", 340.0),
        (plain.replace("340 deg", "Up"), "Up", "vertical", None),
        (plain.replace("340 deg", "Other"), "Other", "unknown", None),
        (plain.replace(" | comment", scnl.format("HNE") + " |"), "HNE", "horizontal", 90.0),
        (plain.replace(" | comment", scnl.format("HN3") + " |"), "HN3", "horizontal", 340.0),
        (cosmos_channel(CM, azimuth=402, label="Vert"), "Vert", "vertical", None),
        (cosmos_channel(CM, azimuth=400, label="Up"), "Up", "vertical", None),
        (cosmos_channel(CM, azimuth=0, label="sensor"), "sensor", "unknown", None),
    ):
        (result,) = read(tmp_path, text)
        assert (result.component, result.orientation, result.azimuth_deg) == (
            *(component, orientation, azimuth),
        ), component


def test_cosmos_headers_that_end_too_early(tmp_path: Path) -> None:
    text = cosmos_channel(CM)
    with pytest.raises(
        RecordFileError, match=r"line 14, .*10000 lines of values must follow, and f"
    ):
        read(tmp_path, text.replace("on  10 lines", "on  10000 lines"))
    with pytest.raises(
        RecordFileError, match="a channel begins, and its samples are missing; fetc"
    ):
        read(tmp_path, text + text.partition("   403  acceleration")[0])
    for none in ("403  acc points", "403  pts"):
        with pytest.raises(
            RecordFileError, match=r"no line of it states samples .as in: 7000 accel"
        ):
            read(tmp_path, text.replace("403  acceleration pts", none))


def test_cosmos_numbers_without_a_stated_format(tmp_path: Path) -> None:
    """Whole numbers are then eight characters wide, and real ones fifteen."""
    text = cosmos_channel(CM)
    lines = text.split("\n")
    first = next(at for at, line in enumerate(lines) if "Real-header values" in line)
    reals = [
        "".join(f"{line[at : at + 13]:>15}" for at in range(0, len(line), 13))
        for line in lines[first + 1 : first + 18]
    ]
    lines[first + 1 : first + 18] = reals
    bare = "\n".join(lines).replace(", Format= (10I8)", "").replace(", Format= (6F13.6)", "")
    (result,), (plain,) = read(tmp_path, bare), read(tmp_path, text)
    assert result.record == plain.record
    assert (result.start_time, result.stated_peak_m_s2) == (
        plain.start_time,
        plain.stated_peak_m_s2,
    )
    assert result.azimuth_deg == 340.0
