"""Facts of orbits, attractors and sweeps, for texts, JSON and tables."""

import math
from collections.abc import Sequence
from typing import Any

from rocksteady.dynamics.history.start import ImpactState, Rest, Start, Steady
from rocksteady.dynamics.steady.verdicts import (
    MULTIPLIERS,
    multipliers_text,
    multipliers_value,
    verdict,
)
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.equations import Model
from rocksteady.model.facts import AnyBlock, block_text, case_text, harmonic_values, lean_text
from rocksteady.model.motions.fourier import FourierSeries, PeriodicMotion
from rocksteady.results.description import Column, Fact, Table
from rocksteady.results.numbers import number, plural, quantity

# The classes that use this module are named Any: to import them would close a circle.


def motion_text(block: AnyBlock, motion: PeriodicMotion) -> str:
    """Return a periodic motion: in g and Hz where the block has a size."""
    orders = ""
    if isinstance(motion, FourierSeries):
        orders = f", orders {', '.join(str(order) for order in motion.orders)}"
    if not isinstance(block, Block):
        ratio = number(motion.frequency_ratio, 4)
        return f"A = {number(motion.amplitude, 4)}, Ω = {ratio}{orders}"
    accel_g = in_g(motion.acceleration_m_s2(block))
    return f"{quantity(accel_g, 'g')} at {quantity(motion.frequency_hz(block), 'Hz')}{orders}"


def where(block: AnyBlock, motion: PeriodicMotion, model: Model) -> str:
    """Return what moves and by what, for a headline."""
    return f"{motion_text(block, motion)}, {case_text(block)}, {model.name} model"


def case_facts(block: AnyBlock, motion: PeriodicMotion, model: Model) -> list[Fact]:
    """Return the facts of what moves, by what and in which model."""
    values = harmonic_values(block, motion)
    text = motion_text(block, motion)
    if isinstance(block, Block):
        ratio = number(motion.frequency_ratio, 4)
        text += f" (A = {number(motion.amplitude, 4)}, Ω = {ratio})"
    key = "block" if "block" in values else ""
    return [
        Fact(key, values.pop("block", None), "block", block_text(block)),
        Fact("", label="motion", text=text),
        *(Fact(key, value) for key, value in values.items()),
        Fact("model", model.name, "model"),
    ]


def start_text(start: Start) -> str:
    """Return a start in a word, as `--start` takes it where it can."""
    if isinstance(start, Rest):
        return "rest"
    if isinstance(start, Steady):
        return "steady" if start.branch == 1 else "steady:2"
    if isinstance(start, ImpactState):
        return f"impact at {number(start.phase)} rad"
    return f"{start.angle:.12g},{start.velocity:.12g}"


def state_rows(states: Sequence[ImpactState]) -> list[dict[str, Any]]:
    """Return states after impacts in plain values."""
    return [{"side": each.side, "phase": each.phase, "speed": each.speed} for each in states]


def section_row(state: ImpactState) -> dict[str, Any]:
    """Return the row of a state after an impact."""
    return {"side": state.side, "phase_rad": state.phase, "speed_per_pivot_time": state.speed}


def plain_orbit(orbit: Any, block: AnyBlock, motion: PeriodicMotion) -> dict[str, Any]:
    """Return an orbit of a block in plain values, in SI too where the block has a size."""
    peaks = [orbit.highest, orbit.lowest] if orbit.admissible else None
    values: dict[str, Any] = {
        "kind": orbit.kind,
        "period": orbit.period,
        "impacts_per_period": orbit.impacts,
        "rest_phases": orbit.rest_phases,
        "peaks": peaks,
        "multipliers": multipliers_value(orbit.multipliers),
        "lyapunov": orbit.lyapunov,
        "residual": orbit.residual,
        "states": state_rows(orbit.states),
    }
    if isinstance(block, Block):
        values["peaks_rad"] = None if peaks is None else [peak * block.alpha for peak in peaks]
        values["period_s"] = orbit.period / motion.frequency_hz(block)
    return values


def orbit_values(orbit: Any) -> dict[str, Any]:
    """Return an orbit in plain values, with its branch and its stability."""
    values = plain_orbit(orbit, orbit.block, orbit.motion)
    # What passes through the floor has multipliers, and no stability.
    judged = orbit.admissible and values["multipliers"] is not None
    return {
        **values,
        "branch": orbit.branch,
        "admissible": orbit.admissible,
        "stable": orbit.stable if judged else None,
        "neutral": orbit.neutral if judged else None,
    }


def worth(orbit: Any) -> str:
    """Return whether an orbit is a motion and stable, in a word."""
    values = orbit_values(orbit)
    return verdict(**{name: values[name] for name in ("admissible", "neutral", "stable")})


