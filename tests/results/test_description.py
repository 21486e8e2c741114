"""Descriptions: one content, from which text, HTML, JSON and rows are made."""

import math
from dataclasses import dataclass

import pytest

from rocksteady.errors import ModelError
from rocksteady.results.description import Column, Description, Fact, Table, shown
from rocksteady.results.rendering import as_html, as_text
from rocksteady.results.result import Result
from tests.every import every

ROWS = [{"order": n, "peak": n / 7.0, "stable": n % 2 == 0, "hidden": "<b>"} for n in range(40)]
WHOLE = Description(
    headline="a thing & its <state>",
    facts=(
        Fact("status", "overturned", "status"),
        Fact("time_s", 3.20712, "overturns at", "3.21 s"),
        Fact("seed", 7),
        Fact("", None, "remark", "seen by people alone"),
        Fact("nothing", None, "unknown"),
    ),
    tables=(
        Table("rows", ROWS, (Column("order", "n"), Column("peak", "peak"), Column("stable", "?"))),
        Table("raw", [{"a": 1}]),
    ),
    notes=("It falls.",),
)


@dataclass(frozen=True, repr=False)
class Thing(Result):
    """A result."""

    def describe(self) -> Description:
        """Return the whole."""
        return WHOLE


def test_json_has_every_key_and_every_row_and_no_label() -> None:
    values = Thing().to_dict()
    assert values == {
        "status": "overturned",
        "time_s": 3.20712,
        "seed": 7,
        "nothing": None,
        "rows": ROWS,
        "raw": [{"a": 1}],
    }


def test_text_has_what_people_read_in_80_columns() -> None:
    text = Thing().summary()
    for words in ("a thing & its <state>", "3.21 s", "seen by people alone", "It falls.", "—"):
        assert words in text
    for words in ("3.20712", "seed", "hidden", "raw"):
        assert words not in text
    assert max(map(len, text.splitlines())) <= 80


def test_text_is_returned_and_plain_in_a_notebook_and_where_colours_are_forced(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    text = Thing().summary()
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setattr("rich.console._is_jupyter", lambda: True)  # what rich asks in a kernel
    assert Thing().summary() == text != ""


def test_no_name_of_others_controls_a_terminal_or_ends_a_line() -> None:
    name = "a\nb\x1b[2J\u202e"
    table = Table("rows", [{"name": name}], (Column("name", name),), title=name)
    text = as_text(Description(name, [Fact("file", name, name)], [table], [f"of {name[2:]}"]))
    shown_name = r"a\nb\x1b[2J\u202e"
    assert text.splitlines() == [
        shown_name,
        f"{shown_name}  {shown_name}",
        *[shown_name] * 3,
        f"of {shown_name[3:]}",
    ]


def test_no_name_of_others_controls_a_page() -> None:
    name = "a\nb\x1b[2J\u202e"
    table = Table("rows", [{"name": name}], (Column("name", name),), title=name)
    page = as_html(Description(name, [Fact("file", name, name)], [table], [f"of {name[2:]}"]))
    assert page.count(r"a\nb\x1b[2J\u202e") == 6
    assert r"<p>of b\x1b[2J\u202e</p>" in page
    assert not {"\n", "\x1b", "\u202e"} & set(page)


def test_html_has_what_text_has_and_escapes_it() -> None:
    page = Thing()._repr_html_()
    assert "a thing &amp; its &lt;state&gt;" in page
    assert "<state>" not in page
    assert page.count("<tr>") == 4 + 1 + 24
    assert page == as_html(WHOLE)


def test_a_long_table_shows_its_first_rows_and_says_how_many_are_left_out() -> None:
    table = WHOLE.tables[0]
    assert table.shown == ROWS[: table.most] == ROWS[:24]
    assert "16 more rows in the file and in JSON" in as_text(WHOLE)
    assert list(table.records()) == [list(row.values()) for row in ROWS]
    assert Table("rows", ROWS[:24]).remark == ""


def test_a_long_table_shows_the_worst_first_and_counts_the_others_by_kind() -> None:
    def table(rows: list[dict[str, int]], most: int) -> Table:
        return Table(
            "rows",
            rows,
            most=most,
            severity=lambda row: row["level"] // 10,
            kind=lambda row: "red" if row["level"] >= 70 else "green",
            alarm="red",
        )

    rows = [{"level": 37 * n % 101} for n in range(101)]  # 0 to 100 in a mixed order
    for count, most in ((101, 40), (101, 5), (60, 3), (9, 8), (9, 9)):
        part = rows[:count]
        reds = sum(row["level"] >= 70 for row in part)
        shown = table(part, most).shown
        expected = sorted(part, key=lambda row: -(row["level"] // 10))  # ties keep their order
        length = min(count, max(most, min(reds, 20)))
        assert shown == (expected if length < count else part)[:length]
        left = [row["level"] >= 70 for row in expected[length:]]
        words = table(part, most).remark
        if not left:
            assert words == ""
            continue
        kinds = (f"{n} {word}" for n, word in ((sum(left), "red"), (left.count(False), "green")))
        listed = ", ".join(each for each in kinds if not each.startswith("0 "))
        plural = "row" if len(left) == 1 else "rows"
        assert words == f"{len(left)} more {plural} in the file and in JSON: {listed}"


def test_the_header_has_each_key_once_and_a_row_without_it_has_nothing() -> None:
    table = Table("rows", [{"a": 1}, {"b": 2, "a": 3}])
    assert table.header == ["a", "b"]
    assert list(table.records()) == [[1, None], [3, 2]]


def test_repr_is_one_line() -> None:
    assert repr(Thing()) == "<Thing: a thing & its <state>>"


def test_a_result_without_a_picture_names_those_with_one() -> None:
    with pytest.raises(ModelError) as refused:
        Thing().plot()
    assert str(refused.value).startswith("plot has no picture of a Thing: ")
    for kind in ("Basins", "Trajectory", "attractor map"):
        assert kind in refused.value.valid


@every(
    ("value", "words"),
    [
        (None, "—"),
        (math.nan, "—"),
        (math.inf, "infinite"),
        (True, "yes"),
        (False, "no"),
        (12345, "12,345"),
        (0.123456, "0.123"),
        ([1, 2.5], "1, 2.5"),
        ("as it is", "as it is"),
    ],
)
def test_plain_values_as_people_read_them(value: object, words: str) -> None:
    assert shown(value) == words


def test_what_a_description_does_not_have_is_not_rendered() -> None:
    bare = Description("nothing else")
    assert as_text(bare) == "nothing else"
    assert bare.to_dict() == {}
    assert "<table" not in as_html(bare)


def test_a_table_that_is_too_wide_wraps_words_and_keeps_every_number() -> None:
    rows = [{"place": 12345678, "words": "a symmetry breaking " * 3, "more": "motions " * 9}]
    columns = (
        Column("place", "n"),
        Column("words", "kind", str, left=True),
        Column("more", "what it is", str, left=True),
        Column("place", "again"),
    )
    text = as_text(Description(headline="wide", facts=(), tables=(Table("rows", rows, columns),)))
    assert text.count("12,345,678") == 2
    assert "…" not in text
    assert text.count("symmetry") == 3
    assert max(map(len, text.splitlines())) <= 80


def test_a_summary_is_the_same_text_in_a_notebook_and_with_forced_colours(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    shown = Thing().summary()
    assert shown
    # Rich asks this to find out whether it runs in Jupyter, where it would print into the page.
    monkeypatch.setattr("rich.console._is_jupyter", lambda: True)
    monkeypatch.setenv("FORCE_COLOR", "1")
    assert Thing().summary() == shown
