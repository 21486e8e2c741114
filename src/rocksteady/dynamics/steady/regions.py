"""Boundaries of the regions of symmetric steady states, in the plane of frequency and amplitude.

They are the curves along which these states begin to exist, change kind and lose symmetry, and the
one along which the stable and unstable manifolds of the upright saddles first touch.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import order_of_orbit, real_array, validated_grid
from rocksteady.kernels.elementary.arrays import exp, log
from rocksteady.kernels.elementary.roots import root
from rocksteady.kernels.orbits.closed_form import fill_curves, symmetry_breaking
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import RESTITUTION
from rocksteady.model.checks.validation import LARGEST, in_range
from rocksteady.model.equations import OfLinear
from rocksteady.results.result import Result

BOUNDARIES = ("existence", "sign", "kind")
"""Names of the boundaries of the regions."""
REGIONS = {
    1: "one out-of-phase and one in-phase solution, both with positive phase",
    2: "one out-of-phase solution; the in-phase one has negative phase and is inadmissible",
    3: "two in-phase solutions, both with positive phase",
    4: "no symmetric solution",
    5: "two in-phase solutions; the one with negative phase is inadmissible",
}
"""What Tso and Wong's regions hold (Figs 3 and 4), as the computation finds it."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class RegionBoundaries(OfLinear, Result):
    """Amplitudes that bound the regions, as arrays of the inputs' broadcast shape.

    Attributes
    ----------
    existence
        Eq 23: the least amplitude with a symmetric solution.
    sign
        Eq 24, P = Q: above it the phase of branch 2 is negative.
    kind
        Eq 25, Q = 1: above it branch 1 is out of phase.
    frequency_ratio, restitution, order
        The inputs, broadcast against each other.

    Examples
    --------
    >>> from rocksteady.orbits import compute_region_boundaries
    >>> found = compute_region_boundaries(4.0, 0.8)
    >>> print(f"{found.existence:.4f} {found.kind:.4f} {found.sign:.4f}")
    0.2602 0.2638 1.5882
    """

    existence: Floats
    sign: Floats
    kind: Floats
    frequency_ratio: Floats
    restitution: Floats
    order: NDArray[np.int64]


@checked
def compute_region_boundaries(
    frequency_ratio: ArrayLike, restitution: ArrayLike, *, order: ArrayLike = 1
) -> RegionBoundaries:
    """Return the three boundary curves of the regions (eqs 23, 24, 25).

    Parameters
    ----------
    frequency_ratio, restitution, order
        Arrays that broadcast: Omega in [0.01, 10 000], (0, 1], odd.

    Raises
    ------
    InputError
        If a value is outside its range.

    Examples
    --------
    >>> curves = compute_region_boundaries(4.0, 0.5)
    >>> print(f"{curves.existence:.5f} {curves.kind:.5f} {curves.sign:.5f}")
    0.70825 0.79129 1.58816
    """
    existence, sign, kind, _, _ = _curves(frequency_ratio, restitution, order)
    _, ratios, restitutions, orders = validated_grid(0.0, frequency_ratio, restitution, order)
    return RegionBoundaries(
        existence=existence,
        sign=sign,
        kind=kind,
        frequency_ratio=ratios,
        restitution=restitutions,
        order=orders,
    )


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class RegionMap(OfLinear, Result):
    """Boundary curves in the plane of frequency and amplitude, for one restitution and order.

    Attributes
    ----------
    frequency_ratio
        Shape (frequencies,); the curves below have the same.
    restitution, order
        One number each.
    existence, sign, kind
        The boundaries of the regions (eqs 23, 24, 25).
    symmetry_breaking
        Where branch 1 loses its symmetry.
    heteroclinic
        The heteroclinic curve.
    """

    frequency_ratio: Floats
    restitution: float
    order: int
    existence: Floats
    sign: Floats
    kind: Floats
    symmetry_breaking: Floats
    heteroclinic: Floats


@checked
def compute_region_map(
    frequency_ratio: ArrayLike, restitution: float, *, order: int = 1
) -> RegionMap:
    """Return all boundary curves at given frequency ratios (Figs 3 and 4, and more).

    Parameters
    ----------
    frequency_ratio
        Omega = omega/p, shape (frequencies,), or one number.
    restitution
        Ratio of angular velocities, in (0, 1].
    order
        n = 1, 3, 5, ...

    Returns
    -------
    RegionMap
        Amplitudes A = a_max/(alpha g), arrays of shape (frequencies,).

    Raises
    ------
    InputError
        If a value is outside its range, or the order is even.

    Examples
    --------
    >>> curves = compute_region_map([2.0, 4.0], 0.5)
    >>> print(curves.existence.round(5), curves.symmetry_breaking.round(5))
    [0.65675 0.70825] [1.82727 4.70266]
    """
    ratios = np.atleast_1d(real_array("frequency_ratio", frequency_ratio))
    restitution = RESTITUTION("restitution", restitution)
    order = order_of_orbit(order)
    existence, sign, kind, breaking, heteroclinic = _curves(ratios, restitution, order)
    return RegionMap(
        frequency_ratio=ratios,
        restitution=float(restitution),
        order=int(order),
        existence=existence,
        sign=sign,
        kind=kind,
        symmetry_breaking=breaking,
        heteroclinic=heteroclinic,
    )


