"""The reference of the command line: complete, true, the same each time, and safe from any text."""

import inspect
import io
import re
import warnings
from collections import Counter
from pathlib import Path
from typing import Annotated, Any

import pytest
import typer
from docutils import nodes
from docutils.core import publish_doctree
from hypothesis import example, given, settings
from hypothesis import strategies as st
from myst_parser.parsers.docutils_ import Parser
from rich.markup import escape
from rich.style import Style
from rich.text import Text

from tests.cli.program import ran_once, rocksteady
from tests.every import every
from tools.manual import commands as tool
from tools.manual import commands_facts as facts
from tools.namespace import THINGS

DOCS = Path(__file__).parents[2] / "docs"
COMMANDS = tool.commands_of()
LEAVES = [command for command in COMMANDS if not command.subcommands]
PAGES = tool.pages()
OPTION = re.compile(
    r"^````\{option\} ([^\n]+)\n:no-index-entry:\n\n(.*?)^````$", re.DOTALL | re.MULTILINE
)

each_command = every("command", LEAVES)


def flags_in(names: str) -> list[str]:
    return re.findall(r"(?:^|, )(--?[A-Za-z][\w-]*)", names)


def seen(markdown: str) -> str:
    """Return the text that a reader of Markdown sees, as MyST reads it."""
    return parsed(markdown).astext()


def parsed(markdown: str) -> nodes.document:
    said = io.StringIO()
    made = publish_doctree(
        markdown,
        parser=Parser(),
        settings_overrides={
            "warning_stream": said,
            "myst_enable_extensions": [
                "attrs_block",
                "attrs_inline",
                "colon_fence",
                "deflist",
                "dollarmath",
            ],
        },
    )
    assert said.getvalue() == ""
    return made


# -------------------------------------------------------------------------------- completeness


def test_there_is_a_page_for_each_command_that_the_help_lists() -> None:
    listed = re.findall(r"^  ([a-z][a-z-]*) ", rocksteady("", "--help").out, re.MULTILINE)
    below = {f"study-{name}.md" for name in ("atlas", "chaos")}
    assert set(PAGES) == {f"{name}.md" for name in listed} | below | {"flags.md"}
    assert len(listed) == 25


@each_command
def test_each_option_of_the_help_is_on_the_page_once(command: tool.Command) -> None:
    shown = ran_once(f"{' '.join(command.words)} --help-all").out
    rows = re.findall(r"^│ (--[\w-]+) +(-[A-Za-z])?", shown, re.MULTILINE)
    listed = {flag for row in rows for flag in row if flag} - {"--help", "-h", "--help-all"}
    written = Counter(
        flag for names, _ in OPTION.findall(PAGES[f"{command.slug}.md"]) for flag in flags_in(names)
    )
    assert set(written.values()) == {1}
    assert listed <= set(written)
    assert set(written) == {
        flag for option in command.options for flag in (*option.opts, *option.secondary_opts)
    }


@each_command
def test_panels_are_those_of_the_help_in_its_order(command: tool.Command) -> None:
    shown = ran_once(f"{' '.join(command.words)} --help-all").out
    titles = re.findall(r"^╭─ (.+?) ─", shown, re.MULTILINE)
    wanted = [title for title in titles if title not in {"Options", "Arguments"}]
    written = re.findall(r"^### (.+)$", PAGES[f"{command.slug}.md"], re.MULTILINE)
    assert [title for title in written if title != tool.GENERAL] == wanted


@each_command
def test_defaults_are_those_of_the_function_that_runs(command: tool.Command) -> None:
    signature = inspect.signature(command.held.callback)
    page = PAGES[f"{command.slug}.md"]
    for names, text in OPTION.findall(page):
        option = next(each for each in command.options if flags_in(names)[0] in each.opts)
        default = signature.parameters[option.name].default
        line = text.partition("\n")[0]
        if default is None or default is inspect.Parameter.empty:
            continue
        if default is False:
            assert line == "*switch · default off*"
        elif default is ...:
            assert line.endswith("required*"), (names, line)
        else:
            assert line.endswith(f"default `{default}`*"), (names, line)


