"""Words of shares of basins over a parameter, and of their families."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, TypedDict

import numpy as np

from rocksteady.dynamics.basins.over.families import BasinFamily
from rocksteady.dynamics.basins.over.shares import BasinShares
from rocksteady.dynamics.parameters import AXES, SYMBOLS
from rocksteady.model.blocks.block import Block
from rocksteady.model.facts import (
    amplitude_text,
    attributes_of,
    block_text,
    frequency_text,
    harmonic_values,
    solved_text,
)
from rocksteady.model.units import CONVERSIONS
from rocksteady.outcomes import AttractorKind
from rocksteady.results.description import Column, Description, Fact, Table, left_out, line
from rocksteady.results.numbers import CONFIDENCE, chance, number, plural
from rocksteady.results.result import describes
from rocksteady.words.windows import (
    FEW,
    MOST_BASINS,
    axis_facts,
    basin_name,
    coordinates_of,
    ends_text,
    window_text,
)

if TYPE_CHECKING:
    import xarray


PHASE = "phase"
Row = TypedDict(
    "Row",
    {
        "label": int,
        "name": str,
        "from": float,
        "to": float,
        "values": int,
        "least": float,
        "most": float,
        "periods": list[int],
    },
)
"""Row of a family: where it exists, and its least and largest share."""
SI = {name: CONVERSIONS[name][0] for name in ("amplitude", "frequency_ratio")}
"""The same parameters of a block with a size."""


@describes(BasinShares)
def describe_shares(shares: BasinShares) -> Description:
    """Return the facts of shares: families, their shares by value, window and case."""
    block, motion, name = shares.block, shares.motion, shares.parameter
    symbol = SYMBOLS.get(name, name)
    values = harmonic_values(block, motion)
    for key in (
        name,
        SI.get(name, ""),
        *(("negative_restitution",) if name == "restitution" else ()),
    ):
        values.pop(key, None)
    ends = f"{symbol} from {shares.values[0]:.6g} to {shares.values[-1]:.6g}"
    drawn = shares.seed is not None
    facts = [
        Fact("parameter", name),
        Fact("values", shares.values.tolist(), "values", f"{len(shares.values):,}: {ends}"),
        Fact("block", values.pop("block"), "block", _block_words(shares))
        if isinstance(block, Block)
        else Fact("", label="block" if _block_words(shares) else "", text=_block_words(shares)),
        Fact("", label="base motion", text=", ".join(_motion_words(shares))),
        *(Fact(key, value) for key, value in values.items()),
        *([] if name == PHASE else [Fact(PHASE, motion.phase)]),
        Fact("model", shares.model.name, "model"),
        Fact(
            "",
            label="states",
            text=f"{shares.label[0].size:,} at each value, {window_text(shares)}",
        ),
        Fact("cycles", shares.max_cycles, "followed for", f"{shares.max_cycles} periods at most"),
        Fact("seed", shares.seed, "seed" if drawn else ""),
        Fact("confidence", CONFIDENCE if drawn else None),
        *axis_facts(shares),
        Fact("distance", shares.matching.distance),
        Fact("threshold", shares.matching.threshold),
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
    families = _family_rows(shares)
    sentence, screen = over_answer(shares, families)
    return Description(
        f"{plural(len(families), 'basin')} over {ends}, {_case(shares)}",
        [*screen, *facts],
        [
            Table("shares", _rows(shares)),
            Table("families", families),
            Table("", families, columns, "shares where the attractor exists", most=40),
        ],
        _notes(shares),
        sentence,
    )


def _block_words(shares: BasinShares) -> str:
    """Return the block in words, without a restitution that is the parameter."""
    parts = block_text(shares.block).split(", ")
    moved = shares.parameter == "restitution"
    return ", ".join(part for part in parts if not (moved and part.startswith("restitution")))


def _motion_words(shares: BasinShares) -> list[str]:
    """Return amplitude, frequency and phase in words, except the parameter."""
    motion = shares.motion
    words = {
        "amplitude": amplitude_text(shares.block, motion.amplitude),
        "frequency_ratio": frequency_text(shares.block, motion.frequency_ratio),
        PHASE: f"phase {number(motion.phase)} rad",
    }
    return [text for key, text in words.items() if key != shares.parameter]


def _case(shares: BasinShares) -> str:
    """Return what stays the same in a few words: amplitude, frequency, restitution, model."""
    motion, bare = shares.motion, shares.block.dimensionless()
    left, right = bare.restitution, getattr(bare, "negative_restitution", None)
    ratios = f"{left:.6g}" if right is None or right == left else f"{left:.4g}/{right:.4g}"
    words = {
        "amplitude": f"A = {motion.amplitude:.6g}",
        "frequency_ratio": f"Ω = {motion.frequency_ratio:.6g}",
        "restitution": f"restitution {ratios}",
    }
    phrases = [text for key, text in words.items() if key != shares.parameter]
    return ", ".join([*phrases, f"{shares.model.name} model"])


def _rows(shares: BasinShares) -> list[dict[str, object]]:
    """Return one row per family and value at which it exists."""
    low, high = shares.intervals()
    rows = []
    for place, value in enumerate(shares.values.tolist()):
        for family in shares.families:
            attractor = family.attractors[place]
            if attractor is None:
                continue
            orbit = attractor.orbit
            rows.append(
                {
                    shares.parameter: value,
                    "label": family.label,
                    "name": family.name,
                    "share": float(shares.share[family.label, place]),
                    "low": float(low[family.label, place]),
                    "high": float(high[family.label, place]),
                    "states": int(shares.states[family.label, place]),
                    "kind": str(attractor.kind.value),
                    "period": attractor.period,
                    "impacts": attractor.impacts,
                    "highest": None if orbit is None else orbit.highest,
                    "lowest": None if orbit is None else orbit.lowest,
                }
            )
    return rows


def _family_rows(basin_shares: BasinShares) -> list[Row]:
    """Return one row per family."""
    rows: list[Row] = []
    for family in basin_shares.families:
        where = family.present
        shares, values = basin_shares.share[family.label, where], basin_shares.values[where]
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


def _notes(shares: BasinShares) -> list[str]:
    """Return what a reader should know of these shares."""
    notes = []
    if any((shares.states[family.label][family.present] == 0).any() for family in shares.families):
        notes.append(
            "Share 0: no state of the window goes there, the motion at a neighbouring value does."
        )
    if any(family.typical.kind is AttractorKind.APERIODIC for family in shares.families):
        notes.append(
            f"Aperiodic: not settled within {shares.max_cycles} periods, and neighbours part. All "
            "such motions are one basin."
        )
    if shares.undecided:
        notes.append("States are undecided: they balance for ever, or take more periods to follow.")
    return notes


def over_answer(shares: BasinShares, families: Sequence[Row]) -> tuple[str, list[Fact]]:
    """Return how the shares of basins change over a parameter.

    Parameters
    ----------
    shares
        The shares.
    families
        Its basins, as in JSON.
    """
    symbol = SYMBOLS.get(shares.parameter, shares.parameter).replace("Ω", "W")
    over = f"{symbol} {number(float(shares.values[0]))} to {number(float(shares.values[-1]))}"
    falls = [each for each in families if each["name"] == AttractorKind.OVERTURNED.value]
    sentence = f"None of these starts falls over {over}"
    if falls:
        values = len(shares.values)
        at = "" if falls[0]["values"] == values else f" at {falls[0]['values']} of {values} values"
        sentence = f"Over {over}, {_range(falls[0])} of these starts fall{at}"
    if shares.undecided > FEW:
        sentence = f"Undecided: {sentence[0].lower()}{sentence[1:]}"
    ranked = sorted(
        (each for each in families if each not in falls), key=lambda each: -each["most"]
    )
    rows = []
    for each in ranked[:MOST_BASINS]:
        where = "" if each["values"] == len(shares.values) else _where(each, symbol)
        typical = shares.families[each["label"]].typical
        does, further = basin_name(typical.kind, typical.period, each["name"])
        rows.append(line(does, ", ".join([_range(each), *[further] * bool(further)]) + where))
    left = len(ranked) - len(rows)
    facts = [
        *rows,
        left_out(left, "smaller basins"),
        line("starts", f"{shares.label[0].size:,} at each: {ends_text(shares)}"),
        line("computed", f"{shares.model.name}; at most {shares.max_cycles} periods"),
    ]
    return f"{solved_text(sentence, shares.block)}.", facts


def _where(family: Row, symbol: str) -> str:
    """Return between which values a family is met."""
    first, last = number(family["from"], 4), number(family["to"], 4)
    return f", at {symbol} {first}" + ("" if first == last else f" to {last}")


def _range(family: Row) -> str:
    """Return the least and the largest share of a family."""
    least, most = chance(family["least"]), chance(family["most"])
    if not family["least"] and family["most"]:
        return f"none to {most}"
    return most if least == most else f"{least.removesuffix(' %')} to {most}"


def shares_dataset(shares: BasinShares) -> "xarray.Dataset":
    """Return shares as a labelled dataset."""
    import xarray

    name = shares.parameter
    low, high = shares.intervals()
    along = ("family", name)

    def of_orbits(attribute: str, missing: float) -> list[list[float]]:
        return [
            [missing if orbit is None else getattr(orbit, attribute) for orbit in family.orbits]
            for family in shares.families
        ]

    flags = {
        "flag_values": list(range(len(shares.families))),
        "flag_meanings": " ".join(family.name for family in shares.families),
    }
    kept = {"amplitude", "frequency_ratio", PHASE} - {name}
    plane = (name, "velocity", "angle")
    return xarray.Dataset(
        {
            "share": (along, shares.share, {"units": "1"}),
            "low": (along, low, {"units": "1", "confidence": CONFIDENCE}),
            "high": (along, high, {"units": "1", "confidence": CONFIDENCE}),
            "states": (along, shares.states),
            "present": (along, np.array([family.present for family in shares.families])),
            "period": (along, np.array(of_orbits("period", 0), dtype=np.int64)),
            "highest": (along, np.array(of_orbits("highest", np.nan)), {"units": "1"}),
            "lowest": (along, np.array(of_orbits("lowest", np.nan)), {"units": "1"}),
            "label": (plane, shares.label, {"long_name": "family", "units": "1", **flags}),
        },
        coords={
            "family": ("family", [family.name for family in shares.families]),
            name: (name, shares.values, dict(zip(("units", "long_name"), AXES[name], strict=True))),
            **coordinates_of(shares, "angle", "velocity", units="1"),
        },
        attrs={
            **{key: getattr(shares.motion, key) for key in sorted(kept)},
            **{
                key: value
                for key, value in attributes_of(shares.block, shares.model).items()
                if name != "restitution" or "restitution" not in key
            },
            "max_cycles": shares.max_cycles,
            "seed": "none" if shares.seed is None else str(shares.seed),
            "distance": shares.matching.distance,
            "threshold": shares.matching.threshold,
        },
    )


@describes(BasinFamily)
def describe_family(family: BasinFamily) -> Description:
    """Return the name, the kinds and the periods, and the number of values where it exists."""
    count = int(family.present.sum())
    kinds = sorted(
        {str(attractor.kind.value) for attractor in family.attractors if attractor is not None}
    )
    facts = [
        Fact("label", family.label, "label"),
        Fact("name", family.name, "name"),
        Fact("kinds", kinds, "kinds"),
        Fact("periods", list(family.periods), "forcing periods"),
        Fact("values", count, "values", f"{count} of {len(family.attractors)}"),
    ]
    return Description(f"{family.name}, at {count} of {len(family.attractors)} values", facts)
