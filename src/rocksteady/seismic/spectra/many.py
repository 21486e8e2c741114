"""Many blocks on many records at many levels: how each run ends."""

import functools
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats, Objects
from rocksteady.errors import InputError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import LARGEST, in_range
from rocksteady.model.equations import Model, ModelChoice, chosen_model
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.seismic.measures.free_sides import impact_ratios, side_coordinates
from rocksteady.seismic.spectra.batch import (
    OUTPUTS,
    load_kernel,
    shaken_fates,
    sides_in_si,
    told_apart,
)
from rocksteady.seismic.spectra.grounds import (
    axis_values,
    check_grounds,
    extremes_of,
    grounds_of,
    is_single_motion,
    is_single_number,
    names_of,
    scale_values,
    turned_round,
)
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.cells import Cells, Variable
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.labelled import as_dataset
from rocksteady.sweep.evaluate import compute_cells
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray


DIRECTIONS = ("as recorded", "reversed")


@checked
def simulate_many(
    blocks: Block | Sequence[Block],
    motions: Record | BaseMotion | Sequence[Record | BaseMotion],
    *,
    pga_g: ArrayLike | None = None,
    scales: ArrayLike | None = None,
    reverse: bool | Literal["both"] = False,
    model: ModelChoice = None,
    run: Execution | None = None,
) -> "xarray.Dataset":
    """Simulate many blocks on many records at many levels, from rest.

    Every cell is what `simulate` finds for the block and the scaled record: the same status and
    impacts, and peaks to a part of 1e-12, times one and `Trajectory.growth`.  Where that growth is
    above some 1e12, rounding decides on all of them, and they may differ.  A block against a
    wall (`Block.against_wall`) feels the sign of a record: it leaves the wall where the base
    accelerates to its positive side, and the reversed record is another motion.

    Parameters
    ----------
    blocks
        A block or several, each with its own sides, restitution and gravity.
    motions
        A record or several, or `BaseMotion` of a horizontal and a vertical record.
    pga_g
        Levels of PGA [g], a number or several: each motion is multiplied by what brings its
        horizontal component to the level.
    scales
        Levels as factors of all accelerations, above 0; default 1.  Not with `pga_g`.
    reverse
        True reverses the horizontal records; "both" adds a dimension ``direction``, as recorded
        and reversed; default False.
    model
        ``"linear"`` or ``"nonlinear"`` (default), the full equations.
    run
        Executor, workers, store and progress; default `Execution()`.

    Returns
    -------
    xarray.Dataset
        ``status`` (with flags), ``peak_angle`` (|theta|/alpha), ``peak_velocity``
        (|d(theta/alpha)/d(p t)|) and ``impacts`` over ``block``, ``record`` and ``level``; a single
        one is no dimension.  ``pga_g`` and ``scale`` are coordinates, and so are alpha, p and
        restitution of the blocks, of one against a wall that of the wall.

    Raises
    ------
    InputError, ModelError
        If an argument is outside its range, both `pga_g` and `scales` are given, or the linear
        model meets a vertical motion.

    Examples
    --------
    The share of a suite that topples an off-centre statue, at two levels of PGA:

    >>> from rocksteady import Block, Record, Status, simulate_many
    >>> statue = Block.asymmetric(left=0.2, right=0.3, height=1.8)
    >>> suite = [Record(acceleration_m_s2=[0.0, a, -a, 0.0], dt_s=0.3) for a in (2.0, 4.0)]
    >>> result = simulate_many(statue, suite, pga_g=[0.2, 0.8])
    >>> (result.status == Status.OVERTURNED).mean("record").values
    array([0., 1.])
    """
    cells = cells_of_many(
        blocks, motions, pga_g=pga_g, scales=scales, reverse=reverse, model=model, run=run
    )
    return as_dataset(cells)


