"""`rocksteady restitution`: restitution from the peaks of measured free rocking."""

from pathlib import Path

from rocksteady.cli.console.refusals import flags_of, missing, refuse
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags, named_model
from rocksteady.cli.flags.demand import sized_block
from rocksteady.cli.flags.groups import OutputFlags, grouped, in_columns
from rocksteady.results.numbers import number

HELP = (
    "Fit the restitution to the peaks of measured free rocking.\n\n"
    "Housner's value stands beside it. The scatter from impact to impact is separated from the "
    "measuring error.\n\n"
    "--peaks names a CSV table with a column peak_rad, peak_deg or peak_mrad and a line for "
    "each half cycle; further columns: sigma_rad (measuring error), test (several releases), "
    "side (+ or -) and t_s (time, for a check of the block's size)."
)
MAIN = "peaks width_m height_m each_side model plot csv"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady restitution --peaks peaks.csv --width-m 0.05 --height-m 0.5\n\n"
    "rocksteady restitution --peaks peaks.csv --alpha-rad 0.1 --p-rad-s 5.4 --plot decay.png\n\n"
    "rocksteady restitution --peaks peaks.csv --left-m 0.15 --right-m 0.25 --height-m 1.2 "
    "--each-side --json\n\n"
    "Your file: peaks.csv, a table of peaks."
)
peaks_flag = options.Panel("Peaks")


@grouped
def restitution(
    block: BlockFlags,
    output: OutputFlags,
    peaks: Path | None = peaks_flag(
        "--peaks FILE", "Read the peaks of half cycles from a CSV table."
    ),
    each_side: bool | None = peaks_flag(
        "--each-side/--one-factor",
        "Fit a factor of Housner's value to each side, or one to both; by default to each "
        "where the sides differ.",
    ),
    model: str | None = options.model(),
) -> None:
    """Run `rocksteady restitution`; `HELP` is what its users read."""
    output.check([] if peaks is None else [peaks])
    if peaks is None:
        raise missing(
            "--peaks",
            valid="a restitution follows from the peaks of measured half cycles",
            hint="add --peaks FILE, a table with a column peak_rad",
        )
    sought = "the restitution is what this command finds"
    refuse({"--restitution/-r": block.restitution}, sought)
    if block.one_sided:
        raise block.refuse_sides(
            "the peaks are those of a block that rocks to both sides",
            "leave the flag out: between equal sides both lose alike, and the peaks are the same",
        )
    body = sized_block(block)
    from rocksteady.risk.free_rocking.fit_restitution import fit_restitution
    from rocksteady.risk.observations.read_peaks import read_peaks

    equations = None if model is None else named_model(model, None)
    with flags_of({"peaks": "--peaks", "peaks_rad": "--peaks"}):
        releases = read_peaks(peaks)
        fit = fit_restitution(releases, body, each_side=each_side, model=equations)
    description = fit.describe()
    output.write_csv(lambda: in_columns(list(vars(fit.impacts[0])), map(vars, fit.impacts)))
    if output.plot is not None:
        from rocksteady.show.figures.observations import restitution_figure

        output.write_plot(lambda page: restitution_figure(fit, description.headline, page))
    after = {"block": body.describe().to_dict(), "file": str(peaks)}
    measured = fit.measured
    ratios = dict.fromkeys((measured.positive.restitution, measured.negative.restitution))
    flag = "-r " + ",".join(number(ratio, 4) for ratio in ratios)
    follow_up = options.follow_up("simulate", block, flag, "--start 0.8,0")
    output.leave("restitution", description, after=after, follow_up=follow_up)
