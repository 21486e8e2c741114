"""Pictures of an atlas: bands of families, coexisting motions, fates from rest."""

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.outcomes import AttractorKind, motion_verb
from rocksteady.show.style import palette
from rocksteady.show.style.areas import area_style, swatch
from rocksteady.show.style.tokens import DASHED, Inks, inks_of, mixed
from rocksteady.studies.atlas.analysis.coexistence import Coexistence
from rocksteady.studies.atlas.analysis.families import FamilyMap
from rocksteady.studies.atlas.analysis.from_rest import FATES, FromRest
from rocksteady.studies.atlas.analysis.lines import Line
from rocksteady.studies.atlas.analysis.plane import Plane
from rocksteady.studies.atlas.analysis.windows import Window
from rocksteady.studies.atlas.pages._marks import (
    draw_area,
    draw_cells,
    draw_edge,
    draw_lines,
    draw_thresholds,
    legend_below,
    line_handles,
    prepare,
    shades,
)

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DRAWN = ("existence", "symmetry-breaking", "first-doubling", "cascade-limit", "graze")
"""Borders in the picture of the families; the second doubling would hide what lies between."""
BANDS = (
    ("symmetric", "symmetric"),
    ("unsymmetric", "unsymmetric"),
    ("subharmonic, by doubling", "subharmonic"),
)
"""Words and role of each band."""
MAGNIFIED = 0.5
"""Part of the way along the cascade at which a piece of it is drawn large."""
SLIVER = -0.4
"""Part of black in the fill of a window, which is thin."""
AWAY = 0.01
"""Part of the plane's height by which a graze may miss the end of the bands."""
FATE_LOOKS = {
    "rest": ("comes to rest", "rest", None),
    "symmetric, period 1": ("symmetric", "symmetric", None),
    "unsymmetric, period 1": ("unsymmetric", "unsymmetric", None),
    "period 1 with rests": ("period 1\nwith rests", "rocks", "with_rests"),
    "subharmonic": ("subharmonic", "subharmonic", None),
    "aperiodic": ("aperiodic", "aperiodic", None),
    "overturned": ("falls", "falls", None),
    "undecided": ("undecided", "undecided", None),
}
"""Words, role and pattern of each fate."""
PERIODS = (("3 periods", 0.65), ("5 periods", 0.25), ("3 and 5 periods", -0.15))
"""Words of motions of several periods, and their steps of one fill: parts of white or black."""
RARE = ("2, 4, 6, 7 periods\nor more", -0.6)
WITH_RESTS = "1 period,\nwith rests in it"
"""The one pattern, over any of the fills."""
ON_DARK = -0.7
"""Factor of the steps on dark paper, where the strongest is the lightest."""
BESIDE: dict[str, Any] = {
    "loc": "center left",
    "bbox_to_anchor": (1.01, 0.5),
    "handleheight": 1.2,
}
"""Legend to the right of its axes."""
REST_EDGE: dict[str, Any] = {"lw": 1.3, "ls": DASHED}
"""Line below which a block at rest stays at rest."""
RISKS = ("0 to 20 %", "20 to 40 %", "40 to 60 %", "60 to 80 %", "80 to 100 %")
"""Steps of a share that falls."""


def draw_families(
    families: Sequence[FamilyMap], lines: Sequence[Line], strips: Sequence[Window]
) -> "Figure":
    """Draw the bands of every family, one above the other, with the windows of its period."""
    from matplotlib.figure import Figure

    plane = families[0].plane
    with palette.style():
        figure = Figure(figsize=(7.2, 0.9 + 2.7 * len(families)))
        rows = figure.subplots(len(families), 1, squeeze=False)[:, 0]
        inks = inks_of(rows[0])
        for axes, family in zip(rows, families, strict=True):
            title = f"n = {family.order}: {motion_verb(AttractorKind.SYMMETRIC, family.order)}"
            prepare(axes, plane, title=title, bottom=axes is rows[-1])
            edges = family.edges
            _draw_bands(axes, plane, edges)
            for window in strips:
                if window.orbits.period == family.order:
                    _draw_window(axes, window)
            family_lines = [line for line in lines if line.order == family.order]
            draw_lines(
                axes, [_beside(line, family) for line in family_lines], only=DRAWN, cased=False
            )
            _magnify(axes, family, family_lines)
        names = [
            name
            for name in (*DRAWN[:3], "second-doubling", *DRAWN[3:])
            if any(line.name == name for line in lines)
        ]
        handles: list[Artist] = [swatch(inks, role, label) for label, role in BANDS]
        handles.append(swatch(inks, "paper", "nothing stable of this family"))
        legend_below(figure, [*handles, *line_handles(inks, names)], 3)
    return figure


