"""`rocksteady calibrate`: from what fell and what stood to a block that predicts."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from rocksteady.cli.console.outputs import (
    again,
    announce_file,
    report_command,
)
from rocksteady.cli.console.progress import sweeping
from rocksteady.cli.console.refusals import FlagError, flags_of, refuse
from rocksteady.cli.console.shell import command_of
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import named_model
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.shaking_tests import (
    PRIOR,
    SamplingFlags,
    TableFlags,
    prior_of,
    sampling_flag,
    test_flag,
)
from rocksteady.cli.flags.sweep import executor_flag, workers_flag
from rocksteady.show.export.folders import CALIBRATION

if TYPE_CHECKING:
    from rocksteady.risk.calibration.calibration import Calibration
    from rocksteady.risk.observations.observations import Observations

HELP = (
    "Fit objects to the shaking tests in which they fell or stood.\n\n"
    "Draws of each object are run under the record of each test at gains about its own, and "
    "weighted by how well they explain the outcomes. Scores are of tests that are predicted "
    "without their group, beside the base rate and a logistic on intensity measures. --out "
    "keeps the posterior for `rocksteady predict`, with a report. Outcomes identify alpha "
    "alone: height, p and restitution come back about as they were put in."
)
MAIN = "tests objects records prior draws gains out plot example"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady calibrate --example --out fit\n\n"
    "rocksteady calibrate --tests tests.csv --records suite --out own\n\n"
    "rocksteady calibrate --tests tests.csv --records suite --prior prior.toml "
    "--folds session --draws 3000 --json\n\n"
    "rocksteady calibrate --tests tests.csv --records suite --temper 1 --csv predictions.csv "
    "--plot fit.png\n\n"
    "Your files: tests.csv and objects.csv, tables; prior.toml, a prior; suite, a folder of "
    "records."
)
ARGUMENTS = {"folds": "--folds", "model": "--model", "temper": "--temper"}
"""Flags of arguments of `rocksteady.calibrate`."""
_WHEN = {"auto": None, "yes": True, "no": False}
USUAL_DRAWS = 3000
"""Draws to go on with where there are too few effective ones."""
EXAMPLE_MOTIONS = 8
EXAMPLE_SIZE = (0.15, 0.6)
"""Width and height of the block of --example [m]."""


@grouped
def calibrate(
    context: typer.Context,
    table: TableFlags,
    sampled: SamplingFlags,
    output: OutputFlags,
    prior: Path | None = test_flag(*PRIOR),
    model: str = sampling_flag(
        "--model NAME",
        "Choose the equations of motion: nonlinear (the full equations) or linear (slender "
        "blocks, faster, without vertical motion).",
        default="nonlinear",
    ),
    recalibrate: str = sampling_flag(
        "--recalibrate WHEN",
        "Mend held-out predictions by a line over their log odds, fitted without the group: auto "
        "(where it helps), yes or no.",
        default="auto",
    ),
    executor: str = executor_flag(),
    workers: int | None = workers_flag(),
    out: Path | None = options.output_flag(
        "--out DIR",
        "Write report.html, fit.json, posterior.csv, predictions.csv and parameters.csv into "
        "a new folder; --force replaces those of an earlier calibration.",
    ),
    example: bool = test_flag(
        "--example",
        "Calibrate by synthetic tests of a known block: no file is needed.",
        default=False,
    ),
) -> None:
    """Run `rocksteady calibrate`; `HELP` is what its users read."""
    from rocksteady.sweep.run import Execution

    read = [*table.files, *([] if prior is None else [prior])]
    output.check(read, out=out)
    output.check_folder(CALIBRATION, out, read)
    if example:
        valid = "--example has synthetic tests and reads no file"
        refuse({**table.given, "--prior": prior}, valid, "leave one out")
    sampling, exponent, folds = sampled.sampling(), sampled.exponent, sampled.folds
    # The default of calibrate has a tolerance of its own.
    equations = None if model == "nonlinear" else named_model(model)
    run = Execution(executor=executor, workers=workers)
    if recalibrate not in _WHEN:
        valid = f"it must be one of {', '.join(_WHEN)}"
        raise FlagError("--recalibrate", recalibrate, valid, "leave it out for auto")
    tests, known = _tests(table, example=example), prior_of(prior)
    read += table.record_files(tests)
    output.check_folder(CALIBRATION, out, read)

    from rocksteady.risk.calibration.calibrate import calibrate as calibrated

    checks = 3 if model == "linear" else 4  # what `Calibration.flips` counts
    cells = len(tests) * (sampling.draws * sampling.gains + checks)
    with sweeping("running draws", cells) as meter, flags_of(ARGUMENTS):
        calibration = calibrated(
            tests,
            known,
            sampling=sampling,
            folds=folds,
            temper=exponent,
            recalibrate=_WHEN[recalibrate],
            model=equations,
            run=replace(run, progress=meter),
        )
    _write(context, calibration, out, output)
    description = calibration.describe()
    notes = list(description.notes)
    if example:
        notes.insert(0, "The tests are synthetic: no object was shaken.")
    if out is not None:
        notes.append(f"Pictures, method, guarantees and inputs stand in {out / 'report.html'}.")
    output.leave(
        "calibrate",
        replace(description, notes=notes),
        after={"synthetic": example},
        follow_up=_next_command(context, calibration, out),
    )


def _next_command(context: typer.Context, calibration: "Calibration", out: Path | None) -> str:
    """Return the command of more draws where there are too few, else that of the report."""
    few = min(calibration.posteriors.values(), key=lambda each: each.effective_draws)
    if few.identified:
        return report_command(context, out)
    flags = [f"--draws {max(USUAL_DRAWS, 2 * len(few.values))}", *(["--force"] if out else [])]
    return again(context, *flags, but=("--draws",))


def _tests(table: TableFlags, *, example: bool) -> "Observations":
    """Return the tests of the table, or synthetic ones; remarks are printed beside the result."""
    if example:
        from rocksteady.model.blocks.block import Block
        from rocksteady.model.motions.synthetic_suite import make_synthetic_suite
        from rocksteady.risk.observations.synthetic_tests import make_synthetic_tests

        width, height = EXAMPLE_SIZE
        column = Block.rectangle(width=width, height=height)
        return make_synthetic_tests(column, make_synthetic_suite(EXAMPLE_MOTIONS))
    return table.observations()


def _write(
    context: typer.Context, calibration: "Calibration", out: Path | None, output: OutputFlags
) -> None:
    """Write the folder and the files that the flags name."""
    if out is not None:
        from rocksteady.show.calibration.calibration_folder import write_calibration

        command = command_of(["rocksteady", *context.find_root().obj])
        for file in write_calibration(calibration, out, command=command, force=output.force):
            announce_file(file)
    output.write_csv(lambda: calibration.validation.predictions.describe().tables[0])
    if output.plot is not None:
        from rocksteady.show.figures.observations import calibration_figure

        output.write_plot(lambda page: calibration_figure(calibration, page=page))
