"""Flags and endings of studies, `rocksteady study NAME` and `rocksteady paper`."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from rocksteady.cli.console.shell import quoted
from rocksteady.cli.flags import options
from rocksteady.cli.flags.groups import ScreenFlags
from rocksteady.cli.flags.sweep import resuming
from rocksteady.errors import OutputError, UnfinishedError
from rocksteady.results.description import Description, line
from rocksteady.results.rendering import printable

if TYPE_CHECKING:
    from rocksteady.show.study.parts import Parts

plane_flag = options.Panel("Plane")
restitution_flag = plane_flag(
    "--restitution -r R",
    "Ratio of angular velocities after and before an impact, in (0, 1).",
    default="0.8",
)


@contextmanager
def resumable_study(parts: "Parts", context: typer.Context) -> Iterator[None]:
    """Print where the finished parts of an ended study are, and remove those of a whole one.

    Parameters
    ----------
    parts
        Parts of the study.
    context
        Context of the command.
    """
    try:
        yield
    except BaseException as error:
        ended = isinstance(error, KeyboardInterrupt | UnfinishedError)
        if not (ended or (isinstance(error, OutputError) and parts.swept)):
            parts.remove()  # of seconds of work, or of what would fail again
        elif parts.folder.is_dir():
            print(
                f"finished parts are kept in {printable(parts.study)}; to go on:\n"
                f"  {resuming(context.find_root().obj)}",
                file=sys.stderr,
            )
        raise
    parts.remove()


def leave_study(name: str, result: Any, output: ScreenFlags, out: Path, files: list[Path]) -> None:
    """Print what came out, how many files there are, and how to open the page.

    Parameters
    ----------
    name
        Name of the study, and of its page.
    result
        What was computed.
    output
        Flags of the screen.
    out, files
        The folder, and the files in it.
    """
    values = {**result.values(), "out": str(out), "files": [file.name for file in files]}
    sentence, screen = result.answer
    first, *texts = (
        text.replace("\N{NO-BREAK SPACE}", " ") for text in (sentence, *result.sentences)
    )
    description = Description(
        first,
        [*screen, line("files", f"{len(files)} in {out}")],
        notes=texts,
        sentence=first,
        follow_up=f"python3 -m webbrowser {quoted(out / f'{name}.html')}",
    )
    output.leave(name, description, values=values)
