"""How often the draws of each object fall: every record at every level, from rest.

A shaking of the other sign is the mirror image of the object under the shaking as it is: sides are
exchanged, no record is reversed.  An object of unknown facing has every second draw mirrored.
"""

import functools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats, Integers, Objects
from rocksteady.kernels.core.scatter import LARGEST_KEY
from rocksteady.model.blocks.block import Block
from rocksteady.model.equations import Model
from rocksteady.outcomes import Status
from rocksteady.risk.back_analysis.survey import Survey
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.seismic.spectra.batch import (
    GroundShaking,
    load_kernel,
    scattered_sides,
    shaken_fates,
    sides_in_si,
    told_apart,
)
from rocksteady.seismic.spectra.grounds import check_grounds, extremes_of, names_of
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.draws import uniform
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.outputs import Output
from rocksteady.sweep.evaluate import compute_cells
from rocksteady.sweep.run import Execution

POOL = 64
"""Fewest draws of an object, of which each scale takes some in turn."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Pool:
    """Draws of one object, facing one way.

    Attributes
    ----------
    sides
        As `scattered_sides` has them, shape (draws, 2, 7).
    gravity
        Acceleration of gravity of the object [m/s^2].
    """

    sides: Floats
    gravity: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Scaled:
    """A record, its number from 0, and its factor at each level, shape (levels,)."""

    ground: GroundShaking
    number: int
    factors: Floats


@dataclass(frozen=True, kw_only=True, eq=False)
class Pools:
    """Draws of all objects of a survey.

    Attributes
    ----------
    each
        Draws of each object under the shaking as it is, and then under that of the other sign where
        it matters.
    places
        Number of the draws of each object under each sign, shape (objects, signs); one sign where
        it matters for no object.
    blocks
        The blocks of all draws.
    model
        Equations of motion.
    """

    each: tuple[Pool, ...]
    places: Integers
    blocks: tuple[Block, ...]
    model: Model


def draw_objects(survey: Survey, model: Model, *, count: int, seed: int) -> Pools:
    """Return the draws of all objects: points that fill the prior evenly, shifted by the seed."""
    each: list[Pool] = []
    turned: list[Pool] = []
    blocks: list[Block] = []
    places = np.repeat(np.arange(len(survey))[:, np.newaxis], 2, axis=1)
    for place, (prior, facing) in enumerate(zip(survey.objects, survey.facings, strict=True)):
        values = prior.draw(_shares(prior, place, count, seed))
        drawn = prior.blocks(values)
        blocks += drawn
        number = place * count + np.arange(count)
        keys = (uniform(seed, number, 2)[:, 1] * LARGEST_KEY).astype(np.int64)
        plain = np.stack([sides_in_si(block, model) for block in drawn])
        sides = scattered_sides(plain, prior.scatter_of(values), keys)
        mirrored = sides[:, ::-1].copy()
        if facing is None:
            sides[1::2] = mirrored[1::2]
        else:
            sides, opposite = (mirrored, sides) if facing else (sides, mirrored)
            places[place, 1] = len(survey) + len(turned)
            turned.append(Pool(sides=opposite, gravity=drawn[0].gravity))
        each.append(Pool(sides=sides, gravity=drawn[0].gravity))
    return Pools(
        each=(*each, *turned),
        places=places if turned else places[:, :1],
        blocks=tuple(blocks),
        model=model,
    )


def fall_shares(
    pools: Pools,
    grounds: Sequence[GroundShaking],
    scales: Floats,
    *,
    draws: int,
    run: Execution | None,
) -> Floats:
    """Return the share of draws that fall.

    Parameters
    ----------
    pools
        The objects.
    grounds
        The records.
    scales
        Factor of each record at each level, shape (records, levels).
    draws
        Number of draws at each scale.
    run
        As for `back_analyse`.

    Returns
    -------
    numpy.ndarray
        Of both halves of the draws, shape (2, objects, signs, records, levels); one sign where it
        matters for no object.
    """
    check_grounds(grounds, scales.max(axis=1).tolist(), extremes_of(pools.blocks), pools.model)
    items = [
        Scaled(ground=ground, number=place, factors=scales[place])
        for place, ground in enumerate(grounds)
    ]
    names = names_of(ground.record for ground in grounds)
    objects = [f"object {place + 1}" for place in range(len(pools.each))]
    axes = (
        Axis(name="ground", values=names, long_name="record", items=items),
        Axis(name="level", values=np.arange(scales.shape[1]), long_name="level"),
        Axis(name="pool", values=objects, long_name="object", items=pools.each),
        Axis(name="draw", values=np.arange(draws), long_name="draw"),
    )
    load_kernel(pools.model)
    cells = compute_cells(
        functools.partial(_fates, draws=draws),
        Grid(axes=axes),
        (Output(name="fell", dtype=np.int8, long_name="whether it fell"),),
        run=run,
        attributes={"model": pools.model.name},
    )
    fell = cells["fell"].transpose("draw", "pool", "ground", "level").values
    # Neighbouring draws fill the prior evenly, so that both halves do.
    shares = np.stack([fell[: draws // 2].mean(axis=0), fell[draws // 2 :].mean(axis=0)])
    return np.asarray(shares[:, pools.places], dtype=np.float64)


def _fates(
    ground: Objects, level: Floats, pool: Objects, draw: Floats, *, draws: int
) -> dict[str, NDArray[Any]]:
    """Return which draws fall, of some cells.

    Each scale takes other draws of the pool, and so does each record, so that neighbours together
    cover more of the prior than each.
    """
    at = level.astype(np.int64)
    records, numbers = told_apart(ground)
    shifts = at + 5 * np.array([scaled.number for scaled in records])[numbers]
    places = (shifts * draws + draw.astype(np.int64)).tolist()
    fates = shaken_fates(
        [scaled.ground for scaled in records],
        ground=numbers,
        scale=np.stack([scaled.factors for scaled in records])[numbers, at],
        sides=np.stack(
            [each.sides[k % len(each.sides)] for each, k in zip(pool, places, strict=True)]
        ),
        gravity=np.array([each.gravity for each in pool]),
        peaks=False,
    )
    return {"fell": (fates.status == int(Status.OVERTURNED)).astype(np.int8)}


def _shares(prior: ObjectPrior, place: int, count: int, seed: int) -> Floats:
    """Return points that fill the unit cube evenly: Kronecker's sequence, shifted.

    Its steps are powers of 1/g, g the root of ``x^(k+1) = x + 1`` (M. Roberts, 2018).
    """
    size = len(prior.parameters)
    root = 2.0
    for _ in range(60):
        root = (1.0 + root) ** (1.0 / (size + 1.0))
    steps = root ** -np.arange(1.0, size + 1.0)
    shift = uniform(seed, np.array([2**40 + place]), max(size, 1))[:, :size]
    return np.asarray((shift + np.arange(count)[:, np.newaxis] * steps) % 1.0)
