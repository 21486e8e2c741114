"""Copies of public objects: replaced fields give what the constructor gives, pickles are equal."""

import copy
import dataclasses
import pickle
import warnings
from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.risk.calibration.sampler.surfaces import Surfaces
from tests.public.things import things
from tools.namespace import THINGS

UNSETTLED = {"Demand"}
"""What takes a peak and a damping from its table or file, and keeps them when it is replaced."""


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def one_of_each() -> list[Any]:
    """One object of every public frozen class that things hold or are, inputs among them."""
    seen: dict[type, Any] = {}
    waiting = [
        *things().values(),
        *(
            rs.branches.BranchOptions(),
            rs.branches.CurveOptions(),
            rs.Nonlinear(),
            rs.Steady(),
        ),
        rs.motions.Impulses(velocities=(0.5, -0.2), times=(0.0, 1.0)),
        rs.Block.asymmetric(left=0.15, right=0.2, height=1.2, restitution=("housner", 0.9)),
    ]
    while waiting:
        here = waiting.pop()
        if dataclasses.is_dataclass(here) and not isinstance(here, type):
            if type(here) in seen:
                continue
            seen[type(here)] = here
            waiting += [getattr(here, field.name) for field in dataclasses.fields(here)]
        elif isinstance(here, list | tuple):
            waiting += here[:3]
    return [each for each in seen.values() if THINGS.get(type(each).__name__) is type(each)]


def state(value: Any) -> Any:
    """All that an object holds, to the last bit."""
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, value.tobytes()
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        names = [field.name for field in dataclasses.fields(value) if field.init]
        return type(value).__name__, [(name, state(getattr(value, name))) for name in names]
    if isinstance(value, partial):
        value = [value.func, value.args, value.keywords]
    elif isinstance(value, Mapping):
        value = [*value.items()]
    if isinstance(value, list | tuple):
        return [state(each) for each in value]
    if isinstance(value, float):
        return value.hex()
    if isinstance(value, Surfaces):
        return state(vars(value))
    return repr(value) if hasattr(value, "to_dict") else value


def others(value: Any) -> Iterator[Any]:
    """Yield values that a field may have as well."""
    yield None
    if isinstance(value, bool):
        yield not value
    elif isinstance(value, int):
        yield from (value + 1, value + 2, 3, 1)
    elif isinstance(value, float):
        yield from (0.9 * value, 1.1 * value, 0.5, 1.0, 2.0)
    elif value is None:
        yield from (0.5, 1, 3, 2.0, 0.8, "rest", True, (1.0, 2.0))
    elif isinstance(value, tuple):
        yield from (value[:-1], (*value, *value[-1:]), (3,), (1, 3))
    elif isinstance(value, rs.formulas.Side):
        yield from (dataclasses.replace(value, restitution=ratio) for ratio in (0.7, 1.0))


def made(kind: type, values: dict[str, Any]) -> Any:
    """The object of a class with some values; None where they are none of it."""
    try:
        return kind(**values)
    except (rs.RocksteadyError, TypeError, ValueError, AttributeError, AssertionError):
        return None


@pytest.mark.slow
def test_a_replaced_field_gives_what_the_constructor_gives() -> None:
    warnings.simplefilter("ignore")
    compared, wrong = 0, set()
    for one in one_of_each():
        kind, fields = type(one), [field for field in dataclasses.fields(one) if field.init]
        given = {field.name: getattr(one, field.name) for field in fields}
        assert state(dataclasses.replace(one)) == state(one), kind
        if not hasattr(kind, "__post_init__"):
            continue  # what it holds is what it was given
        missing = dataclasses.MISSING
        needed = {
            field.name: given[field.name]
            for field in fields
            if field.default is missing and field.default_factory is missing
        }
        bases = [needed, given]
        changes = [(name, value) for name, old in given.items() for value in others(old)]
        bases += [{**needed, name: value} for name, value in changes]
        for values in bases:
            base = made(kind, values)
            if base is None:
                continue
            for name, value in changes:
                direct = made(kind, {**values, name: value})
                if direct is None:
                    continue
                compared += 1
                if state(dataclasses.replace(base, **{name: value})) != state(direct):
                    wrong.add((kind.__name__, name))
    assert compared > 3_000
    assert {each for each in wrong if each[0] not in UNSETTLED} == set()


def test_copies_hold_what_the_original_holds() -> None:
    for one in one_of_each():
        for twin in (copy.copy(one), copy.deepcopy(one), pickle.loads(pickle.dumps(one))):
            assert state(twin) == state(one), type(one)
            if "__eq__" in vars(type(one)) and not isinstance(one, rs.codes.Screens):
                assert twin == one, type(one)


def test_a_block_that_leaves_its_wall_has_its_own_restitutions_again() -> None:
    free = rs.Block.asymmetric(left=0.15, right=0.2, height=1.2, restitution=("housner", 0.9))
    wall = free.against_wall(("housner", 0.8))
    assert wall.housner_factor == 0.8
    again = dataclasses.replace(wall, wall_restitution=None)
    assert again == free
    assert again.housner_factor is None  # .8 was that of the wall
    assert wall == rs.Block.asymmetric(left=0.15, right=0.2, height=1.2).against_wall(
        wall.restitution
    )
    slow = dataclasses.replace(free.positive, restitution=0.5)
    assert dataclasses.replace(free, positive=slow).housner_factor is None
    both = rs.DimensionlessBlock(restitution=0.8, negative_restitution=0.8)
    assert both == rs.DimensionlessBlock(restitution=0.8)
    assert hash(both) == hash(rs.DimensionlessBlock(restitution=0.8))
    unlike = dataclasses.replace(both, restitution=0.9)
    assert unlike.sides == ((0.9, 1.0, 1.0), (0.8, 1.0, 1.0))
