"""Plots of orbits: sections, multipliers, closed portraits; each shows the numbers it was given."""

import math
from collections.abc import Callable
from typing import Any

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle

from rocksteady import (
    DimensionlessBlock,
    Harmonic,
    State,
    Still,
    find_attractor,
    find_orbits,
    plots,
    simulate,
)
from rocksteady.errors import ModelError
from rocksteady.orbits import Orbit
from rocksteady.show.figures.single import cloud_figure, orbit_figure, orbits_figure
from rocksteady.show.style import palette
from rocksteady.show.style.tokens import inks_of
from tests.every import every

BARE = DimensionlessBlock(restitution=0.8)
CHAOTIC = (DimensionlessBlock(restitution=0.25), Harmonic(amplitude=6.0, frequency_ratio=6.0))
RESTING = (DimensionlessBlock(restitution=0.05), Harmonic(amplitude=1.08, frequency_ratio=0.6))


def found(ratio: float = 1.9, amplitude: float = 2.0, restitution: float = 0.8) -> list[Orbit]:
    shaking = Harmonic(amplitude=amplitude, frequency_ratio=ratio)
    return [*find_orbits(DimensionlessBlock(restitution=restitution), shaking)]


def resting() -> Orbit:
    orbit = find_attractor(*RESTING).orbit
    assert orbit is not None
    assert orbit.rest_phases == 2
    return orbit


