"""Sessions against sums by hand, and gains that are known."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rocksteady import Linear, Record, calibrate
from rocksteady.calibration import DrawOptions, ObjectPrior, Observations, ShakingTest
from rocksteady.errors import InputError
from rocksteady.risk.calibration._draw_runs import shared_runs
from rocksteady.risk.calibration._sessions import Sessions, session_nodes
from rocksteady.risk.calibration.held_out.folds import Evidence, hold_out


def evidence(tests: int = 8, draws: int = 5) -> Evidence:
    """Return random numbers in place of runs: two sessions, each of two groups or more."""
    rng = np.random.default_rng(7)
    gains, _, weight = session_nodes(np.full(draws, 0.2), 0.02)
    sessions = Sessions(
        names=("a", "b"),
        member=np.arange(tests) % 2,
        column=np.arange(tests),
        falls=rng.random((tests, draws, gains.shape[1])),
        gain=gains,
        weight=weight,
        outliers=np.full(draws, 0.03),
        fell=np.where(rng.random(tests) < 0.5, 1.0, 0.0),
    )
    logs, share = np.zeros((draws, tests)), np.full((draws, tests), 0.5)
    return Evidence(
        base=rng.normal(size=draws), log_likelihood=logs, share=share, tests=np.arange(tests),
        total=sessions.total(logs), sessions=sessions,
    )  # fmt: skip


def test_leaving_a_group_out_is_the_sum_over_all_that_is_not_known() -> None:
    made, codes = evidence(), np.array([0, 0, 0, 0, 1, 1, 2, 2])
    shared = made.sessions
    assert isinstance(shared, Sessions)
    prior = np.exp(shared.weight[0])
    p = 0.97 * shared.falls + 0.015
    likely = np.where(shared.fell[:, None, None] > 0.0, p, 1.0 - p)
    found = hold_out([made.by_groups(codes)], codes, 1.0).p
    for test in range(8):
        of_draw = np.exp(made.base)
        share = np.zeros(5)
        for draw in range(5):
            for session in (0, 1):
                kept = (shared.member == session) & (codes != codes[test])
                nodes = prior * likely[kept, draw].prod(axis=0)
                of_draw[draw] *= nodes.sum()
                if session == shared.member[test]:
                    share[draw] = (nodes @ p[test, draw]) / nodes.sum()
        assert found[test] == pytest.approx(of_draw @ share / of_draw.sum(), rel=1e-9)


def test_nodes_have_the_moments_of_their_laws() -> None:
    gains, ratios, weight = session_nodes(np.array([0.15]), 0.02)
    for row, deviation in zip(np.exp(weight), (0.0, 0.02), strict=True):
        assert row.sum() == pytest.approx(1.0)
        assert row @ gains[0] ** 2 == pytest.approx(0.15**2, rel=0.03)
        assert row @ ratios[0] ** 2 == pytest.approx(deviation**2, abs=1e-12)


def test_tests_of_one_motion_share_runs_and_others_do_not() -> None:
    record = Record(acceleration_m_s2=np.array([0.0, 3.0, -3.0, 0.0]), dt_s=0.1, name="r")
    first = ShakingTest(name="1", record=record, object="o", fell=True)
    tests = [
        first,
        replace(first, name="2", gain=1.02),
        replace(first, name="3", gain=2.0),
        replace(first, name="4", reversed=True),
        replace(first, name="5", fell=False, peak_rad=0.01, sigma_rad=0.01),
    ]
    made, motion, shift = shared_runs(tests)
    assert motion.tolist() == [0, 0, 1, 2, 3]
    assert len(made) == 4
    gains = [made[k].gain * math.exp(s) for k, s in zip(motion, shift, strict=True)]
    assert gains == pytest.approx([test.gain for test in tests], rel=1e-12)


def in_sessions(gains: dict[str, float], repeats: int = 12) -> Observations:
    """Return a block on pulses that overturn it above a level: sessions move the level."""
    t = 0.02 * np.arange(60)
    rng = np.random.default_rng(3)
    tests = []
    for name, gain in gains.items():
        for k in range(repeats):
            wave = np.sin(2.0 * np.pi * t / (0.8 + 0.05 * (k % 4)))
            record = Record(acceleration_m_s2=6.0 * wave, dt_s=0.02, name=f"pulse {k % 4}")
            level = float(rng.uniform(0.5, 2.0))
            tests.append(
                ShakingTest(
                    name=f"{name} {k}", record=record, object="o", gain=level,
                    session=name, fell=level * gain > 1.0,
                )
            )  # fmt: skip
    block = ObjectPrior(name="o", alpha_rad="0.2:0.5", p_rad_s="3:4")
    return Observations(tests=tests, objects={"o": block})


@pytest.mark.slow
def test_a_strong_session_has_the_larger_gain() -> None:
    tests = in_sessions({"weak": 0.7, "usual": 1.0, "strong": 1.4})
    found = calibrate(tests, sampling=DrawOptions(draws=400, gains=3, rounds=4), model=Linear())
    posterior = found.posteriors["o"]
    weak, usual, strong = (posterior.session_gain(name)[0] for name in posterior.sessions)
    assert weak < usual < strong
    assert "session_ln" in posterior.names
    new = [replace(tests.tests[0], name=f"new {name}", gain=1.0, session=name)
           for name in ("weak", "strong")]  # fmt: skip
    low, high = found.predict(new).p
    assert low < high


def test_a_session_of_one_test_is_refused() -> None:
    tests = in_sessions({"a": 1.0, "b": 1.0})
    lone = [replace(tests.tests[0], session="alone"), *tests.tests[1:]]
    with pytest.raises(InputError, match="alone"):
        calibrate(replace(tests, tests=lone), model=Linear())


def test_tests_of_no_session_count_by_their_own_likelihood() -> None:
    """The whole is theirs, and the sum over the nodes of each session beside it."""
    made = evidence()
    shared = made.sessions
    assert isinstance(shared, Sessions)
    mixed = replace(shared, member=np.array([-1, 1, 0, -1, 0, 1, -1, 1]))
    logs = np.random.default_rng(5).normal(size=(5, 8))
    p = 0.97 * mixed.falls + 0.015
    likely = np.where(mixed.fell[:, None, None] > 0.0, p, 1.0 - p)
    prior = np.exp(mixed.weight[0])
    expected = logs[:, [0, 3, 6]].sum(axis=1)
    for session in (0, 1):
        nodes = prior * likely[mixed.member == session].prod(axis=0)
        expected = expected + np.log(nodes.sum(axis=1))
    assert mixed.total(logs) == pytest.approx(expected, rel=1e-9)
    whole = replace(made, log_likelihood=logs, sessions=mixed)
    result = mixed.condition(whole, np.arange(8))
    assert result.total == pytest.approx(expected, rel=1e-9)
    assert (result.log_likelihood[:, [0, 3, 6]] == logs[:, [0, 3, 6]]).all()
    assert (result.share[:, [0, 3, 6]] == made.share[:, [0, 3, 6]]).all()
