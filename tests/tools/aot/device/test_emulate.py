"""A launch, emulated: the same bits as the library of this processor, whoever takes which cell."""

import dataclasses
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.installation._recorded import Call, arguments_of
from rocksteady.kernels.core.queue import LEFT_OVER
from rocksteady.kernels.core.tuples import Cells, Fates, Starts
from rocksteady.kernels.devices import FORMS, Form, form_of
from rocksteady.kernels.entries import ENTRIES
from tests.every import every
from tests.strategies import PLAIN
from tools.aot.calls import batches
from tools.aot.calls.recorder import Recorder
from tools.aot.device.emulate import Emulated

pytestmark = pytest.mark.skipif(PLAIN, reason="no library is loaded")

CELLS = {False: 6000, True: 500}
"""Of a call, by whether the model is nonlinear."""
RARE = 0.05
"""Largest share of cells that a device leaves to the processor's own kernel."""


@cache
def calls(*, nonlinear: bool) -> list[Call]:
    """Calls of this processor's library: arguments and results."""
    call, cells = Recorder(ENTRIES), CELLS[nonlinear]
    for leaping in (True, False):
        batches.record_fates(call, f"device {leaping}", cells, nonlinear=nonlinear, leaping=leaping)
    batches.record_attractors(call, "device", cells // 3, nonlinear=nonlinear)
    batches.record_attractors(call, "device", cells // 6, nonlinear=nonlinear, chatter=True)
    for scattered in (False, True):
        batches.record_records(
            call, "device", cells, nonlinear=nonlinear, samples=200, scattered=scattered
        )
    return [each for each in call.calls if _form(each) is not None]


def _form(call: Call) -> Form | None:
    return form_of(ENTRIES[call.entry], tuple(arguments_of(ENTRIES[call.entry], call.before)))


def calls_of(form: Form) -> list[Call]:
    """The recorded calls that a device runs in one form."""
    return [
        each for model in (False, True) for each in calls(nonlinear=model) if _form(each) is form
    ]


def code(results: Sequence[NDArray[Any]]) -> NDArray[np.int64]:
    """How each cell ended: what a kernel leaves over is marked there."""
    first: NDArray[np.int64] = results[0]
    return first if first.ndim == 1 else first[:, 0]


def results_of(form: Form, run: Callable[[Form, list[Any]], None], call: Call) -> list[Any]:
    """The results of a recorded call, computed again."""
    given = [np.array(leaf) if isinstance(leaf, np.ndarray) else leaf for leaf in call.before]
    arguments = arguments_of(ENTRIES[call.entry], given)
    run(form, arguments)
    return list(arguments[-1])


def bits(array: NDArray[Any]) -> NDArray[np.int64]:
    return np.ascontiguousarray(array).view(np.int64)


@pytest.mark.slow
@every("name", FORMS)
def test_every_bit_is_that_of_the_library(name: str, emulated: Emulated) -> None:
    form = FORMS[name]
    recorded = calls_of(form)
    assert recorded
    for call in recorded:
        computed = results_of(form, emulated.run, call)
        expected = [np.asarray(each) for each in call.after[-len(computed) :]]
        done, known = code(computed) != LEFT_OVER, code(expected) != LEFT_OVER
        for mine, theirs in zip(computed, expected, strict=True):
            assert np.array_equal(bits(mine[done & known]), bits(theirs[done & known]))
        assert not (done & ~known).any()
        assert (known & ~done).mean() < RARE


@pytest.mark.slow
@every("name", FORMS)
def test_no_bit_depends_on_who_takes_a_cell_and_when(name: str, emulated: Emulated) -> None:
    form = FORMS[name]
    call = calls_of(form)[0]
    cells = len(np.asarray(call.after[-1]))
    order = np.random.default_rng(1).permutation(cells).astype(float)
    usual = results_of(form, emulated.run, call)
    alone = Emulated(emulated.library, workers=1)
    mixed = dataclasses.replace(form, length=lambda *_: order)
    for again in (results_of(form, alone.run, call), results_of(mixed, emulated.run, call)):
        for mine, theirs in zip(again, usual, strict=True):
            assert np.array_equal(bits(mine), bits(theirs))


@pytest.mark.slow
def test_nothing_is_taken_where_there_are_no_cells(emulated: Emulated) -> None:
    form = FORMS["lane_fates"]
    none, nothing = np.empty(0), np.empty(0, dtype=np.int64)
    cells, starts = Cells(none, none, np.empty((0, 2, 3))), Starts(none, none, none)
    emulated.run(form, [cells, starts, 10, True, 100, Fates(nothing, nothing, np.empty((0, 3)))])
