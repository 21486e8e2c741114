"""Words of fates under a base motion with noise."""

import math
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.dynamics.batch.finite import OUTPUTS
from rocksteady.dynamics.maps.noise_fates import AXES, NoiseFates
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.confidence import CONFIDENCE_TEXT
from rocksteady.model.facts import attributes_of, block_text, case_text
from rocksteady.model.motion_facts import motion_facts, motion_text
from rocksteady.outcomes import Status
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import CONFIDENCE, number, quantity
from rocksteady.results.result import describes

if TYPE_CHECKING:
    import xarray


@describes(NoiseFates)
def describe_fates(fates: NoiseFates) -> Description:
    """Return the shares that overturn, with their intervals, and the case."""
    block, noise = fates.block, fates.noise
    low, high = noise.band
    band, lasting = f"Omega {number(low)} to {number(high)}", f"pt {number(noise.duration)}"
    if isinstance(block, Block):
        hertz = [ratio * block.p / (2.0 * math.pi) for ratio in noise.band]
        band = f"{number(hertz[0])} to {quantity(hertz[1], 'Hz')} ({band})"
        lasting = f"{quantity(noise.duration / block.p, 's')} ({lasting})"
    facts = [
        Fact("block", block.to_dict(), "block", block_text(block)),
        Fact("motion", motion_text(fates.block, fates.motion), "base motion"),
        *motion_facts(block, fates.motion),
        Fact("noise_band", list(noise.band), "noise", f"{band}, {lasting}"),
        Fact("noise_rms", noise.rms),
        Fact("noise_duration_pt", noise.duration),
        Fact("seed", noise.seed, "seed", str(noise.seed)),
        Fact("draws", fates.draws, "realisations", f"{fates.draws:,} at each level"),
        Fact("model", fates.model.name, "model"),
        Fact("confidence", CONFIDENCE),
    ]
    ends = fates.interval()
    rows = []
    for (i, j), count in np.ndenumerate(fates.overturned):
        row = {
            "scale": float(fates.scale[i]),
            "level": float(fates.level[j]),
            "rms": float(fates.rms[j]),
            "overturned": int(count),
            "share": float(fates.share[i, j]),
            "low": float(ends[0][i, j]),
            "high": float(ends[1][i, j]),
            "median_peak": float(np.median(fates.peak[i, j])),
            "undecided": int(np.count_nonzero(fates.fate[i, j] == Status.UNDECIDED)),
            "lost_contact": int(np.count_nonzero(fates.fate[i, j] == Status.LOST_CONTACT)),
        }
        if isinstance(block, Block):
            row["rms_m_s2"] = row["rms"] * block.uplift_acceleration
        rows.append(row)
    shown = [
        *([Column("scale", "scale")] if len(fates.scale) > 1 else []),
        Column("rms", "rms [alpha g]"),
        *([Column("rms_m_s2", "rms [m/s²]")] if isinstance(block, Block) else []),
        Column("overturned", "overturned"),
        Column("share", "share", lambda share: f"{100.0 * share:.1f} %"),
        Column("between", CONFIDENCE_TEXT),
        Column("median_peak", "median peak"),
    ]
    read = [
        {**row, "between": f"{100.0 * row['low']:.1f} to {100.0 * row['high']:.1f} %"}
        for row in rows
    ]
    notes = [
        status.advice
        for status in (Status.LOST_CONTACT, Status.UNDECIDED)
        if (fates.fate == status).any()
    ]
    tables = [Table("shares", rows), Table("", read, shown, severity=lambda row: row["share"])]
    return Description(_headline(fates), facts, tables, notes)


def _headline(fates: NoiseFates) -> str:
    """Return what the fates are of, in a line."""
    words = f"{motion_text(fates.block, fates.motion)} with noise"
    return f"Overturning under {words}: {case_text(fates.block)}, {fates.model.name} model"


def fates_dataset(fates: NoiseFates) -> "xarray.Dataset":
    """Return fates and shares, as `NoiseFates.to_dataset` states."""
    import xarray

    cells, plane = ("scale", "level", "draw"), ("scale", "level")
    low, high = fates.interval()
    return xarray.Dataset(
        {
            **{each.name: (cells, getattr(fates, each.name), each.attributes) for each in OUTPUTS},
            "share": (plane, fates.share, {"long_name": "share that overturns", "units": "1"}),
            "share_low": (plane, low, {"units": "1"}),
            "share_high": (plane, high, {"units": "1"}),
        },
        coords={
            "scale": ("scale", fates.scale, {"long_name": AXES["scale"], "units": "1"}),
            "level": ("level", fates.level, {"long_name": AXES["level"], "units": "1"}),
            "rms": ("level", fates.rms, {"long_name": "rms over alpha g", "units": "1"}),
            "draw": ("draw", np.arange(fates.draws), {"long_name": "realisation of the noise"}),
        },
        attrs={
            "title": _headline(fates),
            **attributes_of(fates.block, fates.model),
            "noise_rms": fates.noise.rms,
            "noise_low": fates.noise.band[0],
            "noise_high": fates.noise.band[1],
            "noise_duration": fates.noise.duration,
            "seed": str(fates.noise.seed),
        },
    )
