"""Fates of a block under a base motion with noise on top, over levels of both and realisations."""

import functools
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.batch.finite import OUTPUTS, Fate, collected, fate_of, finite_table
from rocksteady.dynamics.history.start import (
    HasStart,
    Rest,
    State,
    refuse_behind_wall,
    start_without_phase,
)
from rocksteady.errors import InputError
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.motions import fill_bounds
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.confidence import (
    Confidence,
    share_interval,
)
from rocksteady.model.checks.validation import LARGEST, in_range, whole_number
from rocksteady.model.equations import Linear, Model, ModelChoice, chosen_model
from rocksteady.model.linear_tables import segment_table
from rocksteady.model.motions.band_noise import BandNoise, finite, with_lines
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.segments import Motion, Still
from rocksteady.model.nonlinear_tables import lifted_table
from rocksteady.outcomes import Status
from rocksteady.results.numbers import CONFIDENCE
from rocksteady.results.result import Result, words_module
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.evaluate import compute_cells
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray


AXES = {"level": "factor of the noise", "scale": "factor of the motion"}
"""What may be moved, in words."""
DRAWS = 100
MOST_DRAWS = 100_000
BATCH = 64
"""The most motions of one call; each has a table of its own."""
ORDER = (
    columns.DURATION,
    columns.CONSTANT,
    columns.SLOPE,
    columns.AMPLITUDE,
    columns.FREQUENCY,
    columns.PHASE,
    columns.JUMP,
)
"""Columns of a table that `rocksteady.model.motions.band_noise.with_lines` has, in its order."""

