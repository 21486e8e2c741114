"""Docstrings as the reference shows them: types from the source, and names that link.

The docstrings of the package follow NumPy's style, without types. The types are put into the lists
of parameters and attributes here. A name between single backticks links to the public object of
that name; what is no public name stays a literal.
"""

import contextlib
import inspect
import re
import sys
from enum import Enum
from types import ModuleType
from typing import Any

from docutils import nodes
from docutils.parsers.rst.states import Inliner
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.domains.python import PythonDomain

from rocksteady.errors import ModelError
from rocksteady.outcomes import Status
from rocksteady.results.result import Result, plotting_function
from tools.manual.types_in_words import type_of_result, types_of
from tools.namespace import COMMON_WORDS, PLACES, THINGS

COMMON = ("describe", "summary", "to_dict", "to_dataframe", "plot")
"""What every result can do, as one section of the reference explains."""
NAMES = re.compile(r"\*{0,2}\w+(, \*{0,2}\w+)*")
COLON = "\ue000"
"""Stands for a colon while napoleon reads a docstring."""
WORD = re.compile(r"(?<![`.\w])[A-Z]\w+(?![`.\w])")

# ------------------------------------------------------------------------------------------- names


def resolve(text: str, inside: str | None = None) -> str | None:
    """Return the full name of what a name between backticks means, if it is public.

    Parameters
    ----------
    text
        What stands between the backticks.
    inside
        The public class whose docstring it is, or one of whose members.
    """
    name = text.removesuffix("()").removeprefix("rocksteady.")
    *before, last = name.split(".")
    if name in PLACES.values():
        return f"rocksteady.{name}"
    if not before:
        if last in PLACES.keys() - COMMON_WORDS:
            return f"rocksteady.{PLACES[last]}"
        known = inside in PLACES and _is_documented(inside, last)
        return f"rocksteady.{PLACES[inside]}.{last}" if inside and known else None
    holder = before[-1]
    if holder in PLACES and ".".join(before) in {holder, PLACES[holder]}:
        return f"rocksteady.{PLACES[holder]}.{last}" if has_member(holder, last) else None
    module = sys.modules.get(f"rocksteady.{'.'.join(before)}")  # by the module that defines it
    if last in THINGS and getattr(module, last, None) is THINGS[last]:
        return f"rocksteady.{PLACES[last]}"
    return None


def has_member(name: str, member: str) -> bool:
    """Return whether a public class has a public member, a field without a default included."""
    thing = THINGS[name]
    fields = getattr(thing, "__dataclass_fields__", {})
    return not member.startswith("_") and (member in fields or hasattr(thing, member))


def _is_documented(name: str, member: str) -> bool:
    """Return whether a member of a public class is a method or property."""
    thing = THINGS.get(name)
    if not isinstance(thing, type) or member in getattr(thing, "__dataclass_fields__", {}):
        return False
    value = inspect.getattr_static(thing, member, None)
    return not member.startswith("_") and not isinstance(value, str | None) and has_text(value)


def has_text(value: object) -> bool:
    """Return whether a member has a docstring of its own."""
    value = getattr(value, "__func__", value)
    return bool(getattr(value, "__doc__", None)) and not isinstance(value, int | float | tuple)


def name_role(
    _role: str,
    rawtext: str,
    text: str,
    _line: int,
    inliner: Inliner,
    options: dict[str, Any] | None = None,
    content: list[str] | None = None,
) -> tuple[list[nodes.Node], list[nodes.system_message]]:
    """Make a link of a name between single backticks, or a literal of what is no public name."""
    del options, content
    env = inliner.document.settings.env
    target = resolve(text, env.ref_context.get("py:class"))
    if target is None:
        return [nodes.literal(rawtext, text)], []
    link = addnodes.pending_xref(
        rawtext,
        nodes.literal(rawtext, text.removeprefix("rocksteady."), classes=["xref", "py", "py-obj"]),
        refdoc=env.current_document.docname,
        refdomain="py",
        refexplicit=True,
        reftarget=target,
        reftype="obj",
        refwarn=True,
    )
    return [link], []


# ---------------------------------------------------------------------------------------- sections


