"""The flat public namespace: sorted, complete, lazy, and the same for Python and type checkers."""

import ast
import importlib
import subprocess
import sys
from pathlib import Path

import pytest

import rocksteady

HEAVY = ("h5py", "matplotlib", "numba", "numpy", "scipy", "typer", "xarray", "zarr")


def names_for_type_checkers() -> dict[str, str]:
    """The names imported under TYPE_CHECKING, each with the module it comes from."""
    tree = ast.parse(Path(rocksteady.__file__).read_text(encoding="utf-8"))
    blocks = [
        node
        for node in tree.body
        if isinstance(node, ast.If)
        and isinstance(node.test, ast.Name)
        and node.test.id == "TYPE_CHECKING"
    ]
    assert len(blocks) == 1
    found: dict[str, str] = {}
    for statement in blocks[0].body:
        assert isinstance(statement, ast.ImportFrom)
        assert statement.module is not None
        for alias in statement.names:
            assert alias.asname is None
            found[alias.name] = statement.module
    return found


def modules_loaded_by(code: str) -> set[str]:
    """The top-level modules that a fresh interpreter has loaded after `code`."""
    report = "\nimport sys\nprint(*{name.partition('.')[0] for name in sys.modules})"
    finished = subprocess.run(
        [sys.executable, "-c", code + report], capture_output=True, check=True, text=True
    )
    return set(finished.stdout.split())


def test_all_is_sorted_and_without_repetition() -> None:
    assert rocksteady.__all__ == sorted(set(rocksteady.__all__))


def test_type_checkers_see_what_python_imports() -> None:
    assert names_for_type_checkers() == rocksteady._DEFINED_IN
    assert sorted({*rocksteady._DEFINED_IN, "__version__"}) == rocksteady.__all__


@pytest.mark.parametrize("name", rocksteady.__all__)
def test_each_name_is_the_object_its_module_defines(name: str) -> None:
    module = importlib.import_module(rocksteady._DEFINED_IN.get(name, "rocksteady"))
    assert getattr(rocksteady, name) is getattr(module, name)


def test_dir_lists_the_public_names() -> None:
    assert dir(rocksteady) == rocksteady.__all__


def test_an_unknown_name_is_an_attribute_error_that_names_it() -> None:
    with pytest.raises(AttributeError, match="'rocksteady' has no attribute 'Blok'"):
        _ = vars(rocksteady)["__getattr__"]("Blok")
    assert not hasattr(rocksteady, "Blok")


def test_import_loads_nothing_heavy() -> None:
    assert modules_loaded_by("import rocksteady") & set(HEAVY) == set()


def test_the_errors_load_nothing_heavy() -> None:
    code = "import rocksteady\nrocksteady.InputError, rocksteady.Status"
    assert modules_loaded_by(code) & set(HEAVY) == set()
