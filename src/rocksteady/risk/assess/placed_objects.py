"""Objects at their places, each with motions that have the peaks of its demand."""

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.motions.floor import Floor
from rocksteady.risk.assess.described.building import Building, floor_of
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.risk.counted.built_in import make_built_in_suite
from rocksteady.risk.counted.motions import Motion, distinct, has_vertical
from rocksteady.risk.counted.suite import Demanded, Peaks, Shaking, Suite
from rocksteady.risk.observations.files.toml_tables import in_file, named
from rocksteady.risk.spectra.design_spectrum import DesignSpectrum
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
    motions: Sequence[Motion] | Suite | None,
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
        if isinstance(things, Sequence) and not len(things):
            raise InputError(name, [], "there must be one or more", "give a list")
    suite = motions if isinstance(motions, Suite) else make_built_in_suite()
    if motions is not None and not isinstance(motions, Suite):
        grounds_of(list(motions))  # refused where one is no record
        kept = distinct(motions)
        suite = Suite(motions=kept, copies=len(motions) - len(kept))
    made: dict[tuple[Floor | None, Demanded, float], Shaking] = {}
    standing, shakings, plain = [], [], []

    def shaken(stood: Floor | None, demand: Demanded, vertical_g: float) -> Shaking | None:
        if vertical_g and not any(map(has_vertical, suite.motions)):
            return None
        key = stood, demand, vertical_g
        if key not in made:
            made[key] = suite.at(demand, floor=stood, vertical_g=vertical_g, stretch=stretch)
        return made[key]

    for each in objects:
        demand = demand_of(each, built_in=suite.built_in)
        if isinstance(demand, DesignSpectrum) and not stretch:
            raise ModelError(
                "stretch", stretch, "records are placed on a spectrum by a stretch", "leave it out"
            )
        storey, stated = floor_of(each, buildings)
        stood = stated if stated is not None or each.given.floor is not None else floor
        vertical_g = each.given.demand.vertical_g
        shaking = shaken(stood, demand, vertical_g)
        beside = shaken(stood, demand, 0.0) if vertical_g else None
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


def demand_of(described: DescribedObject, *, built_in: bool = False) -> Demanded:
    """Return the demand of an object: its spectrum, or its peaks where both are stated.

    Raises
    ------
    InputError, ModelError
        If it states none, one peak alone and there are no records, or a spectrum that motions
        cannot be placed on.
    """
    if described.is_on_spectrum and described.spectrum is not None:
        with in_file(described.source, "demand"):
            return DesignSpectrum(table=described.spectrum, pga_g=described.given.demand.pga_g)
    peaks = {"pga_g": described.pga_g, "pgv_m_s": described.given.demand.pgv_m_s}
    missing = [key for key, value in peaks.items() if value is None]
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
    return Peaks(**peaks)


def with_demand(described: DescribedObject, demand: Demanded | None) -> DescribedObject:
    """Return an object with the demand of all where it states none of its own.

    Raises
    ------
    ModelError
        If there is none at all.
    """
    given = described.given.demand
    stated = (given.pga_g, given.pgv_m_s, described.spectrum)
    if any(each is not None for each in stated):
        return described
    if demand is None:
        raise ModelError(
            "demand",
            Words(f"is missing of {described.name}"),
            "objects are assessed at peaks of the ground, or on a spectrum",
            "give rs.risk.Peaks(pga_g=0.3)",
        )
    if isinstance(demand, DesignSpectrum):
        return described.on_spectrum(demand)
    return described.with_peaks(pga_g=demand.pga_g, pgv_m_s=demand.pgv_m_s)
