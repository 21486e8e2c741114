"""What the annotations of a kernel say about its calls."""

from typing import Annotated, Any, NamedTuple, TypeVar

import numpy as np
import pytest
from numpy.typing import NDArray
from typing_extensions import TypeAliasType

from rocksteady.kernels.machine_code.types import (
    Booleans2,
    Floats1,
    Floats3,
    Integers2,
    Leaf,
    element_type,
    signature_of,
)

Item = TypeVar("Item", bound=np.generic)
Aliased = TypeAliasType("Aliased", np.ndarray[tuple[Any, ...], np.dtype[Item]], type_params=(Item,))
"""What NDArray is from NumPy 2.5 on."""


class Point(NamedTuple):
    x: float
    place: tuple[int, bool]


def nested(first: Floats1, point: Point, count: int) -> tuple[bool, Point, complex]:
    raise NotImplementedError(first, point, count)


def nothing(cube: Floats3, whole: Integers2, truth: Booleans2) -> None:
    raise NotImplementedError(cube, whole, truth)


@pytest.mark.parametrize("kind", [np.float64, np.int64, np.bool_])
def test_elements_of_arrays_are_those_of_the_annotation(kind: Any) -> None:
    plain = np.ndarray[tuple[Any, ...], np.dtype[kind]]
    assert element_type(plain) is element_type(NDArray[kind]) is element_type(Aliased[kind]) is kind


def test_tuples_are_taken_apart_in_order() -> None:
    signature = signature_of(nested)
    assert signature.leaves == (
        Leaf("first", float, 1),
        Leaf("point.x", float),
        Leaf("point.place.0", int),
        Leaf("point.place.1", bool),
        Leaf("count", int),
    )
    assert [leaf.name for leaf in signature.returned] == ["0", "1.x", "1.place.0", "1.place.1", "2"]


def test_an_array_takes_a_cell_for_its_address_and_one_a_dimension() -> None:
    assert [leaf.cells for leaf in signature_of(nothing).leaves] == [4, 3, 3]
    assert [leaf.cells for leaf in signature_of(nested).returned] == [1, 1, 1, 1, 2]
    assert signature_of(nothing).returned == ()


def test_an_array_without_dimensions_is_refused() -> None:
    def vague(array: NDArray[np.float64]) -> None:
        raise NotImplementedError(array)

    with pytest.raises(TypeError, match=r"vague: array is .*float64.* cannot pass"):
        signature_of(vague)


def test_a_kernel_may_not_return_an_array() -> None:
    def array() -> Annotated[NDArray[np.float64], 1]:
        raise NotImplementedError

    with pytest.raises(TypeError, match="array returns an array"):
        signature_of(array)
