"""PEER's AT2: every form of its header, what follows its samples, and what is refused."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady import read_record
from rocksteady.errors import RecordFileError
from rocksteady.records import read_recordings
from tests.every import every
from tests.records import refused
from tests.records.writers import at2, samples

G = 9.80665
HEADERS = [
    "NPTS= {count:6d}, DT= {dt:.5f} SEC",
    "NPTS= {count:6d}, dt= {dt:.5f}",
    "NPTS=   {count}, DT=   {dt:.4f} SEC,                        ",
    "NPTS= {count}, DT= {dt:.3f}SEC",
    "NPTS={count},DT={dt:.3f}",
    "{count}    {dt:.4f}    NPTS, DT",
    "  {count}  {dt:.4f}  NPTS, DT (SEC)",
    "NPTS= {count} , DT= 1.0E-02 SEC",
    "NPTS= {count}., DT= .01 SEC",
    "NPTS= {count}, DELTA T= {dt:.4f} SEC",
    "DT= {dt:.4f} SEC, NPTS= {count}",
    "NPTS=   {count}\nDT=   {dt:.4f} SEC",
    "DT=   {dt:.4f} SEC\nNPTS=   {count}",
]


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "hut.AT2"
    path.write_text(text)
    return path


@every("counts", HEADERS)
@every("count", [2, 5, 403])
def test_every_header(tmp_path: Path, counts: str, count: int) -> None:
    values = samples(403)[:count]
    (found,) = read_recordings(written(tmp_path, at2(values, counts=counts)))
    np.testing.assert_allclose(found.record.acceleration_m_s2, values * G, rtol=1e-7)
    assert (found.record.dt_s, found.format, found.units_in_file) == (0.01, "peer-at2", "g")
    assert (found.station, found.event) == ("Hut - Far, West", "Somewhere-01, 1/17/1994")
    assert (found.component, found.orientation, found.azimuth_deg) == ("090", "horizontal", 90.0)
    assert found.warnings == found.processing == ()


@every(
    ("line", "event", "station", "component"),
    [
        ("Somewhere-01, 1/17/1994, Hut, 090", "Somewhere-01, 1/17/1994", "Hut", "090"),
        (
            "Somewhere-01, 1/17/1994, 12:30, Hut, 090",
            "Somewhere-01, 1/17/1994, 12:30",
            "Hut",
            "090",
        ),
        ("Somewhere, Hut, 090", "Somewhere", "Hut", "090"),
        ("Somewhere, else, Hut, 090", "Somewhere, else", "Hut", "090"),
        ("Somewhere, 090", "Somewhere, 090", None, None),
    ],
)
def test_event_station_and_component_are_apart_with_a_date_or_without(
    tmp_path: Path, line: str, event: str, station: str | None, component: str | None
) -> None:
    text = at2(samples(9)).splitlines(keepends=True)
    (found,) = read_recordings(written(tmp_path, "".join([text[0], f"{line}\n", *text[2:]])))
    assert (found.event, found.station, found.component) == (event, station, component)


@given(
    values=st.lists(
        st.floats(-5.0, 5.0).map(lambda value: round(value, 9)), min_size=2, max_size=60
    ).filter(any),
    per_line=st.integers(1, 9),
    dt=st.sampled_from([0.0025, 0.004, 0.005, 0.01, 0.02]),
    ends=st.sampled_from(["\n", "\r\n", "\r", "\r\r\n"]),
    form=st.sampled_from(["{:17.9E}", "{:+.9f}", " {:.9f}"]),
)
def test_what_is_written_is_read(
    tmp_path_factory: pytest.TempPathFactory,
    values: list[float],
    per_line: int,
    dt: float,
    ends: str,
    form: str,
) -> None:
    text = at2(np.array(values), dt, form=form, per_line=per_line)
    path = tmp_path_factory.mktemp("at2") / "a.at2"
    path.write_bytes(text.replace("\n", ends).encode())
    record = read_record(path)
    np.testing.assert_allclose(record.acceleration_m_s2, np.array(values) * G, atol=1e-8)
    assert record.dt_s == dt


def test_negatives_that_run_together(tmp_path: Path) -> None:
    text = at2(np.array([1.234, -5.678, -0.5, 0.25]), form="{:.3f}")
    assert "1.234-5.678-0.500" in text
    record = read_record(written(tmp_path, text.replace("0.5000.250", "0.500 0.250")))
    assert (record.acceleration_m_s2 / G).round(9).tolist() == [1.234, -5.678, -0.5, 0.25]


def test_more_values_than_stated_are_a_warning(tmp_path: Path) -> None:
    values = samples(40)
    for stated in (39, 35, 31):
        text = at2(values).replace("NPTS=     40", f"NPTS=     {stated}")
        (found,) = read_recordings(written(tmp_path, text))
        assert len(found.record.acceleration_m_s2) == stated
        assert "more than" in found.warnings[0] or "more samples" in found.warnings[0]


def test_fewer_values_than_stated_are_refused(tmp_path: Path) -> None:
    text = at2(samples(40)).replace("NPTS=     40", "NPTS=     41")
    with pytest.raises(RecordFileError, match=r"line 12.*40 samples are read.*line 4 states 41"):
        read_recordings(written(tmp_path, text))


def test_a_count_beyond_all_bounds_allocates_nothing(tmp_path: Path) -> None:
    for count in ("1000000000000", "9" * 40):
        text = at2(samples(40)).replace("NPTS=     40", f"NPTS= {count}")
        with pytest.raises(RecordFileError, match="40 samples are read"):
            read_recordings(written(tmp_path, text))


def test_times_beside_the_samples_make_a_table(tmp_path: Path) -> None:
    values = samples(40)
    rows = "".join(f"{0.01 * at:8.3f} {value:15.7E}\n" for at, value in enumerate(values))
    head = "".join(at2(values).splitlines(keepends=True)[:4])
    path = written(tmp_path, head + rows)
    (found,) = read_recordings(path)
    np.testing.assert_allclose(found.record.acceleration_m_s2, values * G, rtol=1e-6)
    assert (found.format, found.record.dt_s, found.units_in_file) == ("columns", 0.01, "g")
    assert "it is read as a table: line 5, " in found.warnings[0]
    assert "times stand beside the samples" in found.warnings[0]
    with refused("", "line 5.*times stand beside the samples"):
        read_recordings(path, format="peer-at2")
    with refused("contradiction"):
        read_recordings(path, units="mg")
    with refused("contradiction"):
        read_recordings(path, dt_s=0.02)


def test_blank_lines_in_the_header(tmp_path: Path) -> None:
    (found,) = read_recordings(written(tmp_path, "\n\n" + at2(samples(40))))
    assert (found.station, found.component) == ("Hut - Far, West", "090")


def test_what_follows_the_samples_is_left_out_with_a_warning(tmp_path: Path) -> None:
    (found,) = read_recordings(written(tmp_path, at2(samples(40)) + "\n\nEND OF FILE\n"))
    assert len(found.record.acceleration_m_s2) == 40
    assert "from line 13, is left out" in found.warnings[0]
    (found,) = read_recordings(written(tmp_path, at2(samples(40)) + "\n\n\x1a\x00\x00"))
    assert found.warnings == ()


def test_words_after_the_last_sample_on_its_own_line(tmp_path: Path) -> None:
    text = at2(samples(38))
    record = read_record(written(tmp_path, text.rstrip() + " END\n"))
    assert record == read_record(written(tmp_path, text))
    with pytest.raises(RecordFileError, match=r"line 5, .*0 samples are read"):
        read_record(written(tmp_path, text.replace("\n", " END\n")))


def test_a_letter_among_the_samples_is_refused_with_its_line(tmp_path: Path) -> None:
    lines = at2(samples(40)).split("\n")
    lines[7] = lines[7].replace("E", "X", 1)
    with pytest.raises(RecordFileError, match=r"line 8, .*X") as found:
        read_recordings(written(tmp_path, "\n".join(lines)))
    assert found.value.line == 8
    assert "\n" not in str(found.value)


@every(
    "quantity",
    [
        "VELOCITY TIME SERIES IN UNITS OF CM/S",
        "DISPLACEMENT TIME SERIES IN UNITS OF CM",
        "Velocity",
        "PSEUDO SPECTRAL ACCELERATION IN UNITS OF G",
        "RESPONSE SPECTRUM, 5 PERCENT, IN UNITS OF G",
    ],
)
def test_velocity_and_displacement_are_refused(tmp_path: Path, quantity: str) -> None:
    with pytest.raises(RecordFileError, match=r"line 3, .*moves by its acceleration"):
        read_recordings(written(tmp_path, at2(samples(40), quantity=quantity)))


def test_units_of_the_file_those_asked_for_and_those_given(tmp_path: Path) -> None:
    values = 100.0 * samples(40)
    in_cm = at2(values, quantity="ACCELERATION TIME HISTORY IN UNITS OF CM/S/S")
    record = read_record(written(tmp_path, in_cm))
    np.testing.assert_allclose(record.acceleration_m_s2, 0.01 * values, rtol=1e-6)
    nothing = at2(values, quantity="ACCELERATION TIME HISTORY")
    with pytest.raises(RecordFileError, match="does not state the unit of its numbers; give units"):
        read_record(written(tmp_path, nothing))
    (found,) = read_recordings(written(tmp_path, nothing), units="gal")
    assert found.warnings == ()
    path = written(tmp_path, in_cm)
    assert read_record(path, units="gal", dt_s=0.01) == record
    with refused(
        "contradiction", r"its numbers are in cm/s\^2, and units in mm/s\^2; leave out un"
    ):
        read_recordings(path, units="mm/s^2")
    with refused("contradiction", "states 0.01 s between samples, and dt_s 0.02 s; leave out dt_s"):
        read_recordings(path, dt_s=0.02)


@every(
    ("counts", "dt"),
    [
        *[("NPTS= {count}, DT= 10 MSEC", 0.01), ("NPTS= {count}, DT (MS)= 10", 0.01)],
        *[("{count} 10.0 NPTS, DT (MSEC)", 0.01), ("{count} .01 SEC NPTS, DT", 0.01)],
        *[("NPTS= {count}, DT= 100 Hz", 0.01), ("NPTS= {count}, DT= .1,5 SEC", None)],
        *[("NPTS= {count}, DT= .01 LIGHTYEARS", None), ("{count} .1,5 NPTS, DT", None)],
        *[("NPTS= {count},5, DT= .01 SEC", None), ("NPTS= {count}, DT= .01.5 SEC", None)],
    ],
)
def test_units_of_the_interval(tmp_path: Path, counts: str, dt: float | None) -> None:
    path = written(tmp_path, at2(samples(40), counts=counts))
    if dt is None:
        with pytest.raises(RecordFileError, match=r"line 4, "):
            read_recordings(path)
    else:
        assert read_recordings(path)[0].record.dt_s == pytest.approx(dt, rel=1e-15)


@every(
    ("quantity", "kind"),
    [
        ("ACCELERATION TIME HISTORY IN UNITS OF G (MULTIPLIED BY 981)", ""),
        ("ACCELERATION TIME HISTORY IN UNITS OF G, SCALE FACTOR= 2.0", ""),
        ("ACCELERATION TIME HISTORY IN UNITS OF G X 1000", ""),
        ("ACCELERATION TIME HISTORY IN UNITS OF G/CM", ""),
        ("ACCELERATION TIME HISTORY IN UNITS OF COUNTS", "counts"),
        ("ACCELERATION TIME HISTORY IN UNITS OF THOUSANDTHS OF G", ""),
        ("UNITS OF G. UNITS OF CM/S/S", "contradiction"),
    ],
)
def test_units_that_are_not_understood_as_a_whole(tmp_path: Path, quantity: str, kind: str) -> None:
    path = written(tmp_path, at2(samples(40), quantity=quantity))
    words = {
        "": "line 3, .*give units",
        "counts": "its numbers are in COUNTS: counts, and the base moves",
        "contradiction": "line 3, .*which are not one unit; take out the line that is wrong",
    }
    with refused(kind, words[kind]):
        read_recordings(path)
    if kind:
        with refused(kind, words[kind]):
            read_recordings(path, units="2 g")
    else:
        (given,) = read_recordings(path, units="2 g")
        assert given.record.peak_acceleration_m_s2 == pytest.approx(2.0 * G, rel=1e-6)
    scaled = at2(samples(40), counts="NPTS= {count}, DT= {dt:.4f} SEC, SCALE FACTOR= 2.0")
    with pytest.raises(RecordFileError, match=r"line 4, .*a factor on the samples"):
        read_recordings(written(tmp_path, scaled))
    same = at2(samples(40), quantity="ACCELERATION IN UNITS OF MILLI G. SCALE FACTOR= 1.0")
    assert read_recordings(written(tmp_path, same))[0].units_in_file == "mg"


@every("odd", ["1.0E+06", "1.0E+307", "-9.9E+300"])
def test_numbers_that_no_record_holds_are_refused(tmp_path: Path, odd: str) -> None:
    lines = at2(samples(40)).split("\n")
    lines[6] = f" {odd}" * 5
    with pytest.raises(RecordFileError, match=r"is none of a record|not a finite number"):
        read_record(written(tmp_path, "\n".join(lines)))


def test_a_peak_beyond_belief_is_doubted(tmp_path: Path) -> None:
    (found,) = read_recordings(written(tmp_path, at2(samples(40, peak=300.0))))
    assert "more than any earthquake has caused" in found.warnings[0]


@every("dt", ["0.0", "-.01", "x"])
def test_an_interval_that_is_none_is_refused(tmp_path: Path, dt: str) -> None:
    text = at2(samples(40)).replace("DT= 0.01000", f"DT= {dt}")
    with pytest.raises(RecordFileError):
        read_recordings(written(tmp_path, text))
