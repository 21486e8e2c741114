"""`rocksteady predict`: the probability of falling in tests or records, from a calibration."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from rocksteady.cli.console.refusals import FlagError, both, flags_of, missing, refuse
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.options import Panel
from rocksteady.cli.flags.record_files import FLOOR_FLAGS, ReadingFlags, RecordFlags, cleaning_of
from rocksteady.cli.flags.shaking_tests import TableFlags, objects_flag, records_flag, tests_flag
from rocksteady.cli.flags.sweep import executor_flag, workers_flag
from rocksteady.errors import InputError
from rocksteady.show.export.files import check_apart

if TYPE_CHECKING:
    from rocksteady.risk.calibration.stored_posterior import StoredPosterior
    from rocksteady.risk.observations.shaking_test import ShakingTest

HELP = (
    "Predict shaking tests from a calibration.\n\n"
    "Predict the probability that a calibrated object falls, with its 90 % interval.\n\n"
    "--fit names the folder that `rocksteady calibrate --out` wrote. --tests takes a table "
    "whose outcomes may be empty; --record takes ground-motion files, at each factor of "
    "--scale. The records of the calibration are not needed. The folder's predictions.csv has "
    "the tests of the calibration, each predicted without its own group."
)
MAIN = "fit record scale tests objects records object plot csv"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady predict --fit fit --record example:near-fault --scale 0.5,1,2 "
    "--plot quake.png\n\n"
    "rocksteady predict --fit fit --record example:firm-ground --record example:soft-soil "
    "--json\n\n"
    "rocksteady predict --fit fit --tests next.csv --records suite --csv predictions.csv\n\n"
    "Your files: fit, a folder of calibrate; next.csv and objects.csv, tables; suite, a folder of "
    "records."
)
fit_flag = Panel("Calibration")


@grouped
def predict(
    recorded: RecordFlags,
    reading: ReadingFlags,
    output: OutputFlags,
    fit: Path | None = fit_flag(
        "--fit DIR", "Take the posterior of this folder, which calibrate --out wrote."
    ),
    object: str | None = fit_flag(  # noqa: A002 -- the name of its flag
        "--object NAME",
        "Choose the object that --record shakes; default the only one of the calibration.",
    ),
    tests: Path | None = tests_flag(),
    objects: Path | None = objects_flag(),
    records: Path | None = records_flag(),
    executor: str = executor_flag(),
    workers: int | None = workers_flag(),
) -> None:
    """Run `rocksteady predict`; `HELP` is what its users read."""
    from rocksteady.sweep.run import Execution

    output.check(recorded.files)
    if fit is None:
        raise missing(
            "--fit",
            valid="predictions come from a calibration",
            hint="add --fit DIR, the folder of rocksteady calibrate --out DIR",
        )
    run = Execution(executor=executor, workers=workers)
    table = TableFlags(
        tests=tests,
        objects=objects,
        records=records,
        units=reading.units,
        dt_s=reading.dt_s,
        column=reading.column,
        resample=reading.resample,
        baseline=reading.baseline,
        filter=reading.filter,
        trim=reading.trim,
    )
    _refuse_idle(table, recorded, reading, object)
    from rocksteady.risk.calibration.stored import FILES, read_posterior

    check_apart(output.files, read=[*table.files, *(fit / name for name in FILES)])

    with flags_of({"folder": "--fit"}):
        stored = read_posterior(fit)
    if tests is not None:
        observed = table.observations()
        check_apart(output.files, read=table.record_files(observed))
        shaken: Sequence[ShakingTest] = observed.tests
        remarks = observed.remarks
    else:
        shaken = _tests_of(recorded, reading, _object(stored, object))
        remarks = list(filter(None, [cleaning_of(reading).remark]))
    with flags_of({"tests": "--tests"}):
        predictions = stored.predict(shaken, run=run)
    predictions = replace(predictions, warnings=(*predictions.warnings, *remarks))
    description = predictions.describe()
    output.write_csv(lambda: description.tables[0])
    if output.plot is not None:
        from rocksteady.show.figures.observations import predictions_figure

        output.write_plot(lambda page: predictions_figure(predictions, page=page))
    output.leave(
        "predict",
        description,
        after={"model": stored.model.name},
        decided=predictions.identified,
    )


def _refuse_idle(
    table: TableFlags, recorded: RecordFlags, reading: ReadingFlags, body: str | None
) -> None:
    """Refuse flags that have no meaning beside each other.

    Raises
    ------
    FlagError
        If neither tests nor records are given, or both, or a flag of one beside the other.
    """
    if table.tests is None and not recorded.record:
        raise missing(
            "--tests or --record",
            valid="a prediction is of tests or of records",
            hint="add --record example:near-fault, or --tests with your table",
        )
    if table.tests is not None and recorded.record:
        raise both("--tests", "--record", valid="a prediction is of one of the two")
    if table.tests is not None:
        idle = {
            "--object": body,
            "--scale": recorded.scale,
            "--pga-g": recorded.pga_g,
            "--vertical": recorded.vertical,
            "--reverse": recorded.reverse,
            **{k: v for k, v in reading.given.items() if k in ("--channel", *FLOOR_FLAGS.values())},
        }
        refuse(idle, "the table of --tests states it", "write it into the table")
        of_files = {"--format": reading.format, "--ignore-header": reading.ignore_header}
        refuse(of_files, "each file of --tests is read by what it states")
    else:
        idle = {"--objects": table.objects, "--records": table.records}
        refuse(idle, "without --tests it has no meaning")


def _object(stored: "StoredPosterior", name: str | None) -> str:
    """Return the object that is shaken.

    Raises
    ------
    FlagError
        If there is none of that name, or it is not clear which one is meant.
    """
    names = list(stored.posteriors)
    if name is None and len(names) > 1:
        raise missing(
            "--object",
            valid=f"the calibration has {len(names)} objects, {', '.join(names[:6])}",
            hint=f"add --object {names[0]}",
        )
    if name is not None and name not in names:
        raise FlagError(
            "--object", name, "the calibration has " + ", ".join(names[:6]), "name one of them"
        )
    return names[0] if name is None else name


def _tests_of(recorded: RecordFlags, reading: ReadingFlags, body: str) -> "list[ShakingTest]":
    """Return a test of an object for each record and factor.

    Raises
    ------
    InputError, FlagError
        If a file cannot be read, or a factor is not valid.
    """
    from rocksteady.risk.observations.shaking_test import ShakingTest

    tests: list[ShakingTest] = []
    for recording in recorded.recordings(reading):
        level = recorded.at_pga(recording)
        vertical = recorded.vertical_recording(reading, recording)
        name = recording.record.name or recording.path.stem
        for scale in recorded.scales:
            words = name if scale == 1.0 else f"{name} x {scale:.4g}"
            taken = sum(test.name.partition(" #")[0] == words for test in tests)
            tests.append(
                ShakingTest(
                    name=f"{words} #{taken + 1}" if taken else words,
                    record=level.record,
                    object=body,
                    gain=scale,
                    vertical=None if vertical is None else vertical.record,
                    reversed=recorded.reverse,
                    group=name,
                )
            )
    if not tests:
        raise InputError("--record", "", "it names no record", "give a file")
    return tests
