"""Tables and keys of an object file, as msgspec validates them."""

from collections.abc import Iterator
from typing import Literal

import msgspec

from rocksteady.risk.counted.verdict import Target

USUAL = Target(0.1)
"""Target of an object that states none."""


class Range(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A value that is known between two bounds."""

    low: float
    high: float

    @property
    def middle(self) -> float:
        """The mean of both bounds."""
        return 0.5 * (self.low + self.high)


Value = float | Range
"""A number, or one between two bounds."""


class Geometry(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Shape and mass of the object itself."""

    width_m: Value | None = None
    height_m: Value | None = None
    base_width_m: Value | None = None
    offset_m: Value | None = None
    left_m: Value | None = None
    right_m: Value | None = None
    mass_centre_height_m: Value | None = None
    gyration_m: Value | None = None
    inertia_kg_m2: Value | None = None
    mass_kg: Value | None = None
    alpha_rad: Value | None = None
    alpha_deg: Value | None = None
    p_rad_s: Value | None = None
    columns: int | None = None
    cap_mass_ratio: Value | None = None


class Content(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the object holds, as one mass that does not move in it."""

    mass_kg: Value
    mass_centre_height_m: Value


class ObjectSpectrum(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A response spectrum of the floor or the ground."""

    period_s: tuple[float, ...]
    sa_g: tuple[float, ...]
    damping: float


class ObjectDemand(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Shaking that the object is checked for."""

    pga_g: float | None = None
    pgv_m_s: float | None = None
    place: Literal["ground", "floor"] = "ground"
    vertical_g: float = 0.0
    vertical_share: float = 1.0
    spectrum: str | ObjectSpectrum | None = None


class OwnState(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A damage state of the user's: theta/alpha above a peak."""

    name: str
    peak: float


class Options(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How the object is assessed."""

    damage_states: tuple[str | OwnState, ...] | None = None
    target_probability: float | None = None
    target_50_years: float | None = None
    draws: int = 5
    records: str | None = None


class ObjectInput(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The whole file."""

    name: str
    geometry: Geometry
    kind: str = "other"
    building: str | None = None
    floor: int | str | None = None
    friction: Value | None = None
    restitution: str | Value = "housner"
    against_wall: bool = False
    fixed_parts: bool = False
    gravity_m_s2: float = 9.80665
    content: Content | None = None
    demand: ObjectDemand = ObjectDemand()
    assessment: Options = Options()

    @property
    def parts(self) -> str:
        """What is one body if `fixed_parts` is true."""
        if self.geometry.columns is not None:
            return "pier and point cap" if self.geometry.columns == 1 else "each column"
        return "all parts" if self.content is None else "object and content"


TABLES: dict[str, type[msgspec.Struct]] = {
    "": ObjectInput,
    "geometry": Geometry,
    "content": Content,
    "demand": ObjectDemand,
    "demand.spectrum": ObjectSpectrum,
    "assessment": Options,
}
"""Class of each table of the file by its name; "" is what stands above the first table."""


def target_of(options: Options) -> Target:
    """Return the target that is given; else the usual one."""
    if options.target_50_years is not None:
        return Target(options.target_50_years, years=50.0)
    return USUAL if options.target_probability is None else Target(options.target_probability)


def inline_keys(table: str) -> tuple[str, ...]:
    """Return the keys of an inline table: of a damage state, or of a range."""
    return ("name", "peak") if "damage_states" in table else ("low", "high")


def numbers_of(given: msgspec.Struct, table: str = "") -> Iterator[tuple[str, str, object]]:
    """Yield table, key and value of what the file gives as a number, a range or a list of them."""
    for key in given.__struct_fields__:
        value = getattr(given, key)
        if isinstance(value, msgspec.Struct) and not isinstance(value, Range):
            yield from numbers_of(value, f"{table}.{key}" if table else key)
        elif isinstance(value, tuple):
            for each in value:
                if isinstance(each, OwnState):
                    yield table, "peak", each.peak
                elif not isinstance(each, str):
                    yield table, key, each
        elif isinstance(value, float | int | Range) and not isinstance(value, bool):
            yield table, key, value


def own_states(options: Options) -> list[tuple[str, float | None]]:
    """Return the names of the damage states that are given, with the peak of the user's own."""
    return [
        (each.name, each.peak) if isinstance(each, OwnState) else (each, None)
        for each in options.damage_states or []
    ]
