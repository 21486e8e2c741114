"""File writes after which a crash or a power failure leaves the old version or the new one whole.

Every output of the package takes this way: it is written in a private folder beside its place,
forced to the disk, and moved; then the folder that holds it is forced to the disk.
"""

import os
import re
import shutil
import stat
import unicodedata
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import TemporaryDirectory

PREFIX = ".rocksteady-partial-"
"""Begins the names of private folders; `tempfile` adds eight random characters."""
PRIVATE = re.escape(PREFIX) + r"\w{8}"
"""Names of private folders, as a regular expression."""

FEW, AT_ONCE = 4, 32
"""Files that are forced to the disk one after another, and threads where there are more."""
_missing: set[Path] = set()
"""Places in which there was nothing when `expect` looked, and nothing may be replaced."""


def expect(file: Path, *, replace: bool) -> None:
    """Note whether what is found in the place of a file when it is written may be replaced.

    Without it anything may. A run takes minutes, in which another program may write there.
    """
    (_missing.discard if replace else _missing.add)(place_of(file))


def obstacle(file: Path) -> tuple[str, str] | None:
    """Return why no file can be written at a path, and what to do; None where one can.

    Links are followed. A device, a pipe or a folder is never replaced.
    """
    try:
        mode = os.stat(file).st_mode  # noqa: PTH116 -- the same for links of every kind
    except FileNotFoundError:
        folder = place_of(file).parent
        if not folder.is_dir():
            link = "the folder that the link leads to" if file.is_symlink() else "its folder"
            return f"{link} does not exist", "create the folder"
    except (OSError, ValueError) as error:
        return getattr(error, "strerror", None) or str(error), "name another file"
    else:
        if stat.S_ISDIR(mode):
            return "it is a folder", "name a file"
        if not stat.S_ISREG(mode):
            return "it is a device or a pipe", "name a file"
    return None


def place_of(file: Path) -> Path:
    """Return the path that a file has without links."""
    return Path(os.path.realpath(file))


def same_file(one: Path, other: Path) -> bool:
    """Return whether two paths lead to one file, through links and other spellings too.

    Of two files that do not exist yet, names that differ in case alone count as one: some file
    systems ignore it.
    """
    try:
        return one.samefile(other)
    except (OSError, ValueError):
        places = place_of(one), place_of(other)
        if any(os.path.lexists(place) for place in places):
            return False
        spelled = {unicodedata.normalize("NFC", str(place)).casefold() for place in places}
        return len(spelled) == 1


def write(file: Path, fill: Callable[[Path], object]) -> None:
    """Write a file so that its place holds the old content or the whole new one.

    Parameters
    ----------
    file
        Where it goes; a link stays, and what it leads to is replaced.
    fill
        Writes the path that it is given, in a folder that only this user may open.

    Raises
    ------
    OSError
        If it cannot be written; FileExistsError if there is a file that may not be replaced.
    """
    place = place_of(file)
    with private_folder(place.parent) as folder:
        staged = folder / place.name
        fill(staged)
        with suppress(FileNotFoundError):
            staged.chmod(stat.S_IMODE(place.stat().st_mode))
        if place in _missing:
            sync(staged)
            _move_to_nothing(staged, place)
            sync_folder(place.parent)
            _missing.discard(place)
        else:
            move(staged, place)


@contextmanager
def private_folder(parent: Path) -> Iterator[Path]:
    """Make a private folder and remove it at the end; folders of killed programs are removed too.

    A program holds a lock on its folder, which the system drops when the program ends in any way.

    Parameters
    ----------
    parent
        Where it is made.

    Raises
    ------
    OSError
        If it cannot be made.
    """
    _remove_left(parent)
    while True:
        made = TemporaryDirectory(prefix=PREFIX, dir=parent, ignore_cleanup_errors=True)
        with made as folder:
            held = _locked(Path(folder), wait=True)
            try:
                if not Path(folder).is_dir():  # another program came between and removed it
                    continue
                yield Path(folder)
                return
            finally:
                if held is not None:
                    os.close(held)


@contextmanager
def alone(folder: Path) -> Iterator[None]:
    """Hold a folder: another program, or thread, that would hold it waits until the end."""
    held = _locked(folder, wait=True)
    try:
        yield
    finally:
        if held is not None:
            os.close(held)


def _remove_left(parent: Path) -> None:
    """Remove private folders that no running program holds.

    Folders of other users stay, and folders that other users may enter.
    """
    with suppress(OSError):
        for folder in parent.glob(f"{PREFIX}*"):
            about = folder.lstat()
            ours = stat.S_ISDIR(about.st_mode) and stat.S_IMODE(about.st_mode) == stat.S_IRWXU
            if not (ours and re.fullmatch(PRIVATE, folder.name)) or about.st_uid != os.getuid():
                continue
            held = _locked(folder, wait=False)
            if held is not None:
                shutil.rmtree(folder, ignore_errors=True)
                os.close(held)


def _locked(folder: Path, *, wait: bool) -> int | None:
    """Return the descriptor of a folder that is locked now; None where it is not, or never is."""
    try:
        import fcntl
    except ImportError:  # Windows
        return None
    try:
        descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    except OSError:
        return None
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX if wait else fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:  # another program holds it, or the file system has no locks
        os.close(descriptor)
        return None
    return descriptor


def _move_to_nothing(staged: Path, place: Path) -> None:
    """Move a file to a place where nothing is."""
    try:
        os.link(staged, place)  # unlike a move, it never replaces
    except FileExistsError:
        raise
    except OSError as error:  # some file systems have one name for each file
        if os.path.lexists(place):
            raise FileExistsError(place) from error
        staged.replace(place)


def create(file: Path, content: bytes) -> None:
    """Create a file, which nothing is in the place of."""
    with file.open("xb") as stream:
        stream.write(content)


def move(staged: Path, place: Path) -> None:
    """Move a file to its place, both forced to the disk: the file before, the folder after."""
    move_all({staged: place})


def move_all(places: Mapping[Path, Path]) -> None:
    """Move files to their places; all are forced to the disk before the first is moved."""
    if len(places) > FEW:  # at the same time, of which a disk makes one turn
        with ThreadPoolExecutor(AT_ONCE) as pool:
            for _ in pool.map(sync, places):
                pass
    else:
        for staged in places:
            sync(staged)
    for staged, place in places.items():
        staged.replace(place)
    for folder in {place.parent for place in places.values()}:
        sync_folder(folder)


def sync(file: Path) -> None:
    """Force the content of a file to the disk."""
    descriptor = os.open(file, os.O_RDWR | getattr(os, "O_BINARY", 0))
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def sync_folder(folder: Path) -> None:
    """Force the names in a folder to the disk, where the system has a way to."""
    if not hasattr(os, "O_DIRECTORY"):
        return
    with suppress(PermissionError):  # of a folder that may be written and not read
        descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
        try:
            with suppress(OSError):  # some network file systems refuse it; the files are there
                os.fsync(descriptor)
        finally:
            os.close(descriptor)
