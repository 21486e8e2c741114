"""The page of an assessment: its figures, its sections, and that it needs and runs nothing."""

import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from rocksteady.errors import OutputError
from rocksteady.kernels.nonlinear.drive import Drive, acceleration
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.synthetic_suite import make_synthetic_suite
from rocksteady.results.numbers import chance, number
from rocksteady.risk.assess.assessment import Assessment, assess_object
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.show.assessment.object_report import report_html, write_assessment_page
from rocksteady.show.export.manifest import make_manifest
from rocksteady.words.assessment import lines_of
from tests.every import every
from tests.outputs import unrendered
from tests.show.assessment.pages import Page, check_alone, drawn_once

HOSTILE = "<script>alert('1')</script> & \u202eevil \"q\" $\\frac{x}$ {{ 7*7 }} </style>\\"
SUITE = make_synthetic_suite(12)
COMMAND = "rocksteady assess statue.toml --records <DIR> --out \"OUT\" && echo '$x$'"


def statue(name: str = "statue", **keys: Any) -> DescribedObject:
    values: dict[str, Any] = {
        "name": name,
        "friction": 0.5,
        "geometry": {"width_m": 0.34, "height_m": 1.8, "mass_kg": 200.0},
        "demand": {"pga_g": 0.4, "pgv_m_s": 0.45},
        "assessment": {"draws": 2},
    }
    return DescribedObject(values=values | keys)


def page_of(assessment: Assessment, command: str = COMMAND) -> str:
    """Return the page with empty pictures, for tests of words."""
    with unrendered(), drawn_once():
        return whole(assessment, command)


def whole(assessment: Assessment, command: str = COMMAND) -> str:
    """Return the page with its pictures for dark screens and phones."""
    return report_html(assessment, make_manifest(assessment.suite.motions, command=command))


@pytest.fixture(scope="module", name="found")
def _found() -> Assessment:
    return assess_object(statue(), SUITE)


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


@pytest.mark.slow
def test_it_is_one_page_that_runs_and_fetches_nothing(found: Assessment) -> None:
    html = whole(found)
    page = Page(html)
    check_alone(page)
    assert page.tags["h1"] == 1
    pictures = {each["src"] for each in page.of("img")}
    assert not {each["srcset"] for each in page.of("source")} & pictures
    # All are drawn again for dark screens, two for a phone, and none for paper.
    media = [each["media"] for each in page.of("source")]
    dark, phone = "screen and (prefers-color-scheme: dark)", "screen and (max-width: 40rem)"
    assert media.count(dark) == 3
    assert media.count(phone) == media.count(f"{dark} and (max-width: 40rem)") == 2
    assert len(media) == 7


@pytest.mark.slow
def test_the_time_of_the_runs_does_not_stand_on_it(found: Assessment) -> None:
    assert page_of(replace(found, seconds=found.seconds + 1.0)) == page_of(found)


def inside(page: Page) -> list[str]:
    """Return the headings of the sections, without their numbers."""
    return [re.sub(r"^\d+", "", text) for _, text in page.headings[2:]]


def first_page(page: Page) -> str:
    """Return the text before the first section."""
    return page.text.partition("Contents")[0]


@every("friction", [0.5, 0.1])
def test_its_first_page_is_the_screen(
    friction: float, found: Assessment, slides: Assessment
) -> None:
    """All lines of the summary, in their order, with nothing between that has a figure."""
    each = found if friction == 0.5 else slides
    text = first_page(Page(page_of(each)))
    word = each.verdict.replace("-", " ")
    said = [each.sentence]
    for line in lines_of(each):
        said += [replace(line, condition="").words.removeprefix(f"{word}: "), line.condition]
    places = [text.lower().find(words.lower()) for words in said if words]
    assert min(places) >= 0
    assert places == sorted(places)


def test_a_formula_has_no_colour_of_a_verdict(found: Assessment, page: Page) -> None:
    looks = [part.get("class", "") for part in page.of("span")]
    first, *others = (look for look in looks if look.startswith("badge"))
    assert first == f"badge {found.verdict}"
    assert set(others) == {"badge plain"}


