"""The reference of the command line: one page a command, from the program itself.

The pages are written below `docs/reference/commands` when a build begins, and only where they have
changed, so that Sphinx reads again no other.  Each option can be linked as `#option-NAME`.
"""

import inspect
import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import typer.main
from docutils import nodes
from rich.text import Text
from sphinx import addnodes
from sphinx.application import Sphinx

from rocksteady.cli.app import app as program
from rocksteady.cli.flags.parsing import UNITS
from tools.manual.commands_facts import (
    FILES,
    GUIDES,
    HOW_TO,
    INTERVAL,
    PYTHON,
    VALID,
    default_in,
)
from tools.namespace import PLACES

FOLDER = "reference/commands"
FILES_FOLDER = "reference/files"
RANGE = re.compile(r"([\[(][-\w.]+), ([-\w./]+[\])])")
"""An interval, as in a column of valid values."""
NAME = "rocksteady"
HOW_TOS = Path(__file__).parents[2] / "docs" / "how-to"
GENERAL = "General"
"""The panel of options that name none."""
SYMBOLS = {"metres": "m", "seconds": "s", "radians": "rad", "m/s^2": "m/s²"}
"""Units as the program's messages have them, and as pages do."""
ESCAPED = re.compile(r"([\\`*_{}\[\]<>#|$&~^!%@])")
CODE = re.compile(
    r"(?P<ticks>`[^`]+`)"
    r"|(?P<quoted>(?<!\w)'[^'\s]+'(?!\w))"
    r"|(?P<flag>(?<![\w/.=-])--?[A-Za-z][\w-]*(?:=[\w.:+-]+)?)"
)
"""What is typed as it stands: text between backticks or quotes, and flags."""


@dataclass(frozen=True)
class Command:
    """A command as typer holds it, with the words that call it."""

    words: tuple[str, ...]
    held: Any

    @property
    def slug(self) -> str:
        """Name of its page."""
        return "-".join(self.words)

    @property
    def options(self) -> list[Any]:
        """Its options, those that help hides excepted."""
        found = [each for each in self.held.params if each.param_type_name == "option"]
        return [each for each in found if not each.hidden]

    @property
    def arguments(self) -> list[Any]:
        """Its arguments without a flag."""
        return [each for each in self.held.params if each.param_type_name == "argument"]

    @property
    def subcommands(self) -> dict[str, Any]:
        """What it groups, if it is a group."""
        return dict(getattr(self.held, "commands", {}))


def commands_of(typed: typer.Typer = program) -> list[Command]:
    """Return every command of a program in the order of its help, a group before its own."""
    return list(_below(Command((), typer.main.get_command(typed))))


def _below(command: Command) -> Iterator[Command]:
    for name, held in command.subcommands.items():
        found = Command((*command.words, name), held)
        yield found
        yield from _below(found)


# ------------------------------------------------------------------------------------- the text


def escaped(text: str) -> str:
    """Return plain text as Markdown that shows it, within a line."""
    return ESCAPED.sub(r"\\\1", text)


def code(text: str) -> str:
    """Return text as inline code, whatever backticks it has."""
    longest = max((len(run) for run in re.findall(r"`+", text)), default=0)
    ticks = "`" * (longest + 1)
    pad = " " if text[:1] == "`" or text[-1:] == "`" or not text.strip() else ""
    return f"{ticks}{pad}{text}{pad}{ticks}"


def markdown(help_text: str, flags: frozenset[str] = frozenset()) -> str:
    """Return a help text with rich markup as Markdown, its paragraphs apart.

    Parameters
    ----------
    help_text
        Text as typer takes it.
    flags
        Flags that the page defines: they become links.
    """
    paragraphs = re.split(r"\n\s*\n", inspect.cleandoc(help_text))
    return "\n\n".join(_paragraph(" ".join(each.split()), flags) for each in paragraphs)


