"""Cache of machine code on disk: a folder private to this user, files with checksums.

numba unpickles what it finds in its cache, which runs what stands there.  So the folder must be
this user's alone, and a file that is not what was written counts as missing: it is compiled again.
"""

import atexit
import hashlib
import os
import pickle
import shutil
import stat
import tempfile
import warnings
from contextlib import suppress
from pathlib import Path
from typing import Any

from numba.core.caching import FunctionCache, IndexDataCacheFile

MOST_LINKS = 40
"""Links in one path, as the system allows."""
CHECKSUM = hashlib.sha256().digest_size


def own_folder(top: Path, *names: str) -> Path:
    """Return a folder that only this user can change: the preferred one, or one for this process.

    Parameters
    ----------
    top, names
        Path of the preferred folder. It and the folders down from `top` are made for this user
        alone where they are missing.

    Warns
    -----
    UserWarning
        If the preferred one cannot be written, or other users could change it.
    """
    preferred = top
    try:
        for name in ("", *names):
            preferred /= name
            preferred.mkdir(mode=0o700, parents=True, exist_ok=True)
        weakness = _weakness(preferred)
        if weakness is None:
            with tempfile.TemporaryFile(dir=preferred):
                return preferred
    except OSError as error:
        weakness = f"{preferred} cannot be written: {error.strerror or error}"
    warnings.warn(
        f"machine code is kept for this run only, and compiling it takes up to some minutes: "
        f"{weakness}; mend that, or set XDG_CACHE_HOME to a folder of your own",
        stacklevel=2,
    )
    return _fresh()


def _fresh() -> Path:
    """Return a new private folder, which is removed when this process ends."""
    folder = Path(tempfile.mkdtemp(prefix="rocksteady-"))
    maker = os.getpid()

    def remove() -> None:
        if os.getpid() == maker:  # a forked process uses it, and does not own it
            shutil.rmtree(folder, ignore_errors=True)

    atexit.register(remove)
    return folder


def _weakness(folder: Path) -> str | None:
    """Return what lets another user change a folder's content, as a clause; None where nothing.

    Checks each folder and link on the path: a user who may rename one of them may replace it.
    """
    if not hasattr(os, "getuid"):
        return None
    trusted = {os.getuid(), 0, Path("/").stat().st_uid}
    left = list(Path(os.path.abspath(folder)).parts)[::-1]  # noqa: PTH100 -- links stay
    here, links = Path(), 0
    while left:
        part = left.pop()
        if part == "..":
            here = here.parent
            continue
        there = here / part
        found = there.lstat()
        if found.st_uid not in trusted:
            return f"{there} belongs to another user"
        if stat.S_ISLNK(found.st_mode):
            links += 1
            if links > MOST_LINKS:
                return f"{there} is a link in a circle"
            left += there.readlink().parts[::-1]  # an absolute one begins at the top again
        elif _shared(found):
            return f"{there} can be written by other users"
        else:
            here = there
    if here.stat().st_uid != os.getuid():
        return f"{here} belongs to another user"
    if here.stat().st_mode & 0o022:
        return f"{here} can be written by other users"
    return None


def _shared(found: os.stat_result) -> bool:
    """Return whether another user may rename what is in a folder.

    Many systems give each user a group of the same name without other members, and let that group
    write what its user makes.
    """
    if found.st_mode & stat.S_ISVTX or not found.st_mode & 0o022:
        return False
    if found.st_mode & 0o002:
        return True
    import grp  # POSIX alone has them
    import pwd

    try:
        user, group = pwd.getpwuid(os.getuid()), grp.getgrgid(found.st_gid)
    except KeyError:
        return True
    alone = group.gr_gid == user.pw_gid and group.gr_name == user.pw_name
    return not (alone and set(group.gr_mem) <= {user.pw_name})


class CheckedCache(FunctionCache):
    """numba's cache of a function, in files that carry checksums.

    Nothing that is wrong with them ends a run: what cannot be loaded is compiled, and what cannot
    be saved is compiled again by the next process.
    """

    def __init__(self, function: Any) -> None:
        super().__init__(function)
        stamp = self._impl.locator.get_source_stamp()
        self._cache_file = _CheckedFiles(self._cache_path, self._impl.filename_base, stamp)

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return compiled code; None where there is none that can be loaded."""
        try:
            return super().load_overload(sig, target_context)
        except Exception:  # noqa: BLE001 -- of another version of something it is made of
            return None

    def save_overload(self, sig: Any, data: Any) -> None:
        """Save compiled code where that is possible."""
        with suppress(OSError):
            super().save_overload(sig, data)


class _CheckedFiles(IndexDataCacheFile):
    """An index and the files that it names, each a checksum and a pickle."""

    def _load_index(self) -> Any:
        found = self._read(self._index_path)
        known = isinstance(found, tuple) and found[:2] == (self._version, self._source_stamp)
        return found[2] if known else {}

    def _save_index(self, overloads: Any) -> None:
        self._write(self._index_path, (self._version, self._source_stamp, overloads))

    def _load_data(self, name: str) -> Any:
        return self._read(self._data_path(name))

    def _save_data(self, name: str, data: Any) -> None:
        self._write(self._data_path(name), data)

    def _read(self, file: str) -> Any:
        """Return what was written to a file; None where it is missing or damaged."""
        try:
            content = Path(file).read_bytes()
        except OSError:
            return None
        checksum, data = content[:CHECKSUM], content[CHECKSUM:]
        return pickle.loads(data) if hashlib.sha256(data).digest() == checksum else None

    def _write(self, file: str, what: Any) -> None:
        data = self._dump(what)
        with self._open_for_write(file) as stream:
            stream.write(hashlib.sha256(data).digest() + data)
