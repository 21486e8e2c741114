"""Pages of "How we know": each is listed and asserts what it claims; the manual's build runs it."""

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.every import every

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "docs" / "evidence"
PAGES = {page.stem: page.read_text(encoding="utf-8") for page in sorted(FOLDER.glob("*.md"))}
CELL = re.compile(r"^```\{code-cell\}[^\n]*\n(?::[^\n]*\n)*(.*?)^```$", re.MULTILINE | re.DOTALL)
LEAST = {"claims": 5, "corrections": 12, "limits": 5, "nature": 6, "oracles": 10, "peers": 6}
"""Assertions that a page has at least; `published` asserts in `row`, once for each number."""


def cells(page: str) -> list[str]:
    """Return the code of the cells of a page."""
    return CELL.findall(PAGES[page])


def assertions(code: str) -> int:
    """Count the assertions of a cell."""
    return sum(isinstance(node, ast.Assert) for node in ast.walk(ast.parse(code)))


def run(code: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run code by itself in a folder, without a screen."""
    return subprocess.run(
        [sys.executable, "-c", "import matplotlib\nmatplotlib.use('Agg')\n" + code],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )


def test_each_page_is_in_the_list_and_in_the_table_of_claims() -> None:
    listed = re.search(r"```\{toctree\}\n:hidden:\n\n(.*?)\n```", PAGES["index"], re.DOTALL)
    assert listed is not None
    others = set(PAGES) - {"index"}
    assert set(listed[1].split()) == others
    table = [line for line in PAGES["index"].splitlines() if line.startswith("|")]
    assert {name for name in others if any(f"]({name}.md" in line for line in table)} == others


@every("page", LEAST)
def test_a_page_asserts_what_it_claims(page: str) -> None:
    assert sum(map(assertions, cells(page))) >= LEAST[page]


@pytest.mark.slow
def test_a_row_of_published_numbers_fails_where_ours_is_off(tmp_path: Path) -> None:
    setup = cells("published")[0]
    good = run(f"{setup}\nprint(row('a', 1.0, 1.0 + 1e-12, 1e-9))", tmp_path)
    assert good.returncode == 0, good.stderr
    bad = run(f"{setup}\nprint(row('a', 1.0, 1.0 + 1e-6, 1e-9))", tmp_path)
    assert bad.returncode != 0
    assert "AssertionError" in bad.stderr
