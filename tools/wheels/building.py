"""Wheels of the package: libraries of the platform, programs of GPUs, the explorer's module."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from hatchling.builders.wheel import WheelBuilder

from rocksteady.explorer import _program as program
from rocksteady.explorer import module
from rocksteady.kernels.machine_code.programs import sources_of
from rocksteady.kernels.machine_code.sources import sources_hash
from tools.wheels.needs import faults
from tools.wheels.platforms import Platform

ROOT = Path(__file__).parents[2]
INSIDE = "rocksteady/kernels/machine_code/libraries"
"""Folder of the libraries and of the module in a wheel."""
LARGEST = 5_000_000
"""Bytes of a wheel, of which libraries take some 0.9 MB and programs for GPUs 1.1 MB."""


class _Builder(WheelBuilder):
    """Builds a wheel as hatchling builds any other, with a platform's tag and compiled files."""

    def __init__(self, platform: Platform, files: Sequence[Path]) -> None:
        super().__init__(str(ROOT))
        self._platform = platform
        self._files = files

    def get_default_build_data(self) -> dict[str, Any]:
        """Return what hatchling lets a project say about its wheel."""
        return super().get_default_build_data() | {
            "tag": f"py3-none-{self._platform.tag}",
            "pure_python": not self._platform.targets,
            "force_include": {str(file): f"{INSIDE}/{file.name}" for file in self._files},
        }


def build(platform: Platform, libraries: Path, out: Path) -> Path:
    """Build the wheel of a platform; the same sources and libraries give the same bytes.

    Parameters
    ----------
    platform
        The platform.
    libraries
        Folder that ``python -m tools.aot build`` wrote its libraries to, and
        ``python -m tools.aot.device`` its programs.
    out
        Folder for the wheel.

    Returns
    -------
    Path
        The wheel.

    Raises
    ------
    SystemExit
        If a library, a program or the module is missing, if a program or the module was made from
        other sources, if systems to which the tag belongs could not load a library, or if the wheel
        is too large.
    """
    page, script = libraries / module.NAME, libraries / program.NAME
    compiled, programs = platform.libraries(libraries), platform.programs(libraries)
    files = [*compiled, page, script, *programs]
    wrong = list(filter(None, [module.fault(page)]))
    wrong += [f"{file} is missing" for file in (script, *programs) if not file.is_file()]
    wrong += [
        f"{file} was made from other sources"
        for file in programs
        if file.is_file() and sources_of(file) != sources_hash()
    ]
    for file in compiled:
        found = faults(file, platform.tag) if file.is_file() else ["it is missing"]
        wrong += [f"{file} does not fit {platform.tag}: {fault}" for fault in found]
    if wrong:
        raise SystemExit("\n".join(wrong))
    (built,) = _Builder(platform, files).build(directory=str(out), versions=["standard"])
    wheel = Path(built)
    size = wheel.stat().st_size
    if size > LARGEST:
        raise SystemExit(f"{wheel} has {size} bytes, and {LARGEST} is the most")
    return wheel
