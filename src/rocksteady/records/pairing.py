"""Channels of one station and earthquake, grouped: two horizontal and one vertical.

Networks publish them as three files or as one, and not always of one length or with one start.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from os import PathLike
from typing import Final, Literal

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.records.core.directions import TAIL, direction
from rocksteady.records.core.recording import Recording
from rocksteady.records.read import read_recordings
from rocksteady.results.result import Result

_SQUARE: Final = 1.0


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False)
class RecordSet(Result):
    """The channels of one station in one earthquake.

    Parameters
    ----------
    name
        Station and event, or what the names of the files share.
    horizontal
        The horizontal channels, in the order of the files; two as a rule.
    vertical
        The vertical channel, where there is one.
    other
        Channels whose direction the files do not state.
    warnings
        What keeps them from being used together as they are, a sentence each; differences of
        event, station, interval, length, start and direction are found here.
    """

    name: str
    horizontal: tuple[Recording, ...] = ()
    vertical: Recording | None = None
    other: tuple[Recording, ...] = ()
    warnings: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Add what differs between the channels to the warnings."""
        warnings = dict.fromkeys((*_doubts(self.recordings), *self._misplaced(), *self.warnings))
        object.__setattr__(self, "warnings", tuple(warnings))

    def _misplaced(self) -> tuple[str, ...]:
        """Return a sentence on each channel whose direction is not that of its place."""
        places = [(recording, "horizontal") for recording in self.horizontal]
        places += [] if self.vertical is None else [(self.vertical, "vertical")]
        return tuple(
            f"{recording.path.name}{f' ({recording.component})' if recording.component else ''} is "
            f"{recording.orientation}, in the place of a {place} channel"
            for recording, place in places
            if recording.orientation not in {"unknown", place}
        )

    @property
    def recordings(self) -> tuple[Recording, ...]:
        """All channels: horizontal, vertical, other."""
        vertical = () if self.vertical is None else (self.vertical,)
        return (*self.horizontal, *vertical, *self.other)

    @property
    def starts_s(self) -> tuple[float, ...]:
        """Time by which each of `recordings` begins after the first [s]; 0 unless all state it."""
        starts = [each.start_time for each in self.recordings if each.start_time is not None]
        if len(starts) < len(self.recordings):
            return (0.0,) * len(self.recordings)
        return tuple((start - min(starts)).total_seconds() for start in starts)

    def motions(self) -> tuple[BaseMotion, ...]:
        """Return a base motion for each horizontal channel, with the vertical one beside it.

        They begin together: of channels whose starts differ take those of `aligned`.

        Raises
        ------
        InputError
            If there is no horizontal channel.
        """
        if not self.horizontal:
            raise InputError(
                "horizontal",
                Words("is empty"),
                f"the channels of {self.name} have no known horizontal direction",
                "make BaseMotion(horizontal, vertical) of the records of `recordings`",
            )
        vertical = None if self.vertical is None else self.vertical.record
        return tuple(BaseMotion(each.record, vertical) for each in self.horizontal)

    def aligned(self, method: Literal["trim", "pad"]) -> "RecordSet":
        """Return the set with channels that begin together and have one length.

        Where all state when they begin, they are shifted by whole samples; else they are taken to
        begin together. What is done to each is in its `processing`.

        Parameters
        ----------
        method
            ``trim`` to the time that all cover, or ``pad`` with a still base.

        Raises
        ------
        InputError
            If the intervals between samples differ, no time is common to all, or the method is not
            known.
        """
        if method not in {"trim", "pad"}:
            raise InputError(
                "method", method, "it must be a way of making lengths equal", "use trim or pad"
            )
        channels = self.recordings
        intervals = sorted({recording.record.dt_s for recording in channels})
        if len(intervals) > 1:
            raise InputError(
                "dt_s",
                intervals,
                f"the channels of {self.name} have different intervals between samples",
                "bring them to one first (rocksteady.records.resample)",
            )
        shifts = _shifts(self)
        ends = [
            shift + len(recording.record.acceleration_m_s2)
            for shift, recording in zip(shifts, channels, strict=True)
        ]
        first, last = (max(shifts), min(ends)) if method == "trim" else (min(shifts), max(ends))
        if last - first < 2:
            raise InputError(
                "method",
                method,
                f"the channels of {self.name} have no time in common",
                "see whether they are of one earthquake, or pad",
            )
        moved = [
            _cut(recording, first - shift, last - shift)
            for shift, recording in zip(shifts, channels, strict=True)
        ]
        count = len(self.horizontal)
        vertical = None if self.vertical is None else moved[count]
        return RecordSet(
            name=self.name,
            horizontal=tuple(moved[:count]),
            vertical=vertical,
            other=tuple(moved[count + (vertical is not None) :]),
        )


@checked
def pair_records(
    paths: Iterable[str | PathLike[str]],
    *,
    units: str | None = None,
    dt_s: float | None = None,
) -> tuple[RecordSet, ...]:
    r"""Read files and group their channels by station and earthquake.

    Channels belong together where their files name the same station and event, or the same station
    and start; else where the names of the files are alike except for their ends (``CHY012-N``,
    ``CHY012-W``). Nothing is cut, padded or shifted: see `RecordSet.aligned`.

    Parameters
    ----------
    paths
        The files.
    units, dt_s
        As for `~rocksteady.records.read.read_recordings`, for all of them.

    Returns
    -------
    tuple of RecordSet
        In the order in which their first files come.

    Raises
    ------
    RecordFileError
        If a file cannot be read.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> folder = Path(tempfile.mkdtemp())
    >>> for end in ("000", "090", "-UP"):
    ...     _ = (folder / f"HUT{end}.csv").write_text("t,acc (g)\n0,.1\n.01,-.2\n.02,.1\n")
    >>> (one,) = pair_records(sorted(folder.iterdir()))
    >>> one.name, len(one.horizontal), one.vertical is not None
    ('HUT', 2, True)
    """
    files = (read_recordings(path, units=units, dt_s=dt_s) for path in paths)
    return paired(recording for recordings in files for recording in recordings)


