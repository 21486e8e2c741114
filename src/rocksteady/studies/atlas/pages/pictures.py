"""Pictures of an atlas: bands of families, coexisting motions, fates from rest."""

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.show.style import palette
from rocksteady.studies.atlas.analysis.coexistence import Coexistence
from rocksteady.studies.atlas.analysis.families import FamilyMap
from rocksteady.studies.atlas.analysis.from_rest import FATES, FromRest
from rocksteady.studies.atlas.analysis.lines import Line
from rocksteady.studies.atlas.analysis.windows import Window
from rocksteady.studies.atlas.pages._marks import (
    draw_cells,
    draw_edge,
    draw_lines,
    draw_pattern,
    draw_thresholds,
    legend_below,
    line_handles,
    patch,
    prepare,
    shades,
)
from rocksteady.studies.atlas.pages._words import family_name

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DRAWN = ("existence", "symmetry-breaking", "first-doubling", "cascade-limit", "graze")
"""Borders in the picture of the families; the second doubling would hide what lies between."""
MOST_COUNTED = ("#eaf5fe", "#0b3c63")
OVERTURNING = (palette.REST, palette.OVERTURNED)
"""From few to many: each a ramp of lightness, which grey shows too."""
BANDS = (
    ("symmetric", palette.SYMMETRIC, ""),
    ("unsymmetric", palette.UNSYMMETRIC, ""),
    ("doubled, and doubled again", palette.SUBHARMONIC, ""),
)
RARE = ("2, 4, 6, 7 periods\nor more", palette.APERIODIC, "", palette.INK)
MAGNIFIED = 0.5
"""Part of the way along the cascade at which a piece of it is drawn large."""
AWAY = 0.01
"""Part of the plane's height by which a graze may miss the end of the bands."""
FATE_LOOKS = {
    "rest": (palette.REST, "", palette.INK),
    "symmetric, period 1": (palette.SYMMETRIC, "", palette.INK),
    "unsymmetric, period 1": (palette.UNSYMMETRIC, "", palette.INK),
    "period 1 with rests": (palette.REGION_FILLS[1], "||||", palette.LINES[0]),
    "subharmonic": (palette.SUBHARMONIC, "....", "white"),
    "aperiodic": (palette.APERIODIC, "......", "white"),
    "overturned": (palette.OVERTURNED, "////", palette.FAINT),
    "undecided": (palette.UNDECIDED, "xxxx", palette.INK),
}
"""Fill, pattern and its colour of each fate."""
PERIODS = (
    ("3 periods", palette.SYMMETRIC),
    ("5 periods", palette.UNSYMMETRIC),
    ("3 and 5 periods", palette.SUBHARMONIC),
)
"""Fills of the regions of motions of several periods, each cell one of them."""
WITH_RESTS = ("1 period,\nwith rests in it", "none", "....", palette.INK)
"""The one pattern, over any of the fills."""
REST_EDGE: dict[str, Any] = {"color": palette.IMPACT, "lw": 1.3}
"""Line below which a block at rest stays at rest."""


def draw_families(
    families: Sequence[FamilyMap], lines: Sequence[Line], strips: Sequence[Window]
) -> "Figure":
    """Draw the bands of every family, one above the other, with the windows of its period."""
    from matplotlib.figure import Figure

    plane = families[0].plane
    with palette.style():
        figure = Figure(figsize=(7.2, 0.9 + 2.7 * len(families)))
        rows = figure.subplots(len(families), 1, squeeze=False)[:, 0]
        for axes, family in zip(rows, families, strict=True):
            title = f"n = {family.order}: {family_name(family.order)}"
            prepare(axes, plane, title=title, bottom=axes is rows[-1])
            edges = family.edges
            for band, (_, fill, _) in enumerate(BANDS):
                axes.fill_between(
                    plane.ratios, edges[band], edges[band + 1], color=fill, lw=0, zorder=0.5
                )
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
        handles: list[Artist] = [patch(label, fill, hatch) for label, fill, hatch in BANDS]
        handles += [patch("nothing stable of this family", "white")]
        legend_below(figure, [*handles, *line_handles(names)], 3)
    return figure


