"""Tables: separators, decimal commas, names with units, times; what is asked for and refused."""

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady import read_record
from rocksteady.errors import InputError, RecordFileError
from tests.every import every
from tests.records import refused
from tests.records.tables import THREE, G, read
from tests.records.writers import csv, samples


@every(
    ("text", "unit"),
    [
        ("time,acc (g)\n0,1.0\n0.01,-2.5\n0.02,0.5\n", "g"),
        ("Time [s];Acc [m/s\N{SUPERSCRIPT TWO}]\n0;1\n0,01;-2,5\n0,02;0,5\n", "m/s^2"),
        ("t (ms)\tvel (cm/s)\tacc (cm/s2)\n0\t9\t1\n10\t9\t-2.5\n20\t9\t0.5\n", "cm/s^2"),
        ("time accel_cm/s2\n0 1\n0.01 -2.5\n0.02 0.5\n", "cm/s^2"),
        ("Time  Acceleration (mm/s/s)\n0 1\n0.01 -2.5\n0.02 0.5\n", "mm/s^2"),
        ("# a comment\n# t, a_g\n0,1\n0.01,-2.5\n0.02,0.5\n", "g"),
        ('"Time","Acceleration (gal)"\n"0.00","1.0"\n"0.01","-2.5"\n"0.02","0.5"\n', "gal"),
        ("Time,Acc\n(s),(g)\n0.00,1.0\n0.01,-2.5\n0.02,0.5\n", "g"),
        ("time_s,acc_m_s2\n0.00,1.0\n0.01,-2.5\n0.02,0.5\n", "m/s^2"),
        ("NPTS: 3\nDT: 0.01\nUnits: g\n1.0\n-2.5\n0.5\n", "g"),
        ("s,g\n0.00,1.0,\n0.01,-2.5,\n0.02,0.5,\n", "g"),
        ("\ufefftime,acc (g)\r\n0,1.0\r\n0.01,-2.5\r\n0.02,0.5\r\n\r\n", "g"),
        ("made by hand\nunits: cm/s^2\n0.00 1.0\n0.01 -2.5\n0.02 0.5\n", "cm/s^2"),
    ],
)
def test_tables_with_times_and_units(tmp_path: Path, text: str, unit: str) -> None:
    (found,) = read(tmp_path, text)
    size = {"g": G, "m/s^2": 1.0, "cm/s^2": 0.01, "mm/s^2": 0.001, "gal": 0.01}[unit]
    np.testing.assert_allclose(found.record.acceleration_m_s2, np.array(THREE) * size)
    assert (found.record.dt_s, found.units_in_file) == (0.01, unit)


@every(
    "text",
    [
        "1.0\n-2.5\n0.5\n",
        "1.0 -2.5 0.5\n",
        "1.0 -2.5\n0.5\n",
        "1.0-2.5+0.5\n",
        "1,0\n-2,5\n0,5\n",
        "1,0 -2,5\n0,5 0,25\n",
        "1.0;-2.5\n0.5;0.25\n",
        "3 0.010\n1.0\n-2.5\n0.5\n",
        "Time history matched to spectrum\n4 0.0100 656\n1.0 -2.5\n0.5 0.25\n",
        "1.0E+00\n-2.5D+00\n0.5\n",
    ],
)
def test_samples_alone(tmp_path: Path, text: str) -> None:
    (found,) = read(tmp_path, text, units="m/s^2", dt_s=0.01)
    assert found.record.acceleration_m_s2[:3].tolist() == THREE
    assert found.record.dt_s == 0.01
    with pytest.raises(RecordFileError, match="does not state the unit of its numbers"):
        read(tmp_path, text, dt_s=0.01)
    if "010" in text:
        with refused("contradiction", "states 0.01 s between samples, and dt_s 0.005 s"):
            read(tmp_path, text, units="m/s^2", dt_s=0.005)


@every(
    ("head", "dt"),
    [
        ("dt = 0.005 s", 0.005),
        ("# Time step: 5 ms", 0.005),
        ("sampling rate 200 Hz", 0.005),
        ("Sampling frequency (Hz): 200", 0.005),
        ("% DT=.005", 0.005),
    ],
)
def test_intervals_in_words(tmp_path: Path, head: str, dt: float) -> None:
    (found,) = read(tmp_path, f"{head}\n1.0\n-2.5\n0.5\n", units="g")
    assert found.record.dt_s == dt


