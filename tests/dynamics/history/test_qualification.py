"""Displacement, clearances, impact speed and base force against DOP853 on points in a plane."""

import math
from functools import partial
from typing import NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rocksteady import Block, DimensionlessBlock, Harmonic, Pulse, State, Status, simulate
from rocksteady.errors import InputError, ModelError
from rocksteady.histories import Trajectory
from tests.every import every

G = 9.80665
BLOCKS = {
    "rectangle": Block.rectangle(width=0.6, height=1.8),
    "frame": Block.frame(columns=3, cap_mass_ratio=1.5, width=0.6, height=1.8),
    "asymmetric": Block.asymmetric(left=0.28, right=0.32, height=1.8),
}
STEP = 2e-4
"""Of the samples of the oracle [s]."""


def shaken(block: Block, *, peak: float = 3.0) -> Trajectory:
    """Return a run that starts tilted to the right and rocks under a sine."""
    pulse = Pulse.from_si(block, shape="one-sine", acceleration_m_s2=peak, frequency_hz=1.2)
    return simulate(block, pulse, start=State(angle=-0.25, velocity=0.0))


class Found(NamedTuple):
    """Largest rotation to either side, speed of an edge, and force over mass."""

    leans: tuple[float, float]
    speed: float
    across: float
    up: float


def landing(_t: float, state: np.ndarray) -> float:
    """Return the rotation, which is 0 at an impact."""
    return float(state[0])


landing.terminal, landing.direction = True, -1  # type: ignore[attr-defined]


def course(block: Block, span: float, peak: float = 3.0) -> Found:
    """Integrate Lagrange's equation of columns and cap as bodies in the plane.

    The mass centre of a column and its upper corner, where the cap stands, are points on circles
    about the pivot; forces are the rates of change of momentum.
    """
    gamma = 0.0 if block.cap is None else block.cap.cap_mass_ratio
    mass = np.array([1.0, gamma])
    spin = (block.width**2 + block.height**2) / 12.0

    def base(t: float) -> float:
        return peak * math.sin(2 * math.pi * 1.2 * t) if t < 1 / 1.2 else 0.0

    def parts(y: float, side: int) -> tuple[np.ndarray, np.ndarray, float]:
        """Return first and second derivative of the places by y, and gravity's arm."""
        edge = block.positive if side > 0 else block.negative
        z = np.exp(1j * (edge.alpha - y)) * edge.radius * np.array([1.0, 2.0])
        # x = side R sin(alpha - y), height R cos(alpha - y).
        first = np.array(-side * z.real + 1j * z.imag)
        second = np.array(-side * z.imag - 1j * z.real)
        return first, second, float(mass @ first.imag)

    def turning(t: float, y: float, w: float, side: int) -> tuple[float, complex]:
        first, second, arm = parts(y, side)
        inertia = float(mass @ np.abs(first) ** 2) + spin
        twist = float(mass @ (np.conj(first) * second).real) * w * w
        rate = (-G * arm - base(t) * float(mass @ first.real) - twist) / inertia
        force = mass @ (first * rate + second * w * w) + mass.sum() * (base(t) + 1j * G)
        return rate, complex(force) / mass.sum()

    def rates(t: float, state: np.ndarray, side: int) -> tuple[float, float]:
        return float(state[1]), turning(t, float(state[0]), float(state[1]), side)[0]

    t, y, w, side = 0.0, 0.25 * block.alpha, 0.0, -1
    leans: dict[int, float] = {1: 0.0, -1: y}
    across = up = speed = 0.0
    while t < span:
        end = 1 / 1.2 if t < 1 / 1.2 else span  # the sine ends in a corner
        run = solve_ivp(
            partial(rates, side=side), (t, end), (y, w),
            method="DOP853", rtol=1e-11, atol=1e-13, events=landing, dense_output=True,
        )  # fmt: skip
        times = np.linspace(t, run.t[-1], max(2, int((run.t[-1] - t) / STEP)))
        assert run.sol is not None
        angle, rate = run.sol(times)
        leans[side] = max(leans[side], float(angle.max()))
        for each in zip(times, angle, rate, strict=True):
            force = turning(*each, side)[1]
            across, up = max(across, abs(force.real)), max(up, force.imag)
        t, (y, w) = float(run.t[-1]), run.y[:, -1]
        if run.status == 1:
            speed = max(speed, block.width * abs(w))
            kept = (block.positive if side > 0 else block.negative).restitution
            y, w, side = 0.0, -kept * w, -side
    return Found((leans[1], leans[-1]), speed, across, up)


