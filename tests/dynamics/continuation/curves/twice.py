"""Curves listed twice, seen from the moments of impacts with a speed and from nothing else."""

import math
from itertools import permutations

import numpy as np

from rocksteady.branches import BifurcationCurve, BifurcationCurves, BranchPoint

Impacts = np.ndarray

CHORD = 2e-3
"""Most by which a chord between two points of a curve lies beside it, in parts of the ranges and
in rad: its length of .02 (pi of phase each) times its largest turn of .1 rad, over 8, is 8e-4."""
SHARED = 3
"""Points that two different curves have in common at most: where one begins on the other."""


def impacts(point: BranchPoint) -> Impacts:
    """Return phase and side of each impact with a speed, in order, shape (k, 2)."""
    chain = point.chain
    listed = []
    for k in range(point.impacts):
        row = k % chain.impacts
        if min(chain.durations[row - 1], chain.durations[row]) > 1e-7:
            halves = chain.turns[row] + (chain.half_cycles if k >= chain.impacts else 0)
            listed.append((chain.phases[row] + halves * math.pi, (-1.0) ** k))
    return np.array(listed).reshape(-1, 2)


def turned(angle: Impacts) -> Impacts:
    """Return an angle between -pi and pi."""
    return (angle + math.pi) % (2.0 * math.pi) - math.pi


def apart(one: Impacts, other: Impacts) -> float:
    """Return the largest distance of an impact of one motion from the nearest of the other."""
    if not len(one) or not len(other):
        return 0.0 if len(one) == len(other) else math.inf
    distance = np.abs(turned(one[:, None, 0] - other[None, :, 0]))
    distance = np.where(one[:, None, 1] == other[None, :, 1], distance, math.inf)
    return float(max(distance.min(axis=0).max(), distance.min(axis=1).max()))


def shared(one: BifurcationCurve, other: BifurcationCurve, widths: Impacts) -> int:
    """Return how many points of a curve lie on another, or their mirror images do."""
    places = one.values / widths
    chords = np.diff(places, axis=0)
    lengths = np.maximum((chords**2).sum(axis=1), 1e-300)
    motions = [impacts(point) for point in one.points]
    total = 0
    for point, place in zip(other.points, other.values / widths, strict=True):
        parts = np.clip(((place - places[:-1]) * chords).sum(axis=1) / lengths, 0.0, 1.0)
        beside = np.abs(places[:-1] + parts[:, None] * chords - place).max(axis=1)
        k = int(beside.argmin())
        first, last = motions[k], motions[k + 1]
        if beside[k] > CHORD or first.shape != last.shape:
            continue
        first = first + parts[k] * np.column_stack([turned(last - first)[:, 0], 0.0 * first[:, 0]])
        mine = impacts(point)
        mirrored = np.column_stack([mine[:, 0] + math.pi, -mine[:, 1]])
        total += min(apart(first, mine), apart(first, mirrored)) <= CHORD
    return total


def curves_listed_twice(found: BifurcationCurves) -> list[tuple[int, int]]:
    """Return the pairs of curves of which one lies on the other."""
    widths = np.array([high - low for low, high in found.within])
    return [
        (i + 1, j + 1)
        for (i, one), (j, other) in permutations(enumerate(found.curves), 2)
        if one.type is other.type and shared(one, other, widths) > SHARED
    ]


def points_listed_twice(found: BifurcationCurves) -> list[tuple[int, int]]:
    """Return the pairs of points of one type, with motions of one length, at one place."""
    points = [each.point for each in found.points]
    return [
        (i + 1, j + 1)
        for (i, one), (j, other) in permutations(enumerate(points), 2)
        if (one.type, one.period, one.impacts) == (other.type, other.period, other.impacts)
        and np.abs(one.chain.parameters - other.chain.parameters).max() < 1e-7
    ]
