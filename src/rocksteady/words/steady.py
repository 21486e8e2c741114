"""Words of symmetric steady states: of states, one orbit, response curves and regions."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Final, NotRequired, TypedDict

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.dynamics.steady.regions import BOUNDARIES, REGIONS, RegionBoundaries, RegionMap
from rocksteady.dynamics.steady.response import ResponseCurve
from rocksteady.dynamics.steady.states import BRANCHES, SteadyOrbit, SteadyStates
from rocksteady.dynamics.steady.verdicts import (
    BEYOND,
    MULTIPLIERS,
    multipliers_text,
    multipliers_value,
    verdict,
)
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.facts import (
    AnyBlock,
    amplitude_text,
    block_text,
    block_values,
    case_text,
    frequency_text,
    lean_text,
    peak_unit,
    solved_text,
    tilt_text,
)
from rocksteady.model.motions.segments import Harmonic
from rocksteady.results.description import Column, Description, Fact, Table, line, shown
from rocksteady.results.numbers import angle, number, plural, quantity
from rocksteady.results.result import describes

if TYPE_CHECKING:
    import xarray


SI: Final = ("accel_g", "freq_hz")
"""Values of a point of a block with a size."""


class Solution(TypedDict):
    """A solution at a point, as in JSON; None where it is not known."""

    branch: int
    kind: str
    phase: float
    velocity: float
    velocity_tau: float
    peak: float | None
    extrema: int | None
    admissible: bool | None
    half_cycle_trace: float
    half_cycle_multipliers: list[complex] | None
    multipliers: list[complex] | None
    stable: bool | None
    neutral: bool | None
    peak_rad: NotRequired[float]


class Point(TypedDict, total=False):
    """A point of a grid, as in JSON: regions of the linear model, SI of a block with a size."""

    amplitude: float
    frequency_ratio: float
    restitution: float
    order: int
    region: int
    region_meaning: str
    boundaries: dict[str, float]
    solutions: list[Solution]
    block: dict[str, object]
    accel_g: float
    freq_hz: float
    closed_form: "Point"
    model: str


@describes(SteadyStates)
def describe_states(states: SteadyStates) -> Description:
    """Return both solutions at one point, or what there is along the axes."""
    return describe_point(states) if states.region.size == 1 else describe_grid(states)


def point_values(states: SteadyStates, index: tuple[int, ...]) -> Point:
    """Return the solutions at a point, in SI too where a block is known."""
    region, block, closed = int(states.region[index]), states.block, states.closed_form
    values: Point = {
        "amplitude": float(states.amplitude[index]),
        "frequency_ratio": float(states.frequency_ratio[index]),
        "restitution": float(states.restitution[index]),
        "order": int(states.order[index]),
    }
    if closed is None:
        names = ("existence", "kind", "sign")
        values |= {"region": region, "region_meaning": REGIONS[region]}
        values["boundaries"] = {name: float(getattr(states, name)[index]) for name in names}
    values["solutions"] = [
        _solution(states, (which, *index))
        for which in (0, 1)
        if not np.isnan(states.phase[which, *index])
    ]
    if block is not None:
        motion = Harmonic(amplitude=values["amplitude"], frequency_ratio=values["frequency_ratio"])
        values["block"] = block_values(block)
        values["accel_g"] = in_g(motion.acceleration_m_s2(block))
        values["freq_hz"] = motion.frequency_hz(block)
    if closed is not None:
        values["closed_form"] = {**point_values(closed, index), "model": closed.model.name}
    return values


def _solution(states: SteadyStates, at: tuple[int, ...]) -> Solution:
    """Return one of the two solutions at a point; without shapes less is known."""
    solution: Solution = {
        "branch": at[0] + 1,
        "kind": "in-phase" if states.in_phase[at] else "out-of-phase",
        "phase": float(states.phase[at]),
        "velocity": float(states.velocity[at]),
        "velocity_tau": float(states.velocity_tau[at]),
        "peak": None,
        "extrema": None,
        "admissible": None,
        "half_cycle_trace": float(states.trace[at]),
        "half_cycle_multipliers": multipliers_value(states.half_cycle_multipliers[at]),
        "multipliers": multipliers_value(states.multipliers[at]),
        "stable": None,
        "neutral": None,
    }
    if states.admissible is None or states.peak is None or states.extrema is None:
        return solution
    peak, admissible = float(states.peak[at]), bool(states.admissible[at])
    judged = admissible and solution["half_cycle_multipliers"] is not None
    solution |= {
        "peak": peak,
        "extrema": int(states.extrema[at]),
        "admissible": admissible,
        "stable": bool(states.stable[at]) if judged else None,
        "neutral": bool(states.neutral[at]) if judged else None,
    }
    if states.block is not None:
        solution["peak_rad"] = peak * states.block.alpha
    return solution


def solution_rows(states: SteadyStates) -> list[dict[str, object]]:
    """Return one row per solution, in the order of the points."""
    rows: list[dict[str, object]] = []
    for index in np.ndindex(states.region.shape):
        values = point_values(states, index)
        names = ("amplitude", "frequency_ratio", "restitution", "order", "region")
        shared = {name: value for name, value in values.items() if name in names}
        rows += [
            {
                **shared,
                "branch": each["branch"],
                "kind": each["kind"],
                "phase_rad": each["phase"],
                "velocity": each["velocity"],
                "velocity_tau": each["velocity_tau"],
                "peak": each["peak"],
                "extrema": each["extrema"],
                "admissible": each["admissible"],
                "stable": each["stable"],
                "half_cycle_trace": each["half_cycle_trace"],
            }
            for each in values["solutions"]
        ]
    return rows


def worth(solution: Solution) -> str:
    """Return the verdict on a solution in a word."""
    if solution["admissible"] is None:
        return "not known"
    return verdict(
        admissible=solution["admissible"], neutral=solution["neutral"], stable=solution["stable"]
    )


def describe_point(states: SteadyStates) -> Description:
    """Return the solutions at the only point of a grid, a column each."""
    values = point_values(states, (0,) * states.region.ndim)
    block, model = states.block, states.model.name
    place = f"A = {values['amplitude']:.6g}, Ω = {values['frequency_ratio']:.6g}"
    closed = values.get("closed_form", values)
    existence, kind, sign = map(number, closed["boundaries"].values())
    region = f"{closed['region']}: {closed['region_meaning']}"
    bounds = f"existence {existence} (eq 23), kind {kind} (eq 25), sign {sign} (eq 24)"
    words = {
        "region": ("region", region),
        "boundaries": ("boundaries in A", bounds),
        "closed_form": ("closed form", f"region {region}; {bounds}"),
    }
    if block is not None:
        amplitude = amplitude_text(block, values["amplitude"])
        frequency = frequency_text(block, values["frequency_ratio"])
        place = f"{amplitude}, {frequency}"
        words |= {
            "block": ("block", block_text(block)),
            "accel_g": ("amplitude", amplitude),
            "freq_hz": ("frequency", frequency),
        }
    rows = [
        {"label": label, **{str(s["branch"]): text(s) for s in values["solutions"]}}
        for label, text in (
            ("verdict", worth),
            ("kind", lambda s: s["kind"]),
            ("phase (rad)", lambda s: number(s["phase"])),
            ("velocity du/d(pt)", lambda s: number(s["velocity"])),
            ("velocity du/d(omega t)", lambda s: number(s["velocity_tau"])),
            ("peak u", lambda s: shown(s["peak"])),
            *(
                [("peak", lambda s: lean_text(block, s["peak"]) if s["peak"] else "—")]
                if block is not None
                else []
            ),
            ("extrema in the half cycle", lambda s: str(s["extrema"])),
            (MULTIPLIERS, lambda s: multipliers_text(s["multipliers"])),
        )
    ]
    columns = [Column("label", "", left=True)]
    columns += [Column(str(k), f"branch {k}", left=True) for k in (1, 2)]
    sentence, screen = point_answer(
        values, block or DimensionlessBlock(restitution=values["restitution"])
    )
    return Description(
        f"Symmetric steady states: {place}, restitution {values['restitution']:.6g}, "
        f"n = {values['order']}, {model} model",
        [
            *screen,
            *(Fact(key, value, *words.get(key, ())) for key, value in values.items()),
            Fact("model", model),
        ],
        [Table("", rows if values["solutions"] else (), columns)],
        sentence=sentence,
    )


def describe_grid(states: SteadyStates) -> Description:
    """Return what there is along the axes of a grid."""
    points = [point_values(states, index) for index in np.ndindex(states.region.shape)]
    existing = sum(bool(point["solutions"]) for point in points)
    facts = [Fact("", label="points", text=f"{states.region.size:,}, {existing:,} with solutions")]
    if states.admissible is not None:
        for which in (0, 1):
            admissible, stable = (
                int(each[which].sum()) for each in (states.admissible, states.stable)
            )
            text = f"{admissible:,} admissible, {stable:,} stable"
            facts.append(Fact("", label=f"branch {which + 1}", text=text))
    facts.append(Fact("model", states.model.name, "model"))
    orders = sorted({int(n) for n in states.order.ravel()})
    over = (
        f"A {span(states.amplitude)}, Ω {span(states.frequency_ratio)}, "
        f"restitution {span(states.restitution)}, n = {', '.join(map(str, orders))}"
    )
    headline = f"Symmetric steady states at {plural(len(points), 'point')}: {over}, "
    solved = states.admissible is not None
    sentence, screen = grid_answer(states, points) if solved else ("", [])
    return Description(
        f"{headline}{states.model.name} model",
        [*screen, *facts],
        [Table("points", points)],
        ["plot response curves of one branch with compute_response_curve"],
        sentence,
    )


def point_answer(values: Point, block: AnyBlock) -> tuple[str, list[Fact]]:
    """Return whether a block can rock steadily at a point.

    Parameters
    ----------
    values
        Values of the point, as in JSON.
    block
        The block, without its own restitution where it has no size.
    """
    closed = values.get("closed_form", values)
    full = closed is not values
    limits = {key: peak_unit(block, value) for key, value in closed["boundaries"].items()}
    solved, beside = "linear (exact)", []
    if full:
        solved, beside = (
            "full equations",
            [line("closed form", _closed_form(closed, block, limits))],
        )
    order = values["order"]
    name = "" if order == 1 else f" in a period-{order} motion"
    if not values["solutions"]:
        why = (
            "the full equations have none" if full else f"that needs {limits['existence']} or more"
        )
        sentence = f"It cannot rock steadily{name}: {why}."
        return sentence, [*beside, line("computed", solved_text(solved, block))]
    best, second = _ordered(values["solutions"])
    kind = best["kind"].replace("-", " ")
    words, peak = worth(best), best["peak"]
    sentence = f"It cannot rock steadily{name}: both solutions pass through the base."
    if best["admissible"] and peak is not None:
        joined = "and that is" if words == "stable" else "but that is"
        joined = "but that" if words == "grazes" else joined
        tilt = tilt_text(block, peak)
        shown = solved_text(f"at {tilt}, {kind}", block)
        sentence = f"It can rock steadily{name} {shown}, {joined} {words}."
    period = plural(order, "period") if order > 1 else "a period"
    impacts = f"2 in {period}" if order > 1 else f"2 {period}"
    speed = f"du/d(pt) {number(best['velocity'])} after each"
    if isinstance(block, Block):
        impacts += f" ({quantity(order / values['freq_hz'], 's')})"
        speed = f"{angle(abs(best['velocity']) * block.alpha * block.p)}/s after each"
    beyond = BEYOND if best["admissible"] and peak is not None and peak > 1.0 else ""
    beyond = beyond.partition(":")[0] if full else beyond
    exists = f"from {limits['existence']} up; a second branch up to {limits['sign']} at most"
    return (
        sentence,
        [
            line("beyond alpha", beyond),
            line("impacts", f"{impacts}, {speed}" if best["admissible"] else ""),
            line("other branch", _other(second, block)),
            *(beside or [line("exists", "" if beyond else exists)]),
            line("computed", f"{solved}; multipliers {multipliers_text(best['multipliers'])}"),
        ],
    )


def _ordered(solutions: Sequence[Solution]) -> list[Solution]:
    """Return the solutions, a stable motion first, then any motion."""
    return sorted(solutions, key=lambda each: (not each["stable"], not each["admissible"]))


def _closed_form(values: Point, block: AnyBlock, limits: dict[str, str]) -> str:
    """Return what the linear model has at a point of the full equations."""
    if not values["solutions"]:
        return f"none below {limits['existence']} (linear)"
    best, _ = _ordered(values["solutions"])
    kind = best["kind"].replace("-", " ")
    return f"at {_tilt(best, block)}, {kind}, {worth(best)} (linear)"


def _other(solution: Solution, block: AnyBlock) -> str:
    """Return what the second solution is worth."""
    kind = solution["kind"].replace("-", " ")
    if not solution["admissible"]:
        return f"{kind}: passes through the base, so not possible"
    return f"{kind}: {_tilt(solution, block)}, {worth(solution)}"


def _tilt(solution: Solution, block: AnyBlock) -> str:
    """Return how far a solution tilts."""
    return "—" if solution["peak"] is None else tilt_text(block, solution["peak"])


def grid_answer(states: SteadyStates, points: Sequence[Point]) -> tuple[str, list[Fact]]:
    """Return at how many points of a grid there is a stable symmetric motion.

    Parameters
    ----------
    states
        The states.
    points
        Values of its points.
    """
    block, count = states.block, len(points)
    solved = "linear (exact)" if states.closed_form is None else "full equations"
    solutions = [each for point in points for each in point["solutions"]]
    motions = sum(bool(each["admissible"]) for each in solutions)
    peaks = [each["peak"] for each in solutions if each["stable"] and each["peak"] is not None]
    stable = sum(any(each["stable"] for each in point["solutions"]) for point in points)
    nowhere = sum(not point["solutions"] for point in points)
    tilts = ""
    if peaks:
        scale, unit = (math.degrees(block.alpha), "°") if block else (1.0, "alpha")
        tilts = f"{span([scale * peak for peak in peaks], unit)}" + (
            "; beyond alpha too" if max(peaks) > 1.0 else ""
        )
    over = f"A {span(states.amplitude)}, W {span(states.frequency_ratio)}"
    over += f", restitution {span(states.restitution)}"
    if block:
        accel_g, freq_hz = ([point[name] for point in points] for name in SI)
        over = f"{span(accel_g, 'g')}, {span(freq_hz, 'Hz')}"
    orders = sorted({point["order"] for point in points})
    over += "" if orders == [1] else f", n = {', '.join(map(str, orders))}"
    unstable = f"{motions - len(peaks):,} of {plural(motions, 'motion')}"
    sentence = f"A stable symmetric motion is possible at {stable:,} of {count:,} points."
    if not stable:
        sentence = f"No stable symmetric motion is possible at any of {plural(count, 'point')}."
    return (
        sentence,
        [
            line("tilt", tilts),
            line("unstable", unstable if motions else ""),
            line("no motion", f"at {plural(nowhere, 'point')}" if nowhere else ""),
            line("over", over),
            line("computed", solved_text(solved, block)),
        ],
    )


def span(values: ArrayLike, unit: str = "") -> str:
    """Return the ends of an array with their unit."""
    flat = np.ravel(np.asarray(values, dtype=float))
    low, high = (float(np.nanmin(flat)), float(np.nanmax(flat))) if flat.size else (math.nan,) * 2
    words = number(low) if low == high else f"{number(low)} to {number(high)}"
    return f"{words}{'' if unit in ('', '°') else ' '}{unit}"


def steady_dataset(states: SteadyStates) -> "xarray.Dataset":
    """Return everything over branch and grid, as `SteadyStates.to_dataset` states."""
    import xarray

    dims = tuple(f"grid_{axis}" for axis in range(states.region.ndim))
    units = {"phase": "rad"}
    variables: dict[str, object] = {}
    for name in ("amplitude", "frequency_ratio", "restitution", "order"):
        variables[name] = (dims, getattr(states, name), {"units": "1"})
    meanings = " ".join(f"region_{number}" for number in REGIONS)
    flags = {"flag_values": list(REGIONS), "flag_meanings": meanings, "units": "1"}
    descriptions = "; ".join(f"{number}: {text}" for number, text in REGIONS.items())
    variables["region"] = (dims, states.region, {**flags, "description": descriptions})
    for name in ("existence", "sign", "kind"):
        variables[f"{name}_amplitude"] = (dims, getattr(states, name), {"units": "1"})
    names = ["phase", "velocity", "velocity_tau", "trace", "in_phase"]
    if states.admissible is not None:
        names += ["peak", "extrema", "admissible", "stable", "neutral"]
    for name in names:
        attributes = {"units": units.get(name, "1")}
        variables[name] = (("branch", *dims), getattr(states, name), attributes)
    attributes = {"model": states.model.name}
    return xarray.Dataset(variables, {"branch": list(BRANCHES)}, attributes)


@describes(SteadyOrbit)
def describe_orbit(orbit: SteadyOrbit) -> Description:
    """Return which steady state it is, and its extremes."""
    given = {
        name: getattr(orbit, name)
        for name in ("amplitude", "frequency_ratio", "restitution", "order", "branch")
    }
    peak = float(np.abs(orbit.angle).max())
    return Description(
        f"Steady state, branch {orbit.branch}: A = {orbit.amplitude:.6g}, "
        f"Ω = {orbit.frequency_ratio:.6g}, restitution {orbit.restitution:.6g}, "
        f"n = {orbit.order}, {orbit.model.name} model",
        [
            *(Fact(name, value) for name, value in given.items()),
            Fact("samples", len(orbit.tau), "samples"),
            Fact("peak", peak, "largest angle", quantity(peak, "alpha")),
            Fact("model", orbit.model.name, "model"),
        ],
    )


@describes(ResponseCurve)
def describe_curve(curve: ResponseCurve) -> Description:
    """Return the case, the range of the curve, and its largest peak."""
    amplitude = float(curve.states.amplitude.flat[0])
    order = int(curve.states.order.flat[0])
    ends = float(curve.frequency_ratio.min()), float(curve.frequency_ratio.max())
    low, high = (frequency_text(curve.block, end) for end in ends)
    facts = [
        Fact("", label="block", text=block_text(curve.block)),
        Fact("amplitude", amplitude, "amplitude", amplitude_text(curve.block, amplitude)),
        Fact("order", order),
        Fact("branch", curve.branch),
        Fact("", label="frequencies", text=f"{len(curve.peak):,}: {low} to {high}"),
    ]
    if np.isfinite(curve.peak).any():
        at = int(np.nanargmax(curve.peak))
        text = f"{lean_text(curve.block, float(curve.peak[at]))} at "
        text += frequency_text(curve.block, float(curve.frequency_ratio[at]))
        facts.append(Fact("", label="highest peak", text=text))
    stable = int(curve.stable.sum())
    facts += [Fact("", label="stable", text=f"at {stable:,} of them")]
    facts += [Fact("model", curve.model.name, "model")]
    rows = [
        {"frequency_ratio": ratio, "peak": peak, "stable": stable}
        for ratio, peak, stable in zip(
            curve.frequency_ratio.tolist(), curve.peak.tolist(), curve.stable.tolist(), strict=True
        )
    ]
    if curve.frequency_hz is not None:
        for row, hertz in zip(rows, curve.frequency_hz.tolist(), strict=True):
            row["freq_hz"] = hertz
    headline = f"Response curve, branch {curve.branch}, n = {order}: A = {number(amplitude)}, "
    return Description(
        f"{headline}{case_text(curve.block)}, {curve.model.name} model",
        facts,
        [Table("curve", rows)],
    )


@describes(RegionBoundaries)
def describe_boundaries(boundaries: RegionBoundaries) -> Description:
    """Return the ranges of the inputs and of the amplitudes."""
    return _curves("Boundaries of the regions", boundaries, BOUNDARIES)


@describes(RegionMap)
def describe_regions(regions: RegionMap) -> Description:
    """Return the ranges of the frequency ratio and of the curves."""
    names = (*BOUNDARIES, "symmetry_breaking", "heteroclinic")
    return _curves("Regions of steady states", regions, names)


def _curves(what: str, curves: RegionBoundaries | RegionMap, names: Sequence[str]) -> Description:
    """Return curves as lists for JSON, as rows, and by their ends for people."""

    def fact(name: str) -> Fact:
        values = np.asarray(getattr(curves, name))
        if not values.size:
            return Fact(name, values.tolist(), name.replace("_", " "), "none")
        low, high = float(np.nanmin(values)), float(np.nanmax(values))
        text = number(low) if low == high else f"{number(low)} to {number(high)}"
        return Fact(name, values.tolist(), name.replace("_", " "), text)

    given = [fact(name) for name in ("frequency_ratio", "restitution", "order")]
    headline = f"{what}: Ω {given[0].words}, restitution {given[1].words}, n = {given[2].words}"
    facts = [*given, *map(fact, names)]
    columns = np.broadcast_arrays(*(np.asarray(each.value) for each in facts))
    keys = [each.key for each in facts]
    points = zip(*(column.ravel().tolist() for column in columns), strict=True)
    rows = [dict(zip(keys, point, strict=True)) for point in points]
    return Description(
        f"{headline}, linear model",
        [*facts, Fact("model", "linear", "model")],
        [Table("", rows)],
        ["The curves are A = a/(alpha g)."],
    )
