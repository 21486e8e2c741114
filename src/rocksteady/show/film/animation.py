"""Film of a time history: the block on its moving ground, above its angle against time."""

import math
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.dynamics.history.fall import Fall, fall_to_ground
from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.pulses import Pulse
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Still
from rocksteady.show.film._geometry import shape_of
from rocksteady.show.film._playback import FRAMES_PER_SECOND, Reel, reel_of, speed_text, speed_unit
from rocksteady.show.film._scene import BlockScene
from rocksteady.show.plots.motion import plot_trajectory
from rocksteady.show.plots.motion_axes import sided, time_scale
from rocksteady.show.style import palette
from rocksteady.show.style.escaping import literal
from rocksteady.show.style.palette import shortened
from rocksteady.show.style.scales import scale_of
from rocksteady.show.style.tokens import DARK, DARKEST_PAPER, DASHED, Inks, inks_of, luminance

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

GLOW_SECONDS = 0.35
"""Time of the film for which an impact is seen, if a period lasts long enough."""
HOLD_SECONDS = 1.0
"""Time of the film for which its last picture stays."""
SIZE = (6.8, 5.4)
"""Inches."""
KEY_SIZE = 7.0
"""Size of the text that explains the marks [points]."""


class Film:
    """The figure of a film and how it is moved; `animate` and its tests use it.

    Attributes
    ----------
    figure
        With the axes `scene.axes` and `history`.
    scene
        The block on its ground.
    reel
        The frames, the hold at the end not counted.
    fall
        What follows the end of the trajectory, if the block falls and the film shows it.
    inks
        Colours for its paper.
    """

    def __init__(
        self, trajectory: Trajectory, reel: Reel, alpha: float | None, fall: Fall | None
    ) -> None:
        from matplotlib.figure import Figure

        self.trajectory, self.reel, self.fall = trajectory, reel, fall
        self.frames = len(reel.times) + round(HOLD_SECONDS * reel.fps)
        self.inks = paper_of_user()
        with self.style():
            # The margins are fixed: a new layout for each frame would jitter.
            self.figure = Figure(figsize=SIZE, dpi=100.0)
            self.figure.set_layout_engine("none")
            wide, high = SIZE
            left, right = 0.78 / wide, 1.0 - 0.12 / wide
            scene = self.figure.add_axes((left, 2.02 / high, right - left, (high - 2.88) / high))
            self.history = self.figure.add_axes((left, 0.45 / high, right - left, 1.05 / high))
            self.scene = BlockScene(
                scene,
                trajectory,
                reel.times,
                alpha=alpha,
                glow=min(GLOW_SECONDS * reel.speed * speed_unit(trajectory), 0.4 * reel.period),
                fall=fall,
            )
            name = literal(title(self.scene))
            self.figure.text(left, 1.0 - 0.12 / high, name, va="top", fontsize=10.5)
            self.figure.text(
                left,
                1.0 - 0.32 / high,
                caption(self.scene, reel),
                va="top",
                fontsize=8.0,
                color=self.inks.quiet,
            )
            self._draw_history(self.history)
            self._draw_key(scene)
        self.show(0)

    @contextmanager
    def style(self) -> Iterator[None]:
        """Apply the house style on the paper of the film, inside a ``with`` block."""
        with palette.on_paper(self.inks), palette.style():
            yield

    def _draw_history(self, axes: "Axes") -> None:
        """Draw the tilt over the span of the film, and the mark that moves along it."""
        start, end = float(self.reel.times[0]), float(self.reel.times[-1])
        last = min(end, self.trajectory.end_time_pt)
        self.scale = time_scale(self.trajectory).factor
        self.degrees = sided(self.trajectory, "angle").factor / self.scene.shape.alpha
        impacts = self.trajectory.impacts.pt
        self.shown_impacts = impacts[(impacts >= start) & (impacts <= end)]
        plot_trajectory(self.trajectory, axes, span=(start, last), legend="none")
        if self.fall is not None and end > last:  # the rest of the fall leaves the axes
            axes.plot(
                self.fall.pt * self.scale, self.fall.theta * self.degrees, color=self.inks.motion
            )
            axes.set_xlim(axes.get_xlim()[0], end * self.scale)
        self.line = axes.axvline(start * self.scale, color=self.inks.ink, lw=0.9)
        (self.dot,) = axes.plot(
            [],
            [],
            "o",
            ms=5.5,
            color=self.inks.motion,
            mec=self.inks.paper,
            mew=0.8,
            clip_on=self.fall is not None,
            zorder=4,
        )

    def _draw_key(self, axes: "Axes") -> None:
        """Say what the marks are, above the axes: a block that falls may come anywhere in them."""
        from matplotlib.lines import Line2D

        inks = self.inks
        looks: list[dict[str, Any]] = [
            {"marker": "o", "mfc": inks.paper, "mec": inks.ink, "mew": 1.2, "ms": 5.5},
            {"color": inks.limit, "lw": 0.9, "ls": DASHED},
            {"marker": "^", "mfc": inks.ink, "mec": inks.ink, "ms": 5.0},
            {"marker": "|", "mec": inks.impact, "mew": 1.3, "ms": 7.0},
            {"marker": "o", "mfc": "none", "mec": inks.impact, "mew": 1.5, "ms": 7.5},
            {"marker": (3, 0, -90), "color": inks.base, "lw": 3.0, "ms": 6.0, "ls": "-"},
            {"marker": "|", "mec": inks.ink, "mew": 1.0, "ms": 7.0},
        ]
        words = [
            "mass centre",
            tipping_words(self.scene),
            "edge it turns on",
            "impact",
            "corner that struck",
            "base acceleration a",
            uplift_words(self.scene),
        ]
        if self.scene.largest == 0.0:
            looks, words = looks[:-2], words[:-2]
        if len(self.trajectory.impacts) == 0:
            looks, words = looks[:3] + looks[5:], words[:3] + words[5:]
        handles: list[Artist] = [
            Line2D([], [], label=word, **{"ls": "", **look})
            for look, word in zip(looks, words, strict=True)
        ]
        axes.legend(
            handles=handles,
            loc="lower left",
            bbox_to_anchor=(0.0, 1.01),
            borderaxespad=0.0,
            borderpad=0.0,
            labelspacing=0.45,
            handlelength=1.6,
            columnspacing=1.2,
            ncols=math.ceil(len(handles) / 2),
            fontsize=KEY_SIZE,
        )

    def frame_after(self, s: float) -> int:
        """Return the first frame that is not before a pivot time."""
        return int(np.searchsorted(self.reel.times, s))

    def show(self, frame: int) -> "list[Artist]":
        """Move everything to a frame; those after the last one of the reel repeat it."""
        s = float(self.reel.times[min(frame, len(self.reel.times) - 1)])
        moved = self.scene.show(s)
        self.line.set_xdata([s * self.scale] * 2)
        self.dot.set_data([s * self.scale], [float(self.scene.theta(s)) * self.degrees])
        return [*moved, self.line, self.dot]


