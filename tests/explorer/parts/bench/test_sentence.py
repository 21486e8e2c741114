"""Sentences of the laboratory: one number each, and true where they advise."""

import re
from typing import Any

from tests.every import every
from tests.explorer.in_node import InNode

SAID = """
const { shakenSentence } = await import(parts('bench/sentence.mjs'));
answer(asked.map(([run, given, windows]) => shakenSentence(run, given, windows)));
"""
RUN: dict[str, Any] = {
    "fate": 1,
    "kind": "symmetric",
    "period": 1,
    "lean": 0.1,
    "lies": None,
    "impacts": 0,
}
WINDOWS = [
    {"low": 0.4415, "high": 0.9819, "impacts": 1, "side": -1},
    {"low": 0.98195, "high": 1.0, "impacts": 2, "side": 1},
    {"low": 1.154, "high": 9.0, "impacts": 0, "side": 1},
]


def said(in_node: InNode, run: dict[str, Any], g: float, *, push: bool) -> tuple[str, str]:
    """Return the sentence and the facts on a run."""
    asked = {"push": push, "g": g, "lift": 0.25, "alpha": 0.245}
    whole: dict[str, Any] = {**RUN, **run}
    (found,) = in_node(SAID, [[whole, asked, WINDOWS if push else []]])
    return "".join(found["words"]), found["facts"]


@every(
    ("run", "g", "push", "sentence", "facts"),
    [
        ({"fate": 0}, 0.2, True, "It never lifts: to lift it takes 0.25 g.", ""),
        ({"fate": 0}, 0.2, False, "It never lifts: to lift it takes 0.25 g.", ""),
        (
            {}, 0.4, False,
            "It rocks with the shaking, and leans 5.7° at most.", "it tips past 14.0°",
        ),
        (
            {"kind": "unsymmetric", "period": 2}, 0.4, False,
            "It rocks, alike every second shake, and leans 5.7° at most.", "it tips past 14.0°",
        ),
        (
            {"kind": "rocking", "period": None}, 0.4, False,
            "It rocks, and leans 5.7° at most.", "it tips past 14.0°",
        ),
        (
            {"fate": 2, "lies": 2.34}, 0.4, False,
            "It falls after 2.3 s.", "at once, without an impact",
        ),
        (
            {"fate": 2, "lies": 2.34, "impacts": 3}, 0.4, False,
            "It falls after 2.3 s.", "after 3 impacts",
        ),
        ({}, 0.4, True, "It rocks, leans 5.7°, and stands.", "it tips past 14.0°"),
        ({}, 1.05, True, "It stands: safer than a push of 1.00 g.", "it leans 5.7° of 14.0°"),
        (
            {"fate": 2, "lies": 1.0}, 2.0, True,
            "It falls at once; at 1.15 g it would stand.", "it lies after 1.0 s",
        ),
        (
            {"fate": 3, "lies": 1.0}, 0.99, True,
            "It falls after an impact; at 0.44 g it would stand.", "it lies after 1.0 s",
        ),
        ({"fate": 4}, 0.9, True, "What becomes of it is not decided.", ""),
    ],
)  # fmt: skip
def test_a_run_is_one_sentence_with_one_number(
    run: dict[str, Any], g: float, push: bool, sentence: str, facts: str, in_node: InNode
) -> None:
    assert said(in_node, run, g, push=push) == (sentence, facts)
    assert len(re.findall(r"\d+(?:\.\d+)?", sentence)) <= 1


def test_advice_lies_outside_every_window_and_a_warning_inside_one(in_node: InNode) -> None:
    for g in (0.45, 0.7, 0.98, 0.995, 1.16, 3.0):
        (value,) = re.findall(r"at ([\d.]+) g", said(in_node, {"fate": 3}, g, push=True)[0])
        assert float(value) < g
        assert not any(each["low"] <= float(value) <= each["high"] for each in WINDOWS)
    narrow = [{"low": 0.50012, "high": 0.50019, "impacts": 1, "side": 1}]
    asked = {"push": True, "g": 0.6, "lift": 0.25, "alpha": 0.245}
    (found,) = in_node(SAID, [[RUN, asked, narrow]])
    assert 0.50012 <= float(found["words"][1].removesuffix(" g")) <= 0.50019


OTHERS = """
const { releasedSentence, sizeSentence } = await import(parts('bench/sentence.mjs'));
const words = ({ words }) => words.join('');
answer(asked.map(([what, run, given, further]) => words(
  what === 'size' ? sizeSentence(run, further, given) : releasedSentence(run, given, further))));
"""
SIZE = {"push": True, "lift": 0.3, "alpha": 0.29, "width": 0.6}
START = {"alpha": 0.29, "shaken": True}


@every(
    ("what", "run", "given", "further", "sentence"),
    [
        ("size", {}, SIZE, None, "It stands."),
        (
            "size", {}, SIZE, {"falls": False, "turns": 0.56, "last": None},
            "It stands; 4 cm narrower it falls.",
        ),
        (
            "size", {"fate": 3}, SIZE, {"falls": True, "turns": 0.91, "last": None},
            "It falls; 31 cm wider it stands.",
        ),
        (
            "size", {"fate": 0}, SIZE, {"falls": False, "turns": None, "last": 0.05},
            "It never lifts, narrower too, down to 0.05 m.",
        ),
        (
            "size", {"fate": 2}, SIZE, {"falls": True, "turns": None, "last": 1.8},
            "It falls, wider too, up to 1.80 m.",
        ),
        ("size", {}, SIZE, {"falls": False, "turns": None, "last": None}, "It stands."),
        ("size", {"fate": 4}, SIZE, None, "What becomes of it is not decided."),
        (
            "start", {"rock": 1.376}, {**START, "shaken": False}, None,
            "The first rock takes 1.38 s.",
        ),
        ("start", {"fate": 0, "kind": "rest"}, START, None, "From here it comes to rest."),
        (
            "start", {"fate": 2, "kind": "overturned"}, START, {"falls": 57, "cells": 100},
            "From here it falls; 57 % of the starts on this map fall.",
        ),
        (
            "start", {"fate": 4, "kind": "undecided"}, START, {"falls": 0, "cells": 100},
            "What becomes of it is not decided; none of the starts on this map fall.",
        ),
    ],
)  # fmt: skip
def test_sentences_on_sizes_and_on_starts(
    what: str, run: dict[str, Any], given: Any, further: Any, sentence: str, in_node: InNode
) -> None:
    assert in_node(OTHERS, [[what, {**RUN, **run}, given, further]]) == [sentence]
