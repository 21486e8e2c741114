"""Sums against exact fractions, and triangular roots against NumPy's linear algebra."""

from fractions import Fraction

import numpy as np
import pytest
from scipy import special

from rocksteady.risk.calibration.sampler import exact


def test_products_of_rounded_factors_are_exact_in_any_order() -> None:
    rng = np.random.default_rng(1)
    left = exact.rounded(rng.normal(size=(7, 900)), 20)
    right = exact.rounded(rng.random((900, 5)), 22)
    whole, order = left @ right, rng.permutation(900)
    assert (left[:, order] @ right[order] == whole).all()
    assert (left[:, :333] @ right[:333] + left[:, 333:] @ right[333:] == whole).all()
    terms = [Fraction(a) * Fraction(b) for a, b in zip(left[3], right[:, 2], strict=True)]
    assert Fraction(whole[3, 2]) == sum(terms)
    rounds = exact.rounded(np.array([0.3, -0.3, 0.126, 5.0]), 3)
    assert rounds.tolist() == [0.25, -0.25, 0.125, 5.0]


def test_sums_of_exponentials_are_those_of_scipy() -> None:
    logs = np.random.default_rng(2).normal(-700.0, 9.0, size=(4, 3, 50))
    assert exact.log_sum_exp(logs) == pytest.approx(special.logsumexp(logs, axis=-1), abs=1e-9)
    assert exact.softmax(logs) == pytest.approx(special.softmax(logs), abs=1e-10)
    weights = np.random.default_rng(3).random(400)
    expected = weights.sum() ** 2 / np.square(weights).sum()
    assert exact.effective(weights) == pytest.approx(expected, rel=1e-9)


def test_roots_and_solutions_are_those_of_linear_algebra() -> None:
    rng = np.random.default_rng(4)
    parts = rng.normal(size=(9, 6, 6))
    matrices = parts @ parts.transpose(0, 2, 1) + 0.1 * np.eye(6)
    root = exact.cholesky(np.ascontiguousarray(matrices.transpose(1, 2, 0)))
    np.testing.assert_allclose(root.transpose(2, 0, 1), np.linalg.cholesky(matrices), atol=1e-12)
    right, inverse = rng.normal(size=(6, 9)), np.linalg.inv(matrices)
    expected = (inverse @ right.T[:, :, np.newaxis])[:, :, 0].T
    np.testing.assert_allclose(exact.solve(root, right), expected, rtol=1e-8)
    diagonal = inverse[:, np.arange(6), np.arange(6)].T
    np.testing.assert_allclose(exact.inverse_diagonal(root), diagonal, rtol=1e-9)
