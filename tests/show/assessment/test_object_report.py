"""The page of an assessment: its figures, its sections, and that it needs and runs nothing."""

import base64
import math
import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rocksteady.errors import OutputError
from rocksteady.kernels.nonlinear.drive import Drive, acceleration
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.synthetic_suite import make_synthetic_suite
from rocksteady.results.numbers import chance, interval, number
from rocksteady.risk.assess.assessment import Assessment, assess_object
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.show.assessment._assessment_pictures import tornado_rows
from rocksteady.show.assessment._assessment_tables import answer_rows
from rocksteady.show.assessment.object_report import report_html, write_assessment_page
from rocksteady.show.export.manifest import make_manifest
from tests.every import every
from tests.outputs import unrendered
from tests.show.assessment.pages import Page, check_alone, drawn_once

HOSTILE = "<script>alert('1')</script> & \u202eevil \"q\" $\\frac{x}$ {{ 7*7 }} </style>\\"
SUITE = make_synthetic_suite(12)
COMMAND = "rocksteady assess statue.toml --records <DIR> --out \"OUT\" && echo '$x$'"
ALL = {
    "Why, and what to mind", "The object", "Motions", "Method", "Fragility",
    "Efficiency of measures", "Published formulas, side by side", "Sensitivity", "Remedies", "Risk",
    "What the answer depends on", "Inputs",
}  # fmt: skip


def statue(name: str = "statue", **keys: Any) -> DescribedObject:
    values: dict[str, Any] = {
        "name": name,
        "friction": 0.5,
        "geometry": {"width_m": 0.34, "height_m": 1.8, "mass_kg": 200.0},
        "demand": {"pga_g": 0.4, "pgv_m_s": 0.45},
        "assessment": {"draws": 2, "levels": 6, "replicates": 100},
    }
    return DescribedObject(values=values | keys)


def page_of(assessment: Assessment, command: str = COMMAND) -> str:
    """Return the page with empty pictures, for tests of words."""
    with unrendered(), drawn_once():
        return whole(assessment, command)


def whole(assessment: Assessment, command: str = COMMAND) -> str:
    """Return the page with its pictures for dark screens and phones."""
    return report_html(assessment, make_manifest(assessment.motions, command=command))


@pytest.fixture(scope="module", name="found")
def _found() -> Assessment:
    levels, rates = np.array([0.01, 1.0, 10.0]), np.array([1.0, 1e-3, 1e-4])
    curves = [
        HazardCurve(measure=measure, levels=levels, rates=rates, name=f"{measure} <mean>")
        for measure in ("pgv_m_s", "pga_g")
    ]
    return assess_object(statue(), SUITE, hazard=curves)


@pytest.fixture(scope="module", name="html")
def _html(found: Assessment) -> str:
    with drawn_once():
        return whole(found)


@pytest.fixture(scope="module", name="page")
def _page(html: str) -> Page:
    return Page(html)


@pytest.fixture(scope="module", name="slides")
def _slides() -> Assessment:
    return assess_object(statue(friction=0.1), SUITE[:3])


def test_bars_go_from_the_low_to_the_high_end_the_widest_first() -> None:
    cases = [
        SimpleNamespace(parameter=parameter, change=change, fitted=share)
        for parameter, change, share in (
            ("", "", 0.3),
            ("width", "-5 % alone", 0.5),
            ("width", "+5 % alone", 0.2),
            ("mass centre", "-2 %", 0.25),
            ("friction", "+10 %", 0.9),
            ("restitution", "+1 %", math.nan),
        )
    ]
    shares = [case.fitted for case in cases]
    found: Any = SimpleNamespace(cases=cases, case_probabilities=shares)
    rows = tornado_rows(found)
    assert [row[1:] for row in rows] == [(0.3, 0.9), (0.5, 0.2), (0.25, 0.3)]
    assert rows[1][0].endswith(", -5 % to +5 %")


