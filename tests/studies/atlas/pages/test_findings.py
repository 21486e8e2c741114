"""The numbers and sentences of an atlas: each ends, holds a number, and counts what it names."""

from dataclasses import replace

import numpy as np

from rocksteady.studies.atlas.analysis.columns import column
from rocksteady.studies.atlas.pages.findings import (
    bands_at,
    coexistence_sentences,
    family_sentences,
    rest_sentences,
)
from tests.studies.atlas.small import small


def test_a_band_too_thin_to_follow_is_said_not_to_be_followed() -> None:
    bands = column(0.8, 0.6, 8.0, 3)
    found = bands_at(bands, 3)
    assert found.ends_with == "not-followed"
    assert found.symmetric_until == bands.borders[0]
    assert np.isnan(found.unsymmetric_until)


def test_every_sentence_ends_and_holds_a_number() -> None:
    whole = small()
    texts = [
        *family_sentences(whole.families, whole.lines, whole.strips),
        *coexistence_sentences(whole.found),
        *rest_sentences(whole.rest, whole.families[0]),
    ]
    assert len(texts) >= 7
    for text in texts:
        assert text.endswith(".")
        assert any(letter.isdigit() for letter in text)
        assert "nan" not in text


def test_the_most_motions_are_all_named() -> None:
    found = small().found
    for aperiodic in (False, True):  # one more motion, of another kind
        several = replace(found, aperiodic=np.full_like(found.aperiodic, fill_value=aperiodic))
        most = int(several.motions.max())
        (text,) = (t for t in coexistence_sentences(several) if t.startswith("The most are"))
        assert text.startswith(f"The most are {most}, ")
        named = text.partition(": ")[2]
        assert (
            named.count("a symmetric")
            + named.count("an unsymmetric")
            + named.count("rest")
            + (named.count("a motion that does not repeat itself"))
            == most
        )
