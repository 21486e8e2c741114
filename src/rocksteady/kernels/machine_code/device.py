"""The device that takes over calls of kernels in a thread: a GPU, or an emulation of it."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, Protocol


class Form(Protocol):
    """How the work of a host kernel is done on a device."""

    @property
    def queued(self) -> Callable[..., None]:
        """Kernel that a worker calls once: takes (queue, *room, *shared, *arguments)."""
        ...

    @property
    def room(self) -> tuple[tuple[int, ...], ...]:
        """Shapes of the scratch arrays of one worker; nothing is known of what they hold."""
        ...

    @property
    def shared(self) -> Callable[..., tuple[Any, ...]] | None:
        """Returns, of the arguments, arrays that all workers read; None where there are none."""
        ...

    @property
    def length(self) -> Callable[..., Any] | None:
        """Returns, of the arguments, the expected length of each cell, shape (cells,)."""
        ...


class Device(Protocol):
    """What runs kernels in place of the processor."""

    def run(self, form: Form, arguments: tuple[Any, ...]) -> None:
        """Do the work of a host kernel.

        Parameters
        ----------
        form
            How it is done there.
        arguments
            Those of the host kernel; the last one receives the results.

        Raises
        ------
        DeviceMemoryError
            If the device has no memory for so many cells.
        UnfinishedError
            If the device fails.
        """
        ...


class DeviceMemoryError(MemoryError):
    """A device has no memory for so many cells; it can be called again with fewer.

    Parameters
    ----------
    device
        Name of the device.
    """

    def __init__(self, device: str) -> None:
        super().__init__(f"the memory of {device} does not suffice")
        self.device = device


def cells_in(arguments: tuple[Any, ...]) -> int:
    """Return the number of cells of a call of a host kernel.

    Its last argument is a tuple of arrays that receive the results, the first of them one value a
    cell.
    """
    return len(arguments[-1][0])


_current: ContextVar[Device | None] = ContextVar("device", default=None)


def current_device() -> Device | None:
    """Return the device of this thread; None where kernels run on the processor."""
    return _current.get()


@contextmanager
def on_device(device: Device) -> Iterator[None]:
    """Have a device run the kernels that this thread calls and that have a form for it."""
    token = _current.set(device)
    try:
        yield
    finally:
        _current.reset(token)
