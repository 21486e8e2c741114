"""Manifest of a run: hashes by hand, no folder, no date, the same twice."""

import hashlib
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady import BaseMotion, Block, Record, run_ensemble
from rocksteady.errors import InputError, OutputError
from rocksteady.export import make_manifest, write_manifest
from rocksteady.risk import Levels, RestitutionBand

SAMPLES = np.array([0.0, 1.5, -1.0, 0.0])
SHOCK = Record(acceleration_m_s2=SAMPLES, dt_s=0.3, name='sh"ock <&>\n波')


def test_a_record_has_the_hash_of_its_samples_and_a_file_of_its_bytes(tmp_path: Path) -> None:
    file = tmp_path / "in.AT2"
    file.write_bytes(b"abc")
    found = make_manifest([SHOCK, BaseMotion(SHOCK, SHOCK.scaled(0.5))], files=[file])
    by_hand = hashlib.sha256(struct.pack("<4d", *SAMPLES)).hexdigest()
    half = hashlib.sha256(struct.pack("<4d", *(0.5 * a for a in SAMPLES))).hexdigest()
    plain = {"name": SHOCK.name, "samples": 4, "dt_s": 0.3, "sha256": by_hand}
    first, second = found["records"]
    assert first == plain
    assert {key: second[key] for key in plain} == plain
    assert second["vertical"]["sha256"] == half
    of_abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"  # FIPS 180-2
    assert found["files"] == [{"name": "in.AT2", "bytes": 3, "sha256": of_abc}]


def test_one_bit_of_a_sample_changes_the_hash() -> None:
    other = Record(acceleration_m_s2=np.nextafter(SAMPLES, 2.0), dt_s=0.3)
    hashes = {make_manifest([each])["records"][0]["sha256"] for each in (SHOCK, other)}
    assert len(hashes) == 2


def test_seed_model_and_warnings_come_from_the_ensemble(tmp_path: Path) -> None:
    runs = run_ensemble(
        Block.rectangle(width=0.4, height=1.6),
        SHOCK,
        levels=Levels("pga_g", [0.2, 4.0], beside=()),
        restitution=RestitutionBand(draws=2, seed=7),
    )
    found = make_manifest([SHOCK], ensemble=runs, warnings=["one", "one"])
    assert found["ensemble"]["seed"] == "7"
    assert found["ensemble"]["measure"] == "pga_g"
    assert found["ensemble"]["cells"] == runs.status.size
    with pytest.raises(InputError, match="ensemble is no rocking ensemble"):
        make_manifest([SHOCK], ensemble=runs.assign_attrs(kind="attractors"))
    assert found["warnings"] == ["one", *json.loads(runs.attrs["warnings"])]
    assert any("scaled by up to" in each for each in found["warnings"])
    file = write_manifest(tmp_path / "run.json", found)
    assert json.loads(file.read_text(encoding="utf-8")) == {"schema": "rocksteady/run/1", **found}
    assert str(tmp_path) not in file.read_text(encoding="utf-8")


def test_the_same_bytes_twice(tmp_path: Path) -> None:
    files = [
        write_manifest(tmp_path / name, make_manifest([SHOCK], settings={"levels": [0.1, 0.2]}))
        for name in ("a.json", "b.json")
    ]
    assert files[0].read_bytes() == files[1].read_bytes()


def test_what_cannot_be_read_or_written_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"files = .* it cannot be read \(No such file"):
        make_manifest(files=[tmp_path / "none"])
    odd: dict[str, Any] = {"settings": {"block": object()}}
    with pytest.raises(InputError, match="numbers, texts, lists"):
        write_manifest(tmp_path / "run.json", odd)
    with pytest.raises(OutputError, match="it is a folder"):
        write_manifest(tmp_path, make_manifest())
    assert list(tmp_path.iterdir()) == []
