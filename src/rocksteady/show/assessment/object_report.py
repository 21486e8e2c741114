"""Page of an assessment, one HTML file for screen and paper."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from rocksteady.model.checks.arguments import checked
from rocksteady.results.numbers import plural
from rocksteady.risk.assess.assessment import Assessment
from rocksteady.risk.assess.objects_table import ObjectsTable
from rocksteady.show.assessment._assessment_pictures import pictures_of
from rocksteady.show.assessment._assessment_tables import (
    answer_rows,
    case_rows,
    further_rows,
    level_words,
    motion_rows,
    object_rows,
    remedy_rows,
    screen_rows,
    share_rows,
    side_rows,
    summary_rows,
    verdict_words,
)
from rocksteady.show.assessment._objects_page import objects_html
from rocksteady.show.export.files import save_text
from rocksteady.show.export.manifest import make_manifest
from rocksteady.show.export.provenance import provenance
from rocksteady.show.report import render
from rocksteady.show.style.markup import badge
from rocksteady.show.style.wording import BADGES, cleaned, greek, plain_name, sentence, span
from rocksteady.words.assessment import CAVEATS, scope_words


@checked
def write_assessment_page(
    path: Path | str,
    assessment: Assessment | ObjectsTable,
    *,
    command: str = "",
    files: Sequence[Path | str] = (),
) -> Path:
    """Write the page of an assessment, one HTML file that needs no other.

    Parameters
    ----------
    path
        The file, which is replaced.
    assessment
        From `rocksteady.assess_object` or `rocksteady.assess_objects`.
    command
        Command that makes it again; none by default.
    files
        Files that were read, whose hashes stand on the page; none by default.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    InputError
        If a file that was read cannot be read again.
    OutputError
        If the page cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from rocksteady import assess_object
    >>> from rocksteady.motions import make_synthetic_suite
    >>> from rocksteady.risk import DescribedObject
    >>> cabinet = DescribedObject(
    ...     values={
    ...         "name": "cabinet",
    ...         "friction": 0.1,
    ...         "geometry": {"width_m": 0.4, "height_m": 1.8},
    ...         "demand": {"pga_g": 0.4, "pgv_m_s": 0.4},
    ...     }
    ... )
    >>> assessment = assess_object(cabinet, make_synthetic_suite(2, seed=0))
    >>> with TemporaryDirectory() as folder:
    ...     file = write_assessment_page(f"{folder}/report.html", assessment)
    ...     print(file.read_text(encoding="utf-8").count("<h1>"))
    1
    """
    file = Path(path)
    motions = assessment.suite.motions if isinstance(assessment, Assessment) else ()
    manifest = make_manifest(motions, files=files, command=command)
    save_text("path", file, report_html(assessment, manifest))
    return file


def report_html(assessment: Assessment | ObjectsTable, manifest: Mapping[str, Any]) -> str:
    """Return the page of an assessment as the text of one HTML file.

    The same assessment gives the same text: times are left out.

    Parameters
    ----------
    assessment
        From `rocksteady.assess_object` or `rocksteady.assess_objects`.
    manifest
        From `rocksteady.export.make_manifest`: versions, command, and the hashes of motions and
        files.
    """
    if isinstance(assessment, ObjectsTable):
        return objects_html(assessment, manifest)
    fragility, described = assessment.fragility, assessment.described
    values: dict[str, Any] = {
        "answer": answer_rows(assessment),
        "badge": badge(*BADGES[assessment.decision.verdict]),
        "cases": case_rows(assessment),
        "caveats": [greek(each) for each in CAVEATS],
        "facts": object_rows(assessment),
        "further": further_rows(assessment),
        "given": list(_given(described.values)),
        "method": _method(assessment),
        "motions": motion_rows(assessment, manifest),
        "name": described.name,
        "provenance": provenance(manifest, described.source, described.sha256),
        "remedies": remedy_rows(assessment),
        "running": plain_name(described.name),
        "scope": greek(scope_words(assessment)),
        "screens": screen_rows(assessment),
        "shares": [] if fragility is None else share_rows(assessment),
        "sides": side_rows(assessment),
        "sources": " ".join(greek(f"{row.name}: {row.source}.") for row in assessment.screens.rows),
        "summaries": [] if fragility is None else summary_rows(fragility),
        "verdict": verdict_words(assessment),
        "warnings": _warnings(assessment),
        "sentence": greek(assessment.sentence),
    }
    return render(
        __package__, "object.html.j2", **cleaned(values), pictures=pictures_of(assessment)
    )


def _warnings(assessment: Assessment) -> list[str]:
    """Return sentences on what is assumed of the object, and on what limits the runs."""
    notes = assessment.describe().notes
    warnings = [each for each in notes if each not in (*CAVEATS, scope_words(assessment))]
    return [sentence(greek(each)) for each in dict.fromkeys(warnings)]


def _method(assessment: Assessment) -> dict[str, Any]:
    """Return the numbers of the paragraphs on the method; none of what was not run."""
    shaking, fragility = assessment.judged.shaking, assessment.fragility
    runs = assessment.judged.runs if fragility is None else fragility.ensemble
    if runs is None or shaking is None:
        return {}
    ratios = runs["restitution"].values
    spectrum = None if shaking.placing is None else shaking.placing.spectrum
    counted: dict[str, str] = dict.fromkeys(("levels", "measure", "reach", "runs"), "")
    if fragility is not None:
        levels, (label, unit) = fragility.states[-1].curve.levels, level_words(assessment)
        counted = {
            "levels": plural(len(levels), "level"),
            "measure": label,
            "reach": f"{span(float(levels[0]), float(levels[-1]))} {unit}".rstrip(),
            "runs": f"{fragility.runs:,}",
        }
    return counted | {
        "built_in": assessment.suite.built_in,
        "count": plural(len(shaking.motions), "motion"),
        "draws": int(runs.sizes["draw"]),
        "floor": assessment.described.on_floor,
        "kept": sentence(shaking.demand.kept) if shaking.stretched else "",
        "range": "" if spectrum is None else f"from {span(*spectrum.range_s)} s",
        "ratios": span(float(ratios.min()), float(ratios.max())),
        "signs": int(runs.sizes["direction"]) > 1,
        "spectrum": "" if spectrum is None else Path(spectrum.words_of_source).name,
        "stretched": shaking.stretched,
        "rate": assessment.risk is not None,
        "target": assessment.target.words,
        "vertical": shaking.is_lifted,
        "wall": assessment.facts.block.one_sided,
    }


def _given(values: Mapping[str, object], table: str = "") -> Iterator[dict[str, str]]:
    """Yield table, key and value of what the object's file holds."""
    for key, value in values.items():
        if isinstance(value, Mapping) and set(value) != {"low", "high"}:
            yield from _given(value, f"{table}.{key}" if table else str(key))
        else:
            yield {"table": table, "key": str(key), "value": _written(value)}


def _written(value: object) -> str:
    """Return a value of the object's file, every digit of it."""
    if isinstance(value, Mapping):
        return ", ".join(f"{key} {_written(each)}" for key, each in value.items())
    if isinstance(value, list | tuple):
        return ", ".join(_written(each) for each in value)
    return str(value)
