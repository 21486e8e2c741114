"""The model, as an engineer draws it: a block that turns about an edge, with its measures."""

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.results.numbers import number
from rocksteady.show.film._geometry import Shape, shape_of_block
from rocksteady.show.style.legends import size_of, text_size
from rocksteady.show.style.tokens import Inks, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LEAST_TILT, MOST_TILT = math.radians(6.0), math.radians(11.0)
"""Tilt at which a small one is drawn."""
PART_OF_ALPHA = 0.6
"""Of the slenderness, which the drawn tilt does not exceed."""
DEEP = 0.24
"""Depth of the ground, in parts of the size of the block."""
ROWS = 11.0
"""Height of the values and the law of impact, in sizes of text."""
LAW = 0.24
"""Height at which the law of impact stands, in parts of the size of the block."""
WORDS = 14.0
"""Width of the words at the right, in sizes of text."""
ARC = 0.55
"""Radius of the arc of the slenderness, in parts of R."""


def draw_model(axes: "Axes", block: Block | DimensionlessBlock, alpha: float | None) -> None:
    """Draw a block at a small positive tilt with its measures, in the symbols of the theory."""
    drawing = _Drawing(axes, block, shape_of_block(block, alpha))
    drawing.draw_ground()
    drawing.draw_body()
    drawing.draw_sizes()
    drawing.draw_angles()
    drawing.draw_signs()
    drawing.write_values()


def math_of(symbols: str) -> str:
    r"""Return symbols as mathematics.

    Examples
    --------
    >>> print(math_of("α₊, α₋"))
    $\alpha_+,\;\alpha_-$
    """
    letters = {"α": r"\alpha", "γ": r"\gamma", "δ": r"\delta", "₊": "_+", "₋": "_-", ", ": r",\;"}
    for letter, mathematics in letters.items():
        symbols = symbols.replace(letter, mathematics)
    return f"${symbols}$"


