"""Facts, tables, notes and dataset of shares of basins over a parameter."""

from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.dynamics.basins.basin_facts import CONFIDENCE, axis_values
from rocksteady.dynamics.history.nonlinear_tables import attributes_of
from rocksteady.dynamics.parameters import AXES, SYMBOLS
from rocksteady.model.blocks.block import Block
from rocksteady.model.facts import (
    amplitude_text,
    block_text,
    frequency_text,
    harmonic_values,
    lean_text,
)
from rocksteady.outcomes import AttractorKind
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import number, plural

if TYPE_CHECKING:
    import xarray

PHASE = "phase"
SI = {"amplitude": "accel_g", "frequency_ratio": "freq_hz"}
"""The same parameters of a block with a size."""


def shares_described(found: Any) -> Description:
    """Return the facts of shares: families, their shares by value, window and case."""
    block, motion, name = found.block, found.motion, found.parameter
    symbol = SYMBOLS.get(name, name)
    values = harmonic_values(block, motion)
    for key in (
        name,
        SI.get(name, ""),
        *(("negative_restitution",) if name == "restitution" else ()),
    ):
        values.pop(key, None)
    ends = f"{symbol} from {found.values[0]:.6g} to {found.values[-1]:.6g}"
    drawn = found.seed is not None
    facts = [
        Fact("parameter", name),
        Fact("values", found.values.tolist(), "values", f"{len(found.values):,}: {ends}"),
        Fact("block", values.pop("block"), "block", _block_words(found))
        if isinstance(block, Block)
        else Fact("", label="block" if _block_words(found) else "", text=_block_words(found)),
        Fact("", label="base motion", text=", ".join(_motion_words(found))),
        *(Fact(key, value) for key, value in values.items()),
        *([] if name == PHASE else [Fact(PHASE, motion.phase)]),
        Fact("model", found.model.name, "model"),
        Fact("", label="states", text=f"{found.label[0].size:,} at each value, {_window(found)}"),
        Fact("cycles", found.max_cycles, "followed for", f"{found.max_cycles} periods at most"),
        Fact("seed", found.seed, "seed" if drawn else ""),
        Fact("confidence", CONFIDENCE if drawn else None),
        Fact("angles", axis_values(found.angle)),
        Fact("velocities", axis_values(found.velocity)),
        Fact("distance", found.matching.distance),
        Fact("threshold", found.matching.threshold),
        *(Fact(key) for key in ("fractions", "erosion", "drop")),
    ]
    columns = [
        Column("name", "basin", left=True),
        Column("from", symbol, lambda value: f"{value:.6g}"),
        Column("to", "to", lambda value: f"{value:.6g}"),
        Column("least", "least", lambda share: f"{100.0 * share:.2f} %"),
        Column("most", "most", lambda share: f"{100.0 * share:.2f} %"),
        Column("periods", "periods", lambda periods: ", ".join(map(str, periods))),
    ]
    families = _family_rows(found)
    return Description(
        f"{plural(len(families), 'basin')} over {ends}, {_case(found)}",
        facts,
        [
            Table("shares", _rows(found)),
            Table("families", families),
            Table("", families, columns, "shares where the attractor is there", most=40),
        ],
        _notes(found),
    )


def _block_words(found: Any) -> str:
    """Return the block in words, without a restitution that is the parameter."""
    parts = block_text(found.block).split(", ")
    moved = found.parameter == "restitution"
    return ", ".join(part for part in parts if not (moved and part.startswith("restitution")))


def _motion_words(found: Any) -> list[str]:
    """Return amplitude, frequency and phase in words, but for the parameter."""
    motion = found.motion
    words = {
        "amplitude": amplitude_text(found.block, motion.amplitude),
        "frequency_ratio": frequency_text(found.block, motion.frequency_ratio),
        PHASE: f"phase {number(motion.phase)} rad",
    }
    return [text for key, text in words.items() if key != found.parameter]


def _case(found: Any) -> str:
    """Return what stays the same in a few words: amplitude, frequency, restitution, model."""
    motion, bare = found.motion, found.block.dimensionless()
    left, right = bare.restitution, getattr(bare, "negative_restitution", None)
    both = f"{left:.6g}" if right is None or right == left else f"{left:.4g}/{right:.4g}"
    words = {
        "amplitude": f"A = {motion.amplitude:.6g}",
        "frequency_ratio": f"Ω = {motion.frequency_ratio:.6g}",
        "restitution": f"restitution {both}",
    }
    said = [text for key, text in words.items() if key != found.parameter]
    return ", ".join([*said, f"{found.model.name} model"])


