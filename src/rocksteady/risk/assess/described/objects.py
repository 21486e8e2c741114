"""One object as its owner describes it: a TOML file, checked, and the blocks that it can be."""

import hashlib
import itertools
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np

from rocksteady.errors import InputError, ModelError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.housner_forms import Restitution, form_of_text
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds, nonempty_text
from rocksteady.results.numbers import number
from rocksteady.results.result import Result
from rocksteady.risk.assess.described._body import Body, body_of, middle
from rocksteady.risk.assess.described._validation import validated
from rocksteady.risk.assess.described.schema import ObjectInput, Range, Value, numbers_of, target_of
from rocksteady.risk.counted.verdict import Target
from rocksteady.risk.observations.files.toml_tables import in_file
from rocksteady.risk.screens.demand import Demand
from rocksteady.risk.screens.friction import least_gravity_g
from rocksteady.risk.spectra.code_spectra import SPECTRUM_DAMPING, formula_of
from rocksteady.risk.spectra.design_spectrum import DesignSpectrum
from rocksteady.risk.spectra.tabulated import TabulatedSpectrum, spectrum_from, tabulated
from rocksteady.small_files import content_of, toml_of

GROUND = ("", "0", "ground")
"""Floors that are the ground."""
BASE = ("width_m", "base_width_m", "left_m", "right_m")
"""Keys of a base."""
UNITS = {
    "_kg_m2": "kg m^2", "_rad_s": "rad/s", "_m": "m", "_kg": "kg", "_rad": "rad", "_deg": "deg",
}  # fmt: skip
"""Unit of a key of geometry or content by its ending."""
FILE_HINT = "name a file of one object in TOML, or a table of objects in CSV"

EXAMPLE = Path(__file__).with_name("example.toml")
"""The object of ``rocksteady assess --example``, of our own making."""


def floor_number(place: str) -> int | None:
    """Return the number of a floor, "2.0" of a spreadsheet too; None of a room."""
    if place in GROUND:
        return 0
    whole = place.removesuffix(".0")
    return int(whole) if whole.isascii() and whole.isdecimal() else None


def key_words(key: str) -> str:
    """Return the key of an object's file in words, with its unit.

    Examples
    --------
    >>> key_words("geometry.mass_centre_height_m"), key_words("content.mass_kg")
    ('mass centre height [m]', 'content mass [kg]')
    >>> key_words("geometry.p_rad_s"), key_words("mass centre")
    ('p [rad/s]', 'mass centre')
    """
    table, _, name = key.rpartition(".")
    ending, unit = next((each for each in UNITS.items() if name.endswith(each[0])), ("", ""))
    words = name.removesuffix(ending).replace("_", " ") + (f" [{unit}]" if unit else "")
    return f"{table} {words}" if table == "content" else words


def parameter_words(key: str) -> str:
    """Return the key of an object's file in words, without its unit.

    Examples
    --------
    >>> parameter_words("geometry.mass_centre_height_m"), parameter_words("mass centre")
    ('mass centre height', 'mass centre')
    """
    return key_words(key).partition(" [")[0]


@dataclass(frozen=True, kw_only=True)
class Variant:
    """An object with one thing changed.

    Attributes
    ----------
    key
        What is changed, as "content.mass_kg".
    label
        The change in words, as "content.mass_kg 20".
    block
        The block that it then is.
    """

    key: str
    label: str
    block: Block


