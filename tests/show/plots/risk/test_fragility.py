"""Pictures of fragility: what is drawn is what was counted, and what is known without a run."""

from functools import cache
from itertools import combinations, pairwise

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from rocksteady import Block, compute_fragility, plots
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import DamageState, Fragility, Levels, RestitutionBand, fit_curve
from rocksteady.show.figures.risk import fragility_figure
from rocksteady.show.style import palette
from rocksteady.show.style.page import Page
from rocksteady.show.style.tokens import DARK, LIGHT, contrast
from tests.every import every

BLOCK = Block.rectangle(width=0.3, height=1.5)


@cache
def found() -> Fragility:
    """PGA says little of such blocks: records lift it at many levels of PGV."""
    return compute_fragility(
        BLOCK,
        make_synthetic_suite(14),
        levels=Levels("pgv_m_s"),
        restitution=RestitutionBand(draws=2),
    )


def axes() -> Axes:
    return Figure(figsize=(6.4, 4.2)).add_subplot()


def lines_of(drawn: Axes) -> list[Line2D]:
    return [line for line in drawn.lines if line.get_linestyle() == "-"]


def points_of(drawn: Axes) -> list[Line2D]:
    return [line for line in drawn.lines if line.get_linestyle() == "None"]


def bars_of(drawn: Axes) -> list[LineCollection]:
    return [each for each in drawn.collections if isinstance(each, LineCollection)]


def test_points_are_the_counts_and_bars_their_intervals() -> None:
    drawn = plots.fragility(found(), axes())
    counted = found().states[1:]
    points, bars = points_of(drawn), bars_of(drawn)
    for state, dots, ends in zip(counted, points, bars, strict=True):
        np.testing.assert_array_equal(np.asarray(dots.get_xdata()), state.curve.levels)
        runs = [count.falls / count.runs for count in state.curve.counts]
        np.testing.assert_allclose(np.asarray(dots.get_ydata()), runs, atol=1e-12)
        for path, level, count in zip(
            ends.get_paths(), state.curve.levels, state.curve.counts, strict=True
        ):
            np.testing.assert_array_equal(
                np.asarray(path.vertices), [[level, count.band[0]], [level, count.band[1]]]
            )
    # States of one level stand side by side, the worst at the level itself.
    places = [dots.get_transform().transform((1.0, 0.5))[0] for dots in points]
    assert places[-1] == pytest.approx(drawn.transData.transform((1.0, 0.5))[0])
    steps = np.diff(places) * 72.0 / drawn.figure.dpi
    np.testing.assert_allclose(steps, steps[0])
    assert 0.5 < steps[0] < 2.0


def test_uplift_is_a_step_at_the_threshold_of_each_record() -> None:
    uplift = lines_of(plots.fragility(found(), axes()))[0]
    x, y = np.asarray(uplift.get_xdata()), np.asarray(uplift.get_ydata())
    runs = found().ensemble
    pgv = runs["level"].values[0] / runs["scale"].values[0, :, 0]
    at = np.sort((runs["uplift_scale"].values[0].reshape(len(pgv), -1).T * pgv).ravel())
    inside = at[(at > x[0]) & (at < x[-1])]
    assert len(inside) > 20
    for threshold in inside:
        below, above = y[x <= threshold * (1.0 - 1e-9)][-1], y[x >= threshold * (1.0 + 1e-9)][0]
        assert below <= (at < threshold * (1.0 - 1e-9)).mean() + 1e-12
        assert above >= (at <= threshold * (1.0 + 1e-9)).mean() - 1e-12
    rises = np.flatnonzero(np.diff(y))
    assert (np.diff(x)[rises] < 1e-9 * x[rises]).all()  # upright, to the last digit


def test_lines_pass_through_the_monotone_shares_and_each_holds_the_next() -> None:
    drawn = plots.fragility(found(), axes())
    low, high = found().states[0].curve.levels[[0, -1]].tolist()
    grid = np.geomspace(low, high, 999)
    shares = []
    for state, line in zip(found().states, lines_of(drawn), strict=True):
        x, y = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
        assert (np.diff(y) >= 0.0).all()
        at = np.interp(np.log(grid), np.log(x), y)
        shares.append(at)
        if state.state.name != "uplift":
            levels = state.curve.levels
            np.testing.assert_allclose(
                y[np.searchsorted(x, levels)],
                np.minimum(state.curve.steps, state.curve.lifting(levels)),
            )
    for more, less in pairwise(shares):
        assert (more >= less - 1e-3).all()