def _window(found: Any) -> str:
    """Return the window of the states."""
    least, most = (lean_text(found.block, float(end)) for end in found.angle[[0, -1]])
    slow, fast = (number(float(end)) for end in found.velocity[[0, -1]])
    return f"u from {least} to {most}, du/d(pt) from {slow} to {fast}"


def _rows(found: Any) -> list[dict[str, Any]]:
    """Return a row a family and value at which it is there."""
    low, high = found.intervals(CONFIDENCE)
    rows = []
    for place, value in enumerate(found.values.tolist()):
        for family in found.families:
            one = family.attractors[place]
            if one is None:
                continue
            orbit = one.orbit
            rows.append(
                {
                    found.parameter: value,
                    "label": family.label,
                    "name": family.name,
                    "share": float(found.share[family.label, place]),
                    "low": float(low[family.label, place]),
                    "high": float(high[family.label, place]),
                    "states": int(found.states[family.label, place]),
                    "kind": str(one.kind.value),
                    "period": one.period,
                    "impacts": one.impacts,
                    "highest": None if orbit is None else orbit.highest,
                    "lowest": None if orbit is None else orbit.lowest,
                }
            )
    return rows


def _family_rows(found: Any) -> list[dict[str, Any]]:
    """Return a row a family: where it is there, and its least and largest share."""
    rows = []
    for family in found.families:
        where = family.present
        shares, values = found.share[family.label, where], found.values[where]
        rows.append(
            {
                "label": family.label,
                "name": family.name,
                "from": float(values[0]),
                "to": float(values[-1]),
                "values": int(where.sum()),
                "least": float(shares.min()),
                "most": float(shares.max()),
                "periods": list(family.periods),
            }
        )
    return rows


def _notes(found: Any) -> list[str]:
    """Return what a reader should know of these shares."""
    notes = []
    if any((found.states[one.label][one.present] == 0).any() for one in found.families):
        notes.append(
            "Share 0: no state of the window goes there, the motion at a neighbouring value does."
        )
    if any(one.typical.kind is AttractorKind.APERIODIC for one in found.families):
        notes.append(
            f"Aperiodic: not settled within {found.max_cycles} periods, and neighbours part. All "
            "such motions are one basin."
        )
    if found.undecided:
        notes.append("States are undecided: they balance for ever, or take more periods to follow.")
    return notes


def shares_dataset(found: Any) -> "xarray.Dataset":
    """Return shares as a labelled dataset."""
    import xarray

    name = found.parameter
    low, high = found.intervals(CONFIDENCE)
    along = ("family", name)

    def of_orbits(attribute: str, missing: float) -> list[list[float]]:
        return [
            [missing if orbit is None else getattr(orbit, attribute) for orbit in family.orbits]
            for family in found.families
        ]

    flags = {
        "flag_values": list(range(len(found.families))),
        "flag_meanings": " ".join(family.name for family in found.families),
    }
    kept = {"amplitude", "frequency_ratio", PHASE} - {name}
    plane = (name, "velocity", "angle")
    return xarray.Dataset(
        {
            "share": (along, found.share, {"units": "1"}),
            "low": (along, low, {"units": "1", "confidence": CONFIDENCE}),
            "high": (along, high, {"units": "1", "confidence": CONFIDENCE}),
            "states": (along, found.states),
            "present": (along, np.array([family.present for family in found.families])),
            "period": (along, np.array(of_orbits("period", 0), dtype=np.int64)),
            "highest": (along, np.array(of_orbits("highest", np.nan)), {"units": "1"}),
            "lowest": (along, np.array(of_orbits("lowest", np.nan)), {"units": "1"}),
            "label": (plane, found.label, {"long_name": "family", "units": "1", **flags}),
        },
        coords={
            "family": ("family", [family.name for family in found.families]),
            name: (name, found.values, dict(zip(("units", "long_name"), AXES[name], strict=True))),
            "angle": ("angle", found.angle, {"long_name": "theta/alpha", "units": "1"}),
            "velocity": (
                "velocity",
                found.velocity,
                {"long_name": "d(theta/alpha)/d(p t)", "units": "1"},
            ),
        },
        attrs={
            **{key: getattr(found.motion, key) for key in sorted(kept)},
            **{
                key: value
                for key, value in attributes_of(found.block, found.model).items()
                if name != "restitution" or "restitution" not in key
            },
            "max_cycles": found.max_cycles,
            "seed": "none" if found.seed is None else str(found.seed),
            "distance": found.matching.distance,
            "threshold": found.matching.threshold,
        },
    )
