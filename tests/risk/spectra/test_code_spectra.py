"""Spectra by formula against values by hand, and texts that are none."""

import numpy as np
import pytest

from rocksteady.codes import ElasticSpectrum
from rocksteady.errors import InputError
from rocksteady.risk.spectra.code_spectra import FORMS, formula_of
from tests.every import every


def values(text: str, periods: list[float]) -> list[float]:
    """Return Sa [g] of a formula, on the straight lines of its table."""
    found = formula_of(text)
    assert found is not None
    return [float(np.interp(t, *found.rows.T)) for t in periods]


@every(
    ("text", "by_hand"),
    [
        # ag S [1 + T/TB (2.5 - 1)], 2.5 ag S, times TC/T, times TC TD/T^2
        (
            "en1998-1:2004:type1:A:ag=0.25",
            {0.0: 0.25, 0.075: 0.4375, 0.3: 0.625, 1.0: 0.25, 4.0: 0.03125},
        ),
        (
            "EN1998-1:2004:Type1:d:AG=0.3",
            {0.0: 0.405, 0.1: 0.70875, 0.8: 1.0125, 1.6: 0.50625, 4.0: 0.10125},
        ),
        (
            "en1998-1:2004:type2:B:ag=0.1",
            {0.0: 0.135, 0.05: 0.3375, 0.25: 0.3375, 1.0: 0.084375, 2.4: 0.3375 * 0.3 / 5.76},
        ),
        # SDS (.4 + .6 T/T0), SDS, SD1/T, SD1 TL/T^2
        (
            "asce7-16:sds=1.0:sd1=0.6:tl=8",
            {0.0: 0.4, 0.06: 0.7, 0.3: 1.0, 2.0: 0.3, 10.0: 0.048},
        ),
    ],
)
def test_values_by_hand(text: str, by_hand: dict[float, float]) -> None:
    assert values(text, [*by_hand]) == pytest.approx([*by_hand.values()], rel=1e-3)


def test_that_of_ntc_is_the_class_of_facades() -> None:
    site = ElasticSpectrum(ag_g=0.2, f0=2.4, tc_star_s=0.33, soil="C", topography="T2")
    periods = [0.0, 0.1, 0.4, 1.5, 3.5]
    found = values("ntc2018:C:T2:ag=0.2:f0=2.4:tc=0.33", periods)
    assert found == pytest.approx([site.sa_g(t, 0.05) for t in periods], rel=2e-3)


@every("text", [example for example, _ in FORMS.values()])
def test_a_text_of_another_form_is_refused_with_an_example(text: str) -> None:
    code, *parts = text.split(":")
    for place in range(len(parts)):
        less = ":".join([code, *parts[:place], *parts[place + 1 :]])
        for wrong in (less, f"{text}:{parts[place]}", f"{text}:x=1", f"{text}:F"):
            with pytest.raises(InputError, match=f"another form than {text}; write it so"):
                formula_of(wrong)
    for number in ("0", "-1", "nan", "1e9", "x", "0,25"):
        last = text.rpartition("=")[2]
        with pytest.raises(InputError, match=r"spectrum = .* is not valid: (of )?(ag|tl|tc|it)"):
            formula_of(text.removesuffix(last) + number)


def test_corners_rise_and_other_names_are_files() -> None:
    for text in ("asce7-16:sds=1:sd1=2:tl=1", "asce7-16:sds=1:sd1=0.6:tl=0.6"):  # fmt: skip
        with pytest.raises(InputError, match="of the numbers: its corner periods must rise"):
            formula_of(text)
    assert formula_of("en1998-1.csv") is formula_of("asce7-22:sds=1") is None
