"""Geometry to scale: corners of the tilted block, and length scale of the ground displacement."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.history.trajectory import Trajectory
from rocksteady.errors import ModelError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.validation import in_range

ALPHA = 0.2
"""Slenderness [rad] of the rectangle that stands for a dimensionless block."""
MOST_COLUMNS = 5
"""Of a frame that are drawn: of more the first ones."""
SPACING, CAP = 2.2, 0.5
"""From column to column, and depth of the cap, in their widths: of the drawing alone."""


@dataclass(frozen=True, kw_only=True)
class Shape:
    """What is drawn of a block, in metres, or in units of R for a dimensionless one.

    Attributes
    ----------
    alpha
        Slenderness of the positive side [rad], the unit of angles.
    radius
        Distance from the left corner to the mass centre: half the diagonal of a symmetric block.
    left, right
        Horizontal distances from the corners to the mass centre.
    height
        Full height.
    travel
        Length of alpha g/p^2, the unit of the ground's displacement.
    columns
        Number of columns that are drawn under the cap of a frame; 0 of a single block.
    overhangs
        How far the top reaches beyond the left and the right corner.
    unit
        ``"m"`` or ``"radius"``, the end of the names of the axis labels.
    """

    alpha: float
    radius: float
    left: float
    right: float
    height: float
    travel: float
    unit: str
    columns: int = 0
    overhangs: tuple[float, float] = (0.0, 0.0)

    @property
    def places(self) -> Floats:
        """Where the middles of the columns stand that are drawn; x is 0 midway."""
        count = max(self.columns, 1)
        width = 2.0 * self.half_width
        return np.asarray(SPACING * width * (np.arange(count) - 0.5 * (count - 1)))

    @property
    def cap(self) -> Floats:
        """Lower left and upper right corner of the cap, shape (2, 2), empty of a single block."""
        end, depth = self.places[-1] + self.half_width, CAP * 2.0 * self.half_width
        ends: Floats = np.array([[-end, self.height], [end, self.height + depth]])
        return ends if self.columns else ends[:0]

    @property
    def half_width(self) -> float:
        """Half the distance between the pivots."""
        return 0.5 * (self.left + self.right)

    @property
    def lying(self) -> tuple[float, float]:
        """|theta| [rad] at which it lies on its left and on its right side, drawn no further."""
        left, right = self.overhangs
        return math.atan2(self.height, left), math.atan2(self.height, right)

    @property
    def centre_height(self) -> float:
        """Height of the mass centre."""
        return self.radius * math.cos(self.alpha)

    @property
    def offset(self) -> float:
        """How far to the right of the middle between the pivots the mass centre is."""
        return 0.5 * (self.left - self.right)

    def corners(self, theta: ArrayLike) -> Floats:
        """Return the corners of the block at rotations [rad], seen from the ground.

        Positive rotation is about the left corner, negative about the right one; x is 0 midway
        between the two.  What is wider than its base is drawn as a trapezium.

        Returns
        -------
        ndarray, shape (..., 4, 2)
            Bottom left, bottom right, top right, top left.
        """
        b, h, (left, right) = self.half_width, self.height, self.overhangs
        standing = np.array([[-b, 0.0], [b, 0.0], [b + right, h], [-b - left, h]])
        angle = np.asarray(theta, dtype=np.float64)[..., np.newaxis]
        pivot = np.where(angle < 0.0, b, -b)
        x, y = standing[:, 0] - pivot, standing[:, 1]
        cos, sin = np.cos(angle), np.sin(angle)
        return np.stack([pivot + x * cos - y * sin, x * sin + y * cos], axis=-1)


def shape_of(trajectory: Trajectory, alpha: float | None = None) -> Shape:
    """Return the shape of a trajectory's block; `alpha` is for a dimensionless one.

    Raises
    ------
    InputError, ModelError
        As for `shape_of_block`.
    """
    return shape_of_block(trajectory.block, alpha)


def shape_of_block(block: Block | DimensionlessBlock, alpha: float | None = None) -> Shape:
    """Return the shape of a block; `alpha` is for a dimensionless one.

    Raises
    ------
    InputError
        If alpha is outside (0, pi/2), or so large that the other side's is.
    ModelError
        If it is given for a block that has its own.
    """
    if not isinstance(block, Block):
        lean = 1.0 if block.one_sided else block.alpha_ratio
        widest = max(lean, 1.0)  # the alpha of either side stays below a right angle
        hint = "give the slenderness in radians of the rectangle to draw"
        slenderness = in_range(
            "alpha",
            ALPHA / widest if alpha is None else alpha,
            0.0,
            0.5 * math.pi / widest,
            "()",
            hint=hint,
        )
        centre = math.cos(slenderness)
        return Shape(
            alpha=slenderness,
            radius=1.0,
            left=math.sin(slenderness),
            right=math.sin(slenderness) if lean == 1.0 else centre * math.tan(lean * slenderness),
            height=2.0 * centre,
            # g/(p^2 R) of a homogeneous rectangle is 4/3.
            travel=slenderness * 4.0 / 3.0,
            unit="radius",
        )
    if alpha is not None:
        raise ModelError(
            "alpha",
            alpha,
            f"the block has its own slenderness, {block.alpha:.6g} rad",
            "leave alpha out; it is for a dimensionless block",
        )
    return Shape(
        alpha=block.alpha,
        radius=block.radius,
        left=block.positive.distance,
        right=block.negative.distance,
        height=block.height,
        overhangs=block.overhangs,
        travel=block.uplift_acceleration / block.p**2,
        unit="m",
        columns=0 if block.cap is None else min(block.cap.columns, MOST_COLUMNS),
    )