class _Drawing:
    """The axes, the block, and where its points are."""

    def __init__(self, axes: "Axes", block: Block | DimensionlessBlock, shape: Shape) -> None:
        self.axes, self.block, self.shape = axes, block, shape
        self.inks: Inks = inks_of(axes)
        self.small = text_size(axes, 9.0)
        self.sized = isinstance(block, Block)
        # h is the height of the mass centre, in every formula.
        self.tall = "2h" if not isinstance(block, Block) or block.fills_outline else "H"
        self.differ = shape.left != shape.right and not block.one_sided
        self.tilt = min(max(0.5 * shape.alpha, LEAST_TILT), MOST_TILT, PART_OF_ALPHA * shape.alpha)
        self.size = max(shape.height, 2.0 * shape.half_width + sum(shape.overhangs))
        self.edge = np.array([-shape.half_width, 0.0])
        self.centre = self.turned(shape.left, shape.centre_height)
        self._set_view()

    def turned(self, x: float, y: float) -> Floats:
        """Return where a point of the block is, whose place is counted from its left edge."""
        cos, sin = math.cos(self.tilt), math.sin(self.tilt)
        place: Floats = self.edge + np.array([x * cos - y * sin, x * sin + y * cos])
        return place

    def _set_view(self) -> None:
        """Set the limits, in true scale and without axes."""
        s, shape = self.size, self.shape
        corners = shape.corners(self.tilt)
        self.right = corners[:, 0].max() + 0.22 * s  # where words and values begin
        wide, high = size_of(self.axes)
        left = corners[:, 0].min() - (0.3 if self.block.one_sided else 0.16) * s
        self.right += 0.5 * self.small * (self.right - left) / wide
        room = min(0.6, WORDS * self.small / wide)  # of the words and values at the right
        right, top = left + (self.right - left) / (1.0 - room), corners[:, 1].max() + 0.16 * s
        point = (right - left) / wide  # at least: so many rows need room above the law of impact
        self.deep = max(DEEP * s, 4.6 * self.small * point)
        bottom = -self.deep
        top = max(top, LAW * s + ROWS * self.small * point)
        missing = (top - bottom) * wide / high - (right - left)
        if missing > 0.0:
            left, right = left - 0.4 * missing, right + 0.6 * missing
        self.axes.set_axis_off()
        self.axes.set_aspect("equal", adjustable="box")
        self.axes.set(xlim=(left, right), ylim=(bottom, top))

    def write(self, words: str, at: Floats, colour: str = "", **look: Any) -> None:
        """Write words at a point."""
        look = {"ha": "center", "va": "center", "fontsize": self.small, **look}
        x, y = at.tolist()
        self.axes.text(x, y, words, color=colour or self.inks.ink, zorder=6.0, **look)

    def line(self, *points: Floats, **look: Any) -> None:
        """Draw a line through points."""
        style = {"color": self.inks.ink, "lw": 0.9, "zorder": 3.5, **look}
        self.axes.plot(*np.array(points).T, **style)

    def arrow(self, start: Floats, end: Floats, colour: str, style: str, **look: Any) -> None:
        """Draw an arrow."""
        given = {"arrowstyle": style, "color": colour, "lw": 1.2, "shrinkA": 0.0, "shrinkB": 0.0}
        (x, y), (x0, y0) = end.tolist(), start.tolist()
        self.axes.annotate("", (x, y), (x0, y0), arrowprops={**given, **look}, zorder=4.0)

    def draw_ground(self) -> None:
        """Draw the ground under the block, and the wall behind one that has it."""
        from matplotlib.patches import Rectangle

        s, b = self.size, self.shape.half_width + self.shape.overhangs[1]
        left, right = self.axes.get_xlim()
        soil: dict[str, Any] = {"facecolor": self.inks.soil, "lw": 0.0, "zorder": 1.0}
        self.axes.add_patch(Rectangle((left, -self.deep), right - left, self.deep, **soil))
        self.line(np.array([left, 0.0]), np.array([right, 0.0]), lw=1.2, zorder=2.0)
        if self.block.one_sided:
            tall = 1.04 * self.shape.height
            self.axes.add_patch(Rectangle((b, 0.0), 0.1 * s, tall, **soil))
            self.line(np.array([b, 0.0]), np.array([b, tall]), lw=1.2, zorder=2.0)
            self.write("wall", np.array([b + 0.05 * s, 0.4 * tall]), rotation=90.0)

    def draw_body(self) -> None:
        """Draw the block, its mass centre and the radius to it."""
        from matplotlib.patches import Polygon

        inks = self.inks
        corners = self.shape.corners(self.tilt)
        body = Polygon(corners, closed=True, fc=inks.rocks, ec=inks.ink, lw=1.3, zorder=3.0)
        body.set_joinstyle("round")
        self.axes.add_patch(body)
        self.line(self.edge, self.centre, color=inks.on_rocks, lw=1.3)
        look: dict[str, Any] = {"mfc": inks.paper, "mec": inks.on_rocks, "mew": 1.4, "zorder": 5.0}
        self.axes.plot(*self.centre, "o", ms=7.5, **look)

    def draw_sizes(self) -> None:
        """Draw the width above the block, the height to its right, and the radius."""
        shape, off = self.shape, self.gap
        wide, tall = 2.0 * shape.half_width, shape.height
        quiet = self.inks.quiet
        lean = math.degrees(self.tilt)
        spans = [(0.0, wide, "2b", "center")]
        if self.differ:  # words away from each other
            spans = [(0.0, shape.left, "b₊", "right"), (shape.left, wide, "b₋", "left")]
        for start, end, name, side in spans:
            ends = self.turned(start, tall + off), self.turned(end, tall + off)
            self.arrow(*ends, quiet, "|-|,widthA=0.25,widthB=0.25", lw=0.9)
            place = self.turned(0.5 * (start + end), tall + 2.0 * off)
            self.write(math_of(name), place, rotation=lean, ha=side)
        # The wall stands to the right.
        across, beyond = wide + shape.overhangs[1] + off, off
        if self.block.one_sided:
            across, beyond = -shape.overhangs[0] - 3.2 * off, -off
        ends = self.turned(across, 0.0), self.turned(across, tall)
        self.arrow(*ends, quiet, "|-|,widthA=0.25,widthB=0.25", lw=0.9)
        self.write(
            math_of(self.tall), self.turned(across + 1.1 * beyond, 0.5 * tall), rotation=lean
        )
        part = 0.4 if self.differ else 0.72
        place = self.turned(part * shape.left + 0.55 * off, part * shape.centre_height)
        self.write("$R_+$" if self.differ else "$R$", place, self.inks.on_rocks)
        if self.differ:
            self.line(self.turned(wide, 0.0), self.centre, color=self.inks.on_rocks, lw=1.3)
            place = self.turned(wide - 0.75 * shape.right + 0.7 * off, 0.75 * shape.centre_height)
            self.write("$R_-$", place, self.inks.on_rocks)

    def draw_angles(self) -> None:
        """Draw the slenderness between an edge of the block and the radius, and the tilt."""
        from matplotlib.patches import Arc

        shape, inks = self.shape, self.inks
        lean = math.degrees(self.tilt)
        sides = [(shape.left, self.edge, 1.0, "α₊" if self.differ else "α")]
        if self.differ:
            sides.append((shape.right, self.turned(2.0 * shape.half_width, 0.0), -1.0, "α₋"))
        for across, corner, sign, name in sides:
            alpha = math.atan2(across, shape.centre_height)
            radius = ARC * math.hypot(across, shape.centre_height)
            edge = 90.0 + lean
            ends = sorted((edge, edge - sign * math.degrees(alpha)))
            self.axes.add_patch(
                Arc(tuple(corner), 2 * radius, 2 * radius, theta1=ends[0], theta2=ends[1],
                    color=inks.on_rocks, lw=1.3, zorder=3.6)
            )  # fmt: skip
            middle = math.radians(edge) - 0.5 * sign * alpha
            arc = corner + radius * np.array([math.cos(middle), math.sin(middle)])
            outside = corner + radius * np.array([-math.sin(self.tilt), math.cos(self.tilt)])
            words = outside - np.array([1.7 * sign * self.gap, 0.0])
            self.line(arc, words + np.array([0.7 * sign * self.gap, 0.0]), lw=0.7)
            self.write(math_of(name), words)
        reach = 2.0 * shape.half_width + 0.34 * self.size
        turned = self.edge + reach * np.array([math.cos(self.tilt), math.sin(self.tilt)])
        self.line(self.turned(2.0 * shape.half_width, 0.0), turned, color=inks.quiet, lw=0.8)
        radius = reach - 0.06 * self.size
        curve = np.linspace(0.0, self.tilt, 30)
        arc = self.edge + radius * np.column_stack([np.cos(curve), np.sin(curve)])
        self.axes.plot(*arc.T, color=inks.motion, lw=1.5, zorder=4.0)
        self.arrow(arc[-8], arc[-1], inks.motion, "-|>", lw=1.5)
        at = max(arc[15][1], 0.8 * self.small * self.per_point)
        self.write(
            "$\\theta > 0$", np.array([turned[0] + 0.03 * self.size, at]), inks.motion, ha="left"
        )

    def draw_signs(self) -> None:
        """Draw the edges, the positive acceleration of the base, and what an impact does."""
        inks, s, b = self.inks, self.size, self.shape.half_width
        mark = [(0.0, 0.0), (-0.5, -0.9), (0.5, -0.9), (0.0, 0.0)]
        look: dict[str, Any] = {"marker": mark, "ms": 10.0, "mec": inks.paper, "mew": 0.6}
        self.axes.plot(*self.edge, mfc=inks.ink, ls="none", zorder=5.0, **look)
        struck = np.array([b, 0.0])
        down = np.array([0.0, 0.34 * self.deep])
        self.write("$O$", self.edge - down)
        if self.block.one_sided:
            struck = np.array([b + self.shape.overhangs[1], self.shape.height])
            self.axes.plot(*struck, "_", ms=9.0, mew=1.8, color=inks.impact, zorder=5.0)
            self.law = "$\\dot\\theta_a = -e\\,\\dot\\theta_b$"
        else:
            self.axes.plot(*struck, "|", ms=9.0, mew=1.8, color=inks.impact, zorder=5.0)
            self.write("$O'$", struck - down)
            ratio = "\\delta_\\pm" if self.differ else "\\delta"
            self.law = f"$\\dot\\theta_a = {ratio}\\,\\dot\\theta_b$"
            words = np.array([self.right, LAW * s])
            self.line(words - np.array([0.02 * s, 0.0]), struck, color=inks.impact, lw=0.7)
        arrow = np.array([-0.5 * b, -0.75 * self.deep])
        tip = arrow + np.array([0.34 * s, 0.0])
        self.arrow(arrow, tip, inks.base, "-|>,head_width=0.3,head_length=0.6", lw=2.4)
        aside = np.array([0.03 * s, 0.0])
        self.write("$\\ddot u_g > 0$", tip + aside, inks.base, ha="left")

    def write_values(self) -> None:
        """Write what the symbols are of this block, and the law of impact."""
        block, shape = self.block, self.shape
        rows: list[tuple[str, str]] = []
        if isinstance(block, Block):
            sides = [block.positive, block.negative][: 2 if self.differ else 1]
            distances = [shape.left, shape.right] if self.differ else [block.width]
            rows += [
                self._row("b" if self.differ else "2b", distances, " m"),
                self._row(self.tall, [block.height], " m"),
                *([] if block.fills_outline else [self._row("h", [shape.centre_height], " m")]),
                self._row("R", [side.radius for side in sides], " m"),
                self._row("α", [math.degrees(side.alpha) for side in sides], "°"),
                self._row("p", [side.p for side in sides], " rad/s"),
            ]
        else:
            rows.append(self._row("α₊" if self.differ else "α", [shape.alpha], " rad, as drawn"))
            if block.alpha_ratio != 1.0:
                rows.append(self._row("α₋/α₊", [block.alpha_ratio]))
            if block.p_ratio != 1.0:
                rows.append(self._row("p₋/p₊", [block.p_ratio]))
        if isinstance(block, Block) and block.cap is not None:  # what is drawn is one column
            rows.append(self._row("N", [block.cap.columns], " columns"))
            rows.append(self._row("γ", [block.cap.cap_mass_ratio], " of their mass, the cap"))
        if block.one_sided:
            rows.append(self._row("e", [block.restitution]))
        else:
            pair = block.dimensionless().sides if isinstance(block, Block) else block.sides
            ratios = [side[0] for side in pair]
            rows.append(self._row("δ", ratios if ratios[0] != ratios[1] else ratios[:1]))
        point = self.small * self.per_point
        names = 0.75 * max(len(name) for name, _ in rows) + 0.9
        top = self.axes.get_ylim()[1] - point
        wide = 2.0 * shape.half_width + shape.overhangs[1]
        height = self.turned(wide + 2.1 * self.gap, 0.5 * shape.height)
        begin = max(self.right, float(height[0]) + 1.6 * point)  # to the right of the height
        for k, (name, value) in enumerate(rows):
            at = np.array([begin, top - 1.5 * k * point])
            self.write(math_of(name), at, ha="left")
            self.write(value, at + np.array([names * point, 0.0]), ha="left")
        low = LAW * self.size
        if block.one_sided:
            low = max(low, top - 1.5 * (len(rows) + 0.4) * point)
        words = np.array([self.right, low])
        self.write(f"impact: {self.law}", words, self.inks.impact, ha="left")

    @staticmethod
    def _row(name: str, values: list[float], unit: str = "") -> tuple[str, str]:
        """Return a symbol, or that of either side, and what it is."""
        words = ", ".join(number(value) for value in values)
        return (name if len(values) == 1 else f"{name}₊, {name}₋"), words + unit

    @property
    def gap(self) -> float:
        """Return the distance of dimension lines from the block."""
        return max(0.06 * self.size, 0.9 * self.small * self.per_point)

    @property
    def per_point(self) -> float:
        """Return the length of a point in the units of the axes."""
        (low, high), (wide, tall) = self.axes.get_ylim(), size_of(self.axes)
        left, right = self.axes.get_xlim()
        return max((high - low) / tall, (right - left) / wide)
