"""Orbits with rest on a branch, and the branch that they make over a parameter."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.resting._legs import Leg, Uplifts
from rocksteady.dynamics.continuation.resting.resting_types import RestingPointType
from rocksteady.dynamics.history.start import ImpactState
from rocksteady.dynamics.orbits.orbit import Orbit, orbit_from
from rocksteady.dynamics.orbits.return_map import make_system, state_of
from rocksteady.errors import InputError
from rocksteady.kernels.orbits import periodic
from rocksteady.kernels.orbits.bounces import chatter_end
from rocksteady.kernels.orbits.return_map import highest_after, phase_between
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.checks.validation import finite
from rocksteady.model.equations import Model
from rocksteady.model.motions.segments import Harmonic
from rocksteady.model.units import framed
from rocksteady.results.result import Result, words_module

if TYPE_CHECKING:
    import pandas as pd


EVENTS = (RestingPointType.GRAZING, RestingPointType.UPLIFT, RestingPointType.REST_END)


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False)
class Excursion:
    """Motion from an uplift through its impacts to the rest and on to the next uplift.

    Attributes
    ----------
    side
        Side to which the block lifts.
    uplift_phase
        Phase of the shaking at the uplift, in [0, 2 pi).
    impacts
        States after the impacts, until it is proved that the bounces die out.
    impact_phases
        Phase that has passed from the uplift to each of them [rad], shape (impacts,).
    peaks
        Extreme u = theta/alpha of each flight with its side, shape (flights,): from the uplift on,
        one after each impact, and the bounce to the other side that follows.
    chatter_end
        Phase that has passed when the bounces have died out [rad].
    chatter_error
        Estimate of its error [rad].
    half_cycles
        Half periods of the shaking from this uplift to the next.
    rest
        Phase for which the block rests before the next uplift [rad].
    """

    side: int
    uplift_phase: float
    impacts: tuple[ImpactState, ...]
    impact_phases: Floats
    peaks: Floats
    chatter_end: float
    chatter_error: float
    half_cycles: int
    rest: float


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class RestingPoint(Result):
    """Orbit with rest on a branch.

    Attributes
    ----------
    type
        Type of the point.
    block, motion, model
        Block, base motion and equations at this point.
    gains
        At a graze 1 where two impacts are added as the parameter grows, -1 where they vanish; 0
        elsewhere.
    touch
        At a graze the numbers of the excursion and of the impact that touches, from 0.
    """

    type: RestingPointType
    block: Block | DimensionlessBlock
    motion: Harmonic
    model: Model
    gains: int = 0
    touch: tuple[int, int] | None = None
    legs: tuple[Leg, ...] = field(repr=False)

    @property
    def amplitude(self) -> float:
        """A = a_max/(alpha g)."""
        return self.motion.amplitude

    @property
    def frequency_ratio(self) -> float:
        """Omega = omega/p."""
        return self.motion.frequency_ratio

    @property
    def restitution(self) -> float:
        """Ratio of the angular velocities after and before an impact."""
        return self.block.dimensionless().restitution

    @property
    def period(self) -> int:
        """Forcing periods of the orbit."""
        return sum(leg.half_cycles for leg in self.legs) // 2

    @property
    def symmetric(self) -> bool:
        """Whether half of it is the mirror image of the other half."""
        return self.block.symmetric and not self.block.one_sided and len(self.legs) == 2

    @property
    def kind(self) -> str:
        """Symmetry in a word: "symmetric" or "unsymmetric"."""
        return "symmetric" if self.symmetric else "unsymmetric"

    @property
    def rest_phases(self) -> int:
        """Number of rests in a period of the orbit."""
        return len(self.legs)

    @property
    def multipliers(self) -> NDArray[np.complex128]:
        """Floquet multipliers, shape (2,): both are 0, since a rest forgets what came before."""
        return np.zeros(2, dtype=np.complex128)

    @property
    def stable(self) -> bool:
        """True: an orbit with rest attracts all that is near it."""
        return True

    @cached_property
    def peaks(self) -> Floats:
        """Extreme u = theta/alpha of each flight of a period, with its side."""
        return np.concatenate([_peaks_of(self, leg) for leg in self.legs])

    @property
    def highest(self) -> float:
        """Largest u = theta/alpha."""
        return max(0.0, float(self.peaks.max()))

    @property
    def lowest(self) -> float:
        """Smallest u = theta/alpha."""
        return min(0.0, float(self.peaks.min()))

    @cached_property
    def excursions(self) -> tuple[Excursion, ...]:
        """What happens from each uplift to the next, in order."""
        first = _excursion(self, self.legs[0])
        if self.symmetric:
            return first, _mirrored(first)
        return first, *(_excursion(self, leg) for leg in self.legs[1:])

    @property
    def rests(self) -> Floats:
        """Phase for which the block rests after each excursion [rad], shape (rest_phases,)."""
        return np.array([each.rest for each in self.excursions])

    @property
    def start(self) -> ImpactState:
        """The first uplift of its orbit, at which `rocksteady.simulate` sets off."""
        return state_of(self.legs[0].states[0])

    @cached_property
    def orbit(self) -> Orbit:
        """The orbit, as from `rocksteady.find_orbits`."""
        system = make_system(self.block, self.motion, self.model)
        passages = sum(len(leg.states) for leg in self.legs)
        table = np.zeros((passages, periodic.ORBIT_COLUMNS))
        begin = self.legs[0].states[0]
        orbit = periodic.polish(system, begin, passages, self.period, table)
        return orbit_from(self.block, self.motion, table, self.period, orbit.residual, self.model)

    def plot(self, *arguments: Any, **options: Any) -> Any:
        """Plot the orbit there; arguments are those of `rocksteady.plots.poincare_section`."""
        return self.orbit.plot(*arguments, **options)


def _peaks_of(point: RestingPoint, leg: Leg) -> Floats:
    """Return the extremes of the flights from an uplift on."""
    system = make_system(point.block, point.motion, point.model)
    peaks: list[float] = []
    for state, step in zip(leg.states, leg.steps, strict=True):
        near, far = highest_after(system, state, step)
        peaks += [state.side * near, *([-state.side * far] if far > 0.0 else [])]
    return np.array(peaks)


def _excursion(point: RestingPoint, leg: Leg) -> Excursion:
    """Return an excursion in the words of users."""
    system = make_system(point.block, point.motion, point.model)
    begin = leg.states[0]
    end, lost, bounces = chatter_end(system, begin, leg.states[-1])
    error = lost + 8.0 * bounces * math.ulp(max(end, 1.0))
    assert leg.following is not None
    until = phase_between(begin, leg.following)
    return Excursion(
        side=leg.side,
        uplift_phase=state_of(begin).phase,
        impacts=tuple(state_of(state) for state in leg.states[1:]),
        impact_phases=np.array([phase_between(begin, state) for state in leg.states[1:]]),
        peaks=_peaks_of(point, leg),
        chatter_end=end,
        chatter_error=error,
        half_cycles=leg.half_cycles,
        rest=max(until - end, 0.0),
    )


def _mirrored(each: Excursion) -> Excursion:
    """Return the mirror image of an excursion, half a period later."""
    phase = each.uplift_phase
    return replace(
        each,
        side=-each.side,
        uplift_phase=phase + math.pi if phase < math.pi else phase - math.pi,
        impacts=tuple(state.mirrored for state in each.impacts),
        peaks=-each.peaks,
    )


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class RestingBranch(Result):
    """An orbit with rest over a parameter, which determines it: the branch has no folds.

    Its multipliers are 0: all of it is stable.

    Attributes
    ----------
    block, motion, model
        Block, base motion and equations; their own value of the parameter does not count.
    parameter
        Parameter over which it was followed.
    points
        With the parameter growing; the special ones stand among the regular ones.
    """

    block: Block | DimensionlessBlock
    motion: Harmonic
    model: Model
    parameter: str
    points: tuple[RestingPoint, ...]

    @cached_property
    def values(self) -> Floats:
        """The parameter at each point, shape (points,)."""
        return np.array([self.value(point) for point in self.points])

    def value(self, point: RestingPoint) -> float:
        """Return the parameter at a point."""
        return float(getattr(point, self.parameter))

    @property
    def within(self) -> tuple[float, float]:
        """The values between which the branch is."""
        return self.value(self.points[0]), self.value(self.points[-1])

    @property
    def begin(self) -> RestingPoint:
        """Its lower end, whose type is the reason why it ends there."""
        return self.points[0]

    @property
    def end(self) -> RestingPoint:
        """Its upper end, whose type is the reason why it ends there."""
        return self.points[-1]

    @property
    def events(self) -> tuple[RestingPoint, ...]:
        """Grazes on it, and ends at which the shaking just lifts the block or its rest ends."""
        return tuple(point for point in self.points if point.type in EVENTS)

    @property
    def period(self) -> int:
        """Forcing periods of its orbits."""
        return self.points[0].period

    @property
    def symmetric(self) -> bool:
        """Whether its orbits are symmetric."""
        return self.points[0].symmetric

    @property
    def kind(self) -> str:
        """Symmetry in a word: "symmetric" or "unsymmetric"."""
        return self.points[0].kind

    @property
    def rest_phases(self) -> int:
        """Number of rests in a period of its orbits."""
        return self.points[0].rest_phases

    @property
    def stable(self) -> NDArray[np.bool_]:
        """Which points are stable, shape (points,): all."""
        return np.ones(len(self.points), dtype=np.bool_)

    @cached_property
    def peaks(self) -> Floats:
        """Extreme u = theta/alpha of each flight with its side, shape (points, flights).

        At some points more bounces are followed than at others: nan fills their rows.
        """
        most = max(len(point.peaks) for point in self.points)
        rows = [np.append(p.peaks, np.full(most - len(p.peaks), math.nan)) for p in self.points]
        return np.array(rows)

    def pieces(self) -> Iterator[tuple[Floats, tuple[Floats, ...]]]:
        """Yield the parts between grazes: values, and for each excursion the extremes of flights.

        In a part every column is one flight; nan fills the rows of points with fewer of them.
        """
        first = 0
        for k, point in enumerate(self.points):
            if point.type is RestingPointType.GRAZING:
                cut = k if point.gains > 0 else k + 1
                if cut > first:
                    yield self._piece(first, cut)
                first = cut
        if first < len(self.points):
            yield self._piece(first, len(self.points))

    def _piece(self, first: int, last: int) -> tuple[Floats, tuple[Floats, ...]]:
        points = self.points[first:last]
        legs = []
        for k in range(self.rest_phases):
            rows = [_peaks_of(point, point.legs[k]) for point in points]
            most = max(map(len, rows))
            legs.append(np.array([np.append(r, np.full(most - len(r), math.nan)) for r in rows]))
        return self.values[first:last], tuple(legs)

    def at(self, value: float) -> RestingPoint:
        """Return the orbit at any value of the parameter, computed there.

        Raises
        ------
        InputError
            If the branch has no orbit at that value.
        """
        low, high = self.within
        number = finite("value", value, hint="give a value of the parameter")
        uplifts = Uplifts(self.block, self.motion, self.parameter, self.model, self.period)
        begin = self.points[0].legs
        pattern = tuple((leg.side, leg.half_cycles) for leg in begin)
        if low <= number <= high:
            sample = uplifts.sample(number, begin[0].side)
            if sample.pattern == pattern:
                block, motion = uplifts.moved(number)
                return RestingPoint(
                    type=RestingPointType.REGULAR,
                    block=block,
                    motion=motion,
                    model=self.model,
                    legs=sample.legs,
                )
        raise InputError(
            "value",
            value,
            f"the branch goes from {low:.17g} to {high:.17g}",
            "choose a value between its ends",
        )

    def rows(self) -> list[dict[str, Any]]:
        """Return one row per point, in SI too where the block has a size."""
        rows: list[dict[str, Any]] = words_module(RestingBranch).resting_rows(self)
        return rows

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per point, in SI too where the block has a size."""
        return framed(self.rows(), self.block)
