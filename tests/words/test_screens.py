"""Words of published formulas: the governing one first, then what is not passed."""

from typing import Any

from rocksteady import Demand, screen_block
from rocksteady.risk.screens.screen import Kind
from tests.every import every
from tests.outputs import lines_of
from tests.risk.screens.test_screens import BLOCK, SPECTRUM, full
from tests.risk.screens.test_vertical import CASK, FLAT


def test_the_answer_shows_the_governing_row_then_what_is_not_passed() -> None:
    calm = screen_block(BLOCK, Demand(pga_g=0.17, pgv_m_s=0.2), friction=0.4, object_kind="wall")
    answer = calm.describe()
    passes = [calm.row(name).passes for name, _ in answer.rows]
    assert passes == [False, None, None, None, True, True]
    assert "restitution" not in [name for name, _ in answer.rows]
    for kind in (None, "statue"):
        worst = full(kind=kind).describe()
        failed = [row.name for row in full(kind=kind).rows if row.passes is False]
        assert [name for name, _ in worst.rows][: len(failed)] == failed
    bare = screen_block(BLOCK, Demand()).describe()
    none = "No answer yet: none of the published screens for any block has a verdict."
    assert bare.sentence == none
    (words,) = [text for name, text in bare.screen if name == "no verdict"]
    assert words == "uplift needs a PGA; friction to rock needs a PGA"
    assert not lines_of(bare)["give next"]


@every(
    ("demand", "friction", "words"),
    [
        (Demand(), None, "none of the other published screens has a verdict."),
        (Demand(pga_g=0.35), 0.05, "It slides at 0.35 g: no screen of rocking is an answer."),
        (Demand(pgv_m_s=9.0), None, "It fails the one other published screen that has a verdict"),
        (Demand(spectrum=SPECTRUM[1:]), None, "its damping, as 0.05; for the rest a PGA (or its"),
        (Demand(spectrum=SPECTRUM[1:], spectrum_damping=0.05), None, "give next for the rest a"),
    ],
)
def test_what_screens_say_at_once(demand: Demand, friction: float | None, words: str) -> None:
    result = screen_block(BLOCK, demand, friction=friction, object_kind="cask")
    text = " ".join(result.summary().split())
    assert words in text, text
    assert ("give next" in text) == (demand.spectrum is not None)
    failed = any(row.passes is False for row in result.rows)
    assert result.negative == (failed or friction is not None)


ROW: dict[str, Any] = {"spectrum": FLAT, "spectrum_damping": 0.1}


@every(
    ("kind", "given", "counts"),
    [
        ("statue", {"pga_g": 0.1, "pgv_m_s": 0.1, "vertical_g": 0.3}, True),  # Ishiyama's PGA
        ("statue", {"pga_g": 0.1, "pgv_m_s": 0.1, "vertical_g": 0.3, "vertical_share": 0.0}, False),
        ("statue", {"pga_g": 0.9, "pgv_m_s": 0.1, "vertical_g": 0.3}, False),  # bound of PGV
        ("statue", {"pga_g": 0.9, "pgv_m_s": 9.0, "vertical_g": 0.3}, True),
        ("statue", {"pgv_m_s": 9.0, "vertical_g": 0.3}, False),  # shares alone
        ("statue", {"pga_g": 0.9, "vertical_g": 0.3}, False),  # uplift and friction alone
        ("wall", {"pga_g": 0.9, "vertical_g": 0.3}, True),
        ("cask", {"pga_g": 0.9, "vertical_g": 0.3, "vertical_share": 0.0, **ROW}, True),
        ("cask", {"pga_g": 0.9, "vertical_g": 0.3, "sa_v_per_sa_h": 0.5, **ROW}, False),
    ],
)
def test_the_first_line_has_the_vertical_peak_where_a_verdict_counts_it(
    kind: Kind, given: dict[str, Any], counts: bool
) -> None:
    found = screen_block(CASK, Demand(**given), object_kind=kind)
    answer = found.describe()
    assert ("with a vertical peak of 0.3 g" in answer.sentence) is counts, answer.sentence
    fact = "" if counts else "0.3 g enters no row that has a verdict"
    assert lines_of(answer)["vertical motion"] == fact


def test_a_slide_under_vertical_motion_names_it() -> None:
    demand = Demand(pga_g=0.3, vertical_g=0.5)
    found = screen_block(CASK, demand, friction=0.5)
    assert found.motion == "slides"
    assert "It slides at 0.3 g with a vertical peak of 0.5 g" in found.summary()
