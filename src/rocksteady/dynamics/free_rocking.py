r"""Free rocking on a still base in closed form: period, decay, equivalent damping.

All of the linear model, with phi = theta/alpha and time as p t.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.dynamics.grids import real_array
from rocksteady.errors import InputError
from rocksteady.model.block import restitution_value
from rocksteady.model.validation import in_range, whole_number

Floats = NDArray[np.float64]

MOST_IMPACTS = 1_000_000


def free_rocking_period(amplitude_ratio: ArrayLike) -> Floats:
    r"""Return the period of free rocking of an amplitude, ``p T = 4 arccosh(1/(1 - phi0))``.

    A block let go at phi0 reaches its base after a quarter of it, and without loss comes back after
    all of it.  The smaller the amplitude the shorter the period; towards 1 it grows without bound.

    Parameters
    ----------
    amplitude_ratio
        phi0 = theta0/alpha, in [0, 1).

    Returns
    -------
    ndarray
        p T, in the shape of `amplitude_ratio`; over p it is in seconds.

    Raises
    ------
    InputError
        If an amplitude is outside [0, 1).

    References
    ----------
    G. W. Housner, Bull. Seism. Soc. Am. 53, 403-417 (1963).

    Examples
    --------
    >>> free_rocking_period([0.1, 0.5, 0.9]).round(6)
    array([ 1.868581,  5.267832, 11.972891])
    """
    phi = real_array("amplitude_ratio", amplitude_ratio)
    for value in phi[~((phi >= 0.0) & (phi < 1.0))][:1].tolist():
        _ratio(value)
    # arccosh(1/(1 - phi)) = 2 artanh sqrt(phi/(2 - phi)), which keeps the digits of a small phi
    period: Floats = 8.0 * np.arctanh(np.sqrt(phi / (2.0 - phi)))
    return period


def free_rocking_peaks(amplitude_ratio: float, restitution: float, impacts: int) -> Floats:
    r"""Return how the peaks of free rocking decay from impact to impact.

    Each impact keeps the part r = restitution^2 of the energy ``1 - (1 - phi)^2``, so that after n
    of them ``phi_n = 1 - sqrt(1 - r^n (1 - (1 - phi0)^2))``.

    Parameters
    ----------
    amplitude_ratio
        phi0 = theta0/alpha at which the block is let go, in [0, 1].
    restitution
        Ratio of angular velocities, in (0, 1]; the literature's r is its square.
    impacts
        How many, up to a million.

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
    """
    hint = "give theta0/alpha, as 0.5"
    phi = in_range("amplitude_ratio", amplitude_ratio, 0.0, 1.0, "[]", hint=hint)
    ratio = restitution_value(restitution)
    hint = "give a number of impacts"
    count = whole_number("impacts", impacts, at_least=0, at_most=MOST_IMPACTS, hint=hint)
    energy = phi * (2.0 - phi) * ratio ** (2.0 * np.arange(count + 1))
    # 1 - sqrt(1 - q) without its cancellation
    peaks: Floats = energy / (1.0 + np.sqrt(np.maximum(1.0 - energy, 0.0)))
    return peaks


def equivalent_damping(restitution: ArrayLike) -> Floats:
    r"""Return the damping ratio of an oscillator that decays about as free rocking does.

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
    >>> from rocksteady import housner_restitution
    >>> ratios = [housner_restitution(radians(angle)) for angle in (10, 15, 20)]
    >>> (100 * equivalent_damping(ratios)).round(3)
    array([ 3.147,  7.201, 13.12 ])
    """
    ratio = real_array("restitution", restitution)
    for value in ratio[~((ratio > 0.0) & (ratio <= 1.0))][:1].tolist():
        restitution_value(value)
    damping: Floats = np.abs(-0.68 * np.log(ratio))  # of 1 it is 0, not -0
    return damping


def _ratio(value: object) -> None:
    """Refuse an amplitude outside [0, 1)."""
    hint = "give theta0/alpha, as 0.5"
    in_range("amplitude_ratio", value, 0.0, 1.0, "[)", hint=hint)
    raise InputError(name="amplitude_ratio", value=value, valid="it must be a number", hint=hint)
