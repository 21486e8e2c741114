"""Branches and their points: the type of each point, and the orbit there."""

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.chains.chain import Chain
from rocksteady.dynamics.continuation.chains.point_types import (
    BIFURCATIONS,
    GRAZES,
    MARGINAL,
    REASONS,
    PointType,
)
from rocksteady.dynamics.history.start import ImpactState
from rocksteady.dynamics.orbits.orbit import Orbit, modulus, orbit_from
from rocksteady.dynamics.orbits.return_map import make_system, state_of
from rocksteady.dynamics.steady.verdicts import NO_MULTIPLIERS
from rocksteady.errors import ModelError
from rocksteady.kernels.orbits import periodic
from rocksteady.kernels.orbits.systems import for_system
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.equations import Model
from rocksteady.model.units import framed
from rocksteady.results.result import Result, words_module

if TYPE_CHECKING:
    import pandas as pd
    import xarray


CLOSING = 1e-6
"""Residual up to which the flights of an orbit count as staying on it."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class BranchPoint(Result):
    """A periodic orbit on a branch.

    Attributes
    ----------
    type
        Type of the point.
    amplitude, frequency_ratio, restitution
        Where it is.
    arclength
        From the start of the branch, in units of the parameter's range and of pi of phase.
    chain
        The impacts of the orbit, from which it can be followed on.
    """

    type: PointType
    arclength: float
    chain: Chain = field(repr=False)

    @property
    def amplitude(self) -> float:
        """A = a_max/(alpha g)."""
        return float(self.chain.parameters[0])

    @property
    def frequency_ratio(self) -> float:
        """Omega = omega/p."""
        return float(self.chain.parameters[1])

    @property
    def restitution(self) -> float:
        """Ratio of the angular velocities after and before an impact."""
        return float(self.chain.parameters[2])

    @property
    def block(self) -> Block | DimensionlessBlock:
        """The block, with the restitution there."""
        return self.chain.body

    @property
    def model(self) -> Model:
        """Which equations of motion hold: `Linear` or `Nonlinear`."""
        return self.chain.model

    @property
    def reason(self) -> str:
        """Why a branch or a curve that ends at this point ends; empty where its type is no end."""
        return REASONS.get(self.type, "")

    @property
    def period(self) -> int:
        """Forcing periods of the whole orbit."""
        return self.chain.period

    @property
    def impacts(self) -> int:
        """Impacts in a period of the orbit."""
        return self.chain.impacts * (2 if self.chain.symmetric else 1)

    @property
    def symmetric(self) -> bool:
        """Whether half of it is the mirror image of the other half."""
        return self.chain.symmetric

    @property
    def kind(self) -> str:
        """Symmetry in a word: "symmetric" or "unsymmetric"."""
        return "symmetric" if self.symmetric else "unsymmetric"

    @cached_property
    def multipliers(self) -> NDArray[np.complex128]:
        """Floquet multipliers of the whole orbit, shape (2,), the larger in modulus first.

        Their product is that of the squares of the restitutions of all impacts: a pair never leaves
        the unit circle together, and there is no Neimark-Sacker bifurcation.  nan at a graze: no
        derivative exists there.
        """
        return NO_MULTIPLIERS if self.chain.touches else self.chain.multipliers

    @cached_property
    def admissible(self) -> bool:
        """Whether it is a motion: no flight passes through the floor."""
        return self.type in GRAZES or self.chain.admissible

    @property
    def stable(self) -> bool:
        """Whether it is a motion and both multipliers lie inside the unit circle.

        Not at a bifurcation, where one of them lies on it or none exists.
        """
        marginal = self.type in MARGINAL or self.block.lossless
        return bool(self.admissible and not marginal and modulus(self.multipliers[0]) < 1.0)

    @cached_property
    def peaks(self) -> Floats:
        """Extreme u = theta/alpha of each flight of the whole orbit, with its side."""
        return self.chain.peaks

    def plot(self, *arguments: Any, **options: Any) -> Any:
        """Plot the orbit there; arguments are those of `rocksteady.plots.poincare_section`.

        Raises
        ------
        ModelError
            As `orbit`.
        """
        return self.orbit.plot(*arguments, **options)

    @property
    def start(self) -> ImpactState:
        """The first state of its orbit, at which `rocksteady.simulate` sets off."""
        return state_of(self.chain.sections[0])

    @cached_property
    def orbit(self) -> Orbit:
        """The orbit there.

        Its residual is nan where its flights are so long that none stays on it.

        Raises
        ------
        ModelError
            If the solution passes through the floor, or grazes it.
        """
        block, model = self.block, self.model
        motion = self.chain.motion
        system, sections = make_system(block, motion, model), self.chain.sections
        table = np.zeros((len(sections), periodic.ORBIT_COLUMNS))
        for row, section in enumerate(sections):
            periodic.put(table, row, section)
        residual = math.inf
        if self.chain.admissible:
            measured = for_system(periodic.measured, system)
            residual = measured(system, len(sections), self.period, table).residual
        if residual < CLOSING:
            orbit = orbit_from(block, motion, table, self.period, residual, model)
            return replace(orbit, multipliers=self.multipliers) if self.chain.touches else orbit
        if not self.chain.admissible or self.type in GRAZES:
            raise ModelError(
                "point",
                self.type.value,
                "its solution passes through the floor or grazes it and is no motion",
                "choose a point beside it"
                if self.chain.admissible
                else "choose a point that is admissible",
            )
        states = tuple(state_of(section) for section in sections)
        return Orbit(
            block=block,
            motion=replace(motion, phase=states[0].phase),
            period=self.period,
            states=states,
            rest_phases=0,
            symmetric=self.symmetric,
            highest=float(self.peaks.max()),
            lowest=float(self.peaks.min()),
            multipliers=self.multipliers,
            residual=math.nan,
            model=model,
        )


def extremes(point: BranchPoint, lean: float) -> list[float]:
    """Return the highest and the lowest u of an orbit, or of its mirror image for a lean of -1."""
    peaks = lean * point.peaks
    return [float(peaks.max()), float(peaks.min())]


@checked_result
@dataclass(frozen=True, kw_only=True)
class Stretch:
    """Consecutive points of a branch with unchanged stability and admissibility.

    Attributes
    ----------
    first, last
        Their indices, both included; the last of one stretch is the first of the next.
    stable
        Whether the motions between them are stable.
    admissible
        Whether the solutions between them are motions.
    """

    first: int
    last: int
    stable: bool
    admissible: bool


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Branch(Result):
    """A periodic orbit followed over a parameter.

    Attributes
    ----------
    parameter
        Parameter over which it was followed.
    points
        In order of arclength; the special ones stand among the regular ones.
    """

    parameter: str
    points: tuple[BranchPoint, ...]

    @property
    def block(self) -> Block | DimensionlessBlock:
        """The block, with the restitution of the first point."""
        return self.points[0].block

    @property
    def model(self) -> Model:
        """Which equations of motion hold: `Linear` or `Nonlinear`."""
        return self.points[0].model

    @cached_property
    def values(self) -> Floats:
        """The parameter at each point, shape (points,)."""
        return np.array([getattr(point, self.parameter) for point in self.points])

    @cached_property
    def stable(self) -> NDArray[np.bool_]:
        """Which points are stable, shape (points,)."""
        return np.array([point.stable for point in self.points], dtype=np.bool_)

    @cached_property
    def admissible(self) -> NDArray[np.bool_]:
        """Which points are motions, shape (points,)."""
        return np.array([point.admissible for point in self.points], dtype=np.bool_)

    @cached_property
    def peaks(self) -> Floats:
        """Extreme u = theta/alpha of each flight with its side, shape (points, flights).

        At the end of a branch of doubled orbits the orbit that is doubled stands, twice over.
        """
        most = max(point.impacts for point in self.points)
        return np.array([np.tile(point.peaks, most // point.impacts) for point in self.points])

    @property
    def bifurcations(self) -> tuple[BranchPoint, ...]:
        """Folds, symmetry breakings, period doublings and grazes on it."""
        return tuple(point for point in self.points if point.type in BIFURCATIONS)

    @property
    def period(self) -> int:
        """Forcing periods of its orbits."""
        return max(point.period for point in self.points)

    @property
    def symmetric(self) -> bool:
        """Whether its orbits are symmetric."""
        return all(point.symmetric for point in self.points)

    @property
    def impacts(self) -> int:
        """Impacts in a period of its orbits."""
        return max(point.impacts for point in self.points)

    @cached_property
    def lean(self) -> float:
        """Return 1, or -1 where the branch leans to the negative side.

        `rocksteady.find_orbits` lists the orbits that lean to the positive side: the mirror images.
        For a block whose sides differ, and under even orders, there are none, and it is 1.
        """
        if not self.points[0].chain.alike:
            return 1.0
        return 1.0 if np.nanmax(self.peaks) >= -np.nanmin(self.peaks) else -1.0

    def rows(self) -> list[dict[str, Any]]:
        """Return one row per point."""
        rows: list[dict[str, Any]] = words_module(Branch).branch_rows(self)
        return rows

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per point."""
        return framed(self.rows(), self.block)

    def to_dataset(self) -> "xarray.Dataset":
        """Return the points as an xarray Dataset with dimensions point and flight.

        Returns
        -------
        xarray.Dataset
            The columns of `to_dataframe` over point, in order of arclength: the three parameters as
            coordinates, ``type`` with flags, multipliers by their parts.  ``peaks`` over point and
            flight: extreme theta/alpha, nan for a missing flight.

        Examples
        --------
        >>> from rocksteady import DimensionlessBlock, Harmonic, find_orbits
        >>> from rocksteady.branches import find_branches
        >>> motion = Harmonic(amplitude=2.0, frequency_ratio=2.2)
        >>> starts = find_orbits(DimensionlessBlock(restitution=0.8), motion, max_period=1)
        >>> branch = find_branches(starts[:1], "amplitude", (1.8, 2.2), max_period=1)[0]
        >>> data = branch.to_dataset()
        >>> print(data.peaks.dims, data.amplitude.values[[0, -1]], data.stable.values.all())
        ('point', 'flight') [1.8 2.2] True
        """
        dataset: xarray.Dataset = words_module(Branch).branch_dataset(self)
        return dataset

    @cached_property
    def stretches(self) -> tuple[Stretch, ...]:
        """Stretches of unchanged stability, in order; none of a branch of one point.

        Between two bifurcations without a point between them the stretch is what the one before is
        not: of two multipliers whose product is below 1, one passes the unit circle at a time.
        """
        kinds: list[tuple[bool, bool]] = []
        for index in range(len(self.points) - 1):
            inside = [end for end in (index + 1, index) if self._decided(end)]
            if inside:
                stable = bool(self.stable[inside[0]])
            else:
                before = kinds[-1][0] if kinds else False
                stable = not before if self.points[index].type in MARGINAL else before
            whole = bool(self.admissible[index] and self.admissible[index + 1])
            kinds.append((stable and whole, whole))
        stretches, first = [], 0
        for (stable, whole), same in groupby(kinds):
            last = first + len(list(same))
            stretches.append(Stretch(first=first, last=last, stable=stable, admissible=whole))
            first = last
        return tuple(stretches)

    def _decided(self, index: int) -> bool:
        """Return whether the multipliers of a point determine what is stable beside it.

        Not where one lies on the unit circle, nor at a graze, next to which they grow without
        bound.
        """
        point = self.points[index]
        lossless = self.parameter == "restitution" and point.block.lossless
        undecided = (*BIFURCATIONS, PointType.LOST, PointType.STALLED)
        return point.type not in undecided and not lossless