@every("dark", [False, True])
def test_a_state_has_one_hue_and_the_worse_the_stronger(dark: bool) -> None:
    inks = DARK if dark else LIGHT
    with palette.on_paper(inks), palette.style():
        drawn = plots.fragility(found(), axes())
    hues = [to_hex(line.get_color()) for line in lines_of(drawn)]
    assert hues[:-1] == inks.series("motion", 5)[:0:-1]
    assert hues[-1] == inks.series("risk", 5)[0]
    strengths = [contrast(hue, inks.paper) for hue in hues]
    assert strengths == sorted(strengths)
    assert strengths[0] > 4.4
    for hue, points, bars in zip(hues[1:], points_of(drawn), bars_of(drawn), strict=True):
        assert to_hex(points.get_color()) == hue
        assert to_hex(np.asarray(bars.get_color())[0]) == hue
    names = {text.get_text(): to_hex(text.get_color()) for text in drawn.texts}
    assert names == dict(
        zip(
            ["━ lifts", "▲ tilt > 0.25 α", "◆ tilt > 0.5 α", "■ tilt > 1 α", "● falls"],
            hues,
            strict=True,
        )
    )
    assert len({points.get_marker() for points in points_of(drawn)}) == 4


def test_a_state_is_drawn_alone_and_has_the_name_that_it_was_given() -> None:
    (own,) = compute_fragility(
        BLOCK,
        make_synthetic_suite(3),
        levels=Levels("scale", [2.0, 8.0]),
        restitution=RestitutionBand(draws=1),
        states=[DamageState("over$turned_", 0.2)],
    ).states
    drawn = own.plot(axes())
    assert [text.get_text() for text in drawn.texts] == [r"● over\$turned_"]
    assert (drawn.get_xlabel(), len(points_of(drawn))) == ("factor of the records", 1)
    (line,) = lines_of(drawn)
    assert own.curve.shares[0] > 0.0
    assert np.min(line.get_xdata()) == 2.0  # under the lowest level nothing was counted
    fall = found().state("overturned").plot(axes())
    assert to_hex(lines_of(fall)[0].get_color()) == LIGHT.risk


def test_a_fitted_curve_is_drawn_over_its_shares() -> None:
    at, fell = [0.2, 0.4, 0.8, 1.6], [2, 9, 27, 39]
    curve = fit_curve(at, fell, [40] * 4, measure=("PGV", "m/s"))
    drawn = plots.fragility(curve, axes())
    (dots,), (line,) = points_of(drawn), lines_of(drawn)
    pairs = np.column_stack([at, np.array(fell) / 40])
    np.testing.assert_allclose(np.asarray(dots.get_path().vertices), pairs)
    x = np.asarray(line.get_xdata(), dtype=float)
    np.testing.assert_allclose(np.asarray(line.get_ydata()), curve.probability(x))
    assert (x[0], x[-1]) == pytest.approx((0.2, 1.6))  # nothing beyond what was tried
    (name,) = drawn.texts
    assert name.get_text() == f"lognormal\nmedian {curve.median:.3g} m/s\nβ {curve.beta:.3g}"
    assert drawn.get_xlabel() == "PGV [m/s]"


@every(
    ("fell", "word"),
    [
        ([0, 0, 0, 0], "never in any run"),
        ([10, 10, 10, 10], "in every run"),
        ([0, 0, 10, 10], "step between\n0.2 and 0.3 m/s"),
        ([9, 6, 4, 1], "no curve:\ndoes not rise"),
    ],
)
def test_shares_without_a_curve_are_drawn_and_say_so(fell: list[int], word: str) -> None:
    curve = fit_curve([0.1, 0.2, 0.3, 0.4], fell, [10] * 4, measure=("PGV", "m/s"))
    drawn = plots.fragility(curve, axes())
    (dots,) = points_of(drawn)
    np.testing.assert_allclose(np.asarray(dots.get_ydata()) * 10, fell)
    assert [text.get_text() for text in drawn.texts] == [word]


@every("width", [84.0, 170.0])
def test_texts_are_large_enough_inside_the_figure_and_apart(width: float) -> None:
    figure = fragility_figure(found(), page=Page(width_mm=width))
    figure.draw_without_rendering()
    (drawn,) = figure.axes
    low, high = drawn.get_xlim()
    ticks = [*drawn.xaxis.get_major_ticks(), *drawn.yaxis.get_major_ticks()]
    texts = [drawn.xaxis.label, drawn.yaxis.label, *drawn.texts]
    texts += [tick.label1 for tick in ticks if low <= tick.get_loc() <= high or tick.get_loc() == 0]
    boxes = []
    for text in texts:
        assert float(text.get_fontsize()) >= 6.5
        box = text.get_window_extent()
        assert box.x0 >= -1.0, text.get_text()
        assert box.x1 <= figure.bbox.x1 + 1.0, text.get_text()
        boxes.append((text.get_text(), box.shrunk(0.9, 0.6)))
    for (first, box), (second, other) in combinations(boxes, 2):
        assert not box.overlaps(other), (first, second)
