"""Flags for ensembles: suites of records, levels, and a band of restitutions."""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocksteady.cli.console import terminal
from rocksteady.cli.console.refusals import FlagError, both, flags_of, missing, refuse
from rocksteady.cli.flags.block_and_shaking import BlockFlags
from rocksteady.cli.flags.options import Panel, mass_flag
from rocksteady.cli.flags.parsing import axis, decimal, number, restitution_from
from rocksteady.cli.flags.record_files import FLOOR_FLAGS, ReadingFlags
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.housner_forms import Impacts, Restitution, form_of_text
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.records.examples import example_named, is_example
from rocksteady.results.rendering import printable

if TYPE_CHECKING:
    from rocksteady.model.motions.record import Record
    from rocksteady.risk.ensemble.levels import Levels
    from rocksteady.risk.ensemble.restitution_band import RestitutionBand
    from rocksteady.risk.ensemble.ways import Ways
    from rocksteady.seismic.measures.scalar import Measure

ensemble_flag = Panel("Ensemble")
BAND_DRAWS = 5


@dataclass(frozen=True, kw_only=True)
class Suite:
    """Ground motions that were read.

    Attributes
    ----------
    motions
        The motions, horizontal or with a vertical component.
    files
        The file of each.
    left_out
        File and reason of each that was not used.
    """

    motions: "list[Record | BaseMotion]"
    files: list[Path]
    left_out: list[tuple[Path, str]] = field(default_factory=list)

    @classmethod
    def synthetic(cls, count: int) -> "Suite":
        """Return synthetic motions, which have no files."""
        from rocksteady.model.motions.synthetic_suite import make_synthetic_suite

        return cls(motions=[*make_synthetic_suite(count)], files=[])

    @property
    def read(self) -> list[Path]:
        """All files that were opened, those left out too."""
        return [*self.files, *(file for file, _ in self.left_out)]


@dataclass(frozen=True, kw_only=True)
class SuiteFlags:
    """A suite of recorded motions; a command takes `ReadingFlags` beside them."""

    records: list[Path] | None = ensemble_flag(
        "--records DIR|FILE",
        "Read ground motions: every file of a folder, or a file; several times for more. A "
        "file that cannot be read is named and left out.",
    )
    pair: bool = ensemble_flag(
        "--pair",
        "Pair the channels of each station, and run with its vertical one as well as without.",
        default=False,
    )

    @property
    def given(self) -> dict[str, object]:
        """Both by their flags: the first of --records, and --pair."""
        return {"--records": next(iter(self.records or []), None), "--pair": self.pair}

    @property
    def files(self) -> list[Path]:
        """The files of all folders, in the order of their names.

        Raises
        ------
        InputError, FlagError
            If there is none, or a path or an example does not exist.
        """
        from rocksteady.records.read import files_of

        paths: list[Path] = []
        for path in self.records or []:
            if path.is_dir():
                paths += files_of(path)
            elif is_example(path):
                example_named(path)
                paths.append(path)
            elif path.exists():
                paths.append(path)
            else:
                raise FlagError("--records", path, "it does not exist", "name a folder or a file")
        if not self.records:
            raise missing(
                "--records",
                valid="an ensemble needs ground motions",
                hint="add --records DIR, or --example for synthetic ones",
            )
        return list(dict.fromkeys(paths))

    def suite(self, reading: ReadingFlags) -> Suite:
        """Return the motions of all files that can be read; the others are named on stderr.

        Raises
        ------
        InputError
            If no file can be read, or --pair meets a flag that it has no use for.
        """
        if self.pair:
            kept = ("--units", "--dt-s", *FLOOR_FLAGS.values())
            idle = {flag: value for flag, value in reading.given.items() if flag not in kept}
            refuse(idle, "channels are paired as their files have them", "leave one out")
        suite = Suite(motions=[], files=[])
        good: list[Path] = []
        for file in self.files:
            try:
                across = self._across(file, reading, suite)
            except InputError as error:
                suite.left_out.append((file, error.valid))
                continue
            good.append(file)
            if not self.pair:
                suite.motions.extend(across)
                suite.files.extend([file] * len(across))
        if self.pair and good:
            self._pair(good, reading, suite)
        for file, reason in suite.left_out:
            terminal.note(f"{file} is left out: {printable(reason)}")
        if not suite.motions:
            raise InputError(
                "--records",
                ", ".join(str(path) for path in self.records or []),
                f"none of its {len(self.files)} files is a horizontal record that can be read",
                "name a folder of ground-motion files, or see `rocksteady record FILE`",
            )
        return suite

    def _across(self, file: Path, reading: ReadingFlags, suite: Suite) -> "list[Record]":
        """Return the horizontal channels of a file."""
        from rocksteady.seismic.measures.time_course import refuse_extreme

        recordings = reading.recordings(file)
        across = [recording for recording in recordings if recording.orientation != "vertical"]
        for recording in across:
            refuse_extreme(recording.record)
        if not across and not self.pair:
            suite.left_out.append((file, "its channel is vertical; --pair runs it with the others"))
        return [recording.record for recording in across]

    def _pair(self, files: list[Path], reading: ReadingFlags, suite: Suite) -> None:
        """Add the motions of paired channels."""
        from rocksteady.records.pairing import pair_records

        for group in pair_records(files, units=reading.units, dt_s=reading.dt_s):
            for warning in group.warnings:
                terminal.note(f"{group.name}: {warning}")
            if not group.horizontal:
                for recording in group.recordings:
                    suite.left_out.append((recording.path, "its station has no horizontal channel"))
                continue
            steps = {recording.record.dt_s for recording in group.recordings}
            ready = group.aligned("pad") if len(steps) == 1 else group
            suite.motions.extend(map(reading.on_floor, ready.motions()))
            suite.files.extend(recording.path for recording in ready.horizontal)


