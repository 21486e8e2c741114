"""The tree of the package: who imports whom decides a module's name."""

import ast
import importlib
import re
import subprocess
from collections import defaultdict
from functools import cache
from pathlib import Path

import pytest

from rocksteady.cli._registration import GROUPS
from rocksteady.results import result
from tests.every import every
from tests.trees import nodes_of, tree_of

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src" / "rocksteady"
FILES = sorted(SOURCE.rglob("*.py"))
STARTED = {
    *("rocksteady.__main__", "rocksteady.cli.app", "rocksteady.gpu.executor"),
    "rocksteady.kernels.entries",
    *result._words.values(),
    *(
        f"rocksteady.{each.partition(':')[0]}"
        for group in GROUPS.values()
        for each in group.values()
    ),
    *("rocksteady.certify.proofs.checker", "rocksteady.certify.proofs.fate_checker"),
    *(f"rocksteady.certify.proofs.{kind}_checker" for kind in ("base", "chaos", "point", "region")),
}
"""Modules that are run, or imported, by their names."""
TWICE = {
    frozenset({"kernels/linear", "kernels/nonlinear"}),  # one thing in both models
    frozenset({"kernels/march", "kernels/nonlinear"}),
    frozenset({"kernels/lanes", "kernels/nonlinear_lanes"}),
    frozenset({"show/plots", "show/figures"}),  # a thing and its figure
    frozenset({"certify", "certify/chaos_study"}),  # a command each
}
"""Folders of one layer that may have files of one name."""


ROOTS = {
    *(".ci", ".github", ".gitignore", "CHANGELOG.md", "CITATION.cff", "CODE_OF_CONDUCT.md"),
    *("CONTRIBUTING.md", "LICENSE", "Makefile", "README.md", "SECURITY.md", "bench"),
    *("codemeta.json", "constraints.txt", "docs", "examples", "hatch_build.py", "paper"),
    *("pyproject.toml", "src"),
    *("tests", "tools"),
}
"""What stands in the root of the repository."""


def name_of(file: Path) -> str:
    """Return the dotted name of a module."""
    return ".".join(("rocksteady", *file.relative_to(SOURCE).with_suffix("").parts))


NAMES = {name_of(file): file for file in FILES}


@cache
def imports() -> dict[str, list[ast.Import | ast.ImportFrom]]:
    """Return what each module imports, wherever it does so."""
    return {
        name: [node for node in nodes_of(file) if isinstance(node, ast.Import | ast.ImportFrom)]
        for name, file in NAMES.items()
    }


def imported(name: str) -> set[str]:
    """Return the modules of the package that a module imports."""
    found = set()
    for node in imports()[name]:
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        else:
            found |= {str(node.module), *(f"{node.module}.{alias.name}" for alias in node.names)}
    return found & NAMES.keys()


PUBLIC = {
    ".".join(("rocksteady", *file.relative_to(SOURCE).parts[:-1], str(node.module)))
    for file in SOURCE.rglob("*.pyi")
    for node in ast.parse(file.read_text(encoding="utf-8")).body
    if isinstance(node, ast.ImportFrom)
} | {name_of(file) for file in SOURCE.glob("[!_]*.pyi")}
"""Modules that define public names, and those through which they are reached."""
OPEN = {name_of(file).removesuffix(".__init__") for file in SOURCE.rglob("*.pyi")}
"""Modules through which public names are reached."""


@cache
def importers() -> dict[str, set[str]]:
    """Return who imports each module."""
    users: dict[str, set[str]] = defaultdict(set)
    for name in NAMES:
        for other in imported(name):
            users[other].add(name)
    return users


def folder_of(name: str) -> str:
    return name.rpartition(".")[0]


def is_private(name: str) -> bool:
    return name.rpartition(".")[2].startswith("_")


@every("name", [name for name in sorted(NAMES) if not name.endswith("__")])
def test_a_module_that_only_its_own_folder_imports_has_an_underscore_and_no_other(
    name: str,
) -> None:
    elsewhere = {
        user
        for user in importers()[name]
        if folder_of(user) != folder_of(name) and user != "rocksteady.__init__"
    }
    public = name in PUBLIC
    assert is_private(name) == (not elsewhere and not public and name not in STARTED), elsewhere


def test_words_know_the_type_of_what_they_describe() -> None:
    """Nothing in `words` is typed Any."""
    named = {
        str(file.relative_to(SOURCE))
        for file in (SOURCE / "words").rglob("*.py")
        if any(isinstance(node, ast.Name) and node.id == "Any" for node in nodes_of(file))
    }
    assert named == set()


def test_what_is_public_stands_in_modules_without_underscore() -> None:
    assert [name for name in sorted(PUBLIC) if "._" in name] == []


