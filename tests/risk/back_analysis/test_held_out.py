"""Records left out in turn: simulated surveys, what covers a share of truths, and temper."""

import math
from dataclasses import replace
from typing import Literal

import numpy as np
import pytest

from rocksteady.calibration import ScanOptions
from rocksteady.risk.back_analysis._density import Plane
from rocksteady.risk.back_analysis._held_out import _covering, _surveys, hold_out, unchecked
from tests.every import every


@every(("count", "place"), [(9, 9), (19, 18), (20, 19), (99, 90), (3, 3), (1, 1)])
def test_a_share_covers_as_conformal_prediction_counts(count: int, place: int) -> None:
    """The ceil(0.9 (n + 1))-th smallest, the largest where there are too few."""
    shares = np.random.default_rng(0).permutation(np.arange(1, count + 1) / (count + 1.0))
    assert _covering(shares) == pytest.approx(place / (count + 1.0))
    assert _covering(np.ones(count)) == 0.999


def test_surveys_are_drawn_under_each_record_where_it_agrees_with_the_real_one() -> None:
    """Two records: one agrees at its third node under the second sign, one at two nodes alike."""
    logs = np.full((2, 2, 4), -1e9)
    logs[1, 0, 2] = -7.0
    logs[0, 1, 1] = logs[0, 1, 3] = -90.0
    chance = np.full((4, 2, 2, 4), 0.5)
    chance[0], chance[1] = 1.0, 0.0
    chance[3, 1], chance[3, 0] = 1.0, 0.0
    record, node, fell = _surveys(logs, chance, 200, np.random.default_rng(1))
    assert record.tolist() == [0] * 200 + [1] * 200
    assert (node[:200] == 2).all()
    assert set(node[200:].tolist()) == {1, 3}
    assert (node[200:] == 1).mean() == pytest.approx(0.5, abs=0.12)
    assert (fell[:, 0] == 1.0).all()
    assert (fell[:, 1] == 0.0).all()
    assert fell[:, 2].mean() == pytest.approx(0.5, abs=0.08)
    # The last object falls under the second sign alone.
    assert fell[:, 3].tolist() == [1.0] * 200 + [0.0] * 200


def test_surveys_of_one_kind_of_outcome_are_drawn_again_or_left_out() -> None:
    logs = np.zeros((1, 2, 3))
    rare = np.full((2, 1, 2, 3), 0.1)
    record, _, fell = _surveys(logs, rare, 50, np.random.default_rng(2))
    assert set(fell.sum(axis=1).tolist()) == {1.0}
    assert len(record) == 100  # one in 5.6 has both kinds, and there are fifty draws
    for certain in (0.0, 1.0):
        sure = np.full((2, 1, 2, 3), certain)
        record, node, fell = _surveys(logs, sure, 5, np.random.default_rng(2))
        assert len(record) == len(node) == len(fell) == 0


def plane() -> Plane:
    ratios = np.stack([np.zeros(6), np.linspace(-0.4, 0.4, 6)], axis=1)
    return Plane(nodes=np.linspace(-1.5, 1.0, 26), ratios=ratios)


def test_where_no_survey_can_be_drawn_nothing_is_checked() -> None:
    logs, chance = np.zeros((1, 6, 26)), np.ones((2, 1, 6, 26))
    tempers: tuple[tuple[float | Literal["auto"], float], ...] = (("auto", 1.0), (0.3, 0.3))
    for temper, taken in tempers:
        scan = ScanOptions(temper=temper, trials=2)
        none = hold_out(logs, 0.5 * chance, plane(), ScanOptions(temper=taken, trials=0))
        for each in (hold_out(logs, chance, plane(), scan), unchecked(plane(), scan), none):
            assert (each.temper, each.share, each.surveys, each.scores) == (taken, 0.9, 0, {})
            assert each.tails.tolist() == [0.9, 0.9]
            assert math.isnan(each.plain_coverage)


def test_objects_that_obey_the_model_need_no_temper_and_a_region_of_about_the_confidence() -> None:
    """Thresholds with a known error under every record: the likelihood is the right one."""
    x = plane().nodes
    thresholds = np.linspace(-1.0, 0.6, 8)
    chance = 1.0 / (1.0 + np.exp(-(x - thresholds[:, np.newaxis]) / 0.25))
    chance = np.broadcast_to(chance[:, np.newaxis, np.newaxis], (8, 1, 6, 26))
    fell = (thresholds < -0.2).astype(float)
    logs = (
        fell @ np.log(chance.reshape(8, -1)) + (1.0 - fell) @ np.log1p(-chance.reshape(8, -1))
    ).reshape(1, 6, 26)
    scan = ScanOptions(trials=30, seed=4)
    found = hold_out(logs, chance, plane(), scan)
    assert found.surveys > 150
    assert found.temper >= 0.7
    assert found.temper == max(found.scores, key=lambda value: found.scores[value])
    assert 0.75 < found.plain_coverage <= 1.0
    assert 0.7 < found.share < 0.97
    assert ((found.tails > 0.6) & (found.tails < 0.999)).all()
    fixed = hold_out(logs, chance, plane(), replace(scan, temper=found.temper))
    assert list(fixed.scores) == [found.temper]
    assert fixed.scores[found.temper] == found.scores[found.temper]
    assert (fixed.share, fixed.tails.tolist()) == (found.share, found.tails.tolist())
    flat = hold_out(logs, chance, plane(), replace(scan, temper=0.05))
    assert flat.scores[0.05] < found.scores[found.temper]
