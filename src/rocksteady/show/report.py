"""Self-contained HTML reports, for screen and print."""

import re
from base64 import b64encode
from collections.abc import Callable
from typing import TYPE_CHECKING

from rocksteady.show.export.files import figure_bytes
from rocksteady.show.style import palette
from rocksteady.show.style.page import SCREEN, Page
from rocksteady.show.style.tokens import DARK, LIGHT, Inks
from rocksteady.show.style.wording import minus

if TYPE_CHECKING:
    from jinja2 import Environment
    from markupsafe import Markup
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

WIDTH = 7.2
"""Of a figure across the page [inches]."""
PHONE = Page(width_mm=105.0)

ROLES = (
    *("page", "paper", "ink", "quiet", "edge", "hair"),
    *("verdict_red", "verdict_amber", "verdict_green"),
)
"""Colours of a page, each of which is a CSS property."""

FINER = re.compile(rb"(?<!scale\()(\b\d+\.\d\d)\d{2,}")
"""Digits of places in a drawing below a hundredth of a point, a tenth of its bytes."""
UNSEEN = re.compile(rb"<metadata>.*?</metadata>\s*|<!--.*?-->\s*", re.DOTALL)
"""What is not drawn."""

INDEXED = re.compile(r"\b([dT])_(SLV|SLC|C)\b|\b([SaCxz])_([eDgChd])\b")
"""Symbols of codes with an index."""

RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def render(package: str, template: str, **values: object) -> str:
    """Return a report as the text of one HTML file.

    Parameters
    ----------
    package
        The package whose folder holds the template.
    template
        Its file. It begins with ``{% extends "house/base.html.j2" %}`` and fills that page's
        blocks; its neighbours are ``own/<file>``.
    **values
        What it shows. Text is escaped: none of it is read as markup.

    Returns
    -------
    str
        The same for the same values.

    Raises
    ------
    jinja2.TemplateNotFound
        If the package holds no such template.
    jinja2.UndefinedError
        If the template names a value that is not given.
    """
    text: str = _environment(package).get_template(f"own/{template}").render(values)
    return text


def svg_data_uri(svg: bytes) -> str:
    """Return an SVG as the address of an ``<img>`` that carries the picture itself.

    Each picture is a document of its own that way, so that the names of the parts of one SVG never
    meet those of another.
    """
    return f"data:image/svg+xml;base64,{b64encode(svg).decode('ascii')}"


def picture(
    draw: "Callable[[Axes], object]",
    height: float,
    words: str,
    *,
    phone: bool = True,
    rows: bool = False,
    page: Page = SCREEN,
) -> dict[str, str]:
    """Return a picture on light and on dark paper, drawn again for a phone or not, with its words.

    Parameters
    ----------
    draw
        Draws on the axes that it is given.
    height
        Height of the figure [inches].
    words
        What it shows, for those who do not see it.
    phone
        Whether it is drawn with larger letters for a phone too; default True.
    rows
        Whether it has rows of bars, and is as high on a phone; default False.
    page
        Width and legend where there is room; default the width of the page.
    """

    def make(page: Page) -> "Figure":
        stacked = height / page.width(WIDTH) if rows else None
        with page.figure(WIDTH, height, "", stacked=stacked) as figure:
            draw(figure.add_subplot())
        return figure

    return twins(make, words, page=page, phone=phone)


def twins(
    make: "Callable[[Page], Figure]", words: str, *, page: Page = SCREEN, phone: bool = True
) -> dict[str, str]:
    """Return the addresses of a figure on light and dark paper, for a page and for a phone.

    Parameters
    ----------
    make
        Makes the figure for a page.
    words
        What it shows, for those who do not see it.
    page, phone
        As for `picture`.
    """
    sources = {"alt": words}
    for inks, end in ((LIGHT, ""), (DARK, "_dark")):
        with palette.on_paper(inks):
            sources[f"source{end}"] = picture_address(make(page))
            sources[f"narrow{end}"] = (
                picture_address(make(PHONE)) if phone else sources[f"source{end}"]
            )
    return sources


def picture_address(figure: "Figure") -> str:
    """Return the address of a figure without its paper, which carries the figure itself."""
    svg = figure_bytes(figure, "svg", transparent=True)
    return svg_data_uri(FINER.sub(rb"\1", UNSEEN.sub(b"", svg)))


