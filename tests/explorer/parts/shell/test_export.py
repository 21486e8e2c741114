"""Files that the page makes: tables as CSV, and their names."""

import csv
import io
import math
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.explorer.in_node import InNode

IMPORTS = "const { csvOf, fileName } = await import(parts('shell/export.mjs'));\n"
ONCE = settings(
    deadline=None, max_examples=4, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
letters = st.characters(exclude_categories=["Cs"])
texts = st.text(letters, max_size=12).filter(lambda text: "\0" not in text)
cells = st.one_of(texts, st.floats(allow_nan=False, allow_infinity=False))
tables = st.integers(1, 5).flatmap(
    lambda wide: st.fixed_dictionaries(
        {
            "columns": st.lists(texts, min_size=wide, max_size=wide),
            "rows": st.lists(st.lists(cells, min_size=wide, max_size=wide), max_size=30),
        }
    )
)


def read(text: str) -> list[list[str]]:
    return list(csv.reader(io.StringIO(text, newline=""), strict=True))


def same(cell: str, value: object) -> bool:
    if isinstance(value, str):
        return cell in (value, f"'{value}")
    return float(cell) == value


@given(table=tables)
@ONCE
def test_a_table_is_read_back_to_the_last_bit(table: dict[str, Any], in_node: InNode) -> None:
    head, *rows = read(in_node(IMPORTS + "answer(csvOf(asked));", table))
    # A reader has no cell in an empty line: a single empty column cannot be told from that.
    assert all(same(*pair) for pair in zip(head, table["columns"], strict=len(head) > 0))
    assert len(rows) == len(table["rows"])
    for found, row in zip(rows, table["rows"], strict=True):
        assert all(same(*pair) for pair in zip(found, row, strict=len(found) > 0))


FORMULAS = ["=1+1", "+1", "-1+2", "@SUM(A1)", " =1", "\t=1", "\r=1", '=HYPERLINK("http://x","y")']


@pytest.mark.parametrize("text", FORMULAS)
def test_text_is_no_formula_of_a_spreadsheet(text: str, in_node: InNode) -> None:
    table = {"columns": [text], "rows": [[text], ["safe"], [-1.5]]}
    found = [row[0] for row in read(in_node(IMPORTS + "answer(csvOf(asked));", table))]
    assert found == [f"'{text}", f"'{text}", "safe", "-1.5"]


def test_lines_end_as_rfc_4180_has_them_and_nan_is_empty(in_node: InNode) -> None:
    lines = "answer(csvOf({ columns: ['a', 'b'], rows: [[NaN, 'x \"y\", z'], [null, true]] }));"
    assert in_node(IMPORTS + lines) == 'a,b\r\n,"x ""y"", z"\r\n,true\r\n'


@pytest.mark.parametrize(
    ("panel", "a", "w", "name"),
    [
        ("map", 2, 3, "rocksteady-map-A2-W3.png"),
        ("history", 1 / 3, math.pi, "rocksteady-history-A0.333333-W3.14159.png"),
        ("a/../b c", 1000, 0.01, "rocksteady-a-b-c-A1000-W0.01.png"),
    ],
)
def test_names_of_files_hold_the_point(
    panel: str, a: float, w: float, name: str, in_node: InNode
) -> None:
    lines = "answer(fileName(asked.panel, asked, 'png'));"
    assert in_node(IMPORTS + lines, {"panel": panel, "A": a, "W": w}) == name
