"""Moments of errors and gains against sums over their grids written out."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rocksteady.risk.calibration.sampler.moments import error_moments, session_moments
from tests.risk.calibration.toys import FEATURES, Known, make_toy

SESSIONS = ("a", "a", "a", "b", "c", "b")


def fit_of(fell: tuple[bool | None, ...], sessions: tuple[str, ...] = SESSIONS) -> Any:
    """Return what moments need of a fit of nine draws."""
    toy = make_toy(sessions, fell)
    return SimpleNamespace(
        likelihood=toy,
        cells=toy.cells(Known(), FEATURES, np.arange(6)),
        features=FEATURES,
        surfaces=Known(),
        values=FEATURES,
        weights=np.full(9, 1.0 / 9.0),
    )


def test_outcomes_weigh_the_nodes_of_the_grid() -> None:
    fit = fit_of((True, True, True, False, None, False))
    like = fit.likelihood
    shares = np.exp(fit.cells + like.grid)
    shares /= shares.sum(axis=(1, 2, 3), keepdims=True)
    errors, gains = error_moments(fit), session_moments(fit)
    for name, axis, nodes in (("sigma_ln", 1, like.sigma), ("session_ln", 2, like.between)):
        of_node = shares.sum(axis=tuple({1, 2, 3} - {axis}))
        mean = of_node @ nodes
        assert errors[name][:, 0] == pytest.approx(mean, rel=1e-6)
        square = of_node @ nodes**2 - mean**2
        prior = getattr(like.noise, name)  # a node stands for its part of the prior
        square += ((prior.high - prior.low) / len(nodes)) ** 2 / 12.0
        assert errors[name][:, 1] == pytest.approx(np.sqrt(square), rel=1e-4)
    # Session "a" fell in all three tests and "b" in none: of a middle draw one was strong.
    assert gains["a"][4, 0] > 0.05 > -0.05 > gains["b"][4, 0]
    assert gains["c"][:, 0] == pytest.approx(np.zeros(9), abs=1e-6)
    assert (gains["a"][:, 1] < gains["c"][:, 1]).all()
    assert session_moments(fit_of((True,) * 6, ("a",) * 6)) == {}
