"""Design spectra: their peak, their end, their damping, and what is refused in a line."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady.codes import ElasticSpectrum, SpectrumTable, make_design_spectrum
from rocksteady.errors import InputError
from tests.every import every

ROWS = [[0.0, 0.3], [0.2, 0.75], [0.6, 0.75], [4.0, 0.1125]]


@every(
    ("rows", "options", "words"),
    [
        ([[0.1, 0.6], *ROWS[1:]], {}, "begins at 0.1 s; add its row at period 0, or state the PGA"),
        (ROWS, {"pga_g": 0.31}, "pga_g = 0.31 is not valid: the spectrum has 0.3 g at period 0 s"),
        ([*ROWS[:3], [1.0, 0.5]], {}, "ends at 1 s, and motions are placed up to 2 s; add rows"),
        (
            [[t, 9.81 * a + 5.0] for t, a in ROWS],
            {},
            "it reaches 12.4 g, and 10 g is the most; give values in g",
        ),
        ([*ROWS[:2], [0.2, 0.7], *ROWS[2:]], {}, "its periods must ascend, and after 0.2 s"),
        ([[0.0, -0.3], *ROWS[1:]], {}, "its spectral accelerations must lie in"),
        ([], {}, "two rows or more"),
        (ROWS, {"spectrum_damping": 0.0}, "spectrum_damping = 0.0 is not valid"),
        (ROWS, {"pga_g": 11.0}, "pga_g = 11.0 is not valid: it must lie in (0, 10]"),
        ("asce7-16:sds=1:sd1=0.6:tl=8", {"spectrum_damping": 0.02}, "formulas are for 5 % damping"),
        ("asce7-22:sds=1", {}, "formulas are en1998-1:2004:type1:C:ag=0.25 or asce7-16"),
    ],
)
def test_what_motions_cannot_be_placed_on_is_refused(
    rows: Any, options: dict[str, Any], words: str
) -> None:
    with pytest.raises(InputError) as error:
        make_design_spectrum(rows, **options)
    assert words in str(error.value)
    assert "\n" not in str(error.value)


@every(
    ("text", "words"),
    [
        ("0 0.3\n0.5 0.7\n4 0.1\n", "states no damping; write # damping 0.05 into it"),
        ("# damping 0.05, Sa [m/s^2]\n0 3\n0.5 7\n4 1\n", "line 1 names m/s^2: it takes T"),
        ("T [s]; Sa [cm/s2]; damping 5 %\n0;300\n1;700\n4;99\n", "line 1 names m/s2"),
        ("freq_hz, Sa [g], damping 5 %\n0 0.3\n1 0.7\n4 0.9\n", "names freq_hz: it takes T"),
        ("T [s], PSV [m/s], damping 5 %\n0 0.3\n1 0.7\n4 0.9\n", "line 1 names psv: it takes"),
        ("T [s], disp [m], damping 5 %\n0 0.3\n1 0.7\n4 0.9\n", "line 1 names m: it takes"),
        ("# damping 0.05\n0,0;0,3\n0,5;0,7\n4,0;0,1\n", "decimal commas|line 2"),
        ("# damping 0.05\n", "has no rows of numbers"),
    ],
)
def test_files_say_their_damping_and_their_unit(tmp_path: Path, text: str, words: str) -> None:
    file = tmp_path / "design.csv"
    file.write_text(text, "utf-8")
    with pytest.raises(InputError, match=words.replace("^", r"\^")):
        make_design_spectrum(file)


def test_a_peak_is_that_of_the_first_row_or_a_given_one_beside_it() -> None:
    assert make_design_spectrum(ROWS).pga_g == 0.3
    assert make_design_spectrum([[0.02, 0.3], *ROWS[1:]]).pga_g == 0.3
    assert make_design_spectrum([[0.1, 0.6], *ROWS[1:]], pga_g=0.25).pga_g == 0.25
    assert make_design_spectrum(ROWS, pga_g=0.305).pga_g == 0.305  # within 2 %


def test_what_was_done_to_it_is_said(tmp_path: Path) -> None:
    file = tmp_path / "design.csv"
    file.write_text("# Sa [g], PGA 2.94 m/s^2, damping 0.02\n0 0.3\n0.2 0.9\n3 0.12\n", "utf-8")
    found = make_design_spectrum(file)
    assert found.range_s == (0.2, 3.0)
    by_hand = 0.9 * 0.55**0.0 * np.sqrt(7.0 / 10.0)  # eta of 5 % over eta of 2 %
    assert found.accelerations_g(np.array([0.2])) == pytest.approx(by_hand)
    assert found.damping_words == "taken from 2 to 5 % damping"
    plain = make_design_spectrum(ROWS)
    assert plain.damping_words == plain.remark == found.remark == ""
    formula = make_design_spectrum("asce7-16:sds=1:sd1=0.6:tl=8")
    assert "of ASCE 7-16, 11.4.6 (sds=1:sd1=0.6:tl=8), not checked" in formula.remark
    # Divided by q = 3 the plateau is 2.5/3 of the peak, or 1.25 of a peak that is divided less.
    for top, words in ((0.375, "divided by q or R"), (0.539, "divided by q"), (0.541, ""),
                       (1.499, ""), (1.501, "check PGA and unit")):  # fmt: skip
        found = make_design_spectrum([[0, 0.3], [0.2, top], [4, 0.1]])
        assert words in found.peak_words
        assert bool(words) == bool(found.peak_words)


def test_a_damping_that_contradicts_the_file_and_columns_of_two_peaks(tmp_path: Path) -> None:
    file = tmp_path / "design.csv"
    file.write_text("# damping 2 %, 5 %\n0 0.35 0.25\n0.2 0.9 0.7\n4 0.1 0.08\n", "utf-8")
    assert make_design_spectrum(file).pga_g == 0.25  # that of 5 %
    with pytest.raises(InputError, match=r"states 0.02, 0.05; leave it out, or correct the file"):
        make_design_spectrum(file, spectrum_damping=0.05)
    file.write_text("# damping 5 %\n0 0.25\n0.2 0.7\n4 0.08\n", "utf-8")
    assert make_design_spectrum(file, spectrum_damping=0.05).pga_g == 0.25
    with pytest.raises(InputError, match=r"states 0\.05"):
        make_design_spectrum(file, spectrum_damping=0.02)


def test_classes_of_spectra_are_taken_at_5_per_cent() -> None:
    site = ElasticSpectrum(ag_g=0.2, f0=2.4, tc_star_s=0.33, soil="C")
    table = SpectrumTable(periods_s=[0.0, 0.5, 4.0], values_g=[0.3, 1.2, 0.12], damping=0.02)
    for given in (site, table):
        found, t = make_design_spectrum(given), np.array([0.3, 1.0, 3.0])
        expected = [given.sa_g(each, 0.05) for each in t.tolist()]
        np.testing.assert_allclose(found.accelerations_g(t), expected, rtol=2e-3)
