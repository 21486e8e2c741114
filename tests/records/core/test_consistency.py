"""Counts, layouts, durations and times of peaks: a cut, a surplus or a wrong interval is named."""

import re
from pathlib import Path

import numpy as np
import pytest

from rocksteady.errors import RecordFileError
from rocksteady.records import Recording, read_recordings
from rocksteady.records.core import consistency
from tests.every import every
from tests.records import FOLDER
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


@every(
    "text",
    ["time,acc (g)\n", "Time (s)  Acc (g)", "t;a\n", "acc (g)\n", "# made by hand\ntime\tacc_g\n"],
)
def test_a_table_without_rows_is_named(tmp_path: Path, text: str) -> None:
    with pytest.raises(RecordFileError, match="names of columns and no rows of numbers"):
        read(tmp_path, text)


def test_the_real_file_cut_inside_its_last_number(tmp_path: Path) -> None:
    path = FOLDER / "suite_at2" / "A-BEN360.AT2"
    if not path.is_file():
        pytest.skip(f"there is no {path.name} in ../shared/records")
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


def test_lines_that_are_laid_out_alike_need_no_search_and_lose_no_doubt(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rng = np.random.default_rng(77)

    def said(text: str) -> str:
        try:
            return str([one.warnings for one in read(tmp_path, text)])
        except RecordFileError as error:
            return str(error)

    texts = [*FILES.values()]
    for _ in range(300):
        text = str(rng.choice([*FILES.values()]))
        place = int(rng.integers(len(text) // 3, len(text)))
        for _ in range(int(rng.integers(1, 3))):
            letter = str(rng.choice(["", " ", "-", "1", ".", "E", "+", "\n", "x"]))
            place = min(place + int(rng.integers(0, 40)), len(text))
            text = text[:place] + letter + text[place + int(rng.integers(0, 2)) :]
        texts.append(text if rng.random() < 0.7 else text[:place])
    short = [said(text) for text in texts]
    monkeypatch.setattr(consistency, "_alike", lambda _: False)
    differing = [(a, b) for a, b in zip(short, map(said, texts), strict=True) if a != b]
    assert differing == []
    assert len(set(short)) > 20
