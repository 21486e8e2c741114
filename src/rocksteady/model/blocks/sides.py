"""One side of a block: slenderness, frequency parameter and restitution at its pivot.

The **positive side** is rotation about the left edge, counterclockwise, which a base acceleration
to the right (positive) drives; the negative side is rotation about the right edge.
"""

import math
from dataclasses import dataclass, field, replace
from typing import Annotated

from rocksteady.errors import InputError, ModelError, Words
from rocksteady.kernels.elementary.arrays import atan2, cos, hypot, sin
from rocksteady.model.blocks.housner_forms import Impacts, Restitutions
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import ALPHA, GRAVITY, GYRATION, RADIUS, RESTITUTION, P, length

SAME_BODY = 1e-6
"""How near two sides' heights and moments of inertia are, relative to their size, if they belong to
one body: measured values agree to less, computed ones to rounding."""

CONSERVING = "the restitution that conserves angular momentum"


@checked
@dataclass(frozen=True, kw_only=True)
class Side:
    """One side of a block: the properties of its pivot.

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
    gravity
        Acceleration of gravity [m/s^2] that `p` is for; None (default) for that of the block.
    cap_mass_ratio
        That of the cap that `p` is for, of a column; 0 (default) of a single block.

    Raises
    ------
    InputError
        If alpha lies outside (0, pi/2), a restitution outside (0, 1], or another number is not
        positive.
    """

    alpha: Annotated[float, ALPHA]
    radius: Annotated[float, RADIUS]
    p: Annotated[float, P]
    restitution: Annotated[float, RESTITUTION]
    gravity: Annotated[float | None, GRAVITY] = field(default=None, compare=False, repr=False)
    cap_mass_ratio: float = field(default=0.0, compare=False, repr=False)

    @property
    def distance(self) -> float:
        """Horizontal distance from the pivot to the mass centre [m]."""
        return self.radius * sin(self.alpha)

    @property
    def centre_height(self) -> float:
        """Height of the mass centre [m]."""
        return self.radius * cos(self.alpha)

    def to_dict(self) -> dict[str, float]:
        """Return its measures under the names of the commands' JSON."""
        return {
            "alpha_rad": self.alpha,
            "radius_m": self.radius,
            "p_rad_s": self.p,
            "restitution": self.restitution,
        }


def gyration_squared(side: Side, gravity: float) -> float:
    """Return ``I_c/M`` about the mass centre [m^2], negative where no body has it."""
    return side.radius * (gravity / (side.p * side.p) - side.radius)


def gyration_of(side: Side, gravity: float) -> float:
    """Return the radius of gyration about the mass centre [m]."""
    return math.sqrt(max(gyration_squared(side, gravity), 0.0))


def under(side: Side, gravity: float, cap_mass_ratio: float) -> Side:
    """Return the side of the same body under a gravity [m/s^2]: p^2 is proportional to it.

    A rectangle, and Housner's restitution, are computed again, to the last bit.

    Raises
    ------
    ModelError
        If its p is that of a column under another cap, or under none.
    """
    before, p, radius, ratio = side.gravity, side.p, side.radius, side.restitution
    if before is not None and side.cap_mass_ratio != cap_mass_ratio:
        raise ModelError(
            "cap",
            Words("is not the one that the p of its sides is for"),
            "a cap sets the p and the restitution of its columns",
            "give the column, as Block.rectangle(...), and take its capped(...)",
        )
    if before == gravity:
        return side
    if before is not None:
        rectangle = p == rectangle_p(radius, before)
        p = rectangle_p(radius, gravity) if rectangle else p * math.sqrt(gravity / before)
        if ratio == housner_ratio(side.alpha, p=side.p, radius=radius, gravity=before):
            ratio = housner_ratio(side.alpha, p=p, radius=radius, gravity=gravity)
    return replace(side, p=p, restitution=ratio, gravity=gravity, cap_mass_ratio=cap_mass_ratio)


def rectangle_p(radius: float, gravity: float) -> float:
    """Return p [rad/s] of a homogeneous rectangle of half-diagonal R [m] (eq 27)."""
    return math.sqrt(0.75 * gravity / radius)


def body_p(weight: float, radius: float, inertia: float) -> float:
    """Return p [rad/s] of a body: ``sqrt(M g R / I_0)`` (eq 6).

    Parameters
    ----------
    weight, inertia
        M g and I_0 about the pivot, or both per unit of mass.
    radius
        R from the pivot to the mass centre [m].
    """
    return math.sqrt(weight * radius / inertia)


def impact_friction(left: Side, struck: Side) -> float:
    """Return the least friction with which an impact leaves the struck edge in place.

    An impact that ends a rotation omega about the edge at a distance b from the mass centre, which
    stands h high, and begins e omega about the struck edge at b', gives the mass centre ``h (1 - e)
    omega`` across and ``(b + e b') omega`` upwards: ``mu >= h (1 - e)/(b + e b')``, for like sides
    ``cot(alpha) (1 - e)/(1 + e)``.
    """
    ratio = left.restitution
    return left.centre_height * (1.0 - ratio) / (left.distance + ratio * struck.distance)


