"""Points of codimension two solved again in 50 digits, from the formulae of the theory pages alone.

An orbit is the phases of its impacts; its arcs have y = 0 at both ends (continuation.md).  Whether
it is at a fold or a flip is said here by the return map's derivative in closed form, a product of
flows and saltation matrices (orbits.md), and not by the determinant of a chain.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import mpmath as mp
import numpy as np

from rocksteady.branches import BranchPoint
from rocksteady.dynamics.continuation.chains.chain import Chain
from rocksteady.dynamics.continuation.curves._codimension_two import touching

DIGITS = 100
INDEPENDENT = 1e-3
"""Least singular value of the slopes of independent conditions."""
Numbers = Sequence[Any]


class Orbit:
    """An orbit, or half a symmetric one, in many digits.

    `phases` are absolute: the first impact sends the block to its positive side.
    """

    def __init__(self, phases: Numbers, half_cycles: int, parameters: Numbers) -> None:
        self.amplitude, self.frequency, self.restitution = parameters
        self.half_cycles, self.count = half_cycles, len(phases)
        self.phases = [*phases, phases[0] + half_cycles * mp.pi]
        self.beta = self.amplitude / (1 + self.frequency**2)

    def side(self, k: int) -> int:
        return 1 if k % 2 == 0 else -1

    def seen(self, k: int, phase: Any) -> Any:
        return phase if self.side(k) > 0 else phase + mp.pi

    def duration(self, k: int) -> Any:
        return (self.phases[k + 1] - self.phases[k]) / self.frequency

    def speeds(self, k: int) -> tuple[Any, Any]:
        """Return the speeds of take-off and landing of an arc."""
        first, last = (self.seen(k, self.phases[j]) for j in (k, k + 1))
        w, beta, time = self.frequency, self.beta, self.duration(k)
        f0, f1 = beta * mp.sin(first) - 1, beta * mp.sin(last) - 1
        bend = mp.tanh(time / 2)
        start = (f1 - f0) / mp.sinh(time) - f0 * bend - beta * w * mp.cos(first)
        landing = (f0 - f1) / mp.sinh(time) - f1 * bend + beta * w * mp.cos(last)
        return start, landing

    def errors(self) -> list[Any]:
        """Return what eq 9 asks for at each impact."""
        speeds = [self.speeds(k) for k in range(self.count)]
        return [speeds[k][0] - self.restitution * speeds[k - 1][1] for k in range(self.count)]

    def height(self, k: int, time: Any) -> tuple[Any, Any]:
        """Return y and y' in an arc, a time after its take-off."""
        first, last = (self.seen(k, self.phases[j]) for j in (k, k + 1))
        w, beta, whole = self.frequency, self.beta, self.duration(k)
        f0, f1 = beta * mp.sin(first) - 1, beta * mp.sin(last) - 1
        span = 1 - mp.exp(-2 * whole)
        growing = (f1 - f0 * mp.exp(-whole)) / span * mp.exp(time - whole)
        decaying = (f0 - f1 * mp.exp(-whole)) / span * mp.exp(-time)
        psi = first + w * time
        return (
            growing + decaying + 1 - beta * mp.sin(psi),
            growing - decaying - beta * w * mp.cos(psi),
        )

    def flow(self, time: Any) -> Any:
        return mp.matrix([[mp.cosh(time), mp.sinh(time)], [mp.sinh(time), mp.cosh(time)]])

    def saltation(self, k: int) -> Any:
        """Return the derivative of the impact that ends arc k, in angle and velocity."""
        kept, side = self.restitution, self.side(k)
        velocity = -side * self.speeds(k)[1]
        push = self.amplitude * mp.sin(self.phases[k + 1])
        before, after = push - side, push + side  # x'' = x - sigma + a, at x = 0
        return mp.matrix([[kept, 0], [(after - kept * before) / velocity, kept]])

    def turned(self, begin: int = 0, time: Any = 0) -> Any:
        """Return the derivative of the map from a moment in an arc to one chain later.

        Of half a symmetric orbit the block is seen from the other side then.
        """
        total = self.saltation(begin) * self.flow(self.duration(begin) - time)
        for j in range(begin + 1, begin + self.count):
            k = j % self.count
            total = self.saltation(k) * self.flow(self.duration(k)) * total
        # The last impact has led back into the arc in which it began.
        total = self.flow(time) * total
        return -total if self.half_cycles % 2 else total

    def multiplier(self, value: int) -> Any:
        """Return what vanishes where a multiplier of the chain is 1 or -1."""
        turned = self.turned()
        return 1 - value * (turned[0, 0] + turned[1, 1]) + self.restitution ** (2 * self.count)


