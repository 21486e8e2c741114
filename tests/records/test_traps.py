"""Headers and columns about other things, which could pass for those of a motion."""

from pathlib import Path

import numpy as np
import pytest

from rocksteady.errors import RecordFileError
from rocksteady.records import read_recordings
from rocksteady.records.suite import select
from tests.every import every
from tests.records.writers import at2, samples

N, E, U = (samples(300, peak, seed) for seed, peak in enumerate((90.0, 60.0, 30.0)))
ALONE = "".join(f"{value:.4f}\n" for value in N)
HEAD = "dt: 0.01 s\nunits: gal\n"


def table(names: str, *columns: np.ndarray, time: bool = True) -> str:
    rows = zip(*columns, strict=True)
    times = [f"{k * 0.01:.2f}," * time for k in range(len(N))]
    body = (at + ",".join(f"{v:.4f}" for v in row) for at, row in zip(times, rows, strict=True))
    return names + "\n" + "\n".join(body) + "\n"


@every(
    ("text", "words"),
    [
        ("# dt: 0.01 s\n# units: gal\n# N\n" + ALONE + "# E\n" + ALONE, "another channel"),
        (HEAD + ALONE + "\n" + ALONE, "another channel or quantity; give each block"),
        (HEAD + ALONE + "UD, dt .01 s\n" + ALONE, "another channel or quantity; give each block"),
        *(
            (HEAD + ALONE + f"{odd}\n" + ALONE, "line 303, .*a row of numbers")
            for odd in ("%", "# 0.0071", ",", "n/a")
        ),
        (
            table("time (s),acc (gal),Time2 (s),acc2 (gal)", N, np.arange(300.0), E),
            "two columns of",
        ),
        ("Acceleration response spectrum, 5% damping\n" + HEAD + ALONE, "spectra"),
        ("Low-pass filter\n40 Hz\nunits: gal\n" + ALONE, "does not state the interval"),
        ("gravity 9.81 (m/s2)\ndt: 0.01 s\n" + ALONE, "does not state the unit"),
        ("Gravity (m/s2): 9.81\ndt: 0.01 s\n" + ALONE, "does not state the unit"),
        ("Sensor range (g): 2\ndt: 0.01 s\n" + ALONE, "does not state the unit"),
        (table("time,S/N (gal)", N), "not understood"),
    ],
)
def test_what_is_refused(tmp_path: Path, text: str, words: str) -> None:
    (tmp_path / "hut.txt").write_text(text)
    with pytest.raises(RecordFileError, match=words):
        read_recordings(tmp_path / "hut.txt")


def test_what_an_option_leaves_unread_is_said(tmp_path: Path) -> None:
    """A folder's options meet files that state something else in words that are not understood."""
    path = tmp_path / "hut.txt"
    for line in ("Units: dm/s2", "Units: x1000 g", "-acc (g)", "1000*acc (g)", "DT: 1/100 s"):
        path.write_text(f"{line}\n{ALONE}")
        (found,) = read_recordings(path, units="gal", dt_s=0.01)
        assert [doubt for doubt in found.warnings if line in doubt and "as given" in doubt], line
    path.write_text(f"Duration: 3 s\n{ALONE}")
    (found,) = read_recordings(path, units="gal", dt_s=0.05)
    assert "the header states 3 s" in found.warnings[0]
    path.write_text(HEAD + ALONE + "\n" + ALONE[:99])
    assert read_recordings(path)[0].warnings[0] == "1 blank line among its samples passed over"


@every(
    ("text", "taken", "left"),
    [
        (table("N,time,acc (gal)", np.arange(300.0), 0.01 * np.arange(300.0), N, time=False), 1, 1),
        (table("time,long,lat,acc (gal)", 0 * N + 30.0, 0 * N + 12.0, N), 1, 2),
        (table("time (s),E (J),H (m),acc (gal)", E, U, N), 1, 2),
        ("Vertical acceleration at a hut\n" + HEAD + ALONE, 0, 1),
        ("Epicentral azimuth: 113 deg\n" + HEAD + ALONE, 1, 0),
        ("# Y is up\n" + table("time (s),x (gal),y (gal),z (gal)", N, U, E), 0, 3),
        (table("time (s),x (gal),y (gal),z (gal)", N, E, U), 2, 1),
        (HEAD + table("T,L,V", N, E, U, time=False), 2, 1),
        (HEAD + "\n".join(table("", N, E, U, N, E, U, time=False).split("\n")[1:]), 0, 6),
        (at2(N, component="090").replace("Hut - Far", "Hut - 5th floor"), 0, 1),
        (at2(N, component="090").replace("Hut - Far", "Downhole 30 m"), 0, 1),
        (at2(N, component="090").replace("Hut - Far", "Pacoima Dam (upper left abut)"), 1, 0),
        ("Component: NNE\n" + HEAD + ALONE, 1, 0),
    ],
)
def test_what_is_taken(tmp_path: Path, text: str, taken: int, left: int) -> None:
    (tmp_path / "hut.txt").write_text(text)
    recordings = read_recordings(tmp_path / "hut.txt")
    across, others = select(recordings)
    assert (len(across), len(others)) == (taken, left)
    for each in across:
        assert len(each.record.acceleration_m_s2) == len(N)
        assert each.azimuth_deg in {None, 22.5, 90.0}
