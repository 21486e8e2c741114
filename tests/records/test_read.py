"""Files of any kind: their format by what stands in them, their encodings, and what is refused."""

import pickle
from pathlib import Path

import numpy as np
import pytest

from rocksteady import read_record, read_records
from rocksteady.errors import InputError, RecordFileError
from rocksteady.records import read_recordings
from rocksteady.records.read import FORMATS, chosen
from tests.every import every
from tests.records.writers import at2, cosmos_channel, csv, esm, knet, samples, smc

CM = samples(403, peak=150.0)
FILES = {
    "peer-at2": at2(samples(403)),
    "esm-ascii": esm(CM),
    "knet": knet(np.rint(1e5 * samples(800)).astype(np.int64)),
    "cosmos-v2": cosmos_channel(CM),
    "smc": smc(CM),
    "csv": csv(samples(403)),
}


@every("name", FILES)
def test_the_format_is_found_from_what_stands_in_the_file(tmp_path: Path, name: str) -> None:
    for wrong_name in ("record.csv", "record.sac", "record", "record.AT2"):
        path = tmp_path / wrong_name
        path.write_text(FILES[name])
        (found,) = read_recordings(path)
        assert found.format == name
        assert found.path == path
        (named,) = read_recordings(path, format=name)
        assert named.record == found.record


def test_a_format_that_is_not_the_files_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "hut"
    for name, text in FILES.items():
        path.write_text(text)
        for other in FORMATS:
            same = other == name or {other, name} <= {"knet", "kiknet"}
            table = other in {"csv", "columns"}
            # Read through ObsPy, which may not be installed.
            binary = other in {"mseed", "sac"}
            if same or table or binary or other.split("-")[0] == name.split("-")[0]:
                continue
            with pytest.raises(RecordFileError):
                read_recordings(path, format=other)
    with pytest.raises(InputError, match=r"format = 'at3' is not valid.*use one of knet"):
        read_recordings(path, format="at3")


def test_what_is_no_file(tmp_path: Path) -> None:
    cases = {
        tmp_path: "it is a folder",
        tmp_path / "none": "there is no such file",
        Path("/dev/null"): "not a regular file|no such file",
    }
    for path, message in cases.items():
        with pytest.raises(RecordFileError, match=message) as refused:
            read_recordings(path)
        assert "\n" not in str(refused.value)
    for named, words in (("a\0b", "a path, in text"), ("x" * 5000, "names up to 255 bytes")):
        with pytest.raises(InputError, match=words):
            read_recordings(named)


@every(
    ("given", "name"),
    [({"units": "furlong"}, "units"), ({"units": 3}, "units"), ({"dt_s": 0.0}, "dt_s")],
)
def test_arguments_are_looked_at_before_the_file(given: dict[str, object], name: str) -> None:
    with pytest.raises(InputError) as refused:
        read_record("there is none", **given)  # type: ignore[arg-type]
    assert refused.value.name == name


def test_samples_that_are_all_zero_are_no_record(tmp_path: Path) -> None:
    path = tmp_path / "hut.AT2"
    path.write_text(at2(np.zeros(40)))
    with pytest.raises(RecordFileError, match="all samples are zero"):
        read_record(path)


def test_the_error_of_a_file_comes_back_whole_from_another_process(tmp_path: Path) -> None:
    path = tmp_path / "hut.AT2"
    path.write_text(at2(samples(40)).replace("NPTS=     40", "NPTS= few"))
    with pytest.raises(RecordFileError) as refused:
        read_record(path, format="peer-at2")
    error = refused.value
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error)
    assert (again.path, again.line, again.found) == (path, 4, error.found)
    path.write_text(at2(samples(40), quantity="VELOCITY"))
    with pytest.raises(RecordFileError) as refused:
        read_record(path)
    assert pickle.loads(pickle.dumps(refused.value)).kind == refused.value.kind == "velocity"
    assert isinstance(again, InputError)
    assert isinstance(again, ValueError)


