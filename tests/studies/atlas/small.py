"""A small atlas, computed once for all tests of a process."""

from functools import cache

import numpy as np
from matplotlib.figure import Figure

from rocksteady.studies.atlas._study import Atlas, atlas
from rocksteady.studies.atlas.analysis.plane import Plane

AMPLITUDES = np.linspace(0.4, 8.0, 5)
FREQUENCY_RATIOS = np.linspace(0.6, 12.0, 5)


@cache
def plane() -> Plane:
    return Plane(restitution=0.8, amplitude=AMPLITUDES, frequency_ratio=FREQUENCY_RATIOS)


@cache
def small() -> Atlas:
    return atlas(0.8, amplitude=AMPLITUDES, frequency_ratio=FREQUENCY_RATIOS)


@cache
def smallest() -> Atlas:
    """Nine cells and one order, for tests of what is done with an atlas."""
    return atlas(0.8, amplitude=[1.0, 2.0, 3.0], frequency_ratio=[2.0, 4.0, 6.0], orders=(1,))


def tiny(*_: object) -> Figure:
    """A picture that costs nothing."""
    return Figure(figsize=(0.5, 0.5), dpi=40)
