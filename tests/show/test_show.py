"""Pictures: what each draws, its labels, its files, and that it leaves matplotlib as it was."""

import contextlib
import itertools
import math
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    State,
    Status,
    Steady,
    Still,
    compute_response_curve,
    plots,
    simulate,
)
from rocksteady.errors import InputError
from rocksteady.formulas import steady_states
from rocksteady.histories import Trajectory
from rocksteady.orbits import (
    RegionMap,
    ResponseCurve,
    SteadyOrbit,
    compute_region_map,
    compute_steady_orbit,
)
from rocksteady.show.figures.single import response_figure, simulation_figure, steady_figure
from rocksteady.show.style import palette
from rocksteady.show.style.layout import region_centres
from rocksteady.show.style.page import Page
from rocksteady.show.style.tokens import DARK, DASHED, DOTTED, LIGHT, inks_of
from tests.every import every
from tests.public.calls import calls

BARE = DimensionlessBlock(restitution=0.8)
BLOCK = Block.from_p(alpha=0.2, p=2.0 * math.pi, restitution=0.8)


def rocking() -> Trajectory:
    return simulate(BARE, Harmonic(amplitude=2.0, frequency_ratio=4.0), cycles=10)


def overturning() -> Trajectory:
    return simulate(BARE, Harmonic(amplitude=2.0, frequency_ratio=1.7), start=Steady(), cycles=40)


def coming_to_rest() -> Trajectory:
    return simulate(BLOCK, Still(), start=State(angle=0.6, velocity=0.0))


def curves() -> RegionMap:
    return compute_region_map(np.linspace(0.1, 14.0, 200), 0.5, order=3)


def responses() -> list[ResponseCurve]:
    hertz = np.linspace(1.0, 8.0, 60)
    return [compute_response_curve(BLOCK, a, frequency_hz=hertz) for a in (1.0, 2.0, 3.0)]


def orbit() -> SteadyOrbit:
    return compute_steady_orbit(2.0, 6.0, 0.8, order=3)


PLOTS: dict[str, Callable[[Axes | None], Axes]] = {
    "trajectory": lambda ax: plots.trajectory(rocking(), ax),
    "overturning": lambda ax: plots.trajectory(overturning(), ax),
    "rest": lambda ax: plots.trajectory(coming_to_rest(), ax),
    "base": lambda ax: plots.base(rocking(), ax),
    "portrait": lambda ax: plots.phase_portrait(rocking(), ax),
    "orbit": lambda ax: plots.steady_orbit(orbit(), ax),
    "regions": lambda ax: plots.steady_regions(curves(), ax, point=(6.0, 2.0)),
    "response": lambda ax: plots.response(responses(), ax),
    "hertz": lambda ax: plots.response(responses(), ax, hertz=True),
}
FIGURES: dict[str, Callable[[], Figure]] = {
    "simulation": lambda: simulation_figure(rocking(), "title"),
    "fall": lambda: simulation_figure(overturning()),
    "rest": lambda: simulation_figure(coming_to_rest()),
    "steady": lambda: steady_figure([("branch 1", orbit())], curves(), point=(6.0, 2.0)),
    "nothing": lambda: steady_figure([], curves(), point=(6.0, 0.1), title="title"),
    "response": lambda: response_figure(responses(), hertz=True, title="title"),
}
MAGIC = {"png": b"\x89PNG\r\n", "svg": b"<?xml", "pdf": b"%PDF"}
"""How a file of each ending begins."""
drawings = pytest.mark.parametrize("draw", PLOTS.values(), ids=PLOTS)
figures = pytest.mark.parametrize("make", FIGURES.values(), ids=FIGURES)


@pytest.fixture(autouse=True)
def matplotlib_left_as_it_was() -> Iterator[None]:
    """No picture may change a setting of its user, nor leave a figure in pyplot behind."""
    settings = dict(mpl.rcParams)
    open_figures = plt.get_fignums()
    yield
    assert dict(mpl.rcParams) == settings
    assert plt.get_fignums() == open_figures


