"""Measures of a block and their description: size, slenderness, rates and restitution."""

from typing import TYPE_CHECKING

from rocksteady.model.blocks.caps import Cap
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.outlines import Outline
from rocksteady.model.blocks.sides import Side
from rocksteady.model.checks.arguments import checked
from rocksteady.results.result import Result


@checked
class Measured(Result):
    """A block of two sides as equations and descriptions see it."""

    if TYPE_CHECKING:
        positive: Side
        negative: Side
        gravity: float
        housner_factor: float | None
        wall_restitution: float | None
        cap: Cap | None
        parts: str
        outline: Outline | None

    @property
    def alpha(self) -> float:
        """Slenderness of the positive side [rad]."""
        return self.positive.alpha

    @property
    def radius(self) -> float:
        """Distance R from the positive side's pivot to the mass centre [m]."""
        return self.positive.radius

    @property
    def p(self) -> float:
        """Frequency parameter of the positive side [rad/s]."""
        return self.positive.p

    @property
    def restitution(self) -> float:
        """Ratio of angular velocities after and before an impact that ends positive rotation.

        For a block against a wall, that of the wall.
        """
        if self.wall_restitution is not None:
            return self.wall_restitution
        return self.positive.restitution

    @property
    def one_sided(self) -> bool:
        """Whether a wall stops it at angle 0, so that it rocks on its positive side alone."""
        return self.wall_restitution is not None

    @property
    def width(self) -> float:
        """Distance between the pivots [m]; that of a rectangle is its full width."""
        return self.positive.distance + self.negative.distance

    @property
    def height(self) -> float:
        """Full height [m]; where none was given, twice the height of the mass centre."""
        assert self.outline is not None  # a block has one from its construction on
        return self.outline.height

    @property
    def overhangs(self) -> tuple[float, float]:
        """How far it reaches beyond the left and the right edge of its base [m]."""
        assert self.outline is not None
        return self.outline.left_overhang, self.outline.right_overhang

    @property
    def fills_outline(self) -> bool:
        """Whether it is as wide as its base and twice as high as its mass centre."""
        twice = 2.0 * self.positive.centre_height
        return self.overhangs == (0.0, 0.0) and self.height == twice

    @property
    def symmetric(self) -> bool:
        """Whether its two sides are equal; a block against a wall has one."""
        return self.positive == self.negative and not self.one_sided

    @property
    def lossless(self) -> bool:
        """Whether no impact takes anything from the velocity: restitution 1 on both sides."""
        if self.one_sided:
            return self.restitution == 1.0
        return self.positive.restitution == self.negative.restitution == 1.0

    @property
    def uplift_acceleration(self) -> float:
        """Base acceleration that lifts the block from rest in the linear model, alpha g [m/s^2].

        For an asymmetric block it is that which lifts it to the positive side; the unit of all
        accelerations.  To the negative side lifts one of ``negative.alpha * gravity``, reversed.
        """
        return self.positive.alpha * self.gravity

    def dimensionless(self) -> DimensionlessBlock:
        """Return what the equation of motion sees of the block in its own units.

        Those of an asymmetric block are the positive side's.

        Raises
        ------
        InputError
            If one side's alpha or p is more than a hundred times the other's.
        """
        if self.one_sided:
            return DimensionlessBlock(restitution=self.restitution, one_sided=True)
        positive, negative = self.positive, self.negative
        return DimensionlessBlock(
            restitution=positive.restitution,
            negative_restitution=negative.restitution,
            alpha_ratio=negative.alpha / positive.alpha,
            p_ratio=negative.p / positive.p,
        )
