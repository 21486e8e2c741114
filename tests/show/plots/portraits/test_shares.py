"""Plot of shares over a parameter: bands, names and limits are those of the numbers."""

from functools import cache

import matplotlib as mpl

mpl.use("Agg")

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from rocksteady import DimensionlessBlock, Harmonic, plots
from rocksteady.basins import BasinShares, SamplingOptions, compute_basin_shares
from rocksteady.errors import InputError
from rocksteady.outcomes import AttractorKind
from rocksteady.show.plots.portraits.basins import plain_name
from rocksteady.show.style import palette
from rocksteady.show.style.tokens import LIGHT

WINDOW = np.linspace(-1.2, 1.2, 30)


@cache
def found(parameter: str = "frequency_ratio", *values: float) -> BasinShares:
    return compute_basin_shares(
        DimensionlessBlock(restitution=0.95),
        Harmonic(amplitude=0.5, frequency_ratio=2.0),
        parameter,
        values or (1.9, 2.0, 2.1, 2.3),
        sampling=SamplingOptions(angles=WINDOW, velocities=WINDOW, seed=1),
    )


def bands(axes: Axes) -> list[PolyCollection]:
    return [each for each in axes.collections if isinstance(each, PolyCollection)]


def heights(band: PolyCollection, value: float) -> float:
    """Height of a band at one of the values, in per cent."""
    corners = np.asarray(band.get_paths()[0].vertices)
    at = corners[np.isclose(corners[:, 0], value), 1]
    return float(at.max() - at.min())


@pytest.mark.parametrize("shares", [found(), found("frequency_ratio", 2.3, 2.0, 1.9)])
def test_bands_have_the_shares_and_add_up_to_100(shares: BasinShares) -> None:
    axes = plots.basin_shares(shares, Figure(figsize=(7, 4)).add_subplot(), top=1.0)
    assert axes.get_ylim() == (0.0, 100.0)
    assert axes.get_xlim() == (shares.values.min(), shares.values.max())
    drawn = bands(axes)
    assert len(drawn) == len(shares.families)
    for place, value in enumerate(shares.values.tolist()):
        thick = sorted(heights(band, value) for band in drawn)
        assert thick == pytest.approx(sorted(100.0 * shares.share[:, place]), abs=1e-9)
        assert sum(thick) == pytest.approx(100.0)


def test_rest_is_below_and_what_overturns_above_in_their_fills() -> None:
    shares = found()
    drawn = bands(plots.basin_shares(shares, Figure(figsize=(7, 4)).add_subplot()))
    fills = [to_hex(tuple(np.asarray(band.get_facecolor())[0].tolist())) for band in drawn]
    assert (fills[0], fills[-1]) == (LIGHT.rest, LIGHT.falls)
    assert LIGHT.symmetric in fills
    assert len(set(fills)) == len(fills)


def test_every_family_is_named_in_its_band_in_the_legend_or_counted() -> None:
    shares = found()
    axes = plots.basin_shares(shares, Figure(figsize=(7, 4)).add_subplot(), top=1.0)
    named = [text.get_text() for text in axes.texts]
    legend = axes.get_legend()
    assert legend is not None
    listed = [text.get_text() for text in legend.get_texts()]
    assert {"falls", "comes to rest"} <= {*named, *listed}
    names = [plain_name(one.typical.kind, one.name) for one in shares.families]
    thin = [name for name in names if name not in named + listed]
    assert not thin or f"and {len(thin)} below" in listed[-1]
    assert not set(named) & set(listed)


def test_the_axis_of_shares_goes_from_0_to_100() -> None:
    shares = found()
    falls = next(one for one in shares.families if one.typical.kind is AttractorKind.OVERTURNED)
    assert (1.0 - shares.share[falls.label]).max() < 0.5
    axes = plots.basin_shares(shares, Figure(figsize=(7, 4)).add_subplot())
    assert axes.get_ylim() == (0.0, 100.0)
    assert plots.basin_shares(shares, Figure().add_subplot(), top=0.2).get_ylim()[1] == 20.0


def test_labels_axes_and_scale() -> None:
    log = found("frequency_ratio", 0.5, 1.0, 2.0, 4.0, 8.0)
    axes = plots.basin_shares(log, Figure().add_subplot())
    assert axes.get_xscale() == "log"
    assert axes.get_xlabel() == palette.LABELS["frequency_ratio"]
    turned = plots.basin_shares(found("phase", 0.0, 1.0), Figure().add_subplot())
    assert "phase at the start" in turned.get_xlabel()
    assert found().plot(Figure().add_subplot()).get_ylabel() == "share of the window [%]"


def test_what_has_no_picture_is_refused() -> None:
    with pytest.raises(InputError, match="two values"):
        plots.basin_shares(found("phase", 0.5))
    with pytest.raises(InputError, match="top"):
        plots.basin_shares(found(), Figure().add_subplot(), top=0.0)
