"""Description of a block: size, slenderness, rates and restitution."""

from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.sides import Side
from rocksteady.results.description import Description, Fact
from rocksteady.results.numbers import angle, length, number, quantity


def description_of(positive: Side, negative: Side) -> Description:
    """Return the facts of a block of two sides."""
    symmetric = positive == negative
    width, height = positive.distance + negative.distance, 2.0 * positive.centre_height
    sides = (positive, negative)[: 1 if symmetric else 2]
    alphas = " and ".join(angle(side.alpha) for side in sides)
    impacts = dict.fromkeys(number(side.restitution) for side in sides)
    restitutions = " and ".join(impacts)
    size = f"{number(width)} x {number(height)} m"
    uplifts = " and ".join(quantity(tan(side.alpha), "g") for side in sides)
    facts = [
        Fact("", label="size", text=f"{length(width)} x {length(height)}"),
        Fact("alpha_rad", positive.alpha, "slenderness alpha", alphas),
        Fact("radius_m", positive.radius, "radius R", _each(sides, "radius", "m")),
        Fact("p_rad_s", positive.p, "frequency p", _each(sides, "p", "rad/s")),
        Fact("restitution", positive.restitution, "restitution", restitutions),
        Fact("", label="uplift at", text=uplifts),
    ]
    if not symmetric:
        facts.insert(0, Fact("", label="sides", text="positive (left) and negative (right)"))
        facts += [
            Fact("left_m", positive.distance),
            Fact("right_m", negative.distance),
            Fact("height_m", height),
            Fact("negative", negative.to_dict()),
        ]
    return Description(
        headline=f"{size} block, alpha {alphas}, restitution {restitutions}", facts=facts
    )


def _each(sides: tuple[Side, ...], name: str, unit: str) -> str:
    """Return a quantity of each side with its unit."""
    return " and ".join(quantity(getattr(side, name), unit) for side in sides)
