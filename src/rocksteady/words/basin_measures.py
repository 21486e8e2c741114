"""Words of measures of basins: entropy, uncertainty exponent and test of a boundary."""

import math

from rocksteady.dynamics.basins.measures.boundary import FINE, BoundaryCheck
from rocksteady.dynamics.basins.measures.entropy import BasinEntropies, BasinEntropy
from rocksteady.dynamics.basins.measures.uncertainty import UncertaintyExponent
from rocksteady.model.checks.confidence import CONFIDENCE_TEXT
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.doubts import FEWEST_BOXES, FEWEST_SIZES, NOT_IDENTIFIED, TOO_FEW
from rocksteady.results.numbers import plural
from rocksteady.results.result import describes


@describes(BasinEntropy)
def describe_entropy(entropy: BasinEntropy) -> Description:
    """Return both entropies, what they are over, and the criterion."""
    sides = " x ".join(map(str, entropy.box))
    few = entropy.boundary_boxes < FEWEST_BOXES
    criterion = f"S_bb is {'above' if entropy.fractal else 'not above'} ln 2 = 0.6931"
    if few:
        criterion = f"{NOT_IDENTIFIED}: {TOO_FEW} boundary boxes"
    bound = "—" if math.isnan(entropy.boundary_entropy) else f"{entropy.boundary_entropy:.4f}"
    facts = [
        Fact("entropy", entropy.entropy, "basin entropy S_b", f"{entropy.entropy:.4f}"),
        Fact("boundary_entropy", entropy.boundary_entropy, "boundary entropy S_bb", bound),
        Fact("fractal", entropy.fractal, "ln 2 criterion", criterion),
        Fact("box", list(entropy.box), "box", f"{sides} states"),
        Fact("boxes", entropy.boxes),
        Fact("boundary_boxes", entropy.boundary_boxes),
        Fact(
            "",
            label="boundary boxes",
            text=f"{entropy.boundary_boxes:,} of {entropy.boxes:,}",
        ),
        Fact("basins", entropy.basins, "basins"),
    ]
    notes = []
    if entropy.boundary_boxes == 0:
        notes.append("No box has two basins: there is no boundary to measure at this size.")
    elif few:
        notes.append("Few boxes lie on a boundary: take more states, or smaller boxes.")
    if not few and not entropy.fractal:
        notes.append("S_bb above ln 2 means a fractal boundary; below it, either is possible.")
    return Description(
        f"basin entropy {entropy.entropy:.4f}, on the boundary {bound}, boxes of {sides} states",
        facts,
        notes=notes,
    )


@describes(BasinEntropies)
def describe_entropies(entropies: BasinEntropies) -> Description:
    """Return both entropies at each value."""
    rows = [
        {
            entropies.parameter: value,
            "entropy": entropy.entropy,
            "boundary_entropy": entropy.boundary_entropy,
            "fractal": entropy.fractal,
            "boundary_boxes": entropy.boundary_boxes,
            "basins": entropy.basins,
        }
        for value, entropy in zip(entropies.values.tolist(), entropies.entropies, strict=True)
    ]
    first = entropies.entropies[0]
    sides = " x ".join(map(str, first.box))
    facts = [
        Fact("box", list(first.box), "box", f"{sides} states"),
        Fact("boxes", first.boxes, "boxes"),
    ]
    columns = [
        Column(
            entropies.parameter, entropies.parameter.replace("_", " "), lambda value: f"{value:.6g}"
        ),
        Column("entropy", "S_b", lambda value: f"{value:.4f}"),
        Column("boundary_entropy", "S_bb", lambda value: f"{value:.4f}".replace("nan", "—")),
        Column("fractal", "above ln 2"),
        Column("boundary_boxes", "boundary boxes"),
    ]
    low, high = float(entropies.entropy.min()), float(entropies.entropy.max())
    headline = f"basin entropy from {low:.4f} to {high:.4f}, boxes of {sides} states"
    note = "S_bb above ln 2 means a fractal boundary; below it, either is possible."
    return Description(headline, facts, [Table("entropies", rows, columns)], [note])


