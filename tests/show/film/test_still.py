"""The block on its ground: true lengths, the right corner, and a ground that obeys its motion."""

import cmath
import math
from collections.abc import Iterator
from typing import Any

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Piecewise,
    State,
    Steady,
    Still,
    plots,
    simulate,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.histories import Trajectory
from rocksteady.model.equations import Linear
from rocksteady.motions import Segment
from rocksteady.show.film._geometry import Shape, shape_of
from rocksteady.show.film._scene import BlockScene, signed
from rocksteady.show.film.animation import uplift_words
from rocksteady.show.style import palette
from rocksteady.show.style.tokens import HATCHES, inks_of

BARE = DimensionlessBlock(restitution=0.8)
BLOCK = Block.named("tso-wong-1989")
SHAKEN = Harmonic(amplitude=2.0, frequency_ratio=1.7)
PIECES = Piecewise(
    pieces=(
        Segment(duration=0.7, constant=0.4, slope=1.1, amplitude=1.5, frequency=3.0, phase=0.4),
        Segment(duration=0.9, constant=-1.2, amplitude=0.6, frequency=5.0, phase=-1.0),
        Segment(duration=0.5, slope=-0.8),
    )
)


@pytest.fixture(autouse=True)
def matplotlib_left_as_it_was() -> Iterator[None]:
    settings = dict(mpl.rcParams)
    open_figures = plt.get_fignums()
    yield
    assert dict(mpl.rcParams) == settings
    assert plt.get_fignums() == open_figures


def falling() -> Trajectory:
    return simulate(BLOCK, SHAKEN, start=Steady(), cycles=40)


def new_axes() -> Axes:
    return Figure(figsize=(6.0, 4.0)).add_subplot()


def drawn_corners(axes: Axes) -> Any:
    """The body's corners in the units of the axes, through everything that draws them."""
    bodies = [
        p
        for p in axes.patches
        if isinstance(p, Polygon) and len(p.get_xy()) == 5 and not p.get_hatch()
    ]
    (body,) = bodies
    pixels = body.get_transform().transform(np.asarray(body.get_xy())[:4])
    return axes.transData.inverted().transform(pixels)


# -------------------------------------------------------------------------------- geometry


@given(
    left=st.floats(0.01, 100.0),
    right=st.floats(0.01, 100.0),
    height=st.floats(0.01, 100.0),
    theta=st.floats(-0.5 * math.pi, 0.5 * math.pi),
)
def test_corners_are_a_rotation_about_the_pivot_in_the_complex_plane(
    left: float, right: float, height: float, theta: float
) -> None:
    radius = left + right + height
    shape = Shape(
        alpha=math.atan2(left, 0.5 * height),
        radius=math.hypot(left, 0.5 * height),
        left=left,
        right=right,
        height=height,
        travel=1.0,
        unit="m",
    )
    b, h = 0.5 * (left + right), height
    pivot = b if theta < 0.0 else -b
    standing = np.array([-b, b, b + 1j * h, -b + 1j * h])
    turned = pivot + (standing - pivot) * cmath.exp(1j * theta)
    corners = shape.corners(theta)
    np.testing.assert_allclose(corners[:, 0] + 1j * corners[:, 1], turned, atol=1e-12 * radius)
    assert corners[:, 1].min() >= -1e-12 * radius, "no corner is below the ground"


@pytest.mark.slow
def test_the_drawn_block_keeps_its_size_and_stands_on_its_pivot() -> None:
    run = falling()
    b = BLOCK.radius * math.sin(BLOCK.alpha)
    for s in np.linspace(0.0, run.end_time_pt, 60):
        corners = drawn_corners(plots.block(run, new_axes(), pt=float(s)))
        for one, other in ((0, 2), (1, 3)):
            diagonal = np.linalg.norm(corners[one] - corners[other])
            assert diagonal == pytest.approx(2.0 * BLOCK.radius)
        angle = float(run(s).angle)
        edge = corners[1] - corners[0]
        assert math.atan2(edge[1], edge[0]) == pytest.approx(angle * BLOCK.alpha, abs=1e-9)
        # a = -A sin: the ground of harmonic shaking is where its acceleration over -omega^2 is.
        omega = 1.7 * BLOCK.p
        acceleration = float(run.base_acceleration(s)) * BLOCK.alpha * 9.80665
        pivot = corners[0] if angle > 0.0 else corners[1]
        ground = -acceleration / omega**2
        assert pivot == pytest.approx([ground + (-b if angle > 0.0 else b), 0.0], abs=1e-9)