def test_all_figures_of_the_answer_stand_on_it(found: Assessment, page: Page) -> None:
    values = found.to_dict()
    expected = [chance(values[key]) for key in ("share", "share_1_1", "target_probability")]
    expected += [number(values[key]) for key in ("friction_needed", "uplift_pga_g")]
    for case in values["cases"]:
        expected += [f"{case['fall']} of {case['runs']}", case["change"]]
    for row in values["screens"]:
        expected += [row["edition"], row["status"]]
        expected += [] if row["value"] is None else [number(row["value"])]
    for row in values["inputs"]:
        expected += [row["name"]]
        expected += [number(row[key]) for key in ("pga_g", "pgv_m_s", "scale", "stretch")]
    assert [each for each in expected if each not in page.text] == []


def test_each_file_that_was_read_has_its_hash(slides: Assessment, tmp_path: Path) -> None:
    file = tmp_path / "a&b.toml"
    file.write_bytes(b"")
    written = write_assessment_page(tmp_path / "report.html", slides, files=[file])
    text = Page(written.read_text(encoding="utf-8")).text
    assert "a&b.toml" in text
    # The hash of no bytes, which everyone knows.
    assert "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855" in text


@pytest.mark.slow
def test_names_of_any_kind_are_shown_and_never_run(page: Page) -> None:
    record = Record(
        acceleration_m_s2=SUITE[0].acceleration_m_s2, dt_s=SUITE[0].dt_s, name="<b>&amp;$x$"
    )
    found = assess_object(statue(HOSTILE), [record, *SUITE[1:]])
    html = page_of(found, command="<script>'\"&")
    plain, page = page, Page(html)
    check_alone(page)
    assert page.tags["b"] == plain.tags["b"]
    assert page.tags["i"] == 0
    assert "\u202e" not in html
    for text in (
        " ".join(HOSTILE.replace("\u202e", "\\u202e").split()),
        "<b>&amp;$x$",
        "<script>'\"&",
    ):
        assert text in page.text
    assert page.style.count("<") == 0
    running = re.search(r'@bottom-left { content: "([^"]*)"; color', page.style)
    assert running is not None
    assert not set(running[1]) & set("\\<>&{}'")


def test_an_object_that_stands_needs_no_run() -> None:
    """It has no share in a picture or a table."""
    found = assess_object(statue(demand={"pga_g": 0.17, "pgv_m_s": 0.1}), SUITE)
    assert (found.verdict, found.judged.stands, found.fragility) == ("stands", True, None)
    page = Page(page_of(found))
    check_alone(page)
    assert "By statics, without a run." in first_page(page)
    assert not {"Counted shares", "Sensitivity"} & set(inside(page))
    assert "nan" not in page.text.lower().split()


def test_too_few_records_have_a_page_with_their_motions() -> None:
    found = assess_object(statue(), SUITE[:3])
    page = Page(page_of(found))
    assert found.verdict == "no-answer"
    assert found.sentence in page.text
    assert {"Motions", "Method"} <= set(inside(page))
    assert "Counted shares" not in inside(page)


@pytest.mark.slow
def test_headings_stand_over_content_alone(found: Assessment, page: Page) -> None:
    rest = Page(page_of(replace(found, cases=found.cases[:1])))
    assert [each for each in inside(page) if each not in inside(rest)] == ["Sensitivity"]


@pytest.mark.slow
def test_an_object_that_nothing_moves_has_no_tornado() -> None:
    squat = statue(geometry={"width_m": 1.0, "height_m": 0.8}, demand={"pgv_m_s": 0.05})
    found = assess_object(DescribedObject(values={**squat.values, "friction": 2.0}), SUITE)
    page = Page(page_of(found))
    check_alone(page)
    assert found.judged.count is not None
    assert found.judged.count.falls == 0
    assert "No change that was tried moves the share." in page.text
    assert not [each for each in page.of("img") if "Tornado" in each["alt"]]


@pytest.mark.slow
def test_built_in_motions_and_scaled_ones_are_named_so(page: Page) -> None:
    assert "its time axis by the stretch" in page.text
    built = Page(page_of(assess_object(statue())))
    assert "no earthquake made" in built.text
    scaled = Page(page_of(assess_object(statue(), SUITE, stretch=False)))
    assert "each scaled to the demand" in scaled.text
    assert "stretch" not in scaled.text.partition("Motions")[2].partition("The object")[0]


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
