"""The level of an object's demand, for tests of what is run there."""

from collections.abc import Sequence

from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.risk.assess._demand_level import DemandLevel, demand_level
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.seismic.measures.scalar import Measure


def level_of(described: DescribedObject, suite: Sequence[Record | BaseMotion]) -> DemandLevel:
    measure = Measure(described.given.assessment.intensity_measure)
    return demand_level(measure, described.given.demand, suite, described.block, described.source)
