"""`rocksteady explore`: the file that it writes, the browser that it opens, what it refuses."""

import json
import stat
import tempfile
import webbrowser
from pathlib import Path

import numpy as np
import pytest

from rocksteady import Block, Harmonic, State, read_record, write_explorer
from rocksteady.errors import MissingKernelsError, OutputError
from rocksteady.explorer import write
from rocksteady.explorer._module import page_module
from rocksteady.export import ExplorerView
from tests.cli.motion_files import at2, samples
from tests.cli.program import refused, rocksteady
from tests.explorer.test_page import Reader
from tests.strategies import PLAIN


@pytest.fixture(autouse=True)
def opened(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[str]:
    """The addresses that a browser was to open; and an empty folder for temporary files."""
    if PLAIN:
        pytest.skip("no library is loaded")
    try:
        page_module()
    except MissingKernelsError as error:
        pytest.skip(f"{error}")
    asked: list[str] = []

    def open_address(url: str) -> bool:
        asked.append(url)
        return True

    monkeypatch.setattr(webbrowser, "open", open_address)
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))
    (tmp_path / "temporary").mkdir()
    return asked


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return at2(tmp_path / "hut.AT2", samples())


def view_in(page: Path | str) -> dict[str, str]:
    """The first view of a page."""
    found = json.loads(Reader(Path(page).read_text("utf-8")).texts["first-view"])
    assert isinstance(found, dict)
    return found


def motions_in(page: Path | str) -> list[dict[str, object]]:
    """The ground motions of a page."""
    found = json.loads(Reader(Path(page).read_text("utf-8")).texts["motions"])
    assert isinstance(found, list)
    return found


# ------------------------------------------------------------------------------------ the page


def test_without_flags_the_page_lies_in_a_private_folder_and_is_opened(
    opened: list[str], tmp_path: Path
) -> None:
    ran = rocksteady("explore")
    (page,) = (tmp_path / "temporary").glob("*/*")
    assert (ran.code, ran.err) == (0, "")
    assert str(page) in ran.out.replace("\n", "")
    assert opened == [page.as_uri()]
    assert stat.S_IMODE(page.parent.stat().st_mode) == 0o700
    assert view_in(page)["tab"] == "shake"
    assert motions_in(page) == []


def test_the_page_is_that_of_python(tmp_path: Path, file: Path) -> None:
    ours, theirs = tmp_path / "ours.html", tmp_path / "theirs.html"
    flags = "--width-m 0.6 --height-m 2 -r 0.9 --accel-m-s2 4 --freq-hz 1.5 --start 0.4,-0.1"
    ran = rocksteady(f"explore {flags} --tab design --scale 1.5", "--record", file, "--out", ours)
    assert ran.code == 0
    assert ran.err == f"wrote {ours}\n"
    block = Block.rectangle(width=0.6, height=2.0, restitution=0.9)
    view = ExplorerView(
        block=block,
        motion=Harmonic.from_si(block, acceleration_m_s2=4.0, frequency_hz=1.5),
        start=State(angle=0.4, velocity=-0.1),
        tab="design",
        scale=1.5,
    )
    write_explorer(theirs, view, records=[read_record(file)])
    assert view_in(ours) == view_in(theirs)
    one, other = motions_in(ours), motions_in(theirs)
    assert [each["samples"] for each in one] == [each["samples"] for each in other]


