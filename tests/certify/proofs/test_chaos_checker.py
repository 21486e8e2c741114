"""The program for chaos: no tampered set of boxes or chain of coverings holds."""

import copy
import json
from typing import Any

import pytest

from rocksteady.certify.proofs.chaos import certify_chaos
from tests.certify.proofs.test_checker import verdict
from tests.every import every


@every(
    "change",
    [
        {"phases": ["0.5", "2.64832"]},  # no hilltop
        {"phases": ["2.64832", "2.64832"]},  # one symbol twice
        {"least_half_periods": 1},
        {"least_half_periods": 4},
        {"claim": {"entropy_per_period": "0.85"}},
        {"radius": "0.5"},  # boxes that overlap
        {"kind": "orbit"},
        {"format": "other"},
    ],
)
def test_tampered_horseshoes_do_not_hold(change: dict[str, Any]) -> None:
    values = json.loads(certify_chaos(0.6, 2, 0.8).to_json())
    assert verdict(values) == "holds"
    if "phases" in change:
        change = {"phases": [change["phases"][0], values["phases"][1]]}
        if change["phases"][0] == "2.64832":
            change = {"phases": [values["phases"][1]] * 2}
    assert verdict(values | change) != "holds"


@pytest.mark.slow
def test_tampered_chains_of_coverings_do_not_hold() -> None:
    values = json.loads(certify_chaos(2.698, 2, 0.8, kind="homoclinic").to_json())
    assert verdict(values) == "holds"
    for k, entry, change in ((0, 2, "0.0000001"), (5, 0, "2.5"), (7, 5, "0.5")):
        frames = copy.deepcopy(values["frames"])
        frames[k][entry] = change
        assert verdict(values | {"frames": frames}) != "holds"
    claim = {"entropy_per_period": "0.3"}
    assert verdict(values | {"claim": claim}).startswith("refused")
    assert verdict(values | {"frames": values["frames"][:-1]}) != "holds"
