"""Runs of the solvers, with the package on the same cells right before and after each."""

import statistics
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from bench.peers.work import Cells, Outcome, Peer

QUICK = 10.0  # seconds below which a solver runs three times
OWN_RUNS = 5  # of the package, before and again after each solver

Say = Callable[[str], None]
Run = Callable[[Cells], Outcome]


@contextmanager
def noted(name: str, rows: list[dict[str, Any]], say: Say) -> Iterator[None]:
    """Keep a row that says why, where a solver is not installed or fails; the others still run."""
    say(name)
    try:
        yield
    except ImportError:
        rows.append({"name": name, "failed": "not installed"})
    except Exception as error:  # noqa: BLE001 - the row says why
        say(f"  {error!r}")
        rows.append({"name": name, "failed": f"failed: {type(error).__name__}"})


def set_up(maker: Callable[[], list[Peer]]) -> tuple[list[Peer], float]:
    """Return the ways to run a solver and the time that each took to prepare."""
    began = time.process_time()
    peers = maker()
    return peers, (time.process_time() - began) / len(peers)


def measured(peer: Peer, own: Cells, package: Run) -> tuple[dict[str, Any], Outcome]:
    """Run one solver on its cells, with the package on the same cells before and after it."""
    ours_runs = [package(own).seconds for _ in range(OWN_RUNS)]
    runs = [peer.run(own)]
    while runs[0].seconds < QUICK and len(runs) < 3:
        runs.append(peer.run(own))
    ours_runs += [package(own).seconds for _ in range(OWN_RUNS)]
    ours = statistics.median(ours_runs)
    # Of the package itself the same runs, so that it is 1.0 times as fast as itself.
    seconds = ours if peer.run is package else statistics.median(run.seconds for run in runs)
    return {
        "name": peer.name,
        "version": peer.version,
        "settings": peer.settings,
        "cells": len(own.index),
        "us": 1e6 * seconds / len(own.index),
        "ours_us": 1e6 * ours / len(own.index),
        "ratio": seconds / ours,
        "remark": runs[-1].remark,
    }, runs[-1]
