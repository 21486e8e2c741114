"""Motions on a design spectrum: a known stretch is found, and the cases of the design hold."""

from typing import Any

import numpy as np
import pytest

from rocksteady import BaseMotion, Record
from rocksteady.codes import make_design_spectrum
from rocksteady.errors import InputError
from rocksteady.measures import compute_response_spectrum
from rocksteady.motions import Floor, make_synthetic_suite, place_on_spectrum
from rocksteady.risk import make_built_in_suite
from rocksteady.risk.counted.motions import across, folds
from rocksteady.risk.counted.placing import STEPS
from tests.every import every
from tests.risk.counted.recorded import G, described, judged, real_suite

ROCK, STIFF = "en1998-1:2004:type1:A:ag=0.25", "en1998-1:2004:type1:D:ag=0.375"
AMERICAN = "asce7-16:sds=1.0:sd1=0.6:tl=8"


@every("place", [60, 100, 120, 165])
def test_a_record_is_stretched_by_what_its_own_spectrum_was(place: int) -> None:
    """The spectrum of a record that is longer k times is its own at T/k, by exact spectra."""
    (record,), k = make_synthetic_suite(1, seed=4), float(STEPS[place])
    periods = np.geomspace(0.02, 6.0, 300)
    exact = compute_response_spectrum(record, periods / k).pseudo_acceleration_m_s2
    peak = record.peak_acceleration_m_s2
    rows = np.column_stack([periods, 0.4 * exact / peak])
    found = place_on_spectrum([record], make_design_spectrum(rows, pga_g=0.4))
    assert found.stretches == pytest.approx([k], rel=1e-12)
    assert found.placing is not None
    assert found.placing.misfit < 0.03
    (made,) = found.motions
    assert isinstance(made, Record)
    np.testing.assert_allclose(made.acceleration_m_s2, 0.4 * G / peak * record.acceleration_m_s2)
    assert made.dt_s == pytest.approx(k * record.dt_s)


CASES: list[tuple[tuple[float, float], dict[str, Any], str, dict[str, Any]]] = [
    ((0.32, 1.8), {}, ROCK, {"falls": 26, "band": (0.052, 0.151), "beyond": 0.204,
     "near": (0.057, 21), "pgv": (0.223, 0.172, 0.272), "stretch": (2.42, 6.73), "misfit": 0.32}),
    ((0.6, 2.0), {}, STIFF, {"falls": 180, "band": (0.556, 0.723), "beyond": 0.739,
     "near": (0.679, 38), "pgv": (0.768, 0.564, 1.046), "stretch": (1.54, 8.0), "misfit": 0.303}),
    ((0.15, 0.45), {}, AMERICAN, {"falls": 46, "band": (0.099, 0.249), "beyond": 0.514,
     "near": (0.15, 40), "pgv": (0.567, 0.442, 0.723), "stretch": (1.65, 8.0), "misfit": 0.305}),
    ((0.6, 1.8), {"records": 28}, "asce7-16:sds=1.5:sd1=0.9:tl=8",
     {"falls": 78, "band": (0.439, 0.671), "beyond": 0.7, "near": (0.588, 17),
      "pgv": (0.866, 0.672, 1.101), "stretch": (1.76, 8.0), "misfit": 0.303}),
    ((0.6, 2.0), {"floor": True}, ROCK, {"falls": 9, "band": (0.01, 0.075), "beyond": 0.075,
     "near": (0.086, 21), "pgv": (0.223, 0.172, 0.272), "stretch": (2.42, 6.73), "misfit": 0.32}),
    ((0.32, 1.8), {"built_in": True}, ROCK, {"falls": 36, "band": (0.08, 0.193), "beyond": 0.225,
     "near": None, "pgv": (0.211, 0.183, 0.271), "stretch": (1.58, 2.0), "misfit": 0.207}),
]  # fmt: skip
"""Objects, motions and spectra of the design, with its values: of a trial of its own."""


