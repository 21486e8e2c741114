"""Maps coloured by a quantity: its values, what has none, and the shares beside it."""

from io import BytesIO
from typing import Any

import matplotlib as mpl

mpl.use("Agg")

import numpy as np
import pytest
import xarray
from matplotlib.colors import to_hex, to_rgba
from matplotlib.figure import Figure

from rocksteady import map_fates, plots
from rocksteady.dynamics.maps.cell_classes import BLANK
from rocksteady.errors import InputError
from rocksteady.show.figures.maps import map_figure
from rocksteady.show.plots.map_classes import map_cells
from rocksteady.show.plots.map_quantities import MOST_PERIODS, period_fills, shade_of, with_values
from rocksteady.show.style.tokens import LIGHT
from tests.every import every
from tests.show.drawn_maps import BLOCK, drawn_up, found

PLANE = {"amplitude": np.arange(1.0, 5.0), "frequency_ratio": np.arange(1.0, 7.0)}


def made(**variables: Any) -> xarray.Dataset:
    """A map of 4 x 6 cells: rows at rest, symmetric, unsymmetric and overturned."""
    data = drawn_up(PLANE, period=np.array([[0], [1], [9], [0]])).copy(deep=True)
    data["kind"], data["period"] = (data[one].copy() for one in ("kind", "period"))
    kinds = data.kind.attrs["flag_meanings"].split()
    for row, word in enumerate(("rest", "symmetric", "unsymmetric", "overturned")):
        data["kind"][row] = int(data.kind.attrs["flag_values"][kinds.index(word)])
    still = np.array([[0.0], [0.5], [1.2], [np.nan]]) * np.ones(6)
    data["highest"], data["lowest"] = (data.kind.dims, still), (data.kind.dims, -0.5 * still)
    lyapunov = np.array([[np.nan], [-0.4], [0.2], [np.nan]]) * np.ones(6)
    data["lyapunov"] = (data.kind.dims, lyapunov)
    return data.assign(variables)


def legend_of(axes: Any) -> list[str]:
    return [text.get_text() for text in axes.get_legend().get_texts()]


def image_of(axes: Any) -> Any:
    """The values that are drawn, upwards and to the right, masked where there is none."""
    return axes.images[-1].get_array()


def test_exponents_are_drawn_about_zero_and_the_rest_is_set_apart() -> None:
    axes = plots.outcomes(made(), Figure().add_subplot(), by="lyapunov")
    values = image_of(axes)
    assert values.mask.all(axis=1).tolist() == [True, False, False, True]
    assert values[1].tolist() == [-0.4] * 6
    image: Any = axes.images[-1]
    low, high = image.get_clim()
    assert low == -high
    middle = image.cmap(image.norm(0.0))
    assert middle == pytest.approx(to_rgba(LIGHT.paper), abs=0.01)
    assert legend_of(axes) == ["comes to rest  25.0 %", "falls  25.0 %"]
    (bar,) = (other for other in axes.figure.axes if other is not axes)
    assert "per forcing period" in bar.get_ylabel()


def test_a_peak_above_one_has_a_line_around_it() -> None:
    axes = plots.outcomes(made(), Figure().add_subplot(), by="peak")
    assert image_of(axes)[2].tolist() == pytest.approx([1.2] * 6)
    (line,) = (
        path
        for each in axes.collections
        if not any(getattr(each, "hatches", ()))
        for path in each.get_paths()
    )
    assert np.asarray(line.vertices)[:, 1] == pytest.approx(2.0 + (1.0 - 0.5) / (1.2 - 0.5))
    assert legend_of(axes) == ["falls  25.0 %", "tipping angle"]


def test_periods_have_fills_of_their_own_and_long_ones_share_one() -> None:
    data = made()
    data["period"][1] = [1, 2, 3, MOST_PERIODS, MOST_PERIODS + 1, 40]
    data["kind"][1, :2] = 1
    axes = plots.outcomes(data, Figure().add_subplot(), by="period")
    image: Any = axes.images[-1]
    fills = [to_hex(image.cmap(image.norm(value))) for value in image.get_array()[1]]
    colours = period_fills(LIGHT)
    assert fills == [*(colours[k - 1] for k in (1, 2, 3, MOST_PERIODS)), *[colours[-1]] * 2]
    assert len(set(colours)) == len(colours) == MOST_PERIODS + 1
    assert colours[0] == LIGHT.symmetric
    entries = legend_of(axes)
    assert entries[0].startswith("period 1  4.2 %")
    assert f"period ≥ {MOST_PERIODS + 1}  33.3 %" in entries  # 6 of period 9, and two of these
    shares = [float(entry.rpartition("  ")[2].removesuffix(" %")) for entry in entries]
    assert sum(shares) == pytest.approx(100.0, abs=0.3)


