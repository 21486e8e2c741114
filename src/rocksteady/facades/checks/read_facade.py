"""Facade files in TOML: a wall, parapet or gable, what acts on it, and the demand."""

import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Final, TypeVar

import msgspec

from rocksteady.errors import InputError, ModelError, RocksteadyError, Words
from rocksteady.facades.checks.actions import Load, PushingMass, Thrust, Tie
from rocksteady.facades.checks.facade import KNOWLEDGE_LEVELS, Facade
from rocksteady.facades.checks.facade_demand import DemandSpectrum, FacadeDemand
from rocksteady.facades.checks.facade_schema import (
    FILE,
    FacadeInput,
    FacadeTable,
    SpectrumKeys,
)
from rocksteady.facades.checks.spectrum_table import read_spectrum_table
from rocksteady.model.blocks.housner_forms import VALID_TEXT, form_of_text
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import nonempty_text
from rocksteady.results.result import Result
from rocksteady.risk.observations.files.toml_tables import named
from rocksteady.risk.spectra.elastic_spectrum import ElasticSpectrum
from rocksteady.small_files import content_of, toml_of

Made = TypeVar("Made")

HINT: Final = "name a file of one facade in TOML"

EXAMPLE: Final = Path(__file__).with_name("example_facade.toml")
"""The facade of ``rocksteady facade --example``, of our own making."""


@checked
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class DescribedFacade(Result):
    """A facade and its demand, from a file that `rocksteady.read_facade` has read.

    Attributes
    ----------
    facade
        The facade.
    demand
        Spectra of the limit states that the file gives.
    source
        Name of the file.
    sha256
        Hash of the file.
    files
        The file, and the tables of spectra that it names.

    Examples
    --------
    >>> from rocksteady.codes import ElasticSpectrum, Facade, FacadeDemand
    >>> wall = Facade(name="front", thickness_m=0.4, height_m=4.0)
    >>> site = ElasticSpectrum(ag_g=0.2, f0=2.5, tc_star_s=0.3, soil="B")
    >>> DescribedFacade(facade=wall, demand=FacadeDemand(slv=site))
    <DescribedFacade: front: wall 0.4 x 4 m>
    """

    facade: Facade
    demand: FacadeDemand
    source: Annotated[str, nonempty_text] = "facade"
    sha256: str | None = None
    files: tuple[Path, ...] = ()


@checked
def read_facade(path: Path | str) -> DescribedFacade:
    """Read a facade file in TOML.

    Parameters
    ----------
    path
        The file: a table ``[facade]`` with the keys of `Facade`, or ``knowledge_level`` in place of
        ``confidence_factor``; any number of ``[[loads]]``, ``[[masses]]``, ``[[ties]]`` and
        ``[[thrusts]]``, all but masses with ``until_collapse`` or ``lost_at_m`` if wanted;
        ``[demand.sld]``, ``[demand.slv]`` and ``[demand.slc]`` with the keys of `ElasticSpectrum`,
        or ``table``, a file beside it as `read_spectrum_table` reads it, and ``damping``.

    Returns
    -------
    DescribedFacade
        Checked.

    Raises
    ------
    InputError, ModelError
        If it cannot be read, is empty, no TOML or not in UTF-8; if a key is unknown, missing or
        given twice over, or a value is of another type or out of range; the line names file, table
        and key.

    Examples
    --------
    >>> from rocksteady.facades.checks.read_facade import EXAMPLE
    >>> example = read_facade(EXAMPLE)
    >>> print(f"{example.facade.mechanism.a0_g:.4f} g", example.demand.given)
    0.1171 g ('SLD', 'SLV', 'SLC')
    """
    file = Path(path)
    content = content_of(file, "facade", HINT)
    source = file.name
    values = toml_of(content, source)
    if not values:
        raise InputError(
            source, Words("is empty"), FILE.needs, "write [facade], name, thickness_m and height_m"
        )
    given = FILE.convert(values, FacadeInput, source)
    return DescribedFacade(
        facade=_facade(given, source),
        demand=_demand(given, source, file.parent),
        source=source,
        sha256=hashlib.sha256(content).hexdigest(),
        files=(file, *_tables(given, file.parent)),
    )


