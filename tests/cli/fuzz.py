"""Random command lines over the program's own tree of commands, and what must hold of each.

Commands, flags and what a flag takes are read from the program, so that new flags are drawn too.
"""

import contextlib
import io
import json
import os
import random
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import FrameType
from typing import Any

import typer

from rocksteady.cli.app import app, run
from tests.cli.motion_files import at2, samples

SECONDS = 120
"""After which a command line hangs, on a machine with much else to do."""
JUNK = (
    *("", " ", "x", "nan", "-nan", "inf", "-inf", "1e400", "-1", "0", "-0", "-0.0", "1e308"),
    *("1e-308", "5e-324", "-1e308", "1e50", "1e-50", "1e18", "1000000000000000000", "1e9"),
    *(
        "999999999",
        "2147483648",
        "9" * 50,
        "9" * 5000,
        "0x10",
        "1_000",
        "\u0661",
        "½",
        "1,2",
        "1,2,3",
    ),
    *("1;2", "True", "None", "[bold]", "[/]", "$\\frac{$", "%s", "{}", "a\nb", "\t", "\x1b[31m"),
    *("\udcff", "\u202e", "😀", "x" * 300, "--", "-", "--json", "'", '"', "\\", "~", "*"),
    *("1:2", "1:2:3:4", "2:1:3", "1:1:3", "0:1:2", "1:2:0", "1:2:1", "1:2:-3", "1:2:1e3", "::"),
    *("nan:1:3", "1:inf:3", "-1e308:1e308:3", "5e-324:1e-323:3", "log:1:2:3", "log:0:1:3"),
    *("log:-1:1:3", "log:1e-300:1e300:3", "1:2:99999999999", "1:2:1000001", "log:1:2", "1:2:"),
    *(
        "1:1.0000000000000002:3",
        "1:2:\u0663",
        "rest",
        "housner",
        "auto",
        "steady:3",
        "1,tau=",
        "w=1,2",
    ),
)
VALID = {
    "A": ("2", "0.5", "1:3:3", "2:2.2:2", "0", "1e-3", "40"),
    "W": ("4", "2", "1.9:2:3", "0.3", "60"),
    "G": ("0.4", "2", "0.1:0.5:3", "9.81"),
    "F": ("1", "2", "0.5:2:3"),
    "R": ("0.8", "0.9,0.8", "housner", "housner*0.9", "1", "0.5:0.9:3", "1e-3"),
    "M": ("0.4", "2", "0.3:0.5:2", "10"),
    "RAD": ("0.2", "0", "0.1:0.3:2", "3"),
    "P": ("2", "1:3:2"),
    "N": ("1", "3", "2", "5", "10"),
    "GAMMA": ("2", "1.5"),
    "S": ("2", "0.5"),
    "UNIT": ("g", "m/s^2", "gal"),
    "DT": ("0.01", "0.02"),
    "X": ("1", "1e-8"),
    "START": ("rest", "steady", "steady:2", "0.4,0", "0.4,tau=0.1", "auto"),
    "+|-": ("+", "-"),
    "K": ("1e-6", "0.1"),
    "U": ("1.5",),
    "ZETA": ("0.05", "0"),
    "AXIS": ("1:3:3", "0.1:0.3:2", "log:0.5:2:3", "-0.5:0.5:3"),
    "RANGE": ("1:5", "0.5:2", "0:3"),
    "PART": ("0.05", "0.01"),
    "CELLS": ("4", "100"),
    "FIGURE": ("10", "3b"),
    "FILE": (
        "a.png",
        "b.csv",
        "c.nc",
        "d.gif",
        "e.svg",
        "f.pdf",
        "p.html",
        "no/such/g.png",
        "folder",
    ),
    "STORE": ("s.zarr", "t.zarr", "folder", "there.csv"),
    "DIR": ("out", "folder", "there.csv", "no/such"),
    "--block": ("tso-wong-1989", "zhang-makris-2001"),
    "--model": ("linear", "nonlinear"),
    "--pulse": ("one-sine", "ricker", "half-sine", "mavroeidis-papageorgiou", "type-c2"),
    "--executor": ("threads", "serial"),
    "--tab": ("explore", "basins", "quake"),
    "--baseline": ("none", "mean", "pre:0.1", "linear", "polynomial:2"),
    "--filter": ("0.1:", ":25", "0.1:25"),
    "--trim": ("0.1:", ":1", "0:0.5"),
    "--format": ("peer-at2", "table"),
    "--channel": ("1", "090"),
    "--column": ("1", "2", "acc"),
    "--samples": ("10", "100"),
    "--workers": ("1", "2"),
    "--cycles": ("1", "20", "100"),
    "--max-branches": ("1", "3"),
    "--max-impacts": ("1", "2"),
    "--max-period": ("1", "2"),
    "--seeds": ("10",),
}
"""Values that some command takes, by what a flag says it takes, or by the flag."""
RECORDS = (
    "a.at2",
    "cut.at2",
    "empty.txt",
    "bytes.bin",
    "table.csv",
    "gone.at2",
    "folder",
    "[b].at2",
)
SHAKING = ["-A", "2", "-W", "4", "-r", "0.8"]
BLOCK = ["--width-m", "0.4", "--height-m", "2"]
IN_SI = ["--alpha-rad", "0.2", "--radius-m", "2", "--accel-g", "0.4", "--freq-hz", "2"]
ASYMMETRIC = ["--left-m", "0.2", "--right-m", "0.3", "--height-m", "2", "-A", "2", "-W", "4"]
NONLINEAR = ["--alpha-rad", "0.2", "--p-rad-s", "2", "-A", "2", "-W", "4", "--model", "nonlinear"]
USUAL = {
    "explore": [
        [*SHAKING, "--no-browser"],
        [*IN_SI, "--out", "p.html", "--force"],
        [*BLOCK, "--record", "a.at2", "--tab", "quake"],
    ],
    "steady": [SHAKING, IN_SI],
    "simulate": [
        SHAKING,
        ASYMMETRIC,
        NONLINEAR,
        [*BLOCK, "--record", "a.at2", "--model", "nonlinear", "--vertical", "[b].at2"],
        [*BLOCK, "--start", "0.5,0"],
        [*IN_SI, "--pulse", "ricker"],
        ["-A", "2", "-W", "1.9", "-r", "0.8", "--start", "steady", "--kick", "1e-3"],
    ],
    "attractor": [SHAKING, ASYMMETRIC, NONLINEAR],
    "orbits": [[*SHAKING, "--max-period", "1", "--max-impacts", "2", "--seeds", "10"]],
    "bifurcate": [["-A", "2", "-W", "3:3.2:3", "-r", "0.8", "--no-sweeps", "--max-branches", "2"]],
    "curves": [["-A", "1:2:2", "-W", "3:4:2", "-r", "0.8", "--max-impacts", "2"]],
    "basins": [[*SHAKING, "--angles=-1:1:4", "--velocities=-0.3:0.3:4", "--cycles", "50"]],
    "edge": [["-A", "0.2", "-W", "2", "-r", "0.9", "--cycles", "50"]],
    "map": [
        ["-A", "2:3:2", "-W", "4", "-r", "0.8"],
        ["-A", "2", "-W", "2:4:2", *BLOCK],
        [*NONLINEAR, "-A", "1:2:2"],
    ],
    "overturn": [
        ["-r", "0.9", "--pulse", "one-sine", "-W", "3:5:2", "-A", "0.5:4"],
        [*BLOCK, "--pulse", "half-sine", "--freq-hz", "1:2:2", "--accel-g", "0.1:1"],
    ],
    "record": [["a.at2"], ["a.at2", *BLOCK]],
    "spectrum": [["--record", "a.at2", "--alpha-rad", "0.2", "--periods-s", "1:2:2"]],
    "screens": [
        [*BLOCK, "--pga-g", "0.3", "--pgv-m-s", "0.4", "--friction", "0.3"],
        [*BLOCK, "--spectrum", "spectrum.txt", "--damping", "0.05"],
        [*BLOCK, "--record", "a.at2"],
    ],
    "restitution": [[*BLOCK, "--peaks", "peaks.csv"]],
    "assess": [[*BLOCK, "--pga-g", "0.3", "--pgv-m-s", "0.4"]],
    "facade": [["wall.toml"], ["wall.toml", "--records", "a.at2"]],
    "paper": [["--only", "10", "--out", "out"]],
    "study atlas": [["-A", "1:3:3", "-W", "2:6:3", "-n", "1", "--out", "out"]],
}
"""Small cases, which random flags are added to; a new command has none and needs none."""
LONG = {"paper", "study atlas", "study chaos"}
"""Commands that run for minutes where their usual flags are not there."""
VAGUE = re.compile(
    r"= '?(not given|both given|neither given|given|no axis|one size)'? is|the block = "
)
NAMED = re.compile(
    r"rocksteady: ([^:]*(?<![\w-])--?[a-zA-Z]|(record|assess|object|facade|certificate) = |"
    r"WHAT (is not given|= )|.* not given: .*; try `rocksteady |"
    r"[^:]+: line \d+|.*; see rocksteady.*--help$|"
    r".* is (too much|no command|no flag of [^:]*): rocksteady.* --help(-all)? )"
)


