"""Colours of the page: those of plots and reports, as JSON and CSS variables."""

from dataclasses import asdict
from typing import Any

from rocksteady.show.style import palette
from rocksteady.show.style.line_colours import DARK, LIGHT, Inks


def theme_colours() -> dict[str, Any]:
    """Return the colours of the page on light and dark paper, for `draw/theme.mjs`.

    Examples
    --------
    >>> colours = theme_colours()
    >>> colours["dark"]["subharmonicLines"][0], colours["fills"]["rest"]
    ('#58a088', '#fcfaf3')
    """
    return {
        "light": _colours(LIGHT, palette.LINK, palette.GROUND),
        "dark": _colours(DARK, DARK.lines[0], DARK.grid),
        "fills": {
            "rest": palette.REST,
            "symmetric": palette.SYMMETRIC,
            "unsymmetric": palette.UNSYMMETRIC,
            "subharmonic": palette.SUBHARMONIC,
            "aperiodic": palette.APERIODIC,
            "rocking": palette.ROCKING,
            "overturned": palette.OVERTURNED,
            "undecided": palette.UNDECIDED,
        },
        # Of the patterns on the fills.
        "marks": {"light": palette.REST, "dark": palette.NUMBER},
    }


def style_variables() -> str:
    """Return the CSS variables of the light and the dark theme."""
    light = _variables(LIGHT, palette.REST, palette.LINK, "light")
    dark = _variables(DARK, palette.tinted(DARK.grid, -0.6), DARK.lines[0], "dark")
    return (
        f":root {{ {light} }}\n"
        f"@media (prefers-color-scheme: dark) {{ :root {{ {dark} }} }}\n"
        f':root[data-look="light"] {{ {light} }}\n'
        f':root[data-look="dark"] {{ {dark} }}\n'
    )


def _variables(inks: Inks, page: str, link: str, scheme: str) -> str:
    """Return the declarations of one theme; `page` lies beneath the papers of the panels."""
    colours = {
        "page": page,
        "paper": inks.paper,
        "ink": inks.ink,
        "number": inks.number,
        "line": inks.grid,
        "edge": inks.faint,
        "link": link,
        "impact": inks.impact,
    }
    declared = [f"--{name}: {colour};" for name, colour in colours.items()]
    return " ".join([f"color-scheme: {scheme};", *declared])


def _colours(inks: Inks, link: str, ground: str) -> dict[str, Any]:
    """Return the colours of what stands on one paper."""
    colours = asdict(inks)
    del colours["dark"]
    colours["subharmonicLines"] = colours.pop("subharmonic_lines")
    return {**colours, "link": link, "block": palette.BLOCK, "ground": ground}
