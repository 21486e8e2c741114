"""The return map and its orbits under a Fourier series, as functions that Python calls.

What takes a system takes both kinds of it; a function of the library has one type of arguments, so
that each stands here once more.  `for_system` chooses.
"""

from typing import Any

from rocksteady.kernels.machine_code.compilation import compiled
from rocksteady.kernels.machine_code.types import Floats2
from rocksteady.kernels.orbits.periodic import (
    Fixed,
    Orbits,
    Sought,
    fill_peaks,
    is_symmetric,
    loss,
    measured,
    polish,
    search,
)
from rocksteady.kernels.orbits.return_map import (
    AnyState,
    Passage,
    Section,
    highest_after,
    next_passage,
    uplift_after,
)
from rocksteady.kernels.orbits.settle import Settled, settle
from rocksteady.kernels.orbits.systems import EitherSystem, SeriesSystem

# Annotated for one kind of system, compiled for both.
_next_passage: Any = next_passage
_uplift_after: Any = uplift_after
_highest_after: Any = highest_after
_settle: Any = settle
_search: Any = search
_polish: Any = polish
_measured: Any = measured
_loss: Any = loss
_fill_peaks: Any = fill_peaks
_is_symmetric: Any = is_symmetric


@compiled
def series_next_passage(system: SeriesSystem, state: Section, guess: float) -> Passage:
    """Return what `next_passage` does."""
    found: Passage = _next_passage(system, state, guess)
    return found


@compiled
def series_uplift_after(system: SeriesSystem, half_cycles: int, phase: float) -> Passage:
    """Return what `uplift_after` does."""
    found: Passage = _uplift_after(system, half_cycles, phase)
    return found


@compiled
def series_highest_after(
    system: SeriesSystem, state: Section, passage: Passage
) -> tuple[float, float]:
    """Return what `highest_after` does."""
    found: tuple[float, float] = _highest_after(system, state, passage)
    return found


@compiled
def series_settle(
    system: SeriesSystem, start: AnyState, most_periods: int, memory: Floats2, table: Floats2
) -> Settled:
    """Return what `settle` does."""
    found: Settled = _settle(system, start, most_periods, memory, table)
    return found


@compiled
def series_search(
    system: SeriesSystem, sought: Sought, table: Floats2, orbits: Orbits, count: int
) -> int:
    """Return what `search` does."""
    found: int = _search(system, sought, table, orbits, count)
    return found


@compiled
def series_polish(
    system: SeriesSystem, state: Section, passages: int, periods: int, table: Floats2
) -> Fixed:
    """Return what `polish` does."""
    found: Fixed = _polish(system, state, passages, periods, table)
    return found


@compiled
def series_measured(system: SeriesSystem, passages: int, periods: int, table: Floats2) -> Fixed:
    """Return what `measured` does."""
    found: Fixed = _measured(system, passages, periods, table)
    return found


@compiled
def series_loss(system: SeriesSystem, side: int, passages: int, rests: int) -> float:
    """Return what `loss` does."""
    found: float = _loss(system, side, passages, rests)
    return found


@compiled
def series_fill_peaks(system: SeriesSystem, passages: int, table: Floats2) -> None:
    """Do what `fill_peaks` does."""
    _fill_peaks(system, passages, table)


@compiled
def series_is_symmetric(system: SeriesSystem, table: Floats2, passages: int, periods: int) -> bool:
    """Return what `is_symmetric` does."""
    found: bool = _is_symmetric(system, table, passages, periods)
    return found


SERIES: dict[str, Any] = {
    "next_passage": series_next_passage,
    "uplift_after": series_uplift_after,
    "highest_after": series_highest_after,
    "settle": series_settle,
    "search": series_search,
    "polish": series_polish,
    "measured": series_measured,
    "loss": series_loss,
    "fill_peaks": series_fill_peaks,
    "is_symmetric": series_is_symmetric,
}
"""Kernels for a Fourier series, by the names of their harmonic counterparts."""


def for_system(kernel: Any, system: EitherSystem) -> Any:
    """Return a kernel for the kind of a system."""
    return SERIES[kernel.__name__] if isinstance(system, SeriesSystem) else kernel
