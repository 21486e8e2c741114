"""The numbers of the six scenes against the package, to the last bit where one is shown."""

from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    Harmonic,
    Pulse,
    Record,
    State,
    Status,
    Steady,
    Still,
    check_neighbours,
    find_attractor,
    simulate,
)
from rocksteady.outcomes import AttractorKind
from tests.explorer.in_node import InNode

G = 9.80665
HEAD = """
const { rectangle, pulseReel, fatesAsked } = await import(parts('physics/story/pulses.mjs'));
const plain = ({ reel, ...rest }) => ({ ...rest, falls: reel.falls, peak: reel.peak,
  overturns: reel.overturns, times: [...reel.impacts.time], speeds: [...reel.impacts.speed],
  last: reel.angle[reel.angle.length - 1] });
"""
SWING = (
    HEAD
    + """
const { letGo, restitutionHeard, rockTimes } = await import(parts('physics/story/swing.mjs'));
const block = rectangle(kernels, 0.3, 1);
const swing = letGo(kernels, block, asked.tilt, 5);
answer({ ...plain(swing), times_of: rockTimes(kernels, block),
  heard: restitutionHeard(kernels, block, [...swing.reel.impacts.time].slice(0, 8)) });
"""
)
PULSES = (
    HEAD
    + """
answer(asked.map(({ width, height, restitution, strength, hertz }) => plain({
  reel: pulseReel(kernels, rectangle(kernels, width, height, restitution), strength, hertz, 5),
})));
"""
)
FATES = """
const { stateFates } = await import(parts('physics/story/fates.mjs'));
answer(stateFates(kernels, asked));
"""
ORDER = """
const { cascadeOf, orderAt } = await import(parts('physics/story/order.mjs'));
const { amplitudes, starts, falls } = cascadeOf(kernels, asked);
answer({ falls, orders: amplitudes.map((amplitude, k) =>
  orderAt(kernels, { amplitude, start: starts[k] })) });
"""
CROWD = (
    HEAD
    + """
const { crowdReels } = await import(parts('physics/story/crowd.mjs'));
const { syntheticMotion } = await import(parts('physics/quake/synthetic.mjs'));
const { samples, dt } = syntheticMotion(), block = rectangle(kernels, 0.6, 2);
answer({ samples: [...samples], dt, runs: asked.map((scale) => crowdReels(kernels,
  { motion: { samples, dt }, block, scale, seconds: 12 }).map((reel) => plain({ reel }))) });
"""
)
WORDS = """
const { storyWords } = await import(parts('story/words.mjs'));
answer(asked.map(storyWords));
"""


def test_a_block_that_is_let_go_strikes_when_the_package_says(in_node: InNode) -> None:
    block = Block.rectangle(width=0.3, height=1.0)
    for tilt in (0.05, 0.8, 0.98):
        found = in_node(SWING, {"tilt": tilt})
        run = simulate(block, Still(), start=State(angle=tilt, velocity=0.0))
        times = run.impacts.pt / block.p
        count = min(8, len(times), len(found["times"]))
        assert found["times"][:count] == times[:count].tolist()
        assert found["rocks"][: count - 1] == np.diff(times)[: count - 1].tolist()
        assert found["heard"] == pytest.approx(block.restitution, abs=2e-3)
        # The further it tilts, the longer it takes.
        known = [each["time"] for each in found["times_of"]]
        assert known == sorted(known)


CASES = [
    *({"width": h / 4.0, "height": h, "strength": 0.45, "hertz": 1.0 / t}
      for h in (0.5, 1.0, 2.0) for t in (0.2, 0.35, 0.5, 1.0)),
    *({"width": 0.25, "height": 1.0, "restitution": 0.8, "strength": g, "hertz": 2.16}
      for g in (0.2, 0.3, 0.43, 0.7, 1.05, 1.3)),
]  # fmt: skip


def test_blocks_under_a_pulse_do_what_the_package_says(in_node: InNode) -> None:
    found = in_node(PULSES, CASES)
    fates = set()
    for case, reel in zip(CASES, found, strict=True):
        sizes = {name: case[name] for name in ("width", "height", "restitution") if name in case}
        block = Block.rectangle(**sizes)
        pulse = Pulse.from_si(
            block,
            shape="one-sine",
            acceleration_m_s2=case["strength"] * G,
            frequency_hz=case["hertz"],
        )
        run = simulate(block, pulse)
        falls = run.status is Status.OVERTURNED
        fates.add((falls, len(run.impacts.pt) > 0))
        assert reel["falls"] == falls, case
        times = (run.impacts.pt / block.p).tolist()
        if falls:
            assert reel["times"] == times, case
            assert reel["overturns"] == pytest.approx(run.overturn_time_s, rel=1e-12)
            assert abs(reel["last"]) == pytest.approx(0.5 * np.pi / block.alpha)
        else:
            assert reel["times"][:5] == times[:5], case
            assert reel["peak"] == run.peak, case
    assert fates == {(True, True), (True, False), (False, True), (False, False)}


