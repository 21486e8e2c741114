"""Writing chunks: jobs in any order, what is marked as finished when, and one writer at a time."""

from pathlib import Path

import numpy as np
import pytest

from rocksteady import durable
from rocksteady.errors import OutputError, UnfinishedError
from rocksteady.sweep.cases.task import Answer, Task
from rocksteady.sweep.store import _writer
from rocksteady.sweep.store._writer import StoreFiles, locked
from rocksteady.sweep.store.reading import finished_cells, open_store
from rocksteady.sweep.store.store import Store
from tests.every import every
from tests.sweep.executors.cases import GRID, OUTPUTS, some
from tests.sweep.store.faults import CHUNK, CHUNKS, tree

TASK = Task(cases=some, grid=GRID, outputs=OUTPUTS, numbered=None, batch=CHUNK)
A, B = (points.ravel() for points in np.meshgrid(*(x.points for x in GRID.axes), indexing="ij"))
WHOLE = some(A, B)


def answer(first: int, stop: int, end: int | None = None) -> Answer:
    """Return the results of a job, or of its cells up to one."""
    arrays = {name: values[first:stop] for name, values in WHOLE.items()}
    return Answer(job=(first, stop if end is None else end), stop=stop, arrays=arrays)


@every("seed", range(5))
def test_jobs_of_any_length_in_any_order_make_the_same_store(
    seed: int, tmp_path: Path, undisturbed: Path
) -> None:
    rng = np.random.default_rng(seed)
    jobs = []
    for first in range(0, GRID.size, CHUNK):
        cuts = np.unique([0, CHUNK, *rng.integers(1, CHUNK, 3)]) + first
        jobs += list(zip(cuts[:-1].tolist(), cuts[1:].tolist(), strict=True))
    path = tmp_path / "a.zarr"
    with Store(path, chunk=CHUNK).opened(TASK, {}) as writer:
        assert list(writer.missing()) == [(k * CHUNK, (k + 1) * CHUNK) for k in range(CHUNKS)]
        for at in rng.permutation(len(jobs)).tolist():
            writer.put(answer(*jobs[at]))
        assert list(writer.missing()) == []
    assert tree(path) == tree(undisturbed)


def test_only_whole_chunks_are_kept_and_the_others_are_missing(tmp_path: Path) -> None:
    path = tmp_path / "a.zarr"
    with Store(path, chunk=CHUNK).opened(TASK, {}) as writer:
        writer.put(answer(100, 200))
        writer.put(answer(300, 350, end=400))  # interrupted
        writer.put(answer(500, 580))
        writer.put(answer(580, 600))
    assert finished_cells(path) == (200, 600)
    with Store(path, resume=True).opened(TASK, {}) as writer:
        assert list(writer.missing()) == [(0, 100), (200, 300), (300, 400), (400, 500)]
    found = open_store(path, partial=True)
    np.testing.assert_array_equal(
        np.flatnonzero(found.computed), [*range(100, 200), *range(500, 600)]
    )
    np.testing.assert_array_equal(found["sum"].values.ravel()[100:200], WHOLE["sum"][100:200])


def test_files_are_forced_to_the_disk_several_chunks_at_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # The first chunk is written at once; the next wait, because to write takes so long.
    monkeypatch.setattr(_writer, "SHARE", 1e-12)
    path = tmp_path / "a.zarr"
    with Store(path, chunk=CHUNK).opened(TASK, {}) as writer:
        seen = []
        for first in range(0, 500, CHUNK):
            writer.put(answer(first, first + CHUNK))
            seen.append(finished_cells(path)[0])
        assert seen == [100] * 5
        writer.flush()
        assert finished_cells(path)[0] == 500
        # The last one of all waits for nothing.
        writer.put(answer(500, 600))
        assert finished_cells(path)[0] == 600


def test_many_bytes_do_not_wait(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_writer, "SHARE", 1e-12)
    monkeypatch.setattr(_writer, "MOST_HELD", 10)
    path = tmp_path / "a.zarr"
    with Store(path, chunk=CHUNK).opened(TASK, {}) as writer:
        for first in range(0, 300, CHUNK):
            writer.put(answer(first, first + CHUNK))
            assert finished_cells(path)[0] == first + CHUNK


def test_what_there_was_room_for_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_writer, "SHARE", 1e-12)
    path = tmp_path / "a.zarr"
    put = StoreFiles.put
    written: list[int] = []

    def short(self: StoreFiles, files: dict[str, bytes]) -> None:
        """Write no more than the files of one chunk at a time, and of two in all."""
        if len(files) > len(OUTPUTS) or len(written) == 4:
            raise OSError(28, "No space left on device")
        written.append(len(files))
        put(self, files)

    def interrupted() -> None:
        with Store(path, chunk=CHUNK).opened(TASK, {}) as writer:
            writer.put(answer(0, CHUNK))
            monkeypatch.setattr(StoreFiles, "put", short)
            for first in (100, 200, 300):
                writer.put(answer(first, first + CHUNK))

    with pytest.raises(UnfinishedError, match="No space left on device; 3 of 6 chunks are finish"):
        interrupted()
    monkeypatch.undo()
    assert finished_cells(path) == (300, 600)


def test_there_is_one_writer_at_a_time(begun: Path) -> None:
    with locked(begun) as files:
        assert isinstance(files, StoreFiles)
        with pytest.raises(OutputError, match=r"another process is writing it \(process \d+ on "):
            locked(begun).__enter__()
    with locked(begun):
        pass


def test_what_a_killed_writer_left_is_removed_and_nothing_else(begun: Path) -> None:
    token = "0123456789abcdef" * 2
    done = begun / "done"
    (done / "lock").write_text(f"process 1 on hut\n{token}")
    left, other = done / f"{token}-0.partial", done / "mine.partial"
    for file in (left, other):
        file.write_text("half")
    with locked(begun):
        assert not left.exists()
        assert other.exists()
    assert (done / "lock").read_text() == ""


def test_files_are_put_whole_or_not_at_all(begun: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = tree(begun)
    with locked(begun) as files:
        files.put({"more/a": b"one", "more/deeper/b": b"two"})
        assert (begun / "more" / "deeper" / "b").read_bytes() == b"two"

        def full(path: Path, content: bytes) -> None:
            path.write_bytes(content[:1])
            raise OSError(28, "No space left on device")

        monkeypatch.setattr(durable, "create", full)
        with pytest.raises(OSError, match="No space left"):
            files.put({"more/c": b"three"})
    assert not (begun / "more" / "c").exists()
    assert not list(begun.rglob("*.partial"))
    assert tree(begun).keys() - before.keys() == {"more/a", "more/deeper/b"}
