"""The block: its slenderness, its frequency parameter and what an impact leaves of its velocity.

A free-standing rigid block rocks about two edges.  What its equation of motion needs of each side
is its critical angle `alpha`, its frequency parameter `p` and its restitution; `Side` holds them,
and a `Block` is two sides.  All constructors make symmetric blocks, whose sides are equal.

Sizes are full dimensions in metres.  Much of the literature writes b and h for half of them.
"""

import math
from dataclasses import dataclass
from typing import Literal

from rocksteady.errors import InputError, ModelError
from rocksteady.model.validation import in_range, positive

STANDARD_GRAVITY = 9.80665
"""Standard acceleration of gravity [m/s^2]."""

Restitution = float | Literal["housner"]
"""A ratio of angular velocities in (0, 1], or "housner" for that of inelastic impact."""


def restitution_value(value: object, *, name: str = "restitution") -> float:
    """Return a restitution in (0, 1], the ratio of angular velocities after and before an impact.

    Raises
    ------
    InputError
        If `value` is not a number in (0, 1].
    """
    hint = (
        "give the ratio of the angular velocities after and before an impact; a ratio of energies "
        "r is its square, so take sqrt(r)"
    )
    return in_range(name, value, 0.0, 1.0, "(]", hint=hint)


@dataclass(frozen=True, kw_only=True)
class Side:
    """One pivot of a block.

    Parameters
    ----------
    alpha
        Critical angle (slenderness) [rad]: the tilt at which the mass centre stands above the
        pivot.
    radius
        Distance R from the pivot to the mass centre [m].
    p
        Frequency parameter ``sqrt(M g R / I_0)`` [rad/s] (eq 6).
    restitution
        Ratio of the angular velocities after and before the impact that ends rocking on this side
        (eq 9).

    Raises
    ------
    InputError
        If alpha lies outside (0, pi/2), a restitution outside (0, 1], or another number is not
        positive.
    """

    alpha: float
    radius: float
    p: float
    restitution: float

    def __post_init__(self) -> None:
        """Validate."""
        object.__setattr__(self, "alpha", _alpha(self.alpha))
        object.__setattr__(self, "radius", _radius(self.radius))
        object.__setattr__(self, "p", _rate(self.p))
        object.__setattr__(self, "restitution", restitution_value(self.restitution))