def null_vector(rows: Callable[[Numbers], Numbers], phases: Numbers) -> list[Any]:
    """Return what the derivative of equations forgets, its largest component 1."""
    step = mp.mpf(10) ** -30
    count = len(phases)
    matrix = mp.matrix(count, count)
    for j in range(count):
        up, down = ([x + sign * step * (k == j) for k, x in enumerate(phases)] for sign in (1, -1))
        for k, (a, b) in enumerate(zip(rows(up), rows(down), strict=True)):
            matrix[k, j] = (a - b) / (2 * step)
    return forgotten(matrix)


def forgotten(matrix: Any) -> list[Any]:
    """Return the vector that a singular matrix sends to 0, its first component 1."""
    count = matrix.rows
    if count == 1:
        return [mp.mpf(1)]
    rest = mp.lu_solve(matrix[: count - 1, 1:], -matrix[: count - 1, 0])
    return [mp.mpf(1), *rest]


def bend_of_fold(orbit: Orbit, parameters: Numbers) -> Any:
    """Return the change of the fold's condition along what its equations forget: 0 at a cusp."""
    phases, halves = orbit.phases[:-1], orbit.half_cycles
    along = null_vector(lambda there: Orbit(there, halves, parameters).errors(), phases)
    step = mp.mpf(10) ** -28

    def fold(x: Any) -> Any:
        moved = [a + x * b for a, b in zip(phases, along, strict=True)]
        return Orbit(moved, halves, parameters).multiplier(1)

    return (fold(step) - fold(-step)) / (2 * step)


def cubic_of_flip(orbit: Orbit, parameters: Numbers) -> Any:
    """Return the cubic coefficient of the chain run through twice: 0 at a generalised flip."""
    phases, halves = orbit.phases[:-1], orbit.half_cycles
    count = len(phases)

    def twice(x: Any, y: Numbers, z: Any = 0) -> list[Any]:
        """Return the errors of both rounds, displaced by x (xi, -xi) + z (y, y)."""
        first = [a + x * b + z * c for a, b, c in zip(phases, along, y, strict=True)]
        other = [a - x * b + z * c for a, b, c in zip(phases, along, y, strict=True)]
        other = [a + halves * mp.pi for a in other]
        return Orbit([*first, *other], 2 * halves, parameters).errors()

    def reversed_(there: Numbers) -> list[Any]:
        """Return the first round's errors where the second is displaced the other way."""
        shifts = [a - b for a, b in zip(there, phases, strict=True)]
        other = [a - b + halves * mp.pi for a, b in zip(phases, shifts, strict=True)]
        return Orbit([*there, *other], 2 * halves, parameters).errors()[:count]

    along = null_vector(reversed_, phases)
    step = mp.mpf(10) ** -15
    zero = [mp.mpf(0)] * count
    up, here, down = twice(step, zero), twice(0, zero), twice(-step, zero)
    bent = [(a - 2 * b + c) / step**2 for a, b, c in zip(up, here, down, strict=True)][:count]
    plain, turned = mp.matrix(count, count), mp.matrix(count, count)
    tiny = mp.mpf(10) ** -30
    for j in range(count):
        for matrix, rows in (
            (plain, lambda there: Orbit(there, halves, parameters).errors()),
            (turned, reversed_),
        ):
            ends = [
                rows([x + sign * tiny * (k == j) for k, x in enumerate(phases)]) for sign in (1, -1)
            ]
            for k in range(count):
                matrix[k, j] = (ends[0][k] - ends[1][k]) / (2 * tiny)
    aside = list(mp.lu_solve(plain, -mp.matrix(bent) / 2))
    weight = forgotten(turned.T)

    def reduced(x: Any) -> Any:
        errors = twice(x, aside, x * x)[:count]
        return sum(a * b for a, b in zip(weight, errors, strict=True))

    def odd(x: Any) -> Any:
        return (reduced(x) - reduced(-x)) / 2

    return (odd(2 * step) - 2 * odd(step)) / (6 * step**3)


