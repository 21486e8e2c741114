"""Overturning mechanism of a facade: activation multiplier, capacity curve, equivalent block.

The runs are those of a block, not of a new equation: exact where all masses lie in line with the
hinge, accurate to the order of theta^2 elsewhere; in return every proof for blocks holds.  FC
divides the restoring moment of the runs, as it divides a0; in a0 alone it would not reach them.
"""

import itertools
import math
from dataclasses import dataclass
from typing import Annotated

from rocksteady.errors import InputError
from rocksteady.kernels.elementary.arrays import atan2, hypot
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.blocks.housner_forms import Impacts, Restitution, form_text
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.checks.validation import in_range, non_negative, positive
from rocksteady.results.numbers import angle, length, number
from rocksteady.results.result import Result
from rocksteady.results.words import Label

SHARE_SLV, SHARE_SLC = 0.4, 0.6
"""Displacement capacities d_SLV and d_SLC as shares of d0 (Circolare 2019 n. 7, C8.7.1.2.1)."""
FACTOR_SLV, FACTOR_SLC = 1.68, 1.56
"""Factors of the secant periods T_SLV and T_SLC (formulas C8.7.1.10 and C8.7.1.11)."""


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False)
class Mechanism(Result):
    """Overturning of a facade about a horizontal hinge, from `rocksteady.codes.Facade.mechanism`.

    Weights P move with the facade; masses Q push it horizontally without weighing on it.  With x
    inwards from the outer face, z above the hinge at x_h, ties T and thrusts H::

        M = sum P (x - x_h) + sum T z - sum H z        K = sum P z
        D = sum (P + Q) z      S = sum (P + Q) z^2     I = sum (P + Q) r^2 (of Q: z^2 alone)

    alpha_0 and a0 count all that acts at rest.  d0 counts only what is verified to act up to
    collapse: the capacity curve drops where an action ends.

    Parameters
    ----------
    name
        Name of the facade.
    stabilising_kn_m
        M, moment about the hinge that holds the facade [kN m].
    weight_moment_kn_m
        K, weights times heights [kN m].
    push_moment_kn_m
        D, weights and pushing masses times heights [kN m].
    push_kn
        Sum of weights and pushing masses [kN].
    second_moment_kn_m2
        S, weights and pushing masses times squared heights [kN m^2].
    lumped_moment_kn_m2
        S with the mass of each body at its centre [kN m^2].
    inertia_kn_m2
        I, moment of inertia about the hinge times gravity [kN m^2].
    compactness
        Weight times squared distance of its centre from the hinge, over I: 3/4 of a rectangle.
    confidence_factor
        FC, which divides the strength.
    one_sided
        Whether what stands behind stops the facade.
    restitution
        Restitution of the impacts on the building behind, or of two-sided rocking; "housner" or a
        number.
    free
        Whether it is an element free to vibrate; default False.
    elastic_period_s
        T0 of an element free to vibrate [s], which begins its capacity curve; default None.
    after
        Displacement [m] at which actions end, and the mechanism of the remaining ones, ascending;
        the last is of the actions verified up to collapse.  Default none ends.
    in_runs
        Mechanism of the runs: without what ends and holds the facade, with what ends and does not;
        default None, where it is the same.

    Examples
    --------
    >>> from rocksteady.codes import Facade
    >>> wall = Facade(name="wall", thickness_m=0.3, height_m=3.0, confidence_factor=1.0)
    >>> mechanism = wall.mechanism
    >>> print(f"{mechanism.a0_g:.6f} g, {mechanism.d0_m:.3f} m, {mechanism.t_slv_s:.6f} s")
    0.133333 g, 0.200 m, 1.685384 s
    """

    name: Annotated[str, Label("facade")]
    stabilising_kn_m: float
    weight_moment_kn_m: float
    push_moment_kn_m: float
    push_kn: float
    second_moment_kn_m2: float
    lumped_moment_kn_m2: float
    inertia_kn_m2: float
    compactness: float
    confidence_factor: Annotated[float, Label("confidence factor FC")]
    one_sided: bool
    restitution: Restitution = "housner"
    free: bool = False
    elastic_period_s: Annotated[
        float | None, Label("elastic period T0", unit="s", optional=True)
    ] = None
    after: tuple[tuple[float, "Mechanism"], ...] = ()
    in_runs: "Mechanism | None" = None

    @property
    def lasting(self) -> "Mechanism":
        """Mechanism of the actions that are verified up to collapse."""
        return self.after[-1][1] if self.after else self

    @property
    def rocking(self) -> "Mechanism":
        """Mechanism of the runs."""
        return self if self.in_runs is None else self.in_runs

    @property
    def alpha0(self) -> Annotated[float, Label("activation multiplier alpha_0 (1)", number)]:
        """Activation multiplier alpha_0 = M/D (C8.7.1.1)."""
        return self.stabilising_kn_m / self.push_moment_kn_m

    @property
    def uplift_g(self) -> Annotated[float, Label("uplift acceleration alpha_0 g", unit="g")]:
        """Base acceleration that lifts the facade with all that acts at rest, alpha_0 g [g]."""
        return self.alpha0

    @property
    def theta0_rad(self) -> Annotated[float, Label("slenderness of the block theta0", angle)]:
        """Rotation without restoring moment in runs, atan(M/K) [rad]."""
        rocking = self.rocking
        return float(atan2(rocking.stabilising_kn_m, rocking.weight_moment_kn_m))

    @property
    def e_star(self) -> Annotated[float, Label("e* (5), mass spread", number)]:
        """Participating mass fraction, e* = D^2/(sum(P + Q) S) (C8.7.1.5)."""
        push = self.push_moment_kn_m
        return push * push / (self.push_kn * self.second_moment_kn_m2)

    @property
    def e_star_lumped(self) -> Annotated[float, Label("e*, mass at the centres", number)]:
        """Participating mass fraction e* with the mass of each body at its centre."""
        return self.e_star * self.second_moment_kn_m2 / self.lumped_moment_kn_m2

    @property
    def mass_kg(self) -> Annotated[float, Label("participating mass", unit="kg")]:
        """Participating mass, D^2/(g S) [kg]."""
        push = self.push_moment_kn_m
        return 1e3 * push * push / (STANDARD_GRAVITY * self.second_moment_kn_m2)

    @property
    def a0_g(self) -> Annotated[float, Label("activation a0 (3), mass spread", unit="g")]:
        """Activation acceleration a0 = alpha_0 g/(e* FC) [g] (C8.7.1.3)."""
        return self.alpha0 / (self.e_star * self.confidence_factor)

    @property
    def a0_lumped_g(self) -> Annotated[float, Label("a0, mass at the centres", unit="g")]:
        """Activation acceleration with the mass of each body at its centre, up to `a0_g` [g]."""
        return self.alpha0 / (self.e_star_lumped * self.confidence_factor)

    @property
    def linear_g(self) -> Annotated[float, Label("capacity of the linear checks", unit="g")]:
        """Capacity of the linear checks [g]: alpha_0/FC if free to vibrate, else the smaller a0."""
        if self.free:
            return self.alpha0 / self.confidence_factor
        return min(self.a0_g, self.a0_lumped_g)

    @property
    def linear_name(self) -> str:
        """Symbol of the capacity of the linear checks: "alpha_0 g/FC" or "min a0"."""
        return "alpha_0 g/FC" if self.free else "min a0"

    @property
    def arm_m(self) -> Annotated[float, Label("height of the displacement d", length)]:
        """Height of the displacement d, S/D [m]: 2/3 of the height of a rectangle."""
        lasting = self.lasting
        return lasting.second_moment_kn_m2 / lasting.push_moment_kn_m

    def _zero_m(self, arm_m: float) -> float:
        """Return the displacement at a height at which the moment of these actions is zero."""
        return self.stabilising_kn_m / self.weight_moment_kn_m * arm_m

    @property
    def d0_m(self) -> Annotated[float, Label("displacement of zero capacity d0", length)]:
        """Displacement of zero capacity up to collapse [m]: 2 t/3 of a rectangle."""
        arm, stages = self.arm_m, ((0.0, self), *self.after)
        zeros = [self.lasting._zero_m(arm)]
        for (start, stage), (end, _) in itertools.pairwise(stages):
            zero = stage._zero_m(arm)
            if zero < end:
                zeros.append(max(zero, start))
        return min(zeros)

    @property
    def run_d0_m(self) -> float:
        """Displacement of the rotation theta0 of the runs [m]; at most `d0_m`."""
        return self.rocking._zero_m(self.arm_m)

    @property
    def d_slv_m(self) -> Annotated[float, Label("d_SLV = 0.4 d0", length)]:
        """Displacement capacity of SLV, 0.4 d0 [m]."""
        return SHARE_SLV * self.d0_m

    @property
    def d_slc_m(self) -> Annotated[float, Label("d_SLC = 0.6 d0", length)]:
        """Displacement capacity of SLC, 0.6 d0 [m]."""
        return SHARE_SLC * self.d0_m

    @property
    def t_slv_s(self) -> Annotated[float, Label("secant period T_SLV (10)", unit="s")]:
        """Secant period of SLV [s] (C8.7.1.10)."""
        return self.period_s(SHARE_SLV, FACTOR_SLV)

    @property
    def t_slc_s(self) -> Annotated[float, Label("secant period T_SLC (11)", unit="s")]:
        """Secant period of SLC [s] (C8.7.1.11)."""
        return self.period_s(SHARE_SLC, FACTOR_SLC)

    @property
    def p_rad_s(self) -> Annotated[float, Label("frequency parameter p, with FC", unit="rad/s")]:
        """Frequency parameter of the equivalent block, sqrt(g sqrt(M^2 + K^2)/(I FC)) [rad/s]."""
        block = self.rocking
        moment = hypot(block.stabilising_kn_m, block.weight_moment_kn_m)
        return math.sqrt(STANDARD_GRAVITY * moment / (block.inertia_kn_m2 * self.confidence_factor))

    @property
    def base_factor(self) -> Annotated[float, Label("factor of the base acceleration, with FC")]:
        """Factor of the base acceleration of the equivalent block, (D/K) FC."""
        block = self.rocking
        return block.push_moment_kn_m / block.weight_moment_kn_m * self.confidence_factor

    @property
    def run_activation_g(
        self,
    ) -> Annotated[float, Label("activation acceleration of the runs, with FC", unit="g")]:
        """Base acceleration from which the block of the runs moves, tan(theta0)/lambda [g]."""
        return self.rocking.alpha0 / self.confidence_factor

    def capacity_g(self, displacement_m: float) -> float:
        """Return the capacity a(d) = a0 (1 - d/d0) of what acts at d [g], below 0 beyond d0.

        At d = 0 all acts; what is not verified has ended at any d above 0.  The curve of an element
        free to vibrate begins with (2 pi/T0)^2 d (C8.7.1.6).

        Raises
        ------
        InputError
            If the displacement is no finite number of 0 or above.
        """
        hint = "give the displacement in metres"
        distance = non_negative("displacement_m", displacement_m, hint=hint)
        if distance >= self.d0_m:
            return self.lasting.a0_g * (1.0 - distance / self.d0_m)
        ended = [each for start, each in self.after if 0.0 < distance >= start]
        stage = ended[-1] if ended else self
        rigid = stage.a0_g * (1.0 - distance / stage._zero_m(self.arm_m))
        if self.elastic_period_s is None:
            return rigid
        rate = 2.0 * math.pi / self.elastic_period_s
        return min(rigid, rate * rate * distance / STANDARD_GRAVITY)

    @property
    def curve(self) -> tuple[tuple[float, float], ...]:
        """Corners of the capacity curve from d = 0 to d0: displacement [m], capacity [g]."""
        d0, arm = self.d0_m, self.arm_m
        points = [(0.0, self.capacity_g(0.0))]
        least = 1e-9 * self.a0_g  # what rounding leaves at d0
        for end, _ in (*self.after, (d0, self)):
            if end <= d0:
                sides = (math.nextafter(end, 0.0), math.nextafter(end, d0))
                heights = (self.capacity_g(side) for side in sides)
                points += [(end, each if each > least else 0.0) for each in heights]
        if self.elastic_period_s is not None:
            angular = 2.0 * math.pi / self.elastic_period_s
            rate = angular * angular / STANDARD_GRAVITY
            for stage in (self, *(each for _, each in self.after)):
                place = stage.a0_g / (rate + stage.a0_g / stage._zero_m(arm))
                points += [(place, self.capacity_g(place))] if place < d0 else []
        return tuple(dict.fromkeys(sorted(points, key=lambda point: point[0])))

    def period_s(self, share: float, factor: float) -> float:
        """Return a secant period, factor pi sqrt(d/a(d)) [s], at a share of d0 in (0, 1).

        Raises
        ------
        InputError
            If the share lies outside (0, 1), or the factor is not positive.
        """
        part = in_range("share", share, 0.0, 1.0, "()", hint="give d/d0, as 0.4")
        times = positive("factor", factor, hint="give the factor of pi, as 1.68")
        distance = part * self.d0_m
        return (
            times * math.pi * math.sqrt(distance / (STANDARD_GRAVITY * self.capacity_g(distance)))
        )

    def block(self) -> Block:
        """Return the equivalent block: alpha = theta0, p of the mechanism with FC.

        The base acceleration of a run is `base_factor` times that of the ground; a rotation theta
        is the displacement `run_d0_m` theta/theta0.  Exact where all masses are in line with the
        hinge and no tie, thrust or pushing mass acts, else to the order of theta^2.

        Raises
        ------
        InputError
            If the facade is too stocky for a restitution "housner".
        """
        alpha, rate = self.theta0_rad, self.p_rad_s
        compactness = self.rocking.compactness
        radius = compactness * STANDARD_GRAVITY / (rate * rate)
        try:
            made = Block.general(
                mass=1.0,
                inertia=radius * radius / compactness,
                radius=radius,
                alpha=alpha,
                restitution="housner" if self.one_sided else self.restitution,
            )
            return made.against_wall(self.restitution) if self.one_sided else made
        except InputError as error:
            factor = Impacts.of(self.restitution).factor
            raise InputError(
                "restitution",
                self.restitution if factor is None else form_text(factor),
                f"{self.name} has theta0 = {math.degrees(alpha):.3g} degrees: {error.valid}",
                "give the restitution as a number, or check the ties",
            ) from None
