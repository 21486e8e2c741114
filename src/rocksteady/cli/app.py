"""The program `rocksteady`: its commands, one-line errors and exit codes.

Exit codes: 0 done, 1 negative verdict with --check, 2 usage or input, 3 incomplete or undecided,
101 internal error, 130 interrupted (Ctrl-C), and 143 and 129 by SIGTERM and SIGHUP.
"""

import errno
import re
import signal
import sys
import traceback
import warnings
from copy import copy
from functools import cache
from typing import Annotated, Any, Final, TextIO

import typer
from typer.exceptions import TyperException
from typer.models import CommandInfo

from rocksteady import __version__
from rocksteady.cli._registration import Registered, questions, registered_commands
from rocksteady.cli.console import terminal
from rocksteady.cli.console.help import NAMES, HelpfulGroup, Program, with_main
from rocksteady.cli.console.outputs import INCOMPLETE
from rocksteady.cli.console.refusals import OncePerFlag
from rocksteady.cli.flags.options import FLAG_OF_ARGUMENT
from rocksteady.cli.flags.parsing import no_number, without_unit
from rocksteady.cli.flags.record_files import FLOOR_FLAGS
from rocksteady.errors import RocksteadyError, UnfinishedError, one_line

HELP = (
    "Rocking of free-standing rigid blocks on a shaking base: exact, complete and fast.\n\n"
    "Results go to standard output, messages to standard error. Every command has --json; "
    "rocksteady COMMAND --help-all shows its flags, their units and examples."
)
USAGE, INTERNAL, INTERRUPTED = 2, 101, 130
OUTPUT_LOST = "standard output cannot be written"
LONGEST_MESSAGE = 400
"""Characters of what typer finds wrong, which shows arguments whole."""

NO_FLOOR = (
    "floors are flags of commands with a motion, and this one has none or follows two axes of it",
    "give the shaking of the floor, of which rocksteady attractor --floor-hz states the amplitude",
)
"""What is valid, and what to do, of flags of floors where a command has none."""
NO_NUMBER = "should be a valid number"
"""What typer finds of a text that is none."""

app = typer.Typer(
    name="rocksteady",
    cls=Program,
    no_args_is_help=True,
    add_completion=True,
    rich_markup_mode="rich",
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": NAMES},
)
STUDY: Final = "study"
"""The group of commands that fill a folder each, `rocksteady study NAME`."""
studies = typer.Typer(cls=HelpfulGroup, no_args_is_help=True, rich_markup_mode="rich")


@studies.callback()
def study() -> None:
    """Run a study; its help is what its users read."""


def _register() -> dict[str, Registered]:
    """Add the commands to the program, and return them by their names."""
    groups = registered_commands()
    Program.groups = {
        title: list(dict.fromkeys(name.partition(" ")[0] for name in commands))
        for title, commands in groups.items()
    }
    every = {name: each for commands in groups.values() for name, each in commands.items()}
    Program.questions = questions(every)
    for name, each in every.items():
        group, _, last = name.rpartition(" ")
        (studies if group else app).command(
            last,
            cls=with_main(OncePerFlag, getattr(each.module, "MAIN", "")),
            help=each.module.HELP,
            epilog=each.module.EXAMPLES,
        )(each.run)
    names = [command.name for command in studies.registered_commands]
    if names:
        purpose = f"Run a study into a folder: {', '.join(map(str, names))}."
        app.add_typer(studies, name=STUDY, help=purpose)
    return every


COMMANDS = _register()
"""By name, as "simulate" or "study atlas"."""


def _version(asked: bool) -> None:
    if asked:
        print(f"rocksteady {__version__}")
        raise typer.Exit


@app.callback(help=HELP)
def rocksteady(
    version: Annotated[
        bool, typer.Option("--version", help="Print the version.", callback=_version, is_eager=True)
    ] = False,
) -> None:
    """Run the program; `HELP` is what its users read."""


def main() -> None:
    """Run the program and leave with its exit code."""
    terminal.open_streams()
    terminal.catch_signals()
    warnings.showwarning = _warn
    try:
        code = run(sys.argv[1:])
    except KeyboardInterrupt:  # one more, while the first was dealt with
        code = _interrupted()
    terminal.ignore_signals()
    sys.exit(code)


