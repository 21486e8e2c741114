"""Tables and keys of a facade file, as msgspec validates them."""

from typing import Literal

import msgspec

from rocksteady.risk.observations.files.toml_tables import TomlTables


class FacadeTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The facade itself; what is left out has the default of `Facade`."""

    name: str
    kind: Literal["wall", "parapet", "pinnacle", "gable"] = "wall"
    thickness_m: float
    height_m: float
    length_m: float | None = None
    unit_weight_kn_m3: float | None = None
    hinge_inset_m: float | None = None
    confidence_factor: float | None = None
    knowledge_level: Literal["LC1", "LC2", "LC3"] | None = None
    one_sided: bool | None = None
    restitution: float | str | None = None
    base_height_m: float | None = None
    elastic_modulus_mpa: float | None = None
    elastic_period_s: float | None = None


class LoadTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A weight that the facade carries."""

    name: str
    weight_kn: float
    x_m: float
    z_m: float
    until_collapse: bool | None = None
    lost_at_m: float | None = None


class MassTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A mass that pushes the facade and does not weigh on it."""

    name: str
    weight_kn: float
    z_m: float


class ForceTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A tie or a thrust."""

    name: str
    force_kn: float
    z_m: float
    until_collapse: bool | None = None
    lost_at_m: float | None = None


class SpectrumKeys(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Demand of a limit state: numbers of the elastic spectrum, or a table."""

    ag_g: float | None = None
    f0: float | None = None
    tc_star_s: float | None = None
    soil: Literal["A", "B", "C", "D", "E"] | None = None
    topography: float | str | None = None
    soil_factor: float | None = None
    cc: float | None = None
    table: str | None = None
    damping: float | None = None


class DemandTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Demand of each limit state."""

    sld: SpectrumKeys | None = None
    slv: SpectrumKeys | None = None
    slc: SpectrumKeys | None = None


class FacadeInput(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The whole file."""

    facade: FacadeTable
    loads: list[LoadTable] = []
    masses: list[MassTable] = []
    ties: list[ForceTable] = []
    thrusts: list[ForceTable] = []
    demand: DemandTable = DemandTable()


FILE = TomlTables(
    kinds={
        "": FacadeInput,
        "facade": FacadeTable,
        "loads": LoadTable,
        "masses": MassTable,
        "ties": ForceTable,
        "thrusts": ForceTable,
        "demand": DemandTable,
        "demand.sld": SpectrumKeys,
        "demand.slv": SpectrumKeys,
        "demand.slc": SpectrumKeys,
    },
    needs="a file has a [facade] with name, thickness_m and height_m",
    lists=("loads", "masses", "ties", "thrusts"),
)
