"""What the tests of devices share: the emulated one."""

import pytest
from filelock import FileLock

from rocksteady.kernels.machine_code.library import targets
from tests.strategies import PLAIN
from tools.aot.build import LOWERED
from tools.aot.device.build import emulation
from tools.aot.device.emulate import Emulated
from tools.aot.link import compilers
from tools.aot.targets import TARGETS


@pytest.fixture(scope="session")
def emulated() -> Emulated:
    """A device of four threads."""
    if PLAIN:
        pytest.skip("no kernel is compiled")
    if not targets() or not compilers(TARGETS[targets()[0]]):
        pytest.skip("no C compiler is in reach: gcc, clang or the package ziglang")
    LOWERED.mkdir(parents=True, exist_ok=True)
    with FileLock(LOWERED / "device.lock"):
        file = emulation()
    return Emulated(file, workers=4)
