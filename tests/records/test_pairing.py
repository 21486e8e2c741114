"""Channels of one station: which belong together, what differs, and how they are aligned."""

from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest

from rocksteady import Record
from rocksteady.errors import InputError
from rocksteady.records import RecordSet, pair_records, read_recordings
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
