"""Tables of measured free rocking: units, tests, sides, and files that are wrong."""

import math
from pathlib import Path

import numpy as np
import pytest

from rocksteady.calibration import read_peaks
from rocksteady.errors import InputError
from tests.every import every


def _read(folder: Path, text: str, encoding: str = "utf-8") -> list:  # type: ignore[type-arg]
    file = folder / "peaks.csv"
    file.write_bytes(text.encode(encoding))
    return read_peaks(file)


@every(("column", "scale"), [("peak_rad", 1.0), ("peak_deg", math.pi / 180.0), ("peak_mrad", 1e-3)])
def test_each_unit_is_read_as_radians(column: str, scale: float, tmp_path: Path) -> None:
    (release,) = _read(tmp_path, f"{column}\n0.9\n0.7\n0.5\n")
    assert release.peaks_rad == pytest.approx(scale * np.array([0.9, 0.7, 0.5]), rel=1e-15)
    assert (release.sigma_rad, release.times_s, release.name) == (None, None, "release")
    assert release.sides.tolist() == [1, -1, 1]


def test_all_columns_are_read_and_others_are_not(tmp_path: Path) -> None:
    rows = "test;peak_rad;side;t_s;sigma_rad;remark\n"
    rows += (
        "a;0.08;+;0.1;0.001;good\na;0.06;right;0.5;0.002;\n\nb;0.07;-;0;0.001;x\nb;0.05;-1;1;0;\n"
    )
    one, two = _read(tmp_path, rows, "utf-8-sig")
    assert one.sides.tolist() == [1, -1]
    assert two.sides.tolist() == [-1, -1]
    assert one.times_s.tolist() == [0.1, 0.5]
    assert one.sigma_rad.tolist() == [0.001, 0.002]
    assert (one.name, two.name) == ("a", "b")


@every(
    ("text", "words"),
    [
        ("", "is empty"),
        ("peak_rad\n", "has 0 peaks"),
        ("angle\n1\n", "has no column peak_rad"),
        ("peak_rad,peak_deg\n1,2\n", "has the columns peak_rad and peak_deg"),
        ("peak_rads\n1\n", "did you mean peak_rad"),
        ("peak_rad,peak_rad\n1,2\n", "it occurs twice"),
        ("peak_rad\n0.08\nx\n", "line 3, peak_rad = 'x' is not valid: it must be a finite number"),
        ("peak_rad;t_s\n0,08;1\n0.07;2\n", "write a point for a decimal comma"),
        ("peak_rad\n0.08\n-0.07\n", r"line 3, peak_rad = -0\.07 .* in \(0, 1\.57.*; give abs"),
        ("peak_deg\n95\n80\n", r"line 2, peak_deg = 95\.0 .* in \(0, 90\)"),
        (
            "peak_rad,test\n0.08,a\n0.07,b\n0.06,a\n",
            "line 4, test = 'a' .* line 2 has it too",
        ),
        ("peak_rad,test\n0.08,a\n0.07,\n", "line 3, test is empty"),
        ("peak_rad,side\n0.08,+\n0.07,up\n", "line 3, side = 'up'"),
        ("peak_rad,t_s\n0.08,1\n0.07,1\n", "times_s of release do not rise"),
        ("peak_rad,sigma_rad\n0.08,-1\n0.07,0\n", "line 2, test release: sigma_rad"),
        ("peak_rad\n0.08\n", "needs the peaks before and after it"),
        ("peak_rad,test\n0.08\n", "has 1 cells"),
        ("peak_rad\n0.08\0\n", "zero byte"),
    ],
)
def test_a_wrong_file_has_one_line(text: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=words) as refused:
        _read(tmp_path, text)
    assert "\n" not in str(refused.value)
    assert "peaks.csv" in str(refused.value)


def test_a_file_that_is_not_there_or_not_text_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="name a table in CSV"):
        read_peaks(tmp_path / "nothing.csv")
    with pytest.raises(InputError, match="is not UTF-8"):
        _read(tmp_path, "peak_rad\n\N{SUPERSCRIPT TWO}\n", "latin-1")
