"""Which way a vertical channel points, by codes, words and names, and what belongs to it."""

import struct
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rocksteady.records import RecordSet, pair_records, read_recordings
from rocksteady.records.core.directions import pointing, pointing_of_name, tells_nothing
from rocksteady.records.pairing import pair_doubts
from tests.every import every
from tests.records import ABSENT, FOLDER
from tests.records.writers import (
    at2,
    cosmos_channel,
    csmip_v2_channel,
    csv,
    esm,
    knet,
    samples,
    smc,
)

CM = samples(403, peak=150.0)
COUNTS = np.rint(1e5 * samples(800)).astype(np.int64)
DOWN = [
    *("DWN", "Down", "dn", "D", "down", "acc_dwn", "Acc down", "Vert Down", "Vertical (Down)"),
    *("Z, positive down", "vertical, positive downwards", "HNZ (down)", "negative up"),
]
UP = ["UP", "Up", "u", "upwards", "acc_up", "vertical, positive upwards"]
NO_SENSE = ["U-D", "UD", "up-down", "V", "vert", "HNZ", "BLZ", "acc_z"]


@every(("names", "down"), [(DOWN, True), (UP, False), (NO_SENSE, None)])
def test_words(names: list[str], down: bool | None) -> None:
    for name in names:
        found = pointing(name)
        assert (found.orientation, found.down) == ("vertical", down), name


@every(
    "name",
    [
        *("D-U", "-U-D", "DU", "-UD", "UD-", "Z-", "-Z", "-UP", "-DWN", "Down-Up", "acc -UD"),
        *("UP (positive down)", "UPSIDE DOWN", "not up", "DWN (positive upwards)"),
        *("DOWN (reversed)", "U-D (inverted)", "vertical (reversed)"),
    ],
)
def test_a_sense_that_is_not_understood_as_a_whole(tmp_path: Path, name: str) -> None:
    for file, text in (
        ("hut.UD", knet(COUNTS, direction=name)),
        ("hut.AT2", at2(samples(), component=name)),
    ):
        (tmp_path / file).write_text(text)
        (found,) = read_recordings(tmp_path / file)
        assert f"{name!r}, of which the vertical sense is not understood" in found.warnings[0]
        assert not any("sign changed" in note for note in found.processing)


@every("name", ["U-D (down positive)", "Acc UD down positive", "DWN (positive down)", "-"])
def test_a_sense_in_more_words(name: str) -> None:
    assert pointing(name).down is (True if name != "-" else None)
    assert not pointing(name).unclear


@every("name", ["down hole NS", "backup", "090", "updated", "HNZ"])
def test_no_sense_is_seen_in_other_words(name: str) -> None:
    assert not pointing(name).unclear


def test_a_file_of_knet_whose_direction_is_damaged(tmp_path: Path) -> None:
    path = tmp_path / "hut.txt"
    for damaged in ("Dr.", "ir."):
        path.write_text(knet(COUNTS, direction="U-D").replace("Dir.", damaged))
        (found,) = read_recordings(path)
        assert "no line 'Dir.'" in found.warnings[0]


def test_names_of_files() -> None:
    for name in ("RSN77_SFERN_PULDWN", "a-DWN", "a_DOWN", "a.down", "PULDOWN", "pul-dn"):
        assert pointing_of_name(name).down is True, name
    for name in ("RSN6_ELC-UP", "A_up", "up"):
        assert pointing_of_name(name).down is False, name
    for name in ("backup", "setup", "meltdown", "record_001", "AZF225"):
        assert pointing_of_name(name).orientation is None, name


def smc_of(vertical: int, component: str = "360") -> str:
    text = smc(CM, angles=(vertical, 0))
    return text.replace("component=    360", f"component=    {component}")


