"""What acts on a facade: loads, masses, ties, thrusts, their ranges and moments."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, Final

from rocksteady.errors import InputError, ModelError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import Ends, in_range

METRES: Final = "sizes are in metres: write 0.3 for 300 mm"
KILONEWTONS: Final = "give it in kN, for the whole length of the facade"

BOUNDS: Final[Mapping[str, tuple[float, float, Ends, str]]] = {
    "thickness_m": (0.05, 5.0, "[]", METRES),
    "height_m": (0.1, 50.0, "[]", METRES),
    "length_m": (0.1, 200.0, "[]", METRES),
    "unit_weight_kn_m3": (8.0, 30.0, "[]", "give it in kN/m^3, as 18: 1800 kg/m^3 are 17.7"),
    "hinge_inset_m": (0.0, 5.0, "[]", METRES),
    "confidence_factor": (1.0, 2.0, "[]", "give 1.35, 1.2 or 1.0, for LC1, LC2 or LC3"),
    "weight_kn": (0.0, 1e6, "(]", KILONEWTONS),
    "force_kn": (0.0, 1e6, "(]", KILONEWTONS),
    "x_m": (-5.0, 10.0, "[]", f"give the distance inwards of the outer face; {METRES}"),
    "z_m": (0.0, 100.0, "(]", f"give the height above the hinge; {METRES}"),
    "lost_at_m": (0.0, 10.0, "(]", f"give the displacement d at which it ends; {METRES}"),
    "base_height_m": (0.0, 300.0, "[]", f"give the height of the hinge above ground; {METRES}"),
    "elastic_modulus_mpa": (10.0, 1e5, "[]", "give it in MPa, as 750"),
    "elastic_period_s": (0.001, 10.0, "[]", "give T0 in seconds, as 0.13"),
}
"""Lowest and highest number of each quantity, whether they belong to it, and what to do."""


@checked
@dataclass(frozen=True, kw_only=True)
class Load:
    """A weight on the facade that moves with it [kN].

    Parameters
    ----------
    name
        What it is, as "roof".
    weight_kn
        Weight on the whole length of the facade [kN].
    x_m
        Distance inwards from the outer face [m]; below 0 outside, as of a balcony.
    z_m
        Height above the hinge [m].
    until_collapse
        Whether it is verified to act up to collapse, so that d0 counts it; default None: where it
        lowers the rotation of zero moment it counts, else not.
    lost_at_m
        Displacement d at which it ends [m], in place of `until_collapse`; default None.

    Raises
    ------
    InputError
        If a number is outside its range.
    ModelError
        If it is verified up to collapse and ends before.
    """

    name: str
    weight_kn: float
    x_m: float
    z_m: float
    until_collapse: bool | None = None
    lost_at_m: float | None = None

    def __post_init__(self) -> None:
        """Validate."""
        check_numbers(self, "load", ("weight_kn", "x_m", "z_m"))
        _check_end(self)


@checked
@dataclass(frozen=True, kw_only=True)
class PushingMass:
    """A mass that pushes the facade in an earthquake but does not load it [kN].

    Parameters
    ----------
    name
        What it is, as "vault".
    weight_kn
        Its weight on the whole length of the facade [kN].
    z_m
        Height above the hinge at which it pushes [m].

    Raises
    ------
    InputError
        If a number is outside its range.
    """

    name: str
    weight_kn: float
    z_m: float

    def __post_init__(self) -> None:
        """Validate."""
        check_numbers(self, "mass", ("weight_kn", "z_m"))


@checked
@dataclass(frozen=True, kw_only=True)
class Tie:
    """A tie that pulls the facade inwards with a constant force [kN].

    Parameters
    ----------
    name
        What it is, as "tie rods of floor 1".
    force_kn
        Its strength on the whole length of the facade [kN]: the least of steel, anchor and wall.
    z_m
        Height above the hinge [m].
    until_collapse
        Whether it is verified to act up to collapse, so that d0 counts it; default None: not,
        it acts at rest alone.
    lost_at_m
        Displacement d at which it ends [m], in place of `until_collapse`; default None.

    Raises
    ------
    InputError
        If a number is outside its range.
    ModelError
        If it is verified up to collapse and ends before.
    """

    name: str
    force_kn: float
    z_m: float
    until_collapse: bool | None = None
    lost_at_m: float | None = None

    def __post_init__(self) -> None:
        """Validate."""
        check_numbers(self, "tie", ("force_kn", "z_m"))
        _check_end(self)


@checked
@dataclass(frozen=True, kw_only=True)
class Thrust:
    """A static outward thrust on the facade [kN], as of an arch or a roof.

    Parameters
    ----------
    name
        What it is, as "vault".
    force_kn
        Its force on the whole length of the facade [kN].
    z_m
        Height above the hinge [m].
    until_collapse
        Whether it is verified to act up to collapse; default None.  It counts in d0 either way,
        as it pushes.
    lost_at_m
        Displacement d at which it ends [m], in place of `until_collapse`; default None.

    Raises
    ------
    InputError
        If a number is outside its range.
    ModelError
        If it is verified up to collapse and ends before.
    """

    name: str
    force_kn: float
    z_m: float
    until_collapse: bool | None = None
    lost_at_m: float | None = None

    def __post_init__(self) -> None:
        """Validate."""
        check_numbers(self, "thrust", ("force_kn", "z_m"))
        _check_end(self)


def _check_end(action: Load | Tie | Thrust) -> None:
    """Validate until when an action acts."""
    if action.lost_at_m is None:
        return
    check_numbers(action, type(action).__name__.lower(), ("lost_at_m",))
    if action.until_collapse:
        raise ModelError(
            f"lost_at_m of {action.name}",
            action.lost_at_m,
            "what acts up to collapse does not end before",
            "leave lost_at_m or until_collapse out",
        )


def check_numbers(thing: Any, kind: str, keys: tuple[str, ...]) -> None:
    """Validate the name and the numbers of a thing, and keep them as floats."""
    name: object = thing.name
    if not isinstance(name, str) or not name.strip() or not name.isprintable():
        # Others break lines, move the cursor of a terminal or turn the text around.
        valid = "it must be a text of printable characters in one line"
        raise InputError("name", name, valid, "give a name, as 'roof'")
    place = f" of {kind} {thing.name}" if kind else ""
    for key in keys:
        low, high, ends, hint = BOUNDS[key]
        value = in_range(f"{key}{place}", getattr(thing, key), low, high, ends, hint=hint)
        object.__setattr__(thing, key, value)


@dataclass(frozen=True, kw_only=True)
class Moments:
    """Weights, forces and their moments about the hinge, of one action or of several.

    Attributes
    ----------
    weight_kn, weight_lever_kn_m, weight_moment_kn_m
        Weights P, weights times distances inwards, weights times heights.
    held_kn_m
        Moment of ties less that of thrusts.
    push_kn, push_moment_kn_m, second_moment_kn_m2
        Weights and pushing masses P + Q, and their first and second moments over the height.
    lumped_moment_kn_m2
        Second moment with the mass of each body at its centre.
    inertia_kn_m2
        Moment of inertia times gravity; of pushing masses z^2 alone.
    """

    weight_kn: float = 0.0
    weight_lever_kn_m: float = 0.0
    weight_moment_kn_m: float = 0.0
    held_kn_m: float = 0.0
    push_kn: float = 0.0
    push_moment_kn_m: float = 0.0
    second_moment_kn_m2: float = 0.0
    lumped_moment_kn_m2: float = 0.0
    inertia_kn_m2: float = 0.0

    @property
    def stabilising_kn_m(self) -> float:
        """Moment about the hinge that holds the facade."""
        return self.weight_lever_kn_m + self.held_kn_m

    @property
    def slope(self) -> float:
        """Tangent of the rotation at which the moment is zero; infinite of a horizontal force."""
        if self.weight_moment_kn_m == 0.0:
            return math.copysign(math.inf, self.held_kn_m)
        return self.stabilising_kn_m / self.weight_moment_kn_m

    @classmethod
    def of_weight(cls, weight_kn: float, x_m: float, z_m: float) -> "Moments":
        """Return the moments of a weight at a distance inwards of the hinge and a height."""
        moment = weight_kn * z_m
        second = moment * z_m
        return cls(
            weight_kn=weight_kn,
            weight_lever_kn_m=weight_kn * x_m,
            weight_moment_kn_m=moment,
            push_kn=weight_kn,
            push_moment_kn_m=moment,
            second_moment_kn_m2=second,
            lumped_moment_kn_m2=second,
            inertia_kn_m2=second + weight_kn * x_m * x_m,
        )

    @classmethod
    def of_mass(cls, weight_kn: float, z_m: float) -> "Moments":
        """Return the moments of a mass that pushes and does not weigh on the facade."""
        moment = weight_kn * z_m
        second = moment * z_m
        return cls(
            push_kn=weight_kn,
            push_moment_kn_m=moment,
            second_moment_kn_m2=second,
            lumped_moment_kn_m2=second,
            inertia_kn_m2=second,
        )

    @classmethod
    def of_force(cls, force_kn: float, z_m: float) -> "Moments":
        """Return the moment of a horizontal force, positive inwards."""
        return cls(held_kn_m=force_kn * z_m)

    @classmethod
    def total(cls, parts: Iterable["Moments"]) -> "Moments":
        """Return the sum of moments."""
        each = list(parts)
        names = [field.name for field in fields(cls)]
        return cls(**{name: math.fsum(getattr(part, name) for part in each) for name in names})


def unfavourable(base: Sequence[Moments], options: Iterable[Moments]) -> list[Moments]:
    """Return the options that, added to a base, make its rotation of zero moment smallest.

    An action lowers M/K where its own ratio is smaller.  In ascending order of their ratios, the
    options are taken until one is larger than that of all before.
    """
    taken: list[Moments] = []
    for option in sorted(options, key=lambda each: each.slope):
        if option.slope >= Moments.total([*base, *taken]).slope:
            break
        taken.append(option)
    return taken
