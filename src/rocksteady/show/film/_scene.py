"""The block on its moving ground, drawn to scale at any time of a motion."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.history.base_motion import largest_acceleration
from rocksteady.dynamics.history.fall import Fall
from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.show.film._geometry import shape_of
from rocksteady.show.style import palette
from rocksteady.show.style.legends import figure_of, text_size
from rocksteady.show.style.tokens import DASHED, HATCHES, inks_of, mixed

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.text import Text
    from matplotlib.transforms import Transform


GLOW = 0.5
"""Pivot time for which an impact is seen at the corner that has struck."""
FAR = 2.0
"""Travel of the ground to either side, in half-diagonals, beyond which the camera goes with it."""
FAR_OFF = 1e6
"""Distance of the ground, in half-diagonals, at which its place has too many digits for an axis."""
THICKNESS = 0.36
"""Of the ground, in half-diagonals; the arrow of its acceleration has to fit in."""
MARGIN = 1.1
"""Ground to either side of the block's base, in half-diagonals."""
PATTERN = 0.3
"""Part of white in the pattern over what falls."""
LINE = 14.0
"""Distance of the two lines of text above the block [points]."""


class BlockScene:
    """The block on its ground as artists that `show` moves to any moment.

    Parameters
    ----------
    axes
        Where it is drawn; its limits are set so that all `times` fit in, in true scale.
    trajectory
        What moves.
    times
        Pivot times that will be shown.
    alpha
        Slenderness [rad] to draw a dimensionless block with.
    glow
        Pivot time for which an impact is seen.
    fall
        What follows the end of the trajectory; without, the times end there.

    Attributes
    ----------
    moving
        All artists that `show` may move; where the camera moves too, so do the axes' ticks.
    camera
        ``"fixed"``; ``"following"``: it goes with ground that travels far; ``"riding"``: as that,
        but the ground is so far off, or so fast between two of the times, that no background is
        drawn and positions count from the ground.
    """

    def __init__(
        self,
        axes: "Axes",
        trajectory: Trajectory,
        times: Floats,
        *,
        alpha: float | None = None,
        glow: float = GLOW,
        fall: Fall | None = None,
    ) -> None:
        self.axes, self.trajectory, self.glow, self.fall = axes, trajectory, glow, fall
        self.inks = inks_of(axes)
        self.shape = shape_of(trajectory, alpha)
        self.strongest = float(np.abs(trajectory.impacts.velocity_before).max(initial=0.0))
        self.largest = largest_acceleration(trajectory.segments)
        self.one_sided = trajectory.block.one_sided
        negative, positive = trajectory.uplifts
        self.uplifts = (positive,) if self.one_sided else (negative, positive)
        # Arrows fit in beside the marks of all uplift accelerations.
        self.strongest_push = max(self.largest, *map(abs, self.uplifts))
        self.symbol = "α" if self.one_sided or -negative == positive else "α₊"
        self._view(times)
        before = set(axes.get_children())
        self._draw()
        self.moving: list[Artist] = [a for a in axes.get_children() if a not in before]

    def theta(self, s: ArrayLike) -> Floats:
        """Return the rotation [rad] as it is drawn: no further than lying on the ground."""
        # A flight begins and ends at 0 only to rounding; its side decides about the pivot.
        times = np.asarray(s, dtype=np.float64)
        end = self.trajectory.end_time_pt
        angle = self.trajectory(np.minimum(times, end)).angle
        turned = np.maximum(angle * self.side(times), 0.0)
        theta = turned * self.shape.alpha * self.side(times)
        if self.fall is not None:
            theta = np.where(times > end, self.fall(times), theta)
        left, right = self.shape.lying
        return np.clip(theta, -right, left)

    def side(self, s: ArrayLike) -> Floats:
        """Return 1 where the block stands on its left corner, -1 on its right one, 0 on both."""
        flights = self.trajectory.flights
        index = np.searchsorted(flights.pt, np.asarray(s, dtype=np.float64), side="right") - 1
        return flights.side[index].astype(np.float64)

    def ground(self, s: ArrayLike) -> Floats:
        """Return where the ground is, in the unit of the axes."""
        return self.shape.travel * self.trajectory.base_displacement(s)

    def _view(self, times: Floats) -> None:
        """Set limits, ticks and labels, and decide what the camera does."""
        from matplotlib.ticker import MaxNLocator

        axes, radius = self.axes, self.shape.radius
        corners, ground = self.shape.corners(self.theta(times)), self.ground(times)
        low, high = float(ground.min()), float(ground.max())
        self.travelled = high - low
        still = high - low <= 2.0 * FAR * radius
        aside = float(self.shape.places[-1])
        self.margin = aside + self.shape.half_width + MARGIN * radius
        # A block that lies has ground beneath it.
        self.wide = max(aside + float(np.abs(corners[..., 0]).max()) + 0.15 * radius, self.margin)
        reach = max(self.wide, self.margin + 0.15 * radius)
        reach += 0.5 * (high - low) if still else 0.0
        floor = -(THICKNESS + 0.02) * radius
        above = float(np.ptp(self.shape.cap[:, 1])) if self.shape.columns else 0.0
        top = max(float(corners[..., 1].max()), self.shape.height) + above + 0.06 * radius
        box = axes.get_window_extent()
        figure = figure_of(axes)
        # Two lines of text stand above the block, wherever it goes.
        share = min(0.45, 2.3 * LINE / 72.0 * figure.dpi / box.height)
        top = floor + (top - floor) / (1.0 - share)
        # A wide picture shows more to the sides, a narrow one more above.
        self.half = max(reach, 0.5 * (top - floor) * box.width / box.height)
        top = floor + max(top - floor, 2.0 * reach * box.height / box.width)
        axes.set_aspect("equal", adjustable="box")
        axes.set_autoscale_on(False)
        axes.set(
            ylim=(floor, top),
            xlim=(-self.half, self.half),
            ylabel=palette.LABELS[f"height_{self.shape.unit}"],
        )
        axes.xaxis.set_major_locator(MaxNLocator(8, steps=[1, 2, 5, 10]))
        axes.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))
        axes.grid(visible=False, axis="y")
        step = float(np.abs(np.diff(ground)).max(initial=0.0))
        first, second = axes.get_xticks()[:2]
        if max(-low, high) > FAR_OFF * radius or (not still and step > 0.45 * (second - first)):
            self.camera = "riding"
        elif still:
            self.camera = "fixed"
            centre = 0.5 * (low + high)
            axes.set_xlim(centre - self.half, centre + self.half)
        else:
            self.camera = "following"
        seen = "ground" if self.camera == "riding" else "position"
        axes.set_xlabel(palette.LABELS[f"{seen}_{self.shape.unit}"])
        if self.camera == "following":  # past these the ground moves
            axes.grid(axis="x", color=self.inks.edge, lw=0.8)

    def _draw(self) -> None:
        """Make the artists, the block standing and the ground at 0."""
        from matplotlib.patches import Polygon, Rectangle
        from matplotlib.transforms import Affine2D

        axes, shape = self.axes, self.shape
        r, b, h = shape.radius, shape.half_width, shape.height
        wide = self.wide if self.camera == "fixed" else 3.0 * self.half
        self._shift, self._turn, self._raise = Affine2D(), Affine2D(), Affine2D()
        ground = self._shift + axes.transData
        # All columns of a frame turn alike; pivots and mass centre are marked on the first.
        home, *others = [Affine2D().translate(x, 0.0) + ground for x in shape.places]
        block = self._turn + home
        deep = THICKNESS * r
        # Where the mass centre is above the edge that it turns about, |theta| = alpha.
        for side, across in ((1, shape.left), (-1, shape.right)):
            if side > 0 or not self.one_sided:
                top = 1.12 * math.hypot(across, shape.centre_height)
                axes.plot(
                    [-side * b, -side * b],
                    [0.0, top],
                    color=self.inks.limit,
                    lw=0.9,
                    ls=DASHED,
                    transform=home,
                    zorder=3.6,
                )
        axes.add_patch(
            Rectangle(
                (-wide, -deep),
                2.0 * wide,
                deep,
                transform=ground,
                facecolor=self.inks.soil,
                lw=0,
                zorder=2.0,
            )
        )
        if self.one_sided:
            self._draw_wall(ground)
        surface = [((-wide, 0.0), (wide, 0.0))]
        strokes = np.arange(-wide + 0.11 * r, wide, 0.11 * r)
        hatching = [((x, 0.0), (x - 0.07 * r, -0.07 * r)) for x in strokes]
        self._draw_edge(surface, hatching, ground)
        corners = shape.corners(0.0)
        look: dict[str, Any] = {"closed": True, "transform": block, "joinstyle": "round"}
        line: dict[str, Any] = {"edgecolor": self.inks.ink, "lw": 1.2, "zorder": 3.0}
        self.body = Polygon(corners, **line, **look)
        self.bodies = [self.body]
        # A pattern has the colour of its outline, so that it is a patch of its own.
        self.pattern = Polygon(
            corners,
            facecolor="none",
            edgecolor=mixed(self.inks.falls, PATTERN),
            hatch=HATCHES["falls"],
            lw=0.0,
            zorder=3.1,
            **look,
        )
        for place in others:
            look["transform"] = self._turn + place
            self.bodies.append(
                Polygon(corners, edgecolor=self.inks.ink, lw=1.2, zorder=3.0, **look)
            )
        if shape.columns:
            (left, low), (right, high) = shape.cap.tolist()
            cap = [(left, low), (right, low), (right, high), (left, high)]
            look["transform"] = self._raise + ground
            self.bodies.append(Polygon(cap, **line, **look))
        for patch in (*self.bodies, self.pattern):
            axes.add_patch(patch)
        (self.lever,) = axes.plot([], [], lw=0.8, transform=block, zorder=3.5)
        (self.mass,) = axes.plot(
            [shape.offset],
            [shape.centre_height],
            marker="o",
            ms=6.5,
            mfc=self.inks.paper,
            mew=1.3,
            ls="none",
            transform=block,
            zorder=4.0,
        )
        (self.pivots,) = axes.plot(
            [],
            [],
            marker=[(0.0, 0.0), (-0.5, -0.9), (0.5, -0.9), (0.0, 0.0)],
            ms=11,
            mfc=self.inks.ink,
            mec=self.inks.paper,
            mew=0.6,
            ls="none",
            transform=home,
            zorder=4.0,
        )
        self.rings = {
            side: axes.plot(
                [side * (b + shape.overhangs[1] * self.one_sided)],
                [h if self.one_sided else 0.0],  # of a wall, where the block's top strikes it
                marker="o",
                mfc="none",
                mec=self.inks.impact,
                ls="none",
                visible=False,
                transform=home,
                zorder=5.0,
            )[0]
            for side in (-1, 1)
        }
        self._draw_base(ground)
        size = text_size(axes, 9.0)
        self.clock, self.tilt = self._written(0, size), self._written(1, size)
        self.push, self.verdict = (
            self._written(1, size, "right"),
            self._written(0, size + 2.0, "right"),
        )
        self.verdict.set_fontweight("bold")
        self.tilt.set_color(self.inks.motion)
        self.push.set_color(self.inks.base)

    def _draw_wall(self, ground: "Transform") -> None:
        """Make the wall behind the block, which stands on the ground and moves with it."""
        from matplotlib.patches import Rectangle

        axes, r = self.axes, self.shape.radius
        b = self.shape.half_width + self.shape.overhangs[1]
        thick, high = 0.5 * THICKNESS * r, 1.03 * self.shape.height
        axes.add_patch(
            Rectangle(
                (b, 0.0), thick, high, transform=ground, facecolor=self.inks.soil, lw=0, zorder=2.0
            )
        )
        strokes = np.arange(0.11 * r, high, 0.11 * r)
        hatching = [((b, y), (b + 0.07 * r, y - 0.07 * r)) for y in strokes]
        face = [((b, 0.0), (b, high))]
        self._draw_edge(face, hatching, ground)

    def _draw_edge(
        self, edge: Sequence[ArrayLike], hatching: Sequence[ArrayLike], ground: "Transform"
    ) -> None:
        """Draw the edge of what stands still, and the strokes behind it."""
        from matplotlib.collections import LineCollection

        for lines, colour, width in ((hatching, self.inks.edge, 0.7), (edge, self.inks.ink, 1.2)):
            drawn = LineCollection(
                lines, colors=colour, linewidths=width, transform=ground, zorder=2.2
            )
            self.axes.add_collection(drawn, autolim=False)

    def _written(self, line: int, size: float, side: Literal["left", "right"] = "left") -> "Text":
        """Make a text in a line above the block."""
        from matplotlib.transforms import ScaledTranslation

        inches = figure_of(self.axes).dpi_scale_trans
        down = ScaledTranslation(0.0, -(3.0 + LINE * line) / 72.0, inches)
        x = 0.012 if side == "left" else 0.988
        return self.axes.text(
            *(x, 1.0, ""),
            transform=self.axes.transAxes + down,
            ha=side,
            va="top",
            fontsize=size,
            color=self.inks.ink,
            zorder=6.0,
        )

    def _draw_base(self, ground: "Transform") -> None:
        """Make the arrow of the base acceleration and the marks of the uplift accelerations."""
        from matplotlib.patches import Polygon

        axes, r = self.axes, self.shape.radius
        self.arrow_y, self.arrow_length = -0.21 * r, 0.75 * self.margin
        self.arrow = Polygon(
            np.zeros((7, 2)),
            closed=True,
            transform=ground,
            facecolor=self.inks.base,
            lw=0,
            zorder=2.6,
            visible=self.largest > 0.0,
        )
        axes.add_patch(self.arrow)
        lifts = self.arrow_length / self.strongest_push
        marks = [(level * lifts, 0.055) for level in self.uplifts]
        for x, reach in ((0.0, 0.09), *marks):
            axes.plot(
                [x, x],
                [self.arrow_y - reach * r, self.arrow_y + reach * r],
                color=self.inks.ink,
                lw=1.0,
                transform=ground,
                zorder=2.5,
                visible=self.largest > 0.0,
            )

    def show(self, s: float) -> "list[Artist]":
        """Move everything to a pivot time and return what may have moved."""
        theta, side = float(self.theta(s)), int(self.side(s))
        ground = float(self.ground(s))
        b, h = self.shape.half_width, self.shape.height
        self._shift.clear().translate(0.0 if self.camera == "riding" else ground, 0.0)
        if self.camera == "following":
            self.axes.set_xlim(ground - self.half, ground + self.half)
        self._turn.clear().rotate_around(-b if side > 0 else b, 0.0, theta)
        # The cap stands on the upper corners opposite to the pivots.
        upper = (b if theta > 0.0 else -b), h
        self._raise.clear().translate(*(self._turn.transform(upper) - upper))
        over = self.trajectory.overturn_time_pt
        fallen = over is not None and s >= over
        state = "falls" if fallen else "rocks" if side else "rest"
        for body in self.bodies:
            body.set_facecolor(getattr(self.inks, state))
        self.pattern.set_visible(fallen)
        line = {"falls": self.inks.on_falls, "rocks": self.inks.on_rocks}.get(state, self.inks.ink)
        self.lever.set_color(line)
        self.mass.set_markeredgecolor(line)
        centre = self.shape.offset
        self.lever.set_data(
            ([-side * b, centre], [0.0, self.shape.centre_height]) if side else ([], [])
        )
        corners = [-side * b] if side else [-b, b]
        self.pivots.set_data(corners, [0.0] * len(corners))
        self._flash(s)
        self._push(float(self.trajectory.base_acceleration(s)))
        self.clock.set_text(self._time(s))
        degrees, part = math.degrees(theta), signed(theta / self.shape.alpha, 2)
        words = [f"{part} {self.symbol}", f"{signed(degrees, 1)}°"]
        if isinstance(self.trajectory.block, Block):
            words.reverse()
        self.tilt.set_text(f"θ = {' = '.join(words)}")
        self.verdict.set_text("at rest" if state == "rest" else state)
        return self.moving

    def _time(self, s: float) -> str:
        """Return a pivot time as it stands in the picture."""
        if isinstance(self.trajectory.block, Block):
            return f"t = {s / self.trajectory.block.p:.2f} s"
        return f"pt = {s:.2f}"

    def _flash(self, s: float) -> None:
        """Draw a ring at each corner that has struck, wider and fainter the longer ago.

        For a block against a wall it is at the top corner, which strikes that.
        """
        impacts = self.trajectory.impacts
        first, last = np.searchsorted(impacts.pt, [s - self.glow, s], side="right")
        age = (s - impacts.pt[first:last]) / self.glow
        strength = np.sqrt(np.abs(impacts.velocity_before[first:last]) / self.strongest)
        for side, ring in self.rings.items():
            # A block that falls from its positive side stood on the left corner: the right strikes.
            bright = np.where(impacts.side[first:last] == side, (1.0 - age**2) * strength, 0.0)
            seen = bright.max(initial=0.0)
            ring.set_visible(bool(seen > 0.01))
            if ring.get_visible():
                since = float(age[bright.argmax()])
                ring.set(
                    alpha=float(seen),
                    markersize=7.0 + 24.0 * since,
                    markeredgewidth=3.2 - 2.0 * since,
                )

    def _push(self, acceleration: float) -> None:
        """Draw the arrow of the base acceleration, in units of alpha g."""
        r, tip = self.shape.radius, self.arrow_length * acceleration / self.strongest_push
        head = math.copysign(min(abs(tip), 0.15 * r), tip)
        x = np.array([0.0, tip - head, tip - head, tip, tip - head, tip - head, 0.0])
        y = np.array([0.024, 0.024, 0.075, 0.0, -0.075, -0.024, -0.024]) * r
        self.arrow.set_xy(np.column_stack([x, self.arrow_y + y]))
        block, pushed = self.trajectory.block, f"a = {signed(acceleration, 2)} {self.symbol}g"
        if isinstance(block, Block):
            pushed = (
                f"a = {signed(acceleration * block.uplift_acceleration / STANDARD_GRAVITY, 2)} g"
            )
        self.push.set_text(pushed if self.largest > 0.0 else "")


def signed(value: float, digits: int) -> str:
    """Return a number with its sign, as the tick labels write it, and none where it shows 0."""
    text = f"{value:+.{digits}f}" if abs(value) < 1e5 else f"{value:+.{digits}e}"
    return text[1:] if float(text) == 0.0 else text.replace("-", "−")