@drawings
def test_a_plot_draws_on_the_axes_it_is_given_and_returns_them(
    draw: Callable[[Axes | None], Axes],
) -> None:
    axes = Figure().add_subplot()
    assert draw(axes) is axes
    assert axes.lines
    assert any(len(np.asarray(line.get_xdata())) > 2 for line in axes.lines)
    limits = [*axes.get_xlim(), *axes.get_ylim()]
    assert np.isfinite(limits).all()
    assert limits[0] < limits[1]
    assert limits[2] < limits[3]


@drawings
def test_a_plot_makes_axes_of_its_own_where_none_are_given(
    draw: Callable[[Axes | None], Axes],
) -> None:
    axes = draw(None)
    try:
        assert plt.gcf() is axes.figure
        assert not axes.spines["top"].get_visible(), "in the house style"
    finally:
        plt.close(axes.figure)  # type: ignore[arg-type]


@drawings
def test_both_axes_say_quantity_and_unit(draw: Callable[[Axes | None], Axes]) -> None:
    axes = draw(Figure().add_subplot())
    for label in (axes.get_xlabel(), axes.get_ylabel()):
        # a unit in brackets, or the ratio or dimensionless group in symbols
        assert re.search(r"\[[^\]]+\]|\$.*\$", label), label
        assert label in palette.LABELS.values()


def test_the_time_axis_has_the_unit_of_the_run() -> None:
    free = simulate(BARE, Still(), start=State(angle=0.5, velocity=0.0))
    shaken = simulate(BLOCK, Harmonic(amplitude=2.0, frequency_ratio=4.0), cycles=5)
    for run, label, scale in (
        (rocking(), "periods", 4.0 / (2.0 * math.pi)),
        (shaken, "seconds", 1.0 / BLOCK.p),
        (coming_to_rest(), "seconds", 1.0 / BLOCK.p),
        (free, "pivot_time", 1.0),
    ):
        axes = plots.trajectory(run, Figure().add_subplot())
        assert axes.get_xlabel() == palette.LABELS[label]
        assert axes.get_xlim()[1] == pytest.approx(run.times()[-1] * scale)


def test_the_time_history_is_the_trajectory_with_all_its_impacts() -> None:
    run = rocking()
    axes = plots.trajectory(run, Figure().add_subplot())
    drawn = {len(np.asarray(line.get_xdata())): line for line in axes.lines}
    times = run.times()
    np.testing.assert_array_equal(drawn[len(times)].get_ydata(), run(times).angle)
    impacts = drawn[len(run.impacts)]
    np.testing.assert_allclose(
        np.asarray(impacts.get_xdata(), dtype=float), run.impacts.pt * 4.0 / (2.0 * math.pi)
    )
    assert f"{len(run.impacts)} impacts" in legend_of(axes)


def legend_of(axes: Axes) -> list[str]:
    legend = axes.get_legend()
    assert legend is not None
    return [text.get_text() for text in legend.get_texts()]


def test_words_on_the_end_lie_in_axes_that_a_caller_has_made_longer() -> None:
    for run in (overturning(), coming_to_rest()):
        whole = plots.trajectory(run, Figure().add_subplot()).get_xlim()
        axes = Figure().add_subplot()
        axes.set_xlim(0.0, 6.0 * whole[1])
        plots.trajectory(run, axes)
        assert axes.get_xlim() == (0.0, 6.0 * whole[1])
        (words,) = (text for text in axes.texts if re.match("falls|at rest", text.get_text()))
        box = words.get_window_extent()
        assert axes.bbox.x0 <= box.x0 < box.x1 <= axes.bbox.x1


def test_the_end_is_marked() -> None:
    fall = overturning()
    assert fall.status is Status.OVERTURNED
    axes = plots.trajectory(fall, Figure().add_subplot())
    assert fall.overturn_time_pt is not None
    periods = fall.overturn_time_pt * 1.7 / (2.0 * math.pi)
    assert f"falls at {periods:.3g} periods" in texts_of(axes)
    assert axes.get_ylim()[1] > 1.5
    rest = coming_to_rest()
    assert rest.rest_time_s is not None
    axes = plots.trajectory(rest, Figure().add_subplot())
    assert f"at rest from {rest.rest_time_s:.3g} s" in texts_of(axes)
    upright = [line for line in axes.lines if np.ptp(np.asarray(line.get_xdata(), float)) == 0.0]
    assert np.asarray(upright[0].get_xdata())[0] == pytest.approx(rest.rest_time_s)
    assert len(legend_of(plots.trajectory(rocking(), Figure().add_subplot()))) == 1