def test_the_mass_centre_leaves_the_band_where_the_angle_passes_alpha() -> None:
    shape = shape_of(simulate(BLOCK, Still(), start=State(angle=0.5, velocity=0.0), model=Linear()))
    for part in (0.999, -0.999, 1.001, -1.001):
        x = shape.corners(part * BLOCK.alpha)[:, 0].mean()
        assert (abs(x) < shape.half_width) == (abs(part) < 1.0)


def test_a_block_is_drawn_in_metres_and_a_dimensionless_one_in_radii() -> None:
    start = State(angle=0.5, velocity=0.0)
    wide = Block.rectangle(width=0.5, height=2.0)
    axes = plots.block(simulate(wide, Still(), start=start, model=Linear()), new_axes(), pt=0.0)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("position [m]", "height [m]")
    corners = drawn_corners(axes)
    assert np.linalg.norm(corners[0] - corners[1]) == pytest.approx(0.5)
    assert np.linalg.norm(corners[1] - corners[2]) == pytest.approx(2.0)
    axes = plots.block(simulate(BARE, Still(), start=start), new_axes(), pt=0.0, alpha=0.3)
    assert axes.get_xlabel() == palette.LABELS["position_radius"]
    corners = drawn_corners(axes)
    assert np.linalg.norm(corners[0] - corners[2]) == pytest.approx(2.0)
    assert np.linalg.norm(corners[0] - corners[1]) == pytest.approx(2.0 * math.sin(0.3))


