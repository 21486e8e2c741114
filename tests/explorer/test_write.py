"""The explorer as a file: ground motions to the last bit, any name, and never half a page."""

import gzip
import json
from base64 import b64decode
from pathlib import Path

import numpy as np
import pytest

from rocksteady import Harmonic, Record, write_explorer
from rocksteady.errors import InputError, MissingKernelsError, OutputError
from rocksteady.explorer import _motions, write
from rocksteady.explorer._module import page_module
from rocksteady.explorer._motions import motions_of
from rocksteady.explorer._program import SCENES
from rocksteady.export import ExplorerView
from rocksteady.records import Recording
from tests.every import every
from tests.explorer.in_node import InNode
from tests.explorer.test_page import NASTY, Reader
from tests.strategies import PLAIN

SAMPLES = np.array([0.1, -0.0, 5e-324, -1e49, 1.0 / 3.0, 9.80665])


def record(name: str | None = "made") -> Record:
    return Record(acceleration_m_s2=SAMPLES, dt_s=0.005, name=name)


@pytest.fixture
def module() -> Path:
    if PLAIN:
        pytest.skip("no library is loaded")
    try:
        return page_module()
    except MissingKernelsError as error:
        pytest.skip(f"{error}")


def test_the_page_reads_each_sample_to_the_last_bit(in_node: InNode) -> None:
    lines = """
    const { motionsPutIn } = await import(parts('shell/motions.mjs'));
    answer(motionsPutIn(JSON.stringify(asked)).map(({ acceleration, ...rest }) => (
        { ...rest, bits: [...new BigInt64Array(acceleration.buffer)].map(String) })));
    """
    given = [record(), record(name="second")]
    found = in_node(lines, motions_of(given))
    bits = [str(each) for each in SAMPLES.view(np.int64)]
    assert [each["name"] for each in found] == ["made", "second"]
    assert all(each["bits"] == bits and each["dt"] == 0.005 for each in found)


def test_a_recording_brings_its_file_and_what_was_done_to_it() -> None:
    given = Recording(
        record=record(),
        format="peer-at2",
        path=Path("folder/hut.AT2"),
        units_in_file="g",
        component="090",
        event="Somewhere",
        processing=("mean taken off",),
    )
    (found,) = motions_of([given])
    assert (found["name"], found["note"]) == ("hut.AT2 090", "Somewhere, 090; mean taken off")
    (unnamed,) = motions_of([record(None)])
    assert unnamed["name"] == "record 1"
    (long,) = motions_of([record("x" * 5000)])
    assert len(str(long["name"])) == _motions.LONGEST_TEXT


def test_the_page_holds_view_motions_and_module(module: Path, tmp_path: Path) -> None:
    view = ExplorerView(motion=Harmonic(amplitude=2.0, frequency_ratio=6.0), tab="basins")
    file = write_explorer(tmp_path / "page.html", view, records=[record()])
    assert file.stat().st_size <= 600_000
    page = Reader(file.read_text(encoding="utf-8"))
    state = json.loads(page.texts["first-view"])
    assert (state["A"], state["W"], state["tab"]) == ("2", "6", "basins")
    assert json.loads(page.texts["motions"]) == motions_of([record()])
    assert gzip.decompress(b64decode(page.texts["kernels"])) == module.read_bytes()


@pytest.mark.slow
@pytest.mark.usefixtures("module")
@pytest.mark.parametrize(
    "name", [NASTY, "\udcff\ud800", "\u2028\u202e\0\n", "${alert(1)}", "{{csp}}"]
)
def test_any_name_is_text(name: str, tmp_path: Path) -> None:
    plain, nasty = (
        Reader(write_explorer(tmp_path / "p.html", records=[record(each)]).read_text("utf-8"))
        for each in ("plain", name)
    )
    assert [tag for tag, _ in nasty.found] == [tag for tag, _ in plain.found]
    assert nasty.texts["program"] == plain.texts["program"]
    (found,) = json.loads(nasty.texts["motions"])
    assert found["name"].isprintable()


