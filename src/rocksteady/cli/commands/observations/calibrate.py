"""`rocksteady calibrate`: from what fell and what stood to a block that predicts."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from rocksteady.cli.console.outputs import again, announce_file, report_command
from rocksteady.cli.console.progress import sweeping
from rocksteady.cli.console.refusals import flags_of, refuse
from rocksteady.cli.console.shell import command_of
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import named_model
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.shaking_tests import PRIOR, TableFlags, prior_of, test_flag
from rocksteady.cli.flags.sweep import executor_flag, workers_flag
from rocksteady.show.export.folders import CALIBRATION

if TYPE_CHECKING:
    from rocksteady.risk.calibration.calibration import Calibration
    from rocksteady.risk.observations.observations import Observations

HELP = (
    "Fit objects to the shaking tests in which they fell or stood.\n\n"
    "Draws of each object are run under the record of each test, in rounds that close in on the "
    "blocks that explain the outcomes, until 200 effective draws or more agree. Scores are of "
    "tests that are predicted without their group, by block and logistic together and by each "
    "alone, beside the base rate. --out keeps the posterior for `rocksteady predict`, with a "
    "report. Outcomes say most of alpha: height, p and restitution mostly come back as they were "
    "put in."
)
MAIN = "tests objects records prior folds most_runs out plot example"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady calibrate --example --out fit\n\n"
    "rocksteady calibrate --tests tests.csv --records suite --out own\n\n"
    "rocksteady calibrate --tests tests.csv --records suite --prior prior.toml "
    "--folds session --json\n\n"
    "rocksteady calibrate --tests tests.csv --records suite --most-runs 12000 "
    "--csv predictions.csv --plot fit.png\n\n"
    "Your files: tests.csv and objects.csv, tables; prior.toml, a prior; suite, a folder of "
    "records."
)
ARGUMENTS = {
    "folds": "--folds", "model": "--model", "most_runs": "--most-runs", "seed": "--seed"
}  # fmt: skip
"""Flags of arguments of `rocksteady.calibrate`."""
USUAL_RUNS = 6000
"""Default of --most-runs, and the fewest that a next command asks for."""
EXAMPLE_MOTIONS = 8
EXAMPLE_SIZE = (0.15, 0.6)
"""Width and height of the block of --example [m]."""
sampling_flag = options.Panel("Calibration")


@grouped
def calibrate(
    context: typer.Context,
    table: TableFlags,
    output: OutputFlags,
    prior: Path | None = test_flag(*PRIOR),
    model: str = sampling_flag(
        "--model NAME",
        "Choose the equations of motion: nonlinear (the full equations) or linear (slender "
        "blocks, faster, without vertical motion).",
        default="nonlinear",
    ),
    folds: str = sampling_flag(
        "--folds NAME",
        "Hold out together the tests of one record, test, session or group.",
        default="group",
    ),
    most_runs: int = sampling_flag(
        "--most-runs N", "Stop after this number of runs of a test.", default=USUAL_RUNS
    ),
    seed: int = sampling_flag("--seed N", "Set the seed of all draws.", default=0),
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
    # The default of calibrate has a tolerance of its own.
    equations = None if model == "nonlinear" else named_model(model)
    run = Execution(executor=executor, workers=workers)
    tests, known = _tests(table, example=example), prior_of(prior)
    read += table.record_files(tests)
    output.check_folder(CALIBRATION, out, read)

    from rocksteady.risk.calibration.calibrate import calibrate as calibrated

    checks = 3 if model == "linear" else 4  # what `Calibration.flips` counts
    cells = len(tests) * (most_runs + checks)
    with sweeping("running draws", cells) as meter, flags_of(ARGUMENTS):
        calibration = calibrated(
            tests,
            known,
            folds=folds,  # type: ignore[arg-type]  # checked there
            seed=seed,
            most_runs=most_runs,
            model=equations,
            run=replace(run, progress=meter),
        )
        meter.end()
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
        decided=calibration.identified,
        follow_up=_next_command(context, calibration, out),
    )


def _next_command(context: typer.Context, calibration: "Calibration", out: Path | None) -> str:
    """Return the command that opens the report, or makes more runs where they help."""
    if calibration.identified:
        return report_command(context, out)
    if not calibration.more_runs_help:
        return ""
    flags = [
        f"--most-runs {max(2 * calibration.most_runs, USUAL_RUNS)}",
        *(["--force"] if out else []),
    ]
    return again(context, *flags, but=("--most-runs",))


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
