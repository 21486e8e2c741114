"""ASCE 43-05, Appendix A.2: rocking of an unanchored body against a response spectrum, all roots.

The capacity at a rotation t and the effective frequency there are

- ``f1 = cos t + a sin t``, ``SA_cap = 2 g (f1 - 1)/(F_v t)``, ``F_v = sqrt(1 + (a SA_V/SA_H)^2)``;
- ``f_e = sqrt(2 g (f1 - 1)/(C_I h t^2))/(2 pi)``, ``C_I = (4/3)(1 + a^2)``;
- ``C_R = 1 - 2 a^2/C_I`` (Housner's restitution), ``gamma = -2 ln C_R``,
  ``beta_e = gamma/sqrt(4 pi^2 + gamma^2)``;

and t solves SA_H(f_e, beta_e) = SA_cap.  a is tan(alpha), h the height of the mass centre.

**No root is missed.**  The demand is a chain of power laws S = c T^m in the period T = 1/f_e.
On (0, alpha) both T and the elasticity e(t) = t f1'/(f1 - 1) are monotone: T rises, and e falls
from 1 to 0, since ``f1 - 1 = 2 sin(t/2) sin(alpha - t/2)/cos(alpha)`` gives ``e = (t/2) cot(t/2) -
(t/2) cot(alpha - t/2)``, a falling term less a rising one.  With y = (f1 - 1)/t and T^2
proportional to t/y the distance d = ln SA_cap - ln S has the slope ``t d' = (1 + m/2)(e - 1) -
m/2`` on one power law, which is zero where e = 1 + m/(2 + m): once at most, and only for
-1 < m < 0.  Cut there, and at the ends of each power law, (0, alpha) falls into pieces on which d
is monotone: each has one root where d changes its sign, and none where it does not.
"""

import functools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rocksteady.kernels.elementary.arrays import cos, sin, tan
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.blocks.sides import Side
from rocksteady.results.numbers import number, quantity
from rocksteady.risk.screens._rows import Case
from rocksteady.risk.screens.screen import Screen
from rocksteady.risk.spectra.tabulated import Chain, HeaderDamping, spectrum_of

LEAST = 1e-9
"""Of alpha: rotations below it are not looked at; capacity and demand do not change there."""


@dataclass(frozen=True)
class RockingBody:
    """What the appendix sees of a block: its slenderness, size, inertia and gravity.

    Attributes
    ----------
    alpha
        Critical angle [rad].
    height_m
        Height of the mass centre h [m].
    inertia
        C_I = I_0/(M h^2), about the edge.
    gravity
        Acceleration of gravity [m/s^2].
    vertical_ratio
        SA_V/SA_H.
    """

    alpha: float
    height_m: float
    inertia: float
    gravity: float
    vertical_ratio: float = 0.0

    @classmethod
    def of_side(cls, side: Side, gravity: float, vertical_ratio: float) -> "RockingBody":
        """Return that of a block's side, with its own inertia: of a rectangle (4/3)(1 + a^2)."""
        height = side.centre_height
        inertia = gravity * side.radius / (side.p * side.p * height * height)
        return cls(side.alpha, height, inertia, gravity, vertical_ratio)

    @property
    def restitution(self) -> float:
        """C_R, the restitution."""
        slope = tan(self.alpha)
        return 1.0 - 2.0 * slope * slope / self.inertia

    @property
    def damping(self) -> float:
        """beta_e, the effective damping, 1 being critical."""
        gamma = -2.0 * math.log(self.restitution)
        return gamma / math.hypot(2.0 * math.pi, gamma)

    @functools.cached_property
    def vertical_factor(self) -> float:
        """F_v, by which the vertical motion lowers the capacity."""
        return math.hypot(1.0, tan(self.alpha) * self.vertical_ratio)

    def rise(self, t: float) -> float:
        """Return f1 - 1, the rise of the mass centre over its height, without cancellation."""
        return 2.0 * sin(0.5 * t) * sin(self.alpha - 0.5 * t) / cos(self.alpha)

    def capacity_m_s2(self, t: float) -> float:
        """Return SA_cap [m/s^2] at a rotation [rad]."""
        return 2.0 * self.gravity * self.rise(t) / (self.vertical_factor * t)

    def frequency_hz(self, t: float) -> float:
        """Return f_e [Hz] at a rotation [rad]."""
        stiffness = 2.0 * self.gravity * self.rise(t) / (self.inertia * self.height_m)
        return math.sqrt(stiffness) / (2.0 * math.pi * t)

    def elasticity(self, t: float) -> float:
        """Return t f1'/(f1 - 1), which falls from 1 to 0 on (0, alpha)."""
        half = 0.5 * t
        return half * (cos(half) / sin(half) - cos(self.alpha - half) / sin(self.alpha - half))