ROUGH = 0.05
"""Standard error from which on a description calls the fit poor."""
FEW = 20
"""Uncertain states or boxes below which a scale is of little use."""


@describes(UncertaintyExponent)
def describe_exponent(uncertainty: UncertaintyExponent) -> Description:
    """Return the exponent with its interval, the dimension, and the counts."""
    low, high = uncertainty.interval()
    rows = [
        {"size": size, "uncertain": uncertain, "total": total, "share": uncertain / total}
        for size, uncertain, total in zip(
            uncertainty.size.tolist(),
            uncertainty.uncertain.tolist(),
            uncertainty.total.tolist(),
            strict=True,
        )
    ]
    known = not math.isnan(uncertainty.exponent)
    error = f" ± {uncertainty.standard_error:.3f}"
    value = f"{uncertainty.exponent:.3f}{error}" if known else NOT_IDENTIFIED
    facts = [
        Fact("by", uncertainty.by, "counted", uncertainty.by),
        Fact("exponent", uncertainty.exponent, "uncertainty exponent", value),
        Fact("standard_error", uncertainty.standard_error),
        Fact("interval", [low, high]),
        Fact(
            "",
            label=CONFIDENCE_TEXT,
            text="—" if math.isnan(low) else f"{low:.3f} to {high:.3f}",
        ),
        Fact(
            "dimension",
            uncertainty.dimension,
            "dimension of the boundary",
            f"{uncertainty.dimension:.3f}{error}" if known else "—",
        ),
        Fact(
            "r_squared",
            uncertainty.r_squared,
            "r²",
            f"{uncertainty.r_squared:.4f}" if known else "—",
        ),
        Fact("dimensions", uncertainty.dimensions),
    ]
    columns = [
        Column("size", "cells"),
        Column("uncertain", f"uncertain {uncertainty.by}"),
        Column("share", "share", lambda share: f"{100.0 * share:.2f} %"),
    ]
    notes = []
    if not known:
        notes.append(f"Fewer than {FEWEST_SIZES} sizes meet a boundary, {TOO_FEW} for an exponent.")
    elif (
        uncertainty.standard_error > ROUGH
        or uncertainty.uncertain[uncertainty.uncertain > 0].min() < FEW
    ):
        notes.append("The fit is poor, or counts are small: take more states in the window.")
    if known and uncertainty.by == "boxes" and int(uncertainty.size.min()) < 5:
        notes.append(
            "A box of few states misses boundaries near its edge, which raises the exponent."
        )
    sizes = plural(len(uncertainty.size), "size")
    return Description(
        f"uncertainty exponent {value} by {uncertainty.by}, {sizes}",
        facts,
        [Table("scales", rows, columns)],
        notes,
    )


@describes(BoundaryCheck)
def describe_check(check: BoundaryCheck) -> Description:
    """Return the verdict with the entropy of the balls and that of a smooth boundary."""
    low = check.smooth_entropy - check.standard_error
    high = check.smooth_entropy + check.standard_error + check.bias
    text = f"{check.boundary_entropy:.4f} ± {check.standard_error:.4f}"
    smooth = f"{low:.4f} to {high:.4f}"
    facts = [
        Fact("verdict", check.verdict, "boundary", f"{check.verdict} at this scale"),
        Fact("boundary_entropy", check.boundary_entropy, "boundary entropy S_bb", text),
        Fact("standard_error", check.standard_error),
        Fact("smooth_entropy", check.smooth_entropy, "smooth boundaries", smooth),
        Fact("bias", check.bias),
        Fact("radius", check.radius, "radius", f"{check.radius} cells"),
        Fact("balls", check.balls, "balls"),
        Fact("seed", check.seed, "seed"),
        Fact("fine", check.fine),
    ]
    notes = []
    if not check.fine:
        notes.append(
            f"The window is narrower than {FINE} radii: a fold of a smooth boundary may look "
            "fractal. Take more states, or a smaller radius."
        )
    return Description(f"{check.verdict} boundary: S_bb {text}, smooth {smooth}", facts, [], notes)