SIZED = (columns.JUMP, columns.CONSTANT, columns.SLOPE, columns.AMPLITUDE)
"""Columns by which a motion is strong or weak."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class NoiseFates(Result):
    """Fates under a base motion with noise, over levels of both and realisations of the noise.

    Attributes
    ----------
    block, motion, noise
        Block, base motion and noise; realisation i of the noise has its number i.
    start
        `Rest` or `State` at pivot time 0.
    scale
        Factors of the motion, shape (scales,).
    level
        Factors of the rms of the noise, shape (levels,).
    fate
        Code of `Status` with which each run ends, shape (scales, levels, draws).
    side
        Side to which the block overturns, 1 or -1; 0 where it does not.
    impacts
        Impacts until the end, as `Impacts` counts them.
    peak
        Largest |theta|/alpha, until overturning.
    model
        Which equations of motion hold: `Linear` or `Nonlinear`.
    """

    block: Block | DimensionlessBlock
    motion: Motion | Record | BaseMotion
    noise: BandNoise
    start: Rest | State
    scale: Floats
    level: Floats
    fate: NDArray[np.int8]
    side: NDArray[np.int8]
    impacts: NDArray[np.int64]
    peak: Floats
    model: Model = field(default_factory=Linear)

    @property
    def draws(self) -> int:
        """Realisations of the noise at each level."""
        return int(self.fate.shape[2])

    @property
    def rms(self) -> Floats:
        """Rms of the noise in units of alpha g, shape (levels,)."""
        rms: Floats = self.level * self.noise.rms
        return rms

    @cached_property
    def overturned(self) -> NDArray[np.int64]:
        """Number of realisations under which the block overturns, shape (scales, levels)."""
        count: NDArray[np.int64] = (self.fate == Status.OVERTURNED).sum(axis=2)
        return count

    @property
    def share(self) -> Floats:
        """Share of the realisations under which the block overturns, shape (scales, levels)."""
        share: Floats = self.overturned / self.draws
        return share

    def interval(self, confidence: Confidence = CONFIDENCE) -> tuple[Floats, Floats]:
        """Return Wilson's score interval of the probability of overturning.

        One realisation is a trial at every level.  At level 0 all trials are one, and the interval
        is that share itself.

        Parameters
        ----------
        confidence
            Confidence of the interval, in (0, 1); default 0.9.

        Returns
        -------
        tuple of ndarray
            Its lower and its upper end, shape (scales, levels) each.

        Raises
        ------
        InputError
            If the confidence is outside its range.
        """
        ends = np.stack(share_interval(self.share, self.draws, confidence))
        ends[:, :, self.rms == 0.0] = self.share[np.newaxis, :, self.rms == 0.0]
        return ends[0], ends[1]

    def to_dataset(self) -> "xarray.Dataset":
        """Return the fates as an xarray Dataset over scale, level and draw.

        Returns
        -------
        xarray.Dataset
            ``fate`` with flags, ``side``, ``impacts`` and ``peak`` over all three; ``share`` with
            ``share_low`` and ``share_high`` of the 90 % interval over scale and level; ``rms`` over
            level [alpha g].
        """
        dataset: xarray.Dataset = words_module(NoiseFates).fates_dataset(self)
        return dataset


@checked
def compute_noise_fates(
    block: Block | DimensionlessBlock,
    motion: Motion | Record | BaseMotion,
    noise: BandNoise,
    *,
    axes: Mapping[str, ArrayLike],
    draws: int = DRAWS,
    start: Rest | State | HasStart | None = None,
    model: ModelChoice = None,
    run: Execution | None = None,
) -> NoiseFates:
    """Compute the share of realisations of noise under which a block overturns.

    Every run is that of `simulate` under ``add_noise(scaled motion, noise.realisation(i))``.  All
    levels and scales share the realisations 0 to draws - 1, so that the shares differ by them alone
    and not by chance; more draws begin with the same.

    Parameters
    ----------
    block
        The block.
    motion
        Any base motion, as for `add_noise`; `Still()` for noise alone.
    noise
        The noise at level 1.
    axes
        ``level``, factors of the noise's rms, ``scale``, factors of the motion, or both, from 0 to
        1e50; 1 of what is left out.
    draws
        Realisations of the noise (default 100).
    start
        `Rest` (default) or `State`, at pivot time 0.
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.
    run
        Executor, store and progress, as for `evaluate`.

    Returns
    -------
    NoiseFates
        Fates and peaks; shares with Wilson's interval.

    Raises
    ------
    InputError, ModelError, OutputError, UnfinishedError
        If an axis is unknown, a number is outside its range, or as for `simulate` and `add_noise`.

    Examples
    --------
    A pulse that the block survives alone, and with noise less and less often:

    >>> from rocksteady import DimensionlessBlock, Pulse, compute_noise_fates
    >>> from rocksteady.motions import BandNoise
    >>> fates = compute_noise_fates(
    ...     DimensionlessBlock(restitution=0.9),
    ...     Pulse(shape="one-sine", amplitude=5.0, frequency_ratio=4.0),
    ...     BandNoise(rms=1.0, band=(0.5, 10.0), duration=15.0, seed=1),
    ...     axes={"level": [0.0, 0.05, 0.1, 0.2]},
    ...     draws=40,
    ... )
    >>> print(fates.overturned)
    [[ 0  1 14 23]]
    """
    chosen = chosen_model(model, block)
    begun = start_without_phase(start)
    moved = _axes(axes)
    hint = "give a number of realisations, as 100"
    count = whole_number("draws", draws, at_least=1, at_most=MOST_DRAWS, hint=hint)
    state = (begun.angle, begun.velocity) if isinstance(begun, State) else (0.0, 0.0)
    refuse_behind_wall(block, *state)
    base = motion if isinstance(motion, BaseMotion) else BaseMotion(motion)
    if not isinstance(base.horizontal, Record):
        base = BaseMotion(finite(base.horizontal, noise), base.vertical)
    finite_table(base, block, chosen)  # refused here, before anything is computed
    vertical = None if base.vertical is None else _plain(base.vertical)
    data = compute_cells(
        functools.partial(
            _fates,
            block=block,
            across=_plain(base.horizontal),
            vertical=vertical,
            noise=noise,
            model=chosen,
            start=state,
        ),
        # Cells of one realisation follow each other, so that it is made once.
        Grid(axes=(Axis(name="draw", values=np.arange(count, dtype=np.float64)), *moved)),
        OUTPUTS,
        run=run,
        batch=BATCH,
    )
    cells: dict[str, NDArray[Any]] = {
        str(name): np.moveaxis(data[str(name)].values, 0, -1) for name in data.data_vars
    }
    return NoiseFates(
        block=block,
        motion=motion,
        noise=noise,
        start=begun,
        scale=moved[0].points,
        level=moved[1].points,
        model=chosen,
        **cells,
    )


def _axes(axes: Mapping[str, ArrayLike]) -> tuple[Axis, Axis]:
    """Return the axes of scales and of levels."""
    given: object = axes
    if not isinstance(given, Mapping) or not axes or set(axes) - set(AXES):
        raise InputError(
            "axes",
            given,
            "it names level, scale or both, each with its values",
            'give a mapping, as {"level": [0.0, 0.1, 0.2]}',
        )
    scale, level = (
        Axis(name=name, values=np.atleast_1d(axes.get(name, 1.0)), long_name=AXES[name])
        for name in ("scale", "level")
    )
    for axis in (scale, level):
        for end in (axis.points.min(), axis.points.max()):
            in_range(axis.name, end, 0.0, LARGEST, "[]", hint="give factors of 0 or above")
    return scale, level


def _fates(
    draw: Floats,
    scale: Floats,
    level: Floats,
    *,
    block: Block | DimensionlessBlock,
    across: Record | Floats,
    vertical: Record | Floats | None,
    noise: BandNoise,
    model: Model,
    start: tuple[float, float],
) -> dict[str, NDArray[Any]]:
    """Return the fates under some realisations.

    Components of the motion are records, which are scaled in their own units, or tables.
    """
    sides = model.sides(block)
    scaled: dict[float, tuple[Floats, Floats | None]] = {}
    alone: dict[float, Fate] = {}
    fates = []
    for factor, share, which in zip(scale.tolist(), level.tolist(), draw.tolist(), strict=True):
        if factor not in scaled:
            lifting = None if vertical is None else _scaled(vertical, factor, block)
            scaled[factor] = _scaled(across, factor, block), lifting
        table, lifted = scaled[factor]
        rms = share * noise.rms
        if rms == 0.0 and factor in alone:
            fates.append(alone[factor])
            continue
        summed = _with_noise(table, noise.realisation(int(which), rms=rms)) if rms else table
        if isinstance(block, Block) and columns.is_nonlinear(sides):
            summed = lifted_table(summed, lifted, block.positive.alpha)
        fates.append(fate_of(summed, sides, *start))
        if rms == 0.0:
            alone[factor] = fates[-1]
    return collected(fates)


def _plain(part: Motion | Record) -> Record | Floats:
    """Return a record as it is, and the table of any other component."""
    return part if isinstance(part, Record) else segment_table(part)


def _scaled(part: Record | Floats, factor: float, block: Block | DimensionlessBlock) -> Floats:
    """Return the table of a component of the motion times a factor; of 0 a still base."""
    if factor == 0.0:
        return segment_table(Still())
    if isinstance(part, Record):
        return segment_table(part.scaled(factor), block)
    table = part.copy()
    table[:, SIZED] *= factor
    fill_bounds(table)
    return table


def _with_noise(table: Floats, noise: BandNoise) -> Floats:
    """Return the table of a motion with noise: to the last bit that of `add_noise`."""
    summed = with_lines(table[:, ORDER], noise.samples, noise.step)
    segments = np.zeros((len(summed), columns.SEGMENT_COLUMNS))
    segments[:, ORDER] = summed
    fill_bounds(segments)
    return segments
