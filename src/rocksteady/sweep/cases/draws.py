"""Random numbers for each cell, determined by a seed and the cell's number.

NumPy's ``SeedSequence`` takes 8 to 10 microseconds a cell under Python's lock, which was half the
time of seeded basins.  Here all cells of a call take 0.1 microseconds each.
"""

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats

Words = NDArray[np.uint32]

# The constants of `numpy.random.SeedSequence`, which NumPy keeps as they are for good (NEP 19).
FIRST_IN, FACTOR_IN = 0x43B0D7E5, 0x931E8875
FIRST_OUT, FACTOR_OUT = 0x8B51F9DD, 0x58F38DED
LEFT, RIGHT = np.uint32(0xCA01F9DD), np.uint32(0x4973F715)
HALF = np.uint32(16)
POOL = 4
MASK = 2**32 - 1


def uniform(seed: int, numbers: NDArray[np.int64], count: int = 1) -> Floats:
    """Return uniform numbers of cells in [0, 1), keyed on a seed and the cells' numbers.

    A cell draws the same numbers in every process and beside any other cells: to the last bit
    what ``SeedSequence(seed, spawn_key=(number,))`` gives, for all cells at once.

    Parameters
    ----------
    seed
        From 0 to 2^64 - 1.
    numbers
        Numbers of the cells in their grid, 0 or more, shape (cells,), as `evaluate` passes them to
        a case function that takes them by ``numbered``.
    count
        Number of values that each cell draws.  More of them begin with the same.

    Returns
    -------
    numpy.ndarray
        Shape (cells, count).

    Examples
    --------
    >>> uniform(7, np.array([0, 1, 2]), 2).round(6)
    array([[0.183569, 0.953002],
           [0.219144, 0.980187],
           [0.951875, 0.170647]])
    """
    # What the seed alone makes of the pool is the same for all cells; then comes the key.
    pool = [np.full(len(numbers), word) for word in np.random.SeedSequence(seed).pool]
    constant = FIRST_IN * pow(FACTOR_IN, POOL * POOL, MASK + 1) & MASK
    low, high = (words.astype(np.uint32) for words in (numbers & MASK, numbers >> 32))
    # A number has a second word only where it needs one.
    for words, mask in ((low, np.ones(len(numbers), dtype=np.bool_)), (high, high > 0)):
        for place in range(POOL):
            hashed, constant = _hashed(words, constant, FACTOR_IN)
            mixed = _folded(LEFT * pool[place] - RIGHT * hashed)
            pool[place] = np.where(mask, mixed, pool[place])
    halves = np.empty((count, 2, len(numbers)), dtype=np.uint64)
    constant = FIRST_OUT
    for place in range(2 * count):
        halves[place // 2, place % 2], constant = _hashed(pool[place % POOL], constant, FACTOR_OUT)
    whole = halves[:, 0] | halves[:, 1] << np.uint64(32)
    # The 53 upper bits, as NumPy's own generators make a double of them.
    numbers_drawn: Floats = (whole >> np.uint64(11)).T.astype(np.float64) * 2.0**-53
    return numbers_drawn


def _hashed(words: Words, constant: int, factor: int) -> tuple[Words, int]:
    """Return words hashed with a constant, and the constant of the next hash."""
    following = constant * factor & MASK
    return _folded((words ^ np.uint32(constant)) * np.uint32(following)), following


def _folded(words: Words) -> Words:
    """Return words whose lower halves hold what the upper ones do too."""
    folded: Words = words ^ words >> HALF
    return folded
