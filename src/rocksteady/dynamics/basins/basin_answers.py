"""Answers of windows of starts: which share falls, rests and rocks."""

import math
from collections.abc import Iterable, Sequence
from typing import Any

from rocksteady.dynamics.orbits.orbit_answers import beyond_alpha
from rocksteady.dynamics.parameters import SYMBOLS
from rocksteady.dynamics.steady.verdicts import BEYOND
from rocksteady.model.facts import case_text, peak_unit, solved_text, tilt_text
from rocksteady.outcomes import AttractorKind, Status
from rocksteady.results.answer import Answer, left_out
from rocksteady.results.numbers import chance, number, plural

MOST_BASINS = 3
"""Basins that an answer lists."""
FEW = 1e-3
"""Share of undecided states that is no failure: a window may meet states that balance for ever."""
ENDS = {AttractorKind.OVERTURNED: "fall", AttractorKind.REST: "come to rest"}
"""What becomes of the starts of a basin, besides rocking on."""
LONGER = "they balance for ever, or take more periods to follow"
FALLEN = (AttractorKind.OVERTURNED,)


def shares_sentence(ends: Iterable[tuple[str, float]], undecided: float) -> str:
    """Return what becomes of the starts of a window: shares by what they do, the first as given."""
    shares: dict[str, float] = {}
    for verb, share in ends:
        shares[verb] = shares.get(verb, 0.0) + share
    parts = [f"{chance(share)} {verb}" for verb, share in shares.items() if share]
    if len(parts) == 1:
        parts = [f"all {verb}" for verb, share in shares.items() if share]
    words = ", ".join(parts[:-1]) + f" and {parts[-1]}" if len(parts) > 1 else parts[0]
    return f"{'Undecided: of' if undecided > FEW else 'Of'} these starts {words}."


def basins_answer(basins: Any) -> Answer:
    """Return the shares of the basins, the largest listed."""
    shares = [part.share for part in basins.fractions()]
    pairs = sorted(zip(basins.attractors, shares, strict=True), key=lambda pair: -pair[1])
    ends = [
        (ENDS.get(each.kind, "are undecided" if _open(each) else "keep rocking"), share)
        for each, share in sorted(
            pairs, key=lambda pair: pair[0].kind is not AttractorKind.OVERTURNED
        )
    ]
    rows = []
    for each, share in pairs[:MOST_BASINS]:
        words, orbit = [f"{100.0 * share:.1f} %"], each.orbit
        if basins.seed is not None:
            part = basins.fractions()[each.label]
            words[0] += f" (90 %: {100.0 * part.low:.1f} to {100.0 * part.high:.1f} %)"
        if orbit is not None:
            words += [f"period {orbit.period}", f"tilt {tilt_text(basins.block, _reach(orbit))}"]
        rows.append((_name(each), ", ".join(words)))
    left = pairs[MOST_BASINS:]
    total = sum(share for _, share in left)
    beyond = sum(each.orbit is not None and beyond_alpha(each.orbit) for each in basins.attractors)
    settle = "without loss motions do not settle" if basins.block.lossless else LONGER
    facts = [
        ("undecided", settle if basins.undecided else ""),
        *rows,
        left_out(len(left), f"{100.0 * total:.1f} %"),
        ("beyond alpha", f"{plural(beyond, 'motion')}: {BEYOND}" if beyond else ""),
        ("starts", f"{basins.label.size:,}: {_window(basins)}"),
        ("computed", f"{basins.model.name}; at most {basins.max_cycles} periods"),
        ("boundary", "not measured: --entropy and --exponent measure it"),
    ]
    sentence = shares_sentence(ends, basins.undecided).removesuffix(".")
    return Answer(f"{solved_text(sentence, basins.block)}.", facts)


def _window(result: Any) -> str:
    """Return the window of the starts: its ends once where both axes are centred."""
    ends = [(float(axis[0]), float(axis[-1])) for axis in (result.angle, result.velocity)]
    if all(abs(low + high) <= 1e-9 * high for low, high in ends):
        return f"|u| to {number(ends[0][1])}, |du/d(pt)| to {number(ends[1][1])}"
    words = [f"{number(low)} to {number(high)}" for low, high in ends]
    return f"u {words[0]}, du/d(pt) {words[1]}"


def _open(attractor: Any) -> bool:
    return bool(attractor.kind is AttractorKind.UNDECIDED)


def _reach(orbit: Any) -> float:
    """Return the largest tilt of an orbit."""
    return float(max(orbit.highest, -orbit.lowest))


def _name(attractor: Any) -> str:
    """Return a basin in a word, with the letter that distinguishes mirror images."""
    plain = {AttractorKind.OVERTURNED: "falls", AttractorKind.REST: "rests"}
    letter = attractor.name[-1] if attractor.orbit and attractor.name[-1].isalpha() else ""
    return f"{plain.get(attractor.kind, attractor.kind.value)} {letter}".strip()


