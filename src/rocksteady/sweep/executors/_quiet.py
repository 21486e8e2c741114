"""Dask's own messages."""

import logging
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

from distributed.utils import silence_logging_cmgr


@contextmanager
def quiet() -> Iterator[None]:
    """Keep dask's own messages from the terminal: what matters is raised, or a warning.

    Only handlers that write to a stream are turned down, so that a log file has all.
    """
    with ExitStack() as stack:
        for name in ("distributed", *logging.root.manager.loggerDict):
            if name.partition(".")[0] in {"distributed", "tornado"}:
                stack.enter_context(silence_logging_cmgr(logging.CRITICAL + 1, name))
        yield
