"""Pictures of the study: verdicts over slenderness and height, ratios, worked walls."""

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady import plots
from rocksteady.show.style import palette
from rocksteady.show.style.legends import draw_legend, line_scale, text_size
from rocksteady.show.style.limits import name_level_end
from rocksteady.show.style.page import SCREEN, Page
from rocksteady.show.style.scales import scale_of
from rocksteady.show.style.tokens import DASHED, HATCHES, inks_of
from rocksteady.studies.facade_checks._checked_walls import METHODS, SHARE, CheckedWalls
from rocksteady.studies.facade_checks._findings import CLASSES
from rocksteady.studies.facade_checks._worked_walls import WorkedWall

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FILLS = {
    7: ("page", ""),
    6: ("hair", "||||"),
    5: ("hair", "----"),
    3: ("hair", "++"),
    4: ("edge", "++"),
    2: ("edge", "----"),
    1: ("edge", "||||"),
    0: ("quiet", ""),
}
"""Role and pattern of the combinations of verdicts: the darker the more refuse, with the pattern of
the check that stands alone."""
EDGES: tuple[Any, ...] = ("-", (0, (5, 1.6)), (0, (1.2, 1.2)))
"""Borders of the three checks."""
STEPS = (0.5, 1.0, 2.0, 4.0)
"""Borders of the fills of a ratio."""
WIDE = 7.2
TOP = 1.12
"""Where the mark of a run beyond d0 stands, over d0."""
ASIDE_S = 1.5
"""Time of a run that is shown before the first impact and after the last [s]."""
LABEL_X, LABEL_Y = "slenderness  $h/t$", "height  $h$ [m]"


def verdict_figure(
    checked: CheckedWalls, walls: tuple[WorkedWall, ...] = (), *, page: Page = SCREEN
) -> "Figure":
    """Return the combinations of verdicts, a panel for each level."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    count = len(checked.plane.levels_g)
    stacked = page.stacks(WIDE)
    high = (0.62 * count + 0.25) if stacked else 0.0
    with page.figure(WIDE, 3.6 if count > 1 else 4.6, "", stacked=high or None) as figure:
        panels = figure.subplots(
            count if stacked else 1, 1 if stacked else count,
            sharex=True, sharey=True, squeeze=False,
        ).ravel()  # fmt: skip
        for level, axes in enumerate(panels):
            draw_verdicts(checked, level, axes)
            for number, wall in enumerate(walls, start=1):
                if wall.level == level:
                    _mark(axes, checked, wall, number)
            last = stacked is False or level == count - 1
            axes.set_xlabel(LABEL_X if last else "")
            axes.set_ylabel(LABEL_Y if stacked or level == 0 else "")
        inks = inks_of(panels[0])
        handles: list[Any] = [
            Patch(
                facecolor=getattr(inks, FILLS[kind][0]),
                hatch=FILLS[kind][1],
                edgecolor=inks.ink,
                lw=0.4,
                label=words,
            )
            for kind, words in CLASSES.items()
            if (checked.classes == kind).any()
        ]
        handles += [
            Line2D([], [], color=inks.ink, lw=1.3, ls=dash, label=f"border of the {name} check")
            for name, dash in zip(METHODS, EDGES, strict=True)
        ]
        figure.legend(
            handles=handles, loc="outside lower left", ncols=1 if stacked else 2,
            fontsize=text_size(panels[0], 8.0), frameon=False, labelcolor=inks.ink,
            handlelength=2.4, columnspacing=1.4, borderaxespad=0.3,
        )  # fmt: skip
    return figure


def draw_verdicts(checked: CheckedWalls, level: int, axes: "Axes") -> None:
    """Draw the combinations of verdicts at a level, and the borders of the checks."""
    x, y = _edges(checked.plane.slendernesses), _edges(checked.plane.heights_m)
    inks = inks_of(axes)
    for kind, (role, hatch) in FILLS.items():
        _fill(axes, (x, y), checked.classes[level] == kind, getattr(inks, role), hatch)
    for (_, ratio), dash in zip(checked.ratios.items(), EDGES, strict=True):
        path = _border(x, y, ratio[level] <= 1.0)
        # On any fill: light beneath, dark above.
        axes.plot(*path, color=inks.paper, lw=2.6 * line_scale(axes), solid_capstyle="butt")
        axes.plot(*path, color=inks.limit, lw=1.2 * line_scale(axes), ls=dash)
    axes.grid(visible=False)
    axes.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
    axes.locator_params(axis="y", integer=True)
    axes.set_title(f"PGA {checked.plane.levels_g[level]:g} g", color=inks.ink)


def _fill(
    axes: "Axes",
    edges: tuple[NDArray[np.float64], NDArray[np.float64]],
    chosen: NDArray[np.bool_],
    colour: str,
    hatch: str = "",
) -> None:
    """Fill the chosen cells."""
    from matplotlib.colors import ListedColormap

    if not chosen.any():
        return
    cells = np.ma.masked_array(np.zeros(chosen.shape), ~chosen)
    style: dict[str, Any] = {"cmap": ListedColormap([colour]), "zorder": 0.9}
    axes.pcolormesh(*edges, cells, rasterized=True, **style)
    if hatch:
        inks = inks_of(axes)
        ink = inks.on_falls if colour == inks.falls else inks.ink
        axes.pcolor(*edges, cells, edgecolors=ink, lw=0.0, hatch=hatch, **style)


def _edges(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the edges of cells around points."""
    inner = 0.5 * (points[1:] + points[:-1])
    return np.concatenate(([1.5 * points[0] - 0.5 * points[1]], inner,
                           [1.5 * points[-1] - 0.5 * points[-2]]))  # fmt: skip