FILES = {
    "peer": (at2(samples(), component="DWN"), at2(samples(), component="UP")),
    "peer, Down": (at2(samples(), component="Down"), at2(samples(), component="up")),
    "esm": (esm(CM, STREAM="DOWN"), esm(CM, STREAM="HNZ")),
    "cosmos": (
        cosmos_channel(CM, raw_dt=0.01, azimuth=401, label="Down"),
        cosmos_channel(CM, raw_dt=0.01, azimuth=400),
    ),
    "cosmos, no sense": (
        cosmos_channel(CM, raw_dt=0.01, azimuth=402, label="Down"),
        cosmos_channel(CM, raw_dt=0.01, azimuth=402, label="Vertical"),
    ),
    "cosmos, other code": (
        cosmos_channel(CM, raw_dt=0.01, azimuth=-999, label="Down"),
        cosmos_channel(CM, raw_dt=0.01, azimuth=-999, label="Up"),
    ),
    "csmip": (csmip_v2_channel(CM, name="Down"), csmip_v2_channel(CM, name="Up")),
    "smc": (smc_of(180, "Down"), smc_of(0, "Up")),
    "knet": (knet(COUNTS, direction="DOWN"), knet(COUNTS, direction="U-D")),
    "csv": (
        csv(samples()).replace("acc (g)", "acc_dwn (g)"),
        csv(samples()).replace("acc (g)", "acc_up (g)"),
    ),
    "csv, in brackets": (
        csv(samples()).replace("acc (g)", "acc (down) (g)"),
        csv(samples()).replace("acc (g)", "acc (up) (g)"),
    ),
}


@every("name", FILES)
def test_every_reader_turns_what_is_positive_downwards(tmp_path: Path, name: str) -> None:
    paths = [tmp_path / "first.txt", tmp_path / "second.txt"]
    for path, text in zip(paths, FILES[name], strict=True):
        path.write_text(text)
    (turned,), (plain,) = map(read_recordings, paths)
    np.testing.assert_array_equal(turned.record.acceleration_m_s2, -plain.record.acceleration_m_s2)
    assert [one.orientation for one in (turned, plain)] == ["vertical"] * 2
    assert [one.warnings for one in (turned, plain)] == [(), ()]
    assert turned.processing[-1].startswith("sign changed: ")
    assert "is positive downwards" in turned.processing[-1]
    assert not any("sign" in note for note in plain.processing)


@every("end", ["-DWN", "_DOWN", "DWN", ".down", "_dn"])
def test_the_name_of_a_file_that_states_nothing(tmp_path: Path, end: str) -> None:
    (tmp_path / f"HUT{end}.txt").write_text("1.0\n-2.5\n0.5\n")
    (found,) = read_recordings(tmp_path / f"HUT{end}.txt", units="m/s^2", dt_s=0.01)
    assert found.record.acceleration_m_s2.tolist() == [-1.0, 2.5, -0.5]
    assert "file's name alone" in found.warnings[0]
    # The name of a file with several columns is that of none of them.
    text = "t,ax,ay\n" + "".join(f"{0.01 * n:.2f},{n},{-n}\n" for n in range(9))
    (tmp_path / f"HUT{end}.txt").write_text(text)
    first, _ = read_recordings(tmp_path / f"HUT{end}.txt", units="m/s^2")
    assert first.record.acceleration_m_s2[3] == 3.0


@every(("end", "component"), [("-DWN", "DWN"), ("-up", "UP"), ("-DWN", "vert"), ("-UD", "DWN")])
def test_a_name_that_agrees_with_the_header_is_not_doubted(
    tmp_path: Path, end: str, component: str
) -> None:
    path = tmp_path / f"HUT{end}.AT2"
    path.write_text(at2(samples(), component=component))
    assert read_recordings(path)[0].warnings == ()


def test_the_header_goes_before_the_name_of_the_file(tmp_path: Path) -> None:
    for end, component, sign, words in (
        ("-up", "DWN", -1.0, "name states upwards, and its header downwards (DWN)"),
        ("-DWN", "UP", 1.0, "name states downwards, and its header upwards (UP)"),
        ("-UP", "090", 1.0, "name states vertical, and its header horizontal (090)"),
    ):
        path = tmp_path / f"HUT{end}.AT2"
        path.write_text(at2(samples(), component=component))
        (found,) = read_recordings(path)
        assert words in found.warnings[0]
        first = found.record.acceleration_m_s2[5] / samples()[5]
        assert first == pytest.approx(sign * 9.80665, rel=1e-6)


