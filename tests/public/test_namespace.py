"""The flat public namespace: sorted, complete, lazy, and the same for Python and type checkers."""

import ast
import importlib
import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

import rocksteady

HEAVY = ("h5py", "matplotlib", "numba", "numpy", "scipy", "typer", "xarray", "zarr")

ERRORS = {"InputError", "ModelError", "Words"}
SOURCE = Path(rocksteady.__file__).parent


def names_of_the_stub() -> dict[str, str]:
    """The names that the stub imports, each with the module it comes from."""
    stub = Path(rocksteady.__file__).with_suffix(".pyi")
    found: dict[str, str] = {}
    for statement in ast.parse(stub.read_text(encoding="utf-8")).body:
        if isinstance(statement, ast.ImportFrom):
            for alias in statement.names:
                assert alias.asname == alias.name  # or type checkers would not export it
                found[alias.name] = f"rocksteady.{statement.module}"
    return found


DEFINED_IN = names_of_the_stub()


def modules_loaded_by(code: str) -> set[str]:
    """The top-level modules that a fresh interpreter has loaded after `code`."""
    report = "\nimport sys\nprint(*{name.partition('.')[0] for name in sys.modules})"
    finished = subprocess.run(
        [sys.executable, "-c", code + report], capture_output=True, check=True, text=True
    )
    return set(finished.stdout.split())


def test_all_is_sorted_and_without_repetition() -> None:
    assert rocksteady.__all__ == sorted(set(rocksteady.__all__))


@pytest.mark.parametrize("name", rocksteady.__all__)
def test_each_name_is_the_object_its_module_defines(name: str) -> None:
    module = importlib.import_module(DEFINED_IN[name])
    thing = getattr(module, name)
    assert getattr(rocksteady, name) is thing
    assert getattr(thing, "__module__", module.__name__) == module.__name__


def test_dir_lists_the_public_names() -> None:
    assert dir(rocksteady) == rocksteady.__all__


def test_an_unknown_name_is_an_attribute_error_that_names_it() -> None:
    with pytest.raises(AttributeError, match="No rocksteady attribute Blok"):
        _ = vars(rocksteady)["__getattr__"]("Blok")
    assert not hasattr(rocksteady, "Blok")


def test_import_loads_nothing_heavy() -> None:
    assert modules_loaded_by("import rocksteady") & set(HEAVY) == set()


def test_the_errors_load_nothing_heavy() -> None:
    code = "import rocksteady\nrocksteady.InputError, rocksteady.Status"
    assert modules_loaded_by(code) & set(HEAVY) == set()


def test_functions_that_errors_name_exist() -> None:
    """In backticks an error names what is public, a member or a parameter of it."""
    known = set(rocksteady.__all__)
    for name in rocksteady.__all__:
        value = getattr(rocksteady, name)
        members = vars(value) if isinstance(value, type) else {name: value}
        known |= set(members)
        for each in filter(inspect.isfunction, members.values()):
            known |= set(inspect.signature(each).parameters)
    unknown = {
        (file.name, word)
        for file in SOURCE.rglob("*.py")
        for call in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(call, ast.Call) and getattr(call.func, "id", "") in ERRORS
        for part in ast.walk(call)
        if isinstance(part, ast.Constant) and isinstance(part.value, str)
        for word in re.findall(r"`([a-z_]\w*)[`(]", part.value)
        if word not in known
    }
    assert unknown == set()
