"""Closed formulas of thresholds: Ishiyama, Kaneko and Hayashi, the Circolare, and the impulse."""

import math
from dataclasses import dataclass

from rocksteady.kernels.elementary.arrays import cos, sin, tan
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.blocks.sides import Side

CENTIMETRES = 100.0
"""In a metre."""


def impulse_velocity_m_s(side: Side, gravity: float) -> float:
    """Return V_i [m/s], the sudden velocity of the base that just topples a block at rest.

    Angular momentum about the edge, I_0 omega = M V R cos(alpha), and energy, I_0 omega^2/2 =
    M g R (1 - cos(alpha)), give V_i = 2 g sin(alpha/2)/(p cos(alpha)) for any mass distribution; of
    a rectangle that is ``sqrt(8 g R/3 (1 - cos alpha))/cos alpha``.  For
    slender blocks PGV/V_i tends to p PGV/(g tan alpha).

    Examples
    --------
    >>> from rocksteady import Block
    >>> block = Block.rectangle(width=0.32, height=1.8)
    >>> print(f"{impulse_velocity_m_s(block.positive, block.gravity):.4f}")
    0.6170
    """
    return 2.0 * gravity * sin(0.5 * side.alpha) / (side.p * cos(side.alpha))


@dataclass(frozen=True, kw_only=True)
class IshiyamaBounds:
    """Least peak acceleration [g] and velocity [m/s] under which a block overturned.

    Attributes
    ----------
    pga_g, pgv_m_s
        (B/H) g and 0.4 V_i.
    simple_m_s
        His simple rule for rectangles, 10 B/sqrt(H) in cm and cm/s.
    """

    pga_g: float
    pgv_m_s: float
    simple_m_s: float


def ishiyama_bounds(side: Side, gravity: float) -> IshiyamaBounds:
    """Return the lower bounds of Ishiyama (1982) for overturning.

    Overturning needs PGA >= (B/H) g and PGV >= 0.4 V_i, with ``V_i = sqrt(8 g R/3 (1 -
    cos alpha))/cos alpha``.  B/H is tan(alpha), and V_i that of the block's own inertia.  The
    simple rule is 2.2 % below that of a slender rectangle, 3.5 % below at B/H = .18.

    References
    ----------
    Y. Ishiyama, Earthq. Eng. Struct. Dyn. 10, 635-650 (1982).
    """
    depth = CENTIMETRES * 2.0 * side.distance
    return IshiyamaBounds(
        pga_g=gravity * tan(side.alpha) / STANDARD_GRAVITY,
        pgv_m_s=0.4 * impulse_velocity_m_s(side, gravity),
        simple_m_s=10.0 * depth / math.sqrt(CENTIMETRES * 2.0 * side.centre_height) / CENTIMETRES,
    )


@dataclass(frozen=True, kw_only=True)
class KanekoHayashi:
    """Floor motion under which half of such blocks overturn.

    Attributes
    ----------
    acceleration_g, velocity_m_s
        A50 [g] and V50 [m/s].
    limit_hz
        Fe [Hz], below which the acceleration decides.
    """

    acceleration_g: float
    velocity_m_s: float
    limit_hz: float

    def threshold_g(self, frequency_hz: float) -> float:
        """Return the peak acceleration [g] at a frequency of the floor: A50, or 2 pi F V50."""
        if frequency_hz <= self.limit_hz:
            return self.acceleration_g
        return 2.0 * math.pi * frequency_hz * self.velocity_m_s / STANDARD_GRAVITY


def kaneko_hayashi(side: Side, gravity: float) -> KanekoHayashi:
    """Return the 50 % overturning threshold of Kaneko and Hayashi.

    ``A50 = (B/H) g (1 + B/H)``, ``V50 = 10 (B/sqrt H)(1 + B/H)^2.5`` and ``Fe = 15.6/sqrt(H)
    (1 + B/H)^-1.5``, with the full depth B and height H in cm, V50 in cm/s and Fe in Hz.
    The three agree, 2 pi Fe V50 = .9995 A50.  B and H are twice the distance from the mass centre
    to the edge and to the base.

    References
    ----------
    M. Kaneko and Y. Hayashi, 13th World Conf. Earthq. Eng., Vancouver (2004).
    """
    depth = CENTIMETRES * 2.0 * side.distance
    height = CENTIMETRES * 2.0 * side.centre_height
    ratio = depth / height
    return KanekoHayashi(
        acceleration_g=ratio * gravity / STANDARD_GRAVITY * (1.0 + ratio),
        velocity_m_s=10.0 * depth / math.sqrt(height) * (1.0 + ratio) ** 2.5 / CENTIMETRES,
        limit_hz=15.6 / math.sqrt(height) * (1.0 + ratio) ** -1.5,
    )