@dataclass(frozen=True)
class Rotations:
    """All rotations at which capacity and demand are equal.

    Attributes
    ----------
    roots_rad
        They, ascending [rad].
    examined_rad
        The largest rotation that the spectrum reaches [rad]; alpha where it reaches all.
    above_at_end
        Whether the demand exceeds the capacity there.
    """

    roots_rad: tuple[float, ...]
    examined_rad: float
    above_at_end: bool


def find_rotations(body: RockingBody, demand: Chain) -> Rotations:
    """Return every root of SA_H(f_e(t), beta_e) = SA_cap(t) on (0, alpha].

    Parameters
    ----------
    body
        The body.
    demand
        Its spectrum at the effective damping, in m/s^2.
    """
    ends = _cuts(body, demand)

    def distance(t: float) -> float:
        return math.log(body.capacity_m_s2(t)) - math.log(demand.at(1.0 / body.frequency_hz(t)))

    values = [distance(t) for t in ends]
    roots: list[float] = []
    for i in range(len(ends) - 1):
        if values[i] * values[i + 1] < 0.0:
            roots.append(_root(distance, ends[i], ends[i + 1]))
        elif values[i + 1] == 0.0:
            roots.append(ends[i + 1])
    return Rotations(tuple(roots), ends[-1], above_at_end=values[-1] < 0.0)


def _cuts(body: RockingBody, demand: Chain) -> list[float]:
    """Return the rotations between which the distance of capacity and demand is monotone."""
    first = LEAST * body.alpha
    last = _rotation_of(body, demand.last_s, first)
    cuts = [first]
    for end_s, power in demand.pieces():
        low, high = cuts[-1], min(_rotation_of(body, end_s, first), last)
        if -1.0 < power < 0.0:
            level = 1.0 + power / (2.0 + power)
            if body.elasticity(low) > level > body.elasticity(high):
                cuts.append(_turn(body, level, low, high))
        if high > cuts[-1]:
            cuts.append(high)
    return cuts


def _turn(body: RockingBody, level: float, low: float, high: float) -> float:
    """Return the rotation at which the elasticity has a level."""
    return _root(lambda t: body.elasticity(t) - level, low, high)


def _rotation_of(body: RockingBody, period_s: float, first: float) -> float:
    """Return the rotation whose effective period is a given one; alpha where all are shorter."""
    if period_s * body.frequency_hz(body.alpha) >= 1.0:
        return body.alpha
    if period_s * body.frequency_hz(first) <= 1.0:
        return first
    return _root(lambda t: period_s * body.frequency_hz(t) - 1.0, first, body.alpha)


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    """Return the root of a function between two points where its signs differ."""
    from scipy.optimize import brentq

    root: float = brentq(function, low, high, xtol=1e-15 * low, rtol=1e-14, maxiter=500)
    return root


MOST_SHOWN = 3
"""Largest number of roots that a text lists."""


def rotations_text(roots_rad: Sequence[float]) -> str:
    """Return rotations as people read them.

    Examples
    --------
    >>> rotations_text((0.02, 0.1))
    '0.02 and 0.1 rad'
    >>> rotations_text((0.001, 0.002, 0.02, 0.05, 0.1))
    '5 angles from 0.001 to 0.1 rad'
    """
    if len(roots_rad) > MOST_SHOWN:
        return f"{len(roots_rad)} angles from {roots_rad[0]:.3g} to {roots_rad[-1]:.3g} rad"
    return " and ".join(f"{root:.3g}" for root in roots_rad) + " rad"


