"""Restitution that scatters, in the words of NumPy and the quantiles of SciPy."""

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from rocksteady.kernels.core.tables import KEY, SCATTER, SCATTERED_SIDE_COLUMNS

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Words = NDArray[np.uint32]

TURNS = (13, 15, 26, 6, 17, 29, 16, 24)


def scattered(sides: Floats, deviation: float, key: int) -> Floats:
    """Return the table of one block's sides, (2, 3) or (2, 5), with restitution that scatters."""
    wide = np.zeros((2, SCATTERED_SIDE_COLUMNS))
    wide[:, : sides.shape[1]] = sides
    wide[:, SCATTER], wide[:, KEY] = deviation, key
    return wide


def enciphered(keys: Integers, counts: Integers, other_counts: Integers) -> tuple[Words, Words]:
    """Return Threefry-2x32-20 of arrays, in words that overflow by themselves."""
    low, high = (keys & 0xFFFFFFFF).astype(np.uint32), (keys >> 32).astype(np.uint32)
    schedule = (low, high, np.uint32(0x1BD11BDA) ^ low ^ high)
    x, y = counts.astype(np.uint32) + low, other_counts.astype(np.uint32) + high
    for turn in range(20):
        by = np.uint32(TURNS[turn % 8])
        x = x + y
        y = (y << by | y >> (np.uint32(32) - by)) ^ x
        if turn % 4 == 3:
            injected = turn // 4 + 1
            x = x + schedule[injected % 3]
            y = y + schedule[(injected + 1) % 3] + np.uint32(injected)
    return x, y


def draws(mean: float, deviation: float, keys: Integers | int, impacts: Integers | int) -> Floats:
    """Return the restitution of impacts: the first draw inside (0, (1 + mean)/2]."""
    keys, impacts = np.broadcast_arrays(keys, impacts)
    values = np.full(keys.shape, -1.0)
    attempt = 0
    while True:
        out = ~((values > 0.0) & (values <= 0.5 * (1.0 + mean)))
        if not out.any():
            return values
        high, low = enciphered(keys[out], impacts[out], np.full(int(out.sum()), attempt))
        whole = high.astype(np.uint64) << np.uint64(32) | low.astype(np.uint64)
        middle = (whole >> np.uint64(12)).astype(np.float64) + 0.5
        values[out] = mean + deviation * ndtri(middle * 2.0**-52)
        attempt += 1
