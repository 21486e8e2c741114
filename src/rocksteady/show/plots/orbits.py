"""Plots of periodic motions: the Poincare section just after impact, and Floquet multipliers."""

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.dynamics.basins.labels import BasinAttractor
from rocksteady.dynamics.basins.over.families import BasinFamily
from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.dynamics.orbits.attractor import Attractor
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.errors import ModelError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import finite
from rocksteady.show.style import palette
from rocksteady.show.style.layout import (
    axes_or_new,
    clear_place,
    emptiest_corner,
    extent,
    put_beside,
)
from rocksteady.show.style.legends import LegendPlace, draw_legend, place_of, size_of, text_size
from rocksteady.show.style.scales import Scale, scale_of
from rocksteady.show.style.tokens import DASHED, Inks, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

LINEAR_REACH = 2.0
"""Modulus up to which multipliers are drawn to scale; with larger ones the scale is logarithmic
outside the unit circle."""
MOST_RINGS = 3
"""Circles outside the unit circle, for powers of ten."""
RINGS_AT = math.radians(-105.0)
"""Direction in which their numbers stand; multipliers are real or come in pairs about the axis."""
MOST_NUMBERS = 100
"""Orbits that are numbered."""
MOST_CROWDED = 90.0
"""Diameter of the unit circle [points] below which it has fewer ticks."""
LEAST_NAMED = 66.0
"""Diameter of the unit circle [points] from which on its name fits in."""
NAME = (56.0, 16.0)
"""Width and height of its name with a mark about it [points]."""
HEIGHTS_OF_NAME = (-0.74, 0.74, -0.22, 0.22)
"""Heights at which the name may stand, in radii: the first where it covers fewest marks."""
BEYOND = r"beyond the circle: $\log|\mu|$"
"""What the distance from the unit circle is, where multipliers are far outside it."""
MARKERS = {1: "^", -1: "v"}
"""Of the side to which the block goes."""


@checked
def plot_poincare_section(
    motions: Orbit | Iterable[Orbit] | Attractor | BasinAttractor | BasinFamily | Trajectory,
    ax: "Axes | None" = None,
    *,
    since: float = 0.0,
    legend: LegendPlace | None = None,
) -> "Axes":
    """Draw the Poincare section just after impact: speed against the phase of the shaking.

    Of orbits, every state: stable ones filled, unstable ones hollow, neutral ones half filled, with
    the colour of their kind and a triangle that points to the side to which the block goes.
    Several orbits have numbers, in the order in which they come, at their first state.  An uplift
    from rest is a state with speed 0.  Solutions that pass through the floor are left out.

    For a trajectory, every impact: a motion that never repeats draws a cloud.

    Parameters
    ----------
    motions
        From `rocksteady.find_orbits`, from `rocksteady.find_attractor`, or from
        `rocksteady.simulate` under harmonic shaking; one orbit or several.  Of an attractor of
        basins its orbit, and of one followed over a parameter that at each value.
    ax
        Axes to draw on; default: axes of a new figure.
    since
        Pivot time p t from which on the impacts of a trajectory are drawn.
    legend
        "inside" the axes, to their "right", "below" them or "none"; by default inside, or
        below narrow ones.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: phase of the shaking, 0 to 2 pi, and speed after the impact: degrees a second of
        a `rocksteady.Block`, else |d(theta/alpha)/d(p t)|.

    Raises
    ------
    ModelError
        If the shaking of a trajectory is not harmonic, or an attractor of basins has no orbit.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, Harmonic, find_orbits
    >>> shaking = Harmonic(amplitude=2.0, frequency_ratio=1.9)
    >>> orbits = find_orbits(DimensionlessBlock(restitution=0.8), shaking, max_period=1)
    >>> axes = plot_poincare_section(orbits, Figure().add_subplot())
    >>> [number.get_text() for number in axes.texts]  # the second is no motion
    ['1', '3']
    """
    since = finite("since", since, hint="give a pivot time p t")
    if isinstance(motions, Attractor):
        if motions.orbit is None:
            run = motions.trajectory()
            motions, since = run, since or 0.5 * run.end_time_pt
        else:
            motions = motions.orbit
    if isinstance(motions, BasinAttractor | BasinFamily):
        motions = _orbits_of(motions)
    axes = axes_or_new(ax)
    if isinstance(motions, Trajectory):
        labels: list[tuple[str, float, float]] = []
        scale = _speed_scale(motions.block)
        handles, phase, speed = _draw_impacts(axes, motions, since, scale.factor)
    else:
        numbered = _numbered(motions)
        orbits = [orbit for _, orbit in numbered]
        scale = _speed_scale(orbits[0].block if orbits else None)
        handles, phase, speed = _draw_states(axes, orbits, scale.factor)
        labels = [
            (text, orbit.states[0].phase, scale.factor * orbit.states[0].speed)
            for text, orbit in numbered
        ]
    top = float(speed.max(initial=0.0))
    columns = 1 if len(handles) < 4 else 2
    place = place_of(axes, legend, "inside", width=115.0 * columns)
    size = extent(axes, width=115.0 * columns, height=12.0 * math.ceil(len(handles) / columns) + 14)
    room = size[1] if place == "inside" else 0.0
    axes.set(
        xlabel=palette.LABELS["phase"],
        ylabel=scale.label,
        xlim=(0.0, 2.0 * math.pi),
        # A legend inside goes above what is drawn.
        ylim=(-0.04 * top, top / max(0.3, 0.95 - room)) if top > 0.0 else (0.0, 1.0),
    )
    turns = ("0", r"$\pi/2$", r"$\pi$", r"$3\pi/2$", r"$2\pi$")
    axes.set_xticks([0.5 * math.pi * k for k in range(5)], turns)
    corner = emptiest_corner(axes, (phase, speed), size)
    draw_legend(axes, place, handles=handles, corner=corner, columns=columns)
    put_beside(axes, labels, (phase, speed))
    return axes


