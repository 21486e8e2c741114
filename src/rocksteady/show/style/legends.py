"""Placement of legends: inside the axes, to their right, below them, or none."""

import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, get_args

from rocksteady.errors import InputError
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.legend import Legend

LegendPlace = Literal["inside", "right", "below", "none"]
PLACES: tuple[LegendPlace, ...] = get_args(LegendPlace)

WIDE = 290.0
"""Width of axes [points] from which on a legend stands to their right by default."""
SMALL = 300.0
"""Width of a figure [points] below which its text is smaller."""
GAP = 6.0
"""Between axes and a legend outside of them [points]."""
LETTER = 0.56
"""Width of a letter in parts of its size, on average."""
HANGING = "below the axes"
"""Label of a legend that `settle` moves when the labels of its axes have changed."""
BESIDE = "beside the axes"
"""Label of a legend to the right of its axes."""


def checked_place(legend: object) -> LegendPlace | None:
    """Return the place of a legend, or None for the default one.

    Raises
    ------
    InputError
        If there is no such place.
    """
    for place in PLACES:
        if isinstance(legend, str) and legend == place:
            return place
    if legend is None:
        return None
    raise InputError(
        "legend",
        legend,
        "a legend is one of " + ", ".join(PLACES),
        "leave it out for the default place",
    )


def place_of(
    axes: "Axes", legend: object, default: LegendPlace, *, width: float = 0.0
) -> LegendPlace:
    """Return where the legend of axes goes: below them by default where they are narrow.

    Parameters
    ----------
    axes
        Axes of the legend.
    legend
        A place, or None for the default.
    default
        Default place for axes that are wide enough.
    width
        Width of a legend inside [points], if it is a wide one.

    Raises
    ------
    InputError
        If there is no such place.
    """
    chosen = checked_place(legend)
    if chosen is not None:
        return chosen
    axes_width = size_of(axes)[0]
    narrow = axes_width < WIDE if default == "right" else axes_width < 1.2 * width
    return "below" if narrow and default != "none" else default


def figure_of(axes: "Axes") -> "Figure":
    """Return the figure of axes."""
    figure = axes.get_figure(root=True)
    assert figure is not None
    return figure


def size_of(axes: "Axes") -> tuple[float, float]:
    """Return width and height of axes [points], before any layout."""
    box, inches = axes.get_position(), figure_of(axes).get_size_inches()
    return 72.0 * box.width * float(inches[0]), 72.0 * box.height * float(inches[1])


def text_size(axes: "Axes", usual: float) -> float:
    """Return the size of small text on axes [points]: smaller in a narrow figure."""
    return usual if 72.0 * figure_of(axes).get_figwidth() >= SMALL else max(6.5, usual - 1.0)


def line_scale(axes: "Axes") -> float:
    """Return the factor of widths of lines and sizes of marks: smaller in a narrow figure."""
    return text_size(axes, 10.0) / 10.0 - (0.15 if text_size(axes, 10.0) < 10.0 else 0.0)


def draw_legend(
    axes: "Axes",
    place: LegendPlace,
    *,
    handles: "Sequence[Any] | None" = None,
    labels: Sequence[str] | None = None,
    corner: str = "best",
    columns: int = 1,
    title: str = "",
    gap: float = GAP,
    within: bool = False,
    **style: Any,
) -> "Legend | None":
    """Draw the legend of axes at a place, and return it.

    Parameters
    ----------
    axes
        With their labels and limits.
    place
        From `place_of`.
    handles, labels
        Its entries; those of the axes by default.
    corner, columns
        Corner and number of columns of a legend inside.
    title
        Above the entries.
    gap
        Between the axes and a legend to their right [points].
    within
        Whether a legend below is no wider than the axes, to whose right something else stands.
    style
        Further settings of `matplotlib.axes.Axes.legend`.
    """
    if handles is None:
        handles, labels = axes.get_legend_handles_labels()
    if labels is None:
        labels = [str(handle.get_label()) for handle in handles]
    if place == "none" or not handles:
        present = axes.get_legend()
        if present is not None:
            present.remove()
        return None
    inks, size = inks_of(axes), text_size(axes, 8.0)
    figure = figure_of(axes)
    whole = 72.0 * figure.get_figwidth()
    if _shares_row(axes):
        whole = min(whole, size_of(axes)[0] / 0.78)
    # Of a narrow picture the legend leaves the larger part to the axes.
    room = {"inside": 0.8 * size_of(axes)[0], "right": 0.42 * whole, "below": 0.78 * whole}[place]
    letters = max(12, int((room - 4.0 * size) / (LETTER * size)))
    given: dict[str, Any] = {
        "handles": list(handles),
        "labels": [_broken(label, letters) for label in labels],
        "fontsize": size,
        "labelcolor": inks.ink,
        "title": _broken(title, letters) or None,
        "title_fontsize": size,
        "frameon": place == "inside",
        "facecolor": inks.paper,
        "edgecolor": "none",
        "framealpha": 0.85,
        **style,
    }
    made: Any = axes.legend  # whose type has the places as literals
    legend: Legend
    if place == "inside":
        legend = made(loc=corner, ncols=columns, borderaxespad=0.3, columnspacing=1.4, **given)
        legend.set_zorder(6.0)
    elif place == "right":
        from matplotlib.transforms import ScaledTranslation

        across = ScaledTranslation(gap / 72.0, 0.0, figure.dpi_scale_trans)
        legend = made(loc="upper left", borderaxespad=0.0, **given)
        legend.set_bbox_to_anchor((1.0, 1.0), axes.transAxes + across)
        legend.set_label(BESIDE)
    else:
        legend = _below(axes, given, within=within)
    legend.get_title().set_color(inks.ink)
    if place in ("right", "below") and figure.get_layout_engine() is None:
        _make_room(axes, legend, figure)
    return legend


