"""Rows at their own thresholds, at the edges of their ranges, and with one peak alone."""

import math
from pathlib import Path
from typing import Any

import pytest

from rocksteady import Block, Demand, check_facade, screen_block
from rocksteady.codes import ElasticSpectrum, Facade, FacadeDemand
from rocksteady.results.numbers import number
from rocksteady.risk.screens._rows import LEAST_NUMBER
from rocksteady.risk.screens.cabinets import CABINETS, INCH_M
from rocksteady.risk.screens.friction import uplift_acceleration_g
from rocksteady.risk.screens.screen import Kind, Screen
from rocksteady.risk.screens.thresholds import (
    circolare_rectangle,
    ishiyama_bounds,
    kaneko_hayashi,
    shares_at,
)
from tests.every import every

BLOCK = Block.rectangle(width=0.32, height=1.8)
G = 9.80665
GUIDE = Path(__file__).parents[3] / "docs/guides/screens.md"
ASCE = "ASCE 43-05 rocking"
NUMBER, CABINET = "p PGV/(g tan alpha)", "FEMA P-58 cabinets"
KINDS: dict[str, Kind] = {"Circolare rectangle": "wall", CABINET: "cabinet", ASCE: "cask"}


def row(name: str, block: Block = BLOCK, friction: float | None = None, **demand: Any) -> Screen:
    found = screen_block(block, Demand(**demand), friction=friction, object_kind=KINDS.get(name))
    return found.row(name)


MORE = 1e-8
"""More than rounding does."""


def below(value: float) -> float:
    return value * (1.0 - MORE)


def above(value: float) -> float:
    return value * (1.0 + MORE)


def details(found: Screen) -> dict[str, Any]:
    return {name: (value, unit) for name, value, unit in found.details}


def test_a_peak_at_uplift_itself_holds_the_block_down_in_every_row() -> None:
    """The moments are then equal: no row may speak of another motion than its neighbour."""
    gate = uplift_acceleration_g(BLOCK)
    for pga, rests in ((gate, True), (math.nextafter(gate, 1.0), True), (above(gate), False)):
        found = screen_block(BLOCK, Demand(pga_g=pga, pgv_m_s=5.0), friction=2.0)
        assert (found.motion == "rest") is rests
        assert found.row("uplift").verdict.startswith("stays down" if rests else "lifts")
        assert found.row("friction to rock").verdict.startswith("stays at rest") is rests
        assert found.row(NUMBER).passes is rests
        impacts = details(found.row("friction to rock"))["at impacts"][0]
        assert (impacts == 0.0) is rests
    soft = Block.rectangle(width=0.3, height=1.8, restitution=0.8)
    need = row("friction to rock", soft, pga_g=0.2).value
    assert need == pytest.approx(6.0 * 0.2 / 1.8)  # of its impacts, (1 - e)/(1 + e) h/b


def test_a_peak_at_a_bound_reaches_it() -> None:
    """Ishiyama's bounds are the least peaks of blocks that fell, the other rows medians."""
    bounds, half = ishiyama_bounds(BLOCK.positive, G), kaneko_hayashi(BLOCK.positive, G)
    ishiyama, kaneko, circolare = "Ishiyama bound", "Kaneko-Hayashi 50 %", "Circolare rectangle"
    assert row(ishiyama, pga_g=below(bounds.pga_g)).passes is True
    assert row(ishiyama, pgv_m_s=below(bounds.pgv_m_s)).passes is True
    at_both: dict[str, Any] = {"pga_g": bounds.pga_g, "pgv_m_s": bounds.pgv_m_s}
    assert row(ishiyama, **at_both).passes is False
    assert row(ishiyama, **(at_both | {"pga_g": below(bounds.pga_g)})).passes is True
    assert row(ishiyama, **(at_both | {"pgv_m_s": below(bounds.pgv_m_s)})).passes is True
    # A slow floor: below Fe the acceleration decides.
    assert row(kaneko, pga_g=half.acceleration_g, pgv_m_s=9.0).passes is False
    assert "more than half" in row(kaneko, pga_g=half.acceleration_g, pgv_m_s=9.0).verdict
    slower = row(kaneko, pga_g=below(half.acceleration_g), pgv_m_s=9.0)
    assert slower.passes is None
    assert "fewer than half" in slower.verdict
    for name, value in (("pga_g", half.acceleration_g), ("pgv_m_s", half.velocity_m_s)):
        assert not row(kaneko, **dict[str, Any]({name: below(value)})).needs
        assert row(kaneko, **dict[str, Any]({name: value})).needs
    # The acceleration that activates a mechanism does not yet exceed its capacity.
    poor = circolare_rectangle(BLOCK.positive, G, 1.35).a0_lumped_g
    assert [row(circolare, pga_g=pga).passes for pga in (poor, above(poor))] == [True, False]
    cabinet = next(each for each in CABINETS if each.row in row(CABINET, pgv_m_s=0.1).equation)
    median = cabinet.median_m_s
    assert [row(CABINET, pgv_m_s=pgv).passes for pgv in (below(median), median)] == [None, False]


