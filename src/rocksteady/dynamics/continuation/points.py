"""Branches and their points: the type of each point, and the orbit there."""

import math
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cached_property
from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.dynamics.continuation._branch_facts import (
    BARE,
    bifurcations_table,
    branch_values,
    point_row,
    point_values,
    stable_text,
)
from rocksteady.dynamics.continuation._chain import Chain
from rocksteady.dynamics.orbits.orbit import Orbit, modulus, orbit_from
from rocksteady.dynamics.orbits.return_map import make_system, state_of
from rocksteady.dynamics.parameters import SYMBOLS
from rocksteady.dynamics.steady.verdicts import multipliers_text
from rocksteady.errors import ModelError
from rocksteady.kernels.orbits import periodic
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.equations import Linear, OfLinear
from rocksteady.model.motions.segments import Harmonic
from rocksteady.results.description import Description, Fact
from rocksteady.results.numbers import number, plural
from rocksteady.results.result import Result

if TYPE_CHECKING:
    import pandas as pd

Floats = NDArray[np.float64]


class PointType(StrEnum):
    """Type of a point on a branch."""

    REGULAR = "regular"
    FOLD = "fold"
    """Two orbits of one kind meet and the branch turns back: a multiplier passes 1."""
    SYMMETRY_BREAKING = "symmetry-breaking"
    """Two orbits that lean, mirror images of each other, branch off a symmetric one: half of it
    has the multiplier -1."""
    PERIOD_DOUBLING = "period-doubling"
    """A multiplier passes -1, and an orbit of twice the period branches off."""
    GRAZING = "grazing"
    """The block touches its base between two impacts, or two impacts merge: beyond, the solution
    passes through the floor.  A branch loses its admissibility in no other way."""
    RANGE_END = "end-of-range"
    """The branch leaves the range of its parameter."""
    CLOSED = "closed"
    """The branch is back where it began."""
    LIMIT = "limit"
    """As many points were followed as were asked for."""
    LOST = "lost"
    """The branch could not be followed on."""
    STALLED = "stalled"
    """The branch could be followed on in steps only that get nowhere."""


REASONS = {
    PointType.RANGE_END: "a parameter leaves its range",
    PointType.CLOSED: "it is back where it began",
    PointType.LIMIT: "as many points were followed as were asked for",
    PointType.LOST: "no next point satisfies its equations, however near",
    PointType.STALLED: "200 steps together were shorter than the largest one: the equations are "
    "near to singular there, or rounding is as large as what they ask for",
    PointType.GRAZING: "beyond, the solution passes through the floor",
}
"""Why a branch or a curve ends at a point of a type."""


