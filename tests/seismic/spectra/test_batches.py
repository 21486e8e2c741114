"""Every batch is its single runs: status, peaks and impacts of each cell, over drawn scenarios.

The oracle is `simulate`, one cell at a time: it shares the flights with the batches, and none of
what they add, as tables for many blocks, waits at rest, chatter left out, lanes, and peaks kept on
the way.
"""

import math
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import rocksteady as rs
from rocksteady.kernels.core.tables import COUNTED
from rocksteady.seismic.spectra.batch import PEAKS_AGREE_TO
from tests.strategies import PLAIN

Floats = NDArray[np.float64]
Draw = np.random.Generator

SEED = int(os.environ.get("ROCKSTEADY_SEED", "20261123"))
"""Seed of the drawn scenarios; another one draws others."""
QUICK, THOROUGH = 300, 1_000
"""Single runs of each kind of batch in every run and in the slow tests."""
GRAVITY = 9.80665


@dataclass(frozen=True, kw_only=True)
class Cell:
    """What a batch says of a cell, and the single run that has to agree."""

    words: str
    run: rs.histories.Trajectory
    status: int
    peak: float | None = None
    peak_velocity: float | None = None
    impacts: int | None = None

    def faults(self) -> Iterator[str]:
        """Yield how the two disagree."""
        if self.status != int(self.run.status):
            yield f"status {self.status}, single {int(self.run.status)}"
        elif self.impacts not in (None, self.run.impact_count):
            yield f"{self.impacts} impacts, single {self.run.impact_count}"
        for name in ("peak", "peak_velocity"):
            batch, single = getattr(self, name), getattr(self.run, name)
            if batch is None or batch == single:
                continue
            apart = abs(batch - single) / single if single > 0.0 else math.inf
            if not apart <= PEAKS_AGREE_TO * (1.0 + self.run.growth):
                yield f"{name} {batch!r}, single {single!r}"


def block(rng: Draw) -> rs.Block:
    """Return a block of any kind: sides alike or not, off centre, against a wall."""
    height = rng.uniform(0.5, 5.0)
    width = height * rng.uniform(0.03, 0.6)
    ratio = float(rng.choice([rng.uniform(0.2, 0.95), rng.uniform(0.9, 0.999)]))
    kind = rng.integers(6)
    if kind == 0:
        return rs.Block.rectangle(width=width, height=height)
    if kind == 1:
        share = rng.uniform(0.2, 0.8)
        left, right = width * share, width * (1.0 - share)
        return rs.Block.asymmetric(left=left, right=right, height=height, restitution=ratio)
    if kind == 2:
        alone = rs.Block.rectangle(width=width, height=height, restitution=ratio)
        return alone.against_wall(float(rng.choice([0.0, rng.uniform(0.05, 0.95)])))
    if kind == 3:
        alpha, p = math.atan(width / height), 10.0 ** rng.uniform(-0.3, 1.0)
        return rs.Block.from_p(alpha=alpha, p=p, restitution=ratio)
    return rs.Block.rectangle(width=width, height=height, restitution=ratio)


def values(rng: Draw, count: int) -> Floats:
    """Return accelerations of order 1: noise, levels, jumps at the start, still spells."""
    kind = rng.integers(5)
    if kind == 0:
        drawn = rng.choice([-1.0, 0.1, 1.0], count)
    elif kind == 1:
        drawn = rng.normal(size=count)
        drawn[0] *= 3.0
    elif kind == 2:
        drawn = rng.normal(size=count) * (rng.random(count) < 0.5)
    elif kind == 3:
        drawn = np.append(rng.normal(size=count - 1), 4.0 * rng.choice([-1.0, 1.0]))
    else:
        drawn = rng.normal(size=count)
    return drawn if drawn.any() else np.ones(count)


def ground(rng: Draw, uplift: float, p: float) -> rs.Record:
    """Return a short record around the uplift of a block, with tiny or long steps."""
    count = int(rng.integers(2, 10))
    step = 10.0 ** rng.uniform(-2.5, 0.3) / p
    size = uplift * 10.0 ** rng.uniform(-0.2, 0.7)
    return rs.Record(acceleration_m_s2=size * values(rng, count), dt_s=step)