class Hang(BaseException):
    """A command line has run for too long; no `except Exception` hides it."""


def leaves(command: Any = None, path: str = "") -> Iterator[tuple[str, Any]]:
    """Yield every command of the program with its words."""
    command = command or typer.main.get_command(app)
    below = getattr(command, "commands", None)
    if not below:
        yield path, command
        return
    for name, one in below.items():
        yield from leaves(one, f"{path} {name}".strip())


COMMANDS = dict(leaves())


def fill(folder: Path) -> None:
    """Put files into a folder that command lines name."""
    text = at2(folder / "a.at2", samples()[:60]).read_text()
    (folder / "[b].at2").write_text(text)
    (folder / "cut.at2").write_text(text[: len(text) // 2])
    (folder / "empty.txt").touch()
    (folder / "bytes.bin").write_bytes(bytes(range(256)))
    (folder / "table.csv").write_text("t,acc\n0,1\n.1,2\n.2,1\n")
    (folder / "peaks.csv").write_text("peak_rad\n.1\n.08\n.07\n.06\n")
    (folder / "spectrum.txt").write_text("0 0.3\n0.1 0.8\n1 0.3\n4 0.02\n")
    (folder / "wall.toml").write_text(
        '[facade]\nname = "wall"\nthickness_m = 0.5\nheight_m = 4\n'
        '[demand.slv]\nag_g = 0.1\nf0 = 2.5\ntc_star_s = 0.3\nsoil = "A"\n'
    )
    (folder / "there.csv").write_text("precious")
    (folder / "folder").mkdir()


def command_line(draw: random.Random, number: int) -> list[str]:
    """Return the arguments of one random command line."""
    if draw.random() < 0.02:
        return draw.choices([*JUNK, *COMMANDS, "--help", "--version", "-h"], k=draw.randrange(4))
    path = draw.choice(list(COMMANDS))
    if path == "doctor" and draw.random() < 0.8:  # half of the time, for two flags
        path = draw.choice(list(COMMANDS))
    parameters = COMMANDS[path].params
    usual = list(draw.choice(USUAL.get(path, [[]]))) if draw.random() < 0.9 or path in LONG else []
    words = list(usual)
    for _ in range(draw.choice((0, 1, 1, 1, 2, 2, 3, 5))):
        parameter = draw.choice(parameters)
        if not getattr(parameter, "multiple", False) and draw.random() < 0.95:
            words = without(words, parameter.opts)
        words += flag_of(draw, parameter, number)
    if path in LONG:  # seconds for few of them, minutes for none
        words = [*without(words, ["--out"]), "--out", "no/such"]
        words = words if draw.random() < 0.99 else list(usual)
    if draw.random() < 0.03 and path not in LONG:
        words.insert(draw.randrange(len(words) + 1), draw.choice(("--help", "--", *JUNK)))
    if words and path not in LONG and draw.random() < 0.05:
        del words[draw.randrange(len(words))]
    if draw.random() < 0.3:
        words.append("--json")
    return [*path.split(), *words]


def without(words: list[str], names: list[str]) -> list[str]:
    """Return arguments without those of a flag; for a flag with a value both."""
    kept: list[str] = []
    skip = False
    for word in words:
        if skip:
            skip = False
        elif word in names:
            skip = word.startswith("-")
        elif word.partition("=")[0] not in names or "=" not in word:
            kept.append(word)
    return kept


def flag_of(draw: random.Random, parameter: Any, number: int) -> list[str]:
    """Return a parameter of a command with a value, valid for some command or junk."""
    name = draw.choice(parameter.opts)
    if getattr(parameter, "is_flag", False):
        return [name]
    record = name in ("--record", "--vertical", "files")
    valid = RECORDS if record else VALID.get(name) or VALID.get(parameter.metavar, ("1",))
    value = draw.choice(JUNK) if draw.random() < 0.6 else draw.choice(valid)
    if value in VALID["FILE"] and draw.random() < 0.8:
        value = f"{number}{value}"
    if parameter.param_type_name == "argument":
        return [value]
    if draw.random() < 0.02:
        return [name]
    return [f"{name}={value}"] if name.startswith("--") and draw.random() < 0.5 else [name, value]


def run_here(arguments: list[str]) -> tuple[int, str, str]:
    """Run a command line in this process; one that hangs raises `Hang`."""

    def hangs(_: int, __: FrameType | None) -> None:
        raise Hang(arguments)

    out, err = io.StringIO(), io.StringIO()
    before = signal.signal(signal.SIGALRM, hangs)
    signal.alarm(SECONDS)
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = run(arguments)
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)
    return code, out.getvalue(), err.getvalue()


ENVIRONMENTS: tuple[dict[str, str], ...] = (
    {},
    {"COLUMNS": "0"},
    {"COLUMNS": "garbage", "LINES": "²", "TERM": "dumb"},
    {"PYTHONIOENCODING": "cp1252", "NO_COLOR": "1"},
    {"PYTHONIOENCODING": "ascii", "MPLBACKEND": "garbage"},
    {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
    {"TERMINAL_WIDTH": "x", "COLUMNS": "1"},
)


def run_apart(draw: random.Random, arguments: list[str], folder: Path) -> tuple[int, str, str]:
    """Run a command line as a process, in a random environment."""
    done = subprocess.run(
        [sys.executable, "-m", "rocksteady", *arguments],
        capture_output=True,
        cwd=folder,
        env={**os.environ, **draw.choice(ENVIRONMENTS)},
        stdin=subprocess.DEVNULL,
        timeout=10 * SECONDS,
        check=False,
    )
    out, err = (stream.decode("utf-8", "replace") for stream in (done.stdout, done.stderr))
    return done.returncode, out, err


def fault(arguments: list[str], code: int, out: str, err: str) -> str | None:
    """Return what is wrong with how a command line ended; None where nothing is."""
    if code not in (0, 2, 3) and not (code == 1 and "--check" in arguments):
        return f"exit code {code}"
    if "Traceback" in err:
        return "a traceback"
    if code == 2:
        return _fault_of_refusal(arguments, out, err)
    if "--json" in arguments and not {"--help", "-h", "--version"} & set(arguments):
        return _fault_of_json(out)
    return None


def _fault_of_refusal(arguments: list[str], out: str, err: str) -> str | None:
    """Return what is wrong with a refusal."""
    lines = err.removesuffix("\n").split("\n")
    every = arguments[:1] == ["record"]  # each file that cannot be read has its line
    faults = {
        "a refusal of several lines": len(lines) != 1
        and not (every and all(": record = " in line for line in lines)),
        "a refusal with output": out and arguments,
        "a refusal that does not say what was given": VAGUE.search(err),
        "a refusal that names no flag": arguments and not NAMED.match(lines[0]),
        "a line that is no line": not lines[0].isprintable(),
    }
    return next((name for name, there in faults.items() if there), None)


def _fault_of_json(out: str) -> str | None:
    """Return what is wrong with what --json has printed."""
    try:
        values = json.loads(out, parse_constant=_no_number)
    except ValueError as error:
        return f"not one object with --json: {error}"
    if out.count("\n") != 1 or not str(values.get("schema")).startswith("rocksteady/"):
        return "an object without its schema, or not in one line"
    return None


def _no_number(constant: str) -> None:
    message = f"{constant} is no JSON"
    raise ValueError(message)
