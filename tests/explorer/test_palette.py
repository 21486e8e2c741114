"""The colours and words of the page: the roles of all pictures."""

import re
from dataclasses import fields

import pytest

from rocksteady.dynamics.maps.cell_classes import CellClass
from rocksteady.explorer._page import SHEETS
from rocksteady.explorer._palette import page_theme, style_variables
from rocksteady.explorer._program import PARTS
from rocksteady.outcomes import Status
from rocksteady.show.style.tokens import DARK, LIGHT, Inks, contrast

BOTH = pytest.mark.parametrize(("look", "inks"), [("light", LIGHT), ("dark", DARK)])
OF_THE_PEN = {"draw/svg.mjs"}
"""Modules whose colours are what a canvas begins with."""


def sheets() -> str:
    return "".join((PARTS / name).read_text("utf-8") for name in SHEETS)


@BOTH
def test_roles_are_those_of_pictures(look: str, inks: Inks) -> None:
    found = page_theme()[look]
    assert len(found) == len(fields(Inks))
    assert found["falls"] == inks.falls
    assert found["riskRamp"] == inks.risk_ramp
    assert found["aperiodicLine"] == inks.aperiodic_line
    assert found["dark"] == inks.dark


@BOTH
def test_variables_of_the_style_are_roles(look: str, inks: Inks) -> None:
    (rule,) = re.findall(rf':root\[data-look="{look}"\] {{ (.*) }}', style_variables())
    declared = dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6});", rule))
    assert declared == {
        each.name.replace("_", "-"): getattr(inks, each.name)
        for each in fields(Inks)
        if isinstance(getattr(inks, each.name), str)
    }
    used = set(re.findall(r"var\(--([\w-]+)\)", sheets()))
    assert used
    assert used <= set(declared)
    assert f"color-scheme: {look};" in rule


@BOTH
def test_texts_and_edges_stand_out_from_what_lies_beneath(look: str, inks: Inks) -> None:
    colours = page_theme()[look]
    for beneath in ("page", "paper"):
        for name in ("ink", "quiet", "motion", "base", "impact"):
            least = 3.0 if name == "impact" else 4.5
            assert contrast(colours[name], colours[beneath]) >= least, (name, beneath)
        assert contrast(inks.edge, colours[beneath]) >= 3.0, beneath


def test_what_may_be_touched_has_no_hue() -> None:
    rules = re.findall(r"([^{}]+)\{([^{}]+)\}", sheets())
    hues = {"rocks", "motion", "base", "impact", "risk", "symmetric"}
    for selector, declarations in rules:
        if re.search(r"button|tab|:focus|input|select|summary", selector):
            assert not hues & set(re.findall(r"var\(--([\w-]+)\)", declarations)), selector


def test_no_part_of_the_page_holds_a_colour() -> None:
    checked = 0
    for path in PARTS.rglob("*.*"):
        if path.suffix not in {".mjs", ".css", ".html"}:
            continue
        if path.relative_to(PARTS).as_posix() in OF_THE_PEN:
            continue
        checked += 1
        assert not re.findall(r"#[0-9a-fA-F]{6}\b", path.read_text("utf-8")), path.name
    assert checked > 50


def test_words_of_classes_are_the_plain_ones_of_outcomes() -> None:
    words = page_theme()["words"]
    assert list(words) == [one.name.lower().replace("_", "-") for one in CellClass]
    assert words["rest"] == Status.AT_REST.plain == "comes to rest"
    assert words["overturned"] == Status.OVERTURNED.plain == "falls"
    assert words["rocking"] == Status.ROCKING.plain == "rocks"
    assert words["undecided"] == Status.UNDECIDED.plain
    assert words["not-computed"] == "not computed"
