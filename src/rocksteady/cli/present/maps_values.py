"""Maps as plain values and as terminal tables: number of cells of each kind."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from rocksteady.cli.console import terminal
from rocksteady.cli.flags.map_axes import RESIZED, MapCase
from rocksteady.cli.present.shared import block_text, restitution_text, shaking_values
from rocksteady.dynamics.parameters import SIZES

if TYPE_CHECKING:
    import xarray

    from rocksteady.cli.console.progress import Meter

SLAB = 4_000_000
"""Cells that are read from a store at once."""
AMPLITUDE = {"amplitude": "amplitude", "acceleration_m_s2": "accel_g"}
FREQUENCY = {"frequency_ratio": "frequency_ratio", "frequency_hz": "freq_hz"}
"""Names of the contract, by the parameters that they are."""
LEANER = frozenset({"width", "height", "alpha"})
"""What moves alpha, by which amplitudes are measured; `RESIZED` moves p, for frequencies."""


def map_values(case: MapCase, found: "xarray.Dataset", meter: "Meter") -> dict[str, Any]:
    """Return what the contract promises of a map, in plain values."""
    counts, longer = _counted(found)
    subharmonic = (
        {}
        if longer is None
        else {"subharmonic": sum(longer.values()), "subharmonic_counts": longer}
    )
    return {
        "counts": counts,
        **subharmonic,
        "cells": case.cells,
        "computed": int(found["met"].sum()) if "met" in found else meter.computed,
        "seconds": meter.seconds,
        "axes": {
            name: {"start": values[0], "stop": values[-1], "count": len(values)}
            for name, values in case.axes.items()
        },
        **case_values(case),
    }


def _counted(found: "xarray.Dataset") -> tuple[dict[str, int], dict[str, int] | None]:
    """Return how many cells there are of each kind, and how many of these are subharmonic.

    Of fates, which have no periods, None.
    """
    import numpy as np

    fates = "fate" in found
    names = ("fate",) if fates else ("kind", "period")
    flags = found[names[0]].attrs
    words = dict(zip(flags["flag_values"].tolist(), flags["flag_meanings"].split(), strict=True))
    counts = dict.fromkeys(words.values(), 0)
    longer = dict.fromkeys(counts, 0)
    for kind, *period in slabs(found, *names):
        for code, word in words.items():
            counts[word] += int(np.count_nonzero(kind == code))
            for one in period:
                longer[word] += int(np.count_nonzero((kind == code) & (one > 1)))
    return counts, None if fates else {word: count for word, count in longer.items() if count}


def case_values(case: MapCase) -> dict[str, Any]:
    """Return block, shaking and start; None for what is an axis or moves with one."""
    values = shaking_values(case.body, case.shaking)
    values |= case.start.values(case.shaking.phase)
    axes = set(case.axes)
    moving = set(axes)
    for names, sizes in ((AMPLITUDE, LEANER), (FREQUENCY, RESIZED)):
        if axes & names.keys():
            moving |= set(names.values())
        elif axes & sizes:  # what was given stays, and moves in the other measure
            moving |= {word for name, word in names.items() if name not in case.fixed}
    if axes & set(SIZES):
        values["block"] = None
        moving |= {"restitution"} if case.housner else set()
    if "restitution" in axes:  # of both impacts
        moving |= {"negative_restitution"}
    if moving & {"velocity", "angle"}:
        values["start"] = None
    return values | dict.fromkeys(moving & values.keys())


def slabs(found: "xarray.Dataset", *names: str) -> Iterator[tuple[Any, ...]]:
    """Yield the values of variables in parts that fit into memory."""
    first = str(found[names[0]].dims[0])
    rows = max(1, SLAB * found.sizes[first] // found[names[0]].size)
    for row in range(0, found.sizes[first], rows):
        part = found.isel({first: slice(row, row + rows)})
        yield tuple(part[name].values for name in names)


def title_of(case: MapCase, cycles: int | None, model: str) -> str:
    """Return what is no axis in a few words; `cycles` are those after which a fate is seen."""
    values = case_values(case)
    parts = []
    for name, symbol, in_si, unit in (
        ("amplitude", "A", "accel_g", "g"),
        ("frequency_ratio", "Ω", "freq_hz", "Hz"),
    ):
        if values[name] is not None:
            parts.append(f"{symbol} = {values[name]:g}")
        elif values.get(in_si) is not None:
            parts.append(f"{values[in_si]:g} {unit}")
    if values["restitution"] is not None:
        parts.append(restitution_text(values))
    elif case.housner:
        parts.append("Housner's restitution")
    block = values.get("block")
    if block is not None:
        parts.append(block_text(block))
    if values["start"] is not None:
        parts.append(f"from {values['start']}")
    if values["phase"]:
        parts.append(f"phase {values['phase']:.4g} rad")
    if model == "nonlinear":
        parts.append("nonlinear model")
    asked = "What the block settles to" if cycles is None else f"The block after {cycles} periods"
    return f"{asked}: " + ", ".join(parts)


def class_counts(values: dict[str, Any]) -> dict[str, int]:
    """Return how many cells there are of each class of a picture, in the order of its legend.

    Subharmonic motions are a class of their own there, whatever their kind.
    """
    longer = values.get("subharmonic_counts", {})
    found: dict[str, int] = {}
    for kind, count in values["counts"].items():
        if kind == "aperiodic" and longer:
            found["subharmonic"] = sum(longer.values())
        found[kind] = count - longer.get(kind, 0)
    return found


def print_counts(values: dict[str, Any]) -> None:
    """Print one row a kind, in 80 characters."""
    from rich.table import Table

    console = terminal.console()
    axes = " x ".join(f"{axis['count']} {name}" for name, axis in values["axes"].items())
    console.print(f"{values['cells']:,} cells: {axes}")
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    first = "kind" if "subharmonic" in values else "fate"
    for heading in (first, "cells", "share"):
        table.add_column(heading, justify="left" if heading == first else "right", no_wrap=True)
    for kind, count in class_counts(values).items():
        if count:
            table.add_row(kind, f"{count:,}", f"{100.0 * count / values['cells']:.2f} %")
    console.print(table)
    if values.get("subharmonic"):
        parts = [f"{count:,} {kind}" for kind, count in values["subharmonic_counts"].items()]
        console.print(f"subharmonic: of period 2 or longer, {', '.join(parts)}", style="dim")
    rate = values["computed"] / values["seconds"] if values["seconds"] else 0.0
    place = f", kept in {values['store']}" if values["store"] else ""
    console.print(
        f"{values['computed']:,} cells computed in {values['seconds']:.2f} s, {rate:,.0f} a second"
        f"{place}",
        style="dim",
    )
