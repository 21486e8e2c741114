"""Edge state: what a motion on the border of two basins settles to."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.edges.hilltop import HilltopSaddle
from rocksteady.dynamics.history.start import State
from rocksteady.dynamics.orbits.attractor import Attractor
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.equations import Linear, Model
from rocksteady.model.facts import kick_m_s
from rocksteady.model.motions.segments import Harmonic
from rocksteady.model.units import in_units
from rocksteady.results.result import Result

if TYPE_CHECKING:
    import pandas as pd


MOST_KICK = 4.0
"""Largest kick that is tried [alpha g/p]."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class EdgeState(Result):
    """What a motion on the border of two basins settles to.

    Attributes
    ----------
    block, motion
        Block and base motion; the phase of `motion` is that of `start`, `other`, `boundary` and of
        the tracked states, in [0, 2 pi).
    kind
        "hilltop" or "orbit" for a saddle of that kind; "aperiodic" where the tracked motion does
        not repeat, "lost" where it could not be followed.
    saddle
        `HilltopSaddle` or `Orbit`, found by Newton's method; None without one.
    start, other
        The states between which the border was sought.
    attractors
        What either settles to.
    outcomes
        The same in words, with the side of a fall.
    boundary
        The state on the border between them, to 1e-10 of it, at which the tracking began.
    kick
        The least fatal kick from `start` [alpha g/p], with its sign; None where `other` was given.
    opposite
        The least fatal kick in the other direction; nan where none up to 4 alpha g/p is fatal, None
        where that direction was not searched.
    fractal
        Whether smaller steps of the kick find more borders, so that `kick` is the least one found;
        None where `other` was given.
    width
        Width of the window of fatal kicks that begins at `kick`, to 1 % [alpha g/p]; None where the
        border is not fractal in that direction.
    resolution
        Step of the sizes up to twice the least [alpha g/p]: narrower windows of fatal kicks may be
        missed.
    angle, velocity
        The tracked motion at the phase, period by period, shape (periods + 1,).
    bisections
        States whose outcome was computed.
    exponent
        Rate at which motions leave the border, per forcing period, from the growth of the pairs
        that bracket it: the Lyapunov exponent of the tracked motion.
    distance
        From the last tracked state to the saddle at the phase, in (u, du/d(pt)); nan without one.
    model
        Which equations of motion hold: `Linear` or `Nonlinear`.
    """

    block: Block | DimensionlessBlock
    motion: Harmonic
    kind: str
    saddle: Orbit | HilltopSaddle | None
    start: State
    other: State
    attractors: tuple[Attractor, Attractor]
    outcomes: tuple[str, str]
    boundary: State
    kick: float | None
    opposite: float | None
    fractal: bool | None
    width: float | None
    resolution: float | None
    angle: Floats
    velocity: Floats
    bisections: int
    exponent: float
    distance: float
    model: Model = field(default_factory=Linear)

    @property
    def periods(self) -> int:
        """Forcing periods for which the border was tracked."""
        return len(self.angle) - 1

    @property
    def kick_m_s(self) -> float:
        """The least fatal kick [m/s]; nan of a dimensionless block, or where there is none."""
        return kick_m_s(self.block, self.kick)

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per tracked state: periods since the boundary, angle and velocity."""
        import pandas as pd

        columns = {"period": np.arange(len(self.angle)), "angle": self.angle}
        return pd.DataFrame(in_units({**columns, "velocity": self.velocity}, self.block))
