"""Facts of blocks and base motions, as results put them into JSON and into words."""

import math
from typing import Any

from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.blocks.sides import same_shape
from rocksteady.model.equations import Model, Nonlinear, slender_block
from rocksteady.model.motions.fourier import FourierSeries, PeriodicMotion
from rocksteady.results.numbers import DIGITS, angle, length, number, quantity

AnyBlock = Block | DimensionlessBlock


def block_values(block: Block) -> dict[str, Any]:
    """Return a block's measures in SI; for one whose sides differ those of both.

    For a block against a wall those of the side on which it rocks, with the restitution of the
    wall.  A body of several parts names them.
    """
    positive: dict[str, Any] = block.positive.to_dict()
    positive |= {} if block.cap is None else block.cap.to_dict()
    positive |= {"parts": block.parts} if block.parts else {}
    if not block.fills_outline:
        centre = block.positive.centre_height
        positive |= {"height_m": block.height, "mass_centre_height_m": centre}
        if any(block.overhangs):
            positive["overhangs_m"] = list(block.overhangs)
    if block.symmetric:
        return positive
    if block.one_sided:
        positive |= {"one_sided": True, "restitution": block.restitution}
        if same_shape(block.positive, block.negative):
            return positive
    distances = {"left_m": block.positive.distance, "right_m": block.negative.distance}
    values = {**positive, **distances, "height_m": block.height}
    return values if block.one_sided else {**values, "negative": block.negative.to_dict()}


def restitution_values(block: AnyBlock) -> dict[str, Any]:
    """Return the restitution, or that of either impact where they differ; for a wall, its own."""
    bare = block.dimensionless()
    if bare.one_sided:
        return {"restitution": bare.restitution, "one_sided": True}
    first, second = (restitution for restitution, _, _ in bare.sides)
    values = {"restitution": first}
    return values if first == second else {**values, "negative_restitution": second}


def side_attributes(block: AnyBlock) -> dict[str, float]:
    """Return restitution and ratios of a block's sides, as a dataset names them.

    For a block against a wall the restitution is the wall's, and ``one_sided`` is 1.
    """
    if block.one_sided:
        return {"restitution": block.restitution, "one_sided": 1.0}
    (first, _, _), (second, alpha_ratio, p_ratio) = block.dimensionless().sides
    attributes = {"restitution": first}
    if not block.symmetric:
        attributes |= {
            "negative_restitution": second,
            "alpha_ratio": alpha_ratio,
            "p_ratio": p_ratio,
        }
    return attributes


def attributes_of(block: AnyBlock, model: Model) -> dict[str, float | str]:
    """Return the attributes of a dataset for its block and its model."""
    attributes: dict[str, float | str] = {**side_attributes(block), "model": model.name}
    if isinstance(model, Nonlinear):
        attributes["alpha"] = slender_block(block).positive.alpha
    return attributes


def harmonic_values(block: AnyBlock, motion: PeriodicMotion) -> dict[str, Any]:
    """Return block and periodic motion without its phase, in SI too where the block has a size."""
    values: dict[str, Any] = {
        "amplitude": motion.amplitude,
        "frequency_ratio": motion.frequency_ratio,
        **restitution_values(block),
    }
    if isinstance(motion, FourierSeries):
        values["harmonics"] = [list(wave) for wave in motion.harmonics]
    if isinstance(block, Block):
        values["block"] = block_values(block)
        values["accel_g"] = in_g(motion.acceleration_m_s2(block))
        values["freq_hz"] = motion.frequency_hz(block)
    return values


def restitution_text(block: AnyBlock) -> str:
    """Return what an impact leaves, of either impact where they differ."""
    if block.one_sided:
        return f"against a wall, restitution {number(block.restitution, 4)}"
    values = restitution_values(block)
    return "restitution " + "/".join(number(value, 4) for value in values.values())


def block_text(block: AnyBlock) -> str:
    """Return slenderness, size, rate and restitution of a block, as engineers write them.

    Examples
    --------
    >>> block_text(Block.rectangle(width=0.4, height=1.2, restitution=0.9))
    'alpha 18.4°, R 632 mm, p 3.41 rad/s, restitution 0.9'
    """
    if isinstance(block, DimensionlessBlock):
        return restitution_text(block)
    return (
        f"alpha {_alphas(block)}, R {length(block.radius)}, p {quantity(block.p, 'rad/s')}, "
        f"{f'{block.parts} as one body, ' if block.parts else ''}{restitution_text(block)}"
    )