def texts_of(axes: Axes) -> list[str]:
    return [text.get_text() for text in axes.texts]


def test_a_block_of_known_size_is_drawn_in_degrees_seconds_and_g() -> None:
    run = simulate(BLOCK, Harmonic(amplitude=2.0, frequency_ratio=4.0), cycles=5)
    degrees, p = math.degrees(BLOCK.alpha), BLOCK.p
    history = plots.trajectory(run, Figure().add_subplot())
    motion = run(run.times())
    (course,) = (line for line in history.lines if len(np.asarray(line.get_xdata())) > 100)
    np.testing.assert_allclose(np.asarray(course.get_xdata(), dtype=float), motion.pt / p)
    np.testing.assert_allclose(np.asarray(course.get_ydata(), dtype=float), motion.angle * degrees)
    assert (history.get_xlabel(), history.get_ylabel()) == ("time [s]", palette.LABELS["angle_deg"])
    portrait = plots.phase_portrait(run, Figure().add_subplot())
    angle, velocity = run.phase_path()
    np.testing.assert_allclose(
        np.asarray(portrait.lines[0].get_xdata(), dtype=float), angle * degrees
    )
    np.testing.assert_allclose(
        np.asarray(portrait.lines[0].get_ydata(), dtype=float), velocity * degrees * p
    )
    for quantity, unit in (("acceleration", 1.0), ("velocity", 9.80665 / p)):
        axes = plots.base(run, Figure().add_subplot(), quantity=quantity)  # type: ignore[arg-type]
        drawn = np.asarray(axes.lines[0].get_ydata(), dtype=float)
        top = 2.0 if quantity == "acceleration" else 2.0 / 4.0
        assert drawn.max() == pytest.approx(top * BLOCK.alpha * unit, rel=1e-3)


def test_the_dimensionless_scale_is_on_the_far_side_where_there_is_room() -> None:
    run = simulate(BLOCK, Harmonic(amplitude=2.0, frequency_ratio=4.0), cycles=5)
    axes = plots.trajectory(run, Figure().add_subplot())
    far = {each.get_xlabel() or each.get_ylabel(): each for each in axes.child_axes}
    assert set(far) == {palette.LABELS["periods"], palette.LABELS["angle"]}
    axes.figure.draw_without_rendering()  # type: ignore[union-attr]
    assert far[palette.LABELS["periods"]].get_xlim()[1] == pytest.approx(5.0)
    near = np.array(axes.get_ylim()) / math.degrees(BLOCK.alpha)
    np.testing.assert_allclose(far[palette.LABELS["angle"]].get_ylim(), near)
    for figure in (Figure(figsize=(3.3, 3.0)), Figure(figsize=(8.0, 1.6))):
        assert not plots.trajectory(run, figure.add_subplot()).child_axes
    assert not plots.trajectory(rocking(), Figure().add_subplot()).child_axes


def test_limits_are_dashed_and_named_on_their_line() -> None:
    for draw, name, level in (
        (plots.trajectory, "tipping angle", math.degrees(BLOCK.alpha)),
        (plots.base, "lifts off", math.tan(BLOCK.alpha)),
    ):
        axes: Any = draw(coming_to_rest(), Figure().add_subplot())
        (words,) = (text for text in axes.texts if text.get_text() == name)
        assert words.xy[1] == pytest.approx(level)
        assert words.get_color() == inks_of(axes).ink
        dashed = [line for line in axes.lines if line.get_linestyle() == "--"]
        heights = sorted(float(np.ravel(line.get_ydata())[0]) for line in dashed)
        assert heights == pytest.approx([-level, level])
        assert {line.get_color() for line in dashed} == {inks_of(axes).limit}


