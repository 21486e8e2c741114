"""Plots of branches, sweeps and curves of bifurcations; each shows the numbers it was given."""

from collections.abc import Iterable
from dataclasses import replace
from functools import cache
from itertools import pairwise

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from rocksteady import DimensionlessBlock, Harmonic, Steady, find_orbits, plots
from rocksteady.branches import (
    BifurcationCurve,
    BifurcationCurves,
    BifurcationDiagram,
    Branch,
    BranchOptions,
    BranchPoint,
    CodimensionTwoPoint,
    CurveOptions,
    PointType,
    Region,
    find_branches,
    find_resting_branches,
    follow_bifurcation,
    follow_branch,
)
from rocksteady.errors import InputError
from rocksteady.formulas import symmetry_breaking_amplitude
from rocksteady.orbits import AttractorSweep, compute_region_boundaries, sweep_attractor
from rocksteady.show.figures.single import bifurcation_figure
from rocksteady.show.plots.branches._resting import NUMBER
from rocksteady.show.style import palette

BARE = DimensionlessBlock(restitution=0.8)
PLANE = ("amplitude", "frequency_ratio")
MARKS = {"s", "D", "^", "o"}
REST = ("amplitude", (1.0, 1.07))
RESTING_COLOUR = palette.LINES[NUMBER]


@cache
def over_amplitude() -> tuple[Branch, ...]:
    shaking = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    starts = find_orbits(BARE, shaking, max_period=1, max_impacts=2, seeds=1)
    return find_branches(starts, "amplitude", (0.1, 3.0), max_period=2, max_impacts=6)


def diagram_of(branches: tuple[Branch, ...], parameter: str) -> BifurcationDiagram:
    """Return a diagram of branches without sweeps."""
    return BifurcationDiagram(
        block=BARE,
        motion=Harmonic(amplitude=1.0, frequency_ratio=2.0),
        parameter=parameter,
        within=(0.1, 1.0),
        search=BranchOptions(doublings=0),
        branches=branches,
        sweeps=(),
        cascade=None,
        complete=True,
    )


@cache
def over_frequency() -> tuple[Branch, ...]:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=2.2)
    starts = find_orbits(BARE, shaking, max_period=1, max_impacts=2, seeds=1)
    return find_branches(starts[:1], "frequency_ratio", (1.6, 2.4), max_period=2)


@cache
def sweeps() -> tuple[AttractorSweep, ...]:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    ways = (np.linspace(1.6, 2.4, 41), np.linspace(2.4, 1.6, 41))
    return tuple(
        sweep_attractor(BARE, shaking, "frequency_ratio", way, start=Steady()) for way in ways
    )


@cache
def curves() -> tuple[tuple[BranchPoint, ...], ...]:
    ranges = ((0.1, 6.0), (1.0, 4.0))
    points = over_amplitude()[0].points
    starts = [next(p for p in points if p.type == kind) for kind in ("fold", "symmetry-breaking")]
    return tuple(
        tuple(follow_bifurcation(start, PLANE, ranges, direction=direction))
        for start in starts
        for direction in (1, -1)
    )


def lines_of(axes: Axes, *, marked: bool) -> list[Line2D]:
    return [line for line in axes.lines if (line.get_marker() in MARKS) == marked]


def data(line: Line2D) -> tuple[np.ndarray, np.ndarray]:
    return np.asarray(line.get_xdata(), dtype=float), np.asarray(line.get_ydata(), dtype=float)


def legend_of(axes: Axes) -> list[str]:
    legend = axes.get_legend()
    assert legend is not None
    return [text.get_text() for text in legend.get_texts()]


def curve_lines(axes: Axes, colour: str) -> list[Line2D]:
    return [line for line in lines_of(axes, marked=False) if line.get_color() == colour]


@pytest.mark.slow
def test_a_plot_draws_on_the_axes_it_is_given_with_its_labels() -> None:
    axes = Figure().add_subplot()
    assert plots.bifurcations(over_frequency(), sweeps(), axes) is axes
    assert axes.get_xlabel() == palette.LABELS["frequency_ratio"]
    assert axes.get_ylabel() == palette.LABELS["flight_peak"]
    assert axes.get_xlim() == (1.6, 2.4)
    assert plots.bifurcation_curves(curves(), axes) is axes


