"""The page of a facade: its numbers, its marks, both languages, and that it runs nothing."""

import functools
import re
from dataclasses import replace

import pytest

from rocksteady.facades.checks.actions import Tie
from rocksteady.facades.checks.check_facade import check_facade
from rocksteady.facades.checks.facade import Facade
from rocksteady.facades.checks.facade_runs import FacadeRuns
from rocksteady.facades.page._facade_page import facade_html
from rocksteady.facades.page._facade_tables import _restitution, mechanism_rows
from rocksteady.facades.plots.languages import TABLES, language_of
from rocksteady.show.export.manifest import make_manifest
from tests.every import every
from tests.facades.page.checked_facades import SUITE, alone, thin, tied
from tests.outputs import unrendered
from tests.show.assessment.pages import Page, check_alone, drawn_once

CHECKS = {"tied": tied, "thin": thin, "alone": alone}
BOTH = every("name", CHECKS)
NAMES = {"fronte", "timpano", "copertura", "volta", "catene", "puntoni", "synthetic"}


@functools.cache
def page_of(name: str, language: str) -> tuple[Page, str]:
    with unrendered(), drawn_once():  # whose pictures are rendered in a folder
        html = facade_html(CHECKS[name](), make_manifest(SUITE), language_of(language))
    return Page(html), html


def words_in(text: str) -> set[str]:
    """Return the words of a text, without hashes and the indices of symbols."""
    plain = re.sub(r"\b[0-9a-f]{12,}\b|SL[VC]", " ", text)
    return {word.lower() for word in re.findall(r"[A-Za-zÀ-ÿ]{4,}", plain)}


def test_a_restitution_that_is_given_is_written_as_the_language_has_it() -> None:
    words, check = language_of("it"), alone()
    assert _restitution(check, words)[1] == words["housner"]
    given = replace(check, facade=replace(check.facade, restitution=0.85))
    assert _restitution(given, words) == ("0,85", "")


@pytest.mark.slow
@BOTH
@every("language", ["en", "it"])
def test_it_is_one_page_that_runs_and_fetches_nothing(name: str, language: str) -> None:
    page, html = page_of(name, language)
    check_alone(page)
    assert page.tags["h1"] == 1
    assert re.search(r'<html lang="([\w-]+)">', html)[1] == TABLES[language]["lang"]  # type: ignore[index]
    numbers = [text for level, text in page.headings[2:] if level == 2]
    assert [int(re.match(r"\d+", text)[0]) for text in numbers] == [*range(1, len(numbers) + 1)]  # type: ignore[index]
    pictures = [each["alt"] for each in page.of("img")]
    assert len(pictures) == (3 if CHECKS[name]().runs is not None else 2)
    assert all(len(alt) > 40 for alt in pictures)


@pytest.mark.slow
@BOTH
def test_no_english_is_left_on_the_italian_page(name: str) -> None:
    """Words of the English page that the Italian table does not have are nowhere on it."""
    english, _ = page_of(name, "en")
    italian, html = page_of(name, "it")
    table = words_in(" ".join(TABLES["it"].values()))
    foreign = words_in(english.text) - table - NAMES
    assert len(foreign) > 100
    shown = words_in(italian.text) | words_in(" ".join(e["alt"] for e in italian.of("img")))
    assert shown & foreign == set()
    assert "Contents" not in html
    assert "To the content" not in html


@pytest.mark.slow
@BOTH
def test_italian_numbers_have_commas_and_english_ones_points(name: str) -> None:
    """But for numbers of formulas, as C8.7.1.10, and the version at the end."""

    def numbers(text: str) -> str:
        plain = re.sub(r"C8\.[\w.]+|rocksteady [\d.]+|NumPy [\d.]+|\d+\.\s", " ", text)
        return " ".join(re.findall(r"\d[.,]\d+", plain))

    pages = {code: page_of(name, code)[0] for code in ("en", "it")}
    written = {code: numbers(page.text) for code, page in pages.items()}
    assert "." not in written["it"]
    assert "," not in written["en"]
    assert len(written["it"].split()) > 10
    alts = " ".join(each["alt"] for each in pages["it"].of("img"))
    assert not re.search(r"\d\.\d", alts)