@pytest.mark.parametrize("run", [rocking, overturning, coming_to_rest])
@pytest.mark.parametrize("width_mm", [84.0, pytest.param(174.0, marks=pytest.mark.slow)])
def test_the_words_of_a_history_are_apart(run: Callable[[], Trajectory], width_mm: float) -> None:
    figure = simulation_figure(run(), page=Page(width_mm=width_mm))
    figure.draw_without_rendering()
    for axes in figure.axes:
        legend = axes.get_legend()
        boxes = [text.get_window_extent() for text in axes.texts]
        boxes += [legend.get_window_extent()] if legend is not None else []
        for one, other in itertools.combinations(boxes, 2):
            assert not one.padded(-1.0).overlaps(other.padded(-1.0))


def test_a_block_that_falls_from_one_side_does_not_leave_half_the_picture_empty() -> None:
    for sign in (1.0, -1.0):
        start = State(angle=1.2 * sign, velocity=0.0)
        axes = plots.trajectory(simulate(BARE, Still(), start=start), Figure().add_subplot())
        low, high = axes.get_ylim()
        assert (low if sign > 0.0 else high) == pytest.approx(-1.15 * sign, rel=0.5)
        assert (high if sign > 0.0 else -low) > 2.0
        assert axes.get_xlim()[0] < 0.0, "the mark of the fall at time 0 is whole"
        assert "falls from the start" in texts_of(axes)
        assert axes.get_legend() is None, "no impacts are counted"


def test_one_impact_is_singular() -> None:
    axes = plots.trajectory(
        simulate(BARE, Harmonic(amplitude=2.0, frequency_ratio=4.0), cycles=1.2),
        Figure().add_subplot(),
    )
    assert legend_of(axes) == ["1 impact"]


@pytest.mark.parametrize("draw", [PLOTS[name] for name in ("trajectory", "portrait")])
def test_a_legend_stays_inside_its_axes(draw: Callable[[Axes | None], Axes]) -> None:
    figure = Figure(figsize=(10.0, 8.0))
    axes = draw(figure.subplots(2, 2)[1, 0])
    figure.canvas.draw()
    legend = axes.get_legend()
    assert legend is not None
    frame, box = legend.get_window_extent(), axes.get_window_extent()
    assert box.x0 <= frame.x0 < frame.x1 <= box.x1
    assert box.y0 <= frame.y0 < frame.y1 <= box.y1


def words_module(axes: Axes) -> list[str]:
    return [text.get_text() for text in axes.texts]


BOUNDARIES = {"existence (23)", "kind (25)", "sign (24)", "symmetry breaking", "heteroclinic"}


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_regions_are_fills_of_their_role_and_every_boundary_is_a_named_limit(dark: bool) -> None:
    inks = DARK if dark else LIGHT
    figure = Figure(figsize=(8.0, 5.0), facecolor=inks.paper)
    axes = plots.steady_regions(curves(), figure.add_subplot(facecolor=inks.paper))
    colours: list[Any] = [np.ravel(fill.get_facecolor()).tolist() for fill in axes.collections]
    fills = {to_hex(colour) for colour in colours}
    assert fills == set(inks.rocks_ramp[:2]), "and paper where there is no motion"
    assert {line.get_color() for line in axes.lines} == {inks.limit}
    assert len({str(line._unscaled_dash_pattern) for line in axes.lines}) == 5  # type: ignore[attr-defined]
    legend = axes.get_legend()
    named = set(words_module(axes)) | set([] if legend is None else legend_of(axes))
    assert named >= BOUNDARIES
    assert {"1", "2", "3", "4", "5"} <= set(words_module(axes))


def test_names_of_boundaries_without_room_are_in_a_legend_beside_the_axes() -> None:
    figure = Figure(figsize=(7.0, 4.0), layout="constrained")
    flat = compute_region_map(np.linspace(0.1, 14.0, 200), 0.99)
    axes = plots.steady_regions(flat, figure.add_subplot(), key="beside")
    figure.draw_without_rendering()
    legend = axes.get_legend()
    assert legend is not None
    assert set(legend_of(axes)) | set(words_module(axes)) >= BOUNDARIES
    frame, box = legend.get_window_extent(), axes.get_window_extent()
    assert box.x1 < frame.x0 < frame.x1 <= figure.bbox.x1


