"""Bifurcation curves of a plane of two parameters, and the points of codimension two on them."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.dynamics.continuation.points import BranchPoint
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import Whole
from rocksteady.model.checks.validation import odd_order, whole_number
from rocksteady.model.equations import Linear, Model
from rocksteady.model.motions.segments import Harmonic
from rocksteady.model.units import framed
from rocksteady.results.result import Result, words_module

if TYPE_CHECKING:
    import pandas as pd


MOST = 1000
"""Limits of periods, impacts, curves and points, as for branches."""
UP_TO_MOST = Whole(1, MOST, "give a whole number")


def _orders(name: str, value: Iterable[object]) -> tuple[int, ...]:
    """Return orders of symmetric motions, each once."""
    orders = tuple(dict.fromkeys(odd_order("order", order) for order in value))
    whole_number(name, len(orders), at_least=1, at_most=50, hint="give one order or more")
    return orders


def _lines(name: str, value: tuple[int, int]) -> tuple[int, int]:
    """Return numbers of lines of which one is not 0."""
    first, second = value
    whole_number(name, first, at_least=0, at_most=MOST, hint="give a whole number")
    least = 0 if first else 1
    whole_number(name, second, at_least=least, at_most=MOST, hint="give a whole number")
    return value


@checked
@dataclass(frozen=True, kw_only=True)
class CurveOptions:
    """Which bifurcation curves of a plane are looked for.

    Parameters
    ----------
    orders
        n = 1, 3, 5, ... of the symmetric motions from which all begin; default (1,).  For a block
        whose sides differ: forcing periods of the motions with two impacts.
    lines
        Numbers of lines across the plane on which bifurcations are looked for, at values of the
        first parameter and of the second; default (3, 3).
    max_period, max_impacts
        Longest motions whose bifurcations are followed [forcing periods, impacts]; by default twice
        the largest order, and 6.
    max_branches
        Largest number of branches of each line and order; default 20.
    max_curves
        Largest number of curves (default 40).
    everywhere
        Whether to start also from all motions that `find_orbits` finds at both ends and in the
        middle of each line; they may be many.
    most_points
        Largest number of points of each curve, in either direction; default 400.

    Raises
    ------
    InputError
        If a number is outside its range.
    """

    orders: Annotated[tuple[int, ...], _orders] = (1,)
    lines: Annotated[tuple[int, int], _lines] = (3, 3)
    max_period: Annotated[int | None, UP_TO_MOST] = None
    max_impacts: Annotated[int, UP_TO_MOST] = 6
    max_branches: Annotated[int, Whole(1, 10 * MOST, "give a whole number")] = 20
    max_curves: Annotated[int, UP_TO_MOST] = 40
    everywhere: bool = False
    most_points: Annotated[int, Whole(1, 100 * MOST, "give a whole number")] = 400

    @property
    def longest(self) -> int:
        """Longest motions that are followed [forcing periods]: `max_period`, or its default."""
        longest = min(2 * max(self.orders), MOST)
        return longest if self.max_period is None else self.max_period


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class BifurcationCurve(Result):
    """A bifurcation followed in the plane of two parameters.

    Attributes
    ----------
    type
        Fold, symmetry breaking, period doubling or graze.
    parameters
        Names of the two parameters.
    points
        In order; those of codimension two stand among the others, with their own type.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic, find_bifurcation_curves
    >>> block = DimensionlessBlock(restitution=0.87)
    >>> motion = Harmonic(amplitude=3.0, frequency_ratio=4.2)
    >>> few = CurveOptions(orders=(3,), lines=(1, 1), max_impacts=2, max_period=3)
    >>> found = find_bifurcation_curves(block, motion, within=((4.4, 5.4), (2.5, 3.0)), search=few)
    >>> print(found.curves[0].type, found.curves[0].parameters)
    symmetry-breaking ('frequency_ratio', 'amplitude')
    """

    type: PointType
    parameters: tuple[str, str]
    points: tuple[BranchPoint, ...] = field(repr=False)

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
        """Both parameters at each point, shape (points, 2)."""
        return np.array(
            [[getattr(point, name) for name in self.parameters] for point in self.points]
        )

    @property
    def _inner(self) -> BranchPoint:
        """A point that is neither an end nor of codimension two, where there is one."""
        points = [point for point in self.points if point.type is self.type]
        return points[len(points) // 2] if points else self.points[0]

    @property
    def period(self) -> int:
        """Forcing periods of its motions."""
        return self._inner.period

    @property
    def impacts(self) -> int:
        """Impacts in a period of its motions."""
        return self._inner.impacts

    @property
    def symmetric(self) -> bool:
        """Whether its motions are symmetric."""
        return self._inner.symmetric

    @property
    def kind(self) -> str:
        """Symmetry in a word: "symmetric" or "unsymmetric"."""
        return self._inner.kind

    @cached_property
    def stable(self) -> NDArray[np.bool_]:
        """At which points it borders stable motions, shape (points,).

        A fold, a symmetry breaking and a period doubling do all along where an impact has a
        restitution below 1: the other multiplier has the size of the product of the squares of all
        restitutions.  A graze does where its motions are stable on the side without the touch.
        """
        if self.type is not PointType.GRAZING:
            return np.array([not point.block.lossless for point in self.points], dtype=np.bool_)
        return np.array([bool(abs(point.chain.multipliers[0]) < 1.0) for point in self.points])

    def rows(self) -> list[dict[str, Any]]:
        """Return one row per point."""
        rows: list[dict[str, Any]] = words_module(BifurcationCurve).curve_rows(self)
        return rows

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per point."""
        return framed(self.rows(), self.block)


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False)
class CodimensionTwoPoint:
    """A point of codimension two, and the curves that meet there.

    Attributes
    ----------
    point
        Its type, its place and the motion there.
    curves
        Numbers of the curves, from 1.
    """

    point: BranchPoint
    curves: tuple[int, ...]


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False)
class Region:
    """A place of the plane, and which of the motions followed are stable there.

    Attributes
    ----------
    place
        Values of the two parameters.
    motions
        "symmetric", "unsymmetric", "unsymmetric, period 2", "rest", ...
    extent
        Part of the line across the plane on which they are the same: (axis, low, high), the axis 0
        or 1.
    """

    place: tuple[float, float]
    motions: tuple[str, ...]
    extent: tuple[int, float, float]


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class BifurcationCurves(Result):
    """The bifurcation curves of a plane of two parameters, with what is found on them.

    Attributes
    ----------
    block, motion
        Block and base motion; their own values of the two parameters do not count.
    parameters, within
        The two parameters, and the range of each.
    search
        Which curves were looked for.
    curves
        In the order in which they were found, those of short motions first.
    points
        Every point of codimension two once, with the curves that meet there.
    regions
        Places at which it is known which of the motions followed are stable.
    complete
        Whether all were followed: False where `max_curves` or `max_branches` ended the work.
    model
        Which equations of motion hold: `Linear` or `Nonlinear`.
    """

    block: Block | DimensionlessBlock
    motion: Harmonic
    parameters: tuple[str, str]
    within: tuple[tuple[float, float], tuple[float, float]]
    search: CurveOptions
    curves: tuple[BifurcationCurve, ...]
    points: tuple[CodimensionTwoPoint, ...]
    regions: tuple[Region, ...]
    complete: bool
    model: Model = field(default_factory=Linear)

    def rows(self) -> Iterator[dict[str, Any]]:
        """Yield one row per point of each curve."""
        for place, curve in enumerate(self.curves, start=1):
            yield from words_module(BifurcationCurves).curve_rows(curve, place)

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per point of each curve."""
        return framed(self.rows(), self.block, "curve")
