"""Surveys in words and keys, and synthetic ones."""

from typing import Any

import numpy as np
import pytest

from rocksteady.errors import InputError
from rocksteady.risk.back_analysis.synthetic_survey import make_synthetic_survey
from rocksteady.risk.observations.spread import PriorRange


def ends(given: Any) -> tuple[float, float]:
    """Return the ends of a range of an object's prior."""
    assert isinstance(given, PriorRange)
    return given.low, given.high


def test_synthetic_surveys_are_of_their_sizes_and_fall_by_slenderness() -> None:
    """An object falls where .35 g exceeds 1.25 times its width over height."""
    for count, seed in ((2, 0), (12, 0), (50, 5)):
        survey = make_synthetic_survey(count, seed=seed)
        assert len(survey) == count
        again = make_synthetic_survey(count, seed=seed)
        assert survey.to_dict() == again.to_dict()
        for place, (each, fell) in enumerate(zip(survey.objects, survey.fell, strict=True)):
            assert each.name == f"synthetic {place + 1}"
            width, height = ends(each.width_m), ends(each.height_m)
            middle = 0.5 * sum(width), 0.5 * sum(height)
            assert width[0] / middle[0] == pytest.approx(0.97)
            assert height[0] / middle[1] == pytest.approx(0.98)
            assert ends(each.base) == pytest.approx((0.9, 1.0))
            assert 0.5 * (1.0 - 1e-9) <= middle[1] <= 1.6 * (1.0 + 1e-9)
            assert 2.5 * (1.0 - 1e-9) <= middle[1] / middle[0] <= 6.0 * (1.0 + 1e-9)
            assert fell == (1.25 * middle[0] / middle[1] < 0.35)
    many = make_synthetic_survey(800, seed=1)
    heights = np.array([0.5 * sum(ends(each.height_m)) for each in many.objects])
    ratios = heights / [0.5 * sum(ends(each.width_m)) for each in many.objects]
    for values, low, high in ((heights, 0.5, 1.6), (ratios, 2.5, 6.0)):
        # Logarithms are even: four parts of the range have a quarter each, and both are unrelated.
        counts = np.histogram(np.log(values), 4, (np.log(low), np.log(high)))[0]
        assert counts == pytest.approx(np.full(4, 200.0), abs=5.0 * np.sqrt(150.0))
    assert abs(np.corrcoef(np.log(heights), np.log(ratios))[0, 1]) < 0.15
    assert make_synthetic_survey().to_dict() == make_synthetic_survey(12, seed=0).to_dict()
    assert make_synthetic_survey(seed=1).to_dict() != make_synthetic_survey(seed=0).to_dict()
    for wrong in (1, 10_001, 2.5, True):
        with pytest.raises(InputError, match=r"^count = "):
            make_synthetic_survey(wrong)  # type: ignore[arg-type]
    for wrong in (-1, 0.5, True):
        with pytest.raises(InputError, match=r"^seed = "):
            make_synthetic_survey(2, seed=wrong)  # type: ignore[arg-type]
