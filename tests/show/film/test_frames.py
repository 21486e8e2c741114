"""Pictures of rocking frames: columns that turn alike, and a cap on their upper corners."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from rocksteady import Block, Pulse, simulate
from rocksteady.model.blocks.tops import top_displacement
from rocksteady.show.film._geometry import MOST_COLUMNS, shape_of_block
from rocksteady.show.film._scene import BlockScene
from rocksteady.show.film.still import plot_block

SIZES = {"width": 1.6, "height": 9.6}


@pytest.mark.parametrize("time", [0.0, 0.9, 2.4])
def test_the_cap_stands_on_the_highest_corner_of_every_column(time: float) -> None:
    """At rest on both, leaning to the left on the right one, and the reverse."""
    frame = Block.frame(columns=3, cap_mass_ratio=1.0, **SIZES)
    pulse = Pulse.from_si(frame, shape="one-sine", acceleration_m_s2=2.4, frequency_hz=0.5)
    axes = Figure().add_subplot()
    scene = BlockScene(axes, simulate(frame, pulse), np.linspace(0.0, 3.0, 20))
    scene.show(time)
    *columns, cap = [
        (body.get_transform() - axes.transData).transform(body.get_xy())[:4]
        for body in scene.bodies
    ]
    assert len(columns) == 3
    tops = np.array([column[column[:, 1].argmax()] for column in columns])
    assert tops[:, 1] == pytest.approx(cap[0, 1])
    moved = np.sign(-scene.theta(time)) * top_displacement(frame, scene.theta(time))
    assert cap[:, 0].mean() == pytest.approx(moved + scene.ground(time), abs=1e-9)
    assert np.diff(columns, axis=0)[..., 1] == pytest.approx(0.0, abs=1e-9)
    low, high = axes.get_ylim()
    assert low < 0.0 < cap[:, 1].max() < high
    left, right = axes.get_xlim()
    assert left < cap[:, 0].min() < cap[:, 0].max() < right


def test_few_columns_of_many_are_drawn_and_the_model_names_them() -> None:
    """And a single block has neither columns nor cap."""
    many = Block.frame(columns=40, cap_mass_ratio=0.5, **SIZES)
    assert len(shape_of_block(many).places) == MOST_COLUMNS
    single = shape_of_block(Block.rectangle(**SIZES))
    assert single.places.tolist() == [0.0]
    assert single.cap.size == 0
    axes = plot_block(many, Figure().add_subplot())
    texts = {text.get_text() for text in axes.texts}
    assert {"$N$", "40 columns", "$\\gamma$", "0.5 of their mass, the cap"} <= texts
