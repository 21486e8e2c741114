"""`rocksteady back-analyse`: which shaking agrees with what fell and what stood at one place."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import typer

from rocksteady.cli.console.outputs import again
from rocksteady.cli.console.progress import sweeping
from rocksteady.cli.console.refusals import FlagError, flags_of, missing, refuse
from rocksteady.cli.flags.ensemble import Suite, SuiteFlags, intensity_of
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.options import Panel
from rocksteady.cli.flags.parsing import number
from rocksteady.cli.flags.record_files import ReadingFlags
from rocksteady.cli.flags.shaking_tests import PRIOR, prior_of
from rocksteady.cli.flags.sweep import executor_flag, workers_flag
from rocksteady.errors import InputError
from rocksteady.show.export.files import check_apart

if TYPE_CHECKING:
    from rocksteady.risk.back_analysis.scan import ScanOptions
    from rocksteady.risk.back_analysis.survey import Survey

HELP = (
    "Find the PGA and PGV from what fell and what stood.\n\n"
    "Draws of each object are run under every record at every scale. The region of 90 % is "
    "tried on records that are left out in turn, as the true shaking is in no suite; the temper "
    "of the likelihood and the probability of the region follow from that. Where everything "
    "fell there is a lower bound alone, where nothing fell an upper one at most."
)
MAIN = "survey records prior measure draws limits plot csv example"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady back-analyse --example\n\n"
    "rocksteady back-analyse --survey cemetery.csv --records suite --plot region.png\n\n"
    "rocksteady back-analyse --survey cemetery.csv --records suite --measure sa_g:0.5 "
    "--measure pgv_m_s --prior prior.toml --json\n\n"
    "rocksteady back-analyse --survey cemetery.csv --records suite --limits 0.05:1.5 --draws 32\n\n"
    "Your files: cemetery.csv, a survey; prior.toml, a prior; suite, a folder of records."
)
survey_flag = Panel("Survey")
scan_flag = Panel("Scan")
FLAGS = ("limits", "levels", "draws", "temper", "trials", "seed")
"""Options of a scan that are flags."""


@grouped
def back_analyse(
    context: typer.Context,
    recorded: SuiteFlags,
    reading: ReadingFlags,
    output: OutputFlags,
    survey: Path | None = survey_flag(
        "--survey FILE",
        "Read the objects from a table in CSV: name, width_m, height_m and outcome (fell or "
        "stood), a cell as 0.4, 0.38:0.42 or 0.4+-0.01.",
    ),
    prior: Path | None = survey_flag(*PRIOR),
    measure: list[str] | None = scan_flag(
        "--measure NAME[:S]",
        "Set the measures, two or more flags; the region is in the first two. pga_g and "
        "pgv_m_s by default, sa_g or sa_avg_g with a period \\[s], as sa_g:0.5.",
    ),
    limits: str | None = scan_flag(
        "--limits LOW:HIGH",
        "Set the limits of the first measure; by default from no uplift to nearly all fallen.",
    ),
    levels: int = scan_flag("--levels N", "Set the number of scales of each record.", default=22),
    draws: int | None = scan_flag(
        "--draws N",
        "Set the number of draws of each object at each scale; by default 320 over the number "
        "of objects, 8 to 64.",
    ),
    temper: str = scan_flag(
        "--temper T",
        "Set the exponent of the likelihood, in (0, 1], or auto for the best score on "
        "records that are left out.",
        default="auto",
    ),
    trials: int = scan_flag(
        "--trials N",
        "Set the number of simulated surveys for each record that is left out.",
        default=4,
    ),
    seed: int = scan_flag(
        "--seed N", "Set the seed of the draws and of the simulated surveys.", default=0
    ),
    executor: str = executor_flag(),
    workers: int | None = workers_flag(),
    example: bool = survey_flag(
        "--example",
        "Analyse 12 synthetic objects with 12 synthetic motions: no file is needed.",
        default=False,
    ),
) -> None:
    """Run `rocksteady back-analyse`; `HELP` is what its users read."""
    from rocksteady.sweep.run import Execution

    output.check([path for path in (survey, prior) if path is not None])
    scan = _scan(
        limits=_limits(limits), levels=levels, draws=draws, temper=temper, trials=trials, seed=seed
    )
    measures = ["pga_g", "pgv_m_s"] if measure is None else [intensity_of(each) for each in measure]
    run = Execution(executor=executor, workers=workers)
    if example:
        objects, suite, scan = _example(recorded, reading, survey, scan)
    else:
        objects = _survey(survey)
        suite = recorded.suite(reading)
        check_apart(output.files, read=suite.read)

    from rocksteady.risk.back_analysis.back_analyse import back_analyse as analysed

    pools = len(objects) + sum(facing is not None for facing in objects.facings)
    cells = len(suite.motions) * scan.levels * pools * scan.draws_of(len(objects))
    try:
        with sweeping("running objects", cells) as meter:
            result = analysed(
                objects,
                suite.motions,
                measures=measures,
                prior=prior_of(prior),
                scan=scan,
                run=replace(run, progress=meter),
            )
    except InputError as error:
        flag = {"measures": "--measure", "motions": "--records"}.get(error.name, error.name)
        hint = error.hint.replace(
            "rs.calibration.ScanOptions(temper=0.3, trials=0)", "--temper 0.3 --trials 0"
        )
        raise FlagError(flag, error.value, error.valid, hint) from None
    description = result.describe()
    first, second = (measure.key for measure in result.measures[:2])
    output.write_csv(lambda: ((first, second, "density", "in_region"), result.grid_rows()))
    if output.plot is not None:
        from rocksteady.show.figures.observations import back_analysis_figure

        output.write_plot(lambda page: back_analysis_figure(result, page=page))
    notes = [*description.notes, f"{result.runs:,} runs in {result.seconds:.1f} s"]
    if example:
        notes.insert(0, "Objects and motions are synthetic: nothing was surveyed.")
    output.leave(
        "back-analyse",
        replace(description, notes=notes),
        after={"seconds": result.seconds, "synthetic": example},
        suite=suite,
        follow_up="" if output.plot else again(context, "--plot region.png"),
    )


def _survey(path: Path | None) -> "Survey":
    """Return the survey of the flag."""
    if path is None:
        raise missing(
            "--survey",
            valid="a back-analysis needs objects, each fallen or standing",
            hint="add --example for a synthetic survey, or --survey with your table",
        )
    from rocksteady.risk.back_analysis.read_survey import read_survey

    with flags_of({"survey": "--survey"}):
        return read_survey(path)


def _limits(text: str | None) -> tuple[float, float] | None:
    """Return the two limits of the flag."""
    if text is None:
        return None
    low, colon, high = text.partition(":")
    if not colon:
        raise FlagError("--limits", text, "there are two limits", "write them as 0.05:1.5")
    return number("--limits", low), number("--limits", high)


def _scan(*, temper: str, **options: object) -> "ScanOptions":
    """Return the scan, whose errors name the flags."""
    from rocksteady.risk.back_analysis.scan import ScanOptions

    exponent = _temper(temper)
    with flags_of({name: f"--{name}" for name in FLAGS}):
        return ScanOptions(temper=exponent, **options)  # type: ignore[arg-type]


def _temper(text: str) -> Literal["auto"] | float:
    """Return the temper of a flag: a number, or "auto".

    Raises
    ------
    FlagError
        If it is neither.
    """
    if text == "auto":
        return "auto"
    try:
        return number("--temper", text)
    except InputError:
        raise FlagError(
            "--temper", text, "it must be auto or a number in (0, 1]", "write auto, or 0.3"
        ) from None


def _example(
    recorded: SuiteFlags, reading: ReadingFlags, survey: Path | None, scan: "ScanOptions"
) -> "tuple[Survey, Suite, ScanOptions]":
    """Return a synthetic survey and synthetic motions, after refusing files."""
    given = {**reading.given, **recorded.given, "--survey": survey}
    refuse(given, "--example is synthetic and reads no file", "leave one out")
    from rocksteady.risk.back_analysis.synthetic_survey import make_synthetic_survey

    few = scan if scan.draws is not None else replace(scan, draws=4)
    return make_synthetic_survey(), Suite.synthetic(12), few
