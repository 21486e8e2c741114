"""Plot of the floors of buildings with the objects on them, in the colours of their risk."""

from collections import defaultdict
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from rocksteady.errors import InputError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.risk.assess.described.objects import floor_number
from rocksteady.risk.assess.objects_table import ObjectsTable
from rocksteady.show.plots.risk._words import FALLING
from rocksteady.show.plots.risk.objects import NARROW
from rocksteady.show.style import palette
from rocksteady.show.style.areas import risk_swatches
from rocksteady.show.style.escaping import literal
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import LETTER, draw_legend, figure_of, size_of, text_size
from rocksteady.show.style.tokens import inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TALLEST = 0.5
"""Height of the tallest object over the distance of two floors."""
TURNED = ((8, 20.0), (14, 45.0))
"""Largest number of objects on a floor, and the angle of their names [°] where they do not fit
beside each other; beyond there are none."""
LETTERS = 12
"""Of a name."""
MARKED = 1.6
"""Width of the outline of what is above its target [points]."""
BELOW, ABOVE = 0.55, 0.6
"""Room below the lowest floor and above the highest, over the same."""


def floors_of(table: ObjectsTable) -> list[tuple[str, list[Mapping[str, Any]]]]:
    """Return the floors with an object, the lowest first, and their objects, the worst first."""
    floors: dict[tuple[str, int, str], list[Mapping[str, Any]]] = defaultdict(list)
    for row in table.worst:
        storey, room = row["storey"], str(row["floor"] or "").strip()
        where = f"floor {storey}" if storey else "ground"
        named = where if floor_number(room) is not None else f"{where}, {room}"
        building = row["building"] or ""
        floors[building, storey, named].append(row)
    several = len({building for building, _, _ in floors}) > 1
    return [
        (f"{building}: {name}" if several and building else name, rows)
        for (building, _, name), rows in sorted(floors.items())
    ]


@checked
def plot_plan(table: ObjectsTable, ax: "Axes | None" = None) -> "Axes":
    """Draw each floor with its objects in proportion, coloured by its share of runs that fall.

    The worst stands on the left, and what is above its target has a heavy outline.  Names stand
    below where no floor has more than 14 objects.  An object without a share is crosshatched.

    Parameters
    ----------
    table
        From `rocksteady.assess_objects` with `buildings`.
    ax
        Axes to draw on; default: axes of a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: a row for each floor, the ground at the bottom.

    Raises
    ------
    InputError
        If no object stands on a floor of a building.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import assess_objects
    >>> from rocksteady.motions import make_synthetic_suite
    >>> from rocksteady.risk import Building, DescribedObject, Peaks
    >>> house = Building.of_first_mode("house", storeys=2, period_s=0.3)
    >>> vase = DescribedObject(
    ...     values={"name": "vase", "floor": 2, "geometry": {"width_m": 0.12, "height_m": 0.5}}
    ... )
    >>> demand = Peaks(pga_g=0.2)
    >>> table = assess_objects([vase], make_synthetic_suite(11), buildings=[house], demand=demand)
    >>> axes = plot_plan(table, Figure().add_subplot())
    >>> [name.get_text() for name in axes.get_yticklabels()]
    ['floor 2']
    """
    from matplotlib.patches import Patch, Rectangle

    if not any(row["storey"] for row in table.rows):
        raise InputError(
            "table",
            Words("has no object on a floor"),
            "a plan shows the floors of buildings",
            "give floors and buildings to assess_objects, or draw rs.plots.objects",
        )
    axes = axes_or_new(ax)
    inks, small = inks_of(axes), text_size(axes, 6.5)
    floors = floors_of(table)
    sizes = {id(row): _size(row) for row in table.rows}
    most = max(len(rows) for _, rows in floors)
    step = 1.0 / most
    wide, high = size_of(axes)
    shape = high / wide / (len(floors) - 1 + BELOW + ABOVE)  # a unit across over one upwards
    up = min(
        TALLEST / max(height for _, height in sizes.values()),
        0.9 * step / shape / max(width for width, _ in sizes.values()),
    )
    across = up * shape
    names = {id(row): literal(palette.shortened(row["name"], LETTERS)) for row in table.rows}
    letters = max(map(len, names.values()))
    fits = letters * LETTER * small <= step * wide
    turn = 0.0 if fits else next((angle for count, angle in TURNED if most <= count), None)
    for place, (_, rows) in enumerate(floors):
        axes.plot([0.0, 1.0], [place, place], color=inks.edge, lw=1.0, zorder=1)
        for at, row in enumerate(rows):
            width, height = sizes[id(row)]
            middle, share = (at + 0.5) * step, row["share"]
            above = row["verdict"] == "red"
            axes.add_patch(
                Rectangle(
                    (middle - 0.5 * across * width, place),
                    across * width,
                    up * height,
                    facecolor=inks.undecided if share is None else inks.risk_step(share),
                    hatch="xxxx" if share is None else None,
                    edgecolor=inks.ink if above else inks.edge,
                    lw=MARKED if above else 0.6,
                    zorder=2,
                )
            )
            if turn is None:
                continue
            axes.text(
                middle,
                place - 0.04,
                names[id(row)],
                rotation=turn,
                ha="right" if turn else "center",
                va="top",
                rotation_mode="anchor",
                size=small,
                color=inks.ink,
            )
    handles = risk_swatches(inks)
    if any(row["share"] is None for row in table.rows):
        handles.append(
            Patch(fc=inks.undecided, hatch="xxxx", ec=inks.edge, label="slides, or no answer")
        )
    if any(row["verdict"] == "red" for row in table.rows):
        words = f"above the target of {table.target.words}"
        handles.append(Patch(fc="none", ec=inks.ink, lw=MARKED, label=words))
    narrow = figure_of(axes).get_figwidth() <= NARROW
    labels = [literal(name).replace(", ", ",\n" if narrow else ", ") for name, _ in floors]
    axes.set_yticks(range(len(floors)), labels)
    axes.set(xlim=(0.0, 1.0), ylim=(-BELOW, len(floors) - 1 + ABOVE), xticks=[])
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    draw_legend(axes, "below", handles=handles, title=FALLING)
    return axes


def _size(row: Mapping[str, Any]) -> tuple[float, float]:
    """Return width and height of the homogeneous rectangle that rocks as an object does [m]."""
    block = Block.from_p(alpha=row["alpha_rad"], p=row["p_rad_s"])
    return block.width, block.height
