"""Folders for machine code: private ones, of which those of old versions are removed.

numba unpickles what it finds in its cache, which runs what stands there.  So the folder must be
this user's alone.
"""

import atexit
import os
import re
import shutil
import stat
import tempfile
import time
import warnings
from contextlib import suppress
from pathlib import Path

import platformdirs

MOST_LINKS = 40
"""Links in one path, as the system allows."""
KEPT = 2
"""Versions whose machine code is kept: the last ones used."""
IN_USE = 24 * 3600.0
"""Seconds after the start of the last process that used a version in which it is kept too."""
VERSION = re.compile(r"[0-9a-f]{16}")
"""Name of the folder of a version."""
MACHINE_CODE = re.compile(
    r".+\.nb[ic](\.tmp\.[0-9a-f]+)?|rocksteady-.+\.(so|dylib|dll|ptx)(\.sha256)?(\.\d+\.tmp)?"
)
"""Name of a file of machine code, or of one that was left half written."""


def version_folder(version: str) -> Path:
    """Return the folder of all machine code of one version of the sources."""
    return Path(platformdirs.user_cache_dir("rocksteady")) / "kernels" / version


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
        found = weakness(preferred)
        if found is None:
            with tempfile.TemporaryFile(dir=preferred):
                return preferred
    except OSError as error:
        found = f"{preferred} cannot be written: {error.strerror or error}"
    warnings.warn(
        f"machine code is kept for this run only, and compiling it takes up to some minutes: "
        f"{found}; mend that, or set XDG_CACHE_HOME to a folder of your own",
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


def weakness(folder: Path) -> str | None:
    """Return what lets another user change a folder's content, as a clause; None where nothing.

    Looks at each folder and link on the way to it: a user who may rename one of them could put
    something else there.
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

    Many systems give each user a group of the same name with nobody else in it, and let that group
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


def prune(version: Path) -> None:
    """Remove the machine code of versions that have not been used for long.

    Parameters
    ----------
    version
        Private folder of the version in use, beside which stand those of others.  Its time stamp is
        set to now: it says when a version was last used.

    Notes
    -----
    Kept are the last two versions used, this one included, and any that a process has started with
    within a day.  Of the others only files of machine code are removed, and folders that are empty
    then; only from folders that are named as this package names them and that nobody but this user
    can enter, and never through a link.  A process that has run for longer than a day and whose
    version is removed compiles again what it has not loaded yet.
    """
    oldest = time.time() - IN_USE
    others = []
    with suppress(OSError):
        os.utime(version)
        for entry in os.scandir(version.parent):
            found = entry.stat(follow_symlinks=False)
            if entry.name != version.name and VERSION.fullmatch(entry.name) and _private(found):
                others.append((found.st_mtime, entry.path))
    for used, folder in sorted(others, reverse=True)[KEPT - 1 :]:
        if used < oldest:
            _remove_machine_code(folder)


def _private(found: os.stat_result) -> bool:
    """Return whether this is a folder, no link, that nobody but this user can enter."""
    if not stat.S_ISDIR(found.st_mode):
        return False
    if not hasattr(os, "getuid"):
        return True
    return found.st_uid == os.getuid() and not found.st_mode & 0o077


def _remove_machine_code(folder: str) -> None:
    """Remove files of machine code from a folder and those in it, and what is empty then."""
    for here, _, names in os.walk(folder, topdown=False):  # does not go through links
        for name in filter(MACHINE_CODE.fullmatch, names):
            with suppress(OSError):
                Path(here, name).unlink()
        with suppress(OSError):
            Path(here).rmdir()
