"""Bands of stable motions of one family over the plane, column by column."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rocksteady import Execution
from rocksteady.arrays import Floats
from rocksteady.show.study.environment import Done, nothing
from rocksteady.studies.atlas.analysis.columns import Column, columns
from rocksteady.studies.atlas.analysis.plane import Plane


@dataclass(frozen=True, kw_only=True, eq=False)
class FamilyMap:
    """The bands of one family over the plane.

    Attributes
    ----------
    plane
        Where.
    order
        Half periods n of the shaking in a half cycle of the symmetric motion.
    columns
        One for each frequency ratio of the plane.
    """

    plane: Plane
    order: int
    columns: tuple[Column, ...]

    @cached_property
    def edges(self) -> Floats:
        """Ends of the bands, shape (4, columns): begin, symmetric, unsymmetric, cascade.

        nan where there is no stable symmetric motion.
        """
        rows = [(c.lowest, c.band(0)[1], c.band(1)[1], c.limit) for c in self.columns]
        edges: Floats = np.minimum(np.array(rows).T, self.plane.top)
        edges[3] = np.maximum(edges[3], edges[2])
        return edges

    def area(self, band: int) -> float:
        """Return the part of the plane that a band takes: 0 symmetric, 1 unsymmetric, 2 doubled."""
        left, right, low, high = self.plane.window
        heights = np.nan_to_num(self.edges[band + 1] - np.maximum(self.edges[band], low))
        ratios = self.plane.ratios
        # Each column stands for its cell, so that the outermost ones count to the window's edges.
        widths = np.diff([left, *(0.5 * (ratios[1:] + ratios[:-1])), right])
        return float((widths * np.maximum(heights, 0.0)).sum() / ((right - left) * (high - low)))

    def stable(self, amplitude: Floats) -> NDArray[np.bool_]:
        """Return where a motion of the family is stable, shape (amplitudes, columns)."""
        rows = np.asarray(amplitude)[:, np.newaxis]
        inside: NDArray[np.bool_] = (rows > self.edges[0]) & (rows < self.edges[3])
        return inside


def family_map(
    plane: Plane,
    order: int,
    *,
    run: Execution | None = None,
    done: Done = nothing,
) -> FamilyMap:
    """Return the bands of one family over a plane.

    Parameters
    ----------
    plane
        Where.
    order
        n = 1, 3, 5, ...
    run
        As for `rocksteady.sweeps.evaluate`; `done` replaces its progress.
    done
        Called once for each column.
    """

    def told(count: int) -> None:
        for _ in range(count):
            done(f"columns, n = {order}")

    how = replace(Execution() if run is None else run, progress=told)
    bands = columns(plane, order, plane.ratios, run=how)
    return FamilyMap(plane=plane, order=order, columns=bands)