def kind_text(kind: str, period: int | None) -> str:
    """Return the kind of a motion and its period, of period 1 the kind alone."""
    return f"{kind}, period {period}" if period is not None and period > 1 else kind


def orbit_facts(orbit: Any) -> list[Fact]:
    """Return what people read of an orbit; the values are those of `orbit_values`."""
    values, block = orbit_values(orbit), orbit.block
    period = "1 forcing period"
    if orbit.period > 1:
        period = f"{orbit.period} forcing periods, subharmonic"
    if "period_s" in values:
        period += f", {quantity(values['period_s'], 's')}"
    impacts = "infinitely many in a period"
    if orbit.impacts is not None:
        impacts = f"{orbit.impacts} in a period"
    words = {
        "period": ("period", period),
        "impacts_per_period": ("impacts", impacts),
        "multipliers": (MULTIPLIERS, multipliers_text(orbit.multipliers)),
    }
    if orbit.rest_phases:
        words["rest_phases"] = ("comes to rest", plural(orbit.rest_phases, "time") + " in a period")
    if orbit.branch is not None:
        words["branch"] = ("branch", str(orbit.branch))
    facts = [Fact(key, value, *words.get(key, ())) for key, value in values.items()]
    peaks = peak_facts(values["peaks"], block)
    at = next(k for k, fact in enumerate(facts) if fact.key == "multipliers")
    return [*facts[:at], *peaks, *facts[at:]]


def peak_facts(peaks: Sequence[float] | None, block: AnyBlock) -> list[Fact]:
    """Return the extremes of a motion for people, in degrees first where the block has a size."""
    return [
        Fact("", label=label, text=lean_text(block, peak))
        for label, peak in zip(("highest", "lowest"), peaks or (), strict=False)
    ]


def orbit_row(number_of: int, orbit: Any) -> dict[str, Any]:
    """Return the row of an orbit in a table: infinitely many impacts are None."""
    first, second = (complex(m) for m in orbit.multipliers)
    begin, values = orbit.states[0], orbit_values(orbit)
    highest, lowest = values["peaks"] or (None, None)
    row: dict[str, Any] = {
        "number": number_of,
        "period": orbit.period,
        "impacts_per_period": orbit.impacts,
        **{name: values[name] for name in ("rest_phases", "kind", "branch")},
        **{name: values[name] for name in ("admissible", "stable", "neutral")},
        "highest": highest,
        "lowest": lowest,
        "multiplier_1_re": first.real,
        "multiplier_1_im": first.imag,
        "multiplier_2_re": second.real,
        "multiplier_2_im": second.imag,
        "residual": orbit.residual,
        "side": begin.side,
        "phase_rad": begin.phase,
        "speed_per_pivot_time": begin.speed,
    }
    if isinstance(orbit.block, Block):
        row["highest_rad"], row["lowest_rad"] = values["peaks_rad"] or (None, None)
    return row


def angle_columns(block: AnyBlock) -> list[Column]:
    """Return the columns of the extremes of motions: degrees where the block has a size."""
    if isinstance(block, Block):
        alpha = block.alpha

        def degrees(u: float | None) -> str:
            return "—" if u is None or math.isnan(u) else f"{math.degrees(u * alpha):.2f}°"

        return [Column("highest", "highest", degrees), Column("lowest", "lowest", degrees)]

    def plain(u: float | None) -> str:
        return "—" if u is None or math.isnan(u) else f"{u:.4f}"

    return [Column("highest", "highest", plain), Column("lowest", "lowest", plain)]


def orbits_table(orbits: Sequence[Any], *, most: int = 200) -> Table:
    """Return a table of orbits: for people, and as rows of a file."""
    if not orbits:
        return Table("", ())
    words = {k: (worth(orbit), orbit) for k, orbit in enumerate(orbits, start=1)}

    def kind(k: int) -> str:
        orbit = words[k][1]
        return orbit.kind if orbit.branch is None else f"{orbit.kind} {orbit.branch}"

    columns = [
        Column("number", "#"),
        Column("period", "period"),
        Column("impacts_per_period", "impacts", lambda n: "inf" if n is None else str(n)),
        Column("number", "kind", kind, left=True),
        Column("number", "", lambda k: words[k][0], left=True),
        *angle_columns(orbits[0].block),
        Column("number", "multipliers", lambda k: multipliers_text(words[k][1].multipliers), True),
    ]
    rows = [orbit_row(k, orbit) for k, orbit in enumerate(orbits, start=1)]
    return Table("", rows, columns, most=most, kind=lambda row: words[row["number"]][0])
