"""Damage of every kind to a store: it is resumed to the same bytes or refused, never to others."""

import functools
import random
import shutil
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import xarray

from rocksteady.errors import InputError, OutputError, UnfinishedError
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.run import Execution
from rocksteady.sweep.store.reading import open_store
from rocksteady.sweep.store.store import Store
from tests.sweep.executors.cases import GRID, OUTPUTS, some
from tests.sweep.store.faults import CHUNK, run, whole


@pytest.fixture(scope="module")
def other(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A store of the same shape, with other numbers."""
    path = tmp_path_factory.mktemp("other") / "a.zarr"
    evaluate(
        functools.partial(some, factor=2.0),
        GRID,
        OUTPUTS,
        run=Execution(store=Store(path, chunk=CHUNK)),
    )
    return path


def swapped(first: Path, second: Path) -> None:
    one, two = first.read_bytes(), second.read_bytes()
    first.write_bytes(two)
    second.write_bytes(one)


def of(name: str, chunk: int) -> str:
    return f"done/c/{chunk}" if name == "done" else f"{name}/c.{chunk}.0"


def read(path: Path) -> xarray.Dataset:
    return open_store(path, partial=True).load()


def refused_or_right(path: Path, undisturbed: Path) -> str:
    """Return how a damaged store is taken: read first, then resumed."""
    right = open_store(undisturbed).load()
    taken = "read"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            found = read(path)
            known = found.computed
            for name in right.data_vars:
                assert bool((found[name] == right[name]).where(known, True).all())
            assert found.attrs == right.attrs
        except (InputError, UnfinishedError):
            taken = "refused"
        try:
            data, _ = run(path, resume=True)
        except OutputError as error:
            assert "\n" not in str(error)  # noqa: PT017 -- only where it is refused
            return "refused"
    assert data.identical(right)
    assert whole(path, undisturbed)
    return taken


@pytest.mark.parametrize("array", ["sum", "sign", "done"])
def test_a_file_in_the_place_of_a_sibling_is_found(
    array: str, begun: Path, undisturbed: Path
) -> None:
    swapped(begun / of(array, 1), begun / of(array, 4))
    with pytest.raises(InputError, match="cannot be read"):
        open_store(begun).load()
    with pytest.warns(UserWarning, match="2 of 6 finished chunks are missing or damaged"):
        _, there = run(begun, resume=True)
    assert there == GRID.size - 2 * CHUNK
    assert whole(begun, undisturbed)


@pytest.mark.parametrize("arrays", [["sum"], ["sign"], ["done"], ["sum", "sign", "done"]])
def test_a_file_of_another_store_of_the_same_shape_is_found(
    arrays: list[str], begun: Path, undisturbed: Path, other: Path
) -> None:
    for array in arrays:
        shutil.copy(other / of(array, 2), begun / of(array, 2))
    if arrays != ["sign"]:  # the signs of chunk 2 happen to be alike in part, the file's bytes not
        with pytest.raises(InputError, match="cannot be read"):
            open_store(begun).load()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        run(begun, resume=True)
    assert whole(begun, undisturbed)


def test_what_is_read_lazily_is_checked_where_it_is_read(begun: Path) -> None:
    found = open_store(begun)
    swapped(begun / of("sum", 1), begun / of("sum", 4))
    assert found["sum"][:5].values.shape == (5, 20)
    with pytest.raises(InputError, match=r"its file sum/c\.1\.0 is damaged, or that of another"):
        found["sum"][5:10].values  # noqa: B018 -- it is read here
    assert found["sign"].values.shape == GRID.shape


def test_chunks_are_those_of_their_sweep_after_a_resumption(begun: Path) -> None:
    """The dataset of a resumed store checks what was written in the meantime."""
    (begun / of("done", 3)).unlink()
    data, _ = run(begun, resume=True)
    swapped(begun / of("sum", 3), begun / of("sum", 4))
    with pytest.raises(InputError, match="cannot be read"):
        data["sum"].load()


Damage = Callable[[random.Random, Path, Path], Any]


def _file(draw: random.Random, folder: Path) -> Path:
    return draw.choice(sorted(p for p in folder.rglob("*") if p.is_file()))


def flip(draw: random.Random, path: Path, _: Path) -> None:
    file = _file(draw, path)
    content = bytearray(file.read_bytes() or b"\0")
    content[draw.randrange(len(content))] ^= 1 << draw.randrange(8)
    file.write_bytes(content)


def cut(draw: random.Random, path: Path, _: Path) -> None:
    file = _file(draw, path)
    content = file.read_bytes()
    file.write_bytes(content[: draw.randrange(len(content) + 1)])


def longer(draw: random.Random, path: Path, _: Path) -> None:
    file = _file(draw, path)
    file.write_bytes(file.read_bytes() + draw.randbytes(draw.randrange(1, 9)))


def zeros(draw: random.Random, path: Path, _: Path) -> None:
    file = _file(draw, path)
    file.write_bytes(bytes(len(file.read_bytes())))


def removed(draw: random.Random, path: Path, _: Path) -> None:
    _file(draw, path).unlink()


def exchanged(draw: random.Random, path: Path, _: Path) -> None:
    swapped(_file(draw, path), _file(draw, path))


def siblings(draw: random.Random, path: Path, _: Path) -> None:
    array = draw.choice(["sum", "sign", "done"])
    swapped(*(path / of(array, chunk) for chunk in draw.sample(range(6), 2)))


def repeated(draw: random.Random, path: Path, _: Path) -> None:
    array = draw.choice(["sum", "sign", "done"])
    one, two = (path / of(array, chunk) for chunk in draw.sample(range(6), 2))
    shutil.copy(one, two)


def from_another(draw: random.Random, path: Path, other: Path) -> None:
    file = _file(draw, other)
    shutil.copy(file, path / file.relative_to(other))


def whole_chunk_from_another(draw: random.Random, path: Path, other: Path) -> None:
    one, two = (draw.randrange(6) for _ in range(2))
    for array in ("sum", "sign", "done"):
        shutil.copy(other / of(array, one), path / of(array, two))


def a_folder(draw: random.Random, path: Path, _: Path) -> None:
    file = _file(draw, path)
    file.unlink()
    file.mkdir()


DAMAGES: list[Damage] = [
    flip,
    cut,
    longer,
    zeros,
    removed,
    exchanged,
    siblings,
    repeated,
    from_another,
    whole_chunk_from_another,
    a_folder,
]


@pytest.mark.slow
def test_random_damages(undisturbed: Path, other: Path, tmp_path: Path) -> None:
    """Ten draws of each of eleven kinds."""
    taken = []
    for number in range(10):
        for damage in DAMAGES:
            place = tmp_path / f"{damage.__name__}-{number}"
            place.mkdir()
            shutil.copytree(undisturbed, place / "a.zarr")
            draw = random.Random(f"{damage.__name__} {number}")
            damage(draw, place / "a.zarr", other)
            taken.append(refused_or_right(place / "a.zarr", undisturbed))
            shutil.rmtree(place)
    assert set(taken) <= {"read", "refused"}
    assert "read" in taken