def sections(lines: list[str]) -> list[tuple[str, int, int]]:
    """Return the sections of a docstring: title, first line of its content, and line after it."""
    heads = [
        i
        for i in range(len(lines) - 1)
        if re.fullmatch(r"[A-Z]\w+", lines[i]) and re.fullmatch(r"-{3,}", lines[i + 1])
    ]
    ends = [*heads[1:], len(lines)][: len(heads)]
    return [(lines[i], i + 2, end) for i, end in zip(heads, ends, strict=True)]


def add_types(lines: list[str], words: dict[str, str]) -> None:
    """Write the types of parameters and attributes behind their names."""
    for title, first, end in sections(lines):
        for i in range(first, end):
            line = lines[i]
            if title in {"Parameters", "Attributes"} and NAMES.fullmatch(line):
                names = [name.lstrip("*") for name in line.split(", ")]
                found = list(dict.fromkeys(words[name] for name in names if name in words))
                lines[i] = f"{line} : {', '.join(found)}" if found else line
            elif title in {"Returns", "Yields"} and line[:1].strip():
                lines[i] = WORD.sub(_ticked, line)


def unlink_parameters(lines: list[str], words: dict[str, str]) -> None:
    """Write the names of a function's own parameters as literals, also where a property has one."""
    for i, line in enumerate(lines):
        lines[i] = re.sub(
            r"(?<!`)`(\w+)`(?!`)",
            lambda name: f"``{name[1]}``" if name[1] in words else name[0],
            line,
        )


def _ticked(word: re.Match[str]) -> str:
    return f"`{word[0]}`" if word[0] in THINGS else word[0]


def number_references(lines: list[str]) -> None:
    """Write references as a list: footnotes of several docstrings on a page share numbers.

    An initial at the start of a line is no number of a list.
    """
    for title, first, end in sections(lines):
        if title == "References":
            for i in range(first, end):
                line = re.sub(r"^\.\. (\[\d\] )", r"* \1", lines[i])
                line = re.sub(r"^   (?=\S)", "  ", line)
                lines[i] = re.sub(r"^(?=[A-Z]\. )", r"\\", line)
    lines[:] = [re.sub(r"(?<=\s)\[(\d)\]_", r"[\1]", line) for line in lines]


def add_result(lines: list[str], thing: type) -> None:
    """Name the methods that every result has, and its picture, before the first section."""
    text = "It has the :ref:`methods of every result <every-result>`"
    with contextlib.suppress(ModelError):  # no picture of it
        text += f"; ``plot()`` is `{PLACES[plotting_function(thing.__name__).__name__]}`"
    found = sections(lines)
    place = found[0][1] - 2 if found else len(lines)
    lines[place:place] = ["", f"{text}.", ""]


def escape_bars(lines: list[str]) -> None:
    """Escape the bars of absolute values, which are a markup of RST; examples have none."""
    found = sections(lines)
    last = next((first for title, first, _ in found if title == "Examples"), len(lines))
    for i, line in enumerate(lines[:last]):
        parts = re.split(r"(``.*?``|`.*?`)", line)
        parts[::2] = [re.sub(r"\|([^|]+)\|", r"\\|\1\\|", part) for part in parts[::2]]
        lines[i] = "".join(parts)


def process(
    _app: Sphinx, what: str, _name: str, thing: object, _options: object, lines: list[str]
) -> None:
    """Change a docstring before napoleon reads it."""
    number_references(lines)
    escape_bars(lines)
    if isinstance(thing, ModuleType):
        return
    if isinstance(thing, type) or inspect.isroutine(thing):
        words = types_of(thing)
        add_types(lines, words)
        if not isinstance(thing, type):
            unlink_parameters(lines, words)
    if isinstance(thing, type) and issubclass(thing, Result):
        add_result(lines, thing)
    if isinstance(thing, Status):
        lines[:] = [thing.advice, ""]
    if what in {"attribute", "data", "property"} and lines:  # no type stands before a colon there
        lines[0] = lines[0].replace(":", COLON)


def restore(
    _app: Sphinx, _what: str, _name: str, _thing: object, _options: object, lines: list[str]
) -> None:
    """Put back what napoleon was not to read."""
    lines[:] = [line.replace(COLON, ":") for line in lines]


