"""`rocksteady facade`: checks of a facade against overturning, static and dynamic."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, TypeVar

import typer

from rocksteady.cli.console.outputs import NEGATIVE, announce_file, report_command
from rocksteady.cli.console.refusals import FlagError, needs, refuse
from rocksteady.cli.console.shell import command_of
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import named_model
from rocksteady.cli.flags.ensemble import Suite, SuiteFlags
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.parsing import number
from rocksteady.cli.flags.record_files import ReadingFlags, remark_on_scale
from rocksteady.facades.page.files import FACADE
from rocksteady.model.blocks.housner_forms import form_of_text

if TYPE_CHECKING:
    from rocksteady.facades.checks.facade import Facade
    from rocksteady.facades.checks.facade_check import FacadeCheck
    from rocksteady.facades.checks.facade_demand import FacadeDemand
    from rocksteady.facades.checks.facade_runs import FacadeRuns
    from rocksteady.model.motions.base_motion import BaseMotion
    from rocksteady.model.motions.record import Record
    from rocksteady.results.description import Description

HELP = (
    "Check a wall, parapet, pinnacle or gable (Circolare 2019 n. 7).\n\n"
    "Check a wall, parapet, pinnacle or gable against falling, by Circolare 2019 n. 7, C8.7.1: "
    "linear, nonlinear static and nonlinear dynamic, side by side.\n\n"
    "FILE describes the facade in TOML (docs/guides/facades.md), with loads, ties and the "
    "demand of each limit state. A tie counts in displacements with until_collapse = true. "
    "--records runs the facade under ground motions, as recorded and reversed: no run may go "
    "beyond d0, and the mean of the largest displacements has a limit. If FILE has no demand "
    "for the limit state of the records, 7 records or more give it. --out writes a report in "
    "English or Italian."
)
MAIN = "file records pga_g limit_state restitution language out check plot example"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady facade --example --plot wall.png\n\n"
    "rocksteady facade wall.toml --records suite --pga-g 0.25\n\n"
    "rocksteady facade wall.toml --records suite --out answer --language it\n\n"
    "rocksteady facade wall.toml --json --check\n\n"
    "Your files: wall.toml, a facade; suite, a folder of records."
)
T = TypeVar("T")
EXAMPLE_MOTIONS = 10
run_flag = options.Panel("Runs")

SIGNS: dict[str, Literal["both", "as recorded", "reversed"]] = {
    "both": "both",
    "recorded": "as recorded",
    "reversed": "reversed",
}
STATES: dict[str, Literal["SLV", "SLC"]] = {"SLV": "SLV", "SLC": "SLC"}
LANGUAGES: dict[str, Literal["en", "it"]] = {"en": "en", "it": "it"}


@grouped
def facade(
    context: typer.Context,
    recorded: SuiteFlags,
    reading: ReadingFlags,
    output: OutputFlags,
    file: Annotated[
        Path | None,
        typer.Argument(metavar="FILE", help="A facade and its demand in TOML."),
    ] = None,
    scale: str | None = run_flag(
        "--scale S", "Multiply the accelerations of all records by a factor; default 1."
    ),
    pga_g: str | None = run_flag(
        "--pga-g G",
        "Scale each record to a peak acceleration in g (9.80665 m/s^2); instead of --scale.",
    ),
    limit_state: str = run_flag(
        "--limit-state NAME",
        "Choose the limit state of the records: SLV, limit 0.4 d0 (default), or SLC, 0.6 d0.",
        default="SLV",
    ),
    directions: str = run_flag(
        "--directions NAME",
        "Choose the signs of the records: both (default), recorded or reversed.",
        default="both",
    ),
    restitution: str | None = run_flag(
        "--restitution -r E",
        "Set the restitution of impacts on the building behind, in [0, 1], or 'housner'; "
        "default that of FILE.",
    ),
    model: str | None = run_flag(
        "--model NAME", "Choose the equations of motion: nonlinear (default) or linear."
    ),
    out: Path | None = options.output_flag(
        "--out DIR",
        "Write the report, the checks, the runs and the inputs with their hashes into a new "
        "folder; --force replaces those of an earlier check.",
    ),
    language: str = options.output_flag(
        "--language NAME",
        "Choose the language of --out and --plot: en (default) or it.",
        default="en",
    ),
    example: bool = run_flag(
        "--example",
        f"Check an invented wall under {EXAMPLE_MOTIONS} synthetic motions, without a file.",
        default=False,
    ),
    check: bool = options.output_flag(
        "--check",
        "Leave with exit code 1 where a check is not satisfied; without a verdict with 2.",
        default=False,
    ),
) -> None:
    """Run `rocksteady facade`; `HELP` is what its users read."""
    from rocksteady.facades.checks.check_facade import check_facade
    from rocksteady.facades.checks.facade_runs import run_facade
    from rocksteady.facades.checks.read_facade import EXAMPLE, read_facade

    tongue = _chosen("--language", language, LANGUAGES)
    state = _chosen("--limit-state", limit_state, STATES)
    signs = _chosen("--directions", directions, SIGNS)
    equations = None if model is None else named_model(model)
    factor = None if scale is None else number("--scale", scale)
    level = None if pga_g is None else number("--pga-g", pga_g)
    flags = {
        "--scale": scale,
        "--pga-g": pga_g,
        "--limit-state": None if state == "SLV" else state,
        "--directions": None if signs == "both" else directions,
        "--restitution": restitution,
        "--model": model,
    }
    _refuse_idle(file, recorded, reading, flags, example=example)
    if tongue != "en" and out is None and output.plot is None:
        valid = "it is that of --out and --plot, and neither is given"
        refuse({"--language": language}, valid, "add --out DIR, or leave it out")
    output.check([] if file is None else [file], out=out)
    output.check_folder(FACADE, out)
    described = read_facade(EXAMPLE if file is None else file)
    wall = _with_restitution(described.facade, restitution)
    demand, runs, files = described.demand, None, [] if file is None else [*described.files]
    suite = Suite()
    if example:
        suite = Suite.synthetic(EXAMPLE_MOTIONS)
    elif recorded.records:
        suite = recorded.suite(reading)
    files += suite.files
    output.check_folder(FACADE, out, [*files, *suite.read])
    if suite.motions:
        runs = run_facade(
            wall,
            suite.motions,
            scale=factor,
            pga_g=level,
            limit_state=state,
            directions=signs,
            model=equations,
        )
        remark_on_scale(float(runs.scale.max()), "the largest factor multiplies a record")
        demand = _with_records(demand, suite.motions, runs)
    facade_check = check_facade(wall, demand, runs=runs)
    if check:
        _refuse_open(facade_check)
    _write(context, facade_check, output, out, (suite.motions, files), language=tongue)
    after = {"synthetic": example, "files": [str(each) for each in files]}
    text, values = _in_text(facade_check, example=example), facade_check.to_dict()
    more = report_command(context, out)
    output.leave("facade", text, values=values, after=after, follow_up=more, suite=suite)
    if check and any(each.satisfied is False for each in facade_check.checks):
        raise typer.Exit(NEGATIVE)


def _chosen(flag: str, text: str, names: dict[str, T]) -> T:
    """Return what a flag names, in either case.

    Raises
    ------
    FlagError
        If there is no such name.
    """
    folded = {name.lower(): value for name, value in names.items()}
    if text.lower() not in folded:
        first, second, *_ = names
        valid = f"it is one of {', '.join(names)}"
        raise FlagError(flag, text, valid, f"give {first}, or {second}")
    return folded[text.lower()]


def _refuse_idle(
    file: Path | None,
    recorded: SuiteFlags,
    reading: ReadingFlags,
    flags: dict[str, str | None],
    *,
    example: bool,
) -> None:
    """Refuse flags that have no meaning beside what is checked.

    Raises
    ------
    FlagError
        With the flag and what to do.
    """
    files = {**recorded.given, **reading.given}
    if example:
        if file is not None:
            refuse({"--example": True}, f"{file} is checked already", "leave one out")
        refuse(files, "--example reads no files")
    elif file is None:
        raise FlagError(
            finding="neither FILE nor --example is given",
            valid="a facade is described in TOML",
            hint="name it, as wall.toml; docs/guides/facades.md lists its keys",
        )
    elif not recorded.records:
        for flag, value in (files | flags).items():
            needs(flag, value, "--records", "example:near-fault")
    if flags["--scale"] is not None:
        level = {"--pga-g": flags["--pga-g"]}
        refuse(level, "--scale is the other way to set the level", "leave one out")


def _with_restitution(wall: "Facade", text: str | None) -> "Facade":
    """Return a facade with the restitution of --restitution, where it is given.

    Raises
    ------
    FlagError, InputError
        If it is no number in its range.
    """
    if text is None:
        return wall
    form = form_of_text(text)
    return replace(wall, restitution=number("--restitution", text) if form is None else form)


def _with_records(
    demand: "FacadeDemand",
    motions: "list[Record | BaseMotion]",
    runs: "FacadeRuns",
) -> "FacadeDemand":
    """Return the demand with that of the records where their limit state has none."""
    from rocksteady.facades.checks.record_demand import RecordDemand
    from rocksteady.seismic.spectra.grounds import grounds_of

    key = runs.limit_state.lower()
    if not runs.enough or getattr(demand, key) is not None:
        return demand
    scaled = [
        ground.record.scaled(factor)
        for ground, factor in zip(grounds_of(motions), runs.scale.tolist(), strict=True)
    ]
    # A record is run with and without its vertical one, and counts once.
    demand_of_records = RecordDemand(records=tuple(dict.fromkeys(scaled)))
    return replace(demand, **{key: demand_of_records})


def _refuse_open(check: "FacadeCheck") -> None:
    """Refuse --check where nothing is checked: an exit code 0 would pass for a yes.

    Raises
    ------
    FlagError
        If no check has a verdict, or the runs have none.
    """
    given = {"--check": True}
    if check.runs is not None and check.runs.refusal is not None:
        refuse(given, check.runs.refusal, "add records, or leave out --check")
    if not check.states:
        valid = "neither the file nor records give a demand: no check has a verdict"
        refuse(given, valid, "add [demand.slv] to the file or --records DIR, or leave out --check")


def _in_text(check: "FacadeCheck", *, example: bool) -> "Description":
    """Return what people read: the checks, a row for each record, and the notes of both."""
    description = check.describe()
    words = "An example: the wall is invented and the motions are synthetic."
    tables, notes = [*description.tables], [words] * example + [*description.notes]
    if check.runs is not None:
        tables += check.runs.describe().tables
        notes += check.runs.remarks
    return replace(description, tables=tables, notes=notes)


def _write(
    context: typer.Context,
    check: "FacadeCheck",
    output: OutputFlags,
    out: Path | None,
    read: "tuple[list[Record | BaseMotion], list[Path]]",
    *,
    language: Literal["en", "it"],
) -> None:
    """Write the files that the flags name, with hashes of the motions and files that were read."""
    motions, files = read
    output.write_csv(lambda: check.describe().tables[0])
    if output.plot is not None:
        from rocksteady.facades._figures import facade_figure

        output.write_plot(lambda page: facade_figure(check, language=language, page=page))
    if out is not None:
        from rocksteady.facades.page.facade_folder import write_facade

        command = command_of(["rocksteady", *context.find_root().obj])
        for written in write_facade(
            check,
            out,
            language=language,
            motions=motions,
            command=command,
            files=files,
            force=output.force,
        ):
            announce_file(written)
