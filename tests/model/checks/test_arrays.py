"""Arrays as arguments: which numbers pass."""

import pytest

from rocksteady.model.checks.arrays import UnfitError, numeric_array


def test_whole_numbers_pass_that_an_array_of_them_can_hold() -> None:
    for fit, beyond in ((2**64 - 1, 2**64), (-(2**63), -(2**63) - 1)):
        assert numeric_array("x", fit) == fit
        with pytest.raises(UnfitError, match="2\\^63"):
            numeric_array("x", beyond)
