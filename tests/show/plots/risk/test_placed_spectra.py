"""A design spectrum with its motions: the spectra of what is run, and the periods that decide."""

import math

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import rocksteady as rs
from rocksteady.errors import InputError
from rocksteady.risk import Peaks
from rocksteady.risk.counted.suite import Suite
from rocksteady.show.style.page import Page
from tests.every import every

SUITE = rs.motions.make_synthetic_suite(4)
PLACED = rs.motions.place_on_spectrum(SUITE, "en1998-1:2004:type1:A:ag=0.25")
CABINET = rs.Block.rectangle(width=0.32, height=1.8)


def exact_g(periods_s: np.ndarray) -> np.ndarray:
    """Return the spectra of the motions as they are run [g]."""
    records = [each for each in PLACED.motions if isinstance(each, rs.Record)]
    found = [rs.measures.compute_response_spectrum(each, periods_s) for each in records]
    return np.array([each.pseudo_acceleration_m_s2 / 9.80665 for each in found])


def test_lines_are_the_spectra_of_the_motions_that_are_run() -> None:
    drawn = rs.plots.placed_spectra(PLACED, Figure().add_subplot())
    *own, mean, design = (np.asarray(line.get_xydata()) for line in drawn.lines)
    for place, line in enumerate(own):
        for first, rtol in ((0.05, 0.03), (0.4, 0.005)):  # short periods have few samples
            t, values = line[(line[:, 0] > first) & (line[:, 0] < 4.0)].T
            np.testing.assert_allclose(values, exact_g(t)[place], rtol=rtol)
    t, values = mean.T
    np.testing.assert_allclose(values, np.exp(np.log(exact_g(t)).mean(axis=0)), rtol=0.05)
    wanted = [0.25 * (1.0 + 1.5 * 0.1 / 0.15), 0.625, 0.625 * 0.4, 0.625 * 0.4 * 2.0 / 16.0]
    np.testing.assert_allclose(np.interp([0.1, 0.3, 1.0, 4.0], *design.T), wanted, rtol=0.001)


@every(
    "block",
    [CABINET, CABINET.against_wall(), rs.Block.asymmetric(left=0.1, right=0.3, height=1.8)],
)
def test_the_band_is_that_of_both_sides(block: rs.Block) -> None:
    (band,) = rs.plots.placed_spectra(PLACED, Figure().add_subplot(), block=block).patches
    box = band.get_extents().transformed(band.axes.transData.inverted())  # type: ignore[union-attr]
    rates = [block.positive.p] if block.one_sided else [block.positive.p, block.negative.p]
    ends = [0.3 * 2.0 * math.pi / max(rates), 1.1 * 2.0 * math.pi / min(rates)]
    assert [box.x0, box.x1] == pytest.approx(ends)


@pytest.mark.parametrize("width", [84.0, 174.0])
def test_the_legend_covers_no_line_and_no_name_is_cut_off(width: float) -> None:
    with Page(width_mm=width).figure(7.2, 4.0, "") as figure:
        drawn: Axes = rs.plots.placed_spectra(PLACED, figure.add_subplot(), block=CABINET)
    figure.draw_without_rendering()
    legend, (name,) = drawn.get_legend(), drawn.texts
    assert legend is not None
    box = legend.get_window_extent()
    paths = [line.get_transform().transform_path(line.get_path()) for line in drawn.lines]
    assert not any(path.intersects_bbox(box, filled=False) for path in paths)
    assert name.get_text() == "periods that decide:\n0.66 to 2.4 s"
    assert name.get_window_extent().x1 <= figure.bbox.x1


def test_motions_on_no_spectrum_have_no_picture() -> None:
    with pytest.raises(InputError, match="place_on_spectrum"):
        rs.plots.placed_spectra(Suite(motions=SUITE).at(Peaks(pga_g=0.3)))
