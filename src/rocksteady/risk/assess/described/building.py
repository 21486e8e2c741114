"""Buildings: the floors on which objects stand, from a file, and the motions that they have."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import msgspec

from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds, Whole, nonempty_text
from rocksteady.model.checks.validation import whole_number
from rocksteady.model.motions.floor import DAMPING, LARGEST_SUM, SHAPE, Floor
from rocksteady.model.motions.oscillator import DEFAULT_DAMPING
from rocksteady.risk.assess.described.objects import DescribedObject, floor_number
from rocksteady.risk.observations.files.csv_table import refuse_doubled
from rocksteady.risk.observations.files.toml_tables import TomlTables, in_file
from rocksteady.risk.screens.floors import PERIOD
from rocksteady.small_files import content_of, toml_of

HINT = "name a file of buildings in TOML"
STOREYS = Whole(1, 200, "give the number of floors above the ground")
PARTICIPATION = Bounds(0.0, LARGEST_SUM, "(]", SHAPE.hint)


class BuildingTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A building of a file: its first mode, or its modes."""

    name: str
    storeys: int
    period_s: float | None = None
    participation: float | None = None
    frequencies_hz: list[float] | None = None
    shapes: list[list[float]] | None = None
    damping: float | list[float] = DEFAULT_DAMPING
    rooms: dict[str, int] = {}