@every(
    ("azimuth", "label", "words"),
    [
        (400, "340 deg", "'340 deg', horizontal, and its code in the header states vertical"),
        (340, "Up", "'Up', vertical, and its code in the header states horizontal"),
        (400, "Down", "'Down', downwards, and its code in the header states upwards"),
        (401, "Up", "'Up', upwards, and its code in the header states downwards"),
        (90, "360 deg", "'360 deg', 0 deg, and its code in the header states 90 deg"),
    ],
)
def test_a_label_that_contradicts_its_code(
    tmp_path: Path, azimuth: int, label: str, words: str
) -> None:
    path = tmp_path / "hut.v2"
    path.write_text(cosmos_channel(CM, raw_dt=0.01, azimuth=azimuth, label=label))
    (found,) = read_recordings(path)
    assert words in found.warnings[0]
    assert found.orientation == ("vertical" if azimuth >= 400 else "horizontal")
    assert found.record.acceleration_m_s2[5] * CM[5] * (1.0 if azimuth != 401 else -1.0) > 0.0


def test_an_smc_label_that_contradicts_its_angle(tmp_path: Path) -> None:
    path = tmp_path / "hut.smc"
    path.write_text(smc_of(180, "Up"))
    assert "'Up', upwards, and its code" in read_recordings(path)[0].warnings[0]


def test_sac_by_its_angle_from_upwards(tmp_path: Path) -> None:
    obspy = pytest.importorskip("obspy")
    path = tmp_path / "hut.sac"
    trace = obspy.Trace(data=samples(200).astype("f4"), header={"delta": 0.01, "channel": "HNZ"})
    trace.write(str(path), format="SAC")
    data = bytearray(path.read_bytes())
    found = []
    for angle in (0.0, 180.0):
        data[58 * 4 : 59 * 4] = struct.pack("<f", angle)  # CMPINC
        path.write_bytes(bytes(data))
        found.append(read_recordings(path, units="g")[0])
    up, down = found
    np.testing.assert_array_equal(down.record.acceleration_m_s2, -up.record.acceleration_m_s2)
    assert (up.processing, len(down.processing)) == ((), 1)


def test_what_does_not_belong_is_named(tmp_path: Path) -> None:
    first, second = tmp_path / "a.AT2", tmp_path / "b.AT2"
    first.write_text(at2(samples()))
    other = at2(samples(300), 0.005, component="DWN")
    second.write_text(other.replace("Hut", "Shed").replace("1/17/1994", "1/18/1994"))
    (across,), (up,) = map(read_recordings, (first, second))
    words = "; ".join(pair_doubts(across, up))
    for part in ("1/17/1994", "1/18/1994", "Shed", "0.005, 0.01 s", "300 to 403 samples"):
        assert part in words
    assert pair_doubts(across, replace(across, component="UP", orientation="vertical")) == ()
    wrong = "; ".join(pair_doubts(up, across))
    assert "b.AT2 (DWN) is vertical, in the place of a horizontal channel" in wrong
    assert "a.AT2 (090) is horizontal, in the place of a vertical channel" in wrong
    by_hand = RecordSet(name="two", horizontal=(across,), vertical=up)
    assert by_hand.warnings == pair_doubts(across, up)


def test_starts_that_differ_are_named(tmp_path: Path) -> None:
    first, second = tmp_path / "a.asc", tmp_path / "b.asc"
    first.write_text(esm(CM))
    second.write_text(esm(CM, STREAM="HNZ").replace("160919.870", "160921.870"))
    (across,), (up,) = map(read_recordings, (first, second))
    assert pair_doubts(across, up) == ("starts up to 2 s apart",)
    (both,) = pair_records([first, second])
    assert both.warnings == ("starts up to 2 s apart",)


def test_real_files_of_pacoima_dam() -> None:
    paths = sorted((FOLDER / "peer_at2").glob("RSN77_*"))
    if len(paths) != 3:
        pytest.skip(ABSENT)
    (found,) = pair_records(paths)
    assert found.vertical is not None
    assert found.vertical.component == "DWN"
    assert found.vertical.processing
    filed = np.array(" ".join(paths[2].read_text().splitlines()[4:]).split(), dtype=np.float64)
    np.testing.assert_array_equal(found.vertical.record.acceleration_m_s2, -filed * 9.80665)


