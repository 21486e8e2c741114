"""How the library is found, and how Python calls what is in it."""

import ctypes
import ctypes.util
import hashlib
import platform
import struct
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy as np
import pytest

from rocksteady.errors import MissingKernelsError
from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.machine_code import library as module
from rocksteady.kernels.machine_code.library import (
    Library,
    caller,
    checksum_file,
    file_name,
    library,
    targets,
)
from rocksteady.kernels.machine_code.sources import sources_hash
from rocksteady.kernels.machine_code.types import Floats1, Floats2, Integers1
from tests.every import every
from tests.strategies import PLAIN

ROUTINE = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.POINTER(ctypes.c_int64))


class Pair(NamedTuple):
    first: int
    second: float


class Inner(NamedTuple):
    pair: Pair
    flag: bool


def routine(answer: Callable[[Any], int]) -> Any:
    """Return a C function that runs a Python one on its cells."""
    return ROUTINE(answer)


def real(cell: int) -> float:
    """Return the number whose bits are in a cell."""
    return float(struct.unpack("d", struct.pack("q", cell))[0])


def bits(number: float) -> int:
    return int(struct.unpack("q", struct.pack("d", number))[0])


def mixed(inner: Inner, values: Floats2, scale: float) -> tuple[float, Inner, complex]:
    raise NotImplementedError(inner, values, scale)


def test_leaves_are_put_into_cells_and_results_taken_from_those_after_them() -> None:
    seen = []

    def answer(cells: Any) -> int:
        seen.append([cells[k] for k in range(8)])
        cells[2] = 7  # an argument's cell is the callee's
        found = (bits(0.5), -3, bits(1.5), 1, bits(2.0), bits(-4.0))
        for k, value in enumerate(found):
            cells[7 + k] = value
        return 0

    values = np.arange(6.0).reshape(2, 3)
    call = caller(mixed, routine(answer))
    result = call(Inner(Pair(-5, 0.25), True), values, 3)
    assert result == (0.5, Inner(Pair(-3, 1.5), True), complex(2.0, -4.0))
    assert type(result[1]) is Inner
    assert type(result[1].pair) is Pair
    assert result[1].flag is True
    (cells,) = seen
    assert cells[0] == -5
    assert real(cells[1]) == 0.25
    assert cells[2] == 1
    assert cells[3] == values.ctypes.data
    assert cells[4:6] == [2, 3]
    assert real(cells[6]) == 3.0


def lengths(values: Floats1, counts: Integers1) -> None:
    raise NotImplementedError(values, counts)


def test_what_is_no_array_of_the_kind_is_refused_by_name() -> None:
    called: list[int] = []

    def noted(_cells: Any) -> int:
        called.append(1)
        return 0

    call = caller(lengths, routine(noted))
    good, counts = np.zeros(4), np.zeros(4, dtype=np.int64)
    frozen = np.zeros(4)
    frozen.flags.writeable = False
    bad: list[Any] = [
        np.zeros(4, dtype=np.float32),
        np.zeros(8)[::2],
        np.zeros((2, 2)),
        np.zeros(4).astype(">f8"),
        frozen,
        [0.0] * 4,
        None,
        1.0,
    ]
    for values in bad:
        with pytest.raises(TypeError, match=r"values is .*array of float64 with 1 dimension$"):
            call(values, counts)
    with pytest.raises(TypeError, match=r"counts is .*float64: .* array of int64"):
        call(good, good)
    assert not called
    call(good, counts)
    assert called


def test_empty_arrays_are_passed() -> None:
    seen = []

    def noted(cells: Any) -> int:
        seen.append((cells[1], cells[3]))
        return 0

    call = caller(lengths, routine(noted))
    call(np.zeros(0), np.zeros(0, dtype=np.int64))
    assert seen == [(0, 0)]


def test_a_number_of_another_kind_is_refused() -> None:
    def count(number: int) -> int:
        raise NotImplementedError(number)

    call = caller(count, routine(lambda _: 0))
    with pytest.raises(struct.error):
        call(1.5)


def test_a_status_is_an_error_and_no_result() -> None:
    call = caller(lengths, routine(lambda _: 2))
    with pytest.raises(MemoryError, match="lengths"):
        call(np.zeros(1), np.zeros(1, dtype=np.int64))


# ------------------------------------------------------------------------------- where it is found


