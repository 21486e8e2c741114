"""Crowded corners, bars with names, triangles on curves, pulses without teeth, a key clear of a
falling block, and names of others shown as they are.
"""

from dataclasses import replace

import matplotlib as mpl

mpl.use("Agg")

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.path import Path as Outline

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Record,
    compute_response_curve,
    find_orbits,
    find_overturning_windows,
    plots,
    simulate,
)
from rocksteady.branches import find_branches
from rocksteady.measures import compute_response_spectrum
from rocksteady.overturning import OverturningWindows
from rocksteady.show.export.files import figure_bytes
from rocksteady.show.figures.single import bifurcation_figure, simulation_figure
from rocksteady.show.film.animation import film_of
from rocksteady.show.plots.branches._sweeps import SIZE
from rocksteady.show.style.escaping import literal
from rocksteady.show.style.insets import crowd_of
from rocksteady.show.style.page import Page
from tests.every import every
from tests.show.drawn_figures import resting, rocking, shock
from tests.show.plots.branches.test_bifurcations import MARKS, diagram_of, over_frequency, sweeps

BARE = DimensionlessBlock(restitution=0.8)
NAMES = (
    r"$\frac{$.at2",
    "$a$",
    "_hidden",
    "50 %_of #1 & ^2~",
    r"back\slash $ and \$",
    "two\nlines\ttab",
    "wave 波",
    "cut \udcff off",
    "x" * 300,
    r"\alpha",
    "{}",
    "$",
    "",
)


def marks_of(axes: Axes) -> np.ndarray:
    places = [line.get_xydata() for line in axes.lines if line.get_marker() in MARKS]
    return np.concatenate([np.asarray(each, dtype=float) for each in places])


def crowded() -> Axes:
    """Branches of which nearly all are born in a corner of the picture."""
    starts = find_orbits(
        BARE, Harmonic(amplitude=1.05, frequency_ratio=2.0), max_period=2, seeds=16
    )
    smooth = [orbit for orbit in starts if not orbit.rest_phases]
    branches = find_branches(smooth, "amplitude", (0.1, 3.0), max_period=2)
    figure = Figure(figsize=(8.8, 4.8), layout="constrained")
    return plots.bifurcations(branches, ax=figure.add_subplot())


@pytest.mark.slow
def test_bifurcations_that_crowd_are_drawn_again_and_apart() -> None:
    axes = crowded()
    inset: Axes = axes.child_axes[0]  # type: ignore[assignment]
    figure = axes.get_figure(root=True)
    assert figure is not None
    figure.draw_without_rendering()
    (x0, x1), (y0, y1) = inset.get_xlim(), inset.get_ylim()
    every = marks_of(axes)
    within = every[((every > (x0, y0)) & (every < (x1, y1))).all(axis=1)]
    assert len(within) >= 8
    grown = [np.ptp(each.transData.transform(within), axis=0) for each in (axes, inset)]
    assert (grown[1] > 1.5 * grown[0]).any()
    assert len(marks_of(inset)) == len(every), "the same marks, cut off by the limits"
    # The inset hides hardly a mark.
    box = inset.get_window_extent()
    hidden = [box.contains(x, y) for x, y in axes.transData.transform(every)]
    assert np.mean(hidden) < 0.05


def test_bifurcations_apart_have_no_inset() -> None:
    axes = plots.bifurcations(over_frequency(), ax=Figure(figsize=(8.8, 4.8)).add_subplot())
    assert not axes.child_axes


def test_a_crowd_is_the_largest_one_and_small() -> None:
    axes = Figure(figsize=(8.0, 5.0)).add_subplot(xlim=(0.0, 10.0), ylim=(0.0, 10.0))
    some = [(0.1 * k, 0.05 * k) for k in range(10)]
    assert crowd_of(axes, some) == pytest.approx((0.0, 0.0, 0.9, 0.45))
    assert crowd_of(axes, some[:7]) is None
    assert crowd_of(axes, [(k, k) for k in range(10)]) is None
    assert crowd_of(axes, [(0.2 * k, 0.0) for k in range(40)]) is None, "too wide to grow"
    assert crowd_of(axes, []) is None


@pytest.mark.slow
def test_bifurcations_low_on_a_wide_axis_have_a_logarithmic_one() -> None:
    starts = find_orbits(BARE, Harmonic(amplitude=2.0, frequency_ratio=2.2), max_period=1)
    branches = find_branches(starts, "frequency_ratio", (0.5, 12.0), max_period=4)
    axes = plots.bifurcations(branches, ax=Figure(figsize=(8.8, 4.8)).add_subplot())
    assert axes.get_xscale() == "log"


