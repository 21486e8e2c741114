"""A time history: its flights and impacts, and the motion at any time."""

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import real_array
from rocksteady.dynamics.history import base_motion
from rocksteady.dynamics.history._growth import Course, growth_of
from rocksteady.dynamics.history._resting import resting_ratio
from rocksteady.dynamics.history.samples import Flights, Impacts, Samples
from rocksteady.dynamics.history.start import Rest, Start, State
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.tables import is_nonlinear
from rocksteady.kernels.core.tuples import Tables
from rocksteady.kernels.elementary.arrays import sin, tan
from rocksteady.kernels.march.facts import LANDING_ROWS, RunFacts, fill_landings, run_facts
from rocksteady.kernels.march.forces import FORCES, largest_forces
from rocksteady.kernels.march.replay import fill_states
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.blocks.sides import impact_friction
from rocksteady.model.blocks.tops import clearance, top_displacement
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.checks.bounds import MASS
from rocksteady.model.checks.validation import (
    LARGEST,
    finite,
    span_value,
    whole_number,
    within_memory,
)
from rocksteady.model.equations import Linear, Model
from rocksteady.model.linear_tables import mass_centres, weight_kn
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Motion, Still
from rocksteady.model.units import in_units
from rocksteady.outcomes import Status
from rocksteady.results.description import Description
from rocksteady.results.result import Result, words_module

if TYPE_CHECKING:
    import xarray

