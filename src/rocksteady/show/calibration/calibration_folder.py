"""The folder of a calibration: page, fit, posterior, predictions and parameters."""

import hashlib
import json
from pathlib import Path

from rocksteady.model.checks.arguments import checked
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.risk.calibration.stored import FORM, TABLES, fit_hash, posterior_rows
from rocksteady.show.calibration._calibration_report import calibration_html
from rocksteady.show.export.files import json_text, save_csv, save_text
from rocksteady.show.export.folders import CALIBRATION
from rocksteady.show.export.manifest import make_manifest


@checked
def write_calibration(
    calibration: Calibration, folder: Path | str, *, command: str = "", force: bool = False
) -> list[Path]:
    """Write a calibration into a folder: page, fit, posterior, predictions, parameters.

    Every file is written whole, in a hidden folder first: what fails leaves all as it was.

    Parameters
    ----------
    calibration
        From `rocksteady.calibrate`.
    folder
        New, empty, or with files of a calibration, which `force` replaces.
    command
        Command line that repeats it; default "".
    force
        Replace files of an earlier calibration; default False.

    Returns
    -------
    list of Path
        ``report.html``; ``fit.json`` with scores, parameters and hashes; ``posterior.csv`` with the
        draws that `rocksteady.calibration.read_posterior` reads; ``predictions.csv`` with each
        test predicted without its group; ``parameters.csv``.

    Raises
    ------
    OutputError
        If the folder holds anything else, one of the files that were read would be replaced, or it
        cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from rocksteady import Block, Linear, calibrate
    >>> from rocksteady.calibration import make_synthetic_tests
    >>> from rocksteady.export import write_calibration
    >>> from rocksteady.motions import make_synthetic_suite
    >>> column = Block.rectangle(width=0.15, height=0.6)
    >>> tests = make_synthetic_tests(column, make_synthetic_suite(2), model=Linear())
    >>> calibration = calibrate(tests, most_runs=200, model=Linear())
    >>> with TemporaryDirectory() as folder:
    ...     [file.name for file in write_calibration(calibration, folder)]
    ['fit.json', 'parameters.csv', 'posterior.csv', 'predictions.csv', 'report.html']
    """

    def write(stage: Path) -> None:
        header, rows = posterior_rows(calibration)
        save_csv("out", stage / "posterior.csv", header, rows)
        for name, table in (
            ("predictions", calibration.validation.predictions.describe().tables[0]),
            ("parameters", calibration.describe().tables[0]),
        ):
            save_csv("out", stage / f"{name}.csv", table.header, table.records())
        hashes = {name: hashlib.sha256((stage / name).read_bytes()).hexdigest() for name in TABLES}
        fit = json.loads(json_text(FORM, {**calibration.to_dict(), "files": hashes}))
        text = json.dumps(fit | {"sha256": fit_hash(fit)}, indent=2, ensure_ascii=False)
        save_text("out", stage / "fit.json", text + "\n")
        page = calibration_html(calibration, make_manifest(command=command))
        save_text("out", stage / "report.html", page)

    sources = {**calibration.tests.sources, **calibration.prior.sources}
    return CALIBRATION.fill(folder, write, force=force, hashes=sources.values())
