"""Points of codimension two by shooting with DOP853, its solutions truncated power series.

Unknowns are the phase of the first impact, the speed after each one, the duration of each flight,
both parameters and at a graze the time of the touch.  Where a coefficient of a normal form has to
vanish the motion is flown as a series in a displacement: the third derivative of the return map is
then as exact as the map.
"""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import root, root_scalar

from rocksteady import Block
from rocksteady.branches import BranchPoint
from tests.dynamics.shooting import PARAMETERS, Rocking

Floats = NDArray[np.float64]

TERMS = 4
"""Of a series: up to the third power."""


def times(one: Floats, other: Floats) -> Floats:
    return np.convolve(one, other)[:TERMS]


def over(one: Floats, other: Floats) -> Floats:
    found = np.zeros(TERMS)
    for k in range(TERMS):
        found[k] = (one[k] - found[:k] @ other[k:0:-1]) / other[0]
    return found


def sine_and_cosine(x: Floats) -> tuple[Floats, Floats]:
    sine, cosine = np.zeros(TERMS), np.zeros(TERMS)
    sine[0], cosine[0] = math.sin(x[0]), math.cos(x[0])
    for k in range(1, TERMS):
        weights = np.arange(1, k + 1) * x[1 : k + 1] / k
        sine[k], cosine[k] = weights @ cosine[k - 1 :: -1], -weights @ sine[k - 1 :: -1]
    return sine, cosine


def flown(
    block: Rocking, side: int, values: Floats, phase: Floats, speed: Floats, duration: float
) -> tuple[Floats, Floats]:
    """Return phase and speed after the next impact, about a duration later, as series."""
    row = 0 if side > 0 else 1
    alpha, rate, unit = block.alpha[row], block.rate[row], block.alpha[0]
    amplitude, frequency = values[0], values[1]
    rises, lasts = speed, np.zeros(TERMS)
    lasts[0] = duration
    for _ in range(3):  # each step of Newton's method doubles the powers that are right

        def slopes(part: float, y: Floats, lasts: Floats = lasts) -> Floats:
            angle, rises = y[:TERMS], y[TERMS:]
            sine, cosine = sine_and_cosine(np.eye(TERMS)[0] * alpha - unit * angle)
            base = side * amplitude * unit * sine_and_cosine(phase + frequency * part * lasts)[0]
            bend = rate**2 * (times(base, cosine) - sine) / unit
            return np.concatenate([times(lasts, rises), times(lasts, bend)])

        begin = np.concatenate([np.zeros(TERMS), speed])
        run = solve_ivp(slopes, (0.0, 1.0), begin, method="DOP853", rtol=1e-13, atol=1e-15)
        angle, rises = run.y[:TERMS, -1], run.y[TERMS:, -1]
        lasts = lasts - over(angle, rises)
    # The last move of the end is of the rounding's size, but for the powers it has just set right.
    return phase + frequency * lasts, -block.kept[row] * rises


def around(block: Rocking, values: Floats, state: Floats, durations: Floats) -> Floats:
    """Return phase and speed after all flights, shape (2, TERMS), from a series of them."""
    phase, speed = state
    for k, duration in enumerate(durations):
        side = 1 if k % 2 == 0 else -1
        phase, speed = flown(block, side, values, phase, speed, float(duration))
    return np.array([phase, speed])


def degeneracy(
    block: Rocking, values: Floats, start: Floats, durations: Floats, multiplier: float
) -> float:
    """Return the normal form's coefficient at a fold (1) or a flip (-1) of the return map."""

    def image(*powers: Floats) -> Floats:
        state = np.zeros((2, TERMS))
        state[:, 0] = start
        for k, power in enumerate(powers, start=1):
            state[:, k] = power
        return around(block, values, state, durations)

    one, two = np.eye(2)
    matrix = np.array([image(one)[:, 1], image(two)[:, 1]]).T
    left, _, right = np.linalg.svd(matrix - multiplier * np.eye(2))
    along, across = right[-1], left[:, -1]
    across = across / (across @ along)
    second = image(along)[:, 2]
    if multiplier == 1.0:
        return float(across @ second)
    aside = np.linalg.solve(np.eye(2) - matrix, second)
    return float(across @ image(along, aside)[:, 3])


