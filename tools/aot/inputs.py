"""What libraries are built from: a hash that a build can compare before numba is installed.

Standard library alone: the build hook of the package imports it.
"""

import hashlib
import platform
import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

ROOT = Path(__file__).parents[2]
LIBRARIES = ROOT / "src/rocksteady/kernels/machine_code/libraries"
MADE = LIBRARIES / "made.txt"
"""File that says of which inputs the files beside it were built."""
PARTS = ROOT / "src/rocksteady/explorer/parts"


def tool_files(folder: Path = Path(__file__).parent) -> list[Path]:
    """Return the programs in a folder of tools: modules of Python and of C."""
    return sorted(path for path in folder.glob("*.[pc]*") if path.is_file())


def inputs_hash() -> str:
    """Return a hash of all bytes that the files for this machine are built from."""
    files = [
        *sorted((ROOT / "src/rocksteady/kernels").rglob("*.py")),
        ROOT / "src/rocksteady/outcomes.py",
        *sorted(PARTS.rglob("*.mjs")),
        *tool_files(),
        *tool_files(Path(__file__).parent / "web"),
    ]
    digest = hashlib.sha256(f"{sys.platform} {platform.machine()} {_level()}".encode())
    for file in files:
        digest.update(f"\0{file.relative_to(ROOT).as_posix()}\0".encode())
        digest.update(file.read_bytes())
    return digest.hexdigest()


def _level() -> int:
    """Return the level of this processor, without importing the package."""
    file = ROOT / "src/rocksteady/kernels/machine_code/_cpu.py"
    spec = spec_from_file_location("_cpu", file)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    level: int = module.x86_64_level()
    return level


def is_made() -> bool:
    """Return whether all that a build makes here was made from these inputs."""
    return MADE.is_file() and MADE.read_text("ascii") == inputs_hash()
