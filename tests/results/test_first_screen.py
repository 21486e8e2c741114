"""Answers: at most eight lines, within 80 columns and within the console."""

import io
import re
import subprocess
from collections.abc import Callable, Sequence
from functools import partial

import pytest
from rich.cells import cell_len
from rich.console import Console

from rocksteady.cli.console.shell import quoted
from rocksteady.results.description import MOST_FACTS, Description, Fact, line
from rocksteady.results.rendering import (
    MOST_LINES,
    MOST_ROWS,
    WIDTH,
    print_answer,
    print_description,
)


def answer_of(
    sentence: str,
    facts: Sequence[tuple[str, str | Callable[[], str]]] = (),
    rows: Sequence[tuple[str, str]] = (),
    *,
    follow_up: str = "",
) -> Description:
    """Return a description with a first screen alone."""
    shown = [line(*fact) for fact in facts]
    return Description(sentence, shown, sentence=sentence, rows=rows, follow_up=follow_up)


def printed(answer: Description, width: int = 80) -> list[str]:
    """Return the lines of an answer on a console of some width."""
    stream = io.StringIO()
    print_answer(answer, Console(file=stream, width=width, soft_wrap=True, highlight=False))
    return stream.getvalue().splitlines()


FACTS = [("lifts at", "0.25 g"), ("friction needed", "0.324"), ("empty", "")]


def test_facts_stand_under_the_sentence_and_those_without_words_are_left_out() -> None:
    lines = printed(answer_of("It falls.", FACTS, follow_up="rocksteady overturn -W 3"))
    assert lines == [
        "It falls.",
        "  lifts at         0.25 g",
        "  friction needed  0.324",
        "next: rocksteady overturn -W 3",
    ]


def test_no_more_than_five_facts_are_shown() -> None:
    assert (
        len(printed(answer_of("It falls.", [("fact", str(i)) for i in range(9)]))) == 1 + MOST_FACTS
    )


def test_of_too_many_facts_what_was_given_is_left_out_first() -> None:
    facts = [("block", "0.5 x 2 m"), *((f"fact {i}", str(i)) for i in range(MOST_FACTS))]
    assert [label for label, _ in answer_of("It falls.", facts).screen] == [
        f"fact {i}" for i in range(MOST_FACTS)
    ]
    assert answer_of("It falls.", facts[:-1]).screen == facts[:-1]


def test_eight_lines_hold_the_first_facts_that_fit_whatever_the_console_has() -> None:
    long = "a reason of many words " * 6
    facts = [("first", long), ("second", long), ("third", long), ("fourth", "0.5 x")]
    command = "rocksteady overturn " + "--height-m 1.8 --width-m 0.4 " * 4
    answer = answer_of("It falls.", facts, follow_up=command.strip())
    lines = printed(answer)
    assert len(lines) <= MOST_LINES
    labels = [text.split()[0] for text in lines if re.match(r"  \w", text)]
    assert labels[:2] == ["first", "fourth"]
    for width in (40, 200):
        assert not any(re.search("second|third", text) for text in printed(answer, width))


def test_a_long_command_makes_way_for_a_fact() -> None:
    facts = [("first", "a reason of many words " * 6), ("scaled", "by up to 46.7 x: check these")]
    for count, stays in ((2, True), (12, False)):
        command = f"rocksteady fragility {'--levels 0.4,0.8,1.6 ' * count}".strip()
        lines = printed(answer_of("No answer yet.", facts, follow_up=command))
        assert any("46.7 x" in text for text in lines)
        assert any(text.startswith("next:") for text in lines) is stays
        assert len(lines) <= MOST_LINES


def test_rows_are_beside_the_eight_lines_and_at_most_twelve() -> None:
    rows = [(f"screen {i}", "passes") for i in range(20)]
    lines = printed(answer_of("It passes.", FACTS, rows))
    assert len(lines) == 1 + MOST_ROWS + 2


def test_words_that_are_computed_are_computed_once_and_only_where_they_are_printed() -> None:
    calls: list[int] = []

    def words() -> str:
        calls.append(1)
        return "0.5 x"

    answer = answer_of("It falls.", [("stands at", words), ("none", lambda: "")])
    assert repr(answer)
    assert not calls
    assert printed(answer) == ["It falls.", "  stands at        0.5 x"]
    assert len(calls) == 1


@pytest.mark.parametrize("width", [40, 59, 80, 200])
def test_no_line_is_longer_than_the_console_or_80_columns(width: int) -> None:
    words = "a reason of many words " * 8
    command = "rocksteady overturn " + "--height-m 1.8 --width-m 0.4 " * 4
    lines = printed(answer_of(words, [("label", words)], follow_up=command), width)
    assert max(map(len, lines)) <= min(width, 80)
    assert " ".join(lines).replace("\\ ", " ").split()[-4:] == command.split()[-4:]


def test_on_a_narrow_console_labels_stand_on_lines_of_their_own() -> None:
    assert printed(answer_of("It falls.", FACTS[:1]), 40) == [
        "It falls.",
        "  lifts at",
        "    0.25 g",
    ]


@pytest.mark.parametrize(
    "name",
    ["2009 - the main shock - EW.csv", "it's - 9.csv", "a\n -b.csv", "-c '-d -e.csv", '"'],
)
def test_a_command_that_follows_is_broken_outside_quotes_alone(name: str) -> None:
    words = ["--width-m", "0.5", "--record", name, name, "-A", "-0.5", "--height-m", "2"]
    command = " ".join(["rocksteady overturn", *map(quoted, words)])
    lines = printed(answer_of("It falls.", follow_up=command), 40)
    assert len(lines) > 2
    narrow = io.StringIO()
    print_answer(answer_of("It falls.", follow_up=command), Console(file=narrow, width=40))
    assert narrow.getvalue().splitlines() == lines, "with and without lines broken by the console"
    shown = "\n".join(lines[1:]).removeprefix("next: ")
    script = f'rocksteady() {{ shift; printf "%s|" "$@"; }}; {shown}'
    ran = subprocess.run(["bash", "-c", script], capture_output=True, check=True)
    assert ran.stdout.decode() == "".join(f"{word}|" for word in words)


@pytest.mark.parametrize("letter", ["x", "波", "e\u0301"])
@pytest.mark.parametrize("width", [40, 80])
def test_a_long_label_is_cut_in_the_middle_and_leaves_room(letter: str, width: int) -> None:
    label = f"begin {letter * 200} end"
    rows = [(label, "12 %, falls")]
    described = Description("One object.", [Fact(key="", label=label, value="falls")])
    for print_on in (
        partial(print_answer, answer_of("It falls.", [("lifts at", "0.25 g")], rows)),
        partial(print_description, described),
    ):
        stream = io.StringIO()
        print_on(Console(file=stream, width=width, soft_wrap=True))
        lines = stream.getvalue().splitlines()
        assert max(map(cell_len, lines)) <= WIDTH
        shown = " ".join(lines)
        assert "begin" in shown
        assert " end" in shown
        assert "falls" in shown