def same_shape(one: Side, other: Side) -> bool:
    """Return whether two sides are equal, their restitutions aside."""
    return one == replace(other, restitution=one.restitution)


def check_one_body(one: Side, other: Side, gravity: float) -> None:
    """Refuse two sides that no rigid body has.

    Raises
    ------
    ModelError
        If the moment of inertia about the mass centre is negative, or differs between the sides, or
        their mass centres have different heights.
    """
    # I_c/M about the mass centre is that of one body seen from either pivot.
    centre = gyration_squared(one, gravity), gyration_squared(other, gravity)
    for side, square in zip((one, other), centre, strict=True):
        if square < -SAME_BODY * side.radius * side.radius:
            raise ModelError(
                "g radius / p^2 - radius^2",
                square,
                "it is the squared radius of gyration about the mass centre, so 0 or more",
                f"give p up to sqrt(g/radius) = {math.sqrt(gravity / side.radius):.10g} rad/s",
            )
    if one == other:
        return
    here, other_height = one.centre_height, other.centre_height
    if abs(here - other_height) > SAME_BODY * max(here, other_height):
        raise ModelError(
            "radius * cos(alpha)",
            (here, other_height),
            "it is the height of the one mass centre, so the same on both sides",
            "use Block.from_alphas with one radius, or Block.asymmetric",
        )
    about = [gravity * side.radius / (side.p * side.p) for side in (one, other)]
    if abs(centre[0] - centre[1]) > SAME_BODY * max(about):
        raise ModelError(
            "g radius / p^2 - radius^2",
            centre,
            "it is the squared radius of gyration about the mass centre, so the same on each side",
            "leave p to Block.asymmetric or Block.from_alphas",
        )


def with_point_mass(
    centre_height: float, gyration: float, *, share: float, at_height: float
) -> tuple[float, float]:
    """Return mass centre and gyration [m] of a body with a point mass fixed in line with its own.

    Parallel axes: ``M k^2`` grows by the reduced mass times the squared distance of the two.

    Parameters
    ----------
    centre_height, gyration
        Height of the mass centre and radius of gyration about it, without the point mass [m].
    share
        The point mass over the mass of the body.
    at_height
        Height of the point mass, straight above or below the mass centre [m].
    """
    whole, apart = 1.0 + share, at_height - centre_height
    square = (gyration * gyration + share * apart * apart / whole) / whole
    return centre_height + apart * share / whole, math.sqrt(square)


def sides_of_body(
    *,
    left: float,
    right: float,
    centre_height: float,
    gyration: float,
    restitution: Restitutions,
    gravity: float,
) -> tuple[Side, Side]:
    """Return the positive and the negative side of a rigid body; all arguments are valid numbers.

    Parameters
    ----------
    left, right
        Horizontal distances from the edges to the mass centre [m].
    centre_height
        Height of the mass centre [m].
    gyration
        Radius of gyration about the mass centre, ``sqrt(I_c/M)`` [m].
    restitution, gravity
        As for `rocksteady.Block.asymmetric`.
    """
    alphas = atan2(left, centre_height), atan2(right, centre_height)
    radii = hypot(left, centre_height), hypot(right, centre_height)
    rates = [body_p(gravity, r, gyration * gyration + r * r) for r in radii]

    def housner() -> tuple[float, float]:
        ratios = (
            impact_ratio(alphas, radii, gyration),
            impact_ratio(alphas[::-1], radii[::-1], gyration),
        )
        # Not left to the check of the angles, which the caller may not have given.
        words = f"with {right:.6g} m to the right edge and {centre_height:.6g} m down to the base "
        refuse_no_rocking("left", left, min(ratios), f"{words}{CONSERVING} is")
        return ratios

    impacts = Impacts.of(restitution)
    kept = impacts.numbers if impacts.factor is None else map(impacts.times, housner())
    first, second = (
        Side(alpha=alpha, radius=radius, p=p, restitution=ratio, gravity=gravity)
        for alpha, radius, p, ratio in zip(alphas, radii, rates, kept, strict=True)
    )
    return first, second


