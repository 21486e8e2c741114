"""Tests as a folder: what is written is read again to the last bit."""

from pathlib import Path

import numpy as np
import pytest

from rocksteady.errors import OutputError
from rocksteady.model.motions.record import Record
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.observations import Observations
from rocksteady.risk.observations.read_tests import read_tests
from rocksteady.risk.observations.shaking_test import ShakingTest
from rocksteady.show.export.tests_folder import write_tests

KEYS = (
    "name", "object", "fell", "gain", "sigma_ln", "reversed", "group", "session", "peak_rad",
    "sigma_rad",
)  # fmt: skip


def record(name: str, seed: int, dt_s: float) -> Record:
    samples = np.random.default_rng(seed).normal(size=200)
    return Record(acceleration_m_s2=samples, dt_s=dt_s, name=name)


def everything() -> Observations:
    first, second, third = (
        record("a/b: é", 1, 1.0 / 256.0),
        record("tests", 2, 0.01),
        record("TESTS", 3, 0.0123456789),
    )
    objects = {
        "column, blue": ObjectPrior(name="column, blue", width_m=0.15, height_m="0.55:0.65"),
        "rock": ObjectPrior(
            name="rock", alpha_rad="0.3+-0.05", p_rad_s=3.3, restitution=0.9, scatter=0.05
        ),
    }
    tests = [
        ShakingTest(
            name="1", record=first, object="column, blue", fell=False, gain=1.0 / 3.0,
            vertical=second, peak_rad=0.1, sigma_rad=0.01, reversed=True, session='"q"',
        ),
        ShakingTest(name="2", record=second, object="rock", fell=True, sigma_ln=0.1, group="g"),
        ShakingTest(name="3", record=third, object="rock"),
    ]  # fmt: skip
    return Observations(tests=tests, objects=objects)


def test_what_is_written_is_read_again_to_the_last_bit(tmp_path: Path) -> None:
    made = everything()
    table = write_tests(tmp_path / "kept", made)
    assert table == tmp_path / "kept" / "tests.csv"
    again = read_tests(table)
    for one, other in zip(made.tests, again.tests, strict=True):
        assert [getattr(one, key) for key in KEYS] == [getattr(other, key) for key in KEYS]
        for motion, same in ((one.record, other.record), (one.vertical, other.vertical)):
            if motion is None:
                assert same is None
                continue
            assert same is not None
            assert same.dt_s == motion.dt_s
            np.testing.assert_array_equal(same.acceleration_m_s2, motion.acceleration_m_s2)
    for name, one_object in made.objects.items():
        assert again.objects[name].spreads == one_object.spreads
        assert again.objects[name].defaults == one_object.defaults
    assert len(list((tmp_path / "kept").iterdir())) == 5


def test_tables_of_others_are_replaced_when_that_is_wanted_alone(tmp_path: Path) -> None:
    made = everything()
    write_tests(tmp_path, made)
    before = {file.name: file.read_bytes() for file in tmp_path.iterdir()}
    with pytest.raises(OutputError, match="it holds"):
        write_tests(tmp_path, made)
    write_tests(tmp_path, made, force=True)
    assert {file.name: file.read_bytes() for file in tmp_path.iterdir()} == before
    with pytest.raises(OutputError):
        write_tests(tmp_path / "no" / "such", made)


def test_the_files_that_tests_were_read_from_are_kept(tmp_path: Path) -> None:
    table = write_tests(tmp_path, everything())
    before = {file: file.read_bytes() for file in tmp_path.iterdir()}
    with pytest.raises(OutputError, match="this file is read; name another folder"):
        write_tests(tmp_path, read_tests(table), force=True)
    assert {file: file.read_bytes() for file in tmp_path.iterdir()} == before
