"""Flags for the demand on an object: peaks, friction, a spectrum or a record."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocksteady.cli.console.refusals import FlagError, both, flags_of, missing, needs
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags
from rocksteady.cli.flags.groups import OutputFlags, ScreenFlags
from rocksteady.cli.flags.parsing import number, restitution_from
from rocksteady.cli.flags.record_files import ReadingFlags, RecordFlags
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.examples import constructor_of
from rocksteady.model.blocks.housner_forms import Impacts
from rocksteady.model.blocks.sides import gyration_of, rectangle_p
from rocksteady.model.checks.validation import in_range

if TYPE_CHECKING:
    from rocksteady.risk.assess.described.objects import DescribedObject
    from rocksteady.risk.counted.suite import Peaks
    from rocksteady.risk.screens.demand import Demand
    from rocksteady.risk.spectra.code_spectra import CodeSpectrum
    from rocksteady.risk.spectra.design_spectrum import DesignSpectrum
    from rocksteady.risk.spectra.tabulated import TabulatedSpectrum

demand_flag = options.Panel("Demand")
SOURCE = "block"
"""What an object of flags is called in messages, which then name the flags."""
OF_SPECTRUM = {"spectrum": "--spectrum", "spectrum_damping": "--damping", "pga_g": "--pga-g"}
"""Flags of what a design spectrum is made of."""
LENGTHS = ("offset", "mass_centre_height", "left", "right", "gyration")
"""Measures of a block with one number each, in metres."""
UNITS = {"width": "_m", "height": "_m", "alpha": "_rad", "p": "_rad_s"}


@dataclass(frozen=True, kw_only=True)
class PeakFlags:
    """Peak accelerations, peak velocity and friction."""

    pga_g: float | None = demand_flag(
        "--pga-g G",
        "Set the peak acceleration of the ground or floor \\[g]; with --record, scale the "
        "record to it.",
    )
    pgv_m_s: float | None = demand_flag(
        "--pgv-m-s V", "Set the peak velocity of the ground or floor \\[m/s]."
    )
    friction: float | None = demand_flag(
        "--friction MU",
        "Set the coefficient of friction between block and base; without, its need is shown.",
    )
    vertical_g: float = demand_flag(
        "--vertical-g G",
        "Set the peak vertical acceleration of the ground or floor \\[g], without a sign: the "
        "worse direction counts.",
        default=0.0,
    )
    vertical_share: float = demand_flag(
        "--vertical-share X",
        "Set the share of --vertical-g that acts at the horizontal peak; 0.4 by the 100-40-40 "
        "rule of ASCE 4.",
        default=1.0,
    )

    @property
    def vertical(self) -> dict[str, float]:
        """Vertical motion and its share, as the demand takes them.

        Raises
        ------
        FlagError
            If there is a share alone.
        """
        share = self.vertical_flags["--vertical-share"]
        needs("--vertical-share", share, "--vertical-g", "0.3", beside=self.vertical_g or None)
        return {"vertical_g": self.vertical_g, "vertical_share": self.vertical_share}

    @property
    def vertical_flags(self) -> dict[str, float | None]:
        """Both by their flags; None where a flag is not given, or given as its default."""
        return {
            "--vertical-g": self.vertical_g or None,
            "--vertical-share": None if self.vertical_share == 1.0 else self.vertical_share,
        }

    @property
    def demand(self) -> "Peaks | None":
        """Both peaks; None where neither is given.

        Raises
        ------
        InputError
            If one is outside its range.
        """
        if self.pga_g is None and self.pgv_m_s is None:
            return None
        from rocksteady.risk.counted.suite import Peaks

        with flags_of({"pga_g": "--pga-g", "pgv_m_s": "--pgv-m-s"}, InputError):
            return Peaks(pga_g=self.pga_g, pgv_m_s=self.pgv_m_s)

    def need_both_peaks(self) -> None:
        """Refuse a demand of one peak, which built-in motions are not made of.

        Raises
        ------
        FlagError
            If one is missing.
        """
        flags = (("--pga-g", self.pga_g, "0.3"), ("--pgv-m-s", self.pgv_m_s, "0.4"))
        for flag, value, usual in flags:
            if value is None:
                raise missing(
                    flag,
                    valid="built-in motions are made of both peaks",
                    hint=f"give it, as {flag} {usual}, or add --records with your folder",
                )


@dataclass(frozen=True, kw_only=True)
class DesignFlags:
    """A spectrum and its damping."""

    spectrum: Path | None = demand_flag(
        "--spectrum FILE|CODE",
        "Take a response spectrum: rows of period \\[s] and Sa \\[g], one column of Sa for "
        "each damping; a comment '# 5 % damping' states it. Or one by a formula, as "
        "en1998-1:2004:type1:C:ag=0.25, asce7-16:sds=1.0:sd1=0.6:tl=8 or "
        "ntc2018:C:T1:ag=0.2:f0=2.5:tc=0.35.",
    )
    damping: str | None = demand_flag(
        "--damping X",
        "Set the damping of --spectrum, 0.05 being 5 % of critical; several with commas.",
    )

    @property
    def formula(self) -> "CodeSpectrum | None":
        """The spectrum by a formula; None of a file."""
        from rocksteady.risk.spectra.code_spectra import formula_of

        with flags_of(OF_SPECTRUM, InputError):
            return None if self.spectrum is None else formula_of(str(self.spectrum))

    @property
    def file(self) -> list[Path]:
        """The file of the spectrum; none of a formula."""
        return [] if self.spectrum is None or self.formula is not None else [self.spectrum]

    @property
    def dampings(self) -> list[float] | None:
        """The dampings of --damping; None without.

        Raises
        ------
        FlagError
            If there is no spectrum, or one is no number.
        """
        needs("--damping", self.damping, "--spectrum", "FILE", beside=self.spectrum)
        if self.damping is None:
            return None
        return [number("--damping", text) for text in self.damping.split(",")]

    def design(self, pga_g: float | None) -> "DesignSpectrum | None":
        """Return the spectrum that motions are placed on; None without one.

        Raises
        ------
        InputError, FlagError
            If it cannot be read, or motions cannot be placed on it.
        """
        if self.spectrum is None:
            return None
        from rocksteady.risk.spectra.design_spectrum import DesignSpectrum

        with flags_of(OF_SPECTRUM, InputError):
            return DesignSpectrum(table=self.table, pga_g=pga_g)

    @property
    def table(self) -> "TabulatedSpectrum":
        """The table of the spectrum, which is given.

        Raises
        ------
        InputError, FlagError
            If it cannot be read.
        """
        from rocksteady.risk.spectra.tabulated import spectrum_from

        assert self.spectrum is not None
        with flags_of(OF_SPECTRUM, InputError):
            return spectrum_from(self.spectrum, self.dampings)


@dataclass(frozen=True, kw_only=True)
class SpectrumFlags(DesignFlags):
    """A spectrum or a record, and the ratio of vertical to horizontal spectra."""

    record: Path | None = demand_flag(
        "--record FILE", "Measure PGA, PGV and spectrum of a ground-motion file."
    )
    vertical_per_horizontal: float | None = demand_flag(
        "--vertical-per-horizontal X",
        "Set the ratio of vertical to horizontal spectral acceleration; default: --vertical-g over "
        "the PGA.",
    )

    @property
    def files(self) -> list[Path]:
        """The files that are read."""
        return [*self.file, *([] if self.record is None else [self.record])]

    def demand(self, peaks: PeakFlags, reading: ReadingFlags) -> "Demand":
        """Return the demand of all flags.

        Raises
        ------
        InputError, FlagError
            If a value is outside its range, a file cannot be read, or two flags contradict.
        """
        from rocksteady.risk.screens.demand import Demand

        vertical: dict[str, Any] = {"sa_v_per_sa_h": self.vertical_per_horizontal, **peaks.vertical}
        dampings = self.dampings
        if self.record is None:
            RecordFlags().given(reading)  # how no record is read
            return Demand(
                pga_g=peaks.pga_g,
                pgv_m_s=peaks.pgv_m_s,
                spectrum=self.spectrum,
                spectrum_damping=dampings,
                **vertical,
            )
        for flag, value in (("--pgv-m-s", peaks.pgv_m_s), ("--spectrum", self.spectrum)):
            if value is not None:
                raise both("--record", flag, valid="the record has its own")
        recorded = RecordFlags(record=[self.record], pga_g=peaks.pga_g)
        return Demand.from_record(recorded.recording(reading).record, **vertical)


@dataclass(frozen=True, kw_only=True)
class RowFlags(ScreenFlags):
    """Output of a command whose result is a table."""

    csv: Path | None = options.csv()
    force: bool = options.force()

    @property
    def files(self) -> OutputFlags:
        """The same as output of any command, with checks."""
        return OutputFlags(**vars(self))


def sized_block(flags: BlockFlags) -> Block:
    """Return the block of flags, which must have a size.

    Raises
    ------
    InputError, FlagError
        As for `BlockFlags.described`, or if no block is described.
    """
    body = flags.described() if flags.given else None
    if isinstance(body, Block):
        return body
    raise missing(
        "--width-m with --height-m",
        valid="an object needs a size",
        hint="describe it, as --width-m 0.32 --height-m 1.8",
    )


def described_block(flags: BlockFlags, peaks: PeakFlags) -> "DescribedObject":
    """Return the block of flags with its demand as an object file describes them.

    Raises
    ------
    InputError, FlagError
        As for `sized_block`; if a number is outside the ranges of an object file; or of two
        restitutions, which such a file has no key for.
    """
    from rocksteady.risk.assess.described.objects import DescribedObject
    from rocksteady.risk.observations.files.toml_tables import named

    body = sized_block(flags)
    demand = {"pga_g": peaks.pga_g, "pgv_m_s": peaks.pgv_m_s, **peaks.vertical}
    tables: dict[str, dict[str, Any]] = {
        "geometry": _geometry(flags, body),
        "demand": demand,
        "": {
            "friction": peaks.friction,
            "restitution": _restitution(flags, body),
            "gravity_m_s2": body.gravity,
        },
    }
    known = {
        table: {key: value for key, value in values.items() if value is not None}
        for table, values in tables.items()
    }
    names = {
        named(SOURCE, table, key): options.FLAG_OF_ARGUMENT.get(key, "--" + key.replace("_", "-"))
        for table, values in known.items()
        for key in values
    }
    with flags_of(names, InputError):
        return DescribedObject(
            values={
                "name": "block",
                "against_wall": body.one_sided,
                "fixed_parts": bool(body.parts),  # which the flags take as one body
                **known.pop(""),
                **known,
            },
            source=SOURCE,
        )


def _geometry(flags: BlockFlags, body: Block) -> dict[str, Any]:
    """Return the geometry of a block under the keys of an object file."""
    frame = {"columns": flags.columns, "cap_mass_ratio": flags.cap_mass_ratio}
    if flags.block is not None:
        bare = replace(flags, columns=None, cap_mass_ratio=None, one_sided=None, restitution="1")
        return _measured(sized_block(bare)) | frame
    sizes = {name: values[0] for name, values in flags.sizes.items()}
    if "radius" in sizes:
        sizes["p"] = rectangle_p(sizes.pop("radius"), body.gravity)
    shape = {name + UNITS[name]: value for name, value in sizes.items()}
    shape |= {f"{name}_m": getattr(flags, f"{name}_m") for name in LENGTHS}
    if flags.left_m is not None and flags.mass_centre_height_m is None:
        shape["mass_centre_height_m"] = 0.5 * sizes["height"]
    return shape | frame


def _measured(body: Block) -> dict[str, float]:
    """Return the geometry of a block without a cap, from its measures."""
    left, right = body.positive, body.negative
    shape = {
        "width_m": body.width,
        "height_m": body.height,
        "gyration_m": gyration_of(left, body.gravity),
    }
    if left.distance != right.distance:
        shape["offset_m"] = 0.5 * (left.distance - right.distance)
    if not body.fills_outline:
        shape["mass_centre_height_m"] = left.centre_height
    return shape


def _restitution(flags: BlockFlags, body: Block) -> str | float:
    """Return the restitution of a block as an object file has it."""
    if flags.restitution is None:
        alone = flags.block is not None and not body.one_sided and body.cap is None
        return constructor_of(flags.block)[1].get("restitution", "housner") if alone else "housner"
    given = restitution_from(flags.restitution, default="housner", wall=body.one_sided)
    if Impacts.of(given).pair is not None:
        raise FlagError(
            "--restitution/-r",
            flags.restitution,
            "an object has one restitution, or both from angular momentum",
            "give one number, or leave it out",
        )
    return given if isinstance(given, float) else flags.restitution


def share(flag: str, value: float) -> float:
    """Return a share that a flag was given, inside (0, 1)."""
    return in_range(flag, value, 0.0, 1.0, "()", hint="give a share, as 0.1")
