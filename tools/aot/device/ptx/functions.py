"""A function of PTX in C: each instruction one statement, in the same order."""

import math
import re
import struct
from collections import Counter
from collections.abc import Callable

from tools.aot.device.ptx.forms import EXACT_FUSED, FORMS, FUSED, MINUS_TWO, why_refused
from tools.aot.device.ptx.text import Function, Module, PtxError, Statement, Variable, variable

_DECLARED = re.compile(r"\.(pred|[busf](?:16|32|64))\s+(.*)")
_OPERANDS = re.compile(r"\{[^}]*\}|\[[^\]]*\]|\([^)]*\)|[^,\s]+")
_ADDRESS = re.compile(r"\[\s*(%?[$\w]+)\s*(?:\+\s*(-?\d+))?\s*\]$")
_ACCESS = re.compile(
    r"(?P<way>ld|st)(?:\.(?P<space>global|local|param|const))?(?P<nc>\.nc)?"
    r"(?:\.v(?P<count>[24]))?\.(?P<kind>[bus](?:8|16|32|64)|f64)$"
)
_ATOMIC = re.compile(
    r"atom(?:\.relaxed)?(?:\.(?:cta|gpu|sys))?(?:\.global)?\.add\.u(?P<bits>32|64)$"
)
_SPACES = {None: "GENERIC", "global": "GLOBAL", "local": "LOCAL", "const": "READ_ONLY"}
_IGNORED = {".pragma", ".loc", ".file"}


def c_name(name: str) -> str:
    """Return what a name of PTX is in C."""
    return name.replace("$", "_d_")


def _v(space: Variable) -> str:
    return f"v_{c_name(space.name)}"


def declaration(function: Function) -> str:
    """Return what C is told of a function."""
    name = c_name(function.name)
    if function.entry:
        return f"PUBLIC int32_t {name}(int64_t *cells)"
    taken = [f"uint8_t *{_v(each)}" for each in function.returned]
    taken += [f"const uint8_t *{_v(each)}" for each in function.taken]
    return f"static void f_{name}({', '.join(taken) or 'void'})"


