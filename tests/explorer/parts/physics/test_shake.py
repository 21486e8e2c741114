"""Shaken blocks of the laboratory against runs of the package."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, Harmonic, Nonlinear, Pulse, Status, find_attractor, simulate
from tests.explorer.in_node import InNode

BLOCK = Block.rectangle(width=0.25, height=1.0, restitution=0.8)
CELLS = """
const { shakenCells } = await import(parts('physics/shake.mjs'));
answer(asked.map((one) => [...shakenCells(kernels, { ...one, x: one.hz, y: one.g }).fate]));
"""
RUNS = """
const { shakenRun } = await import(parts('physics/shake.mjs'));
answer(asked.map((one) => {
  const { reel, places, ...rest } = shakenRun(kernels, one);
  return { ...rest, last: reel.angle[reel.angle.length - 1], base: [...reel.base].slice(0, 40),
    places: [...places], step: reel.step };
}));
"""
STRENGTHS = (0.2, 0.3, 0.45, 0.7, 0.9, 1.1, 1.3)
RATES = (0.6, 1.2, 2.16, 3.0)


def block_asked() -> dict[str, object]:
    """The block as the page has it."""
    return {
        "alpha": BLOCK.alpha,
        "p": BLOCK.p,
        "radius": BLOCK.radius,
        "restitution": BLOCK.restitution,
        "nonlinear": True,
    }


def scaled(strength: float, rate: float) -> dict[str, float]:
    """Amplitude and frequency ratio of a strength [g] and a frequency [Hz]."""
    return {
        "amplitude": strength / BLOCK.alpha,
        "frequency_ratio": 2.0 * math.pi * rate / BLOCK.p,
    }


def test_fates_of_one_push_are_those_of_simulated_pulses(in_node: InNode) -> None:
    places = [(g, hz) for g in STRENGTHS for hz in RATES]
    g, hz = zip(*places, strict=True)
    (codes,) = in_node(CELLS, [{"block": block_asked(), "push": True, "g": g, "hz": hz}])
    expected = []
    for strength, rate in places:
        amplitude, ratio = scaled(strength, rate).values()
        motion = Pulse(shape="one-sine", amplitude=amplitude, frequency_ratio=ratio)
        run = simulate(BLOCK, motion)
        falls = run.status is Status.OVERTURNED
        lifts = strength > math.tan(BLOCK.alpha)
        expected.append(2 + (len(run.impacts) > 0) if falls else int(lifts))
    assert codes == expected
    assert set(codes) == {0, 1, 2, 3}


def test_fates_of_64_shakes_are_those_of_simulated_ones(in_node: InNode) -> None:
    places = [(g, hz) for g in STRENGTHS for hz in RATES]
    g, hz = zip(*places, strict=True)
    (codes,) = in_node(CELLS, [{"block": block_asked(), "push": False, "g": g, "hz": hz}])
    for (strength, rate), code in zip(places, codes, strict=True):
        motion = Harmonic(**scaled(strength, rate))
        falls = simulate(BLOCK, motion, cycles=64).status is Status.OVERTURNED
        lifts = strength > math.tan(BLOCK.alpha)
        assert code == (2 if falls else int(lifts)), (strength, rate)
    assert set(codes) == {0, 1, 2}


def test_a_run_ends_as_its_fate_says_and_leans_as_its_attractor(in_node: InNode) -> None:
    asked = [
        {"block": block_asked(), "push": push, "g": g, "hz": hz}
        for push in (True, False)
        for g in STRENGTHS
        for hz in RATES
    ]
    runs: list[dict[str, Any]] = in_node(RUNS, asked)
    flat = 0.5 * math.pi / BLOCK.alpha
    settled = 0
    for given, run in zip(asked, runs, strict=True):
        falls = run["fate"] in (2, 3)
        assert falls == (abs(run["last"]) >= flat * (1.0 - 1e-6)) == (run["lies"] is not None)
        if run["fate"] == 1 and not given["push"] and run["period"]:
            motion = Harmonic(**scaled(float(given["g"]), float(given["hz"])))  # type: ignore[arg-type]
            found = find_attractor(BLOCK, motion, model=Nonlinear())
            assert found.orbit is not None
            peak = max(found.orbit.highest, -found.orbit.lowest) * BLOCK.alpha
            assert run["lean"] == pytest.approx(peak, rel=1e-9)
            assert (run["kind"], run["period"]) == (found.kind.value, found.period)
            settled += 1
    assert settled > 5


def test_ground_that_does_not_move_leaves_the_block_at_rest(in_node: InNode) -> None:
    asked = [{"block": block_asked(), "push": push, "g": 0.0, "hz": 2.0} for push in (False, True)]
    for run in in_node(RUNS, asked):
        assert (run["fate"], run["last"], run["lies"], run["lean"]) == (0, 0.0, None, 0.0)
        assert set(run["places"]) == {0.0}


def test_the_ground_of_a_film_is_the_integral_of_its_push(in_node: InNode) -> None:
    g, hz = 0.5, 1.0
    on, push = in_node(
        RUNS, [{"block": block_asked(), "push": push, "g": g, "hz": hz} for push in (False, True)]
    )
    time = on["step"] * np.arange(len(on["places"]))
    omega = 2.0 * math.pi * hz
    size = g * 9.80665 / omega**2
    np.testing.assert_allclose(on["places"], -size * np.sin(omega * time), atol=3e-3 * size)
    # One sine carries the ground g/omega times its length, and leaves it there.
    assert push["places"][-1] == pytest.approx(g * 9.80665 / omega / hz, rel=1e-3)