def test_a_default_of_a_help_text_is_what_stands_there() -> None:
    assert facts.default_in("Set the interval; default 0.05.") == "0.05"
    assert facts.default_in("Choose nonlinear: nonlinear (default) or linear.") == "nonlinear"
    assert facts.default_in("Set a width \\[m], default half of --height-m.") == ""
    assert facts.default_in("half periods: 1 harmonic (default), 3 the third") == ""
    assert (
        facts.default_in("Set the columns; default 0.075:12:160. The time goes") == "0.075:12:160"
    )
    for command in LEAVES:
        for option in command.options:
            found = facts.default_in(option.help or "")
            assert found in (option.help or "").replace("\\[", "[")
            given_default = option.default
            if found and given_default is not None and not option.is_flag:
                assert str(given_default) == found.strip("'"), option.opts


def test_valid_values_and_intervals_are_those_of_the_program() -> None:
    for command in LEAVES:
        for option in command.options:
            flag = option.opts[0]
            if flag in facts.VALID and flag != "--format" and option.help:
                values = facts.VALID[flag]
                assert all(value in option.help + str(option.metavar) for value in values), flag
    assert rocksteady("attractor --side x --start steady -A 2 -W 1.9 -r 0.8").code == 2
    assert facts.INTERVAL.search("Set a ratio, in (0, 1], or") is not None


@each_command
def test_examples_and_usage_are_those_of_the_help(command: tool.Command) -> None:
    page = PAGES[f"{command.slug}.md"]
    shown = " ".join(ran_once(f"{' '.join(command.words)} --help-all").out.split())
    blocks = re.findall(r"^```bash\n(.*?)\n```$", page, re.DOTALL | re.MULTILINE)
    assert blocks == tool.examples_of(command)
    assert all(" ".join(block.split()) in shown for block in blocks)
    (usage,) = re.findall(r"^```text\n(.*?)\n```$", page, re.DOTALL | re.MULTILINE)
    assert f"Usage: {usage}" in shown


def test_what_stands_beside_a_command_is_there() -> None:
    slugs = {command.slug for command in COMMANDS}
    for table in (facts.GUIDES, facts.FILES, facts.HOW_TO, facts.PYTHON):
        assert set(table) <= slugs
    assert set(facts.GUIDES) >= {command.slug for command in LEAVES} - {"doctor"}
    assert {name for names in facts.PYTHON.values() for name in names} <= set(THINGS)
    assert all((DOCS / page).exists() for pages in facts.GUIDES.values() for page in pages)
    files = DOCS / "reference" / "files"
    assert all((files / f"{page}.md").exists() for pages in facts.FILES.values() for page in pages)


@pytest.mark.skipif(
    not (DOCS / "how-to" / "does-it-fall.md").exists(), reason="these pages are not there yet"
)
def test_each_how_to_that_is_linked_is_there() -> None:
    linked = {name for names in facts.HOW_TO.values() for name in names}
    assert {name for name in linked if not (DOCS / "how-to" / f"{name}.md").exists()} == set()


# --------------------------------------------------------------------------------- the overview


def test_the_overview_has_each_command_once_and_lists_each_page() -> None:
    text = (DOCS / "reference" / "commands.md").read_text(encoding="utf-8")
    table = text[text.index("| question |") : text.index("A flag that you know")]
    named = re.findall(r"\| \[`([\w -]+)`\]\(commands/([\w-]+)\.md\) \|", table)
    assert sorted(slug for _, slug in named) == sorted(command.slug for command in COMMANDS)
    assert all(words.replace(" ", "-") == slug for words, slug in named)
    tree = text[text.index("```{toctree}") :]
    listed = re.findall(r"^commands/([\w-]+)$", tree, re.MULTILINE)
    assert sorted(listed) == sorted(name.removesuffix(".md") for name in PAGES)