@dataclass(frozen=True, kw_only=True)
class EnsembleFlags:
    """Levels of an ensemble, its band of restitutions and its signs."""

    measure: str | None = ensemble_flag(
        "--measure NAME[:S]",
        "Set what the levels are in: pgv_m_s (default), pga_g, p_pgv_per_uplift, pga_per_uplift, "
        "sa_g or sa_avg_g, whose period \\[s] may follow, as sa_g:0.5; default 2 pi/p.",
    )
    levels: str | None = ensemble_flag(
        "--levels AXIS",
        "Set the levels: start:stop:count, log:start:stop:count, or values with commas; "
        "default 20 that suit the block.",
    )
    scale: str | None = ensemble_flag(
        "--scale AXIS", "Multiply all records by the same factors, an axis, in place of --levels."
    )
    draws: int | None = ensemble_flag(
        "--draws N",
        "Set the number of restitutions in a band: --restitution LOW:HIGH, or by default from "
        f"Housner's value e to the root of e, at most 0.98; default {BAND_DRAWS}, and 1 of a "
        "single value.",
    )
    scatter: float = ensemble_flag(
        "--scatter SD",
        "Let the restitution scatter from impact to impact with this standard deviation.",
        default=0.0,
    )
    mass_kg: float | None = mass_flag()
    no_reverse: bool = ensemble_flag(
        "--no-reverse", "Run the records as recorded only; by default reversed too.", default=False
    )
    seed: int = ensemble_flag(
        "--seed N", "Set the seed of the scatter and of the bands.", default=0
    )

    @property
    def ways(self) -> "Ways":
        """Signs of the records."""
        from rocksteady.risk.ensemble.ways import Ways

        return Ways(reverse=False if self.no_reverse else "both")

    def levels_asked(self) -> "Levels":
        """Return the levels.

        Raises
        ------
        InputError, FlagError
            If a measure or a level is not valid, or both kinds of levels are given.
        """
        from rocksteady.risk.ensemble.levels import SCALE

        if self.scale is not None:
            for flag, value in (("--levels", self.levels), ("--measure", self.measure)):
                if value is not None:
                    raise both("--scale", flag, valid="levels are factors, or of a measure")
            return _levels("--scale", SCALE, values_of("--scale", self.scale))
        from rocksteady.seismic.measures.scalar import DEFAULT

        measure = intensity_of(self.measure or DEFAULT)
        levels = None if self.levels is None else values_of("--levels", self.levels)
        flag = "--measure" if levels is None else "--levels"
        return _levels(flag, measure, levels)

    def block_and_band(
        self, block: BlockFlags, default: Block | None
    ) -> "tuple[Block, RestitutionBand]":
        """Return the block, and the restitutions that it is run with.

        Parameters
        ----------
        block
            The flags of the block, whose --restitution may be a band, as 0.85:0.95 or
            housner*0.95:housner.
        default
            The block where no flag describes one; None where one must.

        Raises
        ------
        InputError, FlagError
            If the block or the band is not valid.
        """
        text = block.restitution
        low, colon, high = (text or "").partition(":")
        if colon:
            ends = {"low": _end(low, text), "high": _end(high, text)}
            return _body(replace(block, restitution=low), default), self._band(BAND_DRAWS, ends)
        body = _body(block, default)
        if text is None:
            return body, self._band(BAND_DRAWS, {})
        if self.draws in (None, 1):
            return body, self._band(1, {})
        if self.scatter == 0.0:
            raise FlagError(
                "--draws",
                self.draws,
                "a single value of the restitution has one draw without --scatter",
                "give a band, as --restitution 0.85:0.95, or add --scatter 0.05",
            )
        from rocksteady.seismic.measures.free_sides import impact_ratios

        ratio, negative = impact_ratios(body)
        if ratio != negative:
            raise FlagError(
                "--draws",
                self.draws,
                "the sides of this block have two restitutions, which have one draw",
                "give one number with --restitution, or a band",
            )
        return body, self._band(1, {"low": ratio, "high": ratio})

    def _band(self, draws: int, ends: dict[str, Any]) -> "RestitutionBand":
        """Return a band, whose errors name the flags."""
        from rocksteady.risk.ensemble.restitution_band import RestitutionBand

        count = draws if self.draws is None else self.draws
        flags = {name: f"--{name}" for name in ("restitution", "draws", "scatter", "seed")}
        with flags_of({"low": "--restitution", "high": "--restitution", **flags}):
            return RestitutionBand(**ends, draws=count, scatter=self.scatter, seed=self.seed)


