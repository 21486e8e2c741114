"""Output of `rocksteady simulate`: values, summary, rows."""

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from rocksteady.cli.console import terminal
from rocksteady.cli.present.shared import block_values, restitution_values, shaking_values
from rocksteady.model.blocks.block import STANDARD_GRAVITY, Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.motions.pulses import Pulse
from rocksteady.model.motions.segments import Harmonic, Motion

if TYPE_CHECKING:
    from rocksteady.dynamics.history.trajectory import Trajectory
    from rocksteady.model.motions.record import Record


def trajectory_values(trajectory: "Trajectory", body: Block | DimensionlessBlock) -> dict[str, Any]:
    """Return what the contract promises, in plain values."""
    from rocksteady.model.motions.record import Record

    motion, block = trajectory.motion, trajectory.block
    values: dict[str, Any] = {
        "model": trajectory.model.name,
        "status": trajectory.status.label,
        "peak": trajectory.peak,
        "impacts": len(trajectory.impacts),
        "flights": len(trajectory.rows),
        **restitution_values(body),
    }
    if not body.symmetric:
        values["side_peaks"] = list(trajectory.side_peaks)
    if isinstance(motion, Harmonic):
        values |= shaking_values(body, motion)
        values["phase"] = motion.phase
    elif isinstance(motion, Pulse):
        values |= {"pulse": motion.shape} | shaking_values(body, motion)
        values["duration_pt"] = motion.duration
        if isinstance(body, Block):
            values["duration_s"] = motion.duration / body.p
    elif isinstance(body, Block):
        if isinstance(motion, Record):
            values |= ground_values(motion, trajectory.vertical)
        values["block"] = block_values(body)
    if block is None:
        values["overturn_time_tau"] = trajectory.overturn_time_tau
        values["overturn_time_pt"] = trajectory.overturn_time_pt
        values["rest_time_pt"] = trajectory.rest_time_pt
    else:
        values["overturn_time_s"] = trajectory.overturn_time_s
        values["rest_time_s"] = trajectory.rest_time_s
        sides = zip(trajectory.side_peaks, (block.positive, block.negative), strict=True)
        # The larger angle may be the smaller part of its alpha.
        values["peak_rad"] = max(peak * side.alpha for peak, side in sides)
    return values


def ground_values(motion: "Record", vertical: "Motion | Record | None") -> dict[str, Any]:
    """Return what a recorded motion is, as the block felt it: scaled."""
    from rocksteady.model.motions.record import Record

    values: dict[str, Any] = {
        "record": motion.name,
        "npts": len(motion.acceleration_m_s2),
        "dt_s": motion.dt_s,
        "duration_s": motion.duration_s,
        "pga_g": motion.peak_acceleration_m_s2 / STANDARD_GRAVITY,
    }
    if isinstance(vertical, Record):
        values["vertical"] = vertical.name
        values["vertical_pga_g"] = vertical.peak_acceleration_m_s2 / STANDARD_GRAVITY
    return values


def print_summary(values: dict[str, Any], trajectory: "Trajectory") -> None:
    """Print how it ended, what that means, and the figures that people ask for first."""
    from rich.table import Table
    from rich.text import Text

    console = terminal.console()
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_row("status", Text(values["status"], style="bold"))
    peak = f"{values['peak']:.10g} alpha"
    if "side_peaks" in values:  # each in its own alpha
        left, right = values["side_peaks"]
        table.add_row("peak, left edge", f"{left:.10g} alpha")
        table.add_row("peak, right edge", f"{right:.10g} alpha")
        peak = f"{values['peak']:.10g} alpha of its side"
    if "peak_rad" in values and "side_peaks" not in values:
        peak += f" = {values['peak_rad']:.6g} rad"
    if trajectory.overturn_time_pt is not None:
        peak += ", up to overturning"
    table.add_row("peak", peak)
    table.add_row("impacts", str(values["impacts"]))
    if trajectory.overturn_time_pt is not None:
        table.add_row("overturns at", time_text(trajectory, trajectory.overturn_time_pt))
    if trajectory.rest_time_pt is not None:
        table.add_row("at rest from", time_text(trajectory, trajectory.rest_time_pt))
    for key in ("record_processing", "vertical_processing"):
        for note in values.get(key, ()):
            table.add_row(key.partition("_")[0], note)
    console.print(table)
    console.print(trajectory.status.advice, style="dim")


def time_text(trajectory: "Trajectory", s: float) -> str:
    """Return a pivot time in every unit that the run has."""
    parts = [f"pt = {s:.8g}"]
    if isinstance(trajectory.motion, Harmonic):
        tau = s * trajectory.motion.frequency_ratio
        parts.append(f"tau = {tau:.8g} ({tau / (2.0 * math.pi):.4f} periods)")
    if trajectory.block is not None:
        parts.append(f"{s / trajectory.block.p:.8g} s")
    return ", ".join(parts)


def csv_header(trajectory: "Trajectory") -> list[str]:
    """Return the columns of the time history."""
    header = ["pivot_time"]
    if isinstance(trajectory.motion, Harmonic):
        header.append("tau")
    header += ["angle_per_alpha", "velocity_per_pivot_time", "acceleration_per_pivot_time2"]
    header += ["base_acceleration_per_alpha_g", "energy"]
    if trajectory.block is not None:
        header += ["time_s", "angle_rad", "base_acceleration_m_s2"]
    if trajectory.vertical is not None:
        header.append("vertical_acceleration_m_s2")
    return header


def csv_rows(trajectory: "Trajectory", samples: int) -> Iterator[list[float]]:
    """Yield the time history row by row, the motion just after each impact included."""
    from rocksteady.dynamics.history.base_motion import lift

    motion = trajectory(trajectory.times(samples))
    columns = [motion.pt]
    if motion.tau is not None:
        columns.append(motion.tau)
    columns += [motion.angle, motion.velocity, motion.acceleration]
    columns += [motion.base_acceleration, motion.energy]
    if trajectory.block is not None and motion.t_s is not None:
        block = trajectory.block
        columns += [motion.t_s, motion.angle * block.alpha]
        columns.append(motion.base_acceleration * block.uplift_acceleration)
        if trajectory.vertical is not None:
            columns.append(lift(trajectory.segments, motion.pt) * block.gravity)
    for row in zip(*columns, strict=True):
        yield [float(value) for value in row]
