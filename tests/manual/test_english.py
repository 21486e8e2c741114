"""English of docs/interface.md and of everything that a reader meets: pages, docstrings, comments,
error messages and help texts. Each rule is a pattern with what to write in its place.
"""

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from tests.every import every
from tests.trees import nodes_of, tree_of

ROOT = Path(__file__).parents[2]
SOURCE = ROOT / "src" / "rocksteady"
FORMULAE = ("kernels", "installation")
"""Folders whose sources are hashed into the compiled library; their words are formulae."""
GENERATED = ("docs/benchmarks.md", "docs/changelog.md", "docs/reference/commands/")
"""Pages, or folders of pages, that a command writes."""
TITLES = "docs/theory/literature.md"
"""Page whose titles have the spelling of their authors."""

SPELT = (
    "README.md",
    "CONTRIBUTING.md",
    "CHANGELOG.md",
    "docs",
    "src",
    "tools",
    "examples",
    "bench",
)
"""What codespell reads, with the settings of pyproject.toml."""

RULES = {
    r"(?<![-\w.])([a-z]{2,}) \1(?![-\w.])": "the word once",
    r"(?<![-\w.])\d+(?:\.\d+)?(?:kN|Hz|kHz|kg|km|cm)\b": "a space before the unit",
    r"\b(?:(?<!-)color(?:s|ed)?(?!-)|(?<!lower )centers?(?! left|:)|centered|behaviors?|gray|"
    r"neighbors?(?:ing)?|meters? (?:per|long)|labeled|modeled|modeling|favors?)\b": "British",
    r"\b(?!\w*(?:siz|priz|seiz))[a-z]\w{2,}iz(?:e|es|ed|ing|ation|ations)\b": "-ise, -isation",
}
"""What not to write, and what to write instead."""

NOT_NOUNS = frozenset({"found", "there", "own", "one", "other", "many", "both", "said", "told"})
"""Names that do not say what a variable holds."""
PUBLIC = {
    ("show/plots/observations/back_analysis.py", "found"),
    ("show/plots/maps.py", "found"),
    ("show/plots/spectra.py", "found"),
    ("errors.py", "found"),
}
"""Parameters of the public interface, which keep their names."""


def prose(text: str) -> str:
    """Return a text without code, formulae and line breaks."""
    text = re.sub(r"(?m)^\s*(?:>>>|\.\.\. ).*$", " ", text)
    text = re.sub(r"(?s)\n *Examples\n *-{3,}\n.*", " ", text)
    text = re.sub(r"``[^`]*``|`[^`\n]*`", " X ", text)
    return re.sub(r"\s+", " ", text)


def sources() -> list[Path]:
    """Return the modules whose words and names are held to the rules: no Italian ones."""
    return [
        file
        for file in sorted(SOURCE.rglob("*.py"))
        if file.relative_to(SOURCE).parts[0] not in FORMULAE and not file.stem.endswith("_it")
    ]


def in_python(file: Path) -> Iterator[tuple[int, str]]:
    """Yield line and words of every docstring, text and comment of a module."""
    for node in nodes_of(file):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and " " in node.value:
            yield node.lineno, prose(node.value)
    first, last, words = 0, -1, ""
    for line, text in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        comment = "#" in text and re.search(r"(?:^|\s)#(.*)", text)
        if not comment:
            continue
        if line == last + 1:
            words += comment[1]
        else:
            yield first, prose(words)
            first, words = line, comment[1]
        last = line
    yield first, prose(words)


def in_markdown(file: Path) -> Iterator[tuple[int, str]]:
    """Yield line and words of every paragraph of a page, without its code and formulae."""
    text = file.read_text(encoding="utf-8")
    for hidden in (
        r"(?ms)^(`{3,})[^\n]*\n.*?^\1\s*$",
        r"(?s)\A---\n.*?\n---\n",
        r"(?s)<!--.*?-->",
        r"(?s)\$\$.*?\$\$",
    ):
        text = re.sub(hidden, lambda match: "\n" * match[0].count("\n"), text)
    line = 1
    for paragraph in text.split("\n\n"):
        words = re.sub(r"\$[^$]*\$", " X ", paragraph)
        yield line, prose(re.sub(r"\]\([^)]*\)|\]\[[^\]]*\]", "]", words))
        line += paragraph.count("\n") + 2


def in_script(file: Path) -> Iterator[tuple[int, str]]:
    """Yield line and words of every text of a module of the explorer's page."""
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        for _, text in re.findall(r"(['\"`])((?:(?!\1).)* (?:(?!\1).)*)\1", line):
            yield number, text


