"""Plots of basins and of erosion: each shows the numbers it was given."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import to_hex, to_rgb
from matplotlib.figure import Figure

from rocksteady import Block, DimensionlessBlock, Harmonic, compute_basins, compute_erosion, plots
from rocksteady.basins import Basins, Erosion, find_hilltop_saddles
from rocksteady.model.equations import Nonlinear
from rocksteady.show.figures.single import basins_figure, erosion_figure
from rocksteady.show.plots.portraits.basins import STEPS, areas_of, plain_name, plot_safe_basin
from rocksteady.show.style import palette
from rocksteady.show.style.tokens import DARK, LIGHT, mixed
from tests.every import every

WINDOW = np.linspace(-1.0, 1.0, 41)


@cache
def found(amplitude: float = 0.5, ratio: float = 2.0, restitution: float = 0.95) -> Basins:
    return compute_basins(
        DimensionlessBlock(restitution=restitution),
        Harmonic(amplitude=amplitude, frequency_ratio=ratio, phase=0.4),
        angles=WINDOW,
        velocities=WINDOW,
    )


@cache
def eroded(top: float = 1.0) -> Erosion:
    return compute_erosion(
        DimensionlessBlock(restitution=0.9),
        Harmonic(amplitude=1.0, frequency_ratio=2.0),
        np.linspace(0.1, top, 4),
        angles=WINDOW,
        velocities=WINDOW,
    )


PLOTS: dict[str, Callable[[Axes | None], Axes]] = {
    "basins": lambda ax: plots.basins(found(), ax),
    "mirrored": lambda ax: plots.basins(found(2.0, 1.9, 0.8), ax),
    "erosion": lambda ax: plots.erosion(eroded(), ax),
    "before": lambda ax: plots.erosion(eroded(0.2), ax),
    "safe": lambda ax: plot_safe_basin(eroded(), 2, ax),
}
drawings = every("draw", PLOTS.values())


@drawings
def test_a_plot_draws_on_the_axes_it_is_given_with_its_labels(
    draw: Callable[[Axes | None], Axes],
) -> None:
    axes = Figure().add_subplot()
    assert draw(axes) is axes
    for label in (axes.get_xlabel(), axes.get_ylabel()):
        assert label in palette.LABELS.values()
    assert np.isfinite([*axes.get_xlim(), *axes.get_ylim()]).all()


@drawings
def test_a_plot_makes_axes_of_its_own_and_leaves_the_settings(
    draw: Callable[[Axes | None], Axes],
) -> None:
    settings = dict(mpl.rcParams)
    axes = draw(None)
    try:
        assert plt.gcf() is axes.figure
        assert dict(mpl.rcParams) == settings
    finally:
        plt.close("all")


def colours_seen(axes: Axes) -> "np.ndarray[tuple[int, ...], np.dtype[np.str_]]":
    """The colour of each cell of the picture."""
    (image,) = axes.images
    labels = image.get_array()
    assert labels is not None
    data = image.to_rgba(labels)
    return np.array([[to_hex(cell) for cell in row] for row in data])


def test_each_cell_has_the_fill_of_its_attractor() -> None:
    given = found()
    axes = plots.basins(given, Figure().add_subplot())
    fills = np.array([area.fill for area in areas_of(given.attractors, LIGHT)])
    assert np.array_equal(colours_seen(axes), fills[given.label])
    (image,) = axes.images
    half = 0.5 * (WINDOW[1] - WINDOW[0])
    assert image.get_extent() == pytest.approx((-1.0 - half, 1.0 + half, -1.0 - half, 1.0 + half))
    assert image.origin == "lower"


def test_the_attractors_stand_where_they_are_at_that_phase() -> None:
    given = found()
    axes = plots.basins(given, Figure().add_subplot())
    drawn = {
        (float(x), float(y))
        for line in axes.lines
        for x, y in zip(np.asarray(line.get_xdata()), np.asarray(line.get_ydata()), strict=True)
    }
    expected = [tuple(point) for points in given.stroboscopic for point in points.tolist()]
    assert drawn == set(expected)
    periods = [one.period or int(one.kind.value == "rest") for one in given.attractors]
    assert [len(points) for points in given.stroboscopic] == periods
    # An attractor lies in its own basin.
    for label, points in enumerate(given.stroboscopic):
        for u, v in points:
            column, row = np.abs(given.angle - u).argmin(), np.abs(given.velocity - v).argmin()
            near = given.label[row - 1 : row + 2, column - 1 : column + 2]
            assert label in near


def test_the_legend_has_every_share() -> None:
    given = found()
    legend = plots.basins(given, Figure().add_subplot()).get_legend()
    assert legend is not None
    texts = [text.get_text() for text in legend.get_texts()]
    for text, one, part in zip(texts, given.attractors, given.fractions(), strict=True):
        name = plain_name(one.kind, one.name)
        assert text == f"{name}  {100.0 * part.share:.1f} %"
    assert {"falls", "comes to rest"} <= {text.partition("  ")[0] for text in texts}


def lightness(colour: str) -> float:
    return float(np.dot(to_rgb(colour), (0.2126, 0.7152, 0.0722)))


def test_attractors_of_one_kind_differ_in_lightness() -> None:
    given = found(2.0, 1.9, 0.8)
    for inks in (LIGHT, DARK):
        fills = [area.fill for area in areas_of(given.attractors, inks)]
        assert len(set(fills)) == len(fills) == 3
        assert fills[0] == inks.falls
        light = [lightness(fill) for fill in fills]
        assert min(abs(one - other) for k, one in enumerate(light) for other in light[:k]) > 0.15
        for role in ("symmetric", "unsymmetric", "subharmonic"):
            steps = [lightness(mixed(getattr(inks, role), part)) for part in STEPS]
            assert len({round(step, 2) for step in steps}) == len(steps)


def test_a_block_of_known_size_has_its_window_in_degrees() -> None:
    block = Block.rectangle(width=0.4, height=2.0, restitution=0.95)
    motion = Harmonic(amplitude=0.5, frequency_ratio=2.0, phase=0.4)
    sized = compute_basins(block, motion, angles=WINDOW, velocities=WINDOW)
    axes = plots.basins(sized, Figure(figsize=(8.0, 5.0)).add_subplot())
    assert axes.get_xlabel() == palette.LABELS["angle_deg_at_start"]
    assert axes.get_ylabel() == palette.LABELS["velocity_deg_s_at_start"]
    degree = np.degrees(block.alpha)
    half = 0.5 * (WINDOW[1] - WINDOW[0])
    assert np.array(axes.get_xlim()) / degree == pytest.approx([-1.0 - half, 1.0 + half])
    assert np.array(axes.get_ylim()) / (degree * block.p) == pytest.approx(
        [-1.0 - half, 1.0 + half]
    )
    marks = np.concatenate([line.get_xydata() for line in axes.lines[1::2]])
    expected = np.concatenate(sized.stroboscopic) * (degree, degree * block.p)
    np.testing.assert_allclose(marks, expected)
    # What is drawn upon it later is in its units.
    saddles = find_hilltop_saddles(block, motion)
    plots.edge_state(saddles[0], axes)
    highest = max(float(np.max(line.get_xdata())) for line in axes.lines)
    assert highest > 1.05 * degree > 5.0


def test_words_keep_clear_of_the_attractors() -> None:
    axes = plots.basins(found(), Figure(figsize=(8.0, 5.0)).add_subplot())
    axes.get_figure(root=True).draw_without_rendering()  # type: ignore[union-attr]
    boxes = [word.get_window_extent() for word in axes.texts]
    assert boxes
    points = axes.transData.transform(np.concatenate(found().stroboscopic))
    assert not any(box.contains(*point) for box in boxes for point in points)


def test_the_erosion_is_drawn_with_its_threshold_and_drops() -> None:
    given = eroded()
    drops = [
        drop for name in ("integrity_factor", "global_integrity") if (drop := given.drop(name))
    ]
    axes = plots.erosion(given, Figure().add_subplot(), drops=drops)
    factor, area, threshold, *marks = axes.lines
    for line, name in ((factor, "integrity_factor"), (area, "global_integrity")):
        drawn = dict(zip(*(np.asarray(each).tolist() for each in line.get_data()), strict=True))
        known = dict(zip(given.amplitude.tolist(), given.measure(name).tolist(), strict=True))
        assert known.items() <= drawn.items()
    assert set(np.asarray(threshold.get_xdata()).tolist()) == {given.heteroclinic}
    assert len(marks) == len(drops) == 2
    for mark, drop in zip(marks, drops, strict=True):
        (where,) = np.asarray(mark.get_xdata()).tolist()
        assert drop.low < where < drop.high
        line = factor if drop.measure == "integrity_factor" else area
        x, y = (np.asarray(each, dtype=float) for each in line.get_data())
        height = np.interp(where, x, y)
        assert np.asarray(mark.get_ydata()).tolist() == [drop.level] == [pytest.approx(height)]


def test_a_threshold_beyond_the_axis_is_said() -> None:
    legend = plots.erosion(eroded(0.2), Figure().add_subplot()).get_legend()
    assert legend is not None
    assert any(text.get_text().endswith("(beyond)") for text in legend.get_texts())


def test_without_a_threshold_there_is_no_line_of_it() -> None:
    given = replace(eroded(), block=Block.from_p(alpha=0.2, p=2.0), model=Nonlinear())
    axes = plots.erosion(given, Figure().add_subplot())
    assert len(axes.lines) == 2
    legend = axes.get_legend()
    assert legend is not None
    assert not any("tangency" in text.get_text() for text in legend.get_texts())
    assert len(erosion_figure(given).axes) >= 2


def test_safe_states_are_light() -> None:
    given = eroded()
    seen = colours_seen(plot_safe_basin(given, 1, Figure().add_subplot()))
    assert np.array_equal(seen == LIGHT.paper, given.safe[1])


def test_figures_have_a_title_and_their_panels() -> None:
    assert len(basins_figure(found(), "a title").axes) == 1
    given = eroded()
    drop = given.drop()
    assert drop is not None
    figure = erosion_figure(given, [drop], "a title")
    assert len(figure.axes) >= 3
    assert figure.get_suptitle() == "a title"


def test_amplitudes_spaced_by_ratio_get_a_logarithmic_axis() -> None:
    window = np.linspace(-1.4, 1.4, 15)
    block = DimensionlessBlock(restitution=0.9)
    for amplitudes, scale in (([0.01, 0.1, 1.0], "log"), ([0.1, 0.55, 1.0], "linear")):
        found = compute_erosion(
            block,
            Harmonic(amplitude=1.0, frequency_ratio=2.0),
            amplitudes,
            angles=window,
            velocities=window,
        )
        axes = plots.erosion(found, Figure().add_subplot())
        assert axes.get_xscale() == scale
        assert axes.get_xlim() == (amplitudes[0] if scale == "log" else 0.0, 1.0)
