"""Environment of the program: streams, terminal width, signals, consoles.

None of them may change what a command computes or lose what it prints: a stream may be closed, in
another encoding or on a full disk, a variable of the environment may hold anything.
"""

import io
import logging
import os
import shutil
import signal
import sys
from contextlib import suppress
from types import FrameType
from typing import TYPE_CHECKING, Any, TextIO

from rocksteady.cli.console._styles import styled
from rocksteady.results.rendering import printable

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

NARROWEST, WIDEST = 40, 400
"""Columns within which help and progress are laid out; a terminal of others wraps or fills."""
TABLE = 80
"""Columns that every table of results has, however narrow the terminal."""
ENDING = ("SIGINT", "SIGTERM", "SIGHUP")
"""Signals that end a run in order; Windows has no SIGHUP."""

received: list[int] = []
"""Numbers of the signals that have arrived, the last one at the end."""

arguments: list[str] = []
"""Command line of the program, as typed."""

_notes: list[str] = []
_suggestions: list[str] = []


def note(words: str) -> None:
    """Keep a line for standard error until work begins: a refusal is one line alone."""
    _notes.append(words)


def say_notes() -> None:
    """Print the lines that are kept."""
    while _notes:
        say(_notes.pop(0))


def drop_notes() -> None:
    """Forget the lines that are kept."""
    _notes.clear()
    _suggestions.clear()


def suggest(words: str) -> None:
    """Keep what a run that turns out to be long would do better with."""
    _suggestions[:] = [words]


def say_suggestion() -> None:
    """Print what is kept for a long run, once."""
    while _suggestions:
        say(_suggestions.pop())


def say(words: str) -> None:
    """Print one line on standard error, with the name of the program."""
    print(f"rocksteady: {printable(words)}", file=sys.stderr)


def open_streams() -> None:
    """Make the standard streams such that no text and no closed or full one raises an error.

    Characters without a code in the encoding of a stream are escaped, messages that cannot be
    written are dropped, and a result that cannot be written is an error: of a standard output that
    was closed too.
    """
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:  # or print would write messages into standard output
            access = os.O_RDONLY if name == "stdout" else os.O_RDWR  # which refuses what is written
            stream = open(os.open(os.devnull, access), mode, encoding="utf-8")  # noqa: PTH123, SIM115
            setattr(sys, name, stream)
            setattr(sys, f"__{name}__", stream)
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")
    if isinstance(sys.stderr, io.TextIOWrapper):
        sys.stderr.reconfigure(errors="backslashreplace")
        sys.stderr = _Messages(sys.stderr)


def abandon_output() -> None:
    """Lead standard output nowhere: what it still holds cannot be written at the end either."""
    with suppress(OSError, ValueError):  # a stream in memory has no number
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


class _Messages:
    """Standard error, which drops what it cannot write: an error of it has nowhere to go."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        """Write a text, or drop it."""
        with suppress(OSError):
            return self._stream.write(text)
        return len(text)

    def flush(self) -> None:
        """Write what is buffered, or leave it."""
        with suppress(OSError):
            self._stream.flush()

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


def tidy_environment() -> None:
    """Replace variables of the environment that libraries would stumble over.

    Pictures are saved and never shown, so that matplotlib needs no window system.
    """
    os.environ["MPLBACKEND"] = "agg"
    columns = shutil.get_terminal_size((TABLE, 24)).columns
    if "COLUMNS" in os.environ or not NARROWEST <= columns <= WIDEST:
        os.environ["COLUMNS"] = str(min(max(columns, NARROWEST), WIDEST))
    for name in ("LINES", "TERMINAL_WIDTH"):  # rich and typer take these for numbers, of any size
        os.environ.pop(name, None)
    logging.getLogger("matplotlib").setLevel(logging.ERROR)  # of settings and folders of its own


def catch_signals() -> None:
    """Let the signals that end a run raise KeyboardInterrupt, unless they are ignored.

    What runs then is the same for all of them: finished work is kept, and how to go on is printed.
    """

    def stop(number: int, _: FrameType | None) -> None:
        received.append(number)
        raise KeyboardInterrupt

    for name in ENDING:
        number = getattr(signal, name, None)
        # Under nohup SIGHUP is ignored, and SIGINT in the background of a script.
        if number is not None and signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, stop)


def ignore_signals() -> None:
    """Let no further signal change how the program ends."""
    for name in ENDING:
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_IGN)


def console(*, wrap: bool = False) -> "Console":
    """Return what results are printed on: texts as they are, tables whole.

    Parameters
    ----------
    wrap
        Whether long texts are wrapped at the width of the terminal.
    """
    from rich.console import Console

    class Plain(Console):
        """A console to which no text is markup, and which no text controls."""

        def render_str(self, text: str, **options: Any) -> "Text":
            """Return a text with its unprintable characters escaped."""
            return super().render_str(printable(text, keep="\n"), **options)

    columns = shutil.get_terminal_size((TABLE, 24)).columns
    return Plain(
        highlight=False,
        markup=False,
        emoji=False,
        soft_wrap=not wrap,
        width=min(max(TABLE, columns), WIDEST),
        **styled(),
    )