def test_the_velocity_number_passes_below_a_fifth() -> None:
    per_number = G * math.tan(BLOCK.alpha) / BLOCK.p
    for level, passes in ((0.19, True), (0.1999999, True), (0.2000001, False), (0.3, False)):
        found = row(NUMBER, pgv_m_s=level * per_number)
        assert found.passes is passes
        assert found.value == pytest.approx(level)
        shown = details(found)
        assert (shown["published"][0], shown["this package"][0]) == shares_at(found.value or 0.0)
    assert "below 0.2 only" in row(NUMBER, pgv_m_s=1.0).remark
    # PGV at the median is 0.757 of it, and half of such blocks fall there.
    middle, unit = details(row(NUMBER))["PGV at 0.757"]
    assert unit == "m/s"
    assert shares_at(row(NUMBER, pgv_m_s=middle).value or 0.0)[0] == pytest.approx(0.5)


@every(
    ("alpha", "p", "inside"),
    [
        (0.1001, 2.0, True), (0.0999, 2.0, False), (0.2999, 2.0, True), (0.3001, 2.0, False),
        (0.2, 1.001, True), (0.2, 0.999, False), (0.2, 2.999, True), (0.2, 3.001, False),
    ],
)  # fmt: skip
def test_the_runs_behind_the_shares_end_where_the_remark_says(
    alpha: float, p: float, inside: bool
) -> None:
    found = row(NUMBER, Block.from_p(alpha=alpha, p=p), pgv_m_s=0.5)
    assert found.status == ("computed" if inside else "approximate")
    outside = "outside the latter: alpha 0.1 to 0.3 rad, p 1 to 3 rad/s"
    assert (outside in found.remark) is not inside


@every(("distance", "near"), [(0.249, True), (0.251, False)])
@every("way", [0.0, 0.5 * math.pi])
def test_a_cabinet_has_a_verdict_up_to_a_quarter_away(
    distance: float, near: bool, way: float
) -> None:
    last = CABINETS[-1]  # a corner of the table: nothing else is near to what is larger
    block = Block.rectangle(
        width=INCH_M * last.depth_in * math.exp(distance * math.cos(way)),
        height=INCH_M * last.height_in * math.exp(distance * math.sin(way)),
    )
    found = row(CABINET, block, pgv_m_s=9.0)
    assert f"at a distance of {number(distance)} in" in found.remark
    assert (found.value is not None) is near
    assert (found.status, found.needs) == ("computed" if near else "refused", "")
    assert found.passes is (False if near else None)
    assert ("no cabinet is near" in found.verdict) is not near
    assert ("probability" in [name for name, _, _ in found.details]) is near
    assert "18.6 x 67.75 in" in found.remark


def test_what_is_missing_beside_one_peak_above_its_bounds() -> None:
    for name in ("Ishiyama bound", "Kaneko-Hayashi 50 %"):
        fast, strong = row(name, pgv_m_s=9.0), row(name, pga_g=9.0)
        assert (fast.verdict, fast.needs) == ("needs a PGA", "pga_g")
        assert (strong.verdict, strong.needs) == ("needs a PGV", "pgv_m_s")


def test_the_circolares_details_are_those_of_both_confidence_factors() -> None:
    slope, name = 0.32 / 1.8, "Circolare rectangle"
    found = details(row(name))
    for factor, words in ((1.0, "FC 1"), (1.35, "FC 1.35")):
        assert found[f"a0, e* 1, {words}"] == (pytest.approx(slope / factor), "g")
        assert found[f"a0, e* 0.75, {words}"] == (pytest.approx(slope / 0.75 / factor), "g")
        # The confidence factor divides the acceleration alone: periods grow with its root.
        for limit, part, share in (("SLV", 1.68, 0.4), ("SLC", 1.56, 0.6)):
            secant = share * found["d0"][0] / (slope * G / 0.75 / factor * (1.0 - share))
            period = part * math.pi * math.sqrt(secant)
            assert found[f"T_{limit}, {words}"] == (pytest.approx(period), "s")
    assert found["d0"] == (pytest.approx(2.0 / 3.0 * 0.32), "m")
    assert found["0.4 d0 (SLV)"][0] / 0.4 == pytest.approx(found["0.6 d0 (SLC)"][0] / 0.6)
    verdicts = [row(name, pga_g=part * slope).verdict for part in (0.7, 0.9, 1.1)]
    assert verdicts == [
        "S_e(0) below a0 with FC 1.35, without q",
        "S_e(0) below a0 with FC 1, above it with FC 1.35, without q",
        "S_e(0) above a0 with FC 1.35, without q",
    ]
    assert "q = 2 that SLV's linear check allows: `facade` makes the checks" in row(name).remark


