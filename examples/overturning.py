"""Overturning spectra of two pulses, one of the full equations, and free rocking.

Writes overturning.png, overturning-nonlinear.png and free-rocking.png into the folder that is
given, by default the current one: python examples/overturning.py docs/images
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import rocksteady as rs
from rocksteady.show.style import palette

RATIOS = np.geomspace(0.5, 8.0, 400)


def main(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    block = rs.DimensionlessBlock(restitution=0.9)
    with palette.style():
        figure = Figure(figsize=(9.6, 4.6))
        left, right = figure.subplots(1, 2, sharey=True)
        for axes, shape in ((left, "one-sine"), (right, "one-cosine")):
            found = rs.find_overturning_windows(block, shape, RATIOS, within=(1.0, 12.0))
            rs.plot_overturning(found, axes)
            axes.set_title(f"{shape} pulse, restitution {block.restitution:g}")
            axes.grid(visible=False)
        left.get_legend().remove()
        right.set_ylabel("")
        handles = right.get_legend().legend_handles
        right.get_legend().remove()
        words = [handle.get_label() for handle in handles]
        figure.legend(handles, words, loc="outside lower center", ncols=5, columnspacing=1.4)
        figure.savefig(folder / "overturning.png", dpi=150)

        cabinet = rs.named_block("zhang-makris-2001")
        ratios = np.linspace(0.5, 9.0, 400)
        full = rs.find_overturning_windows(cabinet, "one-sine", ratios, within=(1.0, 15.0))
        figure = Figure(figsize=(8.0, 4.4))
        axes = rs.plot_overturning(full, figure.add_subplot())
        axes.set_title("one-sine pulse, full equations, α = 0.25 rad, restitution 0.9")
        axes.grid(visible=False)
        figure.savefig(folder / "overturning-nonlinear.png", dpi=150)

        figure = Figure(figsize=(5.6, 3.6))
        rs.plot_free_rocking([0.95, 0.8], figure.add_subplot())
        figure.savefig(folder / "free-rocking.png", dpi=150)


if __name__ == "__main__":
    main(Path(*sys.argv[1:2]))
