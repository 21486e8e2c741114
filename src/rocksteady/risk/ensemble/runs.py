"""Ensembles: blocks on many records at many levels, restitutions, signs, with vertical motion."""

import functools
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import MASS
from rocksteady.model.equations import Linear, ModelChoice, chosen_model
from rocksteady.model.linear_tables import weight_kn
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.risk.ensemble._cases import Body, copies_of, fates, ways_to_run, whole
from rocksteady.risk.ensemble._labels import labelled, warnings_of
from rocksteady.risk.ensemble.levels import Levels
from rocksteady.risk.ensemble.qualification import FORCE_OUTPUTS, qualification_of
from rocksteady.risk.ensemble.restitution_band import RestitutionBand
from rocksteady.risk.ensemble.uplift import uplift_scales, uplift_times
from rocksteady.risk.ensemble.ways import Ways
from rocksteady.seismic.spectra.batch import OUTPUTS, GroundShaking, load_kernel
from rocksteady.seismic.spectra.grounds import (
    check_grounds,
    extremes_of,
    grounds_of,
    is_single_number,
    names_of,
)
from rocksteady.seismic.spectra.many import DIRECTIONS, blocks_of, chosen
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray

VERTICAL = ("without", "with")


@checked
def run_ensemble(
    blocks: Block | Sequence[Block],
    motions: Record | BaseMotion | Sequence[Record | BaseMotion],
    *,
    levels: Levels,
    restitution: RestitutionBand | None = None,
    ways: Ways | None = None,
    mass_kg: float | Sequence[float] | None = None,
    model: ModelChoice = None,
    run: Execution | None = None,
) -> "xarray.Dataset":
    """Run every block on every record, scaled to every level, from rest.

    Every run is what `simulate` finds for the block, its restitution and the scaled record.  For a
    symmetric block the reversed record gives the mirror image: that is copied, not computed again.
    A block against a wall has none: the reversed record is another motion of it.

    Parameters
    ----------
    blocks
        A block or several.
    motions
        A record or several, or `BaseMotion` of a horizontal and a vertical record, which are scaled
        by the same factor.
    levels
        The levels, with values, and what they are in.
    restitution
        The band of restitutions; default `RestitutionBand()`.
    ways
        Signs of the records, and whether vertical components act; default `Ways()`.
    mass_kg
        Mass of the block, of a frame that of columns and cap together, or one for each block [kg];
        default none.  With it the largest forces on the base are found, which takes some five times
        as long.
    model
        ``"nonlinear"`` (default) or ``"linear"``.
    run
        Executor, workers, store and progress; default `Execution()`.

    Returns
    -------
    xarray.Dataset
        ``status`` (with flags), ``peak_angle`` (|theta|/alpha), ``impacts``, ``top_displacement_m``
        and ``clearance_m`` (as of a `Trajectory`, of the worse side, nan of a fall),
        ``edge_speed_m_s`` (of the lifted lower edge, up to a fall) and ``uplift_time_s`` (nan
        without uplift), with a mass ``base_force_across_kn`` and ``base_force_down_kn`` (as
        `Trajectory.base_force_kn`, nan of a fall and without uplift), over ``block``, ``record``,
        ``direction``, ``vertical``, ``draw`` and ``level``.  Coordinates are ``scale``, the factor
        of the accelerations, ``uplift_scale``, that above which it lifts, ``restitution``,
        ``alpha`` and ``p``, and ``im_NAME`` for each measure of the records as they are; and, where
        some records alone have a vertical component, ``copied``, true of the runs with it of the
        others.

    Raises
    ------
    InputError, ModelError
        If an argument is outside its range, the levels have no values, vertical motion is wanted
        and there is none, the linear model meets one, or there are not as many masses as blocks.

    Examples
    --------
    The share of two records that topples a cabinet at each level, in both directions:

    >>> from rocksteady import Block, Record, Status, run_ensemble
    >>> from rocksteady.risk import Levels, RestitutionBand
    >>> cabinet = Block.rectangle(width=0.4, height=1.6)
    >>> suite = [Record(acceleration_m_s2=[0.0, 1.0, -1.0, 0.0], dt_s=dt) for dt in (0.1, 0.3)]
    >>> levels = Levels("pga_g", [0.2, 0.5, 2.0], beside=())
    >>> runs = run_ensemble(cabinet, suite, levels=levels, restitution=RestitutionBand(draws=1))
    >>> fell = (runs.status == Status.OVERTURNED).stack(run=set(runs.dims) - {"level"})
    >>> fell.mean("run").values
    array([0. , 0.5, 0.5])
    """
    bodies = blocks_of(blocks)
    band = RestitutionBand() if restitution is None else restitution
    grounds = grounds_of(motions)
    records = [ground.record for ground in grounds]
    names = names_of(records)
    for block in bodies:
        band.ratios(block)  # refused before anything runs
    weights = _weights(bodies, mass_kg)
    chosen_ways = Ways() if ways is None else ways
    directions = chosen(chosen_ways.reverse, DIRECTIONS)
    lifts = _lifts(chosen_ways.vertical, grounds)
    at_one = levels.at_scale_one(records, bodies)
    scale = np.array(levels.values) / at_one[:, :, np.newaxis]
    equations = chosen_model(model, bodies[0])
    used = grounds if "with" in lifts else [GroundShaking(record=record) for record in records]
    check_grounds(used, scale.max(axis=(0, 2)).tolist(), extremes_of(bodies), equations)
    # Of symmetric blocks alone one direction is the mirror image of the other.
    several = directions if not all(block.symmetric for block in bodies) else directions[:1]
    shakings = ways_to_run(grounds, several, lifts)
    # Draws run fastest: those of one block on one ground share its table and its scale.
    axes = (
        Axis(
            name="motion",
            values=[way.name(names[way.record]) for way in shakings],
            long_name="ground motion",
            items=shakings,
        ),
        Axis(
            name="block",
            values=[f"block {place}" for place in range(1, len(bodies) + 1)],
            long_name="block",
            items=[Body(block=block, number=place) for place, block in enumerate(bodies)],
        ),
        Axis(name="level", values=levels.values, long_name=levels.key),
        Axis(name="draw", values=np.arange(band.draws), long_name="value of the restitution"),
    )
    load_kernel(equations)
    swept = evaluate(
        functools.partial(
            fates,
            at_one=at_one,
            band=band,
            mirrored_from=directions[0] if len(several) > 1 else None,
            model=equations,
            weights_kn=weights,
        ),
        Grid(axes=axes),
        [*OUTPUTS, *(() if weights is None else FORCE_OUTPUTS)],
        run=run,
        numbered="cell",
        attributes={"model": equations.name, "measure": levels.key},
    )
    arrays = whole(swept, shakings, bodies, directions, lifts)
    speeds = arrays.pop("peak_velocity")
    arrays |= qualification_of(bodies, arrays["peak_angle"], speeds, arrays["status"])
    linear = isinstance(equations, Linear)
    times = uplift_times(bodies, grounds, scale, directions, lifts, linear=linear)
    # Uplift does not depend on the restitution.
    rocked = arrays["peak_angle"] > 0.0
    arrays["uplift_time_s"] = np.where(rocked, times[:, :, :, :, np.newaxis], np.nan)
    copied = copies_of(grounds, lifts)
    runs = sum(len(shakings) // (len(several) if block.symmetric else 1) for block in bodies)
    return labelled(
        arrays,
        bodies,
        records,
        levels,
        scale,
        band,
        coordinates={
            "record": names,
            "direction": list(directions),
            "vertical": list(lifts),
            "copied": copied,
            "uplift_scale": uplift_scales(bodies, grounds, directions, lifts, linear=linear),
        },
        attributes={
            **swept.attrs,
            "kind": "rocking ensemble",
            "runs": runs * len(levels.values) * band.draws,
            "warnings": warnings_of(names, records, scale, arrays["status"], copied),
        },
    )


def _weights(blocks: Sequence[Block], mass_kg: float | Sequence[float] | None) -> Floats | None:
    """Return the weights of blocks [kN], where their masses are given."""
    if mass_kg is None:
        return None
    masses = np.atleast_1d(np.asarray(mass_kg)).tolist()
    masses *= len(blocks) if is_single_number(mass_kg) else 1
    if len(masses) != len(blocks):
        raise InputError(
            "mass_kg",
            mass_kg,
            f"there must be one mass for all blocks, or {len(blocks)}, one for each",
            "give a mass in kg for each block",
        )
    pairs = zip(blocks, masses, strict=True)
    return np.array([weight_kn(block, MASS("mass_kg", mass)) for block, mass in pairs])


def _lifts(value: object, grounds: Sequence[GroundShaking]) -> tuple[str, ...]:
    """Return whether runs are with vertical motion, without, or both."""
    lifts = chosen(value, VERTICAL)
    if any(ground.vertical is not None for ground in grounds):
        return lifts
    if value is True:
        raise InputError(
            "vertical",
            Words("is True and no motion has a vertical component"),
            "runs with vertical motion need records of it",
            "give BaseMotion(horizontal, vertical), or leave it out",
        )
    return VERTICAL[:1]
