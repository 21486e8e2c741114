"""Computes the units of parts in a few processes."""

import multiprocessing
import os
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from typing import NamedTuple
from unittest.mock import patch

from tools.aot.replay.outcome import MissingProgramError
from tools.freeze.parts import PARTS
from tools.freeze.results import begin


class Frozen(NamedTuple):
    """What has become of a part.

    Attributes
    ----------
    part
        Its name.
    items
        Its items.
    missing
        Units that cannot be computed here, and why.
    seconds
        Seconds of the processor that it took.
    """

    part: str
    items: dict[str, str]
    missing: dict[str, str]
    seconds: float


def frozen_unit(part: str, unit: str) -> Frozen:
    """Return what has become of a unit."""
    began = time.process_time()
    try:
        items, missing = dict(PARTS[part].freeze(unit)), {}
    except MissingProgramError as error:
        items, missing = {}, {unit: str(error)}
    return Frozen(part, items, missing, time.process_time() - began)


def frozen(names: list[str], workers: int) -> Iterator[Frozen]:
    """Yield parts, each when all of its units are done."""
    tasks = [(name, unit) for name in names for unit in PARTS[name].units()]
    waiting = Counter(name for name, _ in tasks)
    parts = {name: Frozen(name, {}, {}, 0.0) for name in names}
    spawn = multiprocessing.get_context("spawn")
    with (
        tempfile.TemporaryDirectory(prefix="frozen-") as room,
        patch.dict(os.environ, TMPDIR=room),
        ProcessPoolExecutor(workers, mp_context=spawn, initializer=begin) as pool,
    ):
        for done in as_completed([pool.submit(frozen_unit, *task) for task in tasks]):
            found = done.result()
            name, items, missing, took = parts[found.part]
            seconds = took + found.seconds
            parts[name] = Frozen(name, items | found.items, missing | found.missing, seconds)
            waiting[name] -= 1
            if not waiting[name]:
                yield parts.pop(name)
