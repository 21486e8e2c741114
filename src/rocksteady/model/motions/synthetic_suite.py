"""Synthetic motions for examples and trials: clearly named, seeded, and no earthquake's."""

import math
from typing import TYPE_CHECKING

from rocksteady.kernels.elementary.arrays import exp, log
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import whole_number
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.synthetic import SyntheticMotion

if TYPE_CHECKING:
    import numpy as np

FREQUENCIES_HZ = (1.2, 5.0)
"""Of the ground, from soft to firm: evenly in the logarithm over a suite."""

DURATIONS_S = (12.0, 18.0, 27.0)
"""Taken in turn."""

HIGH_PASS = 0.3
"""Over the frequency of the ground: with it PGV/PGA is .05 to .25 s, as of records."""

RMS_M_S2 = 1.0
"""Of the strong part; the largest acceleration is some 0.3 g."""


@checked
def make_synthetic_suite(count: int = 24, *, seed: int = 0) -> list[Record]:
    """Make a suite of synthetic motions, for trials without records.

    Parameters
    ----------
    count
        Number of motions; default 24, of which a fragility curve can be fitted.
    seed
        A whole number of 0 or above; the same one gives the same suite.

    Returns
    -------
    list of Record
        Named "synthetic 1", ...; each a `SyntheticMotion` with an rms of 1 m/s^2 while it is
        strong, a ground of 1.2 to 5 Hz and a duration of 12, 18 or 27 s.

    Raises
    ------
    InputError
        If a number is outside its range.

    Examples
    --------
    >>> suite = make_synthetic_suite(3)
    >>> suite[0].name, round(suite[0].duration_s, 6), len(suite)
    ('synthetic 1', 12.0, 3)
    """
    number = whole_number("count", count, at_least=1, at_most=1000, hint="give 24")
    first = whole_number("seed", seed, at_least=0, hint="give a seed, as 0")
    import numpy as np

    seeds = np.random.SeedSequence(first).generate_state(number).tolist()
    return [_motion(place, number, each) for place, each in enumerate(seeds)]


def _motion(place: int, count: int, seed: int) -> Record:
    """Return one motion of a suite."""
    low, high = FREQUENCIES_HZ
    # The golden ratio spreads frequencies over any number of motions, beside every duration.
    part = (place * 0.6180339887498949) % 1.0 if count > 1 else 0.5
    frequency = low * exp(part * log(high / low))
    made = SyntheticMotion(
        rms=RMS_M_S2,
        frequency_ratio=2.0 * math.pi * frequency,  # of a p of 1 rad/s: pivot time is seconds
        duration=DURATIONS_S[place % len(DURATIONS_S)],
        seed=seed,
        high_pass_ratio=HIGH_PASS,
    )
    samples: np.ndarray[tuple[int], np.dtype[np.float64]] = made.samples
    return Record(acceleration_m_s2=samples, dt_s=made.step, name=f"synthetic {place + 1}")