def test_two_rows_of_names_and_units_with_a_factor(tmp_path: Path) -> None:
    with pytest.raises(RecordFileError, match="line 2, "):
        read(tmp_path, "time (s),acc (g)\ns,g x 10\n0,1.0\n0.01,-2.5\n0.02,0.5\n")


def test_the_column_beside_another_quantity_is_read(tmp_path: Path) -> None:
    (found,) = read(tmp_path, "t,acc (g),acc error (g)\n0,1.0,9\n0.01,-2.5,9\n0.02,0.5,9\n")
    assert found.component == "acc"


def test_an_interval_may_be_any_number(tmp_path: Path) -> None:
    (found,) = read(tmp_path, "1.0\n-2.5\n0.5\n", units="g", dt_s=Fraction(1, 200))
    assert found.record.dt_s == 0.005


@every(
    ("head", "dt"),
    [
        *[("dt = 0.01 hours", 36.0), ("sampling rate 100 kHz", 1e-5), ("dt: 10 msec", 0.01)],
        *[("sampling rate: 12000 samples/min", 0.005), ("fs = 200 sps", 0.005)],
        *[("dt (ms) = 5", 0.005), ("dt = 0,01 s", 0.01), ("sampling interval .1e-1 s", 0.01)],
        *[("Sampling interval (sec): 0.01", 0.01), ("dt = 10^-3 s", None), ("dt = .1,5", None)],
        *[("dt = 0.01 fortnights", None), ("dt = 0.01 x 10", None), ("dt (ms) = 5 s", None)],
        *[("dt = 0.01\nsampling rate 200 Hz", 2), ("sampling rate 200 g", None)],
        *[("dt = 0.005\nsampling rate 200 Hz", 0.005), ("dt = 1.5.2 s", None)],
    ],
)
def test_intervals_with_their_units(tmp_path: Path, head: str, dt: float | None) -> None:
    """What states no one interval is refused, and what states two whatever is given."""
    text = f"{head}\nunits: g\n1.0\n-2.5\n0.5\n"
    if dt is None:
        with refused(""):
            read(tmp_path, text)
        assert read(tmp_path, text, dt_s=0.02)[0].record.dt_s == 0.02
    elif dt == 2:
        for dt_s in (None, 0.01, 0.02):
            with refused("contradiction", "states 0.005 s and 0.01 s between samples; take out"):
                read(tmp_path, text, dt_s=dt_s)
    else:
        assert read(tmp_path, text)[0].record.dt_s == pytest.approx(dt, rel=1e-12)
        with refused("contradiction", "and dt_s 0.02 s; leave out dt_s"):
            read(tmp_path, text, dt_s=0.02)


@every(
    ("head", "unit"),
    [
        *[("units: milli g", "mg"), ("units of acceleration: cm/s/s", "cm/s^2")],
        *[("acceleration in 10^-3 g", "mg"), ("units: s, g", "g"), ("units (g)", "g")],
        *[("units: g (9.81 m/s2)", "g"), ("units: g x 1000", None), ("units: counts", "counts")],
        *[("units: g (multiplied by 981)", None), ("units: g\nunits: cm/s2", "contradiction")],
        *[("scale factor = 2.0\nunits: g", None), ("scale factor = 1.0\nunits: g", "g")],
        *[("scale: 1/1000\nunits: g", None), ("units: g\nacceleration x 10^-3", None)],
        *[("acceleration in cm/s2 x 10", None), ("units: gal/counts", "counts")],
    ],
)
def test_units_in_words(tmp_path: Path, head: str, unit: str | None) -> None:
    """An option decides where the words are not understood, and there alone."""
    text = f"{head}\nmade by hand\n\n1.0\n-2.5\n0.5\n"
    if unit is None:
        with refused("", "unit"):
            read(tmp_path, text, dt_s=0.01)
        (found,) = read(tmp_path, text, dt_s=0.01, units="2 g")
        assert found.record.acceleration_m_s2[0] == 2.0 * G
    elif unit in {"counts", "contradiction"}:
        for units in (None, "2 g"):
            with refused(unit):
                read(tmp_path, text, dt_s=0.01, units=units)
    else:
        (found,) = read(tmp_path, text, dt_s=0.01)
        assert found.units_in_file == unit
        assert read(tmp_path, text, dt_s=0.01, units=unit)[0].record == found.record
        with refused("contradiction", "and units in 2 g; leave out units"):
            read(tmp_path, text, dt_s=0.01, units="2 g")


