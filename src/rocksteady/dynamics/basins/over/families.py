"""Families of attractors: one attractor followed over the values of a parameter."""

from collections import Counter
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rocksteady.dynamics.basins.labels import BasinAttractor, attractor_names
from rocksteady.dynamics.basins.over._seeding import Here
from rocksteady.dynamics.basins.over.matching import BasinMatching, courses, matched
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.model.checks.arguments import checked_result
from rocksteady.outcomes import AttractorKind
from rocksteady.results.description import Description, Fact
from rocksteady.results.result import Result

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


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
        """Whether it is there at each value, shape (values,)."""
        return np.array([one is not None for one in self.attractors])

    @property
    def orbits(self) -> tuple[Orbit | None, ...]:
        """Its orbit at each value; None where there is none."""
        return tuple(None if one is None else one.orbit for one in self.attractors)

    @property
    def typical(self) -> BasinAttractor:
        """An attractor of the kind and period that it has at most values, the first such."""
        return _typical([one for one in self.attractors if one is not None])

    @property
    def periods(self) -> tuple[int, ...]:
        """The forcing periods that its orbit has, each once; empty without one."""
        return tuple(sorted({orbit.period for orbit in self.orbits if orbit is not None}))

    def describe(self) -> Description:
        """Return the name, the kinds and the periods, and at how many values it is there."""
        there = int(self.present.sum())
        kinds = sorted({str(one.kind.value) for one in self.attractors if one is not None})
        facts = [
            Fact("label", self.label, "label"),
            Fact("name", self.name, "name"),
            Fact("kinds", kinds, "kinds"),
            Fact("periods", list(self.periods), "forcing periods"),
            Fact("values", there, "values", f"{there} of {len(self.attractors)}"),
        ]
        return Description(f"{self.name}, at {there} of {len(self.attractors)} values", facts)


def families_of(
    line: list[Here], matching: BasinMatching, states: int
) -> tuple[tuple[BasinFamily, ...], Integers]:
    """Return the families of all values, and the label of each state at each value.

    Parameters
    ----------
    line
        What is known at the values, in their order.
    matching
        How orbits become families.
    states
        Of the window; seeds come after them and have no label.
    """
    members: list[dict[int, BasinAttractor]] = []
    latest: dict[int, Floats] = {}
    by_kind: dict[AttractorKind, int] = {}
    labels = np.zeros((len(line), states), dtype=np.int64)
    for place, here in enumerate(line):
        orbits = [one for one in here.attractors if one.orbit is not None]
        sets = [courses(one.orbit) for one in orbits if one.orbit is not None]
        old = list(latest)
        taken = matched(matching, sets, [latest[label] for label in old])
        kept = {
            one.label: old[index]
            for one, index in zip(orbits, taken, strict=True)
            if index is not None
        }
        kept |= {
            one.label: by_kind[one.kind]
            for one in here.attractors
            if one.orbit is None and one.kind in by_kind
        }
        for one in here.attractors:
            if one.label not in kept:
                kept[one.label] = len(members)
                members.append({})
                if one.orbit is None:
                    by_kind[one.kind] = len(members) - 1
            members[kept[one.label]][place] = one
        if not matching.vanished:
            latest.clear()
        for one, where in zip(orbits, sets, strict=True):
            latest[kept[one.label]] = where
        renamed = np.array([kept[one.label] for one in here.attractors], dtype=np.int64)
        labels[place] = renamed[here.label[:states]]
    usual = [_typical(list(found.values())) for found in members]
    names = list(attractor_names([(one.kind, one.orbit) for one in usual]))
    return tuple(
        BasinFamily(
            label=label,
            name=names[label],
            attractors=tuple(found.get(place) for place in range(len(line))),
        )
        for label, found in enumerate(members)
    ), labels


def _typical(found: list[BasinAttractor]) -> BasinAttractor:
    """Return the first attractor of the kind and period that most of them have."""
    kinds = [(one.kind, one.period) for one in found]
    return found[kinds.index(Counter(kinds).most_common(1)[0][0])]
