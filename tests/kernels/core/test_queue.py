"""Queue of cells: every cell is taken once, in its order, and workers are numbered."""

import numpy as np

from rocksteady.kernels.core.queue import HEAD, LEFT_OVER, add_one, enter, queue_of, take
from rocksteady.outcomes import Status


def test_a_queue_holds_its_cells_in_their_natural_order() -> None:
    queue = queue_of(5)
    assert queue.dtype == np.int64
    np.testing.assert_array_equal(queue, [0, 0, 0, 1, 2, 3, 4])


def test_each_cell_is_taken_once_and_none_after_the_last() -> None:
    queue = queue_of(4)
    queue[HEAD:] = [2, 0, 3, 1]
    assert [take(queue) for _ in range(7)] == [2, 0, 3, 1, -1, -1, -1]
    np.testing.assert_array_equal(queue[HEAD:], [2, 0, 3, 1])


def test_no_cell_is_taken_from_an_empty_queue() -> None:
    assert take(queue_of(0)) == -1


def test_workers_are_numbered_from_zero_whatever_has_been_taken() -> None:
    queue = queue_of(2)
    assert enter(queue) == 0
    take(queue)
    assert [enter(queue), enter(queue)] == [1, 2]
    assert take(queue) == 1


def test_adding_one_returns_what_was_there_before() -> None:
    queue = queue_of(3)
    assert add_one(queue, HEAD) == 0
    assert queue[HEAD] == 1


def test_no_status_is_that_of_a_cell_that_is_left_over() -> None:
    assert LEFT_OVER == -1
    assert LEFT_OVER not in {int(status) for status in Status}
