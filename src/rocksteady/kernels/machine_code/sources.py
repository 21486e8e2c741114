"""The sources of all kernels: the hash that names their machine code, and whether they changed."""

import hashlib
from functools import cache
from pathlib import Path

from rocksteady.outcomes import Status


def sources() -> list[Path]:
    """Return the files of all kernels, in one order wherever they are."""
    return sorted(_root().rglob("*.py"))


@cache
def sources_hash() -> str:
    """Return a hash of what machine code is made of: the kernels, and the codes they end with."""
    _stamps()
    digest = hashlib.sha256(repr([(status.name, status.value) for status in Status]).encode())
    for source in sources():
        digest.update(source.relative_to(_root()).as_posix().encode())
        digest.update(source.read_bytes())
    return digest.hexdigest()[:16]


def unchanged() -> bool:
    """Return whether the sources are what they were when they were hashed."""
    return all(_stamp(source) == stamp for source, stamp in _stamps().items())


def _root() -> Path:
    return Path(__file__).parents[1]


@cache
def _stamps() -> dict[Path, tuple[int, int]]:
    """Return time stamp and size of each source when it was hashed."""
    return {source: _stamp(source) for source in sources()}


def _stamp(source: Path) -> tuple[int, int]:
    found = source.stat()
    return found.st_mtime_ns, found.st_size
