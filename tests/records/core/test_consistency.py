"""Counts, layouts, durations and times of peaks: a cut, a surplus or a wrong interval is named."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady.errors import RecordFileError
from rocksteady.records import Recording, read_recordings
from rocksteady.records.core import consistency
from rocksteady.records.core.text import RecordText
from tests.every import every
from tests.records import ABSENT, FOLDER
from tests.records.writers import (
    at2,
    cosmos_channel,
    csmip_v2_channel,
    csv,
    esm,
    knet,
    samples,
    smc,
)

CM = samples(403, peak=150.0)
COUNTS = np.rint(1e5 * samples(800)).astype(np.int64) - 12085
FILES = {
    "peer": at2(samples(403)),
    "esm": esm(CM),
    "knet": knet(COUNTS),
    "cosmos": cosmos_channel(CM, raw_dt=0.01),
    "csmip": csmip_v2_channel(CM),
    "smc": smc(CM),
}
STATED = {
    "peer": ("NPTS=    403", "NPTS=    380"),
    "esm": ("NDATA: 403", "NDATA: 380"),
    "knet": ("Duration Time(s)  8", "Duration Time(s)  6"),
    "cosmos": ("403  acceleration pts", "400  acceleration pts"),
    "csmip": (" 403 points of accel data", " 400 points of accel data"),
    "smc": ("       403    -32768", "       400    -32768"),
}
INTERVALS = {
    "esm": ("INTERVAL_S: 0.005", "INTERVAL_S: 0.050"),
    "knet": ("100Hz", "50Hz"),
    "csmip": ("equally spaced at  0.005", "equally spaced at  0.010"),
    "smc": ("2.0000000E+02", "1.0000000E+02"),
}


def read(tmp_path: Path, text: str, **given: object) -> tuple[Recording, ...]:
    path = tmp_path / "hut.txt"
    path.write_text(text)
    return read_recordings(path, **given)  # type: ignore[arg-type]


@every("at", [300, 700])
@every(("apart", "doubted"), [(0, False), (2, False), (3, True), (50, True)])
def test_the_time_of_a_peak_is_right_to_some_samples(at: int, apart: int, doubted: bool) -> None:
    """Two, and one more every 500: alike before the peak and after it."""
    values = 0.1 * samples(1000, peak=1.0)
    values[at] = -1.0
    reach = apart + at // 500 if apart else 0
    for stated in (at - reach, at + reach):
        assert bool(consistency.timing(values, 0.01, peak_at=0.01 * stated)) == doubted


@every("name", FILES)
def test_whole_files_are_not_doubted(tmp_path: Path, name: str) -> None:
    assert [one.warnings for one in read(tmp_path, FILES[name])] == [()]


@every("name", STATED)
def test_a_surplus_is_named(tmp_path: Path, name: str) -> None:
    old, new = STATED[name]
    assert old in FILES[name]
    found = read(tmp_path, FILES[name].replace(old, new, 1))[0]
    whole = read(tmp_path, FILES[name])[0].record.acceleration_m_s2
    kept = len(found.record.acceleration_m_s2)
    assert kept < len(whole)
    words = f"holds {len(whole)} samples, more than the {kept} that its header states: the last "
    assert words + f"{len(whole) - kept} are left out" in found.warnings[0]


@every("name", INTERVALS)
def test_an_interval_that_does_not_fit_is_named(tmp_path: Path, name: str) -> None:
    old, new = INTERVALS[name]
    assert old in FILES[name]
    (found,) = read(tmp_path, FILES[name].replace(old, new, 1))
    assert "see whether" in " ".join(found.warnings)
    assert "right" in " ".join(found.warnings)


@every("name", ["peer", "esm", "knet", "smc"])
def test_a_cut_inside_the_last_number_is_refused(tmp_path: Path, name: str) -> None:
    text = FILES[name].rstrip()
    last = text.split()[-1]
    start = max(len(text) - len(last), len(text) - 8)
    for at in range(start + 1, len(text)):
        with pytest.raises(RecordFileError, match=r"inside its last number|is no number"):
            read(tmp_path, text[:at])


@every(
    ("text", "given"),
    [
        (csv(samples(403)), {}),
        ("".join(f"{value:.6f}\n" for value in samples(403)), {"units": "g", "dt_s": 0.01}),
        ("".join(f"{value:15.6E}\n" for value in samples(403)), {"units": "g", "dt_s": 0.01}),
        ("".join(f"{value!r}\n" for value in samples(403).tolist()), {"units": "g", "dt_s": 0.01}),
    ],
)
def test_a_cut_of_a_table_is_warned_about_or_refused(
    tmp_path: Path, text: str, given: dict[str, object]
) -> None:
    text = text.rstrip()
    assert read(tmp_path, text + "\n", **given)[0].warnings == ()
    for at in range(len(text) - 4, len(text) - 1):
        try:
            (found,) = read(tmp_path, text[:at], **given)
        except RecordFileError:
            continue
        words = " ".join(found.warnings)
        # Of seventeen digits the last few do not matter.
        last, whole = found.record.acceleration_m_s2[-1] / 9.80665, samples(403)[-1]
        assert "last number" in words or "laid out" in words or abs(last - whole) < 1e-10


def test_a_lost_digit_in_the_middle_is_named(tmp_path: Path) -> None:
    for name in ("peer", "esm", "smc", "cosmos"):
        lines = FILES[name].split("\n")
        at = len(lines) - 30
        lines[at] = re.sub(r"(\.\d)\d", r"\1", lines[at], count=1)
        (found,) = read(tmp_path, "\n".join(lines))
        assert f"line {at + 1} is not laid out as the others" in found.warnings[0], name


def test_counts_above_tables(tmp_path: Path) -> None:
    rows = "".join(f"{value:10.5f}{-value:10.5f}{value / 2:10.5f}\n" for value in CM)
    head = " PLACE : Hut\n NUMBER OF DATA : {}\n SAMPLING INTERVAL (sec) : 0.01\n"
    head += " ACCELERATION (gal)\n      N-S       E-W       U-D\n"
    found = read(tmp_path, head.format(403) + rows)
    assert [len(one.record.acceleration_m_s2) for one in found] == [403] * 3
    assert [one.record.dt_s for one in found] == [0.01] * 3
    assert [one.warnings for one in found] == [()] * 3
    with pytest.raises(RecordFileError, match="403 samples are read so far, and line 2 states 404"):
        read(tmp_path, head.format(404) + rows)
    (first, *_) = read(tmp_path, head.format(400) + rows)
    assert "403 samples, more than the 400" in first.warnings[0]
    with pytest.raises(RecordFileError, match=r"states 404 and 403 samples"):
        read(tmp_path, "NPTS = 404\n" + head.format(403) + rows)
    lasting = f"duration = 40 s\n{head.format(403)}{rows}"
    assert "header states 40 s" in read(tmp_path, lasting)[0].warnings[0]


def test_the_real_file_cut_inside_its_last_number(tmp_path: Path) -> None:
    path = FOLDER / "suite_at2" / "A-BEN360.AT2"
    if not path.is_file():
        pytest.skip(ABSENT)
    text = path.read_text().rstrip()
    for at in range(len(text) - 12, len(text)):
        with pytest.raises(RecordFileError):
            read(tmp_path, text[:at])


@pytest.mark.parametrize(("end", "doubted"), [("", True), ("\n", False)])
def test_a_cut_in_the_last_of_uneven_numbers(tmp_path: Path, end: str, doubted: bool) -> None:
    rows = [f"{0.02 * at:g},{value}" for at, value in enumerate([0, 0.0063, 0.00364, 0.001] * 9)]
    path = tmp_path / "cut.csv"
    path.write_text("time,acc (g)\n" + "\n".join([*rows, "0.72,-0.0001"]) + end)
    (found,) = read_recordings(path)
    assert ("may end inside its last number" in " ".join(found.warnings)) == doubted


def lines_of(lines: list[str], *, ended: bool = True) -> RecordText:
    return RecordText(path=Path("hut.txt"), lines=tuple(lines), ended=ended)


def test_as_many_samples_as_stated() -> None:
    text = lines_of(["2", "1.5", "2.5", "3.5", "4.5 x"])
    values = np.array([1.5, 2.5, 3.5])
    here: dict[str, Any] = {"stated": 0, "start": 1}
    for count, words in (
        (1, "line 1, .*: 1 samples are no record; see whether the file is whole"),
        (0, "line 1, .*: 0 samples are no record"),
        (4, "line 5, .*: 'x' is no number; 3 samples are read so far, and line 1 states 4; fetch"),
    ):
        with pytest.raises(RecordFileError, match=words):
            consistency.agreed(text, values, count, consistency.Lines(end=4, **here))
    for count, rest in ((3, ""), (2, "one is"), (1 + 1, "one is")):
        kept, doubts = consistency.agreed(
            lines_of(["2", "1.5", "2.5", "3.5"]), values, count, consistency.Lines(end=4, **here)
        )
        surplus = f"the file holds 3 samples, more than the {count} that its header states: "
        assert doubts == ((f"{surplus}the last {rest} left out",) if rest else ())
        np.testing.assert_array_equal(kept, values[:count])
    # Numbers below those that have been read count as well.
    more = lines_of(["2", "1.5", "2.5", "3.5", "4.5"])
    for end, held in ((3, 2), (4, 3)):
        where = consistency.Lines(end=end, **here)
        assert consistency.agreed(more, values[:held], 2, where)[1] == (
            (
                "the file holds 4 samples, more than the 2 that its header states: "
                "the last 2 are left out"
            ),
        )
    for alone, doubts in (
        (True, ("what stands after the last sample, from line 5, is left out",)),
        (False, ()),
    ):
        where = consistency.Lines(end=4, alone=alone, **here)
        assert consistency.agreed(text, values, 3, where)[1] == doubts
    blank = lines_of(["2", "1.5", "2.5", "3.5", " "])
    assert consistency.agreed(blank, values, 3, consistency.Lines(end=4, **here))[1] == ()


def test_durations_that_fit_the_interval() -> None:
    """From the first sample to the last, or an interval more, and half a digit on either side."""
    values = np.ones(101)
    for dt_s, place in ((0.01, 0.0), (0.01, 0.05), (0.02, 0.005)):
        lasts = 100 * dt_s
        for stated, fits in (
            *((lasts, True), (lasts + dt_s, True)),
            *((lasts - place, True), (lasts + dt_s + place, True)),
            *((lasts + 1.02 * (dt_s + place), False), (lasts - 1.02 * place - 0.02 * dt_s, False)),
        ):
            result = consistency.timing(values, dt_s, duration=(stated, place))
            words = f"its 101 samples {dt_s:g} s apart last {lasts:.6g} s, and the header states "
            words += f"{stated:g} s: see whether the interval is right"
            assert result == (() if fits else (words,)), (dt_s, place, stated)
    for none in (None, 0.0, -0.01):
        assert consistency.timing(values, none, duration=(99.0, 0.0), peak_at=50.0) == ()


def test_the_time_of_a_peak_in_words() -> None:
    values = np.full(1000, 0.1)
    values[0] = -1.0
    assert consistency.timing(values, 0.01, peak_at=0.0) == ()
    assert consistency.timing(values, 0.01, peak_at=-1.0) == ()
    for late in (5.0, 1e30):
        assert consistency.timing(values, 0.01, peak_at=late) == (
            (
                f"its peak comes after 0 s, and the header states {late:g} s: "
                "see whether the interval is right"
            ),
        )
    for counterpart, doubted in ((0.991, False), (0.989, True)):
        values[500] = counterpart
        assert bool(consistency.timing(values, 0.01, peak_at=5.0)) == doubted


def test_lines_that_are_laid_out_otherwise_are_counted() -> None:
    """Nine lines make a layout, and eight do not; the first odd one is named, others counted."""
    tail = "not laid out as the others: a character may be lost"
    for count, most in ((8, 0), (9, 1), (40, 3)):
        rows = [f"{k % 7}.{k:03d}4 -{k % 5}.{k:03d}7" for k in range(count)]
        assert consistency.layout(lines_of(rows), range(count)) == ()
        for odd, words in (
            ([2], f"line 3 is {tail}"),
            ([2, 5], f"line 3 and 1 more lines are {tail}"),
            ([2, 5, 6], f"line 3 and 2 more lines are {tail}"),
        ):
            changed = [row[:-1] if at in odd else row for at, row in enumerate(rows)]
            result = consistency.layout(lines_of(changed), range(count))
            assert result == ((words,) if len(odd) <= most else ()), (count, odd)


def test_ends_inside_the_last_number() -> None:
    """Of an odd form alone the end of the line decides, and whether the format is strict."""
    aligned = [f"{k:4d}.{k % 1000:03d}" if k % 3 else f"{-k:4d}.{k:03d}" for k in range(1, 40)]
    loose = [f"{(-1) ** k * 7 ** (k % 5)}.{k:03d}" for k in range(1, 40)]
    for rows, ended, strict, refused in (
        *((aligned, ended, strict, True) for ended in (False, True) for strict in (False, True)),
        *((loose, False, True, True), (loose, True, True, False)),
        *((loose, False, False, False), (loose, True, False, False)),
    ):
        text = lines_of([*rows[:-1], rows[-1][:-1], ""], ended=ended)
        last = rows[-1][:-1].strip()
        if refused:
            match = f"line 39, .*: the file ends inside its last number, '{last}'; fetch"
            with pytest.raises(RecordFileError, match=match):
                consistency.layout(text, range(40), strict=strict)
        else:
            (doubt,) = consistency.layout(text, range(40), strict=strict)
            assert doubt.startswith("line 39 is not laid out"), (ended, strict)
        # What stands below makes it the last number no more.
        below = lines_of([*text.lines, "end"], ended=ended)
        assert "line 39 is not" in consistency.layout(below, range(40), strict=strict)[0]


def test_few_digits_in_the_last_of_uneven_numbers() -> None:
    rng = np.random.default_rng(5)
    for count, ended, few in ((12, False, True), (12, True, True), (12, False, False)):
        rows = [f"{value:.{3 + k % 3}f}" for k, value in enumerate(rng.normal(size=count))]
        rows[-1] = "0.12" if few else "0.12345"
        result = consistency.layout(lines_of(rows, ended=ended), range(count))
        words = "the file may end inside its last number, '0.12': its last line has no end"
        assert result == ((words,) if few and not ended else ())
    whole = ["1234", "-56789", "987654", "12", "34567", "777", "4321", "99", "10", "1"]
    words = "the file may end inside its last number, '1', which has few digits"
    assert consistency.layout(lines_of(whole, ended=False), range(10)) == (words,)
    assert consistency.layout(lines_of([*whole[:-1], "10"], ended=False), range(10)) == ()
    assert consistency.layout(lines_of(whole[2:], ended=False), range(8)) == ()
    assert consistency.layout(lines_of([]), range(3)) == ()
