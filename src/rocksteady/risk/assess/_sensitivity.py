"""Sensitivity of an object's answer: one thing changed at a time, run again."""

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np

from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arrays import compare_by_value
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.results.doubts import far_above
from rocksteady.results.numbers import chance, plural
from rocksteady.risk.assess._counts import (
    MULTIPLES,
    THE_DEMAND,
    Basis,
    Counts,
    Motions,
    is_fitted,
    run_at,
)
from rocksteady.risk.assess._demand_level import DemandLevel
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.risk.assess.described.schema import Range
from rocksteady.risk.ensemble.restitution_band import RestitutionBand
from rocksteady.risk.screens.friction import lifts
from rocksteady.sweep.run import Execution

CENTRE = 0.1
"""Share by which the height of the mass centre is varied."""
MOST_DRAWS = 3
"""Restitutions of a changed object: both ends of the band and its middle."""
WORN = 0.05
"""Share of the width that worn edges take."""


@compare_by_value
@dataclass(frozen=True, kw_only=True)
class Case:
    """The object with one thing changed.

    Attributes
    ----------
    parameter
        What is changed; "as described" of the first case.
    change
        How, in words.
    fitted, counted
        Probability of falling at the demand: fitted over the levels about it, and the share of the
        runs there; where no curve can be fitted both are the share.
    basis
        What the probability is from: "curve", "count" (no curve can be fitted, or the share counted
        is far above it), or "statics" (the PGA does not lift it).
    fell, trials
        Runs at the demand.
    median
        Level at which half of the runs fall; NaN where none was found.
    band
        Interval of 90 % of the share counted, over records; None without a run.
    """

    parameter: str
    change: str
    fitted: float
    counted: float
    basis: Basis
    fell: int
    trials: int
    median: float
    band: tuple[float, float] | None = None

    @property
    def probability(self) -> float:
        """Probability of falling by the basis."""
        return self.counted if self.basis == "count" else self.fitted

    def to_dict(self) -> dict[str, Any]:
        """Return plain values, None for what does not exist."""
        low, high = self.band or (None, None)
        values = {**vars(self), "probability": self.probability, "band_low": low, "band_high": high}
        del values["band"]
        return {
            key: None if isinstance(value, float) and math.isnan(value) else value
            for key, value in values.items()
        }


def vary(
    described: DescribedObject,
    motions: Motions,
    level: DemandLevel,
    *,
    run: Execution | None = None,
) -> tuple[Case, ...]:
    """Return the object as described and each of its changes, at the demand.

    The object as described has the restitutions of its band and no vertical motion; every case
    meets all records in both signs at 0.63 to 1.6 times the demand.
    """
    base, levels = described.block, levels_about(level)
    band = band_of(described, most=MOST_DRAWS)
    changes = changes_of(described)
    blocks = [base, *(block for _, _, block in changes)]
    counts = run_at(blocks, motions, level.measure, levels, restitution=band, run=run)
    names = [("as described", ""), *((parameter, change) for parameter, change, _ in changes)]
    cases = [
        case_of(parameter, change, run_counts, rests=stays(described, block))
        for (parameter, change), run_counts, block in zip(names, counts, blocks, strict=True)
    ]
    if band.draws > 1:
        ends = band.ratios(base)[[0, -1]].tolist()
        alone = [
            base.with_restitution(ratio if base.one_sided else (ratio, negative))
            for ratio, negative in ends
        ]
        run_counts = run_at(alone, motions, level.measure, levels, run=run)
        cases += [
            case_of("restitution", f"{max(pair):.3f} alone", each, rests=stays(described, base))
            for pair, each in zip(ends, run_counts, strict=True)
        ]
    lifted = [
        each for each in motions if isinstance(each, BaseMotion) and each.vertical is not None
    ]
    if lifted:
        (shaken,) = run_at(
            [base], motions, level.measure, levels, restitution=band, vertical=True, run=run
        )
        words = f"with {plural(len(lifted), 'component')}"
        if shaken.without:
            words += f"; {plural(shaken.without, 'run')} left out whose base falls at g"
        cases.append(case_of("vertical motion", words, shaken, rests=stays(described, base)))
    return tuple(cases)


def band_of(described: DescribedObject, *, most: int) -> RestitutionBand:
    """Return the restitutions of an object: a band of its file, its one value, or the usual band.

    Parameters
    ----------
    described
        The object.
    most
        Largest number of values.
    """
    given, draws = described.given.restitution, min(most, described.given.assessment.draws)
    if isinstance(given, Range):
        return RestitutionBand(low=given.low, high=given.high, draws=draws)
    if given == "housner":
        return RestitutionBand(draws=draws)
    return RestitutionBand(draws=1)


def levels_about(level: DemandLevel) -> list[float]:
    """Return the levels at which a changed object is run."""
    return [multiple * level.value for multiple in MULTIPLES]


