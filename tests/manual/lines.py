"""Command lines of pages and of help texts, and the files that their reader has."""

import re
import shlex
import shutil
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
from sybil import Document
from sybil.parsers.markdown.lexers import FencedCodeBlockLexer

import rocksteady as rs
from tests.show.calibrated import without_pictures
from tools.manual import commands

ROOT = Path(__file__).parents[2]
PAGES = {
    str(page.relative_to(ROOT)): page.read_text(encoding="utf-8")
    for page in (
        ROOT / "README.md",
        ROOT / "CONTRIBUTING.md",
        *sorted((ROOT / "docs").rglob("*.md")),
    )
    if page.parent != ROOT / "docs" / "reference" / "commands"
}
HELP = {f"help of {name}": text for name, text in commands.pages().items()}
"""Pages of commands, which the build of the manual makes of the help texts."""
FENCED = FencedCodeBlockLexer(r"[^\n]*")
SHOWN = re.compile(
    r"^:::\{code-block\} \w+\n:caption: (\S+)\n\n(.*?)^:::$", re.DOTALL | re.MULTILINE
)


def blocks(text: str) -> Iterator[tuple[str, str]]:
    """Yield kind and content of the blocks of a page, those inside of directives included."""
    for region in FENCED(Document(text, "")):
        yield region.lexemes["language"].strip(), str(region.lexemes["source"])


# -------------------------------------------------------------------------------------- lines

INLINE = re.compile(r"`(rocksteady\s[^`]+)`")
NAMED = re.compile(r"((study )?\w+)?( --[\w-]+( FILE)?)*|.* FILE\b.*")
"""A command that a sentence names, perhaps with flags: no line to be typed as it stands."""
PROGRAM = re.compile(r"(?:\.venv/bin/)?rocksteady ")


def shell_lines(text: str) -> list[str]:
    """Return the lines of a page that are typed into a shell, without their comments."""
    kinds = {"sh", "bash"}
    typed = [body.replace("\\\n", " ") for kind, body in blocks(text) if kind in kinds]
    lines = [re.sub(r"\s+#.*|^#.*", "", line) for body in typed for line in body.splitlines()]
    return [" ".join(line.split()) for line in lines if line.strip()]


def command_lines(text: str) -> list[str]:
    """Return the command lines of a page, those in sentences last, without the program."""
    lines = [*shell_lines(text), *(" ".join(line.split()) for line in INLINE.findall(text))]
    return list(dict.fromkeys(PROGRAM.sub("", line) for line in lines if PROGRAM.match(line)))


def typed_lines(text: str) -> list[str]:
    """Return the command lines of a page that can be typed as they stand."""
    lines = command_lines(text)
    return [line for line in lines if not NAMED.fullmatch(line) or line.endswith("--help")]


EVERY = sorted({line for text in PAGES.values() for line in command_lines(text)})
TYPED = sorted({line for text in PAGES.values() for line in typed_lines(text)})
LONG = re.compile(r"--executor|--animate|^paper|^study|^assess --example")
"""Lines that take long with a few values on their axes, too."""
ELSEWHERE = re.compile(r"--executor (?:gpu|tcp:)")
"""Lines whose answer another machine computes."""
AXIS = re.compile(r"((?:log:)?-?[0-9.]+:-?[0-9.]+:)(\d+)")
FEW = 6


def shortened(line: str) -> str:
    """Return a command line with a few values on each of its axes, and few draws."""
    if line.startswith("fragility"):
        few = {"--levels": "0.4,0.8,1.6", "--restitution": "0.9"}
        line += "".join(f" {flag} {value}" for flag, value in few.items() if flag not in line)
    if line.startswith("calibrate"):
        line = re.sub(r" --most-runs \d+", "", line) + " --most-runs 100 --model linear"
    if line.startswith("back-analyse --survey"):
        line = re.sub(r" --draws \d+", "", line) + " --draws 2 --levels 8 --trials 8"
    return AXIS.sub(lambda axis: axis[1] + str(min(FEW, int(axis[2]))), line)


# ----------------------------------------------------------------------- files of the reader


def _channel(station: str, direction: str, factor: float, omega: float = 6.0) -> str:
    """Return a channel in PEER's format, of an angular frequency [rad/s]."""
    time = 0.01 * np.arange(400)
    swelling = 0.6 * factor * np.sin(omega * time) * np.exp(-((time - 2.0) ** 2))  # g
    rows = [" ".join(f"{value: .7E}" for value in row) for row in swelling.reshape(-1, 5)]
    return (
        f"PEER NGA STRONG MOTION DATABASE RECORD\nSomewhere-01, 1/17/1994, {station}, {direction}\n"
        f"ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {len(time):6d}, DT=   .0100 SEC,\n"
        + "\n".join(rows)
        + "\n"
    )


