"""Words of motions on a design spectrum: how they lie on it, and what is doubtful."""

import math
from typing import Final

from rocksteady.results.numbers import number, quantity
from rocksteady.results.stated import Stated
from rocksteady.risk.counted.motions import median_fold
from rocksteady.risk.counted.placing import Placing
from rocksteady.risk.spectra.design_spectrum import PLACED_S

MOST_DOUBTS: Final = 2
"""Doubts on a line, the gravest first: a longer one is left out of a screen."""
DOUBTFUL_STRETCH: Final = 3.5
"""Median fold of stretches on a spectrum above which there is a doubt."""


def misfit_words(placing: Placing) -> str:
    """Return the median misfit, as "32 %"; above 1 as a factor."""
    if placing.misfit > 1.0:
        return f"{number(math.exp(placing.misfit), 2)}-fold"
    return f"{number(100.0 * placing.misfit, 2)} %"


def doubt_on_spectrum(placing: Placing) -> str:
    """Return why no answer on it is green; empty where it may be."""
    far = f"half of the records miss the spectrum by {misfit_words(placing)} or more"
    return placing.spectrum.peak_words or far * placing.is_far_off


def spectrum_line(placing: Placing, doubt: str) -> Stated:
    """Return how the motions lie on it and what is doubtful, as a line of a screen."""
    (first, last), limited = placing.spectrum.range_s, placing.at_limit
    median, low, high = placing.pgv_range_m_s
    pgv = f"PGV {quantity(median, 'm/s', 2)} ({number(low, 2)} to {number(high, 2)})"
    is_far = median_fold(placing.stretches) > DOUBTFUL_STRETCH
    doubts = [
        doubt,
        placing.spectrum.damping_words,
        f"{limited} at the limit of the stretch" * bool(limited),
        f"half are stretched over {DOUBTFUL_STRETCH:g}-fold: doubtful" * is_far,
    ]
    span = f"{number(first)} to {number(last)} s{', its end' * (last < PLACED_S[1])}"
    return Stated(
        quantity="spectrum",
        text=f"{span}, met to {misfit_words(placing)}; {pgv}",
        condition="; ".join([*filter(None, doubts)][:MOST_DOUBTS]),
    )


def spectrum_remark(placing: Placing) -> str:
    """Return how the mean spectrum of the motions lies on the design spectrum."""
    ends = " to ".join(number(each) for each in placing.spectrum.range_s)
    least, most = (number(each, 2) for each in placing.mean_over_spectrum)
    return f"From {ends} s the mean spectrum of the motions is {least} to {most} of it."
