"""Sweeps of the page against `sweep_attractor`, its curves against `steady_states`."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, DimensionlessBlock, Harmonic, Linear, Nonlinear, Rest, State, Steady
from rocksteady.dynamics.orbits.attractor import KINDS
from rocksteady.formulas import steady_states
from rocksteady.orbits import sweep_attractor
from tests.explorer.in_node import InNode

STARTS: dict[str, Any] = {
    "rest": Rest(),
    "steady": Steady(),
    "state": State(angle=0.3, velocity=-0.4),
}
PARAMETERS = {"w": "frequency_ratio", "a": "amplitude"}
SWEEP = """
const { sweepSteps } = await import(parts('physics/sweep.mjs'));
const found = [];
for (const { given, by, values, start, chunk } of asked) {
  const steps = { kinds: [], periods: [], impacts: [], peaks: [], states: [] };
  let carry = { begin: start, carried: null };
  for (let first = 0; first < values.length; first += chunk) {
    const part = sweepSteps(kernels, {
      given, by, values: values.slice(first, first + chunk), carry, cycles: 300,
    });
    for (const name of ['kinds', 'periods', 'impacts', 'states']) steps[name].push(...part[name]);
    steps.peaks.push(...part.peaks.map((peaks) => [...peaks]));
    carry = structuredClone(part.carry);
  }
  found.push(steps);
}
answer(found);
"""


def cases(count: int) -> list[dict[str, Any]]:
    """Return sweeps to make: both parameters, directions, models, all kinds of start."""
    draw = np.random.default_rng(25)
    asked = []
    for number in range(count):
        by, nonlinear = "wa"[number % 2], number % 4 >= 2
        low = draw.uniform(0.8, 3.0) if by == "w" else draw.uniform(0.2, 1.5)
        ends = [low, low + draw.uniform(0.3, 4.0)][:: draw.choice([1, -1])]
        asked.append(
            {
                "given": {
                    "amplitude": draw.uniform(0.4, 3.0),
                    "frequencyRatio": draw.uniform(1.0, 6.0),
                    "restitution": draw.uniform(0.6, 0.97),
                    "nonlinear": nonlinear,
                    "alpha": draw.uniform(0.1, 0.4),
                },
                "by": by,
                "values": np.linspace(ends[0], ends[1], 9).tolist(),
                "start": list(STARTS)[number % len(STARTS)],
                "chunk": int(draw.integers(1, 10)),
            }
        )
    return asked


def started(name: str) -> dict[str, Any]:
    """Return a start as the page writes it."""
    return {"kind": name, **({"angle": 0.3, "velocity": -0.4} if name == "state" else {})}


def test_steps_are_those_of_the_package_in_chunks_of_any_length(in_node: InNode) -> None:
    asked = cases(24)
    given = [{**each, "start": started(each["start"])} for each in asked]
    met = set()
    for each, steps in zip(asked, in_node(SWEEP, given), strict=True):
        case = each["given"]
        restitution = case["restitution"]
        sweep = sweep_attractor(
            Block.from_p(alpha=case["alpha"], p=3.0, restitution=restitution)
            if case["nonlinear"]
            else DimensionlessBlock(restitution=restitution),
            Harmonic(amplitude=case["amplitude"], frequency_ratio=case["frequencyRatio"]),
            PARAMETERS[each["by"]],
            each["values"],
            start=STARTS[each["start"]],
            max_cycles=300,
            model=Nonlinear() if case["nonlinear"] else Linear(),
        )
        assert [KINDS[code].value for code in steps["kinds"]] == sweep.kinds
        assert [period or None for period in steps["periods"]] == sweep.periods
        assert steps["peaks"] == [peaks.tolist() for peaks in sweep.peaks]
        for attractor, state in zip(sweep.attractors, steps["states"], strict=True):
            if attractor.orbit is not None:
                first = attractor.orbit.states[0]
                assert state == {"side": first.side, "phase": first.phase, "speed": first.speed}
        met |= set(sweep.kinds)
    assert met >= {"symmetric", "unsymmetric", "rest", "overturned"}, "or little is tested"


def test_hysteresis_of_rest_and_the_harmonic_motion(in_node: InNode) -> None:
    """From rest the block stays at rest up to A = 1; from the steady state it rocks below that."""
    given = {
        "amplitude": 1,
        "frequencyRatio": 2,
        "restitution": 0.8,
        "nonlinear": False,
        "alpha": 0,
    }
    up = [0.4, 0.6, 0.8, 1.0]
    shared = {"given": given, "by": "a", "chunk": 2}
    kept, rocking = in_node(
        SWEEP,
        [
            {**shared, "values": up, "start": {"kind": "rest"}},
            {**shared, "values": up[::-1], "start": {"kind": "steady"}},
        ],
    )
    assert kept["kinds"][:3] == [KINDS.index("rest")] * 3
    assert rocking["kinds"][1] == KINDS.index("symmetric")
    assert max(rocking["peaks"][1]) == pytest.approx(0.391, abs=5e-4)


@pytest.mark.parametrize("by", ["w", "a"])
def test_curves_are_the_steady_states_that_are_motions(in_node: InNode, by: str) -> None:
    values = np.linspace(0.5, 9.0, 60).tolist()
    given = {
        "amplitude": 2,
        "frequencyRatio": 5,
        "restitution": 0.8,
        "nonlinear": False,
        "alpha": 0,
    }
    asked = {"given": given, "by": by, "values": values, "orders": [1, 3]}
    curves = in_node(
        """
        const { steadyCurves } = await import(parts('physics/sweep.mjs'));
        answer(steadyCurves(kernels, asked).map((curve) => ({
          ...curve, ...Object.fromEntries(['peaks', 'stable', 'phases', 'speeds'].map(
            (name) => [name, [...curve[name]]])),
        })));
        """,
        asked,
    )
    assert [(curve["order"], curve["branch"]) for curve in curves] == [
        (1, 1),
        (1, 2),
        (3, 1),
        (3, 2),
    ]
    for curve in curves:
        amplitude, ratio = (2.0, values) if by == "w" else (values, 5.0)
        states = steady_states(amplitude, ratio, 0.8, order=curve["order"])
        assert states.peak is not None
        assert states.admissible is not None
        which = curve["branch"] - 1
        expected = {
            "peaks": np.where(states.admissible[which], states.peak[which], math.nan),
            "phases": states.phase[which],
            "speeds": states.velocity[which],
        }
        for name, numbers in expected.items():
            found = np.array(curve[name], dtype=np.float64)  # None is nan in JSON
            assert np.array_equal(found, numbers, equal_nan=True), name
        assert curve["stable"] == states.stable[which].astype(int).tolist()
    assert any(sum(curve["stable"]) for curve in curves if curve["order"] == 3)
