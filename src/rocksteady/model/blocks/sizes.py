"""Sizes as they are given: which of them, in which unit, and the radius that p implies."""

import warnings
from collections.abc import Mapping

from rocksteady.errors import ModelError, Words
from rocksteady.kernels.elementary.arrays import cos, sin, tan
from rocksteady.model.blocks.sides import housner_ratio, refuse_no_rocking
from rocksteady.model.checks.bounds import GYRATION, P, length

TALLEST = 200.0
"""Of the standing towers and obelisks none is taller [m]."""

TALL = 50.0
"""Size [m] above which those in whole numbers are taken for millimetres or centimetres, and above
which commands and object files, which people type, take none."""

METRES = "sizes are in metres: write 0.6 for 600 mm"
"""What to do where a size is above it."""


def question_millimetres(sizes: Mapping[str, float], *, height: float) -> None:
    """Warn of sizes that seem to be in millimetres.

    So seem heights above 200 m, and heights above 50 m where all sizes are whole numbers, as those
    of catalogues are.

    Parameters
    ----------
    sizes
        Those that were given [m], by name.
    height
        The height of the block that they make [m].
    """
    whole = all(size.is_integer() for size in sizes.values())
    if height > TALLEST or (height > TALL and whole):
        given = ", ".join(f"{name}={size:g}" for name, size in sizes.items())
        instead = ", ".join(f"{name}={size / 1000.0:g}" for name, size in sizes.items())
        warnings.warn(
            f"{given} make a block {height:g} m high: sizes are in metres; for one in millimetres "
            f"give {instead}",
            stacklevel=5,
        )


def check_one_size(*, radius: float | None, p: float | None, gyration: float | None) -> None:
    """Check that a block has one size: `radius`, with or without `gyration`, or `p` alone.

    Raises
    ------
    ModelError
        If it has none, or too many.
    """
    if (radius is None) != (p is None) and (p is None or gyration is None):
        return
    sizes = {"radius": radius, "p": p, "gyration": gyration}
    given = " and ".join(name for name, value in sizes.items() if value is not None)
    raise ModelError(
        "radius, p, gyration",
        Words(f"do not fit, with {given} given" if given else "are all missing"),
        "a radius, with or without a gyration, or a p alone sets its size",
        "give radius=..., or p=...",
    )


def radius_of_p(p: float, alpha: float, other_alpha: float, gravity: float) -> float:
    """Return the radius [m] of the side of `alpha`, with a rectangle's radius of gyration.

    For a body R times as large as one with R = 1, ``p^2 = g/(R (1 + k^2))``.

    Parameters
    ----------
    p
        Frequency parameter of that side [rad/s].
    alpha, other_alpha
        Slenderness of either side [rad].
    gravity
        g [m/s^2].
    """
    rate = P("p", p)
    height = cos(alpha)
    base = sin(alpha) + height * tan(other_alpha)
    shape = (base * base + 4.0 * height * height) / 12.0
    return gravity / (rate * rate * (1.0 + shape))


def check_inertia(inertia: float, least: float) -> None:
    """Refuse a moment of inertia about a pivot below mass times radius squared [kg m^2].

    Raises
    ------
    ModelError
        With that product.
    """
    if inertia < least * (1.0 - 1e-12):
        raise ModelError(
            "inertia",
            inertia,
            f"about a pivot it is at least mass * radius^2 = {least:.6g} kg m^2",
            "add mass * radius^2 to a moment of inertia about the mass centre",
        )


def lengths_of(
    left: float, right: float, height: float, gyration: float | None
) -> tuple[float, float, float, float | None]:
    """Return the lengths of an asymmetric block [m], validated.

    Raises
    ------
    InputError
        If one is not positive.
    """
    b1 = length("give the distance of the left edge in metres")("left", left)
    b2 = length("give the distance of the right edge in metres")("right", right)
    h = length("give the full height in metres")("height", height)
    return b1, b2, h, None if gyration is None else GYRATION("gyration", gyration)


def refuse_stocky(width: float, height: float, alpha: float) -> None:
    """Refuse a rectangle that has no Housner's restitution.

    Not left to the check of alpha, which the caller has not given.

    Raises
    ------
    InputError
        If that is not positive.
    """
    words = f"with a height of {height:.6g} m Housner's restitution is"
    refuse_no_rocking("width", width, housner_ratio(alpha), words)
