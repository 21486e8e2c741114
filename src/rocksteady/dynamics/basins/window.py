"""Windows of initial states, and the phase of the shaking at which they are taken."""

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.history.start import FARTHEST
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.elementary.arrays import hypot
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.confidence import share_interval
from rocksteady.model.checks.validation import in_range
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.sweep.cases.axes import Axis

HALF_WIDTHS, CELLS = (1.2, 1.5), (144, 108)
"""Of the window of starts under periodic shaking, here and on the page: how far it reaches in angle
[alpha] and in velocity [alpha p], and its cells along each."""
POINTS = 200
"""Default number of points along an axis of any other window."""
DECIMALS = 12
"""Of a phase in radians: what is beyond them is rounding of the whole periods taken off."""
BEHIND = (
    "a block against a wall has angles of 0 or above, and at angle 0 velocities of 0 or above",
    "give middles of cells, from half a step above 0 on",
)
"""What is valid of the states of such a block, and what to give."""
LONG_NAMES = {"angle": "theta/alpha", "velocity": "d(theta/alpha)/d(p t)"}
"""Long names of the axes of a window."""
ROUNDED = 1.0 - 1e-9
HALF_UNIT = 5e-13
"""Half a unit of the last of them."""


def reach(amplitude: float, frequency_ratio: float) -> float:
    """Return the |u + du/ds| of a state from which on its flight grows, whatever the phase.

    The flight of a state that leans to the positive side holds e^s with the coefficient
    (u + du/ds - 1 + beta (sin phi + Omega cos phi))/2, whose last term is at most
    A/sqrt(1 + Omega^2) in size.  Where that is positive the block could come back to its base only
    in a dip on the way.
    """
    return 1.0 + amplitude / hypot(1.0, frequency_ratio)


def window_of(sides: Floats, amplitude: float, frequency_ratio: float) -> tuple[float, float]:
    """Return how far in u and in du/ds a state may be that does not fly off, on either side.

    Parameters
    ----------
    sides
        Sides of the block, as from `DimensionlessBlock.sides`, shape (2, 3).
    amplitude, frequency_ratio
        Parameters of the shaking; `reach` is counted in the units of each side.
    """
    angle = velocity = 0.0
    for _, lean, rate in sides.tolist():
        bound = lean * reach(amplitude / lean, frequency_ratio / rate)
        angle, velocity = max(angle, bound), max(velocity, rate * bound)
    return angle, velocity


def shaken_axes(
    block: Block | DimensionlessBlock,
    angles: ArrayLike | None,
    velocities: ArrayLike | None,
    *,
    drawn: bool,
) -> tuple[Axis, Axis]:
    """Return the axes of a window of starts under periodic shaking.

    Parameters
    ----------
    block, angles, velocities, drawn
        As for `window_axes`; the default window counts in the larger units of the two sides.

    Raises
    ------
    InputError, ModelError
        As for `window_axes`.
    """
    _, leans, rates = np.array(block.dimensionless().sides).T
    reaches = (HALF_WIDTHS[0] * float(leans.max()), HALF_WIDTHS[1] * float((leans * rates).max()))
    return window_axes(block, angles, velocities, reaches, drawn=drawn, cells=CELLS)


def centred(half_width: float, points: int = POINTS) -> Floats:
    """Return the middles of equal cells between -half_width and half_width, mirrored exactly."""
    from_middle = np.arange(points, dtype=np.float64) - 0.5 * (points - 1)
    middles: Floats = from_middle * (2.0 * half_width / points)
    return middles


def against_wall(reach: float, points: int = POINTS) -> Floats:
    """Return the middles of equal cells between 0, where the wall is, and a reach."""
    middles: Floats = (np.arange(points, dtype=np.float64) + 0.5) * (reach / points)
    return middles


def window_axes(
    block: Block | DimensionlessBlock,
    angles: ArrayLike | None,
    velocities: ArrayLike | None,
    reaches: tuple[float, float],
    *,
    drawn: bool = False,
    cells: tuple[int, int] = (POINTS, POINTS),
) -> tuple[Axis, Axis]:
    """Return the axes of angles and of velocities of a window.

    Parameters
    ----------
    block
        One against a wall has states on its positive side alone.
    angles, velocities
        As they are given; None for middles of cells as far as `reaches`.
    reaches
        Extent of the default window in u and in du/d(pt).
    drawn
        Whether states are drawn in the cells around the values.
    cells
        Number of cells along a default axis of angles, and of velocities.

    Raises
    ------
    InputError
        As for `window_axis`.
    ModelError
        If a state lies behind the wall, or moves into it.
    """
    if angles is None:
        angles = (against_wall if block.one_sided else centred)(reaches[0], cells[0])
    if velocities is None:
        velocities = centred(reaches[1], cells[1])
    angle = window_axis("angles", angles, LONG_NAMES["angle"])
    velocity = window_axis("velocities", velocities, LONG_NAMES["velocity"])
    if block.one_sided:
        least, slowest = angle.points[0].item(), velocity.points[0].item()
        if least < 0.0 or (least == 0.0 and slowest < 0.0):
            finding = f"begin at {least:g}, at velocities from {slowest:g} on"
            raise ModelError("angles", Words(finding), *BEHIND)
        if drawn and least < ROUNDED * 0.5 * spacing(angle):
            finding = f"begin at {least:g}, in a cell that begins below 0"
            raise ModelError("angles", Words(finding), *BEHIND)
    return angle, velocity


def window_axis(name: str, values: ArrayLike, long_name: str) -> Axis:
    """Return an axis of a window: two or more values, ascending and evenly spaced.

    Only of even spacing a share of states is a share of area.

    Raises
    ------
    InputError
        If the values are anything else.
    """
    axis = Axis(name=name, values=values, long_name=long_name)
    for value in (axis.points.min(), axis.points.max()):
        in_range(name, value, -FARTHEST, FARTHEST, "[]", hint="give a smaller window")
    steps = np.diff(axis.points)
    if not (steps.size and (steps > 0.0).all() and np.ptp(steps) <= 1e-6 * steps.mean()):
        raise InputError(
            name,
            values,
            "the window needs two values or more, ascending and evenly spaced",
            "give them from the lowest to the highest in equal steps",
        )
    return axis


def spacing(axis: Axis) -> float:
    """Return the distance of neighbours on the axis of a window."""
    return float(axis.points[-1] - axis.points[0]) / (len(axis) - 1)


def counted(states: int, window: int, confidence: float) -> dict[str, Any]:
    """Return the fields of a fraction: states, share and Wilson's interval.

    Parameters
    ----------
    states
        Number of states that the fraction counts.
    window
        Number of all states of the window.
    confidence
        Confidence of the interval, in (0, 1).
    """
    share = states / window
    low, high = share_interval(share, window, confidence)
    return {"states": states, "share": share, "low": float(low), "high": float(high)}


def moment(shaking: PeriodicMotion) -> tuple[int, float]:
    """Return the phase of a shaking as 0 or 1 half cycle and a rest in [0, pi).

    The rest is rounded to 12 decimals.  Phases that are whole half periods apart then have the same
    rest, although adding pi to a number rounds it, and near a fractal border a rounding decides.
    """
    half, rest = clock(shaking.phase)
    if math.pi - rest < HALF_UNIT:
        half, rest = half + 1, 0.0
    return half % 2, round(rest, DECIMALS)
