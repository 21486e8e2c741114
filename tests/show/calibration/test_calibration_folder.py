"""The folder of a calibration: read back to the last bit, the same bytes twice, all or nothing."""

import csv
import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from rocksteady.calibration import read_posterior
from rocksteady.errors import OutputError
from rocksteady.export import write_calibration
from tests.show.calibrated import calibrated, unscored, without_pictures

FILES = ["fit.json", "parameters.csv", "posterior.csv", "predictions.csv", "report.html"]


@pytest.fixture(name="plain")
def _plain() -> Iterator[None]:
    with without_pictures():
        yield


def names(folder: Path) -> list[str]:
    return sorted(each.name for each in folder.iterdir())


def rows(file: Path) -> list[dict[str, str]]:
    with file.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


@pytest.mark.usefixtures("plain")
def test_every_file_is_there_and_has_the_numbers_of_the_result(tmp_path: Path) -> None:
    found, out = calibrated(), tmp_path / "fit"
    written = write_calibration(found, out, command="rocksteady calibrate x")
    assert [file.name for file in written] == names(out) == FILES

    fit = json.loads((out / "fit.json").read_text(encoding="utf-8"))
    assert fit["schema"] == "rocksteady/calibrate/2"
    for name, scores in found.validation.rows.items():
        assert fit["scores"][name]["brier"]["value"] == scores.brier[0]
    assert fit["hashes"] == {"tests.csv": "ab" * 32}
    assert fit["runs"] == {"synthetic block": 200}

    predicted = rows(out / "predictions.csv")
    assert list(predicted[0])[:6] == ["test", "p", "low", "high", "block", "logistic"]
    assert [float(row["p"]) for row in predicted] == found.validation.predictions.p.tolist()
    medians = [
        float(row["median"]) if row["median"] else None for row in rows(out / "parameters.csv")
    ]
    assert medians == [row["median"] for row in found.parameters]


@pytest.mark.usefixtures("plain")
def test_what_is_read_back_predicts_to_the_last_bit(tmp_path: Path) -> None:
    found = calibrated()
    write_calibration(found, tmp_path / "fit")
    stored = read_posterior(tmp_path / "fit")
    mine, its = (found.posteriors["synthetic block"], stored.posteriors["synthetic block"])
    assert np.array_equal(mine.values, its.values)
    assert np.array_equal(mine.weights, its.weights)
    again = stored.predict(found.tests.tests)
    assert np.array_equal(again.p, found.validation.predictions.p)


@pytest.mark.slow
def test_the_same_calibration_gives_the_same_bytes(tmp_path: Path) -> None:
    made = unscored()
    for name in ("one", "two"):
        write_calibration(made, tmp_path / name)
    for file in FILES:
        assert (tmp_path / "one" / file).read_bytes() == (tmp_path / "two" / file).read_bytes()


def test_a_folder_with_anything_else_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").write_text("years of work", encoding="utf-8")
    for force in (False, True):
        with pytest.raises(OutputError, match=r"it holds thesis\.txt, which is no file of a cal"):
            write_calibration(unscored(), tmp_path, force=force)
    assert names(tmp_path) == ["thesis.txt"]


@pytest.mark.usefixtures("plain")
def test_an_earlier_one_is_replaced_with_force_alone(tmp_path: Path) -> None:
    out = tmp_path / "fit"
    write_calibration(calibrated(), out)
    before = (out / "fit.json").read_bytes()
    with pytest.raises(OutputError, match=r"it holds fit\.json and 4 more; add --force"):
        write_calibration(unscored(), out)
    assert (out / "fit.json").read_bytes() == before
    write_calibration(unscored(), out, force=True)
    assert names(out) == FILES
    assert (out / "fit.json").read_bytes() != before
