"""Basins and erosion as tables for a terminal."""

from typing import Any

from rocksteady.cli.console import terminal
from rocksteady.cli.present.basins_values import undecided
from rocksteady.cli.present.shared import case_text


def case_of(values: dict[str, Any]) -> str:
    """Return block and frequency in a few words."""
    return case_text({**values, "amplitude": 0.0}).replace("A = 0, ", "", 1)


def print_fractions(values: dict[str, Any]) -> None:
    """Print one row a basin, in 80 characters."""
    from rich.table import Table

    console = terminal.console()
    count = sum(fraction["states"] for fraction in values["fractions"])
    console.print(f"{case_text(values)}\n{count} states at phase {values['phase']:.6g} rad")
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    drawn = values["seed"] is not None  # no probability belongs to the middles of cells
    interval = (f"{100.0 * values['confidence']:g} % interval",) if drawn else ()
    for heading in ("basin", "share", *interval, "period", "lowest", "highest"):
        table.add_column(heading, justify="left" if heading == "basin" else "right", no_wrap=True)
    for fraction in values["fractions"]:
        orbit = fraction["orbit"]
        highest, lowest = ("", "") if orbit is None else (f"{u:.4f}" for u in orbit["peaks"])
        table.add_row(
            fraction["name"],
            f"{100.0 * fraction['share']:.2f} %",
            *([f"{100.0 * fraction['low']:.2f} to {100.0 * fraction['high']:.2f} %"] * drawn),
            str(fraction["period"] or ""),
            lowest,
            highest,
        )
    console.print(table)
    angles, velocities = values["angles"], values["velocities"]
    console.print(
        f"u = theta/alpha from {angles['start']:.4g} to {angles['stop']:.4g}, du/d(pt) from "
        f"{velocities['start']:.4g} to {velocities['stop']:.4g}.",
        style="dim",
    )
    if any(fraction["kind"] == "aperiodic" for fraction in values["fractions"]):
        console.print(
            f"Aperiodic: not settled within {values['cycles']} periods, and neighbours part. More\n"
            "--cycles tell chaos from a long way to something else.",
            style="dim",
        )
    if undecided(values) > 0.0:
        lossless = values["restitution"] == 1.0
        console.print(
            "Without loss (restitution 1) motions do not settle."
            if lossless
            else "States are undecided: they balance for ever, or take more --cycles to follow."
        )


def print_erosion(values: dict[str, Any]) -> None:
    """Print one row an amplitude, and what one looks for in them."""
    from rich.table import Table

    console = terminal.console()
    console.print(f"{case_of(values)}\nsafe basin at phase {values['phase']:.6g} rad")
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    sized = "heteroclinic_accel_g" in values
    in_g = ("accel [g]",) if sized else ()
    for heading in ("amplitude", *in_g, "integrity factor", "global integrity"):
        table.add_column(heading, justify="right", no_wrap=True)
    for row in values["erosion"]:
        accel = (f"{row['accel_g']:.6g}",) if sized else ()
        names = ("integrity_factor", "global_integrity")
        table.add_row(f"{row['amplitude']:.6g}", *accel, *(f"{row[name]:.4f}" for name in names))
    console.print(table)
    if values["heteroclinic_amplitude"] is None:
        console.print("heteroclinic tangency: no closed form in the nonlinear model")
    else:
        tangency = f"heteroclinic tangency at A = {values['heteroclinic_amplitude']:.6g}"
        if sized:
            tangency += f", {values['heteroclinic_accel_g']:.6g} g"
        console.print(tangency)
    for measure, drop in values["drop"].items():
        words = measure.replace("_", " ")
        if drop is None:
            console.print(f"{words} does not fall below 0.5")
        else:
            console.print(
                f"{words} falls below {drop['level']:g} between A = {drop['low']:.4f} and "
                f"{drop['high']:.4f}"
            )
    console.print(
        "Both are 1 on a still base: the radius of the largest safe circle and the\nsafe area.",
        style="dim",
    )
