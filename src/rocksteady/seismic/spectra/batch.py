"""Batch response of blocks of any size to one record, from one table for all blocks.

The tables are in seconds and m/s^2, with vertical motion in g, and serve every block: a block is
its uplift acceleration and its p.  Horizontal motion is scaled by dividing the uplift acceleration,
vertical motion in its columns of the table.

A cell is the march of `rocksteady.simulate` from the same samples: status and impacts are equal,
peaks agree to `PEAKS_AGREE_TO`.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats, Integers
from rocksteady.dynamics.batch.left_over import run_left_over
from rocksteady.dynamics.history.samples import COUNTED_IMPACTS
from rocksteady.dynamics.history.simulate import FLIGHT_LIMIT
from rocksteady.errors import InputError
from rocksteady.kernels.batch.base_forces import record_forces
from rocksteady.kernels.batch.records import record_fates
from rocksteady.kernels.core import tables
from rocksteady.kernels.core.queue import LEFT_OVER
from rocksteady.kernels.core.scatter import LARGEST_DEVIATION, LARGEST_KEY
from rocksteady.kernels.core.tables import is_nonlinear
from rocksteady.kernels.core.tuples import Blocks, PeakFates
from rocksteady.kernels.devices import run_cells
from rocksteady.kernels.march.facts import ELASTIC_TIME, LONGEST_REST
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.housner_forms import Impacts, Restitution
from rocksteady.model.blocks.sides import Side, housner_ratio, wall_ratio
from rocksteady.model.equations import Model
from rocksteady.model.linear_tables import record_table
from rocksteady.model.motions.record import Record
from rocksteady.model.nonlinear_tables import lifted_table
from rocksteady.outcomes import Status
from rocksteady.sweep.cases.draws import uniform
from rocksteady.sweep.cases.outputs import Output

SpectrumRestitution = Restitution | tuple[Literal["wall"], Restitution]
"""Restitution of free blocks, or as ("wall", 0.5) that of a wall that they stand against."""

PEAKS_AGREE_TO = 1e-12
"""Part to which the peaks of a cell are those of its single run, whose table is in units of the
block: times one and the run's growth (`rocksteady.histories.Trajectory.growth`)."""
DIGITS = 53
"""Binary digits of a uniform number, and of the key that is made of it."""

OUTPUTS = (
    Output(
        name="status",
        dtype=np.int8,
        long_name="how it ended",
        flags={int(status): status.label for status in Status},
    ),
    Output(name="peak_angle", long_name="largest |theta|/alpha"),
    Output(name="peak_velocity", long_name="largest |d(theta/alpha)/d(p t)|"),
    Output(name="impacts", dtype=np.int64, long_name=COUNTED_IMPACTS),
)


@dataclass(frozen=True, kw_only=True)
class GroundShaking:
    """What shakes a base: a horizontal record, and a vertical one where there is any.

    Parameters
    ----------
    record, vertical
        The records, both from the same moment on.
    """

    record: Record
    vertical: Record | None = None


class Fared(NamedTuple):
    """How blocks fared, arrays of shape (cells,)."""

    status: Integers
    """Codes of `rocksteady.Status`."""
    impacts: Integers
    """As `rocksteady.histories.Impacts` counts them."""
    peak_angle: Floats
    """Largest |theta|/alpha, as in `rocksteady.histories.Trajectory.peak`."""
    peak_velocity: Floats
    """Largest |d(theta/alpha)/d(p t)|, as in `rocksteady.histories.Trajectory.peak_velocity`."""


def shaken_fates(
    grounds: Sequence[GroundShaking],
    *,
    ground: Integers,
    scale: Floats,
    sides: Floats,
    gravity: Floats,
    peaks: bool = True,
) -> Fared:
    """Return how blocks fare that are at rest when the ground begins to shake.

    Each is followed to rest or proven overturning, without loss (restitution 1) for p t = 1e4 on
    the still base.  A cell's answer depends on nothing but the cell; those on the same shaking
    share its table.

    Parameters
    ----------
    grounds
        What shakes the bases.
    ground
        Number of each cell's shaking in `grounds`, shape (cells,).
    scale
        What its accelerations are multiplied by, above 0, shape (cells,).
    sides
        Sides of the blocks, as from `sides_in_si` or `scattered_sides`, shape (cells, 2, 3),
        (cells, 2, 5) or (cells, 2, 7), all of one model.
    gravity
        Acceleration of gravity [m/s^2], shape (cells,).
    peaks
        Whether the peaks are wanted: without them the march is faster, and they are nan.
    """
    count = len(scale)
    status, impacts = np.empty(count, dtype=np.int64), np.empty(count, dtype=np.int64)
    tops = np.full((count, tables.PEAK_COLUMNS), np.nan)
    for cells, table, blocks in _by_table(grounds, ground, scale, sides, gravity):
        fates = _room(len(cells), tables.PEAK_COLUMNS if peaks else 0)
        run_cells(record_fates, table, blocks, FLIGHT_LIMIT, fates)
        status[cells], impacts[cells] = fates.status, fates.impacts
        if peaks:
            tops[cells] = fates.peaks
        left = fates.status == LEFT_OVER
        if left.any():  # what a device has no room for
            fates = _room(int(left.sum()), tables.PEAK_COLUMNS)
            some = Blocks(*(each[left] for each in blocks))
            run_left_over(record_fates, table, some, FLIGHT_LIMIT, fates)
            status[cells[left]], impacts[cells[left]], tops[cells[left]] = fates
    return Fared(status, impacts, tops[:, tables.PEAK_ANGLE], tops[:, tables.PEAK_SPEED])


