"""Films: their frames, speed and length, what they refuse, and the GIF."""

import io
import math
from collections.abc import Callable, Iterator
from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.animation import FuncAnimation
from matplotlib.colors import to_hex
from matplotlib.patches import Rectangle
from PIL import Image

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Piecewise,
    State,
    Steady,
    Still,
    simulate,
)
from rocksteady.dynamics.history.fall import fall_to_ground
from rocksteady.errors import InputError, ModelError
from rocksteady.histories import Trajectory
from rocksteady.model.equations import Linear
from rocksteady.motions import Segment
from rocksteady.plots import animate
from rocksteady.show.film.animation import Film, film_of
from rocksteady.show.film.gif import save_gif
from rocksteady.show.style import palette
from rocksteady.show.style.tokens import DARK

BARE = DimensionlessBlock(restitution=0.8)
BLOCK = Block.named("tso-wong-1989")  # p = 2 pi rad/s: Omega is the frequency in Hz


def shaken(cycles: float = 10.0, ratio: float = 1.7, bare: bool = False) -> Trajectory:
    motion = Harmonic(amplitude=0.9, frequency_ratio=ratio)  # too weak to lift it: no fall
    return simulate(BARE if bare else BLOCK, motion, cycles=cycles)


def falling() -> Trajectory:
    motion = Harmonic(amplitude=2.0, frequency_ratio=1.7)
    return simulate(BLOCK, motion, start=Steady(), cycles=40)


def texts(film: Film) -> str:
    return " / ".join(text.get_text() for text in film.figure.texts)


@pytest.fixture(autouse=True)
def matplotlib_left_as_it_was() -> Iterator[None]:
    settings = dict(mpl.rcParams)
    open_figures = plt.get_fignums()
    yield
    assert dict(mpl.rcParams) == settings
    assert plt.get_fignums() == open_figures


# ------------------------------------------------------------------------- frames and speed


def test_a_block_plays_in_real_time_and_a_dimensionless_one_a_period_a_second() -> None:
    run = shaken()
    film = film_of(run)
    np.testing.assert_allclose(np.diff(film.reel.times)[:-1], BLOCK.p / 25.0)
    assert "real time" in texts(film)
    bare = shaken(bare=True)
    film = film_of(bare)
    np.testing.assert_allclose(np.diff(film.reel.times)[:-1], 2.0 * math.pi / 1.7 / 25.0)
    assert "1 period a second" in texts(film)
    assert "drawn with α = 0.2 rad" in texts(film)
    for film in (film_of(run), film_of(bare)):
        assert film.reel.times[0] == 0.0
        assert film.reel.times[-1] == film.trajectory.end_time_pt
        assert film.frames == len(film.reel.times) + 25, "the last picture is held for a second"


def test_fast_shaking_of_a_block_is_shown_in_slow_motion() -> None:
    film = film_of(shaken(ratio=4.0))  # 4 Hz: 6.25 frames a period in real time
    assert film.reel.speed == pytest.approx(0.5)
    assert "0.5 × real time" in texts(film)
    assert film_of(shaken(ratio=4.0), fps=50).reel.speed == pytest.approx(1.0)


def test_a_long_run_is_played_faster_and_says_so() -> None:
    film = film_of(shaken(cycles=50.0, ratio=1.0))  # 50 s in real time
    assert len(film.reel.times) == 401
    assert film.reel.speed == pytest.approx(50.0 / 16.0)
    assert "3.12 × real time" in texts(film)


def test_the_usual_fifty_periods_can_be_shown_and_more_not() -> None:
    film = film_of(shaken(cycles=50.0, ratio=4.0, bare=True))
    assert len(film.reel.times) - 1 == 400 == 8 * 50
    with pytest.raises(InputError, match=r"span = .* 7\.84 of them, and at least 8") as caught:
        film_of(shaken(cycles=51.0, ratio=4.0, bare=True))
    assert "p t = 78.5398 of the run" in str(caught.value), "50 periods of 2 pi/4"


