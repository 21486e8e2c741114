"""Certificates as results and as files."""

import json
from pathlib import Path

import pytest

from rocksteady.certify.certificate import attempts, harmonic_numbers, ladder, meaning
from rocksteady.certify.chaos import certify_chaos
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


def test_what_is_not_proved_has_no_file(tmp_path: Path) -> None:
    undecided = certify_chaos(0.4, 2, 0.8)
    with pytest.raises(ModelError, match="is undecided"):
        undecided.save(tmp_path / "none.json")
    assert not list(tmp_path.iterdir())
    proved = certify_chaos(0.6, 2, 0.8)
    proved.save(tmp_path / "some.json")
    values = json.loads((tmp_path / "some.json").read_text(encoding="utf-8"))
    assert values["format"] == "rocking-certificate/1"
    assert values["model"]["amplitude"][0] == "0.6"
