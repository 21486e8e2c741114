"""Flags for ensembles: suites of records, levels, and a band of restitutions."""

import re
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocksteady.cli.console import terminal
from rocksteady.cli.console.refusals import FlagError, both, flags_of, missing
from rocksteady.cli.console.shell import quoted
from rocksteady.cli.flags.block_and_shaking import BlockFlags
from rocksteady.cli.flags.options import Panel, mass_flag
from rocksteady.cli.flags.parsing import decimal, number, restitution_from, values_of
from rocksteady.cli.flags.record_files import ReadingFlags, warn_of
from rocksteady.errors import InputError, RecordFileError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.housner_forms import Impacts, Restitution, form_of_text
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.records.core.text import NO_RECORD
from rocksteady.records.examples import example_named, is_example
from rocksteady.results.description import Column, Description, Table, line
from rocksteady.results.numbers import plural
from rocksteady.results.rendering import printable

if TYPE_CHECKING:
    from rocksteady.model.motions.record import Record
    from rocksteady.records.core.recording import LeftOut, Recording
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
    recordings
        The horizontal channel of each; none of synthetic motions.
    left_out
        Channels and files that were not used.
    """

    motions: "list[Record | BaseMotion]" = field(default_factory=list)
    recordings: "list[Recording]" = field(default_factory=list)
    left_out: "list[LeftOut]" = field(default_factory=list)

    @classmethod
    def synthetic(cls, count: int) -> "Suite":
        """Return synthetic motions, which have no files."""
        from rocksteady.model.motions.synthetic_suite import make_synthetic_suite

        return cls(motions=[*make_synthetic_suite(count)])

    @property
    def files(self) -> list[Path]:
        """The file of each motion."""
        return [each.path for each in self.recordings]

    @property
    def read(self) -> list[Path]:
        """All files that were opened, those left out too."""
        return [*self.files, *(each.file for each in self.left_out)]

    @property
    def values(self) -> dict[str, Any]:
        """What --json says of the files: what is left out, and whose direction is not stated."""
        files = [str(each.path) for each in self.recordings if each.orientation == "unknown"]
        unstated = {"unstated_direction": files} if files else {}
        return {"left_out": [each.to_dict() for each in self.left_out], **unstated}

    def counted(self, description: Description) -> Description:
        """Return a description that counts what is left out by kind, and names it in a table."""
        from rocksteady.records.suite import suite_words

        values, facts = self.values, [*description.facts]
        if description.sentence and (self.left_out or "unstated_direction" in values):
            words, count = suite_words(self.recordings, self.left_out), len(self.recordings)
            records = plural(count, "record")
            rest = words.removeprefix(records)
            for place, fact in enumerate(fact for fact in facts if fact.first):
                if fact.label == "counted" and records in fact.words:
                    facts[place] = line(fact.label, fact.words.replace(records, words, 1))
                    break
                if fact.label == "records" and re.match(
                    rf"{count:,}(, scaled|, stretched|$)", fact.words
                ):
                    facts[place] = line(fact.label, f"{fact.words}; {rest.lstrip(',; ')}")
                    break
            else:
                runs = next((each.value for each in description.facts if each.key == "runs"), None)
                words = f"{runs:,} runs, {words}" if isinstance(runs, int) else words
                facts.insert(1, line("suite", words))
        columns = [
            Column("file", "file", lambda file: Path(file).name, left=True),
            Column("channel", "channel", left=True),
            Column("why", "why", left=True),
        ]
        table = Table("", values["left_out"], columns, title="Left out:")
        tables = [*description.tables, *[table] * bool(self.left_out)]
        return replace(description, facts=facts, tables=tables)


@dataclass(frozen=True, kw_only=True)
class SuiteFlags:
    """A suite of recorded motions; a command takes `ReadingFlags` beside them."""

    records: list[Path] | None = ensemble_flag(
        "--records DIR|FILE",
        "Read ground motions: every file of a folder, or a file; several times for more. What "
        "is no horizontal motion of the ground is counted and left out.",
    )
    include: str | None = ensemble_flag(
        "--include KIND",
        "Run these kinds of channels all the same, with commas: unknown, borehole, structure or "
        "rotated.",
    )
    pair: bool = ensemble_flag(
        "--pair",
        "Pair the channels of each station, and run with its vertical one as well as without.",
        default=False,
    )

    @property
    def given(self) -> dict[str, object]:
        """Those that were given, by their flags, and of --records the first."""
        return {
            "--records": next(iter(self.records or []), None),
            "--include": self.include,
            "--pair": self.pair,
        }

    @property
    def kinds(self) -> list[str]:
        """Kinds of channels of --include.

        Raises
        ------
        InputError
            If one is none.
        """
        from rocksteady.records.suite import check_includable

        names = [] if self.include is None else self.include.split(",")
        return [check_includable("--include", each.strip()) for each in names]

    @property
    def files(self) -> list[Path]:
        """The files of all folders, in the order of their names.

        Raises
        ------
        InputError, FlagError
            If there is none, or a path or an example does not exist.
        """
        from rocksteady.records.suite import files_of

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
                hint="add --records with your folder, or --records example:near-fault",
            )
        return list(dict.fromkeys(paths))

    def suite(self, reading: ReadingFlags) -> Suite:
        """Return the horizontal motions of all files; records that cannot be read are named.

        Raises
        ------
        InputError
            If nothing is left, or --pair meets a flag that it has no use for.
        """
        from rocksteady.records.suite import FAULTS, INCLUDABLE, file_left_out, nothing_left

        # A channel that is named is meant, whatever its kind.
        kinds = [*self.kinds, *[*INCLUDABLE] * (reading.channel is not None)]
        suite, files = Suite(), self.files
        channels: list[Recording] = []
        for file in files:
            try:
                channels += self._channels(file, reading, kinds, suite)
            except InputError as error:
                if self.records == [file]:
                    if isinstance(error, RecordFileError):
                        raise InputError("--records", file, error.valid, error.hint) from None
                    raise
                suite.left_out.append(file_left_out(file, error))
                if getattr(error, "kind", "") in FAULTS:
                    terminal.note(f"{file} is left out: {printable(error.valid)}")
        if self.pair:
            self._pair(channels, reading, suite)
        else:
            suite.recordings.extend(channels)
            suite.motions.extend(each.record for each in channels)
        if not suite.motions:
            given = ", ".join(str(path) for path in self.records or [])
            reason = nothing_left(suite.left_out, "files")
            raise InputError("--records", given, reason, _remedy(suite.left_out))
        return suite

    def _channels(
        self, file: Path, reading: ReadingFlags, kinds: list[str], suite: Suite
    ) -> "list[Recording]":
        """Return the horizontal channels of a file, and with --pair its vertical ones."""
        from rocksteady.records.suite import kind_of, select
        from rocksteady.seismic.measures.time_course import refuse_extreme

        recordings = (reading.on_ground if self.pair else reading).recordings(file, warned=False)
        across, others = select(recordings, kinds)
        for recording in across:
            refuse_extreme(recording.record)
        suite.left_out.extend(each for each in others if not self.pair or each.kind != "vertical")
        upright = [each for each in recordings if kind_of(each, alone=True) == "vertical"]
        chosen = [*across, *upright * self.pair]
        warn_of(file, chosen)
        return chosen

    def _pair(self, channels: "list[Recording]", reading: ReadingFlags, suite: Suite) -> None:
        """Add the motions of paired channels, and of those of --include, which are not paired."""
        from rocksteady.records.core.recording import LeftOut
        from rocksteady.records.pairing import paired
        from rocksteady.records.suite import kind_of

        pairable: list[Recording] = []
        lone: list[Recording] = []
        for each in channels:
            if each.orientation == "vertical" and each.position in {"borehole", "structure"}:
                lone.append(each)
            elif kind_of(each, alone=True) in {"", "vertical"}:
                pairable.append(each)
            else:
                suite.recordings.append(each)
                suite.motions.append(reading.on_floor(each.record))
        for group in paired(pairable):
            across = tuple(each for each in group.recordings if each.orientation != "vertical")
            if not across:
                lone += group.recordings
                continue
            lone += [each for each in group.other if each.orientation == "vertical"]
            kept = replace(group, horizontal=across, other=())
            for warning in kept.warnings:
                terminal.note(f"{kept.name}: {warning}")
            steps = {recording.record.dt_s for recording in kept.recordings}
            ready = kept.aligned("pad") if len(steps) == 1 else kept
            suite.motions.extend(map(reading.on_floor, ready.motions()))
            suite.recordings.extend(ready.horizontal)
        why = "vertical, and no horizontal channel goes with it"
        suite.left_out.extend(
            LeftOut(file=each.path, channel=each.component, kind="vertical", why=why)
            for each in lone
        )


def _remedy(left_out: "list[LeftOut]") -> str:
    """Return what to do where no file has a horizontal record."""
    from rocksteady.records.suite import INCLUDABLE

    kinds = [kind for kind in INCLUDABLE if any(each.kind.startswith(kind) for each in left_out)]
    if kinds:
        return f"add --include {','.join(kinds)} to run them all the same"
    doubtful = [quoted(each.file) for each in left_out if each.kind != NO_RECORD]
    if doubtful:
        return f"see `rocksteady record {doubtful[0]}`, or name another folder"
    return "name a folder of ground-motion files"


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
        "Set the levels: start:stop:count, log:start:stop:count, or values with commas; by "
        "default they reach from where nothing lifts to where 95 % fall.",
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
    seed: int = ensemble_flag("--seed N", "Set the seed of the scatter.", default=0)

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
