"""A disk that loses power: what was not forced to it is dropped, reordered or torn, as it may be.

`Recorder` watches a folder while something is written there.  Before each change of a name and each
`fsync` it notes what the disk must hold, and what it may hold, if the power fails at that moment:

- of a file: its content when it was last forced, or the present one, or nothing, half of it, zeros;
- of a folder: for each name what it was when the folder was last forced, or what it is now, each
  name by itself, so that later changes may be there without earlier ones.

`Moment.lose` makes such a folder.
"""

import os
import random
import shutil
import stat
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

Inode = tuple[int, int]


@dataclass
class Thing:
    """A file or a folder, with what has been forced to the disk of it, and what is there now."""

    folder: bool
    forced: Any = None
    """Content or names; None where it never was."""
    now: Any = None


@dataclass
class Moment:
    """What there is at a moment."""

    what: str
    root: Inode
    things: dict[Inode, Thing]

    def lose(self, place: Path, draw: random.Random, how: str = "any") -> Path:
        """Write what the disk may hold after a power failure; `how` "worst": new names, old data.

        "best" is what is there without a failure.
        """
        self._write(place, self.root, draw, how)
        return place

    def _write(self, place: Path, inode: Inode, draw: random.Random, how: str) -> None:
        thing = self.things[inode]
        if not thing.folder:
            place.write_bytes(_content(thing, draw, how))
            return
        place.mkdir()
        before, now = thing.forced or {}, thing.now or {}
        for name in sorted(before.keys() | now.keys()):
            old, new = before.get(name), now.get(name)
            chosen = {"worst": new, "best": new, "oldest": old}.get(how, draw.choice([old, new]))
            if chosen is not None:
                self._write(place / name, chosen, draw, how)


def _content(thing: Thing, draw: random.Random, how: str) -> bytes:
    forced, now = thing.forced, thing.now or b""
    if forced == now or how == "best":
        return bytes(now)
    known = b"" if forced is None else forced
    if how in {"worst", "oldest"}:
        return bytes(known)
    torn = now[: len(now) // 2]
    return bytes(draw.choice([known, now, b"", torn, bytes(len(now)), torn + known[len(torn) :]]))


@dataclass
class Recorder:
    """Watches a folder; `moments` are those at which the power may fail."""

    root: Path
    moments: list[Moment] = field(default_factory=list)
    lock: Any = field(default_factory=threading.RLock)
    _things: dict[Inode, Thing] = field(default_factory=dict)
    _held: list[int] = field(default_factory=list)

    def __post_init__(self) -> None:
        for path in (self.root, *self.root.rglob("*")):  # what is there is on the disk
            self.force(path)

    def force(self, path: Path | int) -> None:
        """Note that the content of a file, or the names in a folder, are on the disk."""
        place = Path(f"/proc/self/fd/{path}").readlink() if isinstance(path, int) else path
        if place != self.root and self.root not in place.parents:
            return
        thing = self._thing(place)
        thing.forced = self._names(place) if thing.folder else place.read_bytes()

    def _thing(self, path: Path) -> Thing:
        found = path.stat()
        inode = (found.st_dev, found.st_ino)
        if inode not in self._things:
            self._things[inode] = Thing(folder=stat.S_ISDIR(found.st_mode))
            self._held.append(os.open(path, os.O_RDONLY))  # no other file gets its number
        return self._things[inode]

    def _names(self, folder: Path) -> dict[str, Inode]:
        return {
            entry.name: (entry.stat(follow_symlinks=False).st_dev, entry.inode())
            for entry in os.scandir(folder)
        }

    def note(self, what: str) -> None:
        """Note a moment."""
        for path in (self.root, *self.root.rglob("*")):
            thing = self._thing(path)
            thing.now = self._names(path) if thing.folder else path.read_bytes()
        found = self.root.stat()
        things = {
            inode: Thing(folder=t.folder, forced=t.forced, now=t.now)
            for inode, t in self._things.items()
        }
        self.moments.append(Moment(what, (found.st_dev, found.st_ino), things))

    def close(self) -> None:
        """Let go of the files."""
        for descriptor in self._held:
            os.close(descriptor)


CHANGES = ("replace", "rename", "unlink", "remove", "mkdir", "rmdir", "link")


@contextmanager
def recorded(root: Path) -> Iterator[Recorder]:
    """Record what is written in a folder; the last moment is that after all of it."""
    recorder = Recorder(root)
    with pytest.MonkeyPatch.context() as patch:
        for name in CHANGES:
            patch.setattr(os, name, _noted(recorder, name, getattr(os, name)))
        fsync = os.fsync

        def forced(descriptor: int) -> None:
            with recorder.lock:
                recorder.note("fsync")
                fsync(descriptor)
                recorder.force(descriptor)

        patch.setattr(os, "fsync", forced)
        yield recorder
    recorder.note("end")
    recorder.close()


def _noted(recorder: Recorder, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    def noted(*arguments: Any, **options: Any) -> Any:
        with recorder.lock:
            recorder.note(name)
            return function(*arguments, **options)

    return noted


def after_losses(
    moments: list[Moment], place: Path, *, draws: int, seed: int = 1
) -> Iterator[tuple[Moment, Path]]:
    """Yield folders as they may be after a power failure at each of some moments."""
    for number, moment in enumerate(moments):
        draw = random.Random(f"{seed} {number}")
        for turn, how in enumerate(["worst", "oldest", *["any"] * draws]):
            folder = place / f"{number}-{turn}"
            yield moment, moment.lose(folder, draw, how)
            shutil.rmtree(folder)
