"""The standalone program of fates: with its samples, and no false fate passes."""

import json
from typing import Any

import numpy as np
from flint import arb

import rocksteady as rs
from rocksteady.certify.proofs import fate_checker
from rocksteady.certify.proofs._balls import hull, precision
from rocksteady.certify.proofs.fate import certify_edges, certify_fate
from tests.certify.proofs.test_fate import BARE, BLOCK, synthetic


def verdict(
    values: dict[str, Any], samples: list[float], arithmetic: Any = fate_checker.arb
) -> str:
    with precision(64):
        return str(fate_checker.check(json.dumps(values), arithmetic, samples))


def test_the_fate_of_a_record_holds_with_its_samples_alone() -> None:
    certificate = certify_fate(BLOCK, synthetic(1, 6.0, samples=1001), model="linear")
    values, samples = json.loads(certificate.to_json()), list(certificate.samples)
    assert verdict(values, samples) == "holds"
    samples[300] = np.nextafter(samples[300], 9.0)
    assert verdict(values, samples).startswith("refused")
    assert verdict(values, []).startswith("refused")


def test_false_fates_are_refused_in_both_arithmetics() -> None:
    for amplitude in (1.1, 2.0):
        pulse = rs.Pulse(shape="one-sine", amplitude=amplitude, frequency_ratio=2.0)
        values = json.loads(certify_fate(BARE, pulse).to_json())
        other = {"falls": "stands", "stands": "falls"}[values["claim"]["outcomes"][0]]
        for arithmetic in (fate_checker.arb, fate_checker.iv):
            assert verdict(values, [], arithmetic) == "holds"
            false = values | {"claim": {"outcomes": [other]}}
            assert verdict(false, [], arithmetic).startswith("refused")


def test_an_edge_that_is_moved_off_the_change_is_refused() -> None:
    pulse = rs.Pulse(shape="one-sine", amplitude=1.0, frequency_ratio=1.0)
    windows = rs.find_overturning_windows(BARE, pulse, [2.0], within=(1.0, 2.0))
    values = json.loads(certify_edges(windows, places=12)[0].to_json())
    assert verdict(values, []) == "holds"
    assert verdict(values | {"between": ["1.3", "1.4"]}, []).startswith("refused")


def test_the_first_zero_is_the_first_and_a_touch_is_undecided() -> None:
    with precision(64):
        arithmetic = fate_checker.arb(64)

        def curve(u: arb) -> list[arb]:
            return [(u - 1) * (u - 2) * (u - 3) * -1, -(3 * u * u - 12 * u + 11)]

        found = fate_checker.first_zero(arithmetic, curve, (arb(0), arb(4)))
        assert found.overlaps(arb(1))
        assert found.rad() < 1e-15
        above = fate_checker.first_zero(arithmetic, lambda u: [u + 1, arb(1) + 0 * u], (0, 4))
        assert above is None
        try:
            fate_checker.first_zero(
                arithmetic, lambda u: [(u - 1) * (u - 1), 2 * (u - 1)], (arb(0), hull(4, 4))
            )
        except ArithmeticError:
            return
        raise AssertionError
