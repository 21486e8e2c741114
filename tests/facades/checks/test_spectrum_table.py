"""Tables of spectra: their rows and dampings, what is between them, and what is refused."""

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady.errors import RocksteadyError
from rocksteady.facades.checks.spectrum_table import SpectrumTable, read_spectrum_table
from tests.every import every

ROWS: dict[str, Any] = {"periods_s": [0.0, 0.2, 0.8, 3.2], "values_g": [0.3, 1.2, 0.6, 0.075]}


def test_rows_are_given_back_and_power_laws_stand_between() -> None:
    """From .2 to .8 s the power is -1/2: at .4 s 1.2/sqrt(2); from .8 to 3.2 s -3/2."""
    floor = SpectrumTable(**ROWS, damping=0.05)
    for period, value in zip(ROWS["periods_s"], ROWS["values_g"], strict=True):
        assert floor.sa_g(period, 0.05) == pytest.approx(value, rel=1e-14)
    assert floor.sa_g(0.4, 0.05) == pytest.approx(1.2 / math.sqrt(2.0), rel=1e-13)
    assert floor.sa_g(1.6, 0.05) == pytest.approx(0.6 / 2.0**1.5, rel=1e-13)
    assert floor.displacement_m(1.6, 0.05) == pytest.approx(
        0.6 / 2.0**1.5 * 9.80665 * (1.6 / (2.0 * math.pi)) ** 2, rel=1e-13
    )


def test_another_damping_is_scaled_by_eta_and_leaves_the_peak() -> None:
    floor = SpectrumTable(**ROWS, damping=0.05)
    assert floor.sa_g(0.8, 0.08) == pytest.approx(0.6 * math.sqrt(10.0 / 13.0), rel=1e-13)
    assert floor.sa_g(0.0, 0.08) == pytest.approx(0.3, rel=1e-13)
    other = SpectrumTable(**ROWS, damping=0.1)
    assert other.sa_g(0.8, 0.05) == pytest.approx(0.6 * math.sqrt(1.5), rel=1e-13)
    assert (
        str(floor.remark(0.08)) == "table at 5 % damping scaled to 8 % by 0.877, the ratio of eta"
    )
    assert str(floor.remark(0.05)) == "table at 5 % damping"


def test_between_two_dampings_it_is_interpolated() -> None:
    """Ln Sa is linear in ln(damping): half way from 5 to 20 % at 10 %."""
    values = [[0.3, 0.3], [1.2, 0.3], [0.4, 0.1]]
    floor = SpectrumTable(periods_s=[0.0, 0.2, 0.8], values_g=values, damping=(0.05, 0.2))
    assert floor.sa_g(0.2, 0.1) == pytest.approx(0.6, rel=1e-13)
    assert floor.sa_g(0.8, 0.1) == pytest.approx(0.2, rel=1e-13)
    assert str(floor.remark(0.1)) == "table interpolated between 5 and 20 % damping to 10 %"


def test_a_table_is_not_continued() -> None:
    floor = SpectrumTable(**ROWS, damping=0.05)
    with pytest.raises(RocksteadyError, match=r"at 3\.3 s: it goes from 0 to 3\.2 s and is not"):
        floor.sa_g(3.3, 0.05)
    bare = SpectrumTable(periods_s=[0.2, 0.8], values_g=[1.2, 0.6], damping=0.05)
    with pytest.raises(RocksteadyError, match="add rows to the table, the first at period 0"):
        bare.sa_g(0.0, 0.05)


WRONG: list[tuple[dict[str, Any], str]] = [
    ({"values_g": [0.3, 1.2]}, "there is one for each period"),
    ({"values_g": "x"}, "values_g = 'x' is not valid: it must be an array of real numbers"),
    ({"periods_s": np.ma.masked_less([0.0, 0.2, 0.8, 3.2], 0.1)}, "a mask would be lost"),
    ({"values_g": [[0.3], [1.2, 0.1], [0.6], [0.1]]}, "give rows of one length"),
    ({"periods_s": [0.0, 0.8, 0.2, 3.0]}, "its periods must ascend"),
    ({"values_g": [0.3, 1.2, math.nan, 0.1]}, "its numbers must be finite"),
    ({"values_g": [3.0, 12.0, 60.0, 1.0]}, "divide m/s^2 by 9.81"),
    ({"damping": 5}, "damping = 5 is not valid"),
    ({"damping": [0.05, 0.1]}, "has 1 column of Sa"),
]


