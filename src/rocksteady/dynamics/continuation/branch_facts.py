"""Facts of branches, their bifurcations and cascades, for texts, JSON and tables."""

import math
from collections.abc import Iterable, Sequence
from typing import Any

from rocksteady.dynamics.parameters import SYMBOLS
from rocksteady.dynamics.steady.verdicts import multipliers_value
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.equations import Linear, Model, Nonlinear
from rocksteady.model.facts import AnyBlock, block_text, block_values, restitution_text
from rocksteady.model.motions.fourier import PeriodicMotion, harmonics_of
from rocksteady.model.motions.harmonics import Harmonics
from rocksteady.model.motions.segments import Harmonic
from rocksteady.results.description import Column, Fact, Table
from rocksteady.results.numbers import number

# The classes that use this module are named Any: to import them would close a circle.

SHORT = {**SYMBOLS, "restitution": "delta"}
"""As headings have them."""
UNITS = {"amplitude": ("accel_g", "g"), "frequency_ratio": ("freq_hz", "Hz")}
"""What stands beside a parameter of a block with a size."""
ENDS = {
    "symmetry-breaking": "breaking",
    "period-doubling": "doubling",
    "grazing": "graze",
    "end-of-range": "range end",
}
"""The ends of branches, shorter."""
BARE = DimensionlessBlock(restitution=1.0)
"""What has no size, for texts in units of alpha."""


def model_text(block: AnyBlock, model: Model) -> str:
    """Return the equations of motion, the nonlinear ones with the slenderness of the block."""
    name = f"{model.name} model"
    if isinstance(model, Linear) or not isinstance(block, Block):
        return name
    leans = dict.fromkeys(f"{side.alpha:.6g}" for side in (block.positive, block.negative))
    return f"{name}, alpha {'/'.join(leans)} rad"


def model_facts(block: AnyBlock, model: Model) -> list[Fact]:
    """Return the equations of motion and what they need of a block beside its restitution."""
    facts = []
    bare = block.dimensionless()
    if isinstance(model, Nonlinear) and isinstance(block, Block):
        leans = [block.positive.alpha, block.negative.alpha]
        text = "/".join(dict.fromkeys(f"{lean:.6g}" for lean in leans)) + " rad"
        facts.append(Fact("alpha_rad", leans[0] if leans[0] == leans[1] else leans, "alpha", text))
    if not block.symmetric:
        (first, _, _), (second, lean, rate) = bare.sides
        if second != first:
            text = f"restitution {second:.6g}"
            facts.append(Fact("negative_restitution", second, "negative side", text))
        facts += [
            Fact("alpha_ratio", lean, "alpha, negative / positive side", f"{lean:.6g}"),
            Fact("p_ratio", rate, "p, negative / positive side", f"{rate:.6g}"),
        ]
    return [*facts, Fact("model", model.name, "model")]


def block_fact(block: Block, moving: Sequence[str]) -> Fact:
    """Return the measures of a block, without its restitution where that is one that moves."""
    values, text = block_values(block), block_text(block)
    if "restitution" in moving:
        text = text.removesuffix(f", {restitution_text(block)}")
        values["restitution"] = None
        if "negative" in values:
            values["negative"] = {**values["negative"], "restitution": None}
    return Fact("block", values, "block", text)


def model_facts_over(block: AnyBlock, model: Model, moving: Sequence[str]) -> list[Fact]:
    """Return the facts of the model beside those of parameters that move and of `block_fact`."""
    block_named = block.with_restitution(1.0) if "restitution" in moving else block
    sized = isinstance(block, Block)
    return [fact for fact in model_facts(block_named, model) if fact.key == "model" or not sized]


def kept_text(block: AnyBlock) -> str:
    """Return the restitution of a block; both values where its impacts differ."""
    kept = [side[0] for side in block.dimensionless().sides]
    return "/".join(dict.fromkeys(f"{each:.6g}" for each in kept))


def point_case(point: Any) -> str:
    """Return restitution and equations of motion of a point in a few words."""
    kept = f"{point.restitution:.8g}"
    negative = point.block.dimensionless().sides[1][0]
    if negative != point.restitution and not point.block.symmetric:
        kept += f"/{negative:.8g}"
    model = model_text(point.block, point.model)
    return f"restitution {kept}{orders_text(point.chain.harmonics)}, {model}"


def in_si(block: AnyBlock, amplitude: float, frequency_ratio: float) -> dict[str, float]:
    """Return harmonic motion in g and Hz where the block has a size, else nothing."""
    if not isinstance(block, Block):
        return {}
    motion = Harmonic(amplitude=amplitude, frequency_ratio=frequency_ratio)
    return {
        "accel_g": in_g(motion.acceleration_m_s2(block)),
        "freq_hz": motion.frequency_hz(block),
    }