def paper_of_user() -> Inks:
    """Return the colours for the paper of the user's figures: dark where these are."""
    import matplotlib as mpl
    from matplotlib.colors import to_hex, to_rgba
    from matplotlib.figure import Figure

    ground = to_rgba(mpl.rcParams["figure.facecolor"])
    if ground[3] > 0.0 and luminance(to_hex(ground)) < DARKEST_PAPER:
        return replace(DARK, paper=to_hex(ground))
    with palette.style():
        return inks_of(Figure().add_subplot())


def title(scene: BlockScene) -> str:
    """Return what moves, in one line."""
    motion = scene.trajectory.motion
    if isinstance(motion, Pulse):  # its name leaves no room for the block
        return f"Pulse {motion.shape}, {shaking_words(scene, motion)}"
    if isinstance(motion, Record):  # nor do many of theirs
        name = literal(shortened(motion.name or f"Record of {motion.duration_s:.4g} s"))
        upwards = scene.trajectory.vertical is not None
        return f"{name}, with vertical motion, not drawn" if upwards else name
    if isinstance(motion, PeriodicMotion):
        parts = [shaking_words(scene, motion)]
    elif isinstance(motion, Still):
        parts = ["Free rocking"]
    else:
        pieces = len(motion.segments())
        parts = [f"Base motion of {pieces} segment{'' if pieces == 1 else 's'}"]
    return ", ".join([*parts, *block_words(scene)])


def shaking_words(scene: BlockScene, motion: Pulse | PeriodicMotion) -> str:
    """Return amplitude and frequency of a motion, in g and Hz for a block of known size."""
    block, a, w = scene.trajectory.block, motion.amplitude, motion.frequency_ratio
    if not isinstance(block, Block):
        return f"A = {a:.4g}, Ω = {w:.4g}"
    strength = a * scale_of("amplitude", block).factor
    return f"{strength:.3g} g, {w * scale_of('frequency_ratio', block).factor:.3g} Hz"


def tipping_words(scene: BlockScene) -> str:
    """Return the tilts at which the block tips, in words."""
    if scene.one_sided:
        return "tips beyond, θ = α"
    return "tips beyond, |θ| = α" if scene.symbol == "α" else "tips beyond, θ = α₊, −α₋"


def uplift_words(scene: BlockScene) -> str:
    """Return which base accelerations lift the block from rest."""
    block, lifts = scene.trajectory.block, scene.uplifts
    if isinstance(block, Block):
        unit = block.uplift_acceleration / STANDARD_GRAVITY
        size = [f"{abs(lift) * unit:.3g}" for lift in lifts]
    else:
        size = ["αg"] * len(lifts) if scene.symbol == "α" else ["α₋g", "α₊g"]
    end = " g" if isinstance(block, Block) else ""
    if len(lifts) == 1:
        return f"lifts off at {size[0]}{end}"
    if scene.symbol == "α":
        return f"lifts off at ±{size[0]}{end}"
    return f"lifts off at −{size[0]}, {size[1]}{end}"