@every(("keys", "line"), WRONG)
def test_what_is_no_table_is_refused(keys: dict[str, Any], line: str) -> None:
    with pytest.raises(RocksteadyError) as refusal:
        SpectrumTable(**{**ROWS, "damping": 0.05, **keys})
    assert line in str(refusal.value)


def test_a_file_is_the_table(tmp_path: Path) -> None:
    file = tmp_path / "floor.csv"
    file.write_text("period_s;sa_g;storey\n0;0.3;2\n0.2;1.2;2\n\n0.8;0.6;2\n3.2;0.075;2\n", "utf-8")
    found, same = (
        read_spectrum_table(file, spectrum_damping=0.05),
        SpectrumTable(**ROWS, damping=0.05),
    )
    assert (found.periods_s, found.values_g) == (same.periods_s, same.values_g)


def test_a_column_of_dampings_makes_a_curve_of_each(tmp_path: Path) -> None:
    file = tmp_path / "floor.csv"
    lines = [f"{t},{sa},{xi}" for xi, sa in ((0.2, 0.3), (0.05, 1.2)) for t in (0.1, 0.5, 2.0)]
    file.write_text("\n".join(["period_s,sa_g,damping", *lines]), "utf-8")
    found = read_spectrum_table(file)
    assert found.damping == (0.05, 0.2)
    assert found.sa_g(0.5, 0.05) == pytest.approx(1.2)
    assert found.sa_g(0.5, 0.2) == pytest.approx(0.3)


@every(
    ("text", "damping", "line"),
    [
        ("period_s,sa_g\n0,0.3\n1,x\n", 0.05, "floor.csv: line 3, sa_g = 'x' is not valid"),
        ("period_s,sa_g\n0,0.3\n0,0.2\n", 0.05, "line 3, period_s = '0' is not valid: it occurs"),
        ("period_s,sa\n0,0.3\n1,0.2\n", 0.05, "did you mean sa_g?"),
        ("period_s,sa_g\n0,0.3\n1,0.2\n", None, "damping is not given"),
        ("period_s,sa_g,damping\n0,0.3,0.05\n1,0.2,0.05\n", 0.05, "damping is given twice"),
        ("period_s,sa_g,damping\n0,1,0.05\n1,1,0.1\n", None, "has other periods"),
        ("period_s,sa_g\n0,0.3\n1,0.2\n", 5, "damping = 5 is not valid"),
        ("period_s,sa_g\n1,0.3\n0.5,0.2\n", 0.05, "its periods must ascend"),
        ("", 0.05, "is empty"),
    ],
)  # fmt: skip
def test_a_fault_of_a_file_is_named_in_one_line(
    text: str, damping: float | None, line: str, tmp_path: Path
) -> None:
    file = tmp_path / "floor.csv"
    file.write_text(text, "utf-8")
    with pytest.raises(RocksteadyError) as refusal:
        read_spectrum_table(file, spectrum_damping=damping)
    assert line in str(refusal.value)
    assert "\n" not in str(refusal.value)


@every(
    ("rows", "named"),
    [
        ("0,0.3\n0.5,0_1.7_5\n4,0.1", "line 3, sa_g = '0_1.7_5'"),
        ("0,12\n0.5,25\n4,8", "per cent by 100"),
        ("0,0.3\n500,0.75\n4000,0.1", "periods in seconds"),
    ],
)
def test_digits_grouped_per_cent_and_milliseconds_are_refused(
    rows: str, named: str, tmp_path: Path
) -> None:
    file = tmp_path / "spectrum.csv"
    file.write_text(f"period_s,sa_g\n{rows}\n", "utf-8")
    with pytest.raises(RocksteadyError, match=re.escape(named)):
        read_spectrum_table(file, spectrum_damping=0.05)