def drawn_model(rng: Draw) -> rs.Linear | rs.Nonlinear:
    return rs.Linear() if rng.random() < 0.5 else rs.Nonlinear()


def many_on_records(rng: Draw) -> Iterator[Cell]:
    """Yield the cells of `simulate_many`: blocks, records, scales, reversed, vertical."""
    blocks = [block(rng) for _ in range(int(rng.integers(1, 5)))]
    model, first = drawn_model(rng), blocks[0]
    grounds: list[Any] = [ground(rng, first.uplift_acceleration, first.p) for _ in range(2)]
    if isinstance(model, rs.Nonlinear) and rng.random() < 0.3:
        size = rng.uniform(0.05, 0.4) * GRAVITY
        lifts = [
            rs.Record(
                acceleration_m_s2=size * rng.uniform(-1.0, 1.0, len(each.acceleration_m_s2)),
                dt_s=each.dt_s,
            )
            for each in grounds
        ]
        grounds = [rs.BaseMotion(*pair) for pair in zip(grounds, lifts, strict=True)]
    scales = [1.0, float(rng.uniform(0.5, 2.0))]
    table = rs.simulate_many(blocks, grounds, scales=scales, reverse="both", model=model)
    for i, body in enumerate(blocks):
        for j, motion in enumerate(grounds):
            for k, sign in enumerate((1.0, -1.0)):
                for m, scale in enumerate(scales):
                    shaken = scaled(motion, sign, scale)
                    found = table.isel(block=i, record=j, direction=k, level=m)
                    yield cell_of(found, rs.simulate(body, shaken, model=model))


def scaled(motion: rs.Record | rs.BaseMotion, sign: float, scale: float) -> Any:
    """Return a motion times a scale, whose horizontal component may be reversed."""
    if isinstance(motion, rs.Record):
        return motion.scaled(sign * scale)
    across, up = motion.horizontal, motion.vertical
    assert isinstance(across, rs.Record)
    assert isinstance(up, rs.Record)
    return rs.BaseMotion(across.scaled(sign * scale), up.scaled(scale))


def cell_of(found: Any, run: rs.histories.Trajectory) -> Cell:
    """Return the cell of a table with the variables of `simulate_many`."""
    numbers = {name: part.item() for name, part in found.data_vars.items()}
    return Cell(
        words=f"{run.block!r} on {run.motion!r}, {run.vertical!r}, {run.model!r}",
        run=run,
        status=int(numbers["status"]),
        peak=numbers["peak_angle"],
        peak_velocity=numbers.get("peak_velocity"),
        impacts=int(numbers["impacts"]),
    )


def spectra(rng: Draw) -> Iterator[Cell]:
    """Yield the cells of `compute_rocking_spectrum`, free and against a wall."""
    alphas, periods = np.sort(rng.uniform(0.05, 0.4, 3)), np.sort(rng.uniform(1.0, 8.0, 2))
    middle = rs.Block.from_p(alpha=float(alphas[1]), p=2.0 * math.pi / float(periods[0]))
    motion, model = ground(rng, middle.uplift_acceleration, middle.p), drawn_model(rng)
    ratio, walled = float(rng.uniform(0.3, 0.99)), rng.random() < 0.3
    table = rs.compute_rocking_spectrum(
        motion,
        alpha=alphas,
        periods_s=periods,
        restitution=("wall", ratio) if walled else ratio,
        model=model,
    )
    for alpha in alphas.tolist():
        for period in periods.tolist():
            body = rs.Block.from_p(alpha=alpha, p=2.0 * math.pi / period, restitution=ratio)
            body = body.against_wall(ratio) if walled else body
            found = table.sel(alpha=alpha, period=period)
            yield cell_of(found, rs.simulate(body, motion, model=model))