def _border(
    x: NDArray[np.float64], y: NDArray[np.float64], accepts: NDArray[np.bool_]
) -> tuple[list[float], list[float]]:
    """Return the edges between cells that a check accepts and refuses; nan between pieces."""
    across: list[float] = []
    up: list[float] = []
    for row, column in np.argwhere(accepts[:, 1:] != accepts[:, :-1]).tolist():
        across += [x[column + 1], x[column + 1], np.nan]
        up += [y[row], y[row + 1], np.nan]
    for row, column in np.argwhere(accepts[1:] != accepts[:-1]).tolist():
        across += [x[column], x[column + 1], np.nan]
        up += [y[row + 1], y[row + 1], np.nan]
    return _joined(across, up)


def _joined(across: list[float], up: list[float]) -> tuple[list[float], list[float]]:
    """Return pieces joined end to end where they meet, so that dashes run on."""
    ends = [((across[k], up[k]), (across[k + 1], up[k + 1])) for k in range(0, len(across), 3)]
    found_x: list[float] = []
    found_y: list[float] = []
    while ends:
        path = list(ends.pop())
        grown = True
        while grown:
            grown = False
            for piece in ends:
                first, last = piece
                if path[-1] in piece:
                    path.append(last if path[-1] == first else first)
                elif path[0] in piece:
                    path.insert(0, last if path[0] == first else first)
                else:
                    continue
                ends.remove(piece)
                grown = True
                break
        found_x += [*(each[0] for each in path), np.nan]
        found_y += [*(each[1] for each in path), np.nan]
    return found_x, found_y


def _mark(axes: "Axes", checked: CheckedWalls, wall: WorkedWall, number: int) -> None:
    """Write the number of a worked wall into its cell."""
    inks = inks_of(axes)
    axes.annotate(
        str(number),
        (checked.plane.slendernesses[wall.column], checked.plane.heights_m[wall.row]),
        ha="center", va="center_baseline", fontsize=text_size(axes, 8.0), color=inks.ink,
        bbox={"boxstyle": "circle,pad=0.25", "fc": inks.paper, "ec": inks.ink, "lw": 0.9},
        zorder=6.0, annotation_clip=False,
    )  # fmt: skip


