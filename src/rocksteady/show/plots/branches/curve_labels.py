"""Words on a plane of curves: along the lines, beside marked points, and inside regions."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.show.style.layout import CORNERS, Corner
from rocksteady.show.style.legends import (
    GAP,
    LETTER,
    LegendPlace,
    draw_legend,
    figure_of,
    size_of,
    text_size,
)
from rocksteady.show.style.line_ends import APART, spread_heights
from rocksteady.show.style.tokens import DASHED, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes


SPACING = 3.0
"""Between the points of a line at which a word is tried [points]."""
BUNDLE = 4.0
"""Distance below which lines look like one [points]."""
STRAIGHT = 2.5
"""Largest distance of a line from the chord under its word [points]."""
MOST_NAMES = 2
"""Names in one word on a bundle of lines; for a larger one the first alone is written."""
MOST_SHIFT = 6.0
"""Distance of a name from the end of its line at which it is no longer there [heights of text]."""
MARK = 3.0
"""How far marks on a line stand out from it [points]."""
LEAST_GAP = 0.62
"""Least distance of lines from the middle of a word beside a mark [heights of text]."""
MOST_ROOM = 40.0
"""Distance from other lines beyond which more of it is no better [points]."""
AROUND = [(1, 0), (1, 1), (1, -1), (-1, 0), (-1, 1), (-1, -1), (0, 1), (0, -1)]
"""Sides of a mark on which its word is tried, in turn."""


def explain(
    axes: "Axes", place: LegendPlace, handles: Sequence[Any], note: str, *, gap: float = GAP
) -> None:
    """Draw the legend of what has no name in the picture, with a note above it."""
    from matplotlib.lines import Line2D

    style: dict[str, Any] = {"title": note, "alignment": "left"}
    if note and not handles:
        handles = [Line2D([], [], ls="none", label=note)]
        style = {"handlelength": 0.0, "handletextpad": 0.0}
    draw_legend(axes, place, handles=handles, corner="best", gap=gap, **style)


def limit_entries(axes: "Axes", names: Sequence[str]) -> list[Any]:
    """Return the entries of a legend for dashed lines of limits that have no name."""
    from matplotlib.lines import Line2D

    look: dict[str, Any] = {"color": inks_of(axes).limit, "ls": DASHED, "lw": 0.8}
    return [Line2D([], [], label=name, **look) for name in names]


class Words:
    """Places of axes that are taken, in points from their lower left corner.

    Parameters
    ----------
    axes
        With their final limits and scales.
    lines
        Abscissas and ordinates of each line, shape (points, 2), that words should not cover.
    dots
        The same of marks that words should not cover either.
    """

    def __init__(self, axes: "Axes", lines: Sequence[Floats], dots: Sequence[Floats] = ()) -> None:
        figure = figure_of(axes)
        if figure.get_layout_engine() is not None:
            figure.draw_without_rendering()  # where the legend leaves room for the axes
        axes.get_xlim(), axes.get_ylim()  # which settles limits that are not yet known
        self.axes, self.size = axes, np.array(size_of(axes))
        self.lines = [self._spaced(self.there(line)) for line in lines]
        self.taken: list[tuple[Floats, float]] = []
        self.boxes: list[Floats] = []
        self.gap = 2.5 + (MARK if dots else 0.0)  # of words from their line [points]
        every = [*self.lines, *(self.there(each) for each in dots)]
        self.owners = np.repeat(np.arange(len(every)), [len(each) for each in every])
        self.points = np.concatenate([np.zeros((0, 2)), *every])

    def there(self, places: Floats) -> Floats:
        """Return places in points from the lower left corner."""
        shown = self.axes.transData.transform(np.asarray(places, dtype=float))
        points: Floats = self.axes.transAxes.inverted().transform(shown) * self.size
        return points[np.isfinite(points).all(axis=1)]

    def length(self, number: int) -> float:
        """Return the length of a line within the axes."""
        return SPACING * len(self.lines[number])

    def take(self, places: Sequence[tuple[float, float]], radius: float) -> None:
        """Keep words off marks."""
        if len(places):
            self.taken.append((self.there(np.array(places)), radius))

    def take_box(self, x0: float, y0: float, x1: float, y1: float) -> None:
        """Keep words off a box, in parts of the axes."""
        self.boxes.append(np.array([[x0, y0], [x1, y1]]) * self.size)

    def along(
        self,
        names: Sequence[str],
        colours: Sequence[str],
        *,
        aside: bool = False,
        once: bool = False,
    ) -> set[str]:
        """Write names along lines, where each has most room, and return those with room.

        Parameters
        ----------
        names, colours
            One of each a line; no name is written where it is empty.
        aside
            Whether names stand beside their lines, or on them (default).
        once
            Whether each name is written on one of its lines; else on each, for a bundle of lines
            on one of them.
        """
        size = text_size(self.axes, 7.0)
        shifts = (0.5 * size + self.gap) * np.array([1.0, -1.0]) if aside else np.zeros(1)
        done, written = [not name for name in names], set[str]()
        for number in sorted(range(len(names)), key=lambda k: -len(self.lines[k])):
            if done[number] or (once and names[number] in written):
                continue
            best: tuple[float, Floats, float, str, list[int]] | None = None
            line = self.lines[number]
            for index in range(2, len(line) - 2, 3):
                alone = self._fitting(names[number : number + 1], line, index, size)
                if alone is None:
                    continue
                # A bundle is what lies together all along the word.
                ends = self._shape(line[index], alone[2], alone[1])[[0, -1]]
                bundle = [
                    k
                    for k, each in enumerate(self.lines[: len(names)])
                    if k == number
                    or (
                        not once
                        and all(self._far(each, at) < BUNDLE for at in (line[index], *ends))
                    )
                ]
                others = (names[k] for k in bundle if names[k] and not (aside and done[k]))
                words = dict.fromkeys([names[number], *others])
                if aside and len(words) > MOST_NAMES:
                    continue
                text, half, angle = self._fitting([*words], line, index, size) or alone
                for shift in shifts:
                    normal = np.array([-math.sin(angle), math.cos(angle)])
                    middle = line[index] + shift * normal
                    shape = self._shape(middle, angle, half)
                    if not self._free(shape, 0.75 * size):
                        continue
                    room = self._room(shape, bundle) - 0.01 * abs(index - 0.5 * len(line))
                    room -= 8.0 * (aside and len(words) > 1)  # a name alone is better
                    if best is None or room > best[0]:
                        best = (room, middle, angle, text, bundle)
            if best is None or best[0] < 0.6 * size:
                continue
            _, place, angle, text, bundle = best
            text = text.removesuffix(" …") if aside else text
            half = 0.5 * LETTER * size * len(text) + 3.0
            self.taken.append((self._shape(place, angle, half), 0.6 * size))
            on_it = {names[k] for k in bundle if names[k] in text}
            for k in bundle:
                done[k] = done[k] or not aside or names[k] in on_it
            written |= on_it
            self._write(place, text, size, colours[number], angle=angle, on_line=not aside)
        return written

    def _fitting(
        self, words: Sequence[str], line: Floats, index: int, size: float
    ) -> tuple[str, float, float] | None:
        """Return as many names as a line has room for at a point, half their width, its slope."""
        most = len(words) if len(words) <= MOST_NAMES else 1
        for words_kept in range(most, 0, -1):
            text = " | ".join(words[:words_kept]) + (" …" if len(words) > words_kept else "")
            half = 0.5 * LETTER * size * len(text) + 3.0
            angle = self._angle(line, index, half)
            if angle is not None:
                return text, half, angle
        return None

    def at_ends(self, names: Sequence[str], colours: Sequence[str]) -> set[str]:
        """Write names at the right ends of the first lines, and return those with room.

        Outside the axes they make way for each other.
        """
        size = text_size(self.axes, 7.0)
        ends = {k: self.lines[k][-1] for k in range(len(names)) if len(self.lines[k])}
        outer = [k for k in ends if ends[k][0] > self.size[0] - 2.0 * SPACING]
        outer.sort(key=lambda k: float(ends[k][1]))
        wanted = np.array([ends[k][1] for k in outer])
        steps = [APART * size] * (len(wanted) - 1)
        heights = spread_heights(wanted, steps, lowest=0.5 * size, highest=math.inf)
        written = set()
        if np.abs(heights - wanted).max(initial=0.0) < MOST_SHIFT * size:
            for k, up in zip(outer, heights - wanted, strict=True):
                self._annotate(ends[k], (6.0, up), names[k], colours[k], ha="left")
                written.add(names[k])
        back = self.axes.transAxes + self.axes.transData.inverted()
        for k in ends.keys() - {*outer}:
            x, y = back.transform(ends[k] / self.size).tolist()
            if self.beside((x, y), names[k], colours[k]):
                written.add(names[k])
        return written

    def emptiest_corner(self, width: float, height: float) -> Corner:
        """Return the corner where a legend of a size [points] covers fewest points and no word."""
        size = np.array([width, height])
        weights = [(self.points, 1.0), *((places, 1e3) for places, _ in self.taken)]

        def hidden(corner: tuple[int, int]) -> float:
            low = np.array(corner) * (self.size - size)
            high = low + size
            return sum(
                weight * float(((places > low) & (places < high)).all(axis=1).sum())
                for places, weight in weights
            )

        return min(CORNERS, key=lambda name: hidden(CORNERS[name]))

    def beside(self, place: tuple[float, float], text: str, colour: str = "") -> bool:
        """Write a word beside a mark, and return whether there was room."""
        size = text_size(self.axes, 7.0)
        width = LETTER * size * len(text)
        (mark,) = self.there(np.array([place]))
        best: tuple[float, Floats] | None = None
        for reach in (5.0, 12.0, 20.0):
            for across, up in AROUND:
                aside = 0.5 * width + reach * (0.7 if up else 1.0)
                offset = np.array([across * aside, up * (0.5 * size + reach)])
                shape = self._shape(mark + offset, 0.0, 0.5 * width)
                if not self._free(shape, 0.6 * size):
                    continue
                room = min(self._room(shape), size)
                if best is None or room > best[0] + 0.5:
                    best = (room, offset)
        if best is None or best[0] < LEAST_GAP * size:
            return False
        offset = best[1]
        self.taken.append((self._shape(mark + offset, 0.0, 0.5 * width), 0.6 * size))
        self._annotate(mark, offset, text, colour or inks_of(self.axes).ink)
        return True

    def _annotate(
        self, place: Floats, offset: ArrayLike, text: str, colour: str, ha: str = "center"
    ) -> None:
        """Write a word at a distance [points] from a place, which it keeps in any layout."""
        from matplotlib.patheffects import withStroke

        back = self.axes.transAxes + self.axes.transData.inverted()
        across, up = np.asarray(offset, dtype=float).tolist()
        self.axes.annotate(
            text,
            back.transform(place / self.size).tolist(),
            (across, up),
            textcoords="offset points",
            ha=ha,
            va="center",
            fontsize=text_size(self.axes, 7.0),
            color=colour,
            zorder=5.0,
            annotation_clip=False,
            path_effects=[withStroke(linewidth=2.0, foreground=inks_of(self.axes).paper)],
        )

    def inside(self, places: Sequence[tuple[float, float]], text: str) -> bool:
        """Write a word at the first of several places with room, and return whether one has."""
        size = text_size(self.axes, 7.0)
        rows = text.split("\n")
        half = 0.5 * LETTER * size * max(map(len, rows))
        for place in places:
            (middle,) = self.there(np.array([place]))
            heights = 1.2 * size * (np.arange(len(rows)) - 0.5 * (len(rows) - 1))
            shape = np.concatenate(
                [self._shape(middle + np.array([0.0, up]), 0.0, half) for up in heights]
            )
            if self._room(shape) > 0.6 * size and self._free(shape, 0.6 * size):
                self.taken.append((shape, 0.6 * size))
                self._write(middle, text, size, inks_of(self.axes).quiet, italic=True)
                return True
        return False

    def _write(
        self,
        place: Floats,
        text: str,
        size: float,
        colour: str,
        *,
        angle: float = 0.0,
        italic: bool = False,
        on_line: bool = False,
    ) -> None:
        from matplotlib.patheffects import withStroke

        paper = inks_of(self.axes).paper
        behind: dict[str, Any] = {"path_effects": [withStroke(linewidth=2.5, foreground=paper)]}
        if on_line:  # which is interrupted there
            behind = {"bbox": {"fc": paper, "ec": "none", "pad": 0.4}}
        back = self.axes.transAxes + self.axes.transData.inverted()
        middle, ahead = back.transform(
            [place / self.size, (place + np.array([math.cos(angle), math.sin(angle)])) / self.size]
        )
        slope = math.atan2(ahead[1] - middle[1], ahead[0] - middle[0])
        # Of a layout that comes later the word follows its line.
        self.axes.text(
            float(middle[0]),
            float(middle[1]),
            text,
            ha="center",
            va="center",
            rotation=math.degrees(slope),
            rotation_mode="anchor",
            transform_rotates_text=True,
            clip_on=True,
            fontsize=size,
            color=colour,
            style="italic" if italic else "normal",
            zorder=5.0,
            **behind,
        )

    def _spaced(self, line: Floats) -> Floats:
        """Return points of a line at equal distances, those outside of the axes left out."""
        steps = np.hypot(*np.diff(line, axis=0).T) if len(line) > 1 else np.zeros(0)
        passed = np.concatenate([[0.0], np.cumsum(steps)])
        if passed[-1] <= 0.0:
            return line[:1]
        places = np.arange(0.0, passed[-1], SPACING)
        spaced = np.column_stack([np.interp(places, passed, line[:, k]) for k in (0, 1)])
        within = ((spaced >= 0.0) & (spaced <= self.size)).all(axis=1)
        positions: Floats = spaced[within]
        return positions

    def _angle(self, line: Floats, index: int, half: float) -> float | None:
        """Return the slope of a line under a word; None where it bends or ends there."""
        reach = math.ceil(half / SPACING)
        if index - reach < 0 or index + reach >= len(line):
            return None
        under = line[index - reach : index + reach + 1]
        chord = under[-1] - under[0]
        length = float(np.hypot(*chord))
        if length < 1.6 * half:
            return None
        off = np.abs((under - under[0]) @ np.array([-chord[1], chord[0]])) / length
        if off.max() > STRAIGHT:
            return None
        angle = math.atan2(chord[1], chord[0])
        if abs(angle) > 0.5 * math.pi:
            angle -= math.copysign(math.pi, angle)
        box = self._shape(line[index], angle, half)
        inside = ((box > 4.0) & (box < self.size - 4.0)).all()
        return angle if inside else None

    @staticmethod
    def _shape(middle: Floats, angle: float, half: float) -> Floats:
        """Return points along the middle of a word."""
        ways = np.linspace(-half, half, max(2, math.ceil(half / 3.0)))
        corners: Floats = middle + np.outer(ways, [math.cos(angle), math.sin(angle)])
        return corners

    @staticmethod
    def _far(line: Floats, places: Floats) -> float:
        """Return the least distance between points of a line and one or more places."""
        apart = line[:, np.newaxis] - places
        return float(np.hypot(apart[..., 0], apart[..., 1]).min(initial=math.inf))

    def _room(self, shape: Floats, without: Sequence[int] = ()) -> float:
        """Return the distance of a word from lines and dots, those of some lines left out."""
        low, high = shape.min(axis=0) - MOST_ROOM, shape.max(axis=0) + MOST_ROOM
        (near,) = ((self.points > low) & (self.points < high)).all(axis=1).nonzero()
        near = near[~np.isin(self.owners[near], without)]
        return min(MOST_ROOM, self._far(self.points[near], shape))

    def _free(self, shape: Floats, radius: float) -> bool:
        inside = ((shape > 2.0) & (shape < self.size - 2.0)).all()
        boxed = any(
            ((shape > low - radius) & (shape < high + radius)).all(axis=1).any()
            for low, high in self.boxes
        )
        return (
            bool(inside)
            and not boxed
            and all(self._far(places, shape) > radius + margin for places, margin in self.taken)
        )
