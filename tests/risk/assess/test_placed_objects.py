"""Objects at their places: whose motions they share, what a floor adds, and missing peaks."""

from typing import Any

import numpy as np
import pytest

from rocksteady import BaseMotion
from rocksteady.errors import InputError, ModelError
from rocksteady.motions import Floor, make_synthetic_suite
from rocksteady.risk import Building, DescribedObject
from rocksteady.risk.assess.placed_objects import demand_of, place_objects, with_demand
from rocksteady.risk.counted.motions import across, has_vertical
from rocksteady.risk.counted.suite import Peaks
from tests.every import every
from tests.risk.counted.recorded import described
from tests.risk.counted.test_suite import peaks_of as measured

SUITE = make_synthetic_suite(5, seed=8)
MUSEUM = Building.of_first_mode("museum", storeys=3, period_s=0.5)
BOTH: dict[str, Any] = {"pga_g": 0.4, "pgv_m_s": 0.45}


def vase(**keys: Any) -> DescribedObject:
    return described(0.15, 0.45, **{**BOTH, **keys})


def test_objects_at_one_demand_on_one_floor_have_the_same_motions() -> None:
    objects = [
        vase(), vase(friction=0.5), vase(pga_g=0.5), vase(floor=1), vase(floor=1), vase(floor=2),
        vase(floor=0), vase(pgv_m_s=None),
    ]  # fmt: skip
    placed = place_objects(objects, SUITE, [MUSEUM])
    kinds = [id(each) for each in placed.shakings]
    groups = [kinds.index(each) for each in kinds]
    assert groups == [0, 0, 2, 3, 3, 5, 0, 7]
    assert [each.storey for each in placed.objects] == [0, 0, 0, 1, 1, 2, 0, 0]
    assert placed.plain == [None] * len(objects)
    assert placed.suite.motions == (*SUITE,)


def test_its_demand_where_it_stands_is_the_largest_of_the_motions_of_its_floor() -> None:
    """The floor answers the ground at its demand, stretched, by its own calculation."""
    placed = place_objects([vase(floor=3), vase(floor=3, pgv_m_s=None), vase()], SUITE, [MUSEUM])
    floor = MUSEUM.floors[2]
    grown = []
    for shaking in placed.shakings[:2]:
        assert shaking is not None
        led = [across(each) for each in shaking.motions]
        ratios = []
        for each in led:
            assert each.ground is not None
            again = floor.motion(each.ground)
            np.testing.assert_allclose(again.acceleration_m_s2, each.acceleration_m_s2)
            ratios.append(np.divide(measured(each), measured(each.ground)))
        grown.append(np.max(ratios, axis=0))
    for standing, ratio in zip(placed.objects, grown, strict=False):
        assert standing.amplified == pytest.approx(tuple(ratio), rel=1e-9)
        assert standing.demand.pga_g == pytest.approx(0.4 * ratio[0], rel=1e-9)
        assert standing.on_floor
    assert not np.allclose(grown[0], grown[1], rtol=1e-3)  # time is stretched for one of them
    assert (placed.objects[2].amplified, placed.objects[2].on_floor) == ((1.0, 1.0), False)


def test_a_floor_is_that_of_the_objects_that_state_none() -> None:
    floor = Floor(frequencies_hz=2.5)
    objects = [vase(), vase(floor=0), vase(floor=1)]
    placed = place_objects(objects, SUITE, [MUSEUM], floor=floor)
    found = []
    for shaking in placed.shakings:
        assert shaking is not None
        first = across(shaking.motions[0])
        found.append(first if first.ground is None else first.ground)
        expected = (floor, None, MUSEUM.floors[0])[len(found) - 1]
        if expected is None:
            assert first.ground is None
        else:
            np.testing.assert_allclose(
                first.acceleration_m_s2, expected.motion(found[-1]).acceleration_m_s2
            )


