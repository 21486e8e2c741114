"""What can be said of PTX without running it: its stack, its loops, and registers never set."""

import re
from collections.abc import Iterable
from dataclasses import dataclass, field

from tools.aot.device.ptx.text import Function, Module, PtxError, Statement, variable

MOST_STACK = 512 * 1024
"""Bytes of memory that a thread of a device can have for itself."""
_REGISTER = re.compile(r"%[A-Za-z]\w*")
_FIRST = re.compile(r"\s*(\{[^}]*\}|[^,\s]+)(.*)", re.DOTALL)
_CALLED = re.compile(r"(?:\([^)]*\)\s*,\s*)?([$\w]+)")
_NO_TARGET = ("st", "bra", "brx", "call", "ret", "exit")


@dataclass(frozen=True)
class Unset:
    """A register that is read where no way to it need have set it.

    Attributes
    ----------
    function, register, line
        Where it is read.
    """

    function: str
    register: str
    line: int


@dataclass(frozen=True)
class Facts:
    """What is known of a PTX file.

    Attributes
    ----------
    stack
        Bytes of stack memory that PTX declares, along the deepest chain of calls.  The assembler
        adds what it spills.
    unset
        Registers that may be read before they are set.
    parameters
        Lines that load a parameter by an address in a register, for which the assembler puts the
        parameters on the stack.
    endless
        Lines of labels from which no way leads to a return.
    atomics, votes
        Lines of atomic operations and of votes of a warp.
    """

    stack: int
    unset: tuple[Unset, ...]
    parameters: tuple[int, ...]
    endless: tuple[int, ...]
    atomics: tuple[int, ...]
    votes: tuple[int, ...]


@dataclass(slots=True)
class _Block:
    line: int
    statements: list[Statement] = field(default_factory=list)
    after: list[int] = field(default_factory=list)
    before: list[int] = field(default_factory=list)
    ends: bool = False


def facts(module: Module) -> Facts:
    """Return what is known of a PTX file.

    Raises
    ------
    PtxError
        If functions call each other in a circle, or an entry takes more stack than a device has.
    """
    statements = [each for f in module.functions.values() for each in f.body]
    stack = max((stack_of(f, module) for f in module.functions.values() if f.entry), default=0)
    if stack > MOST_STACK:
        raise PtxError(1, f"{stack} bytes of stack: a thread of a device has {MOST_STACK}")
    unset: list[Unset] = []
    endless: list[int] = []
    for function in module.functions.values():
        blocks = _blocks(function)
        unset += _unset(function, blocks)
        endless += _endless(blocks)

    def lines(pattern: str) -> tuple[int, ...]:
        found = re.compile(pattern)
        texts = ((each.line, f"{each.opcode} {each.operands}") for each in statements)
        return tuple(line for line, text in texts if found.match(text))

    return Facts(
        stack,
        tuple(unset),
        lines(r"ld\.param.*\[\s*%"),
        tuple(endless),
        lines(r"(atom|red)\."),
        lines(r"(redux|vote|match|shfl|bar)\."),
    )


def stack_of(function: Function, module: Module, above: tuple[str, ...] = ()) -> int:
    """Return the bytes of stack of a function and of what it calls; raise if that is itself."""
    if function.name in above:
        raise PtxError(function.line, f"{function.name} calls itself")
    memory = deepest = 0
    for each in function.body:
        if each.opcode == ".local":
            memory += variable(each.line, f".local {each.operands}").size
        elif each.opcode.startswith("call"):
            found = _CALLED.match(each.operands.strip())
            called = module.functions.get(found[1]) if found else None
            if called is not None:
                deepest = max(deepest, stack_of(called, module, (*above, function.name)))
    return memory + deepest