def test_lengths_are_equal_in_both_directions_and_everything_is_in_the_picture() -> None:
    run = falling()
    for size in ((6.0, 2.0), (2.5, 6.0)):
        axes = plots.block(run, Figure(figsize=size).add_subplot(), pt=run.end_time_pt)
        axes.figure.canvas.draw()
        assert axes.get_aspect() == 1.0
        (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
        corners = drawn_corners(axes)
        assert x0 < corners[:, 0].min() < corners[:, 0].max() < x1
        assert y0 < corners[:, 1].min() < corners[:, 1].max() < y1


def test_a_block_beyond_a_right_angle_lies_on_the_ground() -> None:
    stocky = Block.rectangle(width=1.0, height=0.9, restitution=0.5)
    run = simulate(stocky, Still(), start=State(angle=1.01, velocity=0.0), model=Linear())
    corners = drawn_corners(plots.block(run, new_axes(), pt=run.end_time_pt))
    assert corners[0] == pytest.approx(corners[0] * [1.0, 0.0], abs=1e-12)
    assert sorted(corners[:, 1]) == pytest.approx([0.0, 0.0, 1.0, 1.0], abs=1e-9)


# ---------------------------------------------------------------------------------- ground


@pytest.mark.parametrize("motion", [PIECES, SHAKEN], ids=["pieces", "harmonic"])
def test_the_second_difference_of_the_ground_is_the_base_acceleration(
    motion: Piecewise | Harmonic,
) -> None:
    run = simulate(BARE, motion, start=State(angle=0.1, velocity=0.0))
    h = 1e-4
    s = np.linspace(h, 2.4, 97)
    before, at, after = (run.base_displacement(s + d) for d in (-h, 0.0, h))
    kinks = np.array([0.7, 1.6, 2.1])
    smooth = np.abs(s[:, np.newaxis] - kinks).min(axis=1) > 2.0 * h
    assert smooth.sum() > 90
    found = (before - 2.0 * at + after) / h**2
    np.testing.assert_allclose(found[smooth], run.base_acceleration(s)[smooth], atol=3e-6)


def test_ground_in_pieces_starts_from_rest_and_coasts_on_after_them() -> None:
    run = simulate(BARE, PIECES, start=State(angle=0.1, velocity=0.0))
    np.testing.assert_allclose(run.base_displacement([0.0, 1e-8]), [0.0, 0.0], atol=1e-15)
    # Velocity at the end: the acceleration summed by the midpoint rule.
    middle = (np.arange(210_000) + 0.5) * 1e-5
    velocity = run.base_acceleration(middle).sum() * 1e-5
    far = run.base_displacement([10.0, 11.0])
    assert far[1] - far[0] == pytest.approx(velocity, abs=1e-9)


def test_a_jump_moves_the_ground_as_a_short_strong_push_does() -> None:
    start = State(angle=0.3, velocity=0.0)
    jump = Piecewise(pieces=(Segment(duration=1.0), Segment(duration=1.0, jump=0.25)))
    short = 1e-7
    push = Piecewise(pieces=(Segment(duration=1.0), Segment(duration=short, constant=0.25 / short)))
    one, other = (simulate(BARE, motion, start=start) for motion in (jump, push))
    # The block's own answer to both is the same, so the ground's has to be as well.
    assert float(one(1.2).velocity) == pytest.approx(float(other(1.2).velocity), abs=1e-6)
    for s in (0.5, 1.0, 1.3, 1.9):
        place = float(one.base_displacement(s))
        assert place == pytest.approx(0.25 * max(0.0, s - 1.0), abs=1e-12)
        assert place == pytest.approx(float(other.base_displacement(s)), abs=1e-6)


def test_the_ground_of_a_rectangle_in_metres_and_in_radii_is_one() -> None:
    block = Block.from_radius(alpha=0.2, radius=3.0, restitution=0.8)
    metres, radii = (shape_of(simulate(b, SHAKEN, cycles=1)) for b in (block, BARE))
    assert metres.travel == pytest.approx(3.0 * radii.travel)


# ------------------------------------------------------------------------ pivot and impacts


def scene_at(run: Trajectory, s: float, glow: float = 0.5) -> BlockScene:
    scene = BlockScene(new_axes(), run, np.array([s]), glow=glow)
    scene.show(s)
    return scene


def test_the_pivot_is_the_corner_on_the_ground_and_both_at_rest() -> None:
    run = simulate(BARE, Harmonic(amplitude=2.0, frequency_ratio=4.0), cycles=10)
    b = math.sin(0.2)
    assert sorted(np.asarray(scene_at(run, 0.0).pivots.get_xdata())) == pytest.approx([-b, b])
    for s in np.linspace(0.5, run.end_time_pt, 23):
        if abs(float(run(s).angle)) > 1e-6:
            corner = -b if run(s).angle > 0.0 else b
            assert scene_at(run, float(s)).pivots.get_xdata() == pytest.approx([corner])


def test_an_impact_is_seen_at_the_corner_that_was_in_the_air_and_fades() -> None:
    run = simulate(BARE, Harmonic(amplitude=2.0, frequency_ratio=4.0), cycles=10)
    for impact, side in zip(run.impacts.pt[:8], run.impacts.side[:8], strict=True):
        before = float(run(impact - 1e-3).angle)
        raised = 1 if before > 0.0 else -1  # positive rotation lifts the right corner
        assert side == raised
        just, later = (scene_at(run, impact + d, glow=0.3) for d in (0.01, 0.2))
        assert just.rings[raised].get_visible()
        (x,) = np.asarray(just.rings[raised].get_xdata())
        assert x == pytest.approx(raised * math.sin(0.2))
        if later.rings[raised].get_visible():
            faded, fresh = (scene.rings[raised].get_alpha() for scene in (later, just))
            assert faded is not None
            assert fresh is not None
            assert faded < fresh
            assert later.rings[raised].get_markersize() > just.rings[raised].get_markersize()
        quiet = scene_at(run, impact - 0.01, glow=0.01)
        assert not any(ring.get_visible() for ring in quiet.rings.values())


def test_the_arrow_points_where_the_base_accelerates() -> None:
    run = simulate(BARE, Harmonic(amplitude=2.0, frequency_ratio=4.0), cycles=10)
    lengths = []
    for s in (0.3, 1.0, 1.2):
        scene = scene_at(run, s)
        x = scene.arrow.get_xy()[:, 0]
        tip = x[np.abs(x).argmax()]
        lengths.append(tip / float(run.base_acceleration(s)))
    assert lengths == pytest.approx([lengths[0]] * 3)
    assert lengths[0] > 0.0
    still = simulate(BARE, Still(), start=State(angle=0.5, velocity=0.0))
    assert not scene_at(still, 0.0).arrow.get_visible()


def test_the_block_wears_its_state_and_names_it() -> None:
    run = falling()
    assert run.overturn_time_pt is not None
    words = {}
    for s in (0.0, run.overturn_time_pt * (1.0 - 1e-9), run.overturn_time_pt, run.end_time_pt):
        scene = scene_at(run, s)
        words[s] = scene.verdict.get_text()
        state = "falls" if s >= run.overturn_time_pt else "rocks"
        assert to_hex(scene.body.get_facecolor()) == getattr(inks_of(scene.axes), state)
        assert scene.pattern.get_visible() == (state == "falls")
        assert scene.pattern.get_hatch() == HATCHES["falls"]
    assert list(words.values()) == ["rocks", "rocks", "falls", "falls"]
    rest = simulate(BLOCK, Still(), start=State(angle=0.5, velocity=0.0), model=Linear())
    assert rest.rest_time_pt is not None
    scene = scene_at(rest, rest.rest_time_pt)
    assert scene.verdict.get_text() == "at rest"
    assert to_hex(scene.body.get_facecolor()) == inks_of(scene.axes).rest
    assert scene_at(rest, 0.0).verdict.get_text() == "rocks"


def test_the_numbers_in_the_picture() -> None:
    run = falling()
    s = 6.6 * BLOCK.p
    scene = scene_at(run, s)
    angle = float(run(s).angle)
    degrees = math.degrees(angle * BLOCK.alpha)
    assert scene.clock.get_text() == "t = 6.60 s"
    assert scene.tilt.get_text() == f"θ = +{degrees:.1f}° = +{angle:.2f} α"
    pushed = abs(float(run.base_acceleration(s))) * BLOCK.alpha
    assert scene.push.get_text() == f"a = −{pushed:.2f} g"
    slender = simulate(BARE, SHAKEN, start=Steady(), cycles=40)
    bare, angle = scene_at(slender, s), float(slender(s).angle)
    degrees = math.degrees(angle * BLOCK.alpha)
    assert bare.tilt.get_text() == f"θ = +{angle:.2f} α = +{degrees:.1f}°"
    assert bare.push.get_text().endswith(" αg")
    moon = Block.rectangle(width=0.4, height=2.0, gravity=1.62)  # g are of 9.80665 m/s^2 there too
    light = scene_at(simulate(moon, SHAKEN, cycles=1), 0.3)
    pushed = float(light.trajectory.base_acceleration(0.3)) * moon.alpha * 1.62 / 9.80665
    assert light.push.get_text() == f"a = {signed(pushed, 2)} g"
    assert uplift_words(light) == f"lifts off at ±{0.2 * 1.62 / 9.80665:.3g} g"
    assert (signed(0.0, 2), signed(-0.001, 2), signed(1.005e7, 2)) == ("0.00", "0.00", "+1.00e+07")


def test_ground_that_travels_far_is_followed_past_lines_that_stand_still() -> None:
    slow = simulate(BARE, Harmonic(amplitude=0.9, frequency_ratio=0.25), cycles=1)
    times = np.linspace(0.0, slow.end_time_pt, 200)
    scene = BlockScene(new_axes(), slow, times)
    assert scene.camera == "following"
    ticks = scene.axes.get_xticks()
    for s in times[::20]:
        scene.show(float(s))
        low, high = scene.axes.get_xlim()
        assert 0.5 * (low + high) == pytest.approx(float(scene.ground(s)))
        assert drawn_corners(scene.axes)[:2, 0].mean() == pytest.approx(float(scene.ground(s)))
    assert (np.diff(scene.axes.get_xticks())[0]) == pytest.approx(np.diff(ticks)[0])
    # Seen so seldom that no line could be followed, the camera stays on the ground.
    riding = BlockScene(new_axes(), slow, times[::40])
    assert riding.camera == "riding"
    riding.show(float(times[40]))
    assert drawn_corners(riding.axes)[:2, 0].mean() == pytest.approx(0.0, abs=1e-12)
    assert riding.axes.get_xlabel() == palette.LABELS["ground_radius"]
    near = BlockScene(new_axes(), falling(), np.linspace(0.0, 40.0, 100))
    assert near.camera == "fixed"


# ------------------------------------------------------------------------------------- model


def texts_of(axes: Axes) -> list[str]:
    return [text.get_text() for text in axes.texts if text.get_text()]


def test_a_block_alone_is_drawn_with_its_measures_and_signs() -> None:
    block = Block.rectangle(width=0.5, height=2.0, restitution=0.85)
    axes = block.plot(new_axes())
    corners = drawn_corners(axes)
    assert np.linalg.norm(corners[0] - corners[1]) == pytest.approx(0.5)
    assert np.linalg.norm(corners[1] - corners[2]) == pytest.approx(2.0)
    assert corners[1][1] > corners[0][1] == pytest.approx(0.0), "positive tilt is about the left"
    seen = texts_of(axes)
    for words in ("0.5 m", "2 m", "14°", "1.03 m", "0.85", r"$\theta > 0$", r"$\ddot u_g > 0$"):
        assert words in seen
    assert any(r"\delta" in words and "impact" in words for words in seen)
    (mass,) = (line for line in axes.lines if line.get_marker() == "o")
    assert np.ravel(mass.get_data()) == pytest.approx(corners.mean(axis=0))


@pytest.mark.parametrize("size", [(6.4, 4.2), (3.3, 2.2)])
@pytest.mark.parametrize(
    "block",
    [
        Block.rectangle(width=0.3, height=3.0),
        Block.rectangle(width=1.0, height=1.4, restitution=0.5),
        Block.asymmetric(left=0.15, right=0.25, height=1.2),
        Block.rectangle(width=0.4, height=1.6).against_wall(),
        BARE,
        DimensionlessBlock(restitution=0.8, alpha_ratio=1.8, p_ratio=0.9),
    ],
)
def test_words_of_the_model_are_whole_and_apart(
    block: Block | DimensionlessBlock, size: tuple[float, float]
) -> None:
    figure = Figure(figsize=size)
    with palette.style():
        axes = plots.block(block, figure.add_axes((0.02, 0.02, 0.96, 0.96)))
        figure.draw_without_rendering()
        boxes = [text.get_window_extent() for text in axes.texts if text.get_text()]
    for k, box in enumerate(boxes):
        assert figure.bbox.x0 <= box.x0 < box.x1 <= figure.bbox.x1, axes.texts[k]
        assert figure.bbox.y0 <= box.y0 < box.y1 <= figure.bbox.y1, axes.texts[k]
        for other in boxes[:k]:
            assert not box.padded(-1.5).overlaps(other.padded(-1.5))


def test_the_sides_of_a_model_have_their_own_measures() -> None:
    block = Block.asymmetric(left=0.15, right=0.25, height=1.2)
    seen = texts_of(plots.block(block, new_axes()))
    assert "0.15, 0.25 m" in seen
    assert "14, 22.6°" in seen
    walled = texts_of(plots.block(block.against_wall(0.5), new_axes()))
    assert "wall" in walled
    assert "0.5" in walled
    assert any("-e" in words for words in walled)


# ------------------------------------------------------------------------------------ refused


def test_what_cannot_be_drawn_is_refused() -> None:
    run = falling()
    for s in (-1.0, run.end_time_pt + 1.0, math.nan, math.inf):
        with pytest.raises(InputError, match="pt = "):
            plots.block(run, new_axes(), pt=s)
    with pytest.raises(ModelError, match=r"alpha = 0\.3 .* 0\.2 rad"):
        plots.block(run, new_axes(), pt=0.0, alpha=0.3)
    bare = simulate(BARE, SHAKEN, cycles=2)
    for alpha in (0.0, -0.2, 1.6, math.nan):
        with pytest.raises(InputError, match="alpha = "):
            plots.block(bare, new_axes(), pt=0.0, alpha=alpha)
    with pytest.raises(InputError, match="glow = "):
        plots.block(bare, new_axes(), pt=0.0, glow=0.0)


@pytest.mark.parametrize(
    ("motion", "start"),
    [
        (Harmonic(amplitude=1e50, frequency_ratio=0.01), State(angle=0.0, velocity=0.0)),
        (Harmonic(amplitude=0.0, frequency_ratio=1e4), State(angle=0.5, velocity=0.0)),
        (Still(), State(angle=1e12, velocity=0.0)),
        (Still(), State(angle=0.0, velocity=0.0)),
        (Piecewise(pieces=(Segment(duration=1e6, slope=1e40),)), State(angle=0.0, velocity=0.0)),
    ],
)
def test_extreme_runs_are_drawn(motion: Harmonic | Still | Piecewise, start: State) -> None:
    run = simulate(BARE, motion, start=start, cycles=2)
    figure = Figure(figsize=(4.0, 3.0))
    axes = plots.block(run, figure.add_subplot(), pt=0.0)
    plots.block(run, figure.add_subplot(), pt=min(run.end_time_pt, 1.0))
    figure.canvas.draw()
    assert np.isfinite([*axes.get_xlim(), *axes.get_ylim()]).all()


def test_new_axes_are_in_the_house_style() -> None:
    axes = plots.block(falling(), pt=1.0)
    try:
        assert plt.gcf() is axes.figure
        assert not axes.spines["top"].get_visible()
    finally:
        plt.close("all")
