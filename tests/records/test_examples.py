"""Motions that ship: three characters, the same bits everywhere, refused options and names."""

import hashlib
from pathlib import Path

import pytest

from rocksteady import Block, compute_measures, read_record, simulate
from rocksteady.errors import InputError, RecordFileError
from rocksteady.records import read_recordings
from rocksteady.records.examples import EXAMPLES, PREFIX
from tests.every import every

BITS = {
    "near-fault": "33ffcc0179b585dd803be1183baa66b583e89e7efd21cff59395570f289bec9e",
    "firm-ground": "58fc66c5a6a9dc225aab2a5a11e90311d9f67a451d79c4bf8e65769607691f1b",
    "soft-soil": "015367095c8fb730ba38fd1aad34a1552491657c71e17db402d12d5390d2db40",
}
"""SHA-256 of the samples."""


@every("name", EXAMPLES)
def test_an_example_is_the_same_to_the_bit_and_is_named_synthetic(name: str) -> None:
    (recording,) = read_recordings(PREFIX + name)
    record = recording.record
    assert hashlib.sha256(record.acceleration_m_s2.tobytes()).hexdigest() == BITS[name]
    measures = compute_measures(record)
    assert measures.pga_g == pytest.approx(EXAMPLES[name].pga_g, rel=1e-15)
    assert not measures.drifts
    for words in (record.name, recording.event, *recording.processing):
        assert words is not None
        assert "synthetic" in words


def test_three_characters() -> None:
    block = Block.rectangle(width=0.6, height=2.0)
    near, firm, soft = (read_record(PREFIX + name) for name in EXAMPLES)
    assert simulate(block, near).status == "overturned"
    assert simulate(block, firm).peak < 0.2
    assert 0.6 < simulate(block, soft).peak < 1.0
    strong = [compute_measures(each).significant_5_95_s for each in (firm, near, soft)]
    assert strong == sorted(strong)
    assert compute_measures(firm).mean_period_s < 0.3
    assert compute_measures(soft).mean_period_s > 1.0


def test_a_name_is_always_that_of_the_example(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "example:soft-soil"
    file.write_text("t,acc (g)\n0,.1\n.01,-.2\n.02,.1\n")
    assert len(read_record("example:soft-soil").acceleration_m_s2) == 1001
    assert len(read_record(file).acceleration_m_s2) == 3


def test_refusals() -> None:
    for unknown in ("example:", "example:soft"):
        with pytest.raises(RecordFileError, match="example:near-fault, example:firm-ground, exam"):
            read_record(unknown)
    for options in (
        {"units": "g"},
        {"dt_s": 0.01},
        {"resample": True},
        {"format": "csv"},
        {"ignore_header": True},
    ):
        with pytest.raises(InputError, match=rf"{next(iter(options))} = .*is no file; leave it"):
            read_recordings("example:soft-soil", **options)
