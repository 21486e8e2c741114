"""Objects at their places: the motions of the floor of each, and how many runs they have."""

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.risk.assess._counts import Motions
from rocksteady.risk.assess._probability import onset_of
from rocksteady.risk.assess._sensitivity import band_of
from rocksteady.risk.assess.described.building import Building, on_floors
from rocksteady.risk.assess.described.objects import DescribedObject

PGA = Bounds(0.0, 10.0, "(]", "give the peak in g; 0.3 is usual")
PGV = Bounds(0.0, 10.0, "(]", "give the peak in m/s; 0.4 is usual")


@dataclass(frozen=True, kw_only=True)
class PlacedObjects:
    """Objects with a demand, and the motions of each.

    Attributes
    ----------
    objects
        Each with its demand and the peaks of its floor.
    motions
        A list for each object, the same one on one floor.
    suite
        Motions of the ground.
    seconds
        Time that making the motions of the floors took.
    """

    objects: Sequence[DescribedObject]
    motions: Sequence[Motions]
    suite: Motions
    seconds: float

    @property
    def cells(self) -> int:
        """How many runs the ensembles have; an object that slides has none."""
        grounds = len(self.suite) + sum(isinstance(each, BaseMotion) for each in self.suite)
        count = 0
        for each in self.objects:
            if not onset_of(each).slides:
                options = each.given.assessment
                ways = grounds * (1 if each.block.symmetric else 2)
                count += ways * options.levels * band_of(each, most=options.draws).draws
        return count


def place_objects(
    objects: Sequence[DescribedObject], motions: Motions, buildings: Sequence[Building] = ()
) -> PlacedObjects:
    """Return objects with the motions of their floors, made once a floor.

    Raises
    ------
    InputError, ModelError
        As for `assess_objects`.
    """
    began = time.perf_counter()
    for name, things in (("objects", objects), ("motions", motions)):
        if not things:
            raise InputError(name, [], "there must be one or more", "give a list")
    standing, shaken = on_floors(objects, motions, buildings)
    return PlacedObjects(
        objects=standing,
        motions=shaken,
        suite=[*motions],
        seconds=time.perf_counter() - began,
    )


@checked
def with_demand(
    described: DescribedObject,
    pga_g: Annotated[float | None, PGA],
    pgv_m_s: Annotated[float | None, PGV],
) -> DescribedObject:
    """Return an object with the demand of all where it states none of its own.

    Raises
    ------
    InputError, ModelError
        If a peak is not above 0 or above 10, or there is none at all.
    """
    demand = described.given.demand
    if demand.pga_g is not None or demand.pgv_m_s is not None:
        return described
    if pga_g is None and pgv_m_s is None:
        raise ModelError(
            "pga_g, pgv_m_s",
            Words(f"are both missing of {described.name}"),
            "objects are assessed at a peak velocity, a peak acceleration or both",
            "give the PGV, and the PGA where it is known",
        )
    return described.with_peaks(pga_g=pga_g, pgv_m_s=pgv_m_s)
