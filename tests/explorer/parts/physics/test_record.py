"""Response to a record on the page against `simulate`, `check_neighbours` and the batches."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import (
    Block,
    Linear,
    Nonlinear,
    Record,
    Status,
    check_neighbours,
    compute_rocking_spectrum,
    simulate,
    simulate_many,
)
from tests.explorer.in_node import InNode
from tests.records import el_centro, rinaldi, synthetic

Floats = NDArray[np.float64]
HEAD = """
const { scaledMotion } = await import(parts('physics/motions.mjs'));
const physics = await import(parts('physics/quake/record.mjs'));
const { measuresOf } = await import(parts('physics/case.mjs'));
const motionOf = ({ samples, dt }) => ({ samples: Float64Array.from(samples), dt });
const blockOf = ({ width, height, restitution, nonlinear }) =>
  ({ ...measuresOf(kernels, width, height), restitution, nonlinear });
const plain = (found) => Object.fromEntries(Object.entries(found).map(([name, value]) =>
  [name, ArrayBuffer.isView(value) ? [...value] : value]));
"""
RUNS = (
    HEAD
    + """
answer(asked.map(({ motion, block, scale }) => plain(physics.runRecord(
  kernels, scaledMotion(motionOf(motion), scale), blockOf(block), 300))));
"""
)


def shocks() -> dict[str, tuple[Floats, float]]:
    """Return motions of all kinds: noise, pulses, steps, spikes, very short and very slow."""
    draw = np.random.default_rng(25)
    time = np.arange(0.0, 3.0, 0.01)
    spike = np.zeros(200)
    spike[100] = 60.0
    return {
        "noise": (synthetic(draw, 2000, 0.02, 5.0), 0.02),
        "strong noise": (synthetic(draw, 1500, 0.01, 12.0), 0.01),
        "pulse": (6.0 * np.sin(2.0 * math.pi * time) * (time < 1.0), 0.01),
        "one step": (np.array([5.0, 0.0]), 0.4),
        "short": (np.array([0.0, 9.0, -9.0, 0.0]), 0.2),
        "spike": (spike, 0.005),
        "tiny step": (synthetic(draw, 400, 1e-6, 8.0), 1e-6),
        "slow": (np.array([0.0, 1.5, 0.5, -1.0, 0.2]), 20.0),
        "weak": (np.array([0.0, 0.1, -0.1, 0.1]), 0.02),
        "zeros around": (np.array([0.0] * 50 + [8.0, 8.0, 8.0] + [0.0] * 400), 0.05),
    }


BLOCKS = [
    {"width": 0.6, "height": 2.4, "restitution": 0.9, "nonlinear": False},
    {"width": 0.5, "height": 2.0, "restitution": 0.8, "nonlinear": True},
    {"width": 0.2, "height": 0.9, "restitution": 0.95, "nonlinear": True},
    {"width": 0.3, "height": 1.8, "restitution": 1.0, "nonlinear": False},
]


def given(samples: Floats, dt: float) -> dict[str, Any]:
    return {"samples": samples.tolist(), "dt": dt}


def made(block: dict[str, Any]) -> tuple[Block, Linear | Nonlinear]:
    model = Nonlinear() if block["nonlinear"] else Linear()
    sizes = {name: block[name] for name in ("width", "height", "restitution")}
    return Block.rectangle(**sizes), model


def agrees(found: dict[str, Any], block: dict[str, Any], record: Record) -> Status:
    """Compare a run of the page with that of the package, all bits, and return how it ended."""
    body, model = made(block)
    run = simulate(body, record, model=model)
    assert found["status"] == run.status.label
    assert found["peak"] == run.peak
    assert found["peakVelocity"] == run.peak_velocity
    assert found["overturned"] == run.overturn_time_pt
    assert found["rested"] == run.rest_time_pt
    assert found["impacts"] == run.impacts.pt.tolist()
    assert found["impactCount"] == run.impact_count
    assert found["impactVelocities"] == run.impacts.velocity_before.tolist()
    assert math.isinf(run.end_time_pt) or found["end"] == run.end_time_pt
    assert found["angle"] == run(found["pt"]).angle.tolist()
    return run.status


def test_runs_are_those_of_the_package_bit_for_bit(in_node: InNode) -> None:
    cases: list[dict[str, Any]] = [
        {"motion": given(*shock), "block": block, "scale": scale}
        for number, shock in enumerate(shocks().values())
        for block, scale in list(zip(BLOCKS, (1.0, 0.7, 1.9, 0.37), strict=True))[number % 2 :: 2]
    ]
    met = set()
    for case, found in zip(cases, in_node(RUNS, cases), strict=True):
        motion = case["motion"]
        record = Record(acceleration_m_s2=motion["samples"], dt_s=motion["dt"])
        met.add(agrees(found, case["block"], record.scaled(case["scale"])))
    assert met >= {Status.AT_REST, Status.OVERTURNED, Status.ROCKING}, "or little is tested"


@pytest.mark.parametrize("real", [el_centro, rinaldi])
def test_runs_under_real_records_are_the_same(in_node: InNode, real: Any) -> None:
    samples, dt = real()
    cases: list[dict[str, Any]] = [
        {"motion": given(samples, dt), "block": block, "scale": scale}
        for block in BLOCKS[:3]
        for scale in (0.8, 1.6)
    ]
    for case, found in zip(cases, in_node(RUNS, cases), strict=True):
        record = Record(acceleration_m_s2=samples, dt_s=dt)
        agrees(found, case["block"], record.scaled(case["scale"]))


def test_neighbours_are_those_of_the_package(in_node: InNode) -> None:
    cases: list[dict[str, Any]] = [
        {"motion": given(*shocks()[name]), "block": block, "scale": 1.1}
        for name in ("noise", "pulse", "short")
        for block in BLOCKS
    ]
    lines = """
    answer(asked.map(({ motion, block, scale }) => {
      const shaking = scaledMotion(motionOf(motion), scale);
      return physics.runNeighbours(
        kernels, shaking, physics.neighbourCases(kernels, blockOf(block)));
    }));
    """
    fell = 0
    for case, found in zip(cases, in_node(HEAD + lines, cases), strict=True):
        body, model = made(case["block"])
        motion = case["motion"]
        record = Record(acceleration_m_s2=motion["samples"], dt_s=motion["dt"]).scaled(1.1)
        neighbours = check_neighbours(simulate(body, record, model=model))
        assert found == [
            {
                "scale": each.scale,
                "restitution": each.restitution,
                "alpha": each.alpha,
                "status": each.status.label,
                "peak": each.peak,
            }
            for each in neighbours.cases
        ]
        fell += neighbours.fall
    assert fell, "or little is tested"


@pytest.mark.slow
@pytest.mark.parametrize("block", BLOCKS)
def test_fates_over_scales_are_those_of_the_batch_in_chunks_of_any_length(
    in_node: InNode, block: dict[str, Any]
) -> None:
    scales = np.linspace(0.05, 3.0, 23).tolist()
    for name in ("noise", "pulse", "one step"):
        samples, dt = shocks()[name]
        asked = {"motion": given(samples, dt), "block": block, "scales": scales}
        lines = """
        const chunks = [1, 4, 23].map((end, k) => asked.scales.slice([0, 1, 4][k], end));
        answer(chunks.map((scales) => plain(physics.fatesOverScales(
          kernels, motionOf(asked.motion), blockOf(asked.block), Float64Array.from(scales)))));
        """
        found = in_node(HEAD + lines, asked)
        body, model = made(block)
        record = Record(acceleration_m_s2=samples, dt_s=dt)
        result = simulate_many(body, record, scales=scales, model=model)
        names = {"status": "status", "impacts": "impacts", "peak": "peak_angle"}
        for key, output in (names | {"peakVelocity": "peak_velocity"}).items():
            joined = [value for part in found for value in part[key]]
            assert joined == result[output].values.tolist(), (name, key)


@pytest.mark.slow
@pytest.mark.parametrize("block", BLOCKS)
def test_rocking_spectra_are_those_of_the_package(in_node: InNode, block: dict[str, Any]) -> None:
    periods = np.geomspace(0.3, 12.0, 40).tolist()
    samples, dt = shocks()["noise"]
    lines = """
    answer(plain(physics.rockingSpectrum(kernels, motionOf(asked.motion), blockOf(asked.block),
      Float64Array.from(asked.periods), asked.scale)));
    """
    asked = {"motion": given(samples, dt), "block": block, "periods": periods, "scale": 1.3}
    found = in_node(HEAD + lines, asked)
    body, model = made(block)
    spectrum = compute_rocking_spectrum(
        Record(acceleration_m_s2=samples, dt_s=dt),
        alpha=body.alpha,
        periods_s=periods,
        restitution=block["restitution"],
        model=model,
        scales=1.3,
    )
    assert found["peak"] == spectrum.peak_angle.values.tolist()
    assert found["status"] == spectrum.status.values.tolist()
    assert found["impacts"] == spectrum.impacts.values.tolist()
    assert len({*found["status"]}) > 1, "or little is tested"


def test_a_motion_that_shakes_no_block_is_refused(in_node: InNode) -> None:
    motions = [
        {"samples": [0.0, 0.0, 0.0], "dt": 0.01},
        {"samples": [0.0, 1.0], "dt": 1e7},
        {"samples": [0.0, 1e60], "dt": 0.01},
        {"samples": [0.0, 1.0], "dt": 0.01},
    ]
    lines = """
    answer(asked.map((motion) => physics.refusedMotion(motionOf(motion), blockOf(%s))));
    """
    block = "{ width: 0.5, height: 2, restitution: 0.8, nonlinear: true }"
    found = in_node(HEAD + lines % block, motions)
    assert [bool(words) for words in found] == [True, True, True, False]


def test_the_motion_of_a_formula_is_what_numpy_makes_of_it(in_node: InNode) -> None:
    lines = """
    const made = await import(parts('physics/quake/synthetic.mjs'));
    const { SYNTHETIC_IN_PYTHON, syntheticMotion } = made;
    const { samples, dt, note, name } = syntheticMotion();
    answer({ samples: [...samples], dt, note, name, expression: SYNTHETIC_IN_PYTHON });
    """
    found = in_node(lines)
    made = eval(found["expression"], {"np": np, "sum": sum})
    assert found["samples"] == made.tolist()
    assert found["expression"] in found["note"]
    assert "not a record" in found["name"]
