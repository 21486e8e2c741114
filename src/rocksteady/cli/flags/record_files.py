"""Flags for recorded ground motions: files, how to read them, how they shake a block."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from rocksteady.cli.console import terminal
from rocksteady.cli.console.refusals import FlagError, both, flags_of, missing, needs, refuse
from rocksteady.cli.flags.block_and_shaking import BlockFlags, PulseFlags, ShakingFlags
from rocksteady.cli.flags.options import FLAG_OF_ARGUMENT, Panel, given_in, motion_flag
from rocksteady.cli.flags.parsing import number, single, values_of
from rocksteady.errors import InputError, RecordFileError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.validation import LARGEST, in_range
from rocksteady.model.motions.fourier import FourierSeries
from rocksteady.model.motions.oscillator import DEFAULT_DAMPING
from rocksteady.model.motions.segments import Harmonic
from rocksteady.records.examples import LISTED, example_named, is_example
from rocksteady.results.rendering import printable

if TYPE_CHECKING:
    from rocksteady.model.motions.floor import Floor
    from rocksteady.model.motions.record import Record
    from rocksteady.records.core.recording import Recording
    from rocksteady.records.processing import Cleaning

reading_flag = Panel("Reading files")
FLOOR_FLAGS = {
    "frequencies_hz": "--floor-hz",
    "damping": "--floor-damping",
    "shapes": "--participation",
}
"""Flags of the fields of a floor."""

MOST_USUAL_SCALE = 10.0
"""Factor of a record beyond which a wrong unit is more likely than a wish."""

scale_flag = partial(
    motion_flag,
    "--scale S",
    "Multiply the accelerations of --record, and of --vertical, by a factor; default 1.",
)
units_flag = partial(
    reading_flag,
    "--units UNIT",
    "Set the unit of numbers in files that do not state it: g, m/s^2, cm/s^2, gal and others.",
)
dt_s_flag = partial(
    reading_flag,
    "--dt-s DT",
    "Set the interval between samples \\[s] in files that do not state it.",
)
format_flag = partial(
    reading_flag,
    "--format NAME",
    "Set the format of the files; default: recognised from their content.",
)
column_flag = partial(
    reading_flag,
    "--column NAME",
    "Choose the column of a table with the acceleration: its number from 1, or its name.",
)
resample_flag = partial(
    reading_flag,
    "--resample",
    "Interpolate a table with uneven times to even ones.",
    default=False,
)
ignore_header_flag = partial(
    reading_flag,
    "--ignore-header",
    "Read the samples as plain columns by --units and --dt-s alone, whatever the file states.",
    default=False,
)
baseline_flag = partial(
    reading_flag,
    "--baseline NAME",
    "Subtract a baseline: none, mean, pre:SECONDS (mean of the first ones), linear, polynomial:N.",
    default="none",
)
filter_flag = partial(
    reading_flag,
    "--filter LOW:HIGH",
    "Keep frequencies \\[Hz] after --baseline, without phase shift: 0.1:25, 0.1: or :25.",
)
trim_flag = partial(
    reading_flag,
    "--trim START:END",
    "Keep the times of the file \\[s] after --filter: 2:40, 2: or :40.",
)


@dataclass(frozen=True, kw_only=True)
class FloorFlags:
    """Modes of the building on whose floor a block stands."""

    floor_hz: str | None = motion_flag(
        "--floor-hz F",
        "Stand the block on a floor: the natural frequency of its building \\[Hz], or of several "
        "modes with commas. Levels and --pga-g stay those of the ground.",
    )
    floor_damping: str | None = motion_flag(
        "--floor-damping ZETA",
        "Set the damping of the modes of --floor-hz over the critical one; default "
        f"{DEFAULT_DAMPING:g}.",
    )
    participation: str | None = motion_flag(
        "--participation G",
        "Set participation factor times mode shape at the floor, one for each frequency of "
        "--floor-hz; default 1 of one.",
    )

    @cached_property
    def floor(self) -> "Floor | None":
        """The floor; None of the ground.

        Raises
        ------
        InputError, FlagError
            If a number is outside its range, or there is no frequency.
        """
        given = {"damping": self.floor_damping, "shapes": self.participation}
        for name, value in given.items():
            needs(FLOOR_FLAGS[name], value, "--floor-hz", "F", beside=self.floor_hz)
        if self.floor_hz is None:
            return None
        from rocksteady.model.motions.floor import Floor

        texts = {"frequencies_hz": self.floor_hz} | given
        with flags_of(FLOOR_FLAGS, InputError):
            return Floor(
                **{
                    name: [number(FLOOR_FLAGS[name], part) for part in text.split(",")]
                    for name, text in texts.items()
                    if text is not None
                }
            )

    def of(self, body: Any) -> "Floor | None":
        """Return the floor under a block; None of the ground.

        Raises
        ------
        InputError, FlagError
            As for `floor`; and if the block has no p.
        """
        if self.floor is not None and not isinstance(body, Block):
            raise FlagError(
                "--floor-hz", self.floor_hz, "hertz need a block with a p", "describe a block"
            )
        return self.floor

    def along(self, parameter: str | None, motion: Any, body: Any) -> Any:
        """Return the motion of the floor where a parameter moves, its amplitude the ground's.

        Raises
        ------
        InputError, FlagError
            As for `on_floor`; and if the hertz move.
        """
        if self.floor is None or parameter in (None, "restitution"):
            return self.on_floor(motion, body)
        if parameter not in ("amplitude", "acceleration_m_s2", "phase"):
            flag, hint = FLAG_OF_ARGUMENT[parameter], "give rocksteady map that axis, as a sinusoid"
            valid = f"{flag} is an axis here, and each frequency has its own shaking of the floor"
            raise FlagError("--floor-hz", self.floor_hz, valid, f"{hint}, or one frequency here")
        if isinstance(motion, Harmonic):
            self.on_floor(motion, body)  # for its note
            wave = {name: getattr(motion, name) for name in ("amplitude", "frequency_ratio")}
            motion = FourierSeries(**wave, harmonics=((1, 1.0, 0.0),), phase=motion.phase)
        return self.on_floor(motion, body)

    @property
    def on_ground(self) -> Self:
        """The same without the floor."""
        return replace(self, floor_hz=None, floor_damping=None, participation=None)

    def on_floor(self, motion: Any, body: Any = None) -> Any:
        """Return the motion of the floor; on the ground the motion itself.

        Of harmonic shaking a note says by how much the floor amplifies it.

        Raises
        ------
        InputError, ModelError
            As for `rocksteady.floor_motion`.
        """
        if self.floor is None:
            return motion
        if hasattr(motion, "segments"):
            self.of(body)
        moved = self.floor.motion(motion, body)
        if isinstance(moved, Harmonic):
            factor = self.floor.amplification(moved.frequency_ratio * body.p / (2.0 * math.pi))
            terminal.note(f"{self.floor.label}: {factor:.4g} times the amplitude of the ground")
        return moved


@dataclass(frozen=True, kw_only=True)
class ReadingFlags(FloorFlags):
    """How ground-motion files are read, and the floor on which they are felt."""

    channel: str | None = reading_flag(
        "--channel NAME",
        "Choose the channel of a file with several: its component, or its number from 1.",
    )
    format: str | None = format_flag()
    units: str | None = units_flag()
    dt_s: float | None = dt_s_flag()
    column: str | None = column_flag()
    resample: bool = resample_flag()
    ignore_header: bool = ignore_header_flag()
    baseline: str = baseline_flag()
    filter: str | None = filter_flag()
    trim: str | None = trim_flag()

    @property
    def given(self) -> dict[str, object]:
        """The flags that were given, with their values."""
        return given_in(self)

    def recordings(self, file: Path, *, warned: bool = True) -> "list[Recording]":
        """Return the channels of a file, or the chosen channel.

        Parameters
        ----------
        file
            The file.
        warned
            Whether their warnings are printed; default True.

        Raises
        ------
        InputError
            If it cannot be read, or has no such channel.
        """
        from rocksteady.records.read import chosen

        channels = self._channels(file)
        wanted = channels if self.channel is None else (chosen(channels, self.channel),)
        if warned:
            warn_of(file, wanted)
        return self._ready(wanted)

    def read(self, file: Path) -> "Recording":
        """Return the one channel of a file, and print its warnings.

        Raises
        ------
        InputError
            If it cannot be read, or it is not clear which channel is meant.
        """
        from rocksteady.records.read import chosen

        channels = self._channels(file)
        if self.channel is None and len(channels) > 1:
            try:
                channel = chosen(channels, None)
            except InputError as error:
                raise missing("--channel", valid=error.valid, hint=error.hint) from None
        else:
            channel = chosen(channels, self.channel)
        warn_of(file, (channel,))
        return self._ready((channel,))[0]

    def read_vertical(self, file: Path) -> "Recording":
        """Return the vertical channel of a file: its one channel, or the vertical one of several.

        Raises
        ------
        InputError
            If it cannot be read, is an example, or no channel, or more than one, is marked as
            vertical.
        """
        if is_example(file):
            raise InputError("--vertical", file, "no example is vertical", "give a file")
        channels = self._channels(file)
        upright = tuple(channel for channel in channels if channel.orientation == "vertical")
        if len(channels) > 1 and len(upright) != 1:
            raise InputError(
                "--vertical",
                file,
                f"of its {len(channels)} channels {len(upright)} are vertical",
                "give a file with one channel",
            )
        wanted = upright if len(channels) > 1 else channels
        warn_of(file, wanted)
        (channel,) = self._ready(wanted, across=False)
        if channel.orientation == "unknown":
            warn(file, "where its channel points is not stated: it is taken as vertical, upwards")
        return channel

    def _channels(self, file: Path) -> "tuple[Recording, ...]":
        """Return all channels of a file."""
        from rocksteady.records.read import read_recordings

        if is_example(file):
            example_named(file)
        try:
            return read_recordings(
                file,
                format=self.format,
                units=self.units,
                dt_s=self.dt_s,
                column=self.column,
                resample=self.resample,
                ignore_header=self.ignore_header,
            )
        except RecordFileError as error:
            raise RecordFileError(
                path=error.path,
                line=error.line,
                found=error.found,
                valid=in_flags(error.clause),
                hint=in_flags(error.hint),
                kind=error.kind,
            ) from error

    def _ready(
        self, channels: "tuple[Recording, ...]", *, across: bool = True
    ) -> "list[Recording]":
        """Return cleaned channels, on the floor."""
        if self.ignore_header:
            warn(channels[0].path, "its header is ignored")
        cleaning = cleaning_of(self)
        ready = [_named(cleaning.apply(channel)) for channel in channels]
        if self.floor is None or not across:
            return ready
        return [
            each
            if each.orientation == "vertical"
            else each.processed(self.floor.motion(each.record), self.floor.label)
            for each in ready
        ]


def cleaning_of(flags: Any) -> "Cleaning":
    """Return the offset, the filter and the trim of a group of flags."""
    from rocksteady.records.processing import Cleaning

    return Cleaning(baseline=flags.baseline, filter_hz=flags.filter, trim_s=flags.trim)


def _named(one: "Recording") -> "Recording":
    """Return a recording whose name every table, picture and store can hold."""
    name = one.record.name
    if name is None or printable(name) == name:
        return one
    return replace(one, record=replace(one.record, name=printable(name)))


ASKED_FOR = re.compile(
    r"(?<=\bgive )(?:units|column)\b|(?<=\bleave out )units\b"
    r"|(?<=, and )units(?= in\b)|(?<=\()resample(?=\))|\b(?:dt_s|ignore_header)\b"
)
"""Arguments of `rocksteady.records.read_recordings` in the hints and warnings of readers."""


def in_flags(words: str) -> str:
    """Return a hint or a warning with flags in place of arguments."""
    return ASKED_FOR.sub(lambda match: FLAG_OF_ARGUMENT[match[0]], words)


def warn(file: Path, words: str) -> None:
    """Keep a warning about a file, to be printed beside the result."""
    terminal.note(f"{file}: {words}")


def warn_of(file: Path, channels: "Sequence[Recording]") -> None:
    """Keep the warnings about channels of a file, each once."""
    for words in dict.fromkeys(words for each in channels for words in each.warnings):
        warn(file, in_flags(words))


def warn_across(recording: "Recording") -> None:
    """Warn about a channel that shakes across, and is no horizontal motion of the ground."""
    from rocksteady.records.suite import INCLUDABLE, kind_of

    reasons = {"vertical": f"{recording.component or 'its channel'} is vertical"} | INCLUDABLE
    reason = reasons.get(kind_of(recording, alone=True), "")
    if not reason and recording.orientation == "unknown":
        reason = "where it points is not stated"
    if reason:
        warn(recording.path, f"{reason}: it shakes across")


@dataclass(frozen=True, kw_only=True)
class RecordFlags:
    """Recorded motions in place of harmonic shaking; a command takes `ReadingFlags` beside them."""

    record: list[Path] | None = motion_flag(
        "--record FILE",
        "Ground-motion file that shakes a block of known size; then the base stands still. "
        f"Synthetic ones to try: {LISTED}.",
    )
    scale: str | None = scale_flag()
    pga_g: float | None = motion_flag(
        "--pga-g G",
        "Scale --record to a peak acceleration in g (9.80665 m/s^2), and --vertical by the "
        "same factor; instead of --scale.",
    )
    vertical: Path | None = motion_flag(
        "--vertical FILE",
        "Add the vertical acceleration of a file, its vertical channel where it has several; "
        "upwards is positive, and DWN is reversed. The linear model has no term for it.",
    )
    reverse: bool = motion_flag(
        "--reverse",
        "Change the sign of --record or --pulse: positive values drive negative rotation.",
        default=False,
    )
    reverse_vertical: bool = motion_flag(
        "--reverse-vertical",
        "Change the sign of --vertical, for a file that states its direction wrongly; DWN of "
        "PEER, positive downwards, is reversed without it.",
        default=False,
    )

    @property
    def files(self) -> list[Path]:
        """The files that are read."""
        return [*(self.record or []), *([] if self.vertical is None else [self.vertical])]

    def given(self, reading: ReadingFlags, *, pulse: bool = False, on_floor: bool = False) -> bool:
        """Return whether there is a record.

        Parameters
        ----------
        reading
            How it is read.
        pulse
            Whether there is a pulse, which --reverse reverses too.
        on_floor
            Whether there is another motion that a floor has; default False.

        Raises
        ------
        ModelError
            If there is none, and something that only a record has.
        """
        upwards = self.reverse_vertical
        needs("--reverse-vertical", upwards, "--vertical", "FILE", beside=self.vertical)
        if self.record:
            return True
        flags = {
            "--reverse": self.reverse and not pulse,
            "--scale": self.scale,
            "--pga-g": self.pga_g,
            "--vertical": self.vertical,
        }
        for flag, value in (reading.given | flags).items():
            if not on_floor or flag not in FLOOR_FLAGS.values():
                needs(flag, value, "--record", "example:near-fault")
        return False

    def recordings(self, reading: ReadingFlags) -> list["Recording"]:
        """Return the horizontal channels, as their files have them.

        Raises
        ------
        InputError
            If a file cannot be read.
        """
        recordings = [reading.read(file) for file in self.record or []]
        for recording in recordings:
            if self.vertical is None or recording.orientation != "vertical":
                warn_across(recording)
        return recordings

    def block(self, described: BlockFlags) -> Block:
        """Return the block that is shaken.

        Raises
        ------
        InputError, ModelError
            As for `BlockFlags.described`; and if it has no size.
        """
        body = described.described() if described.given else None
        if isinstance(body, Block):
            return body
        raise FlagError(
            "--record",
            (self.record or [])[0],
            "m/s^2 and seconds need a block with a slenderness and a p",
            "describe a block, as --width-m 0.4 --height-m 1.6",
        )

    def recording(self, reading: ReadingFlags) -> "Recording":
        """Return the one channel that shakes a block across, scaled and reversed.

        Raises
        ------
        InputError
            As for `recordings`; and if the scale is 0 or not finite.
        ModelError
            If there are several records.
        """
        files = self.record or []
        if len(files) != 1:
            raise FlagError(
                finding=f"--record names {len(files)} files",
                valid="this command takes one",
                hint="give one file",
            )
        (recording,) = self.recordings(reading)
        scaled = self.scaled(self.at_pga(recording).record)
        return replace(recording, record=scaled.reversed() if self.reverse else scaled)

    def at_pga(self, horizontal: "Recording") -> "Recording":
        """Return a horizontal channel scaled to --pga-g; its factor is kept for the vertical one.

        Raises
        ------
        InputError
            If the peak is not above 0, or --scale is given too.
        """
        if self.pga_g is None:
            return horizontal
        if self.scale is not None:
            raise both("--scale", "--pga-g", valid="one of the two is the level")
        hint = "give the peak in g; 0.3 is usual"
        level = in_range("--pga-g", self.pga_g, 0.0, LARGEST, hint=hint)
        peak = horizontal.record.reference.peak_acceleration_m_s2
        factor = level * STANDARD_GRAVITY / peak
        remark_on_scale(factor, f"--pga-g {level:g} multiplies {horizontal.path.name}")
        self._to_pga.append(factor)
        return replace(horizontal, record=horizontal.record.scaled(factor))

    @cached_property
    def _to_pga(self) -> list[float]:
        """Factors of the horizontal channels that are scaled to --pga-g."""
        return []

    def vertical_recording(
        self, reading: ReadingFlags, horizontal: "Recording"
    ) -> "Recording | None":
        """Return the vertical channel; what keeps it from belonging to the other is printed.

        Parameters
        ----------
        reading
            How files are read.
        horizontal
            The channel beside it.

        Raises
        ------
        InputError
            As for `recordings`.
        """
        if self.vertical is None:
            return None
        from rocksteady.records.pairing import pair_doubts

        recording = reading.read_vertical(self.vertical)
        if doubts := pair_doubts(horizontal, recording):
            with_what = f"beside {horizontal.path.name} it may not belong"
            warn(self.vertical, f"{with_what}: {'; '.join(doubts)}")
        if self._to_pga:
            recording = replace(recording, record=recording.record.scaled(self._to_pga[0]))
        if not self.reverse_vertical:
            return recording
        return recording.processed(recording.record.reversed(), "sign changed: --reverse-vertical")

    def scaled(self, record: "Record") -> "Record":
        """Return a record multiplied by --scale.

        Raises
        ------
        InputError
            If the scale is not in [1e-50, 1e50].
        """
        if self.scale is not None:
            return record.scaled(single("--scale", self.scales))
        return record

    @cached_property
    def scales(self) -> list[float]:
        """Values of --scale, above 0: --reverse is what changes the sign.

        Raises
        ------
        InputError
            If one is not.
        """
        hint = "give a factor, as 1.5; --reverse changes the sign"
        values = [1.0] if self.scale is None else values_of("--scale", self.scale)
        for value in values:
            in_range("--scale", value, 1.0 / LARGEST, LARGEST, "[]", hint=hint)
        remark_on_scale(max(values), f"--scale {max(values):g} multiplies the record")
        return values


def remark_on_scale(factor: float, what: str) -> None:
    """Print a remark beside the result where a record is made more than ten times as strong."""
    if factor > MOST_USUAL_SCALE:
        terminal.note(f"{what} by {factor:.3g}: is its unit right (--units)?")


def refuse_beside_record(*, pulse: PulseFlags, shaking: ShakingFlags, phase: float | None) -> None:
    """Refuse another base motion beside a recorded one.

    Raises
    ------
    InputError
        If there is one.
    """
    others = {
        "--pulse": pulse.pulse if pulse.given else None,
        "--amplitude/-A": shaking.amplitude,
        "--frequency-ratio/-W": shaking.frequency_ratio,
        "--accel-g": shaking.accel_g,
        "--accel-m-s2": shaking.accel_m_s2,
        "--freq-hz": shaking.freq_hz,
        "--phase": phase,
    }
    hint = "leave one of the two out; --scale makes a record stronger"
    refuse(others, "--record sets the motion of the base", hint)
