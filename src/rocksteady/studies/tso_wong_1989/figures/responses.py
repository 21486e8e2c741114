"""Figs 5, 6 and 7: peaks of the out-of-phase motion against frequency."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np

from rocksteady import Block, DimensionlessBlock, compute_response_curve, plots
from rocksteady.orbits import ResponseCurve
from rocksteady.studies.tso_wong_1989.figures.panel import Panel
from rocksteady.studies.tso_wong_1989.figures.words import motion_name

if TYPE_CHECKING:
    from matplotlib.figure import Figure

AMPLITUDES = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
"""Of Fig. 5."""
P_VALUES = (0.5 * math.pi, math.pi, 2.0 * math.pi, 4.0 * math.pi)
"""Frequency parameters of Fig. 6 [rad/s]; those of the paper are not legible."""
RESTITUTIONS = (0.7, 0.8, 0.9, 1.0)
"""Of Fig. 7."""
AMPLITUDE = 3.0
"""Of Fig. 6, and chosen for Fig. 7."""
RESTITUTION = 0.8
"""Of Figs 5 and 6."""
ALPHA = 0.2
"""Slenderness of the blocks of Fig. 6 [rad]; no result depends on it."""

DRAWN_BY_STABILITY = (
    "Drawn solid where the motion is stable and dashed where it is unstable, which the paper does "
    "not distinguish; left out where it passes through the floor."
)

Quantity = Literal["amplitude", "p", "restitution"]


@dataclass(frozen=True, kw_only=True)
class Responses:
    """Response curves of one order over one quantity."""

    id: str
    quantity: Quantity
    order: int
    ends: tuple[float, float]
    says: str
    chosen: tuple[str, ...] = ()

    @property
    def values(self) -> tuple[float, ...]:
        """Values of the quantity, one per curve."""
        return {"amplitude": AMPLITUDES, "p": P_VALUES, "restitution": RESTITUTIONS}[self.quantity]

    @property
    def hertz(self) -> bool:
        """Whether the abscissa is in Hz."""
        return self.quantity == "p"

    @cached_property
    def curves(self) -> list[ResponseCurve]:
        """The curves, in the order of the values."""
        start, stop = self.ends
        frequencies = np.linspace(start, stop, round(100 * (stop - start)) + 1)
        curves = []
        for value in self.values:
            if self.quantity == "amplitude":
                block: Block | DimensionlessBlock = DimensionlessBlock(restitution=RESTITUTION)
                curve = compute_response_curve(
                    block, value, frequency_ratio=frequencies, order=self.order
                )
            elif self.quantity == "p":
                block = Block.from_p(alpha=ALPHA, p=value, restitution=RESTITUTION)
                curve = compute_response_curve(
                    block, AMPLITUDE, frequency_hz=frequencies, order=self.order, model="linear"
                )
            else:
                block = DimensionlessBlock(restitution=value)
                curve = compute_response_curve(
                    block, AMPLITUDE, frequency_ratio=frequencies, order=self.order
                )
            curves.append(curve)
        return curves

    @property
    def labels(self) -> list[str]:
        """Legend entries."""
        if self.quantity == "amplitude":
            return [f"A = {value:g}" for value in self.values]
        if self.quantity == "p":
            return [f"p = {_of_pi(value)} rad/s" for value in self.values]
        return [f"δ = {value:g}" for value in self.values]

    @property
    def title(self) -> str:
        """What it shows, in one line."""
        fixed = {
            "amplitude": f"δ = {RESTITUTION:g}",
            "p": f"A = {AMPLITUDE:g}, δ = {RESTITUTION:g}",
            "restitution": f"A = {AMPLITUDE:g}",
        }[self.quantity]
        return f"Peak of the symmetric {motion_name(self.order)} (branch 1), {fixed}"

    def panel(self) -> Panel:
        """Return the figure with its data and its words."""
        curves = self.curves
        return Panel(
            id=self.id,
            title=self.title,
            says=self.says,
            computed=" ".join(self._sentences(curves)),
            choices=(
                *self.chosen,
                DRAWN_BY_STABILITY,
            ),
            header=(
                self.quantity, "frequency_hz" if self.hertz else "frequency_ratio", "peak",
                "stable",
            ),
            rows=list(self._rows(curves)),
            draw=self._draw,
        )  # fmt: skip

    def _sentences(self, curves: list[ResponseCurve]) -> Iterator[str]:
        """Say for each curve where it is stable and, if it does, where it ends."""
        for label, curve in zip(self.labels, curves, strict=True):
            x = curve.frequency_hz if self.hertz else curve.frequency_ratio
            assert x is not None
            finite = np.isfinite(curve.peak)
            if not finite.any():
                yield f"{label}: no such motion on this axis."
                continue
            unit = " Hz" if self.hertz else ""
            name = "" if self.hertz else "Ω = "
            end = float(x[finite][-1])
            reaches = "to the end of the axis" if end == x[-1] else f"to {name}{end:.2f}{unit}"
            neutral = curve.states.neutral[curve.branch - 1]
            if curve.stable.any():
                lowest = f"stable from {name}{float(x[curve.stable][0]):.2f}{unit}"
            elif neutral.any():
                lowest = f"neutral from {name}{float(x[neutral][0]):.2f}{unit}, nowhere stable"
            else:
                lowest = "nowhere stable"
            yield f"{label}: exists {reaches}, {lowest}."

    def _rows(self, curves: list[ResponseCurve]) -> Iterator[tuple[object, ...]]:
        for value, curve in zip(self.values, curves, strict=True):
            x = curve.frequency_hz if self.hertz else curve.frequency_ratio
            assert x is not None
            rows = zip(x.tolist(), curve.peak.tolist(), curve.stable.tolist(), strict=True)
            for row in rows:
                yield (value, *row)

    def _draw(self) -> "Figure":
        from matplotlib.figure import Figure

        from rocksteady.show.style import palette

        with palette.style():
            figure = Figure(figsize=(5.6, 4.0))
            axes = plots.response(
                self.curves, figure.add_subplot(), hertz=self.hertz, labels=self.labels, top=1.0
            )
            axes.set_xlim(0.0, self.ends[1])
            axes.set_title(f"Fig. {self.id}  {self.title}")
        return figure


P_ILLEGIBLE = (
    "The values of p are not legible in the scan: π/2, π, 2π and 4π rad/s are taken, which belong "
    "to homogeneous blocks of half-diagonal 2.98, 0.75, 0.19 and 0.05 m."
)
A_ILLEGIBLE = "The amplitude is not legible in the scan: A = 3, as in Fig. 6, is taken."

RESPONSES = (
    Responses(
        id="5a", quantity="amplitude", order=1, ends=(0.05, 16.0),
        says="Peaks of the harmonic motion grow as the frequency falls, without a resonance, and "
        "less than in proportion to the excitation.",
    ),
    Responses(
        id="5b", quantity="amplitude", order=3, ends=(0.05, 16.0),
        says="The same for the 1/3 subharmonic; the curves of A = 1 and A = 2 end where no such "
        "motion exists any more.",
    ),
    Responses(
        id="6a", quantity="p", order=1, ends=(0.05, 16.0),
        says="In this motion the peak at one frequency in Hz grows with p.",
        chosen=(P_ILLEGIBLE,),
    ),
    Responses(
        id="6b", quantity="p", order=3, ends=(0.05, 16.0),
        says="The same for the 1/3 subharmonic.", chosen=(P_ILLEGIBLE,),
    ),
    Responses(
        id="7a", quantity="restitution", order=1, ends=(0.05, 14.0),
        says="The restitution hardly matters to the harmonic motion, whose peak grows with it.",
        chosen=(A_ILLEGIBLE,),
    ),
    Responses(
        id="7b", quantity="restitution", order=3, ends=(0.05, 14.0),
        says="The peak of the 1/3 subharmonic falls as the restitution grows.",
        chosen=(A_ILLEGIBLE,),
    ),
)  # fmt: skip


def _of_pi(value: float) -> str:
    """Return a whole multiple or fraction of pi as people write it."""
    multiple = value / math.pi
    if multiple < 1.0:
        return f"π/{1.0 / multiple:g}"
    return f"{multiple:g}π" if multiple > 1.0 else "π"


def responses() -> dict[str, Responses]:
    """Return the response curves of Figs 5 to 7 by number; nothing is computed yet."""
    return {response.id: response for response in RESPONSES}
