"""Remedies: the least change with which an object meets its target, by runs of what it makes."""

import itertools
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Final

import numpy as np

from rocksteady.errors import InputError, ModelError
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.risk.assess.judging import Judged, band_of, evidence_of, onset_of, run_at_demand
from rocksteady.risk.assess.remedy import CHANGES, Remedy
from rocksteady.risk.counted.count import count_falls
from rocksteady.risk.counted.suite import Shaking
from rocksteady.risk.counted.verdict import MARGIN, decide
from rocksteady.sweep.run import Execution

WIDER: Final = 1.02
"""Ratio of a width to the next."""
WIDEST: Final = 2.2
"""Ratio of the widest base to the base as it is."""
LOWER_M: Final = 0.02
"""Step by which the mass centre is lowered [m]."""
STEPS: Final = (0.02, 0.04)
"""Parts of the height of the mass centre that a step is at least and at most."""
LOWEST: Final = 0.5
"""Part of the height of the mass centre by which it is lowered at most."""
FINER: Final = 8
"""Steps between the last value that does not pass and the first that does."""
HELPED: Final = ("band", "cliff", "stretched")
"""Reasons of "not shown" that a change of shape can take away."""


@dataclass(frozen=True, kw_only=True)
class _Change:
    """A kind of change: its values, of which the first is the object as it is."""

    name: str
    values: Sequence[float]
    make: Callable[[float], DescribedObject]


@dataclass(frozen=True, kw_only=True)
class _Tried:
    """An object that was changed, and what was counted of it."""

    value: float
    share: float
    beyond: float
    is_shown: bool
    friction: float

    def passes(self, target: float) -> bool:
        """Whether no more than the target fall, at the demand and at 1.1 times it."""
        return self.share <= target and self.beyond <= target


def is_helped(judged: Judged, described: DescribedObject, *, built_in: bool) -> bool:
    """Return whether a change of shape is looked for."""
    decision = judged.decision
    wanted = decision.verdict == "red" or decision.reason in HELPED
    at_demand = described.target.years is None and judged.count is not None
    return wanted and at_demand and not built_in


def remedies_of(
    asked: Sequence[tuple[DescribedObject, Shaking]], *, run: Execution | None = None
) -> list[tuple[Remedy, ...]]:
    """Return the least changes of some objects, all changed objects run at once.

    Values rise in steps from the object as it is: a base wider by 2 % each, to 2.2 times it, and a
    mass centre lower by 20 mm each.  Of all that pass the least counts from which all larger ones
    pass too, refined by a step of eight parts: shares need not fall with the width.  Values are run
    as they are printed.  Those that slide are no remedies, nor are larger ones.
    """
    scans = [
        (place, shaking, change)
        for place, (described, shaking) in enumerate(asked)
        for change in _changes(described)
    ]
    objects = [list(_feasible(change, change.values, shaking)) for _, shaking, change in scans]
    coarse = _tried(
        [(shaking, row) for (_, shaking, _), row in zip(scans, objects, strict=True)], run
    )
    targets = [asked[place][0].target.share for place, _, _ in scans]
    brackets = [
        sorted({*_finer(row, target), *_finer(row, None)})
        for row, target in zip(coarse, targets, strict=True)
    ]
    fine = _tried(
        [
            (shaking, list(_feasible(change, values, shaking)))
            for (_, shaking, change), values in zip(scans, brackets, strict=True)
        ],
        run,
    )
    remedies: list[tuple[Remedy, ...]] = [() for _ in asked]
    for (place, _, change), first, second, target in zip(scans, coarse, fine, targets, strict=True):
        if first:
            remedies[place] += (_remedy(change, first, second, target),)
    return remedies


def _changes(described: DescribedObject) -> Iterator[_Change]:
    """Yield the kinds of change of an object."""
    body = described.body
    width, centre = body.left + body.right, body.centre_height
    widths = [width]
    while widths[-1] < WIDEST * width:
        widths.append(widths[-1] * WIDER)
    yield _Change(
        name=CHANGES[0],
        values=[width, *map(rounded, widths[1:])],
        make=lambda value: described.wider(value / width),
    )
    least, most = (part * centre for part in STEPS)
    step = min(max(LOWER_M, least), most)
    lower = step * np.arange(int(LOWEST * centre / step) + 1, dtype=np.float64)
    yield _Change(
        name=CHANGES[1], values=[0.0, *map(rounded, lower[1:].tolist())], make=described.lowered
    )


