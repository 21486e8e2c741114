"""The device of a thread."""

import threading
from typing import Any

import pytest

from rocksteady.kernels.machine_code.device import current_device, on_device


class Nothing:
    """A device that does nothing."""

    def run(self, form: Any, arguments: tuple[Any, ...]) -> None:
        """Do nothing."""


def test_a_device_is_that_of_one_thread_until_the_end() -> None:
    outer, inner = Nothing(), Nothing()
    others: list[object] = []
    assert current_device() is None
    with on_device(outer):
        with pytest.raises(KeyError), on_device(inner):
            raise KeyError(current_device() is inner)
        assert current_device() is outer
        thread = threading.Thread(target=lambda: others.append(current_device()))
        thread.start()
        thread.join()
    assert current_device() is None
    assert others == [None]
