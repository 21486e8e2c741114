"""Channels of one station: which belong together, what differs, and how they are aligned."""

from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady import Record
from rocksteady.errors import InputError
from rocksteady.records import Recording, RecordSet, pair_records, read_recordings
from tests.records import recording
from tests.records.writers import at2, csv, knet, samples

START = datetime(2020, 1, 2, tzinfo=UTC)


def test_pairs_by_what_the_files_say(tmp_path: Path) -> None:
    paths = []
    for end, component in (("x", "090"), ("y", "UP"), ("z", "360")):
        paths.append(tmp_path / f"{end}.AT2")
        paths[-1].write_text(at2(samples(100), component=component))
    (one,) = pair_records(paths)
    assert one.name == "Hut - Far, West, Somewhere-01, 1/17/1994"
    assert [channel.component for channel in one.horizontal] == ["090", "360"]
    assert one.vertical is not None
    assert one.vertical.component == "UP"
    assert one.warnings == ()


def test_pairs_by_the_names_of_files(tmp_path: Path) -> None:
    for stem in ("CHY012-N", "CHY012-W", "CHY012-V", "A-BEN360", "A-BEN270", "A-BEN-UP", "x"):
        (tmp_path / f"{stem}.csv").write_text(csv(samples(100)))
    found = {one.name: one for one in pair_records(sorted(tmp_path.iterdir()))}
    assert sorted(found) == ["A-BEN", "CHY012", "x"]
    for name in ("A-BEN", "CHY012"):
        assert len(found[name].horizontal) == 2
        assert found[name].vertical is not None
    assert len(found["x"].other) == 1


def test_stations_of_one_hole_are_kept_apart(tmp_path: Path) -> None:
    counts = np.rint(1000 * samples(800)).astype(np.int64)
    for at in range(1, 7):
        (tmp_path / f"S.{at}").write_text(knet(counts, direction=str(at)))
    found = pair_records(sorted(tmp_path.iterdir()))
    assert [one.name.split(",")[0] for one in found] == ["AOM001 borehole", "AOM001 surface"]
    assert all(len(one.horizontal) == 2 and one.vertical for one in found)


def test_what_differs_is_said() -> None:
    one = recording(samples(100), orientation="horizontal", azimuth_deg=0.0, start_time=START)
    later = START + timedelta(seconds=0.05)
    two = recording(samples(90), 0.02, orientation="horizontal", azimuth_deg=40.0, start_time=later)
    from rocksteady.records.pairing import _doubts

    assert _doubts((one, two)) == (
        "intervals of 0.01, 0.02 s",
        "lengths from 90 to 100 samples",
        "starts up to 0.05 s apart",
        "azimuths 0 and 40 deg, not at right angles",
    )
    with pytest.raises(InputError, match=r"different intervals.*resample"):
        RecordSet(name="hut", horizontal=(one, two)).aligned("trim")


@pytest.mark.parametrize(("method", "first", "count"), [("trim", 5, 90), ("pad", 0, 100)])
def test_channels_are_brought_to_one_time(method: str, first: int, count: int) -> None:
    motion = samples(100)
    one = recording(motion, orientation="horizontal", start_time=START)
    late = START + timedelta(seconds=0.05)
    two = recording(motion[5:95], orientation="vertical", start_time=late)
    found = RecordSet(name="hut", horizontal=(one,), vertical=two).aligned(method)  # type: ignore[arg-type]
    assert found.vertical is not None
    vertical = found.vertical.record.acceleration_m_s2
    expected = motion[first : first + count].copy()
    np.testing.assert_array_equal(found.horizontal[0].record.acceleration_m_s2, expected)
    if method == "pad":
        expected[:5] = expected[95:] = 0.0
        assert "5 and 5 zeros put there" in found.vertical.processing[0]
    else:
        (note,) = found.horizontal[0].processing
        assert "5 samples cut from the start and 5 from the end" in note
    np.testing.assert_array_equal(vertical, expected)
    assert found.vertical.start_time == found.horizontal[0].start_time
    assert found.warnings == ()


def test_nothing_in_common_and_no_such_method() -> None:
    one = recording(samples(100), start_time=START)
    two = recording(samples(100), start_time=START + timedelta(seconds=60))
    both = RecordSet(name="hut", other=(one, two))
    with pytest.raises(InputError, match="no time in common"):
        both.aligned("trim")
    with pytest.raises(InputError, match="use trim or pad"):
        both.aligned("cut")  # type: ignore[arg-type]


