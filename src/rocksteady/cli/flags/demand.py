"""Flags for the demand on an object: peaks, friction, a spectrum or a record."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocksteady.cli.console.refusals import both, missing, needs
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags
from rocksteady.cli.flags.groups import OutputFlags, ScreenFlags
from rocksteady.cli.flags.parsing import number
from rocksteady.cli.flags.record_files import ReadingFlags, RecordFlags
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.validation import in_range

if TYPE_CHECKING:
    from rocksteady.risk.screens.demand import Demand

demand_flag = options.Panel("Demand")


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

    def both_peaks(self) -> tuple[float, float]:
        """Return PGA and PGV.

        Raises
        ------
        FlagError
            If one is missing.
        """
        flags = (("--pga-g", self.pga_g, "0.3"), ("--pgv-m-s", self.pgv_m_s, "0.4"))
        for flag, value, usual in flags:
            if value is None:
                hint = f"give it, as {flag} {usual}"
                raise missing(flag, valid="PGA and PGV are both needed", hint=hint)
        assert self.pga_g is not None
        assert self.pgv_m_s is not None
        return self.pga_g, self.pgv_m_s


@dataclass(frozen=True, kw_only=True)
class SpectrumFlags:
    """A spectrum or a record, and the ratio of vertical to horizontal spectra."""

    spectrum: Path | None = demand_flag(
        "--spectrum FILE",
        "Take a response spectrum: rows of period \\[s] and Sa \\[g], one column of Sa for "
        "each damping; a comment '# 5 % damping' states it.",
    )
    damping: str | None = demand_flag(
        "--damping X",
        "Set the damping of --spectrum, 0.05 being 5 % of critical; several with commas.",
    )
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
        return [file for file in (self.spectrum, self.record) if file is not None]

    def demand(self, peaks: PeakFlags, reading: ReadingFlags) -> "Demand":
        """Return the demand of all flags.

        Raises
        ------
        InputError, FlagError
            If a value is outside its range, a file cannot be read, or two flags contradict.
        """
        from rocksteady.risk.screens.demand import Demand

        vertical: dict[str, Any] = {"sa_v_per_sa_h": self.vertical_per_horizontal, **peaks.vertical}
        needs("--damping", self.damping, "--spectrum", "FILE", beside=self.spectrum)
        if self.record is None:
            RecordFlags().given(reading)  # how no record is read
            return Demand(
                pga_g=peaks.pga_g,
                pgv_m_s=peaks.pgv_m_s,
                spectrum=self.spectrum,
                spectrum_damping=self._dampings(),
                **vertical,
            )
        for flag, value in (("--pgv-m-s", peaks.pgv_m_s), ("--spectrum", self.spectrum)):
            if value is not None:
                raise both("--record", flag, valid="the record has its own")
        recorded = RecordFlags(record=[self.record], pga_g=peaks.pga_g)
        return Demand.from_record(recorded.recording(reading).record, **vertical)

    def _dampings(self) -> list[float] | None:
        """Return the dampings of --damping; None without."""
        if self.damping is None:
            return None
        return [number("--damping", text) for text in self.damping.split(",")]


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


def probability(flag: str, value: float) -> float:
    """Return a probability that a flag was given, inside (0, 1)."""
    return in_range(flag, value, 0.0, 1.0, "()", hint="give a probability, as 0.1")
