"""Shares of a window of states: their counts, intervals, words and columns."""

from collections.abc import Iterable, Mapping
from typing import Any

from rocksteady.model.checks.confidence import CONFIDENCE_TEXT, share_interval
from rocksteady.results.description import Column, Description, Fact
from rocksteady.results.numbers import number

BETWEEN = Column("between", CONFIDENCE_TEXT)


def counted(states: int, window: int, confidence: float) -> dict[str, Any]:
    """Return the fields of a fraction: states, share and Wilson's interval.

    Parameters
    ----------
    states
        Number of states that the fraction counts.
    window
        Number of all states of the window.
    confidence
        Confidence of the interval, in (0, 1).
    """
    share = states / window
    low, high = share_interval(share, window, confidence)
    return {"states": states, "share": share, "low": float(low), "high": float(high)}


def fraction_described(fraction: Any, name: str, *facts: Fact) -> Description:
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


def with_between(rows: Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Return the rows of fractions, each with its interval in words."""
    return [
        {**row, "between": f"{100.0 * row['low']:.2f} to {100.0 * row['high']:.2f} %"}
        for row in rows
    ]
