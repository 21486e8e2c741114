"""Erosion of the safe basin: its size under shaking relative to that on a still base."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Bools, Floats
from rocksteady.dynamics.arrays import validated_grid
from rocksteady.dynamics.basins._safe import measured, safe_states
from rocksteady.dynamics.basins.window import (
    POINTS,
    against_wall,
    centred,
    moment,
    window_axes,
)
from rocksteady.dynamics.orbits.attractor import FORCING_PERIODS
from rocksteady.dynamics.orbits.return_map import periodic_motion
from rocksteady.dynamics.steady.heteroclinic import tangency_amplitude
from rocksteady.dynamics.steady.regions import heteroclinic_amplitude
from rocksteady.errors import InputError, ModelError
from rocksteady.kernels.core.tables import LEAN, RATE
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.validation import in_range, positive
from rocksteady.model.equations import Linear, Model, ModelChoice, Nonlinear, chosen_model
from rocksteady.model.linear_tables import only_side
from rocksteady.model.motions.fourier import FourierSeries, PeriodicMotion, harmonics_of
from rocksteady.results.result import Result, words_module
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray


CYCLES = 100
"""Default number of forcing periods that a safe state stands."""
HALF_WIDTH, WIDENING, WIDEST = 1.5, 1.5, 20.0
"""Of the default window in theta/alpha and in its velocity per pivot time: the least half-width,
the factor by which it is widened, and the largest."""
LEVEL = 0.5
TOLERANCE = 1e-3
MEASURES = ("integrity_factor", "global_integrity")


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False)
class IntegrityDrop(Result):
    """Two neighbouring amplitudes between which a measure of integrity first falls below a level.

    Attributes
    ----------
    measure, level
        Name of the measure, and the level.
    low, high
        The amplitudes between which the measure falls below the level.
    above, below
        The measure at these.
    """

    measure: str
    level: float
    low: float
    high: float
    above: float
    below: float


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Erosion(Result):
    """Integrity of the safe basin against the amplitude of the shaking.

    Attributes
    ----------
    block, motion
        Block and base motion; the phase of `motion` is that of all initial states, in [0, 2 pi),
        and its amplitude, which was given, is replaced by `amplitude`.
    amplitude
        A = a_max/(alpha g), ascending, shape (amplitudes,).
    angle, velocity
        The window: u = theta/alpha, shape (n,), and du/d(pt), shape (m,).
    cycles
        Forcing periods that a safe state stands.
    safe
        Whether each state is safe, shape (amplitudes, m, n).
    safe_share
        Share of the window that is safe, shape (amplitudes,).
    radius
        Radius of the largest circle of safe states in the plane of u and du/d(pt), shape
        (amplitudes,).
    still_share, still_radius
        Share and radius on a still base (A = 0).
    model
        Which equations of motion hold: `Linear` or `Nonlinear`.
    """

    block: Block | DimensionlessBlock
    motion: PeriodicMotion
    amplitude: Floats
    angle: Floats
    velocity: Floats
    cycles: int
    safe: Bools
    safe_share: Floats
    radius: Floats
    still_share: float
    still_radius: float
    model: Model = field(default_factory=Linear)

    @property
    def global_integrity(self) -> Floats:
        """Global integrity measure: the safe area over that on a still base, 1 at most."""
        measure: Floats = np.minimum(self.safe_share / self.still_share, 1.0)
        return measure

    @property
    def integrity_factor(self) -> Floats:
        """Integrity factor: radius of the largest safe circle over a still base's, 1 at most."""
        measure: Floats = np.minimum(self.radius / self.still_radius, 1.0)
        return measure

    @property
    def heteroclinic(self) -> float | None:
        """Amplitude of the heteroclinic tangency, in closed form: `heteroclinic_amplitude`.

        For a block whose sides differ, the lower one of both directions.  None in the nonlinear
        model and under a Fourier series, which have no closed form of it, and against a wall, where
        there is one saddle.
        """
        series = isinstance(self.motion, FourierSeries)
        if series or isinstance(self.model, Nonlinear) or self.block.one_sided:
            return None
        if not self.block.symmetric:
            return tangency_amplitude(self.block.dimensionless().sides, self.motion.frequency_ratio)
        return float(heteroclinic_amplitude(self.motion.frequency_ratio, self.block.restitution))

    @cached_property
    def drops(self) -> "Mapping[str, IntegrityDrop | None]":
        """Amplitude at which each measure first falls below 0.5, by name; computed when read."""
        return {measure: self.drop(measure) for measure in MEASURES}

    def measure(self, name: str) -> Floats:
        """Return a measure by its name.

        Raises
        ------
        InputError
            If it is neither "integrity_factor" nor "global_integrity".
        """
        if name not in MEASURES:
            raise InputError(
                "measure",
                name,
                f"it must be one of {', '.join(MEASURES)}",
                "leave it out for the integrity factor",
            )
        return self.integrity_factor if name == MEASURES[0] else self.global_integrity

    def drop(
        self,
        measure: str = MEASURES[0],
        *,
        level: float = LEVEL,
        tolerance: float = TOLERANCE,
        run: Execution | None = None,
    ) -> IntegrityDrop | None:
        """Return where a measure first falls below a level, or None.

        None is the answer where it does not up to the last of the amplitudes.

        The first of the amplitudes below the level and the one before it (or 0) are brought closer
        by bisection, each time with a new basin over the same window.  A dip between two of the
        amplitudes is not seen.

        Parameters
        ----------
        measure
            "integrity_factor" or "global_integrity".
        level
            In (0, 1].
        tolerance
            How close the two amplitudes come, above 0.
        run
            As for `compute_erosion`, without a store; `progress` counts one basin after another.

        Raises
        ------
        InputError
            If an argument is outside its range.
        ModelError
            If the run has a store.
        """
        how = (run or Execution()).in_memory("the basins of a drop are not kept")
        bound = in_range("level", level, 0.0, 1.0, hint="give a share, as 0.5")
        close = positive("tolerance", tolerance, hint="give a difference of amplitudes, as 0.001")
        values = self.measure(measure)
        under = np.flatnonzero(values < bound)
        if not under.size:
            return None
        first = int(under[0])
        low, above = 0.0, 1.0
        if first > 0:
            low, above = float(self.amplitude[first - 1]), float(values[first - 1])
        high, below = float(self.amplitude[first]), float(values[first])
        while high - low > close:
            middle = 0.5 * (low + high)
            if not low < middle < high:  # neighbouring numbers
                break
            value = self._at(middle, measure, how)
            if value < bound:
                high, below = middle, value
            else:
                low, above = middle, value
        return IntegrityDrop(
            measure=measure, level=bound, low=low, high=high, above=above, below=below
        )

    def _at(self, amplitude: float, measure: str, run: Execution) -> float:
        """Return a measure at one more amplitude."""
        safe = safe_states(
            sides=self.model.sides(self.block),
            frequency_ratio=self.motion.frequency_ratio,
            phase=self.motion.phase,
            harmonics=harmonics_of(self.motion),
            amplitudes=[amplitude],
            angles=self.angle,
            velocities=self.velocity,
            cycles=self.cycles,
            run=run,
        )
        share, radius = measured(safe[0], self.angle, self.velocity)
        ratio = radius / self.still_radius if measure == MEASURES[0] else share / self.still_share
        return min(ratio, 1.0)

    def to_dataset(self) -> "xarray.Dataset":
        """Return the measures and the basins as an xarray Dataset.

        Returns
        -------
        xarray.Dataset
            ``global_integrity`` and ``integrity_factor`` over amplitude, ``safe`` over amplitude,
            velocity (du/d(pt)) and angle; the heteroclinic amplitude, where there is a closed form
            of it, among the attributes.
        """
        dataset: xarray.Dataset = words_module(Erosion).erosion_dataset(self)
        return dataset

    def __repr__(self) -> str:
        """Return one line, without the drops."""
        return f"<Erosion: {words_module(Erosion).erosion_headline(self)}>"