def solved(
    point: BranchPoint,
    parameters: tuple[int, int],
    conditions: Callable[[Orbit, Numbers, Numbers], Numbers],
    moments: Sequence[float] = (),
) -> list[float]:
    """Return the two parameters of a point, by Newton's method in 50 digits from beside it.

    Parameters
    ----------
    point
        As it was found; it is moved by 1e-6 first.
    parameters
        Indices of the two in (A, Omega, restitution).
    conditions
        Of an orbit, of further unknown moments, and of (A, Omega, restitution).
    moments
        Guesses of these.
    """
    chain = point.chain
    count = chain.impacts
    with mp.workdps(DIGITS):
        fixed = [mp.mpf(repr(each)) for each in chain.parameters.tolist()]
        begin = [mp.mpf(x) * mp.pi for x in chain.turns.tolist()]
        begin = [a + mp.mpf(x) for a, x in zip(begin, chain.phases.tolist(), strict=True)]
        begin += [mp.mpf(x) for x in moments] + [fixed[k] for k in parameters]
        begin = [x + mp.mpf("1e-6") * (-1) ** k for k, x in enumerate(begin)]

        def equations(*unknown: Any) -> list[Any]:
            values = list(fixed)
            for k, value in zip(parameters, unknown[-2:], strict=True):
                values[k] = value
            orbit = Orbit(unknown[:count], chain.half_cycles, values)
            return [*orbit.errors(), *conditions(orbit, unknown[count:-2], values)]

        found = mp.findroot(equations, begin, tol=mp.mpf(10) ** -100, maxsteps=30)
        rest = max(abs(each) for each in equations(*found))
        assert rest < mp.mpf(10) ** -48, rest
        assert independent(equations, found) > INDEPENDENT
        return [float(found[k]) for k in (-2, -1)]


def independent(equations: Callable[..., Numbers], place: Numbers) -> float:
    """Return the least singular value of the slopes, each row of length 1.

    It is 0 where one condition follows from the others, as where two touches are one touch.
    """
    step = mp.mpf(10) ** -30
    columns = []
    for k in range(len(place)):
        ends = [
            equations(*(x + sign * step * (j == k) for j, x in enumerate(place)))
            for sign in (1, -1)
        ]
        columns.append([float((a - b) / (2 * step)) for a, b in zip(*ends, strict=True)])
    slopes = np.array(columns).T
    slopes /= np.linalg.norm(slopes, axis=1, keepdims=True)
    return float(np.linalg.svd(slopes, compute_uv=False)[-1])


def solved_again(point: BranchPoint, parameters: tuple[int, int]) -> list[float]:
    """Return where a point of codimension two has both conditions of its type, in 50 digits."""
    point = replace(point, chain=touching(point.chain))
    moments = touches(point.chain)
    needed = {"double-graze": 2, "cusp": 0}.get(point.type, int(point.type.endswith("-graze")))
    assert len(moments) == needed, f"{point.type} with {len(moments)} touches"

    def conditions(orbit: Orbit, times: Numbers, values: Numbers) -> Numbers:
        rows = [row for row, _ in moments]
        heights = [
            each for row, time in zip(rows, times, strict=True) for each in orbit.height(row, time)
        ]
        if point.type == "double-graze":
            return heights
        if point.type == "resonant-graze":
            # A kick at the touch, which two impacts give, does not come back as a height.
            return [*heights, orbit.turned(rows[0], times[0])[0, 1]]
        if point.type == "cusp":
            return [orbit.multiplier(1), bend_of_fold(orbit, values)]
        multiplier = orbit.multiplier(1 if point.type == "fold-graze" else -1)
        return [*heights, multiplier] if heights else [multiplier, cubic_of_flip(orbit, values)]

    return solved(point, parameters, conditions, [when for _, when in moments])


def touches(chain: Chain) -> list[tuple[int, float]]:
    """Return the arcs that touch the base, and when."""
    return [
        (int(row), float(chain.shape[row, 2]))
        for row in np.flatnonzero(np.abs(chain.shape[:, 1]) < 1e-8)
    ]
