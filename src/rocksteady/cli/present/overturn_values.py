"""Output of `rocksteady overturn`: values, table, rows."""

from typing import TYPE_CHECKING, Any

from rocksteady.cli.console import terminal
from rocksteady.cli.present.shared import block_text, block_values, restitution_values
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.motions.segments import Harmonic

if TYPE_CHECKING:
    from rocksteady.dynamics.overturning.windows import OverturningWindows


def overturn_values(
    found: "OverturningWindows", body: Block | DimensionlessBlock
) -> dict[str, Any]:
    """Return what the contract promises; in SI too where the block has a size."""
    from rocksteady.dynamics.overturning.thresholds import THRESHOLDS, overturning_threshold

    shape = found.pulse.shape
    closed = None
    if shape in THRESHOLDS and found.model.name == "linear":
        closed = overturning_threshold(shape, found.frequency_ratio).tolist()
    values: dict[str, Any] = {
        "model": found.model.name,
        "pulse": shape,
        "oscillations": found.pulse.oscillations,
        "phase": found.pulse.phase,
        **restitution_values(body),
        "amplitudes": list(found.amplitudes),
        "resolution": found.resolution,
    }
    unit = None
    if isinstance(body, Block):
        values["block"] = block_values(body)
        unit = body.uplift_acceleration / body.gravity
    windows = []
    for index, ratio in enumerate(found.frequency_ratio.tolist()):
        intervals = found.intervals(index)
        row: dict[str, Any] = {"frequency_ratio": ratio}
        if isinstance(body, Block):
            row["freq_hz"] = Harmonic(amplitude=1.0, frequency_ratio=ratio).frequency_hz(body)
        row["intervals"] = [list(ends) for ends in intervals]
        if unit is not None:
            row["intervals_g"] = [[end * unit for end in ends] for ends in intervals]
        row["modes"] = [
            {
                "interval": [window.low, window.high],
                "impacts": window.impacts,
                "side": window.side,
                "endless": window.endless,
            }
            for window in found.at(index)
        ]
        row["first"] = float(found.first[index])
        row["closed_form"] = None if closed is None else closed[index]
        row["left_out"] = int(found.left_out[index])
        row["left_out_width"] = float(found.left_out_width[index])
        row["undecided"] = int(found.undecided[index])
        row["unsettled"] = int(found.unsettled[index])
        windows.append(row)
    return values | {"windows": windows}


def window_rows(values: dict[str, Any]) -> list[dict[str, object]]:
    """Return a row a window."""
    rows: list[dict[str, object]] = []
    for row in values["windows"]:
        head = {name: row[name] for name in ("frequency_ratio", "freq_hz") if name in row}
        for mode in row["modes"]:
            low, high = mode["interval"]
            ways = {name: mode[name] for name in ("impacts", "side", "endless")}
            rows.append({**head, "low": low, "high": high, **ways})
    return rows


def title_of(values: dict[str, Any]) -> str:
    """Return pulse, block and model in a few words."""
    ratios = (values.get(name) for name in ("restitution", "negative_restitution"))
    delta = " and ".join(f"{ratio:.4g}" for ratio in ratios if ratio is not None)
    parts = [f"{values['pulse']} pulse", f"restitution {delta}"]
    if "block" in values:
        parts.append(block_text(values["block"]))
    if values["model"] == "nonlinear":
        parts.append("nonlinear")
    return "Overturning: " + ", ".join(parts)


def print_windows(values: dict[str, Any]) -> None:
    """Print one row a window, in 80 characters."""
    from rich.table import Table

    console = terminal.console()
    low, high = values["amplitudes"]
    console.print(f"{title_of(values)}\nsearched from {low:.6g} to {high:.6g} alpha g")
    sized = "block" in values
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    headings = ["omega/p", *(["Hz"] if sized else []), "from a/(alpha g)", "to", "impacts", "side"]
    for heading in headings:
        table.add_column(heading, justify="right", no_wrap=True)
    for row in values["windows"]:
        head = [f"{row['frequency_ratio']:.6g}", *([f"{row['freq_hz']:.5g}"] if sized else [])]
        for mode in row["modes"]:
            first, last = mode["interval"]
            table.add_row(
                *head,
                f"{first:.8g}",
                "the end" if mode["endless"] else f"{last:.8g}",
                str(mode["impacts"]),
                "+" if mode["side"] > 0 else "-",
            )
            head = [""] * len(head)
        if not row["modes"]:
            table.add_row(*head, "stands", "", "", "")
    console.print(table)
    left_out = sum(row["left_out"] for row in values["windows"])
    if left_out:
        width = max(row["left_out_width"] for row in values["windows"])
        console.print(
            f"{left_out} narrower windows are left out, at no frequency more than {width:.2g} wide "
            "together.",
            style="dim",
        )
    unsettled = sum(row["unsettled"] > 0 for row in values["windows"])
    if unsettled:
        console.print(
            f"At {unsettled} of the frequencies there are so many windows that the search was "
            "ended before all of them.",
            style="dim",
        )
