"""Least fatal kicks in both directions, against an integration in metres and seconds."""

import math
from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import Block, DimensionlessBlock, Harmonic, Linear, find_edge_state
from rocksteady.arrays import Floats
from rocksteady.basins import EdgeState
from rocksteady.formulas import heteroclinic_amplitude
from tests.every import every

CYCLES = 12
G = 9.80665


class Case(NamedTuple):
    """A block on its left and on its right edge, and the shaking of its base."""

    left: float
    right: float
    height: float
    restitution: tuple[float, float]
    acceleration: float
    rate: float
    phase: float

    @property
    def block(self) -> Block:
        return Block.asymmetric(
            left=self.left, right=self.right, height=self.height, restitution=self.restitution
        )

    @property
    def motion(self) -> Harmonic:
        alpha, p = self.edges[0]
        return Harmonic(
            amplitude=self.acceleration / (alpha * G),
            frequency_ratio=self.rate / p,
            phase=self.phase,
        )

    @property
    def unit(self) -> float:
        """alpha g/p of the left edge [m/s]."""
        alpha, p = self.edges[0]
        return alpha * G / p

    @property
    def edges(self) -> list[tuple[float, float]]:
        """Slenderness and p about the left and the right edge, from the rectangle's inertia."""
        centre = 0.5 * self.height
        inertia = ((self.left + self.right) ** 2 + self.height**2) / 12.0
        return [
            (math.atan(base / centre), math.sqrt(G * r / (inertia + r * r)))
            for base in (self.left, self.right)
            for r in [math.hypot(base, centre)]
        ]


def drawn(seed: int) -> Case:
    """Return an asymmetric block on shaking below its uplift."""
    draw = np.random.default_rng(seed)
    height = draw.uniform(0.8, 2.5)
    left = height * draw.uniform(0.08, 0.2)
    right = left * math.exp(draw.uniform(-0.5, 0.5))
    case = Case(
        left, right, height, tuple(draw.uniform(0.75, 0.93, 2).tolist()), 0.0, 0.0, 0.0
    )  # fmt: skip
    alpha = min(alpha for alpha, _ in case.edges)
    return case._replace(
        acceleration=draw.uniform(0.2, 0.95) * alpha * G,
        rate=draw.uniform(1.0, 3.5) * case.edges[0][1],
        phase=draw.uniform(0.0, 2.0 * math.pi),
    )


def falls(case: Case, kicks: Floats, cycles: int = CYCLES) -> NDArray[np.bool_]:
    """Return which kicks [m/s] fell a block that stands: exact steps, landings by Newton."""
    (a0, p0), (a1, p1) = case.edges
    w, size = case.rate, case.acceleration / G
    step, end = 0.05 / p0, cycles * 2.0 * math.pi / case.rate

    def moved(motion: Floats, dt: Floats) -> tuple[Floats, Floats]:
        x, v, t, s = motion
        p, top = np.where(s > 0.0, p0, p1), np.where(s > 0.0, a0, -a1)
        share = -size * p * p / (p * p + w * w)
        begin, after = w * t + case.phase, w * (t + dt) + case.phase
        lean, turn = x - top - share * np.sin(begin), (v - share * w * np.cos(begin)) / p
        up, down = 0.5 * (lean + turn) * np.exp(p * dt), 0.5 * (lean - turn) * np.exp(-p * dt)
        return top + share * np.sin(after) + up + down, share * w * np.cos(after) + p * (up - down)

    fell = np.zeros(len(kicks), dtype=np.bool_)
    numbers = np.flatnonzero(kicks)
    s = np.sign(kicks[numbers])
    speed = kicks[numbers] * np.where(s > 0.0, p0 * p0, p1 * p1) / G
    motions = np.array([np.zeros(len(s)), speed, np.zeros(len(s)), s])
    while numbers.size:
        s, dt = motions[3], np.full(len(numbers), step)
        x, v = moved(motions, dt)
        dips = np.flatnonzero((s * motions[1] < 0.0) & (s * v > 0.0) & (s * x > 0.0))
        landed = s * x < 0.0
        if dips.size:  # down and up again within the step
            lowest = np.linspace(0.0, step, 41)[:, np.newaxis]
            path = s[dips] * moved(motions[:, dips], lowest)[0]
            landed[dips] = (path < 0.0).any(axis=0)
            dt[dips] = lowest[np.argmax(path < 0.0, axis=0), 0] + (~landed[dips]) * step
        at = np.flatnonzero(landed)
        for _ in range(8 if at.size else 0):
            gap, rate = moved(motions[:, at], dt[at])
            dt[at] = np.clip(dt[at] - gap / rate, 0.0, step)
        x, v = moved(motions, dt)
        x[at], v[at] = 0.0, v[at] * np.where(s[at] > 0.0, *case.restitution)
        motions = np.array([x, v, motions[2] + dt, np.where(landed, -s, s)])
        over = np.abs(x) > 5.0 * max(a0, a1)
        fell[numbers[over]] = True
        slow = np.abs(v) < 1e-3 * a0 * p0
        left = ~over & ~(landed & (slow | (motions[2] > end)))
        numbers, motions = numbers[left], motions[:, left]
    return fell


