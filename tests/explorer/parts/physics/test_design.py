"""Blocks of many sizes against one demand: the page against `simulate`, bit for bit."""

from typing import Any

import numpy as np
import pytest

from rocksteady import Block, Harmonic, Linear, Nonlinear, Pulse, Record, Status, simulate
from rocksteady.errors import InputError
from rocksteady.histories import Trajectory
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.blocks.housner_forms import Restitution
from rocksteady.model.equations import Model
from rocksteady.model.motions.pulses import PULSES
from tests.explorer.in_node import InNode

STANDS, OVERTURNS, UNDECIDED, IMPOSSIBLE = range(4)
MODELS: dict[bool, Model] = {False: Linear(), True: Nonlinear()}
ASK = """
const module = await import(parts('physics/demand/design.mjs'));
answer(asked.map((given) => module.%s(kernels, given)));
"""


def demands(draw: np.random.Generator) -> list[dict[str, Any]]:
    """Return demands of all kinds, every pulse among them."""
    time = np.arange(0.0, 6.0, 0.02)
    samples = 3.0 * np.sin(5.0 * time) * np.exp(-0.3 * (time - 3.0) ** 2) + draw.normal(size=300)
    found: list[dict[str, Any]] = []
    for shape in PULSES:
        level, hertz = draw.uniform(0.1, 1.0), draw.uniform(0.4, 4.0)
        found.append({"kind": "pulse", "shape": shape, "level": level, "hertz": hertz})
        level, hertz = draw.uniform(0.1, 0.6), draw.uniform(0.8, 5.0)
        found.append({"kind": "harmonic", "level": level, "hertz": hertz, "cycles": 15})
        record = {"kind": "record", "dt": 0.02, "acceleration": samples.tolist()}
        found.append({**record, "scale": draw.uniform(0.2, 2.0)})
    return found


