"""Surfaces of the probability of a fall: over block and gain, one for each motion.

The share of a draw's own few runs that fall is mostly noise, and a likelihood of hundreds of such
shares picks the luckiest draw.  Of 60 tests, 1,000 runs a test left 149 effective draws on
surfaces, 18 with one global curve a test, and 6 with the shares themselves.
"""

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.kernels.elementary.arrays import exp, log
from rocksteady.risk.calibration.sampler.exact import cholesky, rounded, solve
from rocksteady.risk.calibration.sampler.logistic import (
    AT_BITS,
    DESIGN_BITS,
    PAIR_BITS,
    fit_logistics,
    probability,
)

FAR = 4.0
"""Standard deviations of a property beyond which a surface goes on as at it."""
ENDS = (0.002, 0.998)
"""Shares of the runs between whose loads a surface is followed."""
LEAST_WIDTH = 1e-4
"""Deviation below which a property has one value."""
SWEEPS = (12, 4, 4)
"""Steps of Newton's method between estimates of what motions have in common."""
SURE = 0.6
"""Share of the motions, those of the least variances, that show what motions have in common."""


class Surfaces:
    """Logistic surfaces of block and gain, fitted to the runs of each motion.

    The log odds of a fall are quadratic in the properties of the block and cubic in the load,
    ln(gain/tan alpha), with products.  Coefficients are shrunk to those of the other motions
    (empirical Bayes).

    Parameters
    ----------
    features
        Properties of the blocks, ln tan alpha first, shape (runs, features).
    gain
        ln of the gain of each run over that of its motion, shape (runs,).
    fell
        Outcomes, nan of what was not run, shape (motions, runs).
    peaks
        ln of the largest angle [rad] of runs that stood, nan where it is not wanted, same shape.
    weight
        How much each run counts, 0 to 1, shape (runs,).
    start
        Coefficients to begin at; default none.
    """

    def __init__(
        self,
        features: Floats,
        gain: Floats,
        fell: Floats,
        peaks: Floats,
        weight: Floats,
        start: Floats | None = None,
    ) -> None:
        """Fit."""
        kept = weight > 0.02
        features, gain, fell, peaks = features[kept], gain[kept], fell[:, kept], peaks[:, kept]
        weight = rounded(weight[kept], 10)
        share = weight / weight.sum()
        self.middle, self.width = moments(features, share)
        load = (gain - features[:, 0])[:, np.newaxis]
        self.load_middle, self.load_width = moments(load, share)
        z, load = self._scaled(features), (load - self.load_middle) / self.load_width
        self.reach = np.quantile(load, ENDS)
        load = np.clip(load, -FAR, FAR)
        wide = np.hstack([np.ones((len(z), 1)), z])
        design = np.hstack([quadratic(z), load * wide, load**2 * wide, load**3])
        self.sizes = np.cumsum([quadratic(z[:1]).shape[1], wide.shape[1], wide.shape[1]])
        self.at = _fit(design, fell, weight, start)
        self.peaks = _fit_peaks(design, peaks, weight) if np.isfinite(peaks).any() else None

    def _scaled(self, features: Floats) -> Floats:
        return np.clip((features - self.middle) / self.width, -FAR, FAR)

    def curves(self, features: Floats, motion: Integers, moved: Floats) -> Floats:
        """Return P(fall) with ln of the gain moved, shape (draws, curves, moves).

        Parameters
        ----------
        features
            Shape (draws, features).
        motion
            Motion of each curve, shape (curves,).
        moved
            ln of the gain over that of the motion, shape (curves, moves), or (draws, curves,
            moves).
        """
        return probability(self._value(self.at, features, motion, moved))

    def standing(
        self, features: Floats, motion: Integers, moved: Floats, peak: tuple[float, float]
    ) -> Floats:
        """Return the density of a measured peak of a block that stands, shape as of `curves`.

        ln of the peak is normal about a surface of its own; `peak` is what was measured, and its
        error [rad].
        """
        assert self.peaks is not None
        at, spread = self.peaks
        measured, error = max(*peak), peak[1]
        variance = spread[motion, np.newaxis] ** 2 + (error / measured) ** 2
        apart = log(measured) - self._value(at, features, motion, moved)
        density = exp(-0.5 * apart * apart / variance) / np.sqrt(2.0 * np.pi * variance)
        return (1.0 - self.curves(features, motion, moved)) * (density / measured)

    def _value(self, at: Floats, features: Floats, motion: Integers, moved: Floats) -> Floats:
        """Return the polynomial with these coefficients, shape (draws, curves, moves)."""
        z = rounded(self._scaled(features), DESIGN_BITS)
        wide = np.hstack([np.ones((len(z), 1)), z])
        plain = rounded(quadratic(z), DESIGN_BITS)
        parts = np.split(at, self.sizes, axis=1)
        odds = [part[:, motion, np.newaxis] for part in (
            plain @ parts[0].T, wide @ parts[1].T, wide @ parts[2].T)]  # fmt: skip
        load = (moved - features[:, 0, np.newaxis, np.newaxis] - self.load_middle) / self.load_width
        load = np.clip(load, *self.reach)
        cubic = parts[3][motion]
        return ((cubic * load + odds[2]) * load + odds[1]) * load + odds[0]