def run(arguments: list[str]) -> int:
    """Run the program on a list of arguments and return its exit code."""
    terminal.tidy_environment()
    terminal.drop_notes()
    terminal.arguments[:] = arguments
    try:
        code = _program(arguments[0] if arguments else None).main(
            arguments, prog_name="rocksteady", standalone_mode=False, obj=arguments
        )
        sys.stdout.flush()
    except TyperException as error:
        return _usage_error(error, arguments)
    except RocksteadyError as error:
        flag = _flag(error.name, arguments)
        code = _complain(str(error).replace(f"{error.name} ", f"{flag} ", 1))
        return INCOMPLETE if isinstance(error, UnfinishedError) else code
    except (KeyboardInterrupt, typer.Abort):
        code = INTERRUPTED
    except SystemExit as leaving:
        # typer leaves with 1 where the reader of a pipe has left, as `head` does: no failure.
        return 0 if isinstance(leaving.__context__, BrokenPipeError) else _code(leaving.code)
    except (OSError, MemoryError, UnicodeError) as error:
        return _surroundings_error(error)
    except Exception as error:  # noqa: BLE001 -- the last line of defence: reported with its code
        return _internal_error(error)
    terminal.say_notes()
    return _interrupted() if code == INTERRUPTED else _code(code)


def _flag(name: str, arguments: list[str]) -> str:
    """Return the flag that an argument of the library is, --records where that one was given."""
    flag = FLAG_OF_ARGUMENT.get(name, name)
    plural = f"{flag}s"
    return plural if any(each.partition("=")[0] == plural for each in arguments) else flag


@cache
def _program(first: str | None) -> Any:
    """Return the program as typer builds it, once for each first word.

    Flags take long to build: beside a command or --help only what is called has them.
    """
    names = {command.name for command in app.registered_commands}
    if first not in {*names, STUDY, *NAMES, "--version"}:  # all, as to complete a line
        return typer.main.get_command(app)
    program = copy(app)
    program.registered_commands = [
        command if command.name == first else _without_flags(command)
        for command in app.registered_commands
    ]
    return typer.main.get_command(program)


def _without_flags(command: CommandInfo) -> CommandInfo:
    bare = copy(command)
    bare.callback = lambda: None
    return bare


def _interrupted() -> int:
    """Print what ended the run, and return its exit code: 128 and the number of the signal."""
    number = signal.Signals(terminal.received[-1]) if terminal.received else signal.SIGINT
    by_hand = number == signal.SIGINT
    terminal.say("interrupted" if by_hand else f"interrupted by {number.name}")
    return 128 + number


def _internal_error(error: Exception) -> int:
    """Report an error that is a bug, unless Ctrl-C has made it of compiled code."""
    if _is_interruption(error):
        return _interrupted()
    traceback.print_exception(error)
    terminal.say(
        f"internal error: {type(error).__name__}: {error}; "
        "this is a bug: please report it with the command and the lines above",
    )
    return INTERNAL


def _is_interruption(error: BaseException | None) -> bool:
    """Return whether an error comes from Ctrl-C: compiled code that it met leaves a SystemError."""
    while isinstance(error, SystemError):
        error = error.__cause__ or error.__context__
    return isinstance(error, KeyboardInterrupt)


def _surroundings_error(error: OSError | MemoryError | UnicodeError) -> int:
    """Report what no flag alone decides: a stream, the memory, an encoding.

    Files that a flag names have errors of their own.
    """
    if isinstance(error, MemoryError):
        return _complain(
            f"more memory is needed than there is ({str(error) or 'out of memory'}); take fewer "
            "points, cells or cycles"
        )
    if isinstance(error, UnicodeError):
        return _complain(f"a name or a file cannot be read as text ({error}); rename or mend it")
    if isinstance(error, BrokenPipeError):  # its reader has left, as above
        return 0
    if error.filename:
        return _complain(f"{error.filename} cannot be read or written: {error.strerror or error}")
    terminal.abandon_output()
    why = "it is closed" if error.errno == errno.EBADF else error.strerror or error
    return _complain(f"{OUTPUT_LOST}: {why}; lead it into a file, a pipe or /dev/null")


