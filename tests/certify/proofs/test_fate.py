"""Fates proved: against the march of the kernels, and edges of windows against known digits."""

import math
import random
from dataclasses import replace

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.certify.proofs import fate_checker
from rocksteady.certify.proofs.fate import certify_edges, certify_fate
from rocksteady.errors import ModelError
from rocksteady.model.motions.pulses import PULSES
from tests.every import every

BARE = rs.DimensionlessBlock(restitution=0.9)
BLOCK = rs.Block.from_p(alpha=0.2, p=2.0, restitution=0.9)
SHAPES = tuple(fate_checker.PULSES)


def synthetic(seed: int, peak: float, samples: int = 4001) -> rs.Record:
    """A record of 40 sinusoids under an envelope, with a peak in units of alpha g."""
    draw = random.Random(seed)
    waves = [
        (draw.uniform(0.4, 6), draw.uniform(0, 2 * math.pi), draw.gauss(0, 1)) for _ in "x" * 40
    ]
    times = 0.01 * np.arange(samples)
    course = sum(c / math.sqrt(f) * np.sin(2 * math.pi * f * times + p) for f, p, c in waves)
    course = course * (times / 4) ** 2 * np.exp(2 - times / 2)
    course = np.round(course / np.abs(course).max() * peak, 6) * BLOCK.uplift_acceleration
    return rs.Record(acceleration_m_s2=course, dt_s=0.01, name=f"synthetic {seed}")


def agrees(block: rs.Block | rs.DimensionlessBlock, motion: rs.Pulse | rs.Record) -> None:
    """The fate that is proved is that of the march."""
    certificate = certify_fate(block, motion, model="linear")
    assert certificate.proved, certificate.reason
    run = rs.simulate(block, motion, model=rs.Linear())
    falls = run.status == rs.Status.OVERTURNED
    assert certificate.content["claim"] == {"outcomes": ("falls" if falls else "stands",)}


@every("shape", SHAPES)
def test_fates_under_pulses_are_those_of_the_march(shape: str) -> None:
    draw = random.Random(shape)
    for number in range(6):
        pulse = rs.Pulse(
            shape=shape,
            amplitude=round(draw.uniform(1.01, 12), 3),
            frequency_ratio=round(draw.uniform(1, 8), 3),
            reverse=bool(number % 2),
        )
        agrees(BARE, pulse)


@every("case", [(1, 6.0), (2, 4.0)])
def test_fates_under_records_are_those_of_the_march(case: tuple[int, float]) -> None:
    agrees(BLOCK, synthetic(*case, samples=1501))


@pytest.mark.slow
@every("case", [(seed, peak) for seed in (1, 2, 3) for peak in (1.5, 2.5, 4.0, 6.0)])
def test_all_test_records_are_decided(case: tuple[int, float]) -> None:
    agrees(BLOCK, synthetic(*case))


def test_a_record_needs_more_bits_than_a_double_has() -> None:
    assert certify_fate(BLOCK, synthetic(2, 4.0), model="linear").bits > 53
    undecided = certify_fate(BLOCK, synthetic(2, 4.0), model="linear", most_bits=53)
    assert undecided.verdict == "undecided"
    assert "with 53 bits" in undecided.reason


def test_edges_of_windows_are_enclosed_around_the_doubles_of_the_search() -> None:
    pulse = rs.Pulse(shape="one-sine", amplitude=1.0, frequency_ratio=1.0)
    windows = rs.find_overturning_windows(BARE, pulse, [2.0, 4.0], within=(1.0, 6.0))
    known = (
        ["1.2251794232683136"],
        ["1.7954415956314803", "4.8501106438480795", "5.2389643576017384"],
    )
    for row, digits in enumerate(known):
        found = certify_edges(windows, row=row, places=16)
        # Windows that meet differ in their impacts: the block falls on both sides.
        low = [each.content["between"][0] for each in found if each.proved]
        assert set(digits) <= set(low)
        doubles = [x for pair in windows.intervals(row) for x in pair]
        for text in digits:
            assert min(abs(x - float(text)) for x in doubles) < 1e-14


def test_a_dimensionless_block_under_a_record_and_sampled_pulses_are_refused() -> None:
    with pytest.raises(ModelError, match="needs a block with sizes"):
        certify_fate(BARE, synthetic(1, 2.0, samples=50))
    ricker = rs.Pulse(shape="ricker", amplitude=2.0, frequency_ratio=2.0)
    for shape in sorted(set(PULSES) - set(SHAPES)):
        sampled = replace(ricker, shape=shape)
        with pytest.raises(ModelError, match="lack an enclosure of its samples"):
            certify_fate(BARE, sampled)
    assert set(SHAPES) < set(PULSES)
    with pytest.raises(ModelError, match="reversal of the velocity at a wall"):
        certify_fate(rs.DimensionlessBlock(restitution=0.5, one_sided=True), ricker)


def test_weak_shaking_never_lifts_the_block() -> None:
    still = rs.Pulse(shape="one-sine", amplitude=0.99, frequency_ratio=2.0)
    certificate = certify_fate(BARE, still)
    assert certificate.content["claim"] == {"outcomes": ("stands",)}
