"""Colours and words of the page: the roles of all pictures, as JSON and CSS variables."""

import re
from dataclasses import asdict
from typing import Any

from rocksteady.dynamics.maps.cell_classes import CellClass
from rocksteady.explorer._units import page_units
from rocksteady.show.plots.map_classes import LOOKS
from rocksteady.show.style.tokens import DARK, LIGHT, Inks


def page_theme() -> dict[str, Any]:
    """Return colours on both papers, words of classes and units, for `draw/theme.mjs`.

    Examples
    --------
    >>> theme = page_theme()
    >>> theme["dark"]["falls"] == DARK.falls, len(theme["light"]["riskRamp"])
    (True, 5)
    >>> theme["words"]["overturned"]
    'falls'
    """
    papers = {"light": _roles(LIGHT), "dark": _roles(DARK)}
    return papers | {"words": class_words(), "units": page_units()}


def class_words() -> dict[str, str]:
    """Return the words of each class of motion in pictures, by its name in the page.

    Examples
    --------
    >>> list(class_words().items())[:2]
    [('rest', 'comes to rest'), ('symmetric', 'symmetric')]
    """
    return {each.name.lower().replace("_", "-"): LOOKS[each].words for each in CellClass}


def style_variables() -> str:
    """Return the CSS variables of the light and the dark theme."""
    light, dark = _variables(LIGHT, "light"), _variables(DARK, "dark")
    return (
        f":root {{ {light} }}\n"
        f"@media (prefers-color-scheme: dark) {{ :root {{ {dark} }} }}\n"
        f':root[data-look="light"] {{ {light} }}\n'
        f':root[data-look="dark"] {{ {dark} }}\n'
    )


def _variables(inks: Inks, scheme: str) -> str:
    """Return the declarations of one theme."""
    colours = {name: colour for name, colour in asdict(inks).items() if isinstance(colour, str)}
    declared = [f"--{name.replace('_', '-')}: {colour};" for name, colour in colours.items()]
    return " ".join([f"color-scheme: {scheme};", *declared])


def _roles(inks: Inks) -> dict[str, Any]:
    """Return the roles of one theme, named as in JavaScript."""
    return {
        re.sub(r"_(\w)", lambda letter: letter[1].upper(), name): colour
        for name, colour in asdict(inks).items()
    }
