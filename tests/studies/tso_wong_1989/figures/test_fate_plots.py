"""The strip of fates in the figure of a time history: its colours and its two sides."""

import numpy as np
import pytest
from matplotlib.colors import to_rgb

from rocksteady.show.style import palette
from rocksteady.studies.tso_wong_1989.figures._fate_plots import FILLS
from tests.studies.tso_wong_1989.whole import evidence

pytestmark = pytest.mark.usefixtures("computed")


def test_the_strip_of_fates_is_coloured_as_the_fates_are_on_its_side() -> None:
    case = evidence().histories["8b"]  # whose fates differ from end to end on either side
    figure = case.panel().draw()
    (strip,) = (axes for axes in figure.axes if axes.get_xlabel() == palette.LABELS["kick"])
    for image in strip.images:
        left, right, _, _ = image.get_extent()
        side = 1 if right > 0.0 else -1
        colours = np.asarray(image.get_array())[0, :, :3]
        expected = [to_rgb(FILLS[fate.kind]) for fate in case.fates_over_kicks[side]]
        if side < 0:
            expected.reverse()  # the smallest distance lies next to the middle
        scale = 255.0 if colours.max() > 1.0 else 1.0
        np.testing.assert_allclose(colours / scale, expected, atol=0.003)
        assert (left > 0.0) == (side > 0)
    assert len(strip.images) == 2
    places = sorted(
        float(np.asarray(line.get_xdata(), dtype=float)[0])
        for line in strip.lines
        if line.get_marker() == "v"
    )
    assert places == pytest.approx([-2.5, 2.5])
