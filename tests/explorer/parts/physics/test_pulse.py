"""Pulses of the page against the Python API: fates, windows and histories, bit for bit."""

from typing import Any

import numpy as np
import pytest

from rocksteady import Block, Linear, Nonlinear, Pulse, Status, find_overturning_windows, simulate
from rocksteady.dynamics.history import base_motion
from rocksteady.dynamics.overturning._cases import _table
from rocksteady.dynamics.overturning.window_cells import follow
from rocksteady.formulas import overturning_amplitude
from rocksteady.model.equations import Model
from rocksteady.model.linear_tables import segment_table
from rocksteady.model.motions.pulses import PULSES
from tests.explorer.in_node import InNode

SHAPES = list(PULSES)
QUICK = ["one-sine", "triangle", "ricker"]
OTHERS = [shape for shape in SHAPES if shape not in QUICK]
MODELS: dict[bool, Model] = {False: Linear(), True: Nonlinear()}
ASK = """
const module = await import(parts('physics/demand/%s.mjs'));
answer(asked.map((given) => {
  const found = module.%s(kernels, given);
  for (const [name, value] of Object.entries(found)) {
    if (ArrayBuffer.isView(value)) found[name] = Array.from(value);
  }
  return found;
}));
"""


def struck(draw: np.random.Generator, shape: str, *, nonlinear: bool) -> dict[str, Any]:
    """Return a block that a pulse of some shape meets."""
    return {
        "shape": shape,
        "restitution": draw.uniform(0.5, 0.99),
        "nonlinear": nonlinear,
        "alpha": draw.uniform(0.05, 0.5),
    }


def block_of(given: dict[str, Any]) -> Block:
    """Return that block."""
    return Block.from_p(alpha=given["alpha"], p=2.0, restitution=given["restitution"])


def test_every_shape_of_the_package_has_the_same_segments(in_node: InNode) -> None:
    draw = np.random.default_rng(25)
    asked: list[dict[str, Any]] = [
        {
            "shape": shape,
            "a": draw.uniform(0.5, 9.0),
            "w": draw.uniform(0.1, 20.0),
            "tolerance": part,
        }
        for shape in SHAPES
        for part in (1e-6, 1e-4)
    ]
    lines = """
    const { PULSES } = await import(parts('kernels/pulses.mjs'));
    const { pulseTable } = await import(parts('physics/motions.mjs'));
    const tables = asked.map(({ shape, a, w, tolerance }) =>
      [...pulseTable(kernels, shape, a, w, { nonlinear: false, tolerance }).values]);
    answer({ names: Object.keys(PULSES), tables });
    """
    found = in_node(lines, asked)
    assert sorted(found["names"]) == sorted(SHAPES)
    for given, values in zip(asked, found["tables"], strict=True):
        pulse = Pulse(
            shape=given["shape"],
            amplitude=given["a"],
            frequency_ratio=given["w"],
            tolerance=given["tolerance"],
        )
        table = segment_table(pulse).ravel()
        assert values == [value if np.isfinite(value) else None for value in table.tolist()]


@pytest.mark.slow
@pytest.mark.parametrize("nonlinear", MODELS)
def test_fates_over_frequency_and_amplitude_are_those_of_the_package(
    in_node: InNode, nonlinear: bool
) -> None:
    draw = np.random.default_rng(26)
    asked = []
    for shape in SHAPES:
        given = struck(draw, shape, nonlinear=nonlinear)
        ratios = np.repeat(draw.uniform(0.3, 12.0, 3), 20)
        amplitudes = draw.uniform(0.0, 15.0, 60)
        asked.append({**given, "ratios": ratios.tolist(), "amplitudes": amplitudes.tolist()})
    overturned = set()
    for given, found in zip(asked, in_node(ASK % ("pulse", "pulseFates"), asked), strict=True):
        block, pulse = block_of(given), Pulse(shape=given["shape"], amplitude=1, frequency_ratio=1)
        body = block if nonlinear else block.dimensionless()
        model = MODELS[nonlinear]
        table, sides = _table(body, model, pulse), model.sides(body)
        for first in range(0, 60, 20):
            part = slice(first, first + 20)
            amplitude = np.array(given["amplitudes"][part])
            fates = follow(amplitude, table=table, sides=sides, ratio=given["ratios"][first])
            margin = [-1.0 if value is None else value for value in found["margin"][part]]
            falls = np.array(found["status"][part]) == Status.OVERTURNED
            assert falls.tolist() == fates.overturns.tolist()
            assert found["impacts"][part] == fates.impacts.tolist()
            assert found["side"][part] == fates.side.tolist()
            assert found["during"][part] == fates.during.tolist()
            assert margin == fates.margin.tolist()
            overturned |= set(falls.tolist())
    assert overturned == {False, True}


