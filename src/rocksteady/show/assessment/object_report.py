"""Page of an assessment, one HTML file for screen and paper."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from rocksteady.model.checks.arguments import checked
from rocksteady.results.numbers import chance, interval, number, plural
from rocksteady.risk.assess.assessment import Assessment
from rocksteady.risk.assess.caveats import CAVEATS
from rocksteady.risk.assess.objects_table import ObjectsTable
from rocksteady.risk.ensemble.gates import which_lift
from rocksteady.risk.fits.two_stages import TwoStageCurve
from rocksteady.show.assessment._assessment_pictures import pictures_of
from rocksteady.show.assessment._assessment_tables import (
    answer_rows,
    case_rows,
    motion_rows,
    object_rows,
    ranking_rows,
    remedy_rows,
    risk_rows,
    screen_rows,
    side_rows,
    state_rows,
    synthetic,
)
from rocksteady.show.assessment._objects_page import objects_html
from rocksteady.show.export.files import save_text
from rocksteady.show.export.manifest import make_manifest
from rocksteady.show.export.provenance import provenance
from rocksteady.show.report import render
from rocksteady.show.style.markup import badge
from rocksteady.show.style.wording import (
    BADGES,
    cleaned,
    greek,
    plain_name,
    sentence,
    span,
)


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
    motions = assessment.motions if isinstance(assessment, Assessment) else ()
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
    fragility = assessment.fragility
    word, look = BADGES[assessment.colour]
    described = assessment.described
    answer = assessment.describe().answer
    assert answer is not None
    sentence_, reason = assessment.sentence, assessment.reason
    if assessment.basis in ("curve", "count"):  # the heading has the number, this what it means
        reason = f"{sentence_} {reason}"
        sentence_ = sentence(sentence_.partition("): ")[2])
    values: dict[str, Any] = {
        "answer": answer_rows(assessment),
        "badge": badge(word if look == "open" else f"chance of falling: {word}", look),
        "cases": case_rows(assessment),
        "caveats": [greek(each) for each in CAVEATS],
        "chance": _chance(assessment),
        "consequence": greek(sentence_),
        "facts": object_rows(assessment),
        "given": list(_given(described.values)),
        "method": _method(assessment),
        "motions": motion_rows(assessment, manifest),
        "probability": chance(assessment.probability),
        "provenance": provenance(manifest, described.source, described.sha256),
        "name": described.name,
        "reason": greek(reason),
        "refused": fragility is None,
        "remedies": remedy_rows(assessment),
        "risks": risk_rows(assessment),
        "risk_notes": _risk_notes(assessment),
        "running": plain_name(described.name),
        "scope": greek(assessment.scope_words),
        "screens": screen_rows(assessment),
        "sides": side_rows(assessment),
        "sources": " ".join(greek(f"{row.name}: {row.source}.") for row in assessment.screens.rows),
        "states": [] if fragility is None else state_rows(fragility),
        "ranking": [] if fragility is None else ranking_rows(fragility),
        "target": chance(described.given.assessment.target_probability),
        "verdict": greek(answer.sentence),
        "warnings": _warnings(assessment),
    }
    return render(
        __package__, "object.html.j2", **cleaned(values), pictures=pictures_of(assessment)
    )


def _chance(assessment: Assessment) -> dict[str, Any]:
    """Return the places on the bar of the probability and its interval; none without one."""
    if assessment.probability is None:
        return {}
    words, band = chance(assessment.probability), assessment.probability_band
    place = 100.0 * assessment.probability
    alt = f"Probability of falling {words} on a scale from 0 to 100 %"
    shown: dict[str, Any] = {"words": words, "place": f"{place:.2f}", "band": ""}
    if band is not None and assessment.fragility and assessment.fragility.fitting.bands:
        confidence = assessment.fragility.fitting.bands.confidence
        low, high = (100.0 * end for end in band)
        shown |= {"low": f"{low:.2f}", "width": f"{high - low:.2f}"}
        shown |= {"middle": f"{0.5 * (low + high):.2f}"}
        shown["band"] = interval(band, confidence).strip(" ()")
        alt += f"; {shown['band']}"
    return shown | {"alt": f"{alt}."}


def _warnings(assessment: Assessment) -> list[str]:
    """Return sentences on what is assumed and what limits the answer."""
    warnings = list(assessment.facts.warnings)
    if assessment.fragility is not None:
        warnings += assessment.fragility.warnings
    made, motions = synthetic(assessment), len(assessment.motions)
    if made and assessment.fragility is not None:
        warnings.append(
            f"{made} of {plural(motions, 'motion')} {'is' if made == 1 else 'are'} synthetic, "
            "made from random numbers and no earthquake's: the answer is an example, not one for a "
            "site."
        )
    return [sentence(greek(each)) for each in dict.fromkeys(warnings)]


def _risk_notes(assessment: Assessment) -> list[str]:
    """Return what is to be known of the risk, each once."""
    notes = [note for risk in assessment.risks for note in risk.describe().notes]
    return [sentence(greek(note)) for note in dict.fromkeys(notes)]


def _method(assessment: Assessment) -> dict[str, Any]:
    """Return the numbers of the paragraphs on the method."""
    fragility = assessment.fragility
    if fragility is None:
        return {}
    runs, bands = fragility.ensemble, fragility.fitting.bands
    levels = runs["level"].values
    ratios = runs["restitution"].values
    return {
        "linear": str(runs.attrs["model"]) == "linear",
        "records": plural(fragility.records, "motion"),
        "levels": plural(len(levels), "level"),
        "reach": span(float(levels.min()), float(levels.max())),
        "measure": greek(str(fragility.measure)),
        "draws": int(runs.sizes["draw"]),
        "ratios": span(float(ratios.min()), float(ratios.max())),
        "scatter": float(runs.attrs["scatter"]),
        "synthetic": synthetic(assessment) > 0,
        "signs": int(runs.sizes["direction"]) > 1,
        "vertical": int(runs.sizes["vertical"]) > 1,
        "runs": f"{fragility.runs:,}",
        "family": fragility.fitting.family,
        "stages": any(isinstance(each.curve, TwoStageCurve) for each in fragility.states),
        "given": which_lift(runs) if any(each.given_uplift for each in fragility.states) else "",
        "band": any(each.curve.median_band is not None for each in fragility.states),
        "confidence": "" if bands is None else number(100.0 * bands.confidence),
        "replicates": "" if bands is None else f"{bands.replicates:,}",
        "seed": "" if bands is None else str(bands.seed),
        "scatter_seed": str(runs.attrs["seed"]),
        "factor": number(fragility.scale_factor_max),
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