def test_the_interval_is_asked_for(tmp_path: Path) -> None:
    with pytest.raises(RecordFileError, match=r"does not state the interval.*give dt_s"):
        read(tmp_path, "1.0\n2.0\n", units="g")


def test_several_columns_are_channels(tmp_path: Path) -> None:
    text = "t,ax,ay,vel\n" + "".join(f"{0.01 * n:.2f},{n},{-n},7\n" for n in range(9))
    first, second = read(tmp_path, text, units="g")
    assert [first.component, second.component] == ["ax", "ay"]
    path = tmp_path / "table.txt"
    with pytest.raises(InputError, match=r" holds 2 channels; choose one: 1 \(ax\), 2 \(ay\)"):
        read_record(path, units="g")
    assert read_record(path, units="g", channel="AY") == second.record
    assert read_record(path, units="g", channel=1) == first.record
    (by_name,) = read(tmp_path, text, units="g", column="AY")
    assert by_name.record == replace(second.record, name="table")
    for of_velocity in ("vel", 4):
        with refused("velocity", "line 1, .*: its column is vel: velocity, and the base moves"):
            read(tmp_path, text, units="g", column=of_velocity)
    (by_number,) = read(tmp_path, text, units="g", column=3)
    np.testing.assert_array_equal(
        by_number.record.acceleration_m_s2, second.record.acceleration_m_s2
    )
    with pytest.raises(InputError, match="no such column; choose one of these: t, ax, ay, vel"):
        read(tmp_path, text, units="g", column="az")
    with pytest.raises(InputError, match="no such channel"):
        read_record(path, units="g", channel="3")


def test_a_single_column_is_the_first_and_no_other(tmp_path: Path) -> None:
    text = "1.0\n2.0\n-1.0\n"
    (plain,), (first,) = (
        read(tmp_path, text, units="g", dt_s=0.01, column=column) for column in (None, 1)
    )
    assert plain.record == first.record
    with pytest.raises(InputError, match="no such column; choose one of these: 1 to 1"):
        read(tmp_path, text, units="g", dt_s=0.01, column=2)


STEADY = "".join(f"{0.01 * n:.2f} {n % 3}\n" for n in range(20))


@every(
    ("text", "message"),
    [
        ("1.0\nabc\n2.0\n3.0\n", "line 2, 'abc'"),
        ("1.0\n2.0\nnan\n3.0\n", "line 3, 'nan'"),
        ("t,acc (g)\n0,1\n.01,\n.02,3\n", "line 3, '.01,'"),
        ("t,acc (g)\n0,1\n.01,,2\n.02,3\n", "line 3, '.01,,2'"),
        ("t,acc (g)\n0,1\n.01,2\n.01,3\n", "line 4, .*does not come after"),
        ("t,acc (g)\n0,1\n.01,2\n.03,3\n.04,2\n.05,2\n", "line 4, .*is 0.02 s after"),
        (f"{STEADY}0.02 3\n{STEADY}", "line 21, .*does not come after"),
        ("time,velocity (cm/s)\n0,1\n.01,2\n.02,3\n", "line 1, .*: velocity, and the base"),
        ("velocity in cm/s\n1\n2\n3\n", "its header names another quantity: velocity, and"),
        ("just words\nand more\n", "in no format"),
        ("t,acc (g)\n0,1\n", "one sample|no record"),
        ("5 0.01\n1.0\n2.0\n3.0\n", "3 samples are read so far, and line 1 states 5"),
    ],
)
def test_what_is_wrong_is_said_with_its_line(tmp_path: Path, text: str, message: str) -> None:
    dt_s = 0.01 if "t" not in text.split("\n", maxsplit=1)[0] else None
    with pytest.raises(RecordFileError, match=message):
        read(tmp_path, text, units="g", **({} if dt_s is None else {"dt_s": dt_s}))


