"""Plots of tests by record: at which gain what fell, and what was predicted of it."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import whole_number
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.show.plots.observations._rows import CROWDED, name_rows
from rocksteady.show.style.areas import risk_swatches
from rocksteady.show.style.layout import axes_or_new, plain_ticks
from rocksteady.show.style.legends import LegendPlace, draw_legend, line_scale, place_of
from rocksteady.show.style.tokens import Inks, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes


MOST = 40
"""Rows of a picture."""
TALL = 0.36
"""Half the height of a strip, in rows."""
APART = 1.12
"""Least factor by which a picture goes beyond the smallest and the largest gain."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Rung:
    """The tests of one object under one record, the weakest first.

    Attributes
    ----------
    name
        Name of the record, and of the object where it shook several.
    at
        Gains, or peak accelerations [g], shape (tests,).
    p
        Predicted probabilities of falling, shape (tests,).
    fell
        Outcomes, shape (tests,).
    """

    name: str
    at: Floats
    p: Floats
    fell: NDArray[np.bool_]

    @property
    def even(self) -> float:
        """Logarithm of where falling is as likely as standing, beyond the ends by the odds."""
        odds = np.log(np.clip(self.p, 1e-3, 0.999) / (1.0 - np.clip(self.p, 1e-3, 0.999)))
        return float(np.mean(np.log(self.at) - 0.15 * odds))


