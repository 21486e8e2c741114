"""The flat public namespace: sorted, complete, lazy, and the same for Python and type checkers."""

import ast
import contextlib
import importlib
import inspect
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from typer.main import get_command

import rocksteady
from rocksteady.cli.app import app
from tests.every import every
from tests.trees import nodes_of
from tools.namespace import MODULES, PLACES, THINGS

HEAVY = ("h5py", "matplotlib", "numba", "numpy", "scipy", "typer", "xarray", "zarr")

SOURCE = Path(rocksteady.__file__).parent


def names_of_a_stub(file: Path) -> dict[str, tuple[str, str]]:
    """The names that a stub imports: of each the module that defines it, and its name there."""
    found: dict[str, tuple[str, str]] = {}
    before = ".".join(("rocksteady", *file.relative_to(SOURCE).parts[:-1]))
    for statement in ast.parse(file.read_text(encoding="utf-8")).body:
        if isinstance(statement, ast.ImportFrom) and statement.module:
            for alias in statement.names:
                assert alias.asname  # or type checkers would not export it
                found[alias.asname] = f"{before}.{statement.module}", alias.name
    return found


STUBS = {
    ".".join(("rocksteady", *file.relative_to(SOURCE).with_suffix("").parts)).removesuffix(
        ".__init__"
    ): names_of_a_stub(file)
    for file in sorted(SOURCE.rglob("*.pyi"))
}
DEFINED_IN = {
    f"{holder}.{name}": place for holder, names in STUBS.items() for name, place in names.items()
}


def modules_loaded_by(code: str) -> set[str]:
    """The top-level modules that a fresh interpreter has loaded after `code`."""
    report = "\nimport sys\nprint(*{name.partition('.')[0] for name in sys.modules})"
    finished = subprocess.run(
        [sys.executable, "-c", code + report], capture_output=True, check=True, text=True
    )
    return set(finished.stdout.split())


HOLDERS = ["rocksteady", *(f"rocksteady.{name}" for name in MODULES)]


@every("holder", HOLDERS)
def test_all_is_sorted_without_repetition_and_what_dir_lists(holder: str) -> None:
    module = importlib.import_module(holder)
    assert module.__all__ == sorted(set(module.__all__))
    if holder in STUBS:
        assert dir(module) == module.__all__
        submodules = set(MODULES) if holder == "rocksteady" else set()
        assert set(STUBS[holder]) == set(module.__all__) - submodules


@every("name", DEFINED_IN)
def test_each_name_is_the_object_its_module_defines(name: str) -> None:
    holder, _, own = name.rpartition(".")
    place, defined = DEFINED_IN[name]
    module = importlib.import_module(place)
    thing = getattr(module, defined)
    assert getattr(importlib.import_module(holder), own) is thing
    assert getattr(thing, "__module__", module.__name__) == module.__name__
    # A picture has its name without the verb; nothing else has two names.
    assert own == (defined.removeprefix("plot_") if holder == "rocksteady.plots" else defined)


def test_no_name_is_reached_in_two_ways() -> None:
    reached = [getattr(importlib.import_module(h), n) for h in HOLDERS for n in STUBS.get(h, ())]
    callables = [thing for thing in reached if callable(thing)]
    assert len(callables) > 300
    assert len({id(thing) for thing in callables}) == len(callables)
    assert len(STUBS["rocksteady"]) <= 62  # what begins fits two screens of help


@every("holder", HOLDERS)
def test_an_unknown_name_of_a_module_is_an_attribute_error_that_names_it(holder: str) -> None:
    with pytest.raises(AttributeError, match=r"\bblok$|'blok'"):
        _ = importlib.import_module(holder).blok


def test_an_unknown_name_is_an_attribute_error_that_names_it() -> None:
    with pytest.raises(AttributeError, match="No rocksteady attribute Blok"):
        _ = vars(rocksteady)["__getattr__"]("Blok")
    assert not hasattr(rocksteady, "Blok")


def test_import_loads_nothing_heavy() -> None:
    assert modules_loaded_by("import rocksteady") & set(HEAVY) == set()


