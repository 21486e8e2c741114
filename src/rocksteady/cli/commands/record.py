"""`rocksteady record`: channels and intensity measures of ground-motion files."""

import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn

import typer

from rocksteady.cli.console.refusals import FlagError, needs, require
from rocksteady.cli.console.shell import quoted
from rocksteady.cli.console.titles import turned_text
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.parsing import axis, values_of
from rocksteady.cli.flags.record_files import ReadingFlags, warn
from rocksteady.errors import RecordFileError
from rocksteady.model.blocks.block import Block
from rocksteady.results.description import Column, Description, Fact, Table, left_out, line
from rocksteady.results.numbers import number, plural, quantity
from rocksteady.results.rendering import printable
from rocksteady.show.style.palette import shortened

if TYPE_CHECKING:
    from rocksteady.records.core.recording import LeftOut, Recording
    from rocksteady.seismic.measures.intensity import Measures
    from rocksteady.seismic.measures.response_spectrum import ResponseSpectrum
    from rocksteady.seismic.measures.time_course import IntegratedRecord

HELP = (
    "Read ground-motion files: peaks, durations, spectra, faults.\n\n"
    "What ground-motion files hold: format, samples, unit and warnings; peaks, durations and "
    "spectra, exact for an acceleration that is linear between its samples.\n\n"
    "A file with several channels is described channel by channel, unless --channel names one. "
    "With a block, the dimensionless measures of its size are added."
)
MAIN = "files channel units dt_s baseline width_m height_m damping plot csv"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady record example:near-fault --plot near-fault.png\n\n"
    "rocksteady record example:near-fault example:firm-ground example:soft-soil --json\n\n"
    "rocksteady record column.txt --units m/s^2 --dt-s 0.005 --csv record.csv --units-out gal\n\n"
    "rocksteady record example:near-fault --width-m 0.5 --height-m 2\n\n"
    "Your file: column.txt, accelerations alone."
)


LONGEST = 74
"""Characters of a command that follows, whose files have no flags to break it before."""
MOST_ANSWERED = 5
"""Records of an answer."""
DIRECTIONS = {"horizontal": "", "vertical": "vertical", "unknown": "its direction is not stated"}
PLACES = {"surface": "", "unknown": "", "borehole": "below ground", "structure": "in a structure"}
PLOTTED_PERIODS = "log:0.02:10:200"


@grouped
def record(
    files: Annotated[
        list[Path] | None,
        typer.Argument(metavar="FILE", help="Read these ground-motion files.", show_default=False),
    ] = None,
    *,
    reading: ReadingFlags,
    block: BlockFlags,
    output: OutputFlags,
    periods_s: str | None = options.output_flag(
        "--periods-s AXIS",
        "Compute the response spectrum at these periods \\[s], as 0.2,1 or log:0.05:10:100; "
        "printed for one record, and in --json; default of --plot log:0.02:10:200.",
    ),
    damping: float = options.output_flag(
        "--damping ZETA",
        "Set the damping of its oscillators, 1 being critical; default 0.05.",
        default=0.05,
    ),
    units_out: str | None = options.output_flag(
        "--units-out UNIT",
        "Set the unit of the accelerations of --csv: g, cm/s^2, gal, ...; default g.",
    ),
) -> None:
    """Run `rocksteady record`; `HELP` is what its users read."""
    require("record", {"file": files}, "example:near-fault")
    assert files is not None
    output.check(files)
    body = sized(block)
    unit = unit_of(units_out, output)
    periods = None if periods_s is None else values_of("--periods-s", periods_s)
    from rocksteady.seismic.measures.intensity import compute_measures
    from rocksteady.seismic.measures.response_spectrum import compute_response_spectrum
    from rocksteady.seismic.measures.time_course import integrate_record
    from rocksteady.show.figures.single import record_figure

    wanted = periods
    if output.plot is not None and periods is None:
        wanted = axis("--periods-s", PLOTTED_PERIODS)
    recordings = all_recordings(files, reading)
    if output.csv is not None and len(recordings) > 1:
        refuse_several(output.csv, len(recordings))
    courses = [integrate_record(each.record) for each in recordings]
    measures = [compute_measures(each.record, body, damping=damping) for each in recordings]
    spectra = [
        compute_response_spectrum(each.record, wanted, damping=damping)
        for each in recordings
        if wanted
    ]
    for each, measured in zip(recordings, measures, strict=True):
        if measured.warning is not None:
            warn(each.path, measured.warning)
    output.write_csv(lambda: (course_header(unit), course_rows(courses[0], unit)))
    output.write_plot(lambda page: record_figure(courses, spectra, title_of(recordings), page))
    printed = spectra if periods is not None else []
    shown = [[spectrum] for spectrum in printed] or [[] for _ in recordings]
    rows = [record_values(*results) for results in zip(recordings, measures, shown, strict=True)]
    if len(rows) == 1:
        answer = described(recordings[0], measures[0], printed)
        sized_as = block if block.given else "--width-m 0.5 --height-m 2"
        follow_up = options.follow_up(f"simulate --record {quoted(files[0])}", reading, sized_as)
        if measures[0].drifts and reading.baseline == ReadingFlags.baseline:
            mended = replace(reading, baseline="linear")
            follow_up = options.follow_up(f"record {quoted(files[0])}", mended)
        output.leave("record", answer, values=rows[0], follow_up=follow_up)
    else:
        names = " ".join(map(quoted, files))
        more = options.follow_up(f"record {names}", reading, block, "--more")
        more = more if len(more) < LONGEST else ""
        answer = table_of(recordings, measures)
        output.leave("record", answer, values={"records": rows}, follow_up=more)


