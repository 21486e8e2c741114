"""What the checks of all walls come to, as plain values and in sentences."""

import math
from typing import Any

import numpy as np

from rocksteady.results.numbers import chance, number_or_none, plural
from rocksteady.studies.facade_checks._checked_walls import (
    METHODS,
    SHARE,
    CheckedWalls,
    Dynamics,
)
from rocksteady.studies.facade_checks._worked_walls import LONGER, WorkedWall

SLOWER = 1.15
"""Growth of S_D beyond T_SLV from which on it counts as a reason."""
CLASSES = {
    7: "all accept",
    6: "the dynamic check alone refuses",
    5: "the static check alone refuses",
    3: "the linear check alone refuses",
    4: "the linear check alone accepts",
    2: "the static check alone accepts",
    1: "the dynamic check alone accepts",
    0: "all refuse",
}
"""Combinations of verdicts, from all accept to all refuse."""


def percent(part: int, whole: int) -> str:
    r"""Return a share in per cent.

    Examples
    --------
    >>> percent(1, 8), percent(0, 8)
    ('12\xa0%', '0 of 8')
    """
    return chance(part / whole, whole).replace(" %", "\N{NO-BREAK SPACE}%")


def level_values(checked: CheckedWalls) -> list[dict[str, Any]]:
    """Return the share of each combination of verdicts at each level."""
    values = []
    for level, pga_g in enumerate(checked.plane.levels_g.tolist()):
        kinds = checked.classes[level]
        values.append(
            {
                "pga_g": pga_g,
                "agree": float(np.isin(kinds, (0, 7)).mean()),
                "shares": {words: float((kinds == kind).mean()) for kind, words in CLASSES.items()},
                "accepted": {
                    method: float((ratio[level] <= 1.0).mean())
                    for method, ratio in checked.ratios.items()
                },
            }
        )
    return values


def variant_values(checked: CheckedWalls) -> list[dict[str, Any]]:
    """Return what other equations and restitutions change at the middle level."""
    middle = checked.plane.middle
    base = checked.dynamics[0].ratio[middle]
    return [_variant(each, middle, base) for each in checked.dynamics]


def _variant(each: Dynamics, middle: int, base: Any) -> dict[str, Any]:
    """Return what equations and restitution of some runs come to at the middle level."""
    place = each.levels.index(middle)
    ratio, beyond = each.ratio[place], each.beyond[place]
    valid = np.isfinite(ratio) & np.isfinite(base) & (base > 0.0)
    return {
        "name": each.name,
        "accepted": float((ratio <= 1.0).mean()),
        "beyond_d0": float((beyond > 0).mean()),
        "newly_accepted": int(((ratio <= 1.0) & (base > 1.0)).sum()),
        "newly_refused": int(((ratio > 1.0) & (base <= 1.0)).sum()),
        "median_mean": float(np.median(ratio[valid] / base[valid])) if valid.any() else None,
        "undecided_runs": each.undecided,
    }


def worked_values(wall: WorkedWall) -> dict[str, Any]:
    """Return the numbers of a worked wall."""
    runs, mechanism = wall.runs, wall.check.mechanism
    facade = wall.check.facade
    return {
        "kind": wall.kind,
        "height_m": facade.height_m,
        "thickness_m": facade.thickness_m,
        "confidence_factor": facade.confidence_factor,
        "pga_g": float(runs.pga_g[0]),
        "records": list(runs.records),
        "demand_per_capacity": {name: number_or_none(each) for name, each in wall.ratios.items()},
        "beyond_d0": list(runs.beyond),
        "t_slv_s": mechanism.t_slv_s,
        "d_slv_m": mechanism.d_slv_m,
        "d0_m": mechanism.d0_m,
        "a0_g": mechanism.a0_g,
        "linear_g": mechanism.linear_g,
        "run_activation_g": mechanism.run_activation_g,
        "governing": runs.records[wall.governing],
        "direction": wall.direction,
        "spectral_m": float(wall.spectra_m[wall.governing]),
        "spectral_to_twice_m": wall.longer_m,
        "largest_m": number_or_none(float(runs.largest_m[wall.governing])),
        "impacts": len(wall.history.impacts.pt),
        "others": {name: number_or_none(each) for name, each in wall.others.items()},
    }


