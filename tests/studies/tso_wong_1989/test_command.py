"""`rocksteady paper`: its contract, its text, and when it says no."""

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from rocksteady.cli.app import app
from rocksteady.show.export.files import picture_files
from rocksteady.studies.tso_wong_1989 import _study as study_module
from rocksteady.studies.tso_wong_1989._study import FIGURES, Study
from tests.cli.program import refused, rocksteady
from tests.studies.tso_wong_1989.whole import study, undrawn

PROGRESS = re.compile(r"(computing|drawing): \d+ of \d+ \(\d+ %\), .+")


@pytest.fixture
def ready(monkeypatch: pytest.MonkeyPatch) -> Study:
    """The whole study, already computed, for a program that then need not."""
    whole = undrawn(study())

    def reproduce(*, only: object, done: Callable[[str], None]) -> Study:
        assert not only
        for timed in whole.panels:
            done(f"figure {timed.panel.id}")
        for claim in whole.claims:
            done(claim.id)
        return whole

    monkeypatch.setattr(study_module, "reproduce", reproduce)
    return whole


def test_the_command_is_there_and_explains_itself() -> None:
    assert "paper" in {command.name for command in app.registered_commands}
    ran = rocksteady("paper --help")
    assert (ran.code, ran.err) == (0, "")
    for word in ("--out", "--only", "--force", "--json", "claims.json", "report.html"):
        assert word in ran.out


@pytest.mark.slow
def test_the_json_of_the_whole_study_keeps_the_contract(ready: Study, tmp_path: Path) -> None:
    folder = tmp_path / "out"
    ran = rocksteady("paper --json --out", folder)
    assert ran.code == 0
    values = ran.json
    assert next(iter(values)) == "schema"
    assert values["schema"] == "rocksteady/paper/1"
    assert len(values["claims"]) == len(ready.claims)
    for claim in values["claims"]:
        assert list(claim)[:2] == ["id", "statement"]
        for name in ("id", "statement", "verdict", "detail"):
            assert type(claim[name]) is str
            assert claim[name]
        assert claim["verdict"] in {"reproduced", "corrected", "not-checkable"}
    assert values["files"] == sorted(file.name for file in folder.iterdir())
    assert {"claims.json", "report.html"} <= set(values["files"])
    written = json.loads((folder / "claims.json").read_text(encoding="utf-8"))
    assert written == {name: value for name, value in values.items() if name in written}


@pytest.mark.slow
def test_progress_goes_to_standard_error_alone(ready: Study, tmp_path: Path) -> None:
    ran = rocksteady("paper --out", tmp_path / "out")
    assert ran.code == 0
    lines = [line for line in ran.err.splitlines() if not line.startswith("compiling")]
    assert lines
    assert all(PROGRESS.fullmatch(line) for line in lines), ran.err
    for task, steps in (("computing", len(FIGURES) + len(ready.claims)), ("drawing", ready.steps)):
        mine = [line for line in lines if line.startswith(task)]
        assert 5 <= len(mine) <= 12
        assert mine[-1].startswith(f"{task}: {steps} of {steps} (100 %), ")
        assert not PROGRESS.search(ran.out)


@pytest.mark.slow
def test_the_text_names_what_is_not_as_the_paper_says(ready: Study, tmp_path: Path) -> None:
    folder = tmp_path / "out"
    ran = rocksteady("paper --more --out", folder)
    counts = ready.counts()
    assert ran.out.startswith(
        f"{counts['reproduced']} of {len(ready.claims)} statements of Tso and Wong (1989) hold; "
        f"{counts['corrected']} are corrected.\n"
    )
    assert f"{counts['not-checkable']} statements cannot be checked" in ran.out
    listed = [line.split()[0] for line in ran.out.splitlines() if re.match(r"(E\d|[a-z-]+-)", line)]
    for claim in ready.claims:
        assert (claim.id in listed) == (claim.verdict.value == "corrected"), claim.id
    assert max(map(len, ran.out.replace(str(folder), "").splitlines())) <= 80
    assert f"webbrowser {folder / 'report.html'}" in ran.out
    short = rocksteady("paper --force --out", folder).out.replace(str(folder), "out")
    assert short == ran.out.replace(str(folder), "out")[: len(short)]
    assert len(short.splitlines()) <= 8


