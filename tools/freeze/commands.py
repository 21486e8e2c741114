"""Commands: what each line of help and pages prints, writes and returns; refusals; help texts."""

import contextlib
import re
import shlex
import shutil
import tempfile
import warnings
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import typer

from rocksteady.cli import app
from tests.cli.bad_input import BAD_INPUT
from tests.cli.program import rocksteady
from tests.manual import lines as pages
from tools.freeze.files import files_of, left
from tools.freeze.records import FILE
from tools.freeze.values import of_json, tidy

EVERY_FLAG = Path(__file__).parents[2] / "tests" / "cli" / "every_flag"
"""Lines that use the flags that neither help texts nor pages use, and the files that they name."""
WRITTEN = {"--csv": "x.csv", "--netcdf": "x.nc", "--plot": "x.svg"}
"""Flags that write a file, and the file that takes the place of each."""
ELSEWHERE = re.compile(rf"{pages.ELSEWHERE.pattern}|^doctor|^--version")
"""Lines whose answer is the machine's."""
PAGE_SIZE = re.compile(r"^(size +|bytes: )\d+(?: kB)?$", re.MULTILINE)
LONG = re.compile(
    rf"{pages.LONG.pattern}|^curves .*(?:-n 3|--max-impacts 4)|--out (?!\S+\.zarr)"
    r"|^basins .*--record|^bifurcate -A 0\.1:3:6 |^edge .*--other"
)
"""Lines that take more than some two seconds: they run in the large freeze alone."""


def examples() -> list[str]:
    """Return the lines that help texts of short commands give, without the program."""
    commands = app.COMMANDS.items()
    texts = [each.module.EXAMPLES for name, each in commands if not name.startswith("study ")]
    return re.findall(r"^rocksteady (.*)$", "\n".join(texts), re.MULTILINE)


def lines(*, long: bool) -> list[str]:
    """Return the lines of the quick freeze, or those of the large one alone.

    Every line runs twice: as it prints text, and as it prints JSON and writes files. Those that
    pages alone have print text in the large freeze only; those of `EVERY_FLAG` run as they are.
    """
    texts_too, every = (
        {
            form
            for line in some
            for form in forms(pages.shortened(line))
            if not ELSEWHERE.search(line)
        }
        for some in (examples(), (*examples(), *pages.TYPED))
    )
    quick = {
        line for line in every if not LONG.search(line) and (line in texts_too or "--json" in line)
    }
    return sorted(every - quick if long else quick | set(flag_lines()))


def flag_lines() -> list[str]:
    """Return the lines of `EVERY_FLAG`."""
    return (EVERY_FLAG / "lines.txt").read_text(encoding="utf-8").splitlines()


def forms(line: str) -> set[str]:
    """Return a line as it prints text, and as it prints JSON and writes every file that it can."""
    words = [word for word in without_files(shlex.split(line)) if word != "--json"]
    if words[0] == "explore" and "--no-browser" not in words:
        words.append("--no-browser")
    flags = flags_of(words)
    files = [word for flag in sorted(flags & WRITTEN.keys()) for word in (flag, WRITTEN[flag])]
    json = ["--json"] if "--json" in flags and "--help" not in words else []
    return {shlex.join(words), shlex.join([*words, *json, *files])}


def without_files(words: list[str]) -> list[str]:
    """Return a line without the flags that write a file."""
    names = {place + 1 for place, word in enumerate(words) if word in WRITTEN}
    return [word for k, word in enumerate(words) if word not in WRITTEN and k not in names]


def flags_of(words: list[str]) -> set[str]:
    """Return the flags of the command that a line calls."""
    found: Any = program()
    for word in words:
        if word not in getattr(found, "commands", {}):
            break
        found = found.commands[word]
    return {name for parameter in found.params for name in parameter.opts}


@cache
def program() -> Any:
    """Return the program with all its commands."""
    return typer.main.get_command(app.app)


@cache
def template() -> Path:
    """Return a folder with the files that examples and pages name."""
    folder = Path(tempfile.mkdtemp(prefix="frozen-files-"))
    every = "\n\n".join(text for text in pages.PAGES.values() if pages.typed_lines(text))
    pages.write_files(folder, pages.NAMES, pages.shown(every) | pages.YOURS)
    shutil.copytree(folder / "fit", folder / "own")
    for file in EVERY_FLAG.glob("*.csv"):
        shutil.copy(file, folder)
    return folder


def fresh(folder: Path, line: str) -> None:
    """Fill a folder with the files of `template`, but for what a line is to write itself."""
    out = re.findall(r"--out (own|fit|one\.json)", line)
    shutil.copytree(template(), folder, dirs_exist_ok=True, ignore=shutil.ignore_patterns(*out))


def ran(line: str, folder: Path) -> Iterator[tuple[str, str]]:
    """Yield exit code and streams of a line, and the files that it leaves."""
    before = files_of(folder)
    words = [
        found
        for word in shlex.split(line)
        for found in (("*" in word and sorted(map(str, Path().glob(word)))) or [word])
    ]
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        warnings.showwarning = app._warn
        done = rocksteady("", *words)
    out = of_json(done.out) if "--json" in words and done.out.startswith("{") else done.out
    if words[0] == "explore":  # a page is smaller where its script has been shortened
        out = PAGE_SIZE.sub(r"\1SIZE", out)
    yield "", "\n".join([f"exit {done.code}", tidy(out, folder), tidy(done.err, folder)])
    for name, text in left(folder, before):
        yield f"{FILE}{name}", text


def freeze_line(line: str) -> Iterator[tuple[str, str]]:
    """Yield what a line leaves in a folder; where its files are refused, without them too."""
    with tempfile.TemporaryDirectory(prefix="frozen-line-") as name:
        folder = Path(name)
        fresh(folder, line)
        with contextlib.chdir(folder):
            found = dict(ran(line, folder))
    yield from ((f"{line}{part}", text) for part, text in found.items())
    bare = shlex.join(without_files(shlex.split(line)))
    if bare != line and found[""].startswith("exit 2\n"):
        yield from freeze_line(bare)


def freeze_refusals(command: str) -> Iterator[tuple[str, str]]:
    """Yield what a command answers to each fault."""
    for given, _ in BAD_INPUT:
        line = f"{command} {given}"
        done = rocksteady(line)
        yield line, f"exit {done.code}\n{done.out}{done.err}"


def paths() -> list[str]:
    """Return the path of every command, groups included."""
    found: list[str] = [""]
    for path in found:
        group: Any = program()
        for word in path.split():
            group = group.commands[word]
        found += [f"{path} {name}".strip() for name in getattr(group, "commands", {})]
    return found


def freeze_help(path: str) -> Iterator[tuple[str, str]]:
    """Yield the help of a command."""
    for flag in ("--help", "--help-all"):
        yield f"{path} {flag}".strip(), tidy(rocksteady(path, flag).out)
