"""`rocksteady study atlas`: its contract, its text, and when it says no."""

import json
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from rocksteady.studies.atlas import _study as module
from rocksteady.studies.atlas._study import Atlas, steps
from tests.cli.program import refused, rocksteady
from tests.every import every
from tests.studies.atlas.small import smallest, tiny

PROGRESS = re.compile(r"(computing|drawing): \d+ of \d+ \(\d+ %\), .+")
AXES = "-A 1:3:3 -W 2:6:3 -n 1"
DRAWN = ("draw_families", "draw_coexistence", "draw_from_rest")


@pytest.fixture
def ready(monkeypatch: pytest.MonkeyPatch) -> Atlas:
    """The smallest atlas, already computed, with pictures that cost nothing."""

    def ready_atlas(*, done: Callable[[str], None], **_: object) -> Atlas:
        for step in range(steps(smallest().plane)):
            done(f"step {step}")
        return smallest()

    monkeypatch.setattr(module, "atlas", ready_atlas)
    for name in DRAWN:
        monkeypatch.setattr(module, name, tiny)
    return smallest()


def test_the_command_explains_itself() -> None:
    assert "study" in rocksteady("--help").out
    assert "atlas" in rocksteady("study --help").out
    ran = rocksteady("study atlas --help")
    assert (ran.code, ran.err) == (0, "")
    for word in ("--out", "--restitution", "--amplitude", "--frequency-ratio", "--order", "--json"):
        assert word in ran.out


@pytest.mark.slow
def test_the_json_keeps_the_contract(ready: Atlas, tmp_path: Path) -> None:
    folder = tmp_path / "out"
    ran = rocksteady(f"study atlas {AXES} --json --out", folder)
    assert ran.code == 0
    values = ran.json
    assert next(iter(values)) == "schema"
    assert values["schema"] == "rocksteady/atlas/1"
    assert values["out"] == str(folder)
    assert values["files"] == sorted(file.name for file in folder.iterdir())
    written = json.loads((folder / "atlas.json").read_text(encoding="utf-8"))
    assert written == {name: value for name, value in values.items() if name in written}
    assert written["coexistence"]["most"] == ready.found.motions.max()


