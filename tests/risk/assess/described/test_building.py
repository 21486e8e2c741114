"""Buildings: shapes of a straight mode, files, and objects that have the motion of their floor."""

from pathlib import Path
from typing import Any

import pytest

from rocksteady import assess_object, assess_objects
from rocksteady.errors import InputError, ModelError, RocksteadyError
from rocksteady.motions import Floor, make_synthetic_suite
from rocksteady.risk import Building, DescribedObject, Peaks, read_buildings
from rocksteady.risk.assess.described.building import floor_of
from rocksteady.words.assessment import demand_words

SUITE = make_synthetic_suite(12)
FEW = {"assessment": {"draws": 1}}
MUSEUM = Building.of_first_mode("museum", storeys=3, period_s=0.5, rooms={"attic": 3, "shop": 0})


def standing(name: str, **keys: Any) -> DescribedObject:
    geometry = {"width_m": 0.35, "height_m": 1.7}
    return DescribedObject(values={"name": name, "geometry": geometry, **FEW, **keys})


def test_a_straight_mode_of_equal_masses_has_the_participation_of_its_sums() -> None:
    heights = (1.0, 2.0, 3.0, 4.0, 5.0)
    gamma = sum(heights) / sum(z * z for z in heights)  # sum m z / sum m z^2
    five = Building.of_first_mode("five", storeys=5, period_s=0.8, damping=0.03)
    for place, floor in enumerate(five.floors, 1):
        ((hertz, damping, shape),) = floor.modes
        assert (hertz, damping) == (1.25, 0.03)
        assert shape == pytest.approx(gamma * place, rel=1e-12)


def test_a_file_says_what_the_constructor_does(tmp_path: Path) -> None:
    file = tmp_path / "town.toml"
    file.write_text(
        '[[buildings]]\nname = "museum"\nstoreys = 3\nperiod_s = 0.5\n'
        'rooms = { attic = 3, shop = 0 }\n\n[[buildings]]\nname = "annex"\nstoreys = 2\n'
        "frequencies_hz = [2.5, 7.0]\ndamping = [0.05, 0.02]\nshapes = [[0.7, 1.2], [0.3, -0.2]]\n",
        encoding="utf-8",
    )
    museum, annex = read_buildings(file)
    assert museum == MUSEUM
    assert annex.floor(2) == Floor(
        frequencies_hz=[2.5, 7.0], damping=[0.05, 0.02], shapes=[1.2, -0.2]
    )
    assert [museum.storey(place) for place in (0, "", "ground", "2", "attic", "shop")] == [
        *(0, 0, 0, 2, 3, 0)
    ]
    assert museum.floor("shop") is None
    assert museum.storey(" 2.0 ") == 2  # as a spreadsheet writes it
    with pytest.raises(InputError, match="must be a name"):
        Building.of_first_mode("house", storeys=2, period_s=0.3, rooms={"2": 1})
    with pytest.raises(InputError, match="rooms: 1 = 1 is not valid: it must be a text"):
        Building.of_first_mode("house", storeys=2, period_s=0.3, rooms={1: 2})  # type: ignore[dict-item]


def test_an_object_on_a_floor_is_one_on_the_motions_of_that_floor() -> None:
    """Led there by hand; with one peak of the ground, which motions of a floor keep."""
    floors = [None, MUSEUM.floors[0], MUSEUM.floors[2]]
    objects = [standing(f"statue {k}", floor=k, building="museum") for k in (0, 1, 3)]
    found = assess_objects(objects, SUITE, buildings=[MUSEUM], demand=Peaks(pga_g=0.25))
    for row, floor in zip(found.rows, floors, strict=True):
        moved = [*SUITE] if floor is None else [floor.motion(each) for each in SUITE]
        (alone,) = assess_objects([standing(row["name"])], moved, demand=Peaks(pga_g=0.25)).rows
        for key in ("share", "low", "high", "fall", "runs", "lifted", "verdict", "floor_pga_g"):
            assert row[key] == alone[key], key
    assert [row["storey"] for row in found.rows] == [0, 1, 3]
    fell = [row["fall"] for row in found.rows]
    assert fell == sorted(fell)
    assert fell[-1] > fell[0]


def test_what_the_ground_does_not_lift_a_floor_may() -> None:
    low: dict[str, Any] = {"pga_g": 0.15, "pgv_m_s": 0.2}
    ground, roof = assess_objects(
        [standing("ground", floor=0), standing("roof", floor="attic")],
        SUITE,
        buildings=[MUSEUM],
        demand=Peaks(**low),
    ).rows
    assert (ground["verdict"], ground["by"]) == ("stands", "statics")
    assert roof["by"] == "runs"
    assert roof["lifted"] > 0
    one = standing("roof", floor="attic", demand=low)
    assessment = assess_object(one, SUITE, buildings=[MUSEUM])
    assert (assessment.verdict, assessment.share) == (roof["verdict"], roof["share"])
    assert assessment.described.demand.pga_g == roof["floor_pga_g"] > 0.15
    assert "of ground motion" in demand_words(assessment)


