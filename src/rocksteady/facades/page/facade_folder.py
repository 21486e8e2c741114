"""The folder of a facade: page, checks, runs, and its inputs."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rocksteady.facades.checks.facade_runs import FacadeRuns
from rocksteady.facades.page._facade_page import facade_html
from rocksteady.facades.page.files import FACADE
from rocksteady.facades.plots.languages import Language, language_of
from rocksteady.model.checks.arguments import checked
from rocksteady.show.export.files import json_text, save_csv, save_text, schema_of
from rocksteady.show.export.manifest import make_manifest, write_manifest

if TYPE_CHECKING:
    from rocksteady.facades.checks.facade_check import FacadeCheck
    from rocksteady.model.motions.base_motion import BaseMotion
    from rocksteady.model.motions.record import Record
    from rocksteady.results.description import Table


@checked
def write_facade(
    check: "FacadeCheck",
    out: Path | str,
    *,
    language: str = "en",
    motions: "Sequence[Record | BaseMotion] | None" = None,
    command: str = "",
    files: Sequence[Path | str] = (),
    force: bool = False,
) -> list[Path]:
    """Write the checks of a facade into a folder: page, tables, numbers, and its inputs.

    Every file is written whole, in a hidden folder first: what fails leaves all as it was.

    Parameters
    ----------
    check
        From `rocksteady.check_facade`.
    out
        New, empty, or with files of a facade, which `force` replaces.
    language
        Language of the page and its pictures: "en" (default) or "it".  Tables and JSON have points
        and English names in either.
    motions
        Records that were run, whose hashes are kept; none by default.
    command
        Command line that repeats it; default "".
    files
        The files that were read, whose hashes are kept; none by default.
    force
        Replace files of an earlier check; default False.

    Returns
    -------
    list of Path
        ``report.html``; ``checks.csv`` with a row for each check; ``runs.csv`` with a row for each
        run under records, if there are any; ``facade.json`` with all numbers; ``run.json`` with
        what went in.

    Raises
    ------
    InputError
        If there is no such language, or a file that was read cannot be read again.
    OutputError
        If the folder holds anything else, one of the files that were read would be replaced, or it
        cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from rocksteady import check_facade
    >>> from rocksteady.codes import Facade
    >>> from rocksteady.export import write_facade
    >>> wall = Facade(name="front", thickness_m=0.3, height_m=3.0)
    >>> with TemporaryDirectory() as folder:
    ...     [file.name for file in write_facade(check_facade(wall), folder, language="it")]
    ['checks.csv', 'facade.json', 'report.html', 'run.json']
    """
    words = language_of(language)
    manifest = make_manifest(
        motions, files=files, command=command, settings={"language": words.code}
    )

    def write(stage: Path) -> None:
        _fill(check, stage, manifest, words)

    return FACADE.fill(out, write, force=force, read=files)


def _fill(check: "FacadeCheck", stage: Path, manifest: dict[str, object], words: Language) -> None:
    """Write all files into a folder."""
    _save_rows(stage / "checks.csv", check.describe().tables[0])
    if isinstance(check.runs, FacadeRuns):
        _save_rows(stage / "runs.csv", check.runs.describe().tables[0])
    text = json_text(schema_of("facade"), check.to_dict(), indent=2)
    save_text("out", stage / "facade.json", f"{text}\n")
    write_manifest(stage / "run.json", manifest)
    save_text("out", stage / "report.html", facade_html(check, manifest, words))


def _save_rows(file: Path, table: "Table") -> None:
    """Save the rows of a table."""
    save_csv("out", file, table.header, table.records())
