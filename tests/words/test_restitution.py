"""Words of fits of the restitution: estimates, errors and keys."""

import math

import numpy as np
import pytest

from rocksteady import fit_restitution
from rocksteady.histories import Release
from tests.risk.free_rocking.decays import decay
from tests.risk.free_rocking.test_fit_restitution import BLOCK, UNLIKE, counted, exact


def test_a_fit_in_words_and_in_keys() -> None:
    housner = 1.0 - 1.5 * math.sin(BLOCK.alpha) ** 2
    peaks = exact()
    fit = fit_restitution(Release(peaks_rad=peaks, sigma_rad=1e-7), BLOCK)
    values = fit.to_dict()
    assert fit.housner == pytest.approx((housner, housner), rel=1e-12)
    assert values["factor"] == pytest.approx([0.95 / housner] * 2, rel=1e-6)
    assert values["impacts_to_5_percent"] == counted(BLOCK, peaks[0], 1, (0.95, 0.95))
    assert values["impacts_to_5_percent_housner"] == counted(BLOCK, peaks[0], 1, (housner, housner))
    assert values["standard_error"][0] / values["restitution"][0] == pytest.approx(
        values["factor_error"][0] / values["factor"][0]
    )
    assert (values["sigma_rad"], values["sigma_estimated"], values["model"]) == (
        *(1e-7, False, "nonlinear"),
    )
    assert [row["number"] for row in values["impacts"]] == list(range(1, 13))
    text = fit.summary(more=True)
    headline = f"restitution 0.95, {0.95 / housner:.3g} of Housner's, from 12 impacts of 1 release"
    for words in (
        *(headline, "e/Housner", "measuring error", "sd 0.0001 mrad", "until 5 % of the peak"),
        *(f"{values['impacts_to_5_percent']} impacts by the fit and ", "by Housner's value"),
        *("test", "peak [rad]", "next [rad]", "± measuring", "residual [sd]", "0.9500"),
    ):
        assert words in text, (words, text)
    two = fit_restitution([Release(peaks_rad=peaks, sides=1), Release(peaks_rad=peaks)], BLOCK)
    assert "from 36 impacts of 2 releases" in two.summary(more=True)
    sides = decay(UNLIKE, 0.5 * UNLIKE.positive.alpha, np.tile([0.87, 0.93], 6))
    unlike = fit_restitution(sides, UNLIKE)
    assert "restitution 0.87 and 0.93, from 12 impacts of 1 release" in unlike.summary(more=True)
    assert unlike.to_dict()["restitution"] == pytest.approx([0.87, 0.93])
    single = fit_restitution(sides, UNLIKE, each_side=False)
    assert single.factor is not None
    assert single.factor[0] == single.factor[1]