@pytest.fixture
def _found_anew() -> Iterator[None]:
    library.cache_clear()
    yield
    library.cache_clear()


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, _found_anew: None) -> Path:
    """Have libraries looked for in an empty folder; return it."""
    monkeypatch.setattr(module, "libraries_folder", lambda: tmp_path)
    return tmp_path


def placed(folder: Path, content: bytes, target: str) -> Path:
    """Put a library of some content where it is looked for, with its checksum."""
    path = folder / file_name(target)
    path.write_bytes(content)
    checksum_file(path).write_text(f"{hashlib.sha256(content).hexdigest()} tools\n")
    return path


def refusal() -> str:
    """Return the one line by which a library is refused, without its remedy."""
    with pytest.raises(MissingKernelsError, match=r"run `make library` in a checkout") as raised:
        library()
    assert "\n" not in str(raised.value)
    return str(raised.value).partition("compiled kernels ")[2].partition(": it must be")[0]


_known = None if PLAIN else library()
LIBRARY = _known.path.read_bytes() if _known else b""
"""Content of the library that this process uses, or could use."""
needs_library = pytest.mark.skipif(not LIBRARY, reason="no library is built for these sources")


@needs_library
def test_the_library_holds_every_entry() -> None:
    found = library()
    assert found is not None
    assert [name for name, kernel in ENTRIES.items() if found.entry(kernel.py_func) is None] == []


@needs_library
def test_a_library_is_found(home: Path) -> None:
    target = targets()[-1]
    path = placed(home, LIBRARY, target)
    found = library()
    assert found is not None
    assert (found.path, found.target) == (path, target)


@needs_library
def test_a_library_of_other_sources_is_refused(home: Path) -> None:
    named = sources_hash().encode()
    assert LIBRARY.count(named) == 1
    placed(home, LIBRARY.replace(named, b"0123456789abcdef"), targets()[-1])
    assert refusal() == "is of other kernels: their code has changed since it was compiled"


@needs_library
@every("keep", [0, 100, len(LIBRARY) // 2, len(LIBRARY) - 1])
def test_a_cut_library_is_refused(keep: int) -> None:
    with TemporaryDirectory() as folder, pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "libraries_folder", lambda: Path(folder))
        path = placed(Path(folder), LIBRARY, targets()[0])
        path.write_bytes(LIBRARY[:keep])
        library.cache_clear()
        assert refusal() == f"is damaged ({path})"
        path.write_bytes(LIBRARY)
        checksum_file(path).unlink()
        assert refusal() == f"is damaged ({path})"
    library.cache_clear()


@needs_library
def test_a_library_of_another_processor_is_refused_with_its_name(home: Path) -> None:
    placed(home, LIBRARY, "macos-arm64")
    placed(home, LIBRARY, "linux-x86-64-v9")
    expected = "is for another processor (rocksteady-linux-x86-64-v9, rocksteady-macos-arm64)"
    assert refusal() == expected


def test_an_installation_without_libraries_has_none(home: Path) -> None:
    (home / "explorer.wasm").touch()
    assert library() is None


@pytest.mark.skipif(not targets(), reason="no library is made for this platform")
def test_a_file_that_is_no_library_is_refused(home: Path) -> None:
    placed(home, b"no library at all", targets()[-1])
    assert refusal().startswith("cannot be loaded (")


@needs_library
def test_a_library_without_a_hash_is_not_used(tmp_path: Path) -> None:
    with pytest.raises((OSError, ValueError)):
        _ = Library(Path(ctypes.util.find_library("m") or tmp_path), "linux").sources


@every(
    ("system", "machine", "expected"),
    [
        ("linux", "x86_64", ("linux-x86-64-v3", "linux-x86-64-v2")),
        ("linux", "aarch64", ("linux-aarch64",)),
        ("darwin", "arm64", ("macos-arm64",)),
        ("darwin", "x86_64", ()),
        ("win32", "AMD64", ("windows-x86-64-v3", "windows-x86-64-v2")),
        ("win32", "ARM64", ()),
        ("sunos5", "sun4v", ()),
    ],
)
def test_the_fastest_code_that_a_processor_runs_comes_first(
    system: str, machine: str, expected: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "platform", system)
    monkeypatch.setattr(platform, "machine", lambda: machine)
    monkeypatch.setattr(module, "x86_64_level", lambda: 3)
    assert targets() == expected
