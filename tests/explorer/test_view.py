"""The first view: the page reads what was meant; what it cannot show is refused."""

import math
import re
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    Pulse,
    Rest,
    State,
    Steady,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.explorer.view import DEFAULT_MOTION, FULL, LIMITS, TABS, WINDOW, state_of
from rocksteady.export import ExplorerView
from rocksteady.formulas import Outline
from rocksteady.histories import ImpactState
from tests.every import every
from tests.explorer.in_node import InNode

RECTANGLE = Block.rectangle(width=0.5, height=2.0)
IMPORTS = """
const { FIELDS, ROOMS, TABS, blockNumbers, caseOf, defaultState, patched, startOf } =
    await import(parts('shell/state.mjs'));
"""
READ = """
answer(asked.map((text) => {
    const { state, refused } = patched(defaultState(), text);
    const { alpha, p, restitution } = blockNumbers(kernels, state);
    return { state, refused, given: caseOf(kernels, state), start: startOf(state),
        block: { alpha, p, restitution } };
}));
"""
KEYS = {"amplitude": "A", "frequency_ratio": "W", "restitution": "r", "width": "b", "height": "h"}
motions = st.builds(
    Harmonic, amplitude=st.floats(0.0, 1000.0), frequency_ratio=st.floats(0.01, 1000.0)
)
ratios = st.floats(0.01, 1.0)
blocks = st.one_of(
    st.builds(DimensionlessBlock, restitution=ratios),
    st.builds(
        Block.rectangle,
        width=st.integers(2, 2000).map(lambda mm: mm / 1000),
        height=st.integers(2500, 9000).map(lambda mm: mm / 1000),
        restitution=st.one_of(st.just("housner"), ratios),
    ),
)
plain = st.floats(-1e6, 1e6)
starts = st.one_of(
    st.just(Rest()),
    st.just(Steady()),
    st.builds(State, angle=plain, velocity=plain),
    st.builds(
        ImpactState,
        side=st.sampled_from([1, -1]),
        phase=st.floats(0.0, 6.0),
        speed=st.floats(0.0, 1e6),
    ),
)
tabs = st.sampled_from([tab for tab in TABS if tab not in FULL])
views = st.lists(
    st.builds(
        ExplorerView,
        motion=motions,
        block=blocks,
        start=starts,
        tab=tabs,
    ),
    min_size=40,
    max_size=40,
)


def meant(start: Any) -> dict[str, object]:
    """A start as the page has it."""
    if isinstance(start, State):
        return {"kind": "state", "angle": start.angle, "velocity": start.velocity}
    if isinstance(start, ImpactState):
        return {
            "kind": "impact",
            "side": start.side,
            "phase": start.phase,
            "speed": start.speed,
        }
    return {"kind": type(start).__name__.lower()}