@pytest.mark.parametrize("language", ["en", "it"])
def test_every_check_stands_on_it_with_formula_page_and_mark(language: str) -> None:
    check = thin()
    page, html = page_of("thin", language)
    rows = re.findall(r"<tr><th scope=\"row\" class=\"quarter name\">(.*?)</tr>", html, re.DOTALL)
    mark = "," if language == "it" else "."
    for each, row in zip(check.checks, rows, strict=False):
        assert f"{each.formula.split(',')[0]}" in row
        assert "†" in row
        assert "272–277" in row
        assert each.limit_state in row
        word = {True: "satisfied", False: "not_satisfied", None: "no_verdict"}[each.satisfied]
        assert f">{TABLES[language][word]}</span>" in row
    assert f"0{mark}0988" in page.text
    assert f"1{mark}96 s" in page.text
    assert f"2{mark}73 s" in page.text
    assert page.text.count("†") > 12


@pytest.mark.parametrize("language", ["en", "it"])
def test_each_symbol_of_the_mechanism_has_the_value_that_defines_it(language: str) -> None:
    """A wall of .3 x 3 m, FC 1.35, W = 16.2 kN; a tie of 2 kN at 3 m that is not verified.

    By hand: M = 16.2 x .15 = 2.43, at rest 8.43, and D = K = 24.3 kN m.
    """
    words = language_of(language)
    rod = Tie(name="rod", force_kn=2.0, z_m=3.0)
    facade = Facade(name="tied", thickness_m=0.3, height_m=3.0, ties=(rod,))
    keys = [words[f"col_{key}"] for key in ("symbol", "value")]
    rows = [
        [re.sub(r"<[^>]+>", "", str(getattr(row[key], "content", row[key]))) for key in keys]
        for row in mechanism_rows(check_facade(facade), words)
    ]
    for symbol, value in (
        ("α0 g", 8.43 / 24.3),
        ("min a0", 8.43 / 24.3 / 1.35),
        ("tan θ0/λ", 0.1 / 1.35),
    ):
        assert [row[1] for row in rows if row[0] == symbol] == [words.quantity(value, "g")]
    for symbol, value in (("d0", 200.0), ("dSLV", 80.0), ("dSLC", 120.0)):
        assert [row[1] for row in rows if row[0] == symbol] == [words.quantity(value, "mm")]


def test_disagreement_shows_at_the_top_with_its_reason() -> None:
    page, _ = page_of("tied", "it")
    assert "1 verifica su 5 non è soddisfatta. metodi discordi" in page.text
    assert (
        "verifica soddisfatta con analisi cinematica non lineare e analisi dinamica non lineare, "
        "non soddisfatta con analisi cinematica lineare." in page.text
    )
    assert "cresce con lo spessore" in page.text


def test_without_a_demand_there_is_no_verdict() -> None:
    page, _ = page_of("alone", "en")
    assert page.headings[0][1].startswith("No check: neither a demand nor records are given.")
    assert "no verdict" in page.text
    assert "Give a demand, or 7 records or more, for a verdict." in page.text
    assert "∞" not in page.text


def test_each_record_has_its_row_and_the_mean_is_below() -> None:
    runs = tied().runs
    assert isinstance(runs, FacadeRuns)
    page, html = page_of("tied", "en")
    for name in runs.records:
        assert f"<bdi>{name}</bdi>" in html
    assert runs.mean_m is not None
    assert f"{1e3 * runs.mean_m:.3g} mm" in page.text
    assert page.text.count("does not lift") == int((runs.share == 0.0).sum())


def test_a_name_is_no_markup() -> None:
    page, html = page_of("tied", "en")
    assert page.headings[0] == (
        1,
        "1\N{NO-BREAK SPACE}of\N{NO-BREAK SPACE}5 checks is not satisfied.",
    )
    assert "Fronte <A> & B 1 of 5 checks" in page.text
    assert "Fronte <A>" not in html
