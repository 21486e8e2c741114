"""Screens chosen for a kind of object: the governing row, what is left out, and what counts."""

from typing import Any

import pytest

from rocksteady import Block, Demand, assess_object, screen_block
from rocksteady.codes import Screens
from rocksteady.errors import InputError
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import Assessment, DescribedObject
from rocksteady.risk.screens.screen import Kind
from tests.cli.program import refused, rocksteady
from tests.descriptions import as_json, fits
from tests.every import every
from tests.outputs import lines_of

CASK = Block.rectangle(width=2.4, height=4.3)
RACK = Block.rectangle(width=0.32, height=1.8)
TABLE = [[0.05, 0.3], [0.1, 0.6], [0.4, 0.6], [1.0, 0.25], [4.0, 0.03]]
OWN = {
    "cask": "ASCE 43-05 rocking",
    "wall": "Circolare rectangle",
    "cabinet": "FEMA P-58 cabinets",
    "statue": None,
}
"""The row made for each kind."""
OWN_ROW = "The screen made for a {}, {}"
GENERAL = [
    *("uplift", "friction to rock", "restitution"),
    *("Ishiyama bound", "Kaneko-Hayashi 50 %", "p PGV/(g tan alpha)"),
]


def screened(kind: Kind | None, block: Block = CASK, **given: Any) -> Screens:
    peaks = {"pga_g": 0.3, "pgv_m_s": 0.4, "spectrum": TABLE, "spectrum_damping": 0.1}
    return screen_block(block, Demand(**{**peaks, **given}), object_kind=kind)


def _of_kind(written: str) -> Assessment:
    described = DescribedObject(
        values={
            "name": "thing",
            "kind": written,
            "friction": 0.1,
            "geometry": {"width_m": 0.4, "height_m": 1.8},
            "demand": {"pga_g": 0.4, "pgv_m_s": 0.4},
        }
    )
    return assess_object(described, make_synthetic_suite(2))


def said(found: Screens) -> str:
    return " ".join(found.summary().split())


@every("kind", [*OWN])
def test_rows_are_chosen_for_the_kind_and_the_governing_one_stands_first(kind: Kind) -> None:
    found, own = screened(kind), OWN[kind]
    names = [row.name for row in found.rows]
    assert names == [*([own] if own else []), *GENERAL]
    others = [name for name in OWN.values() if name and name != own]
    assert [row.name for row in found.left_out] == others
    answer = found.describe()
    if own:
        assert answer.rows[0][0] == own
    label, words = answer.screen[0]
    assert label == f"not for a {kind}"
    assert all(name in str(words) for name in others)
    assert not any(name in dict(answer.rows) for name in others)
    assert fits(found.summary(more=True))
    lines = [line.strip() for line in found.summary(more=True).splitlines()]
    assert not any(line.startswith(name) for line in lines for name in others)
    assert [row["name"] for row in as_json(found.to_dict())["left_out"]] == others


@every("kind", [None, *OWN])
def test_only_rows_that_apply_are_counted(kind: Kind | None) -> None:
    """0.3 g on a cask: Ishiyama's and the velocity row pass, and of its kind its own row."""
    found = screened(kind)
    count = {None: "2 of 2", "cask": "3 of 3", "wall": "3 of 3"}.get(kind, "2 of 2")
    who = f"a {kind}" if kind else "any block"
    begin = f"It passes {count} published screens for {who} at 0.3 g"
    if kind == "cabinet":  # 4.3 m high: none is like it
        begin = (
            f"{OWN_ROW.format('cabinet', OWN[kind])}: no cabinet is near to this size. It passes"
        )
    assert said(found).startswith(begin)
    passed = {row.name for row in found.rows if row.passes}
    assert passed - {"Ishiyama bound", "p PGV/(g tan alpha)"} <= {OWN.get(kind or "")}


def test_rows_made_for_other_blocks_are_named_beside_the_count() -> None:
    facts = screened("statue", RACK.against_wall()).describe()
    words = str(lines_of(facts)["approximate"])
    names, _, reason = words.partition(": ")
    assert names == "Ishiyama bound, Kaneko-Hayashi 50 %, p PGV/(g tan alpha)"
    assert reason == "the block is outside its range"
    plain = screened("statue", RACK).describe()
    assert not lines_of(plain)["approximate"]


SMALL = "--width-m 0.45 --height-m 1.7"
LARGE = "--width-m 2.4 --height-m 4.3"


@every(
    ("flags", "begin", "code"),
    [
        (f"{SMALL} --kind cask --pga-g 0.1 --pgv-m-s 0.1", "needs a spectrum with its damping", 3),
        (f"{SMALL} --kind wall --pgv-m-s 0.1", "needs a PGA. It passes 2 of 2", 3),
        (f"{SMALL} --kind cabinet --pga-g 0.1", "needs a peak", 3),
        # Below a median no bound is kept.  By hand: Phi(ln(0.2/0.526)/0.5) = 0.0266.
        (f"{SMALL} --kind cabinet --pga-g 0.1 --pgv-m-s 0.2", "2.7 % of such", 3),
        (f"{SMALL} --kind cabinet --pga-g 0.01 --pgv-m-s 0.6", "It passes 2 of 3", 1),
        (f"{LARGE} --kind cabinet --pga-g 0.01 --pgv-m-s 0.05", "no cabinet is near", 3),
        # Angular momentum turns it round.
        ("--width-m 2.4 --height-m 1.2 -r 0.8 --kind cask --pga-g 0.01", "no answer: rest", 3),
        (f"{LARGE} --kind statue --pga-g 0.01 --pgv-m-s 0.05", "It passes 2 of 2", 0),
        (f"{SMALL} --pga-g 0.1 --pgv-m-s 0.1", "It passes 2 of 2", 0),
    ],
)
def test_no_pass_is_stated_before_the_row_that_governs(flags: str, begin: str, code: int) -> None:
    """Rows for any block do not answer in its place."""
    ran = rocksteady(f"screens {flags} --check")
    assert ran.code == code, ran.out
    text = " ".join(ran.out.split())
    if code == 3:
        kind = flags.partition("--kind ")[2].split()[0]
        begin = f"{OWN_ROW.format(kind, OWN[kind])}: {begin}"
    assert text.startswith(begin)


def test_an_unknown_kind_is_refused() -> None:
    with pytest.raises(InputError, match="cask, cabinet, wall, statue"):
        screened("vase")  # type: ignore[arg-type]
    line = refused("screens --width-m 2 --height-m 5 --kind vase")
    assert all(word in line for word in ("--kind", "vase", "cask, cabinet, wall, statue"))


@every("written", ["parapet", "statues", "nuclear part", "vase", "other"])
def test_a_kind_that_chooses_no_formulas_is_named(written: str) -> None:
    found = _of_kind(written)
    assert found.screens.kind is None
    text = " ".join(found.summary(more=True).split())
    words = f"Kind {written!r} chooses no formulas; cask, cabinet, wall, statue do."
    assert (words in text) is (written != "other")


@every("written", ["Statue", " statue ", "STATUE\t"])
def test_an_object_file_states_its_kind_in_any_case(written: str) -> None:
    assessment = _of_kind(written)
    assert assessment.screens.kind == "statue"
    assert "formulas, not for a statue: ASCE" in " ".join(assessment.summary(more=True).split())
