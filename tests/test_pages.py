"""The pages of the documentation: each block of Python runs alone and prints what the page shows
below it; each command line runs; what pages name is there.
"""

import ast
import itertools
import math
import re
import shlex
import subprocess
import sys
import textwrap
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import rocksteady as rs
from tests.cli.program import rocksteady
from tests.every import every
from tests.show.calibrated import without_pictures
from tools.manual import images
from tools.manual.twins import dark_twin
from tools.namespace import MODULES, PLACES

ROOT = Path(__file__).parents[1]
PAGES = {
    str(page.relative_to(ROOT)): page.read_text(encoding="utf-8")
    for page in (
        ROOT / "README.md",
        ROOT / "CONTRIBUTING.md",
        *sorted((ROOT / "docs").rglob("*.md")),
    )
    # The build of the manual writes these from the help texts, whose examples tests/cli runs.
    if page.parent != ROOT / "docs" / "reference" / "commands"
}
FENCED = re.compile(
    r"^(?P<indent> *)(?P<fence>[`:]{3,})(?P<kind>[^`\n]*)\n(?P<body>.*?)^(?P=indent)(?P=fence) *$",
    re.DOTALL | re.MULTILINE,
)
PRINTED = re.compile(r"\n\nIt prints\n\n```text\n(.*?)^```$", re.DOTALL | re.MULTILINE)


@dataclass(frozen=True)
class Block:
    """A block of a page between two fences."""

    kind: str
    body: str
    line: int
    printed: str | None


def blocks(text: str, first: int = 1) -> Iterator[Block]:
    """Yield the blocks of a page, those inside of directives included."""
    for fenced in FENCED.finditer(text):
        line = first + text.count("\n", 0, fenced.start())
        body = textwrap.dedent(fenced["body"])
        printed = PRINTED.match(text, fenced.end())
        yield Block(fenced["kind"].strip(), body, line, printed and printed[1])
        if fenced["kind"].startswith("{"):
            yield from blocks(body, line + 1)


SNIPPETS = {
    f"{name}:{block.line}": block
    for name, text in PAGES.items()
    for block in blocks(text)
    if block.kind == "python"
}
"""The Python of the pages by page and line, each with what the page shows that it prints."""


@pytest.mark.slow
@pytest.mark.parametrize("block", list(SNIPPETS.values()), ids=list(SNIPPETS))
def test_each_block_of_python_runs_alone(block: Block, tmp_path: Path) -> None:
    out = run_alone(block.body, tmp_path)
    if block.printed is not None:
        assert out == block.printed


