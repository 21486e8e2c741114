r"""Free rocking on a still base in closed form: period, decay, equivalent damping.

Of slender blocks (the linear model), or of a given slenderness by the full equations, with phi =
theta/alpha and time as p t.
"""

from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import checked_array
from rocksteady.kernels.elementary.arrays import asin, asinh, cos, exp, log, sin
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import ALPHA, RESTITUTION, WALL_RESTITUTION, Bounds, Whole

MOST_IMPACTS = 1_000_000

SLENDER = 1e-8
"""Slenderness [rad] up to which the full equations are the linear ones to the last digit."""

DUPLICATIONS = 16
"""Of an elliptic integral: enough for arguments as far apart as 1 and 1e32."""


BELOW_ALPHA = Bounds(0.0, 1.0, "[)", "give theta0/alpha, as 0.5")


@checked
def free_rocking_period(
    amplitude_ratio: ArrayLike, *, alpha: float | None = None, one_sided: bool = False
) -> Floats:
    r"""Return the period of free rocking at an amplitude, ``p T = 4 arccosh(1/(1 - phi0))``.

    A block let go at phi0 reaches its base after a quarter of it, and without loss comes back after
    all of it, or after half of it where a wall turns it back there.  The smaller the amplitude the
    shorter the period; towards 1 it grows without bound.

    For a slenderness alpha it is an elliptic integral.  With ``w0 = alpha (1 - phi0)`` the angle to
    the upright position at which the block is let go, energy gives ``dw/d(pt) = 2 sqrt(sin^2(w/2) -
    sin^2(w0/2))``, and in Carlson's symmetric form [2]_ ::

        p T = 4 X R_F(1, 1 + X^2 sin^2(w0/2), 1 + X^2),
        X = sqrt(sin^2(alpha/2) - sin^2(w0/2))/(sin(w0/2) cos(alpha/2)).

    Parameters
    ----------
    amplitude_ratio
        phi0 = theta0/alpha, in [0, 1).
    alpha
        Slenderness [rad], in (0, pi/2), for the full equations; left out, the block is slender
        (the linear model).
    one_sided
        Whether the block stands against a wall, which it leaves on one side alone (default False).

    Returns
    -------
    ndarray
        p T, in the shape of `amplitude_ratio`; over p it is in seconds.

    Raises
    ------
    InputError
        If an amplitude is outside [0, 1), or the slenderness outside (0, pi/2).

    References
    ----------
    .. [1] G. W. Housner, Bull. Seism. Soc. Am. 53, 403-417 (1963).
    .. [2] B. C. Carlson, Numerical computation of real or complex elliptic integrals, Numerical
       Algorithms 10, 13-26 (1995).

    Examples
    --------
    >>> free_rocking_period([0.1, 0.5, 0.9]).round(6)
    array([ 1.868581,  5.267832, 11.972891])
    >>> free_rocking_period([0.1, 0.5, 0.9], alpha=0.2).round(6)
    array([ 1.873831,  5.274018, 11.976509])
    >>> free_rocking_period([0.1, 0.5, 0.9], one_sided=True).round(5)
    array([0.93429, 2.63392, 5.98645])
    """
    flights = 1.0 if one_sided else 2.0  # each up and down again
    phi = checked_array("amplitude_ratio", amplitude_ratio, BELOW_ALPHA)
    if alpha is not None and ALPHA("alpha", alpha) > SLENDER:
        return 0.5 * flights * _tilting_period(phi, float(alpha))
    # arccosh(1/c) = arcsinh(sqrt(1 - c^2)/c), which keeps the digits of a small phi and of 1 - phi
    period: Floats = 2.0 * flights * asinh(np.asarray(np.sqrt(phi * (2.0 - phi)) / (1.0 - phi)))
    return period


@checked
def free_rocking_peaks(
    amplitude_ratio: Annotated[float, Bounds(0.0, 1.0, "[]", "give theta0/alpha, as 0.5")],
    restitution: float,
    impacts: int,
    *,
    alpha: float | None = None,
    one_sided: bool = False,
) -> Floats:
    r"""Return the decaying peaks of free rocking, impact by impact.

    Each impact keeps the part r = restitution^2 of the energy ``1 - (1 - phi)^2``, so that after n
    of them ``phi_n = 1 - sqrt(1 - r^n (1 - (1 - phi0)^2))``.  For a slenderness alpha the energy is
    ``cos(alpha (1 - phi)) - cos(alpha)``.

    Parameters
    ----------
    amplitude_ratio
        phi0 = theta0/alpha at which the block is let go, in [0, 1].
    restitution
        Ratio of angular velocities, in (0, 1]; the literature's r is its square.
    impacts
        Number of impacts, up to a million.
    alpha
        Slenderness [rad], in (0, pi/2), for the full equations; left out, the block is slender.
    one_sided
        Whether the block stands against a wall, whose restitution may be 0 (default False).

    Returns
    -------
    ndarray, shape (impacts + 1,)
        |theta|/alpha of the peaks, the first one phi0.

    Raises
    ------
    InputError
        If an argument is outside its range.

    References
    ----------
    G. W. Housner, Bull. Seism. Soc. Am. 53, 403-417 (1963).

    Examples
    --------
    >>> free_rocking_peaks(1.0, 0.7**0.5, 4).round(4)
    array([1.    , 0.4523, 0.2859, 0.1894, 0.1283])
    >>> free_rocking_peaks(1.0, 0.7**0.5, 4, alpha=0.5).round(4)
    array([1.    , 0.4563, 0.2895, 0.1924, 0.1305])
    >>> free_rocking_peaks(0.8, 0.5, 4, one_sided=True).round(4)
    array([0.8   , 0.1282, 0.0305, 0.0075, 0.0019])
    """
    ratio = (WALL_RESTITUTION if one_sided else RESTITUTION)("restitution", restitution)
    count = Whole(0, MOST_IMPACTS, "give a number of impacts")("impacts", impacts)
    kept = np.zeros(count + 1)
    kept[0] = 1.0
    if ratio > 0.0:
        kept = exp(2.0 * log(ratio) * np.arange(count + 1))
    with np.errstate(under="ignore"):  # the last peaks may be 0
        if alpha is not None and ALPHA("alpha", alpha) > SLENDER:
            return _tilting_peaks(amplitude_ratio, kept, float(alpha))
        energy = amplitude_ratio * (2.0 - amplitude_ratio) * kept
        # 1 - sqrt(1 - q) without its cancellation
        peaks: Floats = energy / (1.0 + np.sqrt(np.maximum(1.0 - energy, 0.0)))
        return peaks


