"""Files that are whole or not there, JSON without NaN, CSV that reads back to the last digit."""

import csv
import errno
import json
import math
import re
from pathlib import Path
from typing import Any

import matplotlib as mpl

mpl.use("Agg")

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure

from rocksteady import __version__
from rocksteady.errors import OutputError
from rocksteady.show.export.files import (
    figure_bytes,
    json_text,
    picture_files,
    save_csv,
    save_figure,
    save_text,
    save_whole,
)
from tests.every import every
from tests.origins import origin_of

MAGIC = {"png": b"\x89PNG\r\n", "svg": b"<?xml", "pdf": b"%PDF"}


def picture() -> Figure:
    figure = Figure(figsize=(2.0, 1.5))
    axes = figure.add_subplot()
    axes.plot([0.0, 1.0, 2.0], [0.0, 1.0, 0.5], label="curve")
    axes.set_xlabel(r"$\theta/\alpha$")
    axes.legend()
    return figure


# ------------------------------------------------------------------------------------ whole files


def test_a_file_appears_when_it_is_whole(tmp_path: Path) -> None:
    file = tmp_path / "a.csv"

    def write(target: Path) -> None:
        assert target.parent.parent == tmp_path, "on the same disk"
        assert target.parent.stat().st_mode & 0o777 == 0o700, "nobody else can put a link there"
        assert target.suffix == ".csv", "writers look at the ending"
        target.write_text("half", encoding="utf-8")
        assert not file.exists()
        target.write_text("whole", encoding="utf-8")

    save_whole("--csv", file, write)
    assert file.read_text(encoding="utf-8") == "whole"
    assert list(tmp_path.iterdir()) == [file]


@every("error", [OSError(errno.ENOSPC, "No space left on device"), ValueError()])
@every("there", [False, True])
def test_a_writer_that_fails_leaves_what_was_there(
    error: Exception, there: bool, tmp_path: Path
) -> None:
    file = tmp_path / "a.csv"
    if there:
        file.write_text("old", encoding="utf-8")

    def write(target: Path) -> None:
        target.write_text("half", encoding="utf-8")
        raise error

    with pytest.raises(OutputError if isinstance(error, OSError) else ValueError) as caught:
        save_whole("--csv", file, write)
    if isinstance(error, OSError):
        assert "--csv = " in str(caught.value)
        assert "No space left on device" in str(caught.value)
        assert isinstance(caught.value, OutputError)
    assert [path.name for path in tmp_path.iterdir()] == (["a.csv"] if there else [])
    assert not there or file.read_text(encoding="utf-8") == "old"


def test_an_error_without_words_is_named_all_the_same(tmp_path: Path) -> None:
    def write(_: Path) -> None:
        message = "odd"
        raise OSError(message)

    with pytest.raises(OutputError, match="odd"):
        save_whole("--csv", tmp_path / "a.csv", write)


def test_a_folder_in_the_place_of_a_file_is_an_error_of_output(tmp_path: Path) -> None:
    (tmp_path / "a.txt").mkdir()
    with pytest.raises(OutputError):
        save_text("--out", tmp_path / "a.txt", "text")
    assert [path.name for path in tmp_path.iterdir()] == ["a.txt"]


def test_a_text_is_utf_8(tmp_path: Path) -> None:
    save_text("--out", tmp_path / "a.txt", "θ/α ≤ 1\n")
    assert (tmp_path / "a.txt").read_bytes() == "θ/α ≤ 1\n".encode()


def test_a_name_that_is_no_text_is_written_and_json_reads_it_back(tmp_path: Path) -> None:
    """As of a file whose name has bytes that are no UTF-8."""
    name = b"G\xff\xfe.AT2".decode("utf-8", "surrogateescape")
    save_text("out", tmp_path / "run.json", json_text("rocksteady/x/1", {"name": name}, indent=2))
    back = json.loads((tmp_path / "run.json").read_text(encoding="utf-8"))
    assert back["name"] == name
    save_csv("out", tmp_path / "runs.csv", ["record"], [[name]])
    assert (tmp_path / "runs.csv").read_text(encoding="utf-8") == "record\nG\\udcff\\udcfe.AT2\n"


# ---------------------------------------------------------------------------------------- figures


@pytest.mark.slow
@every("kind", MAGIC)
def test_a_figure_is_the_same_bytes_each_time(kind: str) -> None:
    first = figure_bytes(picture(), kind)
    assert first.startswith(MAGIC[kind])
    assert figure_bytes(picture(), kind) == first


def test_a_figure_has_one_layout_in_all_formats() -> None:
    figure = Figure(figsize=(2.0, 1.5), layout="constrained")
    axes = figure.add_subplot(xlabel=r"$\theta/\alpha$")
    laid_out: list[object] = []
    figure.canvas.mpl_connect("draw_event", lambda _: laid_out.append(axes.get_position().bounds))
    engine = figure.get_layout_engine()
    files = picture_files(figure, command="rocksteady a")
    assert figure.get_layout_engine() is engine
    assert len(set(laid_out)) == 1
    assert {kind: data[: len(MAGIC[kind])] for kind, data in files.items()} == MAGIC
    assert origin_of(files["png"], "png")[1] == "rocksteady a"


