"""The colours of the page: those of plots, legible on the papers of the page."""

import re

import pytest

from rocksteady.dynamics.maps.cell_classes import CellClass
from rocksteady.explorer._palette import style_variables, theme_colours
from rocksteady.show.plots.map_classes import LOOKS
from rocksteady.show.style.line_colours import DARK, LIGHT, Inks

TEXTS = ("ink", "number", "link", "impact")
LINES = ("lines", "subharmonicLines", "impact", "base", "faint", "link")
FILLS = ("rest", "symmetric", "unsymmetric", "subharmonic", "aperiodic", "rocking", "overturned")


def luminance(colour: str) -> float:
    """Return the relative luminance, as WCAG 2.2 defines it."""
    parts = (int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5))
    linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: str, other: str) -> float:
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def test_contrast_is_that_of_its_definition() -> None:
    assert contrast("#ffffff", "#000000") == pytest.approx(21.0)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.005)


@pytest.mark.parametrize("look", ["light", "dark"])
def test_texts_and_lines_stand_out_from_their_paper(look: str) -> None:
    colours = theme_colours()[look]
    for name in TEXTS:
        assert contrast(colours[name], colours["paper"]) >= 4.5, name
    for name in LINES:
        found = colours[name]
        for colour in [found] if isinstance(found, str) else found:
            assert contrast(colour, colours["paper"]) >= 3.0, (name, colour)


@pytest.mark.parametrize("look", ["light", "dark"])
def test_texts_and_edges_of_the_page_stand_out_from_what_lies_beneath(look: str) -> None:
    (rule,) = re.findall(rf':root\[data-look="{look}"\] {{ (.*) }}', style_variables())
    colours = dict(re.findall(r"--(\w+): (#[0-9a-f]{6});", rule))
    for beneath in ("page", "paper"):
        for name in ("ink", "number", "link", "impact"):
            assert contrast(colours[name], colours[beneath]) >= 4.5, (name, beneath)
        assert contrast(colours["edge"], colours[beneath]) >= 3.0, beneath
    assert f"color-scheme: {look};" in rule


def test_marks_of_patterns_stand_out_from_their_fills() -> None:
    found = theme_colours()
    for name, mark in [("subharmonic", "light"), ("aperiodic", "light"), ("undecided", "dark")]:
        assert contrast(found["fills"][name], found["marks"][mark]) > 2.0, name


@pytest.mark.parametrize(("look", "inks"), [("light", LIGHT), ("dark", DARK)])
def test_colours_are_those_of_plots(look: str, inks: Inks) -> None:
    found = theme_colours()
    assert found[look]["lines"] == inks.lines
    assert found[look]["paper"] == inks.paper
    for name in FILLS:
        assert found["fills"][name] == LOOKS[CellClass[name.upper()]].fill
