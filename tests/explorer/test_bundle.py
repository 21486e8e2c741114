"""The page's modules joined into one script."""

import re
import subprocess
from pathlib import Path

import pytest

from rocksteady.explorer._bundle import ENTRY, PARTS, PartError, joined, script
from rocksteady.explorer._program import SCRIPTS, entry_of
from tests.every import every
from tools.aot.replay.wasm import node


def written(folder: Path, **modules: str) -> Path:
    for name, text in modules.items():
        (folder / f"{name}.mjs").write_text(text, encoding="utf-8")
    return folder / "main.mjs"


def test_a_module_stands_after_those_that_it_imports() -> None:
    order = list(joined(ENTRY))
    assert order[-1] == ENTRY
    for path, text in joined(ENTRY).items():
        for name in re.findall(r"^(?:import .*|\}) from '(.*)';$", text, re.MULTILINE):
            assert order.index((path.parent / name).resolve()) < order.index(path), path.name


def test_every_module_but_those_of_types_is_joined() -> None:
    modules = {path for name in SCRIPTS for path in joined(entry_of(name))}
    assert modules == set(PARTS.rglob("*.mjs"))


def test_the_script_has_no_imports_no_exports_and_begins_by_itself() -> None:
    text = script()
    assert "\nimport " not in text
    assert "\nexport " not in text
    assert text.endswith("$.at(-1).start();\n}\n")


@every("name", SCRIPTS)
def test_the_script_begins_in_a_worker_which_has_no_window(name: str, tmp_path: Path) -> None:
    file = tmp_path / "worker.cjs"
    text = f"globalThis.onmessage = null;\n{script(entry_of(name))}\nconsole.log(typeof onmessage);"
    file.write_text(text, encoding="utf-8")
    ran = subprocess.run([*node(), str(file)], check=False, capture_output=True, text=True)
    assert (ran.stdout, ran.stderr) == ("function\n", "")


def test_modules_give_what_they_export_and_keep_the_rest(tmp_path: Path) -> None:
    entry = written(
        tmp_path,
        main="import {\n  two,\n} from './other.mjs';\nconst own = 3;\n"
        "export function start() { console.log(own * two); }\n",
        other="/** Two. */\nexport const two = 2;\nconst own = 5;\n",
    )
    text = script(entry)
    assert "Two." not in text
    assert "return { two };" in text
    assert "const { two } = $[0];" in text
    ran = subprocess.run([*node(), "-e", text], capture_output=True, text=True, check=True)
    assert ran.stdout == "6\n"


@every(
    ("main", "other", "fault"),
    [
        ("", "import { start } from './main.mjs';\n", "in a circle"),
        ("export default 3;\n", "", "not joined"),
        ("import * as all from './other.mjs';\n", "", "not joined"),
        ("const a = '</script>';\n", "", "end it in a page"),
        ("const a = `x\ny`;\n", "", "over several lines"),
    ],
)
def test_what_cannot_be_joined_is_refused(
    main: str, other: str, fault: str, tmp_path: Path
) -> None:
    head = "import { b } from './other.mjs';\n"
    entry = written(tmp_path, main=head + main, other=other + "export const b = 1;\n")
    with pytest.raises(PartError, match=fault):
        script(entry)


def test_a_comment_in_front_of_code_takes_no_code_with_it(tmp_path: Path) -> None:
    entry = written(
        tmp_path, main="/** @type {any} */ (a());\n/** Note. */\nfunction a() {}\n// end\n"
    )
    assert "(a());\nfunction a() {}\nreturn {" in script(entry)
