"""Arrays of amplitude, frequency ratio, restitution and order, validated and broadcast."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.checks.arrays import UnfitError, numeric_array
from rocksteady.model.checks.bounds import RESTITUTION, Bounds
from rocksteady.model.checks.validation import LARGEST, odd_order
from rocksteady.model.motions.segments import HIGHEST_FREQUENCY_RATIO, LOWEST_FREQUENCY_RATIO

AMPLITUDE = Bounds(0.0, LARGEST, "[]", "give a_max/(alpha g)")
FREQUENCY_RATIO = Bounds(LOWEST_FREQUENCY_RATIO, HIGHEST_FREQUENCY_RATIO, "[]", "give omega/p")

SMALLEST = 1e-140
"""Smallest amplitude that closed forms take: steady states below it have the same digits."""
HIGHEST_ORDER = 999_999
"""The longest half cycle, in half periods of the shaking."""


def resolved(amplitude: Floats) -> Floats:
    """Return amplitudes from which the closed forms can be computed: those below are raised.

    The squares of the boundaries' ratios to a smaller one would overflow.
    """
    return np.where(amplitude > 0.0, np.maximum(amplitude, SMALLEST), amplitude)


def validated_grid(
    amplitude: ArrayLike, frequency_ratio: ArrayLike, restitution: ArrayLike, order: ArrayLike
) -> tuple[Floats, Floats, Floats, NDArray[np.int64]]:
    """Return the four arguments of the steady states as contiguous arrays of one shape.

    Raises
    ------
    InputError
        If a value is outside its range, or the shapes do not broadcast.
    """
    amplitudes = checked_array("amplitude", amplitude, AMPLITUDE)
    ratios = checked_array("frequency_ratio", frequency_ratio, FREQUENCY_RATIO)
    restitutions = checked_array("restitution", restitution, RESTITUTION)
    try:
        orders = np.asarray(numeric_array("order", order, None))
    except (UnfitError, ValueError):
        order_of_orbit(order)
        raise
    if orders.dtype.kind not in "iu":
        for value in orders.flat:
            order_of_orbit(value)
        orders = orders.astype(np.int64)  # without elements, or the order of no integer type
    odd = (orders >= 1) & (orders % 2 == 1) & (orders <= HIGHEST_ORDER)
    if not odd.all():
        order_of_orbit(orders[~odd].flat[0].item())
    try:
        shape = np.broadcast_shapes(
            amplitudes.shape, ratios.shape, restitutions.shape, orders.shape
        )
    except ValueError:
        raise InputError(
            "shapes",
            (amplitudes.shape, ratios.shape, restitutions.shape, orders.shape),
            "the arguments must broadcast against each other",
            "give arrays of one shape, or add axes with [:, np.newaxis]",
        ) from None
    # Copies, so that the kernels see one type of array: read-only ones would be compiled for again.
    a, w, r = (
        np.array(np.broadcast_to(array, shape), order="C")
        for array in (amplitudes, ratios, restitutions)
    )
    return a, w, r, np.array(np.broadcast_to(orders, shape), dtype=np.int64, order="C")


def real_array(name: str, values: ArrayLike) -> Floats:
    """Return real numbers as an array of floats.

    Raises
    ------
    InputError
        If they are anything else: text and booleans are not converted.
    """
    try:
        return np.asarray(numeric_array(name, values)).astype(np.float64)
    except UnfitError:
        raise InputError(
            name, values, "it must be a real number or an array of them", "give floats"
        ) from None


def checked_array(name: str, values: ArrayLike, bounds: Bounds) -> Floats:
    """Return a float array whose values lie in an interval; the first that does not is reported."""
    array = real_array(name, values)
    above = array >= bounds.low if bounds.ends[0] == "[" else array > bounds.low
    below = array <= bounds.high if bounds.ends[1] == "]" else array < bounds.high
    for value in array[~(above & below)][:1].tolist():
        bounds(name, value)
    return array


def order_of_orbit(value: object) -> int:
    """Return an order that the closed forms can follow."""
    order = odd_order("order", value)
    if order > HIGHEST_ORDER:
        valid = f"it must be at most {HIGHEST_ORDER}"
        raise InputError("order", value, valid, "use 1, 3, 5, ...")
    return order
