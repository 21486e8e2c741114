"""Demand spectra: interpolation, damping, files and refusals."""

import math
import time
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

from rocksteady import Record
from rocksteady.errors import InputError
from rocksteady.measures import compute_response_spectrum
from rocksteady.risk.spectra import tabulated as spectra
from rocksteady.risk.spectra.tabulated import (
    Chain,
    RecordSpectrum,
    read_table,
    spectrum_of,
    tabulated,
)
from tests.every import every

G = 9.80665
TABLE = [[0.0, 0.3], [0.1, 0.75], [0.5, 0.75], [2.0, 0.1875]]


def test_a_chain_is_a_straight_line_on_logarithmic_paper() -> None:
    chain = Chain((0.1, 0.5, 2.0), (2.0, 2.0, 0.5))
    assert chain.at(0.3) == pytest.approx(2.0)
    assert chain.at(1.0) == pytest.approx(1.0)  # 1/T
    assert (chain.at(0.01), chain.at(5.0)) == (2.0, 0.5)
    assert list(chain.pieces()) == [(0.1, 0.0), (0.5, 0.0), (2.0, pytest.approx(-1))]


def test_between_two_dampings_both_logarithms_are_interpolated() -> None:
    rows = [[0.1, 1.2, 0.6], [1.0, 0.9, 0.3]]
    table = tabulated(rows, (0.02, 0.08))
    assert table is not None
    chain, how = table.at_damping(0.04, 4.0)
    assert chain.values_m_s2 == pytest.approx([math.sqrt(0.72) * G, math.sqrt(0.27) * G])
    assert "from 2 and 8 %" in how
    turned = tabulated([[t, b, a] for t, a, b in rows], (0.08, 0.02))
    assert turned is not None
    assert turned.at_damping(0.04, 4.0)[0] == chain


def test_a_record_has_its_spectrum_at_the_damping_itself() -> None:
    t = 0.02 * np.arange(400)
    record = Record(acceleration_m_s2=3.0 * np.sin(7.0 * t) * np.exp(-0.3 * t), dt_s=0.02)
    found = spectrum_of(compute_response_spectrum(record, [0.5], damping=0.2), None)
    assert found == RecordSpectrum(record) == spectrum_of(record, None)
    assert found is not None
    chain, _ = found.at_damping(0.0173, 3.0)
    some = list(range(0, 200, 37))
    exact = compute_response_spectrum(
        record, [chain.periods_s[i] for i in some], damping=0.0173
    ).pseudo_acceleration_m_s2
    assert [chain.values_m_s2[i] for i in some] == pytest.approx(exact.tolist(), rel=1e-12)
    assert chain.last_s == pytest.approx(3.0)


@every("first", [1e-5, 0.005, 0.01, 0.0101, 0.5])
def test_a_row_at_period_zero_stands_below_all_others(first: float) -> None:
    """Its value holds up to 0.01 s, or to half the next period where that comes sooner."""
    table = tabulated([[0.0, 0.3], [first, 0.9], [2.0, 0.5]], 0.05)
    assert table is not None
    chain, _ = table.at_damping(0.05, 4.0)
    rigid = 0.01 if first > 0.01 else 0.5 * first
    assert chain.periods_s == (rigid, first, 2.0)
    assert chain.at(0.99 * rigid) == chain.at(0.0) == pytest.approx(0.3 * G)
    assert chain.at(first) == pytest.approx(0.9 * G)


