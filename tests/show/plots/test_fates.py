"""Plots of maps of fates: as those of attractors, with classes of their own."""

from typing import Any

import matplotlib as mpl

mpl.use("Agg")

import numpy as np
import pytest
import xarray
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from rocksteady import DimensionlessBlock, State, map_fates, plots
from rocksteady.dynamics.maps.cell_classes import BLANK, CellClass
from rocksteady.errors import InputError
from rocksteady.show.figures.maps import map_figure
from rocksteady.show.plots.map_classes import LOOKS, map_cells
from rocksteady.show.style.tokens import LIGHT

CLASS_OF = {
    0: CellClass.ROCKING,
    1: CellClass.REST,
    2: CellClass.OVERTURNED,
    -1: CellClass.NO_START,
    BLANK: CellClass.NOT_COMPUTED,
}
START = State(angle=0.0, velocity=0.3)


def found(**axes: Any) -> xarray.Dataset:
    """A map of fates over frequency and perhaps more."""
    ratios = np.linspace(1.0, 8.0, 40)
    given: dict[str, Any] = {"amplitude": 2.0, "frequency_ratio": ratios, **axes}
    return map_fates(DimensionlessBlock(restitution=0.8), axes=given, start=START)


def test_each_cell_has_the_fill_of_its_fate() -> None:
    data = found(amplitude=np.linspace(0.5, 5.0, 30))
    data.fate[:3, :3] = np.array([-1, BLANK, 1], dtype=np.int8)
    axes = plots.outcomes(data, Figure().add_subplot())
    (image,) = axes.images
    drawn = np.asarray(image.get_array())
    wanted = np.vectorize(CLASS_OF.get)(data.fate.values)
    assert np.array_equal(drawn, wanted)
    assert to_hex(image.to_rgba(drawn)[0, -1]) == getattr(
        LIGHT, LOOKS[CellClass(int(drawn[0, -1]))].fill
    )
    legend = axes.get_legend()
    assert legend is not None
    texts = [text.get_text().rpartition("  ")[0] for text in legend.get_texts()]
    assert texts == ["comes to rest", "rocks", "falls", "no such start", "not computed"]


def test_over_one_axis_the_fates_fill_the_axes() -> None:
    data = found()
    data.fate[0] = BLANK
    axes = plots.outcomes(data, Figure().add_subplot())
    assert (len(axes.lines), len(axes.get_yticks())) == (0, 0)
    for band in axes.collections:
        fill = to_hex(np.asarray(band.get_facecolor())[0])
        corners = [np.asarray(path.vertices) for path in band.get_paths()]
        assert all((each[:, 1].min(), each[:, 1].max()) == (0.0, 1.0) for each in corners)
        inside = [
            code
            for ratio, code in zip(data.frequency_ratio.values, data.fate.values, strict=True)
            if any(each[:, 0].min() < ratio < each[:, 0].max() for each in corners)
        ]
        (code,) = set(inside)
        assert fill == getattr(LIGHT, LOOKS[CLASS_OF[code]].fill)
        assert len(inside) == int((data.fate == code).sum())
    assert len(axes.collections) == len(np.unique(data.fate)) > 2


def test_a_third_axis_becomes_panels() -> None:
    figure = map_figure(found(amplitude=[0.5, 1.0, 2.0], restitution=[0.7, 0.8]))
    assert [axes.get_title(loc="left") for axes in figure.axes] == [
        "restitution = 0.7",
        "restitution = 0.8",
    ]


def test_an_unknown_fate_is_refused() -> None:
    data = found()
    data.fate[0] = 9
    with pytest.raises(InputError, match="dataset = 9 is not valid"):
        map_cells(data)
