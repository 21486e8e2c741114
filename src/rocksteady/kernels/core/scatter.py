"""Restitution that scatters from impact to impact, drawn from the impact's number.

The restitution of an impact is ``mean + deviation z`` with z normal, drawn again until it lies in
(0, (1 + mean)/2].  Draws depend on the key of the cell and the number of the impact alone: a block
cipher turns the two, and the number of the attempt, into random bits (Threefry-2x32 of 20 rounds:
Salmon, Moraes, Dror and Shaw, Parallel random numbers: as easy as 1, 2, 3, 2011).  A normal number
is the quantile of a uniform one (algorithm AS 241: Wichura, Applied Statistics 37, 1988).

Words of 32 bits are kept in whole numbers of 64, so that no sum or shift of them is cut off by
anything but `WORD`.
"""

from rocksteady.kernels.core import tables
from rocksteady.kernels.core._quantile import normal_quantile
from rocksteady.kernels.core.tables import Floats, free_side
from rocksteady.kernels.core.typed import whole
from rocksteady.kernels.machine_code.compilation import compiled, inlined

WORD = whole(2**32 - 1)
WORD_BITS = whole(32)
PARITY = whole(0x1BD11BDA)
"""What the third word of a key holds beside the two others."""
EVEN = (whole(13), whole(15), whole(26), whole(6))
ODD = (whole(17), whole(29), whole(16), whole(24))
"""Places by which four rounds turn a word, in turn."""
UNIFORM_BITS = 52
UNIFORM_PART = 2.0**-52
ATTEMPTS = 1000
"""Draws after which the mean is taken: never in practice, with no larger deviation than below."""
LARGEST_DEVIATION = 1.0
"""The largest standard deviation of a restitution."""
LARGEST_KEY = 2**53 - 1


@inlined
def is_scattered(sides: Floats) -> bool:
    """Return whether a side table has restitution that scatters."""
    return bool(sides.shape[1] >= tables.SCATTERED_SIDE_COLUMNS)


@inlined
def largest_draw(sides: Floats, row: int) -> float:
    """Return the largest restitution that an impact on a side may have."""
    mean: float = abs(sides[row, tables.RESTITUTION])
    if is_scattered(sides) and sides[row, tables.SCATTER] > 0.0:
        return 0.5 * (1.0 + mean)
    return mean


@inlined
def largest_restitution(sides: Floats) -> float:
    """Return the largest restitution that any impact may have; a wall's without its sign."""
    free = free_side(sides)
    if free != 0:
        return largest_draw(sides, 0 if free > 0 else 1)
    return max(largest_draw(sides, 0), largest_draw(sides, 1))


@compiled
def restitution_of(sides: Floats, row: int, impact: int) -> float:
    """Return the restitution of an impact on a side that scatters; impacts count from 1 on."""
    mean, deviation = abs(sides[row, tables.RESTITUTION]), sides[row, tables.SCATTER]
    sign = -1.0 if sides[row, tables.RESTITUTION] <= 0.0 else 1.0
    if deviation > 0.0:
        key, top = int(sides[row, tables.KEY]), largest_draw(sides, row)
        for attempt in range(ATTEMPTS):
            value: float = mean + deviation * normal_quantile(uniform(key, impact, attempt))
            if 0.0 < value <= top:
                return sign * value
    return sign * float(mean)


@compiled
def uniform(key: int, impact: int, attempt: int) -> float:
    """Return a uniform number inside (0, 1): the middle of one of 2^52 equal parts."""
    high, low = threefry(key & WORD, key >> WORD_BITS, impact & WORD, attempt & WORD)
    bits = (high << (UNIFORM_BITS - 32)) | (low >> (64 - UNIFORM_BITS))
    return (bits + 0.5) * UNIFORM_PART


@compiled
def threefry(key: int, other_key: int, count: int, other_count: int) -> tuple[int, int]:
    """Return two words of 32 bits: a count of two words, enciphered with a key of two."""
    third = PARITY ^ key ^ other_key
    x, y = (count + key) & WORD, (other_count + other_key) & WORD
    x, y = _four_rounds(x, y, EVEN)
    x, y = (x + other_key) & WORD, (y + third + 1) & WORD
    x, y = _four_rounds(x, y, ODD)
    x, y = (x + third) & WORD, (y + key + 2) & WORD
    x, y = _four_rounds(x, y, EVEN)
    x, y = (x + key) & WORD, (y + other_key + 3) & WORD
    x, y = _four_rounds(x, y, ODD)
    x, y = (x + other_key) & WORD, (y + third + 4) & WORD
    x, y = _four_rounds(x, y, EVEN)
    return (x + third) & WORD, (y + key + 5) & WORD


@inlined
def _four_rounds(x: int, y: int, turns: tuple[int, int, int, int]) -> tuple[int, int]:
    """Return two words after four rounds: add, turn, exclusive or."""
    x, y = _round(x, y, turns[0])
    x, y = _round(x, y, turns[1])
    x, y = _round(x, y, turns[2])
    return _round(x, y, turns[3])


@inlined
def _round(x: int, y: int, turn: int) -> tuple[int, int]:
    x = (x + y) & WORD
    return x, (((y << turn) & WORD) | (y >> (WORD_BITS - turn))) ^ x
