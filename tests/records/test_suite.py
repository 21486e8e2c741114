"""Which channels of files and folders are horizontal motions of the ground, and what is named."""

from pathlib import Path

import numpy as np
import pytest

from rocksteady.errors import InputError, RecordFileError
from rocksteady.model.motions.record import Record
from rocksteady.records import read_recordings
from rocksteady.records.suite import INCLUDABLE, RecordSuite, read_records, select
from tests.every import every
from tests.records.test_phrases import TURNED
from tests.records.writers import at2, csv, esm, knet, samples

VALUES = samples(200)
COLUMNS = (
    "Time (s);N-S (g);U-D (g);acc roof (g);EW GL-30m (g);vel N (cm/s);Radial (g);QX (g);what\n"
    + "".join(f"{k * 0.01:.2f}" + f";{v:.4f}" * 8 + "\n" for k, v in enumerate(VALUES))
)
KINDS = {
    "U-D": "vertical",
    "acc roof": "structure",
    "EW": "borehole",
    "vel N (cm/s)": "velocity",
    "Radial": "rotated",
    "QX (g)": "not understood",
    "what": "not understood",
}


def test_a_table_of_all_kinds(tmp_path: Path) -> None:
    path = tmp_path / "hut.csv"
    path.write_text(COLUMNS)
    taken, left = select(read_recordings(path))
    assert [each.component for each in taken] == ["N-S"]
    assert {each.channel: each.kind for each in left} == KINDS
    taken, left = select(read_recordings(path), INCLUDABLE)
    assert len(taken) == 4
    assert {each.kind for each in left} == {"vertical", "velocity", "not understood"}


def test_a_channel_that_is_dead(tmp_path: Path) -> None:
    path = tmp_path / "hut.csv"
    rows = "".join(f"{k * 0.01:.2f};{v:.4f};0\n" for k, v in enumerate(VALUES))
    path.write_text("Time (s);N-S (g);E-W (g)\n" + rows)
    (found,) = read_recordings(path)
    assert found.component == "N-S"
    assert [(each.channel, each.kind) for each in found.left_out] == [("E-W (g)", "still")]
    path.write_text("Time (s);N-S (g)\n0;0\n0.01;0\n0.02;0\n")
    with pytest.raises(RecordFileError, match="all samples are zero"):
        read_recordings(path)


def test_a_folder_with_other_files_in_it(tmp_path: Path) -> None:
    files: dict[str, str | bytes] = {
        "a.AT2": at2(VALUES),
        "b.AT2": at2(VALUES, component="UP"),
        "c.csv": csv(VALUES),
        "d.VT2": at2(VALUES, quantity="VELOCITY TIME SERIES IN UNITS OF CM/S"),
        "e.EW1": knet(np.rint(1e5 * samples(800)).astype(np.int64), direction="2"),
        "event.json": '{"magnitude": 7.1}',
        "README.txt": "Two records of a hut.\n",
        "map.png": b"\x89PNG\r\n\x1a\n" + bytes(range(64)),
        "sheet.xlsx": b"PK\x03\x04 xl/workbook.xml",
    }
    for name, content in files.items():
        data = content if isinstance(content, bytes) else content.encode()
        (tmp_path / name).write_bytes(data)
    suite = read_records(tmp_path)
    assert isinstance(suite, RecordSuite)
    assert [record.name for record in suite] == ["a", "c"]
    assert isinstance(suite[0], Record)
    assert suite[:1] == (suite[0],)
    assert repr(suite) == (
        "<RecordSuite: 2 records, 1 of unstated direction; 3 channels left out: 1 borehole, "
        "1 velocity, 1 vertical; 4 files left out: 4 no record>"
    )
    assert {each.file.name: each.to_dict()["why"] for each in suite.left_out}["sheet.xlsx"] == (
        "it is a spreadsheet"
    )
    assert len(read_records(tmp_path, include=["borehole"])) == 3
    with pytest.raises(InputError, match=r"include = 'vertical' is not valid.* use unknown, bore"):
        read_records(tmp_path, include=["vertical"])
    with pytest.raises(InputError, match=r"has a horizontal record; 1 channel left out: 1 vert"):
        read_records(tmp_path, pattern="b.*")


@every(
    ("text", "words"),
    [
        (csv(VALUES).replace("(g)", ""), "does not state the unit"),
        (at2(VALUES)[:1500], "fetch the file again"),
        ("# units: g\n# units: gal\n" + csv(VALUES).replace("(g)", ""), "states g and gal"),
    ],
)
def test_a_record_that_cannot_be_read_is_not_passed_over(
    tmp_path: Path, text: str, words: str
) -> None:
    (tmp_path / "a.AT2").write_text(at2(VALUES))
    (tmp_path / "b.txt").write_text(text)
    with pytest.raises(RecordFileError, match=words):
        read_records(tmp_path)


@every("name", TURNED)
def test_components_that_were_turned(tmp_path: Path, name: str) -> None:
    (tmp_path / "a.AT2").write_text(at2(VALUES, component=name))
    (tmp_path / "b.AT2").write_text(at2(VALUES))
    suite = read_records(tmp_path)
    assert [each.kind for each in suite.left_out] == ["rotated"]
    assert len(read_records(tmp_path, include=["rotated"])) == 2


@every(
    ("text", "kind"),
    [
        (at2(VALUES, component="QX"), "unknown direction"),
        (esm(VALUES, STREAM="BHQ"), "unknown direction"),
        (
            csv(VALUES).replace("acc (g)", "acc (g)").replace("time", "Component: QX\ntime"),
            "unknown direction",
        ),
        (esm(VALUES, SENSOR_DEPTH_M="12.5"), "borehole"),
        # A network's file that is read as a table: its direction stands in what is not understood.
        (
            at2(VALUES, component="UP", counts="NPTS= few, DT= 0.01 SEC"),
            "unknown direction",
        ),
        (csv(VALUES), ""),
        (csv(VALUES).replace("acc", "El Centro"), ""),
    ],
)
def test_a_lone_channel(tmp_path: Path, text: str, kind: str) -> None:
    (tmp_path / "hut.txt").write_text(text)
    recordings = read_recordings(tmp_path / "hut.txt", units="g" if "Centro" in text else None)
    taken, left = select(recordings)
    assert [each.kind for each in left] == ([kind] if kind else [])
    assert len(taken) == (not kind)
