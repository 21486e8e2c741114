"""Plots of what is proved: each verdict has its colour, and what is undecided its pattern."""

import numpy as np
from matplotlib.figure import Figure

import rocksteady as rs
from rocksteady.certify.plots import ROLES, plot_proved_region
from rocksteady.show.style.tokens import inks_of


def test_cells_have_the_fill_of_their_verdict_and_the_legend_names_them() -> None:
    region = rs.proofs.certify_region((0.5, 6.0), (2.0, 8.0), 0.8, order=3, most_boxes=800)
    axes = plot_proved_region(region, Figure().add_subplot())
    mesh = axes.collections[0]
    fills = {tuple(fill) for fill in mesh.cmap(np.arange(len(ROLES)) / (len(ROLES) - 1))}
    assert len(fills) == len(ROLES)
    legend = axes.get_legend()
    assert legend is not None
    named = [text.get_text() for text in legend.get_texts()]
    assert named == ["symmetric, stable", "unstable", "no solution", "undecided"]
    assert len(axes.collections) + len(axes.patches) > 1, "what is undecided has a pattern"
    assert getattr(inks_of(axes), ROLES["2"]).startswith("#")
