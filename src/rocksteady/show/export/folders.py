"""Output folders: checked before computing, written whole or left unchanged."""

import hashlib
import os
import re
import shutil
from collections.abc import Callable, Collection, Iterable, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import NamedTuple

from rocksteady import durable
from rocksteady.errors import OutputError

MANIFESTS = {"run.json", "fit.json"}
"""Files of which every folder of an answer holds one."""


def check_folder(
    folder: Path | str,
    ours: str,
    *,
    force: bool = False,
    read: Iterable[Path | str] = (),
    hashes: Collection[str | None] = (),
) -> None:
    """Refuse, before anything is computed, a folder that could not be filled.

    Parameters
    ----------
    folder
        Where it goes.
    ours
        Regular expression of the names of the files that are written.
    force
        Whether files of such names are replaced.
    read
        Files that are read.
    hashes
        SHA-256 of files that were read, where their paths are not known.

    Raises
    ------
    OutputError
        If its parent is missing or not writable, it is a file, or it holds files of these names and
        `force` is off; with `force`, if one of these names is that of a folder, a device, a pipe
        or a file that is read.
    """
    target = Path(folder)
    parent = target.absolute().parent
    try:
        target.exists()
    except OSError as error:  # a name of too many characters
        raise OutputError(
            "out", target, error.strerror or str(error), "name another folder"
        ) from error
    if target.is_dir():
        named = sorted(file for file in target.iterdir() if re.fullmatch(ours, file.name))
        for file in named:
            problem = durable.obstacle(file)
            if problem is not None:
                raise OutputError("out", file, problem[0], "move it, or name another folder")
            if _was_read(file, [Path(each) for each in read], hashes):
                raise OutputError("out", file, "this file is read", "name another folder")
        held = [] if force else [file.name for file in named]
        if held:
            raise OutputError(
                "out",
                target,
                f"it holds {held[0]}" + (f" and {len(held) - 1} more" if held[1:] else ""),
                "add --force to replace them, or name another folder",
            )
    if os.path.lexists(target) and not target.is_dir():
        valid, hint = "it is a file", "name a folder"
    elif not parent.is_dir():
        valid, hint = "the folder it would be in does not exist", "create that folder"
    elif not os.access(target if target.is_dir() else parent, os.W_OK):
        valid, hint = "it is not writable", "choose another folder"
    else:
        return
    raise OutputError("out", target, valid, hint)


def _was_read(file: Path, read: Iterable[Path], hashes: Collection[str | None]) -> bool:
    """Return whether a file is read too, by its path or by its content."""
    if any(durable.same_file(file, each) for each in read):
        return True
    if not hashes:
        return False
    with suppress(OSError), file.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest() in hashes
    return False


class OwnFolder(NamedTuple):
    """A folder that is wholly ours."""

    ours: str
    """Regular expression of the names of its files."""
    kind: str
    """What it is of, as "an assessment"."""

    def check(
        self,
        folder: Path | str,
        *,
        force: bool = False,
        read: Iterable[Path | str] = (),
        hashes: Collection[str | None] = (),
    ) -> None:
        """Refuse, before anything is computed, a folder that could not be filled.

        Parameters
        ----------
        folder, force, read, hashes
            As for `check_folder`.

        Raises
        ------
        OutputError
            As for `check_folder`; and if the folder holds anything else, or files of such names
            without the manifest of an earlier answer, which therefore did not write them.
        """
        target = Path(folder)
        check_folder(target, self.ours, force=force, read=read, hashes=hashes)
        held = sorted(each.name for each in target.iterdir()) if target.is_dir() else []
        foreign = [
            name for name in held if not re.fullmatch(f"{self.ours}|{durable.PRIVATE}", name)
        ]
        named = [name for name in held if re.fullmatch(self.ours, name)]
        if named and not foreign and not MANIFESTS & set(named):
            raise OutputError(
                "out",
                target,
                f"it holds {named[0]}, which no earlier answer wrote",
                "move it, or name a new or an empty folder",
            )
        if foreign:
            raise OutputError(
                "out",
                target,
                f"it holds {foreign[0]}, which is no file of {self.kind}",
                "name a new or an empty folder",
            )

    def fill(
        self,
        folder: Path | str,
        write: Callable[[Path], None],
        *,
        force: bool = False,
        read: Iterable[Path | str] = (),
        hashes: Collection[str | None] = (),
    ) -> list[Path]:
        """Fill a folder, and remove what an earlier answer left in it.

        Parameters
        ----------
        folder, force, read, hashes
            As for `check_folder`.
        write
            As for `fill_folder`.

        Returns
        -------
        list of Path
            The written files.

        Raises
        ------
        OutputError
            As for `check` and `fill_folder`.
        """
        check = partial(self.check, folder, force=force, read=read, hashes=hashes)
        return fill_folder(folder, write, check, ours=self.ours)


ASSESSMENT = OwnFolder(
    r"report\.html|(answers|results|shares|fragility)\.csv|(run|fragility)\.json|fragility\.xml",
    "an assessment",
)
CALIBRATION = OwnFolder(
    r"report\.html|fit\.json|(posterior|predictions|parameters)\.csv", "a calibration"
)


def fill_folder(
    folder: Path | str,
    write: Callable[[Path], None],
    check: Callable[[], None],
    *,
    within: Path | None = None,
    ours: str | None = None,
) -> list[Path]:
    """Write files into a hidden folder in the target first and move them out of it at the end.

    They are moved one writer at a time: of two that began with a new folder, and may replace
    nothing, the second is refused.

    Parameters
    ----------
    folder
        Made if it does not exist, in an existing folder; what else it holds stays.
    write
        Writes every file into the folder that it is given.
    check
        Refuses a folder that could not be filled, before anything is written and again before the
        files are moved.
    within
        Where the hidden folder is made, inside the target; by default the target itself.
    ours
        Regular expression of the names of files that are removed if they are not written anew.

    Returns
    -------
    list of Path
        The written files.

    Raises
    ------
    OutputError
        As `check` does, and if the folder cannot be made or written.
    """
    check()
    target = Path(folder)
    made = not target.is_dir()
    try:
        target.mkdir(exist_ok=True)
        durable.sync_folder(target.absolute().parent)
        # Inside the target, so that moving never crosses from one disk to another.
        with durable.private_folder(within or target) as stage:
            try:
                write(stage)
            except OutputError as error:  # whose path is one that goes away with this folder
                raise OutputError("out", target, error.valid, error.hint) from error
            with durable.alone(target):
                check()
                made = False  # from here on it holds something
                written = _move(sorted(stage.iterdir()), target)
                fresh = {each.name for each in written}
                for file in target.iterdir() if ours else ():  # of an earlier answer
                    if file.name not in fresh and re.fullmatch(str(ours), file.name):
                        file.unlink()
                return written
    except OSError as error:
        raise OutputError(
            "out",
            target,
            error.strerror or str(error),
            "check the folder and the space that is left",
        ) from error
    finally:
        if made:
            with suppress(OSError):
                target.rmdir()


def _move(staged: Sequence[Path], folder: Path) -> list[Path]:
    """Move files into a folder; where the target is a link, write what it leads to.

    All are forced to the disk before the first is moved: a run that is ended while it waits for the
    disk leaves the old files, and no mixture of old and new ones.
    """
    places = {file: folder / file.name for file in staged}
    links = {file: place for file, place in places.items() if place.is_symlink()}
    durable.move_all({file: place for file, place in places.items() if file not in links})
    for file, place in links.items():  # perhaps to another disk
        durable.write(place, lambda new, file=file: shutil.copyfile(file, new))  # type: ignore[misc]
    return list(places.values())
