"""Words of facades: the same keys and places in each language, and numbers as it writes them."""

import re
from types import SimpleNamespace

import pytest

from rocksteady.errors import InputError
from rocksteady.facades.checks.remark import TEMPLATES
from rocksteady.facades.plots.headline import LOOKS, headline_of, verdict_of
from rocksteady.facades.plots.languages import TABLES, language_of
from tests.every import every

SAME = {"inputs_file"}
"""Texts that are the same: Italian has the word "file"."""
PLACE = re.compile(r"\{(\w+)\}")


def test_every_language_has_the_same_keys() -> None:
    assert set(TABLES["en"]) == set(TABLES["it"])
    assert {f"remark_{key}" for key in TEMPLATES} <= set(TABLES["it"])


@every("key", TABLES["en"])
def test_a_text_has_the_same_places_in_each_language(key: str) -> None:
    """A facade's kind may be named once more in one language than in the other."""
    english, italian = (set(PLACE.findall(TABLES[code][key])) for code in ("en", "it"))
    assert english - {"kind", "the", "The"} == italian - {"kind", "the", "The"}


def test_no_text_is_the_same_in_both_but_symbols() -> None:
    alike = {key for key, text in TABLES["it"].items() if text == TABLES["en"][key]}
    for key in alike - SAME:
        plain = PLACE.sub("", TABLES["en"][key])
        assert not re.search(r"[a-z]{4}", plain), key


def test_italian_numbers_have_a_comma() -> None:
    italian, english = language_of("it"), language_of("en")
    assert italian.number(0.0987654) == english.number(0.0987654).replace(".", ",") == "0,0988"
    assert italian.quantity(200.0, "mm") == "200\N{NO-BREAK SPACE}mm"
    assert italian.number(None) == "—"


def test_a_language_that_is_not_there_is_refused_by_name() -> None:
    with pytest.raises(InputError, match=r"language = 'de'.*en and it"):
        language_of("de")


def test_a_headline_counts_the_checks_that_fail() -> None:
    words = language_of("en")
    for satisfied, line in (
        ([], ""),
        ([True, None], ""),
        ([True, True, None], words["headline_all"]),
        ([False, False], words["headline_no"]),
        ([True, False, True], words("headline_one", failed=1, all=3)),
        ([False, False, True, None], words("headline_some", failed=2, all=3)),
    ):
        checks = [SimpleNamespace(satisfied=each) for each in satisfied]
        check = SimpleNamespace(checks=checks, states=())
        assert headline_of(check, words) == line  # type: ignore[arg-type]
        decided = [each for each in satisfied if each is not None]
        word = words[LOOKS[all(decided) if decided else None][0]]
        assert verdict_of(check, words)["word"] == word  # type: ignore[arg-type]
