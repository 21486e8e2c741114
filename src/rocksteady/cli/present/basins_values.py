"""Basins and erosion as plain values for JSON, and as rows for files."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from rocksteady.cli.present.shared import orbit_values, shaking_values
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.motions.segments import Harmonic

if TYPE_CHECKING:
    from rocksteady.dynamics.basins.basins import Basins
    from rocksteady.dynamics.basins.erosion import Erosion, IntegrityDrop

CONFIDENCE = 0.95
"""Of the intervals."""


def window_values(found: "Basins | Erosion") -> dict[str, Any]:
    """Return the window and how long its states were followed."""
    return {
        "angles": _axis_values(found.angle),
        "velocities": _axis_values(found.velocity),
        "cycles": found.cycles,
        "model": found.model.name,
    }


def _axis_values(points: Any) -> dict[str, float]:
    return {"start": float(points[0]), "stop": float(points[-1]), "count": len(points)}


def basins_values(found: "Basins", body: Block | DimensionlessBlock) -> dict[str, Any]:
    """Return shares and attractors in plain values."""
    fractions = []
    for attractor, fraction in zip(found.attractors, found.fractions(CONFIDENCE), strict=True):
        orbit = attractor.orbit
        fractions.append(
            {
                "label": fraction.label,
                "name": attractor.name,
                "kind": attractor.kind.value,
                "period": attractor.period,
                "share": fraction.share,
                "low": fraction.low,
                "high": fraction.high,
                "states": fraction.states,
                "stroboscopic": found.stroboscopic[fraction.label].tolist(),
                "orbit": None if orbit is None else orbit_values(orbit, body),
            }
        )
    return {
        "fractions": fractions,
        # No probability belongs to the middles of the cells, which are no random sample.
        "confidence": None if found.seed is None else CONFIDENCE,
        "erosion": None,
        "drop": None,
        **window_values(found),
        "seed": found.seed,
        "phase": found.shaking.phase,
        **shaking_values(body, found.shaking),
    }


def erosion_values(
    found: "Erosion", drops: "dict[str, IntegrityDrop | None]", body: Block | DimensionlessBlock
) -> dict[str, Any]:
    """Return the measures of integrity and where they drop in plain values."""
    columns = {
        "amplitude": found.amplitude,
        **({"accel_g": found.amplitude * body.alpha} if isinstance(body, Block) else {}),
        "global_integrity": found.global_integrity,
        "integrity_factor": found.integrity_factor,
        "safe_share": found.safe_share,
        "radius": found.radius,
    }
    tangency = found.heteroclinic
    rows = zip(*(values.tolist() for values in columns.values()), strict=True)
    shaking = Harmonic(amplitude=0.0, frequency_ratio=found.frequency_ratio)
    measures = shaking_values(body, shaking)
    for name in ("amplitude", "accel_g"):  # there are many of them
        measures.pop(name, None)
    return {
        "fractions": None,
        "erosion": [dict(zip(columns, row, strict=True)) for row in rows],
        "drop": {
            measure: None
            if drop is None
            else {
                "level": drop.level,
                "low": drop.low,
                "high": drop.high,
                "above": drop.above,
                "below": drop.below,
            }
            for measure, drop in drops.items()
        },
        "heteroclinic_amplitude": tangency,
        **(
            {"heteroclinic_accel_g": None if tangency is None else tangency * body.alpha}
            if isinstance(body, Block)
            else {}
        ),
        "still": {"safe_share": found.still_share, "radius": found.still_radius},
        **window_values(found),
        "phase": found.phase,
        **measures,
    }


def undecided(values: dict[str, Any]) -> float:
    """Return the share of undecided states."""
    shares = {fraction["kind"]: fraction["share"] for fraction in values["fractions"]}
    return float(shares.get("undecided", 0.0))


def state_rows(found: "Basins") -> Iterator[Sequence[object]]:
    """Yield one row a state: where it is, and where it goes."""
    names = [attractor.name for attractor in found.attractors]
    columns = (found.start_angle, found.start_velocity, found.label)
    for angle, velocity, label in zip(*(c.ravel().tolist() for c in columns), strict=True):
        yield angle, velocity, label, names[label]
