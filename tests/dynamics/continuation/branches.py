"""Branches that several tests follow, and where bifurcations are by the return map alone."""

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import root

from rocksteady import DimensionlessBlock, Harmonic, find_orbits
from rocksteady.branches import BranchPoint, PointType, follow_branch
from rocksteady.histories import ImpactState
from rocksteady.orbits import Orbit, ReturnMap

Floats = NDArray[np.float64]

PARAMETERS = ("amplitude", "frequency_ratio", "restitution")
RANGES = {"amplitude": (0.05, 8.0), "frequency_ratio": (0.3, 12.0), "restitution": (0.05, 0.999)}
Event = tuple[str, float, int]


def values_of(point: BranchPoint) -> Floats:
    return np.array([getattr(point, name) for name in PARAMETERS])


def setting(values: Iterable[float]) -> tuple[DimensionlessBlock, Harmonic]:
    amplitude, frequency, restitution = map(float, values)
    return (
        DimensionlessBlock(restitution=restitution),
        Harmonic(amplitude=amplitude, frequency_ratio=frequency),
    )


def symmetric_start(
    amplitude: float, frequency: float, restitution: float, *, order: int = 1, branch: int = 1
) -> Orbit:
    """Return a symmetric orbit with two impacts, in closed form."""
    found = find_orbits(
        *setting((amplitude, frequency, restitution)), max_period=order, max_impacts=1, seeds=1
    )
    (orbit,) = (each for each in found if each.period == order and each.branch == branch)
    return orbit


def random_start(rng: np.random.Generator) -> Orbit | None:
    """Return an orbit of a random shaken block, or None where none was found."""
    values = rng.uniform(0.3, 5.0), rng.uniform(1.0, 8.0), rng.uniform(0.3, 0.95)
    longest = int(rng.choice([1, 3, 5]))
    found = find_orbits(*setting(values), max_period=longest, max_impacts=4, seeds=16)
    fit = [each for each in found if each.admissible and not each.rest_phases]
    return fit[rng.integers(len(fit))] if fit else None


def special(points: Iterable[BranchPoint]) -> list[BranchPoint]:
    return [point for point in points if point.type is not PointType.REGULAR]


def first(points: Iterable[BranchPoint], kind: str) -> BranchPoint:
    return next(point for point in points if point.type == kind)


def events(points: Iterable[BranchPoint], parameter: str) -> list[Event]:
    """Return type, place and number of impacts of what is special on a branch."""
    return [
        (point.type.value, getattr(point, parameter), point.chain.impacts)
        for point in special(points)
    ]


def same_events(one: list[Event], other: list[Event], *, within: float) -> bool:
    """Return whether two branches have the same events, as far as both were followed."""
    if "limit" in (one[-1][0], other[-1][0]):
        both = min(len(one), len(other)) - 1
        one, other = one[:both], other[:both]
    return len(one) == len(other) and all(
        a[0] == b[0] and a[2] == b[2] and abs(a[1] - b[1]) <= within
        for a, b in zip(one, other, strict=True)
    )


def unsymmetric_branch() -> list[BranchPoint]:
    """Return the branch of harmonic orbits that lean, A = 2, restitution 0.8."""
    branch = follow_branch(
        symmetric_start(2.0, 2.0, 0.8), "frequency_ratio", (1.6, 2.1), direction=-1
    )
    breaking = first(branch, "symmetry-breaking")
    return list(follow_branch(breaking, "frequency_ratio", (1.6, 2.1), switch=True))


def closed_error(values: Floats, state: Floats, steps: int, turn: float) -> tuple[Floats, Floats]:
    """Return by what a state fails to come back after some steps of the map, and the derivative.

    `turn` is the phase [rad] after which it should; after an odd number of steps on the other side.
    """
    begin = ImpactState(side=1, phase=float(state[0]), speed=float(state[1]))
    passage = ReturnMap(*setting(values))(begin, steps)
    assert passage.state is not None
    error = [passage.phase - turn, passage.state.speed - begin.speed]
    return np.array(error), passage.jacobian


def located(point: BranchPoint, parameter: str, multiplier: float) -> float:
    """Return where an orbit near a point has a multiplier: phase, speed and parameter as unknowns.

    By the return map and its saltation matrices alone; half of a symmetric orbit counts.
    """
    chain, index = point.chain, PARAMETERS.index(parameter)
    turn, steps = chain.half_cycles * math.pi, chain.impacts
    values = values_of(point)
    begin = chain.sections[0]
    guess = [(begin.half_cycles % 2) * math.pi + begin.phase, begin.speed, values[index]]

    def errors(unknown: Floats) -> Floats:
        here = values.copy()
        here[index] = unknown[2]
        error, jacobian = closed_error(here, unknown[:2], steps, turn)
        # The characteristic polynomial, with the exact determinant.
        test = multiplier**2 - multiplier * np.trace(jacobian) + here[2] ** (2 * steps)
        return np.append(error, test)

    shaken = np.array(guess) + np.array([1e-6, -1e-6, 1e-6])  # not where it should end
    found = root(errors, shaken, method="hybr", options={"xtol": 1e-15})
    assert np.abs(errors(found.x)).max() < 1e-9, found
    return float(found.x[2])


def least_height(point: BranchPoint) -> float:
    """Return the least height of all flights away from their ends, sampled in long double."""
    chain = point.chain
    amplitude, frequency, _ = chain.parameters
    w = np.longdouble(frequency)
    beta = np.longdouble(amplitude) / (1 + w * w)
    least = math.inf
    for k in range(chain.impacts):
        time = np.longdouble(chain.durations[k])
        if not time > 0.0:
            return -math.inf
        turned = int(chain.turns[k] % 2 + k % 2)
        psi = np.longdouble(chain.phases[k]) + turned * np.longdouble(math.pi)
        t = np.linspace(0.0, 1.0, 3001).astype(np.longdouble) * time
        left, right = beta * np.sin(psi) - 1, beta * np.sin(psi + w * time) - 1
        y = (right * np.sinh(t) + left * np.sinh(time - t)) / np.sinh(time)
        y += 1 - beta * np.sin(psi + w * t)
        least = min(least, float(y[20:-20].min()))
    return least