@checked
def equivalent_damping(restitution: ArrayLike) -> Floats:
    r"""Return the damping ratio of an oscillator that decays about as fast as free rocking.

    ``beta = -0.34 ln(r)`` with r = restitution^2, the ratio of kinetic energies [2]_, a fit to the
    decay over several cycles that [1]_ draws.  It is a number of the literature that stands for a
    whole decay, not a property of the block: the two systems differ, and [2]_ warns of replacing
    one by the other.

    Parameters
    ----------
    restitution
        Ratio of angular velocities, in (0, 1].

    Returns
    -------
    ndarray
        beta, 1 being critical, in the shape of `restitution`.

    Raises
    ------
    InputError
        If a restitution is outside (0, 1].

    References
    ----------
    .. [1] M. J. N. Priestley, R. J. Evison and A. J. Carr, Bull. N. Z. Nat. Soc. Earthq. Eng. 11,
       141-150 (1978).
    .. [2] N. Makris and D. Konstantinidis, Earthq. Eng. Struct. Dyn. 32, 265-289 (2003).

    Examples
    --------
    >>> from math import radians
    >>> from rocksteady.formulas import housner_restitution
    >>> ratios = [housner_restitution(radians(angle)) for angle in (10, 15, 20)]
    >>> (100 * equivalent_damping(ratios)).round(3)
    array([ 3.147,  7.201, 13.12 ])
    """
    ratio = checked_array("restitution", restitution, RESTITUTION)
    damping: Floats = np.abs(-0.68 * log(ratio))  # of 1 it is 0, not -0
    return damping


def _tilting_period(phi: Floats, alpha: float) -> Floats:
    """Return the period by the full equations; the arguments are checked."""
    upright = sin(0.5 * alpha * (1.0 - phi))
    # sin^2(alpha/2) - sin^2(w0/2) as a product, which keeps the digits of a small phi
    reach = np.sqrt(sin(alpha * (1.0 - 0.5 * phi)) * sin(0.5 * alpha * phi))
    reach /= upright * cos(0.5 * alpha)
    tilted = reach * upright
    return 4.0 * reach * _elliptic(1.0 + tilted * tilted, 1.0 + reach * reach)


def _tilting_peaks(phi: float, kept: Floats, alpha: float) -> Floats:
    """Return the peaks by the full equations, from the parts of the energy that are kept."""
    sine, cosine = sin(0.5 * alpha), cos(0.5 * alpha)
    half_energy = sin(alpha * (1.0 - 0.5 * phi)) * sin(0.5 * alpha * phi) * kept
    # asin(sine) - asin(upright) as one, which keeps the digits of a small peak
    square = np.maximum(sine * sine - half_energy, 0.0)
    fall = half_energy / (sine * np.sqrt(1.0 - square) + np.sqrt(square) * cosine)
    peaks: Floats = 2.0 * asin(fall) / alpha
    return peaks


def _elliptic(y: Floats, z: Floats) -> Floats:
    """Return Carlson's symmetric elliptic integral R_F(1, y, z) by duplication [2]_ of the period.

    Each step leaves a quarter of the differences, of which the sixth power is neglected.
    """
    x = np.ones_like(y)
    for _ in range(DUPLICATIONS):
        root_x, root_y, root_z = np.sqrt(x), np.sqrt(y), np.sqrt(z)
        shared = root_x * root_y + root_y * root_z + root_z * root_x
        x, y, z = 0.25 * (x + shared), 0.25 * (y + shared), 0.25 * (z + shared)
    mean = (x + y + z) / 3.0
    u, v = 1.0 - x / mean, 1.0 - y / mean
    w = -u - v
    second, third = u * v - w * w, u * v * w
    series = second * (second / 24.0 - 0.1 - 3.0 * third / 44.0) + third / 14.0
    integral: Floats = (1.0 + series) / np.sqrt(mean)
    return integral