def ratio_figure(checked: CheckedWalls, *, page: Page = SCREEN) -> "Figure":
    """Return demand over capacity: a row for each level, a column for each check."""
    from matplotlib.patches import Patch

    count = len(checked.plane.levels_g)
    narrow = page.stacks(WIDE)
    high = 0.5 * count + 0.42
    with page.figure(WIDE, 1.9 * count + 0.9, "", stacked=high) as figure:
        panels = figure.subplots(count, 3, sharex=True, sharey=True, squeeze=False)
        for level in range(count):
            for column, (name, ratio) in enumerate(checked.ratios.items()):
                axes = panels[level, column]
                draw_ratio(checked, ratio[level], axes)
                if level == 0:
                    title = name if not narrow else name.replace("nonlinear ", "")
                    axes.set_title(title[0].upper() + title[1:])
                if column == 0:
                    axes.set_ylabel(f"PGA {checked.plane.levels_g[level]:g} g\n{LABEL_Y}")
                if level == count - 1:
                    axes.set_xlabel(LABEL_X)
        inks = inks_of(panels[0, 0])
        bounds = ("", *(f"{each:g}" for each in STEPS), "")
        labels = [
            f"{low} to {top}" if low and top else f"below {top}" if top else f"above {low}"
            for low, top in pairwise(bounds)
        ]
        fills = [*zip(inks.rocks_ramp, labels, strict=True), (inks.falls, "a run beyond $d_0$")]
        figure.legend(
            handles=[
                Patch(
                    facecolor=fill, edgecolor=inks.edge, lw=0.4, label=words,
                    hatch=HATCHES["falls"] if fill == inks.falls else "",
                )
                for fill, words in fills
            ],
            title="demand over capacity", loc="outside lower left", ncols=3 if narrow else 5,
            fontsize=text_size(panels[0, 0], 8.0), title_fontsize=text_size(panels[0, 0], 8.0),
            frameon=False, labelcolor=inks.ink, handlelength=1.6, columnspacing=1.2,
            alignment="left", borderaxespad=0.3,
        )  # fmt: skip
    return figure


def draw_ratio(checked: CheckedWalls, ratio: NDArray[np.float64], axes: "Axes") -> None:
    """Draw demand over capacity of one check at one level."""
    x, y = _edges(checked.plane.slendernesses), _edges(checked.plane.heights_m)
    inks, infinite = inks_of(axes), np.isinf(ratio)
    # A ratio of exactly 1 is accepted.
    place = np.searchsorted(STEPS, ratio, side="left")
    for step, colour in enumerate(inks.rocks_ramp):
        _fill(axes, (x, y), (place == step) & ~infinite, colour)
    _fill(axes, (x, y), infinite, inks.falls, HATCHES["falls"])
    path = _border(x, y, ratio <= 1.0)
    axes.plot(*path, color=inks.paper, lw=2.6 * line_scale(axes), solid_capstyle="butt")
    axes.plot(*path, color=inks.limit, lw=1.2 * line_scale(axes), ls=DASHED)
    axes.grid(visible=False)
    axes.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
    axes.locator_params(axis="y", integer=True)


def worked_figure(wall: WorkedWall, *, page: Page = SCREEN) -> "Figure":
    """Return the capacity curve of a wall, its records one by one, and a run."""
    stacked = page.stacks(WIDE)
    with page.figure(WIDE, 7.6, "", stacked=3.9) as figure:
        if stacked:
            grid = figure.add_gridspec(3, 1, height_ratios=(1.0, 0.9, 0.6))
            places = [grid[0, 0], grid[1, 0], grid[2, 0]]
        else:
            grid = figure.add_gridspec(2, 2, height_ratios=(1.0, 0.62))
            places = [grid[0, 0], grid[0, 1], grid[1, :]]
        first, second, third = (figure.add_subplot(each) for each in places)
        plots.facade_capacity(wall.check, first)
        first.set_title("Capacity and demand", pad=16.0)
        draw_records(wall, second)
        plots.trajectory(wall.history, third, span=_span(wall), legend="none")
        name = palette.shortened(wall.runs.records[wall.governing], 24)
        third.set_title(f"Run under {name}, {wall.direction}")
        tilted = scale_of("angle", wall.history.block).factor
        limit = SHARE * tilted  # of theta over that at d0
        third.axhline(limit, color=inks_of(third).limit, lw=0.9, ls=DASHED)
        third.set_ylim(top=min(third.get_ylim()[1], 1.6 * tilted))
        name_level_end(third, limit, r"$d_{\mathrm{SLV}}$", left=True)
    return figure


