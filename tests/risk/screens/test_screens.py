"""All screens of a block: values, verdicts, missing inputs, and friction that governs."""

import math
from pathlib import Path

import pytest

from rocksteady import Block, Demand, screen_block
from rocksteady.codes import Screens
from rocksteady.errors import InputError
from rocksteady.risk.screens.screen import Kind
from tests.every import every

G = 9.80665
BLOCK = Block.rectangle(width=0.32, height=1.8)
PEAKS = Demand(pga_g=0.35, pgv_m_s=0.4)
SPECTRUM = [[0.0, 0.35], [0.1, 0.8], [0.4, 0.8], [1.0, 0.32], [2.0, 0.16], [4.0, 0.04]]
NAMES = (
    "uplift",
    "friction to rock",
    "restitution",
    "Ishiyama bound",
    "Kaneko-Hayashi 50 %",
    "p PGV/(g tan alpha)",
    "ASCE 43-05 rocking",
    "Circolare rectangle",
    "FEMA P-58 cabinets",
)
ROCKING = NAMES[3:]
ASCE = "ASCE 43-05 rocking"


def full(friction: float | None = 0.4, block: Block = BLOCK, kind: Kind | None = None) -> Screens:
    demand = Demand(pga_g=0.35, pgv_m_s=0.4, spectrum=SPECTRUM, spectrum_damping=0.05)
    return screen_block(block, demand, friction=friction, object_kind=kind)


def test_against_a_wall_rows_are_of_the_free_side_and_those_for_both_sides_say_so() -> None:
    free, wall = full(), full(block=BLOCK.against_wall())
    assert wall.row("uplift").value == free.row("uplift").value
    for name in ROCKING:
        one, other = free.row(name), wall.row(name)
        assert one.value == other.value
        assert one.status == "computed"
        marked = name != "Circolare rectangle"  # which is made for walls
        assert other.status == ("approximate" if marked else "computed")
        assert ("the wall is left out" in other.remark) == marked
    # Angular momentum on base, wall and base of a rectangle.
    square = math.sin(BLOCK.alpha) ** 2
    ratio = (1.0 - 1.5 * square) ** 2 * (1.5 * (1.0 - square) - 1.0)
    assert wall.row("restitution").value == pytest.approx(ratio, rel=1e-13)
    stocky = screen_block(Block.rectangle(width=1.0, height=1.0).against_wall(0.1), PEAKS)
    assert stocky.row("restitution").value is None
    assert "no answer" in stocky.row("restitution").verdict


def test_the_restitution_of_a_frame_is_that_of_columns_and_cap() -> None:
    frame = Block.frame(columns=4, cap_mass_ratio=1.5, width=0.6, height=3.3)
    row = screen_block(frame, PEAKS).row("restitution")
    assert row.value == pytest.approx(frame.restitution, rel=1e-13)
    assert row.edition == "Makris 2013"
    assert screen_block(frame.against_wall(0.3), PEAKS).row("restitution").value is None


def test_of_unlike_sides_the_wall_leaves_the_free_one() -> None:
    leaning = Block.asymmetric(left=0.3, right=0.15, height=1.8)
    free, wall = (
        screen_block(block, PEAKS, friction=0.4) for block in (leaning, leaning.against_wall())
    )
    assert free.row("uplift").value == pytest.approx(0.15 / 0.9)
    assert wall.row("uplift").value == pytest.approx(0.3 / 0.9)
    assert (free.motion, wall.motion) == ("rocks", "rocks")
    # It needs the friction of its free side alone, and no other side is named.
    needed = [found.row("friction to rock").value or 0.0 for found in (free, wall)]
    assert 0.0 < needed[0] <= needed[1]
    assert not wall.row("uplift").details
    assert free.row("uplift").details


FALLING = [[0.1, 0.4], [0.4, 0.4], [0.8, 0.01], [1.0, 0.005]]
"""A spectrum that ends at 1 s; the period at alpha is 2.22 s."""


