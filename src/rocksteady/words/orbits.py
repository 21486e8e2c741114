"""Words of periodic orbits, single or found by a search."""

import math
from collections import Counter
from collections.abc import Sequence

from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.orbits.return_map import has_mirror_images
from rocksteady.dynamics.steady.verdicts import (
    BEYOND,
    MULTIPLIERS,
    Judgement,
    multipliers_text,
    multipliers_value,
    verdict,
)
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.equations import Model
from rocksteady.model.facts import (
    AnyBlock,
    block_text,
    case_text,
    harmonic_values,
    lean_text,
    solved_text,
)
from rocksteady.model.motions.fourier import FourierSeries, PeriodicMotion
from rocksteady.results.description import Column, Description, Fact, Table, aligned, left_out, line
from rocksteady.results.numbers import number, plural, quantity
from rocksteady.results.result import describes

MOST_ORBITS = 2
"""Orbits that an answer lists."""
VERDICTS = ("stable", "neutral", "grazes", "unstable", "inadmissible")
"""Verdicts on orbits, those of motions that last first."""


@describes(Orbit)
def describe_orbit(orbit: Orbit) -> Description:
    """Return period, impacts, extremes, multipliers and states of an orbit."""
    kind = kind_text(orbit.kind, orbit.period)
    headline = f"{worth(orbit).capitalize()} {kind} orbit: "
    headline += where(orbit.block, orbit.motion, orbit.model)
    return Description(
        headline, [*orbit_facts(orbit), *case_facts(orbit.block, orbit.motion, orbit.model)]
    )


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


def orbit_values(orbit: Orbit) -> dict[str, object]:
    """Return an orbit in plain values, with its branch and its stability."""
    values = plain_orbit(orbit, orbit.block, orbit.motion)
    return {**values, "branch": orbit.branch, **judgement_of(orbit)}


def judgement_of(orbit: Orbit) -> Judgement:
    """Return whether an orbit is a motion, and its stability; None where it has none."""
    # What passes through the floor has multipliers, and no stability.
    judged = orbit.admissible and multipliers_value(orbit.multipliers) is not None
    return {
        "admissible": orbit.admissible,
        "stable": orbit.stable if judged else None,
        "neutral": orbit.neutral if judged else None,
    }


def worth(orbit: Orbit) -> str:
    """Return whether an orbit is a motion and stable, in a word."""
    return verdict(**judgement_of(orbit))


def kind_text(kind: str, period: int | None) -> str:
    """Return the kind of a motion and its period, of period 1 the kind alone."""
    return f"{kind}, period {period}" if period is not None and period > 1 else kind


def orbit_facts(orbit: Orbit) -> list[Fact]:
    """Return what people read of an orbit; the values are those of `orbit_values`."""
    values, block = orbit_values(orbit), orbit.block
    period = "1 forcing period"
    if orbit.period > 1:
        period = f"{orbit.period} forcing periods"
    if isinstance(block, Block):
        period += f", {quantity(orbit.period / orbit.motion.frequency_hz(block), 's')}"
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
    peaks = peak_facts(peaks_of(orbit), block)
    at = next(k for k, fact in enumerate(facts) if fact.key == "multipliers")
    return [*facts[:at], *peaks, *facts[at:]]


def peak_facts(peaks: Sequence[float] | None, block: AnyBlock) -> list[Fact]:
    """Return the extremes of a motion, in degrees first where the block has a size."""
    return [
        Fact("", label=label, text=lean_text(block, peak))
        for label, peak in zip(("highest", "lowest"), peaks or (), strict=False)
    ]