def settle(figure: "Figure") -> None:
    """Hang the legends below axes again, after the labels of these have changed."""
    for axes in figure.axes:
        legend = axes.get_legend()
        if legend is not None and legend.get_label() == HANGING:
            _hang(axes, legend)


def height_needed(axes: "Axes") -> float:
    """Return by how much a figure must grow for the legend of axes, in inches.

    A legend below adds its height; one beside, what it is higher than its axes.
    """
    legend = axes.get_legend()
    figure = figure_of(axes)
    if legend is None or legend.get_label() not in (HANGING, BESIDE):
        return 0.0
    high = legend.get_window_extent().height / figure.dpi
    return high if legend.get_label() == HANGING else max(0.0, high - size_of(axes)[1] / 90.0)


def _shares_row(axes: "Axes") -> bool:
    """Return whether other axes stand beside given ones."""
    spec = axes.get_subplotspec()
    return spec is not None and len(spec.colspan) < spec.get_gridspec().ncols


def _below(axes: "Axes", given: dict[str, Any], *, within: bool = False) -> "Legend":
    """Draw a legend below axes, in as many columns as fit."""
    figure = figure_of(axes)
    count = len(given["handles"])
    room = 0.94 * figure.bbox.width - axes.bbox.x0
    room = axes.bbox.width if within or _shares_row(axes) else max(axes.bbox.width, room)
    made: Any = axes.legend
    columns = min(count, 4)
    while True:
        legend: Legend = made(
            loc="upper left", ncols=columns, borderaxespad=0.0, columnspacing=1.2, **given
        )
        if columns == 1 or legend.get_window_extent().width <= room:
            break
        columns -= 1
    legend.set_label(HANGING)
    _hang(axes, legend)
    return legend


def _hang(axes: "Axes", legend: "Legend") -> None:
    """Put a legend beneath the labels of the abscissa."""
    from matplotlib.transforms import ScaledTranslation

    figure = figure_of(axes)
    labels = axes.xaxis.get_tightbbox()
    drop = 0.0 if labels is None else max(0.0, axes.bbox.y0 - labels.y0)
    down = ScaledTranslation(0.0, -drop / figure.dpi - GAP / 72.0, figure.dpi_scale_trans)
    legend.set_bbox_to_anchor((0.0, 0.0), axes.transAxes + down)


def _make_room(axes: "Axes", legend: "Legend", figure: "Figure") -> None:
    """Shrink axes of a figure without a layout until their legend fits into the figure."""
    extent, whole, box = legend.get_window_extent(), figure.bbox, axes.get_position()
    pad = 0.01
    right = max(0.0, extent.x1 / whole.width - 1.0 + pad)
    down = max(0.0, pad - extent.y0 / whole.height)
    if right or down:
        width, height = max(0.1, box.width - right), max(0.1, box.height - down)
        axes.set_position((box.x0, box.y1 - height, width, height))
        axes.set_in_layout(True)  # a layout that the user applies later moves them again


def _broken(label: str, letters: int) -> str:
    """Return a label in lines; mathematics stays whole."""
    if len(label) <= letters or "$" in label:
        return label
    together = label.replace(" %", "\N{NO-BREAK SPACE}%")
    return textwrap.fill(together, letters, break_long_words=True)
