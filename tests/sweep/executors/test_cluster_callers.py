"""Who calls a cluster: interrupted, at a terminal, killed; and nothing is left behind."""

import functools
import os
import pty
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import psutil
import pytest

from rocksteady.errors import UnfinishedError
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.executors import _local
from rocksteady.sweep.run import Execution
from tests.every import every
from tests.sweep.executors.callers import ENDLESS, RUN, SCRIPT, script_in, started, within
from tests.sweep.executors.cases import GRID, OUTPUTS, held, some


@pytest.mark.slow
def test_an_interruption_waits_for_no_cell_and_leaves_nothing_behind(
    address: str, tmp_path: Path
) -> None:
    def interrupt(cells: int) -> None:
        if cells:
            signal.raise_signal(signal.SIGINT)

    before = {child.pid for child in psutil.Process().children(recursive=True)}
    for executor in ("dask", address):
        gate = tmp_path / f"{executor[:4]}"
        cases = functools.partial(held, gate=str(gate))
        with within(120), pytest.raises(KeyboardInterrupt):
            evaluate(
                cases,
                GRID,
                OUTPUTS,
                run=Execution(executor=executor, workers=2, progress=interrupt),
                batch=20,
            )
        assert {child.pid for child in psutil.Process().children(recursive=True)} == before
        gate.touch()  # those of a cluster that stays would wait for ever


@pytest.mark.slow
def test_a_script_needs_no_guard_and_says_nothing(tmp_path: Path) -> None:
    # A worker is killed, too; the case function is one of the script.
    text = (
        SCRIPT
        + """
import psutil
def told(cells):
    if cells and not told.killed:
        told.killed = True
        psutil.Process().children()[0].kill()
told.killed = False
"""
        + RUN
        + "print(float(data['sum'].sum()))\n"
    )
    file = script_in(tmp_path, text)
    root = str(Path(__file__).parents[3])
    done = subprocess.run(
        [sys.executable, file],
        env={**os.environ, "PYTHONPATH": root},
        capture_output=True,
        text=True,
        check=True,
        timeout=200,
    )
    assert done.stderr == ""
    assert float(done.stdout) == float(evaluate(some, GRID, OUTPUTS)["sum"].sum())


@pytest.mark.slow
@every("when", ["computing", 0.05, 0.3, 0.6])
def test_ctrl_c_in_a_terminal_is_all_that_one_sees(when: float | str) -> None:
    text = (
        ENDLESS
        + "print('here', flush=True)\ntry:\n    "
        + RUN.replace("batch=4", "batch=1")
        + "except KeyboardInterrupt:\n    print('stopped')\n"
    )
    own, other = pty.openpty()
    process = started(text, stdin=other, stdout=other, stderr=other, start_new_session=True)
    os.close(other)
    said = b""
    with within(120):
        while (b"begun" if when == "computing" else b"here") not in said:
            said += os.read(own, 1000)
        if not isinstance(when, str):
            time.sleep(when)
        children = psutil.Process(process.pid).children(recursive=True)
        os.killpg(process.pid, signal.SIGINT)
        with suppress(OSError):  # the end, on Linux
            while more := os.read(own, 1000):
                said += more
        assert process.wait() == 0
    words = said.decode()
    assert "stopped" in words
    for word in ("here", "begun", "stopped"):
        words = words.replace(word, "")
    assert not words.strip()
    assert not psutil.wait_procs(children, timeout=60)[1]
    os.close(own)


@pytest.mark.slow
def test_workers_end_with_a_caller_that_is_killed(tmp_path: Path) -> None:
    process = started(ENDLESS + RUN, stdout=subprocess.PIPE, temporary=tmp_path)
    with process:
        assert process.stdout is not None
        assert process.stdout.readline() == "begun\n"
        children = psutil.Process(process.pid).children(recursive=True)
        assert len(children) == 2
        assert list(tmp_path.iterdir())
        process.kill()
    assert not psutil.wait_procs(children, timeout=60)[1]
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_a_caller_that_is_killed_while_its_workers_start_leaves_no_folder(tmp_path: Path) -> None:
    with within(120), started(ENDLESS + RUN, stdout=subprocess.PIPE, temporary=tmp_path) as process:
        while len(children := psutil.Process(process.pid).children()) < 2:
            time.sleep(0.001)
        time.sleep(0.05)  # in which the second one is usually told of the folder
        assert list(tmp_path.iterdir())
        process.kill()
    assert not psutil.wait_procs(children, timeout=60)[1]
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("does", "how"),
    [
        ("raise SystemExit(7)", "with status 7"),
        ("import os; os.kill(os.getpid(), 9)", "by signal 9"),
    ],
)
def test_workers_that_cannot_start_are_no_endless_loop(
    does: str, how: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(_local, "START", does)
    with within(120), pytest.raises(UnfinishedError, match=f"end at once, {how}"):
        evaluate(some, GRID, OUTPUTS, run=Execution(executor="dask", workers=1))
