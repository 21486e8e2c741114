"""Number of runs of objects, before they are made."""

from collections.abc import Sequence

from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.risk.assess._probability import onset_of
from rocksteady.risk.assess._sensitivity import band_of
from rocksteady.risk.assess.described.building import Building, on_floors
from rocksteady.risk.assess.described.objects import DescribedObject


def count_cells(
    objects: Sequence[DescribedObject],
    motions: Sequence[Record | BaseMotion],
    buildings: Sequence[Building] = (),
    *,
    pga_g: float | None = None,
    pgv_m_s: float | None = None,
) -> int:
    """Return how many runs the ensembles of objects have; an object that slides has none.

    Parameters
    ----------
    objects, motions, buildings, pga_g, pgv_m_s
        As for `assess_objects`.

    Raises
    ------
    InputError, ModelError
        As for `assess_objects`.
    """
    asked = [
        each
        if each.demand.pga_g or each.demand.pgv_m_s
        else each.with_peaks(pga_g=pga_g, pgv_m_s=pgv_m_s)
        for each in objects
    ]
    standing, _ = on_floors(asked, motions, buildings)
    grounds = len(motions) + sum(isinstance(each, BaseMotion) for each in motions)
    count = 0
    for each in standing:
        if not onset_of(each).slides:
            options = each.given.assessment
            ways = grounds * (1 if each.block.symmetric else 2)
            count += ways * options.levels * band_of(each, most=options.draws).draws
    return count
