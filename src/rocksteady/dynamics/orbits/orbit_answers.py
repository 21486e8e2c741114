"""Answers of attractors and of searches for orbits."""

import math
from collections import Counter
from collections.abc import Sequence
from typing import Any

from rocksteady.dynamics.history.start import Rest
from rocksteady.dynamics.orbits.orbit_facts import start_text, worth
from rocksteady.dynamics.orbits.return_map import has_mirror_images
from rocksteady.dynamics.steady.verdicts import BEYOND, multipliers_text
from rocksteady.model.blocks.block import Block
from rocksteady.model.facts import AnyBlock, case_text, solved_text, tilt_text
from rocksteady.outcomes import AttractorKind
from rocksteady.results.answer import Answer, aligned, left_out
from rocksteady.results.numbers import angle, number, plural, quantity

MOST_ORBITS = 2
"""Orbits that an answer lists."""
VERDICTS = ("stable", "neutral", "grazes", "unstable", "inadmissible")
"""Verdicts on orbits, those of motions that last first."""


def attractor_answer(attractor: Any, *, rounded: float) -> Answer:
    """Return what a motion settles to, how stable that is and when it was known.

    Parameters
    ----------
    attractor
        The attractor.
    rounded
        Growth of small differences from which on a rounding may decide.
    """
    block, orbit, kind = attractor.block, attractor.orbit, attractor.kind
    start = start_text(attractor.initial)
    shrinks, rate = "", attractor.lyapunov
    if orbit is not None:
        left = "vanishes at each rest" if orbit.rest_phases else ""
        left = left or f"shrinks to {number(100.0 * math.exp(rate), 2)} % a period"
        shrinks = f"a disturbance {left}"
    mirrored = kind is AttractorKind.UNSYMMETRIC and has_mirror_images(block, attractor.motion)
    grown = ""
    decided = kind not in (AttractorKind.APERIODIC, AttractorKind.UNDECIDED)
    if decided and attractor.growth > rounded:
        tens = round(math.log10(attractor.growth))
        grown = f"differences grew 10^{tens}-fold on the way: a rounding may have chosen"
    known = plural(attractor.after, "period") if attractor.after else ""
    facts = [
        ("rounding", grown),
        ("beyond alpha", BEYOND if orbit is not None and beyond_alpha(orbit) else ""),
        ("period", _period(orbit)),
        ("stable", shrinks),
        ("mirror image", "is an attractor too" if mirrored else ""),
        ("known after", f"{known}, from {start}" if known else ""),
        ("computed", f"{attractor.model.name}; {case_text(block)}"),
    ]
    return Answer(_settles(attractor), facts)


def _settles(attractor: Any) -> str:
    """Return what a motion settles to, in a sentence."""
    kind, orbit, start = attractor.kind, attractor.orbit, start_text(attractor.initial)
    if orbit is not None:
        article = "an" if kind is AttractorKind.UNSYMMETRIC else "a"
        period = f" of period {orbit.period}" if orbit.period > 1 else ""
        if orbit.symmetric:
            reach = f"up to {tilt_text(orbit.block, orbit.highest)}"
        elif isinstance(orbit.block, Block):
            ends = [angle(u * orbit.block.alpha) for u in (orbit.highest, orbit.lowest)]
            reach = f"from {ends[0]} to {ends[1]}"
        else:
            reach = f"from {number(orbit.highest)} to {number(orbit.lowest)} alpha"
        return f"It settles to {article} {kind.value} steady motion{period}, {reach}."
    if kind is AttractorKind.UNDECIDED:
        return f"Undecided: {attractor.reason}."
    if kind is AttractorKind.OVERTURNED:
        return f"It falls: from this start ({start}) it reaches no steady motion."
    if kind is AttractorKind.REST:
        if isinstance(attractor.initial, Rest) and not attractor.after:
            return "It rests throughout: the motion never lifts it."
        return "It comes to rest, and the motion does not lift it again."
    grows = number(math.exp(attractor.lyapunov))
    return f"It rocks on and never repeats: a small difference grows {grows}-fold a period."


def beyond_alpha(orbit: Any) -> bool:
    """Return whether a motion tilts beyond alpha."""
    return bool(max(orbit.highest, -orbit.lowest) > 1.0)


def _period(orbit: Any) -> str:
    """Return the period of an orbit and its impacts."""
    if orbit is None:
        return ""
    words = f"{plural(orbit.period, 'period')} of the base"
    if isinstance(orbit.block, Block):
        words += f" ({quantity(orbit.period / orbit.motion.frequency_hz(orbit.block), 's')})"
    if orbit.rest_phases:
        return f"{words}, {plural(orbit.rest_phases, 'rest')}, infinitely many impacts"
    return f"{words}, {plural(orbit.impacts, 'impact')}"


def orbits_answer(
    orbits: Sequence[Any],
    block: AnyBlock,
    limits: dict[str, int],
    *,
    mirrors: bool,
) -> Answer:
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
        (
            "beyond alpha",
            f"{plural(reaching, 'motion')}: {BEYOND}" if reaching else "",
        ),
        ("searched", f"{seeds} x {seeds} starts may miss some{images}"),
    ]
    return Answer(sentence, facts)


def _row(number_of: int, orbit: Any) -> tuple[str, ...]:
    """Return an orbit in words: its verdict and kind, then its numbers."""

    def tilt(u: float) -> str:
        if math.isnan(u):
            return "—"
        sized = isinstance(orbit.block, Block)
        return f"{math.degrees(u * orbit.block.alpha):.2f}°" if sized else f"{u:.3f}"

    return (
        f"{number_of} {worth(orbit)} {orbit.kind}",
        str(orbit.period),
        "inf" if orbit.impacts is None else str(orbit.impacts),
        tilt(orbit.highest),
        tilt(orbit.lowest),
        multipliers_text(orbit.multipliers),
    )
