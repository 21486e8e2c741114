"""Pictures and films of runs under pulses: the whole pulse, its steps and impulses, its name."""

import math

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from rocksteady import Block, DimensionlessBlock, Piecewise, Pulse, SyntheticMotion, plots, simulate
from rocksteady.dynamics.history import base_motion
from rocksteady.histories import Trajectory
from rocksteady.model.equations import Linear
from rocksteady.motions import Impulses, Segment
from rocksteady.show.film._playback import FEWEST_A_PERIOD
from rocksteady.show.film.animation import film_of
from tests.every import every

Floats = NDArray[np.float64]

BLOCK = Block.rectangle(width=0.5, height=2.0)
BARE = DimensionlessBlock(restitution=0.9)


def under(name: str, a: float, w: float, block: Block | DimensionlessBlock = BARE) -> Trajectory:
    return simulate(block, Pulse(shape=name, amplitude=a, frequency_ratio=w), model=Linear())


def course(line: Line2D) -> tuple[Floats, Floats]:
    return np.array(line.get_xdata(), dtype=float), np.array(line.get_ydata(), dtype=float)


def arrows(axes: Axes, marker: str) -> tuple[Floats, Floats]:
    """Times and heights of the heads of arrows."""
    heads = [course(line) for line in axes.lines if line.get_marker() == marker]
    return heads[0] if heads else (np.empty(0), np.empty(0))


@every("name", ["rectangle", "decaying-ramp", "one-cosine", "type-c1"])
def test_a_step_of_the_base_is_drawn_upright(name: str) -> None:
    run = under(name, 3.0, 40.0)
    axes = plots.base(run, Figure().add_subplot())
    times, base = course(axes.lines[0])
    end = run.segments[0, 0]
    (at,) = np.flatnonzero(times == end)
    assert base[at] == 0.0
    assert end - times[at - 1] < 1e-15
    expected = base_motion.base_acceleration(run.segments, np.nextafter(end, 0.0))
    assert base[at - 1] == expected


@every("w", [2.0, 50.0, 5000.0])
def test_a_pulse_is_drawn_smooth_however_quick(w: float) -> None:
    run = under("one-sine", 2.0, w)
    axes = plots.base(run, Figure().add_subplot())
    _, base = course(axes.lines[0])
    assert base.max() == pytest.approx(2.0, rel=2e-3)
    assert base.min() == pytest.approx(-2.0, rel=2e-3)
    assert np.abs(np.diff(base)).max() < 0.15, "a hundred points a period"


def test_times_ask_for_no_more_points_than_before_where_a_pulse_is_slow() -> None:
    run = under("one-sine", 2.0, 2.0)
    even = math.ceil(100 * run.shown_to_pt) + 1
    assert len(run.times()) <= even + len(run.rows)


def test_impulses_are_arrows_where_and_whither_they_strike() -> None:
    run = simulate(
        BLOCK, Impulses(velocities=(0.3, -0.5, 0.2), times=(1.0, 2.0, 3.0)), model=Linear()
    )
    axes = plots.base(run, Figure().add_subplot())
    (up_times, ups), (down_times, downs) = arrows(axes, "^"), arrows(axes, "v")
    np.testing.assert_allclose(up_times, np.array([1.0, 3.0]) / BLOCK.p)
    np.testing.assert_allclose(down_times, np.array([2.0]) / BLOCK.p)
    lifts = math.tan(BLOCK.alpha)
    assert ups.min() > lifts
    assert downs.max() < -lifts
    axes = plots.base(under("one-sine", 2.0, 2.0), Figure().add_subplot())
    assert len(arrows(axes, "^")[0]) == len(arrows(axes, "v")[0]) == 0


def test_a_picture_shows_the_base_to_its_end() -> None:
    motion = SyntheticMotion(rms=0.5, frequency_ratio=6.0, duration=30.0, seed=1)
    run = simulate(DimensionlessBlock(restitution=0.5), motion)
    assert run.rest_time_pt is not None
    assert run.rest_time_pt < 25.0
    assert 30.0 <= run.shown_to_pt < 31.0
    axes = plots.trajectory(run, Figure().add_subplot())
    assert axes.get_xlim()[1] >= 30.0


@pytest.mark.parametrize(
    ("block", "label", "base"),
    [(BLOCK, "time [s]", "base  $a$ [g]"), (BARE, "pivot time  $pt$", r"base  $a/(\alpha g)$")],
)
def test_the_axes_have_units(block: Block | DimensionlessBlock, label: str, base: str) -> None:
    axes = plots.base(under("versed-sine", 2.0, 3.0, block), Figure().add_subplot())
    assert axes.get_xlabel() == label
    assert axes.get_ylabel() == base


@every("name", ["triangle", "ricker", "mavroeidis-papageorgiou", "one-sine"])
def test_a_film_names_the_pulse_and_shows_it(name: str) -> None:
    run = under(name, 2.0, 9.0, BLOCK)
    film = film_of(run)
    words = [text.get_text() for text in film.figure.texts]
    assert words[0] == f"Pulse {name}, 0.49 g, 3.83 Hz"
    assert words[1].startswith("α = 14°, R = 1.03 m, restitution 0.9118, true scale")
    period = 2.0 * math.pi / 9.0
    assert np.diff(film.reel.times).max() <= period / FEWEST_A_PERIOD * (1.0 + 1e-9)
    width = film.figure.bbox.width
    for text in film.figure.texts:
        assert text.get_window_extent().x1 < width


def test_quick_sinusoids_of_any_motion_that_ends_get_their_points() -> None:
    pieces = (Segment(duration=1.0), Segment(duration=0.5, amplitude=2.0, frequency=300.0))
    run = simulate(BARE, Piecewise(pieces=pieces))
    times = run.times(10)
    inside = times[(times >= 1.0) & (times <= 1.5)]
    assert np.diff(inside).max() <= 2.0 * math.pi / 300.0 / 10.0 * (1.0 + 1e-9)
