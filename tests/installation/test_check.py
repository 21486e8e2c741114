"""The shipped calls: of every kernel, up to date, and each bit of a wrong kernel is noticed."""

import functools
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.installation._recorded import Call, loaded
from rocksteady.installation.check import RECORDED, replay
from rocksteady.kernels.batch.attractors import RESTS
from rocksteady.kernels.core.tables import NONLINEAR_SIDE_COLUMNS, SIDE_COLUMNS
from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.machine_code.compilation import LIBRARY, runner
from rocksteady.kernels.orbits.return_map import FALL, IMPACT, UPLIFT
from rocksteady.kernels.orbits.settle import FALLS, PERIODIC
from rocksteady.outcomes import Status
from tests.every import every
from tests.gpu.fake_gpu import FakeDriver, fake_gpu
from tests.strategies import PLAIN

CALLS = loaded(RECORDED.read_bytes())
RENEW = "renew the calls by `python -m tools.aot.calls`"


def calls_of(entry: str) -> list[Call]:
    return [call for call in CALLS if call.entry == entry]


def columns(table: Any) -> int:
    """The last length of an array."""
    return int(table.shape[-1])


def test_some_300_calls_of_all_kernels_are_shipped() -> None:
    assert {call.entry for call in CALLS} == set(ENTRIES), RENEW
    assert 200 <= len(CALLS) <= 350
    assert RECORDED.stat().st_size < 300_000


@pytest.mark.skipif(PLAIN, reason="tests/kernels/test_recorded_calls.py repeats each uncompiled")
def test_the_shipped_calls_are_those_of_the_kernels_as_they_are() -> None:
    found = rs.installation.check_installation()
    wrong = {check.name: check.first_difference for check in found.checks if not check.equal}
    assert wrong == {}, RENEW
    assert (found.equal, found.differing) == (True, 0)
    assert found.calls == len(CALLS)
    assert found.values > 10_000
    assert found.kernels == runner()
    assert found.versions["rocksteady"] == rs.__version__
    assert found.versions["numpy"] == np.__version__
    assert (found.library is not None) == (found.kernels == LIBRARY)


def test_the_calls_reach_every_end_of_a_motion_in_both_models() -> None:
    ends = {(columns(call.before[1]) > SIDE_COLUMNS, call.results[0]) for call in calls_of("march")}
    both = (Status.ROCKING, Status.AT_REST, Status.OVERTURNED)
    assert ends >= {(False, int(status)) for status in both}
    assert ends >= {(True, int(status)) for status in (*both[1:], Status.LOST_CONTACT)}
    kinds = {call.results[0] for call in calls_of("next_passage") + calls_of("uplift_after")}
    assert kinds >= {IMPACT, UPLIFT, FALL}
    assert {call.results[0] for call in calls_of("settle")} >= {PERIODIC, FALLS}
    whole = [np.asarray(call.after[9]) for call in calls_of("settle_cells")]
    assert any(cells[:, RESTS].any() for cells in whole), "orbits that rest"
    models = {columns(call.before[2]) for call in calls_of("settle_cells")}
    assert models == {SIDE_COLUMNS, NONLINEAR_SIDE_COLUMNS}


def last_bit(kernel: Callable[..., Any]) -> Callable[..., Any]:
    """Return a kernel whose first array result, or first number, is wrong in its last bit."""

    @functools.wraps(kernel)
    def wrong(*arguments: Any) -> Any:
        result = kernel(*arguments)
        if isinstance(result, float):
            return np.nextafter(result, np.inf)
        arguments[-1].flat[0] = np.nextafter(arguments[-1].flat[0], np.inf)
        return result

    return wrong


@every(
    ("entry", "where"),
    [("symmetry_breaking", "result"), ("fill_curves", "curves[0, 0]"), ("fill_clocks", "rest[0]")],
)
def test_one_wrong_bit_is_found_and_named(entry: str, where: str) -> None:
    calls = [*calls_of(entry), *calls_of("clock")]
    right, clock = replay(calls, ENTRIES)
    assert (right.equal, clock.equal) == (True, True)
    wrong, clock = replay(calls, {**ENTRIES, entry: last_bit(ENTRIES[entry])})
    assert clock.equal
    assert not wrong.equal
    assert (wrong.name, wrong.calls, wrong.differing) == (entry, right.calls, right.calls)
    assert wrong.values == right.values
    assert wrong.first_difference is not None
    assert wrong.first_difference.startswith(f"call 1 of {wrong.calls}, {where}: ")


def test_a_gpu_that_can_run_is_named(tmp_path: Path) -> None:
    with fake_gpu(tmp_path):
        found = rs.installation.check_installation(repeat_calls=False)
    assert (found.gpu, found.no_gpu) == ("NVIDIA Imaginary, compute capability 9.0", None)
    old = FakeDriver(name="Tesla T4", capability=(7, 5))
    with fake_gpu(tmp_path, old):
        found = rs.installation.check_installation(repeat_calls=False)
    assert found.gpu is None
    assert found.no_gpu is not None
    assert found.no_gpu.startswith("Tesla T4 has compute capability 7.5, and ")


def test_without_programs_of_the_kernels_a_gpu_cannot_run(tmp_path: Path) -> None:
    with fake_gpu(tmp_path):
        for file in tmp_path.glob("*queued_record_fates.ptx"):
            file.unlink()
        found = rs.installation.check_installation(repeat_calls=False)
    assert found.no_gpu is not None
    assert found.no_gpu.startswith("the GPU program of queued_")
