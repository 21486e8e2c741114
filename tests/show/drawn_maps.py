"""Maps to draw, and what a picture of one shows at a place."""

from collections.abc import Mapping
from functools import cache

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import to_hex
from numpy.typing import ArrayLike

from rocksteady import DimensionlessBlock, map_attractors
from rocksteady.dynamics.batch.attractors import KIND_FLAGS
from rocksteady.dynamics.maps.cell_classes import BLANK
from rocksteady.show.plots.map_classes import LOOKS
from rocksteady.show.style import palette
from rocksteady.show.style.tokens import LIGHT

BLOCK = DimensionlessBlock(restitution=0.8)
CLASS_OF = {
    "symmetric": "symmetric",
    "unsymmetric": "unsymmetric",
    "rest": "comes to rest",
    "overturned": "falls",
    "aperiodic": "aperiodic",
    "undecided": "undecided",
    "no-start": "no such start",
}
"""Words of the legend by those of the dataset, written out once more."""
AXES = (
    *("amplitude", "frequency_ratio", "phase", "acceleration_m_s2", "frequency_hz", "restitution"),
    *("alpha", "radius", "p", "width", "height", "angle", "velocity", "kick"),
)


@cache
def found() -> xarray.Dataset:
    """A map of 24 x 30 cells with five classes."""
    amplitude, frequency_ratio = np.linspace(0.2, 6.0, 24), np.linspace(0.5, 8.0, 30)
    return map_attractors(BLOCK, axes={"amplitude": amplitude, "frequency_ratio": frequency_ratio})


def drawn_up(
    axes: Mapping[str, ArrayLike], kind: ArrayLike = 2, period: ArrayLike = 0
) -> xarray.Dataset:
    """A map with any axes and kinds."""
    shape = tuple(len(np.asarray(values)) for values in axes.values())
    names = tuple(axes)
    flags = {
        "flag_values": np.array(list(KIND_FLAGS), dtype=np.int8),
        "flag_meanings": " ".join(KIND_FLAGS.values()),
    }
    return xarray.Dataset(
        {
            "kind": (names, np.broadcast_to(np.asarray(kind, dtype=np.int8), shape), flags),
            "period": (names, np.broadcast_to(np.asarray(period, dtype=np.int32), shape)),
            "highest": (names, np.full(shape, 0.5)),
            "lowest": (names, np.full(shape, -0.5)),
        },
        coords=dict(axes),
    )


def random_map(axes: Mapping[str, ArrayLike], seed: int = 1) -> xarray.Dataset:
    shape = [len(np.asarray(values)) for values in axes.values()]
    rng = np.random.default_rng(seed)
    kind = rng.choice([*KIND_FLAGS, BLANK], shape)
    return drawn_up(axes, kind, np.where(kind < 2, rng.integers(1, 4, shape), 0))


def words_at(data: xarray.Dataset, **place: float) -> str:
    """What the legend calls a cell of a map."""
    cell = data.sel(place)
    code = int(cell.kind)
    if code == BLANK:
        return "not computed"
    word = CLASS_OF[KIND_FLAGS[code]]
    again = word in ("symmetric", "unsymmetric") and int(cell.period) > 1
    return "subharmonic (period ≥ 2)" if again else word


FILL_OF = {look.words: getattr(LIGHT, look.fill) for look in LOOKS.values()}


def colour_at(axes: Axes, x: float, y: float) -> str:
    """The colour of what is drawn at a place, by the edges of the artist."""
    if axes.images:
        (image,) = axes.images
        left, right, low, high = image.get_extent()
        array = np.asarray(image.get_array())
        at_x = np.log10(x) if axes.get_xscale() == "log" else x
        at_y = np.log10(y) if axes.get_yscale() == "log" else y
        row = int((at_y - low) / (high - low) * array.shape[0])
        column = int((at_x - left) / (right - left) * array.shape[1])
        assert image.origin == "lower"
        return to_hex(image.to_rgba(array)[row, column])
    (mesh,) = [one for one in axes.collections if isinstance(one, QuadMesh)]
    corners = np.asarray(mesh.get_coordinates())
    row = int(np.searchsorted(corners[:, 0, 1], y)) - 1
    column = int(np.searchsorted(corners[0, :, 0], x)) - 1
    return to_hex(mesh.to_rgba(np.asarray(mesh.get_array()))[row, column])


def assert_drawn(axes: Axes, data: xarray.Dataset, right: str, up: str) -> None:
    """Every cell has its fill at its place."""
    for x in data[right].values:
        for y in data[up].values:
            words = words_at(data, **{right: x, up: y})
            assert colour_at(axes, float(x), float(y)) == FILL_OF[words], (x, y)
    assert axes.get_xlabel() == palette.axis_label(right)
    assert axes.get_ylabel() == palette.axis_label(up)