def orbit_row(number_of: int, orbit: Orbit) -> dict[str, object]:
    """Return the row of an orbit in a table: infinitely many impacts are None."""
    first, second = (complex(m) for m in orbit.multipliers)
    begin, values = orbit.states[0], orbit_values(orbit)
    highest, lowest = peaks_of(orbit) or (None, None)
    row: dict[str, object] = {
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
        for name, peak in (("highest_rad", highest), ("lowest_rad", lowest)):
            row[name] = None if peak is None else peak * orbit.block.alpha
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


def orbits_table(orbits: Sequence[Orbit], *, most: int = 200) -> Table:
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


def describe_orbits(
    orbits: Sequence[Orbit],
    block: AnyBlock,
    motion: PeriodicMotion,
    model: Model,
    **limits: int,
) -> Description:
    """Describe the orbits that a search has found.

    Parameters
    ----------
    orbits, block, motion, model
        What was found, of what, by what and in which equations.
    limits
        max_period, max_impacts and seeds of the search.
    """
    motions = sum(orbit.admissible for orbit in orbits)
    stable = sum(orbit.stable for orbit in orbits)
    reach = f"up to {plural(limits['max_period'], 'period')} and "
    reach += plural(limits["max_impacts"], "impact")
    # A block whose sides differ has no mirror images.
    mirrors = has_mirror_images(block, motion)
    images = "; of two mirror images one is listed." if mirrors else "."
    seeds, reminder = limits["seeds"], "Multipliers are of a period."
    unit = "Angles are in units of alpha. " if isinstance(block, DimensionlessBlock) else ""
    count = f"{plural(motions, 'periodic motion')} {reach}, {stable} stable"
    if motions < len(orbits):
        count += f"; {plural(len(orbits) - motions, 'inadmissible solution')}"
    sentence, screen = orbits_answer(orbits, block, limits, mirrors=mirrors)
    return Description(
        f"Periodic motions: {where(block, motion, model)}",
        [
            *screen,
            Fact("orbits", [orbit_values(orbit) for orbit in orbits]),
            *(Fact(name, value) for name, value in limits.items()),
            *case_facts(block, motion, model),
            Fact("", label="found", text=count),
        ],
        [orbits_table(orbits)],
        [f"{unit}{reminder} A search from {seeds} x {seeds} states may miss motions{images}"],
        sentence,
    )


def orbits_answer(
    orbits: Sequence[Orbit],
    block: AnyBlock,
    limits: dict[str, int],
    *,
    mirrors: bool,
) -> tuple[str, list[Fact]]:
    """Return how many steady motions there are, and the stable ones.

    Parameters
    ----------
    orbits
        As found.
    block
        The block.
    limits
        max_period, max_impacts and seeds of the search.
    mirrors
        Whether motions have mirror images.
    """
    ranked = sorted(orbits, key=lambda orbit: VERDICTS.index(worth(orbit)))
    motions = sum(orbit.admissible for orbit in orbits)
    stable = sum(orbit.stable for orbit in orbits)
    reach = f"{plural(limits['max_period'], 'period')} and "
    reach += solved_text(plural(limits["max_impacts"], "impact"), block)
    if not motions:
        sentence = f"No steady motion was found up to {reach}."
    else:
        verb = "is" if stable < 2 else "are"
        count = f"{stable or 'None'} of {plural(motions, 'steady motion')} {verb} stable"
        sentence = f"{count}; found up to {reach}."
    unit = "" if isinstance(block, Block) else "[alpha]"
    head = (unit, "period", "impacts", "highest", "lowest", "multipliers")
    rows = [head, *(_row(orbits.index(orbit) + 1, orbit) for orbit in ranked[:MOST_ORBITS])]
    left = Counter(worth(orbit) for orbit in ranked[MOST_ORBITS:])
    kinds = ", ".join(f"{count:,} {word}" for word, count in left.items())
    reaching = sum(orbit.admissible and beyond_alpha(orbit) for orbit in orbits)
    images = "; mirror images are one" if mirrors else ""
    seeds = limits["seeds"]
    facts = [
        *(aligned(rows) if ranked else ()),
        left_out(sum(left.values()), kinds),
        line(
            "beyond alpha",
            f"{plural(reaching, 'motion')}: {BEYOND}" if reaching else "",
        ),
        line("searched", f"{seeds} x {seeds} starts may miss some{images}"),
    ]
    return sentence, facts


def _row(number_of: int, orbit: Orbit) -> tuple[str, ...]:
    """Return an orbit in words: its verdict and kind, then its numbers."""
    block = orbit.block

    def tilt(u: float) -> str:
        if math.isnan(u):
            return "—"
        return f"{math.degrees(u * block.alpha):.2f}°" if isinstance(block, Block) else f"{u:.3f}"

    return (
        f"{number_of} {worth(orbit)} {orbit.kind}",
        str(orbit.period),
        "inf" if orbit.impacts is None else str(orbit.impacts),
        tilt(orbit.highest),
        tilt(orbit.lowest),
        multipliers_text(orbit.multipliers),
    )


def peaks_of(orbit: Orbit) -> list[float] | None:
    """Return the extremes of an orbit; None where it is no motion."""
    return [orbit.highest, orbit.lowest] if orbit.admissible else None


def beyond_alpha(orbit: Orbit) -> bool:
    """Return whether a motion tilts beyond alpha."""
    return bool(max(orbit.highest, -orbit.lowest) > 1.0)


def plain_orbit(orbit: Orbit, block: AnyBlock, motion: PeriodicMotion) -> dict[str, object]:
    """Return an orbit of a block in plain values, in SI too where the block has a size."""
    peaks = peaks_of(orbit)
    values: dict[str, object] = {
        "kind": orbit.kind,
        "period": orbit.period,
        "impacts_per_period": orbit.impacts,
        "rest_phases": orbit.rest_phases,
        "peaks": peaks,
        "multipliers": multipliers_value(orbit.multipliers),
        "lyapunov": orbit.lyapunov,
        "residual": orbit.residual,
        "states": [
            {"side": each.side, "phase": each.phase, "speed": each.speed} for each in orbit.states
        ],
    }
    if isinstance(block, Block):
        values["peaks_rad"] = None if peaks is None else [peak * block.alpha for peak in peaks]
        values["period_s"] = orbit.period / motion.frequency_hz(block)
    return values
