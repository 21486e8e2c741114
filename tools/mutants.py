"""``python -m tools.mutants``: change single places of the sources, and count what checks notice.

A mutant swaps one comparison, one operator of arithmetic or of logic, drops a sign, a `not` or a
guard, or moves one constant.  Mutants are drawn with a seed, equally many from each package.

The tests of a package are traced once.  Each mutant is given to those that call its function, the
quickest first and up to a minute, and is killed where one of them fails.  What survives is given to
the tests of recorded answers that call the function, kernels excepted.  A score is a lower bound: a
test that was left out might have failed.
"""

import argparse
import ast
import contextlib
import hashlib
import itertools
import multiprocessing
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import SimpleQueue
from typing import Any, NamedTuple

import pytest

from tools.reach import Checks, Chosen, Reach

ROOT = Path(__file__).parents[1]
SOURCES = Path("src", "rocksteady")
PACKAGES = ("dynamics", "kernels", "model", "records", "risk", "seismic", "show", "sweep")
RECORDED = "recorded"
ANSWERS = "tests/public/test_recorded.py"
"""Tests that what is public shows and returns what is recorded."""
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
STRICT = re.compile(r"zip\(.*strict=True\)", re.DOTALL)
"""Calls whose lengths differ by mistake alone: no test sees whether zip looks at them."""
MOST = 60.0
"""Seconds of the processor that the tests of a mutant take, as they were traced."""
LONGEST = 1200.0
"""Seconds after which checks that go on count as failed; those of the processor are counted too."""
LARGEST = 8 << 30
"""Bytes of addresses that checks of a mutant may take."""
WARM = (
    *("pytest", "hypothesis", "mpmath", "rich.console", "typer", "msgspec", "jinja2", "PIL.Image"),
    *("scipy.stats", "scipy.signal", "scipy.ndimage", "scipy.optimize", "scipy.special"),
    *("matplotlib.pyplot", "matplotlib.animation", "matplotlib.backends.backend_svg"),
    *("xarray", "h5netcdf", "zarr"),
)
"""Modules that each check finds imported."""


class Mutant(NamedTuple):
    """One place of a module, and what stands there instead.

    `function` is the first line of the function around it, decorators included; 0 outside any.
    """

    file: Path
    line: int
    function: int
    before: str
    after: str
    source: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.before} -> {self.after}"


def mutants(file: Path) -> list[Mutant]:
    """Return all mutants of a module; annotations, texts and what zip refuses make none."""
    source = (ROOT / file).read_text(encoding="utf-8")
    code, found = source.encode(), []
    lines = source.splitlines(keepends=True)
    begins = [0, *itertools.accumulate(len(line.encode()) for line in lines)]
    for node, function, after in _changes(ast.parse(source)):
        start = begins[node.lineno - 1] + node.col_offset
        end = begins[(node.end_lineno or 1) - 1] + (node.end_col_offset or 0)
        changed = (code[:start] + f"({after})".encode() + code[end:]).decode()
        before = " ".join(code[start:end].decode().split())
        found.append(Mutant(file, node.lineno, function, before, after, changed))
    return found


def _changes(tree: ast.AST) -> Iterator[tuple[ast.expr, int, str]]:
    """Yield the expressions that can be changed, their functions, and what takes their place."""
    for node, around in _computed(tree, 0):
        if isinstance(node, ast.If) and isinstance(node.body[0], ast.Raise | ast.Return):
            yield node.test, around, "False"
        elif isinstance(node, ast.Compare) and len(node.ops) == 1:
            left, right = ast.unparse(node.left), ast.unparse(node.comparators[0])
            yield node, around, f"{left} {SWAPPED[type(node.ops[0])]} {right}"
        elif isinstance(node, ast.BinOp) and type(node.op) in SWAPPED:
            left, right = ast.unparse(node.left), ast.unparse(node.right)
            yield node, around, f"({left}) {SWAPPED[type(node.op)]} ({right})"
        elif isinstance(node, ast.BoolOp):
            word = " or " if isinstance(node.op, ast.And) else " and "
            yield node, around, word.join(f"({ast.unparse(value)})" for value in node.values)
        elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.Not):
            yield node, around, ast.unparse(node.operand)
        elif isinstance(node, ast.Constant) and isinstance(node.value, int | float):
            other = not node.value if isinstance(node.value, bool) else node.value + 1
            yield node, around, repr(other)