def intensity_of(text: str) -> "Measure":
    """Return the measure of intensity of a flag: a name, and a period after a colon.

    Raises
    ------
    FlagError
        If there is none of that name, or it has no period.
    """
    from rocksteady.seismic.measures.scalar import Measure

    name, colon, period = text.partition(":")
    try:
        return Measure(name, number("--measure", period) if colon else None)
    except InputError as error:
        raise FlagError("--measure", text, error.valid, error.hint) from None


def values_of(flag: str, text: str) -> list[float]:
    """Return the values of an axis, or those with commas between them.

    Raises
    ------
    InputError
        If one is no number.
    """
    if "," in text:
        return [number(flag, part) for part in text.split(",")]
    return axis(flag, text)


def _levels(flag: str, measure: "Measure | str", levels: list[float] | None) -> "Levels":
    """Return levels, whose errors name the flag."""
    from rocksteady.risk.ensemble.levels import Levels

    try:
        return Levels(measure, levels)
    except InputError as error:
        raise FlagError(flag, error.value, error.valid, error.hint) from None


def _end(text: str, whole: str | None) -> Restitution:
    """Return one end of a band of restitutions."""
    form = form_of_text(text)
    try:
        return decimal(text) if form is None else form
    except ValueError:
        raise InputError(
            "restitution",
            whole,
            "a band has two ends, numbers in (0, 1] or factors of Housner's value",
            "write it as -r 0.85:0.95, or -r 'housner*0.95:housner'",
        ) from None


def _body(block: BlockFlags, default: Block | None) -> Block:
    """Return the block of flags; the default where none describes one."""
    if replace(block, restitution=None, one_sided=None, gravity_m_s2=None).given:
        body = block.described()
        assert isinstance(body, Block)
        return body
    if default is None or block.gravity_m_s2 is not None:
        raise missing(
            "--width-m with --height-m",
            valid="fragility is of a block with a size",
            hint="describe it, as --width-m 0.32 --height-m 1.8",
        )
    ratio = restitution_from(block.restitution, default="housner")
    if block.one_sided:
        return default.against_wall(Impacts.of(ratio).of_wall)
    return default if ratio == "housner" else default.with_restitution(ratio)