def test_a_set_of_one_file_of_several_channels(tmp_path: Path) -> None:
    path = tmp_path / "hut.csv"
    path.write_text("t,acc_x (g),acc_y (g)\n0,1,2\n.01,2,3\n.02,-1,2\n")
    assert len(read_recordings(path)) == 2
    (one,) = pair_records([path])
    assert len(one.other) == 2


def test_a_set_is_a_base_motion_for_each_horizontal_channel() -> None:
    rng = np.random.default_rng(3)
    north, east, up = (rng.normal(size=40) for _ in range(3))
    pair = RecordSet(
        name="hut",
        horizontal=(
            recording(north, orientation="horizontal"),
            recording(east, orientation="horizontal"),
        ),
        vertical=recording(up, orientation="vertical"),
    )
    one, other = pair.motions()
    for motion, values in ((one, north), (other, east)):
        assert isinstance(motion.horizontal, Record)
        assert isinstance(motion.vertical, Record)
        np.testing.assert_array_equal(motion.horizontal.acceleration_m_s2, values)
        np.testing.assert_array_equal(motion.vertical.acceleration_m_s2, up)
    (alone,) = RecordSet(name="hut", horizontal=pair.horizontal[:1]).motions()
    assert alone.vertical is None
    assert [row["place"] for row in pair.to_dict()["recordings"]] == [
        "horizontal",
        "horizontal",
        "vertical",
    ]
    assert repr(pair) == "<RecordSet: hut: 2 horizontal channels, a vertical one>"
    with pytest.raises(InputError, match="no known horizontal"):
        RecordSet(name="hut", vertical=pair.vertical).motions()


def across(azimuth: float | None, count: int = 100, **fields: Any) -> Recording:
    return recording(samples(count), orientation="horizontal", azimuth_deg=azimuth, **fields)


def test_right_angles_are_right_to_a_degree() -> None:
    for first, second, square in (
        *((0.0, 90.0, True), (90.0, 0.0, True), (0.0, 270.0, True), (350.0, 80.0, True)),
        *((0.0, 91.0, True), (0.0, 89.0, True), (0.0, 91.5, False), (0.0, 88.5, False)),
        *((181.0, 90.0, True), (1.5, 270.0, False), (0.0, 180.0, False), (30.0, 30.0, False)),
        *((0.0, None, True), (None, None, True), (269.0, 0.0, True), (268.4, 0.0, False)),
    ):
        for pair in ((first, second), (second, first)):
            result = RecordSet(name="hut", horizontal=tuple(across(each) for each in pair))
            listed = " and ".join(f"{each:g}" for each in pair if each is not None)
            words = f"azimuths {listed} deg, not at right angles"
            assert result.warnings == (() if square else (words,)), pair
    # Of one or three horizontal channels, or vertical ones, angles say nothing.
    three = RecordSet(name="hut", horizontal=(across(0.0), across(40.0), across(90.0)))
    beside = RecordSet(name="hut", horizontal=(across(0.0),), other=(recording(samples(100)),))
    assert three.warnings == beside.warnings == ()


def test_what_a_set_says_of_itself() -> None:
    single = across(0.0, component="NS", station="Hut", event="Town")
    up = recording(samples(100), 0.02, orientation="vertical", event="town", station="Shed")
    odd = recording(samples(90), component="x")
    whole = RecordSet(
        name="hut", horizontal=(single,), vertical=up, other=(odd,), warnings=("more",)
    )
    assert whole.warnings == (
        *("stations 'Hut' and 'Shed'", "intervals of 0.01, 0.02 s"),
        *("lengths from 90 to 100 samples", "more"),
    )
    rows = whole.to_dict()["recordings"]
    assert [row["place"] for row in rows] == ["horizontal", "vertical", "other"]
    assert [row["npts"] for row in rows] == [100, 100, 90]
    assert [row["dt_s"] for row in rows] == [0.01, 0.02, 0.01]
    assert [row["azimuth_deg"] for row in rows] == [0.0, None, None]
    assert [row["component"] for row in rows] == ["NS", None, "x"]
    assert rows[0]["pga_m_s2"] == np.abs(samples(100)).max()
    assert whole.to_dict()["warnings"] == list(whole.warnings)
    text = " ".join(whole.summary().split())
    for words in (
        "hut: 1 horizontal channel, a vertical one",
        "channel",
        "PGA [g]",
        "dt [s]",
        "0.102",
    ):
        assert words in text, text
    assert repr(RecordSet(name="hut")) == "<RecordSet: hut: 0 horizontal channels, no vertical one>"
    wrong = RecordSet(name="hut", horizontal=(up,), vertical=replace(single, component=None))
    assert wrong.warnings[-2:] == (
        "hut.csv is vertical, in the place of a horizontal channel",
        "hut.csv is horizontal, in the place of a vertical channel",
    )


