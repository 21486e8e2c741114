"""Files of ESM: values, header and units, and what is refused."""

import re
from datetime import UTC, datetime
from pathlib import Path

import pytest

from rocksteady.errors import RecordFileError
from tests.every import every
from tests.records import refused
from tests.records.formats.networks import CM, close, read
from tests.records.writers import esm


def test_esm(tmp_path: Path) -> None:
    (found,) = read(tmp_path, esm(CM))
    close(found, CM, 5e-7)
    assert (found.format, found.units_in_file, found.record.dt_s) == ("esm-ascii", "cm/s^2", 0.005)
    assert (found.station, found.event) == ("HUT", "EM-1")
    assert (found.component, found.orientation, found.azimuth_deg) == ("HNE", "horizontal", 90.0)
    assert found.start_time == datetime(2019, 7, 28, 16, 9, 19, 870000, tzinfo=UTC)
    assert found.warnings == ()


def test_esm_in_other_units_and_with_many_values_in_a_line(tmp_path: Path) -> None:
    text = esm(CM, UNITS="m/s^2")
    head, _, _ = text.partition("USER2: \n")
    in_m = [f"{0.01 * value:.8f}" for value in CM]
    lines = "\n".join(" ".join(in_m[at : at + 6]) for at in range(0, len(in_m), 6))
    (found,) = read(tmp_path, f"{head}USER2: \n{lines}\n")
    close(found, CM, 1e-4)
    assert (found.units_in_file, found.warnings) == ("m/s^2", ())


def test_esm_of_another_quantity_is_refused(tmp_path: Path) -> None:
    for given in ({}, {"units": "gal"}):
        with refused(
            "velocity", "line 10, 'DATA_TYPE: VELOCITY': .*: velocity, and the base moves"
        ):
            read(tmp_path, esm(CM, data_type="VELOCITY"), **given)


@every(
    ("units", "kind"),
    [("cm/s^2 * 10", ""), ("cm/s", "velocity"), ("counts", "counts"), ("G/CM", "")],
)
def test_esm_units_are_understood_as_a_whole(tmp_path: Path, units: str, kind: str) -> None:
    words = f"its numbers are in {units}: {kind}, and" if kind else "is not understood; give units"
    with refused(kind, words):
        read(tmp_path, esm(CM, UNITS=units))
    with pytest.raises(RecordFileError, match="a factor on the samples is stated"):
        read(tmp_path, esm(CM).replace("USER1: /", "SCALE_FACTOR: 2.0\nUSER1: /"))


def test_esm_counts(tmp_path: Path) -> None:
    with pytest.raises(RecordFileError, match="403 samples are read so far, and line 6 states 404"):
        read(tmp_path, esm(CM, NDATA="404"))
    (found,) = read(tmp_path, esm(CM, NDATA="400"))
    assert len(found.record.acceleration_m_s2) == 400
    assert "left out" in found.warnings[0]
    (whole,), (table,) = read(tmp_path, esm(CM)), read(tmp_path, esm(CM, NDATA="many"))
    assert (table.record, table.format) == (whole.record, "columns")
    assert re.match("it is read as a table: line 6, .* a whole number", table.warnings[0])
    with refused("", "line 6, 'NDATA: many': it must state a whole number, once"):
        read(tmp_path, esm(CM, NDATA="many"), format="esm-ascii")


def test_a_peak_that_is_not_the_headers_is_a_warning(tmp_path: Path) -> None:
    (found,) = read(tmp_path, esm(CM).replace("PGA_CM/S^2: 150.0", "PGA_CM/S^2: -140.0"))
    assert found.warnings == ("its peak is 1.5 m/s^2, and the header states 1.4 m/s^2",)


def test_esm_keys_that_are_missing_or_of_another_form(tmp_path: Path) -> None:
    for old, new, fields in (
        ("STATION_CODE: HUT", "STATION_NAME: Shed", {"station": "Shed"}),
        ("STATION_CODE: HUT", "STATION_CODE: ", {"station": None}),
        ("EVENT_ID: EM-1", "EVENT_ID: ", {"event": "SOMEWHERE"}),
        ("STREAM: HNE", "STREAM: ", {"component": None, "orientation": "unknown"}),
        ("160919.870", "160919", {"start_time": datetime(2019, 7, 28, 16, 9, 19, tzinfo=UTC)}),
        ("160919.870", "noon", {"start_time": None}),
        ("PGA_CM/S^2: ", "PGA_: ", {"stated_peak_m_s2": None, "warnings": ()}),
        ("PGA_CM/S^2: ", "PGA_CM/S^2: x", {"stated_peak_m_s2": None, "warnings": ()}),
        ("DURATION_S: 2.015", "DURATION_S: ", {"warnings": ()}),
        ("DURATION_S: 2.015", "DURATION_S: 2.01", {"warnings": ()}),
        ("DURATION_S: 2.015", "DURATION_S: 2", {"warnings": ()}),
        ("DATA_TYPE: ACCELERATION", "DATA_TYPE: ", {"warnings": ()}),
        ("DATA_TYPE: ACCELERATION", "data type: acceleration", {"warnings": ()}),
    ):
        text = esm(CM)
        assert old in text
        (result,) = read(tmp_path, text.replace(old, new))
        assert {name: getattr(result, name) for name in fields} == fields, new
    for wrong, dt_s, doubts in (("3.000", None, 1), ("1.900", None, 1), ("3.000", 0.005, 1)):
        text = esm(CM, DURATION_S=wrong)
        given = {} if dt_s is None else {"dt_s": dt_s}
        assert len(read(tmp_path, text, **given)[0].warnings) == doubts, wrong
    for key in ("NDATA", "SAMPLING_INTERVAL_S"):
        with pytest.raises(
            RecordFileError, match=f"its header does not state {key}; fetch the fil"
        ):
            read(tmp_path, esm(CM).replace(f"{key}:", "X:"), format="esm-ascii")
