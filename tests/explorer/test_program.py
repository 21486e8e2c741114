"""The page's scripts: bundled when the package is built, and refused where parts have changed."""

import json
import re
import subprocess
from pathlib import Path

import pytest

from rocksteady.errors import MissingKernelsError
from rocksteady.explorer import _program as module
from rocksteady.explorer._program import NAME, PARTS, SCRIPTS, parts_hash, program
from rocksteady.kernels.machine_code.sources import libraries_folder
from tests.every import every
from tools.aot.replay.wasm import node
from tools.aot.web import program as bundling
from tools.aot.web.program import bundled, bundler, entry_of, write_scripts

MADE = {name: f"{name}();" for name in SCRIPTS}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where the scripts are looked for, and nothing yet."""
    monkeypatch.setattr(module, "libraries_folder", lambda: tmp_path)
    return tmp_path


def test_scripts_of_these_parts_are_taken(folder: Path) -> None:
    (folder / NAME).write_text(json.dumps({"parts": parts_hash(), **MADE}), "utf-8")
    assert {name: program(name) for name in SCRIPTS} == MADE


def test_a_wheel_has_the_scripts_without_the_parts(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / NAME).write_text(json.dumps({"parts": parts_hash(), **MADE}), "utf-8")
    monkeypatch.setattr(module, "PARTS", folder)
    assert program() == MADE["explorer"]


@every(
    "content",
    [
        None,
        b"",
        b"[]",
        b"\xff",
        json.dumps({"parts": "other", **MADE}).encode(),
        json.dumps({"parts": parts_hash(), "push": "push();"}).encode(),
    ],
)
def test_no_others_are(content: bytes | None, folder: Path) -> None:
    if content is not None:
        (folder / NAME).write_bytes(content)
    with pytest.raises(MissingKernelsError, match=r"put bun on PATH and run `make library`") as no:
        program()
    assert "\n" not in str(no.value)


def test_every_part_is_in_a_script() -> None:
    texts = [(file, file.read_text("utf-8")) for file in PARTS.rglob("*.mjs")]
    taken = {
        (file.parent / name).resolve()
        for file, text in texts
        for name in re.findall(r"from '(\.[^']+)';", text)
    }
    assert {file for file, _ in texts} == taken | set(map(entry_of, SCRIPTS))


@every("name", SCRIPTS)
def test_a_script_starts_in_a_worker_which_has_no_window(name: str, tmp_path: Path) -> None:
    file = tmp_path / "worker.cjs"
    text = f"globalThis.onmessage = null;\n{program(name)}\nconsole.log(typeof onmessage);"
    file.write_text(text, encoding="utf-8")
    ran = subprocess.run([*node(), str(file)], check=False, capture_output=True, text=True)
    assert (ran.stdout, ran.stderr) == ("function\n", "")


@every(
    "text",
    [
        "console.log('</script>');",
        "export default (",
        "console.log('<!--x');",
        "import './missing.mjs';",
    ],
)
def test_what_would_break_the_page_is_refused(text: str, tmp_path: Path) -> None:
    file = tmp_path / "main.mjs"
    file.write_text(f"{text}\nexport function start() {{}}\n", "utf-8")
    with pytest.raises(MissingKernelsError, match=r"main\.mjs cannot be made"):
        bundled(file, bundler())


def test_without_bun_a_line_says_so_and_an_old_script_goes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(bundling, "bundler", list)
    (tmp_path / NAME).write_text("{}", "utf-8")
    write_scripts(tmp_path)
    assert list(tmp_path.iterdir()) == []
    assert capsys.readouterr().err.count("\n") == 1
    (tmp_path / NAME).write_bytes((libraries_folder() / NAME).read_bytes())
    write_scripts(tmp_path)  # needs none
    assert (tmp_path / NAME).is_file()
