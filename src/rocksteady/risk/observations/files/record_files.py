"""Record files that tests name: each is found, read and hashed once."""

import difflib
import hashlib
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Any

from rocksteady.errors import InputError, RocksteadyError, Words
from rocksteady.model.motions.record import Record
from rocksteady.records.core.recording import Recording
from rocksteady.records.processing import Cleaning
from rocksteady.records.read import chosen, read_recordings

Channel = tuple[Path, int]
"""A channel of a file: the path, and its number from 1."""


class RecordFiles:
    """Record files of a folder.

    Parameters
    ----------
    folder
        Where they lie.
    cleaning, options
        As for `rocksteady.read_record`: units, dt_s, format, column and resample.

    Attributes
    ----------
    sources
        Hash of each file that has been read, by its path from the folder on.
    remarks
        Warnings about them.
    """

    def __init__(self, folder: Path, *, cleaning: Cleaning, **options: Any) -> None:
        self._folder = folder.resolve()
        self._cleaning, self._options = cleaning, options
        self._found: dict[str, Path] = {}
        self._read: dict[Path, tuple[Recording, ...]] = {}
        self._named: dict[Channel, Record] = {}
        self.sources: dict[str, str] = {}
        self.remarks: list[str] = []

    def channel(self, name: str, channel: str, place: str, channel_place: str) -> Channel:
        """Return the channel that a cell names; its file is read if it has not been.

        Parameters
        ----------
        name, channel
            The cells: a file with or without its suffix, and a number or a component.
        place, channel_place
            File, line and column of either, for messages.

        Raises
        ------
        InputError
            If there is no such file or channel, several, or the file cannot be read.
        """
        path = self._path(name, place)
        try:
            if path not in self._read:
                self._read[path] = self._all_channels(path)
            recording = chosen(self._read[path], channel or None)
        except RocksteadyError as error:
            if error.name in Cleaning.__dataclass_fields__:
                raise
            if error.name == "channel":
                raise InputError(channel_place, error.value, error.valid, error.hint) from None
            # The name of the file is in the cell, and its whole path adds nothing.
            raise InputError(place, name, f"it cannot be read: {error.valid}", error.hint) from None
        number = 1 + next(k for k, each in enumerate(self._read[path]) if each is recording)
        self._named[path, number] = recording.record
        return path, number

    def records(self) -> dict[Channel, Record]:
        """Return every channel that has been named, each record with a name of its own."""
        alike = Counter(record.name for record in self._named.values())
        records = {}
        for (path, number), record in self._named.items():
            records[path, number] = record
            if alike[record.name] > 1:
                several = f" channel {number}" if len(self._read[path]) > 1 else ""
                records[path, number] = replace(record, name=f"{self._shown(path)}{several}")
        return records

    def _all_channels(self, path: Path) -> tuple[Recording, ...]:
        """Return the channels of a file, and keep its hash and its warnings."""
        read = read_recordings(path, **self._options)
        recordings = tuple(map(self._cleaning.apply, read))
        shown = self._shown(path)
        self.sources[shown] = hashlib.sha256(path.read_bytes()).hexdigest()
        remarks = dict.fromkeys(text for each in recordings for text in each.warnings)
        self.remarks += [f"{shown}: {text}" for text in remarks]
        return recordings

    def _shown(self, path: Path) -> str:
        """Return a path from the folder on where it lies there."""
        inside = path.is_relative_to(self._folder)
        return path.relative_to(self._folder).as_posix() if inside else path.as_posix()

    def _path(self, name: str, place: str) -> Path:
        """Return the file that a name means."""
        if name in self._found:
            return self._found[name]
        hint = "name a file of the folder of records, with or without its suffix"
        if not name:
            raise InputError(place, Words("is empty"), "it is the file of a motion", hint)
        given = self._folder / name
        try:
            path = given if given.is_file() else self._by_stem(given, name, place, hint)
            path = path.resolve()
        except (OSError, ValueError) as error:
            if isinstance(error, InputError):
                raise
            words = getattr(error, "strerror", None) or str(error)
            raise InputError(place, name, words, hint) from None
        self._found[name] = path
        return path

    def _by_stem(self, given: Path, name: str, place: str, hint: str) -> Path:
        """Return the file whose name without its suffix is that which is given."""
        folder = given.parent
        if not folder.is_dir():
            raise InputError(place, name, f"there is no folder {folder}", hint)
        files = sorted(path for path in folder.iterdir() if path.is_file())
        fitting = [path for path in files if path.stem == given.name]
        if len(fitting) == 1:
            return fitting[0]
        if fitting:
            names_fitting = ", ".join(path.name for path in fitting)
            raise InputError(
                place, name, f"{names_fitting} have this name", "give it with its suffix"
            )
        if given.is_dir():
            raise InputError(place, name, "it is a folder", hint)
        names = [path.name for path in files] + [path.stem for path in files]
        near = difflib.get_close_matches(given.name, names, n=1)
        more = f"did you mean {near[0]}?" if near else hint
        raise InputError(place, name, f"there is no such file in {folder}", more)