def test_words_in_the_regions_leave_point_and_each_other_free() -> None:
    for point in ((2.0, 5.5), (13.0, 5.5), (1.0, 0.2), (13.0, 0.2)):
        axes = plots.steady_regions(curves(), Figure(figsize=(5.0, 4.4)).add_subplot(), point=point)
        axes.figure.canvas.draw()
        level = [text.get_window_extent() for text in axes.texts if text.get_rotation() == 0.0]
        legend = axes.get_legend()
        frames = level if legend is None else [*level, legend.get_window_extent()]
        for first, second in itertools.combinations(frames, 2):
            assert not first.overlaps(second), point
        for frame in frames:
            assert not frame.contains(*axes.transData.transform(point)), point


def test_the_words_beside_a_point_cross_no_curve_where_a_legend_narrows_the_axes() -> None:
    from matplotlib.path import Path as Outline

    for restitution, point in ((0.5, (3.0, 3.0)), (0.8, (2.0, 1.0)), (0.925, (4.0, 2.0))):
        found = compute_region_map(np.linspace(0.1, 14.0, 300), restitution)
        axes = plots.steady_regions(found, Figure().add_subplot(), point=point, legend="right")
        axes.figure.canvas.draw()
        (words,) = (text for text in axes.texts if text.get_text().startswith("A = "))
        for line in (each for each in axes.lines if np.size(each.get_xdata()) > 1):
            path = axes.transData.transform(np.array(line.get_xydata()))
            path = path[np.isfinite(path).all(axis=1)]
            box = words.get_window_extent()
            assert not Outline(path).intersects_bbox(box, filled=False), line.get_label()


def test_an_orbit_is_solid_dashed_or_dotted_as_it_is_stable_or_no_motion() -> None:
    for place, order, branch, style in (
        ((0.8, 5.0, 0.9), 1, 1, "-"),
        ((0.8, 5.0, 0.9), 1, 2, "--"),
        ((2.0, 4.0, 0.8), 1, 2, ":"),
    ):
        orbit = compute_steady_orbit(*place, order=order, branch=branch)
        (line,) = plots.steady_orbit(orbit, Figure().add_subplot()).lines
        drawn = line._unscaled_dash_pattern  # type: ignore[attr-defined]
        assert drawn == ({"-": (0, None), "--": DASHED, ":": DOTTED}[style])


def test_a_point_of_a_block_of_known_size_is_drawn_in_its_units() -> None:
    figure = steady_figure([("branch 1", orbit())], curves(), point=(6.0, 2.0), block=BLOCK)
    motion, base, plane = figure.axes
    assert motion.get_ylabel() == palette.LABELS["angle_deg"]
    assert base.get_xlabel() == palette.LABELS["half_cycle_s"]
    assert plane.get_xlabel() == palette.LABELS["freq_hz"]
    assert plane.get_ylabel() == palette.LABELS["accel_g"]
    (angle,) = (line for line in motion.lines if len(np.asarray(line.get_xdata())) > 2)
    degrees = math.degrees(BLOCK.alpha) * orbit().angle
    np.testing.assert_allclose(np.asarray(angle.get_ydata(), dtype=float), degrees)
    seconds = orbit().tau / (6.0 * BLOCK.p)
    np.testing.assert_allclose(np.asarray(angle.get_xdata(), dtype=float), seconds)
    (mark,) = (line for line in plane.lines if line.get_marker() == "o")
    assert np.ravel(mark.get_xydata()) == pytest.approx(
        [6.0, 2.0 * BLOCK.uplift_acceleration / BLOCK.gravity]
    )
    assert "0.4 g, 6 Hz" in words_module(plane)


def test_small_rocking_fills_the_picture() -> None:
    run = simulate(BARE, Harmonic(amplitude=2.0, frequency_ratio=8.0), start=Steady(), cycles=5)
    top = plots.trajectory(run, Figure().add_subplot()).get_ylim()[1]
    assert run.peak < top < 1.5 * run.peak


