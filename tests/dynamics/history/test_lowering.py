"""Which block sides are of."""

from rocksteady import DimensionlessBlock, Linear
from rocksteady.dynamics.history.lowering import only_side


def test_the_one_side_of_a_block_against_a_wall_is_named_by_its_sign() -> None:
    free, leaning = (
        Linear().sides(DimensionlessBlock(restitution=0.6, one_sided=wall))
        for wall in (False, True)
    )
    assert (only_side(free), only_side(leaning), only_side(leaning[::-1])) == (0, 1, -1)
