"""What frozen objects hold cannot be written to: they stay what they were when they were made."""

import copy
import enum
import pickle
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.results.result import read_only
from tests.every import every
from tests.public.things import things

WRITABLE = (list, dict, set, bytearray)
KERNEL_TABLES = {"Chain"}
"""Classes that are not public and hold tables that kernels take, which must be writable."""
HOUSE = {"width_m": 0.1, "height_m": 0.5}


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def _attributes(thing: Any) -> dict[str, Any]:
    """Return the public attributes that an object of the package stores, if it is frozen."""
    kind = type(thing)
    frozen = getattr(getattr(kind, "__dataclass_params__", None), "frozen", False)
    if isinstance(thing, enum.Enum) or kind.__name__ in KERNEL_TABLES:
        return {}
    if not (frozen or hasattr(kind, "__struct_fields__")):
        return {}
    slots = [name for base in kind.__mro__ for name in base.__dict__.get("__slots__", ())]
    names = {*getattr(thing, "__dict__", ()), *slots, *getattr(kind, "__struct_fields__", ())}
    return {name: getattr(thing, name) for name in sorted(names) if name[0] != "_"}


def writable(value: Any, place: str, seen: dict[int, Any]) -> Iterator[str]:
    """Yield the places at which something can be written to."""
    if id(value) in seen:
        return
    seen[id(value)] = value  # kept, so that no other object takes its place
    parts: dict[Any, Any] = {}
    if isinstance(value, WRITABLE) or (isinstance(value, np.ndarray) and value.flags.writeable):
        yield f"{place}: {type(value).__name__}"
    elif isinstance(value, Mapping):
        parts = dict(value)
    elif isinstance(value, tuple | frozenset):
        parts = dict(enumerate(value))
    else:
        parts = _attributes(value)
    for name, part in parts.items():
        yield from writable(part, f"{place}.{name}", seen)


def test_what_frozen_objects_hold_cannot_be_written_to() -> None:
    seen: dict[int, Any] = {}
    for name, thing in things().items():
        if isinstance(thing, WRITABLE):
            continue  # some of `things` themselves, made for the tests
        twins = (thing, copy.copy(thing), copy.deepcopy(thing), pickle.loads(pickle.dumps(thing)))
        assert not [each for twin in twins for each in writable(twin, name, seen)]
    assert len({type(each) for each in seen.values() if _attributes(each)}) > 130


def test_what_is_given_is_not_what_is_held() -> None:
    """A change of a list, a table or an array after an object is made does not change it."""
    rooms, floors = {"hall": 1}, [rs.motions.Floor(frequencies_hz=2.0, shapes=1.0)]
    spectrum = {"period_s": [0.1, 1.0], "sa_g": [0.5, 0.2], "damping": 0.05}
    values: dict[str, Any] = {"name": "vase", "geometry": HOUSE, "demand": {"spectrum": spectrum}}
    values["assessment"] = {"damage_states": ["uplift"]}
    house = rs.risk.Building(name="house", floors=floors, rooms=rooms)
    vase = rs.risk.DescribedObject(values=values)
    seen: dict[int, Any] = {}
    assert not [*writable(house, "house", seen), *writable(vase, "vase", seen)]
    rooms["attic"] = 7
    floors.clear()
    spectrum["sa_g"] = []
    assert (dict(house.rooms), len(house.floors)) == ({"hall": 1}, 1)
    assert vase.values["demand"]["spectrum"]["sa_g"] == (0.5, 0.2)  # type: ignore[index]
    with pytest.raises(TypeError, match="item assignment"):
        house.rooms["attic"] = 7  # type: ignore[index]


@every("values", [{}, {"a": 1}, {"a": read_only({"b": (1, 2)})}])
def test_read_only_mappings_are_pickled_copied_and_compared_as_dicts(values: Any) -> None:
    held = read_only(values)
    for twin in (held, copy.copy(held), copy.deepcopy(held), pickle.loads(pickle.dumps(held))):
        assert type(twin) is MappingProxyType
        assert twin == values == dict(twin)
