"""Coefficients of normal forms at folds and flips, from the equations of a chain.

At a fold the quadratic coefficient, at a flip (a symmetry breaking or a period doubling) the cubic
one.  Where it vanishes the bifurcation is degenerate: a cusp, or a generalised flip.  Derivatives
beyond the first are differences of the exact first ones, `Chain.matrix`, of eighth order: those are
analytic, and what is lost is some 1e-13 of their size.  Nothing else of a chain is needed, so
that chains of any model have these coefficients.
"""

import math

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.chains.chain import Chain

STEP = 0.01
"""Length of the displacements of the phases of which the differences are taken [rad]."""
FIRST = np.array([4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0])
"""Weights of (f(k h) - f(-k h))/h, k = 1 .. 4, in the first derivative; the next error is h^8."""
EVEN = np.arange(1.0, 5.0)
"""Multiples of the step at which an even function is evaluated for its coefficient of x^2."""


def fold_coefficient(chain: Chain, along: Floats) -> float:
    """Return what vanishes at a cusp: 1/2 eta . F''[xi, xi] of a chain at a fold.

    xi and eta, of length 1, are what the derivative M(1) forgets and what its transpose does.

    Parameters
    ----------
    chain
        At a fold.
    along
        Direction of the phases on whose side xi points, shape (m,).
    """
    right, left = _null(chain.matrix(1.0))
    bent = _bent(chain, right)
    value = 0.5 * float(left @ (bent @ right))
    return value if float(right @ along) >= 0.0 else -value


def flip_coefficient(chain: Chain) -> float:
    """Return what vanishes at a generalised flip: the cubic coefficient of a chain at a flip.

    It is eta . (1/6 F'''[xi, xi, xi] + F''[xi, y]) with M(1) y = -1/2 F''[xi, xi], where xi and
    eta belong to M(-1): xi comes back reversed after the chain, y as it was.  The sign is that of
    the displacement of the motions that branch off: they lie on the side of the parameter on which
    it is balanced.
    """
    right, left = _null(chain.matrix(-1.0))
    twice = chain.doubled()
    half = chain.impacts
    out = np.concatenate([right, -right])
    bent = _bent(twice, out)[:half] @ out
    second = np.linalg.solve(chain.matrix(1.0), -0.5 * bent)
    aside = np.concatenate([second, second])
    weight = np.concatenate([left, -left])
    # Where fold and flip are near to each other y is large, and the curve bends the sooner.
    unit = STEP / math.sqrt(1.0 + float(np.linalg.norm(second)))

    def slope(x: float) -> float:
        """Return d/dx of eta . F(xi x + y x^2): even in x, as swapping the halves reverses x."""
        moved = twice.moved(twice.phases + x * out + x * x * aside, twice.parameters)
        return float(weight @ (moved.matrix(1.0) @ (out + 2.0 * x * aside)))

    start = slope(0.0)  # except for rounding it is 0
    values = np.array([slope(unit * each) - start for each in EVEN])
    powers = np.array([EVEN ** (2 * k + 2) for k in range(len(EVEN))]).T
    bend: float = np.linalg.solve(powers, values)[0]
    return bend / (6.0 * unit**2)  # a third of it is the cubic coefficient, of both halves


def _null(matrix: Floats) -> tuple[Floats, Floats]:
    """Return what a matrix and its transpose forget, each of length 1, their signs together.

    Together the sign is that of the determinant that remains, which does not jump along a curve.
    """
    left, _, right = np.linalg.svd(matrix)
    sign = float(np.linalg.det(left) * np.linalg.det(right))
    return right[-1], left[:, -1] * (1.0 if sign > 0.0 else -1.0)


def _bent(chain: Chain, along: Floats) -> Floats:
    """Return the derivative of the matrix in a direction of the phases."""
    total = np.zeros((chain.impacts, chain.impacts))
    for k, weight in enumerate(FIRST, start=1):
        for sign in (1.0, -1.0):
            phases = chain.phases + sign * k * STEP * along
            moved = chain.moved(phases, chain.parameters)
            total += sign * weight / STEP * moved.matrix(1.0)
    return total
