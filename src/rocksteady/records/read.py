"""Reader of ground-motion files: detects the format from the content, reads all channels."""

from collections.abc import Callable
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Final

import numpy as np

from rocksteady.errors import InputError, RecordFileError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.motions.record import Record
from rocksteady.records.core.assembling import Given
from rocksteady.records.core.recording import Recording
from rocksteady.records.core.text import RecordText, as_text, file_bytes
from rocksteady.records.examples import is_example, read_example
from rocksteady.records.formats import columns, cosmos, csmip, esm, knet, peer, smc, waveforms
from rocksteady.records.formats.unrecognised import network_of
from rocksteady.records.processing import correct_baseline

Reader = Callable[[RecordText, Given], tuple[Recording, ...]]
Recogniser = Callable[[RecordText], bool]

_READERS: Final[tuple[tuple[tuple[str, ...], Recogniser, Reader], ...]] = (
    ((knet.KNET, knet.KIKNET), knet.recognises, knet.read),
    ((esm.FORMAT,), esm.recognises, esm.read),
    (cosmos.FORMATS, cosmos.recognises, cosmos.read),
    (csmip.FORMATS, csmip.recognises, csmip.read),
    ((smc.FORMAT,), smc.recognises, smc.read),
    ((peer.FORMAT,), peer.recognises, peer.read),
    ((columns.CSV, columns.COLUMNS), columns.recognises, columns.read),
)
"""Formats of text, in the order of trial: short names, recognisers and readers."""

FORMATS: Final = (
    *(name for names, _, _ in _READERS for name in names),
    waveforms.MSEED,
    waveforms.SAC,
)
"""Short names of the formats that can be read."""


@checked
def read_recordings(
    path: str | PathLike[str],
    *,
    format: str | None = None,  # noqa: A002 -- the word that users have for it
    units: str | None = None,
    dt_s: float | None = None,
    column: str | int | None = None,
    resample: bool = False,
) -> tuple[Recording, ...]:
    r"""Read all acceleration channels of a ground-motion file, in the file's order.

    Parameters
    ----------
    path
        The file, or a synthetic motion that ships with the package: ``example:near-fault``,
        ``example:firm-ground`` or ``example:soft-soil``.
    format
        Its format by short name; by default found from what stands in it, never from its name.
    units
        Unit of its numbers, where it does not state them, or states them wrongly: ``g``, ``mg``,
        ``m/s^2``, ``cm/s^2``, ``mm/s^2``, ``gal``, ``mgal``, ``in/s^2``, ``ft/s^2``.
    dt_s
        Interval between its samples [s], where it does not state it, or states it wrongly.
    column
        For a table: the column with the acceleration, by its number from 1 or its name.
    resample
        Whether a table whose times are unevenly spaced may be interpolated to even ones.

    Returns
    -------
    tuple of Recording
        One for each channel, with warnings, and notes on what has been done.

    Raises
    ------
    RecordFileError
        If the file cannot be read, is in no known format, holds no acceleration, or does not state
        what is needed; the message names the line.
    InputError
        If an argument is not valid.

    Examples
    --------
    >>> import tempfile
    >>> path = Path(tempfile.mkdtemp()) / "hut.AT2"
    >>> head = "PEER\nSomewhere, 1/2/1990, Hut, 090\nACCELERATION IN UNITS OF G\n"
    >>> _ = path.write_text(head + "3 .01 NPTS, DT\n .1-.2 .05\n")
    >>> (recording,) = read_recordings(path)
    >>> recording.station, recording.component, recording.record
    ('Hut', '090', Record(name='hut', samples=3, dt_s=0.01, peak_acceleration_m_s2=1.96133))
    """
    given = Given(units=units, dt_s=dt_s, column=column, resample=resample)
    if format is not None and format not in FORMATS:
        hint = f"use one of {', '.join(FORMATS)}, or leave it out"
        raise InputError("format", format, "it must be a format that can be read", hint)
    file = Path(path)
    if is_example(file):
        stated = {"format": format, "units": units, "dt_s": dt_s, "column": column}
        for name, value in (stated | {"resample": resample or None}).items():
            if value is not None:
                raise InputError(name, value, f"{file} is no file", "leave it out")
        return (read_example(file),)
    data = file_bytes(file)
    # What overflows is refused when the record is made.
    with np.errstate(all="ignore"):
        recordings = _found(file, data, format, given)
    if recordings is not None:
        return _told_apart(recordings)
    raise RecordFileError(
        path=file,
        valid="it is in no format that can be read",
        hint=f"give a file of one of these: {', '.join(FORMATS)}",
    )


@checked
def read_record(
    path: str | PathLike[str],
    *,
    channel: str | int | None = None,
    format: str | None = None,  # noqa: A002 -- as above
    units: str | None = None,
    dt_s: float | None = None,
    column: str | int | None = None,
    resample: bool = False,
    baseline: str = "none",
) -> Record:
    """Read one acceleration channel of a ground-motion file.

    Parameters
    ----------
    path, format, units, dt_s, column, resample
        As for `read_recordings`.
    channel
        Which one, where the file holds several: its number from 1, or its component.
    baseline
        What to take off: ``none``, ``mean``, ``linear`` or ``polynomial:N``.

    Returns
    -------
    Record
        The samples [m/s^2] and their interval.

    Raises
    ------
    RecordFileError
        As for `read_recordings`.
    InputError
        If the file holds several channels and none is chosen, or the file has no such channel.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> path = Path(tempfile.mkdtemp()) / "shock.csv"
    >>> rows = ["time (s),acceleration (g)", "0,0", "0.01,0.2", "0.02,-0.1", "0.03,0"]
    >>> _ = path.write_text(chr(10).join(rows))
    >>> read_record(path)
    Record(name='shock', samples=4, dt_s=0.01, peak_acceleration_m_s2=1.96133)
    """
    recordings = read_recordings(
        path, format=format, units=units, dt_s=dt_s, column=column, resample=resample
    )
    return correct_baseline(chosen(recordings, channel), baseline).record