def record_values(
    recording: "Recording", measures: "Measures", spectra: "Sequence[ResponseSpectrum]"
) -> dict[str, Any]:
    """Return the JSON object of a channel: what its file states, its measures and its spectrum."""
    stated = recording.to_dict()
    values = stated | measures.to_dict()
    if measures.warning is not None:
        values["warnings"] = [*stated["warnings"], measures.warning]
    for spectrum in spectra:
        values["spectrum"] = spectrum.to_dict()
    return values


def described(
    recording: "Recording", measures: "Measures", spectra: "Sequence[ResponseSpectrum]"
) -> Description:
    """Return the description of a channel with its measures, and with its spectrum."""
    first, second = recording.describe(), measures.describe()
    samples = next(fact.words for fact in first.facts if fact.key == "npts")
    channel = channel_words(recording)
    station = f"{recording.title}: {channel}" if channel else recording.title
    screen = [fact for fact in second.facts if fact.first]
    return Description(
        headline=first.headline,
        facts=[
            line("warnings", "; ".join(recording.warnings)),
            line("station", station),
            *screen[:2],
            line("samples", samples),
            *first.facts,
            Fact("", channel, "channel" * bool(channel)),
            *(fact for fact in second.facts if not fact.first),
        ],
        tables=[table for spectrum in spectra for table in spectrum.describe().tables],
        notes=[*first.notes, *second.notes],
        sentence=second.sentence,
    )


def channel_words(recording: "Recording") -> str:
    """Return where a channel points and stands, unless it is a horizontal one on the ground."""
    words = [DIRECTIONS[recording.orientation], PLACES[recording.position]]
    words += [f"beside {each.kind}" for each in recording.left_out]
    return ", ".join(dict.fromkeys(filter(None, words)))


def suite_fact(recordings: "Sequence[Recording]") -> Fact:
    """Return the fact that counts the channels that a suite takes, where it does not take all."""
    from rocksteady.records.suite import select, suite_words

    taken: list[Recording] = []
    left: list[LeftOut] = []
    for _, channels in groupby(recordings, key=lambda each: each.path):
        across, others = select(tuple(channels))
        taken += across
        left += others
    return line("in a suite", suite_words(taken, left) if left else "")


def table_of(recordings: "Sequence[Recording]", measures: "Sequence[Measures]") -> Description:
    """Return a table with a row for each channel."""
    rows = [
        {
            "name": each.name,
            "samples": len(each.record.acceleration_m_s2),
            "dt_s": each.record.dt_s,
            **measured.to_dict(),
        }
        for each, measured in zip(recordings, measures, strict=True)
    ]
    columns = [
        Column("name", "record", lambda name: shortened(printable(name), 30), left=True),
        Column("samples", "samples"),
        Column("dt_s", "dt s", lambda value: f"{value:g}"),
        Column("pga_g", "PGA g"),
        Column("pgv_m_s", "PGV m/s"),
        Column("arias_m_s", "Arias m/s"),
        Column("significant_5_95_s", "D5-95 s"),
    ]
    strongest = sorted(measures, key=lambda each: -each.pga_g)
    ends = dict.fromkeys(number(each.pga_g) for each in (strongest[-1], strongest[0]))
    drifting = sum(each.drifts for each in measures)
    return Description(
        headline=plural(len(rows), "record"),
        facts=[
            suite_fact(recordings),
            line("drift", f"{drifting} of {len(rows)} records drift" * (drifting > 0)),
            left_out(max(len(rows) - MOST_ANSWERED, 0), "weaker"),
        ],
        tables=[Table("", rows, columns, most=len(rows))],
        sentence=f"{plural(len(rows), 'record')} peak at {' to '.join(ends)} g.",
        rows=[
            (
                shortened(printable(each.record.name or "record"), 30),
                f"{each.peaks_text}; strong part {quantity(each.significant_5_95_s, 's')}",
            )
            for each in strongest[:MOST_ANSWERED]
        ],
    )


def title_of(recordings: "Sequence[Recording]") -> str:
    """Return what a figure shows in a few words."""
    if len(recordings) > 1:
        return plural(len(recordings), "record")
    turned = turned_text(recordings[0].processing)
    return shortened(recordings[0].title, 110 - len(turned)) + turned


def course_header(unit: str) -> list[str]:
    """Return the columns of a record, its acceleration in a unit."""
    from rocksteady.model.units import with_unit

    return ["time_s", with_unit("acceleration", unit), "velocity_m_s", "displacement_m"]


def course_rows(course: "IntegratedRecord", unit: str) -> Iterator[list[float]]:
    """Yield a record sample by sample, its acceleration in a unit."""
    from rocksteady.records.core.units import UNITS

    columns = (
        course.t_s,
        course.acceleration_m_s2 / UNITS[unit],
        course.velocity_m_s,
        course.displacement_m,
    )
    for row in zip(*columns, strict=True):
        yield [float(value) for value in row]


def all_recordings(files: list[Path], reading: ReadingFlags) -> "list[Recording]":
    """Return the channels of all files; a file that cannot be read has an error line.

    Raises
    ------
    InputError
        If there is one.
    """
    recordings: list[Recording] = []
    wrong: list[RecordFileError] = []
    for file in files:
        try:
            recordings += reading.recordings(file)
        except RecordFileError as error:
            wrong.append(error)
    for earlier in wrong[:-1]:
        print(f"rocksteady: {earlier}", file=sys.stderr)
    if wrong:
        raise wrong[-1]
    return recordings


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
        If the unit is no unit of acceleration.
    ModelError
        If there is one and no --csv.
    """
    from rocksteady.records.core.units import unit_named

    if units_out is None:
        return "g"
    needs("--units-out", units_out, "--csv", "record.csv", beside=output.csv)
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