@every(
    ("table", "verdict", "passes", "roots"),
    [
        ([[period, 0.001 * value] for period, value in SPECTRUM], "does not overturn: no", True, 0),
        (SPECTRUM, "rocks up to", True, 2),
        ([[period, 9.0 * value] for period, value in SPECTRUM], "overturns", False, 0),
        # Its last root is passed: what follows of a falling spectrum can be left out.
        (FALLING, "rocks up to", True, 1),
        ([*FALLING[:3], [4.0, 4.0]], "may overturn beyond", False, 2),
        # It ends above the capacity, or has met it nowhere.
        ([*FALLING[:3], [1.0, 0.4]], "needs a spectrum up to 2.22 s", None, 2),
        ([[period, 0.01] for period, _ in FALLING], "needs a spectrum up to 2.22 s", None, 0),
    ],
)
def test_the_asce_row_passes_where_the_demand_ends_below_the_capacity(
    table: list[list[float]], verdict: str, passes: bool | None, roots: int
) -> None:
    demand = Demand(spectrum=table, spectrum_damping=0.05)
    row = screen_block(BLOCK, demand, object_kind="cask").row(ASCE)
    assert row.verdict.startswith(verdict)
    assert row.passes is passes
    assert row.status == ("needs input" if passes is None else "computed")
    assert row.needs == ("spectrum" if passes is None else "")
    found = [value for name, value, _ in row.details if name == "root"]
    assert len(found) == roots
    assert row.value == (found[-1] if found else None)
    assert ("It ends at 1 s: up to" in row.remark) is (table[-1][0] == 1.0)


def test_rows_without_their_input_say_what_they_need() -> None:
    found = screen_block(BLOCK, Demand())
    needs = {row.name: row.needs for row in found.rows if row.needs}
    assert needs == {
        "uplift": "pga_g",
        "friction to rock": "pga_g",
        "ASCE 43-05 rocking": "spectrum, spectrum_damping",
        "Ishiyama bound": "pga_g and pgv_m_s",
        "Kaneko-Hayashi 50 %": "pga_g and pgv_m_s",
        "Circolare rectangle": "pga_g",
        "p PGV/(g tan alpha)": "pgv_m_s",
        "FEMA P-58 cabinets": "pgv_m_s",
    }
    assert all("needs" in found.row(name).verdict for name in needs)
    assert not found.negative
    assert screen_block(BLOCK, PEAKS).row("friction to rock").needs == "friction"
    undamped = screen_block(BLOCK, Demand(spectrum=SPECTRUM)).row("ASCE 43-05 rocking")
    assert undamped.verdict == "needs its damping; made for nuclear facilities"
    assert undamped.needs == "spectrum_damping"


@pytest.mark.parametrize(("friction", "motion"), [(0.1, "slides"), (0.2, "slides and rocks")])
def test_rocking_is_refused_as_an_answer_where_friction_governs(
    friction: float, motion: str
) -> None:
    found = full(friction)
    assert found.motion == motion
    assert found.negative
    for name in ROCKING:
        row = found.row(name)
        assert row.status == "refused", name
        assert row.passes is None
        assert "friction governs" in row.verdict
    assert found.row("uplift").passes is None
    assert "it passes 0 of 0" in found.summary(more=True)


def test_formulas_with_fixed_units_have_no_answer_in_another_gravity() -> None:
    found = full(9.0, Block.rectangle(width=0.32, height=1.8, gravity=1.62))
    for name in ("Kaneko-Hayashi 50 %", "FEMA P-58 cabinets"):
        row = found.row(name)
        assert (row.status, row.value, row.passes, row.details) == ("refused", None, None, ())
        assert row.verdict.startswith("no answer: made for 9.81 m/s^2")
    ishiyama = found.row("Ishiyama bound")
    assert ishiyama.status == "computed"
    assert "10 B/sqrt(H)" not in [name for name, _, _ in ishiyama.details]
    assert "10 B/sqrt(H)" not in ishiyama.remark
    local = full(block=Block.rectangle(width=0.32, height=1.8, gravity=9.78))
    assert local.row("Kaneko-Hayashi 50 %").status == "computed"


def test_in_another_gravity_every_value_scales_with_its_unit() -> None:
    """Accelerations k times those on Earth and times over the root of k leave angles and shares."""
    k, found = 0.3, []
    for part in (1.0, k):
        root, block = math.sqrt(part), Block.rectangle(width=0.32, height=1.8, gravity=part * G)
        spectrum = [[period / root, part * value] for period, value in SPECTRUM[1:]]
        demand = Demand(
            pga_g=0.35 * part, pgv_m_s=0.4 * root, vertical_g=0.1 * part, spectrum=spectrum,
            spectrum_damping=0.05,
        )  # fmt: skip
        found.append(screen_block(block, demand, friction=0.3).rows)
    units, compared = {"g": k, "m/s": k**0.5, "s": k**-0.5, "Hz": k**0.5}, 0
    for one, other in zip(*found, strict=True):
        if other.status == "refused":  # a formula with fixed units
            continue
        ours = [
            *(each for each in one.details if each[0] != "10 B/sqrt(H)"),
            ("", one.value, one.unit),
        ]
        lighter = [*(each[1] for each in other.details), other.value]
        for (name, value, unit), light in zip(ours, lighter, strict=True):
            expected = (value or 0.0) * units.get(unit, 1.0)
            assert light == pytest.approx(expected, rel=1e-9), (one.name, name)
            compared += 1
    assert compared > 20


