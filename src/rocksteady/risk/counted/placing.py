"""Motions on a design spectrum: each stretched in time until its own spectrum lies on it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.model.checks.arrays import guard_result
from rocksteady.results.numbers import number, quantity
from rocksteady.results.stated import Stated
from rocksteady.risk.counted.motions import Motion, across, folds, median_fold
from rocksteady.risk.spectra.design_spectrum import PLACED_S, DesignSpectrum
from rocksteady.seismic.measures.sampled_spectrum import sample_pseudo_acceleration

GRID_S: Final = np.geomspace(0.02, 20.0, 100)
"""Periods of the spectra of motions [s]; a stretch slides the spectra along them."""
MOST_STRETCH: Final = 8.0
"""Largest fold of a stretch that is tried."""
STEPS: Final = np.geomspace(1.0 / MOST_STRETCH, MOST_STRETCH, 241)
"""Stretches that are tried."""
COMPARED: Final = 40
"""Number of periods at which spectra are compared, evenly in ln T."""
FAR_OFF: Final = 0.45
"""Median misfit above which motions do not follow a spectrum."""
MOST_DOUBTS: Final = 2
"""Doubts on a line, the gravest first: a longer one is left out of a screen."""
DOUBTFUL_STRETCH: Final = 3.5
"""Median fold of stretches on a spectrum above which there is a doubt."""


@guard_result
@dataclass(frozen=True, kw_only=True, eq=False)
class Placing:
    """How motions lie on a design spectrum.

    Attributes
    ----------
    spectrum
        The design spectrum, whose peak acceleration all motions have.
    shapes
        ln(PSA/PGA) of the motions as they are, over `GRID_S`, shape (motions, periods).
    stretches, misfits
        Factor of time of each motion, and its rms difference in ln Sa from the spectrum then.
    pgv_m_s
        Peak velocity of each motion as placed [m/s].
    """

    spectrum: DesignSpectrum
    shapes: Floats
    stretches: Floats
    misfits: Floats
    pgv_m_s: Floats

    @property
    def misfit(self) -> float:
        """Median of the misfits."""
        return float(np.median(self.misfits))

    @property
    def misfit_words(self) -> str:
        """That median, as "32 %"; above 1 as a factor."""
        if self.misfit > 1.0:
            return f"{number(math.exp(self.misfit), 2)}-fold"
        return f"{number(100.0 * self.misfit, 2)} %"

    @property
    def is_far_off(self) -> bool:
        """Whether the motions do not follow the spectrum."""
        return self.misfit > FAR_OFF

    @property
    def doubt(self) -> str:
        """Why no answer on it is green, in words; empty of nothing."""
        far = f"half of the records miss the spectrum by {self.misfit_words} or more"
        return self.spectrum.peak_words or far * self.is_far_off

    @property
    def at_limit(self) -> int:
        """How many motions would be stretched further."""
        return int((folds(self.stretches) > STEPS[-2]).sum())

    @property
    def pgv_range_m_s(self) -> tuple[float, float, float]:
        """Median, 10 and 90 % quantile of the peak velocities [m/s]."""
        median, low, high = np.quantile(self.pgv_m_s, (0.5, 0.1, 0.9)).tolist()
        return median, low, high

    def line(self, doubt: str) -> Stated:
        """Return how the motions lie on it and what is doubtful, as a line of a screen."""
        (first, last), limited = self.spectrum.range_s, self.at_limit
        median, low, high = self.pgv_range_m_s
        pgv = f"PGV {quantity(median, 'm/s', 2)} ({number(low, 2)} to {number(high, 2)})"
        is_far = median_fold(self.stretches) > DOUBTFUL_STRETCH
        doubts = [
            doubt,
            self.spectrum.damping_words,
            f"{limited} at the limit of the stretch" * bool(limited),
            f"half are stretched over {DOUBTFUL_STRETCH:g}-fold: doubtful" * is_far,
        ]
        span = f"{number(first)} to {number(last)} s{', its end' * (last < PLACED_S[1])}"
        return Stated(
            quantity="spectrum",
            text=f"{span}, met to {self.misfit_words}; {pgv}",
            condition="; ".join([*filter(None, doubts)][:MOST_DOUBTS]),
        )

    def spectra_g(self, periods_s: Floats) -> Floats:
        """Return the spectra of the motions as placed [g], shape (motions, periods)."""
        t, grid = np.log(periods_s), np.log(GRID_S)
        pairs = zip(self.shapes, np.log(self.stretches), strict=True)
        logs = np.array([np.interp(t - moved, grid, shape) for shape, moved in pairs])
        return np.asarray(self.spectrum.peak_g * np.exp(logs))

    @property
    def mean_over_spectrum(self) -> tuple[float, float]:
        """Least and largest ratio of the mean spectrum (of ln Sa) to the design spectrum."""
        t = compared_s(self.spectrum)
        ratios = self.mean_g(t) / self.spectrum.accelerations_g(t)
        return float(ratios.min()), float(ratios.max())

    def mean_g(self, periods_s: Floats) -> Floats:
        """Return the mean spectrum of the motions as placed, that of ln Sa [g]."""
        return np.asarray(np.exp(np.log(self.spectra_g(periods_s)).mean(axis=0)))

    @property
    def values(self) -> dict[str, Any]:
        """What JSON says of it."""
        median, low, high = self.pgv_range_m_s
        least, most = self.mean_over_spectrum
        return {
            **self.spectrum.values,
            "misfit": self.misfit,
            "median_stretch": median_fold(self.stretches),
            "largest_stretch": float(folds(self.stretches).max()),
            "at_limit": self.at_limit,
            "pgv_m_s": {"median": median, "low": low, "high": high},
            "mean_over_spectrum": {"least": least, "most": most},
        }

    @property
    def remark(self) -> str:
        """How the mean spectrum of the motions lies on the design spectrum, as a sentence."""
        ends = " to ".join(number(each) for each in self.spectrum.range_s)
        least, most = (number(each, 2) for each in self.mean_over_spectrum)
        return f"From {ends} s the mean spectrum of the motions is {least} to {most} of it."


def shapes_of(motions: Sequence[Motion]) -> Floats:
    """Return ln(PSA/PGA) of horizontal motions at 5 % damping, shape (motions, periods)."""
    records = [across(each) for each in motions]
    return np.array(
        [
            np.log(sample_pseudo_acceleration(each, GRID_S) / each.peak_acceleration_m_s2)
            for each in records
        ]
    )


def compared_s(spectrum: DesignSpectrum) -> Floats:
    """Return the periods at which motions are compared with a spectrum [s]."""
    return np.geomspace(*spectrum.range_s, COMPARED)


def fit_stretches(shapes: Floats, spectrum: DesignSpectrum) -> tuple[Floats, Floats]:
    """Return the stretch of each motion with which it lies on a spectrum, and its misfit.

    The peak acceleration is exact; of `STEPS` the one with the least squares of ln Sa.
    """
    t, grid = compared_s(spectrum), np.log(GRID_S)
    wanted = np.log(spectrum.accelerations_g(t) / spectrum.peak_g)
    moved = np.log(t) - np.log(STEPS)[:, np.newaxis]
    off = np.array([np.interp(moved, grid, shape) - wanted for shape in shapes])
    misfits = np.sqrt((off * off).mean(axis=2))
    best = misfits.argmin(axis=1)
    return STEPS[best], misfits[np.arange(len(best)), best]
