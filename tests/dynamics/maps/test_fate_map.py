"""Maps of fates: every cell is how a time history ends at that point."""

import inspect
import math
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    DimensionlessBlock,
    Execution,
    Harmonic,
    State,
    Status,
    Steady,
    Store,
    map_attractors,
    map_fates,
    open_store,
    simulate,
)
from rocksteady.dynamics.maps.attractor_map import ATTRACTORS
from rocksteady.dynamics.maps.fate_map import FATES
from rocksteady.errors import InputError, ModelError
from rocksteady.outcomes import NO_START
from tests.dynamics.maps.drawn import drawn_case
from tests.every import every

BLOCK = DimensionlessBlock(restitution=0.8)
AXES = {"amplitude": np.linspace(0.4, 6.0, 23), "frequency_ratio": np.linspace(0.6, 8.0, 19)}
START = State(angle=0.0, velocity=0.3)
CASES = 60
"""Maps of random axes."""
CYCLES = 30


@every("number", range(CASES))
def test_every_cell_of_any_map_is_how_a_time_history_ends(number: int) -> None:
    case = drawn_case(number)
    found = map_fates(
        case.block,
        case.shaking,
        axes=case.named,
        start=case.start,
        cycles=CYCLES,
    )
    assert found.fate.dims == tuple(case.axes)
    for values in product(*case.axes.values()):
        at = dict(zip(case.axes, values, strict=True))
        block, shaking, start = case.at(at)
        cell = found.sel(at)
        fate = int(cell.fate)
        try:
            run = simulate(block, shaking, start=start, cycles=CYCLES)
        except ModelError:
            assert fate == NO_START
            continue
        assert fate == run.status


def test_the_codes_of_the_fates_are_kept_for_ever() -> None:
    # Stored maps hold them.
    found = map_fates(BLOCK, axes={"amplitude": [1.0], "frequency_ratio": [2.0]}, cycles=1)
    assert found.fate.attrs["flag_values"].tolist() == [0, 1, 2, 4, -1]
    assert found.fate.attrs["flag_meanings"] == "rocking at-rest overturned undecided no-start"
    assert NO_START not in set(Status)
    assert found.fate.dtype == np.int8


def test_a_map_has_no_number_of_impacts() -> None:
    # Chatter is left out as soon as rest is proved: the number would be one of the algorithm.
    found = map_fates(BLOCK, axes={"amplitude": [1.0], "frequency_ratio": [2.0]}, cycles=1)
    assert list(found.data_vars) == ["fate"]


def test_a_map_says_what_it_was_computed_from_and_follows_200_periods() -> None:
    found = map_fates(BLOCK, axes=AXES, start=START)
    assert {name: found.attrs[name] for name in ("start", "velocity", "cycles")} == {
        "start": "state",
        "velocity": 0.3,
        "cycles": 200,
    }
    assert set(np.unique(found.fate)) == {Status.ROCKING, Status.AT_REST, Status.OVERTURNED}
    assert found.identical(
        map_fates(BLOCK, axes=AXES, start=START, run=Execution(executor="serial"))
    )


def test_a_block_that_a_mirrored_motion_moves_ends_as_its_mirror_image() -> None:
    one = map_fates(BLOCK, axes={"phase": [0.5], **AXES}, start=START)
    phase, other = 0.5 - math.pi, State(angle=0.0, velocity=-0.3)
    mirrored = map_fates(BLOCK, axes={"phase": [phase], **AXES}, start=other)
    # A sine of a phase that is half a period away is not the same to the last bit.
    assert (one.fate.values == mirrored.fate.values).mean() > 0.98


def test_a_store_holds_what_memory_does_and_is_continued(tmp_path: Path) -> None:
    class EnoughError(Exception):
        pass

    seen = 0

    def stop(cells: int) -> None:
        nonlocal seen
        seen += cells
        if seen > 100:
            raise EnoughError

    path = tmp_path / "a.zarr"
    with pytest.raises(EnoughError):
        map_fates(
            BLOCK, axes=AXES, start=START, run=Execution(store=Store(path, chunk=19), progress=stop)
        )
    there = int(open_store(path, partial=True).computed.sum())
    assert 0 < there < 23 * 19
    told: list[int] = []
    found = map_fates(
        BLOCK,
        axes=AXES,
        start=START,
        run=Execution(store=Store(path, resume=True), progress=told.append),
    )
    assert told[0] == there
    assert found.load().identical(map_fates(BLOCK, axes=AXES, start=START))


def test_a_refined_map_has_the_fates_near_their_borders() -> None:
    axes = {name: np.linspace(values[0], values[-1], 65) for name, values in AXES.items()}
    whole = map_fates(BLOCK, axes=axes, start=START)
    found = map_fates(BLOCK, axes=axes, start=START, refine=4)
    met = found.met.values
    assert 0.05 < met.mean() < 0.8
    assert (found.fate == whole.fate).mean() > 0.99
    assert (found.fate == whole.fate).values[met].all()
    with pytest.raises(ModelError, match="a store holds every cell"):
        map_fates(BLOCK, axes=axes, refine=4, run=Execution(store="a.zarr"))


@every(
    ("axes", "more", "valid"),
    [
        ({"amplitude": [2.0, -1.0]}, {}, "amplitude = -1.0 is not valid"),
        ({"tilt": [1.0]}, {}, "there is no parameter of that name"),
        ({"amplitude": 1.0}, {}, "a map has one axis or more"),
        ({"amplitude": [1.0]}, {"cycles": 0}, "cycles = 0 is not valid"),
        ({"amplitude": [1.0]}, {"cycles": 1.5}, "cycles = 1.5 is not valid"),
        ({"amplitude": [1.0]}, {"start": "rest"}, "must be a Rest"),
        ({"phase": [0.0]}, {"start": Steady()}, "a steady state to start on decides"),
    ],
)
def test_bad_values_are_refused(axes: Any, more: dict[str, Any], valid: str) -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=3.0)
    with pytest.raises((InputError, ModelError), match=valid):
        map_fates(BLOCK, shaking, axes=axes, **more)


def test_the_command_follows_motions_as_long_as_the_functions_do() -> None:
    for function, question in ((map_fates, FATES), (map_attractors, ATTRACTORS)):
        default = inspect.signature(function).parameters[question.counted].default
        assert question.cycles == default
