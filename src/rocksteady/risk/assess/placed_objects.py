"""Objects at their places, each with motions that have the peaks of its demand."""

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.motions.floor import Floor
from rocksteady.risk.assess.described.building import Building, floor_of
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.risk.counted.built_in import make_built_in_suite
from rocksteady.risk.counted.suite import Motion, Peaks, Shaking, Suite, distinct, has_vertical
from rocksteady.risk.observations.files.toml_tables import named
from rocksteady.seismic.spectra.grounds import grounds_of


@dataclass(frozen=True, kw_only=True)
class PlacedObjects:
    """Objects with a demand, and the motions of each.

    Attributes
    ----------
    objects
        Each with its demand and the peaks of its floor.
    shakings
        Motions of each at its demand, the same on one floor at one demand; of a demand with a
        vertical motion those that have one, and None where none has.
    plain
        Likewise all motions, of a demand with a vertical motion; else None.
    suite
        Motions of the ground, or built-in ones.
    seconds
        Time that making the motions took.
    """

    objects: Sequence[DescribedObject]
    shakings: Sequence[Shaking | None]
    plain: Sequence[Shaking | None]
    suite: Suite
    seconds: float


def place_objects(
    objects: Sequence[DescribedObject],
    motions: Sequence[Motion] | None,
    buildings: Sequence[Building] = (),
    *,
    floor: Floor | None = None,
    stretch: bool = True,
) -> PlacedObjects:
    """Return objects with motions of their floors that have the peaks of their demands.

    Parameters
    ----------
    objects, motions, buildings, floor, stretch
        As for `assess_objects`.

    Raises
    ------
    InputError, ModelError
        As for `assess_objects`.
    """
    began = time.perf_counter()
    for name, things in (("objects", objects), ("motions", motions)):
        if things is not None and not len(things):
            raise InputError(name, [], "there must be one or more", "give a list")
    if motions is not None:
        grounds_of(list(motions))  # refused where one is no record
    suite = make_built_in_suite()
    if motions is not None:
        kept = distinct(motions)
        suite = Suite(motions=kept, copies=len(motions) - len(kept))
    made: dict[tuple[Floor | None, Peaks, bool], Shaking | None] = {}
    standing, shakings, plain = [], [], []

    def shaken(stood: Floor | None, demand: Peaks, *, lifted: bool) -> Shaking | None:
        key = (stood, demand, lifted)
        if key not in made:
            kept = [each for each in suite.motions if has_vertical(each) or not lifted]
            whole = replace(suite, motions=kept, floor=stood)
            made[key] = whole.at(demand, stretch=stretch) if kept else None
        return made[key]

    for each in objects:
        demand = peaks_of(each, built_in=suite.built_in)
        storey, stated = floor_of(each, buildings)
        stood = stated if stated is not None or each.given.floor is not None else floor
        vertical = each.given.demand.vertical_g > 0.0
        shaking = shaken(stood, demand, lifted=vertical)
        beside = shaken(stood, demand, lifted=False) if vertical else None
        either = shaking or beside
        amplified = (1.0, 1.0) if either is None else either.amplified
        standing.append(replace(each, amplified=amplified, storey=storey))
        shakings.append(shaking)
        plain.append(beside)
    return PlacedObjects(
        objects=standing,
        shakings=shakings,
        plain=plain,
        suite=suite,
        seconds=time.perf_counter() - began,
    )


def peaks_of(described: DescribedObject, *, built_in: bool = False) -> Peaks:
    """Return the peaks of an object's demand.

    Raises
    ------
    ModelError
        If it states none, or one alone and there are no records.
    """
    demand = described.given.demand
    missing = [key for key in ("pga_g", "pgv_m_s") if getattr(demand, key) is None]
    if len(missing) == 2:
        raise ModelError(
            named(described.source, "demand", "pga_g"),
            Words("is missing, and so is pgv_m_s"),
            "runs are counted at a peak acceleration, a peak velocity or both",
            "give the peaks that the object is to stand",
        )
    if missing and built_in:
        raise ModelError(
            named(described.source, "demand", missing[0]),
            Words("is missing"),
            "built-in motions are made of both peaks",
            "give both peaks, or records",
        )
    return Peaks(pga_g=demand.pga_g, pgv_m_s=demand.pgv_m_s)


def with_demand(described: DescribedObject, demand: Peaks | None) -> DescribedObject:
    """Return an object with the demand of all where it states none of its own.

    Raises
    ------
    ModelError
        If there is none at all.
    """
    given = described.given.demand
    if given.pga_g is not None or given.pgv_m_s is not None:
        return described
    if demand is None:
        raise ModelError(
            "demand",
            Words(f"is missing of {described.name}"),
            "objects are assessed at a peak velocity, a peak acceleration or both",
            "give rs.risk.Peaks(pga_g=0.3)",
        )
    return described.with_peaks(pga_g=demand.pga_g, pgv_m_s=demand.pgv_m_s)