@given(views=views)
@settings(
    deadline=None, max_examples=3, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
def test_the_page_reads_block_shaking_and_start_to_the_last_bit(
    views: list[ExplorerView], in_node: InNode
) -> None:
    asked = [state_of(view, on_records=False) for view in views]
    for view, found in zip(views, in_node(IMPORTS + READ, asked), strict=True):
        assert found["refused"] == []
        assert view.motion is not None
        assert view.block is not None
        case, state = found["given"], found["state"]
        assert case["amplitude"] == view.motion.amplitude
        assert case["frequencyRatio"] == view.motion.frequency_ratio
        assert case["restitution"] == view.block.restitution
        assert state["tab"] == view.tab
        assert found["start"] == meant(view.start)
        assert state["w0"] <= view.motion.frequency_ratio <= state["w1"]
        assert state["a0"] <= view.motion.amplitude <= state["a1"]
        if isinstance(view.block, Block):
            assert found["block"]["alpha"] == view.block.alpha
            assert found["block"]["p"] == view.block.p


@pytest.mark.parametrize("name", KEYS)
def test_the_limits_and_defaults_are_those_of_the_page(name: str, in_node: InNode) -> None:
    low, high = LIMITS[name]
    texts = [repr(low), repr(high), repr(math.nextafter(high, math.inf))]
    texts.append(repr(math.nextafter(low, -math.inf)))
    lines = f"answer(asked.map((text) => FIELDS.{KEYS[name]}.parse(text) !== undefined));"
    assert in_node(IMPORTS + lines, texts) == [True, True, False, False]


def test_defaults_and_tabs_are_those_of_the_page(in_node: InNode) -> None:
    state, tabs = in_node(IMPORTS + "answer([defaultState(), [...TABS, ...Object.keys(ROOMS)]]);")
    assert (state["A"], state["W"]) == (DEFAULT_MOTION.amplitude, DEFAULT_MOTION.frequency_ratio)
    assert {name: state[name] for name in WINDOW} == WINDOW
    assert tuple(tabs) == TABS
    assert state["tab"] == TABS[0]


def test_a_size_keeps_its_digits_whatever_made_the_block() -> None:
    tidy = state_of(ExplorerView(block=Block.rectangle(width=0.6, height=1.8)), on_records=False)
    assert (tidy["b"], tidy["h"], tidy["units"], tidy["rh"]) == ("0.6", "1.8", "si", "1")
    block = Block.from_p(alpha=0.25, p=2.14, restitution=0.9)
    other = state_of(ExplorerView(block=block), on_records=False)
    again = Block.rectangle(width=float(other["b"]), height=float(other["h"]))
    assert (again.alpha, again.p) == pytest.approx((block.alpha, block.p), rel=1e-14)
    assert (other["r"], "rh" in other) == ("0.9", False)
    stocky = Block.rectangle(width=3.0, height=1.0, restitution=0.8)
    assert "rh" not in state_of(ExplorerView(block=stocky), on_records=False)


def test_ground_motions_open_their_tab_with_the_equations_of_the_tab() -> None:
    bare = ExplorerView(block=DimensionlessBlock(restitution=0.8))
    for view, on_records, expected in (
        (ExplorerView(), False, ("shake", "auto")),
        (ExplorerView(), True, ("quake", "auto")),
        (ExplorerView(tab="design", model=Linear()), True, ("design", "linear")),
        (ExplorerView(model=Nonlinear()), False, ("shake", "nonlinear")),
        (bare, True, ("quake", "linear")),
    ):
        state = state_of(view, on_records=on_records)
        assert (state["tab"], state["model"]) == expected


@every(
    ("given", "name", "words"),
    [
        ({"tab": "basin"}, "tab", "shake, start"),
        ({"scale": 0.0}, "scale", r"\[0.01, 100\]"),
        ({"motion": Harmonic(amplitude=1001.0, frequency_ratio=2.0)}, "amplitude", "1000"),
        ({"motion": Harmonic(amplitude=1.0, frequency_ratio=1001.0)}, "frequency_ratio", "1000"),
        ({"block": DimensionlessBlock(restitution=0.001)}, "restitution", "0.01"),
        ({"block": Block.rectangle(width=1e-4, height=0.5)}, "width", "0.001"),
        ({"start": State(angle=1e7, velocity=0.0)}, "angle", "1000000"),
    ],
)
def test_numbers_that_the_page_does_not_take_are_refused(
    given: dict[str, Any], name: str, words: str
) -> None:
    with pytest.raises(InputError, match=f"^{name} = .*{words}"):
        ExplorerView(**given)


@every(
    ("given", "name"),
    [
        ({"block": Block.asymmetric(left=0.2, right=0.3, height=2.0)}, "block"),
        ({"block": Block.rectangle(width=0.5, height=2.0).against_wall()}, "block"),
        ({"block": DimensionlessBlock(restitution=0.8, alpha_ratio=1.1)}, "block"),
        ({"block": Block.named("gas-cylinder")}, "block"),
        ({"block": replace(RECTANGLE, outline=Outline(height=2.5))}, "block"),
        ({"block": Block.rectangle(width=0.5, height=2.0, gravity=1.62)}, "gravity"),
        ({"block": DimensionlessBlock(restitution=0.8), "model": Nonlinear()}, "block"),
        ({"model": Nonlinear(tolerance=1e-8)}, "tolerance"),
        ({"motion": Harmonic(amplitude=1.0, frequency_ratio=2.0, phase=0.5)}, "phase"),
        ({"motion": Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=3.0)}, "motion"),
        ({"start": Steady(order=3)}, "start"),
        ({"start": State(angle=0.1, velocity=0.0, phase=1.0)}, "phase"),
    ],
)
def test_what_the_page_cannot_show_is_refused(given: dict[str, Any], name: str) -> None:
    with pytest.raises(ModelError) as error:
        ExplorerView(**given)
    assert error.value.name == name
    assert re.fullmatch(r"[^\n]+", str(error.value))


def test_a_view_of_nothing_opens_with_the_block_to_push_and_any_other_in_the_laboratory() -> None:
    def place(view: ExplorerView, *, on_records: bool = False) -> str:
        return state_of(view, on_records=on_records)["at"]

    assert place(ExplorerView()) == place(ExplorerView(start=Rest())) == "push"
    assert place(ExplorerView(scene="order")) == "order"
    assert place(ExplorerView(tab="explore")) == place(ExplorerView(scale=2.0)) == "lab"
    assert place(ExplorerView(), on_records=True) == "lab"
    with pytest.raises(InputError, match="scene"):
        ExplorerView(scene="fell")
