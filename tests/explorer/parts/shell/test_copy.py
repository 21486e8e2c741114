"""What the page copies: scripts and commands that run, and give its numbers to the last bit."""

import json
import math
import runpy
import shlex
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.cli.app import main
from rocksteady.dynamics.basins.window import centred
from tests.explorer.in_node import InNode

IMPORTS = """
const { addressOf, commandOf, pythonNumber, pythonOf, pythonText, shellText, subjectOf } =
    await import(parts('shell/copy.mjs'));
const { caseOf, defaultState, patched, startOf } = await import(parts('shell/state.mjs'));
const { stateOfLink } = await import(parts('shell/link.mjs'));
const { attractorOf } = await import(parts('physics/attractor.mjs'));
const { historyOf } = await import(parts('physics/history.mjs'));
const stateOf = ({ patch, further }) => {
    const { state, refused } = patched(defaultState(), { tab: 'explore', ...patch });
    if (refused.length) throw new Error(`refused: ${refused}`);
    return { ...state, ...further };
};
"""
COPIED = """
const state = stateOf(asked);
const motion = asked.motion;
answer([pythonOf(state, asked.subject, motion), commandOf(state, asked.subject, motion)]);
"""
POINTS: list[dict[str, Any]] = [
    {},
    {"A": 0.8, "W": 2, "r": 0.8, "start": "steady"},
    {"A": 2, "W": 6, "start": "0.1,-0.3333333333333333"},
    {"A": 1 / 3, "W": math.pi, "rh": 1, "start": "-1:3.5:0.125", "cycles": 7.5},
    {"A": 2.1, "W": 1.9, "model": "nonlinear", "b": 0.6180339, "h": 1.7, "rh": 1},
    {"A": 6, "W": 2, "units": "si", "b": 1e-3, "h": 0.004, "r": 0.25, "cycles": 12},
    {"A": 0, "W": 3, "start": "0.5,0"},
]