def test_resampling_is_never_silent(tmp_path: Path) -> None:
    times = np.array([0.0, 0.01, 0.03, 0.04, 0.05])
    text = "t,acc (m/s2)\n" + "".join(f"{time},{3.0 * time + 1.0}\n" for time in times)
    with pytest.raises(RecordFileError, match="ask for resampling"):
        read(tmp_path, text)
    (found,) = read(tmp_path, text, resample=True)
    # What is straight stays straight.
    np.testing.assert_allclose(found.record.acceleration_m_s2, 3.0 * 0.01 * np.arange(6) + 1.0)
    assert found.processing[0].startswith("resampled from intervals of 0.01 to 0.02 s to 0.01 s")


def test_times_that_are_written_coarsely(tmp_path: Path) -> None:
    # 200 samples a second, times with two digits: 0.00, 0.00, 0.01, 0.02, ...
    values = samples(2000)
    text = "".join(f"{0.005 * n + 1e-9:.2f} {value:.6f}\n" for n, value in enumerate(values))
    (found,) = read(tmp_path, "time acc_g\n" + text)
    assert found.record.dt_s == pytest.approx(0.005, rel=1e-3)
    # Without names the times are known by their growth.
    assert read(tmp_path, text, units="g")[0].record == found.record
    # The same with a row lost in the middle at an interval that two digits show.
    lines = [f"{0.01 * n:.2f} {value:.6f}\n" for n, value in enumerate(values)]
    del lines[1000]
    with pytest.raises(RecordFileError, match="line 1002"):
        read(tmp_path, "time acc_g\n" + "".join(lines))


@given(
    values=st.lists(st.integers(-9999, 9999), min_size=3, max_size=50).filter(any),
    dt=st.sampled_from([0.001, 0.0025, 0.005, 0.01, 0.02]),
    start=st.sampled_from([0.0, 0.01, -3.0, 100.0]),
    separator=st.sampled_from([",", ";", "\t", " ", "   "]),
)
def test_what_is_written_is_read(
    tmp_path_factory: pytest.TempPathFactory,
    values: list[int],
    dt: float,
    start: float,
    separator: str,
) -> None:
    path = tmp_path_factory.mktemp("table") / "table.csv"
    lines = [f"{start + dt * at:.4f}{separator}{n / 1000:.3f}" for at, n in enumerate(values)]
    path.write_text(f"time{separator}acc_g\n" + "\n".join(lines))
    record = read_record(path)
    np.testing.assert_allclose(record.acceleration_m_s2, np.array(values) * G / 1000)
    assert record.dt_s == pytest.approx(dt, rel=1e-12)


def test_a_table_of_a_writer(tmp_path: Path) -> None:
    values = samples(4000)
    (found,) = read(tmp_path, csv(values, 0.004))
    np.testing.assert_allclose(found.record.acceleration_m_s2, values * G, atol=1e-5)
    assert (found.format, found.record.dt_s) == ("csv", 0.004)


@every(
    ("text", "name"),
    [
        ("1.0 -2.5\n0.5 0.25\n", "columns"),
        ("acc (g)\n1.0\n-2.5\n0.5\n", "columns"),
        ("1.0;-2.5\n0.5;0.25\n", "csv"),
        ("ax ay\n1.0 -2.5\n0.5 0.25\n", "csv"),
        ("ax,ay\n1.0,-2.5\n0.5,0.25\n", "csv"),
    ],
)
def test_names_of_columns_or_a_separator_make_a_csv(tmp_path: Path, text: str, name: str) -> None:
    found = read(tmp_path, text, units="g", dt_s=0.01)
    assert {each.format for each in found} == {name}


def test_columns_named_by_their_directions(tmp_path: Path) -> None:
    text = "Time(s),EW (cm/s/s),NS,UD\n0,1,2,3\n0.01,2,3,4\n0.02,-1,2,3\n"
    found = read(tmp_path, text)
    assert [one.orientation for one in found] == ["horizontal", "horizontal", "vertical"]
    assert [one.units_in_file for one in found] == ["cm/s^2"] * 3
    assert found[0].azimuth_deg == 90.0


