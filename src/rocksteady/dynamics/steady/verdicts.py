"""Words on the stability of periodic motions."""

import math
from collections.abc import Iterable
from typing import TypedDict

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats

NO_MULTIPLIERS = np.full(2, complex(math.nan, math.nan))
"""Multipliers of a motion that grazes: no derivative exists there."""
NO_MULTIPLIERS.flags.writeable = False
MULTIPLIERS = "multipliers of a period"
"""Label of the multipliers of a motion, in every table: those of one of its periods."""
BEYOND = "the base carries it back: no fall"
"""Of a motion whose tilt exceeds alpha."""


def half_cycle_pairs(trace: Floats, restitution: Floats) -> NDArray[np.complex128]:
    """Return the roots of ``m^2 - trace m + restitution^2``, the larger in modulus first."""
    half = 0.5 * trace
    product = np.broadcast_to(restitution * restitution, half.shape)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        # sqrt(half^2 - product) without squaring a trace near the overflow
        ratio = restitution / np.abs(half)
        real = np.abs(half) >= restitution
        root = np.abs(half) * np.sqrt(np.where(real, (1.0 - ratio) * (1.0 + ratio), 0.0))
        large = half + np.copysign(root, half)
        turn = np.sqrt(np.maximum(product - half * half, 0.0))
        first = np.empty(half.shape, dtype=np.complex128)
        first.real, first.imag = np.where(real, large, half), np.where(real, 0.0, turn)
        second = np.conj(first)
        second.real = np.where(real, product / large, half)
    nothing = np.isnan(half)
    first[nothing] = second[nothing] = NO_MULTIPLIERS[0]
    return np.stack([first, second], axis=-1)


def squared_pairs(pairs: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Return the squares of pairs of multipliers, of a conjugate pair the upper one first."""
    squares = np.empty(pairs.shape, dtype=np.complex128)
    with np.errstate(over="ignore", invalid="ignore"):
        squares.real = pairs.real * pairs.real - pairs.imag * pairs.imag
        squares.imag = 2.0 * pairs.real * pairs.imag + 0.0  # no -0
    lower = squares[..., 0].imag < 0.0
    squares[lower] = squares[lower].conj()
    return squares


class Judgement(TypedDict):
    """What `verdict` takes: whether a solution is a motion, and its stability where known."""

    admissible: bool
    stable: bool | None
    neutral: bool | None


def verdict(*, admissible: bool, neutral: bool | None, stable: bool | None) -> str:
    """Return the verdict on a solution in a word; a motion that grazes is neither."""
    if not admissible:
        return "inadmissible"
    if stable is None:
        return "grazes"
    if neutral:
        return "neutral"
    return "stable" if stable else "unstable"


def multipliers_value(multipliers: Iterable[complex]) -> list[complex] | None:
    """Return multipliers in plain values; None where the motion grazes."""
    pair = [complex(value) for value in multipliers]
    return None if math.isnan(pair[0].real) else pair


def multipliers_text(multipliers: Iterable[complex] | None) -> str:
    """Return a pair of multipliers as people write it; None and nan where the motion grazes.

    Examples
    --------
    >>> multipliers_text([0.5 + 0.25j, 0.5 - 0.25j]), multipliers_text([1.2e-7, 0.0])
    ('0.500 ± 0.250i', '1.2e-7, 0')
    >>> multipliers_text(None)
    'no derivative: grazes'
    """
    pair = multipliers_value(NO_MULTIPLIERS if multipliers is None else multipliers)
    if pair is None:
        return "no derivative: grazes"
    first, second = pair
    if first.imag != 0.0:
        return f"{first.real:.3f} ± {abs(first.imag):.3f}i"
    text = f"{first.real:.3g}, {second.real:.3g}"
    for sign in ("-", "+"):  # 1e-06 is 1e-6, and 1e+06 is 1e6
        text = text.replace(f"e{sign}0", f"e{sign}")
    return text.replace("e+", "e")