@pytest.mark.slow
@pytest.mark.parametrize(("shapes", "nonlinear"), [(QUICK, True), (OTHERS, False)])
def test_windows_at_one_frequency_are_those_of_the_package(
    in_node: InNode, shapes: list[str], nonlinear: bool
) -> None:
    draw = np.random.default_rng(27)
    asked = [
        {**struck(draw, shape, nonlinear=nonlinear), "ratio": draw.uniform(1.5, 5.0)}
        for shape in shapes
    ]
    counts = set()
    for given, found in zip(asked, in_node(ASK % ("windows", "pulseWindows"), asked), strict=True):
        searched = find_overturning_windows(
            block_of(given), given["shape"], [given["ratio"]], model=MODELS[nonlinear]
        )
        windows = searched.at(0)
        counts.add(len(windows))
        names = ("low", "high", "impacts", "side")
        assert found["windows"] == [{n: getattr(each, n) for n in names} for each in windows]
        assert (found["low"], found["high"]) == searched.within
        assert found["leftOut"] == searched.left_out[0]
        assert found["unsettled"] == searched.unsettled[0]
        assert found["undecided"] == searched.undecided[0]
    assert len(counts) > 1


def test_the_last_window_of_a_half_sine_begins_at_the_closed_form(in_node: InNode) -> None:
    ratios = [0.5, 2.0, 7.0]
    block = {"shape": "half-sine", "restitution": 0.9, "nonlinear": False, "alpha": 0.2}
    found = in_node(ASK % ("windows", "pulseWindows"), [{**block, "ratio": w} for w in ratios])
    for ratio, one in zip(ratios, found, strict=True):
        closed = overturning_amplitude("half-sine", ratio)
        assert one["windows"][-1]["impacts"] == 0
        assert one["windows"][-1]["low"] == pytest.approx(closed, rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("nonlinear", MODELS)
def test_histories_are_those_of_simulate(in_node: InNode, nonlinear: bool) -> None:
    draw = np.random.default_rng(28)
    asked = [
        {
            **struck(draw, shape, nonlinear=nonlinear),
            "amplitude": draw.uniform(0.8, 8.0),
            "ratio": draw.uniform(0.8, 8.0),
            "samples": 80,
        }
        for shape in SHAPES
    ]
    statuses = set()
    for given, found in zip(asked, in_node(ASK % ("pulse", "pulseHistory"), asked), strict=True):
        pulse = Pulse(
            shape=given["shape"], amplitude=given["amplitude"], frequency_ratio=given["ratio"]
        )
        run = simulate(block_of(given), pulse, model=MODELS[nonlinear])
        statuses.add(run.status)
        assert found["status"] == run.status.label.replace("-", " ")
        assert (found["peak"], found["end"]) == (run.peak, run.end_time_pt)
        assert (found["overturns"], found["rests"]) == (run.overturn_time_pt, run.rest_time_pt)
        assert found["impacts"] == run.impacts.pt.tolist()
        assert found["impactSpeeds"] == run.impacts.velocity_before.tolist()
        motion, count = run(found["times"]), len(found["times"])
        assert found["states"][:count] == motion.angle.tolist()
        assert found["states"][count : 2 * count] == motion.velocity.tolist()
        course = base_motion.base_acceleration(run.segments, np.array(found["times"]))
        assert found["base"] == course.tolist()
        assert found["duration"] == base_motion.segment_starts(run.segments)[-1]
    assert statuses == {Status.OVERTURNED, Status.AT_REST}
