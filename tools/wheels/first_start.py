"""What somebody meets who installs the wheel of this machine: its size, its speed, its errors."""

import os
import statistics
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from packaging.tags import sys_tags
from packaging.utils import parse_wheel_filename

from rocksteady.gpu._programs import BROUGHT
from tools.wheels.building import LARGEST, ROOT

MB = 1e6
MOST_INSTALLED = 12.0
"""MB on disk of the package itself, which Python's bytecode doubles."""
LONGEST_IMPORT = 0.6
"""Processor time of ``import rocksteady`` over that of ``import numpy``, in turn."""
LONGEST_FIRST_PICTURE = 3.0
"""Processor time of a new user's first picture over that of matplotlib's, in turn."""
IMPORTS = 10
USERS = 3
"""How often either is timed: the least import and the median picture count."""
LISTED = 10
"""Packages whose sizes are shown."""
FIRST_PICTURE = (
    *("simulate", "--width-m", ".5", "--height-m", "2", "--accel-g", ".6", "--freq-hz", "2"),
    *("--plot", "a.png"),
)
PROGRAMS = (
    "from rocksteady.kernels.devices import FORMS\n"
    "from rocksteady.gpu._programs import LEAST, check_programs\n"
    "check_programs(FORMS.values(), LEAST)\n"
    "print('of all kernels')"
)
EMPTY_PICTURE = ("python", "-c", "import matplotlib.pyplot as p; p.plot([1]); p.savefig('b.png')")
TIMED = "import time; t = time.process_time(); import {}; print(time.process_time() - t)"
RUNNER = (
    "from rocksteady.kernels.machine_code.compilation import runner\n"
    "from rocksteady.kernels.machine_code.library import library\n"
    "print(runner(), library().target)"
)
COMPILERS = (
    "import importlib.util as found; "
    "print([name for name in ('numba', 'llvmlite') if found.find_spec(name)])"
)


class Row(NamedTuple):
    """One thing that was looked at."""

    what: str
    found: str
    goal: str
    good: bool


class Environment:
    """A fresh environment, and a new user in it at each start of a program.

    Parameters
    ----------
    folder
        An empty folder for it.
    """

    def __init__(self, folder: Path) -> None:
        # Without pip, which may be missing beside this Python and would count as installed.
        command = [sys.executable, "-m", "venv", "--without-pip", str(folder)]
        subprocess.run(command, check=True)
        self._programs = folder / ("Scripts" if os.name == "nt" else "bin")
        self.python = self._programs / "python"
        code = "import sysconfig; print(sysconfig.get_path('purelib'))"
        self.packages = Path(self.run("python", "-c", code).stdout.strip())

    def install(self, wheel: Path | str, *options: str) -> None:
        """Install a wheel and, unless told otherwise, what it depends on in the pinned versions."""
        pip = [sys.executable, "-m", "pip", "--python", str(self.python), "--quiet", "install"]
        pins = ["--constraint", str(ROOT / "constraints.txt"), "--only-binary", ":all:"]
        subprocess.run([*pip, *pins, *options, str(wheel)], check=True)

    def run(self, program: str, *arguments: str) -> subprocess.CompletedProcess[str]:
        """Run a program of the environment in an empty folder that is its home."""
        with tempfile.TemporaryDirectory() as home:
            return subprocess.run(
                [str(self._programs / program), *arguments],
                cwd=home,
                env=_as_new_user(home),
                capture_output=True,
                text=True,
                check=False,
            )


def _as_new_user(home: str) -> dict[str, str]:
    """Return the variables of a process whose user has no settings and no caches."""
    own = ("MPL", "NUMBA_", "PIP_", "PYTHON", "ROCKSTEADY_", "VIRTUAL_ENV", "XDG_")
    kept = {name: value for name, value in os.environ.items() if not name.startswith(own)}
    return kept | dict.fromkeys(("HOME", "USERPROFILE", "APPDATA", "LOCALAPPDATA"), home)


def wheel_of_this_machine(wheels: Sequence[Path]) -> Path:
    """Return the wheel that pip would take here.

    Raises
    ------
    SystemExit
        If there is none but the one without a library.
    """
    own = {tag: rank for rank, tag in enumerate(sys_tags())}
    ranked = [
        (min(own.get(tag, len(own)) for tag in parse_wheel_filename(wheel.name)[3]), wheel)
        for wheel in wheels
        if not is_pure(wheel)
    ]
    rank, wheel = min(ranked, default=(len(own), Path()))
    if rank == len(own):
        raise SystemExit("none of the wheels with a library can be installed here")
    return wheel


def is_pure(wheel: Path) -> bool:
    """Return whether a wheel has no library inside."""
    return wheel.stem.endswith("-any")


def check(wheels: Sequence[Path], folder: Path) -> list[Row]:
    """Install the wheel of this machine, start it as a new user does, and return what was found.

    Parameters
    ----------
    wheels
        All wheels.
    folder
        An empty folder for the environment.
    """
    own = wheel_of_this_machine(wheels)
    environment = Environment(folder)
    environment.install(own)
    rows = [_size(wheel, wheel == own) for wheel in sorted(wheels)]
    rows += _installed(environment)
    rows += [_without_compilers(environment), _runner(environment)]
    rows += [_import(environment), _first_picture(environment), _doctor(environment)]
    rows.append(_explorer(environment))
    if sys.platform != "darwin":
        rows.append(_programs(environment, own))
    pure = [wheel for wheel in wheels if is_pure(wheel) and BROUGHT not in wheel.name]
    rows += [_plain_python(environment, wheel) for wheel in pure]
    return rows


