"""Krawczyk's test: a box of balls in which a system of equations has exactly one zero."""

from collections.abc import Callable
from dataclasses import dataclass

from flint import arb, arb_mat, ctx

from rocksteady.certify.proofs._balls import around, mid, size

System = Callable[[list[arb]], tuple[list[arb], list[list[arb]]]]
"""Residuals of a point or a box, and their Jacobian there."""

STEPS = 40
"""Most steps of Newton's method towards the centre of a box."""
LARGEST = 0.25
"""Half-width of the first box that is tried for uniqueness."""


@dataclass(frozen=True)
class Enclosure:
    """A zero: the box that encloses it, and the half-width around it within which it is alone."""

    box: list[arb]
    alone: float


def enclose(system: System, start: list[arb]) -> Enclosure | None:
    """Return a proved enclosure of the zero near a start; None where there is no proof.

    A box X in whose interior K(X) = x - Y f(x) + (1 - Y f'(X)) (X - x) lies has exactly one zero
    (Krawczyk 1969); Y is an approximate inverse of the Jacobian, which no proof relies on.
    """
    try:
        return _enclose(system, [mid(x) for x in start])
    except (
        ValueError,
        ZeroDivisionError,
    ):  # a ball that holds 0 is a divisor
        return None


def _enclose(system: System, centre: list[arb]) -> Enclosure | None:
    """Return what `enclose` does, or raise where a ball that holds 0 is divided by."""
    count = len(centre)
    before = float("inf")
    for _ in range(STEPS):
        residuals, jacobian = system(centre)
        inverse = centres(centres(arb_mat(jacobian)).inv())
        shift = inverse * arb_mat(count, 1, residuals)
        length = max(size(shift[i, 0]) for i in range(count))
        if not length < before / 2:
            break
        before = length
        centre = [mid(x - shift[i, 0]) for i, x in enumerate(centre)]
    else:
        return None
    unit = arb_mat(count, count, [int(i == j) for i in range(count) for j in range(count)])

    def image(radii: list[float]) -> tuple[list[arb], list[arb]]:
        box = [around(x, radius) for x, radius in zip(centre, radii, strict=True)]
        spread = (unit - inverse * arb_mat(system(box)[1])) * arb_mat(
            count, 1, [part - x for part, x in zip(box, centre, strict=True)]
        )
        return box, [x - shift[i, 0] + spread[i, 0] for i, x in enumerate(centre)]

    radii = [3.0 * size(shift[i, 0]) + 2.0 ** (8 - ctx.prec) for i in range(count)]
    for _ in range(6):
        box, inside = image(radii)
        if contained(inside, box):
            break
        radii = [2.0 * size(k - x) for k, x in zip(inside, centre, strict=True)]
    else:
        return None
    half = LARGEST
    while half > max(radii):
        try:
            wide, narrow = image([half] * count)
            if contained(narrow, wide):
                return Enclosure(inside, half)
        except (ValueError, ZeroDivisionError):
            pass
        half /= 4.0
    return Enclosure(inside, max(radii))


def contained(inner: list[arb], outer: list[arb]) -> bool:
    """Return whether each ball lies inside another one, without touching its ends."""
    return all(wide.contains_interior(narrow) for narrow, wide in zip(inner, outer, strict=True))


def centres(matrix: arb_mat) -> arb_mat:
    """Return the matrix of the centres."""
    return matrix.mid()