def _span(wall: WorkedWall) -> tuple[float, float]:
    """Return the pivot times between which the wall rocks, with a little before and after."""
    history, aside = wall.history, wall.check.mechanism.p_rad_s * ASIDE_S
    impacts = history.impacts.pt
    last = history.shown_to_pt
    if history.overturn_time_pt is None and len(impacts):
        last = min(last, float(impacts[-1]) + aside)
    first = max(0.0, float(impacts[0]) - aside) if len(impacts) else 0.0
    return first, last


def draw_records(wall: WorkedWall, axes: "Axes") -> None:
    """Draw the largest displacement of each record over its largest spectral one."""
    runs, inks, scale = wall.runs, inks_of(axes), line_scale(axes)
    d0 = wall.check.mechanism.d0_m
    spectral, share = wall.spectra_m / d0, runs.share.max(axis=1)
    over = share > 1.0
    axes.set_title("Record by record", pad=15.0)
    axes.axvline(SHARE, color=inks.limit, lw=0.9, ls=DASHED)
    for limit, words in ((SHARE, r"$d_{\mathrm{SLV}}$"), (1.0, "$d_0$")):
        axes.axhline(limit, color=inks.limit, lw=0.9, ls=DASHED)
        axes.annotate(
            words, (1.0, limit), (3.0, 0.0), xycoords=("axes fraction", "data"),
            textcoords="offset points", va="center", color=inks.limit,
            fontsize=text_size(axes, 8.0), annotation_clip=False,
        )  # fmt: skip
    axes.plot(
        spectral[~over], share[~over], "o", ms=4.0 * scale, color=inks.quiet, ls="none",
        label="record that comes back",
    )  # fmt: skip
    if over.any():  # no artist without points: it would take the layout out of its bounds
        axes.plot(
            spectral[over], np.full(int(over.sum()), TOP), "^", ms=6.5 * scale, color=inks.falls,
            mec=inks.edge, ls="none", label="record with a run beyond $d_0$", clip_on=False,
            zorder=4.0,
        )  # fmt: skip
    axes.plot(
        spectral[wall.governing], min(share[wall.governing], TOP), "o", ms=10.0 * scale,
        mfc="none", mec=inks.ink, mew=1.1, ls="none", label="the run below", clip_on=False,
        zorder=5.0,
    )  # fmt: skip
    mean = float(share.mean())
    axes.plot(
        spectral.mean(), min(mean, TOP), "D", ms=6.0 * scale, color=inks.paper, mec=inks.ink,
        mew=1.5, ls="none", zorder=4.5, clip_on=False,
        label="means" if np.isfinite(mean) else r"means; that of the runs is $\infty$",
    )  # fmt: skip
    axes.set(
        xlabel=r"largest $S_D$ up to $T_{\mathrm{SLV}}$, over $d_0$",
        ylabel="largest $d/d_0$ of the runs",
        xlim=(0.0, 1.06 * max(float(spectral.max()), 1.1 * SHARE)),
        ylim=(0.0, TOP + 0.06),
    )
    axes.annotate(
        r"$d_{\mathrm{SLV}}$", (SHARE, 1.0), (0.0, 2.0), xycoords=("data", "axes fraction"),
        textcoords="offset points", ha="center", va="bottom", fontsize=text_size(axes, 8.0),
        color=inks.ink,
    )  # fmt: skip
    draw_legend(axes, "below")
