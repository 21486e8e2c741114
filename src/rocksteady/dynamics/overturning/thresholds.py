r"""Closed forms of the smallest pulse that overturns a block without an impact.

A slender block at rest lifts off at pivot time s0, where the pulse a f(s) first reaches 1.  If it
has not landed when the pulse ends, it never comes back if and only if::

    a integral from s0 to the end of f(s) e^-(s - s0) ds > 1,

because the integral less 1, over 2, is the coefficient of e^s after the pulse.  With w = omega/p
this gives the equations below, each with the smallest a that fulfils it.
"""

import math
from collections.abc import Callable
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import real_array
from rocksteady.errors import InputError
from rocksteady.kernels.elementary.arrays import cos, exp, expm1, log, log1p, sin
from rocksteady.kernels.elementary.roots import root
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import INSIDE
from rocksteady.model.equations import Linear, ModelChoice, chosen_model
from rocksteady.model.motions.pulses import PULSE_RATIO


@checked
def overturning_amplitude(shape: str, frequency_ratio: ArrayLike) -> Floats:
    r"""Return the amplitude above which a pulse overturns a slender block without an impact.

    ==============  ==============================================================================
    rectangle       ``A = 1/(1 - e^(-pi/w))`` [1]_
    half-sine       ``A = 1/sin(psi)``, ``w sin(psi) - cos(psi) = e^(-(pi - psi)/w)`` [2]_
    versed-sine     ``A = 2/(1 - cos(psi))``, ``2 w cos(psi) + sin(psi) = 2 w e^(-(2 pi-psi)/2w)``
    triangle        ``A = q/(q - ln(2 - e^-q))``, ``q = pi/(2 w)``
    decaying-ramp   ``A = d/(d - 1 + e^-d)``, ``d = pi/w``
    one-sine        ``A = 1/sin(psi)``, ``w sin(psi) - cos(psi) = -e^(-(2 pi - psi)/w)`` [3]_
    one-cosine      ``A = (1 + w^2)/(1 - e^(-2 pi/w))``
    ==============  ==============================================================================

    psi is the phase of the pulse at uplift.  The forms without a source follow from the same
    integral.  Under the last two pulses a block falls at smaller amplitudes too, after impacts: see
    `rocksteady.find_overturning_windows`.

    Parameters
    ----------
    shape
        One of the names above, as for `Pulse`.
    frequency_ratio
        w = omega/p with omega = 2 pi over the pulse's period, of any shape.

    Returns
    -------
    ndarray
        a_max/(alpha g), in the shape of `frequency_ratio`.

    Raises
    ------
    InputError
        If there is no closed form of that shape, or a ratio is outside [0.01, 5000].

    References
    ----------
    .. [1] G. W. Housner, Bull. Seism. Soc. Am. 53, 403-417 (1963).
    .. [2] N. Makris and Y. S. Roussos, Geotechnique 50, 243-262 (2000).  Housner's sqrt(1 + w^2)
       [1]_, where the growing part vanishes while the pulse still lasts, is too high.
    .. [3] J. Zhang and N. Makris, J. Eng. Mech. 127, 473-483 (2001).

    Examples
    --------
    >>> overturning_amplitude("half-sine", [1.0, 2.0, 3.0]).round(6)
    array([1.322397, 1.800724, 2.293872])
    >>> round(float(overturning_amplitude("one-sine", 5.0)), 6)
    7.168129
    """
    if shape not in THRESHOLDS:
        raise InputError(
            "shape",
            shape,
            "no closed form is known for it",
            "choose one of " + ", ".join(THRESHOLDS) + ", or compute find_overturning_windows",
        )
    ratios = real_array("frequency_ratio", frequency_ratio)
    amplitudes = np.empty(ratios.shape)
    for index, ratio in np.ndenumerate(ratios):
        w = PULSE_RATIO("frequency_ratio", ratio.item())
        amplitudes[index] = THRESHOLDS[shape](w)
    return amplitudes


