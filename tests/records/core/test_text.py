"""Files as lines: their encodings and line ends, and what is empty, too large or no text."""

from pathlib import Path

import pytest

from rocksteady.errors import RecordFileError
from rocksteady.records import read_recordings
from rocksteady.records.core.text import LARGEST_FILE
from tests.every import every
from tests.records.writers import at2, samples


@every("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
@every("ends", ["\n", "\r\n", "\r", "\r\r\n"])
def test_encodings_and_line_ends(tmp_path: Path, encoding: str, ends: str) -> None:
    path = tmp_path / "hut.AT2"
    text = at2(samples(40)).replace("Hut", "H\N{LATIN SMALL LETTER U WITH DIAERESIS}tte")
    path.write_bytes(text.replace("\n", ends).encode(encoding))
    (found,) = read_recordings(path)
    assert len(found.record.acceleration_m_s2) == 40
    assert found.station == "H\N{LATIN SMALL LETTER U WITH DIAERESIS}tte - Far, West"


@every("data", [b"", b"\n \n", b"\x00" * 5000, b"\x1a"])
def test_an_empty_file(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "empty"
    path.write_bytes(data)
    with pytest.raises(RecordFileError, match="it is empty; fetch it again"):
        read_recordings(path)


def test_files_that_are_too_large_or_no_text(tmp_path: Path) -> None:
    path = tmp_path / "large"
    with path.open("wb") as file:
        file.truncate(LARGEST_FILE + 1)
    with pytest.raises(RecordFileError, match=f"{LARGEST_FILE} are the most"):
        read_recordings(path)
    path.write_bytes(bytes(range(256)) * 40)
    with pytest.raises(RecordFileError, match="it is not text"):
        read_recordings(path)
