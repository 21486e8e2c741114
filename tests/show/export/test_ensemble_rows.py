"""Ensembles as a table: each run once, each number as it was."""

import csv
import itertools
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

from rocksteady import BaseMotion, Block, Record, Status, run_ensemble
from rocksteady.errors import InputError
from rocksteady.export import write_runs_csv
from rocksteady.risk import Levels, RestitutionBand

NAMES = ["=1+1", 'a,"b"\nc', "波 <&>", "@sum"]


@pytest.fixture(scope="module", name="runs")
def _runs() -> xarray.Dataset:
    rng = np.random.default_rng(1)
    suite = []
    for name in NAMES:
        record = Record(
            acceleration_m_s2=np.cumsum(rng.normal(size=80)) * 0.5, dt_s=0.05, name=name
        )
        suite.append(BaseMotion(record, record.scaled(0.3)))
    return run_ensemble(
        [Block.rectangle(width=0.3, height=1.6), Block.rectangle(width=0.5, height=1.2)],
        suite,
        levels=Levels("pga_g", [0.1, 0.4, 1.5], beside=()),
        restitution=RestitutionBand(draws=2),
    )


def read(file: Path) -> list[dict[str, str]]:
    with file.open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def test_every_run_is_there_once_with_its_numbers(runs: xarray.Dataset, tmp_path: Path) -> None:
    rows = read(write_runs_csv(tmp_path / "results.csv", runs))
    assert len(rows) == runs.status.size == 2 * 4 * 2 * 2 * 2 * 3
    seen = set()
    for row in rows:
        name = row["record"].removeprefix("'")
        where: dict[str, Any] = {
            "block": int(row["block"]),
            "record": name,
            "direction": row["direction"],
            "vertical": row["vertical"],
            "level": float(row["level"]),
        }
        part = runs.sel(where)
        (draw,) = np.flatnonzero(part["restitution"].values == float(row["restitution"]))
        part = part.isel(draw=int(draw))
        seen.add((*where.values(), int(draw)))
        assert Status(int(part["status"])).label == row["status"]
        assert float(part["peak_angle"]) == float(row["peak_angle"])
        assert int(part["impacts"]) == int(row["impacts"])
        assert float(part["scale"]) == float(row["scale"])
        time = float(part["uplift_time_s"])
        assert row["uplift_time_s"] == "" if np.isnan(time) else time == float(row["uplift_time_s"])
    assert len(seen) == len(rows)
    assert {row["uplift_time_s"] == "" for row in rows} == {True, False}
    assert len({row["status"] for row in rows}) > 1


def test_a_name_is_no_formula(runs: xarray.Dataset, tmp_path: Path) -> None:
    rows = read(write_runs_csv(tmp_path / "results.csv", runs))
    assert [name for name, _ in itertools.groupby(row["record"] for row in rows)] == [
        "'=1+1", 'a,"b"\nc', "波 <&>", "'@sum",
    ] * 2  # fmt: skip


def test_another_dataset_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="ensemble is no rocking ensemble"):
        write_runs_csv(tmp_path / "results.csv", xarray.Dataset())
    assert list(tmp_path.iterdir()) == []
