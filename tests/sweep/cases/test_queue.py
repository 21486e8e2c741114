"""The deal: every cell is handed out, and once only, whatever comes back."""

import random

from hypothesis import given
from hypothesis import strategies as st

from rocksteady.sweep.cases.queue import Deal
from rocksteady.sweep.cases.task import Answer, Piece


@given(
    lengths=st.lists(st.integers(1, 500), max_size=6),
    workers=st.integers(1, 5),
    batch=st.integers(1, 70),
    seed=st.integers(0, 100),
)
def test_every_cell_is_done_once(lengths: list[int], workers: int, batch: int, seed: int) -> None:
    draw = random.Random(seed)
    ranges: list[Piece] = []
    for length in lengths:
        first = (ranges[-1][1] if ranges else 0) + draw.choice([0, 3])
        ranges.append((first, first + length))
    deal = Deal(ranges, workers=workers, batch=batch)
    assert deal.left == sum(lengths)
    done: list[int] = []
    while (piece := deal.next()) is not None:
        stop = draw.randint(piece[0] + 1, piece[1])  # as far as the time lasted
        done += range(piece[0], stop)
        deal.rest_of(Answer(piece, stop, {}))
        assert any(first <= piece[0] and piece[1] <= last for first, last in ranges)
    assert deal.left == 0
    assert sorted(done) == [cell for first, stop in ranges for cell in range(first, stop)]


def test_pieces_become_smaller_so_that_all_finish_together() -> None:
    deal = Deal([(0, 100_000)], workers=4, batch=10)
    pieces = []
    while (piece := deal.next()) is not None:
        pieces.append(piece[1] - piece[0])
    assert pieces[0] == 100_000 // 16
    assert pieces == sorted(pieces, reverse=True)
    assert pieces[-10:-1] == [10] * 9


def test_what_was_not_done_comes_first() -> None:
    deal = Deal([(0, 10), (10, 20)], workers=1, batch=10)
    piece = deal.next()
    assert piece == (0, 10)
    deal.rest_of(Answer((0, 10), 4, {}))
    assert deal.next() == (4, 10)
