"""Branches of periodic motions as lines, and the marks of their bifurcations."""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.dynamics.continuation.points import Branch
from rocksteady.show.plots.branches.views import View
from rocksteady.show.style.legends import line_scale
from rocksteady.show.style.tokens import DASHED, DOTTED, Inks, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Kind = tuple[int, bool]
"""Period of an orbit, and whether it is unsymmetric."""
Marks = dict[PointType, list[tuple[float, float]]]
"""Places of the marks of each type of bifurcation."""

LOOKS: dict[str, dict[str, Any]] = {
    "solid: stable": {"ls": "-", "lw": 1.9, "zorder": 3.0},
    "dashed: unstable": {"ls": DASHED, "lw": 0.9, "zorder": 2.6},
    "dotted: no motion": {"ls": DOTTED, "lw": 0.9, "alpha": 0.5, "zorder": 2.4},
}
"""Look of each part of a branch, by the words that explain it."""
MARKS = {
    PointType.FOLD: "o",
    PointType.SYMMETRY_BREAKING: "D",
    PointType.PERIOD_DOUBLING: "s",
    PointType.GRAZING: "X",
}
"""Marker of each bifurcation."""
EVENTS = {
    PointType.FOLD: "fold",
    PointType.SYMMETRY_BREAKING: "symmetry breaks",
    PointType.PERIOD_DOUBLING: "period doubles",
    PointType.GRAZING: "grazes",
}
"""Words beside the mark of each bifurcation."""


class Flight(NamedTuple):
    """A line of a diagram: places, what kind of motion it shows, and whether that is stable."""

    places: Floats
    label: str
    colour: str
    stable: bool


def _colours(branches: Sequence[Branch], inks: Inks) -> dict[Kind, str]:
    """Return the colour of each kind of orbit that there is."""
    kinds = sorted({(branch.period, not branch.symmetric) for branch in branches})
    longer = [kind for kind in kinds if kind[0] > 1]
    shades = inks.series("subharmonic_line", len(longer))
    colours = {(1, False): inks.motion, (1, True): inks.unsymmetric_line}
    colours |= dict(zip(longer, shades, strict=True))
    return {kind: colours[kind] for kind in kinds}


def _label(kind: Kind, kinds: Iterable[Kind]) -> str:
    """Return the words for a kind of orbit; its symmetry only where that distinguishes it."""
    period, leaning = kind
    word = "unsymmetric" if leaning else "symmetric"
    if period == 1:
        return word
    if period % 2 == 0 and (period, not leaning) not in kinds:
        return f"period {period}"
    return f"{word}, period {period}"


def _sided(peaks: Floats, branch: Branch, view: View) -> Floats:
    """Return what is drawn of the extremes of flights, shape (points, lines)."""
    # Of two impacts that merge the flight between them vanishes: its extreme is 0.
    peaks = np.nan_to_num(peaks, nan=0.0)
    if view.sizes:
        return view.y(peaks[..., : peaks.shape[-1] // 2] if branch.symmetric else peaks)
    # The mirror image of what leans; for a block whose sides differ it is no motion.
    leans = not branch.symmetric and branch.block.symmetric
    return view.y(np.concatenate([peaks, -peaks], axis=-1) if leans else peaks)


def draw_branches(
    axes: "Axes", branches: Sequence[Branch], inks: Inks, view: View
) -> tuple[list[Flight], set[str]]:
    """Draw branches and return their lines, and the words for the looks of these."""
    flights, looks = [], set[str]()
    colours, scale = _colours(branches, inks), line_scale(axes)
    for branch in branches:
        kind = branch.period, not branch.symmetric
        x, lines = view.x(branch.values), _sided(branch.peaks, branch, view)
        for stretch in branch.stretches:
            word = "dashed: unstable" if stretch.admissible else "dotted: no motion"
            word = "solid: stable" if stretch.stable else word
            looks.add(word)
            part = slice(stretch.first, stretch.last + 1)
            look = {**LOOKS[word], "lw": LOOKS[word]["lw"] * scale, "color": colours[kind]}
            axes.plot(x[part], lines[part], **look)
            for y in lines[part].T:
                places, label = np.column_stack([x[part], y]), _label(kind, colours)
                flights.append(Flight(places, label, colours[kind], stretch.stable))
    return flights, looks


def bifurcations_of(branches: Sequence[Branch], view: View) -> Marks:
    """Return where bifurcations of each type are marked."""
    marks = {}
    for kind in MARKS:
        places: set[tuple[float, float]] = set()
        for branch in branches:
            for index, point in enumerate(branch.points):
                if point.type is kind:
                    # A point on two branches is marked once.
                    places |= set(spots_of(branch, index, view))
        if places:
            marks[kind] = sorted(places)
    return marks


def spots_of(branch: Branch, index: int, view: View) -> list[tuple[float, float]]:
    """Return where a point of a branch is marked: at its highest and at its lowest angle."""
    peaks = branch.peaks[index]
    ends = np.array([max(np.nanmax(peaks), 0.0), min(np.nanmin(peaks), 0.0)])
    x = round(float(view.x(branch.values[index])), 9)
    return [(x, round(y, 6)) for y in _sided(ends, branch, view).tolist()]


def draw_bifurcations(axes: "Axes", marks: Marks) -> None:
    """Mark bifurcations."""
    for kind, places in marks.items():
        axes.plot(*zip(*places, strict=True), zorder=4.0, **mark_of(kind, axes))


def mark_of(kind: PointType, axes: "Axes") -> dict[str, Any]:
    inks, size = inks_of(axes), 3.8 * line_scale(axes)
    look = {"mfc": inks.paper, "mec": inks.ink, "mew": 0.8, "ls": "none"}
    return {"marker": MARKS[kind], "ms": size, **look}


def name_of(kind: PointType) -> str:
    """Return the name of a bifurcation in a legend."""
    return "graze" if kind is PointType.GRAZING else kind.value.replace("-", " ")
