"""The folder of an assessment: page, runs, counted shares, and what is needed to do it again."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rocksteady.model.checks.arguments import checked
from rocksteady.risk.assess.objects_table import ObjectsTable
from rocksteady.risk.counted.count import without_mirrors
from rocksteady.show.assessment._loss_files import write_loss_files
from rocksteady.show.assessment.object_report import report_html
from rocksteady.show.export.ensemble_rows import write_runs_csv
from rocksteady.show.export.files import save_csv, save_text
from rocksteady.show.export.folders import ASSESSMENT
from rocksteady.show.export.manifest import make_manifest, write_manifest

if TYPE_CHECKING:
    import xarray

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
    lognormal: bool = False,
) -> list[Path]:
    """Write an assessment into a folder: page, runs, counted shares, and its inputs.

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
    lognormal
        Write lognormals into the files for loss models, where they are within 10 points of the
        counted shares; default False: the shares.

    Returns
    -------
    list of Path
        The report, a table with a row for each run, one with the counted share of each damage state
        at each level, the shares as pelicun and OpenQuake read them, and the manifest; of an object
        without a share report and manifest alone; of a table of objects report, rows, manifest and
        the shares of each kind, where those were counted.

    Raises
    ------
    InputError
        If a lognormal is further from the counted shares.
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
        lambda stage: _fill(assessment, stage, command, files, lognormal=lognormal),
        force=force,
        read=files,
        hashes=[] if isinstance(assessment, ObjectsTable) else [assessment.described.sha256],
    )


def _fill_with_table(
    table: ObjectsTable, stage: Path, command: str, files: Sequence[Path], *, lognormal: bool
) -> None:
    """Write the files of a table of objects into a folder."""
    answer = table.to_dict()
    for name in ("seconds", "objects"):  # the same inputs give the same bytes; the rows have a file
        answer.pop(name)
    left_out = write_loss_files(table, stage, lognormal=lognormal)
    settings = {"answer": answer, "no_loss_component": left_out}
    rows = table.describe().tables[0]
    save_csv("out", stage / "answers.csv", rows.header, rows.records())
    if shares := _share_rows(_named(table)):
        save_csv("out", stage / "shares.csv", *shares)
    manifest = make_manifest(files=files, command=command, settings=settings)
    write_manifest(stage / "run.json", manifest)
    save_text("out", stage / "report.html", report_html(table, manifest))


def _named(table: ObjectsTable) -> "list[tuple[str, Fragility]]":
    """Return name and shares of the kinds of objects that have them, the worst first."""
    curves = table.curves
    return [(row["name"], curves[row["like"]]) for row, _ in table.kinds if row["like"] in curves]


def _share_rows(
    curves: "Sequence[tuple[str, Fragility]]",
) -> tuple[list[str], list[list[object]]] | None:
    """Return header and rows of counted shares, with the name where there are several."""
    rows = [
        {"object": name, **row} if len(curves) > 1 else row
        for name, fragility in curves
        for each in fragility.states
        for row in each.rows
    ]
    return (list(rows[0]), [list(row.values()) for row in rows]) if rows else None


def _fill(
    assessment: "Assessment | ObjectsTable",
    stage: Path,
    command: str,
    files: Sequence[Path],
    *,
    lognormal: bool,
) -> None:
    """Write all files into a folder."""
    if isinstance(assessment, ObjectsTable):
        _fill_with_table(assessment, stage, command, files, lognormal=lognormal)
        return
    described, fragility = assessment.described, assessment.fragility
    if fragility is not None:
        write_runs_csv(
            stage / "results.csv", _of_records(without_mirrors(fragility.ensemble), assessment)
        )
        if shares := _share_rows([(described.name, fragility)]):
            save_csv("out", stage / "shares.csv", *shares)
    left_out = write_loss_files(assessment, stage, lognormal=lognormal)
    answer = assessment.to_dict()
    answer.pop("seconds")  # the same inputs give the same bytes
    given = {"source": described.source, "sha256": described.sha256, "values": described.values}
    manifest = make_manifest(
        assessment.suite.motions,
        files=files,
        ensemble=None if fragility is None else fragility.ensemble,
        command=command,
        settings={"object": given, "answer": answer, "no_loss_component": left_out},
        warnings=() if fragility is None else fragility.warnings,
    )
    write_manifest(stage / "run.json", manifest)
    save_text("out", stage / "report.html", report_html(assessment, manifest))


def _of_records(runs: "xarray.Dataset", assessment: "Assessment") -> "xarray.Dataset":
    """Return runs with the factors of the motions as they were recorded."""
    shaking = assessment.judged.shaking
    assert shaking is not None
    if not shaking.stretched:
        return runs
    known = runs.assign_coords(
        own_scale=("record", shaking.scales), stretch=("record", shaking.stretches)
    )
    return known.assign_coords(scale=known["scale"] * known["own_scale"])
