"""Description of a block: size, slenderness, rates and restitution."""

from typing import TYPE_CHECKING

from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.sides import Side
from rocksteady.results.description import Description, Fact
from rocksteady.results.numbers import angle, length, number, quantity

if TYPE_CHECKING:
    from rocksteady.model.blocks.block import Block


def description_of(block: "Block") -> Description:
    """Return the facts of a block."""
    sides = (block.positive, block.negative)[: 1 if block.symmetric else 2]
    alphas = " and ".join(angle(side.alpha) for side in sides)
    impacts = dict.fromkeys(number(side.restitution) for side in sides)
    restitutions = " and ".join(impacts)
    size = f"{number(block.width)} x {number(block.height)} m"
    uplifts = " and ".join(quantity(tan(side.alpha), "g") for side in sides)
    facts = [
        Fact("", label="size", text=f"{length(block.width)} x {length(block.height)}"),
        Fact("alpha_rad", block.alpha, "slenderness alpha", alphas),
        Fact("radius_m", block.radius, "radius R", _each(sides, "radius", "m")),
        Fact("p_rad_s", block.p, "frequency p", _each(sides, "p", "rad/s")),
        Fact("restitution", block.restitution, "restitution", restitutions),
        Fact("", label="uplift at", text=uplifts),
    ]
    if not block.symmetric:
        facts.insert(0, Fact("", label="sides", text="positive (left) and negative (right)"))
        facts += [
            Fact("left_m", block.positive.distance),
            Fact("right_m", block.negative.distance),
            Fact("height_m", block.height),
            Fact("negative", block.negative.to_dict()),
        ]
    return Description(
        headline=f"{size} block, alpha {alphas}, restitution {restitutions}", facts=facts
    )


def _each(sides: tuple[Side, ...], name: str, unit: str) -> str:
    """Return a quantity of each side with its unit."""
    return " and ".join(quantity(getattr(side, name), unit) for side in sides)