def fates_answer(fates: Any) -> Answer:
    """Return the shares of the fates and what is left of the safe states."""
    parts = fates.fractions()
    words = {
        Status.OVERTURNED: "fall",
        Status.AT_REST: "come to rest",
        Status.ROCKING: "keep rocking",
        Status.LOST_CONTACT: "leave the base",
        Status.UNDECIDED: "are undecided",
    }
    order = [Status.OVERTURNED, *(status for status in Status if status != Status.OVERTURNED)]
    ends = [(words[p.fate], p.share) for status in order for p in parts if p.fate == status]
    sides = " and ".join(
        f"{100.0 * part.share:.1f} % to the {'positive' if part.side > 0 else 'negative'} side"
        for part in parts
        if part.fate == Status.OVERTURNED
    )
    still = fates.global_integrity
    safe = f"{_left(still)} of the safe area without the motion"
    safe += f", {_left(fates.integrity_factor)} of its radius"
    facts = [
        ("falls", sides),
        ("left of it", "" if math.isnan(still) else safe),
        ("starts", f"{fates.fate.size:,}: {_window(fates)}"),
        ("computed", f"{fates.model.name}; {case_text(fates.block)}"),
    ]
    return Answer(shares_sentence(ends, fates.undecided), facts)


def erosion_answer(erosion: Any) -> Answer:
    """Return the amplitudes at which half of the safe basin is lost."""
    block = erosion.block
    last = peak_unit(block, float(erosion.amplitude[-1]))
    drops = {
        name: peak_unit(block, drop.high) if drop else "" for name, drop in erosion.drops.items()
    }
    area, radius = drops["global_integrity"], drops["integrity_factor"]
    sentence = f"Half of the safe area is lost at {area}"
    sentence += f", half of its radius at {radius}." if radius else "."
    if not area:
        sentence = f"Half or more of the safe area is left up to {last}"
        sentence += f"; half of its radius is lost at {radius}." if radius else "."
    tangency = erosion.heteroclinic
    ends = (erosion.global_integrity[-1], erosion.integrity_factor[-1])
    area_left, radius_left = (_left(float(end)) for end in ends)
    left = f"{area_left} of the area, {radius_left} of the radius"
    return Answer(
        sentence,
        [
            (f"left at {last}", left),
            ("begins at", f"{peak_unit(block, tangency)}, the tangency" if tangency else ""),
            ("safe", f"stands {plural(erosion.cycles, 'period')}; against that of a base at rest"),
            ("starts", f"{erosion.safe[0].size:,}: {_window(erosion)}"),
            ("computed", f"{erosion.model.name}; {case_text(block)}"),
        ],
    )


def over_answer(shares: Any, families: Sequence[dict[str, Any]]) -> Answer:
    """Return how the shares of basins change over a parameter.

    Parameters
    ----------
    shares
        The shares.
    families
        Its basins, as in JSON.
    """
    symbol = SYMBOLS.get(shares.parameter, shares.parameter).replace("Ω", "W")
    over = f"{symbol} {number(float(shares.values[0]))} to {number(float(shares.values[-1]))}"
    falls = [each for each in families if each["name"] == AttractorKind.OVERTURNED.value]
    sentence = f"None of these starts falls over {over}"
    if falls:
        values = len(shares.values)
        at = "" if falls[0]["values"] == values else f" at {falls[0]['values']} of {values} values"
        sentence = f"Over {over}, {_range(falls[0])} of these starts fall{at}"
    if shares.undecided > FEW:
        sentence = f"Undecided: {sentence[0].lower()}{sentence[1:]}"
    ranked = sorted(
        (each for each in families if each not in falls), key=lambda each: -each["most"]
    )
    rows = []
    for each in ranked[:MOST_BASINS]:
        where = "" if each["values"] == len(shares.values) else _where(each, symbol)
        rows.append(("rests" if each["name"] == "rest" else each["name"], _range(each) + where))
    left = len(ranked) - len(rows)
    facts = [
        *rows,
        left_out(left, "smaller basins"),
        ("starts", f"{shares.label[0].size:,} at each: {_window(shares)}"),
        ("computed", f"{shares.model.name}; at most {shares.max_cycles} periods"),
    ]
    return Answer(f"{solved_text(sentence, shares.block)}.", facts)


def _left(share: float) -> str:
    """Return the fraction of the safe basin that survives, in words."""
    return chance(share) if 0.0 < share < 1.0 else "all" if share else "nothing"


def _where(family: dict[str, Any], symbol: str) -> str:
    """Return between which values a family is met."""
    first, last = number(family["from"], 4), number(family["to"], 4)
    return f", at {symbol} {first}" + ("" if first == last else f" to {last}")


def _range(family: dict[str, Any]) -> str:
    """Return the least and the largest share of a family."""
    least, most = chance(family["least"]), chance(family["most"])
    if not family["least"] and family["most"]:
        return f"none to {most}"
    return most if least == most else f"{least.removesuffix(' %')} to {most}"
