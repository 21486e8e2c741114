"""Answers on symmetric steady states: counts of a grid from its arrays, one point in words."""

import math
from typing import Any

import numpy as np

from rocksteady import Block, DimensionlessBlock, Harmonic, find_steady_states
from rocksteady.formulas import steady_states
from rocksteady.results.description import Description
from rocksteady.results.numbers import number
from tests.every import every
from tests.outputs import lines_of

BARE = DimensionlessBlock(restitution=0.8)
SIZED = Block.rectangle(width=0.4, height=2.0)


def answer_of(answer: Description) -> tuple[str, dict[str, Any]]:
    return answer.sentence, lines_of(answer)


GRIDS = [
    ([0.1, 0.5, 2.0, 6.0], 4.0, 0.8, 1),
    ([0.01, 0.1, 0.2, 4.0], 4.0, 0.8, 1),
    (3.0, [3.0, 5.0, 6.0, 8.0, 20.0], 0.85, 3),
    ([2.0, 2.0, 3.5], [1.9, 0.7, 0.8], [0.8, 0.9, 0.95], 1),
    ([0.01, 0.02], [4.0, 5.0], 0.8, 1),
    (2.0, [1.85, 1.9], 0.8, 1),
]


@every(("amplitude", "ratio", "restitution", "order"), GRIDS)
def test_an_answer_counts_the_motions_of_a_grid(
    amplitude: float | list[float],
    ratio: float | list[float],
    restitution: float | list[float],
    order: int,
) -> None:
    states = steady_states(amplitude, ratio, restitution, order=order)
    assert states.peak is not None
    assert states.admissible is not None
    sentence, facts = answer_of(states.describe())
    points, motions = states.region.size, int(states.admissible.sum())
    stable, where = int(states.stable.sum()), int(states.stable.any(axis=0).sum())
    told = f"No stable symmetric motion is possible at any of {points} points."
    if where:
        told = f"A stable symmetric motion is possible at {where} of {points} points."
    assert sentence == told
    plural = "s" if motions != 1 else ""
    unstable = f"{motions - stable} of {motions} motion{plural}" if motions else ""
    assert facts["unstable"] == unstable
    nowhere = int((states.region == 4).sum())
    plural = "s" if nowhere != 1 else ""
    assert facts["no motion"] == (f"at {nowhere} point{plural}" if nowhere else "")
    peaks = states.peak[states.stable]
    tilts = ""
    if stable:
        ends = dict.fromkeys(number(float(end)) for end in (peaks.min(), peaks.max()))
        tilts = " to ".join(ends) + " alpha" + ("; beyond alpha too" if peaks.max() > 1.0 else "")
    assert facts["tilt"] == tilts
    assert (f"n = {order}" in facts["over"]) is (order > 1)


def test_a_block_with_a_size_has_degrees_and_hertz() -> None:
    motion = Harmonic(amplitude=3.0, frequency_ratio=5.0)
    states = find_steady_states(SIZED, motion, order=[1, 3])
    assert states.peak is not None
    sentence, facts = answer_of(states.describe())
    assert sentence == "A stable symmetric motion is possible at 2 of 2 points."
    low, high = np.sort(np.degrees(SIZED.alpha * states.peak[states.stable]))
    assert facts["tilt"] == f"{number(float(low))} to {number(float(high))}°"
    hertz = 5.0 * SIZED.p / (2.0 * math.pi)
    accel_g = 3.0 * SIZED.alpha
    assert facts["over"] == f"{number(accel_g)} g, {number(hertz)} Hz, n = 1, 3"


@every(
    ("amplitude", "ratio", "order", "sentence", "expected"),
    [
        (2.0, 4.0, 1, "at {} alpha, out of phase, and that is stable.", {
            "impacts": "2 a period, du/d(pt) 0.732 after each",
            "other branch": "in phase: passes through the base, so not possible",
            "exists": "from A = 0.26 up; a second branch up to A = 1.59 at most",
            "beyond alpha": "",
        }),
        (2.0, 1.9, 1, "at {} alpha, out of phase, but that is unstable.", {}),
        (3.0, 6.0, 3, "in a period-3 motion at {} alpha, out of phase, and that is stable.", {
            "impacts": "2 in 3 periods, du/d(pt) 0.823 after each",
            "other branch": "in phase: 0.326 alpha, unstable",
        }),
        (1.5, 1.0, 1, "at {} alpha, out of phase, but that is unstable.", {
            "beyond alpha": "the base carries it back: no fall",
            "exists": "",
        }),
    ],
)  # fmt: skip
def test_an_answer_names_the_best_motion_at_a_point(
    amplitude: float, ratio: float, order: int, sentence: str, expected: dict[str, str]
) -> None:
    motion = Harmonic(amplitude=amplitude, frequency_ratio=ratio)
    states = find_steady_states(BARE, motion, order=order)
    assert states.peak is not None
    shown, facts = answer_of(states.describe())
    peak = number(float(states.peak[0]))
    assert shown == f"It can rock steadily {sentence.format(peak)}"
    assert {key: facts[key] for key in expected} == expected


def test_the_period_and_the_speed_of_a_block_with_a_size_are_its_own() -> None:
    motion = Harmonic(amplitude=3.0, frequency_ratio=6.0)
    states = find_steady_states(SIZED, motion, order=3)
    assert states.velocity is not None
    sentence, facts = answer_of(states.describe())
    seconds = 3 * 2.0 * math.pi / (6.0 * SIZED.p)
    speed = math.degrees(abs(float(states.velocity[0])) * SIZED.alpha * SIZED.p)
    assert facts["impacts"] == f"2 in 3 periods ({seconds:.3g} s), {speed:.3g}°/s after each"
    assert "in a period-3 motion at " in sentence
    assert facts["closed form"].endswith(", out of phase, stable (linear)")
    _, facts = answer_of(find_steady_states(SIZED, motion, model="linear").describe())
    assert facts["exists"].startswith("from 0.")


@every(("order", "words"), [(1, ""), (3, " in a period-3 motion")])
def test_below_existence_nothing_rocks_steadily(order: int, words: str) -> None:
    states = find_steady_states(BARE, Harmonic(amplitude=0.01, frequency_ratio=4.0), order=order)
    sentence, facts = answer_of(states.describe())
    least = float(states.existence)
    assert sentence == (f"It cannot rock steadily{words}: that needs A = {number(least)} or more.")
    assert facts == {"computed": "linear (exact)"}