@checked
def overturning_impulse(block: Annotated[Block, INSIDE], *, model: ModelChoice = None) -> float:
    r"""Return the change of base velocity that overturns a block at rest [m/s].

    The impulse gives the block the velocity ``p^2 v cos(alpha)/g``, which lifts its mass centre
    over the pivot from ``v = (g/p) sqrt(2 (1 - cos alpha))/cos(alpha)`` on; for a homogeneous
    rectangle that is ``sqrt(8 g R (1 - cos alpha)/3)/cos(alpha)`` [1]_.

    Parameters
    ----------
    block
        The block; for one whose sides differ the positive side.
    model
        ``"nonlinear"`` (default), or ``"linear"``: ``alpha g/p``, size 1 of `Impulses`.

    References
    ----------
    .. [1] G. W. Housner, Bull. Seism. Soc. Am. 53, 403-417 (1963).

    Examples
    --------
    >>> block = Block.rectangle(width=0.4, height=1.6)
    >>> slender = overturning_impulse(block, model=Linear())
    >>> round(overturning_impulse(block), 6), round(slender, 6)
    (0.82711, 0.804424)
    """
    if not isinstance(block, Block):
        raise InputError(
            "block",
            block,
            "a velocity in m/s needs a block with sizes",
            "give a Block; in units of alpha g/p the impulse is 1",
        )
    if isinstance(chosen_model(model, block), Linear):
        return block.uplift_acceleration / block.p
    # 2 sin(alpha/2) is sqrt(2 (1 - cos alpha)), without its cancellation
    return block.gravity / block.p * 2.0 * sin(0.5 * block.alpha) / cos(block.alpha)


def _sine(w: float, end: float, sign: float) -> float:
    """Return 1/sin(psi) for ``w sin(psi) - cos(psi) = sign e^(-(end - psi)/w)``.

    psi lies at or before pi/2, where the pulse is largest: there the left side is w, at 0 it is -1.
    """

    def equation(psi: float) -> float:
        return w * sin(psi) - cos(psi) - sign * exp(-(end - psi) / w)

    return 1.0 / sin(root(equation, 0.0, 0.5 * math.pi))


def _versed_sine(w: float) -> float:
    k = 2.0 * w

    def equation(psi: float) -> float:
        return k * cos(psi) + sin(psi) - k * exp(-(2.0 * math.pi - psi) / k)

    sine = sin(0.5 * root(equation, 0.0, math.pi))
    return 1.0 / (sine * sine)


def _triangle(w: float) -> float:
    q = 0.5 * math.pi / w
    if q > 1.0:
        return q / (q - log(2.0 - exp(-q)))
    # q - ln(2 - e^-q) = -ln(e^-q (2 - e^-q)) = -ln(1 - (1 - e^-q)^2)
    lost = expm1(-q)
    return q / -log1p(-lost * lost)


def _decaying_ramp(w: float) -> float:
    d = math.pi / w
    if d > 0.1:
        return d / (d + expm1(-d))
    # d - 1 + e^-d = d^2/2 - d^3/6 + ...: its terms fall by d/3 or more.
    term, total = 0.5 * d * d, 0.0
    for n in range(3, 20):
        total += term
        term *= -d / n
    return d / total


THRESHOLDS: dict[str, Callable[[float], float]] = {
    "rectangle": lambda w: -1.0 / expm1(-math.pi / w),
    "half-sine": lambda w: _sine(w, math.pi, 1.0),
    "versed-sine": _versed_sine,
    "triangle": _triangle,
    "decaying-ramp": _decaying_ramp,
    "one-sine": lambda w: _sine(w, 2.0 * math.pi, -1.0),
    "one-cosine": lambda w: -(1.0 + w * w) / expm1(-2.0 * math.pi / w),
}
"""The closed form of each shape, from w."""