def test_a_plot_makes_axes_of_its_own_and_leaves_the_settings() -> None:
    settings = dict(mpl.rcParams)
    assert plots.bifurcations(over_frequency()).figure is plt.gcf()
    assert plots.bifurcation_curves(curves()).figure is plt.gcf()
    assert dict(mpl.rcParams) == settings
    plt.close("all")


def test_every_flight_is_a_line_and_nothing_drawn_is_nan() -> None:
    branches = over_amplitude()
    axes = plots.bifurcations(branches, ax=Figure().add_subplot())
    expected = sum(
        branch.peaks.shape[1] // (2 if branch.symmetric else 1) * len(branch.stretches)
        for branch in branches
    )
    assert len(lines_of(axes, marked=False)) == expected
    for line in axes.lines:
        assert np.isfinite(data(line)).all()
        assert (data(line)[1] >= 0.0).all()


def test_the_highest_line_is_the_highest_peak() -> None:
    branch = over_frequency()[1]
    axes = plots.bifurcations([branch], ax=Figure().add_subplot())
    drawn = {
        (x, y)
        for line in lines_of(axes, marked=False)
        for x, y in zip(*(column.tolist() for column in data(line)), strict=True)
    }
    for value, peaks in zip(branch.values, branch.peaks, strict=True):
        assert {(value, abs(peak)) for peak in peaks.tolist()} <= drawn


def test_stable_parts_are_solid_and_thick_and_unstable_ones_dashed_and_thin() -> None:
    symmetric = over_frequency()[0]
    axes = plots.bifurcations([symmetric], ax=Figure().add_subplot())
    unstable, stable = lines_of(axes, marked=False)
    breaking = float(symmetric.bifurcations[0].frequency_ratio)
    assert breaking == pytest.approx(1.948378, abs=5e-7)  # TW6
    assert data(stable)[0].min() == data(unstable)[0].max() == breaking
    assert stable.get_linestyle() == "-"
    assert unstable.get_linestyle() == "--"
    assert stable.get_linewidth() > 2.0 * unstable.get_linewidth()


def test_a_stretch_between_two_bifurcations_is_what_the_one_before_is_not() -> None:
    for branch in (*over_amplitude(), *over_frequency()):
        parts = branch.stretches
        assert parts[0].first == 0
        assert parts[-1].last == len(branch.points) - 1
        for part, after in pairwise(parts):
            assert part.last == after.first
            assert part.stable != after.stable
            assert branch.points[part.last].type != "regular"
        for part in parts:
            inside = branch.stable[part.first + 1 : part.last]
            assert (inside == part.stable).all()


def test_solutions_that_are_no_motion_are_dotted_and_faint() -> None:
    shaking = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    start = find_orbits(BARE, shaking, max_period=1, max_impacts=2, seeds=1)[1]
    points = tuple(follow_branch(start, "amplitude", (0.1, 3.0), inadmissible=True))
    branch = Branch(parameter="amplitude", points=points)
    assert not branch.admissible.all()
    axes = plots.bifurcations([branch], ax=Figure().add_subplot())
    faint = [line for line in lines_of(axes, marked=False) if line.get_alpha() is not None]
    assert faint
    graze = next(point for point in points if point.type == "grazing")
    for line in faint:
        assert float(line.get_alpha() or 1.0) < 1.0
        assert data(line)[0].min() == pytest.approx(graze.amplitude)
    assert "no motion" in legend_of(axes)


def test_colours_tell_kinds_apart_and_the_legend_names_them() -> None:
    axes = plots.bifurcations(over_frequency(), ax=Figure().add_subplot())
    assert legend_of(axes) == [
        "symmetric",
        "unsymmetric",
        "period 2",
        "unstable",
        "symmetry breaking",
        "period doubling",
    ]
    legend = axes.get_legend()
    assert legend is not None
    colours = [line.get_color() for line in legend.get_lines()[:3]]
    assert len(set(colours)) == 3
    for branch, colour in zip(over_frequency(), colours, strict=True):
        lines = curve_lines(axes, str(colour))
        assert {x for line in lines for x in data(line)[0].tolist()} == set(branch.values.tolist())


