"""The one source of colours, labels and units.

The fills tell attractors apart for normal and for colour-blind sight; lines on white take darker
shades of the same hues.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

REST = "#fcfaf3"
SYMMETRIC = "#76c6fe"
UNSYMMETRIC = "#bda613"
SUBHARMONIC = "#477f68"
APERIODIC = "#87439e"
OVERTURNED = "#272728"
UNDECIDED = "#9a9a9a"

INK = OVERTURNED
FAINT = "#8b8b8b"
NUMBER = "#5b5b5c"
"""Numbers and labels on the fills."""
GRID = "#dedede"
LINES = ("#1273b8", "#b0531b", "#477f68", "#87439e", "#8a7906", "#5b5b5c")
"""Line colours in the order of their use; with the dashes below they differ in grey too."""
DASHES: tuple[Any, ...] = ("-", (0, (6, 2)), (0, (2, 1.5)), (0, (6, 2, 1.5, 2)), (0, (1, 1)), "-")
IMPACT = "#b0531b"
BASE = "#477f68"
BLOCK = SYMMETRIC
GROUND = "#e9e6dc"

REGION_FILLS = {1: "#d5edff", 2: "#ffffff", 3: "#f0e7b0", 4: "#e9e6dc", 5: "#dcc8e4"}

LABELS = {
    "amplitude": r"amplitude  $A = a_{\max}/(\alpha g)$",
    "frequency_ratio": r"frequency ratio  $\Omega = \omega/p$",
    "frequency_hz": "frequency [Hz]",
    "angle": r"angle  $\theta/\alpha$",
    "velocity": r"velocity  d$(\theta/\alpha)$/d$(pt)$",
    "velocity_tau": r"velocity  d$(\theta/\alpha)$/d$(\omega t)$",
    "peak": r"peak  $|\theta|_{\max}/\alpha$",
    "periods": "time [excitation periods]",
    "kick": "distance from the orbit, with its side",
    "periods_short": "time [periods]",
    "half_cycle": r"time since impact  $\omega t/2\pi$ [excitation periods]",
    "pivot_time": "pivot time  $pt$",
    "seconds": "time [s]",
    "base": r"base  $a/(\alpha g)$",
    "position_m": "position [m]",
    "ground_m": "position on the ground [m]",
    "ground_radius": "position on the ground  $x/R$",
    "height_m": "height [m]",
    "position_radius": "position  $x/R$",
    "height_radius": "height  $y/R$",
    "phase": "phase of the shaking at the impact [rad]",
    "speed": r"speed after the impact  $|$d$(\theta/\alpha)$/d$(pt)|$",
    "multiplier_real": r"real part of the multipliers  Re $\mu$",
    "multiplier_imaginary": r"imaginary part  Im $\mu$",
}
"""Axis labels with their units; angles, amplitudes and ratios have none."""

STYLE: dict[str, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.labelsize": 9.0,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.7,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "grid.color": GRID,
    "grid.linewidth": 0.5,
    "xtick.color": INK,
    "ytick.color": INK,
    "text.color": INK,
    "legend.fontsize": 8.0,
    "legend.frameon": False,
    "lines.linewidth": 1.3,
    "figure.dpi": 100.0,
    "savefig.dpi": 200.0,
    "figure.constrained_layout.use": True,
    "svg.fonttype": "path",
    "svg.hashsalt": "rocksteady",
}


@contextmanager
def style() -> Iterator[None]:
    """Apply the house style inside a ``with`` block, and leave the user's own settings alone."""
    import matplotlib as mpl

    with mpl.rc_context(STYLE):  # type: ignore[arg-type]  # its keys are a type of 300 literals
        yield