def _paragraph(text: str, flags: frozenset[str]) -> str:
    shown = Text.from_markup(text, emoji=False)
    ends = sorted(
        {0, len(shown), *(edge for span in shown.spans for edge in (span.start, span.end))}
    )
    parts = []
    for begin, end in itertools.pairwise(ends):
        styles = {str(each.style) for each in shown.spans if each.start <= begin < each.end}
        part = _inline(shown.plain[begin:end], flags)
        for style, mark in (("italic", "*"), ("bold", "**")):
            if style in styles and part.strip():
                before, after = part[: len(part) - len(part.lstrip())], part[len(part.rstrip()) :]
                part = f"{before}{mark}{part.strip()}{mark}{after}"
        parts.append(part)
    return _safe_begin("".join(parts))


def _inline(text: str, flags: frozenset[str]) -> str:
    parts, last = [], 0
    for found in CODE.finditer(text):
        parts.append(escaped(text[last : found.start()]))
        last = found.end()
        whole = found[0]
        if found["flag"] and whole in flags:
            parts.append(f"{{option}}`{whole}`")
        else:
            parts.append(code(whole if found["flag"] else whole[1:-1]))
    return "".join([*parts, escaped(text[last:])])


def _safe_begin(paragraph: str) -> str:
    """Return a paragraph whose first characters make no list, heading, fence or target of it."""
    return re.sub(r"^(?=[-+=:(])", r"\\", re.sub(r"^(\d+)([.)])", r"\1\\\2", paragraph))


# ------------------------------------------------------------------------------------ an option


def value_of(option: Any) -> str:
    """Return what follows a flag, as its help names it; nothing for a switch."""
    if option.is_flag:
        return ""
    return str(option.metavar or option.name.upper())


def unit_of(option: Any) -> str:
    """Return the unit that the name of a flag ends with."""
    for flag in option.opts:
        for ending, unit in UNITS.items():
            if flag.endswith(ending) and not option.is_flag:
                return SYMBOLS.get(unit, unit)
    return ""


def default_of(option: Any) -> str:
    """Return the default of an option: the program's, or what its help names."""
    if option.is_flag:
        return "" if option.default is None else "on" if option.default else "off"
    if option.default is not None:
        return str(option.default)
    return default_in(option.help or "")


def kind_of(option: Any) -> str:
    """Return what sort of value an option takes, where its type or its name has it."""
    held = str(option.type_descriptor.annotation)
    if option.is_flag:
        return "switch"
    if "Path" in held:
        return "path"
    if "int" in held:
        return "whole number"
    if "float" in held:
        return "number"
    return "number or axis" if value_of(option) == "AXIS" else ""


def switch_names(option: Any) -> list[str]:
    """Return every spelling of an option, long ones first."""
    return sorted([*option.opts, *option.secondary_opts], key=lambda flag: flag[:2] != "--")


def _facts(option: Any) -> str:
    """Return the line of an option's value, unit, valid values and default."""
    unit, default, flag = unit_of(option), default_of(option), option.opts[0]
    interval = INTERVAL.search((option.help or "").replace("\\[", "["))
    kind = kind_of(option) or ("number" if unit else "")
    facts = [f"{kind} [{unit}]" if unit else kind] if kind else []
    facts = [escaped(each) for each in facts]
    if option.multiple:
        facts.append("may be repeated")
    if option.required:
        facts.append("required")
    if flag in VALID:
        facts.append("one of " + ", ".join(code(each) for each in VALID[flag]))
    elif interval and not option.is_flag:
        facts.append("in " + escaped(interval[1]))
    if default:
        exact = option.default is not None and not option.is_flag
        facts.append("default " + (code(default) if exact else _inline(default, frozenset())))
    return " · ".join(facts)


def option_block(option: Any, flags: frozenset[str]) -> str:
    """Return an option as a directive of Sphinx, with what its value may be."""
    value = value_of(option)
    names = ", ".join(f"{flag} {value}".strip() for flag in switch_names(option))
    facts = _facts(option)
    body = [f"*{facts}*"] if facts else []
    text = "\n\n".join([*body, markdown(option.help or "", flags)])
    return f"````{{option}} {names}\n:no-index-entry:\n\n{text}\n````"


def panels_of(command: Command) -> dict[str, list[Any]]:
    """Return the options of a command by the panels of its help, in their order."""
    found: dict[str, list[Any]] = {}
    for option in command.options:
        found.setdefault(option.rich_help_panel or GENERAL, []).append(option)
    return found