def draw_coexistence(
    result: Coexistence, families: Sequence[FamilyMap], lines: Sequence[Line]
) -> "Figure":
    """Draw how many motions there are, and where those of other periods were found."""
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    plane = result.plane
    most = max(int(result.motions.max()), 1)
    with palette.style():
        figure = Figure(figsize=(7.2, 8.2))
        upper, lower = figure.subplots(2, 1)
        inks = inks_of(upper)
        colours = [inks.falls, *shades(inks.rocks_ramp, most)]
        prepare(upper, plane, title="Number of motions that stand side by side", bottom=False)
        draw_cells(upper, plane, result.motions, colours)
        draw_area(upper, plane, result.motions == 0, "falls")
        handles: list[Artist] = [swatch(inks, "falls", "0: falls")]
        handles += [filled(inks, colours[count], str(count)) for count in range(1, most + 1)]
        upper.legend(handles=handles, **BESIDE)
        prepare(lower, plane, title="Where motions other than rocking with the shaking were found")
        three = result.having(lambda kind: kind.period == 3)
        five = result.having(lambda kind: kind.period == 5)
        codes = np.where(three | five, three + 2.0 * five - 1.0, np.nan)
        steps = [(words, period_fill(inks, part)) for words, part in (*PERIODS, RARE)]
        draw_cells(lower, plane, codes, [fill for _, fill in steps[:-1]])
        rests = result.having(lambda kind: kind.impacts is None)
        draw_area(lower, plane, rests, "rocks", "with_rests")
        draw_edge(lower, plane, result.rest, color=inks.limit, **REST_EDGE)
        # Rare ones above the fills and beneath the pattern, so that both are seen.
        rare = result.having(lambda kind: kind.period not in (1, 3, 5))
        draw_cells(lower, plane, np.where(rare, 0.0, np.nan), [steps[-1][1]], above=0.7)
        for family in families:
            if family.order in (3, 5):
                family_lines = [
                    _beside(line, family) for line in lines if line.order == family.order
                ]
                draw_lines(lower, family_lines, only=("existence", "cascade-limit", "graze"))
        handles = [filled(inks, fill, words) for words, fill in steps]
        handles.append(swatch(inks, "paper", WITH_RESTS, "with_rests"))
        rest_edge = Line2D([], [], color=inks.limit, label="rests for ever below", **REST_EDGE)
        handles.append(rest_edge)
        lower.legend(handles=handles, **BESIDE)
    return figure


def draw_from_rest(result: FromRest, lines: Sequence[Line]) -> "Figure":
    """Draw the long-term motion from rest, and the share of phases at which the block falls."""
    from matplotlib.figure import Figure

    plane, count = result.plane, len(result.phases)
    family_lines = [line for line in lines if line.order == 1]
    over = ("symmetry-breaking", "first-doubling")
    with palette.style():
        figure = Figure(figsize=(7.2, 8.6))
        upper, lower = figure.subplots(2, 1)
        inks = inks_of(upper)
        title = "A block at rest when the shaking begins at phase 0"
        prepare(upper, plane, title=title, bottom=False)
        fills = [getattr(inks, FATE_LOOKS[fate][1]) for fate in FATES]
        draw_cells(upper, plane, result.fate[0], fills)
        handles: list[Artist] = []
        for code, fate in enumerate(FATES):
            where = result.fate[0] == code
            if where.any():
                words, role, pattern = FATE_LOOKS[fate]
                draw_area(upper, plane, where, role, pattern)
                handles.append(swatch(inks, role, words, pattern))
        upper.legend(handles=handles, **BESIDE)
        prepare(lower, plane, title=f"At which share of {2 * count} phases it falls")
        steps = np.minimum(np.floor(result.overturned * len(RISKS)), len(RISKS) - 1)
        draw_cells(lower, plane, steps, inks.risk_ramp)
        handles = [filled(inks, inks.risk_ramp[k], RISKS[k]) for k in range(len(RISKS))[::-1]]
        lower.legend(handles=handles, **BESIDE)
        for axes in (upper, lower):
            draw_lines(axes, family_lines, only=over)
            draw_thresholds(axes, plane)
        names = [name for name in over if any(line.name == name for line in family_lines)]
        handles = line_handles(inks, names, thresholds=True)
        for handle in handles[: len(names)]:
            handle.set_label(f"{handle.get_label()}, n = 1")
        legend_below(figure, handles, 2)
    return figure


