"""A store survives whatever ends a run, and what befalls its files: kills and damage.

Runs are killed in processes forked from one that has everything imported, at each of the moments
at which something changes on the disk.
"""

import functools
import shutil
import warnings
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

from rocksteady.errors import OutputError
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.run import Execution
from rocksteady.sweep.store.store import Store
from tests.sweep.executors.cases import GRID, OUTPUTS, some
from tests.sweep.store.faults import CHUNK, MOMENTS, run, script, tree, whole


@pytest.mark.slow
def test_a_run_that_is_killed_at_any_moment_is_resumed(undisturbed: Path, tmp_path: Path) -> None:
    done = script(
        MOMENTS + "every_moment(Path(sys.argv[1]), lambda path: None, run, int(sys.argv[2]))",
        tmp_path,
        5,
    )
    assert done.returncode == 0, done.stderr
    there = []
    for place in sorted(tmp_path.iterdir(), key=lambda place: int(place.name)):
        data, cells = run(place / "a.zarr", resume=True)
        there.append(cells)
        assert whole(place / "a.zarr", undisturbed)
        assert data.identical(run(undisturbed, resume=True)[0])
    assert there == sorted(there)  # the later it is killed, the more is there
    assert set(there) == set(range(0, GRID.size + 1, CHUNK))


@pytest.mark.slow
def test_a_resumed_run_that_is_killed_is_resumed(
    begun: Path, undisturbed: Path, tmp_path: Path
) -> None:
    (begun / "sum/c.1.0").write_bytes(b"")
    (begun / "sign/c.4.0").unlink()
    (begun / "done/c/5").unlink()
    places = tmp_path / "places"
    places.mkdir()
    done = script(
        MOMENTS
        + """
        import warnings
        warnings.simplefilter("ignore")
        every_moment(
            Path(sys.argv[1]),
            lambda path: shutil.copytree(sys.argv[2], path),
            partial(run, resume=True),
            int(sys.argv[3]),
        )
        """.replace("\n        ", "\n"),
        places,
        begun,
        4,
    )
    assert done.returncode == 0, done.stderr
    for place in places.iterdir():
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            _, there = run(place / "a.zarr", resume=True)
        assert there >= GRID.size - 3 * CHUNK
        assert whole(place / "a.zarr", undisturbed)


@pytest.mark.slow
def test_replacing_a_store_leaves_the_old_one_or_a_new_one(
    undisturbed: Path, tmp_path: Path
) -> None:
    old = tmp_path / "old.zarr"
    evaluate(
        functools.partial(some, factor=2.0),
        GRID,
        OUTPUTS,
        run=Execution(store=Store(old, chunk=CHUNK)),
    )
    places = tmp_path / "places"
    places.mkdir()
    done = script(
        MOMENTS
        + """
        def replace(path):
            run(path, overwrite=True, chunk=600)  # of one chunk: most of it is the replacing
        def run(path, chunk=100, **options):
            store = Store(path, chunk=chunk, **options)
            return evaluate(some, GRID, OUTPUTS, run=Execution(executor="serial", store=store))
        every_moment(
            Path(sys.argv[1]),
            lambda path: shutil.copytree(sys.argv[2], path),
            replace,
            int(sys.argv[3]),
        )
        """.replace("\n        ", "\n"),
        places,
        old,
        5,
    )
    assert done.returncode == 0, done.stderr
    kept = []
    for place in sorted(places.iterdir(), key=lambda place: int(place.name)):
        path = place / "a.zarr"
        with suppress(OutputError):
            data, _ = run(path, resume=True)
            kept.append("new")
            assert data.identical(run(undisturbed, resume=True)[0])
            assert [path.name for path in place.iterdir()] == ["a.zarr"]
            continue
        kept.append("old")
        assert tree(path) == tree(old)
    assert kept == sorted(kept, reverse=True)
    assert len(set(kept)) == 2


def test_a_new_store_does_not_replace_one_that_is_put_there_meanwhile(
    begun: Path, undisturbed: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    there, make_folder = begun.rename(tmp_path / "there"), Store._make_folder

    def late(store: Store) -> bool:
        shutil.move(there, begun)
        return make_folder(store)

    monkeypatch.setattr(Store, "_make_folder", late)
    with pytest.raises(OutputError, match="it exists"):
        run(begun)
    assert whole(begun, undisturbed)


DAMAGES: dict[str, Callable[[Path], object]] = {
    "truncated": lambda file: file.write_bytes(file.read_bytes()[:-1]),
    "emptied": lambda file: file.write_bytes(b""),
    "removed": Path.unlink,
    "garbled": lambda file: file.write_bytes(bytes(b ^ 0x55 for b in file.read_bytes())),
    "changed": lambda file: file.write_bytes(_changed(file.read_bytes())),
    "longer": lambda file: file.write_bytes(file.read_bytes() + b"x"),
}


def _changed(content: bytes) -> bytes:
    middle = len(content) // 2
    return content[:middle] + bytes([content[middle] ^ 4]) + content[middle + 1 :]


@pytest.mark.slow
@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.parametrize("array", ["sum", "sign", "done"])
def test_what_is_damaged_is_computed_again_and_nothing_else(
    array: str, damage: str, begun: Path, undisturbed: Path
) -> None:
    for chunk in (1, 4):
        DAMAGES[damage](begun / array / (f"c/{chunk}" if array == "done" else f"c.{chunk}.0"))
    if array == "done" and damage not in {"garbled", "changed"}:  # as one never finished
        data, there = run(begun, resume=True)
    else:
        with pytest.warns(UserWarning, match="2 of 6 finished chunks are missing or damaged"):
            data, there = run(begun, resume=True)
    assert there == GRID.size - 2 * CHUNK
    assert data.identical(run(undisturbed, resume=True)[0])
    assert whole(begun, undisturbed)


@pytest.mark.parametrize("damage", DAMAGES)
def test_the_values_of_an_axis_are_written_again(
    damage: str, begun: Path, undisturbed: Path
) -> None:
    DAMAGES[damage](begun / "a" / "c" / "0")
    data, there = run(begun, resume=True)
    assert there == GRID.size
    assert np.array_equal(data["a"].values, GRID.axes[0].points)
    assert whole(begun, undisturbed)


@pytest.mark.parametrize("damage", ["truncated", "emptied", "removed", "garbled"])
def test_a_store_that_no_more_says_what_it_is_is_refused_in_one_line_and_can_be_replaced(
    damage: str, begun: Path
) -> None:
    DAMAGES[damage](begun / "zarr.json")
    with pytest.raises(OutputError, match="damaged") as caught:
        run(begun, resume=True)
    assert "\n" not in str(caught.value)
    assert run(begun, overwrite=True)[1] == 0


@pytest.mark.slow
@pytest.mark.parametrize("name", ["sum/zarr.json", "done/zarr.json", "a/zarr.json"])
@pytest.mark.parametrize("damage", ["truncated", "emptied", "removed", "garbled"])
def test_the_descriptions_of_arrays_are_written_again(
    name: str, damage: str, begun: Path, undisturbed: Path
) -> None:
    DAMAGES[damage](begun / name)
    assert run(begun, resume=True)[1] == GRID.size
    assert whole(begun, undisturbed)