def stays(described: DescribedObject, block: Block) -> bool:
    """Return whether the demand's PGA does not lift a block; False without a PGA."""
    demand = described.demand
    if demand.pga_g is None:
        return False
    return not lifts(block, demand.pga_g, demand.vertical_at_peak_g)


def case_of(
    parameter: str,
    change: str,
    counts: Counts,
    *,
    rests: bool = False,
    by_levels: float = math.nan,
) -> Case:
    """Return a case of its counts; 0 where the demand's PGA does not lift the block.

    Parameters
    ----------
    parameter, change
        What is changed, and how.
    counts
        Runs about the demand.
    rests
        Whether the demand's PGA does not lift the block; default False.
    by_levels
        Probability by a curve through more levels, which takes the place of that of these counts;
        nan (default) without one.
    """
    curve = counts.curve()
    fell, trials = counts.totals(THE_DEMAND)
    probability, has_curve = by_levels, not math.isnan(by_levels)
    if not has_curve and is_fitted(curve):
        probability = float(curve.probability(np.array([counts.levels[THE_DEMAND]]))[0])
        has_curve = True
    counted = fell / trials if trials else math.nan
    # A step, or no curve, has no value between the levels: the share is all there is.
    fitted = 0.0 if rests else probability if has_curve else counted
    by_curve = has_curve and far_above(fitted, counted) == fitted
    return Case(
        parameter=parameter,
        change=change,
        fitted=fitted,
        counted=counted,
        basis="statics" if rests else "curve" if by_curve else "count",
        fell=fell,
        trials=trials,
        median=float(curve.median),
        band=counts.share_band(THE_DEMAND),
    )


def changes_of(described: DescribedObject) -> list[tuple[str, str, Block]]:
    """Return parameter, change and block of each case without vertical motion."""
    body = described.body
    changes: list[tuple[str, str, Block]] = []
    for factor in (1.0 - CENTRE, 1.0 + CENTRE):
        with suppress(InputError):  # a stocky block with its centre lower still has no impacts
            changed = described.block_of(body.with_centre(factor))
            changes.append(("mass centre", f"{100.0 * (factor - 1.0):+.0f} %", changed))
    changes.append(
        (
            "base width",
            f"{-100.0 * WORN:+.0f} %, worn edges",
            described.block_of(body.wider(1.0 - WORN)),
        )
    )
    changes += [
        (variant.key, variant.label.removeprefix(variant.key).strip(), variant.block)
        for variant in described.variants()
    ]
    return changes


def end_words(probability: float) -> str:
    """Return an end of a bar in words."""
    return chance(probability) if probability else "none"


def bar_words(bar: Mapping[str, Any]) -> str:
    """Return both ends of a bar; empty where they read alike, or one is not known.

    Examples
    --------
    >>> bar_words({"low": 0.21, "high": 0.428}), bar_words({"low": 0.0, "high": 0.08})
    ('21 to 43 %', 'none to 8.0 %')
    >>> bar_words({"low": 0.0, "high": 0.0})
    ''
    """
    low, high = (end_words(bar[end]) for end in ("low", "high"))
    if low == high or not math.isfinite(bar["low"] + bar["high"]):
        return ""
    return f"{low.removesuffix(' %')} to {high}"


def as_described(bar: Mapping[str, Any], value: float | None) -> str:
    """Return the middle of a bar in words where the answer lies outside it, or else nothing.

    Bars are of runs about the demand, the answer may be of runs at all levels.

    Examples
    --------
    >>> as_described({"low": 0.0, "high": 0.08, "base": 0.01}, 0.12)
    ', 1.0 % as described'
    >>> as_described({"low": 0.0, "high": 0.2, "base": 0.11}, 0.12)
    ''
    """
    if value is None or bar["low"] <= value <= bar["high"]:
        return ""
    return f", {end_words(bar['base'])} as described"


def by_one_method(cases: Sequence[Case], basis: Basis | None) -> list[float]:
    """Return the probability of each case by the method of the answer.

    A case that went from curve to count would show the difference of the methods, not of the
    change.
    """
    return [
        case.counted if basis == "count" and case.basis != "statics" else case.fitted
        for case in cases
    ]


def tornado(cases: Sequence[Case], basis: Basis | None) -> list[dict[str, Any]]:
    """Return a bar for each parameter, the widest first: lowest and highest probability.

    Parameters
    ----------
    cases
        The object as described, and each change of it.
    basis
        What the probability of the answer is from.
    """
    base, *shares = by_one_method(cases, basis)
    bars: dict[str, list[float]] = {}
    for case, share in zip(cases[1:], shares, strict=True):
        bars.setdefault(case.parameter, [base]).append(share)
    rows = [
        {"parameter": name, "low": float(np.min(ends)), "high": float(np.max(ends)), "base": base}
        for name, ends in bars.items()
    ]
    # A bar without an end, where no run lifts the changed object, comes last.
    return sorted(rows, key=lambda row: np.nan_to_num(row["low"] - row["high"], nan=1.0))
