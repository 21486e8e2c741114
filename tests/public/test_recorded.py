"""What every class shows and every public call returns is as recorded, except for rounding.

The records are those of the freeze, which compares each bit; here the processor is any.  Of what is
not kept whole there, ends of long lines and arrays of many values, words are compared here by a
hash, numbers by a sum or a mean.
"""

import contextlib
from functools import cache
from typing import Any

import pytest

from tests.public.calls import ELSEWHERE, REFUSED_LATER, calls, is_recorded, room
from tools.freeze.commands import freeze_help, paths
from tools.freeze.records import FILE, FOLDER, Items, apart, dumped, loaded, moved, short
from tools.freeze.results import freeze_call, freeze_things

PACKAGES = (
    *("certify", "dynamics", "explorer", "facades", "model", "records"),
    *("results", "risk", "seismic", "show", "sweep"),
)
ANEW = "where that is meant: python -m tools.freeze record calls things"


@cache
def recorded(part: str) -> dict[str, str]:
    """Return the records of a part."""
    return loaded((FOLDER / f"{part}.txt").read_text(encoding="utf-8"))


def package_of(function: Any) -> str:
    """Return the package of the sources that a function or a method is part of."""
    return str(function.__module__.split(".")[1])


def of_call(label: str) -> dict[str, str]:
    """Return the records of a call: its result and the files that it leaves."""
    own = label + FILE
    return {
        name: text
        for name, text in recorded("calls").items()
        if name == label or name.startswith(own)
    }


def differing(before: Items, now: Items) -> dict[str, str]:
    """Return what is missing on one side or differs, by name."""
    pairs = {name: (before.get(name), now.get(name)) for name in before.keys() | now.keys()}
    lines = {
        name: "not on both sides" if None in pair else apart(*pair)  # type: ignore[arg-type]
        for name, pair in pairs.items()
    }
    return {name: line for name, line in lines.items() if line}


def test_what_every_class_shows_is_as_recorded() -> None:
    assert differing(recorded("things"), dict(freeze_things(""))) == {}, ANEW


def test_help_of_every_command_is_as_recorded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    texts = dict(item for path in paths() for item in freeze_help(path))
    assert moved(recorded("help"), loaded(dumped(short(texts)))) == {}, "record help anew"


@pytest.mark.parametrize("package", PACKAGES)
def test_what_calls_return_is_as_recorded(package: str) -> None:
    with contextlib.chdir(room()):
        every = calls()
    moved: dict[str, str] = {}
    for label, call in every.items():
        if package_of(call.function) == package and is_recorded(label):
            now = {f"{label}{file}": text for file, text in freeze_call(call)}
            moved |= differing(of_call(label), now)
    assert moved == {}, ANEW


def test_each_call_is_of_a_package_that_is_compared() -> None:
    with contextlib.chdir(room()):
        packages = {package_of(call.function) for call in calls().values()}
    assert packages - {"installation"} == {*PACKAGES}
    labels = {name.partition(FILE)[0] for name in recorded("calls")}
    assert labels == {name for name in calls() if name.partition(".")[0] not in ELSEWHERE}


def test_no_valid_call_is_refused() -> None:
    refused = {name for name, text in recorded("calls").items() if text.startswith("raises")}
    assert refused == REFUSED_LATER