def case_text(block: AnyBlock) -> str:
    """Return a block in the few words that a title has room for."""
    if isinstance(block, DimensionlessBlock):
        return restitution_text(block)
    alphas = _alphas(block)
    rate = "" if "/" in alphas else f", p {quantity(block.p, 'rad/s')}"
    rate = ", as one body" if block.parts else rate
    return f"{restitution_text(block)}, alpha {alphas}{rate}"


def solved_text(words: str, block: AnyBlock | None) -> str:
    """Return words on what was solved, and that several parts were solved as one body."""
    return f"{words}, as one body" if isinstance(block, Block) and block.parts else words


def kick_m_s(block: AnyBlock, kick: float | None) -> float:
    """Return a kick [alpha g/p] in m/s; nan without a size or a kick."""
    if kick is None or not isinstance(block, Block):
        return math.nan
    return kick * block.uplift_acceleration / block.p


def kick_text(block: AnyBlock, kick: float, digits: int = DIGITS) -> str:
    """Return a kick [alpha g/p] with its sign, in m/s first where the block has a size."""
    text = quantity(kick, "alpha g/p", digits)
    if not isinstance(block, Block):
        return text
    return f"{quantity(kick_m_s(block, kick), 'm/s', digits)} ({text})"


def other_kick_text(
    block: AnyBlock, kick: float, within: tuple[float, float], digits: int = DIGITS
) -> str:
    """Return the least kick of the other direction, or which kicks do not overturn the block."""
    if not math.isnan(kick):
        return kick_text(block, kick, digits)
    return f"no kick {kicks_text(block, within)} makes it fall"


def kicks_text(block: AnyBlock, within: tuple[float, float]) -> str:
    """Return a range of kicks [alpha g/p] in words."""
    low, high = (kick_text(block, end) for end in within)
    return f"from {low} to {high}" if within[0] else f"up to {high}"


def _alphas(block: Block) -> str:
    """Return the slenderness of each side on which a block rocks."""
    sides = (block.positive,) if block.one_sided else (block.positive, block.negative)
    return "/".join(dict.fromkeys(angle(side.alpha) for side in sides))


def frequency_text(block: AnyBlock, frequency_ratio: float) -> str:
    """Return a frequency ratio; in Hz first where the block has a size."""
    ratio = f"Ω = {number(frequency_ratio, 4)}"
    if isinstance(block, DimensionlessBlock):
        return ratio
    return f"{quantity(frequency_ratio * block.p / (2.0 * math.pi), 'Hz')} ({ratio})"


def amplitude_text(block: AnyBlock, amplitude: float) -> str:
    """Return an amplitude; in g first where the block has a size."""
    ratio = f"A = {number(amplitude, 4)}"
    if isinstance(block, DimensionlessBlock):
        return ratio
    return f"{quantity(in_g(amplitude * block.uplift_acceleration), 'g')} ({ratio})"


def lean_text(block: AnyBlock, lean: float) -> str:
    """Return an angle u = theta/alpha; in degrees first where the block has a size."""
    if isinstance(block, DimensionlessBlock):
        return quantity(lean, "alpha")
    return f"{angle(lean * block.alpha)} = {quantity(lean, 'alpha')}"


def tilt_text(block: AnyBlock, lean: float) -> str:
    """Return an angle u = theta/alpha of an answer; in degrees where the block has a size.

    Examples
    --------
    >>> tilt_text(Block.rectangle(width=0.4, height=1.2, restitution=0.9), 0.142)
    '2.62° (0.142 alpha)'
    """
    part = quantity(lean, "alpha")
    return f"{angle(lean * block.alpha)} ({part})" if isinstance(block, Block) else part


def peak_unit(block: AnyBlock, amplitude: float) -> str:
    """Return an amplitude of an answer: in g where the block has a size, else as A."""
    if isinstance(block, Block):
        return quantity(in_g(amplitude * block.uplift_acceleration), "g")
    return f"A = {number(amplitude)}"
