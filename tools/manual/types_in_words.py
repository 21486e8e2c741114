"""Types of parameters, fields and results in words, from the annotations of the source.

The source says it shortest: `ArrayLike` is one word there, and a union of fifteen types once it is
evaluated. What is an alias there is resolved here: `Start` is one of four classes to the reader.
"""

import ast
import functools
import inspect
import sys
import types
import typing
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.machine_code.types import element_type
from tools.namespace import THINGS

WORDS = {
    "Any": "any value",
    "ArrayLike": "ArrayLike",
    "Axes": "matplotlib Axes",
    "Callable": "callable",
    "DataFrame": "pandas.DataFrame",
    "Floats": "array of float",
    "Motion": "any motion",
    "NoneType": "None",
    "Path": "path",
    "PathLike": "path",
    "Self": "the same class",
    "bool": "bool",
    "bool_": "bool",
    "complex128": "complex",
    "datetime": "datetime",
    "float": "float",
    "float64": "float",
    "int": "int",
    "int64": "int",
    "int8": "int",
    "object": "any value",
    "slice": "slice",
    "str": "str",
    "str_": "str",
}
"""Names of types in the source by the words of the reference."""
MANY = {
    "Iterable": "iterable",
    "Iterator": "iterator",
    "NDArray": "array",
    "Sequence": "sequence",
    "list": "list",
    "tuple": "tuple",
}


@functools.cache
def tree_of(module: str) -> ast.Module:
    """Return the syntax tree of a module of the package."""
    return ast.parse(Path(str(sys.modules[module].__file__)).read_text(encoding="utf-8"))


def definition(thing: Any) -> ast.ClassDef | ast.FunctionDef | None:
    """Return where the source defines a class or function of the package."""
    node: ast.ClassDef | ast.FunctionDef | None = None
    body = tree_of(thing.__module__).body
    for part in thing.__qualname__.split("."):
        node = next(
            (
                each
                for each in body
                if isinstance(each, ast.ClassDef | ast.FunctionDef) and each.name == part
            ),
            None,
        )
        if node is None:
            return None
        body = node.body
    return node


def types_of(thing: Any) -> dict[str, str]:
    """Return the types of the parameters of a function, or of the fields of a class, in words."""
    if isinstance(thing, type):
        return _fields(thing)
    function = inspect.unwrap(getattr(thing, "__func__", thing))
    node = definition(function) if hasattr(function, "__qualname__") else None
    return _parameters(node, function.__module__) if isinstance(node, ast.FunctionDef) else {}


def type_of_result(thing: Any) -> str:
    """Return the type of what a function returns, in words, or an empty text."""
    function = inspect.unwrap(getattr(thing, "__func__", thing))
    node = definition(function) if hasattr(function, "__qualname__") else None
    if not isinstance(node, ast.FunctionDef) or node.returns is None:
        return ""
    return in_words(node.returns, function.__module__)


def _fields(thing: type) -> dict[str, str]:
    found: dict[str, str] = {}
    for base in reversed(thing.__mro__):
        node = definition(base) if base.__module__.startswith("rocksteady") else None
        for each in node.body if node else []:
            if isinstance(each, ast.AnnAssign) and ast.unparse(each.target) != "_":
                found[ast.unparse(each.target)] = in_words(each.annotation, base.__module__)
            elif isinstance(each, ast.FunctionDef) and each.name == "__init__":
                found |= _parameters(each, base.__module__)
            elif isinstance(each, ast.FunctionDef) and _is_property(each) and each.returns:
                found.setdefault(each.name, in_words(each.returns, base.__module__))
    return found


def _is_property(node: ast.FunctionDef) -> bool:
    return any(ast.unparse(each) in {"property", "cached_property"} for each in node.decorator_list)


def _parameters(node: ast.FunctionDef, module: str) -> dict[str, str]:
    every = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
    every += [each for each in (node.args.vararg, node.args.kwarg) if each]
    return {each.arg: in_words(each.annotation, module) for each in every if each.annotation}


def in_words(node: ast.expr, module: str) -> str:
    """Return an annotation in words, with single backticks about names of classes."""
    match node:
        case ast.Constant(value=None):
            return "None"
        case ast.Constant(value=str(text)):
            return in_words(ast.parse(text, mode="eval").body, module)
        case ast.Name(id=name):
            return _name(name, module)
        case ast.Attribute(attr=name):
            return WORDS.get(name) or ast.unparse(node)
        case ast.BinOp(left=left, right=right):
            return _either((in_words(left, module), in_words(right, module)))
        case ast.Subscript(value=ast.Name(id=name), slice=within):
            parts = within.elts if isinstance(within, ast.Tuple) else [within]
            return _of(name, parts, module)
    raise ValueError(f"no words for the type {ast.unparse(node)}")


def _of(name: str, parts: list[ast.expr], module: str) -> str:
    if name == "Literal":
        return _either(f"``{ast.unparse(part)}``" for part in parts)
    if name in WORDS:
        return WORDS[name]
    if name == "Annotated":  # the range of a value stands in its own sentence
        return in_words(parts[0], module)
    words = [in_words(part, module) for part in parts if ast.unparse(part) != "..."]
    if name in {"Mapping", "dict"}:
        return f"mapping of {words[0]} to {words[1]}"
    if name == "tuple" and len(words) == len(parts):
        return _fixed(words)
    return _several(MANY[name], words[0])


def _fixed(words: list[str]) -> str:
    """Return a tuple of so many items in words."""
    number = {2: "pair", 3: "triple"}.get(len(words))
    if number and len(set(words)) == 1:
        return _several(number, words[0])
    return f"({', '.join(words)})"


def _either(words: Iterable[str]) -> str:
    """Return alternatives, each once."""
    return " or ".join(dict.fromkeys(words))


def _several(kind: str, words: str) -> str:
    """Return a collection of items in words."""
    several = " or " in words and not words.startswith("(")
    return f"{kind} of ({words})" if several else f"{kind} of {words}"


def _name(name: str, module: str) -> str:
    """Return the name of a type in words: of an alias what it stands for."""
    if name in WORDS:
        return WORDS[name]
    if name in THINGS:
        return f"`{name}`"
    return _value(getattr(sys.modules[module], name, name))


def _value(value: Any) -> str:
    """Return what an alias of types stands for, in words."""
    origin, parts = typing.get_origin(value), typing.get_args(value)
    if origin is typing.Literal:
        return _either(f"``{part!r}``" for part in parts)
    if origin in {types.UnionType, typing.Union}:
        return _either(_value(part) for part in parts)
    if origin in {np.ndarray, typing.get_origin(NDArray[np.float64])}:
        return f"array of {WORDS[element_type(value).__name__]}"
    if origin is tuple:
        words = [_value(part) for part in parts if part is not ...]
        return _several("tuple", words[0]) if parts[-1] is ... else _fixed(words)
    if origin is dict:
        return f"mapping of {_value(parts[0])} to {_value(parts[1])}"
    name = value if isinstance(value, str) else (origin or value).__name__
    return WORDS.get(name, f"`{name}`")
