"""Files of certificates checked."""

from pathlib import Path

import pytest

from rocksteady.certify.chaos import certify_chaos
from rocksteady.certify.fate import certify_fate
from rocksteady.certify.files import check_certificate
from rocksteady.certify.region import certify_region
from rocksteady.errors import InputError
from tests.certify.test_fate import BLOCK, synthetic


def test_each_kind_is_checked_by_its_program(tmp_path: Path) -> None:
    file = tmp_path / "certificate.json"
    file.write_text(certify_chaos(0.6, 2, 0.8).to_json(), encoding="utf-8")
    assert check_certificate(file).holds
    file.write_text(
        certify_region((1.9, 2.1), (1.9, 2.1), 0.8, most_boxes=500).to_json(), encoding="utf-8"
    )
    assert check_certificate(file, leaves=50).holds
    fate = certify_fate(BLOCK, synthetic(1, 6.0, samples=801))
    file.write_text(fate.to_json(), encoding="utf-8")
    assert check_certificate(file, accelerations_m_s2=fate.samples).holds
    assert check_certificate(file).verdict == "refused"


def test_what_is_no_certificate_is_bad_input(tmp_path: Path) -> None:
    file = tmp_path / "other.json"
    file.write_text("[1, 2]", encoding="utf-8")
    with pytest.raises(InputError, match="cannot be read as the JSON of a certificate"):
        check_certificate(file)
    with pytest.raises(InputError, match="give arb or iv"):
        check_certificate(file, arithmetic="float")