def ensembles(rng: Draw) -> Iterator[Cell]:
    """Yield the cells of `run_ensemble`, whose blocks have drawn restitutions."""
    body = rs.Block.rectangle(width=rng.uniform(0.2, 0.8), height=2.0)
    model = drawn_model(rng)
    grounds = [ground(rng, body.uplift_acceleration, body.p) for _ in range(2)]
    scales = sorted(rng.uniform(0.3, 2.0, 2).tolist())
    levels = rs.risk.Levels(levels=scales, measure="scale")
    table = rs.run_ensemble(body, grounds, levels=levels, model=model).isel(block=0, vertical=0)
    for draw, ratio in enumerate(table.restitution.values.tolist()):
        drawn = body.with_restitution(ratio)
        for j, motion in enumerate(grounds):
            for k, sign in enumerate((1.0, -1.0)):
                for m, scale in enumerate(scales):
                    shaken = motion.scaled(sign * scale)
                    found = table.isel(record=j, direction=k, draw=draw, level=m)
                    yield cell_of(found, rs.simulate(drawn, shaken, model=model))


def finite_basins(rng: Draw) -> Iterator[Cell]:
    """Yield states of `compute_fate_basins` under a record, a pulse or impulses."""
    body, model = block(rng), drawn_model(rng)
    kind = rng.integers(3)
    motion: Any = ground(rng, body.uplift_acceleration, body.p)
    if kind == 1:
        motion = rs.Pulse(
            shape=str(rng.choice(["one-sine", "half-sine", "one-cosine"])),
            amplitude=float(rng.uniform(0.5, 5.0)),
            frequency_ratio=float(rng.uniform(0.5, 6.0)),
        )
    elif kind == 2:
        times = np.cumsum(rng.uniform(0.1, 1.5, 2))
        motion = rs.motions.Impulses(
            velocities=rng.normal(0.0, 0.5, 2).tolist(), times=times.tolist()
        )
    low = 0.01 if body.one_sided else -0.8
    angles = np.linspace(low, float(rng.uniform(low + 0.1, 0.8)), 3)
    velocities = np.linspace(-0.6, float(rng.uniform(-0.5, 0.6)), 3)
    table = rs.compute_fate_basins(
        body, motion, angles=angles, velocities=velocities, model=model
    ).to_dataset()
    for angle in angles.tolist():
        for velocity in velocities.tolist():
            state = rs.State(angle=angle, velocity=velocity)
            run = rs.simulate(body, motion, start=state, model=model)
            found = table.sel(angle=angle, velocity=velocity)
            yield Cell(
                words=f"{body!r} on {motion!r} from {state!r}, {model!r}",
                run=run,
                status=int(found.fate),
                peak=float(found.peak),
                impacts=int(found.impacts),
            )


def harmonic_fates(rng: Draw) -> Iterator[Cell]:
    """Yield cells of `map_fates`: lanes, unlike sides, walls, both models."""
    body: rs.Block | rs.DimensionlessBlock = block(rng)
    model = drawn_model(rng)
    if rng.random() < 0.5:
        body, model = rs.DimensionlessBlock(restitution=float(rng.uniform(0.3, 0.95))), rs.Linear()
    amplitudes = np.sort(rng.uniform(0.5, 6.0, 3))
    frequencies = np.sort(rng.uniform(0.8, 8.0, 2))
    axes = {"amplitude": amplitudes, "frequency_ratio": frequencies}
    table = rs.map_fates(body, axes=axes, cycles=12, model=model)
    for amplitude in amplitudes.tolist():
        for frequency in frequencies.tolist():
            motion = rs.Harmonic(amplitude=amplitude, frequency_ratio=frequency)
            run = rs.simulate(body, motion, cycles=12, model=model)
            found = table.sel(amplitude=amplitude, frequency_ratio=frequency)
            if run.growth > 1e12:  # rounding decides, as `Trajectory.growth` says
                continue
            yield Cell(words=f"{body!r} under {motion!r}", run=run, status=int(found.fate))


