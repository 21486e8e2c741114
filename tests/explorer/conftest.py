"""What the tests of the page share."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from rocksteady.errors import MissingKernelsError
from rocksteady.explorer._module import page_module
from tests.explorer.in_node import InNode, Server
from tests.strategies import PLAIN
from tools.aot.replay.outcome import MissingProgramError
from tools.aot.replay.wasm import node


@pytest.fixture(scope="session")
def node_server() -> Iterator[Server]:
    if PLAIN:
        pytest.skip("no library is loaded")
    try:
        server = Server(node(), page_module())
    except (MissingKernelsError, MissingProgramError) as error:
        pytest.skip(str(error))
    yield server
    server.end()


@pytest.fixture
def in_node(node_server: Server, tmp_path: Path) -> InNode:
    def run(lines: str, asked: object = None) -> Any:
        return node_server.run(tmp_path / "script.mjs", lines, asked)

    return run