BIFURCATIONS = (
    PointType.FOLD,
    PointType.SYMMETRY_BREAKING,
    PointType.PERIOD_DOUBLING,
    PointType.GRAZING,
)
CLOSING = 1e-6
"""Residual up to which the flights of an orbit count as staying on it."""
MARGINAL = BIFURCATIONS[:3]
"""Where a multiplier lies on the unit circle, and rounding may not decide on stability."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class BranchPoint(OfLinear, Result):
    """A periodic orbit on a branch.

    Attributes
    ----------
    type
        What is special about it.
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
        """Symmetric or unsymmetric, in that word."""
        return "symmetric" if self.symmetric else "unsymmetric"

    @cached_property
    def multipliers(self) -> NDArray[np.complex128]:
        """Floquet multipliers of the whole orbit, shape (2,), the larger in modulus first.

        Their product is restitution^(2 impacts): a pair never leaves the unit circle together, and
        there is no Neimark-Sacker bifurcation.
        """
        return self.chain.multipliers

    @cached_property
    def admissible(self) -> bool:
        """Whether it is a motion: no flight passes through the floor."""
        return self.type is PointType.GRAZING or self.chain.admissible

    @property
    def stable(self) -> bool:
        """Whether it is a motion and both multipliers lie inside the unit circle.

        Not at a bifurcation, where one of them lies on it.
        """
        marginal = self.type in MARGINAL or self.restitution == 1.0
        return bool(self.admissible and not marginal and modulus(self.multipliers[0]) < 1.0)

    @cached_property
    def peaks(self) -> Floats:
        """Extreme u = theta/alpha of each flight of the whole orbit, with its side."""
        return self.chain.peaks

    def describe(self) -> Description:
        """Return where the point is, what is special about it, and its orbit."""
        values = point_values(self, 1.0, BARE)
        kind = f"{self.type.value.replace('-', ' ')} point"
        place = f"A = {self.amplitude:.8g}, Ω = {self.frequency_ratio:.8g}"
        words = {
            "amplitude": ("A", f"{self.amplitude:.8g}"),
            "frequency_ratio": ("Ω", f"{self.frequency_ratio:.8g}"),
            "restitution": ("restitution", f"{self.restitution:.8g}"),
            "period": ("period", plural(self.period, "forcing period")),
            "impacts": ("impacts", f"{self.impacts} in a period"),
            "symmetric": ("kind", self.kind),
            "peaks": ("highest, lowest", ", ".join(map(number, values["peaks"])) + " alpha"),
            "multipliers": ("multipliers", multipliers_text(values["multipliers"])),
        }
        return Description(
            f"{kind.capitalize()}: {place}, restitution {self.restitution:.8g}, linear model",
            [
                *(Fact(key, value, *words.get(key, ())) for key, value in values.items()),
                Fact("stable", self.stable, "stable"),
                Fact("admissible", self.admissible),
                Fact("arclength", self.arclength),
                Fact("model", "linear", "model"),
            ],
            notes=[self.reason] if self.reason else [],
        )

    def orbit(self) -> Orbit:
        """Return the orbit there.

        Its residual is nan where its flights are so long that none stays on it.

        Raises
        ------
        ModelError
            If the solution passes through the floor, or grazes it.
        """
        block = DimensionlessBlock(restitution=self.restitution)
        motion = Harmonic(amplitude=self.amplitude, frequency_ratio=self.frequency_ratio)
        system, sections = make_system(block, motion, Linear()), self.chain.sections
        table = np.zeros((len(sections), periodic.ORBIT_COLUMNS))
        for row, section in enumerate(sections):
            periodic.put(table, row, section)
        residual = math.inf
        if self.chain.admissible:
            residual = periodic.measured(system, len(sections), self.period, table).residual
        if residual < CLOSING:
            return orbit_from(block, motion, table, self.period, residual, Linear())
        if not self.chain.admissible or self.type is PointType.GRAZING:
            raise ModelError(
                "point",
                self.type.value,
                "its solution passes through the floor or grazes it and is no motion",
                "choose a point that is admissible",
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
        )


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
class Branch(OfLinear, Result):
    """A periodic orbit followed over a parameter.

    Attributes
    ----------
    parameter
        What it was followed in.
    points
        In order of arclength; the special ones stand among the regular ones.
    """

    parameter: str
    points: tuple[BranchPoint, ...]

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
        """
        return 1.0 if np.nanmax(self.peaks) >= -np.nanmin(self.peaks) else -1.0

    def rows(self) -> list[dict[str, Any]]:
        """Return a row a point."""
        return [point_row(1, point, self.lean, BARE) for point in self.points]

    def to_dataframe(self) -> "pd.DataFrame":
        """Return a row a point."""
        import pandas as pd

        return pd.DataFrame(self.rows())

    def describe(self) -> Description:
        """Return what the branch is, its ends, where it is stable, and its bifurcations."""
        values, symbol = branch_values(self), SYMBOLS[self.parameter]
        low, high = values["within"]
        special = [
            {"branch": 1, **point_values(point, self.lean, BARE)} for point in self.bifurcations
        ]
        kind = "Symmetric" if self.symmetric else "Unsymmetric"
        words = {
            "begin": ("from", values["begin"]["type"].replace("-", " ")),
            "end": ("to", values["end"]["type"].replace("-", " ")),
            "stable_ranges": ("stable", stable_text(values["stable_ranges"])),
            "points": ("points", str(len(self.points))),
        }
        return Description(
            f"{kind} branch, {plural(self.period, 'period')}, {plural(self.impacts, 'impact')}: "
            f"{symbol} from {low:.6g} to {high:.6g}, linear model",
            [
                Fact("parameter", self.parameter),
                *(Fact(key, value, *words.get(key, ())) for key, value in values.items()),
                Fact("model", "linear", "model"),
            ],
            [bifurcations_table(special, self.parameter, BARE, key="bifurcations")],
        )

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
        """Return whether the multipliers of a point say what is stable beside it.

        Not where one lies on the unit circle, nor at a graze, next to which they grow without
        bound.
        """
        point = self.points[index]
        lossless = self.parameter == "restitution" and point.restitution == 1.0
        undecided = (*BIFURCATIONS, PointType.LOST, PointType.STALLED)
        return point.type not in undecided and not lossless
