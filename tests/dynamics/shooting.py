"""Bifurcations by shooting with SciPy's DOP853 on the equations of motion: nothing of the package.

Unknowns are the phase of the first impact, the speed after each one, the duration of each flight
and one parameter; at a graze the time of the touch as well.  No event ends a flight: its duration
is an unknown, and that its angle is 0 at the end is an equation.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import root

from rocksteady import Block
from rocksteady.branches import BranchPoint

Floats = NDArray[np.float64]

PARAMETERS = ("amplitude", "frequency_ratio", "restitution")


@dataclass(frozen=True)
class Rocking:
    """A block by the numbers of its two sides, shape (2,) each: slenderness, p, restitution."""

    alpha: tuple[float, float]
    rate: tuple[float, float]
    kept: tuple[float, float]
    harmonics: tuple[tuple[int, float, float], ...] = ((1, 1.0, 0.0),)
    linear: bool = False

    @classmethod
    def of(
        cls,
        block: Block,
        harmonics: tuple[tuple[int, float, float], ...] = (),
        *,
        linear: bool = False,
    ) -> "Rocking":
        sides = (block.positive, block.negative)
        return cls(
            (sides[0].alpha, sides[1].alpha),
            (1.0, sides[1].p / sides[0].p),
            (sides[0].restitution, sides[1].restitution),
            harmonics or ((1, 1.0, 0.0),),
            linear,
        )

    def wave(self, phase: float) -> float:
        return math.fsum(size * math.sin(k * phase + shift) for k, size, shift in self.harmonics)

    def fly(
        self, side: int, values: Floats, phase: float, speed: float, duration: float
    ) -> tuple[Floats, float]:
        """Return the angle at the end, its rate, M by rows, and the acceleration there.

        Time counts in 1/p of the positive side, the angle in its alpha.
        """
        row = 0 if side > 0 else 1
        alpha, rate, unit = self.alpha[row], self.rate[row], self.alpha[0]
        amplitude, frequency = values[0], values[1]

        def bend(time: float, u: float) -> float:
            tilt = alpha - u * unit
            base = side * amplitude * unit * self.wave(phase + frequency * time)
            if self.linear:
                return float(rate**2 * (base - tilt) / unit)
            return float(rate**2 * (base * math.cos(tilt) - math.sin(tilt)) / unit)

        def slopes(time: float, y: Floats) -> list[float]:
            tilt = alpha - y[0] * unit
            base = side * amplitude * unit * self.wave(phase + frequency * time)
            stiffness = rate**2 * (base * math.sin(tilt) + math.cos(tilt))
            if self.linear:
                stiffness = rate**2
            return [y[1], bend(time, y[0]), y[4], y[5], stiffness * y[2], stiffness * y[3]]

        begin = [0.0, speed, 1.0, 0.0, 0.0, 1.0]
        run = solve_ivp(slopes, (0.0, duration), begin, method="DOP853", rtol=1e-13, atol=1e-15)
        return run.y[:, -1], bend(duration, float(run.y[0, -1]))

    def moved(self, restitution: float) -> "Rocking":
        kept = self.kept if self.kept[0] != self.kept[1] else (restitution, restitution)
        return Rocking(self.alpha, self.rate, kept, self.harmonics, self.linear)

    def around(
        self, values: Floats, phase: float, speeds: Floats, durations: Floats
    ) -> tuple[list[float], Floats]:
        """Return by what flights fail to close at their ends, and the derivative of the map."""
        block = self.moved(float(values[2]))
        missed: list[float] = []
        total = np.eye(2)
        count, frequency = len(speeds), values[1]
        passed = phase
        for k in range(count):
            side = 1 if k % 2 == 0 else -1
            row = 0 if side > 0 else 1
            end, bend = block.fly(side, values, passed, speeds[k], durations[k])
            passed += frequency * durations[k]
            kept = block.kept[row]
            missed += [float(end[0]), -kept * float(end[1]) - speeds[(k + 1) % count]]
            # The derivative by (phase, speed): a shift of the phase is one of the time, which
            # moves the start of the flight along it.
            m11, m12, m21, m22 = end[2:]
            begin = block.fly(side, values, passed - frequency * durations[k], speeds[k], 1e-300)[1]
            # y at a fixed absolute time, by the phase at the start: -M (speed, begin)/frequency.
            by_phase = (
                np.array([-(m11 * speeds[k] + m12 * begin), -(m21 * speeds[k] + m22 * begin)])
                / frequency
            )
            by_speed = np.array([m12, m22])
            columns = []
            for at in (by_phase, by_speed):
                later = -at[0] / end[1]
                columns.append([frequency * later, -kept * (at[1] + bend * later)])
            total = np.array(columns).T @ total
        return missed, total


def solved(point: BranchPoint, parameter: str, multiplier: float | None) -> float:
    """Return where the parameter is at a bifurcation near a point.

    Parameters
    ----------
    point
        The place where the search begins, beside it.
    parameter
        That moves.
    multiplier
        Of the chain at the bifurcation; None for a graze.
    """
    chain, index = point.chain, PARAMETERS.index(parameter)
    assert isinstance(point.block, Block)
    block, count = (
        Rocking.of(point.block, chain.harmonics, linear=point.model.name == "linear"),
        chain.impacts,
    )
    turn = chain.half_cycles * math.pi
    phase = float(chain.phases[0] + chain.turns[0] * math.pi)
    values = chain.parameters.copy()
    touching = int(np.nanargmin(chain.shape[:, 1])) if multiplier is None else -1
    guess: Floats = np.array(
        [phase, *chain.table[:, 0], *chain.durations, values[index]]
        + ([chain.shape[touching, 2]] if multiplier is None else [])
    )

    def errors(unknown: Floats) -> Floats:
        here = values.copy()
        here[index] = unknown[2 * count + 1]
        speeds, durations = unknown[1 : count + 1], unknown[count + 1 : 2 * count + 1]
        missed, total = block.around(here, unknown[0], speeds, durations)
        missed.append(float(here[1] * durations.sum() - turn))
        if multiplier is None:
            first = unknown[0] + here[1] * float(durations[:touching].sum())
            side = 1 if touching % 2 == 0 else -1
            end, _ = block.moved(here[2]).fly(
                side, here, first, speeds[touching], unknown[2 * count + 2]
            )
            missed += [float(end[0]), float(end[1])]
            return np.array(missed)
        determinant = float(np.linalg.det(total))
        missed.append(multiplier**2 - multiplier * float(np.trace(total)) + determinant)
        return np.array(missed)

    aside = 1e-5 * np.cos(np.arange(len(guess)))  # not where it should end
    found = root(errors, guess + aside, method="hybr", options={"xtol": 1e-14})
    assert np.abs(errors(found.x)).max() < 1e-10, found
    return float(found.x[2 * count + 1])
