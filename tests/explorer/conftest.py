"""What the tests of the page share."""

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest

from rocksteady.errors import MissingKernelsError
from rocksteady.explorer.module import page_module
from tests.explorer.in_node import InNode, script_of
from tests.strategies import PLAIN
from tools.aot.replay.outcome import MissingProgramError
from tools.aot.replay.wasm import node


@pytest.fixture
def in_node(tmp_path: Path) -> InNode:
    if PLAIN:
        pytest.skip("no library is loaded")
    try:
        module = page_module()
        program = node()
    except MissingKernelsError as error:
        pytest.skip(f"{error}")
    except MissingProgramError as error:
        pytest.skip(str(error))

    def run(lines: str, asked: object = None) -> Any:
        given, script = tmp_path / "asked.json", tmp_path / "script.mjs"
        given.write_text(json.dumps(asked), encoding="utf-8")
        script.write_text(script_of(module, given, lines), encoding="utf-8")
        ran = subprocess.run([*program, str(script)], capture_output=True, text=True, check=False)
        assert ran.returncode == 0, ran.stderr
        return json.loads(ran.stdout)

    return run
