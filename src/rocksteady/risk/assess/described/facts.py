"""What follows from an object's geometry: slenderness, frequency, restitution, friction, doubts."""

import math
from dataclasses import dataclass

from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.results.numbers import angle, number
from rocksteady.results.result import Result
from rocksteady.risk.assess.described.objects import DescribedObject, bounds_of, parameter_words
from rocksteady.risk.assess.described.schema import Range
from rocksteady.risk.screens.demand import Demand
from rocksteady.risk.screens.friction import uplift_acceleration_g
from rocksteady.seismic.measures.free_sides import first_side

STOCKY = 0.4
"""Slenderness [rad] from which on a block on most floors slides before it rocks."""

SLENDER = 0.04
"""Slenderness [rad] below which a slope of the floor of a degree is half of it."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class ObjectFacts(Result):
    """Derived facts of an object, from `rocksteady.risk.compute_object_facts`.

    Attributes
    ----------
    name
        Name of the object.
    block
        The block that it is; for a range the middle.
    demand
        The demand of the object.
    uplift_pga_g
        Base acceleration that lifts its weaker side [g], with the demand's vertical motion.
    friction
        Lowest and highest coefficient of friction; None where it is not given.
    friction_to_lift
        Friction below which it slides at the acceleration that lifts it, tan(alpha).
    mass_kg
        Mass with its content, of a frame that of all columns and the cap [kg]; None where it is not
        given.
    warnings
        Sentences on what is assumed, and on what is unusual.
    """

    name: str
    block: Block
    demand: Demand
    uplift_pga_g: float
    friction: tuple[float, float] | None
    friction_to_lift: float
    mass_kg: float | None
    warnings: tuple[str, ...]


@checked
def compute_object_facts(described: DescribedObject) -> ObjectFacts:
    """Derive slenderness, frequency, restitution and warnings of an object.

    Parameters
    ----------
    described
        The object.

    Returns
    -------
    ObjectFacts
        Of the middle of each range.

    Raises
    ------
    InputError
        If `described` is no object.

    Examples
    --------
    >>> desk = DescribedObject(
    ...     values={"name": "statue", "geometry": {"width_m": 0.32, "height_m": 1.8}}
    ... )
    >>> facts = compute_object_facts(desk)
    >>> print(f"{facts.uplift_pga_g:.4f} g")
    0.1778 g
    >>> print(facts.warnings[0])
    The friction is not given: with a coefficient below 0.178 the object slides.
    """
    block, demand = described.block, described.demand
    slope, friction = tan(first_side(block).alpha), described.given.friction
    return ObjectFacts(
        name=described.name,
        block=block,
        demand=demand,
        uplift_pga_g=uplift_acceleration_g(block, demand.vertical_at_peak_g),
        friction=None if friction is None else bounds_of(friction),
        friction_to_lift=slope,
        mass_kg=described.body.whole_mass_kg,
        warnings=tuple(_warnings(described, block, slope)),
    )


def _warnings(described: DescribedObject, block: Block, slope: float) -> list[str]:
    """Return sentences on what is assumed and what is unusual."""
    given, side = described.given, first_side(block)
    sentences = []
    if given.friction is None:
        sentences.append(
            f"The friction is not given: with a coefficient below {number(slope)} the object "
            "slides."
        )
    if block.one_sided:
        sentences.append(
            "It stands against a wall, which stops it: it rocks about its left edge alone, and "
            "each record is run with both signs."
        )
    if side.alpha > STOCKY:
        sentences.append(
            f"At a slenderness of {angle(side.alpha)} most objects slide before they rock."
        )
    if side.alpha < SLENDER:
        sentences.append(
            f"A slenderness of {angle(side.alpha)} is small: a floor out of level by half a degree "
            f"changes it by {number(50.0 / math.degrees(side.alpha))} %."
        )
    shape = given.geometry
    moved = shape.mass_centre_height_m is not None or shape.offset_m is not None
    if moved and shape.gyration_m is None and shape.inertia_kg_m2 is None:
        sentences.append(
            "The moment of inertia about the mass centre is that of the homogeneous rectangle of "
            "this outline: give its radius of gyration or moment of inertia where it is known."
        )
    if given.content is not None:
        sentences.append(
            "The content is one point mass, fixed in the object: sloshing, shifting and falling "
            "content are not in the model."
        )
    if isinstance(given.restitution, float) and given.restitution > 0.98:
        sentences.append(
            f"A restitution of {number(given.restitution)} leaves almost all velocity after an "
            "impact: few tests of stone or timber found so much."
        )
    keys = dict.fromkeys(parameter_words(each.key) for each in described.variants())
    if keys:
        sentences.append(
            f"Of the range of the {' and the '.join(keys)} the middle is taken; the worse end "
            "decides on uplift and sliding."
        )
    if isinstance(given.restitution, Range):
        sentences.append("The lowest restitution of its range is the block's own.")
    if given.demand.place == "floor":
        sentences.append("The object stands on a floor: the motions must be those of that floor.")
    return sentences
