"""Signatures as `help()` shows them: annotations as short as in the source."""

import inspect
import re
import types
from typing import Any, get_args, get_origin


class _Words:
    """An annotation as it is written in the source."""

    def __init__(self, text: str) -> None:
        self.text = text

    def __repr__(self) -> str:
        return self.text


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
    inner = get_args(annotation)
    if any("_SupportsArray" in str(get_origin(part)) for part in inner):
        return _Words("ArrayLike | None" if types.NoneType in inner else "ArrayLike")
    text = annotation if isinstance(annotation, str) else inspect.formatannotation(annotation)
    text = re.sub(
        r"(typing\.)?Union\[[^\[]*_Buffer.*?complex \| bytes \| str\]\]", "ArrayLike", text
    )
    text = re.sub(r"ndarray\[tuple\[[^\]]*\], [\w.]*dtype\[[^\]]*\]\]", "ndarray", text)
    return _Words(re.sub(r"\b(?:[a-z_]\w*\.)+(?=\w)", "", text))
