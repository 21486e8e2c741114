"""Flags for ensembles: suites of records, levels, and a band of restitutions."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocksteady.cli.console import terminal
from rocksteady.cli.console.refusals import FlagError, both, flags_of, missing
from rocksteady.cli.flags.block_and_shaking import BlockFlags
from rocksteady.cli.flags.options import Panel, mass_flag
from rocksteady.cli.flags.parsing import decimal, number, restitution_from, values_of
from rocksteady.cli.flags.record_files import ReadingFlags
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.housner_forms import Impacts, Restitution, form_of_text
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.records.examples import example_named, is_example
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
MOST_NAMED = 3
"""Files that are no records and are named beside their count."""


@dataclass(frozen=True, kw_only=True)
class Suite:
    """Ground motions that were read.

    Attributes
    ----------
    motions
        The motions, horizontal or with a vertical component.
    recordings
        The horizontal channel of each.
    left_out
        Channels and files that were not used.
    """

    motions: "list[Record | BaseMotion]"
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
    def words(self) -> str:
        """How many records there are, and what is left out; nothing of synthetic motions."""
        from rocksteady.records.suite import suite_words

        return suite_words(self.recordings, self.left_out) if self.recordings else ""

    @property
    def values(self) -> dict[str, Any]:
        """What is left out, and what is taken though its direction is not stated, for JSON."""
        unstated = [str(each.path) for each in self.recordings if each.orientation == "unknown"]
        return {
            "left_out": [each.to_dict() for each in self.left_out],
            **({"unstated_direction": unstated} if unstated else {}),
        }


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
    include: str | None = ensemble_flag(
        "--include KIND",
        "Take channels that are left out by default: unknown (a direction that is not "
        "understood), borehole, structure or rotated; several with commas.",
    )

    @property
    def given(self) -> dict[str, object]:
        """All by their flags: the first of --records, --pair and --include."""
        first = next(iter(self.records or []), None)
        return {"--records": first, "--pair": self.pair, "--include": self.include}

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
                hint="add --records DIR, or --example for synthetic ones",
            )
        return list(dict.fromkeys(paths))

    def suite(self, reading: ReadingFlags) -> Suite:
        """Return the motions of all files; records that cannot be read are named on stderr.

        Raises
        ------
        InputError
            If no file has a horizontal record, or --include names no kind of channels.
        """
        from rocksteady.records.core.text import NO_RECORD
        from rocksteady.records.suite import (
            FAULTS,
            INCLUDABLE,
            check_includable,
            file_left_out,
            nothing_left,
            select,
        )

        kinds = [
            check_includable("--include", kind) for kind in (self.include or "").split(",") if kind
        ]
        suite = Suite(motions=[])
        upright: list[Recording] = []
        plain = replace(reading, floor_hz=None, floor_damping=None, participation=None)
        for file in self.files:
            try:
                recordings = (plain if self.pair else reading).recordings(file)
                # Whoever names a channel takes it.
                named = INCLUDABLE if reading.channel is not None else kinds
                across, left = select(recordings, named)
                self._refuse_extreme(across)
            except InputError as error:
                suite.left_out.append(file_left_out(file, error))
                continue
            suite.recordings.extend(across)
            suite.left_out.extend(left)
            upright += [each for each in recordings if each.orientation == "vertical"]
        for each in suite.left_out:
            if each.channel is None and each.kind in FAULTS.values():
                terminal.note(f"{each.file} is left out: {printable(each.why)}")
        if suite.recordings and self.pair:
            suite = self._paired(suite, upright, reading)
        elif suite.recordings:
            suite.motions.extend(each.record for each in suite.recordings)
        if not suite.motions:
            raise InputError(
                "--records",
                ", ".join(str(path) for path in self.records or []),
                nothing_left(suite.left_out, "files"),
                "name a folder of ground-motion files, or see `rocksteady record FILE`",
            )
        if suite.left_out or suite.values.get("unstated_direction"):
            names = [each.file.name for each in suite.left_out if each.kind == NO_RECORD]
            more = ", ..." if len(names) > MOST_NAMED else ""
            listed = f" ({', '.join(names[:MOST_NAMED])}{more})" if names else ""
            terminal.note(f"{suite.words}{listed}")
        return suite

    def _refuse_extreme(self, recordings: "Sequence[Recording]") -> None:
        """Refuse records whose measures would overflow."""
        from rocksteady.seismic.measures.time_course import refuse_extreme

        for recording in recordings:
            refuse_extreme(recording.record)

    def _paired(self, suite: Suite, upright: "list[Recording]", reading: ReadingFlags) -> Suite:
        """Return a suite with the vertical channels of its stations beside the horizontal ones."""
        from rocksteady.records.core.recording import LeftOut
        from rocksteady.records.pairing import paired
        from rocksteady.records.suite import INCLUDABLE, OPEN

        pairs = Suite(motions=[])
        beside: set[tuple[Path, str | None]] = set()
        for group in paired([*suite.recordings, *upright]):
            for warning in group.warnings:
                terminal.note(f"{group.name}: {warning}")
            if group.horizontal:
                steps = {recording.record.dt_s for recording in group.recordings}
                ready = group.aligned("pad") if len(steps) == 1 else group
                pairs.motions.extend(map(reading.on_floor, ready.motions()))
                pairs.recordings.extend(ready.horizontal)
                beside |= {(each.path, each.component) for each in (ready.vertical,) if each}
            pairs.left_out.extend(
                LeftOut(
                    file=each.path, channel=each.component, kind=OPEN, why=INCLUDABLE["unknown"]
                )
                for each in group.other
                if each.orientation == "unknown"
            )
        pairs.left_out.extend(
            each for each in suite.left_out if (each.file, each.channel) not in beside
        )
        return pairs


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