def check(case: Case, tried: int) -> EdgeState:
    """Check the least kick of both directions against those tried one by one."""
    edge = find_edge_state(case.block, case.motion, max_cycles=CYCLES, model=Linear())
    assert edge.kick is not None
    assert edge.opposite is not None
    assert abs(edge.kick) <= abs(edge.opposite)
    if edge.saddle is None:
        assert (edge.kind == "lost") is (edge.periods < 200)
        ending = "could not be followed beyond" if edge.kind == "lost" else "does not repeat in"
        assert f"{ending} {edge.periods} periods" in str(edge.describe())
    # A fractal border has ever narrower windows beside its end.
    wider = np.geomspace(1e-12, 1e-3, 60) if edge.fractal else np.array([1e-7])
    parts = np.concatenate([np.linspace(0.0, 1.0 - 1e-7, tried), 1.0 + wider])
    kicks = case.unit * np.array([[edge.kick], [edge.opposite]]) * parts
    fell = falls(case, kicks.ravel()).reshape(2, -1)
    assert fell[:, tried:].any(axis=1).all()
    assert edge.fractal or not fell[:, :tried].any()
    if edge.width is not None:
        inside = abs(edge.kick) + edge.width * np.array([0.2, 0.5, 0.8])
        assert falls(case, case.unit * math.copysign(1.0, edge.kick) * inside).any()
    for missed in kicks[:, :tried][fell[:, :tried]].tolist():
        assert edge.resolution is not None
        near = np.linspace(-1.0, 1.0, 401) * edge.resolution * case.unit
        stands = near[~falls(case, missed + near)]
        width = stands[stands > 0.0].min() - stands[stands < 0.0].max()
        assert width < edge.resolution * case.unit
    return edge


@pytest.mark.slow
@every("seed", range(20))
def test_asymmetric_blocks_fall_at_the_least_kick_of_both_directions(seed: int) -> None:
    check(drawn(seed), tried=200)


@pytest.mark.slow
def test_two_hundred_asymmetric_blocks_fall_at_the_least_kick_of_both_directions() -> None:
    edges = [check(drawn(seed), tried=4000) for seed in range(100, 300)]
    assert 20 < sum(bool(edge.fractal) for edge in edges) < 180
    assert 60 < sum(edge.kick < 0.0 for edge in edges if edge.kick) < 140


@every("seed", range(8))
def test_the_border_of_a_symmetric_block_is_fractal_above_its_tangency(seed: int) -> None:
    draw = np.random.default_rng(seed)
    ratio, restitution = draw.uniform(1.0, 4.0), draw.uniform(0.7, 0.95)
    part = draw.uniform(0.3, 0.95) if seed % 2 else draw.uniform(1.1, 1.6)
    touching = float(heteroclinic_amplitude(ratio, restitution))
    motion = Harmonic(
        amplitude=part * touching, frequency_ratio=ratio, phase=draw.uniform(0.0, 6.28)
    )
    edge = find_edge_state(DimensionlessBlock(restitution=restitution), motion, max_cycles=100)
    assert edge.fractal is (part > 1.0)
    kicks = [edge.kick, edge.opposite]
    alone = [find_edge_state(edge.block, motion, max_cycles=100, kick=sign) for sign in (1, -1)]
    assert sorted(kicks) == sorted(each.kick for each in alone)  # type: ignore[type-var]
    assert all(each.opposite is None for each in alone)
