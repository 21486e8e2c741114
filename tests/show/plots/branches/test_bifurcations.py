"""Plots of branches, sweeps and curves of bifurcations; each shows the numbers it was given."""

import math
from collections.abc import Iterable
from dataclasses import replace
from functools import cache
from itertools import combinations, pairwise

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
from matplotlib.text import Annotation

from rocksteady import Block, DimensionlessBlock, Harmonic, Steady, find_orbits, plots
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
from rocksteady.show.plots.branches._resting import LABEL
from rocksteady.show.style import palette
from rocksteady.show.style.tokens import DARK, LIGHT, Inks

BARE = DimensionlessBlock(restitution=0.8)
PLANE = ("amplitude", "frequency_ratio")
MARKS = {"s", "D", "X", "o"}
REST = ("amplitude", (1.0, 1.07))
UNITS = ("amplitude", (0.3, 1.5))


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
    marks = MARKS if marked else {"None"}
    lines = [line for line in axes.lines if line.get_marker() in marks]
    return [line for line in lines if marked or line.get_color() != LIGHT.limit]


def data(line: Line2D) -> tuple[np.ndarray, np.ndarray]:
    return np.asarray(line.get_xdata(), dtype=float), np.asarray(line.get_ydata(), dtype=float)


def legend_of(axes: Axes) -> list[str]:
    legend = axes.get_legend()
    assert legend is not None
    title = legend.get_title().get_text()
    return [title] * bool(title) + [text.get_text() for text in legend.get_texts()]


def words_module(axes: Axes) -> dict[str, str]:
    """Return the words in the picture, with their colours."""
    return {text.get_text(): str(text.get_color()) for text in axes.texts}


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


@pytest.mark.slow
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
    assert unstable.get_color() == stable.get_color() == LIGHT.motion
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
    assert "dotted: no motion" in legend_of(axes)[0]


@pytest.mark.parametrize("inks", [LIGHT, DARK], ids=["light", "dark"])
def test_kinds_have_the_colours_of_their_roles_and_their_names_on_their_lines(inks: Inks) -> None:
    figure = Figure(figsize=(8.0, 5.0), facecolor=inks.paper)
    axes = plots.bifurcations(over_frequency(), ax=figure.add_subplot(facecolor=inks.paper))
    words = words_module(axes)
    kinds = ("symmetric", "unsymmetric", "period 2")
    colours = (inks.motion, inks.unsymmetric_line, inks.subharmonic_line)
    entries = legend_of(axes)
    for branch, kind, colour in zip(over_frequency(), kinds, colours, strict=True):
        lines = curve_lines(axes, colour)
        assert {x for line in lines for x in data(line)[0].tolist()} == set(branch.values.tolist())
        assert (kind in words) != (kind in entries), "named once"
        if kind in words:
            assert words[kind] == colour
    assert words["symmetric"] == inks.motion
    assert "solid: stable, dashed: unstable" in entries


def test_bifurcations_that_end_stable_parts_are_named_with_their_places() -> None:
    axes = plots.bifurcations(over_frequency(), ax=Figure(figsize=(8.0, 5.0)).add_subplot())
    breaking = float(over_frequency()[0].bifurcations[0].frequency_ratio)
    words = {text.get_text(): text for text in axes.texts}
    assert {"symmetry breaks 1.95", "period doubles 1.79"} <= set(words)
    assert breaking == pytest.approx(1.95, abs=5e-3)
    named = words["symmetry breaks 1.95"]
    assert isinstance(named, Annotation)
    assert named.xy[0] == pytest.approx(breaking, abs=1e-6)
    assert "symmetry breaking" not in legend_of(axes), "all of them have their names"


@pytest.mark.slow
@pytest.mark.parametrize("width", [3.3, 8.0])
def test_no_name_lies_on_another_or_on_a_mark(width: float) -> None:
    figure = Figure(figsize=(width, 4.0), layout="constrained")
    axes = plots.bifurcations(over_amplitude(), ax=figure.add_subplot())
    figure.draw_without_rendering()
    level = [text for text in axes.texts if text.get_rotation() == 0.0]
    assert len(level) > 2
    for first, second in combinations(level, 2):
        assert not first.get_window_extent().overlaps(second.get_window_extent())
    for text in level:
        box = text.get_window_extent()
        for line in lines_of(axes, marked=True):
            marks = axes.transData.transform(np.column_stack(data(line)))
            assert not any(box.contains(x, y) for x, y in marks), text.get_text()


