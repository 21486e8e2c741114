"""What calls kernels and keeps records of the calls."""

from collections.abc import Callable
from typing import Any

from rocksteady.installation._recorded import Call, recorded


class Recorder:
    """Calls kernels by their names, and keeps a record of each call.

    Parameters
    ----------
    entries
        The kernels that Python calls, by name.

    Attributes
    ----------
    calls
        The records, in order.
    """

    def __init__(self, entries: dict[str, Callable[..., Any]]) -> None:
        self._entries = entries
        self.calls: list[Call] = []

    def __call__(self, entry: str, *arguments: Any) -> Any:
        """Call a kernel, keep the record, and return the result."""
        call, result = recorded(entry, self._entries[entry], arguments)
        self.calls.append(call)
        return result

    def quietly(self, entry: str, *arguments: Any) -> Any:
        """Call a kernel and return the result, without a record."""
        return recorded(entry, self._entries[entry], arguments)[1]