def _draw_bands(axes: "Axes", plane: Plane, edges: Floats) -> None:
    """Fill the bands of a family between their edges."""
    for band, (_, role) in enumerate(BANDS):
        style = area_style(inks_of(axes), role)
        axes.fill_between(plane.ratios, edges[band], edges[band + 1], zorder=0.5, **style)


def period_fill(inks: Inks, part: float) -> str:
    """Return a step of the fill of subharmonic motions, away from the paper as parts fall."""
    return mixed(inks.subharmonic, ON_DARK * part if inks.dark else part)


def filled(inks: Inks, fill: str, label: str) -> "Artist":
    """Return the legend entry of a step of a ramp."""
    from matplotlib.patches import Patch

    return Patch(facecolor=fill, edgecolor=inks.edge, lw=0.6, label=label)


def _beside(line: Line, family: FamilyMap) -> Line:
    """Return a line as far as it borders what is stable: grazes go on beyond it."""
    if line.name != "graze":
        return line
    end = np.interp(line.frequency_ratio, family.plane.ratios, family.edges[3])
    away = np.abs(line.amplitude - end) > AWAY * family.plane.top
    return replace(line, amplitude=np.where(away, np.nan, line.amplitude))


def _magnify(axes: "Axes", family: FamilyMap, lines: Sequence[Line]) -> None:
    """Draw a piece of the cascade again, large enough to see what it consists of."""
    cascade = next((line for line in lines if line.name == "cascade-limit"), None)
    plane, edges = family.plane, family.edges
    if cascade is None or len(cascade.amplitude) < 8:
        return
    middle = float(cascade.frequency_ratio[int(MAGNIFIED * len(cascade.amplitude))])
    column = int(np.argmin(np.abs(plane.ratios - middle)))
    doubled, limit = edges[2:, column]
    slope = (edges[3, column + 1] - edges[3, column - 1]) / np.ptp(
        plane.ratios[column - 1 : column + 2]
    )
    height = limit - doubled
    # At the right of the family of n = 1 and at the left of the others nothing is in the way.
    place = (0.66, 0.2, 0.3, 0.62) if family.order == 1 else (0.06, 0.42, 0.26, 0.5)
    inset = axes.inset_axes(place)
    _draw_bands(inset, plane, edges)
    draw_lines(inset, lines, only=(*DRAWN[1:4], "second-doubling"), cased=False)
    inset.set(
        xlim=(middle - height / slope, middle + height / slope),
        ylim=(limit - 2.6 * height, limit + 1.2 * height),
    )
    inset.grid(visible=False)
    inset.tick_params(labelsize=7.0, length=2.0)
    inset.locator_params(nbins=3)
    for spine in inset.spines.values():
        spine.set_visible(True)
    axes.indicate_inset_zoom(inset, edgecolor=inks_of(axes).quiet, alpha=1.0, lw=0.8)


def _draw_window(axes: "Axes", window: Window) -> None:
    """Fill what lies between the fold and the symmetry breaking of a window, and name it."""
    named = {line.name: line for line in window.lines}
    low, high = named.get("fold"), named.get("symmetry-breaking")
    if low is None or high is None:
        return
    ends = [line.frequency_ratio for line in (low, high)]
    ratios = np.linspace(max(map(np.min, ends)), min(map(np.max, ends)), 200)
    under, over = (np.array([line.amplitude_at(ratio) for ratio in ratios]) for line in (low, high))
    fill = mixed(inks_of(axes).symmetric, SLIVER)
    axes.fill_between(ratios, under, over, color=fill, lw=0.4, zorder=1.0)
    place = int(0.8 * len(ratios))
    axes.annotate(
        f"{window.orbits.impacts} impacts",
        (ratios[place], over[place]),
        (0.0, 3.0),
        textcoords="offset points",
        ha="center",
        va="bottom",
        fontsize=8.0,
    )