def cases() -> list[dict[str, Any]]:
    """Return blocks under these demands, of both models, with Housner's restitution or another."""
    draw = np.random.default_rng(29)
    found = []
    for number, demand in enumerate(demands(draw)):
        width, height = draw.uniform(0.2, 1.0), draw.uniform(0.9, 4.0)
        alpha, radius = draw.uniform(0.1, 0.4), draw.uniform(0.3, 3.0)
        by_lengths = {"width": width, "height": height}
        found.append(
            {
                "demand": demand,
                "restitution": None if number % 2 else draw.uniform(0.5, 0.97),
                "nonlinear": bool(number // 3 % 2),
                "sizes": by_lengths if number % 4 else {"alpha": alpha, "radius": radius},
            }
        )
    return found


def run_of(given: dict[str, Any]) -> Trajectory:
    """Return what Python makes of a case."""
    demand, own = given["demand"], given["restitution"]
    restitution: Restitution = "housner" if own is None else own
    if "alpha" in given["sizes"]:
        block = Block.from_radius(**given["sizes"], restitution=restitution)
    else:
        block = Block.rectangle(**given["sizes"], restitution=restitution)
    model = MODELS[given["nonlinear"]]
    if demand["kind"] == "record":
        record = Record(acceleration_m_s2=np.array(demand["acceleration"]), dt_s=demand["dt"])
        return simulate(block, record.scaled(demand["scale"]), model=model)
    level, hertz = demand["level"] * STANDARD_GRAVITY, demand["hertz"]
    if demand["kind"] == "harmonic":
        shaking = Harmonic.from_si(block, acceleration_m_s2=level, frequency_hz=hertz)
        return simulate(block, shaking, cycles=demand["cycles"], model=model)
    shape = demand["shape"]
    pulse = Pulse.from_si(block, shape=shape, acceleration_m_s2=level, frequency_hz=hertz)
    return simulate(block, pulse, model=model)


@pytest.mark.slow
def test_runs_of_blocks_are_those_of_simulate(in_node: InNode) -> None:
    asked, fates = cases(), set()
    for given, found in zip(asked, in_node(ASK % "designRun", asked), strict=True):
        run, block, shown = run_of(given), found["block"], found["run"]
        fates.add((given["demand"]["kind"], found["fate"]))
        assert found["fate"] == (OVERTURNS if run.status is Status.OVERTURNED else STANDS)
        assert shown["status"] == run.status.label.replace("-", " ")
        assert (shown["peak"], shown["end"]) == (run.peak, run.end_time_pt)
        assert (shown["overturns"], shown["rests"]) == (run.overturn_time_pt, run.rest_time_pt)
        assert isinstance(run.block, Block)
        for name in ("alpha", "radius", "p", "restitution"):
            assert block[name] == getattr(run.block, name)
        assert run.uplift_g in (None, block["uplift"])
    assert {(kind, fate) for kind in ("pulse", "record") for fate in (STANDS, OVERTURNS)} <= fates


@pytest.mark.parametrize("nonlinear", MODELS)
def test_cells_of_the_plane_are_runs_of_their_blocks(in_node: InNode, nonlinear: bool) -> None:
    pulse = {"kind": "pulse", "shape": "one-sine", "level": 0.5, "hertz": 1.2}
    given = {"demand": pulse, "restitution": None, "nonlinear": nonlinear}
    grid = [(w, h) for w in np.linspace(0.2, 1.1, 7) for h in np.linspace(0.8, 3.0, 6)]
    sizes = [{"width": width, "height": height} for width, height in grid]
    lines = """
    const { designCells } = await import(parts('physics/demand/design.mjs'));
    const { fates, peaks } = designCells(kernels, asked);
    answer({ fates: [...fates], peaks: [...peaks] });
    """
    found = in_node(lines, {**given, "sizes": sizes})
    for each, fate, peak in zip(sizes, found["fates"], found["peaks"], strict=True):
        run = run_of({**given, "sizes": each})
        falls = run.status is Status.OVERTURNED
        assert (fate, peak) == ((OVERTURNS, None) if falls else (STANDS, run.peak))
    assert set(found["fates"]) == {STANDS, OVERTURNS}


def test_neighbours_are_runs_of_their_own(in_node: InNode) -> None:
    pulse = {"kind": "pulse", "shape": "one-sine", "level": 0.55, "hertz": 1.1}
    given = {"demand": pulse, "restitution": None, "nonlinear": True}
    sizes = {"width": 0.6, "height": 1.8}
    (found,) = in_node(ASK % "designNeighbours", [{**given, **sizes}])
    fates = {each["change"]: (each["fate"], each["peak"]) for each in found}
    changed: dict[str, dict[str, Any]] = {
        "demand +10 %": {"demand": {**pulse, "level": 1.1 * 0.55}},
        "frequency −10 %": {"demand": {**pulse, "hertz": 0.9 * 1.1}},
        "width −10 %": {"sizes": {**sizes, "width": 0.9 * 0.6}},
        "height +10 %": {"sizes": {**sizes, "height": 1.1 * 1.8}},
    }
    for change, other in changed.items():
        run = run_of({**given, "sizes": sizes, **other})
        falls = run.status is Status.OVERTURNED
        assert fates[change] == (OVERTURNS if falls else STANDS, run.peak)
    assert len(fates) == 10


def test_a_block_that_housner_lets_not_rock_is_told_apart(in_node: InNode) -> None:
    pulse = {"kind": "pulse", "shape": "one-sine", "level": 0.5, "hertz": 1.0}
    sizes = {"width": 1.5, "height": 1.0}
    given = {"demand": pulse, "restitution": None, "nonlinear": False, "sizes": sizes}
    (found,) = in_node(ASK % "designRun", [given])
    assert (found["fate"], found["run"]) == (IMPOSSIBLE, None)
    with pytest.raises(InputError):
        Block.rectangle(**sizes)
