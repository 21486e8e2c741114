"""The elastic spectrum of NTC 2018: points by hand, bounds of the soils, properties."""

import itertools
import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.errors import InputError, RocksteadyError
from rocksteady.risk.spectra.elastic_spectrum import SOIL_FACTORS, ElasticSpectrum, Soil
from tests.every import every

SITE: dict[str, Any] = {"ag_g": 0.2, "f0": 2.5, "tc_star_s": 0.3}


def test_soil_b_by_hand() -> None:
    """S_S = 1.4 - .4 2.5 .2 = 1.2, C_C = 1.1 .3^-.2, TC = 1.1 .3^.8 = .4198457 s, TD = 2.4 s."""
    site = ElasticSpectrum(**SITE, soil="B")
    assert site.ss == pytest.approx(1.2, rel=1e-14)
    assert site.tc_s == pytest.approx(0.4198457, rel=1.5e-7)
    assert site.td_s == pytest.approx(2.4)
    assert site.peak_g == pytest.approx(0.24)
    points = {0.0: 0.24, 0.1: 0.4972374, 0.3: 0.6, 1.0: 0.2519074, 3.0: 0.06717531}
    for period, value in points.items():
        assert site.sa_g(period, 0.05) == pytest.approx(value, rel=1.5e-7)


def test_eight_per_cent_lowers_all_but_the_peak() -> None:
    """Eta of 8 % is sqrt(10/13) = .877058; of 28 % and more .55."""
    site = ElasticSpectrum(**SITE, soil="A")
    assert site.sa_g(0.0, 0.08) == pytest.approx(0.2, rel=1e-14)
    assert site.sa_g(0.2, 0.08) == pytest.approx(0.5 * 0.8770580193, rel=1e-9)
    assert site.sa_g(0.2, 0.5) == site.sa_g(0.2, 0.4) == pytest.approx(0.275)


def test_displacement_is_constant_beyond_td() -> None:
    """S_e T^2/(4 pi^2) at TD of soil A: .5 .3/2.4 9.80665 2.4^2/39.4784 = .089426 m."""
    site = ElasticSpectrum(**SITE, soil="A")
    assert site.displacement_m(2.4, 0.05) == pytest.approx(0.0894259, rel=1e-5)
    assert site.displacement_m(3.9, 0.05) == pytest.approx(site.displacement_m(2.4, 0.05))


@every(
    ("soil", "low", "high", "middle"),
    [("A", 1.0, 1.0, 1.0), ("B", 1.0, 1.2, 1.15), ("C", 1.0, 1.5, 1.325),
     ("D", 0.9, 1.8, 1.4625), ("E", 1.0, 1.6, 1.3125)],
)  # fmt: skip
def test_factors_of_the_soil_and_their_bounds(
    soil: Soil, low: float, high: float, middle: float
) -> None:
    """Published: Table 3.2.IV; in the middle F0 a_g/g = 2.5 .25 = .625 by hand."""
    strong, weak, between = (
        ElasticSpectrum(ag_g=ag, f0=2.5, tc_star_s=0.3, soil=soil) for ag in (1.0, 0.01, 0.25)
    )
    assert strong.ss == low
    assert weak.ss == high
    assert between.ss == pytest.approx(middle)


def test_periods_of_the_soils() -> None:
    """C_C at TC* = .25 s, by hand."""
    values = {"A": 1.0, "B": 1.1 * 4.0**0.2, "C": 1.05 * 4.0**0.33, "D": 2.5, "E": 1.15 * 4.0**0.4}
    for soil in SOIL_FACTORS:
        site = ElasticSpectrum(ag_g=0.2, f0=2.5, tc_star_s=0.25, soil=soil)  # type: ignore[arg-type]
        assert site.tc_s / 0.25 == pytest.approx(values[soil], rel=1e-13)


def test_topography_and_plain_numbers() -> None:
    hill = ElasticSpectrum(**SITE, soil="B", topography="T4")
    assert hill.peak_g == pytest.approx(0.24 * 1.4)
    for name, factor in (("T1", 1.0), ("T2", 1.2), ("T3", 1.2)):
        assert ElasticSpectrum(**SITE, soil="A", topography=name).st == factor  # type: ignore[arg-type]
    plain = ElasticSpectrum(**SITE, soil_factor=1.2, cc=hill.tc_s / 0.3, topography=1.4)
    for period in (0.0, 0.1, 0.5, 2.0, 4.0):
        assert plain.sa_g(period, 0.08) == pytest.approx(hill.sa_g(period, 0.08), rel=1e-13)


@given(
    st.floats(0.01, 0.5),
    st.floats(2.2, 3.0),
    st.floats(0.15, 0.6),
    st.sampled_from(sorted(SOIL_FACTORS)),
    st.floats(0.02, 0.3),
)
def test_the_branches_meet_and_displacements_grow_with_the_period(
    ag: float, f0: float, tc_star: float, soil: Any, damping: float
) -> None:
    site = ElasticSpectrum(ag_g=ag, f0=f0, tc_star_s=tc_star, soil=soil)
    for corner in (site.tc_s / 3.0, site.tc_s, site.td_s):
        before, after = (site.sa_g(corner * (1.0 + side * 1e-9), damping) for side in (-1, 1))
        assert before == pytest.approx(after, rel=1e-7)
    periods = [0.05 * k for k in range(1, 80)]
    moved = [site.displacement_m(period, damping) for period in periods]
    assert all(after >= before * (1.0 - 1e-12) for before, after in itertools.pairwise(moved))
    damped = [site.sa_g(period, damping + 0.05) for period in periods]
    assert all(
        one <= other
        for one, other in zip(
            damped, [site.sa_g(period, damping) for period in periods], strict=True
        )
    )
    assert site.sa_g(0.0, damping) == pytest.approx(site.peak_g, rel=1e-12)
    assert max(damped) <= site.peak_g * f0 * math.sqrt(10.0 / 7.0)


