"""Blocks that are let go, and blocks of many sizes, against runs of the package."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    Harmonic,
    Nonlinear,
    Pulse,
    State,
    Status,
    compute_basins,
    find_attractor,
    simulate,
)
from tests.explorer.in_node import InNode

BLOCK = Block.rectangle(width=0.3, height=1.0, restitution=0.9)
MOTION = Harmonic(amplitude=0.6, frequency_ratio=2.5)
RUNS = """
const { releasedRun } = await import(parts('physics/released.mjs'));
answer(asked.map((one) => {
  const { reel, places, ...rest } = releasedRun(kernels, one);
  const last = reel.angle.length - 1;
  return { ...rest, first: reel.angle[0], last: reel.angle[last], place: places[last] };
}));
"""
CELLS = """
const { startCells } = await import(parts('physics/released.mjs'));
answer([...startCells(kernels, asked).fate]);
"""
CURVE = """
const { rockCurve } = await import(parts('physics/released.mjs'));
answer(rockCurve(kernels, asked));
"""
SIZES = """
const { sizeCells, widthTurn } = await import(parts('physics/shake.mjs'));
const { x, y, ...shaking } = asked;
answer([[...sizeCells(kernels, asked).fate], x.map((width, k) =>
  widthTurn(kernels, { ...shaking, width, height: y[k], least: 0.05, most: 0.9 * y[k] }))]);
"""
CODES = {"rest": 0, "overturned": 2, "undecided": 4}


def released(amplitude: float, ratio: float) -> dict[str, Any]:
    """The block on its ground as the page has it."""
    block = {
        "alpha": BLOCK.alpha,
        "p": BLOCK.p,
        "radius": BLOCK.radius,
        "restitution": BLOCK.restitution,
        "nonlinear": True,
    }
    return {"block": block, "amplitude": amplitude, "ratio": ratio}


def test_cells_and_runs_are_those_of_the_basins(in_node: InNode) -> None:
    angles, velocities = np.linspace(-0.9, 0.9, 4), np.linspace(-0.6, 0.6, 3)
    basins = compute_basins(BLOCK, MOTION, angles=angles, velocities=velocities, model=Nonlinear())
    states = [(float(u), float(v)) for v in velocities for u in angles]
    x, y = zip(*states, strict=True)
    codes = in_node(CELLS, {**released(0.6, 2.5), "x": x, "y": y})
    kinds = [basins.attractors[int(k)].kind.value for k in basins.label.ravel()]
    assert codes == [CODES.get(kind, 1) for kind in kinds]
    assert len(set(codes)) > 1
    runs = in_node(RUNS, [{**released(0.6, 2.5), "angle": u, "velocity": v} for u, v in states])
    for (u, v), run, code in zip(states, runs, codes, strict=True):
        found = find_attractor(BLOCK, MOTION, start=State(angle=u, velocity=v), model=Nonlinear())
        assert (run["fate"], run["kind"], run["period"]) == (code, found.kind.value, found.period)
        assert run["first"] == u
        assert (code == 2) == (abs(run["last"]) >= 0.5 * math.pi / BLOCK.alpha * (1.0 - 1e-6))


def test_the_first_rock_lasts_from_the_first_impact_to_the_second(in_node: InNode) -> None:
    tilts = [0.05, 0.3, 0.7, 0.95]
    curve = in_node(CURVE, {"block": released(0.0, 1.0)["block"], "tilts": tilts})
    runs = in_node(RUNS, [{**released(0.0, 1.0), "angle": u, "velocity": 0.0} for u in tilts])
    still = Harmonic(amplitude=0.0, frequency_ratio=1.0)
    for u, point, run in zip(tilts, curve, runs, strict=True):
        motion = simulate(BLOCK, still, start=State(angle=u, velocity=0.0), cycles=10)
        first, second = motion.impacts.pt[:2] / BLOCK.p
        assert point == {"x": u, "y": pytest.approx(second - first, rel=1e-9)}
        assert run["rock"] == pytest.approx(point["y"], rel=1e-12)
        assert run["place"] == 0.0


@pytest.mark.parametrize("push", [True, False])
def test_sizes_stand_and_fall_as_their_blocks(push: bool, in_node: InNode) -> None:
    strength, rate = 0.5, 1.5
    sizes = [(b, h) for b in (0.15, 0.3, 0.45, 0.7) for h in (0.8, 2.0)]

    def fate(width: float, height: float) -> int:
        block = Block.rectangle(width=width, height=height)
        if strength <= width / height:
            return 0
        scaled = {
            "amplitude": strength / block.alpha,
            "frequency_ratio": 2.0 * math.pi * rate / block.p,
        }
        if push:
            run = simulate(block, Pulse(shape="one-sine", **scaled))  # type: ignore[arg-type]
        else:
            run = simulate(block, Harmonic(**scaled), cycles=64)
        if run.status is not Status.OVERTURNED:
            return 1
        return 2 + (push and len(run.impacts) > 0)

    x, y = zip(*sizes, strict=True)
    asked = {"restitution": None, "push": push, "hz": rate, "g": strength, "x": x, "y": y}
    codes, turns = in_node(SIZES, asked)
    assert codes == [fate(b, h) for b, h in sizes]
    assert {0, 1, 2} <= set(codes)
    for (width, height), code, turn in zip(sizes, codes, turns, strict=True):
        assert turn["falls"] == (code > 1)
        if turn["turns"] is None:
            alike = () if turn["last"] is None else np.linspace(width, turn["last"], 9)
            assert {fate(float(b), height) > 1 for b in alike} <= {turn["falls"]}
            continue
        steps = round((turn["turns"] - width) / 0.01)
        assert (steps > 0) == turn["falls"]
        way = 1 if steps > 0 else -1
        beside = [fate(width + 0.01 * way * k, height) > 1 for k in range(abs(steps) + 1)]
        assert beside[0] == turn["falls"] != beside[-1]
