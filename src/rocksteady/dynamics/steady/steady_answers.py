"""Answer of symmetric steady states: whether one is stable, how large, and from where on."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from rocksteady.dynamics.steady.verdicts import multipliers_text, verdict
from rocksteady.model.blocks.block import Block
from rocksteady.model.facts import AnyBlock, peak_unit, solved_text, tilt_text
from rocksteady.results.answer import Answer
from rocksteady.results.numbers import angle, number, plural, quantity

BEYOND = "the base carries it back: no fall"
"""Of a motion whose tilt exceeds alpha."""


def point_answer(values: dict[str, Any], block: AnyBlock) -> Answer:
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
        solved, beside = "full equations", [("closed form", _closed_form(closed, block, limits))]
    order = values["order"]
    name = "" if order == 1 else f" in a period-{order} motion"
    if not values["solutions"]:
        why = (
            "the full equations have none" if full else f"that needs {limits['existence']} or more"
        )
        sentence = f"It cannot rock steadily{name}: {why}."
        return Answer(sentence, [*beside, ("computed", solved_text(solved, block))])
    best, second = _ordered(values["solutions"])
    kind = best["kind"].replace("-", " ")
    words = verdict(**{key: best[key] for key in ("admissible", "neutral", "stable")})
    sentence = f"It cannot rock steadily{name}: both solutions pass through the base."
    if best["admissible"]:
        joined = "and that is" if words == "stable" else "but that is"
        joined = "but that" if words == "grazes" else joined
        tilt = tilt_text(block, best["peak"])
        shown = solved_text(f"at {tilt}, {kind}", block)
        sentence = f"It can rock steadily{name} {shown}, {joined} {words}."
    period = plural(order, "period") if order > 1 else "a period"
    impacts = f"2 in {period}" if order > 1 else f"2 {period}"
    speed = f"du/d(pt) {number(best['velocity'])} after each"
    if isinstance(block, Block):
        impacts += f" ({quantity(order / values['freq_hz'], 's')})"
        speed = f"{angle(abs(best['velocity']) * block.alpha * block.p)}/s after each"
    beyond = BEYOND if best["admissible"] and best["peak"] > 1.0 else ""
    beyond = beyond.partition(":")[0] if full else beyond
    exists = f"from {limits['existence']} up; a second branch up to {limits['sign']} at most"
    return Answer(
        sentence,
        [
            ("beyond alpha", beyond),
            ("impacts", f"{impacts}, {speed}" if best["admissible"] else ""),
            ("other branch", _other(second, block)),
            *(beside or [("exists", "" if beyond else exists)]),
            ("computed", f"{solved}; multipliers {multipliers_text(best['multipliers'])}"),
        ],
    )


def _ordered(solutions: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return the solutions, a stable motion first, then any motion."""
    return sorted(solutions, key=lambda each: (not each["stable"], not each["admissible"]))


def _closed_form(values: dict[str, Any], block: AnyBlock, limits: dict[str, str]) -> str:
    """Return what the linear model has at a point of the full equations."""
    if not values["solutions"]:
        return f"none below {limits['existence']} (linear)"
    best, _ = _ordered(values["solutions"])
    words = verdict(**{key: best[key] for key in ("admissible", "neutral", "stable")})
    kind = best["kind"].replace("-", " ")
    return f"at {tilt_text(block, best['peak'])}, {kind}, {words} (linear)"


def _other(solution: dict[str, Any], block: AnyBlock) -> str:
    """Return what the second solution is worth."""
    kind = solution["kind"].replace("-", " ")
    if not solution["admissible"]:
        return f"{kind}: passes through the base, so not possible"
    words = verdict(**{key: solution[key] for key in ("admissible", "neutral", "stable")})
    return f"{kind}: {tilt_text(block, solution['peak'])}, {words}"


def grid_answer(states: Any, points: Sequence[dict[str, Any]]) -> Answer:
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
    peaks = [each["peak"] for each in solutions if each["stable"]]
    stable = sum(any(each["stable"] for each in point["solutions"]) for point in points)
    nowhere = sum(not point["solutions"] for point in points)
    tilts = ""
    if peaks:
        scale, unit = (math.degrees(block.alpha), "°") if block else (1.0, "alpha")
        tilts = f"{span([scale * peak for peak in peaks], unit)}" + (
            "; beyond alpha too" if max(peaks) > 1.0 else ""
        )
    names = ("accel_g", "freq_hz") if block else ("amplitude", "frequency_ratio")
    ends = [[point[name] for point in points] for name in names]
    over = f"{span(ends[0], 'g')}, {span(ends[1], 'Hz')}"
    if not block:
        over = f"A {span(ends[0])}, W {span(ends[1])}, restitution {span(states.restitution)}"
    orders = sorted({point["order"] for point in points})
    over += "" if orders == [1] else f", n = {', '.join(map(str, orders))}"
    unstable = f"{motions - len(peaks):,} of {plural(motions, 'motion')}"
    sentence = f"A stable symmetric motion is possible at {stable:,} of {count:,} points."
    if not stable:
        sentence = f"No stable symmetric motion is possible at any of {plural(count, 'point')}."
    return Answer(
        sentence,
        [
            ("tilt", tilts),
            ("unstable", unstable if motions else ""),
            ("no motion", f"at {plural(nowhere, 'point')}" if nowhere else ""),
            ("over", over),
            ("computed", solved_text(solved, block)),
        ],
    )


def span(values: Any, unit: str = "") -> str:
    """Return the ends of an array with their unit."""
    flat = np.ravel(values)
    low, high = (float(np.nanmin(flat)), float(np.nanmax(flat))) if flat.size else (math.nan,) * 2
    words = number(low) if low == high else f"{number(low)} to {number(high)}"
    return f"{words}{'' if unit in ('', '°') else ' '}{unit}"