def test_starts_count_where_all_channels_state_them() -> None:
    starts = [START + timedelta(seconds=late) for late in (0.2, 0.0, 0.05)]
    single, two, three = (across(None, start_time=start) for start in starts)
    whole = RecordSet(name="hut", horizontal=(single, two), other=(three,))
    assert whole.starts_s == pytest.approx((0.2, 0.0, 0.05))
    bare = RecordSet(name="hut", horizontal=(single, across(None)), other=(three,))
    assert bare.starts_s == (0.0, 0.0, 0.0)
    assert bare.warnings == ("starts up to 0.15 s apart",)
    assert RecordSet(name="hut").starts_s == ()


def test_channels_that_overlap_by_two_samples_can_be_trimmed() -> None:
    motion = samples(40)
    for late, left in ((37, 3), (38, 2), (39, 1), (40, 0), (0, 40)):
        single = recording(motion, start_time=START)
        two = recording(motion, start_time=START + timedelta(seconds=0.01 * late))
        whole = RecordSet(name="hut", other=(single, two))
        if left < 2:
            with pytest.raises(InputError, match="no time in common; see whether they are of one"):
                whole.aligned("trim")
        else:
            first, second = whole.aligned("trim").recordings
            np.testing.assert_array_equal(first.record.acceleration_m_s2, motion[late:])
            np.testing.assert_array_equal(second.record.acceleration_m_s2, motion[:left])
            assert first.start_time == second.start_time == two.start_time
        first, second = whole.aligned("pad").recordings
        still = np.zeros(late)
        np.testing.assert_array_equal(
            first.record.acceleration_m_s2, np.concatenate([motion, still])
        )
        np.testing.assert_array_equal(
            second.record.acceleration_m_s2, np.concatenate([still, motion])
        )
        assert first.start_time == second.start_time == START
        notes = [f"0 and {late} zeros put there", f"{late} and 0 zeros put there"]
        for each, note in zip((first, second), notes, strict=True):
            cut = f"0 samples cut from the start and 0 from the end, {note}"
            assert each.processing == ((cut,) if late else ())


def test_places_are_kept_when_channels_are_aligned() -> None:
    single, two, up, odd = (recording(samples(count)) for count in (30, 40, 50, 60))
    single, two = (replace(each, orientation="horizontal") for each in (single, two))
    up = replace(up, orientation="vertical")
    for vertical in (None, up):
        whole = RecordSet(name="hut", horizontal=(single, two), vertical=vertical, other=(odd, odd))
        result = whole.aligned("trim")
        assert (result.name, len(result.horizontal), len(result.other)) == ("hut", 2, 2)
        assert (result.vertical is None) == (vertical is None)
        assert {len(each.record.acceleration_m_s2) for each in result.recordings} == {30}
        # Without starts all begin together: the shortest of them is left as it is.
        assert result.horizontal[0] is single
        assert result.other[0].processing == (
            "0 samples cut from the start and 30 from the end, 0 and 0 zeros put there",
        )


def test_several_channels_of_one_place_are_named(tmp_path: Path) -> None:
    for end, component in enumerate(("000", "090", "045", "UP", "DWN")):
        path = tmp_path / f"{end}.AT2"
        path.write_text(at2(samples(100), component=component))
    (result,) = pair_records(sorted(tmp_path.iterdir()))
    assert len(result.horizontal) == 3
    assert result.vertical is not None
    assert result.vertical.component == "UP"
    assert [each.component for each in result.other] == ["DWN"]
    assert result.warnings == (
        "2 vertical channels: the first is taken",
        "3 horizontal channels: which belong together is open",
    )


def test_names_of_files_that_are_alike_but_for_their_ends(tmp_path: Path) -> None:
    for stem in (
        *("ELC180-hor1", "ELC270-hor2", "ELC-up", "H1", "B-h1", "B-h2", "C.HNZ", "C.HNE", "090"),
    ):
        (tmp_path / f"{stem}.csv").write_text(csv(samples(100)))
    result = {each.name: each for each in pair_records(sorted(tmp_path.iterdir()))}
    counts = {name: (len(each.horizontal), each.vertical is None) for name, each in result.items()}
    assert counts["ELC"] == (2, False)
    assert counts["B"] == (2, True)
    assert counts["C"] == (1, False)
    assert {"H1", "090"} <= set(counts)
