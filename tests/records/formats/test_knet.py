"""Files of K-NET and KiK-net: counts, scale and offset, and what is refused."""

from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from rocksteady.errors import RecordFileError
from tests.every import every
from tests.records.formats.networks import close, read
from tests.records.writers import knet, samples


def counts_of(in_cm: np.ndarray, offset: int = -12085) -> np.ndarray:
    return np.rint(in_cm * 6182761 / 3920).astype(np.int64) + offset


@every("offset", [0, -12085, 13190])
def test_knet_takes_the_offset_off_and_says_so(tmp_path: Path, offset: int) -> None:
    in_cm = samples(800, peak=4.0)
    in_cm -= in_cm.mean()
    stated = f"{np.abs(in_cm).max():.3f}"
    (found,) = read(tmp_path, knet(counts_of(in_cm, offset), peak=stated))
    close(found, in_cm, 2e-3)
    assert (found.format, found.units_in_file, found.component) == ("knet", "counts", "N-S")
    assert found.position == "surface"
    roof = knet(counts_of(in_cm)).replace("Memo.", "Memo.             on the roof")
    assert read(tmp_path, roof)[0].position == "structure"
    assert found.start_time == datetime(2018, 1, 24, 10, 51, 28, tzinfo=UTC)
    assert found.warnings == ()
    noted = float(found.processing[0].partition("(")[2].partition(" ")[0])
    assert noted == pytest.approx(offset * 3920 / 6182761 * 0.01, abs=1e-5)


@every(
    ("direction", "component", "place"),
    [("1", "N-S", "borehole"), ("3", "U-D", "borehole"), ("5", "E-W", "surface")],
)
def test_kiknet(tmp_path: Path, direction: str, component: str, place: str) -> None:
    (found,) = read(tmp_path, knet(counts_of(samples(800)), direction=direction))
    assert (found.format, found.component) == ("kiknet", component)
    assert found.station == f"AOM001 {place}"


def test_knet_that_is_cut_or_has_no_scale_is_refused(tmp_path: Path) -> None:
    text = knet(counts_of(samples(800)))
    with pytest.raises(RecordFileError, match=r"792 samples are read .*line 12 states 800"):
        read(tmp_path, "\n".join(text.split("\n")[:-2]))
    with pytest.raises(RecordFileError, match=r"line 14, .*scale of the counts"):
        read(tmp_path, text.replace("3920(gal)/6182761", "3920/0"))
    for scale in ("0.3920(gal)/618.2761", "0.0003920(gal)/0.6182761"):
        (found,) = read(tmp_path, text.replace("3920(gal)/6182761", scale))
        close(found, samples(800) - samples(800).mean(), 2e-3)
    for scale in (
        "-3920(gal)/6182761",
        "3920(gal)/-6182761",
        "3920(mgal)/6182761",
        "x 3920(gal)/1",
    ):
        with pytest.raises(RecordFileError, match=r"line 14, .*scale of the counts"):
            read(tmp_path, text.replace("3920(gal)/6182761", scale))
    with pytest.raises(RecordFileError, match=r"line 11, .*unit of time"):
        read(tmp_path, text.replace("100Hz", "100 baud"))
    with pytest.raises(RecordFileError, match=r"line 11, .*above 0"):
        read(tmp_path, text.replace("100Hz", "Hz"))


@every("key", ["Scale Factor", "Sampling Freq(Hz)", "Duration Time(s)"])
def test_counts_without_their_scale_do_not_pass_for_a_table(tmp_path: Path, key: str) -> None:
    text = knet(counts_of(samples(800)))
    with pytest.raises(RecordFileError, match="its header has no line"):
        read(tmp_path, text.replace(key, key.replace("a", "@").replace("q", "@")))
    assert read(tmp_path, text.upper())[0].record == read(tmp_path, text)[0].record
    with pytest.raises(RecordFileError, match="counts, which is not applied"):
        read(tmp_path, "\n".join(";".join(line.split()) for line in text.splitlines()))


def test_knet_scales_that_are_no_size(tmp_path: Path) -> None:
    text = knet(counts_of(samples(800)))
    for scale in ("0(gal)/6182761", "3920(gal)/0", "0.0(gal)/0"):
        with pytest.raises(
            RecordFileError, match=r"line 14, .*scale of the counts, above 0; it read"
        ):
            read(tmp_path, text.replace("3920(gal)/6182761", scale))
    for scale, size in (("1(gal)/1", 1.0), ("0.5 (GAL) / 2", 0.25), ("2(gal)/0.5", 4.0)):
        (result,) = read(tmp_path, text.replace("3920(gal)/6182761", scale), units="gal")
        counts = counts_of(samples(800))
        expected = 0.01 * size * (counts - counts.mean())
        np.testing.assert_allclose(result.record.acceleration_m_s2, expected, atol=1e-9)


def test_knet_words_of_the_header(tmp_path: Path) -> None:
    text = knet(counts_of(samples(800)), peak="1.000")
    (result,) = read(tmp_path, text)
    assert (result.station, result.event) == ("AOM001", "2018/01/24 19:51:00, M 6.2")
    for old, new, fields in (
        ("2018/01/24 19:51:43\nSampling", "2018/01/24\nSampling", {"start_time": None}),
        ("Mag.              6.2", "Mag.", {"event": "2018/01/24 19:51:00"}),
        ("Time       2018/01/24 19:51:00", "Time", {"event": "M 6.2"}),
        ("AOM001", "", {"station": None}),
        ("N-S", "", {"component": None, "orientation": "unknown"}),
        ("N-S", "7", {"component": "7", "format": "knet"}),
        ("N-S", "4", {"component": "N-S", "format": "kiknet", "station": "AOM001 surface"}),
        ("N-S", "6", {"component": "U-D", "format": "kiknet", "station": "AOM001 surface"}),
        ("N-S", "2", {"component": "E-W", "format": "kiknet", "station": "AOM001 borehole"}),
    ):
        assert old in text, old
        (single,) = read(tmp_path, text.replace(old, new))
        assert {name: getattr(single, name) for name in fields} == fields, old
    # More samples than duration and rate state are left out, and both are doubted.
    (more,) = read(tmp_path, text.replace("Duration Time(s)  8", "Duration Time(s)  7"))
    assert "7 s at 100 Hz are 700 samples: see whether duration and rate are right" in more.warnings
