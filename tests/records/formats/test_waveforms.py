"""miniSEED and SAC through ObsPy, and what is said where ObsPy is missing."""

import contextlib
import struct
import sys
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady.errors import RecordFileError
from rocksteady.records import read_recordings
from rocksteady.records.formats.waveforms import recognised
from tests.records import refused
from tests.records.writers import samples


@pytest.fixture
def obspy() -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of what ObsPy itself imports
        return pytest.importorskip("obspy", reason="the extra records (obspy) is not installed")


def stream(obspy: Any, dtype: str = "float32", channels: str = "ENZ") -> Any:
    traces = []
    for at, letter in enumerate(channels):
        header = {"network": "XX", "station": "HUT", "channel": f"HN{letter}", "delta": 0.01}
        header["starttime"] = obspy.UTCDateTime(2020, 1, 2, 3, 4, 5)
        values = samples(500, seed=at) * (1000 if dtype == "int32" else 1)
        traces.append(obspy.Trace(values.astype(dtype), header=header))
    return obspy.Stream(traces)


@pytest.mark.parametrize("dtype", ["float32", "float64", "int32"])
def test_miniseed(obspy: Any, tmp_path: Path, dtype: str) -> None:
    path = tmp_path / "hut.bin"
    written = stream(obspy, dtype)
    written.write(str(path), format="MSEED")
    with pytest.raises(RecordFileError, match=r"XX\.HUT\.\.HNE holds .*give units"):
        read_recordings(path)
    found = read_recordings(path, units="cm/s^2")
    assert [one.component for one in found] == ["HNE", "HNN", "HNZ"]
    assert [one.orientation for one in found] == ["horizontal", "horizontal", "vertical"]
    for one, trace in zip(found, written, strict=True):
        np.testing.assert_allclose(one.record.acceleration_m_s2, 0.01 * trace.data.astype(float))
        assert (one.format, one.station, one.record.dt_s) == ("mseed", "XX.HUT", 0.01)
        assert one.start_time is not None
        assert one.start_time.isoformat() == "2020-01-02T03:04:05+00:00"


@pytest.mark.parametrize("byteorder", ["<", ">"])
def test_sac(obspy: Any, tmp_path: Path, byteorder: str) -> None:
    path = tmp_path / "hut.bin"
    trace = stream(obspy, channels="N")[0]
    trace.stats.sac = {"cmpinc": 90.0, "cmpaz": 35.0}
    trace.write(str(path), format="SAC", byteorder=byteorder)
    (found,) = read_recordings(path, units="m/s^2")
    assert (found.format, found.orientation, found.azimuth_deg) == ("sac", "horizontal", 35.0)
    np.testing.assert_allclose(found.record.acceleration_m_s2, trace.data, rtol=1e-7)
    assert found.record.dt_s == pytest.approx(0.01, rel=1e-6)
    data = path.read_bytes()
    assert (recognised(data[:632]), recognised(data[:636])) == (None, "sac")  # a header alone
    trace.stats.sac["idep"] = 7
    trace.write(str(path), format="SAC", byteorder=byteorder)
    with refused("velocity", "its header states IDEP: velocity, and the base moves"):
        read_recordings(path, units="m/s^2")


def test_gaps_are_refused(obspy: Any, tmp_path: Path) -> None:
    path = tmp_path / "hut.bin"
    first, second = stream(obspy, channels="NN")
    second.stats.starttime += 60
    obspy.Stream([first, second]).write(str(path), format="MSEED")
    with pytest.raises(RecordFileError, match="comes in 2 pieces, with gaps"):
        read_recordings(path, units="m/s^2")