def cells_of_many(
    blocks: Block | Sequence[Block],
    motions: Record | BaseMotion | Sequence[Record | BaseMotion],
    *,
    pga_g: ArrayLike | None = None,
    scales: ArrayLike | None = None,
    reverse: bool | Literal["both"] = False,
    model: ModelChoice = None,
    run: Execution | None = None,
) -> Cells:
    """Return the runs of many blocks on many records as cells.

    Parameters and errors are those of `simulate_many`.
    """
    bodies = blocks_of(blocks)
    grounds = grounds_of(motions)
    names = names_of(ground.record for ground in grounds)
    if pga_g is not None and scales is not None:
        raise InputError(
            "pga_g",
            Words("and scales are both given"),
            "levels are either of PGA or factors",
            "leave one of the two out",
        )
    peaks = np.array([ground.record.reference.peak_acceleration_m_s2 for ground in grounds])
    if pga_g is None:
        given = 1.0 if scales is None else scales
        levels = scale_values(given)
        factors = np.tile(levels, (len(grounds), 1))
    else:
        hint = "give a PGA in g, as 0.3"
        given = pga_g
        levels = [
            in_range("pga_g", value, 1.0 / LARGEST, LARGEST, "[]", hint=hint)
            for value in axis_values("pga_g", pga_g)
        ]
        factors = np.array(levels) * STANDARD_GRAVITY / peaks[:, np.newaxis]
    equations = chosen_model(model, bodies[0])
    check_grounds(grounds, factors.max(axis=1).tolist(), extremes_of(bodies), equations)
    directions = chosen(reverse, DIRECTIONS)
    sign = {"as recorded": lambda ground: ground, "reversed": turned_round}
    shaking = [sign[direction](ground) for direction in directions for ground in grounds]
    cases = [f"{direction}: {name}" for direction in directions for name in names]
    words = "PGA" if pga_g is not None else "factor of all accelerations"
    # Blocks run fastest: those on one ground share its table.
    axes = (
        Axis(name="motion", values=cases, long_name="ground motion", items=shaking),
        Axis(name="level", values=levels, units="1" if pga_g is None else "g", long_name=words),
        Axis(
            name="block",
            values=[f"block {number}" for number in range(1, len(bodies) + 1)],
            long_name="block",
            items=bodies,
        ),
    )
    load_kernel(equations)
    result = compute_cells(
        functools.partial(
            _fates,
            peak_m_s2=None if pga_g is None else STANDARD_GRAVITY,
            model=equations,
        ),
        Grid(axes=axes),
        OUTPUTS,
        run=run,
        attributes={
            "model": equations.name,
            "direction": "both" if reverse == "both" else directions[0],
            "vertical": ", ".join(names_of(ground.vertical for ground in grounds)) or "none",
        },
    )
    dims = ("block", "record", "direction", "level")
    shape = (len(directions), len(grounds), len(levels), len(bodies))
    variables = {}
    for output in OUTPUTS:
        values = result[output.name].values.reshape(shape).transpose(3, 1, 0, 2)
        variables[output.name] = Variable(dims, values, output.attributes)
    pga = factors * (peaks / STANDARD_GRAVITY)[:, np.newaxis]
    ways = {"long_name": "sign of the horizontal component"}
    coords = {
        **{
            each: Variable((each,), result[each].values, result[each].attrs)
            for each in ("level", "block")
        },
        "record": Variable(("record",), np.array(names), {"long_name": "ground motion"}),
        "direction": Variable(("direction",), np.array(directions), ways),
        "scale": Variable(
            ("record", "level"), factors, {"long_name": "factor of all accelerations"}
        ),
        "pga_g": Variable(
            ("record", "level"), pga, {"units": "g", "long_name": "PGA of the horizontal component"}
        ),
    }
    for name, (dim, values, words) in _measures(bodies).items():
        coords[name] = Variable((dim,), np.array(values), words)
    name = "scale" if pga_g is None else "pga_g"
    coords[name] = Variable(("level",), np.array(levels), coords[name].attrs)
    single = {
        "block": isinstance(blocks, Block),
        "record": is_single_motion(motions),
        "direction": reverse != "both",
        "level": is_single_number(
            pga_g if pga_g is not None else 1.0 if scales is None else scales
        ),
    }
    whole = Cells(variables, coords, result.attrs, result.encoding)
    return whole.without([name for name, once in single.items() if once])


def _fates(
    motion: Objects,
    level: Floats,
    block: Objects,
    *,
    peak_m_s2: float | None,
    model: Model,
) -> dict[str, NDArray[Any]]:
    """Return how the blocks of some cells fare.

    `peak_m_s2` is the peak acceleration of level 1; None where levels are factors.
    """
    grounds, ground = told_apart(motion)
    bodies, body = told_apart(block)
    scale = level
    if peak_m_s2 is not None:
        peaks = np.array([each.record.reference.peak_acceleration_m_s2 for each in grounds])
        scale = level * peak_m_s2 / peaks[ground]
    fared = shaken_fates(
        grounds,
        ground=ground,
        scale=scale,
        sides=np.stack([sides_in_si(each, model) for each in bodies])[body],
        gravity=np.array([each.gravity for each in bodies])[body],
    )
    return fared._asdict()


def blocks_of(blocks: Block | Sequence[Block]) -> list[Block]:
    """Return one or more blocks."""
    given: object = blocks
    several = [given] if isinstance(given, Block) else given
    bodies = list(several) if isinstance(several, list | tuple) else []
    if not bodies or not all(isinstance(block, Block) for block in bodies):
        raise InputError(
            "blocks",
            given,
            "it must be a Block, which has sizes, or a list of them",
            "give Block.rectangle(width=0.5, height=1.8), or several",
        )
    return bodies


def chosen(value: object, both: tuple[str, str]) -> tuple[str, ...]:
    """Return one of two kinds of runs, or both."""
    return (both[value],) if isinstance(value, bool) else both


def _measures(bodies: Sequence[Block]) -> dict[str, Any]:
    """Return coordinates along the axis of blocks."""
    coordinates = side_coordinates(bodies)
    ratios = np.array([impact_ratios(block) for block in bodies])
    words = {"units": "1", "long_name": "restitution"}
    coordinates["restitution"] = ("block", ratios[:, 0], words)
    if "negative_alpha" in coordinates:
        words = {**words, "long_name": "restitution of the negative side"}
        coordinates["negative_restitution"] = ("block", ratios[:, 1], words)
    sizes = {"width": "distance between the edges", "height": "full height"}
    return coordinates | {
        name: (
            "block",
            [float(getattr(block, name)) for block in bodies],
            {"units": "m", "long_name": text},
        )
        for name, text in sizes.items()
    }
