"""Measures of a block and their description: size, slenderness, rates and restitution."""

from typing import TYPE_CHECKING

from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.caps import Cap
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.blocks.outlines import Outline
from rocksteady.model.blocks.sides import Side, same_shape
from rocksteady.model.checks.arguments import checked
from rocksteady.results.description import Description, Fact
from rocksteady.results.numbers import angle, length, number, quantity
from rocksteady.results.result import Result

ROUNDED = 1e-6
"""Relative difference of moments of inertia that are the same."""


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

    def describe(self) -> Description:
        """Return its size, slenderness and rates, for people and under the names of JSON."""
        return description_of(self)


def description_of(block: Measured) -> Description:
    """Return the facts of a block.

    A rectangle has a width and a height, any other body a base, a mass centre, and an outline where
    that is not the mass centre's.  A block against a wall rocks on its positive side alone, and has
    no rates of the other.
    """
    positive, negative, factor = block.positive, block.negative, block.housner_factor
    alike = block.symmetric or (block.one_sided and same_shape(positive, negative))
    sides = (positive,) if alike or block.one_sided else (positive, negative)
    alphas = " and ".join(angle(side.alpha) for side in sides)
    ratios = [block.restitution] if block.one_sided else [side.restitution for side in sides]
    restitutions = " and ".join(dict.fromkeys(number(ratio) for ratio in ratios))
    if factor is not None:
        source = "that from angular momentum" if block.one_sided else "Housner's"
        restitutions += f" ({number(factor)} of {source})"
    size, lengths = _size(block)
    size += f" ({block.parts} as one body)" if block.parts else ""
    uplifts = " and ".join(quantity(in_g(block.gravity * tan(side.alpha)), "g") for side in sides)
    facts = [
        lengths,
        Fact("alpha_rad", positive.alpha, "slenderness alpha", alphas),
        Fact("radius_m", positive.radius, "radius R", _each(sides, "radius", "m")),
        Fact("p_rad_s", positive.p, "frequency p", _each(sides, "p", "rad/s")),
        Fact("restitution", block.restitution, "restitution", restitutions),
        Fact("", label="uplift at", text=uplifts),
    ]
    if block.cap is not None:
        facts += [Fact(key, value) for key, value in block.cap.to_dict().items()]
        facts.insert(0, Fact("", label="frame", text=block.cap.words.removesuffix(",")))
    if factor is not None:
        facts.append(Fact("housner_factor", factor))
    if block.one_sided:
        facts.insert(0, Fact("one_sided", True, "sides", "positive (left) alone, a wall behind"))
    elif not alike:
        facts.insert(0, Fact("", label="sides", text="positive (left) and negative (right)"))
    if not alike:
        facts += [Fact("left_m", positive.distance), Fact("right_m", negative.distance)]
    if not (alike and block.fills_outline):
        facts.append(Fact("height_m", block.height))
    if not block.fills_outline:
        facts.append(Fact("mass_centre_height_m", positive.centre_height))
    if not alike and not block.one_sided:
        facts.append(Fact("negative", negative.to_dict()))
    return Description(headline=f"{size}, alpha {alphas}, restitution {restitutions}", facts=facts)


def _size(block: Measured) -> tuple[str, Fact]:
    """Return the size of a block as in a headline, and as a fact."""
    width, height, centre = block.width, block.height, block.positive.centre_height
    noun = "block against a wall" if block.one_sided else "block"
    if block.cap is not None:
        size = f"{block.cap.words} of {number(width)} x {number(height)} m"
        size += " against a wall" if block.one_sided else ""
        return size, Fact("", label="each column", text=f"{length(width)} x {length(height)}")
    if not block.fills_outline:
        across = width + sum(block.overhangs)
        size, text = f"{number(across)} x {number(height)} m {noun}", ""
        if across > width:
            size, text = f"{size} on a base of {number(width)} m", f", base {length(width)}"
        text = f"{length(across)} x {length(height)}{text}, mass centre {length(centre)} up"
        return f"{size} with its mass centre at {number(centre)} m", Fact("", "", "size", text)
    if not _rectangular(block.positive, width, height, block.gravity):
        size = f"{number(width)} m wide {noun} with its mass centre at {number(centre)} m"
        text = f"{length(width)}, mass centre {length(centre)} up"
        return size, Fact("", label="base", text=text)
    text = f"{length(width)} x {length(height)}"
    return f"{number(width)} x {number(height)} m {noun}", Fact("", label="size", text=text)


def _rectangular(side: Side, width: float, height: float, gravity: float) -> bool:
    """Return whether a side's p is that of a homogeneous rectangle with its mass in mid-height."""
    inertia = (width * width + height * height) / 12.0 + side.radius * side.radius
    return abs(side.p * side.p * inertia / (gravity * side.radius) - 1.0) < ROUNDED


def _each(sides: tuple[Side, ...], name: str, unit: str) -> str:
    """Return a quantity of each side with its unit."""
    return " and ".join(quantity(getattr(side, name), unit) for side in sides)
