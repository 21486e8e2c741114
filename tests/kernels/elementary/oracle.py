"""Elementary functions in ball arithmetic, what is drawn to test ours, and errors in ulp."""

import math
import re
import types
from collections.abc import Callable
from typing import Any

import flint
import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels import elementary
from rocksteady.kernels.elementary import arrays
from rocksteady.kernels.elementary.circular import NEAR
from tests.strategies import sample_size

Floats = NDArray[np.float64]
Draw = Callable[[np.random.Generator, int], Floats]

COUNT = sample_size(30_000, 6_000)
MANY = 500_000
CHUNK = 100_000
LARGEST = np.finfo(np.float64).max


def stated_bounds() -> dict[str, float]:
    """Return the largest error of each function as the package's docstring states it."""
    rows = re.findall(r"^([a-z0-9, ]+?)  +([0-9.]+)  +\S", elementary.__doc__ or "", re.MULTILINE)
    return {name: float(ulp) for names, ulp in rows for name in names.split(", ")}


BOUNDS = stated_bounds()


def uniform(low: float, high: float) -> Draw:
    return lambda rng, count: rng.uniform(low, high, count)


def spread(low: float, high: float) -> Draw:
    """Return numbers of either sign, their logarithms uniform."""
    low, high = math.log(low), math.log(high)
    return lambda rng, count: np.exp(rng.uniform(low, high, count)) * rng.choice([-1.0, 1.0], count)


def near(points: float, most: int) -> Draw:
    """Return numbers beside the multiples of a number."""
    return lambda rng, count: (
        rng.integers(1, most, count) * points * (1.0 + rng.normal(0.0, 1e-12, count))
    )


def any_float(rng: np.random.Generator, count: int) -> Floats:
    """Return finite floats of either sign, every one as likely as another."""
    drawn = rng.integers(0, 0x7FF0000000000000, count).view(np.float64)
    signed: Floats = np.copysign(drawn, rng.choice([-1.0, 1.0], count))
    return signed


def positive(draw: Draw) -> Draw:
    return lambda rng, count: np.abs(draw(rng, count))


ANGLES: list[Any] = [
    uniform(-1.6, 4.8),
    uniform(-NEAR, NEAR),
    near(0.5 * math.pi, 127_000),
    spread(1e5, 1e20),
]
"""Ranges from which angles are drawn."""


def length(x: Any, y: Any) -> Any:
    return (x * x + y * y).sqrt()


ORACLES: dict[str, Callable[..., Any]] = {"atan2": flint.arb.atan2, "hypot": length}


def error_of(name: str, *arguments: Floats) -> float:
    """Return the largest error of a function in ulp of its result.

    Results must be finite and not zero, or exact.
    """
    results = getattr(arrays, name)(*arguments)
    assert np.isfinite(results).all()
    exact = ORACLES.get(name) or getattr(flint.arb, name)
    units = np.spacing(np.abs(results))
    # Enough for what an angle of 1e308 loses in its whole turns, or a number near 1 in its log.
    size = max(float(np.abs(each).max()) for each in arguments)
    turns = name in {"sin", "cos", "tan"}
    worst = 0.0
    columns = (each.tolist() for each in arguments)
    with flint.ctx.workprec(170 + (max(0, math.frexp(size)[1]) if turns else 0)):
        for result, unit, *given in zip(results.tolist(), units.tolist(), *columns, strict=True):
            truth = exact(*map(flint.arb, given))
            error = abs(float(truth - flint.arb(result)))
            if not error <= worst * unit:
                worst = error / unit
    return worst


def check(name: str, draws: list[Any], count: int, *, bound: float | None = None) -> None:
    """Assert that errors stay within what is stated, over `count` arguments from all ranges.

    A draw of a function of two numbers is a pair.
    """
    rng = np.random.default_rng(1989)
    each = count // len(draws)
    for draw in draws:
        pair = draw if isinstance(draw, tuple) else (draw,)
        for start in range(0, each, CHUNK):
            size = min(CHUNK, each - start)
            error = error_of(name, *(one(rng, size) for one in pair))
            assert 0.3 < error <= (bound or BOUNDS[name]), (name, error)


def plain(kernel: Any) -> Any:
    """Return a kernel as a function of Python that calls nothing compiled."""
    function = kernel.py_func
    names = dict(function.__globals__)
    for name in function.__code__.co_names:
        if hasattr(names.get(name), "py_func"):
            names[name] = plain(names[name])
    return types.FunctionType(function.__code__, names)


def bits(values: Any) -> list[int]:
    """Return the bits of floats, one pattern for all that are NaN."""
    array = np.atleast_1d(np.asarray(values, dtype=np.float64))
    return np.where(np.isnan(array), np.nan, array).view(np.int64).tolist()  # type: ignore[no-any-return]


SPECIAL = (
    *(0.0, -0.0, math.inf, -math.inf, math.nan, 1.0, -1.0, 0.5, -0.5, 5e-324, -5e-324),
    *(1e-310, -1e-310, 1e-17, -1e-17, 1.0 + 2.0**-52, 1.0 - 2.0**-53, 37.0, -37.0, 2e5, -2e5),
    *(2e5 + 1e-10, 709.78, 709.79, 710.475, 710.476, -708.5, -745.1, -745.2, 1e16, 2.0**52),
    *(1e300, -1e300, float(LARGEST), -float(LARGEST)),
)


def same_as_math(name: str, *arguments: float) -> bool:
    """Return whether a value, infinite, zero or NaN, agrees with Python's own function.

    Python raises where C99 returns an infinity or NaN.
    """
    ours = getattr(arrays, name)(*arguments)
    try:
        theirs = getattr(math, name)(*arguments)
    except OverflowError:
        even = name in {"exp", "expm1", "cosh"}
        theirs = math.inf if even else math.copysign(math.inf, arguments[0])
    except ValueError:
        pole = (name, arguments[0]) in {("log", 0.0), ("log1p", -1.0)}
        theirs = -math.inf if pole else math.nan
    if math.isnan(theirs) or math.isinf(theirs) or theirs == 0.0:
        return bits(ours) == bits(theirs)
    return bool(abs(ours - theirs) <= 3.0 * math.ulp(theirs))


def around(point: float, count: int = 1000) -> Floats:
    """Return so many floats in a row on either side of a positive number."""
    middle = int(np.float64(point).view(np.int64))
    return np.arange(middle - count, middle + count).view(np.float64)