@checked
def read_records(
    folder: str | PathLike[str],
    *,
    pattern: str = "*",
    units: str | None = None,
    dt_s: float | None = None,
) -> tuple[Record, ...]:
    r"""Read all horizontal records of a folder, a suite, in the order of the file names.

    Channels of unknown direction count as horizontal.  `pair_records` brings vertical ones too.

    Parameters
    ----------
    folder
        The folder; hidden files and folders in it are left out.
    pattern
        Names of the files, as ``*.AT2``; by default all.
    units, dt_s
        As for `read_recordings`, for all files.

    Returns
    -------
    tuple of Record
        Samples [m/s^2] and interval of each channel.

    Raises
    ------
    InputError
        If there is no such folder, or no horizontal record in it.
    RecordFileError
        If a file cannot be read; the message names it.

    Examples
    --------
    >>> import tempfile
    >>> folder = Path(tempfile.mkdtemp())
    >>> for name in ("b", "a"):
    ...     _ = (folder / f"{name}.csv").write_text("t,acc (g)\n0,.1\n.01,-.2\n.02,.1\n")
    >>> [record.name for record in read_records(folder, pattern="*.csv")]
    ['a', 'b']
    """
    place = Path(folder)
    if not place.is_dir():
        raise InputError("folder", folder, "there is no such folder", "name a folder of records")
    given: object = pattern
    if not isinstance(given, str) or not Path(given).parts:  # as of "."
        raise InputError("pattern", pattern, "it must be a text", 'give one as "*.AT2"')
    files = [file for file in files_of(place) if file.match(pattern)]
    recordings = [each for file in files for each in read_recordings(file, units=units, dt_s=dt_s)]
    records = tuple(each.record for each in recordings if each.orientation != "vertical")
    if not records:
        raise InputError(
            "folder",
            folder,
            f"none of its {len(files)} files named {pattern} has a horizontal record",
            "name a folder of ground-motion files",
        )
    return records


def files_of(folder: Path) -> list[Path]:
    """Return the files of a folder by name, without hidden ones."""
    return sorted(
        each for each in folder.iterdir() if each.is_file() and not each.name.startswith(".")
    )


def _found(
    file: Path, data: bytes, wanted: str | None, given: Given
) -> tuple[Recording, ...] | None:
    """Return what the reader of a format makes of a file, or None where none recognises it."""
    binary = waveforms.recognised(data) if wanted is None else wanted
    if binary in {waveforms.MSEED, waveforms.SAC}:
        return waveforms.read(file, data, binary, given)
    text = as_text(file, data)
    for names, recognises, read in _READERS:
        if wanted in names or (wanted is None and recognises(text)):
            if wanted is None and columns.CSV in names:
                columns.refuse_geonet(text)
                _refuse_damaged(text)
            return read(text, given)
    if wanted is None:
        _refuse_damaged(text)
        columns.refuse_without_rows(text)
    return None


def _refuse_damaged(text: RecordText) -> None:
    """Raise where lines of a network's header show a damaged file, which is no table.

    Raises
    ------
    RecordFileError
        As above.
    """
    network = network_of(text)
    if network is not None:
        valid = f"it is a line of {network[0]}'s header, and the rest of that header is damaged"
        hint = "fetch the file again, or give format columns where it is a table of its own"
        raise text.error(valid, hint, at=network[1])


def _told_apart(recordings: tuple[Recording, ...]) -> tuple[Recording, ...]:
    """Return recordings of one file with names of their own: the file's, and their component's."""
    if len(recordings) < 2:
        return recordings
    return tuple(
        replace(
            recording,
            record=replace(
                recording.record,
                name=f"{recording.record.name} {recording.component or f'channel {position}'}",
            ),
        )
        for position, recording in enumerate(recordings, 1)
    )


def chosen(recordings: tuple[Recording, ...], channel: str | int | None) -> Recording:
    """Return the channel that a caller means, by its number from 1 or its component.

    Raises
    ------
    InputError
        If there are several and none is named, or there is no such channel.
    """
    listed = ", ".join(
        f"{position} ({recording.component or recording.record.name})"
        for position, recording in enumerate(recordings, 1)
    )
    if channel is None:
        if len(recordings) == 1:
            return recordings[0]
        raise InputError(
            "channel",
            Words("is not given"),
            f"{recordings[0].path} holds {len(recordings)} channels",
            f"choose one: {listed}",
        )
    wanted = str(channel).strip().lower()
    if isinstance(channel, str):
        named = [
            recording
            for recording in recordings
            if (recording.component or "").strip().lower() == wanted
        ]
        if len(named) == 1:
            return named[0]
    if len(wanted) < 10 and wanted.isdecimal() and 1 <= int(wanted) <= len(recordings):
        return recordings[int(wanted) - 1]
    raise InputError(
        "channel", channel, f"{recordings[0].path} has no such channel", f"choose one: {listed}"
    )
