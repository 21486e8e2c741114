"""`rocksteady record`: what it says of files, what it writes, and what it refuses."""

import csv
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from scipy.integrate import cumulative_trapezoid

from rocksteady import Block, Record, compute_measures
from rocksteady.cli.commands import record as command
from rocksteady.measures import compute_response_spectrum, integrate_record
from tests.cli.motion_files import at2, real, samples
from tests.cli.program import rocksteady
from tests.every import every
from tests.records import recording


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return at2(tmp_path / "hut.AT2", samples())


def record_of(values_g: Any) -> Record:
    return Record(acceleration_m_s2=9.80665 * values_g, dt_s=0.02)


def test_one_file_is_one_object_with_the_keys_of_the_contract(file: Path) -> None:
    ran = rocksteady("record --json", file)
    assert (ran.code, ran.err) == (0, "")
    values = ran.json
    assert values["schema"] == "rocksteady/record/1"
    assert values["format"] == "peer-at2"
    assert (values["npts"], values["dt_s"], values["units_in_file"]) == (601, 0.02, "g")
    assert values["warnings"] == []
    truth = compute_measures(record_of(samples()))
    assert values["pga_g"] == pytest.approx(np.abs(samples()).max())
    assert values["pgv_m_s"] == pytest.approx(truth.pgv_m_s)
    assert values["significant_5_95_s"] == pytest.approx(truth.significant_5_95_s)
    assert "spectrum" not in values
    assert "pga_per_uplift" not in values


def test_a_block_adds_what_it_feels_and_periods_add_a_spectrum(file: Path) -> None:
    command = "record --json --width-m 0.4 --height-m 1.6 --periods-s 0.5:2:4 --damping 0.02"
    values = rocksteady(command, file).json
    block = Block.rectangle(width=0.4, height=1.6)
    truth = compute_measures(record_of(samples()), block, damping=0.02)
    for name in ("pga_per_uplift", "p_pgv_per_uplift", "p_pgv_per_pga", "housner_intensity_m"):
        assert values[name] == pytest.approx(getattr(truth, name)), name
    spectrum = compute_response_spectrum(record_of(samples()), [0.5, 1.0, 1.5, 2.0], damping=0.02)
    assert values["damping"] == 0.02
    assert values["spectrum"].pop("damping") == 0.02
    for name, found in values["spectrum"].items():
        np.testing.assert_allclose(found, getattr(spectrum, name), err_msg=name)


def test_a_spectrum_is_printed_where_periods_are_given(file: Path) -> None:
    lines = rocksteady("record --more --periods-s 0.5:1:2", file).out.splitlines()
    spectrum = compute_response_spectrum(record_of(samples()), [0.5, 1.0])
    at = next(k for k, line in enumerate(lines) if line.split()[:2] == ["T", "[s]"])
    for line, period, psa in zip(
        lines[at + 1 : at + 3], (0.5, 1.0), spectrum.pseudo_acceleration_m_s2 / 9.80665, strict=True
    ):
        assert [float(word) for word in line.split()[:2]] == pytest.approx([period, psa], rel=6e-3)


@pytest.mark.slow
def test_a_record_is_written_in_the_unit_that_is_asked_for(file: Path, tmp_path: Path) -> None:
    for unit, column, size in (
        ("m/s^2", "acceleration_m_s2", 9.80665),
        ("gal", "acceleration_gal", 980.665),
        ("g", "acceleration_g", 1.0),
    ):
        table = tmp_path / f"{column}.csv"
        ran = rocksteady("record --units-out", unit, "--csv", table, file)
        assert (ran.code, ran.err) == (0, f"wrote {table}\n")
        with table.open(encoding="utf-8", newline="") as stream:
            rows = list(csv.DictReader(stream))
        assert list(rows[0]) == ["time_s", column, "velocity_m_s", "displacement_m"]
        np.testing.assert_allclose([float(row[column]) for row in rows], size * samples())
        assert float(rows[-1]["time_s"]) == pytest.approx(12.0)
        # The table says all that is needed to read it again.
        again = rocksteady("record --json", table).json
        assert (again["npts"], again["units_in_file"]) == (601, unit)
        assert again["pga_g"] == pytest.approx(0.6)


