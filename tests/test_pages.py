"""The pages of the documentation: each block of Python runs alone and prints what the page shows
below it; what pages name is there.
"""

import ast
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from PIL import Image
from sybil import Example, Sybil
from sybil.parsers.markdown import CodeBlockParser

from tests.every import every
from tests.manual.lines import PAGES, ROOT, blocks
from tools.manual import images
from tools.manual.twins import dark_twin
from tools.namespace import MODULES, PLACES

PRINTED = re.compile(r"\n\nIt prints\n\n```text\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def run_alone(example: Example) -> None:
    """Run a block in a process and a folder of its own: it prints what the page shows, if any."""
    with TemporaryDirectory() as folder:
        Path(folder, "page.py").write_text(example.parsed, encoding="utf-8")
        command = [sys.executable, "-W", "error", "page.py"]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    shown = PRINTED.match(example.document.text, example.end)
    assert shown is None or done.stdout == shown[1]


SYBIL = Sybil([CodeBlockParser("python", run_alone)])
EXAMPLES = {
    f"{name}:{example.line}": example for name in PAGES for example in SYBIL.parse(ROOT / name)
}


@pytest.mark.slow
@pytest.mark.parametrize("name", EXAMPLES)
def test_each_block_of_python_runs_alone(name: str) -> None:
    EXAMPLES[name].evaluate()


def test_what_is_printed_stands_below_the_block_that_prints_it() -> None:
    held = sum(
        PRINTED.match(each.document.text, each.end) is not None for each in EXAMPLES.values()
    )
    assert held == sum(text.count("\nIt prints\n") for text in PAGES.values()) >= 7


# -------------------------------------------------------------------------- kinds of blocks

RUN_HERE = {"python", "sh", "toml"}
SHOWN = {"text", "bibtex", "json"}
"""What programs print, and what is given to other programs."""
DIRECTIVE = re.compile(r"\{([\w:-]+)\}")


def test_each_block_is_of_a_kind_that_some_check_runs() -> None:
    """Cells, directives included, are run by the build of the manual."""
    for name, text in PAGES.items():
        for kind, body in blocks(text):
            assert kind in RUN_HERE | SHOWN or DIRECTIVE.match(kind), (name, kind, body)


def test_each_block_of_toml_is_toml() -> None:
    for text in PAGES.values():
        for kind, body in blocks(text):
            assert kind != "toml" or tomllib.loads(body)


# ------------------------------------------------------------------ names, targets and places


def test_pages_name_public_things_extras_and_targets_that_there_are() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    targets = set(re.findall(r"^\.PHONY: ([\w.-]+)$", makefile, re.MULTILINE))
    for name, text in PAGES.items():
        named = re.findall(r"\brs\.((?:(?:" + "|".join(MODULES) + r")\.)?\w+)", text)
        assert set(named) <= {*PLACES.values(), *MODULES}, name
        extras = ",".join(re.findall(r"rocksteady\[([\w,]+)\]", text)).split(",")
        assert set(extras) <= {"", *project["optional-dependencies"]}
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


def test_captions_name_what_makes_each_picture_and_it_is_there_on_both_papers_and_small() -> None:
    scripts = {maker for maker in MADE.values() if maker.startswith("examples/")}
    assert all((ROOT / script).is_file() for script in scripts)
    pictures = {file.name: file.stat().st_size for file in images.IMAGES.glob("*.png")}
    twins = {dark_twin(Path(name)).name for name in MADE}
    assert set(pictures) == {*MADE, *twins}
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