# --------------------------------------------------------------------------------------- a page


def examples_of(command: Command) -> list[str]:
    """Return the command lines below a command's help."""
    return re.findall(rf"^{NAME} .*$", command.held.epilog or "", re.MULTILINE)


def usage_of(command: Command) -> str:
    """Return the line that shows how a command is called."""
    context = command.held.make_context(command.words[-1], [], resilient_parsing=True)
    pieces = command.held.collect_usage_pieces(context)
    return " ".join([NAME, *command.words, *pieces])


def exit_codes(command: Command) -> dict[int, str]:
    """Return the exit codes that a command can leave with, and why."""
    found = {0: "The command has done what it was called for."}
    flags = {flag: option for option in command.options for flag in option.opts}
    if "--check" in flags:
        found[1] = "With `--check`: the verdict is negative."
    found[2] = "A flag or a file is not valid; the message names it."
    source = inspect.getmodule(getattr(command.held, "callback", None))
    source = inspect.getmodule(inspect.unwrap(command.held.callback)) if source else None
    text = inspect.getsource(source) if source else ""
    if "INCOMPLETE" in text or "Exit code 3" in (command.held.help or ""):
        said = re.search(r"Exit code 3 (where [^.]+)\.", command.held.help or "")
        why = f": {_inline(said[1].removeprefix('where '), frozenset())}" if said else ""
        found[3] = f"The answer is incomplete or undecided{why}."
    found[130] = "Interrupted with Ctrl-C."
    return found


def page_of(command: Command) -> str:
    """Return the page of a command."""
    flags = frozenset(flag for option in command.options for flag in switch_names(option))
    title = " ".join(command.words)
    lines = [f"# {escaped(title)}", f":::{{program}} {NAME} {title}\n:::"]
    lines += [markdown(command.held.help or "", flags), f"```text\n{usage_of(command)}\n```"]
    if command.subcommands:
        lines += ["| command | what it answers |\n|---|---|\n" + "\n".join(_rows(command))]
        return "\n\n".join(lines) + "\n"
    examples = examples_of(command)
    if examples:
        lines += ["## Examples", *(f"```bash\n{example}\n```" for example in examples)]
        lines += map(markdown, re.findall(r"^Your .*$", command.held.epilog, re.MULTILINE))
    if command.arguments:
        lines += ["## Arguments"]
        for each in command.arguments:
            required = "required" if each.required else "may be left out"
            several = ", one or more" if each.nargs == -1 else ""
            text = markdown(each.help or "", flags).replace("\n", "\n  ")
            lines += [f"{code(str(each.metavar))}\n: {required}{several}\n\n  {text}"]
    lines += ["## Options"]
    for panel, options in panels_of(command).items():
        lines += [f"### {escaped(panel)}", *(option_block(each, flags) for each in options)]
    rows = "\n".join(f"| {number} | {why} |" for number, why in exit_codes(command).items())
    lines += ["## Exit codes", f"| code | meaning |\n|---|---|\n{rows}"]
    more = "All codes, and how messages and results are kept apart: [](../commands.md)."
    if "--json" in flags:
        more += " Keys of `--json`, and columns of `--csv`: [](../files/results.md)."
    lines += [more]
    lines += _see_also(command)
    return "\n\n".join(lines) + "\n"


def _rows(group: Command) -> Iterator[str]:
    """Yield the rows of a group's table: its commands and the first sentence of their help."""
    for name, held in group.subcommands.items():
        slug = Command((*group.words, name), held).slug
        first = markdown(held.help or "").partition("\n\n")[0]
        yield f"| [{code(name)}]({slug}.md) | {first} |"


def _see_also(command: Command) -> list[str]:
    """Return where the subject is explained, and what does the same in Python."""
    slug = command.slug
    tasks = [
        f"how-to/{each}.md" for each in HOW_TO.get(slug, ()) if (HOW_TOS / f"{each}.md").exists()
    ]
    pages_of_kind = {
        "Guides and theory": [f"[](../../{each})" for each in GUIDES.get(slug, ())],
        "How-to": [f"[](../../{each})" for each in tasks],
        "Files": [f"[](../files/{each}.md)" for each in FILES.get(slug, ())],
        "Python": [f"{{py:obj}}`~{NAME}.{PLACES[each]}`" for each in PYTHON.get(slug, ())],
    }
    rows = [f"- {kind}: {', '.join(links)}" for kind, links in pages_of_kind.items() if links]
    return ["## See also", "\n".join(rows)] if rows else []


