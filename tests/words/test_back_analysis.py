"""Words of surveys: how many fell, and the keys of a row."""

import numpy as np
import pytest

from rocksteady.calibration import ObjectPrior, Survey


def test_a_survey_in_words_and_keys() -> None:
    objects = [
        ObjectPrior(name=f"stone {place}", width_m=0.2 + 0.1 * place, height_m=1.0)
        for place in range(3)
    ]
    survey = Survey(
        objects=objects, fell=[True, False, True], reversed=[None, True, False], sources={"a": "b"}
    )
    values = survey.to_dict()
    assert (values["objects"], values["fell"], values["sources"]) == (3, 2, {"a": "b"})
    assert [row["outcome"] for row in values["rows"]] == ["fell", "stood", "fell"]
    assert [row["reversed"] for row in values["rows"]] == [None, True, False]
    assert [row["object"] for row in values["rows"]] == ["stone 0", "stone 1", "stone 2"]
    assert values["rows"][0]["outline_alpha_rad"] == pytest.approx(np.arctan(0.2), rel=0.2)
    assert repr(survey) == "<Survey: 3 objects: 2 fell, 1 stood>"
    lines = survey.summary().splitlines()
    (heading,) = (line for line in lines if "outcome" in line)
    assert heading.split() == ["object", "outcome", "alpha", "by", "sizes,", "rad"]
    # Words stand on the left of their columns, and numbers on the right.
    first = next(line for line in lines if "stone 0" in line)
    assert first.index("stone 0") == heading.index("object")
    assert first.index("fell") == heading.index("outcome")
    assert len(first.rstrip()) == len(heading.rstrip())
    assert len(survey) == 3
    assert survey.outcomes.tolist() == [1.0, 0.0, 1.0]
    # Of objects whose sides are alike it makes no difference which way they face.
    assert survey.facings == (None, None, None)