def draw_coexistence(
    result: Coexistence, families: Sequence[FamilyMap], lines: Sequence[Line]
) -> "Figure":
    """Draw the number of motions, and the regions of motions that are not harmonic."""
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    plane = result.plane
    most = max(int(result.motions.max()), 1)
    colours = [palette.OVERTURNED, *shades(*MOST_COUNTED, most)]
    with palette.style():
        figure = Figure(figsize=(7.2, 8.2))
        upper, lower = figure.subplots(2, 1)
        prepare(upper, plane, title="Number of motions that stand side by side", bottom=False)
        draw_cells(upper, plane, result.motions, colours)
        draw_pattern(upper, plane, result.motions == 0, "////", palette.FAINT)
        handles = [patch("0: all overturn", palette.OVERTURNED, "////", palette.FAINT)]
        handles += [patch(str(count), colours[count]) for count in range(1, most + 1)]
        upper.legend(handles=handles, loc="center left", bbox_to_anchor=(1.01, 0.5))
        prepare(lower, plane, title="Where motions other than the plain harmonic one were found")
        three = result.having(lambda kind: kind.period == 3)
        five = result.having(lambda kind: kind.period == 5)
        codes = np.where(three | five, three + 2.0 * five - 1.0, np.nan)
        draw_cells(lower, plane, codes, [fill for _, fill in PERIODS])
        rests = result.having(lambda kind: kind.impacts is None)
        draw_pattern(lower, plane, rests, WITH_RESTS[2], WITH_RESTS[3])
        draw_edge(lower, plane, result.rest, **REST_EDGE)
        # Rare ones above the fills and beneath the pattern, so that both are seen.
        rare = result.having(lambda kind: kind.period not in (1, 3, 5))
        draw_cells(lower, plane, np.where(rare, 0.0, np.nan), [RARE[1]], above=0.7)
        for family in families:
            if family.order in (3, 5):
                family_lines = [
                    _beside(line, family) for line in lines if line.order == family.order
                ]
                draw_lines(lower, family_lines, only=("existence", "cascade-limit", "graze"))
        looks = ((*look, "", palette.INK) for look in PERIODS)
        handles = [patch(*look) for look in (*looks, RARE, WITH_RESTS)]
        handles.append(Line2D([], [], label="rest for ever below", **REST_EDGE))
        lower.legend(handles=handles, loc="center left", bbox_to_anchor=(1.01, 0.5))
    return figure


def draw_from_rest(result: FromRest, lines: Sequence[Line]) -> "Figure":
    """Draw the long-term motion from rest, and at how many phases the block overturns."""
    from matplotlib.figure import Figure

    plane, count = result.plane, len(result.phases)
    family_lines = [line for line in lines if line.order == 1]
    over = ("symmetry-breaking", "first-doubling")
    shares = shades(*OVERTURNING, count + 1)
    with palette.style():
        figure = Figure(figsize=(7.2, 8.6))
        upper, lower = figure.subplots(2, 1)
        title = "A block at rest when the shaking begins at phase 0"
        prepare(upper, plane, title=title, bottom=False)
        draw_cells(upper, plane, result.fate[0], [FATE_LOOKS[fate][0] for fate in FATES])
        for code, fate in enumerate(FATES):
            _, hatch, ink = FATE_LOOKS[fate]
            if hatch:
                draw_pattern(upper, plane, result.fate[0] == code, hatch, ink)
        fates = [fate for code, fate in enumerate(FATES) if (result.fate[0] == code).any()]
        looks = [(fate, *FATE_LOOKS[fate]) for fate in fates]
        upper.legend(
            handles=[patch(fate.replace(" with", "\nwith").replace(", ", ",\n"), *look)
                     for fate, *look in looks],
            loc="center left",
            bbox_to_anchor=(1.01, 0.5),
        )  # fmt: skip
        prepare(lower, plane, title=f"At how many of {2 * count} phases it overturns")
        draw_cells(lower, plane, np.rint(result.overturned * count), shares)
        lower.legend(
            handles=[patch(f"{2 * k} of {2 * count}", shares[k]) for k in range(count, -1, -1)],
            loc="center left",
            bbox_to_anchor=(1.01, 0.5),
        )
        for axes in (upper, lower):
            draw_lines(axes, family_lines, only=over)
            draw_thresholds(axes, plane)
        names = [name for name in over if any(line.name == name for line in family_lines)]
        handles = line_handles(names, thresholds=True)
        for handle in handles[: len(names)]:
            handle.set_label(f"{handle.get_label()}, n = 1")
        legend_below(figure, handles, 2)
    return figure


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
    # At the right of the harmonic motions and at the left of the others nothing is in the way.
    place = (0.66, 0.2, 0.3, 0.62) if family.order == 1 else (0.06, 0.42, 0.26, 0.5)
    inset = axes.inset_axes(place)
    for band, (_, fill, _) in enumerate(BANDS):
        inset.fill_between(plane.ratios, edges[band], edges[band + 1], color=fill, lw=0, zorder=0.5)
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
    axes.indicate_inset_zoom(inset, edgecolor=palette.NUMBER, alpha=1.0, lw=0.8)


def _draw_window(axes: "Axes", window: Window) -> None:
    """Fill what lies between the fold and the symmetry breaking of a window, and name it."""
    named = {line.name: line for line in window.lines}
    low, high = named.get("fold"), named.get("symmetry-breaking")
    if low is None or high is None:
        return
    ends = [line.frequency_ratio for line in (low, high)]
    ratios = np.linspace(max(map(np.min, ends)), min(map(np.max, ends)), 200)
    under, over = (np.array([line.amplitude_at(ratio) for ratio in ratios]) for line in (low, high))
    axes.fill_between(ratios, under, over, color=palette.LINES[0], lw=0.4, zorder=1.0)
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