def test_lines_of_a_few_numbers_without_names_are_doubted(tmp_path: Path) -> None:
    text = "".join(f"{value:.3f} {value / 2:.3f}\n" for value in samples(20))
    (found,) = read(tmp_path, text, units="g", dt_s=0.01)
    assert len(found.record.acceleration_m_s2) == 40
    assert "give column where they are channels" in found.warnings[0]
    (one,) = read(tmp_path, text, units="g", dt_s=0.01, column=2)
    assert (len(one.record.acceleration_m_s2), one.warnings) == (20, ())


def test_a_comma_in_one_number_is_no_second_number(tmp_path: Path) -> None:
    with pytest.raises(RecordFileError, match=r"line 2, '1,5'"):
        read(tmp_path, "1.25\n1,5\n1.75\n2.0\n2.25\n", units="g", dt_s=0.01)


def test_blank_lines_of_a_spreadsheet(tmp_path: Path) -> None:
    (found,) = read(tmp_path, "sep=,\ntime,acc (g)\n,,\n0,1,\n0.01,-2.5,\n0.02,0.5,\n,,\n,\n")
    assert (len(found.record.acceleration_m_s2), found.record.dt_s) == (3, 0.01)


def test_an_interval_that_the_times_contradict(tmp_path: Path) -> None:
    text = csv(samples(100), 0.01)
    with refused("contradiction", "the file states 0.01 s between samples, and dt_s 0.02 s; leave"):
        read(tmp_path, text, dt_s=0.02)
    (finer,) = read(tmp_path, text, dt_s=0.005, resample=True)
    assert (finer.record.dt_s, len(finer.record.acceleration_m_s2)) == (0.005, 199)
    assert finer.processing == (
        "resampled from 0.01 s to 0.005 s (straight lines between the samples)",
    )
    assert finer.warnings == ()


def test_milliseconds_by_their_other_name(tmp_path: Path) -> None:
    (found,) = read(tmp_path, "time (msec),acc (g)\n0,1.0\n10,-2.5\n20,0.5\n")
    assert found.record.dt_s == 0.01


@every(
    ("head", "unit"),
    [
        ("Acceleration in m/s^2, PGA = 0.35 g", "m/s^2"),
        ("Concepcion, NS (UNITS: CM/SEC/SEC)", "cm/s^2"),
        ("horizontal acceleration g", "g"),
    ],
)
def test_the_unit_of_a_peak_is_not_that_of_the_samples(
    tmp_path: Path, head: str, unit: str
) -> None:
    (found,) = read(tmp_path, f"{head}\n1.0\n-2.5\n0.5\n", dt_s=0.01)
    assert found.units_in_file == unit


def test_a_count_above_times_and_samples(tmp_path: Path) -> None:
    (found,) = read(tmp_path, "3 0.01\n0.00 1.0\n0.01 -2.5\n0.02 0.5\n", units="m/s^2")
    assert found.record.acceleration_m_s2.tolist() == THREE


def test_a_title_above_a_count_is_no_component(tmp_path: Path) -> None:
    (found,) = read(tmp_path, "my record\n3 0.0100\n1.0\n-2.5\n0.5\n", units="m/s^2")
    assert (found.component, found.record.dt_s) == (None, 0.01)
    assert found.record.acceleration_m_s2.tolist() == THREE


@every(
    ("text", "line"),
    [
        ("t,acc (g)\n0.00,NaN\n0.01,2.0\n0.02,3.0\n0.03,1.0\n", 2),
        ("t;acc (g)\n0,00;1,0x\n0,01;2,0\n0,02;3,0\n0,03;1,0\n", 2),
        ("acc (g)\n*****\n0.2\n0.3\n0.1\n", 2),
        ("0.1 0.2 0.3\n0.1 0.2\n0.1 0.2 0.3\n0.1\n", 2),
    ],
)
def test_no_sample_is_lost_without_a_word(tmp_path: Path, text: str, line: int) -> None:
    with pytest.raises(RecordFileError, match=rf"line {line},"):
        read(tmp_path, text, units="g", dt_s=0.01)


def test_a_header_of_numbers_is_not_taken_for_samples(tmp_path: Path) -> None:
    words = "Corrected accelerogram 20180212_211554_WPWS_20 GNS Science\nNumber of points  4\n"
    text = words + "    2018       2      12\n   200.0    0.70    0.00\n     0.1    -0.2     0.1\n"
    with pytest.raises(RecordFileError, match="GeoNet"):
        read(tmp_path, text, units="mm/s^2", dt_s=0.02)