def shaken_forces(
    grounds: Sequence[GroundShaking],
    *,
    ground: Integers,
    scale: Floats,
    sides: Floats,
    gravity: Floats,
    centres: Floats,
) -> Floats:
    """Return the largest force on the base over the weight, across and down, shape (cells, 2).

    Both are those of `rocksteady.histories.Trajectory.forces_per_weight` of a single run, and nan
    where the block falls or never rocks.

    Parameters
    ----------
    grounds, ground, scale, sides, gravity
        As for `shaken_fates`.
    centres
        Mass centres of the blocks, as from `model.linear_tables.mass_centres`, shape
        (cells, 2, 2).
    """
    forces = np.empty((len(scale), 2))
    for cells, table, blocks in _by_table(grounds, ground, scale, sides, gravity):
        largest = np.empty((len(cells), 2))
        record_forces(table, blocks, centres[cells], FLIGHT_LIMIT, largest)
        forces[cells] = largest
    return forces


def _by_table(
    grounds: Sequence[GroundShaking],
    ground: Integers,
    scale: Floats,
    sides: Floats,
    gravity: Floats,
) -> Iterator[tuple[Integers, Floats, Blocks]]:
    """Yield the numbers of cells that share a table, the table, and their blocks."""
    side_rows = sides.copy()
    side_rows[:, :, tables.LEAN] /= scale[:, np.newaxis]
    elastic = (np.abs(sides[:, :, tables.RESTITUTION]) == 1.0).all(axis=1)
    afterwards = np.where(elastic, ELASTIC_TIME, LONGEST_REST)
    # Vertical motion is scaled in its table, where it counts in units of gravity.
    lifted = np.array([each.vertical is not None for each in grounds], dtype=np.bool_)[ground]
    for cells in _alike(ground, np.where(lifted, gravity, 1.0), np.where(lifted, scale, 1.0)):
        shaking = grounds[ground[cells[0]]]
        weight = 1.0 if shaking.vertical is None else float(gravity[cells[0]])
        table = _table(shaking, is_nonlinear(side_rows[cells[0]]), weight)
        if shaking.vertical is not None:
            table = table.copy()
            table[:, tables.LIFT :] *= scale[cells[0]]
        yield cells, table, Blocks(side_rows[cells], afterwards[cells])


def _room(count: int, columns: int) -> PeakFates:
    """Return the results of a number of blocks, which a kernel fills."""
    status, impacts = np.empty((2, count), dtype=np.int64)
    return PeakFates(status, impacts, np.empty((count, columns)))


def _alike(*columns: NDArray[Any]) -> list[Integers]:
    """Return the numbers of the cells of each kind: cells that agree in all columns."""
    order = np.lexsort(columns)
    if not len(order):
        return []
    differs = np.zeros(len(order) - 1, dtype=np.bool_)
    for column in columns:
        differs |= column[order[1:]] != column[order[:-1]]
    return np.split(order, np.flatnonzero(differs) + 1)


def told_apart(items: NDArray[np.object_]) -> tuple[list[Any], Integers]:
    """Return the different things of an array, and the number of each cell's among them."""
    things = {id(item): item for item in items}
    places = {key: place for place, key in enumerate(things)}
    return list(things.values()), np.array([places[id(item)] for item in items], dtype=np.int64)


def sides_in_si(block: Block, model: Model) -> Floats:
    """Return a block's sides with alpha g [m/s^2] for lean and p [rad/s] for rate.

    Parameters, errors and shape are those of the model's `sides`.
    """
    sides = model.sides(block)
    sides[:, tables.LEAN] *= block.uplift_acceleration
    sides[:, tables.RATE] *= block.p
    return sides


def rectangles_in_si(
    *,
    alpha: Floats,
    p: Floats,
    restitution: SpectrumRestitution,
    gravity: float,
    model: Model,
) -> Floats:
    """Return the sides of homogeneous rectangles, as `sides_in_si` has them.

    Parameters
    ----------
    alpha, p
        Slenderness [rad] and frequency parameter [rad/s], shape (cells,).
    restitution
        A number, or "housner" for that of each slenderness, or ("housner", factor); the same as
        ("wall", ...) of rectangles against a wall.
    gravity, model
        As for `sides_in_si`, of a block whose gravity this is.
    """
    one_sided, impact = wall_of(restitution)
    pattern = Block.from_p(alpha=0.1, p=1.0, gravity=gravity)
    if one_sided:
        pattern = pattern.against_wall()
    sides = np.repeat(sides_in_si(pattern, model)[np.newaxis], len(alpha), axis=0)
    sides[:, :, tables.LEAN] = (alpha * gravity)[:, np.newaxis]
    sides[:, :, tables.RATE] = p[:, np.newaxis]
    if sides.shape[2] > tables.ALPHA:  # of the nonlinear model
        sides[:, :, tables.ALPHA] = alpha[:, np.newaxis]
    factor = Impacts.of(impact).factor
    ratios = np.full(len(alpha), impact if factor is None else math.nan)
    if factor is not None:
        # One by one: NumPy's sine may round differently by its place in the array.
        ratio = _rectangle_at_wall if one_sided else housner_ratio
        ratios = factor * np.array([ratio(value) for value in alpha.tolist()])
    give_restitutions(sides, ratios[:, np.newaxis])
    return sides