@checked
def compute_erosion(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion,
    amplitudes: ArrayLike,
    *,
    angles: ArrayLike | None = None,
    velocities: ArrayLike | None = None,
    cycles: int = CYCLES,
    model: ModelChoice = None,
    run: Execution | None = None,
) -> Erosion:
    """Compute the erosion of the safe basin as the amplitude of the base motion grows.

    A state is safe if the block, shaken from that moment on, has not overturned in a number of
    forcing periods; whether it rocks or rests does not matter.  Two measures of the safe basin are
    given, both over their value on a still base.  The *global integrity measure* is its area [1]_,
    in which fractal tongues count in full.  The *integrity factor* is the radius of the largest
    circle of safe states [2]_ in the plane of u = theta/alpha and du/d(pt): it sees the compact
    core alone.  For the rocking block erosion is discussed in [3]_.

    For a block against a wall there are states at angles above 0 alone, and the circle ends there.

    The safe basin on a still base is a strip without end, so that the area depends on the window,
    whose edge does not count as safe.  A radius is known to about a cell.  Where shaking moves more
    of the strip into the window, or the circle by a part of a cell, the measures stay 1: nothing is
    eroded.

    Parameters
    ----------
    block
        Its restitution counts, and how its sides differ; in the nonlinear model its slenderness.
    motion
        Its frequency ratio, and its phase when the states are taken; its amplitude is replaced.
    amplitudes
        A = a_max/(alpha g), ascending, shape (amplitudes,).
    angles, velocities
        u, shape (n,), and du/d(pt), shape (m,), evenly spaced.  By default the middles of 200 cells
        up to 1.5 in each (in units of the larger side), or further where the edge would cut the
        largest circle on a still base, as it does with a restitution below .6.
    cycles
        Forcing periods that a safe state stands (default 100).
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.
    run
        Executor, store and progress, as for `evaluate`; the still base is cells too.

    Returns
    -------
    Erosion
        Both measures, and the safe basins themselves.

    Raises
    ------
    InputError, ModelError, OutputError, UnfinishedError
        If an argument is outside its range, no state is safe on a still base, or as for `evaluate`.

    References
    ----------
    .. [1] M. S. Soliman and J. M. T. Thompson, J. Sound Vib. 135, 453-475 (1989).
    .. [2] G. Rega and S. Lenci, Nonlinear Analysis 63, 902-914 (2005).
    .. [3] S. Lenci and G. Rega, Int. J. Bifurcation Chaos 15, 1901-1918 (2005).

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic
    >>> motion = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    >>> erosion = compute_erosion(DimensionlessBlock(restitution=0.9), motion, [0.2, 0.6, 1.0])
    >>> print(erosion.global_integrity.round(2), erosion.integrity_factor.round(2))
    [0.99 0.79 0.46] [1.   0.62 0.42]
    """
    how = Execution() if run is None else run
    block.dimensionless()  # refuses sides too unlike
    axis = Axis(name="amplitudes", values=amplitudes, long_name="a_max/(alpha g)")
    given_motion = periodic_motion(motion)
    ratio = given_motion.frequency_ratio
    validated_grid(axis.points, ratio, 1.0, 1)  # the block has its restitutions
    equations = chosen_model(model, block)
    sides = equations.sides(block)
    if (np.diff(axis.points) <= 0.0).any():
        raise InputError(
            "amplitudes",
            amplitudes,
            "the amplitudes must ascend",
            "give them from the lowest to the highest",
        )
    reach = _least_half_width(sides)
    if angles is None and velocities is None:
        reach = _half_width(sides, replace(how, store=None, progress=None))
    half, rest = moment(given_motion)
    angle, velocity = window_axes(block, angles, velocities, (reach, reach))
    # The still base is one more amplitude, unless it is among those given.
    given = axis.points
    all_of_them = given if given[0] == 0.0 else np.concatenate([[0.0], given])
    start, count = half * math.pi + rest, FORCING_PERIODS("cycles", cycles)
    safe = safe_states(
        sides=sides,
        frequency_ratio=ratio,
        phase=start,
        amplitudes=all_of_them,
        angles=angle.points,
        velocities=velocity.points,
        cycles=count,
        run=how,
        harmonics=harmonics_of(given_motion),
    )
    shares, radii = np.array([measured(states, angle.points, velocity.points) for states in safe]).T
    if shares[0] == 0.0:
        raise ModelError(
            "angles",
            angles,
            "no state of this window stands on a still base",
            "give a window around u = 0, du/d(pt) = 0, or of angles near 0 against a wall",
        )
    shaken = slice(len(safe) - len(given), None)
    return Erosion(
        block=block,
        motion=replace(given_motion, phase=start),
        amplitude=given,
        angle=angle.points,
        velocity=velocity.points,
        cycles=count,
        safe=safe[shaken],
        safe_share=shares[shaken],
        radius=radii[shaken],
        still_share=float(shares[0]),
        still_radius=float(radii[0]),
        model=equations,
    )


