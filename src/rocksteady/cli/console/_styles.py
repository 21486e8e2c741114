"""Styles of the terminal by role, in one table.

A terminal has a light or a dark paper, which no program can ask for.  So the roles of
`rocksteady.show.style.tokens` become weight and named colours there, of which the terminal itself
chooses legible ones: what falls is ink and bold, what rests is dim, what is undecided is grey.
Red, amber and green are for a verdict against a target alone, and always beside its word.
"""

import os
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from rich.theme import Theme

STYLES: Final = {
    "sentence": "bold",
    "label": "dim",
    "note": "dim",
    "next": "underline",
    "falls": "bold",
    "rest": "dim",
    "undecided": "grey50",
    "green": "green",
    "amber": "yellow",
    "red": "red",
}
"""Style of each role, as `rocksteady.results.rendering` names them."""

PARTS: Final = {
    "table.header": "dim",
    "bar.back": "dim",
    "bar.complete": "default",
    "bar.finished": "default",
    "bar.pulse": "default",
    "progress.elapsed": "dim",
    "progress.remaining": "dim",
    "progress.download": "default",
}
"""Styles of tables and progress bars, in place of the hues that rich has for them."""

HELP: Final = {
    "STYLE_OPTION": "bold",
    "STYLE_SWITCH": "bold",
    "STYLE_NEGATIVE_OPTION": "bold",
    "STYLE_NEGATIVE_SWITCH": "bold",
    "STYLE_TYPES": "dim",
    "STYLE_USAGE": "dim",
    "STYLE_REQUIRED_SHORT": "bold",
    "STYLE_REQUIRED_LONG": "bold",
    "STYLE_OPTION_ENVVAR": "dim",
    "STYLE_COMMANDS_TABLE_FIRST_COLUMN": "bold",
}
"""Styles of --help-all, in place of the hues that typer has for it."""


def styled() -> dict[str, Any]:
    """Return the arguments that give a console its styles, or none of them.

    There are none where NO_COLOR is set; rich itself leaves them out of what is no terminal, and
    where TERM is dumb.
    """
    return {"theme": theme(), "color_system": None if os.environ.get("NO_COLOR") else "auto"}


def theme() -> "Theme":
    """Return the styles as a theme of rich."""
    from rich.theme import Theme

    return Theme(STYLES | PARTS)


def style_help() -> None:
    """Apply these styles to the help pages of typer."""
    from typer import rich_utils

    for name, style in HELP.items():
        setattr(rich_utils, name, style)
    if os.environ.get("NO_COLOR"):
        rich_utils.COLOR_SYSTEM = None