def test_a_channel_is_chosen_by_its_name_without_the_unit(tmp_path: Path) -> None:
    text = "t (s),NS (gal),UD (gal)\n0.00,1.0,3.0\n0.01,-2.5,3.0\n0.02,0.5,3.0\n"
    north, up = read(tmp_path, text)
    assert (north.component, north.azimuth_deg, up.component) == ("NS", 0.0, "UD")
    assert read_record(tmp_path / "table.txt", channel="ns") == north.record


def test_a_row_of_count_and_interval_is_known_by_its_form(tmp_path: Path) -> None:
    """A whole number that is large, or counts the rows, or stands beside an interval."""
    rows = "".join(f"{0.5 + at % 3:.2f}\n" for at in range(120))
    for first, count, dt_s in (
        *(("120", 120, 0.01), ("100", 100, 0.01), ("99", 121, 0.01), ("2.0", 121, 0.01)),
        *(("120 0.005", 120, 0.005), ("80 0.005", 80, 0.005), ("120 1.0", 120, 1.0)),
        *(("120 0.02 7", 120, 0.02), ("2 0.01 1 2", None, 0), ("120 1.5", None, 0)),
        *(("120 0.0", None, 0), ("1 0.01", None, 0), ("120. 0.01", None, 0)),
    ):
        text = f"{first}\n{rows}"
        if count is None:
            width = len(first.split())
            with pytest.raises(RecordFileError, match=f"1 number, and the table has {width} col"):
                read(tmp_path, text, units="g", dt_s=0.01)
            continue
        given = {} if len(first.split()) > 1 else {"dt_s": 0.01}
        (result,) = read(tmp_path, text, units="g", **given)
        assert len(result.record.acceleration_m_s2) == count, first
        assert result.record.dt_s == dt_s
        assert (result.warnings == ()) == (count == 120 and dt_s <= 0.1), first
    # Above times and samples the row is as wide as theirs.
    pairs = "".join(f"{0.01 * at:.2f} {0.5 + at % 3:.2f}\n" for at in range(30))
    (result,) = read(tmp_path, f"30 0.01\n{pairs}", units="g")
    assert (len(result.record.acceleration_m_s2), result.warnings) == (30, ())
    whole = "".join(f"{at % 5 + 1}\n" for at in range(120))
    (result,) = read(tmp_path, f"120\n{whole}", units="g", dt_s=0.01)
    assert len(result.record.acceleration_m_s2) == 121
    for few in ("120 0.01\n1.5\n", "120\n1.5\n"):
        (result,) = read(tmp_path, few, units="mg", dt_s=0.01)
        assert result.record.acceleration_m_s2[0] == pytest.approx(0.12 * G)


def test_times_without_a_name_grow_evenly(tmp_path: Path) -> None:
    def rows(times: list[float]) -> str:
        return "".join(f"{time:.3f} {at % 3 - 0.5:.1f}\n" for at, time in enumerate(times))

    for times, known in (
        ([0.0, 0.01, 0.02], True),
        ([0.0, 0.01], False),
        ([5.0, 5.01, 5.02, 5.03], True),
        ([0.03, 0.02, 0.01, 0.0], False),
        ([0.0, 0.0, 0.0, 0.0], False),
        ([0.1, -0.2, 0.3, -0.1, 0.2], False),
    ):
        (result,) = read(tmp_path, rows(times), units="g", dt_s=0.01)
        count = len(times) if known else 2 * len(times)
        assert len(result.record.acceleration_m_s2) == count, times
    # One of ten steps may go back, which is then a row that is wrong, and no more.
    for back, known in ((1, True), (4, False)):
        times = [0.01 * at for at in range(30)]
        for at in range(back):
            times[3 + 2 * at] = 0.005
        if known:
            with pytest.raises(RecordFileError, match="does not come after"):
                read(tmp_path, rows(times), units="g", dt_s=0.01)
        else:
            assert len(read(tmp_path, rows(times), units="g", dt_s=0.01)) == 1


