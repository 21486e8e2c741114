"""All screens of a block: values, verdicts, missing inputs, and friction that governs."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from rocksteady import Block, Demand, Record, screen_block
from rocksteady.codes import Screens
from rocksteady.errors import InputError
from rocksteady.risk.screens.screen import Kind
from tests.descriptions import as_json, fits
from tests.every import every

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
NUMBER = "p PGV/(g tan alpha)"
ASCE = "ASCE 43-05 rocking"


def full(friction: float | None = 0.4, block: Block = BLOCK, kind: Kind | None = None) -> Screens:
    demand = Demand(pga_g=0.35, pgv_m_s=0.4, spectrum=SPECTRUM, spectrum_damping=0.05)
    return screen_block(block, demand, friction=friction, object_kind=kind)


def test_every_row_names_its_equation_edition_and_source() -> None:
    found = full()
    assert tuple(row.name for row in found.rows) == NAMES
    for row in found.rows:
        assert row.equation
        assert row.edition
        assert row.source
        assert row.status == "computed"
        assert row.value is not None
        assert not row.needs


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


def test_values_of_the_worked_block() -> None:
    found = full()
    values = {row.name: row.value for row in found.rows}
    assert values["uplift"] == pytest.approx(0.1778, abs=5e-5)
    assert values["friction to rock"] == pytest.approx(0.2199, abs=5e-5)
    assert values["restitution"] == pytest.approx(BLOCK.restitution, rel=1e-13)
    assert values["p PGV/(g tan alpha)"] == pytest.approx(0.757 * 0.4 / 0.4653, rel=1e-4)
    assert values["Circolare rectangle"] == pytest.approx(0.32 / 1.8 / 1.35)
    assert values["FEMA P-58 cabinets"] == 0.290
    assert found.motion == "rocks"
    assert found.negative


def test_the_asce_row_solves_its_equation() -> None:
    row = full().row("ASCE 43-05 rocking")
    a, h = 0.32 / 1.8, 0.9
    t, g = row.value, 9.80665
    assert t is not None
    rise = math.cos(t) + a * math.sin(t) - 1.0
    inertia = 4.0 / 3.0 * (1.0 + a * a)
    hertz = math.sqrt(2.0 * g * rise / (inertia * h * t * t)) / (2.0 * math.pi)
    gamma = -2.0 * math.log(1.0 - 2.0 * a * a / inertia)
    beta = gamma / math.hypot(2.0 * math.pi, gamma)
    eta = math.sqrt(10.0 / (5.0 + 100.0 * beta))
    demand = eta * 0.16 * (1.0 / hertz / 2.0) ** (math.log(0.04 / 0.16) / math.log(2.0))
    assert 1.0 / hertz > 2.0
    assert 2.0 * rise / t == pytest.approx(demand, rel=1e-9)
    roots = [value for name, value, _ in row.details if name == "root"]
    assert roots == sorted(roots)
    assert roots[-1] == t


@every(
    ("level", "verdict", "passes"),
    [
        (0.001, "does not overturn: no root", True),
        (1.0, "rocks up to", True),
        (9.0, "overturns", False),
    ],
)
def test_no_root_means_overturning_only_where_the_demand_is_above(
    level: float, verdict: str, passes: bool
) -> None:
    table = [[period, level * value] for period, value in SPECTRUM]
    found = screen_block(BLOCK, Demand(spectrum=table, spectrum_damping=0.05), object_kind="cask")
    row = found.row("ASCE 43-05 rocking")
    assert row.verdict.startswith(verdict)
    assert row.passes is passes
    assert row.status == "computed"


def test_a_spectrum_that_ends_early_is_asked_to_go_on() -> None:
    found = screen_block(BLOCK, Demand(spectrum=SPECTRUM[:4], spectrum_damping=0.05))
    row = found.row("ASCE 43-05 rocking")
    assert (row.needs, row.passes) == ("spectrum", None)
    assert "2.22 s" in row.verdict


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


def test_only_rows_that_bound_falling_are_counted() -> None:
    """Rocking is no pass, nor is a median that is not reached: up to half still fall."""
    shaken = screen_block(BLOCK, PEAKS, friction=0.4)
    said = "It passes none of 3 published screens for any block at 0.35 g and 0.4"
    assert shaken.summary().startswith(said)
    calm = screen_block(BLOCK, Demand(pga_g=0.17, pgv_m_s=0.2), friction=0.4)
    assert calm.motion == "rest"
    passes = {row.name: row.passes for row in calm.rows if row.passes is not None}
    assert passes == {"Ishiyama bound": True, NUMBER: True}
    for name in ("Kaneko-Hayashi 50 %", "FEMA P-58 cabinets"):
        row = calm.row(name)
        assert row.passes is None
        assert "fewer than half" in row.verdict or "% of such cabinets fall" in row.verdict


def test_nothing_shown_speaks_of_memory_or_of_a_copy() -> None:
    for found in (full(), full(0.1), screen_block(BLOCK, Demand())):
        texts = [found.summary(more=True), json.dumps(found.to_dict())]
        texts += [row.summary(more=True) for row in found.rows]
        for text in texts:
            for words in ("memory", "confidence", "unreviewed", "transcription", "numerically"):
                assert words not in text.lower(), words
        assert texts[0].count("not checked against the printed") == 1


def test_beside_ishiyamas_general_form_stands_his_simple_rule() -> None:
    """By hand: 10 x 32/sqrt(180) = 23.851 cm/s, 3.4 % below 0.4 V_i = 0.2468 m/s."""
    row = full().row("Ishiyama bound")
    simple = {name: value for name, value, _ in row.details}["10 B/sqrt(H)"]
    assert simple == pytest.approx(0.23851, abs=5e-6)
    assert row.value is not None
    assert simple / row.value == pytest.approx(0.966, abs=5e-4)
    assert "gives 0.239 m/s" in row.remark


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


def test_shares_of_runs_say_where_a_block_lies_outside_them() -> None:
    stocky = screen_block(Block.rectangle(width=0.6, height=1.0), PEAKS)
    assert stocky.row(NUMBER).status == "approximate"
    assert "outside" in stocky.row(NUMBER).remark
    assert screen_block(BLOCK, PEAKS).row(NUMBER).status == "computed"


def test_one_peak_decides_where_it_is_below_its_bound() -> None:
    slow = screen_block(BLOCK, Demand(pgv_m_s=0.1))
    weak = screen_block(BLOCK, Demand(pga_g=0.1))
    for found in (slow, weak):
        for name in ("Ishiyama bound", "Kaneko-Hayashi 50 %"):
            assert found.row(name).passes is (True if name == "Ishiyama bound" else None)
            assert not found.row(name).needs
    strong = screen_block(BLOCK, Demand(pga_g=0.5))
    for name in ("Ishiyama bound", "Kaneko-Hayashi 50 %"):
        assert strong.row(name).needs == "pgv_m_s"


def test_kaneko_hayashi_compares_velocities_above_its_frequency() -> None:
    fast = screen_block(BLOCK, Demand(pga_g=2.0, pgv_m_s=0.3)).row("Kaneko-Hayashi 50 %")
    v50 = {name: value for name, value, _ in fast.details}["V50"]
    assert fast.passes is None  # 2 g, but slow: fewer than half
    assert "fewer than half" in fast.verdict
    over = Demand(pga_g=2.0, pgv_m_s=1.001 * v50)
    assert screen_block(BLOCK, over).row("Kaneko-Hayashi 50 %").passes is False
    assert fast.value == pytest.approx(2.0 * v50 / 0.3)


def test_below_uplift_the_velocity_number_passes() -> None:
    found = screen_block(BLOCK, Demand(pga_g=0.1, pgv_m_s=2.0))
    assert found.row("p PGV/(g tan alpha)").passes is True
    assert screen_block(BLOCK, Demand(pgv_m_s=2.0)).row("p PGV/(g tan alpha)").passes is False
    assert screen_block(BLOCK, Demand(pgv_m_s=0.1)).row("p PGV/(g tan alpha)").passes is True


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


def test_a_spectrum_that_ends_below_the_capacity_answers_up_to_there() -> None:
    """Its last root is passed: what follows of a falling spectrum can be left out."""
    table = [[0.1, 0.4], [0.4, 0.4], [0.8, 0.01], [1.0, 0.005]]
    row = screen_block(
        BLOCK, Demand(spectrum=table, spectrum_damping=0.05), object_kind="cask"
    ).row(ASCE)
    assert row.verdict.startswith("rocks up to ")
    assert (row.passes, row.needs, row.status) == (True, "", "computed")
    assert "It ends at 1 s: up to" in row.remark
    # It is asked to go on where it ends above the capacity, or has met it nowhere.
    for values in ([0.4, 0.4, 0.01, 0.4], [0.01, 0.01, 0.01, 0.005]):
        other = [[period, value] for (period, _), value in zip(table, values, strict=True)]
        row = screen_block(
            BLOCK, Demand(spectrum=other, spectrum_damping=0.05), object_kind="cask"
        ).row(ASCE)
        assert row.verdict.startswith("needs a spectrum up to 2.22 s"), values
        assert (row.passes, row.status) == (None, "needs input")


def test_beyond_its_last_root_a_demand_above_the_capacity_may_overturn() -> None:
    table = [[0.1, 0.4], [0.4, 0.4], [0.8, 0.01], [4.0, 4.0]]
    row = screen_block(
        BLOCK, Demand(spectrum=table, spectrum_damping=0.05), object_kind="cask"
    ).row(ASCE)
    assert row.verdict.startswith("may overturn beyond ")
    assert (row.passes, row.needs, row.status) == (False, "", "computed")
    assert "It ends at" not in row.remark
    roots = [value for name, value, _ in row.details if name == "root"]
    assert len(roots) == 2
    assert row.value == roots[-1]


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


def test_the_answer_shows_the_governing_row_then_what_is_not_passed() -> None:
    calm = screen_block(BLOCK, Demand(pga_g=0.17, pgv_m_s=0.2), friction=0.4, object_kind="wall")
    answer = calm.describe().answer
    assert answer is not None
    passes = [calm.row(name).passes for name, _ in answer.rows]
    assert passes == [False, None, None, None, True, True]
    assert "restitution" not in [name for name, _ in answer.rows]
    for kind in (None, "statue"):
        worst = full(kind=kind).describe().answer
        assert worst is not None
        failed = [row.name for row in full(kind=kind).rows if row.passes is False]
        assert [name for name, _ in worst.rows][: len(failed)] == failed
    bare = screen_block(BLOCK, Demand()).describe().answer
    assert bare is not None
    none = "No answer yet: none of the published screens for any block has a verdict."
    assert bare.sentence == none
    (words,) = [text for name, text in bare.facts if name == "no verdict"]
    assert words == "uplift needs a PGA; friction to rock needs a PGA"
    assert not dict(bare.facts)["give next"]


def test_what_a_spectrum_alone_decides_and_what_to_give_next() -> None:
    rest = "for the rest a PGA (or its row at period 0) and a PGV, or a record"
    table = [[0.05, 0.35], [0.5, 0.6], [2.0, 0.15], [9.0, 0.01]]
    for damping, sentence, words in (
        (
            None,
            (
                f"The screen made for a cask, {ASCE}: needs its damping. No answer yet: none of "
                "the other published screens has a verdict."
            ),
            f"its damping, as 0.05; {rest}",
        ),
        (0.05, "It passes the one published screen for a cask that has a verdict.", rest),
    ):
        demand = Demand(spectrum=table, spectrum_damping=damping)
        answer = screen_block(BLOCK, demand, object_kind="cask").describe().answer
        assert answer is not None
        assert (answer.sentence, dict(answer.facts)["give next"]) == (sentence, words)


def test_far_from_every_cabinet_there_is_no_verdict() -> None:
    tower = Block.rectangle(width=1.0, height=5.0)
    row = screen_block(tower, PEAKS, object_kind="cabinet").row("FEMA P-58 cabinets")
    assert row.passes is None
    assert row.verdict == "no cabinet is near to this size"


def test_a_record_is_screened_with_its_own_spectrum() -> None:
    t = 0.02 * np.arange(500)
    record = Record(acceleration_m_s2=4.0 * np.sin(6.0 * t) * np.exp(-0.2 * t), dt_s=0.02)
    row = screen_block(BLOCK, Demand.from_record(record)).row("ASCE 43-05 rocking")
    assert "spectrum of the record at 1.5 % damping" in row.verdict
    assert row.status == "computed"


def test_the_description_fits_a_page_and_holds_every_row() -> None:
    for found in (full(), full(0.1), screen_block(BLOCK, Demand())):
        text = found.summary(more=True)
        assert fits(text)
        assert all(text.count(name) >= 2 for name in NAMES)
        assert "the engineer verifies" in text
        for row in found.rows:
            assert fits(row.summary(more=True))
    values = as_json(full().to_dict())
    assert [row["name"] for row in values["screens"]] == list(NAMES)
    keys = {"name", "equation", "edition", "status", "value", "unit", "verdict"}
    assert all(keys | {"needs"} <= set(row) for row in values["screens"])
    assert len(values["cabinets"]) == 9
    assert json.dumps(values).count("comply") == json.dumps(values).count("complian") == 0


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


def test_tables_have_words_on_the_left_and_numbers_on_the_right() -> None:
    result = screen_block(Block.rectangle(width=0.32, height=1.8), Demand(pga_g=0.35, pgv_m_s=0.4))
    tables = result.describe().tables
    left = {column.heading: column.left for table in tables for column in table.columns}
    assert left == {
        **dict.fromkeys(("screen", "verdict", "equation", "edition", "made for"), True),
        "value": False,
    }
    values = result.to_dict()
    assert {row["screen"] for row in values["details"]} <= {row.name for row in result.rows}
    assert len(values["cabinets"]) == 9
    assert (values["pga_g"], values["pgv_m_s"], values["friction"]) == (0.35, 0.4, None)


def test_the_demand_over_the_threshold_of_a_row() -> None:
    block = Block.rectangle(width=0.32, height=1.8)
    joint = screen_block(block, Demand(pga_g=0.35, pgv_m_s=0.4))
    for name, peak in (("uplift", 0.35), ("Circolare rectangle", 0.35), ("Ishiyama bound", 0.4)):
        row = joint.row(name)
        assert joint.ratio(row) == pytest.approx(peak / (row.value or math.nan))
    assert joint.ratio(joint.row("restitution")) is None
    bare = screen_block(block, Demand(pgv_m_s=0.4))
    assert bare.ratio(bare.row("uplift")) is None
    assert bare.ratio(bare.row("Circolare rectangle")) is None
    with pytest.raises(
        InputError, match="there is no such row; give one of: uplift, friction to r"
    ):
        joint.row("uplifts")


def test_what_screens_say_at_once() -> None:
    block = Block.rectangle(width=0.32, height=1.8)
    table = [[0.0, 0.3], [0.5, 0.8], [9.0, 0.1]]
    for demand, friction, words in (
        (Demand(), None, "none of the other published screens has a verdict."),
        (Demand(pga_g=0.05, pgv_m_s=0.02), None, "other published screens at 0.05 g and 0.02 m/s."),
        (Demand(pga_g=0.35), 0.05, "It slides at 0.35 g: no screen of rocking is an answer."),
        (
            Demand(pgv_m_s=9.0),
            None,
            "It fails the one other published screen that has a verdict at 9 m/s.",
        ),
        (
            Demand(spectrum=table[1:]),
            None,
            "ASCE 43-05 rocking: needs its damping. No answer yet: none of",
        ),
    ):
        result = screen_block(block, demand, friction=friction, object_kind="cask")
        text = " ".join(result.summary().split())
        assert words in text, text
        following = "its damping, as 0.05; for the rest a PGA (or its row at period 0) and a PGV, o"
        assert (following in text) == (demand.spectrum is not None)
        assert result.negative == (
            friction == 0.05 or any(row.passes is False for row in result.rows)
        )
    damped = screen_block(
        block, Demand(spectrum=table[1:], spectrum_damping=0.05), object_kind="cask"
    )
    text = " ".join(damped.summary().split())
    assert "for the rest a PGA (or its row at period 0) and a PGV, or a record" in text
    assert "its damping, as 0.05;" not in text
