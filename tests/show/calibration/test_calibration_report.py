"""The page of a calibration: every section, the numbers of the result, and no name as markup."""

import json
import re
from dataclasses import replace
from functools import cache
from typing import Any

import pytest

from rocksteady.calibration import Calibration
from rocksteady.results.numbers import number
from rocksteady.show.calibration._calibration_report import calibration_html
from rocksteady.show.calibration._calibration_tables import sentence_of
from rocksteady.show.export.manifest import make_manifest
from tests.every import every
from tests.outputs import unrendered
from tests.show.assessment.pages import Page, check_alone, drawn_once
from tests.show.calibrated import HOSTILE, calibrated, hostile, unscored

SECTIONS = [
    "What to mind",
    "What the tests say of the block",
    "Tests by record",
    "Outcomes that were not expected",
    "Residuals",
    "Learning",
    "Method",
    "What is guaranteed",
    "What is not promised",
    "Inputs",
]


@cache
def page(kind: str) -> str:
    made: dict[str, Calibration] = {
        "usual": calibrated(), "hostile": hostile(), "unscored": unscored()
    }  # fmt: skip
    with unrendered(), drawn_once():  # whose pictures are rendered in a folder
        return calibration_html(made[kind], make_manifest(command="rocksteady calibrate --tests x"))


@pytest.mark.slow
def test_every_section_and_picture_is_there() -> None:
    read = Page(page("usual"))
    headings = [re.sub(r"^\d+", "", text) for level, text in read.headings if level == 2]
    assert headings[1:] == SECTIONS, "the first is that of the contents"
    check_alone(read)
    words = " ".join(each["alt"] for each in read.of("img"))
    (posterior,) = calibrated().posteriors.values()
    # reliability, ladder, learning, residuals by record and by session
    assert len(read.of("img")) == 5 + len(posterior.columns)
    for start in ("Share that fell", "Outcomes over the gain", "alpha_rad of", "Held-out acc"):
        assert start in words


@pytest.mark.slow
def test_numbers_are_those_of_the_result() -> None:
    found, text = calibrated(), Page(page("usual")).text
    scores, new = found.validation.rows, found.new_day
    assert new is not None
    for name in ("accuracy", "f1", "brier", "log_score"):
        for rule in ("predicted", "block", "base rate", "logistic"):
            for rows in (scores, new.rows):
                assert number(getattr(rows[rule], name)[0]) in text
    assert "on a new day" in text
    right = round(scores["predicted"].accuracy[0] * len(found.tests))
    assert f"{right} of {len(found.tests)} outcomes" in text
    alpha = next(each for each in found.parameters if each["parameter"] == "alpha_rad")
    row = (
        f"α [rad]{number(alpha['prior_low'])} to {number(alpha['prior_high'])}"
        f"——{number(alpha['outline'])}not identified"
    )
    assert row in text
    missed = [
        test.name
        for test, p in zip(found.tests.tests, found.validation.predictions.p, strict=True)
        if (p if test.fell else 1.0 - p) < 0.5
    ]
    assert missed
    assert f"{len(missed)} outcome" in text
    assert sum(name in text for name in missed) == min(len(missed), 12)
    for count in found.flips.values():
        assert f": {count}" in text
    assert "abab" in text
    assert "rocksteady calibrate --tests x" in text


@pytest.mark.slow
def test_no_name_is_markup() -> None:
    whole = page("hostile")
    assert "<script>" not in whole
    read = Page(whole)
    check_alone(read)
    assert "\u202e" not in whole
    assert HOSTILE.removesuffix("\u202e") in read.text
    assert r"\u202e" in read.text


@pytest.mark.slow
def test_without_scores_the_page_says_so() -> None:
    read = Page(page("unscored"))
    check_alone(read)
    assert "none of which can be held out" in read.text
    assert "No held-out scores: all tests with an outcome are of one group" in read.text
    headings = [text for level, text in read.headings if level == 2]
    assert not any(name in "".join(headings) for name in ("Residuals", "Learning"))


def test_where_all_outcomes_are_predicted_their_number_is_stated_once() -> None:
    usual = calibrated()
    scores = replace(usual.validation.rows["predicted"], accuracy=(1.0, 1.0, 1.0), tests=8)
    rows = {**usual.validation.rows, "predicted": scores}
    found = replace(usual, validation=replace(usual.validation, rows=rows))
    assert "8 of 8 outcomes came as block and logistic together expect" in sentence_of(found)


@every("promise", ["only alpha is identified", "0.42 g", "finer than the surfaces"])
def test_what_is_not_promised_stands_on_every_page(promise: str) -> None:
    text = Page(page("unscored")).text.replace("α", "alpha")
    assert promise in text


def test_nothing_of_the_page_is_left_to_guess() -> None:
    values: Any = json.loads(json.dumps(calibrated().to_dict(), default=str))
    assert set(values) >= {
        "inputs", "hashes", "seed", "most_runs", "runs", "scores", "new_day", "conflicts",
        "parameters", "effective_draws", "pareto_k", "mc_error", "warnings",
    }  # fmt: skip
