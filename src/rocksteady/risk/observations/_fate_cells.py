"""Cells of tests: test, block, gain and draw as numbers, and how the block of each fares.

490 tests of 1,300 draws at 2 gains are 1.3 million runs: a Python object for each would take longer
than its run.
"""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats, Integers
from rocksteady.seismic.spectra.batch import GroundShaking, keys_of, scattered_sides, shaken_fates

STREAM_BYTES = 8
DRAW_BITS = 31
"""Of the number that keys a draw; the number of the block stands above them."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Shaken:
    """What shakes, and what is shaken.

    Attributes
    ----------
    grounds
        All shakings.
    ground
        Number of the shaking of each test, shape (tests,).
    factors
        On the accelerations, shape (tests, blocks, gains) or (tests, 1, gains).
    sides
        Sides of the blocks, as from `seismic.spectra.batch.sides_in_si`, shape (blocks, 2, 3) or
        (blocks, 2, 5).
    gravity
        Acceleration of gravity [m/s^2], shape (blocks,).
    deviation
        Standard deviation of the restitution from impact to impact, shape (blocks,).
    """

    grounds: tuple[GroundShaking, ...]
    ground: Integers
    factors: Floats
    sides: Floats
    gravity: Floats
    deviation: Floats


def streams_of(seed: int, names: Sequence[str]) -> NDArray[np.uint64]:
    """Return the seed of each test's random numbers, from the seed of all and its name."""
    texts = (f"{seed} {name}".encode(errors="surrogatepass") for name in names)
    digests = (hashlib.sha256(text).digest() for text in texts)
    return np.array([int.from_bytes(d[:STREAM_BYTES], "little") for d in digests], dtype=np.uint64)


def fates_of_cells(
    test: Floats,
    block: Floats,
    gain: Floats,
    draw: Floats,
    *,
    shaken: Shaken,
    streams: NDArray[np.uint64],
    peaks: bool,
) -> dict[str, NDArray[Any]]:
    """Return how the blocks of some cells fare.

    Parameters
    ----------
    test, block, gain, draw
        Numbers from 0, shape (cells,).
    shaken
        What they count.
    streams
        Seed of each test's random numbers, shape (tests,).
    peaks
        Whether peaks are wanted; without them they are nan.
    """
    place, number, level = (values.astype(np.int64) for values in (test, block, gain))
    sides, deviation = shaken.sides[number], shaken.deviation[number]
    if (deviation > 0.0).any():
        counted = number << DRAW_BITS | draw.astype(np.int64)
        keys = np.empty(len(place), dtype=np.int64)
        for each in np.unique(place):
            here = place == each
            keys[here] = keys_of(int(streams[each]), counted[here])
        sides = scattered_sides(sides, deviation, keys)
    several = shaken.factors.shape[1] > 1
    fared = shaken_fates(
        shaken.grounds,
        ground=shaken.ground[place],
        scale=shaken.factors[place, number if several else 0, level],
        sides=sides,
        gravity=shaken.gravity[number],
        peaks=peaks,
    )
    return fared._asdict()