def test_a_part_of_a_long_run_can_be_shown() -> None:
    run = shaken(cycles=2000.0, bare=True)
    span = (run.end_time_pt - 10.0, run.end_time_pt)
    film = film_of(run, span=span)
    assert (film.reel.times[0], film.reel.times[-1]) == span
    assert film.history.get_xlim() == pytest.approx([t * 1.7 / (2.0 * math.pi) for t in span])


@pytest.mark.parametrize("speed", [0.25, 1.0, 1.4])
def test_a_speed_is_what_passes_in_a_second(speed: float) -> None:
    for run, unit in ((shaken(), BLOCK.p), (shaken(bare=True), 2.0 * math.pi / 1.7)):
        for fps in (20.0, 30.0):
            film = film_of(run, speed=speed, fps=fps)
            np.testing.assert_allclose(np.diff(film.reel.times)[:-1] * fps, speed * unit)
            assert film.reel.speed == pytest.approx(speed)


def test_the_hint_of_a_refused_speed_is_a_speed_that_works() -> None:
    run = shaken(cycles=20.0, bare=True)
    for speed in (1e-3, 100.0):
        with pytest.raises(InputError, match="speed = ") as caught:
            film_of(run, speed=speed)
        low, high = (float(x) for x in caught.value.hint.removeprefix("give from ").split(" to "))
        for good in (low * 1.01, high * 0.99):
            frames = film_of(run, speed=good).reel.times
            assert len(frames) <= 1501
            assert np.diff(frames)[0] <= 2.0 * math.pi / 1.7 / 8.0
    with pytest.raises(InputError, match="shorter part"):
        film_of(shaken(cycles=1000.0, bare=True), speed=1.0)


@pytest.mark.parametrize("speed", [0.0, -1.0, math.nan, math.inf, "fast"])
def test_a_speed_that_is_none_is_refused(speed: float) -> None:
    with pytest.raises(InputError, match="speed = "):
        animate(shaken(), speed=speed)


@pytest.mark.parametrize("fps", [0.0, 61.0, math.nan, -25.0])
def test_frames_a_second_have_bounds(fps: float) -> None:
    with pytest.raises(InputError, match="fps = "):
        animate(shaken(), fps=fps)


@pytest.mark.parametrize(
    "span", [(1.0, 1.0), (2.0, 1.0), (-1.0, 1.0), (0.0, 1e6), (0.0, math.nan), (1.0,), 3.0]
)
def test_a_span_lies_within_the_run(span: tuple[float, float]) -> None:
    with pytest.raises(InputError, match="span = "):
        animate(shaken(), span=span)


def test_an_alpha_is_for_a_dimensionless_block_alone() -> None:
    with pytest.raises(ModelError, match="alpha = "):
        animate(shaken(), alpha=0.3)
    assert "drawn with α = 0.3 rad" in texts(film_of(shaken(bare=True), alpha=0.3))


def test_endless_runs_are_refused_and_not_drawn() -> None:
    with pytest.raises(InputError, match="span = "):
        animate(simulate(BARE, Harmonic(amplitude=0.5, frequency_ratio=0.01), cycles=1e15))
    elastic = DimensionlessBlock(restitution=1.0)
    with pytest.raises(InputError, match="span = "):
        animate(simulate(elastic, Still(), start=State(angle=0.5, velocity=0.0)))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("run", "words"),
    [
        (lambda: simulate(BARE, Still()), "Free rocking"),
        (lambda: simulate(BARE, Harmonic(amplitude=0.5, frequency_ratio=4.0), cycles=2), "A = 0.5"),
        (lambda: shaken(cycles=1e-9, bare=True), "A = 0.9"),
        (lambda: simulate(BARE, Still(), start=State(angle=1.0, velocity=0.0)), "Free rocking"),
        (
            lambda: simulate(BLOCK, Still(), start=State(angle=1e9, velocity=0.0), model=Linear()),
            "α = 11.5°",
        ),
        (
            lambda: simulate(
                BLOCK, Piecewise(pieces=(Segment(duration=1.1, constant=1.5),)), model=Linear()
            ),
            "Base motion of 1 segment,",
        ),
        (
            lambda: simulate(BARE, Harmonic(amplitude=3.0, frequency_ratio=4.0), max_flights=1),
            "A = 3",
        ),
    ],
)
def test_runs_that_hardly_move_and_runs_that_fall_have_films(
    run: Callable[[], Trajectory], words: str
) -> None:
    film = film_of(run())
    assert words in texts(film)
    film.show(0)
    film.show(film.frames - 1)
    film.figure.savefig(io.BytesIO(), format="png", dpi=40)


