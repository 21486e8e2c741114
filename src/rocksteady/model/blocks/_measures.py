"""Description of a block: size, slenderness, rates and restitution."""

from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.sides import Side
from rocksteady.results.description import Description, Fact
from rocksteady.results.numbers import angle, length, number, quantity

ROUNDED = 1e-6
"""Relative difference of moments of inertia that are the same."""


def description_of(
    positive: Side, negative: Side, gravity: float, housner_factor: float | None = None
) -> Description:
    """Return the facts of a block of two sides.

    A rectangle has a width and a height; of any other body the height is not known.
    """
    symmetric = positive == negative
    width, height = positive.distance + negative.distance, 2.0 * positive.centre_height
    sides = (positive, negative)[: 1 if symmetric else 2]
    alphas = " and ".join(angle(side.alpha) for side in sides)
    impacts = dict.fromkeys(number(side.restitution) for side in sides)
    restitutions = " and ".join(impacts)
    if housner_factor is not None:
        restitutions += f" ({number(housner_factor)} of Housner's)"
    size = f"{number(width)} x {number(height)} m block"
    lengths = Fact("", label="size", text=f"{length(width)} x {length(height)}")
    if not _rectangular(positive, width, height, gravity):
        centre = 0.5 * height
        size = f"{number(width)} m wide block with its mass centre at {number(centre)} m"
        lengths = Fact("", label="base", text=f"{length(width)}, mass centre {length(centre)} up")
    uplifts = " and ".join(quantity(tan(side.alpha), "g") for side in sides)
    facts = [
        lengths,
        Fact("alpha_rad", positive.alpha, "slenderness alpha", alphas),
        Fact("radius_m", positive.radius, "radius R", _each(sides, "radius", "m")),
        Fact("p_rad_s", positive.p, "frequency p", _each(sides, "p", "rad/s")),
        Fact("restitution", positive.restitution, "restitution", restitutions),
        Fact("", label="uplift at", text=uplifts),
    ]
    if housner_factor is not None:
        facts.append(Fact("housner_factor", housner_factor))
    if not symmetric:
        facts.insert(0, Fact("", label="sides", text="positive (left) and negative (right)"))
        facts += [
            Fact("left_m", positive.distance),
            Fact("right_m", negative.distance),
            Fact("height_m", height),
            Fact("negative", negative.to_dict()),
        ]
    return Description(headline=f"{size}, alpha {alphas}, restitution {restitutions}", facts=facts)


def _rectangular(side: Side, width: float, height: float, gravity: float) -> bool:
    """Return whether a side's p is that of a homogeneous rectangle with its mass in mid-height."""
    inertia = (width * width + height * height) / 12.0 + side.radius * side.radius
    return abs(side.p * side.p * inertia / (gravity * side.radius) - 1.0) < ROUNDED


def _each(sides: tuple[Side, ...], name: str, unit: str) -> str:
    """Return a quantity of each side with its unit."""
    return " and ".join(quantity(getattr(side, name), unit) for side in sides)
