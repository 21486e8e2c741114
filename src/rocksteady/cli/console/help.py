"""Help in three sizes: questions of the program, ten flags of a command, all flags (--help-all)."""

import textwrap
from collections.abc import Sequence
from typing import Any, ClassVar, Final

from typer.core import TyperCommand, TyperGroup

from rocksteady.cli.console._styles import style_help
from rocksteady.cli.console.terminal import console

EVERYTHING: Final = "--help-all"
"""Shows every flag, of one command or of the program."""
NAMES: Final = ["-h", "--help", EVERYTHING]
MOST: Final = 10
"""Flags that the help of a command shows."""
WIDTH: Final = 80
LABEL: Final = 24
"""Columns of a flag with the placeholder of its value."""


class _Named:
    """The names of help in one order, of which typer makes a set."""

    def get_help_option_names(self, ctx: Any) -> list[str]:
        """Return the names that the context has."""
        return [name for name in NAMES if name in ctx.help_option_names]


class HelpfulCommand(_Named, TyperCommand):
    """A command whose help shows the flags that most runs need."""

    shown: ClassVar[Sequence[str]] = ()
    """Names of the parameters that are shown, in order; all where there are none."""

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Print the purpose, ten flags and an example; with --help-all every flag."""
        if not self.shown or EVERYTHING in (ctx.obj or ()):
            style_help()
            super().format_help(ctx, formatter)
            return
        params = {param.name: param for param in self.params}
        lines = textwrap.wrap((self.help or "").partition("\n\n")[0], WIDTH)
        for name in self.shown:
            lines += _flag_lines(params[name])
        path = ctx.command_path
        lines.append(f"All {len(params)} options: {path} {EVERYTHING}")
        examples = [line for line in (self.epilog or "").split("\n\n") if line.startswith(path)]
        lines += [f"Example: {examples[0]}"] if examples else []
        console().print("\n".join(lines))


class HelpfulGroup(_Named, TyperGroup):
    """A group of commands whose help typer makes."""


class Program(HelpfulGroup):
    """The program, whose commands stand in groups."""

    groups: ClassVar[dict[str, Sequence[str]]] = {}
    """Names of commands under the title of their group."""
    questions: ClassVar[str] = ""
    """What the program alone shows."""

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Print the commands by group; of the program alone the questions that it answers."""
        given = ctx.obj or []
        if EVERYTHING in given:
            style_help()
            super().format_help(ctx, formatter)
        elif not given:
            console().print(self.questions)
        else:
            console().print("\n".join(self._lines()))

    def _lines(self) -> list[str]:
        """Return the lines of --help."""
        count, groups = len(self.commands), len(self.groups)
        lines = [f"Usage: rocksteady COMMAND [OPTIONS]      {count} commands in {groups} groups"]
        for title, names in self.groups.items():
            lines.append(title)
            for name in names:
                purpose = (self.commands[name].help or "").partition("\n\n")[0]
                lines.append(f"  {name:<12}  {purpose}")
        lines.append(f"Most commands: --json, --more, --plot FILE, --csv FILE; all: {EVERYTHING}.")
        return lines


def with_main(kind: type[HelpfulCommand], main: str) -> type[HelpfulCommand]:
    """Return a class of commands whose help shows some flags.

    Parameters
    ----------
    kind
        The class without them.
    main
        Names of the parameters, with spaces between them.
    """
    return type(kind.__name__, (kind,), {"shown": tuple(main.split())})


def _flag_lines(param: Any) -> list[str]:
    """Return a flag and the first sentence on it, in lines."""
    names = ", ".join(sorted(param.opts, key=len))
    if param.param_type_name == "argument":
        names = param.metavar or param.name.upper()
    elif param.metavar:
        names += f" {param.metavar}"
    words = (param.help or "").replace("\\[", "[").partition(". ")[0].partition("; ")[0]
    wrapped = textwrap.wrap(f"{words.rstrip('.')}.", WIDTH - LABEL - 2)
    first = [f"  {names:<{LABEL}}{wrapped[0]}"]
    if len(names) >= LABEL:
        first = [f"  {names}", f"{'':{LABEL + 2}}{wrapped[0]}"]
    return first + [f"{'':{LABEL + 2}}{line}" for line in wrapped[1:]]
