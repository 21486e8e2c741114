"""What equipment is qualified by, of the runs of an ensemble: displacement and edge speed."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.tops import top_displacement
from rocksteady.outcomes import Status
from rocksteady.results.numbers import length, quantity
from rocksteady.seismic.measures.free_sides import free_sides

if TYPE_CHECKING:
    import xarray

OUTPUTS: Final[Mapping[str, Mapping[str, str]]] = {
    "top_displacement_m": {"units": "m", "long_name": "largest motion of the top; nan of a fall"},
    "edge_speed_m_s": {"units": "m s-1", "long_name": "largest speed of the lifted lower edge"},
}
"""Attributes of the variables of a dataset."""
SHARE: Final = 0.84
"""Share of the runs that stand, of which a description has the largest values."""


def qualification_of(
    blocks: Sequence[Block], peaks: Floats, speeds: Floats, status: NDArray[Any]
) -> dict[str, Floats]:
    """Return motion of the top [m] and speed of the lifted edge [m/s].

    The top is that of `top_displacement`, of a block whose sides differ on the worse side.
    The edge is as fast as ``2 b |omega|``, at a landing the speed of impact.

    Parameters
    ----------
    blocks
        The blocks, along the first axis.
    peaks, speeds, status
        Largest |theta|/alpha, largest |d(theta/alpha)/d(p t)| and how each run ended.
    """
    tops, edges = np.empty(peaks.shape), np.empty(peaks.shape)
    for top, edge, peak, speed, block in zip(tops, edges, peaks, speeds, blocks, strict=True):
        sides = free_sides(block)
        top[...] = np.max([top_displacement(block, peak * side.alpha) for side in sides], axis=0)
        edge[...] = block.width * (block.alpha * block.p) * speed
    tops[status == int(Status.OVERTURNED)] = np.nan
    return dict(zip(OUTPUTS, (tops, edges), strict=True))


def most_of_standing(runs: "xarray.Dataset") -> dict[str, float | None]:
    """Return the values that 84 % of the runs that stand do not exceed; None where none stands."""
    stands = np.isfinite(runs["top_displacement_m"].values)
    return {
        key: float(np.quantile(runs[key].values[stands], SHARE)) if stands.any() else None
        for key in OUTPUTS
    }


def standing_words(values: Mapping[str, float | None]) -> str:
    """Return the same in words; empty where none stands."""
    top, speed = (values[key] for key in OUTPUTS)
    if top is None or speed is None:
        return ""
    edge, share = quantity(speed, "m/s"), f"{100.0 * SHARE:.0f} %"
    return f"at most {length(top)}, its edge at {edge}, in {share} of the runs that stand"
