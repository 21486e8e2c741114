"""Cells of an ensemble: which runs are made, how they fare, and where their answers stand."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats, Integers, Objects
from rocksteady.model.blocks.block import Block
from rocksteady.model.equations import Model
from rocksteady.model.linear_tables import mass_centres
from rocksteady.outcomes import Status
from rocksteady.risk.ensemble.qualification import FORCES
from rocksteady.risk.ensemble.restitution_band import RestitutionBand
from rocksteady.seismic.spectra.batch import (
    OUTPUTS,
    GroundShaking,
    give_restitutions,
    keys_of,
    scattered_sides,
    shaken_fates,
    shaken_forces,
    sides_in_si,
    told_apart,
)
from rocksteady.seismic.spectra.grounds import turned_round
from rocksteady.seismic.spectra.many import DIRECTIONS

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True, kw_only=True)
class Way:
    """How a record is run: with which sign, and with its vertical component or without.

    Attributes
    ----------
    shaking
        What shakes the base.
    record
        Number of the record, from 0.
    direction, lift
        As in the coordinates of the result.
    """

    shaking: GroundShaking
    record: int
    direction: str
    lift: str

    def name(self, record: str) -> str:
        """Return a name that no other way has."""
        return f"{record}, {self.direction}, {self.lift} vertical"


@dataclass(frozen=True, kw_only=True)
class Body:
    """A block and its number, from 0."""

    block: Block
    number: int


def ways_to_run(
    grounds: Sequence[GroundShaking], directions: Sequence[str], lifts: Sequence[str]
) -> list[Way]:
    """Return the ways in which records are run; a record has none of its own twice."""
    ways = []
    for lift, direction, (place, ground) in product(lifts, directions, enumerate(grounds)):
        if ground.vertical is None and lift != lifts[0]:
            continue  # what the run without one is
        shaking = ground if lift == "with" else GroundShaking(record=ground.record)
        turned = turned_round(shaking) if direction == DIRECTIONS[1] else shaking
        ways.append(Way(shaking=turned, record=place, direction=direction, lift=lift))
    return ways


def copies_of(grounds: Sequence[GroundShaking], lifts: Sequence[str]) -> NDArray[np.bool_]:
    """Return which runs are copies for want of a vertical component, shape (records, lifts)."""
    flat = [[ground.vertical is None and lift != lifts[0] for lift in lifts] for ground in grounds]
    return np.array(flat)


def fates(
    motion: Objects,
    block: Objects,
    level: Floats,
    draw: Floats,
    cell: Integers,
    *,
    at_one: Floats,
    band: RestitutionBand,
    mirrored_from: str | None,
    model: Model,
    weights_kn: Floats | None,
) -> dict[str, NDArray[Any]]:
    """Return how the blocks of some cells fare.

    Parameters
    ----------
    motion, block, level, draw
        A `Way`, a `Body`, a level and a number of a restitution for each cell, shape (cells,).
    cell
        Numbers of the cells, which key their random numbers.
    at_one
        Measure of the levels of each record as it is, shape (blocks, records).
    band
        The restitutions.
    mirrored_from
        The direction that symmetric blocks are run in, where others are run in both; the mirror
        images are left undecided here.
    model
        The equations of motion.
    weights_kn
        Weights of the blocks [kN], for the forces on their bases; None without forces.
    """
    ways, way = told_apart(motion)
    bodies, body = told_apart(block)
    numbers = np.array([each.number for each in bodies])[body]
    scale = level / at_one[numbers, np.array([each.record for each in ways])[way]]
    sides = np.stack([sides_in_si(each.block, model) for each in bodies])[body]
    ratios = np.stack([band.ratios(each.block) for each in bodies])
    give_restitutions(sides, ratios[body, draw.astype(np.int64)])
    if band.scatter > 0.0:
        keys = keys_of(band.seed, cell.astype(np.int64))
        sides = scattered_sides(sides, np.full(len(sides), band.scatter), keys)
    symmetric = np.array([each.block.symmetric for each in bodies])[body]
    runs = np.array([mirrored_from in (None, each.direction) for each in ways])[way] | ~symmetric
    status = np.full(len(motion), int(Status.UNDECIDED))
    peaks, speeds = np.full((2, len(motion)), np.nan)
    impacts = np.zeros(len(motion), dtype=np.int64)
    shakings = [each.shaking for each in ways]
    gravity = np.array([each.block.gravity for each in bodies])[body]

    def shaken(cells: NDArray[np.bool_]) -> dict[str, Any]:
        """Return what shakes some cells."""
        given = {"ground": way, "scale": scale, "sides": sides, "gravity": gravity}
        return {name: values[cells] for name, values in given.items()}

    ends = shaken_fates(shakings, **shaken(runs))
    status[runs], peaks[runs], impacts[runs] = ends.status, ends.peak_angle, ends.impacts
    speeds[runs] = ends.peak_velocity
    columns: dict[str, NDArray[Any]] = dict(
        zip((output.name for output in OUTPUTS), (status, peaks, speeds, impacts), strict=True)
    )
    if weights_kn is not None:
        rocks = (status != int(Status.OVERTURNED)) & (peaks > 0.0)
        centres = np.stack([mass_centres(each.block) for each in bodies])[body]
        forces = np.full((len(motion), 2), np.nan)
        forces[rocks] = shaken_forces(shakings, **shaken(rocks), centres=centres[rocks])
        columns |= dict(zip(FORCES, (forces * weights_kn[numbers, np.newaxis]).T, strict=True))
    return columns


def whole(
    swept: "xarray.Dataset",
    ways: Sequence[Way],
    bodies: Sequence[Block],
    directions: Sequence[str],
    lifts: Sequence[str],
) -> dict[str, NDArray[Any]]:
    """Return the runs over block, record, direction, vertical, draw and level.

    Runs that were not made are copied: mirror images, and those of records without a vertical
    component.
    """
    places = {(way.record, way.direction, way.lift): place for place, way in enumerate(ways)}
    records = range(1 + max(way.record for way in ways))
    symmetric = np.array([block.symmetric for block in bodies])
    made = {way.direction for way in ways}

    def source(record: int, direction: str, lift: str, *, mirror: bool) -> int:
        run = directions[0] if mirror or direction not in made else direction
        return places.get((record, run, lift), places[record, run, lifts[0]])

    cells = list(product(records, directions, lifts))
    index = np.array([[source(*cell, mirror=bool(same)) for cell in cells] for same in symmetric])
    shape = (len(bodies), len(records), len(directions), len(lifts))
    columns = {}
    for name in map(str, swept.data_vars):
        values = swept[name].transpose("block", "motion", "draw", "level").values
        picked = values[np.arange(len(bodies))[:, np.newaxis], index]
        columns[name] = picked.reshape(*shape, *values.shape[2:])
    return columns