def test_the_wall_that_its_row_does_not_pass_satisfies_slv_by_its_linear_check() -> None:
    """By hand: tan(alpha)/1.35 = 0.132 g lies between S_e(0)/2 and S_e(0)."""
    pga = 1.5 * 0.32 / 1.8 / 1.35
    wall = Facade(name="wall", thickness_m=0.32, height_m=1.8, confidence_factor=1.35)
    site = ElasticSpectrum(ag_g=pga, f0=2.5, tc_star_s=0.35, soil="A")
    found = check_facade(wall, FacadeDemand(slv=site))
    linear = next(each for each in found.checks if each.name == "SLV linear")
    assert row("Circolare rectangle", pga_g=pga).verdict.startswith("S_e(0) above a0")
    assert linear.satisfied


def test_the_guide_has_the_bar_of_the_velocity_row() -> None:
    guide = " ".join(GUIDE.read_text(encoding="utf-8").split())
    assert f"passes below {LEAST_NUMBER:g}," in guide
    assert f"Passed below {LEAST_NUMBER:g} only" in row(NUMBER).remark


def test_friction_that_governs_leaves_a_row_without_input_as_it_is() -> None:
    found = screen_block(BLOCK, Demand(pga_g=0.35), friction=0.05, object_kind="wall")
    assert found.motion == "slides"
    assert found.row("Circolare rectangle").status == "refused"
    assert found.row(NUMBER).status == "needs input"
    assert found.row(NUMBER).verdict == "needs a PGV"


def test_a_rectangle_is_known_by_its_inertia_and_its_equal_sides() -> None:
    for width, height, gyration in ((0.3, 1.2, None), (0.3, 1.2, 1.0), (0.3, 1.2, 1.001)):
        own = math.hypot(width, height) / math.sqrt(12.0)
        half = 0.5 * width
        block = Block.asymmetric(
            left=half, right=half, height=height,
            **({} if gyration is None else {"gyration": gyration * own}),
        )  # fmt: skip
        remark = row("Ishiyama bound", block).remark
        assert ("homogeneous rectangles" in remark) is (gyration == 1.001)
        assert "side that lifts first" not in remark


def test_the_value_shown_is_that_which_decides() -> None:
    """By hand: 0.32/1.8 g; 0.4 V_i, V_i^2 = 8 g R/3 (1 - cos alpha)/cos^2 alpha; A50 and V50."""
    radius, slope = 0.5 * math.hypot(0.32, 1.8), 0.32 / 1.8
    cosine = 0.9 / radius
    speed = 0.4 * math.sqrt(8.0 * G * radius / 3.0 * (1.0 - cosine)) / cosine
    v50 = 0.1 * 32.0 / math.sqrt(180.0) * (1.0 + slope) ** 2.5
    cases: tuple[tuple[str, dict[str, Any], float, str], ...] = (
        ("Ishiyama bound", {"pga_g": 0.1}, slope, "g"),
        ("Ishiyama bound", {"pga_g": 0.1, "pgv_m_s": 0.1}, slope, "g"),
        ("Ishiyama bound", {"pga_g": 0.1, "vertical_g": 0.2}, 0.8 * slope, "g"),
        ("Ishiyama bound", {"pgv_m_s": 0.1}, speed, "m/s"),
        ("Ishiyama bound", {"pga_g": 0.5, "pgv_m_s": 0.1}, speed, "m/s"),
        ("Kaneko-Hayashi 50 %", {"pga_g": 0.1}, slope * (1.0 + slope), "g"),
        ("Kaneko-Hayashi 50 %", {"pgv_m_s": 0.1}, v50, "m/s"),
    )
    for name, demand, value, unit in cases:
        found = row(name, **demand)
        assert found.value == pytest.approx(value, rel=1e-6), (name, demand)
        assert found.unit == unit, (name, demand)