def _facade(given: FacadeInput, source: str) -> Facade:
    """Return the facade; a refusal names the file."""
    kinds: Mapping[str, Callable[..., Any]] = {
        "loads": Load,
        "masses": PushingMass,
        "ties": Tie,
        "thrusts": Thrust,
    }
    acting = {
        name: [
            _made(kind, _given(each), f"{source}: [[{name}]] {place}: ")
            for place, each in enumerate(getattr(given, name), 1)
        ]
        for name, kind in kinds.items()
    }
    table = given.facade
    keys = _given(table)
    keys.pop("knowledge_level", None)
    _add_factor(keys, table, source)
    if isinstance(table.restitution, str):
        keys["restitution"] = _form(table.restitution, source)
    return _made(Facade, {**keys, **acting}, f"{source}: [facade] ")


def _add_factor(keys: dict[str, Any], table: FacadeTable, source: str) -> None:
    """Add the confidence factor of a level of knowledge."""
    if table.knowledge_level is None:
        return
    if table.confidence_factor is not None:
        raise ModelError(
            f"{source}: [facade]",
            Words("has both knowledge_level and confidence_factor"),
            "a level of knowledge has its factor: LC1 1.35, LC2 1.2, LC3 1.0",
            "leave one of the two out",
        )
    keys["confidence_factor"] = KNOWLEDGE_LEVELS[table.knowledge_level]


def _form(text: str, source: str) -> Any:
    """Return the form of Housner's restitution that a text is."""
    name = named(source, "facade", "restitution")
    try:
        form = form_of_text(text)
    except InputError as error:
        raise InputError(name, text, error.valid, error.hint) from None
    if form is None:
        raise InputError(name, text, VALID_TEXT, "leave it out for 'housner'")
    return form


def _demand(given: FacadeInput, source: str, folder: Path) -> FacadeDemand:
    """Return the spectrum of each limit state."""
    states = {name: getattr(given.demand, name) for name in given.demand.__struct_fields__}
    spectra = {
        name: _spectrum(keys, source, f"demand.{name}", folder)
        for name, keys in states.items()
        if keys is not None
    }
    return _made(FacadeDemand, spectra, f"{source}: [demand] ")


def _tables(given: FacadeInput, folder: Path) -> list[Path]:
    """Return the tables of spectra that a file names."""
    states = [getattr(given.demand, name) for name in given.demand.__struct_fields__]
    return [folder / keys.table for keys in states if keys is not None and keys.table is not None]


def _spectrum(keys: SpectrumKeys, source: str, table: str, folder: Path) -> DemandSpectrum:
    """Return the spectrum of a limit state."""
    given = _given(keys)
    if keys.table is not None:
        _refuse_beside(given, ("table", "damping"), source, table)
        if not keys.table.strip() or "\0" in keys.table:
            name = named(source, table, "table")
            raise InputError(name, keys.table, "it must be a file", "name a table in CSV")
        file = folder / keys.table
        place = f"{source}: [{table}] "
        return _made(read_spectrum_table, {"path": file, "spectrum_damping": keys.damping}, place)
    if keys.damping is not None:
        raise ModelError(
            named(source, table, "damping"),
            Words("goes with a table alone"),
            "the elastic spectrum has 8 % of SLV and 10 % of SLC by itself",
            "leave it out, or name a table",
        )
    for key in ("ag_g", "f0", "tc_star_s"):
        if key not in given:
            raise ModelError(
                named(source, table, key),
                Words("is missing"),
                "a demand is ag_g, f0, tc_star_s and soil, or a table",
                "add it",
            )
    return _made(ElasticSpectrum, given, f"{source}: [{table}] ")


def _refuse_beside(given: Mapping[str, Any], known: Sequence[str], source: str, table: str) -> None:
    """Refuse a key beside a table that it has nothing to do with."""
    for key in given:
        if key not in known:
            raise ModelError(
                named(source, table, key),
                Words("does not go with table"),
                "a demand is ag_g, f0, tc_star_s and soil, or a table",
                f"leave {key} or table out",
            )


def _given(table: msgspec.Struct) -> dict[str, Any]:
    """Return the keys of a table that are given."""
    fields = {key: getattr(table, key) for key in table.__struct_fields__}
    return {key: value for key, value in fields.items() if value is not None}


def _made(kind: Callable[..., Made], keys: Mapping[str, Any], place: str) -> Made:
    """Return a thing; a refusal names the file and the table."""
    try:
        return kind(**keys)
    except RocksteadyError as error:
        raise type(error)(f"{place}{error.name}", error.value, error.valid, error.hint) from None