PLOTS: dict[str, Callable[[Axes | None], Axes]] = {
    "section": lambda ax: plots.poincare_section(found(), ax),
    "cloud": lambda ax: plots.poincare_section(simulate(*CHAOTIC, cycles=60), ax),
    "multipliers": lambda ax: plots.multipliers(found(), ax),
    "to scale": lambda ax: plots.multipliers([found()[2]], ax),
    "portrait": lambda ax: plots.phase_portrait(found()[2].trajectory(), ax, mark="impacts"),
    "resting": lambda ax: plots.poincare_section([resting()], ax),
    "nothing": lambda ax: plots.poincare_section([], ax),
    "no multipliers": lambda ax: plots.multipliers([], ax),
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


@pytest.mark.slow
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


def marks(axes: Axes) -> list[Line2D]:
    """The lines that are marks of an orbit, one with data."""
    return [
        line
        for line in axes.lines
        if line.get_marker() not in ("None", "", None) and len(np.asarray(line.get_xdata()))
    ]


def points(line: Line2D) -> set[tuple[float, float]]:
    return set(
        zip(
            np.asarray(line.get_xdata(), dtype=float).tolist(),
            np.asarray(line.get_ydata(), dtype=float).tolist(),
            strict=True,
        )
    )


def legend_of(axes: Axes) -> list[str]:
    legend = axes.get_legend()
    assert legend is not None
    return [text.get_text() for text in legend.get_texts()]


# --------------------------------------------------------------------------------- section


def test_the_section_is_the_states_of_every_orbit_that_is_a_motion() -> None:
    listed = found()
    axes = plots.poincare_section(listed, Figure().add_subplot())
    drawn = set().union(*(points(line) for line in marks(axes)))
    assert drawn == {
        (state.phase, state.speed) for orbit in listed if orbit.admissible for state in orbit.states
    }
    assert axes.get_xlim() == (0.0, 2.0 * math.pi)


def test_the_mark_of_a_state_tells_side_stability_and_period() -> None:
    listed = [orbit for orbit in found() if orbit.admissible]
    assert {orbit.stable for orbit in listed} == {True, False}
    axes = plots.poincare_section(listed, Figure().add_subplot())
    styles = {point: line for line in marks(axes) for point in points(line)}
    for orbit in listed:
        for state in orbit.states:
            line = styles[state.phase, state.speed]
            assert line.get_marker() == {1: "^", -1: "v"}[state.side]
            assert line.get_fillstyle() == ("full" if orbit.stable else "none")
            inks = inks_of(axes)
            expected = inks.motion if orbit.symmetric else inks.unsymmetric_line
            assert line.get_color() == (inks.subharmonic_line if orbit.period > 1 else expected)
    assert legend_of(axes) == [
        "symmetric, unstable",
        "unsymmetric, stable",
        "subharmonic, period 3, unstable",
        "to the positive side",
        "to the negative side",
    ]


def test_what_is_neutral_is_neither_filled_nor_hollow() -> None:
    listed = found(4.0, restitution=1.0)[:1]
    assert listed[0].neutral
    for axes in (
        plots.poincare_section(listed, Figure().add_subplot()),
        plots.multipliers(listed, Figure().add_subplot()),
    ):
        assert {line.get_fillstyle() for line in marks(axes)} == {"left"}
        assert any(entry.endswith(", neutral") for entry in legend_of(axes))


def test_orbits_have_the_numbers_of_their_order_and_one_alone_has_none() -> None:
    listed = found()
    numbers = [str(k) for k, orbit in enumerate(listed, start=1) if orbit.admissible]
    assert "2" not in numbers
    for plot in (plots.poincare_section, plots.multipliers):
        texts = [text.get_text() for text in plot(listed, Figure().add_subplot()).texts]
        assert [text for text in texts if text.isdigit() and text != "10"] == [
            number for number in numbers if number != "10"
        ]
        alone = plot([listed[0]], Figure().add_subplot())
        assert not any(text.get_text().isdigit() for text in alone.texts)


def test_the_numbers_do_not_lie_on_one_another() -> None:
    figure = orbits_figure(found())
    figure.canvas.draw()
    for axes in figure.axes:
        boxes = [text.get_window_extent() for text in axes.texts if text.get_text().isdigit()]
        assert len(boxes) > 10
        for k, one in enumerate(boxes):
            for other in boxes[:k]:
                assert not one.padded(-1.0).overlaps(other.padded(-1.0))


def test_a_section_of_a_trajectory_is_its_impacts_from_a_time_on() -> None:
    run = simulate(*CHAOTIC, cycles=300)
    since = 0.5 * run.end_time_pt
    axes = plots.poincare_section(run, Figure().add_subplot(), since=since)
    impacts = run.impacts
    late = impacts.pt >= since
    after = impacts.velocity_after[late]
    expected = (run.motion.phase + 6.0 * impacts.pt[late]) % (2.0 * math.pi)  # type: ignore[union-attr]
    positive, negative = marks(axes)
    for line, there in ((positive, after > 0.0), (negative, after < 0.0)):
        np.testing.assert_array_equal(line.get_ydata(), np.abs(after[there]))
        apart = np.asarray(line.get_xdata(), dtype=float) - expected[there]
        np.testing.assert_allclose(np.sin(0.5 * apart), 0.0, atol=1e-10)
    assert positive.get_marker() != negative.get_marker()
    assert positive.get_color() != negative.get_color()


def test_a_section_needs_harmonic_shaking() -> None:
    run = simulate(BARE, Still(), start=State(angle=0.5, velocity=0.0))
    with pytest.raises(ModelError, match="harmonic"):
        plots.poincare_section(run, Figure().add_subplot())


# ----------------------------------------------------------------------------- multipliers


def circles(axes: Axes) -> list[float]:
    return [patch.get_radius() for patch in axes.patches if isinstance(patch, Circle)]


def test_multipliers_near_the_circle_are_to_scale() -> None:
    orbit = found()[2]
    assert orbit.stable
    axes = plots.multipliers([orbit], Figure().add_subplot())
    (line,) = marks(axes)
    assert points(line) == {(m.real, m.imag) for m in orbit.multipliers.tolist()}
    assert circles(axes) == [1.0]
    assert axes.get_aspect() == 1.0
    assert [text.get_text() for text in axes.texts] == ["stable inside"]


def test_far_multipliers_are_at_their_angle_and_the_logarithm_of_their_modulus() -> None:
    listed = [orbit for orbit in found() if orbit.admissible]
    axes = plots.multipliers(listed, Figure().add_subplot())
    decades = 7.0
    assert 1e6 < max(orbit.largest_multiplier for orbit in listed) < 1e7
    lines = marks(axes)
    assert len(lines) == len(listed)
    for orbit, line in zip(listed, lines, strict=True):
        drawn = np.asarray(line.get_xdata()) + 1j * np.asarray(line.get_ydata())
        for place, multiplier in zip(drawn, orbit.multipliers, strict=True):
            size = abs(multiplier)
            radius = size if size <= 1.0 else 1.0 + math.log10(size) / decades
            assert abs(place) == pytest.approx(radius)
            assert np.angle(place) == pytest.approx(np.angle(multiplier), abs=1e-12)
            assert (abs(place) < 1.0) == (size < 1.0), "stability is read off the circle"
    numbers: list[Any] = [text for text in axes.texts if text.get_text().isdigit()]
    for text, line in zip(numbers, lines, strict=True):
        # Of a conjugate pair the one above the real axis, else the larger.
        pair = np.asarray(line.get_xydata()).tolist()
        assert [*text.xy] == max(pair, key=lambda at: (round(at[1], 9), math.hypot(*at)))
    radii = circles(axes)[1:]
    names = [text.get_text() for text in axes.texts[: len(radii)]]
    assert dict(zip(names, radii, strict=True)) == pytest.approx(
        {"$10^{3}$": 1.0 + 3.0 / 7.0, "$10^{6}$": 1.0 + 6.0 / 7.0}
    )
    for text, radius in zip(axes.texts, radii, strict=False):  # on its ring
        assert math.hypot(*text.get_position()) == pytest.approx(radius)
    assert any("log" in text.get_text() for text in axes.texts)
    for radius in circles(axes):
        assert radius < axes.get_xlim()[1]


def test_multipliers_of_a_rest_lie_at_0() -> None:
    (line,) = marks(plots.multipliers([resting()], Figure().add_subplot()))
    assert points(line) == {(0.0, 0.0)}


# -------------------------------------------------------------------- a period as a course


@pytest.mark.slow
@every(("amplitude", "ratio"), [(2.0, 1.9), (2.0, 4.0), (1.2, 0.7), (1.2, 1.9)])
def test_the_course_of_any_orbit_closes_and_has_its_peaks(amplitude: float, ratio: float) -> None:
    listed = [orbit for orbit in found(ratio, amplitude) if orbit.admissible]
    for orbit in [*listed, *(orbit.mirrored for orbit in listed)]:
        course = orbit.trajectory()
        assert course.end_time_pt == pytest.approx(orbit.period * 2.0 * math.pi / ratio, rel=1e-14)
        assert len(course.impacts) == len(orbit.states)
        assert course.peak == pytest.approx(max(orbit.highest, -orbit.lowest), abs=1e-9)
        first = orbit.states[0]
        last = course(course.end_time_pt)
        assert last.angle == 0.0
        assert last.velocity == pytest.approx(first.side * first.speed, rel=1e-12)
        # Each flight ends where and as the next begins.
        ends = course.flights.pt[:-1] + course.flights.duration[:-1]
        np.testing.assert_allclose(ends, course.flights.pt[1:], atol=1e-7)
        np.testing.assert_allclose(
            course.impacts.velocity_after, course.flights.velocity[1:], atol=1e-7
        )


def test_the_course_of_an_orbit_that_rests_shows_its_bounces() -> None:
    orbit = resting()
    course = orbit.trajectory()
    assert course.end_time_pt == pytest.approx(2.0 * math.pi / 0.6)
    assert len(course.impacts) > 2 * orbit.rest_phases
    assert course.rest_time_pt is None, "it lifts again"
    assert course.peak == pytest.approx(orbit.highest)


def test_what_passes_through_the_floor_has_no_course() -> None:
    (inadmissible,) = (orbit for orbit in found() if not orbit.admissible)
    with pytest.raises(ModelError, match="floor"):
        inadmissible.trajectory()


def test_the_portrait_of_an_orbit_is_closed_with_a_mark_after_each_impact() -> None:
    for orbit in found()[2:6]:
        axes = plots.phase_portrait(orbit.trajectory(), Figure().add_subplot(), mark="impacts")
        path, states = axes.lines
        angle, velocity = (np.asarray(v, dtype=float) for v in path.get_data())
        assert angle[0] == angle[-1] == 0.0
        assert velocity[-1] == pytest.approx(velocity[0], rel=1e-12)
        assert (angle.max(), angle.min()) == pytest.approx((orbit.highest, orbit.lowest), abs=2e-3)
        assert sorted(np.asarray(states.get_ydata(), dtype=float)) == pytest.approx(
            sorted(state.side * state.speed for state in orbit.states), abs=1e-7
        )
        assert legend_of(axes) == ["after an impact"]


# --------------------------------------------------------------------------------- figures


def whole_figures() -> dict[str, Figure]:
    run = simulate(*CHAOTIC, cycles=80)
    orbit = found()[2]
    return {
        "orbit": orbit_figure(orbit, orbit.trajectory(), "title"),
        "orbits": orbits_figure(found(), "title"),
        "none": orbits_figure([], "title"),
        "cloud": cloud_figure(run, run, since=0.5 * run.end_time_pt, title="title"),
    }


@pytest.mark.slow
def test_every_figure_has_its_title_its_labels_and_room_for_its_legends() -> None:
    for name, figure in whole_figures().items():
        assert figure.get_suptitle() == "title"
        figure.canvas.draw()
        for axes in figure.axes:
            assert axes.get_ylabel(), name
            assert axes.get_xlabel() or not axes.xaxis.get_tick_params()["labelbottom"]
            legend = axes.get_legend()
            if legend is not None:
                frame, box = legend.get_window_extent(), axes.get_window_extent()
                assert box.x0 <= frame.x0 < frame.x1 <= box.x1, name
                assert box.y0 <= frame.y0 < frame.y1 <= box.y1 or frame.y1 < box.y0, name


@pytest.mark.slow
def test_the_legend_of_a_section_hides_no_state() -> None:
    for listed in (found(), found(4.0), found(0.7, 1.2), found(4.0, restitution=1.0)):
        figure = orbits_figure(listed)
        figure.canvas.draw()
        section = figure.axes[0]
        legend = section.get_legend()
        assert legend is not None
        frame = legend.get_window_extent()
        for line in marks(section):
            for x, y in section.transData.transform(sorted(points(line))):
                assert not frame.contains(x, y)