def test_stable_parts_are_solid_and_unstable_ones_dashed() -> None:
    curve = compute_response_curve(BARE, 2.0, frequency_ratio=np.linspace(1.0, 8.0, 141))
    axes = plots.response([curve], Figure().add_subplot())
    solid, dashed, _upright = axes.lines
    finite = [np.isfinite(np.asarray(line.get_ydata(), dtype=float)) for line in (solid, dashed)]
    np.testing.assert_array_equal(finite[0], curve.stable)
    unstable = ~curve.stable & np.isfinite(curve.peak)
    assert (finite[1] >= unstable).all()
    # They meet: where stability changes, the dashes reach to the first sample beyond.
    changes = int(np.abs(np.diff(unstable.astype(int))).sum())
    assert changes > 0
    assert int((finite[1] & ~unstable).sum()) == changes
    assert finite[0].any()
    assert finite[1].any()
    assert solid.get_linestyle() == "-"
    assert dashed.get_linestyle() != "-"


def test_peaks_of_very_different_size_are_drawn_over_a_logarithmic_axis() -> None:
    wide, narrow = (
        plots.response(
            [compute_response_curve(BARE, 2.0, frequency_ratio=np.linspace(low, high, 80))],
            Figure().add_subplot(),
        )
        for low, high in ((0.5, 12.0), (5.0, 8.0))
    )
    assert (wide.get_yscale(), narrow.get_yscale()) == ("log", "linear")
    assert "tipping angle" in words_module(wide)
    assert "tipping angle" not in words_module(narrow), "peaks far below do not make room for it"


def test_frequencies_spaced_by_ratio_are_drawn_so() -> None:
    for w, scale in ((np.linspace(0.1, 14.0, 90), "linear"), (np.geomspace(0.1, 14.0, 90), "log")):
        assert (
            plots.steady_regions(compute_region_map(w, 0.8), Figure().add_subplot()).get_xscale()
            == scale
        )
        curve = compute_response_curve(BARE, 2.0, frequency_ratio=w)
        assert plots.response([curve], Figure().add_subplot()).get_xscale() == scale


def test_curves_of_several_orders_and_branches_are_told_apart() -> None:
    w = np.linspace(3.0, 8.0, 20)
    mixed = [
        compute_response_curve(BARE, 2.0, frequency_ratio=w),
        compute_response_curve(BARE, 2.0, frequency_ratio=w, branch=2),
        compute_response_curve(BARE, 2.0, frequency_ratio=w, order=3),
    ]
    axes = plots.response(mixed, Figure().add_subplot())
    labels = {*legend_of(axes), *words_module(axes)}
    assert {
        "A = 2, n = 1, branch 1",
        "A = 2, n = 3, branch 1",
        "A = 2, n = 1, branch 2: no motion",
    } <= labels


def test_curves_end_at_their_names_as_the_caller_says() -> None:
    drawn = responses()
    names = ["soft", "middling", "hard"]
    axes = plots.response(drawn, Figure().add_subplot(), labels=names)
    words = {text.get_text(): text for text in axes.texts}
    shades = LIGHT.series("motion", 3)
    scale = math.degrees(BLOCK.alpha)
    for name, curve, shade in zip(names, drawn, shades, strict=True):
        (line,) = (line for line in axes.lines if line.get_label() == name)
        solid = np.where(curve.stable, scale * curve.peak, math.nan)
        np.testing.assert_allclose(np.asarray(line.get_ydata(), dtype=float), solid)
        assert line.get_color() == words[name].get_color() == shade
    heights = [words[name].get_window_extent().y0 for name in names]
    assert heights == sorted(heights)


def test_more_curves_than_six_have_a_legend() -> None:
    w = np.linspace(1.0, 8.0, 60)
    many = [compute_response_curve(BARE, a, frequency_ratio=w) for a in np.linspace(1.0, 4.0, 8)]
    axes = plots.response(many, Figure().add_subplot())
    assert len(legend_of(axes)) == 8
    looks = {(line.get_color(), line.get_marker()) for line in axes.lines[:-1]}
    assert len(looks) == 8