class BuildingsInput(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The whole file."""

    buildings: list[BuildingTable]


KINDS_OF_MODES = {"period_s": 1, "participation": 1, "frequencies_hz": 2, "shapes": 2}
"""Keys that describe the modes, in two ways."""

FILE = TomlTables(
    kinds={"": BuildingsInput, "buildings": BuildingTable},
    needs="a file has one [[buildings]] or more, with name, storeys and period_s",
    lists=("buildings",),
)


@checked
@dataclass(frozen=True, kw_only=True)
class Building:
    """A building and its floors.

    Parameters
    ----------
    name
        Its name.
    floors
        Modes of each floor above the ground, the lowest first.
    rooms
        Number of the floor of each room that has a name; 0 is the ground.

    Raises
    ------
    InputError
        If there is no floor, or a room lies on none of them.

    Examples
    --------
    >>> museum = Building.of_first_mode("museum", storeys=3, period_s=0.6, rooms={"hall": 1})
    >>> print(museum.floor("hall").label)
    floor of 1.667 Hz, damping 5 %, shape 0.4286
    """

    name: Annotated[str, nonempty_text]
    floors: Sequence[Floor]
    rooms: Mapping[str, int] = field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        """Validate."""
        if not self.floors:
            raise InputError("floors", [], "a building has one floor or more", "give a Floor")
        object.__setattr__(self, "floors", tuple(self.floors))
        for room, place in self.rooms.items():
            hint = "give the number of its floor; 0 is the ground"
            if room.strip() != room or floor_number(room) is not None:
                words = "it must be a name, without a number alone and spaces at its ends"
                raise InputError("rooms", room, words, "name it, as hall 2")
            whole_number(f"rooms: {room}", place, at_least=0, at_most=len(self.floors), hint=hint)

    @classmethod
    @checked
    def of_first_mode(
        cls,
        name: Annotated[str, nonempty_text],
        *,
        storeys: Annotated[int, STOREYS],
        period_s: Annotated[float, PERIOD],
        damping: Annotated[float, DAMPING] = DEFAULT_DAMPING,
        participation: Annotated[float | None, PARTICIPATION] = None,
        rooms: Mapping[str, int] | None = None,
    ) -> "Building":
        """Return a building of equal storeys whose one mode is a straight line over its height.

        Parameters
        ----------
        name, rooms
            As for `Building`.
        storeys
            Floors above the ground, from 1 to 200.
        period_s
            Natural period of the mode [s].
        damping
            Over the critical one.
        participation
            Participation factor times mode shape at the roof; default 3 n/(2 n + 1) of n equal
            masses.

        Raises
        ------
        InputError
            If a number is outside its range.
        """
        roof = 3.0 * storeys / (2.0 * storeys + 1.0) if participation is None else participation
        floors = [
            Floor(frequencies_hz=1.0 / period_s, damping=damping, shapes=roof * place / storeys)
            for place in range(1, storeys + 1)
        ]
        return cls(name=name, floors=floors, rooms=rooms or {})

    def storey(self, place: int | str) -> int:
        """Return the number of the floor of a number or of a room; 0 is the ground.

        Raises
        ------
        InputError
            If the building has no such floor and no such room.
        """
        text = str(place).strip()
        number = self.rooms.get(text)
        if number is None:
            number = floor_number(text)
        if number is None or number > len(self.floors):
            rooms = f", or a room: {', '.join(self.rooms)}" if self.rooms else ""
            raise InputError(
                "floor",
                place,
                f"{self.name} has the floors 0 to {len(self.floors)}{rooms}",
                "give one of them",
            )
        return number

    def floor(self, place: int | str) -> Floor | None:
        """Return the floor of a number or of a room; None of the ground.

        Raises
        ------
        InputError
            As for `storey`.
        """
        number = self.storey(place)
        return self.floors[number - 1] if number else None


@checked
def read_buildings(path: Path | str) -> tuple[Building, ...]:
    r"""Read a file of buildings in TOML.

    Parameters
    ----------
    path
        The file: one ``[[buildings]]`` or more with ``name``, ``storeys`` and either ``period_s``
        (of a straight mode shape, with ``participation`` at the roof) or ``frequencies_hz`` and
        ``shapes``, a list for each mode with a number for each floor above the ground; ``damping``
        and ``rooms``, the number of the floor of each room.

    Returns
    -------
    tuple of Building
        In the order of the file.

    Raises
    ------
    InputError, ModelError
        If it cannot be read, a key is unknown, missing or given twice over, a value is out of
        range, or two buildings have one name; the line names file, building and key.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> text = '[[buildings]]\nname = "museum"\nstoreys = 3\nperiod_s = 0.6\n'
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder, "museum.toml")
    ...     _ = file.write_text(text, "utf-8")
    ...     (museum,) = read_buildings(file)
    >>> print(museum.floor(3).label)
    floor of 1.667 Hz, damping 5 %, shape 1.286
    """
    file = Path(path)
    source = file.name
    values = toml_of(content_of(file, "buildings", HINT), source)
    given = FILE.convert(values, BuildingsInput, source)
    if not given.buildings:
        raise InputError(source, Words("has no building"), FILE.needs, "add [[buildings]]")
    places: dict[str, str] = {}
    made = []
    for number, table in enumerate(given.buildings, 1):
        place = f"{source}: [[buildings]] {number}"
        with in_file(place):
            made.append(_building(table))
        refuse_doubled(place, "name", table.name, places, "give each building its own")
    return tuple(made)


def _building(table: BuildingTable) -> Building:
    """Return a building of a table."""
    given = [key for key in KINDS_OF_MODES if getattr(table, key) is not None]
    kinds = {KINDS_OF_MODES[key] for key in given}
    if len(kinds) != 1 or not {"period_s", "shapes"} & {*given}:
        key = given[-1] if given else "period_s"
        raise ModelError(
            key,
            getattr(table, key) if given else Words("is missing"),
            "a building has one mode by period_s or frequencies_hz with shapes",
            "give one of the two",
        )
    if table.period_s is not None:
        return Building.of_first_mode(
            table.name,
            storeys=table.storeys,
            period_s=table.period_s,
            damping=table.damping,  # type: ignore[arg-type]  # checked there
            participation=table.participation,
            rooms=table.rooms,
        )
    shapes, hertz = table.shapes or [], table.frequencies_hz or []
    if len(shapes) != len(hertz) or any(len(shape) != table.storeys for shape in shapes):
        raise InputError(
            "shapes",
            shapes,
            f"there must be {len(hertz)} lists of {table.storeys} numbers",
            "give a list for each frequency, with a number for each floor above the ground",
        )
    floors = [
        Floor(frequencies_hz=hertz, damping=table.damping, shapes=storey)
        for storey in zip(*shapes, strict=True)
    ]
    return Building(name=table.name, floors=floors, rooms=table.rooms)


def floor_of(described: DescribedObject, buildings: Sequence[Building]) -> tuple[int, Floor | None]:
    """Return number and floor on which an object stands; 0 and None of the ground.

    Raises
    ------
    InputError, ModelError
        If its building is not among those given, or has no such floor.
    """
    given = described.given
    if given.floor is None and given.building is None:
        return 0, None
    names = [building.name for building in buildings]
    wanted = names[0] if given.building is None and len(names) == 1 else given.building
    with in_file(described.source):
        if given.demand.place == "floor":
            raise ModelError(
                "[demand] place",
                "floor",
                "of an object in a building the demand is that of the ground",
                "leave it out, or leave out building and floor",
            )
        if not names:
            key = "building" if given.floor is None else "floor"
            raise ModelError(
                key,
                getattr(given, key),
                "a floor moves as its building does, and none is given",
                "give a file of buildings, as --buildings museum.toml",
            )
        if wanted not in names:
            raise InputError(
                "building",
                Words("is missing") if wanted is None else wanted,
                f"the buildings given are {', '.join(names)}",
                "name one of them",
            )
        building = buildings[names.index(wanted)]
        storey = building.storey("" if given.floor is None else given.floor)
    return storey, building.floor(storey)
