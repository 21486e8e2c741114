"""Who can reach the processes of a sweep: nobody outside this machine."""

import ipaddress
import os
import sys
import time
from pathlib import Path

import psutil
import pytest

from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.executors._local import Local, _how
from rocksteady.sweep.run import Execution
from tests.sweep.executors.callers import within
from tests.sweep.executors.cases import GRID, OUTPUTS, slow

LISTENING = "0A"


def sockets_of(process: int) -> set[str]:
    """Return the inodes of a process's sockets."""
    found = set()
    for entry in os.scandir(f"/proc/{process}/fd"):
        try:
            name = str(Path(entry.path).readlink())
        except FileNotFoundError:
            continue
        if name.startswith("socket:["):
            found.add(name[8:-1])
    return found


def listening(family: str) -> dict[str, str]:
    """Return the addresses at which anything listens, by the inodes of the sockets."""
    lines = Path(f"/proc/net/{family}").read_text(encoding="ascii").splitlines()[1:]
    rows = [line.split() for line in lines]
    return {row[9]: address_of(row[1].partition(":")[0]) for row in rows if row[3] == LISTENING}


def address_of(digits: str) -> str:
    """Return an address from what the kernel writes: words of four bytes, the lowest first."""
    words = [bytes.fromhex(digits[k : k + 8])[::-1] for k in range(0, len(digits), 8)]
    return str(ipaddress.ip_address(b"".join(words)))


def ours() -> list[str]:
    """Return the addresses at which this process and all that it started listen."""
    family = psutil.Process()
    mine = set().union(
        *(sockets_of(member.pid) for member in [family, *family.children(recursive=True)])
    )
    there = {**listening("tcp"), **listening("tcp6")}
    return [place for inode, place in there.items() if inode in mine]


def test_how_a_process_has_ended_is_told() -> None:
    ends = {0: "with status 0", 3: "with status 3", -9: "by signal 9"}
    assert {status: _how(status) for status in ends} == ends


def test_addresses_of_the_kernel_are_read() -> None:
    assert address_of("0100007F") == "127.0.0.1"
    assert address_of("00000000") == "0.0.0.0"
    assert address_of("00000000000000000000000001000000") == "::1"


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc/net")
def test_all_that_a_sweep_opens_listens_on_this_machine_alone() -> None:
    before = ours()
    during: list[list[str]] = []

    def look(cells: int) -> None:
        # Of a scheduler and two workers, for messages and pages; one worker may join later.
        while cells and not during and len(ours()) < len(before) + 6:
            time.sleep(0.01)
        if cells:
            during.append(ours())

    with within(120):
        evaluate(
            slow, GRID, OUTPUTS, run=Execution(executor="dask", workers=2, progress=look), batch=50
        )
    assert len(during[0]) >= len(before) + 6
    for places in during:
        assert {*places} - {*before} <= {"127.0.0.1", "::1"}


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc/net")
def test_settings_of_dask_open_no_other_address() -> None:
    import dask

    settings = {
        "distributed.scheduler.dashboard.link": "http://0.0.0.0",
        "distributed.worker.dashboard.address": "0.0.0.0:0",
        "distributed.comm.default-scheme": "tcp",
        "distributed.dashboard.link": "x",
    }
    before = ours()
    with dask.config.set(settings), Local(1) as cluster:
        cluster.client.wait_for_workers(1)
        assert {*ours()} - {*before} <= {"127.0.0.1", "::1"}
