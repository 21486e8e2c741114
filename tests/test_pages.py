"""The pages of the documentation: their Python runs, each page as one script, and prints what the
page says; the table of layers names the modules that there are.
"""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGES = [
    page
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")))
    if "```python" in page.read_text(encoding="utf-8")
]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_the_python_of_a_page_runs(page: Path, tmp_path: Path) -> None:
    text = page.read_text(encoding="utf-8")
    script = tmp_path / "page.py"
    script.write_text(
        "\n\n".join(re.findall(r"^```python\n(.*?)^```$", text, re.DOTALL | re.MULTILINE))
    )
    done = subprocess.run(
        [sys.executable, "-W", "error", script.name],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    for printed in re.findall(r"^It prints\n\n```\n(.*?)^```$", text, re.DOTALL | re.MULTILINE):
        assert printed in done.stdout


LAYERS = re.compile(r"^\| `(\w+)` \| (`.*?) \|", re.MULTILINE)
"""A row of the table of layers: a layer, and its modules."""
MODULES = re.compile(r"`(\w+)/` \(([^)]*)\)|`(\w+)/?`")
"""In such a row: a package with its modules, or a module or package by its name."""


def test_the_table_of_layers_names_each_module_once() -> None:
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    rows = dict(LAYERS.findall(text[text.index("## Layers as built") : text.index("Foreseen")]))
    source = ROOT / "src" / "rocksteady"
    assert set(rows) == {
        folder.name for folder in source.iterdir() if (folder / "__init__.py").is_file()
    }
    for layer, said in rows.items():
        named: list[str] = []
        whole: set[str] = set()  # packages that stand for all of their modules
        for package, inside, alone in MODULES.findall(said):
            if package:
                named += [f"{package}/{name}" for name in re.findall(r"`(\w+)`", inside)]
            elif (source / layer / alone).is_dir():
                whole.add(alone)
            else:
                named.append(alone)
        there = [
            file.relative_to(source / layer).with_suffix("").as_posix()
            for file in (source / layer).rglob("*.py")
            if not file.name.startswith("__")
            and file.relative_to(source / layer).parts[0] not in whole
        ]
        assert sorted(named) == sorted(there), layer