def test_an_azimuth_has_360_degrees_at_most() -> None:
    degrees = {"0": 0.0, "359": 359.0, "360": 0.0, "360.5": None, "361": None}
    assert {text: pointing(text).azimuth_deg for text in degrees} == degrees


def test_a_sense_is_turned_by_a_negative_word_once() -> None:
    unclear = ("vertical", None, True)
    for name, expected in (
        *(("negative down", ("vertical", False, False)), ("minus up", ("vertical", True, False))),
        *(("neg vertical", unclear), ("negative up down", unclear), ("up down", unclear)),
        *(("vertical (-z)", unclear), ("z- vertical", unclear), ("positive up", ("v", False, 0))),
        *(("hnz up", ("vertical", False, False)), ("hlz", ("vertical", None, False))),
        ("vertical up positive", ("vertical", False, False)),
        *(("up wobbled", ("", None, True)), ("up 090", ("", None, False))),
        *(("wobbled", ("", None, False)), ("negative", ("", None, False)), ("", ("", None, False))),
        *(("dwn vertical", ("vertical", True, False)), ("u-d (u-d)", ("vertical", None, False))),
    ):
        result = pointing(name)
        orientation = "vertical" if expected[0] else None
        assert (result.orientation, result.down, result.unclear) == (
            *(orientation, expected[1], bool(expected[2])),
        ), name


def test_directions_by_compass_quadrant_and_degrees() -> None:
    azimuth: float | None
    for name, azimuth in (
        *(("n", 0.0), ("s", 180.0), ("e", 90.0), ("w", 270.0), ("west", 270.0), ("south", 180.0)),
        *(("N30E", 30.0), ("n 30.5 deg e", 30.5), ("S30E", 150.0), ("S30W", 210.0), ("N0W", 0.0)),
        *(("N90W", 270.0), ("s0e", 180.0), ("H045", 45.0), ("n045", 45.0), ("45 degrees", 45.0)),
        *(("12.5", 12.5), ("10", 10.0), ("4", 4.0), ("360.0", 0.0), ("359.5", 359.5)),
    ):
        result = pointing(name)
        assert (result.orientation, result.azimuth_deg) == ("horizontal", azimuth), name
    for name, azimuth in (("HNN", 0.0), ("hne", 90.0), ("BLX", None), ("hn2", None), ("HGT", None)):
        result = pointing(f"channel {name}")
        assert (result.orientation, result.azimuth_deg) == ("horizontal", azimuth), name
    for name in ("1", "2", "3", "361", "1000", "h45", "HN3", "channel", "x", "HNQ", "sensor x"):
        result = pointing(name)
        assert (result.orientation, result.azimuth_deg) == (None, None), name
    # A word beside the direction that states none is left out; a letter alone stays unknown.
    for name, azimuth in (("comp 090", 90.0), ("acc NS", 0.0), ("comp 5", None), ("acc n", None)):
        assert pointing(name).azimuth_deg == azimuth, name


def test_directions_of_files_that_can_mean_nothing_else() -> None:
    for stem, orientation, down in (
        *(("up", "vertical", False), ("UP", "vertical", False), ("v", None, None)),
        *(("z", None, None), ("u", None, None), ("ud", "vertical", None), ("dn", "vertical", True)),
        *(
            ("a-h1", "horizontal", None),
            ("a_hor2", "horizontal", None),
            ("a-N", "horizontal", None),
        ),
        *(("a.z", "vertical", None), ("A_090", None, None), ("A090", None, None)),
        *(("startup", None, None), ("STAUP", "vertical", False), ("staUP", "vertical", False)),
        *(("a HNZ", "vertical", None), ("a-hne", "horizontal", None), ("x", None, None)),
        *(("a-V", "vertical", None), ("slowdown", None, None), ("puldwn", "vertical", True)),
    ):
        result = pointing_of_name(stem)
        assert (result.orientation, result.down) == (orientation, down), stem


def test_names_without_a_word_of_direction() -> None:
    for name, nothing in (
        *((None, True), ("", True), ("acc 1", True), ("channel 12 (time)", True), ("ch-3", True)),
        *(("hut", False), ("acc up", False), ("1a", False), ("x", False)),
    ):
        assert tells_nothing(name) == nothing, name
