"""Annotations of kernels that Python calls, and the signatures that follow from them.

They state the dimensions of each array.  The library, numba and the WebAssembly module all expect
C-contiguous, writable arrays of that type.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from types import NoneType
from typing import Annotated, Any, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import NDArray

Floats1 = Annotated[NDArray[np.float64], 1]
Floats2 = Annotated[NDArray[np.float64], 2]
Floats3 = Annotated[NDArray[np.float64], 3]
Floats4 = Annotated[NDArray[np.float64], 4]
Integers1 = Annotated[NDArray[np.int64], 1]
Integers2 = Annotated[NDArray[np.int64], 2]
Booleans2 = Annotated[NDArray[np.bool_], 2]

SCALARS = (float, int, bool, complex)


@dataclass(frozen=True)
class Leaf:
    """One number or array of a call, taken out of its tuples.

    Attributes
    ----------
    name
        Where it is, as ``start.phase``.
    kind
        Its Python type; of an array that of its elements.
    dimensions
        Of an array; 0 otherwise.
    """

    name: str
    kind: type
    dimensions: int = 0

    @property
    def cells(self) -> int:
        """Return how many cells of 8 bytes hold it: of an array its address and its lengths."""
        if self.dimensions:
            return 1 + self.dimensions
        return 2 if self.kind is complex else 1


@dataclass(frozen=True)
class Signature:
    """What a kernel takes and returns.

    Attributes
    ----------
    names
        Of its arguments.
    arguments
        Their annotations: a scalar, an array with its dimensions, or a tuple of annotations.
    result
        The annotation of what it returns; None where it returns nothing.
    """

    names: tuple[str, ...]
    arguments: tuple[Any, ...]
    result: Any

    @property
    def leaves(self) -> tuple[Leaf, ...]:
        """Return the leaves of all arguments, in order."""
        pairs = zip(self.names, self.arguments, strict=True)
        return tuple(leaf for name, hint in pairs for leaf in signature_leaves(name, hint))

    @property
    def returned(self) -> tuple[Leaf, ...]:
        """Return the leaves of the result, in order."""
        return () if self.result is None else tuple(signature_leaves("", self.result))


@cache
def signature_of(function: Callable[..., object]) -> Signature:
    """Return the signature that a function's annotations state.

    Raises
    ------
    TypeError
        If Python cannot pass an argument of that type to a kernel, or if it returns an array.
    """
    hints = get_type_hints(function, include_extras=True)
    result = hints.pop("return")
    found = Signature(tuple(hints), tuple(hints.values()), None if result is NoneType else result)
    try:
        _, returned = found.leaves, found.returned
    except TypeError as error:
        raise TypeError(f"{function.__qualname__}: {error}") from None
    if any(leaf.dimensions for leaf in returned):
        raise TypeError(f"{function.__qualname__} returns an array")
    return found


def parts(hint: Any) -> tuple[tuple[str, Any], ...] | None:
    """Return names and annotations of what a tuple is made of; None of anything else."""
    if isinstance(hint, type) and issubclass(hint, tuple):
        return tuple(get_type_hints(hint, include_extras=True).items())
    if get_origin(hint) is tuple:
        return tuple((str(index), part) for index, part in enumerate(get_args(hint)))
    return None


def element_type(array: Any) -> Any:
    """Return the type of the elements of an array, by its annotation.

    NumPy 2.5 made NDArray an alias of its own; before, it stood for an ndarray with a dtype.
    """
    inner = get_args(array)
    return element_type(inner[-1]) if inner else array


def signature_leaves(name: str, hint: Any) -> Iterator[Leaf]:
    """Yield the leaves of one argument or result; None has none."""
    inner = parts(hint)
    if inner is not None:
        for part, annotation in inner:
            yield from signature_leaves(f"{name}.{part}" if name else part, annotation)
    elif hint in SCALARS:
        yield Leaf(name, hint)
    elif hint is NoneType:  # a field that another kind of the same tuple fills
        return
    elif get_origin(hint) is Annotated:
        array, dimensions = get_args(hint)
        kinds = {np.float64: float, np.int64: int, np.bool_: bool}
        yield Leaf(name, kinds[element_type(array)], dimensions)
    else:
        raise TypeError(f"{name or 'the result'} is a {hint}, which Python cannot pass")