@checked
def plot_multipliers(
    orbits: Orbit | Iterable[Orbit], ax: "Axes | None" = None, *, legend: LegendPlace | None = None
) -> "Axes":
    """Draw Floquet multipliers in the complex plane, with the unit circle that bounds stability.

    Inside the circle the plane is drawn to scale.  Where a modulus exceeds 2, moduli above 1 are
    drawn by their logarithm, at the true angle; rings mark powers of ten.  Colours, fills and
    numbers are those of `plots.poincare_section`; a number stands beside the larger multiplier.

    Parameters
    ----------
    orbits
        From `rocksteady.find_orbits`.  Solutions that pass through the floor are left out.
    ax
        Axes to draw on; default: axes of a new figure.
    legend
        "inside" the axes, to their "right", "below" them or "none"; by default inside, or
        below narrow ones.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: real and imaginary part, of one scale.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import DimensionlessBlock, Harmonic, find_orbits
    >>> shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    >>> orbits = find_orbits(DimensionlessBlock(restitution=0.8), shaking)
    >>> print([f"{orbit.largest_multiplier:.3g}" for orbit in orbits if orbit.admissible])
    ['0.64', '3.18', '154', '2.69']
    >>> axes = plot_multipliers(orbits, Figure().add_subplot())
    >>> [text.get_text() for text in axes.texts[:3]]
    ['10', '$10^{2}$', '$10^{3}$']
    """
    from matplotlib.lines import Line2D
    from matplotlib.patches import Circle

    axes = axes_or_new(ax)
    inks = inks_of(axes)
    numbered = [each for each in _numbered(orbits) if not _grazes(each[1])]
    values = np.array([orbit.multipliers for _, orbit in numbered]).reshape(-1, 2)
    largest = float(np.abs(values).max(initial=0.0))
    decades = math.ceil(math.log10(largest) - 1e-9) if largest > LINEAR_REACH else 0
    axes.add_patch(Circle((0.0, 0.0), 1.0, fill=False, ec=inks.limit, lw=1.0, ls=DASHED))
    step = max(1, math.ceil(decades / MOST_RINGS))
    rings = [*range(step, decades + 1, step)]
    axes.grid(visible=False)
    for line in (axes.axhline, axes.axvline):
        line(0.0, color=inks.hair, lw=0.7, zorder=0.5)
    for ring in rings:
        radius = 1.0 + ring / decades
        axes.add_patch(Circle((0.0, 0.0), radius, fill=False, ec=inks.hair, lw=0.7))
        axes.annotate(
            "10" if ring == 1 else f"$10^{{{ring}}}$",
            (radius * math.cos(RINGS_AT), radius * math.sin(RINGS_AT)),
            ha="center",
            va="center",
            fontsize=text_size(axes, 7.5),
            color=inks.quiet,
            bbox={"fc": inks.paper, "ec": "none", "pad": 0.8},
        )
    places = np.array([[_place(complex(m), decades) for m in pair] for pair in values])
    places = places.reshape(-1, 2)
    marks = np.column_stack([places.real.ravel(), places.imag.ravel()])
    colours = _colours((orbit for _, orbit in numbered), inks)
    for (_, orbit), pair in zip(numbered, places, strict=True):
        style = _style(orbit, colours[_kind(orbit)], inks)
        axes.plot(pair.real, pair.imag, "o", ms=5.0, ls="none", clip_on=False, **style)
    reach = 2.2 if decades else max(1.35, 1.15 * largest)
    axes.set(
        xlabel=palette.LABELS["multiplier_real"],
        ylabel=palette.LABELS["multiplier_imaginary"],
        xlim=(-reach, reach),
        ylim=(-reach, reach),
        aspect="equal",
    )
    diameter = min(size_of(axes)) / reach
    roomy = diameter > MOST_CROWDED
    if diameter > LEAST_NAMED:
        half = np.array(NAME) / diameter

        def covered(height: float) -> int:
            return int((np.abs(marks - [0.0, height]) < half).all(axis=1).sum())

        axes.annotate(
            "stable inside",
            (0.0, min(HEIGHTS_OF_NAME, key=covered)),
            ha="center",
            va="center",
            fontsize=text_size(axes, 7.5),
            color=inks.ink,
            bbox={"fc": inks.paper, "ec": "none", "alpha": 0.75, "pad": 0.3},
        )
    ticks = [-1.0, -0.5, 0.0, 0.5, 1.0] if roomy else [-1.0, 0.0, 1.0]
    axes.set_xticks(ticks)
    axes.set_yticks(ticks)
    handles = _handles([orbit for _, orbit in numbered], "o", inks)
    if decades and not roomy:  # the words would cover the numbers of the rings
        handles.append(Line2D([], [], ls="none", label=BEYOND))
    elif decades:
        axes.annotate(
            BEYOND,
            (1.0, 0.0),
            (-2.0, 3.0),
            xycoords="axes fraction",
            textcoords="offset points",
            ha="right",
            fontsize=text_size(axes, 7.5),
            color=inks.quiet,
        )
    place, corner = clear_place(axes, legend, [str(handle.get_label()) for handle in handles])
    draw_legend(axes, place, handles=handles, corner=corner)
    labels: list[tuple[str, float, float]] = []
    for (text, orbit), drawn in zip(numbered, places.tolist(), strict=True):
        # Of a conjugate pair the one above the real axis, else the larger.
        turning = orbit.multipliers[0].imag != 0.0
        spot = max(drawn, key=lambda value: value.imag) if turning else drawn[0]
        labels.append((text, spot.real, spot.imag))
    put_beside(axes, labels, (places.real, places.imag))
    return axes


