"""Forms of kernels for devices: any order and any number of workers give the bits of the host."""

import dataclasses
import inspect
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rocksteady.kernels
from rocksteady.kernels import devices
from rocksteady.kernels.batch.attractors import OUTCOME, settle_cells
from rocksteady.kernels.batch.harmonic import series_fates
from rocksteady.kernels.batch.records import record_fates
from rocksteady.kernels.core.queue import HEAD, LEFT_OVER, queue_of
from rocksteady.kernels.core.tables import OVERTURNED
from rocksteady.kernels.core.tuples import SeriesCells
from rocksteady.kernels.devices import COLD, FORMS, form_of, run_cells
from rocksteady.kernels.lanes.driver import lane_fates
from rocksteady.kernels.machine_code.device import on_device
from rocksteady.kernels.machine_code.types import signature_of
from rocksteady.kernels.orbits.settle import MEMORY, PERIODIC
from tests.every import every
from tests.kernels.queued import CASES, CELLS, Workers, bits, of_lanes, of_settle, room_of

# Empty lanes divide by zero, of which kernels warn where nothing compiles them.
pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning")


def plain(kernel: Any) -> Any:
    """Return the function of a kernel."""
    return kernel.py_func


def test_there_is_a_case_for_each_form() -> None:
    assert list(CASES) == list(FORMS)


@pytest.mark.slow
@every(("name", "workers"), [("lane_fates", 1), *((name, 2) for name in FORMS)])
def test_workers_of_a_device_give_the_bits_of_the_host(name: str, workers: int) -> None:
    kernel, make = CASES[name]
    device = Workers(workers)
    wanted, found = make(), make()
    kernel(*wanted)
    with on_device(device):
        run_cells(kernel, *found)
    assert device.ran == [name]
    left = np.zeros(CELLS, np.bool_)
    if "record_fates" in name:  # peaks of some of those that fall take the host
        left = found[-1].status == LEFT_OVER
        np.testing.assert_array_equal(np.flatnonzero(left), [3])
        assert wanted[-1].status[3] == OVERTURNED
    for one, other in zip(wanted[-1], found[-1], strict=True):
        assert one[~left].tobytes() == other[~left].tobytes()


@every("name", FORMS)
def test_cells_that_are_not_in_the_queue_are_left_as_they_are(name: str) -> None:
    _, make = CASES[name]
    form, arguments = FORMS[name], make()
    before = bits(arguments)
    shared = () if form.shared is None else form.shared(*arguments)
    form.queued(queue_of(0), *room_of(form), *shared, *arguments)
    assert bits(arguments) == before


@every("name", FORMS)
def test_a_queued_kernel_takes_queue_room_and_shared_arrays_before_the_others(name: str) -> None:
    kernel, make = CASES[name]
    form = FORMS[name]
    assert form.queued.__name__ == f"queued_{name}"
    names = list(inspect.signature(plain(form.queued)).parameters)
    own = list(inspect.signature(plain(kernel)).parameters)
    shared = () if form.shared is None else form.shared(*make())
    ahead = 1 + len(form.room) + len(shared)
    assert names[0] == "queue"
    assert names[ahead:] == own
    leaves = signature_of(plain(form.queued)).arguments
    assert leaves[ahead:] == signature_of(plain(kernel)).arguments
    assert signature_of(plain(form.queued)).result is None
    dimensions = [leaf.dimensions for leaf in signature_of(plain(form.queued)).leaves]
    assert dimensions[1 : 1 + len(form.room)] == [1 + len(shape) for shape in form.room]


@every("name", FORMS)
def test_lengths_are_numbers_of_each_cell_and_none_takes_less_than_nothing(name: str) -> None:
    _, make = CASES[name]
    length = FORMS[name].length
    assert length is not None
    found = length(*make())
    assert found.shape == (CELLS,)
    assert np.isfinite(found).all()
    assert (found >= 0.0).all()


