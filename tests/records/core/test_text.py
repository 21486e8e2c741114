"""Files as lines: their encodings and line ends, and what is empty, too large or no text."""

import re
from pathlib import Path

import pytest

from rocksteady.errors import RecordFileError
from rocksteady.records import read_recordings
from rocksteady.records.core import text as text_files
from rocksteady.records.core.text import LARGEST_FILE, RecordText, as_text, file_bytes
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


@every(
    ("encoding", "names"),
    [
        ("cp932", "\u6642\u9593 (s),\u5357\u5317 (gal),\u4e0a\u4e0b (gal)"),
        (
            "gb18030",
            "\u65f6\u95f4(s),\u5357\u5317\u5411\u52a0\u901f\u5ea6(gal),\u7ad6\u5411(gal)",
        ),
    ],
)
def test_encodings_of_the_far_east(tmp_path: Path, encoding: str, names: str) -> None:
    path = tmp_path / "hut.csv"
    path.write_bytes(f"{names}\n0,1,2\n.01,-3,1\n.02,2,-1\n".encode(encoding))
    across, up = read_recordings(path)
    assert (across.azimuth_deg, up.orientation) == (0.0, "vertical")
    assert across.record.dt_s == 0.01


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


def test_errors_name_their_line_and_what_stands_there() -> None:
    text = RecordText(path=Path("hut.txt"), lines=("", " a b ", "x" * 500))
    assert text.first == " a b "
    assert RecordText(path=Path("hut.txt"), lines=("", " ")).first == ""
    assert [len(line) for line in text.heads] == [0, 5, 400]
    for at, line, words in (
        *((None, None, "it is odd"), (0, 1, "it is odd"), (1, 2, "it is odd"), (2, 3, "it is odd")),
        *((3, 3, "the file ends here: it is odd"), (9, 3, "the file ends here: it is odd")),
    ):
        error = text.error("it is odd", "mend it", at=at)
        assert error.line == line
        assert str(error).endswith(f": {words}; mend it"), at
    assert text.error("", "", at=1).found == "a b"
    twice = RecordText(path=Path("hut.txt"), lines=("Key  1", "key 1", "key 2"))
    twice.refuse_repeated(0, 1)
    with pytest.raises(
        RecordFileError, match=r"line 3, .*line 1 states the same with another value"
    ):
        twice.refuse_repeated(0, 2)


def test_the_end_of_a_file_and_what_is_text() -> None:
    path = Path("hut.txt")
    for data, lines, ended in (
        *(
            (b"a\nb", ("a", "b"), False),
            (b"a\nb\n", ("a", "b"), True),
            (b"a\rb\r", ("a", "b"), True),
        ),
        *(
            (b"a\n\nb  \n", ("a", "", "b"), True),
            (b"a\x00\x00", ("a",), False),
            (b"a \x1a", ("a",), False),
        ),
        *((b"a\r\r\nb\n\x1a", ("a", "b"), True), (b"\xef\xbb\xbfa", ("a",), False)),
        *(
            (b"\xff\xfea\x00", ("a",), False),
            (b"\xfe\xff\x00a\x00\n", ("a",), True),
            (b"\xe9", ("é",), False),
        ),
    ):
        result = as_text(path, data)
        assert (result.lines, result.ended) == (lines, ended), data
    # A hundredth of the first 4096 characters may be marks of control, tabs not counted.
    for odd, length, text in (
        *((1, 100, True), (2, 100, False), (2, 199, False), (2, 200, True), (40, 4096, True)),
        *((41, 4096, False), (41, 9000, False), (0, 50, True)),
    ):
        data = b"\x01" * odd + b"\t" * 20 + b"a" * (length - odd - 20)
        if text:
            assert len(as_text(path, data).lines[0]) == length
        else:
            with pytest.raises(
                RecordFileError, match="it is not text; give a record as its network"
            ):
                as_text(path, data)
    late = b"a" * 4096 + b"\x01" * 500
    assert len(as_text(path, late).lines[0]) == 4596


def test_a_file_of_the_largest_size_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "hut"
    path.write_bytes(b"1234567890")
    for most, fits in ((9, False), (10, True), (11, True)):
        monkeypatch.setattr(text_files, "LARGEST_FILE", most)
        if fits:
            assert file_bytes(path) == b"1234567890"
        else:
            with pytest.raises(
                RecordFileError, match="it has 10 bytes, and 9 are the most; give a"
            ):
                file_bytes(path)


def test_layouts_are_lines_without_their_digits() -> None:
    """By another way, over more lines than are translated at once; other scripts' digits stay."""
    rows = ["time (s),acc (g)", "0.19,-1.5", "", "0.28,-2.7", "\N{ARABIC-INDIC DIGIT FIVE},1", "1,"]
    text = RecordText(path=Path("hut.txt"), lines=tuple(rows * 500))
    layouts, of_lines = text.layouts
    assert [layouts[at] for at in of_lines] == [re.sub("[0-9]", "0", line) for line in text.lines]
    assert len(set(layouts)) == len(layouts) == 5
    assert text.by_layout(len).tolist() == [len(line) for line in text.lines]
    assert RecordText(path=Path("hut.txt"), lines=()).by_layout(len).tolist() == []