def test_too_many_samples_are_refused_before_anything_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(_motions, "LARGEST", 2 * SAMPLES.nbytes)
    assert len(motions_of([record()] * 2)) == 2
    with pytest.raises(InputError, match=r"^records = '3 with .* MB of samples'.*resample"):
        write_explorer(tmp_path / "page.html", records=[record()] * 3)
    assert list(tmp_path.iterdir()) == []


def test_without_its_module_there_is_no_page(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def missing() -> Path:
        raise MissingKernelsError("explorer.wasm", None, "", "")

    monkeypatch.setattr(write, "page_module", missing)
    with pytest.raises(MissingKernelsError):
        write_explorer(tmp_path / "page.html")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.usefixtures("module")
def test_an_old_page_is_replaced_whole_or_stays(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "page.html"
    file.write_text("old", encoding="utf-8")
    with monkeypatch.context() as patch:
        patch.setattr("os.fsync", lambda _: (_ for _ in ()).throw(OSError(28, "No space left")))
        with pytest.raises(OutputError, match="No space left"):
            write_explorer(file)
    assert file.read_text(encoding="utf-8") == "old"
    assert write_explorer(str(file)) == file
    assert file.read_text(encoding="utf-8").startswith("<!doctype html>")
    assert list(tmp_path.iterdir()) == [file]
    with pytest.raises(OutputError, match="path = "):
        write_explorer(tmp_path / "no" / "page.html")


@every("name", ["page", "page.csv", "page.html.gz", "html", ".html"])
def test_another_ending_is_refused_and_no_file_of_that_name_is_touched(
    name: str, tmp_path: Path
) -> None:
    file = tmp_path / name
    file.write_text("somebody's table", encoding="utf-8")
    with pytest.raises(OutputError, match=r"the extension \.html"):
        write.write_explorer(file)
    assert file.read_text(encoding="utf-8") == "somebody's table"


def test_a_recording_is_not_replaced_by_its_page(tmp_path: Path) -> None:
    file = tmp_path / "quake.html"
    file.write_text("a record", encoding="utf-8")
    recording = Recording(record=record(), format="table", path=file, units_in_file="g")
    with pytest.raises(OutputError, match="this file is read"):
        write.write_explorer(tmp_path / ".." / tmp_path.name / "quake.html", records=[recording])
    assert file.read_text(encoding="utf-8") == "a record"


@every("scene", SCENES)
def test_a_scene_alone_is_small_and_holds_its_words_and_kernels(
    scene: str, module: Path, tmp_path: Path
) -> None:
    file = write_explorer(tmp_path / "scene.html", ExplorerView(scene=scene), embed=True)
    page = Reader(file.read_text(encoding="utf-8"))
    assert gzip.decompress(b64decode(page.texts["kernels"])) == module.read_bytes()
    assert json.loads(page.texts["first-view"]) == {"at": scene}
    (policy,) = (each["content"] for _, each in page.found if "http-equiv" in each)
    assert policy is not None
    assert policy.startswith("default-src 'none'; script-src 'sha256-")
    assert file.stat().st_size <= 250_000


def test_what_is_embedded_is_one_scene_and_says_nothing_else(tmp_path: Path) -> None:
    for view, records in (
        (ExplorerView(), None),
        (ExplorerView(scene="lab"), None),
        (ExplorerView(scene="fall", tab="pulse"), None),
        (ExplorerView(scene="fall"), [record()]),
    ):
        with pytest.raises(InputError, match="embed"):
            write_explorer(tmp_path / "scene.html", view, records=records, embed=True)
    assert not list(tmp_path.iterdir())


def test_the_scenes_of_python_are_those_of_the_page(in_node: InNode) -> None:
    lines = "answer((await import(parts('shell/state.mjs'))).STORY);"
    assert in_node(lines) == list(SCENES)