def test_the_errors_load_nothing_heavy() -> None:
    code = "import rocksteady\nrocksteady.RocksteadyError, rocksteady.Status"
    assert modules_loaded_by(code) & set(HEAVY) == set()


def texts_of(file: Path) -> Iterator[str]:
    """The texts of a module that a user may read, docstrings and patterns excepted."""
    seen: set[ast.AST] = set()  # docstrings, and parts of texts with values in them
    for node in nodes_of(file):
        text = None if node in seen else getattr(node, "value", None)
        if isinstance(node, ast.Expr):
            seen.add(node.value)
        elif isinstance(node, ast.JoinedStr):
            seen |= set(node.values)
            text = "".join(
                str(part.value) if isinstance(part, ast.Constant) else "0" for part in node.values
            )
        if isinstance(text, str) and not re.search(r"\\|\(\?", text):
            yield text


def known_names() -> dict[str, set[str]]:
    """Public names and members of public classes, with the parameters of those that are called."""
    known: dict[str, set[str]] = {}
    for name in MODULES:
        known[name] = set()
    for name, place in PLACES.items():
        value = THINGS[name]
        known[place.rpartition(".")[2]] = set()
        members = dict(inspect.getmembers_static(value)) if isinstance(value, type) else {}
        for each, member in {name: value, **members}.items():
            function = getattr(member, "__func__", member)
            if (callable(function) and not isinstance(function, type | property)) or each == name:
                with contextlib.suppress(TypeError, ValueError):
                    known.setdefault(each, set()).update(inspect.signature(function).parameters)
            known.setdefault(each, set())
    return known


def flags_of(command: Any) -> set[str]:
    """The flags of a command and of those below it."""
    own = {flag for each in command.params for flag in (*each.opts, *each.secondary_opts)}
    return own.union(*map(flags_of, getattr(command, "commands", {}).values()))


NO_MESSAGES = {"_worker.py", "knet.py", "processes.py"}
"""Modules whose texts with brackets are code, or keys of a header."""
CALLED = re.compile(
    r"(?<![\w.{/<-])(?P<name>(?:[A-Za-z_]\w*\.)*[A-Za-z_]\w{2,})\((?P<given>[^()]*)\)?"
)
FORMULAS = {
    *("sin", "cos", "tan", "atan", "sqrt", "exp", "abs", "min", "max", "Dh²", "S_e", "S_D"),
    *("magnitude", "curve.extended", "found.isel", "found.sel", "summary.isel"),
}
"""Functions and factors of formulas; methods of objects that have no public class."""


def test_names_in_messages_exist() -> None:
    """Whatever a text names as a function, a keyword, a member or a flag is there to be used."""
    known = known_names()
    words_known = FORMULAS.union(known, *known.values())
    flags = {"--help", "--help-all"} | flags_of(get_command(app))
    unknown = set()
    for file in SOURCE.rglob("*.py"):
        if "machine_code" in file.parts or file.name in NO_MESSAGES:  # C in texts
            continue
        for text in texts_of(file):
            words = re.findall(r"(?<![\w-])--[a-z][a-z0-9-]+", text)
            unknown |= {(file.name, word) for word in words if word not in flags}
            ticked = re.findall(r"(?<!`)`([a-z_]\w*)[`(]", text)
            members = re.findall(r"(?<!\d)\)\.([a-z_]\w+)", text) + re.findall(r"\brs\.(\w+)", text)
            unknown |= {
                (file.name, word) for word in (*ticked, *members) if word not in words_known
            }
            for call in CALLED.finditer(text):
                name = call["name"].rpartition(".")[2]
                if call["name"].startswith(("numpy.", "dataclasses.")) or call["name"] in FORMULAS:
                    continue
                given = re.findall(r"(\w+)=\.\.\.", call["given"])
                reached = call["name"].removeprefix("rs.") == PLACES.get(name, call["name"])
                if name not in known or not set(given) <= known[name] or not reached:
                    unknown.add((file.name, call[0]))
    assert sorted(unknown) == []