def test_the_rows_are_the_course_in_the_unit_that_is_given() -> None:
    course = integrate_record(record_of(samples()))
    assert command.course_header("m/s^2")[1] == "acceleration_m_s2"
    assert command.course_header("g")[1] == "acceleration_g"
    in_m = np.array(list(command.course_rows(course, "m/s^2")))
    in_cm = np.array(list(command.course_rows(course, "cm/s^2")))
    np.testing.assert_allclose(in_cm[:, 1], 100.0 * in_m[:, 1])
    np.testing.assert_array_equal(in_cm[:, 2:], in_m[:, 2:])
    # Velocity is the area below the acceleration.
    steps = 0.01 * (in_m[1:, 1] + in_m[:-1, 1])
    np.testing.assert_allclose(np.diff(in_m[:, 2]), steps, atol=1e-12)


def test_the_title_of_a_figure_fits_and_tells_of_a_changed_sign() -> None:
    station = "Castaic - Old Ridge Route above the very long name of a dam in the mountains"
    one = recording(9.8 * samples(), station=3 * station, processing=("sign changed: DWN",))
    title = command.title_of([one])
    assert title.endswith(" (sign changed)")
    assert len(title) <= 110
    assert command.title_of([one, one]) == "2 records"


@pytest.mark.slow
def test_pictures_of_one_and_of_several(file: Path, tmp_path: Path) -> None:
    for name, files in (("one.png", [file]), ("several.png", [file, file])):
        ran = rocksteady("record --json --plot", tmp_path / name, *files)
        assert ran.code == 0
        with Image.open(tmp_path / name) as picture:
            assert picture.size[0] > 1000


def test_a_drift_is_said_and_a_line_taken_off_removes_it(tmp_path: Path) -> None:
    file = at2(tmp_path / "tilted.AT2", samples() + 0.002)
    ran = rocksteady("record --json", file)
    assert ran.code == 0
    assert ran.err.startswith(f"rocksteady: {file}: PGD = ")
    assert ran.err.count("\n") == 1
    assert "--baseline linear" in ran.json["warnings"][0]
    again = rocksteady("record --json --baseline linear", file)
    assert (again.err, again.json["warnings"]) == ("", [])
    assert "straight line" in again.json["processing"][0]
    assert again.json["pgd_m"] < 0.5 * ran.json["pgd_m"]


@every(
    ("pattern", "npts", "dt_s"),
    [
        ("RSN6_*ELC180*", 5372, 0.01),
        ("RSN77_*PUL164*", 4172, 0.01),
        ("RSN753_*CLS000*", 7997, 0.005),
    ],
)
def test_real_records_beside_sums_of_their_samples(pattern: str, npts: int, dt_s: float) -> None:
    file = real(pattern)
    values = rocksteady("record --json", file).json
    assert (values["npts"], values["dt_s"]) == (npts, dt_s)
    a = 9.80665 * np.array(" ".join(file.read_text().splitlines()[4:]).split(), dtype=float)
    velocity = cumulative_trapezoid(a, dx=dt_s)
    assert values["pga_m_s2"] == pytest.approx(np.abs(a).max())
    largest = float(np.abs(velocity).max())
    assert largest <= values["pgv_m_s"] * (1 + 1e-12) <= 1.002 * largest
    fine = np.interp(np.arange(20 * (npts - 1) + 1) / 20, np.arange(npts), a)
    energy = np.cumsum(fine * fine) * dt_s / 20
    assert values["arias_m_s"] == pytest.approx(math.pi / 2 / 9.80665 * energy[-1], rel=1e-3)
    begin, end = np.searchsorted(energy / energy[-1], [0.05, 0.95]) * dt_s / 20
    assert values["significant_5_95_s"] == pytest.approx(end - begin, abs=0.1 * dt_s)
