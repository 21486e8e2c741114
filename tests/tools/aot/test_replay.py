"""Recorded calls on every target that runs here: all bits equal, and each wrong one noticed."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from rocksteady.installation._recorded import Call, loaded
from rocksteady.installation.check import RECORDED
from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.machine_code.library import file_name, targets
from tests.every import every
from tests.strategies import PLAIN
from tools.aot.build import build
from tools.aot.calls.__main__ import large_calls
from tools.aot.replay import native
from tools.aot.replay.everywhere import ARM, RUNS, UNDER_WINE
from tools.aot.replay.outcome import MissingProgramError, Repeated, read

CALLS = loaded(RECORDED.read_bytes())
QUICK = ("C", "node", "Chromium", "wasmtime")
"""Targets for which nothing more is compiled than the library and the module."""
OTHERS = ("linux-x86-64-v2", ARM, UNDER_WINE)
"""Targets that are compiled first. x86-64-v3 is left out: v2 and this processor are beside it."""
BUILT = (*targets(), UNDER_WINE)
PART = 0.01
"""Share of the cells that a release is compared by."""

pytestmark = pytest.mark.skipif(PLAIN, reason="no library is loaded")


@cache
def many_cells() -> list[Call]:
    """Calls of many cells, smaller than those that are compared before a release."""
    return large_calls(ENTRIES, PART)


def prepare(name: str, built: Path) -> None:
    """Compile what a target needs, unless that is done or nothing runs it here."""
    if name == UNDER_WINE and native.emulator(native.WINDOWS) is None:
        pytest.skip("wine is not installed")
    if name in BUILT and not (built / file_name(name)).is_file():
        build([name], built)


def repeated(name: str, built: Path, calls: list[Call]) -> list[Repeated]:
    try:
        return RUNS[name](built, calls)
    except MissingProgramError as error:
        pytest.skip(str(error))


def wrong(found: list[Repeated]) -> dict[str, int]:
    return {call.entry: call.differing for call in found if call.differing}


def test_every_target_that_runs_here_is_known() -> None:
    levels = {f"linux-x86-64-v{level}" for level in (2, 3, 4)}
    assert set(RUNS) == {*levels, ARM, UNDER_WINE, *QUICK}


@pytest.mark.slow
@every("name", QUICK)
def test_the_shipped_calls_give_the_same_bits(name: str, built: Path) -> None:
    found = repeated(name, built, CALLS)
    assert wrong(found) == {}
    assert [call.entry for call in found] == [call.entry for call in CALLS]
    assert sum(call.values for call in found) > 10_000


@pytest.mark.slow
@every("name", QUICK)
def test_one_wrong_bit_is_noticed(name: str, built: Path) -> None:
    # What should come out is changed: the last bit of a number, of an array's element and a sign.
    number = next(call for call in CALLS if call.entry == "symmetry_breaking")
    array = next(call for call in CALLS if call.entry == "fill_exp")
    zero = next(call for call in CALLS if call.entry == "fill_sin")
    changed = [
        number._replace(results=(np.nextafter(number.results[0], np.inf).item(),)),
        array._replace(after=(*array.after[:-1], altered(array.after[-1]))),
        zero._replace(after=(*zero.after[:-1], with_other_zeros(zero.after[-1]))),
        number,
    ]
    found = repeated(name, built, changed)
    zeros = int((np.asarray(zero.after[-1]) == 0.0).sum())
    assert zeros > 0
    assert [call.differing for call in found] == [1, 1, zeros, 0]
    assert [call.values for call in found] == [4, 120, 120, 4]


def altered(values: object) -> np.ndarray:
    """An array with one finite element larger by its last bit."""
    array = np.array(values)
    place = np.flatnonzero(np.isfinite(array) & (array != 0.0))[0]
    array[place] = np.nextafter(array[place], np.inf)
    return array


def with_other_zeros(values: object) -> np.ndarray:
    """An array whose zeros have the other sign."""
    array = np.array(values)
    array[array == 0.0] *= -1.0
    return array


@pytest.mark.slow
@every("name", QUICK)
def test_any_nan_stands_for_any_other(name: str, built: Path) -> None:
    call = next(call for call in CALLS if call.entry == "fill_log")
    result = np.array(call.after[-1])
    assert np.isnan(result).any()
    bits = result.view(np.uint64)
    bits[np.isnan(result)] = 0xFFF8000000000123
    found = repeated(name, built, [call._replace(after=(*call.after[:-1], result))])
    assert [each.differing for each in found] == [0]


def test_what_a_replay_prints_is_read() -> None:
    assert read("march 12 0\nclock 3 1\n") == [Repeated("march", 12, 0), Repeated("clock", 3, 1)]


@pytest.mark.slow
@pytest.mark.parametrize("name", OTHERS)
def test_other_processors_give_the_same_bits(name: str, built: Path) -> None:
    prepare(name, built)
    assert wrong(repeated(name, built, CALLS)) == {}


@pytest.mark.slow
@pytest.mark.parametrize("name", [*OTHERS, *QUICK])
def test_many_cells_give_the_same_bits(name: str, built: Path) -> None:
    prepare(name, built)
    found = repeated(name, built, many_cells())
    assert wrong(found) == {}
    assert min(each.values for each in found) > 1000 * PART