@pytest.mark.slow
def test_it_is_one_page_that_runs_and_fetches_nothing(found: Assessment) -> None:
    html = whole(found)
    page = Page(html)
    check_alone(page)
    assert page.tags["h1"] == 1
    pictures = {each["src"] for each in page.of("img")}
    assert not {each["srcset"] for each in page.of("source")} & pictures
    # All are drawn again for dark screens, five for a phone, and none for paper.
    media = [each["media"] for each in page.of("source")]
    dark, phone = "screen and (prefers-color-scheme: dark)", "screen and (max-width: 40rem)"
    assert media.count(dark) == 6
    assert media.count(phone) == media.count(f"{dark} and (max-width: 40rem)") == 5
    assert len(media) == 16


@pytest.mark.slow
def test_the_time_of_the_runs_does_not_stand_on_it(found: Assessment) -> None:
    assert page_of(replace(found, seconds=found.seconds + 1.0)) == page_of(found)


def test_its_headings_are_in_order_and_numbered(found: Assessment, page: Page) -> None:
    level, verdict = page.headings[0]
    answer = found.describe().answer
    assert answer is not None
    assert (level, verdict.replace("\N{NO-BREAK SPACE}", " ")) == (1, answer.sentence)
    assert page.text.index("statue", len("statue")) < page.text.index(answer.sentence)
    inside = [text for level, text in page.headings[2:] if level == 2]
    assert [int(re.match(r"\d+", text)[0]) for text in inside] == [*range(1, len(inside) + 1)]  # type: ignore[index]
    assert {re.sub(r"^\d+", "", text) for text in inside} == ALL
    linked = [each["href"][1:] for each in page.of("a") if "skip" not in each.get("class", "")]
    assert linked == [each["id"] for each in page.of("h2") if each["id"] != "contents"]


def test_all_figures_of_the_answer_stand_on_it(found: Assessment, page: Page) -> None:
    values = found.to_dict()
    assert values["probability"] > values["by_curve"] + 0.1  # both stand on it, and which decides
    shares = [values["probability"], values["by_curve"], values["target_probability"]]
    expected = [chance(share) for share in shares]
    expected += [number(values[key]) for key in ("median", "friction_needed", "uplift_pga_g")]
    for case in values["cases"]:
        expected += [chance(case["fitted"]), f"{case['fell']} of {case['trials']}"]
    for row in values["screens"]:
        expected += [row["edition"], row["status"]]
        expected += [] if row["value"] is None else [number(row["value"])]
    for row in values["inputs"]:
        expected += [row["name"], number(row["pga_g"]), number(row["pgv_m_s"])]
    for remedy in values["remedies"]:
        assert remedy["words"] in page.text
    for risk in values["risks"]:
        expected += [risk["hazard"], number(risk["hclpf"])]
    assert [each for each in expected if each not in page.text] == []


def test_a_probability_has_its_interval_by_the_curve_and_counted(found: Assessment) -> None:
    by_curve = replace(found, basis="curve", probability_band=(0.213, 0.435))
    (row,) = (each for each in answer_rows(by_curve) if each["name"] == "Probability of falling")
    assert row["words"].endswith("(90 %: 21 to 44 %)")
    (row,) = (each for each in answer_rows(found) if each["name"] == "Probability of falling")
    assert found.basis == "count"
    assert interval(found.probability_band, 0.9) in row["words"]


def test_the_curves_of_all_states_stand_on_it(found: Assessment, page: Page) -> None:
    assert found.fragility is not None
    for each in found.fragility.states:
        assert number(each.curve.median) in page.text
        assert f"{each.plain.failures:,} of {each.plain.trials:,}" in page.text
    assert "theta" not in page.text
    for measure in found.fragility.ranking:
        assert f"{measure.aic:.0f}" in page.text


def test_the_median_is_given_as_a_peak_velocity(found: Assessment, page: Page) -> None:
    assert found.curve is not None
    assert f"{number(found.curve.median)} m/s of PGV" in page.text


