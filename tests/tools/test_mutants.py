"""Mutants: what is changed, which tests each is given to, and what the tests of a tree notice."""

import shutil
from pathlib import Path

import pytest

from tools import mutants as tool
from tools.reach import Checks

SOURCE = '''"""A module."""

from functools import cache

LEAST = 2


@cache
def kept(values: tuple[int, ...], most: int = 3) -> int:
    """Return how many there are, 7 at most."""
    if not values:
        raise ValueError(f"{len(values) + 1}")
    return -min(len(values), most) * LEAST
'''
FILE = Path("src", "rocksteady", "made", "_counting.py")


@pytest.fixture(name="tree")
def _tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    tree = tmp_path / "main"
    monkeypatch.setattr(tool, "ROOT", tree)
    (tree / FILE).parent.mkdir(parents=True)
    (tree / FILE).write_text(SOURCE, encoding="utf-8")
    return tree


@pytest.mark.usefixtures("tree")
def test_each_place_is_changed_once_and_named_with_its_function() -> None:
    found = tool.mutants(FILE)
    assert [(each.line, each.function, each.before, each.after) for each in found] == [
        (5, 0, "2", "3"),
        (9, 8, "3", "4"),
        (11, 8, "not values", "False"),
        (11, 8, "not values", "values"),
        (13, 8, "-min(len(values), most) * LEAST", "(-min(len(values), most)) / (LEAST)"),
        (13, 8, "-min(len(values), most)", "min(len(values), most)"),
    ]
    whole = SOURCE.replace("most) * LEAST", "most)) / (LEAST)").replace("-min", "((-min")
    assert found[4].source == f"{whole.rstrip()})\n"


def test_texts_types_and_what_zip_refuses_are_left_as_they_are(tree: Path) -> None:
    (tree / FILE).write_text('pairs: "list[2]" = [*zip("1", "2", strict=True)]\n', encoding="utf-8")
    assert tool.mutants(FILE) == []
    # Of others, and where lengths may differ, it can be seen.
    for call in ('zip("1", "2", strict=False)', 'reader("1", strict=True)'):
        (tree / FILE).write_text(f"rows = [*{call}]\n", encoding="utf-8")
        assert len(tool.mutants(FILE)) == 1


@pytest.mark.usefixtures("tree")
def test_a_seed_draws_the_same_mutants_of_each_package() -> None:
    drawn = tool.draw(["made"], 4, 7)
    assert len(set(drawn)) == 4
    assert drawn == tool.draw(["made"], 4, 7) != tool.draw(["made"], 4, 8)


def mutant(function: int) -> tool.Mutant:
    return tool.Mutant(FILE, 13, function, "1", "2", "")


def test_a_mutant_is_given_to_the_tests_of_its_function_for_a_minute() -> None:
    own = [f"tests/made/test_counting.py::test_{k}" for k in range(3)]
    other = [f"tests/made/test_other.py::test_{k}" for k in range(60)]
    seconds = {name: 0.01 * k for k, name in enumerate(other)}
    seconds |= dict(zip(own, (30.0, 2.0, 40.0), strict=True))
    checks = Checks(seconds, {f"{FILE}:8": [*own, *other], f"{FILE}:20": other[50:]})
    quickest = [*other, own[1], own[0]]  # a minute at most
    assert tool.tests_of(mutant(8), checks) == quickest
    assert tool.tests_of(mutant(20), checks) == other[50:]
    # Outside any function, and in one that no test calls: those of the file.
    for line in (0, 99):
        assert tool.tests_of(mutant(line), checks) == quickest
    nowhere = tool.tests_of(mutant(8), Checks(seconds, {}))
    assert nowhere == [own[1], own[0]]


@pytest.mark.slow
def test_a_mutant_is_killed_where_a_test_fails_that_did_not(tree: Path) -> None:
    package = tree / "src" / "rocksteady"
    (package / "__init__.py").touch()
    (tree / "pytest.ini").write_text("[pytest]\n", encoding="utf-8")
    test = tree / "tests" / "made" / "test_counting.py"
    test.parent.mkdir(parents=True)
    test.write_text(
        "from rocksteady.made._counting import kept\n\n"
        "def test_few():\n    assert kept((1, 2)) == -4\n\n"
        "def test_fails_anyway():\n    assert kept((1, 2)) == 0\n\n"
        "def test_anything():\n    assert True\n",
        encoding="utf-8",
    )
    tool.SERVER.set_forkserver_preload(["pytest"])
    found = tool.reach("made", tree)
    few, rest = (f"tests/made/test_counting.py::test_{name}" for name in ("few", "anything"))
    assert set(found.seconds) == {few, rest}
    assert found.callers[f"{FILE}:8"] == [few]
    reached = {"made": found}
    copy = Path(shutil.copytree(tree, tree.parent / "copy" / "main"))
    constant, _, guard, *_ = tool.mutants(FILE)
    assert tool.killer(constant, copy, reached) == "tests"
    assert tool.killer(guard, copy, reached) == ""
    answers = copy / tool.ANSWERS
    answers.parent.mkdir()
    answers.write_text(
        "import pytest\n\nfrom rocksteady.made._counting import kept\n\n"
        "def test_empty():\n    with pytest.raises(ValueError, match='1'):\n        kept(())\n",
        encoding="utf-8",
    )
    empty = f"{tool.ANSWERS}::test_empty"
    reached[tool.RECORDED] = Checks({empty: 0.1}, {f"{FILE}:8": [empty]})
    assert tool.killer(guard, copy, reached) == "recorded"
    assert (copy / FILE).read_text(encoding="utf-8") == SOURCE
