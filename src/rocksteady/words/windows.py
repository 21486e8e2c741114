"""Words that windows of initial states share: their ends, shares and coordinates."""

from collections.abc import Iterable, Mapping, Sequence

from rocksteady.dynamics.basins.basins import Basins, BasinShare
from rocksteady.dynamics.basins.erosion import Erosion
from rocksteady.dynamics.basins.fate_basins import FateBasins, FateShare
from rocksteady.dynamics.basins.over.shares import BasinShares
from rocksteady.dynamics.basins.window import LONG_NAMES
from rocksteady.model.checks.confidence import CONFIDENCE_TEXT
from rocksteady.model.facts import lean_text
from rocksteady.outcomes import AttractorKind, motion_words
from rocksteady.results.description import Column, Description, Fact
from rocksteady.results.numbers import chance, number

Windowed = Basins | BasinShares | Erosion | FateBasins


MOST_BASINS = 3
"""Basins that an answer lists."""
FEW = 1e-3
"""Share of undecided states that is no failure: a window may meet states that balance for ever."""
BETWEEN = Column("between", CONFIDENCE_TEXT)


def shares_sentence(ends: Iterable[tuple[str, float]], undecided: float) -> str:
    """Return the shares of the starts of a window by what becomes of them."""
    shares: dict[str, float] = {}
    for verb, share in ends:
        shares[verb] = shares.get(verb, 0.0) + share
    parts = [f"{chance(share)} {verb}" for verb, share in shares.items() if share]
    if len(parts) == 1:
        parts = [f"all {verb}" for verb, share in shares.items() if share]
    words = ", ".join(parts[:-1]) + f" and {parts[-1]}" if len(parts) > 1 else parts[0]
    return f"{'Undecided: of' if undecided > FEW else 'Of'} these starts {words}."


def basin_name(kind: AttractorKind, period: int | None, name: str) -> tuple[str, str]:
    """Return what a basin's motion does, for a row, and the rest of the name of that motion.

    Parameters
    ----------
    kind, period
        Of the motion.
    name
        The basin's own, whose letter distinguishes mirror images.
    """
    does, _, further = motion_words(kind, period).partition(", ")
    letter = f" {name[-1]}" if period and name[-1].isalpha() else ""
    return does + letter, further


def ends_text(result: Windowed) -> str:
    """Return the window of the starts: its ends once where both axes are centred."""
    ends = [(float(axis[0]), float(axis[-1])) for axis in (result.angle, result.velocity)]
    if all(abs(low + high) <= 1e-9 * high for low, high in ends):
        return f"|u| to {number(ends[0][1])}, |du/d(pt)| to {number(ends[1][1])}"
    words = [f"{number(low)} to {number(high)}" for low, high in ends]
    return f"u {words[0]}, du/d(pt) {words[1]}"


def window_text(result: Windowed) -> str:
    """Return the window of the states of a result in words."""
    least, most = (lean_text(result.block, float(end)) for end in result.angle[[0, -1]])
    slow, fast = (number(float(end)) for end in result.velocity[[0, -1]])
    return f"u from {least} to {most}, du/d(pt) from {slow} to {fast}"


def axis_facts(result: Windowed) -> list[Fact]:
    """Return first, last and number of the points along both axes of a window."""
    return [
        Fact(key, {"start": float(axis[0]), "stop": float(axis[-1]), "count": len(axis)})
        for key, axis in (("angles", result.angle), ("velocities", result.velocity))
    ]


def coordinates_of(result: Windowed, *names: str, **attributes: str) -> dict[str, object]:
    """Return axes of a window, in the order given, as coordinates of a dataset."""
    return {
        name: (name, getattr(result, name), {"long_name": LONG_NAMES[name], **attributes})
        for name in names
    }


def fraction_described(fraction: BasinShare | FateShare, name: str, *facts: Fact) -> Description:
    """Return the share with its interval, after the facts on what is counted."""
    between = f"{number(100.0 * fraction.low)} to {number(100.0 * fraction.high)} %"
    share = f"{number(100.0 * fraction.share)} %"
    counts = [
        Fact("states", fraction.states, "states"),
        Fact("share", fraction.share, "share", share),
        Fact("low", fraction.low, "interval", between),
        Fact("high", fraction.high),
    ]
    return Description(f"{name}: {share} ({between})", [*facts, *counts])


def with_between(
    rows: Sequence[Mapping[str, object]], parts: Sequence[BasinShare | FateShare]
) -> list[dict[str, object]]:
    """Return the rows of fractions, each with the interval of its fraction in words."""
    return [
        {**row, "between": f"{100.0 * part.low:.2f} to {100.0 * part.high:.2f} %"}
        for row, part in zip(rows, parts, strict=True)
    ]


def left_text(share: float) -> str:
    """Return the fraction of the safe basin that survives, in words."""
    return chance(share) if 0.0 < share < 1.0 else "all" if share else "nothing"