def test_bifurcations_are_marked_at_the_highest_and_lowest_angle_once() -> None:
    axes = plots.bifurcations(over_amplitude(), ax=Figure().add_subplot())
    marks = {line.get_marker(): data(line) for line in lines_of(axes, marked=True)}
    assert set(marks) == MARKS
    fold = float(compute_region_boundaries(2.0, 0.8).existence)
    assert marks["s"][0].min() == pytest.approx(fold, abs=1e-8)
    breaking = float(symmetry_breaking_amplitude(2.0, 0.8))
    at = np.abs(marks["D"][0] - breaking) < 1e-8
    assert at.sum() == 1, "on both of its branches and marked once"
    known = {
        round(abs(u), 6)
        for branch in over_amplitude()
        for point, peaks in zip(branch.points, branch.peaks, strict=True)
        if point.type != "regular"
        for u in (max(np.nanmax(peaks), 0.0), min(np.nanmin(peaks), 0.0))
    }
    for x, y in marks.values():
        assert set(np.round(y, 6).tolist()) <= known
        assert len(set(zip(x.tolist(), y.tolist(), strict=True))) == len(x)


def test_both_sides_are_mirror_images_of_each_other() -> None:
    axes = plots.bifurcations(over_frequency(), sweeps(), Figure().add_subplot(), side="both")
    assert axes.get_ylabel() == palette.LABELS["flight_extreme"]
    low, high = axes.get_ylim()
    assert low == -high
    solid = lines_of(axes, marked=False)
    drawn = {(tuple(data(line)[0]), tuple(data(line)[1])) for line in solid}
    assert {(x, tuple(-u for u in y)) for x, y in drawn} == drawn


def dots(axes: Axes, colour: str) -> set[tuple[float, float]]:
    found: set[tuple[float, float]] = set()
    for line in axes.lines:
        if line.get_color() == colour and line.get_zorder() < 2.5 and line.get_clip_on():
            found |= set(zip(*(column.tolist() for column in data(line)), strict=True))
    return found


def test_the_dots_of_a_sweep_are_its_peaks_and_its_way_has_its_look() -> None:
    axes = plots.bifurcations(over_frequency(), sweeps(), Figure().add_subplot())
    for trail, colour in zip(sweeps(), palette.SWEEPS, strict=True):
        expected = {
            (value, abs(peak))
            for value, peaks in zip(trail.values.tolist(), trail.peaks, strict=True)
            for peak in peaks.tolist()
        }
        assert dots(axes, colour) == expected
    assert legend_of(axes)[-3:] == ["upward sweep", "downward sweep", "overturned"]
    sizes = {
        line.get_color(): line.get_markersize()
        for line in axes.lines
        if line.get_color() in palette.SWEEPS and line.get_clip_on() and line.get_markersize() > 3.0
    }
    up, down = (sizes[colour] for colour in palette.SWEEPS)
    assert up > down, "one shows around the other"


def bars(axes: Axes, colour: str) -> list[tuple[float, float]]:
    found: list[tuple[float, float]] = []
    for patch in axes.collections:
        assert isinstance(patch, PolyCollection)
        if tuple(np.ravel(patch.get_facecolor())) == to_rgba(colour):
            for path in patch.get_paths():
                x = np.asarray(path.vertices)[:, 0]
                found.append((float(x.min()), float(x.max())))
    return found


def covered(values: Iterable[float], spans: list[tuple[float, float]]) -> list[bool]:
    return [any(low <= value <= high for low, high in spans) for value in values]


def test_the_bars_stand_where_a_sweep_overturned_or_came_to_rest() -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    trail = sweep_attractor(BARE, shaking, "amplitude", np.linspace(0.1, 3.0, 59))
    assert {"rest", "overturned"} <= set(trail.kinds)
    axes = plots.bifurcations((), [trail], Figure().add_subplot())
    for kind, colour in (("overturned", palette.OVERTURNED), ("rest", palette.GROUND)):
        assert covered(trail.values, bars(axes, colour)) == [each == kind for each in trail.kinds]
    assert legend_of(axes) == ["upward sweep", "overturned", "at rest"]
    _, top = axes.get_ylim()
    assert max(y for _, y in dots(axes, palette.SWEEPS[0])) < 0.96 * top, "room for the bars"