def rounded(value: float) -> float:
    """Return a length in metres with the three digits that are printed: what is said is run.

    Examples
    --------
    >>> rounded(0.16644), rounded(1.0379)
    (0.166, 1.04)
    """
    return float(f"{value:.3g}")


def _feasible(
    change: _Change, values: Sequence[float], shaking: Shaking
) -> Iterator[tuple[float, DescribedObject]]:
    """Yield values and changed objects up to one that cannot be, or slides."""
    for value in values:
        try:
            changed = change.make(value)
            slides = onset_of(changed, shaking).slides
        except (InputError, ModelError):
            return
        if slides:
            return
        yield value, changed


def _can_be(change: _Change, place: int) -> bool:
    """Return whether a value makes an object that rocks, if it does not slide."""
    try:
        change.make(change.values[place])
    except (InputError, ModelError):
        return False
    return True


def _tried(
    rows: Sequence[tuple[Shaking, Sequence[tuple[float, DescribedObject]]]],
    run: Execution | None,
) -> list[list[_Tried]]:
    """Return what is counted of changed objects."""
    asked = [(each.block, shaking, band_of(each)) for shaking, row in rows for _, each in row]
    ensembles = iter(run_at_demand(asked, multiples=(1.0, MARGIN), run=run))
    tried = []
    for shaking, row in rows:
        made = []
        for value, each in row:
            count, beyond = count_falls(next(ensembles))
            onset = onset_of(each, shaking)
            evidence = evidence_of(
                each,
                onset,
                shaking,
                (count, beyond),
                built_in=False,
                vertical=False,
                friction_known=True,
            )
            rests = onset.stands and not onset.margin_lifts
            sure = rests or beyond.band[1] < evidence.target
            made.append(
                _Tried(
                    value=value,
                    share=0.0 if onset.stands else count.share,
                    beyond=beyond.share,
                    is_shown=sure and decide(evidence).verdict in ("green", "stands"),
                    friction=onset.friction.largest,
                )
            )
        tried.append(made)
    return tried


def _first(tried: Sequence[_Tried], target: float | None) -> int:
    """Return the place from which all pass a target; without one, from which all are shown to."""
    place = len(tried)
    while place and (
        tried[place - 1].is_shown if target is None else tried[place - 1].passes(target)
    ):
        place -= 1
    return place


def _finer(tried: Sequence[_Tried], target: float | None) -> list[float]:
    """Return values between the last that does not pass and the first that does."""
    place = _first(tried, target)
    if not 0 < place < len(tried):
        return []
    low, high = tried[place - 1].value, tried[place].value
    values = map(rounded, np.linspace(low, high, FINER + 1)[1:-1].tolist())
    return [value for value in values if low < value < high]


def _remedy(
    change: _Change, coarse: Sequence[_Tried], fine: Sequence[_Tried], target: float
) -> Remedy:
    """Return the least change of a kind."""
    tried = sorted([*coarse, *fine], key=lambda each: each.value)
    place, shown = _first(tried, target), _first(tried, None)
    best = tried[place] if 0 < place < len(tried) else None
    proof = tried[shown] if 0 < shown < len(tried) else None
    below = [
        (each.value, each.passes(target))
        for each in coarse[1 : _first(coarse, target)]  # the object as it is, is no change
    ]
    islands = [
        (values[0], values[-1])
        for passes, group in itertools.groupby(below, key=itemgetter(1))
        if passes and (values := [value for value, _ in group])
    ]
    needs = [each.friction for each in (best, proof) if each is not None]
    return Remedy(
        change=change.name,
        unit="m",
        value=None if best is None else best.value,
        share=None if best is None else best.share,
        share_1_1=None if best is None else best.beyond,
        shown_at=None if proof is None else proof.value,
        islands=tuple(islands),
        last=coarse[-1].value,
        slides=len(coarse) < len(change.values) and _can_be(change, len(coarse)),
        friction_needed=max(needs) if needs else None,
    )
