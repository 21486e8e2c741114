"""A run in seconds, in tau and in SI: times, states, and what its base must carry."""

import math
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import real_array
from rocksteady.dynamics.history import base_motion
from rocksteady.dynamics.history._resting import resting_ratio
from rocksteady.dynamics.history.lowering import mass_centres, weight_kn
from rocksteady.dynamics.history.samples import Flights, Impacts, Samples
from rocksteady.dynamics.history.start import State
from rocksteady.errors import ModelError, Words
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.tables import is_nonlinear
from rocksteady.kernels.core.tuples import Tables
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.kernels.march.facts import RunFacts
from rocksteady.kernels.march.forces import FORCES, largest_forces
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.blocks.sides import impact_friction
from rocksteady.model.blocks.tops import clearance, top_displacement
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.checks.bounds import MASS
from rocksteady.model.checks.validation import finite
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Still

if TYPE_CHECKING:
    from rocksteady.model.blocks.dimensionless import DimensionlessBlock
    from rocksteady.model.equations import Model
    from rocksteady.model.motions.segments import Motion
    from rocksteady.outcomes import Status


@checked_result
class Physical:
    """A run in seconds, in tau = omega t and in SI, from its tables in pivot time."""

    if TYPE_CHECKING:
        block: Block | DimensionlessBlock
        motion: Motion | Record
        vertical: Motion | Record | None
        segments: Floats
        sides: Floats
        rows: Floats
        model: Model
        status: Status

        @property
        def peak(self) -> float: ...

        @property
        def side_peaks(self) -> tuple[float, float]: ...

        @property
        def balanced(self) -> bool: ...

        @property
        def impact_count(self) -> int: ...

        @property
        def _landings(self) -> Impacts: ...

        @property
        def growth(self) -> float: ...

        @property
        def end_time_pt(self) -> float: ...

        @property
        def rest_time_pt(self) -> float | None: ...

        @property
        def overturn_time_pt(self) -> float | None: ...

        @property
        def flights(self) -> Flights: ...

        @property
        def _facts(self) -> RunFacts: ...

        def _times(self, pt: ArrayLike) -> Floats: ...

        def __call__(self, pt: ArrayLike) -> Samples: ...

    def _seconds(self, pt: float | None) -> float | None:
        return pt / self.block.p if pt is not None and isinstance(self.block, Block) else None

    def _tau(self, pt: float | None) -> float | None:
        if pt is None or not isinstance(self.motion, PeriodicMotion):
            return None
        return pt * self.motion.frequency_ratio

    @property
    def end_time_s(self) -> float | None:
        """Time up to which the trajectory reaches [s]; None without a `Block`."""
        return self._seconds(self.end_time_pt)

    @property
    def rest_time_s(self) -> float | None:
        """Time at which the block came to rest [s]; None without a `Block`, or if it did not."""
        return self._seconds(self.rest_time_pt)

    @property
    def overturn_time_s(self) -> float | None:
        """Time of overturning [s]; None without a `Block`, or if it does not overturn."""
        return self._seconds(self.overturn_time_pt)

    @property
    def end_time_tau(self) -> float | None:
        """Time up to which the trajectory reaches, omega t; None unless `Harmonic`."""
        return self._tau(self.end_time_pt)

    @property
    def rest_time_tau(self) -> float | None:
        """Time at which the block came to rest, omega t; None unless `Harmonic`."""
        return self._tau(self.rest_time_pt)

    @property
    def overturn_time_tau(self) -> float | None:
        """Time of overturning, omega t; None unless `Harmonic`, or if it does not overturn."""
        return self._tau(self.overturn_time_pt)

    def at_time(self, t_s: ArrayLike) -> Samples:
        """Return the motion at times in seconds.

        Raises
        ------
        ModelError
            If the block is dimensionless.
        """
        if not isinstance(self.block, Block):
            raise ModelError(
                "block",
                self.block,
                "seconds need a block with a frequency parameter p",
                "simulate a Block, or ask in pivot time: trajectory(pt)",
            )
        with np.errstate(over="ignore"):  # infinite, it is outside the trajectory
            pt = real_array("t_s", t_s) * self.block.p
        return self(pt)

    def at_tau(self, tau: ArrayLike) -> Samples:
        """Return the motion at tau = omega t of harmonic shaking.

        Raises
        ------
        ModelError
            If the shaking is not harmonic.
        """
        with np.errstate(over="ignore"):  # infinite, it is outside the trajectory
            pt = real_array("tau", tau) / self.frequency_ratio
        return self(pt)

    @property
    def frequency_ratio(self) -> float:
        """Omega of harmonic shaking.

        Raises
        ------
        ModelError
            If the shaking is not harmonic.
        """
        if not isinstance(self.motion, PeriodicMotion):
            raise ModelError(
                "motion",
                self.motion,
                "tau = omega t needs harmonic shaking",
                "ask in pivot time: trajectory(pt)",
            )
        return self.motion.frequency_ratio

    def state(
        self, *, pt: float | None = None, t_s: float | None = None, tau: float | None = None
    ) -> State:
        """Return the state at a time, from which another run can start.

        It has the phase of harmonic shaking then, so that the run continues as this one does.  Any
        other motion begins again.

        Parameters
        ----------
        pt, t_s, tau
            The time: pivot time, seconds or omega t; exactly one of them.

        Raises
        ------
        ModelError
            If not exactly one time is given, or the run has no such unit.
        InputError
            If the time is outside the trajectory.

        Examples
        --------
        >>> from rocksteady import DimensionlessBlock, Harmonic, simulate
        >>> shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0)
        >>> run = simulate(DimensionlessBlock(restitution=0.8), shaking, cycles=3)
        >>> start = run.state(pt=2.0)
        >>> later = simulate(run.block, shaking, start=start, cycles=1)
        >>> print(abs(run(2.5).angle - later(0.5).angle) < 1e-12)
        True
        """
        given = {"pt": pt, "t_s": t_s, "tau": tau}
        names = [name for name, value in given.items() if value is not None]
        if len(names) != 1:
            raise ModelError(
                "pt, t_s, tau",
                Words(f"are given as {' and '.join(names)}" if names else "are all missing"),
                "exactly one sets the time",
                "give pt=..., t_s=... or tau=...",
            )
        time = finite(names[0], given[names[0]], hint="give one time")
        views = {"pt": self.__call__, "t_s": self.at_time, "tau": self.at_tau}
        motion = views[names[0]](time)
        phase = None
        if isinstance(self.motion, PeriodicMotion):
            # From the clock of its flight, which keeps its digits in long runs.
            at = float(motion.pt)
            row = int(np.searchsorted(self.flights.pt, at, side="right")) - 1
            half = int(self.rows[row, columns.ROW_HALF_CYCLES]) % 2
            turned = self.motion.frequency_ratio * max(at - float(self.flights.pt[row]), 0.0)
            phase = half * math.pi + float(self.rows[row, columns.ROW_PHASE]) + turned
        return State(angle=float(motion.angle), velocity=float(motion.velocity), phase=phase)

    @property
    def _carried_block(self) -> Block | None:
        """The block, if it has a size and the base a finite acceleration."""
        struck = self.segments[:, columns.JUMP].any()
        return self.block if isinstance(self.block, Block) and not struck else None

    @property
    def _shaken_block(self) -> Block | None:
        """The same, if the base has a motion that ends."""
        endless = isinstance(self.motion, PeriodicMotion | Still) and self.vertical is None
        return None if endless else self._carried_block

    @cached_property
    def uplift_g(self) -> float | None:
        """Base acceleration [g] that lifts the block from its base; None without a size or shock.

        ``tan(alpha)`` of the side that lifts first, without vertical motion; alpha in the linear
        model.
        """
        block = self._shaken_block
        if block is None:
            return None
        least = block.positive.alpha
        if not block.one_sided:
            least = min(least, block.negative.alpha)
        ratio = tan(least) if is_nonlinear(self._tables.sides) else least
        return float(ratio) * (block.gravity / STANDARD_GRAVITY)

    @cached_property
    def pga_g(self) -> float | None:
        """Largest horizontal acceleration of the ground [g]; None where `uplift_g` is."""
        block = self._shaken_block
        if block is None:
            return None
        if isinstance(self.motion, Record):
            return self.motion.reference.peak_acceleration_m_s2 / STANDARD_GRAVITY
        peak = base_motion.peak_acceleration(self.segments)
        return peak * (block.uplift_acceleration / STANDARD_GRAVITY)

    @cached_property
    def floor_pga_g(self) -> float | None:
        """Largest horizontal acceleration of the floor of a building [g]; None on the ground."""
        if isinstance(self.motion, Record) and self.motion.ground and self.pga_g is not None:
            return self.motion.peak_acceleration_m_s2 / STANDARD_GRAVITY
        return None

    @cached_property
    def friction_needed(self) -> float | None:
        """Least coefficient of friction that keeps the block from sliding, up to overturning.

        The largest ratio of horizontal and vertical force: at the pivot while the block rocks, at
        its base while it rests, or of its impacts (`friction_at_impacts`); infinite where the
        vertical force vanishes.  None without a size, or if the base has impulses.  Of one against
        a wall neither impacts nor what drives it into the wall count.
        """
        block = self._carried_block
        if block is None:
            return None
        rocking = 0.0 if self._forces is None else self._forces[2]
        until = self.end_time_pt if self.overturn_time_pt is None else self.overturn_time_pt
        resting = block.alpha * resting_ratio(
            self.segments, self.flights, until, one_sided=block.one_sided
        )
        return max(rocking, resting, self.friction_at_impacts or 0.0)

    @cached_property
    def friction_at_impacts(self) -> float | None:
        """Least coefficient of friction that the impacts up to overturning need.

        None where `friction_needed` is, without impacts, or against a wall.
        """
        block = self._carried_block
        if block is None or block.one_sided:
            return None
        count = self._facts.passing if self._facts.passing >= 0 else len(self.rows)
        ended = self.rows[:count, columns.ROW_EVENT] == columns.ENDED_BY_IMPACT
        signs = set(np.sign(self.rows[:count, columns.ROW_SIDE][ended]).tolist())
        sides = {1.0: (block.positive, block.negative), -1.0: (block.negative, block.positive)}
        return max((impact_friction(*sides[sign]) for sign in signs), default=None)

    @cached_property
    def forces_per_weight(self) -> tuple[float, float] | None:
        """Largest horizontal and vertical force on the base while the block rocks, over its weight.

        Newton's law of the mass centre, up to overturning; of a frame that of columns and cap
        together.  The impacts, which last no time here, are left out.  None where `uplift_g` is, or
        if the block never rocks.
        """
        return None if self._shaken_block is None else self._forces and self._forces[:2]

    def base_force_kn(self, mass_kg: float) -> tuple[float, float] | None:
        """Return the largest horizontal and vertical force on the base while the block rocks [kN].

        Parameters
        ----------
        mass_kg
            Mass of the block, or of columns and cap of a frame together [kg].

        Returns
        -------
        tuple of float or None
            `forces_per_weight` times the weight; None if the block never rocks.

        Raises
        ------
        InputError
            If the mass is not above 0 and at most 1e9 kg.
        ModelError
            If the block has no size, or the base motion no end or impulses.

        Examples
        --------
        >>> from rocksteady import Pulse, simulate
        >>> block = Block.rectangle(width=0.6, height=1.8)
        >>> pulse = Pulse.from_si(block, shape="one-sine", acceleration_m_s2=4.0, frequency_hz=1.0)
        >>> print("{:.1f} and {:.1f} kN".format(*simulate(block, pulse).base_force_kn(1000.0)))
        3.5 and 10.0 kN
        """
        mass = MASS("mass_kg", mass_kg)
        block, parts = self._shaken_block, self.forces_per_weight
        if block is None:
            raise ModelError(
                "mass_kg",
                mass_kg,
                "the force on the base is that of a Block on a motion that ends",
                "leave it out, or give a pulse or a record",
            )
        if parts is None:
            return None
        weight = weight_kn(block, mass)
        return parts[0] * weight, parts[1] * weight

    @property
    def _turned(self) -> tuple[Block, list[float]] | None:
        """The block and its largest rotation about the left and right edge; None if it falls."""
        block = self.block
        if not isinstance(block, Block) or self.overturn_time_pt is not None:
            return None
        alphas = block.positive.alpha, -block.negative.alpha
        return block, [p * a for p, a in zip(self.side_peaks, alphas, strict=True)]

    @property
    def top_displacement_m(self) -> float | None:
        """Largest motion of the top across the base [m], at the full height of the block.

        That of the upper corner opposite to the pivot; of a frame the motion of the cap.
        None without a `Block`, or if it overturns.
        """
        if self._turned is None:
            return None
        block, angles = self._turned
        return float(top_displacement(block, angles).max())

    @property
    def clearances_m(self) -> tuple[float, float] | None:
        """Gaps that keep the block off neighbours on its left and right [m].

        They hold the upper corners of its outline, of a frame the cap, off neighbours as high that
        move with the base.
        None without a `Block`, or if it overturns.
        """
        if self._turned is None:
            return None
        block, angles = self._turned
        left, right = clearance(block, angles).tolist()
        return left, right

    @property
    def impact_speed_m_s(self) -> float | None:
        """Largest speed with which an edge strikes the base [m/s]: width times angular velocity.

        None without a `Block`; 0 without impacts.
        """
        if not isinstance(self.block, Block):
            return None
        fastest = float(np.abs(self._landings.velocity_before).max(initial=0.0))
        return self.block.width * (self.block.alpha * self.block.p * fastest)

    @property
    def _tables(self) -> Tables:
        """The tables for kernels, which can be written to."""
        return Tables(vars(self)["segments"], vars(self)["sides"])

    @property
    def _rows(self) -> Floats:
        """The rows for kernels, which can be written to."""
        rows: Floats = vars(self)["rows"]
        return rows

    @cached_property
    def _forces(self) -> tuple[float, float, float] | None:
        """Largest force across and down over the weight, and ratio of both, while the block rocks.

        None if it never rocks, or where the forces are not known.
        """
        if self._carried_block is None:
            return None
        rows, last = self._rows, self._facts.last
        if self._facts.passing >= 0:
            rows, last = rows[: self._facts.passing + 1], self._facts.since
        largest = np.empty(FORCES)
        centres = mass_centres(self._carried_block)
        largest_forces(self._tables, rows, last, centres, largest)
        across, down, ratio = largest.tolist()
        return None if math.isnan(across) else (across, down, ratio)
