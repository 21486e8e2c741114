"""`rocksteady study atlas`: its contract, its text, and when it says no."""

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from rocksteady.studies.atlas import Atlas
from rocksteady.studies.atlas import study as module
from rocksteady.studies.atlas.study import steps
from tests.cli.program import refused, rocksteady
from tests.studies.atlas.small import small, tiny

PROGRESS = re.compile(r"(computing|drawing): \d+ of \d+ \(\d+ %\), .+")
AXES = "-A 0.4:8:16 -W 0.6:12:20"


@pytest.fixture
def ready(monkeypatch: pytest.MonkeyPatch) -> Atlas:
    """The small atlas, already computed, with pictures that cost nothing."""

    def ready_atlas(*, done: Callable[[str], None], **_: object) -> Atlas:
        for step in range(steps(small().plane)):
            done(f"step {step}")
        return small()

    monkeypatch.setattr(module, "atlas", ready_atlas)
    for name in ("draw_families", "draw_coexistence", "draw_from_rest"):
        monkeypatch.setattr(module, name, tiny)
    return small()


def test_the_command_explains_itself() -> None:
    assert "study" in rocksteady("--help").out
    assert "atlas" in rocksteady("study --help").out
    ran = rocksteady("study atlas --help")
    assert (ran.code, ran.err) == (0, "")
    for word in ("--out", "--restitution", "--amplitude", "--frequency-ratio", "--order", "--json"):
        assert word in ran.out


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
    assert f"open {folder / 'atlas.html'}" in ran.out
    assert "12 files in" in ran.out
    assert max(map(len, ran.out.replace(str(folder), "").splitlines())) <= 80
    lines = [line for line in ran.err.splitlines() if not line.startswith("compiling")]
    assert all(PROGRESS.fullmatch(line) for line in lines), ran.err
    assert lines[-1].startswith("drawing: 4 of 4 (100 %)")


def test_it_computes_what_it_is_asked_for(tmp_path: Path) -> None:
    ran = rocksteady("study atlas -r 0.9 -A 1:3:3 -W 2:6:3 -n 1 --json --out", tmp_path / "out")
    assert ran.code == 0
    values = ran.json
    assert values["restitution"] == 0.9
    assert values["orders"] == [1]
    assert values["cells"] == {"amplitude": 3, "frequency_ratio": 3}


def test_an_interruption_ends_with_its_code_and_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(module, "coexistence", interrupted)
    ran = rocksteady("study atlas -A 1:3:3 -W 2:6:3 -n 1 --out", tmp_path / "out")
    assert (ran.code, ran.out) == (130, "")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
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
