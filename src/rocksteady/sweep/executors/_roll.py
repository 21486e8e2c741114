"""Who has come to work."""

from distributed import Scheduler, SchedulerPlugin


class Roll(SchedulerPlugin):
    """Notes the workers that join a scheduler in this process.

    Parameters
    ----------
    processes
        Their process ids: what is added to.
    """

    def __init__(self, processes: set[int]) -> None:
        self._processes = processes

    def add_worker(self, scheduler: Scheduler, worker: str) -> None:
        """Note one, by its address."""
        self._processes.add(scheduler.workers[worker].pid)