def _computed(node: ast.AST, around: int) -> Iterator[tuple[ast.AST, int]]:
    """Yield a node and those within it, without types, decorators and formatted texts."""
    if isinstance(node, ast.FunctionDef):
        around = min([node.lineno, *(each.lineno for each in node.decorator_list)])
    yield node, around
    for name, value in ast.iter_fields(node):
        if name in {"annotation", "returns", "decorator_list", "bases", "type_params"}:
            continue
        if name == "keywords" and STRICT.fullmatch(ast.unparse(node)):
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST) and not isinstance(child, ast.JoinedStr):
                yield from _computed(child, around)


def draw(packages: Sequence[str], count: int, seed: int) -> list[Mutant]:
    """Return mutants, equally many of each package, drawn among its modules by their size."""
    drawn = []
    for package in packages:
        chance = random.Random(f"{seed} {package}")
        modules = sorted((ROOT / SOURCES / package).rglob("*.py"))
        every = [each for file in modules for each in mutants(file.relative_to(ROOT))]
        drawn += chance.sample(every, count // len(packages))
    return drawn


def tests_of(mutant: Mutant, checks: Checks) -> list[str]:
    """Return the tests that a mutant is given to, the quickest first.

    Where none calls its function, because that runs at import or in other processes, they are
    those that call any function of its file, then those of its folder.
    """
    folder = Path("tests", *mutant.file.parent.parts[2:])
    own = f"{folder}/test_{mutant.file.stem.strip('_')}.py::"
    named = [name for name in checks.seconds if name.startswith(own)]
    found = set(checks.reaching(mutant.file, mutant.function))
    if not found:
        found = {*checks.reaching(mutant.file, 0), *named}
    found = found or {name for name in checks.seconds if name.startswith(f"{folder}/")}
    quick = sorted(found, key=lambda name: checks.seconds[name])
    took = itertools.accumulate(checks.seconds[name] for name in quick)
    return [name for name, sofar in zip(quick, took, strict=True) if sofar < MOST] or quick[:1]


def killer(mutant: Mutant, copy: Path, reached: dict[str, Checks]) -> str:
    """Return what notices a mutant in a copy of the tree: tests, recorded answers, or nothing."""
    package = mutant.file.parts[2]
    place = copy / mutant.file
    place.write_text(mutant.source, encoding="utf-8")
    # Bytecode is known by seconds and size: no two mutants are of the same second.
    stamp = next(STAMPS)
    os.utime(place, (stamp, stamp))
    try:
        tests = tests_of(mutant, reached[package])
        seconds = sum(map(reached[package].seconds.__getitem__, tests))
        if tests and _run(_test, copy, package, tests, seconds=seconds):
            return "tests"
        if package != "kernels" and RECORDED in reached:
            answers = tests_of(mutant, reached[RECORDED]) or [*reached[RECORDED].seconds]
            seconds = sum(map(reached[RECORDED].seconds.__getitem__, answers))
            killed = answers and _run(_test, copy, RECORDED, answers, seconds=seconds)
            return RECORDED if killed else ""
    finally:
        shutil.copy2(ROOT / mutant.file, place)
    return ""


STAMPS = itertools.count(10**9)


def reach(name: str, copy: Path) -> Checks:
    """Return what the tests of a package call, or of answers; kept until a file changes."""
    shared = sorted((ROOT / SOURCES).rglob("*.py")) + sorted((ROOT / "tests").glob("*.py"))
    folders = ("frozen", "public") if name == RECORDED else (name,)
    own = [each for folder in folders for each in sorted((ROOT / "tests" / folder).rglob("*.*"))]
    files = [file for file in (*shared, *own) if file.suffix in {".py", ".txt"}]
    digest = hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()[:16]
    kept = ROOT / "build" / "mutants" / f"{name}-{digest}.json"
    if not kept.exists():
        kept.parent.mkdir(parents=True, exist_ok=True)
        if _run(_trace, copy, name, kept) or not kept.exists():
            raise SystemExit(f"the checks of {name} cannot be traced")
    return Checks.read(kept)


def _run(job: Callable[..., int], copy: Path, *given: Any, seconds: float = LONGEST) -> int:
    """Run a job in a copy of the tree, in a process that has imported what rocksteady needs."""
    limit = round(60 + 3 * seconds)
    process = SERVER.Process(target=_begun, args=(job, copy, given, limit))
    process.start()
    process.join(2 * limit if seconds < LONGEST else None)  # one that waits takes no processor
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid or 0, signal.SIGKILL)
    process.join()
    return process.exitcode or 0