def test_a_place_is_a_floor_and_its_number() -> None:
    attic = MUSEUM.floors[2]
    for keys, place in (
        ({}, (0, None)),
        ({"floor": 0}, (0, None)),
        ({"building": "museum"}, (0, None)),
        ({"floor": "shop"}, (0, None)),
        ({"floor": 3, "building": "museum"}, (3, attic)),
        ({"floor": "attic"}, (3, attic)),
    ):
        assert floor_of(standing("vase", **keys), [MUSEUM]) == place


def test_an_object_may_have_a_demand_of_its_own() -> None:
    own = standing("own", demand={"pga_g": 0.6, "pgv_m_s": 0.7})
    rows = assess_objects(
        [own, standing("of all")], SUITE, demand=Peaks(pga_g=0.1, pgv_m_s=0.1)
    ).rows
    assert [(row["pga_g"], row["pgv_m_s"]) for row in rows] == [(0.6, 0.7), (0.1, 0.1)]
    assert [row["verdict"] for row in rows][1] == "stands"
    assert rows[0]["fall"] > 0
    with pytest.raises(ModelError, match="of of all"):
        assess_objects([own, standing("of all")], SUITE)


@pytest.mark.parametrize(
    ("keys", "buildings", "name", "words"),
    [
        ({"floor": 4}, [MUSEUM], "floor", "the floors 0 to 3, or a room: attic, shop"),
        ({"floor": "cellar"}, [MUSEUM], "floor", "attic, shop"),
        ({"floor": -1}, [MUSEUM], "floor", "0 for the ground"),
        ({"building": "annex", "floor": 1}, [MUSEUM], "building", "the buildings given are museum"),
        ({"floor": 1}, [], "floor", "--buildings"),
        ({"building": "museum"}, [], "building = 'museum'", "--buildings"),
        ({"floor": 1}, [MUSEUM, MUSEUM], "building is missing", "museum"),
        ({"floor": 1, "demand": {"place": "floor"}}, [MUSEUM], "place", "of the ground"),
    ],
)
def test_a_place_that_is_none_is_refused_in_one_line(
    keys: dict[str, Any], buildings: list[Building], name: str, words: str
) -> None:
    with pytest.raises(RocksteadyError) as error:
        assess_objects(
            [standing("vase", **keys)], SUITE, buildings=buildings, demand=Peaks(pga_g=0.3)
        )
    assert name in str(error.value)
    assert words in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "[[buildings]]"),
        ("buildings = []", "has no building"),
        ('[[buildings]]\nname = "a"\nstoreys = 2', "period_s or frequencies_hz"),
        ('[[buildings]]\nname = "a"\nstoreys = 2\nperiod_s = 0', "period_s"),
        ('[[buildings]]\nname = "a"\nstoreys = 2\nperiod_s = 350', "in seconds"),  # of ms
        ('[[buildings]]\nname = "a"\nstoreys = 0\nperiod_s = 1', "storeys"),
        ('[[buildings]]\nname = "a"\nstoreys = 2\nperiod_s = 1\ndamping = 1.0', "damping"),
        ('[[buildings]]\nname = "a"\nstoreys = 2\nperiod_s = 1\nshapes = [[1]]', "one mode"),
        ('[[buildings]]\nname = "a"\nstoreys = 2\nperiod_s = 1\nparticipation = -1', "ticipation"),
        ('[[buildings]]\nname = "a"\nstoreys = 2\nperiod_s = 1\nrooms = { hall = 3 }', "hall"),
        ('[[buildings]]\nname = "a"\nstoreys = 2\nfrequencies_hz = [1]\nshapes = [[1]]', "2 numb"),
        ('[[buildings]]\nname = "a"\nstoreys = 2\nperiods = 1', "did you mean period_s"),
        (2 * '[[buildings]]\nname = "a"\nstoreys = 2\nperiod_s = 1\n', "has it too"),
    ],
)
def test_a_file_that_is_none_is_refused_in_one_line(text: str, words: str, tmp_path: Path) -> None:
    file = tmp_path / "town.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(RocksteadyError) as error:
        read_buildings(file)
    assert words in str(error.value)
    assert "town.toml" in str(error.value)
    assert "\n" not in str(error.value)


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="none"):
        read_buildings(tmp_path / "none.toml")
