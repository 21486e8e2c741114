"""Words of an object: its file, what follows from its geometry, and the formula."""

from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.facts import block_text, block_values
from rocksteady.results.description import Column, Description, Fact, Table, line
from rocksteady.results.numbers import angle, length, number, quantity
from rocksteady.results.result import describes
from rocksteady.results.words import facts_of
from rocksteady.risk.assess.described.facts import ObjectFacts
from rocksteady.risk.assess.described.objects import DescribedObject, bounds_of, plain_value
from rocksteady.risk.assess.two_numbers import FormulaAssessment
from rocksteady.risk.screens.friction import least_gravity_g
from rocksteady.seismic.measures.free_sides import first_side, free_sides


@describes(DescribedObject)
def describe_object(described: DescribedObject) -> Description:
    """Return the description in the file."""
    block = described.block.describe()
    about = [
        Fact("name", described.name, "name"),
        Fact("kind", described.given.kind, "kind"),
        Fact("against_wall", described.given.against_wall),
        Fact("source", described.source, "from"),
        Fact("sha256", described.sha256),
        Fact("extra", dict(described.extra)),
    ]
    if described.given.friction is not None:
        low, high = bounds_of(described.given.friction)
        words = number(low) if low == high else f"{number(low)} to {number(high)}"
        about.append(Fact("friction", plain_value(described.given.friction), "friction", words))
    return Description(headline=f"{described.name}: {block.headline}", facts=[*about, *block.facts])


@describes(ObjectFacts)
def describe_object_facts(derived: ObjectFacts) -> Description:
    """Return the facts of the weaker side, and a row for each side."""
    weaker, walled = first_side(derived.block), derived.block.one_sided
    gravity_g = least_gravity_g(derived.block, derived.demand.vertical_at_peak_g)
    lifts = quantity(derived.uplift_pga_g, "g")
    if derived.demand.vertical_words:
        lifts += f" with {derived.demand.vertical_words}"
    mass = "" if derived.mass_kg is None else quantity(derived.mass_kg, "kg")
    if mass and derived.block.cap is not None:
        mass += " of columns and cap"
    rows = [
        {
            "side": name,
            **side.to_dict(),
            **({"restitution": derived.block.restitution} if walled else {}),
            "uplift_pga_g": gravity_g * tan(side.alpha),
        }
        for name, side in zip(("left", "right"), free_sides(derived.block), strict=False)
    ]
    ratio = derived.block.restitution if walled else weaker.restitution
    whose = "restitution of the wall" if walled else "restitution"
    facts = [
        Fact("name", derived.name, "object"),
        *([Fact("", label="as one body", text=parts)] if (parts := derived.block.parts) else []),
        Fact("alpha_rad", weaker.alpha, "slenderness alpha", angle(weaker.alpha)),
        Fact("p_rad_s", weaker.p, "frequency p", quantity(weaker.p, "rad/s")),
        Fact("radius_m", weaker.radius, "radius R", length(weaker.radius)),
        Fact("restitution", ratio, whose, number(ratio)),
        Fact(
            "mass_centre_height_m",
            weaker.centre_height,
            "mass centre",
            f"{length(weaker.centre_height)} up",
        ),
        Fact("uplift_pga_g", derived.uplift_pga_g, "lifts at", lifts),
        Fact(
            "friction_to_lift",
            derived.friction_to_lift,
            "friction to lift",
            f"more than {number(derived.friction_to_lift)}",
        ),
        Fact("friction", derived.friction),
        Fact("mass_kg", derived.mass_kg, "mass" if mass else "", mass),
    ]
    columns = [
        Column("side", "edge", left=True),
        Column("alpha_rad", "alpha", angle),
        Column("p_rad_s", "p [rad/s]"),
        Column("radius_m", "R", length),
        Column("restitution", "restitution"),
        Column("uplift_pga_g", "lifts at [g]"),
    ]
    shown = [] if derived.block.symmetric or walled else columns
    return Description(
        headline=f"{derived.name}: alpha {angle(weaker.alpha)}, p {quantity(weaker.p, 'rad/s')}, "
        f"lifts at {lifts}",
        facts=facts,
        tables=[Table("sides", rows, shown)],
        notes=derived.warnings,
    )


SOURCE = (
    "Lognormal in p PGV/(g tan alpha), median 0.757 and beta 0.592, where PGA > g tan alpha; "
    "0 below. Inferred from 28,399 classified runs of Chu, Giouvanidis, Loong and "
    "Dimitrakopoulos, Earthq. Eng. Struct. Dyn. 54, 3576 (2025), doi 10.1002/eqe.70042. "
    "`assess_object` counts runs of the object itself: use its answer, and this to compare."
)


@describes(FormulaAssessment)
def describe_formula(formula: FormulaAssessment) -> Description:
    """Return the sentence, the thresholds, the source and the remarks."""
    lifting = quantity(formula.uplift_pga_g, "g") + " as one body" * bool(formula.block.parts)
    lifting += f", {number(formula.uplift_pga_g / formula.pga_g, 2)} of the demand"
    screen = [
        line("doubt", " ".join(formula.remarks)),
        line("friction needed", number(formula.friction_needed)),
        line("friction given", "" if formula.friction is None else number(formula.friction)),
        line("lifts at", lifting),
        line(
            "half fall at", quantity(formula.median_pgv_m_s, "m/s") * (formula.verdict == "rocks")
        ),
    ]
    block = Fact("block", block_values(formula.block), "block", block_text(formula.block))
    facts = facts_of(formula, block, Fact("source", SOURCE))
    return Description(
        formula.sentence,
        [*screen, *facts],
        notes=[*formula.remarks, SOURCE],
        sentence=formula.sentence,
    )
