"""Sensitivity of an object's answer: one thing changed at a time, counted again."""

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, NamedTuple

from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arrays import compare_by_value
from rocksteady.results.numbers import number_or_none, share_of
from rocksteady.risk.assess.described.objects import DescribedObject, key_words
from rocksteady.risk.assess.judging import band_of, run_at_demand
from rocksteady.risk.counted.count import count_falls
from rocksteady.risk.counted.suite import Shaking
from rocksteady.risk.ensemble.restitution_band import RestitutionBand
from rocksteady.sweep.run import Execution

CENTRE = 0.1
"""Share by which the height of the mass centre is varied."""
WORN = 0.05
"""Share of the width that worn edges take."""
AS_DESCRIBED = "as described"


@compare_by_value
@dataclass(frozen=True, kw_only=True)
class Case:
    """The object with one thing changed, at the demand.

    Attributes
    ----------
    parameter
        What is changed; "as described" of the first case.
    change
        How, in words.
    share, low, high
        Share of the runs that falls, and its 90 % interval.
    fall, runs
        Runs that fall, and runs.
    """

    parameter: str
    change: str
    share: float
    low: float
    high: float
    fall: int
    runs: int

    def to_dict(self) -> dict[str, Any]:
        """Return plain values."""
        return {**vars(self), "share": number_or_none(self.share)}


def vary(
    described: DescribedObject, shaking: Shaking, *, run: Execution | None = None
) -> tuple[Case, ...]:
    """Return the object as described and each of its changes, counted at the demand."""
    band, base = band_of(described), described.block
    cases = [(AS_DESCRIBED, "", base, band)]
    cases += [(*change, band) for change in changes_of(described)]
    if band.draws > 1:
        fixed = RestitutionBand(draws=1)
        for ratio, negative in band.ratios(base)[[0, -1]].tolist():
            alone = base.with_restitution(ratio if base.one_sided else (ratio, negative))
            words = f"{max(ratio, negative):.3f} alone"
            cases.append(("restitution", words, alone, fixed))
    ensembles = run_at_demand([(block, shaking, kept) for _, _, block, kept in cases], run=run)
    made = []
    for (parameter, change, _, _), runs in zip(cases, ensembles, strict=True):
        (count,) = count_falls(runs)
        low, high = count.band
        made.append(
            Case(
                parameter=parameter,
                change=change,
                share=count.share,
                low=low,
                high=high,
                fall=count.falls,
                runs=count.runs,
            )
        )
    return tuple(made)


def changes_of(described: DescribedObject) -> list[tuple[str, str, Block]]:
    """Return parameter, change and block of each case of another shape."""
    body = described.body
    changes: list[tuple[str, str, Block]] = []
    for factor in (1.0 - CENTRE, 1.0 + CENTRE):
        with suppress(InputError):  # a stocky block with its centre lower still has no impacts
            changed = described.block_of(body.with_centre(factor))
            changes.append(("mass centre", f"{100.0 * (factor - 1.0):+.0f} %", changed))
    worn = described.block_of(body.wider(1.0 - WORN))
    changes.append(("base width", f"{-100.0 * WORN:+.0f} %, worn edges", worn))
    changes += [
        (variant.key, variant.label.removeprefix(variant.key).strip(), variant.block)
        for variant in described.variants()
    ]
    return changes


class Bar(NamedTuple):
    """Shares at both ends of what is varied alone.

    Attributes
    ----------
    parameter, ends
        What is varied, and from what to what, in words.
    low, high
        Share at its low and at its high end; the object as described is the other end of what is
        changed to one side alone.
    """

    parameter: str
    ends: str
    low: float
    high: float

    @property
    def words(self) -> str:
        """Both shares, the smaller first; empty where they read alike."""
        low, high = (share_of(end) for end in sorted((self.low, self.high)))
        return "" if low == high else f"{low.removesuffix(' %')} to {high}"


def bars_of(cases: Sequence[Case]) -> list[Bar]:
    """Return a bar for each parameter, the widest first; none of one without a share."""
    changes: dict[str, list[Case]] = {}
    for case in cases[1:]:
        changes.setdefault(case.parameter, []).append(case)
    bars = []
    for parameter, (first, *others) in changes.items():
        ends, low, high = first.change, cases[0].share, first.share
        if others:
            last = others[-1]
            words = (each.change.removesuffix(" alone") for each in (first, last))
            ends, low, high = " to ".join(words), first.share, last.share
        elif first.change.startswith(("-", "\N{MINUS SIGN}")):
            low, high = high, low
        if math.isfinite(low + high):
            bars.append(Bar(key_words(parameter), ends, low, high))
    base = cases[0].share if cases else 0.0
    return sorted(bars, key=lambda bar: -max(abs(end - base) for end in (bar.low, bar.high)))
