"""FEMA P-58's cabinets: every published number, in every unit."""

import math

import pytest

from rocksteady import Block
from rocksteady.risk.screens.cabinets import CABINETS, nearest_cabinet
from rocksteady.risk.screens.thresholds import kaneko_hayashi

PUBLISHED = {  # depth, height [in], median [m/s], alpha, p, number, e, NRML mean and sd [cm/s]
    "102a": (12.625, 29.0, 0.724, 0.41060, 4.27904, 0.7257, 0.7610, 82.0399, 43.7224),
    "103a": (12.625, 41.0, 0.493, 0.29871, 3.67419, 0.5998, 0.8701, 55.8642, 29.7723),
    "104a": (12.625, 56.0, 0.361, 0.22174, 3.17623, 0.5186, 0.9274, 40.9067, 21.8008),
    "105a": (12.625, 71.0, 0.290, 0.17598, 2.83387, 0.4713, 0.9540, 32.8613, 17.5131),
    "106a": (12.625, 81.25, 0.251, 0.15415, 2.65392, 0.4372, 0.9646, 28.4420, 15.1579),
    "112a": (15.0, 24.0, 1.229, 0.55860, 4.52357, 0.9071, 0.5787, 139.2639, 74.2194),
    "114a": (15.0, 52.0, 0.498, 0.28084, 3.27122, 0.5759, 0.8848, 56.4308, 30.0742),
    "124a": (18.6, 52.5, 0.688, 0.34049, 3.22457, 0.6385, 0.8327, 77.9606, 41.5484),
    "125a": (18.6, 67.75, 0.526, 0.26794, 2.87108, 0.5609, 0.8949, 59.6036, 31.7652),
}


def test_every_published_number_is_there() -> None:
    assert [cabinet.row.removeprefix("E.20.22.") for cabinet in CABINETS] == list(PUBLISHED)
    for cabinet, row in zip(CABINETS, PUBLISHED.values(), strict=True):
        assert (cabinet.depth_in, cabinet.height_in, cabinet.median_m_s) == row[:3]
        block = cabinet.block
        assert block.alpha == pytest.approx(row[3], abs=6e-6)
        assert block.p == pytest.approx(row[4], abs=6e-6)
        assert cabinet.number == pytest.approx(row[5], abs=6e-5)
        assert block.restitution == pytest.approx(row[6], abs=6e-5)
        values = cabinet.values()
        assert values["nrml_mean_cm_s"] == pytest.approx(row[7], abs=6e-5)
        assert values["nrml_sd_cm_s"] == pytest.approx(row[8], abs=6e-5)


def test_the_medians_are_about_079_of_kaneko_and_hayashis() -> None:
    ratios = [
        cabinet.median_m_s / kaneko_hayashi(cabinet.block.positive, 9.80665).velocity_m_s
        for cabinet in CABINETS
    ]
    assert sum(ratios) / 9 == pytest.approx(0.79, abs=0.005)
    assert 0.74 < min(ratios) < max(ratios) < 0.82


def test_the_nearest_cabinet_is_near_in_ratios() -> None:
    block = Block.rectangle(width=0.32, height=1.8)
    cabinet = nearest_cabinet(block.positive)
    assert cabinet.row == "E.20.22.105a"
    expected = math.hypot(math.log(0.32 / 0.320675), math.log(1.8 / 1.8034))
    assert cabinet.distance(block.positive) == pytest.approx(expected)
    for cabinet in CABINETS:
        assert nearest_cabinet(cabinet.block.positive) is cabinet
        assert cabinet.distance(cabinet.block.positive) == pytest.approx(0.0, abs=1e-12)


def test_half_fall_at_the_median() -> None:
    cabinet = CABINETS[0]
    assert cabinet.probability(0.724) == pytest.approx(0.5)
    assert cabinet.probability(0.724 * math.exp(0.5)) == pytest.approx(0.8413447, abs=1e-7)
