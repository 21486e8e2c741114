"""What the tests of targets share: a folder with the library of this machine and the module."""

from pathlib import Path

import pytest
from filelock import FileLock

from rocksteady.kernels.machine_code.library import built_folder, library
from tools.aot.build import build
from tools.aot.link import compilers
from tools.aot.targets import TARGETS, WASM


@pytest.fixture(scope="session")
def built() -> Path:
    """The folder of what is built on this machine, the WebAssembly module included."""
    found = library()
    if found is None:
        pytest.skip("no library of kernels is built here: `make library` builds it")
    if not compilers(TARGETS[WASM]):
        pytest.skip("the package ziglang, which links the module, is not installed")
    folder = built_folder()
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    with FileLock(folder / "module.lock"):
        if not (folder / TARGETS[WASM].file).is_file():
            build([WASM], folder)
    return folder
