"""Runs the page's physics in node, with the kernels of its module."""

import json
import subprocess
from pathlib import Path
from typing import Any, Protocol

PARTS = Path(__file__).parents[2] / "src" / "rocksteady" / "explorer" / "parts"
SERVER = Path(__file__).with_name("server.mjs")
SCRIPT = """
import {{ parentPort, workerData }} from 'node:worker_threads';
const parts = (name) => new URL(name, {parts});
const {{ load }} = await import(parts('kernels/loader.mjs'));
const kernels = await load(workerData.module);
const asked = workerData.asked;
const answer = (found) => parentPort.postMessage(JSON.stringify(found));
{lines}
"""


class InNode(Protocol):
    """Runs lines of a script that has `kernels`, `parts`, `asked` and `answer`."""

    def __call__(self, lines: str, asked: object = None) -> Any:
        """Return the answer."""


class Server:
    """A process of node that runs one script after the other.

    Parameters
    ----------
    program
        The command of node.
    module
        File of the kernels, which it compiles once.
    """

    def __init__(self, program: list[str], module: Path) -> None:
        self._process = subprocess.Popen(
            [*program, str(SERVER), str(module)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            encoding="utf-8",
        )

    def run(self, script: Path, lines: str, asked: object) -> Any:
        """Run some lines, written into a file, and return their answer."""
        text = SCRIPT.format(lines=lines, parts=json.dumps(PARTS.as_uri() + "/"))
        script.write_text(text, encoding="utf-8")
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        print(
            json.dumps({"script": script.as_uri(), "asked": asked}),
            file=self._process.stdin,
            flush=True,
        )
        ran = json.loads(self._process.stdout.readline())
        assert (ran["code"], ran["error"]) == (0, "")
        (answer,) = ran["answers"]
        return json.loads(answer)

    def end(self) -> None:
        """End the process."""
        self._process.communicate()
