"""Figs 3 and 4: regions of symmetric motions in the plane of frequency and amplitude."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from rocksteady import plots
from rocksteady.formulas import steady_states
from rocksteady.orbits import RegionMap, SteadyStates, compute_region_map
from rocksteady.studies.tso_wong_1989.figures.panel import Panel
from rocksteady.studies.tso_wong_1989.figures.words import motion_name, percent

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HIGHEST_FREQUENCY, HIGHEST_AMPLITUDE = 14.0, 6.0
"""Ends of the paper's axes."""
FREQUENCIES = np.linspace(0.05, HIGHEST_FREQUENCY, 1396)
"""Frequency ratios of the curves, .01 apart; below the first one every curve is near 0."""
GRID = 240
"""Points on either axis of the map of admissible motions."""


@dataclass(frozen=True, kw_only=True)
class Plane:
    """The plane of frequency and amplitude for one restitution and order."""

    id: str
    restitution: float
    order: int

    @cached_property
    def curves(self) -> RegionMap:
        """Every boundary."""
        return compute_region_map(FREQUENCIES, self.restitution, order=self.order)

    @cached_property
    def states(self) -> SteadyStates:
        """Both solutions on a grid over the paper's axes, shape (amplitudes, frequencies)."""
        amplitudes = (np.arange(GRID) + 0.5) * (HIGHEST_AMPLITUDE / GRID)
        ratios = (np.arange(GRID) + 0.5) * (HIGHEST_FREQUENCY / GRID)
        return steady_states(amplitudes[:, np.newaxis], ratios, self.restitution, order=self.order)

    @cached_property
    def shares(self) -> dict[int, float]:
        """Part of the paper's window that each region takes, from its boundary curves."""
        return region_shares(self.curves)

    def panel(self) -> Panel:
        """Return the figure with its data and its words."""
        states, shares, curves = self.states, self.shares, self.curves
        assert states.admissible is not None
        through = (states.region != 4) & ~states.admissible[0]
        parts = [
            "Shares of the window: "
            + ", ".join(
                f"region {number} {percent(share)}" for number, share in shares.items() if share
            )
            + "."
        ]
        parts.append(
            f"Region 3 lies between (23) and (25), whose ratio is at least "
            f"{float((curves.existence / np.minimum(curves.kind, curves.sign)).min()):.4f}: "
            "narrow, and never empty."
        )
        lost = int(through.sum())
        parts.append(
            f"On {lost} of {int((states.region != 4).sum())} grid points with solutions the "
            "solution of branch 1 passes through the floor within its half cycle and is no motion"
            + (" (hatched)." if lost else ".")
        )
        parts.append(
            "Added to the paper's curves: symmetry breaking, above which the out-of-phase motion "
            "is unstable, and the heteroclinic curve, above which basins are fractal."
        )
        return Panel(
            id=self.id,
            title=f"Regions of the symmetric {motion_name(self.order)}, δ = {self.restitution:g}",
            says=SAYS[self.id],
            computed=" ".join(parts),
            choices=(),
            header=(
                "frequency_ratio", "existence_eq23", "sign_eq24", "kind_eq25",
                "symmetry_breaking", "heteroclinic",
            ),
            rows=list(
                zip(
                    *(
                        values.tolist()
                        for values in (
                            curves.frequency_ratio, curves.existence, curves.sign, curves.kind,
                            curves.symmetry_breaking, curves.heteroclinic,
                        )
                    ),
                    strict=True,
                )
            ),
            draw=self._draw,
        )  # fmt: skip

    def _draw(self) -> "Figure":
        from matplotlib.figure import Figure
        from matplotlib.patches import Patch

        from rocksteady.show.style import palette
        from rocksteady.show.style.areas import draw_pattern
        from rocksteady.show.style.legends import draw_legend
        from rocksteady.show.style.tokens import HATCHES, inks_of

        states = self.states
        assert states.admissible is not None
        with palette.style():
            figure = Figure(figsize=(7.2, 4.2))
            axes = plots.steady_regions(
                self.curves, figure.add_subplot(), top=HIGHEST_AMPLITUDE, legend="right"
            )
            axes.set_xlim(0.0, HIGHEST_FREQUENCY)
            through = (states.region != 4) & ~states.admissible[0]
            if through.any():
                inks = inks_of(axes)
                edges = (
                    np.linspace(0.0, HIGHEST_FREQUENCY, GRID + 1),
                    np.linspace(0.0, HIGHEST_AMPLITUDE, GRID + 1),
                )
                hatch = HATCHES["no_start"]
                draw_pattern(axes, edges, through, hatch, inks.edge, thin=True)
                handles, words = axes.get_legend_handles_labels()
                handles.append(Patch(fc="none", ec=inks.edge, hatch=hatch))
                words.append("branch 1 passes\nthrough the floor")
                draw_legend(axes, "right", handles=handles, labels=words)
            axes.set_title(
                f"Fig. {self.id}  Symmetric {motion_name(self.order)}, δ = {self.restitution:g}"
            )
        return figure


PLANES = (
    Plane(id="3a", restitution=0.5, order=1),
    Plane(id="3b", restitution=0.95, order=1),
    Plane(id="4a", restitution=0.5, order=3),
    Plane(id="4b", restitution=0.95, order=3),
)

SAYS = {
    "3a": "Regions 1 and 2 with one out-of-phase and one in-phase solution, region 3 with two "
    "in-phase ones, region 4 with none.",
    "3b": "With little loss at impacts region 3 has gone, and region 4 has shrunk.",
    "4a": "The same plane for the 1/3 subharmonic, with a fifth region of two in-phase solutions.",
    "4b": "With little loss at impacts region 2 has grown at the expense of regions 3 and 4, and "
    "region 1 is as it was.",
}


def planes() -> dict[str, Plane]:
    """Return the planes of Figs 3 and 4 by number; nothing is computed yet."""
    return {plane.id: plane for plane in PLANES}


def region_shares(curves: RegionMap, top: float = HIGHEST_AMPLITUDE) -> dict[int, float]:
    """Return the part of the window below `top` that each region takes.

    Parameters
    ----------
    curves
        From `rocksteady.orbits.compute_region_map`.
    top
        Upper end of the amplitude axis.

    Returns
    -------
    dict
        Region 1 to 5: share, by the trapezoidal rule between the boundary curves.
    """
    w = curves.frequency_ratio
    span = (w[-1] - w[0]) * top
    existence, kind, sign = (
        np.minimum(values, top) for values in (curves.existence, curves.kind, curves.sign)
    )
    heights = {
        1: np.maximum(sign - kind, 0.0),
        2: top - np.maximum(kind, sign),
        3: np.minimum(kind, sign) - existence,
        4: existence,
        5: np.maximum(kind - sign, 0.0),
    }
    return {number: float(np.trapezoid(height, w) / span) for number, height in heights.items()}
