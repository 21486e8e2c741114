"""Certificates as results and as files."""

import json

import pytest

from rocksteady.certify.proofs.certificate import attempts, harmonic_numbers, ladder, meaning
from rocksteady.certify.proofs.chaos import certify_chaos
from rocksteady.errors import ModelError


def test_doubles_are_tried_first_and_the_decimals_alone_after_them() -> None:
    numbers = harmonic_numbers(2, 2, "0.8")
    tried = list(attempts(numbers, 512))
    assert [bits for bits, _ in tried] == [64, 128, 64, 128, 256, 512]
    assert len(tried[0][1]["restitution"]) == 2
    assert len(tried[-1][1]["restitution"]) == 1
    assert ladder(100) == [64, 100]
    exact = harmonic_numbers(2, 2, 0.5)
    assert [bits for bits, _ in attempts(exact, 128)] == [64, 128]
    assert meaning(exact) == "the decimals as they are written"


def test_what_is_not_proved_has_no_file() -> None:
    undecided = certify_chaos(0.4, 2, 0.8)
    with pytest.raises(ModelError, match="is undecided"):
        undecided.to_json()
    values = json.loads(certify_chaos(0.6, 2, 0.8).to_json())
    assert values["format"] == "rocking-certificate/1"
    assert values["model"]["amplitude"][0] == "0.6"
