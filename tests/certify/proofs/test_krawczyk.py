"""Zeros enclosed: of a quadratic with known ones, and none where there is none."""

from flint import arb

from rocksteady.certify.proofs._balls import precision
from rocksteady.certify.proofs._krawczyk import enclose


def circle_and_line(unknowns: list[arb]) -> tuple[list[arb], list[list[arb]]]:
    """x^2 + y^2 = 4 and x = y."""
    x, y = unknowns
    return [x * x + y * y - 4, x - y], [[2 * x, 2 * y], [arb(1), arb(-1)]]


def test_a_zero_is_enclosed_to_the_precision_and_alone_in_a_wide_box() -> None:
    for bits in (64, 256):
        with precision(bits):
            zero = enclose(circle_and_line, [arb(1.4), arb(1.5)])
            assert zero is not None
            assert zero.box[0].contains(arb(2).sqrt().mid())
            assert zero.box[0].rad() < arb(2) ** (12 - bits)
            assert zero.alone == 0.25


def test_where_there_is_no_zero_or_a_double_one_there_is_no_proof() -> None:
    with precision(64):
        assert enclose(lambda x: ([x[0] * x[0] + 1], [[2 * x[0]]]), [arb(0.3)]) is None
        assert enclose(lambda x: ([x[0] * x[0]], [[2 * x[0]]]), [arb(0)]) is None
