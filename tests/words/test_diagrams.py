"""Words of bifurcation diagrams: their case, answer and summary."""

import math
from functools import cache
from types import SimpleNamespace
from typing import Any

import pytest

from rocksteady import Block, DimensionlessBlock, Harmonic, Linear, Nonlinear, find_bifurcations
from rocksteady.branches import BifurcationDiagram, BranchOptions
from rocksteady.dynamics.parameters import SYMBOLS
from rocksteady.motions import FourierSeries
from rocksteady.results.description import Fact
from rocksteady.results.numbers import number
from rocksteady.words import diagrams
from rocksteady.words.diagrams import counts_of, diagram_answer
from tests.every import every

BARE = DimensionlessBlock(restitution=0.8)
SIZED = Block.rectangle(width=0.4, height=1.2, restitution=0.8)
SIDES = Block.asymmetric(left=0.15, right=0.2, height=1.2, restitution=(0.85, 0.8))
LINEAR, NONLINEAR = Linear(), Nonlinear()
SHAKEN = Harmonic(amplitude=2.0, frequency_ratio=4.0)


def words_module(facts: list[Fact]) -> dict[str, str]:
    return {fact.label: fact.words for fact in facts if fact.label}


@every(
    ("parameter", "text"),
    [
        ("amplitude", "A from 0.5 to 1, Ω = 4, restitution 0.85/0.8"),
        ("frequency_ratio", "A = 2, Ω from 0.5 to 1, restitution 0.85/0.8"),
        ("restitution", "A = 2, Ω = 4, restitution from 0.5 to 1"),
    ],
)
def test_a_diagram_has_its_range_and_what_is_fixed_in_the_units_of_its_block(
    parameter: str, text: str
) -> None:
    within = (0.5, 1.0)
    assert diagrams.motion_text(SIDES, SHAKEN, parameter, within) == text
    series = FourierSeries(
        amplitude=2.0, frequency_ratio=4.0, harmonics=((3, 0.2, 0.0), (5, 0.1, 0.2))
    )
    assert diagrams.motion_text(SIDES, series, parameter, within) == f"{text}, orders 3, 5"
    units = {"amplitude": (SIZED.alpha, "g"), "frequency_ratio": (SIZED.p / (2 * math.pi), "Hz")}
    symbol = SYMBOLS[parameter]
    for block in (BARE, SIZED):
        facts = diagrams.case_facts(block, SHAKEN, parameter, within, LINEAR)
        values = {fact.key: fact.value for fact in facts}
        shown = words_module(facts)
        over = f"{symbol} from 0.5 to 1"
        if block is SIZED and parameter in units:
            scale, unit = units[parameter]
            low, high = (number(scale * end) for end in within)
            over = f"{low} to {high} {unit} ({over})"
        assert shown["over"] == over
        fixed = {"amplitude": 2.0, "frequency_ratio": 4.0, "restitution": 0.8, parameter: None}
        assert {name: values[name] for name in fixed} == fixed
        si = {"amplitude": ("accel_g", 2.0), "frequency_ratio": ("freq_hz", 4.0)}
        for name, (key, value) in si.items():
            if block is BARE:
                assert key not in values
                continue
            scale, unit = units[name]
            expected = None if name == parameter else pytest.approx(scale * value)
            assert values[key] == expected
            label = {"g": "amplitude", "Hz": "frequency"}[unit]
            if name == parameter:
                assert label not in shown
            else:
                assert shown[label] == f"{number(scale * value)} {unit}"
        assert "harmonics" not in values
    facts = diagrams.case_facts(BARE, series, parameter, within, LINEAR)
    (waves,) = (fact.value for fact in facts if fact.key == "harmonics")
    assert waves == [[3, 0.2, 0.0], [5, 0.1, 0.2]]


MOTION = Harmonic(amplitude=2.0, frequency_ratio=1.95)
WITHIN = (1.9, 2.0)
SMALL = BranchOptions(max_period=1, max_impacts=2, doublings=0)