def test_few_columns_without_names_may_be_channels(tmp_path: Path) -> None:
    values = samples(60)
    for width, doubted in ((1, False), (2, True), (3, True), (4, True), (5, False), (6, False)):
        lines = [values[at : at + width] for at in range(0, 60, width)]
        text = "\n".join(" ".join(f"{value:.4f}" for value in line) for line in lines) + "\n"
        (result,) = read(tmp_path, text, units="g", dt_s=0.01)
        words = f"{width} numbers a line are taken as samples that follow each other; give column "
        expected = (f"{words}where they are channels",) if doubted else ()
        assert result.warnings == expected, width
        np.testing.assert_allclose(result.record.acceleration_m_s2, G * values, atol=1e-3)
        (last,) = read(tmp_path, text, units="g", dt_s=0.01, column=width)
        np.testing.assert_allclose(
            last.record.acceleration_m_s2, G * values[width - 1 :: width], atol=1e-3
        )
        for wrong in (width + 1, 0, "x", "01e1"):
            with pytest.raises(
                InputError, match=f"no such column; choose one of these: 1 to {width}"
            ):
                read(tmp_path, text, units="g", dt_s=0.01, column=wrong)


def test_rows_that_are_short(tmp_path: Path) -> None:
    for text, words in (
        ("t,ax,ay\n0,1,2\n.01,2\n.02,3,4\n", "line 3, .*it has 2 numbers, and the table has 3 col"),
        ("t,ax,ay\n0,1,2\n.01,2,3\n.02,3\n", "line 4, .*it has 2 numbers, and the table has 3 col"),
        ("1 2 3\n4\n5 6 7\n", "line 2, .*it has 1 number, and the table has 3 columns; complete"),
        ("1 2\n4\n5 6\n", "line 2, .*it has 1 number, and the table has 2 columns; complete"),
    ):
        with pytest.raises(RecordFileError, match=words):
            read(tmp_path, text, units="g", dt_s=0.01)
    (result,) = read(tmp_path, "1 2 5\n-4 5 6\n7\n", units="g", dt_s=0.01)
    assert len(result.record.acceleration_m_s2) == 7


def test_quantities_of_words_above_a_table(tmp_path: Path) -> None:
    for words, wrong in (
        *(
            ("velocity of the base", True),
            ("displacement", True),
            ("DISPLACEMENT OF THE HUT", True),
        ),
        *(("velocity and acceleration", False), ("made by some hand", False)),
        ("scale 3920(gal)/6182761 of it", True),
        ("scale (gal) / 5", True),
        ("Corrected accelerogram\nnumber of points 3", True),
        ("Uncorrected accelerogram\nnumber of points 3", True),
        ("accelerogram\nnumber of points 3", False),
    ):
        text = f"{words}\n1.5 2.5 -0.5\n2.5 1.5 0.5\n"
        if wrong:
            with pytest.raises(RecordFileError, match=r"quantity|counts, which|GeoNet"):
                read(tmp_path, text, format="columns", units="g", dt_s=0.01)
        else:
            assert read(tmp_path, text, format="columns", units="g", dt_s=0.01)


def test_names_without_rows_below_them(tmp_path: Path) -> None:
    for text, named in (
        *(("time,acc (g)\n", True), ("acc (g)\n", False), ("acc (g)\nhut\n", False)),
        *(("Time (s)  Acc (g)", True), ("t;a\n", True), ("# by hand\ntime\tacc_g\n", True)),
        ("Two records of a hut.\n", False),
        *(("hut\ntime  acc (g)\n", True), ("hut,shed\n", False), ("hut\n" * 40, False)),
        *((f"{'hut' + chr(10)}" * 39 + "time,acc (g)\n", True),),
        *((f"{'hut' + chr(10)}" * 40 + "time,acc (g)\n", False),),
    ):
        words = "names of columns and no rows of numbers; fetch" if named else "in no format that"
        with pytest.raises(RecordFileError, match=words):
            read(tmp_path, text)


