"""The colours of the manual are those of the tokens, and what may be touched has none."""

import re
from dataclasses import fields
from pathlib import Path
from typing import Any

from rocksteady.show.style.tokens import DARK, LIGHT, Inks, contrast
from tests.every import every
from tools.manual import theme

DOCS = Path(__file__).parents[2] / "docs"
HEX = re.compile(r"#(?:[0-9a-fA-F]{8}|[0-9a-fA-F]{6}|[0-9a-fA-F]{3,4})\b")


def colours(inks: Inks) -> set[str]:
    """Return all colours of the tokens on a paper."""
    found: set[str] = set()
    for each in fields(inks):
        value = getattr(inks, each.name)
        if not isinstance(value, bool):
            found |= {value} if isinstance(value, str) else set(value)
    return found


@every("file", [DOCS / "conf.py", *sorted((DOCS / "_static").glob("*.css"))])
def test_no_file_of_the_theme_has_a_colour_of_its_own(file: Path) -> None:
    text = file.read_text(encoding="utf-8")
    assert not [each for each in HEX.findall(text) if len(each) != 4 or not each.isalpha()]
    assert not re.findall(r"\b(?:rgba?|hsla?)\(", text)


def test_the_logo_has_colours_of_the_tokens() -> None:
    found = set(HEX.findall((DOCS / "_static" / "logo.svg").read_text(encoding="utf-8")))
    assert found
    assert found <= colours(LIGHT)


@every("inks", [LIGHT, DARK])
def test_the_variables_are_tokens_and_text_and_links_are_ink(inks: Inks) -> None:
    variables = theme.variables(inks)
    assert set(variables.values()) <= {*colours(inks), LIGHT.page, "transparent"}
    for name in ("color-link", "color-brand-primary", "sd-color-primary"):
        assert variables[name] == inks.ink
    for text in ("color-foreground-primary", "color-foreground-secondary"):
        for ground in ("color-background-primary", "color-background-secondary"):
            assert contrast(variables[text], variables[ground]) > 4.5
    assert contrast(variables["color-link-underline"], variables["color-background-primary"]) > 3


@every(("style", "inks"), [(theme.LightCode, LIGHT), (theme.DarkCode, DARK)])
def test_code_has_no_hue_and_is_legible(style: Any, inks: Inks) -> None:
    used = {f"#{look['color']}" for _, look in style if look["color"]}
    assert used == {inks.ink, inks.quiet}
    assert min(contrast(each, style.background_color) for each in used) > 4.5


@every("page", sorted(DOCS.rglob("*.md")))
def test_no_page_has_a_colour_of_its_own(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    assert not re.findall(r"""["'](#[0-9a-fA-F]{6})["']""", text)
