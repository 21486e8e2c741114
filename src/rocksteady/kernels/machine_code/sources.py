"""The sources of all kernels: a hash of their code, and whether they have changed.

Comments, docstrings and layout do not count, so editing them leaves machine code valid.
"""

import hashlib
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path

from rocksteady.outcomes import Status

NAME = "sources.txt"
"""File beside the libraries: the hash of all bytes that was last seen, and that of their code."""


def sources() -> list[Path]:
    """Return the files of all kernels, in one order wherever they are."""
    return sorted(_root().rglob("*.py"))


@cache
def sources_hash() -> str:
    """Return a hash of what machine code is made of: the kernels, and the codes they end with."""
    _stamps()
    codes = repr([(status.name, status.value) for status in Status])
    contents = [
        (source.relative_to(_root()).as_posix().encode(), source.read_bytes())
        for source in sources()
    ]
    # Parsing takes 0.3 s: the hash of the code is kept beside that of the bytes it belongs to.
    kept = libraries_folder() / NAME
    of_bytes = _digest(codes, contents)
    with suppress(OSError, ValueError):
        known, of_code = kept.read_text("ascii").split()
        if known == of_bytes:
            return of_code
    of_code = _digest(codes, [(name, _code(content)) for name, content in contents])[:16]
    if kept.parent.is_dir():
        with suppress(OSError):
            kept.write_text(f"{of_bytes} {of_code}\n", "ascii")
    return of_code


def libraries_folder() -> Path:
    """Return the folder of compiled kernels: inside the package, as its build leaves it."""
    return Path(__file__).parent / "libraries"


def unchanged() -> bool:
    """Return whether the sources are what they were when they were hashed."""
    return all(_stamp(source) == stamp for source, stamp in _stamps().items())


def _digest(codes: str, contents: list[tuple[bytes, bytes]]) -> str:
    digest = hashlib.sha256(codes.encode())
    for name, content in contents:
        digest.update(b"%b\0%d\0%b" % (name, len(content), content))
    return digest.hexdigest()


def _code(content: bytes) -> bytes:
    """Return a module's syntax tree as bytes: the same under every version of Python."""
    import ast

    def words(node: object) -> Iterator[str]:
        if isinstance(node, ast.AST):
            yield type(node).__name__
            for name in sorted(node._fields):
                value = getattr(node, name, None)
                if isinstance(value, list):
                    value = [each for each in value if not is_text(each)]
                if value is not None and value != []:
                    yield name
                    yield from words(value)
            yield ")"
        elif isinstance(node, list):
            for each in node:
                yield from words(each)
        else:
            yield repr(node)

    def is_text(node: object) -> bool:
        return (
            isinstance(node, ast.Expr)
            and isinstance(node.value, ast.Constant)
            and isinstance(node.value.value, str)
        )

    return "\0".join(words(ast.parse(content))).encode()


def _root() -> Path:
    return Path(__file__).parents[1]


@cache
def _stamps() -> dict[Path, tuple[int, int]]:
    """Return time stamp and size of each source when it was hashed."""
    return {source: _stamp(source) for source in sources()}


def _stamp(source: Path) -> tuple[int, int]:
    found = source.stat()
    return found.st_mtime_ns, found.st_size
