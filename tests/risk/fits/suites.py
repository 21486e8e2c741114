"""Synthetic suites of records with known capacities, and the coverage of bands on them."""

import sys
from dataclasses import dataclass

import numpy as np
from scipy import stats

from rocksteady.risk import BandOptions, fit_curve

MEDIAN, TOTAL_BETA = 0.7, 0.5
LEVELS = np.geomspace(0.1, 4.0, 20)


@dataclass(frozen=True)
class Suite:
    """Trials of records at common levels."""

    intensity: np.ndarray
    failures: np.ndarray
    trials: np.ndarray
    record: np.ndarray


def make_suite(
    records: int, *, seed: int, draws: int = 1, within: float = 0.0, scatter: float = 0.0
) -> Suite:
    """Return a suite whose records fail above a capacity of their own.

    ln capacity is normal about ln MEDIAN with TOTAL_BETA; a share `within` of it (of the standard
    deviation) differs from draw to draw of a record.  With scatter, levels differ by record.
    """
    rng = np.random.default_rng([seed, records])
    between = np.sqrt(1.0 - within**2) * rng.normal(size=(records, 1))
    spread = between + within * rng.normal(size=(records, draws))
    capacity = MEDIAN * np.exp(TOTAL_BETA * spread)
    at = LEVELS * np.exp(scatter * rng.normal(size=(records, 1)))
    failures = (capacity[:, None, :] <= at[:, :, None]).sum(axis=-1)
    number = np.repeat(np.arange(records), len(LEVELS))
    return Suite(at.ravel(), failures.ravel(), np.full(at.size, draws), number)


def coverage(records: int, suites: int, *, draws: int = 1, within: float = 0.0) -> dict[str, float]:
    """Return the share of suites whose 90 % bands hold the truth."""
    probabilities = np.array([0.1, 0.5, 0.9])
    at = MEDIAN * np.exp(TOTAL_BETA * stats.norm.ppf(probabilities))
    hits = []
    for seed in range(suites):
        suite = make_suite(records, seed=seed, draws=draws, within=within)
        counts = (suite.intensity, suite.failures, suite.trials)
        found = fit_curve(*counts, groups=suite.record, bands=BandOptions(seed=seed))
        band = found.probability_band(at)
        if found.median_band is None or found.beta_band is None or band is None:
            continue
        low, high = band
        hits.append(
            [
                found.median_band[0] <= MEDIAN <= found.median_band[1],
                found.beta_band[0] <= TOTAL_BETA <= found.beta_band[1],
                *((low <= probabilities) & (probabilities <= high)),
            ]
        )
    names = ("median", "beta", "P = .1", "P = .5", "P = .9")
    return dict(zip(names, np.mean(hits, axis=0).tolist(), strict=True))


if __name__ == "__main__":  # python -m tests.risk.fits.suites 500: the figures of the documents
    for size in (11, 22, 56):
        shares = {name: round(share, 3) for name, share in coverage(size, int(sys.argv[1])).items()}
        sys.stdout.write(f"{size} records: {shares}\n")
