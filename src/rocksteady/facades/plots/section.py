"""Drawing of a facade's section: wall, hinge, loads, masses, ties and thrusts."""

import math
from typing import TYPE_CHECKING

from rocksteady.facades.checks.facade import Facade
from rocksteady.facades.checks.read_facade import DescribedFacade
from rocksteady.facades.plots.languages import Language, decimal_marks, language_of
from rocksteady.model.checks.arguments import checked
from rocksteady.show.style import palette
from rocksteady.show.style.escaping import literal
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import size_of, text_size
from rocksteady.show.style.tokens import DASHED, Inks, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LEAN_RAD = math.radians(5.0)
"""Angle of the leaning outline, for the eye alone."""
ARM = 0.17
"""Length of an arrow over the height of the wall."""
BESIDE = 0.56
"""Room to either side of the wall over its height."""
GROUND = 0.07
"""Depth of the ground over the height of the wall."""
LINES = 2.6
"""Distance of two labels over the size of their text."""
LONGEST = 18
"""Letters of a name in the drawing."""


@checked
def plot_facade_section(
    facade: Facade | DescribedFacade, ax: "Axes | None" = None, *, language: str = "en"
) -> "Axes":
    """Draw the section of a facade to scale, with its hinge and forces.

    The outer face is at position 0, the building on the right. The dashed outline leans outwards
    by 5°, for the eye alone. Loads point down, ties pull inwards, thrusts push outwards; masses
    that push without weighing on the wall are hollow.

    Parameters
    ----------
    facade
        From `rocksteady.read_facade`, or made by hand.
    ax
        Axes to draw on; default: axes of a new figure.
    language
        "en", the default, or "it".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: position and height above the hinge [m].

    Raises
    ------
    InputError
        If there is no such language.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady.codes import Facade
    >>> wall = Facade(name="front", kind="wall", thickness_m=0.3, height_m=3.0)
    >>> plot_facade_section(wall, Figure().add_subplot(), language="it").get_xlabel()
    'posizione [m]'
    """
    if isinstance(facade, DescribedFacade):
        facade = facade.facade
    words = language_of(language)
    axes = axes_or_new(ax)
    inks = inks_of(axes)
    high, thick = facade.height_m, facade.thickness_m
    _draw_surroundings(axes, facade, inks)
    _draw_body(axes, facade, inks)
    _draw_leaning(axes, facade, inks)
    left, right = _labels_of(axes, facade, words, inks)
    reach = ARM * high
    loads = [each.z_m for each in facade.loads]
    top = max([high, *(z + reach for z in loads)]) + 0.05 * high
    wide, tall = size_of(axes)
    scale = min(wide / (thick + 2.0 * BESIDE * high), tall / (top + GROUND * high))
    apart = LINES * text_size(axes, 8.0) / scale
    _write(axes, left, (-1.15 * reach, "right"), apart, inks)
    _write(axes, right, (thick + 1.15 * reach, "left"), apart, inks)
    inset = facade.hinge_inset_m
    axes.plot([inset], [0.0], "^", ms=8.0, color=inks.ink, zorder=5.0, clip_on=False)
    axes.annotate(
        words["hinge"], (inset, 0.0), (-1.15 * reach, 0.03 * high), ha="right", va="center",
        fontsize=text_size(axes, 8.0), color=inks.ink,
        arrowprops={"arrowstyle": "-", "color": inks.edge, "lw": 0.6, "shrinkB": 4.0},
    )  # fmt: skip
    axes.set_aspect("equal", adjustable="box")
    axes.set(
        xlim=(-BESIDE * high, thick + BESIDE * high),
        ylim=(-GROUND * high, top),
        xlabel=words["axis_position"],
        ylabel=words["axis_height"],
    )
    axes.locator_params(axis="x", nbins=5)
    axes.grid(visible=False)
    decimal_marks(axes, words)
    return axes


def _draw_surroundings(axes: "Axes", facade: Facade, inks: Inks) -> None:
    """Draw what the wall stands on, and the building that stops it on its way back."""
    from matplotlib.patches import Rectangle

    high, thick = facade.height_m, facade.thickness_m
    ground = (-BESIDE * high, -GROUND * high)
    axes.add_patch(
        Rectangle(
            ground, thick + 2.0 * BESIDE * high, GROUND * high, facecolor=inks.soil,
            lw=0.0, zorder=0.6,
        )
    )  # fmt: skip
    axes.axhline(0.0, color=inks.ink, lw=1.0, zorder=0.8)
    if facade.one_sided:
        axes.add_patch(
            Rectangle((thick, 0.0), 0.07 * high, high, facecolor=inks.hair, lw=0.0, zorder=0.6)
        )  # fmt: skip


