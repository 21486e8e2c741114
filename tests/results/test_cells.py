"""Cells of CSV files: no text is a formula, and every text comes back."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.results.cells import read_cell, written_cell
from rocksteady.risk.observations.files.csv_table import Columns, read_csv_table
from rocksteady.show.export.files import save_csv
from tests.every import every

FORMULAS = ("=1+1", "+1+1", "-1+2", "@SUM(A1)", " =1", "\t=1", "\r=1", '=HYPERLINK("http://x")')
PLAIN = ("-1.5", "+2e3", "-inf", "-", "+", "a", "'a", "", "0.5", "tests = 3")


@pytest.mark.slow
@given(st.text(alphabet="'=+-@\t\r a1.") | st.text())
def test_every_text_comes_back(text: str) -> None:
    assert read_cell(written_cell(text)) == text


@every("text", FORMULAS)
def test_a_formula_is_a_text_to_a_spreadsheet(text: str) -> None:
    assert written_cell(text) == f"'{text}"


def test_numbers_and_plain_texts_stay() -> None:
    assert [written_cell(text) for text in PLAIN] == list(PLAIN)
    for value in (-1.5, np.float64(-2.0), None, True, -3):
        assert written_cell(value) is value


def test_a_table_is_read_back_with_its_formulas_and_numbers(tmp_path: Path) -> None:
    texts = [text.strip() for text in FORMULAS]  # of a cell the reader takes off the spaces
    file = tmp_path / "a.csv"
    save_csv("--csv", file, ["name", "=value"], [[text, -1.5] for text in texts])
    columns = Columns(things="tests", known=("name",), needed={}, example="name")
    table = read_csv_table(file, columns, name="tests", hint="name another")
    assert table.header == ("name", "=value")
    assert [cells for _, cells in table.rows] == [(text, "-1.5") for text in texts]
    lines = file.read_text(encoding="utf-8").replace('"', "").splitlines()
    assert not [line for line in lines if line.startswith(("=", "+", "-", "@", "\t", "\r"))]