# --------------------------------------------------------------------------------- pictures


def test_every_frame_shows_the_trajectory_at_its_time() -> None:
    run = falling()
    film = film_of(run)
    for frame in (0, 17, 60, len(film.reel.times) - 1, film.frames - 1):
        film.show(frame)
        s = film.reel.times[min(frame, len(film.reel.times) - 1)]
        (place,) = np.asarray(film.dot.get_xydata())
        theta = math.degrees(float(film.scene.theta(s)))
        assert place == pytest.approx([s / BLOCK.p, theta])
        if s <= run.end_time_pt:
            assert theta == pytest.approx(math.degrees(float(run(s).angle) * BLOCK.alpha))
        assert film.line.get_xdata() == pytest.approx([s / BLOCK.p] * 2)
        assert film.scene.clock.get_text() == f"t = {s / BLOCK.p:.2f} s"
    assert film.scene.verdict.get_text() == "falls"


@pytest.mark.parametrize("bare", [False, True])
def test_a_fall_ends_on_the_ground(bare: bool) -> None:
    block = BARE if bare else BLOCK
    motion = Harmonic(amplitude=2.0, frequency_ratio=1.7)
    run = simulate(block, motion, start=Steady(), cycles=40)
    film = film_of(run)
    assert film.fall is not None
    last = float(film.reel.times[-1])
    assert last == film.fall.lands_pt > run.end_time_pt
    film.show(film.frames - 1)
    assert abs(float(film.scene.theta(last))) == pytest.approx(0.5 * math.pi)
    corners = film.scene.shape.corners(film.scene.theta(last))
    assert sorted(corners[:, 1])[:2] == pytest.approx([0.0, 0.0], abs=1e-12), "a side is down"
    # Ground lies beneath all of it, and it turns steadily: no jump where the history ends.
    (soil,) = (p for p in film.scene.axes.patches if isinstance(p, Rectangle))
    assert (
        soil.get_x() < corners[:, 0].min() < corners[:, 0].max() < soil.get_x() + soil.get_width()
    )
    turned = np.abs(np.diff(film.scene.theta(film.reel.times)))
    assert turned[-15:].max() < 0.3
    alpha = film.scene.shape.alpha
    expected = fall_to_ground(run, alpha)
    assert expected is not None
    middle = 0.5 * (run.end_time_pt + last)
    assert float(film.scene.theta(middle)) == float(expected(middle))


def test_a_part_of_a_run_that_falls_ends_where_it_is_told() -> None:
    run = falling()
    film = film_of(run, span=(0.5 * run.end_time_pt, run.end_time_pt))
    assert film.fall is None
    assert film.reel.times[-1] == run.end_time_pt


def test_a_fall_for_which_there_are_no_frames_is_left_out() -> None:
    block = Block.rectangle(width=0.3, height=1.5)
    run = simulate(
        block,
        Harmonic(amplitude=5.0, frequency_ratio=300.0),
        start=State(angle=0.9, velocity=3.0),
        model="linear",
    )
    assert fall_to_ground(run, block.alpha) is not None
    film = film_of(run)
    assert film.fall is None
    assert film.reel.times[-1] == run.end_time_pt
    with pytest.raises(InputError, match="fps"):
        film_of(run, fps=0.0)


def test_a_film_is_on_the_paper_of_the_users_figures() -> None:
    run = shaken()
    assert not film_of(run).inks.dark
    with mpl.rc_context({"figure.facecolor": "#141619"}):
        film = film_of(run)
    assert film.inks.dark
    assert to_hex(film.figure.get_facecolor()) == film.inks.paper == "#141619"
    assert to_hex(film.scene.axes.yaxis.label.get_color()) == film.inks.ink
    with palette.on_paper(DARK):
        assert film_of(run).inks.dark