def test_hashes_versions_seed_and_command_stand_on_it(found: Assessment, page: Page) -> None:
    manifest = make_manifest(found.motions)
    for record in manifest["records"]:
        assert record["sha256"][:16] in page.text
    assert COMMAND in page.text
    assert f"rocksteady {manifest['rocksteady']}" in page.text
    assert "Seeds: bands 0" in page.text
    assert {"mass_kg", "200.0", "friction", "0.5"} <= {word.strip() for word in page.words}


def test_each_file_that_was_read_has_its_hash(slides: Assessment, tmp_path: Path) -> None:
    file = tmp_path / "a&b.toml"
    file.write_bytes(b"")
    written = write_assessment_page(tmp_path / "report.html", slides, files=[file])
    text = Page(written.read_text(encoding="utf-8")).text
    assert "a&b.toml" in text
    # The hash of no bytes, which everyone knows.
    assert "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855" in text


def test_every_picture_is_a_drawing_with_words(page: Page) -> None:
    pictures = page.of("img")
    assert len(pictures) == 6
    for each in pictures:
        assert len(each["alt"]) > 40
        assert each["alt"].endswith(".")
        content = each["src"].removeprefix("data:image/svg+xml;base64,")
        assert ET.fromstring(base64.b64decode(content)).tag.endswith("svg")
    assert len({each["alt"] for each in pictures}) == 6


def test_the_bar_has_the_probability_and_the_interval_of_the_answer(found: Assessment) -> None:
    def bar(each: Assessment) -> tuple[dict[str, str], list[str]]:
        page = Page(page_of(each))
        (shown,) = [part for part in page.of("div") if part.get("class") == "chance"]
        return shown, [part["style"] for part in page.of("span") if "style" in part]

    words = chance(found.probability)
    shown, places = bar(found)
    assert found.probability is not None
    begins = f"Probability of falling {words} on a scale from 0 to 100 %; 90 %: "
    assert shown["aria-label"].startswith(begins)
    assert places[:2] == [f"--place: {100.0 * found.probability:.2f}"] * 2
    by_curve = replace(found, basis="curve", probability_band=(0.213, 0.435))
    shown, places = bar(by_curve)
    assert shown["aria-label"].endswith("; 90 %: 21 to 44 %.")
    assert places[2:] == ["left: 21.30%; width: 22.20%", "--place: 32.40"]


def test_what_slides_has_no_bar(slides: Assessment) -> None:
    page = Page(page_of(slides))
    assert "chance" not in {part.get("class") for part in page.of("div")}


def test_motions_from_random_numbers_are_named_so(page: Page, slides: Assessment) -> None:
    assert "12 of 12 motions are synthetic" in page.text
    assert "synthetic" not in page_of(slides)  # none was run


@pytest.mark.slow
def test_names_of_any_kind_are_shown_and_never_run(page: Page) -> None:
    record = Record(
        acceleration_m_s2=SUITE[0].acceleration_m_s2, dt_s=SUITE[0].dt_s, name="<b>&amp;$x$"
    )
    ends = np.array([0.1, 1.0])
    hazard = HazardCurve(measure="pgv_m_s", levels=ends, rates=0.01 / ends, name="<i>x</i>")
    found = assess_object(statue(HOSTILE), [record, *SUITE[1:3]], hazard=hazard)
    html = page_of(found, command="<script>'\"&")
    plain, page = page, Page(html)
    check_alone(page)
    assert page.tags["b"] == plain.tags["b"]
    assert page.tags["i"] == 0
    assert "\u202e" not in html
    for text in (
        " ".join(HOSTILE.replace("\u202e", "\\u202e").split()),
        "<b>&amp;$x$",
        "<i>x</i>",
        "<script>'\"&",
    ):
        assert text in page.text
    assert page.style.count("<") == 0
    running = re.search(r'@bottom-left { content: "([^"]*)"; color', page.style)
    assert running is not None
    assert not set(running[1]) & set("\\<>&{}'")


