"""The picture of what stands side by side: a fill a cell, and no pattern over another."""

import matplotlib as mpl
import numpy as np
from matplotlib.contour import ContourSet

from rocksteady.studies.atlas.pages.pictures import PERIODS, REST_EDGE, draw_coexistence
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
    assert len(hatched) == 1


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
    assert len({fill for _, fill in PERIODS}) == 3
    assert REST_EDGE["lw"] > 1.0
