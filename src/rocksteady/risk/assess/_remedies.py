"""Remedies: the least change with which an object meets its target, by runs of what it makes."""

import itertools
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Final

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, ModelError
from rocksteady.risk.assess._judging import (
    Judged,
    band_of,
    evidence_of,
    onset_of,
    run_at_demand,
)
from rocksteady.risk.assess._remedy import CHANGES, Remedy
from rocksteady.risk.assess.described.objects import DescribedObject
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
    """A kind of change: its values, and the object that each makes."""

    name: str
    steps: Floats
    make: Callable[[float], DescribedObject]
    value: Callable[[float], float]


@dataclass(frozen=True, kw_only=True)
class _Tried:
    """An object that was changed, and what was counted of it."""

    step: float
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
    pass too, refined by a step of eight parts: shares need not fall with the width.  Values that
    slide are no remedies, nor are larger ones.
    """
    scans = [
        (place, shaking, change)
        for place, (described, shaking) in enumerate(asked)
        for change in _changes(described)
    ]
    objects = [list(_feasible(change, change.steps, shaking)) for _, shaking, change in scans]
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
            (shaking, list(_feasible(change, np.array(steps), shaking)))
            for (_, shaking, change), steps in zip(scans, brackets, strict=True)
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
    factors = [1.0]
    while factors[-1] < WIDEST:
        factors.append(factors[-1] * WIDER)
    yield _Change(
        name=CHANGES[0],
        steps=np.array(factors),
        make=described.wider,
        value=lambda factor: width * factor,
    )
    least, most = (part * centre for part in STEPS)
    step = min(max(LOWER_M, least), most)
    yield _Change(
        name=CHANGES[1],
        steps=step * np.arange(int(LOWEST * centre / step) + 1, dtype=np.float64),
        make=described.lowered,
        value=lambda by: by,
    )


def _feasible(
    change: _Change, steps: Floats, shaking: Shaking
) -> Iterator[tuple[float, DescribedObject]]:
    """Yield steps and changed objects up to one that cannot be, or slides."""
    for step in steps.tolist():
        try:
            changed = change.make(step)
            slides = onset_of(changed, shaking).slides
        except (InputError, ModelError):
            return
        if slides:
            return
        yield step, changed


def _can_be(change: _Change, place: int) -> bool:
    """Return whether a step makes an object that rocks, if it does not slide."""
    try:
        change.make(float(change.steps[place]))
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
        for step, each in row:
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
                    step=step,
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
    """Return steps between the last that does not pass and the first that does."""
    place = _first(tried, target)
    if not 0 < place < len(tried):
        return []
    ends = tried[place - 1].step, tried[place].step
    return np.linspace(*ends, FINER + 1)[1:-1].tolist()  # type: ignore[no-any-return]


def _remedy(
    change: _Change, coarse: Sequence[_Tried], fine: Sequence[_Tried], target: float
) -> Remedy:
    """Return the least change of a kind."""
    tried = sorted([*coarse, *fine], key=lambda each: each.step)
    place, shown = _first(tried, target), _first(tried, None)
    best = tried[place] if 0 < place < len(tried) else None
    proof = tried[shown] if 0 < shown < len(tried) else None
    below = [
        (change.value(each.step), each.passes(target))
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
        value=None if best is None else change.value(best.step),
        share=None if best is None else best.share,
        share_1_1=None if best is None else best.beyond,
        shown_at=None if proof is None else change.value(proof.step),
        islands=tuple(islands),
        last=change.value(coarse[-1].step),
        slides=len(coarse) < len(change.steps) and _can_be(change, len(coarse)),
        friction_needed=max(needs) if needs else None,
    )
