"""Every named pulse, impulses, a sum and a synthetic motion: base acceleration and velocity.

Writes pulses.png into the folder that is given, by default the current one:
python examples/pulses.py docs/images
"""

import math
import sys
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import rocksteady as rs
from rocksteady.dynamics.history import base_motion
from rocksteady.dynamics.history.lowering import segment_table
from rocksteady.model.motions.pulses import PULSES
from rocksteady.model.motions.segments import Motion
from rocksteady.show.style import palette

PERIOD = 2.0 * math.pi  # of every pulse: p t is then omega t


def draw(axes: Axes, title: str, motion: Motion, end: float) -> None:
    """Draw one motion over time in periods, with some of the still base around it."""
    later = rs.delay_motion(motion, 0.1 * end)
    table = segment_table(later)
    even = np.linspace(0.0, 1.25 * end, 2001)
    velocity = np.gradient(base_motion.displacement_from_rest(table, even), even)
    times, acceleration = base_motion.base_course(table, even)
    even, times = (even - 0.1 * end) / PERIOD, (times - 0.1 * end) / PERIOD
    axes.axhline(0.0, color=palette.FAINT, lw=0.6)
    axes.plot(even, velocity, color=palette.LINES[1], lw=1.0, ls=(0, (4, 2)), label="velocity")
    axes.plot(times, acceleration, color=palette.BASE, label="acceleration")
    struck, sizes = base_motion.impulses(table)
    at = (struck - 0.1 * end) / PERIOD
    axes.vlines(at, 0.0, sizes, color=palette.BASE, lw=1.4)
    for up, marker in ((True, "^"), (False, "v")):
        chosen = (sizes > 0.0) == up
        axes.plot(at[chosen], sizes[chosen], marker, color=palette.BASE, ms=5.0)
    axes.set_title(title)
    axes.set_xlim(times[0], times[-1])


def main(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    panels: list[tuple[str, Motion, float]] = []
    for name in PULSES:
        pulse = rs.Pulse(shape=name, amplitude=1.0, frequency_ratio=1.0, tolerance=1e-4)
        panels.append((name, pulse, pulse.duration))
    hits = rs.Impulses(velocities=(1.0, -1.5, 0.5), times=(0.0, 3.0, 6.0))
    panels.append(("impulses", hits, 7.0))
    slow = rs.Pulse(shape="one-sine", amplitude=0.7, frequency_ratio=1.0)
    fast = rs.Pulse(shape="type-c2", amplitude=0.3, frequency_ratio=4.0)
    both = rs.add_motions(slow, rs.delay_motion(fast, 1.0), tolerance=1e-4)
    panels.append(("a sum: one-sine and a later type-c2", both, PERIOD))
    noise = rs.SyntheticMotion(rms=0.35, frequency_ratio=1.0, duration=20 * PERIOD, seed=2)
    panels.append(("a synthetic motion", noise, noise.duration))

    with palette.style():
        figure = Figure(figsize=(11.0, 9.0))
        grid = figure.subplots(4, 4)
        for axes, panel in zip(grid.flat, panels, strict=True):
            draw(axes, *panel)
        for axes in grid[-1]:
            axes.set_xlabel("time [periods]")
        for axes in grid[:, 0]:
            axes.set_ylabel(r"$a/a_{\max}$,  $\omega v/a_{\max}$")
        grid[-1, 1].legend(loc="lower right")
        figure.savefig(folder / "pulses.png", dpi=130)


if __name__ == "__main__":
    main(Path(*sys.argv[1:2]))
