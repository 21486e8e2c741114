"""Plot of a cascade: distances, ratios, and the slope to which they tend."""

import dataclasses

import matplotlib as mpl

mpl.use("Agg")

import numpy as np
import pytest
from matplotlib.figure import Figure

from rocksteady import Block, DimensionlessBlock, Harmonic, find_orbits, plots
from rocksteady.branches import Cascade, find_cascade
from rocksteady.errors import InputError
from rocksteady.show.style.tokens import LIGHT


@pytest.fixture(scope="module", name="cascade")
def _cascade() -> Cascade:
    motion = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    origin = find_orbits(DimensionlessBlock(restitution=0.8), motion, max_period=1)[0]
    return find_cascade(origin, "frequency_ratio", (1.7, 2.0), direction=-1, doublings=4)


def test_distances_ratios_and_slope_are_drawn(cascade: Cascade) -> None:
    axes = cascade.plot(Figure().add_subplot())
    line, dots = axes.lines
    assert dots.get_ydata() == pytest.approx(np.abs(np.diff(cascade.values)))
    expected = np.asarray(line.get_ydata())
    assert expected[:-1] / expected[1:] == pytest.approx(4.669201609)
    assert expected[-1] == pytest.approx(abs(cascade.distances[-1]))
    words = [text.get_text() for text in axes.texts]
    assert words == [*(f"{r:.3f}" for r in cascade.ratios), "ratio 4.6692 (Feigenbaum)"]
    assert line.get_color() == LIGHT.limit
    assert dots.get_color() == LIGHT.subharmonic_line
    assert [t.get_text() for t in axes.get_xticklabels()] == ["1 → 2", "2 → 4", "4 → 8"]
    assert "Ω" in axes.get_ylabel()


def test_one_doubling_has_no_distance(cascade: Cascade) -> None:
    one = dataclasses.replace(cascade, points=cascade.points[:1])
    with pytest.raises(InputError, match="has one doubling"):
        plots.cascade(one, Figure().add_subplot())
    two = dataclasses.replace(cascade, points=cascade.points[:2])
    words = [text.get_text() for text in plots.cascade(two, Figure().add_subplot()).texts]
    assert words in ([], ["ratio 4.6692 (Feigenbaum)"]), "no ratio of distances"


def test_distances_of_a_block_of_known_size_are_in_its_units() -> None:
    block = Block.rectangle(width=0.4, height=2.0, restitution=0.8)
    motion = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    origin = find_orbits(block, motion, max_period=1)[0]
    cascade = find_cascade(origin, "frequency_ratio", (1.7, 2.0), direction=-1, doublings=3)
    axes = plots.cascade(cascade, Figure().add_subplot())
    assert axes.get_ylabel() == "distance to the next doubling [Hz]"
    hertz = np.abs(np.diff(cascade.values)) * block.p / (2.0 * np.pi)
    assert axes.lines[1].get_ydata() == pytest.approx(hertz)
    (far,) = axes.child_axes
    assert far.get_ylabel() == "distance to the next doubling, |ΔΩ|"


def test_a_point_is_plotted_as_its_orbit(cascade: Cascade) -> None:
    axes = cascade.points[0].plot(Figure().add_subplot())
    assert "phase" in axes.get_xlabel()
