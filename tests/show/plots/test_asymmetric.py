"""Pictures of a block whose sides differ: where its mass centre is, and where it balances."""

import cmath
import math
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocksteady import Block, DimensionlessBlock, Harmonic, State, Still, plots, simulate
from rocksteady.errors import InputError
from rocksteady.formulas import Outline
from rocksteady.histories import Trajectory
from rocksteady.model.equations import Linear
from rocksteady.show.film._geometry import shape_of
from rocksteady.show.film._scene import BlockScene
from rocksteady.show.film.animation import film_of
from tests.every import every

BLOCK = Block.asymmetric(left=0.15, right=0.25, height=1.2)
LOW = replace(  # reaches beyond its base, and its mass centre is low
    Block.asymmetric(left=0.2, right=0.3, height=1.8, mass_centre_height=0.5),
    outline=Outline(height=1.8, left_overhang=0.2, right_overhang=0.1),
)
UNLIKE = DimensionlessBlock(restitution=0.85, negative_restitution=0.75, alpha_ratio=1.8)
SHAKEN = Harmonic(amplitude=2.0, frequency_ratio=5.0)


def new_axes() -> Axes:
    return Figure(figsize=(6.0, 4.0)).add_subplot()


def balanced(block: Block | DimensionlessBlock, side: int) -> Trajectory:
    """Return a run that begins where the block balances on a side, on a still base."""
    one = simulate(block, Still(), start=State(angle=0.1, velocity=0.0), model=Linear())
    start = State(angle=one.balances[0 if side < 0 else 1], velocity=0.0)
    return simulate(block, Still(), start=start, model=Linear())


def mass_centre(scene: BlockScene) -> tuple[float, float]:
    """Return where the mass centre is drawn, in the units of the axes."""
    pixels = scene.mass.get_transform().transform(np.column_stack(scene.mass.get_data()))
    ((x, y),) = scene.axes.transData.inverted().transform(pixels)
    return x, y


@every("side", [-1, 1])
@every("block", [BLOCK, LOW, UNLIKE])
def test_where_it_balances_its_mass_centre_is_drawn_above_the_pivot(
    block: Block | DimensionlessBlock, side: int
) -> None:
    scene = BlockScene(new_axes(), balanced(block, side), np.array([0.0]))
    scene.show(0.0)
    x, y = mass_centre(scene)
    pivot = -side * scene.shape.half_width
    assert x == pytest.approx(pivot, abs=1e-9)
    arm = scene.shape.left if side > 0 else scene.shape.right
    centre = 0.5 if block == LOW else 0.5 * scene.shape.height
    assert y == pytest.approx(math.hypot(arm, centre), rel=1e-9)


def test_at_rest_its_mass_centre_is_where_it_is() -> None:
    run = simulate(BLOCK, Harmonic(amplitude=0.5, frequency_ratio=2.0), cycles=1)
    scene = BlockScene(new_axes(), run, np.array([0.0]))
    scene.show(0.0)
    x, y = mass_centre(scene)
    base = float(scene.ground(0.0)) - 0.5 * BLOCK.width
    assert (x - base, y) == pytest.approx((0.15, 0.6))


@every("angle", [-0.9, 0.9])
def test_the_drawn_top_is_where_a_turn_about_the_edge_takes_it(angle: float) -> None:
    run = simulate(LOW, Still(), start=State(angle=angle, velocity=0.0))
    axes = new_axes()
    scene = BlockScene(axes, run, np.linspace(0.0, 1.0, 9))
    scene.show(0.0)
    drawn = (scene.body.get_transform() - axes.transData).transform(scene.body.get_xy())[2:4]
    pivot = math.copysign(0.25, -angle)
    turn = cmath.exp(1j * angle * LOW.alpha)
    upper = [pivot + (x + 1.8j - pivot) * turn for x in (0.35, -0.45)]
    assert drawn[:, 0] + 1j * drawn[:, 1] == pytest.approx(upper)
    (left, right), (_, high) = axes.get_xlim(), axes.get_ylim()
    assert left < drawn[:, 0].min() < drawn[:, 0].max() < right
    assert drawn[:, 1].max() < high


def test_a_body_wider_than_its_base_lies_on_its_side_and_not_in_the_ground() -> None:
    run = simulate(LOW, Still(), start=State(angle=1.01, velocity=0.0))
    film = film_of(run)
    assert film.fall is not None
    last = float(film.fall.lands_pt)
    scene = BlockScene(new_axes(), run, np.array([0.0, last]), fall=film.fall)
    corners = scene.shape.corners(scene.theta(last))
    assert corners[:, 1].min() == pytest.approx(0.0, abs=1e-12)
    assert corners[[0, 3], 1] == pytest.approx([0.0, 0.0], abs=1e-12)


