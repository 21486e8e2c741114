"""Files of certificates checked."""

import json
from pathlib import Path
from typing import Any

import pytest

from rocksteady.certify.proofs.chaos import certify_chaos
from rocksteady.certify.proofs.fate import certify_fate
from rocksteady.certify.proofs.files import check_certificate
from rocksteady.certify.proofs.region import certify_region
from rocksteady.errors import InputError
from rocksteady.model.motions.pulses import Pulse
from tests.certify.proofs.test_fate import BARE, BLOCK, synthetic
from tests.every import every


def test_each_kind_is_checked_by_its_program(tmp_path: Path) -> None:
    file = tmp_path / "certificate.json"
    file.write_text(certify_chaos(0.6, 2, 0.8).to_json(), encoding="utf-8")
    assert check_certificate(file).holds
    file.write_text(
        certify_region((1.9, 2.1), (1.9, 2.1), 0.8, most_boxes=500).to_json(), encoding="utf-8"
    )
    assert check_certificate(file, leaves=None).holds
    sampled = check_certificate(file, leaves=50)
    assert (sampled.verdict, sampled.holds) == ("sampled", False)
    assert "claimed on" in sampled.claim
    assert "% of the area that it claims" in sampled.coverage
    fate = certify_fate(BLOCK, synthetic(1, 6.0, samples=801), model="linear")
    file.write_text(fate.to_json(), encoding="utf-8")
    assert check_certificate(file, accelerations_m_s2=fate.samples).holds
    assert check_certificate(file).verdict == "refused"


def test_what_is_no_certificate_is_bad_input(tmp_path: Path) -> None:
    file = tmp_path / "other.json"
    file.write_text("[1, 2]", encoding="utf-8")
    with pytest.raises(InputError, match="cannot be read as the JSON of a certificate"):
        check_certificate(file)
    with pytest.raises(InputError, match="'arb' or 'iv'"):
        check_certificate(file, arithmetic="float")  # type: ignore[arg-type]


BOMBS = ("1e99999999", "1e-99999999", "1E+1_000_000_00", "9" * 10_000)
"""Texts of numbers that would take minutes, or all memory, to be made."""


@every("text", BOMBS)
def test_a_number_of_too_many_digits_is_refused_at_once(text: str, tmp_path: Path) -> None:
    file = tmp_path / "certificate.json"
    chaos = json.loads(certify_chaos(0.6, 2, 0.8).to_json())
    pulse = Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=2.0)
    fate = json.loads(certify_fate(BARE, pulse).to_json())
    changes: tuple[dict[str, Any], ...] = (
        chaos | {"radius": text},
        chaos | {"claim": {"entropy_per_period": text}},
        chaos | {"model": chaos["model"] | {"amplitude": [text]}},
        fate | {"model": fate["model"] | {"amplitude": [text]}},
    )
    for values in changes:
        file.write_text(json.dumps(values), encoding="utf-8")
        for arithmetic in ("arb", "iv"):
            assert check_certificate(file, arithmetic=arithmetic).verdict == "refused"
    with pytest.raises(InputError, match="it must be a finite number"):
        certify_chaos(text, 2, 0.8)


def test_a_file_of_many_brackets_is_no_certificate(tmp_path: Path) -> None:
    file = tmp_path / "deep.json"
    file.write_text("[" * 100_000 + "]" * 100_000, encoding="utf-8")
    with pytest.raises(InputError, match="cannot be read as the JSON of a certificate"):
        check_certificate(file)
