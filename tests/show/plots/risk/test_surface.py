"""Fragility over PGA and PGV: its lines, its dots, the demand, and what reaches loss tools."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.collections import PathCollection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from scipy.stats import norm

from rocksteady import Block, compute_fragility, plots
from rocksteady.errors import InputError
from rocksteady.export import LossComponent, write_pelicun
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import FitOptions, Fragility, RestitutionBand
from rocksteady.show.style.tokens import LIGHT

BLOCK = Block.rectangle(width=0.3, height=1.5)


@pytest.fixture(scope="module", name="found")
def _found() -> Fragility:
    return compute_fragility(
        BLOCK,
        make_synthetic_suite(10),
        restitution=RestitutionBand(draws=1),
        fitting=FitOptions(states=["overturned"], bands=None),
    )


def test_lines_dots_and_demand_are_those_of_the_surface(found: Fragility) -> None:
    axes = plots.fragility_surface(found, Figure().add_subplot(), pga_g=0.4, pgv_m_s=0.5)
    surface = found.surface
    (dots,) = (each for each in axes.collections if isinstance(each, PathCollection))
    assert surface is not None
    for line, share in zip(axes.lines[:3], (0.1, 0.5, 0.9), strict=True):
        assert surface.probability(np.column_stack(line.get_data())) == pytest.approx(share)
    assert [text.get_text() for text in axes.texts] == ["10 %", "50 %", "90 %"]
    runs = found.ensemble
    some = (runs.peak_angle > 0.0).any(("direction", "vertical", "draw")).values
    assert np.shape(dots.get_offsets()) == (some.sum(), 2)
    assert {to_hex(each) for each in np.asarray(dots.get_facecolor())} <= set(LIGHT.risk_ramp)
    (demand,) = (each for each in axes.lines if "demand" in str(each.get_label()))
    assert demand.get_data() == ([0.4], [0.5])
    chance = found.by_both_peaks(0.4, 0.5)
    assert chance is not None
    assert f"{100.0 * chance:.0f} %" in str(demand.get_label())
    bare = plots.fragility_surface(found, Figure().add_subplot())
    assert not any("demand" in str(each.get_label()) for each in bare.lines)


def test_loss_tools_get_the_cut_at_the_ratio_of_the_peaks(found: Fragility, tmp_path: Path) -> None:
    made = LossComponent.from_fragility(found, "RS.vase", pgv_per_pga_s=1.25 / 9.80665)
    (state,) = made.states
    assert found.surface is not None
    at = np.array([0.2, 0.5, 0.9])
    both = found.surface.probability(np.stack([at / 1.25, at], axis=-1))
    assert state.probability(at) == pytest.approx(both, rel=1e-12)
    assert made.no_damage == pytest.approx(1.25 * math.tan(BLOCK.alpha))
    write_pelicun(tmp_path / "a.csv", [made])
    assert "1.25 m/s per g" in state.note
    assert (made.measure, state.name) == ("pgv_m_s", "overturned")
    assert state.median is not None
    assert norm.cdf(0.0) == pytest.approx(float(state.probability(state.median)))


def test_without_a_surface_there_is_no_picture_and_no_component(found: Fragility) -> None:
    with pytest.raises(InputError, match=r"pga_g.*a demand has both peaks"):
        plots.fragility_surface(found, pga_g=0.4)
    with pytest.raises(InputError, match=r"pgv_m_s.*a demand has both peaks"):
        plots.fragility_surface(found, pgv_m_s=0.4)
    for peaks in ((0.0, 0.5), (0.4, -0.5), (math.nan, 0.5), (0.4, math.inf), (1e308, 0.5)):
        with pytest.raises(InputError, match=r"pga_g|pgv_m_s"):
            found.by_both_peaks(*peaks)
    none = replace(found, surface=None)
    with pytest.raises(InputError, match="no fitted surface"):
        plots.fragility_surface(none)
    with pytest.raises(InputError, match="no surface"):
        LossComponent.from_fragility(none, "A", pgv_per_pga_s=1.0)
    with pytest.raises(InputError, match="pgv_per_pga_s"):
        LossComponent.from_fragility(found, "A", pgv_per_pga_s=0.0)
