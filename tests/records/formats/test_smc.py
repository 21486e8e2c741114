"""Files of SMC: header, samples, times and samples in turn, and what is refused."""

from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from rocksteady.errors import RecordFileError
from rocksteady.records.core.assembling import Given
from rocksteady.records.core.text import RecordText
from rocksteady.records.formats import smc as smc_format
from tests.every import every
from tests.records.formats.networks import CM, close, read
from tests.records.writers import smc


def test_smc(tmp_path: Path) -> None:
    (found,) = read(tmp_path, smc(CM))
    close(found, CM, 5e-3)
    assert (found.format, found.units_in_file, found.record.dt_s) == ("smc", "cm/s^2", 0.005)
    assert (found.orientation, found.azimuth_deg) == ("horizontal", 0.0)
    assert (found.station, found.event) == ("Hut, 1295 Shafter", "Somewhere, CA")
    assert found.start_time == datetime(1989, 10, 18, 17, 4, 5, 250000, tzinfo=UTC)
    assert found.warnings == ()


def test_smc_states_when_its_peak_comes_on_either_side(tmp_path: Path) -> None:
    for values in (CM, -CM):
        assert read(tmp_path, smc(values))[0].warnings == ()
        early = np.roll(values, 50)
        text = smc(values).partition("| 12.5")[0] + "|" + smc(early).partition("|")[2]
        (found,) = read(tmp_path, text)
        assert "its peak comes after" in "".join(found.warnings)


def test_smc_vertical_and_without_comments(tmp_path: Path) -> None:
    (found,) = read(tmp_path, smc(CM, comments=0, angles=(0, 0)))
    close(found, CM, 5e-3)
    assert found.orientation == "vertical"


def test_smc_counts_its_comments_with_or_without_their_bar(tmp_path: Path) -> None:
    for comment in ("| 12.5 of comment", "12.5 of comment"):
        (found,) = read(tmp_path, smc(CM).replace("| 12.5 of comment", comment))
        close(found, CM, 5e-3)
        assert found.warnings == ()


def test_smc_of_times_and_samples_in_turn(tmp_path: Path) -> None:
    times = 0.00149 * np.arange(len(CM))
    times[9::10] += 0.0006
    pairs = np.column_stack([times, CM]).ravel()
    text = smc(pairs, rate=None, first="1 UNCORRECTED ACCELEROGRAM")
    with pytest.raises(RecordFileError, match="ask for resampling"):
        read(tmp_path, text)
    (found,) = read(tmp_path, text, resample=True, dt_s=0.001)
    assert found.record.dt_s == 0.001
    assert found.record.peak_acceleration_m_s2 == pytest.approx(1.5, rel=0.2)


@every("first", ["3 VELOCITY", "4 DISPLACEMENT", "5 RESPONSE SPECTRA"])
def test_smc_of_another_quantity_is_refused(tmp_path: Path, first: str) -> None:
    with pytest.raises(RecordFileError, match=r"line 1, .*must be an accelerogram"):
        read(tmp_path, smc(CM, first=first))


def test_smc_that_is_cut(tmp_path: Path) -> None:
    lines = smc(CM).split("\n")
    for kept in (12, 16, 20, 28, 40):
        with pytest.raises(RecordFileError):
            read(tmp_path, "\n".join(lines[:kept]))


def put(text: str, part: int, place: int, written: str) -> str:
    """Return a file with another number in its header: of ten characters, or of fifteen."""
    lines = text.split("\n")
    first, width, per_line = ((11, 10, 8), (17, 15, 5))[part]
    at, column = first + place // per_line, place % per_line * width
    lines[at] = f"{lines[at][:column]}{written:>{width}}{lines[at][column + width :]}"
    return "\n".join(lines)


def test_smc_starts_that_are_stated_in_part() -> None:
    plain = datetime(1989, 10, 18, 17, 4, 5, 250000, tzinfo=UTC)
    for place, written, start in (
        *((1, "1800", plain.replace(year=1800)), (1, "1799", None), (1, "10000", None)),
        *((1, "9999", plain.replace(year=9999)), (1, "-32768", None), (2, "-32768", None)),
        *((3, "-32768", None), (4, "-32768", None), (5, "-32768", plain.replace(second=0))),
        *((6, "-32768", plain.replace(microsecond=0)), (5, "59", plain.replace(second=59))),
        *((2, "1", plain.replace(month=1, day=1)), (2, "365", plain.replace(month=12, day=31))),
        *((3, "0", plain.replace(hour=0)), (4, "0", plain.replace(minute=0))),
        *((6, "1", plain.replace(microsecond=1000)), (2, "9999999", None)),
    ):
        # 1800 is no leap year, and 291 is then the same day.
        text = put(smc(CM), 0, place, written)
        path = RecordText(path=Path("hut.smc"), lines=tuple(text.split("\n")))
        (result,) = smc_format.read(path, Given())
        assert result.start_time == start, (place, written)


