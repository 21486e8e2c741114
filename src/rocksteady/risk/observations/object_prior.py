"""What is known of an object before the tests: sizes, base, restitution, each with its spread."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Annotated, Final

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import checked_array, real_array
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.kernels.elementary.arrays import atan2, hypot
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds, nonempty_text
from rocksteady.results.result import Result
from rocksteady.risk.observations._sides import (
    LOWEST_RESTITUTION,
    blocks_of_sides,
    least_momentum_ratio,
    sides_of_numbers,
)
from rocksteady.risk.observations.spread import PriorRange, spread_of

LARGEST_M: Final = 20.0
"""Longest size [m]: larger ones are taken for millimetres or centimetres."""

_METRES = "sizes are in metres: write 0.6 for 600 mm"

BOUNDS: Final[Mapping[str, tuple[float, float, str]]] = {
    "width_m": (1e-3, LARGEST_M, _METRES),
    "height_m": (1e-3, LARGEST_M, _METRES),
    "alpha_rad": (1e-3, 1.5, "give the angle in radians: 1 degree is 0.01745"),
    "p_rad_s": (0.3, 100.0, "give the frequency parameter sqrt(M g R / I_0) in rad/s"),
    "left_m": (1e-4, LARGEST_M, _METRES),
    "right_m": (1e-4, LARGEST_M, _METRES),
    "mass_centre_height_m": (1e-3, LARGEST_M, _METRES),
    "gyration_m": (1e-4, LARGEST_M, "give the radius of gyration about the mass centre in metres"),
    "base": (0.01, 1.5, "give the width of the base that rocks over that of the outline"),
    "offset": (-0.95, 0.95, "give the distance of the mass centre from the middle over half base"),
    "restitution": (LOWEST_RESTITUTION, 1.0, "give a ratio of angular velocities"),
    "housner_factor": (0.1, 2.0, "give a factor on the value of angular momentum, as 0.95"),
    "scatter": (0.0, 0.5, "give a standard deviation of the restitution, as 0.05"),
    "orientation_rad": (-1.58, 1.58, "give the angle from the first channel in radians"),
}  # fmt: skip
"""Lowest and highest of each number, and what to do; in the order of the parameters."""


def possible(key: str, value: PriorRange | float | str) -> PriorRange:
    """Return the spread of a number inside what is possible.

    Raises
    ------
    InputError
        If it is not possible.
    """
    low, high, hint = BOUNDS[key]
    return spread_of(key, value).within(key, low, high, hint=hint)


Given = Annotated[PriorRange | float | str | None, possible]
"""What a caller says of a number."""

DEFAULTS: Final[Mapping[str, PriorRange]] = {
    "base": PriorRange.around(0.75, 0.2, low=0.05, high=1.0),
    "offset": PriorRange.exactly(0.0),
    "housner_factor": PriorRange.between(0.85, 1.1),
    "scatter": PriorRange.between(0.0, 0.1),
}
"""Of what nothing is known."""

_FORMS: Final[Mapping[tuple[str, ...], tuple[str, ...]]] = {
    ("width_m", "height_m"): ("mass_centre_height_m", "gyration_m", "base", "offset"),
    ("alpha_rad", "p_rad_s"): (),
    ("left_m", "right_m", "mass_centre_height_m"): ("gyration_m",),
}
"""Ways to give a size, and what may stand beside each."""
_ALWAYS: Final = ("restitution", "housner_factor", "scatter", "orientation_rad")
_WAYS: Final = "; ".join(" and ".join(form) for form in _FORMS)


@checked
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class ObjectPrior(Result):
    """Prior of an object: size, base, restitution and scatter.

    A number, a text as ``"0.3:0.5"`` (uniform) or ``"0.4+-0.05"`` (normal, cut off at what is
    possible), or a `PriorRange`.  The size is given in one of three ways: the outline, angle and
    frequency parameter, or the edges.  All numbers are independent of each other.

    Parameters
    ----------
    name
        Name of the object.
    width_m, height_m
        Full width and height of the outline [m].
    alpha_rad, p_rad_s
        Slenderness [rad] and frequency parameter [rad/s] of a homogeneous rectangle.
    left_m, right_m
        Distances from the edges to the mass centre [m], with `mass_centre_height_m`.
    mass_centre_height_m
        Height of the mass centre [m]; default half of `height_m`.
    gyration_m
        Radius of gyration about the mass centre [m]; default that of the rectangle of the outline,
        ``sqrt((width^2 + height^2)/12)``.
    base
        Width of the base that rocks over that of the outline; default normal, 0.75 +- 0.2 up to
        1: published bases of natural stones.  It goes with an outline alone.  `calibrate` takes
        wider priors for what is not given.
    offset
        Distance of the mass centre to the right of the middle over half of the base; default 0.  It
        goes with an outline alone.
    restitution
        Ratio of angular velocities at an impact, on both sides.
    housner_factor
        Factor on the restitution that conserves angular momentum, which is at most 0.999 after it;
        default 0.85 to 1.1.
    scatter
        Standard deviation of the restitution from impact to impact; default 0 to 0.1.
    orientation_rad
        Angle of the plane in which it rocks from the first of two horizontal channels of a test
        [rad]; default -0.3 to 0.3 where a test has two.

    Attributes
    ----------
    spreads
        Spread of each number that the object has, defaults among them.
    defaults
        Names of the numbers that are not given.

    Raises
    ------
    InputError
        If a number is not possible, or no block has the sizes.
    ModelError
        If the size is given twice or in part, or both a restitution and a factor are given.

    Examples
    --------
    >>> column = ObjectPrior(name="column", width_m=0.15, height_m="0.58:0.62", base=1.0)
    >>> column.parameters
    ('height_m', 'housner_factor', 'scatter')
    >>> draws = column.draw([[0.5, 0.6, 0.0]])
    >>> draws.round(4).tolist()
    [[0.6, 1.0, 0.0]]
    >>> print(f"{column.block(draws[0]).alpha:.4f} rad")
    0.2450 rad
    """

    name: Annotated[str, nonempty_text]
    width_m: Given = None
    height_m: Given = None
    alpha_rad: Given = None
    p_rad_s: Given = None
    left_m: Given = None
    right_m: Given = None
    mass_centre_height_m: Given = None
    gyration_m: Given = None
    base: Given = None
    offset: Given = None
    restitution: Given = None
    housner_factor: Given = None
    scatter: Given = None
    orientation_rad: Given = None
    spreads: Mapping[str, PriorRange] = field(init=False)
    defaults: tuple[str, ...] = field(init=False)

    def __post_init__(self) -> None:
        """Validate, and fill in the defaults."""
        values = {key: getattr(self, key) for key in BOUNDS}
        given = {key: spread for key, spread in values.items() if spread is not None}
        fits = _fitting(given, self.name)
        if "restitution" in given and "housner_factor" in given:
            raise ModelError(
                "restitution, housner_factor",
                Words(f"are both given of {self.name}"),
                "the restitution is given itself, or as a factor on that of angular momentum",
                "leave one out",
            )
        silent = [key for key in DEFAULTS if key in fits and key not in given]
        if "restitution" in given:
            silent.remove("housner_factor")
        known = given | {key: DEFAULTS[key] for key in silent}
        spreads = {key: known[key] for key in BOUNDS if key in known}
        object.__setattr__(self, "spreads", spreads)
        object.__setattr__(self, "defaults", tuple(silent))
        self._check_sizes()

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        """Names of the numbers that are not exact, in a fixed order."""
        return tuple(key for key, spread in self.spreads.items() if not spread.fixed)

    @property
    def outline_alpha_rad(self) -> float:
        """Slenderness that the sizes show [rad]: of an outline its own, not that of its base."""
        middle = self._middle
        return middle["alpha_rad"] if "alpha_rad" in middle else atan2(*self._lever)

    @property
    def outline_radius_m(self) -> float:
        """Half-diagonal that the sizes show [m]: of an outline its own, not that of its base."""
        middle = self._middle
        if "alpha_rad" in middle:
            return Block.from_p(alpha=middle["alpha_rad"], p=middle["p_rad_s"]).radius
        return hypot(*self._lever)

    @property
    def middle_block(self) -> Block:
        """Block of the middle of each spread."""
        return self.block([self.spreads[key].middle for key in self.parameters])

    @property
    def _middle(self) -> dict[str, float]:
        """Middle of each spread."""
        return {key: spread.middle for key, spread in self.spreads.items()}

    @property
    def _lever(self) -> tuple[float, float]:
        """Horizontal and vertical distance of the mass centre from the edge that is nearer [m]."""
        middle = self._middle
        if "base" in middle:
            centre = middle.get("mass_centre_height_m", 0.5 * middle["height_m"])
            return 0.5 * middle["width_m"], centre
        return min(middle["left_m"], middle["right_m"]), middle["mass_centre_height_m"]

    def with_defaults(self, others: Mapping[str, PriorRange]) -> "ObjectPrior":
        """Return the object with other spreads where its own are defaults.

        Parameters
        ----------
        others
            Spread by name: of ``base``, ``offset``, ``restitution``, ``housner_factor`` and
            ``scatter``.  What does not go with the object's sizes is left out.
        """
        silent = set(self.defaults)
        if "housner_factor" in silent and "restitution" in others:
            silent = (silent - {"housner_factor"}) | {"restitution"}
        changed = {key: spread for key, spread in others.items() if key in silent}
        return replace(self, **changed) if changed else self  # type: ignore[arg-type]

    def draw(self, uniforms: ArrayLike) -> Floats:
        """Return values of the parameters at shares of their densities.

        Parameters
        ----------
        uniforms
            Shares from 0 to 1, shape (n, k) for k parameters.

        Returns
        -------
        ndarray
            Values, shape (n, k).

        Raises
        ------
        InputError
            If there are not k columns.
        """
        shares = self._rows("uniforms", uniforms)
        columns = [
            self.spreads[key].quantile(shares[:, place])
            for place, key in enumerate(self.parameters)
        ]
        return np.stack(columns, axis=1) if columns else np.empty((len(shares), 0))

    def scatter_of(self, values: ArrayLike) -> Floats:
        """Return the standard deviation of the restitution from impact to impact, shape (n,)."""
        return self._numbers(self._rows("values", values))["scatter"]

    def block(self, row: ArrayLike) -> Block:
        """Return the block of a row of values, shape (k,).

        Raises
        ------
        InputError
            If there are not k values, or no block has them.
        """
        return self.blocks(real_array("row", row)[np.newaxis])[0]

    def blocks(self, values: ArrayLike) -> list[Block]:
        """Return the blocks of rows of values, shape (n, k).

        Raises
        ------
        InputError
            As for `block`.
        """
        return blocks_of_sides(self.sides(values))

    def sides(self, values: ArrayLike) -> Floats:
        """Return the sides of the blocks of rows of values, without making the blocks.

        Parameters
        ----------
        values
            Shape (n, k).

        Returns
        -------
        ndarray
            Shape (n, 2, 4): of the positive and the negative side alpha [rad], the radius [m], p
            [rad/s] and the restitution, to the last bit those of `blocks`.

        Raises
        ------
        InputError
            If there are not k columns, or a value is not possible.
        """
        rows = self._rows("values", values)
        for place, key in enumerate(self.parameters):
            low, high, hint = BOUNDS[key]
            checked_array(key, rows[:, place], Bounds(low, high, "[]", hint))
        return sides_of_numbers(self._numbers(rows))

    def _numbers(self, rows: Floats) -> dict[str, Floats]:
        """Return the column of each number, exact numbers included."""
        return {
            key: rows[:, self.parameters.index(key)].copy()
            if key in self.parameters
            else np.full(len(rows), spread.low)
            for key, spread in self.spreads.items()
        }

    def _rows(self, name: str, values: ArrayLike) -> Floats:
        """Return rows of one value for each parameter."""
        rows = real_array(name, values)
        if rows.ndim != 2 or rows.shape[1] != len(self.parameters):
            names = ", ".join(self.parameters) or "none"
            raise InputError(
                name,
                Words(f"has the shape {rows.shape}"),
                f"each row has {len(self.parameters)} values: {names}",
                "give the values in this order",
            )
        return rows

    def _check_sizes(self) -> None:
        """Refuse sizes that no block has, in the middle of their spreads.

        Ends of wide spreads may be of blocks so stocky that they hardly rock.
        """
        centre, top = self.spreads.get("mass_centre_height_m"), self.spreads.get("height_m")
        if centre is not None and top is not None and centre.middle >= top.middle:
            raise InputError(
                "mass_centre_height_m",
                str(centre),
                f"it is below the top of {self.name}, height_m = {top}",
                "measure it again, or leave it out for half of height_m",
            )
        if "restitution" in self.spreads:
            return
        least = least_momentum_ratio({key: np.array([end]) for key, end in self._middle.items()})
        if least <= 0.0:
            raise InputError(
                f"object {self.name}",
                Words("is too stocky"),
                f"its restitution by angular momentum is {least:.4g}, and rocking needs one above "
                "0",
                "give a restitution, or a more slender object",
            )


def _fitting(given: Collection[str], name: str) -> tuple[str, ...]:
    """Return the numbers that go with the way in which the size is given."""
    # The height of the mass centre belongs to two ways.
    ways = {form: [key for key in form[:2] if key in given] for form in _FORMS}
    heads = [keys[0] for keys in ways.values() if keys]
    if len(heads) != 1:
        raise ModelError(
            f"object {name}",
            Words(f"has both {heads[0]} and {heads[1]}" if heads else "has no size"),
            f"the size is given in one way: {_WAYS}",
            "leave one of the two out" if heads else "add width_m and height_m",
        )
    form = next(form for form in _FORMS if ways[form])
    fits = (*form, *_FORMS[form], *_ALWAYS)
    for key in BOUNDS:
        if key in form and key not in given:
            raise ModelError(
                f"object {name}: {key}",
                Words("is missing"),
                f"the size is given in one way: {_WAYS}",
                "add it",
            )
        if key in given and key not in fits:
            raise ModelError(
                f"object {name}: {key}",
                Words(f"does not go with {form[0]}"),
                f"beside it stand {', '.join(fits)}",
                "leave it out",
            )
    return fits