def test_the_axis_of_angles_ends_where_it_is_told() -> None:
    axes = plots.bifurcations(over_amplitude(), ax=Figure().add_subplot(), top=0.05)
    assert axes.get_ylim() == (0.0, 0.05)


def test_branches_over_different_parameters_are_refused() -> None:
    for branches in ((*over_amplitude(), *over_frequency()), ()):
        with pytest.raises(InputError, match="one parameter"):
            plots.bifurcations(branches, ax=Figure().add_subplot())


def test_the_legend_of_the_figure_is_beside_the_axes_and_inside_the_figure() -> None:
    figure = bifurcation_figure(diagram_of(over_amplitude(), "amplitude"), title="title")
    assert figure.get_suptitle() == "title"
    figure.draw_without_rendering()
    axes = figure.axes[0]
    legend = axes.get_legend()
    assert legend is not None
    frame, box = legend.get_window_extent(), axes.get_window_extent()
    assert box.x1 < frame.x0 < frame.x1 <= figure.bbox.x1


def test_a_figure_of_nothing_says_so() -> None:
    (axes,) = bifurcation_figure(diagram_of((), "restitution")).axes
    assert axes.get_xlabel() == palette.LABELS["restitution"]
    assert axes.texts[0].get_text() == "no periodic motion found"


# ------------------------------------------------------------------------------------- curves


def test_curves_of_bifurcations_lie_where_the_closed_forms_have_them() -> None:
    axes = plots.bifurcation_curves(curves(), Figure().add_subplot())
    assert axes.get_xlabel() == palette.LABELS["frequency_ratio"]
    assert axes.get_ylabel() == palette.LABELS["amplitude"]
    assert legend_of(axes) == ["fold", "symmetry breaking"]
    assert len(axes.lines) == 4
    for line in axes.lines[:2]:
        w, a = data(line)
        np.testing.assert_allclose(a, compute_region_boundaries(w, 0.8).existence, rtol=1e-7)
        assert line.get_linestyle() == "-"
    for line in axes.lines[2:]:
        w, a = data(line)
        np.testing.assert_allclose(a, symmetry_breaking_amplitude(w, 0.8), rtol=1e-7)
        assert line.get_linestyle() == "--"


def test_the_names_of_curves_stand_on_their_lines() -> None:
    axes = plots.bifurcation_curves(curves(), Figure().add_subplot())
    names = {text.get_text(): text for text in axes.texts}
    assert set(names) == {"fold", "symmetry breaking"}
    w, amplitude = names["fold"].get_position()
    assert amplitude == pytest.approx(float(compute_region_boundaries(w, 0.8).existence), abs=0.03)
    w, amplitude = names["symmetry breaking"].get_position()
    assert amplitude == pytest.approx(float(symmetry_breaking_amplitude(w, 0.8)), abs=0.03)
    none = plots.bifurcation_curves(curves(), Figure().add_subplot(), labels=False)
    assert not none.texts


def test_a_plane_marks_its_points_and_names_its_regions() -> None:
    points = curves()[2]
    special = replace(points[3], type=PointType.BREAKING_GRAZE)
    curve = BifurcationCurve(
        type=PointType.SYMMETRY_BREAKING, parameters=PLANE, points=(*points[:3], special)
    )
    found = BifurcationCurves(
        block=BARE,
        motion=Harmonic(amplitude=1.0, frequency_ratio=2.0),
        parameters=PLANE,
        within=((0.1, 6.0), (1.0, 4.0)),
        search=CurveOptions(),
        curves=(curve,),
        points=(CodimensionTwoPoint(point=special, curves=(1,)),),
        regions=(Region(place=(1.0, 3.0), motions=("symmetric",), extent=(0, 0.5, 1.5)),),
        complete=True,
    )
    axes = found.plot(Figure().add_subplot())
    assert axes.get_xlabel() == palette.LABELS["amplitude"]
    (mark,) = (line for line in axes.lines if line.get_marker() == "p")
    x, y = data(mark)
    assert (x[0], y[0]) == pytest.approx((special.amplitude, special.frequency_ratio), abs=1e-6)
    words = [text.get_text() for text in axes.texts]
    assert "breaking graze" in words
    assert "stable:\nsymmetric" in words
    assert legend_of(axes) == ["symmetry breaking", "breaking graze"]