def _orbits_of(attractor: BasinAttractor | BasinFamily) -> list[Orbit]:
    """Return the orbit of an attractor, or that of a family at each value.

    Raises
    ------
    ModelError
        If there is none.
    """
    known = attractor.orbits if isinstance(attractor, BasinFamily) else (attractor.orbit,)
    orbits = [orbit for orbit in known if orbit is not None]
    if not orbits:
        valid = f"{attractor.name} strikes nowhere"
        raise ModelError("motions", Words("has no orbit"), valid, "plot its basin")
    return orbits


def _numbered(orbits: Orbit | Iterable[Orbit]) -> list[tuple[str, Orbit]]:
    """Return the orbits that are motions, with their numbers among all; one alone needs none.

    Too many would hide what they number.
    """
    listed = [orbits] if isinstance(orbits, Orbit) else list(orbits)
    return [
        (str(number) if 1 < len(listed) <= MOST_NUMBERS else "", orbit)
        for number, orbit in enumerate(listed, start=1)
        if orbit.admissible
    ]


def _grazes(orbit: Orbit) -> bool:
    """Return whether an orbit grazes its base, where no multipliers exist."""
    return bool(np.isnan(orbit.multipliers[0]))


def _kind(orbit: Orbit) -> tuple[str, str, int]:
    """Return the words for the kind of an orbit, the role of its colour, and its period."""
    if orbit.period > 1:
        return f"subharmonic, period {orbit.period}", "subharmonic_line", orbit.period
    return ("symmetric", "motion", 1) if orbit.symmetric else ("unsymmetric", "unsymmetric_line", 1)


def _colours(orbits: Iterable[Orbit], inks: Inks) -> dict[tuple[str, str, int], str]:
    """Return the colour of each kind of orbit: subharmonic ones are darker the shorter they are."""
    kinds = sorted({_kind(orbit) for orbit in orbits}, key=lambda kind: (kind[2], kind[0]))
    long = [kind for kind in kinds if kind[2] > 1]
    steps = dict(zip(long, inks.series("subharmonic_line", max(len(long), 1)), strict=False))
    return {kind: steps.get(kind) or getattr(inks, kind[1]) for kind in kinds}


