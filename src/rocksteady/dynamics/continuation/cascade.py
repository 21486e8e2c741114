"""Period-doubling cascade: its doublings, and the ratios of the distances between them."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.continuation.branch import follow_branch
from rocksteady.dynamics.continuation.chains.family import LARGEST_STEP
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.dynamics.continuation.from_orbit import chain_at
from rocksteady.dynamics.continuation.points import Branch, BranchPoint
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.errors import ModelError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import Whole
from rocksteady.model.equations import Model
from rocksteady.results.result import Result, words_module

if TYPE_CHECKING:
    import xarray


MOST_DOUBLINGS = 8
"""The orbit then has 256 times the impacts, and the next doublings are some 1e-7 apart."""
ENOUGH = 3
"""Doublings from which on a cascade has a ratio, and no longer one is looked for."""
SHRINKING = 0.5
"""Largest step after a doubling, in parts of that before: the next one comes sooner."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Cascade(Result):
    """Period doublings, each on the branch created by the previous one.

    Attributes
    ----------
    parameter
        Parameter over which they follow one another.
    points
        The doublings, in order.
    """

    parameter: str
    points: tuple[BranchPoint, ...]

    @property
    def block(self) -> Block | DimensionlessBlock:
        """The block, with the restitution of the first doubling."""
        return self.points[0].block

    @property
    def model(self) -> Model:
        """Which equations of motion hold: `Linear` or `Nonlinear`."""
        return self.points[0].model

    @cached_property
    def values(self) -> Floats:
        """The parameter at each doubling, shape (doublings,)."""
        return np.array([getattr(point, self.parameter) for point in self.points])

    @property
    def distances(self) -> Floats:
        """From each doubling to the next, shape (doublings - 1,)."""
        return np.diff(self.values)

    @property
    def ratios(self) -> Floats:
        """Each distance over the next, shape (doublings - 2,); they tend to Feigenbaum's 4.6692."""
        ratios: Floats = self.distances[:-1] / self.distances[1:]
        return ratios

    @property
    def limit(self) -> float:
        """Where infinitely many doublings end, if the distances go on shrinking by the last ratio.

        nan of fewer than three doublings, and where the last distance is not the smaller one.
        """
        if len(self.points) < 3 or not self.ratios[-1] > 1.0:
            return float("nan")
        return float(self.values[-1] + self.distances[-1] / (self.ratios[-1] - 1.0))

    def values_by_name(self) -> dict[str, Any]:
        """Return the doublings, their distances and ratios in plain values."""
        return {
            "values": self.values.tolist(),
            "periods": [point.period for point in self.points],
            "distances": self.distances.tolist(),
            "ratios": self.ratios.tolist() if len(self.points) > 2 else [],
            "limit": self.limit,
        }

    def to_dataset(self) -> "xarray.Dataset":
        """Return the doublings as an xarray Dataset with dimension doubling.

        Returns
        -------
        xarray.Dataset
            Period and impacts of what is doubled, ``distance`` to the next doubling and ``ratio``
            of two distances, nan where there is none; the three parameters as coordinates, the
            limit among the attributes.

        Examples
        --------
        >>> from rocksteady import DimensionlessBlock, Harmonic, find_orbits
        >>> from rocksteady.branches import find_cascade
        >>> motion = Harmonic(amplitude=2.0, frequency_ratio=2.0)
        >>> origin = find_orbits(DimensionlessBlock(restitution=0.8), motion, max_period=1)[0]
        >>> within = {"within": (1.7, 2.0), "direction": -1, "doublings": 3}
        >>> data = find_cascade(origin, "frequency_ratio", **within).to_dataset()
        >>> print(data.period.values, data.ratio.values.round(3))
        [1 2 4] [  nan 6.107   nan]
        """
        dataset: xarray.Dataset = words_module(Cascade).cascade_dataset(self)
        return dataset


@checked
def find_cascade(
    origin: Orbit | BranchPoint,
    parameter: str,
    within: tuple[float, float],
    *,
    direction: int = 1,
    doublings: Annotated[
        int, Whole(1, MOST_DOUBLINGS, "give the number of doublings to look for")
    ] = 6,
    largest_step: float = LARGEST_STEP,
) -> Cascade:
    """Locate successive period doublings, each on the branch created by the previous one.

    Parameters
    ----------
    origin
        An orbit whose branch has a doubling, or first a symmetry breaking.
    parameter, within, direction
        As for `follow_branch`.
    doublings
        Largest number of doublings, up to 8; fewer are returned where a branch has fewer.
    largest_step
        Largest step of arclength, on the first branch.

    Returns
    -------
    Cascade
        Each doubling to rounding.

    Raises
    ------
    InputError, ModelError
        As `follow_branch`; also if there is no doubling.

    References
    ----------
    M. J. Feigenbaum, Quantitative universality for a class of nonlinear transformations, Journal of
    Statistical Physics 19, 25-52 (1978).

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic, find_orbits
    >>> motion = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    >>> origin = find_orbits(DimensionlessBlock(restitution=0.8), motion, max_period=1)[0]
    >>> cascade = find_cascade(origin, "frequency_ratio", (1.7, 2.0), direction=-1, doublings=4)
    >>> print([f"{value:.7f}" for value in cascade.values], [f"{r:.3f}" for r in cascade.ratios])
    ['1.7892720', '1.7746913', '1.7723039', '1.7718153'] ['6.107', '4.887']
    """
    points: list[BranchPoint] = []
    here, switch, step = origin, False, largest_step
    impacts = chain_at(origin).impacts
    while len(points) < doublings:
        followed = follow_branch(
            here, parameter, within, direction=direction, switch=switch, largest_step=step
        )
        next(followed)
        ahead = next(
            (
                point
                for point in followed
                if point.type in (PointType.PERIOD_DOUBLING, PointType.SYMMETRY_BREAKING)
            ),
            None,
        )
        # A branch may turn back into its parent, and end at what is doubled there.
        if ahead is None or ahead.chain.impacts < impacts:
            break
        if ahead.type is PointType.PERIOD_DOUBLING:
            points.append(ahead)
            step *= SHRINKING
        here, switch = ahead, True
        impacts = 2 * impacts
    if not points:
        raise ModelError(
            "origin",
            Words("is an orbit"),
            f"its branch has no period doubling within {within}",
            "widen the range, or follow it in the other direction",
        )
    return Cascade(parameter=parameter, points=tuple(points))


def longest_cascade(
    branches: Sequence[Branch], within: tuple[float, float], doublings: int
) -> Cascade | None:
    """Return the first long cascade that begins on one of several branches, else the longest.

    Parameters
    ----------
    branches
        Over one parameter, as from `find_branches`.
    within
        Its range.
    doublings
        As for `find_cascade`.

    Returns
    -------
    Cascade or None
        None where no branch has a doubling.
    """
    best = None
    for branch in branches:
        middle = _stable_middle(branch)
        if middle is None:
            continue
        for direction in (1, -1):
            try:
                cascade = find_cascade(
                    middle, branch.parameter, within, direction=direction, doublings=doublings
                )
            except ModelError:  # it has none
                continue
            if best is None or len(cascade.points) > len(best.points):
                best = cascade
            if len(best.points) >= min(ENOUGH, doublings):
                return best
    return best


def _stable_middle(branch: Branch) -> BranchPoint | None:
    """Return a point in the middle of the longest stable stretch of a branch."""
    stable = [part for part in branch.stretches if part.stable and part.last - part.first > 1]
    if not stable:
        return None
    longest = max(stable, key=lambda part: part.last - part.first)
    return branch.points[(longest.first + longest.last) // 2]
