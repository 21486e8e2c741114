"""Groups of flags shared by several commands, each group one parameter of a command.

A group is a frozen dataclass whose fields are the flags; its methods turn them into nouns of the
model.  `grouped` spreads the fields over the command's signature, where typer finds them, and
collects them again when the command is called.
"""

import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import Field, dataclass, fields, is_dataclass, replace
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import typer

from rocksteady.cli.console import terminal
from rocksteady.cli.console.outputs import INCOMPLETE, announce_file, command_line, print_json
from rocksteady.cli.console.refusals import needs
from rocksteady.cli.flags import options
from rocksteady.errors import OutputError
from rocksteady.model.checks.validation import positive
from rocksteady.results.description import Description, Table, line
from rocksteady.results.rendering import print_answer, print_description
from rocksteady.show.export.files import check_apart, check_writable, save_csv, save_figure
from rocksteady.show.export.folders import OwnFolder
from rocksteady.show.style.legends import checked_place
from rocksteady.show.style.page import Page, width_mm_of

if TYPE_CHECKING:
    import pandas as pd
    import xarray
    from matplotlib.figure import Figure

    from rocksteady.cli.flags.ensemble import Suite

    Rows: TypeAlias = Table | pd.DataFrame | tuple[Sequence[str], Iterable[Sequence[object]]]
    """Rows of --csv: with a header of their own, or beside it."""

FIGURE_FORMATS = (".png", ".svg", ".pdf")


@dataclass(frozen=True, kw_only=True)
class ScreenFlags:
    """What a command prints."""

    as_json: bool = options.as_json()
    more: bool = options.more()
    quiet: bool = options.quiet()

    def leave(
        self,
        command: str,
        answer: Description,
        *,
        values: Mapping[str, Any] | None = None,
        after: Mapping[str, Any] | None = None,
        also: Sequence[Description] = (),
        decided: bool = True,
        wrap: bool = False,
        follow_up: str = "",
        suite: "Suite | None" = None,
    ) -> None:
        """Print the answer of a command, and end it with code 3 where it is undecided.

        Parameters
        ----------
        command
            Name of the schema of --json.
        answer
            What is printed.
        values, after
            The values of --json where they are not those of the answer, and further ones.
        also
            What is printed below it with --more, without --json.
        decided
            Whether the command could decide the question.
        wrap
            As for `terminal.console`.
        follow_up
            The command that goes on from the answer.
        suite
            The motions that were read, whose files are counted.

        Raises
        ------
        Exit
            If the question could not be decided.
        """
        if self.as_json:
            print_json(
                command,
                {
                    **(answer.to_dict() if values is None else values),
                    **(after or {}),
                    **({} if suite is None else suite.values),
                },
            )
        else:
            answer = answer if suite is None else suite.counted(answer)
            if (after or {}).get("synthetic"):
                example = line("example", "made-up objects and motions, no earthquake's")
                answer = replace(answer, facts=[example, *answer.facts])
            answer = replace(answer, follow_up=follow_up or answer.follow_up)
            self._print(answer, *also, wrap=wrap)
        if not decided:
            raise typer.Exit(INCOMPLETE)

    def _print(self, *descriptions: Description, wrap: bool) -> None:
        """Print the answer, and with --more or without one all of the descriptions."""
        console, answer = terminal.console(wrap=wrap), descriptions[0]
        if self.quiet:
            console.print(answer.sentence or answer.headline)
            return
        if answer.sentence:
            print_answer(answer, console)
        if self.more or not answer.sentence:
            for description in descriptions:
                print_description(description, console)


@dataclass(frozen=True, kw_only=True)
class OutputFlags(ScreenFlags):
    """What a command leaves behind."""

    plot: Path | None = options.output_flag("--plot FILE", "Save a figure: .png, .svg or .pdf.")
    width: str | None = options.output_flag(
        "--width LENGTH",
        "Set the width of --plot with its unit (mm, cm or in), as 84mm for a journal column.",
    )
    legend: str | None = options.output_flag(
        "--legend PLACE",
        "Place the legends of --plot: inside, right, below or none; default where there is room.",
    )
    csv: Path | None = options.csv()
    force: bool = options.force()

    def check(self, read: Sequence[Path] = (), *, out: Path | None = None) -> None:
        """Refuse, before anything is computed, what could not be written afterwards.

        Parameters
        ----------
        read
            Files that the command reads.
        out
            Folder that it fills.

        Raises
        ------
        OutputError
            If a file exists and --force is off, its folder is missing or not writable, a figure's
            format is unknown, or one file is given twice, is read, or lies in `out`.
        InputError
            If a width or the place of legends is not valid.
        ModelError
            If there is one of these and no figure.
        """
        _ = self.page
        for flag, value in (("--width", self.width), ("--legend", self.legend)):
            needs(flag, value, "--plot", "figure.pdf", beside=self.plot)
        check_ending("--plot", self.plot, *FIGURE_FORMATS)
        check_apart(self.files, {"--out": out}, read)
        for flag, file in self.files.items():
            if file is not None:
                check_writable(flag, file, force=self.force)

    def check_folder(self, answer: OwnFolder, out: Path | None, read: Sequence[Path] = ()) -> None:
        """Refuse, before anything is computed, outputs that would replace a file that is read.

        Raises
        ------
        OutputError
            As for `OwnFolder.check`, and where --plot or --csv is one of the files.
        """
        check_apart(self.files, read=read)
        if out is not None:
            answer.check(out, force=self.force, read=read)

    @property
    def files(self) -> dict[str, Path | None]:
        """The files that are written, by their flags."""
        return {"--plot": self.plot, "--csv": self.csv}

    @property
    def page(self) -> Page:
        """Width of a figure, and place of its legends.

        Raises
        ------
        InputError
            If one of the two is not valid.
        """
        return Page(
            width_mm=None if self.width is None else width_mm_of(self.width),
            legend=checked_place(self.legend),
        )

    def write_csv(self, rows: "Callable[[], Rows]") -> None:
        """Save the rows of --csv where it is given; a missing value is an empty cell."""
        if self.csv is None:
            return
        made = rows()
        if isinstance(made, Table):
            made = made.header, made.records()
        elif not isinstance(made, tuple):
            for name in made.columns[made.isna().any()]:
                made[name] = made[name].astype(object).where(made[name].notna(), None)
            made = list(made), made.itertuples(index=False, name=None)
        save_csv("--csv", self.csv, *made)
        announce_file(self.csv)

    def write_cells(self, dataset: "Callable[[], xarray.Dataset]") -> None:
        """Save a sweep as the file of --csv, one row per cell, where the flag is given."""
        if self.csv is None:
            return
        from rocksteady.show.export.csv_files import save_cells

        save_cells("--csv", self.csv, dataset())
        announce_file(self.csv)

    def write_plot(self, figure: "Callable[[Page], Figure]") -> None:
        """Save the picture of --plot, drawn for its page where the flag is given."""
        if self.plot is not None:
            save_figure("--plot", self.plot, figure(self.page), command=command_line())
            announce_file(self.plot)