def sentences(checked: CheckedWalls) -> list[str]:
    """Return what the maps show."""
    kinds = checked.classes
    count = kinds.size
    agree = int(np.isin(kinds, (0, 7)).sum())
    walls = kinds[0].size
    levels = ", ".join(
        f"{percent(round(each['agree'] * walls), walls)} at {each['pga_g']:g} g"
        for each in level_values(checked)
    )
    texts = [
        f"The three checks agree on {percent(agree, count)} of {count} walls and levels ({levels})."
    ]
    static, dynamic = ((checked.ratios[name] <= 1.0) for name in METHODS[1:])
    linear = checked.linear <= 1.0
    texts.append(
        f"The dynamic check accepts {_count((dynamic & ~static).sum(), count)} that the nonlinear "
        f"static one refuses, and refuses {_count((static & ~dynamic).sum(), count)} that it "
        "accepts."
    )
    texts.append(
        f"The linear check refuses {_count((~linear & static & dynamic).sum(), count)} that both "
        f"others accept, and accepts {_count((linear & ~static & ~dynamic).sum(), count)} that "
        "both refuse."
    )
    refused = static & ~dynamic
    alone = int((refused & (checked.dynamics[0].beyond == 1)).sum())
    if refused.any():
        texts.append(
            f"Of the walls that the dynamic check refuses and the static one accepts, "
            f"{percent(alone, int(refused.sum()))} go beyond d₀ under one record of "
            f"{len(checked.plane.records)} alone."
        )
    return texts


def _count(number: Any, whole: int) -> str:
    """Return a number of walls with its share."""
    if not number:
        return "none"
    return f"{int(number)} ({percent(int(number), whole)})"


def reasons(wall: WorkedWall) -> list[str]:
    """Return why the checks of a worked wall disagree, in numbers."""
    runs, mechanism = wall.runs, wall.check.mechanism
    name, limit = runs.records[wall.governing], 1e3 * mechanism.d_slv_m
    shorter = 1e3 * float(wall.spectra_m[wall.governing])
    longer = 1e3 * wall.longer_m
    peak = 1e3 * float(runs.largest_m[wall.governing])
    impacts = len(wall.history.impacts.pt)
    twice = f"{LONGER:g} T_SLV"
    texts = []
    if wall.kind == "static refuses":
        texts.append(
            f"Under {name} an elastic oscillator with a period up to T_SLV = "
            f"{mechanism.t_slv_s:.2f} s reaches {shorter:.0f} mm; the wall reaches "
            f"{peak:.0f} mm of d_SLV = {limit:.0f} mm."
        )
        still = int((runs.share == 0.0).sum())
        texts.append(
            f"The wall moves from {mechanism.run_activation_g:.3f} g on and strikes what is behind "
            f"it {impacts} times in this run, losing velocity each time. It has no period of its "
            "own: cycles of the shaking do not add up as they do in an oscillator at resonance."
            + (f" In {still} of {runs.share.size} runs it does not lift." if still else "")
        )
    else:
        beyond = len(runs.beyond)
        texts.append(
            f"{beyond} of {len(runs.records)} records {'takes' if beyond == 1 else 'take'} the "
            f"wall beyond d₀, and without {'it' if beyond == 1 else 'them'} the mean would be "
            f"{_mean_of_rest(wall):.2f} of d_SLV: the static check takes a mean of spectra, in "
            "which no record counts for more than its ordinate, the dynamic one refuses for a "
            "single fall."
            if beyond
            else "No record takes the wall beyond d₀, but the mean exceeds d_SLV."
        )
        texts.append(
            f"Under {name} S_D is {shorter:.0f} mm at periods up to T_SLV = "
            f"{mechanism.t_slv_s:.2f} s, against d_SLV = {limit:.0f} mm, and {longer:.0f} mm up to "
            f"{twice}."
            + (
                " The farther a wall leans, the longer it takes to come back, without a limit, so "
                "that the slow part of the shaking, which T_SLV leaves out, still moves it."
                if longer > SLOWER * shorter
                else " The spectrum has no more for it at longer periods."
            )
            + f" The run ends after {plural(impacts, 'impact')}."
        )
    damped, lively = wall.others["nonlinear, e = 0"], wall.others["nonlinear, e = 0.8"]
    if wall.kind == "dynamic refuses" and damped <= 1.0:
        words = "velocity that it keeps from one return to the next"
        if lively <= 1.0:
            words = "the moment of its returns, which restitution shifts"
        texts.append(
            f"What brings it down is {words}: with restitution 0 the dynamic check "
            f"{_verdict(damped)}, with 0.8 it {_verdict(lively)}. No static check "
            "includes the returns."
        )
    else:
        texts.append(
            f"With restitution 0 the dynamic check {_verdict(damped)}, with 0.8 it "
            f"{_verdict(lively)}."
        )
    texts.append(
        "By the linear equations and Housner's restitution it "
        f"{_verdict(wall.others['linear, Housner'])}."
    )
    return texts


def _mean_of_rest(wall: WorkedWall) -> float:
    """Return the mean over d_SLV of the records without a run beyond d0."""
    share = wall.runs.share.max(axis=1)
    rest = share[share <= 1.0]
    return float(rest.mean()) / SHARE if len(rest) else math.nan


def _verdict(ratio: float) -> str:
    """Return a verdict with its demand over capacity."""
    if math.isinf(ratio):
        return "refuses it, with a run beyond d₀"
    return f"{'accepts' if ratio <= 1.0 else 'refuses'} it ({ratio:.2f} of d_SLV)"