def _blocks(function: Function) -> list[_Block]:
    """Return the blocks of a function, and which follow each."""
    blocks = [_Block(function.line)]
    places: dict[str, int] = {}
    lists: dict[str, list[str]] = {}
    jumps: list[tuple[int, str]] = []
    for each in function.body:
        base = each.opcode.removesuffix(".uni")
        here = len(blocks) - 1
        if base == ":":
            if not blocks[here].ends:
                blocks[here].after.append(here + 1)
            places[each.operands] = here + 1
            blocks.append(_Block(each.line))
        elif base == ".branchtargets":
            name, *labels = each.operands.replace(",", " ").split()
            lists[name] = labels
        elif base[0] not in ".{}":
            blocks[here].statements.append(each)
            if base in {"bra", "brx.idx", "ret", "exit"}:
                target = each.operands.rpartition(",")[2].strip()
                jumps += [(here, target)] if base in {"bra", "brx.idx"} else []
                blocks[here].ends = not each.guard
                if each.guard:
                    blocks[here].after.append(here + 1)
                blocks.append(_Block(each.line))
    for here, target in jumps:
        blocks[here].after += [places[label] for label in lists.get(target, [target])]
    for here, block in enumerate(blocks):
        for after in block.after:
            blocks[after].before.append(here)
    return blocks


def _used(statement: Statement) -> tuple[list[str], list[str]]:
    """Return the registers that a statement reads and those that it sets."""
    guard = _REGISTER.findall(statement.guard)
    if statement.opcode.startswith(_NO_TARGET):
        return guard + _REGISTER.findall(statement.operands), []
    found = _FIRST.match(statement.operands)
    if found is None:
        return guard, []
    return guard + _REGISTER.findall(found[2]), _REGISTER.findall(found[1])


def _unset(function: Function, blocks: list[_Block]) -> list[Unset]:
    """Return the registers that may be read before they are set: bit sets, block by block."""
    numbers: dict[str, int] = {}

    def bit(name: str) -> int:
        return 1 << numbers.setdefault(name, len(numbers))

    used = [[_used(each) for each in block.statements] for block in blocks]
    for pairs in used:
        for read, written in pairs:
            for name in (*read, *written):
                bit(name)
    every = (1 << len(numbers)) - 1
    sets = [
        _union(
            bit(name)
            for (_, written), each in zip(pairs, block.statements, strict=True)
            for name in written
            if not each.guard
        )
        for pairs, block in zip(used, blocks, strict=True)
    ]
    out = [every] * len(blocks)
    start = [0] + [every] * (len(blocks) - 1)
    waiting = list(range(len(blocks)))
    while waiting:
        here = waiting.pop(0)
        known = every if here else 0
        for before in blocks[here].before:
            known &= out[before]
        start[here] = known
        after = known | sets[here]
        if after != out[here]:
            out[here] = after
            waiting += [each for each in blocks[here].after if each not in waiting]
    found = []
    for here, block in enumerate(blocks):
        known = start[here]
        for (read, written), each in zip(used[here], block.statements, strict=True):
            found += [
                Unset(function.name, name, each.line) for name in read if not known & bit(name)
            ]
            for name in () if each.guard else written:
                known |= bit(name)
    return found


def _union(bits: Iterable[int]) -> int:
    total = 0
    for each in bits:
        total |= each
    return total


def _endless(blocks: list[_Block]) -> list[int]:
    """Return the lines of reachable blocks from which no way leads to a return."""
    reached = _closure(blocks, [0], forwards=True)
    last = len(blocks) - 1
    returns = [
        here
        for here, block in enumerate(blocks)
        if here == last or any(each.opcode[:3] in {"ret", "exi"} for each in block.statements)
    ]
    ending = _closure(blocks, returns, forwards=False)
    return [blocks[here].line for here in sorted(reached - ending) if blocks[here].statements]


def _closure(blocks: list[_Block], start: list[int], *, forwards: bool) -> set[int]:
    found, waiting = set(start), list(start)
    while waiting:
        block = blocks[waiting.pop()]
        for each in block.after if forwards else block.before:
            if each not in found:
                found.add(each)
                waiting.append(each)
    return found
