"""Wheels of the package, and the wheel rocksteady-gpu, which brings its programs for GPUs."""

import json
import subprocess
import sys
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from hatchling.builders.wheel import WheelBuilder

from rocksteady import __version__
from rocksteady.explorer import _module as module
from rocksteady.explorer import _program as program
from rocksteady.gpu._programs import BROUGHT, LEAST, file_name, sources_of
from rocksteady.kernels.devices import FORMS
from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.machine_code import sources
from rocksteady.kernels.machine_code.library import checksum_file
from rocksteady.kernels.machine_code.sources import sources_hash
from tools.wheels.platforms import PURE, Platform

ROOT = Path(__file__).parents[2]
INSIDE = "rocksteady/kernels/machine_code/libraries"
"""Folder of the libraries and of the module in a wheel."""
LARGEST = 3_600_000
"""Bytes of a wheel: a change that adds code states its own.  Python's sources are 1.9 MB, a library
for x86-64 is 0.3 MB."""
PROGRAMS = "rocksteady-gpu"
"""Name of the package of programs for GPUs."""


class _Builder(WheelBuilder):
    """Builds a wheel as hatchling builds any other, with a platform's tag and compiled files."""

    def __init__(
        self, config: dict[str, Any], platform: Platform, files: Sequence[Path], inside: str
    ) -> None:
        super().__init__(str(ROOT), config=config)
        self._platform = platform
        self._files = {str(file): f"{inside}/{file.name}" for file in files}

    def get_default_build_data(self) -> dict[str, Any]:
        """Return what hatchling lets a project say about its wheel."""
        return super().get_default_build_data() | {
            "tag": f"py3-none-{self._platform.tag}",
            "pure_python": not self._platform.targets,
            "force_include": self._files,
        }

    def made(self, out: Path, wrong: Sequence[str]) -> Path:
        """Build the wheel, unless something is wrong or it is too large."""
        if wrong:
            raise SystemExit("\n".join(wrong))
        (built,) = self.build(directory=str(out), versions=["standard"])
        wheel = Path(built)
        size = wheel.stat().st_size
        if size > LARGEST:
            raise SystemExit(f"{wheel} has {size} bytes, and {LARGEST} is the most")
        return wheel


def build(platform: Platform, libraries: Path, out: Path) -> Path:
    """Build the wheel of a platform; the same sources and libraries give the same bytes.

    Parameters
    ----------
    platform
        The platform.
    libraries
        Folder that ``python -m tools.aot build`` wrote its libraries to, and
        ``python -m tools.aot.web.program`` the scripts of the page.
    out
        Folder for the wheel.

    Returns
    -------
    Path
        The wheel.

    Raises
    ------
    SystemExit
        If a library, the module or a script is missing, if the module or a script was made from
        other sources, if systems to which the tag belongs could not load a library, or if the wheel
        is too large.
    """
    page = libraries / module.NAME
    scripts, noted = libraries / program.NAME, libraries / sources.NAME
    compiled = platform.libraries(libraries)
    wrong = list(filter(None, [module.fault(page)]))
    if program.kept_scripts(scripts) is None:
        wrong.append(f"{scripts} is missing or was made from other parts")
    there = [file for file in compiled if file.is_file()]
    found = faults(there, platform.tag, list(ENTRIES)) if there else []
    of_file = dict(zip(there, found, strict=True))
    wrong += [
        f"{file} does not fit {platform.tag}: {fault}"
        for file in compiled
        for fault in of_file.get(file, ["it is missing"])
    ]
    config = _config()
    # In a checkout `make gpu` writes the programs, so that the extra of the sources has no package.
    asked = f"{PROGRAMS} == {__version__}; sys_platform != 'darwin'"
    config["project"]["optional-dependencies"]["gpu"].append(asked)
    del config["tool"]["hatch"]["build"]["targets"]["wheel"]["hooks"]  # for this machine alone
    checked = [each for file in (*compiled, page) for each in (file, checksum_file(file))]
    return _Builder(config, platform, [*checked, scripts, noted], INSIDE).made(out, wrong)


def faults(files: Sequence[Path], tag: str, kernels: Sequence[str] = ()) -> list[list[str]]:
    """Return what `tools.wheels.needs` finds wrong with each library, as a process of its own."""
    command = [sys.executable, "-m", "tools.wheels.needs", tag, " ".join(kernels), *map(str, files)]
    try:
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    except subprocess.CalledProcessError as error:
        raise SystemExit(error.stderr) from error
    found: list[list[str]] = json.loads(done.stdout)
    return found


def programs(folder: Path) -> list[Path]:
    """Return the files of the programs for GPUs: the oldest ones, which newer GPUs run too."""
    return [folder / file_name(LEAST, form.queued.__name__) for form in FORMS.values()]


def build_programs(libraries: Path, out: Path) -> Path:
    """Build the wheel rocksteady-gpu.

    Parameters
    ----------
    libraries
        Folder that ``python -m tools.aot.device`` wrote its programs to.
    out
        Folder for the wheel.

    Raises
    ------
    SystemExit
        If a program is missing or was made from other sources, or if the wheel is too large.
    """
    files = programs(libraries)
    wrong = [
        f"{file} is missing or was made from other sources"
        for file in files
        if sources_of(file) != sources_hash()
    ]
    project = _config()["project"]
    kept = ("requires-python", "license", "license-files", "authors", "keywords", "classifiers")
    config = {
        "project": {
            "name": PROGRAMS,
            "version": __version__,
            "description": "Programs for GPUs of the package rocksteady",
            "dependencies": [f"rocksteady[gpu] == {__version__}"],
            **{name: project[name] for name in (*kept, "urls") if name in project},
        },
        "tool": {"hatch": {"build": {"targets": {"wheel": {"bypass-selection": True}}}}},
    }
    return _Builder(config, PURE, files, BROUGHT).made(out, wrong)


def _config() -> dict[str, Any]:
    return tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