def test_flags_that_the_overview_links_are_options_of_that_command() -> None:
    pages = [DOCS / "reference" / "commands.md", *(DOCS / "reference" / "files").glob("*.md")]
    linked = {
        link
        for page in pages
        for link in re.findall(r"commands/([\w-]+)\.md#([\w-]+)\)", page.read_text("utf-8"))
    }
    known = {
        (command.slug, tool.anchor_of(option.opts[0]))
        for command in COMMANDS
        for option in command.options
    }
    assert len(linked) > 40
    assert linked - known == set()


def test_letters_codes_and_the_error_of_the_overview_are_those_of_the_program() -> None:
    text = (DOCS / "reference" / "commands.md").read_text(encoding="utf-8")
    letters = {flag for c in LEAVES for o in c.options for flag in o.opts if flag[:2] != "--"}
    sentence = text[text.index("**Flags are long**") :].partition("and `-h`")[0]
    assert set(re.findall(r"`(-\w)`", sentence)) == letters
    line = rocksteady("simulate --width-m .4 --height-m 2 --accel-g .4 --freq-hz two")
    assert line.err in text
    from rocksteady.cli import app
    from rocksteady.cli.console.outputs import INCOMPLETE

    codes = {0, 1, app.USAGE, INCOMPLETE, app.INTERNAL, app.INTERRUPTED}
    written = text[text.index("| code |") : text.index("## Environment")]
    assert {int(code) for code in re.findall(r"^\| (\d+) \|", written, re.MULTILINE)} == codes


# ----------------------------------------------------------------------- files, and any text


def test_pages_are_the_same_each_time_and_written_only_where_they_change(tmp_path: Path) -> None:
    folder = tmp_path / "commands"
    assert len(tool.write(folder)) == len(PAGES)
    assert tool.pages() == PAGES
    assert tool.write(folder) == []
    (folder / "gone.md").write_text("# gone\n", encoding="utf-8")
    (folder / "doctor.md").write_text("# old\n", encoding="utf-8")
    assert {file.name for file in tool.write(folder)} == {"gone.md", "doctor.md"}
    assert {file.name for file in folder.iterdir()} == set(PAGES)


def test_no_help_text_loses_words_to_markup() -> None:
    texts = [option.help or "" for command in COMMANDS for option in command.options]
    texts += [each.held.help for each in COMMANDS] + [each.held.epilog or "" for each in COMMANDS]
    for text in texts:
        for span in Text.from_markup(text).spans:
            Style.parse(str(span.style))  # "[rad]" without a backslash is no style


HOSTILE = "a|b <b>x</b> *y* **z** [w](v) [[u]] {t}`s` $r$ _q_ `p` &amp; \\n #o ~~m~~ 1. - + % ^ !"


def plain(text: str) -> str:
    """Return a text without the quotes and backticks around what is shown as code."""
    return re.sub(r"['`]", "", " ".join(text.split()))


@pytest.mark.slow
@settings(max_examples=150, deadline=None)
@example(HOSTILE)
@example("1. one")
@example("- item")
@example("(target)=")
@example(":::{note}")
@example("+ plus")
@example("--- line")
@example("| a | b |")
@given(st.text(st.sampled_from("ab1 .,:;|<>*_[](){}`$&\\#~^!%@=+-/'\""), max_size=40))
def test_any_help_text_is_shown_as_it_is(text: str) -> None:
    shown = Text.from_markup(
        escape(text), emoji=False
    ).plain  # but for a backslash at the end, text
    assert shown.rstrip("\\") == text.rstrip("\\")
    assert plain(seen(tool.markdown(escape(text)))) == plain(shown)


def test_marked_help_is_marked_in_the_page() -> None:
    made = tool.markdown("Set [bold]both[/bold] ends \\[m], [italic]or[/] none; see --x.")
    assert made == "Set **both** ends \\[m\\], *or* none; see `--x`."
    assert tool.markdown("see --x and --y", frozenset({"--x"})) == "see {option}`--x` and `--y`"


