"""Values as text in which each bit counts: numbers in hexadecimal, arrays by a hash."""

import dataclasses
import enum
import functools
import inspect
import itertools
import json
import re
import tempfile
from collections.abc import Callable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from pathlib import Path
from types import FunctionType, MethodType
from typing import Any

import numpy as np
import xarray as xr

import rocksteady as rs
from rocksteady.kernels.machine_code.sources import sources_hash
from rocksteady.results.result import Result
from tools.freeze.records import digest

TIMED = frozenset({"seconds"})
"""Keys and fields that hold a duration."""
STORED = TIMED | {"source", "rocksteady_version", "case", "version", "sweep"}
"""Keys of a store that state which code has computed it and when."""
RUN = re.compile(
    r"\b(computed|runs|all fits|motions) in [\d.]+ s(?:, [\d,]+ a second)?$", re.MULTILINE
)
"""Ends of lines that state how long a computation took."""
ADDRESS = re.compile(r"\bat 0x[0-9a-f]+")
SIZE = re.compile(r"\b\d+ kB")
"""Sizes of files: that of the page changes with each of its lines."""
TEMPORARY = re.compile(rf"{re.escape(tempfile.gettempdir())}/rocksteady-\w+")
MANY = 100
"""Values of a generator that are taken: it may have no end."""
SMALL = 8
"""Numbers of an array that are shown one by one."""


def tidy(text: str, folder: Path | None = None) -> str:
    """Return a text without places, versions, durations, addresses and sizes of files."""
    for path in {folder, folder and folder.resolve()} - {None}:
        text = text.replace(str(path), "FOLDER")
    text = text.replace(sources_hash(), "SOURCES").replace(sources_hash()[:16], "SOURCES")
    text = re.sub(rf"(?<![\d.]){re.escape(rs.__version__)}(?![\d.]*\d)", "VERSION", text)
    text = TEMPORARY.sub("TEMPORARY", RUN.sub(r"\1 in DURATION", text))
    return SIZE.sub("SIZE kB", ADDRESS.sub("at ADDRESS", text))


def without(value: Any, dropped: AbstractSet[str] = TIMED) -> Any:
    """Return a value of JSON without some keys, those of JSON inside its texts included."""
    if isinstance(value, Mapping):
        return {key: without(each, dropped) for key, each in value.items() if key not in dropped}
    if isinstance(value, list):
        return [without(each, dropped) for each in value]
    if isinstance(value, str) and value.startswith('{"'):
        return without(json.loads(value), dropped)
    return value


def of_json(text: str, dropped: AbstractSet[str] = TIMED) -> str:
    """Return JSON as lines, one per key of its top level, in its order."""
    value = without(json.loads(text), dropped)
    if isinstance(value, dict):
        return "\n".join(f"{key}: {json.dumps(each)}" for key, each in value.items())
    return json.dumps(value, indent=1)


def of_array(array: Any) -> str:
    """Return type, shape and values of an array.

    Where there are many, a hash of its bytes stands for them, with the least, the largest and a
    mean in which later values weigh more.
    """
    array = np.asarray(array)
    head = f"{array.dtype.str}{list(array.shape)}"
    if array.dtype.kind in "OUT":
        values = array.astype(object).ravel().tolist()
        text = ", ".join(plain(value) for value in values)
        return f"{head} {text if len(values) <= SMALL else digest(text)}"
    if array.dtype.kind == "f":
        array = np.where(np.isnan(array), np.array(np.nan, array.dtype), array)
    if array.size <= SMALL:
        return f"{head} {', '.join(plain(value) for value in array.ravel().tolist())}"
    content = np.ascontiguousarray(array).tobytes()
    number = array.dtype.kind in "fiub"
    finite = array[np.isfinite(array)] if number else array[:0]
    seen = ""
    if number and finite.size:
        with np.errstate(over="ignore", invalid="ignore"):
            mean = np.average(finite.astype(float), weights=np.arange(1.0, finite.size + 1.0))
        seen = f" {finite.min()!s} to {finite.max()!s} mean {mean!s}"
    return f"{head}{seen} {digest(content)}"


