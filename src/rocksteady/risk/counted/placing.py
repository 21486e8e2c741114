"""Motions on a design spectrum: each stretched in time until its own spectrum lies on it."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.model.checks.arrays import guard_result
from rocksteady.risk.counted.motions import Motion, across, folds, median_fold
from rocksteady.risk.spectra.design_spectrum import DesignSpectrum
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
    def is_far_off(self) -> bool:
        """Whether the motions do not follow the spectrum."""
        return self.misfit > FAR_OFF

    @property
    def at_limit(self) -> int:
        """How many motions would be stretched further."""
        return int((folds(self.stretches) > STEPS[-2]).sum())

    @property
    def pgv_range_m_s(self) -> tuple[float, float, float]:
        """Median, 10 and 90 % quantile of the peak velocities [m/s]."""
        median, low, high = np.quantile(self.pgv_m_s, (0.5, 0.1, 0.9)).tolist()
        return median, low, high

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