@dataclass(frozen=True, kw_only=True)
class DimensionlessBlock:
    """A symmetric block as the equation of motion sees it: its restitution is all that is left.

    Angles count in units of alpha, times in units of 1/p, accelerations in units of alpha g.

    Parameters
    ----------
    restitution
        Ratio of the angular velocities after and before an impact, in (0, 1].

    Raises
    ------
    InputError
        If the restitution is not a number in (0, 1].

    Examples
    --------
    >>> DimensionlessBlock(restitution=0.8).sides
    ((0.8, 1.0, 1.0), (0.8, 1.0, 1.0))
    """

    restitution: float

    def __post_init__(self) -> None:
        """Validate."""
        object.__setattr__(self, "restitution", restitution_value(self.restitution))

    @property
    def sides(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """(restitution, alpha ratio, p ratio) of the positive and of the negative side.

        The ratios refer to the positive side; those of an asymmetric block will differ from 1.
        """
        side = (self.restitution, 1.0, 1.0)
        return side, side

    def dimensionless(self) -> "DimensionlessBlock":
        """Return itself."""
        return self


@dataclass(frozen=True, kw_only=True)
class Block:
    """A free-standing rigid block.  Use one of the constructors below.

    ====================================  =====================================================
    ``Block.rectangle(width, height)``    homogeneous rectangle of full width and height [m]
    ``Block.from_radius(alpha, radius)``  homogeneous rectangle of slenderness and half-diagonal
    ``Block.from_p(alpha, p)``            slenderness [rad] and frequency parameter [rad/s]
    ``Block.general(...)``                any mass distribution
    ====================================  =====================================================

    Parameters
    ----------
    positive, negative
        The two sides.  Positive rotation is about the pivot of `positive`.
    gravity
        Acceleration of gravity [m/s^2].

    Raises
    ------
    InputError
        If the gravity is not positive.

    Examples
    --------
    >>> block = Block.rectangle(width=0.4, height=1.2)
    >>> print(f"{block.alpha:.4f} rad, {block.radius:.4f} m, {block.p:.4f} rad/s")
    0.3218 rad, 0.6325 m, 3.4102 rad/s
    >>> print(f"{block.restitution:.4f}")
    0.8500
    """

    positive: Side
    negative: Side
    gravity: float = STANDARD_GRAVITY

    def __post_init__(self) -> None:
        """Validate."""
        object.__setattr__(self, "gravity", _gravity(self.gravity))

    @classmethod
    def rectangle(
        cls,
        *,
        width: float,
        height: float,
        restitution: Restitution = "housner",
        gravity: float = STANDARD_GRAVITY,
    ) -> "Block":
        """Return a homogeneous rectangle: ``p = sqrt(3 g / (4 R))`` (eq 27).

        Parameters
        ----------
        width, height
            Full dimensions [m].
        restitution
            A ratio of angular velocities in (0, 1]; "housner" (default) for 1 - 1.5 sin^2 alpha.
        gravity
            [m/s^2]

        Raises
        ------
        InputError
            If a size is not a positive number, a restitution lies outside (0, 1], or Housner's
            value is not positive (a block so stocky does not rock).
        """
        b = positive("width", width, hint="give the full width in metres")
        h = positive("height", height, hint="give the full height in metres")
        alpha = math.atan2(b, h)
        if restitution == "housner" and housner_ratio(alpha) <= 0.0:
            # Not left to the check of alpha, which the caller has not given.
            raise InputError(
                name="width",
                value=width,
                valid=f"with a height of {h:.6g} m Housner's restitution is "
                f"{housner_ratio(alpha):.4g}, and rocking needs one above 0",
                hint="give a measured restitution in (0, 1], or a more slender block",
            )
        return cls.from_radius(
            alpha=alpha, radius=0.5 * math.hypot(b, h), restitution=restitution, gravity=gravity
        )

    @classmethod
    def from_radius(
        cls,
        *,
        alpha: float,
        radius: float,
        restitution: Restitution = "housner",
        gravity: float = STANDARD_GRAVITY,
    ) -> "Block":
        """Return the homogeneous rectangle of slenderness `alpha` [rad] and half-diagonal [m].

        Raises
        ------
        InputError
            As for `rectangle`; `alpha` must lie in (0, pi/2).
        """
        r = _radius(radius)
        g = _gravity(gravity)
        return cls._symmetric(alpha, r, math.sqrt(0.75 * g / r), restitution, g)

    @classmethod
    def from_p(
        cls,
        *,
        alpha: float,
        p: float,
        restitution: Restitution = "housner",
        gravity: float = STANDARD_GRAVITY,
    ) -> "Block":
        """Return the homogeneous rectangle of slenderness `alpha` [rad] and parameter `p` [rad/s].

        Raises
        ------
        InputError
            As for `from_radius`; `p` must be a positive number.
        """
        rate = _rate(p)
        g = _gravity(gravity)
        return cls._symmetric(alpha, 0.75 * g / (rate * rate), rate, restitution, g)

    @classmethod
    def general(
        cls,
        *,
        mass: float,
        inertia: float,
        radius: float,
        alpha: float,
        restitution: Restitution = "housner",
        gravity: float = STANDARD_GRAVITY,
    ) -> "Block":
        """Return a block of any mass distribution: ``p = sqrt(M g R / I_0)`` (eqs 6, 26).

        Parameters
        ----------
        mass
            M [kg].
        inertia
            I_0 about a pivot [kg m^2]; at least M R^2, which is all its mass in one point.
        radius
            R from pivot to mass centre [m].
        alpha
            Slenderness [rad].
        restitution
            A ratio of angular velocities in (0, 1]; "housner" (default) for
            1 - 2 (M R^2 / I_0) sin^2 alpha, from angular momentum about the new pivot.
        gravity
            [m/s^2]

        Raises
        ------
        InputError
            As for `rectangle`.
        ModelError
            If the inertia is below M R^2, which no body has.
        """
        m = positive("mass", mass, hint="give the mass in kg")
        i = positive("inertia", inertia, hint="give the moment of inertia about a pivot in kg m^2")
        r = _radius(radius)
        if i < m * r * r * (1.0 - 1e-12):
            raise ModelError(
                name="inertia",
                value=inertia,
                valid=f"about a pivot it is at least mass * radius^2 = {m * r * r:.6g} kg m^2",
                hint="add mass * radius^2 to a moment of inertia about the mass centre",
            )
        g = _gravity(gravity)
        return cls._symmetric(alpha, r, math.sqrt(m * g * r / i), restitution, g)

    @classmethod
    def _symmetric(
        cls, alpha: float, radius: float, p: float, restitution: Restitution, gravity: float
    ) -> "Block":
        """Return the block whose sides are both made of these."""
        angle = _alpha(alpha)
        if restitution == "housner":
            ratio = housner_restitution(angle, p=p, radius=radius, gravity=gravity)
        else:
            ratio = restitution
        side = Side(alpha=angle, radius=radius, p=p, restitution=ratio)
        return cls(positive=side, negative=side, gravity=gravity)

    @property
    def alpha(self) -> float:
        """Slenderness of the positive side [rad]."""
        return self.positive.alpha

    @property
    def radius(self) -> float:
        """Distance R from the positive side's pivot to the mass centre [m]."""
        return self.positive.radius

    @property
    def p(self) -> float:
        """Frequency parameter of the positive side [rad/s]."""
        return self.positive.p

    @property
    def restitution(self) -> float:
        """Ratio of angular velocities after and before an impact that ends positive rotation."""
        return self.positive.restitution

    @property
    def width(self) -> float:
        """Distance between the pivots [m]; that of a rectangle is its full width."""
        return self.positive.radius * math.sin(
            self.positive.alpha
        ) + self.negative.radius * math.sin(self.negative.alpha)

    @property
    def height(self) -> float:
        """Twice the height of the mass centre [m]; that of a rectangle is its full height."""
        return 2.0 * self.positive.radius * math.cos(self.positive.alpha)

    @property
    def uplift_acceleration(self) -> float:
        """Base acceleration that lifts the block from rest in the linear model, alpha g [m/s^2]."""
        return self.positive.alpha * self.gravity

    def dimensionless(self) -> DimensionlessBlock:
        """Return what the equation of motion sees of the block in its own units.

        Raises
        ------
        ModelError
            If its sides differ, which the equations of motion do not know yet.
        """
        if self.positive != self.negative:
            raise ModelError(
                name="block",
                value=self,
                valid="blocks whose sides differ are not computed yet",
                hint="give both sides the same alpha, radius, p and restitution",
            )
        return DimensionlessBlock(restitution=self.restitution)

    def _repr_html_(self) -> str:
        """Return a small table for notebooks."""
        rows = (
            ("slenderness alpha", f"{self.alpha:.6g} rad"),
            ("radius R", f"{self.radius:.6g} m"),
            ("frequency parameter p", f"{self.p:.6g} rad/s"),
            ("restitution", f"{self.restitution:.6g}"),
            ("uplift at", f"{self.uplift_acceleration / self.gravity:.6g} g"),
        )
        cells = "".join(f"<tr><th>{name}</th><td>{value}</td></tr>" for name, value in rows)
        return f"<table><caption>Block</caption>{cells}</table>"


def housner_restitution(
    alpha: float, *, p: float = 1.0, radius: float = 0.75, gravity: float = 1.0
) -> float:
    """Return the restitution that conserves angular momentum about the new pivot.

    Housner's ``1 - 1.5 sin^2 alpha`` of a homogeneous rectangle is ``1 - 2 (p^2 R / g) sin^2
    alpha`` with its p; the default arguments are those of a rectangle.

    Parameters
    ----------
    alpha
        Slenderness [rad].
    p, radius, gravity
        Frequency parameter [rad/s], R [m] and g [m/s^2]; only p^2 R / g = M R^2 / I_0 matters.

    Returns
    -------
    float
        The ratio of angular velocities.

    Raises
    ------
    InputError
        If the ratio is not positive: the block is so stocky that it does not rock on.

    References
    ----------
    G. W. Housner, Bull. Seism. Soc. Am. 53, 403-417 (1963).

    Examples
    --------
    >>> round(housner_restitution(0.17453292519943295), 6)
    0.954769
    """
    ratio = housner_ratio(_alpha(alpha), p=p, radius=radius, gravity=gravity)
    if ratio <= 0.0:
        raise InputError(
            name="alpha",
            value=alpha,
            valid=f"Housner's restitution for it is {ratio:.4g}, and rocking needs one above 0",
            hint="give a measured restitution in (0, 1], or a more slender block",
        )
    return ratio


def housner_ratio(
    alpha: float, *, p: float = 1.0, radius: float = 0.75, gravity: float = 1.0
) -> float:
    """Return the value of `housner_restitution`, positive or not."""
    return 1.0 - 2.0 * (p * p * radius / gravity) * math.sin(alpha) ** 2


def _alpha(value: float) -> float:
    hint = "give the angle in radians at which the mass centre stands above the pivot"
    return in_range("alpha", value, 0.0, 0.5 * math.pi, "()", hint=hint)


def _radius(value: float) -> float:
    return positive("radius", value, hint="give the distance from pivot to mass centre in metres")


def _rate(value: float) -> float:
    hint = "give the frequency parameter sqrt(M g R / I_0) in rad/s"
    return in_range("p", value, 1e-6, 1e6, "[]", hint=hint)


def _gravity(value: float) -> float:
    return positive("gravity", value, hint="give the acceleration of gravity in m/s^2")
