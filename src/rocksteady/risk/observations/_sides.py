"""Sides of the blocks that rows of sizes make, as arrays; to the last bit those of `Block`."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import atan2, cos, hypot, sin
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.blocks.sides import Side

ALPHA, RADIUS, P, RESTITUTION = range(4)
"""Columns of a side."""

HIGHEST_RESTITUTION: Final = 0.999
"""Of a factor on the value of angular momentum."""
LOWEST_RESTITUTION: Final = 0.01


def sides_of_numbers(numbers: Mapping[str, Floats]) -> Floats:
    """Return the sides of blocks.

    Parameters
    ----------
    numbers
        Values by name, as `ObjectPrior` has them, each of shape (n,).

    Returns
    -------
    ndarray
        Shape (n, 2, 4): of the positive and the negative side alpha [rad], the radius [m], p
        [rad/s] and the restitution.
    """
    sides, momentum = _shapes(numbers)
    if "restitution" in numbers:
        sides[:, :, RESTITUTION] = numbers["restitution"][:, np.newaxis]
    else:
        ratios = numbers["housner_factor"][:, np.newaxis] * momentum
        sides[:, :, RESTITUTION] = np.clip(ratios, LOWEST_RESTITUTION, HIGHEST_RESTITUTION)
    return sides


def least_momentum_ratio(numbers: Mapping[str, Floats]) -> float:
    """Return the lowest restitution by angular momentum, which may be negative."""
    return float(_shapes(numbers)[1].min())


def blocks_of_sides(sides: Floats) -> list[Block]:
    """Return the blocks of sides of shape (n, 2, 4)."""
    return [Block(positive=_side(row[0]), negative=_side(row[1])) for row in sides.tolist()]


def _side(row: list[float]) -> Side:
    return Side(alpha=row[ALPHA], radius=row[RADIUS], p=row[P], restitution=row[RESTITUTION])


def _shapes(numbers: Mapping[str, Floats]) -> tuple[Floats, Floats]:
    """Return sides without their restitution, and that by angular momentum, shape (n, 2)."""
    if "alpha_rad" in numbers:
        alpha, p = numbers["alpha_rad"], numbers["p_rad_s"]
        return _symmetric(alpha, 0.75 * STANDARD_GRAVITY / (p * p), p)
    gyration = numbers.get("gyration_m")
    if "left_m" in numbers:
        left, right = numbers["left_m"], numbers["right_m"]
        height = 2.0 * numbers["mass_centre_height_m"]
        plain = np.full(len(left), gyration is None)
        if gyration is None:
            base = left + right
            gyration = np.sqrt((base * base + height * height) / 12.0)
    else:
        width, tall = numbers["width_m"], numbers["height_m"]
        half = 0.5 * (width * numbers["base"])
        left, right = half * (1.0 + numbers["offset"]), half * (1.0 - numbers["offset"])
        height = 2.0 * numbers.get("mass_centre_height_m", 0.5 * tall)
        plain = (numbers["base"] == 1.0) & (height == tall) & (gyration is None)
        if gyration is None:
            gyration = np.sqrt((width * width + tall * tall) / 12.0)
    sides, momentum = _unlike(left, right, 0.5 * height, gyration)
    # What is computed of a rectangle in another way is the same except for rounding.
    plain &= left == right
    if plain.any():
        base, tall = 2.0 * left[plain], height[plain]
        radius = 0.5 * hypot(base, tall)
        p = np.sqrt(0.75 * STANDARD_GRAVITY / radius)
        sides[plain], momentum[plain] = _symmetric(atan2(base, tall), radius, p)
    return sides, momentum


def _symmetric(alpha: Floats, radius: Floats, p: Floats) -> tuple[Floats, Floats]:
    """Return equal sides, and Housner's restitution."""
    rows = np.stack([alpha, radius, p, np.zeros_like(p)], axis=1)
    sine = sin(alpha)
    ratio = 1.0 - 2.0 * (p * p * radius / STANDARD_GRAVITY) * (sine * sine)
    return np.stack([rows, rows], axis=1), np.stack([ratio, ratio], axis=1)


def _unlike(left: Floats, right: Floats, centre: Floats, gyration: Floats) -> tuple[Floats, Floats]:
    """Return two sides of one body, and the restitution of either impact."""
    alphas = [atan2(left, centre), atan2(right, centre)]
    radii = [hypot(left, centre), hypot(right, centre)]
    square = gyration * gyration
    rows, ratios = [], []
    shared = radii[0] * radii[1] * cos(alphas[0] + alphas[1])
    sine = sin(alphas[0])
    same = left == right
    for alpha, radius, struck in zip(alphas, radii, radii[::-1], strict=True):
        p = np.sqrt(STANDARD_GRAVITY * radius / (square + radius * radius))
        rows.append(np.stack([alpha, radius, p, np.zeros_like(p)], axis=1))
        alike = 1.0 - 2.0 * (p * p * radius / STANDARD_GRAVITY) * (sine * sine)
        ratios.append(np.where(same, alike, (square + shared) / (square + struck * struck)))
    return np.stack(rows, axis=1), np.stack(ratios, axis=1)
