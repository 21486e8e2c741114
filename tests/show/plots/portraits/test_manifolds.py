"""Pictures of manifolds: what is drawn, where, and what does not go together."""

import math

import numpy as np
import pytest
from matplotlib.figure import Figure

from rocksteady import (
    DimensionlessBlock,
    Harmonic,
    State,
    compute_basins,
    find_edge_state,
    find_orbits,
    plots,
    simulate,
)
from rocksteady.basins import Manifold, compute_manifold, find_hilltop_saddles
from rocksteady.errors import ModelError
from rocksteady.orbits import Orbit
from rocksteady.show.plots.portraits.manifolds import saddle_at

BARE = DimensionlessBlock(restitution=0.9)
MOTION = Harmonic(amplitude=0.2, frequency_ratio=2.0)
SADDLE = find_hilltop_saddles(BARE, MOTION)[0]


def test_every_point_is_drawn_and_stable_and_unstable_differ() -> None:
    found = [
        compute_manifold(SADDLE, kind, length=2.0, spacing=0.05) for kind in ("stable", "unstable")
    ]
    axes = plots.manifolds(found, Figure().add_subplot())
    lines = [line for line in axes.lines if line.get_linestyle() in ("-", "--")]
    drawn = sum(len(np.asarray(line.get_xdata())) for line in lines)
    assert drawn == sum(each.points for each in found)
    looks = {(line.get_color(), line.get_linestyle()) for line in lines}
    assert len(looks) == 2
    crosses = [line for line in axes.lines if line.get_marker() == "x"]
    place = np.ravel([crosses[-1].get_xdata(), crosses[-1].get_ydata()])
    assert place == pytest.approx([1.0, -0.08])


def test_over_basins_the_window_and_the_legend_stay() -> None:
    axis = np.linspace(-1.0, 1.0, 12)
    axes = plots.basins(
        compute_basins(BARE, MOTION, angles=axis, velocities=axis), Figure().add_subplot()
    )
    limits, legend = (axes.get_xlim(), axes.get_ylim()), axes.get_legend()
    plots.manifolds(compute_manifold(SADDLE, "stable", length=2.0), axes)
    assert (axes.get_xlim(), axes.get_ylim()) == limits
    assert axes.get_legend() is legend


@pytest.mark.slow
def test_over_impacts_no_line_runs_across_where_the_phase_begins_anew() -> None:
    shaken = Harmonic(amplitude=2.0, frequency_ratio=1.9)
    orbits = find_orbits(DimensionlessBlock(restitution=0.8), shaken, max_period=1, seeds=8)
    axes = plots.poincare_section(orbits, Figure().add_subplot())
    before = len(axes.lines)
    found = compute_manifold(orbits[0], "stable", over="impacts", length=4.0, spacing=0.05)
    plots.manifolds(found, axes)
    for line in axes.lines[before:]:
        x = np.asarray(line.get_xdata(), dtype=np.float64)
        if line.get_linestyle() == "-":
            assert (np.abs(np.diff(x)) < math.pi).all()


def test_over_impacts_a_picture_shows_one_turn_of_the_phase_in_quarters() -> None:
    found = compute_manifold(SADDLE, "stable", over="impacts", spacing=0.1)
    axes = plots.manifolds(found, Figure().add_subplot())
    assert axes.get_xlim() == pytest.approx((0.0, 2.0 * math.pi))
    assert axes.get_ylim() == pytest.approx((0.0, found.window[1]))
    assert axes.get_xticks() == pytest.approx(2.0 * math.pi * np.arange(5) / 4.0)


def test_what_does_not_go_into_one_picture_is_refused() -> None:
    one = compute_manifold(SADDLE, "stable", length=0.5)
    other = compute_manifold(SADDLE, "stable", phase=1.0, length=0.5)
    over = compute_manifold(SADDLE, "stable", over="impacts", spacing=0.1)
    cases: tuple[tuple[list[Manifold], str], ...] = (
        ([one, other], "2 phases"),
        ([one, over], "impacts and phase"),
        ([], "are none"),
    )
    for several, said in cases:
        with pytest.raises(ModelError, match=said):
            plots.manifolds(several)


def test_results_draw_themselves() -> None:
    edge = find_edge_state(BARE, MOTION)
    axes = edge.plot(Figure().add_subplot())
    tracked = next(line for line in axes.lines if line.get_label() == "tracked, period by period")
    assert np.array_equal(tracked.get_xdata(), edge.angle)
    assert not isinstance(edge.saddle, Orbit)
    assert edge.saddle is not None
    course = edge.saddle.plot(Figure().add_subplot()).lines[0]
    assert np.asarray(course.get_xdata()).max() == pytest.approx(1.04, abs=1e-3)
    found = compute_manifold(SADDLE, "unstable", length=1.0)
    assert found.plot(Figure().add_subplot()).get_xlabel() == axes.get_xlabel()


def test_axes_of_another_section_are_refused() -> None:
    shaken = Harmonic(amplitude=2.0, frequency_ratio=1.9)
    orbits = find_orbits(DimensionlessBlock(restitution=0.8), shaken, max_period=1, seeds=8)
    section = plots.poincare_section(orbits, Figure().add_subplot())
    with pytest.raises(ModelError, match="axes over impacts"):
        plots.manifolds(compute_manifold(SADDLE, "stable", length=0.5), section)
    window = np.linspace(-1.2, 1.2, 9)
    states = plots.basins(
        compute_basins(BARE, MOTION, angles=window, velocities=window), Figure().add_subplot()
    )
    over = compute_manifold(SADDLE, "stable", over="impacts", spacing=0.1)
    with pytest.raises(ModelError, match="axes over states at a phase"):
        plots.manifolds(over, states)


def test_states_of_an_orbit_of_three_periods_follow_each_other_by_one_period() -> None:
    block, shaking = (
        DimensionlessBlock(restitution=0.9),
        Harmonic(amplitude=3.0, frequency_ratio=4.0),
    )
    orbits = find_orbits(block, shaking, max_period=3, seeds=12)
    orbit = next(each for each in orbits if each.period == 3)
    for phase in (0.4, 2.0):
        states = saddle_at(orbit, phase)
        assert states.shape == (3, 2)
        for (angle, velocity), after in zip(states, np.roll(states, -1, axis=0), strict=True):
            start = State(angle=angle, velocity=velocity, phase=phase)
            end = simulate(block, shaking, start=start, cycles=1)
            assert end(end.end_time_pt).angle == pytest.approx(after[0], abs=1e-9)
            assert end(end.end_time_pt).velocity == pytest.approx(after[1], abs=1e-9)