@pytest.mark.slow
@pytest.mark.parametrize("format_name", ["MSEED", "SAC"])
def test_files_that_are_cut_or_garbled(
    obspy: Any, tmp_path: Path, format_name: str, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "hut.bin"
    stream(obspy, channels="N").write(str(path), format=format_name)
    whole = path.read_bytes()
    rng = np.random.default_rng(5)
    for at in range(200):
        data = bytearray(whole[: rng.integers(len(whole) // 4, len(whole) + 1)])
        for place in rng.integers(8, len(data), at % 13):
            data[place] = rng.integers(256)
        path.write_bytes(bytes(data))
        # Whatever ObsPy makes of it: samples, or its complaint as an error of ours.
        with contextlib.suppress(RecordFileError):
            for one in read_recordings(path, units="m/s^2"):
                assert np.isfinite(one.record.acceleration_m_s2).all()
    assert capfd.readouterr() == ("", "")


def test_without_obspy_the_extra_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "obspy", None)
    path = tmp_path / "hut.mseed"
    path.write_bytes(b"000001D HUT    HNZXX" + bytes(500))
    with pytest.raises(RecordFileError, match=r"pip install 'rocksteady\[records\]'"):
        read_recordings(path)
    with pytest.raises(RecordFileError, match=r"pip install 'rocksteady\[records\]'"):
        read_recordings(path, format="sac")


def test_bytes_by_which_a_format_is_known() -> None:
    head = b"000001D HUT    HNZXX".ljust(48, b"\x00")
    for data, name in (
        *((head, "mseed"), (head[:47], None), (b"MS\x03", "mseed"), (b"MS\x02", None), (b"", None)),
        *((b"      R ".ljust(48), "mseed"), (head.replace(b"D", b"Q"), "mseed")),
        *((head.replace(b"D", b"M"), "mseed"), (head.replace(b"D", b"X"), None)),
        *((head.replace(b"D ", b"D\x00"), "mseed"), (head.replace(b"D ", b"Dx"), None)),
        *((b"x" + head[1:], None), (head[:5] + b"x" + head[6:], None)),
    ):
        assert recognised(data) == name, data
    for version, order, size, name in (
        *((6, "<", 633, "sac"), (7, "<", 633, "sac"), (6, ">", 633, "sac"), (7, ">", 633, "sac")),
        *((5, "<", 633, None), (8, ">", 633, None), (6, "<", 632, None), (6, "<", 700, "sac")),
    ):
        packed = b"y" * 304 + struct.pack(f"{order}i", version)
        assert recognised(packed.ljust(size, b"y")) == name, (version, order, size)


def test_what_a_header_of_sac_states(obspy: Any, tmp_path: Path) -> None:
    path = tmp_path / "hut.sac"
    for fields, expected in (
        ({"cmpinc": 0.0, "cmpaz": 10.0}, ("vertical", None)),
        ({"cmpinc": 180.0}, ("vertical", None)),
        ({"cmpinc": 90.0, "cmpaz": 370.0}, ("horizontal", 10.0)),
        ({"cmpinc": 90.0}, ("horizontal", None)),
        ({"cmpinc": 45.0, "cmpaz": 10.0}, ("unknown", None)),
        ({}, ("unknown", None)),
        ({"idep": 8}, ("unknown", None)),
        ({"idep": 6}, "displacement"),
        ({"idep": 7}, "velocity"),
    ):
        trace = stream(obspy, channels="3")[0]
        trace.stats.sac = fields
        trace.write(str(path), format="SAC")
        if isinstance(expected, str):
            with refused(expected, f"its header states IDEP: {expected}, and the base"):
                read_recordings(path, units="m/s^2")
            continue
        (result,) = read_recordings(path, units="m/s^2")
        assert (result.orientation, result.azimuth_deg) == expected, fields
        sign = -1.0 if fields.get("cmpinc") == 180.0 else 1.0
        np.testing.assert_allclose(result.record.acceleration_m_s2, sign * trace.data, rtol=1e-6)
    stream(obspy, channels="3").write(str(path), format="MSEED")
    with pytest.raises(
        RecordFileError, match="holds numbers whose unit the file does not state; c"
    ):
        read_recordings(path)
