"""Predictions of other tests against raw runs of the posterior."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rocksteady import Status
from rocksteady.calibration import Scatter, ShakingTest, compute_test_fates
from rocksteady.errors import InputError
from rocksteady.risk.calibration.stored_posterior import digest_of
from tests.risk.calibration.cases import LINEAR, narrow, narrow_tests


def share_of(test: ShakingTest, between: float) -> float:
    """Return the share of 4000 draws that fall, each at a gain with all errors of its own."""
    posterior, rng = narrow().posteriors["stone"], np.random.default_rng(3)
    picked = rng.choice(len(posterior.weights), 4000, p=posterior.weights)
    mean, deviation = np.zeros(4000), np.full(4000, between)
    if test.session is not None and test.session in posterior.sessions:
        mean, deviation = posterior.sessions[test.session][picked].T
    error = posterior.errors["sigma_ln"][picked, 0] if test.sigma_ln is None else test.sigma_ln
    gains = np.exp(mean + np.hypot(error, deviation) * rng.standard_normal(4000))
    block, values = posterior.space.block, posterior.values[picked]
    scatter, each = Scatter(block.scatter_of(values), seed=4), gains[np.newaxis, :, np.newaxis]
    blocks = block.blocks(values)
    fates = compute_test_fates(blocks, [test], gains=each, scatter=scatter, model=LINEAR)
    share = float((fates.status.values == Status.OVERTURNED).mean())
    outliers = float(posterior.errors["outliers"][picked, 0].mean())
    return (1.0 - outliers) * share + 0.5 * outliers


def test_a_new_test_is_predicted_as_raw_runs_of_the_posterior_fall() -> None:
    """In a known session, in a new one, in none, with a larger error."""
    test, posterior = narrow_tests().tests[20], narrow().posteriors["stone"]
    changes: list[dict[str, Any]] = [{}, {"session": "another day"}, {"session": None}]
    changes.append({"session": None, "sigma_ln": 0.6})
    new = [replace(test, name=f"{place}", **keys) for place, keys in enumerate(changes)]
    found = narrow().predict(new)
    assert found.held_out == (False,) * 4
    between = float(posterior.weights @ posterior.errors["session_ln"][:, 0])
    exact = [share_of(t, between if t.session == "another day" else 0.0) for t in new]
    assert found.block == pytest.approx(exact, abs=0.05)
    assert np.ptp(found.block) > 0.1
    assert (found.low < found.p).all()
    assert (found.p < found.high).all()
    stack, curve = narrow().validation.stack, narrow().validation.curve
    assert found.logistic == pytest.approx(np.full(4, curve.of(narrow().measures[[20]])[0]))
    assert found.p == pytest.approx(stack.of(found.block, found.logistic))


def test_a_training_test_is_predicted_without_its_group() -> None:
    known = narrow_tests().tests[5]
    weak = replace(known, name="weak", gain=0.01 * known.gain)
    row = narrow().predict([weak, known])
    assert row.held_out == (False, True)
    before = narrow().validation.predictions
    assert (row.p[1], row.block[1], row.low[1]) == (before.p[5], before.block[5], before.low[5])
    assert row.block[0] == pytest.approx(0.5 * 0.03, abs=0.01)  # nothing lifts: outliers alone
    assert row.mc_error[0] < 0.01
    # The outcome of a test changes nothing.
    other = narrow().predict([replace(known, fell=not known.fell)])
    assert (other.held_out, other.p[0]) == ((True,), row.p[1])


def test_all_that_decides_a_fate_is_in_its_hash() -> None:
    test = narrow_tests().tests[0]
    others: list[dict[str, Any]] = [{"gain": 2.0}, {"reversed": True}, {"sigma_ln": 0.2}]
    others += [{"transverse": test.record}, {"vertical": test.record}]
    assert len({digest_of(replace(test, **keys)) for keys in ({}, *others)}) == 6
    assert digest_of(replace(test, fell=None, name="other", session=None)) == digest_of(test)


def test_what_cannot_be_predicted_is_refused() -> None:
    for none in ([], 3.0, np.array(1.0), ["t1"]):
        with pytest.raises(InputError, match="tests"):
            narrow().predict(none)  # type: ignore[arg-type]
    stranger = replace(narrow_tests().tests[0], object="stranger", name="new")
    with pytest.raises(InputError, match=r"has 'stranger', the object of test 'new'"):
        narrow().predict([stranger])
