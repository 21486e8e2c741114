"""Restitution that scatters: published numbers of the cipher, and the statistics of the draws."""

from itertools import product

import numpy as np
import pytest
from scipy.stats import chi2, kstest, truncnorm

from rocksteady.kernels.core.scatter import (
    LARGEST_KEY,
    largest_restitution,
    restitution_of,
    threefry,
    uniform,
)
from tests.every import every
from tests.kernels.scattering import draws, enciphered, scattered
from tests.kernels.tables import both_sides
from tests.strategies import inner_sample_size

ONES = 2**32 - 1
LAWS = ((0.9, 0.05), (0.9, 0.1), (0.98, 0.08), (0.7, 0.2), (0.05, 0.1), (0.5, 1.0))


@every(
    ("key", "count", "words"),
    [
        ((0, 0), (0, 0), (0x6B200159, 0x99BA4EFE)),
        ((ONES, ONES), (ONES, ONES), (0x1CB996FC, 0xBB002BE7)),
        ((0x13198A2E, 0x03707344), (0x243F6A88, 0x85A308D3), (0xC4923A9C, 0x483DF7A0)),
    ],
)
def test_the_cipher_gives_the_words_that_its_authors_publish(
    key: tuple[int, int], count: tuple[int, int], words: tuple[int, int]
) -> None:
    assert threefry(*key, *count) == words


def test_the_cipher_is_that_of_words_that_overflow() -> None:
    rng = np.random.default_rng(1)
    count = inner_sample_size(20_000, 500)
    keys = rng.integers(0, LARGEST_KEY, count, endpoint=True)
    impacts, attempts = rng.integers(0, 2**32, (2, count))
    high, low = enciphered(keys, impacts, attempts)
    for i in range(count):
        key = int(keys[i])
        found = threefry(key & ONES, key >> 32, int(impacts[i]), int(attempts[i]))
        assert found == (high[i], low[i])
        middle = (((int(high[i]) << 32 | int(low[i])) >> 12) + 0.5) / 2.0**52
        assert uniform(key, int(impacts[i]), int(attempts[i])) == middle


@every(("mean", "deviation"), LAWS)
def test_an_impact_has_the_first_draw_inside_the_bounds(mean: float, deviation: float) -> None:
    count = inner_sample_size(5_000, 100)
    rng = np.random.default_rng(2)
    keys = rng.integers(0, LARGEST_KEY, count, endpoint=True)
    impacts = rng.integers(1, 2**31, count)
    found = [
        restitution_of(scattered(both_sides(mean), deviation, int(key)), row, int(impact))
        for row, key, impact in zip((np.arange(count) % 2).tolist(), keys, impacts, strict=True)
    ]
    np.testing.assert_allclose(found, draws(mean, deviation, keys, impacts), rtol=1e-13, atol=1e-15)


@pytest.mark.slow
@every(("mean", "deviation"), LAWS)
def test_draws_are_those_of_the_normal_distribution_cut_off(mean: float, deviation: float) -> None:
    ends = (-mean / deviation, 0.5 * (1.0 - mean) / deviation)
    law = truncnorm(*ends, loc=mean, scale=deviation)
    keys, impacts = np.arange(100_000), np.arange(1, 100_001)
    for cells, numbers in ((keys, impacts[0]), (keys[7], impacts), (keys, impacts[::-1])):
        found = draws(mean, deviation, cells, numbers)
        assert kstest(found, law.cdf).pvalue > 1e-3
        assert 0.0 < found.min() < found.max() <= 0.5 * (1.0 + mean)
        error = law.std() / np.sqrt(len(found))
        assert found.mean() == pytest.approx(law.mean(), abs=4.0 * error)
        assert found.std() == pytest.approx(law.std(), rel=0.02)


def test_cells_and_impacts_draw_independently() -> None:
    cells, impacts = np.arange(400)[:, np.newaxis], np.arange(1, 251)[np.newaxis]
    found = draws(0.9, 0.05, cells, impacts)
    ranks = found.argsort(axis=None).argsort().reshape(found.shape) / found.size
    centred = ranks - 0.5
    for down, along in product((0, 1, 2, 16), (0, 1, 2, 3, 16)):
        if down == along == 0:
            continue
        here = ranks[: len(ranks) - down, : ranks.shape[1] - along]
        there = ranks[down:, along:]
        pairs = np.histogram2d(here.ravel(), there.ravel(), bins=16, range=[[0, 1], [0, 1]])[0]
        expected = here.size / 256
        assert chi2.sf(((pairs - expected) ** 2 / expected).sum(), 255) > 1e-4
        product_mean = (centred[: len(here), : here.shape[1]] * centred[down:, along:]).mean()
        assert abs(12.0 * product_mean) < 4.0 / np.sqrt(here.size)
    # Sums over the impacts of a cell scatter as those of independent numbers do.
    assert centred.sum(axis=1).var() == pytest.approx(250 / 12, rel=4.0 * np.sqrt(2 / 400))


def test_the_largest_restitution_is_that_of_both_sides_and_of_any_draw() -> None:
    sides = both_sides((0.8, 0.9))
    assert largest_restitution(sides) == largest_restitution(scattered(sides, 0.0, 3)) == 0.9
    assert largest_restitution(scattered(sides, 0.1, 3)) == 0.95
    one = scattered(sides, 0.0, 3)
    one[0, 5] = 0.3
    assert largest_restitution(one) == 0.9
    one[0, 0] = 0.85
    assert largest_restitution(one) == 0.925


def test_without_deviation_an_impact_has_the_mean() -> None:
    sides = scattered(both_sides((0.8, 0.9)), 0.0, 5)
    assert [restitution_of(sides, row, 1) for row in (0, 1)] == [0.8, 0.9]
