"""`rocksteady assess`: from an object to an answer."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rocksteady.cli.console.outputs import NEGATIVE, announce_file, report_command
from rocksteady.cli.console.progress import sweeping
from rocksteady.cli.console.refusals import FlagError, missing, refuse, require
from rocksteady.cli.console.shell import command_of
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags
from rocksteady.cli.flags.demand import PeakFlags, RowFlags, demand_flag, probability, sized_block
from rocksteady.cli.flags.ensemble import Suite, SuiteFlags
from rocksteady.cli.flags.groups import grouped
from rocksteady.cli.flags.record_files import ReadingFlags
from rocksteady.cli.flags.sweep import RunsFlags
from rocksteady.errors import InputError
from rocksteady.show.export.folders import ASSESSMENT

if TYPE_CHECKING:
    from rocksteady.results.description import Description
    from rocksteady.risk.assess.assessment import Assessment
    from rocksteady.risk.assess.described.building import Building
    from rocksteady.risk.assess.described.objects import DescribedObject
    from rocksteady.risk.assess.objects_table import ObjectsTable
    from rocksteady.risk.assess.two_numbers import FormulaAssessment
    from rocksteady.risk.hazard.hazard_curve import HazardCurve

HELP = (
    "Estimate the probability that an object falls.\n\n"
    "Probability that an object falls, with a sentence and the reason.\n\n"
    "FILE is an object in TOML (docs/guides/objects.md): it is run on the motions of --records, "
    "with published formulas, sensitivity, risk and remedies beside; --out keeps all in a "
    "folder. A FILE that ends in .csv is a table of objects, each with a probability, a colour "
    "and a sentence, at --pga-g and --pgv-m-s. --example needs no file.\n\n"
    "Without FILE a block, a peak acceleration and a peak velocity give a probability by a "
    "closed form fitted to published runs. Where friction lets the object slide there is no "
    "probability of falling by rocking."
)
MAIN = "file records pga_g pgv_m_s width_m height_m friction target out example"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady assess --width-m 0.32 --height-m 1.8 --pga-g 0.35 --pgv-m-s 0.4\n\n"
    "rocksteady assess statue.toml --records suite --hazard site.csv --out answer\n\n"
    "rocksteady assess objects.csv --records suite --pga-g 0.35 --pgv-m-s 0.4 --csv answers.csv"
    "\n\nrocksteady assess --example --out example\n\n"
    "Your files: statue.toml, an object; objects.csv, a table of objects; site.csv, a hazard "
    "curve; suite, a folder of records."
)
USUAL_TARGET = 0.1
MEANT = ("--hazard", "--out", "--runs", "--resume", "--workers")
"""Flags that have a meaning beside --example."""
EXAMPLE_MOTIONS = 24
file_flag = options.Panel("Object files")


@grouped
def assess(
    context: typer.Context,
    block: BlockFlags,
    peaks: PeakFlags,
    recorded: SuiteFlags,
    reading: ReadingFlags,
    kept: RunsFlags,
    output: RowFlags,
    file: Annotated[
        Path | None,
        typer.Argument(metavar="FILE", help="An object in TOML, or a table of objects in CSV."),
    ] = None,
    buildings: Path | None = file_flag(
        "--buildings FILE",
        "Read the buildings of objects that state a floor: periods or modes, storeys and rooms. "
        "Motions and demand are then those of the ground.",
    ),
    hazard: Path | None = file_flag(
        "--hazard FILE",
        "Read hazard curves of the site, as OpenQuake writes them or in two columns, and "
        "compute the annual rate of falling.",
    ),
    out: Path | None = file_flag(
        "--out DIR",
        "Write the report, runs, fragility for pelicun and OpenQuake, and inputs with their "
        "hashes into a new folder; for a table its report and rows. --force replaces those of "
        "an earlier assessment.",
    ),
    example: bool = file_flag(
        "--example",
        "Assess a made-up object with synthetic motions: no file is needed.",
        default=False,
    ),
    check: bool = options.output_flag(
        "--check",
        "Leave with exit code 1 where an object does not meet the target, or slides.",
        default=False,
    ),
    target: float | None = demand_flag(
        "--target P",
        f"Set the largest probability of falling that --check accepts; default "
        f"{USUAL_TARGET}, or that of FILE.",
    ),
) -> None:
    """Run `rocksteady assess`; `HELP` is what its users read."""
    kept.sweep.check(output.files, [each for each in (file, hazard) if each is not None], out=out)
    most = None if target is None else probability("--target", target)
    table = file is not None and file.suffix.lower() == ".csv"
    _refuse_idle(block, peaks, recorded, reading, kept, file, hazard, out, example=example)
    if file is None:
        refuse({"--buildings": buildings}, "it belongs to objects of a FILE", "leave it out")
    if buildings is not None:
        floor = {"--floor-hz": reading.floor_hz}
        refuse(floor, "--buildings has the floor of each object", "leave one of the two out")
    answer: FormulaAssessment | Assessment | ObjectsTable
    suite = None
    if file is None and not example:
        answer = quick_answer(block, peaks)
        share = answer.probability
        met = share is not None and share <= (USUAL_TARGET if most is None else most)
    elif table:
        assert file is not None
        with kept.sweep.resumable(context.find_root().obj):
            answer, suite = _answers(
                context, file, peaks, recorded, reading, kept, buildings, out, most, output=output
            )
        met = answer.meets_target
    else:
        with kept.sweep.resumable(context.find_root().obj):
            answer, suite = _answer(
                context, file, recorded, reading, kept, buildings, hazard, out, most, output=output
            )
        met = answer.meets_target
    description = answer.describe()
    output.files.write_csv(lambda: description.tables[0] if table else _one_row(description))
    notes = _notes(description.notes, out, example=example)
    output.files.leave(
        "assess",
        replace(description, notes=notes),
        after={"synthetic": example},
        suite=suite,
        follow_up=_next_command(context, block, peaks, out, quick=file is None and not example),
    )
    if check and not met:
        raise typer.Exit(NEGATIVE)


def _next_command(
    context: typer.Context, block: BlockFlags, peaks: PeakFlags, out: Path | None, *, quick: bool
) -> str:
    """Return the command that opens the report, writes it, or applies published formulas."""
    if quick:
        return options.follow_up("screens", block, peaks)
    return report_command(context, out)


def quick_answer(block: BlockFlags, peaks: PeakFlags) -> "FormulaAssessment":
    """Return the answer from two numbers.

    Raises
    ------
    InputError, FlagError
        If the block or a peak is missing or not valid.
    """
    demand = peaks.pga_g is not None or peaks.pgv_m_s is not None
    require(
        "assess",
        {"block": block.given, "demand": demand},
        "--width-m 0.6 --height-m 2 --pga-g 0.35 --pgv-m-s 0.4",
        "--example",
    )
    body = sized_block(block)
    pga_g, pgv_m_s = peaks.both_peaks()
    from rocksteady.risk.assess.two_numbers import assess_by_formula

    return assess_by_formula(body, pga_g, pgv_m_s, peaks.friction, **peaks.vertical)


def _notes(notes: Sequence[str], out: Path | None, *, example: bool) -> list[str]:
    """Return the notes of an answer; its caveats stand in the report where one is written."""
    from rocksteady.risk.assess.caveats import CAVEATS

    synthetic = ["The motions are synthetic: no earthquake made them."] if example else []
    if out is None:
        return [*synthetic, *notes]
    kept = [note for note in notes if note not in CAVEATS]
    return [*synthetic, *kept, f"Caveats, motions and inputs stand in {out / 'report.html'}."]


def _answer(
    context: typer.Context,
    file: Path | None,
    recorded: SuiteFlags,
    reading: ReadingFlags,
    kept: RunsFlags,
    buildings: Path | None,
    hazard: Path | None,
    out: Path | None,
    target: float | None,
    *,
    output: RowFlags,
) -> "tuple[Assessment, Suite]":
    """Return the whole assessment of one object with its motions, and write its folder.

    Raises
    ------
    InputError, OutputError, FlagError
        If a file cannot be read, the folder cannot be filled, or a motion is missing.
    """
    from rocksteady.risk.assess.assessment import assess_object
    from rocksteady.risk.assess.described.objects import EXAMPLE, read_object
    from rocksteady.risk.assess.placed_objects import place_objects

    output.files.check_folder(ASSESSMENT, out)
    run = kept.sweep.run(force=output.force)
    described = read_object(EXAMPLE if file is None else file)
    if target is not None:
        described = described.with_target(target)
    curves = _hazard_curves(hazard)
    suite = _suite(file, recorded, reading, described)
    read = [each for each in (file, buildings, hazard, *suite.read) if each is not None]
    output.files.check_folder(ASSESSMENT, out, read)
    known = _buildings(buildings)
    cells = place_objects([described], suite.motions, known).cells
    with sweeping("running the object", cells) as meter:
        assessment = assess_object(
            described,
            suite.motions,
            buildings=known,
            hazard=curves,
            run=replace(run, progress=meter),
        )
    if out is not None:
        files = [each for each in (file, buildings, hazard, *suite.files) if each is not None]
        _write_folder(context, assessment, out, files, force=output.force)
    return assessment, suite


def _answers(
    context: typer.Context,
    file: Path,
    peaks: PeakFlags,
    recorded: SuiteFlags,
    reading: ReadingFlags,
    kept: RunsFlags,
    buildings: Path | None,
    out: Path | None,
    target: float | None,
    *,
    output: RowFlags,
) -> "tuple[ObjectsTable, Suite]":
    """Return the answers of a table of objects with the motions, and write its folder.

    Raises
    ------
    InputError, FlagError
        If a file cannot be read, or neither peak is given.
    """
    from rocksteady.risk.assess.described.tables import read_objects
    from rocksteady.risk.assess.objects_table import assess_placed
    from rocksteady.risk.assess.placed_objects import place_objects, with_demand

    output.files.check_folder(ASSESSMENT, out)
    run = kept.sweep.run(force=output.force)
    objects = read_objects(file)
    stated = all(each.demand.pga_g or each.demand.pgv_m_s for each in objects)
    if peaks.pga_g is None and peaks.pgv_m_s is None and not stated:
        raise missing(
            "--pgv-m-s",
            valid="objects that state no peak of their own are assessed under one demand",
            hint="add --pgv-m-s 0.4, and --pga-g 0.35 where it is known",
        )
    suite = recorded.suite(reading)
    beside = [file] if buildings is None else [file, buildings]
    output.files.check_folder(ASSESSMENT, out, [*beside, *suite.read])
    asked = [with_demand(each, peaks.pga_g, peaks.pgv_m_s) for each in objects]
    placed = place_objects(asked, suite.motions, _buildings(buildings))
    with sweeping("running objects", placed.cells) as meter:
        table = assess_placed(
            placed,
            (peaks.pga_g, peaks.pgv_m_s),
            USUAL_TARGET if target is None else target,
            run=replace(run, progress=meter),
        )
    if out is not None:
        _write_folder(context, table, out, [*beside, *suite.files], force=output.force)
    return table, suite


def _write_folder(
    context: typer.Context,
    result: "Assessment | ObjectsTable",
    out: Path,
    files: Sequence[Path],
    *,
    force: bool,
) -> None:
    """Write the folder of an answer, and name its files."""
    from rocksteady.show.assessment.folder import write_assessment

    command = command_of(["rocksteady", *context.find_root().obj])
    for written in write_assessment(result, out, command=command, files=files, force=force):
        announce_file(written)


def _suite(
    file: Path | None, recorded: SuiteFlags, reading: ReadingFlags, described: "DescribedObject"
) -> Suite:
    """Return the motions: of --records, of the folder that the file names, or synthetic ones."""
    if file is None:
        return Suite.synthetic(EXAMPLE_MOTIONS)
    named = described.given.assessment.records
    if recorded.records is None and named is not None:
        recorded = replace(recorded, records=[file.parent / named])
    return recorded.suite(reading)


def _buildings(file: Path | None) -> "Sequence[Building]":
    """Return the buildings of --buildings."""
    if file is None:
        return ()
    from rocksteady.risk.assess.described.building import read_buildings

    return read_buildings(file)


def _hazard_curves(hazard: Path | None) -> "Sequence[HazardCurve] | None":
    """Return the curves of --hazard."""
    if hazard is None:
        return None
    from rocksteady.risk.hazard.read_hazard import read_hazard_curves

    try:
        return read_hazard_curves(hazard)
    except InputError as error:
        hint = error.hint.partition(", or give measure=")[0]  # there is no such flag
        raise InputError("--hazard", error.value, error.valid, hint) from None


def _refuse_idle(
    block: BlockFlags,
    peaks: PeakFlags,
    recorded: SuiteFlags,
    reading: ReadingFlags,
    kept: RunsFlags,
    file: Path | None,
    hazard: Path | None,
    out: Path | None,
    *,
    example: bool,
) -> None:
    """Refuse flags that have no meaning beside what is assessed.

    Raises
    ------
    FlagError
        With the flag and what to do.
    """
    if example and file is not None:
        raise FlagError("--example", True, f"{file} is assessed already", "leave one of them out")
    sizes = {f"--{name.replace('_', '-')}": value for name, value in vars(block).items()}
    given = {
        **sizes,
        "--friction": peaks.friction,
        "--pga-g": peaks.pga_g,
        "--pgv-m-s": peaks.pgv_m_s,
        **peaks.vertical_flags,
        **recorded.given,
        "--hazard": hazard,
        "--out": out,
        "--runs": kept.runs,
        "--resume": kept.resume,
        "--workers": kept.workers,
        **reading.given,
    }
    columns = [*sizes, "--friction", *peaks.vertical_flags]
    flags = [*columns, "--pga-g", "--pgv-m-s"]
    if file is None and not example:
        idle = [flag for flag in given if flag not in flags]
        reason = "a block and two peaks need no motions"
        hint = "name an object FILE, or leave it out"
    elif file is not None and file.suffix.lower() == ".csv":
        idle = [*columns, "--hazard"]
        reason = "a table of objects does not take it"
        hint = "leave it out; sizes, friction and vertical motion are columns of the table"
    else:
        idle = [flag for flag in given if flag not in MEANT] if example else flags
        reason = "the object's file states it" if not example else "--example reads no files"
        hint = "write it into the file, or leave it out" if not example else "leave it out"
    refuse({flag: given[flag] for flag in idle}, reason, hint)


def _one_row(description: "Description") -> "tuple[list[str], list[list[object]]]":
    """Return the plain facts as a table of one row."""
    facts = {fact.key: fact.value for fact in description.facts if fact.key}
    row = {key: each for key, each in facts.items() if not isinstance(each, list | dict)}
    return list(row), [list(row.values())]
