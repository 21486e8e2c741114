"""Damping of spectra: what another than 5 % multiplies them by."""

import math


def damping_factor(damping: float) -> float:
    """Return eta = sqrt(10/(5 + xi)), xi in per cent, at least 0.55 (EN 1998-1:2004 eq. 3.6).

    Examples
    --------
    >>> print(f"{damping_factor(0.05)} {damping_factor(0.02):.4f} {damping_factor(0.5)}")
    1.0 1.1952 0.55
    """
    return max(0.55, math.sqrt(10.0 / (5.0 + 100.0 * damping)))
