"""Random systems and states of the return map, and its derivative by differences."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.orbits.return_map import Section
from rocksteady.kernels.orbits.systems import System, make_system
from tests.kernels.tables import both_sides

Floats = NDArray[np.float64]
Long = np.longdouble

LOPSIDED = [
    ((0.7, 0.9), (1.0, 0.6), (1.0, 1.0)),
    ((0.5, 0.8), (1.0, 1.1), (0.9, 1.4)),
    ((0.9, 0.6), (0.8, 1.3), (1.2, 0.9)),
]


@dataclass(frozen=True)
class Case:
    """A shaken block and a state after an impact."""

    amplitude: float
    frequency: float
    sides: Floats
    state: Section

    @property
    def system(self) -> System:
        return make_system(self.amplitude, self.frequency, self.sides)

    @property
    def row(self) -> int:
        return 0 if self.state.side > 0 else 1


def even_system(amplitude: float, frequency: float, restitution: float) -> System:
    return make_system(amplitude, frequency, both_sides(restitution))


def state_at_phase(side: int, phase: float, speed: float) -> Section:
    half, rest = clock(phase)
    return Section(side, half, rest, speed)


def random_case(rng: np.random.Generator, *, lopsided: bool = False) -> Case:
    """Return a case whose block often comes back, under slow and fast shaking, weak and strong."""
    frequency = 10.0 ** rng.uniform(math.log10(0.05), 2.3)
    amplitude = 10.0 ** rng.uniform(-0.5, 1.3)
    sides = both_sides(rng.uniform(0.05, 1.0))
    if lopsided:
        sides = both_sides(*LOPSIDED[rng.integers(len(LOPSIDED))])
    side = int(rng.choice([1, -1]))
    scale = rng.choice([1.0, (1.0 + amplitude) / (1.0 + frequency)])
    speed = rng.uniform(0.02, 1.2) * scale
    return Case(
        amplitude, frequency, sides, state_at_phase(side, rng.uniform(0.0, 2.0 * math.pi), speed)
    )


def landed(
    case: Case, phase_shift: float, speed_shift: float, near: float
) -> tuple[np.longdouble, np.longdouble]:
    """Return phase passed and speed after the impact near a pivot time, in extended precision."""
    restitution, lean, rate = (Long(value) for value in case.sides[case.row])
    amplitude, frequency = Long(case.amplitude) / lean, Long(case.frequency) / rate
    state = case.state
    pi = Long("3.14159265358979323846264338327950288")
    phase = Long(state.phase) + state.half_cycles % 2 * pi + (pi if state.side < 0 else 0)
    phase += Long(phase_shift)
    speed = (Long(state.speed) + Long(speed_shift)) / (lean * rate)
    beta = amplitude / (1 + frequency * frequency)
    a = speed + beta * frequency * np.cos(phase)
    b = beta * np.sin(phase) - 1
    time, v = Long(near) * rate, Long(0)
    for _ in range(8):
        # Differences of cosh and sine as products: a short bounce loses no digits.
        sinh, rise, turn = np.sinh(time), 2 * np.sinh(time / 2) ** 2, frequency * time / 2
        chord = 2 * beta * np.sin(turn)
        y = a * sinh + b * rise - chord * np.cos(phase + turn)
        v = speed + a * rise + b * sinh + frequency * chord * np.sin(phase + turn)
        time -= y / v
    return Long(phase_shift) + frequency * time, -restitution * v * lean * rate


def differenced(case: Case, near: float, step: float = 1e-10) -> Floats:
    """Return the derivative of (phase, speed) after by that before, by central differences."""
    columns = []
    for phase, speed in ((step, 0.0), (0.0, step)):
        more, less = landed(case, phase, speed, near), landed(case, -phase, -speed, near)
        columns.append([float((p - m) / (2 * Long(step))) for p, m in zip(more, less, strict=True)])
    return np.array(columns).T
