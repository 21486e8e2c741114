"""Hilltop saddles: the unstable motions about the upright balance, without any impact."""

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import checked_array
from rocksteady.dynamics.edges._courses import (
    Course,
    extrema_of,
    linear_course,
    nonlinear_course,
    valued,
)
from rocksteady.dynamics.history.start import State
from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.dynamics.orbits.return_map import harmonic
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.elementary.arrays import exp, hypot
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.checks.validation import LARGEST, finite
from rocksteady.model.equations import Linear, Model, ModelChoice, chosen_model
from rocksteady.model.motions.segments import Harmonic
from rocksteady.outcomes import Status
from rocksteady.results.result import Result

LONGEST_ROW = 1.0
"""Pivot time after which a trajectory is restarted from the saddle: it grows as e^s."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class HilltopSaddle(Result):
    """The unstable motion about the upright balance on one side, periodic with the shaking.

    Attributes
    ----------
    block, motion
        Block and base motion; the phase of `motion` is that of `start`.
    side
        +1 or -1.
    course
        The motion over a period, at equally spaced phases.
    highest, lowest
        Extrema of u = theta/alpha.
    multipliers
        Floquet multipliers over a forcing period, the larger first; their product is 1.
    residual
        Last step of Newton's method, in the side's units; 0 of the closed form.
    model
        Which equations of motion hold: `Linear` or `Nonlinear`.
    """

    block: Block | DimensionlessBlock
    motion: Harmonic
    side: int
    course: Course
    highest: float
    lowest: float
    multipliers: Floats
    residual: float
    model: Model = field(default_factory=Linear)

    @property
    def period(self) -> int:
        """Forcing periods of the motion: 1."""
        return 1

    @property
    def lyapunov(self) -> float:
        """Largest Lyapunov exponent per forcing period."""
        mean = float(np.mean(self.course.leaving))
        return 2.0 * math.pi / self.motion.frequency_ratio * self._scale[1] * mean

    @cached_property
    def _scale(self) -> tuple[float, float]:
        """Lean and rate of the side."""
        _, lean, rate = self.block.dimensionless().sides[0 if self.side > 0 else 1]
        return lean, rate

    def at(self, phase: ArrayLike) -> tuple[Floats, Floats]:
        """Return u and du/d(pt) at phases of the shaking [rad], arrays of their shape.

        Raises
        ------
        InputError
            If a phase is not a finite number, 1e50 at most.
        """
        lean, rate = self._scale
        turned = self._seen(phase)
        unit = self.side * lean
        return (
            np.asarray(unit * valued(self.course.angle, turned)),
            np.asarray(unit * rate * valued(self.course.velocity, turned)),
        )

    def direction(self, kind: Literal["unstable", "stable"], phase: float) -> tuple[float, float]:
        """Return the unit vector in (u, du/d(pt)) along which motions leave or near it.

        Parameters
        ----------
        kind
            "unstable" or "stable".
        phase
            Phase of the shaking [rad].

        Raises
        ------
        InputError
            If there is no such kind, or the phase is not a finite number.
        """
        phase = finite("phase", phase, hint="give a phase in radians")
        rates = self.course.leaving if kind == "unstable" else self.course.entering
        slope = self._scale[1] * float(valued(rates, self._seen(phase)))
        size = hypot(1.0, slope)
        return 1.0 / size, slope / size

    def _seen(self, phase: ArrayLike) -> Floats:
        bounds = Bounds(-LARGEST, LARGEST, "[]", "give a phase in radians")
        phases = checked_array("phase", phase, bounds)
        return phases + (0.0 if self.side > 0 else math.pi)

    @property
    def start(self) -> State:
        """The state at the phase of `motion`, for `rocksteady.simulate`."""
        angle, velocity = self.at(self.motion.phase)
        return State(angle=float(angle), velocity=float(velocity))

    def trajectory(self) -> Trajectory:
        """Return one period of the motion, restarted from the saddle after each pt = 1.

        A run from its start leaves it at the rate of the multiplier.
        """
        ratio = self.motion.frequency_ratio
        count = math.ceil(2.0 * math.pi / ratio / LONGEST_ROW)
        steps = 2.0 * math.pi / count
        rows = np.zeros((count + 1, columns.ROW_COLUMNS))
        for k, row in enumerate(rows):
            phase = self.motion.phase + k * steps
            half, rest = clock(phase)
            angle, velocity = self.at(phase)
            row[columns.ROW_HALF_CYCLES], row[columns.ROW_PHASE] = half, rest
            row[columns.ROW_SIDE] = self.side
            row[columns.ROW_ANGLE], row[columns.ROW_VELOCITY] = float(angle), float(velocity)
            row[columns.ROW_DURATION] = steps / ratio if k < count else 0.0
            row[columns.ROW_EVENT] = columns.ENDED_BY_SPAN
        tables = self.model.lower(self.block, self.motion)
        return Trajectory(
            block=self.block,
            motion=self.motion,
            status=Status.ROCKING,
            segments=tables.segments,
            sides=tables.sides,
            rows=rows,
            model=self.model,
            start=self.start,
        )


@checked
def find_hilltop_saddles(
    block: Block | DimensionlessBlock, motion: Harmonic, *, model: ModelChoice = None
) -> tuple[HilltopSaddle, ...]:
    """Return the unstable motions about the upright balance, one per side.

    In the linear model ``u = sigma - beta sin(Omega s + phi)`` with beta = A/(1 + Omega^2), and
    multipliers exp(+-2 pi/Omega); for an asymmetric block in the units of either side.  Where it
    would pass through the base, beta >= 1, there is none.

    Parameters
    ----------
    block
        One against a wall has one on its free side alone.
    motion
        Amplitude, frequency ratio and the phase at which the saddle's `start` is taken.
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.

    Returns
    -------
    tuple of HilltopSaddle
        That of the positive side first; empty where there is none.

    Raises
    ------
    InputError, ModelError
        If the shaking is not harmonic, or the nonlinear model meets a block without slenderness.

    References
    ----------
    S. Lenci and G. Rega, Int. J. Bifurcation Chaos 15, 1901-1918 (2005),
    doi:10.1142/S0218127405013046.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic
    >>> motion = Harmonic(amplitude=0.5, frequency_ratio=2.0, phase=1.0)
    >>> saddle, other = find_hilltop_saddles(DimensionlessBlock(restitution=0.9), motion)
    >>> print(f"{saddle.highest:.3f} {saddle.lowest:.3f} {saddle.multipliers[0]:.6f}")
    1.100 0.900 23.140693
    """
    bare, shaken = block.dimensionless(), harmonic(motion)
    equations = chosen_model(model, block)
    table = equations.sides(block)
    saddles = []
    for side in (1,) if bare.one_sided else (1, -1):
        row = table[0 if side > 0 else 1]
        lean, rate = float(row[columns.LEAN]), float(row[columns.RATE])
        swing, turn = shaken.amplitude / lean, shaken.frequency_ratio / rate
        if not columns.is_nonlinear(table):
            solved: tuple[Course, float] | None = linear_course(swing, turn), 0.0
        else:
            solved = nonlinear_course(swing, turn, float(row[columns.ALPHA]))
        if solved is None:
            continue
        course, residual = solved
        least, most = extrema_of(course)
        if least <= 0.0:
            continue
        ends = sorted((side * lean * least, side * lean * most))
        exponent = 2.0 * math.pi / turn * float(course.leaving.mean())
        saddles.append(
            HilltopSaddle(
                block=block,
                motion=shaken,
                side=side,
                course=course,
                highest=ends[1],
                lowest=ends[0],
                multipliers=np.array([exp(exponent), exp(-exponent)]),
                residual=residual,
                model=equations,
            )
        )
    return tuple(saddles)
