"""A store survives whatever ends a run: kills, damage, full disks, other processes.

Runs are killed in processes forked from one that has everything imported, at each of the moments
at which something changes on the disk.
"""

import functools
import json
import os
import re
import shutil
import subprocess
import sys
import textwrap
import warnings
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import zarr

from rocksteady.errors import OutputError, UnfinishedError
from rocksteady.sweep.axes import Axis
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.grid import Grid
from rocksteady.sweep.store import Store
from tests.sweep.executors.cases import GRID, OUTPUTS, some

ROOT = str(Path(__file__).parents[2])
CHUNK = 100
CHUNKS = 6

PREAMBLE = """
import errno, os, resource, shutil, signal, sys, threading, time
from functools import partial
from pathlib import Path
import xarray, zarr, zarr.storage._local as local
from rocksteady.errors import RocksteadyError
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.store import Store
from tests.sweep.executors.cases import GRID, OUTPUTS, slow, some

def run(path, cases=some, **options):
    store = Store(path, chunk=100, **options)
    return evaluate(cases, GRID, OUTPUTS, executor="serial", store=store)
"""
MOMENTS = """
class Moments:
    '''Ends this process at one of the moments at which something changes on the disk.'''
    def __init__(self, last):
        self.left = last
    def here(self):
        self.left -= 1
        if self.left < 0:
            os.kill(os.getpid(), signal.SIGKILL)

def watched(moments, name, function):
    def wrapped(*arguments, **options):
        moments.here()
        return function(*arguments, **options)
    return wrapped

def kill_at(last):
    moments = Moments(last)
    class Half:
        '''Writes half of what it is given, and then the rest.'''
        def __init__(self, file):
            self.file = file
        def write(self, view):
            view = memoryview(view).cast("B")
            half = len(view) // 2
            self.file.write(view[:half])
            self.file.flush()
            moments.here()
            return half + self.file.write(view[half:])
    opened = local._atomic_write
    import contextlib
    @contextlib.contextmanager
    def halves(path, mode, exclusive=False):
        moments.here()
        with opened(path, mode, exclusive) as file:
            yield Half(file)
            moments.here()
        moments.here()
    local._atomic_write = halves
    Path.replace = watched(moments, "replace", Path.replace)
    Path.unlink = watched(moments, "unlink", Path.unlink)
    Path.write_text = watched(moments, "write_text", Path.write_text)
    shutil.rmtree = watched(moments, "rmtree", shutil.rmtree)
    os.unlink = watched(moments, "os.unlink", os.unlink)
    os.rmdir = watched(moments, "os.rmdir", os.rmdir)
    return moments

def every_moment(folder, begin, go, step=1, first=0):
    '''Fork a process for each moment; it begins anew and is killed there.'''
    moment = first
    while True:
        place = folder / f"{moment}"
        place.mkdir()
        child = os.fork()
        if child == 0:
            os.chdir(place)
            begin(Path("a.zarr"))
            kill_at(moment)
            go(Path("a.zarr"))
            os._exit(0)
        status = os.waitpid(child, 0)[1]
        if os.WIFEXITED(status):
            assert os.WEXITSTATUS(status) == 0, status
            return moment
        moment += step
"""


def script(text: str, *arguments: object, **options: Any) -> "subprocess.CompletedProcess[str]":
    """Run a script to its end."""
    return subprocess.run(
        [sys.executable, "-c", PREAMBLE + textwrap.dedent(text), *map(str, arguments)],
        env={**os.environ, "PYTHONPATH": ROOT},
        capture_output=True,
        text=True,
        timeout=200,
        check=False,
        **options,
    )


def tree(folder: Path) -> dict[str, bytes]:
    """Return all files of a store but for its lock."""
    files = (path for path in folder.rglob("*") if path.is_file() and path.name != "lock")
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


def run(path: Path, **options: Any) -> tuple[Any, int]:
    """Return the result, and how many cells were there already."""
    told: list[int] = []
    given = {
        name: options.pop(name) for name in ("executor", "workers", "batch") if name in options
    }
    store = Store(path, chunk=CHUNK, **options)
    data = evaluate(some, GRID, OUTPUTS, store=store, done=told.append, **given)
    assert sum(told) == GRID.size
    return data, told[0]


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("undisturbed") / "a.zarr"
    run(path)
    return path


