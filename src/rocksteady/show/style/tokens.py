"""Colours by role, the same on every surface: plots, films, reports, page, manual and terminal.

A colour is a word. Each role has one colour on light paper and one on dark paper, and one mark:
an area, a line, a dashed line, a dot, a tick or a band. What falls is an area near black with a
hatch; a probability of falling has the one ramp that nothing else has; limits are dashed ink.

Line colours of one picture differ by more than 12 in CIEDE2000 on either paper, for normal sight,
protanopia and deuteranopia: `tests/show/style/test_tokens.py` computes it.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, fields, replace
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes

DARKEST_PAPER = 0.18
"""Relative luminance of paper on which black and white text are equally legible."""
DOUBT = 0.2
"""Opacity of a band of doubt, in the colour of the role that it belongs to."""
STRONGEST, WEAKEST = 12.0, 4.5
"""Contrasts with the paper of the first and the last of several series."""
DASHED: Any = (0, (5.0, 2.5))
"""Dashes of limits, and of what is unstable."""
DOTTED: Any = (0, (1.0, 1.5))
"""Dashes of solutions that are no motion."""
HATCHES = {
    "falls": "////",
    "falls_negative": "\\\\\\\\",
    "undecided": "xxxx",
    "unsymmetric": "----",
    "subharmonic": "||||",
    "aperiodic": "....",
    "with_rests": "oo",
    "no_start": "++",
    "not_computed": "..",
}
"""Pattern over an area beside its colour; areas without one have a plain fill."""
MARKS = ("o", "s", "D", "^", "v", "P", "X", "p", "h", "*")
"""Markers in the order of their use, where several series of one role share a picture."""


def _role(light: str, dark: str, means: str) -> Any:
    """Return a field of `Inks`: its colours on light and dark paper, and what it means."""
    return field(default=light, metadata={"dark": dark, "means": means})


def _ramp(light: str, dark: str, means: str) -> Any:
    """Return a field of `Inks` for a ramp of five colours, from nothing to most."""
    metadata = {"dark": tuple(dark.split()), "means": means}
    return field(default=tuple(light.split()), metadata=metadata)


@dataclass(frozen=True, kw_only=True)
class Inks:
    """Colours of all roles on one paper; the defaults are those of light paper."""

    dark: bool = False
    page: str = _role("#faf9f6", "#141619", "ground of a page")
    paper: str = _role("#ffffff", "#1c1f23", "ground of a picture or a sheet")
    ink: str = _role("#1b1d21", "#eceef0", "text, and what may be touched")
    quiet: str = _role("#5a5e65", "#a9aeb5", "secondary text and tick labels")
    edge: str = _role("#81868e", "#7d838b", "outlines of controls and of areas")
    hair: str = _role("#dcdedf", "#343940", "grid, and rules that carry no meaning")
    soil: str = _role("#d8cfbc", "#2c2a22", "the ground under a block")
    rest: str = _role("#eef1f3", "#3b444e", "it rests")
    rocks: str = _role("#6fadd9", "#2f7fb4", "it rocks")
    falls: str = _role("#1b1d21", "#000000", "it falls")
    on_falls: str = _role("#ffffff", "#ffffff", "a label on what falls")
    on_rocks: str = _role("#0d1b26", "#000000", "a label on what rocks, and on kinds of motion")
    undecided: str = _role("#9a9da1", "#83878d", "not known, always crosshatched")
    symmetric: str = _role("#89c3ea", "#2f9ad0", "area: symmetric steady motion")
    unsymmetric: str = _role("#e8c832", "#e3b717", "area: unsymmetric steady motion")
    subharmonic: str = _role("#2d9773", "#037659", "area: subharmonic steady motion")
    aperiodic: str = _role("#7c3b7f", "#783993", "area: aperiodic motion")
    unsymmetric_line: str = _role("#8a6d00", "#e3b717", "line: unsymmetric steady motion")
    subharmonic_line: str = _role("#16785a", "#4fbf9a", "line: subharmonic steady motion")
    aperiodic_line: str = _role("#3b0959", "#9b5fe0", "dots: aperiodic motion")
    motion: str = _role("#0956b0", "#729cd3", "the block's own history and orbit")
    base: str = _role("#307d4f", "#85e39e", "what the base does")
    impact: str = _role("#be4d0b", "#de7139", "instants of impact")
    limit: str = _role("#1b1d21", "#eceef0", "criteria, boundaries, code values: dashed, named")
    observed: str = _role("#1b1d21", "#eceef0", "measured: a dot with its interval")
    verdict_red: str = _role("#b3261e", "#ff9d94", "a verdict: misses its target, with the word")
    verdict_amber: str = _role("#8a5700", "#f0b44c", "a verdict: near its target, with the word")
    verdict_green: str = _role("#1f6f3f", "#7fd6a2", "a verdict: meets its target, with the word")
    risk: str = _role("#9a1d62", "#ffa3c4", "line: probability of falling")
    risk_ramp: tuple[str, ...] = _ramp(
        "#fbf3f4 #ecb7c6 #d67e99 #a83d66 #631440",
        "#2a2125 #5f3345 #964767 #cf6f94 #f4bdd0",
        "area: probability of falling, in five steps of 20 %",
    )
    rocks_ramp: tuple[str, ...] = _ramp(
        "#eaf2f9 #b9d7ee #6fadd9 #2f7db8 #114a7d",
        "#26323d #2b536f #2f7fb4 #6cb1de #bfe0f5",
        "area: how far it rocks, and other quantities from nothing to most",
    )

    def series(self, role: str, count: int) -> list[str]:
        """Return lightness steps of the hue of a role, the strongest first.

        Series of one kind (sizes, restitutions, records) share a picture in them, each labelled at
        its end.

        Parameters
        ----------
        role
            Name of a colour, such as "motion".
        count
            Number of series.

        Examples
        --------
        >>> LIGHT.series("motion", 3)
        ['#06366e', '#0954ab', '#3b79c0']
        """
        colour: str = getattr(self, role)
        if count == 1:
            return [colour]
        steps = (WEAKEST / STRONGEST) ** (1.0 / (count - 1))
        return [_with_contrast(colour, STRONGEST * steps**k, self.paper) for k in range(count)]

    def risk_step(self, probability: float) -> str:
        """Return the colour of a probability of falling, in [0, 1], of equal steps of the ramp.

        Examples
        --------
        >>> LIGHT.risk_step(0.1), LIGHT.risk_step(1.0)
        ('#fbf3f4', '#631440')
        """
        steps = len(self.risk_ramp)
        return self.risk_ramp[min(int(steps * probability), steps - 1)]


LIGHT = Inks()
DARK = Inks(
    dark=True,
    **{each.name: each.metadata["dark"] for each in fields(Inks) if each.name != "dark"},
)
"""Colours on light and on dark paper."""


def meanings() -> Iterator[tuple[str, str]]:
    """Yield name and meaning of each role.

    Examples
    --------
    >>> dict(meanings())["falls"]
    'it falls'
    """
    return ((each.name, each.metadata["means"]) for each in fields(Inks) if each.metadata)


def inks_of(axes: "Axes") -> Inks:
    """Return the colours that are legible on the paper of given axes.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> inks_of(Figure().add_subplot()) == LIGHT
    True
    >>> inks_of(Figure(facecolor="black").add_subplot(facecolor="none")).dark
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


def mixed(colour: str, part: float) -> str:
    """Return a colour mixed with a part of white, or of black where the part is below 0."""
    end = 255 if part > 0.0 else 0
    channels = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    return "#" + "".join(f"{round(c + abs(part) * (end - c)):02x}" for c in channels)


def _with_contrast(colour: str, wanted: float, paper: str) -> str:
    """Return a colour mixed with white or black until it has a contrast with paper."""
    dark = luminance(paper) < DARKEST_PAPER
    low, high, part = -1.0, 1.0, 0.0
    for _ in range(12):
        if (contrast(mixed(colour, part), paper) < wanted) == dark:
            low = part
        else:
            high = part
        part = 0.5 * (low + high)
    return mixed(colour, part)


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


def contrast(first: str, second: str) -> float:
    """Return the contrast of two colours, from 1 to 21, as WCAG defines it.

    Examples
    --------
    >>> round(contrast("#ffffff", "#000000"), 6)
    21.0
    """
    low, high = sorted((luminance(first), luminance(second)))
    return (high + 0.05) / (low + 0.05)
