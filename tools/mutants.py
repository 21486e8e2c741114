"""``python -m tools.mutants``: change single places of the sources, and count what tests notice.

A mutant swaps one comparison, one operator of arithmetic or of logic, drops a sign, a `not` or a
guard, or moves one constant.  It is killed where the tests of the same folder fail with it, those
of the same name first; what survives is compared with the freeze, kernels excepted.  Mutants are
drawn with a seed, equally many from each package.
"""

import argparse
import ast
import os
import random
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import SimpleQueue
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
SOURCES = Path("src", "rocksteady")
PACKAGES = ("dynamics", "kernels", "model", "records", "risk", "seismic", "show", "sweep")
SWAPPED: dict[type[ast.AST], str] = {
    ast.Lt: "<=",
    ast.LtE: "<",
    ast.Gt: ">=",
    ast.GtE: ">",
    ast.Eq: "!=",
    ast.NotEq: "==",
    ast.Is: "is not",
    ast.IsNot: "is",
    ast.In: "not in",
    ast.NotIn: "in",
    ast.Add: "-",
    ast.Sub: "+",
    ast.Mult: "/",
    ast.Div: "*",
}
PYTEST = (sys.executable, "-m", "pytest", "-qx", "-p", "no:cacheprovider")
FROZEN = ("calls", "things", "figures")
FREEZE = (sys.executable, "-m", "tools.freeze", "compare", *FROZEN, "--workers=1")
LONGEST = 600.0
"""Seconds after which tests that go on count as failed."""


class Mutant(NamedTuple):
    """One place of a module, and what stands there instead."""

    file: Path
    line: int
    before: str
    after: str
    source: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.before} -> {self.after}"


def mutants(file: Path) -> list[Mutant]:
    """Return all mutants of a module, annotations, `__all__` and texts excepted."""
    source = (ROOT / file).read_text(encoding="utf-8")
    found = []
    for node, after in _changes(ast.parse(source)):
        before = ast.get_source_segment(source, node) or ""
        start, end = (
            len("".join(source.splitlines(keepends=True)[: line - 1]).encode()) + column
            for line, column in (
                (node.lineno, node.col_offset),
                (node.end_lineno or 0, node.end_col_offset or 0),
            )
        )
        code = source.encode()
        changed = (code[:start] + f"({after})".encode() + code[end:]).decode()
        found.append(Mutant(file, node.lineno, " ".join(before.split()), after, changed))
    return found


def _changes(tree: ast.AST) -> Iterator[tuple[ast.expr, str]]:
    """Yield the expressions that can be changed, and what takes their place."""
    for node in _computed(tree):
        if isinstance(node, ast.If) and isinstance(node.body[0], ast.Raise | ast.Return):
            yield node.test, "False"
        elif isinstance(node, ast.Compare) and len(node.ops) == 1:
            left, right = ast.unparse(node.left), ast.unparse(node.comparators[0])
            yield node, f"{left} {SWAPPED[type(node.ops[0])]} {right}"
        elif isinstance(node, ast.BinOp) and type(node.op) in SWAPPED:
            left, right = ast.unparse(node.left), ast.unparse(node.right)
            yield node, f"({left}) {SWAPPED[type(node.op)]} ({right})"
        elif isinstance(node, ast.BoolOp):
            word = " or " if isinstance(node.op, ast.And) else " and "
            yield node, word.join(f"({ast.unparse(value)})" for value in node.values)
        elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.Not):
            yield node, ast.unparse(node.operand)
        elif isinstance(node, ast.Constant) and isinstance(node.value, int | float):
            yield node, repr(not node.value if isinstance(node.value, bool) else node.value + 1)


def _computed(node: ast.AST) -> Iterator[ast.AST]:
    """Yield a node and those within it, without types, decorators and formatted texts."""
    yield node
    for name, value in ast.iter_fields(node):
        if name in ("annotation", "returns", "decorator_list", "bases", "type_params"):
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST) and not isinstance(child, ast.JoinedStr):
                yield from _computed(child)


