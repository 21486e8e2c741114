"""Stable and unstable manifolds of saddles, over a phase of the shaking or a section of impacts."""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Literal

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.dynamics.edges.hilltop import HilltopSaddle
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.orbits.return_map import harmonic
from rocksteady.errors import ModelError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.checks.validation import LARGEST, in_range
from rocksteady.model.equations import Model
from rocksteady.model.motions.segments import Harmonic
from rocksteady.model.units import in_units
from rocksteady.results.result import Result

if TYPE_CHECKING:
    import pandas as pd


Kind = Literal["stable", "unstable"]
Over = Literal["phase", "impacts"]


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False)
class ManifoldBranch:
    """One branch of a manifold: a curve that begins beside the saddle.

    Attributes
    ----------
    first, second
        u and du/d(pt) at the phase, or phase in [0, 2 pi) [rad] and speed just after an impact,
        shape (points,).
    label
        Periods of the saddle for which the motion through each point has been away from it, up
        to a constant: the map over such a period adds 1, or of a stable manifold takes 1 off.
    impacts
        Number of impacts of that motion since, as `Impacts` counts them.
    side
        +1 or -1 to which the block leans at a point, or goes from an impact; 0 at rest.
    arclength
        Along the branch up to each point, without its jumps.
    breaks
        Indices of the points after which it jumps.
    sign
        +1 or -1: on which side of the saddle it begins.
    place
        Number of the saddle's point at which it begins, from 0; of impacts of a hilltop saddle, how
        many since or until.
    ended
        Why it ends: by its "length"; "far", where all that follows is outside the window; "settled"
        at a point; at "rest"; with the largest number of "points"; after 200 "periods"; or not: of
        a hilltop saddle over impacts it is "whole".

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic
    >>> from rocksteady.basins import compute_manifold, find_hilltop_saddles
    >>> motion = Harmonic(amplitude=0.1, frequency_ratio=4.0)
    >>> saddle, *_ = find_hilltop_saddles(DimensionlessBlock(restitution=0.8), motion)
    >>> manifold = compute_manifold(saddle, kind="stable", length=0.5, spacing=0.1)
    >>> [branch.sign for branch in manifold.branches], manifold.branches[0].ended
    ([1, -1], 'far')
    """

    first: Floats
    second: Floats
    label: Floats
    impacts: Integers
    side: Integers
    arclength: Floats
    breaks: Integers
    sign: int
    place: int
    ended: str

    @property
    def length(self) -> float:
        """Length of the branch."""
        return float(self.arclength[-1]) if len(self.arclength) else 0.0

    @property
    def pieces(self) -> list[slice]:
        """Parts without a jump, as slices of the arrays."""
        ends = [0, *(self.breaks + 1).tolist(), len(self.first)]
        return [slice(a, b) for a, b in pairwise(ends) if b > a]


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Manifold(Result):
    """Stable or unstable manifold of a saddle.

    Attributes
    ----------
    saddle
        `Orbit` or `HilltopSaddle`.
    kind
        "stable" or "unstable".
    over
        "phase": states at a phase of the shaking; "impacts": states just after an impact.
    phase
        Phase of the shaking [rad], in [0, 2 pi); nan over impacts.
    branches
        Curves that begin beside the saddle.
    window
        Half widths of the window, about (0, 0), in which lengths count.
    spacing
        Largest distance of neighbours, in those half widths.
    """

    saddle: Orbit | HilltopSaddle
    kind: Kind
    over: Over
    phase: float
    branches: tuple[ManifoldBranch, ...]
    window: tuple[float, float]
    spacing: float

    @property
    def block(self) -> Block | DimensionlessBlock:
        """What moves."""
        return self.saddle.block

    @property
    def motion(self) -> Harmonic:
        """The shaking."""
        return harmonic(self.saddle.motion)

    @property
    def model(self) -> Model:
        """Which equations of motion hold."""
        return self.saddle.model

    @property
    def points(self) -> int:
        """Number of points of all branches."""
        return sum(len(branch.first) for branch in self.branches)

    def nearest(self, angle: float, velocity: float) -> tuple[float, float]:
        """Return the point of the manifold nearest to a state, between its points on chords.

        For a stable manifold that parts standing from overturning it is the least perturbation of
        any direction in (u, du/d(pt)) that lets the block fall (Halekotte and Feudel 2020).

        Parameters
        ----------
        angle, velocity
            u and du/d(pt) at the phase.

        Returns
        -------
        tuple of float
            u and du/d(pt).

        Raises
        ------
        InputError
            If a number is not finite, or beyond 1e50.
        ModelError
            If the manifold is over impacts, or has no points.
        """
        hint = "give a state at the phase of the manifold"
        here = np.array(
            [
                in_range(name, value, -LARGEST, LARGEST, "[]", hint=hint)
                for name, value in (("angle", angle), ("velocity", velocity))
            ]
        )
        if self.over != "phase" or not self.points:
            raise ModelError(
                "manifold",
                Words("is one over impacts" if self.points else "has no points"),
                "states of angle and velocity are near one over a phase",
                "compute it over a phase",
            )
        best, nearest_state = math.inf, (math.nan, math.nan)
        for branch in self.branches:
            for part in branch.pieces:
                path = np.column_stack([branch.first[part], branch.second[part]])
                begin = path[:-1] if len(path) > 1 else path
                step = np.diff(path, axis=0) if len(path) > 1 else np.zeros_like(path)
                square = np.square(step).sum(axis=1)
                along = ((here - begin) * step).sum(axis=1) / np.where(square > 0.0, square, 1.0)
                closest = begin + np.clip(along, 0.0, 1.0)[:, np.newaxis] * step
                apart = np.square(closest - here).sum(axis=1)
                least = int(np.argmin(apart))
                if apart[least] < best:
                    best = float(apart[least])
                    nearest_state = float(closest[least, 0]), float(closest[least, 1])
        return nearest_state

    @property
    def coordinates(self) -> tuple[str, str]:
        """Names of both coordinates of its points."""
        return ("angle", "velocity") if self.over == "phase" else ("phase", "speed")

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per point, in order; `piece` counts parts without a jump."""
        import pandas as pd

        first, second = self.coordinates
        frames = []
        for index, branch in enumerate(self.branches):
            piece = np.zeros(len(branch.first), dtype=np.int64)
            piece[branch.breaks + 1] = 1
            frames.append(
                pd.DataFrame(
                    {
                        "branch": index,
                        "sign": branch.sign,
                        "place": branch.place,
                        "piece": np.cumsum(piece),
                        first: branch.first,
                        second: branch.second,
                        "side": branch.side,
                        "impacts": branch.impacts,
                        "label": branch.label,
                        "arclength": branch.arclength,
                    }
                )
            )
        columns = ["branch", "sign", "place", "piece", first, second, "side", "impacts"]
        columns += ["label", "arclength"]
        frame = pd.concat(frames, ignore_index=True) if frames else pd.DataFrame(columns=columns)
        return pd.DataFrame(in_units(dict(frame.items()), self.block))
