"""Errors for flags that are valid alone but not together."""

import os
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path
from typing import Any

from rocksteady.cli.console.help import HelpfulCommand
from rocksteady.errors import InputError, ModelError, one_line
from rocksteady.model.checks.arguments import LONGEST_NAME
from rocksteady.show.style.page import width_mm_of

PATHS = {"FILE", "DIR", "STORE"}
"""What `--help` shows for the value of a flag that is a path."""


class FlagError(ModelError):
    """Flags are missing, contradict each other, or have no meaning for a command.

    The message reads ``NAME = VALUE is not accepted: VALID; HINT``, or ``FINDING: VALID; HINT``.

    Parameters
    ----------
    valid, hint
        As for `rocksteady.errors.RocksteadyError`.
    name, value
        As for one flag, where only one is concerned.
    finding
        What is wrong, as a clause that names the flags, where no value is.
    """

    _verdict = "is not accepted"

    def __init__(
        self,
        name: str = "",
        value: object = None,
        valid: str = "",
        hint: str = "",
        *,
        finding: str | None = None,
    ) -> None:
        super().__init__(name, value, valid, hint)
        if finding is not None:
            self.args = (one_line(f"{finding}: {valid}; {hint}"),)


def missing(flag: str, *, valid: str, hint: str) -> FlagError:
    """Return the error of a flag that is needed and not given."""
    return FlagError(finding=f"{flag} is not given", valid=valid, hint=hint)


def require(command: str, given: Mapping[str, object], *examples: str) -> None:
    """Refuse a command that lacks what it needs, with examples that run.

    Parameters
    ----------
    command
        Name of the command.
    given
        Whether each thing that it needs is given, by its name.
    examples
        Flags of commands that run as they stand.

    Raises
    ------
    FlagError
        If something is not given.
    """
    absent = [name for name, value in given.items() if not value]
    if absent:
        tries = " or ".join(f"`rocksteady {command} {flags}`" for flags in examples)
        raise FlagError(
            finding=f"{' and '.join(absent)} {'is' if len(absent) < 2 else 'are'} not given",
            valid=f"{command} needs {'one' if len(absent) < 2 else 'both'}",
            hint=f"try {tries}",
        )


def both(one: str, other: str, *, valid: str, hint: str = "leave one out") -> FlagError:
    """Return the error of two flags of which at most one may be given."""
    return FlagError(finding=f"{one} and {other} are both given", valid=valid, hint=hint)


def refuse(flags: Mapping[str, object], valid: str, hint: str = "leave it out") -> None:
    """Refuse the first of some flags that is given; None and False stand for one that is not.

    Raises
    ------
    FlagError
        With its name and its value.
    """
    for flag, value in flags.items():
        if value is not None and value is not False:
            raise FlagError(flag, value, valid, hint)


def needs(
    flag: str, value: object, other: str, example: str = "", *, beside: object = None
) -> None:
    """Refuse a flag that has no meaning without another one, where that is not given.

    Parameters
    ----------
    flag, value
        The flag and its value, as for `refuse`.
    other, example
        What is needed, and a value that it may have.
    beside
        Value of the flag that is needed; None or False where it is not given.

    Raises
    ------
    FlagError
        If there is a value, and none of the other.
    """
    if beside is None or beside is False:
        hint = f"add {f'{other} {example}'.rstrip()}, or leave it out"
        refuse({flag: value}, f"without {other} it has no meaning", hint)


@contextmanager
def flags_of(
    flags: Mapping[str, str], kind: type[InputError] | type[FlagError] = FlagError
) -> Iterator[None]:
    """Name flags in place of arguments in the errors of what is inside.

    Parameters
    ----------
    flags
        Flag of each argument.
    kind
        The error that is raised in place of an `InputError`.
    """
    try:
        yield
    except InputError as error:
        if error.name not in flags:
            raise
        raise kind(flags[error.name], error.value, error.valid, error.hint) from None


class OncePerFlag(HelpfulCommand):
    """A command that refuses a flag with a value given twice, of which typer drops the first."""

    def make_parser(self, ctx: Any) -> Any:
        """Return typer's parser, which then looks at how often each flag was given."""
        parser: Any = super().make_parser(ctx)
        parse = parser.parse_args

        def parsed(args: list[str]) -> Any:
            given = list(args)  # typer empties its own
            values = parse(args)
            if not set(ctx.help_option_names) & set(given):
                flags = {name for each in self.params for name in each.opts if name[:1] == "-"}
                for flag, value in pairwise(given):
                    if value in flags and flag in flags and value in _values_of(values[0]):
                        raise FlagError(
                            finding=f"{flag} is given without a value",
                            valid=f"{value} after it is a flag",
                            hint=f"give a value, or write {flag}={value} where that is one",
                        )
                _check_paths(self, values[0])
                if "width_m" in {each.name for each in self.params}:
                    _check_width(values[0])
                for option, count in Counter(values[-1]).items():
                    if count > 1 and _takes_one_value(option):
                        raise _repeated(option, given)
            return values

        parser.parse_args = parsed
        return parser


def _values_of(arguments: dict[str, Any]) -> set[str]:
    """Return the texts that flags have taken."""
    values = (value if isinstance(value, list) else [value] for value in arguments.values())
    return {value for several in values for value in several if isinstance(value, str)}


def _check_paths(command: HelpfulCommand, values: dict[str, Any]) -> None:
    """Refuse names of files that are empty, which would mean this folder, or too long for any."""
    for each in command.params:
        if not PATHS & set((each.metavar or "").split("|")):
            continue
        flag = each.opts[0] if each.param_type_name == "option" else str(command.name)
        given = values.get(each.name)
        for value in given if isinstance(given, list | tuple) else [given]:
            if value == "":
                raise FlagError(
                    flag,
                    value,
                    "it is empty, which would mean this folder",
                    "name a file or a folder",
                )
            if isinstance(value, str) and any(
                len(os.fsencode(part)) > LONGEST_NAME for part in Path(value).parts
            ):
                raise FlagError(
                    flag, value, f"names in a path have at most {LONGEST_NAME} bytes", "shorten it"
                )


def _check_width(values: dict[str, Any]) -> None:
    """Refuse --width, of a picture, where the width of a block seems to be meant."""
    width, plot, height = values.get("width"), values.get("plot"), values.get("height_m")
    if width is None or values.get("width_m") or values.get("left_m"):
        return
    try:
        width_mm_of(width)
        fits = True
    except InputError:
        fits = False
    if (height and not fits) if plot else (height or not fits):
        raise FlagError(
            "--width",
            width,
            "it is the width of the picture of --plot, as 84mm",
            "did you mean --width-m?",
        )


def _takes_one_value(parameter: Any) -> bool:
    """Return whether a parameter of a command is a flag with one value."""
    option = parameter.param_type_name == "option"
    return option and not (parameter.multiple or parameter.is_flag)


def _repeated(option: Any, arguments: list[str]) -> FlagError:
    """Return the error of a flag that is given more than once."""
    values = ", ".join(repr(value)[:40] for value in _values(option.opts, arguments))
    return FlagError(
        finding=f"{'/'.join(option.opts)} is given more than once ({values})",
        valid="it takes one value",
        hint="leave out all but one",
    )


def _values(names: list[str], arguments: list[str]) -> Iterator[str]:
    """Yield what was given to an option."""
    for position, argument in enumerate(arguments):
        name, equals, value = argument.partition("=")
        if name in names and equals:
            yield value
        elif argument in names and position + 1 < len(arguments):
            yield arguments[position + 1]
        elif argument[:2] in names and not argument.startswith("--"):
            yield argument[2:]
