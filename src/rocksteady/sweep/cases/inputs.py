"""Canonical description of a result's inputs, readable and comparable.

Two sweeps of the same inputs give the same result to the last bit; that is why one may continue
what the other has begun.
"""

import functools
import hashlib
import json
import math
import sys
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from importlib.metadata import version
from pathlib import Path
from types import CodeType, FunctionType
from typing import Any

import numpy as np

from rocksteady.errors import InputError
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.task import Task

PACKAGE = str(Path(__file__).parents[2] / "__init__.py")
"""Not imported: its namespace names modules of the layers above this one."""
HEX = 16
"""Digits of a hash: two things of one hash differ in 1 of 2e19 cases."""


def inputs_of(task: Task) -> dict[str, Any]:
    """Return what a result follows from, in numbers, texts, lists and dicts.

    Raises
    ------
    InputError
        If a constant of the case function cannot be written down.
    """
    function, constants = _unwrapped(task.cases)
    return {
        "case": f"{function.__module__}:{function.__qualname__}",
        "constants": {name: plain(value, name) for name, value in sorted(constants.items())},
        "dimensions": list(task.grid.names),
        "axes": {axis.name: _axis(axis) for axis in task.grid.axes},
        "outputs": {output.name: str(output.dtype) for output in task.outputs},
        "numbered": task.numbered,
        "version": version("rocksteady"),
        "source": sources_of(function),
    }


def constants_of(task: Task) -> dict[str, Any]:
    """Return what partials have bound of the case function, by the names of its arguments."""
    return _unwrapped(task.cases)[1]