@checked
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class DescribedObject(Result):
    """Geometry, content, friction, restitution, demand and assessment options of an object.

    Parameters
    ----------
    values
        Tables and keys of `docs/guides/objects.md`, as `tomllib` returns them, units in the names.
    source
        Where they come from, for messages; default "object".
    extra
        Further columns of a table of objects, kept and not read.
    sha256
        Hash of the file; none by default.
    amplified
        By how much its floor multiplies PGA and PGV; 1 on the ground.
    storey
        Number of its floor; 0 is the ground.
    spectrum
        Design spectrum; that of ``[demand] spectrum`` by default.

    Attributes
    ----------
    given
        The values as frozen tables, with the default of each key that is left out.

    Raises
    ------
    InputError, ModelError
        If a key is unknown, missing or given twice over, or a value is of another type or out of
        range; the line names source, table and key.

    Examples
    --------
    >>> desk = DescribedObject(
    ...     values={"name": "statue", "geometry": {"width_m": 0.32, "height_m": 1.8}}
    ... )
    >>> print(f"{desk.block.alpha:.4f} rad, {desk.block.p:.4f} rad/s")
    0.1759 rad, 2.8366 rad/s
    >>> DescribedObject(values={"name": "statue", "geometry": {"width_mm": 320, "height_m": 1.8}})
    Traceback (most recent call last):
    ...
    rocksteady.errors.InputError: object: [geometry] width_mm is unknown: the keys of [geometry] \
are width_m, height_m, base_width_m, offset_m, left_m, right_m, mass_centre_height_m, gyration_m, \
inertia_kg_m2, mass_kg, alpha_rad, alpha_deg, p_rad_s, columns, cap_mass_ratio; \
did you mean width_m?
    """

    values: Mapping[str, object]
    source: Annotated[str, nonempty_text] = "object"
    extra: Mapping[str, str] = field(default_factory=dict)
    sha256: str | None = None
    amplified: tuple[float, float] = (1.0, 1.0)
    storey: int = 0
    spectrum: TabulatedSpectrum | None = None
    given: ObjectInput = field(init=False)

    def __post_init__(self) -> None:
        """Validate everything, the ends of every range too."""
        object.__setattr__(self, "given", validated(self.values, self.source))
        if self.spectrum is None:
            object.__setattr__(self, "spectrum", self._own_spectrum())
        block = self.block
        self.variants()
        with in_file(self.source, "demand"):
            least_gravity_g(block, self.demand.vertical_at_peak_g)

    @property
    def name(self) -> str:
        """Name of the object."""
        return self.given.name

    @property
    def on_floor(self) -> bool:
        """Whether its demand is that of the ground below a floor."""
        return self.amplified != (1.0, 1.0)

    @property
    def is_on_spectrum(self) -> bool:
        """Whether its demand is a spectrum: where no peak velocity is stated beside it."""
        return self.spectrum is not None and self.given.demand.pgv_m_s is None

    @property
    def pga_g(self) -> float | None:
        """Peak acceleration of its demand [g], that of its spectrum where none is stated."""
        stated, table = self.given.demand.pga_g, self.spectrum
        return table.peak_g if stated is None and table is not None else stated

    @property
    def label(self) -> str:
        """Name of the object and where it stands, as "vase on floor 2 of museum"."""
        given = self.given
        room = "" if given.floor is None else str(given.floor).strip()
        number = floor_number(room)
        if number == 0:
            return given.name
        where = f"in {room}" if number is None else f"on floor {number}"
        return f"{given.name} {where}{f' of {given.building}' if given.building else ''}"

    @property
    def body(self) -> Body:
        """The object with its content as one body; for a range the middle."""
        return body_of(self.given, self.source)

    @property
    def restitution(self) -> Restitution:
        """Restitution of the block or of the wall: "housner", a number, or the lowest of a band."""
        value = self.given.restitution
        if isinstance(value, str):
            return form_of_text(value) or "housner"  # checked: it is a form
        return value.low if isinstance(value, Range) else value

    @property
    def block(self) -> Block:
        """The block that it is; for a range the middle."""
        return self._made(self.body, self.restitution)

    @property
    def demand(self) -> Demand:
        """The demand where it stands, as the published formulas take it."""
        given, table = self.given.demand, None if self.on_floor else self.spectrum
        pga, pgv = (
            None if peak is None else peak * factor
            for peak, factor in zip((self.pga_g, given.pgv_m_s), self.amplified, strict=True)
        )
        return Demand(
            pga_g=pga,
            pgv_m_s=pgv,
            spectrum=table and np.column_stack([table.periods_s, table.values_g]),
            spectrum_damping=table and table.dampings,
            vertical_g=given.vertical_g,
            vertical_share=given.vertical_share,
        )

    def _own_spectrum(self) -> TabulatedSpectrum | None:
        """Return the spectrum that its values state: a file or a formula, or rows."""
        given = self.given.demand.spectrum
        if given is None:
            return None
        with in_file(self.source, "demand"):
            if isinstance(given, str):
                return spectrum_from(given)
            return tabulated(np.column_stack([given.period_s, given.sa_g]), given.damping)

    def block_of(self, body: Body) -> Block:
        """Return the block of a changed body, with the object's restitution and gravity.

        Off a wall a body that has become too stocky for angular momentum does not rebound.
        """
        try:
            return self._made(body, self.restitution)
        except InputError:
            if not self.given.against_wall:
                raise
            return self._made(body, 0.0)

    @property
    def target(self) -> Target:
        """Share that is accepted; default 10 % of the runs at the demand."""
        return target_of(self.given.assessment)

    def with_target(self, target: Target) -> "DescribedObject":
        """Return the object with another target, at its demand or in 50 years."""
        in_years = target.years is not None
        return self._changed(
            "assessment",
            target_probability=None if in_years else target.share,
            target_50_years=target.share if in_years else None,
        )

    @checked
    def wider(
        self, factor: Annotated[float, Bounds(0.0, 100.0, "(]", "give a factor, as 1.1")]
    ) -> "DescribedObject":
        """Return the object on a base that is wider by a factor.

        Raises
        ------
        InputError
            If the factor is outside its range, or the object too stocky then.
        """
        sizes = self._sizes()
        changed = {key: _times(sizes[key], factor) for key in BASE if key in sizes}
        return self._reshaped(sizes | changed)

    @checked
    def lowered(
        self, by_m: Annotated[float, Bounds(0.0, 100.0, "[]", "give metres, as 0.1")]
    ) -> "DescribedObject":
        """Return the object with its own mass centre lower [m].

        Raises
        ------
        InputError, ModelError
            If it is lowered to the base or beyond, too stocky then, or a frame.
        """
        sizes = self._sizes()
        centre = sizes.get("mass_centre_height_m") or _times(sizes["height_m"], 0.5)
        part = 1.0 - by_m / middle(centre)
        return self._reshaped(sizes | {"mass_centre_height_m": _times(centre, part)})

    def _sizes(self) -> dict[str, Value]:
        """Return the geometry in sizes, also of an object that is given by its slenderness."""
        shape = self.given.geometry
        if shape.p_rad_s is not None:
            body = self.body
            return {"width_m": body.left + body.right, "height_m": body.height}
        values = {key: getattr(shape, key) for key in shape.__struct_fields__}
        return {key: value for key, value in values.items() if value is not None}

    def _reshaped(self, sizes: Mapping[str, Value]) -> "DescribedObject":
        """Return the object with another geometry."""
        known = {key: plain_value(value) for key, value in sizes.items()}
        return replace(self, values={**self.values, "geometry": known})

    def with_peaks(self, *, pga_g: float | None, pgv_m_s: float | None) -> "DescribedObject":
        """Return the object with other horizontal peaks of its demand; None for one not known.

        Raises
        ------
        InputError
            If one is outside its range.
        """
        return self._changed("demand", pga_g=pga_g, pgv_m_s=pgv_m_s)

    @checked
    def on_spectrum(self, spectrum: DesignSpectrum) -> "DescribedObject":
        """Return the object with a design spectrum as its demand, in place of its peaks."""
        table = spectrum.table
        stated = table.source or {
            "period_s": table.periods_s.tolist(),
            "sa_g": table.scaled(SPECTRUM_DAMPING)[0].tolist(),
            "damping": SPECTRUM_DAMPING,
        }
        changed = replace(self, spectrum=table)
        return changed._changed("demand", spectrum=stated, pga_g=spectrum.pga_g, pgv_m_s=None)

    def _changed(self, table: str, **keys: object) -> "DescribedObject":
        """Return the object with other values of some keys of a table; None takes a key out."""
        given = self.values.get(table, {})
        assert isinstance(given, Mapping)
        kept = {key: value for key, value in {**given, **keys}.items() if value is not None}
        return replace(self, values={**self.values, table: kept})

    def variants(self) -> tuple[Variant, ...]:
        """Return the object at both ends of each range of its geometry and content."""
        variants = []
        for table, name, value in numbers_of(self.given):
            key = f"{table}.{name}"
            if table in ("geometry", "content") and isinstance(value, Range):
                for end in (value.low, value.high):
                    body = body_of(self.given, self.source, key, end)
                    block = self._made(body, self.restitution)
                    label = f"{key} {number(end)}"
                    variants.append(Variant(key=key, label=label, block=block))
        return tuple(variants)

    def corners(self) -> tuple[Block, ...]:
        """Return the object at all ends of the ranges of its geometry and content together.

        One that is too stocky to rock is left out; without a range there is none.
        """
        ranges = [
            (table, name, (value.low, value.high))
            for table, name, value in numbers_of(self.given)
            if table in ("geometry", "content") and isinstance(value, Range)
        ]
        if not ranges:
            return ()
        blocks = []
        for ends in itertools.product(*(pair for _, _, pair in ranges)):
            values: dict[str, Any] = dict(self.values)
            for (table, name, _), end in zip(ranges, ends, strict=True):
                values[table] = {**values[table], name: end}
            with suppress(InputError, ModelError):
                blocks.append(replace(self, values=values).block)
        return tuple(blocks)

    def _made(self, body: Body, restitution: Restitution) -> Block:
        """Return the block of a body; a refusal names the file."""
        gravity = self.given.gravity_m_s2
        with in_file(self.source, "geometry"):
            walled = self.given.against_wall  # impacts on the base alone do not occur
            block = body.block(1.0 if walled else restitution, gravity)
            if self.given.fixed_parts:
                block = replace(block, parts=self.given.parts)
            return block.against_wall(restitution) if walled else block