@dataclass(frozen=True, kw_only=True)
class AnimationFlags:
    """A film, and how fast it plays."""

    animate: Path | None = options.output_flag(
        "--animate FILE", "Save a film of the block on its moving ground, to scale: .gif."
    )
    speed: float | None = options.output_flag(
        "--speed X",
        "Set the speed of --animate: seconds of a block (1 is real time), else periods of the "
        "shaking, else pt, per second of film; default 1, or what shows the run well.",
    )

    def check(self, output: OutputFlags, read: Sequence[Path] = ()) -> None:
        """Refuse, before anything is computed, what could not be written afterwards.

        Parameters
        ----------
        output
            What else is written.
        read
            Files that the command reads.

        Raises
        ------
        OutputError
            If the file is no .gif, exists and --force is off, its folder is missing or not
            writable, or another flag names it too; if a file that is read is written over.
        InputError
            If the speed is not positive.
        InputError
            If there is a speed and no film.
        """
        if self.speed is not None:
            positive("speed", self.speed, hint="give 1 for real time or one period a second")
        if self.animate is None:
            needs("--speed", self.speed, "--animate", "run.gif")
            return
        check_ending("--animate", self.animate, ".gif")
        check_apart({**output.files, "--animate": self.animate}, read=read)
        check_writable("--animate", self.animate, force=output.force)


def check_ending(flag: str, file: Path | None, *endings: str) -> None:
    """Refuse a file whose name has none of the endings.

    Raises
    ------
    OutputError
        If there is a file, and it has another ending.
    """
    if file is not None and file.suffix.lower() not in endings:
        valid = "the extension sets the format: " + ", ".join(endings)
        raise OutputError(flag, file, valid, "rename it")


def in_columns(
    columns: Sequence[str], rows: Iterable[Mapping[str, object]]
) -> "tuple[Sequence[str], Iterable[Sequence[object]]]":
    """Return a table of --csv: rows by the names of their columns."""
    return columns, ([row[name] for name in columns] for row in rows)


def grouped(command: Callable[..., Any]) -> Callable[..., Any]:
    """Spread a command's parameters that are groups into one parameter for each of their flags."""
    signature = inspect.signature(command, eval_str=True)
    groups: dict[str, type[Any]] = {
        name: parameter.annotation
        for name, parameter in signature.parameters.items()
        if isinstance(parameter.annotation, type) and is_dataclass(parameter.annotation)
    }
    spread: list[inspect.Parameter] = []
    for name, parameter in signature.parameters.items():
        if name in groups:
            of = inspect.signature(groups[name], eval_str=True).parameters
            spread += [_flag(of[each.name], each) for each in fields(groups[name])]
        else:
            spread.append(_flag(parameter, parameter.default))

    @wraps(command)
    def run(**values: Any) -> Any:
        collected = {
            name: group(**{field.name: values.pop(field.name) for field in fields(group)})
            for name, group in groups.items()
        }
        return command(**collected, **values)

    # typer reads both.
    run.__signature__ = signature.replace(parameters=spread)  # type: ignore[attr-defined]
    run.__annotations__ = {parameter.name: parameter.annotation for parameter in spread}
    return run


def _flag(parameter: inspect.Parameter, field: Any) -> inspect.Parameter:
    """Return a keyword parameter, annotated for typer with the flag of its field, if any."""
    parameter = parameter.replace(kind=inspect.Parameter.KEYWORD_ONLY)
    if not isinstance(field, Field) or options.FLAG not in field.metadata:
        return parameter
    return parameter.replace(
        annotation=Annotated[parameter.annotation, field.metadata[options.FLAG]],
        default=field.default,
    )