def asce_row(case: Case) -> Screen:
    """Return the row of ASCE 43-05, Appendix A.2, with all roots."""
    demand = case.demand
    ratio = demand.spectral_ratio
    body = RockingBody.of_side(case.side, case.block.gravity, ratio or 0.0)
    screen = functools.partial(
        case.rocking,
        name="ASCE 43-05 rocking",
        made_for="nuclear facilities",
        equation="A.2, A-5 on",
        edition="ASCE/SEI 43-05",
        source="ASCE/SEI 43-05, Appendix A.2, approximate method for rocking of an unanchored "
        "rigid body",
        unit="rad",
    )
    if body.restitution <= 0.0:
        return screen(value=None, no_answer="no answer: restitution below 0")
    longest = 1.0 / body.frequency_hz(body.alpha)
    constants = [
        ("C_I", body.inertia, ""),
        ("C_R", body.restitution, ""),
        ("beta_e", body.damping, ""),
        ("period at alpha", longest, "s"),
    ]
    spectrum = spectrum_of(demand.spectrum, demand.spectrum_damping)
    if spectrum is None or ratio is None:
        verdict, needs = "needs a PGA or SA_V/SA_H", "pga_g or sa_v_per_sa_h"
        if demand.spectrum is None:
            verdict, needs = "needs a spectrum with its damping", "spectrum, spectrum_damping"
        elif spectrum is None:
            verdict, needs = "needs its damping", "spectrum_damping"
        details = tuple(constants)
        return screen(value=None, verdict=verdict, needs=needs, details=details, answered=False)
    constants += [("SA_V/SA_H", ratio, ""), ("F_v", body.vertical_factor, "")]
    chain, how = spectrum.at_damping(body.damping, longest)
    if isinstance(demand.spectrum_damping, HeaderDamping):
        given = " and ".join(f"{100.0 * each:.3g} %" for each in demand.spectrum_damping)
        how += f"; {given} by its header"
    rotations = find_rotations(body, chain)
    for root in rotations.roots_rad:
        constants += [
            ("root", root, "rad"),
            ("f_e at the root", body.frequency_hz(root), "Hz"),
            ("SA_cap at the root", body.capacity_m_s2(root) / STANDARD_GRAVITY, "g"),
        ]
    verdict, passes, needs = _verdict(body, rotations, longest)
    value = rotations.roots_rad[-1] if rotations.roots_rad else None
    remark = "A.2 calls its angle a best estimate: the row passes up to alpha, with no margin."
    remark += " The spectrum is a power law between its points."
    if value is not None:
        remark += f" Roots at {rotations_text(rotations.roots_rad)}; the largest is shown."
    if rotations.examined_rad < body.alpha:
        remark += (
            f" It ends at {number(chain.last_s)} s: up to {number(rotations.examined_rad)} rad."
        )
    if ratio or demand.vertical_g:
        how_much = "that of the peaks" if demand.sa_v_per_sa_h is None else "as stated"
        remark += f" Vertical motion: F_v with SA_V/SA_H {number(ratio)}, {how_much}."
    return screen(
        value=value,
        verdict=verdict if needs else f"{verdict}; {how}",
        passes=passes,
        counts_vertical=demand.vertical_g > 0.0 and demand.sa_v_per_sa_h is None,
        needs=needs,
        details=tuple(constants),
        remark=remark,
        answered=not needs,
    )


def _verdict(
    body: RockingBody, rotations: Rotations, longest: float
) -> tuple[str, bool | None, str]:
    """Return the words, whether it passes, and what is missing."""
    complete = rotations.examined_rad >= body.alpha
    if not complete and (rotations.above_at_end or not rotations.roots_rad):
        return f"needs a spectrum up to {number(longest)} s", None, "spectrum"
    if not rotations.roots_rad:
        if rotations.above_at_end:
            return "overturns: no root, demand above capacity", False, ""
        return "does not overturn: no root, capacity above demand", True, ""
    largest = quantity(rotations.roots_rad[-1] / body.alpha, "alpha")
    if rotations.above_at_end:
        return f"may overturn beyond {largest}", False, ""
    return f"rocks up to {largest}", True, ""
