"""Values of orbits, for JSON."""

from typing import Any

from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.steady.verdicts import multipliers_value
from rocksteady.model.blocks.block import Block
from rocksteady.model.facts import AnyBlock
from rocksteady.model.motions.fourier import PeriodicMotion


def plain_orbit(orbit: Orbit, block: AnyBlock, motion: PeriodicMotion) -> dict[str, Any]:
    """Return an orbit of a block in plain values, in SI too where the block has a size."""
    peaks = [orbit.highest, orbit.lowest] if orbit.admissible else None
    values: dict[str, Any] = {
        "kind": orbit.kind,
        "period": orbit.period,
        "impacts_per_period": orbit.impacts,
        "rest_phases": orbit.rest_phases,
        "peaks": peaks,
        "multipliers": multipliers_value(orbit.multipliers),
        "lyapunov": orbit.lyapunov,
        "residual": orbit.residual,
        "states": [
            {"side": each.side, "phase": each.phase, "speed": each.speed} for each in orbit.states
        ],
    }
    if isinstance(block, Block):
        values["peaks_rad"] = None if peaks is None else [peak * block.alpha for peak in peaks]
        values["period_s"] = orbit.period / motion.frequency_hz(block)
    return values
