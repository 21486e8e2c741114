"""Numbers of the page on Housner and nature follow from the package."""

import math
import re
from pathlib import Path

import numpy as np
import pytest

from rocksteady import Block, Linear, fit_restitution
from rocksteady.formulas import free_rocking_peaks, housner_restitution
from rocksteady.risk import RestitutionBand

PAGE = (Path(__file__).parents[3] / "docs" / "guides" / "restitution.md").read_text(
    encoding="utf-8"
)
ROWS = re.findall(r"^\| (\d+) \| (0\.\d+) \| (0\.\d+) \| ([\d.]+) \|$", PAGE, re.MULTILINE)
MEASURED = {int(ratio): float(mean) for ratio, mean, _, _ in ROWS}


def test_the_table_has_housners_value_and_the_quotient_of_each_shape() -> None:
    assert list(MEASURED) == list(range(4, 16))
    for ratio, mean, housner, quotient in ROWS:
        value = housner_restitution(math.atan(1.0 / int(ratio)))
        assert float(housner) == pytest.approx(value, abs=5.1e-5)
        assert float(quotient) == pytest.approx(float(mean) / value, abs=5.1e-4)


def test_the_bias_of_the_means_is_near_that_of_the_single_impacts() -> None:
    given = {ratio: housner_restitution(math.atan(1.0 / ratio)) for ratio in MEASURED}
    off = np.array([given[ratio] - mean for ratio, mean in MEASURED.items()])
    # Published of 134 impacts: .0105; the means weigh shapes with few tests as much as others.
    assert off.mean() == pytest.approx(0.0105, abs=0.001)
    # What a mean is off, and what single tests scatter, make up the published .039.
    assert math.hypot(math.sqrt((off**2).mean()), 0.034) == pytest.approx(0.039, abs=0.002)
    tall = [MEASURED[ratio] / given[ratio] for ratio in (14, 15)]
    assert np.mean(tall) == pytest.approx(0.965, abs=0.001)
    assert "root mean square error of 0.039 and a bias of +0.0105" in PAGE


def test_the_impacts_to_five_percent_are_those_of_the_closed_form() -> None:
    counts = {}
    for ratio in (14, 15):
        block = Block.from_p(alpha=math.atan(1.0 / ratio), p=3.0)
        for name, e in (("measured", MEASURED[ratio]), ("housner", block.restitution)):
            peaks = free_rocking_peaks(0.5, e, 400)
            counts[ratio, name] = 1 + int(np.argmax(peaks[1:] <= 0.05 * 0.5))
            fit = fit_restitution(block.alpha * peaks[:9], block, model=Linear())
            assert fit.to_small == counts[ratio, name]
            assert fit.to_small_housner == counts.get((ratio, "housner"), fit.to_small_housner)
    assert counts == {
        (14, "measured"): 25,
        (15, "measured"): 47,
        (14, "housner"): 178,
        (15, "housner"): 205,
    }
    words = " ".join(PAGE.split())
    assert "would take 25 and 47 impacts, and by Housner's values 178 and 205." in words


def test_the_bands_hold_the_means_that_the_page_names() -> None:
    lower = RestitutionBand(low=("housner", 0.95), high="housner")

    def ends(band: RestitutionBand, ratio: int) -> tuple[float, float]:
        values = band.ratios(Block.rectangle(width=1.0, height=float(ratio)))
        return float(values.min()), float(values.max())

    for band, held in ((RestitutionBand(), [4, 10]), (lower, [*range(5, 12), 14, 15])):
        within = {ratio: ends(band, ratio) for ratio in MEASURED}
        assert [n for n, (low, high) in within.items() if low <= MEASURED[n] <= high] == held
    least, most = (np.argmax(free_rocking_peaks(0.5, e, 1000) <= 0.025) for e in ends(lower, 15))
    assert 14 < least < most < 570  # of the two decays
    words = " ".join(PAGE.split())
    assert "hold the means of first impacts at H/B 4 and 10 alone" in words
    assert "holds all but those at H/B 4, 12 and 13" in words
