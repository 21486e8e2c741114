"""Worker processes: the same bytes, everything sent once, and nothing lost."""

import functools
import gc
import importlib
import io
import logging
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import distributed
import numpy as np
import psutil
import pytest
import xarray

from rocksteady.errors import InputError, UnfinishedError
from rocksteady.sweep.cases import inputs
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.executors import _dask, _local, _remote
from rocksteady.sweep.executors._local import Local
from rocksteady.sweep.executors._worker import START
from rocksteady.sweep.run import Execution
from rocksteady.sweep.store.store import Store
from tests.sweep.executors.callers import started, tree, within
from tests.sweep.executors.cases import (
    GRID,
    OUTPUTS,
    Noted,
    deadly,
    failing,
    of_items,
    slow,
    some,
)


@pytest.mark.slow
def test_a_store_has_the_same_bytes_whoever_computes(address: str, tmp_path: Path) -> None:
    trees = []
    for number, (executor, workers, batch) in enumerate(
        [("serial", 1, 1024), ("threads", 3, 7), (address, None, 10), (address, 1, 50)]
    ):
        store = Store(tmp_path / f"{number}.zarr", chunk=100)
        evaluate(
            some,
            GRID,
            OUTPUTS,
            run=Execution(executor=executor, workers=workers, store=store),
            batch=batch,
        )
        trees.append(tree(store.folder))
    assert all(other == trees[0] for other in trees[1:])


def test_a_client_with_tls_gives_the_same_bytes_though_a_worker_is_killed(tmp_path: Path) -> None:
    stores = [Store(tmp_path / name, chunk=100) for name in ("threads", "tls")]
    cases = functools.partial(slow, seconds=0.004)
    evaluate(cases, GRID, OUTPUTS, run=Execution(store=stores[0]))
    killed: list[int] = []
    with (
        within(120),
        distributed.LocalCluster(
            n_workers=2,
            threads_per_worker=1,
            security=distributed.Security.temporary(),
            dashboard_address=None,
            local_directory=str(tmp_path),
        ) as cluster,
        cluster.get_client() as client,
    ):

        def kill(cells: int) -> None:
            if cells and not killed:
                killed.append(next(iter(client.run(os.getpid).values())))
                os.kill(killed[0], signal.SIGKILL)

        run = Execution(executor=client, store=stores[1], progress=kill)
        evaluate(cases, GRID, OUTPUTS, run=run, batch=5)
        later = Execution(executor=client)
        assert client.status == "running"
        assert cluster.scheduler_address.startswith("tls://")
    assert killed
    trees = [tree(store.folder) for store in stores]
    assert trees[0] == trees[1]
    with pytest.raises(InputError, match="a client must be connected"):
        evaluate(some, GRID, OUTPUTS, run=later)


@pytest.mark.slow
def test_a_cluster_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[int] = []
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    children = set(psutil.Process().children(recursive=True))
    found = evaluate(
        some,
        GRID,
        OUTPUTS,
        run=Execution(executor="dask", workers=2, progress=told.append),
        batch=50,
    )
    assert found.identical(evaluate(some, GRID, OUTPUTS, run=Execution(executor="serial")))
    assert told[0] == 0
    assert sum(told) == GRID.size
    assert set(psutil.Process().children(recursive=True)) == children
    assert not list(tmp_path.iterdir())


def test_things_are_sent_once_to_each_worker(address: str, tmp_path: Path) -> None:
    things = [Noted(float(k), str(tmp_path)) for k in range(3)]
    grid = Grid(
        axes=(
            Axis(name="thing", values=["x", "y", "z"], items=things),
            Axis(name="b", values=np.arange(40.0)),
        )
    )
    found = evaluate(of_items, grid, OUTPUTS[:1], run=Execution(executor=address), batch=2)
    assert np.array_equal(found["sum"].values, np.outer([0.0, 1.0, 2.0], np.arange(40.0)))
    processes = [path.name.partition("-")[0] for path in tmp_path.iterdir()]
    assert len(processes) == 2 * len(things)
    assert all(processes.count(process) == len(things) for process in processes)