def case_text(
    block: AnyBlock, motion: PeriodicMotion, parameter: str, within: tuple[float, float]
) -> str:
    """Return the three parameters of a diagram in a few words."""
    parts = []
    for name, value in fixed_values(block, motion, [parameter]).items():
        symbol, equals = SYMBOLS[name], " " if name == "restitution" else " = "
        if value is None:
            parts.append(f"{symbol} from {within[0]:.6g} to {within[1]:.6g}")
        else:
            text = kept_text(block) if name == "restitution" else f"{value:.6g}"
            parts.append(f"{symbol}{equals}{text}")
    return ", ".join(parts) + orders_text(harmonics_of(motion))


def orders_text(harmonics: Harmonics) -> str:
    """Return the orders of a Fourier series, after a comma; nothing of a sinusoid."""
    if not harmonics:
        return ""
    return f", orders {', '.join(str(order) for order, _, _ in harmonics)}"


def series_facts(harmonics: Harmonics) -> list[Fact]:
    """Return the harmonics of a Fourier series; nothing of a sinusoid."""
    return [Fact("harmonics", [list(wave) for wave in harmonics])] if harmonics else []


def case_facts(
    block: AnyBlock,
    motion: PeriodicMotion,
    parameter: str,
    within: tuple[float, float],
    model: Model,
) -> list[Fact]:
    """Return what moves in a diagram, between what, and what else is fixed."""
    scales = {"amplitude": motion.amplitude, "frequency_ratio": motion.frequency_ratio}
    over = f"{SYMBOLS[parameter]} from {number(within[0], 6)} to {number(within[1], 6)}"
    fixed = fixed_values(block, motion, [parameter])
    facts = [Fact(name, value) for name, value in fixed.items()]
    facts += series_facts(harmonics_of(motion))
    if isinstance(block, Block):
        facts.append(block_fact(block, [parameter]))
        si = in_si(block, **scales)
        for name, (key, unit) in UNITS.items():
            if name == parameter:
                low, high = (number(in_si(block, **{**scales, name: end})[key]) for end in within)
                over = f"{low} to {high} {unit} ({over})"
                facts.append(Fact(key, None))
            else:
                label = {"g": "amplitude", "Hz": "frequency"}[unit]
                facts.append(Fact(key, si[key], label, f"{number(si[key])} {unit}"))
    return [
        Fact("parameter", parameter),
        Fact("within", list(within), "over", over),
        *facts,
        *model_facts_over(block, model, [parameter]),
    ]


def fixed_values(
    block: AnyBlock, motion: PeriodicMotion, varied: Iterable[str]
) -> dict[str, float | None]:
    """Return the three parameters; None for a varied parameter."""
    return {
        "amplitude": motion.amplitude,
        "frequency_ratio": motion.frequency_ratio,
        "restitution": block.dimensionless().restitution,
        **dict.fromkeys(varied),
    }


def extremes(point: Any, lean: float) -> list[float]:
    """Return the highest and the lowest u of an orbit, or of its mirror image for a lean of -1."""
    peaks = lean * point.peaks
    return [float(peaks.max()), float(peaks.min())]


def place_values(point: Any) -> dict[str, Any]:
    """Return the type of a point, where it lies, and its period."""
    return {
        "type": point.type.value,
        "amplitude": point.amplitude,
        "frequency_ratio": point.frequency_ratio,
        "restitution": point.restitution,
        "period": point.period,
    }


def orbit_values(point: Any) -> dict[str, Any]:
    """Return the type of a point, where it lies, and which orbit is there."""
    return {**place_values(point), "impacts": point.impacts, "symmetric": point.symmetric}


def multiplier_columns(multipliers: Iterable[complex]) -> dict[str, float]:
    """Return both multipliers as columns of a file."""
    first, second = (complex(m) for m in multipliers)
    return {
        "multiplier_1_re": first.real,
        "multiplier_1_im": first.imag,
        "multiplier_2_re": second.real,
        "multiplier_2_im": second.imag,
    }


def point_values(point: Any, lean: float, block: AnyBlock) -> dict[str, Any]:
    """Return a point of a branch in plain values, in SI too where the block has a size."""
    values: dict[str, Any] = {
        **orbit_values(point),
        "peaks": extremes(point, lean),
        "multipliers": multipliers_value(point.multipliers),
    }
    values |= in_si(block, point.amplitude, point.frequency_ratio)
    if isinstance(block, Block):
        values["peaks_rad"] = [peak * block.alpha for peak in values["peaks"]]
    return values


def point_row(branch: int, point: Any, lean: float, block: AnyBlock) -> dict[str, Any]:
    """Return the row of a point of a branch in a file."""
    high, low = extremes(point, lean)
    row: dict[str, Any] = {
        "branch": branch,
        **orbit_values(point),
        "stable": point.stable,
        "admissible": point.admissible,
        **multiplier_columns(point.multipliers),
        "highest": high,
        "lowest": low,
        "arclength": point.arclength,
        **in_si(block, point.amplitude, point.frequency_ratio),
    }
    if isinstance(block, Block):
        row |= {"highest_rad": high * block.alpha, "lowest_rad": low * block.alpha}
    return row