WRONG: list[tuple[dict[str, Any], str]] = [
    ({}, "soil is missing: the ground is a category from A to E, or soil_factor and cc"),
    ({"soil_factor": 1.2}, "soil is missing beside soil_factor alone"),
    ({"soil": "B", "cc": 1.2}, "soil and cc are both given"),
    ({"soil": "F"}, "it must be one of A, B, C, D, E"),
    ({"soil": "B", "ag_g": 2.5}, "ag_g = 2.5 is not valid"),
    ({"soil": "B", "ag_g": float("nan")}, "ag_g = nan is not valid"),
    ({"soil": "B", "f0": "2"}, "f0 = '2' is not valid"),
    ({"soil": "B", "topography": "T5"}, "give T1, T2, T3 or T4"),
    ({"soil_factor": 1.0, "cc": 4.0, "tc_star_s": 1.0}, "TC = C_C TC* = 4 s must be below TD"),
]  # fmt: skip


@every(("keys", "line"), WRONG)
def test_what_is_wrong_is_named(keys: dict[str, Any], line: str) -> None:
    with pytest.raises(RocksteadyError) as refusal:
        ElasticSpectrum(**{**SITE, **keys})
    assert line in str(refusal.value)


@every(("period", "damping"), [(-0.1, 0.05), (61.0, 0.05), (1.0, 0.0), (1.0, 8)])
def test_periods_and_dampings_out_of_range_are_refused(period: float, damping: float) -> None:
    with pytest.raises(RocksteadyError):
        ElasticSpectrum(**SITE, soil="A").sa_g(period, damping)


def test_numbers_of_a_site_reach_the_ends_of_their_ranges_and_no_further() -> None:
    usual: dict[str, Any] = {
        "ag_g": 0.2,
        "f0": 2.5,
        "tc_star_s": 0.3,
        "soil_factor": 1.2,
        "cc": 1.4,
    }
    wrong = []
    for key, low, high in (
        *(("ag_g", 0.001, 1.0), ("f0", 1.5, 5.0), ("tc_star_s", 0.05, 1.0)),
        *(("soil_factor", 0.5, 4.0), ("cc", 0.5, 4.0), ("topography", 1.0, 2.0)),
    ):
        step = 1e-6 * (high - low)
        for value, taken in (
            *((low - step, False), (low, True), (high, True), (high + step, False)),
        ):
            try:
                ElasticSpectrum(**{**usual, key: value})
                result = True
            except InputError:
                result = False
            if result != taken:
                wrong.append((key, value))
    assert wrong == []
    site = ElasticSpectrum(**usual)
    for period, taken in ((-1e-9, False), (0.0, True), (60.0, True), (60.001, False)):
        if taken:
            assert site.sa_g(period, 0.05) > 0.0
        else:
            with pytest.raises(InputError, match=r"^period_s = "):
                site.sa_g(period, 0.05)
    for damping, taken in ((0.0, False), (1e-9, True), (1.0 - 1e-9, True), (1.0, False)):
        if taken:
            assert site.displacement_m(1.0, damping) > 0.0
        else:
            with pytest.raises(InputError, match=r"^damping = "):
                site.displacement_m(1.0, damping)


def test_grounds_of_the_table() -> None:
    """Categories by hand at a_g F0 = .5: S_S within its bounds and C_C of Table 3.2.IV."""
    for soil, factor, cc in (
        *(("A", 1.0, 1.0), ("B", 1.2, 1.1 * 0.3**-0.2), ("C", 1.7 - 0.6 * 0.5, 1.05 * 0.3**-0.33)),
        *(("D", 2.4 - 1.5 * 0.5, 1.25 * 0.3**-0.5), ("E", 2.0 - 1.1 * 0.5, 1.15 * 0.3**-0.4)),
    ):
        site = ElasticSpectrum(ag_g=0.2, f0=2.5, tc_star_s=0.3, soil=soil)  # type: ignore[arg-type]
        assert site.ss == pytest.approx(factor), soil
        assert site.tc_s == pytest.approx(0.3 * cc), soil
        assert site.td_s == pytest.approx(2.4)
        weak = ElasticSpectrum(ag_g=0.01, f0=2.5, tc_star_s=0.3, soil=soil)  # type: ignore[arg-type]
        strong = ElasticSpectrum(ag_g=0.9, f0=2.5, tc_star_s=0.3, soil=soil)  # type: ignore[arg-type]
        most = {"A": 1.0, "B": 1.2, "C": 1.5, "D": 1.8, "E": 1.6}[soil]
        assert (weak.ss, strong.ss) == (most, 0.9 if soil == "D" else 1.0), soil
    for topography, factor in (("T1", 1.0), ("T2", 1.2), ("T3", 1.2), ("T4", 1.4), (1.3, 1.3)):
        site = ElasticSpectrum(
            ag_g=0.2,
            f0=2.5,
            tc_star_s=0.3,
            soil="A",
            topography=topography,  # type: ignore[arg-type]
        )
        assert site.st == factor
        assert site.peak_g == pytest.approx(0.2 * factor)