def hostile_program() -> typer.Typer:
    made = typer.Typer(rich_markup_mode="rich")

    def command(
        value: Annotated[
            str, typer.Option("--value", metavar="A|B", help=escape(HOSTILE))
        ] = "x|y`z",
    ) -> None:
        assert value

    made.command("one|two", help=escape(HOSTILE), epilog="rocksteady one --value '|'")(command)
    made.command("other", help="Other.")(lambda: None)
    return made


def test_a_hostile_program_has_pages_that_show_its_texts() -> None:
    pages = tool.pages(hostile_program())
    page = re.sub(r"````\{option\} .*\n:no-index-entry:", "", pages["one|two.md"])
    page = re.sub(r"^````$", "", page, flags=re.MULTILINE)
    page = re.sub(r":::\{program\}.*\n:::", "", page)
    tree = parsed(page.replace("[](../commands.md)", "there"))
    assert plain(tree.astext()).count(plain(HOSTILE)) == 2
    assert "default x|yz" in plain(tree.astext())
    assert next(title.astext() for title in tree.findall(nodes.title)) == "one|two"
    (rows,) = parsed(pages["flags.md"]).findall(nodes.tbody)
    assert [entry.astext() for entry in rows.findall(nodes.entry)][1] == "A|B"


# ------------------------------------------------------------------------------- in the site


@pytest.fixture(scope="module", name="site")
def _site(tmp_path_factory: pytest.TempPathFactory) -> tuple[Any, str]:
    """Return a site of a few pages, one of them of a command, with its warnings."""
    source = tmp_path_factory.mktemp("site")
    (source / "index.md").write_text(
        "# Home\n\n[wall](reference/commands/doctor.md#option-check) and "
        "{option}`rocksteady doctor --json`\n\n```{toctree}\n:glob:\n\nreference/*/*\n```\n",
        encoding="utf-8",
    )
    files = source / "reference" / "files"
    files.mkdir(parents=True)
    (files / "x.md").write_text("# X\n\n| key | trap |\n|---|---|\n| [0, 1) | no |\n", "utf-8")
    others = [f"reference/commands/{name}" for name in PAGES if name != "doctor.md"]
    said = io.StringIO()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of a later Sphinx
        app = _built(source, others, said)
    return app, said.getvalue()


def _built(source: Path, others: list[str], said: io.StringIO) -> Any:
    """Return the application that has built a site."""
    from sphinx.application import Sphinx

    app = Sphinx(
        source,
        None,
        source / "out",
        source / "trees",
        "html",
        confoverrides={
            "extensions": ["myst_parser", "tools.manual.commands"],
            "exclude_patterns": others,
            "myst_enable_extensions": ["attrs_block", "colon_fence", "deflist"],
        },
        status=None,
        warning=said,
    )
    app.build()
    return app


def test_options_are_linked_by_their_anchors_and_roles(site: tuple[Any, str]) -> None:
    app, said = site
    # Pages that this site does not have.
    # Where another test of this process has built a site, Sphinx warns of its own nodes.
    elsewhere = ("commands.md", "results.md", "how-to/", "already registered")
    lines = [line for line in said.splitlines() if not any(page in line for page in elsewhere)]
    assert lines == []
    home = Path(app.outdir, "index.html").read_text(encoding="utf-8")
    page = Path(app.outdir, "reference/commands/doctor.html").read_text(encoding="utf-8")
    assert 'href="reference/commands/doctor.html#option-check"' in home
    assert re.search(r'href="reference/commands/doctor.html#[\w-]*json"', home)
    for option in next(each for each in LEAVES if each.slug == "doctor").options:
        assert page.count(f'id="{tool.anchor_of(option.opts[0])}"') == 1


def test_tables_of_keys_are_marked_and_intervals_stay_in_a_line(site: tuple[Any, str]) -> None:
    page = Path(site[0].outdir, "reference/files/x.html").read_text(encoding="utf-8")
    assert re.search(r'<table class="[^"]*\bkeys\b', page)
    assert "[0,\N{NO-BREAK SPACE}1)" in page
