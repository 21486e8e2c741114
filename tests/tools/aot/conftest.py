"""What the tests of targets share: a folder with the library of this machine and the modules."""

import shutil
from pathlib import Path

import pytest
from filelock import FileLock

from rocksteady.kernels.machine_code.library import library
from rocksteady.kernels.machine_code.sources import sources_hash
from tools.aot.build import LOWERED, build, tools_hash
from tools.aot.link import compilers
from tools.aot.targets import PAGE, TARGETS, WASM


@pytest.fixture(scope="session")
def built() -> Path:
    """The folder of what is built on this machine, the WebAssembly modules included."""
    found = library()
    if found is None:
        pytest.skip("no library of kernels is built here: `make library` builds it")
    if not compilers(TARGETS[WASM]):
        pytest.skip("the package ziglang, which links the modules, is not installed")
    folder = LOWERED / f"{sources_hash()}-{tools_hash()}"
    folder.mkdir(parents=True, exist_ok=True)
    with FileLock(folder / "module.lock"):
        shutil.copyfile(found.path, folder / found.path.name)
        page = found.path.with_name(TARGETS[PAGE].file)
        if page.is_file():
            shutil.copyfile(page, folder / page.name)
        missing = [name for name in (WASM, PAGE) if not (folder / TARGETS[name].file).is_file()]
        build(missing, folder)
    return folder
