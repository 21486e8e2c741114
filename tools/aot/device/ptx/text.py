"""Statements of a PTX file: its tables, its functions and what they hold, not yet understood."""

import re
from dataclasses import dataclass, field


class PtxError(Exception):
    """A line of PTX that this translator refuses.

    Parameters
    ----------
    line
        Its number in the file, from 1.
    problem
        What is wrong with it.
    """

    def __init__(self, line: int, problem: str) -> None:
        super().__init__(f"line {line} of the PTX: {problem}")
        self.line = line


@dataclass(frozen=True, slots=True)
class Statement:
    """A statement of a function.

    Attributes
    ----------
    line
        Its number in the file.
    opcode
        The instruction with all its modifiers, or the directive; ``":"`` of a label, ``"{"`` and
        ``"}"`` of a scope.
    operands
        What follows it; of a label its name.
    guard
        Predicate that decides whether it is executed, as ``"%p1"`` or ``"!%p1"``; empty if none.
    """

    line: int
    opcode: str
    operands: str = ""
    guard: str = ""


@dataclass(frozen=True, slots=True)
class Variable:
    """A table of a module, the stack memory of a function, or a parameter.

    Attributes
    ----------
    name, align, size
        Alignment and size are in bytes.
    each
        Bytes of an element.
    content
        What a table begins with, integers and names of tables; zeros follow.
    """

    name: str
    align: int
    size: int
    each: int
    content: tuple[int | str, ...] = ()


@dataclass(slots=True)
class Function:
    """A function or an entry.

    Attributes
    ----------
    line, name
        Where it begins, and what it is called.
    entry
        Whether a launch calls it.
    returned, taken
        Parameters that receive results, and parameters.
    body
        Its statements.
    """

    line: int
    name: str
    entry: bool
    returned: list[Variable]
    taken: list[Variable]
    body: list[Statement] = field(default_factory=list)


@dataclass(slots=True)
class Module:
    """A PTX file.

    Attributes
    ----------
    target
        Architecture, as ``"sm_90"``.
    tables
        Global variables by name.
    functions
        By name, in their order.
    """

    target: str = ""
    tables: dict[str, Variable] = field(default_factory=dict)
    functions: dict[str, Function] = field(default_factory=dict)


_PLAIN = re.compile(r"(?:@(!?%\w+)\s+)?([\w.:]+)(?:\s+([^;]*))?;$")
_LABEL = re.compile(r"([$\w]+):\s*(\.branchtargets\s.*)?$", re.DOTALL)
_VARIABLE = re.compile(
    r"(?:\.visible |\.weak )*\.(?P<space>global|const|local|param) "
    r"(?:\.align (?P<align>\d+) )?\.(?P<kind>[busf])(?P<bits>8|16|32|64) "
    r"(?:\.ptr (?:\.\w+ )?(?:\.align \d+ )?)?(?P<name>[$\w]+)(?:\[(?P<count>\d+)\])?"
    r"(?: = (?P<content>.*))?$"
)
_FUNCTION = re.compile(
    r"(?:\.visible |\.weak )*\.(?P<kind>func|entry) ?(?:\((?P<returned>[^)]*)\) ?)?"
    r"(?P<name>[$\w]+) ?(?:\((?P<taken>[^)]*)\))?(?P<rest>[^(]*)$"
)
_SCOPE = re.compile(r"\{ (.*;) \}$")
_GENERIC = re.compile(r"generic\(([$\w]+)\)$")
_LIMITS = re.compile(r"( ?\.(maxntid|minnctapersm|maxnreg|reqntid) [\d, ]+)*$")


def parsed(ptx: str) -> Module:
    """Return the statements of a PTX file.

    Raises
    ------
    PtxError
        If a line is none of those that LLVM writes for kernels.
    """
    module = Module()
    function: Function | None = None
    depth = 0
    for number, text in _whole_lines(ptx):
        if function is None:
            function = _outside(number, text, module)
        elif text == "{":
            depth += 1
            if depth > 1:
                function.body.append(Statement(number, "{"))
        elif text == "}":
            depth -= 1
            if depth:
                function.body.append(Statement(number, "}"))
            else:
                function = None
        else:
            function.body.append(_inside(number, text))
    if function is not None:
        raise PtxError(function.line, f"{function.name} does not end")
    return module