def test_the_tipping_angle_is_a_dashed_limit_with_its_name() -> None:
    axes = plots.bifurcations(over_frequency(), ax=Figure().add_subplot())
    (line,) = (line for line in axes.lines if line.get_color() == LIGHT.limit)
    assert data(line)[1].tolist() == [1.0, 1.0]
    assert line.get_linestyle() == "--"
    assert words_module(axes)["tipping angle"] == LIGHT.limit
    low = plots.bifurcations(over_frequency(), ax=Figure().add_subplot(), top=0.5)
    assert "tipping angle" not in words_module(low)


@pytest.mark.slow
def test_a_block_of_known_size_has_its_units_and_the_ratios_on_the_far_sides() -> None:
    block = Block.rectangle(width=0.4, height=2.0, restitution=0.8)
    shaking = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    start = find_orbits(block, shaking, max_period=1, max_impacts=2, seeds=1)[0]
    branch = Branch(parameter="amplitude", points=tuple(follow_branch(start, *UNITS)))
    figure = Figure(figsize=(8.0, 5.0), layout="constrained")
    axes = plots.bifurcations([branch], ax=figure.add_subplot())
    assert axes.get_xlabel() == palette.LABELS["accel_g"]
    assert axes.get_ylabel() == palette.LABELS["flight_peak_deg"]
    g = block.uplift_acceleration / block.gravity
    degrees = math.degrees(block.alpha)
    assert axes.get_xlim() == pytest.approx([g * branch.values.min(), g * branch.values.max()])
    highest = max(data(line)[1].max() for line in curve_lines(axes, LIGHT.motion))
    assert highest == pytest.approx(degrees * np.nanmax(np.abs(branch.peaks)))
    across, up = axes.child_axes
    assert across.get_xlabel() == palette.LABELS["amplitude"]
    assert up.get_ylabel() == palette.LABELS["flight_peak"]
    figure.draw_without_rendering()
    assert across.get_xlim() == pytest.approx([branch.values.min(), branch.values.max()])
    narrow = plots.bifurcations([branch], ax=Figure(figsize=(3.3, 2.4)).add_subplot())
    assert not narrow.child_axes
    other = plots.bifurcations([branch, *over_amplitude()], ax=Figure().add_subplot())
    assert other.get_xlabel() == palette.LABELS["amplitude"], "of blocks that differ"


def test_bifurcations_are_marked_at_the_highest_and_lowest_angle_once() -> None:
    axes = plots.bifurcations(over_amplitude(), ax=Figure().add_subplot())
    marks = {line.get_marker(): data(line) for line in lines_of(axes, marked=True)}
    assert set(marks) == MARKS
    fold = float(compute_region_boundaries(2.0, 0.8).existence)
    assert marks["o"][0].min() == pytest.approx(fold, abs=1e-8)
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


def dots(axes: Axes, *markers: str) -> set[tuple[float, float]]:
    found: set[tuple[float, float]] = set()
    for line in axes.lines:
        if line.get_marker() in markers and line.get_zorder() < 2.15:
            found |= set(zip(*(column.tolist() for column in data(line)), strict=True))
    return found


def test_the_dots_of_a_sweep_are_its_peaks_and_point_its_way() -> None:
    axes = plots.bifurcations(over_frequency(), sweeps(), Figure().add_subplot())
    for trail, marker in zip(sweeps(), "^v", strict=True):
        expected = {
            (value, abs(peak))
            for value, peaks, kind in zip(
                trail.values.tolist(), trail.peaks, trail.kinds, strict=True
            )
            for peak in peaks.tolist()
            if kind != "aperiodic"
        }
        assert dots(axes, marker) == expected
    assert legend_of(axes)[-3:] == ["upward sweep", "downward sweep", "falls"]