STILL = 1e-12
"""Velocity d(theta/alpha)/d(p t) below which a block at its balance stands."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Trajectory(Result):
    """Time history of a block: flights, impacts, and the motion at any time.

    Call it with pivot times, ``trajectory(pt)``; `at_time` takes seconds and `at_tau` the paper's
    tau = omega t.

    Attributes
    ----------
    block
        The block.
    motion
        The horizontal base motion, with the phase that the start has given it.
    status
        How it ended: rocking (a flight or its end was in progress), at rest, overturned, or
        undecided (the flight limit was reached).
    segments, sides
        The tables that the kernels saw.
    rows
        The flights and rests, shape (flights, 8), with the columns of `kernels.march.march`.
    vertical
        The vertical base motion, if any.
    model
        Which equations of motion held: `Linear` or `Nonlinear`.
    start
        Where the block began, as it was given.
    impacts_left_out
        Impacts after the last flight: those on a still base of a run that came to its limit of
        flights, whose number and end in rest are known without flights.
    """

    KERNEL_FIELDS: ClassVar = ("segments", "sides", "rows")

    block: Block | DimensionlessBlock
    motion: Motion | Record
    status: Status
    segments: Floats
    sides: Floats
    rows: Floats
    vertical: Motion | Record | None = None
    model: Model = field(default_factory=Linear)
    start: Start = field(default_factory=Rest)
    impacts_left_out: int = 0

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
    def _timed(self) -> tuple[Floats, RunFacts]:
        """Pivot time at which each row begins, and the facts of the run."""
        starts = np.empty(len(self.rows))
        return starts, run_facts(self._tables, self._rows, int(self.status), starts)

    @property
    def _facts(self) -> RunFacts:
        """Times and peaks of the run."""
        return self._timed[1]

    @cached_property
    def flights(self) -> Flights:
        """All flights and rests in order."""
        return Flights(
            pt=self._timed[0],
            duration=self.rows[:, columns.ROW_DURATION],
            side=self.rows[:, columns.ROW_SIDE].astype(np.int64),
            angle=self.rows[:, columns.ROW_ANGLE],
            velocity=self.rows[:, columns.ROW_VELOCITY],
            ended_by=self.rows[:, columns.ROW_EVENT].astype(np.int64),
        )

    @cached_property
    def end_time_pt(self) -> float:
        """Pivot time up to which the trajectory reaches.

        For a block that overturns it is when it passes twice its slenderness (or, if its last
        flight began further out, one slenderness more than that); where the proof came at the end
        of a segment of the base motion, it is that end.
        """
        return float(self._facts.end)

    @cached_property
    def rest_time_pt(self) -> float | None:
        """Pivot time at which the block came to rest where it stayed; None if it did not.

        The recorded bounces end when they are proved to die out and rise below 1e-16 of alpha, or
        at the limit of flights.  Those still to come last ``2 v (1/(1 - a) + r/(1 + a))/(1 -
        r^2)``, with the velocity v after the last recorded impact and the base acceleration a
        towards the side of the next bounce; what this leaves out is of the order of v times that on
        a moving base, of v^2 times that on a still one.  For a block whose sides differ 1 - a is
        the pull of that side, ``rho^2 (lambda - a)``, and r^2 the product of both.  In the
        nonlinear model lambda is times ``sin(alpha)/alpha`` and the weight of the block in the
        vertical motion, a times ``cos(alpha)``.  Against a wall all bounces are to one side, and
        those still to come last ``2 v/((1 - a) (1 - r))``.
        """
        return float(self._facts.rested) if self.status is Status.AT_REST else None

    @cached_property
    def overturn_time_pt(self) -> float | None:
        """Pivot time at which the block passes |theta| = alpha for the last time, if it overturns.

        The alpha is that of the side to which it falls.  A block that is tilted further from its
        start on overturns at time 0.
        """
        return float(self._facts.overturned) if self.status is Status.OVERTURNED else None

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

    @property
    def peak(self) -> float:
        """Largest |theta|/alpha, exact, up to the end or to `overturn_time_pt`.

        Each side counts in its own alpha, so that 1 is where the block balances.
        """
        return max(self.side_peaks)

    @cached_property
    def side_peaks(self) -> tuple[float, float]:
        """Largest |theta|/alpha on the positive and on the negative side, each in its own alpha.

        As for `peak`; 0 of a side to which the block does not go.
        """
        positive, negative, _ = self._facts.peaks
        return positive, negative

    @property
    def peak_velocity(self) -> float:
        """Largest |d(theta/alpha)/d(p t)|, exact, up to where `peak` counts.

        In the positive side's alpha and p on either side.  Times alpha it is the angular velocity
        over p [rad].
        """
        return self._facts.peaks[2]

    @property
    def balances(self) -> tuple[float, float]:
        """Where the block balances on the negative and on the positive side, in u = theta/alpha.

        -1 and 1 of a symmetric block, 0 and 1 of one against a wall, on which it rests.
        """
        if self.block.one_sided:
            return 0.0, 1.0
        positive, negative = self.sides[:, columns.LEAN].tolist()
        return -negative, positive

    @property
    def balanced(self) -> bool:
        """Whether it ends still and tilted, its mass centre above an edge: any disturbance decides.

        It neither falls nor comes back, and its status stays "rocking".
        """
        if self.status is not Status.ROCKING:
            return False
        end = self(self.end_time_pt)
        return abs(float(end.velocity)) < STILL and float(end.angle) in self.balances

    @property
    def uplifts(self) -> tuple[float, float]:
        """Base accelerations that lift the block to the negative and to the positive side.

        In units of alpha g.  In the linear model they are the `balances`; in the nonlinear one
        those times ``tan(alpha)/alpha`` of the side, as long as the base does not move vertically.
        No acceleration lifts a block to the side of a wall: there it is minus infinity.
        """
        negative, positive = self.balances
        if self.block.one_sided:
            negative = -math.inf
        if not is_nonlinear(self._tables.sides):
            return negative, positive
        first, second = self.sides[:, columns.ALPHA].tolist()
        return negative * (tan(second) / second), positive * (tan(first) / first)

    @cached_property
    def impacts(self) -> Impacts:
        """Impacts that leave with 1e-6 or more in du/d(pt), in the side's alpha and p."""
        velocity = self._landings.velocity_after
        side = self.sides[np.where(velocity > 0.0, 0, 1)]
        units = side[:, columns.LEAN] * side[:, columns.RATE]
        kept = np.abs(velocity) >= columns.COUNTED * units
        return Impacts(**{name: part[kept] for name, part in vars(self._landings).items()})

    @property
    def impact_count(self) -> int:
        """Number of impacts that leave with 1e-6 or more in du/d(pt), as batches count them."""
        return len(self.impacts) + self.impacts_left_out

    @cached_property
    def _landings(self) -> Impacts:
        """All impacts, however slow."""
        landings = np.empty((LANDING_ROWS, len(self.rows)))
        count = fill_landings(self._tables, self._rows, self._timed[0], landings)
        pt, half_cycles, phase, side, before, after = landings[:, :count]
        return Impacts(
            pt=pt,
            half_cycles=half_cycles.astype(np.int64),
            phase=phase,
            side=side.astype(np.int64),
            velocity_before=before,
            velocity_after=after,
        )

    @cached_property
    def growth(self) -> float:
        """Largest factor by which a small difference at the start has grown on the way.

        Exact derivatives through flights and impacts, looked at after each impact and counted again
        after a rest, which forgets what came before; infinite after a graze.  Above some 1e12
        rounding decides how the run goes on, and another way of computing it may end otherwise.
        """
        durations = self.rows[:, columns.ROW_DURATION].copy()
        durations[-1] = self._facts.last
        course = Course(self._rows, *self._tables, durations, self.flights.pt)
        return growth_of(course, self._landings)

    @cached_property
    def shown_to_pt(self) -> float:
        """Pivot time up to which pictures follow the run: a little into a rest, not for ever.

        A base that still moves when the block has come to rest is followed to its end.
        """
        if not isinstance(self.motion, PeriodicMotion):
            if self.rest_time_pt is not None:
                moving = float(base_motion.segment_starts(self.segments)[-1])
                return min(self.end_time_pt, max(1.05 * self.rest_time_pt, moving) + 0.1)
            if self.status is Status.ROCKING:  # without loss, or balanced for ever
                return min(self.end_time_pt, float(self.flights.pt[-1]) + 10.0)
        return self.end_time_pt

    def times(self, per_unit: int = 100, *, span: tuple[float, float] | None = None) -> Floats:
        """Return pivot times that draw the motion well: evenly spaced, and every impact.

        Parameters
        ----------
        per_unit
            Samples per unit of time: per forcing period of harmonic shaking, else per p t = 1, and
            per period of a pulse while it lasts.
        span
            Pivot times between which they lie; default: from 0 to `shown_to_pt`.

        Raises
        ------
        InputError
            If `per_unit` is not a whole number from 1 to a million, or more than 1e8 times follow.
        """
        hint = "give samples per unit of time"
        count = whole_number("per_unit", per_unit, at_least=1, at_most=1_000_000, hint=hint)
        unit = 1.0
        if isinstance(self.motion, PeriodicMotion):
            unit = 2.0 * math.pi / self.motion.frequency_ratio
        start, end = (0.0, self.shown_to_pt) if span is None else self._span(span)
        wanted = count * ((end - start) / unit + base_motion.pulse_turns(self.segments))
        within_memory("per_unit", per_unit, wanted, hint="take fewer, or a shorter span")
        even = np.linspace(start, end, max(2, math.ceil(count * (end - start) / unit) + 1))
        points = np.concatenate(
            [even, self.flights.pt, *base_motion.pulse_times(self.segments, count)]
        )
        return np.unique(points[(points >= start) & (points <= end)])

    def _span(self, span: tuple[float, float]) -> tuple[float, float]:
        """Return pivot times of the run, the first before the second."""
        return span_value("span", span, 0.0, self.end_time_pt, hint="give pivot times of the run")

    def _times(self, pt: ArrayLike) -> Floats:
        """Return finite times, 0 or above."""
        times = real_array("pt", pt)
        if not ((times >= 0.0) & (times <= LARGEST)).all():
            raise InputError("pt", pt, f"it must lie in [0, {LARGEST:g}]", "give pivot times p t")
        return times

    def __call__(self, pt: ArrayLike) -> Samples:
        """Return the motion at pivot times `pt`, from 0 to `end_time_pt`.

        Raises
        ------
        InputError
            If a time is outside the trajectory.
        """
        times = real_array("pt", pt)
        flat = np.atleast_1d(times).ravel()
        outside = ~((flat >= 0.0) & (flat <= self.end_time_pt * (1.0 + 1e-15)))
        if outside.any():
            raise InputError(
                "pt",
                flat[outside][0].item(),
                f"the trajectory reaches from 0 to {self.end_time_pt:.10g}",
                "ask within it, or simulate more cycles",
            )
        index = np.searchsorted(self.flights.pt, flat, side="right") - 1
        since = np.maximum(flat - self.flights.pt[index], 0.0)
        states = np.empty((3, len(flat)))
        fill_states(*self._tables, self._rows, index, since, states)
        angle, velocity, acceleration = states.reshape(3, *times.shape)
        harmonic = isinstance(self.motion, PeriodicMotion)
        return Samples(
            pt=times,
            tau=times * self.frequency_ratio if harmonic else None,
            t_s=times / self.block.p if isinstance(self.block, Block) else None,
            angle=angle,
            velocity=velocity,
            acceleration=acceleration,
            base_acceleration=self.base_acceleration(times),
            energy=self._energy(angle, velocity),
        )

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

    def _energy(self, angle: Floats, velocity: Floats) -> Floats:
        """Return kinetic and potential energy above rest."""
        rows = self.sides[np.where(angle < 0.0, 1, 0)]
        lean, square = rows[..., columns.LEAN], np.square(rows[..., columns.RATE])
        if is_nonlinear(self._tables.sides):
            alpha, tilt = rows[..., columns.ALPHA], np.abs(angle) / lean
            # cos x - cos y as a product, which keeps the digits of small angles.
            raised = sin(alpha * (1.0 - 0.5 * tilt)) * sin(0.5 * alpha * tilt)
            potential = 2.0 * square * np.square(lean) * raised / np.square(alpha)
        else:
            potential = square * lean * np.abs(angle) - 0.5 * square * np.square(angle)
        return np.asarray(0.5 * np.square(velocity) + potential)

    def phase_path(self, per_unit: int = 100) -> tuple[Floats, Floats]:
        """Return angle and velocity in the order of time, both states of each impact included.

        Parameters
        ----------
        per_unit
            As for `times`.
        """
        motion, impacts = self(self.times(per_unit)), self._landings
        kept = impacts.pt <= motion.pt[-1]
        before = np.searchsorted(motion.pt, impacts.pt[kept], side="left")
        angle = np.insert(motion.angle, before, 0.0)
        velocity = np.insert(motion.velocity, before, impacts.velocity_before[kept])
        return angle, velocity

    def base_acceleration(self, pt: ArrayLike) -> Floats:
        """Return the base acceleration at pivot times, in units of alpha g."""
        return base_motion.base_acceleration(self.segments, self._times(pt))

    def base_displacement(self, pt: ArrayLike) -> Floats:
        """Return where the base is at pivot times, in units of alpha g/p^2.

        Harmonic shaking goes to and fro about 0; any other motion starts from rest at 0.
        """
        swings = isinstance(self.motion, PeriodicMotion)
        integrals = base_motion.swinging_course if swings else base_motion.course_from_rest
        return integrals(self.segments, self._times(pt))[1]

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

    def to_columns(self, samples: int = 100) -> dict[str, Floats]:
        """Return the time history as columns of equal length, with the units in their names.

        The motion just after each impact is among the rows.

        Parameters
        ----------
        samples
            Rows per unit of time, as `per_unit` of `times`.
        """
        motion = self(self.times(samples))
        table = {"pt": motion.pt}
        if motion.tau is not None:
            table["tau"] = motion.tau
        table |= {
            "angle_per_alpha": motion.angle,
            "velocity_per_pt": motion.velocity,
            "acceleration_per_pt2": motion.acceleration,
            "base_acceleration_per_alpha_g": motion.base_acceleration,
            "energy": motion.energy,
        }
        if self.vertical is not None:
            table["vertical_acceleration_per_g"] = base_motion.lift(self.segments, motion.pt)
        return in_units(table, self.block)

    def to_dataset(self, samples: int = 100) -> "xarray.Dataset":
        """Return the time history as a Dataset: the columns of `to_columns` over pt."""
        dataset: xarray.Dataset = words_module(Trajectory).trajectory_dataset(self, samples)
        return dataset

    def describe(
        self, *, mass_kg: float | None = None, friction: float | None = None
    ) -> Description:
        """Return how it ended, its peaks, times and inputs.

        Parameters
        ----------
        mass_kg
            Mass of the block [kg], for the force on its base; default none.
        friction
            Coefficient of friction between block and base, with which a run that needs more is one
            that slides; None (default) where it is not known.

        Raises
        ------
        ModelError
            If there is a friction, and the block has no size or the base impulses.
        """
        words = words_module(Trajectory)
        description: Description = words.describe_trajectory(self, mass_kg, friction)
        return description
