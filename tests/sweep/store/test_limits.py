"""A store against full disks, other processes, other sweeps; and with other executors."""

import math
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest

from rocksteady.errors import OutputError, UnfinishedError
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.run import Execution
from rocksteady.sweep.store import _writer
from rocksteady.sweep.store.store import Store
from tests.sweep.executors.cases import GRID, OUTPUTS, some
from tests.sweep.store.faults import CHUNK, PREAMBLE, ROOT, run, script, tree, whole

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
    how = Execution(executor="serial", store=store, progress=told())
    evaluate(some, GRID, OUTPUTS, run=how, batch=100)
def told():
    cells = 0
    def add(more):
        nonlocal cells
        cells += more
        limited(cells)
    return add
small(Path(sys.argv[1]))
"""


@pytest.mark.slow
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


def test_a_full_disk_ends_the_run_in_one_line(
    small_disk: Path, undisturbed: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(_writer, "SHARE", math.inf)  # each chunk is marked as finished at once
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
        evaluate(
            some,
            GRID,
            OUTPUTS,
            run=Execution(executor="serial", store=store, progress=full),
            batch=CHUNK,
        )
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


@pytest.mark.slow
def test_a_second_process_is_refused_until_the_first_is_no_more(
    undisturbed: Path, tmp_path: Path
) -> None:
    path = tmp_path / "a.zarr"
    text = PREAMBLE + (
        "def told(cells):\n"
        "    print(cells, flush=True)\n"
        "    if cells == 100:\n"
        "        time.sleep(3600)\n"
        "store = Store(Path(sys.argv[1]), chunk=100)\n"
        "how = Execution(executor='serial', store=store, progress=told)\n"
        "evaluate(some, GRID, OUTPUTS, run=how, batch=100)\n"
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


@pytest.mark.slow
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
