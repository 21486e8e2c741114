"""Families of attractors: one attractor followed over the values of a parameter."""

from collections import Counter
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats, Integers
from rocksteady.dynamics.basins.labels import BasinAttractor, attractor_names
from rocksteady.dynamics.basins.over._seeding import Here
from rocksteady.dynamics.basins.over.matching import MatchingOptions, courses, matched
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.model.checks.arguments import checked_result
from rocksteady.outcomes import AttractorKind
from rocksteady.results.result import Result


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class BasinFamily(Result):
    """One attractor followed over the values of a parameter.

    Attributes
    ----------
    label
        Its number in `BasinShares.label`.
    name
        Kind and period that it has at most values, with a letter where several share them.
    attractors
        What it is at each value; None where there is none.
    """

    label: int
    name: str
    attractors: tuple[BasinAttractor | None, ...]

    @property
    def present(self) -> NDArray[np.bool_]:
        """Whether it exists at each value, shape (values,)."""
        return np.array([attractor is not None for attractor in self.attractors])

    @property
    def orbits(self) -> tuple[Orbit | None, ...]:
        """Its orbit at each value; None where there is none."""
        return tuple(
            None if attractor is None else attractor.orbit for attractor in self.attractors
        )

    @property
    def typical(self) -> BasinAttractor:
        """An attractor of the kind and period that it has at most values, the first such."""
        return _typical([attractor for attractor in self.attractors if attractor is not None])

    @property
    def periods(self) -> tuple[int, ...]:
        """The forcing periods that its orbit has, each once; empty without one."""
        return tuple(sorted({orbit.period for orbit in self.orbits if orbit is not None}))


def families_of(
    line: list[Here], matching: MatchingOptions, states: int
) -> tuple[tuple[BasinFamily, ...], Integers]:
    """Return the families of all values, and the label of each state at each value.

    Parameters
    ----------
    line
        What is known at the values, in their order.
    matching
        How orbits become families.
    states
        States of the window; seeds come after them and have no label.
    """
    members: list[dict[int, BasinAttractor]] = []
    latest: dict[int, Floats] = {}
    by_kind: dict[AttractorKind, int] = {}
    labels = np.zeros((len(line), states), dtype=np.int64)
    for place, here in enumerate(line):
        orbits = [attractor for attractor in here.attractors if attractor.orbit is not None]
        sets = [courses(attractor.orbit) for attractor in orbits if attractor.orbit is not None]
        old = list(latest)
        taken = matched(matching, sets, [latest[label] for label in old])
        kept = {
            attractor.label: old[index]
            for attractor, index in zip(orbits, taken, strict=True)
            if index is not None
        }
        kept |= {
            attractor.label: by_kind[attractor.kind]
            for attractor in here.attractors
            if attractor.orbit is None and attractor.kind in by_kind
        }
        for attractor in here.attractors:
            if attractor.label not in kept:
                kept[attractor.label] = len(members)
                members.append({})
                if attractor.orbit is None:
                    by_kind[attractor.kind] = len(members) - 1
            members[kept[attractor.label]][place] = attractor
        if not matching.vanished:
            latest.clear()
        for attractor, where in zip(orbits, sets, strict=True):
            latest[kept[attractor.label]] = where
        renamed = np.array([kept[attractor.label] for attractor in here.attractors], dtype=np.int64)
        labels[place] = renamed[here.label[:states]]
    usual = [_typical(list(attractors.values())) for attractors in members]
    names = list(attractor_names([(attractor.kind, attractor.orbit) for attractor in usual]))
    return tuple(
        BasinFamily(
            label=label,
            name=names[label],
            attractors=tuple(attractors.get(place) for place in range(len(line))),
        )
        for label, attractors in enumerate(members)
    ), labels


def _typical(attractors: list[BasinAttractor]) -> BasinAttractor:
    """Return the first attractor of the kind and period that most of them have."""
    kinds = [(attractor.kind, attractor.period) for attractor in attractors]
    return attractors[kinds.index(Counter(kinds).most_common(1)[0][0])]
