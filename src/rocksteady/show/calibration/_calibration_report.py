"""Page of a calibration, one HTML file for screen and paper."""

from collections.abc import Mapping
from typing import Any

from rocksteady.results.numbers import number, plural
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.show.calibration._calibration_pictures import MOST_PICTURES, pictures_of
from rocksteady.show.calibration._calibration_tables import (
    MOST_ROWS,
    parameter_rows,
    score_rows,
    sentence_of,
    session_rows,
    unexpected_rows,
    verdict_words,
)
from rocksteady.show.calibration._promises import GUARANTEES, NOT_PROMISED
from rocksteady.show.export.provenance import provenance
from rocksteady.show.plots.observations.ladders import MOST
from rocksteady.show.report import render
from rocksteady.show.style.wording import cleaned, greek, plain_name, sentence

LONGEST_TABLE = 30
"""Rows of residuals on the page; all are in the pictures or in the predictions."""


def calibration_html(calibration: Calibration, manifest: Mapping[str, Any]) -> str:
    """Return the page of a calibration as the text of one HTML file.

    The same calibration gives the same text: times are left out.

    Parameters
    ----------
    calibration
        From `rocksteady.calibrate`.
    manifest
        From `rocksteady.export.make_manifest`: versions and command.
    """
    tests = calibration.tests.tests
    unexpected = unexpected_rows(calibration)
    names = list(calibration.posteriors)
    heading = names[0] if len(names) == 1 else plural(len(names), "object")
    values: dict[str, Any] = {
        "answer": greek(calibration.describe().sentence),
        "guarantees": GUARANTEES,
        "heading_words": heading,
        "method": _method(calibration),
        "not_promised": NOT_PROMISED,
        "new_day": calibration.new_day is not None and bool(calibration.new_day.rows),
        "parameters": parameter_rows(calibration),
        "provenance": _provenance(calibration, manifest),
        "records_left_out": max(
            0, len({(test.group, test.object) for test in tests}) - MOST * MOST_PICTURES
        ),
        "remarks": [sentence(greek(each)) for each in calibration.tests.remarks],
        "running": plain_name(heading),
        "scores": score_rows(calibration),
        "sentence": sentence_of(calibration),
        "sessions": session_rows(calibration)[:LONGEST_TABLE],
        "several": len(names) > 1,
        "unexpected": unexpected[:MOST_ROWS],
        "unexpected_all": len(unexpected),
        "verdicts": verdict_words(calibration),
        "warnings": [
            sentence(greek(each))
            for each in calibration.warnings
            if each not in calibration.tests.remarks  # stated among the inputs
        ],
    }
    return render(
        __package__,
        "calibration.html.j2",
        **cleaned(values),
        pictures=pictures_of(calibration),
    )


def _method(calibration: Calibration) -> dict[str, Any]:
    """Return the numbers of the paragraphs on the method."""
    tests = calibration.tests.tests
    fell = sum(test.fell is True for test in tests)
    stood = sum(test.fell is False for test in tests)
    fits, posteriors = calibration.fits, calibration.posteriors.values()
    return {
        "counts": f"{plural(len(tests), 'test')}: {fell} fell, {stood} stood",
        "records": plural(len({id(test.record) for test in tests}), "record"),
        "groups": plural(len({test.group for test in tests}), "group"),
        "draws": plural(max(len(each.weights) for each in posteriors), "draw"),
        "rounds": plural(max(len(each.rounds) for each in fits), "round"),
        "runs": f"{max(calibration.runs.values()):,}",
        "effective": f"{min(each.effective_draws for each in posteriors):.0f}",
        "error": number(float(calibration.mc_error), 2),
        "seed": str(calibration.seed),
        "flips": [f"{name}: {count:,}" for name, count in calibration.flips.items()],
        "folds": calibration.folds,
    }


def _provenance(calibration: Calibration, manifest: Mapping[str, Any]) -> dict[str, Any]:
    """Return command, versions, and the hashes of all files that were read."""
    made = provenance(manifest)
    sources = {**calibration.prior.sources, **calibration.tests.sources}
    files = [{"name": name, "sha256": digest} for name, digest in sources.items()]
    return {**made, "files": [*made["files"], *files]}
