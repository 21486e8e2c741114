"""Equations of a chain's orbits over one or two parameters, whose solutions form a curve."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.chains.chain import Chain
from rocksteady.dynamics.continuation.chains.predictor_corrector import gradient
from rocksteady.dynamics.parameters import PARAMETERS, range_of
from rocksteady.errors import InputError, ModelError
from rocksteady.model.checks.validation import (
    LARGEST,
    Ends,
    in_range,
    side_value,
    whole_number,
)
from rocksteady.model.motions.segments import HIGHEST_FREQUENCY_RATIO, LOWEST_FREQUENCY_RATIO

LIMITS: tuple[tuple[float, float, Ends], ...] = (
    (0.0, LARGEST, "[]"),
    (LOWEST_FREQUENCY_RATIO, HIGHEST_FREQUENCY_RATIO, "[]"),
    (0.0, 1.0, "(]"),
)
"""Ends of the ranges in which orbits are followed, and whether they belong to them."""
OUTSIDE = 0.05
"""Part of its range by which a parameter may be beyond it while a point is looked for."""
LARGEST_STEP = 0.02
"""Of arclength: the parameters' parts of their ranges together with the mean phase over pi."""
MOST_POINTS = 100_000

Test = Callable[[Chain], float]
"""A number that changes its sign at an event."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ChainSolution:
    """A chain as the solution of equations, in scaled unknowns."""

    place: Floats
    chain: Chain
    errors: Floats
    slopes: Floats

    @cached_property
    def flip(self) -> float:
        """What vanishes where a multiplier of the chain is -1."""
        return self.chain.determinant(-1.0)

    @cached_property
    def fold(self) -> float:
        """What vanishes where a multiplier of the chain is 1."""
        return self.chain.determinant(1.0)


@dataclass(frozen=True, kw_only=True, eq=False)
class Family:
    """The chains of one shape over some of the parameters.

    The unknowns are the phases over pi and the square root of their number, so that a mean phase
    counts, and each active parameter over the width of its range.

    Attributes
    ----------
    chain
        One of them.
    active
        Indices of the parameters that may move.
    ranges
        Lower and upper end of each, shape (k, 2).
    conditions
        Tests that vanish all along the curve: one for a curve in two parameters, none for one.
    """

    chain: Chain
    active: tuple[int, ...]
    ranges: Floats
    conditions: tuple[Test, ...] = ()

    @property
    def phase_scale(self) -> float:
        """Phase [rad] of a scaled unknown of 1."""
        return math.pi * math.sqrt(self.chain.impacts)

    @property
    def widths(self) -> Floats:
        """Width of each parameter's range."""
        return self.ranges[:, 1] - self.ranges[:, 0]

    def place_of(self, chain: Chain) -> Floats:
        """Return the scaled unknowns of a chain."""
        parameters = chain.parameters[list(self.active)]
        return np.concatenate([chain.phases / self.phase_scale, parameters / self.widths])

    def chain_at(self, place: Floats) -> Chain | None:
        """Return the chain at a place, None where it has no meaning."""
        count = self.chain.impacts
        moving = place[count:] * self.widths
        room = OUTSIDE * self.widths
        if (moving < self.ranges[:, 0] - room).any() or (moving > self.ranges[:, 1] + room).any():
            return None
        parameters = self.chain.parameters.copy()
        parameters[list(self.active)] = moving
        if not (parameters[1:] > 0.0).all():
            return None
        return self.chain.moved(place[:count] * self.phase_scale, parameters)

    def evaluate(self, place: Floats) -> ChainSolution | None:
        """Return the equations at a place; None outside their domain, or where no arc is found."""
        chain = self.chain_at(place)
        if chain is None or not np.isfinite(chain.errors).all():
            return None
        errors, slopes = chain.errors, chain.jacobian(self.active)
        slopes = slopes * np.concatenate([np.full(chain.impacts, self.phase_scale), self.widths])
        for condition in self.conditions:

            def value(parameters: Floats, condition: Test = condition) -> float:
                moved = self.chain_at(parameters)
                return math.nan if moved is None else condition(moved)

            errors = np.append(errors, condition(chain))
            slopes = np.vstack([slopes, gradient(value, place)])
        return ChainSolution(place=place, chain=chain, errors=errors, slopes=slopes)


def checked_ranges(
    chain: Chain, parameters: Sequence[object], within: Sequence[object]
) -> tuple[tuple[int, ...], Floats]:
    """Return the indices of parameters to follow a chain in, and their ranges, shape (k, 2).

    Raises
    ------
    InputError
        If a parameter has no such name, or a range is none, or does not hold the chain's own value.
    ModelError
        If it is the restitution of a block whose two impacts have different ones.
    """
    active, ranges = [], []
    for name, ends in zip(parameters, within, strict=True):
        if name not in PARAMETERS:
            raise InputError(
                "parameter",
                name,
                "orbits are followed in " + ", ".join(PARAMETERS),
                "name one of them",
            )
        index = PARAMETERS.index(str(name))
        kept = chain.sides[:, 0]
        if name == "restitution" and kept[0] != kept[1]:
            raise ModelError(
                "parameter",
                name,
                f"that of the block's two impacts differs, {kept[0]:.12g} and {kept[1]:.12g}",
                "follow it over another parameter, or give the block one restitution",
            )
        low, high = _checked_range(index, ends)
        fastest = max((order for order, _, _ in chain.harmonics), default=1)
        if name == "frequency_ratio" and high * fastest > HIGHEST_FREQUENCY_RATIO:
            raise InputError(
                "within",
                ends,
                f"its order {fastest} may be at most {HIGHEST_FREQUENCY_RATIO:g} p fast",
                "lower the upper end",
            )
        value = float(chain.parameters[index])
        if not low <= value <= high:
            raise InputError(
                "within",
                ends,
                f"it must hold the {name} of the start, {value:.12g}",
                "widen it, or start elsewhere",
            )
        active.append(index)
        ranges.append((low, high))
    return tuple(active), np.array(ranges)


def _checked_range(index: int, ends: object) -> tuple[float, float]:
    name = PARAMETERS[index]
    least, most, interval = LIMITS[index]
    hint = f"give two values of {name}, the lower one first"
    low, high = range_of(ends, name)
    for end in (low, high):
        in_range(name, end, least, most, interval, hint=hint)
    return low, high


@dataclass(frozen=True, kw_only=True)
class Course:
    """How a branch or a curve is followed.

    Parameters
    ----------
    direction
        +1 or -1.
    largest_step
        Largest step of arclength.
    most_points
        After which it ends.

    Raises
    ------
    InputError
        If a value is outside its range.
    """

    direction: int
    largest_step: float
    most_points: int

    def __post_init__(self) -> None:
        """Validate."""
        side_value("direction", self.direction)
        step, most = self.largest_step, self.most_points
        in_range("largest_step", step, 0.0, 0.2, "(]", hint="give 0.02, or less")
        whole_number(
            "most_points", most, at_least=1, at_most=MOST_POINTS, hint="give a number of points"
        )
