"""What the tests of targets share: a folder with the library of this machine and the modules."""

from pathlib import Path

import pytest

from tools.aot.replay.everywhere import built_here
from tools.aot.replay.outcome import MissingProgramError


@pytest.fixture(scope="session")
def built() -> Path:
    """The folder of what is built on this machine, the WebAssembly modules included."""
    try:
        return built_here()
    except MissingProgramError as error:
        pytest.skip(str(error))
