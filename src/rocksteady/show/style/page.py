"""Page of a whole figure: its width, and the place of its legends."""

import re
import textwrap
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rocksteady.errors import InputError
from rocksteady.model.checks.validation import in_range
from rocksteady.show.style import palette
from rocksteady.show.style.escaping import literal
from rocksteady.show.style.legends import LegendPlace, checked_place, height_needed, settle

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

INCH = 25.4
UNITS = {"mm": 1.0, "cm": 10.0, "in": INCH}
NARROWEST, WIDEST = 60.0, 1000.0
"""Widths of a figure [mm]."""
SMALL = 110.0
"""Width [mm] below which text is smaller."""
SMALL_TEXT: dict[str, Any] = {
    "font.size": 8.0,
    "axes.titlesize": 8.0,
    "axes.labelsize": 8.0,
    "xtick.labelsize": 7.0,
    "ytick.labelsize": 7.0,
    "legend.fontsize": 7.0,
}
LEAST_TEXT = 6.5
"""Size of the smallest text [points]."""


@dataclass(frozen=True, kw_only=True)
class Page:
    """Width of a figure, and place of its legends.

    Attributes
    ----------
    width_mm
        Width [mm], from 60 to 1000, as 84 for a column of a journal; that of the figure by default.
    legend
        "inside" the axes, to their "right", "below" them or "none"; by default where there is room.

    Raises
    ------
    InputError
        If the width is outside its range, or there is no such place.

    Examples
    --------
    >>> Page(width_mm=84, legend="below")
    Page(width_mm=84.0, legend='below')
    """

    width_mm: float | None = None
    legend: LegendPlace | None = None

    def __post_init__(self) -> None:
        """Validate both."""
        if self.width_mm is not None:
            hint = "give millimetres, as 84 or 174"
            width = in_range("width_mm", self.width_mm, NARROWEST, WIDEST, "[]", hint=hint)
            object.__setattr__(self, "width_mm", width)
        object.__setattr__(self, "legend", checked_place(self.legend))

    def width(self, natural: float) -> float:
        """Return the width of a figure in inches, of which one has a natural width."""
        return natural if self.width_mm is None else self.width_mm / INCH

    @contextmanager
    def figure(
        self, width: float, height: float, title: str, *, stacked: float | None = None
    ) -> "Iterator[Figure]":
        """Make a figure inside a ``with`` block, at whose end its title and legends are placed.

        Parameters
        ----------
        width, height
            Natural size in inches.
        title
            Above the panels; shown as it is.
        stacked
            Height of panels one above the other, in parts of the width, where that is narrow.
        """
        import matplotlib as mpl
        from matplotlib.figure import Figure

        wide = self.width(width)
        if stacked is not None and self.stacks(width):
            high = stacked * wide
        else:
            high = min(height, max(height * wide / width, 0.72 * wide)) if wide < width else height
        small = wide * INCH < SMALL
        settings: Any = SMALL_TEXT if small else {}
        with palette.style(), mpl.rc_context(settings):
            figure = Figure(figsize=(wide, high))
            yield figure
            if title:
                _write_title(figure, title, 8.5 if small else 10.0)
            settle(figure)
            if self.width_mm is not None or self.legend is not None:
                _fit(figure)

    def panel(
        self,
        width: float,
        height: float,
        title: str,
        plot: Callable[..., Any],
        shown: Any,
        **options: Any,
    ) -> "Figure":
        """Return a figure of one panel, which a function plots with these options."""
        with self.figure(width, height, title) as figure:
            plot(shown, figure.add_subplot(), legend=self.legend, **options)
        return figure

    def stacks(self, natural: float) -> bool:
        """Return whether panels of a figure stand one above the other."""
        return self.width(natural) < 0.62 * natural


SCREEN = Page()
"""The default of every figure."""


def width_mm_of(text: str) -> float:
    """Return a width in millimetres from text with its unit: mm, cm or in.

    Raises
    ------
    InputError
        If it is no such text, or outside the range of a figure.

    Examples
    --------
    >>> width_mm_of("84mm"), width_mm_of("8.4 cm"), width_mm_of("3.5in")
    (84.0, 84.0, 88.9)
    """
    match = re.fullmatch(r"\s*([0-9]*\.?[0-9]+|[0-9]+\.)\s*(mm|cm|in)\s*", text)
    width = float(match[1]) * UNITS[match[2]] if match else 0.0
    if not NARROWEST <= width <= WIDEST:
        raise InputError(
            "--width",
            text,
            f"a width is a number with its unit (mm, cm or in), from {NARROWEST:g}mm to "
            f"{WIDEST:g}mm",
            "write 84mm for a column of a journal, 174mm for its page",
        )
    return round(width, 9)


def _write_title(figure: "Figure", title: str, size: float) -> None:
    """Write a title above the panels, in as many lines as it needs."""
    letters = max(20, len(title))
    text = figure.suptitle(literal(title), x=0.01, ha="left", fontsize=size)
    room = 0.99 * figure.bbox.x1
    for box in (legend.get_window_extent() for legend in figure.legends):
        if box.x0 > 0.5 * room and box.y1 > 0.9 * figure.bbox.y1:  # at the right of the title
            room = box.x0 - 6.0
    while letters > 20 and text.get_window_extent().x1 > room:
        letters -= 1
        text.set_text(literal(title, line=letters))


def _fit(figure: "Figure") -> None:
    """Make room for legends, and break labels that are longer than their axes."""
    import matplotlib as mpl

    figure.set_figheight(figure.get_figheight() + _legends_height(figure.axes))
    for axes in figure.axes:  # the same when it is saved under other settings
        axes.tick_params(labelsize=mpl.rcParams["xtick.labelsize"])
    figure.draw_without_rendering()
    boxes = [each.get_tightbbox() for each in figure.axes]
    over = max((box.x1 / figure.bbox.x1 - 1.0 for box in boxes if box), default=0.0)
    engine: Any = figure.get_layout_engine()
    if over > 0.0 and engine is not None:  # the layout lets the last label of an axis stick out
        engine.set(rect=(0.0, 0.0, 1.0 - over - 0.01, 1.0))
        figure.draw_without_rendering()
    for axes in figure.axes:
        for label, side in ((axes.xaxis.label, "width"), (axes.yaxis.label, "height")):
            _shorten(label, getattr(axes.bbox, side), side)
    for label, side in ((figure._supxlabel, "width"), (figure._supylabel, "height")):  # type: ignore[attr-defined]
        if label is not None:
            _shorten(label, getattr(figure.bbox, side), side)
    settle(figure)


def _legends_height(axes: "Sequence[Axes]") -> float:
    """Return the height that all legends need, in inches: the largest of each row."""
    rows: dict[float, float] = {}
    for each in axes:
        row = round(each.get_position().y0, 3)
        rows[row] = max(rows.get(row, 0.0), height_needed(each))
    return sum(rows.values())


def _shorten(label: Any, room: float, side: str) -> None:
    """Break a label in two lines, and make it smaller, where it is longer than its axes."""
    if getattr(label.get_window_extent(), side) <= room or not label.get_text():
        return
    words = label.get_text()
    if "  " in words:
        label.set_text(words.replace("  ", "\n", 1))
    elif "$" not in words:
        label.set_text(textwrap.fill(words, -(-len(words) * 3 // 5), break_long_words=False))
    while getattr(label.get_window_extent(), side) > room and label.get_fontsize() > LEAST_TEXT:
        label.set_fontsize(max(LEAST_TEXT, label.get_fontsize() - 0.5))
