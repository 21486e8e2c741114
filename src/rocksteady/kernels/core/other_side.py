"""Fields of lanes for the side of a block that a lane is not on: kept as differences of bits.

The exchange of both sides is then one exclusive or, without a branch, and like sides cost nothing.
"""

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.bits import bits_of, float_of
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.machine_code.types import Floats2


@compiled
def unlike(sides: Floats2) -> bool:
    """Return whether the two sides of a block differ."""
    found = False
    for column in range(sides.shape[1]):
        found = found or sides[0, column] != sides[1, column]
    return found


@inlined
def difference(here: float, there: float) -> float:
    """Return what makes one number the other, or with one of them the other."""
    return float_of(bits_of(here) ^ bits_of(there))


@inlined
def mask_of(changes: bool) -> float:
    """Return all bits, or none."""
    return float_of(-1 if changes else 0)


@inlined
def exchanged(here: float, apart: float, mask: float) -> float:
    """Return the other side's number where the mask has all bits; `apart` is their difference."""
    return float_of(bits_of(here) ^ (bits_of(apart) & bits_of(mask)))


@inlined
def turn_over(lanes: Floats, sided: int, count: int, k: int) -> None:
    """Give one of so many lanes the constants of the other side.

    It has the differences so many numbers after them.
    """
    for field in range(k, sided, count):
        lanes[field] = difference(lanes[field], lanes[sided + field])


@inlined
def put_differences(lanes: Floats, sided: int, count: int, k: int) -> None:
    """Put differences in the place of the other side's constants of a lane."""
    for field in range(k, sided, count):
        lanes[sided + field] = difference(lanes[field], lanes[sided + field])
