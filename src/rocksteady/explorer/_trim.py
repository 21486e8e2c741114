"""A WebAssembly module with some of its entries: what no entry reaches is emptied.

Functions keep their numbers, so that nothing has to be renumbered: a function that no kept entry
reaches gets a body of three bytes, and its export goes.  The format is that of the WebAssembly core
specification 2.0, section 5.
"""

from collections.abc import Iterator

from rocksteady.explorer.module import BEGINS

FUNCTION, EXPORT, ELEMENT, CODE, IMPORT = 3, 7, 9, 10, 2
"""Numbers of sections."""
EMPTY = b"\x03\x00\x00\x0b"
"""A body without locals: unreachable, end."""
_NONE, _ONE, _TWO, _BLOCK, _TABLE, _SELECT, _BYTE, _F32, _F64 = range(9)
_FORMS = {
    **dict.fromkeys((0x02, 0x03, 0x04), _BLOCK),
    **dict.fromkeys((0x0C, 0x0D, 0x10, 0xD0, 0xD2, *range(0x20, 0x27), 0x41, 0x42), _ONE),
    **dict.fromkeys((0x11, *range(0x28, 0x3F)), _TWO),
    0x0E: _TABLE,
    0x1C: _SELECT,
    0x3F: _BYTE,
    0x40: _BYTE,
    0x43: _F32,
    0x44: _F64,
}
"""Immediates of the instructions that have any."""
_BULK = {8: 2, 9: 1, 10: 2, 11: 1, 12: 2, 13: 1, 14: 2, 15: 1, 16: 1, 17: 1}
"""Numbers after an instruction of bulk memory."""
CALL, CALL_INDIRECT, REFERENCE, BULK, VECTOR = 0x10, 0x11, 0xD2, 0xFC, 0xFD


def trimmed(module: bytes, entries: frozenset[str]) -> bytes:
    """Return a module that has the exports named, with memory and what allocates in it.

    Parameters
    ----------
    module
        A module of this package.
    entries
        Names of the kernels that are kept; memory and what allocates in it always are.
    """
    sections = list(_sections(module))
    contents = dict(sections)
    exports = list(_exports(contents[EXPORT]))
    kept = [
        (raw, kind, index)
        for name, kind, index, raw in exports
        if kind != 0 or not name.startswith("rs_") or name.removeprefix("rs_") in entries
    ]
    imported = _count(contents.get(IMPORT, b"\x00"))
    bodies = list(_bodies(contents[CODE]))
    waiting = [index for _, kind, index in kept if kind == 0]
    if ELEMENT in contents:  # any function of a table may be called
        waiting += range(imported, imported + len(bodies))
    reached: set[int] = set()
    while waiting:
        index = waiting.pop()
        if index >= imported and index not in reached:
            reached.add(index)
            waiting += _called(bodies[index - imported])
    code = [
        _number(len(body)) + body if imported + place in reached else EMPTY
        for place, body in enumerate(bodies)
    ]
    changed = contents | {
        EXPORT: _number(len(kept)) + b"".join(raw for raw, _, _ in kept),
        CODE: _number(len(code)) + b"".join(code),
    }
    made = bytearray(BEGINS)
    for number, content in sections:
        inside = changed[number] if number else content  # of the custom ones there are several
        made += bytes([number]) + _number(len(inside)) + inside
    return bytes(made)


def _sections(module: bytes) -> Iterator[tuple[int, bytes]]:
    """Yield number and content of each section."""
    at = len(BEGINS)
    while at < len(module):
        number = module[at]
        size, at = _read(module, at + 1)
        yield number, module[at : at + size]
        at += size


def _exports(content: bytes) -> Iterator[tuple[str, int, int, bytes]]:
    """Yield name, kind and index of each export, and its bytes."""
    count, at = _read(content, 0)
    for _ in range(count):
        begin = at
        size, at = _read(content, at)
        name = content[at : at + size].decode("utf-8")
        kind = content[at + size]
        index, at = _read(content, at + size + 1)
        yield name, kind, index, content[begin:at]


def _bodies(content: bytes) -> Iterator[bytes]:
    """Yield the functions of a section of code."""
    count, at = _read(content, 0)
    for _ in range(count):
        size, at = _read(content, at)
        yield content[at : at + size]
        at += size


def _called(body: bytes) -> Iterator[int]:
    """Yield the functions that a function calls or refers to."""
    groups, at = _read(body, 0)
    for _ in range(groups):
        _, at = _read(body, at)
        at += 1
    while at < len(body):
        code = body[at]
        at += 1
        form = _FORMS.get(code, _NONE)
        if code in (CALL, REFERENCE):
            index, _ = _read(body, at)
            yield index
        if code == BULK:
            code, at = _read(body, at)
            for _ in range(_BULK.get(code, 0)):
                _, at = _read(body, at)
        elif code == VECTOR:
            at = _after_vector(body, at)
        elif form in (_ONE, _BLOCK):
            _, at = _read(body, at)
        elif form == _TWO:
            _, at = _read(body, at)
            _, at = _read(body, at)
        elif form in (_TABLE, _SELECT):
            count, at = _read(body, at)
            for _ in range(count + (form == _TABLE)):
                _, at = _read(body, at)
        elif form != _NONE:
            at += {_BYTE: 1, _F32: 4, _F64: 8}[form]


def _after_vector(body: bytes, at: int) -> int:
    """Return where an instruction on vectors ends."""
    code, at = _read(body, at)
    if code <= 11 or 84 <= code <= 93:
        _, at = _read(body, at)
        _, at = _read(body, at)
        return at + (84 <= code <= 91)
    if code in (12, 13):
        return at + 16
    return at + (21 <= code <= 34)


def _count(content: bytes) -> int:
    """Return how many functions a section of imports has; the package's modules have none."""
    return _read(content, 0)[0]


def _read(content: bytes, at: int) -> tuple[int, int]:
    """Return a number in LEB128, without its sign, and where it ends."""
    value = shift = 0
    while True:
        byte = content[at]
        at += 1
        value |= (byte & 0x7F) << shift
        shift += 7
        if byte < 0x80:
            return value, at


def _number(value: int) -> bytes:
    """Return a number in LEB128."""
    digits = bytearray()
    while True:
        value, low = value >> 7, value & 0x7F
        if not value:
            return bytes([*digits, low])
        digits.append(low | 0x80)