def _least_half_width(sides: Floats) -> float:
    """Return how far a window reaches at least: in units of the larger side, where they differ."""
    widths = sides[:, LEAN] * np.maximum(sides[:, RATE], 1.0)
    return HALF_WIDTH * float(widths.max())


def _half_width(sides: Floats, run: Execution) -> float:
    """Return how far a window reaches whose edge does not cut the largest safe circle at A = 0."""
    width = _least_half_width(sides)
    radius = _still_radius(width, sides, run)
    while width < WIDEST:
        wider = WIDENING * width
        still_radius = _still_radius(wider, sides, run)
        if still_radius <= radius + 2.0 * wider / POINTS:  # the same circle to within a cell
            break
        width, radius = wider, still_radius
    return width


def _still_radius(width: float, sides: Floats, run: Execution) -> float:
    """Return the radius of the largest safe circle on a still base, in a square window."""
    velocities = centred(width)
    angles = against_wall(width) if only_side(sides) > 0 else velocities
    safe = safe_states(
        sides=sides,
        frequency_ratio=1.0,
        phase=0.0,
        harmonics=(),
        amplitudes=[0.0],
        angles=angles,
        velocities=velocities,
        cycles=CYCLES,
        run=run,
    )
    return measured(safe[0], angles, velocities)[1]
