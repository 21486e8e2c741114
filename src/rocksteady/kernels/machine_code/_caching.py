"""Cache of machine code on disk, keyed on the content of the sources, in files with checksums.

numba names its files after the path of a source, and takes them for stale where its time stamp has
changed.  Here both are the content of the source: a second copy of the package finds the machine
code of the first.  A file that is not what was written counts as missing: it is compiled again.
"""

import hashlib
import pickle
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

from numba.core.caching import (
    CompileResultCacheImpl,
    FunctionCache,
    IndexDataCacheFile,
    _CacheLocator,
)

CHECKSUM = hashlib.sha256().digest_size


class CheckedCache(FunctionCache):
    """numba's cache of a function, in files that carry checksums.

    Nothing that is wrong with them ends a run: what cannot be loaded is compiled, and what cannot
    be saved is compiled again by the next process.

    Parameters
    ----------
    function
        Whose machine code is kept.
    name
        Of its module, alike in every copy of the package.
    folder
        Where it is kept.
    unchanged
        Returns whether the sources are unchanged since the folder was chosen: code compiled after
        an edit is not saved.
    """

    def __init__(
        self, function: Any, name: str, folder: Path, unchanged: Callable[[], bool]
    ) -> None:
        # In place of numba's own, which looks for a folder by the path of the source.
        self._name = repr(function)
        self._py_func = function
        self._impl = _Naming(function, name, folder)
        self._cache_path = str(folder)
        stamp = self._impl.locator.get_source_stamp()
        self._cache_file = _CheckedFiles(self._cache_path, self._impl.filename_base, stamp)
        self._unchanged = unchanged
        self.enable()

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return compiled code; None where there is none that can be loaded."""
        try:
            return super().load_overload(sig, target_context)
        except Exception:  # noqa: BLE001 -- of another version of something it is made of
            return None

    def save_overload(self, sig: Any, data: Any) -> None:
        """Save compiled code where that is possible."""
        with suppress(OSError):
            if self._unchanged():
                super().save_overload(sig, data)


class _Naming(CompileResultCacheImpl):
    """How the files of a function are named."""

    def __init__(self, function: Any, name: str, folder: Path) -> None:
        # In place of numba's own, as above.
        self._lineno = function.__code__.co_firstlineno
        self._locator = _ContentLocator(function, folder)
        flags = getattr(sys, "abiflags", "")
        self._filename_base = self.get_filename_base(f"{name}.{function.__qualname__}", flags)


class _ContentLocator(_CacheLocator):
    """Where the files of a function stand, and which content of its source they were made of."""

    def __init__(self, function: Any, folder: Path) -> None:
        self._py_file = function.__code__.co_filename
        self._lineno = function.__code__.co_firstlineno
        self._folder = folder

    def get_cache_path(self) -> str:
        """Return the folder."""
        return str(self._folder)

    def get_source_stamp(self) -> str:
        """Return a hash of the source."""
        found = Path(self._py_file).stat()
        return _hash_of(self._py_file, found.st_mtime_ns, found.st_size)

    def get_disambiguator(self) -> str:
        """Return what tells functions of one name in a module apart."""
        return str(self._lineno)


@cache
def _hash_of(file: str, _mtime_ns: int, _size: int) -> str:
    """Return a hash of a file's content, read again where its time stamp or size has changed."""
    return hashlib.sha256(Path(file).read_bytes()).hexdigest()


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