def test_smc_numbers_of_the_header_that_are_missing_or_wrong(tmp_path: Path) -> None:
    text = smc(CM, comments=0)
    (result,) = read(tmp_path, put(text, 0, 15, "-32768"))
    close(result, CM, 5e-3)
    for place, written, words in (
        (15, "-1", "line 13, .*it states more comments than the file has lines"),
        (15, "9999", "line 13, .*it states more comments than the file has lines"),
        (16, "-32768", "line 14, .*it must state the number of samples first"),
        (16, "x", "line 14, .*it must hold 8 numbers of the header; fetch the file again"),
    ):
        with pytest.raises(RecordFileError, match=words):
            read(tmp_path, put(text, 0, place, written))
    with pytest.raises(RecordFileError, match=r"line 18, .*it must hold 5 numbers of the header"):
        read(tmp_path, put(text, 1, 2, "x"))
    # Numbers that fill their columns have nothing between them.
    (full,) = read(tmp_path, put(put(text, 0, 20, "1234567890"), 0, 21, "1234567890"))
    (long,) = read(tmp_path, put(put(text, 1, 3, "123456789.12345"), 1, 4, "123456789.12345"))
    assert full.record == long.record == result.record
    for rate in ("0.0", "-1.0", "1.7E38"):
        with pytest.raises(
            RecordFileError, match=r"line 18, .*a sampling rate above 0, as its sec"
        ):
            read(tmp_path, put(text, 1, 1, rate))
        assert read(tmp_path, put(text, 1, 1, rate), dt_s=0.01)[0].record.dt_s == 0.01


def test_smc_peaks_and_directions(tmp_path: Path) -> None:
    largest, smallest = CM.max(), CM.min()
    text = smc(CM)
    (result,) = read(tmp_path, text)
    assert result.stated_peak_m_s2 == pytest.approx(0.01 * max(largest, -smallest), rel=1e-6)
    for place, left in ((29, smallest), (31, largest)):
        (single,) = read(tmp_path, put(text, 1, place, "1.7000000E+38"))
        assert single.stated_peak_m_s2 == pytest.approx(abs(0.01 * left), rel=1e-6)
    bare = put(put(text, 1, 29, "1.7000000E+38"), 1, 31, "1.7000000E+38")
    assert read(tmp_path, bare)[0].stated_peak_m_s2 is None
    for angles, orientation, azimuth in (
        *(((0, 0), "vertical", None), ((180, 0), "vertical", None), ((90, 0), "horizontal", 0.0)),
        *(((90, 359), "horizontal", 359.0), ((90, 361), "horizontal", 0.0), ((90, -1), "h", 0.0)),
        *(((45, 10), "horizontal", 0.0), ((90, 1), "horizontal", 1.0)),
    ):
        text = smc(CM, angles=angles)
        text = text if orientation == "vertical" else text.replace("=    360", "=   none")
        (single,) = read(tmp_path, text)
        known = angles[0] != 45 and 0 <= angles[1] <= 360
        assert (single.orientation, single.azimuth_deg) == (
            (orientation, azimuth) if known else ("unknown", None)
        ), angles
        sign = -1.0 if angles[0] == 180 else 1.0
        np.testing.assert_allclose(single.record.acceleration_m_s2, 0.01 * sign * CM, atol=1e-4)
    star = smc(CM, first="*")
    assert read(tmp_path, star)[0].warnings == (
        "the file does not state its quantity: taken to be acceleration",
    )


def test_smc_words_of_the_header(tmp_path: Path) -> None:
    text = smc(CM)
    for old, new, fields in (
        ("station = Hut, 1295 Shafter        component=    360", "-", {"station": "HUT1"}),
        ("station = Hut, 1295 Shafter        component=    360", "-", {"component": None}),
        ("component=    360", "component= up  ", {"component": "up", "orientation": "horizontal"}),
        ("1704 Somewhere, CA", "1704              ", {"event": None}),
        ("HUT1", "    ", {"station": "Hut, 1295 Shafter"}),
    ):
        assert old in text
        (result,) = read(tmp_path, text.replace(old, new))
        assert {name: getattr(result, name) for name in fields} == fields, new