def test_a_refused_object_has_a_short_page(slides: Assessment) -> None:
    page = Page(page_of(slides))
    check_alone(page)
    inside = {re.sub(r"^\d+", "", text) for _, text in page.headings[2:]}
    assert inside == {
        "What is needed", "The object", "Published formulas, side by side",
        "What the answer depends on", "Inputs",
    }  # fmt: skip
    assert slides.sentence in page.text
    assert slides.reason in page.text
    assert "no answer" in page.text
    assert "Probability of falling" not in page.text
    assert len(page.of("img")) == 1


@pytest.mark.slow
def test_headings_stand_over_content_alone(found: Assessment) -> None:
    """Without hazard, remedies, sensitivity and further measures their sections are gone."""
    fragility = found.fragility
    assert fragility is not None
    bare = replace(
        found,
        risks=(),
        remedies=(),
        cases=found.cases[:1],
        fragility=replace(fragility, ranking=fragility.ranking[:1]),
    )
    page = Page(page_of(bare))
    inside = {re.sub(r"^\d+", "", text) for _, text in page.headings[2:]}
    assert ALL - inside == {"Risk", "Remedies", "Sensitivity", "Efficiency of measures"}
    assert "none needed" in page.text


@pytest.mark.slow
def test_an_object_that_no_run_topples_has_a_page_without_a_median() -> None:
    squat = statue(
        geometry={"width_m": 1.0, "height_m": 0.8}, demand={"pga_g": 0.9, "pgv_m_s": 0.1}
    )
    found = assess_object(DescribedObject(values={**squat.values, "friction": 2.0}), SUITE[:3])
    page = Page(page_of(found))
    check_alone(page)
    assert found.verdict == "stands"
    assert "No change that was tried moves it." in page.text
    assert not [each for each in page.of("img") if "Tornado" in each["alt"]]
    assert "chance of falling: low" in page.text
    assert "nan" not in page.text.lower().split()


@pytest.mark.slow
def test_few_motions_have_no_band_and_the_page_says_none() -> None:
    found = assess_object(statue(), SUITE[:3])
    page = Page(page_of(found))
    assert found.basis == "count", "the band is that of the count"
    assert "studentised" not in page.text
    assert "90 % band" not in page.text


@pytest.mark.slow
def test_two_sides_that_differ_have_a_table() -> None:
    shape = {"width_m": 0.4, "height_m": 1.6, "offset_m": 0.05}
    page = Page(page_of(assess_object(statue(geometry=shape), SUITE[:3])))
    assert "Its two sides differ." in page.text
    for side in (0.15, 0.25):
        assert f"{number(math.degrees(math.atan(side / 0.8)))}°" in page.text


def test_what_cannot_be_written_is_refused(slides: Assessment, tmp_path: Path) -> None:
    with pytest.raises(OutputError):
        write_assessment_page(tmp_path / "missing" / "report.html", slides)


@every(("side", "theta", "a"), [(1, 0.05, 0.4), (1, 0.2, -0.3), (-1, -0.1, 0.4), (-1, -0.3, 0.0)])
def test_the_equation_on_the_page_is_that_of_the_runs(
    page: Page, side: int, theta: float, a: float
) -> None:
    (inside,) = re.findall(r"= -p² \[(.+?)\]", page.text)
    for words, code in (
        ("α sgn θ", "side * alpha"), ("(a/g)", "a *"), ("θ", "theta"), ("sin", "math.sin"),
        ("cos", "math.cos"),
    ):  # fmt: skip
        inside = inside.replace(words, code)
    alpha = 0.35
    known = {"math": math, "side": side, "alpha": alpha, "theta": theta, "a": a}
    written = -eval(inside, {"__builtins__": {}}, known)
    drive = Drive(alpha, side * a / alpha, 0.0, 0.0, 0.0, 0.0, 0.0)
    run = side * alpha * acceleration(drive, 0.0, side * theta / alpha, 0.0)
    assert written == pytest.approx(run, rel=1e-12)