@pytest.fixture
def run_script(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Callable[[str], list[str]]:
    """Runs a script, and returns the lines that it prints."""

    def run(text: str) -> list[str]:
        script = tmp_path / "copied.py"
        script.write_text(text, encoding="utf-8")
        runpy.run_path(str(script), run_name="__main__")
        return capsys.readouterr().out.splitlines()

    return run


@pytest.fixture
def run_command(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[[str], str]:
    """Runs a command line, as a shell would take it apart, and returns what it prints."""

    def run(text: str) -> str:
        program, *words = shlex.split(text)
        assert program == "rocksteady"
        monkeypatch.setattr(sys, "argv", [program, *words])
        code: object = 0
        try:
            main()
        except SystemExit as end:
            code = end.code
        assert code in (None, 0), text
        return capsys.readouterr().out

    return run


def printed(lines: list[str]) -> dict[str, str]:
    return dict(line.split(": ", 1) for line in lines)


@pytest.mark.slow
@pytest.mark.parametrize("patch", POINTS, ids=str)
def test_a_script_of_a_motion_prints_what_the_page_computes(
    patch: dict[str, Any], in_node: InNode, run_script: Callable[[str], list[str]]
) -> None:
    lines = """
    const state = stateOf(asked);
    const given = caseOf(kernels, state), start = startOf(state);
    const { kind, period, impacts, highest, lowest, orbit } = attractorOf(kernels, given, start);
    const run = historyOf(kernels, given, start, state.cycles);
    answer({ script: pythonOf(state, 'point'), kind, period, impacts, highest, lowest,
        orbit: orbit !== null, status: run.status, peak: run.peak, hits: run.impactCount });
    """
    page = in_node(IMPORTS + lines, {"patch": patch})
    found = printed(run_script(page["script"]))
    assert found["attractor"] == page["kind"]
    assert found["status"] == page["status"]
    assert float(found["peak of |theta|/alpha"]) == page["peak"]
    assert int(found["impacts"]) == page["hits"]
    assert ("highest theta/alpha" in found) == page["orbit"]
    if page["orbit"]:
        assert int(found["period [periods of the shaking]"]) == page["period"]
        assert found["impacts in a period"] == str(page["impacts"])
        assert float(found["highest theta/alpha"]) == page["highest"]
        assert float(found["lowest theta/alpha"]) == page["lowest"]


@pytest.mark.slow
@pytest.mark.parametrize("patch", POINTS, ids=str)
def test_a_command_of_a_motion_runs_and_agrees(
    patch: dict[str, Any], in_node: InNode, run_command: Callable[[str], str]
) -> None:
    lines = """
    const state = stateOf(asked);
    const { kind, highest } = attractorOf(kernels, caseOf(kernels, state), startOf(state));
    answer([commandOf(state, 'point'), kind, highest]);
    """
    command, kind, highest = in_node(IMPORTS + lines, {"patch": patch})
    text = json.dumps(json.loads(run_command(f"{command} --json")))
    kind = "at-rest" if kind == "rest" and " simulate " in command else kind
    assert kind in text
    if highest:
        assert repr(highest) in text


OTHERS: list[dict[str, Any]] = [
    {"subject": "map", "patch": {"w0": 1, "w1": 4, "a0": 0.5, "a1": 3}},
    {"subject": "map", "patch": {"w0": 1, "w1": 4, "a0": 0.5, "a1": 3, "log": 1, "start": "0,0.2"}},
    {"subject": "strip", "patch": {"w0": 2, "w1": 3}},
    {"subject": "strip", "patch": {"by": "a", "a0": 0, "a1": 2, "log": 1}},
    {"subject": "basins", "patch": {"A": 0.8, "W": 2}},
    {
        "subject": "basins",
        "patch": {"A": 0.8, "W": 2, "u0": -1.25, "u1": 1, "v0": -0.5, "v1": 0.5},
    },
    {"subject": "pulse", "patch": {"pulse": "one-sine", "pA": 4.5, "pW": 3.2}},
    {"subject": "pulse", "patch": {"model": "nonlinear", "pulse": "ricker", "pA": 2, "pW": 2}},
    {"subject": "design", "patch": {"demand": "harmonic", "dg": 0.4, "df": 1.5, "dn": 3}},
]


@pytest.mark.slow
@pytest.mark.parametrize("asked", OTHERS[::2], ids=lambda asked: f"{asked['subject']} {asked}")
def test_scripts_and_commands_of_other_panels_run(
    asked: dict[str, Any],
    in_node: InNode,
    run_script: Callable[[str], list[str]],
    run_command: Callable[[str], str],
) -> None:
    script, command = in_node(IMPORTS + COPIED, asked)
    assert run_script(script)
    assert run_command(command)


@pytest.mark.slow
def test_a_script_and_a_command_run_by_themselves(in_node: InNode, tmp_path: Path) -> None:
    script, command = in_node(IMPORTS + COPIED, {"subject": "point"})
    (tmp_path / "copied.py").write_text(script, encoding="utf-8")
    for words in (["copied.py"], ["-m", *shlex.split(command)]):
        ran = subprocess.run(
            [sys.executable, *words], capture_output=True, text=True, check=False, cwd=tmp_path
        )
        assert (ran.returncode, ran.stderr) == (0, "")
        assert "symmetric" in ran.stdout


def test_a_script_of_basins_gives_the_shares_of_the_window(
    in_node: InNode, run_script: Callable[[str], list[str]]
) -> None:
    found = printed(run_script(in_node(IMPORTS + COPIED, OTHERS[5])[0]))
    basins = rs.compute_basins(
        rs.DimensionlessBlock(restitution=0.8),
        rs.Harmonic(amplitude=0.8, frequency_ratio=2.0),
        angles=0.5 * (-1.25 + 1) + (np.arange(144) - 71.5) * (2.25 / 144),
        velocities=centred(0.5, 108),
    )
    expected = {
        each.name: part.share
        for each, part in zip(basins.attractors, basins.fractions(), strict=True)
    }
    assert {name: float(found[name]) for name in expected} == expected


DESIGNS: list[dict[str, Any]] = [
    {"demand": "pulse", "pulse": "one-cosine", "dg": 0.7, "df": 1.1, "rh": 1},
    {"demand": "harmonic", "dg": 1 / 3, "df": 2.2, "dn": 7, "b": 0.41, "h": 1.7},
    {"demand": "pulse", "pulse": "type-c2", "dg": 0.6, "df": 0.9, "model": "nonlinear"},
]


@pytest.mark.parametrize("patch", DESIGNS, ids=str)
def test_a_script_of_a_design_prints_what_the_page_computes(
    patch: dict[str, Any], in_node: InNode, run_script: Callable[[str], list[str]]
) -> None:
    lines = """
    const { designRun } = await import(parts('physics/demand/design.mjs'));
    const state = stateOf(asked);
    const { demand: kind, pulse: shape, dg: level, df: hertz, dn: cycles } = state;
    const found = designRun(kernels, { demand: { kind, shape, level, hertz, cycles },
        restitution: state.rh === 1 ? null : state.r, nonlinear: state.model === 'nonlinear',
        sizes: { width: state.b, height: state.h } });
    answer([pythonOf(state, 'design'), found.run.peak, found.run.impacts.length]);
    """
    script, peak, impacts = in_node(IMPORTS + lines, {"patch": patch})
    found = printed(run_script(script))
    assert float(found["peak of |theta|/alpha"]) == peak
    assert int(found["impacts"]) == impacts


NAMES = ["RSN77.AT2", "'; rm -rf ~; '", 'a\u2028b"\\', "$(reboot)`x`", "-rf", "\ud800\x00ü 🧱"]


@pytest.mark.parametrize("name", NAMES, ids=ascii)
def test_a_record_is_in_the_script_with_all_its_bits(
    name: str, in_node: InNode, run_script: Callable[[str], list[str]]
) -> None:
    samples = [0.0, 5.1, -4.999999999999999, 1 / 3, 5e-324, -0.0, 1e-7, 2.0]
    asked = {
        "subject": "quake",
        "patch": {"b": 0.5, "h": 2},
        "further": {"scale": 1.3},
        "motion": {"name": name, "dt": 0.2, "acceleration": samples},
    }
    script, command = in_node(IMPORTS + COPIED, asked)
    found = printed(run_script(script))
    record = rs.Record(acceleration_m_s2=np.array(samples), dt_s=0.2).scaled(1.3)
    block = rs.Block.rectangle(width=0.5, height=2.0, restitution=0.8)
    run = rs.simulate(block, record, model=rs.Linear())
    assert float(found["peak of |theta|/alpha"]) == run.peak
    assert int(found["impacts"]) == len(run.impacts)
    words = shlex.split(command)
    plain = "".join(letter for letter in name if letter >= " " and letter != "\x7f")
    assert words[2] == f"--record={plain}".encode("utf-8", "replace").decode() or "\ud800" in name
    assert words[3] == "--scale"


def test_numbers_are_doubles_of_python_with_all_their_bits(in_node: InNode) -> None:
    values = [0.1, -2.0, 1e21, 1e-7, 5e-324, 1.7976931348623157e308, 1 / 3, 123456789.0]
    lines = "answer([...asked.map((value) => pythonNumber(value)), pythonNumber(-0)]);"
    found = in_node(IMPORTS + lines, values)
    for text, value in zip(found, [*values, -0.0], strict=True):
        read = eval(text)
        assert isinstance(read, float)
        assert (read, math.copysign(1.0, read)) == (value, math.copysign(1.0, value))


def test_texts_are_literals_of_python_whatever_they_hold(in_node: InNode) -> None:
    texts = ['"', "\\", "\n", "\u2028", "ü", "🧱", "{x}", "\x7f\x85"]
    found = in_node(IMPORTS + "answer(asked.map(pythonText));", texts)
    assert [eval(text) for text in found] == texts
    assert all(text.isascii() for text in found)


def test_a_link_is_the_address_of_the_page_with_the_view(in_node: InNode) -> None:
    lines = """
    const state = stateOf(asked);
    const address = addressOf(state, 'file:///a/b.html#v=1&A=9');
    answer([address, stateOfLink(new URL(address).hash).state, state]);
    """
    address, again, state = in_node(IMPORTS + lines, {"patch": {"A": 1.5, "start": "0.5,0"}})
    assert address.startswith("file:///a/b.html#v=2&at=lab&")
    assert again == state
    assert set(dict(part.split("=") for part in address.partition("#v=2&")[2].split("&"))) == set(
        state
    )


def test_each_panel_copies_what_it_shows(in_node: InNode) -> None:
    lines = """
    answer(['', 'map', 'strip', 'history', 'basins', 'pulsehistory', 'verdict'].map((panel) =>
        subjectOf(stateOf({ patch: { tab: 'basins' } }), panel)));
    """
    expected = ["basins", "map", "strip", "point", "basins", "pulse", "quake"]
    assert in_node(IMPORTS + lines) == expected
