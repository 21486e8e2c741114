"""The queue: every cell is in one finished job, whatever is put back."""

import random

from hypothesis import given
from hypothesis import strategies as st

from rocksteady.sweep.cases.queue import Queue
from rocksteady.sweep.cases.task import Answer, CellRange


@given(
    lengths=st.lists(st.integers(1, 500), max_size=6),
    workers=st.integers(1, 5),
    batch=st.integers(1, 70),
    seed=st.integers(0, 100),
)
def test_every_cell_is_done_once(lengths: list[int], workers: int, batch: int, seed: int) -> None:
    draw = random.Random(seed)
    ranges: list[CellRange] = []
    for length in lengths:
        first = (ranges[-1][1] if ranges else 0) + draw.choice([0, 3])
        ranges.append((first, first + length))
    queue = Queue(ranges, workers=workers, batch=batch)
    assert queue.left == sum(lengths)
    done: list[int] = []
    while (job := queue.next()) is not None:
        stop = draw.randint(job[0] + 1, job[1])  # as far as the time lasted
        done += range(job[0], stop)
        queue.put_back(Answer(job, stop, {}))
        assert any(first <= job[0] and job[1] <= last for first, last in ranges)
    assert queue.left == 0
    assert sorted(done) == [cell for first, stop in ranges for cell in range(first, stop)]


def test_jobs_become_smaller_so_that_all_workers_finish_together() -> None:
    queue = Queue([(0, 100_000)], workers=4, batch=10)
    sizes = []
    while (job := queue.next()) is not None:
        sizes.append(job[1] - job[0])
    assert sizes[0] == 100_000 // 16
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[-10:-1] == [10] * 9


def test_cells_that_were_not_computed_come_first() -> None:
    queue = Queue([(0, 10), (10, 20)], workers=1, batch=10)
    job = queue.next()
    assert job == (0, 10)
    queue.put_back(Answer((0, 10), 4, {}, 32))
    assert queue.many == 32
    assert queue.next() == (4, 10)
