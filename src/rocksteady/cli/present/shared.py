"""Values and text that several commands print: block, shaking, orbit."""

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.motions.pulses import Pulse
from rocksteady.model.motions.segments import Harmonic
from rocksteady.show.style.palette import shortened

if TYPE_CHECKING:
    from rocksteady.dynamics.orbits.orbit import Orbit

SIGN_CHANGED: Final = re.compile("sign changed: ")
"""Beginning of the notes on a record whose sign is not that of its file."""


def block_values(block: Block) -> dict[str, Any]:
    """Return a block's measures in SI; of one whose sides differ those of both."""
    positive, negative = (
        {
            "alpha_rad": side.alpha,
            "radius_m": side.radius,
            "p_rad_s": side.p,
            "restitution": side.restitution,
        }
        for side in (block.positive, block.negative)
    )
    if block.symmetric:
        return positive
    distances = {"left_m": block.positive.distance, "right_m": block.negative.distance}
    return {**positive, **distances, "height_m": block.height, "negative": negative}


def restitution_values(block: Block | DimensionlessBlock) -> dict[str, Any]:
    """Return the restitution, or that of either impact where they differ."""
    first, second = (restitution for restitution, _, _ in block.dimensionless().sides)
    found = {"restitution": first}
    return found if first == second else {**found, "negative_restitution": second}


def shaking_values(block: Block | DimensionlessBlock, shaking: Harmonic | Pulse) -> dict[str, Any]:
    """Return block and shaking without its phase, in SI too where the block has a size."""
    values: dict[str, Any] = {
        "amplitude": shaking.amplitude,
        "frequency_ratio": shaking.frequency_ratio,
        **restitution_values(block),
    }
    if isinstance(block, Block):
        values["block"] = block_values(block)
        values["accel_g"] = shaking.acceleration_m_s2(block) / block.gravity
        values["freq_hz"] = shaking.frequency_hz(block)
    return values


def orbit_values(orbit: "Orbit", block: Block | DimensionlessBlock) -> dict[str, Any]:
    """Return what the contract promises for an orbit, in SI too where the block has a size."""
    values: dict[str, Any] = {
        "kind": orbit.kind,
        "period": orbit.period,
        "impacts_per_period": orbit.impacts,
        "rest_phases": orbit.rest_phases,
        "peaks": [orbit.highest, orbit.lowest] if orbit.admissible else None,
        "multipliers": [complex(m) for m in orbit.multipliers],
        "lyapunov": orbit.lyapunov,
        "residual": orbit.residual,
        "states": [
            {"side": state.side, "phase": state.phase, "speed": state.speed}
            for state in orbit.states
        ],
    }
    if isinstance(block, Block):
        peaks = values["peaks"]
        values["peaks_rad"] = None if peaks is None else [peak * block.alpha for peak in peaks]
        values["period_s"] = orbit.period / orbit.motion.frequency_hz(block)
    return values


def turned_text(processing: Sequence[str]) -> str:
    """Return the words of a title on a changed sign; none where it is as filed."""
    return " (sign changed)" if any(map(SIGN_CHANGED.match, processing)) else ""


def case_text(values: dict[str, Any]) -> str:
    """Return block and shaking in a few words, for a title."""
    parts = [restitution_text(values)]
    if "record" in values:
        up = " and vertical" if "vertical" in values else ""
        # A sign that is not the file's is no detail: the peak may be another one.
        up += turned_text(values.get("vertical_processing", []))
        parts.insert(0, f"{shortened(values['record'])}{up}, PGA {values['pga_g']:.3g} g")
    elif "amplitude" in values:
        parts.insert(0, f"A = {values['amplitude']:g}, Ω = {values['frequency_ratio']:g}")
    else:
        parts.insert(0, "free rocking")
    if "pulse" in values:
        parts.insert(0, f"{values['pulse']} pulse")
    if "block" in values:
        parts.append(block_text(values["block"]))
    if values.get("model") == "nonlinear":
        parts.append("nonlinear model")
    return ", ".join(parts)


def restitution_text(values: dict[str, Any]) -> str:
    """Return what an impact leaves, of either impact where they differ."""
    other = values.get("negative_restitution")
    if other is None:
        return f"restitution {values['restitution']:.4g}"
    return f"restitution {values['restitution']:.3g}/{other:.3g}"


def block_text(block: dict[str, Any]) -> str:
    """Return slenderness and rate of a block; where its sides differ both slendernesses."""
    if "negative" in block:  # four numbers leave no room for what else a title says
        return f"α = {block['alpha_rad']:.3g}/{block['negative']['alpha_rad']:.3g} rad"
    return f"α = {block['alpha_rad']:.4g} rad, p = {block['p_rad_s']:.4g} rad/s"


def plural(count: int, thing: str) -> str:
    """Return a number of things."""
    return f"{count} {thing}" if count == 1 else f"{count} {thing}s"