def test_curves_take_their_axes_in_any_order_and_refuse_other_names() -> None:
    axes = plots.bifurcation_curves(curves(), Figure().add_subplot(), parameters=PLANE)
    assert axes.get_xlabel() == palette.LABELS["amplitude"]
    with pytest.raises(InputError, match="amplitude, frequency_ratio, restitution"):
        plots.bifurcation_curves(curves(), Figure().add_subplot(), parameters=("amplitude", "x"))


def test_no_curves_are_empty_axes_with_labels() -> None:
    axes = plots.bifurcation_curves([[]], Figure().add_subplot())
    assert not axes.lines
    assert axes.get_legend() is None
    assert axes.get_xlabel()


def test_values_spaced_by_ratio_get_a_logarithmic_axis() -> None:
    block, shaking = DimensionlessBlock(restitution=0.8), Harmonic(amplitude=2.0, frequency_ratio=4)
    for values, scale in (
        (np.geomspace(2.0, 60.0, 9), "log"),
        (np.linspace(2.0, 8.0, 9), "linear"),
    ):
        trail = sweep_attractor(block, shaking, "frequency_ratio", values[::-1])
        axes = plots.bifurcations((), [trail], Figure().add_subplot())
        assert axes.get_xscale() == scale
        assert axes.get_xlim() == (values[0], values[-1])


def test_orbits_with_rest_that_hug_the_axis_are_shown_in_an_inset() -> None:
    resting = find_resting_branches(BARE, Harmonic(amplitude=1.0, frequency_ratio=2.0), *REST)
    (branch,) = resting.branches[:1]
    high = [each for each in over_amplitude() if np.nanmax(each.peaks) > 0.3][:1]
    axes = plots.bifurcations([*high, branch], ax=Figure(figsize=(6.0, 4.0)).add_subplot())
    (inset,) = axes.child_axes
    low, most = inset.get_ylim()
    highest = float(np.nanmax(np.abs(branch.peaks)))
    assert low == 0.0
    assert highest < most < 2.0 * highest  # the line fills the inset
    assert inset.get_xlim()[0] < branch.values.min() < branch.values.max() < inset.get_xlim()[1]
    dots = [line for line in inset.lines if line.get_marker() == "o"]
    ends = [line for line in dots if line.get_color() == RESTING_COLOUR]
    assert {float(np.asarray(line.get_xdata())[0]) for line in ends} == {
        branch.values[0],
        branch.values[-1],
    }


def test_orbits_with_rest_that_are_seen_anyway_need_no_inset() -> None:
    resting = find_resting_branches(BARE, Harmonic(amplitude=1.0, frequency_ratio=2.0), *REST)
    axes = plots.bifurcations(resting, ax=Figure(figsize=(6.0, 4.0)).add_subplot())
    assert not axes.child_axes
    flat = Figure(figsize=(6.0, 1.2)).add_subplot()
    high = [each for each in over_amplitude() if np.nanmax(each.peaks) > 0.3][:1]
    assert not plots.bifurcations([*high, *resting.branches], ax=flat).child_axes


def test_the_colour_of_rest_is_like_no_other_of_the_first_kinds() -> None:
    assert RESTING_COLOUR not in palette.SUBHARMONIC_LINES[:2]
    others = [palette.LINES[0], palette.LINES[4], *palette.SUBHARMONIC_LINES[:2], *palette.SWEEPS]
    distances = [
        float(np.linalg.norm(np.subtract(to_rgba(RESTING_COLOUR), to_rgba(other))))
        for other in others
    ]
    assert min(distances) > 0.3