def wall_of(restitution: SpectrumRestitution) -> tuple[bool, Restitution]:
    """Return whether blocks stand against a wall, and the restitution of their impacts."""
    if isinstance(restitution, tuple) and restitution[0] == "wall":
        return True, restitution[1]
    return False, restitution


def _rectangle_at_wall(alpha: float) -> float:
    """Return the restitution of a slender rectangle at a wall, by angular momentum."""
    side = Side(alpha=alpha, radius=0.75, p=1.0, restitution=1.0)
    return wall_ratio(side, side, 1.0)


def give_restitutions(sides: Floats, ratios: Floats) -> None:
    """Write restitutions into sides; for a block against a wall that of the wall.

    Parameters
    ----------
    sides
        Sides of the blocks, as from `sides_in_si`, shape (cells, 2, 3) or more; changed here.
    ratios
        From 0 to 1, shape (cells, 2), or (cells, 1) for both sides; for a block against a wall the
        first counts.
    """
    wall = sides[:, 0, tables.RESTITUTION] <= 0.0
    sides[:, :, tables.RESTITUTION] = ratios
    sides[wall, 0, tables.RESTITUTION] *= -1.0
    sides[wall, 1, tables.RESTITUTION] = 1.0  # never flown


def scattered_sides(sides: Floats, deviation: Floats, keys: Integers) -> Floats:
    """Return sides whose restitution scatters from impact to impact.

    That of an impact is ``mean + deviation z``, z standard normal, drawn again until it lies in
    (0, (1 + mean)/2]; the mean is the side's restitution, or the wall's.  Its draw depends on the
    key and on the number of the impact alone, so that cells with the same key draw the same z.  The
    cut lowers the mean: 0.9 with a deviation of 0.1 becomes 0.849 with 0.070.

    Parameters
    ----------
    sides
        As `sides_in_si` has them, shape (cells, 2, 3) or (cells, 2, 5).
    deviation
        Standard deviation before the cut, from 0 (no scatter) to 1, shape (cells,).
    keys
        Whole numbers from 0 to 2^53 - 1, shape (cells,).

    Returns
    -------
    numpy.ndarray
        Shape (cells, 2, 7).

    Raises
    ------
    InputError
        If a deviation or a key is out of its range.
    """
    if not ((deviation >= 0.0) & (deviation <= LARGEST_DEVIATION)).all():
        raise InputError(
            "deviation",
            deviation,
            f"the standard deviation of a restitution lies between 0 and {LARGEST_DEVIATION:g}",
            "0.05 to 0.1 is what tests show",
        )
    if not ((keys >= 0) & (keys <= LARGEST_KEY)).all():
        raise InputError(
            "keys", keys, "a key is a whole number from 0 to 2^53 - 1", "number the cells from 0"
        )
    scattered = np.zeros((len(sides), 2, tables.SCATTERED_SIDE_COLUMNS))
    scattered[:, :, : sides.shape[2]] = sides
    scattered[:, :, tables.SCATTER] = deviation[:, np.newaxis]
    scattered[:, :, tables.KEY] = keys[:, np.newaxis]
    return scattered


def keys_of(seed: int, numbers: Integers) -> Integers:
    """Return a key of `scattered_sides` for each number, drawn from a seed.

    Parameters
    ----------
    seed
        From 0 to 2^64 - 1.
    numbers
        0 or more, shape (cells,).
    """
    return np.ldexp(uniform(seed, numbers)[:, 0], DIGITS).astype(np.int64)


def load_kernel(model: Model) -> None:
    """Load the kernel, or compile it, so that what is timed afterwards is computation alone."""
    pattern = sides_in_si(Block.from_p(alpha=0.1, p=1.0), model)
    nobody = np.empty((0, *pattern.shape))
    still = Record(acceleration_m_s2=np.array([1.0, 0.0]), dt_s=1.0)
    table = _table(GroundShaking(record=still), is_nonlinear(pattern), 1.0)
    record_fates(table, Blocks(nobody, np.empty(0)), 1, _room(0, tables.PEAK_COLUMNS))


@lru_cache(maxsize=16)
def _table(shaking: GroundShaking, nonlinear: bool, gravity: float) -> Floats:
    """Return the cached table of a shaking, which callers must not change."""
    flat = record_table(shaking.record)
    if not nonlinear:
        return flat
    lifted = None if shaking.vertical is None else record_table(shaking.vertical)
    return lifted_table(flat, lifted, 1.0 / gravity)
