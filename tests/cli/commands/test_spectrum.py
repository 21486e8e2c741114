"""`rocksteady spectrum`: its contract, its text, its files and what it refuses."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
import xarray

from rocksteady import Block, Record, compute_rocking_spectrum, read_record, simulate
from rocksteady.measures import compute_suite_spectrum
from rocksteady.model.blocks.housner_forms import Restitution
from rocksteady.model.equations import Nonlinear
from rocksteady.model.motions.base_motion import BaseMotion
from tests.cli.program import rocksteady
from tests.records import peer
from tests.seismic.grounds import ground, lifting

GRID = "--alpha-rad 0.15:0.3:2 --periods-s 1:4:4"


def write_at2(path: Path, record: Record) -> Path:
    head = "PEER\nSomewhere, 1/2/1990, Hut, 090\nACCELERATION IN UNITS OF G\n"
    values = record.acceleration_m_s2 / 9.80665
    body = "\n".join(f"  {value:.9E}" for value in values)
    path.write_text(f"{head}NPTS= {len(values)}, DT= {record.dt_s} SEC\n{body}\n")
    return path


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    folder = tmp_path_factory.mktemp("records")
    return [
        write_at2(folder / f"ground-{seed}.AT2", ground(seed, peak=3.0 + seed))
        for seed in (1, 2, 3)
    ]


def test_a_suite_has_quantiles_and_shares(files: list[Path]) -> None:
    records = [part for file in files for part in ("--record", file)]
    values = rocksteady(f"spectrum {GRID} --json", *records).json
    suite = [read_record(file) for file in files]
    found = compute_rocking_spectrum(suite, alpha=[0.15, 0.3], periods_s=[1.0, 2.0, 3.0, 4.0])
    summary = compute_suite_spectrum(found)
    assert values["quantiles"] == [0.16, 0.5, 0.84]
    assert [one["name"] for one in values["records"]] == ["ground-1", "ground-2", "ground-3"]
    for row in values["suite"]:
        block = summary.sel(alpha=row["alpha_rad"], period=row["period_s"])
        peaks = [None if np.isinf(peak) else peak for peak in block.peak_angle.values.tolist()]
        assert row["peaks"] == peaks
        assert row["overturned"] == float(block.overturned)


def test_every_flag_reaches_the_blocks(files: list[Path], tmp_path: Path) -> None:
    up = write_at2(tmp_path / "up.AT2", lifting())
    up.write_text(up.read_text().replace("Hut, 090", "Hut, UP"))
    command = "spectrum --alpha-deg 12 --p-rad-s 2 --model nonlinear -r 0.8 --gravity-m-s2 9.7"
    command += " --scale 1.2 --reverse --tolerance 1e-8 --json"
    values = rocksteady(command, "--record", files[1], "--vertical", up).json
    found = compute_rocking_spectrum(
        BaseMotion(read_record(files[1]), read_record(up)).reversed(),
        alpha=math.radians(12.0),
        periods_s=math.pi,
        model=Nonlinear(tolerance=1e-8),
        restitution=0.8,
        gravity=9.7,
        scales=1.2,
    )
    (row,) = values["values"]
    assert (row["peak"], row["impacts"]) == (float(found.peak_angle), int(found.impacts))
    assert (values["scale"], values["reversed"], values["vertical"]) == (1.2, True, "up")


def test_the_published_peak_from_the_command_line() -> None:
    peer("PUL164")  # skips where it is not there
    from tests.records import FOLDER

    (file,) = (FOLDER / "peer_at2").glob("*PUL164*.AT2")
    command = "spectrum --alpha-deg 15 --periods-s 4 --model nonlinear --json --record"
    (row,) = rocksteady(command, file).json["values"]
    assert row["peak_rad"] == pytest.approx(0.1249485, rel=1e-5)


@pytest.mark.slow
def test_the_files_hold_the_same(files: list[Path], tmp_path: Path) -> None:
    names = ("s.csv", "s.nc", "s.png", "s.zarr")
    table, data, picture, store = (tmp_path / name for name in names)
    command = f"spectrum {GRID} --csv {table} --netcdf {data} --plot {picture} --out {store} --json"
    several = [part for file in files for part in ("--record", file)]
    ran = rocksteady(command, *several)
    assert ran.code == 0
    with table.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["peak_angle"]) for row in rows] == [row["peak"] for row in ran.json["values"]]
    assert [row["status"] for row in rows] == [row["status"] for row in ran.json["values"]]
    with xarray.open_dataset(data) as kept:
        assert kept.peak_angle.values.ravel().tolist() == [
            row["peak"] for row in ran.json["values"]
        ]
    assert picture.stat().st_size > 5000
    again = rocksteady(f"{command} --resume", *several).json
    assert again["values"] == ran.json["values"]


def test_blocks_of_given_sizes_at_several_scales(files: list[Path]) -> None:
    command = "spectrum --width-m 0.4 --height-m 1.2:2:3 --scale 0.5:1.5:3 --record"
    values = rocksteady(f"{command} {files[2]} --json").json
    assert values["cells"] == len(values["values"]) == 9
    for row in values["values"]:
        block = Block.rectangle(width=0.4, height=row["height_m"])
        assert row["width_m"] == pytest.approx(0.4)
        assert (row["alpha_rad"], row["p_rad_s"]) == (block.alpha, block.p)
        run = simulate(block, read_record(files[2]).scaled(row["scale"]))
        assert row["status"] == run.status.label
        assert row["peak"] == pytest.approx(run.peak, rel=1e-8, abs=1e-15)
    assert values["scale"] == [0.5, 1.0, 1.5]
    text = rocksteady(
        f"{command} --more {files[2]}".replace("--record --more", "--more --record")
    ).out
    assert "400 mm" in text
    assert "3 levels" in text
    assert all(len(line) <= 80 for line in text.splitlines())


def test_one_sided_blocks_stand_against_a_wall_by_either_size(files: list[Path]) -> None:
    record = read_record(files[2])
    ratios: tuple[Restitution, ...] = (0.0, 0.4, "housner")
    for sizes, ratio in zip(("--width-m 0.4 --height-m 1.2:2:3", GRID, GRID), ratios, strict=True):
        for sign in ("", "--reverse"):
            command = f"spectrum {sizes} --one-sided -r {ratio} {sign} --json --record {files[2]}"
            values = rocksteady(command).json
            assert values["one_sided"] is True
            for row in values["values"]:
                block = Block.from_p(alpha=row["alpha_rad"], p=row["p_rad_s"]).against_wall(ratio)
                run = simulate(block, record.reversed() if sign else record)
                assert row["status"] == run.status.label
                assert row["peak"] == pytest.approx(run.peak, rel=1e-8, abs=1e-15)
    assert "against a wall" in rocksteady(f"spectrum {GRID} --one-sided --record {files[2]}").out
    assert "one_sided" not in rocksteady(f"spectrum {GRID} --json --record {files[2]}").json


def test_a_record_is_scaled_to_a_pga(files: list[Path]) -> None:
    several = [part for file in files for part in ("--record", file)]
    values = rocksteady(f"spectrum {GRID} --pga-g 0.4 --json", *several).json
    suite = [read_record(file) for file in files]
    scaled = [each.scaled(0.4 * 9.80665 / each.peak_acceleration_m_s2) for each in suite]
    truth = compute_rocking_spectrum(scaled, alpha=[0.15, 0.3], periods_s=[1.0, 2.0, 3.0, 4.0])
    peaks = [row["peak"] for row in values["values"]]
    assert peaks == pytest.approx(truth.peak_angle.values.ravel().tolist(), rel=1e-8)
    assert values["pga_g"] == 0.4
