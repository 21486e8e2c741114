"""Words on a plane of curves: along the lines, beside marked points, and inside regions."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.show.style.legends import LETTER, figure_of, size_of, text_size
from rocksteady.show.style.line_colours import inks_of

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
AROUND = [(1, 0), (1, 1), (1, -1), (-1, 0), (-1, 1), (-1, -1), (0, 1), (0, -1)]
"""Sides of a mark on which its word is tried, in turn."""


class Words:
    """Places of axes that are taken, in points from their lower left corner.

    Parameters
    ----------
    axes
        With their final limits and scales.
    lines
        Abscissas and ordinates of each line, shape (points, 2), that words should not cover.
    """

    def __init__(self, axes: "Axes", lines: Sequence[Floats]) -> None:
        figure = figure_of(axes)
        if figure.get_layout_engine() is not None:
            figure.draw_without_rendering()  # where the legend leaves room for the axes
        axes.get_xlim(), axes.get_ylim()  # which settles limits that are not yet known
        self.axes, self.size = axes, np.array(size_of(axes))
        self.lines = [self._spaced(self.there(line)) for line in lines]
        self.taken: list[tuple[Floats, float]] = []

    def there(self, places: Floats) -> Floats:
        """Return places in points from the lower left corner."""
        shown = self.axes.transData.transform(np.asarray(places, dtype=float))
        points: Floats = self.axes.transAxes.inverted().transform(shown) * self.size
        return points

    def take(self, places: Sequence[tuple[float, float]], radius: float) -> None:
        """Keep words off marks."""
        if len(places):
            self.taken.append((self.there(np.array(places)), radius))

    def along(self, names: Sequence[str], colours: Sequence[str]) -> None:
        """Write names along lines, where each has most room; for a bundle on one of its lines."""
        size = text_size(self.axes, 7.0)
        named = [False] * len(self.lines)
        order = sorted(range(len(self.lines)), key=lambda k: -len(self.lines[k]))
        for number in order:
            if named[number] or not names[number]:
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
                    for k, each in enumerate(self.lines)
                    if k == number
                    or all(self._far(each, at) < BUNDLE for at in (line[index], *ends))
                ]
                words = dict.fromkeys([names[number], *(names[k] for k in bundle if names[k])])
                text, half, angle = self._fitting([*words], line, index, size) or alone
                shape = self._shape(line[index], angle, half)
                if not self._free(shape, 0.75 * size):
                    continue
                apart = [each for k, each in enumerate(self.lines) if k not in bundle]
                room = min(
                    (self._far(each, place) for each in apart for place in shape[::2]),
                    default=40.0,
                )
                if best is None or min(room, 40.0) > best[0]:
                    best = (min(room, 40.0), line[index], angle, text, bundle)
            if best is None or best[0] < 0.6 * size:
                continue
            _, place, angle, text, bundle = best
            half = 0.5 * LETTER * size * len(text) + 3.0
            self.taken.append((self._shape(place, angle, half), 0.6 * size))
            for k in bundle:
                named[k] = True
            self._write(place, text, size, colours[number], angle=angle, on_line=True)

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

    def beside(self, place: tuple[float, float], text: str) -> bool:
        """Write a word beside a mark, and return whether there was room."""
        size = text_size(self.axes, 7.0)
        width = LETTER * size * len(text)
        (mark,) = self.there(np.array([place]))
        best: tuple[float, Floats] | None = None
        for reach in (5.0, 12.0):
            for across, up in AROUND:
                aside = 0.5 * width + reach * (0.7 if up else 1.0)
                middle = mark + np.array([across * aside, up * (0.5 * size + reach)])
                shape = self._shape(middle, 0.0, 0.5 * width)
                if not self._free(shape, 0.6 * size):
                    continue
                room = min(
                    (self._far(line, each) for line in self.lines for each in shape), default=40.0
                )
                if best is None or min(room, size) > best[0] + 0.5:
                    best = (min(room, size), middle)
        if best is None or best[0] < 0.45 * size:
            return False
        self.taken.append((self._shape(best[1], 0.0, 0.5 * width), 0.6 * size))
        self._write(best[1], text, size, inks_of(self.axes).ink)
        return True

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
            room = min((self._far(line, each) for line in self.lines for each in shape), default=9)
            if room > 0.6 * size and self._free(shape, 0.6 * size):
                self.taken.append((shape, 0.6 * size))
                self._write(middle, text, size, inks_of(self.axes).number, italic=True)
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
    def _far(line: Floats, place: Floats) -> float:
        return float(np.hypot(*(line - place).T).min()) if len(line) else math.inf

    def _free(self, shape: Floats, radius: float) -> bool:
        inside = ((shape > 2.0) & (shape < self.size - 2.0)).all()
        return bool(inside) and all(
            self._far(places, each) > radius + margin
            for places, margin in self.taken
            for each in shape
        )
