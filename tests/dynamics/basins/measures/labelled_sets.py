"""Labels of states whose boundary has a known dimension."""

import numpy as np
from numpy.typing import NDArray

Integers = NDArray[np.int64]


def cantor(levels: int) -> Integers:
    """Basins that alternate between the gaps of the middle-third Cantor set, their boundary."""
    label = np.array([-1], dtype=np.int64)
    for level in range(levels):
        thirds = np.repeat(label, 3).reshape(-1, 3)
        middle = thirds[:, 1]
        middle[middle == -1] = level % 2
        label = thirds.ravel()
    return np.where(label == -1, levels % 2, label)


def newton(points: int, half_width: float = 1.5) -> Integers:
    """Which root of z^3 = 1 Newton's method finds from each state of a square window."""
    axis = np.linspace(-half_width, half_width, points)
    z = axis[None, :] + 1j * axis[:, None] + 1e-9
    for _ in range(60):
        z = z - (z**3 - 1.0) / (3.0 * z**2)
    roots = np.exp(2j * np.pi * np.arange(3) / 3.0)
    nearest: Integers = np.argmin(np.abs(z[..., None] - roots), axis=-1)
    return nearest


def tilted_plane(points: int, slope: float = 0.37) -> Integers:
    """Two basins on either side of a straight line."""
    x, y = np.meshgrid(np.arange(points), np.arange(points))
    return (y - 0.5 * points > slope * (x - 0.5 * points)).astype(np.int64)


def disc(points: int) -> Integers:
    """A basin within a circle, and one around it."""
    x, y = np.meshgrid(np.arange(points), np.arange(points))
    middle = 0.5 * (points - 1)
    inside: Integers = (np.hypot(x - middle, y - middle) < 0.35 * points).astype(np.int64)
    return inside
