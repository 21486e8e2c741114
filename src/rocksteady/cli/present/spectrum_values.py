"""Output of `rocksteady spectrum`: values and table."""

import math
from collections.abc import Sequence
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocksteady.cli.console import terminal
from rocksteady.cli.present.shared import plural
from rocksteady.outcomes import Status
from rocksteady.show.style.palette import shortened

if TYPE_CHECKING:
    import xarray

ROWS, COLUMNS, SUITE_COLUMNS = 24, 5, 4
"""Of the table on the terminal; of more sizes and slendernesses some are picked."""
FALLS = "falls"


def spectrum_values(
    found: "xarray.Dataset", summary: "xarray.Dataset | None", files: Sequence[Path]
) -> dict[str, Any]:
    """Return what the contract promises: a row a block and record.

    Parameters
    ----------
    found
        Over record, alpha and period.
    summary
        Of a suite; None of one record.
    files
        Of the records.
    """
    status = found["status"].values
    counts = {word.label: int((status == word).sum()) for word in Status}
    values: dict[str, Any] = {
        "model": found.attrs["model"],
        "restitution": found.attrs["restitution"],
        "gravity_m_s2": found.attrs["gravity"],
        "records": [
            {"name": name, "file": str(file)}
            for name, file in zip(found["record"].values.tolist(), files, strict=True)
        ],
        "scale": float(found["scale"]),
        "reversed": found.attrs["direction"] == "reversed",
        "vertical": None if found.attrs["vertical"] == "none" else found.attrs["vertical"],
        "cells": int(status.size),
        "counts": counts,
        "values": _rows(found),
    }
    if summary is not None:
        values["quantiles"] = summary["quantile"].values.tolist()
        values["suite"] = _suite_rows(summary)
    return values


def _rows(found: "xarray.Dataset") -> list[dict[str, Any]]:
    """Return a row for each cell."""
    over = ("record", "alpha", "period")
    names = ("status", "peak_angle", "peak_velocity", "impacts")
    columns = [found[name].transpose(*over).values.ravel().tolist() for name in names]
    blocks = product(
        found["record"].values.tolist(),
        found["alpha"].values.tolist(),
        zip(found["period"].values.tolist(), found["p"].values.tolist(), strict=True),
    )
    return [
        {
            "record": record,
            "alpha_rad": alpha,
            "period_s": period,
            "p_rad_s": p,
            "status": Status(status).label,
            "peak": angle,
            "peak_rad": angle * alpha,
            "peak_velocity": velocity,
            "peak_velocity_rad_s": velocity * alpha * p,
            "impacts": impacts,
        }
        for (record, alpha, (period, p)), status, angle, velocity, impacts in zip(
            blocks, *columns, strict=True
        )
    ]


def _suite_rows(summary: "xarray.Dataset") -> list[dict[str, Any]]:
    """Return a row for each block, with a peak for each quantile."""
    over = ("alpha", "period")
    peaks = [
        summary[name].transpose(*over, "quantile").values.reshape(-1, 3).tolist()
        for name in ("peak_angle", "peak_velocity")
    ]
    shares = summary["overturned"].transpose(*over).values.ravel().tolist()
    blocks = product(summary["alpha"].values.tolist(), summary["period"].values.tolist())
    return [
        {
            "alpha_rad": alpha,
            "period_s": period,
            "overturned": share,
            "peaks": angles,
            "peak_velocities": velocities,
        }
        for (alpha, period), share, angles, velocities in zip(blocks, shares, *peaks, strict=True)
    ]


def title_of(values: dict[str, Any]) -> str:
    """Return what shakes which blocks, in a few words."""
    records = values["records"]
    one = len(records) == 1
    parts = [shortened(records[0]["name"]) if one else plural(len(records), "record")]
    if values["vertical"] is not None:
        parts[0] += " and vertical"
    if values["scale"] != 1.0:
        parts.append(f"scaled by {values['scale']:.4g}")
    if values["reversed"]:
        parts.append("reversed")
    ratio = values["restitution"]
    parts.append("Housner's restitution" if ratio == "housner" else f"restitution {ratio:.4g}")
    parts.append(values["model"])
    return "Rocking spectrum: " + ", ".join(parts)


def print_spectrum(
    values: dict[str, Any],
    found: "xarray.Dataset",
    summary: "xarray.Dataset | None",
    *,
    degrees: bool,
) -> None:
    """Print a row a size and a column a slenderness, in 80 characters; these in degrees or not."""
    from rich.table import Table

    console = terminal.console()
    console.print(title_of(values))
    said = "largest |theta|/alpha"
    if summary is not None:
        said = f"median of the {said}, and the share of records that overturn"
    console.print(said, style="dim")
    alphas = _picked(found.sizes["alpha"], COLUMNS if summary is None else SUITE_COLUMNS)
    periods = _picked(found.sizes["period"], ROWS)
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column("2 pi/p [s]", justify="right", no_wrap=True)
    for alpha in found["alpha"].values[alphas].tolist():
        heading = f"{math.degrees(alpha):.4g}°" if degrees else f"{alpha:.4g} rad"
        table.add_column(heading, justify="right", no_wrap=True)
    for row in periods:
        cells = [
            _peak_text(found.isel(record=0, alpha=column, period=row))
            if summary is None
            else _suite_text(summary.isel(alpha=column, period=row))
            for column in alphas
        ]
        table.add_row(f"{float(found['period'][row]):.5g}", *cells)
    console.print(table)
    shown = len(alphas) * len(periods)
    whole = found.sizes["alpha"] * found.sizes["period"]
    if shown < whole:
        console.print(f"{shown} of {whole:,} blocks; --csv and --json have them all", style="dim")
    fell = values["counts"]["overturned"]
    console.print(
        f"{values['cells']:,} motions in {values['seconds']:.2f} s, {fell:,} overturn"
        + (f", kept in {values['store']}" if values["store"] else ""),
        style="dim",
    )


def _picked(count: int, most: int) -> list[int]:
    """Return which of many are shown, evenly, the first and the last included."""
    if count <= most:
        return list(range(count))
    return [round(k * (count - 1) / (most - 1)) for k in range(most)]


def _peak_text(cell: "xarray.Dataset") -> str:
    """Return what a record does to a block."""
    status = Status(int(cell["status"]))
    if status in (Status.AT_REST, Status.ROCKING):
        return f"{float(cell['peak_angle']):.6g}"
    return FALLS if status is Status.OVERTURNED else status.label


def _suite_text(block: "xarray.Dataset") -> str:
    """Return what a suite does to a block."""
    median = float(block["peak_angle"][1])
    peak = FALLS if math.isinf(median) else f"{median:.4g}"
    return f"{peak}, {100.0 * float(block['overturned']):.3g} %"
