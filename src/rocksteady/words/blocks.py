"""Words of blocks: their sizes, slenderness, rates and restitution."""

from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.blocks.sides import Side, same_shape
from rocksteady.results.description import Description, Fact
from rocksteady.results.numbers import angle, length, number, quantity
from rocksteady.results.result import describes

ROUNDED = 1e-6
"""Relative difference of moments of inertia that are the same."""


@describes(Block)
def describe_block(block: Block) -> Description:
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


def _size(block: Block) -> tuple[str, Fact]:
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


@describes(DimensionlessBlock)
def describe_dimensionless(block: DimensionlessBlock) -> Description:
    """Return its restitution, and the ratios of its sides where they differ."""
    if block.one_sided:
        facts = [
            Fact("restitution", block.restitution, "restitution"),
            Fact("one_sided", True, "sides", "positive (left) alone, a wall behind"),
        ]
        return Description(
            headline=f"dimensionless block against a wall, restitution {number(block.restitution)}",
            facts=facts,
        )
    first, second = block.sides
    ratios = " and ".join(dict.fromkeys((number(first[0]), number(second[0]))))
    facts = [Fact("restitution", first[0], "restitution", ratios)]
    words = f"dimensionless block, restitution {ratios}"
    if second[0] != first[0]:
        facts.append(Fact("negative_restitution", second[0]))
    if second[1:] != first[1:]:
        facts += [
            Fact("alpha_ratio", second[1], "alpha, negative / positive side"),
            Fact("p_ratio", second[2], "p, negative / positive side"),
        ]
        words += f", alpha ratio {number(second[1])}, p ratio {number(second[2])}"
    return Description(headline=words, facts=facts)