def _code(result: object) -> int:
    """Return the exit code that a command's result means: commands that return none have done."""
    return result if isinstance(result, int) else 0


def _usage_error(error: TyperException, arguments: list[str]) -> int:
    """Report what typer found wrong with the command line: what, what is valid, what to do."""
    if not error.format_message():  # help has been shown
        return 0
    context = getattr(error, "ctx", None)
    path = context.command_path if context is not None else _command_of(arguments)
    wrong = _unknown(error, path)
    if wrong is not None:
        return _complain(wrong)
    message = " ".join(error.format_message().split()).rstrip(".")
    flags = getattr(getattr(error, "param", None), "opts", [])
    values = _given(flags, arguments)
    given = values[0] if len(values) == 1 else None
    if given is not None and NO_NUMBER in message:
        return _complain(str(no_number("/".join(flags), given)))
    if given is not None:
        message = f"{message} (given: {given!r})"
    if len(message) > LONGEST_MESSAGE:
        message = f"{message[: LONGEST_MESSAGE // 2]} ... {message[-LONGEST_MESSAGE // 2 :]}"
    return _complain(f"{message}; see {path} --help")


def _unknown(error: TyperException, path: str) -> str | None:
    """Return the line of a word that is no flag, no command or too much; None of other errors."""
    option = getattr(error, "option_name", None)
    if option is not None and not hasattr(error, "possibilities"):
        return one_line(f"{option} is given without a value: it takes one; see {path} --help")
    if option is not None:
        flags = [flag for each in error.ctx.command.params for flag in each.opts]  # type: ignore[attr-defined]
        near = [flag for flag in flags if without_unit(flag) == option]
        near = near or sorted(error.possibilities or ())  # type: ignore[attr-defined]
        lists, hint = f"{path} --help-all lists its flags", "leave it out, or give one of these"
        hint = f"did you mean {' or '.join(near)}?" if near else hint
        if option in FLOOR_FLAGS.values():
            lists, hint = NO_FLOOR
        return one_line(f"{option} is no flag of {path}: {lists}; {hint}")
    words = re.match(
        r"No such command '(.*?)'\.(.*)|Got unexpected .*\((.*)\)", error.message, re.DOTALL
    )
    if words is None:
        return None
    command, suggestions, extra = words.groups()
    if extra is not None:
        return one_line(
            f"{extra!r} is too much: {path} --help-all lists what it takes; leave it out"
        )
    near = re.findall(r"'(.*?)'", suggestions)
    hint = f"did you mean {' or '.join(near)}?" if near else "give one of these"
    return one_line(f"{command!r} is no command: {path} --help lists them; {hint}")


def _command_of(arguments: list[str]) -> str:
    """Return the command that arguments call, where the error does not name it."""
    known = getattr(_program(next(iter(arguments), None)), "commands", {})
    words = ["rocksteady", *(each for each in arguments[:1] if each in known)]
    return " ".join(words)


def _given(options: list[str], arguments: list[str]) -> list[str]:
    """Return the values that followed one of the options, which typer's messages leave out."""
    flags = []
    for position, argument in enumerate(arguments):
        option, equals, value = argument.partition("=")
        if option in options and equals:
            flags.append(value)
        elif option in options and position + 1 < len(arguments):
            flags.append(arguments[position + 1])
    return flags


def _warn(
    message: Warning | str,
    category: type[Warning],  # noqa: ARG001 -- called by these names, as the others below
    filename: str,  # noqa: ARG001
    lineno: int,  # noqa: ARG001
    file: TextIO | None = None,  # noqa: ARG001
    line: str | None = None,  # noqa: ARG001
) -> None:
    """Say on standard error what a user should know, without the place in the code."""
    if not terminal.received:  # what a signal has cut short warns of being cut short
        terminal.say(str(message))


def _complain(message: str) -> int:
    """Report an error in one line, and return the code of a refusal."""
    terminal.drop_notes()
    terminal.say(message)
    return USAGE
