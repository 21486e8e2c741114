"""Calls in processes of their own: their order, where they run, and one that ends its process."""

import os
from collections.abc import Callable
from functools import partial

import pytest

from rocksteady.errors import UnfinishedError
from rocksteady.studies.processes import in_processes


def test_answers_come_in_the_order_of_their_calls() -> None:
    calls = [partial(divmod, number, 3) for number in range(7)]
    for processes in (1, 2):
        assert list(in_processes(calls, processes)) == [divmod(n, 3) for n in range(7)]


def test_one_process_is_this_one_and_several_are_others() -> None:
    assert set(in_processes([os.getpid] * 3, 1)) == {os.getpid()}
    assert set(in_processes([os.getpid], 2)) == {os.getpid()}, "one call needs no other process"
    others = set(in_processes([os.getpid] * 6, 2))
    assert os.getpid() not in others
    assert 1 <= len(others) <= 2


def test_what_a_call_prints_is_no_answer(capfd: pytest.CaptureFixture[str]) -> None:
    assert list(in_processes([partial(print, "said")] * 2, 2)) == [None] * 2
    assert capfd.readouterr() == ("", "said\nsaid\n")


def test_a_call_that_ends_its_process_ends_the_others() -> None:
    calls: list[Callable[[], int]] = [os.getpid, partial(os._exit, 3), *[os.getpid] * 9]
    answers = in_processes(calls, 2)
    next(answers)
    with pytest.raises(UnfinishedError, match="ended, with status 3"):
        list(answers)
