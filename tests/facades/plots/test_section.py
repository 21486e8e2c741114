"""The section: to scale, about its hinge, with every load, mass, tie and thrust once."""

import math

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Text

from rocksteady.facades.plots.section import plot_facade_section
from rocksteady.show.style.page import Page
from tests.facades.page.checked_facades import alone, thin, tied


def words_module(axes: Axes) -> list[str]:
    return [text.get_text() for text in axes.texts if text.get_text()]


def test_the_body_is_to_scale() -> None:
    axes = plot_facade_section(thin().facade, Figure().add_subplot())
    assert axes.get_aspect() == 1.0
    sizes = {(round(p.get_width(), 9), round(p.get_height(), 9)) for p in axes.patches}  # type: ignore[attr-defined]
    assert (0.3, 3.0) in sizes


def test_the_leaning_outline_is_the_body_turned_outwards_about_the_hinge() -> None:
    facade = tied().facade
    axes = plot_facade_section(facade, Figure().add_subplot())
    (outline,) = (line for line in axes.lines if len(np.asarray(line.get_xdata())) == 6)
    x, z = (np.asarray(values, dtype=float) for values in outline.get_data())
    assert (x[0], z[0]) == (facade.hinge_inset_m, 0.0)
    top = complex(x[2] - facade.hinge_inset_m, z[2])
    upright = complex(-facade.hinge_inset_m, facade.height_m)
    assert abs(top) == pytest.approx(abs(upright))
    assert math.degrees(np.angle(top / upright)) == pytest.approx(5.0)
    assert x[2] < 0.0, "outwards"


def test_all_that_acts_is_named_with_its_force() -> None:
    facade = tied().facade
    found = words_module(plot_facade_section(facade, Figure().add_subplot(), language="it"))
    for group in (facade.loads, facade.masses):
        for each in group:
            assert f"{each.name}\n{each.weight_kn:g}\N{NO-BREAK SPACE}kN" in found
    forces = [(each.name, each.force_kn) for each in facade.ties]
    forces += [(each.name, each.force_kn) for each in facade.thrusts]
    for name, force in forces:
        assert f"{name}\n{force:g}\N{NO-BREAK SPACE}kN" in found
    assert "cerniera" in found
    assert f"parete\n{18 * 0.5 * 4 * 6:g}\N{NO-BREAK SPACE}kN" in found
    assert len(found) == 6


def test_a_gable_weighs_half_and_has_its_centre_at_a_third() -> None:
    axes = plot_facade_section(alone().facade, Figure().add_subplot())
    assert f"gable\n{0.5 * 18 * 0.4 * 3 * 8:.3g}\N{NO-BREAK SPACE}kN" in words_module(axes)
    assert any(np.asarray(line.get_ydata()).tolist() == [1.0] for line in axes.lines)


def test_labels_of_a_column_stand_clear_of_each_other() -> None:
    with Page(width_mm=84.0).figure(7.0, 4.5, "") as figure:
        axes = plot_facade_section(tied().facade, figure.add_subplot())
    figure.draw_without_rendering()
    # Without the arrow that an annotation has.
    boxes = [Text.get_window_extent(text) for text in axes.texts if "\n" in text.get_text()]
    assert len(boxes) == 5
    for place, box in enumerate(boxes):
        assert not any(box.overlaps(other) for other in boxes[:place])