@every(("size", "how", "spectrum", "expected"), CASES)
def test_cases_of_the_design_hold(
    size: tuple[float, float], how: dict[str, Any], spectrum: str, expected: dict[str, Any]
) -> None:
    """In whatever order the records come."""
    records: Any = [*reversed(real_suite()[: how.get("records")])]
    motions = make_built_in_suite(56) if "built_in" in how else records
    floor = Floor(frequencies_hz=2.0, damping=0.05, shapes=1.5) if "floor" in how else None
    centre = {"mass_centre_height_m": 0.95} if floor else {}
    one = described(*size, geometry=centre, demand={"spectrum": spectrum})
    found = judged(one, motions, floor=floor)
    assert found.count is not None
    assert found.beyond is not None
    assert found.shaking is not None
    assert (placing := found.shaking.placing) is not None
    assert abs(found.count.falls - expected["falls"]) <= 0.03 * found.count.runs
    assert found.count.band == pytest.approx(expected["band"], abs=0.03)
    assert found.beyond.share == pytest.approx(expected["beyond"], abs=0.03)
    assert placing.pgv_range_m_s == pytest.approx(expected["pgv"], rel=0.03)
    largest = float(folds(found.shaking.stretches).max())
    median = float(np.median(folds(found.shaking.stretches)))
    assert (median, largest) == pytest.approx(expected["stretch"], rel=0.04)
    assert placing.misfit == pytest.approx(expected["misfit"], abs=0.02)
    near = None if found.near is None else (found.near.share, found.near.records)
    assert near == (expected["near"] and pytest.approx(expected["near"], abs=0.03))
    assert found.decision.verdict == ("red" if found.count.band[0] > 0.1 else "not-shown")
    peaks = [across(each).reference.peak_acceleration_m_s2 / G for each in found.shaking.motions]
    assert peaks == pytest.approx([found.shaking.level] * len(peaks), rel=1e-12)


def test_verticals_have_the_same_factors_and_motions_of_floors_are_refused() -> None:
    suite = make_synthetic_suite(4, seed=3)
    pairs = [BaseMotion(each, each.scaled(0.5)) for each in suite]
    found = place_on_spectrum(pairs, ROCK)
    for own, made, stretch in zip(suite, found.motions, found.stretches, strict=True):
        assert isinstance(made, BaseMotion)
        assert isinstance(made.vertical, Record)
        assert made.vertical.dt_s == pytest.approx(stretch * own.dt_s)
        assert made.vertical.peak_acceleration_m_s2 == pytest.approx(0.5 * 0.25 * G)
    with pytest.raises(InputError, match="those of a floor"):
        place_on_spectrum([Floor(frequencies_hz=2.0).motion(suite[0])], ROCK)
    with pytest.raises(InputError, match="there must be one or more"):
        place_on_spectrum([], ROCK)


@every(
    ("width", "demand", "reason"),
    [
        (1.2, {"spectrum": ROCK}, ""),
        (0.42, {"spectrum": ROCK, "place": "floor"}, "floor-spectrum"),
        (1.2, {"spectrum": {"period_s": [0.0, 0.2, 4.0], "sa_g": [0.9, 1.0, 0.2]}}, "odd-peak"),
        (0.5, {"spectrum": {"period_s": [0.0, 0.2, 4.0], "sa_g": [0.2, 0.3, 0.2]}}, "odd-peak"),
        (1.2, {"spectrum": {"period_s": [0.0, 0.3, 0.6, 0.9, 4.0],
                            "sa_g": [0.8, 1.0, 3.9, 0.1, 0.02]}}, "far-off"),
    ],
)  # fmt: skip
def test_spectra_on_which_nothing_is_green(
    width: float, demand: dict[str, Any], reason: str
) -> None:
    """A wide object, of which hardly one falls; of a divided spectrum even one that stands."""
    if isinstance(demand["spectrum"], dict):
        demand["spectrum"]["damping"] = 0.05
    found = judged(described(width, 1.8, demand=demand), [*make_synthetic_suite(40, seed=1)])
    assert found.decision.reason == reason
    assert found.decision.doubts == ((reason,) if reason else ())
    assert (found.decision.verdict in ("green", "stands")) == (not reason)