def test_axes_in_any_order_keep_each_value_at_its_cell() -> None:
    data = found()
    mixed = data.isel(amplitude=np.random.default_rng(1).permutation(data.sizes["amplitude"]))
    turned = mixed.transpose("frequency_ratio", "amplitude")
    one, other = (with_values(map_cells(each), each, "peak") for each in (data, turned))
    expected = np.maximum(np.abs(data.highest), np.abs(data.lowest)).values
    assert one.reached == pytest.approx(expected, nan_ok=True)
    assert other.reached is not None
    assert pytest.approx(expected, nan_ok=True) == other.reached.T
    assert other.turned(("amplitude", "frequency_ratio")).reached == pytest.approx(
        expected, nan_ok=True
    )


def test_cells_not_computed_have_no_value_whatever_stands_there() -> None:
    data = made()
    data["kind"][1] = BLANK
    axes = plots.outcomes(data, Figure().add_subplot(), by="lyapunov")
    assert image_of(axes).mask[1].all()
    assert "not computed  25.0 %" in legend_of(axes)


def test_exponents_that_tend_to_minus_infinity_do_not_stretch_the_colours() -> None:
    data = made()
    data["lyapunov"][1, 0] = -np.inf
    shade = shade_of(with_values(map_cells(data), data, "lyapunov"), "lyapunov")
    assert (shade.norm.vmin, shade.norm.vmax) == pytest.approx((-0.4, 0.4))
    assert shade.extend == "min"
    # Through the renderer, which shows what lies below the class in place of what is infinite.
    figure = Figure(figsize=(4.0, 3.0), dpi=100.0)
    axes = plots.outcomes(data, figure.add_axes((0.2, 0.2, 0.5, 0.7)), by="lyapunov", legend="none")
    stream = BytesIO()
    figure.savefig(stream, format="rgba", dpi=100.0)
    pixels = np.frombuffer(stream.getvalue(), dtype=np.uint8).reshape(300, 400, 4)
    across, above = axes.transData.transform((1.0, 2.0))
    seen = pixels[pixels.shape[0] - 1 - int(above), int(across)] / 255.0
    assert tuple(seen.tolist()) == pytest.approx(to_rgba(LIGHT.motion), abs=0.01)


def test_what_a_map_does_not_have_is_refused() -> None:
    fates = map_fates(BLOCK, axes=PLANE, cycles=5)
    with pytest.raises(InputError, match="fates is coloured by class"):
        plots.outcomes(fates, Figure().add_subplot(), by="lyapunov")
    with pytest.raises(InputError, match="one of class, period, lyapunov, peak"):
        plots.outcomes(found(), Figure().add_subplot(), by="impacts")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="lyapunov"):
        plots.outcomes(drawn_up(PLANE), Figure().add_subplot(), by="lyapunov")


@every("by", ["period", "lyapunov", "peak"])
def test_over_one_axis_the_quantity_is_a_diagram(by: Any) -> None:
    line = found().sel(amplitude=2.0, method="nearest")
    axes = plots.outcomes(line, Figure().add_subplot(), by=by)
    drawn = np.concatenate([np.asarray(each.get_ydata()) for each in axes.lines])
    expected = {
        "period": line.period.where(line.period > 0),
        "lyapunov": line.lyapunov,
        "peak": np.maximum(abs(line.highest), abs(line.lowest)),
    }[by]
    kept = np.sort(expected.values[np.isfinite(expected.values)])
    dots = np.sort(drawn[np.isfinite(drawn)])
    assert set(kept.tolist()) <= set(dots.tolist())
    # Of exponents 0 is seen too, and they have most of the height.
    low, high = axes.get_ylim()
    assert by != "lyapunov" or 0.8 * (high - low) < np.ptp([0.0, *kept]) < high - low


@every("sign", [-1.0, 1.0])
def test_0_is_in_view_beside_exponents_of_one_sign(sign: float) -> None:
    line = made().isel(amplitude=2)
    axes = plots.outcomes(
        line.assign(lyapunov=sign * line.lyapunov), Figure().add_subplot(), by="lyapunov"
    )
    low, high = axes.get_ylim()
    assert low < 0.0 < high
    assert high - low < 0.3


def test_panels_share_their_colours() -> None:
    data = xarray.concat([made(), made()], "restitution").assign_coords(restitution=[0.7, 0.9])
    data["lyapunov"][0] *= 0.5
    figure = map_figure(data, by="lyapunov")
    panels = [axes for axes in figure.axes if axes.images]
    assert len(panels) == 2
    assert len({axes.images[-1].get_clim() for axes in panels}) == 1
    assert len(figure.axes) == 3
