"""Every screen with and without vertical motion: closed formulas by hand, or the reason why not."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, Demand, Record, screen_block
from rocksteady.codes import Screens
from rocksteady.risk.screens.screen import Screen
from tests.every import every

WIDTH, HEIGHT, G = 2.4, 4.3, 9.80665
CASK = Block.rectangle(width=WIDTH, height=HEIGHT)
SLOPE = WIDTH / HEIGHT
FLAT = [[0.01, 0.7], [50.0, 0.7]]
"""0.7 g at every period: no damping but the factor moves it."""
ASCE, NUMBER, CABINET = "ASCE 43-05 rocking", "p PGV/(g tan alpha)", "FEMA P-58 cabinets"


def screened(**given: Any) -> Screens:
    demand = Demand(**{"pga_g": 0.6, "pgv_m_s": 0.9, "spectrum": FLAT, **given})
    return screen_block(CASK, demand, friction=2.0)


def details(row: Screen) -> dict[str, float]:
    return {name: value for name, value, _ in row.details}


def damping() -> float:
    """Return the effective damping: gamma/sqrt(4 pi^2 + gamma^2) of Housner's restitution."""
    gamma = -2.0 * math.log(1.0 - 1.5 * SLOPE**2 / (1.0 + SLOPE**2))
    return gamma / math.hypot(2.0 * math.pi, gamma)


def rotation(sa_g: float, ratio: float) -> float:
    """Return the angle at which 2 (f1 - 1)/(F_v t) falls to a constant spectrum, by halving."""
    factor = math.sqrt(1.0 + (SLOPE * ratio) ** 2)
    low, high = 1e-9, math.atan(SLOPE)
    for _ in range(200):
        t = 0.5 * (low + high)
        capacity = 2.0 * (math.cos(t) + SLOPE * math.sin(t) - 1.0) / (factor * t)
        low, high = (t, high) if capacity > sa_g else (low, t)
    return low


@every(
    ("given", "ratio"),
    [
        ({}, 0.0),
        ({"vertical_g": 0.4}, 0.4 / 0.6),
        ({"vertical_g": 0.4, "vertical_share": 0.4}, 0.4 / 0.6),  # F_v combines by itself
        ({"vertical_g": 0.4, "sa_v_per_sa_h": 0.3}, 0.3),
        ({"vertical_g": 0.4, "sa_v_per_sa_h": 0.0}, 0.0),
        ({"sa_v_per_sa_h": 0.67}, 0.67),
    ],
)
def test_a_vertical_peak_reaches_the_row_of_asce_43(given: dict[str, float], ratio: float) -> None:
    """0.67 of stated spectra, or the ratio of the peaks; the larger the ratio the larger t."""
    sa = 1.5 * SLOPE
    table = [[0.01, sa], [50.0, sa]]
    row = screened(spectrum=table, spectrum_damping=damping(), **given).row(ASCE)
    # The capacity begins at 2 tan(alpha)/F_v and falls with t.
    assert row.value == pytest.approx(rotation(sa, ratio), rel=1e-9)
    assert details(row)["F_v"] == pytest.approx(math.hypot(1.0, SLOPE * ratio))
    stated = "as stated" if "sa_v_per_sa_h" in given else "that of the peaks"
    words = f"SA_V/SA_H {ratio:.3g}, {stated}"
    assert (words in row.remark) is bool(given), row.remark


def test_a_vertical_peak_without_a_horizontal_one_is_missed_by_name() -> None:
    table = [[0.01, 0.7], [50.0, 0.7]]
    for kind, suffix in (("cask", ""), (None, "; made for nuclear facilities")):
        demand = Demand(spectrum=table, spectrum_damping=0.1, vertical_g=0.2)
        row = screen_block(CASK, demand, object_kind=kind).row(ASCE)  # type: ignore[arg-type]
        assert (row.passes, row.value, row.status) == (None, None, "needs input")
        assert row.verdict == f"needs a PGA or SA_V/SA_H{suffix}"
        assert row.needs == "pga_g or sa_v_per_sa_h"
    known = Demand(spectrum=[[0.0, 0.5], *table], spectrum_damping=0.1, vertical_g=0.2)
    assert details(screen_block(CASK, known).row(ASCE))["SA_V/SA_H"] == pytest.approx(0.4)


