"""Surfaces of runs whose probability of a fall is known."""

from typing import Any

import numpy as np
import pytest
from scipy import special

from rocksteady.arrays import Floats
from rocksteady.risk.calibration.sampler.surfaces import Surfaces

LEVELS = np.array([-0.3, 0.0, 0.1, 0.4])
"""ln of the gain over tan alpha at which the motions make half of the blocks fall."""


def chance(features: Floats, gain: Floats) -> Any:
    """Return P(fall) of each motion, shape (motions, ...)."""
    load = gain - features[:, 0] + 0.3 * features[:, 1] - 0.5 * np.square(features[:, 2])
    return special.expit(8.0 * (load - LEVELS[:, np.newaxis]))


def runs_of(count: int, seed: int) -> tuple[Floats, Floats, Floats]:
    """Return properties, gains and outcomes of runs."""
    rng = np.random.default_rng(seed)
    features = np.column_stack(
        [rng.normal(-1.5, 0.2, count), rng.uniform(-1.0, 1.0, count), rng.normal(0.0, 0.3, count)]
    )
    gain = rng.uniform(-0.5, 0.5, count) - 1.5
    p = chance(features, gain)
    return features, gain, (rng.random(p.shape) < p).astype(float)


def fit(features: Floats, gain: Floats, fell: Floats, weight: Floats | None = None) -> Surfaces:
    weight = np.ones(len(gain)) if weight is None else weight
    return Surfaces(features, gain, fell, np.full(fell.shape, np.nan), weight)


def test_surfaces_are_those_that_the_runs_have() -> None:
    features, gain, fell = runs_of(4000, 1)
    fell[1, 1000:] = np.nan  # a motion that few draws have run leans on the others
    surfaces = fit(features, gain, fell)
    features, _, _ = runs_of(200, 2)
    moved = np.array([-1.9, -1.6, -1.5, -1.4, -1.1])
    found = surfaces.curves(features, np.array([2, 0, 1, 3]), np.tile(moved, (4, 1)))
    assert found.shape == (200, 4, 5)
    for place, motion in enumerate((2, 0, 1, 3)):
        for column, gain in enumerate(moved):
            exact = chance(features, np.full(200, gain))[motion]
            assert np.abs(found[:, place, column] - exact).mean() < 0.035
    each = np.broadcast_to(moved, (200, 4, 5))
    assert (surfaces.curves(features, np.array([2, 0, 1, 3]), each) == found).all()


def test_runs_without_weight_do_not_count_and_far_loads_are_level() -> None:
    features, gain, fell = runs_of(900, 3)
    few = fit(features[:500], gain[:500], fell[:, :500])
    fell[:, 500:] = 1.0 - fell[:, 500:]
    weight = (np.arange(900) < 500).astype(float)
    assert (few.at == fit(features, gain, fell, weight).at).all()
    assert (few.at != fit(features, gain, fell, np.maximum(weight, 0.5)).at).any()
    ends = few.curves(features[:5], np.arange(4), np.tile([-9.0, -6.0, 3.0, 9.0], (4, 1)))
    assert (ends[..., 0] == ends[..., 1]).all()
    assert (ends[..., 2] == ends[..., 3]).all()
    assert ends[..., 0].max() < 0.1
    assert ends[..., 2].min() > 0.5


def test_peaks_of_blocks_that_stand_have_a_density() -> None:
    """A lognormal about a plane: its integral is the chance to stand, and its middle the plane."""
    features, gain, fell = runs_of(4000, 5)
    rng = np.random.default_rng(6)
    peaks = 1.5 * (gain - features[:, 0]) - 3.0 + 0.1 * rng.standard_normal(fell.shape)
    peaks[fell > 0.0] = np.nan
    surfaces = Surfaces(features, gain, fell, peaks, np.ones(4000))
    features, _, _ = runs_of(20, 7)
    moved = np.full((4, 1), -1.8)
    angles = np.exp(np.linspace(-6.0, 0.0, 400))
    densities = np.stack(
        [surfaces.standing(features, np.arange(4), moved, (at, 1e-6 * at))[..., 0] for at in angles]
    )
    stand = 1.0 - surfaces.curves(features, np.arange(4), moved)[..., 0]
    assert np.trapezoid(densities, angles, axis=0) == pytest.approx(stand, rel=1e-3)
    largest = np.log(angles[np.argmax(densities * angles[:, np.newaxis, np.newaxis], axis=0)])
    plane = 1.5 * (-1.8 - features[:, 0]) - 3.0
    assert np.abs(largest - plane[:, np.newaxis]).mean() < 0.05
