"""Signatures as `help()` shows them: annotations as short as in the source."""

import inspect
import re
import sys
import types
from collections.abc import Sequence
from typing import Any, Final, Union, get_args, get_origin

UNIONS: Final = (Union, types.UnionType)


class _Words:
    """An annotation as it is written in the source."""

    def __init__(self, text: str) -> None:
        self.text = text

    def __repr__(self) -> str:
        return self.text


def alternatives(annotation: Any) -> tuple[Any, ...]:
    """Return the parts of a union, and of what is an alias of one; of anything else that itself."""
    value = getattr(annotation, "__value__", annotation)
    if get_origin(value) not in UNIONS:
        return (value,)
    return tuple(each for part in get_args(value) for each in alternatives(part))


def is_array_like(parts: Sequence[Any]) -> bool:
    """Return whether some alternatives are those of ArrayLike, and perhaps others."""
    typing = sys.modules.get("numpy.typing")
    return typing is not None and all(part in parts for part in alternatives(typing.ArrayLike))


def readable(signature: inspect.Signature) -> inspect.Signature:
    """Return a signature whose annotations are short."""
    return signature.replace(
        parameters=[
            each.replace(annotation=_short(each.annotation))
            for each in signature.parameters.values()
        ],
        return_annotation=_short(signature.return_annotation),
    )


def _short(annotation: Any) -> Any:
    """Return an annotation with names for unions of arrays, and classes without modules."""
    if annotation is inspect.Parameter.empty:
        return annotation
    inner = alternatives(annotation)
    if is_array_like(inner):
        return _Words("ArrayLike | None" if types.NoneType in inner else "ArrayLike")
    text = annotation if isinstance(annotation, str) else inspect.formatannotation(annotation)
    text = re.sub(
        r"(typing\.)?Union\[[^\[]*_Buffer.*?complex \| bytes \| str\]\]", "ArrayLike", text
    )
    text = re.sub(r"NDArray\[[^\]]*\]", "ndarray", text)
    text = re.sub(r"ndarray\[tuple\[[^\]]*\], [\w.]*dtype\[[^\]]*\]\]", "ndarray", text)
    return _Words(re.sub(r"\b(?:[a-z_]\w*\.)+(?=\w)", "", text))