class Body:
    """A function while it is translated.

    Parameters
    ----------
    function
        The function.
    module
        Its module.
    blocks
        Instructions of each block of the module so far, to which this function's are added.
    """

    def __init__(
        self, function: Function, module: Module, blocks: list[Counter[str]] | None = None
    ) -> None:
        self._function, self._module = function, module
        self._blocks: list[Counter[str]] = [] if blocks is None else blocks
        self._ranges: dict[str, tuple[int, int]] = {}
        self._scopes: list[dict[str, int]] = [{}]
        self._spaces: list[dict[str, Variable]] = [
            {each.name: each for each in (*function.returned, *function.taken)}
        ]
        self._used: dict[str, int] = {}
        self._known: dict[tuple[str, str], str] = {}
        self._depot: Variable | None = None
        self._targets: dict[str, list[str]] = {}
        self._line = function.line
        self._special: dict[str, Callable[[Statement], str]] = {
            "bra": self._branch,
            "brx.idx": self._choice,
            "call": self._call,
            "ret": self._return,
            "exit": self._return,
            "{": self._begun,
            "}": self._ended,
            ":": self._label,
            ".reg": self._registers,
            ".param": self._parameter,
            ".local": self._memory,
            ".branchtargets": self._no_statement,
        }

    def text(self) -> str:
        """Return the function in C.

        Raises
        ------
        PtxError
            If a statement is none that is known.
        """
        self._read_targets()
        lines = [self._new_block()]
        for statement in self._function.body:
            self._line = statement.line
            written = self._written(statement)
            if written:
                if statement.guard:
                    written = f"if ({self._guard(statement.guard)}) {written}"
                lines.append(written)
        self._line = self._function.line
        body = "\n".join(lines)
        head = [declaration(self._function), "{"]
        if self._function.entry:
            head += self._cells()
        for width in (1, 16, 32, 64):
            names = sorted(name for name, bits in self._used.items() if bits == width)
            if names:
                listed = names if width == 1 else [f"REGISTER({name})" for name in names]
                head.append(f"bits{width} {', '.join(listed)};")
        if self._depot is not None:
            head.append(f"DEPOT({self._depot.align}, {self._depot.size})")
        return "\n".join((*head, body, self._return(None), "}"))

    def _cells(self) -> list[str]:
        taken = self._function.taken
        if len(taken) != 1 or taken[0].size != 8:
            raise PtxError(self._line, f"{self._function.name} must take one address")
        return [
            "uint64_t address = (uint64_t)(uintptr_t)cells;",
            f"const uint8_t *{_v(taken[0])} = (const uint8_t *)&address;",
            "ENTER(address)",
        ]

    def _read_targets(self) -> None:
        for statement in self._function.body:
            if statement.opcode == ".branchtargets":
                name, *labels = statement.operands.replace(",", " ").split()
                self._targets[name] = labels

    def _new_block(self) -> str:
        self._blocks.append(Counter())
        return f"BLOCK({len(self._blocks) - 1})"

    # ------------------------------------------------------------------------------ statements

    def _written(self, statement: Statement) -> str:
        opcode = statement.opcode
        if opcode in _IGNORED:
            return ""
        base = opcode.removesuffix(".uni")
        if opcode[0] not in ".:{}":
            self._blocks[-1][base] += 1
        special = self._special.get(base)
        if special is not None:
            return special(statement)
        operands = _OPERANDS.findall(statement.operands)
        if opcode.startswith(("ld", "st")):
            return self._access(opcode, operands)
        if opcode.startswith("mov.") and any(each[0] == "{" for each in operands):
            return self._packed(opcode, operands)
        if opcode.startswith("atom"):
            return self._atomic(opcode, operands)
        form = FORMS.get(opcode)
        if opcode == FUSED and operands[2:3] == [MINUS_TWO]:
            form = EXACT_FUSED
        if form is None:
            raise PtxError(self._line, why_refused(opcode))
        if len(operands) != len(form.kinds):
            raise PtxError(
                self._line, f"{opcode} has {len(operands)} operands, it takes {len(form.kinds)}"
            )
        written = [
            self._target(form.kinds[0], operands[0]),
            *(self._value(*pair) for pair in zip(form.kinds[1:], operands[1:], strict=True)),
        ]
        return form.text.format(*written, line=self._line)

    def _label(self, statement: Statement) -> str:
        return f"L_{c_name(statement.operands)}: ; {self._new_block()}"

    def _branch(self, statement: Statement) -> str:
        jump = f"goto L_{c_name(statement.operands.strip())};"
        if not statement.guard:
            return jump
        return f"{jump}\n{self._new_block()}"

    def _choice(self, statement: Statement) -> str:
        chosen, name = _OPERANDS.findall(statement.operands)
        if name not in self._targets:
            raise PtxError(self._line, f"{name} is no list of labels")
        cases = "".join(
            f" case {n}: goto L_{c_name(label)};" for n, label in enumerate(self._targets[name])
        )
        return f"switch ({self._value('u32', chosen)}) {{{cases} default: __builtin_trap(); }}"

    def _call(self, statement: Statement) -> str:
        operands = _OPERANDS.findall(statement.operands)
        at = 1 if operands and operands[0][0] == "(" else 0
        returned = operands[0].strip("() ").split(",") if at else []
        if len(operands) <= at or operands[at] not in self._module.functions:
            raise PtxError(self._line, f"call {statement.operands[:80]}: no function of this file")
        called = self._module.functions[operands[at]]
        taken = operands[at + 1].strip("() ").split(",") if len(operands) > at + 1 else []
        if len(operands) > at + 2 or called.entry:
            raise PtxError(self._line, f"call {statement.operands[:80]}: not a plain call")
        given = [self._space(each.strip()) for each in (*returned, *taken) if each.strip()]
        wanted = (*called.returned, *called.taken)
        if [each.size for each in given] != [each.size for each in wanted]:
            raise PtxError(self._line, f"{called.name} takes parameters of other sizes")
        return f"f_{c_name(called.name)}({', '.join(map(_v, given))});"

    def _return(self, _: Statement | None) -> str:
        leave = "LEAVE " if self._depot is not None else ""
        return f"{{ {leave}return{' 0' if self._function.entry else ''}; }}"

    def _access(self, opcode: str, operands: list[str]) -> str:
        found = _ACCESS.match(opcode)
        if found is None or len(operands) != 2:
            raise PtxError(self._line, why_refused(opcode))
        kind = found["kind"].replace("f64", "b64")
        store, space = found["way"] == "st", found["space"]
        place, vector = operands if store else operands[::-1]
        values = self._parts(vector, int(found["count"] or 1))
        bits = int(kind[1:])
        size = bits // 8 * len(values)
        if space == "param":
            where = f"({self._of_space(place, size, store)})"
        else:
            if store and (found["nc"] or space == "const"):
                raise PtxError(self._line, f"{opcode} writes what is only read")
            name = "READ_ONLY" if found["nc"] else _SPACES[space]
            where = f"ADDRESS({self._address(place)}, {size}, {name}, {int(store)}, {self._line})"
        memory = f"m_{'s' if kind[0] == 's' else 'b'}{bits}"
        if len(values) == 1:
            cell = f"*({memory} *){where}"
            if store:
                return f"{cell} = {self._value(f'b{bits}+', values[0])};"
            return f"{self._target(f'{kind}+', values[0])} = {cell};"
        lines = []
        for n, each in enumerate(values):
            if store:
                lines.append(f"at[{n}] = {self._value(f'b{bits}+', each)};")
            elif each != "_":
                lines.append(f"{self._target(f'{kind}+', each)} = at[{n}];")
        return f"{{ {memory} *at = {where}; {' '.join(lines)} }}"

    def _packed(self, opcode: str, operands: list[str]) -> str:
        """Return a move that takes a register apart, or puts one together."""
        width = int(opcode.rpartition(".")[2][1:])
        target, source = operands
        apart = target[0] == "{"
        values = (target if apart else source).strip("{} ").split(",")
        part = width // len(values)
        if part * len(values) != width or part not in {16, 32}:
            raise PtxError(self._line, f"{opcode} of {len(values)} parts is not known")
        if apart:
            lines = [
                f"{self._target(f'b{part}', each.strip())} = (uint{part}_t)(whole >> {n * part});"
                for n, each in enumerate(values)
                if each.strip() != "_"
            ]
            return f"{{ uint64_t whole = {self._value(f'b{width}', source)}; {' '.join(lines)} }}"
        pieces = [
            f"(uint64_t){self._value(f'b{part}', each.strip())} << {n * part}"
            for n, each in enumerate(values)
        ]
        return f"{self._target(f'b{width}', target)} = {' | '.join(pieces)};"

    def _atomic(self, opcode: str, operands: list[str]) -> str:
        found = _ATOMIC.match(opcode)
        if found is None or len(operands) != 3:
            raise PtxError(self._line, why_refused(opcode))
        bits = int(found["bits"])
        where = f"ADDRESS({self._address(operands[1])}, {bits // 8}, GENERIC, 1, {self._line})"
        added = f"atomic_add_{bits}({where}, {self._value(f'u{bits}', operands[2])});"
        return added if operands[0] == "_" else f"{self._target(f'u{bits}', operands[0])} = {added}"

    # ------------------------------------------------------------------------- declarations

    def _begun(self, _: Statement) -> str:
        self._scopes.append({})
        self._spaces.append({})
        return "{"

    def _ended(self, _: Statement) -> str:
        self._scopes.pop()
        self._spaces.pop()
        self._known = {}
        return "}"

    def _registers(self, statement: Statement) -> str:
        found = _DECLARED.match(statement.operands)
        written = ""
        if found is None:
            raise PtxError(self._line, f".reg {statement.operands}: not a register that is known")
        kind = found[1]
        if kind[0] == "f" and kind != "f64":
            raise PtxError(self._line, f".reg .{kind}: numbers of other precision are not known")
        width = 1 if kind == "pred" else int(kind[1:])
        for each in found[2].split(","):
            name, several, count = each.strip().rstrip(">").partition("<")
            if len(self._scopes) > 1:
                if several:
                    raise PtxError(self._line, "a scope declares a range of registers")
                self._scopes[-1][name] = width
                self._known = {}
                written += f"bits{width} {c_name(name.lstrip('%'))};"
            elif several:
                self._ranges[name] = (width, int(count))
            else:
                self._scopes[0][name] = width
        return written

    def _parameter(self, statement: Statement) -> str:
        found = variable(self._line, f".param {statement.operands}")
        self._spaces[-1][found.name] = found
        return f"uint8_t {_v(found)}[{found.size}] __attribute__((aligned(16)));"

    def _memory(self, statement: Statement) -> str:
        if self._depot is not None or len(self._scopes) > 1:
            raise PtxError(self._line, "a function has one stack memory")
        self._depot = variable(self._line, f".local {statement.operands}")
        return ""

    def _no_statement(self, _: Statement) -> str:
        return ""

    # ----------------------------------------------------------------------------- operands

    def _register(self, name: str) -> tuple[str, int]:
        """Return what a register is called in C, and its bits."""
        for scope in self._scopes[:0:-1]:
            if name in scope:
                return c_name(name.lstrip("%")), scope[name]
        width = self._scopes[0].get(name)
        if width is None:
            stem = name.rstrip("0123456789")
            width, count = self._ranges.get(stem, (0, 0))
            if not width or int(name[len(stem) :] or count) >= count:
                raise PtxError(self._line, f"{name} is not a register of this function")
        written = name.lstrip("%")
        self._used[written] = width
        return written, width

    def _guard(self, guard: str) -> str:
        return (
            f"{guard[0]}{self._value('p', guard[1:])}"
            if guard[0] == "!"
            else self._value("p", guard)
        )

    def _target(self, kind: str, name: str) -> str:
        """Return what an instruction assigns to."""
        if name[0] != "%" and not any(name in scope for scope in self._scopes):
            raise PtxError(self._line, f"{name} is not a register")
        return self._of_register(kind, name, target=True)

    def _of_register(self, kind: str, name: str, *, target: bool) -> str:
        written, width = self._register(name)
        plain = kind.rstrip("+")
        bits = 1 if plain == "p" else int(plain[1:])
        if width != bits and not (kind[-1] == "+" and width > bits > 1):
            raise PtxError(self._line, f"{name} has {width} bits, the instruction takes {bits}")
        if bits == 1:
            return written
        part = f"{written}.{plain[0] if plain[0] in 'fs' else 'u'}"
        if width > bits and not target:
            return f"({'u' if plain[0] != 's' else ''}int{bits}_t){part}"
        return part

    def _value(self, kind: str, text: str) -> str:
        """Return what an instruction reads."""
        written = self._known.get((kind, text))
        if written is None:
            written = self._known[kind, text] = self._fresh_value(kind, text)
        return written

    def _fresh_value(self, kind: str, text: str) -> str:
        if text[0] == "%" or any(text in scope for scope in self._scopes):
            return self._of_register(kind, text, target=False)
        plain = kind.rstrip("+")
        if plain == "p":
            if text not in {"0", "1", "-1"}:
                raise PtxError(self._line, f"{text} is no predicate")
            return str(int(text != "0"))
        bits = int(plain[1:])
        if text.startswith(("0d", "0D")) and bits == 64:
            pattern = int(f"0x{text[2:]}", 16)
            if plain[0] == "f":
                return double(pattern)
            return f"UINT64_C({pattern:#x})"
        if plain == "f64":
            raise PtxError(self._line, f"{text} is not a double")
        if re.fullmatch(r"-?(0x[0-9a-fA-F]+|\d+)U?", text):
            number = int(text.rstrip("U"), 0)
            if not -(1 << bits - 1) <= number < 1 << bits:
                raise PtxError(self._line, f"{text} has more than {bits} bits")
            sign = "" if plain[0] == "s" else "u"
            return f"(({sign}int{bits}_t)UINT64_C({number % (1 << bits)}))"
        if plain == "a64":
            return self._place(text)
        raise PtxError(self._line, f"{text} is not a value that is known")

    def _place(self, name: str) -> str:
        if self._depot is not None and name == self._depot.name:
            return "(uint64_t)(uintptr_t)depot"
        if name in self._module.tables:
            return f"(uint64_t)(uintptr_t)g_{c_name(name)}"
        if not self._function.entry and name in self._spaces[0]:
            return f"(uint64_t)(uintptr_t){_v(self._spaces[0][name])}"
        raise PtxError(self._line, f"{name} is not a value that is known")

    def _address(self, place: str) -> str:
        found = _ADDRESS.match(place)
        if found is None:
            raise PtxError(self._line, f"{place} is not an address that is known")
        where = self._value("a64", found[1])
        return f"{where} + ((uint64_t)INT64_C({found[2]}))" if found[2] else where

    def _space(self, name: str) -> Variable:
        for scope in reversed(self._spaces):
            if name in scope:
                return scope[name]
        raise PtxError(self._line, f"{name} is not a parameter")

    def _of_space(self, place: str, size: int, store: bool) -> str:
        """Return where a parameter is.

        LLVM takes the address of a function's parameter where it loads one of two: the assembler
        puts both on the stack then.  The reference says that the address is one of the stack.
        """
        found = _ADDRESS.match(place)
        if found is None:
            raise PtxError(self._line, f"{place} is not a parameter")
        if found[1][0] == "%" and not store and not found[2] and not self._function.entry:
            return f"AT({self._value('a64', found[1])})"
        space, offset = self._space(found[1]), int(found[2] or 0)
        if offset < 0 or offset + size > space.size or offset % size:
            raise PtxError(self._line, f"{place} is not inside {space.name}")
        return f"{_v(space)} + {offset}"

    def _parts(self, text: str, count: int) -> list[str]:
        values = [each.strip() for each in text.strip("{} ").split(",")]
        if len(values) != count:
            raise PtxError(self._line, f"{text} has {len(values)} parts, not {count}")
        return values


def double(pattern: int) -> str:
    """Return a double of some bits in C."""
    (number,) = struct.unpack("<d", pattern.to_bytes(8, "little"))
    if math.isfinite(number):
        return f"({number.hex()})"
    return f"((bits64){{.u = UINT64_C({pattern:#x})}}).f"