def block_words(scene: BlockScene) -> list[str]:
    """Return size and restitution of the block."""
    trajectory, block = scene.trajectory, scene.trajectory.block
    first, second = trajectory.sides[:, 0].tolist()
    parts = [
        f"against a wall, restitution {block.restitution:.4g}"
        if block.one_sided
        else f"restitution {first:.4g}"
        if first == second
        else f"restitution {first:.3g}/{second:.3g}"
    ]
    if not isinstance(block, Block):
        return [*parts, f"drawn with {scene.symbol} = {scene.shape.alpha:.4g} rad"]
    alphas = [math.degrees(block.alpha)]
    if not (block.symmetric or block.one_sided):
        alphas.append(math.degrees(block.negative.alpha))
    words = "/".join(f"{alpha:.3g}°" for alpha in alphas)
    return [f"α = {words}, R = {block.radius:.3g} m", *parts]


def caption(scene: BlockScene, reel: Reel) -> str:
    """Return how it is shown, in one line: every length is true, and the speed is named."""
    trajectory = scene.trajectory
    parts = block_words(scene) if isinstance(trajectory.motion, Pulse | Record) else []
    parts += ["true scale", speed_text(trajectory, reel.speed)]
    if scene.camera != "fixed":
        unit = "m" if isinstance(trajectory.block, Block) else "R"
        parts.append(f"camera moves with the ground (over {scene.travelled:.3g} {unit})")
    return ", ".join(parts)


def film_of(
    trajectory: Trajectory,
    *,
    span: tuple[float, float] | None = None,
    speed: float | None = None,
    fps: float = FRAMES_PER_SECOND,
    alpha: float | None = None,
) -> Film:
    """Return the film that `animate` plays; its parameters and errors are the same."""
    if span is None:
        fall = fall_to_ground(trajectory, shape_of(trajectory, alpha).alpha)
        reel = None
        if fall is not None:
            with suppress(InputError):  # too many frames with the fall may be few without
                reel = reel_of(trajectory, None, speed, fps, fall.lands_pt)
        if reel is not None:
            return Film(trajectory, reel, alpha, fall)
    reel = reel_of(trajectory, span, speed, fps, trajectory.shown_to_pt)
    return Film(trajectory, reel, alpha, None)


@checked
def animate(
    trajectory: Trajectory,
    *,
    span: tuple[float, float] | None = None,
    speed: float | None = None,
    fps: float = FRAMES_PER_SECOND,
    alpha: float | None = None,
) -> "FuncAnimation":
    """Return a film of the block on its moving ground, to scale, above its time history.

    The picture is that of `plots.block`: the block is pale where it rests, blue while it rocks and
    black with a hatch from where it passes |theta| = alpha for the last time.  It falls to the
    ground: from the end of the run on by the full equation of motion, about the same edge, until
    it lies.  Where the ground moves further than four half-diagonals the camera goes with it, past
    lines that stand still.  The last picture stays for a second.  The paper is that of the user's
    figures, light or dark.

    Parameters
    ----------
    trajectory
        From `rocksteady.simulate`.
    span
        Pivot times p t between which the film runs; default: the whole run, and the fall that
        follows it where there are frames for both.
    speed
        What passes in a second of the film: for a `rocksteady.Block` seconds, so that 1 is real
        time; for a dimensionless block forcing periods of harmonic shaking, else pivot time.
        Without, it is real time or one period a second, slower for fast shaking, and faster where
        the film would have more than 400 frames.
    fps
        Frames a second of the film, from 1 to 60.  A GIF counts in hundredths of a second: 10, 20,
        25 and 50 are exact.
    alpha
        Slenderness [rad] to draw a dimensionless block with, in (0, pi/2); default 0.2.

    Returns
    -------
    matplotlib.animation.FuncAnimation
        Save it with ``save("run.gif", writer="pillow")``, or show it in a notebook with
        ``to_jshtml()``.  Its figure belongs to no window.

    Raises
    ------
    InputError
        If a number is outside its range, the span leaves the run, a period (of the forcing, or
        p t = 2 pi where that is shorter) would have fewer than 8 frames, or the film more than
        1500.
    ModelError
        If `alpha` is given for a block that has its own.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from rocksteady import Block, State, Still, simulate
    >>> block = Block.rectangle(width=0.5, height=2.0)
    >>> run = simulate(block, Still(), start=State(angle=0.8, velocity=0.0))
    >>> film = animate(run, span=(0.0, 0.5), fps=10)
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder) / "run.gif"
    ...     film.save(file, writer="pillow")
    ...     print(file.read_bytes()[:6])
    b'GIF89a'
    """
    from matplotlib.animation import FuncAnimation

    film = film_of(trajectory, span=span, speed=speed, fps=fps, alpha=alpha)
    return FuncAnimation(
        film.figure,
        film.show,
        frames=film.frames,
        interval=1000.0 / film.reel.fps,
        cache_frame_data=False,
    )
