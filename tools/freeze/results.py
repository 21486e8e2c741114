"""Results: one of every public class and of every public call, and all public signatures."""

import contextlib
import enum
import inspect
import math
import os
import shutil
import tempfile
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib as mpl

import rocksteady as rs
from rocksteady.cli.console import progress
from rocksteady.show.export.files import figure_bytes
from tests.public.calls import ELSEWHERE, calls, close_pictures, room
from tests.public.things import things
from tests.show.all_pictures import pages, pictures, usual_pictures
from tools.freeze.files import files_of, left
from tools.freeze.pictures import drawn, written
from tools.freeze.records import FILE
from tools.freeze.values import plain, shown, tidy
from tools.namespace import PLACES, THINGS


def begin() -> None:
    """Prepare a process: no progress, and a folder of its own in that of temporary files."""
    warnings.filterwarnings("ignore", "Animation was deleted")  # a call returns one unplayed
    mpl.rcParams["svg.hashsalt"] = "frozen"
    progress.QUIET = progress.LINE_AFTER = math.inf
    os.chdir(tempfile.mkdtemp())


def freeze_things(_: str) -> Iterator[tuple[str, str]]:
    """Yield what one of every class shows."""
    with contextlib.chdir(room()):
        for name, thing in things().items():
            if name not in ELSEWHERE:
                for facet, text in shown(thing):
                    yield f"{name}: {facet}", tidy(text, room())


def freeze_calls(only: str) -> Iterator[tuple[str, str]]:
    """Yield what every public call returns and writes, or only one of them."""
    with contextlib.chdir(room()):
        for label, call in calls().items():
            if label.partition(".")[0] not in ELSEWHERE and only in {"", label}:
                for name, text in freeze_call(call):
                    yield f"{label}{name}", text


def freeze_call(call: Any) -> Iterator[tuple[str, str]]:
    """Yield what a call returns and the files that it leaves."""
    with tempfile.TemporaryDirectory(prefix="frozen-call-") as name:
        folder = Path(name)
        shutil.copytree(room(), folder, dirs_exist_ok=True)
        before = files_of(folder)
        with contextlib.chdir(folder):
            try:
                found = call()
                # What axes hold is one of the pictures.
                text = "axes" if hasattr(found, "get_xlim") else plain(found)
            except Exception as error:  # noqa: BLE001 -- what is refused is an answer too
                text = f"raises {type(error).__name__}: {error}"
            yield "", tidy(text, folder)
            for file, content in left(folder, before):
                yield f"{FILE}{file}", content
        close_pictures()


def freeze_pictures(only: str) -> Iterator[tuple[str, str]]:
    """Yield a picture, or a page of a report."""
    if only in pages():
        yield only, written(pages()[only]())
    else:
        draw = usual_pictures().get(only) or pictures()[only]
        yield only, drawn(figure_bytes(draw(), "svg").decode())


def freeze_stores(_: str) -> Iterator[tuple[str, str]]:
    """Yield the store of every call that takes a run."""
    with contextlib.chdir(room()):
        for label, call in calls().items():
            if "run" in call.parameters and callable(THINGS.get(label)):
                for name, text in freeze_call(
                    lambda call=call: call(run=rs.Execution(store="s.zarr"))
                ):
                    if name:
                        yield f"{label}{name}", text


def freeze_signatures(_: str) -> Iterator[tuple[str, str]]:
    """Yield the signature of every public name, and those of its members."""
    for name, thing in THINGS.items():
        lines = [_signature(name, thing)]
        if inspect.isclass(thing):
            lines += [f"bases {', '.join(base.__name__ for base in thing.__mro__[1:-1])}"]
            members = inspect.getmembers(thing)
            if issubclass(thing, enum.Enum):
                members = [(each.name, each.value) for each in thing]
            lines += [
                _signature(member, value)
                for member, value in members
                if not member.startswith("_") and not _inherited(thing, member)
            ]
        yield PLACES[name], "\n".join(lines)


def _inherited(kind: type, member: str) -> bool:
    """Return whether a class has a member from outside of the package."""
    holder = next((base for base in kind.__mro__ if member in vars(base)), kind)
    return not holder.__module__.startswith("rocksteady")


def _signature(name: str, thing: Any) -> str:
    """Return how a name is called, or what it is."""
    if isinstance(thing, property):
        return f"{name}: property"
    if callable(thing):
        with contextlib.suppress(ValueError, TypeError):
            return tidy(f"{name}{inspect.signature(thing)}")
    return f"{name} = {plain(thing)}"
