"""Facts of steady states, for texts, JSON and tables."""

from typing import Any

import numpy as np

from rocksteady.dynamics.steady.regions import REGIONS
from rocksteady.dynamics.steady.steady_answers import grid_answer, point_answer, span
from rocksteady.dynamics.steady.verdicts import (
    MULTIPLIERS,
    multipliers_text,
    multipliers_value,
    verdict,
)
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.facts import (
    amplitude_text,
    block_text,
    block_values,
    frequency_text,
    lean_text,
)
from rocksteady.model.motions.segments import Harmonic
from rocksteady.results.description import Column, Description, Fact, Table, shown
from rocksteady.results.numbers import number, plural

# The classes that use this module are named Any: to import them would close a circle.


def point_values(states: Any, index: tuple[int, ...]) -> dict[str, Any]:
    """Return the solutions at a point, in SI too where a block is known."""
    region, block, closed = int(states.region[index]), states.block, states.closed_form
    values: dict[str, Any] = {
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


def _solution(states: Any, at: tuple[int, ...]) -> dict[str, Any]:
    """Return one of the two solutions at a point; without shapes less is known."""
    solution: dict[str, Any] = {
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
    admissible = bool(states.admissible[at])
    judged = admissible and solution["half_cycle_multipliers"] is not None
    solution |= {
        "peak": float(states.peak[at]),
        "extrema": int(states.extrema[at]),
        "admissible": admissible,
        "stable": bool(states.stable[at]) if judged else None,
        "neutral": bool(states.neutral[at]) if judged else None,
    }
    if states.block is not None:
        solution["peak_rad"] = solution["peak"] * states.block.alpha
    return solution


def solution_rows(states: Any) -> list[dict[str, Any]]:
    """Return one row per solution, in the order of the points."""
    rows: list[dict[str, Any]] = []
    for index in np.ndindex(states.region.shape):
        values = point_values(states, index)
        names = ("amplitude", "frequency_ratio", "restitution", "order", "region")
        shared = {name: values[name] for name in names if name in values}
        rows += [
            {
                **shared,
                "branch": solution["branch"],
                "kind": solution["kind"],
                "phase_rad": solution["phase"],
                **{name: solution[name] for name in ("velocity", "velocity_tau", "peak")},
                **{name: solution[name] for name in ("extrema", "admissible", "stable")},
                "half_cycle_trace": solution["half_cycle_trace"],
            }
            for solution in values["solutions"]
        ]
    return rows


def worth(solution: dict[str, Any]) -> str:
    """Return the verdict on a solution in a word; empty where it is not known."""
    if solution["admissible"] is None:
        return "not known"
    return verdict(**{name: solution[name] for name in ("admissible", "neutral", "stable")})


def describe_point(states: Any) -> Description:
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
    return Description(
        f"Symmetric steady states: {place}, restitution {values['restitution']:.6g}, "
        f"n = {values['order']}, {model} model",
        [
            *(Fact(key, value, *words.get(key, ())) for key, value in values.items()),
            Fact("model", model),
        ],
        [Table("", rows if values["solutions"] else (), columns)],
        answer=point_answer(values, block or DimensionlessBlock(restitution=values["restitution"])),
    )


def describe_grid(states: Any) -> Description:
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
    return Description(
        f"{headline}{states.model.name} model",
        facts,
        [Table("points", points)],
        ["plot response curves of one branch with compute_response_curve"],
        grid_answer(states, points) if states.admissible is not None else None,
    )
