"""Sampling of a curve that a label runs along: finer where it is long, bent, or jumps.

After D. Hobson, J. Comput. Phys. 104, 14-22 (1993): neighbours are close together, and where the
curve bends they are closer.  Distances are taken in a plane in which a window has the half widths
1 and everything beyond it is drawn together, so that what is far away costs little and yet a
curve that comes back from there is not missed.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Bools, Floats
from rocksteady.dynamics.edges._leaving import Images
from rocksteady.kernels.elementary.arrays import acos

BEND = 0.3
"""Angle between neighbouring chords [rad] above which the curve is refined."""
PART = 0.1
"""Largest product of that angle and a chord, over the spacing."""
CLOSEST = 0.02
"""Chords over the spacing below which the angle does not count."""
NEXT = 1e-10
"""Difference of labels below which a gap between neighbours is a jump."""


class Plane(NamedTuple):
    """The plane in which distances between points of a curve are taken.

    Attributes
    ----------
    middle, half
        Middle and half widths of the window, shape (2,).
    turn
        Period of the first coordinate; 0 for none.
    """

    middle: Floats
    half: Floats
    turn: float

    def seen(self, images: Images) -> Floats:
        """Return points with what is beyond the window drawn together, shape (points, 2)."""
        points = np.column_stack([images.first, images.second])
        scaled = (points - self.middle) / self.half
        with np.errstate(divide="ignore", invalid="ignore"):
            drawn = np.where(np.abs(scaled) > 1.0, np.sign(scaled) * 2.0 - 1.0 / scaled, scaled)
        if self.turn:
            drawn[:, 0] = scaled[:, 0]
        return drawn

    def inside(self, images: Images) -> Bools:
        """Return which points lie in the window."""
        points = np.column_stack([images.first, images.second])
        near = np.abs(points - self.middle) <= self.half
        if self.turn:
            near[:, 0] = np.isfinite(points[:, 0])
        inside: Bools = near[:, 0] & near[:, 1]
        return inside

    def chords(self, seen: Floats) -> Floats:
        """Return the differences of neighbours, the shortest way round."""
        steps: Floats = np.diff(seen, axis=0)
        if self.turn:
            period = self.turn / self.half[0]
            steps[:, 0] -= period * np.round(steps[:, 0] / period)
        return steps


class Sampled(NamedTuple):
    """A part of a curve.

    Attributes
    ----------
    labels, images
        In order of the labels.
    broken
        Whether the curve jumps, or is nowhere, between a point and the next, shape (points - 1,).
    complete
        False where there were more points to compute than allowed.
    """

    labels: Floats
    images: Images
    broken: Bools
    complete: bool


def joined(one: Images, other: Images, order: NDArray[np.int64] | None = None) -> Images:
    """Return the points of both, in an order."""
    place = np.arange(len(one.first) + len(other.first)) if order is None else order
    return Images(
        np.concatenate([one.first, other.first])[place],
        np.concatenate([one.second, other.second])[place],
        np.concatenate([one.impacts, other.impacts])[place],
        np.concatenate([one.side, other.side])[place],
        np.concatenate([one.fallen, other.fallen])[place],
    )


def without_first(images: Images) -> Images:
    """Return points without the first."""
    first, second, impacts, side, fallen = images
    return Images(first[1:], second[1:], impacts[1:], side[1:], fallen[1:])


def sampled(
    curve: Callable[[Floats], Images],
    labels: Floats,
    plane: Plane,
    spacing: float,
    most: int,
) -> Sampled:
    """Return a curve between the first and the last of some labels.

    Parameters
    ----------
    curve
        Its points by their labels.
    labels
        At which it is computed first, ascending.
    plane
        Where distances are taken.
    spacing
        Largest distance of neighbours, in half widths of the window.
    most
        Points after which it is left as it is.
    """
    images = curve(labels)
    while True:
        flagged, gaps = _coarse(plane, images, spacing)
        tight = np.diff(labels) <= NEXT * np.maximum(1.0, np.abs(labels[1:]))
        wanted = flagged & ~tight
        broken = gaps & tight
        if not wanted.any() or len(labels) >= most:
            return Sampled(labels, images, gaps if wanted.any() else broken, not wanted.any())
        new = 0.5 * (labels[:-1] + labels[1:])[wanted]
        labels_sampled = np.concatenate([labels, new])
        order = np.argsort(labels_sampled, kind="stable")
        labels, images = labels_sampled[order], joined(images, curve(new), order)


def _coarse(plane: Plane, images: Images, spacing: float) -> tuple[Bools, Bools]:
    """Return between which neighbours the curve is to be refined, and which are far apart."""
    seen = plane.seen(images)
    nowhere: Bools = np.isnan(seen[:, 0]) | np.isnan(seen[:, 1])
    steps = plane.chords(seen)
    length = np.sqrt(np.square(steps).sum(axis=1))
    edge = nowhere[:-1] != nowhere[1:]
    apart: Bools = (length > spacing) | edge
    flagged = apart.copy()
    if len(steps) > 1:
        product = length[:-1] * length[1:]
        inner = (steps[:-1] * steps[1:]).sum(axis=1)
        usable = product > 0.0
        cosine = np.where(usable, inner / np.where(usable, product, 1.0), 1.0)
        angle = acos(np.clip(np.nan_to_num(cosine, nan=1.0), -1.0, 1.0))
        for place in (slice(None, -1), slice(1, None)):
            long = length[place]
            bent = ((angle > BEND) & (long > CLOSEST * spacing)) | (angle * long > PART * spacing)
            flagged[place] |= bent & (long > CLOSEST * spacing)
    either = ~(nowhere[:-1] & nowhere[1:])
    return flagged & either, apart & either | (nowhere[:-1] & nowhere[1:])