def of_dataset(dataset: xr.Dataset) -> str:
    """Return names, dimensions, attributes and bytes of a dataset."""
    lines = [f"attrs {plain(without(dict(dataset.attrs), STORED))}"]
    for name, array in dataset.variables.items():
        attrs = plain(without(dict(array.attrs), STORED))
        lines.append(f"{name} {array.dims} {of_array(array.values)} {attrs}")
    return "\n".join(lines)


def of_dict(values: Mapping[str, Any]) -> str:
    """Return what `to_dict` has, a line per key."""
    return "\n".join(f"{key}: {plain(each)}" for key, each in without(values).items())


def of_frame(frame: Any) -> str:
    """Return the columns of a data frame with their types and bytes."""
    return "\n".join(f"{name} {of_array(frame[name].to_numpy())}" for name in frame)


def plain(value: Any) -> str:
    """Return any value as text in which each bit counts."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        # What is neither compared nor printed is a memory of earlier questions.
        fields = [each for each in dataclasses.fields(value) if each.compare or each.repr]
        return _fields(value, [each.name for each in fields])
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        return _fields(value, value._fields)
    if inspect.isgenerator(value):
        value = list(itertools.islice(value, MANY))
    kinds = ((kind, text) for kind, text in _TEXTS if isinstance(value, kind))
    _, text = next(kinds, (object, repr))
    return tidy(text(value))


_TEXTS: tuple[tuple[Any, Callable[[Any], str]], ...] = (
    (enum.Enum, str),
    # A sentence that is computed when it is printed: its name answers nothing.
    (FunctionType | MethodType | functools.partial, lambda _: "function"),
    (Path, lambda value: value.name if value.is_absolute() else value.as_posix()),
    (float | np.floating, lambda value: float(value).hex()),
    (complex | np.complexfloating, lambda value: f"({plain(value.real)}, {plain(value.imag)})"),
    (np.ndarray, of_array),
    (xr.Dataset, of_dataset),
    (Mapping, lambda value: f"{{{', '.join(f'{key}: {plain(value[key])}' for key in value)}}}"),
    (list | tuple, lambda value: f"[{', '.join(plain(each) for each in value if _stays(each))}]"),
    (set | frozenset, lambda value: f"{{{', '.join(sorted(map(plain, value)))}}}"),
)
"""How values of a kind become text; the first kind that fits counts."""


def _stays(member: Any) -> bool:
    """Return whether a member of a list is no fact on a duration."""
    return getattr(member, "key", None) not in TIMED


def _fields(value: Any, names: Any) -> str:
    """Return the fields of an object, durations excepted."""
    kept = [name for name in names if name not in TIMED]
    inside = ", ".join(f"{name}={plain(getattr(value, name))}" for name in kept)
    return f"{type(value).__name__}({inside})"


def facets(value: Any) -> Iterator[tuple[str, Callable[[], str]]]:
    """Yield all that a value shows, by name."""
    if isinstance(value, xr.Dataset):
        yield "dataset", lambda: of_dataset(value)
        value = value.rocksteady
    elif isinstance(value, Result):
        yield "repr", lambda: tidy(repr(value))
    if hasattr(value, "to_dataset"):
        yield "dataset", lambda: of_dataset(value.to_dataset())
    if isinstance(value, Result) or hasattr(value, "to_dict"):
        yield "summary", lambda: tidy(value.summary())
        yield "html", lambda: digest(tidy(value._repr_html_()))
        yield (
            "dict",
            lambda: "\n".join(f"{k}: {plain(v)}" for k, v in without(value.to_dict()).items()),
        )
        yield "frame", lambda: of_frame(value.to_dataframe())
    else:
        yield "value", lambda: plain(value)


def shown(value: Any) -> Iterator[tuple[str, str]]:
    """Yield the name and the text of all that a value shows, errors included."""
    for name, text in facets(value):
        try:
            yield name, text()
        except Exception as error:  # noqa: BLE001 -- what is refused is an answer too
            yield name, f"raises {type(error).__name__}: {tidy(str(error))}"