@pytest.mark.slow
def test_some_figures_are_written_without_statements(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    ran = rocksteady("paper --only 10 --only 3b --json --out", folder)
    assert ran.code == 0
    values = ran.json
    assert values["claims"] == []
    assert values["out"] == str(folder)
    expected = {
        f"figure-{name}.{kind}" for name in ("3b", "10") for kind in ("csv", "pdf", "png", "svg")
    }
    assert set(values["files"]) == {file.name for file in folder.iterdir()} == expected
    text = rocksteady("paper --only 10 --force --out", folder)
    assert text.code == 0
    assert "".join(text.out.split()) == f"Wrote4filesofthefiguresinto{folder}."


@pytest.mark.slow
def test_the_command_that_a_panel_names_makes_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    command = study_module.reproduce(only=["10"]).panels[0].panel.command
    program, *rest = command.split()
    assert program == "rocksteady"
    assert rocksteady(" ".join(rest)).code == 0
    assert (tmp_path / "figure-10" / "figure-10.png").exists()


# -------------------------------------------------------------------------------------- refusals


@pytest.fixture
def nothing_is_computed(monkeypatch: pytest.MonkeyPatch) -> None:
    def reproduce(**_: object) -> Study:
        message = "computed before it was refused"
        raise AssertionError(message)

    monkeypatch.setattr(study_module, "reproduce", reproduce)


@pytest.mark.usefixtures("nothing_is_computed")
@pytest.mark.parametrize("figure", ["14", "2", "8d", "figure-3a", "12B"])
def test_a_figure_that_is_not_there_is_refused_with_those_that_are(
    figure: str, tmp_path: Path
) -> None:
    line = refused(f"paper --only {figure} --out", tmp_path / "out")
    assert f"--only = '{figure}'" in line
    assert "3a 3b 4a 4b" in line
    assert list(tmp_path.iterdir()) == []


@pytest.mark.usefixtures("nothing_is_computed")
def test_a_folder_that_is_in_the_way_is_refused_before_anything_is_computed(
    tmp_path: Path,
) -> None:
    (tmp_path / "figure-9b.png").touch()
    (tmp_path / "file").touch()
    for only, folder, words in (
        ("", tmp_path, ["--out", "figure-9b.png", "--force"]),
        ("--only 9b", tmp_path, ["--out", "figure-9b.png", "--force"]),
        ("", tmp_path / "file", ["--out", "it is a file", "name a folder"]),
        ("", tmp_path / "no" / "where", ["--out", "does not exist", "create"]),
    ):
        line = refused(f"paper {only} --out", folder)
        assert all(word in line for word in words), line
    assert sorted(file.name for file in tmp_path.iterdir()) == ["figure-9b.png", "file"]


def test_out_must_be_given() -> None:
    assert "--out" in refused("paper")
    assert "--only" in refused("paper --out somewhere --only")
    assert "--onyl" in refused("paper --out somewhere --onyl 3a")


def test_force_replaces_and_leaves_the_rest(tmp_path: Path) -> None:
    for name in ("figure-10.png", "mine.txt"):
        (tmp_path / name).write_text("old", encoding="utf-8")
    assert rocksteady("paper --only 10 --force --out", tmp_path).code == 0
    assert (tmp_path / "figure-10.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "mine.txt").read_text(encoding="utf-8") == "old"


@pytest.mark.slow
def test_a_disk_that_fills_up_ends_in_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(study_module, "save_csv", full)
    ran = rocksteady("paper --only 10 --out", tmp_path / "out")
    assert (ran.code, ran.out) == (2, "")
    last = ran.err.splitlines()[-1]
    assert last.startswith("rocksteady: --out = ")
    assert "No space left on device" in last
    assert "Traceback" not in ran.err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_an_interrupted_paper_says_how_it_goes_on_and_draws_nothing_twice(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    command, whole, folder = "paper --only 10 --only 13a", tmp_path / "whole", tmp_path / "out"
    assert rocksteady(f"{command} --out", whole).code == 0
    monkeypatch.setattr("rocksteady.sweep.cases.queue.usable_cores", lambda: 1)
    drawn: list[str] = []

    def drawing(figure: object, *, command: str) -> dict[str, bytes]:
        if drawn:
            raise KeyboardInterrupt
        drawn.append(command)
        return picture_files(figure, command=command)  # type: ignore[arg-type]

    with monkeypatch.context() as patched:
        patched.setattr(study_module, "picture_files", drawing)
        ran = rocksteady(f"{command} --out", folder)
    assert (ran.code, ran.out) == (130, "")
    assert ran.err.splitlines()[-2] == f"  rocksteady {command} --out {folder} --resume"
    assert [file.name for file in folder.iterdir()] == [".unfinished"]
    assert "--resume" in refused(f"{command} --out", folder)
    assert "of another only" in refused("paper --only 10 --resume --out", folder)
    drawn.clear()
    with monkeypatch.context() as patched:
        patched.setattr(study_module, "picture_files", drawing)
        assert rocksteady(f"{command} --resume --out", folder).code == 0
    assert len(drawn) == 1, "of the figure that was not finished"
    assert {file.name: file.read_bytes() for file in folder.iterdir()} == {
        file.name: file.read_bytes() for file in whole.iterdir()
    }