@checked
def heteroclinic_amplitude(frequency_ratio: ArrayLike, restitution: ArrayLike) -> Floats:
    """Return the amplitude at which the manifolds of the two upright saddles first touch.

    ``A = D (1 + Omega^2) / sqrt(1 + D^2 Omega^2)``, which is eq 23 with tanh -> 1: the limit of
    the existence boundary for long half cycles.  Above it basins are fractal near their borders.

    Parameters
    ----------
    frequency_ratio, restitution
        As for `steady_states`; arrays that broadcast against each other.

    Returns
    -------
    numpy.ndarray
        A = a_max/(alpha g), of the broadcast shape.

    Raises
    ------
    InputError
        If a value is outside its range, or the shapes do not broadcast.

    Examples
    --------
    >>> heteroclinic_amplitude([1.0, 2.0, 5.0], 0.9).round(6)
    array([0.105118, 0.261712, 1.323365])
    """
    return _curves(frequency_ratio, restitution, 1)[4]


@checked
def melnikov_amplitude(frequency_ratio: ArrayLike, restitution: ArrayLike) -> Floats:
    """Return Melnikov's first-order estimate of `heteroclinic_amplitude`.

    ``A = (1 - restitution)(1 + Omega^2)/2``, good for restitution near 1.

    Parameters
    ----------
    frequency_ratio, restitution
        As for `steady_states`; arrays that broadcast against each other.

    Returns
    -------
    numpy.ndarray
        A = a_max/(alpha g), of the broadcast shape.

    Raises
    ------
    InputError
        If a value is outside its range, or the shapes do not broadcast.

    Examples
    --------
    >>> melnikov_amplitude([1.0, 2.0, 5.0], 0.9)
    array([0.1 , 0.25, 1.3 ])
    """
    _, ratios, restitutions, _ = validated_grid(0.0, frequency_ratio, restitution, 1)
    result: Floats = 0.5 * (1.0 - restitutions) * (1.0 + ratios * ratios)
    return result


@checked
def symmetry_breaking_amplitude(
    frequency_ratio: ArrayLike, restitution: ArrayLike, *, order: ArrayLike = 1
) -> Floats:
    """Return the amplitude at which branch 1 loses its symmetry: a half-cycle multiplier of -1.

    Closed form, from trace = -(1 + restitution^2); stable symmetric motion lies between the
    existence boundary and this curve.

    Parameters
    ----------
    frequency_ratio, restitution, order
        As for `steady_states`; arrays that broadcast against each other.

    Returns
    -------
    numpy.ndarray
        A = a_max/(alpha g), of the broadcast shape.

    Raises
    ------
    InputError
        If a value is outside its range, an order is even, or the shapes do not broadcast.

    Examples
    --------
    >>> symmetry_breaking_amplitude([1.448324, 1.948378], 0.8).round(5)
    array([1., 2.])
    """
    return _curves(frequency_ratio, restitution, order)[3]


@checked
def symmetry_breaking_frequencies(
    amplitude: float, restitution: float, *, order: int = 1
) -> Floats:
    """Return every frequency ratio in [0.01, 1000] at which branch 1 loses its symmetry.

    Roots of `symmetry_breaking_amplitude`, isolated on a fine logarithmic grid and found by Brent's
    method, in ascending order; empty where there is none.

    Parameters
    ----------
    amplitude
        A = a_max/(alpha g), above 0, up to 1e50.
    restitution
        Ratio of angular velocities, in (0, 1].
    order
        n = 1, 3, 5, ...

    Returns
    -------
    numpy.ndarray
        Omega = omega/p, shape (roots,).

    Raises
    ------
    InputError
        If a value is outside its range, or the order is even.

    Examples
    --------
    >>> symmetry_breaking_frequencies(2.0, 0.8).round(6)
    array([1.948378])
    """
    a = in_range("amplitude", amplitude, 0.0, LARGEST, hint="give a_max/(alpha g)")
    ratio_of_velocities = RESTITUTION("restitution", restitution)
    n = order_of_orbit(order)

    def excess(log_ratio: float) -> float:
        return symmetry_breaking(exp(log_ratio), ratio_of_velocities, n) - a

    grid = np.linspace(log(0.01), log(1000.0), 4001).tolist()
    values = np.array([excess(x) for x in grid])
    roots = [
        exp(root(excess, grid[i], grid[i + 1]))
        for i in range(len(grid) - 1)
        if values[i] * values[i + 1] <= 0.0 and values[i] != 0.0
    ]
    return np.array(roots)


def _curves(
    frequency_ratio: ArrayLike, restitution: ArrayLike, order: ArrayLike
) -> tuple[Floats, ...]:
    """Return existence, sign, kind, symmetry breaking and the heteroclinic curve."""
    _, ratios, restitutions, orders = validated_grid(0.0, frequency_ratio, restitution, order)
    curves = np.empty((5, ratios.size))
    fill_curves(ratios.ravel(), restitutions.ravel(), orders.ravel(), curves)
    return tuple(curves.reshape(5, *ratios.shape))
