"""Fates over a window of initial states, under any base motion that ends."""

import functools
import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Bools, Floats
from rocksteady.dynamics.basins._safe import measured
from rocksteady.dynamics.basins.window import counted, window_axes
from rocksteady.dynamics.batch.finite import BATCH, OUTPUTS, fates_of, finite_table, thrust
from rocksteady.dynamics.history.start import State
from rocksteady.kernels.core.tables import JUMP, LEAN, RATE
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.confidence import Confidence
from rocksteady.model.checks.validation import index_value
from rocksteady.model.equations import Linear, Model, ModelChoice, chosen_model
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Motion
from rocksteady.model.units import in_units
from rocksteady.outcomes import Status
from rocksteady.results.numbers import CONFIDENCE
from rocksteady.results.result import Result, words_module
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.outputs import Output
from rocksteady.sweep.evaluate import compute_cells
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import pandas as pd
    import xarray

Codes = NDArray[np.int8]

LEAST_WIDTH, WIDEST = 1.5, 20.0
"""Half-width of the default window at least and at most, in units of the larger side."""
MARGIN = 1.0625
"""Beyond the states that the motion carries off: on their border itself the block balances."""
SAFE = (Status.AT_REST, Status.ROCKING)
"""Fates of a block that has neither overturned nor left its base, and is decided."""
STILL = Output(name="still_safe", dtype=np.bool_, long_name="whether it stands on a still base")
ORDER = (
    (Status.AT_REST, 0, "at rest"),
    (Status.ROCKING, 0, "still rocking"),
    (Status.OVERTURNED, 1, "overturned, positive side"),
    (Status.OVERTURNED, -1, "overturned, negative side"),
    (Status.LOST_CONTACT, 0, "lost contact"),
    (Status.UNDECIDED, 0, "undecided"),
)
"""Of fates with their sides, in tables and legends."""


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False)
class FateShare(Result):
    """Share of a window that has one fate.

    Attributes
    ----------
    fate
        How the motions end.
    side
        Side to which they overturn, 1 or -1; 0 for every other fate.
    name
        Both in words.
    states
        Initial states of the window with this fate.
    share
        Share of all states of the window.
    low, high
        Wilson's interval of the share.
    """

    fate: Status
    side: int
    name: str
    states: int
    share: float
    low: float
    high: float


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class FateBasins(Result):
    """Fates over a window of initial states, under a base motion that ends.

    Attributes
    ----------
    block, motion
        What moves.
    time_pt
        Pivot time p t of the motion at which the states are taken.
    angle, velocity
        The window: u = theta/alpha, shape (n,), and du/d(pt), shape (m,).
    fate
        Code of `Status` with which each motion ends, shape (m, n).
    side
        Side to which the block overturns, 1 or -1; 0 where it does not, shape (m, n).
    impacts
        Impacts until the end, as `Impacts` counts them, shape (m, n).
    peak
        Largest |theta|/alpha from that moment on, until overturning; each side counts in its own
        alpha, shape (m, n).
    still_safe
        Whether the state stands on a still base, shape (m, n).
    model
        Which equations of motion hold: `Linear` or `Nonlinear`.
    """

    block: Block | DimensionlessBlock
    motion: Motion | Record | BaseMotion
    time_pt: float
    angle: Floats
    velocity: Floats
    fate: Codes
    side: Codes
    impacts: NDArray[np.int64]
    peak: Floats
    still_safe: Bools
    model: Model = field(default_factory=Linear)

    @cached_property
    def safe(self) -> Bools:
        """Whether the block stands at the end, at rest or rocking, shape (m, n)."""
        return np.isin(self.fate, [int(status) for status in SAFE])

    @property
    def safe_share(self) -> float:
        """Share of the window that is safe."""
        return float(self.safe.mean())

    @property
    def still_share(self) -> float:
        """Share of the window that is safe on a still base."""
        return float(self.still_safe.mean())

    @cached_property
    def radius(self) -> float:
        """Radius of the largest circle of safe states, in the plane of u and du/d(pt)."""
        return measured(self.safe, self.angle, self.velocity)[1]

    @cached_property
    def still_radius(self) -> float:
        """The same radius on a still base."""
        return measured(self.still_safe, self.angle, self.velocity)[1]

    @property
    def global_integrity(self) -> float:
        """Safe area over that on a still base, 1 at most; nan where no state is safe there."""
        return min(self.safe_share / self.still_share, 1.0) if self.still_share else math.nan

    @property
    def integrity_factor(self) -> float:
        """Radius of the largest safe circle over that on a still base, 1 at most; nan without."""
        return min(self.radius / self.still_radius, 1.0) if self.still_radius else math.nan

    @property
    def largest_safe_peak(self) -> float:
        """Largest |theta|/alpha of all safe motions; nan where none is safe."""
        return float(self.peak[self.safe].max()) if self.safe.any() else math.nan

    @property
    def undecided(self) -> float:
        """Share of the states whose fate is undecided."""
        return float((self.fate == Status.UNDECIDED).mean())

    def fractions(self, confidence: Confidence = CONFIDENCE) -> tuple[FateShare, ...]:
        """Return the share of each fate in the window, with Wilson's score interval.

        As for `Basins.fractions` the interval is that of as many states drawn at random.

        Parameters
        ----------
        confidence
            Confidence of the interval, in (0, 1); default 0.9.

        Returns
        -------
        tuple of FateShare
            One for each fate that occurs, and for each side to which blocks overturn; the shares
            add up to 1.

        Raises
        ------
        InputError
            If the confidence is outside its range.
        """
        fractions = []
        for status, side, name in ORDER:
            states = int(np.count_nonzero((self.fate == status) & (self.side == side)))
            if states:
                counts = counted(states, self.fate.size, confidence)
                fractions.append(FateShare(fate=status, side=side, name=name, **counts))
        return tuple(fractions)

    def state(self, row: int, column: int) -> State:
        """Return the initial state of a cell, for `simulate` where `time_pt` is 0.

        Parameters
        ----------
        row, column
            Index of its velocity and of its angle.

        Raises
        ------
        InputError
            If there is no such cell.
        """
        return State(
            angle=float(self.angle[index_value(column, len(self.angle), "angle")]),
            velocity=float(self.velocity[index_value(row, len(self.velocity), "velocity")]),
        )

    def to_dataset(self) -> "xarray.Dataset":
        """Return the fates as an xarray Dataset over velocity and angle.

        Returns
        -------
        xarray.Dataset
            ``fate`` with flags, ``side``, ``impacts``, ``peak`` and ``still_safe`` over velocity
            (du/d(pt)) and angle; the measures of integrity among the attributes.
        """
        dataset: xarray.Dataset = words_module(FateBasins).fates_dataset(self)
        return dataset

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per state: angle, velocity, fate, side, impacts and peak."""
        import pandas as pd

        velocity, angle = np.meshgrid(self.velocity, self.angle, indexing="ij")
        labels = np.array([status.label for status in Status])
        columns = {
            "angle": angle.ravel(),
            "velocity": velocity.ravel(),
            "fate": labels[self.fate.ravel()],
            "side": self.side.ravel(),
            "impacts": self.impacts.ravel(),
            "peak": self.peak.ravel(),
        }
        return pd.DataFrame(in_units(columns, self.block))

    def __repr__(self) -> str:
        """Return one line, without the shares."""
        return f"<FateBasins: {words_module(FateBasins).fates_headline(self)}>"


@checked
def compute_fate_basins(
    block: Block | DimensionlessBlock,
    motion: Motion | Record | BaseMotion,
    *,
    angles: ArrayLike | None = None,
    velocities: ArrayLike | None = None,
    time_pt: float = 0.0,
    model: ModelChoice = None,
    run: Execution | None = None,
) -> FateBasins:
    """Compute the fate of each state of a window under a base motion that ends.

    `simulate` gives the same: the rest of the motion, then a still base until the block comes to
    rest or is proved to overturn, or until p t = 1e4 where nothing is lost (restitution 1).  Two
    measures compare the safe states with those of a still base, as `compute_erosion` does: area,
    and radius of the largest circle.

    Parameters
    ----------
    block
        The block.
    motion
        Any base motion that ends: `Record`, `BaseMotion`, `Pulse`, `Impulses`, `Piecewise` and
        sums of them, `SyntheticMotion`, `Still`; for endless shaking `motions.cut` takes a part.
    angles, velocities
        u = theta/alpha, shape (n,), and du/d(pt), shape (m,), evenly spaced; by default the middles
        of 200 cells up to 1.5 on either side, or as far as the motion shifts the states that its
        acceleration does not carry off.  Against a wall, angles of 0 or above.
    time_pt
        Pivot time p t of the motion at which the states are taken (default 0).  An impulse at that
        moment acts on them.
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.
    run
        Executor, store and progress, as for `evaluate`.

    Returns
    -------
    FateBasins
        Fates, sides, impacts and peaks; shares and integrity.

    Raises
    ------
    InputError, ModelError, OutputError, UnfinishedError
        If a number is outside its range, an axis is not evenly spaced, the motion has no end, a
        record or the nonlinear model meets a dimensionless block, the linear model a vertical
        motion, or a store cannot be written.

    Examples
    --------
    >>> import numpy as np
    >>> from rocksteady import DimensionlessBlock, Pulse, compute_fate_basins
    >>> window = np.linspace(-1.4, 1.4, 15)
    >>> basins = compute_fate_basins(
    ...     DimensionlessBlock(restitution=0.9),
    ...     Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=4.0),
    ...     angles=window,
    ...     velocities=window,
    ... )
    >>> for part in basins.fractions():
    ...     print(part.name, part.states)
    at rest 60
    overturned, positive side 95
    overturned, negative side 70
    >>> print(f"{basins.global_integrity:.3f}")
    0.779
    """
    chosen = chosen_model(model, block)
    sides = chosen.sides(block)
    table = finite_table(motion, block, chosen, time_pt=time_pt)
    axes = window_axes(block, angles, velocities, _reaches(table, sides))
    data = compute_cells(
        functools.partial(_fates, table=table, sides=sides),
        Grid(axes=(axes[1], axes[0])),
        (*OUTPUTS, STILL),
        run=run,
        batch=BATCH,
    )
    cells: dict[str, NDArray[Any]] = {str(name): data[str(name)].values for name in data.data_vars}
    return FateBasins(
        block=block,
        motion=motion,
        time_pt=float(time_pt),
        angle=axes[0].points,
        velocity=axes[1].points,
        model=chosen,
        **cells,
    )


def _fates(
    velocities: Floats, angles: Floats, *, table: Floats, sides: Floats
) -> dict[str, NDArray[Any]]:
    """Return the fates of some states, and whether they are safe on a still base."""
    ends = fates_of(table, sides, angles, velocities)
    still = table[-1:].copy()
    still[:, JUMP] = 0.0
    standing = fates_of(still, sides, angles, velocities)["fate"]
    return {**ends, "still_safe": np.isin(standing, [int(status) for status in SAFE])}


def _reaches(table: Floats, sides: Floats) -> tuple[float, float]:
    """Return how far in u and in du/d(pt) the default window reaches."""
    angle = velocity = 0.0
    for lean, rate in sides[:, [LEAN, RATE]].tolist():
        far = MARGIN * (lean + abs(thrust(table, rate)))
        reach = min(max(LEAST_WIDTH * lean, far), WIDEST * lean)
        angle, velocity = max(angle, reach), max(velocity, max(rate, 1.0) * reach)
    return angle, velocity