def pages() -> list[Path]:
    """Return the pages that people write; the changelog is history."""
    written = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
    return [
        file
        for file in written
        if not str(file.relative_to(ROOT)).replace("\\", "/").startswith(GENERATED)
    ]


@cache
def texts() -> tuple[tuple[str, str], ...]:
    """Return the place and the words of all that a reader meets."""
    kinds = (
        (sources(), in_python),
        (pages(), in_markdown),
        (sorted((SOURCE / "explorer" / "parts").rglob("*.mjs")), in_script),
    )
    return tuple(
        (f"{file.relative_to(ROOT).as_posix()}:{line}", words)
        for files, reader in kinds
        for file in files
        for line, words in reader(file)
    )


@every("pattern", RULES)
def test_spelling_and_units_are_the_usual_ones(pattern: str) -> None:
    spelling = "British" in RULES[pattern] or "-ise" in RULES[pattern]
    rule = re.compile(pattern)
    hits = [
        f"{place}: {words[max(0, match.start() - 40) : match.end() + 40]}"
        for place, words in texts()
        if not (spelling and place.startswith(TITLES))
        for match in rule.finditer(words)
    ]
    assert not hits, f"write instead: {RULES[pattern]}\n" + "\n".join(hits)


@every(
    ("pattern", "sentence"),
    [
        (0, "It marks the the start."),
        (1, "A motion of 2Hz."),
        (-1, "The recognized format."),
    ],
)
def test_a_rule_finds_what_it_forbids(pattern: int, sentence: str) -> None:
    assert re.search(list(RULES)[pattern], sentence)


def bindings(node: ast.AST) -> Iterator[tuple[int, str]]:
    """Yield line and name of what a module binds, fields of classes and parameters excepted."""
    for child in ast.iter_child_nodes(node):
        fields = isinstance(node, ast.ClassDef) and isinstance(child, ast.AnnAssign | ast.Assign)
        if isinstance(child, ast.Name) and isinstance(child.ctx, ast.Store):
            yield child.lineno, child.id
        if not fields:
            yield from bindings(child)


def parameters(file: Path) -> Iterator[tuple[int, str]]:
    """Yield line and name of every parameter of the functions of a module."""
    for node in nodes_of(file):
        if isinstance(node, ast.arg):
            yield node.lineno, node.arg


def test_variables_are_nouns() -> None:
    hits = [
        f"{file.relative_to(SOURCE).as_posix()}:{line}: {name}"
        for file in sources()
        for line, name in bindings(tree_of(file))
        if name in NOT_NOUNS
    ]
    assert hits == []


def test_parameters_are_nouns_or_pairs() -> None:
    pairs = {"one", "other", "many", "both"}  # a pair, or a switch
    hits = [
        f"{place}:{line}: {name}"
        for file in sources()
        for place in [file.relative_to(SOURCE).as_posix()]
        for line, name in parameters(file)
        if name in NOT_NOUNS - pairs and (place, name) not in PUBLIC
    ]
    assert hits == []


def test_a_pronoun_as_a_variable_is_seen() -> None:
    code = (
        "class A:\n    there: int\n\ndef f(x):\n    found = [own for own in x]\n    return found\n"
    )
    assert {name for _, name in bindings(ast.parse(code))} == {"found", "own"}


def helps(file: Path) -> Iterator[ast.expr]:
    """Yield the help texts of a module: of typer's parameters, and of flags, shared ones too."""
    for node in nodes_of(file):
        if isinstance(node, ast.keyword) and node.arg == "help":
            yield node.value
        elif isinstance(node, ast.Call):
            words = [ast.unparse(each) for each in (node.func, *node.args[:1])]
            for place, word in enumerate(words):  # of partial(output_flag, ...) the second
                if word.endswith("_flag"):
                    yield from node.args[1 + place : 2 + place]


def test_no_unit_in_a_help_text_is_taken_for_markup() -> None:
    commands = [file for file in sources() if file.is_relative_to(SOURCE / "cli")]
    assert sum(1 for file in commands for _ in helps(file)) > 200
    hits = [
        f"{file.relative_to(SOURCE).as_posix()}:{node.lineno}: {match[0]}"
        for file in commands
        for node in helps(file)
        for part in ast.walk(node)
        if isinstance(part, ast.Constant) and isinstance(part.value, str)
        for match in re.finditer(r"(?<!\\)\[[a-z#/@][^\[\]]*\]", part.value)
    ]
    assert hits == []


def test_codespell_finds_no_misspelt_word() -> None:
    pytest.importorskip("codespell_lib")
    run = subprocess.run(
        [sys.executable, "-m", "codespell_lib", *SPELT],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stdout + run.stderr