def _times(value: Value, factor: float) -> Value:
    """Return a size, or both ends of its range, times a factor."""
    if isinstance(value, Range):
        return Range(low=value.low * factor, high=value.high * factor)
    return value * factor


def bounds_of(value: Value) -> tuple[float, float]:
    """Return both ends of a value, equal of a number."""
    return (value.low, value.high) if isinstance(value, Range) else (value, value)


def plain_value(value: Value) -> float | dict[str, float]:
    """Return a number, or both ends of a range."""
    return {"low": value.low, "high": value.high} if isinstance(value, Range) else value


@checked
def read_object(path: Path | str) -> DescribedObject:
    """Read an object file in TOML.

    Parameters
    ----------
    path
        The file; its keys are in `docs/guides/objects.md`.

    Returns
    -------
    DescribedObject
        Checked; its `block` is the block that it describes.

    Raises
    ------
    InputError
        If it cannot be read, is empty, no TOML or not in UTF-8, and as for `DescribedObject`.

    Examples
    --------
    >>> from rocksteady.risk.assess.described.objects import EXAMPLE
    >>> read_object(EXAMPLE).name
    'marble bust on a pedestal (example)'
    """
    file = Path(path)
    content = content_of(file, "object", FILE_HINT)
    values = toml_of(content, file.name)
    demand, spectrum = values.get("demand"), None
    stated = demand.get("spectrum") if isinstance(demand, dict) else None
    if isinstance(stated, str) and stated.strip():
        with in_file(file.name, "demand"):
            spectrum = spectrum_from(stated if formula_of(stated) else file.parent / stated)
    return DescribedObject(
        values=values,
        source=file.name,
        sha256=hashlib.sha256(content).hexdigest(),
        spectrum=spectrum,
    )