@pytest.mark.usefixtures("ready")
def test_the_text_says_where_to_look_and_progress_goes_to_standard_error(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    ran = rocksteady(f"study atlas {AXES} --out", folder)
    assert ran.code == 0
    assert f"webbrowser {folder / 'atlas.html'}" in ran.out
    assert "15 in" in ran.out
    screen = ran.out.replace(str(folder), "out").splitlines()
    assert len(screen) <= 8
    assert max(map(len, screen)) <= 80
    assert screen[0] == (
        "Several steady motions exist side by side in 55.6 % of the plane, 2 at the most."
    )
    assert rocksteady(f"study atlas {AXES} --force --quiet --out", folder).out == f"{screen[0]}\n"
    assert len(rocksteady(f"study atlas {AXES} --force --more --out", folder).out) > len(ran.out)
    lines = [line for line in ran.err.splitlines() if not line.startswith("compiling")]
    assert all(PROGRESS.fullmatch(line) for line in lines), ran.err
    assert lines[-1].startswith("drawing: 4 of 4 (100 %)")


@pytest.mark.slow
def test_it_computes_what_it_is_asked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in DRAWN:
        monkeypatch.setattr(module, name, tiny)
    ran = rocksteady("study atlas -r 0.9 -A 1:3:3 -W 2:6:3 -n 1 --json --out", tmp_path / "out")
    assert ran.code == 0
    values = ran.json
    assert values["restitution"] == 0.9
    assert values["orders"] == [1]
    assert values["cells"] == {"amplitude": 3, "frequency_ratio": 3}


def contents(folder: Path) -> dict[str, bytes]:
    """Return the files of a study, without the page, which has the run's time."""
    files = {file.name: file.read_bytes() for file in folder.iterdir() if file.is_file()}
    assert files.pop("atlas.html")
    return files


TINY = f"study atlas {AXES}"


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The files of the smallest atlas, of a run without an interruption."""
    folder = tmp_path_factory.mktemp("whole") / "out"
    assert rocksteady(f"{TINY} --out", folder).code == 0
    assert sorted(folder.iterdir()) == sorted(folder.glob("[!.]*")), "no parts are left"
    return contents(folder)


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The same with pictures that cost nothing: nearly all the time goes into pictures."""
    folder = tmp_path_factory.mktemp("plain") / "out"
    with pytest.MonkeyPatch.context() as patched:
        for name in DRAWN:
            patched.setattr(module, name, tiny)
        assert rocksteady(f"{TINY} --out", folder).code == 0
    return contents(folder)


@pytest.mark.slow
@every("step", ["coexistence", "report_html"])
def test_an_interrupted_atlas_says_how_it_goes_on_and_does(
    step: str, plain: dict[str, bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in DRAWN:
        monkeypatch.setattr(module, name, tiny)

    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    folder = tmp_path / "out"
    with monkeypatch.context() as patched:
        patched.setattr(module, step, interrupted)
        ran = rocksteady(f"{TINY} --out", folder)
    assert (ran.code, ran.out) == (130, "")
    lines = ran.err.splitlines()
    assert lines[-3] == f"finished parts are kept in {folder}; to go on:"
    assert lines[-2] == f"  rocksteady {TINY} --out {folder} --resume"
    assert [file.name for file in folder.iterdir()] == [".unfinished"]
    assert "--resume" in refused(f"{TINY} --out", folder)
    line = refused(f"{TINY} -r 0.7 --resume --out", folder)
    assert "of another restitution" in line
    if step != "coexistence":  # what is finished is not computed again

        def computed(*_: object, **__: object) -> None:
            message = "computed again"
            raise AssertionError(message)

        monkeypatch.setattr("rocksteady.studies.atlas.analysis.columns.column", computed)
        monkeypatch.setattr(
            "rocksteady.studies.atlas.analysis.coexistence.find_attractors", computed
        )
    assert rocksteady(f"{TINY} --resume --out", folder).code == 0
    assert contents(folder) == plain
    assert not (folder / ".unfinished").exists()


@every("name", ["part-mine.zarr/x", "figure-mine.png", "study.json"])
def test_a_folder_of_parts_that_no_study_described_is_refused(name: str, tmp_path: Path) -> None:
    file = tmp_path / "out" / ".unfinished" / name
    file.parent.mkdir(parents=True)
    file.write_text("precious")
    for flag in ("", "--force", "--resume"):
        assert "no study wrote" in refused(f"{TINY} {flag} --out", tmp_path / "out")
    assert file.read_text() == "precious"


@pytest.mark.slow
def test_force_begins_an_interrupted_atlas_anew(
    plain: dict[str, bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    for name in DRAWN:
        monkeypatch.setattr(module, name, tiny)
    folder = tmp_path / "out"
    with monkeypatch.context() as patched:
        patched.setattr(module, "from_rest", interrupted)
        assert rocksteady(f"{TINY} -r 0.7 --out", folder).code == 130
    (folder / ".unfinished" / "mine.txt").write_text("precious")
    inside = next((folder / ".unfinished").glob("part-*.zarr")) / "thesis.txt"
    inside.write_text("precious")
    for flag in ("--force", "-r 0.7 --resume"):
        assert "thesis.txt" in refused(f"{TINY} {flag} --out", folder)
    inside.unlink()
    assert rocksteady(f"{TINY} --force --out", folder).code == 0
    assert contents(folder) == plain
    assert [file.name for file in (folder / ".unfinished").iterdir()] == ["mine.txt"]


@pytest.mark.slow
def test_an_atlas_that_is_killed_at_any_time_gives_the_same_bytes(
    whole: dict[str, bytes], tmp_path: Path
) -> None:
    folder, kills = tmp_path / "out", 0
    command = [sys.executable, "-m", "rocksteady", *TINY.split(), "--resume", "--out", str(folder)]
    for wait in (1.5, 2.5, 1000.0):
        running = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        try:
            running.communicate(timeout=wait)
        except subprocess.TimeoutExpired:
            running.kill()
            running.communicate()
            kills += 1
            continue
        assert running.returncode == 0
    assert kills > 0
    assert contents(folder) == whole
    assert not (folder / ".unfinished").exists()


@every(
    ("arguments", "words"),
    [
        ("-r 1", ["--restitution/-r", "(0, 1)"]),
        ("-r housner", ["--restitution/-r", "number"]),
        ("-A 2", ["--amplitude/-A", "three values"]),
        ("-A 0:8:20", ["--amplitude/-A", "(0, 1000]"]),
        ("-A log:1:8:20", ["--amplitude/-A", "evenly spaced"]),
        ("-W 5:1:20", ["--frequency-ratio/-W", "ascend"]),
        ("-W what", ["--frequency-ratio/-W", "number"]),
        ("-n 4", ["--order/-n", "odd"]),
        ("--onyl", ["--onyl"]),
    ],
)
def test_what_is_no_plane_is_refused_in_one_line(
    arguments: str, words: list[str], tmp_path: Path
) -> None:
    line = refused(f"study atlas {arguments} --out", tmp_path / "out")
    assert all(word in line for word in words), line
    assert list(tmp_path.iterdir()) == []


def test_a_folder_in_the_way_is_refused_before_anything_is_computed(tmp_path: Path) -> None:
    (tmp_path / "atlas.html").touch()
    (tmp_path / "file").touch()
    for folder, words in (
        (tmp_path, ["--out", "atlas.html", "--force"]),
        (tmp_path / "file", ["--out", "it is a file"]),
        (tmp_path / "no" / "where", ["--out", "does not exist"]),
    ):
        line = refused("study atlas --out", folder)
        assert all(word in line for word in words), line


def test_out_must_be_given() -> None:
    assert "--out" in refused("study atlas")
