"""A free-standing block: slenderness, frequency parameter and restitution of both its sides.

A free-standing rigid block rocks about two edges.  What its equation of motion needs of each side
is its critical angle `alpha`, its frequency parameter `p` and its restitution; `Side` holds them,
and a `Block` is two sides.  Those of a symmetric block are equal.

Sizes are full dimensions in metres.  Much of the literature writes b and h for half of them.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Annotated

from rocksteady.errors import InputError, ModelError
from rocksteady.kernels.elementary.arrays import atan2, cos, hypot, sin, tan
from rocksteady.model.blocks._measures import Measured
from rocksteady.model.blocks.caps import CAP_MASS, COLUMNS, Cap, conserving_pair, has_factor
from rocksteady.model.blocks.examples import PARTS, constructor_of
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.blocks.housner_forms import Impacts, Restitution, Restitutions
from rocksteady.model.blocks.outlines import Outline, outline_around
from rocksteady.model.blocks.sides import (
    Side,
    body_p,
    check_one_body,
    gyration_of,
    housner_restitution,
    rectangle_p,
    refuse_no_rocking,
    same_shape,
    sides_of_body,
    under,
    wall_ratio,
    with_point_mass,
)
from rocksteady.model.blocks.sizes import (
    check_inertia,
    check_one_size,
    lengths_of,
    question_millimetres,
    radius_of_p,
    refuse_stocky,
)
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import (
    ALPHA,
    GRAVITY,
    RADIUS,
    P,
    length,
    restitution_of_wall,
)
from rocksteady.model.checks.validation import in_range, positive


@checked
@dataclass(frozen=True, kw_only=True, repr=False)
class Block(Measured):
    """A free-standing rigid block, made by one of the constructors below.

    ==========================================  ====================================================
    ``Block.rectangle(width, height)``          homogeneous rectangle of full width and height [m]
    ``Block.from_radius(alpha, radius)``        homogeneous rectangle of slenderness and
                                                half-diagonal
    ``Block.from_p(alpha, p)``                  slenderness [rad] and frequency parameter [rad/s]
    ``Block.general(...)``                      any mass distribution, symmetric
    ``Block.asymmetric(left, right, height)``   mass centre nearer to one edge, or off mid-height
    ``Block.from_alphas(positive, negative)``   the same, by the critical angles of both sides
    ``Block.frame(columns, ...)``               equal rectangular columns under one rigid cap
    ``Block.named(name)``                       one of the literature or of common equipment
    ==========================================  ====================================================

    ``block.against_wall()`` is any of them against a wall, so that it rocks to one side alone, and
    ``block.capped(...)`` a frame of columns of which each is that block.

    The positive side is rotation about the left edge, counterclockwise, which a positive base
    acceleration (to the right) drives.  Its alpha and p are the reference of an asymmetric block:
    angles count in units of its alpha, pivot time is its p times t, accelerations are in units of
    its alpha g, and `alpha`, `radius`, `p`, `restitution` and `uplift_acceleration` are its own.

    Parameters
    ----------
    positive, negative
        The two sides.  Positive rotation is about the pivot of `positive`.
    gravity
        Acceleration of gravity [m/s^2].
    housner_factor
        Factor of Housner's restitution that was given, for descriptions; none by default, and
        none where the restitutions are another factor of it.
    wall_restitution
        For a block against a wall (`against_wall`), which rocks on its positive side alone, the
        restitution of its impacts on the wall, in [0, 1]; None (default) of a block without.
    cap
        Cap of a rocking frame (`capped`); None (default) of a single block.  Width, height, alpha
        and radius of a frame are those of one column.
    outline
        The rectangle around the block, for its top, clearances and pictures; default (None) that
        of its edges, twice as high as the mass centre, as of a homogeneous rectangle.
    parts
        Parts that are fixed to each other and computed as one body, for descriptions, as "statue
        and plinth"; empty (default) of a single part.

    Raises
    ------
    InputError
        If the gravity is not positive, or the mass centre is above the outline.
    ModelError
        If the sides are not those of one rigid body: ``R cos(alpha)``, the height of its mass
        centre, or ``g R/p^2 - R^2``, its radius of gyration squared, differ, or the latter is
        negative.

    Examples
    --------
    >>> block = Block.rectangle(width=0.4, height=1.2)
    >>> print(f"{block.alpha:.4f} rad, {block.radius:.4f} m, {block.p:.4f} rad/s")
    0.3218 rad, 0.6325 m, 3.4102 rad/s
    >>> print(f"{block.restitution:.4f}")
    0.8500

    The same body on the Moon has another p:

    >>> from dataclasses import replace
    >>> print(f"{replace(block, gravity=1.62).p:.4f} rad/s")
    1.3860 rad/s
    """

    positive: Side
    negative: Side
    gravity: Annotated[float, GRAVITY] = STANDARD_GRAVITY
    housner_factor: float | None = field(default=None, compare=False)
    wall_restitution: Annotated[float | None, restitution_of_wall] = None
    cap: Cap | None = None
    outline: Outline | None = None
    parts: str = field(default="", compare=False)

    def __post_init__(self) -> None:
        """Validate."""
        share = 0.0 if self.cap is None else self.cap.cap_mass_ratio
        for name in ("positive", "negative"):
            object.__setattr__(self, name, under(getattr(self, name), self.gravity, share))
        check_one_body(self.positive, self.negative, self.gravity)
        factor = self.housner_factor
        if factor is not None:
            Impacts.of(("housner", factor))  # refuses what is none
        # Kept where none was given: a block whose mass centre is replaced stays as high.
        outline = outline_around(self.positive.centre_height, self.outline)
        object.__setattr__(self, "outline", outline)
        if self.cap is not None:
            alike = same_shape(self.positive, self.negative) and self.fills_outline
            self.cap.check_column(self.positive, self.gravity, alike=alike)
        sides = self.positive, self.negative, self.gravity
        if factor is not None and not has_factor(factor, *sides, self.wall_restitution, self.cap):
            object.__setattr__(self, "housner_factor", None)

    @property
    def _identity(self) -> tuple[object, ...]:
        """What equal blocks have in common: all that moves them, and their outline."""
        sides = [self.positive, self.negative]
        if self.one_sided:  # no impact on the base alone ends a rotation
            sides = [replace(side, restitution=1.0) for side in sides]
        return (*sides, self.gravity, self.wall_restitution, self.cap, self.outline)

    def __eq__(self, other: object) -> bool:
        """Return whether the other is a block that moves alike in the same outline.

        The outline does not enter the motion, but the top of a higher block moves further: equal
        blocks have results that are equal in every number.
        """
        return isinstance(other, Block) and self._identity == other._identity

    def __hash__(self) -> int:
        """Return the same number for equal blocks."""
        return hash(self._identity)

    @classmethod
    def named(
        cls,
        name: str,
        *,
        restitution: Restitutions | None = None,
        gravity: float = STANDARD_GRAVITY,
    ) -> "Block":
        """Return a named block of the literature or of common equipment.

        Parameters
        ----------
        name
            "tso-wong-1989", "makris-roussos-2000", "zhang-makris-2001", "fema-p58-cabinet",
            "server-rack", "gas-cylinder" or "statue-on-plinth".  Sizes, sources and assumptions
            are in `rocksteady.model.blocks.examples.SOURCES`.
        restitution
            Restitution in place of the source's, in any form that its constructor takes; by
            default the source's, or Housner's where the source gives none.
        gravity
            Acceleration of gravity [m/s^2].

        Raises
        ------
        InputError
            If there is no block of that name, or another value is outside its range.

        Examples
        --------
        >>> Block.named("zhang-makris-2001").restitution
        0.9
        """
        constructor, sizes = constructor_of(name)
        given = {} if restitution is None else {"restitution": restitution}
        made: Block = getattr(cls, constructor)(**(sizes | given))  # of which p is on Earth
        return replace(made, gravity=gravity, parts=PARTS.get(name, ""))

    @classmethod
    def rectangle(
        cls,
        *,
        width: Annotated[float, length("give the full width in metres")],
        height: Annotated[float, length("give the full height in metres")],
        restitution: Restitution = "housner",
        gravity: float = STANDARD_GRAVITY,
    ) -> "Block":
        """Return a homogeneous rectangle: ``p = sqrt(3 g / (4 R))`` (eq 27).

        Parameters
        ----------
        width, height
            Full dimensions [m].
        restitution
            A ratio of angular velocities in (0, 1]; "housner" (default) for 1 - 1.5 sin^2 alpha;
            ("housner", 0.965) for a measured factor of that.
        gravity
            Acceleration of gravity [m/s^2].

        Raises
        ------
        InputError
            If a size is not a positive number, a restitution lies outside (0, 1], or Housner's
            value is not positive (a block so stocky does not rock).
        """
        question_millimetres({"width": width, "height": height}, height=height)
        alpha = atan2(width, height)
        if Impacts.of(restitution).factor is not None:
            refuse_stocky(width, height, alpha)
        return cls._symmetric(alpha, 0.5 * hypot(width, height), restitution, gravity)

    @classmethod
    def frame(
        cls,
        *,
        columns: int,
        cap_mass_ratio: float,
        width: float,
        height: float,
        restitution: Restitutions = "housner",
        gravity: float = STANDARD_GRAVITY,
    ) -> "Block":
        """Return a rocking frame: equal rectangular columns under one rigid cap.

        It rocks as one column does with ``p^2 = 3 g/(4 R) (1 + 2 gamma)/(1 + 3 gamma)``, gamma the
        `cap_mass_ratio`; the same acceleration lifts it (Makris and Vassiliou 2013).  One column
        with its cap is no frame but a body, as `capped` makes it.

        Parameters
        ----------
        columns
            Number of columns, from 1 to 1000.
        cap_mass_ratio
            Mass of the cap over that of all columns together, from 0 to 1000.
        width, height
            Full dimensions of one column [m].
        restitution
            A ratio of angular velocities in (0, 1], or a pair as for `asymmetric`; "housner"
            (default) for ``(1 - 1.5 sin^2 alpha + 3 gamma cos 2 alpha)/(1 + 3 gamma)``;
            ("housner", 0.965) for a measured factor of it.
        gravity
            Acceleration of gravity [m/s^2].

        Raises
        ------
        InputError
            As for `rectangle`; if `columns` or `cap_mass_ratio` is outside its range.

        References
        ----------
        N. Makris and M. F. Vassiliou, Earthquake Eng. Struct. Dyn. 42, 431-449 (2013).

        Examples
        --------
        >>> temple = Block.frame(columns=4, cap_mass_ratio=2.0, width=1.6, height=9.6)
        >>> print(f"{temple.p:.5f} rad/s, restitution {temple.restitution:.5f}")
        1.03904 rad/s, restitution 0.94788
        """
        column = cls.rectangle(width=width, height=height, restitution=1.0, gravity=gravity)
        return column.capped(
            columns=columns, cap_mass_ratio=cap_mass_ratio, restitution=restitution
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
        made = cls._symmetric(alpha, radius, restitution, gravity)
        question_millimetres({"radius": made.radius}, height=made.height)
        return made

    @classmethod
    def from_p(
        cls,
        *,
        alpha: float,
        p: Annotated[float, P],
        restitution: Restitution = "housner",
        gravity: Annotated[float, GRAVITY] = STANDARD_GRAVITY,
    ) -> "Block":
        """Return the homogeneous rectangle of slenderness `alpha` [rad] and parameter `p` [rad/s].

        Raises
        ------
        InputError
            As for `from_radius`; `p` must be a positive number.
        """
        return cls._symmetric(alpha, 0.75 * gravity / (p * p), restitution, gravity, p)

    @classmethod
    def general(
        cls,
        *,
        mass: Annotated[float, partial(positive, hint="give the mass in kg")],
        inertia: float,
        radius: float,
        alpha: float,
        height: float | None = None,
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
        height
            Full height [m], of the outline alone; default twice the height of the mass centre.
        restitution
            A ratio of angular velocities in (0, 1]; "housner" (default) for
            1 - 2 (M R^2 / I_0) sin^2 alpha, from angular momentum about the new pivot;
            ("housner", 0.965) for a measured factor of that.
        gravity
            Acceleration of gravity [m/s^2].

        Raises
        ------
        InputError
            As for `rectangle`, or if the mass centre is above the height.
        ModelError
            If the inertia is below M R^2, which no body has.
        """
        i = positive("inertia", inertia, hint="give the moment of inertia about a pivot in kg m^2")
        r = RADIUS("radius", radius)
        check_inertia(inertia, mass * r * r)
        g = GRAVITY("gravity", gravity)
        made = cls._symmetric(alpha, r, restitution, g, body_p(mass * g, r, i))
        question_millimetres({"radius": r}, height=made.height)
        return made if height is None else replace(made, outline=Outline(height=height))

    @classmethod
    def asymmetric(
        cls,
        *,
        left: float,
        right: float,
        height: Annotated[float, length("give the full height in metres")],
        mass_centre_height: float | None = None,
        gyration: float | None = None,
        restitution: Restitutions = "housner",
        gravity: float = STANDARD_GRAVITY,
    ) -> "Block":
        """Return a block whose mass centre need not be in the middle.

        Parameters
        ----------
        left, right
            Horizontal distances from the left and from the right edge to the mass centre [m].  The
            left edge is the pivot of positive rotation.
        height
            Full height [m].
        mass_centre_height
            Height of the mass centre above the base [m]; default half of `height`.
        gyration
            Radius of gyration about the mass centre, ``sqrt(I_c/M)`` [m].  Without, that of the
            homogeneous rectangle of this base and height, ``sqrt(((left + right)^2 +
            height^2)/12)``: what moves the mass centre is assumed to leave the moment of inertia
            about it as it was.
        restitution
            A ratio of angular velocities in (0, 1] for both impacts; a pair, for the impact that
            ends positive rotation and for the other; or "housner" (default), that of each impact
            which conserves angular momentum about the edge that is struck (`impact_restitution`),
            or ("housner", 0.965) for a measured factor of both.
        gravity
            Acceleration of gravity [m/s^2].

        Returns
        -------
        Block
            With ``left == right`` and neither `mass_centre_height` nor `gyration` it is
            ``Block.rectangle``, to the last bit.

        Raises
        ------
        InputError
            If a number is not positive, the mass centre is above the height, a restitution lies
            outside (0, 1], or one that follows from angular momentum is not positive (a block so
            stocky does not rock).

        Examples
        --------
        >>> block = Block.asymmetric(left=0.15, right=0.25, height=1.2)
        >>> for side in (block.positive, block.negative):
        ...     print(f"{side.alpha:.4f} rad, {side.p:.4f} rad/s, {side.restitution:.4f}")
        0.2450 rad, 3.4290 rad/s, 0.8201
        0.3948 rad, 3.3865 rad/s, 0.8837
        """
        twice, k = height, gyration
        if mass_centre_height is not None:
            hint = "give metres above the base, at most the full height"
            h = in_range("mass_centre_height", mass_centre_height, 0.0, height, "(]", hint=hint)
            twice = 2.0 * h
        if twice != height and k is None:
            k = math.sqrt(((left + right) * (left + right) + height * height) / 12.0)
        made = cls._asymmetric(left, right, twice, k, restitution, gravity)
        if left != right or k is None:  # else its radius has been questioned
            sizes = {"left": float(left), "right": float(right), "height": float(height)}
            question_millimetres(sizes, height=float(height))
        return replace(made, outline=Outline(height=height))

    @classmethod
    def from_alphas(
        cls,
        *,
        positive: Annotated[float, ALPHA],
        negative: Annotated[float, ALPHA],
        radius: float | None = None,
        p: float | None = None,
        gyration: float | None = None,
        restitution: Restitutions = "housner",
        gravity: float = STANDARD_GRAVITY,
    ) -> "Block":
        """Return a block by the critical angles of its sides and one length or rate.

        Parameters
        ----------
        positive, negative
            Slenderness of either side [rad].
        radius
            R of the positive side [m]; that of the other follows from the common height of the mass
            centre, ``R1 cos(alpha1) = R2 cos(alpha2)``.
        p
            Frequency parameter of the positive side [rad/s], in place of `radius`.
        gyration
            As for `asymmetric` [m]; not with `p`, which follows from it.
        restitution, gravity
            As for `asymmetric`.

        Raises
        ------
        InputError
            As for `asymmetric`; an angle must lie inside (0, pi/2).
        ModelError
            If not exactly one of `radius` and `p` is given, or `gyration` with `p`.

        Examples
        --------
        >>> block = Block.from_alphas(positive=0.2, negative=0.3, radius=1.0)
        >>> print(f"{block.negative.radius:.4f} m, {block.p:.4f} and {block.negative.p:.4f} rad/s")
        1.0259 m, 2.7041 and 2.6868 rad/s
        """
        check_one_size(radius=radius, p=p, gyration=gyration)
        if positive == negative and p is not None:
            return cls._alike(cls.from_p, restitution, gravity, alpha=positive, p=p)
        if positive == negative and radius is not None and gyration is None:
            return cls._alike(cls.from_radius, restitution, gravity, alpha=positive, radius=radius)
        g = GRAVITY("gravity", gravity)
        if radius is not None:
            r = RADIUS("radius", radius)
        else:
            assert p is not None
            r = radius_of_p(p, positive, negative, g)
        centre = r * cos(positive)
        left, right = r * sin(positive), centre * tan(negative)
        made = cls._asymmetric(left, right, 2.0 * centre, gyration, restitution, g)
        if radius is not None:
            question_millimetres({"radius": r}, height=made.height)
        return made

    @classmethod
    def _asymmetric(
        cls,
        left: float,
        right: float,
        height: float,
        gyration: float | None,
        restitution: Restitutions,
        gravity: float,
    ) -> "Block":
        """Return what `asymmetric` does, of whatever size."""
        b1, b2, h, k = lengths_of(left, right, height, gyration)
        g = GRAVITY("gravity", gravity)
        # A symmetric block is computed in one way, whichever constructor makes it.
        if b1 == b2 and k is None:
            radius, alpha = 0.5 * hypot(2.0 * b1, h), atan2(2.0 * b1, h)
            return cls._alike(cls._symmetric, restitution, g, alpha=alpha, radius=radius)
        if b1 == b2 and k is not None:
            radius = hypot(b1, 0.5 * h)
            sizes = {"radius": radius, "alpha": atan2(b1, 0.5 * h)}
            inertia = k * k + radius * radius
            return cls._alike(cls.general, restitution, g, mass=1.0, inertia=inertia, **sizes)
        positive, negative = sides_of_body(
            left=b1,
            right=b2,
            centre_height=0.5 * h,
            gyration=math.sqrt(((b1 + b2) * (b1 + b2) + h * h) / 12.0) if k is None else k,
            restitution=restitution,
            gravity=g,
        )
        factor = Impacts.of(restitution).noted
        return cls(positive=positive, negative=negative, gravity=g, housner_factor=factor)

    @classmethod
    def _alike(
        cls,
        make: Callable[..., "Block"],
        restitution: Restitutions,
        gravity: float,
        **sizes: float,
    ) -> "Block":
        """Return a symmetric block of a constructor, with one restitution or two."""
        impacts = Impacts.of(restitution)
        if impacts.factor is not None:
            return make(restitution=restitution, gravity=gravity, **sizes)
        pair = impacts.numbers
        return make(restitution=pair[0], gravity=gravity, **sizes).with_restitution(pair)

    @classmethod
    def _symmetric(
        cls,
        alpha: float,
        radius: float,
        restitution: Restitution,
        gravity: float,
        p: float | None = None,
    ) -> "Block":
        """Return the block whose sides are both made of these; without p a rectangle."""
        if p is None:
            radius, gravity = RADIUS("radius", radius), GRAVITY("gravity", gravity)
            p = rectangle_p(radius, gravity)
        angle = ALPHA("alpha", alpha)
        impacts = Impacts.of(restitution)
        if impacts.factor is None:
            ratio = impacts.given  # which its side checks
        else:
            ratio = impacts.times(housner_restitution(angle, p=p, radius=radius, gravity=gravity))
        side = Side(alpha=angle, radius=radius, p=p, restitution=ratio, gravity=gravity)
        return cls(positive=side, negative=side, gravity=gravity, housner_factor=impacts.noted)

    def capped(
        self, *, columns: int, cap_mass_ratio: float, restitution: Restitutions = "housner"
    ) -> "Block":
        """Return the rocking frame of which each column is this block.

        The cap stands on the upper corners, at `height`: the column's mass centre is in mid-height.
        With one column it is no frame but a body: this block with the cap as a point mass fixed on
        the middle of its top, which raises the mass centre and adds to the moment of inertia.

        Parameters
        ----------
        columns, cap_mass_ratio, restitution
            As for `frame`; the column's own restitution does not count.

        Raises
        ------
        InputError
            If one is outside its range, or columns so stocky do not rock.
        ModelError
            If the block is asymmetric, against a wall, of several parts, a frame already, or has
            its mass centre or outline off mid-height.

        Examples
        --------
        >>> cylinder = Block.named("gas-cylinder")
        >>> print(f"{cylinder.p:.3f}, {cylinder.capped(columns=3, cap_mass_ratio=0.5).p:.3f}")
        2.977, 2.665
        >>> pier = Block.rectangle(width=1.6, height=9.6).capped(columns=1, cap_mass_ratio=2.0)
        >>> print(f"mass centre at {pier.positive.centre_height:.3f} m, p {pier.p:.4f} rad/s")
        mass centre at 8.000 m, p 1.0436 rad/s
        """
        if not self.symmetric or self.cap is not None or self.parts:
            raise ModelError(
                "block",
                self,
                "the columns of a frame are single blocks whose sides are alike",
                "give such a block, as Block.rectangle(width=..., height=...)",
            )
        if COLUMNS("columns", columns) == 1:
            share, side = CAP_MASS("cap_mass_ratio", cap_mass_ratio), self.positive
            b, h, k = side.distance, side.centre_height, gyration_of(side, self.gravity)
            h, k = with_point_mass(h, k, share=share, at_height=self.height)
            pier = self._asymmetric(b, b, 2.0 * h, k, restitution, self.gravity)
            parts = f"pier with a point cap of {share:.4g} times its mass"
            return replace(pier, outline=self.outline, parts=parts)
        cap = Cap(columns=columns, cap_mass_ratio=cap_mass_ratio)
        side = cap.of_column(self.positive, self.gravity)
        if Impacts.of(restitution).factor is not None:
            words = f"with columns of alpha {side.alpha:.4g} rad the frame's restitution is"
            ratio = cap.housner_ratio(side, self.gravity)
            refuse_no_rocking("cap_mass_ratio", cap_mass_ratio, ratio, words)
        made = replace(self, positive=side, negative=side, housner_factor=None, cap=cap)
        return made.with_restitution(restitution)

    def against_wall(self, restitution: Restitution = "housner") -> "Block":
        """Return the block against a wall, which it leaves on its positive side alone.

        Its `restitution` is that of the wall; what its sides have does not count.

        Parameters
        ----------
        restitution
            Ratio of the angular velocities after and before an impact on the wall, in [0, 1]; 0 for
            a block that stays on the wall; "housner" (default) for that which conserves angular
            momentum on base, wall and base (`wall_ratio`), ("housner", 0.9) for a factor of that.

        Raises
        ------
        InputError
            If a restitution lies outside [0, 1], or the block is too stocky for "housner".

        Examples
        --------
        >>> facade = Block.rectangle(width=0.3, height=3.0).against_wall()
        >>> print(f"{facade.restitution:.4f}")
        0.4708
        """
        impacts = Impacts.of(restitution)
        if impacts.factor is None:
            ratio = restitution_of_wall("restitution", impacts.given)
        elif self.cap is not None:
            raise InputError(
                "restitution",
                "housner",
                "angular momentum gives none for a frame against a wall",
                "give the restitution as a number in [0, 1]",
            )
        else:
            ratio = impacts.times(wall_ratio(self.positive, self.negative, self.gravity))
        return replace(self, wall_restitution=ratio, housner_factor=impacts.noted)

    def with_restitution(self, restitution: Restitutions) -> "Block":
        """Return the block with other restitutions, as the constructors take them.

        Raises
        ------
        InputError
            If one lies outside (0, 1].
        """
        impacts = Impacts.of(restitution)
        if self.one_sided:
            return self.against_wall(impacts.of_wall)
        if impacts.factor is None:
            first, second = impacts.numbers
        else:
            values = conserving_pair(self.positive, self.negative, self.gravity, self.cap)
            first, second = map(impacts.times, values)
        positive = replace(self.positive, restitution=first)
        negative = replace(self.negative, restitution=second)
        return replace(self, positive=positive, negative=negative, housner_factor=impacts.noted)