def test_decimal_commas_and_separators(tmp_path: Path) -> None:
    for text, values, count in (
        ("t;acc (g)\n0,0;1,5\n0,01;-2,5\n0,02;0,5\n", [1.5, -2.5, 0.5], 3),
        ("t;acc (g)\n0.0;1.5\n0.01;-2.5\n0.02;0.5\n", [1.5, -2.5, 0.5], 3),
        ("t\tacc (g)\n0,0\t1,5\n0,01\t-2,5\n0,02\t0,5\n", [1.5, -2.5, 0.5], 3),
        ("t acc_g\n0,0 1,5\n0,01 -2,5\n0,02 0,5\n", [1.5, -2.5, 0.5], 3),
        ("acc (g)\n1,5\n-2,5\n0,5\n", [1.5, -2.5, 0.5], 3),
        ("a,b\n1,5\n-2,5\n0,5\n", [1.0, -2.0, 0.0], 3),
        ('t,"acc, of N (g)"\n0,1.5\n.01,-2.5\n.02,.5\n', [1.5, -2.5, 0.5], 3),
        ("t,acc (g, N)\n0,1.5\n.01,-2.5\n.02,.5\n", [1.5, -2.5, 0.5], 3),
        ("2001,12,3\ntaken down\nt,acc (g)\n0,1.5\n.01,-2.5\n.02,.5\n", [1.5, -2.5, 0.5], 3),
    ):
        result = read(tmp_path, text, units="g", **({} if text[0] in "t2" else {"dt_s": 0.01}))
        assert len(result[0].record.acceleration_m_s2) == count, text
        np.testing.assert_allclose(result[0].record.acceleration_m_s2, G * np.array(values))
    for text, line in (
        ("t,acc (g)\n0,1\n.01,2\n* remark\n.02,3\n", 4),
        ("0,1\ntaken down\n.01,2\n.02,3\n", 2),
        ("t,acc (g)\n0,n/a\n.01,2\n.02,3\n", 2),
        ("acc\n#REF!\n1.5\n2.5\n", 2),
    ):
        with pytest.raises(
            RecordFileError, match=f"line {line}, .*it must be a row of numbers, as"
        ):
            read(tmp_path, text, units="g", dt_s=0.01)


def test_rows_of_units_below_the_names(tmp_path: Path) -> None:
    rows = "0.00,5,1.0\n0.01,5,-2.5\n0.02,5,0.5\n"
    for units, size in (
        *(("(s),(cm/s),(g)", G), ("s,m/s,gal", 0.01), ("[s],[mm],[m/s2]", 1.0), ("s,-,g", G)),
    ):
        (result,) = read(tmp_path, f"Time,Vel,Acc\n{units}\n{rows}")
        np.testing.assert_allclose(result.record.acceleration_m_s2, size * np.array(THREE))
        assert result.component == "Acc"
    with pytest.raises(RecordFileError, match=r"line 2, .*its column 'furlong' is not understood"):
        read(tmp_path, f"Time,Vel,Acc\ns,furlong,volt\n{rows}")
    for place, wrong in ((19, True), (20, False)):
        words = "\n".join(["Corrected accelerogram", *["-"] * (place - 1), "number of points 3"])
        text = f"{words}\n1.5 2.5 -0.5\n2.5 1.5 0.5\n"
        if wrong:
            with pytest.raises(RecordFileError, match="it is one of GeoNet's files"):
                read(tmp_path, text, format="columns", units="g", dt_s=0.01)
        else:
            assert read(tmp_path, text, format="columns", units="g", dt_s=0.01)


@every(
    "row", ["{:.2f},{:.6f},{}", "{:.2f}, {:.6E},{},", '"{:.2f}","{:.6f}","{}"', "{:9.2f}{:+.6f} {}"]
)
@every("other", ["1", "-1", "1e305", "1D1"])
def test_an_odd_number_changes_no_other(tmp_path: Path, row: str, other: str) -> None:
    """Numbers are read at once or line by line: `float` of each one by itself is the oracle."""
    values = samples(40)
    rows = [row.format(0.01 * k, value, 1) for k, value in enumerate(values)]
    rows[7] = row.format(0.07, values[7], other)
    text = "\n".join(["time (s),acc (g),factor" if "," in row else "time  acc(g)  factor", *rows])
    (found,) = read(tmp_path, text)
    written = [float(f"{value:.6E}" if "E" in row else f"{value:.6f}") for value in values]
    np.testing.assert_array_equal(found.record.acceleration_m_s2, np.array(written) * G)
    assert found.record.dt_s == 0.01
