"""Bifurcation diagram: branches over a parameter, both sweeps, and the cascade of doublings."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from rocksteady.dynamics.continuation.branches import SAME_PLACE, BranchOptions
from rocksteady.dynamics.continuation.cascade import Cascade
from rocksteady.dynamics.continuation.points import Branch, BranchPoint, extremes
from rocksteady.dynamics.continuation.resting.resting_branch import RestingBranch
from rocksteady.dynamics.orbits.attractor_sweep import AttractorSweep
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.equations import Linear, Model
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.units import framed
from rocksteady.results.result import Result, words_module

if TYPE_CHECKING:
    import pandas as pd
    import xarray


SAME_ANGLE = 1e-5
"""Difference of the highest |u| of one bifurcation on two branches."""
LONGEST_SWEEP = 20_000
"""Values of a sweep; each takes about a millisecond, a motion that does not settle several."""
VALUES = 400
"""Default number of values of a sweep."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Bifurcation(Result):
    """A bifurcation of a diagram.

    Attributes
    ----------
    point
        On the first of the branches that it lies on.
    branches
        Their numbers, from 1.
    highest, lowest
        Extrema of u = theta/alpha; of two mirror images, of the orbit that leans to the
        positive side.
    """

    point: BranchPoint
    branches: tuple[int, ...]
    highest: float
    lowest: float

    @property
    def model(self) -> Model:
        """Which equations of motion hold: `Linear` or `Nonlinear`."""
        return self.point.model

    def plot(self, *arguments: Any, **options: Any) -> Any:
        """Plot the orbit there, as `BranchPoint.plot`."""
        return self.point.plot(*arguments, **options)


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class BifurcationDiagram(Result):
    """Periodic motions over a parameter, with their bifurcations, sweeps and cascade.

    Attributes
    ----------
    block, motion
        Block and base motion; their own value of the parameter does not count.
    parameter, within
        Parameter and its range.
    search
        Options of the search for branches.
    branches
        In the order in which they were found: a branch comes after the one it branches off.
    sweeps
        Upwards and downwards; none without values.
    cascade
        The longest; None where no branch has a period doubling, or `doublings` is 0.
    complete
        Whether all branches were followed: False where `max_branches` ended the work.
    resting
        The branches of orbits that come to rest, all of them stable.
    model
        Which equations of motion hold: `Linear` or `Nonlinear`.
    """

    block: Block | DimensionlessBlock
    motion: PeriodicMotion
    parameter: str
    within: tuple[float, float]
    search: BranchOptions
    branches: tuple[Branch, ...]
    sweeps: tuple[AttractorSweep, ...]
    cascade: Cascade | None
    complete: bool
    resting: tuple[RestingBranch, ...] = ()
    model: Model = field(default_factory=Linear)

    @cached_property
    def points(self) -> tuple[Bifurcation, ...]:
        """Every bifurcation once, with all branches that it lies on."""
        near = SAME_PLACE * (self.within[1] - self.within[0])
        listed: list[Bifurcation] = []
        for place, branch in enumerate(self.branches, start=1):
            for point in branch.bifurcations:
                high, low = extremes(point, branch.lean)
                for index, known in enumerate(listed):
                    if (
                        known.point.type is point.type
                        and abs(self._value(known.point) - self._value(point)) <= near
                        and abs(max(known.highest, -known.lowest) - max(high, -low)) <= SAME_ANGLE
                    ):
                        if place not in known.branches:
                            listed[index] = replace(known, branches=(*known.branches, place))
                        break
                else:
                    listed.append(
                        Bifurcation(point=point, branches=(place,), highest=high, lowest=low)
                    )
        return tuple(listed)

    def _value(self, point: BranchPoint) -> float:
        value: float = getattr(point, self.parameter)
        return value

    def rows(self) -> Iterator[dict[str, Any]]:
        """Yield one row per point of each branch, in SI too where the block has a size."""
        yield from words_module(BifurcationDiagram).diagram_rows(self)

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per point of each branch, in SI too where the block has a size."""
        return framed(self.rows(), self.block, "branch")

    def to_dataset(self) -> "xarray.Dataset":
        """Return branches and bifurcations as an xarray Dataset; sweeps and cascade have their own.

        Returns
        -------
        xarray.Dataset
            The columns of `to_dataframe` over point, one branch after another, with their number
            ``branch``; ``peaks`` over point and flight, nan beyond the flights of a branch.  Over
            bifurcation, each once: ``bifurcation_type`` with flags, its parameters and angles, and
            the first branch that it lies on.

        Examples
        --------
        >>> from rocksteady import DimensionlessBlock, Harmonic, find_bifurcations
        >>> block = DimensionlessBlock(restitution=0.8)
        >>> motion = Harmonic(amplitude=2.0, frequency_ratio=2.0)
        >>> case = {"within": (1.8, 2.4), "values": 0}
        >>> data = find_bifurcations(block, motion, "frequency_ratio", **case).to_dataset()
        >>> longest = data.where(data.branch == 1, drop=True)
        >>> print(data.sizes["bifurcation"], longest.frequency_ratio.values.max())
        1 2.4
        """
        dataset: xarray.Dataset = words_module(BifurcationDiagram).diagram_dataset(self)
        return dataset

    def __repr__(self) -> str:
        """Return one line, with the numbers of branches and bifurcations."""
        return f"<{type(self).__name__}: {words_module(BifurcationDiagram).diagram_line(self)}>"