@pytest.fixture
def begun(undisturbed: Path, tmp_path: Path) -> Path:
    """A store like that, to be damaged."""
    shutil.copytree(undisturbed, tmp_path / "a.zarr")
    return tmp_path / "a.zarr"


def whole(path: Path, undisturbed: Path) -> bool:
    """Return whether a store is that of a run that nothing has disturbed, with nothing beside."""
    return tree(path) == tree(undisturbed) and [p.name for p in path.parent.iterdir()] == [
        path.name
    ]


@pytest.mark.parametrize("step", [7, pytest.param(1, marks=pytest.mark.slow)])
def test_a_run_that_is_killed_at_any_moment_is_resumed(
    step: int, undisturbed: Path, tmp_path: Path
) -> None:
    done = script(
        MOMENTS + "every_moment(Path(sys.argv[1]), lambda path: None, run, int(sys.argv[2]))",
        tmp_path,
        step,
    )
    assert done.returncode == 0, done.stderr
    there = []
    for place in sorted(tmp_path.iterdir(), key=lambda place: int(place.name)):
        for leftover in place.glob(".a.zarr.new-*"):  # removed later, when it is surely abandoned
            shutil.rmtree(leftover)
        data, cells = run(place / "a.zarr", resume=True)
        there.append(cells)
        assert whole(place / "a.zarr", undisturbed)
        assert data.identical(run(undisturbed, resume=True)[0])
    assert there == sorted(there)  # the later it is killed, the more is there
    assert set(there) == set(range(0, GRID.size + 1, CHUNK))


@pytest.mark.parametrize("step", [7, pytest.param(1, marks=pytest.mark.slow)])
def test_a_resumed_run_that_is_killed_is_resumed(
    step: int, begun: Path, undisturbed: Path, tmp_path: Path
) -> None:
    (begun / "sum/c/1/0").write_bytes(b"")
    (begun / "sign/c/4/0").unlink()
    (begun / "done/c/5").unlink()
    (begun / "sum/c/3").mkdir(exist_ok=True)
    (begun / "sum/c/3/0.0123.partial").write_bytes(b"what")
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
        step,
    )
    assert done.returncode == 0, done.stderr
    for place in places.iterdir():
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            _, there = run(place / "a.zarr", resume=True)
        assert there >= GRID.size - 3 * CHUNK
        assert whole(place / "a.zarr", undisturbed)


@pytest.mark.parametrize("step", [7, pytest.param(1, marks=pytest.mark.slow)])
def test_replacing_a_store_leaves_the_old_one_or_a_new_one(
    step: int, undisturbed: Path, tmp_path: Path
) -> None:
    old = tmp_path / "old.zarr"
    evaluate(functools.partial(some, factor=2.0), GRID, OUTPUTS, store=Store(old, chunk=CHUNK))
    places = tmp_path / "places"
    places.mkdir()
    done = script(
        MOMENTS
        + """
        def replace(path):
            run(path, overwrite=True, chunk=600)  # of one chunk: most of it is the replacing
        def run(path, chunk=100, **options):
            store = Store(path, chunk=chunk, **options)
            return evaluate(some, GRID, OUTPUTS, executor="serial", store=store)
        every_moment(
            Path(sys.argv[1]),
            lambda path: shutil.copytree(sys.argv[2], path),
            replace,
            int(sys.argv[3]),
        )
        """.replace("\n        ", "\n"),
        places,
        old,
        step,
    )
    assert done.returncode == 0, done.stderr
    kept = []
    for place in sorted(places.iterdir(), key=lambda place: int(place.name)):
        for leftover in place.glob(".a.zarr.new-*"):
            shutil.rmtree(leftover)
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
    begun: Path, undisturbed: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    is_dir = Path.is_dir
    monkeypatch.setattr(Path, "is_dir", lambda path: path != begun and is_dir(path))
    monkeypatch.setattr(os.path, "lexists", lambda path: path != begun)
    with pytest.raises(OutputError):
        run(begun)
    monkeypatch.undo()
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


