"""Suites of records: which channels of files and folders are horizontal motions of the ground."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Final, overload

from rocksteady.errors import InputError, RecordFileError
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.motions.record import Record
from rocksteady.records.core.directions import pointing
from rocksteady.records.core.recording import LeftOut, Recording
from rocksteady.records.core.text import CONTRADICTION, DAMAGED, NO_RECORD
from rocksteady.records.processing import Cleaning
from rocksteady.records.read import read_recordings
from rocksteady.results.numbers import plural

OPEN: Final = "unknown direction"
INCLUDABLE: Final = {
    "unknown": "its direction is not understood",
    "borehole": "its sensor is below ground",
    "structure": "its sensor is in a structure",
    "rotated": "it is turned from the components that were recorded",
}
"""Kinds of channels that a suite has if they are asked for, and why it has not else."""

FAULTS: Final = {"": "not understood", CONTRADICTION: CONTRADICTION, DAMAGED: DAMAGED}
"""Kinds of files that are records and cannot be read."""


@checked_result
@dataclass(frozen=True, kw_only=True)
class RecordSuite(Sequence[Record]):
    """The horizontal records of files and folders, a sequence, and what is left out of it.

    Parameters
    ----------
    recordings
        The channels.
    left_out
        Channels and files that are no horizontal motion of the ground, or cannot be read.
    """

    recordings: tuple[Recording, ...]
    left_out: tuple[LeftOut, ...] = ()

    def __len__(self) -> int:
        """Return the number of records."""
        return len(self.recordings)

    @overload
    def __getitem__(self, at: int) -> Record: ...
    @overload
    def __getitem__(self, at: slice) -> tuple[Record, ...]: ...
    def __getitem__(self, at: int | slice) -> Record | tuple[Record, ...]:
        """Return a record, or several."""
        return tuple(self)[at]

    def __iter__(self) -> Iterator[Record]:
        """Yield the records."""
        return (each.record for each in self.recordings)

    def __repr__(self) -> str:
        """Return how many records there are, and what is left out."""
        return f"<RecordSuite: {suite_words(self.recordings, self.left_out)}>"


def suite_words(recordings: Sequence[Recording], left_out: Sequence[LeftOut]) -> str:
    """Return how many records there are, and how many channels of which kind are left out.

    Examples
    --------
    >>> kinds = [LeftOut(file=Path("a"), kind=kind, why=kind) for kind in ("vertical", "velocity")]
    >>> suite_words([], kinds)
    '0 records; 2 channels left out: 1 velocity, 1 vertical'
    """
    open_ = sum(each.orientation == "unknown" for each in recordings)
    words = [plural(len(recordings), "record") + (f", {open_} of unstated direction" * (open_ > 0))]
    files = {NO_RECORD, *FAULTS.values()}
    for of_files, named in ((False, "channel"), (True, "file")):
        kinds = Counter(
            each.kind
            for each in left_out
            if (each.channel is None and each.kind in files) == of_files
        )
        counted = ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items()))
        if kinds:
            words.append(f"{plural(kinds.total(), named)} left out: {counted}")
    return "; ".join(words)


@checked
def read_records(
    folder: str | PathLike[str],
    *,
    pattern: str = "*",
    units: str | None = None,
    dt_s: float | None = None,
    ignore_header: bool = False,
    include: Sequence[str] = (),
    cleaning: Cleaning | None = None,
) -> RecordSuite:
    r"""Read all horizontal records of a folder, a suite, in the order of the file names.

    Vertical channels, those of another quantity, below ground, in structures, rotated ones, and
    those whose direction is stated and not understood are left out, as are files that are no
    records; `left_out` names them. The one channel of a file that states no direction counts as
    horizontal. `pair_records` brings vertical channels too.

    Parameters
    ----------
    folder
        The folder; hidden files and folders in it are left out.
    pattern
        Names of the files, as ``*.AT2``; by default all.
    units, dt_s, ignore_header
        As for `read_recordings`, for all files.
    include
        Kinds of channels that are taken all the same: ``unknown``, ``borehole``, ``structure``,
        ``rotated``.
    cleaning
        Offset, filter and trim of each; none by default.

    Returns
    -------
    RecordSuite
        Samples [m/s^2] and interval of each channel, a sequence of `Record`.

    Raises
    ------
    InputError
        If there is no such folder, or no horizontal record in it.
    RecordFileError
        If a record cannot be read; the message names its file.

    Examples
    --------
    >>> import tempfile
    >>> folder = Path(tempfile.mkdtemp())
    >>> for name in ("b", "a"):
    ...     _ = (folder / f"{name}.csv").write_text("t,acc ns (g)\n0,.1\n.01,-.2\n.02,.1\n")
    >>> suite = read_records(folder, pattern="*.csv")
    >>> [record.name for record in suite], suite
    (['a', 'b'], <RecordSuite: 2 records>)
    """
    place = Path(folder)
    if not place.is_dir():
        raise InputError("folder", folder, "there is no such folder", "name a folder of records")
    given: object = pattern
    if not isinstance(given, str) or not Path(given).parts:  # as of "."
        raise InputError("pattern", pattern, "it must be a text", 'give one as "*.AT2"')
    for kind in include:
        check_includable("include", kind)
    taken: list[Recording] = []
    left: list[LeftOut] = []
    files = [file for file in files_of(place) if file.match(pattern)]
    for file in files:
        try:
            recordings = read_recordings(file, units=units, dt_s=dt_s, ignore_header=ignore_header)
        except RecordFileError as error:
            if error.kind in FAULTS:
                raise
            left.append(file_left_out(file, error))
            continue
        across, others = select(recordings, include)
        taken += map((cleaning or Cleaning()).apply, across)
        left += others
    if not taken:
        hint = "name a folder of ground-motion files"
        raise InputError("folder", folder, nothing_left(left, f"files named {pattern}"), hint)
    return RecordSuite(recordings=tuple(taken), left_out=tuple(left))


def nothing_left(left_out: Sequence[LeftOut], named: str) -> str:
    """Return that no file has a horizontal record, and what they have."""
    words = suite_words((), left_out).removeprefix("0 records")
    return f"none of its {named} has a horizontal record{words}"


def check_includable(name: str, kind: object) -> str:
    """Return a kind of channels that may be asked for.

    Raises
    ------
    InputError
        If it is none.
    """
    if not isinstance(kind, str) or kind not in INCLUDABLE:
        raise InputError(
            name, kind, "it must be a kind of channels", f"use {', '.join(INCLUDABLE)}"
        )
    return kind


def file_left_out(file: Path, error: InputError) -> LeftOut:
    """Return why a file has no channel in a suite."""
    if not isinstance(error, RecordFileError):
        return LeftOut(file=file, kind=FAULTS[""], why=error.valid)
    return LeftOut(file=file, kind=FAULTS.get(error.kind, error.kind), why=error.clause)


def select(
    recordings: Sequence[Recording], include: Iterable[str] = ()
) -> tuple[tuple[Recording, ...], tuple[LeftOut, ...]]:
    """Return the channels of one file that are horizontal motions of the ground, and the others.

    Parameters
    ----------
    recordings
        Channels of a file.
    include
        Kinds that are taken all the same.
    """
    taken, left = [], [*recordings[0].left_out] if recordings else []
    for each in recordings:
        kind = kind_of(each, alone=len(recordings) == 1)
        if not kind or kind in include:
            taken.append(each)
            continue
        why = INCLUDABLE.get(kind, kind)
        counted = OPEN if kind == "unknown" else kind
        left.append(LeftOut(file=each.path, channel=each.component, kind=counted, why=why))
    return tuple(taken), tuple(left)


def kind_of(recording: Recording, *, alone: bool) -> str:
    """Return what keeps a channel from being a horizontal motion of the ground, or nothing.

    Parameters
    ----------
    recording
        The channel.
    alone
        Whether its file holds no other.
    """
    if recording.orientation == "vertical":
        return "vertical"
    if recording.position in {"borehole", "structure"}:
        return recording.position
    if pointing(recording.component).rotated:
        return "rotated"
    open_ = recording.orientation == "unknown" and (recording.directed or not alone)
    return "unknown" if open_ else ""


def files_of(folder: Path) -> list[Path]:
    """Return the files of a folder by name, without hidden ones."""
    return sorted(
        each for each in folder.iterdir() if not (each.is_dir() or each.name.startswith("."))
    )
