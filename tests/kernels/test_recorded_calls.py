"""Kernels that run as plain Python repeat the shipped calls bit for bit.

Compiled ones are compared with the same calls in `tests/installation/test_check.py`.
"""

import pytest

from rocksteady.installation._recorded import Call, loaded
from rocksteady.installation.check import RECORDED, replay
from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.march.march import march

CALLS = loaded(RECORDED.read_bytes())
NAMES = [f"{number}-{call.entry}" for number, call in enumerate(CALLS)]


def test_a_kernel_is_the_plain_function() -> None:
    assert type(march).__name__ == "function"


@pytest.mark.parametrize("call", CALLS, ids=NAMES)
def test_each_shipped_call_is_repeated_bit_for_bit(call: Call) -> None:
    (found,) = replay([call], ENTRIES)
    assert found.first_difference is None
    assert found.values > 0