def test_a_block_that_never_lifts_is_expected_to_take_no_time() -> None:
    lengths = FORMS["lane_fates"].length
    assert lengths is not None
    found = lengths(*of_lanes(nonlinear=False))
    # The first alone is at rest, under an amplitude below 1.
    np.testing.assert_array_equal(found == 0.0, [True, *[False] * (CELLS - 1)])
    of_record = FORMS["record_fates"].length
    assert of_record is not None
    blocks = of_record(*CASES["record_fates"][1]())
    np.testing.assert_array_equal(blocks == 0.0, [False, True, *[False] * (CELLS - 2)])


# -------------------------------------------------------------------------------- the choice


def test_without_a_device_and_without_cells_the_host_runs_kernels() -> None:
    wanted, found = of_lanes(nonlinear=False), of_lanes(nonlinear=False)
    lane_fates(*wanted)
    run_cells(lane_fates, *found)
    assert bits(found) == bits(wanted)
    device = Workers()
    with on_device(device):
        run_cells(lane_fates, *(without_cells(each) for each in found))
    assert device.ran == []


def without_cells(argument: Any) -> Any:
    """Return a tuple of arrays without their cells, and any number as it is."""
    if not isinstance(argument, tuple):
        return argument
    return type(argument)(*(each[:0] for each in argument))


def test_a_kernel_without_a_form_runs_on_the_host() -> None:
    (a, w, sides), starts, cycles, _, most, fates = of_lanes(nonlinear=False)
    rest = starts, cycles, most, fates
    device, cells = Workers(), SeriesCells(a, w, np.array([0.7, 0.3]), sides)
    with on_device(device):
        run_cells(series_fates, cells, *rest)
    assert device.ran == []
    assert (rest[-1].impacts > 0).any()
    assert form_of(series_fates, (cells, *rest)) is None


@pytest.mark.parametrize("nonlinear", [False, True])
def test_the_model_of_the_sides_chooses_the_form(nonlinear: bool) -> None:
    form = form_of(settle_cells, of_settle(nonlinear=nonlinear))
    assert form is FORMS["nonlinear_settle_cells" if nonlinear else "settle_cells"]


def test_what_is_never_inlined_are_names_of_kernels() -> None:
    folder = Path(rocksteady.kernels.__file__).parent
    sources = "".join(file.read_text(encoding="utf-8") for file in folder.rglob("*.py"))
    assert len(set(COLD)) == len(COLD)
    for name in COLD:
        assert re.search(rf"^@(compiled|allocating)\ndef {name}\(", sources, re.MULTILINE), name


# --------------------------------------------------------------------- what is left to the host


def test_an_orbit_that_the_table_does_not_hold_is_left_over() -> None:
    kernel, make = settle_cells, CASES["settle_cells"][1]
    wanted, found = make(), make()
    kernel(*wanted)
    # The second cell rests in each period, after more passages than two.
    assert wanted[-1].whole[1, OUTCOME] == PERIODIC
    assert wanted[-1].whole[1, 2] > 2
    form = FORMS["settle_cells"]
    queue = queue_of(1)
    queue[HEAD] = 1
    small = dataclasses.replace(form, room=(form.room[0], (2, form.room[1][1])))
    form.queued(queue, *room_of(small), *found)
    assert found[-1].whole[1, OUTCOME] == LEFT_OVER
    assert np.isnan(found[-1].real[1]).all()
    assert devices.LONGEST_ORBIT >= MEMORY


def test_a_block_whose_whole_motion_is_to_be_seen_again_is_left_over() -> None:
    """It falls, and may have come back to its slenderness before."""
    arguments = CASES["record_fates"][1]()
    wanted = CASES["record_fates"][1]()
    record_fates(*wanted)
    form = FORMS["record_fates"]
    assert form.shared is not None
    form.queued(queue_of(CELLS), *form.shared(*arguments), *arguments)
    np.testing.assert_array_equal(np.flatnonzero(arguments[-1].status == LEFT_OVER), [3])
    assert wanted[-1].status[3] == OVERTURNED
    # Without peaks there is nothing to see again.
    bare = (*arguments[:-1], arguments[-1]._replace(peaks=np.zeros((CELLS, 0))))
    form.queued(queue_of(CELLS), *form.shared(*bare), *bare)
    np.testing.assert_array_equal(bare[-1].status, wanted[-1].status)
    np.testing.assert_array_equal(bare[-1].impacts, wanted[-1].impacts)