def moments(values: Floats, share: Floats) -> tuple[Floats, Floats]:
    """Return weighted means and deviations of columns, on a grid."""
    share = rounded(share, 24)
    middle = rounded(share @ rounded(values, 16), 16)
    square = share @ rounded(np.square(values - middle), 16)
    width = rounded(np.sqrt(square), 16)
    return middle, np.where(width > LEAST_WIDTH, width, np.inf)


def quadratic(z: Floats) -> Floats:
    """Return 1, the columns and their products."""
    first, second = np.triu_indices(z.shape[1])
    return np.hstack([np.ones((len(z), 1)), z, z[:, first] * z[:, second]])


def _fit(design: Floats, fell: Floats, weight: Floats, start: Floats | None) -> Floats:
    """Return the coefficients of all motions, shape (motions, coefficients)."""
    size = design.shape[1]
    mean, precision = np.zeros(size), np.ones(size)
    precision[0] = 0.05
    known = np.isfinite(fell) * weight
    at = start
    for steps in SWEEPS:
        at, error = fit_logistics(
            design,
            np.nan_to_num(fell),
            known,
            precision=precision,
            mean=mean,
            start=at,
            steps=steps,
        )
        # Spread of the coefficients from motion to motion, their own errors taken into account.
        doubt = error[:, 1:].sum(axis=1)
        sure = doubt <= np.quantile(doubt, SURE)
        mean = rounded(at[sure].sum(axis=0) / sure.sum(), AT_BITS)
        spread = np.square(at[sure] - mean).sum(axis=0) / sure.sum()
        precision = 1.0 / (spread + error[sure].sum(axis=0) / sure.sum() + 1e-3)
        mean[0], precision[0] = 0.0, 0.05
    assert at is not None
    return at


def _fit_peaks(design: Floats, peaks: Floats, weight: Floats) -> tuple[Floats, Floats]:
    """Return coefficients of ln of the peaks by least squares, and their spread about it."""
    size, known = design.shape[1], np.isfinite(peaks) * weight
    design = rounded(design, DESIGN_BITS)
    first, second = np.triu_indices(size)
    bend = np.zeros((size, size, len(peaks)))
    bend[second, first] = (known @ rounded(design[:, first] * design[:, second], PAIR_BITS)).T
    bend[np.arange(size), np.arange(size)] += 0.1
    values = rounded(np.nan_to_num(peaks), 14)
    at = solve(cholesky(bend), (rounded(known * values, 17) @ design).T.copy()).T
    at = rounded(at, AT_BITS)
    apart = rounded(np.square(values - at @ design.T) * known, 17).sum(axis=1)
    return at, rounded(np.sqrt(apart / np.maximum(known.sum(axis=1), 1.0)), 17) + 0.05