def paired(recordings: Iterable[Recording]) -> tuple[RecordSet, ...]:
    """Return channels grouped by station and earthquake, as `pair_records` does."""
    groups: dict[tuple[str, ...], list[Recording]] = {}
    for recording in recordings:
        groups.setdefault(_key(recording), []).append(recording)
    return tuple(_set(key, recordings) for key, recordings in groups.items())


def pair_doubts(horizontal: Recording, vertical: Recording) -> tuple[str, ...]:
    """Return a sentence on everything that keeps two channels from being of one motion.

    Parameters
    ----------
    horizontal, vertical
        The channels that are to shake one block.
    """
    pair = RecordSet(name=horizontal.record.name or "", horizontal=(horizontal,), vertical=vertical)
    return pair.warnings


def _key(recording: Recording) -> tuple[str, ...]:
    """Return what the channels of one station and earthquake share."""
    if recording.station and recording.event:
        return recording.station, recording.event
    if recording.station and recording.start_time:
        return recording.station, recording.start_time.strftime("%Y-%m-%d %H:%M:%S")
    stem = recording.path.stem
    tail = TAIL.search(stem)
    shorter = TAIL.sub("", stem)
    # ELC180-hor1: the azimuth stands before the number of the component.
    if tail is not None and "h" in tail[0].lower():
        shorter = TAIL.sub("", shorter)
    return (shorter or stem,)


def _set(key: tuple[str, ...], recordings: list[Recording]) -> RecordSet:
    """Return the set of channels that belong together."""
    recordings = [_directed(recording) for recording in recordings]
    vertical = [recording for recording in recordings if recording.orientation == "vertical"]
    horizontal = tuple(
        recording for recording in recordings if recording.orientation == "horizontal"
    )
    unknown = tuple(recording for recording in recordings if recording.orientation == "unknown")
    doubts: tuple[str, ...] = ()
    if len(vertical) > 1:
        doubts = (*doubts, f"{len(vertical)} vertical channels: the first is taken")
    if len(horizontal) > 2:
        doubts = (*doubts, f"{len(horizontal)} horizontal channels: which belong together is open")
    return RecordSet(
        name=", ".join(key),
        horizontal=horizontal,
        vertical=vertical[0] if vertical else None,
        other=(*unknown, *vertical[1:]),
        warnings=doubts,
    )


def _directed(recording: Recording) -> Recording:
    """Return a recording whose direction is that of its file's name, where the file has none."""
    tail = TAIL.search(recording.path.stem)
    if recording.orientation != "unknown" or tail is None:
        return recording
    orientation, azimuth = direction(tail[0].strip("-_. "))
    return replace(recording, orientation=orientation or "unknown", azimuth_deg=azimuth)


def _doubts(channels: tuple[Recording, ...]) -> tuple[str, ...]:
    """Return a sentence on everything that differs between channels to be used together."""
    doubts = []
    for name, stated in (
        ("events", [recording.event for recording in channels]),
        ("stations", [recording.station for recording in channels]),
    ):
        unlike = {" ".join(words.lower().split()): words for words in stated if words}
        if len(unlike) > 1:
            doubts.append(f"{name} {' and '.join(map(repr, unlike.values()))}")
    intervals = sorted({recording.record.dt_s for recording in channels})
    if len(intervals) > 1:
        doubts.append(f"intervals of {', '.join(f'{value:g}' for value in intervals)} s")
    lengths = sorted({len(recording.record.acceleration_m_s2) for recording in channels})
    if len(lengths) > 1:
        doubts.append(f"lengths from {lengths[0]:,} to {lengths[-1]:,} samples")
    starts = {recording.start_time for recording in channels if recording.start_time is not None}
    if len(starts) > 1:
        apart = (max(starts) - min(starts)).total_seconds()
        doubts.append(f"starts up to {apart:g} s apart")
    across = [recording for recording in channels if recording.orientation == "horizontal"]
    azimuths = [recording.azimuth_deg for recording in across if recording.azimuth_deg is not None]
    complete = len(azimuths) == len(across) == 2
    if complete and abs(abs((azimuths[0] - azimuths[1]) % 180.0 - 90.0)) > _SQUARE:
        doubts.append(f"azimuths {azimuths[0]:g} and {azimuths[1]:g} deg, not at right angles")
    return tuple(doubts)


def _shifts(channels: "RecordSet") -> list[int]:
    """Return by how many samples each channel begins after the first one."""
    return [
        round(start / recording.record.dt_s)
        for start, recording in zip(channels.starts_s, channels.recordings, strict=True)
    ]


def _cut(recording: Recording, first: int, last: int) -> Recording:
    """Return a recording from one sample to before another, still where it has none."""
    import numpy as np

    values = recording.record.acceleration_m_s2
    count = len(values)
    if (first, last) == (0, count):
        return recording
    before, after = max(-first, 0), max(last - count, 0)
    kept = np.pad(values[max(first, 0) : min(last, count)], (before, after))
    note = (
        f"{max(first, 0):,} samples cut from the start and {max(count - last, 0):,} from the end, "
        f"{before:,} and {after:,} zeros put there"
    )
    record = replace(recording.record, acceleration_m_s2=kept)
    start = recording.start_time
    if start is not None:
        from datetime import timedelta

        start += timedelta(seconds=first * recording.record.dt_s)
    return replace(recording.processed(record, note), start_time=start)