@every("name", BLOCKS)
def test_facts_are_those_of_an_independent_integrator(name: str) -> None:
    """Largest values over all flights up to two seconds, where they all lie."""
    block = BLOCKS[name]
    run, found = shaken(block), course(block, 1.6)
    assert run.status is Status.AT_REST
    # The corners of a block that has turned, about the left edge; mirrored about the other.
    corners = np.array([0.0, block.width]) + 1j * block.height
    moved = [(corners * (np.exp(1j * lean) - 1.0)).real for lean in found.leans]
    assert run.top_displacement_m == pytest.approx(max(-x.min() for x in moved), rel=1e-6)
    nearest = [-(x[0] if block.cap is None else x.min()) for x in moved]
    assert run.clearances_m == pytest.approx(nearest, rel=1e-6)
    assert run.impact_speed_m_s == pytest.approx(found.speed, rel=1e-6)
    assert run.forces_per_weight is not None
    assert run.forces_per_weight[0] * G == pytest.approx(found.across, rel=2e-4)
    assert run.forces_per_weight[1] * G == pytest.approx(found.up, rel=2e-4)
    assert run.base_force_kn(500.0) == pytest.approx(
        [0.5 * G * part for part in run.forces_per_weight]
    )


def test_mirrored_motions_exchange_the_clearances() -> None:
    """And leave the rest as it is."""
    block = BLOCKS["rectangle"]
    one, other = (
        simulate(
            block,
            Pulse.from_si(
                block, shape="one-sine", acceleration_m_s2=3.8, frequency_hz=1.2, reverse=reverse
            ),
        )
        for reverse in (False, True)
    )
    assert one.clearances_m is not None
    assert one.clearances_m == pytest.approx((other.clearances_m or ())[::-1], rel=1e-12)
    assert one.top_displacement_m == pytest.approx(other.top_displacement_m, rel=1e-12)
    assert one.impact_speed_m_s == pytest.approx(other.impact_speed_m_s, rel=1e-12)
    assert one.forces_per_weight == pytest.approx(other.forces_per_weight, rel=1e-12)


def test_what_has_no_such_fact_has_none() -> None:
    """A fall, a block without a size, endless shaking; and a mass that is none."""
    fallen = shaken(BLOCKS["rectangle"], peak=12.0)
    assert fallen.status is Status.OVERTURNED
    assert (fallen.top_displacement_m, fallen.clearances_m) == (None, None)
    assert fallen.forces_per_weight is not None
    bare = simulate(DimensionlessBlock(restitution=0.8), Harmonic(amplitude=2, frequency_ratio=4))
    assert (bare.impact_speed_m_s, bare.forces_per_weight, bare.top_displacement_m) == (None,) * 3
    with pytest.raises(ModelError, match="the force on the base is that of a Block"):
        bare.base_force_kn(100.0)
    with pytest.raises(
        InputError, match=r"mass_kg = 0 .* lie in .0, 1000000000.; give the mass in kg"
    ):
        fallen.base_force_kn(0)


def test_facts_in_words_and_json() -> None:
    """Millimetres and kilonewtons for people, SI for JSON; a mass adds the force."""
    run = shaken(BLOCKS["rectangle"])
    facts = {fact.key: fact for fact in run.describe(mass_kg=500.0).facts}
    assert facts["top_displacement_m"].value == run.top_displacement_m
    assert facts["top_displacement_m"].words.endswith("mm, 1.8 m up")
    assert facts["clearances_m"].value == list(run.clearances_m or ())
    assert facts["clearances_m"].words.endswith("mm right")
    assert facts["impact_speed_m_s"].words.endswith("m/s")
    assert facts["base_force_kn"].value == list(run.base_force_kn(500.0) or ())
    assert "base_force_kn" not in run.to_dict()
    assert "; top moves " in run.summary()