def test_a_folder_is_read_without_vertical_channels_and_hidden_files(tmp_path: Path) -> None:
    head = "PEER\nSomewhere, 1/2/1990, Hut, {}\nACCELERATION IN UNITS OF G\n"
    head += "3 .01 NPTS, DT\n{} -.2 .05\n"
    for name, component, start in (("b", "090", 0.1), ("a", "000", 0.3), ("c", "UP", 0.5)):
        (tmp_path / f"{name}.AT2").write_text(head.format(component, start), encoding="ascii")
    (tmp_path / ".hidden").write_text("no record", encoding="ascii")
    records = read_records(tmp_path)
    assert [record.name for record in records] == ["a", "b"]
    first = [record.acceleration_m_s2[0] / 9.80665 for record in records]
    assert first == pytest.approx([0.3, 0.1])
    assert [record.name for record in read_records(tmp_path, pattern="b.*")] == ["b"]
    suite = read_records(tmp_path, pattern="b.*", units="g", dt_s=0.01, ignore_header=True)
    assert suite.recordings[0].processing[0].startswith("header ignored")
    whole = read_recordings(tmp_path / "b.AT2", units="g", dt_s=0.01, ignore_header=True)
    assert list(suite) == [whole[0].record]
    for folder, pattern, words in (
        (tmp_path / "none", "*", "there is no such folder"),
        (
            tmp_path,
            "c.AT2",
            "none of its files named c.AT2 has a horizontal record; 1 channel left out: 1 vertical",
        ),
    ):
        with pytest.raises(InputError, match=words):
            read_records(folder, pattern=pattern)
    for nothing in ("", ".", "./"):
        with pytest.raises(InputError, match=r"^pattern = "):
            read_records(tmp_path, pattern=nothing)


def test_channels_by_number_and_by_name(tmp_path: Path) -> None:
    path = tmp_path / "hut.csv"
    path.write_text("t,2 (g),NS (g),ns (g)\n0,1,2,3\n.01,-1,-2,-3\n.02,1,2,3\n")
    result = read_recordings(path)
    assert [each.record.name for each in result] == ["hut 2", "hut NS", "hut ns"]
    for channel, peak in ((1, 1.0), (2, 2.0), (3, 3.0), ("3", 3.0), ("2", 1.0), (" 1 ", 1.0)):
        assert chosen(result, channel).record.peak_acceleration_m_s2 == pytest.approx(
            9.80665 * peak
        )
    words = r"holds 3 channels; choose one: 1 \(2\), 2 \(NS\), 3 \(ns\)"
    with pytest.raises(InputError, match=words):
        chosen(result, None)
    for wrong in (0, 4, -1, "NS", "x", "", "1.0", "0000000001", "²"):
        with pytest.raises(InputError, match=r"has no such channel; choose one: 1 \(2\), 2 \(NS\)"):
            chosen(result, wrong)
    assert chosen(result[:1], None) is result[0]
    bare = tmp_path / "bare.csv"
    bare.write_text("0,1,2\n.01,-1,-2\n.02,1,2\n.03,2,1\n")
    names = [each.record.name for each in read_recordings(bare, units="g")]
    assert names == ["bare column 2", "bare column 3"]


def test_what_is_in_no_format(tmp_path: Path) -> None:
    path = tmp_path / "hut"
    path.write_text("only words\nof a letter\n")
    words = (
        f"it is in no format that can be read; give a file of one of these: {', '.join(FORMATS)}"
    )
    with pytest.raises(RecordFileError, match=words):
        read_recordings(path)
    with pytest.raises(RecordFileError, match="it holds no rows of numbers; give a record as text"):
        read_recordings(path, format="columns")
    assert FORMATS[:2] == ("knet", "kiknet")
    assert FORMATS[-2:] == ("mseed", "sac")
