"""Heteroclinic tangency in closed form, for a block with equal or different sides."""

from rocksteady.kernels.elementary.arrays import hypot
from rocksteady.model.blocks.dimensionless import SideRow


def tangency_amplitude(sides: tuple[SideRow, SideRow], frequency_ratio: float) -> float:
    """Return the amplitude at which the manifolds of the two upright saddles first touch.

    Under shaking each upright position is a small unstable motion ``y = 1 - b sin(psi)`` of its
    side, ``b = (A/lambda)/(1 + w^2)``, ``w = Omega/rho``.  A flight that leaves it has no decaying
    part, so that it lands at phase psi with the speed ``1 - b (sin(psi) - w cos(psi))``; one that
    tends to it has no growing part and begins with ``1 - b (sin(psi) + w cos(psi))``.  The first is
    multiplied by the restitution at the impact, and psi grows by pi with the change of sides.  In
    reference units, the units of speed being ``u = lambda rho`` on the side that is left and
    ``v = lambda' rho'`` on the other,

    ``delta u - v = A ((delta u c + v c') sin(psi) + (v c' w' - delta u c w) cos(psi))``

    with ``c = 1/(lambda (1 + w^2))``, which first has a solution where A times the length of the
    two factors is ``|delta u - v|``.  The smaller one of both directions is returned; of symmetric
    blocks it is `rocksteady.formulas.heteroclinic_amplitude` (Hogan 1992; Lenci and Rega 2005).
    Where ``delta u > v`` the block falls from one upright position over the other even on a still
    base, and from that amplitude on it need not.

    Parameters
    ----------
    sides
        As `rocksteady.DimensionlessBlock.sides` has them.
    frequency_ratio
        Omega = omega/p of the positive side.

    Returns
    -------
    float
        A in units of the positive side's alpha g.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock
    >>> block = DimensionlessBlock(restitution=0.9, alpha_ratio=1.2)
    >>> print(f"{tangency_amplitude(block.sides, 2.0):.6f}")
    0.209370
    """
    amplitudes = []
    for leaves, enters in (sides, sides[::-1]):
        delta, lean, rate = leaves
        _, other_lean, other_rate = enters
        w, other_w = frequency_ratio / rate, frequency_ratio / other_rate
        going = delta * rate / (1.0 + w * w)
        coming = other_rate / (1.0 + other_w * other_w)
        length = hypot(going + coming, coming * other_w - going * w)
        amplitudes.append(abs(delta * lean * rate - other_lean * other_rate) / length)
    return min(amplitudes)
