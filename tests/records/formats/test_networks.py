"""Files of the networks: values, headers and units of each format, and what each one refuses."""

from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from rocksteady import RecordFileError, Recording, read_recordings
from tests.records.writers import (
    cosmos_channel,
    csmip_v2_channel,
    esm,
    knet,
    rows,
    samples,
    smc,
)

CM = samples(403, peak=150.0)


def read(tmp_path: Path, text: str, **given: float | str) -> tuple[Recording, ...]:
    path = tmp_path / "hut.txt"
    path.write_text(text)
    return read_recordings(path, **given)  # type: ignore[arg-type]


def close(recording: Recording, in_cm: np.ndarray, half_digit: float) -> None:
    np.testing.assert_allclose(
        recording.record.acceleration_m_s2, 0.01 * in_cm, rtol=1e-12, atol=0.0101 * half_digit
    )
    if recording.stated_peak_m_s2 is not None:
        assert recording.record.peak_acceleration_m_s2 == pytest.approx(
            recording.stated_peak_m_s2, rel=1e-3
        )


# ------------------------------------------------------------------------------------ ESM


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
    with pytest.raises(RecordFileError, match=r"line 10, 'DATA_TYPE: VELOCITY': the base moves"):
        read(tmp_path, esm(CM, data_type="VELOCITY"))


@pytest.mark.parametrize("units", ["cm/s^2 * 10", "cm/s", "counts", "G/CM"])
def test_esm_units_are_understood_as_a_whole(tmp_path: Path, units: str) -> None:
    with pytest.raises(RecordFileError, match="is none of acceleration; give units"):
        read(tmp_path, esm(CM, UNITS=units))
    with pytest.raises(RecordFileError, match="a factor on the samples is stated"):
        read(tmp_path, esm(CM).replace("USER1: /", "SCALE_FACTOR: 2.0\nUSER1: /"))


def test_esm_counts(tmp_path: Path) -> None:
    with pytest.raises(RecordFileError, match="403 samples are read so far, and line 6 states 404"):
        read(tmp_path, esm(CM, NDATA="404"))
    (found,) = read(tmp_path, esm(CM, NDATA="400"))
    assert len(found.record.acceleration_m_s2) == 400
    assert "left out" in found.warnings[0]
    with pytest.raises(RecordFileError, match="whole number"):
        read(tmp_path, esm(CM, NDATA="many"))


def test_a_peak_that_is_not_the_headers_is_a_warning(tmp_path: Path) -> None:
    (found,) = read(tmp_path, esm(CM).replace("PGA_CM/S^2: 150.0", "PGA_CM/S^2: -140.0"))
    assert found.warnings == ("its peak is 1.5 m/s^2, and the header states 1.4 m/s^2",)


# ---------------------------------------------------------------------------- K-NET, KiK-net


def counts_of(in_cm: np.ndarray, offset: int = -12085) -> np.ndarray:
    return np.rint(in_cm * 6182761 / 3920).astype(np.int64) + offset


@pytest.mark.parametrize("offset", [0, -12085, 13190])
def test_knet_takes_the_offset_off_and_says_so(tmp_path: Path, offset: int) -> None:
    in_cm = samples(800, peak=4.0)
    in_cm -= in_cm.mean()
    stated = f"{np.abs(in_cm).max():.3f}"
    (found,) = read(tmp_path, knet(counts_of(in_cm, offset), peak=stated))
    close(found, in_cm, 2e-3)
    assert (found.format, found.units_in_file, found.component) == ("knet", "counts", "N-S")
    assert found.start_time == datetime(2018, 1, 24, 10, 51, 28, tzinfo=UTC)
    assert found.warnings == ()
    noted = float(found.processing[0].partition("(")[2].partition(" ")[0])
    assert noted == pytest.approx(offset * 3920 / 6182761 * 0.01, abs=1e-5)