def flags_page(commands: list[Command]) -> str:
    """Return the page of all flags, each with the commands that have it."""
    held: dict[str, list[Command]] = {}
    values: dict[str, str] = {}
    for command in commands:
        for option in command.options:
            name = ", ".join(switch_names(option))
            held.setdefault(name, []).append(command)
            values.setdefault(name, value_of(option))
    rows = []
    for name in sorted(held, key=str.lower):
        anchor = anchor_of(name.partition(",")[0])
        links = ", ".join(f"[{' '.join(c.words)}]({c.slug}.md#{anchor})" for c in held[name])
        value = code(values[name]).replace("|", r"\|") if values[name] else ""
        shown = ", ".join(code(each) for each in name.split(", "))
        rows.append(f"| {shown} | {value} | {links} |")
    return (
        "# All flags\n\nEvery flag, its value, and the commands that have it.\n\n"
        "| flag | value | commands |\n|---|---|---|\n" + "\n".join(rows) + "\n"
    )


def pages(typed: typer.Typer = program) -> dict[str, str]:
    """Return every page by the name of its file."""
    commands = commands_of(typed)
    found = {f"{command.slug}.md": page_of(command) for command in commands}
    return {**found, "flags.md": flags_page(commands)}


def write(folder: Path, typed: typer.Typer = program) -> list[Path]:
    """Write the pages that have changed and remove those of commands that are gone.

    Returns
    -------
    list of Path
        What was written or removed.
    """
    folder.mkdir(parents=True, exist_ok=True)
    wanted, changed = pages(typed), []
    for file in sorted(folder.glob("*.md")):
        if file.name not in wanted:
            file.unlink()
            changed.append(file)
    for name, text in wanted.items():
        file = folder / name
        if not file.exists() or file.read_text(encoding="utf-8") != text:
            file.write_text(text, encoding="utf-8")
            changed.append(file)
    return changed


# ------------------------------------------------------------------------------------ the build


def anchor_of(flag: str) -> str:
    """Return the part of an address that leads to a flag."""
    return f"option-{flag.lstrip('-').lower()}"


def _write(app: Sphinx) -> None:
    write(Path(app.srcdir) / FOLDER)


def _anchor(app: Sphinx, tree: nodes.document) -> None:
    """Give each option of a page its anchor, which links in Markdown know."""
    page = app.env.current_document.docname
    if not page.startswith(FOLDER):
        return
    slugs: dict[str, Any] = app.env.metadata[page].setdefault("myst_slugs", {})
    for option in tree.findall(addnodes.desc):
        if option.get("objtype") != "option":
            continue
        signature = next(iter(option.findall(addnodes.desc_signature)))
        flag = signature["allnames"][0]
        anchor = anchor_of(flag)
        signature["ids"].insert(0, anchor)
        slugs[anchor] = (signature.line or 0, anchor, flag)


def _mark_keys(app: Sphinx, tree: nodes.document) -> None:
    """Mark the tables of keys of files, and keep their intervals in one line."""
    if not app.env.current_document.docname.startswith(FILES_FOLDER):
        return
    for table in tree.findall(nodes.table):
        heads = [head.astext() for head in table.findall(nodes.thead)]
        if heads and heads[0].endswith("trap"):
            table["classes"].append("keys")
            for text in list(table.findall(nodes.Text)):
                kept = RANGE.sub("\\1,\u00a0\\2", text)
                if kept != text:
                    text.parent.replace(text, nodes.Text(kept))


def setup(app: Sphinx) -> dict[str, Any]:
    """Write the pages before Sphinx looks for them, and mark options and tables of keys."""
    app.connect("builder-inited", _write)
    app.connect("doctree-read", _anchor)
    app.connect("doctree-read", _mark_keys)
    app.add_css_file("reference.css")
    return {"env_version": 1, "parallel_read_safe": True, "parallel_write_safe": True}