def windows(rng: Draw) -> Iterator[Cell]:
    """Yield amplitudes inside and outside the windows of `find_overturning_windows`."""
    body = rs.DimensionlessBlock(restitution=float(rng.uniform(0.4, 0.95)))
    shape, ratio = str(rng.choice(["one-sine", "half-sine"])), float(rng.uniform(1.0, 6.0))
    most = 12.0
    found = rs.find_overturning_windows(body, shape, [ratio], within=(0.1, most)).at(0)
    for amplitude in rng.uniform(0.2, most - 0.1, 6).tolist():
        motion = rs.Pulse(shape=shape, amplitude=amplitude, frequency_ratio=ratio)
        inside = [each for each in found if each.low <= amplitude <= each.high]
        run = rs.simulate(body, motion)
        yield Cell(
            words=f"{body!r} on {motion!r}",
            run=run,
            status=int(rs.Status.OVERTURNED) if inside else int(rs.Status.AT_REST),
            impacts=inside[0].impacts if inside else None,
        )


BATCHES: tuple[Callable[[Draw], Iterator[Cell]], ...] = (
    many_on_records,
    spectra,
    ensembles,
    finite_basins,
    harmonic_fates,
    windows,
)


@pytest.mark.skipif(PLAIN, reason="some hundred times slower")
@pytest.mark.parametrize(
    "count", [QUICK, pytest.param(THOROUGH, marks=pytest.mark.slow)], ids=["quick", "thorough"]
)
@pytest.mark.parametrize("batch", BATCHES, ids=[each.__name__ for each in BATCHES])
def test_every_cell_is_what_its_single_run_says(
    batch: Callable[[Draw], Iterator[Cell]], count: int
) -> None:
    rng = np.random.default_rng([SEED, BATCHES.index(batch)])
    seen, ends, faults = 0, set(), []
    while seen < count:
        for cell in batch(rng):
            seen += 1
            ends.add(cell.run.status)
            faults += [f"{cell.words}: {fault}" for fault in cell.faults()]
    assert not faults, f"{len(faults)} of {seen} cells\n" + "\n".join(faults[:20])
    assert {rs.Status.AT_REST, rs.Status.OVERTURNED} <= ends


def test_bounces_after_a_record_that_ends_in_flight_have_their_tops() -> None:
    # The first impact on the still base leads to the highest angle.
    body = rs.Block.rectangle(width=0.4, height=2.0)
    record = rs.Record(acceleration_m_s2=np.array([4.0, 4.0, -15.0]), dt_s=0.1)
    table = rs.simulate_many(body, record)
    single = rs.simulate(body, record)
    assert single.peak == pytest.approx(0.31168, abs=1e-5)
    assert float(table.peak_angle) == pytest.approx(single.peak, rel=1e-12)
    # The lowest velocity that counts is followed by none above it.
    after = np.abs(single.impacts.velocity_after)
    assert len(after) == single.impact_count
    assert after.min() >= COUNTED
    assert after.min() * body.restitution < COUNTED


def test_a_run_of_millions_of_bounces_ends_at_rest_like_its_batch() -> None:
    body = rs.Block.from_p(alpha=1e-3, p=3.0)  # Housner's restitution is 1 - 1.5e-6
    pulse = np.array([0.0, 3.0 * body.uplift_acceleration, 0.0])
    record = rs.Record(acceleration_m_s2=pulse, dt_s=0.05)
    single = rs.simulate(body, record, max_flights=3000)
    table = rs.simulate_many(body, record)
    assert single.status == rs.Status.AT_REST
    assert int(table.status) == rs.Status.AT_REST
    assert len(single.rows) == 3000
    assert len(single.impacts) < 3000 < single.impact_count
    assert int(table.impacts) == pytest.approx(single.impact_count, abs=2)
    assert float(table.peak_angle) == pytest.approx(single.peak, rel=1e-9)
    # From the speed v of an impact on: n impacts, with v delta^n = 1e-6.
    speed = abs(float(single.impacts.velocity_after[-1]))
    more = math.log(COUNTED / speed) / math.log(body.restitution)
    assert single.impact_count - len(single.impacts) == pytest.approx(more, abs=1.0)
    assert single.rest_time_pt is not None
    assert single.rest_time_pt > single.impacts.pt[-1] + 2.0 * speed / (1.0 - body.restitution)