@every(("vertical", "share"), [(0.0, 1.0), (0.3, 1.0), (0.3, 0.4), (0.5, 1.0), (0.5, 0.0)])
def test_thresholds_of_accelerations_take_it_from_gravity(vertical: float, share: float) -> None:
    """By hand: (g - a_v) tan(alpha) in uplift, in Ishiyama's PGA and, over FC 1.35, in a0."""
    found = screened(vertical_g=vertical, vertical_share=share)
    gravity = 1.0 - share * vertical
    assert found.row("uplift").value == pytest.approx(gravity * SLOPE)
    ishiyama = found.row("Ishiyama bound")
    assert details(ishiyama)["PGA bound"] == pytest.approx(gravity * SLOPE)
    walls = details(found.row("Circolare rectangle"))
    assert found.row("Circolare rectangle").value == pytest.approx(gravity * SLOPE / 1.35)
    for factor in (1.0, 1.35):
        for name, mass in (("e* 1", 1.0), ("e* 0.75", 0.75)):
            expected = gravity * SLOPE / (mass * factor)
            assert walls[f"a0, {name}, FC {factor:g}"] == pytest.approx(expected)
    a, need = 0.6 / gravity, SLOPE
    if a > SLOPE:  # Shenton
        need = (a * (1.0 + 4.0 * SLOPE**2) + 3.0 * SLOPE) / (4.0 + SLOPE**2 + 3.0 * a * SLOPE)
    assert found.row("friction to rock").value == pytest.approx(max(need, 0.0))


@every(
    ("pga", "lifts"),
    [(0.99 * 0.7 * SLOPE, False), (1.01 * 0.7 * SLOPE, True), (0.99 * SLOPE, True)],
)
def test_no_row_says_that_it_stays_where_another_says_that_it_lifts(
    pga: float, lifts: bool
) -> None:
    found = screened(pga_g=pga, pgv_m_s=9.0, vertical_g=0.3)
    assert found.row("uplift").verdict.startswith("lifts" if lifts else "stays down")
    assert found.row("Ishiyama bound").passes is not lifts
    assert (found.row(NUMBER).verdict == "stays down: PGA below uplift") is not lifts
    assert (found.motion == "rocks") is lifts


def test_what_reverses_in_a_swing_and_medians_leave_it_out() -> None:
    plain, shaken = screened(), screened(vertical_g=0.3, vertical_share=0.5)
    for name in ("restitution", "Ishiyama bound", "Kaneko-Hayashi 50 %", NUMBER, CABINET):
        assert shaken.row(name).value == plain.row(name).value, name
    for name in ("T_SLV, FC 1", "T_SLC, FC 1.35", "d0"):
        walls = [details(found.row("Circolare rectangle"))[name] for found in (plain, shaken)]
        assert walls[0] == walls[1], name


@every(
    ("given", "words"),
    [
        ({"vertical_g": 0.3}, ""),
        ({"vertical_g": 0.3, "vertical_share": 0.0}, "none at the horizontal peak"),
        ({"sa_v_per_sa_h": 0.67}, "left out, as SA_V/SA_H is stated alone; give vertical_g too"),
        ({}, None),
    ],
)
def test_every_row_with_an_answer_states_its_use_of_vertical_motion(
    given: dict[str, float], words: str | None
) -> None:
    uses = {"uplift", "friction to rock", "Ishiyama bound", "Circolare rectangle", NUMBER}
    for row in screened(spectrum_damping=0.05, **given).rows:
        assert row.remark.count("Vertical motion: ") == (words is not None), row.name
        if words:
            assert (f"Vertical motion: {words}" in row.remark) is (row.name in uses), row.name


def test_a_record_brings_the_ratio_of_its_peak() -> None:
    record = Record(acceleration_m_s2=np.array([0.0, 3.0, -3.0, 0.0, 0.0]), dt_s=0.3)
    row = screen_block(CASK, Demand.from_record(record, vertical_g=0.2)).row(ASCE)
    assert details(row)["SA_V/SA_H"] == pytest.approx(0.2 * G / 3.0)
