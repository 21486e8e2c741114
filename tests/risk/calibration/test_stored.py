"""Posteriors on disk: read back, they predict to the last bit."""

import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rocksteady import calibrate
from rocksteady.calibration import Calibration, read_posterior
from rocksteady.errors import InputError
from rocksteady.export import write_calibration
from rocksteady.risk.calibration.stored import fit_hash
from tests.every import every
from tests.risk.calibration.cases import LINEAR, SERIAL, make_records, narrow_tests
from tests.show.calibrated import without_pictures


@pytest.fixture(scope="module")
def found() -> Calibration:
    tests = narrow_tests().subset(range(20))
    return calibrate(tests, most_runs=200, model=LINEAR, run=SERIAL)


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
    each, again = found.posteriors["stone"], stored.posteriors["stone"]
    for key in ("values", "weights", "prior_weights"):
        assert np.array_equal(getattr(each, key), getattr(again, key))
    for key in each.sessions:
        assert np.array_equal(each.sessions[key], again.sessions[key])


def test_a_file_that_is_missing_cut_or_edited_is_refused(folder: Path) -> None:
    for name in ("fit.json", "posterior.csv", "predictions.csv"):
        whole = (folder / name).read_bytes()
        lines = whole.splitlines(keepends=True)
        others = [b"".join(lines[:-1]), whole.replace(b"0.", b"0.1", 1), b"{}", b"[" * 100_000]
        for content in (*others, b'{"draws": 1e400}', b"null", b'"fit"', None):
            (folder / name).unlink()
            if content is not None:
                (folder / name).write_bytes(content)
            with pytest.raises(InputError, match=r"^folder = .*name the folder that") as refusal:
                read_posterior(folder)
            assert "\n" not in str(refusal.value)
        (folder / name).write_bytes(whole)
    read_posterior(folder)


def test_one_digit_of_a_fit_is_enough_to_refuse_it(found: Calibration, folder: Path) -> None:
    text = (folder / "fit.json").read_text("utf-8")
    slope = repr(found.validation.curve.slopes[2])
    digit = slope[:-1] + str((int(slope[-1]) + 1) % 10)
    assert text.count(slope) == 1
    (folder / "fit.json").write_text(text.replace(slope, digit), "utf-8")
    with pytest.raises(InputError, match=r"fit\.json has been altered since it was written"):
        read_posterior(folder)


@every(
    ("keys", "value", "words"),
    [
        (("model",), "cubic", "cubic"),
        (("schema",), "rocksteady/calibrate/1", "its form is rocksteady/calibrate/1"),
        (("stack", "block"), -1.0, "its slopes of block and logistic are -1.0"),
        (("stack", "logistic"), float("inf"), "its logistic has another length, or a number"),
        (("trained",), {}, "predictions.csv has other tests than fit.json"),
        (("curve", "slope"), 1.0, "unexpected keyword argument 'slope'"),
    ],
)
def test_a_fit_with_a_hash_of_its_own_is_complete(
    written: Path, tmp_path: Path, keys: tuple[str, ...], value: object, words: str
) -> None:
    folder = shutil.copytree(written, tmp_path / "fit")
    fit = json.loads((folder / "fit.json").read_text("utf-8"))
    (fit[keys[0]] if len(keys) > 1 else fit)[keys[-1]] = value
    fit["sha256"] = fit_hash(fit)
    (folder / "fit.json").write_text(json.dumps(fit), "utf-8")
    with pytest.raises(InputError, match=f"are not those of a calibration: .*{words}"):
        read_posterior(folder)
