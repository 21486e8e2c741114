"""The state of the page and its link."""

import math

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rocksteady import Block
from tests.explorer.in_node import InNode

IMPORTS = """
const { FIELDS, TABS, blockNumbers, caseOf, defaultState, patched, startOf, startText } =
    await import(parts('shell/state.mjs'));
const { linkOf, stateOfLink } = await import(parts('shell/link.mjs'));
"""
ONCE = settings(
    deadline=None, max_examples=3, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
numbers = st.floats(0.01, 1000.0)
views = st.lists(
    st.fixed_dictionaries(
        {"A": st.floats(0.0, 1000.0), "W": numbers, "r": st.floats(0.01, 1.0)},
        optional={
            "tab": st.sampled_from(["explore", "basins", "pulse", "quake", "design"]),
            "model": st.sampled_from(["linear", "nonlinear"]),
            "b": st.floats(0.001, 1000.0),
            "h": st.floats(0.001, 1000.0),
            "start": st.sampled_from(["rest", "steady", "0.5,-0.25", "-1:3.5:0.125"]),
        },
    ),
    min_size=30,
    max_size=30,
)


@given(views=views)
@ONCE
def test_a_link_gives_back_its_state_to_the_last_bit(
    views: list[dict[str, object]], in_node: InNode
) -> None:
    lines = """
    answer(asked.map((patch) => {
        const { state, refused } = patched(defaultState(), patch);
        const { state: again, ignored } = stateOfLink(linkOf(state));
        return { state, again, refused, ignored };
    }));
    """
    for patch, found in zip(views, in_node(IMPORTS + lines, views), strict=True):
        assert found["refused"] == found["ignored"] == []
        assert found["again"] == found["state"]
        assert {name: found["state"][name] for name in patch} == patch


def test_keys_at_their_defaults_are_left_out(in_node: InNode) -> None:
    lines = """
    answer([linkOf(defaultState()), linkOf(patched(defaultState(), { A: 1.5, W: 3 }).state)]);
    """
    assert in_node(IMPORTS + lines) == ["#v=2", "#v=2&A=1.5"]


HOSTILE = {
    "#v=2&colour=red": ["colour"],
    "#v=3&A=3": ["v=3"],
    "#A=NaN": ["A"],
    "#A=Infinity": ["A"],
    "#A=": ["A"],
    "#A=-1": ["A"],
    "#A=0x10": ["A"],
    "#A=1,5": ["A"],
    "#r=0": ["r"],
    "#W=%": ["W"],
    "#W=%E0%A4": ["W"],
    "#tab=<script>": ["tab"],
    "#model=Linear": ["model"],
    "#__proto__=1&constructor=2&toString=3": ["__proto__", "constructor", "toString"],
    "#start=1:2": ["start"],
    "#start=2:0:1": ["start"],
    "#start=1:0:-1": ["start"],
    "#start=,": ["start"],
    "#w0=5&w1=4": ["w0"],
    "#a0=6&a1=6": ["a0"],
    "#b=3&h=1&rh=1": ["rh"],
    "#" + "A" * 5000 + "=1": [],
}


@pytest.mark.slow
@pytest.mark.parametrize("fragment", HOSTILE)
def test_what_a_link_must_not_hold_is_ignored_and_named(fragment: str, in_node: InNode) -> None:
    lines = """
    const found = stateOfLink(asked);
    const state = found ? found.state : defaultState();
    answer([found ? found.ignored : [], JSON.stringify(state) === JSON.stringify(defaultState()),
        Object.getPrototypeOf(state) === Object.prototype]);
    """
    ignored, default, ordinary = in_node(IMPORTS + lines, fragment)
    assert ignored == HOSTILE[fragment]
    assert ordinary
    assert default == (fragment != "#v=3&A=3")  # whose A is known to every version


def test_the_measures_of_the_block_are_those_of_the_package(in_node: InNode) -> None:
    sizes = [(0.4, 1.2), (0.5, 2.0), (1e-3, 1.0), (0.074, 0.365), (3.3, 11.1), (0.6180339, 1.0)]
    lines = """
    answer(asked.map(([b, h]) => {
        const state = patched(defaultState(), { b, h, rh: 1 }).state;
        return { ...blockNumbers(kernels, state), case: caseOf(kernels, state) };
    }));
    """
    for (width, height), found in zip(sizes, in_node(IMPORTS + lines, sizes), strict=True):
        block = Block.rectangle(width=width, height=height)
        for name in ("alpha", "radius", "p", "restitution"):
            assert found[name] == getattr(block, name), name
        assert found["case"]["restitution"] == block.restitution
        assert found["case"]["alpha"] == block.alpha


def test_starts_keep_their_numbers(in_node: InNode) -> None:
    starts = [
        {"kind": "rest"},
        {"kind": "steady"},
        {"kind": "state", "angle": 0.1, "velocity": -1 / 3},
        {"kind": "impact", "side": -1, "phase": math.pi, "speed": 5e-324},
    ]
    lines = """
    answer(asked.map((start) => {
        const { state, refused } = patched(defaultState(), { start: startText(start) });
        return [startOf(state), refused];
    }));
    """
    assert in_node(IMPORTS + lines, starts) == [[start, []] for start in starts]
