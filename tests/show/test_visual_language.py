"""One visual language: a word has one look in all pictures, and a look has one meaning."""

import contextlib
import re
from collections import defaultdict
from collections.abc import Iterator
from functools import cache

import numpy as np
import pytest
from matplotlib.figure import Figure

import rocksteady as rs
from rocksteady.show.style.legends import figure_of
from rocksteady.show.style.page import Page
from rocksteady.show.style.tokens import LIGHT, meanings, mixed
from tests.public.calls import calls, close_pictures, room
from tests.show.all_pictures import figures
from tests.show.seen import Seen, read_figure

pytestmark = pytest.mark.slow

SERIES = ("motion", "base", "risk", "subharmonic_line")
KINDS = ("symmetric", "unsymmetric", "subharmonic", "aperiodic")
MEANS = {
    ("area", "falls"): "falls.*",
    ("area", "rest"): "comes to rest",
    ("area", "paper"): "stands|no such start|not computed|does not lift.*",
    ("area", "rocks"): "rocks",
    ("area", "undecided"): "undecided",
    ("area", "symmetric"): "symmetric( stable)?",
    ("area", "unsymmetric"): "unsymmetric",
    ("area", "subharmonic"): "subharmonic",
    ("area", "aperiodic"): "aperiodic",
    ("area", "risk_ramp"): "|predicted|to of runs fall",
    ("line", "base"): "hazard|horizontal|vertical|.* spectrum",
    ("line", "risk"): "probability of falling|",
    ("band", "risk"): "middle of the risk|rate of falling by intensity not to scale",
    ("dot", "impact"): "impacts?|after an impact",
    ("dot", "observed"): "fell|share .*|release|comes to rest|saddle.*|chosen|stable|falls to .*",
    ("line", "motion"): "capacity a d|mean|not identified|score band|stable manifold|integrity .*"
    "|global integrity .*|(positive|negative) kick|branch .*",
    ("text", "risk"): "|● falls|lognormal median|logistic median",
    ("text", "limit"): "(tipping angle|lifts off|as predicted|even chance"
    "|housner|fold|symmetry breaks|period doubles|doubles again)",
}
"""What an entry of a legend, or a label, says that has the mark and the colour of a role."""
OPEN = {("area", "paper"), ("line", "motion"), ("text", "limit"), ("dot", "observed")}
"""Looks that further words may have: steady motions by their names, ink that is plain text."""
SHAPES = {"to the positive side", "to the negative side", "stable", "unstable"}
"""Words that a marker says in any colour: triangles for sides, filled and hollow dots."""
NEVER = {
    "falls": ("area", "text", "dot", "line"),
    "rocks": ("area", "text"),
    "symmetric": ("area", "text", "line", "dot"),
}
"""Marks that a word may have; the line of a state that falls is one of its probability."""


@cache
def names() -> dict[str, set[str]]:
    """Return the roles that have a colour on light paper."""
    found: defaultdict[str, set[str]] = defaultdict(set)
    for name, _ in meanings():
        value = getattr(LIGHT, name)
        for colour in (value,) if isinstance(value, str) else value:
            found[colour].add(name)
    for name in SERIES:
        for count in range(2, 13):
            for colour in LIGHT.series(name, count):
                found[colour].add(name)
    for name in KINDS:  # several of one kind in a picture are steps of its lightness
        for part in range(-70, 71, 5):
            found[mixed(getattr(LIGHT, name), part / 100.0)].add(name)
    return dict(found)


def drawn() -> Iterator[tuple[str, Figure]]:
    """Yield every kind of figure by its name."""
    plane = {"amplitude": np.linspace(0.5, 5.0, 12), "frequency_ratio": np.linspace(1.0, 6.0, 12)}
    fates = rs.map_fates(rs.DimensionlessBlock(restitution=0.8), axes=plane, cycles=20)
    yield "fates", figure_of(rs.plots.outcomes(fates, Figure().add_subplot()))
    with contextlib.chdir(room()):
        for name, draw in figures().items():
            yield name, draw(page=Page())
        for label, call in calls().items():
            if call.function.__module__.startswith("rocksteady.show.plots"):
                yield label, call().figure
                close_pictures()


@cache
def seen() -> dict[Seen, set[str]]:
    """Return every entry of a legend and every label, with the pictures that have it."""
    found: defaultdict[Seen, set[str]] = defaultdict(set)
    for name, figure in drawn():
        for each in read_figure(figure):
            found[each].add(name)
    return dict(found)


def test_every_colour_with_a_name_is_that_of_a_role() -> None:
    strange = {each: where for each, where in seen().items() if each.colour not in names()}
    assert {each: where for each, where in strange.items() if each.colour != "none"} == {}


def test_a_word_has_one_look() -> None:
    looks: defaultdict[tuple[str, str], set[str]] = defaultdict(set)
    for each in seen():
        if re.search("[a-z]{3}", each.word) and each.mark != "text":
            role = "" if each.word in SHAPES else "/".join(sorted(names().get(each.colour, ())))
            look = each.hatch if role else ""
            if each.word.endswith((" stable", " unstable")):  # triangles for sides, else dots
                look = "hollow" if "hollow" in look else "filled"
            looks[each.word, each.mark].add(f"{role} {look}")
    many = {word: found for word, found in looks.items() if len(found) > 1}
    assert many == {}


def test_a_look_has_one_meaning() -> None:
    wrong = []
    for each, where in seen().items():
        for name in names().get(each.colour, ()):
            words = None if (each.mark, name) in OPEN else MEANS.get((each.mark, name))
            # Near black is text, limits and what falls, which has a hatch.
            if words is None or (name == "falls" and not each.hatch):
                continue
            others = (MEANS.get((each.mark, other)) for other in names()[each.colour])
            if not any(other and re.fullmatch(other, each.word) for other in others):
                wrong.append((each, where))
    assert wrong == []


def test_a_word_that_means_a_role_has_its_colour() -> None:
    wrong = []
    for each, where in seen().items():
        roles = {
            role
            for (mark, role), words in MEANS.items()
            if mark == each.mark and each.word and re.fullmatch(words, each.word)
        }
        if roles and not roles & names().get(each.colour, set()):
            wrong.append((each, roles, where))
    assert wrong == []


def test_a_word_has_the_marks_that_it_may_have() -> None:
    for each, where in seen().items():
        for word, marks in NEVER.items():
            if each.word == word:
                assert each.mark in marks, (each, where)
            if each.word == word and each.mark == "area":
                assert word in names()[each.colour], (each, where)
    assert not [each for each in seen() if re.search("overturn|still rocking|at rest", each.word)]