def variable(line: int, text: str) -> Variable:
    """Return what a declaration declares."""
    found = _VARIABLE.match(" ".join(text.split()))
    if found is None:
        raise PtxError(line, f"{text[:80]!r} is not a declaration that is known")
    each = int(found["bits"]) // 8
    size = each * int(found["count"] or 1)
    content = tuple(
        _initial(line, value.strip(), each)
        for value in (found["content"] or "").strip("{} ").split(",")
        if value
    )
    if len(content) * each > size:
        raise PtxError(line, f"{found['name']} has more values than room")
    return Variable(found["name"], int(found["align"] or each), size, each, content)


def _initial(line: int, value: str, each: int) -> int | str:
    """Return what an element of a table begins with: an integer, or the address of a table."""
    if value.lstrip("-").isdigit():
        return int(value) % (1 << 8 * each)
    address = _GENERIC.match(value)
    if address is None or each != 8:
        raise PtxError(line, f"{value!r} is not an element that is known")
    return address[1]


def _whole_lines(ptx: str) -> list[tuple[int, str]]:
    """Return the lines without comments; what goes on on the next one is joined."""
    lines: list[tuple[int, str]] = []
    begun, first = "", 0
    for number, raw in enumerate(ptx.splitlines(), 1):
        text = raw.partition("//")[0].strip()
        if not text:
            continue
        if "/*" in text:
            raise PtxError(number, "a comment of several lines is not read")
        scope = _SCOPE.match(text)
        if scope is not None and not begun:
            parts = [f"{each.strip()};" for each in scope[1].split(";") if each.strip()]
            lines += [(number, each) for each in ("{", *parts, "}")]
            continue
        if not begun:
            first = number
        if text in {"{", "}"}:
            if begun:
                lines.append((first, begun))
            lines.append((number, text))
            begun = ""
            continue
        begun = f"{begun} {text}" if begun else text
        plain_label = text[-1] == ":" or text.startswith((".version", ".target", ".address_size"))
        if text[-1] == ";" or plain_label:
            lines.append((first, begun))
            begun = ""
    if begun:
        raise PtxError(first, f"{begun[:80]!r} does not end")
    return lines


def _outside(line: int, text: str, module: Module) -> Function | None:
    """Take in a line between functions; return the function that begins there, if one does."""
    word = text.split(maxsplit=1)[0]
    if word == ".version":
        return None
    if word == ".target":
        module.target = text.split()[1].strip(",")
        return None
    if word == ".address_size":
        if text.split()[1] != "64":
            raise PtxError(line, f"{text}: addresses of 64 bits are known")
        return None
    if text[-1] == ";":
        if ".func" in text.split("=", maxsplit=1)[0]:
            if ".extern" in text:
                raise PtxError(line, f"{text[:80]!r}: a function of another module")
            return None  # announced here, defined below
        table = variable(line, text[:-1])
        if ".param" in text or ".local" in text:
            raise PtxError(line, f"{text[:80]!r} stands outside functions")
        module.tables[table.name] = table
        return None
    header = _FUNCTION.match(" ".join(text.split()))
    if header is None or _LIMITS.match(header["rest"]) is None:
        raise PtxError(line, f"{text[:80]!r} does not begin a function that is known")
    returned, taken = (
        [variable(line, each) for each in (header[part] or "").split(",") if each.strip()]
        for part in ("returned", "taken")
    )
    function = Function(line, header["name"], header["kind"] == "entry", returned, taken)
    module.functions[function.name] = function
    return function


def _inside(line: int, text: str) -> Statement:
    """Return a statement of a function."""
    plain = _PLAIN.match(text)
    if plain is not None:
        return Statement(line, plain[2], plain[3] or "", plain[1] or "")
    label = _LABEL.match(text.rstrip(";"))
    if label is None:
        raise PtxError(line, f"{text[:80]!r} is not one statement")
    if label[2]:
        return Statement(line, ".branchtargets", f"{label[1]} {label[2].split(None, 1)[1]}")
    return Statement(line, ":", label[1])