_TESTS = "test,record,object,outcome,gain,session\n" + "".join(
    f"{number},{record},column,{outcome},1,{(number + 1) // 2}\n"
    for number, (record, outcome) in enumerate(
        ((1, "fell"), (2, "stood"), (3, "stood"), (1, "fell")), 1
    )
)
YOURS = {
    **{f"suite/{k}.AT2": _channel("Hut", "90", 1.0 / k, 4.0 + 0.3 * k) for k in range(1, 13)},
    **{
        f"stations/HUT{k}{name}.AT2": _channel(f"Hut {k}", direction, factor / k)
        for k in range(1, 5)
        for direction, name, factor in (("90", "090", 1.0), ("UP", "-UP", 0.2))
    },
    "one.json": '{"format": "rocking-certificate/1", "kind": "orbit", "bits": 64, "model": '
    '{"amplitude": ["2"], "frequency_ratio": ["2"], "restitution": ["0.8"]}, "half_periods": [1], '
    '"phases": ["2.87838818025741"], "radii": ["1e-12"], "claim": {"stability": "stable"}}',
    "HUT090.AT2": _channel("Hut", "90", 1.0),
    "HUT-UP.AT2": _channel("Hut", "UP", 0.2),
    "column.txt": "\n".join(map(str, (0.1, -0.25, 0.4, -0.3, 0.15, -0.05))),
    "peaks.csv": "peak_rad\n0.06\n0.05\n0.043\n0.038\n",
    "objects.csv": "name,width_m,height_m\ncolumn,0.4,1.6\n",
    "tests.csv": _TESTS,
    "next.csv": _TESTS,
    "prior.toml": "[noise]\nsigma_ln = 0.2\n",
    "cemetery.csv": "name,outcome,width_m,height_m\na,fell,0.12,0.9\nb,stood,0.5,0.9\n",
    "floor.txt": "# damping 0.05\n0 0.35\n0.4 0.8\n4 0.04\n",
    "site.csv": "PGV [m/s],rate [1/year]\n0.05,0.1\n5,0.00001\n",
    "statue.toml": 'name = "statue"\n[geometry]\nwidth_m = 0.435\nheight_m = 1.8\noffset_m = 0.05\n'
    "[demand]\npga_g = 0.35\npgv_m_s = 0.3\n",
    "wall.toml": '[facade]\nname = "wall"\nthickness_m = 0.5\nheight_m = 3.0\n'
    'confidence_factor = 1.2\n[demand.slv]\nag_g = 0.1\nf0 = 2.5\ntc_star_s = 0.3\nsoil = "B"\n',
}
"""What pages and help texts leave to their reader, as these tests have it."""
NAMES = {"fit", *(name.partition("/")[0] for name in YOURS)}


def shown(text: str) -> dict[str, str]:
    """Return the files that a page shows in full, by their names."""
    return dict(SHOWN.findall(text))


def of_reader(text: str) -> set[str]:
    """Return the names of the reader's files and folders that the command lines of a page have."""
    words = {word.rstrip("/") for line in command_lines(text) for word in line.split()}
    words |= {"objects.csv"} if words & {"tests.csv", "next.csv"} else set()  # beside these
    return words & NAMES


def write_files(folder: Path, names: set[str], files: dict[str, str]) -> None:
    """Write files of the reader, then those that a page shows."""
    own = {name: text for name, text in YOURS.items() if name.partition("/")[0] in names}
    for name, text in (own | files).items():
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, "utf-8")
    if "fit" in names:
        shutil.copytree(fit(), folder / "fit")


@cache
def fit() -> Path:
    """Return the folder of a calibration."""
    folder = Path(mkdtemp(prefix="calibrated-")) / "fit"
    column = rs.Block.rectangle(width=0.15, height=0.6)
    made = rs.calibration.make_synthetic_tests(
        column, rs.motions.make_synthetic_suite(2), model=rs.Linear()
    )
    given = {"column": replace(next(iter(made.objects.values())), name="column")}
    tests = [replace(test, object="column") for test in made.tests]
    found = rs.calibrate(
        replace(made, tests=tests, objects=given),
        most_runs=100,
        model=rs.Linear(),
    )
    with without_pictures():
        rs.export.write_calibration(found, folder)
    return folder


def words_module(line: str) -> list[str]:
    """Return the words of a command line as a shell passes them on, in the present folder."""
    return [
        found
        for word in shlex.split(line)
        for found in (("*" in word and sorted(map(str, Path().glob(word)))) or [word])
    ]
