"""Limits: dashed ink on any paper, named on the line, and never beyond the axes."""

import warnings

import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from rocksteady import Block, State, Still, plots, simulate
from rocksteady.show.style.limits import draw_limit, name_level_end
from rocksteady.show.style.tokens import DARK, LIGHT, Inks


@pytest.mark.parametrize("inks", [LIGHT, DARK], ids=["light", "dark"])
def test_a_limit_is_dashed_ink_with_its_name_above(inks: Inks) -> None:
    figure = Figure(facecolor=inks.paper)
    axes = figure.add_subplot(facecolor=inks.paper)
    draw_limit(axes, 0.4, "threshold")
    (line,), (name,) = axes.lines, axes.texts
    assert line.is_dashed()
    assert to_hex(line.get_color()) == to_hex(name.get_color()) == inks.limit
    figure.draw_without_rendering()
    box = name.get_window_extent()
    assert box.y0 > axes.bbox.y1
    assert 0.5 * (box.x0 + box.x1) == pytest.approx(axes.bbox.x0 + 0.4 * axes.bbox.width, abs=1.0)


@pytest.mark.parametrize(("left", "below"), [(False, False), (True, True)])
def test_the_name_of_a_level_stands_inside_at_an_end(left: bool, below: bool) -> None:
    figure = Figure()
    axes = figure.add_subplot()
    name_level_end(axes, 0.5, "tipping angle", left=left, below=below)
    figure.draw_without_rendering()
    box, whole = axes.texts[0].get_window_extent(), axes.bbox
    assert whole.x0 < box.x0 < box.x1 < whole.x1
    assert bool(box.x0 - whole.x0 < whole.x1 - box.x1) is left
    assert bool(box.y1 < whole.y0 + 0.5 * whole.height) is below


def test_words_beyond_limits_that_are_given_later_take_no_room() -> None:
    block = Block.rectangle(width=0.3, height=1.8)
    run = simulate(block, Still(), start=State(angle=0.6, velocity=0.0))
    assert run.rest_time_pt is not None
    figure = Figure(figsize=(7.36, 4.6), layout="constrained")
    for axes in figure.subplots(2, sharex=True):
        plots.trajectory(run, axes).set(xlim=(0.0, 0.5 * run.rest_time_pt / block.p))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        figure.draw_without_rendering()
