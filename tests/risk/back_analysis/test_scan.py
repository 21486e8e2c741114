"""Shakings that are tried: draws by the number of objects, and what is no scan."""

import pytest

from rocksteady.calibration import ScanOptions
from rocksteady.errors import InputError
from tests.every import every


@every(
    ("objects", "draws"),
    [(1, 64), (5, 64), (6, 54), (10, 32), (32, 10), (39, 9), (40, 8), (41, 8), (10_000, 8)],
)
def test_draws_share_three_hundred_and_twenty_among_the_objects(objects: int, draws: int) -> None:
    """Rounded up: no fewer together than 320, but 8 at least and 64 at most of each."""
    assert ScanOptions().draws_of(objects) == draws
    assert ScanOptions(draws=3).draws_of(objects) == 3


def test_a_temper_is_above_0_and_at_most_1_or_chosen_by_trials() -> None:
    assert ScanOptions(temper=1.0, trials=0).temper == 1.0
    assert ScanOptions(trials=1).temper == "auto"
    for wrong in (0.0, 1.001, float("nan")):
        with pytest.raises(InputError, match="temper"):
            ScanOptions(temper=wrong)
    with pytest.raises(InputError, match="trials = 0"):
        ScanOptions(trials=0)
    for limits in ((1.0, 1.0), (2.0, 1.0), (0.0, 1.0)):
        with pytest.raises(InputError, match="limits"):
            ScanOptions(limits=limits)
    with pytest.raises(InputError, match="objects"):
        ScanOptions().draws_of(0)


def test_numbers_of_a_scan_reach_the_ends_of_their_ranges_and_no_further() -> None:
    wrong = []
    for key, low, high in (
        *(("levels", 4, 200), ("draws", 2, 10_000), ("trials", 1, 1000), ("seed", 0, None)),
    ):
        for value, taken in (
            *((low - 1, key == "trials"), (low, True)),
            *(((high, True), (high + 1, False)) if high else ((10**9, True),)),
        ):
            try:
                ScanOptions(**{"temper": 0.5, key: value})
                result = True
            except InputError:
                result = False
            if result != taken:
                wrong.append((key, value))
    assert wrong == []
    plain = ScanOptions()
    assert (plain.limits, plain.levels, plain.draws, plain.temper) == (None, 22, None, "auto")
    assert (plain.trials, plain.seed) == (4, 0)
