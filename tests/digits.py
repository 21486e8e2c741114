"""Numbers from outside the kernels and through them, as digests of their bits.

`python -m tests.digits` writes them.
"""

import hashlib
import itertools
import json
import math
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np

import rocksteady as rs
from rocksteady.dynamics.overturning.thresholds import THRESHOLDS
from rocksteady.records.core.recording import Recording
from rocksteady.sweep.cases.spacing import in_equal_ratios

Numbers = Iterable[float]
SIZES = np.random.default_rng(11).random((100, 3)).tolist()
RATIOS = in_equal_ratios(0.05, 50.0, 60)


def blocks() -> list[rs.Block]:
    found = [rs.Block.rectangle(width=0.1 + 0.3 * b, height=0.7 + h) for b, h, _ in SIZES]
    found += [
        rs.Block.asymmetric(left=0.1 + 0.1 * b, right=0.1 + 0.1 * h, height=1.0 + c)
        for b, h, c in SIZES
    ]
    return found + [
        rs.Block.from_alphas(positive=0.05 + 0.2 * b, negative=0.05 + 0.2 * h, p=1.0 + c)
        for b, h, c in SIZES
    ]


def record() -> rs.Record:
    times = np.arange(2000) * 0.01
    samples = np.array(SIZES).ravel()[(7 * np.arange(2000)) % 300] - 0.5
    return rs.Record(acceleration_m_s2=samples * times * (20.0 - times), dt_s=0.01)


def sizes() -> Numbers:
    for block in blocks():
        for side in (block.positive, block.negative):
            yield from (side.alpha, side.radius, side.p, side.restitution, side.distance)
        yield rs.formulas.overturning_impulse(block)


def segments() -> Numbers:
    waves = [
        rs.Piecewise(
            pieces=(rs.motions.Segment(duration=1.0 + b, amplitude=h, frequency=9.0 * c, phase=b),)
        )
        for b, h, c in SIZES
    ]
    pulses = [
        rs.Pulse(shape=shape, amplitude=2.0, frequency_ratio=3.0, tolerance=1e-4)
        for shape in ("type-c1", "ricker", "ricker-antisymmetric", "mavroeidis-papageorgiou")
    ]
    sums = [
        rs.motions.add(one, other, tolerance=1e-3)
        for one, other in zip(waves[::2], waves[1::2], strict=True)
    ]
    again = [rs.motions.add(one, rs.motions.delay(one, 0.3)) for one in waves]
    motions: list[rs.Pulse | rs.Piecewise] = [*pulses, *sums, *again]
    for motion in motions:
        for piece in motion.segments():
            yield from (piece.duration, piece.constant, piece.slope, piece.amplitude, piece.phase)


def closed_forms() -> Numbers:
    for shape in THRESHOLDS:
        yield from rs.formulas.overturning_amplitude(shape, RATIOS)
    heights = np.linspace(0.0, 0.999, 500)
    yield from rs.formulas.free_rocking_period(heights)
    yield from rs.formulas.free_rocking_period(heights, alpha=0.3)
    yield from rs.formulas.free_rocking_peaks(0.9, 0.95, 100)
    yield from rs.formulas.free_rocking_peaks(0.9, 0.95, 100, alpha=0.3)
    yield from rs.formulas.equivalent_damping(np.linspace(0.1, 1.0, 100))
    yield from RATIOS


def measures() -> Numbers:
    found = rs.measures.compute_response_spectrum(record(), in_equal_ratios(0.02, 8.0, 40))
    yield from found.displacement_m
    yield from found.pseudo_acceleration_m_s2
    yield rs.measures.compute_average_acceleration(record(), 0.5)
    for name, value in vars(rs.compute_measures(record(), blocks()[0])).items():
        if isinstance(value, float) and name != "mean_period_s":
            yield value


def recordings() -> Numbers:
    given = Recording(record=record(), format="table", path=Path("none"), units_in_file="m/s^2")
    for baseline in ("mean", "linear", "polynomial:5"):
        yield from rs.records.Cleaning(baseline=baseline).apply(given).record.acceleration_m_s2
    yield from rs.records.resample(given, 0.0037).record.acceleration_m_s2


def courses() -> Numbers:
    """Through the kernels: closed forms, time histories of both models, returns, spectra."""
    states = rs.formulas.steady_states(np.linspace(0.5, 6.0, 40)[:, np.newaxis], RATIOS, 0.8)
    for grid in (states.phase, states.velocity_tau, states.trace, states.multipliers.real):
        yield from np.asarray(grid, dtype=np.float64).ravel()
    block = rs.Block.rectangle(width=0.5, height=2.0)
    pulse = rs.Pulse(shape="one-sine", amplitude=2.5, frequency_ratio=3.0)
    shaking = rs.Harmonic(amplitude=2.0, frequency_ratio=4.0)
    motions: tuple[rs.Pulse | rs.Harmonic | rs.Record, ...] = (pulse, shaking, record())
    models: tuple[rs.Linear | rs.Nonlinear, ...] = (rs.Linear(), rs.Nonlinear())
    for motion, model in itertools.product(motions, models):
        start = rs.State(angle=0.1, velocity=0.0)
        run = rs.simulate(block, motion, start=start, model=model)
        course = run(np.linspace(0.0, min(run.shown_to_pt, 30.0), 200))
        yield from np.concatenate([course.angle, course.velocity, course.energy])
        yield from run.impacts.pt
    for orbit in rs.find_orbits(rs.DimensionlessBlock(restitution=0.8), shaking, seeds=24):
        yield from (orbit.highest, orbit.lowest, orbit.largest_multiplier)


def of_the_system() -> Numbers:
    """What the package does not call."""
    angles = np.linspace(0.01, 20.0, 20001)
    yield from np.exp(angles)
    yield from map(math.exp, angles.tolist())


GROUPS: dict[str, Callable[[], Numbers]] = {
    group.__name__: group
    for group in (sizes, segments, closed_forms, measures, recordings, courses, of_the_system)
}


def digest(numbers: Numbers) -> tuple[int, str]:
    """Return how many numbers there are, and a hash of their bits."""
    array = np.array(list(numbers), dtype=np.float64)
    return len(array), hashlib.sha256(array.tobytes()).hexdigest()[:16]


if __name__ == "__main__":
    json.dump({name: digest(group()) for name, group in GROUPS.items()}, sys.stdout)