def properties(inks: Inks) -> str:
    """Return the colours of a page on a paper, as CSS properties.

    Examples
    --------
    >>> properties(LIGHT).startswith(f"--page: {LIGHT.page}; ")
    True
    """
    parts = (f"--{role.replace('_', '-')}: {getattr(inks, role)}" for role in ROLES)
    return "; ".join(parts) + ";"


def prose(text: str) -> str:
    r"""Return a plain text as one would print it: powers of ten, minus signs, no breaks in numbers.

    Examples
    --------
    >>> prose("from -0.5 to 3.2e-16, 10^28-fold")
    'from −0.5 to 3.2·10⁻¹⁶, 10²⁸-fold'
    >>> prose("3 of 66 at A = 2").split(" ")  # no line breaks inside a count, or an equation
    ['3\xa0of\xa066', 'at', 'A\xa0=\xa02']
    """
    text = re.sub(r"(?<=\d)e([+-]?\d+)\b", lambda match: f"·10^{int(match[1])}", text)
    text = re.sub(r"(?<![\d.])1·10\^", "10^", text)
    text = re.sub(r"\b10\^(-?\d+)", lambda match: "10" + match[1].translate(RAISED), text)
    text = re.sub(r"(?<=\d) (?=%)", "\N{NO-BREAK SPACE}", minus(text))
    text = re.sub(r"(?<=\d) of (?=\d)", "\N{NO-BREAK SPACE}of\N{NO-BREAK SPACE}", text)
    return re.sub(r"(?<=\S) ([=<>≤≥≈]) (?=\S)", "\N{NO-BREAK SPACE}\\1\N{NO-BREAK SPACE}", text)


def indexed(text: str) -> "Markup":
    """Return a text as markup, escaped, with the indices of symbols of codes lowered.

    Examples
    --------
    >>> str(indexed("T_SLV <= 2 s, a_g, T_C*"))
    'T<sub>SLV</sub> &lt;= 2 s, a<sub>g</sub>, T<sub>C</sub>*'
    """
    from markupsafe import Markup, escape

    lowered = INDEXED.sub(_lowered, str(escape(text)))
    # Few fonts of pages have the letter, and others draw it like an o.
    return Markup(lowered.replace("\N{SUBSCRIPT ZERO}", "<sub>0</sub>"))


def _lowered(match: "re.Match[str]") -> str:
    """Return a symbol with its index lowered."""
    letter, index = [each for each in match.groups() if each]
    return f"{letter}<sub>{index}</sub>"


def anchor(text: str) -> str:
    """Return a text as a part of an ``id`` and of the link to it.

    Examples
    --------
    >>> anchor("figure 3a"), anchor("E1")
    ('figure-3a', 'E1')
    """
    return re.sub(r"[^A-Za-z0-9.]+", "-", text).strip("-")


def duration(seconds: float) -> str:
    """Return a time in words.

    Examples
    --------
    >>> duration(0.0123), duration(1.26), duration(42.4), duration(187.0)
    ('12 ms', '1.3 s', '42 s', '3 min 7 s')
    """
    if seconds < 0.0005:
        return "under 1 ms"
    if seconds < 0.9995:
        return f"{1000.0 * seconds:.0f} ms"
    if seconds < 9.95:
        return f"{seconds:.1f} s"
    if seconds < 59.5:
        return f"{seconds:.0f} s"
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if rest else f"{minutes} min"


def _environment(package: str) -> "Environment":
    """Return the house's way of filling templates: all is escaped, and nothing may be missing."""
    from jinja2 import Environment, PackageLoader, PrefixLoader, StrictUndefined

    # Two prefixes instead of one search path: a report cannot hide the base template by accident.
    loaders = {
        "house": PackageLoader("rocksteady.show", "templates"),
        "own": PackageLoader(package, "."),
    }
    environment = Environment(
        loader=PrefixLoader(loaders),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters |= {"anchor": anchor, "duration": duration}
    environment.filters |= {"indexed": indexed, "prose": prose}
    environment.globals |= {"light": LIGHT, "dark": DARK, "properties": properties}
    environment.globals |= {"sections": []}
    return environment