def test_a_name_stands_once_in_a_layer() -> None:
    places: dict[tuple[str, str], set[str]] = defaultdict(set)
    for file in FILES:
        path = file.relative_to(SOURCE)
        if len(path.parts) > 1 and path.stem != "__init__" and path.parts[0] != "studies":
            places[path.parts[0], path.stem.removeprefix("_")].add(path.parent.as_posix())
    twice = {frozenset(folders) for folders in places.values() if len(folders) > 1}
    assert twice <= TWICE


def test_every_folder_says_what_it_answers() -> None:
    for folder in {file.parent for file in FILES}:
        said = ast.get_docstring(tree_of(folder / "__init__.py"))
        assert said, folder
        assert said.splitlines()[0].endswith("."), folder


def test_no_name_is_imported_from_a_module_that_has_it_from_another() -> None:
    """The namespaces of the package and of a study are there to pass names on."""
    passed_on = []
    for name, nodes in imports().items():
        for node in nodes:
            if not isinstance(node, ast.ImportFrom) or node.module not in NAMES.keys() - OPEN:
                continue
            passed_on += [
                f"{name}: {alias.name} of {node.module}"
                for alias in node.names
                if alias.name not in defined_in(node.module)
            ]
    assert passed_on == []


@cache
def defined_in(name: str) -> set[str]:
    """Return the names that a module itself defines."""
    found: set[str] = set()
    for node in tree_of(NAMES[name]).body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            found.add(node.name)
        elif isinstance(node, ast.Assign | ast.AnnAssign | ast.For | ast.With | ast.If | ast.Try):
            found |= {
                inner.id
                for inner in ast.walk(node)
                if isinstance(inner, ast.Name) and isinstance(inner.ctx, ast.Store)
            }
            found |= {
                inner.name
                for inner in ast.walk(node)
                if isinstance(inner, ast.FunctionDef | ast.ClassDef)
            }
    return found


def test_tests_stand_in_the_folders_of_what_they_test() -> None:
    """A test of a module has its name, in the same folder of `tests`."""
    tests = ROOT / "tests"
    parts = (SOURCE / "explorer" / "parts").rglob("*.mjs")  # of the page, tested from Python
    folders = {file.parent.relative_to(SOURCE) for file in (*FILES, *parts)}
    # Beside the package, or of all of it.
    own = {
        Path("tools"),
        Path("tools/aot"),
        Path("tools/aot/device"),
        Path("public"),
        Path("manual"),
        Path("explorer/browser"),
    }
    own |= {Path("explorer/browser/tabs"), Path()}
    for file in tests.rglob("test_*.py"):
        folder = file.relative_to(tests).parent
        assert folder in folders | own, file
    stems = {
        (file.parent.relative_to(SOURCE), file.stem.removeprefix("_"))
        for file in FILES
        if file.stem != "__init__"
    }
    layers = {(folder.parts[:1], stem) for folder, stem in stems}
    misplaced = [
        place.as_posix()
        for place in (file.relative_to(tests) for file in tests.rglob("test_*.py"))
        for stem in [place.stem.removeprefix("test_")]
        if (place.parts[:1], stem) in layers and (place.parent, stem) not in stems
    ]
    assert misplaced == []


# --------------------------------------------------------------------- what texts say of the tree

LAYERS = "|".join(sorted(folder.name for folder in SOURCE.iterdir() if folder.is_dir()))
REFERENCE = re.compile(rf"`+((?:rocksteady\.)?(?:{LAYERS})(?:\.(?!csv`)\w+)+)(?:\(\))?`")
TEXTS = {
    str(file.relative_to(ROOT)): file.read_text(encoding="utf-8")
    for file in (*FILES, *(ROOT / "docs").rglob("*.md"), ROOT / "CONTRIBUTING.md")
}


def resolved(name: str) -> bool:
    """Return whether a dotted name leads to a module, or to something in one."""
    parts = ("rocksteady." + name.removeprefix("rocksteady.")).split(".")
    for count in range(len(parts), 1, -1):
        try:
            found: object = importlib.import_module(".".join(parts[:count]))
        except ModuleNotFoundError:
            continue
        for attribute in parts[count:]:
            fields = getattr(found, "__dataclass_fields__", {})
            if not hasattr(found, attribute) and attribute not in fields:
                return False
            found = getattr(found, attribute, None)
        return True
    return False


@every("page", [page for page, text in TEXTS.items() if REFERENCE.search(text)])
def test_what_a_text_names_is_there(page: str) -> None:
    assert [name for name in REFERENCE.findall(TEXTS[page]) if not resolved(name)] == []


@pytest.mark.skipif(not (ROOT / ".git").exists(), reason="this is no checkout")
def test_nothing_that_a_run_left_is_in_the_repository() -> None:
    listed = subprocess.run(
        ["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True
    )
    assert {Path(name).parts[0] for name in listed.stdout.splitlines()} <= ROOTS
