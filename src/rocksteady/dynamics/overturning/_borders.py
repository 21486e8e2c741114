"""Amplitudes to try next between two of different fate, to locate a border in few steps.

Where the block falls at one end of an interval and stands at the other, the margin has a zero
inside, to which its chord leads.  With s the chord's slope and q the part of it by which those of
the two intervals beside it differ from s, the zero of a smooth margin is no further from that of
the chord than q/4 of the interval.  Two amplitudes, 4 q of the interval before the chord's zero and
4 q after it, enclose it with room to spare; for a short interval q is as small as the interval, so
that the next two enclose it to rounding.

Where the slopes differ much (a kink, a wide interval, rounding) the interval is halved.  Two more
amplitudes of a wide one enclose the zero of the line through the two at either side, which often
are close together.  Borders between two ways of falling are no zeros: there halving is all.

Where rounding decides the fates, those of two amplitudes may come in the wrong order and make a
window of one amplitude.  So the two are kept apart by what rounding makes of q, and by some units
in the last place, and no line is followed in a narrow interval.
"""

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats

STRAIGHT = 0.06
"""Part of a chord's slope by which those beside it may differ if it is to be followed."""
ROOM = 4.0
"""Distance from the chord's zero, as a part of the interval and of q."""
NEAREST = 32.0
"""The same in units in the last place."""
WIDE = 1e-9
"""Part of an amplitude; in narrower intervals no line from one side is followed."""
LEAST = 1e-4
"""Least distance from the chord's zero, as a part of the interval: rounding has its share in q."""
AROUND = 0.25
"""Distance from the zero of a line from one side, as a part of the way to it."""


def next_amplitudes(
    amplitude: Floats,
    margin: Floats,
    falls: NDArray[np.bool_],
    where: NDArray[np.int64],
    closest: float,
) -> Floats:
    """Return amplitudes to be tried in some intervals, in ascending order, one or more in each.

    Parameters
    ----------
    amplitude
        What has been tried, ascending, shape (amplitudes,).
    margin, falls
        The margin there, above 0 where the block falls, and whether it does.
    where
        Places of the lower ends of the intervals, shape (intervals,).
    closest
        Part of an amplitude to which a border is wanted.
    """
    # One more at either end, whose slopes are not known.
    padded = np.concatenate([[np.nan], amplitude, [np.nan]])
    a = [padded[where + k] for k in range(4)]
    padded = np.concatenate([[np.nan], margin, [np.nan]])
    m = [padded[where + k] for k in range(4)]
    low, high = a[1], a[2]
    width, middle = high - low, 0.5 * (low + high)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        before, chord, after = ((m[k + 1] - m[k]) / (a[k + 1] - a[k]) for k in range(3))
        q = np.maximum(np.abs(before - chord), np.abs(after - chord)) / np.abs(chord)
        crosses = falls[where] != falls[where + 1]
        straight = crosses & (q < STRAIGHT)
        zero = low - m[1] / chord
        least = np.maximum(0.25 * closest * high, NEAREST * np.spacing(high))
        away = np.maximum(np.maximum(ROOM * q, LEAST) * width, least)
        rising, sinking = -m[1] / before, m[2] / after  # how far the lines' zeros are from the ends
        bent, half = crosses & ~straight & (width > WIDE * high), 0.5 * width
        from_low = bent & (rising > 0.0) & (rising < half)
        from_high = bent & (sinking > 0.0) & (sinking < half)
        tries = [
            (straight, zero - away),
            (straight, zero + away),
            (from_low, low + (1.0 - AROUND) * rising),
            (from_low, low + (1.0 + AROUND) * rising),
            (from_high, high - (1.0 - AROUND) * sinking),
            (from_high, high - (1.0 + AROUND) * sinking),
        ]
    chosen, halved = [], np.ones(len(where), dtype=np.bool_)
    for mask, value in tries:
        inside = mask & (value > low) & (value < high)
        chosen.append(value[inside])
        halved &= ~(straight & inside)  # unless rounding has left no other
    return np.unique(np.concatenate([*chosen, middle[halved]]))
