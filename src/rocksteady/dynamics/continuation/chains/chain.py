"""A periodic orbit at given parameters as a chain of arcs, the form that continuation uses."""

import math
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.chains.predictor_corrector import null_vector
from rocksteady.dynamics.grazing import grazes
from rocksteady.dynamics.orbits.orbit import ordered, squared
from rocksteady.dynamics.steady.verdicts import NO_MULTIPLIERS
from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.orbits import chains as kernel
from rocksteady.kernels.orbits.return_map import Section
from rocksteady.kernels.orbits.systems import SeriesSystem, for_system, make_series_system
from rocksteady.kernels.orbits.systems import make_system as system_of
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.equations import Linear, Model
from rocksteady.model.motions.fourier import FourierSeries, PeriodicMotion, shares_of
from rocksteady.model.motions.harmonics import Harmonics
from rocksteady.model.motions.segments import Harmonic

COLUMNS = (kernel.BY_AMPLITUDE, kernel.BY_FREQUENCY, kernel.BY_RESTITUTION)
MERGED = 1e-9
"""Duration up to which an arc between two impacts counts as none."""
TOUCH = 1e-13
"""Height of an arc at which rounding decides whether it touches the base."""
ANY = DimensionlessBlock(restitution=1.0)
"""A block whose sides are alike, by default: its restitution is a parameter of the chain."""
LINEAR = Linear()
"""The default of its equations of motion."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Chain:
    """Phases of the impacts of an orbit, or of half a symmetric one, as in `kernels.orbits.chains`.

    Attributes
    ----------
    parameters
        Amplitude, frequency ratio and restitution, shape (3,); the restitution of both impacts, or
        where they differ, of the impact that ends positive rotation.
    turns, phases
        Whole half cycles of the shaking and the phase beyond them at each impact, shape (m,); the
        first impact sends the block to its positive side.
    half_cycles
        Half periods of the shaking after which the chain closes: odd, as m, for half of a symmetric
        orbit.
    block
        What moves; its restitution does not count where both impacts have the same.
    model
        Which equations of motion hold.
    harmonics
        Harmonics of the Fourier series that shakes the base; none for a sinusoid.
    """

    parameters: Floats
    turns: NDArray[np.int64]
    phases: Floats
    half_cycles: int
    block: Block | DimensionlessBlock = ANY
    model: Model = LINEAR
    harmonics: Harmonics = ()

    @property
    def alike(self) -> bool:
        """Whether mirror images of its orbits are orbits, half a period later.

        The block's sides have to be alike, and all orders of a series odd.
        """
        return self.block.symmetric and all(order % 2 == 1 for order, _, _ in self.harmonics)

    @property
    def motion(self) -> PeriodicMotion:
        """The shaking."""
        amplitude, frequency, _ = self.parameters.tolist()
        if not self.harmonics:
            return Harmonic(amplitude=amplitude, frequency_ratio=frequency)
        return FourierSeries(
            amplitude=amplitude, frequency_ratio=frequency, harmonics=self.harmonics
        )

    @cached_property
    def series(self) -> SeriesSystem:
        """Block and shaking by a Fourier series as the kernels see them."""
        amplitude, frequency, _ = self.parameters.tolist()
        total, shares = shares_of(self.harmonics)
        lifts = np.empty((2, len(shares) // 2))  # of no use to chains, which never rest
        return make_series_system(amplitude * total, frequency, self.sides, shares, lifts)

    @property
    def body(self) -> Block | DimensionlessBlock:
        """The block with the restitution of the chain."""
        sides = self.block.dimensionless().sides
        restitution = float(self.parameters[2])
        if sides[0][0] != sides[1][0] or sides[0][0] == restitution:
            return self.block
        return self.block.with_restitution(restitution)

    @property
    def impacts(self) -> int:
        """Number of impacts, m."""
        return len(self.phases)

    @property
    def symmetric(self) -> bool:
        """Whether the chain is half of a symmetric orbit."""
        return self.half_cycles % 2 == 1

    @property
    def period(self) -> int:
        """Forcing periods of the whole orbit."""
        return self.half_cycles if self.symmetric else self.half_cycles // 2

    @cached_property
    def sides(self) -> Floats:
        """The block's sides for the kernels, shape (2, 3) or (2, 5)."""
        sides = _sides_of(self.block, self.model).copy()
        if sides[0, 0] == sides[1, 0]:
            sides[:, 0] = self.parameters[2]
        return sides

    @cached_property
    def table(self) -> Floats:
        """What the kernel returns for each arc, shape (m, CHAIN_COLUMNS)."""
        amplitude, frequency, _ = self.parameters.tolist()
        table = np.empty((self.impacts, kernel.CHAIN_COLUMNS))
        if self.harmonics:
            kernel.series_fill_chain(self.series, self.turns, self.phases, self.half_cycles, table)
            table[:, kernel.BY_AMPLITUDE] *= shares_of(self.harmonics)[0]
            return table
        kernel.fill_chain(
            amplitude, frequency, self.sides, self.turns, self.phases, self.half_cycles, table
        )
        return table

    @property
    def errors(self) -> Floats:
        """By what the chain fails to be an orbit: speeds at its impacts, shape (m,)."""
        return self.table[:, kernel.ERROR]

    def matrix(self, closing: float) -> Floats:
        """Return the derivative of the errors by the phases, closed with 1 or -1."""
        matrix = np.empty((self.impacts, self.impacts))
        kernel.fill_matrix(self.table, closing, matrix)
        return matrix

    def jacobian(self, active: tuple[int, ...]) -> Floats:
        """Return the derivative of the errors by phases and active parameters, shape (m, m + k)."""
        columns = self.table[:, [COLUMNS[index] for index in active]]
        return np.hstack([self.matrix(1.0), columns])

    def determinant(self, closing: float) -> float:
        """Return the determinant of `matrix`, its rows over the sizes of their terms: in [-1, 1].

        It is 0 where `closing` is a Floquet multiplier of the chain.
        """
        return self.scaled_determinant(closing, self.sizes)

    @property
    def sizes(self) -> Floats:
        """Sum of the sizes of the terms in each row of `matrix`, shape (m,)."""
        band = self.table[:, [kernel.BY_BEFORE, kernel.BY_HERE, kernel.BY_AFTER]]
        sizes: Floats = np.abs(band).sum(axis=1)
        return sizes

    def scaled_determinant(self, closing: float, sizes: Floats) -> float:
        """Return the determinant of `matrix` with its rows divided by sizes, shape (m,).

        With sizes that stay the same it changes over a curve as the matrix does.  With the chain's
        own it jumps from -1 to 1 where the arcs are long: at a fold all terms of a row of one arc
        vanish like e^-T together.
        """
        return float(np.linalg.det(self.matrix(closing) / sizes[:, np.newaxis]))

    def null_direction(self, closing: float) -> Floats:
        """Return the null vector of the derivative: a displacement of the phases, of length 1."""
        return null_vector(self.matrix(closing))

    @property
    def durations(self) -> Floats:
        """Pivot time of each arc."""
        return self.table[:, kernel.DURATION]

    @cached_property
    def shape(self) -> Floats:
        """Largest |theta|/alpha of each arc, its least minimum and when that is, shape (m, 3)."""
        amplitude, frequency, _ = self.parameters.tolist()
        shape = np.empty((self.impacts, 3))
        system = self.series if self.harmonics else system_of(amplitude, frequency, self.sides)
        for_system(kernel.fill_arcs, system)(system, self.turns, self.phases, self.table, shape)
        return shape

    @property
    def shortest(self) -> float:
        """Duration of the shortest arc; at 0 two impacts merge."""
        return float(self.durations.min())

    @property
    def clearance(self) -> float:
        """Least minimum of the height between impacts; inf where no arc dips."""
        return float(np.nanmin(self.shape[:, 1], initial=math.inf))

    @property
    def admissible(self) -> bool:
        """Whether the block leaves its base at each impact and meets it at the next, no earlier."""
        return bool(
            self.shortest > 0.0
            and self.clearance > 0.0
            and (self.table[:, kernel.START] > 0.0).all()
        )

    @property
    def touches(self) -> bool:
        """Whether the block touches its base between two impacts."""
        return abs(self.clearance) < TOUCH

    @property
    def multipliers(self) -> NDArray[np.complex128]:
        """Floquet multipliers of the whole orbit, shape (2,), the larger first; inf if unknown.

        From the trace and the exact determinant, the product of the squares of all restitutions.
        nan where an arc lands without speed: no derivative exists there.  Where the block touches
        its base between two impacts they are those beside the touch, on the side without it.
        """
        amplitude, frequency, _ = self.parameters.tolist()
        if grazes(float(self.table[:, kernel.LANDING].min()), amplitude, frequency):
            return NO_MULTIPLIERS
        with np.errstate(all="ignore"):
            over = kernel.turned_over(self.table)
        half = 0.5 * float(over.phase_by_phase + over.speed_by_speed)
        if not math.isfinite(half):
            return np.array([complex(math.inf, 0.0), complex(0.0, 0.0)])
        kept = self.sides[np.arange(self.impacts) % 2, 0].tolist()
        determinant = math.prod(kept + kept)
        spread = half * half - determinant
        if spread < 0.0:
            first = complex(half, math.sqrt(-spread))
            second = first.conjugate()
        else:
            first = complex(half + math.copysign(math.sqrt(spread), half))
            second = complex(determinant / first.real)
        if self.symmetric:
            first, second = squared(first), squared(second)
        return ordered(first, second)

    @property
    def peaks(self) -> Floats:
        """Extreme u = theta/alpha of every flight of the whole orbit, with its side."""
        signs = np.where(np.arange(self.impacts) % 2 == 0, 1.0, -1.0)
        merged = np.abs(self.durations) < MERGED
        peaks: Floats = signs * np.where(merged, 0.0, self.shape[:, 0])
        return np.concatenate([peaks, -peaks]) if self.symmetric else peaks

    @property
    def sections(self) -> list[Section]:
        """The whole orbit just after each of its impacts, as the kernels see it."""
        count = self.impacts
        sections = []
        for k in range(2 * count if self.symmetric else count):
            row = k % count
            further, phase = clock(float(self.phases[row]))
            half = int(self.turns[row]) + further + (self.half_cycles if k >= count else 0)
            speed = max(float(self.table[row, kernel.START]), 0.0)
            sections.append(Section(kernel.side_of(k), half, phase, speed))
        return sections

    def moved(self, phases: Floats, parameters: Floats) -> "Chain":
        """Return the chain at other phases and parameters."""
        return replace(self, phases=phases, parameters=parameters)

    def doubled(self) -> "Chain":
        """Return the chain run through twice, as one of twice the length."""
        return self._repeated(2)

    def halved(self) -> "Chain | None":
        """Return the chain of half the length nearest to this one; None where none can be.

        A chain that is its own half twice over is where a symmetry breaks or a period doubles.
        """
        return self._part(2)

    @property
    def halves_apart(self) -> Floats | None:
        """By what the second half of the chain is no repetition of the first, shape (m/2,) [rad].

        None of a chain that no shorter one can be the half of.
        """
        middle = self.halved()
        if middle is None:
            return None
        half = middle.impacts
        turns = middle.turns - self.turns[:half]
        return 2.0 * (turns * math.pi + (middle.phases - self.phases[:half]))

    def primitive(self, tolerance: float) -> "Chain":
        """Return the shortest chain that gives this one when it is run through several times.

        Parameters
        ----------
        tolerance
            Largest difference of phases [rad].
        """
        for times in range(self.impacts, 1, -1):
            part = self._part(times)
            if part is not None and part._repeated(times).distance(self) <= tolerance:
                return part
        return self

    def _part(self, times: int) -> "Chain | None":
        """Return the chain nearest to a part of this one; None where none can be."""
        count, rest = divmod(self.impacts, times)
        turn, odd = divmod(self.half_cycles, times)
        if rest or odd or count % 2 != turn % 2 or (count % 2 and not self.alike):
            return None
        total = (self.turns * math.pi + self.phases).reshape(times, count)
        middle = (total - math.pi * turn * np.arange(times)[:, np.newaxis]).mean(axis=0)
        turns = np.floor(middle / math.pi).astype(np.int64)
        return replace(self, turns=turns, phases=middle - turns * math.pi, half_cycles=turn)

    def _repeated(self, times: int) -> "Chain":
        """Return the chain run through several times, as one so much longer."""
        return replace(
            self,
            turns=np.concatenate([self.turns + k * self.half_cycles for k in range(times)]),
            phases=np.tile(self.phases, times),
            half_cycles=times * self.half_cycles,
        )

    def distance(self, other: "Chain") -> float:
        """Return the largest difference of phases of two chains of one length, as they stand."""
        apart = (self.turns - other.turns) * math.pi + (self.phases - other.phases)
        return float(np.abs(apart).max())

    def moves_like(self, other: "Chain") -> bool:
        """Return whether two chains are of one block, its restitution aside, model and series."""
        if self.harmonics != other.harmonics:
            return False
        if self.block == other.block and self.model == other.model:
            return True
        mine, theirs = _sides_of(self.block, self.model), _sides_of(other.block, other.model)
        if mine.shape != theirs.shape:
            return False
        unlike = mine[0, 0] != mine[1, 0] or theirs[0, 0] != theirs[1, 0]
        first = 0 if unlike else 1
        return bool((mine[:, first:] == theirs[:, first:]).all())

    def repeats(self, other: "Chain", tolerance: float, *, mirrors: bool = False) -> bool:
        """Return whether two chains are one orbit, begun at different impacts.

        Parameters
        ----------
        other
            At the same parameters.
        tolerance
            Largest difference of phases [rad].
        mirrors
            Whether mirror images count as one orbit; a symmetric orbit is its own, and of a block
            whose sides differ, or under a series with an even order, they are none.
        """
        if (self.impacts, self.half_cycles) != (other.impacts, other.half_cycles):
            return False
        if not self.moves_like(other):
            return False
        mine, theirs = (chain.turns * math.pi + chain.phases for chain in (self, other))
        beyond = np.concatenate([theirs, theirs + other.half_cycles * math.pi])
        either = self.symmetric or (mirrors and self.alike)
        for shift in range(0, self.impacts, 1 if either else 2):
            apart = beyond[shift : shift + self.impacts] - mine
            # An odd number of impacts later the block goes to the other side: so does the shaking.
            halves = 2.0 * np.round(0.5 * (apart[0] / math.pi - shift % 2)) + shift % 2
            if np.abs(apart - halves * math.pi).max() <= tolerance:
                return True
        return False


@lru_cache(maxsize=64)
def _sides_of(block: Block | DimensionlessBlock, model: Model) -> Floats:
    """Return a block's sides for the kernels."""
    return model.sides(block)