def test_peaks_of_a_block_of_known_size_are_in_degrees_over_hertz() -> None:
    axes = plots.response(responses(), Figure(figsize=(7.2, 4.4)).add_subplot())
    assert axes.get_xlabel() == palette.LABELS["freq_hz"]
    assert axes.get_ylabel() == palette.LABELS["peak_deg"]
    across, up = axes.child_axes
    assert across.get_xlabel() == palette.LABELS["frequency_ratio"]
    assert up.get_ylabel() == palette.LABELS["peak"]
    g = BLOCK.uplift_acceleration / BLOCK.gravity
    assert [word for word in words_module(axes) if word.endswith(" g")] == [
        f"{a * g:.3g} g" for a in (1.0, 2.0, 3.0)
    ]
    other = Block.from_p(alpha=0.2, p=math.pi, restitution=0.8)
    hertz = np.linspace(1.0, 8.0, 60)
    both = [compute_response_curve(block, 2.0, frequency_hz=hertz) for block in (BLOCK, other)]
    mixed = plots.response(both, Figure().add_subplot(), hertz=True)
    assert mixed.get_xlabel() == palette.LABELS["frequency_hz"]
    assert mixed.get_ylabel() == palette.LABELS["peak"]
    assert not mixed.child_axes
    assert plots.response(both, Figure().add_subplot()).get_xlim() == (1.0, 16.0)


@pytest.mark.parametrize(("top", "balance"), [(0.4, False), (1.0, False), (1.5, True)])
def test_the_peak_axis_ends_where_the_caller_says(top: float, balance: bool) -> None:
    curve = compute_response_curve(BARE, 2.0, frequency_ratio=np.linspace(0.5, 12.0, 80))
    axes = plots.response([curve], Figure().add_subplot(), top=top)
    assert axes.get_yscale() == "linear", "however much the peaks span"
    assert axes.get_ylim() == (0.0, top)
    assert ("tipping angle" in words_module(axes)) == balance


def test_the_numbers_of_the_regions_stand_in_their_regions() -> None:
    drawn = curves()
    centres = region_centres(drawn, 12.0, 0.0)
    assert set(centres) == {1, 2, 3, 4, 5}
    for region, (w, a) in centres.items():
        assert steady_states(a, w, 0.5, order=3).region == region


@every(("name", "ending"), zip([*FIGURES][::2], MAGIC, strict=True))
def test_figures_can_be_saved(name: str, ending: str, tmp_path: Path) -> None:
    figure = FIGURES[name]()
    file = tmp_path / f"figure.{ending}"
    with palette.style():
        figure.savefig(file)
    data = file.read_bytes()
    assert data.startswith(MAGIC[ending]), ending
    assert len(data) > 5_000, ending


@pytest.mark.slow
@figures
def test_every_panel_of_a_figure_has_labels(make: Callable[[], Figure]) -> None:
    figure = make()
    for axes in figure.axes:
        assert axes.get_ylabel()
        assert axes.get_xlabel() or not axes.xaxis.get_tick_params()["labelbottom"]


def test_a_figure_has_the_title_it_is_given() -> None:
    assert FIGURES["simulation"]().get_suptitle() == "title"
    assert FIGURES["steady"]().get_suptitle() == ""
    assert FIGURES["nothing"]().get_suptitle() == "title"


def test_the_style_ends_with_its_block_even_after_an_error() -> None:
    before = mpl.rcParams["axes.spines.top"]
    with contextlib.suppress(ZeroDivisionError), palette.style():
        assert mpl.rcParams["axes.spines.top"] is False
        _ = 1 / 0
    assert mpl.rcParams["axes.spines.top"] == before


# --------------------------------------------------------------------------------- colours


@pytest.mark.parametrize(
    ("label", "changed"),
    [("plot_floor_spectra", {"floors": []}), ("plot_steady_orbit", {"label": b"abc"})],
)
def test_arguments_that_cannot_be_drawn_are_named(
    label: str, changed: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    call = calls()[label]
    with pytest.raises(InputError, match=f"^{next(iter(changed))} = "):
        call(**changed)