@pytest.mark.parametrize(
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


@pytest.mark.parametrize("key", ["Scale Factor", "Sampling Freq(Hz)", "Duration Time(s)"])
def test_counts_without_their_scale_do_not_pass_for_a_table(tmp_path: Path, key: str) -> None:
    text = knet(counts_of(samples(800)))
    with pytest.raises(RecordFileError, match="its header has no line"):
        read(tmp_path, text.replace(key, key.replace("a", "@").replace("q", "@")))
    assert read(tmp_path, text.upper())[0].record == read(tmp_path, text)[0].record
    with pytest.raises(RecordFileError, match="counts, which is not applied"):
        read(tmp_path, "\n".join(";".join(line.split()) for line in text.splitlines()))


# --------------------------------------------------------------------------------- COSMOS


@pytest.mark.parametrize(
    "form",
    [
        ("{:10.5f}", "8F10.5", 8),
        ("{:15.6E}", "1E15.6", 1),
        ("{:10.5f}", "1F15.6E", 5),
        ("{:9.5f}", "10F9.5", 10),
    ],
)
def test_cosmos(tmp_path: Path, form: tuple[str, str, int]) -> None:
    (found,) = read(tmp_path, cosmos_channel(CM / 2, form=form))
    close(found, CM / 2, 1e-4)
    assert (found.format, found.units_in_file, found.record.dt_s) == ("cosmos-v2", "cm/s^2", 0.01)
    assert (found.azimuth_deg, found.component) == (340.0, "340 deg")
    assert found.station == "CE-J2236  CDMG Hut & Far"
    assert found.start_time == datetime(2005, 6, 16, 20, 53, 4, 400000, tzinfo=UTC)


def test_cosmos_numbers_that_fill_their_columns(tmp_path: Path) -> None:
    # Nothing stands between 100.12345 and 101.12345 but the width of nine.
    values = np.abs(CM) + 100.0
    text = cosmos_channel(values, form=("{:9.5f}", "8F9.5", 8))
    assert f"{values[0]:.5f}{values[1]:.5f}" in text
    (found,) = read(tmp_path, text)
    close(found, values, 5e-6)


def test_cosmos_takes_the_interval_that_fits_the_duration(tmp_path: Path) -> None:
    (found,) = read(tmp_path, cosmos_channel(CM, dt_ms=5.0, raw_dt=0.02))
    assert found.record.dt_s == 0.005
    assert "0.02 s between samples too" in found.warnings[0]
    unknown = cosmos_channel(samples(4000, peak=99.0), dt_ms=-999.0, raw_dt=-999.0)
    (found,) = read(tmp_path, unknown, dt_s=0.01)
    assert found.record.dt_s == 0.01
    with pytest.raises(RecordFileError, match="no interval of its header fits"):
        read(tmp_path, cosmos_channel(CM, dt_ms=-999.0, raw_dt=-999.0))


def test_cosmos_of_several_channels_and_quantities(tmp_path: Path) -> None:
    text = "".join(
        cosmos_channel(factor * CM, azimuth=azimuth, quantity=quantity, channel=at)
        for at, (factor, azimuth, quantity) in enumerate(
            [(1.0, 340, "acceleration"), (0.1, 340, "velocity"), (0.5, 400, "acceleration")], 1
        )
    )
    first, second = read(tmp_path, text)
    close(first, CM, 1e-5)
    close(second, 0.5 * CM, 1e-5)
    assert [one.orientation for one in (first, second)] == ["horizontal", "vertical"]
    assert first.record.name != second.record.name
    with pytest.raises(RecordFileError, match="it holds no acceleration"):
        read(tmp_path, cosmos_channel(CM, quantity="velocity", units="cm/sec(05)"))


def test_cosmos_levels_and_counts(tmp_path: Path) -> None:
    (found,) = read(tmp_path, cosmos_channel(CM, first="Uncorrected acceleration", dt_ms=10.0))
    assert found.format == "cosmos-v1"
    both = read(tmp_path, 2 * cosmos_channel(CM, first="Uncorrected acceleration"))
    assert [one.format for one in both] == ["cosmos-v1", "cosmos-v1"]
    assert both[0].event == both[1].event
    with pytest.raises(RecordFileError, match="instrument's counts"):
        read(tmp_path, cosmos_channel(CM, first="Raw acceleration counts", units="counts (50)"))


@pytest.mark.parametrize("units", ["g(04)", "cm/sec2 x 10(04)", "cm/sec(04)", "V(03)"])
def test_cosmos_units_that_contradict_their_code(tmp_path: Path, units: str) -> None:
    with pytest.raises(RecordFileError, match="is none of acceleration; give units"):
        read(tmp_path, cosmos_channel(CM, units=units))
    (given,) = read(tmp_path, cosmos_channel(CM, units=units), units="gal")
    close(given, CM, 5e-4)


def test_csmip_units_are_understood_as_a_whole(tmp_path: Path) -> None:
    text = csmip_v2_channel(CM)
    for unit in ("cm/sec2 x 10.", "counts.", "cm/sec2 (multiplied by 10)"):
        with pytest.raises(RecordFileError, match="is none of acceleration"):
            read(tmp_path, text.replace("in cm/sec2.", f"in {unit}"))


def test_cosmos_that_is_cut(tmp_path: Path) -> None:
    lines = cosmos_channel(CM).split("\n")
    for kept in (20, 25, 35, 44, 46, 60):
        with pytest.raises(RecordFileError):
            read(tmp_path, "\n".join(lines[:kept]))


# ---------------------------------------------------------------------------------- CSMIP


def test_csmip_volume_2_takes_the_acceleration_of_each_channel(tmp_path: Path) -> None:
    text = csmip_v2_channel(CM) + csmip_v2_channel(2.0 * CM, channel=2, name="Up")
    first, second = read(tmp_path, text)
    close(first, CM, 5e-6)
    close(second, 2.0 * CM, 5e-6)
    assert (first.format, first.component, first.station) == ("csmip-v2", "360 Deg", "Hut")
    assert second.orientation == "vertical"
    assert first.record.dt_s == 0.005
    assert first.start_time == datetime(2012, 2, 13, 21, 6, 45, tzinfo=UTC)


def test_csmip_without_acceleration_is_refused(tmp_path: Path) -> None:
    text = csmip_v2_channel(CM).replace("points of accel data", "points of veloc data")
    with pytest.raises(RecordFileError, match="it holds no acceleration"):
        read(tmp_path, text)


def test_csmip_volume_1(tmp_path: Path) -> None:
    head = csmip_v2_channel(CM).split("\n")[1:8]
    peak = np.abs(CM).max() / 980.665
    words = [*head, "-", "Units of uncor data are sec and g .", f"Max  = {peak:8.5f} g , at 3 sec."]
    numbers = rows(np.arange(100.0), "{:5.0f}", 16) + rows(np.zeros(50), "{:10.6f}", 8)
    line = f" {len(CM)} Accelerogram points at 200 pts/sec in units of g .      Format: (8f9.6)\n"
    text = "\n".join(words) + "\n" + numbers + line + rows(CM / 980.665, "{:9.6f}", 8)
    (found,) = read(tmp_path, text + "/&  ----  End of data for channel  1  ----\n")
    close(found, CM, 5e-4)
    assert (found.format, found.units_in_file, found.record.dt_s) == ("csmip-v1", "g", 0.005)


@pytest.mark.parametrize("even", [True, False])
def test_csmip_volume_1_of_times_and_samples_in_turn(tmp_path: Path, even: bool) -> None:
    times = 0.02 * np.arange(len(CM))
    if not even:
        times[5::7] += 0.007
    head = [
        "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 02/28/94",
        *(["-"] * 8),
        "CHAN  1:  90 DEG",
        f"NO. OF POINTS =  {len(CM)}  RECORD LENGTH =  8.040 SEC",
        "UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  =   .153 G.",
        "-",
    ]
    pairs = np.column_stack([times, CM / 98.0665]).ravel()
    numbers = rows(np.arange(100.0), "{:5.0f}", 16) + rows(np.zeros(50), "{:10.6f}", 8)
    text = "\n".join(head) + "\n" + numbers + rows(pairs, "{:7.3f}", 10) + "----- END\n"
    if not even:
        with pytest.raises(RecordFileError, match=r"line 3\d, .*ask for resampling"):
            read(tmp_path, text)
    (found,) = read(tmp_path, text, resample=not even)
    assert (found.format, found.orientation, found.azimuth_deg) == ("csmip-v1", "horizontal", 90.0)
    assert found.record.dt_s == pytest.approx(0.02, abs=1e-9)
    if even:
        close(found, CM, 0.05)
    else:
        assert "resampled" in found.processing[0]


# ------------------------------------------------------------------------------------ SMC


def test_smc(tmp_path: Path) -> None:
    (found,) = read(tmp_path, smc(CM))
    close(found, CM, 5e-3)
    assert (found.format, found.units_in_file, found.record.dt_s) == ("smc", "cm/s^2", 0.005)
    assert (found.orientation, found.azimuth_deg) == ("horizontal", 0.0)
    assert (found.station, found.event) == ("Hut, 1295 Shafter", "Somewhere, CA")
    assert found.start_time == datetime(1989, 10, 18, 0, 4, 5, 250000, tzinfo=UTC)
    assert found.warnings == ()


def test_smc_vertical_and_without_comments(tmp_path: Path) -> None:
    (found,) = read(tmp_path, smc(CM, comments=0, angles=(0, 0)))
    close(found, CM, 5e-3)
    assert found.orientation == "vertical"


def test_smc_of_times_and_samples_in_turn(tmp_path: Path) -> None:
    times = 0.00149 * np.arange(len(CM))
    times[9::10] += 0.0006
    pairs = np.column_stack([times, CM]).ravel()
    text = smc(pairs, rate=None, first="1 UNCORRECTED ACCELEROGRAM")
    with pytest.raises(RecordFileError, match="ask for resampling"):
        read(tmp_path, text)
    (found,) = read(tmp_path, text, resample=True, dt_s=0.001)
    assert found.record.dt_s == 0.001
    assert found.record.peak_acceleration_m_s2 == pytest.approx(1.5, rel=0.2)


@pytest.mark.parametrize("first", ["3 VELOCITY", "4 DISPLACEMENT", "5 RESPONSE SPECTRA"])
def test_smc_of_another_quantity_is_refused(tmp_path: Path, first: str) -> None:
    with pytest.raises(RecordFileError, match=r"line 1, .*must be an accelerogram"):
        read(tmp_path, smc(CM, first=first))


def test_smc_that_is_cut(tmp_path: Path) -> None:
    lines = smc(CM).split("\n")
    for kept in (12, 16, 20, 28, 40):
        with pytest.raises(RecordFileError):
            read(tmp_path, "\n".join(lines[:kept]))