def test_json_is_one_object_and_opens_nothing(opened: list[str], tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    ran = rocksteady("explore -A 2 -W 6 -r 0.8 --json --out", page)
    values = ran.json
    assert list(values)[:2] == ["schema", "file"]
    assert values["schema"] == "rocksteady/explore/1"
    assert (values["file"], values["bytes"]) == (str(page), page.stat().st_size)
    assert values["view"] == view_in(page)
    assert (values["view"]["A"], values["view"]["W"], values["view"]["r"]) == ("2", "6", "0.8")
    assert values["records"] == []
    assert opened == []


def test_one_number_of_the_shaking_is_enough(tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    assert rocksteady("explore -W 2 --out", page).code == 0
    assert (view_in(page)["A"], view_in(page)["W"]) == ("2", "2")


@pytest.mark.parametrize("name", ["server-rack", "zhang-makris-2001", "tso-wong-1989"])
def test_named_blocks_keep_their_restitution(name: str, tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    assert rocksteady(f"explore --block {name} --no-browser --out", page).code == 0
    assert float(view_in(page)["r"]) == Block.named(name).restitution
    assert view_in(page)["units"] == "si"


# ------------------------------------------------------------------------------------- records


def test_records_are_put_in_with_their_names(tmp_path: Path, file: Path) -> None:
    page, other = tmp_path / "page.html", at2(tmp_path / "[b]<i>.AT2", samples(2, 0.3))
    ran = rocksteady("explore --json --record", file, "--record", other, "--out", page)
    assert ran.json["records"] == ["hut.AT2 090", "[b]<i>.AT2 090"]
    assert ran.json["view"]["tab"] == "quake"
    found = motions_in(page)
    assert [each["name"] for each in found] == ran.json["records"]
    assert {each["dt"] for each in found} == {0.02}


def test_a_vertical_channel_is_left_out_unless_it_is_chosen(tmp_path: Path) -> None:
    table = tmp_path / "three.csv"
    table.write_text(
        "Time (s),N-S (g),E-W (g),U-D (g)\n0,.1,.2,.3\n.1,.2,.3,.4\n.2,.1,.1,.1\n", "utf-8"
    )
    page = tmp_path / "page.html"
    ran = rocksteady("explore --no-browser --record", table, "--out", page)
    assert "2 records; 1 channel left out: 1 vertical; --channel takes one" in ran.err
    assert [each["name"] for each in motions_in(page)] == ["three.csv N-S", "three.csv E-W"]
    ran = rocksteady("explore --force --channel U-D --record", table, "--out", page)
    assert "U-D is vertical: it shakes across" in ran.err
    assert [each["name"] for each in motions_in(page)] == ["three.csv U-D"]


def test_an_unreadable_record_is_one_line_and_nothing_is_written(tmp_path: Path) -> None:
    bad, page = tmp_path / "bad.AT2", tmp_path / "page.html"
    bad.write_bytes(np.arange(256, dtype=np.uint8).tobytes())
    line = refused("explore --record", bad, "--out", page)
    assert "bad.AT2" in line
    assert not page.exists()
    assert list((tmp_path / "temporary").iterdir()) == []


def test_the_unit_of_a_record_is_asked_for_by_its_flag(tmp_path: Path) -> None:
    table = tmp_path / "table.csv"
    table.write_text("t,acc\n0,1\n0.1,2\n0.2,1\n", encoding="utf-8")
    assert "--units" in refused("explore --record", table)
    page = tmp_path / "page.html"
    assert rocksteady("explore --units g --record", table, "--out", page).code == 0
    assert len(motions_in(page)) == 1


# ------------------------------------------------------------------------------------- browser


def test_no_browser_is_opened_where_none_is_wanted(opened: list[str], tmp_path: Path) -> None:
    assert rocksteady("explore --no-browser --out", tmp_path / "page.html").code == 0
    assert opened == []


def test_the_screen_says_where_the_page_lies_without_a_window_system_too(
    opened: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("BROWSER", "DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr("sys.platform", "linux")
    page = tmp_path / "page.html"
    ran = rocksteady("explore --out", page)
    assert ran.code == 0
    assert ran.out.replace("\\\n ", "").endswith(f"next: python3 -m webbrowser {page}\n")
    assert opened == []


@pytest.mark.parametrize("error", [None, webbrowser.Error("none"), FileNotFoundError("none")])
def test_a_browser_that_fails_ends_nothing(
    error: Exception | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(_: str) -> bool:
        if error is not None:
            raise error
        return False

    monkeypatch.setattr(webbrowser, "open", broken)
    assert rocksteady("explore --out", tmp_path / "page.html").code == 0


# ------------------------------------------------------------------------------------ refusals


@pytest.mark.parametrize(
    ("flags", "needles"),
    [
        ("--left-m 0.2 --right-m 0.3 --height-m 2", ["--left-m and --right-m", "sides are alike"]),
        ("--width-m 0.5 --height-m 2 --offset-m 0.1", ["--offset-m", "sides are alike"]),
        (
            "--width-m 0.5 --height-m 2 --mass-centre-height-m 0.8",
            ["--mass-centre-height-m make", "homogeneous"],
        ),
        ("--width-m 0.5 --height-m 2 -r 0.8,0.9", ["--restitution/-r", "sides are alike"]),
        ("--block statue-on-plinth", ["--block = 'statue-on-plinth'", "sides are alike"]),
        ("--block gas-cylinder", ["--block = 'gas-cylinder'", "homogeneous"]),
        ("--one-sided -r 0.5", ["--one-sided", "sides are alike"]),
        ("--width-m 0.5 --height-m 2 --gravity-m-s2 1.6", ["--gravity-m-s2 = 1.6"]),
        ("-r 0.8 --model nonlinear", ["--model = 'nonlinear'", "slenderness"]),
        ("--accel-g 0.3", ["--accel-g = '0.3'", "need a block"]),
        ("-A 1e4", ["--amplitude/-A = 10000.0", "[0, 1000]"]),
        ("-A 1:2:3", ["--amplitude/-A"]),
        ("--start steady:2", ["--start = 'steady:2'"]),
        ("--start 1", ["--start = '1'"]),
        ("--tab size --model linear", ["--tab = 'size'", "full equations", "explore"]),
        (
            "--tab map",
            ["--tab = 'map'", "shake, start, quake, size, explore"],
        ),
        ("--scale 2", ["--scale = '2'", "--record"]),
        ("--units g", ["--units = 'g'", "--record"]),
        ("--force", ["--force", "--out"]),
        ("--out page.png", ["--out = 'page.png'", ".html"]),
        ("--out no/such/page.html", ["--out = 'no/such/page.html'", "folder"]),
        ("--record gone.AT2", ["gone.AT2"]),
    ],
)
def test_what_the_page_cannot_show_is_one_line_that_names_the_flag(
    flags: str, needles: list[str], opened: list[str], tmp_path: Path
) -> None:
    line = refused(f"explore {flags}")
    for needle in needles:
        assert needle in line, line
    assert opened == []
    assert list((tmp_path / "temporary").iterdir()) == []


def test_a_file_that_exists_needs_force_and_a_record_is_never_written_over(
    tmp_path: Path, file: Path
) -> None:
    page = tmp_path / "page.html"
    page.write_text("mine", encoding="utf-8")
    assert "it exists" in refused("explore --out", page)
    assert page.read_text(encoding="utf-8") == "mine"
    assert rocksteady("explore --force --out", page).code == 0
    assert view_in(page)
    html = file.rename(tmp_path / "record.html")
    assert "this file is read" in refused("explore --force --record", html, "--out", html)


def test_a_page_that_cannot_be_made_leaves_no_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(write, "save_text", full)
    assert "No space left" in refused("explore")
    assert list((tmp_path / "temporary").iterdir()) == []


def test_a_file_that_cannot_be_written_is_named_by_its_flag(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OutputError("path", "page.html", "No space left on device", "make room")

    monkeypatch.setattr(write, "save_text", full)
    said = refused("explore --out", tmp_path / "page.html")
    assert "--out" in said
    assert "No space left" in said
