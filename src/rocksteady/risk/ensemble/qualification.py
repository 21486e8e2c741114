"""What equipment is qualified by, of the runs of an ensemble: motion, clearance, speed, force."""

import functools
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.tops import clearance, top_displacement
from rocksteady.model.equations import chosen_model
from rocksteady.model.linear_tables import mass_centres, weight_kn
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.outcomes import Status
from rocksteady.seismic.measures.free_sides import free_sides
from rocksteady.seismic.spectra.batch import GroundShaking, shaken_forces, sides_in_si
from rocksteady.seismic.spectra.grounds import grounds_of
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.outputs import Output
from rocksteady.sweep.evaluate import compute_cells
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray

OUTPUTS: Final[Mapping[str, Mapping[str, str]]] = {
    "top_displacement_m": {"units": "m", "long_name": "largest motion of the top; nan of a fall"},
    "clearance_m": {"units": "m", "long_name": "gap that a neighbour needs; nan of a fall"},
    "edge_speed_m_s": {"units": "m s-1", "long_name": "largest speed of the lifted lower edge"},
}
"""Attributes of the variables of a dataset."""
FORCES: Final[Mapping[str, Mapping[str, str]]] = {
    f"base_force_{way}_kn": {
        "units": "kN",
        "long_name": f"largest {word} force on the base; nan of a fall or without uplift",
    }
    for way, word in (("across", "horizontal"), ("down", "vertical"))
}
"""Attributes of the variables that masses of the blocks add."""
FORCE_OUTPUTS: Final = tuple(
    Output(name=name, long_name=words["long_name"], units=words["units"])
    for name, words in FORCES.items()
)
SHARE: Final = 0.84
"""Share of the runs that rock and stand, of which a description has the largest values."""


def qualification_of(
    blocks: Sequence[Block], peaks: Floats, speeds: Floats, status: NDArray[Any]
) -> dict[str, Floats]:
    """Return motion of the top and clearance [m], and speed of the lifted edge [m/s].

    They are `top_displacement` and `clearance`, of a block whose sides differ on the worse side.
    The edge is as fast as ``2 b |omega|``, at a landing the speed of impact.

    Parameters
    ----------
    blocks
        The blocks, along the first axis.
    peaks, speeds, status
        Largest |theta|/alpha, largest |d(theta/alpha)/d(p t)| and how each run ended.
    """
    tops, gaps, edges = np.empty((3, *peaks.shape))
    for place, block in enumerate(blocks):
        angles = [
            sign * peaks[place] * side.alpha
            for sign, side in zip((1.0, -1.0), free_sides(block), strict=False)
        ]
        tops[place] = np.max([top_displacement(block, angle) for angle in angles], axis=0)
        gaps[place] = np.max([clearance(block, angle) for angle in angles], axis=0)
        edges[place] = block.width * (block.alpha * block.p) * speeds[place]
    fell = status == int(Status.OVERTURNED)
    tops[fell] = gaps[fell] = np.nan
    return dict(zip(OUTPUTS, (tops, gaps, edges), strict=True))


def most_of_rocking(runs: "xarray.Dataset") -> dict[str, float | None]:
    """Return the values that 84 % of the runs that rock and stand do not exceed; else None.

    Runs that do not lift are weaker than a demand at which the block rocks.
    """
    rocks = (runs["status"].values != int(Status.OVERTURNED)) & (runs["peak_angle"].values > 0.0)
    values = {}
    for key in (*OUTPUTS, *(key for key in FORCES if key in runs)):
        known = runs[key].values[rocks & np.isfinite(runs[key].values)]
        values[key] = float(np.quantile(known, SHARE)) if len(known) else None
    return values


def forces_of_rocking(
    runs: Sequence["xarray.Dataset"],
    blocks: Sequence[Block],
    motions: Sequence[Record | BaseMotion],
    masses_kg: Sequence[float | None],
    *,
    run: Execution | None = None,
) -> list[tuple[float, float] | None]:
    """Return the horizontal and vertical force on the base of most runs of each block [kN].

    84 % of the runs that rock and stand do not exceed them; None where there is none, or no mass.

    Parameters
    ----------
    runs
        Runs of each block at one level, whose factors are taken.
    blocks, masses_kg
        The blocks and their masses [kg].
    motions
        The records, each run once with each block.
    run
        Executor and workers; default `Execution()`.
    """
    heavy = [place for place, mass in enumerate(masses_kg) if mass is not None]
    values: list[tuple[float, float] | None] = [None] * len(blocks)
    if not heavy:
        return values
    grounds = grounds_of(motions)
    model = chosen_model(None, blocks[0])
    bodies = [blocks[place] for place in heavy]
    # Blocks run fastest: those on one ground share its table.
    axes = (
        Axis(name="motion", values=np.arange(len(grounds)), long_name="number of the motion"),
        Axis(name="block", values=np.arange(len(heavy)), long_name="number of the block"),
    )
    cells = compute_cells(
        functools.partial(
            _forces,
            grounds=grounds,
            scales=np.stack([runs[place]["scale"].isel(block=0).values for place in heavy]),
            sides=np.stack([sides_in_si(block, model) for block in bodies]),
            gravity=np.array([block.gravity for block in bodies]),
            centres=np.stack([mass_centres(block) for block in bodies]),
        ),
        Grid(axes=axes),
        FORCE_OUTPUTS,
        run=run,
    )
    forces = np.stack([cells[name].values.T for name in FORCES], axis=-1)
    for place, each in zip(heavy, forces, strict=True):
        rocked = each[np.isfinite(each[:, 0])]
        if len(rocked):
            weight = weight_kn(blocks[place], masses_kg[place] or 0.0)
            across, down = (weight * np.quantile(rocked, SHARE, axis=0)).tolist()
            values[place] = across, down
    return values


def _forces(
    motion: Floats,
    block: Floats,
    *,
    grounds: Sequence[GroundShaking],
    scales: Floats,
    sides: Floats,
    gravity: Floats,
    centres: Floats,
) -> dict[str, Floats]:
    """Return the largest forces over the weight of some cells."""
    ground, body = motion.astype(np.int64), block.astype(np.int64)
    forces = shaken_forces(
        grounds,
        ground=ground,
        scale=scales[body, ground],
        sides=sides[body],
        gravity=gravity[body],
        centres=centres[body],
    )
    return dict(zip(FORCES, forces.T, strict=True))