@pytest.mark.slow
def test_a_sweep_is_a_thin_rim_and_its_bars_have_a_name() -> None:
    assert SIZE < 4.5
    diagram = replace(diagram_of(over_frequency(), "frequency_ratio"), sweeps=sweeps())
    for page in (Page(), Page(width_mm=84.0)):
        figure = bifurcation_figure(diagram, page=page)
        figure.draw_without_rendering()
        (axes,) = (each for each in figure.axes if each.get_xlabel())
        names = [text for text in axes.texts if text.get_text() in ("up", "down")]
        assert [text.get_text() for text in names] == ["up", "down"]
        first, second = (text.get_window_extent() for text in names)
        assert first.y0 >= second.y1 - 2.0, "one above the other"
        assert not any(line.get_clip_on() is False for line in axes.lines), "no stray dots"


def ways_at(axes: Axes, x: float, y: float) -> int:
    """Return how many filled areas cover a point."""
    return sum(
        Outline(np.asarray(path.vertices)).contains_point((x, y))
        for each in axes.collections
        if isinstance(each, PolyCollection)
        for path in each.get_paths()
    )


def leaning(count: int) -> OverturningWindows:
    return find_overturning_windows(
        DimensionlessBlock(restitution=0.9),
        "ricker",
        np.linspace(0.8, 1.8, count),
        within=(2.5, 9.0),
    )


@pytest.mark.slow
def test_a_narrow_window_that_leans_is_a_band_and_no_stairs() -> None:
    windows = leaning(12)
    axes = plots.overturning(windows, Figure().add_subplot())
    # The finer spectrum tells what overturns between the frequencies of the coarse one.
    fine = leaning(23)
    met = 0
    for k in range(1, 23, 2):
        for window in fine.at(k):
            if min(window.impacts, 2) == 2 and 1.01 < window.high / window.low < 1.2:
                middle = float(np.sqrt(window.low * window.high))
                met += ways_at(axes, float(fine.frequency_ratio[k]), middle) > 0
    between = sum(
        any(min(w.impacts, 2) == 2 and 1.01 < w.high / w.low < 1.2 for w in fine.at(k))
        for k in range(1, 23, 2)
    )
    assert between >= 4
    assert met >= between - 1


def test_a_block_that_never_moves_says_so_in_its_phase_plane() -> None:
    axes = plots.phase_portrait(resting(), Figure().add_subplot())
    assert "never lifts" in axes.texts[0].get_text()
    assert axes.get_xlim() == (-1.0, 1.0)


@every("amplitude", [2.5, 4.0, 8.0])
def test_the_key_of_a_film_is_clear_of_the_block_at_every_moment(amplitude: float) -> None:
    run = simulate(BARE, Harmonic(amplitude=amplitude, frequency_ratio=1.5), cycles=6)
    film = film_of(run)
    film.figure.draw_without_rendering()
    legend = film.scene.axes.get_legend()
    assert legend is not None
    key = legend.get_window_extent()
    for frame in range(0, len(film.reel.times), 5):
        film.show(frame)
        body = film.scene.body.get_window_extent()
        assert not key.overlaps(body)
        words = [film.scene.clock, film.scene.tilt, film.scene.push, film.scene.verdict]
        for text in words:
            if text.get_text():
                assert not text.get_window_extent().overlaps(body), text.get_text()


def test_more_curves_than_colours_differ_by_marks() -> None:
    curves = [
        compute_response_curve(BARE, a, frequency_ratio=np.linspace(1.0, 8.0, 60))
        for a in np.linspace(1.0, 4.0, 14)
    ]
    axes = plots.response(curves, Figure().add_subplot())
    looks = {
        (line.get_color(), line.get_marker())
        for line in axes.lines
        if str(line.get_label()).startswith("A =")
    }
    assert len(looks) == 14


@pytest.mark.slow
@every("name", NAMES[::2])
def test_a_name_from_outside_is_shown_as_it_is(name: str) -> None:
    spectra = [compute_response_spectrum(shock(each), [0.1, 0.3, 1.0]) for each in (name, "other")]
    axes = plots.response_spectra(spectra, Figure().add_subplot())
    legend = axes.get_legend()
    names = [*axes.texts, *(legend.get_texts() if legend is not None else ())]
    named = [text for text in names if "damping" not in text.get_text()]
    assert len(named) == 3, "a name for each, and the mean"
    run = simulate(
        Block.rectangle(width=0.4, height=1.6),
        Record(acceleration_m_s2=shock().acceleration_m_s2, dt_s=0.01, name=name),
    )
    figure = film_of(run, speed=1.0).figure
    for text in (*names, *figure.texts):
        assert "$" not in text.get_text().replace(r"\$", ""), "no mathematics"
    drawn = simulation_figure(rocking(), name)
    for kind in ("png", "svg", "pdf"):
        assert figure_bytes(drawn, kind)


def test_text_that_is_no_mathematics_stays_what_it_is() -> None:
    for text in ("$x$", r"\$", "a_b", "50 %", r"$\frac{$", "^", "{"):
        shown = literal(text)
        # What Matplotlib makes of it: an escaped dollar sign is a dollar sign.
        assert shown.replace(r"\$", "$").lstrip("\N{ZERO WIDTH SPACE}") == text
    assert literal("one two three", line=7) == "one two\nthree"
