"""What a user waits for before anything happens: the interpreter, the import, the help."""

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

COMMANDS = {
    "python -c pass": [sys.executable, "-c", "pass"],
    "import rocksteady": [sys.executable, "-c", "import rocksteady"],
    "rocksteady --help": [str(Path(sys.executable).with_name("rocksteady")), "--help"],
}


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.benchmark(group="start")
def test_start(benchmark: Any, command: str) -> None:
    def start() -> None:
        subprocess.run(COMMANDS[command], check=True, stdout=subprocess.DEVNULL)

    benchmark.pedantic(start, rounds=11, warmup_rounds=2)