def _draw_body(axes: "Axes", facade: Facade, inks: Inks) -> None:
    """Draw the wall."""
    from matplotlib.patches import Rectangle

    axes.add_patch(
        Rectangle(
            (0.0, 0.0), facade.thickness_m, facade.height_m,
            facecolor=inks.rest, edgecolor=inks.ink, lw=1.1, zorder=2.0,
        )
    )  # fmt: skip


def _draw_leaning(axes: "Axes", facade: Facade, inks: Inks) -> None:
    """Draw the outline of the wall that leans outwards about its hinge."""
    sin, cos = math.sin(LEAN_RAD), math.cos(LEAN_RAD)
    inset = facade.hinge_inset_m
    corners = [(x, z) for x, z in (
        (inset, 0.0), (0.0, 0.0), (0.0, facade.height_m),
        (facade.thickness_m, facade.height_m), (facade.thickness_m, 0.0), (inset, 0.0),
    )]  # fmt: skip
    turned = [
        (inset + (x - inset) * cos - z * sin, (x - inset) * sin + z * cos) for x, z in corners
    ]
    axes.plot(*zip(*turned, strict=True), color=inks.quiet, lw=0.9, ls=DASHED, zorder=1.5)


Label = tuple[str, float, tuple[float, float]]
"""Text, its wanted height, and the point that it names."""


def _labels_of(
    axes: "Axes", facade: Facade, words: Language, inks: Inks
) -> tuple[list[Label], list[Label]]:
    """Draw all arrows; return the labels on the left and on the right of the wall."""
    high, thick = facade.height_m, facade.thickness_m
    reach = ARM * high
    left: list[Label] = []
    right: list[Label] = []

    def arrow(start: tuple[float, float], end: tuple[float, float]) -> None:
        style = {"arrowstyle": "-|>", "color": inks.ink, "lw": 1.4, "shrinkA": 0.0, "shrinkB": 0.0}
        axes.annotate("", end, start, arrowprops={**style, "mutation_scale": 9.0}, zorder=4.0)

    def name(text: str, force: float) -> str:
        short = literal(palette.shortened(text, LONGEST))
        return f"{short}\n{words.quantity(force, 'kN')}"

    centre = (0.5 * thick, high / 3.0 if facade.kind == "gable" else 0.5 * high)
    axes.plot(*[[value] for value in centre], "o", ms=6.0, mfc=inks.paper, mec=inks.ink, zorder=4.5)
    weight = words.quantity(facade.weight_kn, "kN")
    # The arrow of a mass leaves to the left, and its name stands there.
    (right if facade.masses else left).append(
        (f"{words[facade.kind]}\n{weight}", centre[1], centre)
    )
    for load in facade.loads:
        tail = (load.x_m, load.z_m + reach)
        arrow(tail, (load.x_m, load.z_m))
        left.append((name(load.name, load.weight_kn), tail[1], tail))
    for mass in facade.masses:
        arrow((0.0, mass.z_m), (-reach, mass.z_m))
        axes.plot([0.5 * thick], [mass.z_m], "s", ms=6.0, mfc="none", mec=inks.ink, zorder=4.5)
        left.append((name(mass.name, mass.weight_kn), mass.z_m, (-reach, mass.z_m)))
    for tie in facade.ties:
        arrow((thick, tie.z_m), (thick + reach, tie.z_m))
        right.append((name(tie.name, tie.force_kn), tie.z_m, (thick + reach, tie.z_m)))
    for thrust in facade.thrusts:
        arrow((thick + reach, thrust.z_m), (thick, thrust.z_m))
        right.append((name(thrust.name, thrust.force_kn), thrust.z_m, (thick + reach, thrust.z_m)))
    return left, right


def _write(
    axes: "Axes", labels: list[Label], where: tuple[float, str], apart: float, inks: Inks
) -> None:
    """Write labels in a column, one above the other, with lines to what they name."""
    x, side = where
    lowest = 1.2 * apart
    for text, wanted, point in sorted(labels, key=lambda label: label[1]):
        z = max(wanted, lowest)
        lowest = z + apart
        style = {"arrowstyle": "-", "color": inks.edge, "lw": 0.6, "shrinkA": 1.0, "shrinkB": 3.0}
        axes.annotate(
            text, point, (x, z), ha=side, va="center", fontsize=text_size(axes, 8.0),
            color=inks.ink, arrowprops=style, linespacing=1.15, zorder=5.0,
        )  # fmt: skip
