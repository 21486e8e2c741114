"""The look of the manual: colours of its theme and of its code, from the tokens.

What may be touched has no hue: links, buttons and marks are ink. Code has none either: its words
differ by weight and slant, so that a hue on a page always means what it means in a picture.
"""

from pygments.style import Style  # type: ignore[import-untyped]
from pygments.token import (  # type: ignore[import-untyped]
    Comment,
    Generic,
    Keyword,
    Name,
    Operator,
    String,
    Text,
    Token,
)

from rocksteady.show.style.tokens import DARK, LIGHT, Inks

ADMONITIONS = (
    *("caution", "warning", "danger", "attention", "error", "hint", "tip", "important", "note"),
    *("seealso", "admonition-todo"),
)
BUTTONS = ("primary", "secondary", "success", "info", "warning", "danger", "muted", "dark")
"""Colours of sphinx-design."""


def variables(inks: Inks) -> dict[str, str]:
    """Return the CSS variables of the theme and of its extensions, without their hyphens.

    Examples
    --------
    >>> variables(LIGHT)["color-link"] == LIGHT.ink
    True
    """
    titles = ["", *(f"--{name}" for name in ADMONITIONS)]
    roles = {
        "ink": [
            *("color-foreground-primary", "color-brand-primary", "color-brand-content"),
            *("color-brand-visited", "color-link", "color-link--hover", "color-link--visited"),
            *("color-link--visited--hover", "color-link-underline--hover"),
            *("color-link-underline--visited--hover", "color-api-name", "color-api-pre-name"),
            *("color-problematic", "color-topic-title", "color-announcement-background"),
            *(f"color-admonition-title{title}" for title in titles),
            *(f"sd-color-{button}" for button in BUTTONS),
            *("sd-color-tabs-label-active", "sd-color-tabs-underline-active"),
            *("sd-color-tabs-label-hover", "sd-color-card-border-hover"),
            *("sg-text-color", "sg-tooltip-foreground", "sg-thumb-hover-border"),
            *("sg-pytb-foreground", "sg-download-a-color"),
        ],
        "quiet": [
            *("color-foreground-secondary", "color-foreground-muted", "color-api-overall"),
            *("color-link-underline", "color-link-underline--visited", "color-api-keyword"),
            *("sd-color-tabs-label-inactive", "sd-color-tabs-underline-hover", "sg-script-out"),
            *(f"color-api-{what}" for what in ("added", "changed", "deprecated", "removed")),
        ],
        "edge": [
            *("color-foreground-border", "mystnb-source-margin-color"),
            *("mystnb-traceback-border-color", "sg-pytb-border-color"),
            *(f"color-api-{what}-border" for what in ("added", "changed", "deprecated", "removed")),
        ],
        "hair": [
            *("color-background-border", "color-background-item", "color-background-hover"),
            *("color-highlighted-background", "color-highlight-on-target", "color-card-border"),
            *("color-guilabel-background", "color-guilabel-border", "color-topic-title-background"),
            *(f"color-admonition-title-background{title}" for title in titles),
            *(f"sd-color-{button}-bg" for button in BUTTONS),
            *("sd-color-card-border", "sd-color-tabs-overline", "sd-color-tabs-underline"),
            *("mystnb-source-border-color", "mystnb-stdout-border-color"),
            *("mystnb-stderr-border-color", "sg-thumb-box-shadow-color", "sg-tr-hover-color"),
        ],
        "page": [
            *("color-background-primary", "sg-background-color", "color-announcement-text"),
            *(f"sd-color-{button}-text" for button in BUTTONS),
        ],
        "paper": [
            *("color-background-secondary", "color-code-background", "color-admonition-background"),
            *("color-card-background", "color-card-marginals-background", "sg-tr-odd-color"),
            *("mystnb-source-bg-color", "mystnb-stdout-bg-color", "mystnb-stderr-bg-color"),
            *("mystnb-traceback-bg-color", "sg-script-pre", "sg-pytb-background"),
            *("sg-code-background-color", "sg-tooltip-background"),
        ],
    }
    found = {name: getattr(inks, role) for role, names in roles.items() for name in names}
    shades = {f"sd-color-{button}-highlight": inks.quiet for button in BUTTONS}
    cards = {"color-background-hover--transparent": "transparent", "picture-card": LIGHT.page}
    return found | shades | cards


def _styles(inks: Inks) -> dict[object, str]:
    """Return how words of code look on a paper."""
    return {
        Token: inks.ink,
        Text: inks.ink,
        Comment: f"italic {inks.quiet}",
        Keyword: "bold",
        Operator.Word: "bold",
        Name.Class: "bold",
        Name.Function: "bold",
        Name.Tag: "bold",
        String: inks.quiet,
        Generic.Heading: "bold",
        Generic.Output: inks.quiet,
        Generic.Prompt: inks.quiet,
        Generic.Emph: "italic",
        Generic.Strong: "bold",
    }


class LightCode(Style):  # type: ignore[misc]
    """Code on light paper."""

    background_color = LIGHT.paper
    highlight_color = LIGHT.hair
    styles = _styles(LIGHT)


class DarkCode(Style):  # type: ignore[misc]
    """Code on dark paper."""

    background_color = DARK.paper
    highlight_color = DARK.hair
    styles = _styles(DARK)
