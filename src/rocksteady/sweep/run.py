"""How a sweep is run: executor, number of workers, storage and progress."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from rocksteady.errors import ModelError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import INSIDE
from rocksteady.sweep.executors.choice import WORKERS, validated_executor
from rocksteady.sweep.store.store import Store

if TYPE_CHECKING:
    from distributed import Client

Progress = Callable[[int], object]
"""Called in the calling thread: once with the number of cells that are done already, when the
first of the others is about to be computed; then with the number of those just finished.  The last
call comes when everything is kept, in a store on disk."""


@checked
@dataclass(frozen=True, kw_only=True)
class Execution:
    """How a sweep is run: what computes its cells, and where they are kept.

    No result depends on it.

    Parameters
    ----------
    executor
        "threads" (default), "serial", "gpu" for an NVIDIA GPU, "dask" for a cluster of processes on
        this machine, the address of a dask scheduler, as "tcp://10.0.0.1:8786", or a connected
        `distributed.Client`, which is left open.  A GPU computes fates and attractors under
        harmonic shaking and runs of blocks on records, and leaves to the processor only the few
        cells that need more memory than a thread of the GPU has.
    workers
        Number of threads or processes; by default as many as this process may use cores, or as a
        cluster has.  With "gpu" the number of launches in flight, by default 3.
    store
        Folder on disk that keeps the results, chunk by chunk: a path for a new one, or a `Store`,
        which has more options.  Without one they are kept in memory.
    progress
        Called in the calling thread, first with the number of cells that are done already, when
        the first of the others is about to be computed; then with the number of those just
        finished.  The last call comes when all is kept.

    Raises
    ------
    InputError
        If there is no such executor, no scheduler can have that address, the client is not
        connected or asynchronous, or the number of workers is not a whole number from 1 to 1024.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Execution, map_attractors
    >>> cells = []
    >>> result = map_attractors(
    ...     DimensionlessBlock(restitution=0.8),
    ...     axes={"amplitude": [0.5, 2.0], "frequency_ratio": [1.0, 4.0, 8.0]},
    ...     run=Execution(executor="serial", progress=cells.append),
    ... )
    >>> sum(cells)
    6
    >>> Execution(workers=0)
    Traceback (most recent call last):
        ...
    rocksteady.errors.InputError: workers = 0 is not valid: ...
    """

    executor: Annotated["str | Client", validated_executor, INSIDE] = "threads"
    workers: Annotated[int | None, WORKERS] = None
    store: Store | Path | str | None = None
    progress: Progress | None = None

    @property
    def place(self) -> Store | None:
        """The store as a `Store`; None for memory."""
        if self.store is None or isinstance(self.store, Store):
            return self.store
        return Store(self.store)

    def in_memory(self, reason: str) -> "Execution":
        """Return the run itself, after refusing a store that a function cannot fill.

        Parameters
        ----------
        reason
            Why there can be no store, as "a drop is kept in memory".

        Raises
        ------
        ModelError
            If it has a store.
        """
        if self.store is not None:
            raise ModelError("run", Words("has a store"), reason, "give a Run without one")
        return self