def tests_of(file: Path) -> list[str]:
    """Return the tests of a module: those of its name, then those of its folder."""
    folder = Path("tests", *file.relative_to(SOURCES).parent.parts)
    while not any((ROOT / folder).glob("test_*.py")):
        folder = next((each for each in folder.parents if (ROOT / each).is_dir()), folder.parent)
        if folder == Path("tests"):
            break
    own = folder / f"test_{file.stem.strip('_')}.py"
    return [*([str(own)] if (ROOT / own).is_file() else []), str(folder)]


def killer(mutant: Mutant, copy: Path) -> str:
    """Return what notices a mutant in a copy of the tree: tests, freeze, or nothing."""
    place = copy / mutant.file
    kernels = "kernels" in mutant.file.parts
    checks = {"tests": (*PYTEST, *tests_of(mutant.file))} | ({} if kernels else {"freeze": FREEZE})
    plain = {"ROCKSTEADY_KERNELS": "python"} if kernels else {}
    place.write_text(mutant.source, encoding="utf-8")
    name = ""
    try:
        for name, command in checks.items():
            ran = subprocess.run(
                command,
                cwd=copy,
                env={**os.environ, "PYTHONPATH": str(copy / "src"), **plain},
                capture_output=True,
                timeout=LONGEST,
                check=False,
            )
            if ran.returncode:
                return name
    except subprocess.TimeoutExpired:
        return name
    finally:
        shutil.copyfile(ROOT / mutant.file, place)
    return ""


def draw(packages: Sequence[str], count: int, seed: int) -> list[Mutant]:
    """Return mutants, equally many of each package, drawn among its modules by their size."""
    drawn = []
    for package in packages:
        chance = random.Random(f"{seed} {package}")
        modules = sorted((ROOT / SOURCES / package).rglob("*.py"))
        every = [each for file in modules for each in mutants(file.relative_to(ROOT))]
        drawn += chance.sample(every, count // len(packages))
    return drawn


def main(arguments: list[str] | None = None) -> int:
    """Print the survivors and the score of each package."""
    parser = argparse.ArgumentParser(prog="python -m tools.mutants", description=__doc__)
    parser.add_argument("packages", nargs="*", default=list(PACKAGES), metavar="PACKAGE")
    parser.add_argument("--count", type=int, default=300, help="mutants of all packages together")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    given = parser.parse_args(arguments)
    if unknown := set(given.packages) - set(PACKAGES):
        parser.error(f"{min(unknown)} is none of {', '.join(PACKAGES)}")
    drawn = draw(given.packages, given.count, given.seed)
    with tempfile.TemporaryDirectory() as scratch:
        free: SimpleQueue[Path] = SimpleQueue()
        for worker in range(given.workers):
            free.put(_copy(Path(scratch, str(worker))))

        def judge(mutant: Mutant) -> str:
            copy = free.get()
            try:
                return killer(mutant, copy)
            finally:
                free.put(copy)

        with ThreadPoolExecutor(given.workers) as workers:
            killers = {}
            for mutant, by in zip(drawn, workers.map(judge, drawn), strict=True):
                killers[mutant] = by
                print(f"{by or 'survives':8} {mutant}", flush=True)
    for package in given.packages:
        own = [by for mutant, by in killers.items() if mutant.file.parts[2] == package]
        tests, freeze = own.count("tests"), own.count("freeze")
        print(f"{package:10} {tests:4d} of {len(own)} killed by tests, {freeze} by the freeze")
    return 0


def _copy(folder: Path) -> Path:
    """Copy what git tracks, and `shared` beside it as here."""
    tree = folder / "main"
    listed = subprocess.run(
        ["git", "ls-files"], cwd=ROOT, capture_output=True, check=True, text=True
    )
    for name in listed.stdout.splitlines():
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / name, tree / name)
    if (ROOT.parent / "shared").is_dir():
        (folder / "shared").symlink_to(ROOT.parent / "shared")
    return tree


if __name__ == "__main__":
    sys.exit(main())
