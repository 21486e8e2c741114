"""Branches, bifurcations, sweeps and cascades as plain values for JSON and rows for CSV."""

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from rocksteady.cli.flags.range import Range
from rocksteady.cli.flags.sweep_start import Sweep
from rocksteady.cli.present.shared import block_values
from rocksteady.model.blocks.block import Block

if TYPE_CHECKING:
    from rocksteady.dynamics.continuation.cascade import DoublingCascade
    from rocksteady.dynamics.continuation.points import Branch, BranchPoint

SAME_PLACE = 1e-7
"""Difference of the parameter, relative to its range, of one bifurcation on two branches."""
SAME_ANGLE = 1e-5
"""Difference of its highest angle."""
CSV_HEADER = (
    "branch",
    "type",
    "amplitude",
    "frequency_ratio",
    "restitution",
    "period",
    "impacts",
    "symmetric",
    "stable",
    "admissible",
    "multiplier_1_re",
    "multiplier_1_im",
    "multiplier_2_re",
    "multiplier_2_im",
    "highest",
    "lowest",
    "arclength",
)


def range_values(span: Range) -> dict[str, Any]:
    """Return what the contract promises of the axis; None for the value of what moves."""
    values: dict[str, Any] = {
        "parameter": span.parameter,
        "within": list(span.within),
        **span.fixed,
    }
    if isinstance(span.body, Block):
        values["block"] = block_values(span.body)
        values |= span.in_si(span.amplitude, span.frequency_ratio)
        alias = {"amplitude": "accel_g", "frequency_ratio": "freq_hz"}.get(span.parameter)
        if alias is None:
            values["block"]["restitution"] = None
        else:
            values[alias] = None
    return values


def lean(branch: "Branch") -> float:
    """Return -1 for a branch that leans to the negative side: its mirror image is listed, else 1.

    `rocksteady.find_orbits` lists the one that leans to the positive side too.
    """
    import numpy as np

    return 1.0 if np.nanmax(branch.peaks) >= -np.nanmin(branch.peaks) else -1.0


def extremes(point: "BranchPoint", sign: float) -> list[float]:
    """Return the highest and the lowest u = theta/alpha of an orbit, or of its mirror image."""
    peaks = sign * point.peaks
    return [float(peaks.max()), float(peaks.min())]


def point_values(point: "BranchPoint", sign: float, span: Range) -> dict[str, Any]:
    """Return what the contract promises for a bifurcation."""
    values: dict[str, Any] = {
        "type": point.type.value,
        "amplitude": point.amplitude,
        "frequency_ratio": point.frequency_ratio,
        "restitution": point.restitution,
        "period": point.period,
        "impacts": point.impacts,
        "symmetric": point.symmetric,
        "peaks": extremes(point, sign),
        "multipliers": [complex(m) for m in point.multipliers],
    }
    values |= span.in_si(point.amplitude, point.frequency_ratio)
    if isinstance(span.body, Block):
        values["peaks_rad"] = [peak * span.body.alpha for peak in values["peaks"]]
    return values


def bifurcation_values(branches: Sequence["Branch"], span: Range) -> list[dict[str, Any]]:
    """Return every bifurcation once, by the first of the branches that it lies on."""
    listed: list[dict[str, Any]] = []
    near = SAME_PLACE * (span.within[1] - span.within[0])
    for number, branch in enumerate(branches, start=1):
        sign = lean(branch)
        for point in branch.bifurcations:
            found = point_values(point, sign, span)
            for known in listed:
                if (
                    known["type"] == found["type"]
                    and abs(known[span.parameter] - found[span.parameter]) <= near
                    and abs(_size(known) - _size(found)) <= SAME_ANGLE
                ):
                    if number not in known["branches"]:
                        known["branches"].append(number)
                    break
            else:
                listed.append({"branch": number, "branches": [number], **found})
    return listed


def _size(values: dict[str, Any]) -> float:
    high, low = values["peaks"]
    return max(float(high), -float(low))


def branch_values(branches: Sequence["Branch"], span: Range) -> list[dict[str, Any]]:
    """Return a summary of each branch: what it is, its ends, and where it is stable."""
    listed = []
    for number, branch in enumerate(branches, start=1):
        ends = [
            {"type": point.type.value, span.parameter: getattr(point, span.parameter)}
            for point in (branch.points[0], branch.points[-1])
        ]
        stable = [
            sorted((float(branch.values[part.first]), float(branch.values[part.last])))
            for part in branch.stretches
            if part.stable
        ]
        listed.append(
            {
                "branch": number,
                "period": branch.period,
                "impacts": branch.impacts,
                "symmetric": branch.symmetric,
                "begin": ends[0],
                "end": ends[1],
                "within": [float(branch.values.min()), float(branch.values.max())],
                "stable_ranges": sorted(stable),
                "points": len(branch.points),
            }
        )
    return listed


def sweep_values(each: Sweep) -> dict[str, Any]:
    """Return what a sweep met, in runs of neighbouring values of one kind."""
    runs = []
    for first, last, found in each.trail.runs():
        orbit = found[0].orbit
        runs.append(
            {
                "from": first,
                "to": last,
                "values": len(found),
                "kind": found[0].kind.value,
                "period": found[0].period,
                "impacts_per_period": None if orbit is None else orbit.impacts,
            }
        )
    return {
        "direction": each.trail.direction,
        "start": each.start,
        "values": len(each.trail.values),
        "counts": dict(sorted(Counter(each.trail.kinds).items())),
        "runs": runs,
    }


def cascade_values(cascade: "DoublingCascade | None") -> dict[str, Any] | None:
    """Return the doublings of a cascade, their distances and ratios; None where there is none."""
    if cascade is None:
        return None
    return {
        "values": cascade.values.tolist(),
        "periods": [point.period for point in cascade.points],
        "distances": cascade.distances.tolist(),
        "ratios": cascade.ratios.tolist() if len(cascade.points) > 2 else [],
        "limit": cascade.limit,
    }


def csv_rows(branches: Sequence["Branch"], span: Range) -> Iterator[list[object]]:
    """Yield one row for each point of each branch."""
    for number, branch in enumerate(branches, start=1):
        sign = lean(branch)
        for point in branch.points:
            first, second = (complex(m) for m in point.multipliers)
            high, low = extremes(point, sign)
            row: list[object] = [
                number,
                point.type.value,
                *(point.amplitude, point.frequency_ratio, point.restitution),
                *(point.period, point.impacts, point.symmetric),
                *(point.stable, point.admissible),
                *(first.real, first.imag, second.real, second.imag),
                *(high, low, point.arclength),
            ]
            row += span.in_si(point.amplitude, point.frequency_ratio).values()
            if isinstance(span.body, Block):
                row += [high * span.body.alpha, low * span.body.alpha]
            yield row
