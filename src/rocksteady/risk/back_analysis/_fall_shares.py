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

from rocksteady.arrays import Floats
from rocksteady.kernels.core.scatter import LARGEST_KEY
from rocksteady.model.equations import Model, ModelChoice, chosen_model
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
from rocksteady.seismic.spectra.grounds import check_grounds, extremes_of
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

    def mirrored(self) -> "Pool":
        """Return the draws with their sides exchanged."""
        return Pool(sides=self.sides[:, ::-1].copy(), gravity=self.gravity)


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
        Draws of each object under the shaking as it is.
    other
        Number of the object's own draws under the shaking of the other sign among `turned`; -1
        where the sign does not matter.
    turned
        Draws of the objects for which it does.
    lowest, highest
        Smallest and largest uplift acceleration of any draw [m/s^2].
    slowest
        Smallest p of any draw [rad/s].
    """

    each: tuple[Pool, ...]
    other: tuple[int, ...]
    turned: tuple[Pool, ...]
    lowest: float
    highest: float
    slowest: float
    extremes: tuple[Any, Any]


def draw_objects(survey: Survey, model: Model, *, count: int, seed: int) -> Pools:
    """Return the draws of all objects: points that fill the prior evenly, shifted by the seed."""
    each: list[Pool] = []
    partners: list[int] = []
    turned: list[Pool] = []
    bodies = []
    for place, (prior, facing) in enumerate(zip(survey.objects, survey.facings, strict=True)):
        values = prior.draw(_shares(prior, place, count, seed))
        blocks = prior.blocks(values)
        sides = np.stack([sides_in_si(block, model) for block in blocks])
        number = place * count + np.arange(count)
        keys = (uniform(seed, number, 2)[:, 1] * LARGEST_KEY).astype(np.int64)
        pool = Pool(
            sides=scattered_sides(sides, prior.scatter_of(values), keys),
            gravity=blocks[0].gravity,
        )
        bodies += blocks
        if facing is None:
            pool_sides = pool.sides.copy()
            pool_sides[1::2] = pool_sides[1::2, ::-1]
            each.append(Pool(sides=pool_sides, gravity=pool.gravity))
            partners.append(-1)
        else:
            ahead, back = (pool.mirrored(), pool) if facing else (pool, pool.mirrored())
            each.append(ahead)
            partners.append(len(turned))
            turned.append(back)
    uplifts = [block.uplift_acceleration for block in bodies]
    return Pools(
        each=tuple(each),
        other=tuple(partners),
        turned=tuple(turned),
        lowest=min(uplifts),
        highest=max(uplifts),
        slowest=min(block.p for block in bodies),
        extremes=extremes_of(bodies),
    )


def fall_shares(
    pools: Pools,
    grounds: Sequence[GroundShaking],
    names: Sequence[str],
    scales: Floats,
    *,
    draws: int,
    model: Model,
    run: Execution | None,
) -> Floats:
    """Return the share of draws that fall.

    Parameters
    ----------
    pools
        The objects.
    grounds, names
        The records and their names.
    scales
        Factor of each record at each level, shape (records, levels).
    draws
        Number of draws at each scale.
    model, run
        As for `back_analyse`.

    Returns
    -------
    numpy.ndarray
        Of both halves of the draws, shape (2, objects, signs, records, levels); one sign where it
        matters for no object.
    """
    check_grounds(grounds, scales.max(axis=1).tolist(), pools.extremes, model)
    everything = (*pools.each, *pools.turned)
    items = [
        Scaled(ground=ground, number=place, factors=scales[place])
        for place, ground in enumerate(grounds)
    ]
    grid = Grid(
        axes=(
            Axis(name="ground", values=list(names), long_name="record", items=items),
            Axis(name="level", values=np.arange(scales.shape[1]), long_name="level"),
            Axis(
                name="pool",
                values=[f"object {place + 1}" for place in range(len(everything))],
                long_name="object",
                items=everything,
            ),
            Axis(name="draw", values=np.arange(draws), long_name="draw"),
        )
    )
    load_kernel(model)
    cells = compute_cells(
        functools.partial(_fates, draws=draws),
        grid,
        (Output(name="fell", dtype=np.int8, long_name="whether it fell"),),
        run=run,
        attributes={"model": model.name},
    )
    fell = cells["fell"].transpose("draw", "pool", "ground", "level").values
    # Neighbouring draws fill the prior evenly, so that both halves do.
    shares = np.stack([fell[: draws // 2].mean(axis=0), fell[draws // 2 :].mean(axis=0)])
    ahead = shares[:, : len(pools.each)]
    if not pools.turned:
        return np.asarray(ahead[:, :, np.newaxis], dtype=np.float64)
    places = [
        place if partner < 0 else len(pools.each) + partner
        for place, partner in enumerate(pools.other)
    ]
    return np.stack([ahead, shares[:, places]], axis=2)


def model_of(survey: Survey, model: ModelChoice) -> Model:
    """Return the equations of motion: the full ones by default."""
    first = survey.objects[0]
    body = first.blocks(first.draw(np.full((1, len(first.parameters)), 0.5)))[0]
    return chosen_model(model, body)


def _fates(
    ground: NDArray[np.object_],
    level: Floats,
    pool: NDArray[np.object_],
    draw: Floats,
    *,
    draws: int,
) -> dict[str, NDArray[Any]]:
    """Return which draws fall, of some cells.

    Each scale takes other draws of the pool, and so does each record, so that neighbours together
    cover more of the prior than each.
    """
    cells = zip(ground, level.astype(np.int64).tolist(), pool, draw.tolist(), strict=True)
    places = [
        ((at + 5 * scaled.number) * draws + int(shift)) % len(each.sides)
        for scaled, at, each, shift in cells
    ]
    at = level.astype(np.int64)
    records, numbers = told_apart(ground)
    fates = shaken_fates(
        [scaled.ground for scaled in records],
        ground=numbers,
        scale=np.stack([scaled.factors for scaled in records])[numbers, at],
        sides=np.stack([each.sides[k] for each, k in zip(pool, places, strict=True)]),
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
