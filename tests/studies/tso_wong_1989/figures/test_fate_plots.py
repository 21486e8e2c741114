"""The strip of fates in the figure of a time history: its colours and its two sides."""

import numpy as np
import pytest
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_hex

from rocksteady.show.style import palette
from rocksteady.show.style.tokens import HATCHES, LIGHT
from rocksteady.studies.tso_wong_1989.figures._fate_plots import LOOKS
from rocksteady.studies.tso_wong_1989.figures.cases import KICKS, SIDES
from tests.studies.tso_wong_1989.whole import evidence

pytestmark = pytest.mark.usefixtures("computed")


@pytest.mark.slow
def test_the_strip_of_fates_is_coloured_as_the_fates_are_on_its_side() -> None:
    case = evidence().histories["8b"]  # whose fates differ from end to end on either side
    figure = case.panel().draw()
    (strip,) = (axes for axes in figure.axes if axes.get_xlabel() == palette.LABELS["kick"])
    decades = np.linspace(0.5, 0.5 + np.log10(KICKS[-1] / KICKS[0]), len(KICKS))
    bars = [each for each in strip.collections if isinstance(each, PolyCollection)]
    for side in SIDES:
        for place, fate in zip(side * decades, case.fates_over_kicks[side], strict=True):
            covering = [
                each
                for each in bars
                if any(path.get_extents().x0 < place < path.get_extents().x1
                       for path in each.get_paths())
            ]  # fmt: skip
            (bar,) = covering
            role = LOOKS[fate.kind][1]
            assert to_hex(np.asarray(bar.get_facecolor())[0].tolist()) == getattr(LIGHT, role)
            assert bar.get_hatch() == HATCHES.get(role)
    places = sorted(
        float(np.asarray(line.get_xdata(), dtype=float)[0])
        for line in strip.lines
        if line.get_marker() == "v"
    )
    assert places == pytest.approx([-2.5, 2.5])