@checked
def plot_test_ladders(
    calibration: Calibration,
    ax: "Axes | None" = None,
    *,
    first: int = 0,
    most: int = MOST,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw the tests of each record over the gain, with the predicted probability behind them.

    Each row is a record, the strongest at the bottom; its shade is the probability of falling that
    the tests of other groups give.  Where every record was run at one gain the abscissa is the peak
    acceleration.

    Parameters
    ----------
    calibration
        From `rocksteady.calibrate`.
    ax
        Axes to draw on; default: axes of a new figure.
    first, most
        Row at the top, and the number of rows; default 0 and 40.
    legend
        "inside" the axes, to their "right", "below" them (default) or "none".

    Returns
    -------
    matplotlib.axes.Axes
        The axes: gain on a logarithmic scale, and a row for each record.

    Raises
    ------
    InputError
        If there is no such row.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, Linear, calibrate
    >>> from rocksteady.calibration import make_synthetic_tests
    >>> from rocksteady.motions import make_synthetic_suite
    >>> column = Block.rectangle(width=0.15, height=0.6)
    >>> tests = make_synthetic_tests(column, make_synthetic_suite(4), model=Linear())
    >>> calibration = calibrate(tests, most_runs=200, model=Linear())
    >>> axes = plot_test_ladders(calibration, Figure().add_subplot())
    >>> axes.get_xscale()
    'log'
    """
    hint = "give a number of rows, as 40"
    begin = whole_number("first", first, at_least=0, hint=hint)
    count = whole_number("most", most, at_least=1, hint=hint)
    rungs, label = rungs_of(calibration)
    shown = rungs[begin : begin + count]
    if not shown:
        raise InputError(
            "first", Words(f"is {begin}"), f"there are {len(rungs)} rows", "give a smaller number"
        )
    axes = axes_or_new(ax)
    inks, place = inks_of(axes), place_of(axes, legend, "below")
    ends = np.concatenate([each.at for each in rungs])
    limits = float(ends.min()) / APART, float(ends.max()) * APART
    _draw_strips(axes, shown, limits, inks)
    handles = _draw_marks(axes, shown, inks, line_scale(axes))
    axes.set_xscale("log")
    axes.set(xlim=limits, xlabel=label)
    plain_ticks(axes)
    name_rows(axes, [each.name for each in shown])
    draw_legend(axes, place, handles=[*handles, *risk_swatches(inks, "predicted {}", 0.4)])
    return axes


def rungs_of(calibration: Calibration) -> tuple[list[Rung], str]:
    """Return the rows of all records, the weakest record first, and the abscissa."""
    tests, predictions = calibration.tests.tests, calibration.validation.predictions
    p = np.asarray(predictions.p, dtype=np.float64)
    rows: dict[tuple[str, str], list[int]] = {}
    for place, test in enumerate(tests):
        if test.fell is not None and np.isfinite(p[place]):
            rows.setdefault((test.record.name or test.group or "", test.object), []).append(place)
    gains = np.array([test.gain for test in tests])
    climbs = any(len(set(gains[places].tolist())) > 1 for places in rows.values())
    if climbs:
        at, label = gains, "gain on the record"
    else:
        peaks = [test.record.peak_acceleration_m_s2 for test in tests]
        at, label = gains * np.array(peaks) / STANDARD_GRAVITY, "peak acceleration [g]"
    counts = Counter(record for record, _ in rows)
    rungs = []
    for (record, body), places in rows.items():
        order = np.array(places)[np.argsort(at[places], kind="stable")]
        rungs.append(
            Rung(
                name=f"{record}, {body}" if counts[record] > 1 else record,
                at=at[order],
                p=p[order],
                fell=np.array([bool(tests[place].fell) for place in order]),
            )
        )
    return sorted(rungs, key=lambda rung: (-rung.even, rung.name)), label


def _draw_strips(
    axes: "Axes", rungs: Sequence[Rung], limits: tuple[float, float], inks: Inks
) -> None:
    """Shade each row by what was predicted, halfway to the next test."""
    from matplotlib.collections import PolyCollection

    boxes, shades = [], []
    for row, rung in enumerate(rungs):
        levels, place = np.unique(rung.at, return_inverse=True)
        mean = np.bincount(place, rung.p) / np.bincount(place)
        middles = np.sqrt(levels[1:] * levels[:-1])
        step = float(np.sqrt(levels[1:] / levels[:-1]).min(initial=APART))
        low = max(limits[0], levels[0] / max(step, 1.03))
        high = min(limits[1], levels[-1] * max(step, 1.03))
        edges = [low, *middles.tolist(), high]
        for left, right, p in zip(edges[:-1], edges[1:], mean.tolist(), strict=True):
            top, foot = row - TALL, row + TALL
            boxes.append([(left, top), (right, top), (right, foot), (left, foot)])
            shades.append(inks.risk_step(p))
    strips = PolyCollection(boxes, facecolors=shades, edgecolors=inks.edge, lw=0.3, zorder=1.5)
    axes.add_collection(strips, autolim=False)


def _draw_marks(axes: "Axes", rungs: Sequence[Rung], inks: Inks, size: float) -> list[Any]:
    """Draw outcomes, and rings about unexpected ones; return their entries."""
    from matplotlib.patheffects import withStroke

    x, y, fell, missed = [], [], [], []
    for row, rung in enumerate(rungs):
        for level in np.unique(rung.at):
            places = np.flatnonzero(rung.at == level)
            offsets = 0.2 * (np.arange(len(places)) - 0.5 * (len(places) - 1))
            offsets *= min(1.0, 2.0 / max(len(places) - 1, 1))
            x += [level] * len(places)
            y += (row + offsets).tolist()
            fell += rung.fell[places].tolist()
            missed += ((rung.p[places] >= 0.5) != rung.fell[places]).tolist()
    across, up, down, wrong = np.array(x), np.array(y), np.array(fell), np.array(missed)
    mark = (5.5 if len(rungs) <= CROWDED else 4.6) * size
    entries = []
    # A dot is seen on any shade: where it is dark its edge is not.
    for which, shape, face, edge, words in (
        (down, "o", inks.observed, inks.paper, "fell"),
        (~down, "s", inks.paper, inks.observed, "stood"),
    ):
        entries += axes.plot(
            across[which], up[which], shape, ms=mark, color=face, mec=edge, mew=0.9, label=words,
            zorder=3.0,
        )  # fmt: skip
    rings = axes.plot(
        across[wrong], up[wrong], "o", ms=2.0 * mark, mfc="none", mec=inks.observed,
        mew=1.4 * size, label="not expected", zorder=3.2,
        path_effects=[withStroke(linewidth=1.4 * size + 2.0, foreground=inks.paper)],
    )  # fmt: skip
    return [*entries, *(rings if wrong.any() else [])]
