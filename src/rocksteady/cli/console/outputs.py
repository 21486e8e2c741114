"""Output of a command: JSON on standard output, and files written whole or not at all."""

import sys
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocksteady.cli.console import terminal
from rocksteady.cli.console.progress import progress
from rocksteady.cli.console.shell import command_of, quoted
from rocksteady.results.rendering import printable
from rocksteady.show.export.files import json_text, save_whole, schema_of

if TYPE_CHECKING:
    import typer

    from rocksteady.show.film.animation import Film

NEGATIVE = 1
"""Exit code with --check where the verdict is negative."""
INCOMPLETE = 3
"""Exit code of a command that could not decide the question."""


WRITTEN = ("--plot", "--csv", "--netcdf", "--animate", "--out", "--runs")
"""Flags of files that are written, of which a picture keeps the name alone."""
NO_PART = ("--force", "--resume", "--more", "--quiet", "--json")
"""Flags that change no picture."""
BY_WHOM = ("--executor", "--workers", "--chunk")
"""Flags with a value that change none either: what is computed is the same bit by bit."""


def command_line() -> str:
    """Return the command as it was typed, as a picture keeps it."""
    kept, words = ["rocksteady"], iter(terminal.arguments)
    for word in words:
        flag, equals, value = word.partition("=")
        if kept[-1] in WRITTEN:
            kept.append(Path(word).name)
        elif equals and flag in WRITTEN:
            kept.append(f"{flag}={Path(value).name}")
        elif flag in BY_WHOM:
            if not equals:
                next(words, None)
        elif word not in NO_PART:
            kept.append(word)
    return command_of(kept)


def write_film(file: Path, film: "Film") -> None:
    """Save the film of --animate."""
    from rocksteady.show.film.gif import save_gif

    with progress("drawing the film", film.frames, lines=False) as done:
        save_whole("--animate", file, lambda target: save_gif(film, target, done))
    announce_file(file)


def again(context: "typer.Context", *flags: str, but: tuple[str, ...] = ()) -> str:
    """Return the command as it was given, with further flags.

    Parameters
    ----------
    context
        Context of the command.
    flags
        Flags that are added, with their values.
    but
        Flags with a value that are left out; without its store nothing is resumed.
    """
    words, kept = list(context.find_root().obj), ["rocksteady"]
    idle = {"--more", "--quiet", "--force"}
    if {"--out", "--runs"} & {*but}:
        idle.add("--resume")
    while words:
        word = words.pop(0)
        name, equals, _ = word.partition("=")
        if name in ("--csv", "--plot", *but):
            del words[: 0 if equals else 1]
        elif word not in idle:
            kept.append(quoted(word))
    return " ".join([*kept, *flags])


def report_command(context: "typer.Context", out: Path | None) -> str:
    """Return the command that opens the report of --out, or writes it to a new folder."""
    if out is not None:
        return f"python3 -m webbrowser {quoted(out / 'report.html')}"
    folders = (f"answer{number or ''}" for number in count())
    folder = next(each for each in folders if not Path(each).exists())
    return again(context, f"--out {folder}", but=("--runs",))  # a store is written once


def announce_file(file: Path) -> None:
    """Print the name of a written file on standard error."""
    print(f"wrote {printable(file)}", file=sys.stderr)


def print_json(command: str, values: dict[str, Any]) -> None:
    """Print one object with its schema; NaN and infinity become null."""
    print(json_text(schema_of(command), values))