def attributes_of(inputs: Mapping[str, Any], given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the attributes of a result: the caller's, and the inputs that it follows from.

    Raises
    ------
    InputError
        If the caller gives anything but numbers and texts: it is what every format of files has.
    """
    seed = inputs["constants"].get("seed")
    return {
        **{name: _attribute(name, value) for name, value in given.items()},
        **({} if seed is None else {"seed": str(seed)}),  # up to 2^64: no format has such numbers
        "rocksteady_version": inputs["version"],
        "source": ", ".join(f"{name} {digest}" for name, digest in inputs["source"].items()),
        "inputs": as_text(inputs),
    }


def _attribute(name: str, value: object) -> int | float | str:
    """Return an attribute as a number or a text of Python."""
    match value.item() if isinstance(value, np.generic) else value:
        case str() as text:
            return text
        case int() | float() as number if not isinstance(number, bool) and math.isfinite(number):
            return number
    raise InputError(
        name,
        value,
        "an attribute of a result is a finite number or a text",
        "describe it in a word, or leave it out",
    )


def as_text(inputs: Mapping[str, Any]) -> str:
    """Return inputs as one line of JSON."""
    return json.dumps(inputs, ensure_ascii=False, sort_keys=True)


def differences(stored: Mapping[str, Any], here: Mapping[str, Any]) -> list[str]:
    """Return what differs between two inputs, each in a few words, "there" before "here"."""
    stored_values, present_values = _flat(stored), _flat(here)
    names = sorted(
        stored_values.keys() | present_values.keys(),
        key=lambda name: (name not in present_values, name),
    )
    differ = [
        n for n in names if stored_values.get(n, "nothing") != present_values.get(n, "nothing")
    ]

    def told_by_another(name: str) -> bool:
        # A hash is shown only where nothing that people can read says the same.
        whole = name.removesuffix("sha256")
        return whole != name and any(n.startswith(whole) and n != name for n in differ)

    return [
        f"{' '.join(name.split()[-2:])} {_words(stored_values.get(name, 'nothing'))} there, "
        f"{_words(present_values.get(name, 'nothing'))} here"
        for name in differ
        if not told_by_another(name)
    ]


def named_function(task: Task) -> None:
    """Refuse a case function that no other process can find by its name.

    Raises
    ------
    InputError
        If it is not at module level.
    """
    function, _ = _unwrapped(task.cases)
    if not _findable(function):
        raise InputError(
            "cases",
            function.__qualname__,
            "a function at module level or a functools.partial of one can be found again",
            "move it out of the function that defines it",
        )


def plain(value: object, name: str) -> Any:
    """Return a constant in numbers, texts, lists and dicts.

    Parameters
    ----------
    value
        Made of dataclasses, numbers, texts, arrays, sequences and mappings.
    name
        Name of the constant, for the error.

    Raises
    ------
    InputError
        If it is made of anything else.
    """
    if isinstance(value, Enum):
        value = value.name
    elif isinstance(value, np.generic):
        value = value.item()
    elif is_dataclass(value) and not isinstance(value, type):
        parts = {field.name: getattr(value, field.name) for field in fields(value)}
        value = {"is": type(value).__name__, **parts}
    match value:
        case None | bool() | int() | str():
            return value
        case float():
            return value if math.isfinite(value) else str(value)
        case np.ndarray() if value.dtype != object:
            shape = list(value.shape)
            return {"dtype": str(value.dtype), "shape": shape, "sha256": digest_of(value)}
        case functools.partial() | FunctionType() if _whole(_unwrapped(value)[0]):
            function, constants = _unwrapped(value)
            named = {key: plain(part, name) for key, part in constants.items()}
            code = hashlib.sha256(_instructions(function.__code__)).hexdigest()[:HEX]
            where = f"{function.__module__}:{function.__qualname__}"
            return {"case": where, "code": code, "constants": named}
        case Mapping():
            return {str(key): plain(part, name) for key, part in value.items()}
        case list() | tuple():
            return [plain(part, name) for part in value]
    raise InputError(
        name,
        value,
        "a constant of a sweep is made of dataclasses, numbers, texts and arrays, or is a "
        "function that takes nothing from around it",
        "give it in such a form, so that it can be written down beside the result",
    )


def sources_elsewhere(task: Task) -> dict[str, str]:
    """Return hashes of the sources that a process computes a task with, where it is sent there.

    A function whose module that process has not imported, or that was typed in or is part of a
    script, has been sent itself: it is what it was, and only this package's sources count.
    """
    function, _ = _unwrapped(task.cases)
    sent = function.__module__ == "__main__" or function.__module__ not in sys.modules
    return sources_of(inputs_of if sent else function)


def sources_of(function: Any) -> dict[str, str]:
    """Return a hash of the sources that a function is part of, and of this package's.

    For a package all its modules count, because they call each other.
    """
    module = function.__module__
    top = module.partition(".")[0]
    source, package = (getattr(sys.modules.get(name), "__file__", None) for name in (module, top))
    if package is not None and Path(package).name == "__init__.py":
        sources = {top: _hash_of(package)}
    elif source is not None:
        sources = {module: _hash_of(source)}
    else:  # typed in, or one of Python's own
        code = getattr(function, "__code__", None)
        content = sys.version.encode() if code is None else _instructions(code)
        sources = {str(module): hashlib.sha256(content).hexdigest()[:HEX]}
    return sources | {"rocksteady": _hash_of(PACKAGE)}


def _instructions(code: CodeType) -> bytes:
    """Return what a function does, without where it stands: cells of a notebook move about."""
    parts = [code.co_code, repr((code.co_names, code.co_varnames)).encode()]
    for constant in code.co_consts:
        nested = isinstance(constant, CodeType)
        parts.append(_instructions(constant) if nested else repr(constant).encode())
    return b"\0".join(parts)


@functools.cache
def _hash_of(file: str) -> str:
    """Return a hash of a module's file, or of all modules of a package."""
    path = Path(file)
    sources = sorted(path.parent.rglob("*.py")) if path.name == "__init__.py" else [path]
    digest = hashlib.sha256()
    for source in sources:
        digest.update(source.relative_to(path.parent).as_posix().encode() + b"\0")
        digest.update(source.read_bytes())
    return digest.hexdigest()[:HEX]


def _findable(function: Any) -> bool:
    """Return whether a function is what its module has under its name."""
    thing: Any = sys.modules.get(function.__module__)
    for part in function.__qualname__.split("."):
        thing = getattr(thing, part, None)
    return thing is function


def _whole(function: Any) -> bool:
    """Return whether all that a function does stands in it: nothing is taken from around it."""
    return isinstance(function, FunctionType) and function.__closure__ is None


def _unwrapped(cases: object) -> tuple[Any, dict[str, Any]]:
    """Return a function, and the arguments that partials of it have bound."""
    constants: dict[str, Any] = {}
    while isinstance(cases, functools.partial):
        constants = (
            {f"{i}": value for i, value in enumerate(cases.args)} | cases.keywords | constants
        )
        cases = cases.func
    if not callable(cases) or not hasattr(cases, "__qualname__") or isinstance(cases, type):
        raise InputError(
            "cases",
            cases,
            "it must be a function or a functools.partial of one",
            "give a function at module level",
        )
    return cases, constants


def _axis(axis: Axis) -> dict[str, Any]:
    points = axis.points
    values: dict[str, Any] = {
        "from": points[0].item(),
        "to": points[-1].item(),
        "points": len(points),
        "sha256": digest_of(points),
    }
    if axis.items is not None:
        items = json.dumps([plain(item, axis.name) for item in axis.items], sort_keys=True)
        values["items"] = hashlib.sha256(items.encode()).hexdigest()[:HEX]
    return values | {"units": axis.units}


def digest_of(array: np.ndarray[Any, Any]) -> str:
    """Return a hash of the values of an array."""
    if array.dtype.kind == "U":
        text = "\0".join(array.tolist()).encode(errors="surrogatepass")  # names of files
        return hashlib.sha256(text).hexdigest()[:HEX]
    return hashlib.sha256(np.ascontiguousarray(array).tobytes()).hexdigest()[:HEX]


def _flat(inputs: Mapping[str, Any], before: str = "") -> dict[str, Any]:
    """Return nested names as one: what is nested deeper reads "shaking phase"."""
    values: dict[str, Any] = {}
    for name, value in inputs.items():
        label = name if before in {"", "constants", "axes"} else f"{before} {name}".rstrip()
        if isinstance(value, Mapping) and value:
            values |= _flat(value, label)
        else:
            values[label] = value
    return values


def _words(value: object) -> str:
    return json.dumps(value, ensure_ascii=False) if isinstance(value, list | dict) else str(value)
