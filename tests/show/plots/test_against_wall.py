"""Pictures of a block against a wall: where the wall stands, what lifts, how far axes reach."""

import math

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.patches import Polygon, Rectangle

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    Pulse,
    State,
    Still,
    plots,
    simulate,
)
from rocksteady.histories import Trajectory
from rocksteady.model.equations import Model
from rocksteady.show.film._geometry import shape_of
from rocksteady.show.film._scene import BlockScene
from rocksteady.show.film.animation import film_of
from rocksteady.show.style.tokens import inks_of
from tests.every import every

FREE = Block.rectangle(width=0.3, height=3.0)
FACADE = FREE.against_wall()
LEANING = Block.asymmetric(left=0.15, right=0.25, height=1.2).against_wall(0.5)
BARE = DimensionlessBlock(restitution=0.5, one_sided=True)
PULSE = Pulse(shape="one-sine", amplitude=1.6, frequency_ratio=2.8)


def new_axes(paper: str = "white") -> Axes:
    return Figure(figsize=(6.0, 4.0), facecolor=paper).add_subplot(facecolor=paper)


def rocked(block: Block | DimensionlessBlock, model: Model | None = None) -> Trajectory:
    return simulate(block, PULSE, model=model)


def walls(axes: Axes) -> list[Rectangle]:
    """Return the rectangles in the colour of the ground that stand on it."""
    found = [patch for patch in axes.patches if isinstance(patch, Rectangle)]
    ground = to_rgba(inks_of(axes).soil)
    return [patch for patch in found if patch.get_facecolor() == ground and patch.get_y() == 0.0]


@every("paper", ["white", "black"])
@every("block", [FACADE, LEANING, BARE])
def test_the_wall_stands_at_the_edge_on_which_the_block_does_not_turn(
    block: Block | DimensionlessBlock, paper: str
) -> None:
    run = rocked(block, Linear())
    axes = plots.block(run, new_axes(paper), pt=0.5 * float(run.impacts.pt[0]))
    (wall,) = walls(axes)
    shape = shape_of(run)
    assert wall.get_x() == pytest.approx(shape.half_width)
    assert wall.get_height() > shape.height
    # The block is free of it, and turns to the left: no corner is right of the wall's face.
    times = np.linspace(0.0, float(run.impacts.pt[-1]), 50)
    scene = BlockScene(new_axes(paper), run, times)
    corners = shape.corners(scene.theta(times))
    assert (corners[..., 0] <= shape.half_width + 1e-12).all()
    low, high = axes.get_ylim()
    assert low < 0.0 < wall.get_height() < high
    assert not walls(plots.block(rocked(FREE), new_axes(paper), pt=0.5))


def test_the_ring_of_an_impact_is_where_the_top_strikes_the_wall() -> None:
    run = rocked(FACADE)
    first = float(run.impacts.pt[0])
    scene = BlockScene(new_axes(), run, np.array([first]))
    scene.show(first)
    lit = [side for side, ring in scene.rings.items() if ring.get_visible()]
    assert lit == [1]
    place = np.array(scene.rings[1].get_data(), dtype=np.float64).ravel()
    np.testing.assert_allclose(place, np.array([0.15, 3.0]))


@pytest.mark.parametrize("model", [Linear(), Nonlinear()])
def test_one_mark_lifts_the_block(model: Model) -> None:
    run = rocked(FACADE, model)
    lift = FACADE.alpha if isinstance(model, Linear) else math.tan(FACADE.alpha)
    dashed = [line for line in plots.base(run, new_axes()).lines if line.get_linestyle() == "--"]
    assert [float(np.unique(line.get_ydata())[0]) for line in dashed] == [pytest.approx(lift)]
    scene = BlockScene(new_axes(), run, np.array([0.0]))
    assert list(scene.uplifts) == [pytest.approx(lift / FACADE.alpha)]
    assert math.isfinite(scene.strongest_push)


def named_walls(axes: Axes) -> int:
    """Return how many areas of ground there are, each with its name."""
    walls = sum(patch.get_facecolor() == to_rgba(inks_of(axes).soil) for patch in axes.patches)
    assert sum(text.get_text() == "wall" for text in axes.texts) == walls
    return walls


@every("start", [0.3, 0.9, 1.4])
@every("paper", ["white", "black"])
def test_the_axis_of_angles_ends_in_the_wall(start: float, paper: str) -> None:
    run = simulate(FACADE, Still(), start=State(angle=start, velocity=0.0))
    axes = plots.trajectory(run, new_axes(paper))
    low, high = axes.get_ylim()
    assert high > math.degrees(FACADE.alpha) * min(start, 1.0)
    assert -0.15 * high < low < 0.0
    assert named_walls(axes) == 1
    face = [line for line in axes.lines if set(np.ravel(line.get_ydata())) == {0.0}]
    assert any(line.get_color() == inks_of(axes).ink for line in face)
    assert "+" not in axes.get_ylabel()
    free = plots.trajectory(
        simulate(FREE, Still(), start=State(angle=start, velocity=0.0)), new_axes(paper)
    )
    assert not named_walls(free)


def test_the_phase_plane_ends_in_the_wall() -> None:
    run = rocked(FACADE)
    axes = plots.phase_portrait(run, new_axes())
    low, high = axes.get_xlim()
    assert high > math.degrees(FACADE.alpha) * run.peak
    assert -0.15 * high < low < 0.0
    assert named_walls(axes) == 1


@pytest.mark.parametrize(
    ("block", "words"),
    [
        (FACADE, ["against a wall, restitution 0.4708", "α = 5.71°, R = 1.51 m"]),
        (BARE, ["against a wall, restitution 0.5", "drawn with α"]),
    ],
)
def test_a_film_names_the_wall_and_one_uplift(
    block: Block | DimensionlessBlock, words: list[str]
) -> None:
    run = simulate(block, Harmonic(amplitude=1.3, frequency_ratio=4.0), cycles=2)
    film = film_of(run, fps=10)
    texts = " ".join(text.get_text() for text in film.figure.texts)
    for each in words:
        assert each in texts
    key = film.scene.axes.get_legend()
    assert key is not None
    entries = [entry.get_text() for entry in key.get_texts()]
    lifts = "lifts off at αg" if block is BARE else f"lifts off at {math.tan(FACADE.alpha):.3g} g"
    assert lifts in entries
    assert "tips beyond, θ = α" in entries
    assert any(isinstance(patch, Polygon) for patch in film.scene.axes.patches)