@dataclass(frozen=True, kw_only=True)
class CircolareRectangle:
    """A rectangle that rocks about its edge, after C8.7.1 of the Circolare 2019 n. 7.

    Attributes
    ----------
    a0_g, a0_lumped_g
        Acceleration that activates the mechanism, with e* = 0.75 and with e* = 1 [g].
    d0_m
        Displacement of the control point at which the capacity is zero [m].
    d_slv_m, d_slc_m
        Its limits 0.4 d0 and 0.6 d0 [m].
    t_slv_s, t_slc_s
        Their secant periods [s].
    """

    a0_g: float
    a0_lumped_g: float
    d0_m: float
    d_slv_m: float
    d_slc_m: float
    t_slv_s: float
    t_slc_s: float


def circolare_rectangle(
    side: Side, gravity: float, confidence_factor: float = 1.0
) -> CircolareRectangle:
    """Return activation, limits and secant periods of a rectangle on its edge (C8.7.1).

    alpha_0 = t/h, ``e* = 0.75``, ``a0 = alpha_0 g/(e* FC)`` (3), ``d0 = 2 t/3``, d_SLV = .4 d0,
    d_SLC = .6 d0, ``T_SLV = 1.68 pi sqrt(d_SLV/a(d_SLV))`` (10), ``T_SLC = 1.56 pi
    sqrt(d_SLC/a(d_SLC))`` (11), with ``a(d) = a0 (1 - d/d0)``.  The second bullets of both limits
    could not be read.  With the mass at its centre e* is 1, and a0 FC the acceleration g t/h that
    lifts a rigid rectangle; with the mass spread it is 4/3 of that.

    Parameters
    ----------
    side
        Its thickness t is twice the distance from edge to mass centre, its h twice the height of
        that.
    gravity
        Acceleration of gravity [m/s^2].
    confidence_factor
        FC, from 1 (full knowledge) to 1.35.
    """
    thickness = 2.0 * side.distance
    activation = tan(side.alpha) * gravity / (0.75 * confidence_factor)
    d0 = 2.0 * thickness / 3.0
    slv, slc = 0.4 * d0, 0.6 * d0
    return CircolareRectangle(
        a0_g=activation / STANDARD_GRAVITY,
        a0_lumped_g=0.75 * activation / STANDARD_GRAVITY,
        d0_m=d0,
        d_slv_m=slv,
        d_slc_m=slc,
        t_slv_s=1.68 * math.pi * math.sqrt(slv / (activation * 0.6)),
        t_slc_s=1.56 * math.pi * math.sqrt(slc / (activation * 0.4)),
    )


MEDIAN, BETA = 0.757, 0.592
"""Median and beta of p PGV/(g tan alpha), from 28,399 classified runs (Chu et al. 2025).

Over 49 motions measured on shaking tables runs give 1.10 and 0.57: the median is that of motions.
"""
OTHER_MEDIAN, OTHER_BETA = 0.672, 0.462
"""The same of nonlinear runs of this package on 56 records."""
SAMPLED_ALPHA, SAMPLED_P = (0.1, 0.3), (1.0, 3.0)
"""Ranges of alpha [rad] and p [rad/s] of these runs."""


def velocity_number(side: Side, gravity: float, pgv_m_s: float) -> float:
    """Return p PGV/(g tan alpha), about PGV/V_i for slender blocks.

    Checked on open data and on runs of this package (`shares_at`).

    References
    ----------
    Y. W. Chu, A. I. Giouvanidis, C. N. Loong and E. G. Dimitrakopoulos, Earthq. Eng. Struct. Dyn.
    54, 3576 (2025), doi 10.1002/eqe.70042.
    """
    return side.p * pgv_m_s / (gravity * tan(side.alpha))


def shares_at(number: float) -> tuple[float, float]:
    """Return the probability that a block that lifts falls, of both sources.

    Parameters
    ----------
    number
        p PGV/(g tan alpha).

    Examples
    --------
    >>> [round(share, 4) for share in shares_at(0.757)]
    [0.5, 0.6017]
    """
    pairs = ((MEDIAN, BETA), (OTHER_MEDIAN, OTHER_BETA))
    published, ours = (normal_share(math.log(number / median) / beta) for median, beta in pairs)
    return published, ours


def sampled(side: Side) -> bool:
    """Return whether runs of this package have the alpha and p of a block's side."""
    sizes = ((side.alpha, SAMPLED_ALPHA), (side.p, SAMPLED_P))
    return all(low <= size <= high for size, (low, high) in sizes)


def normal_share(deviations: float) -> float:
    """Return the standard normal distribution at a number of deviations from the median.

    Examples
    --------
    >>> print(f"{normal_share(0.0)} {normal_share(1.0):.6f}")
    0.5 0.841345
    """
    return 0.5 * math.erfc(-deviations / math.sqrt(2.0))
