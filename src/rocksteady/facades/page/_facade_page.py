"""Page of the checks of a facade, one HTML file for screen and paper, in English or Italian."""

from collections.abc import Mapping
from typing import Any

from rocksteady.facades.checks.facade_check import FacadeCheck
from rocksteady.facades.checks.facade_runs import FacadeRuns
from rocksteady.facades.page._facade_pictures import pictures_of
from rocksteady.facades.page._facade_tables import (
    acting_rows,
    check_row,
    demand_rows,
    facade_rows,
    in_words,
    mechanism_rows,
    motion_rows,
    places,
    remarks_of_checks,
    run_rows,
    sentences_of,
    whole_sentence,
)
from rocksteady.facades.plots.headline import headline_of, verdict_of
from rocksteady.facades.plots.languages import TABLES, Language
from rocksteady.show.export.provenance import provenance
from rocksteady.show.report import render
from rocksteady.show.style.markup import badge
from rocksteady.show.style.wording import cleaned, plain_name

SECTIONS = ("why", "runs", "wall", "mechanism", "demand", "method", "limits", "inputs")
ASSUMED = ("bullets", "t0", "mean", "fc", "block", "balance", "restitution")
NOT_COVERED = ("rigid", "crushing", "sliding", "diaphragm", "ties", "corners", "height")


def facade_html(check: FacadeCheck, manifest: Mapping[str, Any], words: Language) -> str:
    """Return the page of a facade as the text of one HTML file.

    The same check gives the same text: times are left out.

    Parameters
    ----------
    check
        From `rocksteady.check_facade`.
    manifest
        From `rocksteady.export.make_manifest`: versions, command, and the hashes of motions and
        files.
    words
        Language of the page.
    """
    facade = check.facade
    runs = check.runs if isinstance(check.runs, FacadeRuns) else None
    named = places(facade, words)
    made = provenance(manifest)
    sentences = sentences_of(check, words)
    sections = [each for each in SECTIONS if each != "runs" or runs is not None]
    values: dict[str, Any] = {
        "acting": acting_rows(check, words),
        "assumed": [words(f"assumed_{each}", **named) for each in ASSUMED],
        "checks": [check_row(each, words) for each in check.checks],
        "check_remarks": remarks_of_checks(check, words),
        "demand": demand_rows(check, words),
        "facts": facade_rows(check, words),
        "headline": headline_of(check, words) or " ".join(sentences),
        "made": words("inputs_made", **{key: made[key] for key in ("version", "kernels", "numpy")}),
        "mechanism": mechanism_rows(check, words),
        "method": [
            {"name": words[f"method_{k}_name"], "words": words(f"method_{k}", **named)}
            for k in range(1, 5)
        ],
        "motions": motion_rows(manifest, words),
        "name": facade.name,
        "not_covered": [words(f"not_{each}", **named) for each in NOT_COVERED],
        "provenance": made,
        "remarks": _remarks(check, words),
        "running": plain_name(facade.name),
        "runs": [] if runs is None else run_rows(runs, words),
        "runs_intro": "" if runs is None else _runs_intro(runs, words),
        "sections": [(each, words[_section(each, check)]) for each in sections],
        "sentences": sentences if headline_of(check, words) else [],
        "title": words("title", name=facade.name),
        "verdict": badge(**verdict_of(check, words)),
        "w": TABLES[words.code],
    }
    return render(
        __package__, "facade.html.j2", **cleaned(values), pictures=pictures_of(check, words)
    )


def _section(name: str, check: FacadeCheck) -> str:
    """Return the key of the heading of a section."""
    return f"section_{check.facade.kind if name == 'wall' else name}"


def _remarks(check: FacadeCheck, words: Language) -> list[str]:
    """Return why methods disagree, and what a reader must know of the formulas."""
    reasons = [in_words(each, words) for each in check.reasons]
    if not check.states:
        reasons = [words["why_nothing"]]
    elif not reasons:
        reasons = [words["why_agree"]]
    notes = [in_words(each, words) for each in check.remarks]
    if isinstance(check.runs, FacadeRuns) and check.runs.model.name == "linear":
        notes.append(words["mind_linear"])
    return [whole_sentence(each) for each in (*reasons, *notes)]


def _runs_intro(runs: FacadeRuns, words: Language) -> str:
    """Return what was run."""
    key = "runs_intro" if runs.facade.one_sided else "runs_intro_two_sided"
    signs = words[f"signs_{len(runs.directions)}"]
    return words(key, records=len(runs.records), signs=signs, **places(runs.facade, words))
