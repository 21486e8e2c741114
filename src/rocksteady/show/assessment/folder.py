"""The folder of an assessment: runs, curves for loss tools, and what is needed to do it again."""

import re
import unicodedata
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocksteady.errors import InputError
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked
from rocksteady.risk.assess.objects_table import ObjectsTable
from rocksteady.show.assessment.object_report import report_html
from rocksteady.show.export.components import LossComponent
from rocksteady.show.export.ensemble_rows import write_runs_csv
from rocksteady.show.export.files import save_csv, save_text
from rocksteady.show.export.folders import ASSESSMENT
from rocksteady.show.export.manifest import make_manifest, write_manifest
from rocksteady.show.export.openquake import write_openquake
from rocksteady.show.export.pelicun import write_pelicun

if TYPE_CHECKING:
    from rocksteady.risk.assess.assessment import Assessment
    from rocksteady.risk.fragility.fragility import Fragility


@checked
def write_assessment(
    assessment: "Assessment | ObjectsTable",
    folder: Path | str,
    *,
    command: str = "",
    files: Sequence[Path] = (),
    force: bool = False,
) -> list[Path]:
    """Write an assessment into a folder: page, runs, curves for loss tools, and its inputs.

    Every file is written whole, in a hidden folder first: what fails leaves all as it was.

    Parameters
    ----------
    assessment
        From `rocksteady.assess_object` or `rocksteady.assess_objects`.
    folder
        New, empty, or with files of an assessment, which `force` replaces.
    command
        Command line that repeats it; default "".
    files
        The files that were read, whose hashes are kept; none by default.
    force
        Replace files of an earlier assessment; default False.

    Returns
    -------
    list of Path
        The report, a table with a row for each run, curves as pelicun and OpenQuake read them, and
        the manifest of the run; without an ensemble report and manifest alone; for a table of
        objects report, rows and manifest.

    Raises
    ------
    OutputError
        If the folder holds anything else, one of the files that were read would be replaced, or it
        cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from rocksteady import assess_object
    >>> from rocksteady.export import write_assessment
    >>> from rocksteady.motions import make_synthetic_suite
    >>> from rocksteady.risk import DescribedObject
    >>> values = {
    ...     "name": "cabinet",
    ...     "friction": 0.1,
    ...     "geometry": {"width_m": 0.4, "height_m": 1.8},
    ...     "demand": {"pga_g": 0.4, "pgv_m_s": 0.4},
    ... }
    >>> assessment = assess_object(DescribedObject(values=values), make_synthetic_suite(2))
    >>> with TemporaryDirectory() as folder:
    ...     [file.name for file in write_assessment(assessment, folder)]
    ['report.html', 'run.json']
    """
    return ASSESSMENT.fill(
        folder,
        lambda stage: _fill(assessment, stage, command, files),
        force=force,
        read=files,
        hashes=[] if isinstance(assessment, ObjectsTable) else [assessment.described.sha256],
    )


def _fill_with_table(table: ObjectsTable, stage: Path, command: str, files: Sequence[Path]) -> None:
    """Write the page, the rows and the manifest of a table of objects into a folder."""
    answer = table.to_dict()
    for name in ("seconds", "objects"):  # the same inputs give the same bytes; the rows have a file
        answer.pop(name)
    manifest = make_manifest(files=files, command=command, settings={"answer": answer})
    rows = table.describe().tables[0]
    save_csv("out", stage / "answers.csv", rows.header, rows.records())
    write_manifest(stage / "run.json", manifest)
    save_text("out", stage / "report.html", report_html(table, manifest))


def _fill(
    assessment: "Assessment | ObjectsTable", stage: Path, command: str, files: Sequence[Path]
) -> None:
    """Write all files into a folder."""
    if isinstance(assessment, ObjectsTable):
        _fill_with_table(assessment, stage, command, files)
        return
    described, fragility = assessment.described, assessment.fragility
    notes: list[str] = []
    if fragility is not None:
        write_runs_csv(stage / "results.csv", fragility.ensemble)
        notes = _write_curves(assessment, fragility, stage)
    answer = assessment.to_dict()
    answer.pop("seconds")  # the same inputs give the same bytes
    settings = {
        "object": {
            "source": described.source,
            "sha256": described.sha256,
            "values": described.values,
        },
        "bands_seed": None if fragility is None else getattr(fragility.fitting.bands, "seed", None),
        "left_out": notes,
        "answer": answer,
    }
    manifest = make_manifest(
        assessment.motions,
        files=files,
        ensemble=None if fragility is None else fragility.ensemble,
        command=command,
        settings=settings,
        warnings=() if fragility is None else fragility.warnings,
    )
    write_manifest(stage / "run.json", manifest)
    save_text("out", stage / "report.html", report_html(assessment, manifest))


def _write_curves(assessment: "Assessment", fragility: "Fragility", stage: Path) -> list[str]:
    """Write the curves that loss tools take; return what was left out and why."""
    described, peaks = assessment.described, assessment.described.given.demand
    latin = unicodedata.normalize("NFKD", described.name).encode("ascii", "ignore").decode()
    plain = re.sub(r"[^A-Za-z0-9_.]+", "_", latin).strip("_.")
    identifier = f"RS.{plain or 'object'}"[:75]
    asked: dict[str, Any] = {
        "floor": peaks.place == "floor",
        "description": assessment.facts.describe().headline,
    }
    try:
        component = LossComponent.from_fragility(fragility, identifier, **asked)
    except InputError as error:
        return [f"No fragility for loss tools: {error}"]
    components = [component]
    write_openquake(stage / "fragility.xml", components)
    if assessment.by_both_peaks is not None and peaks.pga_g and peaks.pgv_m_s:
        asked["pgv_per_pga_s"] = peaks.pgv_m_s / (STANDARD_GRAVITY * peaks.pga_g)
        along = LossComponent.from_fragility(fragility, f"{identifier[:69]}.peaks", **asked)
        # A model of OpenQuake has one list of damage states, and this component has the last alone.
        write_openquake(stage / "fragility_peaks.xml", [along])
        components.append(along)
    write_pelicun(stage / "fragility.csv", components)
    return list(component.left_out)
