"""The picture of what stands side by side: a fill a cell, and no pattern over another."""

import matplotlib as mpl
import numpy as np
from matplotlib.colors import to_hex
from matplotlib.contour import ContourSet

from rocksteady.show.style.tokens import HATCHES, LIGHT
from rocksteady.studies.atlas.pages.pictures import (
    PERIODS,
    RARE,
    RISKS,
    draw_coexistence,
    draw_from_rest,
    period_fill,
)
from tests.studies.atlas.small import small

mpl.use("Agg")


def test_one_pattern_at_most_lies_over_a_place() -> None:
    found = small()
    _, lower = draw_coexistence(found.found, found.families, found.lines).axes
    patterns = [each for each in lower.collections if isinstance(each, ContourSet)]
    assert len(patterns) <= 1
    legend = lower.get_legend()
    assert legend is not None
    hatched = [patch for patch in legend.get_patches() if patch.get_hatch()]
    assert [patch.get_hatch() for patch in hatched] == [HATCHES["with_rests"]]
    # Motions of several periods are steps of one fill.
    fills = [to_hex(patch.get_facecolor()) for patch in legend.get_patches()[: len(PERIODS) + 1]]
    assert fills == [period_fill(LIGHT, part) for _, part in (*PERIODS, RARE)]
    assert len(set(fills)) == len(fills)


def test_where_rest_lasts_is_the_area_below_a_line() -> None:
    found = small()
    _, lower = draw_coexistence(found.found, found.families, found.lines).axes
    steps = [patch for patch in lower.patches if hasattr(patch, "get_data")]
    assert len(steps) == 1
    edge = np.asarray(steps[0].get_data().values)
    rows, _ = found.found.rest.shape
    low, high = found.found.plane.window[2:]
    middles = low + (np.arange(rows)[:, np.newaxis] + 0.5) * (high - low) / rows
    below = middles < edge
    assert (below <= found.found.rest).all()


def test_the_share_that_falls_is_in_steps_of_risk() -> None:
    found = small()
    upper, lower = draw_from_rest(found.rest, found.lines).axes
    (image,) = lower.images
    drawn = np.asarray(image.to_rgba(np.asarray(image.get_array())))
    share = found.rest.overturned
    for wanted, step in ((0.0, 0), (1.0, -1)):
        assert {to_hex(cell) for cell in drawn[share == wanted]} == {LIGHT.risk_ramp[step]}
    legends = [axes.get_legend() for axes in (upper, lower)]
    words = [[text.get_text() for text in each.get_texts()] for each in legends if each]
    assert {"comes to rest", "falls"} <= set(words[0])
    assert words[1] == list(RISKS[::-1])