def sizes(packages: Path, *, bytecode: bool = True) -> list[tuple[str, float]]:
    """Return what each installed package weighs on disk in MB, the largest first."""
    found: Counter[str] = Counter()
    for file in packages.rglob("*"):
        if file.is_file() and (bytecode or file.suffix != ".pyc"):
            size = file.stat()
            taken = size.st_blocks * 512 if hasattr(size, "st_blocks") else size.st_size
            # Libraries that a package brings along stand beside it.
            found[file.relative_to(packages).parts[0].removesuffix(".libs")] += taken
    return [(name, size / MB) for name, size in found.most_common()]


def _size(wheel: Path, own: bool) -> Row:
    size = wheel.stat().st_size
    checked = "" if own or is_pure(wheel) else ": linked, not run here"
    return Row(
        f"{wheel.name.partition('-')[0]} for {wheel.stem.rpartition('-')[2]}{checked}",
        f"{size / MB:.2f} MB",
        f"{LARGEST / MB:.1f} MB",
        size <= LARGEST,
    )


def _installed(environment: Environment) -> list[Row]:
    found = sizes(environment.packages)
    total = sum(size for _, size in found)
    plain = sizes(environment.packages, bytecode=False)
    own = sum(size for name, size in plain if name.startswith("rocksteady"))
    most = f"{MOST_INSTALLED:.0f} MB"
    return [
        Row("installed, rocksteady without bytecode", f"{own:.1f} MB", most, own <= MOST_INSTALLED),
        Row("installed, all packages", f"{total:.0f} MB", "", True),
        *(Row(f"  of these {name}", f"{size:.0f} MB", "", True) for name, size in found[:LISTED]),
    ]


def _without_compilers(environment: Environment) -> Row:
    found = environment.run("python", "-c", COMPILERS).stdout.strip()
    return Row("compilers that can be imported", found, "[]", found == "[]")


def _runner(environment: Environment) -> Row:
    done = environment.run("python", "-c", RUNNER)
    return Row("kernels run by", _said(done), "the library", done.stdout.split()[:1] == ["library"])


def _import(environment: Environment) -> Row:
    seconds: dict[str, list[float]] = {"rocksteady": [], "numpy": []}
    for _ in range(IMPORTS):
        for name, found in seconds.items():
            done = environment.run("python", "-c", TIMED.format(name))
            found.append(float(done.stdout or "inf"))
    least, beside = map(min, seconds.values())
    return Row(
        f"import rocksteady, busy, least of {IMPORTS}",
        f"{least:.3f} s, {least / beside:.2f} of numpy's",
        f"{LONGEST_IMPORT:.2f} of it",
        least <= LONGEST_IMPORT * beside,
    )


def _first_picture(environment: Environment) -> Row:
    def busy(*command: str) -> tuple[float, subprocess.CompletedProcess[str]]:
        before = os.times()
        done = environment.run(*command)
        after = os.times()
        return sum(after[2:4]) - sum(before[2:4]), done

    ours, bare = [], []
    for _ in range(USERS):
        seconds, done = busy("rocksteady", *FIRST_PICTURE)
        ours.append(seconds)
        bare.append(busy(*EMPTY_PICTURE)[0])
        if done.returncode != 0 or "wrote a.png" not in done.stderr:
            return Row("first picture", _said(done), "a.png", False)
    median, beside = statistics.median(ours), statistics.median(bare)
    return Row(
        f"first picture of a new user, busy, median of {USERS}",
        f"{median:.2f} s, {median / beside:.2f} of matplotlib's",
        f"{LONGEST_FIRST_PICTURE:.2f} of it",
        median <= LONGEST_FIRST_PICTURE * beside,
    )


def _doctor(environment: Environment) -> Row:
    done = environment.run("rocksteady", "doctor")
    return Row("rocksteady doctor", f"exit code {done.returncode}", "0", done.returncode == 0)


def _explorer(environment: Environment) -> Row:
    done = environment.run("rocksteady", "explore", "--no-browser", "--out", "a.html")
    good = done.returncode == 0 and done.stderr == "wrote a.html\n"
    return Row("rocksteady explore", done.stderr.strip() or _said(done), "wrote a.html", good)


def _programs(environment: Environment, own: Path) -> Row:
    """Install what the extra for GPUs asks for, and look for the programs of all kernels."""
    environment.install(f"{own}[gpu]", "--find-links", str(own.parent))
    done = environment.run("python", "-c", PROGRAMS)
    what, good = "programs for GPUs, with rocksteady[gpu]", done.returncode == 0
    return Row(what, _said(done), "of all kernels", good)


def _plain_python(environment: Environment, pure: Path) -> Row:
    """Install the wheel without a library, whose kernels run as plain Python."""
    environment.install(pure, "--no-deps", "--force-reinstall")
    done = environment.run("rocksteady", *FIRST_PICTURE)
    lines = done.stderr.splitlines()
    return Row(
        "without library",
        _said(done),
        "exit code 0, one line that says how slow plain Python is",
        done.returncode == 0 and sum("plain Python" in line for line in lines) == 1,
    )


def _said(done: subprocess.CompletedProcess[str]) -> str:
    """Return what a program printed last, with its exit code where that is not 0."""
    lines = [*done.stdout.splitlines(), *done.stderr.splitlines()]
    code = f"exit code {done.returncode}: " if done.returncode else ""
    return f"{code}{lines[-1] if lines else ''}"
