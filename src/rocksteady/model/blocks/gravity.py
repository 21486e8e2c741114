"""Standard gravity, in which accelerations in g are, and how far rounding moves them."""

from typing import Any

STANDARD_GRAVITY = 9.80665
"""Standard acceleration of gravity [m/s^2]."""
ROUNDED = 1e-9
"""Relative difference of accelerations that rounding makes."""


def in_g(acceleration_m_s2: Any) -> Any:
    """Return an acceleration in g, which is 9.80665 m/s^2 whatever the gravity of a block.

    Examples
    --------
    >>> in_g(4.903325)
    0.5
    """
    return acceleration_m_s2 / STANDARD_GRAVITY