@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.parametrize("array", ["sum", "sign", "done"])
def test_what_is_damaged_is_computed_again_and_nothing_else(
    array: str, damage: str, begun: Path, undisturbed: Path
) -> None:
    for chunk in (1, 4):
        DAMAGES[damage](begun / array / "c" / (f"{chunk}" if array == "done" else f"{chunk}/0"))
    if array == "done":  # without its flag a chunk is one that was never finished
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


@pytest.mark.parametrize("name", ["sum/zarr.json", "done/zarr.json", "a/zarr.json"])
@pytest.mark.parametrize("damage", ["truncated", "emptied", "removed", "garbled"])
def test_the_descriptions_of_arrays_are_written_again(
    name: str, damage: str, begun: Path, undisturbed: Path
) -> None:
    DAMAGES[damage](begun / name)
    assert run(begun, resume=True)[1] == GRID.size
    assert whole(begun, undisturbed)


LIMITED = """
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
def small(path, **options):
    try:
        run(path, **options)
    except RocksteadyError as error:
        print(type(error).__name__, error)
def limited(cells):
    if cells == 200:  # the first two chunks are there
        resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))
def run(path, **options):
    store = Store(path, chunk=100, **options)
    evaluate(some, GRID, OUTPUTS, executor="serial", batch=100, done=told(), store=store)
def told():
    cells = 0
    def add(more):
        nonlocal cells
        cells += more
        limited(cells)
    return add
small(Path(sys.argv[1]))
"""