def test_states_come_to_what_the_package_finds(in_node: InNode) -> None:
    block = Block.rectangle(width=0.3, height=1.0, restitution=0.8)
    rng = np.random.default_rng(4)
    angles, velocities = rng.uniform(-1.1, 1.1, (2, 25))
    asked = {"alpha": block.alpha, "angles": angles.tolist(), "velocities": velocities.tolist()}
    found = in_node(FATES, asked)
    words = {AttractorKind.REST: "rest", AttractorKind.OVERTURNED: "overturned"}
    for fate, angle, velocity in zip(found, angles, velocities, strict=True):
        attractor = find_attractor(
            block,
            Harmonic(amplitude=0.5, frequency_ratio=2.0),
            start=State(angle=float(angle), velocity=float(velocity)),
        )
        assert fate == words.get(attractor.kind, "rocking"), (angle, velocity)
    assert set(found) == {"rest", "rocking", "overturned"}


@pytest.mark.slow
def test_the_cascade_has_the_kinds_and_periods_of_the_package(in_node: InNode) -> None:
    amplitudes = np.linspace(2.0, 2.75, 61).tolist()
    found = in_node(ORDER, {"amplitudes": amplitudes})
    assert found["falls"] == pytest.approx(2.7125, abs=0.02)
    kinds = [(each["kind"], each["period"]) for each in found["orders"]]
    for kind in [("symmetric", 1), ("unsymmetric", 1), ("unsymmetric", 2)]:
        assert kind in kinds
    block = Block.rectangle(width=0.5, height=2.0, restitution=0.8)
    for k in (0, 5, 20, 40):
        attractor = find_attractor(
            block, Harmonic(amplitude=amplitudes[k], frequency_ratio=2.0), start=Steady()
        )
        assert attractor.kind.value == kinds[k][0]
    for each in found["orders"]:
        # What repeats draws two blocks together; what does not, parts them.
        if each["period"]:
            assert each["apart"][-1] < 1e-5


def test_the_cabinet_and_its_neighbours_end_as_the_package_says(in_node: InNode) -> None:
    block = Block.rectangle(width=0.6, height=2.0)
    scales = (0.75, 0.5 / 0.54, 1.3)
    found = in_node(CROWD, scales)
    motion = Record(acceleration_m_s2=np.array(found["samples"]), dt_s=found["dt"])
    for scale, runs in zip(scales, found["runs"], strict=True):
        scaled = motion.scaled(scale)
        own, *others = [each["falls"] for each in runs]
        run = simulate(block, scaled)
        assert own == (run.status is Status.OVERTURNED)
        wanted = [each.status is Status.OVERTURNED for each in check_neighbours(run).cases]
        assert len(others) == len(wanted) == 26
        assert sum(others) == sum(wanted)


STORY = {
    "alpha": 0.2914567944778671, "lift": 0.3, "reach": 0.124, "top": 0.412, "impacts": 3,
    "peak": 0.5, "angle": 0.2, "rocks": False, "lies": False, "quiet": True,
}  # fmt: skip
TOLD: list[tuple[dict[str, Any], str, str]] = [
    ({"lies": True}, "It fell. You moved the ground 12 cm at 0.41 g.", "after 3 impacts"),
    ({"lies": True, "impacts": 0}, "It fell.", "at once, without an impact"),
    ({"rocks": True}, "It rocks.", "3.3° of 16.7° · 3 impacts"),
    ({"rocks": True, "angle": 1.2}, "Past its tipping angle.", ""),
    ({"rocks": True, "angle": 0.01, "impacts": 30}, "It settles.", "more than 20 impacts"),
    ({}, "It stood. You moved the ground 12 cm", "it leaned 8.3°; past 16.7° it tips"),
    ({"peak": 0, "impacts": 0, "top": 0.2}, "It did not lift: that needs 0.30 g.", "0.20 g"),
    ({"peak": 0, "impacts": 0, "top": 0.001}, "", ""),
]


def test_the_landing_says_what_happened(in_node: InNode) -> None:
    found = in_node(WORDS, [STORY | changed for changed, _, _ in TOLD])
    for said, (changed, sentence, facts) in zip(found, TOLD, strict=True):
        assert said["sentence"].startswith(sentence), changed
        assert facts in said["facts"], changed