def show_signature(
    _app: Sphinx,
    what: str,
    _name: str,
    thing: object,
    _options: object,
    signature: str | None,
    result: str | None,
) -> tuple[str | None, str | None]:
    """Show no signature of a class that users do not call: of a result, and of an enumeration."""
    if what == "class" and isinstance(thing, type):
        text = inspect.getdoc(thing) or ""
        made = "\nAttributes\n---" in text and "\nParameters\n---" not in text
        if made or issubclass(thing, Enum | tuple):
            return "", None
    if signature:
        names = vars(sys.modules[getattr(thing, "__module__", "rocksteady")])
        signature = re.sub(
            r"(?<==)_?[A-Z][A-Z_0-9]+\b", lambda name: repr(names.get(name[0], name[0])), signature
        )
        signature = re.sub(r"<class '([\w.]+)'>", r"\1", signature).replace("<factory>", "...")
    return signature, result


def skip(
    _app: Sphinx, _what: str, name: str, member: object, skipped: bool, _options: object
) -> bool | None:
    """Leave out what is explained once for all results, and keep members of enumerations."""
    if isinstance(member, Enum):
        return False
    if isinstance(member, type):  # the default of a field
        return True
    if name in COMMON and not skipped:
        text = getattr(member, "__doc__", None)
        return text is None or text == getattr(Result, name).__doc__ or name == "describe"
    return None


# ----------------------------------------------------------------------------------------- targets


def register(app: Sphinx, domain: str, kind: str, content: addnodes.desc_content) -> None:
    """Make the fields of a class targets, and keep its members out of the page's contents."""
    parent = content.parent
    signature = parent[0] if isinstance(parent, addnodes.desc) else None
    if domain != "py" or not isinstance(signature, addnodes.desc_signature):
        return
    if signature["class"]:
        parent["no-contents-entry"] = True
        add_type_of_result(signature)
    if kind not in {"class", "exception"}:
        return
    python = app.env.domains.python_domain
    name = f"rocksteady.{PLACES[signature['fullname']]}"
    for field in content.findall(nodes.field):
        if field.parent.parent is content and field[0].astext() in {"Parameters", "Attributes"}:
            for strong in field.findall(nodes.strong):
                if isinstance(strong.parent, nodes.paragraph) and strong.parent.index(strong) == 0:
                    _register_fields(python, name, strong)
    if issubclass(THINGS[signature["fullname"]], Result):
        for member in COMMON:
            _note(python, f"{name}.{member}", "method", signature["ids"][0])


def add_type_of_result(signature: addnodes.desc_signature) -> None:
    """Write the type of a property, or of what a method returns, into its signature."""
    name, _, member = signature["fullname"].rpartition(".")
    value = inspect.getattr_static(THINGS[name], member, None)
    getter = getattr(value, "fget", None) or getattr(value, "func", None)
    words = type_of_result(getter or value)
    if words not in {"", "any value"}:
        mark = ": " if getter else " → "
        signature += addnodes.desc_annotation(mark, mark, *type_nodes(words))


def type_nodes(words: str) -> list[nodes.Node]:
    """Return a type in words as nodes, with links to public classes."""
    found: list[nodes.Node] = []
    for i, part in enumerate(re.split(r"`+", words)):
        if part in PLACES and i % 2:
            target = f"rocksteady.{PLACES[part]}"
            found.append(
                addnodes.pending_xref(
                    part, nodes.inline(part, part), refdomain="py", reftype="obj", reftarget=target
                )
            )
        elif part:
            found.append(nodes.inline(part, part))
    return found


def _register_fields(python: PythonDomain, name: str, strong: nodes.strong) -> None:
    """Make each field of a list a target; properties have one, where they are documented."""
    fields = types_of(THINGS[name.rpartition(".")[2]])
    for member in strong.astext().split(", "):
        target = f"{name}.{member}"
        if member in fields and target not in python.objects:
            strong["ids"].append(target)
            _note(python, target, "attribute", target)


def _note(python: PythonDomain, name: str, kind: str, place: str) -> None:
    """Note a target that the search of the site leaves out."""
    if name not in python.objects:
        python.note_object(name, kind, place, aliased=True)


def setup(app: Sphinx) -> dict[str, bool]:
    """Connect the changes to docstrings."""
    app.add_role("name", name_role)
    app.connect("autodoc-process-docstring", process, priority=400)
    app.connect("autodoc-process-docstring", restore, priority=600)
    app.connect("autodoc-process-signature", show_signature)
    app.connect("autodoc-skip-member", skip)
    app.connect("object-description-transform", register)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