def test_frames_move_artists_and_make_none() -> None:
    film = film_of(falling())
    before = [len(axes.get_children()) for axes in film.figure.axes]
    first = film.show(3)
    for frame in range(0, film.frames, 7):
        assert film.show(frame) == first
    assert [len(axes.get_children()) for axes in film.figure.axes] == before


def test_a_frame_does_not_depend_on_those_before_it() -> None:
    film = film_of(falling())
    frame = film.frame_after(float(film.shown_impacts[3])) + 2

    def state() -> list[object]:
        film.show(frame)
        rings = film.scene.rings.values()
        return [
            film.scene.body.get_facecolor(),
            np.asarray(film.scene.lever.get_xydata()).tolist(),
            [(ring.get_visible(), ring.get_markersize()) for ring in rings],
            film.scene.verdict.get_text(),
        ]

    fresh = state()
    film.show(film.frames - 1)
    assert state() == fresh


def test_nothing_of_the_picture_is_cut_off() -> None:
    for run in (falling(), shaken(cycles=50.0, ratio=4.0, bare=True)):
        film = film_of(run)
        film.figure.canvas.draw()
        width, height = film.figure.bbox.size
        for axes in film.figure.axes:
            box = axes.get_tightbbox()
            assert box is not None
            assert box.x0 >= 0.0
            assert box.y0 >= 0.0
            assert box.x1 <= width
            assert box.y1 <= height
        for text in film.figure.texts:
            assert text.get_window_extent().x1 <= width, text.get_text()


@pytest.mark.slow
def test_animate_returns_an_animation_that_matplotlib_can_save(tmp_path: Path) -> None:
    run = simulate(
        Block.rectangle(width=0.5, height=2.0),
        Still(),
        start=State(angle=0.8, velocity=0.0),
        model=Linear(),
    )
    animation = animate(run, span=(0.0, 0.5), fps=10)
    assert isinstance(animation, FuncAnimation)
    file = tmp_path / "run.gif"
    animation.save(file, writer="pillow", dpi=50)
    with Image.open(file) as picture:
        assert picture.info["duration"] == 100


# -------------------------------------------------------------------------------------- GIF


@pytest.mark.slow
def test_a_gif_plays_for_ever_at_its_speed_and_holds_its_end(tmp_path: Path) -> None:
    film = film_of(falling(), span=(30.0, 34.0))
    seen: list[str] = []
    file = tmp_path / "run.gif"
    save_gif(film, file, seen.append)
    assert seen == [f"frame {k + 1}" for k in range(film.frames)]
    with Image.open(file) as picture:
        assert picture.info["loop"] == 0
        durations = []
        for frame in range(getattr(picture, "n_frames", 1)):
            picture.seek(frame)
            durations.append(picture.info["duration"])
        assert sum(durations) == 40 * film.frames
        assert durations[0] == 40
        assert durations[-1] >= 1000
        assert picture.size == (680, 540)
        assert picture.convert("RGB").getpixel((2, 2)) == (255, 255, 255)


@pytest.mark.slow
def test_the_gif_shows_what_the_figure_shows(tmp_path: Path) -> None:
    """Its background is drawn once; a frame has to look like one that is drawn whole."""
    slow = simulate(BARE, Harmonic(amplitude=0.9, frequency_ratio=0.25), cycles=1)
    for run, span in ((falling(), (38.0, 39.0)), (slow, (3.0, 3.5))):
        film = film_of(run, span=span)
        file = tmp_path / f"{span[0]}.gif"
        save_gif(film, file)
        whole = film_of(run, span=span)
        whole.show(2)
        whole.figure.savefig(tmp_path / "frame.png", dpi=100)
        with Image.open(file) as picture, Image.open(tmp_path / "frame.png") as drawn:
            picture.seek(2)
            one, other = (np.asarray(p.convert("L"), dtype=float) for p in (picture, drawn))
        assert one.shape == other.shape
        differ = np.abs(one - other) > 60.0
        assert differ.mean() < 2e-3
