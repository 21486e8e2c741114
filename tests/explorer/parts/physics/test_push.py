"""The ground under a hand, and the block on it, against a filter and `simulate` in Python."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import Block, Record, Status, simulate
from tests.explorer.in_node import InNode

Floats = NDArray[np.float64]
RATE, SPRING, MOST = 480.0, 11.0, 1.2 * 9.80665
BLOCK = Block.rectangle(width=0.3, height=1.0)
PIXEL = 1.0 / 250.0
"""Of a small phone [m]; a larger window has smaller ones."""
PUSHED = """
const { PUSH_STEP, STILL_GROUND, pulledGround } = await import(parts('physics/push/spring.mjs'));
const { STANDING, pushOn } = await import(parts('physics/push/pushed.mjs'));
const { rectangleOf } = await import(parts('physics/case.mjs'));
const measures = rectangleOf(kernels, { width: 0.3, height: 1 });
const block = { ...measures, restitution: measures.housner, nonlinear: true };
let ground = STILL_GROUND, state = STANDING, at = 0, lies = false, peak = 0;
const pushes = [0], places = [0], impacts = [];
for (const count of asked.frames) {
  const samples = [ground.push];
  for (let k = 0; k < count; k++) {
    ground = pulledGround(ground, asked.hand[at + k]);
    samples.push(ground.push);
    places.push(ground.place);
  }
  pushes.push(...samples.slice(1));
  if (!lies) {
    const step = pushOn(kernels, block, state, Float64Array.from(samples));
    ({ state, lies } = step);
    peak = Math.max(peak, step.peak);
    impacts.push(...step.impacts.map(({ time, side }) => [at * PUSH_STEP + time, side]));
  }
  at += count;
}
answer({ pushes, places, impacts, lies, peak, side: state.side });
"""


def frames(count: int, rng: np.random.Generator) -> list[int]:
    """Return samples of frames of 60 a second, of which some come late."""
    found: list[int] = []
    while sum(found) < count:
        found.append(min(int(rng.choice([8, 8, 8, 8, 7, 9, 16])), count - sum(found)))
    return found


def pulled(hand: Floats) -> Floats:
    """Return accelerations of the ground [m/s^2]: three unknowns a sample, solved at once."""
    h, w = 1.0 / RATE, SPRING
    place, speed, push = 0.0, 0.0, 0.0
    found = [push]
    for there in hand:
        equations = np.array(
            [[1.0, 0.0, -h * h / 6.0], [0.0, 1.0, -h / 2.0], [w * w, 2.0 * w, 1.0]]
        )
        known = [place + h * speed + h * h * push / 3.0, speed + h * push / 2.0, w * w * there]
        push_there = float(np.clip(np.linalg.solve(equations, known)[2], -MOST, MOST))
        place = known[0] + h * h * push_there / 6.0
        speed = known[1] + h * push_there / 2.0
        push = push_there
        found.append(push)
    return np.array(found)


def ran(in_node: InNode, hand: Floats, seed: int = 1) -> Any:
    pieces = frames(len(hand), np.random.default_rng(seed))
    return in_node(PUSHED, {"hand": hand.tolist(), "frames": pieces})


def test_a_hand_at_rest_with_a_jitter_of_a_pixel_never_lifts_the_block(in_node: InNode) -> None:
    rng = np.random.default_rng(48)
    event = np.repeat(rng.integers(-1, 2, 4 * 60), 8)  # one an event, 60 a second
    fastest = np.where(np.arange(4 * 480) % 16 < 8, 1, -1)
    for places in (event, fastest):
        found = ran(in_node, np.multiply(PIXEL, places, dtype=np.float64))
        assert found["peak"] == 0.0
        assert found["side"] == 0
        assert max(map(abs, found["pushes"])) < 0.5 * 9.80665 * math.tan(BLOCK.alpha)


def test_a_hand_of_a_hertz_gives_the_pga_of_the_same_filter(in_node: InNode) -> None:
    time = np.arange(1, 5 * 480 + 1) / RATE
    turn = 2.0 * math.pi
    hand = 0.1 * np.sin(turn * time)
    found, wanted = np.array(ran(in_node, hand)["pushes"]), pulled(hand)
    assert np.abs(found).max() == pytest.approx(np.abs(wanted).max(), rel=1e-12)
    np.testing.assert_allclose(found, wanted, rtol=0.0, atol=1e-11)
    # The spring in continuous time: w^2 s^2/(s + w)^2 at s = 2 pi i.
    steady = 0.1 * SPRING**2 * turn**2 / (SPRING**2 + turn**2)
    assert np.abs(found[-480:]).max() == pytest.approx(steady, rel=1e-3)


def test_the_ground_is_where_its_accelerations_take_it(in_node: InNode) -> None:
    hand = 0.2 * np.sin(np.arange(1, 961) / 40.0)
    found = ran(in_node, hand)
    push, h = np.array(found["pushes"]), 1.0 / RATE
    speed = np.concatenate([[0.0], np.cumsum(0.5 * h * (push[1:] + push[:-1]))])
    steps = h * speed[:-1] + h * h * (2.0 * push[:-1] + push[1:]) / 6.0
    np.testing.assert_allclose(found["places"][1:], np.cumsum(steps), atol=1e-12)


@pytest.mark.parametrize(("size", "least", "falls"), [(0.05, 20, False), (0.09, 5, True)])
def test_a_drag_of_a_minute_has_the_fate_and_the_impacts_of_its_replay(
    size: float, least: int, falls: bool, in_node: InNode
) -> None:
    time = np.arange(1, 60 * 480 + 1) / RATE
    hand = size * (np.sin(5.1 * time) + np.sin(7.7 * time + 0.4)) * np.minimum(1.0, time / 10.0)
    hand[time > 55.0] = hand[time <= 55.0][-1]
    found = ran(in_node, hand, seed=3)
    replay = simulate(BLOCK, Record(acceleration_m_s2=np.array(found["pushes"]), dt_s=1.0 / RATE))
    assert (replay.status is Status.OVERTURNED) == found["lies"] == falls
    times = replay.impacts.pt / BLOCK.p
    impacts = np.array(found["impacts"])
    assert len(times) > least
    assert len(impacts) == len(times)
    np.testing.assert_allclose(impacts[:, 0], times, atol=1e-9)