def test_of_a_demand_with_a_vertical_one_the_motions_that_have_one_stand_apart() -> None:
    lifted = [BaseMotion(each, each.scaled(0.5)) for each in SUITE[:2]]
    one = vase(demand={"vertical_g": 0.1})
    placed = place_objects([one, vase()], [*lifted, *SUITE[2:]])
    first, second = placed.shakings
    assert first is not None
    assert second is not None
    assert [*map(has_vertical, first.motions)] == [True, True]
    assert [*map(has_vertical, second.motions)] == [True, True, False, False, False]
    assert placed.plain == [second, None]
    none = place_objects([one], SUITE)
    assert none.shakings == [None]
    assert none.plain[0] is not None
    assert len(none.plain[0].motions) == len(SUITE)


def test_without_records_there_are_built_in_motions() -> None:
    placed = place_objects([vase()], None)
    assert placed.suite.built_in
    (shaking,) = placed.shakings
    assert shaking is not None
    assert len(shaking.motions) == 59
    assert measured(across(shaking.motions[0])) == pytest.approx((0.4, 0.45), rel=1e-9)


def test_without_stretching_motions_keep_their_time() -> None:
    plain, stretched = (
        place_objects([vase()], SUITE, stretch=stretch).shakings[0] for stretch in (False, True)
    )
    assert plain is not None
    assert stretched is not None
    assert [across(each).dt_s for each in plain.motions] == [each.dt_s for each in SUITE]
    assert [across(each).dt_s for each in stretched.motions] != [each.dt_s for each in SUITE]


@every(
    ("peaks", "built_in", "words"),
    [
        ({}, False, r"[demand] pga_g is missing, and so is pgv_m_s"),
        ({}, True, r"[demand] pga_g is missing, and so is pgv_m_s"),
        ({"pga_g": 0.4}, True, r"[demand] pgv_m_s is missing: built-in motions"),
        ({"pgv_m_s": 0.4}, True, r"[demand] pga_g is missing: built-in motions"),
        ({"pga_g": 0.4}, False, None),
        ({"pgv_m_s": 0.4}, False, None),
        (BOTH, True, None),
    ],
)
def test_peaks_that_are_missing_are_named(
    peaks: dict[str, Any], built_in: bool, words: str | None
) -> None:
    one = described(0.15, 0.45, **peaks)
    motions = None if built_in else SUITE
    if words is None:
        assert demand_of(one, built_in=built_in) == Peaks(**peaks)
        assert place_objects([one], motions).objects[0].given.demand.pga_g == peaks.get("pga_g")
        return
    for ask in (lambda: demand_of(one, built_in=built_in), lambda: place_objects([one], motions)):
        with pytest.raises(ModelError) as error:
            ask()
        assert words in str(error.value)
        assert "\n" not in str(error.value)


def test_a_demand_of_all_is_that_of_objects_that_state_none() -> None:
    bare = described(0.15, 0.45)
    for peaks in (Peaks(pga_g=0.3), Peaks(pgv_m_s=0.2), Peaks(pga_g=0.3, pgv_m_s=0.2)):
        assert demand_of(with_demand(bare, peaks)) == peaks
    # An object's own demand is whole: no peak is added to it.
    some: list[dict[str, Any]] = [{"pga_g": 0.5}, {"pgv_m_s": 0.5}, BOTH]
    for own in some:
        assert demand_of(with_demand(described(0.15, 0.45, **own), peaks)) == Peaks(**own)
    lifted = described(0.15, 0.45, demand={"vertical_g": 0.1})
    assert with_demand(lifted, peaks).given.demand.vertical_g == 0.1
    with pytest.raises(ModelError, match="demand is missing of object"):
        with_demand(bare, None)


def test_there_is_an_object_and_a_motion() -> None:
    for objects, motions, name in (([], SUITE, "objects"), ([vase()], [], "motions")):
        with pytest.raises(InputError, match=rf"{name} = \[\] is not valid: there must be one"):
            place_objects(objects, motions)
