"""`rocksteady screens`: published formulas for one block, side by side."""

from dataclasses import replace

import typer

from rocksteady.cli.console.outputs import INCOMPLETE, NEGATIVE
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags
from rocksteady.cli.flags.demand import PeakFlags, RowFlags, SpectrumFlags, sized_block
from rocksteady.cli.flags.groups import grouped, in_columns
from rocksteady.cli.flags.record_files import ReadingFlags, RecordFlags

HELP = (
    "Apply published formulas to a block.\n\n"
    "Published formulas for uplift, rocking and overturning of a block, side by side: statics, "
    "Shenton's friction, ASCE 43-05, Ishiyama, Kaneko-Hayashi, the Circolare, p PGV/(g tan "
    "alpha) and FEMA P-58's cabinets.\n\n"
    "Each row prints its equation and edition, and implements that equation alone: the engineer "
    "verifies. A row whose input is missing names it. Peaks and spectra may be those of a floor."
)
MAIN = "width_m height_m kind pga_g pgv_m_s friction vertical_g record spectrum check"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady screens --width-m 0.32 --height-m 1.8 --pga-g 0.35 --pgv-m-s 0.4 --friction 0.4\n\n"
    "rocksteady screens --width-m 2 --height-m 5 --kind cask --spectrum floor.txt --damping .05\n\n"
    "rocksteady screens --width-m 0.32 --height-m 1.8 --record example:near-fault --json\n\n"
    "Your file: floor.txt, a response spectrum."
)


@grouped
def screens(
    block: BlockFlags,
    peaks: PeakFlags,
    spectra: SpectrumFlags,
    reading: ReadingFlags,
    output: RowFlags,
    kind: str | None = options.block_flag(
        "--kind KIND",
        "Set the kind of object: cask, cabinet, wall or statue.",
    ),
    check: bool = options.output_flag(
        "--check",
        "Leave with exit code 1 where a row does not pass or the block slides, 3 where no row, or "
        "not that of --kind, has a verdict.",
        default=False,
    ),
) -> None:
    """Run `rocksteady screens`; `HELP` is what its users read."""
    files = output.files
    files.check(spectra.files)
    body = sized_block(block)
    demand = spectra.demand(peaks, reading)
    from rocksteady.risk.screens.screens import screen_block

    screens_found = screen_block(body, demand, friction=peaks.friction, object_kind=kind)  # type: ignore[arg-type]
    rows = [row.values() for row in screens_found.rows]
    files.write_csv(lambda: in_columns(list(rows[0]), rows))
    next_command = ""
    if None not in (peaks.pga_g, peaks.pgv_m_s):
        next_command = options.follow_up("assess", block, peaks)
    elif spectra.record is not None:
        recorded = RecordFlags(record=[spectra.record], pga_g=peaks.pga_g)
        next_command = options.follow_up("simulate", block, recorded, reading)
    described, formula = screens_found.describe(), spectra.formula
    if formula is not None:
        described = replace(described, notes=[*described.notes, formula.remark])
    files.leave("screens", described, follow_up=next_command)
    if check and (screens_found.negative or screens_found.undecided):
        raise typer.Exit(NEGATIVE if screens_found.negative else INCOMPLETE)
