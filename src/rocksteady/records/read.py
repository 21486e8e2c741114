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
from rocksteady.records.core.text import NO_RECORD, RecordText, as_text, file_bytes
from rocksteady.records.examples import is_example, read_example
from rocksteady.records.formats import (
    columns,
    cosmos,
    csmip,
    esm,
    knet,
    peer,
    smc,
    waveforms,
)
from rocksteady.records.processing import Cleaning

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
    ignore_header: bool = False,
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
        Unit of its numbers, where it does not state it: ``g``, ``mg``, ``m/s^2``, ``cm/s^2``,
        ``mm/s^2``, ``gal``, ``mgal``, ``in/s^2``, ``ft/s^2``.
    dt_s
        Interval between its samples [s], where it does not state it.
    column
        For a table: the column with the acceleration, by its number from 1 or its name.
    resample
        Whether a table whose times are unevenly spaced may be interpolated to even ones.
    ignore_header
        Whether the numbers are taken as plain columns by `units` and `dt_s` alone, whatever the
        file states; it stands in `processing`.

    Returns
    -------
    tuple of Recording
        One for each channel, with warnings, and notes on what has been done.

    Raises
    ------
    RecordFileError
        If the file cannot be read, is in no known format, holds no acceleration, does not state
        what is needed, or states another unit or interval than is given; the message names the
        line.
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
    given = Given(
        units=units, dt_s=dt_s, column=column, resample=resample, ignore_header=ignore_header
    )
    if format is not None and format not in FORMATS:
        hint = f"use one of {', '.join(FORMATS)}, or leave it out"
        raise InputError("format", format, "it must be a format that can be read", hint)
    file = Path(path)
    if is_example(file):
        stated = {"format": format, "units": units, "dt_s": dt_s, "column": column}
        stated |= {"resample": resample or None, "ignore_header": ignore_header or None}
        for name, value in stated.items():
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
        kind=NO_RECORD,
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
    cleaning: Cleaning | None = None,
) -> Record:
    """Read one acceleration channel of a ground-motion file.

    Parameters
    ----------
    path, format, units, dt_s, column, resample
        As for `read_recordings`, which can also ignore a header.
    channel
        Which one, where the file holds several: its number from 1, or its component.
    cleaning
        Offset, filter and trim; none by default.

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
    return (cleaning or Cleaning()).apply(chosen(recordings, channel)).record


def _found(
    file: Path, data: bytes, wanted: str | None, given: Given
) -> tuple[Recording, ...] | None:
    """Return what the reader of a format makes of a file, or None where none recognises it."""
    binary = waveforms.recognised(data) if wanted is None else wanted
    if binary in {waveforms.MSEED, waveforms.SAC}:
        return waveforms.read(file, data, binary, given)
    text = as_text(file, data)
    if given.ignore_header:
        return columns.read_samples(text, given)
    for names, recognises, read in _READERS:
        if wanted in names or (wanted is None and recognises(text)):
            try:
                return read(text, given)
            except RecordFileError as error:
                if error.kind or wanted is not None or read is columns.read:
                    raise
                return _as_table(text, given, error)
    columns.refuse_without_rows(text)
    return None


def _as_table(text: RecordText, given: Given, why: RecordFileError) -> tuple[Recording, ...]:
    """Return the channels of a network's file whose header is not understood, read as a table.

    Raises
    ------
    RecordFileError
        What the network's reader finds wrong, unless the table states all that is needed.
    """
    try:
        columns.read(text, replace(given, units=None, dt_s=None))
    except InputError as error:
        raise why from error
    warning = f"it is read as a table: {why.valid}"
    return tuple(
        # Where it points may stand in what is not understood.
        replace(each, warnings=(warning, *each.warnings), directed=True)
        for each in columns.read(text, given)
    )


def _told_apart(recordings: tuple[Recording, ...]) -> tuple[Recording, ...]:
    """Return recordings of one file with names of their own: the file's, and their component's."""
    if len(recordings) < 2:
        return recordings
    names = [each.component or f"channel {at}" for at, each in enumerate(recordings, 1)]
    numbered = (
        f"{name} (channel {at})" if names.count(name) > 1 else name
        for at, name in enumerate(names, 1)
    )
    return tuple(
        replace(each, record=replace(each.record, name=f"{each.record.name} {name}"))
        for each, name in zip(recordings, numbered, strict=True)
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