def solved_twice(
    point: BranchPoint, parameters: tuple[str, str], multiplier: float, *, touches: bool
) -> list[float]:
    """Return where both parameters are at a point of codimension two near another.

    Parameters
    ----------
    point
        Beside which the search begins: no two of its impacts merge.
    parameters
        That move.
    multiplier
        Of the chain there.
    touches
        Whether the motion touches the base; else the coefficient of the normal form vanishes.
    """
    chain = point.chain
    assert isinstance(point.block, Block)
    moving = [PARAMETERS.index(name) for name in parameters]
    block, count = Rocking.of(point.block), chain.impacts
    assert count % 2 == 0
    turn, values = chain.half_cycles * math.pi, chain.parameters.copy()
    row = int(np.nanargmin(chain.shape[:, 1])) if touches else -1
    phase = float(chain.phases[0] + chain.turns[0] * math.pi)
    guess = [phase, *chain.table[:, 0], *chain.durations, *values[moving]]
    guess += [float(chain.shape[row, 2])] if touches else []
    places = slice(2 * count + 1, 2 * count + 3)

    # What is given while the other unknowns are solved for, where no coefficient is wanted: along
    # a fold the duration that changes most, as neither parameter grows at a cusp; along a flip the
    # second parameter.
    along_fold = np.abs(np.roll(chain.null_direction(1.0), -1) - chain.null_direction(1.0))
    given = places.stop - 1 if multiplier == -1.0 else count + 1 + int(np.argmax(along_fold))

    def errors(unknown: Floats) -> Floats:
        here = values.copy()
        here[moving] = unknown[places]
        speeds, durations = unknown[1 : count + 1], unknown[count + 1 : 2 * count + 1]
        missed, total = block.around(here, unknown[0], speeds, durations)
        missed.append(float(here[1] * durations.sum() - turn))
        determinant = float(np.linalg.det(total))
        missed.append(multiplier**2 - multiplier * float(np.trace(total)) + determinant)
        if touches:
            first = unknown[0] + here[1] * float(durations[:row].sum())
            side = 1 if row % 2 == 0 else -1
            flight = (speeds[row], unknown[-1])
            end, _ = block.moved(float(here[2])).fly(side, here, first, *flight)
            missed += [float(end[0]), float(end[1])]
        return np.array(missed)

    def solution(function: Callable[[Floats], Floats], begin: Floats) -> Floats:
        aside = 1e-5 * np.cos(np.arange(len(begin)))  # not where it should end
        found = root(function, begin + aside, method="hybr", options={"xtol": 1e-14})
        # Errors are as large as the Jacobian makes a rounding of the unknowns: the step counts.
        triangle = np.zeros((len(begin), len(begin)))
        triangle[np.triu_indices(len(begin))] = found.r
        step = np.linalg.solve(found.fjac.T @ triangle, function(found.x))
        assert np.abs(step).max() < 1e-10, found
        return np.asarray(found.x)

    if touches:
        return [float(value) for value in solution(errors, np.array(guess))[places]]

    def along(value: float) -> Floats:
        begin = np.delete(np.array(guess), given)
        return np.insert(
            solution(lambda part: errors(np.insert(part, given, value)), begin), given, value
        )

    def coefficient(value: float) -> float:
        there = along(value)
        here = values.copy()
        here[moving] = there[places]
        start, durations = there[:2], there[count + 1 : 2 * count + 1]
        return degeneracy(block.moved(float(here[2])), here, start, durations, multiplier)

    near = guess[given]
    found = root_scalar(coefficient, x0=near + 2e-5, x1=near - 1e-5, method="secant", xtol=1e-12)
    assert found.converged
    return [float(value) for value in along(found.root)[places]]