def test_the_model_of_a_low_mass_centre_has_two_heights() -> None:
    texts = [text.get_text() for text in plots.block(LOW, new_axes()).texts]
    for symbol, value in (("$H$", "1.8 m"), ("$h$", "0.5 m")):
        assert value in texts[texts.index(symbol, texts.index("$H$") + 1) :]
    assert "$2h$" not in texts
    assert "$2h$" in [text.get_text() for text in plots.block(BLOCK, new_axes()).texts]


def test_a_dimensionless_block_is_drawn_with_the_ratio_of_its_slendernesses() -> None:
    run = simulate(UNLIKE, Still(), start=State(angle=0.5, velocity=0.0))
    shape = shape_of(run, 0.3)
    angles = math.atan2(shape.left, 0.5 * shape.height), math.atan2(shape.right, 0.5 * shape.height)
    assert angles == pytest.approx((0.3, 1.8 * 0.3))
    assert shape_of(run).alpha == pytest.approx(0.2 / 1.8)
    with pytest.raises(InputError, match="alpha"):
        shape_of(run, 0.9)  # the other side's would lie beyond a right angle


def test_time_histories_have_a_line_at_the_balance_of_either_side() -> None:
    run = simulate(BLOCK, SHAKEN, cycles=5, model=Linear())
    degrees = [-math.degrees(BLOCK.negative.alpha), math.degrees(BLOCK.alpha)]
    uplifts = [-BLOCK.negative.alpha, BLOCK.alpha]
    for axes, expected in (
        (plots.trajectory(run, new_axes()), degrees),
        (plots.base(run, new_axes()), uplifts),
    ):
        levels = [np.unique(np.asarray(line.get_ydata(), dtype=float)) for line in axes.lines]
        flat = sorted(level.item() for level in levels if level.size == 1 and level[0] != 0.0)
        assert flat == pytest.approx(expected)
        (far,) = (each for each in axes.child_axes if each.get_ylabel())
        assert r"\alpha_+" in far.get_ylabel()
    bare = plots.phase_portrait(simulate(UNLIKE, SHAKEN, cycles=5), new_axes())
    assert r"\alpha_+" in bare.get_xlabel()


def test_a_fall_to_its_flatter_side_is_shown_beyond_the_balance_there() -> None:
    run = simulate(UNLIKE, Still(), start=State(angle=0.0, velocity=-2.5))
    low, high = plots.trajectory(run, new_axes()).get_ylim()
    assert low < -1.8
    assert high > 1.0


def test_the_marks_of_uplift_are_at_the_alpha_of_either_side() -> None:
    run = simulate(BLOCK, SHAKEN, cycles=2, model=Linear())
    scene = BlockScene(new_axes(), run, np.array([0.0]))
    places = [np.asarray(line.get_xdata(), dtype=float) for line in scene.axes.lines]
    edges = {-scene.shape.half_width, scene.shape.half_width}
    marks = sorted(float(x[0]) for x in places if len(x) == 2 and x[0] == x[1] not in edges)
    lean = BLOCK.negative.alpha / BLOCK.alpha
    assert len(marks) == 3
    assert marks[0] / marks[2] == pytest.approx(-lean)
    assert marks[1] == 0.0


def test_in_the_nonlinear_model_it_lifts_at_the_tangent_of_either_alpha() -> None:
    run = simulate(BLOCK, SHAKEN, cycles=3)
    lifts = [
        -math.tan(BLOCK.negative.alpha),
        math.tan(BLOCK.positive.alpha),
    ]
    levels = [np.unique(np.asarray(line.get_ydata())) for line in plots.base(run, new_axes()).lines]
    flat = sorted(level.item() for level in levels if level.size == 1 and level[0] != 0.0)
    assert flat == pytest.approx(lifts)
    film = film_of(run, fps=10)
    places = [np.asarray(line.get_xdata(), dtype=float) for line in film.scene.axes.lines]
    edges = {-film.scene.shape.half_width, film.scene.shape.half_width}
    marks = sorted(float(x[0]) for x in places if len(x) == 2 and x[0] == x[1] not in edges)
    assert marks[0] / marks[2] == pytest.approx(lifts[0] / lifts[1])
    legend = film.scene.axes.get_legend()
    assert legend is not None
    assert any("lifts off at −0.417, 0.25 g" in text.get_text() for text in legend.get_texts())


def test_words_of_a_film_tell_both_sides() -> None:
    film = film_of(simulate(BLOCK, SHAKEN, cycles=3), fps=10)
    title = film.figure.texts[0].get_text()
    assert "α = 14°/22.6°" in title
    assert "α₊" in film.scene.tilt.get_text()
    legend = film.scene.axes.get_legend()
    assert legend is not None
    assert any("θ = α₊, −α₋" in text.get_text() for text in legend.get_texts())


def test_plot_block_draws_it() -> None:
    run = simulate(BLOCK, Still(), start=State(angle=-1.5, velocity=0.0), model=Linear())
    axes = plots.block(run, new_axes(), pt=0.0)
    assert "α₊" in axes.texts[1].get_text()
