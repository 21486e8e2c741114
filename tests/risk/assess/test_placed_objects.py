"""The total of a table's progress is what is run."""

import pytest

from rocksteady import Execution
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.synthetic_suite import make_synthetic_suite
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.risk.assess.objects_table import assess_objects
from rocksteady.risk.assess.placed_objects import place_objects, with_demand

FEW = {"draws": 2, "levels": 6}
SLENDER = {"width_m": 0.2, "height_m": 1.2}
RECORDS = make_synthetic_suite(3)
LIFTED = BaseMotion(RECORDS[0], RECORDS[1].scaled(0.3))


def described(name: str, **more: object) -> DescribedObject:
    given = {"name": name, "geometry": SLENDER, "assessment": FEW, **more}
    return DescribedObject(values=given)


@pytest.mark.parametrize("motions", [RECORDS, [LIFTED, *RECORDS[1:]]])
def test_cells_are_those_that_run_and_what_slides_has_none(
    motions: list[Record | BaseMotion],
) -> None:
    demand = {"pga_g": 0.3, "pgv_m_s": 0.4}
    objects = [
        described("vase"),
        described("leaning", geometry=SLENDER | {"offset_m": 0.02}),
        described("fixed", restitution=0.9, demand=demand),
        described("smooth", friction=0.1),
    ]
    passed: list[int] = []
    run = Execution(progress=passed.append)
    assess_objects(objects, motions, pga_g=0.4, pgv_m_s=0.45, run=run)
    asked = [with_demand(each, 0.4, 0.45) for each in objects]
    assert sum(passed) == place_objects(asked, motions).cells
    assert place_objects([objects[-1].with_peaks(**demand)], motions).cells == 0
