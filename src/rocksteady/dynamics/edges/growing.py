"""Growth of stable and unstable manifolds from their saddles."""

import functools
import math
from typing import TYPE_CHECKING, Annotated

import numpy as np

from rocksteady.dynamics.basins.window import window_of
from rocksteady.dynamics.edges._leaving import (
    Departures,
    FromHilltop,
    FromOrbit,
    Images,
    impacting,
    stroboscopic,
)
from rocksteady.dynamics.edges._sampling import Plane, Sampled, joined, sampled, without_first
from rocksteady.dynamics.edges.hilltop import HilltopSaddle
from rocksteady.dynamics.edges.manifold import Kind, Manifold, ManifoldBranch, Over
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.steady.verdicts import multipliers_value
from rocksteady.errors import ModelError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds, Whole
from rocksteady.model.checks.validation import finite, in_range

if TYPE_CHECKING:
    pass


TURN = 2.0 * math.pi
LENGTH = 20.0
SPACING = 0.01
LARGEST_WINDOW = 1e3
MOST_POINTS = 20_000
"""Of a branch."""
LONGEST = 200.0
"""Periods of a saddle for which a manifold is followed."""
FIRST = 17
"""Points at which each piece is computed before it is refined."""
SETTLED = 1e-2
"""Length of the last period of labels, over the spacing, below which a branch has settled."""
WIDER = 1.2
"""Half widths of the window as far as points are kept."""
PIECE = 2.0
"""Logarithm of the growth over a piece,"""
LONGEST_PIECE = 1.0
"""which takes no more periods than this."""


@checked
def compute_manifold(
    saddle: Orbit | HilltopSaddle,
    kind: Kind,
    *,
    over: Over = "phase",
    phase: float | None = None,
    length: Annotated[
        float, Bounds(0.0, 1e4, "(]", "give a length in half widths of the window, as 20")
    ] = LENGTH,
    impacts: Annotated[int, Whole(1, 1000, "give a number of impacts, as 1")] = 1,
    window: tuple[float, float] | None = None,
    spacing: Annotated[
        float, Bounds(1e-4, 0.5, "[]", "give a distance in half widths of the window, as 0.01")
    ] = SPACING,
) -> Manifold:
    """Compute the stable or unstable manifold of a saddle.

    Each point is followed by itself with the exact flow from within 1e-6 of the saddle, forward for
    the unstable manifold and backward for the stable one, so that it lies on the manifold to some
    1e-11 and rounding.  Points are added until neighbours are closer than `spacing`, and closer
    where the curve bends.

    Parameters
    ----------
    saddle
        An `Orbit` with one unstable multiplier, or a `HilltopSaddle`.
    kind
        "stable" or "unstable".
    over
        "phase" (default) for states (u, du/d(pt)) at a phase of the shaking; "impacts" for states
        (phase, speed) just after an impact.
    phase
        Phase of the shaking [rad]; by default that of the saddle's motion.
    length
        Length of each branch inside the window, in half widths of it; default 20.
    impacts
        For a hilltop saddle over impacts: how many since or until, from 1 (default) to this number.
    window
        Half widths in u and du/d(pt) in which lengths count; by default that of `compute_basins`.
        Over impacts the second one is that of the speed.
    spacing
        Largest distance of neighbours in half widths of the window; default 0.01.

    Returns
    -------
    Manifold
        Two branches per point of the saddle.

    Raises
    ------
    InputError, ModelError
        If a number is outside its range, the orbit is no saddle or no motion, or time is to run
        backward through impacts that stop the block.

    References
    ----------
    D. Hobson, J. Comput. Phys. 104, 14-22 (1993), doi:10.1006/jcph.1993.1002.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic
    >>> from rocksteady.basins import find_hilltop_saddles
    >>> motion = Harmonic(amplitude=0.2, frequency_ratio=2.0)
    >>> saddle, _ = find_hilltop_saddles(DimensionlessBlock(restitution=0.9), motion)
    >>> manifold = compute_manifold(saddle, "unstable", length=3.0)
    >>> for branch in manifold.branches:
    ...     print(branch.sign, branch.ended)
    1 far
    -1 length
    """
    _saddle(saddle)
    bare = saddle.block.dimensionless()
    shaking = saddle.motion
    if window is None:
        window = window_of(np.array(bare.sides), shaking.amplitude, shaking.frequency_ratio)
    else:
        valid = "give half widths in u and du/d(pt), as (1.2, 1.2)"
        angle, speed = (
            in_range("window", half, 0.0, LARGEST_WINDOW, "(]", hint=valid) for half in window
        )
        window = angle, speed
    at = shaking.phase if phase is None else finite("phase", phase, hint="give radians")
    at %= TURN
    backward = kind == "stable"
    curves: list[tuple[Departures, int]] = []
    for sign in (1, -1):
        if isinstance(saddle, HilltopSaddle):
            leaving: Departures = FromHilltop(saddle, backward=backward, sign=sign)
            curves += [(leaving, k) for k in (range(1, impacts + 1) if over == "impacts" else (0,))]
        else:
            leaving = FromOrbit(saddle, backward=backward, sign=sign)
            places = saddle.period if over == "phase" else len(saddle.states)
            curves += [(leaving, k) for k in range(places)]
    forward = saddle.model.sides(saddle.block)
    branches = []
    for leaving, where in curves:
        if over == "phase":
            plane = Plane(np.zeros(2), np.array(window), 0.0)
            images = functools.partial(stroboscopic, leaving, phase=at + TURN * where)
        else:
            half = np.array([math.pi, window[1]])
            plane = Plane(np.array([math.pi, 0.0]), half, TURN)
            images = functools.partial(impacting, leaving, place=where, forward=forward)
        closed = over == "impacts" and isinstance(saddle, HilltopSaddle)
        part, ended = _grown(images, leaving.growth, plane, length, spacing, closed=closed)
        branches.append(_branch(part, plane, leaving.sign, where, ended))
    return Manifold(
        saddle=saddle,
        kind=kind,
        over=over,
        phase=at if over == "phase" else math.nan,
        branches=tuple(branches),
        window=(float(window[0]), float(window[1])),
        spacing=spacing,
    )


