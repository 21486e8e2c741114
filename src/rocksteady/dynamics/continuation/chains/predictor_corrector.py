"""Pseudo-arclength continuation of solution curves: N equations in N + 1 unknowns.

From a point and its tangent the next point is predicted along the tangent and corrected by Newton's
method in the plane across it (Keller 1977).  Where the curve turns back in one of its unknowns
nothing special happens.  This module has no physics: it works on arrays.

It is written here because nothing installable does it: PyDSTool no longer builds, pacopy is
proprietary, AUTO is no Python package.
"""

import math
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Generic, Protocol, TypeVar

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import acos

STEPS = 12
"""Most steps of Newton's method in a correction."""
CONVERGED = 1e-11
"""Length of a step after which the next is the last: it is quadratic."""
FAR = 0.5
"""A correction longer than this part of the prediction has gone elsewhere."""
STRAIGHT = 0.995
"""Cosine of the largest turn of the tangent between two points."""
CROSSING = 2e-4
"""Step up to which another orientation is believed: so near to each other curves do cross."""
SMALLEST_STEP = 1e-9
"""Below this length a curve counts as lost."""
DIFFERENCE = 1e-6
"""Step of the central differences of a condition's gradient: they set the speed of Newton's
method, not the place where it ends."""
ATTEMPTS = 200
"""Steps, corrected or not, over which a curve must advance by its largest one: else it stalls."""
LOCATED, RELATIVE = 1e-15, 1e-15
"""Part of a step, and of that part, to which an event is located: rounding."""
TRIALS = 500
"""Most trials for it; some ten are usual."""


class LostError(ArithmeticError):
    """A curve cannot be followed to an event on it."""


class StalledError(LostError):
    """The steps along a curve have become too short to get anywhere."""


class Solution(Protocol):
    """What the equations are at one place: evaluated once, asked often."""

    @property
    def errors(self) -> Floats:
        """Left-hand sides of the N equations."""

    @property
    def slopes(self) -> Floats:
        """Their derivatives by the scaled unknowns, shape (N, N + 1)."""


