"""Posteriors on disk: read back, they predict to the last bit."""

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rocksteady import Linear, calibrate
from rocksteady.calibration import Calibration, DrawOptions, read_posterior
from rocksteady.errors import InputError
from rocksteady.export import write_calibration
from tests.risk.calibration.trials import Case, make_records, make_tests
from tests.show.calibrated import without_pictures


@pytest.fixture(scope="module")
def found() -> Calibration:
    tests, _ = make_tests(Case("20 tests", tests=20), 1)
    return calibrate(tests, sampling=DrawOptions(draws=60, gains=3, rounds=2), model=Linear())


@pytest.fixture(scope="module")
def written(found: Calibration, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write the calibration once."""
    folder = tmp_path_factory.mktemp("calibrated") / "fit"
    with without_pictures():
        write_calibration(found, folder)
    return folder


@pytest.fixture
def folder(written: Path, tmp_path: Path) -> Path:
    """Return a folder of the calibration, to be damaged."""
    shutil.copytree(written, tmp_path / "fit")
    return tmp_path / "fit"


def test_a_stored_posterior_predicts_to_the_last_bit(found: Calibration, folder: Path) -> None:
    stored = read_posterior(folder)
    record = make_records(1, seed=9)[0]
    new = replace(found.tests.tests[0], name="new", record=record, group=None)
    tests = [new, found.tests.tests[3], found.tests.tests[7]]
    first, second = found.predict(tests), stored.predict(tests)
    assert first.held_out == second.held_out == (False, True, True)
    assert first.rows == second.rows
    for name, each in found.posteriors.items():
        assert np.array_equal(stored.posteriors[name].values, each.values)
        assert np.array_equal(stored.posteriors[name].weights, each.weights)


def test_a_training_test_that_was_changed_is_a_new_one(found: Calibration, folder: Path) -> None:
    changed = replace(found.tests.tests[3], gain=found.tests.tests[3].gain * 1.01)
    assert read_posterior(folder).predict([changed]).held_out == (False,)


@pytest.mark.parametrize("name", ["fit.json", "posterior.csv", "predictions.csv"])
def test_a_damaged_folder_is_refused(found: Calibration, folder: Path, name: str) -> None:
    (folder / name).write_text("{}", encoding="utf-8")
    with pytest.raises(InputError, match="folder"):
        read_posterior(folder).predict(found.tests)
    (folder / name).unlink()
    with pytest.raises(InputError, match="folder"):
        read_posterior(folder)


@pytest.mark.parametrize("name", ["posterior.csv", "predictions.csv"])
def test_a_table_that_was_cut_or_edited_is_refused(folder: Path, name: str) -> None:
    whole = (folder / name).read_bytes()
    lines = whole.splitlines(keepends=True)
    for content in (b"".join(lines[:-1]), whole.replace(b"0.", b"0.1", 1)):
        assert content != whole
        (folder / name).write_bytes(content)
        with pytest.raises(InputError, match=f"{name} is not the file that was written"):
            read_posterior(folder)
    (folder / name).write_bytes(whole)
    read_posterior(folder)


@pytest.mark.parametrize(
    "text", ["[" * 100_000, '{"draws": 1e400}', "[]", "null", '"fit"', '{"seed": 0}']
)
def test_a_fit_that_is_none_is_refused_in_one_line(folder: Path, text: str) -> None:
    (folder / "fit.json").write_text(text, "utf-8")
    with pytest.raises(InputError, match=r"are not those of a calibration: [^;]") as refusal:
        read_posterior(folder)
    assert "\n" not in str(refusal.value)