def test_kaneko_hayashi_compares_velocities_above_its_frequency() -> None:
    fast = screen_block(BLOCK, Demand(pga_g=2.0, pgv_m_s=0.3)).row("Kaneko-Hayashi 50 %")
    v50 = {name: value for name, value, _ in fast.details}["V50"]
    assert fast.passes is None  # 2 g, but slow: fewer than half
    assert "fewer than half" in fast.verdict
    over = Demand(pga_g=2.0, pgv_m_s=1.001 * v50)
    assert screen_block(BLOCK, over).row("Kaneko-Hayashi 50 %").passes is False
    assert fast.value == pytest.approx(2.0 * v50 / 0.3)


def test_rows_for_rectangles_say_so_of_other_blocks() -> None:
    asymmetric = Block.asymmetric(left=0.12, right=0.2, height=1.8)
    heavy = Block.asymmetric(left=0.16, right=0.16, height=1.2, gyration=0.5)
    for block in (asymmetric, heavy):
        found = full(block=block, friction=0.5)
        for name in ROCKING[: 4 if block is heavy else 5]:  # no cabinet is near to the heavy one
            assert found.row(name).status == "approximate", name
            assert "homogeneous rectangles" in found.row(name).remark
        assert found.row("uplift").status == "computed"
    found = full(block=asymmetric)
    assert found.row("uplift").value == pytest.approx(0.12 / 0.9)
    assert "side that lifts first" in found.row("ASCE 43-05 rocking").remark
    assert {n: v for n, v, _ in found.row("uplift").details}["other side"] == pytest.approx(
        0.2 / 0.9
    )
    assert found.row("restitution").value == pytest.approx(asymmetric.positive.restitution)
    mirrored = full(block=Block.asymmetric(left=0.2, right=0.12, height=1.8))
    for one, other in zip(found.rows, mirrored.rows, strict=True):
        if one.value is not None:
            assert one.value == pytest.approx(other.value, rel=1e-12)
        assert one.verdict == other.verdict


def test_the_ratio_of_a_row_is_the_demand_over_its_threshold() -> None:
    found = full()
    for row in found.rows:
        demand = {"g": 0.35, "m/s": 0.4}.get(row.unit)
        expected = None if demand is None else demand / (row.value or math.nan)
        assert found.ratio(row) == expected, row.name
    alone = screen_block(BLOCK, Demand(pga_g=9.0))
    assert [row.name for row in alone.rows if alone.ratio(row) is not None] == [
        "uplift",
        "Circolare rectangle",
    ]


def test_an_unknown_row_and_a_wrong_friction_are_refused() -> None:
    with pytest.raises(InputError, match="uplift, friction to rock"):
        full().row("west")
    with pytest.raises(InputError, match="friction"):
        screen_block(BLOCK, PEAKS, friction=-0.1)
    light = Block.rectangle(width=0.3, height=1.0, gravity=1.62)
    with pytest.raises(InputError, match="falls as fast"):
        screen_block(light, Demand(vertical_g=0.2))


def test_a_stocky_block_whose_restitution_would_be_negative_has_no_asce_row() -> None:
    block = Block.rectangle(width=3.0, height=1.0, restitution=0.5)
    row = full(block=block, friction=5.0).row("ASCE 43-05 rocking")
    assert row.passes is None
    assert "restitution" in row.verdict


def test_the_page_has_the_worked_values_of_its_block() -> None:
    page = (Path(__file__).parents[3] / "docs/guides/screens.md").read_text(encoding="utf-8")
    lines = {line.split(" | ")[0].strip("| "): line for line in page.splitlines() if "|" in line}
    found = screen_block(BLOCK, PEAKS, friction=0.4)
    worked: dict[str, list[float | None]] = {
        "uplift": [found.row("uplift").value],
        "friction to rock": [found.row("friction to rock").value],
        "restitution": [found.row("restitution").value],
        "Ishiyama bound": [value for _, value, _ in found.row("Ishiyama bound").details[:2]],
        "Kaneko-Hayashi 50 %": [
            value for _, value, _ in found.row("Kaneko-Hayashi 50 %").details[:3]
        ],
        "p PGV/(g tan alpha)": [found.row("p PGV/(g tan alpha)").value],
        "FEMA P-58 cabinets": [found.row("FEMA P-58 cabinets").value],
    }
    assert set(lines) >= set(NAMES)
    for name, values in worked.items():
        assert all(f"{value:.4f}" in lines[name] for value in values), name
    shares, _, _ = found.row("p PGV/(g tan alpha)").verdict.partition(" of such")
    assert f": {shares} |" in lines["p PGV/(g tan alpha)"]
