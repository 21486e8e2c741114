"""Regions of the symmetric motion proved: existence, stability and admissibility over boxes."""

import base64
import json
import zlib
from collections import Counter, deque
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from random import SystemRandom
from typing import Annotated, Any, Literal, NamedTuple

import numpy as np
from flint import arb
from numpy.typing import NDArray

from rocksteady.certify.proofs import base_checker, region_checker
from rocksteady.certify.proofs._balls import ball, hull, precision, stated
from rocksteady.certify.proofs._flight import Arc, Shaking, stays_above
from rocksteady.certify.proofs.certificate import FORMAT
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Whole
from rocksteady.model.checks.validation import finite, whole_number
from rocksteady.results.result import Result

BITS = 53
UNDECIDED, NONE, STABLE, UNSTABLE, INADMISSIBLE, SPLIT = "012345"
WORDS = {
    STABLE: "stable",
    UNSTABLE: "unstable",
    INADMISSIBLE: "through the floor",
    NONE: "no solution",
    UNDECIDED: "undecided",
}
"""What is proved of a box, by its letter in the tree of bisections."""
MOST_BOXES = 50_000
"""Default number of boxes after which what is left stays undecided."""


BoxCount = Annotated[int, Whole(1, region_checker.MOST // 2, "give a number of boxes")]
Cells = Annotated[int, Whole(1, 10_000, "give a number of cells")]
Leaves = Annotated[int | None, Whole(1, None, "give a number of boxes, or None for all")]
Arithmetic = Literal["arb", "iv"]


class Box(NamedTuple):
    """A box of amplitudes and frequency ratios."""

    low: float
    high: float
    slow: float
    fast: float

    @property
    def area(self) -> float:
        """Its area."""
        return (self.high - self.low) * (self.fast - self.slow)

    def halves(self, depth: int) -> "tuple[Box, Box]":
        """Return both halves: by turns of the amplitudes and of the frequency ratios."""
        if depth % 2 == 0:
            middle = 0.5 * (self.low + self.high)
            return self._replace(high=middle), self._replace(low=middle)
        middle = 0.5 * (self.slow + self.fast)
        return self._replace(fast=middle), self._replace(slow=middle)


def verdict_of(box: Box, restitution: arb, order: int) -> str:
    """Return what is proved of branch 1 on a box, by the closed forms of docs/theory/steady.md.

    The formulas hold without cancellation; no ball decides at a known zero.
    """
    amplitude, ratio = hull(box.low, box.high), hull(box.slow, box.fast)
    inertia = 1 + ratio * ratio
    duration = order * arb.pi() / ratio
    decay = (-duration).exp()
    h = (1 - decay) / (1 + decay)
    share, beta = (1 - restitution) / (1 + restitution), amplitude / inertia
    p = share * h * ratio
    floor = share * h * h
    square = beta * beta * (1 + p * p) - floor * floor
    if square < 0:
        return NONE
    if not square > 0:
        return UNDECIDED
    root = square.sqrt()  # beta S of (21)
    sine = (floor + p * root) / (1 + p * p)  # beta sin(phase)
    growth = (1 - decay) * (1 - decay) / (2 * decay)  # cosh - 1
    loss = 1 - restitution
    trace = growth * (
        loss * (1 + restitution) / (2 * sine) - loss * loss * inertia / 2 - 2 * restitution
    )
    trace, limit = abs(trace - 2 * restitution), 1 + restitution * restitution
    stable, unstable = trace < limit, trace > limit
    if not stable and not unstable:
        return UNDECIDED
    if not _one_rise(amplitude, floor, beta, sine, inertia, order):
        cosine = (floor * floor - beta * beta) / (floor * p + root)  # beta cos(phase)
        phase = arb.atan2(sine, cosine)
        shaking = Shaking(amplitude, ratio, restitution)
        above = stays_above(shaking, Arc(phase, phase, duration), 8)
        if above is not True:
            return INADMISSIBLE if above is False else UNDECIDED
    return STABLE if stable else UNSTABLE


def _one_rise(amplitude: arb, floor: arb, beta: arb, sine: arb, inertia: arb, order: int) -> bool:
    """Return whether a half cycle of order 1 is proved to have no dip, by its forcing alone.

    It has none if the forcing never pushes up, or does at the start, or the phase is beyond pi/2:
    then it pushes up once at most, from the start on (docs/theory/march.md, pieces).
    """
    if order != 1:
        return False
    return bool(amplitude < 1 or sine * inertia > 1 or beta > floor)


@checked
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class ProvedRegion(Result):
    """What is proved of the symmetric motion over amplitude and frequency ratio.

    Attributes
    ----------
    amplitude, frequency_ratio
        Ends of both ranges.
    restitution
        Decimals of the restitution: what is proved holds for all numbers between them.
    order
        Half periods of the shaking in half a cycle, odd.
    tree
        A letter for each box of the bisections, breadth first: `WORDS`, and "5" for a box that is
        halved.
    """

    amplitude: tuple[float, float]
    frequency_ratio: tuple[float, float]
    restitution: tuple[str, ...]
    order: int
    tree: str

    def boxes(self) -> Iterator[tuple[Box, str]]:
        """Yield the boxes that are not halved, each with its letter."""
        rows = deque([(Box(*self.amplitude, *self.frequency_ratio), 0)])
        for letter in self.tree:
            box, depth = rows.popleft()
            if letter == SPLIT:
                rows += [(half, depth + 1) for half in box.halves(depth)]
            else:
                yield box, letter

    @cached_property
    def shares(self) -> dict[str, float]:
        """Share of the area of each verdict, by its words."""
        areas: Counter[str] = Counter()
        for box, letter in self.boxes():
            areas[letter] += box.area  # type: ignore[assignment]
        whole = Box(*self.amplitude, *self.frequency_ratio).area
        return {words: areas[letter] / whole for letter, words in WORDS.items()}

    @property
    def decided(self) -> float:
        """Share of the area that is decided."""
        return 1.0 - self.shares[WORDS[UNDECIDED]]

    @checked
    def grid(self, rows: Cells, columns: Cells) -> NDArray[np.int64]:
        """Return the letter of the box of each point of a grid as a number, lowest row first.

        Parameters
        ----------
        rows, columns
            Number of amplitudes and of frequency ratios, at the middles of equal cells.
        """
        cells = np.zeros((rows, columns), dtype=np.int64)
        (low, high), (slow, fast) = self.amplitude, self.frequency_ratio
        for box, letter in self.boxes():
            first, last = ((x - low) / (high - low) * rows for x in box[:2])
            left, right = ((x - slow) / (fast - slow) * columns for x in box[2:])
            part = slice(round(first), round(last)), slice(round(left), round(right))
            cells[part] = int(letter)
        return cells

    def values(self) -> dict[str, Any]:
        """Return what the file of the region, or of one of its boxes, holds."""
        return {
            "format": FORMAT,
            "kind": "region",
            "model": {"restitution": list(self.restitution)},
            "bits": BITS,
            "amplitude": list(self.amplitude),
            "frequency_ratio": list(self.frequency_ratio),
            "order": self.order,
        }

    def to_json(self) -> str:
        """Return the text of the file: the ranges, and the tree of bisections packed."""
        packed = base64.b64encode(zlib.compress(self.tree.encode(), 9)).decode()
        return json.dumps(self.values() | {"tree": packed}, indent=1) + "\n"

    def box_json(self, path: str, letter: str) -> str:
        """Return the text of the file of one box.

        Parameters
        ----------
        path
            Which halves lead to it: 0 for a lower half and 1 for an upper, of amplitudes and of
            frequency ratios by turns.
        letter
            What is claimed of it, as `WORDS` says.

        Raises
        ------
        InputError
            If the path has other signs, or there is no such claim.
        """
        given: tuple[tuple[str, Any, str], ...] = (
            ("path", path, "01"),
            ("letter", letter, "".join(WORDS)),
        )
        for name, text, signs in given:
            if not isinstance(text, str) or not set(text) <= set(signs):
                raise InputError(
                    name, text, f"it is written with {' '.join(signs)}", "read it in the tree"
                )
        claim = {"path": path, "claim": {"letter": letter}}
        return json.dumps(self.values() | claim, indent=1) + "\n"

    @checked
    def check(self, leaves: Leaves = 1000, arithmetic: Arithmetic = "arb") -> str:
        """Return whether the largest boxes and random ones, or all, are proved again.

        Parameters
        ----------
        leaves
            Number of boxes: half of them are the largest ones, and the others drawn by their area;
            None for all.
        arithmetic
            "arb" of python-flint, or "iv" of mpmath.

        Returns
        -------
        str
            "holds" where all boxes are proved, "sampled" and the share of the area where some are;
            otherwise "refused" or "undecided", and why.
        """
        try:
            rows = region_checker.claims(json.loads(self.to_json()))
        except ValueError as wrong:
            return f"refused: {wrong}"
        rows.sort(key=lambda row: len(row[0]))
        if leaves is not None and leaves < len(rows):
            # No file can know which boxes the operating system draws.  The least of exponential
            # times over their areas are draws by area.
            first, random = (leaves + 1) // 2, SystemRandom()
            times = {row: random.expovariate(0.5 ** len(row[0])) for row in rows[first:]}
            chosen = [*rows[:first], *sorted(times, key=times.__getitem__)[: leaves - first]]
        else:
            chosen = rows
        with precision(BITS):
            for path, letter in chosen:
                answer = base_checker.check(
                    self.box_json(path, letter), getattr(base_checker, arithmetic)
                )
                if answer != "holds":
                    return str(answer)
        if len(chosen) == len(rows):
            return f"holds: {f'all {len(rows):,} boxes' if rows[1:] else 'its one box'} checked"
        read, whole = (sum(0.5 ** len(path) for path, _ in each) for each in (chosen, rows))
        share = f"{100.0 * read / whole:.3g} % of the area that it claims"
        return f"sampled: {len(chosen):,} of {len(rows):,} boxes checked, {share}"


@checked
def certify_region(
    amplitude: tuple[float, float],
    frequency_ratio: tuple[float, float],
    restitution: float | str,
    *,
    order: int = 1,
    most_boxes: BoxCount = MOST_BOXES,
) -> ProvedRegion:
    """Prove where the symmetric motion of branch 1 exists and is stable, over boxes.

    Boxes are halved until one verdict holds for all of their members: a stable or an unstable
    motion, a solution that passes through the floor, or none.

    Parameters
    ----------
    amplitude, frequency_ratio
        Both ranges (low, high).
    restitution
        A number, or its decimal as text.
    order
        Half periods of the shaking in half a cycle, odd.
    most_boxes
        Boxes after which what is left stays undecided.

    Raises
    ------
    InputError
        If a range is empty or not above 0, the restitution is not below 1, or the order is even.

    Examples
    --------
    >>> region = certify_region((1.9, 2.1), (1.9, 2.1), 0.8)
    >>> region.decided > 0.99, region.shares["no solution"]
    (True, 0.0)
    """
    for name, ends in (("amplitude", amplitude), ("frequency_ratio", frequency_ratio)):
        low, high = (finite(name, end, hint="give its ends, as (0.3, 6)") for end in ends)
        if not 0.0 < low < high < 1e6:
            raise InputError(
                name, (low, high), "it must be a range above 0", "give its ends, as (0.3, 6)"
            )
    order = whole_number("order", order, at_least=1, at_most=99, hint="give 1 or 3")
    if order % 2 == 0:
        raise InputError("order", order, "it must be odd", "give 1 or 3")
    texts = stated("restitution", restitution)
    if not 0.0 < Fraction(texts[0]) < 1.0:
        raise InputError(
            "restitution", restitution, "it must lie in (0, 1)", "give a ratio of velocities"
        )
    letters: list[str] = []
    queue = deque([(Box(*amplitude, *frequency_ratio), 0)])
    with precision(BITS):
        loss = ball(texts)
        while queue:
            box, depth = queue.popleft()
            room = len(letters) + len(queue) < most_boxes
            letter = verdict_of(box, loss, order) if room else UNDECIDED
            if letter == UNDECIDED and room:
                letter = SPLIT
                queue += [(half, depth + 1) for half in box.halves(depth)]
            letters.append(letter)
    return ProvedRegion(
        amplitude=amplitude,
        frequency_ratio=frequency_ratio,
        restitution=texts,
        order=order,
        tree="".join(letters),
    )


def region_from(text: str) -> ProvedRegion | None:
    """Return the region of the text of a certificate's file; None if it is no region of a tree."""
    try:
        values, _ = base_checker.read(text)
        region_checker.leaves(values)
    except (ValueError, LookupError):
        return None
    (low, high), (slow, fast) = values["amplitude"], values["frequency_ratio"]
    return ProvedRegion(
        amplitude=(low, high),
        frequency_ratio=(slow, fast),
        restitution=tuple(values["model"]["restitution"]),
        order=values["order"],
        tree=region_checker.tree_of(values),
    )