def branch_values(branch: Any) -> dict[str, Any]:
    """Return what a branch is, its ends, and where it is stable."""
    name = branch.parameter
    begin, end = (
        {"type": point.type.value, name: getattr(point, name)}
        for point in (branch.points[0], branch.points[-1])
    )
    stable = [
        sorted((float(branch.values[part.first]), float(branch.values[part.last])))
        for part in branch.stretches
        if part.stable
    ]
    return {
        "period": branch.period,
        "impacts": branch.impacts,
        "symmetric": branch.symmetric,
        "begin": begin,
        "end": end,
        "within": [float(branch.values.min()), float(branch.values.max())],
        "stable_ranges": sorted(stable),
        "points": len(branch.points),
    }


def range_text(low: float, high: float) -> str:
    """Return a range; for one too narrow for five digits its lower end and its width."""
    first, last = f"{low:.5g}", f"{high:.5g}"
    return f"{low:.7g} + {high - low:.0e}" if first == last else f"{first} to {last}"


def stable_text(ranges: Sequence[Sequence[float]]) -> str:
    """Return the first of the ranges in which a branch is stable, and how many more there are."""
    texts = [range_text(low, high) for low, high in ranges]
    return texts[0] + (f" +{len(texts) - 1}" if len(texts) > 1 else "") if texts else "—"


def kind_word(symmetric: object) -> str:
    """Return symmetric or unsymmetric."""
    return "symmetric" if symmetric else "unsymmetric"


def bifurcations_table(
    points: Sequence[dict[str, Any]], parameter: str, block: AnyBlock, *, key: str = ""
) -> Table:
    """Return bifurcations for people: where they are with the digits that are known."""
    unit, heading = UNITS.get(parameter, ("", ""))
    sized = isinstance(block, Block)

    def angle(u: float) -> str:
        if isinstance(block, Block):
            return f"{math.degrees(u * block.alpha):.2f}°"
        return f"{u:.4f}"

    columns = [
        Column("branch", "branch"),
        Column("type", "bifurcation", lambda kind: str(kind).replace("-", " "), left=True),
        Column(parameter, SHORT[parameter], lambda value: f"{value:.8f}"),
        # The unit takes the place of the kind, which the branches' table has too.
        Column(unit, heading, lambda value: f"{value:.6g}")
        if sized and unit
        else Column("symmetric", "kind", kind_word, left=True),
        Column("period", "period"),
        Column("impacts", "impacts"),
        Column("peaks", "highest", lambda peaks: angle(peaks[0])),
        Column("peaks", "lowest", lambda peaks: angle(peaks[1])),
    ]
    return Table(
        key,
        points,
        columns,
        most=MOST_ROWS,
        kind=lambda row: str(row["type"]).replace("-", " "),
    )


def branches_table(branches: Sequence[dict[str, Any]], parameter: str) -> Table:
    """Return branches for people and for JSON."""

    def end(values: dict[str, Any]) -> str:
        kind = str(values["type"])
        return ENDS.get(kind, kind)

    columns = [
        Column("branch", "branch"),
        Column("period", "period"),
        Column("impacts", "impacts"),
        Column("symmetric", "kind", kind_word, left=True),
        Column("begin", "from", end, left=True),
        Column("end", "to", end, left=True),
        Column("stable_ranges", f"stable in {SHORT[parameter]}", stable_text, left=True),
    ]
    return Table(
        "branches",
        branches,
        columns,
        most=MOST_ROWS,
        kind=lambda row: kind_word(row["symmetric"]),
    )


MOST_ROWS = 100
"""Bifurcations and branches that a summary lists."""


def cascade_table(cascade: dict[str, Any], parameter: str) -> Table:
    """Return the doublings of a cascade for people."""
    count = len(cascade["values"])
    rows = [
        {"period": period, parameter: value, "distance": distance, "ratio": ratio}
        for period, value, distance, ratio in zip(
            cascade["periods"],
            cascade["values"],
            [*cascade["distances"], None],
            [None, *cascade["ratios"], None][:count],
            strict=True,
        )
    ]
    columns = [
        Column("period", "period", lambda period: f"{period} -> {2 * period}"),
        Column(parameter, SHORT[parameter], lambda value: f"{value:.12f}"),
        Column("distance", "distance", lambda d: "" if d is None else f"{abs(d):.3e}"),
        Column("ratio", "ratio", lambda r: "" if r is None else f"{r:.4f}"),
    ]
    plural = "period doubling" if count == 1 else "period doublings"
    return Table("", rows, columns, f"cascade of {count} {plural}")


def cascade_notes(cascade: dict[str, Any]) -> list[str]:
    """Return what follows from the distances of a cascade for its limit."""
    if not cascade["ratios"]:
        return ["fewer than three doublings have no ratio"]
    limit = f"limit {cascade['limit']:.12f}, if the distances go on shrinking by the last ratio"
    return [f"{limit}; the ratios tend to Feigenbaum's 4.6692"]