def test_motions_that_do_not_repeat_are_dots_of_their_colour() -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    values = np.linspace(1.78, 1.77, 21)
    trail = sweep_attractor(BARE, shaking, "frequency_ratio", values, start=Steady())
    assert "aperiodic" in trail.kinds
    axes = plots.bifurcations(trail, ax=Figure().add_subplot())
    cloud = [line for line in axes.lines if line.get_color() == LIGHT.aperiodic_line]
    expected = {
        value for value, kind in zip(trail.values, trail.kinds, strict=True) if kind == "aperiodic"
    }
    assert {x for line in cloud for x in data(line)[0]} == expected
    assert "aperiodic" in legend_of(axes)


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
    for kind, colour in (("overturned", LIGHT.falls), ("rest", LIGHT.rest)):
        assert covered(trail.values, bars(axes, colour)) == [each == kind for each in trail.kinds]
    assert legend_of(axes)[-2:] == ["falls", "comes to rest"]
    hatched = [bool(patch.get_hatch()) for patch in axes.collections]
    assert hatched == [True, False], "what falls has its hatch"
    _, top = axes.get_ylim()
    assert max(y for _, y in dots(axes, "^", "o")) < 0.96 * top, "room for the bars"


def test_the_axis_of_angles_ends_where_it_is_told() -> None:
    axes = plots.bifurcations(over_amplitude(), ax=Figure().add_subplot(), top=0.05)
    assert axes.get_ylim() == (0.0, 0.05)


def test_branches_over_different_parameters_are_refused() -> None:
    for branches in ((*over_amplitude(), *over_frequency()), ()):
        with pytest.raises(InputError, match="one parameter"):
            plots.bifurcations(branches, ax=Figure().add_subplot())


def test_the_legend_of_the_figure_is_below_the_axes_and_inside_the_figure() -> None:
    figure = bifurcation_figure(diagram_of(over_amplitude(), "amplitude"), title="title")
    assert figure.get_suptitle() == "title"
    figure.draw_without_rendering()
    axes = figure.axes[0]
    legend = axes.get_legend()
    assert legend is not None
    frame, box = legend.get_window_extent(), axes.get_window_extent()
    assert 0.0 <= frame.y0 < frame.y1 <= box.y0
    assert frame.x1 <= figure.bbox.x1


def test_a_figure_of_nothing_says_so() -> None:
    (axes,) = bifurcation_figure(diagram_of((), "restitution")).axes
    assert axes.get_xlabel() == palette.LABELS["restitution"]
    assert axes.texts[0].get_text() == "no periodic motion found"


# ------------------------------------------------------------------------------------- curves


def test_curves_of_bifurcations_lie_where_the_closed_forms_have_them() -> None:
    axes = plots.bifurcation_curves(curves(), Figure().add_subplot())
    assert axes.get_xlabel() == palette.LABELS["frequency_ratio"]
    assert axes.get_ylabel() == palette.LABELS["amplitude"]
    assert axes.get_legend() is None, "every line has its name"
    assert len(axes.lines) == 4
    assert {line.get_color() for line in axes.lines} == {LIGHT.limit}
    fold, breaking = (axes.lines[k]._unscaled_dash_pattern for k in (0, 2))  # type: ignore[attr-defined]
    assert fold != breaking
    for line in axes.lines[:2]:
        w, a = data(line)
        np.testing.assert_allclose(a, compute_region_boundaries(w, 0.8).existence, rtol=1e-7)
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
    assert legend_of(axes) == ["symmetry breaking"], "the rest is named in the picture"


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
    ends = [line for line in dots if line.get_color() == LIGHT.quiet]
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


def test_orbits_that_rest_have_a_colour_of_their_own() -> None:
    resting = find_resting_branches(BARE, Harmonic(amplitude=1.0, frequency_ratio=2.0), *REST)
    axes = plots.bifurcations([*over_amplitude(), *resting.branches], ax=Figure().add_subplot())
    lines = curve_lines(axes, LIGHT.quiet)
    assert {x for line in lines for x in data(line)[0]} >= set(resting.branches[0].values)
    high = max(np.nanmax(np.abs(branch.peaks)) for branch in resting.branches)
    assert max(np.nanmax(data(line)[1]) for line in lines) == high
    assert (LABEL in words_module(axes)) or (LABEL in legend_of(axes))
