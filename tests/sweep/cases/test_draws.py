"""Random numbers of cells: against NumPy's own sequences, cell by cell, alone and with others."""

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.sweep.cases.draws import uniform
from tests.every import every

SEEDS = (0, 1, 7, 2**32 - 1, 2**32, 2**64 - 1)
NUMBERS = np.array([0, 1, 2, 41, 10**6, 2**32 - 1, 2**32, 2**32 + 1, 10**12, 2**63 - 1])


def one_by_one(seed: int, number: int, count: int) -> Floats:
    """What a cell draws, from a sequence of its own."""
    sequence = np.random.SeedSequence(seed, spawn_key=(number,))
    words = sequence.generate_state(count, np.uint64)
    return np.array([(word >> 11) / 2**53 for word in words.tolist()])


@every("seed", SEEDS)
@every("count", [1, 2, 5])
def test_a_cell_draws_what_a_sequence_of_its_own_gives(seed: int, count: int) -> None:
    expected = [one_by_one(seed, number, count) for number in NUMBERS.tolist()]
    np.testing.assert_array_equal(uniform(seed, NUMBERS, count), expected)


def test_at_random_too() -> None:
    rng = np.random.default_rng(5)
    numbers = np.concatenate([rng.integers(0, 2**32, 200), rng.integers(0, 2**63, 200)])
    seed = int(rng.integers(0, 2**63))
    expected = [one_by_one(seed, number, 2) for number in numbers.tolist()]
    np.testing.assert_array_equal(uniform(seed, numbers, 2), expected)


def test_a_cell_draws_the_same_whoever_is_beside_it() -> None:
    numbers = np.arange(50)
    whole = uniform(7, numbers, 2)
    np.testing.assert_array_equal(uniform(7, numbers[20:30], 2), whole[20:30])
    np.testing.assert_array_equal(uniform(7, numbers[::-1], 2), whole[::-1])
    np.testing.assert_array_equal(uniform(7, numbers[:1], 2), whole[:1])


def test_more_numbers_begin_with_the_same() -> None:
    numbers = np.arange(20)
    np.testing.assert_array_equal(uniform(3, numbers, 6)[:, :2], uniform(3, numbers, 2))


def test_no_cells_draw_nothing() -> None:
    assert uniform(3, np.arange(0), 2).shape == (0, 2)


def test_cells_and_seeds_differ_and_the_numbers_are_even() -> None:
    found = uniform(11, np.arange(20_000), 2)
    assert found.min() >= 0.0
    assert found.max() < 1.0
    assert len(np.unique(found)) == found.size
    # Mean, variance and correlation of a uniform number, within five standard errors.
    assert abs(found.mean() - 0.5) < 5.0 * np.sqrt(1.0 / 12.0 / found.size)
    assert abs(found.var() - 1.0 / 12.0) < 5.0 * np.sqrt(1.0 / 180.0 / found.size)
    beside = np.corrcoef(found[:-1, 0], found[1:, 0])[0, 1], np.corrcoef(*found.T)[0, 1]
    assert np.abs(beside).max() < 5.0 / np.sqrt(len(found))
    assert not np.isin(uniform(12, np.arange(1000)), found).any()