@checked
def impact_restitution(
    alphas: tuple[float, float], radii: tuple[float, float], *, gyration: float
) -> float:
    """Return the restitution that conserves angular momentum about the struck pivot.

    ``(I_c + M R1 R2 cos(alpha1 + alpha2)) / (I_c + M R2^2)``, with 1 the pivot that is left and 2
    the pivot that is struck: just before the impact the mass centre moves at right angles to the
    line from pivot 1, and the two lines enclose alpha1 + alpha2 (`docs/theory/model.md`).

    Parameters
    ----------
    alphas, radii
        Slenderness [rad] and distance to the mass centre [m] of pivot 1 and pivot 2.
    gyration
        Radius of gyration about the mass centre, ``sqrt(I_c/M)`` [m].

    Returns
    -------
    float
        The ratio of angular velocities.

    Raises
    ------
    InputError
        If the ratio is not positive: the block is so stocky that it does not rock on.

    Examples
    --------
    >>> print(f"{impact_restitution((0.2, 0.3), (1.0, 1.02588), gyration=0.58):.6f}")
    0.890458
    """
    angles = tuple([ALPHA("alphas", alpha) for alpha in alphas])
    distance = length("give the distances from both pivots to the mass centre in metres")
    lengths = tuple([distance("radii", radius) for radius in radii])
    k = GYRATION("gyration", gyration)
    ratio = impact_ratio(angles, lengths, k)
    refuse_no_rocking("alphas", alphas, ratio, f"{CONSERVING} is")
    return ratio


@checked
def housner_restitution(
    alpha: float, *, p: float = 1.0, radius: float = 0.75, gravity: float = 1.0
) -> float:
    """Return Housner's restitution, which conserves angular momentum about the new pivot.

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
    ratio = housner_ratio(
        ALPHA("alpha", alpha),
        p=P("p", p),
        radius=RADIUS("radius", radius),
        gravity=GRAVITY("gravity", gravity),
    )
    refuse_no_rocking("alpha", alpha, ratio, "Housner's restitution for it is")
    return ratio


def refuse_no_rocking(name: str, value: object, ratio: float, words: str) -> None:
    """Refuse a body so stocky that its restitution, which `words` introduce, is not positive.

    Raises
    ------
    InputError
        If it is not.
    """
    if ratio <= 0.0:
        valid = f"{words} {ratio:.4g}, and rocking needs one above 0"
        hint = "give a measured restitution in (0, 1], or a more slender block"
        raise InputError(name, value, valid, hint)


def wall_ratio(positive: Side, negative: Side, gravity: float) -> float:
    """Return the restitution of a block against a wall by conservation of angular momentum.

    A block that falls back strikes its base at the other edge, then the wall at its top, twice as
    high as the mass centre and above that edge, then its base at the first edge.  Each impact
    conserves angular momentum about the point that is struck, and passes its angular velocity on to
    the next.  For a symmetric block::

        (1 - 2 k sin^2 alpha)^2 (2 k cos^2 alpha - 1),    k = p^2 R/g

    with k = 3/4 of a rectangle (Sorrentino, Kunnath, Monti and Scalora 2008; Sorrentino, AlShawa
    and Decanini 2011).  It tends to 1/2 of a slender rectangle.  In general the two impacts on the
    base have their own values of `impact_restitution`, and alpha and k of the wall's factor are
    those of the edge beneath it.

    Raises
    ------
    InputError
        If the block is so stocky that the base or the wall does not turn it back.
    """
    share = negative.p * negative.p * negative.radius / gravity
    cosine = float(cos(negative.alpha))
    wall = 2.0 * share * cosine * cosine - 1.0
    first, second = housner_pair(positive, negative, gravity)
    if min(first, second) <= 0.0 or wall < 0.0:
        raise InputError(
            "restitution",
            "housner",
            f"a block of alpha = {positive.alpha:.4g} rad is not turned back by a wall",
            "give the restitution as a number in [0, 1]",
        )
    return first * second * wall


def housner_ratio(
    alpha: float, *, p: float = 1.0, radius: float = 0.75, gravity: float = 1.0
) -> float:
    """Return the value of `housner_restitution`, positive or not."""
    sine = sin(alpha)
    return 1.0 - 2.0 * (p * p * radius / gravity) * (sine * sine)


def housner_pair(positive: Side, negative: Side, gravity: float) -> tuple[float, float]:
    """Return Housner's restitutions of both impacts of a body, positive or not.

    That of the impact that ends positive rotation is the first.
    """
    if positive.alpha == negative.alpha and positive.p == negative.p:
        ratios = housner_ratio(
            positive.alpha, p=positive.p, radius=positive.radius, gravity=gravity
        )
        return ratios, ratios
    alphas, radii = (positive.alpha, negative.alpha), (positive.radius, negative.radius)
    gyration = gyration_of(positive, gravity)
    return impact_ratio(alphas, radii, gyration), impact_ratio(alphas[::-1], radii[::-1], gyration)


def impact_ratio(alphas: tuple[float, ...], radii: tuple[float, ...], gyration: float) -> float:
    """Return the value of `impact_restitution`, positive or not."""
    square = gyration * gyration
    # R1 R2 cos(alpha1 + alpha2) is the height squared less the product of the two distances.
    shared = radii[0] * radii[1] * cos(alphas[0] + alphas[1])
    return (square + shared) / (square + radii[1] * radii[1])