@cache
def diagram_of(block: Block | DimensionlessBlock, parameter: str) -> BifurcationDiagram:
    """Return a small diagram about a symmetry breaking, without sweeps."""
    ends = {"frequency_ratio": WITHIN, "amplitude": (1.95, 2.05), "restitution": (0.78, 0.82)}
    return find_bifurcations(
        block, MOTION, parameter, within=ends[parameter], values=0, search=SMALL, model="linear"
    )


def width(text: str) -> int:
    return max(len(line) for line in text.splitlines())


def test_an_answer_has_amplitudes_in_standard_gravity() -> None:
    block = Block.rectangle(width=0.4, height=1.2, restitution=0.8, gravity=6.5)
    diagram = diagram_of(block, "amplitude")
    answer = diagram.describe()
    (point,) = diagram.to_dict()["points"]
    words = f"{point['accel_g']:.5g} (symmetry breaks)"
    assert any(words in str(fact[1]) for fact in answer.screen)
    assert str(answer.screen).count("(symmetry breaks)") == 1, "not at the ends of the range"


def test_answer_and_description_count_the_same_branches() -> None:
    diagram = diagram_of(BARE, "frequency_ratio")
    parts = {"branches": diagram.branches, "points": diagram.points}
    assert counts_of(diagram) == "2 branches, 1 bifurcation"
    resting: Any = SimpleNamespace(**parts, resting=diagram.branches)
    assert counts_of(resting) == "2 branches, 2 of orbits that come to rest, 1 bifurcation"
    words = "2 branches up to 1 period and 2 impacts, 1 bifurcation"
    assert words in " ".join(diagram.summary(more=True).split())


@every(
    ("ranges", "sentence"),
    [
        ([], "No steady motion was found to be stable for W = 1.9 to 2."),
        ([(1.9, 2.0)], "A steady motion is stable throughout, for W = 1.9 to 2."),
        ([(1.9, 1.95), (1.94, 2.0)], "A steady motion is stable throughout, for W = 1.9 to 2."),
        ([(1.95, 2.0)], "No steady motion was found to be stable below W = 1.95."),
        ([(1.9, 1.95)], "No steady motion was found to be stable above W = 1.95."),
        ([(1.92, 1.95)], "A steady motion is stable for W = 1.92 to 1.95."),
        (
            [(1.92, 1.95), (1.97, 2.0)],
            "A steady motion is stable for W = 1.92 to 1.95 and in 1 other range.",
        ),
    ],
)
def test_an_answer_joins_the_ranges_of_branches_that_come_to_rest(
    ranges: list[tuple[float, float]], sentence: str
) -> None:
    diagram = diagram_of(BARE, "frequency_ratio")
    names = ("block", "parameter", "within", "model", "search", "complete", "points", "sweeps")
    resting = tuple(SimpleNamespace(within=within) for within in ranges)
    parts = {name: getattr(diagram, name) for name in names}
    found: Any = SimpleNamespace(**parts, branches=(), cascade=None, resting=resting)
    assert diagram_answer(found)[0] == sentence


@every("parameter", ["frequency_ratio", "amplitude", "restitution"])
@every("block", [BARE, SIZED])
def test_the_summary_has_a_row_a_bifurcation_in_the_units_of_the_block(
    block: Block | DimensionlessBlock, parameter: str
) -> None:
    diagram = diagram_of(block, parameter)
    text = diagram.summary(more=True)
    assert width(text) <= 80
    assert "…" not in text
    assert "2 branches up to 1 period and 2 impacts, 1 bifurcation" in text
    (point,) = diagram.to_dict()["points"]
    (row,) = (line for line in text.splitlines() if "symmetry breaking" in line)
    assert f"{point[parameter]:.8f}" in row, "with the digits that are known"
    unit = {"frequency_ratio": "freq_hz", "amplitude": "accel_g"}.get(parameter)
    sized = block is SIZED and unit is not None
    assert ("symmetric" in row) == (not sized), "the unit takes the place of the kind"
    if sized:
        assert f"{point[unit]:.6g}" in row
    assert ("°" in row) == (block is SIZED)
    assert len(repr(diagram)) < 160