def test_a_figure_without_a_layout_keeps_none_whatever_the_settings() -> None:
    figure = Figure(figsize=(2.0, 1.5))
    with mpl.rc_context({"figure.autolayout": True}):
        picture_files(figure)
    assert figure.get_layout_engine() is None


@every("kind", MAGIC)
def test_a_picture_says_what_made_it(kind: str) -> None:
    own = f"rocksteady {__version__}"
    assert origin_of(figure_bytes(picture(), kind), kind) == (own, None)
    command = "rocksteady simulate --record 'a & b <c>.AT2' --plot θ.png"
    made = figure_bytes(picture(), kind, command=command)
    assert origin_of(made, kind) == (own, command)
    assert figure_bytes(picture(), kind, command=command) == made


@every("kind", MAGIC)
def test_a_command_with_a_name_that_is_no_text_is_kept(kind: str) -> None:
    made = figure_bytes(picture(), kind, command="rocksteady --record G\udcff\n.AT2")
    assert origin_of(made, kind)[1] == r"rocksteady --record G\udcff\n.AT2"


@every("kind", MAGIC)
def test_a_picture_has_no_date(kind: str) -> None:
    data = figure_bytes(picture(), kind)
    assert not re.search(rb"dc:date|CreationDate|tIME", data)


def test_the_ending_says_the_format(tmp_path: Path) -> None:
    for name, kind in (("a.png", "png"), ("a.SVG", "svg"), ("a.pdf", "pdf")):
        save_figure("--plot", tmp_path / name, picture())
        assert (tmp_path / name).read_bytes() == figure_bytes(picture(), kind)


def test_saving_leaves_the_settings_as_they_were() -> None:
    before = dict(mpl.rcParams)
    figure_bytes(picture(), "svg")
    assert dict(mpl.rcParams) == before


# ----------------------------------------------------------------------------------------- tables


@given(st.lists(st.floats(allow_nan=False), min_size=1, max_size=5))
def test_floats_read_back_to_the_last_digit(values: list[float]) -> None:
    from tempfile import TemporaryDirectory

    with TemporaryDirectory() as folder:
        file = Path(folder) / "a.csv"
        save_csv("--csv", file, [f"c{n}" for n in range(len(values))], [values])
        with file.open(encoding="utf-8", newline="") as stream:
            (_, row) = csv.reader(stream)
        assert [float(text) for text in row] == values


def test_a_table_has_one_header_and_the_lines_of_every_system(tmp_path: Path) -> None:
    save_csv("--csv", tmp_path / "a.csv", ("side", "fate, words"), iter([(1, 'a "b"'), (-1, "c")]))
    data = (tmp_path / "a.csv").read_bytes()
    assert data == b'side,"fate, words"\n1,"a ""b"""\n-1,c\n'


# ------------------------------------------------------------------------------------------- JSON


def test_json_has_its_schema_first_and_no_number_that_is_none() -> None:
    values: dict[str, Any] = {
        "nan": math.nan,
        "infinite": [math.inf, -math.inf, 1.5],
        "array": np.array([[1.0, math.nan], [2.0, 3.0]]),
        "integer": np.int64(3),
        "truth": np.True_,
        "complex": complex(1.0, math.nan),
        "complexes": np.array([1.0 + 2.0j]),
        "nested": {"tuple": (1, (2.0, math.nan))},
        "text": "θ",
        "nothing": None,
    }
    text = json_text("rocksteady/test/1", values)
    assert "\n" not in text
    read = json.loads(text, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))
    assert next(iter(read)) == "schema"
    assert read == {
        "schema": "rocksteady/test/1",
        "nan": None,
        "infinite": [None, None, 1.5],
        "array": [[1.0, None], [2.0, 3.0]],
        "integer": 3,
        "truth": True,
        "complex": [1.0, None],
        "complexes": [[1.0, 2.0]],
        "nested": {"tuple": [1, [2.0, None]]},
        "text": "θ",
        "nothing": None,
    }


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_json_numbers_read_back_to_the_last_digit(value: float) -> None:
    assert json.loads(json_text("x", {"v": value, "a": np.array([value])})) == {
        "schema": "x", "v": value, "a": [value],
    }  # fmt: skip


def test_indented_json_is_for_readers_and_one_line_is_for_programs() -> None:
    values = {"text": "θ ≤ α"}
    assert json_text("x", values).isascii()
    indented = json_text("x", values, indent=1)
    assert "θ ≤ α" in indented
    assert indented.count("\n") == 3
    assert json.loads(indented) == json.loads(json_text("x", values))
