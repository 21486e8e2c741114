"""Rules of single numbers, as they stand in the annotation of a field or of an argument.

``restitution: Annotated[float, RESTITUTION]`` in a signature under
`rocksteady.model.checks.arguments.checked` refuses other values, after the types of all arguments
and in their order, and passes on a plain number.  A default passes as it is: write 1.0 and not 1.
None passes where the type has it.

A rule is any function of an argument's name and its value that returns the value to keep, as
``partial(positive, hint="give the mass in kg")``.  A range that differs from another one on
purpose has a name or a place of its own.
"""

import math
from collections.abc import Callable
from typing import Any, Final, NamedTuple

from rocksteady.errors import InputError
from rocksteady.model.checks.validation import Ends, in_range, whole_number


class Bounds(NamedTuple):
    """An interval of real numbers, and what to do about others: the rule of `in_range`."""

    low: float
    high: float
    ends: Ends
    hint: str

    def __call__(self, name: str, value: object) -> float:
        """Return a number of the interval as a float."""
        return in_range(name, value, self.low, self.high, self.ends, hint=self.hint)


class Whole(NamedTuple):
    """Whole numbers from one to another, without an end if that is None: `whole_number`."""

    low: int
    high: int | None
    hint: str

    def __call__(self, name: str, value: object) -> int:
        """Return such a number as an int."""
        return whole_number(name, value, at_least=self.low, at_most=self.high, hint=self.hint)


LARGEST_SEED: Final = 2**64 - 1

INSIDE: Final = "checked inside"
"""Label of an argument whose type the function itself checks, in better words than these."""

Rule = Bounds | Whole | Callable[[str, Any], Any]


def nonempty_text(name: str, value: object) -> str:
    """Return a name, which is a text and not empty: the rule of an argument."""
    if not isinstance(value, str) or not value.strip():
        raise InputError(name, value, "it must be a text that is not empty", "give a name")
    return value


def length(hint: str) -> Bounds:
    """Return the rule of a length, whose square and inverse square are numbers too."""
    return Bounds(1e-50, 1e50, "[]", hint)


ALPHA: Final = Bounds(
    0.0,
    0.5 * math.pi,
    "()",
    "give the angle in radians at which the mass centre stands above the pivot",
)
GYRATION: Final = length("give sqrt(I_c/M) in metres")
RADIUS: Final = length("give the distance from pivot to mass centre in metres")
P: Final = Bounds(1e-6, 1e6, "[]", "give the frequency parameter sqrt(M g R / I_0) in rad/s")
GRAVITY: Final = Bounds(1e-50, 1e50, "[]", "give the acceleration of gravity in m/s^2")
MASS: Final = Bounds(0.0, 1e9, "(]", "give the mass in kg")
RESTITUTION: Final = Bounds(
    0.0,
    1.0,
    "(]",
    "give the ratio of the angular velocities after and before an impact; a ratio of energies "
    "r is its square, so take sqrt(r)",
)
"""Of impacts on the base."""
FRICTION: Final = Bounds(0.0, 100.0, "[]", "give the coefficient of friction, as 0.4")
WALL_RESTITUTION: Final = Bounds(
    0.0,
    1.0,
    "[]",
    "give the ratio of the angular velocities after and before the impact on the wall",
)
"""0 of a wall off which a block does not rebound."""


def restitution_of_wall(name: str, value: object) -> float:
    """Return the restitution of a wall; the sum makes 0 of -0, which tables would hold."""
    return WALL_RESTITUTION(name, value) + 0.0
