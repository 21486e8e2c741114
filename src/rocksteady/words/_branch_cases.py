"""Words that branches and curves share: their case, model and parameters."""

import math
from collections.abc import Iterable, Sequence

from rocksteady.dynamics.continuation.points import BranchPoint
from rocksteady.dynamics.continuation.resting.resting_branch import (
    RestingPoint,
)
from rocksteady.dynamics.parameters import SYMBOLS
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.equations import Linear, Model, Nonlinear
from rocksteady.model.facts import (
    AnyBlock,
    block_text,
    block_values,
    restitution_text,
)
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.motions.harmonics import Harmonics
from rocksteady.model.motions.segments import Harmonic
from rocksteady.results.description import Fact

SHORT = {**SYMBOLS, "restitution": "delta"}
"""As headings have them."""
UNITS = {"amplitude": ("accel_g", "g"), "frequency_ratio": ("freq_hz", "Hz")}
"""What stands beside a parameter of a block with a size."""


def scale_of(block: AnyBlock, parameter: str) -> tuple[float, str, str]:
    """Return by what a parameter is multiplied in an answer, its symbol and its unit.

    Parameters
    ----------
    block
        The block; of one with a size amplitudes are in g, frequencies in Hz.
    parameter
        "amplitude", "frequency_ratio" or "restitution".
    """
    if isinstance(block, Block) and parameter == "amplitude":
        return in_g(block.uplift_acceleration), "", " g"
    if isinstance(block, Block) and parameter == "frequency_ratio":
        return block.p / (2.0 * math.pi), "", " Hz"
    return 1.0, SYMBOLS[parameter].replace("Ω", "W"), ""


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


def in_si(block: AnyBlock, amplitude: float, frequency_ratio: float) -> dict[str, float]:
    """Return harmonic motion in g and Hz where the block has a size, else nothing."""
    if not isinstance(block, Block):
        return {}
    motion = Harmonic(amplitude=amplitude, frequency_ratio=frequency_ratio)
    return {
        "accel_g": in_g(motion.acceleration_m_s2(block)),
        "freq_hz": motion.frequency_hz(block),
    }


def orders_text(harmonics: Harmonics) -> str:
    """Return the orders of a Fourier series, after a comma; nothing of a sinusoid."""
    if not harmonics:
        return ""
    return f", orders {', '.join(str(order) for order, _, _ in harmonics)}"


def series_facts(harmonics: Harmonics) -> list[Fact]:
    """Return the harmonics of a Fourier series; nothing of a sinusoid."""
    return [Fact("harmonics", [list(wave) for wave in harmonics])] if harmonics else []


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


def place_values(point: BranchPoint | RestingPoint) -> dict[str, object]:
    """Return the type of a point, where it lies, and its period."""
    return {
        "type": point.type.value,
        "amplitude": point.amplitude,
        "frequency_ratio": point.frequency_ratio,
        "restitution": point.restitution,
        "period": point.period,
    }


def orbit_values(point: BranchPoint) -> dict[str, object]:
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


def kind_word(symmetric: object) -> str:
    """Return symmetric or unsymmetric."""
    return "symmetric" if symmetric else "unsymmetric"
