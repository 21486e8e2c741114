"""Plot of the block on its ground at one moment, to scale."""

from typing import TYPE_CHECKING

import numpy as np

from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import finite, positive
from rocksteady.risk.assess.described.facts import ObjectFacts
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.show.film._model import draw_model
from rocksteady.show.film._scene import GLOW, BlockScene
from rocksteady.show.style.layout import axes_or_new

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Described = DescribedObject | ObjectFacts | ObjectPrior
"""What has a block: of a range, or a spread, its middle."""


@checked
def plot_block(
    trajectory: Trajectory | Block | DimensionlessBlock | Described,
    ax: "Axes | None" = None,
    *,
    pt: float = 0.0,
    alpha: float | None = None,
    glow: float = GLOW,
) -> "Axes":
    """Draw a block on its ground at one pivot time, or a block alone, to scale.

    The block stands on the corner with the triangle; its mass centre is the circle.  It is pale at
    rest, blue while it rocks and black with a hatch where it falls: once the mass centre has passed
    the dashed line above the corner for the last time.  A ring fades at the corner that has struck
    last.  A wall behind the block stands on the ground, and the ring is at the top of the block.
    The arrow in the ground is the base acceleration; the marks beside its root are the uplift
    accelerations of a block at rest.

    A block alone is drawn as in the theory: at a small positive tilt, with its edges O and O',
    its measures, the positive acceleration of the base and the law of impact.

    A `rocksteady.Block` is drawn in metres, as the rectangle that it is (or that has its pivots and
    its mass centre); a dimensionless one in units of R, as a homogeneous rectangle.  Beyond
    |theta| = pi/2 the block is drawn lying on its side.  A frame has up to five columns under its
    cap, spaced for the drawing; alone, it is drawn as one column.

    Parameters
    ----------
    trajectory
        From `rocksteady.simulate`; or a block alone, a described object or a prior of one, of whose
        ranges the middle is drawn.
    ax
        Axes to draw on, whose limits are set; default: axes of a new figure.
    pt
        Pivot time p t, from 0 (default) to ``trajectory.end_time_pt``.
    alpha
        Slenderness [rad] to draw a dimensionless block with, in (0, pi/2); default 0.2.
    glow
        Pivot time for which an impact is seen.

    Returns
    -------
    matplotlib.axes.Axes
        The axes, in metres or units of R; a block alone has no ticks.  Positive rotation is
        counterclockwise, about the left corner.

    Raises
    ------
    InputError
        If the time is outside the trajectory, or another number outside its range.
    ModelError
        If `alpha` is given for a block that has its own.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import Block, State, Still, simulate
    >>> block = Block.rectangle(width=0.5, height=2.0)
    >>> run = simulate(block, Still(), start=State(angle=0.8, velocity=0.0))
    >>> axes = plot_block(run, Figure().add_subplot())
    >>> print(axes.get_xlabel(), axes.texts[1].get_text(), sep=", ")
    position [m], θ = +11.2° = +0.80 α
    """
    time = finite("pt", pt, hint="give a pivot time p t")
    lasts = positive("glow", glow, hint="give the pivot time for which an impact is seen")
    if isinstance(trajectory, ObjectPrior):
        trajectory = trajectory.middle_block
    if isinstance(trajectory, DescribedObject | ObjectFacts):
        trajectory = trajectory.block
    if not isinstance(trajectory, Trajectory):
        axes = axes_or_new(ax)
        draw_model(axes, trajectory, alpha)
        return axes
    trajectory(time)  # refuses a time outside it
    axes = axes_or_new(ax)
    BlockScene(axes, trajectory, np.array([time]), alpha=alpha, glow=lasts).show(time)
    return axes
