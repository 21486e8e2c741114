"""Words of fragility: what never lifts, and the half of a state."""

import json

import numpy as np

from rocksteady import Record, run_ensemble
from rocksteady.risk import Levels, Ways, count_fragility
from tests.risk.fragility.test_fragility import BLOCK, ONE
from tests.risk.fragility.test_state_fragility import state_of


def test_motions_that_never_lift_it_are_counted_and_have_no_infinite_number() -> None:
    """Against a wall, under a base that only moves towards it."""
    push = [Record(acceleration_m_s2=np.array([0.0, -2.0 - k, 0.0]), dt_s=0.1) for k in range(12)]
    runs = run_ensemble(
        BLOCK.against_wall(0.4), push, levels=Levels("pga_g", [0.5, 1.0], beside=()),
        restitution=ONE, ways=Ways(reverse=False),
    )  # fmt: skip
    found = count_fragility(runs)
    assert (np.array([each.curve.shares for each in found.states]) == 0.0).all()
    assert found.state("uplift").half is None
    values = json.loads(json.dumps(found.to_dict(), allow_nan=False))
    assert values["uplift_level"] is None
    assert "inf" not in found.summary()


def test_a_state_is_described_by_its_half() -> None:
    assert "half at 0.566 g" in state_of([0, 25, 75, 100]).describe().headline
    assert "not half at any level" in state_of([0, 25]).describe().headline