@every("longest", [1e-9, 0.5, 4.0, 1e12])
@every("step", [0.02, 2.0])
def test_periods_of_a_record_ascend_to_the_longest_that_is_wanted(
    longest: float, step: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """From 0.01 s, or a hundredth of the interval: an oscillator swings no faster between two."""
    monkeypatch.setattr(spectra, "RECORD_PERIODS", 4)
    record = Record(acceleration_m_s2=np.array([1.0, -1.0]), dt_s=step)
    periods = np.array(RecordSpectrum(record).at_damping(0.05, longest)[0].periods_s)
    assert periods[0] == pytest.approx(max(0.01, 0.01 * step), rel=1e-12)
    assert (np.diff(periods) > 0.0).all()
    assert periods[-1] == pytest.approx(min(max(longest, 2.0 * periods[0]), 1e9))


def test_a_table_may_reach_its_bounds_and_not_beyond() -> None:
    rows = [[1e-6, 1e-12], [1e9, 1e12]]
    assert tabulated(rows, 0.05) is not None
    assert tabulated([[0.0, 1.0], *rows], 0.05) is not None
    for place, value in ((0, 0), (0, 1), (1, 0), (1, 1)):
        wrong = [list(row) for row in rows]
        wrong[place][value] *= 1.001 if place else 0.999
        with pytest.raises(InputError, match="must lie in"):
            tabulated(wrong, 0.05)
    with pytest.raises(InputError, match="2 columns of Sa"):
        tabulated([[0.1, 0.3, 0.2], [0.2, 0.3, 0.2]], 0.05)


@every(
    ("given", "damping", "values", "how"),
    [
        ((0.02, 0.08), 0.02, (0.4, 1.2), "as given at 2 % damping"),
        ((0.02, 0.08), 0.08, (0.4, 0.6), "as given at 8 % damping"),
        # By hand: sqrt(10/(5 + xi)) of 1, 2, 8 and 20 %, at least 0.55.
        ((0.02, 0.08), 0.01, (0.4, 1.2 * 1.290994 / 1.195229), "scaled from 2 % to 1 %"),
        ((0.02, 0.08), 0.2, (0.4, 0.6 * 0.632456 / 0.877058), "scaled from 8 % to 20 %"),
        ((0.3, 0.9), 0.2, (0.4, 1.2 * 0.632456 / 0.55), "damping by 1.15, eta of EN 1998-1 eq. 3"),
        # A factor of 1 is not shown.
        ((0.0189, 0.08), 0.018897, (0.4, 1.200026), "as given at 1.89 % damping"),
        ((0.02, 0.3), 0.4, (0.4, 0.6), "as given at 30 %, for 40 % damping"),
    ],
)
def test_at_the_dampings_of_a_table_and_beyond_the_nearest_column_counts(
    given: tuple[float, float], damping: float, values: tuple[float, float], how: str
) -> None:
    """Outside its dampings Eurocode 8 scales all but the peak acceleration, at period 0."""
    table = tabulated([[0.0, 0.4, 0.4], [0.5, 1.2, 0.6]], given)
    assert table is not None
    chain, words = table.at_damping(damping, 4.0)
    assert chain.periods_s == (0.01, 0.5)
    assert np.array(chain.values_m_s2) / G == pytest.approx(values, rel=1e-5)
    assert how in words


def test_without_a_damping_a_table_is_checked_and_not_used() -> None:
    assert spectrum_of(None, None) is None
    assert spectrum_of(TABLE, None) is None


@every(
    ("table", "damping", "words"),
    [
        ([[0.1, 0.3]], 0.05, "two rows"),
        ([0.1, 0.3], 0.05, "two rows"),
        ([[0.1, 0.3], [0.1, 0.4]], 0.05, "ascend"),
        ([[-0.1, 0.3], [0.1, 0.4]], 0.05, "ascend"),
        ([[0.1, 0.3], [0.2, 0.0]], 0.05, "spectral accelerations"),
        ([[0.1, 0.3], [0.2, math.nan]], 0.05, "finite"),
        ([[0.1, 0.3], [1e-9, 0.3]], 0.05, "ascend"),
        ([[0.0, 0.3], [1e-9, 0.3]], 0.05, "periods above 0"),
        ([[0.1, 0.3], [0.2, 0.3], [1.1e9, 0.3]], 0.05, "periods above 0"),
        (TABLE, (0.02, 0.05), "1 column"),
        ([[0.1, 0.3, 0.2], [0.2, 0.3, 0.2]], (0.05, 0.05), "differ"),
        (TABLE, 5.0, "(0, 1)"),
        (TABLE, 0.0, "(0, 1)"),
        ("spectrum", 0.05, "real numbers"),
        ([[0.1], [0.2, 0.3]], 0.05, "rows of one length"),
    ],
)
def test_what_is_no_spectrum_is_refused(table: object, damping: object, words: str) -> None:
    with pytest.raises(InputError, match=r".") as refusal:
        tabulated(table, damping)
    assert words in str(refusal.value)


@every(
    ("text", "values", "dampings"),
    [
        ("\n0.1 0.3\n0.2, 0.4\n", [0.3], None),
        ("# site A\n# damping 0.05\n0.1;0.3\n\n0.2;0.4\n", [0.3], (0.05,)),
        ("# Damping = 5 %\nperiod_s,sa_g\n0.1,0.3\n0.2,0.4\n", [0.3], (0.05,)),
        ("T (s), Sa (g), damping: 2%\n0.1\t0.3\n0.2\t0.4\n", [0.3], (0.02,)),
        ("# damping 2 %, 5 %, 10 %\n0.1 3 2 1\n0.2 3 2 1\n", [3.0, 2.0, 1.0], (0.02, 0.05, 0.1)),
        ("# damping 2, 5 and 10 % of critical\n0.1 3 2 1\n", [3.0, 2.0, 1.0], (0.02, 0.05, 0.1)),
    ],
)
def test_a_file_is_read_with_the_dampings_it_states_in_the_order_of_the_columns(
    tmp_path: Path, text: str, values: list[float], dampings: tuple[float, ...] | None
) -> None:
    file = tmp_path / "spectrum.txt"
    file.write_text(text, encoding="utf-8")
    rows, found = read_table(file)
    assert rows[0].tolist() == [0.1, *values]
    assert found == dampings


@every(
    ("line", "damping"),
    [
        ("UHS, 5 % damping, 2 % in 50 years", 0.05),
        ("damping 5 %, 2 % in 50 years", 0.05),
        ("5 % damping, PGA 0.4 g", 0.05),
        ("5 % damping 0.4 g PGA", 0.05),
        ("5% damping, 4% slope", 0.05),
        ("5 % damping; soil factor 0.9", 0.05),
        ("damping 0.05 soil factor 0.9", 0.05),
        ("5 %-damped", 0.05),
        ("5 per cent of critical damping", 0.05),
        ("damping 5", 0.05),
        ("damping 1", 0.01),
        ("damping 0.5 %", 0.005),
        ("damping ratio 0.05", 0.05),
        ("0.05 damping", 0.05),
        ("damping: 5 percent", 0.05),
        ("Damping (%): 5", 0.05),
        ("damping ratio of 5%, return period 475 years", 0.05),
        ("5 % damping = 0.05", 0.05),
        ("zeta = .05", 0.05),
        ("ξ=5 %", 0.05),
        ("xi=5%", 0.05),
        ("Table XI 2", None),
        ("rev 1.02 damping 5 %", 0.05),
        ("UHS of 2 %, 5 % damping", 0.05),
        ("5-percent damped", 0.05),
        ("5 pct. damping", 0.05),
        ("damping 0,05", 0.05),
        ("smorzamento viscoso 5 per cento", 0.05),
        ("damping ratio 0.05, 2 sites", 0.05),
        ("undamped oscillators at 5 %", None),
        ("soil factor 0.9, 2 % in 50 years", None),
        ("damping of the structure 0.9", "no number beside"),
        ("damping, soil factor 0.9", "no number beside"),
        ("zeta = -0.05", "no number beside"),
        ("2 % damping 5 %", "a second damping"),
        ("damping 2,5 %", "line 1 states 2 dampings for 1 column of Sa"),
        ("damping 5 % \n# damping 0.02", "line 2 states a second damping"),
        ("site A\n# of some damping", "line 2 names a damping"),
        ("of some damping\n# damping 5 %", 0.05),
    ],
)
def test_only_a_number_beside_the_word_is_the_damping(
    tmp_path: Path, line: str, damping: float | str | None
) -> None:
    file = tmp_path / "spectrum.txt"
    file.write_text(f"# {line}\n0.1 0.3\n0.2 0.4\n", encoding="utf-8")
    if isinstance(damping, str):
        with pytest.raises(InputError, match=damping):
            read_table(file)
        assert read_table(file, 0.05)[1] == 0.05  # what a caller states needs no header
    else:
        assert read_table(file)[1] == (None if damping is None else (damping,))


@every("filling", [" ", "of ", "5 % ", "5 ", "_(", "damping ", "0", "5,"])
def test_a_long_comment_is_read_at_once(tmp_path: Path, filling: str) -> None:
    file = tmp_path / "spectrum.txt"
    file.write_text(f"# damping {filling * 500}x\n0.1 0.3\n0.2 0.4\n", encoding="utf-8")
    began = time.process_time()
    with suppress(InputError):
        read_table(file)
    assert time.process_time() - began < 1.0


@every(
    ("text", "words"),
    [
        ("", "no rows"),
        ("period sa\n", "no rows"),
        ("0.1 0.3\n0.2 0.3 0.4\n", "line 2 has 3 numbers"),
        ("0.1 0.3\nend of file\n", "line 2 is no row"),
        ("T;Sa\n0,1;0,25\n0,2;0,35\n", "line 2 has decimal commas"),
        ("0.1 0.3\n0,2\t0,35\n", "line 2 has decimal commas"),
        ("T,Sa\n0,1,0,25\n0,5,0,6\n", "line 2, 0,1,0,25, has whole numbers and commas alone"),
        ("0,0,25\n0,5,0,6\n", "line 1, 0,0,25, has whole numbers and commas alone"),
    ],
)
def test_a_file_that_holds_none_is_refused_by_its_line(
    tmp_path: Path, text: str, words: str
) -> None:
    file = tmp_path / "spectrum.txt"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=words):
        read_table(file)


def test_what_is_no_text_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="No such file"):
        read_table(tmp_path / "gone.txt")
    with pytest.raises(InputError, match="null byte"):
        read_table(Path("a\0b"))
    for size, words in ((10_000_000, "no rows"), (10_000_001, "too large for a spectrum")):
        (tmp_path / "long").write_text("#" * size, encoding="utf-8")
        with pytest.raises(InputError, match=words):
            read_table(tmp_path / "long")
    (tmp_path / "bytes").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="byte 1 is not UTF-8"):
        read_table(tmp_path / "bytes")
