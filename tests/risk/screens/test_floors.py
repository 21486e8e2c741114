"""Accelerations of floors by three codes: values by hand, peaks, plateaus and what is refused."""

import math

import numpy as np
import pytest

from rocksteady.errors import InputError
from rocksteady.risk.screens.floors import floor_accelerations
from tests.every import every

PGA = 0.2
TABLE = ((0.05, 0.8, 1.4, 5.0), (0.499, 0.8, 1.4, 5.0), (0.5, 0.3, 1.2, 4.0), (1.0, 0.3, 1.2, 4.0))
LONG = ((1.001, 0.3, 1.0, 2.5), (4.0, 0.3, 1.0, 2.5))
"""T_1, a, b and a_p by table C7.2.II of the Circolare of 2019."""


def at(period: float, code: str, t1: float, z: float) -> float:
    """Return the acceleration of one component over the peak of the ground."""
    found = floor_accelerations([period], pga_g=PGA, building_period_s=t1, height_ratio=z)
    return float(found[code][0]) / PGA


@every("z", [0.0, 0.3, 1.0])
@every(("t1", "a", "b", "most"), [*TABLE, *LONG])
def test_the_circolare_rises_to_a_plateau_and_falls_behind_it(
    t1: float, a: float, b: float, most: float, z: float
) -> None:
    """At period 0 it is that of the floor, 1 + z/H, and on the plateau a_p times that."""
    code = "NTC 2018"
    assert at(0.0, code, t1, z) == pytest.approx(1.0 + z)
    for part in (0.0, 0.5, 1.0):
        plateau = a + part * (b - a) * (1.0 - 1e-9)
        assert at(plateau * t1, code, t1, z) == pytest.approx((1.0 + z) * most)
    assert at(a * t1 * (1.0 - 1e-9), code, t1, z) == pytest.approx((1.0 + z) * most)
    assert at(b * t1 * (1.0 + 1e-9), code, t1, z) == pytest.approx((1.0 + z) * most)
    # Twice as far from the plateau: 1 + (a_p - 1) q^2 is what divides a_p.
    for part in (0.25, 0.5, 0.75):
        share = most / (1.0 + (most - 1.0) * (1.0 - part) ** 2)
        assert at(part * a * t1, code, t1, z) == pytest.approx((1.0 + z) * share)
    for part in (1.5, 2.0, 3.0):
        share = (1.0 + z) * most / (1.0 + (most - 1.0) * (part - 1.0) ** 2)
        assert at(part * b * t1, code, t1, z) == pytest.approx(max(share, 1.0))
    assert at(1e6, code, t1, z) == 1.0


@every("z", [0.0, 0.4, 1.0])
@every("t1", [0.05, 0.5, 2.0])
def test_eurocode_8_peaks_at_the_period_of_the_building(t1: float, z: float) -> None:
    code = "EN 1998-1"
    assert at(t1, code, t1, z) == pytest.approx(3.0 * (1.0 + z) - 0.5)
    assert at(0.0, code, t1, z) == pytest.approx(max(1.5 * (1.0 + z) - 0.5, 1.0))
    for part in (0.1, 0.3, 0.7):
        below, above = (at((1.0 + sign * part) * t1, code, t1, z) for sign in (-1.0, 1.0))
        assert below == pytest.approx(above)
        assert below == pytest.approx(max(3.0 * (1.0 + z) / (1.0 + part * part) - 0.5, 1.0))
    assert at(50.0 * t1, code, t1, z) == 1.0


@every(
    ("t1", "z", "ratio"),
    [
        *[(0.3, 0.0, 1.0), (0.3, 1.0, 3.5), (0.4, 1.0, 3.5), (0.41, 0.0, 1.0)],
        *[(0.5, 1.0, 3.36), (1.0, 1.0, 2.84), (2.0, 1.0, 2.46), (2.0, 0.5, 1.25 + 0.96 / 1024.0)],
        *[(0.1, 0.5, 2.25), (0.8, 0.9, 1.0 + 1.125 + 0.75 * 0.9**10)],
    ],
)
def test_asce_7_22_is_that_of_the_floor_for_all_components(
    t1: float, z: float, ratio: float
) -> None:
    for period in (0.0, 0.2, t1, 9.0):
        assert at(period, "ASCE 7-22", t1, z) == pytest.approx(ratio)


def test_floors_in_proportion_to_the_ground_and_of_any_periods() -> None:
    periods = np.array([[0.0, 0.2], [0.5, math.nextafter(0.5, 1.0)]])
    result = floor_accelerations(periods, pga_g=0.4, building_period_s=0.5, height_ratio=0.5)
    half = floor_accelerations(periods, pga_g=0.2, building_period_s=0.5, height_ratio=0.5)
    assert list(result) == ["ASCE 7-22", "EN 1998-1", "NTC 2018"]
    for code, values in result.items():
        assert values.shape == (2, 2)
        np.testing.assert_allclose(values, 2.0 * half[code], rtol=1e-14)
    empty = floor_accelerations([], pga_g=0.4, building_period_s=0.5, height_ratio=0.5)
    assert all(values.shape == (0,) for values in empty.values())


def test_numbers_that_are_none_of_a_floor() -> None:
    good = {"pga_g": 0.2, "building_period_s": 0.5, "height_ratio": 1.0}
    for name, wrong in (
        *(("pga_g", 0.0), ("pga_g", -0.2), ("building_period_s", 0.0099), ("height_ratio", -0.01)),
        *(("building_period_s", 60.1), ("height_ratio", 1.01), ("pga_g", True)),
    ):
        with pytest.raises(InputError, match=f"^{name} = "):
            floor_accelerations([0.1], **{**good, name: wrong})
    for edge in ({"building_period_s": 0.01}, {"building_period_s": 60.0}, {"height_ratio": 0.0}):
        assert floor_accelerations([0.1], **{**good, **edge})
    for periods in ([-0.1], [0.1, math.nan], [math.inf]):
        with pytest.raises(InputError, match="all must be 0 or above; give seconds"):
            floor_accelerations(periods, **good)
    assert floor_accelerations([0.0], **good)