def _style(orbit: Orbit, colour: str, inks: Inks) -> dict[str, Any]:
    """Return how the marks of an orbit look."""
    fill = "full" if orbit.stable else ("left" if orbit.neutral else "none")
    fill = "top" if _grazes(orbit) else fill
    return {"color": colour, "fillstyle": fill, "mew": 1.0, "markerfacecoloralt": inks.paper}


def _handles(orbits: Sequence[Orbit], marker: str, inks: Inks) -> list["Line2D"]:
    """Return the entries of a legend: the marks that are drawn, by kind and stability."""
    from matplotlib.lines import Line2D

    worths = {"full": "stable", "left": "neutral", "none": "unstable", "top": "grazes"}
    looks = {}
    for kind, colour in _colours(orbits, inks).items():
        for orbit in orbits:
            if _kind(orbit) == kind:
                style = _style(orbit, colour, inks)
                looks[f"{kind[0]}, {worths[style['fillstyle']]}"] = style
    mark: dict[str, Any] = {"ls": "none", "marker": marker, "ms": 5.0}
    return [Line2D([], [], label=label, **mark, **style) for label, style in looks.items()]


def _side_handles(styles: dict[int, dict[str, Any]]) -> list["Line2D"]:
    """Return the entries of a legend for the two sides."""
    from matplotlib.lines import Line2D

    words = {1: "to the positive side", -1: "to the negative side"}
    return [
        Line2D([], [], ls="none", label=words[side], **{"ms": 5.0, **style})
        for side, style in styles.items()
    ]


def _draw_states(
    axes: "Axes", orbits: Sequence[Orbit], factor: float
) -> tuple[list["Line2D"], NDArray[np.float64], NDArray[np.float64]]:
    """Draw the states of orbits; return entries of the legend, phases and speeds."""
    inks = inks_of(axes)
    colours = _colours(orbits, inks)
    for orbit in orbits:
        for side, marker in MARKERS.items():
            states = [state for state in orbit.states if state.side == side]
            axes.plot(
                [state.phase for state in states],
                [factor * state.speed for state in states],
                marker=marker,
                ms=6.0,
                ls="none",
                clip_on=False,
                zorder=3.0 if orbit.stable else 2.5,
                **_style(orbit, colours[_kind(orbit)], inks),
            )
    sides = {side: {"marker": marker, "color": inks.edge} for side, marker in MARKERS.items()}
    handles = [*_handles(orbits, "^", inks), *(_side_handles(sides) if orbits else ())]
    states = [state for orbit in orbits for state in orbit.states]
    phase = np.array([state.phase for state in states])
    return handles, phase, factor * np.array([state.speed for state in states])


def _draw_impacts(
    axes: "Axes", trajectory: Trajectory, since: float, factor: float
) -> tuple[list["Line2D"], NDArray[np.float64], NDArray[np.float64]]:
    """Draw the impacts of a trajectory; return entries of the legend, phases and speeds."""
    _ = trajectory.frequency_ratio  # refuses every other base motion
    inks = inks_of(axes)
    impacts = trajectory.impacts
    late = impacts.pt >= since
    phase = (impacts.half_cycles[late] % 2) * math.pi + impacts.phase[late]
    after = factor * impacts.velocity_after[late]
    size = 5.0 if len(after) < MOST_NUMBERS else 1.6
    styles: dict[int, dict[str, Any]] = {}
    for side, colour in zip((1, -1), inks.series("motion", 2), strict=True):
        styles[side] = {"marker": MARKERS[side], "color": colour, "mew": 0.0}
        mask = np.sign(after) == side
        axes.plot(phase[mask], np.abs(after[mask]), ms=size, ls="none", **styles[side])
    return _side_handles(styles), phase, np.abs(after)


def _speed_scale(block: Block | DimensionlessBlock | None) -> Scale:
    """Return the scale of speeds after impacts: in degrees a second for a block of known size."""
    factor = scale_of("velocity", block).factor
    sized = isinstance(block, Block)
    return Scale(factor, palette.LABELS["speed_deg_s" if sized else "speed"])


def _place(multiplier: complex, decades: int) -> complex:
    """Return where a multiplier is drawn; beyond the unit circle by its logarithm."""
    size = abs(multiplier)
    if decades == 0 or size <= 1.0:
        return multiplier
    return multiplier / size * (1.0 + math.log10(size) / decades)
