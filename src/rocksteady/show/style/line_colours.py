"""Colours of lines and text on a light or dark background."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from rocksteady.show.style import palette

if TYPE_CHECKING:
    from matplotlib.axes import Axes

DARKEST_PAPER = 0.18
"""Relative luminance of paper on which black and white text are equally legible."""


@dataclass(frozen=True, kw_only=True)
class Inks:
    """Colours of what is drawn on the paper itself; fills are the same on any.

    Attributes
    ----------
    dark
        Whether the paper is.
    paper
        Behind text that stands over a drawing, and inside hollow marks.
    ink, number, faint, grid
        Text and outlines, from the strongest to the faintest.
    lines, subharmonic_lines
        Line colours in the order of their use.
    sweeps
        Dots of an upward and a downward sweep.
    impact, base
        Impacts, and the motion of the base.
    """

    dark: bool
    paper: str
    ink: str
    number: str
    faint: str
    grid: str
    lines: tuple[str, ...]
    subharmonic_lines: tuple[str, ...]
    sweeps: tuple[str, str]
    impact: str
    base: str


LIGHT = Inks(
    dark=False,
    paper="#ffffff",
    ink=palette.INK,
    number=palette.NUMBER,
    faint=palette.FAINT,
    grid=palette.GRID,
    lines=palette.LINES,
    subharmonic_lines=palette.SUBHARMONIC_LINES,
    sweeps=palette.SWEEPS,
    impact=palette.IMPACT,
    base=palette.BASE,
)
DARK = Inks(
    dark=True,
    paper=palette.DARK_PAPER,
    ink=palette.DARK_INK,
    number=palette.DARK_NUMBER,
    faint=palette.DARK_FAINT,
    grid=palette.DARK_GRID,
    lines=palette.DARK_LINES,
    subharmonic_lines=palette.DARK_SUBHARMONIC_LINES,
    sweeps=palette.DARK_SWEEPS,
    impact=palette.DARK_IMPACT,
    base=palette.DARK_BASE,
)


def inks_of(axes: "Axes") -> Inks:
    """Return the inks that are legible on the paper of given axes.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> inks_of(Figure().add_subplot()) == LIGHT
    True
    >>> inks_of(Figure(facecolor="black").add_subplot(facecolor="none")) == DARK
    True
    """
    from matplotlib.colors import to_hex, to_rgba

    figure = axes.get_figure(root=True)
    assert figure is not None
    seen = [1.0, 1.0, 1.0]
    for patch in (figure.patch, axes.patch):
        *colour, opacity = to_rgba(patch.get_facecolor())
        opacity *= bool(patch.get_visible())
        seen = [opacity * c + (1.0 - opacity) * s for c, s in zip(colour, seen, strict=True)]
    paper = to_hex((seen[0], seen[1], seen[2]))
    return replace(DARK if luminance(paper) < DARKEST_PAPER else LIGHT, paper=paper)


def luminance(colour: str) -> float:
    """Return the relative luminance of a colour, as WCAG defines it.

    Examples
    --------
    >>> luminance("#ffffff"), luminance("#000000")
    (1.0, 0.0)
    """
    parts = [int(colour[k : k + 2], 16) / 255.0 for k in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