def test_nothing_stays_at_the_scheduler(local_cluster: Local, address: str) -> None:
    evaluate(slow, GRID, OUTPUTS, run=Execution(executor=address), batch=20)

    def left(dask_scheduler: Any) -> tuple[int, int]:
        plugins = [name for name in dask_scheduler.worker_plugins if "rocksteady" in name]
        return len(dask_scheduler.tasks), len(plugins)

    with within(120):
        while local_cluster.client.run_on_scheduler(left) != (0, 0):
            time.sleep(0.05)


@pytest.mark.parametrize("kind", ["ours", "another"])
def test_an_error_of_the_case_function_comes_out_once_and_says_where(
    address: str, kind: str
) -> None:
    cases = functools.partial(failing, kind=kind)
    expected = InputError if kind == "ours" else ZeroDivisionError
    with pytest.raises(expected) as caught:
        evaluate(cases, GRID, OUTPUTS, run=Execution(executor=address, workers=1), batch=20)
    assert type(caught.value) is expected
    assert len(caught.value.__notes__) == 1
    assert caught.value.__notes__[0].startswith("in cells ")


def test_a_worker_of_other_sources_is_refused(
    address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(inputs, "_hash_of", lambda _: "0123456789abcdef")
    with pytest.raises(InputError) as caught:
        evaluate(some, GRID, OUTPUTS, run=Execution(executor=address))
    message = str(caught.value)
    assert "its worker tcp://127.0.0.1:" in message
    assert "has other sources of" in message
    assert "than the caller, 0123456789abcdef (rocksteady " in message


@pytest.mark.slow
def test_a_worker_of_other_sources_that_joins_late_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    other = START.replace(
        "from ", "import rocksteady.sweep.cases.inputs as i; i._hash_of = lambda _: 'f' * 16; from "
    )
    joined: list[_local.WorkerProcesses] = []
    cases = functools.partial(slow, seconds=0.02)
    with Local(1) as cluster:
        monkeypatch.setattr(_local, "START", other)

        def join(cells: int) -> None:
            if cells and not joined:
                joined.append(_local.WorkerProcesses(1, str(tmp_path)))
                joined[0].connect(cluster.address)

        with pytest.raises(InputError, match=r"has other sources of .*, ffffffffffffffff"):
            evaluate(
                cases,
                GRID,
                OUTPUTS,
                run=Execution(executor=cluster.address, progress=join),
                batch=1,
            )
        joined[0].end()


def test_a_worker_that_cannot_load_the_case_function_is_named(
    address: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = (
        "from tests.sweep.executors.cases import some\ndef mine(a, b):\n    return some(a, b)\n"
    )
    (tmp_path / "only_here.py").write_text(source, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    module = importlib.import_module("only_here")
    with pytest.raises(InputError) as caught:
        evaluate(module.mine, GRID, OUTPUTS, run=Execution(executor=address))
    assert re.search(
        r"its worker tcp://\S+ cannot load the case function and its constants: "
        r"ModuleNotFoundError: No module named 'only_here'; install",
        str(caught.value),
    )


def test_what_cannot_be_sent_is_refused(address: str) -> None:
    lock = threading.Lock()

    def locked(a: Any, b: Any) -> Any:
        with lock:
            return some(a, b)

    with pytest.raises(InputError, match="other processes need a description of it"):
        evaluate(locked, GRID, OUTPUTS, run=Execution(executor=address))


def test_an_address_where_no_scheduler_answers_is_refused_and_nothing_is_waited_for(
    local_cluster: Local, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(_remote, "ANSWERED", 0.3)
    (worker,) = list(local_cluster.client.nthreads())[:1]
    silence = "(nothing does|OSError: Timed out)"  # whichever ends first
    with socket.create_server(("127.0.0.1", 0)) as silent:
        for place, reason in (
            ("tcp://127.0.0.1:9", silence),
            ("tcp://no.invalid:1", "gaierror: "),
            (f"tcp://127.0.0.1:{silent.getsockname()[1]}", silence),
            ("tls://127.0.0.1:9", "TypeError: TLS expects"),
            (worker, "a Worker does"),
        ):
            with pytest.raises(InputError, match=f"there within 0.3 seconds: .*{reason}"):
                evaluate(some, GRID, OUTPUTS, run=Execution(executor=place))
    gc.collect()  # a client that is half made would try to close itself
    assert capfd.readouterr().err == ""


def test_a_cluster_without_workers_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_remote, "PATIENCE", 0.3)
    with Local(0) as empty, pytest.raises(InputError, match="no worker for 0"):
        evaluate(some, GRID, OUTPUTS, run=Execution(executor=empty.address))


@pytest.mark.slow
def test_one_is_told_that_all_workers_have_gone_and_goes_on_with_new_ones(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(_remote, "PATIENCE", 0.5)
    monkeypatch.setattr(_remote, "LOOKED", 0.1)
    killed: list[int] = []
    with Local(1) as cluster:
        cluster.client.wait_for_workers(1)

        def kill(cells: int) -> None:
            if cells and not killed:
                killed.append(cells)
                cluster._workers._processes[0].kill()

        def replace(warned: pytest.WarningsRecorder) -> None:
            while not len(warned):
                time.sleep(0.01)
            cluster.check_workers(progress=True)

        def computed(warned: pytest.WarningsRecorder) -> xarray.Dataset:
            threading.Thread(target=replace, args=(warned,), daemon=True).start()
            run = Execution(executor=cluster.address, progress=kill)
            return evaluate(slow, GRID, OUTPUTS, run=run, batch=5)

        with within(120), pytest.warns(UserWarning, match="no worker for 0") as warned:
            found = computed(warned)
    assert 0 < killed[0] < GRID.size
    assert np.array_equal(found["sum"].values, evaluate(some, GRID, OUTPUTS)["sum"].values)


def test_dask_may_not_be_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"pip install 'rocksteady\[cluster\]'"):
        evaluate(some, GRID, OUTPUTS, run=Execution(executor="dask"))


@pytest.mark.slow
def test_a_worker_that_is_killed_is_replaced(tmp_path: Path) -> None:
    notes = tmp_path / "notes"
    notes.mkdir()
    cases = functools.partial(deadly, folder=str(notes), times=1)
    found = evaluate(cases, GRID, OUTPUTS, run=Execution(executor="dask", workers=2), batch=10)
    assert len(list(notes.iterdir())) == 1
    assert np.array_equal(found["sum"].values, evaluate(some, GRID, OUTPUTS)["sum"].values)


@pytest.mark.slow
@pytest.mark.parametrize("ours", [True, False])
def test_an_answer_that_is_lost_with_the_last_worker_is_computed_again(
    ours: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    killed: list[int] = []

    class Killing(_dask.JoinedWorkers):
        """Kills the worker that has just finished a job, before anybody can fetch the answer."""

        def add_worker(self, scheduler: Any, worker: str) -> None:
            super().add_worker(scheduler, worker)
            self.last = scheduler.workers[worker].pid

        def transition(self, *states: Any, **_: Any) -> None:
            if states[2] == "memory" and len(killed) < 2 and self.last not in killed:
                os.kill(self.last, signal.SIGKILL)
                killed.append(self.last)

    monkeypatch.setattr(_dask, "JoinedWorkers", Killing)
    monkeypatch.setattr(_remote, "LOOKED", 0.1)
    told: list[int] = []
    ended = threading.Event()

    def replace_ended(cluster: Local) -> None:
        while not ended.wait(0.1):
            cluster.check_workers(progress=True)

    with ExitStack() as stack:
        stack.enter_context(within(120))
        executor = "dask"
        if not ours:
            cluster = stack.enter_context(Local(1))
            cluster.client.wait_for_workers(1)
            executor = cluster.address
            replacing = threading.Thread(target=replace_ended, args=(cluster,))
            replacing.start()
            stack.callback(replacing.join)
            stack.callback(ended.set)
        found = evaluate(
            slow, GRID, OUTPUTS, run=Execution(executor=executor, workers=1, progress=told.append)
        )
    assert len(killed) == 2
    assert sum(told) == GRID.size
    assert np.array_equal(found["sum"].values, evaluate(some, GRID, OUTPUTS)["sum"].values)


@pytest.mark.slow
def test_workers_that_are_killed_while_they_compute_are_not_said_to_end_at_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(_local, "KILLS", 1)
    cases = functools.partial(deadly, folder=str(tmp_path), times=3)
    found = evaluate(cases, GRID, OUTPUTS, run=Execution(executor="dask", workers=1))
    assert len(list(tmp_path.iterdir())) == 3
    assert np.array_equal(found["sum"].values, evaluate(some, GRID, OUTPUTS)["sum"].values)


def test_a_worker_that_dies_while_it_is_sent_the_task_is_no_lost_scheduler(
    address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    tries: list[str] = []
    register = distributed.Client.register_plugin

    def failing_first(client: Any, plugin: Any, name: str) -> Any:
        tries.append(name)
        if len(tries) < 3:
            raise OSError("closed")
        return register(client, plugin, name)

    monkeypatch.setattr(distributed.Client, "register_plugin", failing_first)
    evaluate(some, GRID, OUTPUTS, run=Execution(executor=address))
    assert len(tries) == 3


@pytest.mark.slow
def test_cells_that_kill_every_worker_are_named(tmp_path: Path) -> None:
    notes = tmp_path / "notes"
    notes.mkdir()
    cases = functools.partial(deadly, folder=str(notes), times=4)
    store = Store(tmp_path / "a.zarr", chunk=20)
    with pytest.raises(UnfinishedError) as caught:
        evaluate(
            cases, GRID, OUTPUTS, run=Execution(executor="dask", workers=2, store=store), batch=5
        )
    message = str(caught.value)
    assert "executor = 'dask' is not finished: 4 worker processes ended" in message
    assert "when they computed cells 4" in message
    assert f"of 600: a {GRID.axes[0].points[20]:.15g} to " in message
    assert "\n" not in message
    before = tree(store.folder)
    evaluate(cases, GRID, OUTPUTS, run=Execution(store=Store(store.folder, resume=True)))
    after = tree(store.folder)
    assert len(before) < len(after)
    assert all(after[name] == content for name, content in before.items())


LOSABLE = """
import sys
from distributed import LocalCluster
if __name__ == "__main__":
    cluster = LocalCluster(n_workers=1, threads_per_worker=2, processes=False, protocol="tcp://",
                           dashboard_address="127.0.0.1:0")
    print(cluster.scheduler_address, flush=True)
    sys.stdin.read()
"""


@pytest.mark.slow
def test_a_cluster_that_is_lost_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    # An hour, which nobody waits who does not try to connect again.
    monkeypatch.setattr(_remote, "ANSWERED", 3600.0)
    with within(120), started(LOSABLE, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        assert process.stdout is not None
        executor = process.stdout.readline().strip()

        def kill(cells: int) -> None:
            if cells:
                process.kill()

        with pytest.raises(UnfinishedError) as caught:
            evaluate(slow, GRID, OUTPUTS, run=Execution(executor=executor, progress=kill), batch=5)
    assert str(caught.value).startswith(f"executor = '{executor}' is not finished: the connection")
    assert "\n" not in str(caught.value)


@pytest.mark.slow
def test_messages_of_dask_alone_are_kept_from_the_terminal() -> None:
    dask, ours = logging.getLogger("distributed.nanny"), logging.getLogger("laboratory.distributed")
    streams = [logging.StreamHandler(io.StringIO()) for _ in range(2)]
    try:
        for logger, handler in zip((dask, ours), streams, strict=True):
            logger.addHandler(handler)
        with _dask.quiet():
            dask.error("lost a worker")
            ours.error("lost a table")
        dask.error("lost another")
    finally:
        for logger, handler in zip((dask, ours), streams, strict=True):
            logger.removeHandler(handler)
    written = [handler.stream.getvalue() for handler in streams]
    assert written == ["lost another\n", "lost a table\n"]
