"""What a person reads in a picture: each word of its legends and labels, with its mark."""

import re
from collections.abc import Iterator
from typing import Any, NamedTuple

from matplotlib.colors import to_hex, to_rgba
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.text import Text


class Seen(NamedTuple):
    """A word and what it stands for."""

    word: str
    """Without numbers and units, which are data."""
    mark: str
    """area, band, line, dashed, dot or text."""
    colour: str
    hatch: str = ""


def read_figure(figure: Figure) -> Iterator[Seen]:
    """Yield the entries of all legends of a figure, and its labels in a colour."""
    legends: list[Legend] = figure.findobj(Legend)
    for legend in legends:
        for handle, text in zip(legend.legend_handles, legend.get_texts(), strict=True):
            yield Seen(word_of(text.get_text()), *form_of(handle))
    for axes in figure.axes:
        for text in axes.texts:
            if text.get_visible() and text.get_text().strip():
                yield Seen(word_of(text.get_text()), "text", to_hex(text.get_color()))


def word_of(text: str) -> str:
    """Return a label without what is data in it: numbers, units, symbols.

    >>> word_of("falls  12.3 %"), word_of("17 impacts"), word_of("A = 2, n = 3")
    ('falls', 'impacts', '')
    """
    plain = re.sub(r"\$[^$]*\$", " ", text.replace("\xa0", " "))
    plain = re.sub(r"\b(un)?symmetric-([2-9]|\d\d)[a-z]*", "subharmonic", plain)
    plain = re.sub(r"(un?symmetric)-1[a-z]*", r"\1", plain)
    plain = re.sub(r"\b[A-Za-zδΩα]\w? ?[=<>≥≤].*", " ", plain)
    plain = re.sub(r"[<>≥≤±-]?\s?\d[\d.,e+−-]*", " ", plain)
    plain = re.sub(r"\b(g|Hz|m/s2?|m|s|mm|deg|rad)\b|[%°×()\[\]:;,]", " ", plain)
    plain = re.sub(r"\b(to|up to|at|and|of|β|α|period(?= *$)|[a-z]\b)(?=\s*$)", " ", plain)
    return " ".join(plain.split()).lower()


def form_of(handle: Any) -> tuple[str, str, str]:
    """Return mark, colour and hatch of an entry of a legend."""
    if hasattr(handle, "get_hatch") and hasattr(handle, "get_facecolor"):
        face = handle.get_facecolor()
        face = face[0] if getattr(face, "ndim", 1) == 2 and len(face) else face
        red, green, blue, opacity = to_rgba(face) if len(face) else (0.0, 0.0, 0.0, 0.0)
        hatch = "".join(sorted(set(handle.get_hatch() or "")))
        mark = "band" if 0.0 < opacity < 1.0 or handle.get_alpha() else "area"
        return mark, to_hex((red, green, blue)) if opacity else "none", hatch
    if hasattr(handle, "get_linestyle"):
        marker = getattr(handle, "get_marker", lambda: None)()
        dash = handle.get_linestyle()
        bare = dash in ("None", "none", " ", "")
        if bare and marker in (None, "None", "none", ""):  # a note in place of an entry
            return "text", "none", ""
        if bare:
            face = handle.get_markerfacecolor()
            hollow = isinstance(face, str) and face == "none"
            colour = handle.get_markeredgecolor() if hollow else face
            return "dot", to_hex(colour), f"{marker}{' hollow' if hollow else ''}"
        colour = handle.get_color()
        colour = colour[0] if hasattr(colour, "ndim") and colour.ndim == 2 else colour
        solid = dash in ("-", "solid") or (isinstance(dash, list) and dash[0][1] is None)
        return "line" if solid else "dashed", to_hex(colour), ""
    return type(handle).__name__, "none", ""


def texts_of(figure: Figure) -> list[Text]:
    """Return the texts of a figure that are seen."""
    found: list[Text] = figure.findobj(Text)
    return [text for text in found if text.get_visible() and text.get_text().strip()]