SolutionT = TypeVar("SolutionT", bound=Solution)
Test = Callable[[SolutionT], float]
"""A number that changes its sign at an event."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Spot(Generic[SolutionT]):
    """A point of a curve.

    Attributes
    ----------
    place
        Scaled unknowns, shape (N + 1,).
    tangent
        Unit vector along the curve.
    solution
        The equations there.
    arclength
        From the start of the curve.
    """

    place: Floats
    tangent: Floats
    solution: SolutionT
    arclength: float


@dataclass(frozen=True, kw_only=True)
class Curve(Generic[SolutionT]):
    """A set of equations, whose solutions are curves.

    Attributes
    ----------
    evaluate
        From scaled unknowns to the equations there; None outside their domain.
    largest_step
        Longest step in arclength.
    """

    evaluate: Callable[[Floats], SolutionT | None]
    largest_step: float

    def start(self, place: Floats, towards: Floats) -> Spot[SolutionT] | None:
        """Return the point of a curve near a place, its tangent pointing along a direction."""
        spot = self._corrected(place, towards / _length(towards))
        if spot is None:
            return None
        tangent = _tangent(spot[1].slopes, towards)
        if tangent is None:
            return None
        return Spot(place=spot[0], tangent=tangent, solution=spot[1], arclength=0.0)

    def along(self, spot: Spot[SolutionT], length: float) -> Spot[SolutionT] | None:
        """Return the point of the curve one step from another."""
        guess = spot.place + length * spot.tangent
        next_spot = self._corrected(guess, spot.tangent)
        if next_spot is None or _length(next_spot[0] - guess) > FAR * abs(length) + CONVERGED:
            return None
        tangent = _tangent(next_spot[1].slopes, spot.tangent)
        if tangent is None:
            return None
        return Spot(
            place=next_spot[0],
            tangent=tangent,
            solution=next_spot[1],
            arclength=spot.arclength + length,
        )

    def follow(self, spot: Spot[SolutionT]) -> Iterator[Spot[SolutionT]]:
        """Yield the points that come after one, until the curve is lost.

        Where two curves all but cross, a step straight ahead leads from one to the other.  Such a
        step is seen by the orientation, the sign of the determinant of the slopes and the tangent:
        it is the same all along a curve, except beyond a crossing.

        Raises
        ------
        StalledError
            If the last `ATTEMPTS` steps together are shorter than one largest step.
        """
        step = 0.1 * self.largest_step
        oriented = 0.0  # unknown: the equations may be singular at the start
        passed: deque[float] = deque(maxlen=ATTEMPTS)
        while step >= SMALLEST_STEP:
            if len(passed) == ATTEMPTS and spot.arclength - passed[0] < self.largest_step:
                raise StalledError
            passed.append(spot.arclength)
            new = self.along(spot, step)
            if new is None or float(new.tangent @ spot.tangent) < STRAIGHT:
                step *= 0.5
                continue
            direction = _orientation(new)
            if direction * oriented < 0.0 and step > CROSSING:
                step *= 0.5
                continue
            oriented = direction
            yield new
            turn = acos(min(1.0, float(new.tangent @ spot.tangent)))
            spot = new
            if turn < 0.3 * acos(STRAIGHT):
                step = min(1.6 * step, self.largest_step)

    def locate(
        self, before: Spot[SolutionT], after: Spot[SolutionT], test: "Test[SolutionT]"
    ) -> Spot[SolutionT]:
        """Return the event between two neighbouring points at which a test has opposite signs.

        Points between the two are corrected in planes across the chord.  Newton's method on the
        equations and the test together takes the gradient of a determinant by differences: forty
        times as long for an orbit of 256 impacts.

        Raises
        ------
        LostError
            If the curve is lost between them.
        """
        from scipy.optimize import brentq

        chord = after.place - before.place

        def between(share: float) -> Spot[SolutionT]:
            if share in (0.0, 1.0):
                return before if share == 0.0 else after
            spot = self.start(before.place + share * chord, chord)
            if spot is None:
                raise LostError
            arclength = before.arclength + share * (after.arclength - before.arclength)
            return replace(spot, arclength=arclength)

        def value(share: float) -> float:
            return test(between(share).solution)

        return between(brentq(value, 0.0, 1.0, xtol=LOCATED, rtol=RELATIVE, maxiter=TRIALS))

    def locate_near(
        self, spot: Spot[SolutionT], test: "Test[SolutionT]", reach: float
    ) -> Spot[SolutionT] | None:
        """Return the event nearest to a point, on either side of it, within an arclength or so."""
        if test(spot.solution) == 0.0:
            return spot
        ahead = 1e-8
        while ahead <= reach:
            for step in (ahead, -ahead):
                nearby = self.along(spot, step)
                if nearby is not None and test(nearby.solution) * test(spot.solution) <= 0.0:
                    return self.locate(spot, nearby, test)
            ahead *= 4.0
        return None

    def _corrected(self, guess: Floats, across: Floats) -> tuple[Floats, SolutionT] | None:
        """Return the solution in the plane through a guess and across a direction."""
        place, last = guess, False
        for _ in range(STEPS):
            solution = self.evaluate(place)
            if solution is None:
                return None
            if last:
                return place, solution
            matrix = np.vstack([solution.slopes, across])
            right = np.append(solution.errors, float(across @ (place - guess)))
            move = _solve(matrix, right)
            if move is None:
                return None
            place = place - move
            last = float(np.abs(move).max()) < CONVERGED
        return None


def gradient(function: Callable[[Floats], float], place: Floats) -> Floats:
    """Return the gradient of a function by central differences; nan where it is not defined."""
    slopes = np.empty(place.shape)
    for index in range(len(place)):
        shift = np.zeros(place.shape)
        shift[index] = DIFFERENCE
        slopes[index] = (function(place + shift) - function(place - shift)) / (2.0 * DIFFERENCE)
    return slopes


def _orientation(spot: Spot[SolutionT]) -> float:
    """Return the sign of the determinant of the slopes at a point and its tangent."""
    return float(np.linalg.slogdet(np.vstack([spot.solution.slopes, spot.tangent]))[0])


def _solve(matrix: Floats, right: Floats) -> Floats | None:
    """Return the solution of linear equations, None where it is not finite."""
    if not (np.isfinite(matrix).all() and np.isfinite(right).all()):
        return None
    try:
        solution = np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
    except np.linalg.LinAlgError:
        return None
    return solution if np.isfinite(solution).all() else None


def null_vector(matrix: Floats) -> Floats:
    """Return the right singular vector of a matrix's smallest singular value, of length 1.

    Its first component of at least half the greatest size is positive.  Without a rule, the last
    digits of a processor decide the sign, and with it to which side a branch starts.

    >>> null_vector(np.array([[1.0, 1.0]])).round(3).tolist()
    [0.707, -0.707]
    """
    direction: Floats = np.linalg.svd(matrix)[2][-1]
    sizes = np.abs(direction)
    first = int(np.argmax(sizes >= 0.5 * sizes.max()))
    return direction * math.copysign(1.0, direction[first])


def _tangent(slopes: Floats, towards: Floats) -> Floats | None:
    """Return the unit null vector of the slopes, on the side of a direction."""
    last = np.zeros(len(towards))
    last[-1] = 1.0
    tangent = _solve(np.vstack([slopes, towards]), last)
    if tangent is None:
        return None
    return tangent / _length(tangent)


def _length(vector: Floats) -> float:
    return math.sqrt(float(vector @ vector))