SERVER: Any = multiprocessing.get_context("forkserver")


def _begun(job: Callable[..., int], copy: Path, given: Iterable[Any], seconds: int) -> None:
    """Run a job in this process, which takes its modules, files and settings from a copy."""
    os.setpgid(0, 0)
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
    resource.setrlimit(resource.RLIMIT_AS, (LARGEST, LARGEST))
    tempfile.tempdir = os.environ["TMPDIR"] = tempfile.mkdtemp(dir=copy.parent)
    os.environ["PYTHONPATH"] = str(copy / "src")
    sys.path[:0] = [str(copy / "src"), str(copy)]
    os.chdir(copy)
    with (copy.parent / "log").open("w", encoding="utf-8") as log:
        os.dup2(log.fileno(), 1)
        os.dup2(log.fileno(), 2)
        code = job(copy, *given)
        sys.stdout.flush()
    shutil.rmtree(tempfile.tempdir, ignore_errors=True)
    os._exit(code)


def _pytest(copy: Path, package: str, files: Iterable[str], plugin: object) -> int:
    if package == "kernels":
        os.environ["ROCKSTEADY_KERNELS"] = "python"
    quiet = ("-qx", "-p", "no:cacheprovider", "-W", "ignore::pytest.PytestAssertRewriteWarning")
    own = (f"--rootdir={copy}", f"--basetemp={os.environ['TMPDIR']}/pytest")
    return pytest.main([*quiet, *own, *files], [plugin])


def _test(copy: Path, package: str, tests: list[str]) -> int:
    """Run tests; return 0 where none fails."""
    files = dict.fromkeys(test.partition("::")[0] for test in tests)
    ended = _pytest(copy, package, files, Chosen(tests))
    return 0 if ended == pytest.ExitCode.NO_TESTS_COLLECTED else int(ended)


def _trace(copy: Path, name: str, kept: Path) -> int:
    """Run and trace the tests of a package, or of answers."""
    found = Reach(copy)
    found.see_memories()
    folder = ANSWERS if name == RECORDED else f"tests/{name}"
    _pytest(copy, name, ["--maxfail=1000000", folder], found)
    found.checks().write(kept)
    return 0


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
    SERVER.set_forkserver_preload(list(WARM))
    with (
        tempfile.TemporaryDirectory() as scratch,
        ThreadPoolExecutor(given.workers) as workers,
    ):
        copies = [_copy(Path(scratch, str(worker))) for worker in range(given.workers)]
        free: SimpleQueue[Path] = SimpleQueue()
        for copy in copies:
            free.put(copy)

        def judge(mutant: Mutant) -> tuple[str, float]:
            copy, began = free.get(), time.perf_counter()
            try:
                return killer(mutant, copy, reached), time.perf_counter() - began
            finally:
                free.put(copy)

        def traced(name: str) -> Checks:
            copy = free.get()
            try:
                return reach(name, copy)
            finally:
                free.put(copy)

        names = [*given.packages, *([RECORDED] if given.packages != ["kernels"] else [])]
        reached = dict(zip(names, workers.map(traced, names), strict=True))
        if RECORDED in names and _run(_test, copies[0], RECORDED, [*reached[RECORDED].seconds]):
            raise SystemExit("answers have moved without a mutant: record them first")
        killers = {}
        for mutant, (by, took) in zip(drawn, workers.map(judge, drawn), strict=True):
            killers[mutant] = by
            print(f"{by or 'survives':8} {took:4.0f} s {mutant}", flush=True)
    for package in given.packages:
        own = [by for mutant, by in killers.items() if mutant.file.parts[2] == package]
        tests, answers = own.count("tests"), own.count(RECORDED)
        print(f"{package:10} {tests:4d} of {len(own)} killed by tests, {answers} by answers")
    return 0


def _copy(folder: Path) -> Path:
    """Copy what git tracks, and `shared` beside it as here."""
    tree = folder / "main"
    listed = subprocess.run(
        ["git", "ls-files"], cwd=ROOT, capture_output=True, check=True, text=True
    )
    for name in listed.stdout.splitlines():
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, tree / name)
    if (ROOT.parent / "shared").is_dir():
        (folder / "shared").symlink_to(ROOT.parent / "shared")
    return tree


if __name__ == "__main__":
    sys.exit(main())