def _saddle(saddle: Orbit | HilltopSaddle) -> None:
    """Refuse what has no manifolds."""
    if isinstance(saddle, HilltopSaddle):
        return
    if not saddle.admissible:
        raise ModelError(
            "saddle",
            Words("passes through the floor"),
            "it is no motion",
            "choose an admissible orbit",
        )
    if multipliers_value(saddle.multipliers) is None:
        raise ModelError(
            "saddle",
            Words("is an orbit that grazes its base"),
            "no derivative exists there, and no direction along which it is left",
            "choose an unstable orbit of `find_orbits`",
        )
    first, second = (abs(complex(value)) for value in saddle.multipliers)
    if not first > 1.0 > second:
        raise ModelError(
            "saddle",
            Words(f"is an orbit with multipliers of modulus {first:.4g} and {second:.4g}"),
            "a saddle has one above 1 and one below",
            "choose an unstable orbit of `find_orbits`",
        )


def _grown(
    images: functools.partial[Images],
    growth: float,
    plane: Plane,
    length: float,
    spacing: float,
    *,
    closed: bool,
) -> tuple[Sampled, str]:
    """Return a branch, piece by piece from the saddle on, and why it ends."""
    piece = min(PIECE / growth, LONGEST_PIECE) if growth > 0.0 else LONGEST_PIECE
    end = 1.0 if closed else LONGEST
    whole, begin = None, 0.0
    while begin < end:
        stop = min(begin + piece, end)
        labels = np.linspace(begin, stop, FIRST)
        room = MOST_POINTS - (0 if whole is None else len(whole.labels))
        part = sampled(images, labels, plane, spacing, max(room, FIRST))
        if whole is None:
            whole = part
        else:
            whole = Sampled(
                np.concatenate([whole.labels, part.labels[1:]]),
                joined(whole.images, without_first(part.images)),
                np.concatenate([whole.broken, part.broken]),
                part.complete,
            )
        begin = stop
        if not part.complete or len(whole.labels) >= MOST_POINTS:
            return whole, "points"
        if closed:
            continue
        reason = _end_of(whole, plane, begin, length, spacing)
        if reason:
            return whole, reason
    assert whole is not None
    return whole, "whole" if closed else "periods"


def _end_of(whole: Sampled, plane: Plane, label: float, length: float, spacing: float) -> str:
    """Return why a branch ends at a label; empty where it goes on."""
    inner = plane.inside(whole.images)
    steps = np.sqrt(np.square(plane.chords(plane.seen(whole.images))).sum(axis=1))
    counted = np.where(~whole.broken & inner[:-1] & inner[1:], steps, 0.0)
    if counted.sum() >= length:
        return "length"
    if label < 2.0:
        return ""
    # The map takes the last period of labels to the next.
    last = whole.labels >= label - 1.0
    if not inner[last].any():
        return "far" if whole.images.fallen[last].all() else "rest"
    before = counted[(whole.labels[1:] > label - 2.0) & (whole.labels[1:] <= label - 1.0)].sum()
    now = counted[whole.labels[1:] > label - 1.0].sum()
    if not np.ptp(whole.images.first[last]) > 0.0:
        return "rest"
    return "settled" if now < before and now < SETTLED * spacing else ""


def _branch(part: Sampled, plane: Plane, sign: int, where: int, ended: str) -> ManifoldBranch:
    """Return a branch without the points that are nowhere, or far outside the window."""
    first, second, impacts, side, _ = part.images
    wide = plane._replace(half=WIDER * plane.half)
    kept = np.flatnonzero(wide.inside(part.images))
    # The curve goes on from a point to the next that is kept if nothing between them is broken.
    jumps = np.concatenate([[0], np.cumsum(part.broken)])[kept]
    breaks = np.flatnonzero((np.diff(jumps) > 0) | (np.diff(kept) > 1))
    points = np.column_stack([first[kept], second[kept]])
    lengths = np.zeros(len(points))
    if len(points) > 1:
        steps = np.diff(points, axis=0)
        if plane.turn:
            steps[:, 0] -= plane.turn * np.round(steps[:, 0] / plane.turn)
        each = np.sqrt(np.square(steps).sum(axis=1))
        each[breaks] = 0.0
        lengths = np.concatenate([[0.0], np.cumsum(each)])
    return ManifoldBranch(
        first=points[:, 0],
        second=points[:, 1],
        label=part.labels[kept],
        impacts=impacts[kept],
        side=side[kept],
        arclength=lengths,
        breaks=breaks.astype(np.int64),
        sign=sign,
        place=where,
        ended=ended,
    )