def test_a_file_that_may_not_grow_ends_the_run_in_one_line(
    undisturbed: Path, tmp_path: Path
) -> None:
    done = script(LIMITED, tmp_path / "a.zarr")
    assert done.stderr == ""
    assert re.fullmatch(
        r"UnfinishedError store = '.*a.zarr' is not finished: File too large; 2 of 6 chunks are "
        r"finished and kept; make room and resume it\n",
        done.stdout,
    )
    assert run(tmp_path / "a.zarr", resume=True)[1] == 2 * CHUNK
    assert whole(tmp_path / "a.zarr", undisturbed)


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A disk of 400 kB."""
    place = tmp_path / "disk"
    place.mkdir()
    if shutil.which("mount") is None:
        pytest.skip("there is no mount")
    mount = ["mount", "-t", "tmpfs", "-o", "size=400k", "tmpfs", str(place)]
    if subprocess.run(mount, check=False, capture_output=True).returncode:
        pytest.skip("a file system cannot be mounted here")
    yield place
    subprocess.run(["umount", place], check=True)


def test_a_full_disk_ends_the_run_in_one_line(small_disk: Path, undisturbed: Path) -> None:
    path, ballast = small_disk / "a.zarr", small_disk / "ballast"

    def full(cells: int) -> None:
        told.append(cells)
        if sum(told) == 200:
            with ballast.open("wb", buffering=0) as file, suppress(OSError):
                while file.write(bytes(4096)):
                    pass

    told: list[int] = []
    store = Store(path, chunk=CHUNK)
    with pytest.raises(UnfinishedError, match=r"No space left on device; 2 of 6 chunks are fin"):
        evaluate(some, GRID, OUTPUTS, executor="serial", batch=CHUNK, store=store, done=full)
    before = tree(path)
    with pytest.raises((UnfinishedError, OutputError), match="No space left") as caught:
        run(path, resume=True)  # while it is full
    assert "\n" not in str(caught.value)
    with pytest.raises(OutputError, match="No space left"):
        run(small_disk / "b.zarr")
    assert tree(path) == before
    ballast.unlink()
    assert run(path, resume=True)[1] == 2 * CHUNK
    assert tree(path) == tree(undisturbed)
    assert [entry.name for entry in small_disk.iterdir()] == ["a.zarr"]


def test_a_store_that_may_only_be_read_is_refused_in_one_line(
    small_disk: Path, undisturbed: Path
) -> None:
    shutil.copytree(undisturbed, small_disk / "a.zarr")
    subprocess.run(["mount", "-o", "remount,ro", small_disk], check=True)
    for how in ({"resume": True}, {"overwrite": True}):
        with pytest.raises(OutputError, match=r"it cannot be locked: Read-only file system"):
            run(small_disk / "a.zarr", **how)
    with pytest.raises(OutputError, match=r"its folder is not writable|Read-only"):
        run(small_disk / "b.zarr")


def test_a_second_process_is_refused_until_the_first_is_no_more(
    undisturbed: Path, tmp_path: Path
) -> None:
    path = tmp_path / "a.zarr"
    text = PREAMBLE + (
        "def told(cells):\n"
        "    print(cells, flush=True)\n"
        "    if cells == 100:\n"
        "        time.sleep(60)\n"
        "evaluate(some, GRID, OUTPUTS, executor='serial', batch=100, done=told,\n"
        "         store=Store(Path(sys.argv[1]), chunk=100))\n"
    )
    first = subprocess.Popen(
        [sys.executable, "-c", text, path],
        env={**os.environ, "PYTHONPATH": ROOT},
        stdout=subprocess.PIPE,
        text=True,
    )
    with first:
        assert first.stdout is not None
        assert first.stdout.readline() == "0\n"
        assert first.stdout.readline() == "100\n"
        for how in ({"resume": True}, {"overwrite": True}):
            with pytest.raises(OutputError) as caught:
                run(path, **how)
            assert f"another process is writing it (process {first.pid} on " in str(caught.value)
        with pytest.raises(OutputError, match="it exists"):
            run(path)
        first.kill()
    assert run(path, resume=True)[1] == CHUNK
    assert whole(path, undisturbed)


def test_another_sweep_is_refused_and_the_differences_named(begun: Path) -> None:
    before = tree(begun)
    store = Store(begun, resume=True)
    with pytest.raises(OutputError, match=r"factor nothing there, 3\.0 here"):
        evaluate(functools.partial(some, factor=3.0), GRID, OUTPUTS, store=store)
    with pytest.raises(OutputError, match=r"case .*:some there, .*:other here"):
        evaluate(other, GRID, OUTPUTS, store=store)
    with pytest.raises(OutputError, match=r"sign int8 there, nothing here|outputs sign"):
        evaluate(some, GRID, OUTPUTS[:1], store=store)
    finer = Grid(axes=(GRID.axes[0], Axis(name="b", values=np.arange(21.0))))
    with pytest.raises(OutputError, match=r"b points 20 there, 21 here.*b to 19\.0 there, 20\.0"):
        evaluate(some, finer, OUTPUTS, store=store)
    assert tree(begun) == before


def other(a: Any, b: Any) -> Any:
    return some(a, b)


@pytest.mark.parametrize(
    ("what", "said"),
    [("version", "version 0.0 there"), ("source", "source rocksteady 0123456789abcdef there")],
)
def test_what_another_version_has_computed_is_not_continued(
    what: str, said: str, begun: Path
) -> None:
    group = zarr.open_group(begun, mode="r+")
    inputs = json.loads(str(group.attrs["inputs"]))
    if what == "version":
        inputs["version"] = "0.0"
    else:
        inputs["source"]["rocksteady"] = "0123456789abcdef"
    group.attrs["inputs"] = json.dumps(inputs)
    with pytest.raises(OutputError, match=said):
        run(begun, resume=True)


@pytest.mark.parametrize(
    ("executor", "workers", "batch"),
    [("serial", 1, 1000), ("threads", 3, 7), ("threads", 1, 100), ("dask", 2, 50)],
)
def test_another_executor_goes_on_to_the_same_bytes(
    executor: str, workers: int, batch: int, begun: Path, undisturbed: Path
) -> None:
    for chunk in (0, 3, 4):
        (begun / "done" / "c" / f"{chunk}").unlink()
    _, there = run(begun, resume=True, executor=executor, workers=workers, batch=batch)
    assert there == GRID.size - 3 * CHUNK
    assert whole(begun, undisturbed)
