"""What `record` prints of channels: values, tables and rows."""

import math
from dataclasses import replace
from datetime import UTC, datetime
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    Recording,
    compute_response_spectrum,
    integrate_record,
    measure_intensity,
)
from rocksteady.cli.present.record_values import (
    Description,
    course_header,
    course_rows,
    print_one,
    print_spectrum,
    print_table,
    processing_values,
    record_values,
    title_of,
)
from tests.cli.motion_files import samples
from tests.cli.present.printed import as_json, fits, printed
from tests.records import recording

PERIODS = [0.1, 0.5, 1.0]
STATION = "Castaic - Old Ridge Route above the very long name of a dam in the mountains"


def described(one: Recording, block: Block | None = None, *, spectrum: bool = False) -> Description:
    return Description(
        recording=one,
        course=integrate_record(one.record),
        measures=measure_intensity(one.record, block),
        spectrum=compute_response_spectrum(one.record, PERIODS) if spectrum else None,
    )


def hut(**fields: Any) -> Recording:
    return recording(9.80665 * samples(), 0.02, **fields)


def test_the_values_keep_the_contract() -> None:
    start = datetime(2020, 1, 2, 3, 4, 5, tzinfo=UTC)
    one = hut(component="090", orientation="horizontal", azimuth_deg=90.0, start_time=start)
    values = as_json(record_values(described(one), spectrum=False))
    assert (values["format"], values["npts"], values["dt_s"]) == ("csv", 601, 0.02)
    assert values["units_in_file"] == "g"
    assert values["pga_g"] == pytest.approx(np.abs(samples()).max())
    assert values["duration_s"] == pytest.approx(12.0)
    assert datetime.fromisoformat(values["start_time"]) == start
    assert (values["warnings"], values["processing"]) == ([], [])
    bare = as_json(record_values(described(hut()), spectrum=False))
    assert {bare[name] for name in ("component", "azimuth_deg", "start_time", "station")} == {None}


def test_a_block_adds_what_the_ground_is_to_it() -> None:
    block = Block.asymmetric(left=0.15, right=0.25, height=1.2)
    values = record_values(described(hut(), block), spectrum=False)
    # The side of the smaller slenderness lifts first.
    uplift = min(math.tan(side.alpha) for side in (block.positive, block.negative))
    assert values["pga_per_uplift"] == pytest.approx(values["pga_g"] / uplift)
    assert "pga_per_uplift" not in record_values(described(hut()), spectrum=False)


def test_a_spectrum_stands_in_the_values_where_it_is_asked_for() -> None:
    one = described(hut(), spectrum=True)
    assert "spectrum" not in record_values(one, spectrum=False)
    found = as_json(record_values(one, spectrum=True))["spectrum"]
    assert found["periods_s"] == PERIODS
    frequency = 2.0 * math.pi / np.array(PERIODS)
    np.testing.assert_allclose(
        found["pseudo_velocity_m_s"], frequency * np.array(found["displacement_m"])
    )
    text = printed(print_spectrum, one.spectrum)
    assert fits(text)
    rows = [line.split() for line in text.splitlines()[2:5]]
    assert [float(row[0]) for row in rows] == PERIODS
    assert [float(row[5]) for row in rows] == pytest.approx(found["displacement_m"], rel=1e-4)


def test_a_drift_is_warned_about() -> None:
    assert described(hut()).warnings == []
    drifting = recording(9.80665 * (samples() + 0.05), 0.02, warnings=("it is odd",))
    odd, drift = described(drifting).warnings
    assert odd == "it is odd"
    assert drift.startswith("PGD = ")
    assert "--baseline linear" in drift


def test_the_rows_are_the_course_in_the_unit_of_the_file() -> None:
    course = integrate_record(hut().record)
    assert course_header("m/s^2")[1] == "acceleration_m_s2"
    assert course_header("g")[1] == "acceleration_g"
    in_m = np.array(list(course_rows(course, "m/s^2")))
    in_cm = np.array(list(course_rows(course, "cm/s^2")))
    np.testing.assert_allclose(in_cm[:, 1], 100.0 * in_m[:, 1])
    np.testing.assert_array_equal(in_cm[:, 2:], in_m[:, 2:])
    # Velocity is the area below the acceleration.
    steps = 0.01 * (in_m[1:, 1] + in_m[:-1, 1])
    np.testing.assert_allclose(np.diff(in_m[:, 2]), steps, atol=1e-12)


def test_a_channel_has_a_name_and_a_title() -> None:
    assert described(hut()).name == "hut.csv"
    assert described(hut(component="hut")).name == "hut.csv"
    named = described(hut(component="090", event="Town  1990", station="Hut"))
    assert named.name == "hut.csv 090"
    assert named.title == "Town 1990, Hut, 090"
    assert described(hut()).title == "hut.csv"
    assert title_of([named]) == named.title
    assert title_of([named, named]) == "2 records"
    turned = described(hut(station=3 * STATION, processing=("sign changed: DWN",)))
    title = title_of([turned])
    assert title.endswith(" (sign changed)")
    assert len(title) <= 110


def test_what_was_done_to_both_channels_is_kept() -> None:
    one = hut(processing=("mean taken off",))
    assert processing_values(one, None) == {"record_processing": ["mean taken off"]}
    both = processing_values(one, replace(one, processing=()))
    assert both == {"record_processing": ["mean taken off"], "vertical_processing": []}


def test_one_record_is_printed_with_all_measures() -> None:
    block = Block.rectangle(width=0.4, height=1.2)
    one = described(
        hut(station=STATION, component="090", stated_peak_m_s2=5.9, processing=("mean taken off",)),
        block,
    )
    *lines, rule = printed(print_one, one).splitlines()
    text = "\n".join(lines)
    assert fits(text)
    for words in ("peak stated", "5.9 m/s^2", "mean taken off", "601 every 0.02 s, 12 s, in g"):
        assert words in text
    for words, value, _ in one.measures.rows():
        assert words in text
        assert f"{value:.5g}" in text
    assert rule.startswith("The ground begins at rest; 1 g is 9.80665 m/s^2")


def test_several_records_are_a_row_each() -> None:
    found = [described(hut(component=name)) for name in ("090", "a name of the component " * 4)]
    text = printed(print_table, found)
    assert fits(text)
    row = next(line for line in text.splitlines() if "090" in line)
    measures = found[0].measures
    assert row.split()[2:4] == ["601", "0.02"]
    assert f"{measures.pga_g:.4f}" in row
    assert f"{measures.significant_5_95_s:.2f}" in row
