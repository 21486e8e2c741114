"""Finished parts of an incomplete study, kept in its output folder."""

import json
import re
import shutil
from collections.abc import Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

from rocksteady import __version__
from rocksteady.durable import PRIVATE
from rocksteady.errors import OutputError, check_installed
from rocksteady.show.export.files import FORMATS, json_text, save_text, save_whole
from rocksteady.sweep.store.store import Store

FOLDER = ".unfinished"
"""Name of the hidden folder inside that of the study."""
SCHEMA = "rocksteady/unfinished/1"
DESCRIPTION = "study.json"
OURS = re.compile(rf"part-[\w-]+\.zarr|figure-\w+\.({'|'.join(FORMATS)})|study\.json|{PRIVATE}")
"""Names of what lies there."""


class Parts:
    """What is finished of a study, in the folder that the study will fill.

    Parameters
    ----------
    folder
        Folder of the study.
    inputs
        All that its results follow from, in numbers and texts.
    resume
        Whether existing parts, of the same inputs, are used.
    force
        Whether existing parts are removed.
    sweeps
        Whether some of them are stores.

    Raises
    ------
    OutputError
        If parts exist and neither is given, they are those of other inputs, or sweeps need zarr,
        which is not installed.
    """

    def __init__(
        self,
        folder: Path | str,
        inputs: Mapping[str, Any],
        *,
        resume: bool = False,
        force: bool = False,
        sweeps: bool = True,
    ) -> None:
        self.study = Path(folder)
        if sweeps:
            check_installed(self._refused, "stores", "zarr")
        self.folder = self.study / FOLDER
        self._text = json_text(SCHEMA, {"version": __version__, **inputs}) + "\n"
        existing = self._there()
        foreign = self._foreign(described=existing is not None)
        if foreign:
            raise self._refused(
                f"no study wrote {foreign[0]} in it", "move that, or name another folder"
            )
        if existing is None:
            return
        if force and not resume:
            self.remove()
            return
        if not resume:
            raise self._refused(
                "it holds finished parts of a study",
                "add --resume to continue it, or --force to begin again",
            )
        if existing != self._text:
            before, now = (json.loads(text) for text in (existing, self._text))
            names = sorted(name for name in {*before, *now} if before.get(name) != now.get(name))
            raise self._refused(
                f"its finished parts are of another {' and '.join(names)}",
                "give the same again, or add --force in place of --resume to begin again",
            )

    def _refused(self, valid: str, hint: str) -> OutputError:
        return OutputError("out", self.study, valid, hint)

    def _foreign(self, *, described: bool) -> list[str]:
        """Return what has the name of a part, or lies in one, and no study wrote: relative paths.

        Without a description no study wrote anything.
        """
        if not self.folder.is_dir():
            return []
        names = []
        for path in sorted(self.folder.iterdir()):
            if not OURS.fullmatch(path.name):
                continue  # it stays
            if not described:
                names.append(f"{FOLDER}/{path.name}")
            elif path.suffix == ".zarr":
                inside = (
                    Store(path).foreign_files()
                    if path.is_dir() and not path.is_symlink()
                    else ["."]
                )
                names += [f"{FOLDER}/{path.name}/{name}" for name in inside]
        return names

    def _there(self) -> str | None:
        """Return the description of the existing parts; None without any."""
        try:
            text = (self.folder / DESCRIPTION).read_text(encoding="utf-8")
            return text if json.loads(text)["schema"] == SCHEMA else None
        except (OSError, ValueError, LookupError, TypeError):
            return None

    def begin(self) -> None:
        """Make the folder and describe what its parts are of.

        Raises
        ------
        OutputError
            If it cannot be made.
        """
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise self._refused(error.strerror or str(error), "check the folder") from error
        if self._there() is None:
            save_text("out", self.folder / DESCRIPTION, self._text)

    def store(self, name: str, chunk: int | None = None) -> Store:
        """Return where a sweep of the study is kept, written `chunk` cells at a time."""
        return Store(self.folder / f"part-{name}.zarr", resume=True, chunk=chunk)

    def kept(self, *names: str) -> list[bytes] | None:
        """Return the bytes of files that are kept; None where one is not there."""
        with suppress(OSError):
            return [(self.folder / name).read_bytes() for name in names]
        return None

    def keep(self, name: str, data: bytes) -> None:
        """Keep the bytes of a file."""
        save_whole("out", self.folder / name, partial(Path.write_bytes, data=data))

    @property
    def swept(self) -> bool:
        """Whether sweeps are kept, which take minutes."""
        return any(self.folder.glob("part-*.zarr"))

    def remove(self) -> None:
        """Remove the parts, and the folders where nothing else lies in them."""
        with suppress(OSError):
            # The description goes last: without it the parts belong to no study.
            for path in sorted(self.folder.iterdir(), key=lambda each: each.name == DESCRIPTION):
                if not OURS.fullmatch(path.name):
                    continue
                if path.suffix == ".zarr" and (path.is_symlink() or Store(path).foreign_files()):
                    continue  # it holds a file that no sweep wrote
                if path.is_dir() and not path.is_symlink():
                    shutil.rmtree(path, ignore_errors=True)
                else:
                    path.unlink(missing_ok=True)
            self.folder.rmdir()
            self.study.rmdir()
