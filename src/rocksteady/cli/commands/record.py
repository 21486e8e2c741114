"""`rocksteady record`: channels and intensity measures of ground-motion files."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer

from rocksteady.cli.console.outputs import print_json, write_csv, write_figure
from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.parsing import axis
from rocksteady.cli.flags.record_files import ReadingFlags, warn
from rocksteady.cli.present.record_values import (
    Description,
    course_header,
    course_rows,
    print_one,
    print_spectrum,
    print_table,
    record_values,
    title_of,
)
from rocksteady.errors import RecordFileError
from rocksteady.model.blocks.block import Block

if TYPE_CHECKING:
    from rocksteady.records.core.recording import Recording

HELP = (
    "What ground-motion files hold: format, samples, unit and warnings; peaks, "
    "durations and spectra, exact for an acceleration that is linear between its samples.\n\n"
    "A file with several channels is described channel by channel, unless --channel names one. "
    "With a block come the measures that its size makes dimensionless."
)
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady record RSN77_PUL164.AT2 --plot pacoima.png\n\n"
    "rocksteady record *.AT2 --json\n\n"
    "rocksteady record column.txt --units m/s^2 --dt-s 0.005 --csv record.csv --units-out g\n\n"
    "rocksteady record RSN77_PUL164.AT2 --width-m 0.5 --height-m 2"
)

FilesArgument = Annotated[
    list[Path], typer.Argument(metavar="FILE", help="Ground-motion files.", show_default=False)
]
PeriodsFlag = Annotated[
    str | None,
    typer.Option(
        "--periods-s",
        metavar="AXIS",
        help="Periods of the response spectrum \\[s], as 0.1:4:40 or log:0.05:10:100; it is "
        "printed, for one record, and in --json. --plot has log:0.02:10:200 by default.",
        rich_help_panel=options.OUTPUT,
    ),
]
DampingFlag = Annotated[
    float,
    typer.Option(
        "--damping",
        metavar="ZETA",
        help="Damping of its oscillators, 1 being critical.",
        rich_help_panel=options.OUTPUT,
    ),
]
UnitsOutFlag = Annotated[
    str | None,
    typer.Option(
        "--units-out",
        metavar="UNIT",
        help="Unit of the accelerations of --csv: m/s^2 (default), g, cm/s^2, gal, ...",
        rich_help_panel=options.OUTPUT,
    ),
]

PLOTTED_PERIODS = "log:0.02:10:200"


@grouped
def record(
    files: FilesArgument,
    reading: ReadingFlags,
    block: BlockFlags,
    output: OutputFlags,
    periods_s: PeriodsFlag = None,
    damping: DampingFlag = 0.05,
    units_out: UnitsOutFlag = None,
) -> None:
    """Run `rocksteady record`; `HELP` is what its users read."""
    output.check()
    output.refuse_read(files)
    body = sized(block)
    unit = unit_of(units_out, output)
    periods = None if periods_s is None else axis("--periods-s", periods_s)
    from rocksteady.seismic.measures.intensity import measure_intensity
    from rocksteady.seismic.measures.response_spectrum import compute_response_spectrum
    from rocksteady.seismic.measures.time_course import integrate_record

    wanted = periods
    if output.plot is not None and periods is None:
        wanted = axis("--periods-s", PLOTTED_PERIODS)
    recordings = all_recordings(files, reading)
    if output.csv is not None and len(recordings) > 1:
        refuse_several(output.csv, len(recordings))
    found: list[Description] = []
    for one in recordings:
        described = Description(
            recording=one,
            course=integrate_record(one.record),
            measures=measure_intensity(one.record, body, damping=damping),
            spectrum=compute_response_spectrum(one.record, wanted, damping=damping)
            if wanted
            else None,
        )
        if described.measures.drifts:
            warn(one.path, described.warnings[-1])
        found.append(described)
    if output.csv is not None:
        write_csv(output.csv, course_header(unit), course_rows(found[0].course, unit))
    if output.plot is not None:
        from rocksteady.show.figures.single import record_figure

        courses = [one.course for one in found]
        spectra = [one.spectrum for one in found if one.spectrum is not None]
        write_figure(output.plot, record_figure(courses, spectra, title_of(found), output.page))
    if output.as_json:
        rows = [record_values(one, spectrum=periods is not None) for one in found]
        print_json("record", rows[0] if len(rows) == 1 else {"records": rows})
    elif len(found) == 1:
        print_one(found[0])
        if periods is not None and found[0].spectrum is not None:
            print_spectrum(found[0].spectrum)
    else:
        print_table(found)


def all_recordings(files: list[Path], reading: ReadingFlags) -> "list[Recording]":
    """Return the channels of all files; every file that cannot be read is said in a line.

    Raises
    ------
    InputError
        If there is one.
    """
    found: list[Recording] = []
    wrong: list[RecordFileError] = []
    for file in files:
        try:
            found += reading.recordings(file)
        except RecordFileError as error:
            wrong.append(error)
    for earlier in wrong[:-1]:
        print(f"rocksteady: {earlier}", file=sys.stderr)
    if wrong:
        raise wrong[-1]
    return found


def sized(block: BlockFlags) -> Block | None:
    """Return the block that the flags describe; None where there are none.

    Raises
    ------
    InputError, ModelError
        As for `BlockFlags.described`; and if a restitution alone is given.
    """
    if not block.given:
        return None
    body = block.described()
    if isinstance(body, Block):
        return body
    raise FlagError(
        "restitution",
        block.restitution,
        "no measure of a record depends on it",
        "describe a block by its size, or leave it out",
    )


def unit_of(units_out: str | None, output: OutputFlags) -> str:
    """Return the name of the unit of --csv.

    Raises
    ------
    InputError
        If it is none of acceleration.
    ModelError
        If there is one and no --csv.
    """
    from rocksteady.records.core.units import unit_named

    if units_out is None:
        return "m/s^2"
    if output.csv is None:
        raise FlagError(
            "--units-out",
            units_out,
            "without --csv it has no meaning",
            "add --csv record.csv, or leave it out",
        )
    return unit_named(units_out, "--units-out")


def refuse_several(file: Path, count: int) -> NoReturn:
    """Refuse to write several records into one file.

    Raises
    ------
    ModelError
        Always.
    """
    raise FlagError(
        "--csv",
        file,
        f"it holds one record, and there are {count}",
        "give one file, and --channel where that has several",
    )
