"""A backend of pyplot that does what the one of notebooks does, without a kernel.

The first figure loads it. Loading makes pyplot interactive; a figure that is opened while pyplot is
interactive is shown at the end of its cell, and then all that are open are shown and closed.
"""

from typing import Any

import matplotlib as mpl
from matplotlib.backend_bases import FigureManagerBase
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

FigureCanvas = FigureCanvasAgg
mpl.interactive(True)
opened: list[Figure] = []
"""In the cell that runs, while pyplot was interactive."""


def new_figure_manager(num: int, *args: Any, FigureClass: Any = Figure, **keywords: Any) -> Any:
    figure = FigureClass(*args, **keywords)
    if mpl.is_interactive():
        opened.append(figure)
    return FigureManagerBase(FigureCanvasAgg(figure), num)


def end_of_cell() -> int:
    """Return how many pictures a notebook would show below the cell, and close the figures."""
    import matplotlib.pyplot as plt

    shown = [plt.figure(number) for number in plt.get_fignums()] if opened else []
    for figure in shown:
        figure.canvas.draw()
        plt.close(figure)
    opened.clear()
    return len(shown)