def run_alone(code: str, folder: Path) -> str:
    """Run a block of Python in a process and a folder of its own, and return what it prints."""
    script = folder / "page.py"
    script.write_text(code, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-W", "error", script.name],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    return done.stdout


def test_what_is_printed_stands_below_the_block_that_prints_it() -> None:
    held = sum(block.printed is not None for block in SNIPPETS.values())
    assert held == sum(text.count("\nIt prints\n") for text in PAGES.values()) >= 7


# -------------------------------------------------------------------------- kinds of blocks

RUN_HERE = {"python", "sh", "toml"}
SHOWN = {"text", "bibtex", "json"}
"""What programs print, and what is given to other programs."""
DIRECTIVE = re.compile(r"\{([\w:-]+)\}")
OTHERS = (
    r"make( [a-z-]+)?",  # tested below to be a target
    r"python3 -m pip install (-e )?\S+",
    r"python3 -m venv \S+",
    r"git clone .+|cd \w+",
    r"dask (scheduler|worker) .+",
)
"""Lines of a shell that install or start something, which no test does."""


def test_each_block_is_of_a_kind_that_some_check_runs() -> None:
    """Cells, directives included, are run by the build of the manual."""
    for name, text in PAGES.items():
        for block in blocks(text):
            known = RUN_HERE | SHOWN
            assert block.kind in known or DIRECTIVE.match(block.kind), (name, block)


def test_each_line_of_a_shell_is_a_command_of_the_package_or_one_that_sets_it_up() -> None:
    for name, text in PAGES.items():
        for line in shell_lines(text):
            known = ("rocksteady .+", *OTHERS)
            assert any(re.fullmatch(kind, line) for kind in known), (name, line)


def test_each_block_of_toml_is_toml() -> None:
    for text in PAGES.values():
        for block in blocks(text):
            if block.kind == "toml":
                assert tomllib.loads(block.body)


# --------------------------------------------------------------------------- command lines

INLINE = re.compile(r"`(rocksteady\s[^`]+)`")
NAMED = re.compile(r"((study )?\w+)?( --[\w-]+( FILE)?)*")
"""A command that a sentence names, perhaps with flags: no line to be typed as it stands."""
AXIS = re.compile(r"((?:log:)?-?[0-9.]+:-?[0-9.]+:)(\d+)")
FEW = 6
LONG = re.compile(r"--executor|--animate|^paper|^study|^assess --example")
"""Lines that take long with a few values on their axes, too."""
ELSEWHERE = re.compile(r"--executor (?:gpu|tcp:)")
"""Lines whose answer another machine computes."""


def shell_lines(text: str) -> list[str]:
    """Return the lines of a page that are typed into a shell, without their comments."""
    typed = [block.body.replace("\\\n", " ") for block in blocks(text) if block.kind == "sh"]
    lines = [re.sub(r"\s+#.*|^#.*", "", line) for body in typed for line in body.splitlines()]
    return [" ".join(line.split()) for line in lines if line.strip()]


def command_lines(text: str) -> list[str]:
    """Return the command lines of a page, those in sentences included, without the program."""
    lines = [line for line in shell_lines(text) if line.startswith("rocksteady ")]
    lines += [" ".join(line.split()) for line in INLINE.findall(text)]
    return [line.removeprefix("rocksteady ") for line in lines]


EVERY = sorted({line for text in PAGES.values() for line in command_lines(text)})
TYPED = [line for line in EVERY if not NAMED.fullmatch(line) or line.endswith("--help")]


def cells(line: str) -> int:
    """Return the number of cells that the axes of a command line have together."""
    return math.prod(int(count) for _, count in AXIS.findall(line))


def shortened(line: str) -> str:
    """Return a command line with a few values on each of its axes, and few draws."""
    if line.startswith("fragility"):
        few = {"--levels": "0.4,0.8,1.6", "--restitution": "0.9", "--replicates": "100"}
        line += "".join(f" {flag} {value}" for flag, value in few.items() if flag not in line)
    if line.startswith("calibrate"):
        line = re.sub(r" --draws \d+", "", line) + " --draws 30 --gains 2 --rounds 1 --model linear"
    if line.startswith("back-analyse --survey"):
        line = re.sub(r" --draws \d+", "", line) + " --draws 2 --levels 8 --trials 8"
    if "--kick" in line:  # without one the block falls after 3.3 s on the record of the folder
        line = re.sub(r"--at-s 0:\d+", "--at-s 0:3", line)
    return AXIS.sub(lambda axis: axis[1] + str(min(FEW, int(axis[2]))), line)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Go to an empty folder with the files that the pages assume."""
    monkeypatch.chdir(tmp_path)
    write_files(tmp_path)
    return tmp_path


def write_files(folder: Path) -> None:
    """Write the files that the pages and the examples of the commands assume."""
    time = 0.01 * np.arange(400)
    swelling = 0.6 * np.sin(6.0 * time) * np.exp(-((time - 2.0) ** 2))  # g
    rows = [" ".join(f"{value: .7E}" for value in row) for row in swelling.reshape(-1, 5)]
    header = (
        "PEER NGA STRONG MOTION DATABASE RECORD\nSomewhere-01, 1/17/1994, Hut, 90\n"
        f"ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {len(time):6d}, DT=   .0100 SEC,\n"
    )
    names = ("one.AT2", "two.AT2", "three.AT2", "quake.at2", "east.at2", "north.at2", "FILE")
    for name in ("RSN77_PUL164.AT2", *names):
        (folder / name).write_text(header + "\n".join(rows) + "\n", encoding="ascii")
    suite = folder / "suite"
    suite.mkdir()
    for number in range(1, 8):
        scaled = [" ".join(f"{float(x) / number: .7E}" for x in row.split()) for row in rows]
        text = header + "\n".join(scaled) + "\n"
        for place in (suite, folder):
            (place / f"{number}.AT2").write_text(text, encoding="ascii")
    motions = folder / "motions"
    motions.mkdir()
    for number in range(1, 5):
        for channel, name in (("90", "090"), ("UP", "-UP")):
            share = (1.0 if channel == "90" else 0.2) / number
            scaled = [" ".join(f"{float(x) * share: .7E}" for x in row.split()) for row in rows]
            text = header.replace("Hut, 90", f"Hut {number}, {channel}") + "\n".join(scaled) + "\n"
            (motions / f"RSN{number}_HUT{name}.AT2").write_text(text, encoding="ascii")
    (folder / "orbit.json").write_text(
        '{"format": "rocking-certificate/1", "kind": "orbit", "bits": 64, "model": '
        '{"amplitude": ["2"], "frequency_ratio": ["2"], "restitution": ["0.8"]}, '
        '"half_periods": [1], "phases": ["2.87838818025741"], "radii": ["1e-12"], '
        '"claim": {"stability": "stable"}}',
        "utf-8",
    )
    (folder / "statue.toml").write_text(
        'name = "statue"\n[geometry]\nwidth_m = 0.435\nheight_m = 1.8\noffset_m = 0.05\n'
        "[demand]\npga_g = 0.35\npgv_m_s = 0.3\n",
        "utf-8",
    )
    np.savetxt(folder / "column.txt", 9.80665 * swelling)
    (folder / "peaks.csv").write_text("peak_rad\n0.06\n0.05\n0.043\n0.038\n", encoding="ascii")
    for name in ("objects.csv", "blocks.csv"):
        (folder / name).write_text("name,width_m,height_m\ncolumn,0.4,1.6\n", "utf-8")
    (folder / "museum.toml").write_text(
        '[[buildings]]\nname = "museum"\nstoreys = 3\nperiod_s = 0.35\n', "utf-8"
    )
    (folder / "museum.csv").write_text(
        "name,width_m,height_m,floor\nvase,0.16,0.5,3\nstele,0.3,1.6,0\n", "utf-8"
    )
    (folder / "floor.txt").write_text("# damping 0.05\n0 0.35\n0.4 0.8\n4 0.04\n", "utf-8")
    (folder / "site.csv").write_text("PGV [m/s],rate [1/year]\n0.05,0.1\n5,0.00001\n", "utf-8")
    rows = ["test,record,object,outcome,gain,session"]
    outcomes = ((1, "fell"), (2, "stood"), (3, "stood"), (1, "fell"))
    for number, (record, outcome) in enumerate(outcomes, 1):
        rows += [f"{number},{record},column,{outcome},1,{(number + 1) // 2}"]
    (folder / "cemetery.csv").write_text(
        "name,outcome,width_m,height_m\na,fell,0.12,0.9\nb,stood,0.5,0.9\n", "utf-8"
    )
    facade = '[facade]\nname = "wall"\nthickness_m = {}\nheight_m = 3.0\nconfidence_factor = {}\n'
    spectrum = '[demand.slv]\nag_g = 0.1\nf0 = 2.5\ntc_star_s = 0.3\nsoil = "B"\n'
    for name, text in (
        ("wall", facade.format(0.5, 1.2) + spectrum),
        ("worked-1", facade.format(0.3, 1.0)),
        ("worked-2", facade.format(0.3, 1.35)),
    ):
        (folder / f"{name}.toml").write_text(text, "utf-8")
    (folder / "prior.toml").write_text("[noise]\nsigma_ln = 0.2\n", "utf-8")
    for name in ("tests.csv", "next.csv"):
        (folder / name).write_text("\n".join(rows) + "\n", "utf-8")


@pytest.fixture(scope="session", name="fit")
def _fit(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a calibration."""
    folder = tmp_path_factory.mktemp("calibrated") / "fit"
    write_fit(folder)
    return folder


def write_fit(folder: Path) -> None:
    """Write the folder of a calibration."""
    column = rs.Block.rectangle(width=0.15, height=0.6)
    made = rs.calibration.make_synthetic_tests(
        column, rs.motions.make_synthetic_suite(2), model=rs.Linear()
    )
    given = {"column": replace(next(iter(made.objects.values())), name="column")}
    tests = [replace(test, object="column") for test in made.tests]
    found = rs.calibrate(
        replace(made, tests=tests, objects=given),
        sampling=rs.calibration.DrawOptions(draws=30, gains=2, rounds=1),
        model=rs.Linear(),
    )
    with without_pictures():
        rs.export.write_calibration(found, folder)


def run_line(line: str) -> None:
    """Run a command line as a shell does, and see that it leaves each file that it names."""
    words = [
        found
        for word in shlex.split(line)
        for found in (("*" in word and sorted(map(str, Path().glob(word)))) or [word])
    ]
    ran = rocksteady("", *words)
    assert ran.code == 0, ran.err
    for flag, file in itertools.pairwise(words):
        if flag in {"--plot", "--animate", "--csv", "--out"}:
            assert Path(file).exists(), file


def run_on_gpu(line: str) -> None:
    """Run a command line that needs a GPU; without one it must say so, in one line."""
    ran = rocksteady("", *shlex.split(line))
    if ran.code:
        assert ran.code == 2
        assert re.search(r"^rocksteady: --executor = 'gpu' is not valid: .+$", ran.err), ran.err


@pytest.mark.slow
@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("line", [line for line in TYPED if ELSEWHERE.search(line)])
def test_a_command_line_runs_on_a_gpu_or_says_that_there_is_none_and_on_a_cluster(
    line: str,
) -> None:
    from distributed import LocalCluster

    if "--executor gpu" in line:
        return run_on_gpu(shortened(line))
    with LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster:
        run_line(re.sub(r"tcp:\S+", cluster.scheduler_address, shortened(line)))
    return None


@pytest.mark.slow
@every("line", [line for line in EVERY if line not in TYPED])
def test_a_command_that_is_named_has_the_flags_that_are_named(line: str) -> None:
    flags = re.findall(r"--[\w-]+", line)
    ran = rocksteady("", *line.partition(" --")[0].split(), "--help-all")
    assert ran.code == 0, ran.err
    assert set(flags) <= set(re.findall(r"--[\w-]+", ran.out))


# ------------------------------------------------------------------ names, targets and places


def test_pages_name_public_things_extras_and_targets_that_there_are() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    targets = set(re.findall(r"^\.PHONY: ([\w.-]+)$", makefile, re.MULTILINE))
    for name, text in PAGES.items():
        named = re.findall(r"\brs\.((?:(?:" + "|".join(MODULES) + r")\.)?\w+)", text)
        assert set(named) <= {*PLACES.values(), *MODULES}, name
        assert set(re.findall(r"rocksteady\[(\w+)\]", text)) <= {*project["optional-dependencies"]}
        assert set(re.findall(r"(?:^|`)make ([a-z-]+)", text, re.MULTILINE)) <= targets, name


ROWS = re.compile(r"^\| (?!question|---)(.+?) \| (.+) \|$", re.MULTILINE)
"""A row of the table of questions: the question, and where its answer is."""
PLACE = re.compile(r"`([\w./]+)`(?:: `(\w+)`(?:, `(\w+)`)?)?")
"""A place in such a row: a path, perhaps with one or two names that the file defines."""


def defined_in(file: Path) -> set[str]:
    """Return the names of all functions and classes of a file, and what its top level assigns."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    named = (ast.FunctionDef, ast.ClassDef)
    found = {node.name for node in ast.walk(tree) if isinstance(node, named)}
    for node in tree.body:
        targets = node.targets if isinstance(node, ast.Assign) else []
        targets += [node.target] if isinstance(node, ast.AnnAssign) else []
        found |= {target.id for target in targets if isinstance(target, ast.Name)}
    return found


def test_what_the_table_of_questions_names_is_where_it_says() -> None:
    page = PAGES["CONTRIBUTING.md"]
    begin = page.index("## Where do I find ...")
    rows = ROWS.findall(page[begin : page.index("\n\n`src/rocksteady`", begin)])
    assert page.index("\n## ") == begin - 1  # the page begins with it
    assert len(rows) >= 12
    for question, answer in rows:
        places = [place for place in PLACE.findall(answer) if "/" in place[0] or "." in place[0]]
        assert places, question
        for path, *names in places:
            folder = ROOT if (ROOT / path).exists() else ROOT / "src" / "rocksteady"
            assert (folder / path).exists(), path
            wanted = {name for name in names if name}
            assert not wanted or wanted <= defined_in(folder / path), (path, wanted)


MADE = images.makers()
ELSEWHERE_MADE = {"architecture.png", "facade-checks.png", "facade-checks-wall.png"}
"""Pictures of `make architecture`, and of records that nobody may pass on."""


def test_captions_name_what_makes_each_picture_and_it_is_there_on_both_papers_and_small() -> None:
    scripts = {maker for maker in MADE.values() if maker.startswith("examples/")}
    assert all((ROOT / script).is_file() for script in scripts)
    pictures = {file.name: file.stat().st_size for file in images.IMAGES.glob("*.png")}
    twins = {dark_twin(Path(name)).name for name in (*MADE, "architecture.png")}
    assert set(pictures) == {*MADE, *twins, *ELSEWHERE_MADE}
    assert max(pictures.values()) < 150_000


@pytest.mark.slow
@every("name", ["wall.png", "basins.png"])  # of a script, and of a command line
def test_a_picture_is_drawn_on_both_papers_by_what_its_caption_names(
    name: str, tmp_path: Path
) -> None:
    maker = MADE[name].replace(":400", ":60")
    images.draw(name, maker, tmp_path)
    for file in (tmp_path / name, dark_twin(tmp_path / name)):
        assert 5_000 < file.stat().st_size < 150_000
        with Image.open(file) as picture:
            assert picture.info["Source"] == maker
            assert picture.convert("RGBA").getpixel((0, 0))[3] == 0  # type: ignore[index]
